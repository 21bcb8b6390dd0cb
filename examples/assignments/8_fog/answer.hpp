#pragma once

/// \file answer.hpp
/// \brief Assignment 8: yours to write. The file compiles, but every test fails.

#include <algorithm>
#include <cmath>

#include "given.hpp"
#include "ljus/math/random.hpp"

namespace answer {

// [asked]
// The fraction of the light that passes through this length of fog.
inline double transmittance(const Fog& fog, double distance) {
    return -1;
}

// The distance after which fog scatters or absorbs light, chosen by a number u in [0,
// 1).
inline double sample_flight(const Fog& fog, double u) {
    return -1;
}

// The density of sample_flight(), per unit of length.
inline double pdf_flight(const Fog& fog, double t) {
    return -1;
}

// The phase function of Henyey and Greenstein, per steradian. The cosine is that of the
// angle between the directions of travel before and after.
inline double phase(double g, double cosine) {
    return -1;
}

// The direction of travel after scattering, a unit vector with the density phase().
// `travel` is the unit direction before; u and v are in [0, 1).
inline Vec3 sample_phase(double g, const Vec3& travel, double u, double v) {
    return {0, 0, 0};
}

// A distance on the ray, from 0 to `length`. Its distribution is uniform in the angle
// under which the lamp sees the ray.
inline double sample_angle(const Ray& ray, double length, const Vec3& lamp, double u) {
    return -1;
}

// The density of sample_angle(), per unit of length.
inline double pdf_angle(const Ray& ray, double length, const Vec3& lamp, double t) {
    return -1;
}

// An estimate of the radiance that fog sends to the origin of the ray, from distances
// up to `length`, of light of the lamp that was scattered once. It takes one sample by
// sample_flight() and one by sample_angle(), weighted by the balance heuristic.
inline double scattered_once(const Night& night, const Ray& ray, double length,
                             RandomStream& stream) {
    return -1;
}

// An estimate of the radiance that arrives at the origin of the ray, which lies in a
// ball of fog around (0, 0, 0). The light has been scattered any number of times.
// Outside the ball the radiance is `around` in all directions.
inline double radiance_in_ball(const Fog& fog, double radius, double around, Ray ray,
                               RandomStream& stream) {
    return -1;
}
// [asked]

} // namespace answer
