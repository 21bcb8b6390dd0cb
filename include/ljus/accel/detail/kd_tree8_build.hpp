#pragma once

/// \file ljus/accel/detail/kd_tree8_build.hpp
/// \brief The layout of the wide k-d tree, and the partition of points during its
/// construction.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <vector>

#include "ljus/accel/detail/lane_select.hpp"
#include "ljus/accel/neighbor.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

/// The boxes of a node's eight children, side by side.
template <std::floating_point T>
struct KdTree8NodeT {
    Lanes3T<T> low;  ///< Corners with the least coordinates.
    Lanes3T<T> high; ///< Opposite corners.
};

/// The layout of a wide tree; arithmetic replaces pointers.
///
/// The points are grouped into blocks of eight, and the blocks into leaves of at most
/// `leaf_blocks`. The number of leaves is a power of two, and they share the blocks
/// evenly. A node with eight children combines three halvings; the root may have fewer
/// children.
struct KdTree8Shape {
    static constexpr int leaf_blocks = 4; ///< Most blocks per leaf: 32 points.

    std::uint64_t points = 0; ///< Number of points.
    std::uint64_t blocks = 0; ///< Number of blocks.
    int halvings = 0;         ///< From the root to a leaf.
    int levels = 0;           ///< Number of levels of nodes.
    std::array<std::uint32_t, 12>
        first{}; ///< The first node of each level, then the end.

    /// The layout for a number of points.
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
    /// The number of children of the root.
    [[nodiscard]] constexpr std::uint32_t root_children() const noexcept {
        return 1u << (halvings - 3 * (levels - 1));
    }
    /// The first block of a range after `depth` halvings. A range ends where the next
    /// one begins.
    [[nodiscard]] constexpr std::uint64_t first_block(int depth,
                                                      std::uint64_t number) const {
        return ((number << (halvings - depth)) * blocks) >> halvings;
    }
};

/// The data of a wide tree.
template <std::floating_point T>
struct KdTree8PartsT {
    KdTree8Shape shape{};                 ///< The layout.
    std::vector<KdTree8NodeT<T>> nodes{}; ///< Level by level.
    std::vector<Lanes3T<T>> blocks{};     ///< The points, in blocks of eight.

    /// The point at an index.
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return blocks[index / 8][index % 8];
    }
};

// Builds the nodes, the blocks and the order of a tree.
template <std::floating_point T>
class KdTree8Builder {
public:
    // A point during construction: 16 bytes in float, moved as a unit.
    struct Item {
        using Index = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        T v[3];
        Index index;
        Item() noexcept {} // uninitialised: all items are written before they are read
    };

    KdTree8Builder(const KdTree8Shape& shape, std::vector<KdTree8NodeT<T>>& nodes,
                   std::vector<Lanes3T<T>>& blocks, std::vector<std::uint32_t>& order)
        : shape_(shape), nodes_(nodes), blocks_(blocks), order_(order) {
        for (auto& items : items_) items = std::vector<Item>(shape.points);
    }
    void build(std::span<const Vec3T<T>> points, int threads) {
        constexpr long long piece = 1 << 14;
        if (shape_.points < 2 * piece) threads = 1; // too few to wake threads
        const auto take = [&](std::size_t i) {
            require_finite("a point of the k-d tree", points[i]);
            Item& item = items_[0][i];
            for (int c = 0; c < 3; ++c) item.v[c] = points[i][c];
            item.index = static_cast<typename Item::Index>(i);
        };
        parallel_each(points.size(), piece, take, {.threads = threads});

        // The upper ranges are built level by level, then whole subtrees in parallel.
        const int together = std::min(shape_.halvings, 5);
        for (int depth = 0; depth < together; ++depth)
            parallel_blocks(
                1LL << depth,
                [&](long long number) { halve(depth, std::uint64_t(number)); },
                {.threads = threads});
        parallel_blocks(
            1LL << together,
            [&](long long number) { finish(together, std::uint64_t(number)); },
            {.threads = threads});
    }

private:
    void finish(int depth, std::uint64_t number) {
        halve(depth, number);
        if (depth == shape_.halvings) return;
        finish(depth + 1, 2 * number);
        finish(depth + 1, 2 * number + 1);
    }

