#pragma once

/// \file ljus/geometry/wide_bvh.hpp
/// \brief The fast tree of boxes: eight children a node, asked at once.

#include <algorithm>
#include <array>
#include <bit>

#include "ljus/geometry/bvh.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus {

/// \defgroup wide_bvh Wide trees
/// \brief The twin of the plain tree for speed: the same searches, the same answers.
/// Chapter: \ref ch_bvh.
/// \{

/// A node with up to eight children, coordinate by coordinate \cite wald2008.
// [wide node]
struct WideNode {
    std::array<Lanes, 6> plane;                  ///< Low x, y, z, then high x, y, z.
    std::array<std::uint32_t, lane_count> child; ///< As WideChild has them.
};
// [wide node]

/// A child in 32 bits: how many nodes' lanes lie before its node; or, for a leaf, its
/// first place and how many there are.
struct WideChild {
    static constexpr std::uint32_t leaf = 1u << 31; ///< Set for a leaf.
    static constexpr int count_shift = 27;          ///< Then the count, less one,
    static constexpr std::uint32_t first = (1u << count_shift) - 1; ///< and the place.
    /// A node in units of 32 bytes: its address is one shift away.
    static constexpr std::uint32_t stride = sizeof(WideNode) / sizeof(Lanes);
};

/// A ray, made ready for wide nodes.
struct WideRay {
    Vec3 inverse{1};    ///< 1 / D, finite.
    Vec3 near_shift{0}; ///< t = plane * inverse - shift, a little early,
    Vec3 far_shift{0};  ///< and a little late.
    std::array<std::size_t, 3>
        near{}; ///< The planes that it meets first, along x, y, z,
    std::array<std::size_t, 3> far{}; ///< and last.
    float length = 0;                 ///< The largest component of D.
    float last = 0;                   ///< Beyond this t there is nothing.
    bool moderate = false; ///< Products of three such lengths are far from infinite.
};

/// The plain tree, made wide: of each node the largest children are opened until there
/// are eight. Coordinates are as seen from the middle of everything, so that a scene
/// far from the origin is met as well as one around it.
class WideBvh {
public:
    /// A tree over nothing.
    WideBvh() = default;

    /// Builds the tree.
    /// \param boxes     As for build_bvh(), but below 2^27.
    /// \param settings  As for build_bvh(); leaves of at most 16.
    /// \param multiple  Leaves start at multiples of so many places, holes between
    /// them.
    /// \throws As build_bvh().
    explicit WideBvh(std::span<const Box> boxes, const BvhBuild& settings = {},
                     std::uint32_t multiple = 1);

    /// A place between leaves that nothing has.
    static constexpr std::uint32_t hole = std::numeric_limits<std::uint32_t>::max();

    /// order()[place] is a thing's number, or a hole.
    [[nodiscard]] const std::vector<std::uint32_t>& order() const noexcept {
        return order_;
    }
    /// The nodes, the root first.
    [[nodiscard]] const std::vector<WideNode>& nodes() const noexcept { return nodes_; }
    /// A box around everything.
    [[nodiscard]] const Box& box() const noexcept { return box_; }
    /// The memory that the tree takes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return nodes_.capacity() * sizeof(WideNode) + order_.capacity() * 4;
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
        return walk(ray, each_place(test), watch);
    }

    /// The way of both searches.
    /// \param ray    The ray; a search may shorten it.
    /// \param leaf   Called as leaf(first place, count, ready ray); true ends the
    ///               search. For a ray that cannot be made ready, once, with a null
    ///               pointer.
    /// \param watch  Called for each node on the way.
    /// \return Whether a leaf said true.
    template <typename Leaf, typename Watch>
    bool walk(const Ray& ray, Leaf&& leaf, Watch&& watch) const;

    /// A leaf for walk() that asks place by place.
    template <typename Ask>
    [[nodiscard]] auto each_place(Ask& ask) const {
        return [this, &ask](std::uint32_t first, std::uint32_t count, const WideRay*) {
            for (std::uint32_t place = first; place < first + count; ++place)
                if (order_[place] != hole && ask(place)) return true;
            return false;
        };
    }

