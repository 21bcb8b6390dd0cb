/// \file environment_test.cpp
/// \brief Light from a picture of the sky, against closed forms, quadrature, a sun, and
/// photons against paths.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million, and once
/// in 200 000 where the error comes from 64 passes of photons.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <utility>
#include <vector>

#include "experiments/uniform_sky.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/lights/environment.hpp"
#include "ljus/lights/sun_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/plain_photon_mapping.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::Mean;
using ljus_test::mean_radiance;
using ljus_test::refusal;

static_assert(LightSource<EnvironmentLight> && FarLight<EnvironmentInSceneT<float>> &&
              FillsSky<EnvironmentInSceneT<float>> &&
              LightSource<EnvironmentLightT<double>>);

namespace {

constexpr double pi = std::numbers::pi;

/// A light within a sphere around a scene.
template <std::floating_point T>
EnvironmentInSceneT<T> prepared(const EnvironmentLightT<T>& light, T radius = 2) {
    check(light);
    return in_scene(light, SphereT<T>{.radius = radius});
}

/// A picture of colours that are drawn at random, some of them black, one bright.
template <std::floating_point T>
ImageT<T> drawn_picture(int width, int height) {
    auto picture = make_image<T>(width, height);
    auto stream = random_stream(7, Pass::user, 0, 0);
    for (auto& c : picture.pixels)
        if (next_1d<T>(stream) > T(0.2))
            c = {next_1d<T>(stream), next_1d<T>(stream), next_1d<T>(stream)};
    pixel(picture, width / 3, height / 3) = RgbT<T>{T(20)};
    return picture;
}

/// The integral over all directions, by the midpoint rule in the angles.
template <typename F>
double over_sphere(int steps, const F& f) {
    double sum = 0;
    for (int j = 0; j < steps; ++j)
        for (int i = 0; i < 2 * steps; ++i) {
            const double theta = pi * (j + 0.5) / steps, phi = pi * (i + 0.5) / steps;
            sum += std::sin(theta) *
                   f(Vec3T<double>{std::sin(theta) * std::cos(phi), std::cos(theta),
                                   std::sin(theta) * std::sin(phi)});
        }
    return sum * (pi / steps) * (pi / steps);
}

/// A ray that meets a ball of radius 1 at the origin, wherever.
Ray at_the_ball(RandomStream& stream) {
    const Vec3 from = 5.0f * sample_uniform_sphere(next_2d<float>(stream));
    const Vec3 to = 0.9f * sample_uniform_sphere(next_2d<float>(stream));
    return {.origin = from, .direction = glm::normalize(to - from)};
}

constexpr float floor_side = 4;

/// A floor around the origin, facing +y.
Quad floor_at(float height) {
    return {{-floor_side / 2, height, -floor_side / 2},
            {0, 0, floor_side},
            {floor_side, 0, 0}};
}

} // namespace

TEST_CASE_TEMPLATE("environment: where each column and row lies", T, float, double) {
    auto picture = make_image<T>(4, 3);
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 4; ++x) pixel(picture, x, y) = RgbT<T>(T(1 + x + 4 * y));
    const auto seen = [&](const Vec3T<T>& wi, T degrees) {
        const EnvironmentLightT<T> light{.picture = picture,
                                         .rotation_degrees = degrees};
        return escaped_radiance(prepared(light), glm::normalize(wi)).x;
    };
    const T e = T(0.01);
    CHECK(seen({0, 1, -e}, 45) == 3); // the columns turn with it
    CHECK(seen({0, -1, -e}, 45) == 11);
    CHECK(seen({-e, 0, -1}, 0) == 6); // left and right of the middle
    CHECK(seen({e, 0, -1}, 0) == 7);
    CHECK(seen({1, 0, -e}, 0) == 7);
    CHECK(seen({1, 0, e}, 0) == 8);
    CHECK(seen({e, 0, 1}, 0) == 8); // the seam
    CHECK(seen({-e, 0, 1}, 0) == 5);
    CHECK(seen({-1, 0, e}, 0) == 5);
    // Counter-clockwise from above: what was in front is to the left.
    CHECK(seen({-1, 0, -e}, 90) == 7);
    CHECK(seen({-1, 0, e}, 90) == 6);
    CHECK(seen({e, 0, -1}, 90) == 8);
    CHECK(seen({1, 0, 1}, 90) == 5); // across the seam
    CHECK(seen({-1, 0, 1}, -90) == 8);
    CHECK(seen({e, 0, -1}, 450) == 8);
    CHECK(seen({e, 0, -1}, -270) == 8);
}

