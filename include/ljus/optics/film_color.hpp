#pragma once

/// \file ljus/optics/film_color.hpp
/// \brief The colours of thin films, computed in three ways.

#include <array>
#include <cmath>
#include <numbers>

#include "ljus/optics/cie_observer.hpp"
#include "ljus/optics/thin_film.hpp"

namespace ljus {

/// \defgroup film_color Colours of thin films
/// \brief The reflectance of a film varies quickly with the wavelength and must be
/// integrated over the spectrum.
///
/// The colours are reflectances as linear sRGB. `cos_theta` is the cosine between ray
/// and normal outside the film, in [0, 1], `index` the index of the film, at least 1,
/// and `thickness` is in nm, at least 0.
/// \{

/// The colour of a spectrum.
/// \param spectrum  Called with a wavelength in nm; returns a value relative to white
///                  light.
/// \param step      Distance between samples, in nm; finite and above 0.
/// \return Linear sRGB, which is (1, 1, 1) for a spectrum that is 1 everywhere. It may
///         be outside the range of a screen.
/// \cost 470 nm / step calls, each with seven exponentials.
// [spectrum color]
template <std::floating_point T, typename Spectrum>
[[nodiscard]] RgbT<T> spectrum_color(Spectrum spectrum, T step = T(1)) {
    const auto [first, last] = detail::visible<T>;
    const auto count = static_cast<long long>(std::ceil((last - first) / step));
    const T h = (last - first) / static_cast<T>(count);
    Vec3T<T> sum{T(0)};
    Vec3T<T> white{T(0)};
    for (long long i = 0; i < count; ++i) {
        const T wavelength = first + (static_cast<T>(i) + T(0.5)) * h;
        const Vec3T<T> eye = cie_observer(wavelength);
        sum += eye * spectrum(wavelength);
        white += eye;
    }
    return xyz_to_rgb(sum / white);
}
// [spectrum color]

/// The colour of a film by integration over the spectrum, as a reference for the other
/// functions. The samples resolve the fringes of the film.
/// \return Linear sRGB, which may be outside the range of a screen.
/// \cost 470 wavelengths for a film of 400 nm, and 120 000 for a film of 1 mm.
template <std::floating_point T>
[[nodiscard]] RgbT<T> film_spectral(T cos_theta, T index, T thickness) {
    const T path = thickness * std::sqrt(film_cosine2(cos_theta, index));
    // At the shortest wavelength lambda the phase 4 pi path / lambda advances by 1/2
    // per sample.
    const T finest = detail::visible<T>[0] * detail::visible<T>[0] /
                     (T(8) * std::numbers::pi_v<T> * path); // infinite without a film
    return spectrum_color<T>(
        [&](T wavelength) {
            return thin_film(cos_theta, index, thickness, wavelength).reflected;
        },
        std::min(T(1), finest));
}

/// The colour of a film by three wavelengths: the dominant ones of a screen's red,
/// green and blue.
/// \return Each channel in [0, 1]. The fringes of a thick film do not fade, although
///         real fringes do.
/// \cost Three calls of thin_film().
template <std::floating_point T>
[[nodiscard]] RgbT<T> film_three(T cos_theta, T index, T thickness) noexcept {
    const auto at = [&](T wavelength) {
        return thin_film(cos_theta, index, thickness, wavelength).reflected;
    };
    return {at(T(611.4)), at(T(549.1)), at(T(464.3))};
}

namespace detail {

/// The mean of cos(2 pi delay / wavelength) over all wavelengths, weighted by the eye's
/// response. It is the Fourier transform of the response, which is fitted by four
/// Gaussians over the wave number \cite belcour2017.
/// \param delay  Difference of the optical paths of two waves, in nm.
/// \return The mean as linear sRGB: 1 for no delay, approaching 0 for a large one.
/// \cost Four cosines and four exponentials.
template <std::floating_point T>
[[nodiscard]] RgbT<T> visible_swing(T delay) noexcept {
    struct Gaussian {
        T height, center, variance; // of wave numbers, 1/m and 1/m^2
    };
    constexpr Gaussian fit[] = {{T(5.4856e-13), T(1.6810e6), T(4.3278e9)},
                                {T(4.4201e-13), T(1.7953e6), T(9.3046e9)},
                                {T(5.2481e-13), T(2.2084e6), T(6.6121e9)},
                                {T(9.7470e-14), T(2.2399e6), T(4.5282e9)}};
    const T phase = T(2e-9) * std::numbers::pi_v<T> * delay;
    const auto area = [](const Gaussian& g) {
        return g.height * T(1e13) * std::sqrt(g.variance);
    };
    const auto swing = [&](const Gaussian& g) {
        return area(g) * std::cos(g.center * phase) *
               std::exp(-g.variance * phase * phase);
    };
    return xyz_to_rgb(
        Vec3T<T>{(swing(fit[0]) + swing(fit[3])) / (area(fit[0]) + area(fit[3])),
                 swing(fit[1]) / area(fit[1]), swing(fit[2]) / area(fit[2])});
}

} // namespace detail

/// The colour of a film, integrated over the spectrum in closed form. The reflectance
/// of a film is a sum over k,
///
/// \f[ R = \frac{2R_1}{1 + R_1} - 2\,\frac{1 - R_1}{1 + R_1} \sum_{k \ge 1} R_1^k
///     \cos 2k\varphi . \f]
///
/// R_1 is the reflectance of one surface, and phi is the phase that thin_film()
/// defines. Each cosine is replaced by its mean over the spectrum,
/// detail::visible_swing(). The sum ends at k = 3.
/// \return Linear sRGB, which may be outside the range of a screen.
/// \cost Three calls of detail::visible_swing().
/// \cite belcour2017
// [preintegrated]
template <std::floating_point T>
[[nodiscard]] RgbT<T> film_preintegrated(T cos_theta, T index, T thickness) noexcept {
    const T c = cos_theta;
    const T g = std::sqrt(film_cosine2(c, index));
    if (g == T(0)) return RgbT<T>{T(0)}; // grazing, without a film
    const auto square = [](T x) { return x * x; };
    const T n2 = index * index;
    const T one_surface[] = {square((c - g) / (c + g)),
                             square((n2 * c - g) / (n2 * c + g))};
    const T delay = T(2) * thickness * g;
    const RgbT<T> swings[] = {detail::visible_swing(delay),
                              detail::visible_swing(T(2) * delay),
                              detail::visible_swing(T(3) * delay)};
    RgbT<T> sum{T(0)};
    for (const T r : one_surface) {
        // The sum over k.
        const RgbT<T> waves = r * (swings[0] + r * (swings[1] + r * swings[2]));
        sum += (r - (T(1) - r) * waves) / (T(1) + r);
    }
    return sum; // twice the mean of two polarisations
}
// [preintegrated]

/// \}

} // namespace ljus
