#pragma once

/// \file ljus/geometry/triangle.hpp
/// \brief The triangle: its intersection with a ray (Moeller and Trumbore), and
/// sampling.

#include <array>
#include <cmath>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/facet.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup triangle Triangles
/// \brief Section 3.1.5 of the report: the ray-triangle intersection. Chapter:
/// \ref ch_triangle.
/// \{

/// Three vertices. They turn counter-clockwise as seen from the side to which the
/// normal points.
/// \report{Definition 3.3}
/// \erratum{The report's triple is unordered, which leaves the normal's side
/// undefined.}
template <std::floating_point T>
struct TriangleT {
    Vec3T<T> v1{T(0)}; ///< The vertex \f$V_1\f$, in scene units.
    Vec3T<T> v2{T(0)}; ///< The vertex \f$V_2\f$, in scene units.
    Vec3T<T> v3{T(0)}; ///< The vertex \f$V_3\f$, in scene units.
};
using Triangle = TriangleT<float>; ///< TriangleT in float.

namespace detail {

/// The normal of a triangle times twice its area. It is in double, because in float the
/// normal of a thin triangle would be inaccurate.
template <std::floating_point T>
[[nodiscard]] Vec3T<WideT<T>> cross_of_edges(const TriangleT<T>& triangle) noexcept {
    const Vec3T<WideT<T>> v1{triangle.v1};
    return glm::cross(Vec3T<WideT<T>>{triangle.v2} - v1,
                      Vec3T<WideT<T>>{triangle.v3} - v1);
}

} // namespace detail

/// Whether a triangle has an area that is more than a rounding error in double. A
/// triangle without an area is never hit and has no normal.
template <std::floating_point T>
[[nodiscard]] bool has_area(const TriangleT<T>& triangle) noexcept {
    const Vec3T<WideT<T>> v1{triangle.v1};
    return detail::span_area(Vec3T<WideT<T>>{triangle.v2} - v1,
                             Vec3T<WideT<T>>{triangle.v3} - v1);
}

/// Intersects a ray with a triangle.
/// \tparam Compute  The precision of the arithmetic; by default double, with which no
///                  ray passes between two adjacent triangles. intersect<float>() is
///                  the report's formula, which misses some rays aimed at edges.
/// \return The distance t, and the barycentric coordinates u and v of the hit
///         \f$(1-u-v)V_1 + uV_2 + vV_3\f$. Nothing for a miss, or for a triangle
///         without an area.
/// \report{Section 3.1.5}
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>>
intersect(const RayT<T>& ray, const TriangleT<T>& triangle) noexcept {
    using C = ComputeT<Compute, WideT<T>>;
    const Vec3T<C> v1{triangle.v1};
    auto hit = moller_trumbore<Spanned::triangle, C>(
        ray, v1, Vec3T<C>{triangle.v2} - v1, Vec3T<C>{triangle.v3} - v1);
    // Rounding may give collinear corners an area.
    if (hit && !has_area(triangle)) hit.reset();
    return hit;
}

/// The unit normal of a triangle, whose area must not be 0.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> normal(const TriangleT<T>& triangle) noexcept {
    return Vec3T<T>(glm::normalize(detail::cross_of_edges(triangle)));
}

/// The area of a triangle, in squared scene units.
template <std::floating_point T>
[[nodiscard]] T area(const TriangleT<T>& triangle) noexcept {
    return static_cast<T>(glm::length(detail::cross_of_edges(triangle)) / 2);
}

/// The point of a triangle with the barycentric coordinates u and v, the weights of the
/// second and the third vertex. `normal` must be the result of normal(triangle).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> point_at(const TriangleT<T>& triangle, T u, T v,
                                        const Vec3T<T>& normal) noexcept {
    const Vec3T<T> a = (T(1) - u - v) * triangle.v1;
    const Vec3T<T> b = u * triangle.v2;
    const Vec3T<T> c = v * triangle.v3;
    SurfacePointT<T> point{.position = a + b + c,
                           .error =
                               detail::rounding_bound<T>(7) *
                               (detail::sizes(a) + detail::sizes(b) + detail::sizes(c)),
                           .normal = normal};
    detail::add_tilt(point, triangle.v2 - triangle.v1, triangle.v3 - triangle.v1);
    return point;
}

/// The point of a triangle at u and v. The function calls normal(triangle).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> point_at(const TriangleT<T>& triangle, T u,
                                        T v) noexcept {
    return point_at(triangle, u, v, normal(triangle));
}

/// Samples a point of a triangle uniformly, with the density 1 / area per squared scene
/// unit. `normal` must be the result of normal(triangle).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const TriangleT<T>& triangle,
                                           const Vec2T<T>& u,
                                           const Vec3T<T>& normal) noexcept {
    const T root = std::sqrt(u.x);
    return point_at(triangle, T(1) - root, u.y * root, normal);
}

/// Samples a point of a triangle uniformly. The function calls normal(triangle).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const TriangleT<T>& triangle,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(triangle, u, normal(triangle));
}

/// The point of a triangle at the u and v of a hit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const TriangleT<T>& triangle,
                                             const RayT<T>& /*ray*/,
                                             const ShapeHitT<T>& hit) noexcept {
    return point_at(triangle, hit.u, hit.v);
}

/// The corners of a triangle, counter-clockwise around its normal.
template <std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 3>
corners_of(const TriangleT<T>& triangle) noexcept {
    return {triangle.v1, triangle.v2, triangle.v3};
}

/// A triangle as a facet, whose front is on the side of the normal.
template <std::floating_point T>
[[nodiscard]] Facet facet_of(const TriangleT<T>& triangle) noexcept {
    return {{glm::dvec3(triangle.v1), glm::dvec3(triangle.v2), glm::dvec3(triangle.v3)},
            3};
}

/// A sphere around a triangle.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const TriangleT<T>& triangle) noexcept {
    const Vec3T<T> center = (triangle.v1 + triangle.v2 + triangle.v3) / T(3);
    return {.center = center,
            .radius = max_component(Vec3T<T>{glm::distance(center, triangle.v1),
                                             glm::distance(center, triangle.v2),
                                             glm::distance(center, triangle.v3)})};
}

/// The smallest box around a triangle, without a rounding error.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const TriangleT<T>& triangle) noexcept {
    return {glm::min(glm::min(triangle.v1, triangle.v2), triangle.v3),
            glm::max(glm::max(triangle.v1, triangle.v2), triangle.v3)};
}

/// The texture tangents of a triangle: the two edges at its first vertex.
template <std::floating_point T>
[[nodiscard]] constexpr std::array<Vec3T<T>, 2>
texture_tangents(const TriangleT<T>& triangle, const ShapeHitT<T>& /*hit*/) noexcept {
    return {triangle.v2 - triangle.v1, triangle.v3 - triangle.v1};
}

/// A triangle displaced by a vector, in scene units.
template <std::floating_point T>
[[nodiscard]] constexpr TriangleT<T> translated(const TriangleT<T>& shape,
                                                const Vec3T<T>& by) noexcept {
    return {.v1 = shape.v1 + by, .v2 = shape.v2 + by, .v3 = shape.v3 + by};
}

/// Refuses a triangle if a vertex is not finite.
/// \throws std::invalid_argument  with the name and the value of the vertex.
template <std::floating_point T>
void check(const TriangleT<T>& triangle) {
    require_finite("triangle.v1", triangle.v1);
    require_finite("triangle.v2", triangle.v2);
    require_finite("triangle.v3", triangle.v3);
}

/// \}

} // namespace ljus
