#pragma once

/// \file ljus/photons/emission.hpp
/// \brief How a photon leaves a light.

#include "ljus/math/random.hpp"
#include "ljus/scene/light_choice.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \defgroup emission Photon emission
/// \brief Section 3.2.2: photons are "shot from all the light sources into the scene".
/// \{

/// A photon on its way.
template <std::floating_point T>
struct FlightT {
    RayT<T> ray{};      ///< Where it is and where it goes.
    RgbT<T> flux{T(0)}; ///< W, of all paths together: divide by how many are emitted.
    std::uint16_t light = 0; ///< The number of its light.
};

/// A photon of a light chosen by power, from a point uniform over its area, in a
/// direction with density cos / pi; of a point light, uniform over the sphere.
///
/// Each photon of a white light then carries the same flux, the scene's whole flux over
/// the number of photons; a coloured light's differs in its channels only.
/// \param scene   The scene.
/// \param choice  Of the scene's lights; at least one.
/// \param stream  Five numbers are drawn.
/// \return The photon; its flux is that of all paths together.
/// \report{Section 3.2.2}
/// \erratum{The program behind the report gives every light the same number of photons
///          and the same flux whatever its area, and multiplies the flux by the cosine
///          that the direction's density already holds.}
// [emit]
template <typename Scene>
[[nodiscard]] FlightT<typename Scene::Scalar>
emit(const Scene& scene, const LightChoice& choice, RandomStream& stream) {
    using T = typename Scene::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    const LightT<T>& light = scene.lights[chosen.light];
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    FlightT<T> flight{.flux = light.flux / chosen.probability,
                      .light = static_cast<std::uint16_t>(chosen.light)};
    if (!light.object) {
        flight.ray = {.origin = light.position,
                      .direction = sample_uniform_sphere(u_direction)};
        return flight;
    }
    const SurfacePointT<T> point = light_point(scene, light, u_point);
    const FrameT<T> frame = frame_around(point.normal);
    flight.ray =
        ray_from(point, to_world(frame, sample_cosine_hemisphere(u_direction)));
    return flight;
}
// [emit]

/// A point of an emissive object, uniform over its area, the normal where it shines to.
/// \param scene  The scene.
/// \param light  One of its lights that is an object.
/// \param u      Point of the unit square.
/// \return The point.
template <typename Scene, std::floating_point T>
[[nodiscard]] SurfacePointT<T> light_point(const Scene& scene, const LightT<T>& light,
                                           const Vec2T<T>& u) {
    SurfacePointT<T> point = scene.visit_shape(
        *light.object, [&](const auto& shape) { return sample_area(shape, u); });
    if (scene.object(*light.object).inside_out) point.normal = -point.normal;
    return point;
}

/// The objects that mirror or refract, for photons to be aimed at.
/// \param scene  The scene.
/// \return Their numbers, in the order of the scene.
template <typename Scene>
[[nodiscard]] std::vector<ObjectId> specular_objects(const Scene& scene) {
    std::vector<ObjectId> targets;
    for (std::uint32_t type = 0; type < scene.objects.size(); ++type)
        for (std::uint32_t i = 0; i < scene.objects[type].size(); ++i)
            if (scene.visit_material(
                    scene.objects[type][i].material,
                    [](const auto& m) { return has(lobes(m), Lobes::specular); }))
                targets.push_back({type, i});
    return targets;
}

/// A photon that was aimed at an object.
template <std::floating_point T>
struct AimedFlightT {
    FlightT<T> flight; ///< The photon.
    ObjectId target;   ///< It counts only if this is what it meets first.
};

/// How a point of a light aims at an object.
template <std::floating_point T>
struct AimT {
    ConeT<T> cone{};      ///< In which it sees the object's bounding sphere.
    bool at_area = false; ///< At points of the object's area instead of the cone.
    T size = T(0);        ///< About the solid angle over 2 pi: how often it is chosen.
};

/// Whether photons are aimed at a shape's area: flat shapes fill little of their
/// bounding spheres, nothing at all if seen from the side, and no ray meets one twice.
template <typename S>
[[nodiscard]] constexpr bool aims_at_area(const S&) noexcept {
    return requires(const S& shape) {
        cross_of_edges(shape);
    };
}

