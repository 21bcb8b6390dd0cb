/// \file picture_lamp_test.cpp
/// \brief Textured lamps: against plain lamps, quadrature, and photons against paths.
///
/// Means are held within 5 standard errors: a false alarm once in 1.7 million; a
/// chi-square within what is exceeded once in a million.

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "ljus/geometry/disc.hpp"
#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/normal_map.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/make_scene.hpp"
#include "ljus/scene/picture_lamp.hpp"
#include "support/integrate.hpp"
#include "support/mean.hpp"
#include "support/refusal.hpp"
#include "support/seed.hpp"

using namespace ljus;
using ljus_test::apart;
using ljus_test::integrate;
using ljus_test::Mean;
using ljus_test::refusal;

static_assert(NearLight<PictureLightT<float>> && Light<PictureLightT<double>> &&
              Material<PictureLamp> && ShowsPicture<PictureLamp> &&
              !ShowsPicture<Lambertian>);

namespace {

constexpr double pi = std::numbers::pi;

/// Colours drawn at random, every fourth of them black, one bright.
template <std::floating_point T>
ImageT<T> drawn_picture(int width, int height) {
    auto picture = make_image<T>(width, height);
    auto stream = random_stream(7, Pass::user, 0, 0);
    for (auto& c : picture.pixels)
        if (next_1d<T>(stream) > T(0.25))
            c = {next_1d<T>(stream), next_1d<T>(stream), next_1d<T>(stream)};
    pixel(picture, width / 3, height / 3) = {T(3), T(8), T(2)};
    return picture;
}

template <std::floating_point T>
constexpr QuadT<T> a_quad{
    {T(-0.3), T(1), T(-0.2)}, {T(0.7), T(0.1), T(0)}, {T(0.2), T(0), T(0.5)}};
template <std::floating_point T>
constexpr DiscT<T> a_disc{{T(0.1), T(1), T(0)}, {T(0.1), T(-1), T(0.2)}, T(0.4)};

/// The integral of f(radiance, point) over the area of a textured lamp, by Gauss's rule
/// in each pixel, in which a disc has the pixels' parts.
template <typename T, typename F>
double over_area(const PictureLightT<T>& light, const F& f) {
    const int width = light.picture.width, height = light.picture.height;
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const auto inside = [&](double u, double v) {
                const double a = 2 * u - 1, b = 2 * v - 1;
                return !light.round || a * a + b * b <= 1;
            };
            const double part = integrate(0, 1, light.round ? 30 : 1, [&](double s) {
                const double u = (x + s) / width;
                return integrate(0, 1, light.round ? 30 : 1, [&](double t) {
                    const double v = 1 - (y + t) / height;
                    if (!inside(u, v)) return 0.0;
                    return f(pixel(light.picture, x, y),
                             point_at(light.frame, T(u), T(v), light.normal));
                });
            });
            sum += part * light.pixel_area;
        }
    return sum;
}

/// Calls f(light) with textured lamps: on a quad, inside out, on discs.
template <std::floating_point T, typename F>
void for_each_lamp(const F& f) {
    const RgbT<T> radiance{T(2), T(3), T(4)};
    const auto picture = drawn_picture<T>(5, 4);
    f(make_picture_light(a_quad<T>, picture, radiance, false));
    f(make_picture_light(a_quad<T>, picture, radiance, true));
    f(make_picture_light(a_disc<T>, picture, radiance, false));
    f(make_picture_light(a_disc<T>, drawn_picture<T>(9, 16), radiance, false));
}

/// A room of a floor, a wall, and a lamp above.
template <typename Shape, typename M>
auto corner_under(const Shape& lamp, const M& material, const Rgb& radiance) {
    const Lambertian matt{.albedo = Rgb{0.6f}};
    return World(make_scene(placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, matt),
                            placed(Quad{{-1, 0, -1}, {2, 0, 0}, {0, 2, 0}}, matt),
                            placed(lamp, material, radiance)));
}

