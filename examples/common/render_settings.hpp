#pragma once

/// \file examples/common/render_settings.hpp
/// \brief Every setting of the program `render`, in one table: its option, the values
/// that it takes, its line of --help and its name in the file beside the picture.

#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "command_line.hpp"
#include "exr_files.hpp"
#include "ljus/image/image.hpp"
#include "ljus/render/first_hit.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping_settings.hpp"
#include "picture_slice.hpp"
#include "progressive_picture.hpp"
#include "promise.hpp"
#include "rendered.hpp"

namespace examples {

// Groups of settings, as --help has them.
inline const std::vector<std::string> common_groups{"Picture", "Renderer"};
inline const std::vector<std::string> photon_groups{
    "Photon mapping", "Photons", "Estimates from photons", "Gathering and cache",
    "Rays that photons make needless"};
inline const std::string path_group = "Path tracing";
inline const std::string pass_group = "Passes: photon maps that converge";

/// The values of --renderer. The last three show the first hit of each ray.
enum class RendererName { photon, path, normals, albedo, depth };

/// What a renderer shows of the first hit; nothing if it computes light.
[[nodiscard]] constexpr std::optional<ljus::FirstHit>
first_hit_of(RendererName renderer) noexcept {
    if (renderer == RendererName::normals) return ljus::FirstHit::normals;
    if (renderer == RendererName::albedo) return ljus::FirstHit::albedo;
    if (renderer == RendererName::depth) return ljus::FirstHit::depth;
    return std::nullopt;
}

/// All settings, as the user gave them or as chosen for the user.
struct RenderRequest {
    std::string scene{};                          ///< The scene file.
    std::vector<std::string> reads{};             ///< It and all files that it names.
    std::uint64_t scene_hash = 0;                 ///< Of their bytes as they were read.
    std::string file{};                           ///< The file of the picture or slice.
    RendererName renderer = RendererName::photon; ///< What a pixel shows.
    bool in_double = false;                       ///< Whether to compute in double.
    std::optional<ljus::Preset> preset{}; ///< Options given by name override it.
    ljus::RenderSettings picture{};       ///< Settings of the whole picture.
    int more_rays = 0;                    ///< More rays for pixels that need them.
    /// Deviation at which they get all of them.
    double disagreement = ljus::PresetRays{}.disagreement;
    double exposure = 0; ///< Exposure of PNG files, in stops.
    ljus::PhotonMappingSettings photon{.caustics_estimate = {.radius = 0.1f}};
    ljus::PathTracingSettings path{};
    /// How a path tracer's rays to lamps and its paths are weighted; none: paths alone.
    std::optional<ljus::MisHeuristic> path_lights = ljus::MisHeuristic::balance;
    double photon_memory = 4;      ///< Limit for each photon pass, in GB.
    PassOptions passes{};          ///< Progressive photon maps.
    Promise promise{};             ///< Seconds or an error.
    nlohmann::ordered_json kept{}; ///< How the promise was kept.
    std::string remarks{};         ///< Remarks on the photon passes, one a line.
    std::string slice{};           ///< "3/16", or nothing.
    SliceNumber part{};            ///< The same as a number.
    std::string region{};          ///< "40,30,64,48", or nothing.
    std::string layers{};          ///< "normal,albedo", or nothing.
    std::string pixel{};           ///< "120,80", or nothing.
    std::string photons{};         ///< Kind of photons to draw as dots, or nothing.
    bool plan = false;             ///< Print what would run.
    bool hooks = false;            ///< Print what the scene's types provide.
    bool quiet = false;            ///< No progress bar and no text.
};

/// Adds every setting: its name, the member that holds it, a line of help, and its
/// range. The words for an enum are the names of its enumerators.
/// \param line  The command line.
/// \param r     Receives the user's values; must live as long as the line.
inline void add_settings(CommandLine& line, RenderRequest& r) {
    using namespace ljus;
    constexpr int million = 1'000'000;
    constexpr long long billion = 1'000'000'000;
    auto& photon = r.photon;

    line.group("Program", {"--help", "--version", "--threads", "--quiet"});
    line.group("Files", {"--out"});
    line.add_positional("SCENE.json", r.scene, "The scene file");
    auto types = picture_types();
    types.push_back(".slice");
    line.file_types(types);
    line.add("--slice K/N", r.slice,
             "Render the K-th of N slices, which ljus-merge joins");

    line.group(common_groups[0], {"--width", "--height", "--rays", "--seed"});
    line.add("--region X,Y,W,H", r.region,
             "Only these pixels, counted from the upper left corner");
    line.add(
        "--layers LIST", r.layers,
        "With normal, albedo, depth, position, object, light-paths, or NAME=CLASS\n"
        "of light paths, as glass=ES+.*L: in NAME.exr, or in files NAME.*.pfm");
    line.add("--more-rays", r.more_rays,
             "Most further rays of a pixel, where the rays around it differ", 0,
             million);
    line.add("--disagreement", r.disagreement,
             "Relative standard deviation at which a pixel gets all of them", 1e-6,
             1e6);
    line.add("--sampling", r.picture.sampling, "Pattern of the rays in a pixel");
    line.add("--precision", r.in_double, "Precision of scene, photons and light",
             {{"float", false}, {"double", true}});
    line.add("--exposure", r.exposure, "Exposure of PNG files, in stops", -100, 100);

    line.group(common_groups[1]);
    line.add("--renderer", r.renderer,
             "Photon mapping; path tracing as its reference; or what each ray\n"
             "hits first: its normal n, as (n + 1)/2, its albedo, its distance");
    line.add("--preset", r.preset,
             "Settings that go together: a first look; no visible errors in\n"
             "the least time; or little bias, and noise unless there are many\n"
             "rays. What is given by name replaces the preset's own");
    line.add("--depth", photon.max_depth,
             "Largest number of surfaces on a path, mirrors included", 1, 1000);
    line.add("--roulette", photon.roulette_depth,
             "First surface at which roulette may end a path", 1, million);

    line.group("Promise: all other settings are chosen");
    line.add("--seconds", r.promise.seconds,
             "Seconds to spend: the picture with the least error", 0.01, 1e9);
    line.add("--error", r.promise.error, "relMSE to reach, in the least time", 1e-9,
             1e9);

    line.group(photon_groups[0]);
    line.add("--direct", photon.direct,
             "Light of lamps: by shadow rays; in closed form where there is\n"
             "one; or by multiple importance sampling");
    line.add("--shadow-rays", photon.shadow_rays, "Shadow rays to each light", 1,
             10'000);
    line.add("--indirect", photon.indirect,
             "Light of other surfaces: by rays; by the general map where one\n"
             "ray ends, or where the camera looks; by irradiance that was\n"
             "precomputed where one ray ends, or many rays at few points");
    line.add("--split-glass", photon.split_glass,
             "Follow both reflection and refraction at glass");

    line.group(photon_groups[1]);
    line.add("--caustic-photons", photon.caustics.photons,
             "Photons aimed at mirrors and glass", 0, billion);
    line.add("--general-photons", photon.general.photons,
             "Photons of the general map, if one is needed", 0, billion);
    line.add("--caustic-budget", photon.caustic_budget,
             "How mirrors, glass and lights share them: as lights see them;\n"
             "equally; or for the least error of the flux, of each caustic,\n"
             "or of what the eye sees");
    line.add("--photon-numbers", photon.caustics.numbers, "Random, or spread evenly");
    line.add("--photon-bounces", photon.caustics.max_bounces,
             "Largest number of surfaces on a photon's path", 1, million);
    line.add("--photon-memory", r.photon_memory, "GB that a photon pass may take", 1e-6,
             1e6);

    line.group(photon_groups[2]);
    const auto add_estimate = [&](const std::string& map,
                                  DensityEstimateSettings& estimate) {
        line.add("--" + map + "-radius", estimate.radius,
                 "Radius of a " + map + " estimate; 0: from the photons", 1e-15, 1e6,
                 true);
        line.add("--" + map + "-nearest", estimate.nearest,
                 "Nearest photons used; 0: all within the radius", 2, max_nearest,
                 true);
        line.add("--" + map + "-kernel", estimate.kernel,
                 "Kernel: the weight of a photon by its distance");
    };
    add_estimate("caustic", photon.caustics_estimate);
    add_estimate("general", photon.general_estimate);
    line.add("--fog-radius", photon.fog_estimate.radius,
             "Radius of each photon in fog; 0: from the photons around it", 1e-15, 1e6,
             true);
    line.add("--fog-nearest", photon.fog_estimate.nearest,
             "Photons around it, which set its radius", 1, 511);

    line.group(photon_groups[3]);
    line.add("--irradiance-every", photon.irradiance.every,
             "Photons for each point with precomputed irradiance", 2, million);
    line.add("--irradiance-nearest", photon.irradiance.nearest,
             "Photons in the estimate at such a point", 2, max_nearest);
    line.add("--irradiance-radius", photon.irradiance.radius,
             "Radius of that estimate; 0: from the photons", 0, 1e6);
    line.add("--irradiance-shadow-rays", photon.irradiance.shadow_rays,
             "Shadow rays from such a point to each light", 1, 10'000);
    line.add("--gather-rays", photon.gather.rays, "Rays from each point of the cache",
             1, million);
    line.add("--gather-tile", photon.gather.tile,
             "Pixels on a side that share a point of the cache", 1, 1000);
    line.add("--gather-nearest", photon.gather.nearest,
             "Points of the cache that a pixel interpolates", 2, max_cache_nearest);
    line.add("--gather-reach", photon.gather.reach,
             "Reach of such a point, relative to the mean distance it sees", 1e-3, 1e3);
    line.add("--gather-depth", photon.gather.max_depth,
             "Largest number of surfaces on a gather ray", 2, million);

    line.group(photon_groups[4]);
    line.add("--skip", photon.skip.rule,
             "Shadow rays to skip: none; by the report's rule; where all\n"
             "photons agree; or where enough of them agree");
    line.add("--skip-bounces", photon.skip.indirect_rays,
             "Skip indirect rays where no indirect photon is near");
    line.add("--skip-radius", photon.skip.radius,
             "Distance that counts as near; 0: from the photons", 0, 1e6);
    line.add("--skip-tolerance", photon.skip.tolerance,
             "Hidden fraction of a light that is ignored (enough)", 1e-6, 0.999);
    line.add("--skip-risk", photon.skip.risk, "Risk that more is hidden (enough)", 1e-9,
             0.999);

    line.group(path_group);
    line.add("--path-lights", r.path_lights,
             "Light of lamps: by shadow rays and paths, weighted by the\n"
             "balance or the power heuristic; or by only one of the two",
             {{"balance", MisHeuristic::balance},
              {"power", MisHeuristic::power},
              {"rays", MisHeuristic::shadow_rays},
              {"paths", std::nullopt}});
    line.add("--roulette-threshold", r.path.roulette_threshold,
             "Throughput below which roulette may end a path; 0: never", 0, 1e6);
    line.add("--roulette-max", r.path.roulette_max,
             "Largest probability of surviving roulette", 1e-6, 1);

    line.group(pass_group);
    add_pass_options(line, r.passes);

    line.group("Instead of the picture");
    line.add("--plan", r.plan, "Print what would run and why");
    line.add("--hooks", r.hooks,
             "Print what the scene's types provide, and what they do not");
    line.add("--explain X,Y", r.pixel, "Print the paths of a pixel");
    line.add("--show-photons", r.photons, "Draw photons as dots",
             {"direct", "indirect", "shadow", "caustic", "all"});
}

/// Chooses the settings that the user did not give: from the scene, from the preset,
/// and for passes.
/// \param line    The command line, parsed.
/// \param r       What the user asks for.
/// \param width   Of the scene's picture, in pixels.
/// \param height  Of the scene's picture, in pixels.
/// \param fog     Whether the scene has fog, in which no irradiance is cached.
/// \throws std::invalid_argument  for a picture that is too large.
inline void choose_settings(CommandLine& line, RenderRequest& r, int width, int height,
                            bool fog = false) {
    Options options = line.fill({width, height, ljus::RenderSettings{}.samples});
    ljus::require_image_size(options.width, options.height);
    if (r.preset) {
        const ljus::PresetRays rays = preset_rays(*r.preset);
        options = line.fill({width, height, rays.first});
        r.more_rays = rays.more;
        r.photon = preset_settings(*r.preset, options.width, options.height);
        // Keep the default shadow rays, not the preset's.
        r.photon.irradiance = {.least = r.photon.irradiance.least};
        if (fog && r.photon.indirect == ljus::IndirectLight::cache)
            r.photon.indirect = ljus::IndirectLight::photons;
        line.give_again();
    }
    if (r.passes.passes > 0) { // each pass has one ray per pixel
        options = line.fill({width, height, 1});
        r.more_rays = 0;
    }
    for (const auto& [option, given] : {std::pair{"--slice", r.part.count > 0},
                                        {"--region", !r.region.empty()},
                                        {"--layers", !r.layers.empty()}})
        if (given && r.more_rays > 0)
            throw std::invalid_argument(
                "--more-rays is " + std::to_string(r.more_rays) + "; with " + option +
                ", which takes the same rays in every "
                "pixel, it must be 0: give --more-rays 0");
    const auto sampling = r.picture.sampling;
    r.picture = picture_settings(options);
    r.picture.sampling = sampling;
    r.photon.general.numbers = r.photon.caustics.numbers;
    r.photon.general.max_bounces = r.photon.caustics.max_bounces;
    for (ljus::PhotonPassSettings* pass : {&r.photon.caustics, &r.photon.general}) {
        pass->max_memory = 1e9 * r.photon_memory;
        pass->seed = options.seed;
        pass->threads = options.threads;
    }
    r.path.max_depth = r.photon.max_depth;
    r.path.roulette_depth = r.photon.roulette_depth;
    r.path.sample_lights = r.path_lights.has_value();
    r.path.heuristic = r.path_lights.value_or(ljus::MisHeuristic::balance);
    r.passes.exposure = r.exposure;
    r.quiet = options.quiet;
}

/// The final settings of a picture, for the file beside it.
/// \param line  The command line, parsed.
/// \param r     What the user asked for, and what was chosen.
[[nodiscard]] inline nlohmann::ordered_json to_json(const CommandLine& line,
                                                    const RenderRequest& r) {
    std::vector<std::string> groups = common_groups;
    if (r.renderer == RendererName::path)
        groups.push_back(path_group);
    else if (r.renderer == RendererName::photon)
        groups.insert(groups.end(), photon_groups.begin(), photon_groups.end());
    if (r.passes.passes > 0) groups.push_back(pass_group);
    nlohmann::ordered_json json{
        {"scene", std::filesystem::path(r.scene).filename().string()}};
    if (!r.region.empty()) json["region"] = r.region;
    if (!r.layers.empty()) json["layers"] = r.layers;
    for (const std::string& group : groups)
        for (const auto& [name, value] : line.values(group))
            json[name] = nlohmann::ordered_json::parse(value);
    if (!r.photon.caustics.shares.empty())
        json["caustic-shares"] = r.photon.caustics.shares;
    if (!r.photon.caustics.light_shares.empty())
        json["caustic-light-shares"] = r.photon.caustics.light_shares;
    if (!r.kept.empty()) json["promise"] = r.kept;
    if (!r.remarks.empty()) json["remarks"] = r.remarks;
    return json;
}

/// What the passes of a picture are of; passes that were made by the same text go on.
/// \param line  The command line, parsed.
/// \param r     What the user asked for, with all settings, and the scene's hash.
[[nodiscard]] inline std::string text_of_passes(const CommandLine& line,
                                                const RenderRequest& r) {
    std::vector<std::pair<std::string, std::string>> settings;
    const auto json = to_json(line, r);
    for (const auto& [name, value] : json.items())
        if (name != "scene" && name != "exposure" && name != "passes" &&
            name != "resume" && name != "every")
            settings.emplace_back(name, value.dump());
    return picture_text(settings, r.scene_hash);
}

} // namespace examples
