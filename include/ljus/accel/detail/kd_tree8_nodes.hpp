#pragma once

/// \file ljus/accel/detail/kd_tree8_nodes.hpp
/// \brief The nodes of the wide k-d tree, where each of them lies, and which points of
/// eight are within reach.

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/accel/neighbor.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

/// The squared distances of eight points, in the precision of their coordinates: within
/// five roundings of the exact ones unless they leave the range of T.
/// \param points  Eight points.
/// \param center  Where from.
template <std::floating_point T>
[[nodiscard]] constexpr LanesT<T> distances2(const Lanes3T<T>& points,
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
    [[nodiscard]] constexpr std::uint32_t within(const Lanes3T<T>& points,
                                                 const Vec3T<T>& center,
                                                 const LanesT<T>& d2) const noexcept {
        // Two answers in one number: within reach, as far as T can tell, and surely so.
        std::uint32_t both = 0;
        for_lanes([&](int i) {
            const std::uint32_t near = d2.lane[i] <= last ? lane_bit[i] : 0;
            const std::uint32_t certain = d2.lane[i] <= sure ? lane_bit[i] << 8 : 0;
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

/// Eight boxes side by side: the children of a node.
template <std::floating_point T>
struct KdTree8NodeT {
    Lanes3T<T> low;  ///< Corners with the smallest coordinates.
    Lanes3T<T> high; ///< Opposite corners.
};

// The squared distances to the nearest points of eight boxes. A caller that names
// itself has its own: compilers inline what is called in one place only.
template <typename Caller, std::floating_point T>
[[nodiscard]] constexpr LanesT<T> near2(const KdTree8NodeT<T>& node,
                                        const Vec3T<T>& center) noexcept {
    LanesT<T> result{};
    // To the nearest number of an interval.
    const auto outside = [](T low, T high, T x) {
        const T above = x < low ? low : x;
        return x - (above > high ? high : above);
    };
    // One axis at a time: a longer body is not always inlined, and then no vector.
    LanesT<T> x, y, z;
    for_lanes(
        [&](int i) { x.lane[i] = outside(node.low.x[i], node.high.x[i], center.x); });
    for_lanes(
        [&](int i) { y.lane[i] = outside(node.low.y[i], node.high.y[i], center.y); });
    for_lanes(
        [&](int i) { z.lane[i] = outside(node.low.z[i], node.high.z[i], center.z); });
    for_lanes([&](int i) {
        result.lane[i] =
            x.lane[i] * x.lane[i] + y.lane[i] * y.lane[i] + z.lane[i] * z.lane[i];
    });
    return result;
}

/// Where everything lies in a wide tree: a matter of arithmetic, without a pointer.
///
/// The points stand in blocks of eight, the blocks in leaves of `leaf_blocks` at most,
/// and the leaves, a power of two of them, share the blocks evenly. Three halvings make
/// one level of nodes with eight children; at the root there may be fewer.
struct KdTree8Shape {
    static constexpr int leaf_blocks = 4; ///< The most blocks of a leaf: 32 points.

    std::uint64_t points = 0; ///< How many.
    std::uint64_t blocks = 0; ///< How many blocks hold them.
    int halvings = 0;         ///< From all points to a leaf.
    int levels = 0;           ///< Of nodes.
    std::array<std::uint32_t, 12>
        first{}; ///< The first node of each level, and the end.

    /// The shape for so many points.
    [[nodiscard]] static constexpr KdTree8Shape of(std::uint64_t points) noexcept {
        KdTree8Shape shape{.points = points, .blocks = (points + 7) / 8};
        while ((std::uint64_t(leaf_blocks) << shape.halvings) < shape.blocks)
            ++shape.halvings;
        shape.levels = (shape.halvings + 2) / 3;
        for (int level = 0; level < shape.levels; ++level)
            shape.first[std::size_t(level + 1)] =
                shape.first[std::size_t(level)] +
                (level == 0 ? 1u : 1u << (shape.halvings - 3 * (shape.levels - level)));
        return shape;
    }
    /// How many children the root has.
    [[nodiscard]] constexpr std::uint32_t root_children() const noexcept {
        return 1u << (halvings - 3 * (levels - 1));
    }
    /// The first block of range number `number` after so many halvings; the last one
    /// ends where the next range begins.
    [[nodiscard]] constexpr std::uint64_t first_block(int depth,
                                                      std::uint64_t number) const {
        return ((number << (halvings - depth)) * blocks) >> halvings;
    }
};

/// A wide tree as its searches see it.
template <std::floating_point T>
struct KdTree8PartsT {
    KdTree8Shape shape{};                 ///< Where everything lies.
    std::vector<KdTree8NodeT<T>> nodes{}; ///< Level by level.
    std::vector<Lanes3T<T>> blocks{};     ///< The points, eight by eight.

    /// One point.
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return blocks[index / 8][index % 8];
    }
};

/// \}

} // namespace ljus::detail
