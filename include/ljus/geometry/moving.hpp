#pragma once

/// \file ljus/geometry/moving.hpp
/// \brief A shape that moves while the shutter is open.

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/shape.hpp"

namespace ljus {

/// \defgroup moving Moving shapes
/// \brief Section 2.1 of the report, distributed rays: motion blur. Chapter:
/// \ref ch_distributed_rays.
/// \{

/// A shape with the function `translated(shape, by)`, which is called for each ray.
template <typename S>
concept Movable = Shape<S> && requires(const S& shape, const Vec3T<ScalarOf<S>>& by) {
    { translated(shape, by) } -> std::same_as<S>;
};

/// A shape in linear motion. A ray sees the shape at the ray's time.
/// \tparam S  A sphere, a triangle, a quad, a disc, a cylinder or an instance of a
///            mesh.
// [moving]
template <Movable S>
struct Moving {
    S shape{}; ///< The shape at time 0.
    /// The displacement from time 0 to time 1, in scene units.
    Vec3T<ScalarOf<S>> displacement{0};
};
// [moving]

namespace detail {

template <typename S>
inline constexpr bool is_moving = false;

template <typename S>
inline constexpr bool is_moving<Moving<S>> = true;

} // namespace detail

/// The shape at a time in [0, 1].
// [at_time]
template <typename S, std::floating_point T>
[[nodiscard]] S at_time(const Moving<S>& moving, T time) noexcept {
    return translated(moving.shape, time * moving.displacement);
}
// [at_time]

/// The shape itself, if it does not move.
template <typename S, std::floating_point T>
requires(!detail::is_moving<S>)
    [[nodiscard]] constexpr const S& at_time(const S& shape, T) noexcept {
    return shape;
}

/// \name As a shape
/// \{

/// Intersects a ray with the shape at the ray's time. Compute selects the arithmetic,
/// if the shape offers a choice.
template <typename Compute = void, std::floating_point T, typename S>
[[nodiscard]] auto intersect(const RayT<T>& ray, const Moving<S>& moving) noexcept {
    const S now = at_time(moving, ray.time);
    if constexpr (requires { intersect<Compute>(ray, now); })
        return intersect<Compute>(ray, now);
    else
        return intersect(ray, now);
}

/// Whether a ray meets the shape at the ray's time.
template <typename Compute = void, std::floating_point T, typename S>
requires requires(const RayT<T>& ray, const S& shape) {
    meets<Compute>(ray, shape);
}
[[nodiscard]] bool meets(const RayT<T>& ray, const Moving<S>& moving) {
    return meets<Compute>(ray, at_time(moving, ray.time));
}

/// The point that a ray hit, on the shape at the ray's time.
template <typename S, std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const Moving<S>& moving,
                                             const RayT<T>& ray,
                                             const ShapeHitT<T>& hit) noexcept {
    return surface_point(at_time(moving, ray.time), ray, hit);
}

/// The area of the shape, in squared scene units.
template <typename S>
requires HasArea<S>
[[nodiscard]] auto area(const Moving<S>& moving) noexcept {
    return area(moving.shape);
}

/// Samples a point of the shape at time 0, uniformly over its area.
template <typename S, std::floating_point T>
requires Samplable<S>
[[nodiscard]] SurfacePointT<T> sample_area(const Moving<S>& moving,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(moving.shape, u);
}

/// A sphere around all positions of the shape.
template <typename S>
[[nodiscard]] auto bounding_sphere(const Moving<S>& moving) noexcept {
    auto sphere = bounding_sphere(moving.shape);
    using T = decltype(sphere.radius);
    sphere.center += moving.displacement / T(2);
    sphere.radius += T(glm::length(Vec3T<WideT<T>>(moving.displacement)) / 2);
    return sphere;
}

/// A box around all positions of the shape: the union of the boxes at time 0 and at
/// time 1, a few units in the last place too large.
template <typename S>
requires requires(const S& shape) {
    bounds(shape);
}
[[nodiscard]] auto bounds(const Moving<S>& moving) noexcept {
    using T = ScalarOf<S>;
    const BoxT<T> first = bounds(moving.shape), last = bounds(at_time(moving, T(1)));
    const Vec3T<T> rounding = detail::rounding_bound<T>(4) *
                              (glm::max(glm::abs(first.low), glm::abs(first.high)) +
                               glm::abs(moving.displacement));
    const BoxT<T> both = box_union(first, last);
    return BoxT<T>{both.low - rounding, both.high + rounding};
}

/// The texture coordinates of the shape.
template <typename S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const Moving<S>& moving,
                                           const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& point) noexcept {
    return texture_coordinates(moving.shape, hit, point);
}

/// The texture tangents of the shape.
template <HasTangents S, std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 2>
texture_tangents(const Moving<S>& moving, const ShapeHitT<T>& hit) noexcept {
    return texture_tangents(moving.shape, hit);
}

/// The shading normal of the shape.
template <typename S, std::floating_point T>
requires requires(const S& shape, const ShapeHitT<T>& hit, const Vec3T<T>& normal) {
    shading_normal(shape, hit, normal);
}
[[nodiscard]] Vec3T<T> shading_normal(const Moving<S>& moving, const ShapeHitT<T>& hit,
                                      const Vec3T<T>& geometric) noexcept {
    return shading_normal(moving.shape, hit, geometric);
}

/// The u for which sample_towards() returns the centre of the shape.
template <typename S>
[[nodiscard]] auto center_sample(const Moving<S>& moving) noexcept {
    return center_sample(moving.shape);
}

/// The corners of the shape at time 0. Photons on moving shapes are stored for time 0.
template <typename S>
requires requires(const S& shape) {
    corners_of(shape);
}
[[nodiscard]] auto corners_of(const Moving<S>& moving) noexcept {
    return corners_of(moving.shape);
}

/// The sums of areas that a lamp keeps for sample_area(), see area_sums() of the shape.
template <typename S>
requires requires(const S& shape) {
    area_sums(shape);
}
[[nodiscard]] auto area_sums(const Moving<S>& moving) {
    return area_sums(moving.shape);
}

/// The object to which the shape refers, such as the mesh of an instance.
template <typename S>
requires requires(const S& shape) {
    prototype(shape);
}
[[nodiscard]] const auto& prototype(const Moving<S>& moving) noexcept {
    return prototype(moving.shape);
}

/// Refuses a moving shape if its displacement is not finite, or if check() refuses the
/// shape.
/// \throws std::invalid_argument  with the name and the value of the member.
template <typename S>
void check(const Moving<S>& moving) {
    check(moving.shape);
    require_finite("moving.displacement", moving.displacement);
}
/// \}

/// \}

} // namespace ljus
