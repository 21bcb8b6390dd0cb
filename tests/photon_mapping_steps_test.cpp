// concept: photon_mapping
// Who answers at a vertex, by a plain twin that asks each of them itself; and what a
// path does at mirrors and glass, where nothing is left to chance or chance shows. Run
// with 20 further seeds: none failed.
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "ljus/geometry/cylinder.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/skipping.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

struct Term {
    std::string owner, letters;
    Rgb light;
    bool operator==(const Term&) const = default;
};
using Terms = std::vector<Term>;

/// Writes down what light_at() adds.
struct Witness {
    Terms& seen;
    Rgb throughput{1};
    void operator()(const char* owner, const char* letters, const Rgb& light) const {
        seen.push_back({owner, letters, light});
    }
};

/// Settings that differ wherever one could be taken for another.
PhotonMappingSettings distinct(IndirectLight indirect, DirectLight direct) {
    PhotonMappingSettings settings{
        .shadow_rays = 3, .direct = direct, .indirect = indirect};
    settings.caustics = {.photons = 3000, .seed = test_seed(2), .threads = 1};
    settings.general = {.photons = 6000, .seed = test_seed(3), .threads = 1};
    settings.caustics_estimate.radius = 0.15f;
    settings.general_estimate.radius = 0.4f;
    settings.keep_general_map = true;
    settings.gather.rays = 5;
    return settings;
}

} // namespace

TEST_CASE("photon mapping: who answers at a vertex, term by term") {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror, Glossy>> room;
    const Lambertian matt{.albedo{0.8f, 0.5f, 0.2f}};
    const Glossy gloss{.reflectance{0.9f, 0.7f, 0.5f}, .roughness = 0.3f};
    const Mixture mixed{.color{0.7f, 0.5f, 0.3f},
                        .reflectivity = 0.2f,
                        .transparency = 0.3f,
                        .index = 1.5f,
                        .specularity = 1,
                        .sigma = 0.4f};
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    for (const float y : {-1.0f, 1.0f})
        room.add(Quad{{-2, y, -2}, {0, 0, 4}, {4, 0, 0}}, grey);
    room.add(Sphere{.center{0.1f, 0.3f, 0}, .radius = 0.3f}, room.add(Glass{}));
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Quad{{-0.5f, 0.9f, -0.5f}, {1, 0, 0}, {0, 0, 1}}, black, Rgb{9, 8, 7});
    room.add(Sphere{.center{1.5f, 0, 0}, .radius = 0.2f}, black, Rgb{2, 5, 9});
    const World world(std::move(room));
    const Camera camera = look_at(View{.position{0, 0.8f, 1.5f}, .target{0, -1, 0}});

    const Rgb in_all{std::numbers::inv_pi_v<float>};
    for (const IndirectLight indirect :
         {IndirectLight::rays, IndirectLight::map, IndirectLight::photons,
          IndirectLight::gather, IndirectLight::cache, IndirectLight::none})
        for (const DirectLight direct :
             {DirectLight::sampled, DirectLight::analytic, DirectLight::mis})
            for (const bool skip : {false, true}) {
                PhotonMappingSettings settings = distinct(indirect, direct);
                if (skip) settings.skip.rule = SkipRule::any;
                PhotonMapper mapper(world, settings, abilities<Gathering, Skipping>);
                mapper.fill_cache(camera, {.width = 30, .height = 30, .threads = 1});
                const auto& maps = mapper.maps();
                const auto& known = mapper.state<Gathering>();
                const auto& verdicts = mapper.state<Skipping>().verdicts;
                REQUIRE_FALSE(maps.caustics.empty());
                REQUIRE_FALSE(maps.general.empty());
                REQUIRE(verdicts.empty() != skip);
                const bool gathers = detail::gathers(indirect);
                for (int i = 0; i < 12; ++i) {
                    // Up and down, so that the floor is seen from both sides.
                    const float side = i % 2 == 0 ? 1.0f : -1.0f;
                    const Ray ray{.origin{0.3f * float(i / 2) - 0.7f, -1 + 0.1f * side,
                                          0.05f * float(i)},
                                  .direction{0, -side, 0}};
                    const auto hit = closest_hit(world, ray);
                    REQUIRE(hit);
                    const auto vertex = vertex_at(world, ray, *hit);
                    REQUIRE(vertex.wo.z * side > 0);
                    const Vec3 normal{0, side, 0};
                    const auto check_with = [&](const auto& material, bool diffuse,
                                                bool gather) {
                        auto stream = random_stream(1, Pass::user, 0, std::uint64_t(i));
                        auto twin = stream;
                        Counts counts, cost;
                        Terms seen, right;
                        auto context = context_of(stream, counts);
                        auto plain = context_of(twin, cost);
                        light_at(mapper, vertex, material, gather, {direct, 3}, context,
                                 Witness{seen});
                        const auto ask = [&](const PhotonMap& map,
                                             const DensityEstimateSettings& how,
                                             PhotonKinds kinds) {
                            ++cost.map_queries;
                            return estimate_radiance(map, vertex, material, vertex.wo,
                                                     how, kinds, cost.map_photons);
                        };
                        const auto caustics = [&] {
                            right.push_back(
                                {"caustics map", "DS+L",
                                 ask(maps.caustics, settings.caustics_estimate,
                                     light_kinds)});
                        };
                        if (gather && indirect == IndirectLight::map) {
                            right.push_back(
                                {"general map", "DL|D..DL",
                                 ask(maps.general, settings.general_estimate,
                                     light_kinds)});
                            caustics();
                        } else if (gather) {
                            ++cost.map_queries;
                            const auto irradiance = [&](const Vec3& wi) {
                                const auto at_point = irradiance_at(
                                    known.points, vertex.point.position, normal);
                                return at_point ? *at_point
                                                : detail::irradiance_towards(
                                                      world, gather_lookup(mapper),
                                                      vertex, wi, plain);
                            };
                            right.push_back(
                                {"irradiance points", "DL|D..DL|DS+L",
                                 detail::reflected(material, vertex.wo, irradiance,
                                                   Lobes::non_specular, twin)});
                        } else {
                            right.push_back(
                                {"shadow ray", "DL",
                                 sample_all_lights(
                                     world, vertex, material, {direct, 3}, plain,
                                     detail::verdicts_at(verdicts, vertex))});
                            if (indirect == IndirectLight::photons)
                                right.push_back(
                                    {"general map", "D..DL",
                                     ask(maps.general, settings.general_estimate,
                                         one_kind(PhotonKind::indirect))});
                            if (indirect == IndirectLight::cache && diffuse) {
                                const Rgb irradiance = irradiance_between(
                                    world, known.points, known.cache, vertex, material,
                                    settings.gather, plain);
                                if constexpr (std::is_same_v<decltype(material),
                                                             const Lambertian&>) {
                                    right.push_back(
                                        {"irradiance cache", "D..DL",
                                         irradiance * in_all * matt.albedo});
                                } else { // of its matt part, and of nothing else
                                    const auto part = sample(
                                        material, vertex.wo, next_3d<float>(twin),
                                        Transport::radiance, Lobes::diffuse);
                                    right.push_back(
                                        {"irradiance cache", "D..DL",
                                         part ? irradiance * in_all * part->weight
                                              : Rgb{0}});
                                }
                            }
                            caustics();
                        }
                        REQUIRE(seen.size() == right.size());
                        for (std::size_t k = 0; k < seen.size(); ++k) {
                            CAPTURE(right[k].owner);
                            CHECK(seen[k].owner == right[k].owner);
                            CHECK(seen[k].letters == right[k].letters);
                            CHECK(glm::distance(seen[k].light, right[k].light) <=
                                  1e-5f * glm::length(right[k].light));
                        }
                        CHECK(next_1d(stream) == next_1d(twin));
                        CHECK(counts.map_queries == cost.map_queries);
                        CHECK(counts.map_photons == cost.map_photons);
                        CHECK(counts.shadow_rays == cost.shadow_rays);
                        CHECK(counts.skipped_rays == cost.skipped_rays);
                    };
                    for (const bool gather : {false, true}) {
                        if (gather && !gathers) continue;
                        check_with(matt, true, gather);
                        check_with(gloss, false, gather);
                        check_with(mixed, true, gather);
                    }
                }
            }
}

