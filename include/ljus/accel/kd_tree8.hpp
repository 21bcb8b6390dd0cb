#pragma once

/// \file ljus/accel/kd_tree8.hpp
/// \brief The fast k-d tree: eight children a node, eight points at a time.

#include <optional>

#include "ljus/accel/detail/kd_tree8_results.hpp"

namespace ljus {

/// \defgroup kd_tree8 The wide k-d tree
/// \brief Section 3.2.2: the k-d tree that the photon maps use.
/// \{

namespace detail {

/// Eight points of which a search has found some.
template <std::floating_point T>
struct FoundBlockT {
    std::size_t first = 0;   ///< The place of the first of them in the tree's order.
    std::uint32_t found = 0; ///< Which are found: a bit each, the first point's lowest.
    const detail::Lanes3T<T>&
        points;                  ///< Where they lie; NaN behind the last point of all.
    detail::LanesT<T> distance2; ///< Squared, in T; for those found, at most infinite.
};

} // namespace detail

/// The twin of KdTreeT, with the same answers: a k-d tree \cite bentley1975 of tight
/// boxes, eight to a node, over leaves of 16 to 32 points in lanes, without a single
/// pointer.
///
/// Distances are formed in T, eight at a time; those so near to the limit of a search
/// that T cannot tell are formed once more in double, as everywhere: see
/// detail::ReachT.
///
/// The tree keeps the positions only. What belongs to them is the caller's, who puts it
/// into the tree's order: then a search reads memory that lies together.
///
///     std::vector<Vec3> positions;
///     for (const MyPhoton& photon : photons) positions.push_back(photon.position);
///     const KdTree8 tree{std::span<const Vec3>(positions)};
///     std::vector<MyPhoton> sorted; // sorted[i] belongs to tree.point(i)
///     for (const std::uint32_t id : tree.point_ids()) sorted.push_back(photons[id]);
///     tree.visit_within(x, radius, [&](std::uint32_t i, double distance2) {
///         flux += sorted[i].flux;
///     });
///
/// It has the searches of KdTreeT, by the same names, and visit_blocks() for those who
/// work on eight points at a time. All of them are one walk of the tree,
/// detail::walk(), with what is to be kept as an argument. Searches are const, take no
/// memory, and may run on any number of threads.
template <std::floating_point T>
class KdTree8T {
public:
    /// An empty tree: every search finds nothing.
    KdTree8T() = default;

    /// Builds the tree.
    /// \param points   Any points, equal ones too; below 2^32.
    /// \param threads  As in ParallelSettings; the tree is the same for any number.
    /// \throws std::invalid_argument  if a point is not finite.
    /// \cost O(n log n), whatever the points; in float 16 bytes per point and about 1
    ///       for the boxes, and 32 more while it is built.
    explicit KdTree8T(std::span<const Vec3T<T>> points, int threads = 0) {
        require(points.size() <= std::numeric_limits<std::uint32_t>::max(),
                "the number of points in a k-d tree",
                static_cast<long long>(points.size()), "below 2^32");
        if (points.empty()) return;
        parts_.shape = detail::KdTree8Shape::of(points.size());
        constexpr T nan = std::numeric_limits<T>::quiet_NaN();
        parts_.nodes = std::vector<detail::KdTree8NodeT<T>>(
            parts_.shape.first[std::size_t(parts_.shape.levels)]);
        parts_.blocks = std::vector<detail::Lanes3T<T>>(parts_.shape.blocks);
        detail::for_lanes(
            [&](int i) { parts_.blocks.back().set(std::size_t(i), Vec3T<T>{nan}); });
        point_ids_ = std::vector<std::uint32_t>(points.size());
        detail::KdTree8Builder<T>(parts_.shape, parts_.nodes, parts_.blocks, point_ids_)
            .build(points, threads);
    }

    /// Where the points came from: the i-th point of the tree is number point_ids()[i]
    /// of the span it was built from.
    [[nodiscard]] const std::vector<std::uint32_t>& point_ids() const noexcept {
        return point_ids_;
    }

    /// The points, in the tree's order, eight by eight.
    [[nodiscard]] const std::vector<detail::Lanes3T<T>>& blocks() const noexcept {
        return parts_.blocks;
    }

    /// One point.
    /// \param index  In the tree's order, below size().
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return parts_.blocks[index / 8][index % 8];
    }

    /// How many points there are.
    [[nodiscard]] std::size_t size() const noexcept { return point_ids_.size(); }

