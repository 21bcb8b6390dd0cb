#pragma once

/// \file ljus/geometry/quad.hpp
/// \brief The parallelogram: the report's lamps and walls.

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
/// \brief Section 3.1.5, with other bounds for u and v: one test where two triangles
/// would need two, and no diagonal to leak through.
/// \{

/// The points \f$ V_1 + uE_1 + vE_2 \f$ with u and v in [0, 1].
template <std::floating_point T>
struct QuadT {
    Vec3T<T> corner{T(0)};             ///< \f$V_1\f$, in scene units.
    Vec3T<T> edge_u{T(1), T(0), T(0)}; ///< \f$E_1\f$, in scene units.
    Vec3T<T> edge_v{T(0), T(1), T(0)}; ///< \f$E_2\f$, in scene units.
};
using Quad = QuadT<float>; ///< QuadT in float.

namespace detail {

/// \f$ E_1 \times E_2 \f$, in double, as for a triangle.
/// \param quad  Any quad.
/// \return A normal as long as the area.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<WideT<T>> cross_of_edges(const QuadT<T>& quad) noexcept {
    return glm::cross(Vec3T<WideT<T>>{quad.edge_u}, Vec3T<WideT<T>>{quad.edge_v});
}

/// Whether a quad has an area: see span_area().
/// \param quad  Any quad.
template <std::floating_point T>
[[nodiscard]] bool has_area(const QuadT<T>& quad) noexcept {
    return span_area(Vec3T<WideT<T>>{quad.edge_u}, Vec3T<WideT<T>>{quad.edge_v});
}

} // namespace detail

/// Where a ray meets a quad.
/// \tparam Compute  The precision of the arithmetic; without a wish double, as for a
///                  triangle.
/// \param ray   Any length of direction but zero; hits count in [t_min, t_max].
/// \param quad  Any two edges; parallel ones are never hit.
/// \return t, and the coordinates u, v along the edges; nothing for a miss.
/// \report{Section 3.1.5}
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<FlatHitT<T>> intersect(const RayT<T>& ray,
                                                   const QuadT<T>& quad) noexcept {
    using C = ComputeT<Compute, WideT<T>>;
    auto hit = moller_trumbore<Spanned::parallelogram, C>(
        ray, Vec3T<C>{quad.corner}, Vec3T<C>{quad.edge_u}, Vec3T<C>{quad.edge_v});
    if (hit && !detail::has_area(quad)) hit.reset();
    return hit;
}

/// The unit normal, along \f$ E_1 \times E_2 \f$.
/// \param quad  A quad with an area.
/// \return Unit vector.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> normal(const QuadT<T>& quad) noexcept {
    return Vec3T<T>(glm::normalize(detail::cross_of_edges(quad)));
}

/// The area, in squared scene units.
/// \param quad  Any quad.
/// \return At least 0.
template <std::floating_point T>
[[nodiscard]] inline T area(const QuadT<T>& quad) noexcept {
    return static_cast<T>(glm::length(detail::cross_of_edges(quad)));
}

/// The point of a quad at u, v, if its normal is known.
/// \param quad    The quad.
/// \param u       Coordinate along the first edge.
/// \param v       Coordinate along the second edge.
/// \param normal  What normal() returned.
/// \return Position, its error bound, the normal.
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

/// The point of a quad at u, v.
template <std::floating_point T>
[[nodiscard]] inline SurfacePointT<T> point_at(const QuadT<T>& quad, T u,
                                               T v) noexcept {
    return point_at(quad, u, v, normal(quad));
}

/// A point of a quad, uniform over its area.
/// \param quad    A quad with an area.
/// \param u       Point of the unit square.
/// \param normal  What normal() returned.
/// \return The point; density 1 / area per squared scene unit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const QuadT<T>& quad, const Vec2T<T>& u,
                                           const Vec3T<T>& normal) noexcept {
    return point_at(quad, u.x, u.y, normal);
}

/// The same, if the normal is not known.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const QuadT<T>& quad,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(quad, u, normal(quad));
}

/// The point of a quad that a ray hit, from its coordinates u and v.
/// \param quad  The quad.
/// \param hit   What intersect() returned.
/// \return Position, its error bound, the normal.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const QuadT<T>& quad,
                                             const RayT<T>& /*ray*/,
                                             const FlatHitT<T>& hit) noexcept {
    return point_at(quad, hit.u, hit.v);
}

/// The corners of a quad, counter-clockwise around its normal.
template <std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 4> corners_of(const QuadT<T>& quad) noexcept {
    return {quad.corner, quad.corner + quad.edge_u,
            quad.corner + quad.edge_u + quad.edge_v, quad.corner + quad.edge_v};
}

/// The facet of a quad; it faces along the normal.
template <std::floating_point T>
[[nodiscard]] Facet facet_of(const QuadT<T>& quad) noexcept {
    const glm::dvec3 c(quad.corner), u(quad.edge_u), v(quad.edge_v);
    return {{c, c + u, c + u + v, c + v}, 4};
}

/// A sphere around a quad, not always the smallest. Photons are aimed at it.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const QuadT<T>& quad) noexcept {
    return {.center = quad.corner + (quad.edge_u + quad.edge_v) / T(2),
            .radius = glm::max(glm::length(quad.edge_u + quad.edge_v),
                               glm::length(quad.edge_u - quad.edge_v)) /
                      T(2)};
}

/// A box around a quad. No point of the quad lies outside of it, not by a rounding
/// either.
/// \return The box, a few units in the last place too large.
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

/// A quad in another place.
/// \param shape  The quad.
/// \param by     The displacement, in scene units.
/// \return The same quad there.
template <std::floating_point T>
[[nodiscard]] constexpr QuadT<T> translated(QuadT<T> shape,
                                            const Vec3T<T>& by) noexcept {
    shape.corner += by;
    return shape;
}

/// Refuses a quad of which no picture can be made.
/// \param quad  The quad.
/// \throws std::invalid_argument  with the name and the value.
template <std::floating_point T>
void check(const QuadT<T>& quad) {
    require_finite("quad.corner", quad.corner);
    require_finite("quad.edge_u", quad.edge_u);
    require_finite("quad.edge_v", quad.edge_v);
}

/// \}

} // namespace ljus
