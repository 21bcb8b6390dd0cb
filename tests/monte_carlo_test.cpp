/// \file monte_carlo_test.cpp
/// \brief Means of random numbers against integrals that are known, and their errors
/// against what theory says of them.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/image/image.hpp"
#include "ljus/inspect/estimate.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/math/low_discrepancy.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/optics/schlick.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_state.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using ljus::Estimate;
using ljus_test::within;

namespace {

constexpr double pi = std::numbers::pi;
constexpr double r0 = 0.04, b = 1 - r0;

/// What glass reflects of an even sky: 2c R(c), and what that comes to.
double f(double c) {
    return 2 * c * ljus::schlick(r0, c);
}
constexpr double truth = r0 + b / 21;

// Second moments in closed form: of s = 1 - c, Beta functions.
constexpr double by_uniform = 4 * (r0 * r0 / 3 + 2 * r0 * b / 168 + b * b / 858);
constexpr double by_cosine = r0 * r0 + 2 * r0 * b / 21 + b * b / 66;

double pdf_cosine(double c) {
    return 2 * c;
}
double pdf_grazing(double c) {
    return 6 * std::pow(1 - c, 5);
}
double to_cosine(double u) {
    return std::sqrt(u);
}
double to_grazing(double u) {
    return 1 - std::pow(1 - u, 1.0 / 6);
}

ljus::RandomStream stream_of(std::uint64_t seed) {
    return ljus::random_stream(ljus_test::test_seed(seed), ljus::Pass::user, 0, 0);
}

template <typename Value>
Estimate mean_of(int n, std::uint64_t seed, Value value) {
    auto stream = stream_of(seed);
    Estimate estimate;
    for (int i = 0; i < n; ++i) add(estimate, value(stream));
    return estimate;
}

/// How far a mean is off, in standard errors.
double apart(const Estimate& e, double right) {
    return std::abs(e.mean - right) / standard_error(e);
}

} // namespace

TEST_CASE("monte carlo: the integral itself, by the midpoint rule") {
    double sum = 0, uniform = 0, cosine = 0;
    for (int i = 0; i < 100000; ++i) {
        const double c = (i + 0.5) / 100000;
        sum += f(c) / 100000;
        uniform += f(c) * f(c) / 100000;
        cosine += f(c) * f(c) / pdf_cosine(c) / 100000;
    }
    CHECK(sum == within(truth, 1e-8));
    CHECK(uniform == within(by_uniform, 1e-8));
    CHECK(cosine == within(by_cosine, 1e-8));
}

// False alarms: 4.5 standard errors, 7 in a million each. The variance of 200 000
// samples is known to 0.5 % or so; 4 % is eight times that.
TEST_CASE(
    "monte carlo: the mean of f/p is the integral, and its variance is as foretold") {
    const Estimate uniform =
        mean_of(200000, 1, [](auto& s) { return f(ljus::next_1d<double>(s)); });
    CHECK(apart(uniform, truth) < 4.5);
    CHECK(variance(uniform) == within(by_uniform - truth * truth, 0.04));
    const Estimate cosine = mean_of(200000, 2, [](auto& s) {
        const double c = to_cosine(1 - ljus::next_1d<double>(s));
        return f(c) / pdf_cosine(c);
    });
    CHECK(apart(cosine, truth) < 4.5);
    CHECK(variance(cosine) == within(by_cosine - truth * truth, 0.04));
    // In proportion to f itself every sample is the integral.
    const Estimate perfect = mean_of(
        1000, 3, [](auto& s) { return f(ljus::next_1d<double>(s)) * 0 + truth; });
    CHECK(standard_error(perfect) == 0);
}

TEST_CASE("monte carlo: inversion draws with the density that it should") {
    // The share of u below x is the cumulative curve at x.
    for (const double x : {0.05, 0.3, 0.7, 0.95}) {
        int cosine = 0, grazing = 0;
        for (int i = 0; i < 100000; ++i) {
            const double u = (i + 0.5) / 100000;
            cosine += to_cosine(u) < x;
            grazing += to_grazing(u) < x;
        }
        CHECK(cosine / 1e5 == doctest::Approx(x * x).epsilon(1e-4));
        CHECK(grazing / 1e5 == doctest::Approx(1 - std::pow(1 - x, 6)).epsilon(1e-4));
    }
}

// The rms error of many runs is known within 1/sqrt(2 runs): 5 % of 200, so that a
// slope over a factor of 256 is known within 0.02; 0.15 off does not come by chance.
TEST_CASE("monte carlo: errors fall by chance, by strata and by Owen as theory says") {
    constexpr int runs = 200;
    const auto rms = [](int n, auto number) {
        double squares = 0;
        for (std::uint64_t run = 0; run < runs; ++run) {
            auto stream = stream_of(100 + run);
            double sum = 0;
            for (int i = 0; i < n; ++i) sum += f(number(i, n, run, stream)) / n;
            squares += (sum - truth) * (sum - truth) / runs;
        }
        return std::sqrt(squares);
    };
    const auto random = [](int, int, std::uint64_t, ljus::RandomStream& stream) {
        return ljus::next_1d<double>(stream);
    };
    const auto strata = [](int i, int n, std::uint64_t, ljus::RandomStream& stream) {
        return (i + ljus::next_1d<double>(stream)) / n;
    };
    const auto owen = [](int i, int, std::uint64_t run, ljus::RandomStream&) {
        auto sobol = ljus::sobol_stream(ljus_test::test_seed(run * 7919),
                                        ljus::Pass::user, 0, std::uint64_t(i));
        return ljus::next_1d<double>(sobol);
    };
    const auto slope = [](double near, double far) {
        return std::log(far / near) / std::log(256.0);
    };
    const double by_chance = rms(16, random);
    CHECK(by_chance == within(std::sqrt((by_uniform - truth * truth) / 16), 0.3));
    CHECK(slope(by_chance, rms(4096, random)) == doctest::Approx(-0.5).epsilon(0.1));
    CHECK(slope(rms(16, strata), rms(4096, strata)) ==
          doctest::Approx(-1.5).epsilon(0.06));
    CHECK(slope(rms(16, owen), rms(4096, owen)) == doctest::Approx(-1.5).epsilon(0.1));
}

