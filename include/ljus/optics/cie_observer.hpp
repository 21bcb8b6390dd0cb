#pragma once

/// \file ljus/optics/cie_observer.hpp
/// \brief Converts a spectrum to three channels by the CIE's standard observer of 1931.

#include <algorithm>
#include <array>
#include <cmath>

#include "ljus/image/color.hpp"

namespace ljus {

/// \defgroup cie_observer The standard observer
/// \brief Converts a spectrum to red, green and blue.
/// \{

namespace detail {

/// The range of wavelengths over which spectra are integrated, in nm.
template <std::floating_point T>
inline constexpr std::array<T, 2> visible{T(360), T(830)};

} // namespace detail

/// The colour matching functions of the CIE's standard observer of 1931, for a field of
/// view of 2 degrees, fitted by seven Gaussians \cite wyman2013. The fit is within 0.03
/// of the CIE's table, whose values go up to 1.8.
/// \param wavelength  In nm; visible light is between 380 and 780.
/// \return \f$ \bar x, \bar y, \bar z \f$. The integrals are 106.7 to 106.9 nm.
/// \cost Seven exponentials.
// [observer]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> cie_observer(T wavelength) noexcept {
    // The inverse widths, in 1/nm, are `left` below the centre and `right` above it.
    const auto bell = [&](double center, double left, double right) {
        const T x = (wavelength - T(center)) * T(wavelength < T(center) ? left : right);
        return std::exp(-x * x / T(2));
    };
    return {T(0.362) * bell(442.0, 0.0624, 0.0374) +
                T(1.056) * bell(599.8, 0.0264, 0.0323) -
                T(0.065) * bell(501.1, 0.0490, 0.0382),
            T(0.821) * bell(568.8, 0.0213, 0.0247) +
                T(0.286) * bell(530.9, 0.0613, 0.0322),
            T(1.217) * bell(437.0, 0.0845, 0.0278) +
                T(0.681) * bell(459.0, 0.0385, 0.0725)};
}
// [observer]

/// Converts XYZ, relative to light of equal energy at all wavelengths, to linear sRGB.
/// X = Y = Z = 1 becomes the screen's white (1, 1, 1), so that a surface that reflects
/// all light looks white. For this purpose X, Y and Z are multiplied by those of the
/// screen's white before the matrix of the sRGB standard is applied. A pure colour has
/// one or two negative channels, because no screen can show it.
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> xyz_to_rgb(const Vec3T<T>& xyz) noexcept {
    // The rows of IEC 61966-2-1 times (0.95047, 1, 1.08883); each adds up to 1.
    constexpr T r[] = {T(3.2404542 * 0.95047), T(-1.5371385), T(-0.4985314 * 1.08883)};
    constexpr T g[] = {T(-0.9692660 * 0.95047), T(1.8760108), T(0.0415560 * 1.08883)};
    constexpr T b[] = {T(0.0556434 * 0.95047), T(-0.2040259), T(1.0572252 * 1.08883)};
    const auto row = [&](const T(&m)[3]) {
        return (m[0] * xyz.x + m[1] * xyz.y + m[2] * xyz.z) / (m[0] + m[1] + m[2]);
    };
    return {row(r), row(g), row(b)};
}

/// Moves a finite colour of linear sRGB into the range that a screen can show and a
/// surface can reflect. The colour is mixed with just enough grey of the same luminance
/// to bring all channels into [0, 1]. Clamping the channels instead would change the
/// luminance. The luminance of the result is that of `c`, clamped to [0, 1].
// [into_gamut]
template <std::floating_point T>
[[nodiscard]] RgbT<T> into_gamut(const RgbT<T>& c) noexcept {
    const T grey = std::clamp(luminance(c), T(0), T(1));
    T keep = T(1);
    for (int i = 0; i < 3; ++i) {
        if (c[i] < T(0)) keep = std::min(keep, grey / (grey - c[i]));
        if (c[i] > T(1)) keep = std::min(keep, (T(1) - grey) / (c[i] - grey));
    }
    if (keep == T(1)) return c;
    return glm::clamp(RgbT<T>{grey} + keep * (c - RgbT<T>{grey}), T(0), T(1));
}
// [into_gamut]

/// \}

} // namespace ljus