TEST_CASE("environment: a whole turn changes nothing, to the last bit") {
    const Image picture = drawn_picture<float>(16, 9);
    const auto still = prepared(EnvironmentLight{.picture = picture});
    const auto turned =
        prepared(EnvironmentLight{.picture = picture, .rotation_degrees = -720});
    for (std::uint64_t i = 0; i < 2000; ++i) {
        auto stream = random_stream(3, Pass::user, 0, i);
        const Vec2 u = next_2d<float>(stream);
        const auto a = sample_light(still, Vec3{0}, u, 0.0f);
        const auto b = sample_light(turned, Vec3{0}, u, 0.0f);
        REQUIRE(a->wi == b->wi);
        REQUIRE(a->pdf == b->pdf);
        const Vec3 d = sample_uniform_sphere(next_2d<float>(stream));
        REQUIRE(escaped_radiance(still, d) == escaped_radiance(turned, d));
    }
}

TEST_CASE_TEMPLATE("environment: the density integrates to 1, and the flux is right", T,
                   float, double) {
    const std::pair<int, int> sizes[] = {{1, 1}, {1, 7}, {6, 1}, {12, 5}, {9, 8}};
    for (const auto& size : sizes) {
        const int width = size.first, height = size.second;
        CAPTURE(width);
        CAPTURE(height);
        const auto light =
            prepared(EnvironmentLightT<T>{.picture = drawn_picture<T>(width, height),
                                          .strength = T(3),
                                          .rotation_degrees = T(50)});
        // Borders of pixels lie between the 360 steps of half a degree, or on them.
        const int steps = 360;
        CHECK(over_sphere(steps, [&](const Vec3T<double>& d) {
                  return double(pdf_escaped(light, Vec3T<T>(d)));
              }) == doctest::Approx(1).epsilon(0.01));
        const double green = over_sphere(steps, [&](const Vec3T<double>& d) {
            return double(escaped_radiance(light, Vec3T<T>(d)).y);
        });
        CHECK(double(light.sum.y) == doctest::Approx(green).epsilon(0.01));
        CHECK(double(power(light).y) == doctest::Approx(4 * pi * double(light.sum.y)));
    }
    const auto even = prepared(EnvironmentLightT<T>{.strength = T(3)}, T(5));
    CHECK(double(power(even).x) == doctest::Approx(3 * 4 * pi * 25 * pi));
    CHECK(double(pdf_escaped(even, Vec3T<T>{0, 1, 0})) ==
          doctest::Approx(1 / (4 * pi)));
}

