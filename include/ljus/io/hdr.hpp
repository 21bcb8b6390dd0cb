#pragma once

/// \file ljus/io/hdr.hpp
/// \brief Radiance files (.hdr): linear radiance in four bytes per pixel.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/io/detail/byte_reader.hpp"
#include "ljus/io/detail/srgb_primaries.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup hdr HDR
/// \brief The three channels of a pixel share an exponent. The format spans 76 decades;
/// its error is at most 0.4 % of the largest channel of a pixel.
/// \{

namespace detail {

/// Encodes a colour in four bytes: round(256 x / 2^e) for each channel x, and e + 128,
/// where e is the smallest exponent for which each result fits in a byte
/// \cite ward1991.
/// \param c  The colour. Its channels are at least 0 and below 1.69e38.
/// \return The bytes R, G, B and E; all 0 if the largest channel is below 2.9e-39. The
///         error of a channel is at most 1/256 of the largest one, and has no bias.
[[nodiscard]] inline std::array<unsigned char, 4>
to_rgbe(const RgbT<double>& c) noexcept {
    const double largest = max_component(c);
    int exponent = 0;
    std::frexp(largest, &exponent);
    // A mantissa that rounds to 256 would not fit a byte.
    if (std::ldexp(largest, 8 - exponent) >= 255.5) ++exponent;
    if (!(largest > 0.0) || exponent < -127) return {0, 0, 0, 0};
    const auto mantissa = [exponent](double channel) {
        return static_cast<unsigned char>(std::ldexp(channel, 8 - exponent) + 0.5);
    };
    return {mantissa(c.x), mantissa(c.y), mantissa(c.z),
            static_cast<unsigned char>(exponent + 128)};
}

/// Decodes four bytes R, G, B and E. No half step is added to R, G and B, because
/// to_rgbe() has rounded them to the nearest step.
/// \return (R, G, B) 2^(E - 136), or black if E is 0.
[[nodiscard]] inline RgbT<double>
from_rgbe(const std::array<unsigned char, 4>& rgbe) noexcept {
    if (rgbe[3] == 0) return RgbT<double>(0.0);
    const double unit = std::ldexp(1.0, int{rgbe[3]} - 136);
    return {rgbe[0] * unit, rgbe[1] * unit, rgbe[2] * unit};
}

} // namespace detail

/// Saves an image as a Radiance file, without run-length coding; see save_file().
/// \throws std::invalid_argument  as check(), or if a channel is below 0 or at least
///         1.69e38; std::runtime_error as save_file().
template <std::floating_point T>
void save_hdr(const ImageT<T>& image, const std::string& path) {
    check(image);
    const std::string header = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " +
                               std::to_string(image.height) + " +X " +
                               std::to_string(image.width) + "\n";
    Bytes bytes(header.begin(), header.end());
    bytes.reserve(bytes.size() + 4 * image.pixels.size());
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const RgbT<double> c(pixel(image, x, y));
            for (const double channel : {c.x, c.y, c.z})
                if (!(channel >= 0.0 && channel < 1.69e38))
                    throw std::invalid_argument(
                        "Pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                        ") has a channel of " + std::to_string(channel) + "; for '" +
                        path +
                        "' it must be at least 0 and below 1.69e38 (a .pfm file stores "
                        "any float).");
            for (const unsigned char byte : detail::to_rgbe(c)) bytes.push_back(byte);
        }
    save_file(path, bytes);
}

