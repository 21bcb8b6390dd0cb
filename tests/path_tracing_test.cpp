// Closed forms of the rendering equation, and the tracer against itself with parts of
// it switched off. Of some 150 means it is asked how many standard errors they are off;
// the limit is one that all of them together exceed once in 1000 runs.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <initializer_list>
#include <limits>
#include <numbers>

#include "ljus/geometry/moving.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/plain_path_tracing.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"
#include "support/rooms.hpp"
#include "support/seed.hpp"
#include "support/slabs.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;
using ljus_test::mean_radiance;
using ljus_test::mean_radiances;

namespace {

const double limit = ljus_test::limit_of(150); ///< In standard errors.

constexpr double pi = std::numbers::pi;
constexpr int no_roulette = 1000000;

template <typename T>
using Furnace =
    Scene<Shapes<SphereT<T>>, Materials<LambertianT<T>, GlassT<T>, MirrorT<T>>>;

/// The inside of a sphere of radius 2 that emits radiance 1 and reflects an albedo.
template <typename T>
Furnace<T> furnace(T albedo) {
    Furnace<T> scene;
    const auto wall = scene.add(LambertianT<T>{.albedo = RgbT<T>{albedo}});
    scene.add(SphereT<T>{.center{T(0.5), T(-1), T(0.25)}, .radius = T(2)}, wall,
              RgbT<T>{T(1)}, true);
    return scene;
}

/// From anywhere within a unit cube, in any direction.
template <typename T>
RayT<T> any_ray(RandomStream& stream) {
    const Vec3T<T> origin = next_3d<T>(stream) - Vec3T<T>{T(0.5)};
    return {.origin = origin, .direction = sample_uniform_sphere(next_2d<T>(stream))};
}

} // namespace

TEST_CASE_TEMPLATE("path tracing: in a furnace every path of a given length brings the "
                   "partial geometric sum, with and without shadow rays",
                   T, float, double) {
    // From within a sphere a point of its area and a direction by the cosine have the
    // same density, so that neither they nor their mixture have any variance.
    for (const double albedo : {0.1, 0.5, 0.9})
        for (const int depth : {1, 2, 3, 7, 30})
            for (const bool shadow_rays : {true, false}) {
                const World world(furnace<T>(T(albedo)));
                const PathTracer tracer(world, {.max_depth = depth,
                                                .roulette_depth = no_roulette,
                                                .sample_lights = shadow_rays});
                // The lamp is seen, and then after 1, 2, ... depth reflections.
                const double sum = (1 - std::pow(albedo, depth + 1)) / (1 - albedo);
                CAPTURE(albedo);
                CAPTURE(depth);
                CAPTURE(shadow_rays);
                // Two points at distance d have the cosines d/2R, rounded to some units
                // of R/d each: a relative error of u (2R/d)^2 and the nearest of the N
                // pairs of points of such a check has (2R/d)^2 = N, at most 6000. With
                // a factor of 3 for the steps of the arithmetic: 18000 u.
                const double rounding =
                    9000 * double(std::numeric_limits<T>::epsilon());
                double worst = 0;
                Counts counts;
                for (std::uint64_t path = 0; path < 200; ++path) {
                    auto stream =
                        random_stream(ljus_test::test_seed(7), Pass::camera, 0, path);
                    const auto ray = any_ray<T>(stream);
                    auto context = context_of(stream, counts);
                    const double seen = double(radiance(tracer, ray, context).x);
                    worst = std::max(worst, std::abs(seen / sum - 1));
                }
                CHECK(worst < rounding);
            }
}

TEST_CASE_TEMPLATE("path tracing: a ball of glass in a furnace is invisible", T, float,
                   double) {
    for (const double index : {1.5, 1.1, 2.4}) {
        Furnace<T> scene = furnace<T>(T(0));
        const auto glass = scene.add(GlassT<T>{.index = T(index)});
        scene.add(SphereT<T>{.center{T(0.5), T(-1), T(0.25)}, .radius = T(0.6)}, glass);
        CAPTURE(index);
        const auto towards_ball = [](RandomStream& stream) {
            const Vec3T<T> way = Vec3T<T>{T(0.5), T(-1), T(0.25)} +
                                 (next_3d<T>(stream) - Vec3T<T>{T(0.5)}) -
                                 Vec3T<T>{T(-0.6), T(0.2), T(0.1)};
            return RayT<T>{.origin{T(-0.6), T(0.2), T(0.1)},
                           .direction = glm::normalize(way)};
        };
        // Path by path, if no path is ended by chance: what n^2 takes going in it gives
        // back going out.
        const World world(std::move(scene));
        const PathTracer patient(world, {.roulette_depth = no_roulette});
        const Mean exact = mean_radiance(patient, 20000, 3, towards_ball);
        CHECK(exact.mean == doctest::Approx(1).epsilon(1e-5));
        CHECK(exact.error() < 1e-5);
        const PathTracer tracer(world, {.roulette_depth = 1});
        CHECK(std::abs(apart(mean_radiance(tracer, 20000, 5, towards_ball), 1.0)) <
              limit);
    }
}