/// The flux on a floor at height 0, by photons; one value per seed.
template <typename W>
Mean flux_by_photons(const W& world, std::initializer_list<MapType> maps,
                     long long photons, int channel = 1) {
    Mean mean;
    for (std::uint64_t seed = 1; seed <= 32; ++seed) {
        double flux = 0;
        for (const MapType map : maps)
            for (const Photon& photon :
                 trace_photons(world, map,
                               {.photons = photons,
                               .seed = ljus_test::test_seed(seed),
                               .shadow_photons = false,
                               .threads = 1})
                     .photons)
                if (photon.position.y < 1e-4f && photon.direction.y < 0)
                    flux += double(photon.flux[channel]);
        mean.add(flux);
    }
    return mean;
}

/// The same by paths from all over the floor, from -1 to 1, of albedo 0.6.
template <typename W>
Mean flux_by_paths(const W& world, const PathTracingSettings& settings, long long paths,
                   int channel = 1) {
    const auto ray = [](RandomStream& stream) {
        const Vec2 at = 2.0f * next_2d<float>(stream) - 1.0f;
        return Ray{.origin{at.x, 0.01f, at.y}, .direction{0, -1, 0}};
    };
    Mean mean =
        ljus_test::mean_radiance(PathTracer(world, settings), paths, 9, ray, channel);
    const double scale = 4 * pi / 0.6;
    mean.mean *= scale;
    mean.squares *= scale * scale;
    return mean;
}

} // namespace

TEST_CASE_TEMPLATE("picture lamp: the density integrates to 1, and the flux is right",
                   T, float, double) {
    for_each_lamp<T>([](const PictureLightT<T>& light) {
        const double tolerance = light.round ? 2e-3 : 1e-6;
        for (int c = 0; c < 3; ++c) {
            const double flux = over_area(light, [&](const RgbT<T>& l, const auto&) {
                return pi * double(l[c]);
            });
            CHECK(double(power(light)[c]) == doctest::Approx(flux).epsilon(tolerance));
        }
        if (light.round) return; // beside the disc lies a part of the density
        CHECK(over_area(light, [&](const RgbT<T>& l, const auto&) {
                  return double(pdf_of_point(light, l));
              }) == doctest::Approx(1).epsilon(1e-5));
    });
}

TEST_CASE("picture lamp: the parts of pixels in a circle make up the circle") {
    for (const auto& size : {Vec2{1, 1}, Vec2{2, 3}, Vec2{7, 5}, Vec2{64, 1}}) {
        const int width = int(size.x), height = int(size.y);
        double sum = 0;
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x) {
                const double part = detail::fraction_in_circle(width, height, x, y);
                REQUIRE(part >= 0);
                REQUIRE(part <= 1);
                sum += part / (width * height);
            }
        CHECK(sum == doctest::Approx(pi / 4).epsilon(1e-12));
    }
    CHECK(detail::fraction_in_circle(8, 8, 0, 0) == 0);
    CHECK(detail::fraction_in_circle(8, 8, 3, 4) == 1);
    // Above y = 1/2 in the middle of three columns: the arc less the rectangle.
    const double arc = std::asin(1 / 3.0) + std::sqrt(8.0) / 9;
    CHECK(detail::fraction_in_circle(3, 4, 1, 0) ==
          doctest::Approx((arc - 1 / 3.0) / (1 / 3.0)));
}

TEST_CASE("picture lamp: points are drawn as often as their pixels are bright") {
    for_each_lamp<float>([](const PictureLightT<float>& light) {
        const int width = light.picture.width, height = light.picture.height;
        constexpr int draws = 100000;
        std::vector<double> counts(light.picture.pixels.size()),
            expected(counts.size());
        double all = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            const int x = int(i) % width, y = int(i) / width;
            const Rgb& c = light.picture.pixels[i];
            if (!light.round || detail::fraction_in_circle(width, height, x, y) > 0)
                expected[i] = double(c.x) + double(c.y) + double(c.z);
            all += expected[i];
        }
        for (double& count : expected) count *= draws / all;
        Mean flux[3];
        for (std::uint64_t i = 0; i < draws; ++i) {
            auto stream = random_stream(ljus_test::test_seed(2), Pass::user, 0, i);
            const auto point = emission_point(light, next_2d<float>(stream), 0.0f);
            const Vec2 uv = detail::place_in(light.frame, point.position);
            const int x = std::clamp(int(uv.x * float(width)), 0, width - 1);
            const int y = std::clamp(int((1 - uv.y) * float(height)), 0, height - 1);
            counts[std::size_t(y * width + x)] += 1;
            const Rgb carried = flux_from(light, point);
            for (int c = 0; c < 3; ++c) flux[c].add(double(carried[c]));
            REQUIRE(glm::dot(point.normal, light.normal) > 0.9999f);
        }
        CHECK(ljus_test::chi_square_agrees(counts, expected,
                                           ljus_test::once_in_a_million));
        for (int c = 0; c < 3; ++c)
            CHECK(std::abs(apart(flux[c], double(power(light)[c]), 1e-4)) < 5);
    });
}

