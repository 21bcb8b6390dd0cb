/// \file light_test.cpp
/// \brief What arrives from a sampled light, against closed forms.
///
/// A test of a mean gives a false alarm once in 1.7 million.
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/lights/light.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ljus/geometry/moving.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scene/world.hpp"
#include "support/closed_forms.hpp"
#include "support/numbers.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

/// A light of a user's own that is a point light within a scene: a bulb as a shop
/// describes it.
namespace shop {

template <std::floating_point T>
struct BulbT {
    using Scalar = T;
    ljus::Vec3T<T> position{T(0)};
    T watts = T(40);
};
using Bulb = BulbT<float>;

template <std::floating_point T>
void check(const BulbT<T>& bulb) {
    ljus::require_positive("bulb.watts", bulb.watts);
}

template <std::floating_point T>
[[nodiscard]] ljus::PointLightT<T> in_scene(const BulbT<T>& bulb,
                                            const ljus::SphereT<T>&) {
    const T intensity = bulb.watts / (T(4) * std::numbers::pi_v<T>);
    return {.position = bulb.position, .intensity = ljus::RgbT<T>{intensity}};
}

struct Unchecked : ljus::PointLight {}; // no light: it lacks a check() of its own
void check(const Unchecked&) = delete;

} // namespace shop

using namespace ljus;
using ljus_test::Mean;
using ljus_test::Numbers;

namespace {

constexpr double pi = std::numbers::pi;

/// Irradiance at a point with a normal, by the first light of a world: no shadows.
template <AnyWorld W>
Mean irradiance(const W& world, const Vec3& at, const Vec3& up, int count) {
    Numbers n{ljus_test::test_seed(1)};
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const auto sample = sample_light(world, 0, at, n.square<float>());
        mean.add(sample ? double(std::max(0.0f, glm::dot(sample->wi, up))) *
                              double(sample->weight.x)
                        : 0.0);
    }
    return mean;
}

/// A light of a world, as the type that it is known to be within the scene.
template <typename L, AnyWorld W>
L light_of(const W& world, std::uint32_t number) {
    return world.visit_light(number, []<typename X>(const X& light) {
        if constexpr (std::is_same_v<X, L>)
            return light;
        else
            return L{};
    });
}

/// The spot light within a scene.
template <typename T>
SpotInSceneT<T> in_any_scene(const SpotLightT<T>& spot) {
    return in_scene(spot, SphereT<T>{});
}

} // namespace

TEST_CASE("light: the flux of a diffuse emitter is pi L A") {
    const Quad shape{.edge_u{3, 0, 0}};
    const auto lamp = detail::make_lamp(shape, Rgb{1, 2, 0}, false);
    CHECK(double(power(AreaLightT<Quad>{shape, lamp}).y) == doctest::Approx(6 * pi));
    const World world(make_scene(
        placed(Sphere{.radius = 2}, Lambertian{}, Rgb{1}),
        placed(Quad{.edge_u{2, 0, 0}, .edge_v{0, 3, 0}}, Lambertian{}, Rgb{0, 5, 0}),
        PointLight{.intensity = Rgb{1, 2, 3}}));
    CHECK(double(world.powers()[0].x) == doctest::Approx(16 * pi * pi));
    CHECK(double(world.powers()[1].y) == doctest::Approx(30 * pi));
    CHECK(world.powers()[1].x == 0.0f);
    CHECK(double(world.powers()[2].z) == doctest::Approx(12 * pi));
}

static_assert(LightSource<PointLight> && LightSource<SpotLight> &&
              LightSource<SunLight> && LightSource<PointLightT<double>>);
static_assert(LightSource<shop::Bulb> && LightSource<shop::BulbT<double>>);
static_assert(!LightSource<shop::Unchecked> && !LightSource<Sphere> &&
              !LightSource<Lambertian> && !LightSource<SpotInSceneT<float>>);
static_assert(Light<AreaLightT<Quad>> && Light<AreaLightT<Moving<Sphere>>> &&
              !LightSource<AreaLightT<Quad>>);
static_assert(NearLight<PointLight> && NearLight<SpotInSceneT<float>> &&
              NearLight<AreaLightT<Sphere>> && !NearLight<SunInSceneT<float>>);
