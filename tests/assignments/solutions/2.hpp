#pragma once

/// \file answer.hpp
/// \brief Assignment 2: a solution, for those who keep the course.

#include <cmath>
#include <numbers>
#include <optional>

#include "course/room.hpp"

namespace answer {

using course::Kind, course::Matter, course::Object, course::PointLamp, course::Room,
    course::Surface;
using ljus::Ray, ljus::Rgb, ljus::Vec3;

inline Vec3 reflect(const Vec3& direction, const Vec3& normal) {
    return direction - 2 * dot(direction, normal) * normal;
}

inline std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal,
                                   float eta) {
    const Vec3 n = course::facing(normal, direction);
    const float cos_1 = -dot(direction, n);
    const float square = 1 - eta * eta * (1 - cos_1 * cos_1);
    if (!(square >= 0)) return std::nullopt;
    return normalize(eta * direction + (eta * cos_1 - std::sqrt(square)) * n);
}

inline float fresnel(float cosine, float n_1, float n_2) {
    const float square = 1 - n_1 * n_1 / (n_2 * n_2) * (1 - cosine * cosine);
    if (square <= 0) return 1;
    const float behind = std::sqrt(square);
    const float s = (n_1 * cosine - n_2 * behind) / (n_1 * cosine + n_2 * behind);
    const float p = (n_2 * cosine - n_1 * behind) / (n_2 * cosine + n_1 * behind);
    return (s * s + p * p) / 2;
}

inline Rgb diffuse_light(const Room& room, const Surface& surface, const Ray& ray) {
    const Vec3 n = course::facing(surface.point.normal, ray.direction);
    Rgb sum{0};
    for (const PointLamp& lamp : room.lamps) {
        const Vec3 way = lamp.position - surface.point.position;
        const float distance2 = dot(way, way);
        const float cosine = dot(way, n) / std::sqrt(distance2);
        if (cosine > 0 && visible(room, surface.point, lamp.position))
            sum += lamp.intensity * cosine / distance2;
    }
    return surface.object->matter.color * std::numbers::inv_pi_v<float> * sum;
}

inline Rgb radiance(const Room& room, const Ray& ray, int depth) {
    const auto surface = nearest(room, ray);
    if (!surface) return room.sky;
    const Matter& matter = surface->object->matter;
    if (matter.kind == Kind::diffuse) return diffuse_light(room, *surface, ray);
    if (depth == 0) return Rgb{0};

    const auto further = [&](const Vec3& way) {
        return radiance(room, ljus::spawn_ray(surface->point, way), depth - 1);
    };
    const Vec3& n = surface->point.normal;
    const Vec3 d = normalize(ray.direction);
    if (matter.kind == Kind::mirror) return matter.color * further(reflect(d, n));

    const bool enters = dot(d, n) < 0;
    const float n_1 = enters ? 1 : matter.index;
    const float n_2 = enters ? matter.index : 1;
    const float share = fresnel(std::abs(dot(d, n)), n_1, n_2);
    Rgb sum = share * further(reflect(d, n));
    if (const auto through = refract(d, n, n_1 / n_2))
        sum += (1 - share) * further(*through);
    return sum;
}

} // namespace answer
