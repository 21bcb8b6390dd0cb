#include <doctest/doctest.h>

#include "ljus/inspect/survey.hpp"
#include "ljus/render/distributed.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

TEST_CASE("counts: sums, member by member") {
    Counts a{.camera_rays = 1,
             .bounce_rays = 2,
             .shadow_rays = 3,
             .map_queries = 4,
             .map_photons = 5,
             .skipped_rays = 7,
             .skipped_bounces = 8,
             .rejected = 6,
             .cut_paths = 9};
    const Counts b{.camera_rays = 10,
                   .bounce_rays = 20,
                   .shadow_rays = 30,
                   .map_queries = 40,
                   .map_photons = 50,
                   .skipped_rays = 70,
                   .skipped_bounces = 80,
                   .rejected = 60,
                   .cut_paths = 90};
    a += b;
    CHECK(a.camera_rays == 11);
    CHECK(a.bounce_rays == 22);
    CHECK(a.shadow_rays == 33);
    CHECK(a.map_queries == 44);
    CHECK(a.map_photons == 55);
    CHECK(a.skipped_rays == 77);
    CHECK(a.skipped_bounces == 88);
    CHECK(a.rejected == 66);
    CHECK(a.cut_paths == 99);
    CHECK(a.rays() == 66); // no queries, no photons
}

TEST_CASE("counts: one shadow ray a light and surface, one ray a bounce") {
    // An open floor under two point lights: each path is camera ray, two shadow rays,
    // and one indirect ray that meets nothing.
    ljus_test::BallRoom room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.5f}});
    room.add(Quad{.corner{-90, 0, -90}, .edge_u{0, 0, 180}, .edge_v{180, 0, 0}}, white);
    room.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{1}});
    room.add(PointLight{.position{1, 2, 0}, .intensity = Rgb{1}});
    const World world(std::move(room));
    const Camera camera = look_at({.position{0, 3, 0}, .target{0, 0, 0}, .up{0, 0, 1}});
    const RenderSettings picture{.width = 10, .height = 10, .samples = 4, .threads = 1};
    PhotonMappingSettings settings;
    const auto mapped = render(PhotonMapper(world, settings), camera, picture);
    CHECK(mapped.counts.camera_rays == 400);
    CHECK(mapped.counts.shadow_rays == 800);
    CHECK(mapped.counts.bounce_rays == 400);
    CHECK(mapped.counts.map_queries == 0);
    CHECK(mapped.counts.map_photons == 0);
    // The path tracer chooses one of the lights.
    const auto traced = render(PathTracer(world), camera, picture);
    CHECK(traced.counts.shadow_rays == 400);
    CHECK(traced.counts.bounce_rays == 400);
    // Depth 1: direct light only, and no other ray.
    settings.max_depth = 1;
    const auto direct = render(PhotonMapper(world, settings), camera, picture);
    CHECK(direct.counts.shadow_rays == 800);
    CHECK(direct.counts.bounce_rays == 0);
}

TEST_CASE("counts: passes that are off make no photon and ask no query") {
    const Camera camera = room_camera<float>();
    const RenderSettings picture{.width = 10, .height = 10, .samples = 2, .threads = 1};
    PhotonMappingSettings settings;
    settings.caustics.photons = 2000;
    settings.general.photons = 2000;
    const auto counts_of = [&](const ljus_test::ClosedRoom& room) {
        const PhotonMapper mapper(room, settings);
        const auto& maps = mapper.maps();
        const Plan plan = survey(room, settings);
        CHECK(plan.caustics_map.on == !maps.caustics.empty());
        CHECK(plan.general_map.on == !maps.general.empty());
        return render(mapper, camera, picture).counts;
    };
    // No mirror, no glass: no caustics.
    const ljus_test::ClosedRoom matt =
        make_room<float>(Ball::lambertian, Lamp::quad, 1);
    CHECK(counts_of(matt).map_queries == 0);
    CHECK(counts_of(matt).map_photons == 0);
    const ljus_test::ClosedRoom glass = make_room<float>(Ball::glass, Lamp::quad, 1);
    const Counts with = counts_of(glass);
    CHECK(with.map_queries > 100);
    CHECK(with.map_photons > 100);
    settings.caustics.photons = 0;
    CHECK(counts_of(glass).map_queries == 0);
    settings.indirect = IndirectLight::map;
    CHECK(counts_of(matt).map_queries > 100);
    settings.indirect = IndirectLight::none;
    const Counts direct = counts_of(matt);
    CHECK(direct.map_queries == 0);
    CHECK(direct.bounce_rays == 0);
    CHECK(direct.shadow_rays <= direct.camera_rays); // none where the lamp is behind
    CHECK(direct.shadow_rays > direct.camera_rays / 2);
}

TEST_CASE("counts: what the depth cuts is counted, path by path") {
    // In a white hall between mirrors every path goes on until the depth ends it.
    const RenderSettings picture{.width = 6, .height = 5, .samples = 2, .threads = 1};
    const auto cut = [&](const auto& renderer, const Camera& camera) {
        const Counts counts = render(renderer, camera, picture).counts;
        CHECK(counts.camera_rays == 60);
        return counts.cut_paths;
    };
    const auto matt = sphere_furnace<float>(Rgb{1}, Rgb{0.75f});
    const Camera inside = matt.camera;
    for (const int depth : {1, 4}) {
        const PathTracingSettings traced{.max_depth = depth, .roulette_depth = 1000};
        CHECK(cut(PathTracer(matt.world, traced), inside) == 60);
        PhotonMappingSettings settings{.max_depth = depth, .roulette_depth = 1000};
        // At a depth of one the plan has no indirect rays, and says why.
        CHECK(cut(PhotonMapper(matt.world, settings), inside) == (depth == 1 ? 0 : 60));
        // The map answers for what comes after: nothing is missing.
        settings.indirect = IndirectLight::photons;
        CHECK(cut(PhotonMapper(matt.world, settings), inside) == 0);
    }
    // No path is cut where it ends by itself.
    Scene<Shapes<Sphere>, Materials<Lambertian, Mirror>> black;
    black.add(Sphere{.center{0, 0, 0}, .radius = 1},
              black.add(Lambertian{.albedo = Rgb{0}}), Rgb{1}, true);
    const World world(std::move(black));
    CHECK(cut(PathTracer(world, {.max_depth = 50}), inside) == 0);
    Scene<Shapes<Sphere>, Materials<Mirror>> hall;
    hall.add(Sphere{.center{0, 0, 0}, .radius = 1}, hall.add(Mirror{}), Rgb{0}, true);
    const World hall_world(std::move(hall));
    for (const int depth : {1, 4}) {
        CHECK(cut(PathTracer(hall_world, {.max_depth = depth, .roulette_depth = 1000}),
                  inside) == 60);
        CHECK(cut(WhittedTracer(hall_world, {.max_depth = depth}), inside) == 60);
        CHECK(cut(DistributedTracer(hall_world, {.max_depth = depth}), inside) == 60);
    }
}
