#pragma once

/// \file ljus/io/load_image.hpp
/// \brief Pictures from PNG, JPEG and BMP files of 8 bits, made linear.
///
/// The decoding is done by stb_image, whose implementation this header makes for
/// itself, invisible to other files, as png.hpp does for the writer. A program with its
/// own implementation in the *same* file includes that one first. Without stb_image no
/// picture can be read, which is said when one is asked for.

#if defined(STBI_INCLUDE_STB_IMAGE_H)
#define LJUS_HAS_STB_IMAGE 1 // the program's own
#elif __has_include(<stb/stb_image.h>) || __has_include(<stb_image.h>)
#define LJUS_HAS_STB_IMAGE 1
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wunused-but-set-variable"
#pragma GCC diagnostic ignored "-Wimplicit-fallthrough"
#elif defined(_MSC_VER)
#pragma warning(push, 0)
#pragma warning(disable : 4505 4996)
#endif
// A damaged JPEG file can overflow the sums of int that its colours are made from, and
// where its bits run out, a byte that is 0 is shifted by 32 bits or more. Releases of
// stb_image before 2.28 look for neither: here the sums wrap, and any shift of 0 is 0.
#if defined(__clang__)
#pragma clang attribute push(                                                          \
    [[clang::no_sanitize("signed-integer-overflow", "shift")]], apply_to = function)
#elif defined(__GNUC__)
#pragma GCC push_options
#pragma GCC optimize("wrapv")
#endif
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_BMP
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#if __has_include(<stb/stb_image.h>)
#include <stb/stb_image.h>
#else
#include <stb_image.h>
#endif
#undef STB_IMAGE_STATIC
#undef STB_IMAGE_IMPLEMENTATION
#undef STBI_ONLY_PNG
#undef STBI_ONLY_JPEG
#undef STBI_ONLY_BMP
#undef STBI_NO_LINEAR
#undef STBI_NO_STDIO
#undef STBI_NO_GIF // the others it has made itself
#undef STBI_NO_HDR
#undef STBI_NO_PIC
#undef STBI_NO_PNM
#undef STBI_NO_PSD
#undef STBI_NO_TGA
#if defined(__clang__)
#pragma clang attribute pop
#elif defined(__GNUC__)
#pragma GCC pop_options
#endif
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#elif defined(_MSC_VER)
#pragma warning(pop)
#endif
#endif

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/image/color.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/detail/picture_damage.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup load_image Loading pictures
/// \brief Optional (stb_image): PNG, JPEG, BMP, and no others, since a reader of a rare
/// format is where a damaged file does harm.
/// \{

