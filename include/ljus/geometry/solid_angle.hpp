#pragma once

/// \file ljus/geometry/solid_angle.hpp
/// \brief Points of a shape, chosen for an observer: densities per steradian.

#include <optional>

#include "ljus/geometry/shape.hpp"
#include "ljus/math/facet.hpp"
#include "ljus/math/frame.hpp"

namespace ljus {

/// \defgroup solid_angle Shapes as an observer sees them
/// \brief Section 3.2.3: shadow rays end at a point of a lamp; its density per
/// steradian holds the cosine and the inverse square that the report's program forgot.
/// \{

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

} // namespace detail

/// A point of a shape, and the density with which an observer's direction fell on it.
template <std::floating_point T>
struct SeenPointT {
    SurfacePointT<T> point{}; ///< The point.
    T pdf = T(0);             ///< Per steradian of the observer.
};

namespace detail {

/// The density per steradian of a point that was chosen uniformly over the area.
/// \param from   The observer.
/// \param point  The point of the shape.
/// \param area   The shape's area.
/// \return distance^2 / (|cos| area); infinity if the surface is seen edge-on, and 0 at
///         the point itself, whose light comes from nowhere.
/// \cite veach1997
// [pdf from area]
template <std::floating_point T>
[[nodiscard]] T pdf_from_area(const Vec3T<T>& from, const SurfacePointT<T>& point,
                              T area) noexcept {
    const Vec3T<T> way = point.position - from;
    const T distance2 = glm::dot(way, way);
    if (!(distance2 > T(0))) return T(0);
    const T cosine = std::abs(glm::dot(way, point.normal)) / std::sqrt(distance2);
    return distance2 / (cosine * area);
}
// [pdf from area]

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

/// \name The centre of a lamp
/// \{

/// The point of the unit square whose sample, by sample_towards(), stands for the whole
/// lamp: of a sphere the point that is nearest to the observer, of a quad its middle.
/// \return The point.
template <Shape Lamp>
[[nodiscard]] auto center_sample(const Lamp&) noexcept {
    return Vec2T<ScalarOf<Lamp>>{ScalarOf<Lamp>(0.5)};
}
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> center_sample(const SphereT<T>&) noexcept {
    return Vec2T<T>{T(0)};
}
/// \}

/// \name The facet of a flat shape
/// \{

/// The facet of a flat shape; it faces along the shape's normal.
template <std::floating_point T>
[[nodiscard]] Facet facet_of(const QuadT<T>& quad) noexcept {
    const glm::dvec3 c(quad.corner), u(quad.edge_u), v(quad.edge_v);
    return {{c, c + u, c + u + v, c + v}, 4};
}
template <std::floating_point T>
[[nodiscard]] Facet facet_of(const TriangleT<T>& triangle) noexcept {
    return {{glm::dvec3(triangle.v1), glm::dvec3(triangle.v2), glm::dvec3(triangle.v3)},
            3};
}
/// \}

/// \name How much of the hemisphere over a point a lamp fills, its cosine counted
/// \{

/// The form factor from a point to a flat lamp, in closed form.
/// \param from        The point.
/// \param normal      Unit, of the surface at the point.
/// \param lamp        It counts from the side that its normal points to.
/// \param inside_out  From the other side.
/// \return In [0, 1]: the irradiance over pi times the lamp's radiance.
template <typename Flat, std::floating_point T>
[[nodiscard]] auto form_factor_from(const Vec3T<T>& from, const Vec3T<T>& normal,
                                    const Flat& lamp, bool inside_out) noexcept
    -> decltype(facet_of(lamp), std::optional<T>{}) {
    const Facet facet = facet_of(lamp);
    return static_cast<T>(form_factor_at(glm::dvec3(from), glm::dvec3(normal),
                                         inside_out ? detail::turned(facet) : facet));
}
/// The same of a sphere.
/// \return Nothing if the horizon cuts the sphere, or the point is in it.
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
/// \}

/// \}

} // namespace ljus
