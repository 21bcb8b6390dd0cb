/// \file radiance_test.cpp
/// \brief Flux, irradiance, radiance: the laws of chapter 2, counted with rays against
/// closed forms.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "ljus/geometry/shape.hpp"
#include "ljus/inspect/class_means.hpp"
#include "ljus/inspect/explain.hpp"
#include "ljus/ljus.hpp"
#include "ljus/math/sampling.hpp"
#include "support/draws.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"
#include "support/within.hpp"

using ljus_test::Draws, ljus_test::Mean, ljus_test::within;
using Vec = ljus::Vec3T<double>;
using Quad = ljus::QuadT<double>;
using Sphere = ljus::SphereT<double>;
using Ray = ljus::RayT<double>;

namespace {

constexpr double pi = std::numbers::pi;

/// The share of 400 000 random directions from the origin that meet a shape.
template <typename Shape>
Mean share_of(const Shape& shape, std::uint64_t seed) {
    Draws draws{ljus_test::test_seed(seed)};
    Mean share;
    for (int i = 0; i < 400000; ++i) {
        const Ray ray{.origin{0, 0, 0},
                      .direction = ljus::sample_uniform_sphere(draws.square<double>())};
        share.add(ljus::intersect(ray, shape) ? 1 : 0);
    }
    return share;
}

/// A square of side 0.25 around (distance, 0, 0), tilted.
Quad patch_at(double distance, double degrees) {
    const double a = degrees * pi / 180;
    const Vec u = 0.25 * Vec{std::sin(a), std::cos(a), 0}, v{0, 0, 0.25};
    return {.corner = Vec{distance, 0, 0} - 0.5 * (u + v), .edge_u = u, .edge_v = v};
}

/// The solid angle of a facet by 400 x 400 pieces, each cos/r^2 of its area.
double solid_angle_by_pieces(const Quad& quad) {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec p =
                quad.corner + (i + 0.5) / n * quad.edge_u + (j + 0.5) / n * quad.edge_v;
            const double r = glm::length(p);
            sum += std::abs(glm::dot(normal(quad), p)) / (r * r * r);
        }
    return sum * area(quad) / (double(n) * n);
}

} // namespace

// False alarms: 4.5 standard errors either way, 7 in a million for each of 8 counts.
TEST_CASE("radiance: counted rays find the solid angle of a ball and of a square") {
    for (const double r : {1.05, 2.0, 6.0}) {
        const Mean share = share_of(Sphere{.center{0, r, 0}, .radius = 1}, 3);
        const double cone = 2 * pi * (1 - std::sqrt(1 - 1 / (r * r)));
        CHECK(std::abs(4 * pi * share.mean - cone) < 4.5 * 4 * pi * share.error());
    }
    for (const double r : {0.5, 1.0, 3.0}) {
        const Quad square{{-0.5, -0.5, r}, {1, 0, 0}, {0, 1, 0}};
        const double h = 0.5, right = 4 * std::atan(h * h / (r * std::hypot(h, h, r)));
        CHECK(solid_angle_by_pieces(square) == within(right, 1e-5));
        const Mean share = share_of(square, 4);
        CHECK(std::abs(4 * pi * share.mean - right) < 4.5 * 4 * pi * share.error());
    }
    // From inside of a ball it is everywhere, and from the middle of a cube a sixth.
    CHECK(share_of(Sphere{.center{0.5, 0, 0}, .radius = 1}, 5).mean == 1);
    CHECK(solid_angle_by_pieces({{-1, -1, 1}, {2, 0, 0}, {0, 2, 0}}) ==
          within(4 * pi / 6, 1e-5));
}

