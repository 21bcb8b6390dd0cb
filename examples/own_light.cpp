/// \file own_light.cpp
/// \brief Renders two stage lamps in a dark room, a type of light of the reader's own.
// runs in the folder of its picture

#include <ljus/ljus.hpp>

#include "own_light.hpp"

/// Renders a wall, a glass ball and two stage lamps into own_light.png.
int main() {
    using namespace ljus;
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Glass>, Lights<reader::StageLamp>>
        scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Quad{{-6, 0, 6}, {12, 0, 0}, {0, 0, -9}}, grey);
    scene.add(Quad{{-6, 0, -3}, {12, 0, 0}, {0, 6, 0}}, grey);
    scene.add(Sphere{{1.2f, 0.9f, 0}, 0.9f}, glass);
    const auto shine = [&](const Vec3& from, const Vec3& to, float intensity, float n) {
        scene.add(reader::StageLamp{.position = from,
                                    .axis = glm::normalize(to - from),
                                    .intensity = Rgb{intensity},
                                    .exponent = n});
    };
    shine({-4, 1, 4}, {-1.5f, 2, -3}, 60, 40);
    shine({4, 4, 2}, {1.2f, 0.9f, 0}, 75, 80);
    const World world(std::move(scene));
    const Camera camera = look_at({.position{0, 2.4f, 8}, .target{0, 1.3f, 0}});
    const PhotonMapper mapper(world);
    save_png(render(mapper, camera, {.width = 320, .height = 240, .samples = 64}).image,
             "own_light.png");
}