/// How a point of a light aims at an object: at the cone in which it sees the object's
/// bounding sphere, or at the points of a flat one. From inside of that sphere, a lamp
/// aims at all that it can shine on, and a point light everywhere.
/// \param scene   The scene.
/// \param light   One of its lights.
/// \param from    A point of the light.
/// \param target  The object.
/// \return The aim.
// [aim_at]
template <typename Scene, std::floating_point T>
[[nodiscard]] AimT<T> aim_at(const Scene& scene, const LightT<T>& light,
                             const SurfacePointT<T>& from, ObjectId target) {
    return scene.visit_shape(target, [&](const auto& shape) {
        const SphereT<T> bound = bounding_sphere(shape);
        const ConeT<T> cone = cone_towards(bound, from.position);
        if (cone.one_minus_cos == T(2) && light.object) // inside
            return AimT<T>{{from.normal, T(1)}, false, T(1)};
        if (cone.one_minus_cos == T(2) || !aims_at_area(shape))
            return AimT<T>{cone, false, cone.one_minus_cos};
        const Vec3T<T> way = bound.center - from.position;
        const T size =
            area(shape) * std::numbers::inv_pi_v<T> / (T(2) * glm::dot(way, way));
        return AimT<T>{cone, true, std::min(size, cone.one_minus_cos)};
    });
}
// [aim_at]

/// A photon aimed at one of several objects: at the cone in which the light's point
/// sees the object's bounding sphere, uniformly; a wide cone is chosen more often, so
/// that the density is the same, one over the sum of the cones, in all of them. A flat
/// object is aimed at point by point of its area instead.
///
/// The flux makes up for the density of the direction: it is multiplied by
/// \f$ (\cos\theta / \pi) / p(\omega) \f$, for a point light by
/// \f$ (1/4\pi) / p(\omega) \f$. Where objects overlap, each direction belongs to the
/// one that is met first; the caller drops the photons that were aimed at another.
/// \param scene    The scene.
/// \param choice   Of the scene's lights; at least one.
/// \param targets  The objects; at least one.
/// \param stream   Six numbers are drawn.
/// \return The photon; nothing if its direction lies behind the light, or if all
///         targets are points.
/// \cost One cone a target.
/// \report{Section 3.2.2.2} \cite jensen1996
/// \erratum{The program behind the report does not correct for the density of the
///          direction, and divides by the photons that were stored: a caustic's
///          brightness did not depend on how much light met the glass.}
// [aim]
template <typename Scene>
[[nodiscard]] std::optional<AimedFlightT<typename Scene::Scalar>>
aim(const Scene& scene, const LightChoice& choice, const std::vector<ObjectId>& targets,
    RandomStream& stream) {
    using T = typename Scene::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    const LightT<T>& light = scene.lights[chosen.light];
    const Vec2T<T> u_point = next_2d<T>(stream);
    T u_target = next_1d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);

    SurfacePointT<T> point{.position = light.position};
    if (light.object) point = light_point(scene, light, u_point);

    // Choose a target by its size: each takes the place of the one before
    // with its share of the sum so far, and u is stretched to [0, 1) again.
    T sum = T(0);
    ObjectId target;
    AimT<T> at;
    for (const ObjectId candidate : targets) {
        const AimT<T> seen = aim_at(scene, light, point, candidate);
        if (!(seen.size > T(0))) continue;
        sum += seen.size;
        const T share = seen.size / sum;
        if (u_target < share) {
            target = candidate;
            at = seen;
            u_target /= share;
        } else {
            u_target = (u_target - share) / (T(1) - share);
        }
    }
    if (!(sum > T(0))) return std::nullopt;

    Vec3T<T> direction =
        to_world(frame_around(at.cone.axis),
                 sample_uniform_cone(u_direction, at.cone.one_minus_cos));
    T pdf = pdf_uniform_cone(at.cone.one_minus_cos);
    if (at.at_area) {
        const SeenPointT<T> seen = scene.visit_shape(target, [&](const auto& shape) {
            return sample_towards(shape, point.position, u_direction);
        });
        direction = glm::normalize(seen.point.position - point.position);
        pdf = seen.pdf;
    }
    pdf *= at.size / sum; // of the choice
    if (!(pdf < std::numeric_limits<T>::infinity())) return std::nullopt; // edge-on
    const T cosine = glm::dot(direction, point.normal);
    if (light.object && !(cosine > T(0))) return std::nullopt;
    const T emitted = light.object ? cosine * std::numbers::inv_pi_v<T>
                                   : pdf_uniform_sphere(direction);
    FlightT<T> flight{.flux = light.flux * (emitted / (pdf * chosen.probability)),
                      .light = static_cast<std::uint16_t>(chosen.light)};
    flight.ray = light.object
                     ? ray_from(point, direction)
                     : RayT<T>{.origin = point.position, .direction = direction};
    return AimedFlightT<T>{flight, target};
}
// [aim]

/// \}

} // namespace ljus
