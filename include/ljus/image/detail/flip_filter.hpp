#pragma once

/// \file ljus/image/detail/flip_filter.hpp
/// \brief FLIP's model of the eye: it blurs, and detects edges and points.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/image/detail/flip_color.hpp"

namespace ljus {

/// \addtogroup flip
/// \{

namespace detail {

/// One Gaussian of a contrast sensitivity function: a sqrt(pi / b) exp(-pi^2 x^2 / b),
/// with x in degrees.
struct EyeGaussian {
    double a; ///< Weight.
    double b; ///< Width, in square degrees.
};

/// The blur of lightness, red-green and blue-yellow: a sum of two Gaussians each
/// \cite andersson2020.
inline constexpr EyeGaussian eye_gaussians[3][2] = {
    {{1, 0.0047}, {0, 1e-5}}, {{1, 0.0053}, {0, 1e-5}}, {{34.1, 0.04}, {13.5, 0.025}}};

/// The weights of a filter, from -radius to radius.
using Weights = std::vector<double>;

/// The values f(-radius), ..., f(radius) of a function.
template <typename F>
[[nodiscard]] Weights weights_of(int radius, F f) {
    Weights weights;
    for (int i = -radius; i <= radius; ++i) weights.push_back(f(double(i)));
    return weights;
}

/// Scales weights so that the positive ones add up to 1 and the negative ones to -1.
inline void make_unit(Weights& weights) noexcept {
    double positive = 0, negative = 0;
    for (const double weight : weights) (weight > 0 ? positive : negative) += weight;
    for (double& weight : weights) weight /= weight > 0 ? positive : -negative;
}

/// Convolves one channel of an image along x and along y; pixels at the border are
/// repeated outside.
[[nodiscard]] inline std::vector<double> blurred(const ImageT<double>& image,
                                                 int channel, const Weights& along_x,
                                                 const Weights& along_y) {
    const int width = image.width, height = image.height;
    const auto radius_x = static_cast<int>(along_x.size() / 2);
    const auto radius_y = static_cast<int>(along_y.size() / 2);
    std::vector<double> rows(image.pixels.size()), result(rows.size());
    const auto at = [width](int x, int y) {
        return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
               static_cast<std::size_t>(x);
    };
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int i = -radius_x; i <= radius_x; ++i)
                rows[at(x, y)] +=
                    along_x[static_cast<std::size_t>(i + radius_x)] *
                    pixel(image, glm::clamp(x + i, 0, width - 1), y)[channel];
    for (int y = 0; y < height; ++y)
        for (int i = -radius_y; i <= radius_y; ++i) {
            const double weight = along_y[static_cast<std::size_t>(i + radius_y)];
            const int row = glm::clamp(y + i, 0, height - 1);
            for (int x = 0; x < width; ++x)
                result[at(x, y)] += weight * rows[at(x, row)];
        }
    return result;
}

/// Converts a picture to YCxCz, clamped to [0, 1] of sRGB as on a screen; NaN is black.
template <std::floating_point T>
[[nodiscard]] ImageT<double> opponent_image(const ImageT<T>& image) {
    ImageT<double> result = make_image<double>(image.width, image.height);
    const auto shown = [](T x) { return x > T(0) ? glm::min(double(x), 1.0) : 0.0; };
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        const RgbT<T>& c = image.pixels[i];
        result.pixels[i] = opponent({shown(c.x), shown(c.y), shown(c.z)});
    }
    return result;
}

/// How many pixels away a pixel still counts: three standard deviations of the widest
/// Gaussian of the eye; the one that finds edges is narrower.
[[nodiscard]] inline int eye_radius(double ppd) noexcept {
    return static_cast<int>(
        std::ceil(3 * std::sqrt(0.04 / 2) / std::numbers::pi * ppd));
}

/// Copies a rectangle of one image into another image.
template <std::floating_point T>
void copy_part(const ImageT<T>& from, int x, int y, int width, int height,
               ImageT<T>& to, int to_x, int to_y) {
    for (int row = 0; row < height; ++row)
        std::copy_n(&pixel(from, x, y + row), width, &pixel(to, to_x, to_y + row));
}