TEST_CASE("photon mapping: a path goes both ways eight times, and loses nothing") {
    // A pane of thick clear glass in light of radiance 1 from all around: whatever ways
    // the path takes, together they bring 1, and each way out is one term.
    BallRoom room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{.radius = 100}, black, Rgb{1}, true);
    const auto glass = room.add(Glass{.index = 2.4f});
    room.add(Quad{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, glass);
    room.add(Quad{{-50, -50, -1}, {0, 100, 0}, {100, 0, 0}}, glass);
    const World world(std::move(room));
    const Ray ray{.origin{0, 0, 1}, .direction{0, 0, -1}};
    for (const bool split : {false, true}) {
        PhotonMappingSettings settings{.roulette_depth = 1000, .split_glass = split};
        settings.caustics.photons = 0;
        const PhotonMapper mapper(world, settings);
        for (std::uint64_t i = 0; i < 50; ++i) {
            auto stream = random_stream(test_seed(1), Pass::user, 0, i);
            Counts counts;
            PathLog log;
            auto context = context_of(stream, counts, log);
            const Rgb seen = radiance(mapper, ray, context);
            CHECK(seen.x == doctest::Approx(1).epsilon(1e-5));
            const auto ends =
                std::count_if(log.lines.begin(), log.lines.end(),
                              [](const auto& line) { return line.what == "emission"; });
            CHECK(ends == (split ? 9 : 1));
            // A ray for each surface on the way, and one more for each that split off.
            std::uint64_t rays = 0, longest = 0;
            for (const auto& line : log.lines)
                if (line.what == "emission") {
                    rays += line.path.size() - 2; // E and L are none
                    longest = std::max<std::uint64_t>(longest, line.path.size());
                }
            CHECK(counts.cut_paths == 0);
            CHECK(longest > 2);
            if (!split) CHECK(counts.bounce_rays == rays);
            if (split) {
                // Of the tree of paths each edge once: what two ways share is one ray.
                CHECK(counts.bounce_rays < rays);
                // Both ways from eight surfaces; and one ray from each later one, which
                // are those of the longest path without E, L and the eight.
                CHECK(counts.bounce_rays == 16 + longest - 10);
            }
        }
        // From the first surface on roulette may end it, but the n^2 of glass is no
        // reason, and what has split off is in danger at a 64th of what it carries.
        settings.roulette_depth = 1;
        const PhotonMapper short_lived(world, settings);
        int mirrored = 0;
        const double share = 1.4 * 1.4 / (3.4 * 3.4); // Fresnel's, head on
        for (std::uint64_t i = 0; i < 400; ++i) {
            auto stream = random_stream(test_seed(2), Pass::user, 0, i);
            Counts counts;
            PathLog log;
            auto context = context_of(stream, counts, log);
            const Rgb seen = radiance(short_lived, ray, context);
            if (!split) CHECK(seen.x == doctest::Approx(1).epsilon(1e-5));
            for (const auto& line : log.lines)
                if (split && line.path == "ESL") {
                    ++mirrored;
                    CHECK(line.value.x == doctest::Approx(std::max(share, 1.0 / 64)));
                }
        }
        if (split) CHECK(mirrored == 400); // it carries more than a 64th
    }
}

TEST_CASE("photon mapping: faint branches of split paths send few shadow rays") {
    BallRoom room;
    room.add(Sphere{.radius = 100}, room.add(Lambertian{}), Rgb{1}, true);
    const World world(std::move(room));
    const auto rays = [&](bool split, const PathState& path) {
        const PhotonMapper mapper(world, {.shadow_rays = 4, .split_glass = split});
        return detail::direct_light_at(mapper, path, Lambertian{}, Lobes::all).rays;
    };
    // The largest channel counts, without the n^2 of glass around the eye.
    for (const auto& [carried, scale, count] : {std::tuple{1.0f, 1.0f, 4},
                                                {0.5f, 1.0f, 4},
                                                {0.3f, 1.0f, 3},
                                                {0.2f, 1.0f, 2},
                                                {0.04f, 1.0f, 1},
                                                {0.0f, 1.0f, 1},
                                                {0.4f, 2.0f, 2},
                                                {2.0f, 1.0f, 4}}) {
        PathState path{.throughput{0, carried, 0}, .eta_scale = scale};
        CHECK(rays(true, path) == count);
        CHECK(rays(false, path) == 4);
        path.met_diffuse = true; // no branch is split off any more
        CHECK(rays(true, path) == 4);
    }
}

