#pragma once

/// \file ljus/geometry/surface_point.hpp
/// \brief A point of a surface, how well it is known, and how a ray leaves it.

#include <cmath>
#include <limits>

#include "ljus/geometry/ray.hpp"

namespace ljus {

/// \defgroup surface Leaving a surface
/// \brief A hit point is rounded: it lies a little in front of its surface or behind
/// it. Chapter: \ref ch_ray.
/// \{

/// A point of a surface.
template <std::floating_point T>
struct SurfacePointT {
    Vec3T<T> position{T(0)};           ///< In scene units.
    Vec3T<T> error{T(0)};              ///< Bound of the rounding of each coordinate.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit, geometric, on the outer side.
    T tilt = T(0); ///< By how many roundoffs a test may turn its plane: that of
                   ///< detail::add_tilt(), or 0.
};
using SurfacePoint = SurfacePointT<float>; ///< SurfacePointT in float.

namespace detail {

/// Sets a point to another, number by number: a processor waits for a copy of what has
/// just been written if the copy is made in wider pieces.
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

/// The relative error of n roundings in a row, n u / (1 - n u).
/// \tparam T  The precision; u is its unit roundoff.
/// \param n   How many roundings, at least 0.
/// \return The bound, without a unit.
template <std::floating_point T>
[[nodiscard]] constexpr T rounding_bound(int n) noexcept {
    const T nu = T(n) * std::numeric_limits<T>::epsilon() / T(2);
    return nu / (T(1) - nu);
}

/// The sum of the sizes of the components.
template <std::floating_point T>
[[nodiscard]] T size_of(const Vec3T<T>& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

/// Adds to a point of a flat shape how far the next test of the same shape may see its
/// plane from where it is.
///
/// On which side of the plane a point lies that is at T from the corner is the sign of
/// \f$ T \cdot (E_1 \times E_2) \f$: a sum of products with 9 roundings on the way,
/// none larger than \f$ |T|\,|E_1|\,|E_2| \f$ with
/// \f$ |X| = |X_x| + |X_y| + |X_z| \f$. Over twice the area that is a height,
/// \f[ \gamma_9 |T| \, \frac{|E_1|\,|E_2|}{|E_1 \times E_2|} . \f]
/// The quotient, the tilt, is 1 to 3 for a square; for two edges at a small angle it is
/// 1 over its sine: the plane of a sliver is known badly. Where the arithmetic is wider
/// than the data, as for float, it does not matter and nothing is added.
/// \param point  Of the shape; gets its tilt and a larger error.
/// \param e1     An edge.
/// \param e2     Another one; of parallel ones, which no ray meets, nothing is added.
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

/// Whether two edges span an area, and so have a normal; one that rounding may have
/// made of none does not count. An edge between doubles is one rounding off, a product
/// another, or none if it is fused with the subtraction: together 3 units of roundoff.
/// \param a, b  The edges, in double; lengths between 1e-150 and 1e150.
/// \return False for parallel ones, and for those whose sine is below 1e-15.
template <std::floating_point W>
[[nodiscard]] bool span_area(const Vec3T<W>& a, const Vec3T<W>& b) noexcept {
    constexpr W bound = W(1.75) * std::numeric_limits<W>::epsilon();
    const auto differ = [](W p, W q) {
        return std::abs(p - q) > bound * (std::abs(p) + std::abs(q));
    };
    return differ(a.y * b.z, a.z * b.y) || differ(a.z * b.x, a.x * b.z) ||
           differ(a.x * b.y, a.y * b.x);
}

} // namespace detail

/// The origin of a ray that leaves a surface: safely on the side the direction points
/// to, and no farther from the surface than its rounding asks for.
///
/// A fixed distance (the report's program has four, from 0.0001 to 0.1) is too long for
/// a small scene and too short far from the origin. Here the distance is twice the
/// error of the point, along the normal, and 4 units in the last place of its largest
/// coordinate for the rounding of the sum. A point of a wall through the origin may
/// have no coordinate but 0: then the error in the wall's plane gives the scale.
///
/// A ray in double that leaves a flat shape does not meet it again if its angle with
/// the plane is above some 20 roundoffs times the tilt: 2e-9 for a sliver of 1 to 1e-6.
/// Below that double cannot tell on which side of the plane the ray goes.
///
/// \param point      A point of the surface, with its error.
/// \param direction  Where the ray goes; its length does not matter.
/// \return A point on the side of `direction`.
/// \report{Definition 3.1}
// [offset_ray_origin]
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> offset_ray_origin(const SurfacePointT<T>& point,
                                                const Vec3T<T>& direction) noexcept {
    const Vec3T<T>& n = point.normal;
    const T scale = max_component(detail::sizes(point.position) + point.error);
    const T last_place = glm::max(scale * std::numeric_limits<T>::epsilon(),
                                  std::numeric_limits<T>::min());
    const T distance =
        T(2) * glm::dot(detail::sizes(n), point.error) + T(4) * last_place;
    return point.position + std::copysign(distance, glm::dot(direction, n)) * n;
}
// [offset_ray_origin]

/// A ray that leaves a surface for good.
/// \param point      Where it starts.
/// \param direction  Its direction.
/// \param time       In [0, 1].
/// \return The ray, its range open to infinity.
template <std::floating_point T>
[[nodiscard]] RayT<T> spawn_ray(const SurfacePointT<T>& point,
                                const Vec3T<T>& direction, T time = T(0)) noexcept {
    return {.origin = offset_ray_origin(point, direction),
            .direction = direction,
            .time = time};
}

/// A ray between two points of surfaces that touches neither surface.
///
/// The farther the way, the less is known of where it meets its end: the arithmetic of
/// an intersection is rounded by the length of the way. Without that, a lamp close to
/// the origin of the scene shades itself from afar.
/// \param from  Where it starts.
/// \param to    Where it ends, at t = 1.
/// \param time  In [0, 1].
/// \return The ray; its direction has the length of the way.
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

} // namespace ljus
