// smoke:
/// \file 38_break_it.cpp
/// \brief Chapter 38: one line of the refraction is left out. The program makes the
/// right picture, the wrong picture, and their difference.
// runs in the folder of its picture

#include <algorithm>
#include <cmath>
#include <optional>

#include <ljus/ljus.hpp>

#include "common/error_map.hpp"

using namespace ljus;

namespace {

constexpr int size = 160; // pixels on a side

/// Snell's law as in `ljus::refract`, with one line left out: a negative square is
/// replaced by 0, although it means total internal reflection.
// [wrong]
std::optional<Vec3> wrong_refract(const Vec3& direction, const Vec3& normal,
                                  float eta) {
    const float cos_1 = glm::dot(direction, normal);
    const Vec3 along = direction - cos_1 * normal;
    const float square = cos_1 * cos_1 + (1 - eta) * (1 + eta) * glm::dot(along, along);
    // right: if (square < 0) return std::nullopt;
    const float cos_2 = std::copysign(std::sqrt(std::max(square, 0.0f)), cos_1);
    const Vec3 t = eta * along + cos_2 * normal;
    return t / glm::length(t);
}
// [wrong]

/// The colour of the floor of a pool. The floor has squares.
Rgb floor_color(const Vec3& place) {
    const int squares = int(std::floor(place.x)) + int(std::floor(place.z));
    return (squares % 2 == 0 ? 0.75f : 0.25f) * Rgb{0.25f, 0.6f, 0.65f};
}

/// The sky, which is brighter at the horizon.
Rgb sky_color(const Vec3& direction) {
    const float up = std::sqrt(std::max(0.0f, direction.y));
    return glm::mix(Rgb{0.95f, 0.85f, 0.7f}, Rgb{0.2f, 0.4f, 0.8f}, up);
}

/// A function that refracts a ray; it returns nothing if all light is reflected.
using Refract = std::optional<Vec3>(const Vec3& direction, const Vec3& normal,
                                    float eta);

/// The view of a swimmer who looks up: the sky within a cone, the mirrored floor around
/// it.
Image pool(Refract* refract) {
    const Camera camera = look_at({.position{0, -1, 0},
                                   .target{0, 0, -0.45f},
                                   .up{0, 0, -1},
                                   .vfov_degrees = 115});
    const Vec3 surface{0, 1, 0};
    const auto color = [&](const Ray& ray) {
        if (ray.direction.y <= 0) return Rgb{0.1f, 0.2f, 0.25f}; // deep water
        if (const auto up = refract(ray.direction, surface, 1.333f))
            return sky_color(*up);
        const Vec3 place = ray.origin + 1 / ray.direction.y * ray.direction;
        const Vec3 down = reflect(ray.direction, surface);
        return floor_color(place + (-2 - place.y) / down.y * down);
    };
    Image image = make_image(size, size);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            for (int i = 0; i < 9; ++i) { // a grid of nine rays
                const Vec2 place = (Vec2{float(i % 3), float(i / 3)} + 0.5f) / 3.0f;
                pixel(image, x, y) += color(
                    primary_ray(camera, Vec2{float(x), float(y)} + place, size, size));
            }
            pixel(image, x, y) /= 9.0f;
        }
    return image;
}

/// Copies a picture into a wider one.
void put(Image& all, const Image& part, int left) {
    for (int y = 0; y < part.height; ++y)
        for (int x = 0; x < part.width; ++x)
            pixel(all, left + x, y) = pixel(part, x, y);
}

} // namespace

/// Renders what a swimmer sees, right and wrong.
int main() {
    const Image right = pool(ljus::refract<float>);
    const Image wrong = pool(wrong_refract);
    ImageT<double> difference = make_image<double>(size, size);
    for (std::size_t i = 0; i < right.pixels.size(); ++i)
        difference.pixels[i] = RgbT<double>(
            double(luminance(wrong.pixels[i]) - luminance(right.pixels[i])));
    const Image map = examples::error_picture(difference, examples::Ramp::signs, -1, 1);

    constexpr int gap = 6;
    Image all = make_image(2 * (size + gap) + map.width, map.height, Rgb{1});
    put(all, right, 0);
    put(all, wrong, size + gap);
    put(all, map, 2 * (size + gap));
    save_png(all, "break_it-refraction-total-ignored.png");
}
