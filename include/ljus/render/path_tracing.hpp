#pragma once

/// \file ljus/render/path_tracing.hpp
/// \brief The rendering equation solved by random paths: the judge of all the others.

#include "ljus/path/camera_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/scene/index.hpp"
#include "ljus/scene/light_choice.hpp"

namespace ljus {

/// \defgroup path_tracing Path tracing
/// \brief Section 2: the rendering equation (Eq. 1), after Kajiya \cite kajiya1986.
/// \{

/// Whose a lamp's light is, where a shadow ray and the path itself can both find it.
enum class MisHeuristic : std::uint8_t {
    balance,    ///< Each has a share, by its density: balance().
    power,      ///< Each has a share, by its density's square: power_heuristic().
    shadow_rays ///< The shadow ray's alone: next-event estimation as it was before.
};

/// How paths are traced.
struct PathTracingSettings {
    int max_depth = 1000;      ///< Surfaces on a camera path; 1 is direct light only.
    int roulette_depth = 4;    ///< From this surface on, roulette may end a path.
    bool sample_lights = true; ///< False: paths must find the lights by themselves.
    MisHeuristic share = MisHeuristic::balance; ///< If they need not: who is believed.
    double roulette_threshold = 1; ///< A path that carries less is in danger; 0: none.
    double roulette_most = 1;      ///< Above 0: the largest probability to survive.
};

/// A scene, ready for path tracing. It refers to the scene, which must outlive it.
template <typename Scene>
struct PathTracer {
    IndexedT<Scene> scene;        ///< What is rendered.
    PathTracingSettings settings; ///< How.
    LightChoice lights;           ///< Its lights, by power.
};

/// Makes a path tracer.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  Limits.
/// \return The tracer.
/// \throws std::invalid_argument  if a setting is out of range.
template <typename Scene>
[[nodiscard]] PathTracer<Scene>
make_path_tracer(const Scene& scene, const PathTracingSettings& settings = {}) {
    require(settings.max_depth >= 1, "max_depth",
            static_cast<long long>(settings.max_depth), "at least 1");
    require(settings.roulette_threshold >= 0, "roulette_threshold",
            settings.roulette_threshold, "at least 0");
    require(settings.roulette_most > 0 && settings.roulette_most <= 1, "roulette_most",
            settings.roulette_most, "in (0, 1]");
    return {IndexedT<Scene>(scene), settings, light_choice(scene.lights)};
}

/// The balance heuristic: the share of one of two strategies that could have made the
/// same sample \cite veach1997.
/// \param pdf    Of the strategy that did.
/// \param other  Of the one that could have.
/// \return In [0, 1].
// [heuristics]
template <std::floating_point T>
[[nodiscard]] constexpr T balance(T pdf, T other) noexcept {
    // Not pdf / (pdf + other), which is NaN for two infinities.
    return pdf > other ? T(1) / (T(1) + other / pdf)
                       : pdf / other / (T(1) + pdf / other);
}

/// The power heuristic: the same by the squares of the densities, so that the surer of
/// the two is believed even more \cite veach1995.
/// \param pdf    Of the strategy that did.
/// \param other  Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T power_heuristic(T pdf, T other) noexcept {
    // Squares of quotients, for the squares of densities overflow.
    const T q = pdf > other ? other / pdf : pdf / other;
    return (pdf > other ? T(1) : q * q) / (T(1) + q * q);
}
// [heuristics]

/// The share of one of two strategies, as the settings have it.
/// \param share  balance or power.
/// \param pdf    Of the strategy that made the sample.
/// \param other  Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T mis_weight(MisHeuristic share, T pdf, T other) noexcept {
    return share == MisHeuristic::power ? power_heuristic(pdf, other)
                                        : balance(pdf, other);
}

/// The density with which the tracer's shadow rays from a surface choose a point of a
/// lamp.
/// \param tracer  The tracer.
/// \param from    The surface that the shadow rays leave.
/// \param hit     The point of the lamp.
/// \param at      The same, as a surface.
/// \return Per steradian.
template <typename Scene, std::floating_point T>
[[nodiscard]] T pdf_of_light(const PathTracer<Scene>& tracer, const Vec3T<T>& from,
                             const SceneHitT<T>& hit, const ShadingT<T>& at) {
    const T pdf = tracer.scene.visit_shape(hit.object, [&](const auto& shape) {
        return pdf_towards(shape, from, at.surface.point);
    });
    return pdf * probability_of<T>(tracer.lights, at.surface.object.light);
}

