#pragma once

/// \file ljus/scene/stratified.hpp
/// \brief Primary rays spread evenly over a pixel, for any number of them.

#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup stratified Stratified primary rays
/// \brief Section 3.2: "stratified grid sampling".
/// \{

/// A pixel cut into columns x rows cells, or only into columns and rows.
struct Strata {
    int columns = 1;    ///< Cells side by side.
    int rows = 1;       ///< Cells above each other.
    bool rooks = false; ///< One ray in each column and one in each row: `columns` rays.
};

/// The cells for a number of rays: exactly as many as rays, as square as the number
/// allows; for a prime, or a number with only long factors, rooks that do not attack
/// each other.
/// \param rays  At least 1.
/// \return The cells.
/// \erratum{The report's program steps by 1/sqrt(n) and drops the remainder: of 8 rays
///          it traced 4, and of 10 it traced 9 in nine tenths of the pixel.}
[[nodiscard]] constexpr Strata strata_for(int rays) noexcept {
    int columns = 1;
    for (int i = 1; i <= rays / i; ++i)
        if (rays % i == 0) columns = i;
    const int rows = rays / columns;
    if (rows > 4 * columns) return {.columns = rays, .rows = rays, .rooks = true};
    return {.columns = columns, .rows = rows};
}

/// A number's place in a random order of 0 ... count - 1, without a table: rounds of an
/// invertible scramble within the next power of two, repeated until it lands inside;
/// then all places are moved on by the same random step, because the scramble alone
/// favours some places by half.
/// \param i      In [0, count).
/// \param count  At least 1.
/// \param key    Which order.
/// \return The place; each place once, and each as often as any over the keys.
/// \cost At most two scrambles in the mean.
/// \cite kensler2013
// [shuffled]
[[nodiscard]] constexpr std::uint32_t shuffled(std::uint32_t i, std::uint32_t count,
                                               std::uint64_t key) noexcept {
    std::uint32_t mask = count - 1;
    for (unsigned shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
    const std::uint64_t bits = mix(key);
    const auto offset = static_cast<std::uint32_t>(bits);
    const auto factor = static_cast<std::uint32_t>(bits >> 32) | 1u;
    do {
        // Each step is a bijection of the numbers up to the mask.
        i = (i * factor + offset) & mask;
        i ^= i >> 3;
        i = (i * 0x2c1b3c6du) & mask;
        i ^= i >> 5;
        i = (i * 0x297a2d39u) & mask;
        i ^= i >> 7;
    } while (i >= count);
    const std::uint64_t step = ((mix(~bits) >> 32) * count) >> 32; // in [0, count)
    return static_cast<std::uint32_t>((i + step) % count);
}
// [shuffled]

/// The place of one ray within its pixel.
/// \param strata  From strata_for().
/// \param ray     Its number, in [0, rays).
/// \param key     Of the pixel; decides which rooks stand where.
/// \param u       Where in its cell: point of the unit square.
/// \return Point of the unit square, uniform over all rays and keys; rounding may put
///         it onto the far border of its cell, and so onto 1.
/// \report{Section 3.2}
// [stratified]
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> stratified(const Strata& strata, int ray,
                                            std::uint64_t key,
                                            const Vec2T<T>& u) noexcept {
    const int column = ray % strata.columns;
    const auto row =
        strata.rooks
            ? static_cast<int>(shuffled(static_cast<std::uint32_t>(ray),
                                        static_cast<std::uint32_t>(strata.rows), key))
            : ray / strata.columns;
    return {(T(column) + u.x) / T(strata.columns), (T(row) + u.y) / T(strata.rows)};
}
// [stratified]

/// \}

} // namespace ljus
