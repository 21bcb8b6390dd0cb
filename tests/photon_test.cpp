/// \file photon_test.cpp
/// \brief What a photon takes in memory, and that no flux is lost on its way.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/photons/photon.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <stdexcept>
#include <type_traits>

#include "ljus/geometry/shape.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/tracing.hpp"
#include "support/draws.hpp"
#include "support/seed.hpp"

using ljus::FluxAudit;
using ljus::Rgb;
using ljus_test::Draws;
using RgbD = ljus::RgbT<double>; ///< Accounts are kept in double.

TEST_CASE("photon: 44 bytes in float, and a plain value") {
    CHECK(sizeof(ljus::Photon) == 44);
    CHECK(sizeof(ljus::PhotonT<double>) == 80);
    CHECK(sizeof(ljus::PhotonKind) == 1);
    CHECK(std::is_trivially_copyable_v<ljus::Photon>);
    CHECK(ljus::Photon{}.kind == ljus::PhotonKind::direct);
    CHECK(ljus::Photon{}.flux == Rgb{0});
}

TEST_CASE("photon: a normal in three bytes is less than half a degree wrong") {
    Draws numbers{ljus_test::test_seed(5)};
    for (int i = 0; i < 10000; ++i) {
        const glm::dvec3 n = glm::normalize(numbers.point<double>(1));
        const glm::dvec3 kept(ljus::small_normal(ljus::Vec3(n)));
        const double sine = glm::length(glm::cross(n, kept)) / glm::length(kept);
        REQUIRE(glm::dot(n, kept) > 0);
        REQUIRE(std::asin(sine) < 0.5 * std::numbers::pi / 180);
    }
    CHECK(ljus::small_normal(ljus::Vec3{0, -1, 0}) ==
          ljus::detail::SmallNormal{0, -127, 0});
}

TEST_CASE("photon: turned away from 60 degrees on, and never without a normal") {
    for (int degrees = 0; degrees <= 180; ++degrees) {
        if (degrees == 60) continue; // a rounded normal may lie on either side
        const double angle = degrees * std::numbers::pi / 180;
        const ljus::Vec3 n(std::sin(angle), 0, std::cos(angle));
        CAPTURE(degrees);
        CHECK(ljus::detail::turned_away(ljus::small_normal(n), ljus::Vec3{0, 0, 1}) ==
              (degrees > 60));
    }
    CHECK_FALSE(
        ljus::detail::turned_away(ljus::detail::SmallNormal{0}, ljus::Vec3{0, 0, 1}));
}

TEST_CASE("photon: accounts are added part by part") {
    FluxAudit sum{RgbD{1, 2, 3}, RgbD{4}, RgbD{5}, RgbD{6}, RgbD{-7}};
    sum += FluxAudit{RgbD{10}, RgbD{20, 21, 22}, RgbD{30}, RgbD{40}, RgbD{50}};
    CHECK(sum.emitted == RgbD{11, 12, 13});
    CHECK(sum.absorbed == RgbD{24, 25, 26});
    CHECK(sum.escaped == RgbD{35});
    CHECK(sum.cut == RgbD{46});
    CHECK(sum.roulette == RgbD{43});
    CHECK(FluxAudit{}.emitted == RgbD{0});
}

TEST_CASE("photon: roulette changes no mean, in any channel") {
    Draws numbers{ljus_test::test_seed(3)};
    for (int i = 0; i < 300; ++i) {
        const Rgb flux =
            Rgb{float(numbers.unit()), float(numbers.unit()), float(numbers.unit())} +
            1e-3f;
        Rgb weight{float(numbers.unit()), float(numbers.unit()), float(numbers.unit())};
        if (i % 3 == 0) weight *= 1.5f; // a material may send back more in a direction
        RgbD mean{0};
        constexpr int steps = 4000; // u runs through [0, 1) evenly: no noise
        FluxAudit audit;
        for (int j = 0; j < steps; ++j)
            if (const auto survivor = ljus::play_roulette(
                    flux, weight, (float(j) + 0.5f) / float(steps), audit))
                mean += RgbD(*survivor) / double(steps);
        for (int c = 0; c < 3; ++c) {
            const double exact = double(flux[c]) * double(weight[c]);
            CAPTURE(exact);
            CAPTURE(mean[c]);
            // The survivors are a whole number of steps, each as large as any channel.
            REQUIRE(std::abs(mean[c] - exact) <= 4.0 / steps);
        }
    }
}

TEST_CASE("photon: what survives roulette is never brighter than what came") {
    Draws numbers{ljus_test::test_seed(4)};
    for (int i = 0; i < 10000; ++i) {
        const Rgb flux{float(numbers.unit()), float(numbers.unit()), 1};
        const Rgb weight{float(numbers.unit()), float(numbers.unit()),
                         float(numbers.unit())};
        FluxAudit audit;
        const auto survivor =
            ljus::play_roulette(flux, weight, float(numbers.unit()), audit);
        if (survivor)
            REQUIRE(ljus::max_component(*survivor) <=
                    ljus::max_component(flux) * 1.000001f);
    }
}

