#pragma once

/// \file ljus/render/photon_mapping.hpp
/// \brief The report's renderer: rays from the camera, and two photon maps.

#include "ljus/path/camera_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/photons/photon_map.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/survey.hpp"
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
/// | E ... D L       | shadow rays                                                 |
/// | E ... D S+ L    | the caustics map, at every diffuse surface                  |
/// | E ... D ... D.. | indirect rays, or the general map where the first one ends  |
/// \{

/// What the first pass made. Plain data: it may be made in any other way.
template <std::floating_point T>
struct PhotonMapsT {
    PhotonMapT<T> caustics; ///< L S+ D; empty if the scene has no mirror and no glass.
    PhotonMapT<T> general; ///< L D, L ... D ... D, and shadows; empty unless asked for.
    FluxAudit caustics_audit; ///< Where the flux of the caustics pass went.
    FluxAudit general_audit;  ///< Where the flux of the general pass went.
    bool complete = true;     ///< False if the progress callback stopped the pass.
    std::string remarks{};    ///< Why a pass gave up, if one did: lines.
};

/// Runs the first pass: the maps that the plan asks for, and no others.
/// \param scene     The scene.
/// \param settings  Photons, seed, threads.
/// \return The maps, the same for any number of threads.
/// \throws std::invalid_argument  if there is no light, or a setting is out of range.
template <typename Scene>
[[nodiscard]] PhotonMapsT<typename Scene::Scalar>
make_photon_maps(const Scene& scene, const PhotonMappingSettings& settings = {}) {
    check(settings);
    const Plan plan = survey(scene, settings);
    PhotonMapsT<typename Scene::Scalar> maps;
    const auto run = [&](MapType law, const PhotonPassSettings& pass, auto& map,
                         auto& audit) {
        const auto traced = trace_photons(scene, law, pass);
        map = make_photon_map(traced.photons);
        audit = traced.audit;
        maps.complete = maps.complete && traced.complete;
        if (!traced.remark.empty()) maps.remarks += traced.remark + "\n";
    };
    if (plan.caustics_map.on)
        run(MapType::caustics, settings.caustics, maps.caustics, maps.caustics_audit);
    if (plan.general_map.on)
        run(MapType::general, settings.general, maps.general, maps.general_audit);
    return maps;
}

/// A scene with its photon maps. It refers to both, which must outlive it.
template <typename Scene>
struct PhotonMapper {
    IndexedT<Scene> scene;                           ///< What is rendered.
    const PhotonMapsT<typename Scene::Scalar>& maps; ///< Of the first pass.
    PhotonMappingSettings settings;                  ///< How.
};

/// Makes a photon mapper.
/// \param scene     Must outlive the mapper; a scene, which it indexes, or an
///                  IndexedScene.
/// \param maps      Of make_photon_maps(); must outlive the mapper.
/// \param settings  Depths, radii, who carries indirect light.
/// \return The mapper.
/// \throws std::invalid_argument  if a setting is out of range.
template <typename Scene>
[[nodiscard]] PhotonMapper<Scene>
make_photon_mapper(const Scene& scene, const PhotonMapsT<typename Scene::Scalar>& maps,
                   const PhotonMappingSettings& settings = {}) {
    check(settings);
    return {IndexedT<Scene>(scene), maps, settings};
}

/// The light that a diffuse surface sends back along a camera path, but for what comes
/// by its indirect ray: shadow rays and the caustics map; or, where an indirect ray has
/// ended on it, the two maps.
/// \param mapper    The scene, the maps, the limits.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param gather    Whether the general map answers for all that is not a caustic.
/// \param stream    The numbers of the path.
/// \param counts    Counts rays and photons.
/// \param add       Called as add(owner, letters, radiance) with each term.
/// \report{Sections 3.2.3 and 3.2.6}
// [light_at]
template <typename Scene, std::floating_point T, typename Material, typename Add>
void light_at(const PhotonMapper<Scene>& mapper, const ShadingT<T>& at,
              const Material& material, bool gather, RandomStream& stream,
              Counts& counts, Add& add) {
    const PhotonMappingSettings& settings = mapper.settings;
    const auto ask = [&](const PhotonMapT<T>& map, const DensityEstimateSettings& how,
                         PhotonKinds kinds) {
        ++counts.map_queries;
        return estimate_radiance(map, at.surface, material, at.wo, how, kinds,
                                 counts.map_photons);
    };
    if (gather)
        add("general map", "DL|D..DL",
            ask(mapper.maps.general, settings.general_estimate, light_kinds));
    else
        add("shadow ray", "DL",
            sample_all_lights(mapper.scene, at, material, settings.shadow_rays, stream,
                              counts));
    if (settings.indirect == IndirectLight::photons)
        add("general map", "D..DL",
            ask(mapper.maps.general, settings.general_estimate,
                one_kind(PhotonKind::indirect)));
    if (!mapper.maps.caustics.empty())
        add("caustics map", "DS+L",
            ask(mapper.maps.caustics, settings.caustics_estimate, light_kinds));
}
// [light_at]

