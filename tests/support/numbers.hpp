#pragma once

/// \file support/numbers.hpp
/// \brief Random numbers for tests. They are the same on every machine and independent
/// of the library.

#include <cmath>
#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus_test {

/// Knuth's linear congruential generator, whose upper bits are random enough for tests.
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
    double noise() { return std::sqrt(3.0) * between(-1, 1); } // mean 0, variance 1
    int below(int count) { return static_cast<int>(next() * count); }
    double sign() { return next() < 0.5 ? -1.0 : 1.0; }
    ljus::Vec3T<double> point(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {x, y, between(-size, size)};
    }
    ljus::Vec3 whole_point(int size) { // whole coordinates, exact in float up to 2^24
        const auto part = [&] { return static_cast<float>(below(2 * size) - size); };
        const float x = part(), y = part();
        return {x, y, part()};
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

} // namespace ljus_test
