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
/// Both surfaces of a film reflect light. The wave from the second surface is delayed,
/// and the two waves interfere.
///
/// `cos_theta` is the cosine between ray and normal outside the film, in [0, 1], and
/// `index` is the index n of the film, in [1e-9, 1e9].
/// \{

namespace detail {

template <std::floating_point T>
struct FilmSharesT {
    T reflected = T(0);   ///< The reflectance R.
    T transmitted = T(1); ///< The transmittance T = 1 - R.
};

} // namespace detail

/// The square of \f$ n \cos\theta_t \f$, where n is the index of the film and theta_t
/// the angle *inside* the film. It is computed without cancellation from the angle
/// theta outside, as \f$ \cos^2\theta + (n - 1)(n + 1) \f$.
/// \return Negative if nothing is refracted into the film.
template <std::floating_point T>
[[nodiscard]] constexpr T film_cosine2(T cos_theta, T index) noexcept {
    return cos_theta * cos_theta + (index - T(1)) * (index + T(1));
}

/// The reflectance and transmittance of a film, averaged over the two polarisations.
/// `beat` is \f$ q = (n^2 - 1) \sin\varphi / g \f$ of thin_film().
/// \cost Five divisions.
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
        // The smaller of the two is computed without a subtraction. The ratio may be
        // infinite.
        return detail::FilmSharesT<T>{reflected, ratio < T(1) ? ratio * reflected
                                                              : T(1) - reflected};
    };
    const auto s_wave = shares(beat);
    const auto p_wave = shares(p);
    return {(s_wave.reflected + p_wave.reflected) / T(2),
            (s_wave.transmitted + p_wave.transmitted) / T(2)};
}
// [film_shares]

/// The reflectance R and the transmittance T = 1 - R of a film in air at one
/// wavelength. They include all reflections inside the film. For each polarisation, R
/// is the sum of Airy's series:
///
/// \f[ R = \frac{F \sin^2\varphi}{1 + F \sin^2\varphi}, \quad
///     F = \frac{4 R_1}{(1 - R_1)^2}, \quad
///     \varphi = \frac{2\pi}{\lambda}\, n\, d \cos\theta_t \f]
///
/// R_1 is the reflectance of one surface, n the index, d the thickness, lambda the
/// wavelength in air, in the same unit, and theta_t the angle inside the film.
///
/// The function computes \f$ F \sin^2\varphi = q^2 / (4\cos^2\theta) \f$, in which
/// nothing cancels, for the angle theta outside. For waves polarised perpendicular to
/// the plane of incidence, \f$ q = (n^2 - 1) \sin\varphi / g \f$ with
/// \f$ g = n \cos\theta_t \f$. For waves polarised parallel to this plane, q is
/// multiplied by \f$ \cos^2\theta - \sin^2\theta/n^2 \f$. If nothing is refracted,
/// which needs n < 1, the sine becomes hyperbolic: light tunnels through the film.
/// \return R and T; R = 0 for a film without thickness.
/// \cost A square root, a sine and seven divisions.
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

/// The mean of a film's reflectance over all phases, in [0, 1], for an index of at
/// least 1: the reflectance of a film too thick for interference. For each polarisation
/// it is \f$ 1 - 1/\sqrt{1 + F} = 2R_1/(1 + R_1) \f$, with F and R_1 as for
/// thin_film().
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
