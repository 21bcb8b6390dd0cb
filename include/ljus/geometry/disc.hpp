#pragma once

/// \file ljus/geometry/disc.hpp
/// \brief The disc.

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/ray.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/require.hpp"
#include "ljus/math/sampling.hpp"

namespace ljus {

/// \defgroup disc Discs
/// \brief Section 3.1.5 of the report: a flat shape, here with a circle as its border.
/// \{

/// The points of a plane within the distance R of a centre.
template <std::floating_point T>
struct DiscT {
    Vec3T<T> center{T(0)}; ///< The centre C, in scene units.
    /// The normal N, towards the front; any length except 0.
    Vec3T<T> normal{T(0), T(0), T(1)};
    T radius = T(1); ///< The radius R, above 0, in scene units.
};
using Disc = DiscT<float>; ///< DiscT in float.

/// The unit normal of a disc.
template <std::floating_point T>
[[nodiscard]] inline Vec3T<T> normal(const DiscT<T>& disc) noexcept {
    return Vec3T<T>(glm::normalize(Vec3T<WideT<T>>{disc.normal}));
}

/// Intersects a ray O + tD with a disc of centre C, normal N and radius R. The ray
/// meets the plane of the disc at \f$ t = N \cdot (C - O) / N \cdot D \f$. It hits the
/// disc if the point O + tD lies within R of C.
/// \tparam Compute  The precision of the arithmetic; by default double. In float,
///                  lengths must be between 1e-18 and 1e18.
/// \return The distance t, and the coordinates u and v of the point in [-1, 1]. These
///         are relative to the centre, in units of the radius, along the tangent and
///         the bitangent of frame_around(normal(disc)). Nothing for a miss.
/// \cost One division; a square root and four more divisions for a hit.
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>> intersect(const RayT<T>& ray,
                                                    const DiscT<T>& disc) noexcept {
    using C = ComputeT<Compute, WideT<T>>;
    const Vec3T<C> d{ray.direction}, n{disc.normal};
    const Vec3T<C> to = Vec3T<C>{disc.center} - Vec3T<C>{ray.origin};
    // If the ray is parallel to the disc, t is 0/0 or infinite, which is a miss.
    const C t = glm::dot(n, to) / glm::dot(n, d);
    constexpr C max{std::numeric_limits<T>::max()};
    if (!(C(ray.t_min) <= t && t <= C(ray.t_max) && t <= max)) return std::nullopt;
    const Vec3T<C> p = t * d - to;
    const C r{disc.radius};
    if (!(glm::dot(p, p) <= r * r)) return std::nullopt;
    const FrameT<C> frame = frame_around(glm::normalize(n));
    return ShapeHitT<T>{static_cast<T>(t),
                        static_cast<T>(glm::dot(p, frame.tangent) / r),
                        static_cast<T>(glm::dot(p, frame.bitangent) / r), 0};
}

/// The area of a disc, \f$ \pi R^2 \f$, in squared scene units.
template <std::floating_point T>
[[nodiscard]] constexpr T area(const DiscT<T>& disc) noexcept {
    return std::numbers::pi_v<T> * disc.radius * disc.radius;
}

/// The point of a disc at the coordinates u and v of intersect(), with an error bound.
/// `normal` must be the result of normal(disc).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> point_at(const DiscT<T>& disc, T u, T v,
                                        const Vec3T<T>& normal) noexcept {
    const FrameT<T> frame = frame_around(normal);
    const Vec3T<T> along_u = disc.radius * frame.tangent;
    const Vec3T<T> along_v = disc.radius * frame.bitangent;
    const Vec3T<T> a = u * along_u, b = v * along_v;
    // The rounding of the frame tilts the plane, by 4 units of roundoff per component.
    SurfacePointT<T> point{
        .position = disc.center + a + b,
        .error =
            detail::rounding_bound<T>(5) *
                (detail::sizes(disc.center) + detail::sizes(a) + detail::sizes(b)) +
            detail::rounding_bound<T>(8) * disc.radius * (std::abs(u) + std::abs(v)),
        .normal = normal};
    detail::add_tilt(point, along_u, along_v);
    return point;
}

/// The point of a disc at the u and v of a hit.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const DiscT<T>& disc,
                                             const RayT<T>& /*ray*/,
                                             const ShapeHitT<T>& hit) noexcept {
    return point_at(disc, hit.u, hit.v, normal(disc));
}

/// Samples a point of a disc uniformly, with the density 1 / area per squared scene
/// unit. `normal` must be the result of normal(disc).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const DiscT<T>& disc, const Vec2T<T>& u,
                                           const Vec3T<T>& normal) noexcept {
    const Vec2T<T> p = sample_concentric_disc(u);
    return point_at(disc, p.x, p.y, normal);
}

/// Samples a point of a disc uniformly. The function calls normal(disc).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const DiscT<T>& disc,
                                           const Vec2T<T>& u) noexcept {
    return sample_area(disc, u, normal(disc));
}

/// The texture coordinates of a hit. The disc fills the largest circle in the unit
/// square.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const DiscT<T>& /*disc*/,
                                           const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    return {(T(1) + hit.u) / T(2), (T(1) + hit.v) / T(2)};
}

/// The smallest sphere around a disc.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const DiscT<T>& disc) noexcept {
    return {.center = disc.center, .radius = disc.radius};
}

/// A box that contains a disc despite rounding, a few units in the last place too
/// large. Along axis i the disc extends by \f$ R \sqrt{1 - n_i^2} \f$ from its centre,
/// where n is the unit normal.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const DiscT<T>& disc) noexcept {
    const Vec3T<T> n = normal(disc);
    const Vec3T<T> reach{std::hypot(n.y, n.z), std::hypot(n.x, n.z),
                         std::hypot(n.x, n.y)};
    const Vec3T<T> size =
        disc.radius * reach +
        detail::rounding_bound<T>(16) * (detail::sizes(disc.center) + disc.radius) +
        std::numeric_limits<T>::min();
    return {disc.center - size, disc.center + size};
}

/// A disc displaced by a vector, in scene units.
template <std::floating_point T>
[[nodiscard]] constexpr DiscT<T> translated(DiscT<T> shape,
                                            const Vec3T<T>& by) noexcept {
    shape.center += by;
    return shape;
}

/// Refuses a disc if a member is not finite, if the normal is 0, or if the radius is
/// not above 0.
/// \throws std::invalid_argument  with the name and the value of the member.
template <std::floating_point T>
void check(const DiscT<T>& disc) {
    require_finite("disc.center", disc.center);
    require_direction("disc.normal", disc.normal);
    require_positive("disc.radius", disc.radius);
}

/// \}

} // namespace ljus
