#pragma once

/// \file ljus/inspect/estimate.hpp
/// \brief A mean of random numbers, and how far it may be from the truth.

#include <cmath>
#include <limits>

#include "ljus/version.hpp"

namespace ljus {

/// \defgroup estimate Estimates
/// \brief Sections 1 and 2.1, Monte Carlo: a mean with its standard error. Chapter:
/// \ref ch_monte_carlo.
/// \{

/// What is known after some samples, in one pass and three numbers.
///
/// The sums of x^2 and of x would do on paper: (sum x^2 - (sum x)^2 / n) / (n - 1). In
/// the machine the two cancel where the mean is large beside the deviation. Welford's
/// sums \cite welford1962 hold the distances from the mean, and nothing cancels.
struct Estimate {
    double count = 0;   ///< n, how many samples.
    double mean = 0;    ///< Of them: the estimate.
    double squares = 0; ///< Sum of (x - mean)^2.
};

/// Takes one more sample.
/// \param estimate  Of the samples so far.
/// \param x         The sample; NaN makes everything NaN, it is not hidden.
// [add]
constexpr void add(Estimate& estimate, double x) noexcept {
    estimate.count += 1;
    const double from_old = x - estimate.mean;
    estimate.mean += from_old / estimate.count;
    estimate.squares += from_old * (x - estimate.mean);
}
// [add]

/// The estimate of the samples of both, as if one had taken them all.
/// \param a  Some samples.
/// \param b  Others, independent of them.
/// \return Of both, up to rounding.
// [joined]
[[nodiscard]] constexpr Estimate joined(const Estimate& a, const Estimate& b) noexcept {
    if (a.count == 0) return b;
    const double count = a.count + b.count, apart = b.mean - a.mean;
    return {.count = count,
            .mean = a.mean + apart * (b.count / count),
            .squares =
                a.squares + b.squares + apart * apart * (a.count * b.count / count)};
}
// [joined]

/// The variance of one sample, as the samples themselves tell it.
/// \param estimate  Of the samples.
/// \return Their squared distances over n - 1, which has the right mean because one of
///         the n distances is used up by the mean; infinity for fewer than 2 samples,
///         from which nothing can be told.
// [variance]
[[nodiscard]] constexpr double variance(const Estimate& estimate) noexcept {
    if (estimate.count < 2) return std::numeric_limits<double>::infinity();
    return estimate.squares / (estimate.count - 1);
}

/// The standard error: the deviation of the mean, if one took n other samples.
///
/// *Trap*: it is an estimate itself, and knows only what the samples have found. Where
/// the variance is infinite, or the light is rare, it is too small.
/// \param estimate  Of the samples.
/// \return sqrt(variance / n), in the unit of the samples; infinity for fewer than 2.
[[nodiscard]] inline double standard_error(const Estimate& estimate) noexcept {
    return std::sqrt(variance(estimate) / estimate.count);
}
// [variance]

/// \}

} // namespace ljus
