#pragma once

/// \file ljus/render/path_tracing.hpp
/// \brief The rendering equation solved by random paths: the reference of all others.

#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/scene/index.hpp"
#include "ljus/scene/light_choice.hpp"

namespace ljus {

/// \defgroup path_tracing Path tracing
/// \brief Section 2: the rendering equation (Eq. 1), after Kajiya \cite kajiya1986.
/// \{

/// How the light of a lamp that both a shadow ray and the path itself can find is
/// divided between the two: the weights of multiple importance sampling.
enum class MisHeuristic : std::uint8_t {
    balance,    ///< In proportion to each one's pdf.
    power,      ///< In proportion to the square of the pdf.
    shadow_rays ///< All to the shadow ray: next-event estimation alone.
};

/// How paths are traced.
struct PathTracingSettings {
    int max_depth = 1000;      ///< Surfaces on a camera path; 1 is direct light only.
    int roulette_depth = 4;    ///< From this surface on, roulette may end a path.
    bool sample_lights = true; ///< False: paths must find the lights by themselves.
    MisHeuristic heuristic = MisHeuristic::balance; ///< If they need not: the weights.
    double roulette_threshold = 1; ///< A path that carries less is in danger; 0: none.
    double roulette_max = 1;       ///< Above 0: the largest probability to survive.
};

/// A scene, ready for path tracing. It refers to the scene, which must outlive it.
template <SceneLike S>
struct PathTracer {
    using Stream = RandomStream;  ///< What render() gives it to draw from.
    detail::IndexedT<S> scene;    ///< What is rendered.
    PathTracingSettings settings; ///< How paths are traced.
    LightChoice lights;           ///< Its lights, by power.
};

/// Makes a path tracer.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  Limits.
/// \return The tracer.
/// \throws std::invalid_argument  if a setting is out of range.
template <SceneLike S>
[[nodiscard]] PathTracer<S> make_path_tracer(const S& scene,
                                             const PathTracingSettings& settings = {}) {
    require_at_least("max_depth", settings.max_depth, 1);
    require(settings.roulette_threshold >= 0, "roulette_threshold",
            settings.roulette_threshold, "at least 0");
    require(settings.roulette_max > 0 && settings.roulette_max <= 1, "roulette_max",
            settings.roulette_max, "in (0, 1]");
    return {detail::IndexedT<S>(scene), settings, light_choice(scene.lights)};
}
/// Not of a temporary: the scene would be gone before it is rendered.
template <SceneLike S>
PathTracer<S> make_path_tracer(const S&& scene,
                               const PathTracingSettings& = {}) = delete;

namespace detail {

/// The weight of one of two strategies, as the settings have it.
/// \param heuristic  balance or power.
/// \param pdf        Of the strategy that made the sample.
/// \param other      Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T mis_weight(MisHeuristic heuristic, T pdf, T other) noexcept {
    return heuristic == MisHeuristic::power ? power_heuristic(pdf, other)
                                            : balance_heuristic(pdf, other);
}

/// The density with which the tracer's shadow rays from the vertex before choose the
/// point of a lamp that a path has met.
/// \param tracer  The tracer.
/// \param path    The path.
/// \param vertex  The point of the lamp.
/// \return Per steradian.
template <SceneLike S, std::floating_point T>
[[nodiscard]] T pdf_of_light(const PathTracer<S>& tracer, const PathStateT<T>& path,
                             const VertexT<T>& vertex) {
    return pdf_of_lamp_point(tracer.scene, path.previous, vertex) *
           detail::probability_of<T>(tracer.lights, vertex.object.light);
}

/// The light of a lamp that a path has met, with the weight that the shadow ray from
/// the vertex before left it.
/// \param tracer  The scene and the limits.
/// \param path    The path.
/// \param vertex  Where it met the lamp.
/// \return Throughput times radiance times the weight.
/// \report{Eq. (1)}
// [emitted]
template <SceneLike S, std::floating_point T>
[[nodiscard]] RgbT<T> emitted(const PathTracer<S>& tracer, const PathStateT<T>& path,
                              const VertexT<T>& vertex) {
    const RgbT<T> all = path.throughput * vertex.object.emission;
    const PathTracingSettings& settings = tracer.settings;
    if (!(path.pdf > T(0)) || !settings.sample_lights) return all;
    if (settings.heuristic == MisHeuristic::shadow_rays) return RgbT<T>{T(0)};
    const T other = pdf_of_light(tracer, path, vertex);
    return mis_weight(settings.heuristic, path.pdf, other) * all;
}
// [emitted]

/// The light of one light, chosen by power, at a vertex of a path: by a shadow ray,
/// with the weight that it leaves to the path itself.
/// \param tracer    The scene and the limits.
/// \param path      The path.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param stream    Three numbers are drawn.
/// \param counts    Counts the ray.
/// \return Throughput times radiance times the weight.
/// \report{Section 3.2.3}
// [sampled]
template <SceneLike S, std::floating_point T, Material M>
[[nodiscard]] RgbT<T> sample_one_light(const PathTracer<S>& tracer,
                                       const PathStateT<T>& path,
                                       const VertexT<T>& vertex, const M& material,
                                       RandomStream& stream, Counts& counts) {
    const auto chosen = detail::choose_light(tracer.lights, next_1d<T>(stream));
    const auto weigh = [&](const LightSampleT<T>& light, const Vec3T<T>& wi) {
        const MisHeuristic heuristic = tracer.settings.heuristic;
        if (heuristic == MisHeuristic::shadow_rays) return T(1);
        if (light.pdf == T(0)) return T(1); // no path meets a point light
        return mis_weight(heuristic, light.pdf * chosen.probability,
                          pdf(material, vertex.wo, wi));
    };
    return path.throughput *
           direct_light(tracer.scene, tracer.scene.lights[chosen.light], vertex,
                        material, next_2d<T>(stream), weigh, counts) /
           chosen.probability;
}
// [sampled]

} // namespace detail

