/// \file scene_test.cpp
/// \brief What a scene takes, what it refuses, and how its things are found again.

#include "ljus/scene/scene.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "ljus/geometry/metaballs.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/scene/world.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::refusal;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float nan_value = std::numeric_limits<float>::quiet_NaN();

using Room = Scene<Shapes<Sphere, Quad, Triangle>, Materials<Lambertian, Glass, Mirror>,
                   Lights<PointLight, SunLight>>;

/// What a scene can add, as the compiler sees it.
template <typename S, typename... Args>
concept Takes = requires(S& scene, Args... args) {
    scene.add(args...);
};

static_assert(Takes<Room, Sphere, MaterialId> && Takes<Room, Quad, MaterialId, Rgb> &&
              Takes<Room, Triangle, MaterialId, Rgb, bool> && Takes<Room, Glass> &&
              Takes<Room, PointLight>);
// What is not listed gives a sentence, which tests/checks/short_errors.sh asks for.
static_assert(Room::lists<Triangle> && Room::lists<Mirror> && Room::lists<SunLight> &&
              !Room::lists<SphereT<double>> && !Room::lists<LambertianT<double>>);
using Small = Scene<Shapes<Sphere>, Materials<Lambertian>>;
static_assert(Small::lists<Sphere> && !Small::lists<Quad> && !Small::lists<Glass> &&
              !Small::lists<PointLight>);
static_assert(detail::each_once<> && detail::each_once<int> &&
              detail::each_once<int, char> && !detail::each_once<int, char, int> &&
              !detail::each_once<char, int, int>);

/// What a light is worked out to be; that of an object, else a lamp without an area.
template <AnyWorld W>
LampT<typename W::Scalar> lamp_of(const W& world, std::uint32_t number) {
    return world.visit_light(number, [](const auto& light) {
        if constexpr (requires { light.lamp; })
            return light.lamp;
        else
            return LampT<typename W::Scalar>{};
    });
}

/// The sphere around the scene, as a sun knows it.
template <AnyWorld W>
SphereT<typename W::Scalar> around(const W& world, std::uint32_t number) {
    return world.visit_light(number, [](const auto& light) {
        if constexpr (requires { light.around; })
            return light.around;
        else
            return SphereT<typename W::Scalar>{};
    });
}

} // namespace

TEST_CASE("scene: numbers are equal when type and index are") {
    CHECK(MaterialId{1, 2} == MaterialId{1, 2});
    CHECK(MaterialId{1, 2} != MaterialId{2, 1});
    CHECK(ObjectId{0, 3} == ObjectId{0, 3});
    CHECK(ObjectId{0, 3} != ObjectId{0, 4});
    CHECK(ObjectId{0, 3} != ObjectId{1, 3});
}

TEST_CASE("scene: without more said an object neither emits nor is inside out") {
    const ObjectT<float> object{.material = {1, 2}};
    CHECK(is_black(object.emission));
    CHECK_FALSE(object.inside_out);
    CHECK(object.light == std::numeric_limits<std::uint32_t>::max());
}

TEST_CASE("scene: what is added is found again, as its own type") {
    Room room;
    const MaterialId white = room.add(Lambertian{.albedo = Rgb{0.75f}});
    const MaterialId clear = room.add(Glass{});
    const MaterialId grey = room.add(Lambertian{.albedo = Rgb{0.25f}});
    CHECK(white == MaterialId{0, 0});
    CHECK(clear == MaterialId{1, 0});
    CHECK(grey == MaterialId{0, 1});

    const ObjectId ball = room.add(Sphere{.radius = 2}, clear);
    const ObjectId floor = room.add(Quad{}, grey);
    const ObjectId small = room.add(Sphere{.radius = 0.5f}, white);
    const ObjectId face = room.add(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, white);
    CHECK(ball == ObjectId{0, 0});
    CHECK(floor == ObjectId{1, 0});
    CHECK(small == ObjectId{0, 1});
    CHECK(face == ObjectId{2, 0});
    CHECK(room.size() == 4);
    CHECK(Room{}.size() == 0);

    const World world(room);
    CHECK(world.size() == 4);
    CHECK(World(Room{}).size() == 0);
    CHECK(world.object(ball).material == clear);
    CHECK(world.object(small).material == white);
    CHECK(world.object(floor).material == grey);
    const auto area_of = [&](ObjectId id) {
        return world.visit_shape(id, [](const auto& shape) { return area(shape); });
    };
    CHECK(double(area_of(small)) == doctest::Approx(3.14159265));
    CHECK(area_of(floor) == 1.0f);
    CHECK(area_of(face) == 0.5f);
    const auto kind_of = [&](MaterialId id) {
        return world.visit_material(id, [](const auto& m) { return lobes(m); });
    };
    CHECK(kind_of(white) == Lobes::diffuse);
    CHECK(kind_of(clear) == Lobes::specular);
    world.visit_material(grey, [](const auto& m) {
        using M = std::remove_cvref_t<decltype(m)>;
        static_assert(Material<M>);
        if constexpr (std::is_same_v<M, Lambertian>)
            CHECK(m.albedo == Rgb{0.25f});
        else
            CHECK(false);
    });
}

