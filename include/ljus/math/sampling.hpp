#pragma once

/// \file ljus/math/sampling.hpp
/// \brief Functions that turn two uniform random numbers into a point or a direction,
/// and the densities of the results.

#include <cmath>
#include <limits>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup sampling Sampling
/// \brief Section 3.2.4 of the report: sampling functions. Each takes a point u of
/// [0,1)^2 and stands beside its pdf.
///
/// Directions are unit vectors around +z.
/// \{

namespace detail {

/// Maps the unit square onto the unit disc. Rounding may put the point up to 2 units of
/// roundoff outside the disc.
template <std::floating_point T>
[[nodiscard]] inline Vec2T<T> concentric_map(const Vec2T<T>& u) noexcept {
    constexpr T quarter = std::numbers::pi_v<T> / T(4);
    const T a = T(2) * u.x - T(1);
    const T b = T(2) * u.y - T(1);
    if (a == T(0) && b == T(0)) return {T(0), T(0)};
    if (std::abs(a) > std::abs(b)) {
        const T phi = quarter * (b / a);
        return {a * std::cos(phi), a * std::sin(phi)};
    }
    const T phi = quarter * (a / b); // measured from the y axis
    return {b * std::sin(phi), b * std::cos(phi)};
}

} // namespace detail

/// Samples a point of the unit disc, uniformly in area, by the concentric map
/// \cite shirley1997. This map turns squares around the centre into circles. If
/// rounding puts a point onto the border or outside, the point is moved 4 units of
/// roundoff inwards.
/// \return A point (x, y) with x^2 + y^2 < 1.
/// \cost One division, one sine, one cosine.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> sample_concentric_disc(const Vec2T<T>& u) noexcept {
    constexpr T two = T(2) * std::numeric_limits<T>::epsilon();
    const Vec2T<T> p = detail::concentric_map(u);
    return p.x * p.x + p.y * p.y < T(1) - two ? p : (T(1) - two) * p;
}

/// The density of sample_concentric_disc(), per unit of area: 1/pi in the unit disc,
/// and 0 outside.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_concentric_disc(const Vec2T<T>& p) noexcept {
    return p.x * p.x + p.y * p.y <= T(1) ? std::numbers::inv_pi_v<T> : T(0);
}

/// Samples a direction above the horizon with density cos(theta)/pi, where theta is the
/// angle to +z. A point of the unit disc is lifted onto the hemisphere (Malley's
/// method).
/// \return Unit vector with z >= sqrt(epsilon), for the machine epsilon of T. On the
///         horizon itself the density would be 0.
/// \cost That of sample_concentric_disc(), and one square root.
/// \report{Section 3.2.4}
// [cosine hemisphere]
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> sample_cosine_hemisphere(const Vec2T<T>& u) noexcept {
    // `inline` is a hint that makes a path tracer faster with g++.
    const Vec2T<T> p = detail::concentric_map(u);
    // The radius of p is the larger of |a| and |b|.
    const T a = std::abs(T(2) * u.x - T(1));
    const T b = std::abs(T(2) * u.y - T(1));
    const T r = glm::max(a, b);
    constexpr T least = std::numeric_limits<T>::epsilon();
    return {p.x, p.y, std::sqrt(glm::max((T(1) - r) * (T(1) + r), least))};
}
// [cosine hemisphere]

/// The density of sample_cosine_hemisphere(), per steradian: cos(theta)/pi above the
/// horizon, and 0 on and below it.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_cosine_hemisphere(const Vec3T<T>& d) noexcept {
    return d.z > T(0) ? d.z * std::numbers::inv_pi_v<T> : T(0);
}

/// Samples a direction inside a cone around +z, uniformly in solid angle.
/// \param u                  Point of [0,1)^2.
/// \param one_minus_cos_max  1 - cos(theta_max), in (0, 2], where theta_max is the half
///                           angle; 1 gives the hemisphere. A small angle would lose
///                           most digits in cos(theta_max); see one_minus_cosine().
/// \return Unit vector within the cone.
/// \cost One square root, one sine, one cosine.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_uniform_cone(const Vec2T<T>& u,
                                           T one_minus_cos_max) noexcept {
    const T w = u.x * one_minus_cos_max; // 1 - cos(theta), which is uniform
    const T r = std::sqrt(w * (T(2) - w));
    const T phi = T(2) * std::numbers::pi_v<T> * u.y;
    return {r * std::cos(phi), r * std::sin(phi), T(1) - w};
}

