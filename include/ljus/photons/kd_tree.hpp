#pragma once

/// \file ljus/photons/kd_tree.hpp
/// \brief The plain k-d tree: points near a point.

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup kd_tree The k-d tree
/// \brief Section 3.2.2: "whenever a photon hits a surface, it is stored in a k-d
/// tree".
/// \{

/// A point that a search has found.
template <std::floating_point T>
struct NeighborT {
    double distance2 = 0;    ///< Squared, in double.
    std::uint32_t index = 0; ///< Its place in the tree's order.
};

/// A balanced k-d tree \cite bentley1975 without a single pointer: the middle of each
/// range of the array is its root, the halves on either side are its subtrees.
///
/// The tree keeps the positions; what belongs to them is the caller's, put into the
/// tree's order with order(). Searches are const, take no memory, and may run on any
/// number of threads.
template <std::floating_point T>
class KdTreeT {
public:
    /// An empty tree: every search finds nothing.
    KdTreeT() = default;

    /// Builds the tree.
    /// \param points  Any points, equal ones too.
    /// \throws std::invalid_argument  if a point is not finite.
    /// \cost O(n log n); 17 bytes a point in float.
    explicit KdTreeT(std::span<const Vec3T<T>> points);

    /// Where the points came from: order()[i] is the number of the i-th point of the
    /// tree in the span it was built from.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const noexcept {
        return order_;
    }

    /// The points, in the tree's order.
    [[nodiscard]] const std::vector<Vec3T<T>>& points() const noexcept {
        return points_;
    }

    /// How many points there are.
    [[nodiscard]] std::size_t size() const noexcept { return points_.size(); }

    /// Calls `visit(index, distance2)` for each point within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  At least 0, infinity for all; not squared.
    /// \param visit   Takes the place in the tree's order and the squared distance.
    template <typename Visit>
    void visit_within(const Vec3T<T>& center, T radius, Visit&& visit) const {
        const double r = double(radius);
        descend(0, points_.size(), center, [&](std::uint32_t index, double distance2) {
            if (distance2 <= r * r) visit(index, distance2);
            return r;
        });
    }

    /// The nearest points within a closed ball.
    /// \param center  Of the ball.
    /// \param radius  At least 0, infinity for all.
    /// \param found   Room for as many as are wanted; filled as a heap, farthest first.
    /// \param wanted  Called with a place in the tree's order; false passes it over.
    /// \return How many were found.
    template <typename Wanted>
    [[nodiscard]] std::size_t nearest(const Vec3T<T>& center, T radius,
                                      std::span<NeighborT<T>> found,
                                      Wanted wanted) const;

private:
    template <typename Offer>
    double descend(std::size_t first, std::size_t last, const Vec3T<T>& center,
                   Offer&& offer, double radius = 1e300) const;
    void build(std::span<const Vec3T<T>> points, std::size_t first, std::size_t last);

    std::vector<Vec3T<T>> points_;
    std::vector<std::uint32_t> order_;
    std::vector<std::uint8_t> axis_; // by which coordinate each root splits its range
};
using KdTree = KdTreeT<float>; ///< KdTreeT in float.

// [build]
template <std::floating_point T>
KdTreeT<T>::KdTreeT(std::span<const Vec3T<T>> points) : axis_(points.size()) {
    order_.reserve(points.size());
    for (const Vec3T<T>& point : points) {
        require_finite("a point of the k-d tree", point);
        order_.push_back(static_cast<std::uint32_t>(order_.size()));
    }
    build(points, 0, points.size());
    points_.reserve(points.size());
    for (const std::uint32_t index : order_) points_.push_back(points[index]);
}

template <std::floating_point T>
void KdTreeT<T>::build(std::span<const Vec3T<T>> points, std::size_t first,
                       std::size_t last) {
    if (first >= last) return;

    // Split along the longest side of the range's box.
    Vec3T<T> low = points[order_[first]];
    Vec3T<T> high = low;
    for (std::size_t i = first; i < last; ++i) {
        low = glm::min(low, points[order_[i]]);
        high = glm::max(high, points[order_[i]]);
    }
    const Vec3T<T> size = high / T(2) - low / T(2); // halves: no overflow
    const int axis = size.x >= size.y && size.x >= size.z ? 0
                     : size.y >= size.z                   ? 1
                                                          : 2;

    // The median goes to the middle; ties are split by the point's number.
    const std::size_t middle = first + (last - first) / 2;
    const auto begin = order_.begin();
    std::nth_element(begin + static_cast<std::ptrdiff_t>(first),
                     begin + static_cast<std::ptrdiff_t>(middle),
                     begin + static_cast<std::ptrdiff_t>(last),
                     [&](std::uint32_t a, std::uint32_t b) {
                         const T x = points[a][axis];
                         const T y = points[b][axis];
                         return x < y || (x == y && a < b);
                     });
    axis_[middle] = static_cast<std::uint8_t>(axis);
    build(points, first, middle);
    build(points, middle + 1, last);
}
// [build]

// [search]
template <std::floating_point T>
template <typename Offer>
double KdTreeT<T>::descend(std::size_t first, std::size_t last, const Vec3T<T>& center,
                           Offer&& offer, double radius) const {
    if (first >= last) return radius;
    const std::size_t middle = first + (last - first) / 2;
    const int axis = axis_[middle];
    const double from_plane = double(center[axis]) - double(points_[middle][axis]);

    // The side of the centre first; the offer answers with the radius that is left.
    const bool low_side = from_plane < 0;
    radius = low_side ? descend(first, middle, center, offer, radius)
                      : descend(middle + 1, last, center, offer, radius);
    const glm::dvec3 offset = glm::dvec3(points_[middle]) - glm::dvec3(center);
    radius = offer(static_cast<std::uint32_t>(middle), glm::dot(offset, offset));
    if (std::abs(from_plane) > radius) return radius;
    return low_side ? descend(middle + 1, last, center, offer, radius)
                    : descend(first, middle, center, offer, radius);
}
// [search]

template <std::floating_point T>
template <typename Wanted>
std::size_t KdTreeT<T>::nearest(const Vec3T<T>& center, T radius,
                                std::span<NeighborT<T>> found, Wanted wanted) const {
    const auto farther = [](const NeighborT<T>& a, const NeighborT<T>& b) {
        return a.distance2 < b.distance2 ||
               (a.distance2 == b.distance2 && a.index < b.index);
    };
    const auto heap = [&](std::size_t count) {
        return found.begin() + static_cast<std::ptrdiff_t>(count);
    };
    if (found.empty()) return 0;
    double limit = double(radius);
    std::size_t count = 0;
    descend(0, points_.size(), center, [&](std::uint32_t index, double distance2) {
        const NeighborT<T> candidate{distance2, index};
        if (count < found.size()) {
            if (distance2 > limit * limit || !wanted(index)) return limit;
            found[count++] = candidate;
            std::push_heap(found.begin(), heap(count), farther);
        } else if (farther(candidate, found[0]) && wanted(index)) {
            std::pop_heap(found.begin(), heap(count), farther);
            found[count - 1] = candidate;
            std::push_heap(found.begin(), heap(count), farther);
        }
        // A full heap's farthest point is the new limit.
        return count == found.size() ? std::sqrt(found[0].distance2) : limit;
    });
    return count;
}

/// \}

} // namespace ljus
