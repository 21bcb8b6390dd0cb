#pragma once

/// \file ljus/accel/bvh.hpp
/// \brief A binary tree of boxes, which spares a ray most intersection tests.

#include <array>

#include "ljus/accel/detail/bvh_build.hpp"

namespace ljus {

/// \defgroup bvh Bounding volumes
/// \brief Trees that spare intersection tests. The student report proposes "an octree,
/// axis-aligned bounding boxes, or a binary space partition". Chapter: \ref ch_bvh.
/// \{

/// The default observer of a traversal. It does nothing.
struct NoTrace {
    /// Called with the index of each visited node.
    constexpr void operator()(std::uint32_t) const noexcept {}
};

/// The nearest hit that a search has found so far. If several hits are equally near,
/// the primitive with the lowest index counts, as in a loop over all primitives.
// [nearest]
template <std::floating_point T>
struct NearestHitT {
    ShapeHitT<T> at{}; ///< The hit.
    /// Index of the primitive.
    std::uint32_t number = std::numeric_limits<std::uint32_t>::max();
    bool found = false;     ///< Whether there is a hit.
    std::uint32_t slot = 0; ///< Position in the tree's order, set by nearest_hit().

    /// Accepts a hit if it is nearer than the hit found so far. The ray's t_max is then
    /// set one or two ulps beyond the hit, so that a primitive at the same t is still
    /// tested.
    /// \return Whether the hit was accepted.
    bool offer(const ShapeHitT<T>& hit, std::uint32_t of, RayT<T>& ray) noexcept {
        if (found && !(hit.t < at.t || (hit.t == at.t && of < number))) return false;
        const auto& [t, u, v, part] = hit; // by member: a wide copy would stall
        at.t = t;
        at.u = u;
        at.v = v;
        at.part = part;
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

/// The nearest hit among all primitives in a tree.
/// \param tree  A BvhT, a Bvh8 or a TriangleBvh.
/// \param ray   The ray. Hits lie within [t_min, t_max].
/// \param ask   Called as ask(slot, rest) for primitives that the ray may hit. `slot`
///              is a position in primitive_ids() of the tree, and `rest` is the ray up
///              to the nearest hit so far. Returns an optional ShapeHitT.
/// \return The same hit as a loop over all primitives.
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

/// A binary bounding volume hierarchy over primitives that have boxes \cite rubin1980.
/// The caller keeps the primitives. A traversal calls back with a *slot*, a position in
/// the order of the tree. primitive_ids() maps a slot to the index of a primitive.
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
    /// An empty tree.
    BvhT() = default;

    /// Builds the tree from the top, by the surface area heuristic.
    /// \param boxes     Boxes of fewer than 2^31 primitives; they may be equal or flat.
    /// \param settings  The tree does not depend on the number of threads.
    /// \throws std::invalid_argument  if a box is not finite or has swapped corners, or
    ///         if there are too many.
    /// \cost O(n log n) for n boxes; in float at most 68 bytes per box, and 36 more
    ///       during the build.
    explicit BvhT(std::span<const BoxT<T>> boxes, const BvhSettings& settings = {})
        : tree_(detail::build_bvh(boxes, settings)) {}

    /// The index of the primitive at each slot.
    [[nodiscard]] const std::vector<std::uint32_t>& primitive_ids() const noexcept {
        return tree_.primitive_ids;
    }
    /// The nodes, the root first.
    [[nodiscard]] const detail::GrowingArray<detail::BvhNodeT<T>>&
    nodes() const noexcept {
        return tree_.nodes;
    }
    /// The box around all primitives.
    [[nodiscard]] BoxT<T> box() const noexcept {
        return tree_.nodes.empty() ? BoxT<T>{} : tree_.nodes[0].box;
    }
    /// The size of the tree in bytes.
    [[nodiscard]] std::size_t bytes() const noexcept {
        return tree_.nodes.capacity() * sizeof(detail::BvhNodeT<T>) +
               tree_.primitive_ids.capacity() * 4;
    }

    /// Visits the primitives that a ray may hit, nearer nodes first.
    /// \param ray    The ray.
    /// \param test   Called as test(slot, ray) for primitives in leaves that the ray
    ///               enters. It may shorten the ray, as NearestHitT does, so that
    ///               farther nodes are skipped. Nodes at exactly t_max are still
    ///               visited.
    /// \param watch  Called with the index of each visited node.
    /// \cost O(log n) calls on average for n primitives, n in the worst case.
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

    /// Whether a test succeeds for at least one of the primitives that a ray may hit.
    /// \param ray    The ray.
    /// \param test   Called as test(slot). If it returns true, the traversal ends.
    /// \param watch  Called with the index of each visited node.
    template <typename Test, typename Watch = NoTrace>
    [[nodiscard]] bool any(const RayT<T>& ray, Test&& test, Watch&& watch = {}) const {
        return walk(ray, test, watch);
    }

private:
    // The traversal of both searches. It visits the nearer child first and pushes the
    // other one onto a stack, with the distance at which the ray enters it.
    // [walk]
    template <typename Test, typename Watch>
    bool walk(const RayT<T>& ray, Test&& test, Watch& watch) const {
        const auto& nodes = tree_.nodes;
        if (nodes.empty() || !(is_finite(ray.origin) && is_finite(ray.direction)))
            return false;
        const auto with_signs = box_ray(ray, nodes[0].box);
        if (!with_signs) return ask_all(test);
        const auto entry = [&](std::uint32_t i) {
            return intersect(*with_signs, nodes[i].box, ray.t_min, ray.t_max);
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
            // A hit that was found later may be nearer than nodes on the stack.
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
