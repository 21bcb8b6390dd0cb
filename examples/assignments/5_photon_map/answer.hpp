#pragma once

/// \file answer.hpp
/// \brief Assignment 5: yours to write. As it is, it compiles and every test fails.

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
// A lamp sends light from every point of it, along its normal and to all sides.
inline Flight emit(const Room& room, int count, RandomStream& stream) {
    return {};
}

// Follows a photon through a room of diffuse objects. It is stored at each surface
// that it meets, with the flux that arrives there, and goes on or ends by Russian
// roulette.
inline void follow(const Room& room, Flight flight, RandomStream& stream,
                   std::vector<Photon>& stored) {}

// The weight of a photon at a distance d from the middle of a disc with radius r, for
// x = d^2/r^2 in [0, 1]: Epanechnikov's, which falls to 0 at the edge. Its mean over
// the disc is 1.
inline float kernel(float x) {
    return 0;
}

// The radiance that a diffuse surface sends to where the ray comes from, out of the
// photons within a radius. Only photons that came to this side of this surface count:
// those of the other side of a wall, or of a wall beside it, do not.
inline Rgb estimate(const PhotonMap& map, const Surface& surface, const Ray& ray,
                    float radius) {
    return Rgb{0};
}
// [asked]

} // namespace answer
