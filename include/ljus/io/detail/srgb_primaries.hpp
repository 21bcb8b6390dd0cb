#pragma once

/// \file ljus/io/detail/srgb_primaries.hpp
/// \brief Converts colours of other primaries into linear sRGB.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "ljus/math/vector.hpp"

namespace ljus::detail {

// Primaries and white, as (x, y) of red, green, blue and white.
using Primaries = std::array<double, 8>;
inline constexpr Primaries srgb_primaries{0.64, 0.33, 0.3,    0.6,
                                          0.15, 0.06, 0.3127, 0.329};
// Those of Radiance, with the white of equal energy, as its reference manual has them
// (File Formats, the PRIMARIES of a picture).
inline constexpr Primaries radiance_primaries{0.64, 0.33, 0.29,   0.6,
                                              0.15, 0.06, 1. / 3, 1. / 3};

// The columns X, Y, Z of red, green and blue that give white together, whose luminance
// is 1.
[[nodiscard]] inline glm::dmat3 columns_of(std::span<const double, 8> xy) {
    const auto xyz = [&](std::size_t k) {
        return glm::dvec3{xy[2 * k], xy[2 * k + 1], 1 - xy[2 * k] - xy[2 * k + 1]};
    };
    const glm::dmat3 colors{xyz(0), xyz(1), xyz(2)};
    const glm::dvec3 scale = glm::inverse(colors) * (xyz(3) / xy[7]);
    return {colors[0] * scale.x, colors[1] * scale.y, colors[2] * scale.z};
}

// The same, adapted to the white D50 by Bradford's method, as in colour profiles
// (ICC.1:2022, annex E). Primaries that are X, Y and Z themselves are adapted from the
// white of sRGB.
[[nodiscard]] inline glm::dmat3 columns_in_d50(std::span<const double, 8> xy) {
    const glm::dmat3 bradford{0.8951,  -0.7502, 0.0389, 0.2664, 1.7135,
                              -0.0685, -0.1614, 0.0367, 1.0296};
    const glm::dmat3 columns = columns_of(xy);
    const glm::dvec3 white = columns * glm::dvec3{1}, d50{0.9642, 1.0, 0.8249};
    const glm::dvec3 d65{0.95046, 1.0, 1.08906};
    const bool is_xyz = xy[0] == 1 && xy[3] == 1;
    const glm::dvec3 gain = bradford * d50 / (bradford * (is_xyz ? d65 : white));
    const auto column = [&](int k) {
        return glm::inverse(bradford) * (gain * (bradford * columns[k]));
    };
    return {column(0), column(1), column(2)};
}

// The matrix into linear sRGB from such columns; nothing if their luminances do not add
// to 1, or if they lie nearly in one plane. For columns that are approximately those of
// sRGB it is the identity.
[[nodiscard]] inline std::optional<glm::dmat3> to_srgb(const glm::dmat3& columns) {
    const glm::dmat3 matrix = glm::inverse(columns_in_d50(srgb_primaries)) * columns;
    const auto off = [&](int k) { return glm::distance(matrix[k], glm::dmat3{1}[k]); };
    if (!(std::abs(columns[0].y + columns[1].y + columns[2].y - 1) < 0.1))
        return std::nullopt;
    for (int k = 0; k < 3; ++k) // at most 3.3 for the primaries X, Y and Z
        if (!(glm::length(matrix[k]) < 10)) return std::nullopt;
    return off(0) + off(1) + off(2) < 0.02 ? glm::dmat3{1} : matrix;
}

// The same from primaries. Those that are approximately the primaries of sRGB count as
// such, whatever their white: the usual ones of HDR files differ by 0.01, with the
// white (1/3, 1/3).
[[nodiscard]] inline std::optional<glm::dmat3> to_srgb(std::span<const double> xy) {
    if (xy.size() != srgb_primaries.size()) return std::nullopt;
    if (std::equal(xy.begin(), xy.begin() + 6, srgb_primaries.begin(),
                   [](double a, double b) { return std::abs(a - b) < 0.02; }))
        return glm::dmat3{1};
    return to_srgb(columns_in_d50(xy.first<8>()));
}

// Converts colours by such a matrix. Channels of colours outside of sRGB's gamut are
// limited to 0 and `most`. A colour with a channel that is not finite is left as it is.
template <typename T>
void convert(std::vector<RgbT<T>>& colors, const glm::dmat3& matrix, T most) {
    if (matrix == glm::dmat3{1}) return;
    for (RgbT<T>& color : colors) {
        if (!is_finite(color)) continue;
        const glm::dvec3 c = matrix * glm::dvec3(color);
        for (int k = 0; k < 3; ++k) color[k] = T(std::clamp(c[k], 0.0, double(most)));
    }
}

} // namespace ljus::detail
