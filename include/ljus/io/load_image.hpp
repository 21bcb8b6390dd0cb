#pragma once

/// \file ljus/io/load_image.hpp
/// \brief Pictures from PNG, JPEG and other files of 8 bits, made linear.
///
/// The decoding is done by stb_image, whose implementation this header makes for
/// itself, invisible to other files, as png.hpp does for the writer. A program with its
/// own implementation in the *same* file includes that one first. Without stb_image no
/// picture can be read, which is said when one is asked for.

#if defined(STBI_INCLUDE_STB_IMAGE_H)
#define LJUS_HAS_STB_IMAGE 1 // the program's own
#elif __has_include(<stb/stb_image.h>)
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
#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#undef STB_IMAGE_STATIC
#undef STB_IMAGE_IMPLEMENTATION
#if defined(__GNUC__)
#pragma GCC diagnostic pop
#elif defined(_MSC_VER)
#pragma warning(pop)
#endif
#endif

#include <cstddef>
#include <memory>
#include <stdexcept>
#include <string>

#include "ljus/image/color.hpp"
#include "ljus/image/image.hpp"
#include "ljus/io/file.hpp"

namespace ljus {

/// \defgroup load_image Loading pictures
/// \brief Optional (stb_image): PNG, JPEG, BMP, TGA, GIF, PNM.
/// \{

namespace detail {

/// The largest file that load_image() takes, in bytes.
inline constexpr std::size_t max_image_file = std::size_t(1) << 28;

/// A picture from the bytes of a file.
/// \param bytes  The file.
/// \param path   What messages call it.
/// \return Linear colours in [0, 1]; a transparent file's own, without its alpha.
/// \throws std::runtime_error  with path and reason, if it is no picture.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> decode_image(const Bytes& bytes, const std::string& path) {
#ifdef LJUS_HAS_STB_IMAGE
    int width = 0;
    int height = 0;
    int channels = 0;
    const auto* data = reinterpret_cast<const stbi_uc*>(bytes.data());
    const auto size = static_cast<int>(bytes.size());
    if (!stbi_info_from_memory(data, size, &width, &height, &channels))
        throw std::runtime_error(
            detail::shown_path(path).append(" is no picture that can be read: ") +
            stbi_failure_reason() + ".");
    if (width < 1 || height < 1)
        throw std::runtime_error(detail::shown_path(path).append(" has no pixels."));
    if (width > detail::max_pixels / height)
        throw std::runtime_error(detail::shown_path(path).append(" has more than ") +
                                 std::to_string(detail::max_pixels) + " pixels.");
    const std::unique_ptr<stbi_uc, void (*)(void*)> pixels(
        stbi_load_from_memory(data, size, &width, &height, &channels, 3),
        stbi_image_free);
    if (!pixels)
        throw std::runtime_error(detail::shown_path(path).append(" is damaged: ") +
                                 stbi_failure_reason() + ".");

    ImageT<T> image = make_image<T>(width, height);
    const auto linear = [&](std::size_t i) {
        return static_cast<T>(srgb_decode(pixels.get()[i] / 255.0));
    };
    for (std::size_t i = 0; i < image.pixels.size(); ++i)
        image.pixels[i] = {linear(3 * i), linear(3 * i + 1), linear(3 * i + 2)};
    return image;
#else
    (void)bytes;
    throw std::runtime_error(detail::shown_path(path).append(
        " cannot be read: this program was made without stb_image.h."));
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
