#pragma once

/// \file ljus/render/survey.hpp
/// \brief What a scene requires: which passes run, and why.

#include <array>
#include <string>

#include "ljus/path/thin_surfaces.hpp"
#include "ljus/photons/photon_map.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup survey The survey
/// \brief "Model only what a scene requires": each pass says what it needs of a scene.
/// \{

/// Where light that has met two diffuse surfaces comes from.
enum class IndirectLight : std::uint8_t {
    rays,    ///< Indirect rays, on and on.
    map,     ///< One indirect ray, and the general map where it ends.
    photons, ///< The general map's indirect photons where the camera looks: no indirect
             ///< ray and little noise, but their light is blurred by the radius.
    none     ///< Nowhere: direct light and caustics only.
};

/// How the report's renderer works. Lengths are in scene units.
struct PhotonMappingSettings {
    int max_depth = 1000;     ///< Surfaces on a camera path, mirrors and glass counted.
    int roulette_depth = 4;   ///< From this surface on, roulette may end a path.
    int shadow_rays = 1;      ///< Shadow rays to each light, at least 1.
    bool split_glass = false; ///< At glass before anything matt, go both ways.
    IndirectLight indirect = IndirectLight::rays; ///< Who carries indirect light.
    PhotonPassSettings caustics{}; ///< Photons aimed at mirrors and glass.
    PhotonPassSettings general{};  ///< Photons for all the rest.
    DensityEstimateSettings caustics_estimate{}; ///< How caustics are estimated.
    DensityEstimateSettings general_estimate{
        .radius = 0.3f}; ///< How the general map is asked.
    bool keep_general_map =
        false; ///< Make the general map, even if no ray will ask it.
};

/// Refuses settings that give no picture.
/// \param settings  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const PhotonMappingSettings& settings) {
    require(settings.max_depth >= 1, "max_depth",
            static_cast<long long>(settings.max_depth), "at least 1");
    require(settings.shadow_rays >= 1, "shadow_rays",
            static_cast<long long>(settings.shadow_rays), "at least 1");
    require(settings.caustics.photons >= 0, "caustics.photons",
            settings.caustics.photons, "at least 0");
    require(settings.general.photons >= 0, "general.photons", settings.general.photons,
            "at least 0");
    check(settings.caustics_estimate);
    check(settings.general_estimate);
}

/// Whether a pass runs, and why or why not.
struct PlanItem {
    const char* pass = ""; ///< Its name.
    bool on = false;       ///< Whether it runs.
    std::string why;       ///< One clause.
};

/// What will run for a scene.
struct Plan {
    PlanItem shadow_rays;    ///< Rays to lights.
    PlanItem indirect_rays;  ///< Rays between diffuse surfaces.
    PlanItem caustics_map;   ///< Photons through mirrors and glass.
    PlanItem general_map;    ///< Direct, indirect and shadow photons.
    PlanItem shadow_photons; ///< Part of the general map.
    PlanItem thin_film;      ///< Rays go straight on through soap films.
    PlanItem flat_loop;      ///< How the first object on a ray is found.

    /// All items, in the order in which they are printed.
    [[nodiscard]] std::array<const PlanItem*, 7> items() const& {
        return {&shadow_rays,    &indirect_rays, &caustics_map, &general_map,
                &shadow_photons, &thin_film,     &flat_loop};
    }
    /// Not of a temporary: the items would be gone before they are read.
    std::array<const PlanItem*, 7> items() const&& = delete;
};

/// A plan, one line an item: its name, on or off, and why.
/// \param plan  The plan.
/// \return Lines that end with a line feed.
[[nodiscard]] inline std::string to_text(const Plan& plan) {
    std::string text;
    for (const PlanItem* item : plan.items()) {
        std::string name = item->pass;
        name.resize(16, ' ');
        text += name + (item->on ? "on   " : "off  ") + item->why + "\n";
    }
    return text;
}

/// What a survey counts in a scene.
struct SceneNeeds {
    std::size_t objects = 0;  ///< All.
    std::size_t diffuse = 0;  ///< Those with a part that is not a mirror or glass.
    std::size_t specular = 0; ///< Those with a part that is.
    std::size_t lights = 0;   ///< Emissive objects and point lights.
    bool films = false;       ///< Whether a material is a thin surface.
};

