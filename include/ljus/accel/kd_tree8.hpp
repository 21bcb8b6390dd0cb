#pragma once

/// \file ljus/accel/kd_tree8.hpp
/// \brief A wide k-d tree. A node has eight children, and a search tests eight points
/// together.

#include <optional>

#include "ljus/accel/detail/kd_tree8_results.hpp"

namespace ljus {

/// \defgroup kd_tree8 The wide k-d tree
/// \brief Section 3.2.2 of the report: the k-d tree that the photon maps use.
/// \{

namespace detail {

/// Eight points, some of which a search has found.
template <std::floating_point T>
struct FoundBlockT {
    std::size_t first = 0;    ///< Index of the first point in the tree's order.
    std::uint32_t found = 0;  ///< Bit i: whether point i was found.
    const Lanes3T<T>& points; ///< Positions; NaN beyond the last point of the tree.
    LanesT<T> distance2;      ///< Squared distances; may be infinite.
};

} // namespace detail

/// The fast counterpart of KdTreeT, with the same results. Each node has eight tight
/// boxes. Each leaf has 16 to 32 points, stored in blocks of eight.
///
/// Distances are computed in T, eight at a time. Where the precision of T cannot tell
/// whether a point is within the limit of a search, the distance of that point is
/// computed again in double; see detail::ReachT.
///
/// Searches are const, allocate nothing, and may run in parallel.
template <std::floating_point T>
class KdTree8T {
public:
    /// An empty tree; every search finds nothing.
    KdTree8T() = default;

    /// Builds the tree.
    /// \param points   Fewer than 2^32 points; points may be equal.
    /// \param threads  As in ParallelSettings. The tree does not depend on this number.
    /// \throws std::invalid_argument  if a point is not finite, or if there are too
    ///         many.
    /// \cost O(n log n) for any n points. In float a point takes 16 bytes, 1 to 2 more
    ///       for the boxes, and some more during the build.
    explicit KdTree8T(std::span<const Vec3T<T>> points, int threads = 0)
        : KdTree8T(detail::kd_tree8_items(points), threads) {}

    /// Builds the tree from a list of items, which is empty afterwards.
    KdTree8T(detail::KdTree8ItemsT<T> items, int threads) {
        if (items.size() == 0) return;
        detail::KdTree8Builder<T> builder(items.size());
        parts_ = builder.build(std::move(items), threads);
    }

    /// Makes a tree from data that were built or loaded.
    explicit KdTree8T(detail::KdTree8PartsT<T> parts) : parts_(std::move(parts)) {}

    /// For each point of the tree, its index in the span that the tree was built from.
    [[nodiscard]] std::span<const std::uint32_t> point_ids() const noexcept {
        return parts_.order.span();
    }

    /// The points in the tree's order, in blocks of eight.
    [[nodiscard]] std::span<const detail::Lanes3T<T>> blocks() const noexcept {
        return parts_.blocks.span();
    }

    /// The tree's data.
    [[nodiscard]] const detail::KdTree8PartsT<T>& parts() const noexcept {
        return parts_;
    }

    /// The point at an index in the tree's order, below size().
    [[nodiscard]] Vec3T<T> point(std::size_t index) const noexcept {
        return parts_.point(index);
    }

    /// The number of points.
    [[nodiscard]] std::size_t size() const noexcept { return parts_.order.size(); }

    /// The number of halvings from all points down to a leaf.
    [[nodiscard]] int halvings() const noexcept { return parts_.shape.halvings; }

    /// The index of the first point of a range, in the tree's order. The points are
    /// halved `depth` times into 2^depth ranges; depth is at most halvings(). A range
    /// ends where the next one begins. For range number 2^depth, the result is size().
    [[nodiscard]] std::size_t first_point(int depth,
                                          std::uint64_t number) const noexcept {
        return std::min(size(),
                        8 * std::size_t(parts_.shape.first_block(depth, number)));
    }

    /// The size of the tree's arrays in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return parts_.blocks.span().size_bytes() + parts_.order.span().size_bytes() +
               parts_.nodes.span().size_bytes();
    }

    /// Calls `visit(found)`, with a FoundBlockT, for each block of eight points that
    /// has points within a closed ball. The ball is given as for
    /// KdTreeT::visit_within().
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

    /// See KdTreeT::visit_within().
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

    /// See KdTreeT::any_within().
    [[nodiscard]] bool any_within(const Vec3T<T>& center, T radius) const {
        return within(center, radius, [](std::size_t, std::uint32_t) { return true; });
    }

    /// See KdTreeT::nearest().
    [[nodiscard]] std::optional<Neighbor>
    nearest(const Vec3T<T>& center,
            T radius = std::numeric_limits<T>::infinity()) const {
        if (parts_.blocks.empty()) return std::nullopt;
        detail::NearestOneT<T> results{.reach = detail::ReachT<T>::ball(radius)};
        detail::walk(parts_, center, results);
        return results.best;
    }

    /// See KdTreeT::nearest(). In `found` the first point is the farthest, and the
    /// others are unsorted.
    /// \tparam Most  An upper bound on found.size(). If it is at most 512, less code is
    ///               compiled.
    template <std::size_t Most = std::numeric_limits<std::size_t>::max(),
              typename Wanted = detail::AnyPoint>
    [[nodiscard]] std::size_t nearest(const Vec3T<T>& center, T radius,
                                      std::span<Neighbor> found,
                                      Wanted wanted = {}) const {
        if (found.empty() || parts_.blocks.empty()) return 0;
        if constexpr (Most > detail::max_counted &&
                      std::is_same_v<Wanted, detail::AnyPoint>)
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
};
using KdTree8 = KdTree8T<float>; ///< KdTree8T in float.

/// \}

} // namespace ljus