TEST_CASE("photon mapping: behind a matt surface a path goes one way at glass") {
    // A matt floor below a pane of glass, seen from between them: both ways at the pane
    // would be a ray more.
    BallRoom room;
    room.add(Sphere{.radius = 100}, room.add(Lambertian{.albedo = Rgb{0}}), Rgb{1},
             true);
    room.add(Quad{{-50, -50, -3}, {100, 0, 0}, {0, 100, 0}}, room.add(Lambertian{}));
    const auto glass = room.add(Glass{});
    room.add(Quad{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, glass);
    room.add(Quad{{-50, -50, -1}, {0, 100, 0}, {100, 0, 0}}, glass);
    const World world(std::move(room));
    const Ray ray{.origin{0, 0, -2}, .direction{0, 0, -1}};
    const auto seen = [&](bool split) {
        PhotonMappingSettings settings{.split_glass = split};
        settings.caustics.photons = 0;
        const PhotonMapper mapper(world, settings);
        Rgb sum{0};
        Counts counts;
        for (std::uint64_t i = 0; i < 100; ++i) {
            auto stream = random_stream(test_seed(3), Pass::user, 0, i);
            auto context = context_of(stream, counts);
            sum += radiance(mapper, ray, context);
        }
        return std::tuple(sum, counts.bounce_rays);
    };
    CHECK(seen(true) == seen(false));
}

TEST_CASE("photon mapping: behind a matt surface no branch is spared by roulette") {
    // Far above a dim floor a pane splits the camera path. What comes through it is
    // (1 - R) / (1 + R), and of that the floor lets the share of its albedo go on, into
    // the void: a ray more than above a black floor, where the same numbers are drawn.
    // Within 5 measured standard errors: one seed in a million would lie beyond.
    constexpr double albedo = 0.2, reflected = 0.04,
                     through = (1 - reflected) / (1 + reflected);
    constexpr int paths = 4000;
    std::vector<std::uint64_t> rays[2];
    for (const int bright : {0, 1}) {
        BallRoom room;
        room.add(Quad{{-5e3f, -5e3f, -50}, {1e4f, 0, 0}, {0, 1e4f, 0}},
                 room.add(Lambertian{.albedo = Rgb{float(albedo) * float(bright)}}));
        const auto glass = room.add(Glass{.index = 1.5f});
        room.add(Quad{{-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}}, glass);
        room.add(Quad{{-0.5f, -0.5f, -1e-2f}, {0, 1, 0}, {1, 0, 0}}, glass);
        room.add(PointLight{.position{9, 0, -20}}); // or no indirect ray is sent
        const World world(std::move(room));
        PhotonMappingSettings settings{.roulette_depth = 1, .split_glass = true};
        settings.caustics.photons = 0;
        const PhotonMapper mapper(world, settings);
        for (std::uint64_t i = 0; i < paths; ++i) {
            auto stream = random_stream(test_seed(8), Pass::user, 0, i);
            Counts counts;
            auto context = context_of(stream, counts);
            (void)radiance(mapper, Ray{.origin{0, 0, 1}, .direction{0, 0, -1}},
                           context);
            rays[bright].push_back(counts.bounce_rays);
        }
    }
    Mean more;
    for (std::size_t i = 0; i < paths; ++i)
        more.add(double(rays[1][i]) - double(rays[0][i]));
    CAPTURE(more.mean);
    CHECK(std::abs(more.mean - albedo * through) < 5 * more.error());
    CHECK(more.error() < 0.01);
}

TEST_CASE("photon mapping: where a path ends that has gathered, and who shows a lamp") {
    // A matt room: an indirect ray that gathers where it ends goes no farther; a lamp
    // is seen by the camera alone.
    const ClosedRoom room = make_room<float>(Ball::lambertian, Lamp::quad, 2);
    const Camera camera = look_at(View{.position{0, -0.9f, 0.9f}, .target{0, 1, 0}});
    for (const auto& [way, least, most] : {std::tuple{IndirectLight::rays, 2, 100},
                                           {IndirectLight::map, 1, 1},
                                           {IndirectLight::gather, 1, 1},
                                           {IndirectLight::photons, 0, 0},
                                           {IndirectLight::cache, 0, 0},
                                           {IndirectLight::none, 0, 0}}) {
        const IndirectLight indirect = way; // captured below
        PhotonMappingSettings settings = distinct(indirect, DirectLight::sampled);
        const PhotonMapper mapper(room, settings, abilities<Gathering>);
        std::uint64_t longest = 0;
        int seen = 0, lamps = 0;
        for (std::uint64_t i = 0; i < 400; ++i) {
            auto stream = random_stream(test_seed(5), Pass::user, 0, i);
            const Ray ray = primary_ray(
                camera, Vec2{float(i % 20) + 0.5f, float(i / 20) + 0.5f}, 20, 20);
            Counts counts;
            PathLog log;
            auto context = context_of(stream, counts, log);
            (void)radiance(mapper, ray, context);
            // Where a cache is asked that has nothing, rays gather in its place.
            if (indirect != IndirectLight::cache)
                longest = std::max(longest, counts.bounce_rays);
            const auto hit = closest_hit(room, ray);
            REQUIRE(hit);
            const Vertex first = vertex_at(room, ray, *hit);
            seen += first.emits();
            const glm::dvec3 here(first.point.position);
            for (const auto& line : log.lines) {
                if (line.what == "emission") {
                    ++lamps;
                    CHECK(line.path == "EL");
                }
                // The log knows where each term was found, and each vertex.
                if (line.path == "EL" || line.path == "EDL" || line.path == "ED" ||
                    line.path == "ED..DL")
                    CHECK(glm::distance(line.position, here) < 1e-5);
                else
                    CHECK(glm::distance(line.position, here) > 1e-5);
            }
        }
        CAPTURE(int(indirect));
        CHECK(longest >= std::uint64_t(least));
        CHECK(longest <= std::uint64_t(most));
        CHECK(lamps == seen);
        CHECK(seen > 5);
    }
}

TEST_CASE("photon mapping: behind a glossy surface only photons answer for gloss") {
    // A path goes on from a glossy floor, also if a cache has its diffuse light. Where
    // it then meets a glossy ceiling, the general map ends it: photons know where they
    // come from. Irradiance does not, and there the path asks the lamp, and goes on. In
    // a wide lobe many photons count: there they have the indirect light. At a matt
    // ceiling the irradiance points end it, and no further gathering.
    struct Case {
        IndirectLight indirect;
        const char *at_gloss, *at_matt;
        float roughness = 0.3f;
    };
    for (const Case is :
         {Case{IndirectLight::rays, "shadow ray", "shadow ray"},
          Case{IndirectLight::map, "general map", "general map"},
          Case{IndirectLight::gather, "shadow ray", "irradiance points"},
          Case{IndirectLight::cache, "shadow ray", "irradiance points"},
          Case{IndirectLight::gather, "general map", "irradiance points", 0.6f},
          Case{IndirectLight::cache, "general map", "irradiance points", 0.6f}})
        for (const bool matt : {false, true}) {
            Scene<Shapes<Quad>, Materials<Glossy, Lambertian>, Lights<PointLight>> room;
            const auto gloss =
                room.add(Glossy{.reflectance = Rgb{0.9f}, .roughness = is.roughness});
            const auto above = matt ? room.add(Lambertian{}) : gloss;
            room.add(Quad{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}, gloss);
            room.add(Quad{{-9, 1, -9}, {18, 0, 0}, {0, 0, 18}}, above);
            room.add(PointLight{.position{0, 0.5f, 0}, .intensity = Rgb{1}});
            const World world(std::move(room));
            const std::string who = matt ? is.at_matt : is.at_gloss;
            CAPTURE(who);
            const auto settings = distinct(is.indirect, DirectLight::sampled);
            const PhotonMapper mapper(world, settings, abilities<Gathering>);
            int seconds = 0, longer = 0;
            for (std::uint64_t i = 0; i < 50; ++i) {
                auto stream = random_stream(test_seed(6), Pass::user, 0, i);
                Counts counts;
                PathLog log;
                auto context = context_of(stream, counts, log);
                (void)radiance(mapper, Ray{.direction{0.2f, -1, 0.1f}}, context);
                for (const auto& line : log.lines)
                    if (line.what != "vertex" && line.position.y > 0) {
                        if (is.roughness > 0.5f && !matt && line.what == "shadow ray")
                            continue; // for direct light
                        CHECK(line.what == who);
                        ++seconds;
                    }
                longer += counts.bounce_rays > 1;
            }
            CHECK(seconds > 20);
            CHECK((longer > 10) == (who == "shadow ray"));
        }
}

TEST_CASE("photon mapping: a path goes on at gloss that is smaller than the disc") {
    // On a ball, and also on a long rod, most of the disc would lie beside the surface.
    Scene<Shapes<Quad, Sphere, Cylinder>, Materials<Glossy>, Lights<PointLight>> room;
    const Glossy gloss{.reflectance = Rgb{0.9f}, .roughness = 0.6f};
    const auto is = room.add(gloss);
    room.add(Quad{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}}, is);
    room.add(Quad{{-9, 9, -9}, {18, 0, 0}, {0, 0, 18}}, is);
    room.add(Sphere{.center{-1, 0, 0}, .radius = 1e-3f}, is);
    room.add(Sphere{.center{3, 0, 0}, .radius = 2}, is);
    room.add(Cylinder{.base{0, -0.5f, 1}, .radius = 1e-3f}, is);
    room.add(PointLight{.position{0, 5, 0}, .intensity = Rgb{1}});
    const World world(std::move(room));
    const auto settings = distinct(IndirectLight::gather, DirectLight::sampled);
    const PhotonMapper mapper(world, settings, abilities<Gathering>);
    REQUIRE(radius_on_gloss(mapper) > 1e-3f);
    REQUIRE(radius_on_gloss(mapper) < 2);
    const auto ends = [&](const Vec3& direction) {
        auto stream = random_stream(test_seed(1), Pass::user, 0, 0);
        PathState path{.ray = Ray{.direction = direction}};
        const auto vertex = next_vertex(world, path, stream);
        REQUIRE(vertex.has_value());
        return ends_on_gloss(mapper, *vertex, gloss);
    };
    CHECK_FALSE(ends({-1, 0, 0}));
    CHECK_FALSE(ends({0, 0, 1}));
    CHECK(ends({1, 0, 0}));
    CHECK(ends({0, -1, 0})); // at the floor
}

