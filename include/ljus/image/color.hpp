#pragma once

/// \file ljus/image/color.hpp
/// \brief Converts linear light to the 256 levels of a screen by the sRGB curve.

#include <cmath>
#include <concepts>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup color Colour
/// \brief Radiance is linear and unbounded. The bytes of a picture file are encoded by
/// the sRGB curve and limited to 255.
/// \{

/// The luminance 0.2126 R + 0.7152 G + 0.0722 B of a linear sRGB colour, with the
/// primaries of Rec. 709 and the white D65. It is 1 for white.
template <std::floating_point T>
[[nodiscard]] constexpr T luminance(const RgbT<T>& c) noexcept {
    return T(0.2126) * c.x + T(0.7152) * c.y + T(0.0722) * c.z;
}

/// The sRGB curve (IEC 61966-2-1): encodes linear light.
/// \return In [0, 1]; 0 for NaN and for linear <= 0, 1 for linear >= 1.
// [srgb_encode]
[[nodiscard]] inline double srgb_encode(double linear) noexcept {
    if (!(linear > 0.0)) return 0.0; // written so that NaN is black
    const double x = 1.0 < linear ? 1.0 : linear;
    return x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
}
// [srgb_encode]

/// The inverse of srgb_encode().
/// \return Linear light in [0, 1]; 0 for NaN and for encoded <= 0, 1 for encoded >= 1.
[[nodiscard]] inline double srgb_decode(double encoded) noexcept {
    if (!(encoded > 0.0)) return 0.0;
    const double y = 1.0 < encoded ? 1.0 : encoded;
    return y <= 0.04045 ? y / 12.92 : std::pow((y + 0.055) / 1.055, 2.4);
}

/// The byte of a picture file for one channel: floor(255 y + 1/2), where y is the
/// encoded value in double. In float, some bytes would be off by one.
/// \param linear  Any number. NaN and negative numbers give 0; 1 and above give 255.
[[nodiscard]] inline unsigned char srgb_byte(double linear) noexcept {
    return static_cast<unsigned char>(255.0 * srgb_encode(linear) + 0.5);
}

/// \}

} // namespace ljus