/// So many times, at most, a camera path goes both ways.
inline constexpr std::size_t max_splits = 8;

/// So many times more likely than elsewhere a way survives that began where a path went
/// both ways. It is faint: roulette as elsewhere would make it rare, and then as bright
/// as if it were the only one. Any number keeps the mean.
inline constexpr int second_way_luck = 16;

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
template <typename Scene, std::floating_point T, typename Log = NoLog>
[[nodiscard]] RgbT<T> radiance(const PhotonMapper<Scene>& mapper, RayT<T> ray,
                               RandomStream& stream, Counts& counts, Log&& log = {}) {
    const PhotonMappingSettings& settings = mapper.settings;
    RgbT<T> sum{T(0)};
    std::array<PathT<T>, max_splits> others; // the second ways, to be followed later
    std::array<int, max_splits> depths{};    // and how many boundaries they have met
    std::size_t splits = 0;

    const auto follow = [&](PathT<T> path, int first) {
        const auto add = [&](const char* owner, const char* letters,
                             const RgbT<T>& light) {
            log.term(owner, letters, path.throughput * light);
            sum += path.throughput * light;
        };
        for (int depth = first; depth <= settings.max_depth; ++depth) {
            start_bounce(stream, path.bounce + static_cast<std::uint64_t>(depth));
            const auto met = meet(mapper.scene, path.ray, stream);
            if (!met) return;
            const ShadingT<T> at =
                shading(mapper.scene, path.ray, met->hit, path.medium);
            path.throughput *=
                transmittance(path.medium, met->distance) * met->arrives();
            if (at.emits() && !path.met_diffuse)
                add("emission", "L", at.surface.object.emission);

            const bool gather =
                path.met_diffuse && settings.indirect == IndirectLight::map;
            const auto at_material = [&](const auto& material) {
                if (has(lobes(material), Lobes::diffuse))
                    light_at(mapper, at, material, gather, stream, counts, add);
                if (depth == settings.max_depth) return false;
                if (settings.split_glass && !path.met_diffuse && splits < max_splits) {
                    if (const auto other = split(path, at, material, log)) {
                        depths[splits] = depth;
                        others[splits++] = *other;
                        others[splits - 1].bounce = std::uint64_t(splits) << 32;
                        return true;
                    }
                }
                // Go on by one branch; after gathering, by mirrors and glass only.
                const bool by_rays =
                    !gather && (settings.indirect == IndirectLight::rays ||
                                settings.indirect == IndirectLight::map);
                return send_on(path, at, material,
                               by_rays ? Lobes::all : Lobes::specular, false, stream,
                               log);
            };
            if (!visit_material_of(mapper.scene, at.surface, at_material)) return;
            if (is_black(path.throughput)) return;
            const T eta_scale = splits > 0 && !path.met_diffuse
                                    ? path.eta_scale / T(second_way_luck)
                                    : path.eta_scale;
            if (depth >= settings.roulette_depth &&
                !survives(path.throughput, eta_scale, next_1d<T>(stream)))
                return;
            ++counts.bounce_rays;
        }
    };
    log.begin();
    follow({.ray = ray}, 1);
    for (std::size_t i = 0; i < splits; ++i) { // following one may add more
        const PathT<T> other = others[i];
        ++counts.bounce_rays;
        log.begin();
        for (int depth = 1; depth <= depths[i]; ++depth)
            log.vertex('S', other.ray.origin, other.throughput, T(0));
        follow(other, depths[i] + 1);
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
