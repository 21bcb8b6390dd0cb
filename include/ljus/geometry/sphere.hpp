#pragma once

/// \file ljus/geometry/sphere.hpp
/// \brief The sphere |X - C|^2 = R^2.

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sampling.hpp"

namespace ljus {

/// \defgroup sphere Spheres
/// \brief Sections 3.1.2 and 3.1.4 of the report: the sphere, and the ray-sphere
/// intersection. Chapter: \ref ch_sphere.
/// \{

/// All points at distance `radius` from `center`.
/// \report{Definition 3.2, Eq. (3)}
// [sphere]
template <std::floating_point T>
struct SphereT {
    Vec3T<T> center{T(0)}; ///< The centre C, in scene units.
    T radius = T(1);       ///< The radius R, above 0, in scene units.
};
using Sphere = SphereT<float>; ///< SphereT in float.
// [sphere]

/// The segment of a line inside a sphere, in units of the direction's length.
template <std::floating_point T>
struct ChordT {
    T enter = T(0); ///< The t at which the line enters the sphere.
    T leave = T(0); ///< The t at which the line leaves the sphere.
};

/// Both distances at which the infinite line of a ray meets a sphere.
///
/// The line O + tD meets the sphere of centre C and radius R where
/// \f[ t^2\,(D \cdot D) + 2t\,D \cdot (O - C) + |O - C|^2 - R^2 = 0. \f]
/// The discriminant is computed as \f$ R^2 - |P|^2 \f$, where P is the vector from C to
/// the nearest point of the line. This form is accurate even for a small, distant
/// sphere. The root closer to 0 is computed from the other one \cite haines2019.
/// \tparam Compute  The precision of the arithmetic; by default that of the data. All
///                  lengths, and their products with the length of the direction, must
///                  be between 1e-18 and 1e18 in float, and between 1e-150 and 1e150 in
///                  double.
/// \return Both roots, finite, in the precision of the arithmetic. Nothing for a miss,
///         a NaN, an infinity, a zero direction, a radius not above 0, or a length
///         whose square overflows.
/// \cost One square root and two divisions; one division for a miss.
/// \report{Section 3.1.4, Eqs. (2) and (3)}
// [chord]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ChordT<ComputeT<Compute, T>>>
chord(const RayT<T>& ray, const SphereT<T>& sphere) noexcept {
    using C = ComputeT<Compute, T>;
    const Vec3T<C> d{ray.direction};
    const Vec3T<C> oc = Vec3T<C>{ray.origin} - Vec3T<C>{sphere.center};
    const C r{sphere.radius};
    const C a = glm::dot(d, d);
    const C b = -glm::dot(oc, d);
    const C inverse_a = C(1) / a;
    // [chord]
    // [chord ends]
    // From the centre to the nearest point of the line.
    const Vec3T<C> p = oc + (b * inverse_a) * d;
    const C discriminant = r * r - glm::dot(p, p);
    // False for NaN and for a radius of 0 or less.
    if (!(C(0) <= discriminant && r > C(0))) return std::nullopt;

    // The root of larger magnitude is computed first. The other root is c/q (Vieta).
    const C q = b + std::copysign(std::sqrt(a * discriminant), b);
    const C c = glm::dot(oc, oc) - r * r;
    const C large = q * inverse_a;
    const C small = q != C(0) ? c / q : C(0); // 0/0 if the line is tangent
    // False for infinity and NaN.
    constexpr C max = std::numeric_limits<C>::max();
    if (!(std::abs(large) <= max && std::abs(small) <= max)) return std::nullopt;
    // Sorted by value, because rounding may swap two nearly equal roots.
    return ChordT<C>{.enter = glm::min(small, large), .leave = glm::max(small, large)};
}
// [chord ends]

/// The distance at which a ray first hits a sphere, from outside or inside.
/// \tparam Compute  The precision of the arithmetic, as for chord(); t is rounded to T
///                  once.
/// \return The smallest t of a hit, in units of the direction's length. Nothing for a
///         miss.
/// \cost That of chord().
/// \report{Section 3.1.4, Eqs. (2) and (3)}
// [intersect]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<T> intersect(const RayT<T>& ray,
                                         const SphereT<T>& sphere) noexcept {
    const auto hits = chord<Compute>(ray, sphere);
    if (!hits) return std::nullopt;
    // t_max may be infinite, but a hit is finite.
    const T t_max = glm::min(ray.t_max, std::numeric_limits<T>::max());
    const T enter = static_cast<T>(hits->enter);
    if (ray.t_min <= enter && enter <= t_max) return enter;
    const T leave = static_cast<T>(hits->leave);
    if (ray.t_min <= leave && leave <= t_max) return leave;
    return std::nullopt;
}
// [intersect]

