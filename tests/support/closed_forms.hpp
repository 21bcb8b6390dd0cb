#pragma once

/// \file support/closed_forms.hpp
/// \brief Form factors \cite howell2010 and Fresnel's reflectance, as textbooks have
/// them: what the library's own are compared with.

#include <cmath>
#include <numbers>

namespace ljus_test {

/// The form factor between two equal rectangles with sides a and b that face each
/// other.
inline double form_factor_facing(double a, double b, double distance) noexcept {
    const double x = a / distance, y = b / distance;
    const double x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
    const double corners = std::log(x1 * x1 * y1 * y1 / (1 + x * x + y * y)) / 2;
    const double sides = x * y1 * std::atan(x / y1) + y * x1 * std::atan(y / x1) -
                         x * std::atan(x) - y * std::atan(y);
    return 2 * std::numbers::inv_pi / (x * y) * (corners + sides);
}

/// The form factor from a point to a rectangle a x b at a distance, parallel to its
/// surface, whose corner lies straight above it (C-11).
inline double form_factor_of_corner(double a, double b, double distance) noexcept {
    const double x = a / distance, y = b / distance;
    const double x1 = std::sqrt(1 + x * x), y1 = std::sqrt(1 + y * y);
    return (x / x1 * std::atan(y / x1) + y / y1 * std::atan(x / y1)) *
           std::numbers::inv_pi / 2;
}

/// The reflectance of unpolarised light; 1 beyond the critical angle.
inline double fresnel_share(double cos_i, double n_i, double n_t) noexcept {
    const double sin_t = n_i / n_t * std::sqrt(1 - cos_i * cos_i);
    if (sin_t >= 1) return 1;
    const double cos_t = std::sqrt(1 - sin_t * sin_t);
    const double s = (n_i * cos_i - n_t * cos_t) / (n_i * cos_i + n_t * cos_t);
    const double p = (n_t * cos_i - n_i * cos_t) / (n_t * cos_i + n_i * cos_t);
    return (s * s + p * p) / 2;
}

} // namespace ljus_test
