// concept: monte_carlo
/// \file estimate_test.cpp
/// \brief Means with standard errors, in one pass.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/inspect/estimate.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "support/draws.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using ljus::Estimate;
using ljus_test::within;

namespace {

Estimate estimate_of(const std::vector<double>& samples) {
    Estimate estimate;
    for (const double x : samples) add(estimate, x);
    return estimate;
}

} // namespace

TEST_CASE("estimate: four numbers, worked out by hand") {
    const Estimate e = estimate_of({2, 4, 4, 6});
    CHECK(e.count == 4);
    CHECK(e.mean == 4);
    CHECK(e.squares == 8);
    CHECK(variance(e) == within(8.0 / 3, 1e-15));
    CHECK(standard_error(e) == within(std::sqrt(8.0 / 3 / 4), 1e-15));
}

TEST_CASE("estimate: from fewer than two samples nothing can be told") {
    CHECK(std::isinf(variance(Estimate{})));
    CHECK(std::isinf(standard_error(Estimate{})));
    const Estimate one = estimate_of({3});
    CHECK(one.mean == 3);
    CHECK(std::isinf(variance(one)));
    CHECK(std::isinf(standard_error(one)));
    const Estimate two = estimate_of({3, 3});
    CHECK(variance(two) == 0);
    CHECK(standard_error(two) == 0);
}

TEST_CASE("estimate: a large mean does not eat the deviation") {
    // Whole numbers beside 10^9: exact in double, and so are the sums of the distances.
    const double far = 1e9;
    Estimate e;
    double sum = 0, squares = 0;
    for (int i = 0; i < 1000; ++i) {
        const double x = far + (i % 2);
        add(e, x);
        sum += x;
        squares += x * x;
    }
    CHECK(variance(e) == within(250.0 / 999, 1e-6));
    const double textbook = (squares - sum * sum / 1000) / 999;
    CHECK(std::abs(textbook - 250.0 / 999) > 0.01);
}

TEST_CASE("estimate: two halves joined are the whole") {
    ljus_test::Draws draws{ljus_test::test_seed(5)};
    std::vector<double> all;
    for (int i = 0; i < 1001; ++i) all.push_back(100 * draws.unit<double>());
    const Estimate whole = estimate_of(all);
    for (const std::ptrdiff_t cut : {0, 1, 2, 500, 1000, 1001}) {
        const Estimate both = joined(estimate_of({all.begin(), all.begin() + cut}),
                                     estimate_of({all.begin() + cut, all.end()}));
        CHECK(both.count == whole.count);
        CHECK(both.mean == within(whole.mean, 1e-12));
        CHECK(both.squares == within(whole.squares, 1e-12));
    }
    const Estimate nothing = joined(Estimate{}, Estimate{});
    CHECK(nothing.count == 0);
    CHECK(nothing.mean == 0);
    CHECK(nothing.squares == 0);
}

// 20 000 estimates of 10 samples each. The mean of their variances has a relative
// standard error of 0.2 %; 1 % off comes by chance once in two million runs.
TEST_CASE("estimate: the variance has the right mean, also of few samples") {
    ljus_test::Draws draws{ljus_test::test_seed(7)};
    double sum = 0;
    for (int run = 0; run < 20000; ++run) {
        Estimate e;
        for (int i = 0; i < 10; ++i) add(e, draws.unit<double>());
        sum += variance(e) / 20000;
    }
    CHECK(sum == within(1.0 / 12, 0.01));
}

TEST_CASE("estimate: how often noise alone is this far from the truth") {
    // With one and two degrees of freedom Student's distribution has a closed form.
    for (const double errors : {0.1, 1.0, 3.0, 10.0}) {
        CHECK(ljus::chance_beyond(errors, 2) ==
              doctest::Approx(1 - 2 / std::numbers::pi * std::atan(errors)));
        CHECK(ljus::chance_beyond(errors, 3) ==
              doctest::Approx(1 - errors / std::sqrt(2 + errors * errors)));
        CHECK(ljus::chance_beyond(errors, 1e6) ==
              doctest::Approx(std::erfc(errors / std::sqrt(2.0))).epsilon(0.01));
        for (const double count : {1e8, 1e12, 1e300}) // it is nearly normal
            CHECK(std::abs(ljus::chance_beyond(errors, count) -
                           std::erfc(errors / std::sqrt(2.0))) < 1e-6);
    }
    CHECK(ljus::chance_beyond(0, 5) == 1);
    for (const double errors : {1e6, std::numeric_limits<double>::infinity()})
        for (const double count : {3.0, 16.0, 1e6})
            CHECK(std::abs(ljus::chance_beyond(errors, count)) < 1e-6);
}

TEST_CASE("estimate: a sample that is no number shows") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const Estimate e = estimate_of({1, nan, 2});
    CHECK(std::isnan(e.mean));
    CHECK(std::isnan(standard_error(e)));
}
