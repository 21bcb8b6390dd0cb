#pragma once

/// \file ljus/geometry/placement.hpp
/// \brief Scaling, rotation and translation of shapes.

#include <cmath>
#include <numbers>

#include <glm/mat3x3.hpp>

#include "ljus/geometry/cylinder.hpp"
#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/triangle.hpp"

namespace ljus {

/// \defgroup placement Placing shapes
/// \brief A shape is scaled, then rotated, then translated, before it is added to a
/// scene.
///
///     const Placement flat{.rotate{{1, 0, 0}, -90}, .translate{0, 1, 0}};
///     scene.add(placed(Disc{}, flat), grey);
/// \{

/// A rotation about an axis through the origin.
template <std::floating_point T>
struct RotationT {
    Vec3T<T> axis{T(0), T(1), T(0)}; ///< The axis, of any length except 0.
    /// The angle in degrees, counter-clockwise for a viewer at whom the axis points.
    T degrees = T(0);
};

/// Scaling, then rotation, then translation.
template <std::floating_point T>
struct PlacementT {
    Vec3T<T> scale{T(1)};     ///< Factors along x, y and z, each above 0.
    RotationT<T> rotate{};    ///< The rotation, after the scaling.
    Vec3T<T> translate{T(0)}; ///< The translation, after the rotation, in scene units.
};
using Placement = PlacementT<float>; ///< PlacementT in float.

/// Refuses a placement if a factor of its scale is not above 0, if a member is not
/// finite, or if the axis of its rotation is 0.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T>
void check(const PlacementT<T>& placement) {
    require_finite("scale", placement.scale);
    const bool above_0 = glm::all(glm::greaterThan(placement.scale, Vec3T<T>{0}));
    require(above_0, "scale", placement.scale, "above 0 in each component");
    require_direction("rotate.axis", placement.rotate.axis);
    require(std::isfinite(placement.rotate.degrees), "rotate.degrees",
            placement.rotate.degrees, "finite");
    require_finite("translate", placement.translate);
}

/// The matrix of a rotation, by Rodrigues' formula, in double. Multiples of 90 degrees
/// about a coordinate axis are exact.
template <std::floating_point T>
[[nodiscard]] glm::dmat3 matrix_of(const RotationT<T>& rotation) noexcept {
    const double turn = std::remainder(double(rotation.degrees), 360.0);
    const double angle = turn * std::numbers::pi / 180;
    const bool quarter = std::remainder(turn, 90.0) == 0;
    const double s = quarter ? std::round(std::sin(angle)) : std::sin(angle);
    const double c = quarter ? std::round(std::cos(angle)) : std::cos(angle);
    const glm::dvec3 k = glm::normalize(glm::dvec3(rotation.axis));
    glm::dmat3 matrix;
    for (int column = 0; column < 3; ++column) {
        glm::dvec3 e(0);
        e[column] = 1;
        matrix[column] = c * e + s * glm::cross(k, e) + (1 - c) * k[column] * k;
    }
    return matrix;
}

/// A difference of two points, such as an edge, after scaling and rotation.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> placed_edge(const Vec3T<T>& edge,
                                   const PlacementT<T>& placement) noexcept {
    const glm::dvec3 scaled = glm::dvec3(placement.scale) * glm::dvec3(edge);
    return Vec3T<T>(matrix_of(placement.rotate) * scaled);
}

/// A point after scaling, rotation and translation.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> placed_point(const Vec3T<T>& point,
                                    const PlacementT<T>& placement) noexcept {
    const glm::dvec3 scaled = glm::dvec3(placement.scale) * glm::dvec3(point);
    return Vec3T<T>(matrix_of(placement.rotate) * scaled +
                    glm::dvec3(placement.translate));
}

/// The unit normal of a surface after scaling and rotation. `normal` may have any
/// length except 0. Its components are divided by the factors of the scale.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> placed_normal(const Vec3T<T>& normal,
                                     const PlacementT<T>& placement) noexcept {
    const glm::dvec3 scaled = glm::dvec3(normal) / glm::dvec3(placement.scale);
    return Vec3T<T>(glm::normalize(matrix_of(placement.rotate) * scaled));
}

namespace detail {

/// The scale of a round shape, which must be the same along all axes.
/// \throws std::invalid_argument  if the scale differs; the message names `shape`.
template <std::floating_point T>
[[nodiscard]] T one_scale(const PlacementT<T>& placement, const char* shape) {
    const Vec3T<T>& s = placement.scale;
    require(s.x == s.y && s.y == s.z, join({"the scale of a ", shape}), s,
            "the same along x, y and z");
    return s.x;
}

} // namespace detail

/// \name Placed shapes
/// A shape after scaling, rotation and translation. For a sphere, a disc or a cylinder,
/// placed() throws std::invalid_argument unless the scale is the same along all axes.
/// \{

/// A placed quad.
template <std::floating_point T>
[[nodiscard]] QuadT<T> placed(const QuadT<T>& quad, const PlacementT<T>& placement) {
    return {placed_point(quad.corner, placement), placed_edge(quad.edge_u, placement),
            placed_edge(quad.edge_v, placement)};
}

/// A placed triangle.
template <std::floating_point T>
[[nodiscard]] TriangleT<T> placed(const TriangleT<T>& triangle,
                                  const PlacementT<T>& placement) {
    return {placed_point(triangle.v1, placement), placed_point(triangle.v2, placement),
            placed_point(triangle.v3, placement)};
}

/// A placed sphere.
template <std::floating_point T>
[[nodiscard]] SphereT<T> placed(const SphereT<T>& sphere,
                                const PlacementT<T>& placement) {
    return {placed_point(sphere.center, placement),
            detail::one_scale(placement, "sphere") * sphere.radius};
}

/// A placed disc.
template <std::floating_point T>
[[nodiscard]] DiscT<T> placed(const DiscT<T>& disc, const PlacementT<T>& placement) {
    return {placed_point(disc.center, placement), placed_normal(disc.normal, placement),
            detail::one_scale(placement, "disc") * disc.radius};
}

/// A placed cylinder.
template <std::floating_point T>
[[nodiscard]] CylinderT<T> placed(const CylinderT<T>& cylinder,
                                  const PlacementT<T>& placement) {
    return {placed_point(cylinder.base, placement),
            placed_edge(cylinder.axis, placement),
            detail::one_scale(placement, "cylinder") * cylinder.radius};
}
/// \}

/// \}

} // namespace ljus