TEST_CASE("picture lamp: shadow rays find the irradiance of quadrature") {
    for_each_lamp<float>([](const PictureLightT<float>& light) {
        // Before the lamp, and one point behind it.
        const Vec3T<double> up(light.normal);
        const Vec3T<double> middle(light.frame.corner +
                                   (light.frame.edge_u + light.frame.edge_v) / 2.0f);
        const Vec3T<double> from = middle + 0.6 * up + Vec3T<double>{0.2, 0.1, 0.1};
        const double right = over_area(light, [&](const Rgb& l, const auto& point) {
            const Vec3T<double> way = Vec3T<double>(point.position) - from;
            const double d2 = glm::dot(way, way);
            const double cosine = glm::dot(way, -up);
            return double(l.y) * cosine * cosine / (d2 * d2);
        });
        Mean mean, found;
        for (std::uint64_t i = 0; i < 40000; ++i) {
            auto stream = random_stream(ljus_test::test_seed(4), Pass::user, 0, i);
            const auto sample =
                sample_light(light, Vec3(from), next_2d<float>(stream), 0.0f);
            mean.add(sample ? double(glm::dot(sample->wi, Vec3(-up)) * sample->weight.y)
                            : 0);
            // The density that a path which meets the point would ask for is the same.
            if (!sample) continue;
            const Vec2 uv = detail::place_in(light.frame, sample->point.position);
            REQUIRE(pdf_towards(light, Vec3(from), sample->point, uv) ==
                    doctest::Approx(double(sample->pdf)).epsilon(0.3));
            found.add(double(pdf_towards(light, Vec3(from), sample->point, uv) /
                             sample->pdf));
        }
        CHECK(std::abs(apart(mean, right, light.round ? 2e-3 : 1e-5)) < 5);
        CHECK(found.mean == doctest::Approx(1).epsilon(1e-3));
        CHECK_FALSE(sample_light(light, Vec3(middle - up), Vec2{0.3f, 0.6f}, 0.0f));
    });
}

