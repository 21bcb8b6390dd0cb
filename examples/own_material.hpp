/// \file own_material.hpp
/// \brief A material of the reader's own: the surface of the full moon.
#pragma once
#include <cmath>
#include <numbers>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sampling.hpp"

/// Code that a reader of the book has written.
namespace reader {
using ljus::Lobes, ljus::Rgb, ljus::Vec3;

/// Minnaert's surface. With k = 1 it is Lambertian; above 1 a ball has a darker rim.
struct Moon {
    using Scalar = float;  ///< The precision of its numbers.
    ljus::Rgb color{0.5f}; ///< Albedo for light along the normal.
    float k = 1.5f;        ///< Exponent, at least 1.
};

/// The lobes of the material: one diffuse lobe.
inline Lobes lobes(const Moon&) {
    return Lobes::diffuse;
}

/// f = color (k + 1)/(2 pi) (cos_i cos_o)^(k-1) in 1/sr, with the cosines of wi and wo.
inline Rgb evaluate(const Moon& m, const Vec3& wo, const Vec3& wi) {
    if (!ljus::same_side(wo, wi)) return Rgb{0};
    const float scale = (m.k + 1) / (2 * std::numbers::pi_v<float>);
    return scale * std::pow(wo.z * wi.z, m.k - 1) * m.color;
}

/// The density of sample(), per steradian: cos_i/pi on the side of `wo`.
inline float pdf(const Moon&, const Vec3& wo, const Vec3& wi,
                 Lobes which = Lobes::all) {
    if (!has(which, Lobes::diffuse) || !ljus::same_side(wo, wi)) return 0;
    return std::abs(wi.z) / std::numbers::pi_v<float>;
}

// [sample]
/// A direction with the density pdf(), and the weight f cos_i/pdf.
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
/// Refuses a material that would create light.
inline void check(const Moon& m) {
    ljus::require_unit("moon.color", m.color);
    ljus::require(m.k >= 1 && m.k <= 100, "moon.k", m.k, "within [1, 100]");
}
static_assert(ljus::Material<Moon>);

} // namespace reader
