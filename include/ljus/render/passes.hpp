#pragma once

/// \file ljus/render/passes.hpp
/// \brief The passes of the report's renderer that a scene requires.

#include <cstddef>
#include <string>
#include <tuple>

#include "ljus/path/next_vertex.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus {

/// \addtogroup survey
/// \{

/// Numbers that a survey counts in a scene.
struct SceneNeeds {
    std::size_t objects = 0;  ///< All objects.
    std::size_t diffuse = 0;  ///< Objects with a non-specular lobe.
    std::size_t specular = 0; ///< Objects with a specular lobe.
    std::size_t narrow = 0;   ///< Objects with a nearly_specular() material.
    std::size_t lights = 0;   ///< Lights, including emissive objects.
    std::size_t fog = 0;      ///< Media that scatter light.
    bool films = false;       ///< Whether a material is a thin surface.
};

/// Counts the objects and lights of a scene.
template <AnyWorld W>
[[nodiscard, gnu::cold]] SceneNeeds needs(const W& world) {
    SceneNeeds found{.objects = world.size(),
                     .lights = world.light_count(),
                     .films = detail::has_thin_surfaces(world)};
    world.each_object([&](ObjectId, const auto& object) {
        const Lobes parts = world.visit_material(
            object.material, [](const auto& m) { return lobes(m); });
        found.diffuse += has(parts, Lobes::non_specular) ? 1 : 0;
        found.specular += has(parts, Lobes::specular) ? 1 : 0;
        const auto narrow = [](const auto& m) { return nearly_specular(m); };
        found.narrow += world.visit_material(object.material, narrow) ? 1 : 0;
    });
    const auto count_fog = [&](const auto& list) {
        for (const auto& medium : list)
            found.fog += is_black(scattering(medium)) ? 0 : 1;
    };
    std::apply([&](const auto&... lists) { (count_fog(lists), ...); }, world.media());
    return found;
}

/// Which passes run: the decisions of a Plan, without their reasons.
struct Passes {
    bool shadow_rays = false;     ///< Whether rays to lights are traced.
    bool indirect_rays = false;   ///< Whether rays between diffuse surfaces are traced.
    bool caustics_map = false;    ///< Whether the caustics map is made.
    bool general_map = false;     ///< Whether the general map is made.
    bool volume_map = false;      ///< Whether photons in fog are stored.
    bool shadow_photons = false;  ///< Whether shadow photons are traced.
    bool skipped_rays = false;    ///< Whether unnecessary shadow rays are skipped.
    bool skipped_bounces = false; ///< Whether unnecessary indirect rays are skipped.
    bool irradiance = false;      ///< Whether irradiance points are made.
    bool cache = false;           ///< Whether the irradiance cache is made.
    bool gloss_as_mirrors = false; ///< Value of PhotonPassSettings::gloss_as_mirrors.
    bool caustics_on_gloss = true; ///< Whether the caustics map may have photons where
                                   ///< there is no diffuse lobe.
};

namespace detail {

/// Whether the general pass stores photons in fog, for indirect light.
[[nodiscard]] inline bool
scatters_in_fog(const PhotonMappingSettings& settings) noexcept {
    return settings.indirect != IndirectLight::none && settings.general.photons > 0;
}

} // namespace detail

/// Decides which passes a PhotonMapper runs; survey() gives the reasons.
/// \report{Section 3.2.2}
// [survey]
[[nodiscard, gnu::cold]] inline Passes
choose_passes(const SceneNeeds& found, const PhotonMappingSettings& settings) {
    const bool lit = found.diffuse + found.fog > 0 && found.lights > 0;
    const bool gather_asked = settings.indirect == IndirectLight::map ||
                              settings.indirect == IndirectLight::gather;
    const bool rays_asked = settings.indirect == IndirectLight::rays || gather_asked;
    const bool rays = lit && rays_asked && settings.max_depth > 1;
    const bool map_asked =
        (rays && gather_asked) || settings.indirect == IndirectLight::photons ||
        settings.indirect == IndirectLight::cache || settings.keep_general_map;
    const bool general = lit && map_asked && settings.general.photons > 0;
    const bool cache = settings.indirect == IndirectLight::cache;
    const bool looked_up = detail::uses_points(settings.indirect);
    const bool caustic = lit && settings.caustics.photons > 0;
    const bool gloss = caustic && general && looked_up && found.narrow > 0;
    const bool caustics = gloss || (caustic && found.specular > 0);
    const bool skip = lit && settings.skip.rule != SkipRule::none &&
                      double(settings.general.photons) >=
                          double(found.lights) * photons_needed(settings.skip);
    return {.shadow_rays = lit,
            .indirect_rays = rays,
            .caustics_map = caustics,
            .general_map = general,
            .volume_map =
                lit && found.fog > 0 && (caustics || detail::scatters_in_fog(settings)),
            .shadow_photons = skip || (general && settings.general.shadow_photons),
            .skipped_rays = skip,
            .skipped_bounces =
                rays && settings.skip.indirect_rays && settings.general.photons > 0,
            .irradiance = general && looked_up,
            .cache = general && cache,
            .gloss_as_mirrors = gloss,
            .caustics_on_gloss = !gloss || found.specular > 0};
}
// [survey]

namespace detail {

/// The settings for skipping rays. Skipping is switched off where the photons that
/// would justify it are not traced.
[[nodiscard]] inline SkipSettings skipping(const Passes& run,
                                           const PhotonMappingSettings& settings) {
    SkipSettings skip = settings.skip;
    if (!run.skipped_rays) skip.rule = SkipRule::none;
    skip.indirect_rays = run.skipped_bounces;
    return skip;
}

/// The reason why a PhotonMapper with these settings cannot render a scene with fog: a
/// sentence without a full stop, or nothing.
template <AnyWorld W>
[[nodiscard, gnu::cold]] std::string
refused_in_fog(const W& world, const PhotonMappingSettings& settings) {
    if (!world.has_fog()) return {};
    if (uses_points(settings.indirect))
        return "the scene has fog, and irradiance that is gathered or cached leaves "
               "its light out; let indirect light come by rays, map or photons, or "
               "remove the fog";
    if (skips_rays(settings.skip))
        return "the scene has fog, and photons that say which rays to skip do not know "
               "how much it dims; skip no rays, or remove the fog";
    return {};
}

} // namespace detail

/// \}

} // namespace ljus
