#pragma once

/// \file answer.hpp
/// \brief Assignment 8: yours to write. As it is, it compiles and every test fails.

#include <algorithm>
#include <cmath>

#include "given.hpp"
#include "ljus/math/random.hpp"

namespace answer {

// [asked]
// The part of the light that fog lets through on a way of this length.
inline double transmittance(const Fog& fog, double distance) {
    return -1;
}

// How far light flies before the fog scatters or absorbs it, for a number u in [0, 1).
inline double sample_flight(const Fog& fog, double u) {
    return -1;
}

// The density of sample_flight(), per unit of length.
inline double pdf_flight(const Fog& fog, double t) {
    return -1;
}

// The phase function of Henyey and Greenstein, per steradian. The cosine is that of the
// angle by which the light is turned.
inline double phase(double g, double cosine) {
    return -1;
}

// Where light travels after it has been scattered, with the density phase(): a unit
// vector. `travel` is the unit direction in which it came; u and v are in [0, 1).
inline Vec3 sample_phase(double g, const Vec3& travel, double u, double v) {
    return {0, 0, 0};
}

// A distance on the ray, from 0 to `length`, at which the lamp sees equal angles with
// equal probability.
inline double sample_angle(const Ray& ray, double length, const Vec3& lamp, double u) {
    return -1;
}

// The density of sample_angle(), per unit of length.
inline double pdf_angle(const Ray& ray, double length, const Vec3& lamp, double t) {
    return -1;
}

// An estimate of the radiance that comes to the origin of the ray from the fog on its
// first `length`: light of the lamp that was scattered once. It takes one sample of each
// kind, a flight and an angle, and weighs them by the balance heuristic.
inline double scattered_once(const Night& night, const Ray& ray, double length,
                             RandomStream& stream) {
    return -1;
}

// An estimate of the radiance that comes to the origin of the ray, which lies in a ball
// of fog around (0, 0, 0). The light has been scattered any number of times. From
// outside of the ball comes the radiance `around`, whatever the direction.
inline double radiance_in_ball(const Fog& fog, double radius, double around, Ray ray,
                               RandomStream& stream) {
    return -1;
}
// [asked]

} // namespace answer