TEST_CASE_TEMPLATE("environment: directions are drawn with their density, at the poles "
                   "and across the seam",
                   T, float, double) {
    const auto light = prepared(EnvironmentLightT<T>{.picture = drawn_picture<T>(6, 5),
                                                     .rotation_degrees = T(20)});
    // Cells around another axis, so that poles and seam lie within cells.
    constexpr int belts = 12, parts = 24, n = 200000;
    const auto cell_of = [&](const Vec3T<double>& d) {
        const int belt = std::min(int((d.x + 1) / 2 * belts), belts - 1);
        const double turn = std::atan2(d.y, d.z) / (2 * pi) + 0.5;
        return std::size_t(belt * parts + std::min(int(turn * parts), parts - 1));
    };
    std::vector<double> counts(belts * parts), expected(belts * parts);
    const int steps = 1000;
    (void)over_sphere(steps, [&](const Vec3T<double>& d) {
        const double sine = std::sqrt(d.x * d.x + d.z * d.z);
        expected[cell_of(d)] += n * sine * (pi / steps) * (pi / steps) *
                                double(pdf_escaped(light, Vec3T<T>(d)));
        return 0.0;
    });
    int elsewhere = 0; // in the next pixel, by rounding
    for (std::uint64_t i = 0; i < n; ++i) {
        auto stream = random_stream(ljus_test::test_seed(1), Pass::user, 0, i);
        const auto sample =
            sample_light(light, Vec3T<T>{T(0)}, next_2d<T>(stream), T(0));
        REQUIRE(sample);
        const Vec3T<T>& wi = sample->wi;
        REQUIRE(glm::dot(wi, wi) == doctest::Approx(1).epsilon(1e-5));
        REQUIRE(sample->pdf > 0);
        counts[cell_of(Vec3T<double>(wi))] += 1;
        const RgbT<T> seen = escaped_radiance(light, wi);
        const RgbT<T> sent = sample->weight * sample->pdf;
        if (std::abs(seen.x - sent.x) > T(1e-5) * sent.x) ++elsewhere;
    }
    CHECK(elsewhere < n / 10000);
    const auto chi = ljus_test::chi_square(counts, expected);
    CHECK(chi.cells > 100);
    CHECK(chi.sum < chi.limit());
}

TEST_CASE_TEMPLATE("environment: a bright spot at either pole is one disc", T, float,
                   double) {
    for (const bool below : {false, true}) {
        // 4096 rows: the disc has a radius of 0.04 degrees.
        auto picture = make_image<T>(3, 4096);
        for (int x = 0; x < 3; ++x) pixel(picture, x, below ? 4095 : 0) = RgbT<T>(T(1));
        const auto light = prepared(EnvironmentLightT<T>{.picture = picture});
        const double radius = pi / 4096;
        const double disc = 2 * pi * (2 * std::pow(std::sin(radius / 2), 2));
        Mean squared;
        double across[2] = {}, most = 0;
        for (std::uint64_t i = 0; i < 20000; ++i) {
            auto stream = random_stream(ljus_test::test_seed(2), Pass::user, 0, i);
            const auto sample =
                sample_light(light, Vec3T<T>{T(0)}, next_2d<T>(stream), T(0));
            REQUIRE(double(sample->pdf) == doctest::Approx(1 / disc).epsilon(1e-5));
            REQUIRE((sample->wi.y < 0) == below);
            const double x = double(sample->wi.x) / radius;
            const double z = double(sample->wi.z) / radius;
            most = std::max(most, x * x + z * z);
            squared.add(x * x + z * z); // uniform on a disc: 1/2
            across[0] += x;
            across[1] += z;
        }
        CHECK(most < 1.0001);
        CHECK(squared.agrees_with(0.5));
        // The mean of 20000 with the variance 1/4, by 5 standard errors.
        CHECK(std::abs(across[0]) < 5 * std::sqrt(20000 * 0.25));
        CHECK(std::abs(across[1]) < 5 * std::sqrt(20000 * 0.25));
    }
}

TEST_CASE("environment: a matt floor under an even sky returns its albedo") {
    const World world(
        make_scene(placed(floor_at(0), Lambertian{.albedo{0.2f, 0.5f, 1}}),
                   EnvironmentLight{.strength = 3}));
    const auto down = [](RandomStream&) {
        return Ray{.origin{0.3f, 4, 0.2f}, .direction{0, -1, 0}};
    };
    for (const MisHeuristic how : {MisHeuristic::shadow_rays, MisHeuristic::balance}) {
        const PathTracer tracer(world, {.heuristic = how});
        CHECK(mean_radiance(tracer, 10000, 1, down, 0).agrees_with(0.6));
        CHECK(mean_radiance(tracer, 10000, 2, down, 1).agrees_with(1.5));
        CHECK(mean_radiance(tracer, 10000, 3, down, 2).agrees_with(3));
    }
    // By paths alone there is no noise at all.
    const PathTracer patient(world, {.sample_lights = false});
    CHECK(mean_radiance(patient, 100, 4, down, 1).mean == doctest::Approx(1.5));
    CHECK(mean_radiance(patient, 100, 4, down, 1).error() < 1e-6);
}

