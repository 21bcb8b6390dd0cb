/// \file emission_test.cpp
/// \brief Photons that leave lights against irradiance and form factors worked out on
/// paper.
///
/// Counts are held against chi-square, which gives a false alarm once in a million;
/// means within 4.5 standard errors, once in 150 000. All statistical cases but one,
/// whose seeds are fixed, were run with 20 further seeds: none failed. For others:
/// `./scripts/test --seeds 20`.

#include "ljus/photons/aiming.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <numbers>
#include <utility>
#include <vector>

#include "ljus/geometry/shape.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/lights/spot_light.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/scene/world.hpp"
#include "support/closed_forms.hpp"
#include "support/integrate.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::integrate;
using ljus_test::Mean;
using D3 = glm::dvec3; ///< What the closed forms are computed with.

namespace {

constexpr double pi = std::numbers::pi;
using TestScene = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass, Mirror>,
                        Lights<PointLight, SpotLight, SunLight>>;
using TestWorld = World<TestScene>;

/// A scene with its materials at hand.
struct Stage {
    TestScene scene;
    MaterialId matt = scene.add(Lambertian{});
    MaterialId glass = scene.add(Glass{});
    MaterialId mirror = scene.add(Mirror{});
};

RandomStream stream_of(long long path, std::uint64_t seed = 1) {
    return random_stream(ljus_test::test_seed(seed), Pass::user, 0,
                         static_cast<std::uint64_t>(path));
}

/// A sun, as a world knows it.
template <AnyWorld W>
SunInSceneT<float> sun_of(const W& world, std::uint32_t number) {
    return world.visit_light(number, []<typename L>(const L& light) {
        if constexpr (std::is_same_v<L, SunInSceneT<float>>)
            return light;
        else
            return SunInSceneT<float>{};
    });
}

/// How a point of a light aims at an object.
template <AnyWorld W>
detail::AimT<float> aim_of(const W& world, std::uint32_t number,
                           const SurfacePoint& from, ObjectId target) {
    return world.visit_light(number, [&](const auto& light) {
        detail::ConeT<float> cone;
        if constexpr (requires { light.lamp; })
            cone = detail::cone_of_emission(light, from);
        else
            cone = detail::cone_of_emission(light, from.position);
        return detail::aim_at(world, cone, from.position, target);
    });
}

/// A rectangle of light above the floor z = 0, tilted; it shines down.
constexpr Quad lamp{
    .corner{-0.5f, -0.7f, 2.0f}, .edge_u{0, 1.4f, 0.2f}, .edge_v{1, 0, 0.3f}};

/// Lambert's formula: irradiance from a uniform polygon that lies above the horizon.
double polygon_irradiance(const std::array<D3, 4>& polygon, D3 at, D3 normal,
                          double radiance) {
    D3 sum{0};
    for (std::size_t i = 0; i < 4; ++i) {
        const D3 a = glm::normalize(polygon[i] - at);
        const D3 b = glm::normalize(polygon[(i + 1) % 4] - at);
        sum += std::acos(glm::dot(a, b)) * glm::normalize(glm::cross(a, b));
    }
    return radiance / 2 * std::abs(glm::dot(sum, normal));
}

/// Emits photons, and compares where they meet the floor with the irradiance there.
template <typename Irradiance>
void compare_with_irradiance(const TestWorld& world, double flux,
                             Irradiance irradiance) {
    constexpr int cells = 8;
    constexpr double half = 2; // the cells cover [-2, 2]^2
    constexpr long long photons = 200000;
    std::vector<double> counts(cells * cells + 1), expected(cells * cells + 1);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i);
        const auto flight = emit(world, choice, stream);
        REQUIRE(double(flight.flux.x) == doctest::Approx(flux).epsilon(1e-5));
        std::size_t cell = cells * cells; // anywhere else
        if (flight.ray.direction.z < 0) {
            const D3 o{flight.ray.origin}, d{flight.ray.direction};
            const D3 p = o - d * (o.z / d.z);
            const double x = (p.x + half) / (2 * half) * cells;
            const double y = (p.y + half) / (2 * half) * cells;
            if (x >= 0 && x < cells && y >= 0 && y < cells)
                cell = std::size_t(y) * cells + std::size_t(x);
        }
        ++counts[cell];
    }
    double elsewhere = photons;
    for (int y = 0; y < cells; ++y)
        for (int x = 0; x < cells; ++x) {
            const double side = 2 * half / cells;
            const double power =
                integrate(-half + x * side, -half + (x + 1) * side, [&](double px) {
                    return integrate(-half + y * side, -half + (y + 1) * side,
                                     [&](double py) {
                                         return irradiance(D3{px, py, 0});
                                     });
                });
            auto& cell = expected[std::size_t(y * cells + x)];
            cell = photons * power / flux;
            elsewhere -= cell;
        }
    expected.back() = elsewhere;
    const auto result = ljus_test::chi_square(counts, expected);
    CAPTURE(result.sum);
    CHECK(result.cells == cells * cells + 1);
    CHECK(result.sum < result.limit());
}

/// What photons aimed at the targets bring to each of them: flux per photon aimed.
struct AimedFlux {
    std::vector<ObjectId> targets;
    std::vector<std::array<Mean, 3>> means; ///< One a target and channel.
    long long kept = 0;   ///< Photons that met a target of theirs first.
    long long behind = 0; ///< Photons that the lamp could not send.
};
AimedFlux aim_at_all(const TestWorld& world, long long photons,
                     std::uint64_t seed = 1) {
    AimedFlux result{.targets = specular_objects(world), .means = {}};
    result.means.resize(result.targets.size());
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i, seed);
        const auto aimed = aim(world, choice, result.targets, stream);
        std::optional<ObjectId> met;
        if (!aimed) {
            ++result.behind;
        } else if (const auto hit = closest_hit(world, aimed->photon.ray)) {
            const auto& others = aimed->others;
            if (hit->object == aimed->target ||
                std::find(others.begin(), others.end(), hit->object) != others.end())
                met = hit->object;
        }
        if (met) ++result.kept;
        for (std::size_t j = 0; j < result.targets.size(); ++j)
            for (int c = 0; c < 3; ++c)
                result.means[j][std::size_t(c)].add(
                    met == result.targets[j] ? double(aimed->photon.flux[c]) : 0.0);
    }
    return result;
}

/// The flux that photons sent everywhere bring to each target.
std::vector<Mean> emit_to(const TestWorld& world, const std::vector<ObjectId>& targets,
                          long long photons) {
    std::vector<Mean> means(targets.size());
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i, 77);
        const auto flight = emit(world, choice, stream);
        const auto hit = closest_hit(world, flight.ray);
        for (std::size_t j = 0; j < targets.size(); ++j)
            means[j].add(hit && hit->object == targets[j] ? double(flight.flux.x)
                                                          : 0.0);
    }
    return means;
}

