// Assignment 1: three balls on a fourth, and a lamp without a size.
#include <answer.hpp>

#include <numbers>
#include <string>

#include "ljus/io/png.hpp"

using namespace answer;

int main(int count, char** arguments) {
    const std::string file = count > 1 ? arguments[1] : "assignment-1.png";
    const std::vector<Ball> balls{{{-2.1f, 0, -8}, 1, {0.8f, 0.3f, 0.2f}},
                                  {{0, 0.3f, -9}, 1.3f, {0.8f, 0.8f, 0.7f}},
                                  {{2, -0.2f, -7}, 0.8f, {0.2f, 0.4f, 0.8f}},
                                  {{0, -1001, -8}, 1000, {0.6f, 0.6f, 0.6f}}};
    const Vec3 lamp{3, 6, -3};
    const Eye eye{.position{0, 0.6f, 0}, .vfov_degrees = 35};
    ljus::Image image = ljus::make_image(480, 320);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x)
            for (int part = 0; part < 4; ++part) {
                const Vec2 at{float(x) + 0.25f + 0.5f * float(part % 2),
                              float(y) + 0.25f + 0.5f * float(part / 2)};
                const Ray ray = primary_ray(eye, at, image.width, image.height);
                const auto hit = nearest(ray, balls);
                Rgb color{0.25f, 0.3f, 0.4f};
                if (hit) {
                    const Vec3 point = ray.origin + hit->t * ray.direction;
                    const Vec3 n = normal(balls[hit->ball], point);
                    const Vec3 way = lamp - point;
                    const float distance = length(way);
                    const float cosine = dot(n, way) / distance;
                    float light = 0.25f; // from everywhere
                    if (sees(balls, point, n, lamp))
                        light += 55 * cosine / (distance * distance);
                    color = balls[hit->ball].color * light;
                }
                pixel(image, x, y) += color / 4.0f;
            }
    ljus::save_png(image, file);
}
