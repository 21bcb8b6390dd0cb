#pragma once

/// \file ljus/render/detail/pass_sums.hpp
/// \brief Sums over the passes of a progressive picture, pixel by pixel.

#include <algorithm>
#include <bit>
#include <cmath>

#include "ljus/image/image.hpp"
#include "ljus/math/random.hpp"

namespace ljus::detail {

/// The means of blocks of pixels; the last ones of a row or column may have fewer.
template <std::floating_point T>
[[nodiscard]] ImageT<double> means_of_blocks(const ImageT<T>& image, int side) {
    const auto blocks = [side](int pixels) { return (pixels - 1) / side + 1; };
    auto means = make_image<double>(blocks(image.width), blocks(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const int columns = std::min(side, image.width - x / side * side);
            const int rows = std::min(side, image.height - y / side * side);
            pixel(means, x / side, y / side) +=
                RgbT<double>(pixel(image, x, y)) / (double(columns) * double(rows));
        }
    return means;
}

/// Adds one more number to the squared distances from the mean (Welford).
/// \param squares  Gets it, pixel by pixel.
/// \param x        The new numbers.
/// \param sum      Of the n before.
/// \param n        How many.
template <std::floating_point T>
void add_squares(ImageT<double>& squares, const ImageT<T>& x, const ImageT<double>& sum,
                 double n) {
    if (n == 0) return;
    for (std::size_t p = 0; p < x.pixels.size(); ++p) {
        const RgbT<double> away = RgbT<double>(x.pixels[p]) - sum.pixels[p] / n;
        squares.pixels[p] += away * away * (n / (n + 1));
    }
}

/// The root mean square of the standard errors of means.
[[nodiscard]] inline double standard_error(const ImageT<double>& squares, double n) {
    double sum = 0;
    for (const RgbT<double>& s : squares.pixels) sum += (s.x + s.y + s.z) / 3;
    return std::sqrt(sum / double(squares.pixels.size()) / (n * (n - 1)));
}

/// A number that tells pictures apart, by every bit of them.
template <std::floating_point T>
[[nodiscard]] std::uint64_t hash_of(const ImageT<T>& image) noexcept {
    std::uint64_t hash = mix_bits(std::uint64_t(image.width));
    for (const RgbT<T>& color : image.pixels)
        for (const T channel : {color.x, color.y, color.z})
            hash = mix_bits(hash ^ std::bit_cast<std::uint64_t>(double(channel))) + 1;
    return hash;
}

} // namespace ljus::detail
