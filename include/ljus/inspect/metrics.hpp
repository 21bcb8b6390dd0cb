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
/// x is the picture and r the reference. Every metric is at least 0, and 0 for equal
/// pictures; NaN in a picture makes it NaN. The reference should come from another
/// algorithm and seed, with an error of at most a tenth of the measured one. No metric
/// is enough alone: state relMSE with the block error (bias) and the trimmed error
/// (fireflies).
/// \{

/// The epsilon of the relative metrics, for scenes of mean radiance near 1; for others
/// use (0.1 times the mean radiance)^2.
inline constexpr double default_epsilon = 0.01;

namespace detail {

inline void require_epsilon(double epsilon) {
    require_positive("the epsilon of a relative error", epsilon);
}

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
    return ljus::detail::pairwise_sum(values) / static_cast<double>(values.size());
}

// The squared relative error of one channel.
struct RelativeSquare {
    double epsilon;
    double operator()(double x, double r) const noexcept {
        return (x - r) * (x - r) / (r * r + epsilon);
    }
};

} // namespace detail

/// The root mean square error, sqrt(mean (x - r)^2).
/// It is the metric of theory: for an unbiased method it falls as 1/sqrt(n).
/// *Trap*: a few highlights dominate it; it says nothing of the dark regions.
/// \return In units of radiance.
/// \throws std::invalid_argument  as require_same_size().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rmse(const ImageT<T>& image, const ImageT<U>& reference) {
    const auto square = [](double x, double r) { return (x - r) * (x - r); };
    return std::sqrt(detail::mean(detail::pixel_errors(image, reference, square)));
}

/// The relative mean square error, mean (x - r)^2 / (r^2 + epsilon)
/// \cite rousselle2011.
/// It is relative, like the eye, and the default here.
/// *Trap*: values with different epsilons, or with the divisor (r + epsilon)^2 of some
/// tools, are not comparable; state the epsilon.
/// The epsilon is a squared radiance above 0, the scale of darkness.
/// \return Dimensionless; 1 for a black picture of a scene that is bright throughout.
/// \throws std::invalid_argument  as require_same_size(), or for the epsilon.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                             double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    return detail::mean(
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon}));
}

/// The relative mean square error without the worst pixels.
/// Dropping the worst 1 % removes fireflies, and measures the rest of the picture: the
/// worst floor(dropped * pixels) go, by their mean over the channels. `dropped` is in
/// [0, 1).
/// *Trap*: it favours a method that puts its energy into fireflies; state it beside
/// rel_mse(), never instead of it.
/// \return Dimensionless, at most rel_mse().
/// \throws std::invalid_argument  as rel_mse(), or for `dropped`.
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double trimmed_rel_mse(const ImageT<T>& image, const ImageT<U>& reference,
                                     double dropped = 0.01,
                                     double epsilon = default_epsilon) {
    detail::require_epsilon(epsilon);
    require(dropped >= 0.0 && dropped < 1.0, "the fraction of pixels to drop", dropped,
            "within [0, 1)");
    std::vector<double> errors =
        detail::pixel_errors(image, reference, detail::RelativeSquare{epsilon});
    // NaN cannot be ordered: return it.
    for (const double error : errors)
        if (std::isnan(error)) return error;
    // The factor covers a product that was rounded down below an integer.
    const double count = static_cast<double>(errors.size());
    const auto worst = static_cast<std::ptrdiff_t>(dropped * count * (1.0 + 1e-12));
    const auto end = errors.end() - worst;
    if (worst > 0) std::nth_element(errors.begin(), end, errors.end());
    errors.erase(end, errors.end());
    return detail::mean(errors);
}

/// The image of block means: each pixel is the mean of size x size pixels.
/// If the width or height is no multiple of the block's side, the last column or row of
/// blocks is narrower and takes the mean of its pixels.
/// \param image  The picture.
/// \param size   Side of a block in pixels, at least 1.
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

