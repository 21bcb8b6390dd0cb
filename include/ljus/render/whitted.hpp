#pragma once

/// \file ljus/render/whitted.hpp
/// \brief Whitted's ray tracing: a tree of mirrors and glass, with hard shadows.

#include "ljus/geometry/shape.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/renderer.hpp"
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
    int max_depth = 5;     ///< Reflections and refractions in a row; 0 sends no ray on,
                           ///< 1000 is the most: each is one call inside of another.
    bool both_ways = true; ///< Glass sends two rays; false: one of them, by roulette.
    bool lamps = true; ///< A lamp with a size lights from its centre; false: is only
                       ///< seen.
    Rgb ambient{0}; ///< W/(m^2 sr) from everywhere to every diffuse surface, in place
                    ///< of all the light that the tree does not carry.
};

/// A scene, ready for Whitted's ray tracing. It refers to the scene, which must outlive
/// it.
template <SceneLike S>
struct WhittedTracer {
    using Stream = RandomStream; ///< What render() gives it to draw from.
    detail::IndexedT<S> scene;   ///< What is rendered.
    WhittedSettings settings;    ///< How a tree is traced.
};

/// Makes a tracer.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  Depth, branches, ambient light.
/// \return The tracer.
/// \throws std::invalid_argument  if a setting is out of range.
template <SceneLike S>
[[nodiscard]] WhittedTracer<S> make_whitted(const S& scene,
                                            const WhittedSettings& settings = {}) {
    require(settings.max_depth >= 0 && settings.max_depth <= 1000, "max_depth",
            static_cast<long long>(settings.max_depth), "within [0, 1000]");
    require_radiance("whitted.ambient", settings.ambient);
    return {detail::IndexedT<S>(scene), settings};
}
/// Not of a temporary: the scene would be gone before it is rendered.
template <SceneLike S>
WhittedTracer<S> make_whitted(const S&& scene, const WhittedSettings& = {}) = delete;

namespace detail {

/// The light that a diffuse surface sends back: of each light by one shadow ray, which
/// is not sent where the surface faces away, and of the ambient light without any.
/// \param tracer    The scene and the settings.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param counts    Counts the shadow rays.
/// \param add       Called as add(owner, letters, radiance).
/// \report{Section 2.1}
// [local light]
template <SceneLike S, std::floating_point T, Material M, typename Add>
void local_light(const WhittedTracer<S>& tracer, const VertexT<T>& vertex,
                 const M& material, Counts& counts, Add& add) {
    const auto whole = [](const LightSampleT<T>&, const Vec3T<T>&) { return T(1); };
    for (const LightT<T>& light : tracer.scene.lights) {
        Vec2T<T> u{T(0.5)};
        if (light.object) {
            if (!tracer.settings.lamps) continue;
            u = tracer.scene.visit_shape(
                *light.object, [](const auto& shape) { return center_sample(shape); });
        }
        add("shadow ray", "DL",
            direct_light(tracer.scene, light, vertex, material, u, whole, counts));
    }
    if (tracer.settings.ambient == Rgb{0}) return;
    // As if all of it came along the normal: for a matt surface albedo times radiance.
    const Vec3T<T> normal{T(0), T(0), std::copysign(T(1), vertex.wo.z)};
    add("ambient", "D",
        std::numbers::pi_v<T> * evaluate(material, vertex.wo, normal) *
            RgbT<T>(tracer.settings.ambient));
}
// [local light]

/// Traces one branch of the tree, and all that it sends on.
/// \param tracer  The scene and the settings.
/// \param path    The branch.
/// \param stream  Numbers for what is left to chance.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term.
/// \param sum     Radiance is added to it.
/// \report{Section 2.1}
// [trace_branch]
template <SceneLike S, std::floating_point T, typename Stream, typename Log>
void trace_branch(const WhittedTracer<S>& tracer, PathStateT<T> path, Stream& stream,
                  Counts& counts, Log& log, RgbT<T>& sum) {
    const auto vertex = next_vertex(tracer.scene, path, stream);
    if (!vertex) return;
    log_arrival(log, vertex->point.position);
    const auto add = [&, throughput = path.throughput](
                         const char* owner, const char* letters, const RgbT<T>& light) {
        log.term(owner, letters, throughput * light);
        sum += throughput * light;
    };
    if (vertex->emits()) add("emission", "L", vertex->object.emission);

    std::optional<PathStateT<T>> other; // the second branch
    const auto at_material = [&](const auto& material) {
        if (has(lobes(material), Lobes::non_specular))
            local_light(tracer, *vertex, material, counts, add);
        if (path.depth > tracer.settings.max_depth) {
            detail::cut_if(has(lobes(material), Lobes::specular), counts);
            return false;
        }
        if (tracer.settings.both_ways) other = split_path(path, *vertex, material);
        return other || continue_path(path, *vertex, material, Transport::radiance,
                                      Lobes::specular, stream);
    };
    if (!visit_material_at(tracer.scene, *vertex, at_material)) return;
    detail::log_vertex(log, path);
    const auto grow = [&](const PathStateT<T>& branch) {
        if (is_black(branch.throughput)) return;
        ++counts.bounce_rays;
        trace_branch(tracer, branch, stream, counts, log, sum);
    };
    grow(path);
    if (!other) return;
    detail::log_specular_path(log, *other);
    grow(*other);
}
// [trace_branch]

} // namespace detail

/// The radiance that the tree of one primary ray finds.
///
/// Nothing is left to chance: glass sends a ray both ways, each light has one point.
/// Only a material that mixes several lobes, or a thin surface, still chooses by lot.
/// \param tracer  The scene and the settings.
/// \param ray     A primary ray.
/// \param stream  Numbers for what is left to chance.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term.
/// \return Radiance, W/(m^2 sr).
/// \cost Up to 2^max_depth rays, if every ray meets glass.
/// \report{Section 2.1}
template <SceneLike S, std::floating_point T, typename Stream, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const WhittedTracer<S>& tracer, const RayT<T>& ray,
                               Stream& stream, Counts& counts, Log&& log = {}) {
    RgbT<T> sum{T(0)};
    log.begin();
    detail::trace_branch(tracer, detail::camera_path(tracer.scene, ray, stream), stream,
                         counts, log, sum);
    return sum;
}

/// \}

} // namespace ljus
