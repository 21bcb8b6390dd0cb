// rest: the programs that measure the trades, no concept of the library
// Its statistical cases were run with 20 further seeds: none failed.
#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/promise.hpp"
#include "common/promised_picture.hpp"
#include "ljus/ljus.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using namespace ljus;
using examples::Choice;
using examples::Forecast;
using examples::Promise;

namespace {

/// A quick way that blurs, one between, and a slow one that hardly does.
const std::vector<Forecast> ways{{0.1, 0.02, 0.01}, {0.5, 0.01, 0.002}, {2, 0.04, 0}};

/// Counts seconds as a test says.
struct Clock {
    double* time;
    double step = 0.01;
    double operator()() const { return *time += step; }
};

} // namespace

TEST_CASE("trades: seconds get the least error that fits") {
    // 10 s: 100 pictures have 0.01 + 0.0002, 20 have 0.002 + 0.0005, 5 have 0.008.
    const Choice ten = choose(ways, Promise{.seconds = 10}, 10);
    CHECK(ten.recipe == 1);
    CHECK(ten.pictures == 20);
    CHECK(ten.error == doctest::Approx(0.0025));
    CHECK(ten.seconds == doctest::Approx(10));
    CHECK(ten.possible);
    // 1000 s: bias decides, and the slow one has none.
    CHECK(choose(ways, Promise{.seconds = 1000}, 1000).recipe == 2);
    // 0.4 s: only the quick one makes two pictures.
    const Choice short_one = choose(ways, Promise{.seconds = 0.4}, 0.4);
    CHECK(short_one.recipe == 0);
    CHECK(short_one.pictures == 4);
    // 1.25 s: two or three of 0.5 s miss it by a fifth; twelve of 0.1 s do not.
    const Choice odd = choose(ways, Promise{.seconds = 1.25}, 1.25);
    CHECK(odd.recipe == 0);
    CHECK(odd.pictures == 13);
    // What the pilot took is gone: 10 s are promised, 0.3 s are left.
    CHECK(choose(ways, Promise{.seconds = 10}, 0.3).recipe == 0);
}

TEST_CASE("trades: seconds that nothing fits get the quickest way") {
    for (const double seconds : {0.01, 0.1, 1e-9}) {
        const Choice choice = choose(ways, Promise{.seconds = seconds}, seconds);
        CHECK_FALSE(choice.possible);
        CHECK(choice.recipe == 0);
        CHECK(choice.pictures == 1);
    }
    const Choice late = choose(ways, Promise{.seconds = 1}, -3); // the pilot took all
    CHECK_FALSE(late.possible);
    CHECK(late.pictures == 1);
}

TEST_CASE("trades: an error is reached by the quickest way whose bias allows it") {
    // 0.031: one picture of the first has 0.03, but two are needed to know: 0.2 s.
    const Choice rough = choose(ways, Promise{.error = 0.031});
    CHECK(rough.recipe == 0);
    CHECK(rough.pictures == 2);
    // 0.0125: the first could, by 10 pictures, but its bias is more than half of that.
    const Choice fine = choose(ways, Promise{.error = 0.0125});
    CHECK(fine.recipe == 1);
    CHECK(fine.pictures == 2);
    CHECK(fine.possible);
    // 0.001: only the one without bias, by 42 pictures: 0.04 (1 + 2/42) / 42.
    const Choice finest = choose(ways, Promise{.error = 0.001});
    CHECK(finest.recipe == 2);
    CHECK(finest.pictures == 42);
    CHECK(finest.seconds == doctest::Approx(84));
    CHECK(finest.error == doctest::Approx(0.04 / 42));
}

