#pragma once

/// \file examples/common/convergence.hpp
/// \brief How errors fall with time: slopes, bias and variance.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

#include "ljus/inspect/metrics.hpp"

namespace examples {

/// A power law y = c x^slope, fitted to points.
struct PowerLaw {
    double slope = 0; ///< The exponent.
    double error = 0; ///< Standard error of the slope, from the residuals of the fit.
};

/// Fits a straight line to the logarithms of x and y, by least squares.
/// \param x  Values above 0, not all equal.
/// \param y  As many values. Points with y <= 0 are left out.
/// \return The slope and its error; the slope is NaN for fewer than 2 points, and the
///         error for fewer than 3.
[[nodiscard]] inline PowerLaw fit_power(const std::vector<double>& x,
                                        const std::vector<double>& y) {
    std::vector<double> u, v;
    for (std::size_t i = 0; i < x.size(); ++i)
        if (x[i] > 0 && y[i] > 0) {
            u.push_back(std::log(x[i]));
            v.push_back(std::log(y[i]));
        }
    const auto n = double(u.size());
    double mu = 0, mv = 0, uu = 0, uv = 0, vv = 0;
    for (std::size_t i = 0; i < u.size(); ++i) {
        mu += u[i] / n;
        mv += v[i] / n;
    }
    for (std::size_t i = 0; i < u.size(); ++i) {
        uu += (u[i] - mu) * (u[i] - mu);
        uv += (u[i] - mu) * (v[i] - mv);
        vv += (v[i] - mv) * (v[i] - mv);
    }
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    const double slope = n >= 2 ? uv / uu : nan;
    const double off = std::max(vv - slope * uv, 0.0); // sum of the squared residuals
    return {slope, n >= 3 ? std::sqrt(off / (n - 2) / uu) : nan};
}

/// A picture divided by sqrt(r^2 + epsilon), pixel by pixel. Squared differences of
/// such pictures are relative ones, as in rel_mse().
/// \param image      The picture.
/// \param reference  The truth r, of the same size.
/// \return The quotient, in double.
template <typename T, typename U>
[[nodiscard]] ljus::ImageT<double> weighed(const ljus::ImageT<T>& image,
                                           const ljus::ImageT<U>& reference) {
    ljus::ImageT<double> result{image.width, image.height, {}};
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        const ljus::RgbT<double> r(reference.pixels[i]);
        result.pixels.push_back(ljus::RgbT<double>(image.pixels[i]) /
                                glm::sqrt(r * r + ljus::default_epsilon));
    }
    return result;
}

/// Splits the relMSE of a renderer into squared bias and variance, from pictures with
/// several seeds.
///
/// The sum of both is the mean of rel_mse() over the pictures, minus the noise of the
/// reference.
/// \param runs       At least 2 pictures, with independent seeds.
/// \param reference  The reference.
/// \param its_noise  The variance of the reference itself, as its contribution to
///                   relMSE.
/// \param block      Side of the blocks whose means are compared; 1: pixels.
[[nodiscard]] inline ljus::BiasVariance
relative_split(const std::vector<ljus::Image>& runs,
               const ljus::ImageT<double>& reference, double its_noise = 0,
               int block = 1) {
    const auto truth = block_means(reference, block);
    std::vector<ljus::ImageT<double>> all;
    for (const ljus::Image& run : runs)
        all.push_back(weighed(block_means(run, block), truth));
    auto split = bias_variance(all, weighed(truth, truth));
    split.bias_squared -= its_noise;
    return split;
}

/// The standard error of a squared bias, as ljus::bias_variance() estimates it.
///
/// The squared bias is estimated by the mean of the products of all pairs of runs. Its
/// standard error is found by a jackknife: each run is left out in turn, and the
/// scatter of the results is measured. If there is no bias, this error is too large: by
/// a factor of 2 for three runs, and of 1.4 for many runs.
/// \param apart  The difference of each run from the reference; runs with independent
///               seeds.
/// \return The standard error; infinity for fewer than 3 runs.
[[nodiscard]] inline double bias_error(const std::vector<ljus::ImageT<double>>& apart) {
    const auto n = double(apart.size());
    if (apart.size() < 3) return std::numeric_limits<double>::infinity();
    std::vector<double> with(apart.size()); // the products of a run with all others
    for (std::size_t p = 0; p < apart[0].pixels.size(); ++p) {
        ljus::RgbT<double> sum{0};
        for (const auto& run : apart) sum += run.pixels[p];
        for (std::size_t i = 0; i < apart.size(); ++i)
            with[i] += glm::dot(apart[i].pixels[p], sum - apart[i].pixels[p]);
    }
    double mean = 0, squares = 0;
    for (const double one : with) mean += one / n;
    for (const double one : with) squares += (one - mean) * (one - mean);
    const double without = 2 / ((n - 1) * (n - 2)); // change of the mean by one run
    return std::sqrt((n - 1) / n * squares) * without /
           (3 * double(apart[0].pixels.size()));
}

/// The standard error of the squared bias that relative_split() finds.
/// \param runs       Pictures with independent seeds.
/// \param reference  The reference; its own noise is ignored.
[[nodiscard]] inline double relative_bias_error(const std::vector<ljus::Image>& runs,
                                                const ljus::ImageT<double>& reference) {
    const auto truth = weighed(reference, reference);
    std::vector<ljus::ImageT<double>> apart;
    for (const ljus::Image& run : runs) {
        apart.push_back(weighed(run, reference));
        for (std::size_t p = 0; p < truth.pixels.size(); ++p)
            apart.back().pixels[p] -= truth.pixels[p];
    }
    return bias_error(apart);
}

} // namespace examples
