#pragma once

/// \file ljus/geometry/sphere.hpp
/// \brief The sphere |X - C|^2 = R^2: where a ray meets it, and all else it can do.

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
/// \brief Sections 3.1.2 and 3.1.4: the sphere, and the ray-sphere intersection.
/// Chapter: \ref ch_sphere.
/// \{

/// All points at distance `radius` from `center`.
/// \report{Definition 3.2, Eq. (3)}
// [sphere]
template <std::floating_point T>
struct SphereT {
    Vec3T<T> center{T(0)}; ///< C, in scene units.
    T radius = T(1);       ///< R, above 0, in scene units.
};
using Sphere = SphereT<float>; ///< SphereT in float.
// [sphere]

namespace detail {

/// The part of a line that lies within a ball: where it enters, and where it leaves.
template <std::floating_point T>
struct ChordT {
    T enter = T(0); ///< The smaller root, in units of the direction's length.
    T leave = T(0); ///< The larger root, at least `enter`.
};

/// Both distances at which the whole line of a ray meets a sphere.
///
/// The line O + tD meets the sphere where
/// \f[ t^2\,(D \cdot D) + 2t\,D \cdot (O - C) + |O - C|^2 - R^2 = 0. \f]
/// The discriminant is taken as \f$ R^2 - |P|^2 \f$, P being the way from C to the
/// nearest point of the line, for \f$ b^2 - ac \f$ loses a small, distant sphere; and
/// the second root as \f$ c/q \f$, which does not cancel either \cite haines2019.
///
/// \tparam Compute  The precision of the arithmetic; the data's own if left out.
/// \param ray     Its direction may have any length but zero; t_min, t_max are ignored.
/// \param sphere  The sphere. In float arithmetic all lengths, and their products with
///                that of the direction, lie between 1e-18 and 1e18; in double between
///                1e-150 and 1e150.
/// \return Both roots, finite, in the precision of the arithmetic; nothing for a miss,
///         a NaN, an infinity, a zero direction, a radius not above 0, and for lengths
///         so large that a square is infinite.
/// \cost One square root and two divisions; a miss costs one division.
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
    // From the centre to the point of the line that is nearest to it.
    const Vec3T<C> p = oc + (b * inverse_a) * d;
    const C discriminant = r * r - glm::dot(p, p);
    // Written so that NaN says no; so does a radius of 0 or less.
    if (!(C(0) <= discriminant && r > C(0))) return std::nullopt;

    // The root of larger size first; by Vieta the other one is c/q.
    const C q = b + std::copysign(std::sqrt(a * discriminant), b);
    const C c = glm::dot(oc, oc) - r * r;
    const C large = q * inverse_a;
    const C small = q != C(0) ? c / q : C(0); // 0/0: it only touches
    // Infinity says no, and NaN.
    constexpr C max = std::numeric_limits<C>::max();
    if (!(std::abs(large) <= max && std::abs(small) <= max)) return std::nullopt;
    // By their size, not by q's sign: two roots that are almost one may change places.
    return ChordT<C>{.enter = glm::min(small, large), .leave = glm::max(small, large)};
}
// [chord ends]

} // namespace detail

/// The distance at which a ray first meets a sphere, from outside or from within.
///
/// \tparam Compute  The precision of the arithmetic; t is rounded to T once. With float
///                  data and `double` every decision of the tests is right.
/// \param ray     Hits count within its [t_min, t_max].
/// \param sphere  The sphere. In float arithmetic, lengths between 1e-18 and 1e18.
/// \return The smallest such t, in units of the direction's length; nothing for a miss,
///         and nothing for invalid data, as chord() says.
/// \cost That of chord() and three comparisons.
/// \report{Section 3.1.4, Eqs. (2) and (3)}
// [intersect]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<T> intersect(const RayT<T>& ray,
                                         const SphereT<T>& sphere) noexcept {
    const auto hits = detail::chord<Compute>(ray, sphere);
    if (!hits) return std::nullopt;
    // A ray may be open to infinity; no hit is infinitely far away.
    const T t_max = glm::min(ray.t_max, std::numeric_limits<T>::max());
    const T enter = static_cast<T>(hits->enter);
    if (ray.t_min <= enter && enter <= t_max) return enter;
    const T leave = static_cast<T>(hits->leave);
    if (ray.t_min <= leave && leave <= t_max) return leave;
    return std::nullopt;
}
// [intersect]

