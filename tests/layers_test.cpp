/// \file layers_test.cpp
/// \brief Layers of pictures against values known by hand, and against the pictures of
/// renderers that carry only some paths.

#include "ljus/render/layers.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "ljus/geometry/moving.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/scene/lens_camera.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/rooms.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// All layers that are not light.
const LayerSettings surfaces{
    .normal = true, .albedo = true, .depth = true, .position = true, .object = true};

/// A quad across the view at this depth.
Quad wall(float z) {
    return {.corner{-50, -50, z}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}};
}

/// The value of a pixel in the layer with this first channel.
template <typename T>
RgbT<T> value(const RenderedLayersT<T>& found, const std::string& channel, int x,
              int y) {
    for (const LayerT<T>& layer : found.layers)
        if (channel_name(layer, 0) == channel) return pixel(layer.image, x, y);
    FAIL("no layer " << channel);
    return {};
}

/// Renders layers, three pixels wide and high; the middle one looks along -z.
template <typename W, typename C = Camera>
auto layers_of(const W& world, const C& camera = {}, int samples = 4) {
    return render_layers(PathTracer(world), camera,
                         {.width = 3, .height = 3, .samples = samples}, surfaces);
}

/// A photon mapper's settings with few photons.
PhotonMappingSettings few_photons(IndirectLight indirect) {
    PhotonMappingSettings settings{.indirect = indirect};
    settings.caustics.photons = settings.general.photons = 5000;
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0.2f;
    return settings;
}

} // namespace

TEST_CASE("layers: a matt wall has the values that geometry says") {
    const Rgb color{0.25f, 0.5f, 0.75f};
    const World world(
        make_scene(placed(Sphere{.center{0, 0, 9}, .radius = 1}, Mirror{}),
                   placed(wall(-4), Lambertian{.albedo = color})));
    const auto found = layers_of(world);
    REQUIRE(found.layers.size() == 5);
    CHECK(distance(value(found, "N.X", 1, 1), Vec3{0, 0, 1}) < 1e-6f);
    CHECK(distance(value(found, "albedo.R", 0, 2), color) < 1e-6f);
    CHECK(value(found, "Z", 1, 1).x == doctest::Approx(4));
    CHECK(distance(value(found, "P.X", 1, 1), Vec3{0, 0, -4}) < 1e-6f);
    CHECK(value(found, "id", 1, 1) == Rgb{2}); // spheres come before quads
    // Through the middle of the pixel at the upper left, whatever its rays hit.
    const Vec3 corner = value(found, "P.X", 0, 0);
    const Vec3 way = primary_ray(Camera{}, {0.5f, 0.5f}, 3, 3).direction;
    CHECK(distance(corner, way * (-4 / way.z)) < 1e-5f);
    CHECK(value(found, "Z", 0, 0).x == doctest::Approx(length(corner)));
}

TEST_CASE("layers: where a ray leaves the scene") {
    const World world(
        make_scene(placed(Sphere{.center{0, 0, 9}, .radius = 1}, Lambertian{})));
    const auto found = layers_of(world);
    for (const char* channel : {"N.X", "albedo.R", "P.X", "id"})
        CHECK(value(found, channel, 1, 1) == Rgb{0});
    CHECK(value(found, "Z", 1, 1) == Rgb{infinity});
}

TEST_CASE("layers: normal and albedo are seen in a mirror, the others are its own") {
    const Rgb color{0.25f, 0.5f, 0.75f}, tint{0.5f, 0.5f, 0.8f};
    const World world(make_scene(placed(wall(-4), Mirror{.reflectance = tint}),
                                 placed(wall(3), Lambertian{.albedo = color})));
    const auto found = layers_of(world);
    CHECK(distance(value(found, "N.X", 1, 1), Vec3{0, 0, -1}) < 1e-6f);
    CHECK(distance(value(found, "albedo.R", 1, 1), color * tint) < 1e-6f);
    CHECK(value(found, "Z", 1, 1).x == doctest::Approx(4));
    CHECK(value(found, "id", 1, 1) == Rgb{1});
}

