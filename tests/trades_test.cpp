#include <doctest/doctest.h>

#include <cmath>
#include <string>

#include "common/promise.hpp"
#include "common/promised_picture.hpp"
#include "ljus/ljus.hpp"
#include "ljus/scenes/cornell_box.hpp"

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
    double operator()() const { return *time += 0.01; }
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

TEST_CASE("trades: the estimate of noise is right in the mean") {
    // Every channel is 0.5 + x with x of variance 1/48 (even in [-0.25, 0.25)); eight
    // pictures: 1/48/8 over 0.26. 4096 x 3 numbers, each estimate with a relative
    // deviation of about 0.5: 3 of 4 standard errors are 0.018.
    ProgressiveState state{.alpha = 1};
    RandomStream stream = random_stream(7, Pass::camera, 0, 0);
    for (int run = 0; run < 8; ++run) {
        auto image = make_image(64, 64);
        for (Rgb& color : image.pixels)
            for (int c = 0; c < 3; ++c)
                color[c] = 0.25f + 0.5f * next_1d<float>(stream);
        add_pass(state, image);
    }
    CHECK(examples::relative_noise(state) ==
          doctest::Approx(1.0 / 48 / 8 / 0.26).epsilon(0.03));
}

TEST_CASE("trades: a picture for some seconds takes these seconds") {
    // A clock that goes on by 0.01 s each time it is asked, three times a picture: what
    // is tested is the counting, not this machine.
    const auto room = cornell_box();
    for (const double seconds : {0.5, 1.0, 3.0}) {
        double time = 0;
        int told = 0;
        const auto kept = keep(
            room.scene, room.camera, {.width = 8, .height = 6, .threads = 1},
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
    }
}

TEST_CASE("trades: a picture for an error stops when it is there") {
    const auto room = cornell_box();
    double time = 0;
    const auto nobody = [](const auto&) {};
    const auto kept =
        keep(room.scene, room.camera, {.width = 12, .height = 12, .threads = 1},
             Promise{.error = 0.05}, Clock{&time}, true, nobody);
    CHECK(kept.error() <= 0.05);
    CHECK(kept.noise > 0);
    CHECK(kept.pictures >= 2);
    CHECK_THROWS_WITH_AS(
        (void)keep(room.scene, room.camera, {.width = 4, .height = 4, .threads = 1},
                   Promise{.error = 1e-9}, Clock{&time}, true, nobody),
        doctest::Contains(
            "--error is 1e-09; the least bias of all settings is 0.00067 here"),
        std::invalid_argument);
}

TEST_CASE("trades: without mirrors and glass the exact way has no bias") {
    const auto room = matt_cornell_box();
    double time = 0;
    const auto found =
        examples::pilot(room.scene, room.camera,
                        {.width = 8, .height = 8, .threads = 1}, 100, Clock{&time});
    REQUIRE(found.size() == 3);
    CHECK(found[2].bias == 0);
    CHECK(found[0].noise > 0);
    // No patience: one way is tried all the same.
    CHECK(examples::pilot(room.scene, room.camera,
                          {.width = 8, .height = 8, .threads = 1}, 0.0, Clock{&time})
              .size() == 1);
}
