#pragma once

/// \file ljus/geometry/transform.hpp
/// \brief Shapes moved, turned and scaled.

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "ljus/geometry/shape.hpp"

namespace ljus {

/// \defgroup transform Transforms
/// \brief A transform makes a new shape; a scene never keeps one.
/// \{

/// The affine map x -> A x + b.
template <std::floating_point T>
struct TransformT {
    glm::mat<3, 3, T> linear{T(1)}; ///< A.
    Vec3T<T> translation{T(0)};     ///< b, in scene units.
};
using Transform = TransformT<float>; ///< TransformT in float.

/// Moves by a vector.
/// \param by  In scene units.
/// \return x -> x + by.
template <std::floating_point T>
[[nodiscard]] constexpr TransformT<T> translate(const Vec3T<T>& by) noexcept {
    return {.translation = by};
}

/// Scales each axis about the origin.
/// \param factor  One factor an axis; a negative one mirrors.
/// \return x -> factor x.
template <std::floating_point T>
[[nodiscard]] constexpr TransformT<T> scale(const Vec3T<T>& factor) noexcept {
    glm::mat<3, 3, T> linear{T(0)};
    for (int i = 0; i < 3; ++i) linear[i][i] = factor[i];
    return {.linear = linear};
}

/// Turns about an axis through the origin, counter-clockwise seen against the axis
/// (Rodrigues' formula).
/// \param axis     Any length but zero.
/// \param radians  The angle.
/// \return The rotation.
template <std::floating_point T>
[[nodiscard]] TransformT<T> rotate(const Vec3T<T>& axis, T radians) noexcept {
    const Vec3T<T> k = glm::normalize(axis);
    const T c = std::cos(radians);
    const T s = std::sin(radians);
    glm::mat<3, 3, T> linear{T(0)};
    for (int i = 0; i < 3; ++i) {
        Vec3T<T> e{T(0)};
        e[i] = T(1);
        linear[i] = c * e + s * glm::cross(k, e) + (T(1) - c) * k[i] * k;
    }
    return {.linear = linear};
}

/// One transform after another.
/// \param outer  Applied second.
/// \param inner  Applied first.
/// \return x -> outer(inner(x)).
template <std::floating_point T>
[[nodiscard]] TransformT<T> operator*(const TransformT<T>& outer,
                                      const TransformT<T>& inner) noexcept {
    return {.linear = outer.linear * inner.linear,
            .translation = outer.linear * inner.translation + outer.translation};
}

/// A point, moved.
/// \param transform  The map.
/// \param point      The point.
/// \return A x + b.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> transformed(const TransformT<T>& transform,
                                   const Vec3T<T>& point) noexcept {
    return transform.linear * point + transform.translation;
}

/// A triangle, moved. One that is mirrored turns its vertices round, so that its normal
/// stays on the outer side.
/// \param transform  The map.
/// \param triangle   The triangle.
/// \return The new triangle.
template <std::floating_point T>
[[nodiscard]] TriangleT<T> transformed(const TransformT<T>& transform,
                                       const TriangleT<T>& triangle) noexcept {
    const bool mirrored = glm::determinant(transform.linear) < T(0);
    return {.v1 = transformed(transform, triangle.v1),
            .v2 = transformed(transform, mirrored ? triangle.v3 : triangle.v2),
            .v3 = transformed(transform, mirrored ? triangle.v2 : triangle.v3)};
}

/// A quad, moved; mirrored ones as triangles.
/// \param transform  The map.
/// \param quad       The quad.
/// \return The new quad.
template <std::floating_point T>
[[nodiscard]] QuadT<T> transformed(const TransformT<T>& transform,
                                   const QuadT<T>& quad) noexcept {
    const bool mirrored = glm::determinant(transform.linear) < T(0);
    return {.corner = transformed(transform, quad.corner),
            .edge_u = transform.linear * (mirrored ? quad.edge_v : quad.edge_u),
            .edge_v = transform.linear * (mirrored ? quad.edge_u : quad.edge_v)};
}

/// A sphere, moved, turned, and scaled by the same factor in all directions.
/// \param transform  A similarity; anything else would make an ellipsoid.
/// \param sphere     The sphere.
/// \return The new sphere.
/// \throws std::invalid_argument  if the transform stretches one direction more.
template <std::floating_point T>
[[nodiscard]] SphereT<T> transformed(const TransformT<T>& transform,
                                     const SphereT<T>& sphere) {
    const T factor = std::cbrt(std::abs(glm::determinant(transform.linear)));
    for (int i = 0; i < 3; ++i) {
        const T stretch = glm::length(transform.linear[i]) / factor;
        require(std::abs(stretch - T(1)) < T(1e-4), "the stretch of a sphere", stretch,
                "1 along every axis, because an ellipsoid is not a sphere");
        const T shear = glm::dot(transform.linear[i], transform.linear[(i + 1) % 3]) /
                        (factor * factor);
        require(std::abs(shear) < T(1e-4), "the shear of a sphere", shear,
                "0, because an ellipsoid is not a sphere");
    }
    return {.center = transformed(transform, sphere.center),
            .radius = factor * sphere.radius};
}

/// \}

} // namespace ljus
