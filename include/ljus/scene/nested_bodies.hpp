#pragma once

/// \file ljus/scene/nested_bodies.hpp
/// \brief Transparent bodies that overlap: which medium counts at a point, and which
/// surfaces a path meets.

#include <cstdint>
#include <limits>

#include "ljus/scene/body_list.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup nested_bodies Nested bodies
/// \brief Transparent bodies that overlap, such as water in a glass and a bubble in the
/// water. Chapter: \ref ch_rough_glass.
///
/// Where bodies overlap, the medium of the body with the highest `priority` counts
/// \cite schmidt2002. A path keeps a list of the bodies around it. At a surface, only
/// two bodies count: those of the highest priority before and behind the surface.
///
/// | these bodies  | the surface                                                    |
/// |---------------|----------------------------------------------------------------|
/// | are the same  | is ignored: paths, photons and shadow rays go straight on      |
/// | are different | is a boundary, with the relative index of the two bodies       |
///
/// Water may therefore extend a little into its glass, and a bubble, of index 1, may
/// stick out of the water. Priorities are used if any material of the scene has a
/// priority other than 0. Otherwise each surface is a boundary between its body and
/// air. Among bodies of equal priority, the body of the higher index counts, and
/// survey() says so.
/// \{

/// The boundary that a path crosses if it passes through a surface.
template <std::floating_point T>
struct CrossingT {
    SceneHitT<T> hit{}; ///< The surface, chosen from all coinciding surfaces.
    BodyList before{};  ///< The bodies before the surface.
    /// The bodies behind the surface; for an opaque or thin surface, equal to `before`.
    BodyList behind{};
    bool hidden = false;  ///< Whether the surface is ignored.
    bool entered = false; ///< Whether the surface belongs to the body behind it.

    /// The rank of the body outside the surface; 0 for air.
    [[nodiscard]] std::uint8_t outside() const noexcept {
        return entered ? before.top() : behind.top();
    }
};

namespace detail {

/// Calls f(rank, hit, front) for each surface of a transparent body at a hit of
/// closest_hit(). `front` tells whether the ray arrives from outside the body.
/// \return The point of the hit, with an error so large that a ray spawned there starts
///         beyond all these surfaces.
template <AnyWorld W, std::floating_point T, typename F>
SurfacePointT<T> each_body_at(const W& world, const RayT<T>& ray,
                              const SceneHitT<T>& hit, F&& f) {
    const auto pass = [&](const SceneHitT<T>& at, bool front) {
        const std::uint8_t rank = world.rank_of(world.object(at.object).material);
        if (rank != 0) f(rank, at, front);
    };
    SurfacePointT<T> point = surface_at(world, ray, hit);
    const TouchingObject* const here =
        hit.shared ? world.contacts().find(hit.object) : nullptr;
    if (here == nullptr) {
        pass(hit, glm::dot(ray.direction, point.normal) < T(0));
        return point;
    }
    const auto depth = visit_place(world, ray, hit, *here,
                                   [&](const TouchingObject&, const SceneHitT<T>& at,
                                       bool front) { pass(at, front); });
    point.error += depth.value_or(T(0));
    return point;
}

} // namespace detail

/// The boundary that a ray, with a direction of any length, crosses at a hit of
/// closest_hit(). `known` are the bodies before the hit, as far as they are known. A
/// body that ends at the hit but is not known is added to CrossingT::before.
/// \cost Two surface points. If objects are in contact at the hit, two searches for the
///       other surfaces.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] CrossingT<T> crossing_at(const W& world, const RayT<T>& ray,
                                       const SceneHitT<T>& hit, const BodyList& known) {
    CrossingT<T> crossing{.hit = hit, .before = known, .behind = known};
    if (!world.has_priorities() ||
        world.rank_of(world.object(hit.object).material) == 0)
        return crossing;
    // [crossing]
    const auto cross = [&](std::uint8_t rank, const SceneHitT<T>&, bool front) {
        if (front) {
            crossing.behind = crossing.behind.with(rank);
        } else if (crossing.behind.has(rank)) {
            crossing.behind = crossing.behind.without(rank);
        } else {
            crossing.before = crossing.before.with(rank);
        }
    };
    detail::each_body_at(world, ray, hit, cross);
    const std::uint8_t from = crossing.before.top(), to = crossing.behind.top();
    crossing.hidden = from == to;
    // [crossing]
    const auto choose = [&](std::uint8_t rank, const SceneHitT<T>& at, bool front) {
        if (rank != (front ? to : from) || crossing.entered) return;
        crossing.hit.at = at.at;
        crossing.hit.object = at.object;
        crossing.entered = front;
    };
    detail::each_body_at(world, ray, hit, choose);
    return crossing;
}

/// All bodies around the origin of a ray: those that the ray leaves without having
/// entered them. The t_max of the ray is ignored. Each body must be closed. It may
/// consist of several shapes.
/// \cost One call of closest_hit() per surface up to the end of the scene. Only the
///       first 256 surfaces are visited.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] BodyList bodies_around(const W& world, RayT<T> ray) {
    ray.t_max = std::numeric_limits<T>::infinity();
    BodyList around, entered;
    for (int surfaces = 0; surfaces < 256; ++surfaces) {
        const auto hit = closest_hit(world, ray);
        if (!hit) break;
        const auto cross = [&](std::uint8_t rank, const SceneHitT<T>&, bool front) {
            if (front)
                entered = entered.with(rank);
            else if (entered.has(rank))
                entered = entered.without(rank);
            else
                around = around.with(rank);
        };
        const auto point = detail::each_body_at(world, ray, *hit, cross);
        ray = spawn_ray(point, ray.direction, ray.time);
    }
    return around;
}

/// The bodies around the start of a path, by bodies_around(). In a scene without
/// priorities the list is empty.
/// \cost One comparison for a point outside the bounding box of all bodies.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] BodyList bodies_at(const W& world, const RayT<T>& ray) {
    if constexpr (W::lists_priorities)
        if (world.has_priorities() && world.may_be_in_medium(ray.origin))
            return bodies_around(world, ray);
    return {};
}

/// \}

} // namespace ljus
