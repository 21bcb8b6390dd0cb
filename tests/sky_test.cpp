/// \file sky_test.cpp
/// \brief A light of a test's own that fills the sky: every renderer sees it, once.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million.

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ljus/lights/spot_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/distributed.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/plain_path_tracing.hpp"
#include "ljus/render/whitted.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"

/// A sky of one radiance, all that there is of it.
namespace weather {
using ljus::Rgb, ljus::Vec2, ljus::Vec3;

/// As it is added.
struct Sky {
    using Scalar = float;
    Rgb radiance{1};
};
/// As it is within a scene.
struct SkyInScene {
    using Scalar = float;
    Rgb radiance{0};
    ljus::Sphere around{};
};
constexpr float all_around = 4 * std::numbers::pi_v<float>;

inline void check(const Sky& sky) {
    ljus::require_radiance("sky.radiance", sky.radiance);
}
inline SkyInScene in_scene(const Sky& sky, const ljus::Sphere& around) {
    return {sky.radiance, around};
}
/// From each direction E = L d omega, through the disc of the sphere around the scene.
inline Rgb power(const SkyInScene& sky) {
    const float r = sky.around.radius;
    return all_around * std::numbers::pi_v<float> * r * r * sky.radiance;
}
inline std::optional<ljus::LightSampleT<float>>
sample_light(const SkyInScene& sky, const Vec3& from, const Vec2& u, float) {
    const Vec3 wi = ljus::sample_uniform_sphere(u);
    const float beyond = glm::distance(from, sky.around.center) + sky.around.radius;
    return ljus::LightSampleT<float>{
        .point{.position = from + 2 * beyond * wi, .normal = -wi},
        .wi = wi,
        .weight = all_around * sky.radiance,
        .pdf = 1 / all_around};
}
inline ljus::ArrivalT<float> sample_arrival(const SkyInScene& sky, const Vec2& u) {
    return {ljus::sample_uniform_sphere(u), all_around * sky.radiance};
}
inline Rgb escaped_radiance(const SkyInScene& sky, const Vec3&) {
    return sky.radiance;
}
inline float pdf_escaped(const SkyInScene&, const Vec3&) {
    return 1 / all_around;
}

} // namespace weather

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;
using ljus_test::mean_radiance;
using weather::Sky;

static_assert(LightSource<Sky> && FarLight<weather::SkyInScene> &&
              FillsSky<weather::SkyInScene> && !NearLight<weather::SkyInScene>);

namespace {

constexpr double pi = std::numbers::pi;
constexpr float rho = 0.6f;

/// One ball below a sky of radiance 1.
template <Material M>
auto ball_of(const M& material) {
    return World(make_scene(placed(Sphere{}, material), Sky{}));
}

/// Two balls of one albedo that see each other, below a sky of radiance 1.
auto two_balls(float albedo) {
    const Lambertian matt{.albedo = Rgb{albedo}};
    return World(make_scene(placed(Sphere{.center{-1, 0, 0}}, matt),
                            placed(Sphere{.center{1, 0, 0}}, matt), Sky{}));
}

/// Meets a ball at the origin, wherever; or between two of them.
Ray at_the_ball(RandomStream& stream) {
    const Vec3 from = 5.0f * sample_uniform_sphere(next_2d<float>(stream));
    const Vec3 to = 0.9f * sample_uniform_sphere(next_2d<float>(stream));
    return {.origin = from, .direction = glm::normalize(to - from)};
}
Ray between_balls(RandomStream&) {
    return {.origin{-0.2f, 5, 0}, .direction{0, -1, 0}};
}

/// The mean of a renderer that draws from a StratifiedStream.
template <typename Renderer>
Mean stratified_mean(const Renderer& renderer, int rays) {
    const auto pattern = make_pattern(Sampling::random, rays);
    Mean mean;
    Counts counts;
    for (int i = 0; i < rays; ++i) {
        auto place =
            random_stream(ljus_test::test_seed(2), Pass::user, 0, std::uint64_t(i));
        StratifiedStream stream;
        start_ray(stream, ljus_test::test_seed(3), 0, i, pattern);
        auto context = context_of(stream, counts);
        mean.add(double(radiance(renderer, at_the_ball(place), context).x));
    }
    return mean;
}

} // namespace

