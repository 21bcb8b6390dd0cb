#pragma once

/// \file ljus/accel/kd_tree8.hpp
/// \brief The fast k-d tree: eight children a node, eight points at a time.

#include <optional>

#include "ljus/accel/detail/kd_tree8_build.hpp"

namespace ljus {

/// \defgroup kd_tree8 The wide k-d tree
/// \brief Section 3.2.2: the k-d tree that the photon maps use.
/// \{

/// Eight points of which a search has found some.
template <std::floating_point T>
struct FoundBlockT {
    std::size_t first = 0;   ///< The place of the first of them in the tree's order.
    std::uint32_t found = 0; ///< Which are found: a bit each, the first point's lowest.
    const BlockT<T>& points; ///< Where they lie; NaN behind the last point of all.
    LanesT<T> distance2;     ///< Squared, in T; for those found, at most infinite.
};

/// The twin of KdTreeT, with the same answers: a k-d tree \cite bentley1975 of tight
/// boxes, eight to a node, over leaves of 16 to 32 points in lanes, without a single
/// pointer.
///
/// Distances are formed in T, eight at a time; those so near to the limit of a search
/// that T cannot tell are formed once more in double, as everywhere: see ReachT.
///
/// The tree keeps the positions; what belongs to them is the caller's, put into the
/// tree's order with order(), eight to a block. Searches are const, take no memory, and
/// may run on any number of threads.
template <std::floating_point T>
class KdTree8T {
public:
    /// An empty tree: every search finds nothing.
    KdTree8T() = default;

    /// Builds the tree.
    /// \param points   Any points, equal ones too; below 2^32.
    /// \param threads  As in ParallelSettings; the tree is the same for any number.
    /// \throws std::invalid_argument  if a point is not finite.
    /// \cost O(n log n), whatever the points; 16 bytes a point in float and about 1 for
    ///       the boxes, and 32 more while it is built.
    explicit KdTree8T(std::span<const Vec3T<T>> points, int threads = 0) {
        require(points.size() <= std::numeric_limits<std::uint32_t>::max(),
                "the number of points in a k-d tree",
                static_cast<long long>(points.size()), "below 2^32");
        if (points.empty()) return;
        shape_ = KdTree8Shape::of(points.size());
        constexpr T nan = std::numeric_limits<T>::quiet_NaN();
        nodes_.resize(shape_.first[std::size_t(shape_.levels)]);
        blocks_.resize(shape_.blocks);
        for (std::size_t i = 0; i < 8; ++i) blocks_.back().set(i, Vec3T<T>{nan});
        order_.resize(points.size());
        detail::KdTree8Builder<T>(shape_, nodes_, blocks_, order_)
            .build(points, threads);
    }

    /// Where the points came from: order()[i] is the number of the i-th point of the
    /// tree in the span it was built from.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const noexcept {
        return order_;
    }

    /// The points, in the tree's order, eight by eight.
    [[nodiscard]] const std::vector<BlockT<T>>& blocks() const noexcept {
        return blocks_;
    }

