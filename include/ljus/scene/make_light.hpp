#pragma once

/// \file ljus/scene/make_light.hpp
/// \brief The lights that are no objects, checked and with their flux.

#include <algorithm>

#include "ljus/math/require.hpp"
#include "ljus/scene/light.hpp"

namespace ljus {

/// \defgroup light_source What a light is
/// \brief What a scene takes as a light, besides objects that emit.
///
/// A type of light is a struct with public members, and two functions beside it:
///
/// | what              | what for                                                     |
/// |-------------------|--------------------------------------------------------------|
/// | check(light)      | throws std::invalid_argument, and names what is wrong        |
/// | make_light(light) | the LightT that a scene keeps, with a kind and with its flux |
///
/// A new one, say a bulb as a shop describes it, turns into a light of a known kind:
///
///     struct Bulb { Vec3 position; float watts; };
///     void check(const Bulb& bulb) { require_positive("bulb.watts", bulb.watts); }
///     Light make_light(const Bulb& bulb) {
///         const float intensity = bulb.watts / (4 * std::numbers::pi_v<float>);
///         return make_light(PointLight{bulb.position, Rgb{intensity}});
///     }
///
/// There is nothing else to be written: scenes, shadow rays and photons know the kinds.
/// \{

namespace detail {

/// Refuses a light whose flux is beyond the range of T, though its parts are not.
/// \param flux  W.
/// \throws std::invalid_argument  with the value.
template <std::floating_point T>
void require_flux(const RgbT<T>& flux) {
    require(is_finite(flux) && !is_black(flux), "the flux of a light", flux,
            "finite and above 0");
}

/// The unit vector along a direction of any length.
/// \param what  Its name.
/// \param way   The direction.
/// \throws std::invalid_argument  if it is not finite, or 0.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> unit_along(std::string_view what, const Vec3T<T>& way) {
    require_finite(what, way);
    // Scaled first: in float the square of 1e-30 is 0.
    const T most = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    require(most > T(0), what, way, "of a length above 0");
    return glm::normalize(way / most);
}

/// Lets a sun shine on the sphere around a box, a thousandth wider than it need be, so
/// that no rounding leaves a corner dark: its flux is E pi R^2.
/// \param sun   The light.
/// \param low   The least corner of the box.
/// \param high  The greatest one.
/// \throws std::invalid_argument  if the flux is beyond the range of T.
template <std::floating_point T>
void widen(LightT<T>& sun, const Vec3T<T>& low, const Vec3T<T>& high) {
    const Vec3T<T> half = (high - low) / T(2);
    sun.position = low + half;
    sun.radius = T(1.001) * glm::length(half);
    sun.flux = std::numbers::pi_v<T> * sun.radius * sun.radius * sun.emission;
    require_flux(sun.flux);
}

/// Whether a type is a light of a scene, in any precision.
template <typename L>
inline constexpr bool is_light = false;
/// Such is a light of a scene.
template <std::floating_point T>
inline constexpr bool is_light<LightT<T>> = true;

} // namespace detail

/// \name The lights of the library
/// \{

/// Refuses a light that no picture can be made with.
/// \throws std::invalid_argument  if a vector is not finite, a direction is 0, an
///         intensity or irradiance negative, or an angle out of range.
template <std::floating_point T>
void check(const PointLightT<T>& light) {
    require_finite("point light.position", light.position);
    require_radiance("point light.intensity", light.intensity);
}
template <std::floating_point T>
void check(const SpotLightT<T>& light) {
    require_finite("spot light.position", light.position);
    require_radiance("spot light.intensity", light.intensity);
    require(light.outer_degrees > T(0) && light.outer_degrees <= T(180),
            "spot light.outer_degrees", light.outer_degrees, "within (0, 180]");
    require(light.inner_degrees >= T(0) && light.inner_degrees <= light.outer_degrees,
            "spot light.inner_degrees", light.inner_degrees,
            "within [0, outer_degrees]");
    (void)detail::unit_along("spot light.direction", light.direction);
}
template <std::floating_point T>
void check(const SunLightT<T>& light) {
    require_radiance("sun light.irradiance", light.irradiance);
    (void)detail::unit_along("sun light.direction", light.direction);
}

/// A point light: its flux is 4 pi I.
/// \param light  The light, checked.
/// \return The light of a scene.
template <std::floating_point T>
[[nodiscard]] LightT<T> make_light(const PointLightT<T>& light) {
    return {.position = light.position,
            .emission = light.intensity,
            .flux = T(4) * std::numbers::pi_v<T> * light.intensity};
}

/// A spot light: with w = 1 - cos, its flux is \f$ 2\pi I \f$ times the area below a
/// curve that is 1 up to the inner w and falls to 0 at the outer one,
/// \f$ \pi I (w_i + w_o) \f$.
/// \param light  The light, checked.
/// \return The light of a scene.
template <std::floating_point T>
[[nodiscard]] LightT<T> make_light(const SpotLightT<T>& light) {
    const auto one_minus_cos = [](T degrees) { // by the half angle: no cancellation
        const T sine = std::sin(degrees * (std::numbers::pi_v<T> / T(360)));
        return T(2) * sine * sine;
    };
    LightT<T> made{.kind = LightKind::spot,
                   .position = light.position,
                   .emission = light.intensity,
                   .direction =
                       detail::unit_along("spot light.direction", light.direction),
                   .inner = one_minus_cos(light.inner_degrees),
                   .outer = one_minus_cos(light.outer_degrees)};
    made.flux = std::numbers::pi_v<T> * (made.inner + made.outer) * light.intensity;
    return made;
}

/// A sun; how much flux it has depends on what it shines on, which the scene knows.
/// \param light  The light, checked.
/// \return The light of a scene, without flux as yet.
template <std::floating_point T>
[[nodiscard]] LightT<T> make_light(const SunLightT<T>& light) {
    return {.kind = LightKind::sun,
            .emission = light.irradiance,
            .direction = detail::unit_along("sun light.direction", light.direction)};
}
/// \}

/// What a scene takes as a light: see the head of this page.
template <typename L>
concept LightSource = requires(const L& light) {
    check(light);
    requires detail::is_light<decltype(make_light(light))>;
};

namespace detail {

/// A light of any type, checked and made; they turn into it by themselves. A scene
/// takes this and not any L, so that a compiler says in one line what is no light.
template <std::floating_point T>
struct AnyLightT {
    LightT<T> made; ///< What make_light() has made.

    /// Checks a light and makes it.
    template <LightSource L>
    AnyLightT(const L& light) requires(
        std::same_as<decltype(make_light(light)), LightT<T>>)
        : made((check(light), make_light(light))) {}
};

} // namespace detail

/// \}

} // namespace ljus