TEST_CASE("sky: a world knows it as a light that paths can meet") {
    const auto world = ball_of(Lambertian{});
    REQUIRE(world.light_count() == 1);
    CHECK(world.can_be_met(0));
    const double r = 1.001 * std::sqrt(3.0); // around the box of the ball
    CHECK(double(world.powers()[0].x) ==
          doctest::Approx(4 * pi * pi * r * r).epsilon(1e-5));
    CHECK(sky_radiance(world, Vec3{0, 1, 0}) == Rgb{1});
    CHECK(sky_of(world, 0, Vec3{0, 1, 0}).pdf == doctest::Approx(1 / (4 * pi)));
}

TEST_CASE("sky: in it each way of path tracing finds a ball's albedo") {
    const auto world = ball_of(Lambertian{.albedo = Rgb{rho}});
    const auto seen = [&](const PathTracingSettings& settings, std::uint64_t seed) {
        return mean_radiance(PathTracer(world, settings), 20000, seed, at_the_ball);
    };
    const Mean by_shadow_rays = seen({.heuristic = MisHeuristic::shadow_rays}, 1);
    const Mean balance = seen({.heuristic = MisHeuristic::balance}, 2);
    const Mean power = seen({.heuristic = MisHeuristic::power}, 3);
    const Mean by_paths = seen({.sample_lights = false}, 4);
    CHECK(by_shadow_rays.agrees_with(double(rho)));
    CHECK(balance.agrees_with(double(rho)));
    CHECK(power.agrees_with(double(rho)));
    CHECK(by_paths.mean == doctest::Approx(double(rho)).epsilon(1e-6));
    CHECK(by_paths.error() < 1e-6); // each path brings all of it
    CHECK(balance.error() < by_shadow_rays.error());
    // White balls that light each other are lost in the sky.
    const auto white = two_balls(1);
    const PathTracer patient(white, {.sample_lights = false});
    CHECK(mean_radiance(patient, 2000, 5, between_balls).mean ==
          doctest::Approx(1).epsilon(1e-5));
    CHECK(mean_radiance(PathTracer(white), 20000, 6, between_balls).agrees_with(1));
    CHECK(mean_radiance(PlainPathTracer(world), 20000, 7, at_the_ball)
              .agrees_with(double(rho)));
    CHECK(
        mean_radiance(PlainPathTracer(white), 20000, 8, between_balls).agrees_with(1));
}

TEST_CASE("sky: it is seen past a ball, in a mirror and through glass") {
    const Ray past{.origin{0, 0, 5}, .direction{0, 1, 0}};
    const Ray at{.origin{0.3f, 0.2f, 5}, .direction{0, 0, -1}};
    const auto check_all = [&](const auto& world, const Ray& ray, double right) {
        const auto seen = [&](const auto& renderer) {
            Mean mean;
            Counts counts;
            for (std::uint64_t i = 0; i < 200; ++i) {
                typename std::remove_cvref_t<decltype(renderer)>::Stream stream{};
                start_ray(stream, ljus_test::test_seed(4), i, 0,
                          make_pattern(Sampling::random, 1));
                auto context = context_of(stream, counts);
                mean.add(double(radiance(renderer, ray, context).x));
            }
            return mean;
        };
        const PhotonMappingSettings none{.caustics{.photons = 0}};
        CHECK(seen(PathTracer(world)).agrees_with(right, 1e-5));
        CHECK(seen(PlainPathTracer(world)).agrees_with(right, 1e-5));
        CHECK(
            seen(DistributedTracer(world, {.max_depth = 50})).agrees_with(right, 1e-5));
        // Whitted's tree ends at its depth: a little remains within the glass.
        CHECK(seen(WhittedTracer(world, {.max_depth = 16})).agrees_with(right, 1e-4));
        CHECK(seen(PhotonMapper(world, none)).agrees_with(right, 1e-5));
    };
    check_all(ball_of(Lambertian{}), past, 1);
    check_all(ball_of(Mirror{.reflectance = Rgb{0.75f}}), at, 0.75);
    check_all(ball_of(Glass{.index = 1.5f}), at, 1);
}

