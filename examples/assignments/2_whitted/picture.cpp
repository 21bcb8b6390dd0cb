// Assignment 2: a glass ball, a mirror ball and a diffuse one on a floor.
#include <answer.hpp>

#include <string>

#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"
#include "ljus/scene/camera.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-2.png";
    Room room{.sky{0.35f, 0.45f, 0.6f}};
    for (int x = -4; x < 4; ++x)
        for (int z = -4; z < 4; ++z)
            room.objects.push_back(
                {ljus::Quad{
                     {2.0f * float(x), 0, 2.0f * float(z) + 2}, {2, 0, 0}, {0, 0, -2}},
                 {.color = (x + z) % 2 == 0 ? Rgb{0.75f} : Rgb{0.2f, 0.3f, 0.35f}}});
    room.objects.push_back({ljus::Sphere{{-0.9f, 1, 0.6f}, 1}, {.kind = Kind::glass}});
    room.objects.push_back(
        {ljus::Sphere{{1.7f, 1.2f, -1.2f}, 1.2f}, {Kind::mirror, {0.9f, 0.85f, 0.7f}}});
    room.objects.push_back(
        {ljus::Sphere{{-2, 0.8f, -2.4f}, 0.8f}, {.color{0.8f, 0.2f, 0.15f}}});
    room.lamps = {{{4, 7, 4}, Rgb{150}}, {{-5, 4, 2}, Rgb{40, 35, 25}}};
    const ljus::Camera camera =
        ljus::look_at({.position{0, 2.2f, 7}, .target{0, 0.9f, 0}, .vfov_degrees = 36});
    ljus::Image image = ljus::make_image(480, 320);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int part = 0; part < 4; ++part) {
                const ljus::Vec2 at{float(x) + 0.25f + 0.5f * float(part % 2),
                                    float(y) + 0.25f + 0.5f * float(part / 2)};
                const Ray ray = primary_ray(camera, at, image.width, image.height);
                pixel(image, x, y) += radiance(room, ray, 8) / 4.0f;
            }
    ljus::save_png(image, file);
}
