#pragma once

/// \file ljus/accel/detail/point_block.hpp
/// \brief Eight points side by side, and which of them lie within reach.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "ljus/accel/neighbor.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus {

/// \addtogroup kd_tree8
/// \{

/// Calls `body(i)` for each of eight lanes, in a loop that stays one.
///
/// A compiler that unrolls the loop before it looks for vectors, as g++ does inside of
/// other loops, finds eight separate numbers and no vector any more.
/// \param body  Called with an int in [0, 8).
// [for lanes]
template <typename Body>
constexpr void for_lanes(Body&& body) noexcept {
#if defined(__clang__)
#pragma clang loop unroll(disable)
#else
#pragma GCC unroll 1
#endif
    for (int i = 0; i < lane_count; ++i) body(i);
}
// [for lanes]

/// The bit of each lane in a number that has one for each.
inline constexpr std::uint32_t lane_bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};

/// Eight numbers of any precision.
template <std::floating_point T>
struct alignas(32) LanesT {
    T lane[lane_count]; ///< The numbers.
};

/// Eight points, directions or colours, by coordinate.
template <std::floating_point T>
struct alignas(32) BlockT {
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

/// The squared distances of eight points, in the precision of their coordinates: within
/// five roundings of the exact ones unless they leave the range of T.
/// \param points  Eight points.
/// \param center  Where from.
template <std::floating_point T>
[[nodiscard]] constexpr LanesT<T> distances2(const BlockT<T>& points,
                                             const Vec3T<T>& center) noexcept {
    LanesT<T> result{};
    for_lanes([&](int i) {
        const T x = points.x[i] - center.x;
        const T y = points.y[i] - center.y;
        const T z = points.z[i] - center.z;
        result.lane[i] = x * x + y * y + z * z;
    });
    return result;
}

/// Which of eight numbers are at most so large.
/// \param numbers  The numbers.
/// \param bound    How large.
/// \return A bit each, the first number's the lowest; none for NaN.
template <std::floating_point T>
[[nodiscard]] constexpr std::uint32_t lanes_up_to(const LanesT<T>& numbers,
                                                  T bound) noexcept {
    constexpr std::int32_t bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};
    std::int32_t bits = 0;
    for_lanes([&](int i) { bits |= numbers.lane[i] <= bound ? bit[i] : 0; });
    return static_cast<std::uint32_t>(bits);
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
// [smallest lane]
template <std::floating_point T>
[[nodiscard]] constexpr std::uint32_t
smallest_lane(const LanesT<T>& numbers, std::uint32_t among, T bound) noexcept {
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    constexpr Bits none = std::numeric_limits<Bits>::max() & ~Bits(7);
    constexpr std::uint32_t bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};
    const auto bits = std::bit_cast<std::array<Bits, lane_count>>(numbers);
    Bits smallest = none;
    for_lanes([&](int i) {
        const bool counts = (numbers.lane[i] <= bound) & ((among & bit[i]) != 0);
        const Bits key =
            counts ? (bits[std::size_t(i)] & ~Bits(7)) | Bits(i) : Bits(none);
        smallest = key < smallest ? key : smallest;
    });
    return smallest == none ? 8 : static_cast<std::uint32_t>(smallest & 7);
}
// [smallest lane]

/// How far a search reaches: a limit in double that decides, and two bounds in T that
/// decide nearly always.
///
/// A squared distance computed in T has at most five roundings of half an ulp.
/// Whatever is at most `sure` is within the limit, whatever lies above `last` is not,
/// with 16 roundings between each of them and the limit; only what falls between the
/// two is computed once more, by distance2().
template <std::floating_point T>
struct ReachT {
    double limit2 = 0; ///< Squared.
    bool open = false; ///< Whether the limit itself is out of reach.
    T sure = T(-1);    ///< At most this: within the limit.
    T last = T(-1);    ///< Above this: beyond the limit.

    /// The reach up to a limit.
    /// \param limit   Squared; at least 0, or infinite.
    /// \param beyond  Whether the limit itself is out of reach.
    [[nodiscard]] static constexpr ReachT up_to(double limit, bool beyond) noexcept {
        using Numbers = std::numeric_limits<T>;
        // The smallest numbers, which processors may take for 0, decide nothing.
        constexpr double margin = 8 * double(Numbers::epsilon());
        constexpr double tiny = 4 * double(Numbers::min());
        constexpr double most = double(Numbers::max());
        const double up = limit * (1 + margin) + tiny;
        const double down = std::min(limit, most) * (1 - margin) - tiny;
        return {.limit2 = limit,
                .open = beyond,
                .sure = T(down),
                .last = up < most ? T(up) : Numbers::infinity()};
    }
    /// What a squared distance in double says: the last word.
    [[nodiscard]] constexpr bool holds(double d2) const noexcept {
        return open ? d2 < limit2 : d2 <= limit2;
    }
    /// Which of eight points are within reach, exactly.
    /// \param points  The points.
    /// \param center  The centre of the search.
    /// \param d2      What distances2() says of them.
    /// \return A bit each, the first point's the lowest.
    // [within]
    [[nodiscard]] constexpr std::uint32_t within(const BlockT<T>& points,
                                                 const Vec3T<T>& center,
                                                 const LanesT<T>& d2) const noexcept {
        // Two answers in one number: within reach, as far as T can tell, and surely so.
        constexpr std::uint32_t bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};
        std::uint32_t both = 0;
        for_lanes([&](int i) {
            const std::uint32_t near = d2.lane[i] <= last ? bit[i] : 0;
            const std::uint32_t certain = d2.lane[i] <= sure ? bit[i] << 8 : 0;
            both |= near | certain;
        });
        std::uint32_t found = both & 255;
        if (found == 0) return 0;
        for (std::uint32_t rest = found & ~(both >> 8); rest != 0; rest &= rest - 1) {
            const int i = std::countr_zero(rest);
            if (!holds(distance2(points[std::size_t(i)], center))) found &= ~(1u << i);
        }
        return found;
    }
    // [within]
};

/// \}

} // namespace ljus