    // Processes a range: writes its box into its node, then moves its points to its two
    // halves in the other array, or into its leaf.
    void halve(int depth, std::uint64_t number) {
        const auto point = [&](std::uint64_t block) {
            return std::min(8 * block, shape_.points);
        };
        const std::uint64_t first = point(shape_.first_block(depth, number));
        const std::uint64_t last = point(shape_.first_block(depth, number + 1));
        Item* const from = items_[depth % 2].data() + first;
        Vec3T<T> low, high;
        bounds(from, last - first, low, high);
        const int below = shape_.halvings - depth;
        if (depth > 0 && below % 3 == 0) {
            const int level = shape_.levels - 1 - below / 3;
            KdTree8NodeT<T>& node =
                nodes_[shape_.first[std::size_t(level)] + std::size_t(number / 8)];
            node.low.set(number % 8, low);
            node.high.set(number % 8, high);
        }
        if (below == 0) {
            for (std::uint64_t i = first; i < last; ++i) {
                const Item& item = from[i - first];
                blocks_[i / 8].set(i % 8, {item.v[0], item.v[1], item.v[2]});
                order_[i] = static_cast<std::uint32_t>(item.index);
            }
            return;
        }
        const std::uint64_t middle =
            point(shape_.first_block(depth + 1, 2 * number + 1));
        partition(from, items_[(depth + 1) % 2].data() + first, last - first,
                  middle - first, longest_axis(low, high));
    }
    static void bounds(const Item* items, std::uint64_t count, Vec3T<T>& low,
                       Vec3T<T>& high) noexcept {
        // The fourth lane holds the index; its bits are read but not used.
        T lows[2][4], highs[2][4];
        std::memcpy(lows[0], &items[0], sizeof lows[0]);
        std::memcpy(lows[1], &items[0], sizeof lows[1]);
        std::memcpy(highs, lows, sizeof highs);
        for (std::uint64_t i = 0; i < count; ++i) {
            T v[4];
            std::memcpy(v, &items[i], sizeof v);
            T* const l = lows[i % 2];
            T* const h = highs[i % 2];
            for (int c = 0; c < 4; ++c) {
                l[c] = v[c] < l[c] ? v[c] : l[c];
                h[c] = v[c] > h[c] ? v[c] : h[c];
            }
        }
        for (int c = 0; c < 3; ++c) {
            low[c] = std::min(lows[0][c], lows[1][c]);
            high[c] = std::max(highs[0][c], highs[1][c]);
        }
    }

    // Moves the `rank` items with the least coordinates to the front of `to` and the
    // others behind them. `from` is overwritten.
    // [partition]
    static void partition(Item* from, Item* to, std::uint64_t count, std::uint64_t rank,
                          int axis) {
        while (count > 0) {
            const auto [low, high] = pivots(from, count, rank, axis);
            // Items below the pivots go to the front, those above to the back, and the
            // band between to the front of `from`: three writes and no branch.
            std::uint64_t front = 0, back = count, band = 0;
            for (std::uint64_t i = 0; i < count; ++i) {
                const Item item = from[i];
                const T key = item.v[axis];
                to[front] = item;
                to[back - 1] = item;
                from[band] = item;
                const bool below = key < low;
                const bool above = key > high;
                front += below;
                back -= above;
                band += !(below | above);
            }
            // Equal numbers may be in any order.
            const bool inside = front <= rank && rank <= back;
            if (!inside || low == high || band > count / 2) {
                std::copy(from, from + band, to + front);
                if (!inside || low != high)
                    std::nth_element(to, to + rank, to + count,
                                     [axis](const Item& a, const Item& b) {
                                         return a.v[axis] < b.v[axis];
                                     });
                return;
            }
            to += front;
            rank -= front;
            count = band;
        }
    }
    // [partition]

    // Two numbers that are likely to enclose the item of a rank. For a few items both
    // are that item's coordinate; for many they are estimated from a sample.
    static Extremes<T> pivots(const Item* items, std::uint64_t count,
                              std::uint64_t rank, int axis) {
        constexpr std::uint64_t few = 2048;
        constexpr std::uint64_t sample = 512;
        constexpr std::uint64_t margin = 32; // 2.8 standard deviations of its median
        std::array<T, few> keys;
        const std::uint64_t size = count <= few ? count : sample;
        for (std::uint64_t i = 0; i < size; ++i)
            keys[i] = items[count <= few ? i : i * (count / sample)].v[axis];
        for (std::uint64_t i = size; i % 8 != 0; ++i)
            keys[i] = std::numeric_limits<T>::infinity();
        if (count <= few) {
            const T key = select_smallest(keys.data(), size, rank + 1);
            return {key, key};
        }
        const std::uint64_t middle = rank * sample / count;
        return {
            select_smallest(keys.data(), size, std::max(middle, margin) - margin + 1),
            select_smallest(keys.data(), size, std::min(middle + margin, sample))};
    }

    const KdTree8Shape& shape_;
    std::vector<KdTree8NodeT<T>>& nodes_;
    std::vector<Lanes3T<T>>& blocks_;
    std::vector<std::uint32_t>& order_;
    std::vector<Item> items_[2];
};

/// \}

} // namespace ljus::detail
