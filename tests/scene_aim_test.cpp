/// \file scene_aim_test.cpp
/// \brief Photons of far lamps, aimed at the scene, against closed forms.
///
/// Means are held within 5 standard errors, a false alarm once in 1.7 million; counts
/// within 5 standard deviations. Run with 20 further seeds: none failed.

#include "ljus/photons/scene_aim.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scene/world.hpp"
#include "own_light.hpp"
#include "support/closed_forms.hpp"
#include "support/integrate.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::integrate;
using ljus_test::Mean;
using reader::StageLamp;
using D3 = glm::dvec3; ///< What the closed forms are computed with.

namespace {

constexpr double pi = std::numbers::pi;
using TestScene = Scene<Shapes<Quad, Sphere>, Materials<Lambertian>,
                        Lights<PointLight, SpotLight, SunLight, StageLamp>>;

/// A black floor [-1, 1]^2 at z = 0, to which lights are added.
struct Stage {
    TestScene scene;
    MaterialId black = scene.add(Lambertian{.albedo = Rgb{0}});
    Stage() { scene.add(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, black); }
};

/// Flux and number of the photons of one pass.
struct Landed {
    double flux = 0;     ///< On the whole floor.
    double quarter = 0;  ///< Where x and y are above 0.
    double high = 0;     ///< On whatever lies above z = 1.
    long long kept = 0;  ///< Photons on the floor.
    double heaviest = 0; ///< Of these, over the lightest.
};

/// Traces direct photons of one light.
template <AnyWorld W>
Landed land(const W& world, long long photons, std::uint64_t seed,
            std::uint16_t light = 0) {
    const auto traced = trace_photons(world, MapType::general,
                                      {.photons = photons,
                                       .seed = ljus_test::test_seed(seed),
                                       .max_bounces = 1,
                                       .shadow_photons = false,
                                       .threads = 1});
    Landed landed;
    double least = 1e300, most = 0;
    for (const Photon& photon : traced.photons) {
        if (photon.light != light) continue;
        const double flux = double(photon.flux.x);
        if (photon.position.z > 1) {
            landed.high += flux;
            continue;
        }
        landed.flux += flux;
        if (photon.position.x > 0 && photon.position.y > 0) landed.quarter += flux;
        ++landed.kept;
        least = std::min(least, flux);
        most = std::max(most, flux);
    }
    landed.heaviest = most / least;
    return landed;
}

/// The means of several passes.
struct Means {
    Mean flux{}, quarter{}, high{}, kept{};
    double heaviest = 0;
};
template <AnyWorld W>
Means land_often(const W& world, long long photons = 2000, std::uint16_t light = 0) {
    Means means;
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
        const Landed landed = land(world, photons, seed, light);
        means.flux.add(landed.flux);
        means.quarter.add(landed.quarter);
        means.high.add(landed.high);
        means.kept.add(double(landed.kept) / double(photons));
        means.heaviest = std::max(means.heaviest, landed.heaviest);
    }
    return means;
}

/// The flux of a light without a size through a rectangle of the plane z = 0, by
/// quadrature.
/// \param intensity  Called with the unit direction away from the light.
template <typename Intensity>
double flux_through(D3 from, double low, double high, Intensity intensity) {
    return integrate(low, high, 16, [&](double x) {
        return integrate(low, high, 16, [&](double y) {
            const D3 way = D3{x, y, 0} - from;
            const double d = glm::length(way);
            return intensity(way / d) * -way.z / (d * d * d);
        });
    });
}

bool aims(const AnyWorld auto& world) {
    return !aim_at_scene(world, world.light_choice()).is_aimed.empty();
}

} // namespace

TEST_CASE("scene aim: the sphere holds what is no lamp, and the lamps that touch it") {
    Stage stage;
    const auto sphere = [&] { return *lit_sphere(World(stage.scene)); };
    CHECK(glm::length(sphere().center) < 1e-6f);
    CHECK(sphere().radius == doctest::Approx(1.001 * std::sqrt(2.0)));
    stage.scene.add(Sphere{{0, 0, 500}, 1}, stage.black, Rgb{1});
    CHECK(sphere().radius == doctest::Approx(1.001 * std::sqrt(2.0)));
    stage.scene.add(Sphere{{0, 0, 2}, 1}, stage.black, Rgb{1});
    CHECK(sphere().radius > 2.1f);
    CHECK(glm::distance(sphere().center, Vec3{0, 0, 2}) + 1 <= sphere().radius);
    CHECK(glm::distance(sphere().center, Vec3{1, 1, 0}) <= sphere().radius);

    TestScene lamps;
    lamps.add(Sphere{}, lamps.add(Lambertian{}), Rgb{1});
    CHECK_FALSE(lit_sphere(World(lamps)));
    CHECK_FALSE(aims(World(lamps)));

    TestScene ball; // the corners of its box lie outside its sphere
    ball.add(Sphere{{1, 2, 3}, 4}, ball.add(Lambertian{}));
    CHECK(lit_sphere(World(ball))->radius == doctest::Approx(1.001 * 4));
}

