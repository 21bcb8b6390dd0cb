#pragma once

/// \file ljus/render/gathering.hpp
/// \brief The ability of a photon mapper to gather indirect light.

#include "ljus/render/irradiance_cache.hpp"
#include "ljus/render/photon_mapping.hpp"

namespace ljus {

/// \addtogroup final_gathering
/// \{

/// The ability that IndirectLight::gather and IndirectLight::cache need.
struct Gathering {
    /// The data that a mapper keeps for gathering.
    template <std::floating_point T>
    struct State {
        IrradiancePointsT<T> points{}; ///< The points that gather rays look up.
        /// The cache, filled by PhotonMapper::fill_cache().
        IrradianceCacheT<T> cache{};
    };
};

/// The data that the gather rays of a mapper look up: its irradiance points and, for
/// glossy surfaces, its caustics map.
/// \param mapper  A PhotonMapper with the ability Gathering; must outlive the result.
template <typename Mapper>
[[nodiscard]] GatherLookupT<typename Mapper::Scalar>
gather_lookup(const Mapper& mapper) noexcept {
    GatherLookupT<typename Mapper::Scalar> lookup(
        mapper.template state<Gathering>().points);
    lookup.paths = mapper.maps().starved;
    if (mapper.passes().irradiance && !lookup.paths)
        lookup.general = &mapper.maps().general;
    lookup.irradiance = mapper.settings().irradiance;
    lookup.caustics = &mapper.maps().caustics;
    lookup.caustics_estimate = mapper.settings().caustics_estimate;
    lookup.gloss_as_mirrors = mapper.passes().gloss_as_mirrors;
    return lookup;
}

/// The fraction of the disc of a caustics estimate that lies on the surface, if the
/// caustics map holds the light of glossy surfaces. That light covers whole walls. The
/// estimates are divided by this fraction, or walls would be too dark along each edge.
/// \param mapper  A PhotonMapper with the ability Gathering.
/// \param vertex  The centre of the disc, as detail::at_rest() returns it.
/// \return In (0, 1]; 1 if the map holds no such light, or for an estimate with the k
///         nearest photons.
template <typename Mapper, std::floating_point T>
[[nodiscard]] T part_of_caustics(const Mapper& mapper, const VertexT<T>& vertex) {
    const DensityEstimateSettings& how = mapper.settings().caustics_estimate;
    if (!mapper.passes().gloss_as_mirrors || how.nearest > 0) return T(1);
    return part_on_surface(mapper.world(), vertex, detail::seen_normal(vertex),
                           T(how.radius));
}

/// The radiance that the surface at the end of an indirect ray reflects back along the
/// ray, computed from the irradiance of the nearest irradiance point on each side.
/// \param mapper    A PhotonMapper with the ability Gathering.
/// \param vertex    The surface.
/// \param material  Its material.
/// \param context   The random stream of the path; counts the lookup.
/// \return W/(m^2 sr).
template <typename Mapper, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> known_light(const Mapper& mapper, const VertexT<T>& vertex,
                                  const M& material, Context& context) {
    ++context.counts.map_queries;
    const auto irradiance = [&](const Vec3T<T>& wi) {
        return detail::irradiance_towards(mapper.world(), gather_lookup(mapper), vertex,
                                          wi, context);
    };
    return detail::reflected(material, vertex.wo, irradiance, Lobes::non_specular,
                             context.stream);
}

/// The radius of the disc in which photons_on_gloss() finds photons.
template <typename Mapper>
[[nodiscard]] auto radius_on_gloss(const Mapper& mapper) noexcept {
    return mapper.template state<Gathering>().points.disc / 6;
}

/// Whether a path that has met a diffuse surface ends at a glossy surface, where
/// photons_on_gloss() finds its indirect light. With nearly_specular() objects in the
/// scene the path goes on, because the general map lacks the light that they reflect.
/// It also goes on where the surface ends within the disc, as on thin rods, unless the
/// shape has corners: part_on_surface() knows which part of the disc lies on such a
/// shape.
template <typename Mapper, std::floating_point T, Material M>
[[nodiscard]] bool ends_on_gloss(const Mapper& mapper, const VertexT<T>& vertex,
                                 const M& material) {
    if (mapper.passes().gloss_as_mirrors || scatters_through(material) ||
        has(lobes(material), Lobes::diffuse))
        return false;
    const T radius = radius_on_gloss(mapper);
    if (!(radius > T(0))) return false;
    const VertexT<T>& resting = detail::at_rest(mapper.world(), vertex);
    const Vec3T<T> normal = detail::seen_normal(resting);
    const auto is_below = [&](const Vec3T<T>& off) {
        const auto found = detail::vertex_below(
            mapper.world(), resting.point.position + off, normal, radius);
        return found && found->id == vertex.id;
    };
    return mapper.world().visit_shape(vertex.id, [&](const auto& shape) {
        if constexpr (requires { corners_of(shape); }) return true;
        const Vec3T<T> x = radius * resting.frame.tangent;
        const Vec3T<T> y = radius * resting.frame.bitangent;
        return is_below(x) && is_below(-x) && is_below(y) && is_below(-y);
    });
}

/// The indirect radiance that a surface with a wide glossy lobe reflects to the viewer,
/// in W/(m^2 sr), estimated from the general map. The disc is small and holds few
/// photons: the mean over the paths of a pixel reduces noise, but not blur.
template <typename Mapper, std::floating_point T, Material M>
[[nodiscard]] RgbT<T> photons_on_gloss(const Mapper& mapper, const VertexT<T>& vertex,
                                       const M& material, Counts& counts) {
    ++counts.map_queries;
    const T radius = radius_on_gloss(mapper);
    const VertexT<T>& resting = detail::at_rest(mapper.world(), vertex);
    return estimate_radiance(mapper.maps().general, resting, material, vertex.wo,
                             DensityEstimateSettings{.radius = float(radius)},
                             one_kind(PhotonKind::indirect), counts.map_photons) /
           part_on_surface(mapper.world(), resting, detail::seen_normal(resting),
                           radius);
}

/// The indirect radiance that a matt surface reflects to the viewer, computed from the
/// irradiance cache.
/// \param mapper    A PhotonMapper with the ability Gathering.
/// \param vertex    The surface.
/// \param material  Its material.
/// \param context   The random stream of the path; counts the query and gather rays.
/// \return W/(m^2 sr).
template <typename Mapper, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> cached_light(const Mapper& mapper, const VertexT<T>& vertex,
                                   const M& material, Context& context) {
    const RgbT<T> irradiance = irradiance_between(
        mapper.world(), gather_lookup(mapper), mapper.template state<Gathering>().cache,
        vertex, material, mapper.settings().gather, context);
    const auto from_anywhere = [&](const Vec3T<T>& /*wi*/) { return irradiance; };
    return detail::reflected(material, vertex.wo, from_anywhere, Lobes::diffuse,
                             context.stream);
}

/// \}

} // namespace ljus
