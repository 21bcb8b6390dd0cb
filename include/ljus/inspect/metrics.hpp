#pragma once

/// \file ljus/inspect/metrics.hpp
/// \brief Error metrics of a picture against a reference.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <vector>

#include <glm/exponential.hpp>

#include "ljus/image/image.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sum.hpp"

namespace ljus {

/// \defgroup metrics Error metrics
/// \brief Means over pixels and channels of linear radiance, computed in double.
///
/// x is the picture and r the reference. All metrics are 0 for equal finite pictures,
/// and NaN if a picture has a NaN. Only the estimate of bias^2 can be negative. The
/// reference should come from another algorithm and seed, with at most a tenth of the
/// error to be measured. State relMSE together with the block error, which shows bias,
/// and the trimmed error, which leaves out fireflies.
/// \{

/// The epsilon of the relative metrics for scenes with a mean radiance near 1. For
/// other scenes use the square of a tenth of the mean radiance.
inline constexpr double default_epsilon = 0.01;

namespace detail {

inline void require_runs(std::size_t runs) {
    require_at_least("the number of runs", static_cast<long long>(runs), 2);
}

// The errors of all pixels in order, each the mean of error(x, r) over the channels.
template <std::floating_point T, std::floating_point U, typename Error>
std::vector<double> pixel_errors(const ImageT<T>& image, const ImageT<U>& reference,
                                 Error error) {
    require_same_size(image, reference);
    std::vector<double> errors(image.pixels.size());
    for (std::size_t i = 0; i < errors.size(); ++i) {
        const Vec3T<double> x(image.pixels[i]);
        const Vec3T<double> r(reference.pixels[i]);
        errors[i] = (error(x.x, r.x) + error(x.y, r.y) + error(x.z, r.z)) / 3.0;
    }
    return errors;
}

inline double mean(const std::vector<double>& values) {
    return pairwise_sum(values) / static_cast<double>(values.size());
}

// The squared relative errors of all pixels.
template <std::floating_point T, std::floating_point U>
std::vector<double> relative_errors(const ImageT<T>& image, const ImageT<U>& reference,
                                    double epsilon) {
    require_positive("the epsilon of a relative error", epsilon);
    return pixel_errors(image, reference, [epsilon](double x, double r) {
        return (x - r) * (x - r) / (r * r + epsilon);
    });
}

} // namespace detail

/// The root mean square error, sqrt(mean (x - r)^2). For an unbiased method with n
/// samples, the metric falls as 1/sqrt(n).
///
/// *Trap*: a few highlights dominate the metric, and dark regions hardly count.
/// \return The error, in units of radiance.
/// \throws std::invalid_argument  if the sizes differ, or as check(image).
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rmse(const ImageT<T>& image, const ImageT<U>& reference) {
    const auto square = [](double x, double r) { return (x - r) * (x - r); };
    return std::sqrt(detail::mean(detail::pixel_errors(image, reference, square)));
}

/// The relative mean square error, mean (x - r)^2 / (r^2 + epsilon)
/// \cite rousselle2011. Like the eye, the metric responds to relative differences. The
/// epsilon is a squared radiance above 0; pixels darker than its root count less.
///
/// *Trap*: state the epsilon. Values with different epsilons cannot be compared, nor
/// can values from tools that divide by (r + epsilon)^2.
/// \return Dimensionless; about 1 for a black picture of a scene that is bright
///         throughout.
/// \throws std::invalid_argument  as rmse(), or for the epsilon.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                             double epsilon = default_epsilon) {
    return detail::mean(detail::relative_errors(image, reference, epsilon));
}

/// The relative mean square error without the pixels whose error, as a mean over the
/// channels, is largest. The argument `dropped`, in [0, 1), is the fraction of these
/// pixels. Without the worst 1 %, fireflies hardly influence the metric.
///
/// *Trap*: the metric favours a method that puts much light into few pixels. State it
/// beside rel_mse(), never in its place.
/// \return Dimensionless, at most rel_mse().
/// \throws std::invalid_argument  as rel_mse(), or for `dropped`.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double trimmed_rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                                     double dropped = 0.01,
                                     double epsilon = default_epsilon) {
    require(dropped >= 0.0 && dropped < 1.0, "the fraction of pixels to drop", dropped,
            "within [0, 1)");
    std::vector<double> errors = detail::relative_errors(image, reference, epsilon);
    // A NaN cannot be ordered, and is returned.
    for (const double error : errors)
        if (std::isnan(error)) return error;
    // The factor helps if the product was rounded to just below an integer.
    const double count = static_cast<double>(errors.size());
    const auto worst = static_cast<std::ptrdiff_t>(
        std::min(dropped * count * (1.0 + 1e-12), count - 1.0));
    const auto end = errors.end() - worst;
    if (worst > 0) std::nth_element(errors.begin(), end, errors.end());
    errors.erase(end, errors.end());
    return detail::mean(errors);
}

/// The rel_mse() of the block_means() of two pictures, which measures bias. In the
/// squared error of a block of 10 x 10 pixels, noise that is independent between pixels
/// is 100 times weaker, but an error that neighbouring pixels share is as large as
/// before. A blur that stays within blocks does not show. Narrow blocks at the right
/// and lower edge have the weight of whole blocks.
///
/// *Trap*: with photon maps, neighbouring pixels share photons. Their noise therefore
/// remains in the block means. Use several seeds and bias_variance() instead.
/// \return Dimensionless.
/// \throws std::invalid_argument  as rel_mse() and block_means().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double block_error(const ImageT<T>& image, const ImageT<U>& reference,
                                 int size = 10, double epsilon = default_epsilon) {
    detail::require_same_size(image, reference);
    return rel_mse(block_means(image, size), block_means(reference, size), epsilon);
}

