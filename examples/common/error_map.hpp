#pragma once

/// \file examples/common/error_map.hpp
/// \brief Draws a map of numbers as colours, with a legend.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/image/image.hpp"

namespace examples {

/// Two scales of colours for numbers from 0 to 1.
enum class Ramp {
    heat, ///< From black through violet and orange to pale yellow, for errors without a
          ///< sign.
    signs ///< From blue through white to orange, for signed errors; 0.5 means no error.
};

/// The colour of a number.
/// \param ramp  The scale.
/// \param t     The number, which is clamped to [0, 1].
/// \return Linear sRGB, for save_png().
[[nodiscard]] inline ljus::Rgb ramp_color(Ramp ramp, double t) {
    using Bytes = std::array<double, 3>;
    // The steps are about perceptually uniform, and each is lighter than the one
    // before.
    static constexpr std::array<Bytes, 6> heat{{{0, 0, 0},
                                                {62, 22, 92},
                                                {140, 38, 107},
                                                {212, 74, 71},
                                                {246, 154, 58},
                                                {252, 248, 190}}};
    static constexpr std::array<Bytes, 6> signs{{{22, 60, 130},
                                                 {80, 145, 205},
                                                 {225, 235, 245},
                                                 {250, 232, 215},
                                                 {228, 134, 62},
                                                 {138, 50, 12}}};
    const auto& stops = ramp == Ramp::heat ? heat : signs;
    const double at = std::clamp(t, 0.0, 1.0) * 5;
    const auto i = std::min<std::size_t>(4, static_cast<std::size_t>(at));
    const double part = at - double(i);
    ljus::Rgb color{0};
    for (int c = 0; c < 3; ++c) {
        const auto k = static_cast<std::size_t>(c);
        const double byte = stops[i][k] + part * (stops[i + 1][k] - stops[i][k]);
        color[c] = static_cast<float>(ljus::srgb_decode(byte / 255));
    }
    return color;
}

/// Writes digits into a picture. A character has 3 x 5 dots, with a gap of one dot.
/// \param image  The picture; characters that do not fit are cut off.
/// \param x      Column of the left edge.
/// \param y      Row of the upper edge.
/// \param text   Digits, '.', '-', '+' and '%'; others leave a gap.
/// \param dot    Width of a dot in pixels.
/// \param color  Linear sRGB.
inline void write_digits(ljus::Image& image, int x, int y, std::string_view text,
                         int dot, const ljus::Rgb& color) {
    // Each shape has five rows of three dots. The highest bits are the first row.
    static constexpr std::string_view known = "0123456789.-+%";
    static constexpr std::array<std::uint16_t, 14> shapes{
        0b111'101'101'101'111, 0b010'110'010'010'111, 0b111'001'111'100'111,
        0b111'001'111'001'111, 0b101'101'111'001'001, 0b111'100'111'001'111,
        0b111'100'111'101'111, 0b111'001'010'010'010, 0b111'101'111'101'111,
        0b111'101'111'001'111, 0b000'000'000'000'010, 0b000'000'111'000'000,
        0b000'010'111'010'000, 0b101'001'010'100'101};
    for (const char c : text) {
        const std::size_t which = known.find(c);
        for (int i = 0; which != std::string_view::npos && i < 15 * dot * dot; ++i) {
            const int bit = i / (dot * dot), within = i % (dot * dot);
            if ((shapes[which] >> (14 - bit) & 1) == 0) continue;
            const int column = x + (bit % 3) * dot + within % dot;
            const int row = y + (bit / 3) * dot + within / dot;
            if (column >= 0 && column < image.width && row >= 0 && row < image.height)
                pixel(image, column, row) = color;
        }
        x += 4 * dot;
    }
}

/// A map of numbers as a picture, with a colour bar and its range below the map.
/// \param map   The numbers, in the first channel; NaN is drawn in green.
/// \param ramp  The colours.
/// \param low   The number that gets the first colour.
/// \param high  The number that gets the last colour, above `low`.
/// \return A picture as wide as the map, but at least 120 pixels wide.
[[nodiscard]] inline ljus::Image error_picture(const ljus::ImageT<double>& map,
                                               Ramp ramp, double low, double high) {
    const int width = std::max(map.width, 120);
    const int dot = std::max(1, width / 240);
    const int bar = 8 * dot, digits = 5 * dot, gap = 3 * dot;
    ljus::Image image =
        ljus::make_image(width, map.height + bar + digits + 3 * gap, ljus::Rgb{1});
    for (int y = 0; y < map.height; ++y)
        for (int x = 0; x < map.width; ++x) {
            const double value = pixel(map, x, y).x;
            pixel(image, x, y) = std::isnan(value)
                                     ? ljus::Rgb{0, 1, 0}
                                     : ramp_color(ramp, (value - low) / (high - low));
        }
    const int top = map.height + gap;
    for (int x = 0; x < width; ++x)
        for (int y = 0; y < bar; ++y)
            pixel(image, x, top + y) = ramp_color(ramp, (x + 0.5) / width);
    for (const int tick : {0, 1, 2, 3, 4}) {
        char text[32];
        std::snprintf(text, sizeof text, "%.3g", low + (high - low) * tick / 4);
        const int length = static_cast<int>(std::string_view(text).size());
        const int size = (4 * length - 1) * dot;
        const int left = std::clamp(width * tick / 4 - size / 2, 0, width - size);
        write_digits(image, left, top + bar + gap, text, dot, ljus::Rgb{0});
    }
    return image;
}

} // namespace examples