TEST_CASE("sky: Whitted asks one direction of it, or none; distributed rays any") {
    const auto world = ball_of(Lambertian{.albedo = Rgb{rho}});
    const Vec3 asked = sample_uniform_sphere(Vec2{0.5f});
    Counts counts;
    RandomStream stream;
    auto context = context_of(stream, counts);
    for (const Vec3 normal : {asked, glm::normalize(asked + Vec3{0.3f, 0.2f, 0.5f}),
                              glm::normalize(Vec3{0.1f, 0.2f, 0} - asked)}) {
        const Ray ray{.origin = 3.0f * normal, .direction = -normal};
        // rho / pi times 4 pi L times the cosine.
        const double right = 4 * double(rho) * std::max(0.0f, glm::dot(normal, asked));
        CHECK(double(radiance(WhittedTracer(world), ray, context).x) ==
              doctest::Approx(right).epsilon(1e-4));
        CHECK(is_black(radiance(WhittedTracer(world, {.lamps = false}), ray, context)));
    }
    const DistributedTracer tracer(world);
    CHECK(stratified_mean(tracer, 20000).agrees_with(double(rho)));
    // In gloss the reflected ray sees it, and no shadow ray sees it again.
    const auto satin = ball_of(Glossy{.reflectance = Rgb{0.8f}, .roughness = 0.4f});
    const Mean gloss = stratified_mean(DistributedTracer(satin), 20000);
    const Mean path = mean_radiance(PathTracer(satin), 40000, 9, at_the_ball);
    CHECK(std::abs(apart(gloss, path)) < 5);
    CHECK(path.error() < 0.01 * path.mean);
}

TEST_CASE("sky: its direct light is found in each of the ways") {
    const auto world = ball_of(Lambertian{});
    const Lambertian matt{.albedo = Rgb{rho}};
    const Ray down{.origin{0, 3, 0}, .direction{0, -1, 0}};
    const Vertex top = vertex_at(world, down, *closest_hit(world, down));
    for (const DirectLight how :
         {DirectLight::sampled, DirectLight::mis, DirectLight::analytic})
        for (const int rays : {1, 4}) {
            Mean mean;
            Counts counts;
            for (std::uint64_t i = 0; i < 10000; ++i) {
                auto stream = random_stream(ljus_test::test_seed(5), Pass::user, 0, i);
                start_bounce(stream, 1);
                auto context = context_of(stream, counts);
                mean.add(double(
                    sample_all_lights(world, top, matt, {how, rays}, context).x));
            }
            CAPTURE(int(how));
            CAPTURE(rays);
            CHECK(mean.agrees_with(double(rho)));
        }
}

TEST_CASE("sky: the photon mapper finds what paths find, the indirect light as well") {
    const auto world = two_balls(rho);
    const PhotonMapper mapper(world, {.caustics{.photons = 0}});
    const Mean mapped = mean_radiance(mapper, 40000, 10, between_balls);
    const Mean path = mean_radiance(PathTracer(world), 40000, 11, between_balls);
    CHECK(std::abs(apart(mapped, path)) < 5);
    CHECK(path.error() < 0.01 * path.mean);
    CHECK(path.mean > 0.3);
    CHECK(path.mean < double(rho)); // below the open sky it would be the albedo
}

