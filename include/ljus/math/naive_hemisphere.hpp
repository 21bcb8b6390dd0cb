#pragma once

/// \file ljus/math/naive_hemisphere.hpp
/// \brief The report's second way to choose a direction: two uniform angles.

#include <cmath>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup naive_hemisphere Naive directions
/// \brief Section 3.2.4: "two uniform random generators for the azimuth and inclination
/// angles".
///
/// A belt near the pole is shorter than one near the horizon, and gets as many
/// directions: they crowd around the normal. That is a density like any other, if it is
/// divided by.
/// \erratum{The report does not mention that density. Without it the directions count
/// as if they were cosine-weighted.}
/// \{

/// A direction above the horizon whose inclination and azimuth are uniform.
/// \param u  Point of [0,1)^2.
/// \return Unit vector with z > 0.
/// \cost Two sines, two cosines.
/// \report{Section 3.2.4}
// [naive hemisphere]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_naive_hemisphere(const Vec2T<T>& u) noexcept {
    constexpr T pi = std::numbers::pi_v<T>;
    const T inclination = u.x * pi / T(2);
    const T azimuth = T(2) * pi * u.y;
    const T r = std::sin(inclination);
    // Not cos(inclination), which rounding takes below 0 at the horizon.
    const T z = std::sin((T(1) - u.x) * pi / T(2));
    return {r * std::cos(azimuth), r * std::sin(azimuth), z};
}
// [naive hemisphere]

/// The density of sample_naive_hemisphere(), per steradian:
///
/// \f[ p(\omega) = \frac{1}{\pi^2 \sin\theta} \f]
///
/// 2/pi per radian of inclination, 1/(2 pi) per radian of azimuth, and a solid angle of
/// sin(theta) for a radian of each.
/// \param d  Unit vector.
/// \return At least 1/pi^2; infinite at the pole itself, 0 on and below the horizon.
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