TEST_CASE(
    "scene aim: lights within the scene and suns send the photons that they sent") {
    Stage stage;
    stage.scene.add(PointLight{.position{0.3f, 0.2f, 1}, .intensity = Rgb{5}});
    stage.scene.add(SunLight{});
    stage.scene.add(Quad{{-0.2f, -0.2f, 1}, {0, 0.4f, 0}, {0.4f, 0, 0}}, stage.black,
                    Rgb{9});
    const World world(stage.scene);
    CHECK_FALSE(aims(world));
    CHECK(aim_at_scene(world, world.light_choice()).choice.cumulative ==
          world.light_choice().cumulative);
    const auto traced =
        trace_photons(world, MapType::general, {.photons = 3000, .max_bounces = 1});
    std::size_t next = 0;
    for (std::uint64_t i = 0; i < 3000; ++i) {
        auto stream = random_stream(1, Pass::general_photons, 0, i);
        const auto sent = emit(world, world.light_choice(), stream);
        if (next == traced.photons.size()) break;
        const Photon& photon = traced.photons[next];
        if (photon.direction != sent.ray.direction) continue;
        CHECK(photon.flux == sent.flux / 3000.0f);
        do // with its shadow photons
            ++next;
        while (next < traced.photons.size() &&
               traced.photons[next].direction == sent.ray.direction);
    }
    CHECK(next == traced.photons.size());
    CHECK(next > 100);
}

TEST_CASE("scene aim: a far point light brings a floor the flux of its solid angle") {
    Stage stage;
    stage.scene.add(PointLight{.position{0, 0, 100}, .intensity = Rgb{3}});
    const World world(stage.scene);
    const Means found = land_often(world);
    // A rectangle above whose centre one is: 4 asin(a b / ...), with a = b = 1.
    const double solid = 4 * std::asin(1 / (1 + 100.0 * 100));
    CHECK(found.flux.agrees_with(3 * solid));
    CHECK(found.quarter.agrees_with(3 * solid / 4));
    CHECK(found.flux.error() < 0.01 * found.flux.mean);
    // 7/8 go into the cone, of whose disc the floor fills 2/pi; of those that leave
    // anywhere 1 in 125 000 lands.
    CHECK(found.kept.agrees_with(7.0 / 8 * 2 / pi / (1.001 * 1.001), 1e-4));
    CHECK(found.heaviest < 1.0001); // they share the flux equally
}

TEST_CASE("scene aim: far lamps bring a floor the flux of their form factor") {
    Stage stage;
    stage.scene.add(Quad{{-1, -1, 12}, {0, 2, 0}, {2, 0, 0}}, stage.black, Rgb{2});
    const World quad(stage.scene);
    const Means found = land_often(quad);
    const double factor = ljus_test::form_factor_facing(2, 2, 12);
    CHECK(found.flux.agrees_with(2 * pi * 4 * factor));
    CHECK(found.quarter.agrees_with(2 * pi * factor));
    CHECK(found.kept.mean > 0.5);

    Stage ball; // E = pi L (R / d)^2 cos
    const D3 at{3, -2, 25};
    ball.scene.add(Sphere{Vec3(at), 2}, ball.black, Rgb{2});
    const Means lit = land_often(World(ball.scene));
    const double intensity = pi * 2 * 2 * 2;
    const auto same = [&](const D3&) { return intensity; };
    CHECK(lit.flux.agrees_with(flux_through(at, -1, 1, same)));
    CHECK(lit.quarter.agrees_with(flux_through(at, 0, 1, same)));
    CHECK(lit.kept.mean > 0.2); // half of the points are on its other side
}

TEST_CASE("scene aim: spots and lights of one's own by their density of emission") {
    const D3 at{0, 0, 40};
    Stage stage; // the edge of the inner cone crosses the floor
    stage.scene.add(SpotLight{.position = Vec3(at),
                              .direction{0.03f, 0, -1},
                              .intensity = Rgb{2},
                              .inner_degrees = 2,
                              .outer_degrees = 20});
    const World spot(stage.scene);
    CHECK(aims(spot));
    const D3 axis = glm::normalize(D3{double(0.03f), 0, -1});
    const auto w = [](double degrees) { return 1 - std::cos(degrees * pi / 180); };
    const auto fall = [&](const D3& d) {
        const double out = 1 - glm::dot(d, axis);
        return 2 * std::min(1.0, (w(20) - out) / (w(20) - w(2)));
    };
    const Means found = land_often(spot);
    CHECK(found.flux.agrees_with(flux_through(at, -1, 1, fall), 1e-4));
    CHECK(found.quarter.agrees_with(flux_through(at, 0, 1, fall), 1e-4));
    CHECK(found.kept.mean > 0.5);

    Stage narrow; // shines at a part of the floor: its own directions are better
    narrow.scene.add(SpotLight{.position = Vec3(at),
                               .direction{0, 0, -1},
                               .inner_degrees = 0.1f,
                               .outer_degrees = 0.2f});
    CHECK_FALSE(aims(World(narrow.scene)));

    Stage own;
    own.scene.add(StageLamp{.position = Vec3(at),
                            .axis{0, 0.6f, -0.8f},
                            .intensity = Rgb{2},
                            .exponent = 6});
    const World theirs(own.scene);
    CHECK(aims(theirs));
    const auto power_of_cos = [](const D3& d) {
        return 2 * std::pow(glm::dot(d, D3{0, double(0.6f), -double(0.8f)}), 6);
    };
    const Means stage_lamp = land_often(theirs);
    CHECK(stage_lamp.flux.agrees_with(flux_through(at, -1, 1, power_of_cos), 1e-4));
    CHECK(stage_lamp.quarter.agrees_with(flux_through(at, 0, 1, power_of_cos), 1e-4));
    CHECK(stage_lamp.kept.mean > 0.5);
}

