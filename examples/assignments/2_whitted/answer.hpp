#pragma once

/// \file answer.hpp
/// \brief Assignment 2: yours to write. The file compiles, but every test fails.

#include <cmath>
#include <numbers>
#include <optional>

#include "course/room.hpp"

namespace answer {

using course::Kind, course::Matter, course::Object, course::PointLamp, course::Room,
    course::Surface;
using ljus::Ray, ljus::Rgb, ljus::Vec3;

// [asked]
// The direction of a ray after a mirror. `direction` points towards the surface. Both
// vectors have length 1. The normal may be on either side.
inline Vec3 reflect(const Vec3& direction, const Vec3& normal) {
    return Vec3{0};
}

// The direction of a ray after refraction at a boundary; nothing under total internal
// reflection. The normal may be on either side. The ratio eta is n_1/n_2, where the ray
// comes from the side with index n_1.
inline std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal,
                                   float eta) {
    return std::nullopt;
}

// The fraction of unpolarised light that a boundary reflects. `cosine` is the cosine of
// the angle between ray and normal on the side of index n_1, in [0, 1].
inline float fresnel(float cosine, float n_1, float n_2) {
    return 0;
}

// The radiance of the lamps' light that a diffuse surface reflects to the origin of the
// ray. All lamps count that no object hides.
inline Rgb diffuse_light(const Room& room, const Surface& surface, const Ray& ray) {
    return Rgb{0};
}

// The radiance that arrives along a ray. Diffuse objects have that of diffuse_light(),
// and a ray that meets nothing has that of the sky. At mirrors and glass further rays
// are followed. A ray may meet at most `depth` surfaces of mirror or glass; after these
// it is black.
inline Rgb radiance(const Room& room, const Ray& ray, int depth) {
    return Rgb{0};
}
// [asked]

} // namespace answer
