#pragma once

/// \file ljus/accel/detail/kd_tree8_nodes.hpp
/// \brief The nodes of the wide k-d tree, and where each of them lies.

#include <array>

#include "ljus/accel/detail/point_block.hpp"

namespace ljus {

/// \addtogroup kd_tree8
/// \{

/// Eight boxes side by side: the children of a node.
template <std::floating_point T>
struct KdTree8NodeT {
    BlockT<T> low;  ///< Corners with the smallest coordinates.
    BlockT<T> high; ///< Opposite corners.
};

namespace detail {

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

} // namespace detail

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

/// \}

} // namespace ljus
