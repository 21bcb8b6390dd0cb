/// \file make_scene_test.cpp
/// \brief A scene in one expression.

#include "ljus/scene/make_scene.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <type_traits>

#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/scene/world.hpp"

using namespace ljus;

TEST_CASE("make_scene: lists each type once, in order of first appearance") {
    const auto scene = make_scene(
        placed(Sphere{.center{0, 1, 0}}, Glass{}), PointLight{.position{0, 3, 3}},
        placed(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}}, Lambertian{}),
        placed(Sphere{.center{3, 1, 0}}, Mirror{}),
        placed(Quad{{-1, 4, -1}, {2, 0, 0}, {0, 0, 2}}, Lambertian{}, Rgb{10}));
    static_assert(
        std::is_same_v<std::remove_const_t<decltype(scene)>,
                       Scene<Shapes<Sphere, Quad>, Materials<Glass, Lambertian, Mirror>,
                             Lights<PointLight>>>);
    CHECK(scene.size() == 4);
    CHECK(std::get<0>(scene.shapes).size() == 2);
    CHECK(std::get<1>(scene.shapes).size() == 2);
    CHECK(std::get<1>(scene.materials).size() == 2);
    // Lights keep their order: the point light came first.
    const World world(scene);
    REQUIRE(world.light_count() == 2);
    CHECK_FALSE(world.can_be_met(0));
    CHECK(world.can_be_met(1));
    CHECK(world.object({1, 1}).light == 1);
    CHECK(world.object({1, 1}).emission == Rgb{10});
}

TEST_CASE("make_scene: is what add() makes") {
    const Quad floor{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}};
    const World made(
        make_scene(placed(floor, Lambertian{.albedo = Rgb{0.3f}}),
                   placed(Sphere{.radius = 9}, Mirror{}, Rgb{1, 2, 3}, true)));
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror>> scene;
    scene.add(floor, scene.add(Lambertian{.albedo = Rgb{0.3f}}));
    scene.add(Sphere{.radius = 9}, scene.add(Mirror{}), Rgb{1, 2, 3}, true);
    const World by_hand(scene);
    static_assert(std::is_same_v<decltype(by_hand), decltype(made)>);
    for (std::uint32_t type = 0; type < 2; ++type) {
        const auto &a = made.object({type, 0}), &b = by_hand.object({type, 0});
        CHECK(a.material == b.material);
        CHECK(a.emission == b.emission);
        CHECK(a.inside_out == b.inside_out);
    }
    CHECK(std::get<0>(made.materials())[0].albedo == Rgb{0.3f});
    CHECK(made.powers() == by_hand.powers());
    const auto hit = closest_hit(made, Ray{.origin{0, 1, 0}, .direction{0, -1, 0}});
    REQUIRE(hit);
    CHECK(hit->object == ObjectId{0, 0});
}

TEST_CASE("make_scene: in double all is double") {
    const auto scene =
        make_scene(placed(SphereT<double>{}, LambertianT<double>{}, RgbT<double>{2}),
                   PointLightT<double>{});
    static_assert(std::is_same_v<decltype(scene)::Scalar, double>);
    CHECK(scene.light_count() == 2);
    CHECK(World(scene).light_count() == 2);
}

TEST_CASE("make_scene: one part is enough") {
    CHECK(make_scene(placed(Sphere{}, Lambertian{})).size() == 1);
}

TEST_CASE("make_scene: takes placed shapes and lights, nothing else") {
    static_assert(detail::ScenePart<PointLight> &&
                  detail::ScenePart<Placed<Sphere, Mirror>>);
    static_assert(!detail::ScenePart<Sphere> && !detail::ScenePart<Lambertian> &&
                  !detail::ScenePart<int>);
}

TEST_CASE("make_scene: bad values are refused as by add()") {
    CHECK_THROWS_WITH_AS((void)make_scene(placed(Sphere{.radius = 0}, Lambertian{})),
                         "sphere.radius is 0; it must be finite and above 0.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        (void)make_scene(placed(Sphere{}, Lambertian{.albedo{0, 2, 0}})),
        "lambertian.albedo is (0, 2, 0); it must be within [0, 1] in every channel.",
        std::invalid_argument);
}
