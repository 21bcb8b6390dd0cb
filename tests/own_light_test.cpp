/// \file own_light_test.cpp
/// \brief The stage lamp of examples/own_light.hpp against closed forms.
///
/// Counts are held against chi-square, which gives a false alarm once in a million;
/// means within 5 standard errors, once in 1.7 million.

#include "own_light.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <stdexcept>
#include <vector>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/aiming.hpp"
#include "ljus/scene/world.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::Mean;
using reader::StageLamp;
using D3 = glm::dvec3;

static_assert(LightSource<StageLamp> && NearLight<StageLamp> && !FarLight<StageLamp> &&
              !FillsSky<StageLamp>);
static_assert(std::is_same_v<InSceneT<StageLamp>, StageLamp>); // as it was added

namespace {

constexpr double pi = std::numbers::pi;

using Stage = Scene<Shapes<Sphere>, Materials<Lambertian, Glass>, Lights<StageLamp>>;

World<Stage> stage_with(const StageLamp& lamp) {
    Stage stage;
    stage.add(lamp);
    return World(std::move(stage));
}

/// The irradiance of a surface that faces up, by one shadow ray without obstacles.
double irradiance(const World<Stage>& stage, const Vec3& from) {
    const auto sample = sample_light(stage, 0, from, Vec2{0.5f});
    return sample ? double(sample->weight.x) * double(sample->wi.z) : 0;
}

RandomStream stream_of(std::uint64_t path) {
    return random_stream(ljus_test::test_seed(1), Pass::user, 0, path);
}

} // namespace

TEST_CASE("own light: the irradiance at a point is I cos^n cos / d^2") {
    for (const float n : {0.0f, 1.0f, 20.0f, 300.0f}) {
        const auto stage = stage_with({.position{0, 0, 3},
                                       .axis{0, 0.6f, -0.8f},
                                       .intensity{8, 4, 2},
                                       .exponent = n});
        for (const Vec3 at :
             {Vec3{0}, Vec3{0, 2.25f, 0}, Vec3{1, 2, 0}, Vec3{-3, 4, 1}}) {
            const D3 way = D3(at) - D3{0, 0, 3};
            const double d = glm::length(way);
            const double share =
                std::pow(glm::dot(way, D3{0, 0.6, -0.8}) / d, double(n));
            CAPTURE(n);
            CHECK(irradiance(stage, at) ==
                  doctest::Approx(8 * share * -way.z / (d * d * d)).epsilon(1e-4));
            const auto sample = sample_light(stage, 0, at, Vec2{0});
            REQUIRE(sample);
            CHECK(sample->weight.z == doctest::Approx(sample->weight.x / 4));
            CHECK(sample->pdf == 0);
            CHECK(sample->point.position == Vec3{0, 0, 3});
            CHECK(glm::distance(D3(sample->wi), -way / d) < 1e-6);
        }
        CHECK_FALSE(sample_light(stage, 0, Vec3{0, -4, 3}, Vec2{0})); // behind it
        CHECK_FALSE(sample_light(stage, 0, Vec3{0, 0, 3}, Vec2{0}));  // at it
    }
}

TEST_CASE("own light: all that falls onto a floor is what the lamp sends") {
    for (const float n : {1.0f, 5.0f, 60.0f}) {
        const auto stage = stage_with(
            {.position{0, 0, 2}, .axis{0, 0, -1}, .intensity = Rgb{7}, .exponent = n});
        // Ring by ring of equal angles around the axis; E r dr = E r d / cos^2 da.
        double sum = 0;
        constexpr int rings = 20000;
        for (int i = 0; i < rings; ++i) {
            const double angle = pi / 2 * (i + 0.5) / rings, cosine = std::cos(angle);
            const double r = 2 * std::tan(angle);
            sum += irradiance(stage, {float(r), 0, 0}) * 2 * pi * r * 2 /
                   (cosine * cosine) * pi / 2 / rings;
        }
        CAPTURE(n);
        const double flux = 2 * pi * 7 / (double(n) + 1);
        CHECK(sum == doctest::Approx(flux).epsilon(1e-4));
        CHECK(double(stage.powers()[0].x) == doctest::Approx(flux).epsilon(1e-6));
    }
}