static_assert(FarLight<SunInSceneT<float>> && !FarLight<PointLight> &&
              !FarLight<SunLight>);
static_assert(!FillsSky<SunInSceneT<float>> && !FillsSky<PointLight>);
static_assert(std::is_same_v<InSceneT<PointLight>, PointLight> &&
              std::is_same_v<InSceneT<SpotLight>, SpotInSceneT<float>> &&
              std::is_same_v<InSceneT<SunLight>, SunInSceneT<float>> &&
              std::is_same_v<InSceneT<shop::Bulb>, PointLight>);

TEST_CASE("light: what a world has worked out is what the shape says") {
    const Quad quad{.corner{-1, 2, -1}, .edge_u{2, 0, 0}, .edge_v{0, 0, 1}};
    const World world(make_scene(placed(quad, Lambertian{}, Rgb{3})));
    world.visit_light(0, [](const auto& light) {
        CHECK(light.lamp.area == area(light.shape));
        CHECK(light.lamp.normal == normal(light.shape));
        CHECK(light.lamp.radiance == Rgb{3});
    });
    for (const float u : {0.125f, 0.5f, 0.75f}) {
        const auto found = sample_light(world, 0, Vec3{0}, Vec2{u, 0.25f});
        REQUIRE(found);
        const SeenPointT<float> seen = sample_towards(quad, Vec3{0}, Vec2{u, 0.25f});
        CHECK(found->point.position == seen.point.position);
        CHECK(glm::distance(found->wi, glm::normalize(seen.point.position)) < 1e-6f);
        CHECK(double(found->pdf) == doctest::Approx(double(seen.pdf)).epsilon(1e-5));
        CHECK(double(found->weight.x) ==
              doctest::Approx(3 / double(seen.pdf)).epsilon(1e-5));
    }
}

TEST_CASE("light: a light of a user's own may be another within the scene") {
    const Vec3 at{0, 2, 0};
    const World world(make_scene(placed(Sphere{.center{99, 0, 0}}, Lambertian{}),
                                 shop::Bulb{.position = at, .watts = 60}));
    REQUIRE(world.light_count() == 1);
    CHECK(double(world.powers()[0].x) == doctest::Approx(60).epsilon(1e-6));
    const auto sample = sample_light(world, 0, Vec3{0}, Vec2{0.5f});
    REQUIRE(sample);
    CHECK(double(sample->weight.y) == doctest::Approx(60 / (4 * pi) / 4).epsilon(1e-6));

    Scene<Shapes<SphereT<double>>, Materials<LambertianT<double>>,
          Lights<shop::BulbT<double>>>
        in_double;
    in_double.add(shop::BulbT<double>{});
    CHECK(World(in_double).powers()[0].z == doctest::Approx(40));
    CHECK_THROWS_WITH_AS(in_double.add(shop::BulbT<double>{.watts = -1}),
                         doctest::Contains("bulb.watts"), std::invalid_argument);
}

TEST_CASE("light: a point light falls off with the square of the distance") {
    const World scene(
        make_scene(placed(Sphere{.center{99, 0, 0}}, Lambertian{}),
                   PointLight{.position{0, 2, 0}, .intensity = Rgb{4, 8, 0}}));
    for (const float d : {1e-6f, 0.5f, 1.0f, 10.0f, 1e6f}) {
        const auto s = sample_light(scene, 0, Vec3{d, 2, 0}, Vec2{0.5f, 0.5f});
        REQUIRE(s);
        CHECK(s->wi == Vec3{-1, 0, 0});
        CHECK(double(s->weight.x) == doctest::Approx(4 / (double(d) * double(d))));
        CHECK(double(s->weight.y) == doctest::Approx(8 / (double(d) * double(d))));
        CHECK(s->weight.z == 0.0f);
        CHECK(s->pdf == 0.0f);
        CHECK(s->point.position == Vec3{0, 2, 0});
        CHECK(s->point.error == Vec3{0});
    }
    CHECK_FALSE(sample_light(scene, 0, Vec3{0, 2, 0}, Vec2{0}));
}

