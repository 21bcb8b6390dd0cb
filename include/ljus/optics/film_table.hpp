#pragma once

/// \file ljus/optics/film_table.hpp
/// \brief A table of the colours of all films of one liquid.

#include <cmath>
#include <vector>

#include "ljus/math/require.hpp"
#include "ljus/optics/film_color.hpp"

namespace ljus {

/// \addtogroup film_color
/// \{

/// A table of the colours of films of one index n, over the angle of the ray and the
/// optical path n d cos(theta_t), where d is the thickness and theta_t the angle inside
/// the film. The columns are evenly spaced in the square root of the cosine outside the
/// film, because the reflectance is steep near grazing incidence. The rows are evenly
/// spaced in the square root of the optical path, because fringes fade with longer
/// paths.
template <std::floating_point T>
struct FilmTableT {
    T index = T(0);   ///< Index of the films; 0 if there is no table.
    int cosines = 0;  ///< Number of columns, for cosines from 0 to 1.
    int paths = 0;    ///< Number of rows, for optical paths from 0 to `longest`.
    T longest = T(0); ///< The optical path above which colours have faded, in nm.
    /// The colours, in [0, 1]: the rows of the table, then a row with the means over
    /// all phases.
    std::vector<RgbT<T>> cells{};
    int greyed = 0; ///< Number of cells that into_gamut() has changed.
    T worst = T(0); ///< The most negative channel before into_gamut().
};
using FilmTable = FilmTableT<float>; ///< FilmTableT in float.

namespace detail {

/// The resolution of a table.
struct FilmTableSize {
    int cosines = 65; ///< Number of cosines, at least 2.
    /// Number of optical paths, at least 2; the row of means is not counted.
    int paths = 641;
    double longest = 4000; ///< The longest optical path, in nm.
};

// Wavelengths evenly spaced over the visible range, in nm, and the eye's response to
// each.
struct FilmSpectrum {
    std::vector<double> wavelengths{};
    std::vector<Vec3T<double>> eye{};
    Vec3T<double> white{0}; // the sum of `eye`
};

// The spacing of the wavelengths resolves the fringes of the longest path; see
// film_spectral().
[[nodiscard]] inline FilmSpectrum film_spectrum(double longest) {
    const double first = visible<double>[0], last = visible<double>[1];
    const double finest = first * first / (4 * std::numbers::pi * longest);
    const int count =
        static_cast<int>(std::ceil((last - first) / std::min(2.0, finest)));
    const double step = (last - first) / count;
    FilmSpectrum spectrum;
    for (int i = 0; i < count; ++i) {
        spectrum.wavelengths.push_back(first + (i + 0.5) * step);
        spectrum.white +=
            spectrum.eye.emplace_back(cie_observer(spectrum.wavelengths.back()));
    }
    return spectrum;
}

// Moves a colour into the range of a screen and appends it to a table.
template <std::floating_point T>
void add_cell(FilmTableT<T>& table, const RgbT<double>& color) {
    const RgbT<double> shown = into_gamut(color);
    if (shown != color) ++table.greyed;
    table.worst = std::min(table.worst, static_cast<T>(-max_component(-color)));
    table.cells.push_back(RgbT<T>(shown));
}

} // namespace detail

/// Makes the table for one index, in [1, 1000]. It is computed in double. The default
/// size has 42 000 colours, half a megabyte in float.
/// \throws std::invalid_argument  if the index or a size is out of range.
/// \cost With the default size, it takes 10 million samples in about 0.1 s.
template <std::floating_point T = float>
[[nodiscard]] FilmTableT<T> bake_film_table(T index,
                                            const detail::FilmTableSize& size = {}) {
    require(index >= T(1) && index <= T(1000), "the index of a film", index,
            "within [1, 1000]");
    require_at_least("cosines", size.cosines, 2);
    require_at_least("paths", size.paths, 2);
    require_positive("longest", size.longest);

    const double n = double(index);
    const detail::FilmSpectrum spectrum = detail::film_spectrum(size.longest);
    FilmTableT<T> table{.index = index,
                        .cosines = size.cosines,
                        .paths = size.paths,
                        .longest = static_cast<T>(size.longest)};
    table.cells.reserve(static_cast<std::size_t>(size.cosines) *
                        static_cast<std::size_t>(size.paths + 1));
    const auto cosine = [&](int column) {
        const double root = double(column) / (size.cosines - 1);
        return root * root;
    };
    std::vector<double> sines(spectrum.eye.size());
    for (int row = 0; row < size.paths; ++row) {
        const double root = double(row) / (size.paths - 1);
        const double path = size.longest * root * root;
        for (std::size_t i = 0; i < sines.size(); ++i)
            sines[i] = std::sin(2 * std::numbers::pi * path / spectrum.wavelengths[i]);
        for (int column = 0; column < size.cosines; ++column) {
            const double c = cosine(column);
            const double g = std::sqrt(film_cosine2(c, n));
            const double strength = g > 0 ? (n - 1) * (n + 1) / g : 0.0;
            Vec3T<double> sum{0};
            for (std::size_t i = 0; i < sines.size(); ++i)
                sum +=
                    spectrum.eye[i] * film_shares(c, n, strength * sines[i]).reflected;
            detail::add_cell(table, xyz_to_rgb(sum / spectrum.white));
        }
    }
    for (int column = 0; column < size.cosines; ++column)
        detail::add_cell(table, RgbT<double>{thick_film(cosine(column), n)});
    return table;
}

/// The colour of a film, interpolated in a table, as linear sRGB, each channel in
/// [0, 1]. Beyond the longest optical path it is the mean over all phases.
/// \cost Three square roots, a division and four table entries.
template <std::floating_point T>
[[nodiscard]] RgbT<T> look_up(const FilmTableT<T>& table, T cos_theta,
                              T thickness) noexcept {
    const T path = thickness * std::sqrt(film_cosine2(cos_theta, table.index));
    const T y = std::sqrt(path / table.longest) * static_cast<T>(table.paths - 1);
    const T x = std::sqrt(cos_theta) * static_cast<T>(table.cosines - 1);
    const int column = std::min(static_cast<int>(x), table.cosines - 2);
    const T right = x - static_cast<T>(column);
    const auto in_row = [&](int row) {
        const auto* cell = table.cells.data() + row * table.cosines + column;
        return glm::mix(cell[0], cell[1], right);
    };
    // Written so that infinity and NaN count as thick.
    if (!(y < static_cast<T>(table.paths - 1))) return in_row(table.paths);
    const int row = static_cast<int>(y);
    return glm::mix(in_row(row), in_row(row + 1), y - static_cast<T>(row));
}

/// \}

} // namespace ljus
