#pragma once

/// \file ljus/inspect/survey.hpp
/// \brief The survey of a scene: which passes run for it, and why.

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "ljus/inspect/scene_remarks.hpp"
#include "ljus/radiosity/patch_grid.hpp"

namespace ljus {

/// \defgroup survey The survey
/// \brief A list of the passes of a renderer that a scene requires, with reasons.
/// \{

/// Whether a pass runs, and the reason.
struct PlanItem {
    const char* pass = ""; ///< Name of the pass.
    bool on = false;       ///< Whether the pass runs.
    std::string why;       ///< The reason, as one clause.
};

/// The passes that run for a scene.
struct Plan {
    PlanItem shadow_rays;     ///< Rays to lights.
    PlanItem indirect_rays;   ///< Rays between diffuse surfaces.
    PlanItem caustics_map;    ///< Photons that mirrors and glass scatter.
    PlanItem general_map;     ///< Direct, indirect and shadow photons.
    PlanItem volume_map;      ///< Photons stored where fog scatters them.
    PlanItem shadow_photons;  ///< Shadow photons in the general map.
    PlanItem skipped_rays;    ///< Shadow rays that photons make unnecessary.
    PlanItem skipped_bounces; ///< Indirect rays that photons make unnecessary.
    PlanItem irradiance;      ///< Irradiance points, which end the gather rays.
    PlanItem cache;           ///< Irradiance gathered at a few points of the picture.
    PlanItem thin_film;       ///< Thin surfaces, through which paths pass.
    PlanItem tree;            ///< A tree over the shapes, instead of a loop over them.
    /// Warnings about the scene, each with a remedy; most scenes have none.
    std::vector<std::string> remarks;

    /// All items, in the order of printing.
    [[nodiscard]] std::array<const PlanItem*, 12> items() const& {
        return {&shadow_rays, &indirect_rays,  &caustics_map, &general_map,
                &volume_map,  &shadow_photons, &skipped_rays, &skipped_bounces,
                &irradiance,  &cache,          &thin_film,    &tree};
    }
    /// Deleted for temporary plans, whose items would not exist when they are read.
    std::array<const PlanItem*, 12> items() const&& = delete;
};

/// One pass of a plan as a line of text with a line feed: its name, on or off, and the
/// reason.
[[nodiscard]] inline std::string to_text(const PlanItem& item) {
    std::string name = item.pass;
    name.resize(17, ' ');
    return name + (item.on ? "on   " : "off  ") + item.why + "\n";
}

/// A plan as lines of text with line feeds: one per pass, then the remarks.
[[nodiscard]] inline std::string to_text(const Plan& plan) {
    std::string text;
    for (const PlanItem* item : plan.items()) text += to_text(*item);
    for (const std::string& remark : plan.remarks)
        text += "remark          " + remark + "\n";
    return text;
}

namespace detail {

/// The end of a clause about the caustics map: how photons are distributed, and whether
/// the radius is chosen from the photons.
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

/// Makes the plan: the decisions of choose_passes(), with reasons.
[[nodiscard]] LJUS_CORE_INLINE Plan make_plan(const SceneNeeds& found,
                                              const PhotonMappingSettings& settings);

#ifndef LJUS_CORE // otherwise defined in ljus::core
// A text such as "3 of 7 objects mirror or refract", with the verbs for one object and
// for several.
inline std::string of_all(const SceneNeeds& found, std::size_t count, const char* one,
                          const char* several) {
    return std::to_string(count) + " of " + std::to_string(found.objects) +
           " objects " + (count == 1 ? one : several);
}

inline void plan_rays(Plan& plan, const Passes& run, const SceneNeeds& found,
                      const PhotonMappingSettings& settings) {
    plan.shadow_rays = {"shadow rays", run.shadow_rays,
                        found.lights == 0
                            ? "the scene has no light"
                            : of_all(found, found.diffuse, "reflects", "reflect") +
                                  " diffusely, lit by " + std::to_string(found.lights) +
                                  " light(s)"};
    plan.indirect_rays = {
        "indirect rays", run.indirect_rays,
        run.indirect_rays
            ? of_all(found, found.diffuse, "lights others", "light each other")
        : settings.max_depth <= 1 ? "the depth ends at the first surface"
        : run.shadow_rays         ? "not asked for"
                                  : "nothing is lit"};
}

inline void plan_photons(Plan& plan, const Passes& run, const SceneNeeds& found,
                         const PhotonMappingSettings& settings) {
    const auto casters = [&] {
        std::string text;
        if (found.specular > 0 || !run.gloss_as_mirrors)
            text = of_all(found, found.specular, "mirrors or refracts",
                          "mirror or refract");
        if (found.specular > 0 && run.gloss_as_mirrors) text += "; ";
        if (run.gloss_as_mirrors)
            text += of_all(found, found.narrow, "is nearly a mirror",
                           "are nearly mirrors") +
                    ", whose light is blurred as a caustic";
        return text;
    };
    plan.caustics_map = {"caustics map", run.caustics_map,
                         found.specular == 0 && !run.gloss_as_mirrors
                             ? "no object mirrors or refracts"
                         : settings.caustics.photons == 0
                             ? "0 photons were asked for, and caustics are missing"
                         : run.shadow_rays ? casters() + caustics_clause(settings)
                                           : "nothing is lit"};
    const bool used = run.shadow_rays && settings.indirect != IndirectLight::rays &&
                      settings.indirect != IndirectLight::none;
    plan.general_map = {"general map", run.general_map,
                        run.general_map ? "it provides indirect light"
                        : used && settings.general.photons == 0
                            ? "0 photons were asked for, and indirect light is missing"
                            : "no ray uses it"};
    plan.volume_map = {"volume map", run.volume_map,
                       found.fog == 0 ? "no fog scatters light"
                       : run.volume_map
                           ? std::to_string(found.fog) + " medium(s) scatter light"
                           : "nothing lights the fog but shadow rays"};
    plan.shadow_photons = {"shadow photons", run.shadow_photons,
                           run.skipped_rays     ? "they show which shadow rays to skip"
                           : run.shadow_photons ? "the general map keeps them"
                                                : "no map keeps them"};
}

inline void plan_skipping(Plan& plan, const Passes& run,
                          const PhotonMappingSettings& settings) {
    const std::string photons = std::to_string(settings.general.photons) + " photons";
    const std::string needed = std::to_string(photons_needed(settings.skip));
    plan.skipped_rays = {
        "skipped rays", run.skipped_rays,
        settings.skip.rule == SkipRule::none ? "no rule was asked for"
        : run.skipped_rays ? "where " + needed + " of " + photons + " agree"
        : !run.shadow_rays ? "nothing is lit"
                           : photons + ", and each light needs " + needed};
    plan.skipped_bounces = {
        "skipped bounces", run.skipped_bounces,
        run.skipped_bounces             ? "where none of " + photons + " is near"
        : !settings.skip.indirect_rays  ? "not asked for"
        : settings.general.photons == 0 ? "0 photons were asked for"
                                        : "there are no indirect rays"};
}

LJUS_CORE_INLINE Plan make_plan(const SceneNeeds& found,
                                const PhotonMappingSettings& settings) {
    const Passes run = choose_passes(found, settings);
    Plan plan;
    plan_rays(plan, run, found, settings);
    plan_photons(plan, run, found, settings);
    plan_skipping(plan, run, settings);
    const bool cached = settings.indirect == IndirectLight::cache;
    const bool looked_up = cached || settings.indirect == IndirectLight::gather;
    plan.irradiance = {"irradiance", run.irradiance,
                       !looked_up        ? "no gather ray asks for it"
                       : !run.irradiance ? "there is no general map"
                       : settings.irradiance.least == 0
                           ? "gather rays look it up where they end"
                           : "gather rays look it up where they end, unless fewer "
                             "than " +
                                 std::to_string(settings.irradiance.least) +
                                 " indirect photons are kept"};
    plan.cache = {"irradiance cache", run.cache,
                  run.cache ? "pixels interpolate what few points gather"
                  : cached  ? "there is no general map"
                            : "not asked for"};
    plan.thin_film = {"thin film", found.films,
                      found.films ? "paths pass through the listed films"
                                  : "no material is a thin film"};
    const bool tree = detail::needs_tree(found.objects);
    plan.tree = {"tree", tree,
                 std::to_string(found.objects) +
                     (tree ? " objects, a tree finds the first on a ray"
                           : " object(s), a loop tests each")};
    return plan;
}
#endif

// The longest side of the box around a scene, with three digits.
template <AnyWorld W>
[[gnu::cold]] std::string extent_of(const W& world) {
    BoxT<typename W::Scalar> box; // world.box() contains bounding spheres
    world.each_object([&](ObjectId id, const auto&) {
        box = box_union(box, world.visit_shape(id, [](const auto& shape) {
            return box_around(shape);
        }));
    });
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.3g",
                  double(max_component(box.high - box.low)));
    return text.data();
}

} // namespace detail