TEST_CASE("monte carlo: weights of several ways add up to 1, the mean stays") {
    using ljus::balance_heuristic, ljus::power_heuristic;
    for (double c = 0.01; c < 1; c += 0.01) {
        const double p = pdf_cosine(c), q = pdf_grazing(c);
        CHECK(balance_heuristic(p, q) + balance_heuristic(q, p) == within(1, 1e-12));
        CHECK(power_heuristic(p, q) + power_heuristic(q, p) == within(1, 1e-12));
    }
    const auto both = [](bool power) {
        return mean_of(200000, power ? 21 : 22, [power](auto& s) {
            const auto term = [power](double c, double p, double q) {
                return (power ? power_heuristic(p, q) : balance_heuristic(p, q)) *
                       f(c) / p;
            };
            const double x = to_cosine(1 - ljus::next_1d<double>(s));
            const double y = to_grazing(ljus::next_1d<double>(s));
            return term(x, pdf_cosine(x), pdf_grazing(x)) +
                   term(y, pdf_grazing(y), pdf_cosine(y));
        });
    };
    const Estimate balance = both(false), power = both(true);
    CHECK(apart(balance, truth) < 4.5);
    CHECK(apart(power, truth) < 4.5);
    // Two samples of the cosine alone: half of its variance. Both ways are better.
    const double alone = (by_cosine - truth * truth) / 2;
    CHECK(variance(balance) < 0.5 * alone);
    CHECK(variance(power) < 0.6 * alone);
}

TEST_CASE("monte carlo: roulette keeps the mean for any chance to survive") {
    for (const double chance : {0.9, 0.5, 0.1}) {
        const Estimate played = mean_of(400000, 31, [chance](auto& s) {
            ljus::RgbT<double> carried(f(ljus::next_1d<double>(s)));
            // As survives() plays: with the throughput over a threshold.
            const double threshold = carried.x / chance;
            const bool alive =
                ljus::survives(carried, 1.0, ljus::next_1d<double>(s), threshold);
            return alive ? carried.x : 0.0;
        });
        CHECK(apart(played, truth) < 4.5);
        // Var = E[f^2] / q - I^2.
        CHECK(variance(played) == within(by_uniform / chance - truth * truth, 0.04));
    }
}

TEST_CASE(
    "monte carlo: the cosine of the hemisphere is pi, and a cosine density exact") {
    const Estimate uniform = mean_of(200000, 41, [](auto& s) {
        const auto d = ljus::sample_uniform_hemisphere(ljus::next_2d<double>(s));
        return d.z / ljus::pdf_uniform_hemisphere(d);
    });
    CHECK(apart(uniform, pi) < 4.5);
    CHECK(variance(uniform) == within(pi * pi / 3, 0.04));
    const Estimate cosine = mean_of(1000, 42, [](auto& s) {
        const auto d = ljus::sample_cosine_hemisphere(ljus::next_2d<double>(s));
        return d.z / ljus::pdf_cosine_hemisphere(d);
    });
    CHECK(cosine.mean == within(pi, 1e-12));
    CHECK(standard_error(cosine) < 1e-12);
}

// 4000 runs: the share that two standard errors cover is known within 0.4 %; 2 % is
// five times that. For a normal distribution it is 95.0 %.
TEST_CASE("monte carlo: 1.96 standard errors cover the truth 95 times of 100") {
    const auto covered = [](double (*to)(double), double (*pdf)(double)) {
        int inside = 0;
        for (std::uint64_t run = 0; run < 4000; ++run) {
            const Estimate e = mean_of(256, 5000 + run, [&](auto& s) {
                const double c = to(ljus::next_1d<double>(s));
                return c > 0 ? f(c) / pdf(c) : 0.0;
            });
            inside += apart(e, truth) <= 1.96;
        }
        return inside / 4000.0;
    };
    CHECK(covered(to_cosine, pdf_cosine) == doctest::Approx(0.95).epsilon(0.02));
    // Where the variance is infinite the samples do not know how wrong they are.
    CHECK(covered(to_grazing, pdf_grazing) < 0.85);
}

TEST_CASE("monte carlo: of independent noise a block's mean keeps a tenth") {
    auto stream = stream_of(61);
    auto right = ljus::make_image<double>(200, 200, ljus::RgbT<double>(1));
    auto noisy = right, dark = right;
    for (auto& c : noisy.pixels) c += ljus::next_1d<double>(stream) - 0.5;
    for (auto& c : dark.pixels) c *= 0.9;
    // 40 000 pixels, 400 blocks: the errors are known within 1 % and 7 %.
    CHECK(ljus::rmse(noisy, right) == within(std::sqrt(1.0 / 12), 0.03));
    CHECK(ljus::block_error(noisy, right) ==
          within(ljus::rel_mse(noisy, right) / 100, 0.35));
    CHECK(ljus::block_error(dark, right) == within(ljus::rel_mse(dark, right), 1e-9));
}
