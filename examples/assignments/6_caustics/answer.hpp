#pragma once

/// \file answer.hpp
/// \brief Assignment 6: yours to write. The file compiles, but every test fails.

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
// Whether the caustics map carries a path, which is given in Heckbert's letters from
// the lamp to the eye, such as "LSSDE". It does if there is a mirror or glass between
// the lamp and the first diffuse surface, and only mirrors and glass between that
// surface and the eye.
inline bool belongs_to_caustics_map(std::string_view path) {
    return false;
}

// The flux that a lamp sends towards a ball. The lamp is outside the ball.
inline Rgb flux_towards(const PointLamp& lamp, const Sphere& ball) {
    return Rgb{0};
}

// One of `count` photons that a lamp aims at a ball, uniform in solid angle. Each meets
// the ball if nothing lies between, and together they carry flux_towards().
inline Flight aim(const PointLamp& lamp, const Sphere& ball, int count, Vec2 u) {
    return {};
}

// Follows a photon through mirrors and glass, and returns it at the first diffuse
// surface: L S+ D. At glass it is reflected or refracted at random. Returns nothing for
// a photon that meets a diffuse surface first, or meets none, or meets more than 20
// surfaces before it.
inline std::optional<Photon> follow(const Room& room, Flight flight,
                                    RandomStream& stream) {
    return std::nullopt;
}
// [asked]

} // namespace answer