namespace detail {

/// The largest file that load_image() takes, in bytes.
inline constexpr std::size_t max_image_file = std::size_t(1) << 27;

/// The most pixels that it takes: 8192 x 4096; of a PNG file of 16 bits half of them.
inline constexpr int max_image_pixels = 1 << 25;

#ifdef LJUS_HAS_STB_IMAGE
// A picture as a file has it: three bytes per pixel.
struct DecodedBytes {
    int width = 0, height = 0;
    double gamma = 0;    // light to this power is what the bytes are; 0: sRGB
    int orientation = 1; // jpeg_orientation()
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels{nullptr, stbi_image_free};
};

// The bytes of a picture; why there is none is said by calling refuse(why).
template <typename Refuse>
DecodedBytes decode_bytes(const Bytes& bytes, Refuse refuse) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                bytes.size());
    const bool png = text.starts_with("\x89PNG\r\n\x1a\n");
    const bool jpeg = text.starts_with("\xff\xd8\xff");
    if (!png && !jpeg && !text.starts_with("BM"))
        refuse("is no picture that can be read: it begins as neither PNG, JPEG nor "
               "BMP does");
    if (const char* const why = png    ? png_trouble(bytes)
                                : jpeg ? jpeg_trouble(bytes)
                                       : nullptr)
        refuse(join({"is damaged: ", why}));
    if (png && png_number(bytes, 12) == 0x43674249u) // CgBI
        refuse("is a PNG file of Apple's own kind (CgBI), which has red and blue "
               "exchanged; save it as plain PNG");
    // A channel of 16 bits takes twice the room before it is made one of 8.
    const bool is_deep = png && byte_at(bytes, 24) == 16;
    const int most_pixels = is_deep ? max_image_pixels / 2 : max_image_pixels;
    const auto require_size = [&](long long wide, long long high) {
        if (wide < 1 || high < 1 || wide > most_pixels / high)
            refuse(join({"has ", to_text(wide), " x ", to_text(high), " pixels",
                         is_deep ? " of 16 bits per channel" : "",
                         "; there must be 1 to ", to_text(most_pixels)}));
    };
    // Of a PNG file that is too large for it stb_image says that it is none.
    if (png && png_number(bytes, 12) == 0x49484452u)
        require_size(png_number(bytes, 16), png_number(bytes, 20));
    DecodedBytes picture;
    if (png) picture.gamma = png_gamma(bytes);
    if (jpeg) picture.orientation = jpeg_orientation(bytes);
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const auto size = static_cast<int>(bytes.size());
    int &width = picture.width, &height = picture.height, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        refuse("is no picture that can be read: its header is damaged or rare");
    require_size(width, height);
    // Pixels in a byte at best: PNG packs a thousand bytes of eight into one, JPEG
    // takes a bit for 64, BMP packs nothing. stb_image takes what lacks for zeros.
    const std::size_t most = png ? 8256 : jpeg ? 1024 : 8;
    if (std::size_t(width) * std::size_t(height) / most > bytes.size())
        refuse("is damaged: it ends in the middle of its pixels");
    picture.pixels.reset(
        stbi_load_from_memory(data, size, &width, &height, &channels, 3));
    const char* const why = stbi_failure_reason(); // it may repeat bytes of the file
    if (!picture.pixels) refuse(join({"is damaged: ", shown(why ? why : "error", 48)}));
    return picture;
}
#endif

} // namespace detail

/// A picture from the bytes of a file.
/// \param bytes  The file.
/// \param path   What messages call it.
/// \return Linear colours in [0, 1]; a transparent file's own, without its alpha. A
///         PNG file is decoded by its gamma, if it has a gAMA chunk and neither sRGB nor
///         a profile (which is not read); a photograph stands upright as EXIF says.
/// \throws std::runtime_error  with path and reason, if it is no picture.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> decode_image(const Bytes& bytes, const std::string& path) {
    const auto refuse = [&](std::string_view why) {
        throw std::runtime_error(detail::join({shown_path(path), " ", why, "."}));
    };
#ifdef LJUS_HAS_STB_IMAGE
    const detail::DecodedBytes picture = detail::decode_bytes(bytes, refuse);
    std::array<T, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i)
        linear[i] = static_cast<T>(
            picture.gamma > 0
                ? std::pow(static_cast<double>(i) / 255.0, 1 / picture.gamma)
                : srgb_decode(static_cast<double>(i) / 255.0));
    // 2 to 4: mirrored or turned by half; 5 to 8: those with rows for columns.
    const int turn = picture.orientation;
    const bool rows_for_columns = turn >= 5 && turn <= 8;
    const bool from_right = turn == 2 || turn == 3 || turn == 7 || turn == 8;
    const bool from_below = turn == 3 || turn == 4 || turn == 6 || turn == 7;
    ImageT<T> image = rows_for_columns ? make_image<T>(picture.height, picture.width)
                                       : make_image<T>(picture.width, picture.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            int column = rows_for_columns ? y : x, row = rows_for_columns ? x : y;
            if (from_right) column = picture.width - 1 - column;
            if (from_below) row = picture.height - 1 - row;
            const stbi_uc* const from =
                picture.pixels.get() +
                3 * (std::size_t(row) * std::size_t(picture.width) +
                     std::size_t(column));
            pixel(image, x, y) = {linear[from[0]], linear[from[1]], linear[from[2]]};
        }
    return image;
#else
    (void)bytes;
    refuse("cannot be read: this program was made without stb_image.h");
    return {};
#endif
}

/// Loads a picture, for a texture.
/// \param path  The file.
/// \return Linear colours in [0, 1].
/// \throws std::runtime_error  with path and reason.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_image(const std::string& path) {
    return decode_image<T>(load_file(path, detail::max_image_file), path);
}

/// \}

} // namespace ljus
