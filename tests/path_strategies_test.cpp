// concept: path_tracing
// Who may bring a lamp's light, and when a path ends by chance: the mean knows nothing
// of it. Means are asked for within 3.5 standard errors (13 of them: fresh seeds would
// fail once in 165 runs), chi-squares within 3.09 (3 of them, once in 300).
#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "ljus/materials/glossy.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;
using ljus_test::mean_radiance;

namespace {

using Plate = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glossy>>;

/// A glossy plate that mirrors a lamp, large or small, to the eye; a second lamp stands
/// beside it. Light goes from plate to lamps only: direct light is all there is.
Plate plate(float roughness, float radius) {
    Plate scene;
    const auto gloss =
        scene.add(Glossy{.reflectance = Rgb{0.9f}, .roughness = roughness});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, gloss);
    scene.add(Sphere{{0, 1.5f, -1.5f}, radius}, black, Rgb{0.3f / (radius * radius)});
    scene.add(Sphere{{1.2f, 1.0f, -1.2f}, 0.2f}, black, Rgb{3});
    return scene;
}

/// To a place near the middle of the plate.
Ray to_plate(RandomStream& stream) {
    const Vec3 eye{0, 1.5f, 1.5f};
    const Vec2 u = next_2d<float>(stream);
    return {.origin = eye,
            .direction = glm::normalize(
                Vec3{0.4f * (u.x - 0.5f), 0, 0.4f * (u.y - 0.5f)} - eye)};
}

/// What a path in a furnace of emission 1 and albedo rho brings: a geometric sum of
/// (rho/p)^k up to a length that a constant chance p decides. Its variance.
double furnace_variance(double rho, double p) {
    const double r = rho / p, s = rho * rho / p;
    const double mean = 1 / (1 - rho);
    if (std::abs(r - 1) < 1e-9) return p / ((1 - p) * (1 - p));
    return 1 / (1 - s) + 2 / (r - 1) * (1 / (1 - s) - mean) - mean * mean;
}

Ray in_furnace(RandomStream& stream) {
    return {.origin{0.1f, 0.2f, -0.1f},
            .direction = sample_uniform_sphere(next_2d<float>(stream))};
}

} // namespace

TEST_CASE("multiple importance: the shares of two strategies are the whole") {
    const float largest = std::numeric_limits<float>::max();
    const float infinity = std::numeric_limits<float>::infinity();
    for (const MisHeuristic share : {MisHeuristic::balance, MisHeuristic::power})
        for (const float a : {1e-38f, 0.3f, 1.0f, 7.0f, largest})
            for (const float b : {1e-38f, 0.3f, 2.0f, 1e20f, largest}) {
                const float of_a = mis_weight(share, a, b),
                            of_b = mis_weight(share, b, a);
                CHECK(of_a + of_b == doctest::Approx(1));
                CHECK((of_a >= 0 && of_b >= 0));
                CHECK(mis_weight(share, a, infinity) == 0.0f);
                CHECK(mis_weight(share, a, 0.0f) == 1.0f);
            }
    CHECK(balance_heuristic(1.0, 3.0) == 0.25);
    CHECK(power_heuristic(1.0, 3.0) == doctest::Approx(0.1));
    CHECK(power_heuristic(3.0, 1.0) == doctest::Approx(0.9));
}

TEST_CASE("multiple importance: all ways to share a lamp's light have one mean") {
    // And Veach's bound: the balance heuristic has the better strategy's variance and
    // half the squared mean at most.
    struct Case {
        float roughness, radius;
    };
    for (const Case c : {Case{0.12f, 0.7f}, Case{0.5f, 0.05f}, Case{0.3f, 0.3f}}) {
        const World world(plate(c.roughness, c.radius));
        const auto seen = [&](PathTracingSettings settings, std::uint64_t seed) {
            settings.max_depth = 1;
            return mean_radiance(PathTracer(world, settings), 60000, seed, to_plate);
        };
        const Mean both = seen({}, 1);
        const Mean power = seen({.heuristic = MisHeuristic::power}, 2);
        const Mean light = seen({.heuristic = MisHeuristic::shadow_rays}, 3);
        const Mean gloss = seen({.sample_lights = false}, 4);
        CAPTURE(c.roughness);
        CAPTURE(both.mean);
        CAPTURE(both.error() / both.mean);
        CAPTURE(power.error() / both.mean);
        CAPTURE(light.error() / both.mean);
        CAPTURE(gloss.error() / both.mean);
        CHECK(std::abs(apart(both, power)) < 3.5);
        CHECK(std::abs(apart(both, light)) < 3.5);
        CHECK(std::abs(apart(both, gloss)) < 3.5);
        const double better = std::min(light.error(), gloss.error());
        const double bound =
            std::hypot(better, both.mean * std::sqrt(0.5 / double(both.count)));
        CHECK(both.error() < 1.02 * bound);
        if (c.radius > 0.5f) CHECK(light.error() > 4 * both.error());
        if (c.radius < 0.1f) CHECK(gloss.error() > 4 * both.error());
    }
}

