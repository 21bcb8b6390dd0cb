/// \file own_light.hpp
/// \brief A light of the reader's own: a stage lamp, brightest along its axis.
#pragma once
#include "ljus/lights/light.hpp"

/// Code that a reader of the book has written.
namespace reader {
using ljus::Rgb, ljus::Vec2, ljus::Vec3;
constexpr float two_pi = 2 * std::numbers::pi_v<float>; ///< A hemisphere in sr.

/// A lamp without a size. Its intensity is I cos^n of the angle from its axis.
struct StageLamp {
    using Scalar = float; ///< The precision.
    Vec3 position{0};     ///< Position, in scene units.
    Vec3 axis{0, -1, 0};  ///< Axis of the beam, a unit vector.
    Rgb intensity{1};     ///< The intensity I along the axis, W/sr.
    float exponent = 20;  ///< The exponent n; a large one makes a narrow beam.
};
/// Refuses a lamp with a number out of range.
inline void check(const StageLamp& lamp) {
    ljus::require_finite("stage lamp.position", lamp.position);
    ljus::require(std::abs(glm::length(lamp.axis) - 1) < 1e-4f, "stage lamp.axis",
                  lamp.axis, "of length 1");
    ljus::require_radiance("stage lamp.intensity", lamp.intensity);
    ljus::require(lamp.exponent >= 0 && lamp.exponent <= 1000, "stage lamp.exponent",
                  lamp.exponent, "within [0, 1000]");
}
// [fall-off]
/// The flux of the lamp, W: the intensity integrated, 2 pi I / (n + 1).
inline Rgb power(const StageLamp& lamp) {
    return two_pi / (lamp.exponent + 1) * lamp.intensity;
}
/// The fraction of the flux that goes in a direction, per steradian.
inline float pdf_emission(const StageLamp& lamp, const Vec3&, const Vec3& wo) {
    const float cosine = glm::dot(wo, lamp.axis);
    if (!(cosine > 0)) return 0; // behind the lamp, or NaN
    return (lamp.exponent + 1) / two_pi * std::pow(cosine, lamp.exponent);
}
/// The light that arrives at a point along a shadow ray: intensity / distance^2.
inline std::optional<ljus::LightSampleT<float>>
sample_light(const StageLamp& lamp, const Vec3& from, const Vec2&, float) {
    const Vec3 way = lamp.position - from, wi = glm::normalize(way);
    const Rgb sent = pdf_emission(lamp, lamp.position, -wi) * power(lamp);
    if (ljus::is_black(sent)) return std::nullopt;
    return {{{.position = lamp.position, .normal = -wi}, wi, sent / dot(way, way)}};
}
// [fall-off]
/// The point where a photon starts.
inline Vec3 emission_point(const StageLamp& lamp, const Vec2&, float) {
    return lamp.position;
}
/// The direction of a photon. The number cos^(n + 1) of its angle is uniform.
inline Vec3 sample_emission(const StageLamp& lamp, const Vec3&, const Vec2& u) {
    const float z = std::pow(1 - u.x, 1 / (lamp.exponent + 1));
    const float r = std::sqrt(std::max(0.0f, 1 - z * z)), phi = two_pi * u.y;
    return to_world(ljus::frame_around(lamp.axis),
                    Vec3{r * std::cos(phi), r * std::sin(phi), z});
}
static_assert(ljus::NearLight<StageLamp> && ljus::LightSource<StageLamp>);
} // namespace reader