TEST_CASE("trades: an error below every bias cannot be reached") {
    const std::vector<Forecast> biased{{0.1, 0.02, 0.01}, {0.5, 0.01, 0.002}};
    const Choice none = choose(biased, Promise{.error = 0.001});
    CHECK_FALSE(none.possible);
    CHECK(none.recipe == 1); // the least bias
    // Between half of it and all of it: it is tried, by as many as the noise asks for.
    const Choice close = choose(biased, Promise{.error = 0.003});
    CHECK_FALSE(close.possible);
    CHECK(close.recipe == 1);
    CHECK(close.pictures == 12);
    const Choice for_ever = choose({{1, 1e30, 0}}, Promise{.error = 1e-9});
    CHECK(for_ever.pictures == 1'000'000'000'000);
}

TEST_CASE("trades: a bias that is not well known counts as a larger one") {
    // As much as half of the error, and known: allowed; with an error of its own: not.
    std::vector<Forecast> unsure{{0.1, 0.02, 0.005}, {0.5, 0.02, 0}};
    CHECK(choose(unsure, Promise{.error = 0.01}).recipe == 0);
    unsure[0].unsure = 0.001;
    CHECK(choose(unsure, Promise{.error = 0.01}).recipe == 1);
    // Its standard error takes room from the noise, but never more than half.
    CHECK(examples::room_for_noise({.bias = 0.002}, 0.01) == doctest::Approx(0.008));
    CHECK(examples::room_for_noise({.bias = 0.002, .unsure = 0.003}, 0.01) ==
          doctest::Approx(0.005));
    CHECK(examples::room_for_noise({.bias = 0.002, .unsure = 0.1}, 0.01) ==
          doctest::Approx(0.004));
    CHECK(examples::room_for_noise({.bias = 0.02}, 0.01) < 0);
    // 0.02 (1 + 2/n) / n below 0.008 - 0.003: 6 pictures, where 0.008 needs 4.
    const std::vector<Forecast> one{{0.1, 0.02, 0.002, 0.003}};
    CHECK(choose(one, Promise{.error = 0.01}).pictures == 6);
}

TEST_CASE("trades: a measured bias and an expected one are weighed by their errors") {
    constexpr double never = std::numeric_limits<double>::infinity();
    const Forecast book = examples::weigh(0, never, 0.003);
    CHECK(book.bias == 0.003);
    CHECK(book.unsure == 0.003);
    const Forecast known = examples::weigh(0.001, 0, 0.003);
    CHECK(known.bias == 0.001);
    CHECK(known.unsure == 0);
    // Of equal weight: the mean, known better by a factor of the root of 2.
    const Forecast both = examples::weigh(0.001, 0.003, 0.003);
    CHECK(both.bias == doctest::Approx(0.002));
    CHECK(both.unsure == doctest::Approx(0.003 / std::sqrt(2.0)));
    CHECK(examples::weigh(-0.001, 0.003, 0.003).bias == doctest::Approx(0.0015));
    CHECK(examples::weigh(-0.001, 0, 0.003).bias == 0);
    CHECK(examples::weigh(0.001, 0.5, 0).bias == 0); // the book is sure of it
}

TEST_CASE("trades: the error of a bias, by leaving out each run in turn") {
    // Runs of 1, 2 and 4 in every channel: the products of two are 2, 4 and 8, and so
    // is what is left without one. Their variance about 14/3 is 56/9; times 2 = n - 1.
    std::vector<ImageT<double>> runs;
    for (const double value : {1.0, 2.0, 4.0})
        runs.push_back(make_image<double>(3, 2, RgbT<double>{value}));
    CHECK(bias_variance(runs, make_image<double>(3, 2)).bias_squared ==
          doctest::Approx(14.0 / 3));
    CHECK(examples::bias_error(runs) == doctest::Approx(std::sqrt(2 * 56.0 / 9)));
    runs.pop_back();
    CHECK(std::isinf(examples::bias_error(runs)));
}

