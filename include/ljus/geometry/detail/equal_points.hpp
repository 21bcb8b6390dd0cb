#pragma once

/// \file ljus/geometry/detail/equal_points.hpp
/// \brief Which points of a list are the same.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/math/field_hash.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/vector.hpp"

namespace ljus::detail {

// For each point the index of the first one that is equal to it. There are fewer than
// 2^31 points, without NaN. Expected O(n): a hash table with linear probing.
template <std::floating_point T>
[[nodiscard]] std::vector<std::uint32_t>
first_equal_points(const std::vector<Vec3T<T>>& points) {
    constexpr auto empty = std::numeric_limits<std::uint32_t>::max();
    std::vector<std::uint32_t> slots(std::bit_ceil(2 * points.size() + 1), empty);
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) // -0 + 0 is 0
            hash = mix_bits(hash ^ std::bit_cast<BitsOf<T>>(points[i][axis] + T(0)));
        std::size_t slot = hash & (slots.size() - 1);
        while (slots[slot] != empty && points[slots[slot]] != points[i])
            slot = (slot + 1) & (slots.size() - 1);
        if (slots[slot] == empty) slots[slot] = i;
        first[i] = slots[slot];
    }
    return first;
}

} // namespace ljus::detail