TEST_CASE("scene aim: what lies outside the cone gets its light as well") {
    Stage stage; // a lamp beside a far lamp, and far from the floor
    stage.scene.add(PointLight{.position{0, 0, 100}, .intensity = Rgb{3}});
    stage.scene.add(Sphere{{0, 8, 100}, 4}, stage.black, Rgb{0.01f});
    const World world(stage.scene);
    REQUIRE(lit_sphere(world)->radius < 2);
    const Means found = land_often(world, 4000);
    const double cosine = std::sqrt(1 - 0.5 * 0.5);
    CHECK(found.high.agrees_with(3 * 2 * pi * (1 - cosine)));
    CHECK(found.high.error() < 0.05 * found.high.mean);
    CHECK(found.flux.agrees_with(3 * 4 * std::asin(1 / (1 + 100.0 * 100))));
}

TEST_CASE("scene aim: lights are chosen by the flux that goes to the scene") {
    Stage stage; // a far lamp is 10 000 times as strong, and brings the floor a third
    const D3 far{0, 0, 200}, near{0, 0, 1};
    stage.scene.add(PointLight{.position = Vec3(far), .intensity = Rgb{20000}});
    const PointLight light{.position = Vec3(near), .intensity = Rgb{2}};
    stage.scene.add(light);
    const World world(stage.scene);
    const auto aim = aim_at_scene(world, world.light_choice());
    for (const float u : {0.1f, 0.5f, 0.9f}) // the near one is not aimed
        CHECK(aim(1, light, Vec2{u}, Vec2{u}, 0.0f).ray.direction ==
              emit_photon(light, Vec2{u}, Vec2{u}, 0.0f).ray.direction);
    const auto one = [](const D3&) { return 1.0; };
    const double solid = flux_through(far, -1, 1, one);
    const Means from_far = land_often(world, 2000, 0);
    CHECK(from_far.flux.agrees_with(20000 * solid, 1e-4));
    const Means from_near = land_often(world, 2000, 1);
    CHECK(from_near.flux.agrees_with(2 * flux_through(near, -1, 1, one), 1e-4));
    CHECK(from_near.kept.mean > 0.1); // by power it would be 1 in 30 000
    // Into the cone of the sphere goes pi/2 times what goes to the floor.
    const double share = 20000 * solid * pi / 2 / (20000 * solid * pi / 2 + 8 * pi);
    CHECK(from_far.kept.agrees_with(share * 7 / 8 * 2 / pi, 0.01));

    // Shares that are given stay as they are.
    const auto traced = [&](PhotonPassSettings pass) {
        pass.photons = 20000;
        pass.seed = ljus_test::test_seed(9);
        pass.max_bounces = 1;
        pass.shadow_photons = false;
        double flux[2] = {};
        long long count[2] = {};
        for (const Photon& photon :
             trace_photons(world, MapType::general, pass).photons) {
            flux[photon.light] += double(photon.flux.x);
            ++count[photon.light];
        }
        CHECK(flux[0] == doctest::Approx(20000 * solid).epsilon(0.1));
        return double(count[0]);
    };
    CHECK(traced({.equal_lights = true}) ==
          doctest::Approx(20000 * 0.5 * 7 / 8 * 2 / pi).epsilon(0.1));
    CHECK(traced({.light_shares = {0.9, 0.1}}) ==
          doctest::Approx(20000 * 0.9 * 7 / 8 * 2 / pi).epsilon(0.1));
}

TEST_CASE("scene aim: no photon leaves where its light does not shine") {
    Stage stage; // a ball, from half of whose surface the floor is not seen
    stage.scene.add(Sphere{{0, 0, 30}, 1}, stage.black, Rgb{2});
    stage.scene.add(Sphere{{0, 0, 0.5f}, 0.4f}, stage.black);
    const World world(stage.scene);
    const auto traced =
        trace_photons(world, MapType::general, {.photons = 4000, .max_bounces = 1});
    long long shadow = 0;
    for (const Photon& photon : traced.photons) {
        CHECK(photon.flux.x > 0);
        shadow += photon.kind == PhotonKind::shadow;
    }
    CHECK(shadow > 0);
}
