#pragma once

/// \file ljus/materials/glossy.hpp
/// \brief Brushed metal, satin, a worn mirror: reflecting microfacets.

#include <limits>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"
#include "ljus/optics/conductor.hpp"
#include "ljus/optics/microfacet.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/schlick.hpp"

namespace ljus {

/// \defgroup glossy Gloss
/// \brief Section 3.2.4 of the report, rough mirrors: one microfacet model, from a
/// mirror to satin.
/// \{

namespace detail {

/// The reflectance of a facet by Schlick's approximation, from its colour at normal
/// incidence.
template <std::floating_point T>
[[nodiscard]] RgbT<T> facet_reflectance(const RgbT<T>& color, T cos_theta) noexcept {
    return {schlick(color.x, cos_theta), schlick(color.y, cos_theta),
            schlick(color.z, cos_theta)};
}

/// The reflectance of a metal facet.
template <std::floating_point T>
[[nodiscard]] RgbT<T> facet_reflectance(const ConductorIndexT<T>& index,
                                        T cos_theta) noexcept {
    return fresnel_conductor(cos_theta, index);
}

/// The smallest roughness that is not 0. Below it, the normals of the facets would vary
/// so little that the rounding of a direction in float matters.
template <std::floating_point T>
inline constexpr T min_roughness = T(0.01);

/// Requires a roughness of 0 or within [min_roughness, 1].
template <std::floating_point T>
void require_facet_roughness(std::string_view what, T roughness) {
    require(roughness == T(0) || (roughness >= min_roughness<T> && roughness <= T(1)),
            what, roughness, "0, which is smooth, or within [0.01, 1]");
}

} // namespace detail

/// A two-sided surface whose facets are small mirrors. Light that hits a second facet
/// is lost. At roughness 1 this is more than half of the light.
/// \tparam Facet  RgbT, the colour at normal incidence, or ConductorIndexT, the complex
///                index of a metal.
template <std::floating_point T, typename Facet = RgbT<T>>
struct GlossyT {
    using Scalar = T;     ///< The precision of its numbers.
    Facet reflectance{};  ///< Reflectance of a facet.
    T roughness = T(0.3); ///< Square root of GGX's alpha; 0 or in [0.01, 1].
};
/// GlossyT in float, with a colour as the reflectance.
using Glossy = GlossyT<float>;
/// GlossyT in float, with the complex index of a metal as the reflectance.
using RoughMetal = GlossyT<float, ConductorIndexT<float>>;

/// The lobes of this material: Lobes::glossy or, if the roughness is 0,
/// Lobes::specular.
template <std::floating_point T, typename F>
[[nodiscard]] constexpr Lobes lobes(const GlossyT<T, F>& gloss) noexcept {
    return gloss.roughness > T(0) ? Lobes::glossy : Lobes::specular;
}

/// The microfacet BRDF of Torrance and Sparrow,
///
/// \f[ f = \frac{F(w_o \cdot h)\, D(h)\, G_2(w_o, w_i)}{4\, w_{o,z}\, w_{i,z}}
///       = \frac{F\, D}{2\,(w_{i,z}\, r(w_o) + w_{o,z}\, r(w_i))} \f]
///
/// where h is the half vector, F the reflectance of a facet, D the density of facet
/// normals from ggx_distribution(), G_2 the fraction of facets visible from both
/// directions, and \f$ r(w)^2 = w_z^2 + \alpha^2 (w_x^2 + w_y^2) \f$ with alpha, the
/// squared roughness.
/// \return f in 1/sr, without the cosine; 0 for directions on different sides, and at
///         grazing angles where f would overflow.
/// \cost Three square roots.
/// \cite walter2007 \cite heitz2014
// [glossy]
template <std::floating_point T, typename F>
[[nodiscard]] RgbT<T> evaluate(const GlossyT<T, F>& gloss, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!(gloss.roughness > T(0)) || !same_side(wo, wi)) return RgbT<T>{T(0)};
    const T alpha = gloss.roughness * gloss.roughness;
    const Vec3T<T> out{wo.x, wo.y, std::abs(wo.z)};
    const Vec3T<T> in{wi.x, wi.y, std::abs(wi.z)};
    const Vec3T<T> h = detail::half_vector(out, in);
    const T cos_facet = std::min(glm::dot(out, h), T(1));
    const T r_out = detail::ggx_lambda(alpha, out),
            r_in = detail::ggx_lambda(alpha, in);
    const T shadowed = out.z * r_in + in.z * r_out;
    const T f = ggx_distribution(alpha, h) / (T(2) * shadowed);
    if (!(f <= std::numeric_limits<T>::max())) return RgbT<T>{T(0)};
    return f * detail::facet_reflectance(gloss.reflectance, cos_facet);
}
// [glossy]

