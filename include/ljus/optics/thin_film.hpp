#pragma once

/// \file ljus/optics/thin_film.hpp
/// \brief Interference: the reflectance of a film as thin as a wavelength.

#include <cmath>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup thin_film Thin films
/// \brief The soap bubble of figure 4.
///
/// A film has two surfaces. The wave that the second one reflects is delayed against
/// that of the first, and the two interfere.
/// \{

namespace detail {

template <std::floating_point T>
struct FilmSharesT {
    T reflected = T(0);   ///< R.
    T transmitted = T(1); ///< T: R + T = 1.
};

} // namespace detail

/// \f$ (n_t \cos\theta_t)^2 \f$, the square of index times cosine *inside* the film:
/// \f$ \cos^2\theta + (n - 1)(n + 1) \f$, without cancellation.
/// \return Negative if nothing is refracted into the film.
template <std::floating_point T>
[[nodiscard]] constexpr T film_cosine2(T cos_theta, T index) noexcept {
    return cos_theta * cos_theta + (index - T(1)) * (index + T(1));
}

/// Reflectance and transmittance, averaged over two polarisations, from the amplitude
/// of interference.
/// \param cos_theta  Cosine outside, in [0, 1].
/// \param index      Index of the film, > 0.
/// \param beat       \f$ q = (n^2 - 1) \sin\varphi / g \f$; see thin_film().
/// \return R and T.
/// \cost Four divisions.
// [film_shares]
template <std::floating_point T>
[[nodiscard]] detail::FilmSharesT<T> film_shares(T cos_theta, T index,
                                                 T beat) noexcept {
    const T c2 = cos_theta * cos_theta;
    const T sin2 = (T(1) - cos_theta) * (T(1) + cos_theta);
    const T p = beat * (c2 - sin2 / (index * index)); // 0 at Brewster's angle
    const auto shares = [&](T q) {
        // A film without thickness reflects nothing, even at grazing incidence.
        if (q == T(0)) return detail::FilmSharesT<T>{};
        const T root = T(2) * cos_theta / q, ratio = root * root;
        const T reflected = T(1) / (T(1) + ratio);
        // The smaller one needs no subtraction; the ratio may be infinite.
        return detail::FilmSharesT<T>{reflected, ratio < T(1) ? ratio * reflected
                                                              : T(1) - reflected};
    };
    const auto s_wave = shares(beat);
    const auto p_wave = shares(p);
    return {(s_wave.reflected + p_wave.reflected) / T(2),
            (s_wave.transmitted + p_wave.transmitted) / T(2)};
}
// [film_shares]

/// The reflectance and transmittance of a film in air at one wavelength, with all
/// reflections inside it: the sum of Airy's series,
///
/// \f[ R = \frac{F \sin^2\varphi}{1 + F \sin^2\varphi}, \quad
///     F = \frac{4 R_1}{(1 - R_1)^2}, \quad
///     \varphi = \frac{2\pi}{\lambda}\, n\, d \cos\theta_t \f]
///
/// for each polarisation, where R_1 belongs to one surface. It is evaluated as
/// \f$ F \sin^2\varphi = q^2 / 4\cos^2\theta \f$ with
/// \f$ q = (n^2 - 1) \sin\varphi / g \f$, \f$ g = n \cos\theta_t \f$, for waves
/// polarised perpendicular to the plane of incidence; for the others q is multiplied by
/// \f$ \cos^2\theta - \sin^2\theta/n^2 \f$. Nothing cancels, and R + T = 1. Where
/// nothing is refracted (n < 1) the sine becomes hyperbolic: light tunnels.
/// \param cos_theta   Cosine between ray and normal, outside, in [0, 1].
/// \param index       Index of the film, > 0.
/// \param thickness   >= 0, in the unit of the wavelength.
/// \param wavelength  In air, > 0.
/// \return R and T; R = 0 for a film without thickness.
/// \cost A square root, a sine and five divisions.
/// \cite bornwolf1999
// [thin_film]
template <std::floating_point T>
[[nodiscard]] detail::FilmSharesT<T> thin_film(T cos_theta, T index, T thickness,
                                               T wavelength) noexcept {
    const T g2 = film_cosine2(cos_theta, index);
    const T g = std::sqrt(std::abs(g2));
    const T per_g = T(2) * std::numbers::pi_v<T> * thickness / wavelength;
    const T wave = g == T(0)   ? per_g
                   : g2 > T(0) ? std::sin(per_g * g) / g
                               : std::sinh(per_g * g) / g;
    return film_shares(cos_theta, index, (index - T(1)) * (index + T(1)) * wave);
}
// [thin_film]

/// The mean of a film's reflectance over all phases: the reflectance of a film too
/// thick for interference. For each polarisation it is \f$ 1 - 1/\sqrt{1 + F} =
/// 2R_1/(1 + R_1) \f$.
/// \param cos_theta  Cosine outside, in [0, 1].
/// \param index      Index of the film, >= 1.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] T thick_film(T cos_theta, T index) noexcept {
    const T c = cos_theta;
    const T contrast = (index - T(1)) * (index + T(1));
    if (contrast == T(0)) return T(0);
    const T q = contrast / std::sqrt(film_cosine2(c, index));
    const T sin2 = (T(1) - c) * (T(1) + c);
    const auto mean = [&](T q_of_wave) {
        const T root = std::hypot(T(2) * c, q_of_wave);
        // 1 - 2c/root, without cancellation.
        return root > T(0) ? q_of_wave * q_of_wave / (root * (root + T(2) * c)) : T(0);
    };
    return (mean(q) + mean(q * (c * c - sin2 / (index * index)))) / T(2);
}

/// \}

} // namespace ljus