/// Reports which passes of a PhotonMapper a scene requires.
/// \return The plan that a PhotonMapper follows.
template <AnyWorld W>
[[nodiscard]] Plan survey(const W& world, const PhotonMappingSettings& settings) {
    Plan plan = detail::make_plan(needs(world), settings);
    // Beside the size of the scene, a radius in a wrong unit is noticed.
    const auto add_radius = [&](PlanItem& item, float radius) {
        if (item.on && radius > 0)
            item.why += "; radius " + to_text(radius) + " in a scene " +
                        detail::extent_of(world) + " across";
    };
    add_radius(plan.caustics_map, settings.caustics_estimate.radius);
    if (!plan.irradiance.on)
        add_radius(plan.general_map, settings.general_estimate.radius);
    plan.remarks = scene_remarks(world, settings);
    for (std::string& remark : detail::moving_remarks(
             world, plan.caustics_map.on,
             plan.general_map.on && detail::gathers(settings.indirect)))
        plan.remarks.push_back(std::move(remark));
    if constexpr (W::lists_fog)
        if (std::string why = detail::refused_in_fog(world, settings); !why.empty())
            plan.remarks.push_back(std::move(why));
    return plan;
}

/// Reports which hooks the types of a scene have; only the type of the world is used.
/// \return One line per type of shape, material and light that the scene lists: the
///         name of the type, the hooks that it has, and what happens without the other
///         hooks. A misspelt hook counts as missing.
template <AnyWorld W>
[[nodiscard]] std::vector<std::string> survey_hooks([[maybe_unused]] const W& world) {
    std::vector<std::string> lines;
    const auto add = [&](const std::string& type, const auto& hooks) {
        lines.push_back(type + " " + detail::to_line(hooks));
        return false; // continues with the next type
    };
    (void)W::any_shape([&]<typename G>() {
        return add("shape " + detail::type_name<G>(), detail::shape_hooks<G>());
    });
    (void)W::any_material([&]<typename M>() {
        return add("material " + detail::type_name<M>(), detail::material_hooks<M>());
    });
    (void)W::any_light([&]<typename L>() {
        return add("light " + detail::type_name<L>(), detail::light_hooks<L>());
    });
    return lines;
}

/// \}

} // namespace ljus