TEST_CASE("photon: at each surface absorbed + roulette + survivor is what came") {
    Draws numbers{ljus_test::test_seed(5)};
    for (int i = 0; i < 10000; ++i) {
        const Rgb flux{float(numbers.unit()), float(numbers.unit()),
                       float(numbers.unit())};
        const Rgb weight{float(numbers.between(0, 1.2)), float(numbers.unit()),
                         float(numbers.unit())};
        FluxAudit audit;
        const auto survivor =
            ljus::play_roulette(flux, weight, float(numbers.unit()), audit);
        const RgbD after = survivor ? RgbD(*survivor) : RgbD{0};
        const RgbD sum = audit.absorbed + audit.roulette + after;
        for (int c = 0; c < 3; ++c) REQUIRE(std::abs(sum[c] - double(flux[c])) < 1e-15);
    }
}

TEST_CASE("photon: roulette at its ends") {
    FluxAudit audit;
    const Rgb flux{1, 0.5f, 0.25f};
    // Nothing is absorbed: nothing dies, not even at the largest u below 1.
    CHECK(*ljus::play_roulette(flux, Rgb{1}, 0.99999994f, audit) == flux);
    // All is absorbed: nothing lives, not even at 0.
    CHECK_FALSE(ljus::play_roulette(flux, Rgb{0}, 0.0f, audit));
    CHECK(audit.roulette == RgbD{0});
    CHECK(audit.absorbed == RgbD(flux));
}

TEST_CASE("photon: a pass that cannot be made is refused with a sentence") {
    ljus::Scene<ljus::Shapes<ljus::Sphere>, ljus::Materials<ljus::Lambertian>,
                ljus::Lights<ljus::PointLight>>
        scene;
    const auto trace = [&](const ljus::PhotonPassSettings& pass) {
        const ljus::World world(scene);
        return ljus::trace_photons(world, ljus::MapType::general, pass);
    };
    CHECK_THROWS_WITH(
        (void)trace({}),
        "the number of lights is 0; it must be at least 1, because photons "
        "start at lights.");
    scene.add(ljus::PointLight{});
    CHECK_NOTHROW((void)trace({.photons = 10}));
    CHECK_THROWS_WITH((void)trace({.photons = -1}),
                      "the number of photons is -1; it must be at least 0.");
    CHECK_THROWS_WITH((void)trace({.max_bounces = 0}),
                      "the largest number of bounces is 0; it must be at least 1.");
    CHECK_THROWS_AS((void)trace({.threads = -1}), std::invalid_argument);

    // A photon has 16 bits for the number of its light.
    for (int i = 1; i < 65536; ++i) scene.add(ljus::PointLight{});
    CHECK_NOTHROW((void)trace({.photons = 10}));
    scene.add(ljus::PointLight{});
    CHECK_THROWS_AS((void)trace({.photons = 10}), std::invalid_argument);
}

TEST_CASE("photon: an account is scaled part by part") {
    FluxAudit audit{RgbD{1, 2, 3}, RgbD{4}, RgbD{5}, RgbD{6}, RgbD{-7, 8, 9}};
    audit *= 0.5;
    CHECK(audit.emitted == RgbD{0.5, 1, 1.5});
    CHECK(audit.absorbed == RgbD{2});
    CHECK(audit.escaped == RgbD{2.5});
    CHECK(audit.cut == RgbD{3});
    CHECK(audit.roulette == RgbD{-3.5, 4, 4.5});
}

TEST_CASE("photon: kinds are a bit each, and a side is where it came from") {
    using ljus::PhotonKind, ljus::PhotonKinds;
    const PhotonKind kinds[] = {PhotonKind::direct, PhotonKind::caustic,
                                PhotonKind::indirect, PhotonKind::shadow};
    for (int i = 0; i < 4; ++i) {
        CHECK(ljus::one_kind(kinds[i]).bits == (1 << i));
        CHECK(ljus::all_kinds.has(kinds[i]));
        CHECK(ljus::light_kinds.has(kinds[i]) == (i != 3));
        CHECK_FALSE(PhotonKinds{}.has(kinds[i]));
        for (int k = 0; k < 4; ++k)
            CHECK(ljus::one_kind(kinds[i]).has(kinds[k]) == (i == k));
    }
    const ljus::Vec3 up{0, 1, 0};
    CHECK(ljus::photon_side(ljus::Vec3{1, -1, 0}, up) == 1);
    CHECK(ljus::photon_side(ljus::Vec3{1, 1, 0}, up) == -1);
    CHECK(ljus::photon_side(ljus::Vec3{1, 0, 0}, up) == -1); // along it: from behind
}
