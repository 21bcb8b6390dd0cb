// concept: distributed_rays
// The streams that the rays of a pixel share out: cells, orders, seeds. The statistical
// cases were run with 20 further seeds (`./scripts/test --seeds 20`): none failed.
#include "ljus/math/stratified_stream.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;

TEST_CASE_TEMPLATE("stratified stream: in each draw each ray of a pixel has a cell of "
                   "its own",
                   T, float, double) {
    for (const int rays : {1, 2, 5, 10, 16, 37, 64, 1000}) {
        const Pattern pattern = make_pattern(Sampling::multi_jittered, rays);
        std::vector<std::set<int>> lines(6), across(6), up(6);
        for (int ray = 0; ray < rays; ++ray) {
            StratifiedStream stream;
            start_ray(stream, 4, 11, ray, pattern);
            for (std::size_t draw = 0; draw < 6; ++draw) {
                if (draw == 3) start_bounce(stream, 2);
                const T x = next_1d<T>(stream);
                const auto u = next_2d<T>(stream);
                REQUIRE(
                    (x >= 0 && x < 1 && u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1));
                lines[draw].insert(static_cast<int>(double(x) * rays));
                across[draw].insert(static_cast<int>(double(u.x) * rays));
                up[draw].insert(static_cast<int>(double(u.y) * rays));
            }
        }
        CAPTURE(rays);
        // In float a number next to a border may be rounded across it.
        const auto all = static_cast<std::size_t>(rays) - (sizeof(T) == 4 ? 1u : 0u);
        for (std::size_t draw = 0; draw < 6; ++draw) {
            CHECK(lines[draw].size() >= all);
            CHECK(across[draw].size() >= all);
            CHECK(up[draw].size() >= all);
        }
    }
}

TEST_CASE(
    "stratified stream: the draws of a ray do not hang together, even of two rays") {
    // The coordinates of three draws, over many pixels; 27 pairs of different draws for
    // each pattern and number. With 40 000 and more rays a correlation of 0.03 is 6
    // standard deviations.
    for (const Sampling sampling :
         {Sampling::jittered, Sampling::multi_jittered, Sampling::sobol})
        for (const int rays : {2, 3, 4, 5}) {
            const Pattern pattern = make_pattern(sampling, rays);
            double sums[7][7] = {};
            constexpr int pixels = 20000;
            for (int i = 0; i < pixels * rays; ++i) {
                StratifiedStream stream;
                start_ray(stream, 4, static_cast<std::uint64_t>(i / rays), i % rays,
                          pattern);
                double x[7] = {};
                for (int draw = 0; draw < 3; ++draw) {
                    const auto u = next_2d<double>(stream);
                    x[2 * draw] = u.x - 0.5;
                    x[2 * draw + 1] = u.y - 0.5;
                }
                x[6] = next_1d<double>(stream) - 0.5;
                for (int a = 0; a < 7; ++a)
                    for (int b = 0; b < a; ++b) sums[a][b] += x[a] * x[b];
            }
            CAPTURE(int(sampling));
            CAPTURE(rays);
            for (int a = 0; a < 7; ++a)
                for (int b = 0; b < a; ++b)
                    if (a / 2 != b / 2)
                        CHECK(std::abs(12 * sums[a][b] / (pixels * rays)) < 0.03);
        }
}

TEST_CASE("stratified stream: draws are uniform, and independent of each other") {
    // Chi-square of 8 x 8 cells of two draws over many pixels; false alarm once in
    // 30 000 for each of the three.
    std::vector<double> lens_time(64), time_light(64), within(64);
    const auto cell = [](double a, double b) {
        return static_cast<std::size_t>(8 * a) * 8 + static_cast<std::size_t>(8 * b);
    };
    constexpr int pixels = 2000, rays = 10;
    const Pattern pattern = make_pattern(Sampling::multi_jittered, rays);
    for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
        StratifiedStream stream;
        start_ray(stream, 4, pixel, static_cast<int>(pixel) % rays, pattern);
        const auto lens = next_2d<double>(stream);
        const double time = next_1d<double>(stream);
        const auto light = next_2d<double>(stream);
        lens_time[cell(lens.x, time)] += 1;
        time_light[cell(time, light.y)] += 1;
        within[cell(light.x, light.y)] += 1;
    }
    const std::vector<double> expected(64, pixels / 64.0);
    CHECK(ljus_test::chi_square_agrees(lens_time, expected, 4));
    CHECK(ljus_test::chi_square_agrees(time_light, expected, 4));
    CHECK(ljus_test::chi_square_agrees(within, expected, 4));
    // In one pixel: the place on the lens says nothing of the time.
    constexpr int many = 1024;
    double x_time = 0, y_time = 0;
    for (int ray = 0; ray < many; ++ray) {
        StratifiedStream stream;
        start_ray(stream, 4, 1, ray, make_pattern(Sampling::jittered, many));
        const auto lens = next_2d<double>(stream);
        const double time = next_1d<double>(stream);
        x_time += (lens.x - 0.5) * (time - 0.5) * 12 / many;
        y_time += (lens.y - 0.5) * (time - 0.5) * 12 / many;
    }
    CHECK(std::abs(x_time) < 4 / std::sqrt(double(many)));
    CHECK(std::abs(y_time) < 4 / std::sqrt(double(many)));
}

