#pragma once

/// \file regions.hpp
/// \brief A partition of space among ranks.

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include <ljus/math/vector.hpp>

namespace examples {

/// A k-d tree whose leaves are the regions of ranks, with about as many points each.
class Regions {
public:
    /// \param points  A sample of what is to be shared; all ranks give the same one.
    /// \param ranks   How many regions, at least 1.
    /// \param radius  Of the estimates.
    Regions(std::vector<ljus::Vec3> points, int ranks, float radius)
        : last_(ranks), radius_(radius) {
        cuts_.reserve(static_cast<std::size_t>(ranks));
        divide(points, 0, ranks);
    }

    /// The rank that owns a point.
    [[nodiscard]] int owner(const ljus::Vec3& point) const {
        int found = 0;
        const auto note = [&](int rank) { found = rank; };
        visit(point, 0, 0, last_, 0, note);
        return found;
    }

    /// Calls use(rank) for each rank whose region lies within the radius of a point.
    template <typename Use>
    void visit(const ljus::Vec3& point, Use use) const {
        visit(point, radius_, 0, last_, 0, use);
    }

private:
    // A plane between the regions below and above, in depth-first order: the cuts of the
    // regions below come next, one fewer than these regions, and then those above.
    struct Cut {
        int axis = 0;
        float at = 0;
    };

    void divide(std::span<ljus::Vec3> points, int first, int last) {
        if (last - first == 1) return;
        const int middle = first + (last - first) / 2;
        const std::size_t below =
            points.size() * std::size_t(middle - first) / std::size_t(last - first);
        const auto nth = points.begin() + std::ptrdiff_t(below);
        // The axis with the fewest points near the cut. The median along another one may
        // lie in a wall, and all photons of the wall would have copies.
        Cut best;
        std::size_t fewest = points.size() + 1;
        for (const int axis : {0, 1, 2}) {
            const auto along = [axis](const ljus::Vec3& point) { return point[axis]; };
            std::ranges::nth_element(points, nth, {}, along);
            const float at = points.empty() ? 0 : along(*nth);
            const auto near =
                std::size_t(std::ranges::count_if(points, [&](const ljus::Vec3& point) {
                    return std::abs(along(point) - at) <= radius_;
                }));
            if (near < fewest) best = {axis, at}, fewest = near;
        }
        std::ranges::nth_element(
            points, nth, {}, [&](const ljus::Vec3& point) { return point[best.axis]; });
        cuts_.push_back(best);
        divide(points.first(below), first, middle);
        divide(points.subspan(below), middle, last);
    }

    template <typename Use>
    void visit(const ljus::Vec3& point, float radius, int first, int last,
               std::size_t number, const Use& use) const {
        if (last - first == 1) return use(first);
        const int middle = first + (last - first) / 2;
        const float distance = point[cuts_[number].axis] - cuts_[number].at;
        if (distance < radius) visit(point, radius, first, middle, number + 1, use);
        if (distance >= -radius)
            visit(point, radius, middle, last, number + std::size_t(middle - first),
                  use);
    }

    int last_;
    float radius_;
    std::vector<Cut> cuts_;
};

} // namespace examples
