#pragma once

/// \file ljus/geometry/shape.hpp
/// \brief The interface of a shape, and its defaults.

#include <array>
#include <concepts>
#include <optional>
#include <utility>

#include "ljus/geometry/facet.hpp"
#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/hook.hpp"

namespace ljus {

/// \defgroup shape Shapes
/// \brief The functions that a scene requires of a shape.
///
/// A shape needs the functions of the concept Shape: intersect(), surface_point(),
/// bounding_sphere() and check(). The table lists its optional functions. A row has the
/// name of a function, its purpose, and what happens without it:
///
/// \snippet{lineno} ljus/geometry/shape.hpp shape hooks
///
/// survey() prints which of these functions each shape of a scene has. The functions
/// belong in the shape's own namespace, where argument-dependent lookup finds them.
/// \{

/// The hit for a shape whose intersect() returns a distance.
template <std::floating_point T>
[[nodiscard]] constexpr ShapeHitT<T> as_hit(T t) noexcept {
    return {.t = t};
}

/// The hit for a shape whose intersect() returns a hit.
template <std::floating_point T>
[[nodiscard]] constexpr ShapeHitT<T> as_hit(const ShapeHitT<T>& hit) noexcept {
    return hit;
}

/// The precision of a shape's data.
template <typename S>
using ScalarOf = decltype(bounding_sphere(std::declval<const S&>()).radius);

/// Whether a type has a bounding sphere. The concept Shape tests this first, for a
/// short message about a type that is not a shape.
template <typename S>
concept HasBoundingSphere = !detail::is_stand_in<S> && requires(const S& shape) {
    bounding_sphere(shape);
};

/// The functions that every shape needs.
template <typename S>
concept Shape = HasBoundingSphere<S> &&
    requires(const S& shape, RayT<ScalarOf<S>> ray, ShapeHitT<ScalarOf<S>> hit) {
    as_hit(*intersect(ray, shape));
    { surface_point(shape, ray, hit) } -> std::same_as<SurfacePointT<ScalarOf<S>>>;
    { bounding_sphere(shape) } -> std::same_as<SphereT<ScalarOf<S>>>;
    check(shape);
};

/// Whether a shape has the function area(). A shape without area(), such as metaballs,
/// cannot be a light.
template <typename S>
concept HasArea = requires(const S& shape) {
    { area(shape) } -> std::same_as<ScalarOf<S>>;
};

/// A shape that can be a light: its area can be sampled uniformly.
template <typename S>
concept Samplable = Shape<S> && HasArea<S> &&
    requires(const S& shape, Vec2T<ScalarOf<S>> u) {
    { sample_area(shape, u) } -> std::same_as<SurfacePointT<ScalarOf<S>>>;
};

/// A shape that can have a normal map. `texture_tangents(shape, hit)` returns two
/// vectors of any length, along the derivatives of the point with respect to the
/// texture coordinates u and v. A vector is 0 where there is no derivative.
template <typename S>
concept HasTangents = requires(const S& shape, const ShapeHitT<ScalarOf<S>>& hit) {
    { texture_tangents(shape, hit) } -> std::same_as<std::array<Vec3T<ScalarOf<S>>, 2>>;
};

/// A flat shape, with a single normal, `normal(shape)`. Photons are aimed at points of
/// its area, because it fills little of its bounding sphere.
template <typename S>
concept FlatShape = Samplable<S> && requires(const S& shape) {
    { normal(shape) } -> std::same_as<Vec3T<ScalarOf<S>>>;
};

namespace detail {

/// Whether point_at() and sample_area() of a flat shape accept the result of normal().
/// If so, normal() is called only once per shape, when the World is made.
template <typename S>
inline constexpr bool is_plane = requires(const S& shape, Vec2T<ScalarOf<S>> u) {
    requires FlatShape<S>;
    point_at(shape, u.x, u.y, normal(shape));
    sample_area(shape, u, normal(shape));
};

} // namespace detail

/// \name Defaults
/// A shape's own function of the same name takes precedence.
/// \{

/// Lets the code for lights compile for a shape without area(), which a scene refuses
/// as a light.
template <Shape S>
requires(!HasArea<S>) [[nodiscard]] SurfacePointT<ScalarOf<S>> sample_area(
    const S&, const Vec2T<ScalarOf<S>>&) noexcept {
    return {};
}

/// Samples a point of any shape, uniformly over its area.
/// \return The point and its density per steradian at the observer `from`; 0 for a
///         shape without area(), and if the observer is at the point.
template <Shape S, std::floating_point T>
[[nodiscard]] SeenPointT<T> sample_towards(const S& shape, const Vec3T<T>& from,
                                           const Vec2T<T>& u) noexcept {
    if constexpr (HasArea<S>) {
        const SurfacePointT<T> point = sample_area(shape, u);
        return {.point = point, .pdf = detail::pdf_from_area(from, point, area(shape))};
    } else
        return {};
}

/// The density of sample_towards() at a point of the shape, per steradian at `from`.
template <Shape S, std::floating_point T>
[[nodiscard]] T pdf_towards(const S& shape, const Vec3T<T>& from,
                            const SurfacePointT<T>& point) noexcept {
    if constexpr (HasArea<S>)
        return detail::pdf_from_area(from, point, area(shape));
    else
        return T(0);
}

/// The point u of the unit square for which sample_towards() returns the point of a
/// lamp at which a single shadow ray is aimed: (1/2, 1/2), the centre of a quad or a
/// disc.
template <Shape Lamp>
[[nodiscard]] auto center_sample(const Lamp&) noexcept {
    return Vec2T<ScalarOf<Lamp>>{ScalarOf<Lamp>(0.5)};
}

/// The texture coordinates of a hit: its u and v. See \ref texture_coordinates.
template <Shape S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const S& /*shape*/, const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    return {hit.u, hit.v};
}