/// The light of a lamp that a path has met, with the weight that the shadow ray from
/// the surface before left it.
/// \param tracer  The scene and the limits.
/// \param path    The path.
/// \param hit     Where it met the lamp.
/// \param at      The same, ready to be shaded.
/// \return Radiance, its share of the path's.
/// \report{Eq. (1)}
// [emitted]
template <typename Scene, std::floating_point T>
[[nodiscard]] RgbT<T> emitted(const PathTracer<Scene>& tracer, const PathT<T>& path,
                              const SceneHitT<T>& hit, const ShadingT<T>& at) {
    const RgbT<T> all = path.throughput * at.surface.object.emission;
    const PathTracingSettings& settings = tracer.settings;
    if (!(path.bsdf_pdf > T(0)) || !settings.sample_lights) return all;
    if (settings.share == MisHeuristic::shadow_rays) return RgbT<T>{T(0)};
    const T other = pdf_of_light(tracer, path.from, hit, at);
    return mis_weight(settings.share, path.bsdf_pdf, other) * all;
}
// [emitted]

/// The light of one lamp, chosen by power, at a surface of a path: by a shadow ray,
/// with the weight that it leaves to the path itself.
/// \param tracer    The scene and the limits.
/// \param path      The path.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param stream    Three numbers are drawn.
/// \param counts    Counts the ray.
/// \return Radiance, its share of the path's.
/// \report{Section 3.2.3}
// [sampled]
template <typename Scene, std::floating_point T, typename Material>
[[nodiscard]] RgbT<T> sample_one_light(const PathTracer<Scene>& tracer,
                                       const PathT<T>& path, const ShadingT<T>& at,
                                       const Material& material, RandomStream& stream,
                                       Counts& counts) {
    const auto chosen = choose_light(tracer.lights, next_1d<T>(stream));
    const auto weigh = [&](const LightSampleT<T>& light, const Vec3T<T>& wi) {
        const MisHeuristic share = tracer.settings.share;
        if (share == MisHeuristic::shadow_rays) return T(1);
        if (light.pdf == T(0)) return T(1); // no path meets a point light
        return mis_weight(share, light.pdf * chosen.probability,
                          pdf(material, at.wo, wi));
    };
    return path.throughput *
           direct_light(tracer.scene, tracer.scene.lights[chosen.light], at, material,
                        next_2d<T>(stream), weigh, counts) /
           chosen.probability;
}
// [sampled]

/// The radiance that one random path finds.
///
/// At each diffuse surface a light, chosen by power, is asked by a shadow ray; the path
/// then goes on in a direction that the material samples. A lamp that it meets is
/// counted with the weight that the shadow ray left it (multiple importance sampling),
/// and wholly after a mirror or glass, where no shadow ray could go.
/// \param tracer  The scene and the limits.
/// \param ray  A primary ray.
/// \param stream  The numbers of this path.
/// \param counts  Counts the rays.
/// \param log  Told of each vertex and each term.
/// \return Radiance, W/(m^2 sr): an unbiased estimate, if max_depth is never reached.
/// \report{Eq. (1)}
// [radiance]
template <typename Scene, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const PathTracer<Scene>& tracer, const RayT<T>& ray,
                               RandomStream& stream, Counts& counts, Log&& log = {}) {
    const auto& scene = tracer.scene;
    const PathTracingSettings& limits = tracer.settings;
    RgbT<T> sum{T(0)};
    PathT<T> path{.ray = ray};
    log.begin();
    const auto add = [&](const char* owner, const char* letters, const RgbT<T>& term) {
        log.term(owner, letters, term);
        sum += term;
    };

    for (int depth = 1;; ++depth) {
        start_bounce(stream, static_cast<std::uint64_t>(depth));
        const auto met = meet(scene, path.ray, stream);
        if (!met) break;
        const ShadingT<T> at = shading(scene, path.ray, met->hit, path.medium);
        path.throughput *= transmittance(path.medium, met->distance) * met->arrives();
        if (at.emits()) add("emission", "L", emitted(tracer, path, met->hit, at));
        if (depth > limits.max_depth) break;

        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), Lobes::diffuse) && limits.sample_lights &&
                !scene.lights.empty())
                add("shadow ray", "DL",
                    sample_one_light(tracer, path, at, material, stream, counts));
            return send_on(path, at, material, Lobes::all, depth == limits.max_depth,
                           stream, log);
        };
        if (!visit_material_of(scene, at.surface, at_material)) break;
        if (is_black(path.throughput)) break;
        if (depth >= limits.roulette_depth &&
            !survives(path.throughput, path.eta_scale, next_1d<T>(stream),
                      static_cast<T>(limits.roulette_threshold),
                      static_cast<T>(limits.roulette_most)))
            break;
        ++counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
