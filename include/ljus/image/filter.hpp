#pragma once

/// \file ljus/image/filter.hpp
/// \brief Pixel filters: how much a place of the film counts for a pixel.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup filter Pixel filters
/// \brief Section 3.2: "multiple primary rays are cast per pixel. This means that the
/// resulting image will be anti-aliased". Chapter: \ref ch_radiance.
///
/// A pixel is a weighted mean of the radiance around its middle. A filter is the
/// weight, along x times along y, with the integral 1.
/// \{

/// The filters. Lengths are in pixels.
enum class Filter : std::uint8_t {
    box,      ///< The mean over the pixel; neighbours share nothing.
    tent,     ///< Falls in a straight line to 0 at the middles of the neighbours.
    gaussian, ///< A bell with the deviation 1/2, lowered so that it is 0 at 3/2.
    mitchell  ///< A cubic that goes below 0: sharper, with a rim at edges.
};

/// How far a filter reaches.
/// \param filter  Which one.
/// \return Along x and along y from the pixel's middle, in pixels.
[[nodiscard]] constexpr double filter_radius(Filter filter) noexcept {
    constexpr double radii[] = {0.5, 1.0, 1.5, 2.0};
    return radii[static_cast<std::size_t>(filter)];
}

/// The weight of a filter along one axis.
/// \param filter  Which one.
/// \param x       Distance from the pixel's middle along the axis, in pixels.
/// \return Per pixel; its integral over x is 1. 0 outside of the radius.
/// \cite mitchell1988
// [filter weight]
template <std::floating_point T>
[[nodiscard]] T filter_weight(Filter filter, T x) noexcept {
    const T a = std::abs(x);
    if (!(a < T(filter_radius(filter)))) return T(0);
    switch (filter) {
    case Filter::tent:
        return T(1) - a;
    case Filter::gaussian: {
        constexpr T at_radius = T(0.011108996538242306); // exp(-9/2)
        constexpr T scale = T(0.8219605129230532);       // makes the integral 1
        return scale * (std::exp(T(-2) * a * a) - at_radius);
    }
    case Filter::mitchell:
        if (a < T(1)) return ((T(7) * a - T(12)) * a * a + T(16) / T(3)) / T(6);
        return (T(8) / T(7) - a) * (T(2) - a) * (T(2) - a) * T(7) / T(18);
    default:
        return T(1);
    }
}
// [filter weight]

/// A place that was drawn for a pixel, and what a ray through it counts.
template <std::floating_point T>
struct FilterSampleT {
    Vec2T<T> place{T(0)}; ///< From the pixel's upper left corner, in pixels.
    T weight = T(1);      ///< Filter over density; its mean is 1.
};

namespace detail {

/// How the weight of a filter adds up from the middle to the radius, in equal steps;
/// the sizes of weights below 0 count.
using FilterTable = std::array<double, 65>;

/// Makes the table of a filter.
/// \param filter  Which one.
/// \return Rising from 0 to 1.
[[nodiscard]] inline FilterTable make_filter_table(Filter filter) noexcept {
    constexpr std::size_t cells = std::tuple_size_v<FilterTable> - 1;
    FilterTable cdf{};
    for (std::size_t i = 0; i < cells; ++i) {
        const double middle = (double(i) + 0.5) / double(cells) * filter_radius(filter);
        cdf[i + 1] = cdf[i] + std::abs(filter_weight(filter, middle));
    }
    const double all = cdf.back();
    for (double& sum : cdf) sum /= all;
    return cdf;
}

/// The tables of the filters whose integral has no inverse in closed form.
/// \param filter  Gaussian or Mitchell's.
/// \return make_filter_table() of it, made once.
[[nodiscard]] inline const FilterTable& filter_table(Filter filter) noexcept {
    static const FilterTable gaussian = make_filter_table(Filter::gaussian);
    static const FilterTable mitchell = make_filter_table(Filter::mitchell);
    return filter == Filter::gaussian ? gaussian : mitchell;
}

/// A place along one axis by inversion, with its weight in y.
/// \param filter  Not the box.
/// \param u       In [0, 1]: the place rises with it, so that strata stay strata.
/// \return x: the distance from the pixel's middle; y: filter over density.
// [sample axis]
template <std::floating_point T>
[[nodiscard]] Vec2T<T> sample_filter_axis(Filter filter, T u) noexcept {
    const T v = std::abs(T(2) * u - T(1)); // both sides are alike
    const T side = u < T(0.5) ? T(-1) : T(1);
    if (filter == Filter::tent) // 2x - x^2 = v, solved without a difference
        return {side * v / (T(1) + std::sqrt(T(1) - v)), T(1)};
    const FilterTable& cdf = filter_table(filter);
    const auto above = std::upper_bound(cdf.begin() + 1, cdf.end() - 1, double(v));
    const double share = *above - *(above - 1);
    const double cell = double(above - 1 - cdf.begin());
    const double width = filter_radius(filter) / double(cdf.size() - 1);
    const double x = (cell + (double(v) - *(above - 1)) / share) * width;
    const double density = share / (2 * width);
    return {side * T(x), T(filter_weight(filter, x) / density)};
}
// [sample axis]

} // namespace detail

/// A place for a ray of a pixel, in proportion to the filter: *filter importance
/// sampling* \cite ernst2006. Every ray belongs to one pixel only, so that pixels stay
/// independent of each other, and the mean of weight times radiance is the filtered
/// pixel.
/// \param filter  Which one.
/// \param u       Point of the unit square, as the pixel's pattern has it.
/// \return The place and its weight: 1 for the box and the tent, near 1 for the
///         Gaussian, near 1.3 or -1.3 along each axis for Mitchell's.
/// \cost Nothing for the box; a square root an axis for the tent; 6 steps of a search
///       an axis for the others.
// [sample filter]
template <std::floating_point T>
[[nodiscard]] FilterSampleT<T> sample_filter(Filter filter,
                                             const Vec2T<T>& u) noexcept {
    if (filter == Filter::box) return {.place = u};
    const Vec2T<T> x = detail::sample_filter_axis(filter, u.x);
    const Vec2T<T> y = detail::sample_filter_axis(filter, u.y);
    return {.place = T(0.5) + Vec2T<T>{x.x, y.x}, .weight = x.y * y.y};
}
// [sample filter]

/// \}

} // namespace ljus
