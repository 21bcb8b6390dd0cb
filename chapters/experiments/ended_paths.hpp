#pragma once

/// \file chapters/experiments/ended_paths.hpp
/// \brief Three ways to end a path, in one path tracer: two of them lose light.

#include <cstdint>

#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/ref.hpp"

namespace examples {

/// When a path ends.
enum class Ending : std::uint8_t {
    depth,     ///< After a number of surfaces: later light is lost.
    threshold, ///< When it carries less than some value: that light is lost.
    roulette   ///< By chance, and survivors carry more: no light is lost.
};

/// A path tracer without multiple importance sampling, whose paths end in one of three
/// ways. Its world must outlive it.
template <ljus::AnyWorld W>
struct EndedPaths {
    using Stream = ljus::RandomStream; ///< What render() gives it to draw from.
    ljus::Ref<W> world;                ///< What is rendered.
    Ending ending = Ending::depth;     ///< How paths end.
    int depth = 4;                     ///< Surfaces, or from where on roulette plays.
    float threshold = 1; ///< What a path must carry to go on, or to be safe.
};

/// Makes one.
/// \param world      Must outlive it.
/// \param ending     How paths end.
/// \param depth      Surfaces on a path, for Ending::depth; from where on
///                   roulette plays.
/// \param threshold  What a path must carry to go on, or to be safe from roulette.
/// \return The renderer.
template <ljus::AnyWorld W>
[[nodiscard]] EndedPaths<W> make_ended_paths(const W& world, Ending ending,
                                             int depth = 4, double threshold = 1) {
    return {world, ending, depth, float(threshold)};
}

/// Whether a path continues from a surface.
/// \param paths   The rule.
/// \param path    Its throughput is divided by the chance, if it survives by chance.
/// \param stream  One number is drawn for roulette.
/// \return Whether.
// [goes on]
template <typename W>
[[nodiscard]] bool goes_on(const EndedPaths<W>& paths, ljus::PathState& path,
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

/// What a path gets from one light, chosen by power: all that a shadow ray finds.
template <typename W, typename M>
ljus::Rgb one_light(const W& world, const ljus::PathState& path,
                    const ljus::Vertex& vertex, const M& material, auto& context) {
    const auto chosen = choose_light(world.light_choice(), next_1d(context.stream));
    return path.throughput *
           direct_light(world, chosen.light, vertex, material, next_2d(context.stream),
                        ljus::MisT<float>{}, context.counts) /
           chosen.probability;
}

/// The radiance that one path finds: emission until it has met a diffuse surface and
/// after mirrors and glass, and one shadow ray at each diffuse surface.
template <typename W>
ljus::Rgb radiance(const EndedPaths<W>& paths, const ljus::Ray& ray, auto& context) {
    const W& world = paths.world.get();
    ljus::Rgb sum{0};
    auto path = ljus::camera_path(world, ray, context.stream);
    // A path between mirrors without loss must end as well.
    while (path.depth < 10000) {
        const auto vertex = next_vertex(world, path, context.stream);
        if (!vertex) break;
        const bool shadow_ray_came_before = path.pdf > 0;
        if (vertex->emits() && !shadow_ray_came_before)
            sum += path.throughput * vertex->object.emission;
        const auto at_material = [&](const auto& material) {
            if (has(lobes(material), ljus::Lobes::non_specular) &&
                world.light_count() > 0)
                sum += one_light(world, path, *vertex, material, context);
            return continue_path(path, *vertex, material, ljus::Transport::radiance,
                                 ljus::Lobes::all, context.stream);
        };
        if (!visit_material_at(world, *vertex, at_material)) break;
        if (ljus::is_black(path.throughput) || !goes_on(paths, path, context.stream))
            break;
        ++context.counts.bounce_rays;
    }
    return sum;
}

} // namespace examples
