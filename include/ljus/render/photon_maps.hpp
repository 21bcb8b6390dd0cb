#pragma once

/// \file ljus/render/photon_maps.hpp
/// \brief The first pass of the report's renderer (Section 3.2.2): photon maps.

#include "ljus/photons/budget.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/photons/verdict_grid.hpp"
#include "ljus/render/detail/choose_passes.hpp"
#include "ljus/render/detail/scene_remarks.hpp"
#include "ljus/render/irradiance_cache.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// What the first pass made (the report, Section 3.2.2). Plain data: it may be made in
/// any other way.
template <std::floating_point T>
struct PhotonMapsT {
    PhotonMapT<T> caustics; ///< L S+ D; empty if the scene has no mirror and no glass.
    PhotonMapT<T> general; ///< L D, L ... D ... D, and shadows; empty unless asked for.
    IrradiancePointsT<T> irradiance{}; ///< Looked up by gather rays, if any are sent.
    IrradianceCacheT<T> cache{};       ///< Of add_irradiance_cache(); else empty.
    VerdictGridT<T> verdicts{}; ///< Which rays can be left out; empty unless asked for.
    FluxAudit caustics_audit{}; ///< Where the flux of the caustics pass went.
    FluxAudit general_audit{};  ///< Where the flux of the general pass went.
    bool complete = true;       ///< False if the progress callback stopped the pass.
    std::string remarks{};      ///< Those of the survey, and why a pass gave up: lines.
};

/// The shares of the caustics' photons that a budget asks for, by a pilot.
/// \param scene     The scene.
/// \param settings  The budget, photons, radii. For the brightness 20 000 photons of a
///                  general pass tell what else lights the scene.
/// \return As PhotonPassSettings::shares; those of the settings if there are some.
template <SceneLike S>
[[nodiscard]] std::vector<double>
caustic_shares(const S& scene, const PhotonMappingSettings& settings) {
    using T = typename S::Scalar;
    const CausticBudget budget = settings.caustic_budget;
    if (budget == CausticBudget::as_seen || !settings.caustics.shares.empty())
        return settings.caustics.shares;
    std::vector<PhotonT<T>> light;
    if (budget == CausticBudget::brightness) {
        PhotonPassSettings pass = settings.general;
        pass.photons = 20000;
        pass.shadow_photons = false;
        pass.iteration = ~pass.iteration;
        pass.progress = no_progress;
        light = trace_photons(scene, MapType::general, pass).photons;
    }
    return caustic_shares(budget,
                          pilot_caustics(scene, settings.caustics,
                                         T(settings.caustics_estimate.radius), light,
                                         T(settings.general_estimate.radius)));
}

/// Runs the first pass: the maps that the plan asks for, and no others.
/// \param scene     The scene.
/// \param settings  Photons, seed, threads.
/// \return The maps, the same for any number of threads.
/// \throws std::invalid_argument  if a setting is out of range.
template <SceneLike S>
[[nodiscard]] PhotonMapsT<typename S::Scalar>
make_photon_maps(const S& scene, const PhotonMappingSettings& settings = {}) {
    check(settings);
    const detail::Passes run = detail::choose_passes(needs(scene), settings);
    PhotonPassSettings general = settings.general;
    general.shadow_photons = run.shadow_photons;
    const bool only_indirect = settings.indirect == IndirectLight::photons ||
                               settings.indirect == IndirectLight::gather ||
                               settings.indirect == IndirectLight::cache;
    PhotonKinds kept = settings.general.shadow_photons ? all_kinds : light_kinds;
    if (only_indirect && !settings.keep_general_map)
        kept = one_kind(PhotonKind::indirect);
    const SkipSettings skip = detail::skipping(run, settings);
    const bool verdicts = run.skipped_rays || run.skipped_bounces;
    if (!verdicts) general.keep = kept;
    if (!run.general_map && !run.skipped_bounces) { // only shadow rays are asked about
        general.max_bounces = 1;
        general.equal_lights = true;
    }
    PhotonMapsT<typename S::Scalar> maps;
    for (const std::string& remark : detail::scene_remarks(scene, settings))
        maps.remarks.append(remark).append("\n");
    const auto make = [&](MapType type, const PhotonPassSettings& pass, auto& map,
                          auto& audit) {
        auto traced = trace_photons(scene, type, pass);
        const bool general_pass = type == MapType::general;
        if (general_pass && verdicts)
            maps.verdicts = make_verdict_grid(traced.photons, scene.lights.size(), skip,
                                              pass.threads);
        if (general_pass && verdicts) // those that only the verdicts asked for
            std::erase_if(traced.photons,
                          [&](const auto& photon) { return !kept.has(photon.kind); });
        if (!general_pass || run.general_map) map = make_photon_map(traced.photons);
        audit = traced.audit;
        maps.complete = maps.complete && traced.complete;
        if (!traced.remark.empty()) maps.remarks.append(traced.remark).append("\n");
    };
    if (run.caustics_map) {
        PhotonPassSettings caustics = settings.caustics;
        caustics.shares = caustic_shares(scene, settings);
        make(MapType::caustics, caustics, maps.caustics, maps.caustics_audit);
    }
    if (run.general_map || verdicts)
        make(MapType::general, general, maps.general, maps.general_audit);
    if (run.irradiance && maps.complete)
        maps.irradiance = make_irradiance_points(
            detail::IndexedT<S>(scene), maps.general, maps.caustics,
            settings.irradiance, settings.general.seed, settings.general.threads);
    return maps;
}

/// Gathers indirect light for one picture, if the settings ask for an irradiance cache.
/// Without it, the renderer gathers at every vertex, which is slow and right.
/// \param maps      Of make_photon_maps(); gets the cache.
/// \param scene     Of the maps.
/// \param camera    A CameraT, or anything with a camera_ray().
/// \param picture   Size, seed, threads.
/// \param settings  As for the maps.
/// \throws std::invalid_argument  if a setting is out of range.
template <SceneLike S, template <std::floating_point> typename AnyCamera>
void add_irradiance_cache(PhotonMapsT<typename S::Scalar>& maps, const S& scene,
                          const AnyCamera<typename S::Scalar>& camera,
                          const RenderSettings& picture,
                          const PhotonMappingSettings& settings) {
    check(settings);
    if (detail::choose_passes(needs(scene), settings).cache)
        maps.cache = make_irradiance_cache(scene, maps.irradiance, camera, picture,
                                           settings.gather);
}

/// \}

} // namespace ljus
