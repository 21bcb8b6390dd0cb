#pragma once

/// \file ljus/optics/microfacet.hpp
/// \brief Microfacets: their distribution, shadowing and visible normals.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup microfacet Microfacets
/// \brief Section 3.2.4 of the report: a rough surface made of small mirrors.
///
/// The normals of the facets are distributed as on an ellipsoid flattened by the factor
/// alpha, the roughness: GGX \cite walter2007. All directions are unit vectors in the
/// local frame with z > 0, and alpha > 0.
/// \{

namespace detail {

/// The unit normal of the facet that reflects one direction into the other. The sum of
/// the directions is scaled before it is normalised, so that the squares of its
/// components do not underflow.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> half_vector(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    const Vec3T<T> sum = wo + wi;
    return glm::normalize(sum / max_component(glm::abs(sum)));
}

} // namespace detail

/// The area of the facets with the normal h, per area of the surface and per steradian.
///
/// \f[ D(h) = \frac{1}{\pi \alpha^2 \left( h_z^2 + (h_x^2 + h_y^2)/\alpha^2 \right)^2},
///     \qquad \int D(h)\, h_z\, dh = 1 \f]
///
/// Half of the facets have a slope above alpha.
/// \return D(h), per steradian; at most 1/(pi alpha^2), or alpha^2/pi if alpha > 1.
/// \cite walter2007
template <std::floating_point T>
[[nodiscard]] T ggx_distribution(T alpha, const Vec3T<T>& h) noexcept {
    const T x = h.x / alpha;
    const T y = h.y / alpha;
    const T size = alpha * (x * x + y * y + h.z * h.z);
    return std::numbers::inv_pi_v<T> / (size * size);
}

namespace detail {

/// The function r(w) of a direction w, from which the visibility of facets is computed.
///
/// \f[ r(w) = \sqrt{w_z^2 + \alpha^2 (w_x^2 + w_y^2)}, \quad
///     G_1(w) = \frac{2 w_z}{w_z + r(w)}, \quad
///     G_2(w_o, w_i) = \frac{2\, w_{o,z} w_{i,z}}
///                          {w_{i,z}\, r(w_o) + w_{o,z}\, r(w_i)} \f]
///
/// G1 is the fraction of facets that are visible from w. G2 is the fraction that are
/// both visible from w_o and lit from w_i (height-correlated Smith \cite heitz2014).
/// \return r(w), from alpha to 1.
/// \cost One square root.
template <std::floating_point T>
[[nodiscard]] T ggx_lambda(T alpha, const Vec3T<T>& w) noexcept {
    return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

/// Samples the normal h of a facet that is visible from `wo`. The density per steradian
/// is \f$ G_1(w_o) \max(0, w_o \cdot h) D(h) / w_{o,z} \f$ \cite heitz2018.
///
/// A stretch by alpha along x and y turns the facets into a hemisphere. The mirror
/// directions of the stretched `wo` fill a spherical cap uniformly \cite dupuy2023. The
/// function samples a point of the cap, takes the half vector between it and the
/// stretched `wo`, and undoes the stretch.
/// \return Unit vector with z >= 0.
/// \cost One sine, one cosine, three square roots.
// [visible normals]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_visible_normal(T alpha, const Vec3T<T>& wo,
                                             const Vec2T<T>& u) noexcept {
    // Stretch, so that the facets form a hemisphere.
    const Vec3T<T> stretched{alpha * wo.x, alpha * wo.y, wo.z};
    const Vec3T<T> w = glm::normalize(stretched);
    // A point of the cap with z > -w.z, and the half vector between it and w.
    const T t = u.y * (T(1) + w.z);
    const T radius = std::sqrt(std::max(T(0), t * (T(2) - t)));
    const T phi = T(2) * std::numbers::pi_v<T> * u.x;
    const T x = radius * std::cos(phi) + w.x;
    const T y = radius * std::sin(phi) + w.y;
    const T z = (T(1) - u.y) * (T(1) + w.z); // 1 - t + w.z
    // Undo the stretch.
    return glm::normalize(Vec3T<T>{alpha * x, alpha * y, z});
}
// [visible normals]

} // namespace detail

/// \}

} // namespace ljus
