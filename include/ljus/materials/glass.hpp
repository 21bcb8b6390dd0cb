#pragma once

/// \file ljus/materials/glass.hpp
/// \brief Clear or coloured glass with a smooth surface, and thin panes.

#include <algorithm>
#include <array>
#include <cmath>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace ljus {

/// \defgroup glass Glass
/// \brief Section 3.2.5 of the report: surfaces that reflect and refract.
/// \erratum{The report's program reflects the same fraction at every angle, multiplies
/// refracted light by a cosine, reflects nothing inside the glass, and returns up to
/// 1.6 times the incident light.}
/// \{

/// The smooth boundary between a transparent body and air. The side z > 0 is air, with
/// index 1.
/// \report{Section 3.2.5}
template <std::floating_point T>
struct GlassT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    T index = T(1.5);                           ///< Index of refraction inside.
    /// Absorption coefficient inside, per scene unit; at least 0.
    RgbT<T> absorption{T(0)};
    /// The formula for the reflectance: exact or approximate.
    FresnelModel fresnel = FresnelModel::exact;
};
using Glass = GlassT<float>; ///< GlassT in float.

namespace detail {

/// The indices on both sides of a boundary, as seen from `wo`.
template <std::floating_point T>
struct SidesT {
    T here = T(1);   ///< Index on the side of `wo`.
    T beyond = T(1); ///< Index on the other side.
};

template <typename G, std::floating_point T>
[[nodiscard]] SidesT<T> sides(const G& glass, const Vec3T<T>& wo) noexcept {
    if (wo.z > T(0)) return {T(1), glass.index};
    return {glass.index, T(1)};
}

/// How a boundary divides light between reflection and refraction.
template <std::floating_point T>
struct GlassBoundaryT {
    std::optional<Vec3T<T>> refracted{}; ///< The refracted direction, if there is one.
    T reflectance = T(1);                ///< Fresnel's reflectance F, in [0, 1].
    T eta_scale = T(1);                  ///< Factor of refracted radiance; 1 for flux.
};

/// Divides the light that leaves along `wo` between reflection and refraction.
/// \cost Three square roots and six to eight divisions; fewer in total internal
///       reflection.
template <std::floating_point T>
[[nodiscard]] GlassBoundaryT<T> boundary(const GlassT<T>& glass, const Vec3T<T>& wo,
                                         Transport transport) noexcept {
    const auto [n_i, n_t] = sides(glass, wo);
    const T eta = n_i / n_t;
    const auto refracted = refract(wo, eta);
    if (!refracted) return {};
    return {.refracted = refracted,
            .reflectance = fresnel(glass.fresnel, std::abs(wo.z), n_i, n_t),
            .eta_scale = transport == Transport::radiance ? eta * eta : T(1)};
}

} // namespace detail

/// Chooses reflection with probability F, Fresnel's reflectance, and otherwise
/// refraction. The weight is 1; for refracted radiance it is the squared ratio of the
/// indices, BsdfSampleT::eta_scale.
/// \cost That of refract() and fresnel().
/// \report{Section 3.2.5}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const GlassT<T>& glass, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport transport, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular)) return std::nullopt;
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    const detail::GlassBoundaryT<T> met = detail::boundary(glass, wo, transport);
    if (!met.refracted || u.z < met.reflectance)
        return specular_sample(reflect(wo), RgbT<T>{T(1)});
    return specular_sample(*met.refracted, RgbT<T>{T(1)}, met.eta_scale);
}

/// Both directions with their weights, for a path that splits in two.
/// \return The reflected and the refracted sample; nothing in total internal
///         reflection.
template <std::floating_point T>
[[nodiscard]] std::optional<std::array<BsdfSampleT<T>, 2>>
split(const GlassT<T>& glass, const Vec3T<T>& wo, Transport transport) noexcept {
    const detail::GlassBoundaryT<T> met = detail::boundary(glass, wo, transport);
    if (!met.refracted) return std::nullopt;
    const T f = met.reflectance;
    return std::array{
        specular_sample(reflect(wo), RgbT<T>{f}),
        specular_sample(*met.refracted, RgbT<T>{T(1) - f}, met.eta_scale)};
}

/// The index of refraction inside.
template <std::floating_point T>
[[nodiscard]] constexpr T refractive_index(const GlassT<T>& glass) noexcept {
    return glass.index;
}

