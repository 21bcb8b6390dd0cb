#pragma once

/// \file ljus/geometry/cylinder.hpp
/// \brief The cylinder: an open tube.

#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/disc.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup cylinder Cylinders
/// \brief An open tube around a line segment; the two discs of ends_of() close it.
/// \{

/// The points at the distance R from an axis, between the ends of the axis. The normal
/// points away from the axis.
template <std::floating_point T>
struct CylinderT {
    Vec3T<T> base{T(0)};             ///< One end of the axis, in scene units.
    Vec3T<T> axis{T(0), T(1), T(0)}; ///< The axis A, from the base to the other end.
    T radius = T(1);                 ///< The radius R, above 0, in scene units.
};
using Cylinder = CylinderT<float>; ///< CylinderT in float.

/// The unit vector along the axis of a cylinder.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> axis_of(const CylinderT<T>& cylinder) noexcept {
    return Vec3T<T>(glm::normalize(Vec3T<WideT<T>>{cylinder.axis}));
}

/// Intersects a ray with a cylinder, from outside or inside.
///
/// Projected along the axis, the cylinder is a circle. The projected ray meets this
/// circle where it meets a sphere of the same radius; see chord().
/// \tparam Compute  The precision of the arithmetic; by default double. In float,
///                  lengths must be between 1e-15 and 1e15.
/// \return The distance t, and the coordinate v along the axis, in [0, 1]. Nothing for
///         a miss, or for a ray along the axis.
/// \cost Two square roots and six divisions.
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>>
intersect(const RayT<T>& ray, const CylinderT<T>& cylinder) noexcept {
    using C = ComputeT<Compute, WideT<T>>;
    const Vec3T<C> axis{cylinder.axis};
    const C height = glm::length(axis);
    const Vec3T<C> a = axis / height;
    const auto across = [&a](const Vec3T<C>& v) { return v - glm::dot(v, a) * a; };
    const Vec3T<C> ray_d{ray.direction};
    const Vec3T<C> ray_o = Vec3T<C>{ray.origin} - Vec3T<C>{cylinder.base};
    const Vec3T<C> d = across(ray_d), o = across(ray_o);
    const auto roots = chord(RayT<C>{.origin = o, .direction = d},
                             SphereT<C>{.radius = C(cylinder.radius)});
    if (!roots) return std::nullopt;
    constexpr C max{std::numeric_limits<T>::max()};
    for (const C t : {roots->enter, roots->leave}) {
        const C along = glm::dot(ray_o + t * ray_d, a);
        if (C(ray.t_min) <= t && t <= C(ray.t_max) && t <= max && C(0) <= along &&
            along <= height)
            return ShapeHitT<T>{static_cast<T>(t), T(0), static_cast<T>(along / height),
                                0};
    }
    return std::nullopt;
}

/// The area of a cylinder without its ends, in squared scene units: \f$ 2 \pi R |A| \f$
/// for the radius R and the axis A.
template <std::floating_point T>
[[nodiscard]] T area(const CylinderT<T>& cylinder) noexcept {
    return T(2) * std::numbers::pi_v<T> * cylinder.radius * glm::length(cylinder.axis);
}

namespace detail {

/// The point of a cylinder with the coordinate v along the axis, in [0, 1], and the
/// given unit normal.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> point_of(const CylinderT<T>& cylinder, T v,
                                        const Vec3T<T>& normal) noexcept {
    const Vec3T<T> along = v * cylinder.axis, offset = cylinder.radius * normal;
    return {.position = cylinder.base + along + offset,
            .error = rounding_bound<T>(8) *
                     (sizes(cylinder.base) + size_of(along) + sizes(offset)),
            .normal = normal};
}

} // namespace detail

/// The point of a cylinder that a ray O + tD hit, projected onto the cylinder. If
/// rounding leaves nothing of the normal of a thin, distant cylinder, the normal faces
/// the ray.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const CylinderT<T>& cylinder,
                                             const RayT<T>& ray,
                                             const ShapeHitT<T>& hit) noexcept {
    using W = WideT<T>;
    const Vec3T<W> axis = glm::normalize(Vec3T<W>{cylinder.axis});
    const auto across = [&axis](const Vec3T<W>& v) {
        return v - glm::dot(v, axis) * axis;
    };
    const Vec3T<W> d{ray.direction};
    const Vec3T<W> from = Vec3T<W>{ray.origin} - Vec3T<W>{cylinder.base};
    Vec3T<W> way = across(from + W(hit.t) * d);
    if (way == Vec3T<W>{0}) way = -across(d);
    return detail::point_of(cylinder, hit.v, Vec3T<T>(glm::normalize(way)));
}

/// Samples a point of a cylinder uniformly, with the density 1 / area per squared scene
/// unit. u.x gives the angle around the axis, and u.y the position along it.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const CylinderT<T>& cylinder,
                                           const Vec2T<T>& u) noexcept {
    const FrameT<T> frame = frame_around(axis_of(cylinder));
    const T angle = T(2) * std::numbers::pi_v<T> * u.x;
    const Vec3T<T> out =
        std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent;
    return detail::point_of(cylinder, u.y, glm::normalize(out));
}

/// The texture coordinates (u, v) of a hit, in [0, 1]. u goes once around the axis,
/// from the tangent of frame_around(axis_of(cylinder)) towards the bitangent. v goes
/// along the axis.
/// \cost An arc tangent.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const CylinderT<T>& cylinder,
                                           const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& point) noexcept {
    const Vec3T<T> local = to_local(frame_around(axis_of(cylinder)), point.normal);
    const T u = std::atan2(local.y, local.x) * (std::numbers::inv_pi_v<T> / T(2));
    return {u < T(0) ? u + T(1) : u, hit.v};
}

/// The two discs that close a cylinder, the one at the base first. Both face away from
/// the cylinder.
template <std::floating_point T>
[[nodiscard]] std::array<DiscT<T>, 2> ends_of(const CylinderT<T>& cylinder) noexcept {
    return {DiscT<T>{cylinder.base, -cylinder.axis, cylinder.radius},
            DiscT<T>{cylinder.base + cylinder.axis, cylinder.axis, cylinder.radius}};
}

/// The smallest sphere around a cylinder.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const CylinderT<T>& cylinder) noexcept {
    const Vec3T<T> half = cylinder.axis / T(2);
    return {.center = cylinder.base + half,
            .radius = std::hypot(glm::length(half), cylinder.radius)};
}

/// A box that contains a cylinder despite rounding: the box around the two ends, a few
/// units in the last place too large.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const CylinderT<T>& cylinder) noexcept {
    const auto ends = ends_of(cylinder);
    BoxT<T> box = box_union(bounds(ends[0]), bounds(ends[1]));
    const Vec3T<T> rounding =
        detail::rounding_bound<T>(4) *
        (detail::sizes(cylinder.base) + detail::sizes(cylinder.axis));
    return {box.low - rounding, box.high + rounding};
}

/// A cylinder displaced by a vector, in scene units.
template <std::floating_point T>
[[nodiscard]] constexpr CylinderT<T> translated(CylinderT<T> shape,
                                                const Vec3T<T>& by) noexcept {
    shape.base += by;
    return shape;
}

/// Refuses a cylinder if a member is not finite, if the axis has no length, or if the
/// radius is not above 0.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T>
void check(const CylinderT<T>& cylinder) {
    require_finite("cylinder.base", cylinder.base);
    require_direction("cylinder.axis", cylinder.axis);
    require_positive("cylinder.radius", cylinder.radius);
}

/// \}

} // namespace ljus
