#pragma once

/// \file ljus/accel/detail/bvh8_nodes.hpp
/// \brief The nodes of the fast tree, and how they are made of those of the plain one;
/// and a ray as they are asked by it.

#include <array>
#include <cstddef>
#include <limits>

#include "ljus/accel/detail/bvh_collapse.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/math/lanes.hpp"
#include "ljus/math/require.hpp"

namespace ljus::detail {

/// \defgroup wide_nodes Wide nodes
/// \brief Eight children a node. Chapter: \ref ch_bvh.
/// \{

/// A node with up to eight children, coordinate by coordinate \cite wald2008.
struct Bvh8Node {
    std::array<Lanes, 6> plane;                  ///< Low x, y, z, then high x, y, z.
    std::array<std::uint32_t, lane_count> child; ///< As Bvh8Child has them.
};
/// A child in 32 bits: how many nodes' lanes lie before its node; or, for a leaf, its
/// first slot and how many there are.
struct Bvh8Child {
    static constexpr std::uint32_t leaf = 1u << 31; ///< Set for a leaf.
    static constexpr int count_shift = 27;          ///< Then the count, less one,
    static constexpr std::uint32_t first = (1u << count_shift) - 1; ///< and the slot.
    /// How many primitives a leaf has.
    static constexpr std::uint32_t count(std::uint32_t child) noexcept {
        return ((child >> count_shift) & 15u) + 1;
    }
    /// A node in units of 32 bytes: its address is one shift away.
    static constexpr std::uint32_t stride = sizeof(Bvh8Node) / sizeof(Lanes);
};

/// A wide tree: nodes, the root first, and the order in which leaves have primitives.
/// Coordinates are as seen from the middle of everything, so that a scene far from the
/// origin is met as well as one around it.
struct Bvh8Nodes {
    std::vector<Bvh8Node> nodes{}; ///< Empty if there is nothing.
    std::vector<std::uint32_t>
        primitive_ids{}; ///< primitive_ids[slot] is a primitive's number, or padding.
    Box box{};           ///< Around everything.
    Vec3 middle{0};      ///< Of the box.
    Vec3 half{0};        ///< From there to its sides.

    /// A slot between leaves that nothing has.
    static constexpr std::uint32_t padding = std::numeric_limits<std::uint32_t>::max();
};

// Makes a wide node of a plain one and of what is below it.
template <std::floating_point T>
void widen(Bvh8Nodes& wide, const BvhNodesT<T>& tree, const BvhCollapse<T>& collapse,
           std::uint32_t from, std::size_t to, std::uint32_t multiple) {
    const auto [open, count] = collapse.children(from);
    Bvh8Node node{};
    for (std::size_t i = 0; i < lane_count; ++i) {
        // Nothing enters a box around nothing.
        const BoxT<T> box = i < count ? tree.nodes[open[i]].box : BoxT<T>{};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const int a = static_cast<int>(axis);
            node.plane[axis].lane[i] = box.low[a] - wide.middle[a];
            node.plane[axis + 3].lane[i] = box.high[a] - wide.middle[a];
        }
        if (i >= count) continue;
        const BvhNodeT<T>& below = tree.nodes[open[i]];
        if (below.count == 0) {
            node.child[i] =
                static_cast<std::uint32_t>(wide.nodes.size()) * Bvh8Child::stride;
            wide.nodes.resize(wide.nodes.size() + 1);
            continue;
        }
        node.child[i] = Bvh8Child::leaf |
                        ((below.count - 1) << Bvh8Child::count_shift) |
                        static_cast<std::uint32_t>(wide.primitive_ids.size());
        for (std::uint32_t k = 0; k < below.count; ++k)
            wide.primitive_ids.push_back(tree.primitive_ids[below.first + k]);
        while (wide.primitive_ids.size() % multiple != 0)
            wide.primitive_ids.push_back(Bvh8Nodes::padding);
    }
    wide.nodes[to] = node;
    for (std::size_t i = 0; i < count; ++i)
        if (tree.nodes[open[i]].count == 0)
            widen(wide, tree, collapse, open[i], node.child[i] / Bvh8Child::stride,
                  multiple);
}
/// Makes a tree wide.
/// \param tree      The plain tree; its leaves have at most 16 primitives.
/// \param multiple  Leaves start at multiples of so many slots, padding between them.
/// \return The wide tree.
/// \throws std::invalid_argument  if there are 2^27 slots or more.
template <std::floating_point T>
[[nodiscard]] Bvh8Nodes make_bvh8(const BvhNodesT<T>& tree,
                                  std::uint32_t multiple = 1) {
    Bvh8Nodes wide;
    if (tree.nodes.empty()) return wide;
    wide.box = tree.nodes[0].box;
    wide.middle = 0.5f * wide.box.low + 0.5f * wide.box.high;
    wide.half = 0.5f * wide.box.high - 0.5f * wide.box.low;
    wide.nodes.resize(1);
    widen(wide, tree, BvhCollapse<T>(tree), 0, 0, multiple);
    require(wide.primitive_ids.size() < Bvh8Child::first,
            "the number of slots in a tree",
            static_cast<long long>(wide.primitive_ids.size()), "below 2^27");
    // Copies have no room to spare.
    wide.nodes = std::vector<Bvh8Node>(wide.nodes);
    wide.primitive_ids = std::vector<std::uint32_t>(wide.primitive_ids);
    return wide;
}

