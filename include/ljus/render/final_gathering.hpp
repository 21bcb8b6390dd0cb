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
/// \brief The report's discussion: better use of indirect photons \cite jensen1996.
/// Chapter: \ref ch_final_gathering.
/// \{

namespace detail {

/// The shading normal of a surface, flipped to the side of `wo`.
/// \return Unit vector.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> seen_normal(const VertexT<T>& vertex) noexcept {
    return std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
}

/// The radiance that some lobes of a material reflect or transmit along `wo` if the
/// incident radiance on each side is the same in all directions: albedo times E / pi.
/// It is exact for a Lambertian surface; the albedo of any other is estimated by one
/// sample.
/// \param material    The material of the surface.
/// \param wo          Unit vector in the surface's frame, to the viewer.
/// \param irradiance  Called with a direction in the frame: E on its side, W/m^2.
/// \param which       The lobes.
/// \param stream      Three numbers are drawn, for a Lambertian surface none.
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
        if (!has(which, Lobes::diffuse)) return RgbT<T>{T(0)};
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

/// What gather rays look up where they end.
template <std::floating_point T>
struct GatherLookupT {
    const IrradiancePointsT<T>* points;          ///< The points with known irradiance.
    const PhotonMapT<T>* general = nullptr;      ///< For surfaces without points.
    IrradiancePointSettings irradiance{};        ///< How the points were made.
    const PhotonMapT<T>* caustics = nullptr;     ///< For both, and glossy surfaces.
    DensityEstimateSettings caustics_estimate{}; ///< Estimate of caustics on gloss.
    bool gloss_as_mirrors = false; ///< As in the PhotonPassSettings of the map.
    bool paths = false; ///< Whether rays go on at diffuse surfaces as at glossy ones,
                        ///< since the map has too few photons.

    /// Irradiance points alone: where there is none, it is dark.
    GatherLookupT(const IrradiancePointsT<T>& known) noexcept : points(&known) {}
};

/// What a gather ray finds.
template <std::floating_point T>
struct GatherRayT {
    RgbT<T> radiance{T(0)};                          ///< W/(m^2 sr).
    T distance = std::numeric_limits<T>::infinity(); ///< To the first surface.
};

namespace detail {

/// The irradiance on the side of a surface into which a direction points. Where few
/// indirect photons land, as in the open or behind a wall that keeps most of them back,
/// no point may be near; then the irradiance is computed as it is for the points.
/// \param lookup   The points and the maps.
/// \param resting  The surface, detail::at_rest().
/// \param wi       In its frame.
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
    return irradiance_of_point(world, *lookup.general, *lookup.caustics, vertex,
                               lookup.irradiance, lookup.points->disc, context);
}

/// The radiance that a glossy surface reflects to the viewer, of the light that arrives
/// straight from lamps or is in the caustics map.
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
/// Irradiance does not tell what a glossy surface reflects. If the caustics map has
/// counted the light that reaches the ray's origin by nearly_specular() surfaces, the
/// ray is followed through these as through mirrors. At any other glossy surface the
/// light of lamps and of the caustics map is added, and the ray continues in a sampled
/// direction. With `lookup.paths` it does so at a diffuse surface as well.
/// \param world      The closed scene.
/// \param lookup     Irradiance points, or these with a caustics map.
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
    bool mirrors = lookup.gloss_as_mirrors; // whether narrow gloss is one to this path
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
    RgbT<T> irradiance{T(0)};          ///< Indirect light alone; W/m^2.
    Vec3T<T> normal{T(0), T(0), T(1)}; ///< Unit, on the side that is seen.
    T distance = T(0); ///< Harmonic mean of the gather rays' lengths, in scene units.
    T spacing = T(0);  ///< Distance to its k-th nearest point; set by the cache.
};

/// Gathers the indirect irradiance at a vertex, by stratified rays with a density
/// proportional to the cosine. At a diffuse lobe that is not Lambertian the rays are
/// sampled from that lobe, and the result is the uniform irradiance that would be
/// reflected to `wo` as the actual light is,
///
/// \f[ \pi\, \frac{\sum_i w_i L_i}{\sum_i w_i}, \quad
///     w_i = \frac{f(\omega_o, \omega_i) |\cos\theta_i|}{p(\omega_i)}. \f]
///
/// \param world     The closed scene.
/// \param lookup    The data that the rays look up.
/// \param vertex    The surface; `wo` chooses its side.
/// \param material  Its material.
/// \param settings  The number of rays, and their depth.
/// \param context   The random stream of this vertex; counts the rays.
/// \return Irradiance, normal and harmonic mean distance.
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
        inverse += T(1) / found.distance;
    }
    if constexpr (lambertian)
        gathered.irradiance *= std::numbers::pi_v<T> / T(settings.rays);
    else
        for (int c = 0; c < 3; ++c)
            gathered.irradiance[c] *=
                weights[c] > T(0) ? std::numbers::pi_v<T> / weights[c] : T(0);
    gathered.distance = T(settings.rays) / inverse;
    return gathered;
}

/// The same for a Lambertian surface.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] GatheredT<T>
gather_irradiance(const W& world, const std::type_identity_t<GatherLookupT<T>>& lookup,
                  const VertexT<T>& vertex, const GatherSettings& settings,
                  Context& context) {
    return gather_irradiance(world, lookup, vertex, LambertianT<T>{}, settings,
                             context);
}

/// \}

} // namespace ljus
