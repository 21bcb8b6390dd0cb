#pragma once

/// \file ljus/image/flip.hpp
/// \brief FLIP: how different two pictures look to a viewer who flips between them.

#include <cmath>
#include <numbers>

#include "ljus/image/detail/flip_color.hpp"
#include "ljus/image/detail/flip_filter.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sum.hpp"

namespace ljus {

/// \defgroup flip FLIP
/// \brief Footnote 1: "all we really need is to make the results look real". A number
/// for it, after Andersson et al. \cite andersson2020.
/// Chapter: \ref ch_light_transport.
/// \{

namespace detail {

/// The number of pixels per degree of the visual field.
/// \param distance  From the eye to the screen, in metres.
/// \param width     Width of the screen, in metres.
/// \param pixels    Pixels across the screen.
/// \return Pixels per degree; 67.0 for the defaults.
[[nodiscard]] constexpr double pixels_per_degree(double distance = 0.7,
                                                 double width = 0.7,
                                                 double pixels = 3840) noexcept {
    return distance * pixels / width * std::numbers::pi / 180;
}

/// The perceived difference of two colours without their surroundings.
/// The HyAB distance is raised to the power 0.7 and mapped to [0, 1] by two linear
/// pieces: differences above 0.4 of the largest one, between pure green and pure blue,
/// are compressed into the last 0.05.
/// \return 0 for equal colours, 1 for green and blue.
/// \cite andersson2020
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
    const ImageT<double> a = detail::opponent_image(image),
                         b = detail::opponent_image(reference);
    const ImageT<double> seen_a = detail::eye_filtered(a, ppd),
                         seen_b = detail::eye_filtered(b, ppd);
    const ImageT<double> features_a = detail::features(a, ppd),
                         features_b = detail::features(b, ppd);

    ImageT<double> map = make_image<double>(image.width, image.height);
    for (std::size_t i = 0; i < map.pixels.size(); ++i) {
        const double color = detail::color_error(seen_a.pixels[i], seen_b.pixels[i]);
        const RgbT<double> change = features_a.pixels[i] - features_b.pixels[i];
        const double larger = glm::max(std::abs(change.x), std::abs(change.y));
        const double feature = std::sqrt(larger / std::numbers::sqrt2);
        map.pixels[i] = RgbT<double>(std::pow(color, 1 - feature));
    }
    return map;
}
// [flip_map]

} // namespace detail

/// FLIP of each pixel: how strongly a viewer who flips between two pictures sees it
/// change.
/// Detail too fine for the eye is blurred, channel by channel, before colours are
/// compared. Where only one picture has an edge or a point, the colour difference is
/// raised to a power below 1.
/// \param image      Linear sRGB; clamped to [0, 1], as on a screen.
/// \param reference  The other picture, of the same size.
/// \param ppd        From pixels_per_degree().
/// \return A grey image in [0, 1]; 0 where no difference is visible.
/// \throws std::invalid_argument  as require_same_size(), or for a ppd outside
///         [1, 1000].
/// \cost Proportional to pixels times ppd.
/// \cite andersson2020
template <std::floating_point T, std::floating_point U>
[[nodiscard]] ImageT<double> flip_map(const ImageT<T>& image,
                                      const ImageT<U>& reference,
                                      double ppd = detail::pixels_per_degree()) {
    detail::require_same_size(image, reference);
    require(ppd >= 1 && ppd <= 1000, "pixels per degree", ppd, "from 1 to 1000");
    return detail::map_by_tiles(image, reference, ppd,
                                [ppd](const auto& tile, const auto& reference_tile) {
                                    return detail::flip_tile(tile, reference_tile, ppd);
                                });
}

namespace detail {

/// The mean of the first channel of an image.
[[nodiscard]] inline double mean_of(const ImageT<double>& map) {
    std::vector<double> values;
    values.reserve(map.pixels.size());
    for (const RgbT<double>& value : map.pixels) values.push_back(value.x);
    return detail::pairwise_sum(values) / static_cast<double>(values.size());
}

} // namespace detail

/// The mean of flip_map().
/// *Trap*: FLIP is made for pictures shown alternately at the same spot of a screen, at
/// a given distance and exposure. The values of several errors cannot be added, and no
/// theory predicts how fast FLIP falls with more rays.
/// \return In [0, 1]; symmetric in the two pictures.
/// \throws std::invalid_argument  as flip_map().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double flip(const ImageT<T>& image, const ImageT<U>& reference,
                          double ppd = detail::pixels_per_degree()) {
    return detail::mean_of(flip_map(image, reference, ppd));
}

/// \}

} // namespace ljus