/// \}

/// \defgroup wide_ray Rays for wide nodes
/// \brief What is computed once for a ray: the signs and the slack of box_ray()
/// \cite williams2005 \cite ize2013. Chapter: \ref ch_bvh.
/// \{

/// A ray, made ready for wide nodes.
struct Bvh8Ray {
    Vec3 inverse{1};                   ///< 1 / D, finite.
    Vec3 near_shift{0};                ///< t = plane * inverse - shift, a little early,
    Vec3 far_shift{0};                 ///< and a little late.
    std::array<std::size_t, 3> near{}; ///< The planes that it meets first, by axis,
    std::array<std::size_t, 3> far{};  ///< and last.
    float length = 0;                  ///< The largest component of D.
    float last = 0;                    ///< Beyond this t there is nothing.
    bool moderate = false; ///< Products of three such lengths are far from infinite.
};

/// Makes a ray ready. Boxes grow by as much as box_ray() says. A component of the
/// direction that is almost 0 is given a size: within the box that leads no ray astray
/// by more than this.
/// \param r       Becomes the ready ray.
/// \param ray     The ray.
/// \param middle  The middle of everything.
/// \param half    From there to the sides.
/// \return Whether that is possible: not if the direction is too long or too short, or
///         the origin too far away, for squares of floats.
[[nodiscard]] inline bool make_ready(Bvh8Ray& r, const Ray& ray, const Vec3& middle,
                                     const Vec3& half) noexcept {
    const Vec3 origin = ray.origin - middle;
    const Vec3 size = sizes(ray.direction);
    const float reach = max_component(sizes(origin) + half);
    r.length = max_component(size);
    r.last = 4 * reach / r.length;
    const Vec3 d = glm::max(size, Vec3{1e-12f * r.length});
    const float slack = 8 * std::numeric_limits<float>::epsilon() * reach;
    for (int axis = 0; axis < 3; ++axis) {
        const auto i = static_cast<std::size_t>(axis);
        const std::size_t back = std::signbit(ray.direction[axis]) ? 1 : 0;
        // Not by `back ?`: a processor cannot predict which way rays go.
        const float size_of_inverse = 1 / d[axis];
        const float inverse = std::copysign(size_of_inverse, ray.direction[axis]);
        const float shift = origin[axis] * inverse;
        const float grown = slack * size_of_inverse;
        r.inverse[axis] = inverse;
        r.near_shift[axis] = shift + grown;
        r.far_shift[axis] = shift - grown;
        r.near[i] = i + 3 * back;
        r.far[i] = i + 3 * (1 - back);
    }
    r.moderate = reach * reach * glm::max(reach, r.length) < 1e36f;
    // Their squares are still numbers: those of the directions, and of the distances.
    constexpr float most = 1e18f;
    return r.length > 1 / most && r.length < most && reach < most &&
           is_finite(r.near_shift) && is_finite(r.far_shift);
}
/// \}

} // namespace ljus::detail