TEST_CASE("layers: glass passes the albedo of what lies behind it, without n^2") {
    // Every path ends at a surface of albedo 1/2. One in a million is
    // reflected inside the ball until it is not followed further.
    BallRoom room;
    const auto grey = room.add(Lambertian{.albedo = Rgb{0.5f}});
    room.add(Sphere{.center{0, 0, 0}, .radius = 20}, grey);
    room.add(Sphere{.center{0, 0, -5}, .radius = 1}, room.add(Glass{.index = 1.5f}));
    room.add(Sphere{.center{0, 0, -5}, .radius = 0.5f}, grey); // where n^2 would show
    room.add(PointLight{.position{0, 3, 0}, .intensity = Rgb{1}});
    const World world(std::move(room));
    const auto found = layers_of(world, Camera{}, 100);
    for (int x = 0; x < 3; ++x)
        CHECK(distance(value(found, "albedo.R", x, 1), Rgb{0.5f}) < 1e-5f);
    CHECK(value(found, "id", 1, 1) == Rgb{2});
    CHECK(value(found, "Z", 1, 1).x == doctest::Approx(4));
    CHECK(value(found, "Z", 0, 0).x == doctest::Approx(20));
}

TEST_CASE("layers: means are soft at an edge and under a lens, depths are not") {
    const World world(make_scene(
        placed(Quad{{-50, -50, -4}, {50, 0, 0}, {0, 100, 0}}, Lambertian{}),
        placed(Quad{{0, -50, -8}, {50, 0, 0}, {0, 100, 0}}, Lambertian{Rgb{0}})));
    // The edge at x = 0 divides the middle pixel.
    const auto sharp = layers_of(world, Camera{}, 64);
    CHECK(value(sharp, "albedo.R", 1, 1).x ==
          doctest::Approx(double(Lambertian{}.albedo.x) / 2).epsilon(0.1));
    const LensCamera camera = with_lens(Camera{}, 3.0f, 2.0f);
    const auto soft = layers_of(world, camera, 64);
    for (int x = 0; x < 3; x += 2) {
        CHECK(value(soft, "Z", x, 1) == value(sharp, "Z", x, 1));
        CHECK(value(soft, "P.X", x, 1) == value(sharp, "P.X", x, 1));
    }
    CHECK(value(soft, "albedo.R", 0, 1) != value(sharp, "albedo.R", 0, 1));
}

TEST_CASE("layers: the picture keeps its bytes, and the light adds up to it") {
    const Camera camera = room_camera<float>();
    const RenderSettings picture{
        .width = 20, .height = 16, .samples = 5, .seed = 7, .threads = 2};
    LayerSettings which = surfaces;
    which.paths = light_path_layers();
    const auto check_renderer = [&](const auto& renderer) {
        const auto whole = render(renderer, camera, picture);
        const auto found = render_layers(renderer, camera, picture, which);
        CHECK(found.rendered.image.pixels == whole.image.pixels);
        CHECK(found.rendered.counts.rays() == whole.counts.rays());
        CHECK(found.rendered.counts.map_photons == whole.counts.map_photons);
        CHECK(found.rendered.complete);
        REQUIRE(found.layers.size() == 9);
        std::array<double, 4> seen{};
        for (std::size_t i = 0; i < whole.image.pixels.size(); ++i) {
            RgbT<double> sum{0};
            for (std::size_t k = 0; k < 4; ++k) {
                const RgbT<double> light(found.layers[5 + k].image.pixels[i]);
                sum += light;
                seen[k] += light.y;
            }
            const RgbT<double> all(whole.image.pixels[i]);
            for (int c = 0; c < 3; ++c)
                REQUIRE(std::abs(sum[c] - all[c]) <= 1e-6 * all[c] + 1e-12);
        }
        return seen;
    };
    // The lamp is in view in the mirror only, and the ball of glass makes a caustic.
    for (const Ball ball : {Ball::mirror, Ball::glass, Ball::mixture}) {
        CAPTURE(name(ball));
        const ClosedRoom room = make_room<float>(ball, Lamp::quad, 2);
        for (const auto indirect : {IndirectLight::rays, IndirectLight::map,
                                    IndirectLight::photons, IndirectLight::none}) {
            CAPTURE(int(indirect));
            const PhotonMapper mapper(room, few_photons(indirect));
            const auto seen = check_renderer(mapper);
            CHECK(seen[1] > 0);
            CHECK(seen[2] > 0);
            CHECK((seen[3] > 0) == (indirect != IndirectLight::none));
        }
        CHECK(check_renderer(PathTracer(room))[3] > 0);
    }
}

