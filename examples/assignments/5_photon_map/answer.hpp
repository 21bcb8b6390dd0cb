#pragma once

/// \file answer.hpp
/// \brief Assignment 5: yours to write. The file compiles, but every test fails.

#include <numbers>
#include <vector>

#include "course/room.hpp"
#include "given.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d, ljus::next_2d; // uniform in [0, 1)

// [asked]
// One of `count` photons that together carry the flux of all objects with an emission.
// A lamp emits the same radiance from all its points in all directions, on the side of
// its normal.
inline Flight emit(const Room& room, int count, RandomStream& stream) {
    return {};
}

// Follows a photon through a room of diffuse objects. At each surface the photon is
// stored with the flux that arrives there. Russian roulette decides whether it
// continues.
inline void follow(const Room& room, Flight flight, RandomStream& stream,
                   std::vector<Photon>& stored) {}

// Epanechnikov's kernel: the weight of a photon at a distance d from the middle of a
// disc of radius r, for x = d^2/r^2 in [0, 1]. It falls to 0 at the edge, and its mean
// over the disc is 1.
inline float kernel(float x) {
    return 0;
}

// The radiance that a diffuse surface reflects to the origin of the ray, estimated from
// the photons within a radius. Only photons that arrived on this side of this surface
// count, not those on the other side of a wall, or on another wall nearby.
inline Rgb estimate(const PhotonMap& map, const Surface& surface, const Ray& ray,
                    float radius) {
    return Rgb{0};
}
// [asked]

} // namespace answer