TEST_CASE_TEMPLATE("path tracing: a matt ball embedded in glass in a furnace", T, float,
                   double) {
    // Two balls around one centre: an inside ball of radius a and albedo rho in glass
    // of radius 1. Radiance in glass is n^2 times that outside. Light that leaves the
    // inner ball at an angle theta meets the surface at asin(a sin(theta)), and what is
    // reflected there meets the inner ball again, so that its radiosity over pi is
    //     B = rho ((1 - F) n^2 + F B),  F the mean over the cosine-weighted hemisphere.
    const double n = 1.5, a = 0.55;
    double mean_share = 0;
    const int steps = 100000;
    for (int i = 0; i < steps; ++i) { // uniform in sin^2(theta): cosine-weighted
        const double sine2 = (i + 0.5) / steps;
        mean_share +=
            ljus_test::fresnel_share(std::sqrt(1 - a * a * sine2), n, 1) / steps;
    }
    for (const double albedo : {1.0, 0.5})
        for (const double impact : {0.0, 0.5, 0.8, 0.9}) {
            Furnace<T> scene = furnace<T>(T(0));
            const Vec3T<T> center{T(0.5), T(-1), T(0.25)};
            const auto glass = scene.add(GlassT<T>{.index = T(n)});
            const auto matt = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(albedo)}});
            scene.add(SphereT<T>{.center = center, .radius = T(1)}, glass);
            scene.add(SphereT<T>{.center = center, .radius = T(a)}, matt);
            const auto ray = [&](RandomStream&) {
                return RayT<T>{.origin = center + Vec3T<T>{T(impact), T(0), T(1.5)},
                               .direction{T(0), T(0), T(-1)}};
            };
            const double ball =
                albedo * (1 - mean_share) * n * n / (1 - albedo * mean_share);
            const double share =
                ljus_test::fresnel_share(std::sqrt(1 - impact * impact), 1, n);
            const bool meets = impact / n < a;
            const double right = meets ? share + (1 - share) * ball / (n * n) : 1;
            const World world(std::move(scene));
            const PathTracer tracer(world, {.roulette_depth = no_roulette});
            const Mean seen = mean_radiance(tracer, 30000, 11, ray);
            CAPTURE(albedo);
            CAPTURE(impact);
            CAPTURE(seen.mean);
            CAPTURE(right);
            CHECK(std::abs(apart(seen, right, 2e-5)) < limit);
            CHECK(seen.error() < 0.01);
        }
}

TEST_CASE_TEMPLATE("path tracing: a lamp embedded in glass looks n^2 times darker", T,
                   float, double) {
    // What is lit from outside enters and leaves, and n^2 cancels on the way; light
    // that starts within the glass only leaves it: L = (1 - F) Le / n^2. What the
    // surface throws back meets the black lamp again.
    const double n = 1.5, a = 0.55;
    for (const double impact : {0.0, 0.5, 0.8, 0.9}) {
        Furnace<T> scene;
        const auto glass = scene.add(GlassT<T>{.index = T(n)});
        const auto black = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}});
        scene.add(SphereT<T>{.radius = T(1)}, glass);
        scene.add(SphereT<T>{.radius = T(a)}, black, RgbT<T>{T(4)});
        const auto ray = [&](RandomStream&) {
            return RayT<T>{.origin{T(impact), T(0), T(3)},
                           .direction{T(0), T(0), T(-1)}};
        };
        const double share =
            ljus_test::fresnel_share(std::sqrt(1 - impact * impact), 1, n);
        const double right = impact / n < a ? (1 - share) * 4 / (n * n) : 0;
        const World world(std::move(scene));
        const Mean seen = mean_radiance(PathTracer(world), 30000, 37, ray);
        CAPTURE(impact);
        CAPTURE(seen.mean);
        CAPTURE(right);
        CHECK(std::abs(apart(seen, right, 2e-5)) < limit);
    }
}

