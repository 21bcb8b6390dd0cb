#pragma once

/// \file ljus/optics/fresnel.hpp
/// \brief The exact share of unpolarised light that a boundary reflects.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <cstdint>

#include "ljus/optics/schlick.hpp"
#include "ljus/version.hpp"

namespace ljus {

/// \defgroup fresnel Fresnel's equations
/// \brief Section 3.2.5: what Schlick's formula approximates.
/// \{

/// Which of the twins a material uses.
enum class FresnelModel : std::uint8_t {
    exact,   ///< fresnel()
    schlick, ///< schlick_dielectric()
};

/// The reflectance of the boundary of two transparent media.
///
/// With \f$ g = n_t\cos\theta_t \f$ and \f$ \Delta = (n_t - n_i)(n_t + n_i) \f$,
///
/// \f[ g^2 = (n_i\cos\theta_i)^2 + \Delta, \qquad
///     R_s = \left(\frac{\Delta}{(n_i\cos\theta_i + g)^2}\right)^2, \qquad
///     R_p = R_s \left(\frac{\cos(\theta_i + \theta_t)}
///                          {\cos(\theta_i - \theta_t)}\right)^2 \f]
///
/// and the result is their mean. The textbook's differences of products, which cancel
/// for similar indices, are divided out by hand: only the indices themselves are
/// subtracted.
/// \param cos_theta_i  Cosine between incoming ray and normal, in [0, 1].
/// \param n_i          Index on the side of the incoming ray, > 0.
/// \param n_t          Index on the other side, > 0.
/// \return R in [0, 1]: exactly 0 for equal indices, 1 under total internal reflection.
///         The rest, 1 - R, is transmitted.
/// \cost One square root and two divisions.
/// \report{Section 3.2.5}
// [fresnel]
template <std::floating_point T>
[[nodiscard]] T fresnel(T cos_theta_i, T n_i, T n_t) noexcept {
    const T c = cos_theta_i;
    const T delta = (n_t - n_i) * (n_t + n_i);
    if (delta == T(0)) return T(0); // one medium: no boundary
    const T g2 = (n_i * c) * (n_i * c) + delta;
    if (g2 <= T(0)) return T(1); // total internal reflection
    const T g = std::sqrt(g2);

    const T sum = n_i * c + g;
    const T r_s = delta / (sum * sum);
    // cos(i +- t) = cos i cos t -+ sin i sin t, both times n_t.
    const T cosines = c * g;
    const T sines = n_i * ((T(1) - c) * (T(1) + c));
    const T ratio = (cosines - sines) / (cosines + sines);
    // At grazing incidence R is 1 up to rounding, and must not be more.
    return std::min(r_s * r_s * (T(1) + ratio * ratio) / T(2), T(1));
}
// [fresnel]

/// Schlick's approximation behind the same interface: the twin of fresnel().
/// \param cos_theta_i  Cosine between incoming ray and normal, in [0, 1].
/// \param n_i          Index on the side of the incoming ray, > 0.
/// \param n_t          Index on the other side, > 0.
/// \return R in [0, 1]; for n = 1.5 within 0.036 of fresnel(), from either side.
/// \cost A square root only on the way out of the denser medium.
/// \report{Section 3.2.5}
template <std::floating_point T>
[[nodiscard]] T schlick_dielectric(T cos_theta_i, T n_i, T n_t) noexcept {
    const T r0 = schlick_r0(n_i, n_t);
    if (n_i <= n_t) return schlick(r0, cos_theta_i);
    const T cos_i = n_i * cos_theta_i;
    const T g2 = cos_i * cos_i + (n_t - n_i) * (n_t + n_i);
    return g2 <= T(0) ? T(1) : schlick(r0, std::sqrt(g2) / n_t);
}

/// The reflectance by the model that a material names.
/// \param model        Exact or Schlick.
/// \param cos_theta_i  Cosine between incoming ray and normal, in [0, 1].
/// \param n_i          Index on the side of the incoming ray, > 0.
/// \param n_t          Index on the other side, > 0.
/// \return R in [0, 1].
template <std::floating_point T>
[[nodiscard]] T fresnel(FresnelModel model, T cos_theta_i, T n_i, T n_t) noexcept {
    return model == FresnelModel::exact ? fresnel(cos_theta_i, n_i, n_t)
                                        : schlick_dielectric(cos_theta_i, n_i, n_t);
}

/// \}

} // namespace ljus
