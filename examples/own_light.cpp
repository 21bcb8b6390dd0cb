/// \file own_light.cpp
/// \brief Two torches in a dark room: lights that the library does not know.
// runs in the folder of its picture

#include <ljus/ljus.hpp>

#include "own_light.hpp"

/// Renders a wall, a glass ball and two torches into own_light.png.
int main() {
    using namespace ljus;
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Quad{{-6, 0, 6}, {12, 0, 0}, {0, 0, -9}}, grey);
    scene.add(Quad{{-6, 0, -3}, {12, 0, 0}, {0, 6, 0}}, grey);
    scene.add(Sphere{{1.2f, 0.9f, 0}, 0.9f}, glass);
    scene.add(reader::Torch{.position{-4, 1, 4}, .target{-1.5f, 2, -3}, .watts = 22});
    scene.add(reader::Torch{
        .position{4, 4, 2}, .target{1.2f, 0.9f, 0}, .watts = 12, .beam_degrees = 26});
    const Camera camera = look_at({.position{0, 2.4f, 8}, .target{0, 1.3f, 0}});
    const auto maps = make_photon_maps(scene);
    const auto mapper = make_photon_mapper(scene, maps);
    save_png(render(mapper, camera, {.width = 320, .height = 240, .samples = 64}).image,
             "own_light.png");
}
