#pragma once

/// \file ljus/math/random.hpp
/// \brief Random numbers that depend on where they are used, not on the order in which
/// they are drawn.

#include <cstdint>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup random Random streams
/// \brief Counter-based streams: a number depends only on the key of its stream and on
/// its index, so that the same seed gives the same picture on any number of threads.
/// \{

/// The passes that draw numbers; each has its own streams.
enum class Pass : std::uint32_t {
    camera,           ///< Camera paths.
    general_photons,  ///< Photons of the general map.
    caustics_photons, ///< Photons of the caustics map.
    form_factors,     ///< Rays between the patches of radiosity.
    irradiance,       ///< Precomputed irradiance at photons.
    gathering,        ///< Final gathering for the irradiance cache.
    user = 1000       ///< The first value free for user-defined passes.
};

/// Mixes 64 bits: on average, a change of one input bit changes half of the output
/// bits. The function is a bijection, the finaliser of SplitMix64 \cite steele2014.
[[nodiscard]] constexpr std::uint64_t mix_bits(std::uint64_t x) noexcept {
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// The random numbers of one path. Number n depends on the key and on n only. The
/// bounce is n >> 16, and the dimension within the bounce is in the lower 16 bits of n.
struct RandomStream {
    std::uint64_t key = 0;     ///< Made by random_stream() from seed, pass and path.
    std::uint64_t counter = 0; ///< The index n of the next number.
};

/// The stream of one path.
/// \param seed       The user's seed.
/// \param pass       The pass that draws the numbers.
/// \param iteration  The repetition of the pass, for progressive methods.
/// \param path       The path's number in the pass.
/// \return A stream at bounce 0, dimension 0.
[[nodiscard]] constexpr RandomStream random_stream(std::uint64_t seed, Pass pass,
                                                   std::uint64_t iteration,
                                                   std::uint64_t path) noexcept {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u; // 2^64 over the golden ratio
    const std::uint64_t work =
        mix_bits(mix_bits(seed + odd) + static_cast<std::uint64_t>(pass));
    return {
        .key = mix_bits(mix_bits(work + odd * (iteration + 1)) ^ mix_bits(path + odd))};
}

/// Moves a stream to the start of a bounce; bounce 0 is the camera or the light. The
/// numbers of a bounce do not depend on how many numbers were drawn before.
constexpr void start_bounce(RandomStream& stream, std::uint64_t bounce) noexcept {
    stream.counter = bounce << 16;
}

/// The next number, uniform in [0, 1), never 1; uses one dimension.
/// \return A multiple of 2^-24 (float) or 2^-53 (double).
/// \cost Three multiplications and a few shifts.
template <std::floating_point T = float>
[[nodiscard]] constexpr T next_1d(RandomStream& stream) noexcept {
    constexpr std::uint64_t odd = 0x9e3779b97f4a7c15u;
    const std::uint64_t bits = mix_bits(stream.key + odd * ++stream.counter);
    if constexpr (sizeof(T) == 4)
        return static_cast<T>(bits >> 40) * T(0x1p-24);
    else
        return static_cast<T>(bits >> 11) * T(0x1p-53);
}

/// A source of random numbers: a copyable struct for which these functions are defined.
///
/// | function                     | what it does                                      |
/// |------------------------------|---------------------------------------------------|
/// | next_1d<T>(stream)           | returns the next number of [0, 1)                 |
/// | start_bounce(stream, bounce) | moves to the numbers of a bounce, which do not    |
/// |                              | depend on what was drawn before                   |
///
/// It may have its own next_2d<T>(stream) and next_3d<T>(stream) in place of those
/// below. Copies of a stream draw the same numbers. The `Stream` of a renderer must
/// also have a member `key` and a function `start_ray(stream, seed, pixel, ray,
/// pattern)`, like those of StratifiedStream.
template <typename S>
concept StreamLike = std::copyable<S> && requires(S& stream, std::uint64_t bounce) {
    { next_1d<float>(stream) } -> std::same_as<float>;
    { next_1d<double>(stream) } -> std::same_as<double>;
    start_bounce(stream, bounce);
};

/// The next point of the unit square [0, 1)^2: two numbers.
template <std::floating_point T = float, StreamLike Stream>
[[nodiscard]] constexpr Vec2T<T> next_2d(Stream& stream) noexcept {
    const T x = next_1d<T>(stream);
    return {x, next_1d<T>(stream)};
}

/// The next point of the unit cube [0, 1)^3: three numbers.
template <std::floating_point T = float, StreamLike Stream>
[[nodiscard]] constexpr Vec3T<T> next_3d(Stream& stream) noexcept {
    const T x = next_1d<T>(stream);
    const T y = next_1d<T>(stream);
    return {x, y, next_1d<T>(stream)};
}

/// \}

} // namespace ljus