TEST_CASE("multiple importance: in a box furnace no surface brings more than twice its "
          "share") {
    // cos/r^2 has no bound between walls that meet; f / (p_l + p_b) is at most f / p_b,
    // the albedo. So is what the path itself brings.
    const auto room = box_furnace(Rgb{1}, Rgb{0.5f});
    struct Seen {
        Mean mean{};
        double most = 0;
    };
    const auto seen = [&](const PathTracingSettings& settings) {
        const PathTracer tracer(room.world, settings);
        Seen all;
        Counts counts;
        for (std::uint64_t path = 0; path < 10000; ++path) {
            auto stream = random_stream(5, Pass::camera, 0, path);
            const Ray ray = in_furnace(stream);
            auto context = context_of(stream, counts);
            const double value = double(radiance(tracer, ray, context).x);
            all.mean.add(value);
            all.most = std::max(all.most, value);
        }
        return all;
    };
    const Seen both = seen({.max_depth = 12, .roulette_depth = 100});
    CAPTURE(both.mean.mean);
    CAPTURE(both.most);
    CHECK(std::abs(apart(both.mean, 2 - std::exp2(-12))) < 3.5);
    CHECK(both.most < 1 + 2 * 1.0001);
    const Seen shadow = seen({.max_depth = 12,
                              .roulette_depth = 100,
                              .heuristic = MisHeuristic::shadow_rays});
    CAPTURE(shadow.most);
    CHECK(shadow.most > 20);
}

TEST_CASE("roulette: a hundred seeds have the furnace's mean, at every threshold") {
    // The sum of z^2 of 100 independent means is a chi-square; each of 1600 paths: the
    // few that roulette lets live make a mean of 400 lopsided.
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
    struct Case {
        double threshold, most;
    };
    for (const Case& c : {Case{1, 1}, Case{4, 1}, Case{1e-6, 0.7}}) {
        const PathTracer tracer(room.world, {.roulette_depth = 1,
                                             .sample_lights = false,
                                             .roulette_threshold = c.threshold,
                                             .roulette_max = c.most});
        double chi_square = 0;
        Mean all;
        for (std::uint64_t seed = 1; seed <= 100; ++seed) {
            const Mean mean = mean_radiance(tracer, 1600, seed, in_furnace);
            const double z = apart(mean, 2.0);
            chi_square += z * z;
            all.add(mean.mean);
        }
        CAPTURE(c.threshold);
        CAPTURE(all.mean);
        CAPTURE(all.error());
        CHECK(chi_square < ljus_test::chi_square_limit(100));
        CHECK(std::abs(apart(all, 2.0)) < 4.5);
    }
}

TEST_CASE("roulette: the noise of a constant chance is the closed form's") {
    for (const double p : {0.5, 0.7, 0.9}) {
        const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
        const PathTracer tracer(room.world, {.roulette_depth = 1,
                                             .sample_lights = false,
                                             .roulette_threshold = 1e-9,
                                             .roulette_max = p});
        const Mean seen = mean_radiance(tracer, 100000, 9, in_furnace);
        const double measured = seen.squares / (seen.count - 1);
        CAPTURE(p);
        CAPTURE(measured);
        CAPTURE(furnace_variance(0.5, p));
        CHECK(std::abs(measured / furnace_variance(0.5, p) - 1) < 0.05);
    }
}

TEST_CASE("path tracing: the error falls with the root of the rays") {
    // 256 independent means of n paths: their RMS error is known to 4.4 %, and a slope
    // over six doublings to 0.015. Asked for within 0.06.
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.6f});
    const PathTracer tracer(room.world, {.roulette_depth = 1});
    const auto rms = [&](int paths, std::uint64_t seed) {
        double squares = 0;
        for (std::uint64_t i = 0; i < 256; ++i) {
            const Mean mean = mean_radiance(tracer, paths, seed + i, in_furnace);
            squares += (mean.mean - 2.5) * (mean.mean - 2.5);
        }
        return std::sqrt(squares / 256);
    };
    const double few = rms(4, 1000), many = rms(256, 2000);
    const double slope = std::log2(many / few) / 6;
    CAPTURE(slope);
    CHECK(std::abs(slope + 0.5) < 0.06);
}

TEST_CASE("path tracing: settings that make no sense are refused with their value") {
    const auto room = sphere_furnace(Rgb{1}, Rgb{0.5f});
    const auto said = [&](const PathTracingSettings& settings) {
        return ljus_test::refusal([&] { (void)PathTracer(room.world, settings); });
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    CHECK(said({.max_depth = 0}) == "max_depth is 0; it must be at least 1.");
    CHECK(said({.roulette_threshold = -1}) ==
          "roulette_threshold is -1; it must be finite and at least 0.");
    CHECK(said({.roulette_threshold = nan}) ==
          "roulette_threshold is NaN; it must be finite and at least 0.");
    CHECK(said({.roulette_threshold = std::numeric_limits<double>::infinity()}) ==
          "roulette_threshold is infinity; it must be finite and at least 0.");
    CHECK(said({.roulette_max = 0}) == "roulette_max is 0; it must be in (0, 1].");
    CHECK(said({.roulette_max = 1.5}) == "roulette_max is 1.5; it must be in (0, 1].");
    CHECK(said({.roulette_max = nan}) == "roulette_max is NaN; it must be in (0, 1].");
    // The last that do, and those that are meant where nothing is said.
    CHECK(said({.max_depth = 1, .roulette_threshold = 0, .roulette_max = 1}).empty());
    CHECK(said({.roulette_max = 1e-9}).empty());
    const PathTracingSettings silent = PathTracer(room.world).settings();
    CHECK(silent.max_depth == 1000);
    CHECK(silent.roulette_depth == 4);
    CHECK(silent.sample_lights);
    CHECK(silent.heuristic == MisHeuristic::balance);
    CHECK(silent.roulette_threshold == 1);
    CHECK(silent.roulette_max == 1);
}
