#pragma once

/// \file ljus/lights/sun_light.hpp
/// \brief Light from a single direction.

#include <algorithm>

#include "ljus/lights/light.hpp"

namespace ljus {

/// \addtogroup light
/// \{

/// Light from a single direction, as from a distant sun. Its flux is the light that
/// falls into the sphere around all shapes of the scene.
template <std::floating_point T>
struct SunLightT {
    using Scalar = T;             ///< The precision of its numbers.
    Vec3T<T> direction{0, -1, 0}; ///< Direction of travel; any length but 0.
    RgbT<T> irradiance{T(1)}; ///< The irradiance of a perpendicular surface, in W/m^2.
};
using SunLight = SunLightT<float>; ///< SunLightT in float.

/// A sun as its scene stores it.
template <std::floating_point T>
struct SunInSceneT {
    using Scalar = T;         ///< The precision of its numbers.
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel.
    RgbT<T> irradiance{T(0)}; ///< The irradiance of a perpendicular surface, in W/m^2.
    SphereT<T> around{};      ///< The sphere around the scene.
};

/// \name A sun
/// \{

/// Checks a sun.
/// \throws std::invalid_argument  if the direction is 0 or not finite, or if the
///         irradiance is negative or not finite.
template <std::floating_point T>
void check(const SunLightT<T>& light) {
    require_radiance("sun light.irradiance", light.irradiance);
    require_direction("sun light.direction", light.direction);
}

/// Prepares a sun, which must have passed check(), for its scene.
template <std::floating_point T>
[[nodiscard]] SunInSceneT<T> in_scene(const SunLightT<T>& light,
                                      const SphereT<T>& around) {
    return {.direction = detail::unit_along(light.direction),
            .irradiance = light.irradiance,
            .around = around};
}

/// The flux into the sphere around the scene, in W.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const SunInSceneT<T>& light) noexcept {
    return detail::disc_area(light.around.radius) * light.irradiance;
}

/// Samples the light for a shadow ray from a point within the sphere around the scene.
/// The ray ends outside the scene, on the plane where photons start. The weight is the
/// irradiance, and the pdf is 0.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const SunInSceneT<T>& light, const Vec3T<T>& from, const Vec2T<T>& /*u*/,
             T /*time*/) noexcept {
    const T way =
        glm::dot(from - light.around.center, light.direction) + light.around.radius;
    const Vec3T<T> end = from - std::max(way, T(0)) * light.direction;
    return LightSampleT<T>{.point{.position = end, .normal = light.direction},
                           .wi = -light.direction,
                           .weight = light.irradiance};
}

/// The direction and the irradiance of the sun's photons.
template <std::floating_point T>
[[nodiscard]] ArrivalT<T> sample_arrival(const SunInSceneT<T>& light,
                                         const Vec2T<T>&) noexcept {
    return {light.direction, light.irradiance};
}

/// \}
/// \}

} // namespace ljus
