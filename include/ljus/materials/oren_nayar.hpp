#pragma once

/// \file ljus/materials/oren_nayar.hpp
/// \brief The rough matt surface of Oren and Nayar: their qualitative model.

#include <algorithm>
#include <limits>
#include <numbers>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup oren_nayar Oren-Nayar
/// \brief Section 3.2.1: the Oren-Nayar BRDF, \cite orennayar1994.
/// \erratum{The program uses the cosine between wi and wo where the model has that
/// between their azimuths, and clamps the sum. Figure 14 shows roughness 1, 10 and 100:
/// the unit is radians, and A and B saturate long before 10.}
/// \{

/// A two-sided surface of matt facets whose slopes vary by `sigma`: it looks flatter
/// than Lambert's, and brighter towards the light.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct OrenNayarT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Albedo of a facet, in [0, 1].
    T sigma = T(0.3); ///< Standard deviation of the slope angle, radians; 0: Lambert.
};
using OrenNayar = OrenNayarT<float>; ///< OrenNayarT in float.

/// The lobes of this material: a diffuse one, even if it is black.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const OrenNayarT<T>&) noexcept {
    return Lobes::diffuse;
}

namespace detail {

/// The larger cosine of two directions to the normal, with a lower bound that keeps
/// quotients finite where both directions graze.
/// \return At least epsilon^2.
template <std::floating_point T>
[[nodiscard]] T larger_cosine(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    return std::max(std::max(std::abs(wi.z), std::abs(wo.z)), epsilon * epsilon);
}

/// The ratio of the qualitative model to Lambert's BRDF.
///
/// \f[ A + B\,\max(0, \cos(\phi_i - \phi_o))\,\sin\alpha\,\tan\beta, \quad
///     A = 1 - \frac{\sigma^2}{2(\sigma^2 + 0.33)}, \quad
///     B = \frac{0.45\,\sigma^2}{\sigma^2 + 0.09} \f]
///
/// where alpha is the larger and beta the smaller of the two angles to the normal. The
/// product of both sines with the cosine of the azimuths is x_i x_o + y_i y_o, and the
/// tangent leaves a division by the larger cosine: no angle is computed.
/// \param sigma   Roughness in radians, in [0, 1000].
/// \param wo, wi  Unit vectors on the same side.
/// \return The ratio: at least 1/2, and unbounded where both directions graze: up to
///         3e13 in float.
/// \cost Three divisions; no trigonometric function.
// [oren nayar]
template <std::floating_point T>
[[nodiscard]] T oren_nayar_ratio(T sigma, const Vec3T<T>& wo,
                                 const Vec3T<T>& wi) noexcept {
    const T s2 = sigma * sigma;
    const T a = T(1) - s2 / (T(2) * (s2 + T(0.33)));
    const T b = T(0.45) * s2 / (s2 + T(0.09));
    const T azimuth = std::max(T(0), wi.x * wo.x + wi.y * wo.y);
    return a + b * azimuth / larger_cosine(wo, wi);
}
// [oren nayar]

} // namespace detail

/// The BRDF: Lambert's albedo/pi times oren_nayar_ratio(). Light between facets is left
/// out, so that white returns less than all light at most angles; at grazing angles the
/// model returns up to 1.5 percent too much.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \report{Section 3.2.1}
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const OrenNayarT<T>& surface, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return surface.albedo * (std::numbers::inv_pi_v<T> *
                             detail::oren_nayar_ratio(surface.sigma, wo, wi));
}

/// The density of sample(), per steradian: pdf_cosine_lobe().
template <std::floating_point T>
[[nodiscard]] constexpr T pdf(const OrenNayarT<T>&, const Vec3T<T>& wo,
                              const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    return pdf_cosine_lobe(wo, wi, which);
}

/// Samples the density cos/pi; the weight is the albedo times the ratio.
/// \cost That of Lambert's, and three divisions.
/// \report{Section 3.2.4}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const OrenNayarT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    auto next =
        sample_cosine_lobe(wo, u, is_black(surface.albedo) ? Lobes::none : which);
    if (next)
        next->weight =
            surface.albedo * detail::oren_nayar_ratio(surface.sigma, wo, next->wi);
    return next;
}

namespace detail {

/// Requires a roughness within [0, 1000] radians; `what` is its name, e.g.
/// "oren_nayar.sigma".
template <std::floating_point T>
void require_roughness(std::string_view what, T sigma) {
    require(sigma >= T(0) && sigma <= T(1000), what, sigma,
            "within [0, 1000] radians (the model saturates near 1)");
}

} // namespace detail

/// Requires an albedo within [0, 1] and a roughness within [0, 1000] radians.
template <std::floating_point T>
void check(const OrenNayarT<T>& surface) {
    require_unit("oren_nayar.albedo", surface.albedo);
    detail::require_roughness("oren_nayar.sigma", surface.sigma);
}

/// \}

} // namespace ljus
