// Direct light of all lights at once: closed forms, and three ways with one mean.
// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
// none failed.
#include <doctest/doctest.h>

#include <numbers>

#include "ljus/geometry/moving.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/path/all_lights.hpp"
#include "ljus/scenes/furnaces.hpp"
#include "support/mean.hpp"
#include "support/seed.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr double pi = std::numbers::pi;

/// The vertex straight below a point.
template <AnyWorld W>
Vertex below(const W& world, const Vec3& from) {
    const Ray ray{.origin = from, .direction{0, -1, 0}};
    const auto hit = closest_hit(world, ray);
    REQUIRE(hit);
    return vertex_at(world, ray, *hit);
}

/// The direct light of a vertex, over many samples.
template <AnyWorld W, typename M>
Mean direct(const W& world, const Vertex& vertex, const M& material, DirectLight how,
            int rays, int samples, std::uint64_t seed = 1) {
    Mean mean;
    Counts counts;
    for (int i = 0; i < samples; ++i) {
        auto stream =
            random_stream(ljus_test::test_seed(seed), Pass::user, 0, std::uint64_t(i));
        start_bounce(stream, 1);
        auto context = context_of(stream, counts);
        mean.add(
            double(sample_all_lights(world, vertex, material, {how, rays}, context).x));
    }
    return mean;
}

using Lit = Scene<Shapes<Quad, Sphere>, Materials<Lambertian>, Lights<PointLight>>;

