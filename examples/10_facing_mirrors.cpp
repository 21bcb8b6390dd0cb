// smoke: --quality draft --width 24 --height 24 --rays 1
/// \file 10_facing_mirrors.cpp
/// \brief A room between two mirrors that face each other, by photon mapping.

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// A room with a mirror at each end, a ball, and a lamp at the ceiling.
auto hall() {
    const Mirror mirror{.reflectance{0.86f, 0.95f, 0.9f}};
    const Lambertian grey{.albedo = Rgb{0.6f}};
    const Lambertian red{.albedo{0.7f, 0.35f, 0.2f}}, blue{.albedo{0.25f, 0.4f, 0.7f}};
    const Lambertian yellow{.albedo{0.8f, 0.75f, 0.3f}};
    return World(make_scene(
        placed(Quad{{-2, 0, -3}, {4, 0, 0}, {0, 2.6f, 0}}, mirror), // ahead
        placed(Quad{{-2, 0, 3}, {0, 2.6f, 0}, {4, 0, 0}}, mirror),  // behind
        placed(Quad{{-2, 0, 3}, {4, 0, 0}, {0, 0, -6}}, grey),      // the floor
        placed(Quad{{-2, 2.6f, -3}, {4, 0, 0}, {0, 0, 6}}, grey),   // the ceiling
        placed(Quad{{-2, 0, 3}, {0, 0, -6}, {0, 2.6f, 0}}, red),    // to the left
        placed(Quad{{2, 0, 3}, {0, 2.6f, 0}, {0, 0, -6}}, blue),    // to the right
        placed(Sphere{.center{0.5f, 0.5f, -1}, .radius = 0.5f}, yellow),
        placed(Quad{{-0.5f, 2.59f, -0.8f}, {1, 0, 0}, {0, 0, 1.6f}}, grey, Rgb{9})));
}

} // namespace

/// Renders the hall.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 10, reflection: two mirrors that face each other.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 200, .samples = 16},
                        .report{.width = 600, .height = 400, .samples = 64},
                        .reference{.width = 900, .height = 600, .samples = 4096}});
        const auto world = hall();
        const PhotonMapper mapper(
            world, {.caustics{.photons = options.pick(200000, 1000000, 10000000)},
                    .caustics_estimate{.radius = options.pick(0.15f, 0.1f, 0.05f)}});
        const Camera camera = look_at({.position{-1.1f, 1.35f, 2.6f},
                                       .target{0.35f, 1.05f, -3},
                                       .vfov_degrees = 50});
        const auto picture =
            examples::rendered("reflection-hall", mapper, camera, options);
        save_png(picture.image, options.path("reflection-hall.png"));
    });
}
