#pragma once

/// \file support/student.hpp
/// \brief Statistical tests with a standard error that is estimated from few numbers.
///
/// A mean of 16 numbers is off by 5 of its own standard errors once in 6000, not once
/// in 1.7 million, because the standard error itself is known to 18 % only.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/integrate.hpp"
#include "support/statistics.hpp"

namespace ljus_test {

/// The probability that a variable with Student's distribution is farther from 0 than
/// `t`, on either side.
/// \param freedom  Degrees of freedom, above 0; more than 1000 count as 1000.
inline double student_tail(double t, double freedom) {
    // With t = sqrt(freedom) tan x the density of x is proportional to the power
    // freedom - 1 of cos x.
    const double n = std::min(freedom, 1000.0), right = std::numbers::pi / 2;
    const double part =
        integrate(std::atan(std::abs(t) / std::sqrt(n)), right, 64,
                  [&](double x) { return std::pow(std::cos(x), n - 1); });
    const double log_whole =
        std::lgamma(n / 2) - std::lgamma((n + 1) / 2) + std::log(std::numbers::pi) / 2;
    return std::min(1.0, 2 * part * std::exp(-log_whole));
}

/// The probability that a correct mean is at least this far from the expected value.
inline double chance_of(const Mean& mean, double right) {
    if (mean.mean == right) return 1;
    return student_tail((mean.mean - right) / mean.error(), mean.count - 1);
}

/// The probability that two means are at least this far apart, if their expected values
/// differ by at most `bias`. Their variances may differ (Welch, "The generalization of
/// 'Student's' problem when several different population variances are involved",
/// 1947).
inline double chance_of(const Mean& a, const Mean& b, double bias = 0) {
    const double off = std::abs(a.mean - b.mean) - bias;
    if (!(off > 0)) return 1;
    const double u = a.error() * a.error(), v = b.error() * b.error();
    const double freedom =
        (u + v) * (u + v) / (u * u / (a.count - 1) + v * v / (b.count - 1));
    return student_tail(off / std::sqrt(u + v), freedom);
}

} // namespace ljus_test
