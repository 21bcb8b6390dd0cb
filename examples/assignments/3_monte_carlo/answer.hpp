#pragma once

/// \file answer.hpp
/// \brief Assignment 3: yours to write. The file compiles, but every test fails.

#include <cmath>
#include <numbers>
#include <vector>

#include "given.hpp"

namespace answer {

// [asked]
// The mean of the samples, and the standard error of that mean.
inline Estimate estimate(const std::vector<double>& samples) {
    return {};
}

// A point of the unit disc, uniform in area, from a point of the unit square.
inline Vec2 sample_disc(Vec2 u) {
    return Vec2{2};
}

// A direction above the horizon (z > 0), uniform in solid angle, and its density.
inline Vec3 sample_uniform(Vec2 u) {
    return Vec3{0};
}
inline float pdf_uniform(const Vec3& direction) {
    return 0;
}

// A direction above the horizon with a density proportional to its cosine z, and that
// density.
inline Vec3 sample_cosine(Vec2 u) {
    return Vec3{0};
}
inline float pdf_cosine(const Vec3& direction) {
    return 0;
}

// A direction within a cone around any axis, uniform in solid angle, and its density,
// which is 0 outside the cone.
inline Vec3 sample_cone(const Cone& cone, Vec2 u) {
    return Vec3{0};
}
inline float pdf_cone(const Cone& cone, const Vec3& direction) {
    return 0;
}

// One sample of the irradiance of the floor under a sky, in three ways: by a uniform
// direction, by a cosine-weighted direction, and by a direction within a cone. The last
// one finds only the light of that cone.
inline double irradiance_uniform(const Sky& sky, Vec2 u) {
    return 0;
}
inline double irradiance_cosine(const Sky& sky, Vec2 u) {
    return 0;
}
inline double irradiance_cone(const Sky& sky, const Cone& cone, Vec2 u) {
    return 0;
}

// The balance heuristic: the weight of a sample that was drawn with density a, and that
// another method would have drawn with density b.
inline double balance(double a, double b) {
    return 0;
}

// One sample of the irradiance by a cosine-weighted direction and one within the cone,
// weighted by the balance heuristic. It finds the light of the whole sky.
inline double irradiance_both(const Sky& sky, const Cone& cone, Vec2 u_cosine,
                              Vec2 u_cone) {
    return 0;
}

// n x n points of the unit square: one random point in each cell of a grid.
inline std::vector<Vec2> stratified(int n, RandomStream& stream) {
    return {};
}

// Russian roulette. The value survives with probability `chance`, if u < chance, and is
// 0 otherwise. The mean does not change.
inline double roulette(double value, double chance, double u) {
    return 0;
}
// [asked]

} // namespace answer
