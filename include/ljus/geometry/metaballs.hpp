#pragma once

/// \file ljus/geometry/metaballs.hpp
/// \brief Metaballs: the isosurface of the summed field of some blobs.

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

/// Metaballs: the surface where the summed fields of some blobs are equal to a level L:
/// \f[ f(X) = \sum_i w_i \left(1 - \frac{|X - C_i|^2}{R_i^2}\right)_+^2 - L = 0. \f]
/// The index + means that a negative number counts as 0. A blob of negative weight
/// removes volume. One blob of weight 1 and level 1/4 gives a sphere of radius 0.707 R.
/// \report{Section 2.1, footnote 2} \cite blinn1982 \cite wyvill1986
// [metaballs]
template <std::floating_point T>
struct MetaballsT {
    std::vector<BlobT<T>> blobs{}; ///< The blobs, at least one.
    T level = T(0.25); ///< The level L: above 0, below the sum of positive weights.
};
using Metaballs = MetaballsT<float>; ///< MetaballsT in float.
// [metaballs]

/// The field f of metaballs at a point, in double. It is positive inside, 0 on the
/// surface, and -level far away.
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

/// The gradient of the field in double,
/// \f$ \nabla f = -4 \sum_i w_i s_i (X - C_i)/R_i^2 \f$. The sum is over the blobs for
/// which \f$ s_i = 1 - |X - C_i|^2/R_i^2 \f$ is positive; see MetaballsT.
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

/// A bound on the slope of the field (its Lipschitz constant): the sum of
/// \f$ \frac{8}{3\sqrt 3} |w_i| / R_i \f$ over all blobs. The field of a blob is
/// steepest at the distance \f$ R / \sqrt 3 \f$ from its centre.
/// \return At least |grad f| everywhere, per scene unit, in double.
template <std::floating_point T>
[[nodiscard]] WideT<T> lipschitz(const MetaballsT<T>& balls) {
    WideT<T> sum = 0;
    for (const BlobT<T>& blob : balls.blobs)
        sum += std::abs(WideT<T>(blob.weight)) / WideT<T>(blob.radius);
    return sum * detail::steepest_blob<WideT<T>>;
}

/// The distance at which a ray first hits metaballs, from outside or inside.
/// \tparam Solver  QuarticPieces, Bisection, SphereTracing or Radicals. The default,
///                 QuarticPieces, is the fastest and the most accurate.
/// \return The smallest t at which f crosses 0, in units of the direction's length. It
///         is computed in double and rounded to T once. Nothing for a miss. A point
///         with f >= 0 is inside.
/// \cost A square root and a division per blob. A ray that meets n blobs has at most
///       3n - 1 spans, which end where the ray enters, leaves or is nearest to a blob.
///       A span costs n additions, and usually at most one search for a zero of f; at
///       worst 7 searches of 106 steps each.
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

/// A sphere around metaballs. On the surface the fields of the n blobs of positive
/// weight add up to the level L or more, so that at least one field is L/n or more. The
/// sphere contains all points where a field is that large.
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
            // The blob's field is L/n where 1 - (distance / R)^2 is s.
            const C s = std::sqrt(C(balls.level) / positive / C(blob.weight));
            if (s < 1) visit(Vec3T<C>(blob.center), C(blob.radius) * std::sqrt(1 - s));
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

/// Checks metaballs. All members must be finite, the level and the radii above 0, and
/// the sum of the positive weights above the level.
/// \throws std::invalid_argument  with the name and the value of the member.
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