TEST_CASE("light: a spherical lamp gives pi L (R/d)^2, far and near") {
    for (const float d : {1.001f, 1.5f, 4.0f, 100.0f, 1e4f}) {
        const World scene(make_scene(placed(Sphere{}, Lambertian{}, Rgb{3})));
        const Mean e = irradiance(scene, Vec3{0, -d, 0}, Vec3{0, 1, 0}, 20000);
        CAPTURE(d);
        CHECK(e.agrees_with(3 * pi / (double(d) * double(d)), 1e-4));
    }
}

TEST_CASE("light: a room made of a lamp gives pi L everywhere in it") {
    const World scene(
        make_scene(placed(Sphere{.radius = 5}, Lambertian{}, Rgb{2}, true)));
    for (const Vec3 at : {Vec3{0}, Vec3{1, 2, 3}, Vec3{0, -4.9f, 0}})
        CHECK(irradiance(scene, at, glm::normalize(Vec3{1, 2, 1}), 100000)
                  .agrees_with(2 * pi));
    // From outside it is dark.
    CHECK(irradiance(scene, Vec3{0, -9, 0}, Vec3{0, 1, 0}, 100).mean == 0);
    // And a lamp that is not inside out is dark within.
    const World lamp(make_scene(placed(Sphere{.radius = 5}, Lambertian{}, Rgb{2})));
    CHECK(irradiance(lamp, Vec3{0, 1, 0}, Vec3{0, 1, 0}, 100).mean == 0);
}

TEST_CASE("light: a square lamp above, by the form factor to a small element") {
    for (const float height : {0.1f, 1.0f, 10.0f}) {
        const World scene(make_scene(placed(
            Quad{{-1, height, -1}, {2, 0, 0}, {0, 0, 2}}, Lambertian{}, Rgb{1})));
        CAPTURE(height);
        REQUIRE(normal(std::get<0>(scene.shapes())[0]) == Vec3{0, -1, 0});
        CHECK(irradiance(scene, Vec3{0}, Vec3{0, 1, 0}, 200000)
                  .agrees_with(4 * pi *
                               ljus_test::form_factor_of_corner(1, 1, double(height))));
        // Its back is dark.
        CHECK(irradiance(scene, Vec3{0, height + 1, 0}, Vec3{0, -1, 0}, 100).mean == 0);
    }
}

TEST_CASE("light: two triangles shine as their quad does") {
    const Vec3 a{-1, 2, -1}, b{1, 2, -1}, c{1, 2, 1}, d{-1, 2, 1};
    const World low(make_scene(placed(Triangle{a, b, c}, Lambertian{}, Rgb{1})));
    const World high(make_scene(placed(Triangle{a, c, d}, Lambertian{}, Rgb{1})));
    const World quad(make_scene(placed(Quad{a, b - a, d - a}, Lambertian{}, Rgb{1})));
    const Vec3 at{0.3f, 0, -0.2f}, up{0, 1, 0};
    const Mean e1 = irradiance(low, at, up, 100000),
               e2 = irradiance(high, at, up, 100000);
    const Mean e = irradiance(quad, at, up, 100000);
    CHECK(std::abs(e1.mean + e2.mean - e.mean) <
          5 * (e1.error() + e2.error() + e.error()));
}

TEST_CASE("light: an observer on the lamp or beside it gets no light, no NaN") {
    const World scene(make_scene(
        placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, Lambertian{}, Rgb{1})));
    for (const Vec3 at : {Vec3{0}, Vec3{0.5f, 0, 0.5f}, Vec3{4, 0, 0}})
        for (const Vec2 u : {Vec2{0.5f, 0.5f}, Vec2{0.75f, 0.75f}, Vec2{0, 0}}) {
            const auto sample = sample_light(scene, 0, at, u);
            CHECK_FALSE(sample);
        }
}

TEST_CASE("light: a spot light is a point light within its cone, fades and ends") {
    const World scene(make_scene(placed(Sphere{.center{99, 0, 0}}, Lambertian{}),
                                 SpotLight{.position{0, 2, 0},
                                           .direction{0, -7, 0},
                                           .intensity = Rgb{4},
                                           .inner_degrees = 30,
                                           .outer_degrees = 60}));
    const double inner = std::cos(pi / 6), outer = 0.5;
    for (const double angle : {0.0, 10.0, 29.9, 35.0, 45.0, 59.0, 61.0, 120.0, 180.0}) {
        const double a = angle * pi / 180;
        const Vec3 at{float(3 * std::sin(a)), float(2 - 3 * std::cos(a)), 0};
        const auto s = sample_light(scene, 0, at, Vec2{0.5f});
        const double share =
            std::cos(a) >= inner ? 1 : (std::cos(a) - outer) / (inner - outer);
        CAPTURE(angle);
        CHECK(s.has_value() == (share > 0));
        if (s)
            CHECK(double(s->weight.x) == doctest::Approx(share * 4 / 9).epsilon(1e-5));
        if (s) CHECK(s->pdf == 0.0f);
    }
}

