#pragma once

/// \file support/statistics.hpp
/// \brief Statistical tests: means with standard errors, and Pearson's chi-square.

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace ljus_test {

/// The mean of numbers that are added one by one, and its standard error, by Welford's
/// method.
struct Mean {
    double count = 0;   ///< The number of values.
    double mean = 0;    ///< The mean of the values.
    double squares = 0; ///< Sum of the squared distances from the mean.

    /// Adds a value.
    void add(double x) {
        count += 1;
        const double from_old = x - mean;
        mean += from_old / count;
        squares += from_old * (x - mean);
    }

    /// The variance of one value.
    [[nodiscard]] double variance() const { return squares / (count - 1); }

    /// The standard error of the mean.
    [[nodiscard]] double error() const {
        return count < 2 ? 0 : std::sqrt(variance() / count);
    }

    /// The distance of the mean from the truth in standard errors. For numbers that are
    /// equal up to rounding the standard error is 0; a relative error of `rounding` is
    /// therefore added to it.
    [[nodiscard]] double sigmas(double truth, double rounding = 1e-5) const {
        const double allowed = std::hypot(error(), rounding * truth);
        return mean == truth ? 0 : (mean - truth) / allowed;
    }

    /// Whether the mean is within 5 standard errors of the truth, which gives one false
    /// alarm in 1.7 million. A small relative error is allowed in addition, for numbers
    /// that hardly scatter.
    [[nodiscard]] bool agrees_with(double truth, double relative = 1e-6) const {
        return std::abs(mean - truth) <= 5 * error() + relative * std::abs(truth);
    }
};

/// The slope of a line through points, by least squares.
inline double slope(std::span<const double> x, std::span<const double> y) {
    Mean mx, my;
    for (std::size_t i = 0; i < x.size(); ++i) mx.add(x[i]), my.add(y[i]);
    double xy = 0;
    for (std::size_t i = 0; i < x.size(); ++i)
        xy += (x[i] - mx.mean) * (y[i] - my.mean);
    return xy / mx.squares;
}

/// The distance of two independent means, in standard errors of their difference.
inline double apart(const Mean& a, const Mean& b) {
    const double error = std::hypot(a.error(), b.error());
    return a.mean == b.mean ? 0 : (a.mean - b.mean) / error;
}

/// The distance of a mean from its expected value, in standard errors.
inline double apart(const Mean& a, double truth, double rounding = 1e-6) {
    return a.sigmas(truth, rounding);
}

/// The allowed deviation of the worst of several means, in standard errors. One run in
/// 1000 of a correct test exceeds it, by Bonferroni's bound and the normal
/// distribution.
inline double limit_of(int checks) {
    double low = 0, high = 10;
    for (int step = 0; step < 60; ++step) {
        const double z = (low + high) / 2;
        (checks * std::erfc(z / std::sqrt(2.0)) > 1e-3 ? low : high) = z;
    }
    return high;
}

/// The value that a normal variable exceeds once in a million.
inline constexpr double once_in_a_million = 4.7534;

/// The value that a chi-square variable with `freedom` degrees of freedom exceeds as
/// rarely as a normal variable exceeds z. For z = 3.09 this is once in 1000, and for z
/// = 5 it is 3 times in 10 million. Wilson and Hilferty's formula is used. From 10
/// degrees of freedom on, its probability is right to a few percent.
inline double chi_square_limit(double freedom, double z = once_in_a_million) {
    const double a = 2 / (9 * freedom);
    const double root = 1 - a + z * std::sqrt(a);
    return freedom * root * root * root;
}

/// Pearson's chi-square sum over cells that should all have the same count.
template <typename Counts>
double chi_square(const Counts& counts) {
    double sum = 0;
    for (const auto count : counts) sum += static_cast<double>(count);
    const double expected = sum / static_cast<double>(counts.size());
    double result = 0;
    for (const auto count : counts) {
        const double off = static_cast<double>(count) - expected;
        result += off * off / expected;
    }
    return result;
}

/// Pearson's chi-square sum over cells with different expected counts.
struct ChiSquare {
    double sum = 0; ///< The sum; infinite if a cell that must be empty is not.
    int cells = 0;  ///< Number of cells.

    /// The limit of the sum; see chi_square_limit().
    [[nodiscard]] double limit(double z = once_in_a_million) const {
        return chi_square_limit(cells - 1, z);
    }
};

/// Pearson's sum for counts and expected counts. Cells with an expected count below 8
/// are joined into one cell.
inline ChiSquare chi_square(std::span<const double> counts,
                            std::span<const double> expected) {
    ChiSquare result;
    const auto add = [&](double count, double expect) {
        result.sum += (count - expect) * (count - expect) / expect;
        ++result.cells;
    };
    double rest_count = 0, rest_expected = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 8) {
            add(counts[i], expected[i]);
        } else {
            rest_count += counts[i];
            rest_expected += expected[i];
        }
    }
    if (rest_expected >= 1)
        add(rest_count, rest_expected);
    else if (rest_count > 8)
        result.sum = std::numeric_limits<double>::infinity();
    return result;
}

/// Whether counts agree with expected counts. The rate of false alarms is that of `z`
/// in chi_square_limit().
inline bool chi_square_agrees(std::span<const double> counts,
                              std::span<const double> expected, double z) {
    const ChiSquare found = chi_square(counts, expected);
    if (found.cells < 2) return found.sum < 1e-9; // one cell is not random
    return found.sum <= found.limit(z);
}

} // namespace ljus_test
