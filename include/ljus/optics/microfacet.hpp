#pragma once

/// \file ljus/optics/microfacet.hpp
/// \brief The slopes of a rough surface: how many facets look where, and which of them
/// are seen.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup microfacet Microfacets
/// \brief Section 3.2.4, between the mirror and Lambert: a surface of small mirrors.
///
/// The distribution is GGX \cite walter2007 : the surface looks from afar like an
/// ellipsoid, flattened by alpha. All directions are in the local frame, z > 0, and of
/// unit length; alpha > 0.
/// \{

namespace detail {

/// The middle of two directions, of unit length: the normal of the facet that mirrors
/// one into the other. The sum is scaled first, so that its squares do not underflow.
/// \param wo, wi  Unit vectors in the surface's frame, with z > 0 both.
/// \return Unit vector with z > 0.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> half_vector(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    const Vec3T<T> sum = wo + wi;
    return glm::normalize(sum / max_component(glm::abs(sum)));
}

} // namespace detail

/// How many facets look along h: their area, per area of the surface and steradian.
///
/// \f[ D(h) = \frac{1}{\pi \alpha^2 \left( h_z^2 + (h_x^2 + h_y^2)/\alpha^2 \right)^2},
///     \qquad \int D(h)\, h_z\, dh = 1 \f]
///
/// \param alpha  Roughness; the slope that is exceeded by half of the facets.
/// \param h      Normal of the facets.
/// \return Per steradian; 1/(pi alpha^2) at most, or alpha^2/pi beyond alpha = 1.
/// \cite walter2007
template <std::floating_point T>
[[nodiscard]] T ggx_distribution(T alpha, const Vec3T<T>& h) noexcept {
    const T x = h.x / alpha;
    const T y = h.y / alpha;
    const T size = alpha * (x * x + y * y + h.z * h.z);
    return std::numbers::inv_pi_v<T> / (size * size);
}

namespace detail {

/// The area that the ellipsoid shows in a direction, times two, less the surface's own.
///
/// \f[ r(w) = \sqrt{w_z^2 + \alpha^2 (w_x^2 + w_y^2)}, \quad
///     G_1(w) = \frac{2 w_z}{w_z + r(w)}, \quad
///     G_2(w_o, w_i) = \frac{2\, w_{o,z} w_{i,z}}
///                          {w_{i,z}\, r(w_o) + w_{o,z}\, r(w_i)} \f]
///
/// G1 is the share of facets that is seen and not hidden by others, G2 the share that
/// is seen and lit, for heights that both ways have in common (Smith, height-correlated
/// \cite heitz2014).
/// \param alpha  Roughness.
/// \param w      The direction.
/// \return r(w), from alpha to 1.
/// \cost One square root.
template <std::floating_point T>
[[nodiscard]] T ggx_lambda(T alpha, const Vec3T<T>& w) noexcept {
    return std::sqrt(w.z * w.z + alpha * alpha * (w.x * w.x + w.y * w.y));
}

/// The normal of a facet as `wo` sees them: with the density
/// \f$ G_1(w_o) \max(0, w_o \cdot h) D(h) / w_{o,z} \f$ \cite heitz2018.
///
/// Stretched to a hemisphere, the facets are a mirror whose reflections fill the cap
/// of the sphere above the horizon, seen from the stretched `wo`: evenly
/// \cite dupuy2023. One point of the cap gives the normal. Written by the distance
/// from the cap's top, t, nothing cancels: at grazing angles the cap is half the
/// sphere, straight on the whole of it.
/// \param alpha  Roughness.
/// \param wo     Unit vector in the surface's frame, to where the light goes.
/// \param u      Point of the unit square.
/// \return Unit vector with z >= 0.
/// \cost One sine, one cosine, three square roots.
/// \cite dupuy2023
// [visible normals]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_visible_normal(T alpha, const Vec3T<T>& wo,
                                             const Vec2T<T>& u) noexcept {
    // Stretch, so that all facets together are half a sphere.
    const Vec3T<T> stretched{alpha * wo.x, alpha * wo.y, wo.z};
    const Vec3T<T> w = glm::normalize(stretched);
    // A point of the cap with z > -w.z, and halfway from there to w.
    const T t = u.y * (T(1) + w.z);
    const T radius = std::sqrt(std::max(T(0), t * (T(2) - t)));
    const T phi = T(2) * std::numbers::pi_v<T> * u.x;
    const T x = radius * std::cos(phi) + w.x;
    const T y = radius * std::sin(phi) + w.y;
    const T z = (T(1) - u.y) * (T(1) + w.z); // 1 - t + w.z
    // Flatten again.
    return glm::normalize(Vec3T<T>{alpha * x, alpha * y, z});
}
// [visible normals]

} // namespace detail

/// \}

} // namespace ljus
