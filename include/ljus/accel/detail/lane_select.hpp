#pragma once

/// \file ljus/accel/detail/lane_select.hpp
/// \brief Finds the k-th smallest of many numbers, by counting eight at a time.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>

#include "ljus/math/lanes.hpp"

namespace ljus::detail {

/// The number halfway between two others in the ordered list of all values of T. If an
/// interval is repeatedly halved at this number, its ends are neighbours in the list
/// after at most as many steps as T has bits.
template <std::floating_point T>
[[nodiscard]] constexpr T middle_in_bits(T low, T high) noexcept {
    using Bits = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    constexpr Bits sign = std::numeric_limits<Bits>::min();
    // The bits of negative numbers are ordered in reverse.
    const auto ordered = [](T x) {
        const Bits bits = std::bit_cast<Bits>(x);
        return bits < 0 ? sign - bits : bits;
    };
    const Bits a = ordered(low);
    const Bits b = ordered(high);
    const Bits middle = (a & b) + ((a ^ b) >> 1);
    return std::bit_cast<T>(middle < 0 ? sign - middle : middle);
}

/// The number of values that do not exceed a threshold.
/// \param values     The values, padded to a multiple of eight with infinity.
/// \param count      The number of values.
/// \param threshold  The threshold, below infinity.
template <std::floating_point T>
[[nodiscard]] constexpr std::size_t count_up_to(const T* values, std::size_t count,
                                                T threshold) noexcept {
    using Count = std::conditional_t<sizeof(T) == 4, std::int32_t, std::int64_t>;
    Count counts[lane_count] = {};
    for (const T* block = values; block < values + count; block += lane_count)
        for_lanes([&](int j) { counts[j] += block[j] <= threshold ? 1 : 0; });
    Count sum = 0;
    for (const Count lane : counts) sum += lane;
    return static_cast<std::size_t>(sum);
}

template <std::floating_point T>
struct Extremes {
    T low;
    T high;
};

/// The smallest value above one bound, and the largest value up to another bound.
/// \param values  The values, padded to a multiple of eight with infinity.
/// \param count   The number of values.
/// \param above   Exclusive lower bound of the smallest.
/// \param up_to   Inclusive upper bound of the largest; finite or minus infinity.
/// \return Both values. Infinity if there is no smallest value, and minus infinity if
///         there is no largest one.
template <std::floating_point T>
[[nodiscard]] constexpr Extremes<T>
smallest_and_largest(const T* values, std::size_t count, T above, T up_to) noexcept {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    T low[lane_count], high[lane_count];
    for (std::size_t j = 0; j < lane_count; ++j) low[j] = infinity, high[j] = -infinity;
    for (const T* block = values; block < values + count; block += lane_count)
        for_lanes([&](int j) {
            const T x = block[j];
            const T for_low = x > above ? x : infinity;
            const T for_high = x <= up_to ? x : -infinity;
            low[j] = for_low < low[j] ? for_low : low[j];
            high[j] = for_high > high[j] ? for_high : high[j];
        });
    Extremes<T> result{low[0], high[0]};
    for (std::size_t j = 1; j < lane_count; ++j) {
        result.low = low[j] < result.low ? low[j] : result.low;
        result.high = high[j] > result.high ? high[j] : result.high;
    }
    return result;
}

/// The k-th smallest value.
///
/// The values stay in place. The function keeps a lower and an upper bound of the
/// result. In each pass it interpolates a threshold between the bounds, counts the
/// values up to the threshold, and moves one bound there. Every third threshold is
/// middle_in_bits(), which limits the number of passes.
/// \param values  The values, without NaN and above minus infinity; padded to a
///                multiple of eight with infinity.
/// \param count   The number of values, at least 1.
/// \param k       The rank, in [1, count].
/// \param spare   By how much the rank of the result may exceed k. A larger number
///                saves passes.
/// \return The k-th smallest value. If `spare` is above 0, possibly a larger number, up
///         to which there are at most k + spare values.
/// \cost About five passes, and at most a hundred in float or two hundred in double. A
///       pass has a comparison and an addition per eight values.
// [select]
template <std::floating_point T>
[[nodiscard]] constexpr T select_smallest(const T* values, std::size_t count,
                                          std::size_t k,
                                          std::size_t spare = 0) noexcept {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    constexpr T most = std::numeric_limits<T>::max();
    // Fewer than k values are at most `low`, and at least k values are at most `high`.
    auto [low, high] = smallest_and_largest(values, count, -infinity, most);
    std::size_t up_to_low = count_up_to(values, count, low);
    if (up_to_low >= k) return low;
    std::size_t up_to_high = count_up_to(values, count, most);
    if (up_to_high < k) return infinity;

    for (int step = 0;; ++step) {
        if (spare > 0 && up_to_high <= k + spare) return high;
        if (up_to_high == k)
            return smallest_and_largest(values, count, infinity, high).high;
        if (up_to_low + 1 == k)
            return smallest_and_largest(values, count, low, -infinity).low;
        const T part = (T(k - up_to_low) - T(0.5)) / T(up_to_high - up_to_low);
        T guess = low + (high - low) * part;
        if (step % 3 == 2 || !(low < guess && guess < high)) {
            guess = middle_in_bits(low, high);
            if (!(low < guess && guess < high)) return high; // neighbours
        }
        const std::size_t up_to_guess = count_up_to(values, count, guess);
        (up_to_guess < k ? low : high) = guess;
        (up_to_guess < k ? up_to_low : up_to_high) = up_to_guess;
    }
}
// [select]

} // namespace ljus::detail
