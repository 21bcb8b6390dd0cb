#pragma once

/// \file ljus/geometry/wide_bvh.hpp
/// \brief The fast tree of boxes: eight children a node, asked at once.

#include <array>
#include <bit>

#include "ljus/geometry/bvh.hpp"
#include "ljus/geometry/wide_nodes.hpp"
#include "ljus/geometry/wide_ray.hpp"
#include "ljus/math/prefetch.hpp"

namespace ljus {

/// \defgroup wide_bvh Wide trees
/// \brief The twin of the plain tree for speed \cite wald2008 : the same searches, the
/// same answers. Chapter: \ref ch_bvh.
/// \{

/// The plain tree, made wide: nodes of up to eight children, chosen by
/// \ref bvh_collapse.
class WideBvh {
public:
    /// A tree over nothing.
    WideBvh() = default;

    /// Builds the tree.
    /// \param boxes     As for build_bvh(), but below 2^27.
    /// \param settings  As for build_bvh(); leaves of at most 16.
    /// \param multiple  Leaves start at multiples of so many places, with holes
    ///                  between them.
    /// \throws As build_bvh().
    template <typename Boxes>
    requires std::convertible_to<const Boxes&, std::span<const Box>>
    explicit WideBvh(const Boxes& boxes, const BvhBuild& settings = {},
                     std::uint32_t multiple = 1) {
        require(settings.leaf_size <= 16, "leaf_size",
                static_cast<long long>(settings.leaf_size), "at most 16");
        wide_ = make_wide(build_bvh(std::span<const Box>(boxes), settings), multiple);
    }

    /// A place between leaves that nothing has.
    static constexpr std::uint32_t hole = WideNodes::hole;

    /// order()[place] is a thing's number, or a hole.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const noexcept {
        return wide_.order;
    }
    /// The nodes, the root first.
    [[nodiscard]] const std::vector<WideNode>& nodes() const noexcept {
        return wide_.nodes;
    }
    /// A box around everything.
    [[nodiscard]] const Box& box() const noexcept { return wide_.box; }
    /// The memory that the tree takes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return wide_.nodes.capacity() * sizeof(WideNode) + wide_.order.capacity() * 4;
    }

    /// Asks the things that a ray may meet, the nearer ones first: as BvhT::closest().
    template <typename Test, typename Watch = NoWatch>
    void closest(Ray ray, Test&& test, Watch&& watch = {}) const {
        const auto ask = [&](std::uint32_t place) {
            test(place, ray);
            return false;
        };
        walk(ray, each_place(ask), watch);
    }

    /// Whether any of the things that a ray may meet says yes: as BvhT::any().
    template <typename Test, typename Watch = NoWatch>
    [[nodiscard]] bool any(const Ray& ray, Test&& test, Watch&& watch = {}) const {
        return walk_any(ray, each_place(test), watch);
    }

    /// The way of closest().
    /// \param ray    The ray; a search may shorten it.
    /// \param leaf   Called as leaf(first place, count, ready ray). For a ray that
    ///               cannot be made ready, once, with a null pointer.
    /// \param watch  Called for each node on the way.
    template <typename Leaf, typename Watch>
    void walk(const Ray& ray, Leaf&& leaf, Watch&& watch) const;

    /// The way of any(): as walk(), and in no order.
    /// \param ray    The ray.
    /// \param leaf   As for walk(); true ends the search.
    /// \param watch  Called for each node on the way.
    /// \return Whether a leaf said true.
    template <typename Leaf, typename Watch>
    bool walk_any(const Ray& ray, Leaf&& leaf, Watch&& watch) const;

    /// A leaf for walk() that asks place by place.
    template <typename Ask>
    [[nodiscard]] auto each_place(Ask& ask) const {
        return [this, &ask](std::uint32_t first, std::uint32_t count, const WideRay*) {
            for (std::uint32_t place = first; place < first + count; ++place)
                if (wide_.order[place] != hole && ask(place)) return true;
            return false;
        };
    }