TEST_CASE("environment: a white ball in a white world is invisible") {
    const World world(
        make_scene(placed(Sphere{}, Lambertian{.albedo = Rgb{1}}), EnvironmentLight{}));
    const PathTracer patient(world, {.sample_lights = false});
    const Mean by_paths = mean_radiance(patient, 2000, 1, at_the_ball);
    CHECK(by_paths.mean == doctest::Approx(1).epsilon(1e-5));
    CHECK(by_paths.error() < 1e-6);
    CHECK(mean_radiance(PathTracer(world), 20000, 2, at_the_ball).agrees_with(1));
    const PhotonMapper mapper(world, {.caustics{.photons = 0}});
    CHECK(mean_radiance(mapper, 20000, 3, at_the_ball).agrees_with(1));
    // Beside it one looks into the sky, by photon maps of both kinds.
    Counts counts;
    RandomStream stream;
    auto context = context_of(stream, counts);
    const Ray past{.origin{0, 0, 5}, .direction{0, 1, 0}};
    CHECK(radiance(mapper, past, context) == Rgb{1});
    CHECK(radiance(PlainPhotonMapper(world, PhotonMap{}, {.radius = 1}), past,
                   context) == Rgb{1});
    // So one does where there is nothing at all.
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<EnvironmentLight>> empty;
    empty.add(EnvironmentLight{.strength = 2});
    const World nothing(std::move(empty));
    CHECK(radiance(PathTracer(nothing), past, context) == Rgb{2});
    CHECK(radiance(PhotonMapper(nothing), past, context) == Rgb{2});
}

TEST_CASE("environment: a gradient sky on tilted floors, by quadrature") {
    const Rgb horizon{4, 2, 1}, zenith{1, 2, 6}, ground{0.5f, 0.25f, 0.1f};
    const EnvironmentLight sky{.picture = gradient_sky(horizon, zenith, ground)};
    for (const double degrees : {0.0, 30.0, 90.0, 150.0, 180.0}) {
        CAPTURE(degrees);
        const double tilt = degrees * pi / 180;
        const Vec3T<double> n{std::sin(tilt), std::cos(tilt), 0};
        const Vec3 normal(n), side{0, 0, 2};
        const Vec3 other = glm::cross(side, normal);
        const World world(make_scene(
            placed(Quad{-(side + other) / 2.0f, side, other}, Lambertian{}), sky));
        for (int channel = 0; channel < 3; channel += 2) {
            const double right = over_sphere(400, [&](const Vec3T<double>& d) {
                const double cosine = std::max(0.0, glm::dot(d, n));
                const Rgb l =
                    d.y > 0 ? horizon + float(d.y) * (zenith - horizon) : ground;
                return cosine * double(l[channel]);
            });
            const auto ray = [&](RandomStream&) {
                return Ray{.origin = 2.0f * normal, .direction = -normal};
            };
            const Mean seen = mean_radiance(PathTracer(world), 40000, 5, ray, channel);
            const double albedo = double(Lambertian{}.albedo.x);
            CHECK(seen.agrees_with(albedo * right / pi, 1e-3));
            CHECK(seen.error() < 0.02 * seen.mean);
        }
    }
    // In closed form: pi h + (z - h) 2 pi / 3 on a level floor.
    const auto light = prepared(sky);
    double up = 0;
    for (int y = 0; y < 128; ++y) {
        const double high = std::cos(pi * y / 256), low = std::cos(pi * (y + 1) / 256);
        up += double(pixel(light.picture, 0, y).x) * pi * (high * high - low * low);
    }
    CHECK(up == doctest::Approx(4 * pi - 3 * 2 * pi / 3).epsilon(1e-4));
}

