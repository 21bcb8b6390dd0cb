#pragma once

/// \file support/draws.hpp
/// \brief Random numbers and directions of any precision for tests. They are the same
/// with every compiler.

#include <cmath>
#include <concepts>
#include <cstdint>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus_test {

/// The generator SplitMix64: a counter whose bits are mixed. It is independent of the
/// streams of the library.
struct Draws {
    std::uint64_t state = 1; ///< The seed.

    /// Draws 64 random bits.
    std::uint64_t bits() {
        std::uint64_t z = (state += 0x9e3779b97f4a7c15ull);
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
        return z ^ (z >> 31);
    }

    /// A number in [0, 1) with 24 bits, or 53 bits in double.
    template <std::floating_point T = double>
    T unit() {
        constexpr int keep = sizeof(T) == 4 ? 24 : 53;
        return static_cast<T>(bits() >> (64 - keep)) *
               (T(1) / static_cast<T>(1ull << keep));
    }

    /// A number in [low, high).
    template <std::floating_point T>
    T between(T low, T high) {
        return low + (high - low) * unit<T>();
    }
    double between(double low, double high) { return between<double>(low, high); }

    /// A whole number in [0, count).
    int below(int count) { return static_cast<int>(unit() * count); }

    /// A point of the unit square.
    template <std::floating_point T>
    ljus::Vec2T<T> square() {
        const T x = unit<T>();
        return {x, unit<T>()};
    }

    /// A point of the unit cube.
    template <std::floating_point T>
    ljus::Vec3T<T> cube() {
        const T x = unit<T>(), y = unit<T>();
        return {x, y, unit<T>()};
    }

    /// A point of the cube [-size, size)^3, computed in double and rounded once.
    template <std::floating_point T>
    ljus::Vec3T<T> point(double size) {
        const double x = between(-size, size), y = between(-size, size);
        return {T(x), T(y), T(between(-size, size))};
    }

    /// A uniformly distributed direction, computed in long double and rounded once.
    template <std::floating_point T>
    ljus::Vec3T<T> direction() {
        using L = long double;
        const L z = 1 - 2 * L(unit<double>());
        const L phi = 2 * std::numbers::pi_v<L> * L(unit<double>());
        const L r = std::sqrt((1 - z) * (1 + z));
        return {T(r * std::cos(phi)), T(r * std::sin(phi)), T(z)};
    }

    /// A uniformly distributed direction with z > 0.
    template <std::floating_point T>
    ljus::Vec3T<T> above() {
        for (;;)
            if (const auto d = direction<T>(); d.z > T(0)) return d;
    }
};

/// A direction at an angle to +z, computed in long double and rounded once.
template <std::floating_point T>
ljus::Vec3T<T> at_degrees(double theta, double phi = 0) {
    using L = long double;
    const L degree = std::numbers::pi_v<L> / 180;
    const L t = L(theta) * degree, p = L(phi) * degree;
    return {T(std::sin(t) * std::cos(p)), T(std::sin(t) * std::sin(p)), T(std::cos(t))};
}

} // namespace ljus_test
