#pragma once

/// \file ljus/geometry/detail/equal_points.hpp
/// \brief Finds equal points in a list.

#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "ljus/math/field_hash.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/vector.hpp"

namespace ljus::detail {

// Finds points of a list by a hash table with linear probing, of at most 16 bytes per
// point. The list must have fewer than 2^31 points, none of them NaN.
template <std::floating_point T>
class EqualPoints {
public:
    // Returns the index of the point that was added first among those equal to `point`.
    // If there is none, adds `point` with the index `next`, and returns `next`. The
    // caller then stores the point at that index of the list.
    std::uint32_t find_or_add(const std::vector<Vec3T<T>>& points,
                              const Vec3T<T>& point, std::uint32_t next) {
        if (2 * count_ >= slots_.size()) reserve(points, count_ + 1);
        std::uint32_t& slot = slot_of(points, point);
        if (slot == empty) {
            slot = next;
            ++count_;
        }
        return slot;
    }
    // Makes room for `count` different points.
    void reserve(const std::vector<Vec3T<T>>& points, std::size_t count) {
        const auto before = std::exchange(
            slots_, std::vector<std::uint32_t>(std::bit_ceil(2 * count + 1), empty));
        for (const std::uint32_t number : before)
            if (number != empty) slot_of(points, points[number]) = number;
    }

private:
    static constexpr auto empty = std::numeric_limits<std::uint32_t>::max();

    std::uint32_t& slot_of(const std::vector<Vec3T<T>>& points, const Vec3T<T>& point) {
        std::uint64_t hash = 0;
        for (int axis = 0; axis < 3; ++axis) // adding 0 turns -0 into 0
            hash = mix_bits(hash ^ std::bit_cast<BitsOf<T>>(point[axis] + T(0)));
        std::size_t slot = hash & (slots_.size() - 1);
        while (slots_[slot] != empty && points[slots_[slot]] != point)
            slot = (slot + 1) & (slots_.size() - 1);
        return slots_[slot];
    }

    std::vector<std::uint32_t> slots_{};
    std::size_t count_ = 0;
};

// For each point, the index of the first point of the list that is equal to it. For n
// points the expected cost is O(n).
template <std::floating_point T>
[[nodiscard]] std::vector<std::uint32_t>
first_equal_points(const std::vector<Vec3T<T>>& points) {
    EqualPoints<T> equal;
    equal.reserve(points, points.size());
    std::vector<std::uint32_t> first(points.size());
    for (std::uint32_t i = 0; i < points.size(); ++i)
        first[i] = equal.find_or_add(points, points[i], i);
    return first;
}

} // namespace ljus::detail
