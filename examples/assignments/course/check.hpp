#pragma once

/// \file course/check.hpp
/// \brief Helps the tests of the assignments: a mean with its standard error.

#include <cmath>
#include <ostream>

#include "ljus/math/random.hpp"

namespace course {

/// The result of comparing a mean with its expected value. A test that fails prints
/// both.
struct Verdict {
    bool holds = false;
    double mean = 0, error = 0, truth = 0;
    explicit operator bool() const { return holds; }
    friend std::ostream& operator<<(std::ostream& out, const Verdict& v) {
        return out << "mean " << v.mean << ", standard error " << v.error
                   << "; expected " << v.truth
                   << " (mean / expected: " << v.mean / v.truth << ")";
    }
};

/// The mean of many independent numbers.
struct Mean {
    double sum = 0, sum2 = 0, count = 0;
    void add(double x) {
        sum += x;
        sum2 += x * x;
        count += 1;
    }
    double mean() const { return sum / count; }
    /// The variance of a number, at least 0. For equal numbers rounding could give
    /// less.
    double variance() const {
        const double v = (sum2 - sum * sum / count) / (count - 1);
        return v < 0 ? 0 : v; // NaN stays
    }
    double error() const { return std::sqrt(variance() / count); }
    /// Whether the mean is within five standard errors of the truth, plus `slack` for
    /// the error of the truth itself. An estimator without bias fails once in 1.7
    /// million seeds. The seeds are fixed, so that the same answer always gets the same
    /// verdict.
    Verdict agrees(double truth, double slack = 0) const {
        const double off = std::abs(mean() - truth);
        const bool holds = off <= 5 * error() + slack; // NaN does not agree
        return {holds, mean(), error(), truth};
    }
};

/// The random numbers of a test.
inline ljus::RandomStream stream(std::uint64_t seed) {
    return ljus::random_stream(seed, ljus::Pass::user, 0, 0);
}

} // namespace course
