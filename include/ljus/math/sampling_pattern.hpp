#pragma once

/// \file ljus/math/sampling_pattern.hpp
/// \brief The positions of rays within a pixel: four patterns for any number of rays.

#include <bit>
#include <cstdint>

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup sampling_pattern Sampling patterns
/// \brief Section 3.2 of the report: "stratified grid sampling", and later patterns.
/// Chapter:
/// \ref ch_first_picture.
/// \{

namespace detail {

/// The cells of a pixel, in a grid.
struct Strata {
    int columns = 1;      ///< The number of columns.
    int rows = 1;         ///< The number of rows.
    bool n_rooks = false; ///< Whether each column and each row has one ray.
};

/// The grid for a number of rays: one cell per ray, as square as possible. If the grid
/// would have more than four times as many rows as columns, as for a prime above 4, it
/// has n columns and n rows for n rays, with one ray in each column and in each row (n
/// rooks).
/// \erratum{The report's program steps by 1/sqrt(n) for n rays and drops the remainder.
///          It traced 4 of 8 rays. It traced 9 of 10 rays, all of them in nine tenths
///          of the pixel.}
[[nodiscard]] constexpr Strata strata_for(int rays) noexcept {
    int columns = 1;
    for (int i = 1; i <= rays / i; ++i)
        if (rays % i == 0) columns = i;
    const int rows = rays / columns;
    if (rows > 4 * columns) return {.columns = rays, .rows = rays, .n_rooks = true};
    return {.columns = columns, .rows = rows};
}

/// The value at index i of a random permutation of the numbers 0 to count - 1, from an
/// invertible hash of the numbers below the next power of two. The hash is repeated
/// until the value is below count. A random offset modulo count is added, because the
/// hash alone does not give each value equally often.
/// \param i      The index, in [0, count).
/// \param count  From 1 to 2^31.
/// \param key    The number of the permutation.
/// \return A number in [0, count), different for each i. Over all keys, each value is
///         equally likely.
/// \cost At most two hashes on average.
/// \cite kensler2013
[[nodiscard]] constexpr std::uint32_t shuffled(std::uint32_t i, std::uint32_t count,
                                               std::uint64_t key) noexcept {
    const std::uint32_t mask = std::bit_ceil(count) - 1;
    const std::uint64_t bits = mix_bits(key);
    const auto offset = static_cast<std::uint32_t>(bits);
    const auto factor = static_cast<std::uint32_t>(bits >> 32) | 1u;
    do {
        // Each step is a bijection of the numbers in [0, mask].
        i = (i * factor + offset) & mask;
        i ^= i >> 3;
        i = (i * 0x2c1b3c6du) & mask;
        i ^= i >> 5;
        i = (i * 0x297a2d39u) & mask;
        i ^= i >> 7;
    } while (i >= count);
    const std::uint64_t step = ((mix_bits(~bits) >> 32) * count) >> 32; // in [0, count)
    const std::uint64_t place = i + step; // a remainder would need a division
    return static_cast<std::uint32_t>(place < count ? place : place - count);
}

/// The position of one ray within its pixel.
/// \return Point of the unit square, uniform over all rays and keys. A coordinate may
///         be rounded to the far border of its cell, and so to 1.
/// \report{Section 3.2}
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> stratified(const Strata& strata, int ray,
                                            std::uint64_t key,
                                            const Vec2T<T>& u) noexcept {
    const int column = ray % strata.columns;
    const auto row =
        strata.n_rooks
            ? static_cast<int>(shuffled(static_cast<std::uint32_t>(ray),
                                        static_cast<std::uint32_t>(strata.rows), key))
            : ray / strata.columns;
    return {(T(column) + u.x) / T(strata.columns), (T(row) + u.y) / T(strata.rows)};
}

} // namespace detail

/// How the rays of a pixel are spread over the pixel. Every pattern has exactly the
/// requested number n of points. One of them, chosen at random, is uniform over the
/// pixel, so that the pattern does not change the mean of a pixel.
enum class Sampling : std::uint8_t {
    random, ///< Independent points.
    /// One point in each cell of a grid. If the grid would be too long and narrow, each
    /// of n columns and each of n rows has one point.
    jittered,
    /// Jittered points, exactly one in each of n columns and in each of n rows.
    multi_jittered,
    sobol ///< Sobol points with Owen's scrambling.
};

/// A pattern for one number of points, made by make_pattern().
struct Pattern {
    Sampling sampling = Sampling::multi_jittered; ///< How the points are spread.
    int points = 1;                               ///< The number of points.
    detail::Strata strata{};                      ///< The cells of a jittered pattern.
};