namespace detail {

// Reads a coded row. The four channels are stored one after another, as runs of equal
// bytes and runs of different bytes.
inline void read_rgbe_runs(ByteReader& reader,
                           std::vector<std::array<unsigned char, 4>>& row) {
    for (std::size_t part = 0; part < 4; ++part)
        for (std::size_t x = 0; x < row.size();) {
            const std::size_t code = reader.next();
            const bool same = code > 128;
            const std::size_t count = same ? code - 128 : code;
            if (count == 0 || count > row.size() - x)
                reader.fail("a run of its coded pixels is empty or leaves its row");
            unsigned char byte = same ? reader.next() : static_cast<unsigned char>(0);
            for (std::size_t i = 0; i < count; ++i) {
                if (!same) byte = reader.next();
                row[x++][part] = byte;
            }
        }
}

inline void read_rgbe_row(ByteReader& reader,
                          std::vector<std::array<unsigned char, 4>>& row,
                          std::size_t width) {
    // A coded row begins with 2, 2 and its width, which no encoder writes as a colour.
    const unsigned char* const first = reader.bytes.data() + reader.position;
    if (width >= 8 && width <= 0x7fff && reader.left() >= 4 && first[0] == 2 &&
        first[1] == 2 && first[2] < 128) {
        if (std::size_t{first[2]} * 256 + first[3] != width)
            reader.fail("a row declares another width than the header");
        reader.position += 4;
        row.resize(width);
        return read_rgbe_runs(reader, row);
    }
    row.clear(); // grows pixel by pixel, so that a short file takes little memory
    std::array<unsigned char, 4> rgbe{};
    for (int digit = 0; row.size() < width;) {
        if (reader.left() < 4) reader.fail("its last row is incomplete");
        for (unsigned char& byte : rgbe) byte = reader.next();
        if (rgbe[0] != 1 || rgbe[1] != 1 || rgbe[2] != 1) {
            row.push_back(rgbe);
            digit = 0;
            continue;
        }
        // The coding from before 1991: E repeats of the pixel before. Of two such
        // pixels, the second one gives the higher byte of the number of repeats.
        const std::size_t count = std::size_t{rgbe[3]} << 8 * digit;
        if (row.empty() || digit > 1 || count > width - row.size())
            reader.fail("a run of its repeated pixels leaves its row or repeats none");
        row.insert(row.end(), count, std::array(row.back()));
        ++digit;
    }
}

// The numbers of a line of the header, such as "COLORCORR= 1 1.2 0.9", after its first
// `name` letters. A word that is no number gives NaN.
inline std::vector<double> header_numbers(const std::string& line, std::size_t name) {
    std::vector<double> numbers;
    Words words{std::string_view(line).substr(name)};
    for (auto word = words.next(); !word.empty(); word = words.next())
        numbers.push_back(number_of(word));
    return numbers;
}

// What the lines of a header say about the colours.
struct HdrHeader {
    RgbT<double> exposure{1.0}; // divides the pixels
    glm::dmat3 to_srgb{1};
};

// Reads the lines of a header down to the empty one.
inline HdrHeader read_hdr_header(ByteReader& reader) {
    HdrHeader header;
    bool xyze = false;
    for (std::string line = reader.line(); !line.empty(); line = reader.line()) {
        const std::string says = "its header says " + shown(line);
        line.erase(line.find_last_not_of(" \t") + 1);
        if (line.starts_with("FORMAT=")) {
            const std::string_view format = std::string_view(line).substr(
                std::min(line.find_first_not_of(" \t", 7), line.size()));
            xyze = format == "32-bit_rle_xyze";
            if (!xyze && format != "32-bit_rle_rgbe")
                reader.fail(says + "; it must be 32-bit_rle_rgbe or 32-bit_rle_xyze");
        }
        if (line.starts_with("PRIMARIES=")) {
            const auto numbers = header_numbers(line, 10);
            const std::vector<double> unknown(8); // so written by image editors
            const auto matrix = numbers == unknown ? glm::dmat3{1} : to_srgb(numbers);
            if (!matrix)
                reader.fail(says + ", which are not x and y of red, green, blue and "
                                   "white; remove the line if the colours are sRGB");
            header.to_srgb = *matrix;
        }
        if (line.starts_with("GAMMA=") &&
            header_numbers(line, 6) != std::vector<double>{1.0})
            reader.fail(says + "; only radiance is supported, with a gamma of 1");
        const bool three = line.starts_with("COLORCORR=");
        if (!three && !line.starts_with("EXPOSURE=")) continue;
        const auto numbers = header_numbers(line, three ? 10 : 9);
        // So written where the exposure is unknown.
        if (!three && numbers == std::vector{0.0}) continue;
        const bool good =
            numbers.size() == (three ? 3u : 1u) &&
            std::all_of(numbers.begin(), numbers.end(), [](double number) {
                return number > 0.0 && std::isfinite(number);
            });
        if (!good)
            reader.fail(says + ", which is not " +
                        (three ? "three numbers above 0" : "a number above 0"));
        header.exposure *= three ? RgbT<double>{numbers[0], numbers[1], numbers[2]}
                                 : RgbT<double>{numbers[0]};
    }
    if (xyze) // as Radiance converts them: (1/3, 1/3) becomes white
        header.to_srgb = glm::inverse(columns_of(radiance_primaries)) / 179.;
    return header;
}

} // namespace detail

/// Loads a Radiance file in RGBE or XYZE with rows from left to right, plain or
/// run-length coded, by today's coding or by that from before 1991.
/// \return The radiance: the pixels divided by the EXPOSURE and COLORCORR of the
///         header. Colours of other primaries than those of sRGB are converted, and
///         those of XYZE are divided by 179 lm/W. Their channels are then at least 0,
///         also outside of sRGB's gamut.
/// \throws std::runtime_error  with path and reason, if the file cannot be read, is of
///         an unsupported kind (primaries that give no white, a gamma, another pixel
///         order), or is shorter or longer than its header says.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_hdr(const std::string& path) {
    detail::ByteReader reader{path, load_file(path, 8 * std::size_t(max_pixels), "#?")};
    const detail::HdrHeader header = detail::read_hdr_header(reader);
    const std::string y_word = reader.word();
    const std::string y_size = reader.word();
    const std::string x_word = reader.word();
    const int height = reader.size(y_size);
    const int width = reader.size(reader.last_word());
    const bool upwards = y_word == "+Y";
    if ((y_word != "-Y" && !upwards) || x_word != "+X")
        reader.fail("its rows go " + shown(y_word) + " " + shown(x_word) +
                    "; only -Y +X and +Y +X are supported");
    reader.require_pixels(width, height);

    // The image grows row by row, so that a short file that declares a large size takes
    // little memory.
    ImageT<T> image{.width = width, .height = height, .pixels = {}};
    std::vector<std::array<unsigned char, 4>> row;
    for (int y = 0; y < height; ++y) {
        detail::read_rgbe_row(reader, row, static_cast<std::size_t>(width));
        for (const auto& rgbe : row) {
            const RgbT<T> color(detail::from_rgbe(rgbe) / header.exposure);
            if (!is_finite(color))
                reader.fail("a pixel divided by its exposure is not finite");
            image.pixels.push_back(color);
        }
    }
    if (reader.left() != 0)
        reader.fail("it has " + std::to_string(reader.left()) +
                    " bytes more than its pixels require");
    for (auto low = image.pixels.begin(), high = image.pixels.end();
         upwards && high - low > width; low += width)
        high = std::swap_ranges(low, low + width, high - width) - width;
    detail::convert(image.pixels, header.to_srgb, std::numeric_limits<T>::max());
    return image;
}

/// \}

} // namespace ljus
