#pragma once

/// \file ljus/image/flip.hpp
/// \brief FLIP: how different two pictures look to a viewer who flips between them.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sum.hpp"

namespace ljus {

/// \defgroup flip FLIP
/// \brief Footnote 1 of the report: "all we really need is to make the results look
/// real". FLIP measures how visible a difference is \cite andersson2020. Chapter:
/// \ref ch_light_transport.
/// \{

namespace detail {

/// The contributions of red, green and blue, with the primaries of Rec. 709, to X, Y
/// and Z, in units of the white point. Each row adds up to 1.
inline constexpr Vec3T<double> xyz_weights[3] = {
    Vec3T<double>{10135552, 8788810, 4435075} / 23359437.0,
    Vec3T<double>{2613072, 8788810, 887015} / 12288897.0,
    Vec3T<double>{1425312, 8788810, 70074185} / 80288307.0};

/// The XYZ coordinates of a linear sRGB colour, in units of the white point D65.
[[nodiscard]] inline Vec3T<double> xyz_over_white(const RgbT<double>& c) noexcept {
    return {glm::dot(xyz_weights[0], c), glm::dot(xyz_weights[1], c),
            glm::dot(xyz_weights[2], c)};
}

/// The inverse of xyz_over_white().
[[nodiscard]] inline RgbT<double> rgb_of(const Vec3T<double>& xyz) noexcept {
    // Cramer's rule: cross products of two rows over the determinant.
    const auto& [x, y, z] = xyz_weights;
    const Vec3T<double> yz = glm::cross(y, z);
    return (xyz.x * yz + xyz.y * glm::cross(z, x) + xyz.z * glm::cross(x, y)) /
           glm::dot(x, yz);
}

/// Converts a linear sRGB colour to YCxCz: lightness, red-green and blue-yellow. The
/// channels are linear in light, so that they can be blurred.
/// \return 116 Y - 16, 500 (X - Y) and 200 (Y - Z), with X, Y and Z in units of white.
[[nodiscard]] inline Vec3T<double> opponent(const RgbT<double>& c) noexcept {
    const Vec3T<double> white = xyz_over_white(c);
    return {116 * white.y - 16, 500 * (white.x - white.y), 200 * (white.y - white.z)};
}

/// Converts YCxCz to a linear sRGB colour.
[[nodiscard]] inline RgbT<double> rgb_of_opponent(const Vec3T<double>& c) noexcept {
    const double y = (c.x + 16) / 116;
    return rgb_of({y + c.y / 500, y, y - c.z / 200});
}

/// Converts a linear sRGB colour to L*, and a* and b* multiplied by L*/100. This is the
/// Hunt effect: dark colours look less colourful.
[[nodiscard]] inline Vec3T<double> hunt_lab(const RgbT<double>& c) noexcept {
    const auto root = [](double t) {
        constexpr double d = 6.0 / 29;
        return t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.0 / 29;
    };
    const Vec3T<double> white = xyz_over_white(c);
    const double x = root(white.x), y = root(white.y), z = root(white.z);
    const double lightness = 116 * y - 16;
    return {lightness, 0.01 * lightness * 500 * (x - y),
            0.01 * lightness * 200 * (y - z)};
}

/// The HyAB distance of two L*a*b* colours, which suits large differences. It is the
/// difference in L* plus the Euclidean distance in a* and b*.
[[nodiscard]] inline double hyab(const Vec3T<double>& a,
                                 const Vec3T<double>& b) noexcept {
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// One Gaussian of a contrast sensitivity function: a sqrt(pi / b) exp(-pi^2 x^2 / b),
/// where x is the distance in degrees.
struct EyeGaussian {
    double a; ///< The weight.
    double b; ///< The variance times 2 pi^2, in square degrees.
};

/// The filters that blur lightness, red-green and blue-yellow \cite andersson2020. Each
/// is a sum of two Gaussians.
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

/// Convolves one channel of an image along x and along y. Outside the image, the pixels
/// of the border are repeated.
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

/// Converts a linear sRGB picture to YCxCz. Channels are clamped to [0, 1] first, as on
/// a screen; NaN becomes black.
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

/// The distance, in pixels, up to which other pixels influence a pixel's FLIP, for
/// `ppd` pixels per degree of the visual field. It is three standard deviations of the
/// widest Gaussian among the filters of FLIP.
[[nodiscard]] inline int eye_radius(double ppd) noexcept {
    return static_cast<int>(
        std::ceil(3 * std::sqrt(0.04 / 2) / std::numbers::pi * ppd));
}

template <std::floating_point T>
void copy_part(const ImageT<T>& from, int x, int y, int width, int height,
               ImageT<T>& to, int to_x, int to_y) {
    for (int row = 0; row < height; ++row)
        std::copy_n(&pixel(from, x, y + row), width, &pixel(to, to_x, to_y + row));
}

/// Makes an error map of two pictures of the same size tile by tile, so that
/// intermediate results need memory for one tile only. Each tile includes a margin of
/// eye_radius() pixels. The map is therefore the same as without tiles.
/// `make(image, reference)` returns the error map of a tile of both pictures.
/// \throws std::invalid_argument  if the sizes differ, or ppd is not within [1, 1000].
template <std::floating_point T, std::floating_point U, typename Make>
[[nodiscard]] ImageT<double> map_by_tiles(const ImageT<T>& image,
                                          const ImageT<U>& reference, double ppd,
                                          Make make) {
    require_same_size(image, reference);
    require(ppd >= 1 && ppd <= 1000, "pixels per degree", ppd, "from 1 to 1000");
    const int around = eye_radius(ppd), side = std::max(512, 8 * around);
    const int most = side + 2 * around; // of a tile with its margin
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

/// Converts a picture from YCxCz to what a viewer sees, in linear sRGB: each channel is
/// blurred by the eye's contrast sensitivity.
[[nodiscard]] inline ImageT<double> eye_filtered(const ImageT<double>& image,
                                                 double ppd) {
    constexpr double pi = std::numbers::pi;
    const int radius = eye_radius(ppd);
    ImageT<double> seen = make_image<double>(image.width, image.height);
    for (int channel = 0; channel < 3; ++channel) {
        double total = 0;
        for (const auto& [a, b] : eye_gaussians[channel]) {
            if (a == 0) continue;
            const Weights gaussian = weights_of(radius, [&, breadth = b](double i) {
                return std::exp(-pi * pi * i * i / (ppd * ppd * breadth));
            });
            double sum = 0;
            for (const double weight : gaussian) sum += weight;
            const double share = a * std::sqrt(pi / b);
            total += share * sum * sum;
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

/// The strengths of edges and of points at each pixel of a YCxCz picture. They are the
/// lengths of the first and the second derivative of lightness, smoothed by a Gaussian
/// as wide as the eye's edge detector, 0.082 degrees.
/// \return Edges in the first channel, points in the second.
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
        // Lightness ranges over 116 units, from -16 to 100.
        for (std::size_t i = 0; i < x.size(); ++i)
            found.pixels[i][kind] = std::hypot(x[i], y[i]) / 116;
    }
    return found;
}

/// The number of pixels per degree of the visual field, 67.0 for the defaults.
/// \param distance  From the eye to the screen, in metres.
/// \param width     Width of the screen, in metres.
/// \param pixels    Pixels along the width.
[[nodiscard]] constexpr double pixels_per_degree(double distance = 0.7,
                                                 double width = 0.7,
                                                 double pixels = 3840) noexcept {
    return distance * pixels / width * std::numbers::pi / 180;
}

/// The perceived difference of two linear sRGB colours, without their surroundings. The
/// HyAB distance is raised to the power 0.7. The largest result, that of pure green and
/// pure blue, is mapped to 1. Results up to 0.4 of the largest are mapped linearly to
/// [0, 0.95], and larger ones linearly to [0.95, 1].
[[nodiscard]] inline double color_error(const RgbT<double>& a, const RgbT<double>& b) {
    const auto powered = [](const RgbT<double>& p, const RgbT<double>& q) {
        return std::pow(hyab(hunt_lab(p), hunt_lab(q)), 0.7);
    };
    static const double most = powered({0, 1, 0}, {0, 0, 1});
    const double bend = 0.4 * most;
    const double error = powered(a, b);
    return error < bend ? 0.95 * error / bend
                        : 0.95 + 0.05 * (error - bend) / (most - bend);
}

// flip_map() of a picture, or of a part of one.
// [flip_map]
template <std::floating_point T, std::floating_point U>
[[nodiscard]] ImageT<double> flip_tile(const ImageT<T>& image,
                                       const ImageT<U>& reference, double ppd) {
    const ImageT<double> a = opponent_image(image), b = opponent_image(reference);
    const ImageT<double> seen_a = eye_filtered(a, ppd), seen_b = eye_filtered(b, ppd);
    const ImageT<double> features_a = features(a, ppd), features_b = features(b, ppd);

    ImageT<double> map = make_image<double>(image.width, image.height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const double color = color_error(seen_a.pixels[i], seen_b.pixels[i]);
        const RgbT<double> change = features_a.pixels[i] - features_b.pixels[i];
        const double larger = glm::max(std::abs(change.x), std::abs(change.y));
        const double feature = std::sqrt(larger / std::numbers::sqrt2);
        map.pixels[i] = RgbT<double>(std::pow(color, 1 - feature));
    }
    return map;
}
// [flip_map]

[[nodiscard]] inline double mean_of(const ImageT<double>& map) {
    std::vector<double> values;
    values.reserve(map.pixels.size());
    for (const RgbT<double>& value : map.pixels) values.push_back(value.x);
    return pairwise_sum(values) / static_cast<double>(values.size());
}

} // namespace detail

/// FLIP of each pixel: how visible the change of the pixel is to a viewer who flips
/// between two pictures of the same size. They are linear sRGB, clamped to [0, 1] as on
/// a screen. `ppd` is the number of pixels per degree of the visual field, by default
/// that of 3840 pixels on a screen as wide as the eye is far. Before colours are
/// compared, detail that is too fine for the eye is blurred. Where only one picture has
/// an edge or a point, the colour difference is raised to a power below 1, which makes
/// it larger.
/// \return A grey image in [0, 1]; 0 where no difference is visible.
/// \throws std::invalid_argument  if the sizes differ, or ppd is not within [1, 1000].
/// \cost Proportional to the number of pixels times ppd.
/// \cite andersson2020
template <std::floating_point T, std::floating_point U>
[[nodiscard]] ImageT<double> flip_map(const ImageT<T>& image,
                                      const ImageT<U>& reference,
                                      double ppd = detail::pixels_per_degree()) {
    return detail::map_by_tiles(image, reference, ppd,
                                [ppd](const auto& tile, const auto& reference_tile) {
                                    return detail::flip_tile(tile, reference_tile, ppd);
                                });
}

/// The mean of flip_map().
///
/// *Trap*: FLIP is valid for pictures shown alternately in the same position on a
/// screen, for one viewing distance and one exposure. The FLIP values of several errors
/// cannot be added.
/// \return A number in [0, 1]; exchanging the two pictures does not change it.
/// \throws std::invalid_argument  as flip_map().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double flip(const ImageT<T>& image, const ImageT<U>& reference,
                          double ppd = detail::pixels_per_degree()) {
    return detail::mean_of(flip_map(image, reference, ppd));
}

/// \}

} // namespace ljus
