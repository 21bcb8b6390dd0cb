#pragma once

/// \file ljus/geometry/sphere.hpp
/// \brief The sphere |X - C|^2 = R^2, and where a ray meets it.

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <optional>

#include "ljus/geometry/ray.hpp"
#include "ljus/math/vector.hpp"

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
    return ChordT<C>{.enter = std::min(small, large), .leave = std::max(small, large)};
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
requires(!std::same_as<T, Other>)
Vec3T<T> normal(const SphereT<T>&, const Vec3T<Other>&) {
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

/// \}

} // namespace ljus