/// Makes a map of two pictures tile by tile, so that what is kept of a pixel on the way
/// is kept in one tile only. The map is that of both pictures at once, because a tile
/// comes with all pixels around it that count.
/// \param make  make(image, reference) returns the map of a part of both pictures.
template <std::floating_point T, std::floating_point U, typename Make>
[[nodiscard]] ImageT<double> map_by_tiles(const ImageT<T>& image,
                                          const ImageT<U>& reference, double ppd,
                                          Make make) {
    const int around = eye_radius(ppd), side = std::max(512, 8 * around);
    const int most = side + 2 * around; // of a tile with what is around it
    if (image.width <= most && image.height <= most) return make(image, reference);
    ImageT<double> map = make_image<double>(image.width, image.height);
    for (int top = 0; top < map.height; top += side)
        for (int left = 0; left < map.width; left += side) {
            const int x = std::max(left - around, 0), y = std::max(top - around, 0);
            const int width = std::min(side, map.width - left);
            const int height = std::min(side, map.height - top);
            const auto part = [&]<std::floating_point V>(const ImageT<V>& whole) {
                auto result =
                    make_image<V>(std::min(left + width + around, map.width) - x,
                                  std::min(top + height + around, map.height) - y);
                copy_part(whole, x, y, result.width, result.height, result, 0, 0);
                return result;
            };
            copy_part(make(part(image), part(reference)), left - x, top - y, width,
                      height, map, left, top);
        }
    return map;
}

/// A picture as a distant viewer sees it: each channel is blurred by the eye's contrast
/// sensitivity.
/// \return Linear sRGB within [0, 1].
/// \cite andersson2020
[[nodiscard]] inline ImageT<double> eye_filtered(const ImageT<double>& image,
                                                 double ppd) {
    constexpr double pi = std::numbers::pi;
    const int radius = eye_radius(ppd);
    ImageT<double> seen = make_image<double>(image.width, image.height);
    for (int channel = 0; channel < 3; ++channel) {
        double total = 0;
        for (const auto& [a, b] : eye_gaussians[channel]) {
            const Weights gaussian = weights_of(radius, [&, breadth = b](double i) {
                return std::exp(-pi * pi * i * i / (ppd * ppd * breadth));
            });
            double sum = 0;
            for (const double weight : gaussian) sum += weight;
            const double share = a * std::sqrt(pi / b);
            total += share * sum * sum;
            if (a == 0) continue;
            const std::vector<double> part =
                blurred(image, channel, gaussian, gaussian);
            for (std::size_t i = 0; i < part.size(); ++i)
                seen.pixels[i][channel] += share * part[i];
        }
        for (Vec3T<double>& c : seen.pixels) c[channel] /= total;
    }
    for (Vec3T<double>& c : seen.pixels)
        c = glm::clamp(rgb_of_opponent(c), RgbT<double>(0), RgbT<double>(1));
    return seen;
}

/// The strength of edges and points at each pixel: the lengths of the first and second
/// derivative of lightness, smoothed by a Gaussian as wide as the eye's edge detector,
/// 0.082 degrees.
/// \return Edges in the first channel, points in the second.
/// \cite andersson2020
[[nodiscard]] inline ImageT<double> features(const ImageT<double>& image, double ppd) {
    const double deviation = 0.5 * 0.082 * ppd;
    const int radius = static_cast<int>(std::ceil(3 * deviation));
    const auto gaussian = [deviation](double i) {
        return std::exp(-i * i / (2 * deviation * deviation));
    };
    Weights smooth = weights_of(radius, gaussian);
    Weights edge = weights_of(radius, [&](double i) { return -i * gaussian(i); });
    Weights point = weights_of(radius, [&](double i) {
        return (i * i / (deviation * deviation) - 1) * gaussian(i);
    });
    for (Weights* weights : {&smooth, &edge, &point}) make_unit(*weights);

    ImageT<double> found = make_image<double>(image.width, image.height);
    for (int kind = 0; kind < 2; ++kind) {
        const Weights& derivative = kind == 0 ? edge : point;
        const std::vector<double> x = blurred(image, 0, derivative, smooth);
        const std::vector<double> y = blurred(image, 0, smooth, derivative);
        // Lightness runs from -16 to 100; weights that add up to 0 cancel the -16.
        for (std::size_t i = 0; i < x.size(); ++i)
            found.pixels[i][kind] = std::hypot(x[i], y[i]) / 116;
    }
    return found;
}

} // namespace detail

/// \}

} // namespace ljus
