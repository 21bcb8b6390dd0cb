#pragma once

/// \file answer.hpp
/// \brief Assignment 4: a solution, for those who keep the course.

#include <algorithm>
#include <numbers>
#include <optional>
#include <vector>

#include "course/room.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

namespace answer {

using course::Object, course::Room, course::Surface;
using ljus::RandomStream, ljus::next_1d, ljus::next_2d; // uniform in [0, 1)
using ljus::Ray, ljus::Rgb, ljus::SurfacePoint, ljus::Vec3;

struct LampPoint {
    const Object* lamp = nullptr;
    SurfacePoint point{};
    float density = 0;
};

inline std::optional<LampPoint> choose_lamp_point(const Room& room,
                                                  RandomStream& stream) {
    std::vector<const Object*> lamps;
    for (const Object& object : room.objects)
        if (!ljus::is_black(object.matter.emission)) lamps.push_back(&object);
    if (lamps.empty()) return std::nullopt;
    const auto n = static_cast<float>(lamps.size());
    const auto which = static_cast<std::size_t>(next_1d(stream) * n);
    const Object* lamp = lamps[std::min(which, lamps.size() - 1)];
    return LampPoint{lamp, sample_area(*lamp, next_2d(stream)), 1 / (n * area(*lamp))};
}

inline Rgb direct_light(const Room& room, const Surface& surface, const Ray& ray,
                        RandomStream& stream) {
    const auto chosen = choose_lamp_point(room, stream);
    if (!chosen) return Rgb{0};
    const Vec3 way = chosen->point.position - surface.point.position;
    const float distance2 = dot(way, way);
    const Vec3 wi = normalize(way);
    const float cos_here = dot(course::facing(surface.point.normal, ray.direction), wi);
    const float cos_lamp = -dot(chosen->point.normal, wi);
    if (!(cos_here > 0 && cos_lamp > 0)) return Rgb{0};
    if (!visible(room, surface.point, chosen->point)) return Rgb{0};
    const float geometry = cos_here * cos_lamp / distance2;
    return surface.object->matter.color * std::numbers::inv_pi_v<float> *
           emitted(*chosen->lamp, chosen->point, -wi) * (geometry / chosen->density);
}

inline Rgb radiance(const Room& room, Ray ray, RandomStream& stream) {
    Rgb sum{0}, throughput{1};
    for (bool first = true;; first = false) {
        const auto surface = nearest(room, ray);
        if (!surface) return sum;
        // A later surface that emits has been asked for by the shadow ray before.
        if (first) sum += emitted(*surface->object, surface->point, -ray.direction);
        sum += throughput * direct_light(room, *surface, ray, stream);

        throughput *= surface->object->matter.color;
        const float chance = std::min(0.95f, ljus::max_component(throughput));
        if (!(next_1d(stream) < chance)) return sum;
        throughput /= chance;
        const Vec3 n = course::facing(surface->point.normal, ray.direction);
        const Vec3 local = ljus::sample_cosine_hemisphere(next_2d(stream));
        ray = ljus::spawn_ray(surface->point,
                              ljus::to_world(ljus::frame_around(n), local));
    }
}

} // namespace answer
