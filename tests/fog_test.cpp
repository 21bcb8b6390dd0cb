/// \file fog_test.cpp
/// \brief Fog: its phase function, free flights, equi-angular sampling and whole paths,
/// against closed forms, quadrature and an independent random walk.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million.

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "ljus/geometry/moving.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/media/fog.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/path/light_transport.hpp"
#include "ljus/radiosity/patches.hpp"
#include "ljus/render/first_hit.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/render/whitted.hpp"
#include "ljus/scenes/cornell_box.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::integrate;
using ljus_test::Mean;
using ljus_test::mean_radiance;
using ljus_test::refusal;

static_assert(Medium<Fog<Sphere>> && Medium<Fog<BoxT<double>>>);

namespace {

constexpr double pi = std::numbers::pi;

/// Henyey and Greenstein's formula as it is printed.
double printed(double g, double cosine) {
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

/// A ray along +x from a point, for mean_radiance().
auto along_x(const Vec3& from) {
    return [from](RandomStream&) {
        return Ray{.origin = from, .direction = {1, 0, 0}};
    };
}

using Balls = Scene<Shapes<Sphere>, Materials<Lambertian, Glass>, Lights<PointLight>,
                    Media<Fog<Sphere>, Fog<Box>>>;

/// A scene that is black at x = 20, with fog in it.
Balls black_wall() {
    Balls scene;
    scene.add(Sphere{.center{120, 0, 0}, .radius = 100},
              scene.add(Lambertian{.albedo = Rgb{0}}));
    return scene;
}

/// A room of one ball around the origin that glows with the radiance 1.
Balls glowing_room(float albedo = 0) {
    Balls scene;
    scene.add(Sphere{.radius = 2}, scene.add(Lambertian{.albedo = Rgb{albedo}}),
              Rgb{1 - albedo}, true);
    return scene;
}

constexpr FogLight ways[] = {FogLight::both, FogLight::flight, FogLight::equi_angular};

} // namespace

TEST_CASE("fog: the phase function integrates to 1, with the mean cosine g") {
    for (const double g : {-0.99, -0.6, 0.0, 1e-9, 0.3, 0.9, 0.99}) {
        CAPTURE(g);
        // Cosines, spread so that the peaks at both ends are resolved.
        const auto over = [&](auto f) {
            return integrate(0, pi, 2000, [&](double theta) {
                const double cosine = std::cos(theta);
                return 2 * pi * std::sin(theta) * henyey_greenstein(g, cosine) *
                       f(cosine);
            });
        };
        CHECK(over([](double) { return 1.0; }) == doctest::Approx(1).epsilon(1e-9));
        CHECK(std::abs(over([](double c) { return c; }) - g) < 1e-9);
        for (const double cosine : {-1.0, -0.7, 0.0, 0.2, 0.999, 1.0}) {
            CHECK(henyey_greenstein(g, cosine) ==
                  doctest::Approx(printed(g, cosine)).epsilon(1e-9));
            CHECK(henyey_greenstein(float(g), float(cosine)) ==
                  doctest::Approx(printed(double(float(g)), double(float(cosine))))
                      .epsilon(2e-5));
        }
    }
}

TEST_CASE_TEMPLATE("fog: samples follow the phase function", T, float, double) {
    // Chi-square with a false alarm once in a million.
    const Vec3T<T> travel = glm::normalize(Vec3T<T>{T(1), T(-2), T(0.5)});
    const auto frame = frame_around(travel);
    for (const double g : {-0.95, -0.5, 0.0, 0.4, 0.9}) {
        CAPTURE(g);
        constexpr int rows = 24, columns = 8, count = 100000;
        std::vector<double> found(rows * columns), expected(rows * columns);
        auto stream = random_stream(11, Pass::user, 0, 0);
        for (int i = 0; i < count; ++i) {
            const auto w = sample_henyey_greenstein(T(g), travel, next_2d<T>(stream));
            REQUIRE(std::abs(glm::length(w) - T(1)) < T(1e-5));
            const auto local = to_local(frame, w);
            const double theta = std::acos(std::clamp(double(local.z), -1.0, 1.0));
            const double phi = std::atan2(double(local.y), double(local.x)) + pi;
            const int row = std::min(rows - 1, int(theta / pi * rows));
            const int column = std::min(columns - 1, int(phi / (2 * pi) * columns));
            found[std::size_t(row * columns + column)] += 1;
        }
        for (int row = 0; row < rows; ++row)
            for (int column = 0; column < columns; ++column)
                expected[std::size_t(row * columns + column)] =
                    count * 2 * pi / columns *
                    integrate(pi * row / rows, pi * (row + 1) / rows, 4, [&](double t) {
                        return std::sin(t) * printed(g, std::cos(t));
                    });
        CHECK(ljus_test::chi_square_agrees(found, expected,
                                           ljus_test::once_in_a_million));
    }
}

TEST_CASE("fog: at the ends of the unit square samples are unit directions") {
    const float last = std::nextafter(1.0f, 0.0f);
    const Vec3 travel = glm::normalize(Vec3{3, 1, -2});
    for (float g = -0.99f; g <= 0.99f; g += 0.01f)
        for (const float u : {0.0f, 1e-30f, 1e-7f, last - 1e-7f, last})
            for (const float v : {0.0f, 0.3f, last}) {
                const Vec3 w = sample_henyey_greenstein(g, travel, Vec2{u, v});
                REQUIRE(std::abs(glm::length(w) - 1) < 1e-5f);
            }
}

TEST_CASE("fog: the part of a ray in a sphere and in a box") {
    auto stream = random_stream(3, Pass::user, 0, 0);
    const SphereT<double> ball{.center{1, 2, 3}, .radius = 1.5};
    const BoxT<double> box{{-0.5, 1, 2}, {2, 2.5, 5}};
    const auto in_ball = [&](const glm::dvec3& p) {
        return glm::distance(p, ball.center) < ball.radius;
    };
    const auto in_box = [&](const glm::dvec3& p) {
        return glm::all(glm::lessThan(box.low, p)) &&
               glm::all(glm::lessThan(p, box.high));
    };
    int met = 0;
    const auto check_span = [&](const auto& span, const RayT<double>& ray,
                                const auto& inside) {
        bool any = false;
        for (double t = ray.t_min + 0.005; t < ray.t_max; t += 0.01) {
            const bool in = inside(point_at(ray, t));
            any = any || in;
            REQUIRE(in == (span && span->first < t && t < span->last));
        }
        if (span) REQUIRE((any || span->last - span->first < 0.011));
        if (span) REQUIRE(span->first >= ray.t_min);
        if (span) REQUIRE(span->last <= ray.t_max);
        met += any ? 1 : 0;
    };
    for (int i = 0; i < 400; ++i) {
        const auto u = next_3d<double>(stream), to = next_3d<double>(stream);
        const glm::dvec3 from = 8.0 * u - glm::dvec3{3, 2, 1};
        RayT<double> ray{.origin = from,
                         .direction = 0.7 * glm::normalize(6.0 * to - from),
                         .t_min = 1,
                         .t_max = 1 + 12 * next_1d<double>(stream)};
        if (i % 4 == 0) ray.direction = {0, i % 8 == 0 ? 1.0 : -1.0, 0};
        check_span(span_of(ball, ray), ray, in_ball);
        check_span(span_of(box, ray), ray, in_box);
    }
    CHECK(met > 100);
}

TEST_CASE("fog: equi-angular samples follow their density, which integrates to 1") {
    const RayT<double> ray{.origin{1, 0, 0}, .direction{0, 0, -1}};
    const glm::dvec3 beside{1.5, 0.2, -2}, on{1, 0, -2}, far{1, 3000, -4000}, //
        behind{1.1, 0, 30};
    for (const glm::dvec3& light : {beside, on, far, behind}) {
        CAPTURE(light.y);
        const auto angles = equi_angular(ray, SpanT<double>{0.5, 6}, light);
        const auto density = [&](double t) { return pdf_equi_angular(angles, t); };
        CHECK(integrate(0.5, 6, 4000, density) == doctest::Approx(1).epsilon(1e-6));
        constexpr int cells = 20, count = 20000;
        std::vector<double> found(cells), expected(cells);
        auto stream = random_stream(5, Pass::user, 0, 0);
        for (int i = 0; i < count; ++i) {
            const double t = sample_equi_angular(angles, next_1d<double>(stream));
            REQUIRE((t >= 0.5 && t <= 6));
            found[std::min(std::size_t(cells - 1),
                           std::size_t((t - 0.5) / 5.5 * cells))] += 1;
        }
        for (int i = 0; i < cells; ++i)
            expected[std::size_t(i)] =
                count * integrate(0.5 + 5.5 * i / cells, 0.5 + 5.5 * (i + 1) / cells,
                                  200, density);
        CHECK(ljus_test::chi_square_agrees(found, expected,
                                           ljus_test::once_in_a_million));
    }
}

TEST_CASE("fog: seen from very far, equi-angular samples are uniform") {
    const Ray ray{.direction{1, 0, 0}};
    for (const Vec3& light : {Vec3{1e6f, 3e5f, 0}, Vec3{-2e7f, 0, 1e7f}}) {
        const auto angles = equi_angular(ray, SpanT<float>{1, 5}, light);
        for (const float t : {1.0f, 2.5f, 5.0f})
            CHECK(pdf_equi_angular(angles, t) == doctest::Approx(0.25).epsilon(1e-4));
    }
}

TEST_CASE(
    "fog: what a ray gathers of a point light is the integral of one scattering") {
    // Quadrature of sigma_s phase I / d^2 exp(-sigma_t (t + d)) along the ray.
    struct Setting {
        Rgb absorption, scattering;
        float g;
        Vec3 light;
    };
    const Setting settings[] = {
        {Rgb{0}, Rgb{1e-3f}, 0, {3, 0.5f, 0}}, // thin
        {{0.02f, 0.1f, 0}, {0.5f, 0.1f, 0.02f}, 0.6f, {2, 0, 1}},
        {{1, 0.1f, 0}, {5, 0.7f, 0.01f}, -0.4f, {1, 0.3f, 0.2f}}, // strongly coloured
    };
    const Vec3 from{-1, 0, 0};
    for (const Setting& setting : settings)
        for (const FogLight how : ways) {
            Balls scene = black_wall();
            scene.add(PointLight{.position = setting.light, .intensity = Rgb{2}});
            scene.add(Fog<Sphere>{.region{.radius = 30},
                                  .absorption = setting.absorption,
                                  .scattering = setting.scattering,
                                  .g = setting.g});
            const World world(std::move(scene));
            const PathTracer tracer(world, {.max_depth = 1, .fog = how});
            for (int c = 0; c < 3; ++c) {
                CAPTURE(int(how));
                CAPTURE(c);
                const double s = setting.scattering[c];
                const double all = double(setting.absorption[c]) + s;
                const glm::dvec3 lamp{setting.light};
                const double truth = integrate(0, 21, 4000, [&](double t) {
                    const glm::dvec3 way = lamp - glm::dvec3{-1 + t, 0, 0};
                    const double d = glm::length(way);
                    return s * printed(double(setting.g), way.x / d) * 2 / (d * d) *
                           std::exp(-all * (t + d));
                });
                const Mean mean = mean_radiance(tracer, 20000, 1, along_x(from), c);
                CHECK(mean.agrees_with(truth, 1e-4));
            }
        }
}

TEST_CASE("fog: several media scatter each by its own coefficients") {
    // Two balls, one behind the other, and a box that overlaps the second one.
    struct Ball {
        double from, to, scattering, g;
    };
    const Ball media[] = {{1, 3, 0.3, 0.7}, {4, 8, 0.1, -0.5}, {6, 9, 0.2, 0}};
    const glm::dvec3 lamp{5, 4, 0}; // outside all of them
    const auto inside = [&](int i, const glm::dvec3& p) {
        const auto [from, to, scatters, g] = media[i];
        return i < 2 ? glm::distance(p, {(from + to) / 2, 0, 0}) < (to - from) / 2
                     : p.x > from && p.x < to && std::abs(p.y) < 1;
    };
    Balls scene = black_wall();
    scene.add(PointLight{.position = Vec3(lamp), .intensity = Rgb{10}});
    for (int i = 0; i < 2; ++i)
        scene.add(
            Fog<Sphere>{.region{.center{float(media[i].from + media[i].to) / 2, 0, 0},
                                .radius = float(media[i].to - media[i].from) / 2},
                        .scattering = Rgb{float(media[i].scattering)},
                        .g = float(media[i].g)});
    scene.add(Fog<Box>{.region{{6, -1, -1}, {9, 1, 1}}, .scattering = Rgb{0.2f}});
    const World world(std::move(scene));

    const auto depth = [&](const glm::dvec3& from, const glm::dvec3& to) {
        return glm::distance(from, to) * integrate(0, 1, 400, [&](double t) {
                   const glm::dvec3 p = glm::mix(from, to, t);
                   double sum = 0;
                   for (int i = 0; i < 3; ++i)
                       sum += inside(i, p) ? media[i].scattering : 0;
                   return sum;
               });
    };
    double truth = 0;
    for (int i = 0; i < 3; ++i)
        truth += integrate(media[i].from, media[i].to, 400, [&](double x) {
            const glm::dvec3 p{x, 0, 0}, way = lamp - p;
            const double d = glm::length(way);
            return media[i].scattering * printed(media[i].g, way.x / d) * 10 / (d * d) *
                   std::exp(-depth({0, 0, 0}, p) - depth(p, lamp));
        });
    for (const FogLight how : ways) {
        CAPTURE(int(how));
        const PathTracer tracer(world, {.max_depth = 1, .fog = how});
        CHECK(mean_radiance(tracer, 40000, 13, along_x({0, 0, 0}))
                  .agrees_with(truth, 2e-3 * truth));
    }
}

TEST_CASE("fog: at each time of the shutter a path sees what stands there") {
    // A lamp and a ball before it, both in motion, against the same world at rest at
    // the time that the path draws.
    using Moved = Moving<Sphere>;
    Moved lamp{{.center{-1, 2, 0}, .radius = 0.9f}, {2, 0, 0}};
    Moved ball{{.center{0.6f, 0.7f, 0}, .radius = 0.3f}, {-1.2f, 0, 0.3f}};
    const auto at = [&](float time, float moves) {
        Scene<Shapes<Moved>, Materials<Lambertian>, Lights<>, Media<Fog<Sphere>>> scene;
        const auto add = [&](Moved shape, Rgb emission) {
            shape.shape = at_time(shape, time);
            shape.displacement *= moves;
            scene.add(shape, scene.add(Lambertian{.albedo = Rgb{0.5f}}), emission);
        };
        add(lamp, Rgb{5});
        add(ball, Rgb{0});
        scene.add(
            Fog<Sphere>{.region{.radius = 3}, .scattering = Rgb{0.6f}, .g = 0.3f});
        return World(std::move(scene));
    };
    const auto moving = at(0, 1);
    Counts counts;
    for (const bool lights : {true, false}) {
        const PathTracingSettings settings{.sample_lights = lights};
        const PathTracer tracer(moving, settings);
        int lit = 0;
        for (std::uint64_t i = 0; i < 400; ++i) {
            CAPTURE(i);
            auto stream = random_stream(14, Pass::camera, 0, i);
            const Ray ray{.origin{-2, 0, 0}, .direction{1, 0, 0}};
            auto other = stream;
            const auto still = at(next_1d<float>(other), 0);
            auto context = context_of(stream, counts);
            auto still_context = context_of(other, counts);
            const Rgb found = radiance(tracer, ray, context);
            const Rgb truth = radiance(PathTracer(still, settings), ray, still_context);
            lit += truth.x > 0 ? 1 : 0;
            REQUIRE(found.x == doctest::Approx(truth.x).epsilon(1e-3));
        }
        CHECK(lit > 10);
    }
}

TEST_CASE("fog: of thin fog the closed form, the angle over the distance") {
    Balls scene = black_wall();
    scene.add(PointLight{.position{5, 0, 2}, .intensity = Rgb{1}});
    scene.add(Fog<Sphere>{.region{.radius = 30}, .scattering = Rgb{1e-5f}});
    const World world(std::move(scene));
    const PathTracer tracer(world, {.max_depth = 1});
    const Mean mean = mean_radiance(tracer, 200, 1, along_x({0, 0, 0}));
    const double angle = std::atan2(5.0, 2.0) + std::atan2(15.0, 2.0);
    CHECK(mean.mean == doctest::Approx(1e-5 / (4 * pi) * angle / 2).epsilon(1e-3));
    CHECK(mean.error() < 1e-3 * mean.mean); // the density is that of the light
}

TEST_CASE("fog: in a glowing room, fog that absorbs nothing is not seen") {
    for (const float g : {0.0f, 0.7f})
        for (const bool lights : {true, false}) {
            CAPTURE(g);
            Balls scene = glowing_room(0.5f);
            scene.add(
                Fog<Sphere>{.region{.radius = 5}, .scattering{0.3f, 2, 0.1f}, .g = g});
            // Paths begin in glass that bends nothing, which is a specular surface.
            scene.add(Sphere{.center{-1, 0, 0}, .radius = 0.5f},
                      scene.add(Glass{.index = 1}));
            const World world(std::move(scene));
            for (const auto heuristic : {MisHeuristic::balance, MisHeuristic::power,
                                         MisHeuristic::shadow_rays}) {
                const PathTracer tracer(
                    world, {.sample_lights = lights, .heuristic = heuristic});
                for (int c = 0; c < 3; ++c)
                    CHECK(mean_radiance(tracer, 4000, 2, along_x({-1, 0.3f, 0}), c)
                              .agrees_with(1, 1e-4));
                if (!lights) break;
            }
        }
}

TEST_CASE("fog: at the limit of depth, weights share the light as before it") {
    // Behind a mirror or clear glass, too, a path may end in fog; its last ray then
    // finds the lamps that its weight leaves to it.
    Balls scene = glowing_room();
    scene.add(Sphere{.center{-1, 0, 0}, .radius = 0.5f}, scene.add(Glass{.index = 1}));
    scene.add(Fog<Sphere>{.region{.radius = 5}, .scattering = Rgb{1.5f}});
    const World world(std::move(scene));
    for (const int depth : {1, 2, 3}) {
        CAPTURE(depth);
        const auto mean = [&](MisHeuristic heuristic, std::uint64_t seed) {
            return mean_radiance(
                PathTracer(world, {.max_depth = depth, .heuristic = heuristic}), 20000,
                seed, along_x({-1, 0.3f, 0}));
        };
        CHECK(std::abs(ljus_test::apart(mean(MisHeuristic::balance, 15),
                                        mean(MisHeuristic::shadow_rays, 16))) < 5);
    }
}

TEST_CASE("fog: a slab dims what is behind it by the law of Beer") {
    Balls scene = glowing_room();
    scene.add(Fog<Box>{.region{{-1, -1, -1}, {0.5f, 1, 1}}, .absorption{0.3f, 1, 0}});
    // Where media overlap, coefficients add up.
    scene.add(Fog<Sphere>{.region{.radius = 0.75f}, .absorption{0.2f, 0, 0}});
    const World world(std::move(scene));
    const PathTracer tracer(world);
    const double depths[] = {1.5 * 0.3 + 1.5 * 0.2, 1.5, 0};
    for (int c = 0; c < 3; ++c)
        CHECK(mean_radiance(tracer, 20000, 3, along_x({-1.5f, 0, 0}), c)
                  .agrees_with(std::exp(-depths[c]), 1e-5));
    // A path that begins in it.
    CHECK(mean_radiance(tracer, 20000, 4, along_x({0, 0, 0}), 1)
              .agrees_with(std::exp(-0.5), 1e-5));
}

TEST_CASE("fog: it dims the shadow rays of surfaces") {
    Scene<Shapes<Quad>, Materials<Lambertian>, Lights<PointLight>, Media<Fog<Box>>>
        scene;
    scene.add(Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}},
              scene.add(Lambertian{.albedo = Rgb{0.5f}}));
    scene.add(PointLight{.position{0, 4, 3}, .intensity = Rgb{100}});
    scene.add(Fog<Box>{.region{{-5, 1, -5}, {5, 2, 5}}, .absorption = Rgb{0.4f}});
    const World world(std::move(scene));
    const PathTracer tracer(world, {.max_depth = 1});
    const auto down = [](RandomStream&) {
        return Ray{.origin{0, 3, 0}, .direction{0, -1, 0}};
    };
    // Up to the camera 1 unit of fog, up to the light 5/4: it stands 4 high, 5 away.
    const double truth = 0.5 / pi * 100 / 25 * 4 / 5 * std::exp(-0.4 * (1 + 1.25));
    CHECK(mean_radiance(tracer, 20000, 5, down).agrees_with(truth, 1e-4));
}

