#pragma once

/// \file support/photon_samples.hpp
/// \brief What the tests of photons share: numbers, means, counts against expectation.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/vector.hpp"

namespace photon_test {

/// A generator of our own, so that a test does not lean on the library's streams.
struct Numbers {
    std::uint64_t state = 1; ///< The seed.

    /// A number in [0, 1) with 53 bits (SplitMix64).
    double unit() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return double((z ^ (z >> 31)) >> 11) * 0x1p-53;
    }
    /// A number in [low, high).
    double between(double low, double high) { return low + (high - low) * unit(); }
    /// A whole number in [0, count).
    int below(int count) { return static_cast<int>(unit() * count); }
    /// A point of the cube [-size, size)^3.
    template <typename T>
    ljus::Vec3T<T> point(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {T(x), T(y), T(between(-size, size))};
    }
};

/// Mean and variance of a stream of values (Welford).
struct Mean {
    double count = 0, mean = 0, squares = 0;
    void add(double x) {
        const double before = x - mean;
        mean += before / ++count;
        squares += before * (x - mean);
    }
    double variance() const { return squares / (count - 1); }
    /// By how many standard errors the mean lies off; the errors are at least `floor`
    /// of the exact value, because float data are rounded.
    double sigmas(double exact, double floor = 1e-5) const {
        const double error = std::sqrt(variance() / count);
        return (mean - exact) / std::max(error, floor * std::abs(exact) + 1e-300);
    }
};

/// What chi-square with so many degrees of freedom exceeds once in a million (Wilson
/// and Hilferty).
inline double chi_square_limit(double freedom) {
    const double a = 2 / (9 * freedom);
    const double root = 1 - a + 4.753 * std::sqrt(a);
    return freedom * root * root * root;
}

/// The chi-square of counts; cells that expect fewer than 10 are put together.
struct ChiSquare {
    double sum = 0;
    int cells = 0;
    double limit() const { return chi_square_limit(cells - 1); }
};
inline ChiSquare chi_square(std::span<const double> counts,
                            std::span<const double> expected) {
    ChiSquare result;
    double rare_count = 0, rare_expected = 0;
    const auto add = [&](double count, double mean) {
        result.sum += (count - mean) * (count - mean) / mean;
        ++result.cells;
    };
    for (std::size_t i = 0; i < counts.size(); ++i) {
        if (expected[i] >= 10) {
            add(counts[i], expected[i]);
        } else {
            rare_count += counts[i];
            rare_expected += expected[i];
        }
    }
    if (rare_expected > 0) add(rare_count, rare_expected);
    return result;
}

/// Gauss and Legendre's rule with 8 points over [low, high].
template <typename F>
double integrate(double low, double high, F&& f) {
    constexpr double x[] = {0.1834346424956498, 0.5255324099163290, 0.7966664774136267,
                            0.9602898564975363};
    constexpr double w[] = {0.3626837833783620, 0.3137066458778873, 0.2223810344533745,
                            0.1012285362903763};
    const double middle = (low + high) / 2, half = (high - low) / 2;
    double sum = 0;
    for (int i = 0; i < 4; ++i)
        sum += w[i] * (f(middle - half * x[i]) + f(middle + half * x[i]));
    return sum * half;
}

/// The same over [low, high] cut into pieces.
template <typename F>
double integrate(double low, double high, int pieces, F&& f) {
    double sum = 0;
    for (int i = 0; i < pieces; ++i)
        sum += integrate(low + (high - low) * i / pieces,
                         low + (high - low) * (i + 1) / pieces, f);
    return sum;
}

} // namespace photon_test
