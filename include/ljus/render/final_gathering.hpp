#pragma once

/// \file ljus/render/final_gathering.hpp
/// \brief Indirect light by rays that look up the irradiance where they end.

#include <cmath>
#include <limits>
#include <numbers>

#include "ljus/math/sampling.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/photons/irradiance_points.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus {

/// \defgroup final_gathering Final gathering
/// \brief The report's discussion: indirect photons, used well \cite jensen1996.
/// Chapter: \ref ch_final_gathering.
/// \{

namespace detail {

/// The side of a surface that is seen: its shading normal, or the other way.
/// \param vertex  The surface.
/// \return Unit vector.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> seen_normal(const VertexT<T>& vertex) noexcept {
    return std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
}

/// The light that some lobes of a material send to the viewer, if as much arrives from
/// every direction: the albedo times E over pi. Exact for a Lambertian surface; for any
/// other the albedo is estimated by one sample.
/// \param material    What the surface is made of.
/// \param wo          Unit vector in the surface's frame, to the viewer.
/// \param irradiance  E, W/m^2.
/// \param which       The lobes.
/// \param stream      Three numbers are drawn.
/// \return W/(m^2 sr).
// [reflected]
template <Material M, std::floating_point T, typename Stream>
[[nodiscard]] RgbT<T> reflected(const M& material, const Vec3T<T>& wo,
                                const RgbT<T>& irradiance, Lobes which,
                                Stream& stream) {
    const auto scattered =
        sample(material, wo, next_3d<T>(stream), Transport::radiance, which);
    if (!scattered) return RgbT<T>{T(0)};
    return scattered->weight * irradiance * std::numbers::inv_pi_v<T>;
}
// [reflected]

} // namespace detail

/// What a gather ray brings.
template <std::floating_point T>
struct GatherRayT {
    RgbT<T> radiance{T(0)};                          ///< W/(m^2 sr).
    T distance = std::numeric_limits<T>::infinity(); ///< To the first surface.
};

/// Follows a gather ray: through mirrors and glass to a diffuse surface, where it looks
/// up the irradiance. A lamp that it meets adds nothing: shadow rays and the caustics
/// map have counted that light.
/// \param world      The closed scene.
/// \param points     Where the irradiance is known.
/// \param path       The ray, as it leaves a diffuse surface.
/// \param max_depth  The most surfaces on a path.
/// \param context    The numbers of the ray; counts rays and lookups.
/// \return Radiance and distance.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] GatherRayT<T>
gather_ray(const W& world, const IrradiancePointsT<T>& points, PathStateT<T> path,
           int max_depth, Context& context) {
    auto& stream = context.stream;
    Counts& counts = context.counts;
    // [gather_ray]
    GatherRayT<T> found;
    for (bool first = true; path.depth < max_depth; first = false) {
        ++counts.bounce_rays;
        const auto vertex = next_vertex(world, path, stream);
        if (!vertex) break;
        if (first) found.distance = vertex->distance;
        const auto at_material = [&](const auto& material) {
            const Lobes parts = lobes(material);
            if (has(parts, Lobes::non_specular)) {
                ++counts.map_queries;
                const RgbT<T> irradiance = irradiance_at(
                    points, detail::at_rest(world, *vertex).point.position,
                    detail::seen_normal(*vertex));
                found.radiance += path.throughput *
                                  detail::reflected(material, vertex->wo, irradiance,
                                                    Lobes::non_specular, stream);
            }
            return has(parts, Lobes::specular) &&
                   continue_path(path, *vertex, material, Transport::radiance,
                                 Lobes::specular, stream);
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
    T spacing = T(0);  ///< How far the farthest of its nearest points lies; set when a
                       ///< cache is made.
};

/// Gathers the indirect irradiance at a vertex, by rays spread evenly over the cosine.
/// \param world     The closed scene.
/// \param points    What the rays look up.
/// \param vertex    Where; the side is that of `wo`.
/// \param settings  How many rays.
/// \param context   The numbers of this vertex; counts the rays.
/// \return Irradiance, normal and harmonic mean distance.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] GatheredT<T>
gather_irradiance(const W& world, const IrradiancePointsT<T>& points,
                  const VertexT<T>& vertex, const GatherSettings& settings,
                  Context& context) {
    // [gather_irradiance]
    GatheredT<T> gathered{.normal = detail::seen_normal(vertex)};
    const T side = std::copysign(T(1), vertex.wo.z);
    const detail::Strata strata = detail::strata_for(settings.rays);
    const std::uint64_t key = context.stream.key;
    T inverse = T(0);
    for (int i = 0; i < settings.rays; ++i) {
        const Vec3T<T> up = sample_cosine_hemisphere(
            detail::stratified(strata, i, key, next_2d<T>(context.stream)));
        const Vec3T<T> wi = to_world(vertex.frame, Vec3T<T>{up.x, up.y, side * up.z});
        const PathStateT<T> path{.ray = spawn_ray(vertex.point, wi, vertex.time),
                                 .medium = vertex.medium,
                                 .medium_known = true,
                                 .previous = vertex.point.position,
                                 .met_diffuse = true,
                                 .depth = 1,
                                 .branch = std::uint64_t(i + 1) << 20};
        auto numbers = context.stream; // next_vertex() moves them to the ray's own
        auto own = context_of(numbers, context.counts);
        const auto found = gather_ray(world, points, path, settings.max_depth, own);
        gathered.irradiance += found.radiance;
        inverse += T(1) / found.distance;
    }
    gathered.irradiance *= std::numbers::pi_v<T> / T(settings.rays);
    gathered.distance = T(settings.rays) / inverse;
    return gathered;
    // [gather_irradiance]
}

/// \}

} // namespace ljus
