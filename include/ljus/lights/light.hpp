#pragma once

/// \file ljus/lights/light.hpp
/// \brief The interface of a light for shadow rays, photons and paths.

#include <array>
#include <cmath>
#include <concepts>
#include <numbers>
#include <optional>

#include "ljus/geometry/sphere.hpp"
#include "ljus/hook.hpp"
#include "ljus/math/require.hpp"

namespace ljus {

/// \defgroup light Lights
/// \brief Section 3.2.3 of the report: the targets of shadow rays and the sources of
/// photons.
///
/// A light is a struct with a member type `Scalar` and free functions. All lights have
/// these three functions:
///
/// | function                           | returns                                     |
/// |------------------------------------|---------------------------------------------|
/// | check(light)                       | nothing; throws if a member has a bad value |
/// | power(light)                       | the emitted flux, W                         |
/// | sample_light(light, from, u, time) | a LightSampleT for a shadow ray             |
///
/// A light is near or distant. A near light (NearLight) emits photons from its points,
/// and has the functions
///
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | emission_point(light, u, time)      | a point; on a surface a SurfacePointT      |
/// | sample_emission(light, point, u)    | the unit direction of a photon             |
/// | pdf_emission(light, point, wo)      | the density of sample_emission(), per sr   |
///
/// A distant light (FarLight) has a member `around`, the sphere around the scene, and
/// the function
///
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | sample_arrival(light, u)            | a direction of travel, and the irradiance  |
///
/// Lights may have more functions. The following list gives the name of each, its
/// purpose, and what happens without it:
///
/// \snippet{lineno} ljus/lights/light.hpp light hooks
/// \{

/// The unoccluded light from one sampled point of a light.
template <std::floating_point T>
struct LightSampleT {
    /// End of the shadow ray. Its error bound is 0 unless the point lies on a surface.
    SurfacePointT<T> point{};
    Vec3T<T> wi{T(0)}; ///< Unit direction to the light.
    /// Radiance over pdf for a light that paths can hit; intensity over squared
    /// distance for a light without extent; irradiance for a sun.
    RgbT<T> weight{T(0)};
    T pdf = T(0); ///< Density of `wi` per steradian; 0 if no path can hit the light.
};

/// The light that arrives from a distant light.
template <std::floating_point T>
struct ArrivalT {
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel.
    /// Irradiance of a perpendicular surface, in W/m^2. If the direction was sampled,
    /// this is the radiance over the density of the direction.
    RgbT<T> irradiance{T(0)};
};

namespace detail {

/// Requires a flux that is finite and not 0.
template <std::floating_point T>
void require_flux(const RgbT<T>& flux) {
    require(is_finite(flux) && !is_black(flux), "the flux of a light", flux,
            "finite and above 0");
}

/// The brightness of a colour, for sampling: the sum of its channels.
template <std::floating_point T>
[[nodiscard]] constexpr T brightness(const RgbT<T>& c) noexcept {
    return c.x + c.y + c.z;
}

/// Normalises a direction that require_direction() accepts.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> unit_along(const Vec3T<T>& way) noexcept {
    // The direction is scaled first, because in float the square of 1e-30 is 0.
    return glm::normalize(way / max_component(glm::abs(way)));
}

/// The sample of a light without extent. Its weight is intensity over squared distance.
/// `intensity` returns W/sr for a unit direction away from the light.
/// \return Nothing if no light arrives.
template <std::floating_point T, typename Intensity>
[[nodiscard]] std::optional<LightSampleT<T>> sample_point(const Vec3T<T>& position,
                                                          const Vec3T<T>& from,
                                                          const Intensity& intensity) {
    const Vec3T<T> way = position - from;
    const T distance2 = glm::dot(way, way);
    if (!(distance2 > T(0))) return std::nullopt;
    const Vec3T<T> wi = way / std::sqrt(distance2);
    const RgbT<T> sent = intensity(-wi);
    if (is_black(sent)) return std::nullopt;
    return LightSampleT<T>{.point{.position = position, .normal = -wi},
                           .wi = wi,
                           .weight = sent / distance2};
}

} // namespace detail

/// Prepares a light for its scene. The sphere lies around the whole scene; only distant
/// lights use it. A light that needs no preparation is returned as it is.
template <typename L, std::floating_point T>
[[nodiscard]] const L& in_scene(const L& light, const SphereT<T>& /*around*/) noexcept {
    return light;
}

/// The type in which a scene stores a light: the result of in_scene().
template <typename L>
using InSceneT = std::remove_cvref_t<decltype(in_scene(
    std::declval<const L&>(), std::declval<const SphereT<typename L::Scalar>&>()))>;

