#pragma once

/// \file ljus/accel/detail/kd_tree8_results.hpp
/// \brief The result sets of the searches of the wide k-d tree.

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "ljus/accel/detail/kd_tree8_walk.hpp"
#include "ljus/accel/detail/lane_select.hpp"

namespace ljus::detail {

/// A result set for walk(). It visits all points within reach, leaf by leaf.
/// \tparam Visit  Called as visit(first, found) for a leaf; `first` is the index of its
///                first block. Bit i of `found` is set if the leaf's point i is within
///                reach. If the function returns true, the search ends.
template <std::floating_point T, typename Visit>
struct WithinT {
    static constexpr bool nearest_first = false;
    ReachT<T> reach; ///< The limit of the search.
    Visit visit;     ///< Called for each leaf that has points within reach.

    bool leaf(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, std::size_t first,
              std::size_t last) {
        const std::uint32_t found = in_leaf(tree, first, last, center, reach);
        return found != 0 && visit(first, found);
    }
};

template <std::floating_point T>
struct NearestOneT {
    static constexpr bool nearest_first = true;
    /// The limit of the search: the distance of the nearest point so far, exclusive.
    ReachT<T> reach;
    std::optional<Neighbor> best{}; ///< The nearest point so far.

    bool leaf(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, std::size_t first,
              std::size_t last) {
        // The smallest distance in T, without its last bits. Only points within this
        // distance can be the nearest.
        LanesT<T> least = distances2(tree.blocks[first], center);
        for (std::size_t b = first + 1; b < last; ++b) {
            const LanesT<T> d2 = distances2(tree.blocks[b], center);
            for_lanes([&](int i) {
                least.lane[i] = d2.lane[i] < least.lane[i] ? d2.lane[i] : least.lane[i];
            });
        }
        const std::uint32_t smallest = smallest_lane(least, 255, reach.last);
        if (smallest == 8) return false;
        const T bound = std::min(
            ReachT<T>::up_to(double(least.lane[smallest]), false).last, reach.last);
        constexpr double infinity = std::numeric_limits<double>::infinity();
        const ReachT<T> close{.limit2 = infinity, .sure = bound, .last = bound};
        for (std::uint32_t some = in_leaf(tree, first, last, center, close); some != 0;
             some &= some - 1) {
            const std::size_t i =
                8 * first + static_cast<std::size_t>(std::countr_zero(some));
            const double exact = distance2(tree.point(i), center);
            if (!reach.holds(exact)) continue;
            best = Neighbor{exact, static_cast<std::uint32_t>(i)};
            reach = ReachT<T>::up_to(exact, true);
        }
        return false;
    }
};

// For up to this number of points NearestCountedT is used, for more NearestHeapT.
inline constexpr std::size_t max_counted = 512;

// The candidates of a search for the k nearest.
template <std::floating_point T>
struct CandidatesT {
    static constexpr std::size_t room = 2 * max_counted;

    alignas(32) T d2[room + 8];    // squared distances in T
    std::uint32_t index[room + 8]; // in the tree's order

    CandidatesT() noexcept {} // uninitialised: all are written before they are read

    // Pads the last block of eight, as select_smallest() requires.
    void fill_up(std::size_t count) noexcept {
        for (std::size_t i = count; i % 8 != 0; ++i)
            d2[i] = std::numeric_limits<T>::infinity();
    }
};

// Drops candidates that are certainly not among the k nearest, and shortens the reach
// to the others. Returns the number of candidates left. It is between k and k +
// `spare`, or larger if many distances are equal in T.
template <std::floating_point T>
[[nodiscard]] std::size_t thin_out(CandidatesT<T>& all, std::size_t count,
                                   std::size_t k, std::size_t spare,
                                   ReachT<T>& reach) noexcept {
    all.fill_up(count);
    const T least = select_smallest(all.d2, count, k, spare);
    const T bound = ReachT<T>::up_to(double(least), false).last;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const T x = all.d2[i];
        all.d2[kept] = x;
        all.index[kept] = all.index[i];
        kept += x <= bound;
    }
    if (double(bound) < reach.limit2) reach = ReachT<T>::up_to(double(bound), false);
    return kept;
}