TEST_CASE("fog: glass keeps it out") {
    Balls scene = glowing_room();
    const auto air = scene.add(Glass{.index = 1});
    scene.add(Sphere{.center{0, 0, 0}, .radius = 0.5f}, air);
    // A ball within the ball.
    scene.add(Sphere{.center{0.1f, 0, 0}, .radius = 0.2f}, air);
    scene.add(Fog<Sphere>{.region{.radius = 3}, .absorption = Rgb{0.5f}});
    const World world(std::move(scene));
    const PathTracer tracer(world);
    const auto seen = [&](float x) {
        return mean_radiance(tracer, 20000, 6, along_x({x, 0, 0}));
    };
    CHECK(seen(-1).agrees_with(std::exp(-0.5 * 2), 1e-4));
    // Paths that begin in glass, and in the ball within it.
    CHECK(seen(-0.3f).agrees_with(std::exp(-0.5 * 1.5), 1e-4));
    CHECK(seen(0.1f).agrees_with(std::exp(-0.5 * 1.5), 1e-4));
}

TEST_CASE("fog: under a sky a ball of fog sends on what it does not absorb") {
    // The mean over rays that arrive like the light of the sky is the part of photons
    // that leave the ball again, by an independent walk in double.
    constexpr double radius = 1.2, absorb = 0.3, scatter = 1.1, g = 0.5;
    Mean walk;
    auto stream = random_stream(8, Pass::user, 0, 0);
    const auto next = [&] { return next_1d<double>(stream); };
    const auto start = [&](double& x, glm::dvec3& from, glm::dvec3& way) {
        x = radius * std::sqrt(next());
        from = {x, 0, -std::sqrt(radius * radius - x * x)};
        way = {0, 0, 1};
    };
    for (int i = 0; i < 40000; ++i) {
        glm::dvec3 at, way;
        double x = 0, weight = 1;
        start(x, at, way);
        for (;;) {
            at += -std::log(1 - next()) / (absorb + scatter) * way;
            if (glm::length(at) > radius) break;
            weight *= scatter / (absorb + scatter);
            const double q = (1 - g * g) / (1 - g + 2 * g * next());
            const double c = (1 + g * g - q * q) / (2 * g);
            const double phi = 2 * pi * next(), s = std::sqrt(1 - c * c);
            glm::dvec3 a = glm::cross(way, std::abs(way.x) < 0.5 ? glm::dvec3{1, 0, 0}
                                                                 : glm::dvec3{0, 1, 0});
            a = glm::normalize(a);
            way = s * std::cos(phi) * a + s * std::sin(phi) * glm::cross(way, a) +
                  c * way;
            way = glm::normalize(way);
        }
        walk.add(weight);
    }
    for (const bool scatters : {true, false}) {
        Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<EnvironmentLight>,
              Media<Fog<Sphere>>>
            scene;
        scene.add(Sphere{.center{9, 9, 9}, .radius = 0.01f}, scene.add(Lambertian{}));
        scene.add(EnvironmentLight{.picture = make_image<float>(1, 1, Rgb{1})});
        scene.add(Fog<Sphere>{.region{.radius = float(radius)},
                              .absorption = Rgb{float(absorb)},
                              .scattering = Rgb{scatters ? float(scatter) : 0},
                              .g = float(g)});
        const World world(std::move(scene));
        const PathTracer tracer(world);
        const auto ray = [&](RandomStream& numbers) {
            const float off = float(radius) * std::sqrt(next_1d<float>(numbers));
            return Ray{.origin{off, 0, -4}, .direction{0, 0, 1}};
        };
        const Mean seen = mean_radiance(tracer, 40000, 7, ray);
        const double tau = absorb * radius; // without scattering it is a closed form
        if (scatters)
            CHECK(std::abs(ljus_test::apart(seen, walk)) < 5);
        else
            CHECK(seen.agrees_with(
                (1 - (1 + 2 * tau) * std::exp(-2 * tau)) / (2 * tau * tau), 1e-4));
    }
}