private:
    static constexpr std::size_t most_waiting = bvh_depth * (lane_count - 1) + 1;

    // A ray made ready; or all that there is to say of it.
    struct Start {
        WideRay ray{};
        bool done = true;
        bool found = false;
    };
    template <typename Leaf>
    Start begin(const Ray& ray, Leaf& leaf) const {
        Start start;
        if (wide_.nodes.empty() || !(ray.t_min <= ray.t_max)) return start;
        start.done = !make_ready(start.ray, ray, wide_.middle, wide_.half);
        if (start.done && is_finite(ray.origin) && is_finite(ray.direction))
            start.found = leaf(0u, static_cast<std::uint32_t>(wide_.order.size()),
                               static_cast<const WideRay*>(nullptr));
        return start;
    }
    // Asks eight boxes at once: which ones the ray enters, and where. A function of its
    // own for each search, and `inline`, so that compilers put it there.
    template <typename Search>
    std::uint64_t enter(Lanes& t, std::uint32_t node, const WideRay& r, float t_min,
                        float t_max) const noexcept;

    WideNodes wide_;
};

// [enter]
template <typename Search>
inline std::uint64_t WideBvh::enter(Lanes& t, std::uint32_t node, const WideRay& r,
                                    float t_min, float t_max) const noexcept {
    const Lanes* const lanes = wide_.nodes[0].plane.data();
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
// [enter]

// The way of a search for the nearest.
// [walk]
template <typename Leaf, typename Watch>
void WideBvh::walk(const Ray& ray, Leaf&& leaf, Watch&& watch) const {
    const Start start = begin(ray, leaf);
    if (start.done) return;
    // What waits: a child, and above it the t at which the ray enters it. For numbers
    // from 0 on, the bits are in the order of the values: so the nearer one is less.
    std::array<std::uint64_t, most_waiting> later;
    std::size_t waiting = 0;
    const auto wait = [&](std::uint64_t key) {
        const auto child = static_cast<std::uint32_t>(key);
        if ((child & WideChild::leaf) == 0)
            prefetch<4>(wide_.nodes[child / WideChild::stride].plane.data());
        later[waiting++] = key;
    };
    for (std::uint32_t at = 0;;) {
        if ((at & WideChild::leaf) != 0) {
            leaf(at & WideChild::first, WideChild::count(at), &start.ray);
        } else {
            watch();
            Lanes t;
            std::uint64_t entered = enter<Leaf>(t, at, start.ray, ray.t_min, ray.t_max);
            if (entered != 0) {
                const auto& child = wide_.nodes[at / WideChild::stride].child;
                const auto key = [&](std::size_t i) {
                    const auto t_bits = std::bit_cast<std::uint32_t>(t.lane[i]);
                    return std::uint64_t{t_bits} << 32 | child[i];
                };
                std::uint64_t nearest = key(take_lane(entered));
                // Of three the order is right, of more it nearly is: without a branch
                // that a processor would have to guess.
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
// [walk]

// The way of a search for any: in no order, so that of a node only the lanes wait.
// [walk_any]
template <typename Leaf, typename Watch>
bool WideBvh::walk_any(const Ray& ray, Leaf&& leaf, Watch&& watch) const {
    const Start start = begin(ray, leaf);
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
        if ((child & WideChild::leaf) != 0) {
            if (leaf(child & WideChild::first, WideChild::count(child), &start.ray))
                return true;
        } else {
            later[waiting] = {entered, at};
            waiting += entered != 0 ? 1 : 0;
            at = child;
            watch();
            Lanes t;
            entered = enter<Leaf>(t, at, start.ray, ray.t_min, ray.t_max);
        }
        while (entered == 0) {
            if (waiting == 0) return false;
            --waiting;
            at = later[waiting].node;
            entered = later[waiting].lanes;
        }
        child = wide_.nodes[at / WideChild::stride].child[take_lane(entered)];
    }
}
// [walk_any]

/// \}

} // namespace ljus
