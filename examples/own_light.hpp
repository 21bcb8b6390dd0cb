/// \file own_light.hpp
/// \brief A light of the reader's own: a torch, as a shop describes it.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/scene/make_light.hpp"

/// What a reader has written.
namespace reader {

/// A lamp that lights a round patch evenly.
struct Torch {
    ljus::Vec3 position{0};      ///< In scene units.
    ljus::Vec3 target{0, 0, -1}; ///< What it points at.
    float watts = 10;            ///< Of light, in all directions together.
    float beam_degrees = 40;     ///< From one edge of the patch to the other.
};

/// Refuses a torch that no picture can be made with.
inline void check(const Torch& torch) {
    ljus::require_positive("torch.watts", torch.watts);
    ljus::require(torch.beam_degrees > 0 && torch.beam_degrees < 180,
                  "torch.beam_degrees", torch.beam_degrees, "within (0, 180)");
}

// [make_light]
/// A spot light of a known kind: its watts over the solid angle 2 pi (1 - cos) of the
/// beam are its intensity.
inline ljus::Light make_light(const Torch& torch) {
    const float half = torch.beam_degrees / 2;
    const float sine = std::sin(half * std::numbers::pi_v<float> / 360);
    const float solid_angle = 4 * std::numbers::pi_v<float> * sine * sine;
    return ljus::make_light(
        ljus::SpotLight{.position = torch.position,
                        .direction = torch.target - torch.position,
                        .intensity = ljus::Rgb{torch.watts / solid_angle},
                        .inner_degrees = half,
                        .outer_degrees = half});
}
// [make_light]

} // namespace reader
