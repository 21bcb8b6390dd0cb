#pragma once

/// \file answer.hpp
/// \brief Assignment 1: a solution, for those who keep the course.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "given.hpp"

namespace answer {

inline Ray primary_ray(const Eye& eye, Vec2 pixel, int width, int height) {
    const float half = std::tan(eye.vfov_degrees * std::numbers::pi_v<float> / 360);
    const float scale = 2 * half / float(height);
    const float x = (pixel.x - float(width) / 2) * scale;
    const float y = (float(height) / 2 - pixel.y) * scale;
    return {.origin = eye.position, .direction = normalize(Vec3{x, y, -1})};
}

inline std::optional<float> intersect(const Ray& ray, const Ball& ball) {
    const Vec3 m = ray.origin - ball.center;
    const float a = dot(ray.direction, ray.direction);
    const float b = -dot(m, ray.direction);
    // The point of the line that is nearest to the centre: no large numbers cancel.
    const Vec3 closest = m + (b / a) * ray.direction;
    const float rest = ball.radius * ball.radius - dot(closest, closest);
    if (!(rest >= 0)) return std::nullopt;
    const float root = std::sqrt(rest / a);
    const float enter = b / a - root;
    const float leave = b / a + root;
    if (ray.t_min <= enter && enter <= ray.t_max) return enter;
    if (ray.t_min <= leave && leave <= ray.t_max) return leave;
    return std::nullopt;
}

inline Vec3 normal(const Ball& ball, const Vec3& point) {
    return normalize(point - ball.center);
}

inline std::optional<Hit> nearest(const Ray& ray, const std::vector<Ball>& balls) {
    std::optional<Hit> found;
    for (std::size_t i = 0; i < balls.size(); ++i) {
        const auto t = intersect(ray, balls[i]);
        if (t && (!found || *t < found->t)) found = Hit{*t, i};
    }
    return found;
}

inline bool sees(const std::vector<Ball>& balls, const Vec3& point, const Vec3& normal,
                 const Vec3& lamp) {
    const Vec3 way = lamp - point;
    if (!(dot(way, normal) > 0)) return false;
    const float size =
        std::max({std::abs(point.x), std::abs(point.y), std::abs(point.z)});
    const Vec3 origin = point + 1e-4f * size * normal;
    return !nearest({.origin = origin, .direction = lamp - origin, .t_max = 1}, balls);
}

} // namespace answer
