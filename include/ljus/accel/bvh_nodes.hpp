#pragma once

/// \file ljus/accel/bvh_nodes.hpp
/// \brief What a tree of boxes is made of, and the settings that it is built with.

#include <cstdint>
#include <vector>

#include "ljus/geometry/box.hpp"

namespace ljus {

/// \defgroup bvh_nodes Nodes
/// \brief Boxes within boxes \cite rubin1980. Chapter: \ref ch_bvh.
/// \{

/// How a tree is built.
struct BvhSettings {
    std::uint32_t leaf_size = 4; ///< No leaf has more, at least 1.
    std::uint32_t at_a_time = 1; ///< How many primitives one test asks, side by side.
    float node_cost = 1;         ///< Of a step down, in tests.
    int threads = 0;             ///< 0: all that there are.
};

namespace detail {

/// A node: its box, and either two children or some of the primitives themselves. 32
/// bytes in float, so that two children share a cache line.
// [tree node]
template <std::floating_point T>
struct BvhNodeT {
    BoxT<T> box{};           ///< Around all that is below.
    std::uint32_t first = 0; ///< Its first primitive, or child: the other follows.
    std::uint32_t count = 0; ///< How many primitives; 0 for a node with children.
};
// [tree node]
static_assert(sizeof(BvhNodeT<float>) == 32);

/// A tree of boxes: nodes, the root first, and the order in which leaves have
/// primitives.
template <std::floating_point T>
struct BvhNodesT {
    std::vector<BvhNodeT<T>> nodes{}; ///< Empty if there is nothing.
    std::vector<std::uint32_t>
        primitive_ids{}; ///< primitive_ids[slot] is a primitive's number.
};

/// The deepest that a tree may be; what a search keeps in mind is no more.
inline constexpr int bvh_depth = 64;

} // namespace detail

/// \}

} // namespace ljus
