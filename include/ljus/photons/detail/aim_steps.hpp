#pragma once

/// \file ljus/photons/detail/aim_steps.hpp
/// \brief The steps of aiming a photon: which object, which direction, how much flux.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>

#include "ljus/path/emission.hpp"

namespace ljus::detail {

/// \addtogroup emission
/// \{

/// A photon that was aimed at an object.
template <std::floating_point T>
struct AimedPhotonT {
    EmittedPhotonT<T> photon; ///< The photon.
    ObjectId target;          ///< It counts only if this is what it meets first.
};

/// How a point of a light aims at an object.
template <std::floating_point T>
struct AimT {
    ConeT<T> cone{};      ///< In which it sees the object's bounding sphere.
    bool at_area = false; ///< At points of the object's area instead of the cone.
    T size = T(0);        ///< About the solid angle over 2 pi: how often it is chosen.
};

/// A target that was chosen.
template <std::floating_point T>
struct ChosenTargetT {
    ObjectId target; ///< Its number.
    T sum = T(0);    ///< The sizes of all targets together.
};

/// Chooses a target in proportion to its size, as seen by a light.
/// \param targets   The objects.
/// \param size_of   Called with each; 0 leaves it out.
/// \param u_target  In [0, 1).
/// \return The target; nothing if none has a size.
template <std::floating_point T, typename SizeOf>
[[nodiscard]] std::optional<ChosenTargetT<T>>
choose_target(std::span<const ObjectId> targets, SizeOf size_of, T u_target) {
    ChosenTargetT<T> chosen;
    // Each takes the place of the one before with its share of the sum so far, and u is
    // stretched to [0, 1) again.
    for (const ObjectId candidate : targets) {
        const T size = size_of(candidate);
        if (!(size > T(0))) continue;
        chosen.sum += size;
        const T share = size / chosen.sum;
        if (u_target < share) {
            chosen.target = candidate;
            u_target /= share;
        } else {
            u_target = (u_target - share) / (T(1) - share);
        }
    }
    if (!(chosen.sum > T(0))) return std::nullopt;
    return chosen;
}

/// How much of its flux a light's point sends around a direction, per steradian; aimed
/// photons are paid for with it.
/// \param light      The light, no sun.
/// \param point      The point of it.
/// \param direction  Unit, away from it.
/// \return cos / pi, 1 / (4 pi) or a spot's intensity over its flux; 0 behind a lamp.
template <std::floating_point T>
[[nodiscard]] T emitted_share(const LightT<T>& light, const SurfacePointT<T>& point,
                              const Vec3T<T>& direction) noexcept {
    if (light.kind == LightKind::spot)
        return spot_share(light, direction) * std::numbers::inv_pi_v<T> /
               (light.inner + light.outer);
    if (!light.object) return pdf_uniform_sphere(direction);
    const T cosine = glm::dot(direction, point.normal);
    return cosine > T(0) ? cosine * std::numbers::inv_pi_v<T> : T(0);
}

/// A photon of a sun, aimed at one of several objects: at the discs that their bounding
/// spheres throw as shadows.
/// \param scene     The scene.
/// \param sun       How likely it was chosen, and which of the lights it is.
/// \param targets   The objects.
/// \param u_target  In [0, 1): which of them.
/// \param u_point   Point of the unit square: where in the disc.
/// \return The photon; its time and its light are still to be set. Nothing if all
///         targets are points.
template <SceneLike S, std::floating_point T>
[[nodiscard]] std::optional<AimedPhotonT<T>>
aim_sun(const S& scene, const ChosenLightT<T>& sun, std::span<const ObjectId> targets,
        T u_target, const Vec2T<T>& u_point) {
    const LightT<T>& light = scene.lights[sun.light];
    const auto bound_of = [&](ObjectId id) {
        return scene.visit_shape(id, [](const auto& s) { return bounding_sphere(s); });
    };
    const auto disc_of = [&](ObjectId id) {
        const T radius = bound_of(id).radius;
        return std::numbers::pi_v<T> * radius * radius;
    };
    const auto aimed = choose_target(targets, disc_of, u_target);
    if (!aimed) return std::nullopt;
    const SphereT<T> bound = bound_of(aimed->target);
    return AimedPhotonT<T>{{.ray = sun_ray(light, bound.center, bound.radius, u_point),
                            .flux = light.emission * (aimed->sum / sun.probability)},
                           aimed->target};
}

/// A direction towards an object, and its density.
template <std::floating_point T>
struct AimedDirectionT {
    Vec3T<T> direction{T(0)}; ///< Unit.
    T pdf = T(0);             ///< Per steradian.
};

/// Samples a direction as an aim says: uniform in the cone, or by the area of a flat
/// object.
/// \param scene   The scene.
/// \param aim     aim_at() the target.
/// \param from    The point of the light.
/// \param target  The object.
/// \param u       Point of the unit square.
/// \param time    Of the photon, in [0, 1].
/// \return The direction; its density may be 0 or infinite for points of an object that
///         is seen edge-on, or in which the light's point lies.
template <SceneLike S, std::floating_point T>
[[nodiscard]] AimedDirectionT<T> sample_aim(const S& scene, const AimT<T>& aim,
                                            const Vec3T<T>& from, ObjectId target,
                                            const Vec2T<T>& u, T time) {
    if (aim.at_area) {
        const auto seen = scene.visit_shape(target, [&](const auto& shape) {
            return sample_towards(at_time(shape, time), from, u);
        });
        return {glm::normalize(seen.point.position - from), seen.pdf};
    }
    const Vec3T<T> local = sample_uniform_cone(u, aim.cone.one_minus_cos);
    return {to_world(frame_around(aim.cone.axis), local),
            pdf_uniform_cone(aim.cone.one_minus_cos)};
}

/// \}

} // namespace ljus::detail