/// The flux from a lamp with a normal to a sphere, by quadrature over the lamp's area
/// and the cone in which each of its points sees the sphere.
double quad_to_sphere(const Quad& quad, const Sphere& ball, double radiance,
                      int pieces = 4) {
    const D3 normal = glm::normalize(glm::cross(D3(quad.edge_u), D3(quad.edge_v)));
    const double area = glm::length(glm::cross(D3(quad.edge_u), D3(quad.edge_v)));
    return radiance * area * integrate(0, 1, [&](double u) {
               return integrate(0, 1, [&](double v) {
                   const D3 from =
                       D3(quad.corner) + u * D3(quad.edge_u) + v * D3(quad.edge_v);
                   const D3 way = D3(ball.center) - from;
                   const double d = glm::length(way), sine = double(ball.radius) / d;
                   const double cosine = glm::dot(way, normal) / d;
                   if (cosine >= sine) return pi * sine * sine * cosine; // all above
                   if (cosine <= -sine) return 0.0;
                   // Partly below the horizon: ring by ring around the axis.
                   const double tilt = std::sqrt(1 - cosine * cosine);
                   return integrate(0, std::asin(sine), pieces, [&](double beta) {
                       return integrate(0, pi, pieces, [&](double phi) {
                           return 2 * std::sin(beta) *
                                  std::max(0.0,
                                           std::cos(beta) * cosine +
                                               std::sin(beta) * tilt * std::cos(phi));
                       });
                   });
               });
           });
}

} // namespace

TEST_CASE("emission: photons of a quad lie as densely as its irradiance") {
    Stage stage;
    stage.scene.add(lamp, stage.matt, Rgb{3});
    const D3 c{lamp.corner}, u{lamp.edge_u}, v{lamp.edge_v};
    const std::array polygon{c, c + u, c + u + v, c + v};
    const double flux = 3 * pi * glm::length(glm::cross(u, v));
    compare_with_irradiance(World(stage.scene), flux, [&](D3 at) {
        return polygon_irradiance(polygon, at, {0, 0, 1}, 3);
    });
}

TEST_CASE("emission: photons of a sphere lie as densely as its irradiance") {
    Stage stage;
    stage.scene.add(Sphere{.center{0.3f, -0.2f, 1.5f}, .radius = 0.6f}, stage.matt,
                    Rgb{2});
    const double r = double(0.6f);
    compare_with_irradiance(World(stage.scene), 2 * pi * 4 * pi * r * r, [&](D3 at) {
        const D3 way = D3{double(0.3f), double(-0.2f), 1.5} - at;
        const double d2 = glm::dot(way, way);
        return pi * 2 * r * r / d2 * way.z / std::sqrt(d2); // E = pi L (R/d)^2 cos
    });
}

TEST_CASE("emission: directions go with the cosine, wherever on the lamp they start") {
    Stage stage;
    stage.scene.add(lamp, stage.matt, Rgb{1});
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    const D3 u{lamp.edge_u}, v{lamp.edge_v};
    const D3 n = glm::normalize(glm::cross(u, v));
    const D3 tangent = glm::normalize(u), bitangent = glm::cross(n, tangent);
    constexpr long long photons = 160000;
    std::vector<double> counts(4 * 4 * 10 * 8), expected(counts.size());
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i);
        const RayT<float> ray = emit(world, choice, stream).ray;
        const D3 d{ray.direction}, p = D3(ray.origin) - D3(lamp.corner);
        REQUIRE(std::abs(glm::length(d) - 1) < 1e-6);
        REQUIRE(std::abs(glm::dot(p, n)) < 1e-5); // it starts on the lamp ...
        REQUIRE(glm::dot(p, n) > 0);              // ... but in front of it
        const double cosine = glm::dot(d, n);
        REQUIRE(cosine > 0);
        // Where u.v is not 0, the coordinates along the edges come from a 2 x 2 system.
        const double uu = glm::dot(u, u), vv = glm::dot(v, v), uv = glm::dot(u, v);
        const double pu = glm::dot(p, u), pv = glm::dot(p, v), det = uu * vv - uv * uv;
        const double s = (pu * vv - pv * uv) / det, t = (pv * uu - pu * uv) / det;
        const double phi = std::atan2(glm::dot(d, bitangent), glm::dot(d, tangent));
        const auto bin = [](double x, int bins) {
            return std::size_t(std::clamp(int(x * bins), 0, bins - 1));
        };
        // cos^2 is uniform where the density is cos / pi.
        ++counts[((bin(s, 4) * 4 + bin(t, 4)) * 10 + bin(cosine * cosine, 10)) * 8 +
                 bin(phi / (2 * pi) + 0.5, 8)];
    }
    std::fill(expected.begin(), expected.end(),
              double(photons) / double(counts.size()));
    const auto result = ljus_test::chi_square(counts, expected);
    CAPTURE(result.sum);
    CHECK(result.sum < result.limit());
}

TEST_CASE("emission: a point light emits alike in all directions") {
    Stage stage;
    stage.scene.add(PointLight{.position{1, 2, 3}});
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    std::vector<double> counts(20 * 20);
    constexpr long long photons = 80000;
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i);
        const RayT<float> ray = emit(world, choice, stream).ray;
        REQUIRE(ray.origin == Vec3{1, 2, 3});
        const D3 d{ray.direction};
        const int z = std::clamp(int((d.z + 1) * 10), 0, 19);
        const int phi = std::clamp(int((std::atan2(d.y, d.x) / pi + 1) * 10), 0, 19);
        ++counts[std::size_t(z * 20 + phi)];
    }
    const std::vector<double> expected(400, photons / 400.0);
    const auto result = ljus_test::chi_square(counts, expected);
    CHECK(result.sum < result.limit());
}

TEST_CASE("emission: a room that is a lamp emits inwards") {
    Stage stage;
    const Vec3 center{1, -2, 0.5f}; // not what it would be mirrored about
    stage.scene.add(Sphere{.center = center, .radius = 2}, stage.matt, Rgb{1}, true);
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < 2000; ++i) {
        RandomStream stream = stream_of(i);
        const RayT<float> ray = emit(world, choice, stream).ray;
        const double distance = glm::distance(D3(ray.origin), D3(center));
        REQUIRE(distance < 2);
        REQUIRE(distance > 1.9999);
        REQUIRE(glm::dot(ray.origin - center, ray.direction) < 0);
    }
}

