#pragma once

/// \file ljus/photons/aiming.hpp
/// \brief Photons aimed at mirrors and glass.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "ljus/lights/point_light.hpp"
#include "ljus/photons/photon_path.hpp"
#include "ljus/ref.hpp"

namespace ljus {

/// \addtogroup emission
/// \{

/// The targets of aimed photons: all objects with specular lobes, in the order of the
/// scene.
/// \param world  The closed scene.
/// \param gloss  Whether objects with a nearly_specular() material are also targets.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::vector<ObjectId> specular_objects(const W& world,
                                                                bool gloss = false) {
    std::vector<ObjectId> targets;
    const auto counts = [gloss](const auto& m) {
        return has(lobes(m), Lobes::specular) || (gloss && nearly_specular(m));
    };
    world.each_object([&](ObjectId id, const auto& object) {
        if (world.visit_material(object.material, counts)) targets.push_back(id);
    });
    return targets;
}

/// A photon aimed at an object.
template <std::floating_point T>
struct AimedPhotonT {
    EmittedPhotonT<T> photon; ///< The photon.
    ObjectId target;          ///< The photon counts only if the first object that it
                              ///< hits is this one or one of `others`.
    /// All objects that fill the cone in which the light emits, if the photon is aimed
    /// at several of them at once; otherwise empty.
    std::vector<ObjectId> others{};
};

/// Aims a photon of a point light at a ball: the plain counterpart of aim(). The light
/// emits \f$1/4\pi\f$ of its flux per steradian. All photons together carry the flux
/// into the cone around the ball. If theta is half the opening angle, this cone covers
/// \f$2\pi(1 - \cos\theta)\f$ steradians.
/// \param light  A point light.
/// \param ball   The target. The light must be outside the ball.
/// \param u      Point of the unit square; chooses the direction in the cone.
/// \return The photon, with the flux of all photons together.
/// \report{Section 3.2.2.2}
// [aim_at_ball]
template <std::floating_point T>
[[nodiscard]] EmittedPhotonT<T> aim_at_ball(const PointLightT<T>& light,
                                            const SphereT<T>& ball,
                                            const Vec2T<T>& u) noexcept {
    const detail::ConeT<T> cone = detail::cone_towards(ball, light.position);
    const Vec3T<T> local = sample_uniform_cone(u, cone.one_minus_cos);
    return {.ray{.origin = light.position,
                 .direction = to_world(frame_around(cone.axis), local)},
            .flux = power(light) * (cone.one_minus_cos / T(2))};
}
// [aim_at_ball]

namespace detail {

/// How a point of a light aims at an object.
template <std::floating_point T>
struct AimT {
    ConeT<T> cone{}; ///< The cone into which the point aims.
    /// Whether the point aims at the object's area instead of the cone.
    bool at_area = false;
    /// Weight of the object when a target is chosen: approximately the solid angle that
    /// the object covers, divided by 2 pi.
    T size = T(0);
    bool at_all = false; ///< Whether the point aims at the light's cone of emission.
};

/// Chooses how a point of a light aims at an object: at the cone of directions to the
/// object's bounding sphere or, if the object is flat, at its area. If the cone of
/// emission is narrower, as for a spot light or a lamp inside the bounding sphere, the
/// point aims at the cone of emission instead.
/// \param emission  The cone of all directions of emission.
/// \param from      The point of the light.
// [aim_at]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] AimT<T> aim_at(const W& world, const ConeT<T>& emission,
                             const Vec3T<T>& from, ObjectId target) {
    return world.visit_shape(target, [&]<typename G>(const G& shape) {
        const SphereT<T> bound = bounding_sphere(shape);
        const ConeT<T> cone = cone_towards(bound, from);
        if (emission.one_minus_cos <= cone.one_minus_cos)
            return AimT<T>{emission, false, emission.one_minus_cos, true};
        if (!FlatShape<G>) return AimT<T>{cone, false, cone.one_minus_cos};
        const Vec3T<T> way = bound.center - from;
        T size = T(0);
        if constexpr (HasArea<G>)
            size =
                area(shape) * std::numbers::inv_pi_v<T> / (T(2) * glm::dot(way, way));
        return AimT<T>{cone, true, std::min(size, cone.one_minus_cos)};
    });
}
// [aim_at]

/// A target that was chosen at random.
/// \tparam Aim  How to aim at a target, such as AimT. Its member `size` is the weight.
template <typename Aim>
struct ChosenTargetT {
    ObjectId target;
    Aim at;
    decltype(Aim::size) sum{0}; ///< Sum of the weights of all targets.
};

