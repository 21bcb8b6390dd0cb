#pragma once

/// \file ljus/geometry/quad.hpp
/// \brief The parallelogram, for lamps and walls.

#include <array>
#include <limits>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/facet.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup quad Quads
/// \brief Section 3.1.5 of the report: the intersection test of triangles, with other
/// bounds for u and v. One test replaces those of two triangles, with no gap along a
/// diagonal.
/// \{

/// The points \f$ V_1 + uE_1 + vE_2 \f$ with u and v in [0, 1].
template <std::floating_point T>
struct QuadT {
    Vec3T<T> corner{T(0)};             ///< The corner \f$V_1\f$, in scene units.
    Vec3T<T> edge_u{T(1), T(0), T(0)}; ///< The edge \f$E_1\f$, in scene units.
    Vec3T<T> edge_v{T(0), T(1), T(0)}; ///< The edge \f$E_2\f$, in scene units.
};
using Quad = QuadT<float>; ///< QuadT in float.

namespace detail {

/// The normal of a quad times its area, in double.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<WideT<T>> cross_of_edges(const QuadT<T>& quad) noexcept {
    return glm::cross(Vec3T<WideT<T>>{quad.edge_u}, Vec3T<WideT<T>>{quad.edge_v});
}

} // namespace detail

/// Whether a quad has an area that is more than a rounding error in double. A quad
/// without an area is never hit and has no normal.
template <std::floating_point T>
[[nodiscard]] bool has_area(const QuadT<T>& quad) noexcept {
    return detail::span_area(Vec3T<WideT<T>>{quad.edge_u},
                             Vec3T<WideT<T>>{quad.edge_v});
}

/// Intersects a ray with a quad.
/// \tparam Compute  The precision of the arithmetic; by default double.
/// \return The distance t, and the coordinates u and v along the edges, in [0, 1].
///         Nothing for a miss, or for a quad without an area.
/// \report{Section 3.1.5}
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>> intersect(const RayT<T>& ray,
                                                    const QuadT<T>& quad) noexcept {
    using C = ComputeT<Compute, WideT<T>>;
    auto hit = moller_trumbore<Spanned::parallelogram, C>(
        ray, Vec3T<C>{quad.corner}, Vec3T<C>{quad.edge_u}, Vec3T<C>{quad.edge_v});
    if (hit && !has_area(quad)) hit.reset();
    return hit;
}

/// The unit normal of a quad, along the cross product of the edges. The area must not
/// be 0.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> normal(const QuadT<T>& quad) noexcept {
    return Vec3T<T>(glm::normalize(detail::cross_of_edges(quad)));
}

/// The area of a quad, in squared scene units.
template <std::floating_point T>
[[nodiscard]] inline T area(const QuadT<T>& quad) noexcept {
    return static_cast<T>(glm::length(detail::cross_of_edges(quad)));
}

/// The point of a quad at the coordinates u and v along the edges, with an error bound.
/// `normal` must be the result of normal(quad).
template <std::floating_point T>
[[nodiscard]] inline SurfacePointT<T> point_at(const QuadT<T>& quad, T u, T v,
                                               const Vec3T<T>& normal) noexcept {
    const Vec3T<T> b = u * quad.edge_u;
    const Vec3T<T> c = v * quad.edge_v;
    SurfacePointT<T> point{
        .position = quad.corner + b + c,
        .error = detail::rounding_bound<T>(5) *
                 (detail::sizes(quad.corner) + detail::sizes(b) + detail::sizes(c)),
        .normal = normal};
    detail::add_tilt(point, quad.edge_u, quad.edge_v);
    return point;
}

/// The point of a quad at u and v. The function calls normal(quad).
template <std::floating_point T>
[[nodiscard]] inline SurfacePointT<T> point_at(const QuadT<T>& quad, T u,
                                               T v) noexcept {
    return point_at(quad, u, v, normal(quad));
}

/// Samples a point of a quad uniformly, with the density 1 / area per squared scene
/// unit. `normal` must be the result of normal(quad).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const QuadT<T>& quad, const Vec2T<T>& u,
                                           const Vec3T<T>& normal) noexcept {
    return point_at(quad, u.x, u.y, normal);
}

/// Samples a point of a quad uniformly. The function calls normal(quad).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const QuadT<T>& quad,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(quad, u, normal(quad));
}

/// The point of a quad at the u and v of a hit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const QuadT<T>& quad,
                                             const RayT<T>& /*ray*/,
                                             const ShapeHitT<T>& hit) noexcept {
    return point_at(quad, hit.u, hit.v);
}

/// The corners of a quad, counter-clockwise around its normal.
template <std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 4> corners_of(const QuadT<T>& quad) noexcept {
    return {quad.corner, quad.corner + quad.edge_u,
            quad.corner + quad.edge_u + quad.edge_v, quad.corner + quad.edge_v};
}

/// A quad as a facet, whose front is on the side of the normal.
template <std::floating_point T>
[[nodiscard]] Facet facet_of(const QuadT<T>& quad) noexcept {
    const glm::dvec3 c(quad.corner), u(quad.edge_u), v(quad.edge_v);
    return {{c, c + u, c + u + v, c + v}, 4};
}

/// A sphere around a quad.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const QuadT<T>& quad) noexcept {
    return {.center = quad.corner + (quad.edge_u + quad.edge_v) / T(2),
            .radius = glm::max(glm::length(quad.edge_u + quad.edge_v),
                               glm::length(quad.edge_u - quad.edge_v)) /
                      T(2)};
}

/// A box that contains a quad despite rounding, a few units in the last place too
/// large.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const QuadT<T>& quad) noexcept {
    BoxT<T> box{quad.corner, quad.corner};
    for (const Vec3T<T>& way : {quad.edge_u, quad.edge_v, quad.edge_u + quad.edge_v})
        box = box_union(box, quad.corner + way);
    const Vec3T<T> size = detail::rounding_bound<T>(4) *
                              (detail::sizes(quad.corner) + detail::sizes(quad.edge_u) +
                               detail::sizes(quad.edge_v)) +
                          std::numeric_limits<T>::min();
    return {box.low - size, box.high + size};
}

/// The six sides of an axis-aligned box, as quads that face outwards. The box must have
/// a volume.
template <std::floating_point T>
[[nodiscard]] constexpr std::array<QuadT<T>, 6> sides_of(const BoxT<T>& box) noexcept {
    const Vec3T<T> size = box.high - box.low;
    const Vec3T<T> x{size.x, T(0), T(0)}, y{T(0), size.y, T(0)}, z{T(0), T(0), size.z};
    return {QuadT<T>{box.low, z, y}, {box.high, -y, -z}, {box.low, x, z},
            {box.high, -z, -x},      {box.low, y, x},    {box.high, -x, -y}};
}

/// The texture tangents of a quad: its two edges.
template <std::floating_point T>
[[nodiscard]] constexpr std::array<Vec3T<T>, 2>
texture_tangents(const QuadT<T>& quad, const ShapeHitT<T>& /*hit*/) noexcept {
    return {quad.edge_u, quad.edge_v};
}

/// A quad displaced by a vector, in scene units.
template <std::floating_point T>
[[nodiscard]] constexpr QuadT<T> translated(QuadT<T> shape,
                                            const Vec3T<T>& by) noexcept {
    shape.corner += by;
    return shape;
}

/// Refuses a quad if a member is not finite.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T>
void check(const QuadT<T>& quad) {
    require_finite("quad.corner", quad.corner);
    require_finite("quad.edge_u", quad.edge_u);
    require_finite("quad.edge_v", quad.edge_v);
}

/// \}

} // namespace ljus
