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
#include "ljus/accel/detail/stored_array.hpp"
#include "ljus/accel/neighbor.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"
#include "ljus/ref.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

/// The boxes of a node's eight children, stored coordinate by coordinate.
template <std::floating_point T>
struct KdTree8NodeT {
    Lanes3T<T> low;  ///< The corners with the smallest coordinates.
    Lanes3T<T> high; ///< The corners with the largest coordinates.
};

/// The layout of a wide tree. The positions of nodes and leaves are computed, so that
/// the tree needs no pointers.
///
/// The points are grouped into blocks of eight, and the blocks are distributed evenly
/// among the leaves. The number of leaves is a power of two. The list of points is
/// halved repeatedly, down to the leaves. A node with eight children combines three
/// halvings; the root may have fewer children.
struct KdTree8Shape {
    static constexpr int leaf_blocks = 4; ///< Largest number of blocks per leaf.

    std::uint64_t points = 0; ///< Number of points.
    std::uint64_t blocks = 0; ///< Number of blocks.
    int halvings = 0;         ///< Number of halvings from the root to a leaf.
    int levels = 0;           ///< Number of levels of nodes.
    /// The index of each level's first node, then the number of nodes.
    std::array<std::uint32_t, 12> first{};

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
    /// The first block of a range. The list of blocks, halved `depth` times, has
    /// 2^depth ranges, and `number` is the index of one of them. A range ends where the
    /// next one begins.
    [[nodiscard]] constexpr std::uint64_t first_block(int depth,
                                                      std::uint64_t number) const {
        return ((number << (halvings - depth)) * blocks) >> halvings;
    }
};

/// The data of a wide tree.
template <std::floating_point T>
struct KdTree8PartsT {
    KdTree8Shape shape{};                 ///< The layout.
    StoredArray<KdTree8NodeT<T>> nodes{}; ///< The nodes, level by level.
    StoredArray<Lanes3T<T>> blocks{};     ///< The points, in blocks of eight.
    StoredArray<std::uint32_t> order{};   ///< Each point's index before the build.

    /// The point at an index in the tree's order.
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return blocks[index / 8][index % 8];
    }
};

/// A point and its index during construction. In float they take 16 bytes.
template <std::floating_point T>
struct KdTree8ItemT {
    using Index = std::conditional_t<sizeof(T) == 4, std::uint32_t, std::uint64_t>;
    T v[3];
    Index index;
    KdTree8ItemT() noexcept {} // uninitialised: items are written before they are read
    KdTree8ItemT(const Vec3T<T>& point, std::size_t number) noexcept
        : v{point.x, point.y, point.z}, index(static_cast<Index>(number)) {}
};

/// A list of items, stored in pieces. Each piece is freed when it has been read. The
/// list and the result that is made from it are therefore never both whole in memory.
template <std::floating_point T>
class KdTree8ItemsT {
public:
    using Item = KdTree8ItemT<T>;                 ///< The type of the elements.
    static constexpr std::size_t piece = 1 << 13; ///< Items per piece.

    /// Pieces that were read, which other lists of the same thread use again.
    using Spare = std::vector<GrowingArray<Item>>;

    /// The number of items.
    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Item number i. Its piece must not have been freed by drain().
    [[nodiscard]] const Item& operator[](std::size_t i) const noexcept {
        return pieces_[i / piece][i % piece];
    }
    /// Unused memory behind the last item, with space for at least one more. take()
    /// adds the items that were written into this memory.
    [[nodiscard]] std::span<Item> room() {
        if (size_ == piece * pieces_.size()) add_piece();
        return {pieces_.back().data() + size_ % piece, piece - size_ % piece};
    }
    /// Adds the first `count` items that were written into room().
    void take(std::size_t count) noexcept { size_ += count; }
    /// Adds a point. Its index is the number of items before it.
    /// \throws std::invalid_argument  if the point is not finite.
    void add(const Vec3T<T>& point) {
        require_finite("a point of the k-d tree", point);
        push({point, size_});
    }
    /// Sets the list that keeps the pieces after they are read. If `spare` is null,
    /// the pieces are freed.
    void share(Spare* spare) noexcept { spare_ = spare; }
    /// Adds an item.
    void push(const Item& item) {
        room()[0] = item;
        take(1);
    }
    /// Adds items, the last one first if `backwards` is true. This function and drain()
    /// are not inlined, which saves compile time and costs no run time.
    [[gnu::noinline]] void push_all(std::span<const Item> items,
                                    bool backwards = false) {
        for (std::size_t i = 0; i < items.size(); ++i)
            push(items[backwards ? items.size() - 1 - i : i]);
    }
    /// Calls use(items) for each piece, and frees the piece afterwards. If `backwards`
    /// is true, the last piece comes first. The list is empty at the end.
    [[gnu::noinline]] void drain(FunctionRef<void(std::span<const Item>)> use,
                                 bool backwards = false) {
        const std::size_t count = pieces_.size();
        for (std::size_t n = 0; n < count; ++n) {
            const std::size_t k = backwards ? count - 1 - n : n;
            GrowingArray<Item> read = std::move(pieces_[k]);
            use({read.data(), std::min(piece, size_ - k * piece)});
            if (spare_ != nullptr) spare_->push_back(std::move(read));
        }
        *this = {};
    }
    /// Moves all items into one array. The list is empty at the end.
    [[nodiscard]] GrowingArray<Item> joined() {
        GrowingArray<Item> all(size_);
        Item* end = all.data();
        const auto add = [&](std::span<const Item> items) {
            end = std::copy(items.data(), items.data() + items.size(), end);
        };
        drain(add);
        return all;
    }

private:
    [[gnu::cold]] void add_piece() {
        if (spare_ == nullptr || spare_->empty()) {
            pieces_.push_back(GrowingArray<Item>(piece));
        } else {
            pieces_.push_back(std::move(spare_->back()));
            spare_->pop_back();
        }
    }

