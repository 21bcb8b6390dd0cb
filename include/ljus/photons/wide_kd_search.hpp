#pragma once

/// \file ljus/photons/wide_kd_search.hpp
/// \brief How the wide k-d tree is searched.

#include <algorithm>

#include "ljus/photons/wide_kd_tree.hpp"

namespace ljus {

/// \addtogroup wide_kd_tree
/// \{

// Ranges of blocks that together hold all points of a ball; until one visit says true.
template <std::floating_point T>
template <typename Visit>
bool WideKdTreeT<T>::in_ball(const Vec3T<T>& center, T radius, const ReachT<T>& reach,
                             Visit visit) const {
    if (!(radius >= T(0))) return false;
    if (shape_.levels == 0) return visit(std::size_t(0), blocks_.size());
    struct Entry {
        int level;
        std::uint32_t number;
    };
    Entry stack[8 * 12];
    int size = 0;
    stack[size++] = {0, 0};
    std::uint32_t children = (1u << shape_.root_children()) - 1;
    while (size > 0) {
        const auto [level, number] = stack[--size];
        const WideNodeT<T>& node = nodes_[shape_.first[std::size_t(level)] + number];
        std::uint32_t some =
            lanes_up_to(detail::near2(node, center), reach.last) & children;
        children = 255;
        const int below = shape_.levels - 1 - level; // levels between these and leaves
        const int depth = shape_.halvings - 3 * below;
        std::uint32_t whole =
            255; // of what lies in the ball as a whole, no more is asked
        if (below > 0 && some != 0)
            whole = lanes_up_to(detail::far2(node, center), reach.sure);
        for (; some != 0; some &= some - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(some));
            const std::uint32_t child = 8 * number + i;
            if ((whole >> i & 1u) == 0)
                stack[size++] = {level + 1, child};
            else if (visit(shape_.first_block(depth, child),
                           shape_.first_block(depth, child + 1)))
                return true;
        }
    }
    return false;
}

// Ranges of blocks, the nearer ones first, as long as they are within reach; a visit
// may shorten the reach.
template <std::floating_point T>
template <bool in_order, typename Visit>
void WideKdTreeT<T>::towards(const Vec3T<T>& center, const ReachT<T>& reach,
                             Visit visit) const {
    if (shape_.levels == 0) return visit(std::size_t(0), blocks_.size());
    struct Entry {
        T distance2;
        int level;
        std::uint32_t number;
    };
    Entry stack[8 * 12];
    int size = 0;
    stack[size++] = {T(0), 0, 0};
    std::uint32_t children = (1u << shape_.root_children()) - 1;
    while (size > 0) {
        const Entry at = stack[--size];
        if (!(at.distance2 <= reach.last)) continue;
        if (at.distance2 > reach.sure && at.level > 0) { // T cannot tell
            const WideNodeT<T>& node =
                nodes_[shape_.first[std::size_t(at.level - 1)] + at.number / 8];
            if (!reach.holds(box_distance2(node.low[at.number % 8],
                                           node.high[at.number % 8], center)))
                continue;
        }
        if (at.level == shape_.levels) {
            visit(shape_.first_block(shape_.halvings, at.number),
                  shape_.first_block(shape_.halvings, at.number + 1));
            continue;
        }
        const LanesT<T> near = detail::near2(
            nodes_[shape_.first[std::size_t(at.level)] + at.number], center);
        const int base = size;
        for (std::uint32_t some = lanes_up_to(near, reach.last) & children; some != 0;
             some &= some - 1) {
            const auto i = static_cast<std::uint32_t>(std::countr_zero(some));
            const Entry entry{near.lane[i], at.level + 1, 8 * at.number + i};
            // In order, the nearest on top; or on top the nearest only, where what is
            // found there will put most others out of reach.
            int place = size++;
            if constexpr (in_order) {
                for (; place > base && stack[place - 1].distance2 < entry.distance2;
                     --place)
                    stack[place] = stack[place - 1];
            } else if (place > base && stack[place - 1].distance2 < entry.distance2) {
                stack[place] = stack[place - 1];
                --place;
            }
            stack[place] = entry;
        }
        children = 255;
    }
}

template <std::floating_point T>
std::optional<Neighbor> WideKdTreeT<T>::nearest(const Vec3T<T>& center,
                                                T radius) const {
    if (!(radius >= T(0)) || size() == 0) return std::nullopt;
    auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
    std::optional<Neighbor> best;
    towards<false>(center, reach, [&](std::size_t first, std::size_t last) {
        // The smallest distance in T; only what is as small may be the nearest.
        LanesT<T> least;
        for (T& x : least.lane) x = std::numeric_limits<T>::infinity();
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> d2 = distances2(blocks_[b], center);
            for_lanes([&](int i) {
                least.lane[i] = d2.lane[i] < least.lane[i] ? d2.lane[i] : least.lane[i];
            });
        }
        T smallest = least.lane[0];
        for (const T x : least.lane) smallest = x < smallest ? x : smallest;
        if (!(smallest <= reach.last)) return;
        auto close = ReachT<T>::up_to(double(smallest), false);
        close.last = std::min(close.last, reach.last);
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> d2 = distances2(blocks_[b], center);
            for (std::uint32_t some = lanes_up_to(d2, close.last); some != 0;
                 some &= some - 1) {
                const auto i = std::size_t(std::countr_zero(some));
                const double exact = distance2(blocks_[b][i], center);
                if (!reach.holds(exact)) continue;
                best = Neighbor{exact, static_cast<std::uint32_t>(8 * b + i)};
                reach = ReachT<T>::up_to(exact, true);
            }
        }
    });
    return best;
}

