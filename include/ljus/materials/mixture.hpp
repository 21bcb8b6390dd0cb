#pragma once

/// \file ljus/materials/mixture.hpp
/// \brief The report's material: sliders for matt, mirror and glass, in any mixture.

#include <numbers>

#include "ljus/materials/oren_nayar.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace ljus {

/// \defgroup mixture The report's sliders
/// \brief Section 3.2.1 of the report: all properties of its materials.
///
/// Incident light is divided into fractions:
///
/// | fraction                    | goes to                                        |
/// |-----------------------------|------------------------------------------------|
/// | r = reflectivity            | an untinted mirror                             |
/// | (1 - r) F                   | the boundary's reflection                      |
/// | (1 - r)(1 - F) transparency | refraction, with absorption by Beer's law      |
/// | the rest                    | the matt body; it lets out 1 - F of its light  |
///
/// Here F is the specularity times fresnel() for the angle between light and normal.
///
/// \erratum{In the report's program reflectivity and transparency are independent. Its
/// thin glass has a reflectivity of 0.6 and a transparency of 1, and returns up to 1.6
/// times the incident light.}
/// \{

/// A mixture of mirror, glass and matt body, as the report describes all materials.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct MixtureT {
    using Scalar = T;      ///< The precision of its numbers.
    RgbT<T> color{T(0.5)}; ///< Colour of matt lobe and emission, in [0, 1].
    T reflectivity = T(0); ///< Fraction reflected by a perfect mirror, in [0, 1].
    T transparency = T(0); ///< Transmitted fraction of entering light, in [0, 1].
    T index = T(1.5);      ///< Index of refraction inside.
    T specularity = T(0);  ///< Factor of Fresnel's reflectance, in [0, 1].
    T emissivity = T(0);   ///< Emitted radiance over `color`, W/(m^2 sr), at least 0.
    T sigma = T(0);        ///< Sigma of the matt lobe, in radians; see OrenNayar.
    RgbT<T> absorption{T(0)}; ///< Absorption inside, per scene unit; at least 0.
};
using Mixture = MixtureT<float>; ///< MixtureT in float.

/// The lobes of this material: Lobes::specular if it has reflectivity, transparency or
/// a reflecting boundary; Lobes::diffuse if the matt lobe is not black, or if there is
/// no specular lobe.
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

/// The reflectance F of the boundary for the direction w. w.z < 0 is inside a
/// transparent body; both sides of an opaque body count as outside.
/// \return specularity times fresnel(), or 1 in total internal reflection.
template <std::floating_point T>
[[nodiscard]] T boundary_reflectance(const MixtureT<T>& mixture,
                                     const Vec3T<T>& w) noexcept {
    const bool transparent = mixture.transparency > T(0);
    if (mixture.specularity == T(0) && !transparent) return T(0);
    const bool inside = transparent && w.z < T(0);
    const T f = inside ? fresnel(-w.z, mixture.index, T(1))
                       : fresnel(std::abs(w.z), T(1), mixture.index);
    return transparent && f >= T(1) ? T(1) : mixture.specularity * f;
}

/// The fractions of light that the lobes of a Mixture scatter.
template <std::floating_point T>
struct LobeFractionsT {
    T diffuse; ///< The fraction of the matt lobe, in its brightest channel.
    T refract; ///< The fraction that is refracted.
    T reflect; ///< The fraction that the mirror and the boundary reflect.
    [[nodiscard]] constexpr T sum() const noexcept {
        return diffuse + refract + reflect;
    }
};

/// The fraction of light for each lobe, 0 for a lobe that is not in `which`. sample()
/// chooses a lobe in proportion to its fraction.
template <std::floating_point T>
[[nodiscard]] LobeFractionsT<T>
lobe_fractions(const MixtureT<T>& mixture, const Vec3T<T>& wo, Lobes which) noexcept {
    const T entering =
        (T(1) - mixture.reflectivity) * (T(1) - boundary_reflectance(mixture, wo));
    const T specular = has(which, Lobes::specular) ? T(1) : T(0);
    const T diffuse = has(which, Lobes::diffuse) ? max_component(mixture.color) : T(0);
    return {.diffuse = diffuse * entering * (T(1) - mixture.transparency),
            .refract = specular * entering * mixture.transparency,
            .reflect = specular * (T(1) - entering)};
}

} // namespace detail