TEST_CASE_TEMPLATE("path tracing: a spherical lamp lights a surface with pi L (R/d)^2",
                   T, float, double) {
    for (const double ratio : {1e-4, 0.01, 0.3, 0.7, 0.99, 0.99997}) {
        Scene<Shapes<SphereT<T>, QuadT<T>>, Materials<LambertianT<T>>> scene;
        const auto black = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}});
        const auto white = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0.5)}});
        scene.add(SphereT<T>{.center{T(0), T(0), T(1)}, .radius = T(ratio)}, black,
                  RgbT<T>{T(3)});
        scene.add(QuadT<T>{.corner{T(-1), T(-1), T(0)},
                           .edge_u{T(2), T(0), T(0)},
                           .edge_v{T(0), T(2), T(0)}},
                  white);
        // Right under the lamp, from the side.
        const auto ray = [](RandomStream&) {
            return RayT<T>{.origin{T(-0.02), T(0), T(0.0001)},
                           .direction =
                               glm::normalize(Vec3T<T>{T(0.02), T(0), T(-0.0001)})};
        };
        const double right = 0.5 / pi * (pi * 3 * ratio * ratio);
        const World world(std::move(scene));
        const PathTracer tracer(world);
        const Mean seen = mean_radiance(tracer, 60000, 13, ray);
        CAPTURE(ratio);
        CAPTURE(seen.mean);
        CAPTURE(right);
        CHECK(std::abs(apart(seen, right, 2e-4)) < limit);
        CHECK(seen.error() < 0.01 * right);
    }
}

TEST_CASE_TEMPLATE("path tracing: a slab of glass lets (1-R)/(1+R) through", T, float,
                   double) {
    constexpr double n = 1.5, thickness = 0.7;
    CHECK(ljus_test::transmittance_of({1, n, 1}, 0) ==
          doctest::Approx(2 * n / (n * n + 1)));
    for (const double alpha : {0.0, 0.4})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
            Scene<Shapes<QuadT<T>>, Materials<LambertianT<T>, GlassT<T>>> scene;
            const auto glass =
                scene.add(GlassT<T>{.index = T(n), .absorption = RgbT<T>{T(alpha)}});
            scene.add(ljus_test::face(T(0), true), glass);
            scene.add(ljus_test::face(T(-thickness), false), glass);
            const Mean seen =
                ljus_test::seen_through_scene<T>(std::move(scene), degrees, 60000);
            CAPTURE(degrees);
            CAPTURE(alpha);
            const double right = ljus_test::transmittance_of({1, n, 1}, degrees,
                                                             {0, alpha * thickness, 0});
            CHECK(std::abs(apart(seen, right, 1e-4)) < limit);
            CHECK(seen.error() < 0.005);
        }
}

namespace {

template <typename T>
using Room = Scene<Shapes<SphereT<T>, QuadT<T>>,
                   Materials<LambertianT<T>, GlassT<T>, MirrorT<T>>>;

/// A closed box with a mirror ball, a glass ball, and up to two lamps that stay where
/// they are when they are dark.
template <typename T>
Room<T> room(bool quad_shines, bool ball_shines) {
    Room<T> scene;
    const auto wall = scene.add(LambertianT<T>{.albedo{T(0.7), T(0.5), T(0.3)}});
    const auto black = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}});
    const auto glass = scene.add(GlassT<T>{});
    const auto mirror = scene.add(MirrorT<T>{.reflectance = RgbT<T>{T(0.9)}});
    const Vec3T<T> x{T(2), T(0), T(0)}, y{T(0), T(2), T(0)}, z{T(0), T(0), T(2)};
    for (const auto& [corner, u, v] :
         {std::tuple{Vec3T<T>{-1, -1, -1}, x, y}, std::tuple{Vec3T<T>{-1, -1, 1}, x, y},
          std::tuple{Vec3T<T>{-1, -1, -1}, y, z}, std::tuple{Vec3T<T>{1, -1, -1}, y, z},
          std::tuple{Vec3T<T>{-1, -1, -1}, z, x},
          std::tuple{Vec3T<T>{-1, 1, -1}, z, x}})
        scene.add(QuadT<T>{.corner = corner, .edge_u = u, .edge_v = v}, wall);
    scene.add(SphereT<T>{.center{T(-0.45), T(-0.6), T(-0.2)}, .radius = T(0.4)},
              mirror);
    scene.add(SphereT<T>{.center{T(0.45), T(-0.55), T(0.2)}, .radius = T(0.4)}, glass);
    scene.add(QuadT<T>{.corner{T(-0.7), T(0.99), T(-0.5)},
                       .edge_u{T(0.9), T(0), T(0)},
                       .edge_v{T(0), T(0), T(1)}},
              black, RgbT<T>{T(quad_shines ? 3 : 0)});
    scene.add(SphereT<T>{.center{T(0.55), T(0.45), T(-0.45)}, .radius = T(0.3)}, black,
              RgbT<T>{T(ball_shines ? 4 : 0)});
    return scene;
}

