#pragma once

/// \file form_factor_facing.hpp
/// \brief A form factor in closed form \cite howell2010 , as a reference.

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

} // namespace ljus_test