    /// One point.
    /// \param index  In the tree's order, below size().
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return blocks_[index / 8][index % 8];
    }

    /// How many points there are.
    [[nodiscard]] std::size_t size() const noexcept { return order_.size(); }

    /// How many bytes the tree takes, without its own few.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return blocks_.size() * sizeof(blocks_[0]) + order_.size() * sizeof(order_[0]) +
               nodes_.size() * sizeof(nodes_[0]);
    }

    /// Calls `visit(found)` with a FoundBlockT for each block of eight that has points
    /// within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  Not squared; infinity for all. Below 0, and if it or the centre
    ///                is NaN, the ball is empty.
    /// \param visit   Takes the block; the payload of its points has the same places.
    // [blocks]
    template <typename Visit>
    void visit_blocks(const Vec3T<T>& center, T radius, Visit&& visit) const {
        const auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
        in_ball(center, radius, reach, [&](std::size_t first, std::size_t last) {
            std::uint32_t found = in_leaf(first, last, center, reach);
            for (std::size_t b = first; found != 0; ++b, found >>= 8)
                if ((found & 255) != 0)
                    visit(FoundBlockT<T>{8 * b, found & 255, blocks_[b],
                                         distances2(blocks_[b], center)});
            return false;
        });
    }
    // [blocks]

    /// Calls `visit(index, distance2)` for each point within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \param visit   Takes the place in the tree's order and the squared distance.
    template <typename Visit>
    void visit_within(const Vec3T<T>& center, T radius, Visit&& visit) const {
        const auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
        in_ball(center, radius, reach, [&](std::size_t first, std::size_t last) {
            for (std::uint32_t found = in_leaf(first, last, center, reach); found != 0;
                 found &= found - 1) {
                const std::size_t i =
                    8 * first + static_cast<std::size_t>(std::countr_zero(found));
                visit(static_cast<std::uint32_t>(i), distance2(point(i), center));
            }
            return false;
        });
    }

    /// Whether any point lies within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    [[nodiscard]] bool any_within(const Vec3T<T>& center, T radius) const {
        const auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
        return in_ball(center, radius, reach, [&](std::size_t first, std::size_t last) {
            return in_leaf(first, last, center, reach) != 0;
        });
    }

    /// The nearest point within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \return Of several that are equally far, any, but always the same one; nothing
    ///         if the ball is empty.
    [[nodiscard]] std::optional<Neighbor>
    nearest(const Vec3T<T>& center,
            T radius = std::numeric_limits<T>::infinity()) const;

    /// The k nearest points within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \param found   Room for as many as are wanted; the farthest is put first, the
    ///                others in any order.
    /// \param wanted  Called with a place in the tree's order; false passes it over.
    /// \return How many were found; of several that are equally far, any, but always
    ///         the same ones.
    /// \cost In the mean O(log n) and some steps a point that is wanted, also where
    ///       many points are equal; where few of those around are wanted, more.
    template <typename Wanted = AnyPoint>
    [[nodiscard]] std::size_t nearest(const Vec3T<T>& center, T radius,
                                      std::span<Neighbor> found,
                                      Wanted wanted = {}) const;

private:
    // The most that are selected by counting; more go through a heap.
    static constexpr std::size_t max_counted = 512;

    // Which points of a leaf lie within reach, exactly: a bit each.
    // [leaf]
    std::uint32_t in_leaf(std::size_t first, std::size_t last, const Vec3T<T>& center,
                          const ReachT<T>& reach) const noexcept {
        constexpr std::uint32_t bit[lane_count] = {1, 2, 4, 8, 16, 32, 64, 128};
        const T possible = reach.last, beyond_doubt = reach.sure;
        std::uint32_t near[lane_count] = {}, sure[lane_count] = {};
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> d2 = distances2(blocks_[b], center);
            for_lanes([&](int i) {
                const std::uint32_t here = d2.lane[i] <= possible ? bit[i] << 24 : 0u;
                near[i] = near[i] >> 8 | here;
            });
            for_lanes([&](int i) {
                const std::uint32_t here =
                    d2.lane[i] <= beyond_doubt ? bit[i] << 24 : 0u;
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
            if (!reach.holds(distance2(point(8 * first + std::size_t(i)), center)))
                found &= ~(1u << i);
        }
        return found;
    }
    // [leaf]

    template <typename Visit>
    bool in_ball(const Vec3T<T>& center, T radius, const ReachT<T>& reach,
                 Visit visit) const;
    template <typename Visit>
    void towards(const Vec3T<T>& center, const ReachT<T>& reach, Visit visit) const;
    template <typename Wanted>
    std::size_t count_nearest(const Vec3T<T>& center, ReachT<T> reach,
                              std::span<Neighbor> found, Wanted& wanted) const;

    KdTree8Shape shape_;
    std::vector<KdTree8NodeT<T>> nodes_;
    std::vector<BlockT<T>> blocks_;
    std::vector<std::uint32_t> order_;
};
using KdTree8 = KdTree8T<float>; ///< KdTree8T in float.

/// \}

} // namespace ljus

#include "ljus/accel/detail/kd_tree8_search.hpp"
#include "ljus/accel/detail/kd_tree8_traverse.hpp"