/// Makes a pattern of at least one point.
[[nodiscard]] constexpr Pattern make_pattern(Sampling sampling, int points) noexcept {
    Pattern pattern{.sampling = sampling, .points = points};
    if (sampling == Sampling::jittered) pattern.strata = detail::strata_for(points);
    if (sampling == Sampling::multi_jittered) {
        pattern.strata = detail::strata_for(points);
        int& columns = pattern.strata.columns;
        if (pattern.strata.n_rooks || pattern.strata.rows > 2 * columns) {
            columns = 1;
            while (columns + 1 <= points / (columns + 1)) ++columns;
        }
        const int rows = (points - 1) / columns + 1; // the last may be incomplete
        pattern.strata = {.columns = columns, .rows = rows};
    }
    return pattern;
}

namespace detail {

/// Finds the x of point number i of a multi-jittered pattern whose last row is
/// incomplete. The pixel is divided from left to right into as many narrow strips as
/// there are points. A column of the pattern covers one strip for each of its points;
/// columns with a point in the last row are therefore wider. The wider columns are
/// spread evenly over the pixel from a random start. Finally all strips are shifted
/// cyclically by the same random number, so that each strip is equally likely.
/// \return The strip, in [0, points), different for each i.
[[nodiscard]] constexpr std::uint32_t
strip_of_broken(const Pattern& pattern, std::uint32_t i, std::uint64_t key) noexcept {
    const auto all = static_cast<std::uint32_t>(pattern.points);
    const auto m = static_cast<std::uint32_t>(pattern.strata.columns);
    const std::uint32_t row = i / m, full = all / m, last = all % m;
    const std::uint64_t bits = mix_bits(key + 1);
    const std::uint64_t start = ((bits >> 32) * m) >> 32; // in [0, m)
    const std::uint64_t step = ((bits & 0xffffffffu) * all) >> 32;
    // How many of the first c columns have a point in the last row.
    const auto before = [&](std::uint64_t c) { return (c * last + start) / m; };
    std::uint64_t column = shuffled(i % m, m, key);
    if (row == full) // the k-th column with a point in the last row
        column = (shuffled(i % m, last, key) * std::uint64_t(m) + m - 1 - start) / last;
    const auto points =
        static_cast<std::uint32_t>(full + before(column + 1) - before(column));
    const std::uint64_t strip =
        column * full + before(column) + shuffled(row, points, ~key);
    return static_cast<std::uint32_t>((strip + step) % all);
}

/// A point of a correlated multi-jittered pattern.
/// The points lie in a grid of m columns and n rows. The last row may be incomplete, so
/// that the number of points can be a prime. The square is also divided along x and
/// along y into as many strips as there are points. Each strip has one point.
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
    const bool broken = static_cast<std::uint32_t>(pattern.points) < m * n;
    const std::uint32_t strip =
        broken ? strip_of_broken(pattern, i, key)
               : shuffled(i % m, m, key) * n + shuffled(i / m, n, ~key);
    return {(T(strip) + u.x) / T(pattern.points),
            (T(number) + u.y) / T(pattern.points)};
}
// [multi_jittered]

/// Point `number` of the Sobol sequence, scrambled by `key`. If the unit square is
/// divided into 2^k cells, and the numbers of columns and rows are powers of two, each
/// cell has one of the first 2^k points.
/// \return Point of the unit square, with coordinates below 1.
/// \cite owen1995 \cite burley2020
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> scrambled_sobol(int number,
                                                 std::uint64_t key) noexcept {
    SobolStream stream{.seed = mix_bits(key),
                       .index = static_cast<std::uint32_t>(number)};
    return next_2d<T>(stream);
}

} // namespace detail

/// A point of a pattern: the position of one ray within its pixel.
/// \param pattern  The pattern, made by make_pattern().
/// \param number   The number of the point, in [0, pattern.points).
/// \param key      The pixel's key. The points of two pixels are independent if their
///                 keys differ; mix_bits() makes good keys of consecutive numbers.
/// \param u        Two random numbers in [0, 1); Sobol points do not use them.
/// \return Point of the unit square, uniformly distributed for random `key`, `u` and
///         `number`. A coordinate may be rounded to 1.
/// \cost Some nanoseconds.
/// \report{Section 3.2}
// [spread]
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> spread(const Pattern& pattern, int number,
                                        std::uint64_t key, const Vec2T<T>& u) noexcept {
    switch (pattern.sampling) {
    case Sampling::jittered:
        return detail::stratified(pattern.strata, number, key, u);
    case Sampling::multi_jittered:
        return detail::multi_jittered(pattern, number, key, u);
    case Sampling::sobol:
        return detail::scrambled_sobol<T>(number, key);
    default:
        return u;
    }
}
// [spread]

/// \}

} // namespace ljus
