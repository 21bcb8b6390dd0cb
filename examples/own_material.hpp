/// \file own_material.hpp
/// \brief A material of the reader's own: the full moon's.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sampling.hpp"

/// What a reader has written.
namespace reader {
using ljus::Lobes, ljus::Rgb, ljus::Vec3;

/// Minnaert's surface: darker towards its rim, the more so the larger k; 1 is Lambert.
struct Moon {
    using Scalar = float;  ///< The precision of its numbers.
    ljus::Rgb color{0.5f}; ///< Share that comes back along the normal.
    float k = 1.5f;        ///< At least 1.
};

/// What there is: a diffuse part.
inline Lobes lobes(const Moon&) {
    return Lobes::diffuse;
}

/// f = color (k + 1)/(2 pi) (cos_i cos_o)^(k-1), in 1/sr.
inline Rgb evaluate(const Moon& m, const Vec3& wo, const Vec3& wi) {
    if (!ljus::same_side(wo, wi)) return Rgb{0};
    const float scale = (m.k + 1) / (2 * std::numbers::pi_v<float>);
    return scale * std::pow(wo.z * wi.z, m.k - 1) * m.color;
}

/// The density of sample(): the cosine over pi, on wo's side.
inline float pdf(const Moon&, const Vec3& wo, const Vec3& wi,
                 Lobes which = Lobes::all) {
    if (!has(which, Lobes::diffuse) || !ljus::same_side(wo, wi)) return 0;
    return std::abs(wi.z) / std::numbers::pi_v<float>;
}

// [sample]
/// A direction with that density, and the weight f cos/pdf.
inline std::optional<ljus::BsdfSample> sample(const Moon& m, const Vec3& wo,
                                              const Vec3& u, ljus::Transport,
                                              Lobes which = Lobes::all) {
    if (!has(which, Lobes::diffuse) || wo.z == 0) return std::nullopt;
    Vec3 wi = ljus::sample_cosine_hemisphere(ljus::Vec2{u.x, u.y});
    wi.z = std::copysign(wi.z, wo.z);
    const Rgb weight = evaluate(m, wo, wi) * std::numbers::pi_v<float>;
    return ljus::diffuse_sample(wi, weight, pdf(m, wo, wi));
}
// [sample]
/// Refuses what would make light.
inline void check(const Moon& m) {
    ljus::require_unit("moon.color", m.color);
    ljus::require(m.k >= 1 && m.k <= 100, "moon.k", m.k, "within [1, 100]");
}
static_assert(ljus::Material<Moon>);

} // namespace reader
