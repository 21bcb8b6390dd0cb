#pragma once

/// \file ljus/geometry/watertight.hpp
/// \brief A ray-triangle test that lets no ray pass between two adjacent triangles.

#include <limits>
#include <optional>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"

namespace ljus {

/// \defgroup watertight Watertight triangles
/// \brief Section 3.1.5 of the report: the ray-triangle intersection, with a guarantee
/// for shared edges. Chapter: \ref ch_triangle.
/// \{

/// Selects the watertight test for triangles: `intersect<Watertight>(ray, triangle)`.
/// Loops and trees accept Watertight in place of a precision. Spheres are then
/// intersected in their usual precision, and quads in double.
struct Watertight {};

namespace detail {

/// The shear that maps a ray's direction D to the z axis, after an exchange of axes.
template <std::floating_point T>
struct ShearT {
    int x = 0;   ///< The axis that becomes x.
    int y = 1;   ///< The axis that becomes y.
    int z = 2;   ///< The axis of the direction's largest component.
    T sx = T(0); ///< The shear along x: \f$ D_x / D_z \f$, in [-1, 1].
    T sy = T(0); ///< The shear along y: \f$ D_y / D_z \f$, in [-1, 1].
    /// The scale along z: \f$ 1 / D_z \f$, which may exceed the range of T.
    double sz = 1;
};

} // namespace detail

/// Computes the shear that maps a ray to the z axis. If the ray's direction is zero,
/// NaN or infinite, the shear makes every test a miss.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] detail::ShearT<T> prepare(const RayT<T>& ray) noexcept {
    const Vec3T<T> size = detail::sizes(ray.direction);
    const int z = size.x > size.y ? (size.x > size.z ? 0 : 2) : size.y > size.z ? 1 : 2;
    const int x = z == 2 ? 0 : z + 1, y = x == 2 ? 0 : x + 1;
    const T* const d = &ray.direction.x;
    return {.x = x,
            .y = y,
            .z = z,
            .sx = d[x] / d[z],
            .sy = d[y] / d[z],
            .sz = 1 / static_cast<double>(d[z])};
}
/// Intersects a ray with a triangle so that no ray passes between adjacent triangles. A
/// ray at a common edge hits at least one of its two triangles. A ray at a common
/// vertex hits at least one of the triangles around the vertex.
///
/// The shear of prepare() maps the ray to the z axis. The projected triangle contains
/// the origin if \f$ P_x Q_y - P_y Q_x \f$ has the same sign for all three edges from P
/// to Q. A vertex is rounded in the same way in all its triangles. The products of two
/// floats are exact in double, so that the sign is exact. Triangles that share vertices
/// and have exact signs leave no gap \cite woop2013.
/// \return The distance t, and the barycentric coordinates u and v. Nothing for a miss,
///         a triangle without an area, or a non-finite input.
/// \cost 6 products for most misses; a hit needs 6 more for its edges, one division,
///       and 7 products for t, u and v.
/// \report{Section 3.1.5}
// [intersect]
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>>
intersect(const RayT<T>& ray, const TriangleT<T>& triangle,
          const detail::ShearT<T>& shear) noexcept {
    // Products of two floats are exact; those of two doubles are rounded.
    using W = std::conditional_t<std::is_same_v<T, float>, double, long double>;
    const T* const o = &ray.origin.x;
    const auto corner = [&](const Vec3T<T>& vertex) {
        const T* const p = &vertex.x;
        const T x = p[shear.x] - o[shear.x];
        const T y = p[shear.y] - o[shear.y];
        const T z = p[shear.z] - o[shear.z];
        return Vec3T<T>(static_cast<T>(W(x) - W(shear.sx) * W(z)),
                        static_cast<T>(W(y) - W(shear.sy) * W(z)), z);
    };
    const Vec3T<T> a = corner(triangle.v1), b = corner(triangle.v2),
                   c = corner(triangle.v3);
    // Most triangles lie beside the axis in x or in y.
    const Vec3T<T> low = glm::min(a, glm::min(b, c)),
                   high = glm::max(a, glm::max(b, c));
    if (low.x > 0 || low.y > 0 || high.x < 0 || high.y < 0) return std::nullopt;

    const auto edge = [](const Vec3T<T>& p, const Vec3T<T>& q) {
        return W(p.x) * W(q.y) - W(p.y) * W(q.x); // edge(q, p) is exactly -edge(p, q)
    };
    const W u = edge(a, c), v = edge(b, a), w = edge(c, b);
    // NaN is a miss; a point on an edge is inside.
    if (!((u >= 0 && v >= 0 && w >= 0) || (u <= 0 && v <= 0 && w <= 0)))
        return std::nullopt;

    const W inverse = W(1) / (u + v + w); // infinite without an area
    const W t = (w * W(a.z) + u * W(b.z) + v * W(c.z)) * inverse * W(shear.sz);
    constexpr W max{std::numeric_limits<T>::max()};
    if (!(W(ray.t_min) <= t && t <= W(ray.t_max) && t <= max && shear.sz != 0))
        return std::nullopt;
    // Shear and rounding may give collinear corners an area.
    if (!has_area(triangle)) return std::nullopt;
    return ShapeHitT<T>{static_cast<T>(t), static_cast<T>(u * inverse),
                        static_cast<T>(v * inverse), 0};
}
// [intersect]

// Hidden, because Doxygen would confuse these two with the overloads for a precision.
/// \cond
// For a single triangle. Each call prepares the ray, which costs two divisions.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>>
intersect(const RayT<T>& ray, const TriangleT<T>& triangle) noexcept {
    return intersect<Test>(ray, triangle, prepare<Test>(ray));
}

// The common edge of two quads is rounded differently in each quad, so that no test can
// close the gap between them. In double the gap is as small as possible.
template <std::same_as<Watertight> Test, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>> intersect(const RayT<T>& ray,
                                                    const QuadT<T>& quad) noexcept {
    return intersect<WideT<T>>(ray, quad);
}
/// \endcond

/// \}

} // namespace ljus
