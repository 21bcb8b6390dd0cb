#pragma once

/// \file ljus/render/photon_mapping.hpp
/// \brief The report's renderer: rays from the camera, and two photon maps.

#include "ljus/path/all_lights.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/render/detail/later_caustics.hpp"
#include "ljus/render/photon_maps.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup photon_mapping Photon mapping
/// \brief Section 3: the two-pass renderer. Chapter: \ref ch_two_pass.
///
/// Every light path has one owner:
///
/// | path            | who carries it                                              |
/// |-----------------|-------------------------------------------------------------|
/// | E S* L          | emission, while no diffuse surface has been met             |
/// | E ... D L       | shadow rays, or a verdict of shadow photons in their place  |
/// | E ... D S+ L    | the caustics map, at every diffuse surface                  |
/// | E ... D ... D.. | indirect rays, or the general map where the first one ends  |
/// \{

/// A scene with its photon maps. It refers to both, which must outlive it.
/// \tparam Draws  What its numbers are drawn from: RandomStream, or StratifiedStream:
///                the rays of a pixel share out lamps and directions.
template <SceneLike S, typename Draws = RandomStream>
struct PhotonMapper {
    using Stream = Draws; ///< What render() gives it to draw from.
    /// The caustics map answers many samples of a picture together.
    using Later = detail::LaterCaustics<typename S::Scalar>;
    detail::IndexedT<S> scene;                   ///< What is rendered.
    const PhotonMapsT<typename S::Scalar>& maps; ///< Of the first pass.
    PhotonMappingSettings settings;              ///< Depths, radii, passes.
    Lobes bounces; ///< By which lobes a path goes on until its light is gathered.
};

/// Makes a photon mapper.
/// \tparam Draws    RandomStream or StratifiedStream.
/// \param scene     Must outlive the mapper; a scene, which it indexes, or an
///                  IndexedScene.
/// \param maps      Of make_photon_maps(); must outlive the mapper.
/// \param settings  Depths, radii, who carries indirect light.
/// \return The mapper.
/// \throws std::invalid_argument  if a setting is out of range.
template <typename Draws = RandomStream, SceneLike S>
[[nodiscard]] PhotonMapper<S, Draws>
make_photon_mapper(const S& scene, const PhotonMapsT<typename S::Scalar>& maps,
                   const PhotonMappingSettings& settings = {}) {
    check(settings);
    PhotonMappingSettings resolved = settings;
    if (settings.caustics_estimate.radius == 0)
        resolved.caustics_estimate.radius = float(typical_radius(maps.caustics, 32));
    if (settings.general_estimate.radius == 0)
        resolved.general_estimate.radius = float(typical_radius(maps.general, 64));
    const bool rays = detail::choose_passes(needs(scene), settings).indirect_rays;
    const bool gloss = settings.indirect == IndirectLight::cache;
    return {detail::IndexedT<S>(scene), maps, resolved,
            rays    ? Lobes::all
            : gloss ? Lobes::glossy | Lobes::specular
                    : Lobes::specular};
}
/// Not of a temporary: the scene would be gone before it is rendered.
template <typename Draws = RandomStream, SceneLike S>
PhotonMapper<S, Draws> make_photon_mapper(const S&& scene,
                                          const PhotonMapsT<typename S::Scalar>& maps,
                                          const PhotonMappingSettings& = {}) = delete;
/// Nor of temporary maps.
template <typename Draws = RandomStream, SceneLike S>
PhotonMapper<S, Draws> make_photon_mapper(const S& scene,
                                          const PhotonMapsT<typename S::Scalar>&& maps,
                                          const PhotonMappingSettings& = {}) = delete;

/// The light that a diffuse surface sends back along a camera path, but for what comes
/// by its indirect ray: shadow rays and the caustics map; or, where an indirect ray has
/// ended on it, the two maps.
/// \param mapper    The scene, the maps, the limits.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param gather    Whether the general map answers for all that is not a caustic.
/// \param stream    The numbers of the path.
/// \param counts    Counts rays and photons.
/// \param add       Called as add(owner, letters, radiance) with each term; it may put
///                  off the caustics map.
/// \report{Sections 3.2.3 and 3.2.6}
// [light_at]
template <SceneLike S, std::floating_point T, Material M, typename Stream, typename Add>
void light_at(const PhotonMapper<S, Stream>& mapper, const VertexT<T>& vertex,
              const M& material, bool gather, Stream& stream, Counts& counts,
              Add& add) {
    const PhotonMappingSettings& settings = mapper.settings;
    const auto ask = [&](const PhotonMapT<T>& map, const DensityEstimateSettings& how,
                         PhotonKinds kinds) {
        ++counts.map_queries;
        return estimate_radiance(map, vertex, material, vertex.wo, how, kinds,
                                 counts.map_photons);
    };
    if (gather && settings.indirect != IndirectLight::map) {
        ++counts.map_queries;
        const RgbT<T> irradiance = irradiance_at(
            mapper.maps.irradiance, vertex.point.position, detail::seen_normal(vertex));
        add("irradiance points", "DL|D..DL|DS+L",
            detail::reflected(material, vertex.wo, irradiance, Lobes::non_specular,
                              stream));
        return;
    }
    if (gather)
        add("general map", "DL|D..DL",
            ask(mapper.maps.general, settings.general_estimate, light_kinds));
    else
        add("shadow ray", "DL",
            detail::sample_all_lights(
                mapper.scene, vertex, material, settings.direct, settings.shadow_rays,
                stream, counts, detail::verdicts_at(mapper.maps.verdicts, vertex)));
    if (settings.indirect == IndirectLight::photons)
        add("general map", "D..DL",
            ask(mapper.maps.general, settings.general_estimate,
                one_kind(PhotonKind::indirect)));
    if (settings.indirect == IndirectLight::cache &&
        has(lobes(material), Lobes::diffuse))
        add("irradiance cache", "D..DL",
            detail::reflected(material, vertex.wo,
                              irradiance_between(mapper.scene, mapper.maps.irradiance,
                                                 mapper.maps.cache, vertex,
                                                 settings.gather, stream, counts),
                              Lobes::diffuse, stream));
    if (!mapper.maps.caustics.empty() &&
        !detail::put_off(add, vertex, material, settings.caustics_estimate))
        add("caustics map", "DS+L",
            ask(mapper.maps.caustics, settings.caustics_estimate, light_kinds));
}
// [light_at]

