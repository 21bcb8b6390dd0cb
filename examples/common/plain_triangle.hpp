#pragma once

/// \file examples/common/plain_triangle.hpp
/// \brief The formula of Möller and Trumbore, as in their paper.

#include <optional>

#include "ljus/geometry/triangle.hpp"

namespace examples {

/// Intersects a ray with a triangle: the plain twin of ljus::intersect(), in float.
/// \param ray       Hits count in [t_min, t_max].
/// \param triangle  A triangle of non-zero area.
/// \return The hit, if there is one. Near edges the answer can be wrong, because of
///         rounding in float.
// [plain]
[[nodiscard]] inline std::optional<ljus::ShapeHitT<float>>
intersect_plainly(const ljus::Ray& ray, const ljus::Triangle& triangle) {
    using ljus::Vec3;
    const Vec3 e1 = triangle.v2 - triangle.v1, e2 = triangle.v3 - triangle.v1;
    const Vec3 to = ray.origin - triangle.v1;
    const Vec3 p = glm::cross(ray.direction, e2), q = glm::cross(to, e1);
    const float determinant = glm::dot(p, e1);
    const float t = glm::dot(q, e2) / determinant;
    const float u = glm::dot(p, to) / determinant;
    const float v = glm::dot(q, ray.direction) / determinant;
    if (!(u >= 0 && v >= 0 && u + v <= 1)) return std::nullopt; // NaN is a miss
    if (!(ray.t_min <= t && t <= ray.t_max)) return std::nullopt;
    return ljus::ShapeHitT<float>{.t = t, .u = u, .v = v};
}
// [plain]

} // namespace examples
