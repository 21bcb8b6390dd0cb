#pragma once

/// \file ljus/render/detail/choose_passes.hpp
/// \brief Which passes of the report's renderer run.

#include <cstddef>
#include <string>

#include "ljus/path/next_vertex.hpp"
#include "ljus/render/photon_mapping_settings.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \addtogroup survey
/// \{

/// What a survey counts in a scene.
struct SceneNeeds {
    std::size_t objects = 0;  ///< How many there are.
    std::size_t diffuse = 0;  ///< Those with a part that is not a mirror or glass.
    std::size_t specular = 0; ///< Those with a part that is.
    std::size_t lights = 0;   ///< Emissive objects and point lights.
    bool films = false;       ///< Whether a material is a thin surface.
};

/// Counts what a scene is made of.
/// \param scene  The scene.
/// \return The counts.
template <SceneLike S>
[[nodiscard]] SceneNeeds needs(const S& scene) {
    SceneNeeds found{.objects = scene.size(),
                     .lights = scene.lights.size(),
                     .films = detail::has_thin_surfaces(scene)};
    for (const auto& objects : scene.objects)
        for (const auto& object : objects) {
            const Lobes parts = scene.visit_material(
                object.material, [](const auto& m) { return lobes(m); });
            found.diffuse += has(parts, Lobes::non_specular) ? 1 : 0;
            found.specular += has(parts, Lobes::specular) ? 1 : 0;
        }
    return found;
}

namespace detail {

/// Which passes run: the decisions of a plan, without their reasons.
struct Passes {
    bool shadow_rays = false;     ///< As in Plan.
    bool indirect_rays = false;   ///< As in Plan.
    bool caustics_map = false;    ///< As in Plan.
    bool general_map = false;     ///< As in Plan.
    bool shadow_photons = false;  ///< As in Plan.
    bool skipped_rays = false;    ///< As in Plan.
    bool skipped_bounces = false; ///< As in Plan.
    bool irradiance = false;      ///< As in Plan.
    bool cache = false;           ///< As in Plan.
};

/// Decides which passes run; make_photon_maps() and make_photon_mapper() obey it, and
/// make_plan() says why.
/// \report{Section 3.2.2}
/// \param found     What the scene is made of.
/// \param settings  What the user asks for.
/// \return The decisions.
// [survey]
[[nodiscard]] inline Passes choose_passes(const SceneNeeds& found,
                                          const PhotonMappingSettings& settings) {
    const bool lit = found.diffuse > 0 && found.lights > 0;
    const bool gather_asked = settings.indirect == IndirectLight::map ||
                              settings.indirect == IndirectLight::gather;
    const bool rays_asked = settings.indirect == IndirectLight::rays || gather_asked;
    const bool rays = lit && rays_asked && settings.max_depth > 1;
    const bool map_asked =
        (rays && gather_asked) || settings.indirect == IndirectLight::photons ||
        settings.indirect == IndirectLight::cache || settings.keep_general_map;
    const bool general = lit && map_asked && settings.general.photons > 0;
    const bool cache = settings.indirect == IndirectLight::cache;
    const bool looked_up = cache || settings.indirect == IndirectLight::gather;
    const bool skip = lit && settings.skip.rule != SkipRule::none &&
                      double(settings.general.photons) >=
                          double(found.lights) * photons_needed(settings.skip);
    return {.shadow_rays = lit,
            .indirect_rays = rays,
            .caustics_map = lit && found.specular > 0 && settings.caustics.photons > 0,
            .general_map = general,
            .shadow_photons = skip || (general && settings.general.shadow_photons),
            .skipped_rays = skip,
            .skipped_bounces =
                rays && settings.skip.indirect_rays && settings.general.photons > 0,
            .irradiance = general && looked_up,
            .cache = general && cache};
}
// [survey]

/// What is skipped, by a plan for these settings.
[[nodiscard]] inline SkipSettings skipping(const Passes& run,
                                           const PhotonMappingSettings& settings) {
    SkipSettings skip = settings.skip;
    if (!run.skipped_rays) skip.rule = SkipRule::none;
    skip.indirect_rays = run.skipped_bounces;
    return skip;
}

/// How a plan says what is chosen for the caustics: by what their photons are shared
/// out, and where their radius comes from.
/// \param settings  What the user asks for.
/// \return The end of a clause; nothing where nothing is chosen.
[[nodiscard]] inline std::string
caustics_clause(const PhotonMappingSettings& settings) {
    const char* const radius = settings.caustics_estimate.radius == 0
                                   ? ", the radius comes from the photons"
                                   : "";
    const auto clause = [&](const char* shares) {
        return std::string(shares).append(radius);
    };
    if (!settings.caustics.shares.empty()) return clause(", photons in given shares");
    switch (settings.caustic_budget) {
    case CausticBudget::equal:
        return clause(", each gets as many photons");
    case CausticBudget::flux:
        return clause(", photons are shared out by flux");
    case CausticBudget::area:
        return clause(", photons are shared out by caustic area");
    case CausticBudget::brightness:
        return clause(", photons are shared out by flux over brightness");
    default:
        return clause("");
    }
}

} // namespace detail

/// \}

} // namespace ljus
