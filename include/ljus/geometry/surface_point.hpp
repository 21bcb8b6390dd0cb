#pragma once

/// \file ljus/geometry/surface_point.hpp
/// \brief Points on surfaces: their rounding error, the rays that leave them, and the
/// hit of a ray on a flat shape.

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup surface Leaving a surface
/// \brief Rounding moves a hit point slightly to one side of its surface. Chapter:
/// \ref ch_ray.
/// \{

/// A point of a surface.
template <std::floating_point T>
struct SurfacePointT {
    Vec3T<T> position{T(0)}; ///< The position, in scene units.
    Vec3T<T> error{T(0)};    ///< Bound on the rounding error of each coordinate.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Geometric unit normal; points outwards.
    T tilt = T(0); ///< On a flat shape in double, how much its test magnifies rounding
                   ///< errors; see detail::add_tilt(). Otherwise 0.
};
using SurfacePoint = SurfacePointT<float>; ///< SurfacePointT in float.

namespace detail {

/// Copies a point component by component. A processor that has just stored single
/// components would stall if it had to load several of them at once.
template <std::floating_point T>
inline void set_point(SurfacePointT<T>& to, const SurfacePointT<T>& from) noexcept {
    const auto set = [](Vec3T<T>& a, const Vec3T<T>& b) {
        a.x = b.x;
        a.y = b.y;
        a.z = b.z;
    };
    set(to.position, from.position);
    set(to.error, from.error);
    set(to.normal, from.normal);
    to.tilt = from.tilt;
}

/// Adds the tilt of a flat shape's plane to the error of a point on the shape. Because
/// of rounding, the next intersection test sees the plane tilted.
///
/// The sign of \f$ T \cdot (E_1 \times E_2) \f$ tells on which side of the plane a
/// point lies. E_1 and E_2 are the edges, and T is the vector from a corner to the
/// point. This sum of products has 9 roundings. No term exceeds
/// \f$ \|T\|\,\|E_1\|\,\|E_2\| \f$, where \f$ \|X\| = |X_x| + |X_y| + |X_z| \f$.
/// Division by the Euclidean length of the cross product gives a height above the
/// plane, with the error
/// \f[ \gamma_9 \|T\| \, \frac{\|E_1\|\,\|E_2\|}{|E_1 \times E_2|} , \f]
/// where \f$ \gamma_9 \f$ is rounding_bound(9). The fraction is the tilt: 1 to 3 for a
/// square, and larger for edges that are nearly parallel. For float the function does
/// nothing, because the test computes in double.
// [add_tilt]
template <std::floating_point T>
void add_tilt(SurfacePointT<T>& point, const Vec3T<T>& e1,
              const Vec3T<T>& e2) noexcept {
    if constexpr (sizeof(WideT<T>) == sizeof(T)) {
        const Vec3T<T> up = glm::cross(e1, e2);
        const T tilt = size_of(e1) * size_of(e2) / std::sqrt(glm::dot(up, up));
        if (!std::isfinite(tilt)) return;
        point.tilt = tilt;
        point.error += rounding_bound<T>(9) * (size_of(e1) + size_of(e2)) * tilt;
    }
}
// [add_tilt]

/// Whether two edges define a normal: whether a component of their cross product
/// exceeds its rounding error. The edges must be in double, with lengths between 1e-150
/// and 1e150.
template <std::floating_point W>
[[nodiscard]] bool span_area(const Vec3T<W>& a, const Vec3T<W>& b) noexcept {
    constexpr W bound = W(1.75) * std::numeric_limits<W>::epsilon();
    const auto differ = [](W p, W q) {
        return std::abs(p - q) > bound * (std::abs(p) + std::abs(q));
    };
    return differ(a.y * b.z, a.z * b.y) || differ(a.z * b.x, a.x * b.z) ||
           differ(a.x * b.y, a.y * b.x);
}

/// The distance from a surface at which offset_ray_origin() puts the origin of a ray,
/// in scene units.
// [leaving_distance]
template <std::floating_point T>
[[nodiscard]] inline T leaving_distance(const SurfacePointT<T>& point) noexcept {
    const T scale = max_component(sizes(point.position) + point.error);
    const T last_place = glm::max(scale * std::numeric_limits<T>::epsilon(),
                                  std::numeric_limits<T>::min());
    return T(2) * glm::dot(sizes(point.normal), point.error) + T(4) * last_place;
}
// [leaving_distance]

} // namespace detail