TEST_CASE(
    "radiance: counted rays fall on a patch by the inverse square and the cosine") {
    for (const double r : {1.0, 2.0, 4.0}) {
        const Quad patch = patch_at(r, 0);
        const Mean share = share_of(patch, 11);
        const double right = solid_angle_by_pieces(patch) / (4 * pi);
        CHECK(std::abs(share.mean - right) < 4.5 * share.error());
        CHECK(right == within(area(patch) / (4 * pi * r * r), 0.02));
    }
    const double facing = solid_angle_by_pieces(patch_at(4, 0));
    for (const double degrees : {0.0, 30.0, 60.0, 80.0}) {
        const Quad patch = patch_at(4, degrees);
        const Mean share = share_of(patch, 12);
        const double right = solid_angle_by_pieces(patch);
        CHECK(std::abs(share.mean - right / (4 * pi)) < 4.5 * share.error());
        CHECK(right / facing == within(std::cos(degrees * pi / 180), 0.005));
    }
}

TEST_CASE("radiance: the density of a lamp's point holds the cosine and the square") {
    // A small lamp: density times its solid angle is 1.
    for (const double r : {1.0, 3.0, 100.0})
        for (const double degrees : {0.0, 40.0, 75.0}) {
            Quad lamp = patch_at(r, degrees);
            lamp.edge_u *= 0.01;
            lamp.edge_v *= 0.01;
            const auto seen =
                ljus::sample_towards(lamp, Vec{0, 0, 0}, ljus::Vec2T<double>{0.5, 0.5});
            CHECK(1 / seen.pdf == within(solid_angle_by_pieces(lamp), 1e-3));
        }
}

TEST_CASE("radiance: what A sends to B, B sends to A") {
    // The throughput of a beam, A cos A' cos' / r^2, from either end by pieces.
    const Quad a{{0, 0, 0}, {0.5, 0.2, 0}, {0, 0.3, 0.4}};
    const Quad b{{3, 1, 1}, {-0.4, 0.6, 0}, {0.1, 0, 0.7}};
    const auto beam = [](const Quad& from, const Quad& to) {
        constexpr int n = 24;
        double sum = 0;
        for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j) {
                const auto p = ljus::point_at(from, (i + 0.5) / n, (j + 0.5) / n);
                Quad shifted = to;
                shifted.corner -= p.position;
                constexpr int m = 24;
                for (int k = 0; k < m; ++k)
                    for (int l = 0; l < m; ++l) {
                        const auto q =
                            ljus::point_at(shifted, (k + 0.5) / m, (l + 0.5) / m);
                        // Solid angle seen from p, by the library's density.
                        const double pdf = ljus::pdf_towards(shifted, Vec{0, 0, 0}, q);
                        const double cosine =
                            std::abs(glm::dot(p.normal, glm::normalize(q.position)));
                        sum += cosine / pdf / (n * n * m * m);
                    }
            }
        return sum * area(from);
    };
    CHECK(beam(a, b) == within(beam(b, a), 1e-9));
    CHECK(beam(a, b) > 0.001);
}

TEST_CASE("radiance: it stays the same along a ray, and irradiance does not") {
    const ljus::World scene(ljus::make_scene(
        placed(ljus::Sphere{.center{0, 0, 0}, .radius = 0.5f},
               ljus::Lambertian{.albedo = ljus::Rgb{0}}, ljus::Rgb{10})));
    const ljus::PathTracer tracer(scene);
    for (const float r : {0.75f, 2.0f, 50.0f}) {
        const auto eye = ljus::look_at(
            {.position{0, 0, r}, .target{0, 0, 0}, .vfov_degrees = 0.01f});
        const auto seen = render(tracer, eye, {.width = 1, .height = 1, .samples = 4});
        CHECK(seen.image.pixels[0] == ljus::Rgb{10}); // exactly
    }
    // E = pi L sin^2, by a grid of the cone of directions to the ball.
    for (const double r : {0.75, 2.0, 50.0}) {
        const double sin2 = 0.25 / (r * r);
        const double one_minus_cos = ljus::one_minus_cosine(sin2);
        double sum = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec d = ljus::sample_uniform_cone(
                ljus::Vec2T<double>{(i + 0.5) / 1000, 0.3}, one_minus_cos);
            sum += 10 * d.z / ljus::pdf_uniform_cone(one_minus_cos) / 1000;
        }
        CHECK(sum == within(pi * 10 * sin2, 1e-6));
    }
}

