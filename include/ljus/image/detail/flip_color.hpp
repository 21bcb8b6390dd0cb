#pragma once

/// \file ljus/image/detail/flip_color.hpp
/// \brief The two colour spaces of FLIP: one for blurring, one for distances.

#include <cmath>

#include "ljus/image/image.hpp"

namespace ljus {

/// \addtogroup flip
/// \{

namespace detail {

/// The contributions of red, green and blue to X, Y and Z (primaries of Rec. 709). Each
/// row adds up to 1, because X, Y and Z are relative to the white point.
inline constexpr Vec3T<double> xyz_weights[3] = {
    Vec3T<double>{10135552, 8788810, 4435075} / 23359437.0,
    Vec3T<double>{2613072, 8788810, 887015} / 12288897.0,
    Vec3T<double>{1425312, 8788810, 70074185} / 80288307.0};

/// XYZ of a linear sRGB colour, in units of the white point D65.
/// \return X/Xn, Y/Yn, Z/Zn; white is (1, 1, 1).
[[nodiscard]] inline Vec3T<double> xyz_over_white(const RgbT<double>& c) noexcept {
    return {glm::dot(xyz_weights[0], c), glm::dot(xyz_weights[1], c),
            glm::dot(xyz_weights[2], c)};
}

/// The linear sRGB colour of XYZ: the inverse of xyz_over_white().
/// \return Linear sRGB, not always within [0, 1].
[[nodiscard]] inline RgbT<double> rgb_of(const Vec3T<double>& xyz) noexcept {
    // Cramer's rule: cross products of two rows over the determinant.
    const auto& [x, y, z] = xyz_weights;
    const Vec3T<double> yz = glm::cross(y, z);
    return (xyz.x * yz + xyz.y * glm::cross(z, x) + xyz.z * glm::cross(x, y)) /
           glm::dot(x, yz);
}

/// YCxCz, which separates lightness, red-green and blue-yellow. Each is linear in
/// light, so that it can be blurred.
/// \return 116 Y - 16; 500 (X - Y); 200 (Y - Z), in units of white.
/// \cite andersson2020
[[nodiscard]] inline Vec3T<double> opponent(const RgbT<double>& c) noexcept {
    const Vec3T<double> white = xyz_over_white(c);
    return {116 * white.y - 16, 500 * (white.x - white.y), 200 * (white.y - white.z)};
}

/// The linear sRGB colour of YCxCz.
/// \return Linear sRGB, not always within [0, 1].
[[nodiscard]] inline RgbT<double> rgb_of_opponent(const Vec3T<double>& c) noexcept {
    const double y = (c.x + 16) / 116;
    return rgb_of({y + c.y / 500, y, y - c.z / 200});
}

/// L*a*b* of a colour with the Hunt effect: dark colours are less colourful.
/// \return L*, and a* and b* times L*/100.
/// \cite andersson2020
[[nodiscard]] inline Vec3T<double> hunt_lab(const RgbT<double>& c) noexcept {
    const auto root = [](double t) {
        constexpr double d = 6.0 / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
    };
    const Vec3T<double> white = xyz_over_white(c);
    const double x = root(white.x), y = root(white.y), z = root(white.z);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y),
            0.01 * lightness * 200 * (y - z)};
}

/// The HyAB distance, made for large differences: city-block in lightness, Euclidean in
/// a* and b*.
/// \return |L1 - L2| + |(a1, b1) - (a2, b2)|.
/// \cite andersson2020
[[nodiscard]] inline double hyab(const Vec3T<double>& a,
                                 const Vec3T<double>& b) noexcept {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

} // namespace detail

/// \}

} // namespace ljus
