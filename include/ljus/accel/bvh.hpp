#pragma once

/// \file ljus/accel/bvh.hpp
/// \brief The plain tree of boxes: what a ray meets, without asking everything.

#include <array>

#include "ljus/accel/detail/bvh_build.hpp"

namespace ljus {

/// \defgroup bvh Bounding volumes
/// \brief Discussion: "an octree, axis-aligned bounding boxes, or a binary space
/// partition". Chapter: \ref ch_bvh.
/// \{

/// Is told of each node that a search visits, and does nothing.
struct NoTrace {
    /// A node was visited: its number.
    constexpr void operator()(std::uint32_t) const noexcept {}
};

/// The nearest hit so far; of several that are as near, that of the primitive with the
/// least number: what asking all of them in turn would find.
// [nearest]
template <std::floating_point T>
struct NearestHitT {
    FlatHitT<T> at{};                                                 ///< Where it is.
    std::uint32_t number = std::numeric_limits<std::uint32_t>::max(); ///< Of what.
    bool found = false;     ///< Whether there is one.
    std::uint32_t slot = 0; ///< Of what, in the order of a tree: see nearest_hit().

    /// Takes a hit, if it is nearer, and shortens the ray to it: to one unit in the
    /// last place beyond it, because a primitive at the same t, computed in double, may
    /// seem farther.
    /// \return Whether it was nearer.
    bool offer(const FlatHitT<T>& hit, std::uint32_t of, RayT<T>& ray) noexcept {
        if (found && !(hit.t < at.t || (hit.t == at.t && of < number))) return false;
        at.t = hit.t; // one by one: a wide copy waits for what was just written
        at.u = hit.u;
        at.v = hit.v;
        at.part = hit.part;
        number = of;
        found = true;
        const T beyond = hit.t + hit.t * std::numeric_limits<T>::epsilon() +
                         std::numeric_limits<T>::denorm_min();
        ray.t_max = beyond < ray.t_max ? beyond : ray.t_max;
        return true;
    }
};
// [nearest]
using NearestHit = NearestHitT<float>; ///< NearestHitT in float.

/// The nearest hit of all primitives in a tree.
/// \param tree  A BvhT, a Bvh8 or a TriangleBvh.
/// \param ray   Hits count in [t_min, t_max].
/// \param ask   Called as ask(slot, ray) for those that the ray may meet; returns where
///              it does, an optional FlatHitT. The ray is shorter each time.
/// \return What asking all of them in turn would find.
// [nearest_hit]
template <typename Tree, std::floating_point T, typename Ask>
[[nodiscard]] NearestHitT<T> nearest_hit(const Tree& tree, const RayT<T>& ray,
                                         Ask&& ask) {
    NearestHitT<T> nearest;
    tree.closest(ray, [&](std::uint32_t slot, RayT<T>& rest) {
        const auto hit = ask(slot, rest);
        if (hit && nearest.offer(*hit, tree.primitive_ids()[slot], rest))
            nearest.slot = slot;
    });
    return nearest;
}
// [nearest_hit]

/// A binary tree of boxes over any primitives that have one \cite rubin1980. What the
/// primitives are, and where, is the caller's: a search calls back with a primitive's
/// *slot* in the tree's order, and primitive_ids() says which one that is.
///
///     std::vector<Box> boxes;
///     for (const Triangle& triangle : triangles) boxes.push_back(bounds(triangle));
///     const Bvh tree(boxes);
///     const NearestHit nearest =
///         nearest_hit(tree, ray, [&](std::uint32_t slot, const Ray& rest) {
///             return intersect(rest, triangles[tree.primitive_ids()[slot]]);
///         });
template <std::floating_point T>
class BvhT {
public:
    /// A tree over nothing.
    BvhT() = default;

    /// Builds the tree: top down, each range split where that is cheapest for rays.
    /// \param boxes     Any boxes, equal and flat ones too; below 2^31.
    /// \param settings  Leaves and threads; the tree is the same for any number.
    /// \throws std::invalid_argument  if a box is not finite, or there are too many.
    /// \cost O(n log n); at most 68 bytes per box for the tree in float, and 36 more
    ///       while it is built.
    explicit BvhT(std::span<const BoxT<T>> boxes, const BvhSettings& settings = {})
        : tree_(detail::build_bvh(boxes, settings)) {}

