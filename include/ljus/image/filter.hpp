#pragma once

/// \file ljus/image/filter.hpp
/// \brief Pixel filters: how much the light at a film position contributes to a pixel.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup filter Pixel filters
/// \brief Section 3.2 of the report: "multiple primary rays are cast per pixel. This
/// means that the resulting image will be anti-aliased". Chapter: \ref ch_radiance.
///
/// A pixel is a weighted mean of the radiance around the pixel's centre. The filter is
/// the weight as a function of the position (x, y). It is a product of a function of x
/// and the same function of y, and its integral is 1.
/// \{

/// The filters. Lengths are in pixels.
enum class Filter : std::uint8_t {
    box,      ///< Constant over the pixel, 0 outside.
    tent,     ///< Falls linearly to 0 at the centres of the neighbours.
    gaussian, ///< A Gaussian of standard deviation 1/2, shifted down to 0 at 3/2.
    mitchell  ///< A cubic with negative lobes: sharper, but with halos at edges.
};

/// The radius of a filter along x and along y, in pixels.
[[nodiscard]] constexpr double filter_radius(Filter filter) noexcept {
    constexpr double radii[] = {0.5, 1.0, 1.5, 2.0};
    return radii[static_cast<std::size_t>(filter)];
}

/// The weight of a filter along one axis, per pixel of length, at the distance x from
/// the pixel's centre, in pixels. Its integral over x is 1, and it is 0 outside the
/// radius.
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
        constexpr T scale = T(0.8219605129230532);       // normalises the integral to 1
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

/// A film position that was sampled for a pixel.
template <std::floating_point T>
struct FilterSampleT {
    /// The position in pixels, from the pixel's upper left corner.
    Vec2T<T> place{T(0)};
    T weight = T(1); ///< The filter divided by the pdf; 1 on average.
};

namespace detail {

/// The integral of a filter's absolute weight from the centre to each of 65 equally
/// spaced distances up to the radius, divided by the integral up to the radius.
using FilterTable = std::array<double, 65>;

[[nodiscard]] inline FilterTable make_filter_table(Filter filter) noexcept {
    constexpr std::size_t cells = std::tuple_size_v<FilterTable> - 1;
    FilterTable cdf{};
    // By the trapezoidal rule: the middle of a cell may be close to a zero of the
    // filter, and a sample elsewhere in this cell would have a large weight.
    const auto size_at = [&](std::size_t i) {
        return std::abs(
            filter_weight(filter, double(i) / double(cells) * filter_radius(filter)));
    };
    for (std::size_t i = 0; i < cells; ++i)
        cdf[i + 1] = cdf[i] + size_at(i) + size_at(i + 1);
    const double all = cdf.back();
    for (double& sum : cdf) sum /= all;
    return cdf;
}

/// The table for the Gaussian or Mitchell's filter, whose integrals have no inverse in
/// closed form.
[[nodiscard]] inline const FilterTable& filter_table(Filter filter) noexcept {
    static const FilterTable gaussian = make_filter_table(Filter::gaussian);
    static const FilterTable mitchell = make_filter_table(Filter::mitchell);
    return filter == Filter::gaussian ? gaussian : mitchell;
}

/// Samples a position along one axis by inversion, for any filter except the box. The
/// position increases with u, so that strata of u give strata of positions.
/// \return In x the signed distance from the pixel's centre, in pixels; in y the
///         weight, which is the filter divided by the pdf.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> sample_filter_axis(Filter filter, T u) noexcept {
    const T v = std::abs(T(2) * u - T(1)); // by symmetry
    const T side = u < T(0.5) ? T(-1) : T(1);
    if (filter == Filter::tent) // solves 2x - x^2 = v without cancellation
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

} // namespace detail

/// Samples the film position of a ray in proportion to the filter: *filter importance
/// sampling* \cite ernst2006. A ray contributes to one pixel only, so that pixels are
/// independent of each other. The mean of weight times radiance is the filtered pixel.
/// \return The position and its weight. The weight is 1 for the box and the tent and
///         near 1 for the Gaussian. For Mitchell's filter it is a product of two
///         numbers near 1.07 or -1.07. Where a filter is nearly 0, each factor is
///         between 0 and twice as large.
/// \cost Nothing for the box. Per axis, the tent takes a square root, and the others 6
///       steps of a binary search.
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