TEST_CASE("environment: a sun of one pixel is a sun") {
    // A pixel of half a degree, high in the sky, that brings E = 5 W/m^2.
    constexpr int width = 720, height = 360;
    Image picture = make_image(width, height);
    const int column = 500, row = 100;
    const double omega =
        2 * pi / width *
        (std::cos(pi * row / height) - std::cos(pi * (row + 1) / height));
    pixel(picture, column, row) = Rgb{float(5 / omega)};
    const double theta = pi * (row + 0.5) / height;
    const double phi = 2 * pi * (column + 0.5) / width - pi;
    const Vec3 to_sun(Vec3T<double>{std::sin(theta) * std::sin(phi), std::cos(theta),
                                    -std::sin(theta) * std::cos(phi)});
    const Lambertian matt{.albedo = Rgb{0.5f}};
    const auto scene_under = [&](const auto& light) {
        return World(make_scene(placed(floor_at(0), matt),
                                placed(Sphere{{0, 1, 0}, 0.5f}, matt), light));
    };
    const auto by_picture = scene_under(EnvironmentLight{.picture = picture});
    const auto by_sun =
        scene_under(SunLight{.direction = -to_sun, .irradiance = Rgb{5}});
    CHECK(double(by_picture.powers()[0].x) ==
          doctest::Approx(double(by_sun.powers()[0].x)).epsilon(1e-4));

    const Vec3 shade = Vec3{0, 1, 0} - to_sun / to_sun.y;
    for (const Vec3& point :
         {Vec3{1, 0, 1}, Vec3{-1.5f, 0, -1}, Vec3{shade.x, 0, shade.z}}) {
        const auto ray = [&](RandomStream&) {
            const Vec3 from = point + Vec3{2, 1.5f, 2};
            return Ray{.origin = from, .direction = glm::normalize(point - from)};
        };
        const Mean a = mean_radiance(PathTracer(by_picture), 20000, 6, ray);
        const Mean b = mean_radiance(PathTracer(by_sun), 20000, 7, ray);
        CHECK(std::abs(a.mean - b.mean) < 5 * std::hypot(a.error(), b.error()) + 0.005);
    }
    // Its photons are parallel up to half a pixel, and bring E to the floor.
    const auto traced = trace_photons(by_picture, MapType::general,
                                      {.photons = 20000,
                                       .seed = ljus_test::test_seed(1),
                                       .shadow_photons = false,
                                       .threads = 1});
    double corner = 0, in_corner = 0;
    for (const Photon& photon : traced.photons) {
        if (photon.kind != PhotonKind::direct) continue;
        REQUIRE(glm::dot(-photon.direction, to_sun) > std::cos(0.5 * pi / 180));
        if (photon.position.x > 0.8f && photon.position.z > 0.8f &&
            photon.position.y < 0.1f) {
            corner += double(photon.flux.x);
            in_corner += 1;
        }
    }
    const double e = 5 * double(to_sun.y) * 1.2 * 1.2;
    CHECK(std::abs(corner - e) < 5 * e / std::sqrt(in_corner));
}

TEST_CASE("environment: mirrors show the pixel, to the last bit") {
    const Image picture = drawn_picture<float>(32, 16);
    const EnvironmentLight sky{.picture = picture, .rotation_degrees = 33};
    const auto light = prepared(sky);
    const World world(make_scene(
        placed(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, Mirror{.reflectance = Rgb{1}}),
        sky));
    Counts counts;
    for (std::uint64_t i = 0; i < 200; ++i) {
        auto stream = random_stream(4, Pass::user, 0, i);
        auto context = context_of(stream, counts);
        Vec3 from = 3.0f * sample_uniform_sphere(next_2d<float>(stream));
        from.z = 0.1f + std::abs(from.z);
        const Ray ray{.origin = from, .direction = glm::normalize(-from)};
        const Vec3 mirrored{ray.direction.x, ray.direction.y, -ray.direction.z};
        const Rgb right = escaped_radiance(light, mirrored);
        REQUIRE(radiance(PathTracer(world), ray, context) == right);
        REQUIRE(radiance(PhotonMapper(world, {.caustics{.photons = 0}}), ray,
                         context) == right);
    }
}