/// Into the room from a corner of it.
template <typename T>
RayT<T> into_room(RandomStream& stream) {
    const Vec2T<T> u = next_2d<T>(stream);
    return {.origin{T(0), T(0.1), T(0.95)},
            .direction = glm::normalize(
                Vec3T<T>{T(1.6) * (u.x - T(0.5)), T(1.6) * (u.y - T(0.6)), T(-1)})};
}

} // namespace

TEST_CASE_TEMPLATE("path tracing: two lamps give the sum of what each gives", T, float,
                   double) {
    const World first(room<T>(true, false));
    const World second(room<T>(false, true));
    const World both(room<T>(true, true));
    const auto means = [](const World<Room<T>>& world, std::uint64_t seed) {
        return mean_radiances(PathTracer(world), 60000, seed, into_room<T>);
    };
    const auto by_first = means(first, 23), by_second = means(second, 24),
               by_both = means(both, 25);
    for (const std::size_t channel : {0u, 2u}) {
        const Mean &a = by_first[channel], &b = by_second[channel],
                   &c = by_both[channel];
        CAPTURE(a.mean);
        CAPTURE(b.mean);
        CAPTURE(c.mean);
        const double error = std::hypot(a.error(), b.error(), c.error());
        CHECK(std::abs(a.mean + b.mean - c.mean) < limit * error);
        CHECK(error < 0.03 * c.mean);
    }
}

TEST_CASE_TEMPLATE("path tracing: roulette and shadow rays leave the mean as it is", T,
                   float, double) {
    const World world(room<T>(true, true));
    const long long paths = 60000;
    for (const int depth : {1, 2, 1000}) {
        CAPTURE(depth);
        const auto mean = [&](PathTracingSettings settings, std::uint64_t seed) {
            settings.max_depth = depth;
            return mean_radiance(PathTracer(world, settings), paths, seed,
                                 into_room<T>);
        };
        const Mean usual = mean({}, 31);
        const Mean no_end = mean({.roulette_depth = 100}, 32);
        const Mean early = mean({.roulette_depth = 1}, 33);
        const Mean blind = mean({.sample_lights = false}, 34);
        CAPTURE(usual.mean);
        CAPTURE(usual.error());
        CHECK(std::abs(apart(usual, no_end)) < limit);
        CHECK(std::abs(apart(usual, early)) < limit);
        CHECK(std::abs(apart(usual, blind)) < limit);
        CHECK(usual.error() < 0.02 * usual.mean);
        CHECK(blind.error() < 0.05 * usual.mean);
    }
}

