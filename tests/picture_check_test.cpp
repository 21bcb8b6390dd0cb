// rest: the programs that measure the trades, no concept of the library
// Its statistical cases: false alarms are stated beside them.
#include <doctest/doctest.h>

#include <cmath>
#include <set>
#include <utility>
#include <vector>

#include "common/picture_check.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/seed.hpp"

using namespace ljus;
using examples::PictureCheck;

namespace {

/// A check whose pixels have a true value of 1 and halves with uniform noise.
PictureCheck noisy_check(int size, double noise, RandomStream& stream) {
    PictureCheck check = examples::choose_pixels(size, size, 5);
    check.rounds = 1;
    for (auto& pixels : check.blocks)
        for (auto& pixel : pixels)
            for (auto& half : pixel.halves)
                half = RgbT<double>(check.rays() *
                                    (1 + noise * (2 * next_1d<double>(stream) - 1)));
    return check;
}

/// Pictures of the value 1 + bias in one half of the squares of 8 pixels and 1 - bias
/// in the other, with uniform noise.
ProgressiveState pictures(int size, int count, double bias, double noise,
                          RandomStream& stream) {
    ProgressiveState state{.alpha = 1};
    for (int run = 0; run < count; ++run) {
        auto image = make_image<double>(size, size);
        for (int y = 0; y < size; ++y)
            for (int x = 0; x < size; ++x) {
                const double sign = (x / 8 + y / 8) % 2 == 0 ? 1 : -1;
                pixel(image, x, y) = RgbT<double>(
                    1 + sign * bias + noise * (2 * next_1d<double>(stream) - 1));
            }
        add_pass(state, image);
    }
    return state;
}

auto square_room(bool point, bool mirror) {
    using Small =
        Scene<Shapes<Quad>, Materials<Lambertian, Mirror>, Lights<PointLight>>;
    Small scene;
    const auto matt = scene.add(Lambertian{});
    scene.add(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, matt);
    if (mirror) scene.add(Quad{{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}}, scene.add(Mirror{}));
    if (point)
        scene.add(PointLight{.position{0, 1, 0}, .intensity = Rgb{1}});
    else
        scene.add(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}, matt, Rgb{1});
    return World(std::move(scene));
}

} // namespace

TEST_CASE("picture check: its pixels differ, and lie in all parts of a picture") {
    for (const auto& [width, height] :
         {std::pair{1, 1}, {7, 3}, {48, 36}, {400, 300}, {1000, 8}}) {
        const auto check = examples::choose_pixels(width, height, 3);
        CHECK(check.blocks.size() <= 100);
        std::set<std::pair<int, int>> seen;
        int thirds[3] = {};
        for (const auto& pixels : check.blocks)
            for (const auto& pixel : pixels) {
                CHECK((pixel.x >= 0 && pixel.x < width));
                CHECK((pixel.y >= 0 && pixel.y < height));
                CHECK(pixel.x / 8 == pixels[0].x / 8);
                CHECK(pixel.y / 8 == pixels[0].y / 8);
                CHECK(seen.insert({pixel.x, pixel.y}).second);
                ++thirds[3 * pixel.y / height];
            }
        CHECK(seen.size() <= 400);
        if (width * height >= 48 * 36) CHECK(seen.size() >= 300);
        if (height > 24)
            for (const int count : thirds) CHECK(count > 0.25 * double(seen.size()));
    }
}

TEST_CASE(
    "picture check: it finds a bias below its own noise and that of the picture") {
    // Noise of variance 0.3^2 / 3 in every number, twelve times the squared bias. The
    // product of two has a standard deviation of 0.03; of 400 pixels in three channels
    // the mean has an error of 0.001. Fifty checks: five of their errors are 0.0007.
    auto stream = random_stream(ljus_test::test_seed(11), Pass::user, 0, 0);
    for (const double bias : {0.0, 0.05}) {
        double pixels = 0, blocks = 0, low = 0, high = 0;
        constexpr int trials = 50;
        for (int trial = 0; trial < trials; ++trial) {
            const auto state = pictures(80, 3, bias, 0.3, stream);
            const auto check = noisy_check(80, 0.3, stream);
            const auto found = examples::check_picture(check, state);
            pixels += found.bias.value / trials;
            blocks += found.blocks.value / trials;
            const auto stated = examples::stated_error(state, found);
            const double error = (bias * bias + 0.03 / 3) / 1.01; // with the noise
            low += stated.pixels.low <= error;
            high += stated.pixels.high >= error;
        }
        CHECK(std::abs(pixels - bias * bias / 1.01) < 0.0007);
        CHECK(std::abs(blocks - bias * bias / 1.01) < 0.0007);
        CHECK(low >= trials - 2); // three standard errors
        CHECK(high >= trials - 2);
    }
}

