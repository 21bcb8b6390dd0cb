#pragma once

/// \file answer.hpp
/// \brief Assignment 5: a solution, for those who keep the course.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "course/room.hpp"
#include "given.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d, ljus::next_2d; // uniform in [0, 1)

inline Vec3 cosine_around(const Vec3& normal, RandomStream& stream) {
    return ljus::to_world(ljus::frame_around(normal),
                          ljus::sample_cosine_hemisphere(next_2d(stream)));
}

inline Flight emit(const Room& room, int count, RandomStream& stream) {
    float total = 0;
    const auto power = [](const Object& object) {
        return ljus::max_component(object.matter.emission) * area(object);
    };
    for (const Object& object : room.objects) total += power(object);
    float rest = next_1d(stream) * total;
    for (const Object& object : room.objects) {
        rest -= power(object);
        if (!(rest < 0)) continue;
        const SurfacePoint point = sample_area(object, next_2d(stream));
        const float chance = power(object) / total;
        return {ljus::spawn_ray(point, cosine_around(point.normal, stream)),
                object.matter.emission * std::numbers::pi_v<float> * area(object) /
                    (chance * float(count))};
    }
    return {};
}

inline void follow(const Room& room, Flight flight, RandomStream& stream,
                   std::vector<Photon>& stored) {
    while (const auto surface = nearest(room, flight.ray)) {
        const Vec3 way = flight.ray.direction;
        stored.push_back({surface->point.position, way, flight.flux});
        const Rgb albedo = surface->object->matter.color;
        const float chance = ljus::max_component(albedo);
        if (!(next_1d(stream) < chance)) return;
        flight.flux *= albedo / chance;
        const Vec3 n = course::facing(surface->point.normal, way);
        flight.ray = ljus::spawn_ray(surface->point, cosine_around(n, stream));
    }
}

inline float kernel(float x) {
    return 2 * (1 - x);
}

inline Rgb estimate(const PhotonMap& map, const Surface& surface, const Ray& ray,
                    float radius) {
    const Vec3& x = surface.point.position;
    const Vec3 n = course::facing(surface.point.normal, ray.direction);
    Rgb sum{0};
    map.visit_within(x, radius, [&](const Photon& photon, float distance2) {
        if (!(dot(photon.direction, n) < 0)) return; // it came to the other side
        if (std::abs(dot(photon.position - x, n)) > 0.5f * radius) return;
        sum += kernel(distance2 / (radius * radius)) * photon.flux;
    });
    constexpr float pi = std::numbers::pi_v<float>;
    return surface.object->matter.color / pi * sum / (pi * radius * radius);
}

} // namespace answer
