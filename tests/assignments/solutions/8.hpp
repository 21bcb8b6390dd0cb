#pragma once

/// \file answer.hpp
/// \brief Assignment 8: a solution, for those who keep the course.

#include <algorithm>
#include <cmath>

#include "given.hpp"
#include "ljus/math/random.hpp"

namespace answer {

inline double transmittance(const Fog& fog, double distance) {
    return std::exp(-fog.extinction() * distance);
}

inline double sample_flight(const Fog& fog, double u) {
    return -std::log1p(-u) / fog.extinction();
}

inline double pdf_flight(const Fog& fog, double t) {
    return fog.extinction() * transmittance(fog, t);
}

inline double phase(double g, double cosine) {
    return (1 - g * g) / (4 * pi * std::pow(1 + g * g - 2 * g * cosine, 1.5));
}

inline Vec3 sample_phase(double g, const Vec3& travel, double u, double v) {
    const double s = 2 * u - 1, q = (1 - g * g) / (1 + g * s);
    const double cosine = (g + (s + g) * (1 + q) / (1 + g * s)) / 2;
    const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const Vec3 x = perpendicular(travel), y = cross(travel, x);
    return cosine * travel + sine * std::cos(2 * pi * v) * x +
           sine * std::sin(2 * pi * v) * y;
}

// The lamp from the ray: the nearest point, the distance from there, and two angles.
struct Angles {
    double nearest, away, first, last;
};
inline Angles angles(const Ray& ray, double length, const Vec3& lamp) {
    const Vec3 to = lamp - ray.origin;
    const double nearest = dot(to, ray.direction);
    const double away = glm::length(to - nearest * ray.direction);
    return {nearest, away, std::atan(-nearest / away),
            std::atan((length - nearest) / away)};
}

inline double sample_angle(const Ray& ray, double length, const Vec3& lamp, double u) {
    const Angles a = angles(ray, length, lamp);
    const double t = a.nearest + a.away * std::tan(a.first + u * (a.last - a.first));
    return std::clamp(t, 0.0, length);
}

inline double pdf_angle(const Ray& ray, double length, const Vec3& lamp, double t) {
    const Angles a = angles(ray, length, lamp);
    const double off = t - a.nearest;
    return a.away / ((a.last - a.first) * (a.away * a.away + off * off));
}

inline double scattered_once(const Night& night, const Ray& ray, double length,
                             RandomStream& stream) {
    const Fog& fog = night.fog;
    double sum = 0;
    for (const bool flight : {true, false}) {
        const double u = next_1d<double>(stream);
        const double t =
            flight ? sample_flight(fog, u) : sample_angle(ray, length, night.lamp, u);
        if (t > length) continue;
        const Vec3 point = ray.origin + t * ray.direction;
        if (!night.sees_lamp(point)) continue;
        const Vec3 to = night.lamp - point;
        const double d = glm::length(to);
        const double cosine = dot(to, ray.direction) / d;
        const double light = transmittance(fog, t) * fog.scattering *
                             phase(fog.g, cosine) * transmittance(fog, d) *
                             night.intensity / (d * d);
        sum += light / (pdf_flight(fog, t) + pdf_angle(ray, length, night.lamp, t));
    }
    return sum;
}

inline double radiance_in_ball(const Fog& fog, double radius, double around, Ray ray,
                               RandomStream& stream) {
    const double albedo = fog.scattering / fog.extinction();
    double light = 0;
    while (true) {
        const double out = way_out(ray, radius);
        const double t = sample_flight(fog, next_1d<double>(stream));
        if (t >= out) return light + around;
        light += fog.glow / fog.extinction();
        if (next_1d<double>(stream) >= albedo) return light;
        ray.origin += t * ray.direction;
        const double u = next_1d<double>(stream), v = next_1d<double>(stream);
        ray.direction = sample_phase(fog.g, ray.direction, u, v);
    }
}

} // namespace answer
