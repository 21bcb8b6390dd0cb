#pragma once

/// \file ljus/accel/detail/kd_tree8_traverse.hpp
/// \brief Which leaves of the wide k-d tree a search visits, and in which order.

#include "ljus/accel/kd_tree8.hpp"

namespace ljus {

/// \addtogroup kd_tree8
/// \{

// The leaves within reach; until one visit says true.
// [in ball]
template <std::floating_point T>
template <typename Visit>
bool KdTree8T<T>::in_ball(const Vec3T<T>& center, T radius, const ReachT<T>& reach,
                          Visit visit) const {
    if (!(radius >= T(0))) return false;
    if (shape_.levels == 0) return visit(std::size_t(0), blocks_.size());
    // The nodes of which some children are left: one at most on each level.
    struct Open {
        int level;
        std::uint32_t number, children;
    };
    Open open[12];
    int size = 0;
    int level = 0;
    std::uint32_t number = 0;
    std::uint32_t all = (1u << shape_.root_children()) - 1;
    for (;;) {
        const KdTree8NodeT<T>& node = nodes_[shape_.first[std::size_t(level)] + number];
        std::uint32_t children =
            lanes_up_to(detail::near2<Visit>(node, center), reach.last) & all;
        all = 255;
        if (level + 1 == shape_.levels) {
            for (; children != 0; children &= children - 1) {
                const std::uint64_t leaf =
                    8 * number + static_cast<std::uint32_t>(std::countr_zero(children));
                if (visit(shape_.first_block(shape_.halvings, leaf),
                          shape_.first_block(shape_.halvings, leaf + 1)))
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
// [in ball]

// The leaves within reach, of each node the nearest child first; a visit may shorten
// the reach.
template <std::floating_point T>
template <typename Visit>
void KdTree8T<T>::towards(const Vec3T<T>& center, const ReachT<T>& reach,
                          Visit visit) const {
    if (shape_.levels == 0) return visit(std::size_t(0), blocks_.size());
    struct Open {
        LanesT<T> near;       // how far its children are
        std::uint32_t number; // of the node
        std::uint32_t left;   // which of them have not been looked at
    };
    Open open[12]; // a node on each level
    int level = 0;
    open[0].near = detail::near2<void>(nodes_[0], center);
    open[0].number = 0;
    open[0].left = (1u << shape_.root_children()) - 1;
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
                nodes_[shape_.first[std::size_t(level)] + at.number];
            if (!reach.holds(box_distance2(node.low[i], node.high[i], center)))
                continue;
        }
        if (++level < shape_.levels) {
            open[level].near = detail::near2<void>(
                nodes_[shape_.first[std::size_t(level)] + child], center);
            open[level].number = child;
            open[level].left = 255;
        } else {
            --level;
            visit(shape_.first_block(shape_.halvings, child),
                  shape_.first_block(shape_.halvings, child + 1));
        }
    }
}

/// \}

} // namespace ljus
