#pragma once

/// \file ljus/accel/kd_tree.hpp
/// \brief A k-d tree, which finds the points near a position.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ljus/accel/neighbor.hpp"

namespace ljus {

/// \defgroup kd_tree The k-d tree
/// \brief Section 3.2.2 of the report: "whenever a photon hits a surface, it is stored
/// in a k-d tree".
/// \{

/// A balanced k-d tree without pointers \cite bentley1975. It keeps the points in an
/// array. Each range of the array has a box, and is split at the median along the
/// longest axis of the box, down to leaves of a few points. A search far from all boxes
/// ends at once.
///
/// The tree stores positions only. The caller sorts other data into the tree's order,
/// so that a search reads contiguous memory:
///
///     std::vector<Vec3> positions;
///     for (const MyPhoton& photon : photons) positions.push_back(photon.position);
///     const KdTree tree{std::span<const Vec3>(positions)};
///     std::vector<MyPhoton> sorted; // sorted[i] belongs to tree.point(i)
///     for (const std::uint32_t id : tree.point_ids()) sorted.push_back(photons[id]);
///     tree.visit_within(x, radius, [&](std::uint32_t i, double distance2) {
///         flux += sorted[i].flux;
///     });
///
/// Searches are const, allocate nothing, and may run in parallel. KdTree8T has the same
/// interface.
template <std::floating_point T>
class KdTreeT {
public:
    /// An empty tree; every search finds nothing.
    KdTreeT() = default;

    /// Builds the tree.
    /// \param points  Fewer than 2^32 points; points may be equal.
    /// \throws std::invalid_argument  if a point is not finite, or if there are too
    ///         many.
    /// \cost O(n log n) for any n points. In float a point takes 16 bytes, and 3 to 12
    ///       more for the boxes.
    explicit KdTreeT(std::span<const Vec3T<T>> points) {
        detail::require_point_count(points.size());
        point_ids_.reserve(points.size());
        points_.reserve(points.size());
        for (const Vec3T<T>& point : points) {
            require_finite("a point of the k-d tree", point);
            point_ids_.push_back(static_cast<std::uint32_t>(point_ids_.size()));
        }
        if (!points.empty()) build(points, 0, 0, points.size());
        for (const std::uint32_t index : point_ids_) points_.push_back(points[index]);
    }

    /// For each point of the tree, its index in the span that the tree was built from.
    [[nodiscard]] const std::vector<std::uint32_t>& point_ids() const noexcept {
        return point_ids_;
    }
    /// The points, in the tree's order.
    [[nodiscard]] const std::vector<Vec3T<T>>& points() const noexcept {
        return points_;
    }
    /// The point at an index in the tree's order, below size().
    [[nodiscard]] const Vec3T<T>& point(std::size_t index) const noexcept {
        return points_[index];
    }
    /// The number of points.
    [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }

    /// The traversal of every search; a caller can use it for other searches. It visits
    /// the nearer half of a range first.
    /// \param center   Centre of the search.
    /// \param offer    Called as offer(index, distance2) with each visited point.
    /// \param reaches  Called as reaches(distance2) with the squared distance to the
    ///                 box of a range. If it returns false, the points of the range are
    ///                 skipped.
    template <typename Offer, typename Reaches>
    void walk(const Vec3T<T>& center, Offer&& offer, Reaches&& reaches) const {
        if (!points_.empty() && reaches(distance2_to(0, center)))
            descend(0, 0, points_.size(), center, offer, reaches);
    }

    /// Calls `visit(index, distance2)` for each point within a closed ball.
    /// \param center  Centre of the ball.
    /// \param radius  The radius, not squared; it may be infinite. If the radius is
    ///                negative or NaN, or if the centre is NaN, the ball is empty.
    /// \param visit   Takes the index in the tree's order and the squared distance.
    /// \cost On average O(log n) for n points, and one step per point found.
    // [within]
    template <typename Visit>
    void visit_within(const Vec3T<T>& center, T radius, Visit&& visit) const {
        if (!(radius >= T(0))) return;
        const double limit2 = double(radius) * double(radius);
        const auto offer = [&](std::uint32_t index, double distance2) {
            if (distance2 <= limit2) visit(index, distance2);
        };
        walk(center, offer, [&](double distance2) { return distance2 <= limit2; });
    }
    // [within]

    /// Whether any point lies within a closed ball, given as for visit_within().
    [[nodiscard]] bool any_within(const Vec3T<T>& center, T radius) const {
        if (!(radius >= T(0))) return false;
        const double limit2 = double(radius) * double(radius);
        bool found = false;
        const auto offer = [&](std::uint32_t, double distance2) {
            found = found || distance2 <= limit2;
        };
        walk(center, offer,
             [&](double distance2) { return !found && distance2 <= limit2; });
        return found;
    }

