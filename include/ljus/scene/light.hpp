#pragma once

/// \file ljus/scene/light.hpp
/// \brief What emits: the emissive objects of a scene, points, spots and suns.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "ljus/geometry/moving.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "ljus/scene/object.hpp"

namespace ljus {

/// \defgroup light Lights
/// \brief Section 3.2.3: what a shadow ray runs to, and where photons start.
/// \{

/// A light without a size: it cannot be seen, and its shadows are hard.
template <std::floating_point T>
struct PointLightT {
    Vec3T<T> position{T(0)}; ///< In scene units.
    RgbT<T> intensity{T(1)}; ///< W/sr, the same in every direction.
};
using PointLight = PointLightT<float>; ///< PointLightT in float.

/// A lamp without a size that shines into a cone: evenly up to an inner angle, and from
/// there less and less, in proportion to the cosine, until it is dark at the outer one.
template <std::floating_point T>
struct SpotLightT {
    Vec3T<T> position{T(0)};      ///< In scene units.
    Vec3T<T> direction{0, -1, 0}; ///< Where it shines to; of any length but 0.
    RgbT<T> intensity{T(1)};      ///< W/sr within the inner cone.
    T inner_degrees = T(20);      ///< Half angle of the even part.
    T outer_degrees = T(30);      ///< Half angle of it all, up to 180.
};
using SpotLight = SpotLightT<float>; ///< SpotLightT in float.

/// Light that comes from one direction only, as from a sun far away.
template <std::floating_point T>
struct SunLightT {
    Vec3T<T> direction{0, -1, 0}; ///< Where it shines to; of any length but 0.
    RgbT<T> irradiance{T(1)};     ///< W/m^2 on a surface that faces it.
};
using SunLight = SunLightT<float>; ///< SunLightT in float.

/// The kinds of lights.
enum class LightKind : std::uint8_t {
    object, ///< The emissive surface of an object.
    point,  ///< PointLightT.
    spot,   ///< SpotLightT.
    sun     ///< SunLightT.
};

/// One light of a scene. Its number, the place in Scene::lights, goes with its photons.
template <std::floating_point T>
struct LightT {
    LightKind kind = LightKind::point; ///< What it is.
    std::optional<ObjectId> object{};  ///< The emissive object; none for other kinds.
    Vec3T<T> position{T(0)}; ///< Of a point or spot light; of a sun, the middle of the
                             ///< scene.
    RgbT<T> emission{T(0)};  ///< Radiance of an object, intensity of a point or spot,
                             ///< irradiance of a sun.
    RgbT<T> flux{T(0)}; ///< W that leave the light in all; of a sun, that fall into the
                        ///< sphere around the scene.
    Vec3T<T> direction{T(0)}; ///< Unit; where a spot or a sun shines to; of a flat
                              ///< object, its shape's normal.
    T inner = T(0);           ///< 1 - cos of a spot's inner angle.
    T outer = T(0);           ///< 1 - cos of a spot's outer angle.
    T radius = T(0);          ///< Of the sphere around the scene, for a sun.
    T area = T(0);            ///< Of a flat object; else 0.
};
using Light = LightT<float>; ///< LightT in float.

namespace detail {

/// The share of its intensity that a spot light sends into a direction.
/// \param light  The spot light.
/// \param wo     Unit direction away from it.
/// \return 1 within the inner cone, 0 outside of the outer one.
template <std::floating_point T>
[[nodiscard]] T spot_share(const LightT<T>& light, const Vec3T<T>& wo) noexcept {
    // As |a - b|^2 / 2, which keeps the digits of a narrow cone; 1 - cos would not.
    const Vec3T<T> apart = wo - light.direction;
    const T w = glm::dot(apart, apart) / T(2);
    if (w <= light.inner) return T(1);
    return w < light.outer ? (light.outer - w) / (light.outer - light.inner) : T(0);
}

/// 1 - cos of the angle of a spot light's photon from the axis, with the density of its
/// intensity: even up to `inner`, then falling to 0 at `outer`.
/// \param light  The spot light.
/// \param u      In [0, 1).
/// \return Within [0, outer].
// [sample_spot]
template <std::floating_point T>
[[nodiscard]] T sample_spot(const LightT<T>& light, T u) noexcept {
    const T both = light.inner + light.outer; // twice the area below the curve
    if (u * both < T(2) * light.inner) return u * both / T(2);
    const T beyond = (T(1) - u) * both * (light.outer - light.inner);
    return light.outer - std::sqrt(beyond);
}
// [sample_spot]

/// The flux of a diffuse emitter: its radiance over the hemisphere and its area.
/// \param radiance  W/(m^2 sr), the same in every direction.
/// \param area      In squared scene units.
/// \return pi L A, in W.
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> diffuse_flux(const RgbT<T>& radiance, T area) noexcept {
    return std::numbers::pi_v<T> * area * radiance;
}

} // namespace detail

/// What arrives at a point from one sampled point of a light, if nothing is between.
template <std::floating_point T>
struct LightSampleT {
    SurfacePointT<T> point{}; ///< Where the shadow ray ends; of no object, no error.
    Vec3T<T> wi{T(0)};        ///< Unit direction to the light.
    RgbT<T> weight{T(0)};     ///< Radiance / pdf; of a point or spot light
                              ///< intensity / distance^2; of a sun its irradiance.
    T pdf = T(0);             ///< Per steradian; 0 for what no path can meet.
};

namespace detail {

/// sample_light() of an emissive object. The sample is filled where it will stand: a
/// copy of numbers that have just been written, in wider pieces, makes a processor
/// wait.
template <typename S, std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_lamp(const S& scene, const LightT<T>& light, const Vec3T<T>& from,
            const Vec2T<T>& u, T time) {
    std::optional<LightSampleT<T>> sample(std::in_place);
    SurfacePointT<T>& point = sample->point;
    scene.visit_shape(*light.object, [&]<typename G>(const G& shape) {
        if constexpr (is_plane<G>)
            if (light.area > T(0)) { // what add() has worked out once
                set_point(point, sample_area(shape, u, light.direction));
                sample->pdf = pdf_from_area(from, point, light.area);
                return;
            }
        const SeenPointT<T> seen = sample_towards(at_time(shape, time), from, u);
        set_point(point, seen.point);
        sample->pdf = seen.pdf;
    });
    if (scene.object(*light.object).inside_out) point.normal = -point.normal;

    const T pdf = sample->pdf;
    sample->wi = glm::normalize(point.position - from);
    sample->weight = light.emission / pdf;
    // Written so that NaN, from an observer on the light itself, is no light.
    if (!(glm::dot(sample->wi, point.normal) < T(0) && pdf > T(0) &&
          std::isfinite(pdf)))
        sample.reset();
    return sample;
}

} // namespace detail

/// Samples a point of a light, for a shadow ray.
/// \param scene  The scene of the light.
/// \param light  One of its lights.
/// \param from   The lit point; under a sun, within the sphere around the scene.
/// \param u      Point of the unit square.
/// \param time   Of the path, in [0, 1].
/// \return The sample; nothing if the light does not shine in this direction: emission
///         is one-sided, along the normal.
/// \report{Section 3.2.3}
/// \erratum{The program behind the report leaves out the light's area and the inverse
///          square: a wall ten times as far was lit as brightly.}
template <typename S, std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const S& scene, const LightT<T>& light, const Vec3T<T>& from,
             const Vec2T<T>& u, T time = T(0)) {
    if (light.kind == LightKind::sun) {
        // The shadow ray ends where photons start: on a plane beside the scene.
        const T way = glm::dot(from - light.position, light.direction) + light.radius;
        const Vec3T<T> end = from - std::max(way, T(0)) * light.direction;
        return LightSampleT<T>{.point{.position = end, .normal = light.direction},
                               .wi = -light.direction,
                               .weight = light.emission};
    }
    if (!light.object) {
        const Vec3T<T> way = light.position - from;
        const T distance2 = glm::dot(way, way);
        if (!(distance2 > T(0))) return std::nullopt;
        const Vec3T<T> wi = way / std::sqrt(distance2);
        const T share =
            light.kind == LightKind::spot ? detail::spot_share(light, -wi) : T(1);
        if (!(share > T(0))) return std::nullopt;
        return LightSampleT<T>{.point{.position = light.position, .normal = -wi},
                               .wi = wi,
                               .weight = share * light.emission / distance2};
    }
    return detail::sample_lamp(scene, light, from, u, time);
}

/// \}

} // namespace ljus
