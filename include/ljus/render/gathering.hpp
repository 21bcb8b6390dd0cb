#pragma once

/// \file ljus/render/gathering.hpp
/// \brief The ability of a photon mapper to gather indirect light.

#include "ljus/render/irradiance_cache.hpp"
#include "ljus/render/photon_mapping.hpp"

namespace ljus {

/// \addtogroup final_gathering
/// \{

/// IndirectLight::gather and IndirectLight::cache: `abilities<Gathering>`.
struct Gathering {
    /// What it keeps.
    template <std::floating_point T>
    struct State {
        IrradiancePointsT<T> points{}; ///< Looked up by gather rays, if any are sent.
        IrradianceCacheT<T> cache{};   ///< Of PhotonMapper::fill_cache(); else empty.
    };
};

/// The light that a surface sends back where a gather ray ends on it: what the nearest
/// irradiance point knows.
/// \param mapper    With Gathering.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param context   Three numbers are drawn; the lookup is counted.
/// \return W/(m^2 sr).
template <typename Mapper, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> known_light(const Mapper& mapper, const VertexT<T>& vertex,
                                  const M& material, Context& context) {
    ++context.counts.map_queries;
    const RgbT<T> irradiance =
        irradiance_at(mapper.template state<Gathering>().points, vertex.point.position,
                      detail::seen_normal(vertex));
    return detail::reflected(material, vertex.wo, irradiance, Lobes::non_specular,
                             context.stream);
}

/// The indirect light that a matt surface sends back, by the irradiance cache.
/// \param mapper    With Gathering.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param context   The numbers of the path; counts the query, and rays if there are
///                  any.
/// \return W/(m^2 sr).
template <typename Mapper, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> cached_light(const Mapper& mapper, const VertexT<T>& vertex,
                                   const M& material, Context& context) {
    const auto& state = mapper.template state<Gathering>();
    const RgbT<T> irradiance =
        irradiance_between(mapper.world(), state.points, state.cache, vertex,
                           mapper.settings().gather, context);
    return detail::reflected(material, vertex.wo, irradiance, Lobes::diffuse,
                             context.stream);
}

/// \}

} // namespace ljus
