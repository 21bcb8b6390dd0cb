// Assignment 6: the caustics of a glass ball and a mirror ball on a floor, by the
// caustics map, with direct light by shadow rays. The balls are drawn as outlines only.
#include <answer.hpp>

#include <string>

#include "ljus/image/image.hpp"
#include "ljus/io/png.hpp"
#include "ljus/scene/camera.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-6.png";
    const int aimed = count > 2 ? std::stoi(arguments[2]) : 100000;
    const Sphere glass{{-0.8f, 1.1f, 0}, 1}, mirror{{1.6f, 0.8f, -0.6f}, 0.8f};
    const Room room{.objects{{ljus::Quad{{-5, 0, 5}, {10, 0, 0}, {0, 0, -10}},
                              {.color = Rgb{0.7f}}},
                             {glass, {.kind = Kind::glass}},
                             {mirror, {Kind::mirror, {0.9f, 0.8f, 0.6f}}}},
                    .lamps{{{-1.6f, 5, -4}, Rgb{45}}}};
    std::vector<Photon> photons;
    for (const Sphere& ball : {glass, mirror})
        for (int i = 0; i < aimed; ++i) {
            auto stream = ljus::random_stream(1, ljus::Pass::user, ball.center.x > 0,
                                              static_cast<std::uint64_t>(i));
            const Flight flight =
                aim(room.lamps[0], ball, aimed, ljus::next_2d(stream));
            if (const auto photon = follow(room, flight, stream))
                photons.push_back(*photon);
        }
    const PhotonMap map(photons);
    const ljus::Camera camera = ljus::look_at(
        {.position{0.3f, 5.5f, 7}, .target{0.3f, 0.3f, 0.6f}, .vfov_degrees = 36});
    ljus::Image image = ljus::make_image(480, 320);
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const Vec2 at{float(column) + 0.5f, float(row) + 0.5f};
            const Ray ray = primary_ray(camera, at, image.width, image.height);
            const auto surface = nearest(room, ray);
            if (!surface) continue;
            if (surface->object->matter.kind != Kind::diffuse) {
                const float rim = 1 + dot(ray.direction, surface->point.normal);
                pixel(image, column, row) = Rgb{0.25f} * rim * rim;
                continue;
            }
            const Vec3 way = room.lamps[0].position - surface->point.position;
            const float distance2 = dot(way, way);
            Rgb color = map.estimate(*surface, ray, 0.07f);
            if (visible(room, surface->point, room.lamps[0].position))
                color += surface->object->matter.color / 3.14159265f *
                         room.lamps[0].intensity * dot(way, surface->point.normal) /
                         (distance2 * std::sqrt(distance2));
            pixel(image, column, row) = color;
        }
    ljus::save_png(image, file);
}
