#pragma once

/// \file ljus/scene/light.hpp
/// \brief What shines: the emissive objects of a scene, and point lights.

#include <numbers>
#include <optional>

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

/// One light of a scene. Its number, the place in Scene::lights, goes with its photons.
template <std::floating_point T>
struct LightT {
    std::optional<ObjectId> object{}; ///< The emissive object; none for a point light.
    Vec3T<T> position{T(0)};          ///< Of a point light.
    RgbT<T> emission{T(0)}; ///< Radiance of an object, or intensity of a point.
    RgbT<T> flux{T(0)};     ///< W that leave the light in all.
};
using Light = LightT<float>; ///< LightT in float.

/// The flux of a diffuse emitter: its radiance over the hemisphere and its area.
/// \param radiance  W/(m^2 sr), the same in every direction.
/// \param area      In squared scene units.
/// \return pi L A, in W.
template <std::floating_point T>
[[nodiscard]] constexpr RgbT<T> diffuse_flux(const RgbT<T>& radiance, T area) noexcept {
    return std::numbers::pi_v<T> * area * radiance;
}

/// What arrives at a point from one sampled point of a light, if nothing is between.
template <std::floating_point T>
struct LightSampleT {
    SurfacePointT<T>
        point{};          ///< Where the shadow ray ends; a point light has no error.
    Vec3T<T> wi{T(0)};    ///< Unit direction to the light.
    RgbT<T> weight{T(0)}; ///< Radiance / pdf; of a point light intensity / distance^2.
    T pdf = T(0);         ///< Per steradian; 0 for a point light.
};

/// Samples a point of a light, for a shadow ray.
/// \param scene  The scene of the light.
/// \param light  One of its lights.
/// \param from   The lit point.
/// \param u      Point of the unit square.
/// \return The sample; nothing if the light does not shine in this direction: emission
///         is one-sided, along the normal.
/// \report{Section 3.2.3}
/// \erratum{The program behind the report leaves out the light's area and the inverse
///          square: a wall ten times as far was lit as brightly.}
// [sample_light]
template <typename Scene, std::floating_point T>
[[nodiscard]] std::optional<LightSampleT<T>>
sample_light(const Scene& scene, const LightT<T>& light, const Vec3T<T>& from,
             const Vec2T<T>& u) {
    if (!light.object) {
        const Vec3T<T> way = light.position - from;
        const T distance2 = glm::dot(way, way);
        if (!(distance2 > T(0))) return std::nullopt;
        const Vec3T<T> wi = way / std::sqrt(distance2);
        return LightSampleT<T>{.point{.position = light.position, .normal = -wi},
                               .wi = wi,
                               .weight = light.emission / distance2};
    }
    SeenPointT<T> seen = scene.visit_shape(*light.object, [&](const auto& shape) {
        return sample_towards(shape, from, u);
    });
    if (scene.object(*light.object).inside_out) seen.point.normal = -seen.point.normal;

    const Vec3T<T> wi = glm::normalize(seen.point.position - from);
    // Written so that NaN, from an observer on the light itself, is no light.
    if (!(glm::dot(wi, seen.point.normal) < T(0) && seen.pdf > T(0) &&
          std::isfinite(seen.pdf)))
        return std::nullopt;
    return LightSampleT<T>{.point = seen.point,
                           .wi = wi,
                           .weight = light.emission / seen.pdf,
                           .pdf = seen.pdf};
}
// [sample_light]

/// \}

} // namespace ljus
