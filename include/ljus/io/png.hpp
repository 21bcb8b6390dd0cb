#pragma once

/// \file ljus/io/png.hpp
/// \brief Saves pictures for a screen, as PNG files in sRGB with 8 bits per channel.
///
/// This header compiles stb_image_write, hidden from other files. A program that
/// compiles stb_image_write in the *same* file must include stb_image_write before this
/// header, or define `LJUS_NO_STB` to switch PNG off.

#include <cmath>
#include <concepts>
#include <cstddef>
#include <stdexcept>
#include <string>

#include "ljus/io/detail/stb_memory.hpp"

#if !defined(LJUS_NO_STB)
#if defined(INCLUDE_STB_IMAGE_WRITE_H)
#define LJUS_HAS_STB 1 // the program's own
#elif __has_include(<stb/stb_image_write.h>) || __has_include(<stb_image_write.h>)
#define LJUS_HAS_STB 1
#if defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wsign-conversion"
#pragma GCC diagnostic ignored "-Wold-style-cast"
#pragma GCC diagnostic ignored "-Wcast-qual"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wunused-function"
#pragma GCC diagnostic ignored "-Wmissing-field-initializers"
#pragma GCC diagnostic ignored "-Wdeprecated-declarations"
#elif defined(_MSC_VER)
#pragma warning(push, 0)
#pragma warning(disable : 4505 4996)
#endif
#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBIW_MALLOC(size) ljus::detail::StbMemory::resize(nullptr, size)
#define STBIW_REALLOC(memory, size) ljus::detail::StbMemory::resize(memory, size)
#define STBIW_FREE(memory) ljus::detail::StbMemory::release(memory)
#if __has_include(<stb/stb_image_write.h>)
#include <stb/stb_image_write.h>
#else
#include <stb_image_write.h>
#endif
#undef STB_IMAGE_WRITE_STATIC
#undef STB_IMAGE_WRITE_IMPLEMENTATION
#undef STBIW_MALLOC
#undef STBIW_REALLOC
#undef STBIW_REALLOC_SIZED
#undef STBIW_FREE
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#elif defined(_MSC_VER)
#pragma warning(pop)
#endif
#endif
#endif

#include "ljus/image/color.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/file_beside.hpp"

namespace ljus {

/// \defgroup png PNG
/// \brief PNG files hold a picture for the screen. HDR and PFM files keep the radiance.
/// \{

/// The settings of save_png().
struct PngSettings {
    double exposure = 0.0; ///< Exposure in stops, finite; +1 doubles the light.
};

/// Encodes an image as PNG: 8 bits per channel, sRGB. NaN and negative channels become
/// 0, and channels that exceed 1 after exposure become 255.
/// \throws std::invalid_argument  for an image without pixels or an exposure that is
///         not finite; std::bad_alloc if there is not enough memory.
template <std::floating_point T>
[[nodiscard]] Bytes encode_png(const ImageT<T>& image,
                               const PngSettings& options = {}) {
#ifdef LJUS_HAS_STB
    check(image);
    require(std::isfinite(options.exposure), "the exposure of a PNG file",
            options.exposure, "a finite number of stops");
    const double scale = std::exp2(options.exposure);
    Bytes screen(image.pixels.size() * 3);
    std::size_t next = 0;
    for (const RgbT<T>& c : image.pixels)
        for (const T channel : {c.x, c.y, c.z})
            screen[next++] = srgb_byte(scale * static_cast<double>(channel));

    Bytes file;
    const detail::StbMemory memory;
    const auto append = [](void* context, void* data, int size) {
        const auto* bytes = static_cast<const unsigned char*>(data);
        Bytes& whole = *static_cast<Bytes*>(context);
        whole.insert(whole.end(), bytes, bytes + size);
    };
    if (stbi_write_png_to_func(append, &file, image.width, image.height, 3,
                               screen.data(), 3 * image.width) == 0)
        throw std::runtime_error(
            detail::join({"PNG: no memory for an image of ", to_text(image.width),
                          " x ", to_text(image.height), " pixels."}));
    return file;
#elif defined(LJUS_NO_STB)
    static_assert(sizeof(T) == 0, "LJUS_NO_STB switches PNG off: save a .pfm or .hdr "
                                  "file, or remove the definition.");
    return (void(image), void(options), Bytes{});
#else
    static_assert(
        sizeof(T) == 0,
        "PNG needs stb_image_write.h: apt-get install libstb-dev, or put it on "
        "the include path.");
    return (void(image), void(options), Bytes{});
#endif
}

/// Saves an image as PNG.
/// \throws std::invalid_argument  as encode_png(); std::runtime_error as save_file().
template <std::floating_point T>
[[gnu::cold]] void save_png(const ImageT<T>& image, const std::string& path,
                            const PngSettings& options = {}) {
    save_file(path, encode_png(image, options));
}

/// \}

} // namespace ljus
