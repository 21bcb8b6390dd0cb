#pragma once

/// \file ljus/photons/neighbor.hpp
/// \brief What a search among points finds, and how far away it is.

#include <algorithm>
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

/// What decides whether a point lies within a ball: the squared distance in double,
/// wherever it is asked for. Of floats no term under- or overflows.
/// \param a  A point.
/// \param b  Another one.
/// \return |a - b|^2, within three roundings.
template <std::floating_point T>
[[nodiscard]] constexpr double distance2(const Vec3T<T>& a,
                                         const Vec3T<T>& b) noexcept {
    const double x = double(a.x) - double(b.x);
    const double y = double(a.y) - double(b.y);
    const double z = double(a.z) - double(b.z);
    return x * x + y * y + z * z;
}

/// The squared distance from a point to a box, rounded as the distances of points are:
/// no point of the box is nearer than that.
/// \param low    The box's corner with the smallest coordinates.
/// \param high   The opposite corner.
/// \param point  The point.
/// \return 0 within the box; NaN if the point has a NaN.
template <std::floating_point T>
[[nodiscard]] constexpr double box_distance2(const Vec3T<T>& low, const Vec3T<T>& high,
                                             const Vec3T<T>& point) noexcept {
    double square[3] = {};
    for (int axis = 0; axis < 3; ++axis) {
        const double below = double(low[axis]) - double(point[axis]);
        const double above = double(point[axis]) - double(high[axis]);
        const double outside = below > above ? below : above;
        square[axis] = outside <= 0 ? 0 : outside * outside;
    }
    return square[0] + square[1] + square[2];
}

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

/// Every index: what a search passes that wants any point.
struct AnyPoint {
    /// True.
    constexpr bool operator()(std::uint32_t) const noexcept { return true; }
};

/// \}

} // namespace ljus
