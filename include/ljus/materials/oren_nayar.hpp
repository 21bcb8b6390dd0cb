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
/// \brief Section 3.2.1 of the report: the Oren-Nayar BRDF, \cite orennayar1994.
/// \erratum{The model has the cosine of the angle between the azimuths of wi and wo. In
/// its place the report's program uses the cosine of the angle between wi and wo; it
/// also clamps the result to 1. Figure 14 shows roughness 1, 10 and 100. The unit is
/// radians. The coefficients A and B of the model are nearly constant for a roughness
/// above 3, so that 10 and 100 look the same.}
/// \{

/// A two-sided surface of matt facets with random slopes. Its shading is flatter than
/// that of a Lambertian surface, and brighter when seen from the direction of the
/// light.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct OrenNayarT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Albedo of a facet, in [0, 1].
    /// Standard deviation of the slope angle, in radians. If it is 0, the surface is
    /// Lambertian.
    T sigma = T(0.3);
};
using OrenNayar = OrenNayarT<float>; ///< OrenNayarT in float.

/// The lobes of this material: Lobes::diffuse, even for a black surface.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const OrenNayarT<T>&) noexcept {
    return Lobes::diffuse;
}

namespace detail {

/// The larger of the cosines between two directions and the normal, but at least the
/// square of the machine epsilon, so that a division by the result stays finite.
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
/// Here sigma is the roughness in radians, phi_i and phi_o are the azimuths of wi and
/// wo, alpha is the larger of their angles to the normal, and beta the smaller. The
/// code computes no angles: the product of cos(phi_i - phi_o), sin(alpha) and sin(beta)
/// is wi.x wo.x + wi.y wo.y, and a division by the larger cosine turns sin(beta) into
/// tan(beta).
/// \return At least 1/2. In float, up to 3e13 if both directions are grazing.
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

/// The BRDF: Lambert's albedo/pi times detail::oren_nayar_ratio(). The model leaves out
/// the light that facets send to each other, so that a white surface loses light at
/// most angles. At grazing angles a white surface reflects up to 1.5 percent more light
/// than it receives.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \report{Section 3.2.1}
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const OrenNayarT<T>& surface, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return surface.albedo * (std::numbers::inv_pi_v<T> *
                             detail::oren_nayar_ratio(surface.sigma, wo, wi));
}

/// The density of sample(): that of pdf_cosine_lobe(), per steradian.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf(const OrenNayarT<T>&, const Vec3T<T>& wo,
                              const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    return pdf_cosine_lobe(wo, wi, which);
}

/// Samples a direction by sample_cosine_lobe(). The weight is the albedo times
/// detail::oren_nayar_ratio().
/// \cost One sine, one cosine, one square root and four divisions.
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

/// Requires a roughness within [0, 1000] radians. `what` is the name of the member.
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