namespace detail {

/// The most branches that split off from one camera path at glass.
inline constexpr std::size_t max_splits = 8;

/// How many times more often than its throughput says a branch that split off survives
/// roulette. By its throughput alone such a faint branch would survive rarely, and then
/// be as bright as if it were the only one. The mean is the same for any number.
inline constexpr int split_survival = 16;

} // namespace detail

/// The radiance that one camera path finds with the help of the photon maps.
///
/// At each diffuse surface: one shadow ray to each light, the caustics map, and one
/// indirect ray; at each mirror or glass: one branch. With IndirectLight::map, the
/// first diffuse surface that an indirect ray meets answers from the general map; with
/// IndirectLight::photons, the one that the camera path meets itself. With split_glass
/// a path goes both ways at glass, as long as it has met nothing matt: by chance alone,
/// one path in some hundreds would be mirrored inside of a ball and meet the lamp, and
/// its pixel would be a hundred times too bright.
/// \param mapper  The scene, the maps, the limits.
/// \param ray     A primary ray.
/// \param stream  The numbers of this path.
/// \param counts  Counts rays and photons.
/// \param log     Told of each vertex and each term.
/// \return Radiance, W/(m^2 sr); biased by the radius of the estimates, and by the
///         depth where one is set.
/// \report{Sections 3.2.3, 3.2.4 and 3.2.6}
/// \erratum{In the report's program an indirect ray that met a lamp added it again,
///          though the shadow ray had counted it.}
// [radiance]
template <SceneLike S, typename Stream, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const PhotonMapper<S, Stream>& mapper,
                               const RayT<T>& ray, Stream& stream, Counts& counts,
                               Log&& log = {}) {
    const PhotonMappingSettings& settings = mapper.settings;
    RgbT<T> sum{T(0)};
    std::vector<PathStateT<T>> branches; // split off; following one may add more
    const auto follow_path = [&](PathStateT<T> path) {
        detail::AddTerm add{sum, path.throughput, log};
        while (path.depth < settings.max_depth) {
            const auto vertex = next_vertex(mapper.scene, path, stream);
            if (!vertex) return;
            detail::log_arrival(log, vertex->point.position);
            if (vertex->emits() && !path.met_diffuse)
                add("emission", "L", vertex->object.emission);

            const bool gather = path.met_diffuse && detail::gathers(settings.indirect);
            const auto at_material = [&]<typename M>(const M& material) {
                if constexpr (!OnlySpecular<M>)
                    if (has(lobes(material), Lobes::non_specular))
                        light_at(mapper, *vertex, material, gather, stream, counts,
                                 add);
                const Lobes open = gather ? Lobes::specular : mapper.bounces;
                if (path.depth == settings.max_depth) {
                    detail::cut_if(has(lobes(material), open), counts);
                    return false;
                }
                if (settings.split_glass && !path.met_diffuse &&
                    branches.size() < detail::max_splits)
                    if (const auto other = split_path(path, *vertex, material)) {
                        branches.push_back(*other);
                        return true;
                    }
                // Go on by one branch; after gathering, by mirrors and glass only.
                Lobes which = open;
                if (has(which, Lobes::diffuse) &&
                    detail::skips_bounce(mapper.maps.verdicts, *vertex, counts))
                    which = Lobes::specular;
                return continue_path(path, *vertex, material, Transport::radiance,
                                     which, stream);
            };
            if (!visit_material_at(mapper.scene, *vertex, at_material)) return;
            detail::log_vertex(log, path);
            if (is_black(path.throughput)) return;
            const T eta_scale = !branches.empty() && !path.met_diffuse
                                    ? path.eta_scale / T(detail::split_survival)
                                    : path.eta_scale;
            if (path.depth >= settings.roulette_depth &&
                !survives(path.throughput, eta_scale, next_1d<T>(stream)))
                return;
            ++counts.bounce_rays;
        }
    };
    log.begin();
    follow_path(detail::camera_path(mapper.scene, ray, stream));
    for (std::size_t i = 0; i < branches.size(); ++i) {
        const PathStateT<T> branch = branches[i];
        ++counts.bounce_rays;
        detail::log_specular_path(log, branch);
        follow_path(branch);
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
