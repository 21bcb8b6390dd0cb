#pragma once

/// \file ljus/io/load_image.hpp
/// \brief Loads PNG, JPEG and BMP pictures, in linear colours.
///
/// This header compiles stb_image, hidden from other files. A program that compiles
/// stb_image in the *same* file must include stb_image before this header. Without
/// stb_image, loading a picture throws.

#include "ljus/io/detail/stb_memory.hpp"

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
// In stb_image before 2.28 a damaged JPEG file can overflow signed sums, and can shift
// a byte of value 0 by 32 bits or more. With this option sums wrap around, and any
// shift of 0 gives 0.
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
#define STBI_MALLOC(size) ljus::detail::StbMemory::resize(nullptr, size)
#define STBI_REALLOC(memory, size) ljus::detail::StbMemory::resize(memory, size)
#define STBI_FREE(memory) ljus::detail::StbMemory::release(memory)
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
#undef STBI_MALLOC
#undef STBI_REALLOC
#undef STBI_REALLOC_SIZED
#undef STBI_FREE
#undef STBI_NO_GIF // stb_image has defined the others itself
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

#include "ljus/image/image.hpp"
#include "ljus/io/detail/picture_colors.hpp"
#include "ljus/io/detail/picture_damage.hpp"
#include "ljus/io/detail/picture_size.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup load_image Loading pictures
/// \brief Loading needs the package stb_image. Only PNG, JPEG and BMP are read, because
/// the decoders of rare formats are more likely to fail on damaged files.
/// \{

/// What is read from a picture.
enum class PictureContent : std::uint8_t {
    colors,  ///< Linear colours, without alpha.
    numbers, ///< The bytes divided by 255, for normals and other data.
    alpha,   ///< Alpha in all three channels, in [0, 1]; 1 in a picture without alpha.
    mask ///< As `alpha`. A picture without alpha gives its red channel instead, with
         ///< the bytes divided by 255.
};

namespace detail {

/// The largest file that load_image() accepts, in bytes.
inline constexpr std::size_t max_image_file = std::size_t(1) << 27;

/// The largest width and height, as in stb_image.
inline constexpr int max_image_side = 1 << 24;

#ifdef LJUS_HAS_STB_IMAGE
// A decoded picture: three bytes per pixel, or four.
struct DecodedBytes {
    int width = 0, height = 0;
    bool has_alpha = false;
    ByteColors colors{};
    int orientation = 1; // by EXIF
    std::unique_ptr<stbi_uc, void (*)(void*)> pixels{nullptr, stbi_image_free};
};

// Unpacks the colour profile of a PNG file; empty if it is damaged or larger than 4 MB.
// Profiles of RGB pictures have at most a few hundred kilobytes.
inline Bytes unpack_profile(const unsigned char* data, std::size_t size) {
    Bytes profile(std::size_t(1) << 22);
    const int length = stbi_zlib_decode_buffer(
        reinterpret_cast<char*>(profile.data()), static_cast<int>(profile.size()),
        reinterpret_cast<const char*>(data), static_cast<int>(size));
    profile.resize(static_cast<std::size_t>(length > 0 ? length : 0));
    return profile;
}

// Decodes a picture into `wanted` bytes per pixel, and calls refuse(why) for an error.
// `colors` says whether the bytes are used as colours. For `others` see
// decode_image().
template <typename Refuse>
DecodedBytes decode_bytes(const Bytes& bytes, long long others, int wanted, bool colors,
                          Refuse refuse) {
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()),
                                bytes.size());
    const bool png = text.starts_with("\x89PNG\r\n\x1a\n");
    const bool jpeg = text.starts_with("\xff\xd8\xff");
    if (!png && !jpeg && !text.starts_with("BM"))
        refuse("is not a picture that can be read: it is neither PNG, JPEG nor BMP; "
               "save it as one of these");
    if (const char* const kind = jpeg ? jpeg_kind_unread(bytes) : nullptr)
        refuse(join({"is a JPEG file ", kind}));
    if (const char* const why = png    ? png_trouble(bytes)
                                : jpeg ? jpeg_trouble(bytes)
                                       : nullptr)
        refuse(join({"is damaged: ", why}));
    if (png && stands_at(bytes, 12, "CgBI"))
        refuse("is a PNG file of Apple's own kind (CgBI), which has red and blue "
               "exchanged; save it as plain PNG");
    DecodedBytes picture;
    if (colors)
        picture.colors = png    ? png_colors(bytes, unpack_profile)
                         : jpeg ? jpeg_colors(bytes)
                                : bmp_colors(bytes);
    if (!picture.colors.matrix)
        refuse(join({"has colours of a kind that is not read, as ", picture.colors.says,
                     " says; save it as sRGB"}));
    const BmpHead bmp(bytes);
    const bool is_bmp = !png && !jpeg;
    const std::string rare_bmp =
        "is a BMP file that is damaged or of a rare kind; save it as PNG";
    if (is_bmp && bmp.compression != 0 && bmp.compression != 3)
        refuse("is a BMP file that is compressed; save it without, or as PNG");
    // A 16-bit channel takes twice the memory before it is reduced to 8 bits.
    const bool is_deep = png && byte_at(bytes, 24) == 16;
    const int most_pixels = is_deep ? max_image_pixels / 2 : max_image_pixels;
    const auto require_size = [&](long long wide, long long high) {
        if (wide < 1 || high < 1 || wide > most_pixels / high)
            refuse(join({"has ", to_text(wide), " x ", to_text(high), " pixels",
                         is_deep ? " of 16 bits per channel" : "",
                         "; there must be 1 to ", to_text(most_pixels)}));
        if (wide > max_image_side || high > max_image_side)
            refuse(join({"has ", to_text(wide), " x ", to_text(high),
                         " pixels; width and height must be at most ",
                         to_text(max_image_side)}));
        if (const std::string why = too_large_beside(others, wide, high); !why.empty())
            refuse(why);
    };
    // stb_image would call a PNG file damaged that is only too large.
    if (png && stands_at(bytes, 12, "IHDR"))
        require_size(png_number(bytes, 16), png_number(bytes, 20));
    if (png) picture.orientation = png_orientation(bytes);
    if (jpeg) picture.orientation = jpeg_orientation(bytes);
    const Bytes filled = png      ? with_whole_palette(bytes)
                         : is_bmp ? bmp_with_whole_palette(bytes)
                                  : Bytes{};
    const Bytes& read = filled.empty() ? bytes : filled;
    const auto* data = reinterpret_cast<const stbi_uc*>(read.data());
    const auto size = static_cast<int>(read.size());
    int &width = picture.width, &height = picture.height, channels = 0;
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        refuse(is_bmp ? rare_bmp
                      : "is not a picture that can be read: its header is damaged or "
                        "unknown");
    // A negative height in a BMP file means that its rows are stored from the top.
    const long long high = std::abs(static_cast<long long>(height));
    require_size(width, high);
    // The largest number of pixels per byte: PNG packs about a thousand bytes, of eight
    // pixels each, into one; JPEG packs 64 pixels into a bit. A shorter file is
    // refused, because stb_image would fill missing data with zeros.
    const std::size_t most = png ? 8256 : 1024;
    if (is_bmp ? bmp.bytes(std::size_t(width), std::size_t(high)) > bytes.size()
               : std::size_t(width) * std::size_t(high) / most > bytes.size())
        refuse("is damaged: it ends in the middle of its pixels");
    picture.pixels.reset(
        stbi_load_from_memory(data, size, &width, &height, &channels, wanted));
    picture.has_alpha = channels % 2 == 0;
    if (picture.pixels) return picture;
    const char* const why = stbi_failure_reason(); // may quote bytes of the file
    const std::string reason = why != nullptr ? why : "error";
    refuse(is_bmp ? rare_bmp : join({"is damaged: ", shown(reason)}));
    return picture;
}
#endif

} // namespace detail