TEST_CASE("fog: a sky from which no light arrives adds nothing") {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<EnvironmentLight, PointLight>,
          Media<Fog<Box>>>
        scene;
    const Lambertian grey{.albedo = Rgb{0.5f}};
    scene.add(Sphere{}, scene.add(grey));
    scene.add(EnvironmentLight{});
    scene.add(PointLight{.position{0, 0, 2}, .intensity = Rgb{3}});
    scene.add(Fog<Box>{.region{{-999, -999, -999}, {999, 999, 999}},
                       .absorption = Rgb{0.5f}});
    const World world(std::move(scene));
    auto stream = random_stream(1, Pass::user, 0, 0);
    PathState path{.ray{.origin{0, 0, 1.5f}, .direction{0, 0, -1}}};
    const auto vertex = next_vertex(world, path, stream);
    REQUIRE(vertex);
    Counts counts;
    auto context = context_of(stream, counts);
    const Rgb seen =
        sample_all_lights(world, *vertex, grey, {DirectLight::mis}, context);
    CHECK(double(seen.y) ==
          doctest::Approx(0.5 * std::numbers::inv_pi * 3 * std::exp(-0.5)));
}

TEST_CASE("fog: every way to find its light has the same mean in a room") {
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian>, Lights<>, Media<Fog<Box>>> scene;
    add_cornell_walls(scene);
    scene.add(Sphere{.center{0.2f, 1.5f, 0}, .radius = 0.15f},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{8});
    scene.add(Fog<Box>{.region{{-1, 0, -1}, {1, 2, 1}},
                       .absorption{0, 0.1f, 0.3f},
                       .scattering{0.4f, 0.6f, 1.5f},
                       .g = 0.4f});
    const World world(std::move(scene));
    const auto ray = [](RandomStream& numbers) {
        const Vec2 u = next_2d<float>(numbers);
        return Ray{.origin{0, 1, 4},
                   .direction =
                       glm::normalize(Vec3{1.8f * u.x - 0.9f, 1.8f * u.y - 0.9f, -4})};
    };
    for (int c = 0; c < 3; c += 2) {
        // No shadow rays at all: only the weights of nothing can be wrong.
        const Mean truth = mean_radiance(PathTracer(world, {.sample_lights = false}),
                                         60000, 9, ray, c);
        for (const FogLight how : ways)
            for (const auto heuristic : {MisHeuristic::balance, MisHeuristic::power,
                                         MisHeuristic::shadow_rays}) {
                CAPTURE(int(how));
                CAPTURE(int(heuristic));
                const Mean mean = mean_radiance(
                    PathTracer(world, {.heuristic = heuristic, .fog = how}), 8000, 10,
                    ray, c);
                CHECK(std::abs(ljus_test::apart(mean, truth)) < 5);
            }
    }
}

