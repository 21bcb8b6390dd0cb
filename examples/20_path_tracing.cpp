// smoke: --quality draft --width 16 --height 16 --rays 1
/// \file 20_path_tracing.cpp
/// \brief Renders a diffuse room by path tracing: by paths alone, with shadow rays, and
/// with both, weighted by MIS.

#include <string>

#include <ljus/ljus.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders path_tracing-room-paths.png, -shadow.png and -balance.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 20, path tracing: a diffuse room, three ways.");
        const examples::Options options =
            line.parse({.draft{.width = 120, .height = 120, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 480, .height = 480, .samples = 1024}});

        Scene<Shapes<Quad, Sphere>, Materials<Lambertian>> scene;
        add_cornell_walls(scene);
        const auto grey = scene.add(Lambertian{.albedo = Rgb{0.75f}});
        const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
        scene.add(Sphere{.center{-0.42f, 0.38f, -0.3f}, .radius = 0.38f}, grey);
        scene.add(Sphere{.center{0.42f, 0.38f, 0.3f}, .radius = 0.38f}, grey);
        scene.add(Quad{{-0.25f, 1.99f, -0.25f}, {0.5f, 0, 0}, {0, 0, 0.5f}}, black,
                  Rgb{17, 13, 8}); // the lamp
        const World world(std::move(scene));
        const Camera camera = cornell_box().camera;

        // The three pictures have the same mean, but not the same noise.
        const auto render_by = [&](const std::string& way,
                                   const PathTracingSettings& settings) {
            const PathTracer tracer(world, settings);
            const auto picture = examples::rendered(way, tracer, camera, options);
            save_png(picture.image, options.path("path_tracing-room-" + way + ".png"));
        };
        render_by("paths", {.sample_lights = false});
        render_by("shadow", {.heuristic = MisHeuristic::shadow_rays});
        render_by("balance", {.heuristic = MisHeuristic::balance});
    });
}