TEST_CASE("scene: visitors may return references") {
    Small scene;
    const auto id = scene.add(Sphere{}, scene.add(Lambertian{}));
    const World world(std::move(scene));
    decltype(auto) shape = world.visit_shape(
        id, [](const auto& s) -> const auto& { return s; });
    CHECK(&shape == std::get<0>(world.shapes()).data());
}

TEST_CASE("scene: lights are numbered as they come") {
    Room room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{}, black);                 // no light
    room.add(PointLight{.intensity = Rgb{0}}); // dark: no light either
    const auto lamp = room.add(Quad{}, black, Rgb{0, 0, 5});
    room.add(PointLight{.position{1, 2, 3}, .intensity = Rgb{7}});
    room.add(Sphere{}, black);
    const auto bulb = room.add(Sphere{}, black, Rgb{1}, true);
    CHECK(room.light_count() == 3);
    const World world(std::move(room));
    REQUIRE(world.light_count() == 3);
    CHECK(world.can_be_met(0));
    CHECK(lamp_of(world, 0).radiance == Rgb{0, 0, 5});
    CHECK(world.object(lamp).light == 0);
    CHECK(world.object(lamp).emission == Rgb{0, 0, 5});
    CHECK_FALSE(world.can_be_met(1));
    world.visit_light(1, []<typename L>(const L& light) {
        if constexpr (std::is_same_v<L, PointLight>) {
            CHECK(light.position == Vec3{1, 2, 3});
            CHECK(light.intensity == Rgb{7});
        } else {
            CHECK(false);
        }
    });
    CHECK(world.can_be_met(2));
    CHECK(world.object(bulb).light == 2);
    CHECK(world.object(bulb).inside_out);
    CHECK(lamp_of(world, 2).inside_out);
    CHECK_FALSE(lamp_of(world, 0).inside_out);
    // A lamp refers to the shape of its object.
    const void* shape = world.visit_light(2, [](const auto& light) -> const void* {
        if constexpr (requires { light.shape; }) return &light.shape;
        return nullptr;
    });
    CHECK(shape == &std::get<0>(world.shapes())[bulb.index]);
    CHECK(is_black(world.object({0, 0}).emission));
}

namespace glowing {

/// A material that shines by itself.
struct Glow {
    using Scalar = float;
    Rgb own{2, 0, 0};
};
inline Lobes lobes(const Glow&) {
    return Lobes::none;
}
inline Rgb evaluate(const Glow&, const Vec3&, const Vec3&) {
    return Rgb{0};
}
inline float pdf(const Glow&, const Vec3&, const Vec3&, Lobes) {
    return 0;
}
inline std::optional<BsdfSample> sample(const Glow&, const Vec3&, const Vec3&,
                                        Transport, Lobes) {
    return std::nullopt;
}
inline void check(const Glow&) {}
inline Rgb emission(const Glow& glow) {
    return glow.own;
}

} // namespace glowing

TEST_CASE("scene: what a material emits is added to what the shape emits") {
    Scene<Shapes<Sphere>, Materials<glowing::Glow, Lambertian>> scene;
    const auto glow = scene.add(glowing::Glow{});
    const auto alone = scene.add(Sphere{}, glow);
    const auto both = scene.add(Sphere{}, glow, Rgb{1, 1, 0});
    // A scene keeps what it was given; a world knows the sum.
    CHECK(scene.objects[0][both.index].emission == Rgb{1, 1, 0});
    CHECK(scene.light_count() == 2);
    const World world(std::move(scene));
    CHECK(world.object(alone).emission == Rgb{2, 0, 0});
    CHECK(world.object(both).emission == Rgb{3, 1, 0});
    REQUIRE(world.light_count() == 2);
    CHECK(lamp_of(world, 0).radiance == Rgb{2, 0, 0});
    CHECK(lamp_of(world, 1).radiance == Rgb{3, 1, 0});
}

