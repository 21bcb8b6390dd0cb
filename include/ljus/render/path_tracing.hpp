#pragma once

/// \file ljus/render/path_tracing.hpp
/// \brief The rendering equation solved by random paths: the reference renderer.

#include <cmath>

#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/fog_path.hpp"
#include "ljus/path/path_log.hpp"

namespace ljus {

/// \defgroup path_tracing Path tracing
/// \brief Solves the rendering equation (Section 2 of the report, Eq. 1) by random
/// paths, after Kajiya \cite kajiya1986.
/// \{

/// How paths are traced.
struct PathTracingSettings {
    int max_depth = 1000; ///< Largest number of surfaces on a camera path; 1 is
                          ///< direct light only.
    /// Number of the first surface at which roulette may end a path.
    int roulette_depth = 4;
    bool sample_lights = true;                      ///< Whether to send shadow rays.
    MisHeuristic heuristic = MisHeuristic::balance; ///< MIS weights of light that both
                                                    ///< paths and shadow rays find.
    FogLight fog = FogLight::both; ///< How light that fog scatters is found.
    /// The survival probability is the largest channel of the throughput divided by
    /// this number, but at most `roulette_max`; see survives().
    double roulette_threshold = 1;
    double roulette_max = 1; ///< Largest survival probability, in (0, 1].
};

/// Checks the settings.
/// \throws std::invalid_argument  if a setting is out of range.
inline void check(const PathTracingSettings& settings) {
    require_at_least("max_depth", settings.max_depth, 1);
    require(settings.roulette_threshold >= 0 &&
                std::isfinite(settings.roulette_threshold),
            "roulette_threshold", settings.roulette_threshold, "finite and at least 0");
    require(settings.roulette_max > 0 && settings.roulette_max <= 1, "roulette_max",
            settings.roulette_max, "in (0, 1]");
}

/// A path tracer of a world. The world must outlive the tracer:
///
///     const PathTracer tracer(world, {.max_depth = 8});
template <typename W>
class PathTracer {
public:
    using Stream = RandomStream; ///< The random stream that render() passes.
    static constexpr bool carries_fog = true; ///< Fog scatters the paths.

    /// \param world     Must outlive the tracer.
    /// \param settings  Depth, roulette, light sampling.
    /// \throws std::invalid_argument  if a setting is out of range, or the scene has
    ///         both fog and a thin surface.
    explicit PathTracer(WorldRef<W> world, const PathTracingSettings& settings = {})
        : world_(world), settings_(settings) {
        check(settings);
        require_no_film_in_fog(world_.get());
    }
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// How paths are traced.
    [[nodiscard]] const PathTracingSettings& settings() const noexcept {
        return settings_;
    }

private:
    WorldRef<W> world_;
    PathTracingSettings settings_;
};
/// Deduces the type of the world.
template <typename W>
PathTracer(const W&, const PathTracingSettings& = {}) -> PathTracer<W>;

namespace detail {

/// The MIS weight of light that a path finds. The weight is 1 if no shadow ray from the
/// previous vertex could have found the light.
/// \param pdf  Returns the density of a shadow ray to that light, per steradian; called
///             only if it is needed.
template <AnyWorld W, std::floating_point T, typename Pdf>
[[nodiscard]] T share_of_path(const PathTracer<W>& tracer, const PathStateT<T>& path,
                              std::uint32_t light, const Pdf& pdf) {
    const PathTracingSettings& settings = tracer.settings();
    if (!(path.pdf > T(0)) || !settings.sample_lights) return T(1);
    if (settings.heuristic == MisHeuristic::shadow_rays) return T(0);
    return mis_weight(settings.heuristic, path.pdf,
                      pdf() * probability_of<T>(tracer.world().light_choice(), light));
}

/// The throughput of a path times the radiance of a lamp that it has met, times the MIS
/// weight of the path.
// [emitted]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> emitted(const PathTracer<W>& tracer, const PathStateT<T>& path,
                              const VertexT<T>& vertex) {
    return share_of_path(tracer, path, vertex.object.light,
                         [&] {
                             return pdf_of_lamp_point(tracer.world(), path.previous,
                                                      vertex);
                         }) *
           (path.throughput * vertex.object.emission);
}
// [emitted]

/// The throughput of a path that leaves the scene times the radiance of the sky, times
/// the MIS weights of the path.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> escaped(const PathTracer<W>& tracer, const PathStateT<T>& path) {
    RgbT<T> sum{T(0)};
    if constexpr (has_sky<W>)
        for (std::uint32_t i = 0; i < tracer.world().light_count(); ++i) {
            const SkyT<T> sky = sky_of(tracer.world(), i, path.ray.direction);
            if (!is_black(sky.radiance))
                sum += share_of_path(tracer, path, i, [&] { return sky.pdf; }) *
                       (path.throughput * sky.radiance);
        }
    return sum;
}

