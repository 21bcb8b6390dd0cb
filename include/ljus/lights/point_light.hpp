#pragma once

/// \file ljus/lights/point_light.hpp
/// \brief A point light.

#include "ljus/lights/light.hpp"

namespace ljus {

/// \addtogroup light
/// \{

/// A light without extent: it cannot be seen, and its shadows are hard.
template <std::floating_point T>
struct PointLightT {
    using Scalar = T;        ///< The precision.
    Vec3T<T> position{T(0)}; ///< In scene units.
    RgbT<T> intensity{T(1)}; ///< W/sr, equal in all directions.
};
using PointLight = PointLightT<float>; ///< PointLightT in float.

/// \name A point light
/// \{

/// Refuses an invalid light.
/// \throws std::invalid_argument  if the position is not finite, or the intensity
///         negative or not finite.
template <std::floating_point T>
void check(const PointLightT<T>& light) {
    require_finite("point light.position", light.position);
    require_radiance("point light.intensity", light.intensity);
}

/// The flux: 4 pi I, in W.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const PointLightT<T>& light) noexcept {
    return T(4) * std::numbers::pi_v<T> * light.intensity;
}

/// Samples the light for a shadow ray from a point.
/// \return I / distance^2 with the density 0; nothing at the light itself.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const PointLightT<T>& light, const Vec3T<T>& from, const Vec2T<T>& /*u*/,
             T /*time*/) noexcept {
    return detail::sample_point(light.position, from,
                                [&](const Vec3T<T>&) { return light.intensity; });
}

/// The origin of its photons.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> emission_point(const PointLightT<T>& light, const Vec2T<T>&,
                                      T) noexcept {
    return light.position;
}

/// Samples the unit direction of a photon, uniformly over the sphere.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_emission(const PointLightT<T>&, const Vec3T<T>&,
                                       const Vec2T<T>& u) noexcept {
    return sample_uniform_sphere(u);
}

/// The density of sample_emission(): 1 / (4 pi) per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_emission(const PointLightT<T>&, const Vec3T<T>&,
                             const Vec3T<T>& wo) noexcept {
    return pdf_uniform_sphere(wo);
}

/// \}
/// \}

} // namespace ljus
