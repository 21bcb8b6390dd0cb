#include <doctest/doctest.h>

#include <numbers>

#include "ljus/materials/glossy.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/mean.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr double pi = std::numbers::pi;

/// The vertex straight below a point.
template <typename S>
Vertex below(const S& scene, const Vec3& from) {
    const Ray ray{.origin = from, .direction{0, -1, 0}};
    const auto hit = closest_hit(scene, ray);
    REQUIRE(hit);
    return vertex_at(scene, ray, *hit);
}

/// The direct light of a vertex, over many samples.
template <typename S, typename M>
Mean direct(const S& scene, const Vertex& vertex, const M& material, DirectLight how,
            int rays, int samples, std::uint64_t seed = 1) {
    Mean mean;
    Counts counts;
    for (int i = 0; i < samples; ++i) {
        auto stream = random_stream(seed, Pass::user, 0, std::uint64_t(i));
        start_bounce(stream, 1);
        mean.add(double(detail::sample_all_lights(scene, vertex, material, how, rays,
                                                  stream, counts)
                            .x));
    }
    return mean;
}

using Lit = Scene<Shapes<Quad, Sphere>, Materials<Lambertian>>;

/// A floor, a square lamp of side 1 at height 1 and, if asked for, a half plane at
/// height 0.5 that hides what lies to the left.
Lit lit_floor(bool screen) {
    Lit scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{.corner{-50, 0, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
              white);
    scene.add(Quad{.corner{-0.5f, 1, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}}, black,
              Rgb{3});
    if (screen)
        scene.add(Quad{.corner{-9, 0.5f, -9}, .edge_u{0, 0, 18}, .edge_v{9, 0, 0}},
                  black);
    return scene;
}

/// The form factor from the floor at x to the lamp, of the strip from x0 to x1 of it, by
/// the midpoint rule.
double strip(double x, double x0, double x1) {
    constexpr int n = 400;
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double dx = x0 + (x1 - x0) * (i + 0.5) / n - x;
            const double dz = (j + 0.5) / n - 0.5;
            const double d2 = dx * dx + dz * dz + 1;
            sum += (x1 - x0) / (double(n) * n) / (pi * d2 * d2);
        }
    return sum;
}

} // namespace

TEST_CASE("all lights: the closed form has no noise where all of a lamp is seen") {
    const Lit scene = lit_floor(false);
    const Lambertian white{.albedo = Rgb{0.5f}};
    for (const float x : {0.0f, 0.4f, 3.0f}) {
        const Vertex at = below(scene, {x, 0.1f, 0});
        const double right = 0.5 * 3 * strip(double(x), -0.5, 0.5);
        const Mean seen = direct(scene, at, white, DirectLight::analytic, 1, 50);
        CAPTURE(x);
        CHECK(seen.mean == doctest::Approx(right).epsilon(1e-4));
        CHECK(seen.error() < 1e-6 * right);
        // By shadow rays alone there is noise, and the same mean: 4 standard errors.
        const Mean rays = direct(scene, at, white, DirectLight::sampled, 1, 20000);
        CHECK(std::abs(rays.mean - right) < 4 * rays.error() + 1e-4 * right);
        if (x < 3) CHECK(rays.error() > 1e-4 * right);
    }
}

TEST_CASE("all lights: in a penumbra the three ways have one mean") {
    // The screen hides, from x, the part of the lamp left of -x. Of 9 comparisons by 4
    // standard errors, one in 1800 runs would fail were the seeds new. The quotient's
    // bias is of the order of the variance over the rays: below 1 % with 16 of them.
    const Lit scene = lit_floor(true);
    const Lambertian white{.albedo = Rgb{0.5f}};
    for (const float x : {0.1f, 0.2f, 0.35f}) {
        const Vertex at = below(scene, {x, 0.1f, 0});
        const double right = 0.5 * 3 * strip(double(x), double(-x), 0.5);
        CAPTURE(x);
        for (const DirectLight how :
             {DirectLight::sampled, DirectLight::analytic, DirectLight::mis}) {
            const Mean seen = direct(scene, at, white, how, 16, 4000);
            CAPTURE(int(how));
            CHECK(std::abs(seen.mean - right) < 4 * seen.error() + 0.01 * right);
        }
    }
    // Where the whole lamp is hidden it is black, exactly.
    const Mean dark =
        direct(scene, below(scene, {-3, 0.1f, 0}), white, DirectLight::analytic, 4, 20);
    CHECK(dark.mean == 0);
    CHECK(dark.error() == 0);
}

