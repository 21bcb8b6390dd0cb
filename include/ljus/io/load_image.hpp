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
// A damaged JPEG file can overflow the sums of int from which its colours are clamped:
// they wrap here, and releases of stb_image before 2.28 do not look for it.
#if defined(__clang__)
#pragma clang attribute push(__attribute__((no_sanitize("signed-integer-overflow"))), \
                             apply_to = function)
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
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>

#include "ljus/image/color.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup load_image Loading pictures
/// \brief Optional (stb_image): PNG, JPEG, BMP, and no others, since a reader of a rare
/// format is where a damaged file does harm.
/// \{

namespace detail {

/// The largest file that load_image() takes, in bytes.
inline constexpr std::size_t max_image_file = std::size_t(1) << 27;

/// The most pixels that it takes: 8192 x 4096.
inline constexpr int max_image_pixels = 1 << 25;

// The number in four bytes of a PNG file, the highest first.
inline std::uint32_t png_number(const Bytes& file, std::size_t at) noexcept {
    return std::uint32_t(file[at]) << 24 | std::uint32_t(file[at + 1]) << 16 |
           std::uint32_t(file[at + 2]) << 8 | std::uint32_t(file[at + 3]);
}

// The sum, CRC-32, that ends each chunk of a PNG file: of its name and its bytes.
inline std::uint32_t png_sum(const Bytes& file, std::size_t first, std::size_t last) {
    static constexpr auto table = [] {
        std::array<std::uint32_t, 256> sums{};
        for (std::uint32_t i = 0; i < 256; ++i) {
            sums[i] = i;
            for (int bit = 0; bit < 8; ++bit)
                sums[i] = sums[i] >> 1 ^ (sums[i] & 1u ? 0xedb88320u : 0u);
        }
        return sums;
    }();
    std::uint32_t sum = 0xffffffffu;
    for (std::size_t i = first; i < last; ++i)
        sum = table[(sum ^ file[i]) & 255u] ^ sum >> 8;
    return ~sum;
}

// What is wrong with a PNG file, which stb_image does not ask: the chunks must follow
// one another up to IEND, each with its own sum.
inline const char* png_trouble(const Bytes& file) {
    for (std::size_t at = 8; file.size() - at >= 12;) {
        const std::size_t size = png_number(file, at);
        if (size > file.size() - at - 12) return "it ends in the middle of a chunk";
        if (png_number(file, at + 8 + size) != png_sum(file, at + 4, at + 8 + size))
            return "the sum of a chunk is wrong";
        if (png_number(file, at + 4) == 0x49454e44u) return nullptr; // IEND
        at += 12 + size;
    }
    return "it ends before its last chunk";
}

// A byte of a file; 0 behind its end, as stb_image has it.
inline std::size_t byte_at(const Bytes& file, std::size_t at) {
    return at < file.size() ? std::size_t(file[at]) : std::size_t(0);
}

// Whether stb_image may read the tables of a JPEG file whose length stands at `at`: it
// has room for 256 entries, does not count them, and takes number 255 for none. Notes
// the tables in `there`: bit n is number n for DC, bit 16 + n for AC.
inline bool good_huffman_tables(const Bytes& file, std::size_t at,
                                std::uint32_t& there) {
    const auto byte = [&](std::size_t i) { return byte_at(file, i); };
    auto left = static_cast<long long>(byte(at) * 256 + byte(at + 1)) - 2;
    for (at += 2; left > 0;) {
        std::size_t entries = 0;
        for (std::size_t i = 1; i <= 16; ++i) entries += byte(at + i);
        if (entries > 255) return false;
        there |= std::uint32_t{1} << (byte(at) & 31u);
        at += 17 + entries;
        left -= static_cast<long long>(17 + entries);
    }
    return true;
}

// Whether a scan whose length stands at `at` finds its tables: stb_image reads whatever
// is in the place of one that no file has filled.
inline bool finds_tables(const Bytes& file, std::size_t at, bool progressive,
                         std::uint32_t there) {
    const std::size_t components = byte_at(file, at + 2);
    const std::size_t behind = at + 3 + 2 * components;
    const bool begins_at_dc = byte_at(file, behind) == 0;
    const bool refines = byte_at(file, behind + 2) >> 4 != 0;
    const bool asks_dc = !progressive || (begins_at_dc && !refines);
    const bool asks_ac = !progressive || !begins_at_dc;
    for (std::size_t i = 0; i < components; ++i) {
        const std::size_t numbers = byte_at(file, at + 4 + 2 * i);
        if (asks_dc && (there >> (numbers >> 4) & 1u) == 0) return false;
        if (asks_ac && (there >> (16 + (numbers & 15u)) & 1u) == 0) return false;
    }
    return true;
}

// What is wrong with a JPEG file, which stb_image does not ask.
inline const char* jpeg_trouble(const Bytes& file) {
    std::uint32_t there = 0; // tables
    bool progressive = false;
    bool coded = false; // from the first coded pixels on a table may stand anywhere
    for (std::size_t at = 2; file.size() - at >= 4;) {
        const unsigned char kind = file[at + 1];
        if (file[at] != 0xff || kind == 0xff ||
            (coded && kind != 0xc4 && kind != 0xda)) {
            ++at;
            continue;
        }
        if (kind == 0xc4 && !good_huffman_tables(file, at + 2, there))
            return "a table has more than 255 entries";
        progressive = progressive || kind == 0xc2;
        if (kind == 0xda && !finds_tables(file, at + 2, progressive, there))
            return "a scan uses a table that is not there";
        coded = coded || kind == 0xda;
        at += coded ? 2 : 2 + std::size_t(file[at + 2]) * 256 + file[at + 3];
        if (at > file.size()) break;
    }
    return nullptr;
}

#ifdef LJUS_HAS_STB_IMAGE
// A picture as a file has it: sRGB, three bytes per pixel.
struct DecodedBytes {
    int width = 0, height = 0;
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
    const auto require_size = [&](long long wide, long long high) {
        if (wide < 1 || high < 1 || wide > max_image_pixels / high)
            refuse(join({"has ", to_text(wide), " x ", to_text(high),
                         " pixels; there must be 1 to ", to_text(max_image_pixels)}));
    };
    // Of a PNG file that is too large for it stb_image says that it is none.
    if (png && png_number(bytes, 12) == 0x49484452u)
        require_size(png_number(bytes, 16), png_number(bytes, 20));
    DecodedBytes picture;
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

/// A picture from the bytes of a file.
/// \param bytes  The file.
/// \param path   What messages call it.
/// \return Linear colours in [0, 1]; a transparent file's own, without its alpha.
/// \throws std::runtime_error  with path and reason, if it is no picture.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> decode_image(const Bytes& bytes, const std::string& path) {
    const auto refuse = [&](std::string_view why) {
        throw std::runtime_error(join({shown_path(path), " ", why, "."}));
    };
#ifdef LJUS_HAS_STB_IMAGE
    const DecodedBytes picture = decode_bytes(bytes, refuse);
    std::array<T, 256> linear{};
    for (std::size_t i = 0; i < 256; ++i)
        linear[i] = static_cast<T>(srgb_decode(static_cast<double>(i) / 255.0));
    ImageT<T> image = make_image<T>(picture.width, picture.height);
    const stbi_uc* next = picture.pixels.get();
    for (RgbT<T>& color : image.pixels)
        for (T* const channel : {&color.x, &color.y, &color.z})
            *channel = linear[*next++];
    return image;
#else
    (void)bytes;
    refuse("cannot be read: this program was made without stb_image.h");
    return {};
#endif
}

} // namespace detail

/// Loads a picture, for a texture.
/// \param path  The file.
/// \return Linear colours in [0, 1].
/// \throws std::runtime_error  with path and reason.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> load_image(const std::string& path) {
    return detail::decode_image<T>(load_file(path, detail::max_image_file), path);
}

/// \}

} // namespace ljus