TEST_CASE("photon mapping: what the depth cuts off is counted, what is black is not") {
    // At the last surface that the depth allows: matt, mirror, and black.
    for (const IndirectLight indirect :
         {IndirectLight::rays, IndirectLight::map, IndirectLight::none})
        for (const int kind : {0, 1, 2}) {
            BallRoom room;
            const Quad floor{{-1e3f, -1, -1e3f}, {0, 0, 2e3f}, {2e3f, 0, 0}};
            if (kind == 1)
                room.add(floor, room.add(Mirror{.reflectance = Rgb{0.5f}}));
            else
                room.add(floor,
                         room.add(Lambertian{.albedo = Rgb{kind == 0 ? 1.f : 0.f}}));
            room.add(Quad{{-1e3f, 1, -1e3f}, {2e3f, 0, 0}, {0, 0, 2e3f}},
                     room.add(Lambertian{.albedo = Rgb{0.5f}}));
            room.add(PointLight{.intensity = Rgb{1}});
            const World world(std::move(room));
            for (const int depth : {1, 2}) {
                PhotonMappingSettings settings{.max_depth = depth,
                                               .indirect = indirect};
                settings.general = settings.caustics = {.photons = 100, .threads = 1};
                const PhotonMapper mapper(world, settings);
                auto stream = random_stream(test_seed(6), Pass::user, 0, 0);
                Counts counts;
                auto context = context_of(stream, counts);
                (void)radiance(mapper, Ray{.direction{0, -1, 0}}, context);
                CAPTURE(int(indirect));
                CAPTURE(kind);
                CAPTURE(depth);
                // A ray for direct light alone is not cut; one to a mirror is.
                std::uint64_t bounces = 0, cut = kind == 1 ? 1 : 0;
                if (depth == 2) {
                    // What goes on meets the ceiling, where it is cut, or gathers.
                    const bool rays = indirect != IndirectLight::none;
                    bounces = kind == 1 || (kind == 0 && rays) ? 1 : 0;
                    cut = (kind == 0 && indirect == IndirectLight::rays) ||
                                  (kind == 1 && rays)
                              ? 1
                              : 0;
                }
                CHECK(counts.bounce_rays == bounces);
                CHECK(counts.cut_paths == cut);
            }
        }
}

TEST_CASE("photon mapping: what a red mirror and a green one leave goes no farther") {
    BallRoom room;
    room.add(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
             room.add(Mirror{.reflectance{0, 1, 0}}));
    room.add(Quad{{-1, -1, 1}, {0, 2, 0}, {2, 0, 0}},
             room.add(Mirror{.reflectance{1, 0, 0}}));
    const World world(std::move(room));
    const PhotonMappingSettings settings{.roulette_depth = 100};
    const PhotonMapper mapper(world, settings);
    auto stream = random_stream(test_seed(7), Pass::user, 0, 0);
    Counts counts;
    auto context = context_of(stream, counts);
    (void)radiance(mapper, Ray{.origin{0, 0, 0.5f}, .direction{0, 0, 1}}, context);
    CHECK(counts.bounce_rays == 1);
    CHECK(counts.cut_paths == 0);
}