TEST_CASE("path tracing: the plain one, path by path, in closed form") {
    using Hall =
        Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>, MirrorT<double>>,
              Lights<PointLightT<double>>>;
    using D3 = glm::dvec3;
    const QuadT<double> floor{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}; // its normal is up
    const QuadT<double> ceiling{{-9, 4, -9}, {18, 0, 0}, {0, 0, 18}}; // is down
    const RayT<double> down{.origin{0, 2, 0}, .direction{0, -1, 0}};
    const RayT<double> up{.origin{0, 2, 0}, .direction{0, 1, 0}};
    const auto seen = [](const Hall& hall, const RayT<double>& ray, int depth,
                         std::uint64_t path, Counts& counts) {
        auto stream = random_stream(ljus_test::test_seed(9), Pass::user, 0, path);
        const World world(hall);
        auto context = context_of(stream, counts);
        return D3(radiance(PlainPathTracer(world, depth), ray, context));
    };
    // A lamp seen straight, from its front, and in a mirror: once each.
    Hall lit;
    const auto black = lit.add(LambertianT<double>{.albedo = D3{0}});
    lit.add(floor, lit.add(MirrorT<double>{.reflectance{0.9, 0.5, 0.2}}));
    lit.add(ceiling, black, D3{3, 4, 5});
    for (const int depth : {1, 2, 7})
        for (std::uint64_t path = 0; path < 20; ++path) {
            Counts counts;
            CHECK(seen(lit, up, depth, path, counts) == D3{3, 4, 5});
            CHECK(counts.bounce_rays == 0);
            CHECK(counts.shadow_rays == 0);
            const D3 mirrored = seen(lit, down, depth, path, counts);
            CHECK(glm::distance(mirrored, depth == 1 ? D3{0} : D3{2.7, 2, 1}) < 1e-12);
            CHECK(counts.bounce_rays == 1);
        }
    // Between plates that reflect all and emit all: one more L from each bounce, half
    // of it by a shadow ray. A lamp of its own is met only where no shadow ray could
    // go, so from outside, on the back of the ceiling, nothing is seen.
    Counts counts;
    CHECK(seen(lit, {.origin{0, 5, 0}, .direction{0, -1, 0}}, 5, 1, counts) == D3{0});
    CHECK(seen(lit, {.origin{0, 2, 0}, .direction{1, 0, 0}}, 5, 1, counts) == D3{0});

    // A point light over a plane, twice; each is asked half of the times, for both.
    Hall two;
    two.add(floor, two.add(LambertianT<double>{.albedo{0.8, 0.4, 0.2}}));
    two.add(PointLightT<double>{.position{0, 2, 0}, .intensity{8, 4, 2}});
    two.add(PointLightT<double>{.position{0, 1, 0}, .intensity{1, 2, 3}});
    D3 mean{0};
    int first = 0;
    for (std::uint64_t path = 0; path < 1000; ++path) {
        counts = {};
        const D3 one = seen(two, down, 1, path, counts);
        CHECK(counts.shadow_rays == 1);
        CHECK(counts.bounce_rays == 1);
        const D3 by_first = 2.0 * D3{0.8, 0.4, 0.2} / pi * D3{8, 4, 2} / 4.0;
        const D3 by_second = 2.0 * D3{0.8, 0.4, 0.2} / pi * D3{1, 2, 3};
        const bool is_first = glm::distance(one, by_first) < 1e-9;
        CHECK((is_first || glm::distance(one, by_second) < 1e-9));
        first += is_first;
        mean += one / 1000.0;
    }
    CHECK(std::abs(first - 500) < 5 * std::sqrt(250.0)); // once in 1.7 million

    // Without a light there are no shadow rays, on a matt floor or in a mirror.
    Hall dark;
    dark.add(floor, dark.add(LambertianT<double>{.albedo = D3{1}}));
    dark.add(ceiling, dark.add(MirrorT<double>{}));
    counts = {};
    CHECK(seen(dark, down, 9, 1, counts) == D3{0});
    CHECK(seen(dark, up, 9, 1, counts) == D3{0});
    CHECK(counts.shadow_rays == 0);

    // Facing mirrors end at the depth; nothing else would end a path of throughput 1.
    Hall mirrors;
    const auto mirror = mirrors.add(MirrorT<double>{.reflectance = D3{1}});
    mirrors.add(floor, mirror);
    mirrors.add(ceiling, mirror);
    for (const int depth : {1, 4, 5, 6, 50}) {
        counts = {};
        CHECK(seen(mirrors, up, depth, 3, counts) == D3{0});
        CHECK(counts.bounce_rays == std::uint64_t(depth));
    }
    // Where a mirror takes half, roulette keeps a path with its throughput, from the
    // fifth surface on: 2^-5 of them live to the sixth.
    Hall grey;
    const auto half = grey.add(MirrorT<double>{.reflectance = D3{0.5}});
    grey.add(floor, half);
    grey.add(ceiling, half);
    int sixth = 0;
    const int games = 8192;
    for (std::uint64_t path = 0; path < games; ++path) {
        counts = {};
        (void)seen(grey, up, 6, path, counts);
        CHECK(counts.bounce_rays >= 4);
        sixth += counts.bounce_rays > 4;
    }
    CHECK(std::abs(sixth - games / 32.0) < 5 * std::sqrt(games / 32.0));
    const World world(grey);
    CHECK_NOTHROW((void)PlainPathTracer(world, 1));
}

