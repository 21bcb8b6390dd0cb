#pragma once

/// \file ljus/math/low_discrepancy.hpp
/// \brief Scrambled Sobol points: random numbers that fill space evenly.

#include <array>
#include <bit>

#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup low_discrepancy Low-discrepancy numbers
/// \brief Points that fill the unit cube more evenly than random ones.
///
/// The error of a mean over N random points falls like \f$N^{-1/2}\f$. For a smooth
/// function of few dimensions, the error with scrambled Sobol points falls almost like
/// \f$N^{-3/2}\f$. For a function with edges the error falls more slowly, but remains
/// below the error with random points.
/// \{

namespace detail {

/// The number of dimensions of sobol().
inline constexpr std::uint32_t sobol_dimensions = 16;

/// The direction numbers of all dimensions. If bit i of a point's index is set, the
/// coordinate in dimension d is combined with entry [d][i] by exclusive or.
using SobolTable = std::array<std::array<std::uint32_t, 32>, sobol_dimensions>;

/// Computes the direction numbers at compile time, by the recurrence of Joe and Kuo
/// \cite joe2008. Each dimension has a primitive polynomial, given by its degree s and
/// the bits a of its inner coefficients. Each dimension also has s odd numbers m.
[[nodiscard]] constexpr SobolTable make_sobol_table() noexcept {
    struct Seed {
        unsigned s, a, m[6];
    };
    constexpr Seed seeds[sobol_dimensions - 1] = {{1, 0, {1}},
                                                  {2, 1, {1, 3}},
                                                  {3, 1, {1, 3, 1}},
                                                  {3, 2, {1, 1, 1}},
                                                  {4, 1, {1, 1, 3, 3}},
                                                  {4, 4, {1, 3, 5, 13}},
                                                  {5, 2, {1, 1, 5, 5, 17}},
                                                  {5, 4, {1, 1, 5, 5, 5}},
                                                  {5, 7, {1, 1, 7, 11, 19}},
                                                  {5, 11, {1, 1, 5, 1, 1}},
                                                  {5, 13, {1, 1, 1, 3, 11}},
                                                  {5, 14, {1, 3, 5, 5, 31}},
                                                  {6, 1, {1, 3, 3, 9, 7, 49}},
                                                  {6, 13, {1, 1, 1, 15, 21, 21}},
                                                  {6, 16, {1, 3, 1, 13, 27, 49}}};
    SobolTable table{};
    for (unsigned i = 0; i < 32; ++i) table[0][i] = 1u << (31 - i);
    for (std::size_t d = 1; d < sobol_dimensions; ++d) {
        const Seed& seed = seeds[d - 1];
        for (unsigned i = 0; i < seed.s; ++i) table[d][i] = seed.m[i] << (31 - i);
        for (unsigned i = seed.s; i < 32; ++i) {
            table[d][i] = table[d][i - seed.s] ^ (table[d][i - seed.s] >> seed.s);
            for (unsigned k = 1; k < seed.s; ++k)
                if ((seed.a >> (seed.s - 1 - k)) & 1u) table[d][i] ^= table[d][i - k];
        }
    }
    return table;
}

/// The direction numbers combined for each hexadecimal digit of an index: entry
/// [d][g][digit] is the exclusive or of those of the bits of the g-th digit.
inline constexpr auto sobol_digits = [] {
    constexpr SobolTable table = make_sobol_table();
    std::array<std::array<std::array<std::uint32_t, 16>, 8>, sobol_dimensions> digits{};
    for (std::size_t d = 0; d < sobol_dimensions; ++d)
        for (std::size_t g = 0; g < 8; ++g)
            for (unsigned digit = 1; digit < 16; ++digit) {
                const auto lowest = static_cast<std::size_t>(std::countr_zero(digit));
                digits[d][g][digit] =
                    digits[d][g][digit & (digit - 1)] ^ table[d][4 * g + lowest];
            }
    return digits;
}();

/// One coordinate of a Sobol point \cite sobol1967.
/// \return The coordinate times 2^32. In each dimension, each of 2^m equal intervals
///         contains one of the first 2^m points.
/// \cost One exclusive or per hexadecimal digit of the index.
[[nodiscard]] constexpr std::uint32_t sobol(std::uint32_t index,
                                            std::uint32_t dimension) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t digit = 0; index != 0; ++digit, index >>= 4)
        bits ^= sobol_digits[dimension][digit][index & 15u];
    return bits;
}

