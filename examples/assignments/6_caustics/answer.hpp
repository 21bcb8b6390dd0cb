#pragma once

/// \file answer.hpp
/// \brief Assignment 6: yours to write. As it is, it compiles and every test fails.

#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "course/room.hpp"
#include "given.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d; // uniform in [0, 1)

// [asked]
// Who carries a path from a lamp to the eye, in Heckbert's letters from the lamp on,
// as "LSSDE"? True for those of the caustics map: glass and mirrors between the lamp
// and the first diffuse surface, and none but glass and mirrors between that one and
// the eye.
inline bool belongs_to_caustics_map(std::string_view path) {
    return false;
}

// The flux of a lamp that flies towards a ball, which does not hold the lamp.
inline Rgb flux_towards(const PointLamp& lamp, const Sphere& ball) {
    return Rgb{0};
}

// One of `count` photons that a lamp aims at a ball: each meets the ball if nothing is
// between, and together they carry flux_towards(). Even in solid angle.
inline Flight aim(const PointLamp& lamp, const Sphere& ball, int count, Vec2 u) {
    return {};
}

// Follows a photon through mirrors and glass to the first diffuse surface, by chance
// one way at each boundary of glass, and returns it where it arrives: L S+ D. Nothing
// for a photon that meets a diffuse surface at once, or none, or more than 20 others
// before.
inline std::optional<Photon> follow(const Room& room, Flight flight,
                                    RandomStream& stream) {
    return std::nullopt;
}
// [asked]

} // namespace answer
