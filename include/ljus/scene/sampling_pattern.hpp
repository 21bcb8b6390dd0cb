#pragma once

/// \file ljus/scene/sampling_pattern.hpp
/// \brief Where the rays of a pixel go through it: four patterns for any
/// number.

#include <cstdint>

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/scene/stratified.hpp"

namespace ljus {

/// \defgroup sampling_pattern Sampling patterns
/// \brief Section 3.2: "stratified grid sampling", and what came after it. Chapter:
/// \ref ch_first_picture.
/// \{

/// How the rays of a pixel are spread over it. Every pattern has exactly as many points
/// as are asked for, each of them uniform over the pixel, so that no mean changes.
enum class Sampling : std::uint8_t {
    random,         ///< Each for itself.
    jittered,       ///< One in each of a x b = n cells; rooks where n is prime.
    multi_jittered, ///< The same, and evenly spread along x and y too; any n.
    sobol           ///< The first n points of Sobol, scrambled after Owen.
};

/// A pattern that is ready for its points.
struct Pattern {
    Sampling sampling = Sampling::multi_jittered; ///< Which one.
    int points = 1;                               ///< How many there will be.
    Strata strata{};                              ///< Its cells, if it has any.
};

/// Prepares a pattern.
/// \param sampling  Which one.
/// \param points    At least 1.
/// \return The pattern.
// [make_pattern]
[[nodiscard]] constexpr Pattern make_pattern(Sampling sampling, int points) noexcept {
    Pattern pattern{.sampling = sampling, .points = points};
    if (sampling == Sampling::jittered) pattern.strata = strata_for(points);
    if (sampling == Sampling::multi_jittered) {
        int columns = 1;
        while (columns + 1 <= points / (columns + 1)) ++columns;
        const int rows = (points - 1) / columns + 1; // the last may be part of a row
        pattern.strata = {.columns = columns, .rows = rows};
    }
    return pattern;
}
// [make_pattern]

/// A point of a correlated multi-jittered pattern.
///
/// The points stand in a grid of m columns and n rows, of which the last may be broken
/// off: that is how a prime has its place. Within its cell a point stands, in x, at a
/// place that its row has and, in y, at one that its column has, so that the whole
/// pattern is evenly spread along both sides as well.
/// \param pattern  From make_pattern().
/// \param number   Which point, in [0, points).
/// \param key      Of the pixel; another order of rows and columns for each.
/// \param u        Where in the cell of the cell: point of the unit square.
/// \return Point of the unit square; rounding may put it onto 1.
/// \cite kensler2013
// [multi_jittered]
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> multi_jittered(const Pattern& pattern, int number,
                                                std::uint64_t key,
                                                const Vec2T<T>& u) noexcept {
    const auto m = static_cast<std::uint32_t>(pattern.strata.columns);
    const auto n = static_cast<std::uint32_t>(pattern.strata.rows);
    const auto i = static_cast<std::uint32_t>(number);
    const std::uint32_t column = shuffled(i % m, m, key);
    const std::uint32_t place = shuffled(i / m, n, ~key);
    return {(T(column) + (T(place) + u.x) / T(n)) / T(m),
            (T(number) + u.y) / T(pattern.points)};
}
// [multi_jittered]

/// One of Sobol's points, scrambled.
/// \param number  Which point.
/// \param key     Of the pixel; another scrambling for each.
/// \return Point of the unit square, below 1. The first 2^k points lie one in each cell
///         of every dyadic grid of 2^k cells.
/// \cite owen1995 \cite burley2020
// [scrambled_sobol]
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> scrambled_sobol(int number,
                                                 std::uint64_t key) noexcept {
    SobolStream stream{.seed = mix(key), .index = static_cast<std::uint32_t>(number)};
    return next_2d<T>(stream);
}
// [scrambled_sobol]

/// The place of one ray within its pixel.
/// \param pattern  From make_pattern().
/// \param number   Which of its points, in [0, points); the order means nothing.
/// \param key      Of the pixel: the pixels of a picture shall not repeat each other.
/// \param u        Two random numbers in [0, 1), which Sobol's points leave unused.
/// \return Point of the unit square, uniform over keys and u; rounding may put it onto
///         1.
/// \cost In nanoseconds a point, at 64 and at 61 of them: see the chapter's table.
/// \report{Section 3.2}
// [spread]
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> spread(const Pattern& pattern, int number,
                                        std::uint64_t key, const Vec2T<T>& u) noexcept {
    switch (pattern.sampling) {
    case Sampling::jittered:
        return stratified(pattern.strata, number, key, u);
    case Sampling::multi_jittered:
        return multi_jittered(pattern, number, key, u);
    case Sampling::sobol:
        return scrambled_sobol<T>(number, key);
    default:
        return u;
    }
}
// [spread]

/// \}

} // namespace ljus
