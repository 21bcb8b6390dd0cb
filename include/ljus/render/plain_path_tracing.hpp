#pragma once

/// \file ljus/render/plain_path_tracing.hpp
/// \brief A path tracer of one screen: the plain twin of path_tracing.hpp.

#include "ljus/path/direct_light.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \addtogroup path_tracing
/// \{

/// A scene, ready for the plain path tracer. It refers to the scene, which must outlive
/// it.
template <SceneLike S>
struct PlainPathTracer {
    using Stream = RandomStream; ///< What render() gives it to draw from.
    detail::IndexedT<S> scene;   ///< What is rendered.
    int max_depth = 100;         ///< Surfaces on a camera path.
};

/// Makes a plain path tracer.
/// \param scene      Must outlive the tracer.
/// \param max_depth  Surfaces on a camera path; 1 is direct light only.
/// \return The tracer.
/// \throws std::invalid_argument  for a depth below 1.
template <SceneLike S>
[[nodiscard]] PlainPathTracer<S> make_plain_path_tracer(const S& scene,
                                                        int max_depth = 100) {
    require_at_least("max_depth", max_depth, 1);
    return {detail::IndexedT<S>(scene), max_depth};
}
/// Not of a temporary: the scene would be gone before it is rendered.
template <SceneLike S>
PlainPathTracer<S> make_plain_path_tracer(const S&& scene, int = 100) = delete;

/// The radiance that one random path finds. At each diffuse surface one light, each as
/// likely as the next, is asked by a shadow ray; a lamp that the path meets by itself
/// counts only where no shadow ray could go, seen directly or by mirrors and glass.
///
/// It knows no media, no thin surfaces and no shading normals, and weighs nothing: the
/// mean is that of the PathTracer, the noise is not.
/// \param tracer  The scene and the depth.
/// \param ray     A primary ray.
/// \param stream  The numbers of this path.
/// \param counts  Counts the rays.
/// \return Radiance, W/(m^2 sr).
/// \report{Eq. (1)}
// [plain]
template <SceneLike S, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const PlainPathTracer<S>& tracer, RayT<T> ray,
                               RandomStream& stream, Counts& counts, Log&& = {}) {
    const auto& scene = tracer.scene;
    const auto weight = [](const LightSampleT<T>&, const Vec3T<T>&) { return T(1); };
    RgbT<T> sum{T(0)}, throughput{T(1)};
    bool lamps_count = true;
    for (int depth = 1; depth <= tracer.max_depth; ++depth, ++counts.bounce_rays) {
        const auto hit = closest_hit(scene, ray);
        if (!hit) break;
        const VertexT<T> vertex = vertex_at(scene, ray, *hit);
        if (lamps_count && vertex.emits()) sum += throughput * vertex.object.emission;
        // [plain]

        // [plain bounce]
        const bool goes_on = visit_material_at(scene, vertex, [&](const auto& m) {
            // One shadow ray, to a point of a light.
            const auto lights = static_cast<T>(scene.lights.size());
            const auto light = static_cast<std::size_t>(next_1d<T>(stream) * lights);
            const Vec2T<T> u = next_2d<T>(stream);
            if (has(lobes(m), Lobes::non_specular) && !scene.lights.empty())
                sum += throughput * lights *
                       direct_light(scene, scene.lights[light], vertex, m, u, weight,
                                    counts);
            // One ray on.
            const auto next =
                sample(m, vertex.wo, next_3d<T>(stream), Transport::radiance);
            if (!next) return false;
            throughput *= next->weight;
            lamps_count = next->specular;
            ray = spawn_ray(vertex.point, to_world(vertex.frame, next->wi));
            return true;
        });
        if (!goes_on || (depth > 4 && !survives(throughput, T(1), next_1d<T>(stream))))
            break;
    }
    return sum;
}
// [plain bounce]

/// \}

} // namespace ljus
