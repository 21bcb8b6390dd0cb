#pragma once

/// \file ljus/accel/detail/bvh8_traverse.hpp
/// \brief The ways of a ray through the fast tree.

#include <array>
#include <bit>

#include "ljus/accel/detail/bvh8_nodes.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus::detail {

/// \defgroup wide_walk Ways through a wide tree
/// \brief Eight boxes at once, and what to do about those that a ray enters
/// \cite wald2008. Chapter: \ref ch_bvh.
/// \{

// How a search begins: with a ray made ready, or, where there is none, with its answer.
struct Bvh8Start {
    Bvh8Ray ray{};
    bool done = true;   // nothing is left to be walked
    bool found = false; // what the leaf said, if it was asked about everything
};

// Makes a ray ready. For a finite ray with which that is not possible, the leaf is
// asked about all slots at once.
template <typename Leaf>
inline Bvh8Start begin_walk(const Bvh8Nodes& wide, const Ray& ray, Leaf& leaf) {
    Bvh8Start start;
    if (wide.nodes.empty() || !(ray.t_min <= ray.t_max)) return start;
    start.done = !make_ready(start.ray, ray, wide.middle, wide.half);
    if (start.done && is_finite(ray.origin) && is_finite(ray.direction))
        start.found = leaf(0u, static_cast<std::uint32_t>(wide.primitive_ids.size()),
                           static_cast<const Bvh8Ray*>(nullptr));
    return start;
}

