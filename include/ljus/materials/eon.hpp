#pragma once

/// \file ljus/materials/eon.hpp
/// \brief A rough matt surface that conserves energy: EON.

#include <algorithm>
#include <cmath>

#include "ljus/materials/rough_diffuse.hpp"
#include "ljus/math/sampling.hpp"
#include "ljus/optics/energy_loss.hpp"

namespace ljus {

/// \defgroup eon Energy-preserving Oren-Nayar
/// \brief Section 3.2.1 of the report: EON, a model that conserves energy
/// \cite eon2025.
///
/// Fujii's second model, RoughModel::fon, loses the light that facets send to each
/// other. EON adds this light to the BRDF by a closed form; see
/// \ref multiple_scattering. A white surface reflects all light, at any roughness.
/// \{

/// A two-sided matt surface that conserves energy.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct EonT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Albedo of a facet, in [0, 1].
    T roughness = T(0.5);   ///< The roughness in [0, 1]; 0 is a Lambertian surface.
};
using Eon = EonT<float>; ///< EonT in float.

namespace detail {

/// The fraction of light that a white surface loses in Fujii's second model, divided by
/// A r, where r is the roughness, A is 1/(1 + k_1 r), and k_1 is fon_constant
/// \cite eon2025. With the reflected fraction E, the result is
/// \f$ (1 - E(\mu)) / (A r) \f$.
/// \param s, mu  Sine and cosine of the angle between the direction and the normal.
/// \return At least 0, at most k_1.
// [eon loss]
template <std::floating_point T>
[[nodiscard]] T eon_loss(T s, T mu) noexcept {
    // (1 - s^3)/mu is mu (1 + s + s^2)/(1 + s), which avoids 0/0 at grazing angles.
    const T steep = mu * (T(1) + s + s * s) / (T(1) + s) - T(1);
    const T g = s * (std::atan2(s, mu) - s * mu) + T(2) / T(3) * s * steep;
    return std::max(T(0), fon_constant<T> - g * std::numbers::inv_pi_v<T>);
}
// [eon loss]

/// The cosine-weighted mean of eon_loss() over the hemisphere.
template <std::floating_point T>
inline constexpr T eon_mean_loss = fon_constant<T> -
                                   (T(2) / T(3) -
                                    T(28) / T(15) * std::numbers::inv_pi_v<T>);

/// Pi times the BRDF: Fujii's second model plus a term for the light that this model
/// loses, see \ref multiple_scattering. The factor A r of eon_loss() cancels, so that a
/// roughness of 0 needs no special case.
/// \param wo, wi  Unit vectors on the same side.
/// \return At least 0.
/// \cost Two arc tangents, two square roots, nine divisions.
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

/// A cosine lobe that is sheared towards the outgoing direction wo and cut at the
/// horizon. The matrix M with rows (a, 0, b), (0, c, 0), (d, 0, 1) maps cosine-weighted
/// directions to directions whose density is nearly proportional to the BRDF times the
/// cosine. The x axis points along the azimuth of wo. The entries are the fits of
/// listing 2 in \cite eon2025.
template <std::floating_point T>
struct EonLobeT {
    T a, b, c, d;   ///< The entries of M; d is at most 0.
    T kept;         ///< The fraction of the lobe above the horizon.
    T uniform;      ///< The probability of a uniform direction instead of the lobe.
    Vec2T<T> along; ///< The azimuth of wo; unit vector.
};

template <std::floating_point T>
[[nodiscard]] EonLobeT<T> eon_lobe(T roughness, const Vec3T<T>& wo) noexcept {
    const T r = roughness, mu = std::abs(wo.z);
    EonLobeT<T> lobe;
    lobe.a = T(1) + r * (T(0.303392) + mu * (T(-0.518982) + T(0.111709) * mu) +
                         r * (T(-0.276266) + T(0.335918) * mu));
    lobe.b = r *
             (T(-1.16407) + T(1.15859) * mu + r * (T(0.150815) - T(0.150105) * mu)) /
             (mu * mu * mu - T(1.43545));
    lobe.c = T(1) + r * (T(0.20013) + mu * (T(-0.506373) + T(0.261777) * mu));
    lobe.d = r * (T(0.540852) + mu * (T(-1.01625) + T(0.475392) * mu)) /
             (T(-1.0743) + mu * (T(0.0725628) + mu));
    lobe.d = std::min(lobe.d, T(0)); // the fit is slightly above 0 at normal incidence
    lobe.kept = (T(1) + T(1) / std::sqrt(lobe.d * lobe.d + T(1))) / T(2);
    lobe.uniform =
        std::pow(r, T(0.1)) *
        (T(0.162925) + mu * (T(-0.372058) + mu * (T(0.538233) - T(0.290822) * mu)));
    const T sine = std::hypot(wo.x, wo.y);
    lobe.along =
        sine > T(0) ? Vec2T<T>{wo.x / sine, wo.y / sine} : Vec2T<T>{T(1), T(0)};
    return lobe;
}

/// The density of sample_eon_lobe() for a direction above the horizon, per steradian.
/// It is above 0.
template <std::floating_point T>
[[nodiscard]] T pdf_eon_lobe(const EonLobeT<T>& lobe, const Vec3T<T>& wi) noexcept {
    const T x = lobe.along.x * wi.x + lobe.along.y * wi.y;
    const T y = lobe.along.x * wi.y - lobe.along.y * wi.x;
    // v is the inverse of M times wi, times the determinant of M.
    const T minor = lobe.a - lobe.b * lobe.d;
    const T determinant = lobe.c * minor;
    const Vec3T<T> v{lobe.c * (x - lobe.b * wi.z), minor * y,
                     lobe.c * (lobe.a * wi.z - lobe.d * x)};
    const T square = glm::dot(v, v);
    // The cosine lobe at v, times the change of solid angle, determinant^2/|v|^3.
    const T jacobian = determinant / square;
    const T bent = std::max(T(0), v.z) * jacobian * jacobian *
                   std::numbers::inv_pi_v<T> / lobe.kept;
    const T even = std::numbers::inv_pi_v<T> / T(2);
    return lobe.uniform * even + (T(1) - lobe.uniform) * bent;
}

/// Samples a direction with the density pdf_eon_lobe() \cite eon2025. u.z chooses
/// between the lobe and a uniform direction.
/// \return A unit vector above the horizon or, by rounding, on the horizon.
// [eon lobe sample]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_eon_lobe(const EonLobeT<T>& lobe,
                                       const Vec3T<T>& u) noexcept {
    if (u.z < lobe.uniform) return sample_uniform_hemisphere(Vec2T<T>{u.x, u.y});

    // Seen from above, directions fill the unit disc. Those that M maps above the
    // horizon fill half of the disc and half of an ellipse. Each chord along x is
    // shrunk to this region.
    const Vec3T<T> h = sample_cosine_hemisphere(Vec2T<T>{u.x, u.y});
    const T half_chord = std::sqrt(std::max(T(0), (T(1) - h.y) * (T(1) + h.y)));
    const T x = lobe.kept * h.x - (T(1) - lobe.kept) * half_chord;
    const T z = std::sqrt(std::max(T(0), half_chord * half_chord - x * x));
    const Vec3T<T> bent{lobe.a * x + lobe.b * z, lobe.c * h.y, lobe.d * x + z};
    const Vec3T<T> unit = glm::normalize(bent);
    return {lobe.along.x * unit.x - lobe.along.y * unit.y,
            lobe.along.y * unit.x + lobe.along.x * unit.y, unit.z};
}
// [eon lobe sample]

} // namespace detail

/// The lobes of this material: Lobes::diffuse, even for a black surface.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const EonT<T>&) noexcept {
    return Lobes::diffuse;
}

/// The BRDF, in 1/sr, without the cosine; 0 if the directions lie on different sides.
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const EonT<T>& surface, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return std::numbers::inv_pi_v<T> * detail::eon_weight(surface, wo, wi);
}

/// The density of sample(), per steradian on the side of `wo`; 0 elsewhere.
template <std::floating_point T>
[[nodiscard]] T pdf(const EonT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::diffuse) || !same_side(wo, wi)) return T(0);
    return detail::pdf_eon_lobe(detail::eon_lobe(surface.roughness, wo),
                                Vec3T<T>{wi.x, wi.y, std::abs(wi.z)});
}

/// Samples a direction with a density nearly proportional to the BRDF times the cosine
/// \cite eon2025.
/// \cost Eight to ten times that of Lambert's sample().
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

/// Requires an albedo and a roughness within [0, 1].
template <std::floating_point T>
void check(const EonT<T>& surface) {
    require_unit("eon.albedo", surface.albedo);
    require_unit("eon.roughness", surface.roughness);
}

/// \}

} // namespace ljus
