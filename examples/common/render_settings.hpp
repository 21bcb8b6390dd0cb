#pragma once

/// \file examples/common/render_settings.hpp
/// \brief Every setting of the program `render`, in one table: its option, its allowed
/// values, its line of --help and its name in the JSON file beside the picture.

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
#include "layer_options.hpp"
#include "ljus/image/image.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/render/first_hit.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping_settings.hpp"
#include "picture_slice.hpp"
#include "progressive_picture.hpp"
#include "promise.hpp"
#include "rendered.hpp"

namespace examples {

// The groups of settings in --help.
inline const std::vector<std::string> common_groups{"Picture", "Renderer"};
inline const std::vector<std::string> photon_groups{
    "Photon mapping", "Photons", "Estimates from photons", "Gathering and cache",
    "Rays that photons make unnecessary"};
inline const std::string path_group = "Path tracing";
inline const std::string pass_group = "Passes: photon maps that converge";

/// The values of --renderer. The last three show the first hit of each ray.
enum class RendererName { photon, path, normals, albedo, depth };

/// The quantity of the first hit that a renderer shows; nothing if it computes light.
[[nodiscard]] constexpr std::optional<ljus::FirstHit>
first_hit_of(RendererName renderer) noexcept {
    if (renderer == RendererName::normals) return ljus::FirstHit::normals;
    if (renderer == RendererName::albedo) return ljus::FirstHit::albedo;
    if (renderer == RendererName::depth) return ljus::FirstHit::depth;
    return std::nullopt;
}

/// All settings, as given by the user or chosen by the program.
struct RenderRequest {
    std::string scene{};              ///< The scene file.
    std::vector<std::string> reads{}; ///< The scene file and all files that it names.
    std::uint64_t scene_hash = 0;     ///< Hash of the bytes of these files.
    std::string file{};               ///< The file for the picture or slice.
    RendererName renderer = RendererName::photon; ///< What a pixel shows.
    bool in_double = false;                       ///< Whether to compute in double.
    std::optional<ljus::Preset> preset{}; ///< A preset; other options override it.
    ljus::RenderSettings picture{};       ///< Settings of the whole picture.
    /// Further rays of pixels that differ from their neighbours.
    ljus::AdaptiveSettings adaptive{
        .more = 0, .batches = 1, .disagreement = ljus::PresetRays{}.disagreement};
    double exposure = 0; ///< Exposure of PNG files, in stops.
    ljus::PhotonMappingSettings photon{.caustics_estimate = {.radius = 0.1f}};
    ljus::PathTracingSettings path{};
    /// MIS weights of shadow rays and paths in a path tracer; none: no shadow rays.
    std::optional<ljus::MisHeuristic> path_lights = ljus::MisHeuristic::balance;
    double photon_memory = 4;      ///< Memory limit of each photon pass, in GB.
    PassOptions passes{};          ///< Passes of progressive photon mapping.
    Promise promise{};             ///< The promised time or error.
    nlohmann::ordered_json kept{}; ///< How the promise was kept.
    std::string remarks{};         ///< All remarks, one per line.
    std::string slice{};           ///< Text such as "3/16", or empty.
    SliceNumber part{};            ///< Number of the slice.
    std::string region{};          ///< Text such as "40,30,64,48", or empty.
    ljus::PixelRegion pixels{};    ///< The pixels to render.
    std::string layers{};          ///< Text such as "normal,albedo", or empty.
    ljus::LayerSettings which{};   ///< The layers to save.
    std::string pixel{};           ///< Text such as "120,80", or empty.
    std::vector<ljus::PhotonKind> photons{}; ///< Kinds of photons to draw as dots.
    bool plan = false;  ///< Whether to print the passes that would run.
    bool hooks = false; ///< Whether to print the hooks of the types.
    bool quiet = false; ///< Whether to print remarks only.
};

/// Adds every setting to the command line, with its name, the member that holds it, a
/// line of help, and its range. The words for an enum are the names of its enumerators.
/// \param line  The command line.
/// \param r     Receives the values; must live as long as the command line.
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
             "Render the K-th of N slices; ljus-merge joins the slices");

    line.group(common_groups[0], {"--width", "--height", "--rays", "--seed"});
    line.add("--region X,Y,W,H", r.region,
             "Only these pixels, counted from the upper left corner");
    line.add(
        "--layers LIST", r.layers,
        "With normal, albedo, depth, position, object, light-paths, or NAME=CLASS\n"
        "of light paths, as glass=ES+.*L: in NAME.exr, or in files NAME.*.pfm");
    line.add("--more-rays", r.adaptive.more,
             "Most further rays of a pixel, where the rays around it differ", 0,
             million);
    line.add("--disagreement", r.adaptive.disagreement,
             "Relative standard deviation at which a pixel gets all of them", 1e-6,
             1e6);
    line.add("--sampling", r.picture.sampling, "Pattern of the rays in a pixel");
    line.add("--precision", r.in_double, "Precision of scene, photons and light",
             {{"float", false}, {"double", true}});
    line.add("--exposure", r.exposure, "Exposure of PNG files, in stops", -100, 100);

    line.group(common_groups[1]);
    line.add("--renderer", r.renderer,
             "Photon mapping; path tracing as its reference; or the first hit of\n"
             "each ray: its normal n as (n + 1)/2, its albedo, its distance");
    line.add("--preset", r.preset,
             "Settings for a first look; for no visible errors in the least\n"
             "time; or for little bias, which needs many rays against noise.\n"
             "Other options replace settings of the preset");
    line.add("--depth", photon.max_depth,
             "Largest number of surfaces on a path, mirrors included", 1, 1000);
    line.add("--roulette", photon.roulette_depth,
             "First surface at which roulette may end a path", 1, million);

    line.group("Promise: all other settings are chosen");
    line.add("--seconds", r.promise.seconds,
             "Seconds to spend, for the picture with the least error", 0.01, 1e9);
    line.add("--error", r.promise.error, "relMSE to reach, in the least time", 1e-9,
             1e9);

    line.group(photon_groups[0]);
    line.add("--direct", photon.direct,
             "Light straight from lamps: by shadow rays; in closed form if there\n"
             "is one; or by multiple importance sampling");
    line.add("--shadow-rays", photon.shadow_rays, "Shadow rays to each light", 1,
             10'000);
    line.add("--indirect", photon.indirect,
             "Light from other surfaces: by rays; by the general map at the end\n"
             "of one ray (map) or at the surface itself (photons); by irradiance\n"
             "at the end of one ray (gather) or cached at few points (cache)");
    line.add("--split-glass", photon.split_glass,
             "Follow both reflection and refraction at glass");

    line.group(photon_groups[1]);
    line.add("--caustic-photons", photon.caustics.photons,
             "Photons aimed at mirrors and glass", 0, billion);
    line.add("--general-photons", photon.general.photons,
             "Photons of the general map, if one is needed", 0, billion);
    line.add("--caustic-budget", photon.caustic_budget,
             "How mirrors, glass and lights share caustic photons: as lights see\n"
             "the objects; equally; or for the least error of the flux, of each\n"
             "caustic, or of the picture");
    line.add("--photon-numbers", photon.caustics.numbers, "Random, or spread evenly");
    line.add("--photon-bounces", photon.caustics.max_bounces,
             "Largest number of surfaces on a photon's path", 1, million);
    line.add("--photon-memory", r.photon_memory,
             "Memory that a photon pass may take, in GB", 1e-6, 1e6);

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
             "Number of photons around a photon in fog that set its radius", 1, 511);

    line.group(photon_groups[3]);
    line.add("--irradiance-every", photon.irradiance.every,
             "One point with precomputed irradiance for so many photons", 2, million);
    line.add("--irradiance-nearest", photon.irradiance.nearest,
             "Photons in the estimate at such a point", 2, max_nearest);
    line.add("--irradiance-radius", photon.irradiance.radius,
             "Radius of that estimate; 0: from the photons", 0, 1e6);
    line.add("--irradiance-shadow-rays", photon.irradiance.shadow_rays,
             "Shadow rays from such a point to each light", 1, 10'000);
    line.add("--gather-rays", photon.gather.rays, "Rays from each point of the cache",
             1, million);
    line.add("--gather-tile", photon.gather.tile,
             "Side of a square of pixels that share a point of the cache", 1, 1000);
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
             "With --skip enough: hidden fraction of a light that is ignored", 1e-6,
             0.999);
    line.add("--skip-risk", photon.skip.risk,
             "With --skip enough: risk that more is hidden", 1e-9, 0.999);

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
    line.add("--plan", r.plan, "Print which passes would run, and why");
    line.add("--hooks", r.hooks,
             "Print which hooks the types of the scene have, and which they lack");
    line.add("--explain X,Y", r.pixel, "Print the paths of a pixel");
    using enum PhotonKind;
    line.add("--show-photons", r.photons, "Draw photons as dots",
             {{"direct", {direct}},
              {"indirect", {indirect}},
              {"shadow", {shadow}},
              {"caustic", {caustic}},
              {"all", {direct, indirect, shadow, caustic}}});
}

