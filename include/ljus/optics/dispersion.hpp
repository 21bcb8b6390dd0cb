#pragma once

/// \file ljus/optics/dispersion.hpp
/// \brief Indices of refraction that depend on the wavelength, and random wavelengths
/// for paths.

#include <array>
#include <cmath>
#include <cstddef>
#include <span>

#include "ljus/math/piecewise_constant.hpp"
#include "ljus/optics/cie_observer.hpp"
#include "ljus/optics/wavelength.hpp"

namespace ljus {

/// \defgroup dispersion Dispersion
/// \brief Beyond the report: violet light is refracted more than red light. Chapter:
/// \ref ch_dispersion.
///
/// Wavelengths are in nm, in air.
/// \{

/// Sellmeier's formula \cite sellmeier1871 for the index n at the wavelength lambda, in
/// micrometres:
/// \f[ n^2(\lambda) = 1 + \sum_i \frac{B_i \lambda^2}{\lambda^2 - C_i} \f]
template <std::floating_point T>
struct SellmeierT {
    std::array<T, 4> b{}; ///< B: strengths of up to four resonances, without a unit.
    /// C: squared wavelengths of the resonances, in micrometres^2.
    std::array<T, 4> c{};
};
using Sellmeier = SellmeierT<float>; ///< SellmeierT in float.

/// Cauchy's formula for the index n at the wavelength lambda, in micrometres:
/// \f$ n(\lambda) = A + B/\lambda^2 \f$. It holds for visible light only.
template <std::floating_point T>
struct CauchyT {
    T a = T(1.5); ///< A: the index for long waves.
    T b = T(0);   ///< B: the dispersion, in micrometres^2; 0 for none.
};
using Cauchy = CauchyT<float>; ///< CauchyT in float.

/// The index of refraction by Sellmeier's formula, at a wavelength in nm, > 0.
/// \return The index; NaN if the medium is opaque at the wavelength.
/// \cost Four divisions and a square root.
// [refractive_index]
template <std::floating_point T>
[[nodiscard]] T refractive_index(const SellmeierT<T>& law, T nm) noexcept {
    const T square = nm * nm * T(1e-6);
    T n2 = T(1);
    for (std::size_t i = 0; i < law.b.size(); ++i)
        n2 += law.b[i] * square / (square - law.c[i]);
    return std::sqrt(n2);
}
// [refractive_index]

/// The index of refraction by Cauchy's formula, at a wavelength in nm, > 0.
template <std::floating_point T>
[[nodiscard]] constexpr T refractive_index(const CauchyT<T>& law, T nm) noexcept {
    return law.a + law.b / (nm * nm * T(1e-6));
}

/// Abbe's number \f$ V = (n_d - 1)/(n_F - n_C) \f$, where n_d, n_F and n_C are the
/// indices at 587.56, 486.13 and 656.27 nm. It is 64 for crown glass and 21 for heavy
/// flint. A smaller number gives a wider spectrum; without dispersion the number is
/// infinite, and NaN for an index of 1.
template <std::floating_point T, template <typename> typename Law>
[[nodiscard]] T abbe_number(const Law<T>& law) noexcept {
    return (refractive_index(law, line_d<T>) - T(1)) /
           (refractive_index(law, line_F<T>) - refractive_index(law, line_C<T>));
}

/// Cauchy's formula for a medium with the index n_d > 1 at 587.56 nm, and with Abbe's
/// number > 0.
// [cauchy_from_abbe]
template <std::floating_point T>
[[nodiscard]] constexpr CauchyT<T> cauchy_from_abbe(T index, T abbe) noexcept {
    const auto per_square = [](T nm) { return T(1e6) / (nm * nm); };
    const T b =
        (index - T(1)) / (abbe * (per_square(line_F<T>) - per_square(line_C<T>)));
    return {index - b * per_square(line_d<T>), b};
}
// [cauchy_from_abbe]

/// Measured media: crown glass N-BK7, flint glass SF10 and heavy flint N-SF66
/// \cite schott2017, water at 20 degrees Celsius \cite daimon2007, and diamond
/// \cite peter1923.
/// \{
template <std::floating_point T>
inline constexpr SellmeierT<T> bk7{{T(1.03961212), T(0.231792344), T(1.01046945)},
                                   {T(0.00600069867), T(0.0200179144), T(103.560653)}};
template <std::floating_point T>
inline constexpr SellmeierT<T> sf10{{T(1.61625977), T(0.259229334), T(1.07762317)},
                                    {T(0.0127534559), T(0.0581983954), T(116.60768)}};
template <std::floating_point T>
inline constexpr SellmeierT<T> sf66{{T(2.0245976), T(0.470187196), T(2.59970433)},
                                    {T(0.0147053225), T(0.0692998276), T(161.817601)}};
template <std::floating_point T>
inline constexpr SellmeierT<T> water{
    {T(0.5684027565), T(0.1726177391), T(0.02086189578), T(0.1130748688)},
    {T(0.005101829712), T(0.01821153936), T(0.02620722293), T(10.69792721)}};
template <std::floating_point T>
inline constexpr SellmeierT<T> diamond{{T(0.3306), T(4.3356)},
                                       {T(0.1750 * 0.1750), T(0.1060 * 0.1060)}};
/// \}

namespace detail {

// The eye's response in bands of 5 nm.
struct WavelengthTable {
    static constexpr int size = 94;
    std::array<RgbT<double>, size> colors{}; // of each band: the response over the mean
                                             // of its three channels
    std::array<double, size> sums{}; // of these means up to each band; the last is 1
};

// [wavelength table]
[[nodiscard, gnu::cold]] inline WavelengthTable make_wavelength_table() {
    WavelengthTable table;
    const auto [first, last] = visible<double>;
    RgbT<double> all{0};
    for (int i = 0; i < table.size; ++i) {
        const double nm = first + (last - first) * (i + 0.5) / table.size;
        const RgbT<double> pure = xyz_to_rgb(cie_observer(nm));
        all += table.colors[std::size_t(i)] = glm::max(pure, 0.0);
    }
    double sum = 0;
    for (std::size_t i = 0; i < table.colors.size(); ++i) {
        const RgbT<double> response = table.colors[i] / all;
        const double mean = (response.x + response.y + response.z) / 3;
        table.colors[i] = response / mean;
        table.sums[i] = sum += mean;
    }
    return table;
}
// [wavelength table]

[[nodiscard]] inline const WavelengthTable& wavelength_table() {
    static const WavelengthTable table = make_wavelength_table();
    return table;
}

// The band of a visible wavelength.
[[nodiscard]] inline std::size_t band_of(double nm) noexcept {
    const auto [first, last] = visible<double>;
    const double band = (nm - first) / (last - first) * WavelengthTable::size;
    return std::size_t(std::clamp(band, 0.0, WavelengthTable::size - 1.0));
}

} // namespace detail

/// The weight of a path with a single wavelength, as a colour: the eye's response to
/// the wavelength, divided by pdf_wavelength().
///
/// The response is the wavelength's colour in linear sRGB, with 0 in place of negative
/// channels. Each channel is scaled so that a constant spectrum is white. The response
/// and the density are constant in bands of 5 nm.
/// \param nm  The wavelength in nm, in [360, 830].
/// \return Three channels of at least 0 that add up to 3. The mean over
///         sample_wavelength() is (1, 1, 1).
template <std::floating_point T>
[[nodiscard]] RgbT<T> wavelength_color(T nm) {
    return RgbT<T>(detail::wavelength_table().colors[detail::band_of(double(nm))]);
}

/// The density of sample_wavelength(), per nm: the mean over the three channels of the
/// eye's response. It is 0 outside [360, 830] nm.
template <std::floating_point T>
[[nodiscard]] T pdf_wavelength(T nm) {
    const auto [first, last] = detail::visible<double>;
    if (!(double(nm) >= first && double(nm) <= last)) return T(0);
    const auto& sums = detail::wavelength_table().sums;
    const std::size_t band = detail::band_of(double(nm));
    const double before = band > 0 ? sums[band - 1] : 0;
    return T((sums[band] - before) * double(sums.size()) / (last - first));
}

/// Samples a wavelength in proportion to the eye's response. Nearby values of `u`, in
/// [0, 1), give nearby wavelengths.
/// \return The wavelength in nm, in [360, 830].
/// \cost A binary search among 94 bands.
template <std::floating_point T>
[[nodiscard]] T sample_wavelength(T u) {
    const auto [first, last] = detail::visible<double>;
    const auto& sums = detail::wavelength_table().sums;
    const auto band = detail::choose_interval(std::span<const double>(sums), double(u));
    return T(first + (last - first) * (band.index + band.within) / double(sums.size()));
}

/// \}

} // namespace ljus
