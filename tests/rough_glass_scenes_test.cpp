// long: many pictures of three scenes
// concept: rough_glass
/// \file rough_glass_scenes_test.cpp
/// \brief Every way of carrying light through rough glass against path tracing.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "ljus/accel/mesh.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/inspect/explain.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/rough_glass.hpp"
#include "ljus/render/distributed.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/skipping.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/world.hpp"
#include "ljus/scenes/mesh_formulas.hpp"
#include "support/block_means.hpp"
#include "support/box_sides.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"
#include "support/student.hpp"

using namespace ljus;
using ljus_test::BlockMeans;
using ljus_test::chance_of;
using ljus_test::Mean;

namespace {

using Room = Scene<Shapes<Sphere, Quad, Mesh>, Materials<Lambertian, RoughGlass>>;

constexpr int across = 2, side = 24; // blocks on a side, and pixels
constexpr int blocks = across * across;

/// A closed room of 2 by 2 by 2, grey, with a red and a green wall.
Room walls() {
    Room room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.6f}});
    const auto red = room.add(Lambertian{.albedo{0.6f, 0.2f, 0.2f}});
    const auto green = room.add(Lambertian{.albedo{0.2f, 0.6f, 0.2f}});
    ljus_test::add_room(room, Vec3{-1}, Vec3{1}, {grey, grey, grey, grey, red, green});
    return room;
}

/// A lamp above a rough slab above the floor.
World<Room> slab_room(float roughness) {
    Room room = walls();
    const auto glass =
        room.add(RoughGlass{.roughness = roughness, .absorption{0.5f, 0, 0.2f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    ljus_test::add_block(room, {-0.7f, -0.4f, -0.7f}, {0.7f, -0.1f, 0.5f}, glass);
    room.add(Quad{{-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}}, black, Rgb{6});
    return World(std::move(room));
}

/// A lamp in a ball of rough glass.
World<Room> lamp_in_ball(float roughness) {
    Room room = walls();
    const auto glass =
        room.add(RoughGlass{.roughness = roughness, .absorption{0.5f, 0, 0.2f}});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{{0, -0.3f, -0.2f}, 0.5f}, glass);
    room.add(Sphere{{0.05f, -0.25f, -0.2f}, 0.2f}, black, Rgb{6});
    return World(std::move(room));
}

/// A lamp above a ball of a few triangles with the normals of a sphere.
World<Room> coarse_ball(float roughness) {
    Room room = walls();
    const auto glass = room.add(RoughGlass{.roughness = roughness});
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Mesh(icosphere(Sphere{{0, -0.4f, -0.1f}, 0.5f}, 1)), glass);
    room.add(Quad{{-0.4f, 0.98f, -0.4f}, {0.8f, 0, 0}, {0, 0, 0.8f}}, black, Rgb{6});
    return World(std::move(room));
}

/// A way of carrying light.
struct Carrier {
    const char* name;
    IndirectLight indirect;
    double bias; ///< Of a block, part of its mean and the picture's together.
    SkipRule skip = SkipRule::none;
};
constexpr std::array carriers{
    Carrier{"rays", IndirectLight::rays, 0},
    Carrier{"skip", IndirectLight::rays, 0.01, SkipRule::enough},
    Carrier{"map", IndirectLight::map, 0.02},
    Carrier{"photons", IndirectLight::photons, 0.02},
    Carrier{"gather", IndirectLight::gather, 0.02},
    Carrier{"cache", IndirectLight::cache, 0.02}};

Camera camera() {
    return look_at(
        {.position{0.2f, 0.3f, 0.95f}, .target{0, -0.35f, -0.2f}, .vfov_degrees = 75});
}

RenderSettings picture(int samples, std::uint64_t seed) {
    return {.width = side,
            .height = side,
            .samples = samples,
            .seed = ljus_test::test_seed(seed),
            .threads = 1};
}

PhotonMappingSettings settings_of(const Carrier& carrier, std::uint64_t seed) {
    PhotonMappingSettings settings{.direct = DirectLight::mis,
                                   .indirect = carrier.indirect};
    settings.caustics = {
        .photons = 20000, .seed = ljus_test::test_seed(seed), .threads = 1};
    settings.general = settings.caustics;
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    if (carrier.skip != SkipRule::none)
        settings.skip = {.rule = carrier.skip, .indirect_rays = true};
    return settings;
}

/// Compares all carriers in one scene.
void compare(const std::string& name, const World<Room>& world, double risk) {
    BlockMeans traced{side / across};
    for (std::uint64_t s = 1; s <= 12; ++s)
        traced.add(render(PathTracer(world), camera(), picture(64, 700 + s)).image);
    const double whole = traced.of.back().mean;
    for (const Carrier& carrier : carriers) {
        BlockMeans found{side / across};
        for (std::uint64_t seed = 1; seed <= 8; ++seed) {
            const auto how = picture(16, seed);
            PhotonMapper mapper(world, settings_of(carrier, seed),
                                abilities<Gathering, Skipping>);
            mapper.fill_cache(camera(), how);
            found.add(render(mapper, camera(), how).image);
        }
        double most = 0;
        for (std::size_t b = 0; b <= blocks; ++b) {
            const Mean &right = traced.of[b], &here = found.of[b];
            const double bias = carrier.bias * (right.mean + whole);
            CAPTURE(name);
            CAPTURE(std::string(carrier.name));
            CAPTURE(b);
            CHECK(chance_of(here, right, bias) > risk);
            most = std::max(most, std::abs(here.mean / right.mean - 1));
        }
        MESSAGE(name, ", ", std::string(carrier.name), ": ",
                100 * (found.of.back().mean / whole - 1), " %, a block ", 100 * most,
                " % off");
    }
}

} // namespace

