#pragma once

/// \file ljus/optics/schlick.hpp
/// \brief Schlick's approximation to Fresnel's equations.

namespace ljus {

/// \defgroup schlick Schlick's approximation
/// \brief Section 3.2.5 of the report: the reflectance of a boundary, by
/// multiplications only.
///
/// \erratum{The cosine must be that in the medium of *lower* index. With the cosine of
///          the incoming light, as printed, glass reflects 0.04 of the light from
///          inside at 42 degrees, where reflection is total.}
/// \{

/// The reflectance at normal incidence, ((n1 - n2)/(n1 + n2))^2, in [0, 1], of a
/// boundary between indices n1 and n2 in [1e-9, 1e9].
/// \report{Section 3.2.5}
template <typename T>
[[nodiscard]] constexpr T schlick_r0(T n1, T n2) noexcept {
    const T r = (n1 - n2) / (n1 + n2);
    return r * r;
}

/// The reflectance at the angle theta, by Schlick's formula \cite schlick1994.
///
/// \f[ R(\theta) = R_0 + (1 - R_0)(1 - \cos\theta)^5 \f]
///
/// \param r0         R_0, the reflectance at normal incidence, in [0, 1].
/// \param cos_theta  Cosine in the medium of lower index, in [0, 1].
/// \return The reflectance, from r0 to exactly 1 at grazing incidence.
/// \cost Seven additions and multiplications; no square root, no division.
/// \report{Section 3.2.5}
// [schlick]
template <typename T>
[[nodiscard]] constexpr T schlick(T r0, T cos_theta) noexcept {
    const T m = T(1) - cos_theta;
    const T m2 = m * m;
    return r0 + (T(1) - r0) * (m2 * m2 * m);
}
// [schlick]

/// The reflectance of a boundary crossed in either direction, for a caller who has both
/// cosines; others use schlick_dielectric(). The formula takes the cosine in the medium
/// of lower index.
/// \param n_i    Index on the side of the incoming ray, in [1e-9, 1e9].
/// \param n_t    Index on the other side, in [1e-9, 1e9].
/// \param cos_i  Cosine of the incoming ray, in [0, 1].
/// \param cos_t  Cosine of the refracted ray, in [0, 1]. Under total reflection it must
///               be 0, and the result is 1.
/// \return The reflectance, in [0, 1].
/// \report{Section 3.2.5}
template <typename T>
[[nodiscard]] constexpr T schlick(T n_i, T n_t, T cos_i, T cos_t) noexcept {
    return schlick(schlick_r0(n_i, n_t), n_i > n_t ? cos_t : cos_i);
}

/// \}

} // namespace ljus