private:
    [[nodiscard]] bool make_ready(WideRay& ready, const Ray& ray) const noexcept;
    void widen(const BvhNodesT<float>& tree, std::uint32_t from, std::size_t to,
               std::uint32_t multiple);

    std::vector<WideNode> nodes_;
    std::vector<std::uint32_t> order_;
    Box box_;
    Vec3 middle_{0}; // of the box
    Vec3 half_{0};   // from there to its sides
};

// [walk]
template <typename Leaf, typename Watch>
bool WideBvh::walk(const Ray& ray, Leaf&& leaf, Watch&& watch) const {
    WideRay r;
    if (nodes_.empty() || !(ray.t_min <= ray.t_max)) return false;
    if (!make_ready(r, ray)) {
        if (!is_finite(ray.origin) || !is_finite(ray.direction)) return false;
        return leaf(0u, static_cast<std::uint32_t>(order_.size()),
                    static_cast<const WideRay*>(nullptr));
    }

    // Asks eight boxes at once: which ones the ray enters, and where.
    const Lanes* const lanes = nodes_[0].plane.data();
    Lanes t;
    const auto enter = [&](std::uint32_t node) {
        const Lanes& near_x = (lanes + r.near[0])[node];
        const Lanes& near_y = (lanes + r.near[1])[node];
        const Lanes& near_z = (lanes + r.near[2])[node];
        const Lanes& far_x = (lanes + r.far[0])[node];
        const Lanes& far_y = (lanes + r.far[1])[node];
        const Lanes& far_z = (lanes + r.far[2])[node];
        const auto larger = [](float a, float b) { return a > b ? a : b; };
        const auto smaller = [](float a, float b) { return a < b ? a : b; };
        const float t_min = ray.t_min, t_max = ray.t_max;
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
    };

    // What waits: a child, and above it the t at which the ray enters it. For numbers
    // from 0 on, the bits are in the order of the values: so the nearer one is less.
    std::array<std::uint64_t, bvh_depth*(lane_count - 1) + 1> later;
    std::size_t waiting = 0;
    for (std::uint32_t at = 0;;) {
        if ((at & WideChild::leaf) != 0) {
            if (leaf(at & WideChild::first, ((at >> WideChild::count_shift) & 15u) + 1,
                     static_cast<const WideRay*>(&r)))
                return true;
        } else {
            watch();
            if (std::uint64_t entered = enter(at); entered != 0) {
                const auto& child = nodes_[at / WideChild::stride].child;
                const auto take = [&] {
                    const std::size_t i = take_lane(entered);
                    const auto t_bits = std::bit_cast<std::uint32_t>(t.lane[i]);
                    return std::uint64_t{t_bits} << 32 | child[i];
                };
                std::uint64_t nearest = take();
                // Of three the order is right, of more it nearly is: without a branch
                // that a processor would have to guess.
                if (entered != 0) {
                    std::uint64_t second = take();
                    const std::uint64_t less = std::min(nearest, second);
                    second = std::max(nearest, second);
                    nearest = less;
                    while (entered != 0) {
                        const std::uint64_t other = take();
                        const std::uint64_t farther = std::max(nearest, other);
                        nearest = std::min(nearest, other);
                        later[waiting++] = std::max(second, farther);
                        second = std::min(second, farther);
                    }
                    later[waiting++] = second;
                }
                at = static_cast<std::uint32_t>(nearest);
                continue;
            }
        }
        // What was found since may lie in front of what waits.
        float entry = 0;
        do {
            if (waiting == 0) return false;
            --waiting;
            entry =
                std::bit_cast<float>(static_cast<std::uint32_t>(later[waiting] >> 32));
        } while (entry > ray.t_max);
        at = static_cast<std::uint32_t>(later[waiting]);
    }
}
// [walk]

