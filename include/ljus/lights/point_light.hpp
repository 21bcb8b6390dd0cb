#pragma once

/// \file ljus/lights/point_light.hpp
/// \brief A point light.

#include "ljus/lights/light.hpp"

namespace ljus {

/// \addtogroup light
/// \{

/// A light without extent. It casts hard shadows, and no ray can hit it.
template <std::floating_point T>
struct PointLightT {
    using Scalar = T;        ///< The precision of its numbers.
    Vec3T<T> position{T(0)}; ///< The position, in scene units.
    RgbT<T> intensity{T(1)}; ///< The intensity in W/sr, equal in all directions.
};
using PointLight = PointLightT<float>; ///< PointLightT in float.

/// \name A point light
/// \{

/// Checks a point light.
/// \throws std::invalid_argument  if the position is not finite, or if the intensity is
///         negative or not finite.
template <std::floating_point T>
void check(const PointLightT<T>& light) {
    require_finite("point light.position", light.position);
    require_radiance("point light.intensity", light.intensity);
}

/// The emitted flux in W: 4 pi times the intensity.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const PointLightT<T>& light) noexcept {
    return T(4) * std::numbers::pi_v<T> * light.intensity;
}

/// Samples the light for a shadow ray. The weight is intensity over squared distance,
/// and the pdf is 0.
/// \return Nothing at the position of the light.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const PointLightT<T>& light, const Vec3T<T>& from, const Vec2T<T>& /*u*/,
             T /*time*/) noexcept {
    return detail::sample_point(light.position, from,
                                [&](const Vec3T<T>&) { return light.intensity; });
}

/// The position of the light.
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

/// The density of sample_emission(): 1/(4 pi) per steradian.
template <std::floating_point T>
[[nodiscard]] T pdf_emission(const PointLightT<T>&, const Vec3T<T>&,
                             const Vec3T<T>& wo) noexcept {
    return pdf_uniform_sphere(wo);
}

/// \}
/// \}

} // namespace ljus