// 5 scenes, 6 carriers, 5 means: a false alarm once in 1000 runs.
TEST_CASE("rough glass scenes: every carrier of light agrees with path tracing") {
    constexpr double risk = 1e-3 / (5 * 6 * (blocks + 1));
    compare("slab of roughness 0.6", slab_room(0.6f), risk);
    compare("slab of roughness 0.2", slab_room(0.2f), risk);
    compare("lamp in a ball of roughness 0.7", lamp_in_ball(0.7f), risk);
    compare("lamp in a ball of roughness 0.3", lamp_in_ball(0.3f), risk);
    compare("ball of few triangles", coarse_ball(0.4f), risk);
}

TEST_CASE("rough glass scenes: no photon map is asked at rough glass, and its light "
          "passes as D") {
    Scene<Shapes<Sphere>, Materials<RoughGlass>, Lights<PointLight>> scene;
    scene.add(Sphere{{0, 0, 0}, 1}, scene.add(RoughGlass{.roughness = 0.5f}));
    scene.add(PointLight{.position{0.5f, 0.5f, -4}, .intensity = Rgb{9}});
    const World world(std::move(scene));
    const auto look = look_at({.position{0, 0, 4}, .vfov_degrees = 20});
    for (const Carrier& carrier : carriers) {
        CAPTURE(std::string(carrier.name));
        const PhotonMapper mapper(world, settings_of(carrier, 1),
                                  abilities<Gathering, Skipping>);
        CHECK(mapper.passes().general_map == !mapper.maps().general.empty());
        const auto made = render(mapper, look, picture(4, 1));
        CHECK(made.counts.map_queries == 0);
        // Light comes through, and in no other letters than D.
        const Rgb middle = pixel(made.image, side / 2, side / 2);
        CHECK(middle.x > 0);
    }
    std::string letters;
    const PathTracer tracer(world);
    for (const auto& sum :
         detail::take_apart(tracer, look, picture(200, 2), 12, 8).sums)
        letters += sum.path + " ";
    MESSAGE(letters);
    CHECK(letters.find('S') == std::string::npos);
    CHECK(letters.find("EDDL") != std::string::npos);
}