/// The radiance that one random path finds.
///
/// At each diffuse surface a light, chosen by power, is asked by a shadow ray; the path
/// then goes on in a direction that the material samples. A lamp that it meets is
/// counted with the weight that the shadow ray left it (multiple importance sampling),
/// and wholly after a mirror or glass, where no shadow ray could go.
/// \param tracer  The scene and the limits.
/// \param ray     A primary ray.
/// \param stream  The numbers of this path.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term.
/// \return Radiance, W/(m^2 sr): an unbiased estimate, if max_depth is never reached.
/// \report{Eq. (1)}
// [radiance]
template <SceneLike S, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const PathTracer<S>& tracer, const RayT<T>& ray,
                               RandomStream& stream, Counts& counts, Log&& log = {}) {
    const auto& scene = tracer.scene;
    const PathTracingSettings& settings = tracer.settings;
    RgbT<T> sum{T(0)};
    const auto add = [&](const char* owner, const char* letters, const RgbT<T>& term) {
        log.term(owner, letters, term);
        sum += term;
    };

    auto path = detail::camera_path(scene, ray, stream);
    log.begin();
    while (const auto vertex = next_vertex(scene, path, stream)) {
        detail::log_arrival(log, vertex->point.position);
        if (vertex->emits())
            add("emission", "L", detail::emitted(tracer, path, *vertex));
        if (detail::cut_if(path.depth > settings.max_depth, counts)) break;

        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular) && settings.sample_lights &&
                !scene.lights.empty())
                add("shadow ray", "DL",
                    detail::sample_one_light(tracer, path, *vertex, material, stream,
                                             counts));
            return continue_path(path, *vertex, material, Transport::radiance,
                                 Lobes::all, stream);
        };
        if (!visit_material_at(scene, *vertex, at_material)) break;
        // From the last surface a path goes on to the lamp that its shadow ray left a
        // part of, and to nothing else.
        if (path.depth == settings.max_depth && path.specular) {
            detail::cut_if(!is_black(path.throughput), counts);
            break;
        }
        detail::log_vertex(log, path);
        if (is_black(path.throughput)) break;
        if (path.depth >= settings.roulette_depth &&
            !survives(path.throughput, path.eta_scale, next_1d<T>(stream),
                      static_cast<T>(settings.roulette_threshold),
                      static_cast<T>(settings.roulette_max)))
            break;
        ++counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