/// A light that emits photons from its points.
template <typename L>
concept NearLight = requires(const L& light, const Vec2T<typename L::Scalar>& u,
                             typename L::Scalar time,
                             const Vec3T<typename L::Scalar>& wo) {
    emission_point(light, u, time);
    {
        sample_emission(light, emission_point(light, u, time), u)
        } -> std::same_as<Vec3T<typename L::Scalar>>;
    {
        pdf_emission(light, emission_point(light, u, time), wo)
        } -> std::same_as<typename L::Scalar>;
};

/// A light at infinity. Its radiance is the same at all points of the scene.
template <typename L>
concept FarLight = requires(const L& light, const Vec2T<typename L::Scalar>& u) {
    { light.around } -> std::convertible_to<SphereT<typename L::Scalar>>;
    { sample_arrival(light, u) } -> std::same_as<ArrivalT<typename L::Scalar>>;
};

/// A light as its scene stores it; see \ref light.
template <typename L>
concept Light = requires(const L& light, const Vec3T<typename L::Scalar>& from,
                         const Vec2T<typename L::Scalar>& u, typename L::Scalar time) {
    { power(light) } -> std::same_as<RgbT<typename L::Scalar>>;
    {
        sample_light(light, from, u, time)
        } -> std::same_as<std::optional<LightSampleT<typename L::Scalar>>>;
}
&&(NearLight<L> || FarLight<L>);

/// A light as a program adds it to a scene. It has check(), and in_scene() turns it
/// into a Light.
template <typename L>
concept LightSource = requires(const L& light) {
    typename L::Scalar;
    check(light);
}
&&Light<InSceneT<L>>;

/// A light that is seen by rays that leave the scene. It has escaped_radiance(), the
/// radiance from a direction, and pdf_escaped(), the density with which sample_light()
/// chooses this direction, per steradian.
template <typename L>
concept FillsSky = requires(const L& light,
                            const Vec3T<typename L::Scalar>& direction) {
    { escaped_radiance(light, direction) } -> std::same_as<RgbT<typename L::Scalar>>;
    { pdf_escaped(light, direction) } -> std::same_as<typename L::Scalar>;
};

namespace detail {

template <Light L>
[[nodiscard]] constexpr auto light_hooks() noexcept {
    using T = typename L::Scalar;
    using V = Vec3T<T>;
    // clang-format off
    return std::array{
        // [light hooks]
        Hook{"emission_cone", "photons aimed within what it lights", "anywhere",
             requires(L l, V point) { emission_cone(l, point); } ||
             requires(L l, SurfacePointT<T> point) { emission_cone(l, point); }},
        Hook{"escaped_radiance", "a sky that rays see", "black",
             requires(L l, V wo) { escaped_radiance(l, wo); }},
        Hook{"pdf_escaped", "a sky that rays see", "black",
             requires(L l, V wo) { pdf_escaped(l, wo); }},
        Hook{"flux_from", "photons of unequal flux", "power(light)",
             requires(L l, SurfacePointT<T> point) { flux_from(l, point); }},
        Hook{"form_factor", "its light in closed form", "by shadow rays alone",
             requires(L l, V from, T time) { form_factor(l, from, from, time); }},
        Hook{"center_sample", "its centre", "u = v = 1/2",
             requires(L l) { center_sample(l); }},
        // [light hooks]
    };
// clang-format on
}

/// A cone that contains all directions into which a point of a light emits.
template <typename L, typename Point>
[[nodiscard]] ConeT<typename L::Scalar> cone_of_emission(const L& light,
                                                         const Point& point) {
    if constexpr (requires { emission_cone(light, point); })
        return emission_cone(light, point);
    else
        return {};
}

/// The position of an emission_point(), which may or may not lie on a surface.
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const SurfacePointT<T>& point) noexcept {
    return point.position;
}
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const Vec3T<T>& point) noexcept {
    return point;
}

/// A ray of a distant light through a random point of a disc. The disc has the given
/// centre and radius, and is perpendicular to the unit direction of the ray. The ray
/// starts on a plane that touches the sphere `around` the scene.
template <std::floating_point T>
[[nodiscard]] RayT<T> ray_from_afar(const SphereT<T>& around, const Vec3T<T>& direction,
                                    const Vec3T<T>& center, T radius,
                                    const Vec2T<T>& u) {
    const Vec2T<T> disc = radius * sample_concentric_disc(u);
    const FrameT<T> frame = frame_around(direction);
    const T back = glm::dot(center - around.center, direction) + around.radius;
    return {.origin = center + to_world(frame, Vec3T<T>{disc.x, disc.y, -back}),
            .direction = direction};
}

/// The area of a disc.
template <std::floating_point T>
[[nodiscard]] constexpr T disc_area(T radius) noexcept {
    return std::numbers::pi_v<T> * radius * radius;
}

} // namespace detail

/// \}

} // namespace ljus
