#pragma once

/// \file ljus/math/vector.hpp
/// \brief This library's names for GLM's vectors.

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup vector Vectors
/// \brief Points, directions and colours are GLM vectors.
/// \{

/// A point of the plane, or of the unit square.
template <std::floating_point T>
using Vec2T = glm::vec<2, T>;
using Vec2 = Vec2T<float>; ///< Vec2T in float.

/// A point or a direction in space.
template <std::floating_point T>
using Vec3T = glm::vec<3, T>;
using Vec3 = Vec3T<float>; ///< Vec3T in float.

/// Three channels of linear sRGB: radiance in W/(m^2 sr), flux in W, or a reflectance.
template <std::floating_point T>
using RgbT = glm::vec<3, T>;
using Rgb = RgbT<float>; ///< RgbT in float.

/// The precision of a computation. It is the type Compute if that is a floating-point
/// type, and otherwise T, the precision of the data. Compute is void by default.
template <typename Compute, std::floating_point T>
using ComputeT = std::conditional_t<std::is_floating_point_v<Compute>, Compute, T>;

/// The wider of T and double.
template <std::floating_point T>
using WideT = decltype(T() + double());

/// True if every component is finite.
template <std::floating_point T>
[[nodiscard]] bool is_finite(const Vec3T<T>& v) noexcept {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

/// True if all three channels are zero.
template <std::floating_point T>
[[nodiscard]] constexpr bool is_black(const RgbT<T>& c) noexcept {
    return c.x == T(0) && c.y == T(0) && c.z == T(0);
}

namespace detail {

/// The absolute value of each component. glm::abs() branches on each sign, and a
/// processor cannot predict the signs of a ray's direction.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> sizes(const Vec3T<T>& v) noexcept {
    return {std::abs(v.x), std::abs(v.y), std::abs(v.z)};
}

/// A bound on the relative error of n roundings in a row: n u / (1 - n u), where u is
/// the unit roundoff of T.
template <std::floating_point T>
[[nodiscard]] constexpr T rounding_bound(int n) noexcept {
    const T nu = T(n) * std::numeric_limits<T>::epsilon() / T(2);
    return nu / (T(1) - nu);
}

/// The sum of the absolute values of the components. In a dot or a cross product of v
/// and w, the absolute value of each product is at most size_of(v) * size_of(w).
template <std::floating_point T>
[[nodiscard]] T size_of(const Vec3T<T>& v) noexcept {
    return std::abs(v.x) + std::abs(v.y) + std::abs(v.z);
}

} // namespace detail

/// The largest of the three components.
template <std::floating_point T>
[[nodiscard]] constexpr T max_component(const Vec3T<T>& v) noexcept {
    const T yz = v.y < v.z ? v.z : v.y;
    return v.x < yz ? yz : v.x;
}

/// Longitude u and latitude v of a direction of any length, both scaled to [0, 1]. u
/// goes once around, from +x towards -z. v goes from 0 at -y to 1 at +y.
/// \return (u, v); (0, 0.5) for the zero vector.
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> globe_coordinates(const Vec3T<T>& d) noexcept {
    const T u = std::atan2(-d.z, d.x) * (std::numbers::inv_pi_v<T> / T(2));
    const T v = std::atan2(d.y, std::hypot(d.x, d.z)) * std::numbers::inv_pi_v<T>;
    return {u < T(0) ? u + T(1) : u, v + T(0.5)};
}

/// \}

} // namespace ljus
