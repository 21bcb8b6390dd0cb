#pragma once

/// \file ljus/lights/spot_light.hpp
/// \brief A point light that shines into a cone.

#include "ljus/lights/light.hpp"

namespace ljus {

/// \addtogroup light
/// \{

/// A light without extent that shines into a cone. Its intensity is constant up to an
/// inner angle. From there to an outer angle it falls to 0, linearly in the cosine.
template <std::floating_point T>
struct SpotLightT {
    using Scalar = T;             ///< The precision of its numbers.
    Vec3T<T> position{T(0)};      ///< The position, in scene units.
    Vec3T<T> direction{0, -1, 0}; ///< Axis of the cone; any length but 0.
    RgbT<T> intensity{T(1)};      ///< The intensity within the inner cone, in W/sr.
    /// The inner angle to the axis in degrees, from 0 to the outer angle.
    T inner_degrees = T(20);
    /// The outer angle to the axis in degrees, from 0.001 to 180.
    T outer_degrees = T(30);
};
using SpotLight = SpotLightT<float>; ///< SpotLightT in float.

/// A spot light as its scene stores it.
template <std::floating_point T>
struct SpotInSceneT {
    using Scalar = T;         ///< The precision of its numbers.
    Vec3T<T> position{T(0)};  ///< The position, in scene units.
    Vec3T<T> direction{T(0)}; ///< Axis of the cone; unit vector.
    RgbT<T> intensity{T(0)};  ///< The intensity within the inner cone, in W/sr.
    T inner = T(0);           ///< 1 - cos of the inner angle.
    T outer = T(0);           ///< 1 - cos of the outer angle.
};

/// \name A spot light
/// \{

/// Checks a spot light.
/// \throws std::invalid_argument  if a member is not finite, the direction is 0, the
///         intensity is negative, or an angle is out of range.
template <std::floating_point T>
void check(const SpotLightT<T>& light) {
    require_finite("spot light.position", light.position);
    require_radiance("spot light.intensity", light.intensity);
    // A narrower cone would contain only a few directions in float.
    require(light.outer_degrees >= T(0.001) && light.outer_degrees <= T(180),
            "spot light.outer_degrees", light.outer_degrees, "within [0.001, 180]");
    require(light.inner_degrees >= T(0) && light.inner_degrees <= light.outer_degrees,
            "spot light.inner_degrees", light.inner_degrees,
            detail::join({"within [0, outer_degrees], and outer_degrees is ",
                          to_text(light.outer_degrees)}));
    require_direction("spot light.direction", light.direction);
}

/// Prepares a spot light, which must have passed check(), for its scene.
template <std::floating_point T>
[[nodiscard]] SpotInSceneT<T> in_scene(const SpotLightT<T>& light, const SphereT<T>&) {
    const auto one_minus_cos = [](T degrees) { // by the half angle: no cancellation
        const T sine = std::sin(degrees * (std::numbers::pi_v<T> / T(360)));
        return T(2) * sine * sine;
    };
    return {.position = light.position,
            .direction = detail::unit_along(light.direction),
            .intensity = light.intensity,
            .inner = one_minus_cos(light.inner_degrees),
            .outer = one_minus_cos(light.outer_degrees)};
}

/// The emitted flux in W: \f$ \pi I (w_i + w_o) \f$, where I is the intensity, and w_i
/// and w_o are 1 - cos of the inner and the outer angle.
template <std::floating_point T>
[[nodiscard]] RgbT<T> power(const SpotInSceneT<T>& light) noexcept {
    return std::numbers::pi_v<T> * (light.inner + light.outer) * light.intensity;
}

namespace detail {

/// The factor of the intensity in a direction.
/// \return 1 within the inner cone, 0 outside the outer cone, and between them a number
///         that is linear in the cosine.
template <std::floating_point T>
[[nodiscard]] T fall_off(const SpotInSceneT<T>& light, const Vec3T<T>& wo) noexcept {
    // 1 - cos of the angle of two unit vectors is |a - b|^2 / 2, also for small angles.
    const Vec3T<T> apart = wo - light.direction;
    const T w = glm::dot(apart, apart) / T(2);
    if (w <= light.inner) return T(1);
    return w < light.outer ? (light.outer - w) / (light.outer - light.inner) : T(0);
}

/// Samples a photon's angle to the axis, in proportion to the flux at this angle.
/// \return 1 - cos of the angle, within [0, light.outer].
// [sample_spot]
template <std::floating_point T>
[[nodiscard]] T sample_spot(const SpotInSceneT<T>& light, T u) noexcept {
    const T both = light.inner + light.outer; // twice the integral of fall_off()
    if (u * both < T(2) * light.inner) return u * both / T(2);
    const T beyond = (T(1) - u) * both * (light.outer - light.inner);
    return light.outer - std::sqrt(beyond);
}
// [sample_spot]

} // namespace detail

/// Samples the light for a shadow ray. The weight is intensity over squared distance,
/// and the pdf is 0.
/// \return Nothing outside the cone.
template <std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const SpotInSceneT<T>& light, const Vec3T<T>& from, const Vec2T<T>& /*u*/,
             T /*time*/) noexcept {
    return detail::sample_point(light.position, from, [&](const Vec3T<T>& wo) {
        return detail::fall_off(light, wo) * light.intensity;
    });
}

/// The position of the light.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> emission_point(const SpotInSceneT<T>& light, const Vec2T<T>&,
                                      T) noexcept {
    return light.position;
}

/// Samples the unit direction of a photon, in proportion to the intensity.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_emission(const SpotInSceneT<T>& light, const Vec3T<T>&,
                                       const Vec2T<T>& u) noexcept {
    const T share = detail::sample_spot(light, u.x) / light.outer;
    const Vec3T<T> local = sample_uniform_cone(Vec2T<T>{share, u.y}, light.outer);
    return to_world(frame_around(light.direction), local);
}

/// The density of sample_emission(), per steradian: intensity over emitted flux.
template <std::floating_point T>
[[nodiscard]] T pdf_emission(const SpotInSceneT<T>& light, const Vec3T<T>&,
                             const Vec3T<T>& wo) noexcept {
    return detail::fall_off(light, wo) * std::numbers::inv_pi_v<T> /
           (light.inner + light.outer);
}

/// The cone into which the light shines.
template <std::floating_point T>
[[nodiscard]] detail::ConeT<T> emission_cone(const SpotInSceneT<T>& light,
                                             const Vec3T<T>&) noexcept {
    return {light.direction, light.outer};
}

/// \}
/// \}

} // namespace ljus
