#pragma once

/// \file ljus/materials/eon.hpp
/// \brief A rough matt surface that keeps its energy: EON.

#include <algorithm>
#include <cmath>

#include "ljus/materials/detail/eon_lobe.hpp"
#include "ljus/materials/detail/multiple_scattering.hpp"
#include "ljus/materials/rough_diffuse.hpp"

namespace ljus {

/// \defgroup eon Energy-preserving Oren-Nayar
/// \brief Section 3.2.1, 31 years later: \cite eon2025.
///
/// Fujii's second model loses what goes from facet to facet. How much that is at each
/// angle has a closed form; EON gives it back, in proportion to what is lost on the way
/// in and on the way out. A white surface returns exactly all light, at any roughness.
/// \{

/// A matt surface that conserves energy, two-sided.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct EonT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Of a facet, in [0, 1].
    T roughness = T(0.5);   ///< In [0, 1]; 0 is Lambert.
};
using Eon = EonT<float>; ///< EonT in float.

namespace detail {

/// What Fujii's second model loses of light at an angle, over A r:
/// \f$ (1 - E(\mu)) / (A r) = k_1 - G(\mu)/\pi \f$.
/// \param sine    Of the angle to the normal, in [0, 1].
/// \param cosine  In [0, 1].
/// \return At least 0, at most 1/2 - 2/(3 pi).
/// \cite eon2025
// [eon loss]
template <std::floating_point T>
[[nodiscard]] T eon_loss(T sine, T cosine) noexcept {
    const T s = sine, mu = cosine;
    // (1 - s^3)/mu as mu (1 + s + s^2)/(1 + s): grazing angles do not divide by 0.
    const T steep = mu * (T(1) + s + s * s) / (T(1) + s) - T(1);
    const T g = s * (std::atan2(s, mu) - s * mu) + T(2) / T(3) * s * steep;
    return std::max(T(0), fon_constant<T> - g * std::numbers::inv_pi_v<T>);
}
// [eon loss]

/// 1 minus the mean of E, over A r.
template <std::floating_point T>
inline constexpr T eon_mean_loss = fon_constant<T> -
                                   (T(2) / T(3) -
                                    T(28) / T(15) * std::numbers::inv_pi_v<T>);

/// Pi times the BRDF.
///
/// \f[ \pi f = \rho f_F + \rho_m
///     \frac{(1 - E(\mu_i))(1 - E(\mu_o))}{1 - \bar E}, \quad
///     \rho_m = \frac{\rho^2 \bar E}{1 - \rho (1 - \bar E)} \f]
///
/// with f_F Fujii's ratio, E its albedo at an angle, and the mean of E over all. The
/// losses all have the factor A r, which is taken out: nothing is divided by a
/// roughness of 0.
/// \param surface  The surface.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param wi       Unit vector in the surface's frame, to where it comes from, on the
///                 same side.
/// \return At least 0.
/// \cost Two arc tangents, four square roots, eight divisions.
/// \cite eon2025
// [eon]
template <std::floating_point T>
[[nodiscard]] RgbT<T> eon_weight(const EonT<T>& surface, const Vec3T<T>& wo,
                                 const Vec3T<T>& wi) noexcept {
    const T r = surface.roughness;
    const T ar = r / (T(1) + fon_constant<T> * r);
    const auto loss = [](const Vec3T<T>& w) {
        return eon_loss(std::hypot(w.x, w.y), std::abs(w.z));
    };
    const T both = ar * loss(wo) * loss(wi) / eon_mean_loss<T>;
    return surface.albedo * rough_fon(r, wo, wi) +
           both * multiple_scattering(surface.albedo, ar * eon_mean_loss<T>);
}
// [eon]

} // namespace detail

/// The lobes of this material: a diffuse one, even if it is black.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const EonT<T>&) noexcept {
    return Lobes::diffuse;
}

/// The BRDF.
/// \param surface  The surface.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param wi       Unit vector in the surface's frame, to where it comes from.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const EonT<T>& surface, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return std::numbers::inv_pi_v<T> * detail::eon_weight(surface, wo, wi);
}

/// The density of sample().
/// \param surface  The surface.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param wi       Unit vector in the surface's frame, to where it comes from.
/// \param which    The parts to sample from.
/// \return Per steradian on the side of `wo`; 0 elsewhere, and 0 without
///         Lobes::diffuse.
template <std::floating_point T>
[[nodiscard]] T pdf(const EonT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::diffuse) || !same_side(wo, wi)) return T(0);
    return detail::pdf_eon_lobe(detail::eon_lobe(surface.roughness, wo),
                                Vec3T<T>{wi.x, wi.y, std::abs(wi.z)});
}

/// A direction of about the density of f cos.
/// \param surface  The surface.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param u        Point of [0,1)^3; z chooses the lobe or a uniform direction.
/// \param which    The parts to sample from.
/// \return The sample; nothing if `wo` lies on the surface, if the albedo is black, or
///         without Lobes::diffuse.
/// \cost About three times a cosine-weighted direction's; see chapter 14 for what it
///       saves.
/// \cite eon2025
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const EonT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::diffuse) || is_black(surface.albedo)) return std::nullopt;
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    const detail::EonLobeT<T> lobe = detail::eon_lobe(surface.roughness, wo);
    Vec3T<T> wi = detail::sample_eon_lobe(lobe, u);
    if (!(wi.z > T(0))) return std::nullopt; // on the horizon, by rounding
    const T density = detail::pdf_eon_lobe(lobe, wi);
    wi.z = std::copysign(wi.z, wo.z);
    const RgbT<T> f_cos = std::numbers::inv_pi_v<T> * std::abs(wi.z) *
                          detail::eon_weight(surface, wo, wi);
    return diffuse_sample(wi, f_cos / density, density);
}

/// Refuses an albedo or a roughness outside [0, 1].
/// \param surface  The surface.
/// \throws std::invalid_argument naming the member.
template <std::floating_point T>
void check(const EonT<T>& surface) {
    require_unit("eon.albedo", surface.albedo);
    require_unit("eon.roughness", surface.roughness);
}

/// \}

} // namespace ljus
