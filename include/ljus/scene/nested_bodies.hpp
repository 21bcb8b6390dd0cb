#pragma once

/// \file ljus/scene/nested_bodies.hpp
/// \brief Transparent bodies that overlap: whose medium holds, and which surfaces are
/// there.

#include <cstdint>
#include <limits>

#include "ljus/scene/body_list.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup nested_bodies Bodies in each other
/// \brief Water in a glass, a bubble in the water. Chapter: \ref ch_rough_glass.
///
/// Where bodies overlap, the one of the highest `priority` holds
/// \cite schmidt2002. A path knows in which bodies it is. Of a surface only the highest
/// body before it and the highest one behind it count:
///
/// | these two     | the surface                                                    |
/// |---------------|----------------------------------------------------------------|
/// | are the same  | is not there: paths, photons and shadow rays go straight on    |
/// | are different | is one boundary, of their relative index, to the second medium |
///
/// So water may reach a little into its glass, and a bubble, of index 1, may stand out
/// of the water. Priorities hold if any material of the scene has one that is not 0;
/// otherwise each surface counts as one between its body and air. Of equal priorities
/// the higher index holds, and the survey says so.
/// \{

/// What a path crosses at a surface, if it goes through.
template <std::floating_point T>
struct CrossingT {
    SceneHitT<T> hit{};   ///< The surface; of several in one place the boundary.
    BodyList before{};    ///< The bodies before it, and
    BodyList behind{};    ///< behind it; the same at what is opaque or thin.
    bool hidden = false;  ///< Whether it is not there.
    bool entered = false; ///< Whether it is that of the body behind it.

    /// The rank of the body on its outside; 0: air.
    [[nodiscard]] std::uint8_t outside() const noexcept {
        return entered ? before.top() : behind.top();
    }
};

namespace detail {

/// Calls f(rank, hit, front) for each surface of a transparent body at a hit of
/// closest_hit(); `front` is whether the ray arrives from its outside.
/// \return The point of the hit, with an error that lets a ray start beyond all of
///         them.
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

/// What a ray crosses at a hit.
/// \param world  The closed scene.
/// \param ray    Its direction may have any length.
/// \param hit    A hit of closest_hit().
/// \param known  The bodies before the hit, as far as they are known. A body that ends
///               at the hit is among them.
/// \cost Two surface points; in contact with others two searches of the place.
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

/// All bodies around a ray's origin: those whose surface the ray leaves without having
/// entered it. Bodies are closed, and consist of one shape or several.
/// \param world  The closed scene.
/// \param ray    Its t_max does not matter.
/// \cost A ray per surface up to the end of the scene.
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

/// The bodies around the start of a path: bodies_around(), or none where priorities do
/// not hold.
/// \cost A comparison outside the bounding box of all bodies.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] BodyList bodies_at(const W& world, const RayT<T>& ray) {
    if constexpr (W::lists_priorities)
        if (world.has_priorities() && world.may_be_in_medium(ray.origin))
            return bodies_around(world, ray);
    return {};
}

/// \}

} // namespace ljus