/// The relMSE of the means of 10 x 10 blocks, which measures bias.
/// Noise that is independent between pixels is 100 times weaker in a squared block
/// mean; an error that neighbours share stays. A blur within a block does not show.
/// *Trap*: neighbouring pixels share photons, so that the noise of photon maps survives
/// too; use several seeds and bias_variance() for them. Narrow blocks at the right and
/// lower edge (see block_means()) have the weight of whole ones.
/// \return Dimensionless.
/// \throws std::invalid_argument  as rel_mse() and block_means().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] double block_error(const ImageT<T>& image, const ImageT<U>& reference,
                                 int size = 10, double epsilon = default_epsilon) {
    detail::require_same_size(image, reference);
    return rel_mse(block_means(image, size), block_means(reference, size), epsilon);
}

/// The two terms of a mean square error.
struct BiasVariance {
    double bias_squared = 0.0; ///< Mean of (expected x - r)^2: stays with more seeds.
    double variance = 0.0;     ///< Mean variance of x in one run: noise.
};

/// Splits the mean square error of a method by running it with several seeds.
/// For each pixel and channel, with m the mean of the M runs:
/// variance = sum (x - m)^2 / (M - 1) and bias^2 = (m - r)^2 - variance / M, which
/// subtracts the noise left in m. Their sum is the expected mean square error of a run.
/// Noise that neighbouring pixels share, as with photon maps, does not count as bias,
/// because whole runs are compared.
/// *Trap*: without bias the estimate of bias^2 may be negative by chance; clamping it
/// would itself be a bias.
/// \param runs       At least 2 pictures of the same size, with independent seeds.
/// \param reference  The reference, of that size; its own variance is in the result.
/// \return Both terms, in units of radiance squared.
/// \throws std::invalid_argument  for fewer than 2 runs, or as require_same_size().
template <std::floating_point T, std::floating_point U>
[[nodiscard]] BiasVariance bias_variance(const std::vector<ImageT<T>>& runs,
                                         const ImageT<U>& reference) {
    detail::require_runs(runs.size());
    for (const ImageT<T>& run : runs) detail::require_same_size(run, reference);

    const double count = static_cast<double>(runs.size());
    std::vector<double> biases(reference.pixels.size());
    std::vector<double> variances(reference.pixels.size());
    for (std::size_t i = 0; i < reference.pixels.size(); ++i) {
        RgbT<double> mean(0.0);
        for (const ImageT<T>& run : runs) mean += RgbT<double>(run.pixels[i]) / count;
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
    ImageT<double> standard_error; ///< Its standard error, channel by channel.
    std::size_t runs = 0;          ///< The number of runs.
};

/// Computes the block means of several runs, with standard errors.
/// With b the mean of a block in one of M runs and m the mean of the b:
/// standard error = sqrt(sum (b - m)^2 / (M - 1) / M). It holds for photon maps too,
/// whose pixels are correlated, because whole runs are compared.
/// *Trap*: the standard error from M runs has a relative error of 1/sqrt(2(M - 1))
/// itself: 71 % with two runs, 18 % with 16.
/// \param runs  At least 2 pictures of the same size, with independent seeds.
/// \param size  Side of a block in pixels, at least 1.
/// \return Means and standard errors, in units of radiance.
/// \throws std::invalid_argument  for fewer than 2 runs, or as require_same_size() and
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
        RgbT<double>& mean = result.mean.pixels[i];
        for (const auto& block : blocks) mean += block.pixels[i] / count;
        RgbT<double> squares(0.0);
        for (const auto& block : blocks) {
            const RgbT<double> difference = block.pixels[i] - mean;
            squares += difference * difference;
        }
        result.standard_error.pixels[i] = glm::sqrt(squares / (count - 1.0) / count);
    }
    return result;
}

/// How far the block means of several runs are from a reference, in their own standard
/// errors: where noise is all, most are below 3; see chance_beyond().
/// \param runs       At least 2 pictures of the same size, with independent seeds.
/// \param reference  The reference, of that size, without noise.
/// \param size       Side of a block in pixels, at least 1.
/// \return At least 0; three numbers for each block, row by row. Infinity for a
///         difference without noise.
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
