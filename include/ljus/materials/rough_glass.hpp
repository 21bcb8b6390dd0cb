#pragma once

/// \file ljus/materials/rough_glass.hpp
/// \brief Frosted glass: a transparent body whose surface consists of microfacets.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/optics/microfacet.hpp"

namespace ljus {

/// \defgroup rough_glass Rough glass
/// \brief Beyond the report: microfacets that reflect and refract. Chapter:
/// \ref ch_rough_glass.
///
/// Each facet is a smooth boundary \cite walter2007. The facet that reflects or
/// refracts light from w_i into w_o has the normal
///
/// \f[ h = \pm\frac{\eta\, w_o + w_i}{L}, \qquad L = |\eta\, w_o + w_i| \f]
///
/// where \f$ \eta = n_o/n_i \f$ is the ratio of the indices on the sides of w_o and of
/// w_i. For a reflection the ratio is 1.
///
/// The lobe has a density, so that rough glass counts as D in Heckbert's notation.
/// Rough glass blocks shadow rays. From a vertex on it, shadow rays are cast to both
/// sides of the surface.
/// \{

/// The rough boundary between a transparent body and air. The side z > 0 is air, with
/// index 1. Light that meets a second facet is lost. For index 1.5 and light along the
/// normal, the lost fraction is 0.1 % from outside and 1 % from inside at roughness
/// 0.3. At roughness 0.7 it is 3 % and 24 %; at roughness 1 it is 11 % and 58 %.
/// \cite walter2007
template <std::floating_point T>
struct RoughGlassT {
    using Scalar = T;         ///< The precision of its numbers.
    T index = T(1.5);         ///< Index of refraction inside.
    T roughness = T(0.3);     ///< Square root of GGX's alpha; 0 or in [0.01, 1].
    RgbT<T> absorption{T(0)}; ///< Absorption inside, per scene unit; at least 0.
};
using RoughGlass = RoughGlassT<float>; ///< RoughGlassT in float.

namespace detail {

/// Whether the facets spread refracted light by more than 2e-5 radians. The spread is
/// about alpha |n - 1|, where n is the index. A smaller spread would vanish in the
/// rounding of a direction in float.
template <std::floating_point T>
[[nodiscard]] bool is_rough(const RoughGlassT<T>& glass) noexcept {
    return glass.roughness * glass.roughness * std::abs(glass.index - T(1)) > T(2e-5);
}

template <std::floating_point T>
[[nodiscard]] GlassT<T> smooth(const RoughGlassT<T>& glass) noexcept {
    return {.index = glass.index, .absorption = glass.absorption};
}

/// The direction `w` in a frame whose z axis points to the side of `wo`.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> turned_to(const Vec3T<T>& wo, const Vec3T<T>& w) noexcept {
    return {w.x, w.y, wo.z < T(0) ? -w.z : w.z};
}

/// The density with which sample() chooses the incident direction `in`. It is the
/// density of the facet h among the facets visible from `out`, times the probability of
/// reflection or of refraction, times the Jacobian from facets to directions. With L of
/// \ref rough_glass, the Jacobian is |h.in|/L^2 for refraction and 1/(4 h.out) for
/// reflection.
/// \param alpha    The parameter of GGX.
/// \param out, in  Outgoing and incident direction, with out.z > 0; see turned_to().
/// \param n        Indices on the side of `out` and beyond.
/// \return Per steradian; 0 if no visible facet turns `in` into `out`.
// [joined]
template <std::floating_point T>
[[nodiscard]] T density_of_joined(T alpha, const Vec3T<T>& out, const Vec3T<T>& in,
                                  const SidesT<T>& n) noexcept {
    const T visible = T(2) / (out.z + ggx_lambda(alpha, out)); // G1 / out.z
    if (in.z > T(0)) {
        const Vec3T<T> h = half_vector(out, in);
        const T f = fresnel(std::min(glm::dot(out, h), T(1)), n.here, n.beyond);
        return visible * ggx_distribution(alpha, h) * f / T(4);
    }
    const T eta = n.here / n.beyond;
    const Vec3T<T> sum = eta * out + in;
    const T length = glm::length(sum);
    const Vec3T<T> h = sum / (eta > T(1) ? length : -length);
    const T cos_out = glm::dot(out, h), cos_in = glm::dot(in, h);
    if (!(h.z > T(0) && cos_out > T(0) && cos_in < T(0))) return T(0);
    const T through = T(1) - fresnel(std::min(cos_out, T(1)), n.here, n.beyond);
    return visible * cos_out * ggx_distribution(alpha, h) * through * -cos_in /
           (length * length);
}
// [joined]

/// The fraction of the light along `in` that no facet blocks, divided by |in.z|. With
/// G1 and G2 of \ref microfacet, the fraction is G2/G1(out) for reflection, as for
/// GlossyT. For refraction it is G1(in), because heights on the two sides are taken as
/// independent \cite walter2007.
template <std::floating_point T>
[[nodiscard]] T unblocked(T alpha, const Vec3T<T>& out, const Vec3T<T>& in) noexcept {
    const T r_in = ggx_lambda(alpha, in);
    if (in.z < T(0)) return T(2) / (r_in - in.z);
    const T r_out = ggx_lambda(alpha, out);
    return (out.z + r_out) / (in.z * r_out + out.z * r_in);
}

} // namespace detail

/// The lobes of this material: Lobes::glossy, or Lobes::specular if the boundary is
/// smooth.
template <std::floating_point T>
[[nodiscard]] Lobes lobes(const RoughGlassT<T>& glass) noexcept {
    return detail::is_rough(glass) ? Lobes::glossy : Lobes::specular;
}

