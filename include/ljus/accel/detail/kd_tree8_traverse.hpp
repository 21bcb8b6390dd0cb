#pragma once

/// \file ljus/accel/detail/kd_tree8_traverse.hpp
/// \brief Which leaves of the wide k-d tree a search visits, in which order, and which
/// of their points it finds.

#include "ljus/accel/detail/kd_tree8_nodes.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

// Which points of a leaf lie within reach, exactly: a bit each.
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
// The leaves within reach; until one visit says true.
template <std::floating_point T, typename Visit>
bool in_ball(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, T radius,
             const ReachT<T>& reach, Visit visit) {
    const auto& [shape, nodes, blocks] = tree;
    if (!(radius >= T(0))) return false;
    if (shape.levels == 0) return visit(std::size_t(0), blocks.size());
    // The nodes of which some children are left: one at most on each level.
    struct Open {
        int level;
        std::uint32_t number, children;
    };
    Open open[12];
    int size = 0;
    int level = 0;
    std::uint32_t number = 0;
    std::uint32_t all = (1u << shape.root_children()) - 1;
    for (;;) {
        const KdTree8NodeT<T>& node = nodes[shape.first[std::size_t(level)] + number];
        std::uint32_t children =
            lanes_up_to(near2<Visit>(node, center), reach.last) & all;
        all = 255;
        if (level + 1 == shape.levels) {
            for (; children != 0; children &= children - 1) {
                const std::uint64_t leaf =
                    8 * number + static_cast<std::uint32_t>(std::countr_zero(children));
                if (visit(shape.first_block(shape.halvings, leaf),
                          shape.first_block(shape.halvings, leaf + 1)))
                    return true;
            }
        }
        if (children == 0) {
            if (size == 0) return false;
            level = open[--size].level;
            number = open[size].number;
            children = open[size].children;
        }
        // One child at once; the others stay open.
        open[size] = {level, number, children & (children - 1)};
        if (open[size].children != 0) ++size;
        number = 8 * number + static_cast<std::uint32_t>(std::countr_zero(children));
        ++level;
    }
}
// The leaves within reach, of each node the nearest child first; a visit may shorten
// the reach.
template <std::floating_point T, typename Visit>
void towards(const KdTree8PartsT<T>& tree, const Vec3T<T>& center,
             const ReachT<T>& reach, Visit visit) {
    const auto& [shape, nodes, blocks] = tree;
    if (shape.levels == 0) return visit(std::size_t(0), blocks.size());
    struct Open {
        LanesT<T> near;       // how far its children are
        std::uint32_t number; // of the node
        std::uint32_t left;   // which of them have not been looked at
    };
    Open open[12]; // a node on each level
    int level = 0;
    open[0].near = near2<void>(nodes[0], center);
    open[0].number = 0;
    open[0].left = (1u << shape.root_children()) - 1;
    for (;;) {
        Open& at = open[level];
        const std::uint32_t i = smallest_lane(at.near, at.left, reach.last);
        if (i == 8) {
            if (level-- == 0) return;
            continue;
        }
        at.left &= ~(1u << i);
        const std::uint32_t child = 8 * at.number + i;
        if (at.near.lane[i] > reach.sure) { // T cannot tell
            const KdTree8NodeT<T>& node =
                nodes[shape.first[std::size_t(level)] + at.number];
            if (!reach.holds(box_distance2(node.low[i], node.high[i], center)))
                continue;
        }
        if (++level < shape.levels) {
            open[level].near =
                near2<void>(nodes[shape.first[std::size_t(level)] + child], center);
            open[level].number = child;
            open[level].left = 255;
        } else {
            --level;
            visit(shape.first_block(shape.halvings, child),
                  shape.first_block(shape.halvings, child + 1));
        }
    }
}

/// A block of eight points, of which a ball holds some.
struct BallBlock {
    std::uint32_t ball = 0;  ///< Which ball.
    std::uint32_t block = 0; ///< Which block of the tree.
    std::uint32_t found = 0; ///< Which of its points: a bit each.
};
/// What a search for many balls finds: room that is kept from one to the next.
struct BallBlocks {
    /// A node of the tree that a ball reaches, or a leaf.
    struct Place {
        std::uint32_t ball;   ///< Which ball.
        std::uint32_t number; ///< Which node of its level, or which leaf.
    };
    std::vector<Place> here{};       ///< Of one level: of the first ball, the second...
    std::vector<Place> below{};      ///< Of the next level, in the same order.
    std::vector<BallBlock> blocks{}; ///< What is found, in the same order.
};
/// Finds the points within many balls together, by one step for all of them at a time:
/// a level of the tree after the other, then the leaves. Within a ball each step waits
/// for the one before; those of different balls do not, and a processor works on some
/// at once. What the next step reads is on its way from memory meanwhile.
/// \param tree    The tree.
/// \param balls   How many; below 2^32.
/// \param center  Called as center(ball).
/// \param radius  Of all of them.
/// \param expect  Called as expect(block) for each block that will be found, to fetch
///                what else it has.
/// \param found   Gets the blocks: of each ball those that in_ball() would visit, in
///                its order.
// [find_in_balls]
template <std::floating_point T, typename Center, typename Expect>
void find_in_balls(const KdTree8PartsT<T>& tree, std::size_t balls, Center center,
                   T radius, Expect expect, BallBlocks& found) {
    const auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
    const auto& [shape, nodes, blocks] = tree;
    found.here.clear();
    found.blocks.clear();
    if (!(radius >= T(0))) return;
    for (std::uint32_t ball = 0; ball < balls; ++ball) found.here.push_back({ball, 0});
    for (int level = 0; level < shape.levels; ++level) {
        const std::uint32_t all = level == 0 ? (1u << shape.root_children()) - 1 : 255u;
        found.below.clear();
        for (const auto& [ball, number] : found.here) {
            const KdTree8NodeT<T>& node =
                nodes[shape.first[std::size_t(level)] + number];
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
            blocks.data() + shape.first_block(shape.halvings, leaf));
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
// [find_in_balls]

/// \}

} // namespace ljus::detail