/// The report's formula, term by term, for comparison. The ray is O + tD with a
/// direction of unit length, and the sphere has the centre C and the radius R.
/// \f[ t = -\frac{u}{2} \pm \sqrt{\frac{u^2}{4} - v},\quad
///     u = 2\,D \cdot (O - C),\quad v = |O - C|^2 - R^2 \f]
///
/// If the sphere is far away, \f$ u^2/4 \f$ and \f$ v \f$ are large and nearly equal,
/// and rounding destroys their difference.
/// \tparam Compute  The precision of the arithmetic; t is rounded to T once.
/// \return As intersect(), except for rounding. A direction of another length gives a
///         wrong result.
/// \cost One square root, no division.
/// \report{Section 3.1.4}
// [as_printed]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<T> intersect_as_printed(const RayT<T>& ray,
                                                    const SphereT<T>& sphere) {
    using C = ComputeT<Compute, T>;
    const Vec3T<C> oc = Vec3T<C>{ray.origin} - Vec3T<C>{sphere.center};
    const C r{sphere.radius};
    const C u = C(2) * glm::dot(Vec3T<C>{ray.direction}, oc);
    const C v = glm::dot(oc, oc) - r * r;
    const C discriminant = u * u / C(4) - v;
    if (!(discriminant >= C(0))) return std::nullopt;
    const C root = std::sqrt(discriminant);
    for (const C t : {-u / C(2) - root, -u / C(2) + root})
        if (C(ray.t_min) <= t && t <= C(ray.t_max)) return static_cast<T>(t);
    return std::nullopt;
}
// [as_printed]

/// The outward unit normal of a sphere at a point near the sphere, except the centre.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> normal(const SphereT<T>& sphere,
                              const Vec3T<T>& point) noexcept {
    return glm::normalize(point - sphere.center);
}
/// A compile-time error for mixed precisions.
template <std::floating_point T, std::floating_point Other>
requires(!std::same_as<T, Other>) Vec3T<T> normal(const SphereT<T>&,
                                                  const Vec3T<Other>&) {
    static_assert(sizeof(T) == 0, "The sphere and the point have two precisions.");
    return {};
}

/// The area of a sphere, \f$ 4 \pi R^2 \f$, in squared scene units.
template <std::floating_point T>
[[nodiscard]] constexpr T area(const SphereT<T>& sphere) noexcept {
    return T(4) * std::numbers::pi_v<T> * sphere.radius * sphere.radius;
}

/// The point of a sphere that a ray O + tD hit, projected onto the sphere.
///
/// The vector from the centre C to the point is computed as (O - C) + tD, which is
/// accurate even far from the scene's origin. If rounding leaves nothing of that
/// vector, for a small, distant sphere, the normal faces the ray.
// [surface_point]
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const SphereT<T>& sphere,
                                             const RayT<T>& ray,
                                             const ShapeHitT<T>& hit) noexcept {
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

/// Samples a point of a sphere uniformly, with the density 1 / area per squared scene
/// unit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const SphereT<T>& sphere,
                                           const Vec2T<T>& u) noexcept {
    const Vec3T<T> n = sample_uniform_sphere(u);
    const Vec3T<T> sizes = detail::sizes(sphere.center) + sphere.radius;
    return {.position = sphere.center + sphere.radius * n,
            .error = detail::rounding_bound<T>(5) * sizes,
            .normal = n};
}

namespace detail {

/// A cone of directions.
template <std::floating_point T>
struct ConeT {
    Vec3T<T> axis{T(0), T(0), T(1)}; ///< The axis, a unit vector.
    T one_minus_cos = T(2); ///< 1 - cos of the half angle; 2 for all directions.
};

/// The cone of directions from an observer to a sphere. It contains all directions if
/// the observer is inside.
template <std::floating_point T>
[[nodiscard]] ConeT<T> cone_towards(const SphereT<T>& sphere,
                                    const Vec3T<T>& from) noexcept {
    const Vec3T<T> way = sphere.center - from;
    const T sin2 = sphere.radius * sphere.radius / glm::dot(way, way);
    if (!(sin2 < T(1))) return {};
    return {.axis = glm::normalize(way), .one_minus_cos = one_minus_cosine(sin2)};
}

/// Whether an observer is outside a sphere by more than the rounding error, so that the
/// cone of directions to the sphere can be sampled.
template <std::floating_point T>
[[nodiscard]] bool sees_cone(const SphereT<T>& sphere, const Vec3T<T>& from) noexcept {
    const T doubt = T(8) * std::numeric_limits<T>::epsilon() *
                    (max_component(glm::abs(sphere.center)) + sphere.radius);
    return glm::distance(sphere.center, from) > sphere.radius + doubt;
}

} // namespace detail

