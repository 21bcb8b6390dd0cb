#pragma once

/// \file ljus/geometry/metaballs.hpp
/// \brief Metaballs: a field of blobs, and its isosurface.

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <vector>

#include "ljus/geometry/detail/metaball_quartic.hpp"
#include "ljus/geometry/isosurface.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \addtogroup metaballs
/// \{

/// A field of blobs. Its surface is where the field equals `level`:
/// \f[ f(X) = \sum_i w_i \left(1 - \frac{|X - C_i|^2}{R_i^2}\right)_+^2 - L = 0. \f]
/// f is positive inside and negative outside. A blob of negative weight carves. One
/// blob of weight 1 and level 1/4 gives a sphere of radius 0.707 R.
/// \report{Section 2.1, footnote 2} \cite blinn1982 \cite wyvill1986
// [metaballs]
template <std::floating_point T>
struct MetaballsT {
    std::vector<BlobT<T>> blobs{}; ///< One or more.
    T level = T(0.25); ///< L: above 0, below the sum of the positive weights.
};
using Metaballs = MetaballsT<float>; ///< MetaballsT in float.
// [metaballs]

/// The field f of metaballs at a point, in double: positive inside, 0 on the surface,
/// -L far away.
template <std::floating_point T>
[[nodiscard]] WideT<T> field(const MetaballsT<T>& balls, const Vec3T<WideT<T>>& x) {
    using C = WideT<T>;
    C sum = -C(balls.level);
    for (const BlobT<T>& blob : balls.blobs) {
        const Vec3T<C> q = (x - Vec3T<C>(blob.center)) / C(blob.radius);
        const C s = C(1) - glm::dot(q, q);
        if (s > C(0)) sum += C(blob.weight) * s * s;
    }
    return sum;
}

/// The gradient of the field, \f$ \nabla f = -4 \sum_i w_i s_i (X - C_i)/R_i^2 \f$, in
/// double. It points inwards.
template <std::floating_point T>
[[nodiscard]] Vec3T<WideT<T>> gradient(const MetaballsT<T>& balls,
                                       const Vec3T<WideT<T>>& x) {
    using C = WideT<T>;
    Vec3T<C> sum{0};
    for (const BlobT<T>& blob : balls.blobs) {
        const Vec3T<C> q = (x - Vec3T<C>(blob.center)) / C(blob.radius);
        const C s = C(1) - glm::dot(q, q);
        if (s > C(0)) sum -= C(4) * C(blob.weight) * s * q / C(blob.radius);
    }
    return sum;
}

/// The Lipschitz constant of the field: the sum of
/// \f$ \frac{8}{3\sqrt 3} |w_i| / R_i \f$. A blob is steepest at
/// \f$ r = R / \sqrt 3 \f$. Sphere tracing steps by |f| over it.
/// \return At least |grad f| everywhere, per scene unit, in double.
template <std::floating_point T>
[[nodiscard]] WideT<T> lipschitz(const MetaballsT<T>& balls) {
    WideT<T> sum = 0;
    for (const BlobT<T>& blob : balls.blobs)
        sum += std::abs(WideT<T>(blob.weight)) / WideT<T>(blob.radius);
    return sum * detail::steepest_blob<WideT<T>>;
}

/// The distance within the ray's [t_min, t_max] at which it first hits metaballs, from
/// outside or inside.
/// \tparam Solver  QuarticPieces, the default, is the fastest and most accurate of the
///                 four; the others are Bisection, SphereTracing and Radicals.
/// \return The smallest t at which f crosses 0, in units of the direction's length,
///         computed in double and rounded to T once; nothing for a miss, a NaN, an
///         infinity, or a zero direction. The inside is where f >= 0.
/// \cost A square root and a division per blob, and a quartic per span. The spans lie
///       between the points at which the ray enters, leaves or is nearest to a blob: at
///       most 3 n - 1 spans, each with n additions and mostly 0 or 1 root; at most 10
///       roots of 106 steps.
/// \report{Section 2.1}
template <typename Solver = QuarticPieces, std::floating_point T>
[[nodiscard]] std::optional<T> intersect(const RayT<T>& ray, const MetaballsT<T>& balls,
                                         const Solver& solver = {}) {
    using C = WideT<T>;
    detail::StrandsT<C> strands;
    for (const BlobT<T>& blob : balls.blobs)
        if (const auto met = detail::strand(ray, blob)) strands.add(*met);
    const auto line = detail::line_of(strands, C(balls.level));
    const auto t = detail::first_meeting(solver, line, C(ray.t_min), C(ray.t_max));
    if (!t || !(*t <= std::numeric_limits<T>::max())) return std::nullopt;
    return static_cast<T>(*t);
}

