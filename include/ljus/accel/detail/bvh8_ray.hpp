#pragma once

/// \file ljus/accel/detail/bvh8_ray.hpp
/// \brief A ray as the fast tree asks it.

#include <array>
#include <cstddef>
#include <limits>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup wide_ray Rays for wide nodes
/// \brief What is computed once for a ray: the signs and the slack of box_ray()
/// \cite williams2005 \cite ize2013. Chapter: \ref ch_bvh.
/// \{

/// A ray, made ready for wide nodes.
struct Bvh8Ray {
    Vec3 inverse{1};                   ///< 1 / D, finite.
    Vec3 near_shift{0};                ///< t = plane * inverse - shift, a little early,
    Vec3 far_shift{0};                 ///< and a little late.
    std::array<std::size_t, 3> near{}; ///< The planes that it meets first, by axis,
    std::array<std::size_t, 3> far{};  ///< and last.
    float length = 0;                  ///< The largest component of D.
    float last = 0;                    ///< Beyond this t there is nothing.
    bool moderate = false; ///< Products of three such lengths are far from infinite.
};

/// Makes a ray ready. Boxes grow by as much as box_ray() says. A component of the
/// direction that is almost 0 is given a size: within the box that leads no ray astray
/// by more than this.
/// \param r       Becomes the ready ray.
/// \param ray     The ray.
/// \param middle  The middle of everything.
/// \param half    From there to the sides.
/// \return Whether that is possible: not if the direction is too long or too short, or
///         the origin too far away, for squares of floats.
// [make_ready]
[[nodiscard]] inline bool make_ready(Bvh8Ray& r, const Ray& ray, const Vec3& middle,
                                     const Vec3& half) noexcept {
    const Vec3 origin = ray.origin - middle;
    const Vec3 size = sizes(ray.direction);
    const float reach = max_component(sizes(origin) + half);
    r.length = max_component(size);
    r.last = 4 * reach / r.length;
    const Vec3 d = glm::max(size, Vec3{1e-12f * r.length});
    const float slack = 8 * std::numeric_limits<float>::epsilon() * reach;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::size_t back = std::signbit(ray.direction[axis]) ? 1 : 0;
        // Not by `back ?`: which way rays go a processor cannot guess.
        const float size_of_inverse = 1 / d[axis];
        const float inverse = std::copysign(size_of_inverse, ray.direction[axis]);
        const float shift = origin[axis] * inverse;
        const float grown = slack * size_of_inverse;
        r.inverse[axis] = inverse;
        r.near_shift[axis] = shift + grown;
        r.far_shift[axis] = shift - grown;
        r.near[i] = i + 3 * back;
        r.far[i] = i + 3 * (1 - back);
    }
    r.moderate = reach * reach * glm::max(reach, r.length) < 1e36f;
    // Their squares are still numbers: those of the directions, and of the distances.
    constexpr float most = 1e18f;
    return r.length > 1 / most && r.length < most && reach < most &&
           is_finite(r.near_shift) && is_finite(r.far_shift);
}
// [make_ready]

/// \}

} // namespace ljus