[[nodiscard]] constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen's scrambling of one coordinate \cite owen1995, by a hash \cite burley2020.
/// Whether a bit is flipped depends on the seed and on all higher bits. This permutes
/// the halves of [0, 1), the halves of each half, and so on. The points therefore stay
/// evenly spread, and each point alone becomes uniform over [0, 1).
///
/// A bit of a sum or a product depends only on lower bits of the operands, but here a
/// bit must depend on the higher ones. The function therefore reverses the bits, hashes
/// them by sums and products, and reverses them again.
/// \param bits  The coordinate times 2^32.
/// \param seed  The seed, different for each dimension. Seeds that differ only in their
///              last bits give correlated dimensions.
// [owen]
[[nodiscard]] constexpr std::uint32_t owen_scrambled(std::uint32_t bits,
                                                     std::uint64_t seed) noexcept {
    const std::uint64_t key = mix_bits(seed);
    std::uint32_t x = reversed_bits(bits);
    x ^= x * 0x3d20adeau; // invertible, because the factor is even
    x += static_cast<std::uint32_t>(key);
    x *= static_cast<std::uint32_t>(key >> 32) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reversed_bits(x);
}
// [owen]

} // namespace detail

/// The random numbers of one path. The first 16 numbers are a scrambled Sobol point,
/// and all further ones are random. The points of all paths of a pass fill the unit
/// cube evenly.
///
/// Each number alone is uniform, so that expected values stay the same. The numbers of
/// one path are independent of each other.
struct SobolStream {
    std::uint64_t seed = 0;      ///< Seed of the scrambling; the same for all paths.
    std::uint32_t index = 0;     ///< Index of the Sobol point.
    std::uint32_t dimension = 0; ///< The next dimension.
    RandomStream rest{};         ///< Supplies the numbers after the last dimension.
};

/// The stream of one path; the parameters are those of random_stream(). Each iteration
/// has its own scrambling. The scrambling also changes after each 2^32 paths.
[[nodiscard]] constexpr SobolStream sobol_stream(std::uint64_t seed, Pass pass,
                                                 std::uint64_t iteration,
                                                 std::uint64_t path) noexcept {
    return {.seed = random_stream(~seed, pass, iteration, path >> 32).key,
            .index = static_cast<std::uint32_t>(path),
            .rest = random_stream(seed, pass, iteration, path)};
}

namespace detail {

/// A SobolStream that gives only the random numbers of `rest`.
[[nodiscard]] constexpr SobolStream without_points(const RandomStream& rest) noexcept {
    return {.dimension = sobol_dimensions, .rest = rest};
}

} // namespace detail

/// Moves `rest`, the random numbers that follow the Sobol point, to the start of a
/// bounce. The dimensions of the Sobol point are used one after the other, whatever the
/// bounce.
constexpr void start_bounce(SobolStream& stream, std::uint64_t bounce) noexcept {
    start_bounce(stream.rest, bounce);
}

/// The next number, uniform in [0, 1), never 1; uses one dimension.
/// \return A multiple of 2^-24 in float. In double, the numbers of the Sobol point are
///         multiples of 2^-32, and those after its last dimension multiples of 2^-53.
template <std::floating_point T = float>
[[nodiscard]] constexpr T next_1d(SobolStream& stream) noexcept {
    const std::uint32_t d = stream.dimension;
    if (d >= detail::sobol_dimensions) return next_1d<T>(stream.rest);
    ++stream.dimension;
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u; // adjacent seeds would correlate
    const std::uint32_t bits =
        detail::owen_scrambled(detail::sobol(stream.index, d), stream.seed + d * odd);
    if constexpr (sizeof(T) == 4)
        return static_cast<T>(bits >> 8) * T(0x1p-24);
    else
        return static_cast<T>(bits) * T(0x1p-32);
}

/// \}

} // namespace ljus