TEST_CASE("photon mapping: roulette begins at the surface that is named") {
    // In a hall of mirrors that are all but black a path ends where it first may.
    BallRoom room;
    room.add(Sphere{.radius = 1}, room.add(Mirror{.reflectance = Rgb{1e-3f}}));
    const World world(std::move(room));
    for (const int depth : {1, 2, 4}) {
        PhotonMappingSettings settings{.roulette_depth = depth};
        const PhotonMapper mapper(world, settings);
        int later = 0;
        for (std::uint64_t i = 0; i < 50; ++i) {
            auto stream = random_stream(test_seed(3), Pass::user, 0, i);
            Counts counts;
            auto context = context_of(stream, counts);
            (void)radiance(mapper, Ray{.direction{0, 0, 1}}, context);
            later += counts.bounce_rays != std::uint64_t(depth - 1);
        }
        CHECK(later <= 1); // by a chance of one in a thousand each, or less
    }
}

TEST_CASE("photon mapping: by which lobes a path goes on until it is gathered") {
    const ClosedRoom matt = make_room<float>(Ball::lambertian, Lamp::quad, 1);
    for (const auto& [indirect, lobes] :
         {std::pair{IndirectLight::rays, Lobes::all},
          {IndirectLight::map, Lobes::all},
          {IndirectLight::gather, Lobes::all},
          {IndirectLight::photons, Lobes::specular},
          {IndirectLight::none, Lobes::specular},
          {IndirectLight::cache, Lobes::glossy | Lobes::specular}}) {
        const auto settings = distinct(indirect, DirectLight::sampled);
        CHECK(PhotonMapper(matt, settings, abilities<Gathering>).bounces() == lobes);
    }
    // Where no photon says that light comes by an indirect ray, none is sent, but a
    // mirror below the matt part still mirrors: one ray in two.
    BallRoom half;
    half.add(Quad{{-9, -1, -9}, {0, 0, 18}, {18, 0, 0}},
             half.add(Mixture{.color = Rgb{0.5f}, .reflectivity = 0.5f}));
    half.add(PointLight{.position{0, 1, 0}, .intensity = Rgb{1}});
    const World world(std::move(half));
    PhotonMappingSettings settings;
    settings.general = {.photons = 20000, .threads = 1};
    settings.caustics.photons = 0;
    settings.skip.indirect_rays = true;
    const PhotonMapper mapper(world, settings, abilities<Skipping>);
    REQUIRE(mapper.state<Skipping>().verdicts.dark_known);
    for (std::uint64_t i = 0; i < 100; ++i) {
        auto stream = random_stream(test_seed(4), Pass::user, 0, i);
        Counts counts;
        PathLog log;
        auto context = context_of(stream, counts, log);
        (void)radiance(mapper, Ray{.direction{0, -1, 0}}, context);
        CHECK(counts.skipped_bounces == 1);
        CHECK(counts.bounce_rays == 1);
        const auto mirrored =
            std::count_if(log.lines.begin(), log.lines.end(), [](const auto& line) {
                return line.what == "vertex" && line.path == "ES";
            });
        CHECK(mirrored == 1);
    }
}

namespace {

/// A few photons for each map.
PhotonMappingSettings few_photons(IndirectLight indirect = IndirectLight::rays) {
    PhotonMappingSettings settings{.indirect = indirect};
    settings.caustics = {.photons = 2000, .seed = test_seed(4), .threads = 1};
    settings.general = {.photons = 2000, .seed = test_seed(5), .threads = 1};
    return settings;
}

} // namespace

TEST_CASE("photon mapping: an ability that is needed but not listed is refused") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    const auto said = [&](const PhotonMappingSettings& settings, auto listed) {
        return refusal([&] { (void)PhotonMapper(room, settings, listed); });
    };
    const std::string gathering =
        "indirect light by gathering needs an ability that is not listed: "
        "abilities<Gathering> of ljus/render/gathering.hpp.";
    for (const IndirectLight indirect : {IndirectLight::gather, IndirectLight::cache}) {
        const auto settings = few_photons(indirect);
        CHECK(said(settings, abilities<>) == gathering);
        CHECK(said(settings, abilities<Skipping, Budgeting, StratifiedStream>) ==
              gathering);
        CHECK(said(settings, abilities<Gathering>).empty());
        CHECK(said(settings, abilities<StratifiedStream, Gathering>).empty());
    }
    for (const Preset preset : {Preset::draft, Preset::fast})
        CHECK(said(preset_settings(preset, 8, 8), abilities<>) == gathering);

    const std::string skipping = "leaving out needless rays needs an ability that is "
                                 "not listed: abilities<Skipping> "
                                 "of ljus/render/skipping.hpp.";
    for (const SkipRule rule : {SkipRule::any, SkipRule::enough, SkipRule::report}) {
        auto settings = few_photons();
        settings.skip.rule = rule;
        CHECK(said(settings, abilities<Gathering, Budgeting>) == skipping);
        CHECK(said(settings, abilities<Skipping>).empty());
    }
    auto dark = few_photons();
    dark.skip.indirect_rays = true;
    CHECK(said(dark, abilities<>) == skipping);
    CHECK(said(dark, abilities<Skipping>).empty());

    const std::string budgeting =
        "a budget of caustic photons needs an ability that is not listed: "
        "abilities<Budgeting> of ljus/render/budgeting.hpp.";
    for (const CausticBudget budget :
         {CausticBudget::equal, CausticBudget::flux, CausticBudget::area,
          CausticBudget::brightness}) {
        auto settings = few_photons();
        settings.caustic_budget = budget;
        CHECK(said(settings, abilities<Gathering, Skipping>) == budgeting);
        CHECK(said(settings, abilities<Budgeting>).empty());
        settings.caustics.shares = {1.0}; // there is nothing left to find
        CHECK(said(settings, abilities<>).empty());
    }
    for (const IndirectLight indirect : {IndirectLight::rays, IndirectLight::map,
                                         IndirectLight::photons, IndirectLight::none})
        CHECK(said(few_photons(indirect), abilities<>).empty());

    using Bare = PhotonMapper<ClosedRoom>;
    using All = PhotonMapper<ClosedRoom, Gathering, StratifiedStream, Skipping>;
    static_assert(std::is_same_v<Bare::Stream, RandomStream>);
    static_assert(std::is_same_v<All::Stream, StratifiedStream>);
    static_assert(All::has<Gathering> && All::has<Skipping> && !All::has<Budgeting>);
    static_assert(!Bare::has<Gathering> && !Bare::has<Skipping>);
}