TEST_CASE("picture check: light that is missing in a part of the picture is found") {
    // One of two squares is black, and should be 1. No picture's scatter tells.
    auto stream = random_stream(1, Pass::user, 0, 0);
    const auto state = pictures(80, 4, 1, 0, stream); // 2 and 0
    CHECK(examples::relative_noise(state) == 0);
    const auto found = examples::check_picture(noisy_check(80, 0.1, stream), state);
    const auto stated = examples::stated_error(state, found);
    const double error = 1 / 1.01; // by pixel and by square
    CHECK(stated.pixels.high > error);
    CHECK(stated.blocks.high > error);
    CHECK(stated.pixels.low > 0.1);
    CHECK(stated.blocks.low > 0.1);
}

TEST_CASE("picture check: one picture states its whole error") {
    auto stream = random_stream(ljus_test::test_seed(2), Pass::user, 0, 0);
    const auto state = pictures(80, 1, 0.05, 0.3, stream);
    const auto found = examples::check_picture(noisy_check(80, 0.1, stream), state);
    const auto stated = examples::stated_error(state, found);
    const double error = (0.05 * 0.05 + 0.03) / 1.01;
    CHECK(stated.pixels.high > error);
    CHECK(stated.pixels.low < error);
    CHECK(stated.pixels.low > 0);
}

TEST_CASE("picture check: what it states of a picture of few squares holds") {
    // Of 8000 such pictures none had 2.25 times the stated squared error. If one in 200
    // had, 5 or more of 100 would in 3 of 10 000 runs of the test.
    auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, 0);
    for (const int size : {8, 16}) {
        int kept = 0;
        for (int trial = 0; trial < 100; ++trial) {
            const auto state = pictures(size, 1, 0, 0.3, stream);
            const auto stated = examples::stated_error(
                state, examples::check_picture(noisy_check(size, 0.1, stream), state));
            const auto means = block_means(mean_image<double>(state), 8);
            double error = 0;
            for (const auto& mean : means.pixels) {
                const auto away = mean - RgbT<double>(1);
                error += dot(away, away) / 3 / 1.01 / double(means.pixels.size());
            }
            kept += error <= 2.25 * stated.blocks.high;
        }
        CAPTURE(size);
        CHECK(kept > 95);
    }
}

TEST_CASE(
    "picture check: rounds are of different rays, and the same with any threads") {
    const auto room = square_room(false, false);
    const Camera camera = look_at({.position{0, 1, 0.9f}, .target{0, 0, 0}});
    const auto traced = [&](int threads, int rounds) {
        auto check = examples::choose_pixels(20, 20, 1);
        double time = 0;
        for (int i = 0; i < rounds; ++i)
            trace_round(check, room, camera,
                        {.width = 20, .height = 20, .threads = threads},
                        [&] { return time += 1; });
        CHECK(check.seconds == rounds);
        CHECK(check.rays() == 8 * rounds);
        return check.blocks[0][0].halves;
    };
    const auto once = traced(1, 1), twice = traced(1, 2);
    CHECK(once == traced(2, 1));
    CHECK(once[0] != once[1]);
    CHECK(twice[0] - once[0] != once[0]);
}

TEST_CASE(
    "picture check: paths do not check what mirrors make of light without a size") {
    CHECK(examples::paths_carry_all(square_room(false, false)));
    CHECK(examples::paths_carry_all(square_room(false, true)));
    CHECK(examples::paths_carry_all(square_room(true, false)));
    CHECK_FALSE(examples::paths_carry_all(square_room(true, true)));
}
