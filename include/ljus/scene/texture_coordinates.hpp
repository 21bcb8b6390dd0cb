#pragma once

/// \file ljus/scene/texture_coordinates.hpp
/// \brief The coordinates (u, v) that a place has on its own shape.

#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/shape.hpp"
#include "ljus/image/texture.hpp"

namespace ljus {

/// \defgroup texture_coordinates Texture coordinates
/// \brief Where a shape was hit, in its own terms: what a UvMap looks up by.
///
/// | shape           | (u, v)                                                     |
/// |-----------------|------------------------------------------------------------|
/// | quad            | along its two edges, from its corner: [0, 1] x [0, 1]      |
/// | triangle        | along its two edges, from its first vertex: u + v <= 1     |
/// | sphere          | longitude and latitude, as a GlobeMap at its centre has it |
/// | mesh            | of its vertices, interpolated; without any, the triangle's |
/// | moving shape    | the shape's                                                |
/// | any other shape | the u and v of its hit; (0, 0) if it has none              |
/// \{

/// The coordinates of a hit: those that intersect() found, unless a shape knows better.
/// \param hit  What intersect() returned.
/// \return (u, v), without a unit.
template <Shape S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const S& /*shape*/, const FlatHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    return {hit.u, hit.v};
}

/// Of a sphere: longitude and latitude. The normal tells them also far from the origin.
/// \param point  Of surface_point().
/// \return (u, v) in [0, 1].
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const SphereT<T>& /*sphere*/,
                                           const FlatHitT<T>& /*hit*/,
                                           const SurfacePointT<T>& point) noexcept {
    return map_coordinates(GlobeMapT<T>{}, point.normal);
}

/// Of a moving shape: where it is does not matter.
/// \param moving  The shape.
/// \param hit     What intersect() returned.
/// \param point   Of surface_point().
template <typename S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const Moving<S>& moving,
                                           const FlatHitT<T>& hit,
                                           const SurfacePointT<T>& point) noexcept {
    return texture_coordinates(moving.shape, hit, point);
}

/// \}

} // namespace ljus
