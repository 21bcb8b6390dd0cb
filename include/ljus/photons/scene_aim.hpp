#pragma once

/// \file ljus/photons/scene_aim.hpp
/// \brief Aims photons at the scene, for lamps that are far from the scene.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "ljus/photons/photon_path.hpp"

namespace ljus {

/// \addtogroup emission
/// \{

namespace detail {

/// A sphere around one or more spheres, 0.1 % larger than needed to allow for rounding.
template <std::floating_point T>
[[nodiscard, gnu::cold]] SphereT<T>
sphere_around(const std::vector<SphereT<T>>& others) {
    BoxT<T> box;
    for (const SphereT<T>& other : others) {
        box.low = glm::min(box.low, other.center - other.radius);
        box.high = glm::max(box.high, other.center + other.radius);
    }
    SphereT<T> sphere{.center = box.low + (box.high - box.low) / T(2), .radius = 0};
    for (const SphereT<T>& other : others)
        sphere.radius = std::max(
            sphere.radius,
            T(1.001) * (other.radius + glm::distance(sphere.center, other.center)));
    return sphere;
}

} // namespace detail

/// The sphere to which photons are sent. It contains all objects that are not lamps,
/// and all lamps that touch the sphere around these objects.
/// \return The sphere; nothing if all objects are lamps.
/// \cost O(n) for n objects, and 16 bytes for each in float.
template <AnyWorld W, std::floating_point T = typename W::Scalar>
[[nodiscard, gnu::cold]] std::optional<SphereT<T>> lit_sphere(const W& world) {
    std::vector<SphereT<T>> lit, lamps;
    world.each_object([&](ObjectId id, const auto& object) {
        (object.light == no_light ? lit : lamps)
            .push_back(world.visit_shape(
                id, [](const auto& s) { return bounding_sphere(s); }));
    });
    if (lit.empty()) return std::nullopt;
    const SphereT<T> matt = detail::sphere_around(lit);
    for (const SphereT<T>& lamp : lamps)
        if (glm::distance(lamp.center, matt.center) <= lamp.radius + matt.radius)
            lit.push_back(lamp);
    return detail::sphere_around(lit);
}

namespace detail {

/// The fraction of an aimed light's photons that is sent into the cone. The remaining
/// eighth leaves as without aiming, because objects may lie outside the cone. A photon
/// has at most eight times the flux that it would have if no photon were aimed.
inline constexpr double part_in_cone = 7.0 / 8;

/// Emits a photon of a near light as emit_photon() does, but with the probability
/// part_in_cone into the cone around a sphere. The flux is 0 if the light does not emit
/// in the direction.
// [emit_into]
template <NearLight L, std::floating_point T>
[[nodiscard]] LeavingPhotonT<T> emit_into(const L& light, const SphereT<T>& sphere,
                                          const Vec2T<T>& u_point, Vec2T<T> u, T time) {
    constexpr T part = T(part_in_cone);
    const auto point = emission_point(light, u_point, time);
    const ConeT<T> cone = cone_towards(sphere, position_of(point));
    bool inside = u.x < part;
    Vec3T<T> direction;
    if (inside) {
        u.x /= part;
        direction = to_world(frame_around(cone.axis),
                             sample_uniform_cone(u, cone.one_minus_cos));
    } else {
        u.x = (u.x - part) / (T(1) - part);
        direction = sample_emission(light, point, u);
        const Vec3T<T> apart = direction - cone.axis; // |apart|^2 is 2 (1 - cos)
        inside = glm::dot(apart, apart) <= T(2) * cone.one_minus_cos;
    }
    const T emitted = pdf_emission(light, point, direction);
    if (!(emitted > T(0))) return {leave(point, direction), RgbT<T>{T(0)}};
    const T in_cone = inside ? part * pdf_uniform_cone(cone.one_minus_cos) : T(0);
    const T drawn = in_cone + (T(1) - part) * emitted;
    return {leave(point, direction), flux_leaving(light, point) * (emitted / drawn)};
}
// [emit_into]

/// The fraction of a light's flux that goes into the cone around a sphere. Nothing if
/// it does not pay to aim photons into this cone.
///
/// For a direction that is uniform in the cone, let w be the density of emission,
/// divided by the density of this uniform direction. An aimed photon has a flux in
/// proportion to w. It is worth \f$ E[w]^2 / E[w^2] \f$ photons of equal flux, where E
/// is the mean. Without aiming, the fraction \f$ E[w] \f$ of the photons goes into the
/// cone. Therefore aiming pays if \f$ E[w] > E[w^2] \f$.
template <AnyWorld W, NearLight L, std::floating_point T>
[[nodiscard, gnu::cold]] std::optional<double>
part_of_flux_in(const W& world, const L& light, const SphereT<T>& sphere) {
    constexpr int samples = 64;
    double sum = 0, squares = 0;
    for (int i = 0; i < samples; ++i) {
        auto stream = random_stream(0, Pass::general_photons, ~0ull, std::uint64_t(i));
        const T time = path_time(world, stream);
        const auto point = emission_point(light, next_2d<T>(stream), time);
        const ConeT<T> cone = cone_towards(sphere, position_of(point));
        if (cone.one_minus_cos == T(2)) return std::nullopt; // point in the sphere
        const Vec3T<T> direction =
            to_world(frame_around(cone.axis),
                     sample_uniform_cone(next_2d<T>(stream), cone.one_minus_cos));
        const double w = double(pdf_emission(light, point, direction)) /
                         double(pdf_uniform_cone(cone.one_minus_cos));
        sum += w;
        squares += w * w;
    }
    if (!(sum > squares)) return std::nullopt;
    return sum / samples;
}

} // namespace detail

/// How the photons of a general map leave the lights of a scene. The photons of lamps
/// that are far from the scene are aimed. `emit(world, aim.choice, stream, aim)` emits
/// a photon.
template <std::floating_point T>
struct SceneAimT {
    LightChoice choice{}; ///< The distribution of the lights.
    SphereT<T> sphere{};  ///< The result of lit_sphere().
    /// 1 for each light that is aimed, 0 for the others; empty if no light is aimed.
    std::vector<std::uint8_t> is_aimed{};

