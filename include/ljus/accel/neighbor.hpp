#pragma once

/// \file ljus/accel/neighbor.hpp
/// \brief What a search among points finds, and how far away it is.

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \addtogroup kd_tree
/// \{

/// A point that a search has found. The nearer one is less.
struct Neighbor {
    double distance2 = 0;    ///< Squared, in double.
    std::uint32_t index = 0; ///< Its place in the tree's order.

    /// By distance, then by place.
    friend auto operator<=>(const Neighbor&, const Neighbor&) = default;
};

namespace detail {

/// \f$ x^2 + y^2 + z^2 \f$, the same wherever it is asked for. Where the machine can
/// fuse a product with a sum, a compiler does so in one place and not in another, and a
/// point on the border of a ball would lie in it or not according to who asks: there
/// the sums are fused by name.
// [sum of squares]
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
// [sum of squares]

} // namespace detail

/// What decides whether a point lies within a ball: the squared distance in double,
/// wherever it is asked for. Of floats no term under- or overflows.
/// \param a  A point.
/// \param b  Another one.
/// \return |a - b|^2, within three roundings.
template <std::floating_point T>
[[nodiscard]] double distance2(const Vec3T<T>& a, const Vec3T<T>& b) noexcept {
    return detail::sum_of_squares(double(a.x) - double(b.x), double(a.y) - double(b.y),
                                  double(a.z) - double(b.z));
}

namespace detail {

/// The squared distance from a point to a box, rounded as the distances of points are:
/// no point of the box is nearer than that.
/// \param low    The box's corner with the smallest coordinates.
/// \param high   The opposite corner.
/// \param point  The point.
/// \return 0 within the box; NaN if the point has a NaN.
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

/// The axis along which a box is longest: where a range of points is split.
/// \param low   The box's corner with the smallest coordinates.
/// \param high  The opposite corner.
/// \return 0, 1 or 2; the first of several.
template <std::floating_point T>
[[nodiscard]] constexpr int longest_axis(const Vec3T<T>& low,
                                         const Vec3T<T>& high) noexcept {
    const Vec3T<T> size = high / T(2) - low / T(2); // halves: no overflow
    if (size.x >= size.y && size.x >= size.z) return 0;
    return size.y >= size.z ? 1 : 2;
}

} // namespace detail

/// The nearest points of a search so far: a heap in the caller's memory, the farthest
/// of them on top, at `found[0]`.
struct Nearest {
    std::span<Neighbor> found; ///< Room for as many as are wanted, at least one.
    double limit2 = 0;         ///< The search's radius, squared.
    std::size_t count = 0;     ///< How many there are.

    /// Whether a point at this distance belongs to them. Once the room is full it must
    /// be nearer than the farthest: a thousand equal points are not tried one by one.
    [[nodiscard]] bool reaches(double distance2) const noexcept {
        return count < found.size() ? distance2 <= limit2
                                    : distance2 < found[0].distance2;
    }

    /// Takes a point that belongs to them; the farthest one leaves if the room is full.
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

/// Every index: what a search passes that wants any point.
struct AnyPoint {
    /// True.
    constexpr bool operator()(std::uint32_t) const noexcept { return true; }
};

} // namespace detail

/// \}

} // namespace ljus