TEST_CASE("light: a spot or a sun that makes no sense is refused in a sentence") {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<SpotLight, SunLight>> scene;
    const float nan = std::nanf("");
    CHECK_THROWS_WITH_AS(scene.add(SpotLight{.direction{0, 0, 0}}),
                         doctest::Contains("spot light.direction"),
                         std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SpotLight{.direction{0, nan, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SpotLight{.position{nan, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SpotLight{.intensity = Rgb{-1}}), std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SpotLight{.intensity = Rgb{nan}}), std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SunLight{.direction = Vec3{0}}), std::invalid_argument);
    CHECK_THROWS_AS(scene.add(SunLight{.irradiance = Rgb{-1}}), std::invalid_argument);
    scene.add(SunLight{.irradiance = Rgb{0}}); // dark: no light
    scene.add(SpotLight{.intensity = Rgb{0}});
    CHECK(scene.light_count() == 0);
    // A direction of any length.
    scene.add(SpotLight{.direction{0, 1e-30f, 0}});
    CHECK(light_of<SpotInSceneT<float>>(World(scene), 0).direction == Vec3{0, 1, 0});
}

TEST_CASE("light: a spot's flux is the integral of what it sends, at any angle") {
    // By the midpoint rule over 1 - cos, from what sample_light() says at distance 1.
    using Room = Scene<Shapes<SphereT<double>>, Materials<LambertianT<double>>,
                       Lights<SpotLightT<double>>>;
    for (const double inner : {0.0, 10.0, 40.0, 90.0, 180.0})
        for (const double outer : {40.0, 120.0, 180.0}) {
            if (inner > outer) continue;
            Room room;
            // 3 -4 0 is 5 long, and a direction of any length will do.
            room.add(SpotLightT<double>{.position{1, 2, 3},
                                        .direction{30, -40, 0},
                                        .intensity{2, 3, 4},
                                        .inner_degrees = inner,
                                        .outer_degrees = outer});
            const World world(std::move(room));
            const Vec3T<double> axis{0.6, -0.8, 0}, across{0.8, 0.6, 0};
            double integral = 0;
            const int n = 20000;
            for (int i = 0; i < n; ++i) {
                const double z = 1 - 2 * (i + 0.5) / n;
                const Vec3T<double> way = z * axis + std::sqrt(1 - z * z) * across;
                const auto seen = sample_light(world, 0, Vec3T<double>{1, 2, 3} + way,
                                               Vec2T<double>{0.5, 0.5});
                if (seen) integral += 2 * std::numbers::pi * seen->weight.y * 2 / n;
            }
            CAPTURE(inner);
            CAPTURE(outer);
            for (int c = 0; c < 3; ++c)
                CHECK(world.powers()[0][c] ==
                      doctest::Approx(integral * (2 + c) / 3).epsilon(1e-3));
            CHECK(glm::distance(light_of<SpotInSceneT<double>>(world, 0).direction,
                                axis) < 1e-12);
        }
}

TEST_CASE("light: a sun has the flux of a disc as wide as the scene, from anywhere") {
    // A box from (-1, 2, 3) to (3, 8, 15), by balls in its corners: half of its
    // diagonal is sqrt(4 + 9 + 36) = 7, and a thousandth for rounding.
    using Room = Scene<Shapes<SphereT<double>>, Materials<LambertianT<double>>,
                       Lights<SunLightT<double>>>;
    const Vec3T<double> low{-1, 2, 3}, high{3, 8, 15}, middle{1, 5, 9};
    const auto check_sun = [&](const World<Room>& room, const Vec3T<double>& way) {
        const auto sun = light_of<SunInSceneT<double>>(room, 0);
        CHECK(glm::distance(sun.around.center, middle) < 1e-9);
        CHECK(sun.around.radius == doctest::Approx(7.007));
        for (int c = 0; c < 3; ++c)
            CHECK(room.powers()[0][c] ==
                  doctest::Approx(std::numbers::pi * 7.007 * 7.007 * (c + 1)));
        CHECK(glm::distance(sun.direction, way) < 1e-12);
        // A shadow ray ends on a plane beside the scene, its way along the sun's.
        for (const Vec3T<double>& from : {low, high, middle, Vec3T<double>{3, 2, 15}}) {
            const auto seen = sample_light(room, 0, from, Vec2T<double>{0.25, 0.75});
            REQUIRE(seen);
            CHECK(glm::distance(seen->wi, -way) < 1e-12);
            CHECK(seen->weight == Vec3T<double>{1, 2, 3});
            CHECK(seen->pdf == 0);
            CHECK(glm::dot(seen->point.position - middle, way) ==
                  doctest::Approx(-7.007));
            CHECK(glm::length(glm::cross(seen->point.position - from, way)) < 1e-9);
        }
        // From beyond that plane it ends where it begins, not behind.
        const Vec3T<double> outside = middle - 20.0 * way;
        CHECK(glm::distance(
                  sample_light(room, 0, outside, Vec2T<double>{0, 0})->point.position,
                  outside) < 1e-9);
    };
    for (const Vec3T<double>& way :
         {Vec3T<double>{0.6, -0.8, 0}, Vec3T<double>{0, 0, 1},
          Vec3T<double>{0, 0.8, -0.6}})
        for (const bool sun_first : {true, false}) {
            Room room;
            const auto grey = room.add(LambertianT<double>{});
            const SunLightT<double> sun{.direction = 1e-30 * way, .irradiance{1, 2, 3}};
            if (sun_first) room.add(sun);
            room.add(SphereT<double>{low + 0.5, 0.5}, grey);
            room.add(SphereT<double>{high - 0.25, 0.25}, grey);
            room.add(SphereT<double>{middle, 1}, grey);
            if (!sun_first) room.add(sun);
            check_sun(World(room), way);
        }
}

TEST_CASE("light: the ends of what a spot may be, and a direction along each axis") {
    const auto spot = [](float inner, float outer) {
        check(SpotLight{
            .intensity = Rgb{1}, .inner_degrees = inner, .outer_degrees = outer});
    };
    // The flux of a cone of 1e-30 degrees is 0 in float, and its density infinite.
    const float nan = std::nanf("");
    for (const auto& [inner, outer] :
         {std::pair{0.0f, 180.0f}, {180, 180}, {20, 20}, {0.001f, 0.001f}})
        CHECK_NOTHROW(spot(inner, outer));
    for (const Vec2& ends : {Vec2{0, 180.1f}, Vec2{20.1f, 20}, Vec2{-0.1f, 20},
                             Vec2{nan, 20}, Vec2{0, 0}, Vec2{0, 1e-30f}, Vec2{0, -1},
                             Vec2{0, nan}}) {
        CAPTURE(ends.x);
        CAPTURE(ends.y);
        CHECK_THROWS_AS(spot(ends.x, ends.y), std::invalid_argument);
    }
    CHECK(ljus_test::refusal([&] { spot(40, 30); }) ==
          "spot light.inner_degrees is 40; it must be within [0, outer_degrees], and "
          "outer_degrees is 30.");
    for (int axis = 0; axis < 3; ++axis)
        for (const float length : {1e-30f, -1.0f, 3e38f}) {
            Vec3 way{0}, unit{0};
            way[axis] = length;
            unit[axis] = length > 0 ? 1.0f : -1.0f;
            CHECK(detail::unit_along(way) == unit);
            CHECK_NOTHROW(check(SpotLight{.direction = way, .intensity = Rgb{1}}));
        }
}

TEST_CASE("light: a spot's photons go where its intensity is, angle by angle") {
    // With w = 1 - cos the share of the flux below w is the area below the curve: w up
    // to the inner cone, and w - (w - i)^2 / (2 (o - i)) in the part that fades.
    for (const double inner : {0.0, 0.1, 0.6})
        for (const double outer : {0.6, 1.0, 2.0}) {
            const SpotInSceneT<double> spot{.inner = inner, .outer = outer};
            double last = 0;
            for (int k = 0; k < 200; ++k) {
                const double u = k / 200.0, w = detail::sample_spot(spot, u);
                REQUIRE(w >= last);
                REQUIRE(w <= outer);
                const double fades =
                    w > inner ? (w - inner) * (w - inner) / (2 * (outer - inner)) : 0;
                REQUIRE((w - fades) / ((inner + outer) / 2) ==
                        doctest::Approx(u).epsilon(1e-9));
                last = w;
            }
        }
}

TEST_CASE("light: what no picture can be made with is refused, and a sample faces it") {
    using Room = Scene<Shapes<Sphere>, Materials<Lambertian>,
                       Lights<PointLight, SpotLight, SunLight>>;
    const float nan = std::nanf(""), huge = 3e38f;
    Room room;
    room.add(Sphere{.radius = 1e10f}, room.add(Lambertian{}));
    CHECK_THROWS_AS(room.add(PointLight{.position{0, nan, 0}, .intensity = Rgb{1}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(room.add(PointLight{.intensity{1, -1, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(room.add(PointLight{.intensity{1, nan, 1}}), std::invalid_argument);
    // Each part is finite, the flux is not.
    CHECK_THROWS_WITH_AS(room.add(PointLight{.intensity = Rgb{huge}}),
                         doctest::Contains("the flux of a light"),
                         std::invalid_argument);
    // A sun's flux is that of the scene, which is complete when it is closed.
    Room bright = room;
    bright.add(SunLight{.irradiance = Rgb{1e30f}});
    CHECK_THROWS_WITH_AS((void)World(bright), doctest::Contains("the flux of a light"),
                         std::invalid_argument);
    CHECK_THROWS_AS(room.add(SunLight{.direction{0, nan, 0}, .irradiance = Rgb{1}}),
                    std::invalid_argument);
    CHECK_NOTHROW(room.add(
        SpotLight{.intensity = Rgb{1}, .inner_degrees = 0, .outer_degrees = 0.5f}));
    room.add(PointLight{.position{0, 3, 4}, .intensity = Rgb{1}});
    const auto seen = sample_light(World(room), 1, Vec3{0}, Vec2{0.5f, 0.5f});
    REQUIRE(seen);
    CHECK(glm::distance(seen->point.normal, Vec3{0, -0.6f, -0.8f}) < 1e-6f);
    // At the border of a cone that does not fade it is not dark.
    CHECK(detail::fall_off(
              SpotInSceneT<float>{.direction{0, -1, 0}, .inner = 1, .outer = 1},
              Vec3{1, 0, 0}) == 1);
    room.add(SunLight{.direction{0, -0.6f, -0.8f}});
    const auto sun = sample_light(World(room), 2, Vec3{0}, Vec2{0.5f, 0.5f});
    REQUIRE(sun);
    CHECK(glm::distance(sun->point.normal, Vec3{0, -0.6f, -0.8f}) < 1e-6f);
    // So small and far that its density is beyond all numbers: no light, and no 0 / 0.
    using Lamps = Scene<Shapes<Quad>, Materials<Lambertian>>;
    Lamps far;
    far.add(Quad{.edge_u{1e-15f, 0, 0}, .edge_v{0, 1e-15f, 0}}, far.add(Lambertian{}),
            Rgb{1e12f});
    const World tiny(far);
    CHECK_FALSE(sample_light(tiny, 0, Vec3{0, 0, 1e6f}, Vec2{0.5f, 0.5f}));
    CHECK(sample_light(tiny, 0, Vec3{0, 0, 1}, Vec2{0.5f, 0.5f}));
}

TEST_CASE("light: a lamp that moves is where it is at the time of the ray") {
    Scene<Shapes<Moving<Sphere>>, Materials<Lambertian>> scene;
    scene.add(Moving<Sphere>{Sphere{.radius = 0.5f}, {8, 0, 0}},
              scene.add(Lambertian{}), Rgb{2});
    const World world(std::move(scene));
    Numbers n{31};
    for (const float time : {0.0f, 0.25f, 1.0f})
        for (int i = 0; i < 50; ++i) {
            const auto sample =
                sample_light(world, 0, Vec3{0, 9, 0}, n.square<float>(), time);
            REQUIRE(sample);
            CHECK(glm::distance(sample->point.position, Vec3{8 * time, 0, 0}) ==
                  doctest::Approx(0.5).epsilon(1e-5));
        }
}

TEST_CASE("light: a sample says its density, and 0 where there is none") {
    // Seen at right angles, a small square at distance d has the solid angle A / d^2.
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian>, Lights<PointLight, SunLight>>
        scene;
    const MaterialId matt = scene.add(Lambertian{});
    scene.add(
        Quad{.corner{-0.005f, -0.005f, 0}, .edge_u{0.01f, 0, 0}, .edge_v{0, 0.01f, 0}},
        matt, Rgb{3});
    scene.add(Sphere{.center{0, 0, 0}, .radius = 0.6f}, matt, Rgb{5});
    scene.add(PointLight{.position{0, 0, 1}});
    scene.add(SunLight{});
    const World world(std::move(scene));
    const auto sample = [&](std::uint32_t light) {
        return sample_light(world, light, Vec3{0, 0, 1}, Vec2{0.3f, 0.7f});
    };
    REQUIRE(sample(0));
    CHECK(sample(0)->pdf == doctest::Approx(1e4).epsilon(1e-4));
    CHECK(sample(0)->weight.x * sample(0)->pdf == doctest::Approx(3));
    // A ball's cone: sin = 0.6, and 2 pi (1 - cos) of it.
    REQUIRE(sample(1));
    CHECK(sample(1)->pdf == doctest::Approx(1 / (2 * pi * 0.2)));
    CHECK(sample(1)->weight.x * sample(1)->pdf == doctest::Approx(5));
    CHECK_FALSE(sample(2)); // it is on the light itself
    REQUIRE(sample(3));
    CHECK(sample(3)->pdf == 0);
}

TEST_CASE("light: without more said, each of the three") {
    CHECK(PointLight{}.position == Vec3{0});
    CHECK(PointLight{}.intensity == Rgb{1});
    CHECK(SpotLight{}.position == Vec3{0});
    CHECK(SpotLight{}.direction == Vec3{0, -1, 0});
    CHECK(SpotLight{}.intensity == Rgb{1});
    CHECK(SpotLight{}.inner_degrees == 20);
    CHECK(SpotLight{}.outer_degrees == 30);
    CHECK(SunLight{}.direction == Vec3{0, -1, 0});
    CHECK(SunLight{}.irradiance == Rgb{1});
    const SpotInSceneT<float> spot;
    CHECK((spot.inner == 0 && spot.outer == 0 && is_black(spot.intensity)));
    const SunInSceneT<float> sun;
    CHECK((is_black(sun.irradiance) && sun.direction == Vec3{0}));
    const LampT<float> lamp;
    CHECK((lamp.area == 0 && is_black(lamp.radiance) && !lamp.inside_out));
    const LightSampleT<float> nothing;
    CHECK((nothing.pdf == 0 && is_black(nothing.weight)));
    // A sun has no flux until there is something that it shines on.
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<SunLight>> empty;
    empty.add(SunLight{.irradiance{1, 2, 3}});
    CHECK(is_black(World(empty).powers()[0]));
    CHECK(light_of<SunInSceneT<float>>(World(empty), 0).irradiance == Rgb{1, 2, 3});
}

TEST_CASE("light: a spot of a hundredth of a degree keeps its digits in float") {
    // 1 - cos is 1.5e-8 there, which a cosine in float cannot represent.
    const double angle = 0.01 * pi / 180, w = 2 * std::pow(std::sin(angle / 2), 2);
    const SpotLight spot{
        .intensity = Rgb{1}, .inner_degrees = 0, .outer_degrees = 0.01f};
    const SpotInSceneT<float> made = in_any_scene(spot);
    CHECK(double(made.outer) / w == doctest::Approx(1).epsilon(1e-5));
    CHECK(double(power(made).x) / (pi * w) == doctest::Approx(1).epsilon(1e-5));
    for (const double part : {0.0, 0.25, 0.5, 0.75, 1.5}) {
        const Vec3 way{float(std::sin(part * angle)), -float(std::cos(part * angle)),
                       0};
        const double share = part < 1 ? 1 - part * part : 0;
        CHECK(std::abs(double(detail::fall_off(made, way)) - share) < 1e-3);
    }
}
