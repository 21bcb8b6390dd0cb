#pragma once

/// \file ljus/io/pfm.hpp
/// \brief PFM files, which store linear radiance exactly, in float.

#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/byte_reader.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup pfm PFM
/// \brief A format of three lines of text, followed by the floats, bottom row first.
/// \{

/// Saves an image as PFM. Every float keeps its bits, even NaN and infinity; a double
/// is rounded to float once. The file is little-endian on every machine.
/// \throws std::invalid_argument  as check(); std::runtime_error as save_file().
template <std::floating_point T>
void save_pfm(const ImageT<T>& image, const std::string& path) {
    check(image);
    const std::string header = "PF\n" + std::to_string(image.width) + " " +
                               std::to_string(image.height) + "\n-1.0\n";
    Bytes bytes(header.begin(), header.end());
    bytes.reserve(bytes.size() + 12 * image.pixels.size());
    for (int y = image.height - 1; y >= 0; --y)
        for (int x = 0; x < image.width; ++x) {
            const RgbT<T>& c = pixel(image, x, y);
            for (const T channel : {c.x, c.y, c.z})
                for (const auto byte : detail::bytes_of(static_cast<float>(channel)))
                    bytes.push_back(byte);
        }
    save_file(path, bytes);
}

/// Loads a PFM file in colour or grey, of either byte order.
/// \return The image. Its values are multiplied by the absolute value of the scale in
///         the header; save_pfm() writes a scale of absolute value 1.
/// \throws std::runtime_error  with path and reason, if the file cannot be read, is not
///         a PFM file, or is shorter or longer than its header says.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_pfm(const std::string& path) {
    detail::ByteReader reader{path,
                              load_file(path, 12 * std::size_t(max_pixels) + 256, "P")};
    const std::string kind = reader.word();
    if (kind != "PF" && kind != "Pf") reader.fail("it does not begin with PF or Pf");
    const int width = reader.size(reader.word());
    const int height = reader.size(reader.word());
    const double scale = detail::number_of(reader.word());
    if (!std::isfinite(scale) || scale == 0.0)
        reader.fail("the third line of its header is not a finite number other than 0");
    reader.require_pixels(width, height);

    // The size is checked before memory is allocated for the pixels.
    const std::size_t channels = kind == "PF" ? 3 : 1;
    const std::size_t expected = 4 * channels * static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(height);
    reader.skip_blanks(expected);
    if (reader.left() != expected)
        reader.fail("its " + std::to_string(width) + " x " + std::to_string(height) +
                    " pixels require " + std::to_string(expected) +
                    " bytes after the header, but there are " +
                    std::to_string(reader.left()));

    const bool little_endian = scale < 0.0;
    const auto next_channel = [&] {
        std::uint32_t bits = 0;
        for (int i = 0; i < 4; ++i)
            bits |= std::uint32_t(reader.next()) << 8 * (little_endian ? i : 3 - i);
        const float value = std::bit_cast<float>(bits);
        if (std::abs(scale) == 1.0) return static_cast<T>(value);
        const T scaled = static_cast<T>(std::abs(scale) * static_cast<double>(value));
        if (std::isfinite(value) && !std::isfinite(scaled))
            reader.fail("a pixel multiplied by its scale is not finite");
        return scaled;
    };
    auto image = make_image<T>(width, height);
    for (int y = height - 1; y >= 0; --y)
        for (int x = 0; x < width; ++x) {
            const T first = next_channel();
            const T second = channels == 3 ? next_channel() : first;
            const T third = channels == 3 ? next_channel() : first;
            pixel(image, x, y) = {first, second, third};
        }
    return image;
}

/// \}

} // namespace ljus
