#pragma once

/// \file ljus/materials/lambertian.hpp
/// \brief The Lambertian surface: it is matt and looks equally bright from all
/// directions.

#include <numbers>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup lambertian Lambert
/// \brief Section 3.2.1 of the report: the Lambertian BRDF.
/// \erratum{In the report's program the "BRDF" is cos(theta) times the colour. The
/// factor 1/pi is missing, and the cosine is counted twice, because the integral of
/// reflected light contains it.}
/// \{

/// A two-sided matt surface.
/// \report{Section 3.2.1}
template <std::floating_point T>
struct LambertianT {
    using Scalar = T;       ///< The precision of its numbers.
    RgbT<T> albedo{T(0.5)}; ///< Reflected fraction of the light, in [0, 1].
};
using Lambertian = LambertianT<float>; ///< LambertianT in float.

/// The lobes of this material: Lobes::diffuse, even for a black surface.
template <std::floating_point T>
[[nodiscard]] constexpr Lobes lobes(const LambertianT<T>&) noexcept {
    return Lobes::diffuse;
}

/// The BRDF, f = albedo/pi. The integral of f times the cosine over the hemisphere is
/// the albedo.
/// \return f in 1/sr, without the cosine; 0 if the directions lie on different sides.
/// \report{Section 3.2.1}
// [lambertian]
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> evaluate(const LambertianT<T>& surface,
                                         const Vec3T<T>& wo,
                                         const Vec3T<T>& wi) noexcept {
    if (!same_side(wo, wi)) return RgbT<T>{T(0)};
    return surface.albedo * std::numbers::inv_pi_v<T>;
}
// [lambertian]

/// The density of sample(): that of pdf_cosine_lobe(), per steradian.
template <std::floating_point T>
[[nodiscard]] constexpr T pdf(const LambertianT<T>&, const Vec3T<T>& wo,
                              const Vec3T<T>& wi, Lobes which = Lobes::all) noexcept {
    return pdf_cosine_lobe(wo, wi, which);
}

/// Samples a direction by sample_cosine_lobe(). The weight is the albedo.
/// \cost One sine, one cosine, one square root.
/// \report{Section 3.2.4}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const LambertianT<T>& surface, const Vec3T<T>& wo, const Vec3T<T>& u,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    auto next =
        sample_cosine_lobe(wo, u, is_black(surface.albedo) ? Lobes::none : which);
    if (next) next->weight = surface.albedo;
    return next;
}

/// Requires an albedo within [0, 1].
template <std::floating_point T>
void check(const LambertianT<T>& surface) {
    require_unit("lambertian.albedo", surface.albedo);
}

/// \}

} // namespace ljus
