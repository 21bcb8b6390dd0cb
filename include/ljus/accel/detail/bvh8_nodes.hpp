#pragma once

/// \file ljus/accel/detail/bvh8_nodes.hpp
/// \brief The nodes of the fast tree, and how they are made of those of the plain one.

#include <array>

#include "ljus/accel/detail/bvh_collapse.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup wide_nodes Wide nodes
/// \brief Eight children a node. Chapter: \ref ch_bvh.
/// \{

/// A node with up to eight children, coordinate by coordinate \cite wald2008.
// [wide node]
struct Bvh8Node {
    std::array<Lanes, 6> plane;                  ///< Low x, y, z, then high x, y, z.
    std::array<std::uint32_t, lane_count> child; ///< As Bvh8Child has them.
};
// [wide node]

/// A child in 32 bits: how many nodes' lanes lie before its node; or, for a leaf, its
/// first slot and how many there are.
struct Bvh8Child {
    static constexpr std::uint32_t leaf = 1u << 31; ///< Set for a leaf.
    static constexpr int count_shift = 27;          ///< Then the count, less one,
    static constexpr std::uint32_t first = (1u << count_shift) - 1; ///< and the slot.
    /// How many primitives a leaf has.
    static constexpr std::uint32_t count(std::uint32_t child) noexcept {
        return ((child >> count_shift) & 15u) + 1;
    }
    /// A node in units of 32 bytes: its address is one shift away.
    static constexpr std::uint32_t stride = sizeof(Bvh8Node) / sizeof(Lanes);
};

/// A wide tree: nodes, the root first, and the order in which leaves have primitives.
/// Coordinates are as seen from the middle of everything, so that a scene far from the
/// origin is met as well as one around it.
struct Bvh8Nodes {
    std::vector<Bvh8Node> nodes{}; ///< Empty if there is nothing.
    std::vector<std::uint32_t>
        primitive_ids{}; ///< primitive_ids[slot] is a primitive's number, or padding.
    Box box{};           ///< Around everything.
    Vec3 middle{0};      ///< Of the box.
    Vec3 half{0};        ///< From there to its sides.

    /// A slot between leaves that nothing has.
    static constexpr std::uint32_t padding = std::numeric_limits<std::uint32_t>::max();
};

namespace detail {

// Makes a wide node of a plain one and of what is below it.
// [widen]
template <std::floating_point T>
void widen(Bvh8Nodes& wide, const BvhNodesT<T>& tree, const BvhCollapse<T>& collapse,
           std::uint32_t from, std::size_t to, std::uint32_t multiple) {
    const auto [open, count] = collapse.children(from);
    Bvh8Node node{};
    for (std::size_t i = 0; i < lane_count; ++i) {
        // Nothing enters a box around nothing.
        const BoxT<T> box = i < count ? tree.nodes[open[i]].box : BoxT<T>{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            node.plane[axis].lane[i] = box.low[a] - wide.middle[a];
            node.plane[axis + 3].lane[i] = box.high[a] - wide.middle[a];
        }
        if (i >= count) continue;
        const BvhNodeT<T>& below = tree.nodes[open[i]];
        if (below.count == 0) {
            node.child[i] =
                static_cast<std::uint32_t>(wide.nodes.size()) * Bvh8Child::stride;
            wide.nodes.emplace_back();
            continue;
        }
        node.child[i] = Bvh8Child::leaf |
                        ((below.count - 1) << Bvh8Child::count_shift) |
                        static_cast<std::uint32_t>(wide.primitive_ids.size());
        for (std::uint32_t k = 0; k < below.count; ++k)
            wide.primitive_ids.push_back(tree.primitive_ids[below.first + k]);
        while (wide.primitive_ids.size() % multiple != 0)
            wide.primitive_ids.push_back(Bvh8Nodes::padding);
    }
    wide.nodes[to] = node;
    for (std::size_t i = 0; i < count; ++i)
        if (tree.nodes[open[i]].count == 0)
            widen(wide, tree, collapse, open[i], node.child[i] / Bvh8Child::stride,
                  multiple);
}
// [widen]

} // namespace detail

/// Makes a tree wide.
/// \param tree      The plain tree; its leaves have at most 16 primitives.
/// \param multiple  Leaves start at multiples of so many slots, padding between them.
/// \return The wide tree.
/// \throws std::invalid_argument  if there are 2^27 slots or more.
template <std::floating_point T>
[[nodiscard]] Bvh8Nodes make_bvh8(const BvhNodesT<T>& tree,
                                  std::uint32_t multiple = 1) {
    Bvh8Nodes wide;
    if (tree.nodes.empty()) return wide;
    wide.box = tree.nodes[0].box;
    wide.middle = 0.5f * wide.box.low + 0.5f * wide.box.high;
    wide.half = 0.5f * wide.box.high - 0.5f * wide.box.low;
    wide.nodes.emplace_back();
    detail::widen(wide, tree, BvhCollapse<T>(tree), 0, 0, multiple);
    require(wide.primitive_ids.size() < Bvh8Child::first,
            "the number of slots in a tree",
            static_cast<long long>(wide.primitive_ids.size()), "below 2^27");
    wide.nodes.shrink_to_fit();
    wide.primitive_ids.shrink_to_fit();
    return wide;
}

/// \}

} // namespace ljus
