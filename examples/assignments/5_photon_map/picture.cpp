// Assignment 5: a box with two balls, its light from the photon map alone.
#include <answer.hpp>

#include <string>

#include "ljus/io/png.hpp"
#include "ljus/scene/camera.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-5.png";
    const int emitted_photons = count > 2 ? std::stoi(arguments[2]) : 100000;
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
    std::vector<Photon> photons;
    for (int i = 0; i < emitted_photons; ++i) {
        auto stream =
            ljus::random_stream(1, ljus::Pass::user, 0, static_cast<std::uint64_t>(i));
        follow(room, emit(room, emitted_photons, stream), stream, photons);
    }
    const PhotonMap map(photons);
    const ljus::Camera camera =
        ljus::look_at({.position{0, 0, 3.9f}, .target{0, 0, 0}, .vfov_degrees = 40});
    ljus::Image image = ljus::make_image(320, 320);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const ljus::Vec2 at{float(column) + 0.5f, float(row) + 0.5f};
            const Ray ray = primary_ray(camera, at, image.width, image.height);
            const auto surface = nearest(room, ray);
            if (surface)
                pixel(image, column, row) =
                    emitted(*surface->object, surface->point, -ray.direction) +
                    estimate(map, *surface, ray, 0.12f);
        }
    ljus::save_png(image, file);
}
