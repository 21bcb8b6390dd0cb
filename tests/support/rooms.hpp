#pragma once

/// \file support/rooms.hpp
/// \brief A closed room with a ball of any material and lights of any kind.

#include <tuple>
#include <utility>

#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/world.hpp"

namespace ljus_test {

/// The scene type of the rooms, with all shapes and materials that they use.
template <typename T>
using BallRoomT =
    ljus::Scene<ljus::Shapes<ljus::SphereT<T>, ljus::QuadT<T>>,
                ljus::Materials<ljus::LambertianT<T>, ljus::OrenNayarT<T>,
                                ljus::MirrorT<T>, ljus::GlassT<T>, ljus::MixtureT<T>>,
                ljus::Lights<ljus::PointLightT<T>>>;
using BallRoom = BallRoomT<float>;
/// The world of that scene type.
template <typename T>
using ClosedRoomT = ljus::World<BallRoomT<T>>;
using ClosedRoom = ClosedRoomT<float>;

/// Adds the six walls of [-1, 1]^3, which are matt on both sides. The left wall is red,
/// and the right wall is green.
template <typename T>
void add_walls(BallRoomT<T>& room, T albedo = T(0.5)) {
    using V = ljus::Vec3T<T>;
    const auto grey = room.add(ljus::LambertianT<T>{.albedo = ljus::RgbT<T>{albedo}});
    const auto red = room.add(
        ljus::LambertianT<T>{.albedo = albedo * ljus::RgbT<T>{T(1.2), T(0.6), T(0.6)}});
    const auto green = room.add(
        ljus::LambertianT<T>{.albedo = albedo * ljus::RgbT<T>{T(0.6), T(1.2), T(0.6)}});
    const V x{T(2), T(0), T(0)}, y{T(0), T(2), T(0)}, z{T(0), T(0), T(2)};
    for (const auto& [corner, u, v, material] :
         {std::tuple{V{-1, -1, -1}, z, x, grey}, std::tuple{V{-1, 1, -1}, x, z, grey},
          std::tuple{V{-1, -1, -1}, x, y, grey}, std::tuple{V{-1, -1, 1}, y, x, grey},
          std::tuple{V{-1, -1, -1}, y, z, red}, std::tuple{V{1, -1, -1}, z, y, green}})
        room.add(ljus::QuadT<T>{.corner = corner, .edge_u = u, .edge_v = v}, material);
}

/// The material of the ball in the room.
enum class Ball { lambertian, oren_nayar, mirror, glass, mixture };
/// The kind of light in the room.
enum class Lamp { quad, sphere, point };

/// The material of the ball as a word, for the messages of tests.
inline const char* name(Ball ball) {
    switch (ball) {
    case Ball::lambertian:
        return "Lambertian";
    case Ball::oren_nayar:
        return "Oren-Nayar";
    case Ball::mirror:
        return "mirror";
    case Ball::glass:
        return "glass";
    case Ball::mixture:
        return "mixture";
    }
    return "";
}
/// The kind of light as a word, for the messages of tests.
inline const char* name(Lamp lamp) {
    return lamp == Lamp::quad ? "quad" : lamp == Lamp::sphere ? "sphere" : "point";
}

/// Adds a ball near the middle of the room, above the floor.
template <typename T>
void add_ball(BallRoomT<T>& room, Ball ball) {
    using C = ljus::RgbT<T>;
    ljus::MaterialId material;
    switch (ball) {
    case Ball::lambertian:
        material = room.add(ljus::LambertianT<T>{.albedo = C{T(0.8), T(0.6), T(0.3)}});
        break;
    case Ball::oren_nayar:
        material = room.add(
            ljus::OrenNayarT<T>{.albedo = C{T(0.8), T(0.6), T(0.3)}, .sigma = T(0.6)});
        break;
    case Ball::mirror:
        material = room.add(ljus::MirrorT<T>{.reflectance = C{T(0.9), T(0.8), T(0.7)}});
        break;
    case Ball::glass:
        material = room.add(
            ljus::GlassT<T>{.index = T(1.5), .absorption = C{T(0.1), T(0.3), T(0.6)}});
        break;
    case Ball::mixture:
        material = room.add(ljus::MixtureT<T>{.color = C{T(0.7), T(0.5), T(0.3)},
                                              .reflectivity = T(0.2),
                                              .transparency = T(0.4),
                                              .index = T(1.5),
                                              .specularity = T(1),
                                              .sigma = T(0.4),
                                              .absorption = C{T(0.1)}});
        break;
    }
    room.add(ljus::SphereT<T>{.center{T(0.1), T(-0.4), T(-0.1)}, .radius = T(0.45)},
             material);
}

/// Adds one light, or two of different size, colour and position. room_camera() sees
/// none of them.
template <typename T>
void add_lamps(BallRoomT<T>& room, Lamp lamp, int count) {
    using V = ljus::Vec3T<T>;
    using C = ljus::RgbT<T>;
    const auto black = room.add(ljus::LambertianT<T>{.albedo = C{T(0)}});
    const auto add = [&](const V& center, T size, const C& radiance) {
        if (lamp == Lamp::quad)
            room.add(ljus::QuadT<T>{.corner = center - V{size, T(0), size},
                                    .edge_u{T(2) * size, T(0), T(0)},
                                    .edge_v{T(0), T(0), T(2) * size}}, // shines down
                     black, radiance);
        else if (lamp == Lamp::sphere)
            room.add(ljus::SphereT<T>{.center = center - V{T(0), T(0.34), T(0)},
                                      .radius = T(0.64) * size},
                     black, radiance);
        else
            room.add(ljus::PointLightT<T>{.position = center - V{T(0), T(0.2), T(0)},
                                          .intensity = size * size * radiance});
    };
    add(V{T(-0.1), T(0.98), T(-0.05)}, T(0.5), C{T(4), T(4), T(3)});
    if (count == 2) add(V{T(0.6), T(0.9), T(0.6)}, T(0.3), C{T(1), T(3), T(8)});
}

/// The closed world of a room with a ball and lights.
template <typename T>
ClosedRoomT<T> make_room(Ball ball, Lamp lamp, int lamps) {
    BallRoomT<T> room;
    add_walls(room);
    add_ball(room, ball);
    add_lamps(room, lamp, lamps);
    return ClosedRoomT<T>(std::move(room));
}

/// A camera at the front wall that looks downwards.
template <typename T>
ljus::CameraT<T> room_camera() {
    return ljus::look_at(ljus::ViewT<T>{.position{T(0), T(0.25), T(0.97)},
                                        .target{T(0), T(-0.45), T(-0.3)},
                                        .vfov_degrees = T(70)});
}

} // namespace ljus_test

#ifdef LJUS_CORE // not defined for the broken headers of tests/break_it
#include "support/rooms_core.hpp"
#endif
