#pragma once

/// \file ljus/accel/detail/bvh_bins.hpp
/// \brief Where to cut a crowd of boxes in two: the surface area heuristic, in bins.

#include <cstdint>
#include <utility>
#include <vector>

#include "ljus/geometry/box.hpp"

namespace ljus::detail {

// A box as a builder likes it: the lower sides, and the upper ones with their signs
// changed, so that to grow is eight times the same, which compilers do at once.
template <std::floating_point T>
struct SidesT {
    T side[8];

    static constexpr SidesT none() noexcept {
        SidesT result{};
        for (T& x : result.side) x = std::numeric_limits<T>::infinity();
        return result;
    }
    void grow(const SidesT& other) noexcept {
        for (int i = 0; i < 8; ++i)
            side[i] = side[i] < other.side[i] ? side[i] : other.side[i];
    }
    [[nodiscard]] T size(int axis) const noexcept {
        return -side[axis + 4] - side[axis];
    }
    [[nodiscard]] BoxT<T> box() const noexcept {
        return {{side[0], side[1], side[2]}, {-side[4], -side[5], -side[6]}};
    }
    // In double: the square of a float's largest size has room.
    [[nodiscard]] double half_area() const noexcept {
        const double x{size(0)}, y{size(1)}, z{size(2)};
        return x * y + y * z + z * x;
    }
};

// A thing on its way into the tree.
template <std::floating_point T>
struct CandidateT {
    SidesT<T> sides;
    std::uint32_t number;
    // Half of twice the centre: the sum of two large numbers would be infinite.
    [[nodiscard]] T center(int axis) const noexcept {
        return T(0.5) * sides.side[axis] - T(0.5) * sides.side[axis + 4];
    }
    [[nodiscard]] SidesT<T> centers() const noexcept {
        SidesT<T> result{};
        for (int i = 0; i < 4; ++i) {
            const T middle = T(0.5) * sides.side[i] - T(0.5) * sides.side[i + 4];
            result.side[i] = middle;
            result.side[i + 4] = -middle;
        }
        return result;
    }
};

// A part of the things on their way into the tree, next to each other.
template <std::floating_point T>
struct CrowdT {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    int depth = 0;
    SidesT<T> sides = SidesT<T>::none();   // of the things
    SidesT<T> centers = SidesT<T>::none(); // of their centres

    [[nodiscard]] std::uint32_t size() const noexcept { return last - first; }
    void take(const CandidateT<T>& thing) noexcept {
        sides.grow(thing.sides);
        centers.grow(thing.centers());
    }
};

// How many tests a leaf takes, `at_a_time` of them side by side.
[[nodiscard]] constexpr double tests_of(std::uint32_t count,
                                        std::uint32_t at_a_time) noexcept {
    return (count + at_a_time - 1) / at_a_time;
}

// Where to cut: between two bins along an axis; and what that costs.
struct Cut {
    int axis = -1; // none
    int bin = 0;   // the first of the upper half
    double cost = std::numeric_limits<double>::infinity();
};

inline constexpr int bin_count = 16;

// From a centre to its bin.
template <std::floating_point T>
struct ToBinT {
    T low, factor;
    ToBinT(const CrowdT<T>& crowd, int axis) noexcept
        : low(crowd.centers.side[axis]),
          factor(T(bin_count) * (T(1) - std::numeric_limits<T>::epsilon() * 4) /
                 crowd.centers.size(axis)) {}
    // Written so that it is within the bins for any number.
    [[nodiscard]] int operator()(T center) const noexcept {
        const T place = (center - low) * factor;
        return place < T(bin_count) ? static_cast<int>(place) : bin_count - 1;
    }
};

// The cut that makes the expected cost of a ray least \cite macdonald1990: a ray
// that meets a box meets one within it with the ratio of their surfaces. Of all places
// 15 are tried along each axis, those between 16 bins \cite wald2007.
// [best_cut]
template <std::floating_point T>
[[nodiscard]] Cut best_cut(const std::vector<CandidateT<T>>& things,
                           const CrowdT<T>& crowd, std::uint32_t at_a_time) {
    struct Bin {
        SidesT<T> sides = SidesT<T>::none();
        std::uint32_t count = 0;
    };
    Cut best;
    for (int axis = 0; axis < 3; ++axis) {
        const T size = crowd.centers.size(axis);
        if (!(size > std::numeric_limits<T>::min() &&
              size < std::numeric_limits<T>::max()))
            continue; // all in one plane
        Bin all[bin_count];
        const ToBinT<T> bin_of(crowd, axis);
        for (std::uint32_t i = crowd.first; i < crowd.last; ++i) {
            Bin& bin = all[bin_of(things[i].center(axis))];
            bin.sides.grow(things[i].sides);
            ++bin.count;
        }
        // Once from above, for the costs of the upper halves; once from below.
        double above[bin_count] = {};
        Bin upper, lower;
        for (int i = bin_count - 1; i > 0; --i) {
            upper.sides.grow(all[i].sides);
            upper.count += all[i].count;
            above[i] = upper.count == 0
                           ? 0
                           : upper.sides.half_area() * tests_of(upper.count, at_a_time);
        }
        for (int i = 1; i < bin_count; ++i) {
            lower.sides.grow(all[i - 1].sides);
            lower.count += all[i - 1].count;
            if (lower.count == 0 || lower.count == crowd.size()) continue;
            const double cost =
                lower.sides.half_area() * tests_of(lower.count, at_a_time) + above[i];
            if (cost < best.cost) best = {axis, i, cost};
        }
    }
    return best;
}
// [best_cut]

// Sorts a crowd into its two halves; without a cut, by number.
template <std::floating_point T>
[[nodiscard]] std::pair<CrowdT<T>, CrowdT<T>>
divide(std::vector<CandidateT<T>>& things, const CrowdT<T>& crowd, const Cut& cut) {
    CrowdT<T> low{.first = crowd.first, .last = crowd.first, .depth = crowd.depth + 1};
    CrowdT<T> high{.first = crowd.last, .last = crowd.last, .depth = crowd.depth + 1};
    if (cut.axis < 0) {
        low.last = high.first = crowd.first + crowd.size() / 2;
        for (std::uint32_t i = crowd.first; i < crowd.last; ++i)
            (i < low.last ? low : high).take(things[i]);
        return {low, high};
    }
    const ToBinT<T> bin_of(crowd, cut.axis);
    while (low.last < high.first) {
        CandidateT<T>& thing = things[low.last];
        if (bin_of(thing.center(cut.axis)) < cut.bin) {
            low.take(thing);
            ++low.last;
        } else {
            high.take(thing);
            std::swap(thing, things[--high.first]);
        }
    }
    return {low, high};
}

} // namespace ljus::detail