// [nearest]
template <std::floating_point T>
template <typename Wanted>
std::size_t WideKdTreeT<T>::nearest(const Vec3T<T>& center, T radius,
                                    std::span<Neighbor> found, Wanted wanted) const {
    if (found.empty() || !(radius >= T(0)) || size() == 0) return 0;
    auto reach = ReachT<T>::up_to(double(radius) * double(radius), false);
    if (found.size() <= most_counted)
        return count_nearest(center, reach, found, wanted);

    Nearest best{.found = found, .limit2 = reach.limit2};
    towards<true>(center, reach, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            std::uint32_t some =
                reach.within(blocks_[b], center, distances2(blocks_[b], center));
            for (; some != 0; some &= some - 1) {
                const auto i = std::size_t(std::countr_zero(some));
                const auto index = static_cast<std::uint32_t>(8 * b + i);
                const double d2 = distance2(blocks_[b][i], center);
                if (best.reaches(d2) && wanted(index)) best.take({d2, index});
            }
        }
        if (best.count == found.size())
            reach = ReachT<T>::up_to(found[0].distance2, true);
    });
    return best.count;
}

// Gathers candidates and now and then, when there are more than enough, finds by
// counting how far the k-th of them lies: the reach from then on.
template <std::floating_point T>
template <typename Wanted>
std::size_t WideKdTreeT<T>::count_nearest(const Vec3T<T>& center, ReachT<T> reach,
                                          std::span<Neighbor> found,
                                          Wanted& wanted) const {
    constexpr std::size_t room = 2 * most_counted;
    alignas(32) T d2[room + 8];
    std::uint32_t index[room + 8];
    std::uint32_t band[room];
    const std::size_t k = found.size();
    std::size_t count = 0;

    const auto shrink = [&] {
        for (std::size_t i = count; i % 8 != 0; ++i)
            d2[i] = std::numeric_limits<T>::infinity();
        // Those that T puts near the k-th are put into their order in double.
        const auto kth = ReachT<T>::up_to(double(select_smallest(d2, count, k)), false);
        std::size_t sure = 0, ties = 0;
        for (std::size_t i = 0; i < count; ++i) {
            const T x = d2[i];
            const std::uint32_t at = index[i];
            d2[sure] = x;
            index[sure] = at;
            band[ties] = at;
            sure += x <= kth.sure;
            ties += x > kth.sure && x <= kth.last;
        }
        const auto exact = [&](std::uint32_t i) {
            return Neighbor{distance2(point(i), center), i};
        };
        const std::uint32_t last = static_cast<std::uint32_t>(k - sure - 1);
        std::nth_element(band, band + last, band + ties,
                         [&](auto a, auto b) { return exact(a) < exact(b); });
        const double limit2 = exact(band[last]).distance2;
        for (std::size_t i = 0; sure < k; ++i, ++sure) {
            d2[sure] = distances2(blocks_[band[i] / 8], center).lane[band[i] % 8];
            index[sure] = band[i];
        }
        count = k;
        reach = ReachT<T>::up_to(limit2, true);
    };

    std::size_t enough = k;
    towards<true>(center, reach, [&](std::size_t first, std::size_t last) {
        for (std::size_t b = first; b < last; ++b) {
            const LanesT<T> far = distances2(blocks_[b], center);
            const std::uint32_t some = reach.within(blocks_[b], center, far);
            if (some == 0) continue;
            for (std::uint32_t i = 0; i < lane_count; ++i) {
                const auto at = static_cast<std::uint32_t>(8 * b + i);
                d2[count] = far.lane[i];
                index[count] = at;
                if constexpr (std::is_same_v<Wanted, AnyPoint>)
                    count += some >> i & 1u;
                else
                    count += (some >> i & 1u) != 0 && wanted(at) ? 1 : 0;
            }
        }
        if (count >= enough) {
            shrink();
            enough = k + std::max<std::size_t>(k / 2, 32);
        }
    });
    if (count > k) shrink();

    std::size_t farthest = 0;
    for (std::size_t i = 0; i < count; ++i) {
        found[i] = {distance2(point(index[i]), center), index[i]};
        if (found[i].distance2 > found[farthest].distance2) farthest = i;
    }
    if (count > 0) std::swap(found[0], found[farthest]);
    return count;
}
// [nearest]

/// \}

} // namespace ljus
