// concept: distributed_rays
// A lens against Gauss' formula, and the streams that its rays share out.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include "ljus/scene/lens_camera.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <stdexcept>
#include <vector>

#include "ljus/math/stratified_stream.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;

namespace {

template <typename T>
LensCameraT<T> camera(T radius = T(0.2), T focus = T(5)) {
    return with_lens(look_at<T>({.position{T(1), T(2), T(3)},
                                 .target{T(0), T(1), T(-4)},
                                 .vfov_degrees = T(50)}),
                     radius, focus);
}

/// Where a ray crosses the plane at a depth.
template <typename T>
Vec3T<T> crosses(const RayT<T>& ray, const CameraT<T>& at, T depth) {
    const T t = (depth - glm::dot(ray.origin - at.position, at.forward)) /
                glm::dot(ray.direction, at.forward);
    return ray.origin + t * ray.direction;
}

} // namespace

TEST_CASE_TEMPLATE("lens: all rays of a point meet in the plane of focus", T, float,
                   double) {
    const auto lens = camera<T>();
    const T most = T(40) * std::numeric_limits<T>::epsilon();
    auto numbers = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
    for (int i = 0; i < 200; ++i) {
        const Vec2T<T> pixel = next_2d<T>(numbers) * Vec2T<T>{T(60), T(40)};
        const auto pinhole = primary_ray(lens.pinhole, pixel, 60, 40);
        const auto ray = primary_ray(lens, pixel, 60, 40, next_2d<T>(numbers));
        CHECK(glm::distance(crosses(ray, lens.pinhole, lens.focus),
                            crosses(pinhole, lens.pinhole, lens.focus)) < most);
        CHECK(std::abs(glm::length(ray.direction) - T(1)) < most);
        // It starts in the plane of the lens, within its opening.
        const Vec3T<T> from = ray.origin - lens.pinhole.position;
        CHECK(std::abs(glm::dot(from, lens.pinhole.forward)) < most);
        CHECK(glm::length(from) <= lens.radius * T(1.00001));
        // A lens without an opening is a pinhole.
        const auto closed = primary_ray(camera<T>(T(0)), pixel, 60, 40, Vec2T<T>{T(1)});
        CHECK(closed.origin == pinhole.origin);
        CHECK(glm::distance(closed.direction, pinhole.direction) < most);
    }
}

TEST_CASE("lens: the opening is covered evenly") {
    const auto lens = camera<double>();
    auto numbers = random_stream(ljus_test::test_seed(2), Pass::user, 0, 0);
    std::vector<double> rings(8); // of the same area
    for (int i = 0; i < 8000; ++i) {
        const auto ray = primary_ray(lens, {3, 4}, 60, 40, next_2d<double>(numbers));
        const double r = glm::distance(ray.origin, lens.pinhole.position) / lens.radius;
        rings[std::min<std::size_t>(7, static_cast<std::size_t>(8 * r * r))] += 1;
    }
    CHECK(ljus_test::chi_square_agrees(rings, std::vector<double>(8, 1000), 4));
}

TEST_CASE("lens: the circle of confusion is the thin lens' 1/F = 1/s + 1/d") {
    // A real lens of focal length F stands d before the film, focused at s; a point at
    // z is sharp at d' and leaves a cone of the opening's width that the film cuts.
    for (const double focal : {0.01, 0.05, 0.3})
        for (const double s : {1.0, 5.0, 40.0})
            for (const double z : {0.6, 1.0, 4.0, 5.0, 7.0, 1000.0}) {
                const double radius = 0.07;
                const auto lens = camera<double>(radius, s);
                const double d = 1 / (1 / focal - 1 / s),
                             there = 1 / (1 / focal - 1 / z);
                const double on_film = 2 * radius * std::abs(there - d) / there;
                // The film is as high as the picture at distance d.
                const double film = 2 * lens.pinhole.half_height * d;
                CAPTURE(focal);
                CAPTURE(s);
                CAPTURE(z);
                CHECK(circle_of_confusion(lens, z, 400) ==
                      doctest::Approx(on_film / film * 400).epsilon(1e-9));
            }
    CHECK(circle_of_confusion(camera<double>(), 5.0, 400) == 0);
}

