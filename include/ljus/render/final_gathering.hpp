#pragma once

/// \file ljus/render/final_gathering.hpp
/// \brief Indirect light by rays that look up the irradiance where they end.

#include <cmath>
#include <concepts>
#include <limits>
#include <numbers>
#include <type_traits>

#include "ljus/math/sampling.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/photons/irradiance_points.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus {

/// \defgroup final_gathering Final gathering
/// \brief Rays that use photons one bounce away \cite jensen1996 , which the report
/// proposes in its discussion. Chapter: \ref ch_final_gathering.
/// \{

namespace detail {

/// The radiance that some lobes of a material reflect or transmit along `wo` if the
/// incident radiance on each side of the surface is the same in all directions. This
/// radiance is the albedo times E / pi, where E is the irradiance. For a Lambertian
/// surface the result is exact; the albedo of any other surface is estimated by one
/// sample.
/// \param irradiance  Called with a direction in the frame; returns E on the side into
///                    which the direction points, in W/m^2. Not called for a black
///                    Lambertian surface, such as most lamps.
/// \param stream      Three numbers are drawn, or none for a Lambertian surface.
/// \return W/(m^2 sr).
// [reflected]
template <Material M, std::floating_point T, typename Irradiance, typename Stream>
[[nodiscard]] RgbT<T> reflected(const M& material, const Vec3T<T>& wo,
                                const Irradiance& irradiance, Lobes which,
                                Stream& stream) {
    const auto radiance = [&](const RgbT<T>& weight, const Vec3T<T>& wi) {
        return weight * irradiance(wi) * std::numbers::inv_pi_v<T>;
    };
    if constexpr (std::same_as<M, LambertianT<T>>) {
        if (!has(which, Lobes::diffuse) || is_black(material.albedo))
            return RgbT<T>{T(0)};
        return radiance(material.albedo, {T(0), T(0), std::copysign(T(1), wo.z)});
    } else {
        const auto scattered =
            sample(material, wo, next_3d<T>(stream), Transport::radiance, which);
        if (!scattered) return RgbT<T>{T(0)};
        return radiance(scattered->weight, scattered->wi);
    }
}
// [reflected]

} // namespace detail

/// The data that gather rays look up where they end.
template <std::floating_point T>
struct GatherLookupT {
    const IrradiancePointsT<T>* points; ///< The points with known irradiance.
    /// The general map, from which irradiance is estimated where no point is near; may
    /// be null.
    const PhotonMapT<T>* general = nullptr;
    IrradiancePointSettings irradiance{}; ///< How the points were made.
    /// The caustics map, for estimates of irradiance and for glossy surfaces; may be
    /// null.
    const PhotonMapT<T>* caustics = nullptr;
    /// How caustics on glossy surfaces are estimated.
    DensityEstimateSettings caustics_estimate{};
    /// Whether nearly specular objects counted as mirrors when the caustics map was
    /// made, see PhotonPassSettings::gloss_as_mirrors.
    bool gloss_as_mirrors = false;
    bool paths = false; ///< Whether gather rays continue at diffuse surfaces as at
                        ///< glossy ones, because the general map has too few photons.

    /// Looks up irradiance points alone: where no point is near, the irradiance is 0.
    GatherLookupT(const IrradiancePointsT<T>& known) noexcept : points(&known) {}
};

/// The result of a gather ray.
template <std::floating_point T>
struct GatherRayT {
    RgbT<T> radiance{T(0)};                          ///< The radiance in W/(m^2 sr).
    T distance = std::numeric_limits<T>::infinity(); ///< Distance to the first surface,
                                                     ///< in scene units.
};

namespace detail {

/// The irradiance on the side of a surface into which a direction points. If no
/// irradiance point is near, the irradiance is estimated from the maps, by the same
/// method as at the points; without a general map, the result is 0.
/// \param resting  The surface, as detail::at_rest() returns it.
/// \param wi       The direction, in the frame of the surface.
/// \param context  A random stream, used if there is no point; counts shadow rays.
/// \return W/m^2.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> irradiance_towards(const W& world, const GatherLookupT<T>& lookup,
                                         const VertexT<T>& resting, const Vec3T<T>& wi,
                                         Context& context) {
    const T side = std::copysign(T(1), wi.z);
    if (const auto known = irradiance_at(*lookup.points, resting.point.position,
                                         side * resting.frame.normal))
        return *known;
    if (!lookup.general) return RgbT<T>{T(0)};
    VertexT<T> vertex = resting;
    vertex.wo = {T(0), T(0), side};
    return irradiance_of_point(world, *lookup.general, lookup.caustics, vertex,
                               lookup.irradiance, lookup.points->disc, context);
}