/// A floor, a square lamp of side 1 at height 1 and, if asked for, a half plane at
/// height 0.5 that hides what lies to the left.
Lit lit_floor(bool screen, float radiance = 3) {
    Lit scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.5f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{.corner{-50, 0, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
              white);
    scene.add(Quad{.corner{-0.5f, 1, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}}, black,
              Rgb{radiance});
    if (screen)
        scene.add(Quad{.corner{-9, 0.5f, -9}, .edge_u{0, 0, 18}, .edge_v{9, 0, 0}},
                  black);
    return scene;
}

/// The form factor from the floor at x to the lamp, of the strip from x0 to x1 of
/// it, by the midpoint rule.
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
    const World world(lit_floor(false));
    const Lambertian white{.albedo = Rgb{0.5f}};
    for (const float x : {0.0f, 0.4f, 3.0f}) {
        const Vertex at = below(world, {x, 0.1f, 0});
        const double right = 0.5 * 3 * strip(double(x), -0.5, 0.5);
        const Mean seen = direct(world, at, white, DirectLight::analytic, 1, 50);
        CAPTURE(x);
        CHECK(seen.mean == doctest::Approx(right).epsilon(1e-4));
        CHECK(seen.error() < 1e-6 * right);
        // By shadow rays alone there is noise, and the same mean: 4 standard errors.
        const Mean rays = direct(world, at, white, DirectLight::sampled, 1, 20000);
        CHECK(std::abs(rays.mean - right) < 4 * rays.error() + 1e-4 * right);
        if (x < 3) CHECK(rays.error() > 1e-4 * right);
    }
    // So dim that the square of its light is not a float.
    const World dim(lit_floor(false, 3e-25f));
    const Mean seen =
        direct(dim, below(dim, {0, 0.1f, 0}), white, DirectLight::analytic, 1, 50);
    CHECK(seen.mean / (0.5 * 3e-25 * strip(0, -0.5, 0.5)) ==
          doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("all lights: faint lamps among others share rays, and lose no light") {
    const Lambertian white{.albedo = Rgb{0.5f}};
    // Lamps of side 0.2 in a row, the first of them 9 times as bright: it sends half of
    // the light to a far point, each other one an eighteenth. Those from `hidden` on
    // are behind a screen.
    const auto row = [&](int lamps, int hidden, float step = 0, float unit = 1) {
        Lit scene;
        scene.add(Quad{.corner{-50, 0, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
                  scene.add(white));
        const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
        for (int i = 0; i < lamps; ++i)
            scene.add(Quad{.corner{0.3f * float(i), 20, -0.1f},
                           .edge_u{0.2f, 0, 0},
                           .edge_v{0, 0, 0.2f}},
                      black, Rgb{unit * (i == 0 ? 9.1f : 1 + step * float(i))});
        scene.add(Quad{.corner{0.3f * float(hidden) - 0.05f, 19.99f, -1},
                       .edge_u{10, 0, 0},
                       .edge_v{0, 0, 2}},
                  black);
        return World(std::move(scene));
    };
    const auto light = [&](const auto& world, int each, std::uint64_t path,
                           Counts& counts) {
        const Vertex at = below(world, {1.35f, 1, 0});
        auto stream = random_stream(test_seed(1), Pass::user, 0, path);
        auto context = context_of(stream, counts);
        return sample_all_lights(world, at, white, {DirectLight::analytic, each},
                                 context)
            .x;
    };
    {
        Counts many, few, two;
        const auto ten = row(10, 10);
        CHECK(light(ten, 4, 0, many) / light(ten, 1, 0, few) ==
              doctest::Approx(1).epsilon(1e-6));
        Counts dim;
        CHECK(light(row(10, 10, 0, 1e-25f), 4, 0, dim) / 1e-25f /
                  light(ten, 4, 0, dim) ==
              doctest::Approx(1).epsilon(1e-4));
        CHECK(few.shadow_rays == 10);
        CHECK(many.shadow_rays >= 4 + 4); // half of 8, and one more by rounding up
        CHECK(many.shadow_rays <= 4 + 5);
        light(row(2, 10), 8, 0, two);
        CHECK(two.shadow_rays == 16); // not worth a comparison
    }
    // Of lamps that are hidden or visible as a whole, one ray to each tells all. The
    // mean of 4000 shared estimates has a standard error of at most 0.3 %, and a bias of
    // as much: by chance it would fail in fewer than one of 10^6 runs.
    const auto dim = row(10, 6, 0.3f);
    Counts counts;
    const double exact = light(dim, 1, 0, counts);
    double mean = 0;
    for (std::uint64_t i = 0; i < 4000; ++i) mean += light(dim, 4, i, counts) / 4000;
    CHECK(mean / exact == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("all lights: in a penumbra the three ways have one mean") {
    // The screen hides, from x, the part of the lamp left of -x. Of 9 comparisons by 4
    // standard errors, one in 1800 runs would fail were the seeds new. The quotient's
    // bias is of the order of the variance over the rays: below 1 % with 16 of them.
    const World world(lit_floor(true));
    const Lambertian white{.albedo = Rgb{0.5f}};
    for (const float x : {0.1f, 0.2f, 0.35f}) {
        const Vertex at = below(world, {x, 0.1f, 0});
        const double right = 0.5 * 3 * strip(double(x), double(-x), 0.5);
        CAPTURE(x);
        for (const DirectLight how :
             {DirectLight::sampled, DirectLight::analytic, DirectLight::mis}) {
            const Mean seen = direct(world, at, white, how, 16, 4000);
            CAPTURE(int(how));
            CHECK(std::abs(seen.mean - right) < 4 * seen.error() + 0.01 * right);
        }
    }
    // Where the whole lamp is hidden it is black, exactly.
    const Mean dark =
        direct(world, below(world, {-3, 0.1f, 0}), white, DirectLight::analytic, 4, 20);
    CHECK(dark.mean == 0);
    CHECK(dark.error() == 0);
}

TEST_CASE("all lights: multiple importance sampling tames lamps that are walls") {
    // Inside of a furnace all direct light is the albedo times the emission.
    const auto room = box_furnace(Rgb{2}, Rgb{0.5f});
    const Lambertian wall{.albedo = Rgb{0.5f}};
    for (const float x : {0.0f, 0.9f, 0.99f}) {
        const Vertex at = below(room.world, {x, -0.9f, 0.95f});
        CAPTURE(x);
        const Mean both = direct(room.world, at, wall, DirectLight::mis, 1, 20000);
        CHECK(std::abs(apart(both, 1, 1e-5)) < 4);
        const Mean rays = direct(room.world, at, wall, DirectLight::sampled, 1, 20000);
        CHECK(both.error() < 0.7 * rays.error());
        const Mean form = direct(room.world, at, wall, DirectLight::analytic, 1, 20);
        CHECK(form.mean == doctest::Approx(1).epsilon(1e-5));
        CHECK(form.error() < 1e-6);
    }
    const auto ball = sphere_furnace(Rgb{2}, Rgb{0.5f});
    const Vertex at = below(ball.world, {0.1f, -0.9f, 0});
    const Mean both = direct(ball.world, at, wall, DirectLight::mis, 1, 20000);
    CHECK(std::abs(apart(both, 1, 1e-5)) < 4);
    // The horizon of a point inside cuts the sphere: no closed form, but shadow rays.
    const Mean form = direct(ball.world, at, wall, DirectLight::analytic, 1, 20000);
    CHECK(std::abs(apart(form, 1, 1e-5)) < 4);
}

TEST_CASE("all lights: in a fog and in colours, from both sides") {
    // A square lamp of side 1 at height 1, seen from (0.3, 0, 0) through a fog, by the
    // midpoint rule; above and below a floor whose normal is +y. 4000 paths, 36
    // comparisons by 5 standard errors: one in 50 000 runs, were the seeds new.
    using D3 = glm::dvec3;
    using Fogged =
        Scene<Shapes<QuadT<double>, SphereT<double>>, Materials<LambertianT<double>>>;
    const D3 fog{0.3, 0.6, 1.2}, emission{3, 2, 5};
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    D3 right{0};
    constexpr int n = 200;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double dx = (i + 0.5) / n - 0.8, dz = (j + 0.5) / n - 0.5;
            const double d2 = dx * dx + dz * dz + 1;
            right += matt.albedo * emission * glm::exp(-std::sqrt(d2) * fog) /
                     (double(n) * n * pi * d2 * d2);
        }
    for (const double side : {1.0, -1.0})
        for (const bool inside_out : {false, true}) {
            Fogged scene;
            const auto floor = scene.add(matt);
            scene.add(QuadT<double>{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, floor);
            const D3 u{1, 0, 0}, v{0, 0, 1}; // u x v = -y
            const bool down = (side > 0) != inside_out;
            scene.add(QuadT<double>{{-0.5, side, -0.5}, down ? u : v, down ? v : u},
                      scene.add(LambertianT<double>{.albedo = D3{0}}), emission,
                      inside_out);
            const RayT<double> ray{.origin{0.3, 0.1 * side, 0},
                                   .direction{0, -side, 0}};
            const World world(std::move(scene));
            auto vertex = vertex_at(world, ray, *closest_hit(world, ray));
            vertex.medium = fog;
            for (const DirectLight how : {DirectLight::sampled, DirectLight::mis})
                for (const int rays : {1, 4}) {
                    Mean mean[3];
                    for (std::uint64_t path = 0; path < 4000; ++path) {
                        auto stream =
                            random_stream(ljus_test::test_seed(3), Pass::user, 0, path);
                        start_bounce(stream, 1);
                        Counts counts;
                        auto context = context_of(stream, counts);
                        const D3 seen = sample_all_lights(world, vertex, matt,
                                                          {how, rays}, context);
                        for (int c = 0; c < 3; ++c) mean[c].add(seen[c]);
                        REQUIRE(counts.shadow_rays ==
                                std::uint64_t(rays + (how == DirectLight::mis)));
                    }
                    CAPTURE(side);
                    CAPTURE(int(how));
                    CAPTURE(rays);
                    for (int c = 0; c < 3; ++c)
                        CHECK(std::abs(apart(mean[c], right[c], 1e-5)) < 5);
                }
            // The closed form, and of what is lost in the fog an estimate of 64 rays
            // that lie evenly: some parts in a thousand.
            auto stream = random_stream(ljus_test::test_seed(3), Pass::user, 0, 0);
            Counts counts;
            auto context = context_of(stream, counts);
            const D3 seen = sample_all_lights(world, vertex, matt,
                                              {DirectLight::analytic, 64}, context);
            CHECK(counts.shadow_rays == 64);
            for (int c = 0; c < 3; ++c)
                CHECK(seen[c] == doctest::Approx(right[c]).epsilon(0.003));
            // From the lamp's back there is no light, and no ray.
            auto behind = vertex;
            behind.point.position.y = 2 * side;
            behind.wo.z = -vertex.wo.z;
            Counts none;
            auto nothing = context_of(stream, none);
            CHECK(sample_all_lights(world, behind, matt, {DirectLight::analytic, 4},
                                    nothing) == D3{0});
            CHECK(none.shadow_rays == 0);
        }
}

TEST_CASE("all lights: a verdict for each light, by its number") {
    // Point lights 1, 2 and 3 above the floor, each with some verdict.
    Lit scene = lit_floor(false);
    const Lambertian white{.albedo = Rgb{0.5f}};
    for (const float power : {1.0f, 10.0f, 100.0f})
        scene.add(PointLight{.position{9, 0.5f, 0}, .intensity = Rgb{power}});
    const World world(std::move(scene));
    const Vertex at = below(world, {9, 0.1f, 3});
    const auto light_of = [&](const std::vector<Verdict>& known, int rays,
                              DirectLight how, Counts& counts) {
        auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
        auto context = context_of(stream, counts);
        return sample_all_lights(world, at, white, {how, rays}, context,
                                 [&](std::size_t number) { return known[number]; });
    };
    const double each = 0.5 / pi * 0.5 / std::pow(9.25, 1.5); // of a power of 1
    const Verdict dark = Verdict::shadow, lit = Verdict::lit, ask = Verdict::unknown;
    for (const int rays : {1, 4})
        for (const DirectLight how : {DirectLight::sampled, DirectLight::analytic}) {
            Counts counts;
            const double seen =
                double(light_of({dark, ask, dark, lit}, rays, how, counts).x);
            CHECK(seen == doctest::Approx(101 * each).epsilon(1e-4));
            CHECK(counts.skipped_rays == std::uint64_t(3 * rays)); // dark, dark, lit
            CHECK(counts.shadow_rays == std::uint64_t(rays));
            counts = {};
            CHECK(is_black(light_of({dark, dark, dark, dark}, rays, how, counts)));
            CHECK(counts.skipped_rays == std::uint64_t(4 * rays));
            CHECK(counts.shadow_rays == 0);
        }
    // What is said to be lit is not looked at, even behind a screen; what is not is.
    const World hidden(lit_floor(true));
    const Vertex shaded = below(hidden, {-3, 0.1f, 0});
    for (const Verdict known : {lit, ask}) {
        auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
        Counts counts;
        auto context = context_of(stream, counts);
        const Rgb seen =
            sample_all_lights(hidden, shaded, white, {DirectLight::analytic, 2},
                              context, [&](std::size_t) { return known; });
        CHECK(double(seen.x) ==
              doctest::Approx(known == lit ? 0.5 * 3 * strip(-3, -0.5, 0.5) : 0)
                  .epsilon(1e-3));
    }
}

TEST_CASE("all lights: who goes by which way, number by number") {
    const World world(lit_floor(false));
    const Vertex at = below(world, {0.2f, 0.1f, 0});
    const Lambertian white{.albedo = Rgb{0.5f}};
    const Glossy gloss{.reflectance = Rgb{0.9f}, .roughness = 0.3f};
    const auto once = [&](const auto& material, DirectLight how, const auto& of) {
        auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, 7);
        Counts counts;
        auto context = context_of(stream, counts);
        return sample_all_lights(of, at, material, {how, 3}, context);
    };
    // A gloss has no closed form: both ways, as if that had been asked for.
    CHECK(once(gloss, DirectLight::analytic, world) ==
          once(gloss, DirectLight::mis, world));
    CHECK(once(gloss, DirectLight::sampled, world) !=
          once(gloss, DirectLight::mis, world));
    CHECK(once(white, DirectLight::analytic, world) !=
          once(white, DirectLight::mis, world));
    // No path meets a point light: its shadow rays have all of it.
    Lit with_bulb;
    with_bulb.add(Quad{.corner{-50, 0, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
                  with_bulb.add(white));
    with_bulb.add(PointLight{.position{0, 2, 0}, .intensity = Rgb{7}});
    const World lamp(std::move(with_bulb));
    const double right = 0.5 / pi * 7 * 2 / std::pow(4.04, 1.5);
    for (const DirectLight how :
         {DirectLight::sampled, DirectLight::mis, DirectLight::analytic})
        CHECK(double(once(white, how, lamp).x) == doctest::Approx(right).epsilon(1e-4));
    // A material without such a lobe sends no ray.
    auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, 7);
    Counts counts;
    auto context = context_of(stream, counts);
    CHECK(detail::found_light(world, at, Mirror{}, 1, context) == Rgb{0});
    CHECK(counts.shadow_rays == 0);
    // No form factor of what has no surface, and none of a light behind the surface.
    CHECK_FALSE(detail::seen_lamp(lamp, 0, at));
    CHECK(detail::seen_lamp(world, 0, at)->radiance == Rgb{3});
    CHECK(detail::seen_lamp(world, 0, at)->form_factor ==
          doctest::Approx(strip(0.2, -0.5, 0.5)).epsilon(1e-4));
    Vertex turned = at;
    turned.wo.z = -at.wo.z;
    CHECK(detail::seen_lamp(world, 0, turned)->form_factor == 0);
}

TEST_CASE("all lights: a lamp that moves, at the time of the path") {
    // A square that goes 4 to the right in a second; closed form by the strip it is.
    using Passing = Scene<Shapes<Quad, Moving<Quad>>, Materials<Lambertian>>;
    Passing scene;
    const Lambertian white{.albedo = Rgb{0.5f}};
    const auto floor = scene.add(white),
               black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{.corner{-50, 0, -50}, .edge_u{0, 0, 100}, .edge_v{100, 0, 0}},
              floor);
    const Quad lamp{.corner{-0.5f, 1, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}};
    scene.add(Moving<Quad>{lamp, {4, 0, 0}}, black, Rgb{3});
    const World world(std::move(scene));
    Vertex at = below(world, {1, 0.1f, 0});
    for (const float time : {0.0f, 0.25f, 0.9f}) {
        at.time = time;
        const double x = double(4 * time);
        const double right = 0.5 * 3 * strip(1, x - 0.5, x + 0.5);
        CAPTURE(time);
        for (const DirectLight how :
             {DirectLight::sampled, DirectLight::analytic, DirectLight::mis}) {
            const Mean seen = direct(world, at, white, how, 4, 2000);
            CHECK(std::abs(apart(seen, right, 1e-4)) < 5);
        }
    }
}

TEST_CASE("all lights: a narrow gloss sees a lamp by its own ray") {
    const World world(lit_floor(false));
    const Vertex at = below(world, {0.3f, 0.1f, 0});
    const Glossy gloss{.reflectance = Rgb{0.9f}, .roughness = 0.02f};
    const Mean both = direct(world, at, gloss, DirectLight::mis, 1, 20000);
    const Mean rays = direct(world, at, gloss, DirectLight::sampled, 1, 400000);
    // Straight up all of the narrow lobe meets the lamp.
    CHECK(std::abs(both.mean - 0.9 * 3) < 4 * both.error() + 0.005);
    CHECK(both.error() * std::sqrt(20000.0) < 0.2 * rays.error() * std::sqrt(400000.0));
}

TEST_CASE("form_factor_from: a sphere, by the horizon") {
    const Vec3 up{0, 1, 0};
    const auto factor = [&](const Sphere& ball, bool inside_out = false) {
        return form_factor_from(Vec3{0}, up, ball, inside_out);
    };
    // Wholly above: (r/d)^2 cos. Below: nothing arrives. Cut,
    // inside, or turned: not known.
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

TEST_CASE("all lights: what a ray finds by itself, number by number") {
    // A ball of light that goes to the right, in a fog: by the direction that the
    // material draws, by whether it meets the ball where it is then, and by the density
    // 1 / (2 pi (1 - cos)) of a shadow ray towards its cone.
    using D3 = glm::dvec3;
    using Ball = SphereT<double>;
    Scene<Shapes<QuadT<double>, Moving<Ball>>, Materials<LambertianT<double>>> scene;
    const LambertianT<double> matt{.albedo{0.8, 0.5, 0.2}};
    const D3 radiance{3, 2, 1}, fog{0.1, 0.2, 0.3};
    scene.add(QuadT<double>{{-50, 0, -50}, {0, 0, 100}, {100, 0, 0}}, scene.add(matt));
    scene.add(Moving<Ball>{{.center{0, 2, 0}, .radius = 1.5}, {6, 0, 0}},
              scene.add(LambertianT<double>{.albedo = D3{0}}), radiance);
    const RayT<double> down{.origin{0, 0.3, 0}, .direction{0, -1, 0}};
    const World world(std::move(scene));
    auto at = vertex_at(world, down, *closest_hit(world, down));
    at.medium = fog;
    int met = 0;
    for (const double time : {0.0, 0.25, 0.5, 0.6})
        for (const int rays : {1, 4})
            for (std::uint64_t i = 0; i < 100; ++i) {
                at.time = time;
                if (time == 0.6) { // a shading normal that leans changes no radiance
                    at.frame = frame_around(glm::normalize(D3{0.3, 1, 0}));
                    at.wo = to_local(at.frame, D3{0, 1, 0});
                    at.smooth = true;
                }
                auto stream = random_stream(8, Pass::user, 0, i);
                auto twin = stream;
                Counts counts;
                auto context = context_of(stream, counts);
                const D3 seen = detail::found_light(world, at, matt, rays, context);
                const D3 local =
                    sample(matt, at.wo, next_3d<double>(twin), Transport::radiance)->wi;
                const D3 way = to_world(at.frame, local), center{6 * time, 2, 0};
                const double d2 = glm::dot(center, center);
                const double along = glm::dot(way, center);
                const double inside = 2.25 - (d2 - along * along);
                D3 right{0};
                if (inside > 0 && along > 0) {
                    const double cone = 2 * pi * (1 - std::sqrt(1 - 2.25 / d2));
                    const double own = local.z / pi;
                    right = own / (own + rays / cone) * matt.albedo * radiance *
                            glm::exp(-(along - std::sqrt(inside)) * fog);
                    ++met;
                }
                CHECK(glm::distance(seen, right) < 1e-9);
                CHECK(counts.shadow_rays == 1);
            }
    CHECK(met > 100);
}

namespace {

/// A stream that notes to which bounces' numbers it is moved.
struct NotingStream {
    RandomStream stream;
    std::vector<std::uint64_t>* bounces;
};
template <std::floating_point T>
T next_1d(NotingStream& noting) {
    return next_1d<T>(noting.stream);
}
template <std::floating_point T>
Vec2T<T> next_2d(NotingStream& noting) {
    return next_2d<T>(noting.stream);
}
template <std::floating_point T>
Vec3T<T> next_3d(NotingStream& noting) {
    return next_3d<T>(noting.stream);
}
void start_bounce(NotingStream& noting, std::uint64_t bounce) {
    noting.bounces->push_back(bounce);
    start_bounce(noting.stream, bounce);
}

} // namespace

TEST_CASE("all lights: the ray towards a lamp takes no numbers of the path's own") {
    const World world(lit_floor(false));
    const Vertex at = below(world, {0.2f, 0.5f, 0.1f});
    std::vector<std::uint64_t> bounces;
    NotingStream stream{random_stream(1, Pass::user, 0, 0), &bounces};
    Counts counts;
    auto context = context_of(stream, counts);
    (void)detail::found_light(world, at, Lambertian{.albedo = Rgb{0.5f}}, 1, context);
    REQUIRE(bounces.size() == 1);
    // The path's bounces count from 1; no path has as many as 2^32.
    CHECK(bounces[0] > 0xffffffffu);
}

TEST_CASE("all lights: the rays of a pixel share out all cells of a lamp") {
    // Five shadow rays have 25 cells and stand in 5 of them. A screen hides a quarter
    // of the lamp, 2 1/2 cells by 2 1/2: if all rays of a pixel chose the same 5, no
    // number of them would find 3/4. 20 480 rays that know nothing of each other have
    // a standard error of 0.4 per cent.
    Lit scene = lit_floor(false);
    scene.add(Quad{.corner{-9, 0.999f, -9}, .edge_u{0, 0, 9}, .edge_v{9, 0, 0}},
              scene.add(Lambertian{.albedo = Rgb{0}}));
    const World world(std::move(scene));
    const Vertex at = below(world, {0, 0.1f, 0});
    const Lambertian white{.albedo = Rgb{0.5f}};
    const double right = 0.75 * 0.5 * 3 * strip(0, -0.5, 0.5);
    const auto pattern = make_pattern(Sampling::jittered, 4096);
    for (std::uint64_t pixel = 0; pixel < 4; ++pixel) {
        double sum = 0;
        Counts counts;
        for (int ray = 0; ray < pattern.points; ++ray) {
            StratifiedStream stream;
            start_ray(stream, ljus_test::test_seed(3), pixel, ray, pattern);
            start_bounce(stream, 1);
            auto context = context_of(stream, counts);
            sum += double(
                sample_all_lights(world, at, white, {DirectLight::sampled, 5}, context)
                    .x);
        }
        CHECK(sum / pattern.points == doctest::Approx(right).epsilon(0.025));
    }
}

TEST_CASE("all lights: of a material that is part mirror the matt part is shared") {
    // In a furnace of radiance 2 half of the light is mirrored, and of the rest the
    // matt part sends back its colour.
    const auto room = box_furnace(Rgb{2}, Rgb{0.5f});
    const Mixture half{.color = Rgb{0.8f}, .reflectivity = 0.5f};
    const Vertex at = below(room.world, {0.3f, -0.9f, 0.2f});
    for (const int rays : {1, 4})
        for (const DirectLight how :
             {DirectLight::sampled, DirectLight::mis, DirectLight::analytic}) {
            const Mean seen = direct(room.world, at, half, how, rays, 20000);
            CAPTURE(rays);
            CAPTURE(int(how));
            CHECK(std::abs(apart(seen, 0.8, 1e-5)) < 5); // once in 1.7 million each
        }
}
