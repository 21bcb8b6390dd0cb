#pragma once

/// \file ljus/image/image.hpp
/// \brief An image: a rectangle of linear colours; and layers, which are named images.

#include <algorithm>
#include <cassert>
#include <concepts>
#include <cstddef>
#include <cstdio>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup image Images
/// \brief The result of a renderer: linear radiance, without exposure or encoding.
/// \{

/// The largest number of pixels of an image: 2^28, three gigabytes in float.
inline constexpr long long max_pixels = 1LL << 28;

/// A rectangle of linear colours; see make_image().
template <std::floating_point T>
struct ImageT {
    int width = 0;  ///< Pixels per row.
    int height = 0; ///< Number of rows.
    /// The pixels, row by row from the top left; (x, y) has the index y * width + x.
    std::vector<RgbT<T>> pixels;
};
using Image = ImageT<float>; ///< ImageT in float.

/// Requires a valid image size.
/// \throws std::invalid_argument  unless width and height are at least 1 and their
///         product is at most max_pixels.
inline void require_image_size(long long width, long long height) {
    // The division avoids an overflow of the product.
    if (width >= 1 && height >= 1 && width <= max_pixels / height) return;
    char text[160];
    std::snprintf(text, sizeof text,
                  "The image's size is %lld x %lld; width and height must be at least "
                  "1, and their product at most %lld.",
                  width, height, max_pixels);
    throw std::invalid_argument(text);
}

/// Makes an image of one colour, which is black by default.
/// \throws std::invalid_argument  as require_image_size(), before memory is allocated.
template <std::floating_point T = float>
[[nodiscard]] ImageT<T> make_image(int width, int height,
                                   RgbT<T> fill = RgbT<T>(T(0))) {
    require_image_size(width, height);
    const auto count =
        static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    return {.width = width, .height = height, .pixels = {count, fill}};
}

/// Requires that an image has width * height pixels.
/// \throws std::invalid_argument  if the number of pixels differs, or as
///         require_image_size().
template <std::floating_point T>
void check(const ImageT<T>& image) {
    require_image_size(image.width, image.height);
    const long long count = static_cast<long long>(image.width) * image.height;
    if (static_cast<long long>(image.pixels.size()) == count) return;
    char text[128];
    std::snprintf(text, sizeof text,
                  "The image has %zu pixels; its size, %d x %d, requires %lld.",
                  image.pixels.size(), image.width, image.height, count);
    throw std::invalid_argument(text);
}

namespace detail {

template <std::floating_point T, std::floating_point U>
void require_same_size(const ImageT<T>& image, const ImageT<U>& reference) {
    check(image);
    check(reference);
    if (image.width == reference.width && image.height == reference.height) return;
    char text[128];
    std::snprintf(text, sizeof text,
                  "The image's size is %d x %d; the reference has %d x %d.",
                  image.width, image.height, reference.width, reference.height);
    throw std::invalid_argument(text);
}

template <std::floating_point T>
[[nodiscard]] std::size_t pixel_index(const ImageT<T>& image, int x, int y) noexcept {
    assert(x >= 0 && x < image.width && "x is a column of the image");
    assert(y >= 0 && y < image.height && "y is a row of the image");
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
           static_cast<std::size_t>(x);
}

} // namespace detail

/// The colour of pixel (x, y), for writing: column x from the left, in [0, width), and
/// row y from the top, in [0, height).
template <std::floating_point T>
[[nodiscard]] RgbT<T>& pixel(ImageT<T>& image, int x, int y) noexcept {
    return image.pixels[detail::pixel_index(image, x, y)];
}

/// The colour of pixel (x, y), for reading.
template <std::floating_point T>
[[nodiscard]] const RgbT<T>& pixel(const ImageT<T>& image, int x, int y) noexcept {
    return image.pixels[detail::pixel_index(image, x, y)];
}

/// Requires that the image of a light has radiances that are finite and at least 0, and
/// not all black. `what` is the name of the image, for the message.
/// \throws std::invalid_argument  as check(); if a pixel is negative or not finite,
///         with its column and row; or if all pixels are black.
template <std::floating_point T>
void require_radiance(std::string_view what, const ImageT<T>& image) {
    check(image);
    bool black = true;
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) {
            const RgbT<T>& c = pixel(image, x, y);
            if (!(is_finite(c) && c.x >= T(0) && c.y >= T(0) && c.z >= T(0)))
                detail::refuse(
                    detail::join({what, ", column ", to_text(static_cast<long long>(x)),
                                  ", row ", to_text(static_cast<long long>(y))}),
                    c, "finite and at least 0 in every channel");
            black = black && is_black(c);
        }
    if (black)
        throw std::invalid_argument(detail::join(
            {what, " is black in every pixel; leave such a light out of the scene."}));
}

/// The image of the means of square blocks with sides of `size` pixels, at least 1. If
/// the width or height is no multiple of the size, the blocks of the last column or row
/// are narrower.
/// \return An image of ceil(width/size) x ceil(height/size), in double.
/// \throws std::invalid_argument  as check(image), or for a size below 1.
template <std::floating_point T>
[[nodiscard]] ImageT<double> block_means(const ImageT<T>& image, int size = 10) {
    check(image);
    require_at_least("the side of a block", size, 1);
    const auto blocks = [size](int n) { return n / size + (n % size != 0 ? 1 : 0); };
    auto means = make_image<double>(blocks(image.width), blocks(image.height));
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            pixel(means, x / size, y / size) += RgbT<double>(pixel(image, x, y));
    for (int y = 0; y < means.height; ++y)
        for (int x = 0; x < means.width; ++x) {
            const int columns = std::min(size, image.width - x * size);
            const int rows = std::min(size, image.height - y * size);
            pixel(means, x, y) /= static_cast<double>(columns) * rows;
        }
    return means;
}

/// \}

/// \defgroup layer Layers
/// \brief A layer holds other values for the pixels of a picture: normals, depths, or
/// the light of some paths. An EXR file can contain many layers; see \ref exr.
/// \{

/// One layer of a picture.
template <std::floating_point T>
struct LayerT {
    std::string name{}; ///< The name, e.g. "albedo"; empty for the picture itself.
    /// The names of three channels, or of one.
    std::vector<std::string> channels{"R", "G", "B"};
    ImageT<T> image{}; ///< The values. A single channel is repeated in all three.
};
using Layer = LayerT<float>; ///< LayerT in float.

/// The full name in OpenEXR of the channel with this index: "albedo.R", or "Z" in a
/// layer without a name.
template <std::floating_point T>
[[nodiscard]] std::string channel_name(const LayerT<T>& layer, std::size_t channel) {
    const std::string& own = layer.channels[channel];
    return layer.name.empty() ? own : layer.name + "." + own;
}

/// \}

} // namespace ljus