TEST_CASE("emission: lights are chosen by their power, and keep their colours") {
    Stage stage;
    stage.scene.add(lamp, stage.matt, Rgb{1, 0.5f, 0});
    stage.scene.add(PointLight{.intensity{0, 0.1f, 0.4f}});
    stage.scene.add(Sphere{.center{5, 0, 0}, .radius = 0.5f}, stage.matt, Rgb{0.2f});
    const double area = glm::length(glm::cross(D3(lamp.edge_u), D3(lamp.edge_v)));
    const std::array<D3, 3> flux{pi * area * D3{1, 0.5, 0},
                                 4 * pi * D3{0, double(0.1f), double(0.4f)},
                                 pi * pi * D3{double(0.2f)}};
    std::array<double, 3> expected{}, counts{};
    double power = 0;
    for (const D3& f : flux) power += f.x + f.y + f.z;

    constexpr long long photons = 60000;
    for (std::size_t i = 0; i < 3; ++i)
        expected[i] = photons * (flux[i].x + flux[i].y + flux[i].z) / power;
    D3 sum{0};
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < photons; ++i) {
        RandomStream stream = stream_of(i);
        const auto flight = emit(world, choice, stream);
        REQUIRE(flight.light < 3);
        ++counts[flight.light];
        sum += D3(flight.flux) / double(photons);
        // Every photon carries the same power, in the colours of its light.
        const D3 f =
            flux[flight.light] * (power / (flux[flight.light].x + flux[flight.light].y +
                                           flux[flight.light].z));
        for (int c = 0; c < 3; ++c)
            REQUIRE(double(flight.flux[c]) == doctest::Approx(f[c]).epsilon(1e-5));
    }
    const auto result = ljus_test::chi_square(counts, expected);
    CHECK(result.sum < result.limit());
    const D3 total = flux[0] + flux[1] + flux[2];
    for (int c = 0; c < 3; ++c)
        CHECK(sum[c] == doctest::Approx(total[c]).epsilon(0.02));
}

TEST_CASE("emission: aimed at one ball, the plain way and the general one agree") {
    Stage stage;
    const Sphere ball{.center{0.5f, -1, 2}, .radius = 0.75f};
    stage.scene.add(ball, stage.glass);
    const PointLight bulb{.position{-1, 2, 0.5f}, .intensity = Rgb{3, 2, 1}};
    stage.scene.add(bulb);
    const World world(stage.scene);
    const auto targets = specular_objects(world);
    const LightChoice& choice = world.light_choice();
    for (std::uint64_t path = 0; path < 1000; ++path) {
        auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, path);
        auto again = stream;
        const auto aimed = aim(world, choice, targets, stream);
        REQUIRE(aimed);
        (void)next_1d(again); // the light, the point of it, the target
        (void)next_2d(again);
        (void)next_1d(again);
        const auto plain = aim_at_ball(bulb, ball, next_2d(again));
        REQUIRE(plain.ray.direction == aimed->photon.ray.direction);
        REQUIRE(glm::distance(plain.flux, aimed->photon.flux) <
                1e-6f * glm::length(plain.flux));
        REQUIRE(intersect(plain.ray, ball));
    }
}

TEST_CASE(
    "emission: what is mirror or glass, or in part, is what photons are aimed at") {
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass, Mirror, Mixture>> scene;
    CHECK(specular_objects(World(scene)).empty());
    scene.add(Sphere{}, scene.add(Lambertian{}));
    const ObjectId ball = scene.add(Sphere{}, scene.add(Glass{}));
    const ObjectId mixed =
        scene.add(Sphere{}, scene.add(Mixture{.reflectivity = 0.5f}));
    const ObjectId wall = scene.add(lamp, scene.add(Mirror{}));
    CHECK(specular_objects(World(scene)) == std::vector<ObjectId>{wall, ball, mixed});
}

TEST_CASE(
    "emission: aimed at a sphere by a point light, each photon carries its cone") {
    for (const float distance : {1.0001f, 1.5f, 3.0f, 1000.0f}) {
        CAPTURE(distance);
        Stage stage;
        stage.scene.add(Sphere{.center{0, distance, 0}}, stage.glass);
        stage.scene.add(PointLight{.intensity = Rgb{7}});
        const AimedFlux found = aim_at_all(World(stage.scene), 20000);
        // Phi (1 - cos) / 2, where 1 - cos is sin^2 / (1 + cos).
        const double sine2 = 1 / (double(distance) * double(distance));
        const double exact = 4 * pi * 7 * sine2 / (1 + std::sqrt(1 - sine2)) / 2;
        CHECK(found.means[0][0].mean == doctest::Approx(exact).epsilon(1e-3));
        CHECK(found.kept >= 19990); // the rest grazed it
    }
}

TEST_CASE("emission: aimed at a sphere by a quad, from far, near and the horizon") {
    for (const Vec3 center :
         {Vec3{0, 0, -6}, Vec3{0.3f, 0.2f, 0.8f}, Vec3{2.5f, 0, 2.0f}, Vec3{2, 1, 2.8f},
          Vec3{-3, 0.5f, 1}}) {
        CAPTURE(center.x);
        CAPTURE(center.z);
        Stage stage;
        const Sphere ball{.center = center, .radius = 0.7f};
        stage.scene.add(ball, stage.glass);
        stage.scene.add(lamp, stage.matt, Rgb{2});
        const AimedFlux found = aim_at_all(World(stage.scene), 60000);
        const double exact = quad_to_sphere(lamp, ball, 2);
        CAPTURE(exact);
        CHECK(std::abs(found.means[0][0].sigmas(exact, 1e-4)) < 4.5);
        // Sharp enough to see a few percent.
        const Mean& mean = found.means[0][0];
        CHECK(std::sqrt(mean.variance() / mean.count) < 0.02 * exact);
    }
}

TEST_CASE("emission: where cones overlap, each object gets what it is hit by first") {
    Stage stage;
    const ObjectId near =
        stage.scene.add(Sphere{.center{0, 0, -3}, .radius = 0.5f}, stage.glass);
    const ObjectId far =
        stage.scene.add(Sphere{.center{0.4f, 0, -6}, .radius = 1.5f}, stage.mirror);
    const ObjectId beside = stage.scene.add(Sphere{.center{0, 4, 0}}, stage.glass);
    stage.scene.add(PointLight{});
    const AimedFlux found = aim_at_all(World(stage.scene), 100000);
    REQUIRE(found.targets == std::vector<ObjectId>{near, far, beside});

    // The far ball shows a crescent beside the near one: count it on a fine grid.
    const D3 axis_near{0, 0, -1}, axis_far = glm::normalize(D3{double(0.4f), 0, -6});
    const double cos_near = std::sqrt(1 - 0.25 / 9);
    const double d2 = 36 + double(0.4f) * double(0.4f);
    const double cos_far = std::sqrt(1 - 2.25 / d2);
    const D3 side = glm::normalize(glm::cross(axis_far, D3{0, 1, 0}));
    const D3 up = glm::cross(side, axis_far);
    constexpr int steps = 1500;
    double visible = 0;
    for (int i = 0; i < steps; ++i)
        for (int j = 0; j < steps; ++j) {
            const double z = 1 - (1 - cos_far) * (i + 0.5) / steps;
            const double phi = 2 * pi * (j + 0.5) / steps;
            const double r = std::sqrt(1 - z * z);
            const D3 d =
                z * axis_far + r * std::cos(phi) * side + r * std::sin(phi) * up;
            if (glm::dot(d, axis_near) < cos_near) ++visible;
        }
    visible /= double(steps) * steps;

    const double flux = 4 * pi;
    CHECK(std::abs(found.means[0][0].sigmas(flux * (1 - cos_near) / 2)) < 4.5);
    CHECK(std::abs(found.means[1][0].sigmas(flux * (1 - cos_far) / 2 * visible, 1e-4)) <
          4.5);
    CHECK(std::abs(found.means[2][0].sigmas(flux * (1 - std::sqrt(15.0 / 16)) / 2)) <
          4.5);
    CHECK(visible < 0.9); // the case is one of overlap
}

