#pragma once

/// \file ljus/accel/bvh_nodes.hpp
/// \brief The nodes of a tree of boxes, and the settings of its construction.

#include <cstdint>
#include <vector>

#include "ljus/accel/detail/stored_array.hpp"
#include "ljus/geometry/box.hpp"

namespace ljus {

/// \defgroup bvh_nodes Nodes
/// \brief The nodes of a tree of boxes \cite rubin1980. Chapter: \ref ch_bvh.
/// \{

/// Settings of a tree's construction.
struct BvhSettings {
    std::uint32_t leaf_size = 4; ///< Largest number of primitives per leaf; at least 1.
    std::uint32_t at_a_time = 1; ///< Number of primitives that are tested together.
    int threads = 0;             ///< Number of threads; 0 for all processors.
};

namespace detail {

/// A node: its box, and either two children or a range of primitives. It takes 32 bytes
/// in float, half a cache line.
// [tree node]
template <std::floating_point T>
struct BvhNodeT {
    BoxT<T> box{};           ///< The box around the whole subtree.
    std::uint32_t first = 0; ///< First slot of a leaf, or first child of an inner node.
    std::uint32_t count = 0; ///< Number of primitives; 0 for an inner node.
};
// [tree node]
static_assert(sizeof(BvhNodeT<float>) == 32);

/// A tree of boxes.
template <std::floating_point T>
struct BvhNodesT {
    /// The nodes, the root first; none in an empty tree.
    GrowingArray<BvhNodeT<T>> nodes{};
    /// The index of the primitive at each slot, in the order of the leaves.
    std::vector<std::uint32_t> primitive_ids{};
};

/// The largest depth of a tree, and so of a traversal's stack.
inline constexpr int bvh_depth = 64;

} // namespace detail

/// \}

} // namespace ljus