// Keeps exactly the k nearest candidates, and shortens the reach to below the k-th
// distance. Candidates whose distances in T are too close to the k-th are compared in
// double.
template <std::floating_point T>
void keep_nearest(CandidatesT<T>& all, std::size_t count, std::size_t k,
                  const KdTree8PartsT<T>& tree, const Vec3T<T>& center,
                  ReachT<T>& reach) {
    all.fill_up(count);
    const auto kth = ReachT<T>::up_to(double(select_smallest(all.d2, count, k)), false);
    std::uint32_t band[CandidatesT<T>::room];
    std::size_t sure = 0, ties = 0;
    for (std::size_t i = 0; i < count; ++i) {
        const T x = all.d2[i];
        const std::uint32_t at = all.index[i];
        all.d2[sure] = x;
        all.index[sure] = at;
        band[ties] = at;
        sure += x <= kth.sure;
        ties += x > kth.sure && x <= kth.last;
    }
    const auto exact = [&](std::uint32_t i) {
        return Neighbor{distance2(tree.point(i), center), i};
    };
    const std::uint32_t last = static_cast<std::uint32_t>(k - sure - 1);
    std::nth_element(band, band + last, band + ties,
                     [&](auto a, auto b) { return exact(a) < exact(b); });
    const double limit2 = exact(band[last]).distance2;
    for (std::size_t i = 0; sure < k; ++i, ++sure) {
        all.d2[sure] = distances2(tree.blocks[band[i] / 8], center).lane[band[i] % 8];
        all.index[sure] = band[i];
    }
    reach = ReachT<T>::up_to(limit2, true);
}

/// A result set for walk(). It collects candidates for the k nearest points, for k up
/// to max_counted. When there are `enough` of them, select_smallest() finds the k-th
/// smallest distance, which becomes the reach.
template <std::floating_point T, typename Wanted>
struct NearestCountedT {
    static constexpr bool nearest_first = true;
    ReachT<T> reach;        ///< The limit: about the k-th smallest distance so far.
    Wanted& wanted;         ///< Whether a point counts.
    const std::size_t k;    ///< Number of points to be found.
    std::size_t enough = k; ///< Number of candidates at which the reach is shortened.
    std::size_t count = 0;  ///< Number of candidates.
    CandidatesT<T> all;     ///< The candidates.

    // Without this constructor, 8 kB would be filled with zeros.
    NearestCountedT(const ReachT<T>& most, Wanted& which, std::size_t number) noexcept
        : reach(most), wanted(which), k(number) {}

    bool leaf(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, std::size_t first,
              std::size_t last) {
        std::size_t next = count; // a local stays in a register
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> far = distances2(tree.blocks[b], center);
            const std::uint32_t some = reach.within(tree.blocks[b], center, far);
            if (some == 0) continue;
            for (std::uint32_t i = 0; i < lane_count; ++i) {
                const auto at = static_cast<std::uint32_t>(8 * b + i);
                all.d2[next] = far.lane[i];
                all.index[next] = at;
                if constexpr (std::is_same_v<Wanted, AnyPoint>)
                    next += some >> i & 1u;
                else
                    next += (some >> i & 1u) != 0 && wanted(at) ? 1 : 0;
            }
        }
        count = next;
        if (count >= enough) {
            const std::size_t spare = k / 8; // exactness is not needed on the way
            count = thin_out(all, count, k, spare, reach);
            if (count > k + 2 * spare) shrink(tree, center); // many are equally far
            enough = count + std::max<std::size_t>(k / 2, 32);
        }
        return false;
    }
    /// Reduces the candidates to the k nearest.
    void shrink(const KdTree8PartsT<T>& tree, const Vec3T<T>& center) {
        keep_nearest(all, count, k, tree, center, reach);
        count = k;
    }
    /// Writes the points into `found`, the farthest first and the others unsorted.
    /// \return The number of points.
    [[nodiscard]] std::size_t give(const KdTree8PartsT<T>& tree, const Vec3T<T>& center,
                                   std::span<Neighbor> found) {
        if (count > k) shrink(tree, center);
        std::size_t farthest = 0;
        for (std::size_t i = 0; i < count; ++i) {
            found[i] = {distance2(tree.point(all.index[i]), center), all.index[i]};
            if (found[i].distance2 > found[farthest].distance2) farthest = i;
        }
        if (count > 0) std::swap(found[0], found[farthest]);
        return count;
    }
};

/// A result set for walk(). It finds the k nearest points, for any k, by the heap of
/// KdTreeT.
template <std::floating_point T, typename Wanted>
struct NearestHeapT {
    static constexpr bool nearest_first = true;
    ReachT<T> reach; ///< The limit: the k-th smallest distance so far, exclusive.
    Wanted& wanted;  ///< Whether a point counts.
    Nearest best;    ///< The nearest points so far.

    bool leaf(const KdTree8PartsT<T>& tree, const Vec3T<T>& center, std::size_t first,
              std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            std::uint32_t some = reach.within(tree.blocks[b], center,
                                              distances2(tree.blocks[b], center));
            for (; some != 0; some &= some - 1) {
                const auto i = std::size_t(std::countr_zero(some));
                const auto index = static_cast<std::uint32_t>(8 * b + i);
                const double d2 = distance2(tree.blocks[b][i], center);
                if (best.reaches(d2) && wanted(index)) best.take({d2, index});
            }
        }
        if (best.count == best.found.size())
            reach = ReachT<T>::up_to(best.found[0].distance2, true);
        return false;
    }
};

} // namespace ljus::detail
