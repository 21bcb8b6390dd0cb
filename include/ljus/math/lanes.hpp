#pragma once

/// \file ljus/math/lanes.hpp
/// \brief Arithmetic on eight numbers at a time, in portable C++.

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "ljus/math/vector.hpp"
#include "ljus/version.hpp"

namespace ljus::detail {

// Compilers turn loops over eight numbers into vector instructions. They do not succeed
// if the body of a loop is long, chooses between products, or shifts each lane by a
// different number of bits.

inline constexpr int lane_count = 8;

/// Calls `body(i)` for i from 0 to 7, in a loop that is not unrolled. g++ would unroll
/// the loop before it looks for vector instructions, and then would find none.
template <typename Body>
constexpr void for_lanes(Body&& body) noexcept {
#if defined(__clang__)
#pragma clang loop unroll(disable)
#else
#pragma GCC unroll 1
#endif
    for (int i = 0; i < lane_count; ++i) body(i);
}
/// The bit that stands for each lane in a bit mask.
inline constexpr std::uint32_t lane_bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};

/// Eight numbers of any precision.
template <std::floating_point T>
struct alignas(32) LanesT {
    T lane[lane_count]; ///< The numbers.
};
using Lanes = LanesT<float>; ///< LanesT in float.

/// Eight points, directions or colours, stored coordinate by coordinate.
template <std::floating_point T>
struct alignas(32) Lanes3T {
    T x[lane_count]; ///< First coordinates.
    T y[lane_count]; ///< Second coordinates.
    T z[lane_count]; ///< Third coordinates.

    [[nodiscard]] constexpr Vec3T<T> operator[](std::size_t lane) const noexcept {
        return {x[lane], y[lane], z[lane]};
    }
    constexpr void set(std::size_t lane, const Vec3T<T>& v) noexcept {
        x[lane] = v.x;
        y[lane] = v.y;
        z[lane] = v.z;
    }
};
using Lanes3 = Lanes3T<float>; ///< Lanes3T in float.

/// Eight truth values.
struct alignas(32) LaneMask {
    std::int32_t lane[lane_count]; ///< -1 (all bits set) for true, 0 for false.
};

/// Packs a mask into an integer, for take_lane(). The byte of a lane is 1 if the lane
/// is true, and 0 otherwise.
[[nodiscard]] constexpr std::uint64_t yes_lanes(const LaneMask& mask) noexcept {
    std::array<std::int8_t, lane_count> bytes{};
    for (std::size_t i = 0; i < lane_count; ++i)
        bytes[i] = static_cast<std::int8_t>(mask.lane[i]);
    return std::bit_cast<std::uint64_t>(bytes) & 0x0101010101010101u;
}
/// Removes one lane from the set that yes_lanes() returned. The set must not be empty.
/// \return The index of the removed lane, in [0, 8).
[[nodiscard]] constexpr std::size_t take_lane(std::uint64_t& lanes) noexcept {
    const auto place = static_cast<std::size_t>(std::countr_zero(lanes)) / 8;
    lanes &= lanes - 1;
    return std::endian::native == std::endian::little ? place : lane_count - 1 - place;
}

/// Tests which of eight numbers are at most `bound`.
/// \return A bit mask, with lane 0 in the lowest bit; a NaN does not pass.
template <std::floating_point T>
[[nodiscard]] constexpr std::uint32_t lanes_up_to(const LanesT<T>& numbers,
                                                  T bound) noexcept {
    std::uint32_t bits = 0;
    for_lanes([&](int i) { bits |= numbers.lane[i] <= bound ? lane_bit[i] : 0u; });
    return bits;
}

/// The index of the smallest of eight numbers. The function replaces the last three
/// bits of each number by the index of its lane, and compares the results as integers.
/// For numbers of at least 0 the order is the same. Numbers that differ only in their
/// last three bits count as equal.
/// \param numbers  The numbers; those in `among` must be at least 0.
/// \param among    Bit mask of the lanes that count, with lane 0 in the lowest bit.
/// \param bound    Numbers above `bound` and NaN do not count.
/// \return The index, or 8 if no number counts.
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

/// Hints that `lines` cache lines of 64 bytes, from `address` on, will soon be read.
/// The hint does not change results. Compilers without such a hint ignore it.
template <int lines>
inline void prefetch([[maybe_unused]] const void* address) noexcept {
#if defined(__GNUC__) // clang defines it, too
    for (int i = 0; i < lines; ++i)
        __builtin_prefetch(static_cast<const char*>(address) + 64 * i);
#endif
}

} // namespace ljus::detail