TEST_CASE(
    "emission: a lamp within the bound of its target aims at its whole hemisphere") {
    // Two unit squares face each other; the corners of the lamp are outside of the
    // mirror's bound, its middle inside.
    for (const double c : {0.1, 0.4, 0.6}) {
        CAPTURE(c);
        Stage stage;
        stage.scene.add(Quad{.corner{-0.5f, -0.5f, 0}}, stage.mirror);
        stage.scene.add(
            Quad{.corner{-0.5f, -0.5f, float(c)}, .edge_u{0, 1, 0}, .edge_v{1, 0, 0}},
            stage.matt, Rgb{1});
        const double factor = ljus_test::form_factor_facing(1, 1, double(float(c)));
        const AimedFlux found = aim_at_all(World(stage.scene), 100000);
        CHECK(std::abs(found.means[0][0].sigmas(pi * factor, 1e-4)) < 4.5);
    }
}

TEST_CASE("emission: at a flat mirror no photon is aimed in vain") {
    // A long mirror, seen almost from its edge and from its side. The solid angle of a
    // rectangle over a corner of it: asin(a b / (sqrt(a^2 + h^2) sqrt(b^2 + h^2))).
    for (const float height : {0.02f, 0.5f, 5.0f})
        for (const float beside : {0.1f, 2.0f}) {
            CAPTURE(height);
            CAPTURE(beside);
            Stage stage;
            stage.scene.add(
                Quad{.corner{beside, 0, 0}, .edge_u{4, 0, 0}, .edge_v{0, 0.5f, 0}},
                stage.mirror);
            stage.scene.add(PointLight{.position{0, 0, height}});
            const auto corner = [&](double a, double b) {
                const double h2 = double(height) * double(height);
                return std::asin(a * b / std::sqrt((a * a + h2) * (b * b + h2)));
            };
            const double right =
                corner(double(beside + 4), 0.5) - corner(double(beside), 0.5);
            const AimedFlux found = aim_at_all(World(stage.scene), 40000);
            CHECK(std::abs(found.means[0][0].sigmas(right, 1e-4)) < 4.5);
            const bool outside = beside > 1 || height > 3; // of the bounding sphere
            if (outside) CHECK(found.kept >= 39900);
        }
}

TEST_CASE("emission: a point light within the bound aims everywhere") {
    Stage ball;
    ball.scene.add(Sphere{.center{0.2f, 0, 0}}, ball.glass);
    ball.scene.add(PointLight{});
    const AimedFlux inside = aim_at_all(World(ball.scene), 5000);
    CHECK(inside.kept == 5000);
    CHECK(inside.means[0][1].mean == doctest::Approx(4 * pi).epsilon(1e-5));

    Stage wall;
    wall.scene.add(Quad{.corner{-0.5f, -0.5f, 0}}, wall.mirror);
    wall.scene.add(PointLight{.position{0, 0, 0.25f}});
    // The solid angle of a square from above its middle: 4 asin(1 / (1 + 4 h^2)).
    const double solid_angle = 4 * std::asin(1 / (1 + 4 * 0.25 * 0.25));
    CHECK(
        std::abs(aim_at_all(World(wall.scene), 50000).means[0][0].sigmas(solid_angle)) <
        4.5);
}

TEST_CASE("emission: a shell of light sends a ball within it the share (r/R)^2") {
    for (const float r : {0.1f, 0.9f}) {
        Stage stage;
        stage.scene.add(Sphere{.radius = 2}, stage.matt, Rgb{1}, true);
        stage.scene.add(Sphere{.radius = r}, stage.glass);
        const double flux = pi * 4 * pi * 4;
        const double share = double(r) * double(r) / 4;
        CHECK(std::abs(aim_at_all(World(stage.scene), 30000)
                           .means[0][0]
                           .sigmas(flux * share)) < 4.5);
    }
}

TEST_CASE("emission: what lies behind the lamp, or a wall, gets nothing") {
    Stage stage;
    stage.scene.add(lamp, stage.matt, Rgb{1});
    stage.scene.add(Sphere{.center{0, 0, 6}}, stage.glass);
    const AimedFlux found = aim_at_all(World(stage.scene), 5000);
    CHECK(found.kept == 0);
    CHECK(found.behind == 5000);
    CHECK(found.means[0][0].mean == 0);

    Stage hidden;
    hidden.scene.add(lamp, hidden.matt, Rgb{1});
    hidden.scene.add(Quad{.corner{-9, -9, 1.5f}, .edge_u{18, 0, 0}, .edge_v{0, 18, 0}},
                     hidden.matt);
    hidden.scene.add(Sphere{.center{0, 0, 0}}, hidden.glass);
    CHECK(aim_at_all(World(hidden.scene), 5000).kept == 0);
}

TEST_CASE("emission: one point of the square says where on a light, the other where "
          "to") {
    // Lights, and what each of the two points decides: a lamp has both, a sun is
    // parallel, points and spots are but a point.
    struct Case {
        std::uint32_t light;
        bool origin_by_point, direction_by_direction;
    };
    Stage stage;
    stage.scene.add(lamp, stage.matt, Rgb{1});
    stage.scene.add(PointLight{.position{0, 0, 3}, .intensity{1, 0, 0}});
    stage.scene.add(SpotLight{.position{0, 0, 3}, .intensity{1, 0, 0}});
    stage.scene.add(SunLight{.irradiance{1, 1, 1}});
    const World world(stage.scene);
    const Vec2 a{0.2f, 0.3f}, b{0.7f, 0.6f};
    for (const Case& c : {Case{0, true, true}, Case{1, false, true},
                          Case{2, false, true}, Case{3, true, false}}) {
        CAPTURE(c.light);
        const auto ray = [&](const Vec2& point, const Vec2& direction) {
            return world.visit_light(c.light, [&](const auto& light) {
                return emit_photon(light, point, direction, 0.0f).ray;
            });
        };
        const auto first = ray(a, b), moved = ray(b, b), turned = ray(a, a);
        CHECK((moved.origin != first.origin) == c.origin_by_point);
        CHECK(moved.direction == first.direction);
        CHECK((turned.direction != first.direction) == c.direction_by_direction);
        // A ray starts a rounding error away from the surface, on the side of its
        // direction.
        CHECK(glm::distance(turned.origin, first.origin) < 1e-5f);
    }
}