/// The BRDF of the matt lobe. The factor 1 - F, where F is the
/// detail::boundary_reflectance(), appears twice, for `wi` and for `wo`, because light
/// crosses the boundary on its way in and on its way out.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \report{Section 3.2.1}
// [mixture]
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const MixtureT<T>& mixture, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    const T ratio = detail::oren_nayar_ratio(mixture.sigma, wo, wi);
    const RgbT<T> body = mixture.color * (std::numbers::inv_pi_v<T> * ratio);
    const T out = T(1) - detail::boundary_reflectance(mixture, wo);
    const T in = T(1) - detail::boundary_reflectance(mixture, wi);
    const T clear = mixture.transparency;
    return body * ((T(1) - mixture.reflectivity) * (T(1) - clear) * out * in);
}
// [mixture]

/// The density of sample().
/// \return |wi.z|/pi per steradian times the probability of the matt lobe, on the side
///         of `wo`; 0 elsewhere.
template <std::floating_point T>
[[nodiscard]] T pdf(const MixtureT<T>& mixture, const Vec3T<T>& wo, const Vec3T<T>& wi,
                    Lobes which = Lobes::all) noexcept {
    const auto share = detail::lobe_fractions(mixture, wo, which);
    if (!(share.diffuse > T(0))) return T(0);
    return share.diffuse / share.sum() * pdf_cosine_lobe(wo, wi, Lobes::diffuse);
}

/// Samples one direction. u.z chooses a lobe in proportion to the lobe's fraction of
/// the light, so that the weight is the sum of all fractions. The weight of the matt
/// lobe has three more factors: the colour over its brightest channel, 1 minus the
/// detail::boundary_reflectance() for `wi`, and detail::oren_nayar_ratio().
/// \cost One call of fresnel() for `wo`; for the matt lobe, another one for `wi`.
/// \report{Sections 3.2.1, 3.2.4 and 3.2.5}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const MixtureT<T>& mixture, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    const auto share = detail::lobe_fractions(mixture, wo, which);
    const T sum = share.sum();
    if (!(sum > T(0))) return std::nullopt;
    const T choice = u.z * sum;

    if (choice < share.diffuse) {
        auto matt = sample_cosine_lobe(wo, u, Lobes::diffuse);
        if (!matt) return matt;
        const RgbT<T> tint = mixture.color / max_component(mixture.color);
        const T ratio = detail::oren_nayar_ratio(mixture.sigma, wo, matt->wi);
        matt->weight =
            tint *
            (sum * ratio * (T(1) - detail::boundary_reflectance(mixture, matt->wi)));
        matt->pdf *= share.diffuse / sum;
        // If the lobe is so dark that its probability underflows, nothing is sampled.
        if (!(matt->pdf > T(0))) matt.reset();
        return matt;
    }
    if (choice < share.diffuse + share.refract) {
        const T eta = wo.z > T(0) ? T(1) / mixture.index : mixture.index;
        const T scale = transport == Transport::radiance ? eta * eta : T(1);
        if (const auto wi = refract(wo, eta))
            return specular_sample(*wi, RgbT<T>{sum}, scale);
        // At the critical angle, by rounding, there may be no refracted direction.
    }
    return specular_sample(reflect(wo), RgbT<T>{sum});
}

/// The index of refraction inside; 0 if the material is opaque.
template <std::floating_point T>
[[nodiscard]] constexpr T refractive_index(const MixtureT<T>& mixture) noexcept {
    return mixture.transparency > T(0) ? mixture.index : T(0);
}

/// The absorption coefficient inside, per scene unit; see transmittance().
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> absorption(const MixtureT<T>& mixture) noexcept {
    return mixture.absorption;
}

/// The emitted radiance, emissivity times color, in W/(m^2 sr).
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> emission(const MixtureT<T>& mixture) noexcept {
    return mixture.emissivity * mixture.color;
}

/// Requires every member to be within its range.
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