TEST_CASE(
    "picture lamp: who looks at it sees the pixel, with its lower left at (0, 0)") {
    Image picture = make_image(2, 2);
    pixel(picture, 0, 1) = Rgb{1, 2, 3}; // below, left
    pixel(picture, 1, 0) = Rgb{5, 6, 7}; // above, right
    const World world(make_scene(placed(Quad{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                                        PictureLamp{.picture = picture}, Rgb{2, 1, 1}),
                                 placed(Disc{{3, 0, 0}, {0, 0, 1}, 1},
                                        PictureLamp{.picture = picture}, Rgb{1})));
    const auto seen = [&](Vec2 at, const auto& renderer) {
        Counts counts;
        auto stream = random_stream(1, Pass::user, 0, 0);
        auto context = context_of(stream, counts);
        return radiance(renderer, Ray{.origin{at, 1}, .direction{0, 0, -1}}, context);
    };
    const auto check_seen = [&](const auto& renderer) {
        CHECK(seen({0.2f, 0.2f}, renderer) == Rgb{2, 2, 3});
        CHECK(seen({0.8f, 0.7f}, renderer) == Rgb{10, 6, 7});
        CHECK(seen({0.2f, 0.8f}, renderer) == Rgb{0});
        // The disc's u and v are those of its texture coordinates.
        const Frame frame = frame_around(Vec3{0, 0, 1});
        const Vec3 at = Vec3{3, 0, 0} - 0.5f * (frame.tangent + frame.bitangent);
        CHECK(seen({at.x, at.y}, renderer) == Rgb{1, 2, 3});
    };
    check_seen(PathTracer(world));
    check_seen(PhotonMapper(world, {.caustics{.photons = 0}}));
}

TEST_CASE("picture lamp: an even picture is a plain lamp, and a half black one half") {
    const Image even = make_image(3, 2, Rgb{0.5f});
    Image half = even;
    for (int y = 0; y < 2; ++y) pixel(half, 1, y) = Rgb{1};
    for (int y = 0; y < 2; ++y) pixel(half, 2, y) = Rgb{0};
    const World plain =
        corner_under(a_quad<float>, Lambertian{.albedo = Rgb{0}}, Rgb{4});
    const World shown =
        corner_under(a_quad<float>, PictureLamp{.picture = even}, Rgb{8});
    CHECK(double(shown.powers()[0].y) ==
          doctest::Approx(double(plain.powers()[0].y)).epsilon(1e-6));
    const World dark =
        corner_under(a_quad<float>, PictureLamp{.picture = half}, Rgb{8});
    CHECK(double(dark.powers()[0].y) ==
          doctest::Approx(double(plain.powers()[0].y)).epsilon(1e-6));
    const Mean a = flux_by_paths(plain, {}, 20000);
    const Mean b = flux_by_paths(shown, {}, 20000);
    CHECK(std::abs(apart(a, b)) < 5);
    CHECK(b.error() < 0.02 * b.mean);
}

TEST_CASE("picture lamp: one without a radiance is remarked on") {
    const auto remarks = [](const Rgb& radiance) {
        return path_remarks(World(make_scene(
            placed(a_quad<float>, PictureLamp{}, radiance),
            placed(Sphere{.center{0, 9, 0}, .radius = 1}, Lambertian{}, Rgb{1}))));
    };
    CHECK(remarks(Rgb{1}).empty());
    const auto dark = remarks(Rgb{0});
    REQUIRE(dark.size() == 1);
    CHECK(dark[0].starts_with("1 object(s) have the picture of a lamp, but no radi"));
}

TEST_CASE("picture lamp: a normal map over it leaves its picture") {
    Image half = make_image(2, 1, Rgb{1});
    pixel(half, 1, 0) = Rgb{0};
    const Textured<PictureLamp, NormalMap> lamp{
        {.picture = half}, {{.image = make_image(1, 1, Rgb{0.5f, 0.5f, 1})}}};
    const Quad quad{{0, 0, 0}, {2, 0, 0}, {0, 3, 0}};
    const World world(make_scene(placed(quad, lamp, Rgb{4})));
    CHECK(double(world.powers()[0].y) == doctest::Approx(pi * 4 * 3).epsilon(1e-6));
    const auto seen = [&](float x) {
        const Ray ray{.origin{x, 1, 5}, .direction{0, 0, -1}};
        return vertex_at(world, ray, *closest_hit(world, ray)).object.emission;
    };
    CHECK(seen(0.5f) == Rgb{4});
    CHECK(seen(1.5f) == Rgb{0});
}

TEST_CASE(
    "picture lamp: paths that meet it, shadow rays and both find the same light") {
    const auto check_all = [](const auto& lamp) {
        const World world = corner_under(
            lamp, PictureLamp{.picture = drawn_picture<float>(5, 4)}, Rgb{4});
        const Mean both = flux_by_paths(world, {}, 40000);
        const Mean met = flux_by_paths(world, {.sample_lights = false}, 100000);
        const Mean asked =
            flux_by_paths(world, {.heuristic = MisHeuristic::shadow_rays}, 40000);
        CHECK(std::abs(apart(both, met)) < 5);
        CHECK(std::abs(apart(both, asked)) < 5);
        CHECK(both.error() < 0.02 * both.mean);
        CHECK(met.error() < 0.05 * met.mean);
    };
    check_all(Quad{{-0.5f, 0.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}});
    check_all(Disc{{0, 0.5f, 0}, {0, -1, 0}, 0.6f});
}

TEST_CASE("picture lamp: photons bring to a floor what paths find") {
    const auto check_all = [](const auto& lamp) {
        const World world = corner_under(
            lamp, PictureLamp{.picture = drawn_picture<float>(5, 4)}, Rgb{4, 2, 1});
        for (const int channel : {0, 1}) {
            const Mean photons =
                flux_by_photons(world, {MapType::general}, 4000, channel);
            const Mean paths = flux_by_paths(world, {}, 40000, channel);
            CHECK(std::abs(apart(photons, paths)) < 5);
            CHECK(photons.error() < 0.01 * photons.mean);
        }
    };
    check_all(a_quad<float>);
    check_all(a_disc<float>);
}

// Whether photons have the colours of different pixels.
template <typename W>
bool colors_differ(const W& world, MapType map) {
    const auto photons =
        trace_photons(world, map, {.photons = 500, .threads = 1}).photons;
    return std::any_of(photons.begin(), photons.end(), [&](const Photon& photon) {
        const Rgb &a = photons[0].flux, &b = photon.flux;
        return std::abs(a.x * b.z - a.z * b.x) > 0.01f * a.x * b.z;
    });
}

TEST_CASE("picture lamp: aimed photons, through glass and from afar") {
    // What glass throws on the floor, by photons aimed at it, and by paths to the lamp.
    const PictureLamp shown{.picture = drawn_picture<float>(5, 4)};
    const Lambertian matt{.albedo = Rgb{0.6f}};
    const World glass(make_scene(
        placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, matt),
        placed(Sphere{{0.2f, 0.5f, 0.1f}, 0.3f}, Glass{}),
        placed(Quad{{-1, 1.5f, -1}, {2, 0, 0}, {0, 0, 2}}, shown, Rgb{4, 2, 1})));
    const Mean photons =
        flux_by_photons(glass, {MapType::general, MapType::caustics}, 4000);
    const Mean paths = flux_by_paths(glass, {}, 60000);
    CHECK(std::abs(apart(photons, paths)) < 5);
    CHECK(photons.error() < 0.01 * photons.mean);
    CHECK(colors_differ(glass, MapType::caustics));
    // A lamp so far away that its photons are aimed at the scene.
    const World far(make_scene(
        placed(Quad{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}}, matt),
        placed(Quad{{-3, 60, -3}, {6, 0, 0}, {0, 0, 6}}, shown, Rgb{400, 200, 100})));
    CHECK(aim_at_scene(far, far.light_choice()).is_aimed ==
          std::vector<std::uint8_t>{1});
    const Mean from_afar = flux_by_photons(far, {MapType::general}, 2000);
    const Mean from_below = flux_by_paths(far, {}, 20000);
    CHECK(std::abs(apart(from_afar, from_below)) < 5);
    CHECK(from_afar.error() < 0.01 * from_afar.mean);
    CHECK(colors_differ(far, MapType::general));
}