/// The form factor, in [0, 1], from a point to a shape that has facet_of(): the
/// cosine-weighted fraction of the point's hemisphere that the shape fills. The
/// irradiance at the point is pi times the form factor times the radiance of the lamp.
/// \param from        The point.
/// \param normal      Unit normal of the surface at the point.
/// \param lamp        The shape, which emits on the side of its normal.
/// \param inside_out  True if the shape emits on the other side instead.
template <Shape Flat, std::floating_point T>
[[nodiscard]] auto form_factor_from(const Vec3T<T>& from, const Vec3T<T>& normal,
                                    const Flat& lamp, bool inside_out) noexcept
    -> decltype(facet_of(lamp), std::optional<T>{}) {
    Facet facet = facet_of(lamp);
    if (inside_out) facet = detail::turned(facet); // otherwise without a copy
    return static_cast<T>(
        detail::form_factor_fast(glm::dvec3(from), glm::dvec3(normal), facet));
}
/// \}

namespace detail {

template <Shape S>
[[nodiscard]] constexpr auto shape_hooks() noexcept {
    using T = ScalarOf<S>;
    using V = Vec3T<T>;
    using H = ShapeHitT<T>;
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
             requires(O s, H hit, V n) { shading_normal(s, hit, n); }},
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
        Hook{"normal", "photons aimed at its area", "at its sphere",
             requires(O s) { normal(s); }},
        Hook{"point_at", "normal() computed once", "at each point",
             requires(O s, T u, Vec2T<T> uv, V n) {
                 point_at(s, u, u, n);
                 sample_area(s, uv, n);
             }},
        Hook{"form_factor_from", "a lamp's light without noise", "by facet_of()",
             requires(O s, V from) { form_factor_from(from, from, s, false); }},
        Hook{"facet_of", "form factors of a polygon", "by rays",
             requires(O s) { facet_of(s); }},
        Hook{"patch_grid", "radiosity", "left out of it",
             requires(O s) { patch_grid(s, 1.0); }},
        Hook{"corners_of", "irradiance up to its edges", "darker at them",
             requires(O s) { corners_of(s); }},
        Hook{"texture_coordinates", "images by (u, v)", "those of the hit",
             requires(O s, H hit, P point) { texture_coordinates(s, hit, point); }},
        Hook{"texture_tangents", "normal maps", "refused with one",
             requires(O s, H hit) { texture_tangents(s, hit); }},
        Hook{"translated", "Moving", "does not compile",
             requires(O s, V by) { translated(s, by); }},
        Hook{"area_sums", "a lamp's areas, summed once", "by sample_area()",
             requires(O s) { area_sums(s); }},
        Hook{"prototype", "a mesh that its scene keeps", "it has all its data",
             requires(O s) { prototype(s); }},
        // [shape hooks]
    };
// clang-format on
}

} // namespace detail

/// \}

/// \defgroup texture_coordinates Texture coordinates
/// \brief The coordinates (u, v) of a point on its own shape, for textures with a
/// UvMap.
///
/// | shape           | (u, v)                                                     |
/// |-----------------|------------------------------------------------------------|
/// | quad            | along its two edges, from its corner: [0, 1] x [0, 1]      |
/// | triangle        | along its two edges, from its first vertex: u + v <= 1     |
/// | sphere          | longitude and latitude, as in a GlobeMap at its centre     |
/// | disc            | the disc fills the circle in the unit square               |
/// | cylinder        | around its axis, and along it: [0, 1] x [0, 1]             |
/// | mesh | interpolated between its vertices, or as for a triangle |
/// | moving shape    | those of its shape                                         |
/// | instance        | those of its mesh                                          |
/// | any other shape | u and v of the hit; (0, 0) if it has none                  |

} // namespace ljus