TEST_CASE(
    "fog: a scene that lists fog and has none is the scene without, to the byte") {
    const auto picture = []<typename... F>(Media<F...>) {
        Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>, Lights<>, Media<F...>>
            scene;
        add_cornell_walls(scene);
        scene.add(Sphere{.center{0, 0.5f, 0}, .radius = 0.5f},
                  scene.add(Glass{.absorption{0.1f, 0.2f, 0.4f}}));
        scene.add(Sphere{.center{0, 1.6f, 0}, .radius = 0.1f}, scene.add(Lambertian{}),
                  Rgb{9});
        const World world(std::move(scene));
        return render(PathTracer(world), cornell_camera(),
                      {.width = 12, .height = 12, .samples = 4})
            .image.pixels;
    };
    CHECK(picture(Media<>{}) == picture(Media<Fog<Sphere>, Fog<Box>>{}));
}

TEST_CASE("fog: from none to as dense as rock, pictures hold") {
    for (const float dense : {0.0f, 1e-20f, 1e6f}) {
        CAPTURE(dense);
        Balls scene = glowing_room();
        scene.add(PointLight{.position{0, 1, 0}});
        scene.add(
            Fog<Sphere>{.region{.radius = 1.5f}, .scattering{dense, dense / 2, 0}});
        const World world(std::move(scene));
        for (const FogLight how : ways) {
            const PathTracer tracer(world, {.max_depth = 50, .fog = how});
            for (int c = 0; c < 3; ++c) {
                const Mean mean =
                    mean_radiance(tracer, 300, 12, along_x({-1, 0, 0}), c);
                CHECK(std::isfinite(mean.mean));
                CHECK(mean.mean >= 0);
                if (dense < 1 || c == 2) CHECK(mean.agrees_with(1, 1e-5));
            }
        }
    }
}

