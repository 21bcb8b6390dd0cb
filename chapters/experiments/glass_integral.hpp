#pragma once

/// \file chapters/experiments/glass_integral.hpp
/// \brief The small integral of chapter 3, as examples/03_monte_carlo.cpp has it, and
/// where its random numbers come from.

#include <cmath>
#include <cstdint>

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/math/random.hpp"
#include "ljus/optics/schlick.hpp"

namespace examples::glass {

constexpr double r0 = ljus::schlick_r0(1.0, 1.5); ///< Of glass: 0.04.
constexpr double truth = r0 + (1 - r0) / 21;      ///< The integral of f.

/// What glass under an even sky reflects: the share R of the light from the cosine c,
/// times how much light comes from there.
inline double f(double c) {
    return 2 * c * ljus::schlick(r0, c);
}

/// Ways to draw a cosine from a number u of [0, 1), each with its density.
struct Uniform {
    static double sample(double u) { return u; }
    static double pdf(double) { return 1; }
};
struct Cosine {
    static double sample(double u) { return std::sqrt(1 - u); } // never 0
    static double pdf(double c) { return 2 * c; }
};
struct Grazing {
    static double sample(double u) { return 1 - std::pow(1 - u, 1.0 / 6); }
    static double pdf(double c) { return 6 * std::pow(1 - c, 5); }
};

/// Where the numbers of a run come from.
enum class Points { random, strata, owen };

/// One number of n.
// [where numbers come from]
inline double number(Points points, int i, int n, std::uint64_t seed,
                     ljus::RandomStream& stream) {
    if (points == Points::strata) return (i + next_1d<double>(stream)) / n;
    if (points == Points::owen) {
        auto sobol = ljus::sobol_stream(seed, ljus::Pass::user, 0, std::uint64_t(i));
        return next_1d<double>(sobol);
    }
    return next_1d<double>(stream);
}
// [where numbers come from]

} // namespace examples::glass