TEST_CASE("scene: every bad input is one sentence with its name and value") {
    Room room;
    const auto white = room.add(Lambertian{});
    const auto add = [&](auto... what) { return refusal([&] { room.add(what...); }); };
    const std::size_t before = room.size();

    CHECK(add(Sphere{.radius = 0}, white) ==
          "sphere.radius is 0; it must be finite and above 0.");
    CHECK(add(Sphere{.center{0, nan_value, 0}}, white) ==
          "sphere.center is (0, NaN, 0); it must be finite in every component.");
    CHECK(add(Quad{.edge_u{infinity, 0, 0}}, white) ==
          "quad.edge_u is (infinity, 0, 0); it must be finite in every component.");
    CHECK(add(Triangle{.v3{0, 0, -infinity}}, white) ==
          "triangle.v3 is (0, 0, -infinity); it must be finite in every component.");
    CHECK(add(Lambertian{.albedo{0.5f, 1.5f, 0}}) ==
          "lambertian.albedo is (0.5, 1.5, 0); it must be within [0, 1] in every "
          "channel.");
    CHECK(add(Sphere{}, white, Rgb{0, -1, 0}) ==
          "emission is (0, -1, 0); it must be finite and at least 0 in every channel.");
    CHECK(add(Sphere{}, white, Rgb{nan_value}).find("emission is (NaN, NaN, NaN);") ==
          0);
    CHECK(add(PointLight{.position{0, infinity, 0}}) ==
          "point light.position is (0, infinity, 0); it must be finite in every "
          "component.");
    CHECK(add(PointLight{.intensity{0, 0, -2}}) ==
          "point light.intensity is (0, 0, -2); it must be finite and at least 0 in "
          "every channel.");
    CHECK(add(Sphere{}, MaterialId{0, 1}) ==
          "the material's number is 1; it must be one that add() returned.");
    CHECK(add(Sphere{}, MaterialId{1, 0}) == // no glass was added
          "the material's number is 0; it must be one that add() returned.");
    CHECK(add(Sphere{}, MaterialId{7, 0}) ==
          "the material's type is 7; it must be one that add() returned.");

    // A lamp has an area, and a flux that its precision can say.
    CHECK(add(Quad{.edge_v{2, 0, 0}}, white, Rgb{1}) ==
          "the area of a light is 0; it must be finite and above 0.");
    CHECK(add(Triangle{}, white, Rgb{1}) ==
          "the area of a light is 0; it must be finite and above 0.");
    CHECK(add(Sphere{.radius = 1e25f}, white, Rgb{1}) ==
          "the area of a light is infinity; it must be finite and above 0.");
    CHECK(add(Sphere{.radius = 100}, white, Rgb{1e38f, 0, 0}) ==
          "the flux of a light is (infinity, 0, 0); it must be finite and above 0.");
    CHECK(add(Sphere{.radius = 1e-10f}, white, Rgb{1e-38f}) ==
          "the flux of a light is (0, 0, 0); it must be finite and above 0.");
    CHECK(add(PointLight{.intensity{1e38f, 1, 1}})
              .find("the flux of a light is (infinity, 12.566") == 0);

    // Nothing of that is in the scene now.
    CHECK(room.size() == before);
    CHECK(room.light_count() == 0);
    CHECK(room.order.empty());
    CHECK(std::get<0>(room.lights).empty());
    CHECK(std::get<0>(room.materials).size() == 1);
    for (const auto& objects : room.objects) CHECK(objects.empty());
}

TEST_CASE("scene: a sun shines on all that there is, whenever it was added") {
    // Balls in two corners of a box from (-1, 2, 3) to (3, 8, 15), one of them beyond
    // the other in each coordinate, and one within: half its diagonal is 7.
    using Sky = Scene<Shapes<SphereT<double>>, Materials<LambertianT<double>>,
                      Lights<SunLightT<double>>>;
    const Vec3T<double> low{-1, 2, 3}, high{3, 8, 15};
    for (int turn = 0; turn < 4; ++turn)
        for (const bool low_first : {true, false}) {
            Sky sky;
            const auto grey = sky.add(LambertianT<double>{});
            const SphereT<double> below{low + 0.5, 0.5}, above{high - 0.25, 0.25};
            const auto sun = [&](int when) {
                if (turn == when) sky.add(SunLightT<double>{.direction{0, -1, 0}});
            };
            sun(0);
            sky.add(low_first ? below : above, grey);
            sun(1);
            sky.add(low_first ? above : below, grey);
            sun(2);
            sky.add(SphereT<double>{{1, 5, 9}, 1}, grey);
            sun(3);
            const World world(std::move(sky));
            REQUIRE(world.light_count() == 1);
            CHECK(glm::distance(around(world, 0).center, Vec3T<double>{1, 5, 9}) <
                  1e-9);
            CHECK(around(world, 0).radius == doctest::Approx(7.007));
        }
}

