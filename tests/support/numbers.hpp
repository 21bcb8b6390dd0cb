#pragma once

/// \file support/numbers.hpp
/// \brief Numbers for tests: the same everywhere, and not the library's own.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "ljus/math/vector.hpp"

namespace ljus_test {

/// Knuth's linear congruential generator: its upper bits serve a test well enough.
struct Numbers {
    std::uint64_t state = 1;
    double next() {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state >> 11) / 9007199254740992.0;
    }
    double between(double low, double high) { return low + (high - low) * next(); }
    double power(double low, double high) { // 10^x
        return std::pow(10.0, between(low, high));
    }
    int below(int count) { return static_cast<int>(next() * count); }
    double sign() { return next() < 0.5 ? -1.0 : 1.0; }
    ljus::Vec3T<double> point(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {x, y, between(-size, size)};
    }
    ljus::Vec3T<double> direction() { // of unit length
        for (;;) {
            const auto v = point(1);
            const double length2 = glm::dot(v, v);
            if (length2 > 0.01 && length2 < 1) return v / std::sqrt(length2);
        }
    }
    template <typename T>
    ljus::Vec2T<T> square() { // a point of [0, 1)^2
        const double x = below(1 << 24), y = below(1 << 24);
        return {static_cast<T>(x / 16777216.0), static_cast<T>(y / 16777216.0)};
    }
};

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

/// What a chi-square sum exceeds once in a million tests, by Wilson and Hilferty.
inline double chi_square_limit(double degrees_of_freedom) {
    const double v = 2.0 / (9.0 * degrees_of_freedom);
    return degrees_of_freedom * std::pow(1.0 - v + 4.7534 * std::sqrt(v), 3);
}

/// A mean with its standard error.
struct Mean {
    double sum = 0, squares = 0;
    int count = 0;
    void add(double x) { sum += x, squares += x * x, ++count; }
    double value() const { return sum / count; }
    double error() const {
        const double mean = value();
        return std::sqrt(std::max(0.0, squares / count - mean * mean) / count);
    }
    /// Within 5 standard errors: a false alarm once in 1.7 million; and within a small
    /// part besides, for a sample that hardly scatters.
    bool agrees_with(double truth, double relative = 1e-6) const {
        return std::abs(value() - truth) <= 5.0 * error() + relative * std::abs(truth);
    }
};

} // namespace ljus_test
