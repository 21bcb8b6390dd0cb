#pragma once

/// \file photon_options.hpp
/// \brief Options for what photons save and how they are shared out: which rays they
/// make needless, the budget for caustics, where their numbers come from.

#include <cstddef>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace examples {

/// The enumerator that a word names: the words are in the order of its enum.
template <typename Enum>
[[nodiscard]] Enum chosen(const std::vector<std::string>& words,
                          const std::string& word) {
    std::size_t i = 0;
    while (i + 1 < words.size() && words[i] != word) ++i;
    return static_cast<Enum>(i);
}

/// The word of an enumerator.
template <typename Enum>
[[nodiscard]] const std::string& word_of(const std::vector<std::string>& words,
                                         Enum value) {
    return words[static_cast<std::size_t>(value)];
}

// The names of what is chosen by a word, in the order of its enum.
/// Of ljus::SkipRule.
inline const std::vector<std::string> skip_rules{"none", "report", "any", "enough"};
/// Of ljus::CausticBudget.
inline const std::vector<std::string> budgets{"as-seen", "equal", "flux", "area",
                                              "brightness"};
/// Of ljus::PhotonSampling.
inline const std::vector<std::string> photon_numbers{"random", "sobol"};

/// What the user asks for.
struct PhotonOptions {
    std::string skip = "none";      ///< --skip
    std::string budget = "as-seen"; ///< --caustic-budget
    std::string numbers = "random"; ///< --photon-numbers
    bool skip_bounces = false;      ///< --skip-bounces
    double skip_radius = 0;         ///< --skip-radius, in scene units.
    double skip_tolerance = 0.05;   ///< --skip-tolerance
    double skip_risk = 0.05;        ///< --skip-risk
    double irradiance_radius = 0;   ///< --irradiance-radius, in scene units.
    double memory = 4;              ///< --photon-memory, in GB.
    int bounces = 1000;             ///< --photon-bounces
    int irradiance_shadow_rays = 4; ///< --irradiance-shadow-rays
    int gather_depth = 100;         ///< --gather-depth
};

/// Adds these options to a command line.
/// \param line  The command line.
/// \param what  Takes what the user gives; must live until the line is parsed.
inline void add_photon_options(CommandLine& line, PhotonOptions& what) {
    line.add("--skip", what.skip,
             "Shadow rays that photons make needless: none, by the report's rule, by "
             "any photon, or where enough agree",
             skip_rules);
    line.add("--skip-bounces", what.skip_bounces,
             "No indirect ray where no indirect photon is near");
    line.add("--skip-radius", what.skip_radius,
             "How near, scene units; 0: from the photons", 0, 1e6);
    line.add("--skip-tolerance", what.skip_tolerance,
             "Hidden share of a light that does not matter (enough)", 1e-6, 0.999);
    line.add("--skip-risk", what.skip_risk, "Of more being hidden (enough)", 1e-9,
             0.999);
    line.add("--caustic-budget", what.budget,
             "What mirrors and glass share the caustic photons by", budgets);
    line.add("--photon-numbers", what.numbers, "Chance, or evenly spread",
             photon_numbers);
    line.add("--photon-bounces", what.bounces, "Surfaces that a photon may meet", 1,
             1'000'000);
    line.add("--photon-memory", what.memory, "GB that a photon pass may take", 1e-6,
             1e6);
    line.add("--irradiance-radius", what.irradiance_radius,
             "Of precomputed irradiance, scene units; 0: from the photons", 0, 1e6);
    line.add("--irradiance-shadow-rays", what.irradiance_shadow_rays,
             "To each light where it is precomputed", 1, 10'000);
    line.add("--gather-depth", what.gather_depth, "Surfaces on a gather ray", 2,
             1'000'000);
}

/// Takes them into the settings of the photon mapper; no preset sets any of them.
/// \param settings  The settings.
/// \param what      What the user asked for.
inline void set_photon_options(ljus::PhotonMappingSettings& settings,
                               const PhotonOptions& what) {
    settings.skip = {.rule = chosen<ljus::SkipRule>(skip_rules, what.skip),
                     .indirect_rays = what.skip_bounces,
                     .radius = static_cast<float>(what.skip_radius),
                     .tolerance = static_cast<float>(what.skip_tolerance),
                     .risk = static_cast<float>(what.skip_risk)};
    settings.caustic_budget = chosen<ljus::CausticBudget>(budgets, what.budget);
    for (ljus::PhotonPassSettings* pass : {&settings.caustics, &settings.general}) {
        pass->max_bounces = what.bounces;
        pass->max_memory = 1e9 * what.memory;
    }
    settings.irradiance.radius = static_cast<float>(what.irradiance_radius);
    settings.irradiance.shadow_rays = what.irradiance_shadow_rays;
    settings.gather.max_depth = what.gather_depth;
}

/// Adds them to the settings in a JSON file.
/// \param json      With "caustics", "irradiance" and "gather".
/// \param settings  As the picture was rendered by.
inline void add_to_json(nlohmann::ordered_json& json,
                        const ljus::PhotonMappingSettings& settings) {
    const ljus::SkipSettings& skip = settings.skip;
    json["skip"] = {{"rule", word_of(skip_rules, skip.rule)},
                    {"bounces", skip.indirect_rays},
                    {"radius", skip.radius},
                    {"tolerance", skip.tolerance},
                    {"risk", skip.risk}};
    json["caustics"]["budget"] = word_of(budgets, settings.caustic_budget);
    if (!settings.caustics.shares.empty())
        json["caustics"]["shares"] = settings.caustics.shares;
    json["photon_numbers"] = word_of(photon_numbers, settings.caustics.numbers);
    json["photon_bounces"] = settings.caustics.max_bounces;
    json["photon_memory_gb"] = settings.caustics.max_memory * 1e-9;
    json["irradiance"]["radius"] = settings.irradiance.radius;
    json["irradiance"]["shadow_rays"] = settings.irradiance.shadow_rays;
    json["gather"]["depth"] = settings.gather.max_depth;
}

} // namespace examples
