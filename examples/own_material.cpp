/// \file own_material.cpp
/// \brief Renders three balls of a material of the reader's own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>

#include "own_material.hpp"

/// Renders balls with k = 1, 2 and 4 into own_material.png.
int main() {
    using namespace ljus;
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, reader::Moon>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    scene.add(Quad{{-9, 0, 5}, {18, 0, 0}, {0, 0, -14}}, grey);
    float x = -2.3f;
    for (const float k : {1.0f, 2.0f, 4.0f}) {
        const auto moon = scene.add(reader::Moon{.color{0.8f, 0.75f, 0.6f}, .k = k});
        scene.add(Sphere{{x, 1, 0}, 1}, moon);
        x += 2.3f;
    }
    scene.add(Sphere{{0, 7, 6}, 1}, grey, Rgb{50});
    const Camera camera = look_at({.position{0, 1.8f, 6.5f}, .target{0, 0.9f, 0}});
    const World world(std::move(scene));
    const auto picture =
        render(PathTracer(world), camera, {.width = 360, .height = 200, .samples = 64});
    save_png(picture.image, "own_material.png");
}
