#pragma once

/// \file ljus/photons/aiming.hpp
/// \brief Photons that are sent where mirrors and glass are.

#include <algorithm>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "ljus/photons/detail/aim_steps.hpp"

namespace ljus {

/// \addtogroup emission
/// \{

/// The objects that mirror or refract, for photons to be aimed at.
/// \param scene  The scene.
/// \return Their numbers, in the order of the scene.
template <SceneLike S>
[[nodiscard]] std::vector<ObjectId> specular_objects(const S& scene) {
    std::vector<ObjectId> targets;
    for (std::uint32_t type = 0; type < scene.objects.size(); ++type)
        for (std::uint32_t i = 0; i < scene.objects[type].size(); ++i)
            if (scene.visit_material(
                    scene.objects[type][i].material,
                    [](const auto& m) { return has(lobes(m), Lobes::specular); }))
                targets.push_back({type, i});
    return targets;
}

namespace detail {

/// How a point of a light aims at an object: at the cone in which it sees the object's
/// bounding sphere, or at the points of a flat one. From inside of that sphere, a lamp
/// aims at all that it can shine on, and a point light everywhere. A spot light that is
/// narrower than the cone aims at all that it lights.
/// \param scene   The scene.
/// \param light   One of its lights.
/// \param from    A point of the light.
/// \param target  The object.
/// \return The aim.
// [aim_at]
template <SceneLike S, std::floating_point T>
[[nodiscard]] AimT<T> aim_at(const S& scene, const LightT<T>& light,
                             const SurfacePointT<T>& from, ObjectId target) {
    return scene.visit_shape(target, [&](const auto& shape) {
        const SphereT<T> bound = bounding_sphere(shape);
        const detail::ConeT<T> cone = detail::cone_towards(bound, from.position);
        if (light.kind == LightKind::spot && light.outer < cone.one_minus_cos)
            return AimT<T>{{light.direction, light.outer}, false, light.outer};
        if (cone.one_minus_cos == T(2) && light.object) // inside
            return AimT<T>{{from.normal, T(1)}, false, T(1)};
        if (cone.one_minus_cos == T(2) ||
            !FlatShape<std::remove_cvref_t<decltype(shape)>>)
            return AimT<T>{cone, false, cone.one_minus_cos};
        const Vec3T<T> way = bound.center - from.position;
        T size = T(0);
        if constexpr (HasArea<std::remove_cvref_t<decltype(shape)>>)
            size =
                area(shape) * std::numbers::inv_pi_v<T> / (T(2) * glm::dot(way, way));
        return AimT<T>{cone, true, std::min(size, cone.one_minus_cos)};
    });
}
// [aim_at]

} // namespace detail

/// A photon of a point light, aimed at one ball: the plain twin of aim(). The light
/// sends \f$1/4\pi\f$ of its flux into each steradian, and the ball is seen in a cone
/// of \f$2\pi(1 - \cos\theta)\f$ of them, which the photons share.
/// \param light  A point light.
/// \param ball   The target; the light is outside of it.
/// \param u      Point of the unit square: where in the cone.
/// \return The photon; its flux is that of all paths together.
/// \report{Section 3.2.2.2}
// [aim_at_ball]
template <std::floating_point T>
[[nodiscard]] EmittedPhotonT<T> aim_at_ball(const LightT<T>& light,
                                            const SphereT<T>& ball,
                                            const Vec2T<T>& u) noexcept {
    const detail::ConeT<T> cone = detail::cone_towards(ball, light.position);
    const Vec3T<T> local = sample_uniform_cone(u, cone.one_minus_cos);
    return {.ray{.origin = light.position,
                 .direction = to_world(frame_around(cone.axis), local)},
            .flux = light.flux * (cone.one_minus_cos / T(2))};
}
// [aim_at_ball]

/// A photon aimed at one of several objects: at the cone in which the light's point
/// sees the object's bounding sphere, uniformly; a wide cone is chosen more often, so
/// that the density is the same, one over the sum of the cones, in all of them. A flat
/// object is aimed at point by point of its area instead.
///
/// The flux makes up for the density of the direction: it is multiplied by
/// \f$ (\cos\theta / \pi) / p(\omega) \f$, for a point light by
/// \f$ (1/4\pi) / p(\omega) \f$. A sun aims at the discs that the bounding spheres
/// throw as shadows. Where objects overlap, each ray belongs to the one that is met
/// first; the caller drops the photons that were aimed at another.
/// \param scene    The scene.
/// \param choice   Of the scene's lights; at least one.
/// \param targets  The objects; at least one.
/// \param stream   Six numbers are drawn.
/// \return The photon; nothing behind the light, or if all targets are points.
/// \cost One cone a target.
/// \report{Section 3.2.2.2} \cite jensen1996
/// \erratum{The program behind the report does not correct for the density of the
///          direction, and divides by the photons that were stored: a caustic's
///          brightness did not depend on how much light met the glass.}
// [aim]
template <SceneLike S, typename Stream>
[[nodiscard]] std::optional<detail::AimedPhotonT<typename S::Scalar>>
aim(const S& scene, const LightChoice& choice, std::span<const ObjectId> targets,
    Stream& stream) {
    using T = typename S::Scalar;
    const detail::ChosenLightT<T> chosen =
        detail::choose_light(choice, next_1d<T>(stream));
    const LightT<T>& light = scene.lights[chosen.light];
    const Vec2T<T> u_point = next_2d<T>(stream);
    const T u_target = next_1d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    const T time = detail::path_time(scene, stream);
    const auto number = static_cast<std::uint16_t>(chosen.light);

    if (light.kind == LightKind::sun) {
        auto aimed = detail::aim_sun(scene, chosen, targets, u_target, u_point);
        if (!aimed) return std::nullopt;
        aimed->photon.ray.time = time;
        aimed->photon.light = number;
        return aimed;
    }

    SurfacePointT<T> point{.position = light.position};
    if (light.object) point = detail::light_point(scene, light, u_point, time);
    const auto size_of = [&](ObjectId id) {
        return detail::aim_at(scene, light, point, id).size;
    };
    const auto aimed = detail::choose_target(targets, size_of, u_target);
    if (!aimed) return std::nullopt;

    const detail::AimT<T> at = detail::aim_at(scene, light, point, aimed->target);
    auto [direction, pdf] =
        detail::sample_aim(scene, at, point.position, aimed->target, u_direction, time);
    pdf *= at.size / aimed->sum;                                  // of the choice
    if (!(pdf > T(0) && std::isfinite(pdf))) return std::nullopt; // edge-on, or at it
    const T emitted = detail::emitted_share(light, point, direction);
    if (!(emitted > T(0))) return std::nullopt;
    RayT<T> ray = light.object
                      ? spawn_ray(point, direction)
                      : RayT<T>{.origin = point.position, .direction = direction};
    ray.time = time;
    return detail::AimedPhotonT<T>{
        {.ray = ray,
         .flux = light.flux * (emitted / (pdf * chosen.probability)),
         .light = number},
        aimed->target};
}
// [aim]

/// \}

} // namespace ljus
