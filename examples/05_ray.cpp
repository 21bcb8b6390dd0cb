// smoke: --quality draft --width 24
/// \file 05_ray.cpp
/// \brief Starts shadow rays at a fixed distance from the surface, or at a distance
/// that follows from the rounding error of the point, in one room of five sizes.

#include <algorithm>
#include <cmath>
#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;
using Point = Vec3T<double>;

namespace {

const Point middle{10, 10, -10}; // middle of a room of size 1, far from the origin

/// A point of the room, for a room of this size.
Vec3 at(double size, const Point& place) {
    return Vec3(size * (middle + place));
}

/// A ball on a floor, and beside it a thin lid.
auto make_room(double size) {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian>> scene;
    const auto red = scene.add(Lambertian{.albedo{0.8f, 0.3f, 0.25f}});
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto blue = scene.add(Lambertian{.albedo{0.3f, 0.5f, 0.75f}});
    const auto s = float(size);
    const auto level = [&](const Point& corner, float width, float depth) {
        return Quad{at(size, corner), {0, 0, depth * s}, {width * s, 0, 0}};
    };
    scene.add(Sphere{at(size, {-0.9, 0.5, 0.1}), 0.5f * s}, red);
    scene.add(level({-4, 0, -5}, 8, 9), grey);
    scene.add(level({0, 0.8, -0.7}, 1.6f, 1.4f), blue);
    scene.add(level({0, 0.802, -0.7}, 1.6f, 1.4f), blue);
    return World(std::move(scene));
}

/// The shadow ray to a lamp, from the point that a ray hits at t.
/// \param fixed  The distance from O + tD at which the shadow ray starts, as in the
///               report's program; 0: a distance that follows from the rounding error
///               of the point.
Ray shadow_ray(const Ray& ray, float t, const SurfacePoint& point, const Vec3& lamp,
               float fixed) {
    if (fixed == 0) return spawn_ray_to(point, SurfacePoint{.position = lamp});
    const Vec3 way = lamp - point_at(ray, t);
    return {point_at(ray, t), way / glm::length(way), fixed, glm::length(way)};
}

/// The light at the first hit of a ray, from a lamp above the room and an orange lamp
/// below the lid.
template <typename Room>
Rgb seen(const Room& room, const Ray& ray, double size, float fixed) {
    const auto hit = closest_hit(room, ray);
    if (!hit) return {0.05f, 0.06f, 0.08f};
    const auto here = vertex_at(room, ray, *hit);
    Rgb light{0.04f};
    const auto add = [&](const Vec3& lamp, const Rgb& power) {
        const Ray shadow = shadow_ray(ray, hit->at.t, here.point, lamp, fixed);
        if (occluded(room, shadow)) return;
        const Vec3 way = (lamp - here.point.position) / float(size);
        const float squared = glm::dot(way, way);
        // Both sides are lit, so that light that leaks through the lid is visible.
        const float cosine = glm::dot(here.point.normal, way) / std::sqrt(squared);
        light += power * std::abs(cosine) / squared;
    };
    add(at(size, {-2.5, 3, 1.5}), Rgb{9});
    add(at(size, {0.8, 0.35, 0}), 0.35f * Rgb{1, 0.55f, 0.15f});
    return light * room.visit_material(here.object.material,
                                       [](const Lambertian& m) { return m.albedo; });
}

/// The room in one size.
Image picture(int width, double size, float fixed) {
    const int height = std::max(1, 2 * width / 3);
    const auto room = make_room(size);
    const Vec3 start = at(size, {0.2, 2, 4.2});
    const Point eye(start), target = size * (middle + Point{0, 0.35, 0});
    const Point forward = glm::normalize(target - eye);
    const Point right = glm::normalize(glm::cross(forward, Point{0, 1, 0}));
    const Point up = glm::cross(right, forward);
    Image image = make_image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double across = 0.9 * ((x + 0.5) / width - 0.5);
            const double along = 0.9 * (0.5 * height - y - 0.5) / width;
            const Point way = forward + across * right + along * up;
            const Ray ray{.origin = start, .direction = Vec3(glm::normalize(way))};
            pixel(image, x, y) = seen(room, ray, size, fixed);
        }
    return image;
}

} // namespace

/// Makes pictures with both kinds of shadow rays.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 5, the ray: one room in five sizes.");
        line.without({"--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse(
            {.draft{.width = 540}, .report{.width = 540}, .reference{.width = 1080}});
        for (const std::string size : {"0.01", "0.1", "1", "100", "10000"})
            save_png(picture(options.width, std::stod(size), 1e-3f),
                     options.path("ray-fixed-" + size + ".png"));
        save_png(picture(options.width, 10000, 0), options.path("ray-leave-10000.png"));
    });
}
