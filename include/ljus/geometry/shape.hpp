#pragma once

/// \file ljus/geometry/shape.hpp
/// \brief What every shape can do, and the shapes of the library together.

#include <array>
#include <numbers>
#include <string>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/hook.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sampling.hpp"

namespace ljus {

/// \defgroup shape Shapes
/// \brief What a scene asks of a shape.
///
/// A new shape needs what the concept Shape lists: intersect(), surface_point(),
/// bounding_sphere() and check(). What it may have as well, what that is for, and what
/// happens without it:
///
/// \snippet{lineno} ljus/geometry/shape.hpp shape hooks
///
/// The survey prints which of these each shape of a scene has. Two more are for
/// radiosity alone, patch_grid(shape, size) and facet_of(): a shape without them is
/// left out, and Patches::left_out says so.
/// \{

/// Where a ray meets any shape; a sphere has no use for u and v.
template <std::floating_point T>
[[nodiscard]] constexpr FlatHitT<T> as_hit(T t) noexcept {
    return {.t = t};
}

/// The hit of a flat shape, as it is.
template <std::floating_point T>
[[nodiscard]] constexpr FlatHitT<T> as_hit(const FlatHitT<T>& hit) noexcept {
    return hit;
}

/// The point of a sphere that a ray hit: O + tD, put back onto the sphere. The way from
/// the centre is summed without the centre's own place, which far from the origin would
/// round it away; what is left of a sphere too small and far for t faces the ray.
/// \param sphere  The sphere.
/// \param ray     The ray.
/// \param hit     What intersect() returned.
/// \return Position, its error bound, the outer normal.
// [surface_point]
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const SphereT<T>& sphere,
                                             const RayT<T>& ray,
                                             const FlatHitT<T>& hit) noexcept {
    Vec3T<WideT<T>> way{(ray.origin - sphere.center) + hit.t * ray.direction};
    if (way == Vec3T<WideT<T>>{0}) way = -Vec3T<WideT<T>>{ray.direction};
    const Vec3T<T> n{glm::normalize(way)};
    const Vec3T<T> offset = sphere.radius * n;
    return {.position = sphere.center + offset,
            .error = detail::rounding_bound<T>(5) *
                     (detail::sizes(sphere.center) + detail::sizes(offset)),
            .normal = n};
}
// [surface_point]

/// The point of a flat shape that a ray hit, from its coordinates u and v.
/// \param shape  A triangle or a quad.
/// \param hit    What intersect() returned.
/// \return Position, its error bound, the normal.
template <typename Flat, std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const Flat& shape, const RayT<T>&,
                                             const FlatHitT<T>& hit) noexcept {
    return point_at(shape, hit.u, hit.v);
}

/// A point of a sphere, uniform over its area.
/// \param sphere  The sphere.
/// \param u       Point of the unit square.
/// \return The point; density 1 / area per squared scene unit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const SphereT<T>& sphere,
                                           const Vec2T<T>& u) noexcept {
    const Vec3T<T> n = sample_uniform_sphere(u);
    const Vec3T<T> sizes = detail::sizes(sphere.center) + sphere.radius;
    return {.position = sphere.center + sphere.radius * n,
            .error = detail::rounding_bound<T>(5) * sizes,
            .normal = n};
}

/// \name Bounding spheres
/// \{

/// A sphere around the shape, not always the smallest. Photons are aimed at it.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const SphereT<T>& sphere) noexcept {
    return sphere;
}
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const TriangleT<T>& triangle) noexcept {
    const Vec3T<T> center = (triangle.v1 + triangle.v2 + triangle.v3) / T(3);
    return {.center = center,
            .radius = max_component(Vec3T<T>{glm::distance(center, triangle.v1),
                                             glm::distance(center, triangle.v2),
                                             glm::distance(center, triangle.v3)})};
}
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const QuadT<T>& quad) noexcept {
    return {.center = quad.corner + (quad.edge_u + quad.edge_v) / T(2),
            .radius = glm::max(glm::length(quad.edge_u + quad.edge_v),
                               glm::length(quad.edge_u - quad.edge_v)) /
                      T(2)};
}
/// \}

/// \name Checks
/// \{

/// Refuses data that no picture can be made of, with a sentence.
/// \throws std::invalid_argument  with the name and the value.
template <std::floating_point T>
void check(const SphereT<T>& sphere) {
    require_finite("sphere.center", sphere.center);
    require_positive("sphere.radius", sphere.radius);
}
template <std::floating_point T>
void check(const TriangleT<T>& triangle) {
    require_finite("triangle.v1", triangle.v1);
    require_finite("triangle.v2", triangle.v2);
    require_finite("triangle.v3", triangle.v3);
}
template <std::floating_point T>
void check(const QuadT<T>& quad) {
    require_finite("quad.corner", quad.corner);
    require_finite("quad.edge_u", quad.edge_u);
    require_finite("quad.edge_v", quad.edge_v);
}
/// \}

