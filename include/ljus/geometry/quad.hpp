#pragma once

/// \file ljus/geometry/quad.hpp
/// \brief The parallelogram: the report's lamps and walls.

#include "ljus/geometry/triangle.hpp"

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
    auto hit = moller_trumbore<C>(ray, Vec3T<C>{quad.corner}, Vec3T<C>{quad.edge_u},
                                  Vec3T<C>{quad.edge_v}, [](C u, C v, C border) {
                                      return u <= C(1) + border && v >= -border &&
                                             v <= C(1) + border;
                                  });
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

/// \}

} // namespace ljus