// Boxes grow by as much as box_ray() says. A component of the direction that is almost
// 0 is given a size: within the box that leads no ray astray by more than this.
inline bool WideBvh::make_ready(WideRay& r, const Ray& ray) const noexcept {
    const Vec3 origin = ray.origin - middle_;
    const Vec3 size = glm::abs(ray.direction);
    const float reach = max_component(glm::abs(origin) + half_);
    r.length = max_component(size);
    r.last = 4 * reach / r.length;
    const Vec3 d = glm::max(size, Vec3{1e-12f * r.length});
    const float slack = 8 * std::numeric_limits<float>::epsilon() * reach;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const bool back = std::signbit(ray.direction[axis]);
        const float size_of_inverse = 1 / d[axis];
        const float shift = origin[axis] * (back ? -size_of_inverse : size_of_inverse);
        r.inverse[axis] = back ? -size_of_inverse : size_of_inverse;
        r.near_shift[axis] = shift + slack * size_of_inverse;
        r.far_shift[axis] = shift - slack * size_of_inverse;
        r.near[i] = back ? i + 3 : i;
        r.far[i] = back ? i : i + 3;
    }
    r.moderate = reach * reach * std::max(reach, r.length) < 1e36f;
    // Their squares are still numbers: those of the directions, and of the distances.
    constexpr float most = 1e18f;
    return r.length > 1 / most && r.length < most && reach < most &&
           is_finite(r.near_shift) && is_finite(r.far_shift);
}

// [widen]
inline WideBvh::WideBvh(std::span<const Box> boxes, const BvhBuild& settings,
                        std::uint32_t multiple) {
    require(settings.leaf_size <= 16, "leaf_size",
            static_cast<long long>(settings.leaf_size), "at most 16");
    const BvhNodesT<float> tree = build_bvh(boxes, settings);
    if (tree.nodes.empty()) return;
    box_ = tree.nodes[0].box;
    middle_ = 0.5f * box_.low + 0.5f * box_.high;
    half_ = 0.5f * box_.high - 0.5f * box_.low;
    nodes_.emplace_back();
    widen(tree, 0, 0, multiple);
    require(order_.size() < WideChild::first, "the number of places in a tree",
            static_cast<long long>(order_.size()), "below 2^27");
    nodes_.shrink_to_fit();
    order_.shrink_to_fit();
}

// Makes a wide node of a binary one and of what is below it.
inline void WideBvh::widen(const BvhNodesT<float>& tree, std::uint32_t from,
                           std::size_t to, std::uint32_t multiple) {
    const auto area = [&](std::uint32_t node) {
        const Vec3 size = tree.nodes[node].box.high - tree.nodes[node].box.low;
        return size.x * size.y + size.y * size.z + size.z * size.x;
    };
    std::array<std::uint32_t, lane_count> open{from};
    std::size_t count = 1;
    while (count < lane_count) {
        std::size_t largest = count;
        for (std::size_t i = 0; i < count; ++i)
            if (tree.nodes[open[i]].count == 0 &&
                (largest == count || area(open[i]) > area(open[largest])))
                largest = i;
        if (largest == count) break; // all are leaves
        const std::uint32_t first = tree.nodes[open[largest]].first;
        open[largest] = first;
        open[count++] = first + 1;
    }

    WideNode node{};
    for (std::size_t i = 0; i < lane_count; ++i) {
        // Nothing enters a box around nothing.
        const Box box = i < count ? tree.nodes[open[i]].box : Box{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            node.plane[axis].lane[i] = box.low[a] - middle_[a];
            node.plane[axis + 3].lane[i] = box.high[a] - middle_[a];
        }
        if (i >= count) continue;
        const BvhNodeT<float>& below = tree.nodes[open[i]];
        if (below.count == 0) {
            node.child[i] =
                static_cast<std::uint32_t>(nodes_.size()) * WideChild::stride;
            nodes_.emplace_back();
            continue;
        }
        node.child[i] = WideChild::leaf |
                        ((below.count - 1) << WideChild::count_shift) |
                        static_cast<std::uint32_t>(order_.size());
        for (std::uint32_t k = 0; k < below.count; ++k)
            order_.push_back(tree.order[below.first + k]);
        while (order_.size() % multiple != 0) order_.push_back(hole);
    }
    nodes_[to] = node;
    for (std::size_t i = 0; i < count; ++i)
        if (tree.nodes[open[i]].count == 0)
            widen(tree, open[i], node.child[i] / WideChild::stride, multiple);
}
// [widen]

/// \}

} // namespace ljus
