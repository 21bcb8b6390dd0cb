#pragma once

/// \file ljus/accel/detail/kd_tree8_walk.hpp
/// \brief The traversal of the wide k-d tree: the leaves that a search visits, and the
/// points within its reach.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>

#include "ljus/accel/detail/kd_tree8_build.hpp"

namespace ljus::detail {

/// The squared distances of eight points from `center`, in the precision of the
/// coordinates. They have at most five rounding errors, unless they exceed the range of
/// T.
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

/// The limit of a search: the squared radius in double, and two bounds in T that decide
/// for nearly all points.
///
/// A squared distance computed in T has at most five rounding errors, and each bound
/// differs from the limit by 16 such errors. Between the bounds, distance2() decides in
/// double.
template <std::floating_point T>
struct ReachT {
    double limit2 = -1; ///< The squared limit; if negative, nothing is within reach.
    bool open = false;  ///< Whether the limit itself is excluded.
    T sure = T(-1);     ///< A squared distance up to this is within the limit.
    T last = T(-1);     ///< A squared distance above this is beyond the limit.

    /// The reach up to a limit.
    /// \param limit   The squared limit, at least 0; it may be infinite.
    /// \param beyond  Whether the limit itself is excluded.
    [[nodiscard]] static constexpr ReachT up_to(double limit, bool beyond) noexcept {
        using Numbers = std::numeric_limits<T>;
        // `tiny` is added to the margin, because processors may flush denormals to 0.
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
    /// The reach of a closed ball; empty if the radius is negative or NaN.
    [[nodiscard]] static constexpr ReachT ball(T radius) noexcept {
        if (!(radius >= T(0))) return {};
        return up_to(double(radius) * double(radius), false);
    }
    /// Whether a squared distance in double is within reach.
    [[nodiscard]] constexpr bool holds(double d2) const noexcept {
        return open ? d2 < limit2 : d2 <= limit2;
    }
    /// Decides exactly which of eight points are within reach. Bit i stands for point
    /// i.
    // [within]
    [[nodiscard]] constexpr std::uint32_t within(const Lanes3T<T>& points,
                                                 const Vec3T<T>& center,
                                                 const LanesT<T>& d2) const noexcept {
        // Two results in one number: possibly within reach, and surely within reach.
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

// The squared distances from `center` to eight boxes. Each caller has its own instance,
// because compilers inline a function that is called once.
template <typename Caller, std::floating_point T>
[[nodiscard]] constexpr LanesT<T> near2(const KdTree8NodeT<T>& node,
                                        const Vec3T<T>& center) noexcept {
    LanesT<T> result{};
    // The distance to an interval.
    const auto outside = [](T low, T high, T x) {
        const T above = x < low ? low : x;
        return x - (above > high ? high : above);
    };
    // One axis per loop, because compilers may fail to vectorise a longer body.
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

// Decides exactly which points of a leaf are within reach. Bit i stands for point i.
template <std::floating_point T>
[[nodiscard]] std::uint32_t in_leaf(const KdTree8PartsT<T>& tree, std::size_t first,
                                    std::size_t last, const Vec3T<T>& center,
                                    const ReachT<T>& reach) noexcept {
    const T possible = reach.last, beyond_doubt = reach.sure;
    std::uint32_t near[lane_count] = {}, sure[lane_count] = {};
    for (std::size_t b = first; b < last; ++b) {
        const LanesT<T> d2 = distances2(tree.blocks[b], center);
        for_lanes([&](int i) {
            const std::uint32_t here = d2.lane[i] <= possible ? lane_bit[i] << 24 : 0u;
            near[i] = near[i] >> 8 | here;
        });
        for_lanes([&](int i) {
            const std::uint32_t here =
                d2.lane[i] <= beyond_doubt ? lane_bit[i] << 24 : 0u;
            sure[i] = sure[i] >> 8 | here;
        });
    }
    const auto unused = static_cast<int>(32 - 8 * (last - first));
    std::uint32_t found = 0, certain = 0;
    for_lanes([&](int i) { found |= near[i]; });
    if (found == 0) return 0;
    for_lanes([&](int i) { certain |= sure[i]; });
    found >>= unused;
    certain >>= unused;
    for (std::uint32_t rest = found & ~certain; rest != 0; rest &= rest - 1) {
        const int i = std::countr_zero(rest);
        if (!reach.holds(distance2(tree.point(8 * first + std::size_t(i)), center)))
            found &= ~(1u << i);
    }
    return found;
}

/// The traversal of every search. It visits the leaves whose boxes are within reach,
/// depth first. The argument `results` is a result set, as in nanoflann
/// \cite blanco2014. It has these members:
///
///     ReachT<T> reach;                     // may shrink during the search
///     static constexpr bool nearest_first; // false: in the tree's order
///     bool leaf(tree, center, first, last) // takes the blocks first to last - 1;
///                                          // true ends the search
template <std::floating_point T, typename Results>
bool walk(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, Results& results) {
    const KdTree8Shape& shape = tree.shape;
    if (shape.levels == 0) return results.leaf(tree, center, 0, tree.blocks.size());
    // For the current node of each level: its children that have not been visited, and
    // their distances.
    struct Open {
        std::uint32_t number, left;
    };
    Open open[12];
    LanesT<T> near[Results::nearest_first ? 12 : 1];
    int level = 0;
    std::uint32_t number = 0;
    std::uint32_t left = (1u << shape.root_children()) - 1;
    const auto leaf = [&](std::uint64_t i) {
        return results.leaf(tree, center, shape.first_block(shape.halvings, i),
                            shape.first_block(shape.halvings, i + 1));
    };
    for (;;) {
        // Descend into a node.
        LanesT<T>& far = near[Results::nearest_first ? level : 0];
        far = near2<Results>(tree.nodes[shape.first[std::size_t(level)] + number],
                             center);
        if constexpr (!Results::nearest_first) {
            left &= lanes_up_to(far, results.reach.last);
            if (level + 1 == shape.levels)
                for (; left != 0; left &= left - 1)
                    if (leaf(8 * number +
                             static_cast<std::uint32_t>(std::countr_zero(left))))
                        return true;
        }
        // Go to the next child; ascend if there is none.
        for (;;) {
            auto i = static_cast<std::uint32_t>(std::countr_zero(left));
            if constexpr (Results::nearest_first)
                i = smallest_lane(near[level], left, results.reach.last);
            if (Results::nearest_first ? i == 8 : left == 0) {
                if (level == 0) return false;
                number = open[--level].number;
                left = open[level].left;
                continue;
            }
            left &= Results::nearest_first ? ~(1u << i) : left - 1;
            if constexpr (Results::nearest_first) {
                const auto& node = tree.nodes[shape.first[std::size_t(level)] + number];
                if (near[level].lane[i] > results.reach.sure && // T cannot tell
                    !results.reach.holds(
                        box_distance2(node.low[i], node.high[i], center)))
                    continue;
                if (level + 1 == shape.levels) {
                    if (leaf(8 * number + i)) return true;
                    continue;
                }
            }
            open[level++] = {number, left};
            number = 8 * number + i;
            left = 255;
            break;
        }
    }
}

/// A block of eight points, some of which lie in a ball.
struct BallBlock {
    std::uint32_t ball = 0;  ///< Index of the ball.
    std::uint32_t block = 0; ///< Index of the block in the tree.
    std::uint32_t found = 0; ///< The block's points in the ball, one bit each.
};

/// The blocks that find_in_balls() finds, and buffers that it uses again.
struct BallBlocks {
    /// A node or a leaf that a ball touches.
    struct Place {
        std::uint32_t ball;   ///< Index of the ball.
        std::uint32_t number; ///< Index of the node in its level, or of the leaf.
    };
    GrowingArray<Place> here{};       ///< Nodes of one level, sorted by ball.
    GrowingArray<Place> below{};      ///< Nodes of the next level, sorted by ball.
    GrowingArray<BallBlock> blocks{}; ///< The result, sorted by ball.
};

/// Finds for many balls of one radius what KdTree8T::visit_blocks() finds for each. The
/// blocks of a ball have the order in which visit_blocks() visits them. All balls visit
/// one level of the tree before the next level. A search for a single ball waits for
/// memory at each step; the waits of many balls overlap.
/// \param tree    The tree.
/// \param balls   The number of balls.
/// \param center  Called as center(ball); returns the centre of a ball.
/// \param radius  The radius of all balls, not squared.
/// \param expect  Called as expect(block) for each block that is found, so that the
///                caller can prefetch its data.
/// \param found   Receives the blocks.
template <std::floating_point T, typename Center, typename Expect>
void find_in_balls(const KdTree8PartsT<T>& tree, std::size_t balls, Center center,
                   T radius, Expect expect, BallBlocks& found) {
    const auto reach = ReachT<T>::ball(radius);
    const KdTree8Shape& shape = tree.shape;
    found.here.clear();
    found.blocks.clear();
    for (std::uint32_t ball = 0; ball < balls; ++ball) found.here.push_back({ball, 0});
    for (int level = 0; level < shape.levels; ++level) {
        const std::uint32_t all = level == 0 ? (1u << shape.root_children()) - 1 : 255u;
        found.below.clear();
        for (const auto& [ball, number] : found.here) {
            const KdTree8NodeT<T>& node =
                tree.nodes[shape.first[std::size_t(level)] + number];
            std::uint32_t children =
                lanes_up_to(near2<Expect>(node, center(ball)), reach.last) & all;
            for (; children != 0; children &= children - 1)
                found.below.push_back(
                    {ball, 8 * number +
                               static_cast<std::uint32_t>(std::countr_zero(children))});
        }
        std::swap(found.here, found.below);
    }
    for (const auto& [ball, leaf] : found.here)
        prefetch<KdTree8Shape::leaf_blocks * sizeof(Lanes3T<T>) / 64>(
            tree.blocks.data() + shape.first_block(shape.halvings, leaf));
    for (const auto& [ball, leaf] : found.here) {
        const std::size_t first = shape.first_block(shape.halvings, leaf);
        const std::size_t last = shape.first_block(shape.halvings, leaf + 1);
        std::uint32_t some = in_leaf(tree, first, last, center(ball), reach);
        for (std::size_t block = first; some != 0; ++block, some >>= 8)
            if ((some & 255) != 0) {
                expect(block);
                found.blocks.push_back(
                    {ball, static_cast<std::uint32_t>(block), some & 255});
            }
    }
}

} // namespace ljus::detail