TEST_CASE("path tracing: the log adds up, path by path, and names who carried what") {
    using Hall =
        Scene<Shapes<QuadT<double>>, Materials<LambertianT<double>, MirrorT<double>>,
              Lights<PointLightT<double>>>;
    using D3 = glm::dvec3;
    Hall hall;
    const auto matt = hall.add(LambertianT<double>{.albedo{0.8, 0.4, 0.2}});
    const auto mirror = hall.add(MirrorT<double>{.reflectance{0.9, 0.5, 0.2}});
    hall.add(QuadT<double>{{-9, 0, 9}, {18, 0, 0}, {0, 0, -18}}, matt);
    hall.add(QuadT<double>{{-9, 0, -9}, {18, 0, 0}, {0, 9, 0}}, mirror);
    hall.add(QuadT<double>{{-2, 4, -2}, {4, 0, 0}, {0, 0, 4}}, matt, D3{3, 4, 5});
    hall.add(PointLightT<double>{.position{3, 2, 1}, .intensity{8, 4, 2}});
    const World world(std::move(hall));
    const PathTracer tracer(world, {.max_depth = 6});
    PathLog log; // one for all: each path begins anew
    int emissions = 0, shadows = 0;
    for (std::uint64_t path = 0; path < 300; ++path) {
        auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, path);
        const auto way = D3(next_3d<double>(stream)) * 2.0 - D3{1, 1, 2};
        const RayT<double> ray{.origin{0, 2, 3}, .direction = glm::normalize(way)};
        Counts counts;
        log.lines.clear();
        auto context = context_of(stream, counts, log);
        const D3 seen(radiance(tracer, ray, context));
        D3 told{0};
        for (const PathLogLine& line : log.lines) {
            CHECK(line.path.size() <= 8); // E, six turns, L
            if (line.what == "vertex") continue;
            told += line.value;
            const bool emission = line.what == "emission";
            CHECK((emission || line.what == "shadow ray"));
            CHECK(line.path.ends_with(emission ? "L" : "DL"));
            ++(emission ? emissions : shadows);
        }
        CHECK(glm::distance(told, seen) <= 1e-12 * glm::length(seen));
    }
    CHECK(emissions >
          20); // of each kind there were enough: 200 shadow rays in the mean
    CHECK(shadows > 100);
}

TEST_CASE("path tracing: each heuristic has the weight that its formula says") {
    // Of densities 3 and 1: balance 3/4, power 9/10; and 1/4, 1/10 the other way.
    const auto weight = [](MisHeuristic heuristic, double a, double b) {
        return mis_weight(heuristic, a, b);
    };
    const double infinite = std::numeric_limits<double>::infinity();
    for (const double scale : {1e-150, 1.0, 1e150}) {
        CHECK(weight(MisHeuristic::balance, 3 * scale, scale) == doctest::Approx(0.75));
        CHECK(weight(MisHeuristic::balance, scale, 3 * scale) == doctest::Approx(0.25));
        CHECK(weight(MisHeuristic::power, 3 * scale, scale) == doctest::Approx(0.9));
        CHECK(weight(MisHeuristic::power, scale, 3 * scale) == doctest::Approx(0.1));
        CHECK(weight(MisHeuristic::power, scale, scale) == 0.5);
        CHECK(weight(MisHeuristic::balance, scale, scale) == 0.5);
        CHECK(weight(MisHeuristic::power, scale, 0) == 1);
        CHECK(weight(MisHeuristic::balance, scale, infinite) == 0);
    }
}

