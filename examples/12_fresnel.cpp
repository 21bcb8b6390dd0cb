// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file 12_fresnel.cpp
/// \brief Renders balls of gold, copper and silver, whose reflectance depends on angle
/// and colour.

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders fresnel-metal-balls.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 12, Fresnel: balls of gold, copper and silver.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 150, .samples = 36},
                        .report{.width = 600, .height = 300, .samples = 100},
                        .reference{.width = 900, .height = 450, .samples = 4096}});

        // A dark room whose left and right walls are lamps, which the balls reflect
        // along their rims.
        Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Metal>> scene;
        const auto wall = [&](const Quad& quad, const Rgb& albedo, float light = 0) {
            scene.add(quad, scene.add(Lambertian{.albedo = albedo}), Rgb{light});
        };
        wall({{-4, 0, 4}, {8, 0, 0}, {0, 0, -8}}, {0.12f, 0.12f, 0.14f});
        wall({{-4, 0, -4}, {8, 0, 0}, {0, 5, 0}}, {0.1f, 0.16f, 0.25f});
        wall({{-4, 0, 4}, {0, 0, -8}, {0, 5, 0}}, Rgb{0}, 1);
        wall({{4, 0, 4}, {0, 5, 0}, {0, 0, -8}}, Rgb{0}, 1);
        wall({{-4, 0, 4}, {0, 5, 0}, {8, 0, 0}}, Rgb{0.2f});
        wall({{-4, 5, -4}, {8, 0, 0}, {0, 0, 8}}, Rgb{0.3f});

        // A metal is described by its complex index of refraction, for red, green and
        // blue.
        const auto gold = scene.add(Metal{.index = ljus::gold<float>});
        const auto copper = scene.add(Metal{.index = ljus::copper<float>});
        const auto silver = scene.add(Metal{.index = ljus::silver<float>});
        scene.add(Sphere{.center{-1.7f, 0.8f, 0}, .radius = 0.8f}, gold);
        scene.add(Sphere{.center{0, 0.8f, -0.4f}, .radius = 0.8f}, copper);
        scene.add(Sphere{.center{1.7f, 0.8f, 0}, .radius = 0.8f}, silver);

        const Camera camera = look_at(
            {.position{0, 1.5f, 3.9f}, .target{0, 0.85f, 0}, .vfov_degrees = 42});
        const World world(std::move(scene));
        const PathTracer tracer(world);
        const auto picture = examples::rendered("metals", tracer, camera, options);
        save_png(picture.image, options.path("fresnel-metal-balls.png"));
    });
}
