#pragma once

/// \file ljus/materials/cosine_lobe.hpp
/// \brief Cosine-weighted directions on either side, which sample matt surfaces.

#include "ljus/materials/material.hpp"
#include "ljus/math/sampling.hpp"

namespace ljus {

/// \defgroup cosine_lobe Sampling matt surfaces
/// \brief Section 3.2.4: cosine-weighted sampling, for every f that is almost constant;
/// also for user-defined materials.
/// \{

/// The density of sample_cosine_lobe(), as pdf() of a material.
/// \return |cos(theta)|/pi per steradian on the side of `wo`; 0 elsewhere, and 0
///         without Lobes::diffuse.
/// \report{Section 3.2.4}
template <std::floating_point T>
[[nodiscard]] constexpr T pdf_cosine_lobe(const Vec3T<T>& wo, const Vec3T<T>& wi,
                                          Lobes which) noexcept {
    if (!has(which, Lobes::diffuse) || !same_side(wo, wi)) return T(0);
    return (wi.z < T(0) ? -wi.z : wi.z) * std::numbers::inv_pi_v<T>;
}

/// Samples the density cos/pi on the side of `wo`, as sample() of a material.
/// \param wo      Outgoing direction.
/// \param u       Point of [0,1)^3; z is not used.
/// \param which   The lobes to sample.
/// \param weight  Called with `wi`; returns f cos/pdf, which is pi f.
/// \return The sample; nothing if `wo` lies on the surface or without Lobes::diffuse.
/// \cost One sine, one cosine, one square root, and weight().
/// \report{Section 3.2.4}
template <std::floating_point T, typename Weight>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample_cosine_lobe(const Vec3T<T>& wo, const Vec3T<T>& u, Lobes which,
                   Weight weight) noexcept {
    std::optional<BsdfSampleT<T>> next;
    if (!has(which, Lobes::diffuse) || !(wo.z > T(0) || wo.z < T(0))) return next;
    next.emplace(); // filled in place: avoids a store-forwarding stall
    Vec3T<T>& wi = next->wi;
    wi = sample_cosine_hemisphere(Vec2T<T>{u.x, u.y});
    next->pdf = pdf_cosine_hemisphere(wi);
    wi.z = std::copysign(wi.z, wo.z);
    next->weight = weight(wi);
    return next;
}

/// \}

} // namespace ljus
