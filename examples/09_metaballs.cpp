// smoke: --quality draft --width 24 --height 18 --rays 1
/// \file 09_metaballs.cpp
/// \brief Renders two metaballs that come closer and merge, and blobs of glass in front
/// of them.

#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Two blobs at this distance in a lit corner, with or without three blobs of glass in
/// front of them.
// [scene]
auto merging(float distance, bool with_glass) {
    Scene<Shapes<Metaballs, Quad, Sphere>, Materials<Lambertian, Glass>> scene;
    const auto amber = scene.add(Lambertian{.albedo{0.9f, 0.55f, 0.15f}});
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto glass = scene.add(Glass{});
    const float half = distance / 2;
    scene.add(Metaballs{.blobs{{.center{-half, 0, -4}}, {.center{half, 0, -4}}}},
              amber);
    if (with_glass)
        scene.add(Metaballs{.blobs{{.center{-0.7f, -0.35f, -2.5f}, .radius = 0.75f},
                                   {.center{0, -0.15f, -2.6f}, .radius = 0.7f},
                                   {.center{0.6f, -0.4f, -2.4f}, .radius = 0.7f}}},
                  glass);
    scene.add(Quad{.corner{-9, -0.9f, 3}, .edge_u{18, 0, 0}, .edge_v{0, 0, -12}}, grey);
    scene.add(Quad{.corner{-9, -0.9f, -7}, .edge_u{18, 0, 0}, .edge_v{0, 12, 0}}, grey);
    scene.add(Sphere{.center{-2.5f, 4.5f, -1.5f}, .radius = 0.4f}, grey, Rgb{90});
    return World(std::move(scene));
}
// [scene]

Camera camera(float degrees) {
    return look_at(
        {.position{0, 0.9f, 1}, .target{0, -0.2f, -3.6f}, .vfov_degrees = degrees});
}

} // namespace

/// Makes the strip of two blobs by path tracing, and the glass by photon mapping.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 9, metaballs: two that merge, and three of glass.");
        const examples::Options options =
            line.parse({.draft{.width = 320, .height = 200, .samples = 12},
                        .report{.width = 480, .height = 300, .samples = 256},
                        .reference{.width = 960, .height = 600, .samples = 1024}});
        const auto save = [&](const std::string& name, const auto& renderer,
                              const Camera& eye) {
            const auto picture = examples::rendered(name, renderer, eye, options);
            save_png(picture.image, options.path("metaballs-" + name + ".png"));
        };
        for (const int hundredths : {200, 170, 145, 120, 80}) {
            const auto world = merging(float(hundredths) / 100, false);
            save(std::to_string(hundredths), PathTracer(world), camera(30));
        }
        const auto world = merging(1.2f, true);
        const long long photons = options.pick(100000LL, 300000LL, 3000000LL);
        const PhotonMapper mapper(
            world, {.caustics{.photons = photons, .seed = options.seed}});
        save("glass", mapper, camera(38));
    });
}
