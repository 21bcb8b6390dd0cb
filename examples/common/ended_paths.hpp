#pragma once

/// \file examples/common/ended_paths.hpp
/// \brief Three ways to end a path, in one path tracer: two of them lose light.

#include <cstdint>

#include "ljus/render/path_tracing.hpp"

namespace examples {

/// When a path ends.
enum class Ending : std::uint8_t {
    depth,     ///< After so many surfaces: what comes later is lost.
    threshold, ///< When it carries less than some value: that light is lost.
    roulette   ///< By chance, and who survives carries more: nothing is lost.
};

/// A path tracer without multiple importance sampling, whose paths end in one of three
/// ways. It refers to the scene.
template <ljus::SceneLike S>
struct EndedPaths {
    using Stream = ljus::RandomStream; ///< What render() gives it to draw from.
    ljus::PathTracer<S> tracer;        ///< The scene, and its lights by power.
    Ending ending = Ending::depth;     ///< How paths end.
    int depth = 4;                     ///< Surfaces, or from where on roulette plays.
    float threshold = 1; ///< What a path must carry to go on, or to be safe.
};

/// Makes one.
/// \param scene      Must outlive it.
/// \param ending     How paths end.
/// \param depth      Surfaces on a path, for Ending::depth; from where on
///                   roulette plays.
/// \param threshold  What a path must carry to go on, or to be safe from roulette.
/// \return The renderer.
template <ljus::SceneLike S>
[[nodiscard]] EndedPaths<S> make_ended_paths(const S& scene, Ending ending,
                                             int depth = 4, double threshold = 1) {
    return {make_path_tracer(scene, {.heuristic = ljus::MisHeuristic::shadow_rays}),
            ending, depth, float(threshold)};
}

/// Whether a path goes on from a surface.
/// \param paths   The rule.
/// \param path    Its throughput is divided by the chance, if it survives by chance.
/// \param stream  One number is drawn for roulette.
/// \return Whether.
// [goes on]
template <typename S>
[[nodiscard]] bool goes_on(const EndedPaths<S>& paths, ljus::PathState& path,
                           ljus::RandomStream& stream) {
    switch (paths.ending) {
    case Ending::depth:
        return path.depth < paths.depth;
    case Ending::threshold:
        return ljus::max_component(path.throughput) / path.eta_scale >= paths.threshold;
    case Ending::roulette:
        break;
    }
    return path.depth < paths.depth || ljus::survives(path.throughput, path.eta_scale,
                                                      next_1d(stream), paths.threshold);
}
// [goes on]

/// The radiance that one path finds: emission until it has met a diffuse surface and
/// after mirrors and glass, and one shadow ray at each diffuse surface.
template <typename S, typename Log>
ljus::Rgb radiance(const EndedPaths<S>& paths, const ljus::Ray& ray,
                   ljus::RandomStream& stream, ljus::Counts& counts, Log&&) {
    const auto& scene = paths.tracer.scene;
    ljus::Rgb sum{0};
    auto path = ljus::detail::camera_path(scene, ray, stream);
    // A path of mirrors that lose nothing must end as well.
    while (path.depth < 10000) {
        const auto vertex = next_vertex(scene, path, stream);
        if (!vertex) break;
        if (vertex->emits()) sum += ljus::detail::emitted(paths.tracer, path, *vertex);
        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), ljus::Lobes::non_specular) &&
                !scene.lights.empty())
                sum += ljus::detail::sample_one_light(paths.tracer, path, *vertex,
                                                      material, stream, counts);
            return continue_path(path, *vertex, material, ljus::Transport::radiance,
                                 ljus::Lobes::all, stream);
        };
        if (!visit_material_at(scene, *vertex, at_material)) break;
        if (ljus::is_black(path.throughput) || !goes_on(paths, path, stream)) break;
        ++counts.bounce_rays;
    }
    return sum;
}

} // namespace examples
