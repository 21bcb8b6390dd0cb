#pragma once

/// \file chapters/experiments/numbers.hpp
/// \brief Random numbers in double, for cases that a chapter counts.

#include <cmath>
#include <cstdint>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace examples {

/// A stream of numbers, the same wherever it runs: a linear congruential generator.
struct Numbers {
    std::uint64_t state = 1; ///< Of the generator; the seed at first.

    /// A number in [0, 1).
    double next() {
        state = state * 6364136223846793005ull + 1442695040888963407ull;
        return static_cast<double>(state >> 11) / 9007199254740992.0;
    }

    /// A number in [low, high).
    double between(double low, double high) { return low + (high - low) * next(); }

    /// A unit vector, all directions alike.
    ljus::Vec3T<double> direction() {
        const double z = 2 * next() - 1, r = std::sqrt(1 - z * z);
        const double phi = 2 * std::numbers::pi * next();
        return {r * std::cos(phi), r * std::sin(phi), z};
    }
};

} // namespace examples
