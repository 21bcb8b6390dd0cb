#pragma once

/// \file ljus/geometry/moving.hpp
/// \brief A shape that moves while the shutter is open.

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/shape.hpp"

namespace ljus {

/// \defgroup moving Moving shapes
/// \brief Section 2.1, distributed rays: motion blur. Chapter:
/// \ref ch_distributed_rays.
/// \{

/// A shape that is moved at little cost, so that it can be at each ray's own time.
template <typename S>
concept Movable = Shape<S> && requires(const S& shape, const Vec3T<ScalarOf<S>>& by) {
    { translated(shape, by) } -> std::same_as<S>;
};

/// A shape on its way in a straight line. Time runs from 0, when the shutter opens, to
/// 1, when it closes.
///
/// It is a shape like any other, and a ray meets it where it is at the ray's time. A
/// scene that lists no moving shape pays nothing.
/// \tparam S  A sphere, a triangle, a quad.
// [moving]
template <Movable S>
struct Moving {
    S shape{};                 ///< Where it is at time 0.
    Vec3T<ScalarOf<S>> way{0}; ///< How far it moves until time 1, in scene units.
};
// [moving]

namespace detail {

/// Whether a type of shape moves.
template <typename S>
inline constexpr bool is_moving = false;

/// The one that does.
template <typename S>
inline constexpr bool is_moving<Moving<S>> = true;

} // namespace detail

/// A shape at a time.
/// \param moving  The shape.
/// \param time    In [0, 1].
/// \return Where it is then.
// [at_time]
template <typename S, std::floating_point T>
[[nodiscard]] S at_time(const Moving<S>& moving, T time) noexcept {
    return translated(moving.shape, time * moving.way);
}
// [at_time]

/// The same for a shape that stands still: itself.
template <typename S, std::floating_point T>
requires(!detail::is_moving<S>)
    [[nodiscard]] constexpr const S& at_time(const S& shape, T) noexcept {
    return shape;
}

/// \name As a shape
/// Its bounds hold it at all times.
/// \{

/// Where a ray meets it.
/// \param ray     Any length of direction but zero.
/// \param moving  The shape.
/// \return As for the shape itself at the ray's time.
template <typename Compute = void, std::floating_point T, typename S>
[[nodiscard]] auto intersect(const RayT<T>& ray, const Moving<S>& moving) noexcept {
    return intersect<Compute>(ray, at_time(moving, ray.time));
}

/// The point that a ray hit.
/// \param moving  The shape.
/// \param ray     The ray.
/// \param hit     What intersect() returned.
/// \return As for the shape itself at the ray's time.
template <typename S, std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const Moving<S>& moving,
                                             const RayT<T>& ray,
                                             const FlatHitT<T>& hit) noexcept {
    return surface_point(at_time(moving, ray.time), ray, hit);
}

/// The area, of a shape that has one.
/// \param moving  The shape.
/// \return In squared scene units.
template <typename S>
requires HasArea<S>
[[nodiscard]] auto area(const Moving<S>& moving) noexcept {
    return area(moving.shape);
}

/// A point, uniform over the area, where it is at time 0.
/// \param moving  The shape.
/// \param u       Point of the unit square.
/// \return The point.
template <typename S, std::floating_point T>
requires Samplable<S>
[[nodiscard]] SurfacePointT<T> sample_area(const Moving<S>& moving,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(moving.shape, u);
}

/// A sphere around all its places.
/// \param moving  The shape.
/// \return The sphere.
template <typename S>
[[nodiscard]] auto bounding_sphere(const Moving<S>& moving) noexcept {
    auto sphere = bounding_sphere(moving.shape);
    using T = decltype(sphere.radius);
    sphere.center += moving.way / T(2);
    sphere.radius += glm::length(moving.way) / T(2);
    return sphere;
}

/// A box around all its places: those between the first and the last lie between.
/// \param moving  The shape.
/// \return The box, a few units in the last place too large.
template <typename S>
[[nodiscard]] auto bounds(const Moving<S>& moving) noexcept {
    using T = ScalarOf<S>;
    const BoxT<T> first = bounds(moving.shape), last = bounds(at_time(moving, T(1)));
    const Vec3T<T> rounding =
        detail::rounding_bound<T>(4) *
        (glm::max(glm::abs(first.low), glm::abs(first.high)) + glm::abs(moving.way));
    const BoxT<T> both = box_union(first, last);
    return BoxT<T>{both.low - rounding, both.high + rounding};
}

/// The texture coordinates: those of the shape, wherever it is.
/// \param moving  The shape.
/// \param hit     What intersect() returned.
/// \param point   Of surface_point().
/// \return (u, v), without a unit.
template <typename S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const Moving<S>& moving,
                                           const FlatHitT<T>& hit,
                                           const SurfacePointT<T>& point) noexcept {
    return texture_coordinates(moving.shape, hit, point);
}

/// Refuses a way that is not finite, and what the shape refuses.
/// \param moving  The shape.
/// \throws std::invalid_argument  with the name and the value.
template <typename S>
void check(const Moving<S>& moving) {
    check(moving.shape);
    require_finite("moving.way", moving.way);
}
/// \}

/// \}

} // namespace ljus