TEST_CASE(
    "stratified stream: the same ray draws the same numbers, another pixel others") {
    for (const Sampling sampling : {Sampling::random, Sampling::jittered,
                                    Sampling::multi_jittered, Sampling::sobol}) {
        const auto first = [&](std::uint64_t seed, std::uint64_t pixel) {
            StratifiedStream stream;
            start_ray(stream, seed, pixel, 3, make_pattern(sampling, 16));
            return next_2d<double>(stream);
        };
        CHECK(first(1, 7) == first(1, 7));
        CHECK(first(1, 7) != first(1, 8));
        CHECK(first(1, 7) != first(2, 7));
    }
}

TEST_CASE("stratified stream: by chance alone, if the picture asks for that") {
    StratifiedStream stream;
    start_ray(stream, 4, 11, 3, make_pattern(Sampling::random, 16));
    RandomStream plain = stream.rest;
    for (std::uint64_t bounce = 0; bounce < 3; ++bounce) {
        start_bounce(stream, bounce);
        start_bounce(plain, bounce);
        CHECK(next_1d<double>(stream) == next_1d<double>(plain));
        CHECK(next_2d<double>(stream) == next_2d<double>(plain));
        CHECK(next_3d<double>(stream) == next_3d<double>(plain));
    }
}

TEST_CASE("stratified stream: of which seed, pixel and path its numbers are") {
    const Pattern pattern = make_pattern(Sampling::multi_jittered, 16);
    StratifiedStream stream;
    start_ray(stream, 4, 11, 3, pattern);
    CHECK(stream.ray == 3);
    CHECK(stream.pattern.points == 16);
    CHECK(stream.dimension == 0);
    // Where in its cell a ray stands, no other ray of the picture has from the same.
    CHECK(stream.rest.key == random_stream(4, Pass::camera, 0, 11 * 16 + 3).key);
    CHECK(stream.key != random_stream(4, Pass::camera, 0, 11).key);
    StratifiedStream neighbour;
    start_ray(neighbour, 4, 11, 4, pattern);
    CHECK(neighbour.key == stream.key); // of the pixel
    CHECK(neighbour.rest.key != stream.rest.key);
    // A bounce begins at a fixed dimension, however many numbers were drawn before.
    StratifiedStream more = stream;
    (void)next_3d<double>(more);
    CHECK(more.dimension == 2);
    start_bounce(more, 5);
    CHECK(more.dimension == std::uint64_t(5) << 16);
    CHECK(more.rest.counter == std::uint64_t(5) << 16);
    // A cube's point is a square's, and then a number.
    StratifiedStream a = stream, b = stream;
    const auto xyz = next_3d<double>(a);
    CHECK(next_2d<double>(b) == Vec2T<double>{xyz.x, xyz.y});
    CHECK(next_1d<double>(b) == xyz.z);
}

TEST_CASE_TEMPLATE("stratified stream: within its part of the interval a number is as "
                   "random as the rest",
                   T, float, double) {
    for (const int rays : {1, 4, 7}) {
        const Pattern pattern = make_pattern(Sampling::multi_jittered, rays);
        for (int ray = 0; ray < rays; ++ray) {
            StratifiedStream stream;
            start_ray(stream, 4, 9, ray, pattern);
            RandomStream rest = stream.rest;
            const double u = double(next_1d<T>(stream)) * rays;
            const double within = double(next_1d<T>(rest));
            CHECK(u - std::floor(u) == doctest::Approx(within).epsilon(1e-5));
        }
    }
    const T last = T(1) - std::numeric_limits<T>::epsilon() / T(2);
    CHECK(detail::below_one(T(1)) == last);
    CHECK(detail::below_one(last) == last);
    CHECK(detail::below_one(T(0.25)) == T(0.25));
    CHECK(last < T(1));
}

TEST_CASE_TEMPLATE("stratified stream: the largest number of the last cell is below 1, "
                   "too",
                   T, float, double) {
    // mix_bits() turns this into 64 ones; a stream adds `odd` for each number.
    constexpr std::uint64_t ones = 0xcf9a04affa6badc0u, odd = 0x9e3779b97f4a7c15u;
    REQUIRE(mix_bits(ones) == ~std::uint64_t(0));
    for (const Sampling sampling : {Sampling::random, Sampling::jittered,
                                    Sampling::multi_jittered, Sampling::sobol})
        for (const int rays : {1, 2, 3, 7, 64, 1000})
            for (int ray = 0; ray < rays; ++ray)
                for (const std::uint64_t place : {1u, 2u}) {
                    StratifiedStream stream;
                    start_ray(stream, 4, 9, ray, make_pattern(sampling, rays));
                    stream.rest.key = ones - odd * place;
                    StratifiedStream other = stream;
                    const auto u = next_2d<T>(other);
                    REQUIRE((u.x < 1 && u.y < 1));
                    if (place == 1) REQUIRE(next_1d<T>(stream) < 1);
                }
}