/// The density of sample_uniform_cone(), per steradian, for any direction inside the
/// cone: 1 over the cone's solid angle, 2 pi (1 - cos(theta_max)).
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_uniform_cone(T one_minus_cos_max) noexcept {
    return std::numbers::inv_pi_v<T> / (T(2) * one_minus_cos_max);
}

/// Computes 1 - cos(theta) from sin^2(theta) without cancellation, for an angle theta
/// up to 90 degrees. For the half angle of a sphere seen from outside, sin^2(theta) is
/// radius^2 / distance^2.
template <std::floating_point T>
[[nodiscard]] T one_minus_cosine(T sin_squared) noexcept {
    return sin_squared / (T(1) + std::sqrt(T(1) - sin_squared));
}

/// Samples a direction above the horizon (z > 0), uniformly in solid angle.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_uniform_hemisphere(const Vec2T<T>& u) noexcept {
    return sample_uniform_cone(u, T(1));
}

/// The density of sample_uniform_hemisphere(), per steradian: 1/(2 pi) above the
/// horizon, and 0 on and below it.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_uniform_hemisphere(const Vec3T<T>& d) noexcept {
    return d.z > T(0) ? std::numbers::inv_pi_v<T> / T(2) : T(0);
}

/// Samples a direction, uniformly over the whole sphere.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_uniform_sphere(const Vec2T<T>& u) noexcept {
    return sample_uniform_cone(u, T(2));
}

/// The density of sample_uniform_sphere(), per steradian: 1/(4 pi) in every direction.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_uniform_sphere(const Vec3T<T>&) noexcept {
    return std::numbers::inv_pi_v<T> / T(4);
}

/// Samples a point of a triangle, uniformly in area. The square is folded along its
/// diagonal \cite heitz2019, so that nearby values of u give nearby points.
/// \return Barycentric coordinates of the three vertices, each >= 0, with sum 1.
/// \cost One comparison, one multiplication, two subtractions.
template <std::floating_point T>
[[nodiscard]] constexpr Vec3T<T> sample_uniform_triangle(const Vec2T<T>& u) {
    if (u.x < u.y) {
        const T half = u.x / T(2);
        return {half, u.y - half, T(1) - u.y};
    }
    const T half = u.y / T(2);
    return {u.x - half, half, T(1) - u.x};
}

/// The density of sample_uniform_triangle(), per unit of area.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_uniform_triangle(T area) noexcept {
    return T(1) / area;
}

/// \}

/// \defgroup naive_hemisphere Naive directions
/// \brief Section 3.2.4 of the report: "two uniform random generators for the azimuth
/// and inclination angles".
///
/// A ring of directions near the pole is shorter than a ring near the horizon, but gets
/// as many samples. The samples therefore crowd around the pole. An estimate must
/// divide by their density.
/// \erratum{The report does not mention the density. Without the division, the mean is
///          right for cosine-weighted directions only.}
/// \{

/// Samples a direction above the horizon whose inclination and azimuth are uniform.
/// \return Unit vector with z > 0.
/// \cost Three sines, one cosine.
/// \report{Section 3.2.4}
// [naive hemisphere]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_naive_hemisphere(const Vec2T<T>& u) noexcept {
    constexpr T pi = std::numbers::pi_v<T>;
    const T inclination = u.x * pi / T(2);
    const T azimuth = T(2) * pi * u.y;
    const T r = std::sin(inclination);
    // Not cos(inclination), which rounding makes negative at the horizon.
    const T z = std::sin((T(1) - u.x) * pi / T(2));
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}
// [naive hemisphere]

/// The density of sample_naive_hemisphere(), per steradian:
///
/// \f[ p(\omega) = \frac{1}{\pi^2 \sin\theta} \f]
///
/// The inclination theta has density 2/pi per radian, and the azimuth phi has density
/// 1/(2 pi). Their product is divided by sin(theta), because dtheta dphi covers the
/// solid angle sin(theta) dtheta dphi.
/// \return At least 1/pi^2; infinite at the pole, 0 on and below the horizon.
// [naive pdf]
template <std::floating_point T>
[[nodiscard]] T pdf_naive_hemisphere(const Vec3T<T>& d) noexcept {
    if (!(d.z > T(0))) return T(0);
    constexpr T inv_pi = std::numbers::inv_pi_v<T>;
    return inv_pi * inv_pi / std::sqrt(d.x * d.x + d.y * d.y);
}
// [naive pdf]

/// \}

} // namespace ljus
