#pragma once

/// \file ljus/radiosity/form_factor.hpp
/// \brief A form factor that is known in closed form.

#include <cmath>
#include <numbers>

#include "ljus/geometry/facet.hpp"

namespace ljus {

/// \addtogroup form_factor
/// \{

/// The form factor from a floor to a wall that stands on one of its edges.
/// \param edge    Length of the common edge, above 0.
/// \param floor   The floor's other side.
/// \param height  The wall's other side.
/// \return From the floor to the wall: 0.2000438 for two unit squares.
/// \cite howell2010
[[nodiscard]] inline double form_factor_corner(double edge, double floor,
                                               double height) noexcept {
    const double w = floor / edge, h = height / edge;
    const double w2 = w * w, h2 = h * h, s = h2 + w2;
    const double angles = w * std::atan(1 / w) + h * std::atan(1 / h) -
                          std::sqrt(s) * std::atan(1 / std::sqrt(s));
    const double logs = std::log((1 + w2) * (1 + h2) / (1 + s)) +
                        w2 * std::log(w2 * (1 + s) / ((1 + w2) * s)) +
                        h2 * std::log(h2 * (1 + s) / ((1 + h2) * s));
    return std::numbers::inv_pi / w * (angles + logs / 4);
}

/// \}

} // namespace ljus
