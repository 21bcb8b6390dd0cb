#pragma once

/// \file ljus/render/photon_maps.hpp
/// \brief The first pass of the report's renderer: its photon maps.

#include "ljus/photons/tracing.hpp"
#include "ljus/photons/verdict_grid.hpp"
#include "ljus/render/survey.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// What the first pass made. Plain data: it may be made in any other way.
template <std::floating_point T>
struct PhotonMapsT {
    PhotonMapT<T> caustics; ///< L S+ D; empty if the scene has no mirror and no glass.
    PhotonMapT<T> general; ///< L D, L ... D ... D, and shadows; empty unless asked for.
    VerdictGridT<T> verdicts; ///< Which rays can be left out; empty unless asked for.
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
template <SceneLike S>
[[nodiscard]] PhotonMapsT<typename S::Scalar>
make_photon_maps(const S& scene, const PhotonMappingSettings& settings = {}) {
    check(settings);
    const detail::Passes run = detail::choose_passes(needs(scene), settings);
    PhotonPassSettings general = settings.general;
    general.shadow_photons = run.shadow_photons;
    const SkipSettings skip = detail::skipping(run, settings);
    const bool verdicts = run.skipped_rays || run.skipped_bounces;
    if (!run.general_map && !run.skipped_bounces) { // only shadow rays are asked about
        general.max_bounces = 1;
        general.equal_lights = true;
    }
    PhotonMapsT<typename S::Scalar> maps;
    const auto make = [&](MapType type, const PhotonPassSettings& pass, auto& map,
                          auto& audit) {
        auto traced = trace_photons(scene, type, pass);
        const bool general_pass = type == MapType::general;
        if (general_pass && verdicts)
            maps.verdicts = make_verdict_grid(traced.photons, scene.lights.size(), skip,
                                              pass.threads);
        if (general_pass && !settings.general.shadow_photons) // they have been asked
            std::erase_if(traced.photons, [](const auto& photon) {
                return photon.kind == PhotonKind::shadow;
            });
        if (!general_pass || run.general_map) map = make_photon_map(traced.photons);
        audit = traced.audit;
        maps.complete = maps.complete && traced.complete;
        if (!traced.remark.empty()) maps.remarks.append(traced.remark).append("\n");
    };
    if (run.caustics_map)
        make(MapType::caustics, settings.caustics, maps.caustics, maps.caustics_audit);
    if (run.general_map || verdicts)
        make(MapType::general, general, maps.general, maps.general_audit);
    return maps;
}

/// \}

} // namespace ljus
