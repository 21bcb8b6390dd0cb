#pragma once

/// \file ljus/render/path_tracing.hpp
/// \brief The rendering equation solved by random paths: the judge of all the others.

#include "ljus/render/direct_light.hpp"
#include "ljus/render/path_log.hpp"
#include "ljus/scene/indexed_scene.hpp"
#include "ljus/scene/light_choice.hpp"

namespace ljus {

/// \defgroup path_tracing Path tracing
/// \brief Section 2: the rendering equation (Eq. 1), after Kajiya \cite kajiya1986.
/// \{

/// How paths are traced.
struct PathTracing {
    int max_depth = 1000;      ///< Surfaces on a camera path; 1 is direct light only.
    int roulette_depth = 4;    ///< From this surface on, roulette may end a path.
    bool sample_lights = true; ///< False: paths must find the lights by themselves.
};

/// A scene, ready for path tracing. It refers to the scene, which must outlive it.
template <typename Scene>
struct PathTracer {
    IndexedT<Scene> scene; ///< What is rendered.
    PathTracing settings;  ///< How.
    LightChoice lights;    ///< Its lights, by power.
};

/// Makes a path tracer.
/// \param scene     Must outlive the tracer; a scene, which it indexes, or an
///                  IndexedScene.
/// \param settings  Limits.
/// \return The tracer.
template <typename Scene>
[[nodiscard]] PathTracer<Scene> make_path_tracer(const Scene& scene,
                                                 const PathTracing& settings = {}) {
    require(settings.max_depth >= 1, "max_depth",
            static_cast<long long>(settings.max_depth), "at least 1");
    return {IndexedT<Scene>(scene), settings, light_choice(scene.lights)};
}

/// The balance heuristic: the share of one of two strategies that could have made the
/// same sample \cite veach1997.
/// \param pdf    Of the strategy that did.
/// \param other  Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T balance(T pdf, T other) noexcept {
    // Not pdf / (pdf + other), which is NaN for two infinities.
    return pdf > other ? T(1) / (T(1) + other / pdf)
                       : pdf / other / (T(1) + pdf / other);
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
[[nodiscard]] RgbT<T> radiance(const PathTracer<Scene>& tracer, RayT<T> ray,
                               RandomStream& stream, Counts& counts, Log&& log = {}) {
    const auto& scene = tracer.scene;
    const PathTracing& limits = tracer.settings;
    RgbT<T> sum{T(0)};
    RgbT<T> throughput{T(1)};
    T squeeze = T(1); // what of the throughput is no loss, see survives()
    RgbT<T> medium{T(0)};
    T bsdf_pdf = T(0);   // of the direction the path came in, 0: a delta
    Vec3T<T> from{T(0)}; // the surface it came from
    log.begin();

    for (int depth = 1;; ++depth) {
        start_bounce(stream, static_cast<std::uint64_t>(depth));
        const auto met = meet(scene, ray, stream);
        if (!met) break;
        const ShadingT<T> at = shading(scene, ray, met->hit, medium);
        throughput *= transmittance(medium, met->distance) * met->arrives();

        // Emission, with the weight that the shadow rays left.
        if (at.shines()) {
            T weight = T(1);
            if (bsdf_pdf > T(0) && limits.sample_lights)
                weight = balance(bsdf_pdf, pdf_of_light(tracer, from, met->hit, at));
            const RgbT<T> term = weight * throughput * at.surface.object.emission;
            log.term("emission", "L", term);
            sum += term;
        }
        if (depth > limits.max_depth) break;

        const bool goes_on =
            scene.visit_material(at.surface.object.material, [&](const auto& material) {
                if (has(lobes(material), Lobes::diffuse) && limits.sample_lights &&
                    !scene.lights.empty()) {
                    const auto chosen = choose_light(tracer.lights, next_1d<T>(stream));
                    const auto weigh = [&](const LightSampleT<T>& light,
                                           const Vec3T<T>& wi) {
                        if (light.pdf == T(0))
                            return T(1); // no path meets a point light
                        return balance(light.pdf * chosen.probability,
                                       pdf(material, at.wo, wi));
                    };
                    const RgbT<T> term =
                        throughput *
                        direct_light(scene, scene.lights[chosen.light], at, material,
                                     next_2d<T>(stream), weigh, counts) /
                        chosen.probability;
                    log.term("shadow ray", "DL", term);
                    sum += term;
                }
                const auto scattered =
                    scatter(at.surface, material, at.wo, next_3d<T>(stream),
                            Transport::radiance);
                if (!scattered) return false;
                const auto* next = &scattered->sample;
                // From the last surface a path goes on to the lamp that its shadow ray
                // left a share of, and to nothing else.
                if (depth == limits.max_depth && next->specular) return false;
                throughput *= next->weight;
                squeeze *= next->squeeze;
                bsdf_pdf = next->pdf;
                from = at.surface.point.position;
                log.vertex(next->specular ? 'S' : 'D', from, throughput, next->pdf);
                medium = medium_beyond(medium, material, at.wo, next->wi);
                ray = ray_from(at.surface.point, scattered->wi);
                return true;
            });
        if (!goes_on || is_black(throughput)) break;
        if (depth >= limits.roulette_depth &&
            !survives(throughput, squeeze, next_1d<T>(stream)))
            break;
        ++counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
