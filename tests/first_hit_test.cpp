/// \file first_hit_test.cpp
/// \brief Pictures of normals, albedos and depths against geometry and quadrature.

#include "ljus/render/first_hit.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/materials/soap_film.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"

using namespace ljus;

namespace {

/// What one ray sees.
template <typename W>
Rgb seen(const W& world, FirstHit shown, const Ray& ray) {
    auto stream = random_stream(1, Pass::camera, 0, 0);
    Counts counts;
    auto context = context_of(stream, counts);
    return radiance(FirstHitRenderer(world, shown), ray, context);
}

const Ray ahead{}; // from the origin along -z
const Sphere ball{.center{0, 0, -5}, .radius = 1};

} // namespace

TEST_CASE("first hit: normals face the eye, outside of a ball and within") {
    const World world(make_scene(placed(ball, Lambertian{})));
    const auto normal = [&](const Ray& ray) { // decoded
        return 2.0f * seen(world, FirstHit::normals, ray) - 1.0f;
    };
    CHECK(distance(normal(ahead), Vec3{0, 0, 1}) < 1e-5f);
    const Ray beside{.origin{0.6f, 0, 0}};
    CHECK(distance(normal(beside), Vec3{0.6f, 0, 0.8f}) < 1e-5f);
    const Ray within{.origin{0.6f, 0, -5}};
    CHECK(distance(normal(within), Vec3{-0.6f, 0, 0.8f}) < 1e-5f);
    CHECK(normal({.direction{1, 0, 0}}) == Vec3{0}); // it hits nothing
}

TEST_CASE("first hit: depth is the distance along the ray") {
    const World world(make_scene(placed(ball, Lambertian{})));
    const auto depth = [&](const Ray& ray) {
        return seen(world, FirstHit::depth, ray);
    };
    CHECK(depth(ahead).x == doctest::Approx(4));
    CHECK(depth({.origin{0.6f, 0, 0}}).x == doctest::Approx(4.2));
    CHECK(depth({.direction{1, 0, 0}}) == Rgb{0});
}

TEST_CASE(
    "first hit: a Lambertian surface, a mirror and glass have their albedo exactly") {
    const Rgb color{0.2f, 0.5f, 0.9f};
    const World matt(make_scene(placed(ball, Lambertian{.albedo = color})));
    CHECK(distance(seen(matt, FirstHit::albedo, ahead), color) < 1e-6f);
    CHECK(seen(matt, FirstHit::albedo, {.direction{1, 0, 0}}) == Rgb{0});
    const World mirror(make_scene(placed(ball, Mirror{.reflectance = color})));
    CHECK(distance(seen(mirror, FirstHit::albedo, ahead), color) < 1e-6f);
    const World glass(make_scene(placed(ball, Glass{})));
    CHECK(seen(glass, FirstHit::albedo, ahead) == Rgb{1});
    CHECK(seen(glass, FirstHit::albedo, {.origin{0.6f, 0, -5}}) == Rgb{1}); // within
}

// Each mean of 20 000 rays lies beyond 5 standard errors once in 1.7 million seeds.
TEST_CASE("first hit: the albedo of a rough surface is the integral of f cos") {
    const OrenNayar rough{.albedo = Rgb{0.8f}, .sigma = 0.6f};
    const World world(
        make_scene(placed(Quad{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}}, rough)));
    const Vec3 wo = normalize(Vec3{1, 0, 0.5f});
    double exact = 0; // the midpoint rule in (cos, phi)
    constexpr int n = 300;
    for (int i = 0; i < n * n; ++i) {
        const float z = (float(i % n) + 0.5f) / n, r = std::sqrt(1 - z * z);
        const float phi =
            2 * std::numbers::pi_v<float> * (float(int(i / n)) + 0.5f) / n;
        const Vec3 wi{r * std::cos(phi), r * std::sin(phi), z};
        exact += double(evaluate(rough, wo, wi).x * z) * 2 * std::numbers::pi / (n * n);
    }
    const auto mean = ljus_test::mean_radiance(
        FirstHitRenderer(world, FirstHit::albedo), 20000, 1,
        [&](RandomStream&) { return Ray{.origin = wo, .direction = -wo}; });
    CHECK(exact < 0.8);
    CHECK(std::abs(mean.mean - exact) < 5 * mean.error() + 1e-4);
}

TEST_CASE("first hit: a soap film shows what it reflects and what lies behind it") {
    const SoapFilm film{.thickness = 260, .index = 2.4f};
    const World world(
        make_scene(placed(Quad{{-9, -9, -2}, {18, 0, 0}, {0, 18, 0}}, film),
                   placed(ball, Lambertian{.albedo = Rgb{0.25f}})));
    const Rgb through = pass_through(film, Vec3{0, 0, -2}, Vec3{0, 0, 1});
    CHECK(through.y < 0.9f);
    for (int channel = 0; channel < 3; ++channel) {
        const auto mean = ljus_test::mean_radiance(
            FirstHitRenderer(world, FirstHit::albedo), 20000, 1,
            [](RandomStream&) { return ahead; }, channel);
        const double exact = 1 - 0.75 * double(through[channel]);
        CAPTURE(channel);
        CHECK(std::abs(mean.mean - exact) < 5 * mean.error() + 1e-4);
    }
}

TEST_CASE("first hit: render() makes its pictures, in double as well") {
    Scene<Shapes<SphereT<double>>, Materials<LambertianT<double>>> scene;
    scene.add(SphereT<double>{.center{0, 0, -5}, .radius = 1},
              scene.add(LambertianT<double>{}));
    const World world(std::move(scene));
    const FirstHitRenderer depth(world, FirstHit::depth);
    static_assert(Renderer<decltype(depth), double>);
    const auto picture =
        render(depth, CameraT<double>{}, {.width = 9, .height = 9, .samples = 16});
    CHECK(picture.counts.bounce_rays == 0);
    CHECK(pixel(picture.image, 4, 4).x == doctest::Approx(4).epsilon(0.05));
    CHECK(pixel(picture.image, 0, 0).x == 0);
}