// Asks eight boxes at once: which ones the ray enters, and where. Each search has an
// instance of its own, and `inline` asks for it: compilers inline what is called once.
template <typename Search>
inline std::uint64_t enter(Lanes& t, const Bvh8Nodes& wide, std::uint32_t node,
                           const Bvh8Ray& r, float t_min, float t_max) noexcept {
    const Lanes* const lanes = wide.nodes[0].plane.data();
    const Lanes& near_x = (lanes + r.near[0])[node];
    const Lanes& near_y = (lanes + r.near[1])[node];
    const Lanes& near_z = (lanes + r.near[2])[node];
    const Lanes& far_x = (lanes + r.far[0])[node];
    const Lanes& far_y = (lanes + r.far[1])[node];
    const Lanes& far_z = (lanes + r.far[2])[node];
    const auto larger = [](float a, float b) { return a > b ? a : b; };
    const auto smaller = [](float a, float b) { return a < b ? a : b; };
    Lanes entry;
    LaneMask entered;
    for (int i = 0; i < lane_count; ++i) {
        const float x = near_x.lane[i] * r.inverse.x - r.near_shift.x;
        const float y = near_y.lane[i] * r.inverse.y - r.near_shift.y;
        const float z = near_z.lane[i] * r.inverse.z - r.near_shift.z;
        const float first = larger(larger(x, y), larger(z, t_min));
        const float a = far_x.lane[i] * r.inverse.x - r.far_shift.x;
        const float b = far_y.lane[i] * r.inverse.y - r.far_shift.y;
        const float c = far_z.lane[i] * r.inverse.z - r.far_shift.z;
        const float last = smaller(smaller(a, b), smaller(c, t_max));
        entry.lane[i] = first;
        entered.lane[i] = first <= last ? -1 : 0;
    }
    t = entry;
    return yes_lanes(entered);
}
/// The way of a search for the nearest.
/// \param wide   The tree.
/// \param ray    The ray; a search may shorten it.
/// \param leaf   Called as leaf(first slot, count, ready ray). For a ray that cannot
///               be made ready, once, with a null pointer.
/// \param watch  Called with the number of each node on the way.
template <typename Leaf, typename Watch>
void walk_nearest(const Bvh8Nodes& wide, const Ray& ray, Leaf&& leaf, Watch&& watch) {
    const Bvh8Start start = begin_walk(wide, ray, leaf);
    if (start.done) return;
    // What waits: a child, and above it the t at which the ray enters it. For numbers
    // from 0 on, the bits are in the order of the values: so the nearer one is less.
    constexpr std::size_t max_waiting = bvh_depth * (lane_count - 1) + 1;
    std::array<std::uint64_t, max_waiting> later;
    std::size_t waiting = 0;
    const auto wait = [&](std::uint64_t key) {
        const auto child = static_cast<std::uint32_t>(key);
        if ((child & Bvh8Child::leaf) == 0)
            prefetch<4>(wide.nodes[child / Bvh8Child::stride].plane.data());
        later[waiting++] = key;
    };
    for (std::uint32_t at = 0;;) {
        if ((at & Bvh8Child::leaf) != 0) {
            leaf(at & Bvh8Child::first, Bvh8Child::count(at), &start.ray);
        } else {
            watch(at / Bvh8Child::stride);
            Lanes t;
            std::uint64_t entered =
                enter<Leaf>(t, wide, at, start.ray, ray.t_min, ray.t_max);
            if (entered != 0) {
                const auto& child = wide.nodes[at / Bvh8Child::stride].child;
                const auto key = [&](std::size_t i) {
                    const auto t_bits = std::bit_cast<std::uint32_t>(t.lane[i]);
                    return std::uint64_t{t_bits} << 32 | child[i];
                };
                std::uint64_t nearest = key(take_lane(entered));
                // Of three the order is right, of more it nearly is: without a branch
                // that a processor would have to predict.
                if (entered != 0) {
                    const std::uint64_t other = key(take_lane(entered));
                    std::uint64_t second = glm::max(nearest, other);
                    nearest = glm::min(nearest, other);
                    while (entered != 0) {
                        const std::uint64_t next = key(take_lane(entered));
                        const std::uint64_t farther = glm::max(nearest, next);
                        nearest = glm::min(nearest, next);
                        wait(glm::max(second, farther));
                        second = glm::min(second, farther);
                    }
                    wait(second);
                }
                at = static_cast<std::uint32_t>(nearest);
                continue;
            }
        }
        // What was found since may lie in front of what waits.
        float entry = 0;
        do {
            if (waiting == 0) return;
            --waiting;
            entry =
                std::bit_cast<float>(static_cast<std::uint32_t>(later[waiting] >> 32));
        } while (entry > ray.t_max);
        at = static_cast<std::uint32_t>(later[waiting]);
    }
}
/// The way of a search for any: in no order, so that of a node only the lanes wait.
/// \param wide   The tree.
/// \param ray    The ray.
/// \param leaf   As for walk_nearest(); true ends the search.
/// \param watch  Called with the number of each node on the way.
/// \return Whether a leaf said true.
template <typename Leaf, typename Watch>
[[nodiscard]] bool walk_any(const Bvh8Nodes& wide, const Ray& ray, Leaf&& leaf,
                            Watch&& watch) {
    const Bvh8Start start = begin_walk(wide, ray, leaf);
    if (start.done) return start.found;
    struct Later {
        std::uint64_t lanes;
        std::uint32_t node;
    };
    std::array<Later, bvh_depth> later;
    std::size_t waiting = 0;
    std::uint32_t at = 0;
    std::uint64_t entered = 0;
    for (std::uint32_t child = 0;;) {
        if ((child & Bvh8Child::leaf) != 0) {
            if (leaf(child & Bvh8Child::first, Bvh8Child::count(child), &start.ray))
                return true;
        } else {
            later[waiting] = {entered, at};
            waiting += entered != 0 ? 1 : 0;
            at = child;
            watch(at / Bvh8Child::stride);
            Lanes t;
            entered = enter<Leaf>(t, wide, at, start.ray, ray.t_min, ray.t_max);
        }
        while (entered == 0) {
            if (waiting == 0) return false;
            --waiting;
            at = later[waiting].node;
            entered = later[waiting].lanes;
        }
        child = wide.nodes[at / Bvh8Child::stride].child[take_lane(entered)];
    }
}
/// \}

} // namespace ljus::detail