/// The report's formula, term by term: kept for the lesson, not for use.
///
/// \f[ t = -\frac{u}{2} \pm \sqrt{\frac{u^2}{4} - v},\quad
///     u = 2\,D \cdot (O - C),\quad v = |O - C|^2 - R^2 \f]
///
/// Far away \f$ u^2/4 \f$ and \f$ v \f$ are two nearly equal, large numbers, and their
/// small difference, which is all that decides, drowns in their rounding.
///
/// \tparam Compute  The precision of the arithmetic; t is rounded to T once.
/// \param ray     A ray with a direction of unit length; its range decides.
/// \param sphere  The sphere.
/// \return As intersect(), where the formula holds; elsewhere what it happens to give.
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

/// The outward normal of a sphere.
///
/// Normalised instead of divided by R, for a computed hit is only near to the surface.
/// \param sphere  The sphere.
/// \param point   A point on the sphere, or near to it; not its centre.
/// \return Unit vector from the centre towards the point.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> normal(const SphereT<T>& sphere,
                              const Vec3T<T>& point) noexcept {
    return glm::normalize(point - sphere.center);
}
/// A mistake: it does not compile, and says why.
template <std::floating_point T, std::floating_point Other>
requires(!std::same_as<T, Other>) Vec3T<T> normal(const SphereT<T>&,
                                                  const Vec3T<Other>&) {
    static_assert(sizeof(T) == 0, "The sphere and the point have two precisions.");
    return {};
}

/// The area of a sphere.
/// \param sphere  The sphere.
/// \return \f$ 4 \pi R^2 \f$, in square scene units.
template <std::floating_point T>
[[nodiscard]] constexpr T area(const SphereT<T>& sphere) noexcept {
    return T(4) * std::numbers::pi_v<T> * sphere.radius * sphere.radius;
}

/// The point of a sphere that a ray hit: O + tD, put back onto the sphere.
///
/// The vector from the centre is summed without the centre's own coordinates, which far
/// from the origin would round it away. Of a sphere so small and far away that nothing
/// is left of that vector, the point faces the ray.
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

namespace detail {

/// The directions from a point to a sphere: a cone.
template <std::floating_point T>
struct ConeT {
    Vec3T<T> axis{T(0), T(0), T(1)}; ///< Unit vector to the centre.
    T one_minus_cos = T(2); ///< 1 - cos of the half angle: 2 is every direction.
};

/// The cone of directions in which a sphere is seen.
/// \param sphere  The sphere.
/// \param from    The observer.
/// \return The cone; every direction if the observer is inside.
template <std::floating_point T>
[[nodiscard]] ConeT<T> cone_towards(const SphereT<T>& sphere,
                                    const Vec3T<T>& from) noexcept {
    const Vec3T<T> way = sphere.center - from;
    const T sin2 = sphere.radius * sphere.radius / glm::dot(way, way);
    if (!(sin2 < T(1))) return {};
    return {.axis = glm::normalize(way), .one_minus_cos = one_minus_cosine(sin2)};
}

/// Whether an observer is surely outside a sphere, and samples the cone in which it is
/// seen. From inside, and from a point on the sphere, which may be rounded to either
/// side, the area serves: a room made of a sphere must see all of its wall.
/// \param sphere  The sphere.
/// \param from    The observer.
template <std::floating_point T>
[[nodiscard]] bool sees_cone(const SphereT<T>& sphere, const Vec3T<T>& from) noexcept {
    const T doubt = T(8) * std::numeric_limits<T>::epsilon() *
                    (max_component(glm::abs(sphere.center)) + sphere.radius);
    return glm::distance(sphere.center, from) > sphere.radius + doubt;
}

} // namespace detail