/// Decides whether a path continues, by max_depth and roulette, and counts its next
/// ray.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] bool goes_on(const PathTracer<W>& tracer, PathStateT<T>& path,
                           Context& context) {
    const PathTracingSettings& settings = tracer.settings();
    // After the last surface only a lamp may follow, with its MIS weight.
    if (path.depth == settings.max_depth && path.specular) {
        cut_if(!is_black(path.throughput), context.counts);
        return false;
    }
    log_vertex(context.log, path);
    if (is_black(path.throughput)) return false;
    if (path.depth >= settings.roulette_depth &&
        !survives(path.throughput, path.eta_scale, next_1d<T>(context.stream),
                  static_cast<T>(settings.roulette_threshold),
                  static_cast<T>(settings.roulette_max)))
        return false;
    ++context.counts.bounce_rays;
    return true;
}

/// Adds the light that fog scatters towards the eye along a path's ray, up to the next
/// surface. The fog may also scatter the path itself.
/// \param path     The path after next_vertex(); receives its new ray.
/// \param before   The throughput of the path before next_vertex().
/// \param surface  Distance of the next surface.
// [cross fog]
template <AnyWorld W, std::floating_point T, typename Terms, typename Context>
[[nodiscard]] InFog cross_fog(const PathTracer<W>& tracer, PathStateT<T>& path,
                              const RgbT<T>& before, T surface, const Terms& terms,
                              Context& context) {
    const W& world = tracer.world();
    const PathTracingSettings& settings = tracer.settings();
    if (!meets_fog(world, path.ray)) return InFog::crossed;
    FogSegmentT<T> segment{path.ray, before};
    segment.ray.t_max = surface;
    const bool lit = settings.sample_lights && world.light_count() > 0 &&
                     path.depth <= settings.max_depth;
    if (lit)
        terms.add(
            "equi-angular", "DL",
            aimed_light(world, segment, settings.heuristic, settings.fog, context));
    const auto vertex = fly(world, segment, path, context.stream);
    if (!vertex) return InFog::crossed;
    log_arrival(context.log, vertex->point.position);
    if (cut_if(path.depth > settings.max_depth, context.counts)) return InFog::ended;
    if (lit)
        terms.add("shadow ray", "DL",
                  light_in_flight(world, segment, *vertex, path.throughput,
                                  settings.heuristic, settings.fog, context));
    visit_fog(world, vertex->medium, [&](const auto& medium) {
        scatter_in_fog(path, *vertex, medium, context.stream);
    });
    return goes_on(tracer, path, context) ? InFog::scattered : InFog::ended;
}
// [cross fog]

} // namespace detail

/// The radiance that one random path finds.
///
/// Each diffuse surface sends a shadow ray to one light, chosen by power; the path then
/// continues in a direction sampled by the material. A lamp that the path meets counts
/// with the path's weight of multiple importance sampling. After a mirror or glass,
/// this weight is 1, because no shadow ray could find the lamp. A scattering in fog
/// counts as a diffuse surface, also in max_depth.
/// \param tracer   The world and the settings.
/// \param ray      A primary ray.
/// \param context  The random stream of this path; counts its rays, logs its terms.
/// \return Radiance, in W/(m^2 sr): an unbiased estimate if max_depth is never reached.
/// \report{Eq. (1)}
// [radiance]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const PathTracer<W>& tracer, const RayT<T>& ray,
                               Context& context) {
    const W& world = tracer.world();
    const PathTracingSettings& settings = tracer.settings();
    RgbT<T> sum{T(0)};
    auto path = camera_path(world, ray, context.stream);
    const RadianceSum terms{sum, path.throughput, context.log};
    context.log.begin();
    for (;;) {
        [[maybe_unused]] const RgbT<T> before = path.throughput;
        const auto vertex = next_vertex(world, path, context.stream);
        if constexpr (W::lists_fog) {
            const T surface = vertex ? vertex->distance : path.ray.t_max;
            const auto fog =
                detail::cross_fog(tracer, path, before, surface, terms, context);
            if (fog == detail::InFog::scattered) continue;
            if (fog == detail::InFog::ended) break;
        }
        if (!vertex) {
            terms.add("sky", "L", detail::escaped(tracer, path));
            break;
        }
        detail::log_arrival(context.log, vertex->point.position);
        if (vertex->emits())
            terms.add("emission", "L", detail::emitted(tracer, path, *vertex));
        if (detail::cut_if(path.depth > settings.max_depth, context.counts)) break;

        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), Lobes::non_specular) && settings.sample_lights &&
                world.light_count() > 0)
                terms.add("shadow ray", "DL",
                          sample_one_light(world, path, *vertex, material,
                                           settings.heuristic, context));
            return continue_path(path, *vertex, material, Transport::radiance,
                                 Lobes::all, context.stream);
        };
        if (!visit_material_at(world, *vertex, at_material)) break;
        if (!detail::goes_on(tracer, path, context)) break;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
