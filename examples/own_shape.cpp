/// \file own_shape.cpp
/// \brief Renders a room with crates, a shape of the reader's own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>

#include "own_shape.hpp"

/// Renders two crates, one of them of glass, into own_shape.png.
int main() {
    using namespace ljus;
    Scene<Shapes<Quad, Sphere, reader::Crate>, Materials<Lambertian, Glass>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto red = scene.add(Lambertian{.albedo{0.7f, 0.25f, 0.15f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Quad{{-6, 0, 5}, {12, 0, 0}, {0, 0, -12}}, grey);
    scene.add(reader::Crate{{-1.6f, 0.01f, -2}, {0.2f, 1.8f, -0.4f}}, red);
    scene.add(reader::Crate{{0.3f, 0.01f, 0}, {1.5f, 1.2f, 1}}, glass);
    scene.add(Sphere{{3, 5, 2}, 0.6f}, grey, Rgb{95});
    const Camera camera =
        look_at({.position{0.6f, 2.8f, 5.5f}, .target{-0.2f, 0.6f, 0}});
    const World world(std::move(scene));
    const PhotonMapper mapper(world);
    save_png(render(mapper, camera, {.width = 320, .height = 240, .samples = 49}).image,
             "own_shape.png");
}