/// A point of the near side of a sphere, uniform over the cone in which it is seen;
/// from inside, uniform over its area.
/// \param sphere  The sphere.
/// \param from    The observer.
/// \param u       Point of the unit square.
/// \return The point and its density per steradian of the observer; 0 where the
///         observer is that point.
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

    // From the centre, the point lies at the angle that the chord leaves.
    const Vec3T<T> direction = to_world(frame_around(cone.axis), local);
    const T distance = glm::distance(sphere.center, from);
    const T sine2 = local.x * local.x + local.y * local.y;
    const T half_chord2 = sphere.radius * sphere.radius - distance * distance * sine2;
    const T t = distance * local.z - std::sqrt(glm::max(T(0), half_chord2));
    const RayT<T> ray{.origin = from, .direction = direction};
    return {.point = surface_point(sphere, ray, {.t = t}),
            .pdf = pdf_uniform_cone(cone.one_minus_cos)};
}

/// The density of sample_towards() for a sphere.
/// \param sphere  The sphere.
/// \param from    The observer.
/// \param point   The point of the sphere in question.
/// \return Per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_towards(const SphereT<T>& sphere, const Vec3T<T>& from,
                            const SurfacePointT<T>& point) noexcept {
    if (!detail::sees_cone(sphere, from))
        return detail::pdf_from_area(from, point, area(sphere));
    return pdf_uniform_cone(detail::cone_towards(sphere, from).one_minus_cos);
}

/// The point of the unit square whose sample_towards() is the point of a sphere that is
/// nearest to the observer.
/// \return (0, 0).
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> center_sample(const SphereT<T>& /*sphere*/) noexcept {
    return Vec2T<T>{T(0)};
}

/// The form factor from a point to a sphere: the share of the hemisphere over the point
/// that the sphere fills, weighted by the cosine, in closed form.
/// \param from        The point.
/// \param normal      Unit, of the surface at the point.
/// \param lamp        The sphere; it counts from its outer side.
/// \param inside_out  From the other side.
/// \return In [0, 1]; nothing if the horizon cuts the sphere, if the point lies in it,
///         or for the inner side: then the formula does not hold.
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

/// The smallest sphere around a sphere: itself.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const SphereT<T>& sphere) noexcept {
    return sphere;
}

/// A box around a sphere. No point of the sphere lies outside of it, not by a rounding
/// either.
/// \return The box, a few units in the last place too large.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const SphereT<T>& sphere) noexcept {
    const Vec3T<T> size =
        detail::rounding_bound<T>(3) * (detail::sizes(sphere.center)) +
        (T(1) + detail::rounding_bound<T>(3)) * Vec3T<T>{sphere.radius} +
        std::numeric_limits<T>::min();
    return {sphere.center - size, sphere.center + size};
}

/// A sphere in another place.
/// \param shape  The sphere.
/// \param by     The displacement, in scene units.
/// \return The same sphere there.
template <std::floating_point T>
[[nodiscard]] constexpr SphereT<T> translated(SphereT<T> shape,
                                              const Vec3T<T>& by) noexcept {
    shape.center += by;
    return shape;
}

/// The texture coordinates of a point of a sphere: longitude and latitude, as a
/// GlobeMap at its centre has them. They come from the normal, which is known well also
/// far from the origin.
/// \param point  Of surface_point().
/// \return (u, v) in [0, 1].
/// \cost Two arc tangents.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const SphereT<T>& /*sphere*/,
                                           const FlatHitT<T>& /*hit*/,
                                           const SurfacePointT<T>& point) noexcept {
    return globe_coordinates(point.normal);
}

/// Refuses a sphere of which no picture can be made.
/// \param sphere  The sphere.
/// \throws std::invalid_argument  with the name and the value.
template <std::floating_point T>
void check(const SphereT<T>& sphere) {
    require_finite("sphere.center", sphere.center);
    require_positive("sphere.radius", sphere.radius);
}

/// \}

} // namespace ljus
