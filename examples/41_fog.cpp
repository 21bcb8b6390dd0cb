// smoke: --quality draft --width 24 --height 18 --rays 1
/// \file 41_fog.cpp
/// \brief Renders a lamp behind a grating, which throws shafts of light into fog, and
/// compares three ways to find this light with equally many rays.

#include <algorithm>

#include <ljus/ljus.hpp>
#include <ljus/media/fog.hpp>
#include <ljus/render/path_tracing.hpp>

#include "common/example.hpp"

using namespace ljus;

using Attic = Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror>, Lights<>,
                    Media<Fog<Box>>>;

/// A room of 4 by 2.6 by 4 units in thin fog, with a lamp above its ceiling of bars.
Attic attic() {
    Attic scene;
    const auto wall = scene.add(Lambertian{.albedo{0.5f, 0.48f, 0.45f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0.02f}});
    const Vec3 low{-2, 0, -2}, x{4, 0, 0}, y{0, 2.6f, 0}, z{0, 0, 4};
    scene.add(Quad{low, z, x}, wall);
    scene.add(Quad{low, x, y}, wall);
    scene.add(Quad{low, y, z}, wall);
    scene.add(Quad{low + x, z, y}, wall);

    // Light comes in through the gaps, each 0.12 wide.
    for (int bar = -6; bar <= 5; ++bar)
        scene.add(
            Quad{{0.4f * float(bar) + 0.06f, y.y, -2.5f}, {0.28f, 0, 0}, 1.25f * z},
            black);
    scene.add(Sphere{.center{-0.2f, 4.2f, -0.7f}, .radius = 0.05f}, black,
              Rgb{20000, 17600, 14000});
    scene.add(Sphere{.center{0.7f, 0.45f, -0.6f}, .radius = 0.45f}, wall);
    scene.add(Sphere{.center{-0.6f, 0.35f, 0.3f}, .radius = 0.35f},
              scene.add(Mirror{.reflectance = Rgb{0.9f}}));

    scene.add(Fog<Box>{.region{low, low + x + y + z},
                       .absorption = Rgb{0.02f},
                       .scattering{0.14f, 0.145f, 0.155f},
                       .g = 0.3f});
    return scene;
}

/// Renders fog-shafts.png and fog-ways.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 41, fog: shafts of light, and how they are found.");
        const examples::Options options =
            line.parse({.draft{.width = 160, .height = 120, .samples = 4},
                        .report{.width = 440, .height = 330, .samples = 100},
                        .reference{.width = 880, .height = 660, .samples = 1024}});
        const World world(attic());
        const auto camera = look_at(
            {.position{0, 1.3f, 5.2f}, .target{0, 1.2f, 0}, .vfov_degrees = 36});

        const auto shafts =
            examples::rendered("shafts", PathTracer(world), camera, options);
        save_png(shafts.image, options.path("fog-shafts.png"));

        // Side by side, with 4 rays per pixel each.
        auto picture = examples::picture_settings(options);
        picture.width /= 2;
        picture.height /= 2;
        picture.samples = 4;
        Image ways = make_image<float>(3 * picture.width, picture.height);
        int left = 0;
        for (const FogLight how :
             {FogLight::flight, FogLight::equi_angular, FogLight::both}) {
            const PathTracer tracer(world, {.fog = how});
            const auto way =
                examples::rendered("ways", tracer, camera, picture, options);
            for (int row = 0; row < picture.height; ++row)
                for (int column = 0; column < picture.width; ++column)
                    pixel(ways, left + column, row) = pixel(way.image, column, row);
            left += picture.width;
        }
        save_png(ways, options.path("fog-ways.png"));
    });
}
