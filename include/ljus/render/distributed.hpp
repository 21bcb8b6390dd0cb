#pragma once

/// \file ljus/render/distributed.hpp
/// \brief Distributed rays: one ray of each kind, sent somewhere else each time.

#include "ljus/math/stratified_stream.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup distributed_rays Distributed rays
/// \brief Section 2.1: soft shadows and blurry reflections "by averaging multiple
/// camera rays per pixel", after Cook, Porter and Carpenter \cite cook1984. Chapter:
/// \ref ch_distributed_rays.
///
/// What it carries, in Heckbert's letters, with G for gloss, is L D? (S|G)* E: what
/// Whitted's tree carries, each ray of it blurred. No matt surface lights another.
/// \{

/// How rays are distributed.
struct DistributedSettings {
    int max_depth = 5; ///< Reflections and refractions in a row; 0 sends no ray on.
};

/// A scene, ready for distributed rays. It refers to the scene, which must outlive it.
template <SceneLike S>
struct DistributedTracer {
    using Stream = StratifiedStream; ///< What render() gives it to draw from.
    detail::IndexedT<S> scene;       ///< What is rendered.
    DistributedSettings settings;    ///< How rays are distributed.
};

/// Makes a tracer. RenderSettings::sampling says how its rays are spread, over the
/// pixel and over everything else that they choose.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  The depth.
/// \return The tracer.
/// \throws std::invalid_argument  if the depth is negative.
template <SceneLike S>
[[nodiscard]] DistributedTracer<S>
make_distributed(const S& scene, const DistributedSettings& settings = {}) {
    require_at_least("max_depth", settings.max_depth, 0);
    return {detail::IndexedT<S>(scene), settings};
}
/// Not of a temporary: the scene would be gone before it is rendered.
template <SceneLike S>
DistributedTracer<S> make_distributed(const S&& scene,
                                      const DistributedSettings& = {}) = delete;

namespace detail {

/// The light of all lights at a surface, by one shadow ray to a random point of each.
/// In gloss a lamp is seen by the reflected ray, so that none is sent to it: each path
/// has one owner.
/// \param scene     The scene.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param stream    Two numbers for each light with a size.
/// \param counts    Counts the rays.
/// \return Radiance towards wo.
/// \report{Section 2.1}
template <SceneLike S, std::floating_point T, Material M, typename Stream>
[[nodiscard]] RgbT<T> soft_light(const S& scene, const VertexT<T>& vertex,
                                 const M& material, Stream& stream, Counts& counts) {
    const auto whole = [](const LightSampleT<T>&, const Vec3T<T>&) { return T(1); };
    const bool gloss = has(lobes(material), Lobes::glossy);
    RgbT<T> sum{T(0)};
    for (const LightT<T>& light : scene.lights) {
        if (gloss && light.object) continue;
        const Vec2T<T> u = light.object ? next_2d<T>(stream) : Vec2T<T>{T(0)};
        sum += direct_light(scene, light, vertex, material, u, whole, counts);
    }
    return sum;
}

} // namespace detail

/// The radiance that one camera ray finds, at a random time, by one ray at each mirror,
/// glass or gloss and one to each light.
/// \param tracer  The scene and the settings.
/// \param ray     A primary ray.
/// \param stream  The numbers of this ray.
/// \param counts  Counts the rays.
/// \param log     Told of each vertex and each term; gloss is D there.
/// \return Radiance, W/(m^2 sr): an unbiased estimate of what such paths carry, up to
///         the depth.
/// \cost At most max_depth + 1 rays, and as many shadow rays to each light.
/// \report{Section 2.1}
// [radiance]
template <SceneLike S, std::floating_point T, typename Stream, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const DistributedTracer<S>& tracer, const RayT<T>& ray,
                               Stream& stream, Counts& counts, Log&& log = {}) {
    const auto& scene = tracer.scene;
    RgbT<T> sum{T(0)};
    auto path = detail::camera_path(scene, ray, stream);
    log.begin();
    while (const auto vertex = next_vertex(scene, path, stream)) {
        detail::log_arrival(log, vertex->point.position);
        const auto add = [&](const char* owner, const char* letters,
                             const RgbT<T>& light) {
            log.term(owner, letters, path.throughput * light);
            sum += path.throughput * light;
        };
        if (vertex->emits()) add("emission", "L", vertex->object.emission);

        const auto at_material = [&](const auto& material) {
            const Lobes parts = lobes(material);
            if (has(parts, Lobes::non_specular))
                add("shadow ray", "DL",
                    detail::soft_light(scene, *vertex, material, stream, counts));
            const Lobes which =
                has(parts, Lobes::glossy) ? Lobes::all : Lobes::specular;
            if (path.depth > tracer.settings.max_depth) {
                detail::cut_if(has(parts, which), counts);
                return false;
            }
            return continue_path(path, *vertex, material, Transport::radiance, which,
                                 stream);
        };
        if (!visit_material_at(scene, *vertex, at_material)) break;
        detail::log_vertex(log, path);
        if (is_black(path.throughput)) break;
        ++counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
