#pragma once

/// \file answer.hpp
/// \brief Assignment 4: yours to write. As it is, it compiles and every test fails.

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

// [asked]
// A point of a lamp, chosen by chance.
struct LampPoint {
    const Object* lamp = nullptr;
    SurfacePoint point{};
    float density = 0; ///< Of this point, per unit of area; choice of lamp included.
};

// Chooses one of the objects with an emission, and a point of it; nothing if the room
// has no lamp.
inline std::optional<LampPoint> choose_lamp_point(const Room& room,
                                                  RandomStream& stream) {
    return std::nullopt;
}

// One sample of the light that comes straight from the lamps and that a diffuse
// surface sends to where the ray comes from. It draws one shadow ray.
inline Rgb direct_light(const Room& room, const Surface& surface, const Ray& ray,
                        RandomStream& stream) {
    return Rgb{0};
}

// One sample of all the light that comes along a ray in a room of diffuse objects:
// what the surface emits, direct light at each surface of the path, and a path that
// ends by Russian roulette only.
inline Rgb radiance(const Room& room, Ray ray, RandomStream& stream) {
    return Rgb{0};
}
// [asked]

} // namespace answer