namespace {

/// A sky of two radiances with a broad bright part, which paths find by chance.
/// \param row  Of four: 0 is above 45 degrees, 1 below.
EnvironmentLight bright_part(int row) {
    Image picture = make_image(8, 4, Rgb{1, 0.5f, 0.25f});
    for (int x = 2; x < 4; ++x) pixel(picture, x, row) = Rgb{20, 10, 2};
    return {.picture = picture};
}

/// The irradiance of a part of a floor at height 0, by photons that land there from
/// above, one value per seed.
template <typename W>
Mean by_photons(const W& world, std::initializer_list<MapType> maps, const Vec2& low,
                const Vec2& high, long long photons) {
    Mean mean;
    for (std::uint64_t seed = 1; seed <= 64; ++seed) {
        double flux = 0;
        for (const MapType map : maps) {
            const auto traced = trace_photons(world, map,
                                              {.photons = photons,
                                               .seed = ljus_test::test_seed(seed),
                                               .shadow_photons = false,
                                               .threads = 1});
            for (const Photon& photon : traced.photons)
                if (std::abs(photon.position.y) < 1e-4f && photon.direction.y < 0 &&
                    photon.position.x > low.x && photon.position.x < high.x &&
                    photon.position.z > low.y && photon.position.z < high.y)
                    flux += double(photon.flux.x);
        }
        mean.add(flux / double((high.x - low.x) * (high.y - low.y)));
    }
    return mean;
}

/// The same by paths that start there, of a white floor's own radiance times pi.
template <typename W>
Mean by_paths(const W& world, const Vec2& low, const Vec2& high, double albedo,
              long long paths) {
    const auto ray = [&](RandomStream& stream) {
        const Vec2 at = low + next_2d<float>(stream) * (high - low);
        return Ray{.origin{at.x, 0.02f, at.y}, .direction{0, -1, 0}};
    };
    const Mean seen = mean_radiance(PathTracer(world), paths, 8, ray);
    Mean mean = seen;
    mean.mean *= pi / albedo;
    mean.squares *= (pi / albedo) * (pi / albedo);
    return mean;
}

} // namespace

namespace {

/// A room of 2 x 2 x 2 whose wall at x = -1 is open between heights 0.5 and 1.5.
auto room_with_window() {
    const Lambertian wall{.albedo{0.6f, 0.5f, 0.4f}};
    return World(make_scene(placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, wall),
                            placed(Quad{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}}, wall),
                            placed(Quad{{1, 0, -1}, {0, 0, 2}, {0, 2, 0}}, wall),
                            placed(Quad{{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}}, wall),
                            placed(Quad{{-1, 0, 1}, {0, 2, 0}, {2, 0, 0}}, wall),
                            placed(Quad{{-1, 0, -1}, {0, 0.5f, 0}, {0, 0, 2}}, wall),
                            placed(Quad{{-1, 1.5f, -1}, {0, 0.5f, 0}, {0, 0, 2}}, wall),
                            bright_part(1)));
}

} // namespace

TEST_CASE(
    "environment: directions drawn uniformly, the plain twin, find the same light") {
    const EnvironmentLight sky = bright_part(1);
    const Lambertian matt{.albedo = Rgb{0.5f}};
    const auto seen = [&](const auto& light, std::uint64_t seed) {
        const World world(make_scene(placed(floor_at(0), matt),
                                     placed(Sphere{{0, 0.8f, 0}, 0.5f}, matt), light));
        const auto ray = [&](RandomStream& stream) {
            const Vec2 at = 2.0f * next_2d<float>(stream) - 1.0f;
            return Ray{.origin{at.x, 5, at.y}, .direction{0, -1, 0}};
        };
        return mean_radiance(PathTracer(world), 40000, seed, ray);
    };
    const Mean uniform = seen(plain::UniformSky{sky}, 9), bright = seen(sky, 10);
    CHECK(std::abs(apart(uniform, bright)) < 5);
    CHECK(uniform.error() < 0.02 * uniform.mean);
    CHECK(bright.error() < uniform.error());
}

TEST_CASE("environment: photons through a window bring what paths find") {
    const World world = room_with_window();
    const Vec2 low{-0.6f, -0.8f}, high{0.8f, 0.8f};
    const Mean photons = by_photons(world, {MapType::general}, low, high, 5000);
    const Mean paths = by_paths(world, low, high, 0.6, 60000);
    CHECK(std::abs(apart(photons, paths)) < 5);
    CHECK(photons.error() < 0.04 * photons.mean);
    CHECK(paths.error() < 0.03 * paths.mean);
}

