#pragma once

/// \file answer.hpp
/// \brief Assignment 6: a solution, for those who keep the course.

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "course/room.hpp"
#include "given.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d; // uniform in [0, 1)

inline bool belongs_to_caustics_map(std::string_view path) {
    const std::size_t first = path.find('D');
    if (first == std::string_view::npos || path.rfind('D') != first) return false;
    return path.substr(0, first).find('S') != std::string_view::npos;
}

/// 1 - cos of half the angle under which a lamp sees a ball, without cancellation.
inline float cap(const PointLamp& lamp, const Sphere& ball) {
    const Vec3 way = ball.center - lamp.position;
    const float sine2 = ball.radius * ball.radius / dot(way, way);
    return sine2 / (1 + std::sqrt(1 - sine2));
}

inline Rgb flux_towards(const PointLamp& lamp, const Sphere& ball) {
    return 2 * std::numbers::pi_v<float> * cap(lamp, ball) * lamp.intensity;
}

inline Flight aim(const PointLamp& lamp, const Sphere& ball, int count, Vec2 u) {
    const float w = u.x * cap(lamp, ball);
    const float r = std::sqrt(w * (2 - w));
    const float phi = 2 * std::numbers::pi_v<float> * u.y;
    const Vec3 axis = normalize(ball.center - lamp.position);
    const Vec3 way = ljus::to_world(ljus::frame_around(axis),
                                    {r * std::cos(phi), r * std::sin(phi), 1 - w});
    return {{.origin = lamp.position, .direction = way},
            flux_towards(lamp, ball) / float(count)};
}

inline std::optional<Photon> follow(const Room& room, Flight flight,
                                    RandomStream& stream) {
    for (int met = 0; met <= 20; ++met) {
        const auto surface = nearest(room, flight.ray);
        if (!surface) return std::nullopt;
        const auto& matter = surface->object->matter;
        const Vec3 d = flight.ray.direction, n = surface->point.normal;
        if (matter.kind == Kind::diffuse) {
            if (met == 0) return std::nullopt;
            return Photon{surface->point.position, d, flight.flux};
        }
        Vec3 way = ljus::reflect(d, n);
        if (matter.kind == Kind::mirror) {
            flight.flux *= matter.color;
        } else {
            const bool enters = dot(d, n) < 0;
            const float n_1 = enters ? 1 : matter.index;
            const float n_2 = enters ? matter.index : 1;
            const float share = ljus::fresnel(std::abs(dot(d, n)), n_1, n_2);
            if (!(next_1d(stream) < share))
                if (const auto through = ljus::refract(d, n, n_1 / n_2)) way = *through;
        }
        flight.ray = ljus::spawn_ray(surface->point, way);
    }
    return std::nullopt;
}

} // namespace answer
