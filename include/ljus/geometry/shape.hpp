#pragma once

/// \file ljus/geometry/shape.hpp
/// \brief What every shape can do, and the simple shapes of the library together.

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
/// \brief What a scene asks of a shape.
///
/// A new shape needs what the concept Shape lists: intersect(), surface_point(),
/// bounding_sphere() and check(). What it may have as well, what that is for, and what
/// happens without it:
///
/// \snippet{lineno} ljus/geometry/shape.hpp shape hooks
///
/// The survey prints which of these each shape of a scene has. The functions stand
/// beside the shape, in its own header and namespace, where a call finds them by their
/// argument.
/// \{

/// A hit of any shape, of what intersect() returned: a sphere has no u and v.
template <std::floating_point T>
[[nodiscard]] constexpr FlatHitT<T> as_hit(T t) noexcept {
    return {.t = t};
}

/// The hit of a flat shape, as it is.
template <std::floating_point T>
[[nodiscard]] constexpr FlatHitT<T> as_hit(const FlatHitT<T>& hit) noexcept {
    return hit;
}

/// The precision of a shape's data.
template <typename S>
using ScalarOf = decltype(bounding_sphere(std::declval<const S&>()).radius);

/// What has a bounding sphere; asked first, so that the message for what is no shape is
/// short.
template <typename S>
concept HasBoundingSphere = !detail::is_stand_in<S> && requires(const S& shape) {
    bounding_sphere(shape);
};

/// What a scene asks of a shape.
template <typename S>
concept Shape = HasBoundingSphere<S> &&
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

/// A shape that lies in a plane and says so by having one normal, `normal(shape)`. It
/// fills little of its bounding sphere, and no ray meets it twice, so photons are aimed
/// at points of its area.
template <typename S>
concept FlatShape = Samplable<S> && requires(const S& shape) {
    { normal(shape) } -> std::same_as<Vec3T<ScalarOf<S>>>;
};

namespace detail {

/// Whether a flat shape takes its normal() as an argument instead of computing it
/// again. Then the normal is computed once, when a scene is made.
template <typename S>
inline constexpr bool is_plane = requires(const S& shape, Vec2T<ScalarOf<S>> u) {
    requires FlatShape<S>;
    point_at(shape, u.x, u.y, normal(shape));
    sample_area(shape, u, normal(shape));
};

} // namespace detail

/// \name What any shape can do
/// Used for a shape that has no such function of its own.
/// \{

/// A shape without an area has no points to choose. A scene refuses it as a light, so
/// that none is ever asked for.
/// \return A point of no use.
template <Shape S>
requires(!HasArea<S>) [[nodiscard]] SurfacePointT<ScalarOf<S>> sample_area(
    const S&, const Vec2T<ScalarOf<S>>&) noexcept {
    return {};
}

/// A point of any shape, uniform over its area.
/// \param shape  The shape.
/// \param from   The observer.
/// \param u      Point of the unit square.
/// \return The point and its density per steradian of the observer: 0 for a shape
///         without an area, which is no light, and where the observer is that point.
template <Shape S, std::floating_point T>
[[nodiscard]] SeenPointT<T> sample_towards(const S& shape, const Vec3T<T>& from,
                                           const Vec2T<T>& u) noexcept {
    if constexpr (HasArea<S>) {
        const SurfacePointT<T> point = sample_area(shape, u);
        return {.point = point, .pdf = detail::pdf_from_area(from, point, area(shape))};
    } else
        return {};
}

/// The density of sample_towards() at a point of the shape.
/// \param shape  The shape.
/// \param from   The observer.
/// \param point  The point of the shape in question.
/// \return Per steradian; 0 for a shape without an area.
template <Shape S, std::floating_point T>
[[nodiscard]] T pdf_towards(const S& shape, const Vec3T<T>& from,
                            const SurfacePointT<T>& point) noexcept {
    if constexpr (HasArea<S>)
        return detail::pdf_from_area(from, point, area(shape));
    else
        return T(0);
}

/// The point of the unit square whose sample, by sample_towards(), stands for the whole
/// lamp: the middle of a quad.
/// \return (1/2, 1/2).
template <Shape Lamp>
[[nodiscard]] auto center_sample(const Lamp&) noexcept {
    return Vec2T<ScalarOf<Lamp>>{ScalarOf<Lamp>(0.5)};
}

/// The texture coordinates of a hit: those that intersect() found.
/// \param hit  What intersect() returned.
/// \return (u, v), without a unit; see the group \ref texture_coordinates.
template <Shape S, std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const S& /*shape*/, const FlatHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    return {hit.u, hit.v};
}

/// The form factor from a point to a shape that has a facet_of(): the share of the
/// hemisphere over the point that it fills, weighted by the cosine, in closed form.
/// \param from        The point.
/// \param normal      Unit, of the surface at the point.
/// \param lamp        It counts from the side that its normal points to.
/// \param inside_out  From the other side.
/// \return In [0, 1]: the irradiance over pi times the lamp's radiance.
template <Shape Flat, std::floating_point T>
[[nodiscard]] auto form_factor_from(const Vec3T<T>& from, const Vec3T<T>& normal,
                                    const Flat& lamp, bool inside_out) noexcept
    -> decltype(facet_of(lamp), std::optional<T>{}) {
    const Facet facet = facet_of(lamp);
    return static_cast<T>(form_factor_at(glm::dvec3(from), glm::dvec3(normal),
                                         inside_out ? detail::turned(facet) : facet));
}
/// \}

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
        Hook{"translated", "Moving", "does not compile",
             requires(O s, V by) { translated(s, by); }},
        // [shape hooks]
    };
// clang-format on
}

} // namespace detail

/// \}

/// \defgroup texture_coordinates Texture coordinates
/// \brief Where a shape was hit, in its own terms: what a UvMap looks up by.
///
/// | shape           | (u, v)                                                     |
/// |-----------------|------------------------------------------------------------|
/// | quad            | along its two edges, from its corner: [0, 1] x [0, 1]      |
/// | triangle        | along its two edges, from its first vertex: u + v <= 1     |
/// | sphere          | longitude and latitude, as a GlobeMap at its centre has it |
/// | mesh            | of its vertices, interpolated; without any, the triangle's |
/// | moving shape    | the shape's                                                |
/// | any other shape | the u and v of its hit; (0, 0) if it has none              |

} // namespace ljus