    /// How many bytes the tree takes, without its own few.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return parts_.blocks.size() * sizeof(parts_.blocks[0]) +
               point_ids_.size() * sizeof(point_ids_[0]) +
               parts_.nodes.size() * sizeof(parts_.nodes[0]);
    }

    /// Calls `visit(found)` with a FoundBlockT for each block of eight that has points
    /// within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  Not squared; infinity for all. Below 0, and if it or the centre
    ///                is NaN, the ball is empty.
    /// \param visit   Takes the block; the payload of its points has the same places.
    template <typename Visit>
    void visit_blocks(const Vec3T<T>& center, T radius, Visit&& visit) const {
        within(center, radius, [&](std::size_t first, std::uint32_t found) {
            for (std::size_t b = first; found != 0; ++b, found >>= 8)
                if ((found & 255) != 0)
                    visit(detail::FoundBlockT<T>{
                        8 * b, found & 255, parts_.blocks[b],
                        detail::distances2(parts_.blocks[b], center)});
            return false;
        });
    }

    /// The blocks that visit_blocks() visits, for many balls of one radius together:
    /// the one search that is another walk, see detail::find_in_balls().
    template <typename Center, typename Expect>
    void find_in_balls(std::size_t balls, Center center, T radius, Expect expect,
                       detail::BallBlocks& found) const {
        detail::find_in_balls(parts_, balls, center, radius, expect, found);
    }
    /// Calls `visit(index, distance2)` for each point within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \param visit   Takes the place in the tree's order and the squared distance.
    template <typename Visit>
    void visit_within(const Vec3T<T>& center, T radius, Visit&& visit) const {
        within(center, radius, [&](std::size_t first, std::uint32_t found) {
            for (; found != 0; found &= found - 1) {
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
        return within(center, radius, [](std::size_t, std::uint32_t) { return true; });
    }

    /// The nearest point within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \return Of several that are equally far, any, but always the same one; nothing
    ///         if the ball is empty.
    [[nodiscard]] std::optional<Neighbor>
    nearest(const Vec3T<T>& center,
            T radius = std::numeric_limits<T>::infinity()) const {
        if (parts_.blocks.empty()) return std::nullopt;
        detail::NearestOneT<T> results{.reach = detail::ReachT<T>::ball(radius)};
        detail::walk(parts_, center, results);
        return results.best;
    }

    /// The k nearest points within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  As for visit_blocks().
    /// \param found   Room for as many as are wanted; the farthest is put first, the
    ///                others in any order.
    /// \param wanted  Called with a place in the tree's order; false passes it over.
    /// \tparam Most   The caller promises to want no more: up to 512 a compiler is
    ///                spared the heap that more of them need.
    /// \return How many were found; of several that are equally far, any, but always
    ///         the same ones.
    /// \cost In the mean O(log n) and some steps a point that is wanted, also where
    ///       many points are equal; where few of those around are wanted, more.
    template <std::size_t Most = std::numeric_limits<std::size_t>::max(),
              typename Wanted = detail::AnyPoint>
    [[nodiscard]] std::size_t nearest(const Vec3T<T>& center, T radius,
                                      std::span<Neighbor> found,
                                      Wanted wanted = {}) const {
        if (found.empty() || parts_.blocks.empty()) return 0;
        if constexpr (std::is_same_v<Wanted, detail::AnyPoint>)
            if (found.size() == 1) {
                const auto one = nearest(center, radius);
                if (one) found[0] = *one;
                return one ? 1 : 0;
            }
        const auto reach = detail::ReachT<T>::ball(radius);
        if constexpr (Most > detail::max_counted)
            if (found.size() > detail::max_counted) {
                detail::NearestHeapT<T, Wanted> results{
                    .reach = reach,
                    .wanted = wanted,
                    .best = {.found = found, .limit2 = reach.limit2}};
                detail::walk(parts_, center, results);
                return results.best.count;
            }
        detail::NearestCountedT<T, Wanted> results(reach, wanted, found.size());
        detail::walk(parts_, center, results);
        return results.give(parts_, center, found);
    }

private:
    template <typename Visit>
    bool within(const Vec3T<T>& center, T radius, Visit visit) const {
        detail::WithinT<T, Visit> results{.reach = detail::ReachT<T>::ball(radius),
                                          .visit = visit};
        return detail::walk(parts_, center, results);
    }

    detail::KdTree8PartsT<T> parts_;
    std::vector<std::uint32_t> point_ids_;
};
using KdTree8 = KdTree8T<float>; ///< KdTree8T in float.

/// \}

} // namespace ljus