/// Counts what a scene is made of.
/// \param scene  The scene.
/// \return The counts.
template <typename Scene>
[[nodiscard]] SceneNeeds needs(const Scene& scene) {
    SceneNeeds found{.objects = scene.size(),
                     .lights = scene.lights.size(),
                     .films = has_thin_surfaces(scene)};
    for (const auto& objects : scene.objects)
        for (const auto& object : objects) {
            const Lobes parts = scene.visit_material(
                object.material, [](const auto& m) { return lobes(m); });
            found.diffuse += has(parts, Lobes::diffuse) ? 1 : 0;
            found.specular += has(parts, Lobes::specular) ? 1 : 0;
        }
    return found;
}

/// Says which passes a scene requires.
/// \param found     What the scene is made of.
/// \param settings  What the user asks for.
/// \return The plan.
[[nodiscard]] LJUS_CORE_INLINE Plan make_plan(const SceneNeeds& found,
                                              const PhotonMappingSettings& settings);

#ifndef LJUS_CORE // else it is there already
// [survey]
LJUS_CORE_INLINE Plan make_plan(const SceneNeeds& found,
                                const PhotonMappingSettings& settings) {
    const auto of_all = [&](std::size_t count, const char* what) {
        return std::to_string(count) + " of " + std::to_string(found.objects) +
               " objects " + what;
    };
    const auto item = [](const char* pass, bool on, std::string why) {
        return PlanItem{pass, on, std::move(why)};
    };
    Plan plan;
    const bool lit = found.diffuse > 0 && found.lights > 0;
    plan.shadow_rays =
        item("shadow rays", lit,
             found.lights == 0 ? "the scene has no light"
                               : of_all(found.diffuse, "reflect diffusely, lit by ") +
                                     std::to_string(found.lights) + " light(s)");
    const bool asked = settings.indirect == IndirectLight::rays ||
                       settings.indirect == IndirectLight::map;
    const bool rays = lit && asked && settings.max_depth > 1;
    plan.indirect_rays =
        item("indirect rays", rays,
             rays                      ? of_all(found.diffuse, "light each other")
             : settings.max_depth <= 1 ? "the depth ends at the first surface"
             : lit                     ? "not asked for"
                                       : "nothing is lit");
    const bool caustics = lit && found.specular > 0 && settings.caustics.photons > 0;
    plan.caustics_map =
        item("caustics map", caustics,
             found.specular == 0              ? "no object mirrors or refracts"
             : settings.caustics.photons == 0 ? "0 photons were asked for"
             : lit ? of_all(found.specular, "mirror or refract")
                   : "nothing is lit");
    const bool general =
        lit && settings.general.photons > 0 &&
        ((rays && settings.indirect == IndirectLight::map) ||
         settings.indirect == IndirectLight::photons || settings.keep_general_map);
    plan.general_map =
        item("general map", general,
             general ? "indirect light is asked of it" : "no ray asks it");
    const bool shadows = general && settings.general.shadow_photons;
    plan.shadow_photons =
        item("shadow photons", shadows,
             shadows ? "the general map keeps them" : "no map keeps them");
    plan.thin_film =
        item("thin film", found.films,
             found.films ? "rays go pass_through on through the listed films"
                         : "no material is one");
    const bool few = found.objects <= flat_loop_limit;
    plan.flat_loop = item("flat loop", few,
                          std::to_string(found.objects) +
                              (few ? std::string(" object(s), no need for a tree")
                                   : std::string(" objects, a tree is faster from ") +
                                         std::to_string(flat_loop_limit + 1) + " on"));
    return plan;
}
// [survey]
#endif

/// Says which passes a scene requires.
/// \param scene     The scene.
/// \param settings  What the user asks for.
/// \return The plan; printed by examples, obeyed by make_photon_maps().
template <typename Scene>
[[nodiscard]] Plan survey(const Scene& scene, const PhotonMappingSettings& settings) {
    return make_plan(needs(scene), settings);
}

/// \}

} // namespace ljus
