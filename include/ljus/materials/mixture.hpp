#pragma once

/// \file ljus/materials/mixture.hpp
/// \brief The report's material: one set of sliders, and no more light out than in.

#include <numbers>

#include "ljus/materials/oren_nayar.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace ljus {

/// \defgroup mixture The report's sliders
/// \brief Section 3.2.1: all that a material of the report can be told.
///
/// Light that arrives is shared out once, from the top:
///
/// | share                       | goes to                                          |
/// |-----------------------------|--------------------------------------------------|
/// | r = reflectivity            | a mirror, untinted                               |
/// | (1 - r) F                   | the boundary's reflection                        |
/// | (1 - r)(1 - F) transparency | refraction; inside, Beer's law absorbs           |
/// | the rest                    | the matt body below; 1 - F of it finds a way out |
///
/// with F = specularity times fresnel(), at the angle of the light.
///
/// \erratum{In the program reflectivity and transparency do not know of each other: its
/// thin glass, with 0.6 and 1, returns up to 1.6 times the light.}
/// \{

/// A material of the report.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct MixtureT {
    using Scalar = T;         ///< The precision of its numbers.
    RgbT<T> color{T(0.5)};    ///< Of the matt part and of the emission, in [0, 1].
    T reflectivity = T(0);    ///< Share of a perfect mirror, in [0, 1].
    T transparency = T(0);    ///< Share of what enters that goes through, in [0, 1].
    T index = T(1.5);         ///< Index of refraction inside.
    T specularity = T(0);     ///< How much of Fresnel's reflection there is, in [0, 1].
    T emissivity = T(0);      ///< Emitted radiance is emissivity times color, >= 0.
    T sigma = T(0);           ///< Roughness of the matt part, radians; 0: Lambert.
    RgbT<T> absorption{T(0)}; ///< Inside, per scene unit, >= 0.
};
using Mixture = MixtureT<float>; ///< MixtureT in float.

/// The lobes of this material: a specular one if anything is mirrored, reflected or
/// refracted; a diffuse one if the matt part is not black, or if there is nothing else.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const MixtureT<T>& mixture) noexcept {
    const bool boundary =
        mixture.specularity > T(0) && (mixture.index < T(1) || mixture.index > T(1));
    const bool specular =
        mixture.reflectivity > T(0) || mixture.transparency > T(0) || boundary;
    const bool matt = mixture.reflectivity < T(1) && mixture.transparency < T(1) &&
                      !is_black(mixture.color);
    if (!specular) return Lobes::diffuse;
    return matt ? Lobes::diffuse | Lobes::specular : Lobes::specular;
}

namespace detail {

/// F: what the boundary reflects of light that travels along a direction.
/// \param mixture  The material. If it is opaque both of its sides are outside.
/// \param w        Unit vector; z < 0 is inside a transparent body.
/// \return specularity times fresnel(), and 1 where nothing can be refracted.
template <std::floating_point T>
[[nodiscard]] T boundary_share(const MixtureT<T>& mixture, const Vec3T<T>& w) noexcept {
    const bool transparent = mixture.transparency > T(0);
    if (mixture.specularity == T(0) && !transparent) return T(0);
    const bool inside = transparent && w.z < T(0);
    const T f = inside ? fresnel(-w.z, mixture.index, T(1))
                       : fresnel(std::abs(w.z), T(1), mixture.index);
    return transparent && f >= T(1) ? T(1) : mixture.specularity * f;
}

/// How much of the light goes where; what is missing from a sum of 1 is absorbed.
template <std::floating_point T>
struct MixtureSharesT {
    T diffuse; ///< To the matt part, times its brightest channel.
    T refract; ///< Through the boundary.
    T reflect; ///< To the mirror and to the boundary's reflection: one direction.
    /// The sum of the three.
    [[nodiscard]] constexpr T sum() const noexcept {
        return diffuse + refract + reflect;
    }
};

/// The shares by which sample() chooses.
/// \param mixture  The material.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param which    The parts that count; the others get 0.
template <std::floating_point T>
[[nodiscard]] MixtureSharesT<T>
mixture_shares(const MixtureT<T>& mixture, const Vec3T<T>& wo, Lobes which) noexcept {
    const T entering =
        (T(1) - mixture.reflectivity) * (T(1) - boundary_share(mixture, wo));
    const T specular = has(which, Lobes::specular) ? T(1) : T(0);
    const T diffuse = has(which, Lobes::diffuse) ? max_component(mixture.color) : T(0);
    return {.diffuse = diffuse * entering * (T(1) - mixture.transparency),
            .refract = specular * entering * mixture.transparency,
            .reflect = specular * (T(1) - entering)};
}

} // namespace detail