    /// The nearest point within a closed ball, given as for visit_within().
    /// \return The nearest point; nothing if the ball has no point. Among equally near
    ///         points the choice is arbitrary, but always the same.
    [[nodiscard]] std::optional<Neighbor>
    nearest(const Vec3T<T>& center,
            T radius = std::numeric_limits<T>::infinity()) const {
        Neighbor one;
        if (nearest(center, radius, std::span(&one, 1)) == 0) return std::nullopt;
        return one;
    }

    /// The nearest points within a closed ball.
    /// \param center  Centre of the ball.
    /// \param radius  As for visit_within().
    /// \param found   One element for each point to be found. The elements are filled
    ///                as a heap, so that the first one is the farthest point.
    /// \param wanted  Called with an index in the tree's order. If it returns false,
    ///                the point is skipped.
    /// \return The number of points found. Among equally near points the choice is
    ///         arbitrary, but always the same.
    /// \cost On average O(log n) for n points, and some steps per point to be found;
    ///       more if `wanted` skips most of the points nearby.
    // [nearest]
    template <typename Wanted = detail::AnyPoint>
    [[nodiscard]] std::size_t nearest(const Vec3T<T>& center, T radius,
                                      std::span<Neighbor> found,
                                      Wanted wanted = {}) const {
        if (found.empty() || !(radius >= T(0))) return 0;
        Nearest best{.found = found, .limit2 = double(radius) * double(radius)};
        const auto offer = [&](std::uint32_t index, double distance2) {
            if (best.reaches(distance2) && wanted(index)) best.take({distance2, index});
        };
        walk(center, offer, [&](double distance2) { return best.reaches(distance2); });
        return best.count;
    }
    // [nearest]

private:
    static constexpr std::size_t leaf_size = 16; // a leaf is searched linearly

    // The box of a range of points.
    struct Box {
        Vec3T<T> low, high;
    };

    // [build]
    void build(std::span<const Vec3T<T>> points, std::size_t node, std::size_t first,
               std::size_t last) {
        Box box{points[point_ids_[first]], points[point_ids_[first]]};
        for (std::size_t i = first; i < last; ++i) {
            box.low = glm::min(box.low, points[point_ids_[i]]);
            box.high = glm::max(box.high, points[point_ids_[i]]);
        }
        if (boxes_.size() <= node) boxes_.resize(node + 1);
        boxes_[node] = box;
        if (last - first <= leaf_size) return;

        // The median moves to the middle. Equal coordinates are ordered by index.
        const int axis = detail::longest_axis(box.low, box.high);
        const auto less = [&](std::uint32_t a, std::uint32_t b) {
            const T x = points[a][axis], y = points[b][axis];
            return x < y || (x == y && a < b);
        };
        const std::size_t middle = first + (last - first) / 2;
        std::uint32_t* const ids = point_ids_.data();
        std::nth_element(ids + first, ids + middle, ids + last, less);
        build(points, 2 * node + 1, first, middle);
        build(points, 2 * node + 2, middle, last);
    }
    // [build]

    double distance2_to(std::size_t node, const Vec3T<T>& center) const noexcept {
        return detail::box_distance2(boxes_[node].low, boxes_[node].high, center);
    }

    // [walk]
    template <typename Offer, typename Reaches>
    void descend(std::size_t node, std::size_t first, std::size_t last,
                 const Vec3T<T>& center, Offer& offer, Reaches& reaches) const {
        if (last - first <= leaf_size) {
            for (std::size_t i = first; i < last; ++i)
                offer(static_cast<std::uint32_t>(i), distance2(points_[i], center));
            return;
        }
        const std::size_t middle = first + (last - first) / 2;
        const std::size_t low = 2 * node + 1, high = 2 * node + 2;
        const double to_low = distance2_to(low, center);
        const double to_high = distance2_to(high, center);

        // Points found in the nearer half may make the other half unnecessary.
        const bool low_first = to_low <= to_high;
        if (low_first && reaches(to_low))
            descend(low, first, middle, center, offer, reaches);
        if (reaches(to_high)) descend(high, middle, last, center, offer, reaches);
        if (!low_first && reaches(to_low))
            descend(low, first, middle, center, offer, reaches);
    }
    // [walk]

    std::vector<Vec3T<T>> points_;
    std::vector<std::uint32_t> point_ids_;
    std::vector<Box> boxes_; // of range i; its halves are 2i + 1 and 2i + 2
};
using KdTree = KdTreeT<float>; ///< KdTreeT in float.

/// \}

} // namespace ljus
