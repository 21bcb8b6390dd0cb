#pragma once

/// \file ljus/inspect/bias_variance.hpp
/// \brief Splits an error into bias, which stays, and variance, which averages out.

#include "ljus/inspect/metrics.hpp"

namespace ljus {

/// \addtogroup metrics
/// \{

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
    if (runs.size() < 2)
        throw std::invalid_argument("Bias and variance need at least 2 runs, but there "
                                    "are " +
                                    std::to_string(runs.size()) + ".");
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

/// \}

} // namespace ljus
