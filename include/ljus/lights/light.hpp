#pragma once

/// \file ljus/lights/light.hpp
/// \brief What a light is: what is asked of it by shadow rays, photons and paths.

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
/// \brief Section 3.2.3: what a shadow ray runs to, and where photons start.
///
/// A type of light is a struct with a member type `Scalar` and functions beside it. All
/// lights have three of them:
///
/// | function                           | returns                                     |
/// |------------------------------------|---------------------------------------------|
/// | check(light)                       | nothing; throws, and names what is wrong    |
/// | power(light)                       | the flux that leaves it, W                  |
/// | sample_light(light, from, u, time) | a LightSampleT: where a shadow ray ends     |
///
/// How its photons leave it depends on where it is. A light that is near (NearLight)
/// has points, and sends photons from them:
///
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | emission_point(light, u, time)      | a point; on a surface a SurfacePointT      |
/// | sample_emission(light, point, u)    | the unit direction of a photon from there  |
/// | pdf_emission(light, point, wo)      | the density of that direction, per sr      |
///
/// A light from afar (FarLight) has a member `around`, the sphere around the scene, and
///
/// | function                            | returns                                    |
/// |-------------------------------------|--------------------------------------------|
/// | sample_arrival(light, u)            | a direction of travel, and the irradiance  |
///
/// What a light may have as well, and what happens without it:
///
/// \snippet{lineno} ljus/lights/light.hpp light hooks
/// \{

/// What arrives at a point from one sampled point of a light, if nothing is between.
template <std::floating_point T>
struct LightSampleT {
    SurfacePointT<T> point{}; ///< End of the shadow ray; its error bound is 0 unless it
                              ///< lies on a surface.
    Vec3T<T> wi{T(0)};        ///< Unit direction to the light.
    RgbT<T> weight{T(0)};     ///< Radiance / pdf; of a point or spot light
                              ///< intensity / distance^2; of a sun its irradiance.
    T pdf = T(0);             ///< Per steradian; 0 for what no path can meet.
};

/// Light that arrives from afar.
template <std::floating_point T>
struct ArrivalT {
    Vec3T<T> direction{T(0)}; ///< Unit, the way it travels.
    RgbT<T> irradiance{T(0)}; ///< W/m^2 on a surface that faces it, over the density of
                              ///< the direction where that was sampled.
};

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

/// What a point of a light sends at a distance: intensity / distance^2.
/// \param position   Of the light.
/// \param from       The lit point.
/// \param intensity  Called with the unit direction away from the light; W/sr.
/// \return The sample; nothing where no light arrives.
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

/// The light as it is within a scene, which may know more of it than its author: a sun
/// gets the sphere that it shines on, a spot the cosines of its angles.
/// \param light  As it was added.
/// \return The light itself, for a type that has no in_scene() of its own.
template <typename L, std::floating_point T>
[[nodiscard]] const L& in_scene(const L& light, const SphereT<T>& /*around*/) noexcept {
    return light;
}

/// A light as a scene keeps it.
template <typename L>
using InSceneT = std::remove_cvref_t<decltype(in_scene(
    std::declval<const L&>(), std::declval<const SphereT<typename L::Scalar>&>()))>;

/// A light with points from which its photons leave.
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

/// A light so far away that only directions matter.
template <typename L>
concept FarLight = requires(const L& light, const Vec2T<typename L::Scalar>& u) {
    { light.around } -> std::convertible_to<SphereT<typename L::Scalar>>;
    { sample_arrival(light, u) } -> std::same_as<ArrivalT<typename L::Scalar>>;
};

/// A light as a scene keeps it: see the head of this page.
template <typename L>
concept Light = requires(const L& light, const Vec3T<typename L::Scalar>& from,
                         const Vec2T<typename L::Scalar>& u, typename L::Scalar time) {
    { power(light) } -> std::same_as<RgbT<typename L::Scalar>>;
    {
        sample_light(light, from, u, time)
        } -> std::same_as<std::optional<LightSampleT<typename L::Scalar>>>;
    requires NearLight<L> || FarLight<L>;
};

/// What a program adds to a scene: it has a check(), and within the scene it is a
/// Light.
template <typename L>
concept LightSource = requires(const L& light) {
    typename L::Scalar;
    check(light);
    requires Light<InSceneT<L>>;
};

/// The radiance that a ray sees which leaves the scene in a direction: 0 for a light
/// that has no escaped_radiance() of its own.
template <typename L>
concept FillsSky = requires(const L& light,
                            const Vec3T<typename L::Scalar>& direction) {
    { escaped_radiance(light, direction) } -> std::same_as<RgbT<typename L::Scalar>>;
    { pdf_escaped(light, direction) } -> std::same_as<typename L::Scalar>;
};

namespace detail {

/// The hooks of a type of light.
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
        Hook{"form_factor", "its light in closed form", "by shadow rays alone",
             requires(L l, V from, T time) { form_factor(l, from, from, time); }},
        Hook{"center_sample", "its centre", "u = v = 1/2",
             requires(L l) { center_sample(l); }},
        // [light hooks]
    };
// clang-format on
}

/// The cone that holds all that a point of a light sends; every direction for a light
/// without an emission_cone().
template <typename L, typename Point>
[[nodiscard]] ConeT<typename L::Scalar> cone_of_emission(const L& light,
                                                         const Point& point) {
    if constexpr (requires { emission_cone(light, point); })
        return emission_cone(light, point);
    else
        return {};
}

/// The position of a point of a light.
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const SurfacePointT<T>& point) noexcept {
    return point.position;
}
/// Of a point that lies on no surface.
template <std::floating_point T>
[[nodiscard]] const Vec3T<T>& position_of(const Vec3T<T>& point) noexcept {
    return point;
}

/// A ray of a light from afar, through a disc, from the plane where the scene begins.
/// \param around     The sphere around the scene.
/// \param direction  Unit, the way the light travels.
/// \param center     Of the disc.
/// \param radius     Of the disc.
/// \param u          Point of the unit square: where in the disc.
/// \return The ray.
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

/// The area of the disc that a sphere throws as its shadow.
template <std::floating_point T>
[[nodiscard]] constexpr T disc_area(T radius) noexcept {
    return std::numbers::pi_v<T> * radius * radius;
}

} // namespace detail

/// \}

} // namespace ljus
