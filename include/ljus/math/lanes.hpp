#pragma once

/// \file ljus/math/lanes.hpp
/// \brief Eight numbers at a time, without a line of assembly.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "ljus/math/vector.hpp"
#include "ljus/version.hpp"

namespace ljus {

namespace detail {

/// \defgroup lanes Lanes
/// \brief Eight numbers side by side: loops of a constant length, which compilers turn
/// into the widest instructions that they may use. What keeps them from it: a long
/// body, a choice between products, shifts that differ by lane.
/// \{

/// How many numbers stand side by side.
inline constexpr int lane_count = 8;

/// Calls `body(i)` for each of eight lanes, in a loop that stays one.
///
/// A compiler that unrolls the loop before it looks for vectors, as g++ does inside of
/// other loops, finds eight separate numbers and no vector any more.
/// \param body  Called with an int in [0, 8).
template <typename Body>
constexpr void for_lanes(Body&& body) noexcept {
#if defined(__clang__)
#pragma clang loop unroll(disable)
#else
#pragma GCC unroll 1
#endif
    for (int i = 0; i < lane_count; ++i) body(i);
}
/// The bit of each lane in a number that has one for each.
inline constexpr std::uint32_t lane_bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};

/// Eight numbers of any precision.
template <std::floating_point T>
struct alignas(32) LanesT {
    T lane[lane_count]; ///< The numbers.
};
using Lanes = LanesT<float>; ///< LanesT in float.

/// Eight points, directions or colours, by coordinate.
template <std::floating_point T>
struct alignas(32) Lanes3T {
    T x[lane_count]; ///< First coordinates.
    T y[lane_count]; ///< Second coordinates.
    T z[lane_count]; ///< Third coordinates.

    /// One of them.
    /// \param lane  In [0, 8).
    [[nodiscard]] constexpr Vec3T<T> operator[](std::size_t lane) const noexcept {
        return {x[lane], y[lane], z[lane]};
    }
    /// Replaces one of them.
    /// \param lane  In [0, 8).
    /// \param v     The new one.
    constexpr void set(std::size_t lane, const Vec3T<T>& v) noexcept {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};
using Lanes3 = Lanes3T<float>; ///< Lanes3T in float.

/// Eight answers: all bits of a lane set for yes, none for no.
struct alignas(32) LaneMask {
    std::int32_t lane[lane_count]; ///< -1 or 0.
};

/// The lanes that say yes, as a number to take them from one by one: eight bits a lane.
/// Written in the two steps that compilers know: to bytes, and those into one register.
/// \param mask  The answers.
/// \return 0 for none.
[[nodiscard]] constexpr std::uint64_t yes_lanes(const LaneMask& mask) noexcept {
    std::array<std::int8_t, lane_count> bytes{};
    for (std::size_t i = 0; i < lane_count; ++i)
        bytes[i] = static_cast<std::int8_t>(mask.lane[i]);
    return std::bit_cast<std::uint64_t>(bytes) & 0x0101010101010101u;
}
/// Takes a lane out of what yes_lanes() returned.
/// \param lanes  Not 0; becomes what is left.
/// \return The lane's place.
[[nodiscard]] constexpr std::size_t take_lane(std::uint64_t& lanes) noexcept {
    const auto place = static_cast<std::size_t>(std::countr_zero(lanes)) / 8;
    lanes &= lanes - 1;
    return std::endian::native == std::endian::little ? place : lane_count - 1 - place;
}

/// Which of eight numbers are at most so large.
/// \param numbers  The numbers.
/// \param bound    How large.
/// \return A bit each, the first number's the lowest; none for NaN.
template <std::floating_point T>
[[nodiscard]] constexpr std::uint32_t lanes_up_to(const LanesT<T>& numbers,
                                                  T bound) noexcept {
    std::uint32_t bits = 0;
    for_lanes([&](int i) { bits |= numbers.lane[i] <= bound ? lane_bit[i] : 0u; });
    return bits;
}

/// The place of the smallest of eight numbers, or of one that differs from it in the
/// last three bits only.
///
/// The bits of a number that is not below 0 are ordered as it is; in place of the last
/// three stands the place, and the smallest integer tells both.
/// \param numbers  The numbers; none of those that count below 0.
/// \param among    Which of them count: a bit each, the first number's the lowest.
/// \param bound    Larger ones do not count, nor does NaN.
/// \return The place, or 8 if there is none.
template <std::floating_point T>
[[nodiscard]] constexpr std::uint32_t
smallest_lane(const LanesT<T>& numbers, std::uint32_t among, T bound) noexcept {
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    constexpr Bits none = std::numeric_limits<Bits>::max() & ~Bits(7);
    const auto bits = std::bit_cast<std::array<Bits, lane_count>>(numbers);
    Bits smallest = none;
    for_lanes([&](int i) {
        const bool counts = (numbers.lane[i] <= bound) & ((among & lane_bit[i]) != 0);
        const Bits key =
            counts ? (bits[std::size_t(i)] & ~Bits(7)) | Bits(i) : Bits(none);
        smallest = key < smallest ? key : smallest;
    });
    return smallest == none ? 8 : static_cast<std::uint32_t>(smallest & 7);
}
/// \}

} // namespace detail

/// \defgroup prefetch Prefetching
/// \brief A processor waits for its memory some hundred steps; it can be told in time.
/// \{

namespace detail {

/// Says that `lines` cache lines of 64 bytes will soon be read. A hint: where a
/// compiler has none to give, nothing happens, and all answers are the same.
/// \param address  Where the first begins; any address.
/// \cost An instruction a line.
template <int lines = 1>
inline void prefetch([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) // clang says so, too
    for (int i = 0; i < lines; ++i)
        __builtin_prefetch(static_cast<const char*>(address) + 64 * i);
#endif
}

} // namespace detail
/// \}

} // namespace ljus