TEST_CASE("emission: a photon knows its light among hundreds") {
    Stage stage;
    for (int i = 0; i < 600; ++i)
        stage.scene.add(PointLight{.position{float(i), 0, 0}, .intensity{1, 1, 1}});
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    int beyond = 0;
    for (long long i = 0; i < 200; ++i) {
        RandomStream stream = stream_of(i);
        const auto flight = emit(world, choice, stream);
        CHECK(flight.ray.origin.x == float(flight.light));
        beyond += flight.light > 255;
    }
    CHECK(beyond > 0);
}

TEST_CASE("emission: the light of an aimed photon has its colour and its number") {
    Stage stage;
    stage.scene.add(PointLight{.position{0, 0, 3}, .intensity{1, 0, 0}});
    stage.scene.add(PointLight{.position{0, 0, -3}, .intensity{0, 2, 0}});
    stage.scene.add(Sphere{}, stage.glass);
    const AimedFlux found = aim_at_all(World(stage.scene), 50000);
    const double cap = 2 * pi * (1 - std::sqrt(8.0) / 3); // solid angle of the ball
    CHECK(std::abs(found.means[0][0].sigmas(cap)) < 4.5);
    CHECK(std::abs(found.means[0][1].sigmas(2 * cap)) < 4.5);
    CHECK(found.means[0][2].mean == 0);
    const World world(stage.scene);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < 100; ++i) {
        RandomStream stream = stream_of(i);
        const auto aimed = aim(world, choice, found.targets, stream);
        REQUIRE(aimed);
        CHECK((aimed->photon.flux.x > 0) == (aimed->photon.light == 0));
        CHECK((aimed->photon.flux.y > 0) == (aimed->photon.light == 1));
    }
}

namespace {

/// A scene with one light and a black floor z = 0 of [-2, 2]^2 below it.
using LitFloor = Scene<Shapes<Quad, Sphere, Triangle>, Materials<Lambertian>,
                       Lights<PointLight, SpotLight, SunLight>>;

LitFloor lit_floor() {
    LitFloor scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{.corner{-2, -2, 0}, .edge_u{4, 0, 0}, .edge_v{0, 4, 0}}, black);
    return scene;
}

/// What the photons of many seeds bring to the patch [0, 0.8] x [-0.2, 0.5] of the
/// floor; one number a seed.
template <typename MakeStream>
Mean flux_on_patch(const World<LitFloor>& world, MakeStream make_stream) {
    const LightChoice& choice = world.light_choice();
    Mean mean;
    constexpr int photons = 4096;
    for (std::uint64_t seed = 1; seed <= 16; ++seed) {
        double sum = 0;
        for (std::uint64_t i = 0; i < photons; ++i) {
            auto stream = make_stream(seed, i);
            const auto flight = emit(world, choice, stream);
            const auto hit = closest_hit(world, flight.ray);
            if (!hit || hit->object != ObjectId{0, 0}) continue;
            const Vec3 p = flight.ray.origin + hit->at.t * flight.ray.direction;
            if (p.x >= 0 && p.x < 0.8f && p.y >= -0.2f && p.y < 0.5f)
                sum += double(flight.flux.x) / photons;
        }
        mean.add(sum);
    }
    return mean;
}

/// The same by quadrature.
template <typename Irradiance>
double patch_integral(Irradiance irradiance, int pieces = 1) {
    return integrate(0, 0.8, pieces, [&](double x) {
        return integrate(-0.2, 0.5, pieces, [&](double y) {
            return irradiance(D3{x, y, 0});
        });
    });
}

} // namespace

TEST_CASE(
    "emission: triangles, spots and suns bring their irradiance to a floor, by chance "
    "and evenly spread") {
    // 3 standard errors of 16 seeds: Student's t with 15 degrees puts 0.9 % beyond; 12
    // numbers, were the seeds new, 10 %.
    const auto compare = [](const char* name, const LitFloor& scene, double right) {
        const World world(scene);
        const Mean chance = flux_on_patch(world, [](auto seed, auto i) {
            return random_stream(seed, Pass::user, 0, i);
        });
        const Mean even = flux_on_patch(world, [](auto seed, auto i) {
            return sobol_stream(seed, Pass::user, 0, i);
        });
        CAPTURE(name);
        CAPTURE(right);
        CAPTURE(chance.mean);
        CAPTURE(even.mean);
        CHECK(std::abs(chance.sigmas(right)) < 3);
        CHECK(std::abs(even.sigmas(right)) < 3);
        CHECK(std::sqrt(chance.variance() / 16) < 0.1 * right);
        // And the even ones are known better, by far.
        CHECK(even.variance() < 0.5 * chance.variance());
    };
    {
        LitFloor scene = lit_floor();
        const D3 a{-0.5, -0.6, 1}, b{0.1, 0.9, 1.3}, c{0.9, -0.4, 0.8};
        scene.add(Triangle{Vec3(a), Vec3(b), Vec3(c)}, scene.add(Lambertian{}), Rgb{1});
        compare(
            "triangle", scene, patch_integral([&](D3 at) {
                return polygon_irradiance({a, b, c, (c + a) / 2.0}, at, {0, 0, 1}, 1);
            }));
    }
    const D3 above{0.3, -0.4, 1.2};
    for (const double inner : {0.0, 15.0, 30.0}) {
        LitFloor scene = lit_floor();
        const D3 axis = glm::normalize(D3{0.1, 0.3, -1});
        scene.add(SpotLight{.position = Vec3(above),
                            .direction{0.3f, 0.9f, -3},
                            .intensity = Rgb{2},
                            .inner_degrees = float(inner),
                            .outer_degrees = 30});
        compare("spot", scene,
                patch_integral(
                    [&](D3 at) {
                        const D3 way = above - at;
                        const double d = glm::length(way);
                        const double ci = std::cos(inner * pi / 180);
                        const double co = std::cos(30 * pi / 180);
                        const double c = -glm::dot(way, axis) / d;
                        const double share = c >= ci  ? 1
                                             : c > co ? (c - co) / (ci - co)
                                                      : 0;
                        return share * 2 * way.z / (d * d * d);
                    },
                    60));
    }
    for (const Vec3 way : {Vec3{0, 0, -1}, Vec3{1, 2, -1}}) {
        LitFloor scene = lit_floor();
        scene.add(SunLight{.direction = way, .irradiance = Rgb{5}});
        const double cosine = 1 / glm::length(D3(way));
        compare("sun", scene, 5 * cosine * 0.8 * 0.7);
    }
}

