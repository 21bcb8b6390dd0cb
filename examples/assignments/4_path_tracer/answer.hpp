#pragma once

/// \file answer.hpp
/// \brief Assignment 4: yours to write. The file compiles, but every test fails.

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
// A random point of a lamp.
struct LampPoint {
    const Object* lamp = nullptr;
    SurfacePoint point{};
    float density = 0; ///< Density of the point, per unit of area, including the choice
                       ///< of the lamp.
};

// Chooses one of the objects with an emission, and a point of it; nothing if the room
// has no lamp.
inline std::optional<LampPoint> choose_lamp_point(const Room& room,
                                                  RandomStream& stream) {
    return std::nullopt;
}

// One sample of the radiance that a diffuse surface reflects to the origin of the ray,
// of light that comes straight from the lamps. It takes one shadow ray.
inline Rgb direct_light(const Room& room, const Surface& surface, const Ray& ray,
                        RandomStream& stream) {
    return Rgb{0};
}

// One sample of the radiance that arrives along a ray in a room of diffuse objects. It
// includes the emission of the first surface, and direct light at each surface of a
// path that ends only by Russian roulette.
inline Rgb radiance(const Room& room, Ray ray, RandomStream& stream) {
    return Rgb{0};
}
// [asked]

} // namespace answer
