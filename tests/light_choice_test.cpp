/// \file light_choice_test.cpp
/// \brief One light of many, in proportion to its power.

#include "ljus/scene/world.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "support/numbers.hpp"

using namespace ljus;

namespace {

template <typename T>
constexpr T below_one = T(1) - std::numeric_limits<T>::epsilon() / 2;

} // namespace

TEST_CASE("light choice: the power of a light is the sum of its channels") {
    const auto choice = light_choice(std::vector<Rgb>{{1, 0, 0}, {1, 1, 1}, {0, 2, 4}});
    CHECK(choice.cumulative == std::vector<double>{1, 4, 10});
    CHECK(probability_of<float>(choice, 0) == 0.1f);
    CHECK(probability_of<float>(choice, 1) == 0.3f);
    CHECK(probability_of<float>(choice, 2) == 0.6f);
}

TEST_CASE_TEMPLATE("light choice: probabilities sum to 1", T, float, double) {
    ljus_test::Numbers n;
    for (int count = 1; count < 200; ++count) {
        std::vector<Rgb> fluxes;
        for (int i = 0; i < count; ++i)
            fluxes.push_back(Rgb{float(n.power(-3, 3)), float(n.power(-3, 3)), 0});
        const auto choice = light_choice(fluxes);
        double sum = 0;
        for (std::uint32_t i = 0; i < fluxes.size(); ++i) {
            const T p = probability_of<T>(choice, i);
            REQUIRE(p > 0);
            sum += double(p);
        }
        REQUIRE(sum == doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE_TEMPLATE("light choice: the extremes of u choose the first and the last", T,
                   float, double) {
    for (const std::size_t count : {1u, 2u, 3u, 10u, 1000u}) {
        const auto choice =
            light_choice(std::vector<Rgb>(count, Rgb{0.1f, 0.2f, 0.3f}));
        CHECK(choose_light(choice, T(0)).light == 0);
        CHECK(choose_light(choice, below_one<T>).light == count - 1);
        // Even u = 1, which no stream gives, stays among the lights.
        CHECK(choose_light(choice, T(1)).light == count - 1);
    }
}

TEST_CASE_TEMPLATE("light choice: what is chosen comes with its probability", T, float,
                   double) {
    const auto choice =
        light_choice(std::vector<Rgb>{{1, 2, 3}, {10, 0, 0}, {0, 0, 0.5f}});
    std::vector<double> counts(3);
    constexpr int many = 1 << 16;
    for (int i = 0; i < many; ++i) { // every cell of u once: no statistics
        const auto chosen = choose_light(choice, T(i) / T(many));
        REQUIRE(chosen.probability == probability_of<T>(choice, chosen.light));
        ++counts[chosen.light];
    }
    for (std::uint32_t light = 0; light < 3; ++light)
        CHECK(std::abs(counts[light] - many * probability_of<double>(choice, light)) <=
              1);
}

TEST_CASE_TEMPLATE("light choice: a light without power is never chosen", T, float,
                   double) {
    for (std::size_t dark = 0; dark < 4; ++dark) {
        std::vector<Rgb> fluxes(4, Rgb{0, 0, 1}); // a channel may well be zero
        fluxes[dark] = Rgb{0};
        const auto choice = light_choice(fluxes);
        CHECK(probability_of<T>(choice, std::uint32_t(dark)) == T(0));
        for (int i = 0; i <= 3000; ++i) {
            const T u = i == 3000 ? below_one<T> : T(i) / T(3000);
            const auto chosen = choose_light(choice, u);
            REQUIRE(chosen.light != dark);
            REQUIRE(chosen.probability > 0);
        }
    }
}

TEST_CASE("light choice: lights of all powers that float can say") {
    // The flux of a photon is a light's flux over the probability: never infinite.
    const std::vector<Rgb> fluxes{Rgb{1e-38f}, Rgb{1e38f}, Rgb{1e-40f}, Rgb{1}};
    const auto choice = light_choice(fluxes);
    for (const float u : {0.0f, 0x1p-24f, 0.5f, below_one<float>}) {
        const auto chosen = choose_light(choice, u);
        REQUIRE(chosen.probability > 0);
        CHECK(is_finite(fluxes[chosen.light] / chosen.probability));
    }
}
