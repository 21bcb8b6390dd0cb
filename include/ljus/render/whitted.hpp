#pragma once

/// \file ljus/render/whitted.hpp
/// \brief Whitted's ray tracing: a tree of mirrors and glass, with hard shadows.

#include "ljus/geometry/solid_angle.hpp"
#include "ljus/path/camera_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup whitted Whitted's ray tracing
/// \brief Section 2.1: "trace both refractive, reflective and shadow rays", after
/// Whitted \cite whitted1980. Chapter: \ref ch_whitted.
///
/// What it carries, in Heckbert's letters, is L D? S* E, and each light only from one
/// point. No other surface lights a diffuse one: no L D D E, and no caustic L S D E.
/// \{

/// How a tree is traced.
struct WhittedSettings {
    int max_depth = 5;     ///< Reflections and refractions in a row; 0 sends no ray on.
    bool both_ways = true; ///< Glass sends two rays; false: one of them, by roulette.
    bool lamps = true; ///< A lamp with a size lights, from its middle; or is only seen.
    Rgb ambient{0}; ///< W/(m^2 sr) from everywhere to every diffuse surface; in place
                    ///< of all the light that the tree does not carry.
};

/// A scene, ready for Whitted's ray tracing. It refers to the scene, which must outlive
/// it.
template <typename Scene>
struct WhittedTracer {
    IndexedT<Scene> scene;    ///< What is rendered.
    WhittedSettings settings; ///< How.
};

/// Makes a tracer.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  Depth, branches, ambient light.
/// \return The tracer.
/// \throws std::invalid_argument  if a setting is out of range.
template <typename Scene>
[[nodiscard]] WhittedTracer<Scene> make_whitted(const Scene& scene,
                                                const WhittedSettings& settings = {}) {
    require(settings.max_depth >= 0, "max_depth",
            static_cast<long long>(settings.max_depth), "at least 0");
    require_radiance("whitted.ambient", settings.ambient);
    return {IndexedT<Scene>(scene), settings};
}

/// \name The middle of a lamp
/// \{

/// The point of the unit square whose sample stands for the whole lamp: of a sphere the
/// point that is nearest to the observer, of a quad its middle.
/// \return The point.
template <typename Lamp>
[[nodiscard]] auto center_sample(const Lamp&) noexcept {
    return Vec2T<ScalarOf<Lamp>>{ScalarOf<Lamp>(0.5)};
}
template <std::floating_point T>
[[nodiscard]] constexpr Vec2T<T> center_sample(const SphereT<T>&) noexcept {
    return Vec2T<T>{T(0)};
}
/// \}

/// The light that a diffuse surface sends back: of each light by one shadow ray, which
/// is not sent where the surface faces away, and of the ambient light without any.
/// \param tracer    The scene and the settings.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param counts    Counts the shadow rays.
/// \param add       Called as add(owner, letters, radiance).
/// \report{Section 2.1}
// [local light]
template <typename Scene, std::floating_point T, typename Material, typename Add>
void local_light(const WhittedTracer<Scene>& tracer, const ShadingT<T>& at,
                 const Material& material, Counts& counts, Add& add) {
    const auto whole = [](const LightSampleT<T>&, const Vec3T<T>&) { return T(1); };
    for (const LightT<T>& light : tracer.scene.lights) {
        Vec2T<T> u{T(0.5)};
        if (light.object) {
            if (!tracer.settings.lamps) continue;
            u = tracer.scene.visit_shape(
                *light.object, [](const auto& shape) { return center_sample(shape); });
        }
        add("shadow ray", "DL",
            direct_light(tracer.scene, light, at, material, u, whole, counts));
    }
    if (tracer.settings.ambient == Rgb{0}) return;
    // As if all of it came along the normal: for a matt surface albedo times radiance.
    const Vec3T<T> normal{T(0), T(0), std::copysign(T(1), at.wo.z)};
    add("ambient", "D",
        std::numbers::pi_v<T> * evaluate(material, at.wo, normal) *
            RgbT<T>(tracer.settings.ambient));
}
// [local light]

/// Follows one ray of the tree, and all that it sends on.
/// \param tracer  The scene and the settings.
/// \param path    The ray, and what it brings of the light that it finds.
/// \param depth   How often it has been reflected or refracted.
/// \param stream  Numbers for what is left to chance.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term.
/// \param sum     Radiance is added to it.
/// \report{Section 2.1}
// [follow]
template <typename Scene, std::floating_point T, typename Stream, typename Log>
void follow(const WhittedTracer<Scene>& tracer, PathT<T> path, int depth,
            Stream& stream, Counts& counts, Log& log, RgbT<T>& sum) {
    const auto met = meet(tracer.scene, path.ray, stream);
    if (!met) return;
    const ShadingT<T> at = shading(tracer.scene, path.ray, met->hit, path.medium);
    path.throughput *= transmittance(path.medium, met->distance) * met->arrives();
    const auto add = [&, share = path.throughput](
                         const char* owner, const char* letters, const RgbT<T>& light) {
        log.term(owner, letters, share * light);
        sum += share * light;
    };
    if (at.emits()) add("emission", "L", at.surface.object.emission);

    std::optional<PathT<T>> other; // the second branch
    const auto at_material = [&](const auto& material) {
        if (has(lobes(material), Lobes::diffuse))
            local_light(tracer, at, material, counts, add);
        if (depth == tracer.settings.max_depth) return false;
        if (tracer.settings.both_ways) other = split(path, at, material, log);
        return other ||
               send_on(path, at, material, Lobes::specular, false, stream, log);
    };
    if (!visit_material_of(tracer.scene, at.surface, at_material)) return;
    const auto grow = [&](const PathT<T>& branch) {
        if (is_black(branch.throughput)) return;
        ++counts.bounce_rays;
        follow(tracer, branch, depth + 1, stream, counts, log, sum);
    };
    grow(path);
    if (!other) return;
    log.begin(); // the letters once more, up to here
    for (int i = 0; i <= depth; ++i)
        log.vertex('S', at.surface.point.position, other->throughput, T(0));
    grow(*other);
}
// [follow]

/// The radiance that the tree of one primary ray finds.
///
/// Nothing is left to chance: glass sends a ray both ways, each light has one point.
/// Only a material that mixes several lobes, or a thin sheet, still chooses by lot.
/// \param tracer  The scene and the settings.
/// \param ray     A primary ray.
/// \param stream  Numbers for what is left to chance.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term.
/// \return Radiance, W/(m^2 sr).
/// \cost Up to 2^max_depth rays, if every ray meets glass.
/// \report{Section 2.1}
// [radiance]
template <typename Scene, std::floating_point T, typename Stream, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const WhittedTracer<Scene>& tracer, const RayT<T>& ray,
                               Stream& stream, Counts& counts, Log&& log = {}) {
    RgbT<T> sum{T(0)};
    log.begin();
    follow(tracer, PathT<T>{.ray = ray}, 0, stream, counts, log, sum);
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