TEST_CASE("own light: photons leave it as the fall-off says, angle by angle") {
    for (const float n : {0.0f, 3.0f, 80.0f}) {
        const StageLamp lamp{.position{1, 2, 3},
                             .axis = glm::normalize(Vec3{1, -2, 0.5f}),
                             .intensity = Rgb{3},
                             .exponent = n};
        const D3 axis = glm::normalize(D3{1, -2, 0.5});
        const D3 side = glm::normalize(glm::cross(axis, D3{0, 0, 1}));
        const D3 up = glm::cross(side, axis);
        constexpr int rings = 12, slices = 8, photons = 60000;
        std::vector<double> counts(rings * slices), expected;
        for (std::uint64_t i = 0; i < photons; ++i) {
            auto stream = stream_of(i);
            const Vec2 u = next_2d<float>(stream), v = next_2d<float>(stream);
            const auto leaving = emit_photon(lamp, u, v, 0.0f);
            REQUIRE(leaving.ray.origin == lamp.position);
            REQUIRE(leaving.flux == power(lamp));
            const D3 d{leaving.ray.direction};
            REQUIRE(glm::length(d) == doctest::Approx(1).epsilon(1e-5));
            const int ring = std::clamp(int(glm::dot(d, axis) * rings), 0, rings - 1);
            const double phi = std::atan2(glm::dot(d, up), glm::dot(d, side));
            const int slice =
                std::clamp(int((phi / (2 * pi) + 0.5) * slices), 0, slices - 1);
            ++counts[std::size_t(ring * slices + slice)];
        }
        // The share below a cosine c is c^(n + 1).
        for (int ring = 0; ring < rings; ++ring)
            for (int slice = 0; slice < slices; ++slice)
                expected.push_back(photons *
                                   (std::pow((ring + 1.0) / rings, double(n) + 1) -
                                    std::pow(ring / double(rings), double(n) + 1)) /
                                   slices);
        CAPTURE(n);
        CHECK(ljus_test::chi_square_agrees(counts, expected,
                                           ljus_test::once_in_a_million));
    }
}

TEST_CASE("own light: aimed photons bring a ball what those sent everywhere bring") {
    // Two balls, one partly hidden by the other, near the axis of the lamp;
    // the near one is seen in a narrow cone around the axis, 1 - cos^(n + 1) of it all.
    Stage open;
    const auto glass = open.add(Glass{});
    open.add(Sphere{.center{0, 0, -4}, .radius = 1}, glass);
    open.add(Sphere{.center{2, 0, -7}, .radius = 1.5f}, glass);
    open.add(StageLamp{.axis{0, 0, -1}, .intensity = Rgb{5}, .exponent = 9});
    const World stage(std::move(open));
    const auto targets = specular_objects(stage);
    REQUIRE(targets.size() == 2);
    Mean aimed[2], blind[2];
    for (std::uint64_t i = 0; i < 60000; ++i) {
        auto stream = stream_of(i);
        const auto photon = aim(stage, stage.light_choice(), targets, stream);
        auto other = stream_of(1'000'000 + i);
        const auto sent = emit(stage, stage.light_choice(), other);
        const auto met = closest_hit(stage, sent.ray);
        for (std::size_t k = 0; k < 2; ++k) {
            const bool kept =
                photon && photon->target == targets[k] &&
                closest_hit(stage, photon->photon.ray)->object == targets[k];
            aimed[k].add(kept ? double(photon->photon.flux.x) : 0);
            blind[k].add(met && met->object == targets[k] ? double(sent.flux.x) : 0);
        }
    }
    const double cosine = std::sqrt(15.0) / 4;
    const double right = 2 * pi * 5 / 10 * (1 - std::pow(cosine, 10));
    CHECK(aimed[0].agrees_with(right));
    CHECK(blind[0].agrees_with(right));
    CHECK(std::abs(apart(aimed[1], blind[1])) < 5);
    CHECK(aimed[0].error() < 0.02 * right);
    CHECK(aimed[1].error() < 0.03 * aimed[1].mean);
}

TEST_CASE("own light: what no picture can be made with is refused by name") {
    Stage stage;
    CHECK_NOTHROW(stage.add(StageLamp{}));
    const auto add = [&](const StageLamp& lamp) { stage.add(lamp); };
    CHECK_THROWS_WITH_AS(add({.axis{0, 0, -2}}), doctest::Contains("stage lamp.axis"),
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(add({.intensity = Rgb{-1}}),
                         doctest::Contains("stage lamp.intensity"),
                         std::invalid_argument);
    for (const float n : {-1.0f, 1001.0f, std::nanf("")})
        CHECK_THROWS_WITH_AS(add({.exponent = n}),
                             doctest::Contains("stage lamp.exponent"),
                             std::invalid_argument);
    CHECK_THROWS_WITH_AS(add({.position{0, std::nanf(""), 0}}),
                         doctest::Contains("stage lamp.position"),
                         std::invalid_argument);
    CHECK(stage.light_count() == 1);
}
