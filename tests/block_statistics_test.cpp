// concept: metrics
#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "ljus/inspect/metrics.hpp"
#include "support/numbers.hpp"

namespace {

using ljus::block_statistics;
using ImageD = ljus::ImageT<double>;
using RgbD = ljus::RgbT<double>;

} // namespace

TEST_CASE("block_statistics: three runs of one pixel, written out") {
    std::vector<ImageD> runs;
    for (const double value : {1.0, 2.0, 6.0})
        runs.push_back(ljus::make_image<double>(1, 1, RgbD(value, 5.0, -value)));
    const auto found = block_statistics(runs);
    // Mean 3, squares 4 + 1 + 9 = 14: sqrt(14 / 2 / 3).
    CHECK(found.runs == 3);
    CHECK(pixel(found.mean, 0, 0).x == doctest::Approx(3.0));
    CHECK(pixel(found.standard_error, 0, 0).x ==
          doctest::Approx(std::sqrt(14.0 / 2 / 3)));
    CHECK(pixel(found.standard_error, 0, 0).y == doctest::Approx(0.0));
    CHECK(pixel(found.standard_error, 0, 0).z ==
          doctest::Approx(std::sqrt(14.0 / 2 / 3)));
}

TEST_CASE("block_statistics: noise of a known size, in blocks of 25 pixels") {
    // 400 blocks of 16 runs. The mean of their squared standard errors has a standard
    // error of sqrt(2 / 15 / 1200) = 1.1 % of itself: 5 % are 4.7 of them, so that the
    // test errs once in 400 000 sets of runs.
    std::vector<ImageD> runs;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        ljus_test::Numbers numbers{seed * 7919};
        runs.push_back(ljus::make_image<double>(100, 100));
        for (RgbD& c : runs.back().pixels)
            for (int k = 0; k < 3; ++k) c[k] = 2.0 + 0.3 * numbers.noise();
    }
    const auto found = block_statistics(runs, 5);
    REQUIRE(found.mean.width == 20);
    double squares = 0, scatter = 0;
    for (std::size_t i = 0; i < 400; ++i) {
        const RgbD sure = found.standard_error.pixels[i];
        const RgbD off = found.mean.pixels[i] - 2.0;
        squares += glm::dot(sure, sure) / 1200;
        scatter += glm::dot(off, off) / 1200;
    }
    CHECK(std::abs(squares / (0.09 / 25 / 16) - 1) < 0.05);
    // What it promises: the means lie that far from the truth. 1200 squares of normal
    // numbers: 4.1 % is one standard error.
    CHECK(std::abs(scatter / squares - 1) < 0.2);
}

TEST_CASE("block_statistics: pixels that share their noise do not fool it") {
    // Each run is flat: of its 10 000 pixels all have the same error, as those of a
    // photon map have nearly.
    std::vector<ImageD> runs;
    for (const double value : {0.9, 1.1})
        runs.push_back(ljus::make_image<double>(100, 100, RgbD(value)));
    const auto found = block_statistics(runs);
    REQUIRE(found.standard_error.width == 10); // of 10 x 10 pixels, if nothing is said
    REQUIRE(found.standard_error.height == 10);
    for (const RgbD& sure : found.standard_error.pixels)
        CHECK(sure.x == doctest::Approx(0.1));
}

TEST_CASE("block_statistics: how far blocks are from the truth") {
    // Two blocks of one pixel: the first is off by 1 of its standard errors in red, by
    // any number of them in green, where there is no noise, and not at all in blue.
    std::vector<ImageD> runs;
    for (const double value : {0.5, 1.0}) {
        runs.push_back(ljus::make_image<double>(2, 1, RgbD(value)));
        pixel(runs.back(), 0, 0).y = 1;
    }
    auto truth = ljus::make_image<double>(2, 1, RgbD(0.75));
    pixel(truth, 0, 0).x = 1;
    const auto off = block_deviations(runs, truth, 1);
    REQUIRE(off.size() == 6);
    CHECK(off[0] == doctest::Approx(1));
    CHECK(std::isinf(off[1]));
    for (const std::size_t i : {2, 3, 4, 5}) CHECK(off[i] == 0);
    CHECK_THROWS_AS((void)block_deviations(runs, ljus::make_image<double>(1, 2)),
                    std::invalid_argument);
}

TEST_CASE("block_statistics: what it refuses") {
    const auto one = ljus::make_image<double>(8, 8);
    CHECK_THROWS_WITH_AS((void)block_statistics(std::vector{one}),
                         "the number of runs is 1; it must be at least 2.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)block_statistics(std::vector<ImageD>{}),
                    std::invalid_argument);
    CHECK_THROWS_AS(
        (void)block_statistics(std::vector{one, ljus::make_image<double>(8, 9)}),
        std::invalid_argument);
    CHECK_THROWS_AS((void)block_statistics(std::vector{one, one}, 0),
                    std::invalid_argument);
}
