#pragma once

/// \file ljus/geometry/box.hpp
/// \brief Boxes along the axes, and whether a ray meets them.

#include <array>
#include <cmath>
#include <concepts>
#include <limits>
#include <optional>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup box Boxes
/// \brief Discussion: "axis-aligned bounding boxes". Chapter: \ref ch_bvh.
/// \{

/// All points between two corners. Without values: the box around nothing.
template <std::floating_point T>
struct BoxT {
    Vec3T<T> low{std::numeric_limits<T>::infinity()}; ///< The corner of least x, y, z.
    Vec3T<T> high{-std::numeric_limits<T>::infinity()}; ///< The corner across.
};
using Box = BoxT<float>; ///< BoxT in float.

/// The box around two boxes.
template <std::floating_point T>
[[nodiscard]] constexpr BoxT<T> box_union(const BoxT<T>& a, const BoxT<T>& b) noexcept {
    return {glm::min(a.low, b.low), glm::max(a.high, b.high)};
}

/// The box around a box and a point.
template <std::floating_point T>
[[nodiscard]] constexpr BoxT<T> box_union(const BoxT<T>& a,
                                          const Vec3T<T>& point) noexcept {
    return {glm::min(a.low, point), glm::max(a.high, point)};
}

namespace detail {

/// A ray, made ready for many boxes.
template <std::floating_point T>
struct BoxRayT {
    Vec3T<T> origin{T(0)};  ///< O.
    Vec3T<T> inverse{T(1)}; ///< 1 / D; infinite along an axis it runs across.
    std::array<bool, 3>
        is_negative{}; ///< The sign of `inverse`, which tells -0 from 0.
    T slack = T(0); ///< By how much every box is larger than it says, in scene units.
};

/// Makes a ray ready for boxes.
///
/// A tree must not lose what a shape's own test finds, and both are rounded: by the
/// size of the coordinates as seen from the ray's origin. So the boxes grow by 16 units
/// of roundoff of that size: more than the 3 that the slabs need \cite ize2013, for the
/// shape's test needs them too.
/// \param ray  The ray.
/// \param all  A box around all boxes that the ray will be asked about.
/// \return The ray; nothing if its direction is too long or too short, or its origin
///         too far away, for numbers of this precision: then ask the shapes themselves.
// [box_ray]
template <std::floating_point T>
[[nodiscard]] std::optional<BoxRayT<T>> box_ray(const RayT<T>& ray,
                                                const BoxT<T>& all) noexcept {
    using Limits = std::numeric_limits<T>;
    const T reach = max_component(
        glm::max(sizes(all.low - ray.origin), sizes(all.high - ray.origin)));
    const T length = max_component(sizes(ray.direction));
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

/// Where a ray enters a box: between the planes that it meets first and those that it
/// meets last, chosen by the signs of the inverse direction \cite williams2005.
///
/// A ray in the plane of a side has \f$ 0 \cdot \infty \f$ there, NaN; the comparisons
/// are written so that such an axis does not count.
/// \param ray    Of box_ray().
/// \param box    The box.
/// \param t_min  Start of the range that counts.
/// \param t_max  Its end.
/// \return The first t of the range that lies in the box; nothing for a miss, or if the
///         range is NaN.
// [enter]
template <std::floating_point T>
[[nodiscard]] std::optional<T> enter(const BoxRayT<T>& ray, const BoxT<T>& box, T t_min,
                                     T t_max) noexcept {
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
// [enter]

} // namespace detail

/// \}

} // namespace ljus