TEST_CASE("fog: what is wrong is refused by name and value") {
    constexpr float infinite = std::numeric_limits<float>::infinity();
    const auto why = [](const Fog<Box>& fog) {
        Balls scene;
        return refusal([&] { scene.add(fog); });
    };
    const Box unit{{0, 0, 0}, {1, 1, 1}};
    CHECK(why({.region = unit}) == "");
    CHECK(
        why({.region = unit, .absorption{0, infinite, 0}}) ==
        "fog.absorption is (0, infinity, 0); it must be finite and at least 0 in every "
        "channel.");
    CHECK(
        why({.region = unit, .scattering{-1, 0, 0}}).starts_with("fog.scattering is"));
    CHECK(
        why({.region = unit, .scattering{NAN, 0, 0}}).starts_with("fog.scattering is"));
    CHECK(why({.region = unit, .absorption = Rgb{3e38f}, .scattering = Rgb{3e38f}})
              .starts_with("the sum of fog.absorption and fog.scattering is"));
    CHECK(why({.region = unit, .g = 1}) ==
          "fog.g is 1; it must be within [-0.99, 0.99].");
    CHECK(why({.region = unit, .g = NAN}).starts_with("fog.g is"));
    CHECK(why({.region{{0, 0, 0}, {1, 0, 1}}}).starts_with("fog.region.high is"));
    CHECK(why({.region{}}).starts_with("fog.region.low is"));
    Balls scene;
    CHECK(refusal([&] {
              scene.add(Fog<Sphere>{.region{.radius = -1}});
          }).starts_with("fog.region.radius is -1"));
    // A world checks again what was changed in place.
    scene = glowing_room();
    scene.add(Fog<Sphere>{});
    std::get<0>(scene.media)[0].g = 2;
    CHECK(refusal([&] { (void)World(scene); }).starts_with("fog.g is 2"));
}