TEST_CASE("lens: a point out of focus is a disc of that diameter in the picture") {
    const auto lens = camera<double>(0.3, 5.0);
    const CameraT<double>& at = lens.pinhole;
    constexpr int size = 400;
    for (const double depth : {2.0, 3.5, 9.0, 100.0}) {
        const Vec3T<double> point =
            at.position + depth * (at.forward + 0.1 * at.right - 0.05 * at.up);
        // Each point of the lens sees it in the direction that crosses the plane of
        // focus where the pinhole's ray of some pixel does: project() tells which.
        auto numbers = random_stream(ljus_test::test_seed(3), Pass::user, 0, 0);
        const auto middle = project(at, point, size, size);
        REQUIRE(middle);
        double widest = 0;
        for (int i = 0; i < 4000; ++i) {
            const auto u = next_2d<double>(numbers);
            const auto on_lens = primary_ray(lens, *middle, size, size, u).origin;
            const RayT<double> sees{.origin = on_lens, .direction = point - on_lens};
            const auto pixel = project(at, crosses(sees, at, lens.focus), size, size);
            REQUIRE(pixel);
            widest = std::max(widest, 2 * glm::distance(*pixel, *middle));
            // And indeed, the lens' ray of that pixel passes through the point.
            const auto ray = primary_ray(lens, *pixel, size, size, u);
            REQUIRE(glm::distance(crosses(ray, at, depth), point) < 1e-11 * depth);
        }
        const double right = circle_of_confusion(lens, depth, size);
        CAPTURE(depth);
        CHECK(widest <= right * (1 + 1e-9));
        CHECK(widest > 0.99 * right);
    }
}

TEST_CASE("lens: what it refuses") {
    const auto pinhole = look_at(View{});
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, -1.0f, 5.0f),
                         "camera.radius is -1; it must be finite and at least 0.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)with_lens(pinhole, 0.1f, 0.0f), std::invalid_argument);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS((void)with_lens(pinhole, nan, 1.0f), std::invalid_argument);
    CHECK_THROWS_AS((void)with_lens(pinhole, 0.1f, nan), std::invalid_argument);
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, infinity, 5.0f),
                         "camera.radius is infinity; it must be finite and at least 0.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, 0.1f, infinity),
                         "camera.focus is infinity; it must be finite and above 0.",
                         std::invalid_argument);
    CHECK_NOTHROW((void)with_lens(pinhole, 0.0f, 5.0f));
}

// --- The streams ---------------------------------------------------------------------
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
    // A bounce begins at a place of its own, whatever was drawn before.
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
    REQUIRE(detail::mix_bits(ones) == ~std::uint64_t(0));
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

TEST_CASE("lens: without an opening it is a pinhole; it draws two numbers") {
    const LensCamera lens;
    CHECK(lens.radius == 0);
    CHECK(lens.focus == 1);
    const auto wide = camera<double>(0.3, 4.0);
    auto numbers = random_stream(5, Pass::user, 0, 0), same = numbers;
    const auto ray = camera_ray(wide, Vec2T<double>{30, 10}, 60, 40, numbers);
    CHECK(numbers.counter == 2);
    const auto by_hand =
        primary_ray(wide, Vec2T<double>{30, 10}, 60, 40, next_2d<double>(same));
    CHECK(ray.origin == by_hand.origin);
    CHECK(ray.direction == by_hand.direction);
    // u runs along the picture's own axes: its corner is the opening's lower left.
    const auto corner =
        primary_ray(wide, Vec2T<double>{30, 10}, 60, 40, {0, 0}).origin -
        wide.pinhole.position;
    const double s = 0.3 * std::sqrt(0.5);
    CHECK(glm::dot(corner, wide.pinhole.right) == doctest::Approx(-s));
    CHECK(glm::dot(corner, wide.pinhole.up) == doctest::Approx(-s));
}