/// The radiance that a glossy surface reflects to the viewer, of two kinds of light
/// only: straight from lamps, and from the caustics map.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> light_on_gloss(const W& world, const GatherLookupT<T>& lookup,
                                     const VertexT<T>& vertex, const M& material,
                                     Context& context) {
    RgbT<T> sum =
        sample_all_lights(world, vertex, material, {DirectLight::mis}, context);
    if (lookup.caustics && !lookup.caustics->empty()) {
        ++context.counts.map_queries;
        sum += estimate_radiance(*lookup.caustics, at_rest(world, vertex), material,
                                 vertex.wo, lookup.caustics_estimate, light_kinds,
                                 context.counts.map_photons);
    }
    return sum;
}

} // namespace detail

/// Follows a gather ray through mirrors and glass to a diffuse surface, and looks up
/// the irradiance there. A lamp that it meets adds nothing, because shadow rays and the
/// caustics map have counted that light.
///
/// Irradiance does not determine what a glossy surface reflects. At a glossy surface
/// the light of lamps and of the caustics map is therefore added, and the ray continues
/// in a sampled direction. With `lookup.paths` the same is done at a diffuse surface.
/// With `lookup.gloss_as_mirrors`, the caustics map has counted the light that reaches
/// the ray's origin via nearly_specular() surfaces. The ray then follows these surfaces
/// as if they were mirrors.
/// \param world      The closed scene.
/// \param lookup     Irradiance points, with or without photon maps.
/// \param path       The ray, as it leaves a diffuse surface.
/// \param max_depth  Largest number of surfaces on a path.
/// \param context    The random stream of the ray; counts rays and lookups.
/// \return Radiance and distance.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] GatherRayT<T>
gather_ray(const W& world, const std::type_identity_t<GatherLookupT<T>>& lookup,
           PathStateT<T> path, int max_depth, Context& context) {
    auto& stream = context.stream;
    Counts& counts = context.counts;
    // [gather_ray]
    GatherRayT<T> found;
    bool mirrors = lookup.gloss_as_mirrors; // narrow gloss acts as a mirror
    for (bool first = true; path.depth < max_depth; first = false) {
        ++counts.bounce_rays;
        const auto vertex = next_vertex(world, path, stream);
        if (!vertex) break;
        if (first) found.distance = vertex->distance;
        const auto at_material = [&](const auto& material) {
            const Lobes parts = lobes(material);
            Lobes on = Lobes::specular;
            if (has(parts, Lobes::glossy) ||
                (lookup.paths && has(parts, Lobes::diffuse))) {
                on = Lobes::all;
                if (!mirrors || !nearly_specular_at(world, *vertex, material)) {
                    found.radiance +=
                        path.throughput * detail::light_on_gloss(world, lookup, *vertex,
                                                                 material, context);
                    mirrors = lookup.gloss_as_mirrors && has(parts, Lobes::diffuse);
                }
            } else if (has(parts, Lobes::diffuse)) {
                ++counts.map_queries;
                const auto irradiance = [&](const Vec3T<T>& wi) {
                    return detail::irradiance_towards(
                        world, lookup, detail::at_rest(world, *vertex), wi, context);
                };
                found.radiance += path.throughput *
                                  detail::reflected(material, vertex->wo, irradiance,
                                                    Lobes::diffuse, stream);
            }
            return continue_path(path, *vertex, material, Transport::radiance, on,
                                 stream);
        };
        if (!visit_material_at(world, *vertex, at_material)) break;
        if (!survives(path.throughput, path.eta_scale, next_1d<T>(stream))) break;
    }
    return found;
    // [gather_ray]
}