TEST_CASE(
    "environment: a caustic below a ball of glass, by aimed photons and by paths") {
    const World world(make_scene(placed(floor_at(0), Lambertian{.albedo = Rgb{0.5f}}),
                                 placed(Sphere{{0, 0.7f, 0}, 0.5f}, Glass{}),
                                 bright_part(0)));
    const Vec2 low{-0.6f, -0.6f}, high{0.6f, 0.6f};
    const Mean photons =
        by_photons(world, {MapType::general, MapType::caustics}, low, high, 5000);
    const Mean paths = by_paths(world, low, high, 0.5, 60000);
    CHECK(std::abs(apart(photons, paths)) < 5);
    CHECK(photons.error() < 0.02 * photons.mean);
    CHECK(paths.error() < 0.02 * paths.mean);
    // It is a caustic that is compared: all other light is much less.
    const Mean direct = by_photons(world, {MapType::general}, low, high, 5000);
    CHECK(direct.mean < 0.8 * photons.mean);
}

TEST_CASE("environment: it is said that much of the light through a window is missed") {
    const auto remarks = [](const auto& world, DirectLight direct) {
        int found = 0;
        for (const auto& text : scene_remarks(world, {.direct = direct}))
            found += text.find("as through a window") != text.npos ? 1 : 0;
        return found;
    };
    const World room = room_with_window();
    CHECK(remarks(room, DirectLight::analytic) == 1);
    CHECK(remarks(room, DirectLight::sampled) == 1);
    CHECK(remarks(room, DirectLight::mis) == 0);
    // In the open it is not, nor where no sky is seen, nor under a sun.
    const Lambertian matt{};
    const auto on_floor = [&](const auto& light) {
        return World(make_scene(placed(floor_at(0), matt),
                                placed(Sphere{{0, -2, 0}, 0.5f}, matt), light));
    };
    CHECK(remarks(on_floor(EnvironmentLight{}), DirectLight::sampled) == 0);
    CHECK(remarks(on_floor(SunLight{}), DirectLight::sampled) == 0);
    CHECK(remarks(World(make_scene(placed(Sphere{}, matt), EnvironmentLight{})),
                  DirectLight::sampled) == 0);
}

TEST_CASE("environment: what is no sky is refused, and one pixel is a sky") {
    const auto why = [](const EnvironmentLight& light) {
        return refusal([&] { check(light); });
    };
    CHECK(why({}) == "");
    CHECK(why({.strength = 0}) ==
          "environment light.strength is 0; it must be finite and above 0.");
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK(why({.strength = nan}).starts_with("environment light.strength is NaN"));
    CHECK(why({.rotation_degrees = infinity}) ==
          "environment light.rotation_degrees is infinity; it must be finite.");
    CHECK(
        why({.picture = make_image(4, 2)}) ==
        "environment light.picture is black in every pixel; leave such a light out of "
        "the scene.");
    CHECK(why({.picture = {}}) ==
          "The image's size is 0 x 0; width and height must be at least 1, and their "
          "product at most 268435456.");
    CHECK(why({.picture{.width = 2, .height = 2, .pixels{Rgb{1}}}}) ==
          "The image has 1 pixels; its size, 2 x 2, requires 4.");
    for (const float wrong : {-1.0f, nan, infinity}) {
        Image picture = make_image(4, 2, Rgb{1});
        pixel(picture, 3, 1).y = wrong;
        CHECK(why({.picture = picture})
                  .starts_with("environment light.picture, column 3, row 1 is (1, "));
        CHECK(why({.picture = picture})
                  .ends_with("it must be finite and at least 0 in every channel."));
    }
    // A flux beyond float is refused when the scene is closed, as any light's is.
    CHECK(refusal([] {
              (void)World(
                  make_scene(placed(Sphere{}, Lambertian{}),
                             EnvironmentLight{.picture = make_image(1, 1, Rgb{1e30f}),
                                              .strength = 1e8f}));
          }).ends_with("it must be finite and above 0."));
}