TEST_CASE("trades: the error of a bias is that of its estimates") {
    // 200 estimates, each from 8 runs with a bias of 0.2 in all pixels and even noise
    // in [-0.5, 0.5). Their mean is within 4 of their standard errors (false alarms: 1
    // in 16 000), and the mean of the squared errors that they state is 1 to 1.5 times
    // their variance, which 200 numbers tell to 10 %: 3 and 4 of these are allowed.
    RandomStream stream = random_stream(ljus_test::test_seed(8), Pass::camera, 0, 0);
    const auto none = make_image<double>(6, 6);
    double sum = 0, squares = 0, stated = 0;
    constexpr int trials = 200;
    for (int trial = 0; trial < trials; ++trial) {
        std::vector<ImageT<double>> runs(8, none);
        for (auto& run : runs)
            for (auto& color : run.pixels)
                for (int c = 0; c < 3; ++c)
                    color[c] = 0.2 + next_1d<double>(stream) - 0.5;
        const double estimate = bias_variance(runs, none).bias_squared;
        sum += estimate;
        squares += estimate * estimate;
        stated += examples::bias_error(runs) * examples::bias_error(runs) / trials;
    }
    const double mean = sum / trials, variance = squares / trials - mean * mean;
    CHECK(std::abs(mean - 0.04) < 4 * std::sqrt(variance / trials));
    CHECK(stated / variance > 0.7);
    CHECK(stated / variance < 1.9);
}

TEST_CASE("trades: what was chosen is said in two sentences") {
    const auto names = examples::recipes(100, 100);
    const Promise promise{.seconds = 10};
    const std::string why =
        reason(ways, names, promise, choose(ways, promise, promise.seconds));
    CHECK(why == "The mean of 20 pictures by fast, 0.5 s each, is expected to have "
                 "relMSE 0.0025, of which 0.002 is bias: the least error for these "
                 "seconds. The others: draft relMSE 0.01 in 10 s, exact relMSE 0.008 "
                 "in 10 s.");
    const Promise fine{.error = 0.001};
    CHECK(reason(ways, names, fine, choose(ways, fine)) ==
          "The mean of 42 pictures by exact, 2 s each, is expected to have relMSE "
          "0.00095, of which 0 is bias: the quickest way to this error. The others: "
          "draft "
          "never gets there, fast never gets there.");
    CHECK(reason({ways[0]}, names, promise, {}).find("no time to try another") !=
          std::string::npos);
    const std::vector<Forecast> unsure{{0.1, 0.02, 0.01, 0.005}};
    CHECK(reason(unsure, names, promise, {}).find("of which 0.01 ± 0.005 is bias") !=
          std::string::npos);
}

TEST_CASE("trades: noise is told by the scatter of pictures") {
    // Two pictures of 1 and 3: mean 2, variance of the mean 1, over 4.01.
    ProgressiveState state{.alpha = 1};
    CHECK(std::isinf(examples::relative_noise(state)));
    for (const float value : {1.0f, 3.0f}) {
        auto image = make_image(5, 4);
        for (Rgb& color : image.pixels) color = Rgb{value};
        CHECK(std::isinf(examples::relative_noise(state)));
        add_pass(state, image);
    }
    CHECK(examples::relative_noise(state) == doctest::Approx(1 / 4.01));
}

TEST_CASE("trades: noise is relative to the pixel, where that is known") {
    // One pixel of 8 x 8 is a lamp of 10 +- 1 in two pictures, the others are 0.1: its
    // variance of the mean, 1, is over 10^2, not over what is around.
    const auto noise_of = [](float first, float second) {
        ProgressiveState state{.alpha = 1};
        for (const float value : {first, second}) {
            auto image = make_image(8, 8, Rgb{0.1f});
            pixel(image, 3, 3) = Rgb{value};
            add_pass(state, image);
        }
        return 64 * examples::relative_noise(state);
    };
    CHECK(noise_of(9, 11) ==
          ljus_test::within(1 / 100.01, 0.06)); // 4 % of it is around
    // A firefly: 10 once, and 0.1 as all around. Over the mean of nine, 0.65.
    CHECK(noise_of(0.1f, 10) ==
          ljus_test::within(4.95 * 4.95 / (0.65 * 0.65 + 0.01), 1e-4));
    // Black except for it: no division by 0.
    CHECK(std::isfinite(noise_of(0, 0)));
    CHECK(noise_of(0, 0) == 0);
}