TEST_CASE("emission: a spot light's directions go with its intensity, in cones of any "
          "width") {
    for (const auto& cone :
         {std::pair{0.0, 30.0}, std::pair{20.0, 30.0}, std::pair{60.0, 60.0},
          std::pair{0.0, 180.0}, std::pair{179.0, 180.0}, std::pair{0.02, 0.1}}) {
        const double inner = cone.first, outer = cone.second;
        Stage stage;
        const D3 axis = glm::normalize(D3{1, -2, 0.5});
        stage.scene.add(SpotLight{.position{1, 2, 3},
                                  .direction{2, -4, 1},
                                  .intensity = Rgb{3},
                                  .inner_degrees = float(inner),
                                  .outer_degrees = float(outer)});
        const auto lifted = [](double degrees) {
            const double sine = std::sin(degrees * pi / 360);
            return 2 * sine * sine; // 1 - cos
        };
        const double wi = lifted(inner), wo = lifted(outer);
        const World world(stage.scene);
        const LightChoice& choice = world.light_choice();
        CHECK(double(world.powers()[0].x) ==
              doctest::Approx(3 * pi * (wi + wo)).epsilon(1e-5));
        const D3 side = glm::normalize(glm::cross(axis, D3{0, 0, 1}));
        const D3 up = glm::cross(side, axis);
        constexpr int rings = 12, slices = 8, photons = 60000;
        std::vector<double> counts(rings * slices), expected(counts.size());
        for (long long i = 0; i < photons; ++i) {
            RandomStream stream = stream_of(i);
            const auto flight = emit(world, choice, stream);
            REQUIRE(flight.ray.origin == Vec3{1, 2, 3});
            const D3 d = glm::normalize(D3(flight.ray.direction)) - axis;
            const double w = glm::dot(d, d) / 2;
            REQUIRE(w < wo * (1 + 1e-3) + 1e-9);
            const int ring = std::min(rings - 1, int(w / wo * rings));
            const double phi = std::atan2(glm::dot(d, up), glm::dot(d, side));
            const int slice =
                std::clamp(int((phi / (2 * pi) + 0.5) * slices), 0, slices - 1);
            ++counts[std::size_t(ring * slices + slice)];
        }
        for (int ring = 0; ring < rings; ++ring) {
            // The area below the curve from one ring's w to the next, piece by piece.
            const double part = integrate(
                wo * ring / rings, wo * (ring + 1) / rings, 200,
                [&](double w) { return w <= wi ? 1.0 : (wo - w) / (wo - wi); });
            for (int slice = 0; slice < slices; ++slice)
                expected[std::size_t(ring * slices + slice)] =
                    photons * part / ((wi + wo) / 2) / slices;
        }
        const auto result = ljus_test::chi_square(counts, expected);
        CAPTURE(inner);
        CAPTURE(outer);
        CAPTURE(result.sum);
        CHECK(result.sum < result.limit());
    }
}

TEST_CASE(
    "emission: a sun's photons are parallel, even over the scene, and begin before "
    "it; they know what is added later") {
    Stage stage;
    stage.scene.add(SunLight{.direction{0, 0, -3}, .irradiance = Rgb{2}});
    CHECK(World(stage.scene).powers()[0].x == 0.0f); // nothing to shine on yet
    stage.scene.add(Sphere{.center{1, 0, 0}, .radius = 1}, stage.matt);
    const float small = World(stage.scene).powers()[0].x;
    stage.scene.add(Sphere{.center{-1, 0, 5}, .radius = 0.5f}, stage.matt);
    const World world(stage.scene);
    CHECK(world.powers()[0].x > small);
    const Sphere around = sun_of(world, 0).around;
    const double radius = double(around.radius);
    const D3 middle{around.center};
    CHECK(double(world.powers()[0].x) ==
          doctest::Approx(2 * pi * radius * radius).epsilon(1e-5));
    const LightChoice& choice = world.light_choice();
    std::vector<double> counts(10 * 12), expected(counts.size(), 60000.0 / 120);
    for (long long i = 0; i < 60000; ++i) {
        RandomStream stream = stream_of(i);
        const auto flight = emit(world, choice, stream);
        REQUIRE(flight.ray.direction == Vec3{0, 0, -1});
        REQUIRE(flight.ray.origin.z > 5.5f);
        const D3 p = (D3(flight.ray.origin) - middle) / radius;
        const double r2 = p.x * p.x + p.y * p.y; // uniform over a disc
        REQUIRE(r2 < 1 + 1e-5);
        const int ring = std::min(9, int(r2 * 10));
        const int slice =
            std::clamp(int((std::atan2(p.y, p.x) / (2 * pi) + 0.5) * 12), 0, 11);
        ++counts[std::size_t(ring * 12 + slice)];
    }
    const auto result = ljus_test::chi_square(counts, expected);
    CAPTURE(result.sum);
    CHECK(result.sum < result.limit());
}

