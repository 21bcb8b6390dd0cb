#pragma once

/// \file answer.hpp
/// \brief Assignment 1: yours to write. The file compiles, but every test fails.

#include <cmath>
#include <optional>
#include <vector>

#include "given.hpp"

namespace answer {

// [asked]
// The ray from the eye through a point of the picture, with a direction of length 1.
// `pixel` is measured from the upper left corner: x to the right up to width, y
// downwards up to height.
inline Ray primary_ray(const Eye& eye, Vec2 pixel, int width, int height) {
    return {};
}

// The smallest t within [ray.t_min, ray.t_max] at which the ray meets the ball. The
// direction may have any length.
inline std::optional<float> intersect(const Ray& ray, const Ball& ball) {
    return std::nullopt;
}

// The normal of a ball at one of its points: of length 1, away from the centre.
inline Vec3 normal(const Ball& ball, const Vec3& point) {
    return Vec3{0};
}

// The first ball that the ray meets.
inline std::optional<Hit> nearest(const Ray& ray, const std::vector<Ball>& balls) {
    return std::nullopt;
}

// Whether a point of a surface with this normal sees the lamp: the lamp is on the side
// of the normal, and no ball lies between them. The surface itself must not hide the
// lamp.
inline bool sees(const std::vector<Ball>& balls, const Vec3& point, const Vec3& normal,
                 const Vec3& lamp) {
    return false;
}
// [asked]

} // namespace answer
