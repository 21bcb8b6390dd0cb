#pragma once

/// \file ljus/materials/rough_diffuse.hpp
/// \brief Other formulas for rough matt surfaces: Oren and Nayar's full model, Fujii's
/// two models, and the formula of the report's program.

#include "ljus/materials/oren_nayar.hpp"

namespace ljus {

/// \defgroup rough_diffuse Models of rough matt surfaces
/// \brief Section 3.2.1 of the report: four formulas that are called Oren-Nayar.
/// \{

/// A formula that is called Oren-Nayar. Each comment gives the largest reflectance of
/// a white surface under a uniform sky, over all directions and roughnesses.
enum class RoughModel : std::uint8_t {
    /// The formula of the report's program; its reflectance is at most 1.
    as_printed,
    full,  ///< Oren and Nayar's full model of 1994; its reflectance is at most 1.06.
    fujii, ///< Fujii's first model; its reflectance is at most 1.03.
    /// Fujii's second model, with a roughness in [0, 1]; its reflectance is at most 1.
    fon
};

/// A two-sided matt surface by one of the models.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct RoughDiffuseT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Albedo of a facet, in [0, 1].
    T sigma = T(0.3);       ///< The roughness in radians; for `fon` a number in [0, 1].
    RoughModel model = RoughModel::fon; ///< The formula.
};
using RoughDiffuse = RoughDiffuseT<float>; ///< RoughDiffuseT in float.

namespace detail {

/// The ratio of the formula of the report's program to Lambert's BRDF, albedo/pi.
/// Unlike oren_nayar_ratio(), the formula uses the cosine of the angle between wi and
/// wo in place of that between their azimuths, has 0.57 in place of 0.33, and clamps
/// the result to 1.
template <std::floating_point T>
[[nodiscard]] T rough_as_printed(T sigma, const Vec3T<T>& wo,
                                 const Vec3T<T>& wi) noexcept {
    const T s2 = sigma * sigma;
    const T a = T(1) - s2 / (T(2) * (s2 + T(0.57)));
    const T b = T(0.45) * s2 / (s2 + T(0.09));
    const T sines = std::hypot(wi.x, wi.y) * std::hypot(wo.x, wo.y);
    const T cosine = std::max(T(0), glm::dot(wi, wo));
    const T tangent = sines / larger_cosine(wo, wi);
    return std::min(T(1), a + b * cosine * tangent);
}

/// The BRDF is (`single` * albedo + `twice` * albedo^2)/pi, where `single` is due to
/// light that facets reflect once, and `twice` to light that they reflect twice.
template <std::floating_point T>
struct RoughRatiosT {
    T single{};
    T twice{};
};

/// The full model of 1994, equations (30) and (31) of \cite orennayar1994. `single` and
/// `twice` are
///
/// \f[ C_1 + \cos\phi\,C_2 \tan\beta +
///     (1 - |\cos\phi|)\,C_3 \tan\frac{\alpha+\beta}{2},
///     \quad 0.17 \frac{\sigma^2}{\sigma^2 + 0.13}
///     \left(1 - \cos\phi \left(\frac{2\beta}{\pi}\right)^2\right) \f]
///
/// where sigma is the roughness in radians, alpha the larger of the angles of wi and wo
/// to the normal, beta the smaller, and phi the angle between the azimuths. The code
/// gives C_1, C_2 and C_3. For grazing directions with opposite azimuths the terms
/// cancel: `single` then has no correct digits and may be negative.
/// \cost Two arc tangents, two square roots, seven divisions.
// [full]
template <std::floating_point T>
[[nodiscard]] RoughRatiosT<T> rough_full(T sigma, const Vec3T<T>& wo,
                                         const Vec3T<T>& wi) noexcept {
    constexpr T two_over_pi = T(2) * std::numbers::inv_pi_v<T>;
    const T s2 = sigma * sigma;
    const T sin_i = std::hypot(wi.x, wi.y), sin_o = std::hypot(wo.x, wo.y);
    const T cos_i = std::abs(wi.z), cos_o = std::abs(wo.z);
    const T sines = sin_i * sin_o;
    const T cos_phi = sines > T(0) ? (wi.x * wo.x + wi.y * wo.y) / sines : T(1);
    const T theta_i = std::atan2(sin_i, cos_i), theta_o = std::atan2(sin_o, cos_o);
    const T alpha = std::max(theta_i, theta_o), beta = std::min(theta_i, theta_o);
    const T sin_alpha = std::max(sin_i, sin_o);
    const T tan_beta = std::min(sin_i, sin_o) / larger_cosine(wo, wi);
    const T tan_mean = (sin_i + sin_o) / std::max(cos_i + cos_o, larger_cosine(wo, wi));

    const T steep = two_over_pi * beta;
    const T masked = cos_phi >= T(0) ? T(0) : steep * steep * steep;
    const T both = two_over_pi * two_over_pi * alpha * beta;
    const T c1 = T(1) - s2 / (T(2) * (s2 + T(0.33)));
    const T c2 = T(0.45) * s2 / (s2 + T(0.09)) * (sin_alpha - masked);
    const T c3 = T(0.125) * s2 / (s2 + T(0.09)) * both * both;
    return {.single = c1 + cos_phi * c2 * tan_beta +
                      (T(1) - std::abs(cos_phi)) * c3 * tan_mean,
            .twice = T(0.17) * s2 / (s2 + T(0.13)) * (T(1) - cos_phi * steep * steep)};
}
// [full]

/// Fujii's term s/t. With theta_o and theta_i the angles of wo and wi to the normal,
/// and phi the angle between their azimuths, s is sin(theta_o) sin(theta_i) cos(phi).
/// If s is positive, t is the larger of cos(theta_o) and cos(theta_i), otherwise 1.
/// \return At least -1.
// [fujii]
template <std::floating_point T>
[[nodiscard]] T fujii_term(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    const T s = wi.x * wo.x + wi.y * wo.y;
    return s > T(0) ? s / larger_cosine(wo, wi) : std::max(s, T(-1));
}

/// The ratios of Fujii's first model \cite fujii2012.
template <std::floating_point T>
[[nodiscard]] RoughRatiosT<T> rough_fujii(T sigma, const Vec3T<T>& wo,
                                          const Vec3T<T>& wi) noexcept {
    const T s2 = sigma * sigma;
    return {.single = T(1) - s2 / (T(2) * (s2 + T(0.33))) +
                      T(0.45) * s2 / (s2 + T(0.09)) * fujii_term(wo, wi),
            .twice = T(0.17) * s2 / (s2 + T(0.13))};
}

/// The constant of Fujii's second model: 1/2 - 2/(3 pi).
template <std::floating_point T>
inline constexpr T fon_constant = T(0.5) - T(2) / T(3) * std::numbers::inv_pi_v<T>;

/// The ratio of Fujii's second model, called FON by \cite eon2025, to Lambert's BRDF.
/// \cost Two divisions.
template <std::floating_point T>
[[nodiscard]] T rough_fon(T roughness, const Vec3T<T>& wo,
                          const Vec3T<T>& wi) noexcept {
    return (T(1) + roughness * fujii_term(wo, wi)) /
           (T(1) + roughness * fon_constant<T>);
}
// [fujii]

/// Pi times the BRDF, the weight of a cosine-weighted sample. It is at least 0:
/// negative values of rough_full() are replaced by 0.
template <std::floating_point T>
[[nodiscard]] RgbT<T> rough_weight(const RoughDiffuseT<T>& surface, const Vec3T<T>& wo,
                                   const Vec3T<T>& wi) noexcept {
    const auto both = [&](const RoughRatiosT<T>& ratios) {
        return glm::max(
            surface.albedo * (ratios.single + ratios.twice * surface.albedo), T(0));
    };
    switch (surface.model) {
    case RoughModel::as_printed:
        return surface.albedo * rough_as_printed(surface.sigma, wo, wi);
    case RoughModel::full:
        return both(rough_full(surface.sigma, wo, wi));
    case RoughModel::fujii:
        return both(rough_fujii(surface.sigma, wo, wi));
    case RoughModel::fon:
        break;
    }
    return surface.albedo * rough_fon(surface.sigma, wo, wi);
}

} // namespace detail

