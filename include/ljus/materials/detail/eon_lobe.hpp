#pragma once

/// \file ljus/materials/detail/eon_lobe.hpp
/// \brief A bent cosine lobe, from which the EON model is sampled.

#include <algorithm>
#include <cmath>

#include "ljus/math/sampling.hpp"

namespace ljus {

/// \addtogroup eon
/// \{

namespace detail {

/// A cosine lobe, sheared towards where the light goes, and cut at the horizon: M takes
/// directions of a clamped cosine to directions of about the density of f cos.
///
/// M has the rows (a, 0, b), (0, c, 0), (d, 0, 1) in a frame whose x axis is the
/// azimuth of wo. The four numbers are the fit of \cite eon2025, listing 2.
template <std::floating_point T>
struct EonLobeT {
    T a;            ///< Of the matrix, first row.
    T b;            ///< The same.
    T c;            ///< Second row.
    T d;            ///< Third row, at most 0.
    T kept;         ///< The share of the lobe that lies above the horizon.
    T uniform;      ///< The probability of a uniform direction in place of the lobe's.
    Vec2T<T> along; ///< Unit: the azimuth of wo.
};

/// The lobe for a direction.
/// \param roughness  In [0, 1].
/// \param wo         Unit vector in the surface's frame, to where the light goes.
/// \return The lobe.
template <std::floating_point T>
[[nodiscard]] EonLobeT<T> eon_lobe(T roughness, const Vec3T<T>& wo) noexcept {
    const T r = roughness, mu = std::abs(wo.z);
    EonLobeT<T> lobe;
    lobe.a = T(1) + r * (T(0.303392) + mu * (T(-0.518982) + T(0.111709) * mu) +
                         r * (T(-0.276266) + T(0.335918) * mu));
    lobe.b = r *
             (T(-1.16407) + T(1.15859) * mu + r * (T(0.150815) - T(0.150105) * mu)) /
             (mu * mu * mu - T(1.43545));
    lobe.c = T(1) + r * (T(0.20013) + mu * (T(-0.506373) + T(0.261777) * mu));
    lobe.d = r * (T(0.540852) + mu * (T(-1.01625) + T(0.475392) * mu)) /
             (T(-1.0743) + mu * (T(0.0725628) + mu));
    lobe.d = std::min(lobe.d, T(0)); // the fit is a hair above 0 at the pole
    lobe.kept = (T(1) + T(1) / std::sqrt(lobe.d * lobe.d + T(1))) / T(2);
    lobe.uniform =
        std::pow(r, T(0.1)) *
        (T(0.162925) + mu * (T(-0.372058) + mu * (T(0.538233) - T(0.290822) * mu)));
    const T sine = std::hypot(wo.x, wo.y);
    lobe.along =
        sine > T(0) ? Vec2T<T>{wo.x / sine, wo.y / sine} : Vec2T<T>{T(1), T(0)};
    return lobe;
}

/// The density of a direction above the horizon: the lobe's and the uniform one's.
/// \param lobe  The lobe.
/// \param wi    Unit vector with z > 0.
/// \return Per steradian, above 0.
template <std::floating_point T>
[[nodiscard]] T pdf_eon_lobe(const EonLobeT<T>& lobe, const Vec3T<T>& wi) noexcept {
    const T x = lobe.along.x * wi.x + lobe.along.y * wi.y;
    const T y = lobe.along.x * wi.y - lobe.along.y * wi.x;
    // Back through M, times its determinant.
    const T minor = lobe.a - lobe.b * lobe.d;
    const T determinant = lobe.c * minor;
    const Vec3T<T> v{lobe.c * (x - lobe.b * wi.z), minor * y,
                     lobe.c * (lobe.a * wi.z - lobe.d * x)};
    const T square = glm::dot(v, v);
    const T jacobian = determinant / square; // squared: of solid angles, with |v|^-4
    const T bent = std::max(T(0), v.z) * jacobian * jacobian *
                   std::numbers::inv_pi_v<T> / lobe.kept;
    const T even = std::numbers::inv_pi_v<T> / T(2);
    return lobe.uniform * even + (T(1) - lobe.uniform) * bent;
}

/// A direction with the density pdf_eon_lobe().
/// \param lobe  The lobe.
/// \param u     Point of [0,1)^3; z chooses the lobe or a uniform direction.
/// \return Unit vector; rounding may leave it on the horizon.
/// \cite eon2025
// [eon lobe sample]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_eon_lobe(const EonLobeT<T>& lobe,
                                       const Vec3T<T>& u) noexcept {
    if (u.z < lobe.uniform) return sample_uniform_hemisphere(Vec2T<T>{u.x, u.y});

    // On the disc M takes a half circle and half an ellipse above the horizon: to them
    // each chord along x is shrunk.
    const Vec3T<T> h = sample_cosine_hemisphere(Vec2T<T>{u.x, u.y});
    const T half_chord = std::sqrt(std::max(T(0), (T(1) - h.y) * (T(1) + h.y)));
    const T x = lobe.kept * h.x - (T(1) - lobe.kept) * half_chord;
    const T z = std::sqrt(std::max(T(0), half_chord * half_chord - x * x));
    const Vec3T<T> bent{lobe.a * x + lobe.b * z, lobe.c * h.y, lobe.d * x + z};
    const Vec3T<T> unit = glm::normalize(bent);
    return {lobe.along.x * unit.x - lobe.along.y * unit.y,
            lobe.along.y * unit.x + lobe.along.x * unit.y, unit.z};
}
// [eon lobe sample]

} // namespace detail

/// \}

} // namespace ljus