TEST_CASE("sky: its photons bring pi L to an open floor, and glass its share") {
    const auto floor = World(make_scene(
        placed(Quad{{-2, -2, 0}, {4, 0, 0}, {0, 4, 0}}, Lambertian{.albedo = Rgb{0}}),
        Sky{.radiance = Rgb{3}}));
    Mean above, below, patch;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        const auto traced = trace_photons(floor, MapType::general,
                                          {.photons = 20000,
                                           .seed = ljus_test::test_seed(seed),
                                           .shadow_photons = false,
                                           .threads = 1});
        CHECK(traced.audit.emitted.x ==
              doctest::Approx(double(floor.powers()[0].x)).epsilon(1e-4));
        double sum[2] = {}, in_corner = 0;
        for (const Photon& photon : traced.photons) {
            sum[photon.direction.z > 0] += double(photon.flux.x);
            if (photon.direction.z < 0 && photon.position.x > 1 &&
                photon.position.y > 1)
                in_corner += double(photon.flux.x);
        }
        above.add(sum[0]);
        below.add(sum[1]);
        patch.add(in_corner);
    }
    const double e = 3 * pi; // of radiance 3
    CHECK(above.agrees_with(16 * e));
    CHECK(below.agrees_with(16 * e));
    CHECK(patch.agrees_with(e));
    CHECK(above.error() < 0.01 * above.mean);
    CHECK(patch.error() < 0.05 * patch.mean);

    // Aimed at a ball of glass, whose shadow is pi r^2 from all sides.
    const auto glass = World(
        make_scene(placed(Sphere{.center{0, 0, 1}, .radius = 0.5f}, Glass{}),
                   placed(Sphere{.center{4, 0, 0}, .radius = 2}, Lambertian{}), Sky{}));
    const auto targets = specular_objects(glass);
    REQUIRE(targets.size() == 1);
    Mean aimed, blind;
    for (std::uint64_t i = 0; i < 100000; ++i) {
        const auto reaches = [&](const Ray& ray) {
            const auto hit = closest_hit(glass, ray);
            return hit && hit->object == targets[0];
        };
        auto stream = random_stream(ljus_test::test_seed(6), Pass::user, 0, i);
        const auto photon = aim(glass, glass.light_choice(), targets, stream);
        REQUIRE(photon);
        REQUIRE(double(photon->photon.flux.x) ==
                doctest::Approx(4 * pi * pi * 0.25).epsilon(1e-5));
        aimed.add(reaches(photon->photon.ray) ? double(photon->photon.flux.x) : 0);
        auto other = random_stream(ljus_test::test_seed(7), Pass::user, 0, i);
        const auto sent = emit(glass, glass.light_choice(), other);
        blind.add(reaches(sent.ray) ? double(sent.flux.x) : 0);
    }
    CHECK(std::abs(apart(aimed, blind)) < 5);
    CHECK(aimed.mean < 4 * pi * pi * 0.25 * 0.95); // the other ball stands in the way
    CHECK(aimed.error() < 0.01 * aimed.mean);
}

TEST_CASE("sky: behind a pane it has the colour of the pane, and photons keep it") {
    // Straight on r = 0.04. A pane with the tint a passes T = (1 - r)^2 a /
    // (1 - r^2 a^2) and returns r (1 + a T); both lead to the sky.
    const ThinGlass pane{.tint{1, 0.5f, 0.1f}};
    const Quad quad{.corner{-1, -1, 0}, .edge_u{2, 0, 0}, .edge_v{0, 2, 0}};
    const World world(make_scene(placed(quad, pane), Sky{}));
    const World lit(make_scene(placed(quad, pane), SpotLight{.position{0, 0, 5},
                                                             .direction{0, 0, -1},
                                                             .inner_degrees = 0.1f,
                                                             .outer_degrees = 0.1f}));
    const auto audit = trace_photons(lit, MapType::general,
                                     {.photons = 100000, .shadow_photons = false})
                           .audit;
    const auto straight_on = [](RandomStream&) {
        return Ray{.origin{0.1f, 0.2f, 5}, .direction{0, 0, -1}};
    };
    for (int c = 0; c < 3; ++c) {
        CAPTURE(c);
        const double a = double(pane.tint[c]), r = 0.04;
        const double through = (1 - r) * (1 - r) * a / (1 - r * r * a * a);
        const double right = through + r * (1 + a * through);
        const auto finds = [&](const auto& renderer) {
            const Mean seen = mean_radiance(renderer, 20000, 1, straight_on, c);
            CHECK(std::abs(apart(seen, right)) < 5);
            CHECK(seen.error() < 0.01);
        };
        finds(PathTracer(world));
        finds(PhotonMapper(world));
        finds(DistributedTracer(world));
        finds(WhittedTracer(world));
        CHECK(audit.escaped[c] / audit.emitted[c] ==
              doctest::Approx(right).epsilon(0.02));
        CHECK((audit.absorbed[c] + audit.roulette[c]) / audit.emitted[c] ==
              doctest::Approx(1 - right).epsilon(0.02));
    }
}
