#pragma once

/// \file ljus/math/stratified_stream.hpp
/// \brief Random numbers that are stratified over the rays of a pixel.

#include <limits>

#include "ljus/math/sampling_pattern.hpp"

namespace ljus {

/// \defgroup stratified_stream Stratified streams
/// \brief Section 2.1 of the report, distributed rays: the rays of a pixel are spread
/// evenly over the pixel, the lens, the time, each light and each lobe \cite cook1984.
/// Chapter:
/// \ref ch_distributed_rays.
/// \{

/// The random numbers of one ray of a pixel. In each draw, the pattern spreads the
/// numbers of the pixel's rays evenly over [0, 1) or the unit square. Each draw
/// permutes the rays in a different way, so that a ray's time does not depend on its
/// position on the lens.
struct StratifiedStream {
    Pattern pattern{};     ///< The pattern of the pixel's rays.
    int ray = 0;           ///< The ray's number, in [0, pattern.points).
    std::uint64_t key = 0; ///< A random number that is the same in all rays of a pixel.
    std::uint64_t dimension = 0; ///< The index of the next draw.
    RandomStream rest{};         ///< Numbers for positions within cells of the pattern.
};

/// Sets a stream to the numbers of one ray of a pixel.
/// \param stream   The stream that is set.
/// \param seed     The user's seed.
/// \param pixel    The pixel's number within the picture.
/// \param ray      The ray's number within the pixel.
/// \param pattern  The pattern of a pixel's rays, made by make_pattern(). With
///                 Sampling::random all numbers are independent.
constexpr void start_ray(StratifiedStream& stream, std::uint64_t seed,
                         std::uint64_t pixel, int ray,
                         const Pattern& pattern) noexcept {
    const auto path = pixel * static_cast<std::uint64_t>(pattern.points) +
                      static_cast<std::uint64_t>(ray);
    stream = {.pattern = pattern,
              .ray = ray,
              .key = random_stream(~seed, Pass::camera, 0, pixel).key,
              .rest = random_stream(seed, Pass::camera, 0, path)};
}

/// Moves a stream to the start of a bounce; bounce 0 is the camera ray. The numbers
/// of a bounce do not depend on how many numbers were drawn before.
constexpr void start_bounce(StratifiedStream& stream, std::uint64_t bounce) noexcept {
    stream.dimension = bounce << 16;
    start_bounce(stream.rest, bounce);
}

namespace detail {

/// Begins the next draw: returns the number of the ray's cell, in [0, pattern.points),
/// and sets `key` to the key of the draw.
[[nodiscard]] constexpr std::uint32_t next_cell(StratifiedStream& stream,
                                                std::uint64_t& key) noexcept {
    key = mix_bits(stream.key + 0x9e3779b97f4a7c15u * ++stream.dimension);
    return shuffled(static_cast<std::uint32_t>(stream.ray),
                    static_cast<std::uint32_t>(stream.pattern.points), key);
}

/// Whether the numbers of a ray are independent of other rays: the pixel has only one
/// ray, or the pattern is Sampling::random.
[[nodiscard]] constexpr bool independent(const StratifiedStream& stream) noexcept {
    return stream.pattern.points == 1 || stream.pattern.sampling == Sampling::random;
}

/// If rounding has made x equal to 1, returns the largest number below 1 instead.
template <std::floating_point T>
[[nodiscard]] constexpr T below_one(T x) noexcept {
    constexpr T last = T(1) - std::numeric_limits<T>::epsilon() / T(2);
    return x < last ? x : last;
}

} // namespace detail

/// The next number, uniform in [0, 1), stratified over the pixel's rays.
template <std::floating_point T = float>
[[nodiscard]] constexpr T next_1d(StratifiedStream& stream) noexcept {
    if (detail::independent(stream)) return next_1d<T>(stream.rest);
    std::uint64_t key = 0;
    const T cell = T(detail::next_cell(stream, key)), u = next_1d<T>(stream.rest);
    return detail::below_one((cell + u) / T(stream.pattern.points));
}

/// The next point of the unit square, stratified over the pixel's rays.
// [next 2d]
template <std::floating_point T = float>
[[nodiscard]] constexpr Vec2T<T> next_2d(StratifiedStream& stream) noexcept {
    if (detail::independent(stream)) return next_2d<T>(stream.rest);
    std::uint64_t key = 0;
    const auto cell = static_cast<int>(detail::next_cell(stream, key));
    // The key is mixed: next_cell() and spread() must not use the same permutation.
    const Vec2T<T> u =
        spread(stream.pattern, cell, mix_bits(key), next_2d<T>(stream.rest));
    return {detail::below_one(u.x), detail::below_one(u.y)};
}
// [next 2d]

/// A stratified point of the unit square and a stratified number, in two draws. The
/// point serves to sample a direction, and the number to choose a lobe.
template <std::floating_point T = float>
[[nodiscard]] constexpr Vec3T<T> next_3d(StratifiedStream& stream) noexcept {
    const Vec2T<T> xy = next_2d<T>(stream);
    return {xy.x, xy.y, next_1d<T>(stream)};
}

/// \}

} // namespace ljus