TEST_CASE("path tracing: the plain one finds the same light") {
    // Every pixel of a picture of 8 x 8: the means of both, within 4 standard errors of
    // their difference; of 576 comparisons, none is that far
    // apart in 96 % of such tests.
    using namespace ljus_test;
    for (const Ball ball : {Ball::lambertian, Ball::oren_nayar, Ball::mirror})
        for (const Lamp lamp : {Lamp::quad, Lamp::sphere, Lamp::point}) {
            const ClosedRoom room = make_room<float>(ball, lamp, 2);
            const auto camera = room_camera<float>();
            const PlainPathTracer plain(room);
            const PathTracer fast(room);
            CAPTURE(int(ball));
            CAPTURE(int(lamp));
            for (int pixel = 0; pixel < 64; ++pixel) {
                const Ray ray = primary_ray(
                    camera, {float(pixel % 8) + 0.5f, float(pixel / 8) + 0.5f}, 8, 8);
                const auto mean_of = [&](const auto& tracer, std::uint64_t seed) {
                    Mean mean;
                    Counts counts;
                    for (std::uint64_t path = 0; path < 400; ++path) {
                        auto stream =
                            random_stream(ljus_test::test_seed(seed), Pass::user,
                                          std::uint64_t(pixel), path);
                        auto context = context_of(stream, counts);
                        const Rgb found = radiance(tracer, ray, context);
                        mean.add(double(found.x + found.y + found.z));
                    }
                    return mean;
                };
                CAPTURE(pixel);
                CHECK(std::abs(apart(mean_of(plain, 1), mean_of(fast, 2))) < 4);
            }
        }
    const ClosedRoom empty(BallRoomT<float>{});
    CHECK_THROWS_WITH_AS((void)PlainPathTracer(empty, 0),
                         "max_depth is 0; it must be at least 1.",
                         std::invalid_argument);
    CHECK(PlainPathTracer(empty, 1).max_depth() == 1);
    CHECK(PlainPathTracer(empty).max_depth() == 100);
    CHECK(&PlainPathTracer(empty).world() == &empty);
    static_assert(!std::is_constructible_v<PlainPathTracer<ClosedRoom>, ClosedRoom>);
    static_assert(std::is_constructible_v<PlainPathTracer<ClosedRoom>, ClosedRoom&>);
}

TEST_CASE("path tracing: a ray for each turn is counted, and what leaves "
          "is black") {
    // In a furnace without roulette every path goes as far as it may: from the last
    // matt surface, too, to what its shadow ray left over.
    const World hall(furnace<double>(0.9));
    for (const int depth : {1, 2, 7}) {
        Counts counts;
        auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
        auto context = context_of(stream, counts);
        (void)radiance(
            PathTracer(hall, {.max_depth = depth, .roulette_depth = no_roulette}),
            any_ray<double>(stream), context);
        CHECK(counts.bounce_rays == std::uint64_t(depth));
        CHECK(counts.shadow_rays <= std::uint64_t(depth));
        counts = {};
        (void)radiance(PlainPathTracer(hall, depth), any_ray<double>(stream), context);
        CHECK(counts.bounce_rays <= std::uint64_t(depth));
    }
    // A lamp in the void: rays that miss it bring nothing, with both tracers.
    Furnace<double> lamp;
    lamp.add(SphereT<double>{.radius = 1},
             lamp.add(LambertianT<double>{.albedo = RgbT<double>{0.5}}),
             RgbT<double>{1, 2, 3});
    const World world(std::move(lamp));
    const PathTracer fast(world);
    const PlainPathTracer plain(world);
    Counts counts;
    auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
    const auto both = [&](const RayT<double>& ray) {
        auto context = context_of(stream, counts);
        const auto a = radiance(fast, ray, context);
        CHECK(radiance(plain, ray, context) == a);
        return a;
    };
    CHECK(both({.origin{0, 0, 5}, .direction{0, 0, -1}}) == RgbT<double>{1, 2, 3});
    CHECK(both({.origin{0, 0, 5}, .direction{0, 0, 1}}) == RgbT<double>{0});
    CHECK(both({.origin{0, 2, 5}, .direction{0, 0, -1}}) == RgbT<double>{0});
}