TEST_CASE("rough glass scenes: two blocks that touch are one") {
    const auto block = [](bool halved) {
        Room room;
        const auto glass =
            room.add(RoughGlass{.roughness = 0.6f, .absorption{0.5f, 0, 0}});
        const auto black = room.add(Lambertian{.albedo = Rgb{0}});
        if (halved) {
            ljus_test::add_block(room, {-1, -1, -1}, {1, 0, 1}, glass);
            ljus_test::add_block(room, {-1, 0, -1}, {1, 1, 1}, glass);
        } else {
            ljus_test::add_block(room, {-1, -1, -1}, {1, 1, 1}, glass);
        }
        room.add(Sphere{{0, -0.8f, -2.6f}, 1}, black, Rgb{1});
        return World(std::move(room));
    };
    const auto ray = [](auto& stream) {
        const auto u = next_2d<float>(stream);
        return Ray{.origin{u.x - 0.5f, u.y - 0.5f, 3}, .direction{0, 0, -1}};
    };
    const World<Room> one = block(false), two = block(true);
    const Mean whole = ljus_test::mean_radiance(PathTracer(one), 40000, 9, ray);
    const Mean halves = ljus_test::mean_radiance(PathTracer(two), 40000, 10, ray);
    MESSAGE(whole.mean, " +- ", whole.error(), " and ", halves.mean);
    CHECK(std::abs(ljus_test::apart(whole, halves)) < 5);
    CHECK(whole.error() < 0.02 * whole.mean);
}

TEST_CASE("rough glass scenes: distributed rays follow it to lamps") {
    Scene<Shapes<Sphere>, Materials<Lambertian, RoughGlass>> scene;
    scene.add(Sphere{{0, 0, 0}, 1}, scene.add(RoughGlass{.roughness = 0.5f}));
    scene.add(Sphere{{0, 0.5f, -2.5f}, 0.5f}, scene.add(Lambertian{.albedo = Rgb{0}}),
              Rgb{1});
    const World world(std::move(scene));
    const auto ray = [](auto& stream) {
        const auto u = next_2d<float>(stream);
        return Ray{.origin{u.x - 0.5f, u.y - 0.5f, 3}, .direction{0, 0, -1}};
    };
    const DistributedTracer distributed(world, {.max_depth = 100});
    const Mean by_paths = ljus_test::mean_radiance(PathTracer(world), 40000, 7, ray);
    const Mean by_rays = ljus_test::mean_radiance(distributed, 40000, 8, ray);
    MESSAGE(by_paths.mean, " and ", by_rays.mean);
    CHECK(std::abs(ljus_test::apart(by_paths, by_rays)) < 5);
}

TEST_CASE("rough glass scenes: photons of one side of glass make no ray needless") {
    // Light arrives from both sides of a surface; with glass alone no ray is left out.
    Scene<Shapes<Sphere>, Materials<RoughGlass>, Lights<PointLight>> scene;
    scene.add(Sphere{{0, 0, 0}, 1}, scene.add(RoughGlass{.roughness = 0.7f}));
    scene.add(PointLight{.position{3, 1, -1}, .intensity = Rgb{9}});
    const World world(std::move(scene));
    const auto look = look_at({.position{0, 0, 4}, .vfov_degrees = 30});
    const auto made = [&](const SkipSettings& skip) {
        PhotonMappingSettings settings = settings_of(carriers[0], 3);
        settings.general.photons = 500;
        settings.skip = skip;
        return render(PhotonMapper(world, settings, abilities<Gathering, Skipping>),
                      look, picture(16, 3));
    };
    const auto all = made({});
    const auto left_out =
        made({.rule = SkipRule::any, .indirect_rays = true, .radius = 0.4f});
    CHECK(left_out.counts.skipped_rays == 0);
    CHECK(left_out.counts.skipped_bounces == 0);
    for (int i = 0; i < side * side; ++i)
        REQUIRE(pixel(left_out.image, i % side, i / side) ==
                pixel(all.image, i % side, i / side));
}

