#pragma once

/// \file ljus/optics/fresnel.hpp
/// \brief The exact reflectance of a boundary for unpolarised light.

#include <cmath>
#include <concepts>
#include <cstdint>

#include "ljus/optics/schlick.hpp"
#include "ljus/version.hpp"

namespace ljus {

/// \defgroup fresnel Fresnel's equations
/// \brief Section 3.2.5 of the report: the equations that Schlick's formula
/// approximates.
/// \{

/// The formula for the reflectance of a dielectric.
enum class FresnelModel : std::uint8_t {
    exact,   ///< Fresnel's equations, by fresnel().
    schlick, ///< Schlick's approximation, by schlick_dielectric().
};

namespace detail {

/// The square of (a - b)/(a + b), computed as 1 - 4ab/(a + b)^2 where that is more
/// precise. a and b are at least 0, and not both 0.
template <std::floating_point T>
[[nodiscard]] constexpr T squared_contrast(T a, T b) noexcept {
    const T sum = a + b;
    const T through = T(4) * (a / sum) * (b / sum);
    if (through < T(0.6)) return T(1) - through;
    const T r = (a - b) / sum;
    return r * r;
}

} // namespace detail

/// The reflectance R of the boundary between two transparent media. It is the mean over
/// the two polarisations:
///
/// \f[ R = \frac{1}{2} \left(
///     \left|\frac{n_i \cos\theta_i - n_t \cos\theta_t}
///                {n_i \cos\theta_i + n_t \cos\theta_t}\right|^2 +
///     \left|\frac{n_t \cos\theta_i - n_i \cos\theta_t}
///                {n_t \cos\theta_i + n_i \cos\theta_t}\right|^2 \right) \f]
///
/// theta_i is the angle of the incoming ray, and theta_t that of the refracted ray.
/// Snell's law gives, without cancellation for n_i <= n_t,
///
/// \f[ (n_t \cos\theta_t)^2 = (n_t \cos\theta_i)^2 +
///     (n_t - n_i)(n_t + n_i) \sin^2\theta_i. \f]
/// \param cos_theta_i  Cosine between incoming ray and normal, in [0, 1].
/// \param n_i          Index on the side of the incoming ray, in [1e-9, 1e9].
/// \param n_t          Index on the other side, in [1e-9, 1e9].
/// \return R in [0, 1]: exactly 0 for equal indices, 1 under total internal reflection.
///         The fraction 1 - R is transmitted.
/// \cost One square root, four to six divisions.
/// \report{Section 3.2.5}
// [fresnel]
template <std::floating_point T>
[[nodiscard]] T fresnel(T cos_theta_i, T n_i, T n_t) noexcept {
    const T c = cos_theta_i;
    const T delta = (n_t - n_i) * (n_t + n_i);
    if (delta == T(0)) return T(0); // no boundary
    const T sin2 = (T(1) - c) * (T(1) + c);
    const T g2 = (n_t * c) * (n_t * c) + delta * sin2;
    if (g2 <= T(0)) return T(1); // total internal reflection
    const T g = std::sqrt(g2);   // n_t cos(theta_t)

    const T r_s = detail::squared_contrast(n_i * c, g);
    const T r_p = detail::squared_contrast(n_t * (n_t * c), n_i * g);
    return (r_s + r_p) / T(2);
}
// [fresnel]

/// Schlick's approximation, with the arguments of fresnel(). Between indices 1 and 1.5
/// it is within 0.036 of fresnel(), for rays from either side.
/// \cost One square root if n_i > n_t, otherwise none.
/// \report{Section 3.2.5}
template <std::floating_point T>
[[nodiscard]] T schlick_dielectric(T cos_theta_i, T n_i, T n_t) noexcept {
    const T r0 = schlick_r0(n_i, n_t);
    if (n_i <= n_t) return schlick(r0, cos_theta_i);
    const T eta = n_i / n_t;
    const T sin2 = (T(1) - cos_theta_i) * (T(1) + cos_theta_i);
    const T square = cos_theta_i * cos_theta_i + (T(1) - eta) * (T(1) + eta) * sin2;
    return square <= T(0) ? T(1) : schlick(r0, std::sqrt(square));
}

/// The reflectance by the formula that `model` selects.
template <std::floating_point T>
[[nodiscard]] T fresnel(FresnelModel model, T cos_theta_i, T n_i, T n_t) noexcept {
    return model == FresnelModel::exact ? fresnel(cos_theta_i, n_i, n_t)
                                        : schlick_dielectric(cos_theta_i, n_i, n_t);
}

/// \}

} // namespace ljus