/// The origin of a ray that leaves a surface. It is on the side to which `direction`
/// points, and as close to the surface as rounding permits. `direction` may have any
/// length.
///
/// The offset along the normal is twice the point's error along the normal, plus 4
/// units in the last place of its largest coordinate. The fixed offsets of the report's
/// program are too long for a small scene and too short far from the origin.
///
/// In double, a ray that leaves a flat shape may hit the shape again if its angle to
/// the plane is below about 20 units of roundoff times the point's `tilt`.
/// \report{Definition 3.1}
// [offset_ray_origin]
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> offset_ray_origin(const SurfacePointT<T>& point,
                                                const Vec3T<T>& direction) noexcept {
    const Vec3T<T>& n = point.normal;
    const T distance = detail::leaving_distance(point);
    return point.position + std::copysign(distance, glm::dot(direction, n)) * n;
}
// [offset_ray_origin]

/// A ray that leaves a surface and does not hit the surface again where it starts. Its
/// t_max is infinite.
template <std::floating_point T>
[[nodiscard]] RayT<T> spawn_ray(const SurfacePointT<T>& point,
                                const Vec3T<T>& direction, T time = T(0)) noexcept {
    return {.origin = offset_ray_origin(point, direction),
            .direction = direction,
            .time = time};
}

/// A ray from one surface point to another. It hits neither surface at its ends.
///
/// The rounding error of a hit grows with the length of the ray. The ray stops before
/// its target by this error, because a lamp could otherwise shadow itself.
/// \return The ray. Its direction is the vector from its origin to its end, at t = 1.
// [spawn_ray_to]
template <std::floating_point T>
[[nodiscard]] RayT<T> spawn_ray_to(const SurfacePointT<T>& from,
                                   const SurfacePointT<T>& to, T time = T(0)) noexcept {
    const Vec3T<T> way = to.position - from.position;
    SurfacePointT<T> seen;
    detail::set_point(seen, to);
    seen.error += detail::rounding_bound<T>(8) * max_component(detail::sizes(way));
    if constexpr (sizeof(WideT<T>) == sizeof(T))
        seen.error += detail::rounding_bound<T>(18) * detail::size_of(way) * to.tilt;
    const Vec3T<T> origin = offset_ray_origin(from, way);
    return {.origin = origin,
            .direction = offset_ray_origin(seen, -way) - origin,
            .t_max = T(1),
            .time = time};
}
// [spawn_ray_to]

/// \}

/// \addtogroup triangle
/// \{

namespace detail {

/// A bound on the rounding errors of u, v and u + v in moller_trumbore().
///
/// The numerators of u and v are sums of products with at most 8 roundings. No term
/// exceeds \f$ |D|\,|E|\,|T| \f$ for the ray's direction D, an edge E and the vector T
/// from the corner to the ray's origin, where |X| is \f$ |X_x| + |X_y| + |X_z| \f$.
/// \return The bound, dimensionless; 0 if the bound would be larger than the argument
///         `most`.
// [border]
template <std::floating_point C>
[[nodiscard]] C border_of_rounding(const Vec3T<C>& d, const Vec3T<C>& to,
                                   const Vec3T<C>& e1, const Vec3T<C>& e2, C inverse,
                                   C most) noexcept {
    const C largest = size_of(d) * size_of(to) * (size_of(e1) + size_of(e2));
    const C border = rounding_bound<C>(16) * largest * std::abs(inverse);
    return border <= most ? border : C(0);
}
// [border]

} // namespace detail

