#pragma once

/// \file ljus/materials/compensated_glossy.hpp
/// \brief Rough mirrors with multiple scattering between facets.

#include <algorithm>

#include "ljus/materials/glossy.hpp"
#include "ljus/optics/energy_loss.hpp"

namespace ljus {

/// \defgroup compensated_glossy Energy-preserving gloss
/// \brief Section 3.2.4 of the report, rough mirrors: facets reflect light to each
/// other until it leaves the surface.
/// \{

/// A rough mirror with a second lobe for the light that meets several facets, see
/// \ref multiple_scattering. Programs make it by compensated_glossy(). White facets
/// reflect 0.9996 to 1.00001 of the light of a uniform sky, at any roughness and angle.
/// \tparam Facet  As for GlossyT.
template <std::floating_point T, typename Facet = RgbT<T>>
struct CompensatedGlossyT {
    using Scalar = T;          ///< The precision of its numbers.
    GlossyT<T, Facet> first{}; ///< The lobe of light that meets one facet.
    /// The energy that `first` loses: a table from detail::bake_energy_loss().
    detail::EnergyLossT<T> loss{};
    RgbT<T> mean{T(0)}; ///< Mean reflectance of a facet, from mean_reflectance().
};
/// CompensatedGlossyT in float, with a colour as the reflectance.
using CompensatedGlossy = CompensatedGlossyT<float>;
/// CompensatedGlossyT in float, with the complex index of a metal as the reflectance.
using FullRoughMetal = CompensatedGlossyT<float, ConductorIndexT<float>>;

namespace detail {

/// The mean of the reflectance F of a facet over all angles,
/// \f$ 2 \int_0^1 F(\mu)\,\mu\,d\mu \f$, where mu is the cosine of the angle between
/// the light and the normal of the facet.
template <std::floating_point T, typename Facet>
[[nodiscard]] RgbT<T> mean_reflectance(const Facet& facet) noexcept {
    constexpr int steps = 256; // equal steps of mu^2 have equal weights
    RgbT<T> sum{T(0)};
    for (int i = 0; i < steps; ++i)
        sum += facet_reflectance(facet, std::sqrt((T(i) + T(0.5)) / T(steps)));
    return sum / T(steps);
}

} // namespace detail

/// Adds multiple scattering to the rough mirror `first`. The table `loss` is from
/// detail::bake_energy_loss() or from another material of the same roughness. The scene
/// refuses a table for another roughness.
/// \throws std::invalid_argument  as check(first).
template <std::floating_point T, typename F>
[[nodiscard]] CompensatedGlossyT<T, F>
compensated_glossy(const GlossyT<T, F>& first, const detail::EnergyLossT<T>& loss) {
    check(first);
    return {.first = first,
            .loss = loss,
            .mean = detail::mean_reflectance<T>(first.reflectance)};
}

/// Adds multiple scattering to a rough mirror. With roughness 0 the material scatters
/// like the mirror itself.
/// \throws std::invalid_argument  as check(first).
/// \cost That of detail::bake_energy_loss(): about 20 ms.
template <std::floating_point T, typename F>
[[nodiscard]] CompensatedGlossyT<T, F> compensated_glossy(const GlossyT<T, F>& first) {
    check(first);
    return compensated_glossy(
        first, detail::bake_energy_loss(first.roughness * first.roughness));
}

/// The lobes of this material: those of the rough mirror.
template <std::floating_point T, typename F>
[[nodiscard]] constexpr Lobes lobes(const CompensatedGlossyT<T, F>& gloss) noexcept {
    return lobes(gloss.first);
}

/// The BRDF: the sum of the lobes of one reflection and of multiple scattering.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \cost That of evaluate() of GlossyT, and two calls of detail::lost_at().
/// \cite kulla2017
// [full evaluate]
template <std::floating_point T, typename F>
[[nodiscard]] RgbT<T> evaluate(const CompensatedGlossyT<T, F>& gloss,
                               const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    const detail::EnergyLossT<T>& loss = gloss.loss;
    const RgbT<T> first = evaluate(gloss.first, wo, wi);
    if (!same_side(wo, wi) || !(loss.mean > T(0))) return first;
    const T out = detail::lost_at(loss, std::abs(wo.z)),
            in = detail::lost_at(loss, std::abs(wi.z));
    const T again = out * in / loss.mean * std::numbers::inv_pi_v<T>;
    return first + again * detail::multiple_scattering(gloss.mean, loss.mean);
}
// [full evaluate]

namespace detail {

/// The probability with which sample() chooses the lobe of one reflection: that lobe's
/// fraction of the reflected light.
/// \return In [0, 1]; 1 where nothing is lost.
template <std::floating_point T, typename F>
[[nodiscard]] T first_probability(const CompensatedGlossyT<T, F>& gloss,
                                  const Vec3T<T>& wo) noexcept {
    const T lost = lost_at(gloss.loss, std::abs(wo.z));
    const T first = (T(1) - lost) * max_component(gloss.mean);
    const T again =
        lost * max_component(multiple_scattering(gloss.mean, gloss.loss.mean));
    return again > T(0) ? first / (first + again) : T(1);
}

} // namespace detail

/// The density of sample(), per steradian on the side of `wo`; 0 elsewhere.
template <std::floating_point T, typename F>
[[nodiscard]] T pdf(const CompensatedGlossyT<T, F>& gloss, const Vec3T<T>& wo,
                    const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    const T first = pdf(gloss.first, wo, wi, which);
    const T chance = detail::first_probability(gloss, wo);
    if (!has(which & lobes(gloss), Lobes::glossy) || !same_side(wo, wi) ||
        chance >= T(1))
        return first;
    return chance * first +
           (T(1) - chance) * detail::pdf_lost(gloss.loss, std::abs(wi.z));
}

/// Samples the lobe of one reflection as GlossyT does, or the lobe of multiple
/// scattering. u.z chooses the lobe.
/// \return The sample; nothing in the cases of \ref bsdf, and also if the direction
///         points into the surface.
/// \cost About twice that of sample() of GlossyT.
template <std::floating_point T, typename F>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const CompensatedGlossyT<T, F>& gloss, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    const T chance = detail::first_probability(gloss, wo);
    if (chance >= T(1) || !has(which & lobes(gloss), Lobes::glossy))
        return sample(gloss.first, wo, u, transport, which);
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    Vec3T<T> wi;
    if (u.z < chance) {
        const auto first = sample(gloss.first, wo, u, transport, which);
        if (!first) return std::nullopt;
        wi = first->wi;
    } else {
        const T z = detail::sample_lost(gloss.loss, u.y);
        const T phi = T(2) * std::numbers::pi_v<T> * u.x;
        const T sine = std::sqrt((T(1) - z) * (T(1) + z));
        wi = {sine * std::cos(phi), sine * std::sin(phi), std::copysign(z, wo.z)};
    }
    const T density = pdf(gloss, wo, wi, which);
    if (!(density > T(0))) return std::nullopt;
    const RgbT<T> f = evaluate(gloss, wo, wi);
    return diffuse_sample(wi, f * (std::abs(wi.z) / density), density);
}

/// Requires a valid rough mirror `first`, a mean reflectance within [0, 1], and a table
/// `loss` that was made for the roughness of `first`.
template <std::floating_point T, typename F>
void check(const CompensatedGlossyT<T, F>& gloss) {
    check(gloss.first);
    require_unit("compensated_glossy.mean", gloss.mean);
    const T alpha = gloss.first.roughness * gloss.first.roughness;
    require(gloss.loss.alpha == alpha, "compensated_glossy.loss.alpha",
            gloss.loss.alpha,
            "first.roughness squared: make it with compensated_glossy()");
}

/// \}

} // namespace ljus
