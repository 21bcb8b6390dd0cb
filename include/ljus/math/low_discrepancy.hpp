#pragma once

/// \file ljus/math/low_discrepancy.hpp
/// \brief Scrambled Sobol points: random numbers that fill space evenly.

#include <array>

#include "ljus/math/random.hpp"

namespace ljus {

/// \defgroup low_discrepancy Low-discrepancy numbers
/// \brief Points that fill the unit cube more evenly than random ones.
///
/// The error of a mean of N random points falls like \f$N^{-1/2}\f$. The first
/// \f$2^m\f$ Sobol points put one point into each cell of every dyadic grid. For a
/// smooth function of few dimensions the error of scrambled points falls almost like
/// \f$N^{-3/2}\f$; with edges it is larger, but below that of random points.
/// \{

namespace detail {

/// The number of dimensions of sobol().
inline constexpr std::uint32_t sobol_dimensions = 16;

/// The direction numbers of all dimensions: bit i of the index flips the bits [d][i]
/// in dimension d.
using SobolTable = std::array<std::array<std::uint32_t, 32>, sobol_dimensions>;

/// Computes the direction numbers at compile time, by the recurrence of Joe and Kuo,
/// from a primitive polynomial (degree s, inner coefficients a) and s odd numbers per
/// dimension \cite joe2008.
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

inline constexpr SobolTable sobol_table = make_sobol_table();

/// One coordinate of a Sobol point \cite sobol1967.
/// \return The coordinate times 2^32. The first 2^m points are a (t,m,s)-net: t is 0
///         in each dimension alone and in dimensions 0 and 1 together.
/// \cost 32 exclusive ors, eight or four at a time.
[[nodiscard]] constexpr std::uint32_t sobol(std::uint32_t index,
                                            std::uint32_t dimension) noexcept {
    std::uint32_t bits = 0;
    for (std::size_t i = 0; i < 32; ++i) // without branches: bits are unpredictable
        bits ^= detail::sobol_table[dimension][i] & (0u - ((index >> i) & 1u));
    return bits;
}

[[nodiscard]] constexpr std::uint32_t reversed_bits(std::uint32_t x) noexcept {
    x = ((x >> 1) & 0x55555555u) | ((x & 0x55555555u) << 1);
    x = ((x >> 2) & 0x33333333u) | ((x & 0x33333333u) << 2);
    x = ((x >> 4) & 0x0f0f0f0fu) | ((x & 0x0f0f0f0fu) << 4);
    x = ((x >> 8) & 0x00ff00ffu) | ((x & 0x00ff00ffu) << 8);
    return (x >> 16) | (x << 16);
}

/// Owen's scrambling of one coordinate by a hash: whether a bit is flipped depends on
/// the seed and on all higher bits. This permutes the halves of [0, 1), the halves of
/// each half, and so on. The points therefore stay evenly spread, and each point alone
/// becomes uniform over [0, 1).
///
/// In a sum or a product, each bit depends on the same and on lower bits of the
/// operands only. The function therefore reverses the bits, hashes them by sums and
/// products, and reverses them again.
/// \param seed  Another seed per dimension; seeds that differ only in their last bits
///              give correlated dimensions.
/// \cite owen1995 \cite burley2020
// [owen]
[[nodiscard]] constexpr std::uint32_t owen_scrambled(std::uint32_t bits,
                                                     std::uint64_t seed) noexcept {
    const std::uint64_t key = mix_bits(seed);
    std::uint32_t x = reversed_bits(bits);
    x ^= x * 0x3d20adeau; // an even factor keeps this invertible
    x += static_cast<std::uint32_t>(key);
    x *= static_cast<std::uint32_t>(key >> 32) | 1u;
    x ^= x * 0x05526c56u;
    x ^= x * 0x53a22864u;
    return reversed_bits(x);
}
// [owen]

} // namespace detail

/// The numbers of one path among many that are to be spread evenly together. The first
/// sobol_dimensions numbers are a scrambled Sobol point; all further ones are random.
/// It is used like a RandomStream.
///
/// Each number is uniform, so that no mean changes. The numbers of one path are
/// independent; those of different paths are stratified.
struct SobolStream {
    std::uint64_t seed = 0;      ///< Seed of the scrambling; the same for all paths.
    std::uint32_t index = 0;     ///< Index of the point.
    std::uint32_t dimension = 0; ///< The next dimension.
    RandomStream rest{};         ///< Supplies the numbers after the last dimension.
};

/// The stream of one path.
/// \param seed       The user's seed.
/// \param pass       The pass that draws.
/// \param iteration  The repetition of the pass; each has its own scrambling.
/// \param path       The path's number in the pass; after 2^32 the scrambling changes.
/// \return A stream at dimension 0.
[[nodiscard]] constexpr SobolStream sobol_stream(std::uint64_t seed, Pass pass,
                                                 std::uint64_t iteration,
                                                 std::uint64_t path) noexcept {
    return {.seed = random_stream(~seed, pass, iteration, path >> 32).key,
            .index = static_cast<std::uint32_t>(path),
            .rest = random_stream(seed, pass, iteration, path)};
}

namespace detail {

/// A stream with random numbers only, for code that is compiled once for both kinds.
[[nodiscard]] constexpr SobolStream without_points(const RandomStream& rest) noexcept {
    return {.dimension = sobol_dimensions, .rest = rest};
}

} // namespace detail

/// Moves a stream to the start of a bounce. The dimensions of the Sobol point are not
/// reset: paths that draw equally often per bounce use the same dimensions there.
constexpr void start_bounce(SobolStream& stream, std::uint64_t bounce) noexcept {
    start_bounce(stream.rest, bounce);
}

/// The next number, uniform in [0, 1), never 1; uses one dimension.
/// \return A multiple of 2^-24 (float) or 2^-32 (double, while the dimensions last).
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

/// The next point of the unit square [0, 1)^2; uses two dimensions.
template <std::floating_point T = float>
[[nodiscard]] constexpr Vec2T<T> next_2d(SobolStream& stream) noexcept {
    const T x = next_1d<T>(stream);
    return {x, next_1d<T>(stream)};
}

/// The next point of the unit cube [0, 1)^3; uses three dimensions.
template <std::floating_point T = float>
[[nodiscard]] constexpr Vec3T<T> next_3d(SobolStream& stream) noexcept {
    const T x = next_1d<T>(stream);
    const T y = next_1d<T>(stream);
    return {x, y, next_1d<T>(stream)};
}

/// \}

} // namespace ljus
