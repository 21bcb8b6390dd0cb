#pragma once

/// \file ljus/io/detail/srgb_primaries.hpp
/// \brief Compares the primaries of a file with those of sRGB.

#include <algorithm>
#include <array>
#include <cmath>

namespace ljus::detail {

// Whether primaries, given as (x, y) of red, green and blue, are approximately those of
// sRGB. The usual primaries of HDR files differ from these by 0.01. The white point is
// not compared.
template <typename Numbers>
[[nodiscard]] bool are_srgb_primaries(const Numbers& numbers) {
    constexpr std::array<double, 6> srgb{0.64, 0.33, 0.3, 0.6, 0.15, 0.06};
    return numbers.size() >= srgb.size() &&
           std::equal(srgb.begin(), srgb.end(), numbers.begin(),
                      [](double a, double b) { return std::abs(a - b) < 0.02; });
}

} // namespace ljus::detail
