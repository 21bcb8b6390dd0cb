/// \file absorption_test.cpp
/// \brief Beer and Lambert's law, and the absorption that gives a colour.

#include "ljus/optics/absorption.hpp"
#include "support/refusal.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

using ljus::Rgb, ljus::absorption_from_color, ljus::transmittance;

TEST_CASE("absorption: white light has the colour after the distance, and its square "
          "after twice as much") {
    const Rgb color{0.9f, 0.5f, 0.01f};
    for (const float distance : {0.01f, 1.0f, 250.0f}) {
        const Rgb sigma = absorption_from_color(color, distance);
        const Rgb once = transmittance(sigma, distance);
        const Rgb twice = transmittance(sigma, 2 * distance);
        for (int i = 0; i < 3; ++i) {
            CHECK(once[i] == doctest::Approx(color[i]).epsilon(1e-6));
            CHECK(twice[i] == doctest::Approx(color[i] * color[i]).epsilon(2e-6));
        }
        CHECK(transmittance(sigma, 0.0f) == Rgb{1, 1, 1});
    }
}

TEST_CASE("absorption: clear is exactly clear, at any distance") {
    const Rgb sigma = absorption_from_color(Rgb{1, 1, 1}, 3.0f);
    CHECK(sigma == Rgb{0, 0, 0});
    CHECK_FALSE(std::signbit(sigma.x));
    CHECK(transmittance(sigma, 1e30f) == Rgb{1, 1, 1});
    CHECK(transmittance(Rgb{0, 1, 0}, 1e30f) == Rgb{1, 0, 1}); // underflows, quietly
}

TEST_CASE("absorption: the half-value way") {
    const ljus::RgbT<double> sigma{std::log(2.0), 2 * std::log(2.0), 0};
    const auto t = transmittance(sigma, 1.0);
    CHECK(t.x == doctest::Approx(0.5).epsilon(1e-15));
    CHECK(t.y == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(t.z == 1);
}

TEST_CASE("absorption: what cannot be is refused with a sentence") {
    const auto message = [](Rgb color, float distance) {
        return ljus_test::refusal(
            [&] { (void)absorption_from_color(color, distance); });
    };
    CHECK(message({0.5f, 0.5f, 0.5f}, 1).empty());
    CHECK(message({1, 0, 1}, 1) ==
          "absorption.color is (1, 0, 1); it must be above 0 in every "
          "channel, because no finite absorption reaches 0.");
    for (int channel = 0; channel < 3; ++channel) {
        Rgb color{0.5f};
        color[channel] = 0;
        CHECK(message(color, 1).find("above 0 in every") != std::string::npos);
        color[channel] = 1e-30f;
        CHECK(message(color, 1).empty());
    }
    CHECK(message({1, 1.5f, 1}, 1).find("within [0, 1]") != std::string::npos);
    CHECK(message({1, 1, NAN}, 1).find("absorption.color") != std::string::npos);
    CHECK(message({1, 1, 1}, 0) ==
          "absorption.distance is 0; it must be finite and above 0.");
    CHECK(message({1, 1, 1}, NAN).find("absorption.distance is NaN") == 0);
}