/// The density of sample().
/// \return Per steradian, on both sides of the surface. The integral is below 1,
///         because sample() rejects reflected directions that leave the side of wo and
///         refracted directions that stay on it.
/// \cite walter2007 \cite heitz2018
template <std::floating_point T>
[[nodiscard]] T pdf(const RoughGlassT<T>& glass, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    if (!has(which & lobes(glass), Lobes::glossy)) return T(0);
    if (wo.z == T(0) || wi.z == T(0)) return T(0);
    return detail::density_of_joined(
        glass.roughness * glass.roughness, detail::turned_to(wo, wo),
        detail::turned_to(wo, wi), detail::sides(glass, wo));
}

/// The BSDF for radiance. For reflection it is the BRDF of GlossyT with Fresnel's
/// reflectance F. For refraction it is
///
/// \f[ f = \frac{|w_o \cdot h|\,|w_i \cdot h|}{|w_{o,z}|\,|w_{i,z}|}\,
///         \frac{\eta^2 (1 - F)\, D(h)\, G_1(w_o)\, G_1(w_i)}{L^2} \f]
///
/// with h, L and eta of \ref rough_glass, and with D and G_1 of \ref microfacet.
/// Refraction is not symmetric in the two directions:
/// \f$ f(w_o, w_i)/n_o^2 = f(w_i, w_o)/n_i^2 \f$.
/// \return f in 1/sr, without the cosine; 0 at grazing angles where f would overflow.
/// \cost Four square roots for refraction, five for reflection.
/// \cite walter2007
// [rough glass]
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const RoughGlassT<T>& glass, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    const T density = pdf(glass, wo, wi);
    if (!(density > T(0))) return RgbT<T>{T(0)};
    const Vec3T<T> out = detail::turned_to(wo, wo), in = detail::turned_to(wo, wi);
    T f = density * detail::unblocked(glass.roughness * glass.roughness, out, in);
    if (in.z < T(0)) {
        const auto [here, beyond] = detail::sides(glass, wo);
        f *= (here / beyond) * (here / beyond);
    }
    return RgbT<T>{f <= std::numeric_limits<T>::max() ? f : T(0)};
}
// [rough glass]

/// Chooses a facet that is visible from `wo` \cite heitz2018, then reflection with
/// probability F, Fresnel's reflectance of the facet, and otherwise refraction. The
/// weight is the fraction of light that no other facet blocks, at most 1. For refracted
/// radiance it is multiplied by eta^2, with the eta of \ref rough_glass.
/// \return The sample; nothing in the cases of \ref bsdf, and also if a reflected
///         direction leaves the side of wo or a refracted direction stays on it.
/// \cost One sine, one cosine, ten square roots.
// [sample rough glass]
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const RoughGlassT<T>& glass, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    if (!detail::is_rough(glass))
        return sample(detail::smooth(glass), wo, u, transport, which);
    if (!has(which, Lobes::glossy) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    const T alpha = glass.roughness * glass.roughness;
    const Vec3T<T> out = detail::turned_to(wo, wo);
    const auto [here, beyond] = detail::sides(glass, wo);
    const T eta = here / beyond;
    const Vec3T<T> h = detail::sample_visible_normal(alpha, out, Vec2T<T>{u.x, u.y});
    const T cos_facet = std::clamp(glm::dot(out, h), T(0), T(1));
    const bool reflected = u.z < fresnel(cos_facet, here, beyond);
    const std::optional<Vec3T<T>> in =
        reflected ? glm::normalize(reflect(-out, h)) : ljus::refract(-out, h, eta);
    if (!in || !(reflected ? in->z > T(0) : in->z < T(0))) return std::nullopt;

    const Vec3T<T> wi = detail::turned_to(wo, *in);
    const T density = pdf(glass, wo, wi);
    if (!(density > T(0))) return std::nullopt;
    const T scale = !reflected && transport == Transport::radiance ? eta * eta : T(1);
    const T weight = detail::unblocked(alpha, out, *in) * std::abs(in->z) * scale;
    auto next = diffuse_sample(wi, RgbT<T>{weight}, density);
    next.eta_scale = scale;
    return next;
}
// [sample rough glass]

/// The reflected and the refracted sample of a smooth boundary, as for GlassT.
/// \return Nothing if the boundary is rough.
template <std::floating_point T>
[[nodiscard]] std::optional<std::array<BsdfSampleT<T>, 2>>
split(const RoughGlassT<T>& glass, const Vec3T<T>& wo, Transport transport) noexcept {
    if (detail::is_rough(glass)) return std::nullopt;
    return split(detail::smooth(glass), wo, transport);
}

/// The index of refraction inside.
template <std::floating_point T>
[[nodiscard]] constexpr T refractive_index(const RoughGlassT<T>& glass) noexcept {
    return glass.index;
}

/// The absorption coefficient inside, per scene unit; see transmittance().
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> absorption(const RoughGlassT<T>& glass) noexcept {
    return glass.absorption;
}

/// Requires a valid index, a finite absorption of at least 0, and a roughness of 0 or
/// within [0.01, 1].
template <std::floating_point T>
void check(const RoughGlassT<T>& glass) {
    detail::require_index("rough_glass.index", glass.index);
    require_radiance("rough_glass.absorption", glass.absorption);
    detail::require_facet_roughness("rough_glass.roughness", glass.roughness);
}

/// \}

} // namespace ljus
