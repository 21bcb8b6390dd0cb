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
/// \brief Discussion: "axis-aligned bounding boxes". Chapter: \ref ch_bvh.
/// \{

/// An axis-aligned box, given by two opposite corners. By default it is empty.
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

/// A ray with the reciprocals that the test of many boxes shares.
template <std::floating_point T>
struct BoxRayT {
    Vec3T<T> origin{T(0)};             ///< O.
    Vec3T<T> inverse{T(1)};            ///< 1 / D; infinite where D is 0.
    std::array<bool, 3> is_negative{}; ///< Sign of `inverse`; -0 counts as negative.
    T slack = T(0); ///< Margin added to all sides of each box, in scene units.
};

/// Prepares a ray for intersection with many boxes.
///
/// A tree must find every hit that the shape's own test finds. The rounding of both
/// tests is proportional to the coordinates relative to the ray's origin. Each box
/// therefore grows by 16 roundoffs of that size; the slabs alone need 3 \cite ize2013.
/// \param ray  Its direction may have any length but zero; its range is ignored.
/// \param all  A box around all boxes to be tested.
/// \return The prepared ray; nothing if the length of its direction or the distance to
///         `all` exceeds the range of T. Then test the shapes themselves.
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

/// Finds where a ray enters a box: after the near plane and before the far plane of
/// each axis. The signs of the inverse direction tell near from far \cite williams2005.
///
/// A ray that lies in the plane of a side gives \f$ 0 \cdot \infty \f$, which is NaN;
/// the comparisons ignore such an axis.
/// \param ray    Of box_ray().
/// \param box    One of the boxes.
/// \param t_min  First t of the ray, in units of the direction's length.
/// \param t_max  Last t.
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