/// The lobes of this material: Lobes::diffuse, even for a black surface.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const RoughDiffuseT<T>&) noexcept {
    return Lobes::diffuse;
}

/// The BRDF, by the formula that the surface names, in 1/sr, without the cosine; 0 if
/// the directions lie on different sides.
template <std::floating_point T>
[[nodiscard]] RgbT<T> evaluate(const RoughDiffuseT<T>& surface, const Vec3T<T>& wo,
                               const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return std::numbers::inv_pi_v<T> * detail::rough_weight(surface, wo, wi);
}

/// The density of sample(): that of pdf_cosine_lobe(), per steradian.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf(const RoughDiffuseT<T>&, const Vec3T<T>& wo,
                              const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    return pdf_cosine_lobe(wo, wi, which);
}

/// Samples a direction by sample_cosine_lobe(). The weight is pi times the BRDF.
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const RoughDiffuseT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    auto next =
        sample_cosine_lobe(wo, u, is_black(surface.albedo) ? Lobes::none : which);
    if (next) next->weight = detail::rough_weight(surface, wo, next->wi);
    return next;
}

/// Requires an albedo within [0, 1], and a roughness within [0, 1000] radians or, for
/// RoughModel::fon, within [0, 1].
template <std::floating_point T>
void check(const RoughDiffuseT<T>& surface) {
    require_unit("rough_diffuse.albedo", surface.albedo);
    if (surface.model == RoughModel::fon)
        require_unit("rough_diffuse.sigma", surface.sigma);
    else
        detail::require_roughness("rough_diffuse.sigma", surface.sigma);
}

/// \}

} // namespace ljus
