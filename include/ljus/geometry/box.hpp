#pragma once

/// \file ljus/geometry/box.hpp
/// \brief Axis-aligned boxes and their intersection with rays.

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup box Boxes
/// \brief Axis-aligned bounding boxes, which the student report proposes as a way to
/// spare intersection tests. Chapter: \ref ch_bvh.
/// \{

/// An axis-aligned box, given by two opposite corners. The default box is empty.
template <std::floating_point T>
struct BoxT {
    Vec3T<T> low{std::numeric_limits<T>::infinity()};   ///< The least x, y and z.
    Vec3T<T> high{-std::numeric_limits<T>::infinity()}; ///< The greatest x, y and z.
};
using Box = BoxT<float>; ///< BoxT in float.

/// The smallest box that contains two boxes.
template <std::floating_point T>
[[nodiscard]] constexpr BoxT<T> box_union(const BoxT<T>& a, const BoxT<T>& b) noexcept {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

/// The smallest box that contains a box and a point.
template <std::floating_point T>
[[nodiscard]] constexpr BoxT<T> box_union(const BoxT<T>& a,
                                          const Vec3T<T>& point) noexcept {
    return {glm::min(a.low, point), glm::max(a.high, point)};
}

/// A ray that is prepared for intersection with many boxes.
template <std::floating_point T>
struct BoxRayT {
    Vec3T<T> origin{T(0)};             ///< The ray's origin, in scene units.
    Vec3T<T> inverse{T(1)};            ///< 1 over the direction, per component.
    std::array<bool, 3> is_negative{}; ///< Sign of `inverse`; -0 counts as negative.
    T slack = T(0); ///< Margin added to each side of each box, in scene units.
};

/// Prepares a ray for intersection with many boxes.
///
/// A tree must find every hit that the test of a shape finds. The rounding errors of
/// the shape's test and of the box's test are proportional to the distance of the boxes
/// from the ray's origin. Each box is therefore enlarged by this distance times 16
/// units of roundoff. The test of a box alone needs 3 units \cite ize2013.
/// \param ray  The ray, whose range is ignored.
/// \param all  A box around all boxes to be tested.
/// \return Nothing if the square of the direction's length is outside the range of T,
///         or if that of the distance to `all` overflows; the shapes must then be
///         tested without boxes.
// [box_ray]
template <std::floating_point T>
[[nodiscard]] std::optional<BoxRayT<T>> box_ray(const RayT<T>& ray,
                                                const BoxT<T>& all) noexcept {
    using Limits = std::numeric_limits<T>;
    const T reach = max_component(glm::max(detail::sizes(all.low - ray.origin),
                                           detail::sizes(all.high - ray.origin)));
    const T length = max_component(detail::sizes(ray.direction));
    const bool usable = length * length >= Limits::min() &&
                        length * length <= Limits::max() &&
                        reach * reach <= Limits::max(); // no for NaN
    if (!usable) return std::nullopt;
    const Vec3T<T> inverse = T(1) / ray.direction;
    return BoxRayT<T>{.origin = ray.origin,
                      .inverse = inverse,
                      .is_negative = {std::signbit(inverse.x), std::signbit(inverse.y),
                                      std::signbit(inverse.z)},
                      .slack = T(8) * Limits::epsilon() * reach};
}
// [box_ray]

/// Finds where a ray enters a box. A point of the ray is in the box if it lies beyond
/// the near plane and before the far plane of each axis. The signs of the inverse
/// direction tell the near plane from the far one \cite williams2005.
///
/// If the ray lies in the plane of a side, the plane's distance is
/// \f$ 0 \cdot \infty \f$, which is NaN. The comparisons ignore a NaN.
/// \return The first t of [t_min, t_max] inside the box; nothing for a miss, or if the
///         range is NaN.
// [slabs]
template <std::floating_point T>
[[nodiscard]] std::optional<T> intersect(const BoxRayT<T>& ray, const BoxT<T>& box,
                                         T t_min, T t_max) noexcept {
    for (int axis = 0; axis < 3; ++axis) {
        const bool back = ray.is_negative[static_cast<std::size_t>(axis)];
        const T low = box.low[axis] - ray.origin[axis] - ray.slack;
        const T high = box.high[axis] - ray.origin[axis] + ray.slack;
        const T first = (back ? high : low) * ray.inverse[axis];
        const T last = (back ? low : high) * ray.inverse[axis];
        if (first > t_min) t_min = first;
        if (last < t_max) t_max = last;
    }
    if (!(t_min <= t_max)) return std::nullopt;
    return t_min;
}
// [slabs]

/// \}

} // namespace ljus