/// The point of metaballs that a ray hit, projected onto the surface.
/// \return Position, error bound, outward normal -grad f / |grad f|. If the gradient
///         vanishes, as in the neck of two blobs that just touch, the normal faces the
///         ray.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T>
surface_point(const MetaballsT<T>& balls, const RayT<T>& ray, const ShapeHitT<T>& hit) {
    WideT<T> size = balls.level;
    for (const BlobT<T>& blob : balls.blobs) size += std::abs(WideT<T>(blob.weight));
    return detail::refined([&](const auto& x) { return field(balls, x); },
                           [&](const auto& x) { return gradient(balls, x); }, ray,
                           hit.t, 64 * std::numeric_limits<WideT<T>>::epsilon() * size);
}

namespace detail {

/// The radius within which a blob's field reaches a value.
/// \return R sqrt(1 - sqrt(s/w)); negative if the field is below s everywhere.
template <std::floating_point T>
[[nodiscard]] WideT<T> reach_of(const BlobT<T>& blob, WideT<T> share) {
    const WideT<T> s = std::sqrt(share / WideT<T>(blob.weight));
    return s < 1 ? WideT<T>(blob.radius) * std::sqrt(1 - s) : WideT<T>(-1);
}

} // namespace detail

/// A sphere around metaballs. Where n blobs together reach the level, at least one of
/// them reaches 1/n of it; the sphere contains all points where a blob does. For a
/// single blob it is the surface itself.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const MetaballsT<T>& balls) {
    using C = WideT<T>;
    C positive = 0;
    for (const BlobT<T>& blob : balls.blobs) positive += blob.weight > T(0) ? 1 : 0;
    constexpr C far = std::numeric_limits<C>::infinity();
    Vec3T<C> low{far}, high{-far};
    const auto each = [&](const auto& visit) {
        for (const BlobT<T>& blob : balls.blobs) {
            if (!(blob.weight > T(0))) continue;
            const C reach = detail::reach_of(blob, C(balls.level) / positive);
            if (reach >= C(0)) visit(Vec3T<C>(blob.center), reach);
        }
    };
    each([&](const Vec3T<C>& center, C reach) {
        low = glm::min(low, center - reach);
        high = glm::max(high, center + reach);
    });
    if (!(low.x <= high.x))
        return {.center = Vec3T<T>{0}, .radius = T(0)}; // no surface
    const Vec3T<T> center{low + (high - low) / C(2)};
    C radius = 0;
    each([&](const Vec3T<C>& c, C reach) {
        radius = glm::max(radius, glm::distance(Vec3T<C>(center), c) + reach);
    });
    return {.center = center,
            .radius = static_cast<T>(radius) *
                      (T(1) + T(4) * std::numeric_limits<T>::epsilon())};
}

/// Refuses metaballs that have no surface.
/// \throws std::invalid_argument  with the name and the value.
template <std::floating_point T>
void check(const MetaballsT<T>& balls) {
    require_positive("metaballs.level", balls.level);
    T most = T(0);
    for (const BlobT<T>& blob : balls.blobs) {
        require_finite("metaballs.blobs.center", blob.center);
        require_positive("metaballs.blobs.radius", blob.radius);
        require(std::isfinite(blob.weight), "metaballs.blobs.weight", blob.weight,
                "finite");
        if (blob.weight > T(0)) most += blob.weight;
    }
    require(most > balls.level && std::isfinite(most),
            "the sum of the positive weights of metaballs", most,
            "finite and above metaballs.level, or there is no surface");
}

/// \}

} // namespace ljus