/// The two terms of a mean square error, as means over all pixels and channels.
struct BiasVariance {
    double bias_squared = 0.0; ///< The squared bias.
    double variance = 0.0;     ///< The variance of a single run, which is its noise.
};

/// Splits the mean square error of a method into its bias and its variance. This takes
/// at least 2 runs with independent seeds. For each pixel and channel, x is the value
/// of a run, r that of the reference, and m the mean of the N runs. Then variance =
/// sum (x - m)^2 / (N - 1), and bias^2 = (m - r)^2 - variance / N, where the last term
/// is the noise that the mean m still has. The sum of bias^2 and variance is the
/// expected mean square error of a run. Noise that neighbouring pixels share, as with
/// photon maps, does not count as bias. Noise of the reference does.
///
/// *Trap*: the estimate of bias^2 for a method without bias may be negative by chance.
/// The estimate is not clamped to 0, because clamping would bias it.
/// \return Both terms, in units of radiance squared.
/// \throws std::invalid_argument  for fewer than 2 runs, or as rmse().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] BiasVariance bias_variance(const std::vector<ImageT<T>>& runs,
                                         const ImageT<U>& reference) {
    detail::require_runs(runs.size());
    for (const ImageT<T>& run : runs) detail::require_same_size(run, reference);

    const double count = static_cast<double>(runs.size());
    std::vector<double> biases(reference.pixels.size());
    std::vector<double> variances(reference.pixels.size());
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        const RgbT<double> first(runs.front().pixels[i]); // exact for equal runs
        RgbT<double> mean = first;
        for (const ImageT<T>& run : runs)
            mean += (RgbT<double>(run.pixels[i]) - first) / count;
        double squares = 0.0;
        for (const ImageT<T>& run : runs) {
            const RgbT<double> difference = RgbT<double>(run.pixels[i]) - mean;
            squares += glm::dot(difference, difference) / 3.0;
        }
        const RgbT<double> shift = mean - RgbT<double>(reference.pixels[i]);
        variances[i] = squares / (count - 1.0);
        biases[i] = glm::dot(shift, shift) / 3.0 - variances[i] / count;
    }
    return {.bias_squared = detail::mean(biases), .variance = detail::mean(variances)};
}

/// The block means of several runs of one method.
struct BlockStatistics {
    ImageT<double> mean;           ///< Mean over all runs, block by block.
    ImageT<double> standard_error; ///< Standard error of that mean, channel by channel.
    std::size_t runs = 0;          ///< The number of runs.
};

/// Computes the block means of at least 2 runs with independent seeds, with standard
/// errors. Let b be the mean of a block in one of M runs, and m the mean of all b. Then
/// the standard error of m is sqrt(sum (b - m)^2 / (M - 1) / M). This holds for photon
/// maps too, whose pixels are correlated, because whole runs are compared.
///
/// *Trap*: the standard error is itself an estimate. Its relative error is
/// 1/sqrt(2(M - 1)): 71 % with two runs, 18 % with 16.
/// \return Means and standard errors, in units of radiance.
/// \throws std::invalid_argument  for fewer than 2 runs, or as rmse() and
///         block_means().
template <std::floating_point T>
[[nodiscard]] BlockStatistics block_statistics(const std::vector<ImageT<T>>& runs,
                                               int size = 10) {
    detail::require_runs(runs.size());
    const double count = static_cast<double>(runs.size());
    std::vector<ImageT<double>> blocks;
    for (const ImageT<T>& run : runs) {
        detail::require_same_size(run, runs.front());
        blocks.push_back(block_means(run, size));
    }
    const int width = blocks.front().width, height = blocks.front().height;
    BlockStatistics result{make_image<double>(width, height),
                           make_image<double>(width, height), runs.size()};
    for (std::size_t i = 0; i < result.mean.pixels.size(); ++i) {
        const RgbT<double>& first = blocks.front().pixels[i]; // exact for equal runs
        RgbT<double>& mean = result.mean.pixels[i] = first;
        for (const auto& block : blocks) mean += (block.pixels[i] - first) / count;
        RgbT<double> squares(0.0);
        for (const auto& block : blocks) {
            const RgbT<double> difference = block.pixels[i] - mean;
            squares += difference * difference;
        }
        result.standard_error.pixels[i] = glm::sqrt(squares / (count - 1.0) / count);
    }
    return result;
}

/// The difference between the block_statistics() of several runs and the block means of
/// a reference without noise, in standard errors. If the runs differ from the reference
/// by noise only, most of these numbers are below 3; see chance_beyond().
/// \return For each block, row by row, one number of at least 0 per channel. Infinity
///         for a block that is equal in all runs but differs from the reference.
/// \throws std::invalid_argument  as block_statistics().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] std::vector<double> block_deviations(const std::vector<ImageT<T>>& runs,
                                                   const ImageT<U>& reference,
                                                   int size = 10) {
    const BlockStatistics found = block_statistics(runs, size);
    detail::require_same_size(runs.front(), reference);
    const ImageT<double> truth = block_means(reference, size);
    std::vector<double> deviations;
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        for (int c = 0; c < 3; ++c) {
            const double off = std::abs(found.mean.pixels[i][c] - truth.pixels[i][c]);
            deviations.push_back(off == 0 ? 0
                                          : off / found.standard_error.pixels[i][c]);
        }
    return deviations;
}

/// \}

} // namespace ljus