TEST_CASE("radiance: a Lambertian lamp of radiance L sends out pi L on each square") {
    // Exitance: the integral of L cos over the hemisphere, by a grid.
    double sum = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec d =
            ljus::sample_uniform_hemisphere(ljus::Vec2T<double>{(i + 0.5) / 1000, 0.1});
        sum += 7 * d.z / ljus::pdf_uniform_hemisphere(d) / 1000;
    }
    CHECK(sum == within(7 * pi, 1e-6));
    const ljus::QuadT<double> lamp{.edge_u{3, 0, 0}, .edge_v{0, 1, 0}};
    const auto known = ljus::detail::make_lamp(lamp, ljus::RgbT<double>(7), false);
    const auto flux = power(ljus::AreaLightT<ljus::QuadT<double>>{lamp, known});
    CHECK(flux.x == within(sum * 3, 1e-6));
    // And its intensity, radiance times the area as it is seen, adds up to the same.
    double all = 0;
    for (int i = 0; i < 1000; ++i) {
        const double c = (i + 0.5) / 1000;
        all += 2 * pi * 7 * 3 * c / 1000;
    }
    CHECK(all == within(sum * 3, 1e-6));
}

TEST_CASE("radiance: far from a lamp of any shape the inverse square holds") {
    // Lambert's closed form over L A / r^2: 1 in the limit, and less near the lamp.
    double before = 0;
    for (const double r : {0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 1000.0}) {
        const Quad lamp{{-0.5, r, -0.5}, {1, 0, 0}, {0, 0, 1}};
        const auto factor =
            ljus::form_factor_from(Vec{0, 0, 0}, Vec{0, 1, 0}, lamp, false);
        REQUIRE(factor);
        const double ratio = pi * *factor * r * r;
        CHECK(ratio > before);
        CHECK(ratio < 1);
        before = ratio;
        if (r >= 5) CHECK(ratio > 0.98); // five times the side: within 2 %
    }
    CHECK(before == within(1, 1e-5));
}

TEST_CASE("radiance: a pixel that is taken apart adds up, whatever its filter") {
    const ljus::World scene(ljus::make_scene(
        placed(ljus::Quad{{-1, 0, 1}, {2, 0, 0}, {0, 0, -2}}, ljus::Lambertian{}),
        placed(ljus::Sphere{.center{0, 1, 0}, .radius = 0.3f}, ljus::Lambertian{},
               ljus::Rgb{5})));
    const ljus::PathTracer tracer(scene);
    const auto camera = ljus::look_at({.position{0, 1, 4}, .target{0, 0.5f, 0}});
    for (const ljus::Filter filter :
         {ljus::Filter::box, ljus::Filter::gaussian, ljus::Filter::mitchell}) {
        const ljus::RenderSettings picture{
            .width = 8, .height = 8, .samples = 32, .filter = filter};
        const auto whole = render(tracer, camera, picture).image;
        double all = 0;
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x) {
                const auto parts =
                    ljus::detail::take_apart(tracer, camera, picture, x, y);
                double sum = 0;
                for (const auto& part : parts.sums) sum += part.value.x;
                CHECK(sum == doctest::Approx(double(parts.radiance.x)).epsilon(1e-5));
                CHECK(parts.radiance == pixel(whole, x, y));
                all += sum / 64;
            }
        const ljus::LightPathExpression any[] = {ljus::light_path_expression("E.*L")};
        const auto means = class_means(tracer, camera, picture, any);
        CHECK(means[0].x == doctest::Approx(all).epsilon(1e-5));
    }
}