/// The matt part's f: light passes the boundary twice, so that 1 - F stands there
/// twice, and the roles of the directions can be exchanged.
/// \param mixture  The material.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param wi       Unit vector in the surface's frame, to where it comes from.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \report{Section 3.2.1}
// [mixture]
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const MixtureT<T>& mixture, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    const T ratio = detail::oren_nayar_ratio(mixture.sigma, wo, wi);
    const RgbT<T> body = mixture.color * (std::numbers::inv_pi_v<T> * ratio);
    const T out = T(1) - detail::boundary_share(mixture, wo);
    const T in = T(1) - detail::boundary_share(mixture, wi);
    const T clear = mixture.transparency;
    return body * ((T(1) - mixture.reflectivity) * (T(1) - clear) * out * in);
}
// [mixture]

/// The density of sample().
/// \param mixture  The material.
/// \param wo       Unit vector in the surface's frame, to where the light goes.
/// \param wi       Unit vector in the surface's frame, to where it comes from.
/// \param which    The parts to sample from.
/// \return |cos(theta)|/pi per steradian times the probability that the matt part is
///         chosen, on the side of `wo`; 0 elsewhere.
template <std::floating_point T>
[[nodiscard]] T pdf(const MixtureT<T>& mixture, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    const auto share = detail::mixture_shares(mixture, wo, which);
    if (!(share.diffuse > T(0))) return T(0);
    return share.diffuse / share.sum() * pdf_cosine_lobe(wo, wi, Lobes::diffuse);
}

/// One direction: u.z chooses a part with a probability proportional to the light that
/// it carries. Its weight is then the sum of the shares, for the matt part times the
/// colour over its brightest channel, 1 - F on the way out, and Oren and Nayar's ratio.
/// \param mixture    The material.
/// \param wo         Unit vector in the surface's frame, to where the light goes; z < 0
///                   is inside a transparent body.
/// \param u          Point of [0,1)^3; z chooses the part.
/// \param transport  Radiance from index n_t is scaled by (n_i/n_t)^2; flux is not.
/// \param which      The parts to sample from.
/// \return The sample, of a pdf above 0 unless it is specular; nothing if `wo` lies on
///         the surface or all shares are 0.
/// \cost Fresnel once for `wo`, and for the matt part once for `wi`.
/// \report{Sections 3.2.1, 3.2.4 and 3.2.5}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const MixtureT<T>& mixture, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    const auto share = detail::mixture_shares(mixture, wo, which);
    const T sum = share.sum();
    if (!(sum > T(0))) return std::nullopt;
    const T choice = u.z * sum;

    if (choice < share.diffuse) {
        auto matt = sample_cosine_lobe(wo, u, Lobes::diffuse);
        if (!matt) return matt;
        const RgbT<T> tint = mixture.color / max_component(mixture.color);
        const T ratio = detail::oren_nayar_ratio(mixture.sigma, wo, matt->wi);
        matt->weight =
            tint * (sum * ratio * (T(1) - detail::boundary_share(mixture, matt->wi)));
        matt->pdf *= share.diffuse / sum;
        // So dark beside its gloss that no number says how seldom it is chosen.
        if (!(matt->pdf > T(0))) matt.reset();
        return matt;
    }
    if (choice < share.diffuse + share.refract) {
        const T eta = wo.z > T(0) ? T(1) / mixture.index : mixture.index;
        const T scale = transport == Transport::radiance ? eta * eta : T(1);
        if (const auto wi = refract(wo, eta))
            return specular_sample(*wi, RgbT<T>{sum}, scale);
        // At the critical angle rounding may decide otherwise than in F.
    }
    return specular_sample(reflect(wo), RgbT<T>{sum});
}

/// The absorption inside, per scene unit; see transmittance().
/// \param mixture  The material.
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> absorption(const MixtureT<T>& mixture) noexcept {
    return mixture.absorption;
}

/// The emitted radiance, the same in all directions of the side that emits.
/// \param mixture  The material.
/// \return emissivity times color, in W/(m^2 sr).
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> emission(const MixtureT<T>& mixture) noexcept {
    return mixture.emissivity * mixture.color;
}

/// Refuses a slider outside its range.
/// \param mixture  The material.
/// \throws std::invalid_argument naming the slider.
template <std::floating_point T>
void check(const MixtureT<T>& mixture) {
    require_unit("mixture.color", mixture.color);
    require_unit("mixture.reflectivity", mixture.reflectivity);
    require_unit("mixture.transparency", mixture.transparency);
    detail::require_index("mixture.index", mixture.index);
    require_unit("mixture.specularity", mixture.specularity);
    require(std::isfinite(mixture.emissivity) && mixture.emissivity >= T(0),
            "mixture.emissivity", mixture.emissivity, "finite and at least 0");
    detail::require_roughness("mixture.sigma", mixture.sigma);
    require_radiance("mixture.absorption", mixture.absorption);
}

/// \}

} // namespace ljus