    Spare pieces_;
    std::size_t size_ = 0;
    Spare* spare_ = nullptr;
};

/// Makes a list of items from points.
/// \throws std::invalid_argument  if a point is not finite, or if there are too many.
template <std::floating_point T>
[[nodiscard]] KdTree8ItemsT<T> kd_tree8_items(std::span<const Vec3T<T>> points) {
    require_point_count(points.size());
    KdTree8ItemsT<T> items;
    for (std::size_t i = 0; i < points.size(); ++i) items.add(points[i]);
    return items;
}

// Builds the nodes, the blocks and the order of a tree.
template <std::floating_point T>
class KdTree8Builder {
public:
    using Item = KdTree8ItemT<T>;
    using Items = KdTree8ItemsT<T>;

    explicit KdTree8Builder(std::size_t points) : shape_(KdTree8Shape::of(points)) {
        nodes_.resize(shape_.first[std::size_t(shape_.levels)]);
        std::fill_n(nodes_.data(), nodes_.size(), KdTree8NodeT<T>{});
    }

    // Divides the points level by level, in lists, into the ranges of whole subtrees.
    // Then builds the subtrees in parallel, in arrays, and frees their items.
    [[nodiscard, gnu::cold]] KdTree8PartsT<T> build(Items items, int threads) {
        if (shape_.points < 4 * Items::piece) threads = 1; // too few to wake threads
        int depth = 0;
        std::vector<Items> ranges(1);
        ranges[0] = std::move(items);
        for (; depth < shape_.halvings && (shape_.points >> depth) > 16 * Items::piece;
             ++depth) {
            std::vector<Items> halves(2 * ranges.size());
            parallel_blocks(static_cast<long long>(ranges.size()),
                            [&](long long number) {
                                const auto i = static_cast<std::size_t>(number);
                                divide(depth, i, ranges[i], halves[2 * i],
                                       halves[2 * i + 1]);
                                halves[2 * i].share(nullptr);
                                halves[2 * i + 1].share(nullptr);
                            },
                            {.threads = threads});
            ranges = std::move(halves);
        }
        constexpr std::uint64_t many = 1 << 18;
        std::uint64_t given_back = 0; // points whose lists are freed
        const std::size_t together =
            2 * static_cast<std::size_t>(threads == 0 ? max_threads() : threads);
        for (std::size_t i = 0; i < ranges.size(); i += together) {
            const std::size_t end = std::min(i + together, ranges.size());
            blocks_.resize(shape_.first_block(depth, end));
            order_.resize(first_point(depth, end));
            if (end == ranges.size()) pad();
            parallel_blocks(static_cast<long long>(end - i),
                            [&](long long number) {
                                const std::size_t n = i + std::size_t(number);
                                GrowingArray<Item> from = ranges[n].joined();
                                GrowingArray<Item> to(from.size());
                                finish(depth, n, from.data(), to.data());
                            },
                            {.threads = threads});
            if (order_.size() < given_back + many) continue;
            given_back = order_.size();
            give_back_memory();
        }
        blocks_.shrink_to_fit();
        order_.shrink_to_fit();
        return {shape_, std::move(nodes_), std::move(blocks_), std::move(order_)};
    }

private:
    void pad() { // fills the last block with NaN
        constexpr T nan = std::numeric_limits<T>::quiet_NaN();
        for (std::uint64_t i = shape_.points; i < 8 * shape_.blocks; ++i)
            blocks_[i / 8].set(i % 8, Vec3T<T>{nan});
    }
    [[nodiscard]] std::uint64_t first_point(int depth, std::uint64_t number) const {
        return std::min(8 * shape_.first_block(depth, number), shape_.points);
    }
    // Writes the box of a range into its node.
    void write(int depth, std::uint64_t number, const Vec3T<T>& low,
               const Vec3T<T>& high) {
        const int below = shape_.halvings - depth;
        if (depth == 0 || below % 3 != 0) return;
        const int level = shape_.levels - 1 - below / 3;
        KdTree8NodeT<T>& node =
            nodes_[shape_.first[std::size_t(level)] + std::size_t(number / 8)];
        node.low.set(number % 8, low);
        node.high.set(number % 8, high);
    }
    // Moves the points of a range to its halves, in the order of partition().
    [[gnu::cold]] void divide(int depth, std::uint64_t number, Items& from, Items& low,
                              Items& high) {
        const std::uint64_t count = from.size();
        const std::uint64_t rank =
            first_point(depth + 1, 2 * number + 1) - first_point(depth, number);
        Vec3T<T> box_low, box_high;
        bounds(from, count, box_low, box_high);
        write(depth, number, box_low, box_high);
        const int axis = longest_axis(box_low, box_high);
        const Extremes<T> pivot = pivots(from, count, rank, axis);
        // clang 14 does not let a lambda use a structured binding.
        const T least = pivot.low, most = pivot.high;
        Items above, between;
        typename Items::Spare spare;
        for (Items* const list : {&from, &low, &high, &above, &between})
            list->share(&spare);
        const auto split = [&](std::span<const Item> items) {
            for (std::size_t i = 0; i < items.size();) {
                const auto to_low = low.room(), to_above = above.room(),
                           to_between = between.room();
                const std::size_t end =
                    i + std::min({items.size() - i, to_low.size(), to_above.size(),
                                  to_between.size()});
                std::size_t front = 0, back = 0, band = 0;
                for (; i < end; ++i) {
                    const Item item = items[i];
                    const T key = item.v[axis];
                    to_low[front] = item;
                    to_above[back] = item;
                    to_between[band] = item;
                    const bool is_low = key < least;
                    const bool is_above = key > most;
                    front += is_low;
                    back += is_above;
                    band += !(is_low | is_above);
                }
                low.take(front);
                above.take(back);
                between.take(band);
            }
        };
        from.drain(split);
        const std::uint64_t front = low.size();
        const bool inside = front <= rank && rank <= count - above.size();
        if (!inside || (least != most && between.size() > count / 2)) {
            GrowingArray<Item> all = low.joined();
            all.resize(count);
            Item* end = all.data() + front;
            const auto add = [&](std::span<const Item> items) {
                end = std::copy(items.data(), items.data() + items.size(), end);
            };
            const auto add_reversed = [&](std::span<const Item> items) {
                end = std::reverse_copy(items.data(), items.data() + items.size(), end);
            };
            between.drain(add);
            above.drain(add_reversed, true);
            select(all.data(), count, rank, axis);
            low.push_all({all.data(), all.data() + rank});
            high.push_all({all.data() + rank, all.data() + count});
            return;
        }
        GrowingArray<Item> band = between.joined();
        if (least != most) {
            GrowingArray<Item> sorted(band.size());
            partition(band.data(), sorted.data(), band.size(), rank - front, axis);
            band = std::move(sorted);
        }
        Item* const middle = band.data() + (rank - front);
        low.push_all({band.data(), middle});
        high.push_all({middle, band.data() + band.size()});
        const auto push_reversed = [&](std::span<const Item> items) {
            high.push_all(items, true);
        };
        above.drain(push_reversed, true);
    }
    // Builds a subtree from the items in `from`. `to` has room for the same number.
    void finish(int depth, std::uint64_t number, Item* from, Item* to) {
        const std::uint64_t first = first_point(depth, number);
        const std::uint64_t count = first_point(depth, number + 1) - first;
        Vec3T<T> low, high;
        bounds(from, count, low, high);
        write(depth, number, low, high);
        if (depth == shape_.halvings) {
            for (std::uint64_t i = 0; i < count; ++i) {
                const Item& item = from[i];
                blocks_[(first + i) / 8].set((first + i) % 8,
                                             {item.v[0], item.v[1], item.v[2]});
                order_[first + i] = static_cast<std::uint32_t>(item.index);
            }
            return;
        }
        const std::uint64_t half = first_point(depth + 1, 2 * number + 1) - first;
        partition(from, to, count, half, longest_axis(low, high));
        finish(depth + 1, 2 * number, to, from);
        finish(depth + 1, 2 * number + 1, to + half, from + half);
    }
    template <typename List> // an array or a list
    static void bounds(const List& items, std::uint64_t count, Vec3T<T>& low,
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
            // Items below the pivots go to the front of `to`, items above to its back,
            // and the band between to the front of `from`. Each item is written three
            // times, without a branch.
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
                if (!inside || low != high) select(to, count, rank, axis);
                return;
            }
            to += front;
            rank -= front;
            count = band;
        }
    }
    // [partition]

    static void select(Item* items, std::uint64_t count, std::uint64_t rank, int axis) {
        std::nth_element(
            items, items + rank, items + count,
            [axis](const Item& a, const Item& b) { return a.v[axis] < b.v[axis]; });
    }

    // Two numbers that are likely to enclose the coordinate of the item with a given
    // rank. For few items both are that coordinate. For many items they are estimated
    // from a sample.
    template <typename List>
    static Extremes<T> pivots(const List& items, std::uint64_t count,
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

    const KdTree8Shape shape_;
    GrowingArray<KdTree8NodeT<T>> nodes_;
    GrowingArray<Lanes3T<T>> blocks_;
    GrowingArray<std::uint32_t> order_;
};

/// \}

} // namespace ljus::detail