TEST_CASE("photon mapping: an ability that nobody asks for changes no byte") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 2);
    const Camera camera = room_camera<float>();
    const RenderSettings picture{.width = 12, .height = 9, .samples = 2, .threads = 1};
    for (const IndirectLight indirect : {IndirectLight::rays, IndirectLight::map,
                                         IndirectLight::photons, IndirectLight::none}) {
        const PhotonMapper bare(room, few_photons(indirect));
        PhotonMapper able(room, few_photons(indirect),
                          abilities<Gathering, Skipping, Budgeting>);
        able.fill_cache(camera, picture); // which is not asked for, either
        CHECK(able.state<Gathering>().points.empty());
        CHECK(able.state<Gathering>().cache.empty());
        CHECK(able.state<Skipping>().verdicts.empty());
        const auto one = render(bare, camera, picture);
        const auto other = render(able, camera, picture);
        CHECK(one.image.pixels == other.image.pixels);
        CHECK(one.counts.rays() == other.counts.rays());
        CHECK(one.counts.map_photons == other.counts.map_photons);
    }
}

TEST_CASE("photon mapping: a mapper has the settings that it has chosen") {
    BallRoom open;
    add_walls(open);
    add_ball(open, Ball::glass);
    open.add(Sphere{.center{-0.5f, 0.3f, 0}, .radius = 0.2f}, open.add(Mirror{}));
    add_lamps(open, Lamp::quad, 1);
    const World room(std::move(open));
    PhotonMappingSettings settings = few_photons(IndirectLight::photons);
    settings.caustic_budget = CausticBudget::flux;
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    const PhotonMapper mapper(room, settings, abilities<Budgeting>);
    CHECK(&mapper.world() == &room);
    const PhotonMappingSettings& chosen = mapper.settings();
    CHECK(chosen.caustics_estimate.radius ==
          float(typical_radius(mapper.maps().caustics, 32)));
    CHECK(chosen.general_estimate.radius ==
          float(typical_radius(mapper.maps().general, 64)));
    CHECK(chosen.caustics_estimate.radius > 0);
    CHECK(chosen.general_estimate.radius > 0);
    CHECK(chosen.caustics.shares == caustic_shares(room, settings));
    REQUIRE(chosen.caustics.shares.size() == 2);
    CHECK(chosen.caustics.shares[0] + chosen.caustics.shares[1] == doctest::Approx(1));
    CHECK(mapper.passes().caustics_map);
    CHECK(mapper.passes().general_map);
    CHECK_FALSE(mapper.passes().indirect_rays);
    // What is chosen makes the same mapper again.
    const PhotonMapper again(room, chosen);
    CHECK(again.maps().caustics.records.size() ==
          mapper.maps().caustics.records.size());
    for (std::size_t i = 0; i < again.maps().caustics.records.size(); ++i)
        REQUIRE(again.maps().caustics.records[i].flux ==
                mapper.maps().caustics.records[i].flux);
    // Who asks for no caustics map gets no shares, and no pilot has run.
    settings.caustics.photons = 0;
    CHECK(PhotonMapper(room, settings, abilities<Budgeting>)
              .settings()
              .caustics.shares.empty());
}

TEST_CASE("photon mapping: a chosen radius that is out of range is refused") {
    const auto made = [](double size) {
        Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>>> scene;
        const auto grey = scene.add(LambertianT<double>{});
        scene.add(QuadT<double>{{-size, 0, size}, {2 * size, 0, 0}, {0, 0, -2 * size}},
                  grey);
        scene.add(
            QuadT<double>{{-size, size, -size}, {2 * size, 0, 0}, {0, 0, 2 * size}},
            grey, RgbT<double>{1.0});
        const World room(std::move(scene));
        PhotonMappingSettings settings{.indirect = IndirectLight::map};
        settings.general.photons = 2000;
        settings.general_estimate.radius = 0;
        return double(PhotonMapper(room, settings).settings().general_estimate.radius);
    };
    const double radius = made(1);
    CHECK(made(1e-14) == doctest::Approx(1e-14 * radius).epsilon(1e-5));
    CHECK(refusal([&] { (void)made(1e-18); }).find("general_estimate.radius is ") == 0);
}

TEST_CASE("photon mapping: caustics photons that were traced elsewhere") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    auto settings = few_photons(IndirectLight::photons);
    settings.caustics_estimate.radius = 0; // chosen from the photons
    const PhotonMapper own(room, settings);
    REQUIRE_FALSE(own.maps().caustics.empty());

    auto none = settings;
    none.caustics.photons = 0;
    PhotonMapper taken(room, none);
    taken.set_caustics(own.maps().caustics);
    CHECK(taken.settings().caustics_estimate.radius ==
          own.settings().caustics_estimate.radius);
    const Camera camera = look_at({.position{0, 0, 2}, .target{0, 0, 0}});
    const RenderSettings picture{.width = 12, .height = 12, .samples = 2, .threads = 1};
    CHECK(render(taken, camera, picture).image.pixels ==
          render(own, camera, picture).image.pixels);

    PhotonMapper twice(room, settings);
    CHECK(refusal([&] {
              twice.set_caustics(own.maps().caustics);
          }).starts_with("caustics.photons is 2000"));
    CHECK_FALSE(twice.maps().caustics.empty());
    none.indirect = IndirectLight::gather;
    PhotonMapper gathered(room, none, abilities<Gathering>);
    CHECK(refusal([&] {
              gathered.set_caustics(own.maps().caustics);
          }).starts_with("The irradiance was already gathered"));
}

TEST_CASE("photon mapping: a caustic of few photons is said to be blurred") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    PhotonMappingSettings settings = few_photons(IndirectLight::rays);
    const auto blurred = [&](long long photons, float radius) {
        settings.caustics.photons = photons;
        settings.caustics_estimate.radius = radius;
        const PhotonMapper mapper(room, settings);
        const bool said =
            mapper.maps().remarks.find("the light of caustics is blurred "
                                       "over a radius of ") != std::string::npos;
        CHECK(said == (radius == 0 && mapper.maps().caustics.records.size() < 256));
        return said;
    };
    CHECK(blurred(100, 0));
    CHECK_FALSE(blurred(100, 0.1f)); // a radius of one's own
    CHECK_FALSE(blurred(5000, 0));
}