/// Irradiance that was gathered at a point.
template <std::floating_point T>
struct GatheredT {
    RgbT<T> irradiance{T(0)}; ///< Irradiance of indirect light alone, in W/m^2.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit normal, on the visible side.
    T distance = T(0); ///< Harmonic mean of the gather rays' lengths, in scene units.
    /// Distance to the k-th nearest point of the cache with a similar normal, where k
    /// is GatherSettings::nearest. The point itself is the first.
    T spacing = T(0);
    RgbT<T> brightest{T(0)}; ///< The brightest ray's part of the irradiance, in W/m^2;
                             ///< 0 once a cache has divided it among near points.
};

/// Gathers the indirect irradiance at a vertex, by stratified rays. On a Lambertian
/// surface the density of the rays is proportional to the cosine. On any other surface
/// the rays are sampled from the diffuse lobe. The result is then the irradiance of a
/// uniform light under which the lobe, seen along `wo`, would be as bright as under the
/// actual light:
///
/// \f[ \pi\, \frac{\sum_i w_i L_i}{\sum_i w_i}, \quad
/// w_i = \frac{f(\omega_o, \omega_i) |\cos\theta_i|}{p(\omega_i)}, \f]
///
/// where ray i has the direction \f$ \omega_i \f$ with density p and finds the radiance
/// \f$ L_i \f$, and f is the lobe with \f$ \omega_o \f$ as `wo`.
///
/// \param world     The closed scene.
/// \param lookup    The data that the rays look up.
/// \param vertex    The surface; `wo` chooses its side.
/// \param material  Its material.
/// \param settings  The number of rays, and their depth.
/// \param context   The random stream of this vertex; counts the rays.
/// \return All but the spacing.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] GatheredT<T>
gather_irradiance(const W& world, const std::type_identity_t<GatherLookupT<T>>& lookup,
                  const VertexT<T>& vertex, const M& material,
                  const GatherSettings& settings, Context& context) {
    GatheredT<T> gathered{.normal = detail::seen_normal(vertex)};
    constexpr bool lambertian = std::same_as<M, LambertianT<T>>;
    const T side = std::copysign(T(1), vertex.wo.z);
    const detail::Strata strata = detail::strata_for(settings.rays);
    const std::uint64_t key = context.stream.key;
    RgbT<T> weights{T(0)};
    T inverse = T(0);
    for (int i = 0; i < settings.rays; ++i) {
        const Vec2T<T> u =
            detail::stratified(strata, i, key, next_2d<T>(context.stream));
        PathStateT<T> path{.medium = vertex.medium,
                           .medium_known = true,
                           .previous = vertex.point.position,
                           .met_diffuse = true,
                           .depth = 1,
                           .branch = std::uint64_t(i + 1) << 20};
        if constexpr (lambertian) {
            const Vec3T<T> up = sample_cosine_hemisphere(u);
            path.ray = spawn_ray(
                vertex.point, to_world(vertex.frame, Vec3T<T>{up.x, up.y, side * up.z}),
                vertex.time);
        } else {
            const Vec3T<T> u3{u.x, u.y, next_1d<T>(context.stream)};
            const auto next =
                scatter(vertex, material, u3, Transport::radiance, Lobes::diffuse);
            if (!next) continue;
            path.ray = spawn_ray(vertex.point, next->wi, vertex.time);
            path.medium = detail::medium_beyond(vertex.medium, material, vertex.wo,
                                                next->sample.wi);
            path.throughput = next->sample.weight;
            weights += next->sample.weight;
        }
        auto numbers = context.stream; // next_vertex() sets them to the ray's own
        auto own = context_of(numbers, context.counts);
        const auto found = gather_ray(world, lookup, path, settings.max_depth, own);
        gathered.irradiance += found.radiance;
        if (max_component(found.radiance) > max_component(gathered.brightest))
            gathered.brightest = found.radiance;
        inverse += T(1) / found.distance;
    }
    if constexpr (lambertian) weights = RgbT<T>{T(settings.rays)};
    for (int c = 0; c < 3; ++c) {
        const T scale = weights[c] > T(0) ? std::numbers::pi_v<T> / weights[c] : T(0);
        gathered.irradiance[c] *= scale;
        gathered.brightest[c] *= scale;
    }
    gathered.distance = T(settings.rays) / inverse;
    return gathered;
}

/// \}

} // namespace ljus
