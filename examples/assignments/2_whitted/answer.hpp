#pragma once

/// \file answer.hpp
/// \brief Assignment 2: yours to write. As it is, it compiles and every test fails.

#include <cmath>
#include <numbers>
#include <optional>

#include "course/room.hpp"

namespace answer {

using course::Kind, course::Matter, course::Object, course::PointLamp, course::Room,
    course::Surface;
using ljus::Ray, ljus::Rgb, ljus::Vec3;

// [asked]
// The direction of a ray behind a mirror. `direction` travels towards the surface; it
// and the normal have length 1, and the normal may be on either side.
inline Vec3 reflect(const Vec3& direction, const Vec3& normal) {
    return Vec3{0};
}

// The direction behind a boundary; nothing under total internal reflection. The normal
// may be on either side; eta is n_1/n_2, the index where the ray comes from over the
// index where it goes.
inline std::optional<Vec3> refract(const Vec3& direction, const Vec3& normal,
                                   float eta) {
    return std::nullopt;
}

// The share of the light that a boundary reflects, without polarisation. `cosine` is
// that of the angle between ray and normal, in [0, 1], where the index is n_1.
inline float fresnel(float cosine, float n_1, float n_2) {
    return 0;
}

// What the lamps of the room make a diffuse surface send to where the ray comes from:
// all lamps, none of them through another object.
inline Rgb diffuse_light(const Room& room, const Surface& surface, const Ray& ray) {
    return Rgb{0};
}

// What a ray sees: the sky, diffuse objects by diffuse_light(), and behind mirrors and
// glass what further rays see. A ray has `depth` more surfaces of mirror or glass to
// meet; when they are used up it sees nothing, which is black.
inline Rgb radiance(const Room& room, const Ray& ray, int depth) {
    return Rgb{0};
}
// [asked]

} // namespace answer