/// The figure that two edges span from a corner.
enum class Spanned : std::uint8_t {
    triangle,     ///< A triangle: u and v are at least 0, and u + v is at most 1.
    parallelogram ///< A parallelogram: u and v are in [0, 1].
};

/// Solves \f$ O + tD = V_1 + uE_1 + vE_2 \f$ by Cramer's rule, for the ray O + tD, the
/// corner V_1 and the edges E_1 and E_2.
///
/// With \f$ T = O - V_1 \f$, \f$ P = D \times E_2 \f$ and \f$ Q = T \times E_1 \f$:
/// \f[ t = \frac{Q \cdot E_2}{P \cdot E_1}, \quad u = \frac{P \cdot T}{P \cdot E_1},
///     \quad v = \frac{Q \cdot D}{P \cdot E_1} \f]
///
/// A determinant \f$ P \cdot E_1 \f$ that is 0 or overflows gives a miss.
///
/// At the common edge of two triangles, their rounding errors differ. If the arithmetic
/// is wider than the data, each shape therefore has a border as wide as its rounding
/// error, so that a ray hits at least one of the two. The border is omitted if it would
/// be wider than the rounding of the data.
/// \tparam Compute  The precision of the arithmetic; results are rounded to T once. In
///                  float, shapes and distances must be between 1e-15 and 1e15.
/// \return The distance t and the coordinates u and v; nothing for a miss or a
///         non-finite input.
/// \cost One division, 23 multiplications, and 6 more for t \cite moller1997.
/// \report{Section 3.1.5}
/// \erratum{The report omits u, v and the conditions on them. Without these conditions
///          every ray that crosses the plane hits.}
// [moller_trumbore]
template <Spanned shape, typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>>
moller_trumbore(const RayT<T>& ray, const Vec3T<ComputeT<Compute, T>>& v1,
                const Vec3T<ComputeT<Compute, T>>& e1,
                const Vec3T<ComputeT<Compute, T>>& e2) noexcept {
    using C = ComputeT<Compute, T>;
    const Vec3T<C> d{ray.direction};
    const Vec3T<C> to = Vec3T<C>{ray.origin} - v1;
    const Vec3T<C> p = glm::cross(d, e2);
    const C inverse = C(1) / glm::dot(p, e1);
    const C u = glm::dot(p, to) * inverse;
    constexpr bool closed = sizeof(C) > sizeof(T);
    // The border is no wider than the rounding of the data. Otherwise points beside the
    // shape would be hits.
    constexpr C near = closed ? C(std::numeric_limits<T>::epsilon()) : C(0);
    if (!(u >= -near && u <= C(1) + near)) return std::nullopt; // most rays miss here

    const Vec3T<C> q = glm::cross(to, e1);
    const C v = glm::dot(q, d) * inverse;
    // NaN is a miss.
    const auto within = [&](C border) {
        if (!(u >= -border)) return false;
        if (shape == Spanned::triangle) return v >= -border && u + v <= C(1) + border;
        return u <= C(1) + border && v >= -border && v <= C(1) + border;
    };
    if (!(within(near) && inverse != C(0))) return std::nullopt;

    // dot(q, e2) is the cube of a length, and would overflow in float earlier.
    const C t = glm::dot(inverse * q, e2);
    constexpr C max{std::numeric_limits<T>::max()};
    if (!(C(ray.t_min) <= t && t <= C(ray.t_max) && t <= max)) return std::nullopt;
    // The border comes last, because few hits are close enough to an edge to need it.
    if (closed && !within(C(0)) &&
        !within(detail::border_of_rounding(d, to, e1, e2, inverse, near)))
        return std::nullopt;
    return ShapeHitT<T>{static_cast<T>(t), static_cast<T>(glm::max(u, C(0))),
                        static_cast<T>(glm::max(v, C(0))), 0};
}
// [moller_trumbore]

/// \}

} // namespace ljus