TEST_CASE("trades: the estimate of noise is right in the mean") {
    // Every channel is 0.5 + x with x of variance 1/48 (even in [-0.25, 0.25)); eight
    // pictures: 1/48/8 over 0.26. 4096 x 3 numbers, each estimate with a relative
    // deviation of about 0.5: 4 standard errors are 0.018. The mean of eight is known
    // to a tenth, which adds 0.03.
    ProgressiveState state{.alpha = 1};
    RandomStream stream = random_stream(ljus_test::test_seed(7), Pass::camera, 0, 0);
    for (int run = 0; run < 8; ++run) {
        auto image = make_image(64, 64);
        for (Rgb& color : image.pixels)
            for (int c = 0; c < 3; ++c)
                color[c] = 0.25f + 0.5f * next_1d<float>(stream);
        add_pass(state, image);
    }
    CHECK(examples::relative_noise(state) ==
          ljus_test::within(1.0 / 48 / 8 / 0.26, 0.06));
}

TEST_CASE("trades: a picture for some seconds takes these seconds") {
    // A clock that goes on by 0.01 s each time it is asked, three times a picture: what
    // is tested is the counting, not this machine.
    const auto room = cornell_box();
    for (const double seconds : {0.5, 1.0, 3.0}) {
        double time = 0;
        int told = 0;
        const auto kept = keep(
            room.world, room.camera, {.width = 8, .height = 6, .threads = 1},
            Promise{.seconds = seconds}, Clock{&time}, true, [&](const auto& before) {
                ++told;
                CHECK(before.pictures == 0);
            });
        CHECK(told == 1);
        CHECK(kept.pictures >= 2);
        CHECK(kept.rendered.image.width == 8);
        CHECK(kept.rendered.image.height == 6);
        CHECK(std::abs(time - seconds) <= 0.2 * seconds);
        CHECK(kept.error() >= kept.noise);
        // Its 48 pixels are path traced, and take a fifth of the pictures' time or more.
        CHECK(kept.checked_pixels() == 48);
        CHECK(kept.stated.pixels.low <= kept.error());
        CHECK(kept.stated.pixels.high >= kept.error());
        CHECK(kept.stated.blocks.high >= kept.stated.blocks.low);
        CHECK(stated_text(kept).find("48 path-traced pixels") != std::string::npos);
    }
}

TEST_CASE("trades: a picture for an error stops when it is there") {
    const auto room = cornell_box();
    double time = 0;
    const auto nobody = [](const auto&) {};
    const auto kept =
        keep(room.world, room.camera, {.width = 12, .height = 12, .threads = 1},
             Promise{.error = 0.05}, Clock{&time}, true, nobody);
    CHECK(kept.error() <= 0.05);
    CHECK(kept.noise > 0);
    CHECK(kept.pictures >= 2);
    CHECK_THROWS_WITH_AS(
        (void)keep(room.world, room.camera, {.width = 4, .height = 4, .threads = 1},
                   Promise{.error = 1e-9}, Clock{&time, 1.0}, true, nobody),
        doctest::Contains("--error is 1e-09; the least bias of all settings is "
                          "0.00022 here"),
        std::invalid_argument);
}

TEST_CASE("trades: without mirrors and glass the exact way has no bias") {
    const auto room = matt_cornell_box();
    double time = 0;
    const auto found = examples::pilot(room.world, room.camera,
                                       {.width = 8, .height = 8, .threads = 1},
                                       Promise{.seconds = 8}, Clock{&time});
    REQUIRE(found.size() == 3);
    CHECK(found[2].bias == 0);
    CHECK(found[0].noise > 0);
    // No patience: one way is tried all the same.
    CHECK(examples::pilot(room.world, room.camera,
                          {.width = 8, .height = 8, .threads = 1},
                          Promise{.seconds = 1e-3}, Clock{&time})
              .size() == 1);
}