TEST_CASE("emission: aimed photons bring what photons sent everywhere bring") {
    // Targets that hide each other; a photon's light is a lamp, a ball or a point, one of
    // them near a target; a spot that is wide, narrower than its targets, or within the
    // ball; a sun; or a lamp above a large floor, near two large walls. 18 comparisons.
    enum Kind { lamps, wide, narrow, within, sun, walls };
    for (const Kind kind : {lamps, wide, narrow, within, sun, walls}) {
        Stage stage;
        const float size = kind == walls ? 3.0f : 1.0f;
        if (kind == walls) {
            for (const Vec3 along : {Vec3{-6, 0, 0}, Vec3{0, -6, 0}})
                stage.scene.add(
                    Quad{.corner{3, 3, -0.5f}, .edge_u = along, .edge_v{0, 0, 6}},
                    stage.mirror);
        } else {
            stage.scene.add(Sphere{.center{0, 0, 0.5f}, .radius = 0.5f}, stage.glass);
            stage.scene.add(Sphere{.center{0.9f, 0, 1.5f}, .radius = 0.6f},
                            stage.mirror);
        }
        stage.scene.add(Quad{.corner{-size, -size, -0.5f},
                             .edge_u{2 * size, 0, 0},
                             .edge_v{0, 2 * size, 0}},
                        stage.mirror);
        if (kind == walls) {
            stage.scene.add(
                Quad{.corner{-1, -1, 2}, .edge_u{0, 1, 0}, .edge_v{1, 0, 0}},
                stage.matt, Rgb{1});
        } else if (kind == lamps) {
            stage.scene.add(lamp, stage.matt, Rgb{1});
            stage.scene.add(Sphere{.center{2, 0, 1.5f}, .radius = 0.4f}, stage.matt,
                            Rgb{2});
            stage.scene.add(PointLight{.position{-1.5f, 0, 0.5f}});
        } else if (kind == sun) {
            stage.scene.add(SunLight{.direction{0.3f, 0.1f, -1}});
        } else {
            stage.scene.add(
                SpotLight{.position{0.1f, 0.2f, kind == within ? 0.6f : 3.0f},
                          .direction{0.2f, -0.1f, -1},
                          .inner_degrees = kind == narrow ? 2.0f : 20.0f,
                          .outer_degrees = kind == narrow ? 6.0f : 50.0f});
        }
        const World world(stage.scene);
        const long long photons = kind == lamps ? 150000 : 60000;
        const AimedFlux aimed = aim_at_all(world, photons);
        const auto everywhere = emit_to(world, aimed.targets, photons);
        REQUIRE(aimed.targets.size() == 3);
        // The lamp lies in the bounding spheres of the floor and both walls. Its photons
        // count wherever they land, and not only if they land on one of the three.
        if (kind == walls) CHECK(aimed.kept > photons / 2);
        for (std::size_t i = 0; i < 3; ++i) {
            CAPTURE(int(kind));
            CAPTURE(i);
            const Mean& a = aimed.means[i][0];
            const Mean& b = everywhere[i];
            CAPTURE(a.mean);
            CAPTURE(b.mean);
            const double error =
                std::sqrt(a.variance() / a.count + b.variance() / b.count);
            CHECK(std::abs(a.mean - b.mean) <= 4.5 * error);
            CHECK(error <= (kind == lamps ? 0.03 : 0.06) * b.mean + 1e-6);
        }
    }
}

TEST_CASE("emission: chosen by power all photons weigh the same; chosen evenly they do "
          "not, and the flux that arrives is known worse") {
    LitFloor scene = lit_floor();
    for (const float strength : {0.1f, 1.0f, 30.0f})
        scene.add(PointLight{.position{0.1f, 0.2f, 1}, .intensity = Rgb{strength}});
    const World world(scene);
    const LightChoice& by_power = world.light_choice();
    const LightChoice even{.cumulative = {1, 2, 3}};
    Mean weight[2];
    for (const int i : {0, 1})
        for (long long path = 0; path < 3000; ++path) {
            RandomStream stream = stream_of(path);
            weight[i].add(double(emit(world, i == 0 ? by_power : even, stream).flux.x));
        }
    const double flux = 4 * pi * 31.1;
    CHECK(weight[0].mean == doctest::Approx(flux).epsilon(1e-5));
    CHECK(weight[0].variance() < 1e-10 * flux * flux);
    CHECK(std::abs(weight[1].sigmas(flux)) < 4.5);
    CHECK(weight[1].variance() > flux * flux);
}

TEST_CASE(
    "emission: photons, aimed or not, know when they fly and where the lamp is then") {
    Scene<Shapes<Moving<Quad>, Sphere>, Materials<Lambertian, Mirror>,
          Lights<PointLight, SunLight>>
        scene;
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const Quad square{.corner{0, 0, 0}, .edge_u{1, 0, 0}, .edge_v{0, 1, 0}};
    const Sphere ball{.center{50, 0, 30}, .radius = 5};
    scene.add(Moving<Quad>{square, {100, 0, 0}}, black, Rgb{1});
    scene.add(ball, scene.add(Mirror{}));
    scene.add(SunLight{.direction{0, 0, -1}, .irradiance = Rgb{0.001f}});
    const World world(scene);
    const auto targets = specular_objects(world);
    for (const bool at_ball : {false, true}) {
        double times[2] = {}, counts[2] = {};
        for (long long i = 0; i < 4000; ++i) {
            RandomStream stream = stream_of(i), again = stream;
            auto photon = emit(world, world.light_choice(), stream);
            if (at_ball) {
                const auto aimed = aim(world, world.light_choice(), targets, again);
                REQUIRE(aimed);
                photon = aimed->photon;
            }
            const Ray& ray = photon.ray;
            REQUIRE(ray.time >= 0);
            REQUIRE(ray.time < 1);
            counts[photon.light] += 1;
            times[photon.light] += double(ray.time);
            if (photon.light != 0) continue;
            REQUIRE(ray.origin.x - 100 * ray.time > -1e-3f);
            REQUIRE(ray.origin.x - 100 * ray.time < 1 + 1e-3f);
            if (at_ball) REQUIRE(intersect(ray, ball));
        }
        for (const int light : {0, 1}) {
            CHECK(counts[light] > 100);
            CHECK(std::abs(times[light] / counts[light] - 0.5) <
                  5 / std::sqrt(12 * counts[light]));
        }
    }
}

TEST_CASE("emission: how a light aims at each kind of object, and how often") {
    Stage stage;
    const auto mirror = stage.mirror;
    stage.scene.add(Sphere{.center{0, 0, 10}, .radius = 1}, mirror);
    const Quad flat{
        .corner{-0.1f, -0.2f, 20}, .edge_u{0.2f, 0, 0}, .edge_v{0, 0.4f, 0}};
    stage.scene.add(flat, mirror);
    stage.scene.add(PointLight{.position{0, 0, 0}});
    stage.scene.add(SpotLight{.position{0, 0, 0},
                              .direction{0, 0, 1},
                              .intensity = Rgb{1},
                              .inner_degrees = 0.1f,
                              .outer_degrees = 0.2f});
    const World world(stage.scene);
    const auto targets = specular_objects(world);
    REQUIRE(targets.size() == 2);
    const SurfacePoint from{};
    for (const ObjectId target : targets) {
        const bool round = world.visit_shape(target, [](const auto& shape) {
            return std::same_as<std::remove_cvref_t<decltype(shape)>, Sphere>;
        });
        const auto at = aim_of(world, 0, from, target);
        // A ball by its cone, 1 - cos; a rectangle by its area over 2 pi d^2.
        const double right =
            round ? 1 - std::sqrt(1 - 0.01) : 0.2 * 0.4 / (2 * pi * 400);
        CHECK(at.at_area == !round);
        CHECK(double(at.size) == ljus_test::within(right, 1e-3));
        // The spot's own cone is narrower: within 0.2 degrees.
        const auto spot = aim_of(world, 1, from, target);
        const double narrow = 1 - std::cos(0.2 * pi / 180);
        CHECK_FALSE(spot.at_area);
        CHECK(double(spot.size) == ljus_test::within(narrow, 1e-2));
        CHECK(double(spot.cone.one_minus_cos) == ljus_test::within(narrow, 1e-2));
        CHECK(spot.cone.axis == Vec3{0, 0, 1});
    }
}

