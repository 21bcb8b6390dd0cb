#pragma once

/// \file ljus/optics/wavelength.hpp
/// \brief Declarations about wavelengths that programs without dispersion also need.

#include <concepts>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \addtogroup dispersion
/// \{

/// Three of Fraunhofer's lines, in nm. Catalogues state the indices of glasses at these
/// lines.
/// \{
template <std::floating_point T>
inline constexpr T line_F = T(486.13); ///< The blue line of hydrogen, in nm.
template <std::floating_point T>
/// The yellow line of helium, in nm; a nominal index is given at this line.
inline constexpr T line_d = T(587.56);
template <std::floating_point T>
inline constexpr T line_C = T(656.27); ///< The red line of hydrogen, in nm.
/// \}

// Defined in dispersion.hpp, which only programs with a dispersive material include.
template <std::floating_point T>
[[nodiscard]] T sample_wavelength(T u);
template <std::floating_point T>
[[nodiscard]] RgbT<T> wavelength_color(T nm);

/// \}

} // namespace ljus