    /// primitive_ids()[slot] is a primitive's number in the span that the tree was
    /// built from.
    [[nodiscard]] const std::vector<std::uint32_t>& primitive_ids() const noexcept {
        return tree_.primitive_ids;
    }
    /// The nodes, the root first.
    [[nodiscard]] const std::vector<detail::BvhNodeT<T>>& nodes() const noexcept {
        return tree_.nodes;
    }
    /// A box around everything.
    [[nodiscard]] BoxT<T> box() const noexcept {
        return tree_.nodes.empty() ? BoxT<T>{} : tree_.nodes[0].box;
    }
    /// The memory that the tree takes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return tree_.nodes.capacity() * sizeof(detail::BvhNodeT<T>) +
               tree_.primitive_ids.capacity() * 4;
    }

    /// Asks the primitives that a ray may meet, the nearer ones first.
    /// \param ray    The ray.
    /// \param test   Called as test(slot, ray) for primitives whose box the ray meets;
    ///               it may shorten the ray, as NearestHitT does, so that what lies
    ///               farther is left out; what is as far is still asked.
    /// \param watch  Called with the number of each node on the way.
    /// \cost In the mean O(log n) calls, in the worst case n.
    template <typename Test, typename Watch = NoTrace>
    void closest(RayT<T> ray, Test&& test, Watch&& watch = {}) const {
        walk(
            ray,
            [&](std::uint32_t slot) {
                test(slot, ray);
                return false;
            },
            watch);
    }

    /// Whether any of the primitives that a ray may meet says yes.
    /// \param ray    The ray.
    /// \param test   Called as test(slot); true ends the search.
    /// \param watch  Called with the number of each node on the way.
    /// \return Whether one said true.
    template <typename Test, typename Watch = NoTrace>
    [[nodiscard]] bool any(const RayT<T>& ray, Test&& test, Watch&& watch = {}) const {
        return walk(ray, test, watch);
    }

private:
    // The way of both searches: of two children the nearer one first, and the other one
    // kept for later, with the distance at which the ray enters it.
    // [walk]
    template <typename Test, typename Watch>
    bool walk(const RayT<T>& ray, Test&& test, Watch& watch) const {
        const auto& nodes = tree_.nodes;
        if (nodes.empty() || !(is_finite(ray.origin) && is_finite(ray.direction)))
            return false;
        const auto with_signs = detail::box_ray(ray, nodes[0].box);
        if (!with_signs) return ask_all(test);
        const auto entry = [&](std::uint32_t i) {
            return detail::enter(*with_signs, nodes[i].box, ray.t_min, ray.t_max);
        };
        struct Later {
            std::uint32_t node;
            T t;
        };
        std::array<Later, detail::bvh_depth> later;
        std::size_t waiting = 0;
        if (!entry(0)) return false;
        for (std::uint32_t at = 0;;) {
            watch(at);
            const detail::BvhNodeT<T>& node = nodes[at];
            for (std::uint32_t i = 0; i < node.count; ++i)
                if (test(node.first + i)) return true;
            if (node.count == 0) {
                const auto one = entry(node.first);
                const auto two = entry(node.first + 1);
                if (one || two) {
                    const bool second = !one || (two && *two < *one);
                    at = node.first + (second ? 1u : 0u);
                    if (one && two)
                        later[waiting++] = {second ? node.first : node.first + 1,
                                            second ? *one : *two};
                    continue;
                }
            }
            // What was found since may lie in front of what waits.
            do {
                if (waiting == 0) return false;
                --waiting;
            } while (later[waiting].t > ray.t_max);
            at = later[waiting].node;
        }
    }
    // [walk]

    template <typename Test>
    bool ask_all(Test& test) const {
        for (std::uint32_t slot = 0; slot < tree_.primitive_ids.size(); ++slot)
            if (test(slot)) return true;
        return false;
    }

    detail::BvhNodesT<T> tree_;
};
using Bvh = BvhT<float>; ///< BvhT in float.

/// \}

} // namespace ljus