TEST_CASE("rough glass scenes: glass in whose lobe no shadow ray lies is remarked on") {
    const auto remarks = [](float roughness) {
        Scene<Shapes<Sphere>, Materials<RoughGlass>> scene;
        scene.add(Sphere{{0, 0, 0}, 1}, scene.add(RoughGlass{.roughness = roughness}),
                  Rgb{1});
        std::string all;
        for (const std::string& line : scene_remarks(World(std::move(scene)), {}))
            all += line;
        return all;
    };
    CHECK(remarks(0.1f).find("1 object(s) are nearly mirrors") == 0);
    CHECK(remarks(0.5f).empty());
    CHECK(remarks(0).empty());
}

TEST_CASE("rough glass scenes: a shadow ray out of rough glass into another body is "
          "absorbed there") {
    // A lamp and a rough ball, both in a ball of green glass.
    Scene<Shapes<Sphere>, Materials<Lambertian, RoughGlass, Glass>> scene;
    const auto green = scene.add(Glass{.index = 1.3f, .absorption{3, 0, 3}});
    const auto frosted = scene.add(RoughGlass{.roughness = 0.6f});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Sphere{{0, 0, 0}, 1}, green);
    scene.add(Sphere{{-0.4f, 0, 0}, 0.3f}, frosted);
    scene.add(Sphere{{0.5f, 0, 0}, 0.25f}, black, Rgb{1});
    const World world(std::move(scene));
    const auto ray = [](auto& stream) { // to the frosted ball
        const auto u = next_2d<float>(stream);
        return Ray{.origin{-0.9f, 0.5f * u.x, 0.5f * u.y - 0.25f}, .direction{1, 0, 0}};
    };
    const auto seen = [&](bool shadow_rays, int channel) {
        const PathTracer tracer(world, {.sample_lights = shadow_rays,
                                        .heuristic = MisHeuristic::shadow_rays});
        return ljus_test::mean_radiance(tracer, 40000, 5, ray, channel);
    };
    // With rays that the material samples.
    const PhotonMapper mapper(world, {.direct = DirectLight::mis,
                                      .caustics{.photons = 100000},
                                      .caustics_estimate{.radius = 0.05f}});
    for (const int channel : {0, 1}) {
        const Mean by_rays = seen(true, channel), by_paths = seen(false, channel);
        MESSAGE(by_rays.mean, " +- ", by_rays.error(), " and ", by_paths.mean, " +- ",
                by_paths.error());
        CHECK(std::abs(ljus_test::apart(by_rays, by_paths)) < 5);
        const Mean mapped = ljus_test::mean_radiance(mapper, 40000, 6, ray, channel);
        MESSAGE("by the mapper ", mapped.mean, " +- ", mapped.error());
        CHECK(std::abs(mapped.mean - by_paths.mean) <
              0.03 * by_paths.mean + 5 * std::hypot(mapped.error(), by_paths.error()));
    }
    // At the last vertex, where it leaves the frosted ball, no ray goes on that would
    // find the lamp: one of its own does.
    PhotonMappingSettings ending = mapper.settings();
    ending.max_depth = 2;
    const auto ended =
        ljus_test::mean_radiances(PhotonMapper(world, ending), 40000, 7, ray);
    const auto right = ljus_test::mean_radiances(
        PathTracer(world, {.max_depth = 2, .sample_lights = false}), 40000, 8, ray);
    for (const std::size_t channel : {0u, 1u}) {
        MESSAGE(ended[channel].mean, " and ", right[channel].mean, " +- ",
                right[channel].error());
        CHECK(std::abs(ljus_test::apart(ended[channel], right[channel])) < 5);
    }
}