/// Chooses a target at random, with a probability in proportion to its weight.
/// \param targets   All targets.
/// \param aim_of    Called once with each target; returns how to aim at it. A size of 0
///                  excludes the target.
/// \param u_target  In [0, 1).
/// \return The target; nothing if all weights are 0.
template <typename Aim, std::floating_point T>
[[nodiscard]] std::optional<ChosenTargetT<Aim>>
choose_target(std::span<const ObjectId> targets, FunctionRef<Aim(ObjectId)> aim_of,
              T u_target) {
    ChosenTargetT<Aim> chosen;
    // Reservoir sampling: a target replaces the chosen one with a probability that is
    // its weight over the sum of the weights so far. u is then remapped to [0, 1).
    for (const ObjectId candidate : targets) {
        const auto at = aim_of(candidate);
        if (!(at.size > T(0))) continue;
        chosen.sum += at.size;
        const T share = at.size / chosen.sum;
        if (u_target < share) {
            chosen.target = candidate;
            chosen.at = at;
            u_target /= share;
        } else {
            u_target = (u_target - share) / (T(1) - share);
        }
    }
    return chosen.sum > T(0) ? std::optional(chosen) : std::nullopt;
}

template <std::floating_point T>
struct AimedDirectionT {
    Vec3T<T> direction{T(0)};
    /// Density of the direction per steradian, times the probability of the target.
    T pdf = T(0);
    ObjectId target{};
    std::vector<ObjectId> others{}; ///< As in AimedPhotonT.
};

/// The random numbers of an aimed photon, in the order in which aim() draws them.
template <std::floating_point T>
struct AimNumbersT {
    T probability; ///< Probability of the light, which is chosen first.
    /// Chooses a point of the light, or of a disc for a distant light.
    Vec2T<T> u_point;
    T u_target;           ///< Chooses the target.
    Vec2T<T> u_direction; ///< Chooses the direction.
    T time;               ///< Time of the photon.
};

/// Aims a photon of a distant light at a target, uniformly over the cross section of
/// its bounding sphere.
/// \return The photon, without its time and its light. Nothing if the bounding spheres
///         of all targets have the radius 0.
template <AnyWorld W, FarLight L, std::floating_point T>
[[nodiscard]] std::optional<AimedPhotonT<T>>
aim_photon(const W& world, const L& light, std::span<const ObjectId> targets,
           const AimNumbersT<T>& u) {
    struct Disc {
        SphereT<T> bound;
        T size = T(0); // its area
    };
    const auto disc_of = [&](ObjectId id) {
        const SphereT<T> bound = world.visit_shape(
            id, [](const auto& shape) { return bounding_sphere(shape); });
        return Disc{bound, disc_area(bound.radius)};
    };
    const auto aimed = choose_target<Disc>(targets, disc_of, u.u_target);
    if (!aimed) return std::nullopt;
    const SphereT<T>& bound = aimed->at.bound;
    const ArrivalT<T> arrival = sample_arrival(light, u.u_direction);
    return AimedPhotonT<T>{
        {.ray = ray_from_afar(SphereT<T>(light.around), arrival.direction, bound.center,
                              bound.radius, u.u_point),
         .flux = arrival.irradiance * (aimed->sum / u.probability)},
        aimed->target};
}

/// Samples a direction from a point of a near light to one of the targets: uniformly in
/// a cone, or uniformly over the area of a flat object; see aim_at(). Targets for which
/// that cone is the cone of emission, such as the walls around a lamp, are chosen as if
/// they were one object.
/// \return Nothing if the bounding spheres of all targets have the radius 0, or if the
///         chosen target is flat and `from` lies in its plane.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<AimedDirectionT<T>>
sample_aim(const W& world, const ConeT<T>& emission, const Vec3T<T>& from,
           std::span<const ObjectId> targets, const AimNumbersT<T>& u) {
    std::vector<ObjectId> at_all;
    const auto aim_of = [&](ObjectId id) {
        AimT<T> at = aim_at(world, emission, from, id);
        if (at.at_all && !at_all.empty()) at.size = T(0);
        if (at.at_all) at_all.push_back(id);
        return at;
    };
    const auto chosen = choose_target<AimT<T>>(targets, aim_of, u.u_target);
    if (!chosen) return std::nullopt;
    const AimT<T>& at = chosen->at;
    AimedDirectionT<T> aimed{.target = chosen->target};
    if (at.at_all && at_all.size() > 1) aimed.others = std::move(at_all);
    if (at.at_area) {
        const auto seen =
            world.visit_shape(chosen->target, [&]<typename G>(const G& shape) {
                if constexpr (FlatShape<G>) // a flat shape does not move
                    return sample_towards(shape, from, u.u_direction);
                else
                    return SeenPointT<T>{};
            });
        aimed.direction = glm::normalize(seen.point.position - from);
        aimed.pdf = seen.pdf;
    } else {
        aimed.direction =
            to_world(frame_around(at.cone.axis),
                     sample_uniform_cone(u.u_direction, at.cone.one_minus_cos));
        aimed.pdf = pdf_uniform_cone(at.cone.one_minus_cos);
    }
    aimed.pdf *= at.size / chosen->sum;
    if (!(aimed.pdf > T(0) && std::isfinite(aimed.pdf))) return std::nullopt;
    return aimed;
}

