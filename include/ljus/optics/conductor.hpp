#pragma once

/// \file ljus/optics/conductor.hpp
/// \brief The reflectance of metals.

#include <cmath>
#include <string>
#include <string_view>

#include "ljus/math/require.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup conductor Metals
/// \brief Fresnel's equations with a complex index.
///
/// The index of a metal is complex, \f$ \bar n = n + ik \f$. A wave that enters the
/// metal decays within a fraction of its wavelength, so that no light is refracted. n
/// and k depend on the wavelength, which gives the metal its colour.
/// \{

/// The complex index of a metal at three wavelengths, for red, green and blue.
template <std::floating_point T>
struct ConductorIndexT {
    RgbT<T> n{T(1)}; ///< Real part, in [0, 1e9].
    RgbT<T> k{T(0)}; ///< Imaginary part, the extinction coefficient, in [0, 1e9].
};
using ConductorIndex = ConductorIndexT<float>; ///< ConductorIndexT in float.

/// Measured indices at 620, 539 and 459 nm, which are close to a display's red, green
/// and blue \cite babar2015.
/// \{
template <std::floating_point T>
inline constexpr ConductorIndexT<T> gold{{T(0.1357), T(0.3290), T(1.457)},
                                         {T(3.204), T(2.249), T(1.736)}};
template <std::floating_point T>
inline constexpr ConductorIndexT<T> copper{{T(0.09461), T(0.9717), T(1.147)},
                                           {T(3.382), T(2.413), T(2.372)}};
template <std::floating_point T>
inline constexpr ConductorIndexT<T> silver{{T(0.04803), T(0.05168), T(0.052)},
                                           {T(4.164), T(3.483), T(2.765)}};
/// \}

/// The reflectance R of a metal in air, at one wavelength. R is the mean of the
/// reflectances of the two polarisations:
///
/// \f[ R_s = \left|\frac{c - q}{c + q}\right|^2, \quad
///     R_p = R_s \left|\frac{q c - s^2}{q c + s^2}\right|^2, \quad
///     q = \sqrt{\bar n^2 - s^2}, \quad c = \cos\theta,\ s = \sin\theta \f]
///
/// The root q is computed without cancellation.
/// \param cos_theta  Cosine of the angle theta between ray and normal, in [0, 1].
/// \param n          Real part of the index, in [0, 1e9].
/// \param k          Imaginary part of the index, in [0, 1e9]. If it is 0, R is
///                   fresnel(cos_theta, 1, n), except close to grazing incidence
///                   for n close to 1.
/// \return R in [0, 1].
/// \cost Two square roots (one of them a hypot) and three divisions.
/// \report{Section 3.2.5; the complex index: \cite pharr2023, section 9.3}
// [fresnel_conductor]
template <std::floating_point T>
[[nodiscard]] T fresnel_conductor(T cos_theta, T n, T k) noexcept {
    const T c = cos_theta;
    const T sin2 = (T(1) - c) * (T(1) + c);

    // q = a + ib, with q^2 = n^2 - k^2 - s^2 + 2ink.
    const T real = (n - k) * (n + k) - sin2;
    const T half_imaginary = n * k;
    const T size = std::hypot(real, T(2) * half_imaginary);
    const T larger = std::sqrt((size + std::abs(real)) / T(2));
    const T smaller = larger > T(0) ? half_imaginary / larger : T(0);
    const T a = real >= T(0) ? larger : smaller;
    const T b = real >= T(0) ? smaller : larger;

    const auto square = [](T x) { return x * x; };
    // Grazing incidence with n = 1 and k = 0 gives 0/0.
    const auto share = [](T part, T all) { return all > T(0) ? part / all : T(1); };
    const T r_s = share(square(c - a) + square(b), square(c + a) + square(b));
    const T ratio = share(square(a * c - sin2) + square(b * c),
                          square(a * c + sin2) + square(b * c));
    return r_s * (T(1) + ratio) / T(2);
}
// [fresnel_conductor]

/// The reflectance of a metal in three channels, each in [0, 1].
template <std::floating_point T>
[[nodiscard]] RgbT<T> fresnel_conductor(T cos_theta,
                                        const ConductorIndexT<T>& index) noexcept {
    return {fresnel_conductor(cos_theta, index.n.x, index.k.x),
            fresnel_conductor(cos_theta, index.n.y, index.k.y),
            fresnel_conductor(cos_theta, index.n.z, index.k.z)};
}

namespace detail {

/// Requires that n and k are within [0, 1e9]. `what` names the index in the message.
template <std::floating_point T>
void require_conductor(std::string_view what, const ConductorIndexT<T>& index) {
    const auto check_part = [&](const char* name, const RgbT<T>& part) {
        require_radiance(join({what, name}), part);
        require(max_component(part) <= T(1e9), join({what, name}), part,
                "at most 1e9 in every channel");
    };
    check_part(".n", index.n);
    check_part(".k", index.k);
}

} // namespace detail

/// \}

} // namespace ljus
