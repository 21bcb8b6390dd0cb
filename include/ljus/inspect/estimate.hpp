#pragma once

/// \file ljus/inspect/estimate.hpp
/// \brief A mean of random numbers, with its standard error.

#include <cmath>
#include <limits>
#include <numbers>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup estimate Estimates
/// \brief Sections 1 and 2.1 of the report: the result of a Monte Carlo method, a mean
/// with its standard error. Chapter: \ref ch_monte_carlo.
/// \{

/// A running mean and variance, by Welford's sums \cite welford1962. A variance from
/// the sums of x and x^2 would be lost by rounding where the mean is much larger than
/// the deviation.
struct Estimate {
    double count = 0;   ///< n, the number of samples.
    double mean = 0;    ///< Mean of the samples.
    double squares = 0; ///< Sum of (x - mean)^2 over the samples x.
};

/// Adds one sample. A NaN makes the estimate NaN.
// [add]
constexpr void add(Estimate& estimate, double x) noexcept {
    estimate.count += 1;
    const double from_old = x - estimate.mean;
    estimate.mean += from_old / estimate.count;
    estimate.squares += from_old * (x - estimate.mean);
}
// [add]

/// Merges the estimates of two independent sets of samples.
/// \return The estimate of all samples, up to rounding.
[[nodiscard]] constexpr Estimate joined(const Estimate& a, const Estimate& b) noexcept {
    if (a.count == 0) return b;
    const double count = a.count + b.count, apart = b.mean - a.mean;
    return {.count = count,
            .mean = a.mean + apart * (b.count / count),
            .squares =
                a.squares + b.squares + apart * apart * (a.count * b.count / count)};
}

/// The unbiased estimate of the variance of one sample: `squares` divided by n - 1;
/// infinity for fewer than 2 samples.
[[nodiscard]] constexpr double variance(const Estimate& estimate) noexcept {
    if (estimate.count < 2) return std::numeric_limits<double>::infinity();
    return estimate.squares / (estimate.count - 1);
}

/// The standard error: the standard deviation of the mean of n samples.
///
/// *Trap*: the standard error is itself estimated from the same samples. It is too
/// small where the variance is infinite, or where few samples find the light.
/// \return sqrt(variance / n), in the unit of the samples; infinity for fewer than 2
///         samples.
[[nodiscard]] inline double standard_error(const Estimate& estimate) noexcept {
    return std::sqrt(variance(estimate) / estimate.count);
}

/// The probability that noise alone moves a mean at least a given distance from the
/// truth: both tails of Student's distribution.
/// \param errors  The distance in standard errors, at least 0; may be infinite.
/// \param count   The number of samples of the mean, at least 2.
/// \return A probability, to about 1e-6.
[[nodiscard]] inline double chance_beyond(double errors, double count) {
    // With t = sqrt(n) tan(x) the density of x is proportional to cos(x)^(n - 1), which
    // is 0 in double beyond 40 / sqrt(n).
    count = std::fmin(count, 1e8); // where the distribution is nearly normal
    const double n = count - 1, root = std::sqrt(n);
    const double end = std::fmin(std::atan(errors / root), 40 / root);
    constexpr int steps = 1000; // of the midpoint rule
    double inside = 0;
    for (int i = 0; i < steps; ++i)
        inside += std::pow(std::cos((i + 0.5) * end / steps), n - 1) * end / steps;
    const double scale = std::exp(std::lgamma(count / 2) - std::lgamma(n / 2)) /
                         std::sqrt(std::numbers::pi);
    return 1 - 2 * scale * inside;
}

/// \}

} // namespace ljus
