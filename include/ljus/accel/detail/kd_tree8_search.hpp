#pragma once

/// \file ljus/accel/detail/kd_tree8_search.hpp
/// \brief The nearest points of the wide k-d tree.

#include <algorithm>
#include <optional>
#include <span>

#include "ljus/accel/detail/kd_tree8_traverse.hpp"
#include "ljus/accel/detail/lane_select.hpp"

namespace ljus::detail {

/// \addtogroup kd_tree8
/// \{

template <std::floating_point T>
[[nodiscard]] std::optional<Neighbor> nearest_point(const KdTree8PartsT<T>& tree,
                                                    const Vec3T<T>& center, T radius) {
    if (!(radius >= T(0)) || tree.blocks.empty()) return std::nullopt;
    auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
    std::optional<Neighbor> best;
    towards(tree, center, reach, [&](std::size_t first, std::size_t last) {
        // The smallest distance in T, but for its last bits; only what is as small may
        // be the nearest.
        LanesT<T> least = distances2(tree.blocks[first], center);
        for (std::size_t b = first + 1; b < last; ++b) {
            const LanesT<T> d2 = distances2(tree.blocks[b], center);
            for_lanes([&](int i) {
                least.lane[i] = d2.lane[i] < least.lane[i] ? d2.lane[i] : least.lane[i];
            });
        }
        const std::uint32_t smallest = smallest_lane(least, 255, reach.last);
        if (smallest == 8) return;
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
    });
    return best;
}

// The most that are selected by counting; more go through a heap.
inline constexpr std::size_t max_counted = 512;

// The points that a search for the k nearest has gathered so far.
template <std::floating_point T>
struct CandidatesT {
    static constexpr std::size_t room = 2 * max_counted;

    alignas(32) T d2[room + 8];    // squared distances in T
    std::uint32_t index[room + 8]; // places in the tree's order

    CandidatesT() noexcept {} // nothing is set: all are written before they are read

    // Fills the last eight up, as select_smallest() asks for it.
    void fill_up(std::size_t count) noexcept {
        for (std::size_t i = count; i % 8 != 0; ++i)
            d2[i] = std::numeric_limits<T>::infinity();
    }
};

// Lets those go that are surely not among the k nearest, and shortens the reach to the
// others: k of them, and up to `spare` more.
// Returns how many are left: more than that if many are equally far, as far as T tells.
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

// Keeps exactly the k nearest, and shortens the reach to less than the k-th: those that
// T puts near the k-th are put into their order in double.
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

// Gathers candidates and now and then, when there are more than enough, finds by
// counting how far the k-th of them lies: the reach from then on.
template <std::floating_point T, typename Wanted>
[[nodiscard]] std::size_t count_nearest(const KdTree8PartsT<T>& tree,
                                        const Vec3T<T>& center, ReachT<T> reach,
                                        std::span<Neighbor> found, Wanted& wanted) {
    CandidatesT<T> all;
    const std::size_t k = found.size();
    const std::size_t spare = k / 8; // on the way a few too many will do
    std::size_t count = 0;
    const auto shrink = [&] {
        keep_nearest(all, count, k, tree, center, reach);
        count = k;
    };

    std::size_t enough = k;
    towards(tree, center, reach, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> far = distances2(tree.blocks[b], center);
            const std::uint32_t some = reach.within(tree.blocks[b], center, far);
            if (some == 0) continue;
            for (std::uint32_t i = 0; i < lane_count; ++i) {
                const auto at = static_cast<std::uint32_t>(8 * b + i);
                all.d2[count] = far.lane[i];
                all.index[count] = at;
                if constexpr (std::is_same_v<Wanted, AnyPoint>)
                    count += some >> i & 1u;
                else
                    count += (some >> i & 1u) != 0 && wanted(at) ? 1 : 0;
            }
        }
        if (count >= enough) {
            count = thin_out(all, count, k, spare, reach);
            if (count > k + 2 * spare) shrink(); // many are equally far
            enough = count + std::max<std::size_t>(k / 2, 32);
        }
    });
    if (count > k) shrink();

    std::size_t farthest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        found[i] = {distance2(tree.point(all.index[i]), center), all.index[i]};
        if (found[i].distance2 > found[farthest].distance2) farthest = i;
    }
    if (count > 0) std::swap(found[0], found[farthest]);
    return count;
}

// Takes the k nearest by a heap: any number of them.
template <std::floating_point T, typename Wanted>
[[nodiscard]] std::size_t heap_nearest(const KdTree8PartsT<T>& tree,
                                       const Vec3T<T>& center, ReachT<T> reach,
                                       std::span<Neighbor> found, Wanted& wanted) {
    Nearest best{.found = found, .limit2 = reach.limit2};
    towards(tree, center, reach, [&](std::size_t first, std::size_t last) {
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
        if (best.count == found.size())
            reach = ReachT<T>::up_to(found[0].distance2, true);
    });
    return best.count;
}

// The k nearest, by one of the two; `Most` is the most that the caller may want.
template <std::size_t Most, std::floating_point T, typename Wanted>
[[nodiscard]] std::size_t nearest_points(const KdTree8PartsT<T>& tree,
                                         const Vec3T<T>& center, T radius,
                                         std::span<Neighbor> found, Wanted wanted) {
    if (found.empty() || !(radius >= T(0)) || tree.blocks.empty()) return 0;
    if constexpr (std::is_same_v<Wanted, AnyPoint>)
        if (found.size() == 1) {
            const auto one = nearest_point(tree, center, radius);
            if (one) found[0] = *one;
            return one ? 1 : 0;
        }
    const auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
    if constexpr (Most > max_counted)
        if (found.size() > max_counted)
            return heap_nearest(tree, center, reach, found, wanted);
    return count_nearest(tree, center, reach, found, wanted);
}
/// \}

} // namespace ljus::detail
