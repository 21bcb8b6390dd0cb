// Assignment 4: a box with two balls and a lamp in its ceiling, 64 paths per pixel.
#include <answer.hpp>

#include <string>

#include "ljus/io/png.hpp"
#include "ljus/scene/camera.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-4.png";
    const int paths = count > 2 ? std::stoi(arguments[2]) : 64;
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 2};
    const course::Matter white{.color = Rgb{0.75f}};
    const Room room{
        .objects{{ljus::Quad{{-1, -1, -1}, z, x}, white},
                 {ljus::Quad{{-1, 1, -1}, x, z}, white},
                 {ljus::Quad{{-1, -1, -1}, x, y}, white},
                 {ljus::Quad{{-1, -1, -1}, y, z}, {.color{0.63f, 0.07f, 0.05f}}},
                 {ljus::Quad{{1, -1, -1}, z, y}, {.color{0.14f, 0.45f, 0.09f}}},
                 {ljus::Sphere{{-0.42f, -0.6f, -0.35f}, 0.4f}, white},
                 {ljus::Sphere{{0.45f, -0.7f, 0.25f}, 0.3f}, white},
                 {ljus::Quad{{-0.3f, 0.99f, -0.3f}, {0.6f, 0, 0}, {0, 0, 0.6f}},
                  {.color = Rgb{0}, .emission{17, 13, 8}}}}};
    const ljus::Camera camera =
        ljus::look_at({.position{0, 0, 3.9f}, .target{0, 0, 0}, .vfov_degrees = 40});
    ljus::Image image = ljus::make_image(320, 320);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            auto stream = ljus::random_stream(
                1, ljus::Pass::user, 0,
                static_cast<std::uint64_t>(row * image.width + column));
            Rgb sum{0};
            for (int path = 0; path < paths; ++path) {
                const ljus::Vec2 at =
                    ljus::Vec2{float(column), float(row)} + next_2d(stream);
                const Ray ray = primary_ray(camera, at, image.width, image.height);
                sum += radiance(room, ray, stream);
            }
            pixel(image, column, row) = sum / float(paths);
        }
    ljus::save_png(image, file);
}
