#pragma once

/// \file ljus/accel/detail/bvh8_build.hpp
/// \brief The nodes of a wide tree, and their construction from a binary tree.

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/accel/bvh_nodes.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"

namespace ljus::detail {

/// Chooses which nodes of a binary tree become the children of wide nodes. It minimises
/// the sum of the surface areas of all wide nodes, because the probability that a ray
/// visits a node is proportional to the node's area \cite ylitie2017.
///
/// Suppose that i child slots of a wide node are available to a binary node. Either
/// the binary node becomes a wide node of its own in one slot, or its two children
/// share the i slots. Dynamic programming finds the cheaper choice for each i, from the
/// leaves up.
template <std::floating_point T>
class BvhCollapse {
public:
    static constexpr int width = 8; ///< Largest number of children of a wide node.

    /// The children of one wide node, as nodes of the binary tree.
    struct Children {
        std::array<std::uint32_t, width> node{}; ///< Indices in the binary tree.
        std::size_t count = 0;                   ///< Number of children.
    };

    /// Computes the costs of a tree. The tree must outlive this object.
    /// \cost O(n) for n nodes; 56 bytes per node.
    explicit BvhCollapse(const BvhNodesT<T>& tree)
        : tree_(tree), cost_(tree.nodes.size()) {
        // Children come after their parents in the array.
        for (std::size_t i = tree.nodes.size(); i-- > 0;) {
            const BvhNodeT<T>& node = tree.nodes[i];
            if (node.count != 0) continue; // a leaf cannot be opened
            const Vec3T<double> size{node.box.high - node.box.low};
            cost_[i][0] = size.x * size.y + size.y * size.z + size.z * size.x +
                          share(node, width).cost;
            for (int slots = 2; slots < width; ++slots)
                cost_[i][std::size_t(slots) - 1] =
                    glm::min(cost_[i][0], share(node, slots).cost);
        }
    }

    /// The children of the wide node that a binary node becomes. If the whole binary
    /// tree is one leaf, the wide root gets that leaf as its only child.
    [[nodiscard]] Children children(std::uint32_t from) const {
        Children result;
        const BvhNodeT<T>& node = tree_.nodes[from];
        if (node.count != 0)
            open(from, 1, result);
        else
            open_both(node, width, result);
        return result;
    }

private:
    struct Share {
        int low = 1; // slots of the first child
        double cost = 0;
    };

    double cost(std::uint32_t node, int slots) const noexcept {
        return cost_[node][std::size_t(slots) - 1];
    }

    // The cheapest distribution of slots between the two children of a node.
    // [share]
    Share share(const BvhNodeT<T>& parent, int slots) const noexcept {
        Share best;
        for (int low = 1; low < slots; ++low) {
            const double sum =
                cost(parent.first, low) + cost(parent.first + 1, slots - low);
            if (low == 1 || sum < best.cost) best = {low, sum};
        }
        return best;
    }
    // [share]

    void open_both(const BvhNodeT<T>& parent, int slots, Children& result) const {
        const int low = share(parent, slots).low;
        open(parent.first, low, result);
        open(parent.first + 1, slots - low, result);
    }
    void open(std::uint32_t i, int slots, Children& result) const {
        const BvhNodeT<T>& node = tree_.nodes[i];
        if (node.count == 0 && slots > 1 && share(node, slots).cost < cost_[i][0])
            open_both(node, slots, result);
        else
            result.node[result.count++] = i;
    }

    const BvhNodesT<T>& tree_;
    std::vector<std::array<double, width - 1>> cost_; // for 1, 2, ... slots
};

/// A node with up to eight children. The boxes of the children are stored coordinate by
/// coordinate \cite wald2008.
struct Bvh8Node {
    /// The planes of the boxes: low x, y, z, then high x, y, z.
    std::array<Lanes, 6> plane;
    /// The children, encoded as in Bvh8Child.
    std::array<std::uint32_t, lane_count> child;
};
/// The encoding of a child in 32 bits. An inner node is encoded as its position in the
/// array of nodes, in units of 32 bytes, the size of Lanes. A leaf is encoded as its
/// first slot and its number of primitives.
struct Bvh8Child {
    static constexpr std::uint32_t leaf = 1u << 31; ///< The bit that marks a leaf.
    /// The number of primitives of a leaf, minus 1, is shifted left by this many bits.
    static constexpr int count_shift = 27;
    /// The mask of the bits that hold a leaf's first slot.
    static constexpr std::uint32_t first = (1u << count_shift) - 1;
    /// The number of primitives of a leaf.
    static constexpr std::uint32_t count(std::uint32_t child) noexcept {
        return ((child >> count_shift) & 15u) + 1;
    }
    /// The size of a node in units of Lanes, which are 32 bytes.
    static constexpr std::uint32_t stride = sizeof(Bvh8Node) / sizeof(Lanes);
};

/// A wide tree. The coordinates in its nodes are relative to the centre of the tree's
/// box, so that a scene far from the origin loses no precision.
struct Bvh8Nodes {
    /// The nodes, the root first; none in an empty tree.
    GrowingArray<Bvh8Node> nodes{};
    /// The index of the primitive at each slot, or padding.
    std::vector<std::uint32_t> primitive_ids{};
    Box box{};      ///< The box around all primitives.
    Vec3 middle{0}; ///< The centre of the box.
    Vec3 half{0};   ///< Half the size of the box.

    /// The entry of primitive_ids for an unused slot between leaves.
    static constexpr std::uint32_t padding = std::numeric_limits<std::uint32_t>::max();
};

// Writes the wide node for the binary node `from` to position `to`, and adds its
// subtree.
template <std::floating_point T>
void add_wide_node(Bvh8Nodes& wide, const BvhNodesT<T>& tree,
                   const BvhCollapse<T>& collapse, std::uint32_t from, std::size_t to,
                   std::uint32_t multiple) {
    const auto [open, count] = collapse.children(from);
    Bvh8Node node{};
    for (std::size_t i = 0; i < lane_count; ++i) {
        // No ray enters an empty box.
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
            wide.nodes.push_back({}); // written below
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
            add_wide_node(wide, tree, collapse, open[i],
                          node.child[i] / Bvh8Child::stride, multiple);
}
/// Collapses a binary tree into a wide tree.
/// \param tree      The binary tree. Its leaves have at most 16 primitives.
/// \param multiple  As for Bvh8.
/// \throws std::invalid_argument  if there are 2^27 slots or more, or for multiple 0.
template <std::floating_point T>
[[nodiscard]] Bvh8Nodes make_bvh8(const BvhNodesT<T>& tree, std::uint32_t multiple) {
    require_at_least("multiple", multiple, 1);
    Bvh8Nodes wide;
    if (tree.nodes.empty()) return wide;
    wide.box = tree.nodes[0].box;
    wide.middle = 0.5f * wide.box.low + 0.5f * wide.box.high;
    wide.half = 0.5f * wide.box.high - 0.5f * wide.box.low;
    wide.nodes.push_back({});
    add_wide_node(wide, tree, BvhCollapse<T>(tree), 0, 0, multiple);
    require(wide.primitive_ids.size() < Bvh8Child::first,
            "the number of slots in a tree",
            static_cast<long long>(wide.primitive_ids.size()), "below 2^27");
    wide.nodes.shrink_to_fit();
    // A copy has no spare capacity.
    wide.primitive_ids = std::vector<std::uint32_t>(wide.primitive_ids);
    return wide;
}

} // namespace ljus::detail
