#pragma once

/// \file ljus/accel/detail/kd_tree8_build.hpp
/// \brief What the wide k-d tree is made of, where each node lies, and how ranges of
/// points are split.

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

/// Eight boxes side by side: the children of a node.
template <std::floating_point T>
struct KdTree8NodeT {
    Lanes3T<T> low;  ///< Corners with the smallest coordinates.
    Lanes3T<T> high; ///< Opposite corners.
};

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

// Builds the nodes, the blocks and the order of a tree.
template <std::floating_point T>
class KdTree8Builder {
public:
    // A point on its way: 16 bytes in float, moved as one.
    struct Item {
        using Index = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
        T v[3];
        Index index;
        Item() noexcept {} // nothing is set: all are written before they are read
    };

    KdTree8Builder(const KdTree8Shape& shape, std::vector<KdTree8NodeT<T>>& nodes,
                   std::vector<Lanes3T<T>>& blocks, std::vector<std::uint32_t>& order)
        : shape_(shape), nodes_(nodes), blocks_(blocks), order_(order) {
        for (auto& items : items_) items = std::vector<Item>(shape.points);
    }
    void build(std::span<const Vec3T<T>> points, int threads) {
        constexpr long long piece = 1 << 14;
        if (shape_.points < 2 * piece) threads = 1; // not worth waking them
        const auto take = [&](std::size_t i) {
            require_finite("a point of the k-d tree", points[i]);
            Item& item = items_[0][i];
            for (int c = 0; c < 3; ++c) item.v[c] = points[i][c];
            item.index = static_cast<typename Item::Index>(i);
        };
        parallel_each(points.size(), piece, take, {.threads = threads});

        // The upper ranges level by level, then whole subtrees.
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

    // One range: its box into its node; then its points to its two halves, which lie in
    // the other array, or into its leaf.
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
        // Four lanes, of which the index is one: its bits are read, and not used.
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

    // Sends the `rank` items with the smallest coordinates to the front of `to`, the
    // others behind them. What is in `from` is lost.
    // [partition]
    static void partition(Item* from, Item* to, std::uint64_t count, std::uint64_t rank,
                          int axis) {
        while (count > 0) {
            const auto [low, high] = pivots(from, count, rank, axis);
            // Below the pivots to the front, above to the back, the band between them
            // to the front of where it came from: three writes, and no jump.
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
            // In a band of equal numbers any order will do.
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

    // Two numbers between which the item of a rank is likely to lie. Of a few items
    // both are that item's own coordinate; of many they are estimated from a sample.
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
