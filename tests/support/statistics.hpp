#pragma once

/// \file support/statistics.hpp
/// \brief Statistical tests: means with standard errors, and Pearson's chi-square.

#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

namespace ljus_test {

/// The running mean of numbers, and its standard error (Welford).
struct Mean {
    double count = 0;   ///< The number of values.
    double mean = 0;    ///< Their mean.
    double squares = 0; ///< Sum of the squared distances from the mean.

    /// Adds a value.
    void add(double x) {
        count += 1;
        const double from_old = x - mean;
        mean += from_old / count;
        squares += from_old * (x - mean);
    }

    /// Of the numbers.
    [[nodiscard]] double variance() const { return squares / (count - 1); }

    /// The standard error of the mean.
    [[nodiscard]] double error() const {
        return count < 2 ? 0 : std::sqrt(variance() / count);
    }

    /// By how many standard errors the mean is off. Where all numbers are equal up to
    /// rounding the error is 0, so `rounding` (relative) is allowed for.
    [[nodiscard]] double sigmas(double truth, double rounding = 1e-5) const {
        const double allowed = std::hypot(error(), rounding * truth);
        return mean == truth ? 0 : (mean - truth) / allowed;
    }

    /// Within 5 standard errors: a false alarm once in 1.7 million; and within a small
    /// part besides, for a sample that hardly scatters.
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

/// The allowed deviation of the farthest of several means, in standard errors: one run
/// in 1000 of a correct test exceeds it (Bonferroni, with the normal distribution).
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

/// The value that a chi-square variable with `freedom` degrees exceeds as rarely as a
/// normal one exceeds z: 3.09 is once in 1000, 5 is 3 times in 10 million (Wilson and
/// Hilferty's cube, good to a few percent of that probability from 10 degrees on).
inline double chi_square_limit(double freedom, double z = once_in_a_million) {
    const double a = 2 / (9 * freedom);
    const double root = 1 - a + z * std::sqrt(a);
    return freedom * root * root * root;
}

/// Pearson's sum over cells that should all hold the same count.
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

/// Pearson's sum over cells with different expected counts.
struct ChiSquare {
    double sum = 0; ///< Infinite if a cell that must be empty is not.
    int cells = 0;  ///< Number of cells.

    /// The limit of the sum; see chi_square_limit().
    [[nodiscard]] double limit(double z = once_in_a_million) const {
        return chi_square_limit(cells - 1, z);
    }
};

/// The sum for counts and what is expected; cells that expect fewer than 8 are joined
/// into one.
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

/// Whether counts agree with expected ones, with the false-alarm rate of `z`: see
/// chi_square_limit().
inline bool chi_square_agrees(std::span<const double> counts,
                              std::span<const double> expected, double z) {
    const ChiSquare found = chi_square(counts, expected);
    if (found.cells < 2) return found.sum < 1e-9; // a single cell is not random
    return found.sum <= found.limit(z);
}

} // namespace ljus_test