/// The absorption coefficient inside, per scene unit; see transmittance().
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> absorption(const GlassT<T>& glass) noexcept {
    return glass.absorption;
}

/// Requires a valid index and a finite absorption of at least 0.
template <std::floating_point T>
void check(const GlassT<T>& glass) {
    detail::require_index("glass.index", glass.index);
    require_radiance("glass.absorption", glass.absorption);
}

/// \}

/// \defgroup thin_glass Thin glass
/// \brief Section 3.2.5 of the report, for a window: both boundaries of a pane as one
/// surface.
///
/// A pane is a *thin sheet*, like a soap film: shadow rays pass straight through it and
/// are tinted; other paths pass or are reflected, chosen at random, see
/// \ref next_vertex. sample() returns the reflection, and pass_through() the
/// transmittance.
/// \{

/// A pane with air on both sides.
/// \report{Section 3.2.5}
template <std::floating_point T>
struct ThinGlassT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    T index = T(1.5);                           ///< Index of refraction of the glass.
    /// Transmittance of the glass between its boundaries, for one crossing at normal
    /// incidence; in [0, 1].
    RgbT<T> tint{T(1)};
};
using ThinGlass = ThinGlassT<float>; ///< ThinGlassT in float.

namespace detail {

template <std::floating_point T>
struct PaneFractionsT {
    RgbT<T> reflected;   ///< Reflected fraction of the incident light.
    RgbT<T> transmitted; ///< Transmitted fraction. The rest is absorbed.
};

/// The reflectance and the transmittance of a pane, with all reflections inside it.
/// With the reflectance R of each boundary, and the transmittance a of the glass for
/// one crossing, they are
///
/// \f[ T_\infty = (1-R)^2 a \left(1 + R^2 a^2 + R^4 a^4 + \dots\right)
///              = \frac{(1-R)^2 a}{1 - R^2 a^2}, \qquad
///     R_\infty = R + R\,a\,T_\infty \f]
///
/// where a = tint^(1/c), and c is the cosine inside the glass. There is no
/// interference, because a pane is thicker than the coherence length of light.
/// \param cos_theta  Cosine between ray and normal outside the glass, in [0, 1].
/// \return Reflectance and transmittance. Without a tint their sum is 1.
/// \cost That of fresnel(), and one square root; three powers if there is a tint.
// [pane]
template <std::floating_point T>
[[nodiscard]] PaneFractionsT<T> pane_fractions(const ThinGlassT<T>& pane,
                                               T cos_theta) noexcept {
    const T r = fresnel(cos_theta, T(1), pane.index);
    if (!(r < T(1))) return {RgbT<T>{T(1)}, RgbT<T>{T(0)}};
    const T sine2 = (T(1) - cos_theta) * (T(1) + cos_theta);
    const T cosine =
        std::sqrt(std::max(T(0), T(1) - sine2 / (pane.index * pane.index)));
    PaneFractionsT<T> shares{};
    for (int c = 0; c < 3; ++c) {
        const T tint = pane.tint[c];
        const T a = tint == T(1) ? T(1) : std::pow(tint, T(1) / cosine);
        shares.transmitted[c] =
            (T(1) - r) * (T(1) - r) * a / ((T(1) - r * a) * (T(1) + r * a));
        shares.reflected[c] = r * (T(1) + a * shares.transmitted[c]);
    }
    return shares;
}
// [pane]

} // namespace detail

/// The transmittance of a pane, in each channel. A material with this function is a
/// thin sheet.
template <std::floating_point T>
[[nodiscard]] RgbT<T> pass_through(const ThinGlassT<T>& pane,
                                   const Vec3T<T>& /*position*/,
                                   const Vec3T<T>& wo) noexcept {
    return detail::pane_fractions(pane, std::min(std::abs(wo.z), T(1))).transmitted;
}

/// Returns the mirror direction. Its weight is the reflectance of the pane.
/// \report{Section 3.2.5}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const ThinGlassT<T>& pane, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    const T cos_theta = std::min(std::abs(wo.z), T(1));
    return specular_sample(reflect(wo),
                           detail::pane_fractions(pane, cos_theta).reflected);
}

/// Requires a valid index and a tint within [0, 1].
template <std::floating_point T>
void check(const ThinGlassT<T>& pane) {
    detail::require_index("thin_glass.index", pane.index);
    require_unit("thin_glass.tint", pane.tint);
}

/// \}

} // namespace ljus