TEST_CASE("photon mapping: a radius in another unit than the scene's is remarked on") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 1);
    PhotonMappingSettings settings = few_photons(IndirectLight::photons);
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    const PhotonMapper chosen(room, settings);
    CHECK(chosen.maps().remarks.find(".radius is") == std::string::npos);
    for (const float scale : {1e-3f, 0.02f, 0.2f, 2.0f, 1e3f}) {
        CAPTURE(scale);
        settings.caustics_estimate.radius =
            scale * chosen.settings().caustics_estimate.radius;
        settings.general_estimate.radius =
            scale * chosen.settings().general_estimate.radius;
        const std::string remarks = PhotonMapper(room, settings).maps().remarks;
        for (const char* name :
             {"caustics_estimate.radius is", "general_estimate.radius is"})
            CHECK((remarks.find(name) != std::string::npos) ==
                  (scale < 0.1f || scale > 10));
        CHECK((remarks.find("photons: most of their light is missed; 0 chooses") !=
               std::string::npos) == (scale < 0.1f));
        CHECK((remarks.find("photons: their light is blurred away; 0 chooses") !=
               std::string::npos) == (scale > 10));
    }
    // Nobody asks the general map where rays carry the light.
    settings.indirect = IndirectLight::rays;
    CHECK(PhotonMapper(room, settings).maps().remarks.find("general_estimate") ==
          std::string::npos);
}