/// Samples a point of the visible side of a sphere, uniformly in solid angle. For an
/// observer inside the sphere, samples a point uniformly over the sphere's area.
/// \return The point and its density per steradian at the observer `from`. The density
///         is 0 if the observer is at the point.
/// \cite shirley1996
template <std::floating_point T>
[[nodiscard]] SeenPointT<T> sample_towards(const SphereT<T>& sphere,
                                           const Vec3T<T>& from,
                                           const Vec2T<T>& u) noexcept {
    if (!detail::sees_cone(sphere, from)) {
        const SurfacePointT<T> point = sample_area(sphere, u);
        return {.point = point,
                .pdf = detail::pdf_from_area(from, point, area(sphere))};
    }
    const detail::ConeT<T> cone = detail::cone_towards(sphere, from);
    const Vec3T<T> local = sample_uniform_cone(u, cone.one_minus_cos);

    // The first point of the sphere in the sampled direction, at the distance t.
    const Vec3T<T> direction = to_world(frame_around(cone.axis), local);
    const T distance = glm::distance(sphere.center, from);
    const T sine2 = local.x * local.x + local.y * local.y;
    const T half_chord2 = sphere.radius * sphere.radius - distance * distance * sine2;
    const T t = distance * local.z - std::sqrt(glm::max(T(0), half_chord2));
    const RayT<T> ray{.origin = from, .direction = direction};
    return {.point = surface_point(sphere, ray, {.t = t}),
            .pdf = pdf_uniform_cone(cone.one_minus_cos)};
}

/// The density of sample_towards() at a point of a sphere, per steradian at `from`.
template <std::floating_point T>
[[nodiscard]] T pdf_towards(const SphereT<T>& sphere, const Vec3T<T>& from,
                            const SurfacePointT<T>& point) noexcept {
    if (!detail::sees_cone(sphere, from))
        return detail::pdf_from_area(from, point, area(sphere));
    return pdf_uniform_cone(detail::cone_towards(sphere, from).one_minus_cos);
}

/// The u for which sample_towards() returns the point nearest to the observer: (0, 0).
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> center_sample(const SphereT<T>& /*sphere*/) noexcept {
    return Vec2T<T>{T(0)};
}

/// The form factor, in [0, 1], from a point to a sphere: the cosine-weighted fraction
/// of the point's hemisphere that the sphere fills.
/// \param from        The point.
/// \param normal      Unit normal of the surface at the point.
/// \param lamp        The sphere, which emits on its outside.
/// \param inside_out  True if the sphere emits on its inside instead.
/// \return Nothing if the horizon cuts the sphere, if the point lies inside the sphere,
///         or if the inside emits.
template <std::floating_point T>
[[nodiscard]] std::optional<T>
form_factor_from(const Vec3T<T>& from, const Vec3T<T>& normal, const SphereT<T>& lamp,
                 bool inside_out) noexcept {
    const Vec3T<T> way = lamp.center - from;
    const T distance = glm::length(way), height = glm::dot(way, normal);
    if (inside_out || !(distance > lamp.radius)) return std::nullopt;
    if (height <= -lamp.radius) return T(0);
    if (height < lamp.radius) return std::nullopt;
    const T sine = lamp.radius / distance;
    return sine * sine * (height / distance);
}

/// The bounding sphere of a sphere: itself.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const SphereT<T>& sphere) noexcept {
    return sphere;
}

/// A box that contains a sphere despite rounding, a few units in the last place too
/// large.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const SphereT<T>& sphere) noexcept {
    const Vec3T<T> size =
        detail::rounding_bound<T>(3) * (detail::sizes(sphere.center)) +
        (T(1) + detail::rounding_bound<T>(3)) * Vec3T<T>{sphere.radius} +
        std::numeric_limits<T>::min();
    return {sphere.center - size, sphere.center + size};
}

/// A sphere displaced by a vector, in scene units.
template <std::floating_point T>
[[nodiscard]] constexpr SphereT<T> translated(SphereT<T> shape,
                                              const Vec3T<T>& by) noexcept {
    shape.center += by;
    return shape;
}

/// The texture coordinates of a point of a sphere: longitude and latitude, as in
/// globe_coordinates().
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const SphereT<T>& /*sphere*/,
                                           const ShapeHitT<T>& /*hit*/,
                                           const SurfacePointT<T>& point) noexcept {
    return globe_coordinates(point.normal);
}

/// Refuses a sphere unless its centre is finite, and its radius is finite and above 0.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T>
void check(const SphereT<T>& sphere) {
    require_finite("sphere.center", sphere.center);
    require_positive("sphere.radius", sphere.radius);
}

/// \}

} // namespace ljus
