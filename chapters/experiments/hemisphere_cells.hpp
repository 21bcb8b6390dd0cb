#pragma once

/// \file chapters/experiments/hemisphere_cells.hpp
/// \brief Directions counted in cells of the hemisphere, and the chi-square test.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "ljus/math/vector.hpp"

namespace examples {

/// The probability that a chi-square variable is larger: Wilson and Hilferty's cube.
/// \param sum      The variable.
/// \param freedom  Its degrees, at least 3.
/// \return In [0, 1], within 0.01.
[[nodiscard]] inline double chi_square_p(double sum, double freedom) {
    const double a = 2 / (9 * freedom);
    const double z = (std::cbrt(sum / freedom) - (1 - a)) / std::sqrt(a);
    return std::erfc(z / std::numbers::sqrt2) / 2;
}

/// The hemisphere, cut into cells of the same solid angle.
struct HemisphereCells {
    static constexpr int rows = 16;    ///< In z.
    static constexpr int columns = 12; ///< In azimuth.

    /// The cell of a direction.
    [[nodiscard]] static std::size_t of(const ljus::Vec3T<double>& d) {
        const double phi = std::atan2(d.y, d.x) / (2 * std::numbers::pi);
        const auto cut = [](double x, int count) {
            return std::min(static_cast<int>(std::max(x, 0.0) * count), count - 1);
        };
        const int row = cut(d.z, rows);
        return static_cast<std::size_t>(row * columns +
                                        cut(phi < 0 ? phi + 1 : phi, columns));
    }

    /// The integral of a pdf over each cell, by the midpoint rule in both angles: a
    /// pdf that grows as 1/sin(theta) is no trouble.
    template <typename Pdf>
    [[nodiscard]] static std::vector<double> integrals(const Pdf& pdf) {
        constexpr int fine = 40;
        std::vector<double> cells(rows * columns);
        for (int row = 0; row < rows; ++row) {
            const double low = std::acos((row + 1.0) / rows);
            const double step = (std::acos(double(row) / rows) - low) / fine;
            for (int i = 0; i < fine; ++i)
                for (int j = 0; j < columns * fine; ++j) {
                    const double theta = low + (i + 0.5) * step;
                    const double width = 2 * std::numbers::pi / (columns * fine);
                    const double phi = (j + 0.5) * width;
                    const double sine = std::sin(theta);
                    const ljus::Vec3T<double> d{sine * std::cos(phi),
                                                sine * std::sin(phi), std::cos(theta)};
                    cells[of(d)] += double(pdf(d)) * sine * step * width;
                }
        }
        return cells;
    }
};

} // namespace examples