TEST_CASE("scene: what cannot be a light is refused as one, and shines on nobody") {
    Scene<Shapes<Sphere, Metaballs>, Materials<Lambertian, ThinGlass>> scene;
    const auto pane = scene.add(ThinGlass{});
    const auto grey = scene.add(Lambertian{});
    CHECK(refusal([&] {
              scene.add(Sphere{}, pane, Rgb{1});
          }).find("the radiance of a thin surface is (1, 1, 1)") == 0);
    Metaballs shape;
    shape.blobs.push_back({});
    CHECK(refusal([&] {
              scene.add(shape, grey, Rgb{1});
          }).find("the radiance of a shape of unknown area is (1, 1, 1)") == 0);
    CHECK(scene.light_count() == 0);
    CHECK(scene.size() == 0);
    // One past the last type, and one past the last material.
    CHECK(refusal([&] {
              scene.add(Sphere{}, MaterialId{2, 0});
          }).find("the material's type is 2") == 0);
    CHECK(refusal([&] {
              scene.add(Sphere{}, MaterialId{1, 1});
          }).find("the material's number is 1") == 0);
}

TEST_CASE("scene: an object knows its light, a flat light its normal and area") {
    Room room;
    const MaterialId matt = room.add(Lambertian{});
    const ObjectId dark = room.add(Sphere{}, matt);
    room.add(PointLight{});
    const ObjectId lamp =
        room.add(Quad{.edge_u{2, 0, 0}, .edge_v{0, 0, 3}}, matt, Rgb{1});
    const ObjectId wedge = room.add(Triangle{.v1{0, 0, 0}, .v2{4, 0, 0}, .v3{0, 2, 0}},
                                    matt, Rgb{1}, true);
    const ObjectId later = room.add(Quad{}, matt);
    const ObjectId ball = room.add(Sphere{}, matt, Rgb{1});
    const World world(std::move(room));
    CHECK(world.object(dark).light == no_light);
    CHECK(world.object(later).light == no_light);
    CHECK(world.object(lamp).light == 1);
    CHECK(world.object(wedge).light == 2);
    CHECK(world.object(ball).light == 3);
    // Of the shape itself: where it is inside out, sample_light() turns it.
    CHECK(lamp_of(world, 1).normal == Vec3{0, -1, 0});
    CHECK(lamp_of(world, 1).area == 6);
    CHECK(lamp_of(world, 2).normal == Vec3{0, 0, 1});
    CHECK(lamp_of(world, 2).area == 4);
    CHECK(lamp_of(world, 3).normal == Vec3{0}); // there is no one normal
    CHECK(double(lamp_of(world, 3).area) == doctest::Approx(12.566371));
}

TEST_CASE("scene: which types it lists, asked one by one") {
    const auto is = []<typename Wanted>(Wanted) {
        return []<typename G>() { return std::is_same_v<G, Wanted>; };
    };
    CHECK(Room::any_shape(is(Sphere{})));
    CHECK(Room::any_shape(is(Quad{})));
    CHECK(Room::any_shape(is(Triangle{})));
    CHECK_FALSE(Room::any_shape(is(Lambertian{})));
    CHECK(Room::any_material(is(Lambertian{})));
    CHECK(Room::any_material(is(Mirror{})));
    CHECK_FALSE(Room::any_material(is(Sphere{})));
    const auto is_sun = []<typename L>() {
        return std::is_same_v<L, SunInSceneT<float>>;
    };
    CHECK(Room::any_light(is_sun));
    CHECK_FALSE(Small::any_light(is_sun));
    CHECK_FALSE(Room::any_light(is(Sphere{})));
}

TEST_CASE("scene: a world has a box around all shapes, in which lights have no place") {
    Room room;
    const auto grey = room.add(Lambertian{});
    const auto low = [&] { return World(room).box().low; };
    const auto high = [&] { return World(room).box().high; };
    room.add(PointLight{.position{99, 99, 99}});
    CHECK((low() == Vec3{0} && high() == Vec3{0}));
    room.add(Sphere{{5, 6, 7}, 1}, grey);
    CHECK((low() == Vec3{4, 5, 6} && high() == Vec3{6, 7, 8}));
    room.add(Sphere{{5, 5, 9}, 2}, grey);
    CHECK((low() == Vec3{3, 3, 6} && high() == Vec3{7, 7, 11}));
    room.add(SunLight{});
    CHECK(around(World(room), 1).center == Vec3{5, 5, 8.5f});
    room.add(SunLight{.irradiance = Rgb{0}}); // dark: none
    CHECK(World(room).light_count() == 2);
    // A refused shape leaves all as it was.
    CHECK_THROWS_AS(room.add(Sphere{{50, 0, 0}, 1}, grey, Rgb{-1}),
                    std::invalid_argument);
    CHECK(high() == Vec3{7, 7, 11});
    CHECK(around(World(room), 1).center == Vec3{5, 5, 8.5f});
}