/// Aims a photon of a near light at a target.
/// \return The photon, without its time and its light. Nothing if sample_aim() returns
///         nothing, or if the light does not emit towards the target.
template <AnyWorld W, NearLight L, std::floating_point T>
[[nodiscard]] std::optional<AimedPhotonT<T>>
aim_photon(const W& world, const L& light, std::span<const ObjectId> targets,
           const AimNumbersT<T>& u) {
    const auto point = emission_point(light, u.u_point, u.time);
    auto aimed = sample_aim(world, cone_of_emission(light, point), position_of(point),
                            targets, u);
    if (!aimed) return std::nullopt;
    auto& [direction, pdf, target, others] = *aimed;
    const T emitted = pdf_emission(light, point, direction);
    if (!(emitted > T(0))) return std::nullopt;
    return AimedPhotonT<T>{
        {.ray = leave(point, direction),
         .flux = flux_leaving(light, point) * (emitted / (pdf * u.probability))},
        target,
        std::move(others)};
}

} // namespace detail

/// Aims a photon at one of several objects: uniformly in the cone of the object's
/// bounding sphere as seen from a point of the light. Objects are chosen in proportion
/// to the solid angles of their cones, so that the density is the same in all cones. A
/// flat object is sampled uniformly over its area instead. A distant light aims at the
/// cross sections of the bounding spheres.
///
/// The flux is multiplied by the density with which the light emits in the direction,
/// and divided by the density with which this function samples the direction. Because
/// cones may overlap, the caller must drop a photon that hits another object first. If
/// several objects fill the cone of emission, they are a single target.
/// \param world    The closed scene.
/// \param choice   The distribution of the lights, at least one.
/// \param targets  The objects, at least one.
/// \param stream   Six numbers are drawn, and one more if a shape moves.
/// \return The photon. Nothing if the light does not emit towards the target, or sees
///         it edge-on or as a point.
/// \cost One cone per target.
/// \report{Section 3.2.2.2} \cite jensen1996
/// \erratum{The report's program does not divide by the density of the direction, and
/// divides by the number of stored photons. The brightness of a caustic therefore does
/// not depend on how much light reaches the glass.}
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] std::optional<AimedPhotonT<typename W::Scalar>>
aim(const W& world, const LightChoice& choice, std::span<const ObjectId> targets,
    Stream& stream) {
    using T = typename W::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    detail::AimNumbersT<T> u;
    u.probability = chosen.probability;
    u.u_point = next_2d<T>(stream);
    u.u_target = next_1d<T>(stream);
    u.u_direction = next_2d<T>(stream);
    u.time = detail::path_time(world, stream);
    auto aimed = world.visit_light(chosen.light, [&](const auto& light) {
        return detail::aim_photon(world, light, targets, u);
    });
    if (!aimed) return std::nullopt;
    aimed->photon.ray.time = u.time;
    aimed->photon.light = static_cast<std::uint16_t>(chosen.light);
    return aimed;
}

/// Refuses fractions of the photons that do not add up to 1.
/// \param shares  One fraction per target or light; or empty, which is accepted.
/// \param count   The number of targets or lights.
/// \param of      What `count` counts, for the message.
/// \throws std::invalid_argument  if the number of fractions is wrong, a fraction is
///         outside [0, 1], or their sum is not 1.
inline void check_shares(std::span<const double> shares, std::size_t count,
                         const char* of = "the number of specular objects") {
    if (shares.empty()) return;
    require(shares.size() == count, "the number of shares",
            static_cast<long long>(shares.size()), of);
    double sum = 0;
    for (const double share : shares) {
        require(share >= 0 && share <= 1, "a share of the photons", share,
                "within [0, 1]");
        sum += share;
    }
    require(std::abs(sum - 1) < 1e-6, "the sum of all shares", sum, "1");
}

/// Aims a photon at one of several objects, which is chosen with given probabilities.
/// The flux is divided by the probability of the object.
/// \param world    The closed scene.
/// \param choice   The distribution of the lights, at least one.
/// \param targets  The objects, at least one.
/// \param shares   The probabilities, which must pass check_shares(). If empty, the
///                 function does the same as aim().
/// \param stream   With shares, one more number is drawn than by aim().
/// \return As aim().
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] std::optional<AimedPhotonT<typename W::Scalar>>
aim_by_share(const W& world, const LightChoice& choice,
             std::span<const ObjectId> targets, std::span<const double> shares,
             Stream& stream) {
    using T = typename W::Scalar;
    if (shares.empty()) return aim(world, choice, targets, stream);
    double left = double(next_1d<T>(stream));
    std::size_t chosen = 0;
    for (std::size_t k = 0; k < shares.size(); ++k) {
        if (!(shares[k] > 0)) continue; // rounding must not choose this target
        chosen = k;
        if (left < shares[k]) break;
        left -= shares[k];
    }
    auto aimed = aim(world, choice, targets.subspan(chosen, 1), stream);
    if (aimed) aimed->photon.flux /= static_cast<T>(shares[chosen]);
    return aimed;
}

/// \}

} // namespace ljus
