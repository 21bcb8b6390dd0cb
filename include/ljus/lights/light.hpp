#pragma once

/// \file ljus/lights/light.hpp
/// \brief The interface of a light for shadow rays, photons and paths.

#include <algorithm>
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
/// \brief Section 3.2.3: the targets of shadow rays and the sources of photons.
///
/// A light is a struct with a member type `Scalar` and free functions beside it. All
/// lights have three of them:
///
/// | function                           | returns                                     |
/// |------------------------------------|---------------------------------------------|
/// | check(light)                       | nothing; throws, and names the wrong member |
/// | power(light)                       | the flux that leaves it, W                  |
/// | sample_light(light, from, u, time) | a LightSampleT for a shadow ray             |
///
/// There are two kinds of emission. A near light (NearLight) emits photons from its
/// points:
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | emission_point(light, u, time)      | a point; on a surface a SurfacePointT      |
/// | sample_emission(light, point, u)    | the unit direction of a photon from there  |
/// | pdf_emission(light, point, wo)      | the density of that direction, per sr      |
///
/// A distant light (FarLight) has a member `around`, the sphere around the scene, and
///
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | sample_arrival(light, u)            | a direction of travel, and the irradiance  |
///
/// The table lists the optional functions, their purpose, and what happens without
/// them:
///
/// \snippet{lineno} ljus/lights/light.hpp light hooks
/// \{

/// The unoccluded light from one sampled point of a light.
template <std::floating_point T>
struct LightSampleT {
    SurfacePointT<T> point{}; ///< End of the shadow ray; its error bound is 0 unless it
                              ///< lies on a surface.
    Vec3T<T> wi{T(0)};        ///< Unit direction to the light.
    RgbT<T> weight{T(0)};     ///< Radiance / pdf; intensity / distance^2 for a point or
                              ///< spot light; irradiance for a sun.
    T pdf = T(0);             ///< Per steradian; 0 if no path can hit the light.
};

/// The light that arrives from a distant light.
template <std::floating_point T>
struct ArrivalT {
    Vec3T<T> direction{T(0)}; ///< Unit direction of travel.
    RgbT<T> irradiance{T(0)}; ///< W/m^2 on a perpendicular surface; over the density of
                              ///< the direction if that was sampled.
};

namespace detail {

/// Refuses a flux that is 0 or leaves the range of T.
template <std::floating_point T>
void require_flux(const RgbT<T>& flux) {
    require(is_finite(flux) && !is_black(flux), "the flux of a light", flux,
            "finite and above 0");
}

/// The brightness by which a colour is sampled: the sum of its channels, as for the
/// choice of a light by power.
template <std::floating_point T>
[[nodiscard]] constexpr T brightness(const RgbT<T>& c) noexcept {
    return c.x + c.y + c.z;
}

/// Normalises a direction of any length.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> unit_along(std::string_view what, const Vec3T<T>& way) {
    require_finite(what, way);
    // Scaled first, because in float the square of 1e-30 is 0.
    const T most = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    require(most > T(0), what, way, "of a length above 0");
    return glm::normalize(way / most);
}

/// The sample of a point-like light: intensity / distance^2.
/// \param intensity  Called with the unit direction away from the light; W/sr.
/// \return The sample; nothing if no light arrives.
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

/// Prepares a light for its scene: a sun receives the sphere around the scene, a spot
/// the cosines of its angles. By default the light is unchanged.
template <typename L, std::floating_point T>
[[nodiscard]] const L& in_scene(const L& light, const SphereT<T>& /*around*/) noexcept {
    return light;
}

/// A light as its scene stores it.
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

/// A light so distant that only directions matter.
template <typename L>
concept FarLight = requires(const L& light, const Vec2T<typename L::Scalar>& u) {
    { light.around } -> std::convertible_to<SphereT<typename L::Scalar>>;
    { sample_arrival(light, u) } -> std::same_as<ArrivalT<typename L::Scalar>>;
};

/// A light as its scene stores it; see the group \ref light.
template <typename L>
concept Light = requires(const L& light, const Vec3T<typename L::Scalar>& from,
                         const Vec2T<typename L::Scalar>& u, typename L::Scalar time) {
    { power(light) } -> std::same_as<RgbT<typename L::Scalar>>;
    {
        sample_light(light, from, u, time)
        } -> std::same_as<std::optional<LightSampleT<typename L::Scalar>>>;
    requires NearLight<L> || FarLight<L>;
};

/// A light as a program adds it to a scene: it has check(), and in_scene() makes it a
/// Light.
template <typename L>
concept LightSource = requires(const L& light) {
    typename L::Scalar;
    check(light);
    requires Light<InSceneT<L>>;
};

/// A light that a ray sees when it leaves the scene: it has escaped_radiance().
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

/// The cone of all directions into which a point of a light emits; all directions for a
/// light without emission_cone().
template <typename L, typename Point>
[[nodiscard]] ConeT<typename L::Scalar> cone_of_emission(const L& light,
                                                         const Point& point) {
    if constexpr (requires { emission_cone(light, point); })
        return emission_cone(light, point);
    else
        return {};
}

/// The position of a point of a light, on a surface or not.
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const SurfacePointT<T>& point) noexcept {
    return point.position;
}
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const Vec3T<T>& point) noexcept {
    return point;
}

/// A ray of a distant light through a disc; it starts on a plane outside the scene.
/// \param u          Point of the unit square; chooses the point of the disc.
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

/// The area of the disc that a sphere casts as its shadow.
template <std::floating_point T>
[[nodiscard]] constexpr T disc_area(T radius) noexcept {
    return std::numbers::pi_v<T> * radius * radius;
}

} // namespace detail

/// \}

} // namespace ljus