TEST_CASE("all lights: multiple importance sampling tames lamps that are walls") {
    // Inside of a furnace all direct light is the albedo times the emission.
    const auto room = box_furnace(Rgb{2}, Rgb{0.5f});
    const Lambertian wall{.albedo = Rgb{0.5f}};
    for (const float x : {0.0f, 0.9f, 0.99f}) {
        const Vertex at = below(room.scene, {x, -0.9f, 0.95f});
        CAPTURE(x);
        const Mean both = direct(room.scene, at, wall, DirectLight::mis, 1, 20000);
        CHECK(std::abs(apart(both, 1, 1e-5)) < 4);
        const Mean rays = direct(room.scene, at, wall, DirectLight::sampled, 1, 20000);
        CHECK(both.error() < 0.7 * rays.error());
        const Mean form = direct(room.scene, at, wall, DirectLight::analytic, 1, 20);
        CHECK(form.mean == doctest::Approx(1).epsilon(1e-5));
        CHECK(form.error() < 1e-6);
    }
    const auto ball = sphere_furnace(Rgb{2}, Rgb{0.5f});
    const Vertex at = below(ball.scene, {0.1f, -0.9f, 0});
    const Mean both = direct(ball.scene, at, wall, DirectLight::mis, 1, 20000);
    CHECK(std::abs(apart(both, 1, 1e-5)) < 4);
    // The horizon of a point inside cuts the sphere: no closed form, but shadow rays.
    const Mean form = direct(ball.scene, at, wall, DirectLight::analytic, 1, 20000);
    CHECK(std::abs(apart(form, 1, 1e-5)) < 4);
}

TEST_CASE("all lights: a narrow gloss sees a lamp by its own ray") {
    const Lit scene = lit_floor(false);
    const Vertex at = below(scene, {0.3f, 0.1f, 0});
    const Glossy gloss{.reflectance = Rgb{0.9f}, .roughness = 0.02f};
    const Mean both = direct(scene, at, gloss, DirectLight::mis, 1, 20000);
    const Mean rays = direct(scene, at, gloss, DirectLight::sampled, 1, 400000);
    CHECK(std::abs(both.mean - rays.mean) < 4 * (both.error() + rays.error()));
    CHECK(both.error() * std::sqrt(20000.0) < 0.2 * rays.error() * std::sqrt(400000.0));
}

TEST_CASE("form_factor_from: a sphere, by the horizon") {
    const Vec3 up{0, 1, 0};
    const auto factor = [&](const Sphere& ball, bool inside_out = false) {
        return form_factor_from(Vec3{0}, up, ball, inside_out);
    };
    // Wholly above: (r/d)^2 cos. Below: nothing arrives. Cut, inside, or turned: not known.
    CHECK(*factor({.center{0, 2, 0}, .radius = 1}) == doctest::Approx(0.25));
    CHECK(*factor({.center{3, 4, 0}, .radius = 2}) ==
          doctest::Approx(0.16 * 0.8).epsilon(1e-6));
    CHECK(*factor({.center{0, -2, 0}, .radius = 1}) == 0);
    CHECK(*factor({.center{9, -1, 0}, .radius = 1}) == 0);
    CHECK(!factor({.center{9, 0.5f, 0}, .radius = 1}));
    CHECK(!factor({.center{0, 0.5f, 0}, .radius = 1}));
    CHECK(!factor({.center{0, 2, 0}, .radius = 1}, true));
    // A quad counts from its front alone, or from its back if it is inside out.
    const Quad lamp{.corner{-0.5f, 1, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}};
    CHECK(*form_factor_from(Vec3{0}, up, lamp, false) ==
          doctest::Approx(strip(0, -0.5, 0.5)).epsilon(1e-4));
    CHECK(*form_factor_from(Vec3{0}, up, lamp, true) == 0);
    CHECK(*form_factor_from(Vec3{0, 2, 0}, -up, lamp, true) ==
          doctest::Approx(strip(0, -0.5, 0.5)).epsilon(1e-4));
}