/// The precision of a shape's data.
template <typename S>
using ScalarOf = decltype(bounding_sphere(std::declval<const S&>()).radius);

/// What has bounds; asked first, so that the message for what is no shape is short.
template <typename S>
concept HasBounds = !detail::is_stand_in<S> && requires(const S& shape) {
    bounding_sphere(shape);
};

namespace detail {

/// Whether a type of shape lies in a plane: it fills little of its bounding sphere and
/// no ray meets it twice, so that photons are aimed at points of its area.
template <typename S>
inline constexpr bool is_flat = false;

/// A triangle is flat.
template <std::floating_point T>
inline constexpr bool is_flat<TriangleT<T>> = true;
/// A quad is flat.
template <std::floating_point T>
inline constexpr bool is_flat<QuadT<T>> = true;

/// Whether a shape has one normal(), and does not work it out again if it is told it.
template <typename S>
inline constexpr bool is_plane = requires(const S& shape, Vec2T<ScalarOf<S>> u) {
    point_at(shape, u.x, u.y, normal(shape));
    sample_area(shape, u, normal(shape));
};

} // namespace detail

/// What a scene asks of a shape.
template <typename S>
concept Shape = HasBounds<S> &&
    requires(const S& shape, RayT<ScalarOf<S>> ray, FlatHitT<ScalarOf<S>> hit) {
    as_hit(*intersect(ray, shape));
    { surface_point(shape, ray, hit) } -> std::same_as<SurfacePointT<ScalarOf<S>>>;
    { bounding_sphere(shape) } -> std::same_as<SphereT<ScalarOf<S>>>;
    check(shape);
};

/// Whether the area of a shape is known. One without, such as metaballs, can be lit but
/// cannot be a light.
template <typename S>
concept HasArea = requires(const S& shape) {
    { area(shape) } -> std::same_as<ScalarOf<S>>;
};

/// What a shape needs besides to be a light: points chosen evenly over its area.
template <typename S>
concept Samplable = Shape<S> && HasArea<S> &&
    requires(const S& shape, Vec2T<ScalarOf<S>> u) {
    { sample_area(shape, u) } -> std::same_as<SurfacePointT<ScalarOf<S>>>;
};

/// A shape without an area has no points to choose. A scene refuses it as a light, so
/// that none is ever asked for.
/// \return A point of no use.
template <Shape S>
requires(!HasArea<S>) [[nodiscard]] SurfacePointT<ScalarOf<S>> sample_area(
    const S&, const Vec2T<ScalarOf<S>>&) noexcept {
    return {};
}

namespace detail {

/// The hooks of a type of shape.
template <Shape S>
[[nodiscard]] constexpr auto shape_hooks() noexcept {
    using T = ScalarOf<S>;
    using V = Vec3T<T>;
    using H = FlatHitT<T>;
    using P = SurfacePointT<T>;
    using O = Own<S>;
    // clang-format off
    return std::array{
        // [shape hooks]
        Hook{"bounds", "a tight box in a tree", "its sphere's box",
             requires(O s) { bounds(s); }},
        Hook{"meets", "faster shadow rays", "intersect()",
             requires(O s, RayT<T> ray) { meets<void>(ray, s); }},
        Hook{"shading_normal", "smooth normals", "the geometric one",
             requires(O s, H hit, V normal) { shading_normal(s, hit, normal); }},
        Hook{"area", "being a light", "refused as a light",
             requires(O s) { area(s); }},
        Hook{"sample_area", "being a light", "refused as a light",
             requires(O s, Vec2T<T> u) { sample_area(s, u); }},
        Hook{"sample_towards", "a lamp's solid angle", "points of its area",
             requires(O s, V from, Vec2T<T> u) { sample_towards(s, from, u); }},
        Hook{"pdf_towards", "a lamp's solid angle", "points of its area",
             requires(O s, V from, P point) { pdf_towards(s, from, point); }},
        Hook{"center_sample", "the centre of a lamp", "u = v = 1/2",
             requires(O s) { center_sample(s); }},
        Hook{"texture_coordinates", "images by (u, v)", "those of the hit",
             requires(O s, H hit, P point) { texture_coordinates(s, hit, point); }},
        Hook{"translated", "Moving", "does not compile",
             requires(O s, V by) { translated(s, by); }},
        Hook{"is_flat", "photons aimed at its area", "at its sphere", is_flat<S>},
        // [shape hooks]
    };
// clang-format on
}

} // namespace detail

/// \}

} // namespace ljus