/// Chooses the settings that the user did not give, by the scene, by the preset, and
/// for pictures in passes.
/// \param line    The command line, parsed.
/// \param r       The request of the user.
/// \param width   Width in the scene file, in pixels.
/// \param height  Height in the scene file, in pixels.
/// \param fog     Whether the scene has fog, which the irradiance cache does not
///                support.
/// \throws std::invalid_argument  if the picture is too large, or options do not fit
///         together.
inline void choose_settings(CommandLine& line, RenderRequest& r, int width, int height,
                            bool fog = false) {
    if (fog && promised(r.promise))
        throw std::invalid_argument(
            "--seconds and --error choose among settings that cache irradiance, which "
            "fog does not allow: give a --preset and --rays");
    Options options = line.fill({width, height, ljus::RenderSettings{}.samples});
    ljus::require_image_size(options.width, options.height);
    if (r.preset) {
        const ljus::PresetRays rays = preset_rays(*r.preset);
        options = line.fill({width, height, rays.first});
        r.adaptive.more = rays.more;
        r.photon = preset_settings(*r.preset, options.width, options.height);
        if (fog && r.photon.indirect == ljus::IndirectLight::cache)
            r.photon.indirect = ljus::IndirectLight::photons;
        line.give_again();
    }
    if (r.passes.passes > 0) { // each pass has one ray per pixel
        options = line.fill({width, height, 1});
        r.adaptive.more = 0;
    }
    for (const auto& [option, given] : {std::pair{"--slice", r.part.count > 0},
                                        {"--region", !r.region.empty()},
                                        {"--layers", !r.layers.empty()}})
        if (given && r.adaptive.more > 0)
            throw std::invalid_argument("--more-rays is " +
                                        std::to_string(r.adaptive.more) + "; with " +
                                        option +
                                        ", which takes the same rays in every "
                                        "pixel, it must be 0: give --more-rays 0");
    const auto sampling = r.picture.sampling;
    r.picture = picture_settings(options);
    r.picture.sampling = sampling;
    r.adaptive.first = r.picture.samples;
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
/// \param r     The request of the user, with all settings chosen.
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

/// The text that identifies the picture of some passes. A checkpoint with the same text
/// can be resumed.
/// \param line  The command line, parsed.
/// \param r     The request of the user, with all settings and the hash of the scene.
[[nodiscard]] inline std::string text_of_passes(const CommandLine& line,
                                                const RenderRequest& r) {
    std::vector<std::pair<std::string, std::string>> settings;
    const auto json = to_json(line, r);
    for (const auto& [name, value] : json.items())
        if (name != "scene" && name != "exposure" && name != "passes" &&
            name != "resume" && name != "every" && name != "remarks")
            settings.emplace_back(name, value.dump());
    return picture_text(settings, r.scene_hash);
}

} // namespace examples
