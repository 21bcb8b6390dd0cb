/// \file 01_first_picture.cpp
/// \brief The program of the README: a glass ball and its caustic, in fewer than 20
/// lines.
// figures: first_picture
// runs in the folder of its picture

// [first picture]
#include <ljus/ljus.hpp>
using namespace ljus;

/// Renders a glass ball on a floor into first_picture.png.
int main() {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto glass = scene.add(Glass{.index = 1.5f});
    scene.add(Quad{.corner{-6, 0, 4}, .edge_u{12, 0, 0}, .edge_v{0, 0, -12}}, grey);
    scene.add(Sphere{.center{0, 1.2f, 0}, .radius = 1}, glass);
    scene.add(Sphere{.center{-3, 5, -2}, .radius = 0.5f}, grey, Rgb{50}); // a lamp

    const Camera camera = look_at({.position{0, 3, 7}, .target{0, 0.9f, 0}});
    const World world(std::move(scene));
    const PhotonMapper mapper(world);
    const auto picture = render(mapper, camera, {.samples = 9});
    save_png(picture.image, "first_picture.png");
}
// [first picture]
