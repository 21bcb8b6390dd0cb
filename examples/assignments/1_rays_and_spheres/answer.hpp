#pragma once

/// \file answer.hpp
/// \brief Assignment 1: yours to write. As it is, it compiles and every test fails.

#include <cmath>
#include <optional>
#include <vector>

#include "given.hpp"

namespace answer {

// [asked]
// The ray from the eye through a point of the picture, its direction of length 1.
// `pixel` counts from the upper left corner: x to width, y downwards to height.
inline Ray primary_ray(const Eye& eye, Vec2 pixel, int width, int height) {
    return {};
}

// The smallest t within [ray.t_min, ray.t_max] at which the ray meets the ball. The
// direction may have any length.
inline std::optional<float> intersect(const Ray& ray, const Ball& ball) {
    return std::nullopt;
}

// The normal of a ball at a point of it: length 1, away from the centre.
inline Vec3 normal(const Ball& ball, const Vec3& point) {
    return Vec3{0};
}

// The first of all balls that the ray meets.
inline std::optional<Hit> nearest(const Ray& ray, const std::vector<Ball>& balls) {
    return std::nullopt;
}

// Whether a point of a surface with this normal sees the lamp: the lamp is on the side
// of the normal, and no ball is between. The surface itself must not be in the way.
inline bool sees(const std::vector<Ball>& balls, const Vec3& point, const Vec3& normal,
                 const Vec3& lamp) {
    return false;
}
// [asked]

} // namespace answer