TEST_CASE("fog: what does not carry it says so") {
    Balls scene = glowing_room();
    scene.add(Fog<Sphere>{.scattering = Rgb{1}});
    const World world(std::move(scene));
    const Camera camera = look_at({.position{0, 0, 1}, .target{0, 0, 0}});
    const RenderSettings small{.width = 2, .height = 2, .samples = 1};
    const std::string sentence =
        "the scene has fog, and light in fog is not computed by this renderer; render "
        "it by path tracing, or remove the fog.";
    CHECK(refusal([&] { (void)render(WhittedTracer(world), camera, small); }) ==
          sentence);
    const WhittedTracer whitted(world);
    const PathTracer paths(world);
    CHECK(refusal([&] { (void)render(OnlyPaths(whitted, "EL"), camera, small); }) ==
          sentence);
    CHECK(refusal([&] { (void)render(OnlyPaths(paths, "EL"), camera, small); }) == "");
    CHECK(refusal([&] { (void)make_patches(world); }).find("by radiosity;") !=
          std::string::npos);
    CHECK(refusal([&] {
              (void)render(FirstHitRenderer(world, FirstHit::depth), camera, small);
              (void)render(PathTracer(world), camera, small);
          }) == "");
    CHECK(path_remarks(world).empty());

    Scene<Shapes<Sphere>, Materials<Lambertian, SoapFilm>, Lights<>, Media<Fog<Sphere>>>
        bubble;
    bubble.add(Sphere{}, bubble.add(SoapFilm{}));
    CHECK(refusal([&] {
              const World clear(bubble);
              (void)PathTracer(clear);
          }) == "");
    bubble.add(Fog<Sphere>{});
    const World both(std::move(bubble));
    CHECK(refusal([&] {
              (void)PathTracer(both);
          }).starts_with("the scene has both fog and thin surfaces"));
}