/// Decodes a picture.
/// \param bytes   The file.
/// \param path    The path of the file, for messages.
/// \param others  The number of pixels in all pictures that the caller keeps already.
///                With the new picture, there may be at most 2^25 pixels in all.
/// \param content What is read from the picture.
/// \return Colours or numbers in [0, 1]. Colours of another space than sRGB, such as
///         Display P3 or Adobe RGB, are converted, if the file declares them by a
///         profile of curves and a matrix, by primaries and a gamma in its header, by
///         the numbers of a cICP chunk, or by EXIF data. Channels of colours outside of
///         sRGB's gamut are limited to 0 and 1. The picture is turned upright by its
///         EXIF orientation. A pixel whose index is beyond the end of the palette is
///         black.
/// \throws std::runtime_error  with path and reason, if the file is not a picture or is
///         too large, or if colours are read that cannot be converted: those of a
///         profile of tables, or neither for RGB nor for grey, or in another file, or
///         of primaries that give no white; std::bad_alloc if there is not enough
///         memory.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> decode_image(const Bytes& bytes, const std::string& path,
                                     long long others = 0,
                                     PictureContent content = PictureContent::colors) {
    const auto refuse = [&](std::string_view why) {
        throw std::runtime_error(detail::join({shown_path(path), " ", why, "."}));
    };
#ifdef LJUS_HAS_STB_IMAGE
    const detail::StbMemory memory; // must outlive the picture
    const bool colors = content == PictureContent::colors;
    const bool opacity =
        content == PictureContent::alpha || content == PictureContent::mask;
    const int bytes_each = opacity ? 4 : 3;
    const detail::DecodedBytes picture =
        detail::decode_bytes(bytes, others, bytes_each, colors, refuse);
    // The bytes of a pixel that become red, green and blue.
    const bool red = content == PictureContent::mask && !picture.has_alpha;
    const std::array<int, 3> from_byte = red       ? std::array{0, 0, 0}
                                         : opacity ? std::array{3, 3, 3}
                                                   : std::array{0, 1, 2};
    // 2 to 4: mirrored, or turned by 180 degrees; 5 to 8 in addition exchange rows and
    // columns.
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
                std::size_t(bytes_each) *
                    (std::size_t(row) * std::size_t(picture.width) +
                     std::size_t(column));
            for (std::size_t k = 0; k < 3; ++k) {
                const stbi_uc byte = from[from_byte[k]];
                pixel(image, x, y)[int(k)] =
                    T(colors ? picture.colors.linear[k][byte] : byte / 255.0);
            }
        }
    detail::convert(image.pixels, *picture.colors.matrix, T(1));
    return image;
#else
    (void)bytes;
    (void)others;
    (void)content;
    refuse("cannot be read: this program was compiled without stb_image.h");
    return {};
#endif
}

/// Loads a picture from a file and decodes it as decode_image() does.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_image(const std::string& path, long long others = 0,
                                   PictureContent content = PictureContent::colors) {
    return decode_image<T>(load_file(path, detail::max_image_file), path, others,
                           content);
}

/// \}

} // namespace ljus
