#pragma once

/// \file ljus/accel/detail/bvh8_walk.hpp
/// \brief The traversal of a wide tree by a ray.

#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <type_traits>

#include "ljus/accel/detail/bvh8_build.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/math/lanes.hpp"

namespace ljus::detail {

/// A ray prepared for wide nodes.
struct Bvh8Ray {
    Vec3 inverse{1};    ///< 1 over the direction, per component; always finite.
    Vec3 near_shift{0}; ///< The shift of the near planes: t = plane * inverse - shift.
    Vec3 far_shift{0};  ///< The shift of the far planes.
    /// The index of each axis's near plane in Bvh8Node::plane.
    std::array<std::size_t, 3> near{};
    /// The index of each axis's far plane in Bvh8Node::plane.
    std::array<std::size_t, 3> far{};
    float length = 0; ///< The direction's largest absolute component.
    float last = 0;   ///< The largest t that is searched.
    /// Whether conservative_filter() can multiply three lengths without overflow.
    bool moderate = false;
};

/// Prepares a ray. `near_shift` and `far_shift` enlarge the boxes by the margin of
/// box_ray(). A component of the direction that is close to 0 is replaced by a small
/// number. Within the tree's box, this replacement moves the ray by less than the
/// margin.
/// \return False if the square of the direction's length or of the distance to the box
///         is outside the range of float.
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
        // Branch-free, because the directions of rays are unpredictable.
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
    constexpr float most = 1e18f;
    return r.length > 1 / most && r.length < most && reach < most &&
           is_finite(r.near_shift) && is_finite(r.far_shift);
}

// Tests eight boxes at once. Returns the boxes that the ray enters, as yes_lanes()
// does, and sets `t` to the distances at which it enters. Each type of search has its
// own instance, because compilers inline a function that is called once.
template <typename Search>
inline std::uint64_t entered_lanes(Lanes& t, const Bvh8Nodes& wide, std::uint32_t node,
                                   const Bvh8Ray& r, float t_min,
                                   float t_max) noexcept {
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
// The stack of a search for the nearest hit. An entry is a 64-bit integer: in its upper
// half the bits of the t at which the ray enters a child, in its lower half the child.
// The bits of non-negative floats are ordered like the floats, so that entries are
// compared as integers. Each type of search has its own type of stack; see
// entered_lanes().
template <typename Search>
class NearestFirst {
public:
    // Returns the nearest of the children that the ray enters, and pushes the others.
    // There is at least one.
    std::uint32_t enter(const Bvh8Nodes& wide, std::uint32_t node,
                        std::uint64_t entered, const Lanes& t) {
        const auto& child = wide.nodes[node / Bvh8Child::stride].child;
        const auto key = [&](std::size_t i) {
            const auto t_bits = std::bit_cast<std::uint32_t>(t.lane[i]);
            return std::uint64_t{t_bits} << 32 | child[i];
        };
        const auto wait = [&](std::uint64_t later) {
            const auto below = static_cast<std::uint32_t>(later);
            if ((below & Bvh8Child::leaf) == 0)
                prefetch<4>(wide.nodes[below / Bvh8Child::stride].plane.data());
            later_[size_++] = later;
        };
        std::uint64_t nearest = key(take_lane(entered));
        // Up to three children are sorted exactly, and more only approximately, to
        // avoid unpredictable branches.
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
        return static_cast<std::uint32_t>(nearest);
    }
    // Pops the next child that is not behind the nearest hit.
    bool next(const Bvh8Nodes&, std::uint32_t& child, float t_max) noexcept {
        float entry = 0;
        do {
            if (size_ == 0) return false;
            --size_;
            entry =
                std::bit_cast<float>(static_cast<std::uint32_t>(later_[size_] >> 32));
        } while (entry > t_max);
        child = static_cast<std::uint32_t>(later_[size_]);
        return true;
    }

private:
    std::array<std::uint64_t, bvh_depth*(lane_count - 1) + 1> later_;
    std::size_t size_ = 0;
};

// The stack of a search for any hit. The order of the children does not matter, so that
// an entry is a node and the lanes that remain to be visited.
template <typename Search>
class AnyOrder {
public:
    // As in NearestFirst.
    std::uint32_t enter(const Bvh8Nodes& wide, std::uint32_t node,
                        std::uint64_t entered, const Lanes&) noexcept {
        later_[size_] = {entered_, node_};
        size_ += entered_ != 0 ? 1 : 0;
        entered_ = entered;
        node_ = node;
        return take(wide);
    }
    // As in NearestFirst.
    bool next(const Bvh8Nodes& wide, std::uint32_t& child, float) noexcept {
        while (entered_ == 0) {
            if (size_ == 0) return false;
            --size_;
            node_ = later_[size_].node;
            entered_ = later_[size_].lanes;
        }
        child = take(wide);
        return true;
    }

private:
    std::uint32_t take(const Bvh8Nodes& wide) noexcept {
        return wide.nodes[node_ / Bvh8Child::stride].child[take_lane(entered_)];
    }
    struct Later {
        std::uint64_t lanes;
        std::uint32_t node;
    };
    std::array<Later, bvh_depth> later_;
    std::size_t size_ = 0;
    std::uint64_t entered_ = 0;
    std::uint32_t node_ = 0;
};

/// The traversal of every search. It tests the eight boxes of a node together and then
/// visits a child \cite wald2008. It calls `watch(node)` for each node, and
/// `leaf(first slot, count, prepared ray)` for each leaf. If `leaf` returns true, the
/// search ends. If the ray cannot be prepared, `leaf` is called once for all slots,
/// with a null pointer.
/// \tparam any  If true, children are visited in any order. If false, nearer children
///              come first, and the leaf function shortens the ray.
template <bool any, typename Leaf, typename Watch>
bool walk(const Bvh8Nodes& wide, const Ray& ray, Leaf&& leaf, Watch&& watch) {
    if (wide.nodes.empty() || !(ray.t_min <= ray.t_max)) return false;
    Bvh8Ray ready;
    if (!make_ready(ready, ray, wide.middle, wide.half))
        return is_finite(ray.origin) && is_finite(ray.direction) &&
               leaf(0u, static_cast<std::uint32_t>(wide.primitive_ids.size()),
                    static_cast<const Bvh8Ray*>(nullptr));
    std::conditional_t<any, AnyOrder<Leaf>, NearestFirst<Leaf>> waiting;
    for (std::uint32_t at = 0;;) {
        if ((at & Bvh8Child::leaf) != 0) {
            if (leaf(at & Bvh8Child::first, Bvh8Child::count(at), &ready)) return true;
        } else {
            watch(at / Bvh8Child::stride);
            Lanes t;
            const std::uint64_t entered =
                entered_lanes<Leaf>(t, wide, at, ready, ray.t_min, ray.t_max);
            if (entered != 0) {
                at = waiting.enter(wide, at, entered, t);
                continue;
            }
        }
        if (!waiting.next(wide, at, ray.t_max)) return false;
    }
}

} // namespace ljus::detail