    /// Emits a photon of the light with this number.
    template <Light L>
    [[nodiscard]] LeavingPhotonT<T>
    operator()(std::uint32_t number, const L& light, const Vec2T<T>& u_point,
               const Vec2T<T>& u_direction, T time) const {
        if constexpr (NearLight<L>)
            if (!is_aimed.empty() && is_aimed[number])
                return detail::emit_into(light, sphere, u_point, u_direction, time);
        return emit_photon(light, u_point, u_direction, time);
    }
};

/// Finds the lights that are so far from the scene that it pays to aim their photons at
/// the scene. Most photons of such a light would otherwise miss the scene. Jensen's
/// projection maps \cite jensen2001 have the same purpose. Lights inside the scene and
/// distant lights such as suns are not aimed.
/// \param world     The closed scene.
/// \param choice    The distribution of the lights.
/// \param by_power  True if `choice` is in proportion to power. An aimed light is then
///                  chosen in proportion to its flux into the cone around the scene.
/// \return The arguments of emit().
/// \cost That of lit_sphere(), and at most 64 samples per light.
template <AnyWorld W, std::floating_point T = typename W::Scalar>
[[nodiscard, gnu::cold]] SceneAimT<T>
aim_at_scene(const W& world, const LightChoice& choice, bool by_power = true) {
    SceneAimT<T> aim{.choice = choice};
    const auto sphere = lit_sphere(world);
    if (!sphere) return aim;
    aim.sphere = *sphere;
    aim.is_aimed.resize(world.light_count());
    double before = 0, sum = 0;
    for (std::uint32_t i = 0; i < world.light_count(); ++i) {
        const auto part =
            world.visit_light(i, [&]<typename L>(const L& l) -> std::optional<double> {
                if constexpr (NearLight<L>)
                    return detail::part_of_flux_in(world, l, *sphere);
                return std::nullopt;
            });
        aim.is_aimed[i] = part ? 1 : 0;
        sum += (choice.cumulative[i] - before) * part.value_or(1.0);
        before = choice.cumulative[i];
        if (by_power) aim.choice.cumulative[i] = sum;
    }
    if (std::find(aim.is_aimed.begin(), aim.is_aimed.end(), 1) == aim.is_aimed.end())
        return {.choice = choice};
    return aim;
}

/// \}

} // namespace ljus
