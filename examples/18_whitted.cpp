// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file 18_whitted.cpp
/// \brief Two balls over a chequered floor, by Whitted's tree of rays, with 0 to 5
/// reflections and refractions in a row.

#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders whitted-depth-0.png to whitted-depth-5.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 18, Whitted's ray tracing: the two balls, depth by depth.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 200, .samples = 9},
                        .report{.width = 600, .height = 400, .samples = 36},
                        .reference{.width = 900, .height = 600, .samples = 144}});

        using Tiles = Textured<Lambertian, Checker>;
        Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror, Tiles>,
              Lights<PointLight>>
            scene;
        const auto glass = scene.add(Glass{.index = 1.5f});
        const auto mirror = scene.add(Mirror{.reflectance{0.75f, 0.73f, 0.68f}});
        const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
        const auto tiles = scene.add(Tiles{{.albedo = Rgb{1}},
                                           {.map{.edge_u{2, 0, 0}, .edge_v{0, 0, 2}},
                                            .even{0.75f, 0.07f, 0.04f},
                                            .odd{0.8f, 0.65f, 0.07f}}});
        const Rgb sky{0.16f, 0.27f, 0.5f}; // W/(m^2 sr)
        scene.add(Sphere{.center{0.5f, 1.5f, 1.2f}, .radius = 1}, glass);
        scene.add(Sphere{.center{-1.1f, 1.1f, -1.3f}, .radius = 1.1f}, mirror);
        scene.add(Quad{{-6, 0, 3.5f}, {11, 0, 0}, {0, 0, -16}}, tiles);
        scene.add(Sphere{.radius = 60}, black, sky, true); // seen from inside
        scene.add(PointLight{.position{-3, 7, 5}, .intensity = Rgb{190}});
        const World world(std::move(scene));
        const Camera camera = look_at(
            {.position{0.2f, 2.1f, 8}, .target{-0.1f, 1.1f, 0}, .vfov_degrees = 32});

        for (int depth = 0; depth <= 5; ++depth) {
            // The sky is visible, but no shadow ray is sent to it. Constant ambient
            // light replaces the light of the sky; no ball shades it.
            const WhittedTracer tracer(
                world, {.max_depth = depth, .lamps = false, .ambient = sky});
            const std::string name = "whitted-depth-" + std::to_string(depth);
            const auto picture = examples::rendered(name, tracer, camera, options);
            save_png(picture.image, options.path(name + ".png"));
        }
    });
}
