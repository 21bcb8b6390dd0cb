#pragma once

/// \file ljus/math/piecewise_constant.hpp
/// \brief Samples the cells of a grid in proportion to their weights.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup piecewise_constant Piecewise constant densities
/// \brief Sampling, by inversion, of a density that is constant in each cell of a grid
/// \cite pharr2023. A picture that serves as a light has such a density. Chapter:
/// \ref ch_environment.
/// \{

/// Cumulative sums of the weights of a grid's cells, for sample_cell(). They are
/// double, because one cell may weigh 1e9 times as much as its neighbours.
struct PiecewiseConstant2D {
    int width = 0;  ///< Cells per row.
    int height = 0; ///< Number of rows.
    /// For each row, the sum of all weights in this row and in earlier rows.
    std::vector<double> rows;
    /// For each cell, the sum of its weight and of the weights of earlier cells in its
    /// row.
    std::vector<double> cells;
};

/// Computes the cumulative sums of a grid's weights.
/// \param width   Cells per row, at least 1.
/// \param height  Number of rows, at least 1.
/// \param weight  Called as weight(x, y) for each cell; returns at least 0.
/// \throws std::invalid_argument  if the sum of all weights is 0 or not finite.
template <typename Weight>
[[nodiscard]] PiecewiseConstant2D make_piecewise_constant(int width, int height,
                                                          const Weight& weight) {
    PiecewiseConstant2D made{.width = width, .height = height, .rows{}, .cells{}};
    made.rows.reserve(static_cast<std::size_t>(height));
    made.cells.reserve(static_cast<std::size_t>(width) *
                       static_cast<std::size_t>(height));
    double all = 0;
    for (int y = 0; y < height; ++y) {
        double row = 0;
        for (int x = 0; x < width; ++x)
            made.cells.push_back(row += double(weight(x, y)));
        made.rows.push_back(all += row);
    }
    require_positive("the sum of all weights", all);
    return made;
}

/// A cell, and a point in it.
template <std::floating_point T>
struct CellT {
    int x = 0;             ///< Column.
    int y = 0;             ///< Row.
    Vec2T<T> within{T(0)}; ///< Position in the cell, in [0, 1]^2.
};

namespace detail {

[[nodiscard]] inline std::span<const double> row_of(const PiecewiseConstant2D& density,
                                                    int y) noexcept {
    const auto width = static_cast<std::size_t>(density.width);
    return std::span(density.cells).subspan(static_cast<std::size_t>(y) * width, width);
}

template <std::floating_point T>
struct ChosenIntervalT {
    int index = 0;   ///< The number of the interval.
    T within = T(0); ///< Position in the interval, in [0, 1].
};

/// Chooses an interval with a probability proportional to its length, and a position in
/// the interval, uniformly.
/// \param sums  For each interval, the sum of the lengths up to its end.
/// \param u     A random number in [0, 1).
// [choose_interval]
template <std::floating_point T>
[[nodiscard]] ChosenIntervalT<T> choose_interval(std::span<const double> sums,
                                                 T u) noexcept {
    // The position stays below the sum of all lengths, and so within an interval whose
    // length is not 0.
    const double place =
        std::min(double(u) * sums.back(), std::nextafter(sums.back(), 0.0));
    const auto end = std::upper_bound(sums.begin(), sums.end(), place);
    const double begin = end == sums.begin() ? 0.0 : *(end - 1);
    return {static_cast<int>(end - sums.begin()),
            static_cast<T>((place - begin) / (*end - begin))};
}
// [choose_interval]

} // namespace detail

/// Chooses a cell with a probability proportional to its weight, and a point in the
/// cell, uniformly. Nearby values of u give nearby points, so that stratified values
/// give stratified points.
/// \return A cell whose weight is not 0.
/// \cost Two binary searches.
// [sample_cell]
template <std::floating_point T>
[[nodiscard]] CellT<T> sample_cell(const PiecewiseConstant2D& density,
                                   const Vec2T<T>& u) noexcept {
    const auto row = detail::choose_interval(std::span(density.rows), u.y);
    const auto cell = detail::choose_interval(detail::row_of(density, row.index), u.x);
    return {cell.index, row.index, {cell.within, row.within}};
}
// [sample_cell]

/// The probability that sample_cell() chooses the cell in column x and row y: the
/// cell's weight over the sum of all weights.
[[nodiscard]] inline double probability_of_cell(const PiecewiseConstant2D& density,
                                                int x, int y) noexcept {
    const auto row = detail::row_of(density, y);
    const auto column = static_cast<std::size_t>(x);
    const double before = x == 0 ? 0.0 : row[column - 1];
    return (row[column] - before) / density.rows.back();
}

/// \}

} // namespace ljus
