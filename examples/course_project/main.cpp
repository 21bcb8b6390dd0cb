// Your own scene, rendered with photon maps into picture.png.
#if __has_include("ljus.hpp") // the single header, if it was copied here
#include "ljus.hpp"
#else
#include <ljus/ljus.hpp>
#endif

#include <cstdio>
#include <exception>

using namespace ljus;

// The types in the scene: add yours to the lists.
using MyScene = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, Mirror>>;

MyScene make_my_scene() {
    MyScene scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.8f}});
    const auto red = scene.add(Lambertian{.albedo{0.7f, 0.2f, 0.15f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    const auto mirror = scene.add(Mirror{.reflectance = Rgb{0.9f}});

    // The floor and the wall behind.
    scene.add(Quad{.corner{-4, 0, 4}, .edge_u{8, 0, 0}, .edge_v{0, 0, -8}}, white);
    scene.add(Quad{.corner{-4, 0, -4}, .edge_u{8, 0, 0}, .edge_v{0, 5, 0}}, red);
    scene.add(Sphere{.center{-1.2f, 1, 0}, .radius = 1}, glass);
    scene.add(Sphere{.center{1.4f, 0.8f, -1}, .radius = 0.8f}, mirror);
    // A lamp emits radiance, in W/(m^2 sr).
    scene.add(Sphere{.center{-2, 4, 2}, .radius = 0.4f}, white, Rgb{60});
    return scene;
}

int main() {
    try {
        const World world(make_my_scene());
        const Camera camera = look_at({.position{0, 2.2f, 7}, .target{0, 1, 0}});
        const PhotonMapper renderer(world);
        const auto picture =
            render(renderer, camera, {.width = 320, .height = 240, .samples = 9});
        save_png(picture.image, "picture.png");
        std::puts("wrote picture.png");
    } catch (const std::exception& error) {
        std::fprintf(stderr, "%s\n", error.what());
        return 1;
    }
}
