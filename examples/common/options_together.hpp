#pragma once

/// \file options_together.hpp
/// \brief A table of the options of `render` that cannot be combined.

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ljus/render/passes.hpp"
#include "render_settings.hpp"

namespace examples {

/// Options that have no effect, or are refused, under a condition.
struct NoEffect {
    const char* why; ///< The condition in words: "without --more-rays".
    bool there;      ///< Whether the condition holds.
    std::vector<std::string> options; ///< Names of options, or headings of groups.
    bool all_but = false;             ///< Whether all options but these are meant.
};

/// Whether a PNG file is written. --exposure has an effect in PNG files only.
[[nodiscard]] inline bool exposed(const RenderRequest& r) {
    return r.part.count > 0 || !r.passes.preview.empty() ||
           std::filesystem::path(r.file).extension() == ".png";
}

/// Combinations that are refused, because one option makes the other impossible.
/// \param r  The request of the user.
[[nodiscard]] inline std::vector<NoEffect> options_apart(const RenderRequest& r) {
    const bool explains = !r.pixel.empty(), dots = !r.photons.empty();
    const bool fixed = r.promise.error > 0;
    return {
        {"cannot be combined with --seconds, which chooses the settings",
         r.promise.seconds > 0,
         {"--seconds", "--width", "--height", "--seed", "--precision", "--exposure",
          "--threads", "--out", "--quiet"},
         true},
        {"cannot be combined with --error, which chooses the settings",
         fixed,
         {"--error", "--width", "--height", "--seed", "--precision", "--exposure",
          "--threads", "--out", "--quiet"},
         true},
        {"cannot be combined with --slice",
         !r.slice.empty(),
         {"--explain", "--show-photons", "--passes", "--region"}},
        {"cannot be combined with --region",
         !r.region.empty(),
         {"--explain", "--show-photons", "--passes"}},
        {"cannot be combined with --layers",
         !r.layers.empty(),
         {"--slice", "--region", "--explain", "--show-photons", "--passes"}},
        {"is for pictures that are made in passes: give --passes N, too",
         r.passes.passes == 0,
         {"--alpha", "--checkpoint", "--resume", "--preview", "--every"}},
        {"cannot be combined with --passes",
         r.passes.passes > 0,
         {"--more-rays", "--explain", "--show-photons"}},
        {"is for --renderer photon; give other renderers more --rays",
         r.renderer != RendererName::photon,
         {"--passes"}},
        {"cannot be combined with --explain",
         explains,
         {"--show-photons", "--plan", "--hooks"}},
        {"cannot be combined with --show-photons", dots, {"--plan", "--hooks"}},
    };
}

/// Combinations that are only reported. The picture is right, but would be the same
/// without these options.
/// \param line The command line, parsed.
/// \param r    The request of the user, with all settings.
/// \param run  The passes that a photon mapper runs.
[[nodiscard]] inline std::vector<NoEffect>
options_idle(const CommandLine& line, const RenderRequest& r, const ljus::Passes& run) {
    const bool dots = !r.photons.empty();
    const bool photons = r.renderer == RendererName::photon;
    const bool paths = r.renderer == RendererName::path;
    const bool maps = photons && !dots;
    const bool general =
        run.general_map || run.volume_map || run.skipped_rays || run.skipped_bounces;
    const auto photon_group = [](std::size_t i) { return photon_groups.at(i); };
    using enum ljus::PhotonKind;
    const auto caustics = std::count(r.photons.begin(), r.photons.end(), caustic);
    return {
        {"on what --hooks prints",
         r.hooks && !r.plan,
         {"--hooks", "--quiet", "--precision"},
         true},
        {"on what --plan prints",
         r.plan,
         {"--plan",           "--hooks",           "--quiet",
          "--width",          "--height",          "--rays",
          "--preset",         "--renderer",        "--passes",
          "--alpha",          "--depth",           "--direct",
          "--indirect",       "--caustic-photons", "--caustic-budget",
          "--caustic-radius", "--general-photons", "--general-radius",
          "--skip",           "--skip-bounces",    "--skip-tolerance",
          "--skip-risk"},
         true},
        {"where no file is written", !r.pixel.empty(), {"--out", "--exposure"}},
        {"with --explain", !r.pixel.empty(), {"--more-rays", "--disagreement"}},
        {"with --show-photons",
         dots,
         {"--rays", "--more-rays", "--disagreement", "--sampling", "--renderer",
          "--depth", "--roulette", "--caustic-budget", photon_group(0), photon_group(2),
          photon_group(3), photon_group(4), path_group}},
        {"where no photon of the caustics map is drawn",
         dots && caustics == 0,
         {"--caustic-photons"}},
        {"where no photon of the general map is drawn",
         r.photons == std::vector{caustic},
         {"--general-photons"}},
        {"unless --renderer is photon",
         !photons,
         {photon_group(0), photon_group(1), photon_group(2), photon_group(3),
          photon_group(4)}},
        {"with --renderer path and --rays",
         paths && line.given("--rays") && r.adaptive.more == 0,
         {"--preset"}},
        {"without --renderer path", !paths, {path_group}},
        {"without --more-rays", r.adaptive.more == 0, {"--disagreement"}},
        {"in a file that holds radiance", !exposed(r), {"--exposure"}},
        {"without --checkpoint or --preview",
         r.passes.checkpoint.empty() && r.passes.preview.empty(),
         {"--every"}},
        {"because no caustics map is made: see --plan",
         maps && !run.caustics_map,
         {"--caustic-budget", "--caustic-radius", "--caustic-nearest",
          "--caustic-kernel"}},
        {"because nothing needs a caustics map: see --plan",
         maps && !run.caustics_map && r.photon.caustics.photons > 0,
         {"--caustic-photons"}},
        {"because nothing asks for a general map: see --plan",
         maps && !general && r.photon.general.photons > 0,
         {"--general-photons"}},
        {"because no estimate asks for it: see --plan",
         maps && (!run.general_map || run.irradiance),
         {"--general-radius", "--general-nearest", "--general-kernel"}},
        {"because no volume map is made: see --plan",
         maps && !run.volume_map,
         {"--fog-radius", "--fog-nearest"}},
        {"because --fog-radius is the radius",
         maps && run.volume_map && r.photon.fog_estimate.radius > 0,
         {"--fog-nearest"}},
        {"because no photon map is made: see --plan",
         maps && !run.caustics_map && !general,
         {"--photon-numbers", "--photon-bounces", "--photon-memory"}},
        {"because no irradiance is precomputed: see --plan",
         maps && !run.irradiance,
         {"--irradiance-every", "--irradiance-nearest", "--irradiance-radius",
          "--irradiance-shadow-rays"}},
        {"without an irradiance cache: see --plan",
         maps && !run.cache,
         {"--gather-rays", "--gather-tile", "--gather-nearest", "--gather-reach",
          "--gather-depth"}},
        {"because no ray is skipped: see --plan",
         maps && !run.skipped_rays,
         {"--skip-tolerance", "--skip-risk"}},
        {"because no ray is skipped: see --plan",
         maps && !run.skipped_rays && !run.skipped_bounces,
         {"--skip-radius"}},
        {"because they are skipped by another rule",
         maps && run.skipped_rays && r.photon.skip.rule != ljus::SkipRule::enough,
         {"--skip-tolerance", "--skip-risk"}},
        {"because no indirect ray can be skipped: see --plan",
         maps && !run.skipped_bounces,
         {"--skip-bounces"}},
    };
}

/// The options that the user gave and to which a row applies.
[[nodiscard]] inline std::vector<std::string> idle_options(const CommandLine& line,
                                                           const NoEffect& row) {
    std::vector<std::string> found;
    if (!row.there) return found;
    for (const std::string& option : line.all_given()) {
        const bool listed = std::find(row.options.begin(), row.options.end(), option) !=
                                row.options.end() ||
                            std::find(row.options.begin(), row.options.end(),
                                      line.group_of(option)) != row.options.end();
        if (listed != row.all_but) found.push_back(option);
    }
    return found;
}

/// Refuses options that cannot be combined. Sets the number of the slice in `r`.
/// \param line  The command line, parsed.
/// \param r     The request of the user.
/// \param file  The name of the file, if --out names one.
/// \throws std::invalid_argument  if options cannot be combined, or --slice is not
///         valid.
inline void check_options(const CommandLine& line, RenderRequest& r,
                          const std::string& file) {
    for (const NoEffect& row : options_apart(r))
        for (const std::string& option : idle_options(line, row))
            throw std::invalid_argument(option + " " + row.why);
    const bool slice_file = std::filesystem::path(file).extension() == ".slice";
    if (!r.slice.empty()) {
        r.part = slice_of(r.slice);
        if (!file.empty() && !slice_file)
            throw std::invalid_argument("--out is " + file +
                                        "; a slice is not a picture: it "
                                        "must be NAME.slice, or a folder for it");
    } else if (slice_file) {
        throw std::invalid_argument("--out is " + file +
                                    "; a file NAME.slice is for --slice K/N");
    }
}

/// Why every pixel of a picture may be black, as the end of a sentence.
/// \param r      The request of the user, with all settings.
/// \param found  What the scene needs.
[[nodiscard]] inline std::string why_black(const RenderRequest& r,
                                           const ljus::SceneNeeds& found) {
    const bool photons = r.renderer == RendererName::photon;
    std::string why = "no light reaches what the camera sees; ";
    if (photons && found.specular > 0 && r.photon.caustics.photons == 0)
        why += "--caustic-photons 0 leaves out the light from mirrors and glass, ";
    if (r.photon.max_depth == 1)
        why += "--depth 1 leaves out the light between surfaces, ";
    else if (photons && r.photon.indirect == ljus::IndirectLight::none)
        why += "--indirect none leaves out the light between surfaces, ";
    return why + "the camera may be in a body, or the lamps may face away";
}

/// Finds the pixels of --slice or --region, and the layers of --layers, once the size
/// of the picture is known.
/// \param r  Receives `pixels` and `which`. A slice may have no rows.
/// \throws std::invalid_argument  if the region is not within the picture, or a layer
///         is unknown.
inline void choose_pixels(RenderRequest& r) {
    const auto [width, height] = std::pair{r.picture.width, r.picture.height};
    r.pixels = {0, 0, width, height};
    if (!r.layers.empty()) r.which = layer_settings(r.layers);
    if (r.part.count > 0) r.pixels = rows_of(r.part, width, height);
    if (r.region.empty()) return;
    const std::size_t second = r.region.find(',', r.region.find(',') + 1);
    const auto first = two_numbers(r.region.substr(0, second), ',');
    const auto size = second != std::string::npos
                          ? two_numbers(r.region.substr(second + 1), ',')
                          : std::nullopt;
    const auto inside = [](int from, int count, int all) {
        return from >= 0 && count >= 1 && from < all && count <= all - from;
    };
    if (!first || !size || !inside(first->first, size->first, width) ||
        !inside(first->second, size->second, height))
        throw std::invalid_argument(
            "--region is " + r.region +
            "; it must be X,Y,W,H: the first column and row, counted from 0, and the "
            "width and height, within the picture of " +
            std::to_string(width) + " x " + std::to_string(height) + " pixels");
    r.pixels = {first->first, first->second, size->first, size->second};
}

/// The pixel that --explain selects.
/// \throws std::invalid_argument  if the pixel is not within the picture.
[[nodiscard]] inline std::pair<int, int> pixel_of(const RenderRequest& r) {
    const auto pixel = two_numbers(r.pixel, ',');
    if (!pixel || pixel->first < 0 || pixel->first >= r.picture.width ||
        pixel->second < 0 || pixel->second >= r.picture.height)
        throw std::invalid_argument("--explain is " + r.pixel +
                                    "; it must be X,Y, counted from the upper left "
                                    "corner, from 0,0 to " +
                                    std::to_string(r.picture.width - 1) + "," +
                                    std::to_string(r.picture.height - 1));
    return *pixel;
}

/// Prints on stderr which options have no effect.
/// \param line  The command line, parsed.
/// \param r     The request of the user, with all settings.
/// \param run   The passes that a photon mapper runs.
inline void tell_idle_options(const CommandLine& line, const RenderRequest& r,
                              const ljus::Passes& run) {
    std::vector<std::string> told;
    for (const NoEffect& row : options_idle(line, r, run)) {
        std::vector<std::string> options = idle_options(line, row);
        std::erase_if(options, [&told](const std::string& option) {
            return std::find(told.begin(), told.end(), option) != told.end();
        });
        if (options.empty()) continue;
        told.insert(told.end(), options.begin(), options.end());
        std::string list = options.front();
        for (std::size_t i = 1; i < options.size(); ++i)
            list += (i + 1 < options.size() ? ", " : " and ") + options[i];
        std::fprintf(stderr, "%s %s no effect %s.\n", list.c_str(),
                     options.size() == 1 ? "has" : "have", row.why);
    }
}

} // namespace examples