TEST_CASE("layers: a picture of what moves keeps its bytes") {
    // Each ray draws a time, for the picture and for its layers alike.
    const World world(
        make_scene(placed(Sphere{.radius = 9}, Lambertian{}, Rgb{1}, true),
                   placed(Moving<Sphere>{{.center{-1, 0, -4}, .radius = 1}, {2, 0, 0}},
                          Lambertian{})));
    const PathTracer tracer(world);
    const RenderSettings picture{.width = 8, .height = 8, .samples = 2};
    CHECK(render_layers(tracer, Camera{}, picture, surfaces).rendered.image.pixels ==
          render(tracer, Camera{}, picture).image.pixels);
}

TEST_CASE("layers: each layer of light is the picture of its class of paths") {
    const ClosedRoomT<double> room = make_room<double>(Ball::glass, Lamp::quad, 2);
    const CameraT<double> camera = room_camera<double>();
    const RenderSettings picture{.width = 12, .height = 9, .samples = 3};
    const LayerSettings which{.paths = {{"lamps", "ES*L"},
                                        {"twice", "ES*DS*DS*L"},
                                        {"glass", "ES+.*L"},
                                        {"all", "E.*L"}}};
    const auto check_renderer = [&](const auto& renderer) {
        const auto found = render_layers(renderer, camera, picture, which);
        for (std::size_t k = 0; k < which.paths.size(); ++k) {
            CAPTURE(which.paths[k].name);
            CHECK(found.layers[k].name == which.paths[k].name);
            const auto only =
                render(OnlyPaths(renderer, which.paths[k].paths), camera, picture);
            double level = 0;
            for (std::size_t i = 0; i < only.image.pixels.size(); ++i)
                for (int c = 0; c < 3; ++c) {
                    const double value = only.image.pixels[i][c];
                    level += value;
                    REQUIRE(found.layers[k].image.pixels[i][c] ==
                            doctest::Approx(value).epsilon(1e-12));
                }
            if (k > 0) CHECK(level > 0);
        }
    };
    check_renderer(PhotonMapper(room, few_photons(IndirectLight::rays)));
    check_renderer(PathTracer(room));
}

TEST_CASE("layers: one thread and four give the same bytes") {
    const ClosedRoom room = make_room<float>(Ball::glass, Lamp::quad, 2);
    const PhotonMapper mapper(room, few_photons(IndirectLight::rays));
    LayerSettings which = surfaces;
    which.paths = light_path_layers();
    RenderSettings picture{.width = 15, .height = 9, .samples = 3, .threads = 1};
    const auto one = render_layers(mapper, room_camera<float>(), picture, which);
    picture.threads = 4;
    const auto four = render_layers(mapper, room_camera<float>(), picture, which);
    CHECK(one.rendered.image.pixels == four.rendered.image.pixels);
    for (std::size_t k = 0; k < one.layers.size(); ++k)
        CHECK(one.layers[k].image.pixels == four.layers[k].image.pixels);
}

TEST_CASE("layers: a wrong class of paths, and too many of them, are refused") {
    const ClosedRoom room = make_room<float>(Ball::mirror, Lamp::quad, 1);
    const PathTracer tracer(room);
    const auto render_with = [&](const std::vector<PathLayer>& paths) {
        return render_layers(tracer, room_camera<float>(), {.width = 1, .height = 1},
                             {.paths = paths});
    };
    CHECK_THROWS_WITH_AS((void)render_with({{"odd", "ESX"}}),
                         doctest::Contains("'ESX'"), std::invalid_argument);
    const std::vector<PathLayer> many(65, PathLayer{"all", "E.*L"});
    CHECK_THROWS_WITH_AS((void)render_with(many), doctest::Contains("65"),
                         std::invalid_argument);
    CHECK(render_with({many.begin(), many.end() - 1}).layers.size() == 64);
}