/// The density of sample() \cite heitz2018.
/// \return D/(2 (wo.z + r(wo))) per steradian on the side of `wo`, with D and r as in
///         evaluate(); 0 elsewhere. The integral is below 1, because sample() rejects
///         directions that point into the surface.
template <std::floating_point T, typename F>
[[nodiscard]] T pdf(const GlossyT<T, F>& gloss, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    if (!has(which & lobes(gloss), Lobes::glossy) || !same_side(wo, wi)) return T(0);
    const T alpha = gloss.roughness * gloss.roughness;
    const Vec3T<T> out{wo.x, wo.y, std::abs(wo.z)};
    const Vec3T<T> in{wi.x, wi.y, std::abs(wi.z)};
    return ggx_distribution(alpha, detail::half_vector(out, in)) /
           (T(2) * (out.z + detail::ggx_lambda(alpha, out)));
}

/// Samples a facet that is visible from `wo` \cite heitz2018, and returns the mirror
/// direction about its normal. The weight is the reflectance of the facet times the
/// fraction of light that no other facet blocks.
/// \return The sample; nothing in the cases of \ref bsdf, and also if the direction
///         points into the surface.
/// \cost One sine, one cosine, nine square roots.
template <std::floating_point T, typename F>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const GlossyT<T, F>& gloss, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, lobes(gloss)) || !(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    const Vec3T<T> out{wo.x, wo.y, std::abs(wo.z)};
    if (gloss.roughness == T(0))
        return specular_sample(
            reflect(wo),
            detail::facet_reflectance(gloss.reflectance, std::min(out.z, T(1))));

    const T alpha = gloss.roughness * gloss.roughness;
    const Vec3T<T> h = detail::sample_visible_normal(alpha, out, Vec2T<T>{u.x, u.y});
    Vec3T<T> in = glm::normalize(reflect(-out, h));
    if (!(in.z > T(0))) return std::nullopt; // a second facet blocks this light
    const T r_out = detail::ggx_lambda(alpha, out);
    const T g2_over_g1 =
        (out.z + r_out) / (r_out + out.z / in.z * detail::ggx_lambda(alpha, in));
    const T cos_facet = std::min(glm::dot(out, detail::half_vector(out, in)), T(1));
    in.z = std::copysign(in.z, wo.z);
    const RgbT<T> weight =
        g2_over_g1 * detail::facet_reflectance(gloss.reflectance, cos_facet);
    if (is_black(weight)) return std::nullopt;
    return diffuse_sample(in, weight, pdf(gloss, wo, in));
}

/// Requires a valid reflectance, and a roughness of 0 or within [0.01, 1].
template <std::floating_point T, typename F>
void check(const GlossyT<T, F>& gloss) {
    if constexpr (std::same_as<F, RgbT<T>>)
        require_unit("glossy.reflectance", gloss.reflectance);
    else
        detail::require_conductor("glossy.reflectance", gloss.reflectance);
    detail::require_facet_roughness("glossy.roughness", gloss.roughness);
}

/// \}

} // namespace ljus
