#pragma once

/// \file ljus/image/hdr_flip.hpp
/// \brief FLIP for radiance: the largest difference over a range of exposures.

#include <algorithm>
#include <limits>

#include "ljus/image/color.hpp"
#include "ljus/image/flip.hpp"

namespace ljus {

/// \addtogroup flip
/// \{

namespace detail {

/// The range of exposures of HDR-FLIP.
struct Exposures {
    /// First exposure, in stops: the brightest pixel is nearly white.
    double first = 0;
    double last = 0; ///< Last exposure, in stops: half of the pixels are nearly white.
    int count = 2;   ///< Number of exposures, about one per stop, at least 2.
};

/// The response of a film to light x, by Narkowicz's fit of the ACES curve, without the
/// exposure built into the fit.
/// \return A number in [0, 1]; 0 for NaN and negative x, 0.85 for x = 2.119.
[[nodiscard]] inline double film_curve(double x) noexcept {
    if (!(x > 0)) return 0;
    const double y = std::min(x, 1e100); // its square must not overflow
    return std::min((0.9036 * y * y + 0.018 * y) / (0.8748 * y * y + 0.354 * y + 0.14),
                    1.0);
}

/// The range of exposures at which a picture shows details. film_curve() maps the
/// brightest luminance to 0.85 at the first exposure, and the median luminance to 0.85
/// at the last.
template <std::floating_point T>
[[nodiscard]] Exposures exposures_of(const ImageT<T>& reference) {
    check(reference);
    constexpr double least = std::numeric_limits<float>::epsilon();
    constexpr double most = std::numeric_limits<float>::max();
    std::vector<double> light;
    light.reserve(reference.pixels.size());
    for (const RgbT<T>& c : reference.pixels) {
        const double y = luminance(RgbT<double>(c));
        light.push_back(y > least ? std::min(y, most) : least);
    }
    const auto middle = light.begin() + static_cast<std::ptrdiff_t>(light.size() / 2);
    std::nth_element(light.begin(), middle, light.end());
    const double brightest = *std::max_element(middle, light.end());

    // The light at which the curve is 0.85: the positive root of a quadratic.
    constexpr double a = 0.9036 - 0.85 * 0.8748, b = 0.018 - 0.85 * 0.354,
                     c = -0.85 * 0.14;
    const double bright = (std::sqrt(b * b - 4 * a * c) - b) / (2 * a);
    const double first = std::log2(bright / brightest);
    const double last = std::log2(bright / *middle);
    return {first, last, std::max(2, static_cast<int>(std::ceil(last - first)))};
}

} // namespace detail

/// HDR-FLIP of each pixel: the largest flip_map() over a range of exposures, which the
/// reference alone determines. The pictures are linear sRGB of any brightness; for the
/// exposures, a luminance below 1.2e-7 counts as 1.2e-7.
/// \return A grey image in [0, 1].
/// \throws std::invalid_argument  as flip_map().
/// \cost That of flip_map(), times about the number of stops between the brightest and
///       the median luminance.
/// \cite andersson2021
template <std::floating_point T, std::floating_point U>
[[nodiscard]] ImageT<double> hdr_flip_map(const ImageT<T>& image,
                                          const ImageT<U>& reference,
                                          double ppd = detail::pixels_per_degree()) {
    const detail::Exposures exposures = detail::exposures_of(reference);
    const auto worst_of = [&](const auto& tile, const auto& reference_tile) {
        ImageT<double> worst = make_image<double>(tile.width, tile.height);
        for (int i = 0; i < exposures.count; ++i) {
            const double part = double(i) / (exposures.count - 1);
            const double light =
                std::exp2(exposures.first + part * (exposures.last - exposures.first));
            const auto developed = [light](const auto& picture) {
                auto result = make_image<double>(picture.width, picture.height);
                for (std::size_t k = 0; k < result.pixels.size(); ++k)
                    for (int c = 0; c < 3; ++c)
                        result.pixels[k][c] =
                            detail::film_curve(light * double(picture.pixels[k][c]));
                return result;
            };
            const auto map =
                detail::flip_tile(developed(tile), developed(reference_tile), ppd);
            for (std::size_t k = 0; k < map.pixels.size(); ++k)
                worst.pixels[k] = glm::max(worst.pixels[k], map.pixels[k]);
        }
        return worst;
    };
    return detail::map_by_tiles(image, reference, ppd, worst_of);
}

/// The mean of hdr_flip_map().
/// \return A number in [0, 1]. It stays the same if both pictures are scaled by the
///         same number, unless the median luminance is below 1.2e-7.
/// \throws std::invalid_argument  as flip_map().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double hdr_flip(const ImageT<T>& image, const ImageT<U>& reference,
                              double ppd = detail::pixels_per_degree()) {
    return detail::mean_of(hdr_flip_map(image, reference, ppd));
}

/// \}

} // namespace ljus