TEST_CASE("photon mapping: what the edges of a small object lose") {
    constexpr int all = 4096; // photons on each surface of the large ones
    using Plates = Scene<Shapes<Quad, Sphere>, Materials<Lambertian>>;
    const auto matt = [](Plates& scene) {
        return scene.add(Lambertian{.albedo = Rgb{0.5f}});
    };
    std::vector<Photon> photons;
    const auto land = [&](const Vec3& place, const Vec3& normal) {
        photons.push_back({.position = place,
                           .direction = -normal,
                           .flux = Rgb{1},
                           .kind = PhotonKind::indirect,
                           .normal = small_normal(normal)});
    };
    auto stream = random_stream(test_seed(9), Pass::user, 0, 0);
    const auto cover = [&](const Quad& quad, int count) {
        for (int i = 0; i < count; ++i) {
            const float u = next_1d<float>(stream), v = next_1d<float>(stream);
            land(quad.corner + u * quad.edge_u + v * quad.edge_v, {0, 1, 0});
        }
    };
    const auto lost = [&](Plates&& scene, float radius,
                          PhotonKinds kinds = light_kinds) {
        const World world(std::move(scene));
        const PhotonMap map = make_photon_map(photons);
        photons.clear();
        return edge_loss(world, map, DensityEstimateSettings{.radius = radius}, kinds,
                         test_seed(10));
    };
    const Quad square{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
    // Of the kernel's disc (1 - |x|)(1 - |y|) lies on a unit square in the mean, where
    // |x| is 16/(15 pi) r in the mean, and |x y| is r^2/(3 pi). Bounds are 5 standard
    // errors of 16384 places: once in 10^6.
    for (const float r : {0.1f, 0.3f, 0.9f}) {
        CAPTURE(r);
        const double pi = std::numbers::pi, x = 16 / (15 * pi) * double(r);
        const double expected = 2 * x - double(r) * double(r) / (3 * pi);
        Plates scene;
        scene.add(square, matt(scene));
        cover(square, all);
        CHECK(lost(std::move(scene), r) == doctest::Approx(expected).epsilon(0.06));
    }
    // The object that loses most is told, here the smaller one of two.
    Plates two;
    two.add(square, matt(two));
    const Quad small{{2, 0, 0}, {0, 0, 0.25f}, {0.25f, 0, 0}};
    two.add(small, matt(two));
    cover(square, all - 400);
    cover(small, 400);
    CHECK(lost(std::move(two), 0.1f) > 0.22); // 0.254 of the small one
    // Objects of few photons are taken together; light goes on across a seam; on a ball
    // of the radius or more nothing is lost; other kinds of photons do not count.
    Plates many;
    for (int i = 0; i < 10; ++i) {
        const Quad tile{{float(i), 0, 0}, {0, 0, 0.1f}, {0.1f, 0, 0}};
        many.add(tile, matt(many));
        cover(tile, 10);
    }
    CHECK(lost(std::move(many), 0.1f) > 0.4);
    Plates seam;
    for (int i = 0; i < 20; ++i)
        for (int j = 0; j < 20; ++j)
            seam.add(
                Quad{{0.5f * float(i), 0, 0.5f * float(j)}, {0, 0, 0.5f}, {0.5f, 0, 0}},
                matt(seam));
    cover({{4.5f, 0, 4.5f}, {0, 0, 1}, {1, 0, 0}}, all);
    CHECK(lost(std::move(seam), 0.4f) == doctest::Approx(0).epsilon(1e-5));
    for (const float radius : {0.5f, 1.0f}) {
        Plates ball;
        ball.add(Sphere{{0, 0, 0}, 1}, matt(ball));
        for (int i = 0; i < all; ++i) {
            const Vec3 n = sample_uniform_sphere(next_2d<float>(stream));
            land(n, n);
        }
        CHECK(std::abs(lost(std::move(ball), radius)) < 0.05);
    }
    Plates dark;
    dark.add(square, matt(dark));
    cover(square, all);
    CHECK(lost(std::move(dark), 0.9f, one_kind(PhotonKind::direct)) == 0);
    // A plate at 45 degrees, 0.4 above the line's start. Along the plate's normal the
    // photon is 0.1 or 0.9 over the root of 2 away, and the limit is 0.5.
    for (const float slope : {-1.0f, 1.0f}) {
        Plates tilted;
        const auto grey = matt(tilted);
        tilted.add(Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, grey);
        tilted.add(
            Quad{{0.4f, 0.4f + 0.1f * slope, 1}, {0.2f, -0.2f * slope, 0}, {0, 0, -2}},
            grey);
        const World world(std::move(tilted));
        const Ray down{.origin{0, 1, 0}, .direction{0, -1, 0}};
        const auto photon = vertex_at(world, down, *closest_hit(world, down)).point;
        const DensityEstimateSettings gather{.radius = 1, .kernel = Kernel::box};
        CHECK(detail::found_along(world, photon, Vec3{0.5f, 0, 0}, gather) ==
              doctest::Approx(slope < 0 ? 1 + std::sqrt(2.0) : 1));
    }
}

TEST_CASE("photon mapping: light that small objects lose is said") {
    const auto remarks = [](float size, const PhotonMappingSettings& settings) {
        BallRoomT<float> room;
        add_walls(room, 0.7f);
        const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
        room.add(Quad{{-size / 2, -0.5f, -size / 2}, {0, 0, size}, {size, 0, 0}},
                 white);
        room.add(Quad{{-0.2f, 0.9f, -0.2f}, {0.4f, 0, 0}, {0, 0, 0.4f}}, white, Rgb{5});
        const World world(std::move(room));
        return mapper_remarks(PhotonMapper(world, settings));
    };
    const auto said = [&](float size, const PhotonMappingSettings& settings) {
        return remarks(size, settings).find("its edges lose about ") !=
               std::string::npos;
    };
    PhotonMappingSettings settings{.indirect = IndirectLight::photons};
    settings.general = {.photons = 20000, .seed = test_seed(11), .threads = 1};
    settings.general_estimate.radius = 0.3f;
    // 0.37 with a standard error of 0.03, and 0.11 as the walls; 0.2 is the limit.
    CHECK(said(0.5f, settings));
    CHECK_FALSE(said(1.8f, settings));
    settings.keep_general_map = true;
    CHECK(said(0.5f, settings));
    settings.indirect = IndirectLight::rays;
    CHECK_FALSE(said(0.5f, settings)); // nobody asks the map

    // A plate above a mirror: of the area of a disc of radius 0.1 it is at most 1/pi,
    // of one of radius 0.005 nearly all.
    for (const auto& [radius, lost] : {std::pair{0.1f, true}, {0.005f, false}}) {
        BallRoomT<float> room;
        const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
        room.add(Quad{{-0.05f, 0, -0.05f}, {0, 0, 0.1f}, {0.1f, 0, 0}}, white);
        room.add(Quad{{-1, -1, -1}, {2, 0, 0}, {0, 0, 2}}, room.add(Mirror{}));
        room.add(Quad{{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}}, white, Rgb{1});
        const World world(std::move(room));
        PhotonMappingSettings caustic;
        caustic.caustics = {.photons = 200000, .seed = test_seed(12), .threads = 1};
        caustic.caustics_estimate.radius = radius;
        const std::string lines = mapper_remarks(PhotonMapper(world, caustic));
        CHECK((lines.find("% of its caustics") != std::string::npos) == lost);
    }

    // Beside nearly specular gloss, estimates are divided by the part of the disc on
    // the plate: nothing is lost.
    Scene<Shapes<Quad>, Materials<Lambertian, Glossy>> room;
    const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
    room.add(Quad{{-0.05f, 0, -0.05f}, {0, 0, 0.1f}, {0.1f, 0, 0}}, white);
    room.add(Quad{{-1, -1, -1}, {2, 0, 0}, {0, 0, 2}}, room.add(Glossy{}));
    room.add(Quad{{-1, 1, -1}, {2, 0, 0}, {0, 0, 2}}, white, Rgb{1});
    const World world(std::move(room));
    PhotonMappingSettings gathered{.indirect = IndirectLight::gather};
    gathered.caustics = {.photons = 20000, .seed = test_seed(13), .threads = 1};
    gathered.caustics_estimate.radius = 0.1f;
    const PhotonMapper mapper(world, gathered, abilities<Gathering>);
    REQUIRE(mapper.passes().gloss_as_mirrors);
    CHECK(mapper_remarks(mapper).find("% of its caustics") == std::string::npos);
}

namespace {

/// A groove of gloss in light of radiance 1 from all around, and a ray into it.
auto glossy_groove(float reflectance, float roughness) {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glossy>> room;
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    room.add(Sphere{.radius = 100}, black, Rgb{1}, true);
    const auto gloss =
        room.add(Glossy{.reflectance = Rgb{reflectance}, .roughness = roughness});
    room.add(Quad{{0, 0, -1}, {1, 1, 0}, {0, 0, 2}}, gloss);
    room.add(Quad{{0, 0, -1}, {0, 0, 2}, {-1, 1, 0}}, gloss);
    return World(std::move(room));
}
constexpr Ray into_groove{.origin{0.2f, 1, 0}, .direction{0, -1, 0}};

} // namespace

TEST_CASE("photon mapping: after gloss a path finds the lamps by its next ray") {
    // In a groove. Shadow rays alone find the lamp as well.
    // 4 comparisons of 4.5 standard errors: one false alarm in 37 000 seeds.
    for (const float roughness : {0.3f, 0.6f}) {
        const World world = glossy_groove(0.9f, roughness);
        const auto mean_of = [&](DirectLight direct, IndirectLight indirect) {
            PhotonMappingSettings settings{
                .shadow_rays = 3, .direct = direct, .indirect = indirect};
            settings.caustics.photons = settings.general.photons = 0;
            const PhotonMapper mapper(world, settings, abilities<Gathering>);
            return mean_radiance(mapper, 20000, 1 + std::uint64_t(direct),
                                 [&](auto&) { return into_groove; });
        };
        const Mean right = mean_of(DirectLight::sampled, IndirectLight::rays);
        CAPTURE(roughness);
        CHECK(right.mean > 0.5); // the rest is lost between facets, or absorbed
        for (const IndirectLight indirect : {IndirectLight::rays, IndirectLight::cache})
            CHECK(std::abs(apart(mean_of(DirectLight::mis, indirect), right)) < 4.5);
    }
}

TEST_CASE("photon mapping: after dark gloss, roulette makes no path bright") {
    // Narrow lobes at a right angle turn the ray back, at 45 degrees to both sides. The
    // mean is within 1 % and 4.5 standard errors: one false alarm in 140 000 seeds.
    const World world = glossy_groove(0.1f, 0.1f);
    const PhotonMapper mapper(
        world, {.roulette_depth = 1, .shadow_rays = 3, .direct = DirectLight::mis});
    Mean mean;
    Counts counts;
    float brightest = 0;
    for (std::uint64_t i = 0; i < 20000; ++i) {
        auto stream = random_stream(test_seed(8), Pass::user, 0, i);
        auto context = context_of(stream, counts);
        const float found = radiance(mapper, into_groove, context).x;
        mean.add(double(found));
        brightest = std::max(brightest, found);
    }
    const double once = 0.1 + 0.9 * std::pow(1 - std::sqrt(0.5), 5);
    CHECK(std::abs(mean.mean / (once * once) - 1) <
          0.01 + 4.5 * mean.error() / (once * once));
    CHECK(brightest < 0.4f); // of a survivor's throughput of a quarter
    CHECK(counts.shadow_rays <= 20000 + counts.bounce_rays); // one at each surface
}
