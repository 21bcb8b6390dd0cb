#pragma once

/// \file ljus/image/flip.hpp
/// \brief FLIP: how different two pictures look, to somebody who flips between them.

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

/// How large a pixel is to the viewer.
/// \param distance  From the eye to the screen, in metres.
/// \param width     Of the screen, in metres.
/// \param pixels    Across the screen.
/// \return Pixels in a degree of the visual field; 67.0 for the values given.
[[nodiscard]] constexpr double pixels_per_degree(double distance = 0.7,
                                                 double width = 0.7,
                                                 double pixels = 3840) noexcept {
    return distance * pixels / width * std::numbers::pi / 180;
}

/// What two colours differ by, if nothing else is near them.
///
/// The distance of large colour differences, HyAB, to the power 0.7, and then by two
/// straight lines into [0, 1]: differences above 0.4 of the largest, the one of pure
/// green and pure blue, share the last 0.05.
/// \param a  Linear sRGB within [0, 1].
/// \param b  The other one.
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

} // namespace detail

/// FLIP of each pixel: how much a viewer who flips between two pictures sees there.
///
/// What is too fine for the eye is blurred away, channel by channel, before colours are
/// compared; and where an edge or a point stands in one picture and not in the other,
/// the colours' difference is raised by a power below 1.
/// \param image      Linear sRGB; what is not within [0, 1] is taken to its border, as
///                   a screen does.
/// \param reference  The other picture, of the same size.
/// \param ppd        From pixels_per_degree().
/// \return A grey image in [0, 1]: 0 where nobody sees a difference.
/// \throws std::invalid_argument  as require_same_size(), or for a ppd outside of
///         [1, 1000].
/// \cost Proportional to pixels times ppd.
/// \cite andersson2020
// [flip_map]
template <std::floating_point T, std::floating_point U>
[[nodiscard]] ImageT<double> flip_map(const ImageT<T>& image,
                                      const ImageT<U>& reference,
                                      double ppd = detail::pixels_per_degree()) {
    detail::require_same_size(image, reference);
    require(ppd >= 1 && ppd <= 1000, "pixels per degree", ppd, "from 1 to 1000");
    const ImageT<double> a = detail::opponent_image(image),
                         b = detail::opponent_image(reference);
    const ImageT<double> seen_a = detail::as_seen(a, ppd),
                         seen_b = detail::as_seen(b, ppd);
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

namespace detail {

/// The mean of a grey image.
/// \param map  From flip_map() or hdr_flip_map().
/// \return The mean of its first channel.
[[nodiscard]] inline double mean_of(const ImageT<double>& map) {
    std::vector<double> values;
    values.reserve(map.pixels.size());
    for (const RgbT<double>& value : map.pixels) values.push_back(value.x);
    return detail::pairwise_sum(values) / static_cast<double>(values.size());
}

} // namespace detail

/// The mean of flip_map().
/// *Trap*: it is made for pictures that are looked at one after the other on the same
/// place of a screen, from a stated distance, at a stated exposure. It has no theory of
/// slopes, and does not add up.
/// \param image      Linear sRGB.
/// \param reference  The other picture, of the same size.
/// \param ppd        From pixels_per_degree().
/// \return In [0, 1]; the same if the pictures are exchanged.
/// \throws std::invalid_argument  as flip_map().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double flip(const ImageT<T>& image, const ImageT<U>& reference,
                          double ppd = detail::pixels_per_degree()) {
    return detail::mean_of(flip_map(image, reference, ppd));
}

/// \}

} // namespace ljus
