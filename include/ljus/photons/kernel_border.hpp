#pragma once

/// \file ljus/photons/kernel_border.hpp
/// \brief The fraction of a kernel's disc that lies on a surface.

#include <cmath>
#include <numbers>
#include <optional>

#include "ljus/path/next_vertex.hpp"

namespace ljus {

/// \addtogroup irradiance_points
/// \{

/// The fraction of Epanechnikov's kernel on one side of a straight line: the integral
/// of \f$ \frac{8}{3\pi}(1 - t^2)^{3/2} \f$ from t = -1 to s.
/// \param s  Distance from the centre of the disc to the line, divided by the radius.
///           It is negative if the centre lies on the other side.
/// \return 0 for s <= -1, 1/2 at s = 0, 1 for s >= 1.
// [kernel_part]
template <std::floating_point T>
[[nodiscard]] T kernel_part(T s) noexcept {
    if (!(s < T(1))) return T(1);
    if (s <= T(-1)) return T(0);
    const T root = std::sqrt(T(1) - s * s);
    const T integral = s * root * (T(5) - T(2) * s * s) + T(3) * std::asin(s);
    return T(0.5) + integral / (T(3) * std::numbers::pi_v<T>);
}
// [kernel_part]

namespace detail {

/// Finds the surface near a point by a short ray against the normal, from `height`
/// above the point to `height` below it.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<VertexT<T>>
vertex_below(const W& world, const Vec3T<T>& place, const Vec3T<T>& normal, T height) {
    const RayT<T> down{.origin = place + height * normal,
                       .direction = -normal,
                       .t_max = T(2) * height};
    const auto hit = closest_hit(world, down);
    if (!hit) return std::nullopt;
    VertexT<T> vertex = vertex_at(world, down, *hit);
    vertex.medium = medium_at(world, down);
    return vertex;
}

/// Whether vertex_below() finds a surface with a parallel normal.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] bool goes_on(const W& world, const Vec3T<T>& place,
                           const Vec3T<T>& normal, T height) {
    const auto there = vertex_below(world, place, normal, height);
    return there && std::abs(glm::dot(there->point.normal, normal)) > T(0.99);
}

} // namespace detail

/// The fraction of a kernel's disc that lies on the surface. A straight edge of the
/// shape cuts off a segment of the disc, unless another surface continues beyond the
/// edge. If several edges cut the disc, their fractions are multiplied, which is an
/// approximation.
/// \param world   The closed scene.
/// \param vertex  The centre of the disc.
/// \param normal  Unit normal on the side of the irradiance.
/// \param radius  Radius of the disc, in scene units.
/// \return In (0, 1]; 1 for shapes without straight edges.
/// \cost One ray per edge that cuts the disc.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] T part_on_surface(const W& world, const VertexT<T>& vertex,
                                const Vec3T<T>& normal, T radius) {
    const Vec3T<T>& x = vertex.point.position;
    // [part_on_surface]
    const auto part = [&](const auto& corners) {
        Vec3T<T> middle{T(0)};
        for (const Vec3T<T>& corner : corners) middle += corner / T(corners.size());
        T product = T(1);
        for (std::size_t i = 0; i < corners.size(); ++i) {
            const Vec3T<T>& a = corners[i];
            const Vec3T<T> along =
                glm::normalize(corners[(i + 1) % corners.size()] - a);
            Vec3T<T> inward = glm::cross(normal, along);
            if (glm::dot(middle - a, inward) < T(0)) inward = -inward;
            const T distance = glm::dot(x - a, inward);
            if (!(distance < radius)) continue;
            const Vec3T<T> beyond = x - (distance + T(0.02) * radius) * inward;
            if (!detail::goes_on(world, beyond, normal, T(0.01) * radius))
                product *= kernel_part(distance / radius);
        }
        return product;
    };
    // [part_on_surface]
    return world.visit_shape(vertex.id, [&](const auto& shape) {
        if constexpr (requires { corners_of(shape); })
            return part(corners_of(shape));
        else
            return T(1);
    });
}

/// \}

} // namespace ljus