TEST_CASE("picture lamp: what is no lamp is refused") {
    const auto why = [](const PictureLamp& lamp) {
        return refusal([&] { check(lamp); });
    };
    CHECK(why({}) == "");
    CHECK(why({.picture = make_image(3, 2)}) ==
          "picture lamp.picture is black in every pixel; leave such a light out of the "
          "scene.");
    Image bad = make_image(3, 2, Rgb{1});
    pixel(bad, 2, 1).y = -1;
    CHECK(
        why({.picture = bad}).starts_with("picture lamp.picture, column 2, row 1 is"));
    pixel(bad, 2, 1).y = std::numeric_limits<float>::infinity();
    CHECK(why({.picture = bad}) != "");
    CHECK(why({.base{Rgb{2}}}).starts_with("picture lamp.albedo is"));
    // Only quads and discs have a picture; others may have the material in the dark.
    const auto world_of = [](const auto& shape, const Rgb& radiance) {
        return refusal(
            [&] { World(make_scene(placed(shape, PictureLamp{}, radiance))); });
    };
    CHECK(world_of(Sphere{}, Rgb{1}) ==
          "A lamp that shows a picture must be a quad or a disc at rest; give another "
          "shape a radiance without a picture.");
    CHECK(world_of(Sphere{}, Rgb{0}) == "");
    CHECK(world_of(Quad{}, Rgb{1}) == "");
    CHECK(world_of(Disc{}, Rgb{0}) == "");
}
