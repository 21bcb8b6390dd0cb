#pragma once

/// \file ljus/optics/absorption.hpp
/// \brief The law of Beer and Lambert: absorption in a coloured medium.

#include <cmath>

#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup absorption Absorption
/// \brief The colour of glass deepens with the distance through it.
///
/// The report's program applies the colour once per boundary, so that thin and thick
/// glass look alike.
/// \{

/// The fraction T of light that remains after a distance d in a medium.
/// \f[ T(d) = e^{-\sigma d} \f]
/// \param sigma     Absorption coefficient per scene unit, >= 0.
/// \param distance  The distance d in scene units, >= 0 and finite.
/// \return T in [0, 1] for each channel; 1 without absorption.
/// \cost Three exponentials; none if `sigma` is 0.
template <std::floating_point T>
[[nodiscard]] RgbT<T> transmittance(const RgbT<T>& sigma, T distance) {
    if (is_black(sigma)) return RgbT<T>{T(1)};
    return {std::exp(-sigma.x * distance), std::exp(-sigma.y * distance),
            std::exp(-sigma.z * distance)};
}

/// The absorption coefficient that turns white light into a colour after a distance:
/// -log(color)/distance, per scene unit.
/// \param color     Linear colour after `distance`, each channel in (0, 1]. A channel
///                  of 0 would need infinite absorption.
/// \param distance  In scene units, > 0; for a ball of glass, for example, the
///                  diameter.
/// \throws std::invalid_argument  if the colour or the distance is out of range.
template <std::floating_point T>
[[nodiscard]] RgbT<T> absorption_from_color(const RgbT<T>& color, T distance) {
    require_unit("absorption.color", color);
    require(color.x > T(0) && color.y > T(0) && color.z > T(0), "absorption.color",
            color, "above 0 in every channel, because no finite absorption reaches 0");
    require_positive("absorption.distance", distance);
    const auto sigma = [distance](T c) { return (T(0) - std::log(c)) / distance; };
    return {sigma(color.x), sigma(color.y), sigma(color.z)};
}

/// \}

} // namespace ljus
