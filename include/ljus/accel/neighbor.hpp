#pragma once

/// \file ljus/accel/neighbor.hpp
/// \brief The points that a search finds, and their distances.

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "ljus/math/require.hpp"

namespace ljus {

/// \addtogroup kd_tree
/// \{

/// A point found by a search.
struct Neighbor {
    double distance2 = 0;    ///< The squared distance.
    std::uint32_t index = 0; ///< Index in the tree's order.

    /// Compares the distances, then the indices.
    friend auto operator<=>(const Neighbor&, const Neighbor&) = default;
};

namespace detail {

/// \f$ x^2 + y^2 + z^2 \f$, rounded in the same way everywhere. Otherwise a compiler
/// could fuse a product with a sum for one caller only, and two callers would disagree
/// on a point on the border of a ball.
[[nodiscard]] inline double sum_of_squares(double x, double y, double z) noexcept {
#ifdef FP_FAST_FMA
    return std::fma(z, z, std::fma(y, y, x * x));
#else
    const double x2 = x * x;
    const double y2 = y * y;
    const double z2 = z * z;
    return x2 + y2 + z2;
#endif
}

} // namespace detail

/// The squared distance of two points in double, with at most five rounding errors. It
/// decides whether a point lies within a ball. For floats no term underflows or
/// overflows.
template <std::floating_point T>
[[nodiscard]] double distance2(const Vec3T<T>& a, const Vec3T<T>& b) noexcept {
    return detail::sum_of_squares(double(a.x) - double(b.x), double(a.y) - double(b.y),
                                  double(a.z) - double(b.z));
}

namespace detail {

/// The squared distance from a point to a box. It is rounded so that no point of the
/// box is nearer. It is 0 inside the box, and NaN if the point has a NaN.
template <std::floating_point T>
[[nodiscard]] double box_distance2(const Vec3T<T>& low, const Vec3T<T>& high,
                                   const Vec3T<T>& point) noexcept {
    const auto outside = [&](int axis) {
        const double below = double(low[axis]) - double(point[axis]);
        const double above = double(point[axis]) - double(high[axis]);
        const double most = below > above ? below : above;
        return most <= 0 ? 0 : most;
    };
    return sum_of_squares(outside(0), outside(1), outside(2));
}

/// The longest axis of a box: 0, 1 or 2. If several are equally long, the first one
/// counts.
template <std::floating_point T>
[[nodiscard]] constexpr int longest_axis(const Vec3T<T>& low,
                                         const Vec3T<T>& high) noexcept {
    const Vec3T<T> size = high / T(2) - low / T(2); // halved to avoid overflow
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

} // namespace detail

/// The nearest points that a search has found so far. They form a heap in the caller's
/// memory, with the farthest point at `found[0]`.
struct Nearest {
    std::span<Neighbor> found; ///< One element per point to be found; at least one.
    double limit2 = 0;         ///< The squared radius of the search.
    std::size_t count = 0;     ///< Number of points so far.

    /// Whether a point at this squared distance is within the radius or, once `found`
    /// is full, nearer than the farthest one.
    [[nodiscard]] bool reaches(double distance2) const noexcept {
        return count < found.size() ? distance2 <= limit2
                                    : distance2 < found[0].distance2;
    }

    /// Takes a point. If `found` is full, the point replaces the farthest one.
    void take(const Neighbor& neighbor) {
        const auto last = [&] {
            return found.begin() + static_cast<std::ptrdiff_t>(count);
        };
        if (count == found.size())
            std::pop_heap(found.begin(), last());
        else
            ++count;
        found[count - 1] = neighbor;
        std::push_heap(found.begin(), last());
    }
};

namespace detail {

/// Refuses more points than a tree can have.
inline void require_point_count(std::size_t count) {
    require(count <= std::numeric_limits<std::uint32_t>::max(),
            "the number of points in a k-d tree", static_cast<long long>(count),
            "below 2^32");
}

/// The default filter of a search: accepts every point.
struct AnyPoint {
    constexpr bool operator()(std::uint32_t) const noexcept { return true; }
};

} // namespace detail

/// \}

} // namespace ljus