TEST_CASE("path tracing: a lamp's share by its number, its power and "
          "where it is then") {
    // A path has met the second of three balls of light, which moves. Of radius r at a
    // distance d, a shadow ray chooses each direction within its cone with the density
    // 1 / (2 pi (1 - sqrt(1 - (r/d)^2))), and the ball by its share of all r^2 L.
    using D3 = glm::dvec3;
    using Ball = SphereT<double>;
    Scene<Shapes<Ball, Moving<Ball>>, Materials<LambertianT<double>>> scene;
    const auto black = scene.add(LambertianT<double>{.albedo = RgbT<double>{0}});
    scene.add(Ball{.center{0, 0, -9}, .radius = 1}, black, RgbT<double>{7});
    scene.add(Moving<Ball>{{.center{3, 0, 0}, .radius = 0.5}, {0, 4, 0}}, black,
              RgbT<double>{2});
    scene.add(Ball{.center{0, 0, 9}, .radius = 2}, black, RgbT<double>{1});
    // By its place in the list, whichever that is, it has this power.
    const double share = 0.25 * 2 / (1 * 7 + 0.25 * 2 + 4 * 1);
    const D3 throughput{0.5, 0.25, 1};
    for (const double time : {0.0, 0.25, 1.0}) {
        const D3 center{3, 4 * time, 0};
        const RayT<double> ray{.direction = glm::normalize(center), .time = time};
        const auto index = World(scene);
        const auto hit = closest_hit(index, ray);
        REQUIRE(hit);
        const auto vertex = vertex_at(index, ray, *hit);
        REQUIRE(vertex.emits());
        const double cosine = std::sqrt(1 - 0.25 / glm::dot(center, center));
        const double other = share / (2 * std::numbers::pi * (1 - cosine));
        const auto found = [&](MisHeuristic heuristic, double pdf, bool lights = true) {
            const PathTracer tracer(index,
                                    {.sample_lights = lights, .heuristic = heuristic});
            const PathStateT<double> path{
                .ray = ray, .throughput = throughput, .pdf = pdf};
            return detail::emitted(tracer, path, vertex);
        };
        const D3 all = 2.0 * throughput;
        for (const double pdf : {0.01, 0.7, 30.0}) {
            CAPTURE(time);
            CAPTURE(pdf);
            const auto weight = [&](MisHeuristic heuristic) {
                const D3 seen = found(heuristic, pdf);
                CHECK(seen.x / all.x == doctest::Approx(seen.z / all.z));
                CHECK(seen.y / all.y == doctest::Approx(seen.z / all.z));
                return seen.z / all.z;
            };
            const double squares = pdf * pdf + other * other;
            CHECK(weight(MisHeuristic::balance) ==
                  doctest::Approx(pdf / (pdf + other)));
            CHECK(weight(MisHeuristic::power) == doctest::Approx(pdf * pdf / squares));
            CHECK(weight(MisHeuristic::shadow_rays) == 0);
            CHECK(found(MisHeuristic::balance, pdf, false) == all);
        }
        for (const auto heuristic :
             {MisHeuristic::balance, MisHeuristic::power, MisHeuristic::shadow_rays})
            CHECK(found(heuristic, 0) == all); // after a mirror
    }
}

TEST_CASE("path tracing: what n^2 takes from a path in glass is no "
          "reason to end it") {
    // Glass that absorbs nothing, in light of radiance 1 that is black: each path
    // brings all of it, if roulette does not touch it.
    Furnace<double> room;
    room.add(SphereT<double>{.radius = 2},
             room.add(LambertianT<double>{.albedo = RgbT<double>{0}}), RgbT<double>{1},
             true);
    room.add(SphereT<double>{.radius = 1}, room.add(GlassT<double>{.index = 2.4}));
    const World world(std::move(room));
    const PathTracer tracer(world, {.roulette_depth = 1});
    for (std::uint64_t i = 0; i < 300; ++i) {
        auto stream = random_stream(1, Pass::user, 0, i);
        Counts counts;
        auto context = context_of(stream, counts);
        const auto seen = radiance(
            tracer, RayT<double>{.origin{0, 0.3, 1.9}, .direction{0, 0, -1}}, context);
        REQUIRE(seen.x == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("path tracing: a path whose light is gone is not cut by the depth") {
    // Between a red mirror and one that is green, grey or black: the depth cuts what is
    // left of the light behind the second one.
    for (const auto& second :
         {RgbT<double>{0, 1, 0}, RgbT<double>{0.5}, RgbT<double>{0}})
        for (const int depth : {1, 2, 3}) {
            ljus_test::BallRoomT<double> room;
            const auto wall = [&](double z, const RgbT<double>& color) {
                room.add(QuadT<double>{{-9, -9, z}, {18, 0, 0}, {0, 18, 0}},
                         room.add(MirrorT<double>{.reflectance = color}));
            };
            wall(1, {1, 0, 0});
            wall(-1, second);
            const World world(std::move(room));
            Counts counts;
            auto stream = random_stream(1, Pass::user, 0, 0);
            auto context = context_of(stream, counts);
            (void)radiance(
                PathTracer(world, {.max_depth = depth, .roulette_depth = no_roulette}),
                RayT<double>{.direction{0, 0, 1}}, context);
            CAPTURE(depth);
            const bool left = depth == 1 || second.x > 0;
            CHECK(counts.cut_paths == (left ? 1u : 0u));
            CHECK(counts.bounce_rays == std::uint64_t(left ? depth - 1 : 1));
        }
}