TEST_CASE("emission: a sun's photons start beside the scene, wherever they are aimed") {
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<SunLight>> scene;
    const auto grey = scene.add(Lambertian{});
    for (const Vec3& center : {Vec3{-5, 0, 0}, Vec3{5, 1, 2}, Vec3{0, -7, 3}})
        scene.add(Sphere{.center = center}, grey);
    scene.add(SunLight{.direction{0.6f, -0.8f, 0}});
    const SunInSceneT<float> sun = sun_of(World(scene), 0);
    for (const Vec3& center : {Vec3{-5, 0, 0}, Vec3{5, 1, 2}, Vec3{0, -7, 3}})
        for (const Vec2& u : {Vec2{0.5f, 0.5f}, Vec2{0.1f, 0.9f}, Vec2{0.8f, 0.3f}}) {
            const Ray ray =
                detail::ray_from_afar(sun.around, sun.direction, center, 0.5f, u);
            CHECK(ray.direction == sun.direction);
            CHECK(double(glm::dot(ray.origin - sun.around.center, sun.direction)) ==
                  doctest::Approx(-double(sun.around.radius)).epsilon(1e-5));
            const Vec3 beside = glm::cross(ray.origin - center, sun.direction);
            CHECK(glm::length(beside) < 0.5f); // towards the disc around the centre
        }
}

TEST_CASE("emission: what has no size is no target, first or last") {
    const std::vector<ObjectId> targets{{0, 0}, {0, 1}, {0, 2}, {0, 3}};
    const double sizes[] = {0, 3, 1, 0};
    struct Aim {
        double size = 0;
        std::uint32_t of = 0;
    };
    const auto aim_of = [&](ObjectId id) { return Aim{sizes[id.index], id.index}; };
    int second = 0;
    for (int i = 0; i < 1000; ++i) {
        const auto chosen = detail::choose_target<Aim>(targets, aim_of, i / 1000.0);
        REQUIRE(chosen);
        CHECK(chosen->sum == 4);
        CHECK(chosen->at.of == chosen->target.index);
        CHECK((chosen->target.index == 1 || chosen->target.index == 2));
        second += chosen->target.index == 1;
    }
    CHECK(second == doctest::Approx(750).epsilon(2e-3));
    const auto none = [](ObjectId) { return Aim{}; };
    CHECK_FALSE(detail::choose_target<Aim>(targets, none, 0.5));
}

TEST_CASE("emission: from within a bound a lamp aims at all that it can shine on") {
    Stage stage;
    const ObjectId ball = stage.scene.add(Sphere{.radius = 2}, stage.glass);
    const ObjectId wall = stage.scene.add(
        Quad{.corner{-3, -3, 0}, .edge_u{6, 0, 0}, .edge_v{0, 6, 0}}, stage.mirror);
    stage.scene.add(
        Quad{.corner{-0.1f, -0.1f, 0.5f}, .edge_u{0.2f, 0, 0}, .edge_v{0, 0.2f, 0}},
        stage.matt, Rgb{1});
    stage.scene.add(PointLight{.position{0, 0, 0.5f}});
    const World world(stage.scene);
    const SurfacePoint from{.position{0, 0, 0.5f}, .normal{0, 0, 1}};
    for (const ObjectId target : {ball, wall}) {
        // Its hemisphere, and a point light the whole sphere:
        // in solid angles over 2 pi.
        const auto lamp_at = aim_of(world, 0, from, target);
        CHECK(lamp_at.cone.axis == from.normal);
        CHECK(lamp_at.cone.one_minus_cos == 1);
        CHECK(lamp_at.size == 1);
        CHECK_FALSE(lamp_at.at_area);
        const auto point_at = aim_of(world, 1, from, target);
        CHECK(point_at.cone.one_minus_cos == 2);
        CHECK(point_at.size == 2);
        CHECK_FALSE(point_at.at_area);
    }
    // So every aimed photon of the lamp can hit.
    const LightChoice only{.cumulative = {1, 1}};
    for (long long i = 0; i < 1000; ++i) {
        RandomStream stream = stream_of(i);
        const auto aimed =
            aim(world, only, std::span<const ObjectId>(&ball, 1), stream);
        REQUIRE(aimed);
        CHECK(aimed->photon.ray.direction.z > 0);
    }
}

TEST_CASE("emission: a spot that is wider than its target aims at nothing else") {
    // Its even part is narrower than the target, all of it is wider.
    Stage stage;
    const Sphere ball{.center{0, 0.5f, -4}, .radius = 0.5f};
    stage.scene.add(ball, stage.glass);
    stage.scene.add(
        SpotLight{.direction{0, 0, -1}, .inner_degrees = 1, .outer_degrees = 40});
    const World world(stage.scene);
    const auto targets = specular_objects(world);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < 1000; ++i) {
        RandomStream stream = stream_of(i);
        const auto aimed = aim(world, choice, targets, stream);
        REQUIRE(aimed);
        CHECK(intersect(aimed->photon.ray, ball));
    }
}

TEST_CASE("emission: each light's aimed photons pay for how often it is chosen") {
    // A sun beside a point light, which is chosen nine times in ten though it is weak:
    // a photon carries what its light sends to the ball, over the light's probability.
    Stage stage;
    stage.scene.add(Sphere{.radius = 0.5f}, stage.glass);
    stage.scene.add(PointLight{.position{0, 3, 0}, .intensity = Rgb{0.2f}});
    stage.scene.add(SunLight{.direction{0, 0, -1}, .irradiance = Rgb{4}});
    const World world(stage.scene);
    const auto targets = specular_objects(world);
    const LightChoice choice{.cumulative = {9, 10}};
    const double cone = 1 - std::sqrt(1 - 0.25 / 9);
    const double wanted[] = {2 * pi * cone * 0.2 / 0.9, 4 * pi * 0.25 / 0.1};
    int seen[2] = {};
    for (long long i = 0; i < 1000; ++i) {
        RandomStream stream = stream_of(i);
        const auto aimed = aim(world, choice, targets, stream);
        REQUIRE(aimed);
        const auto light = aimed->photon.light;
        ++seen[light];
        CHECK(double(aimed->photon.flux.x) == ljus_test::within(wanted[light], 1e-3));
    }
    CHECK(seen[0] > 800);
    CHECK(seen[1] > 50);
}

TEST_CASE("emission: a mirror that is seen exactly from its edge gets no photon") {
    Stage stage;
    stage.scene.add(Quad{.corner{2, -0.5f, 0}}, stage.mirror); // in the plane z = 0
    stage.scene.add(PointLight{});
    const World world(stage.scene);
    const auto targets = specular_objects(world);
    const LightChoice& choice = world.light_choice();
    for (long long i = 0; i < 100; ++i) {
        RandomStream stream = stream_of(i);
        CHECK_FALSE(aim(world, choice, targets, stream));
    }
}
