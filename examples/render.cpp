/// \file render.cpp
/// \brief Renders a scene file: by photon mapping, or by path tracing as its judge.
///
///     render scene.json --out picture.png
///     render scene.json --out picture.pfm --renderer path --rays 1000
///     render scene.json --preset fast          settings that go together
///     render scene.json --seconds 5            the best picture for that time
///     render scene.json --error 0.01           the first picture with that relMSE
///     render scene.json --plan                 what would run, and why
///     render scene.json --explain 120,80       why a pixel has its colour
///     render scene.json --photons shadow       the photons of a kind, as dots
///     render scene.json --precision double     the whole scene in double
///     render scene.json --skip enough          shadow rays that photons make needless
///     render scene.json --passes 100 --checkpoint a.check --preview a.png
///                                              maps that converge; --resume goes on
///     render scene.json --slice 3/16 --out part    a part of it; see ljus-merge

#include <array>
#include <charconv>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <sstream>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/photon_options.hpp"
#include "common/picture_slice.hpp"
#include "common/progressive_picture.hpp"
#include "common/promised_picture.hpp"
#include "common/save_picture.hpp"
#include "common/terminal.hpp"
#include "ljus/inspect/census.hpp"
#include "ljus/inspect/explain.hpp"
#include "ljus/inspect/photon_dots.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/io/load_json.hpp"
#include "ljus/math/stratified_stream.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/render/budgeting.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/skipping.hpp"
#include "ljus/scenes/room.hpp"
#ifdef LJUS_HAS_TINYOBJLOADER
#include "ljus/io/load_obj.hpp"
#endif

namespace {

using namespace ljus;

/// Any renderer, but Ctrl-C ends it between two rays: a block of pixels with a million
/// rays each would take minutes.
template <typename Renderer>
struct Stoppable {
    using Stream = typename Renderer::Stream;
    const Renderer& renderer;
};

/// The same for a photon mapper, whose batches ask its maps.
template <AnyWorld W, typename... X>
struct Stoppable<PhotonMapper<W, X...>> {
    using Stream = typename PhotonMapper<W, X...>::Stream;
    using Batch = typename PhotonMapper<W, X...>::Batch;
    const PhotonMapper<W, X...>& renderer;

    const auto& maps() const { return renderer.maps(); }
    const auto& settings() const { return renderer.settings(); }
};

template <typename Renderer, std::floating_point T, typename Context>
RgbT<T> radiance(const Stoppable<Renderer>& stoppable, const RayT<T>& ray,
                 Context& context) {
    examples::stop_if_asked();
    return radiance(stoppable.renderer, ray, context);
}

/// What the options of this program may ask of a photon mapper.
constexpr auto all_abilities =
    abilities<StratifiedStream, Gathering, Skipping, Budgeting>;

/// What the user asked for, besides what all programs share.
struct Request {
    std::string scene;
    std::string renderer = "photon";
    std::string indirect = "rays";
    std::string direct = "sampled";
    std::string preset;
    std::string caustic_kernel = "epanechnikov";
    std::string general_kernel = "epanechnikov";
    std::string sampling = "multi-jittered";
    std::string precision = "float";
    std::string pixel;
    std::string photons;
    int depth = 1000;
    int roulette = 4;
    int shadow_rays = 1;
    int caustic_nearest = 0;
    int general_nearest = 0;
    int irradiance_every = 6;
    int irradiance_nearest = 32;
    int gather_rays = 25;
    int gather_tile = 3;
    int gather_nearest = 6;
    int more_rays = 0;
    long long caustic_photons = 100'000;
    long long general_photons = 100'000;
    double radius = 0.1;
    double general_radius = 0.3;
    double gather_reach = 1;
    double disagreement = PresetRays{}.disagreement;
    double exposure = 0.0;
    bool split_glass = false;
    bool plan = false;
    examples::PhotonOptions photon_options;
    examples::PassOptions passes;
    examples::Promise promise;
    nlohmann::ordered_json kept; ///< How the promise was kept.
    std::string slice;
    examples::SliceNumber part;
    std::string path_lights = "balance";
    double roulette_threshold = 1;
    double roulette_max = 1;
};

// The names of what is chosen by a word, in the order of its enum.
const std::vector<std::string> kernels{"box", "cone", "gaussian", "epanechnikov",
                                       "biweight"};
const std::vector<std::string> indirect_lights{"rays",   "map",   "photons",
                                               "gather", "cache", "none"};
const std::vector<std::string> direct_lights{"sampled", "analytic", "mis"};
const std::vector<std::string> presets{"draft", "fast", "exact"};
const std::vector<std::string> patterns{"random", "jittered", "multi-jittered",
                                        "sobol"};
const std::vector<std::string> path_lights{"balance", "power", "rays", "paths"};
using examples::chosen;

/// Refuses what lies between the numbers that an option takes: one photon, whose own
/// distance would be the radius, and a disc so small that no float holds its radiance.
void check_estimates(const Request& request) {
    const auto ask = [](const char* option, auto value, bool good, const char* right) {
        std::ostringstream sentence;
        sentence << option << " is " << value << "; it must be " << right;
        if (!good) throw std::invalid_argument(sentence.str());
    };
    const auto ask_nearest = [&](const char* option, int nearest) {
        ask(option, nearest, nearest != 1,
            "0 for all in the radius, or 2 to 512: one photon sets the radius");
    };
    const auto ask_radius = [&](const char* option, double radius) {
        ask(option, radius, radius == 0 || radius >= 1e-15,
            "0 to take it from the photons, or 1e-15 to 1e6");
    };
    ask_nearest("--caustic-nearest", request.caustic_nearest);
    ask_nearest("--general-nearest", request.general_nearest);
    ask_radius("--radius", request.radius);
    ask_radius("--general-radius", request.general_radius);
}

/// The settings of a request: those of its preset, and what was given by name.
PhotonMappingSettings settings_of(const Request& request,
                                  const examples::CommandLine& line,
                                  const examples::Options& options,
                                  const RenderSettings& picture) {
    check_estimates(request);
    PhotonMappingSettings settings;
    if (!request.preset.empty())
        settings = preset_settings(chosen<Preset>(presets, request.preset),
                                   picture.width, picture.height);
    const auto set = [&](const char* option, auto& setting, const auto& value) {
        if (request.preset.empty() || line.given(option))
            setting = static_cast<std::remove_cvref_t<decltype(setting)>>(value);
    };
    set("--depth", settings.max_depth, request.depth);
    set("--roulette", settings.roulette_depth, request.roulette);
    set("--shadow-rays", settings.shadow_rays, request.shadow_rays);
    set("--direct", settings.direct,
        chosen<DirectLight>(direct_lights, request.direct));
    set("--split-glass", settings.split_glass, request.split_glass);
    set("--indirect", settings.indirect,
        chosen<IndirectLight>(indirect_lights, request.indirect));
    set("--caustic-photons", settings.caustics.photons, request.caustic_photons);
    set("--general-photons", settings.general.photons, request.general_photons);
    set("--radius", settings.caustics_estimate.radius, request.radius);
    set("--general-radius", settings.general_estimate.radius, request.general_radius);
    set("--caustic-nearest", settings.caustics_estimate.nearest,
        request.caustic_nearest);
    set("--general-nearest", settings.general_estimate.nearest,
        request.general_nearest);
    set("--caustic-kernel", settings.caustics_estimate.kernel,
        chosen<Kernel>(kernels, request.caustic_kernel));
    set("--general-kernel", settings.general_estimate.kernel,
        chosen<Kernel>(kernels, request.general_kernel));
    set("--irradiance-every", settings.irradiance.every, request.irradiance_every);
    set("--irradiance-nearest", settings.irradiance.nearest,
        request.irradiance_nearest);
    set("--gather-rays", settings.gather.rays, request.gather_rays);
    set("--gather-tile", settings.gather.tile, request.gather_tile);
    set("--gather-nearest", settings.gather.nearest, request.gather_nearest);
    set("--gather-reach", settings.gather.reach, request.gather_reach);
    for (PhotonPassSettings* pass : {&settings.caustics, &settings.general}) {
        set("--photon-numbers", pass->numbers,
            chosen<PhotonSampling>(examples::photon_numbers,
                                   request.photon_options.numbers));
        pass->seed = options.seed;
        pass->threads = options.threads;
    }
    set_photon_options(settings, request.photon_options);
    return settings;
}

/// How the path tracer works.
PathTracingSettings path_settings(const Request& request) {
    PathTracingSettings settings{.max_depth = request.depth,
                                 .roulette_depth = request.roulette,
                                 .sample_lights = request.path_lights != "paths",
                                 .roulette_threshold = request.roulette_threshold,
                                 .roulette_max = request.roulette_max};
    if (settings.sample_lights)
        settings.heuristic = chosen<MisHeuristic>(path_lights, request.path_lights);
    return settings;
}

/// Refuses what does not go with passes; each has one ray per pixel unless told.
void set_passes(Request& request, const examples::CommandLine& line,
                RenderSettings& picture) {
    for (const char* option : {"--alpha", "--checkpoint", "--resume", "--preview"})
        if (request.passes.passes == 0 && line.given(option))
            throw std::invalid_argument(std::string(option).append(
                " is for pictures that are made in passes: give --passes N."));
    if (request.passes.passes == 0) return;
    if (request.renderer == "path")
        throw std::invalid_argument(
            "--passes is for --renderer photon; a path tracer takes --rays.");
    for (const char* option : {"--more-rays", "--explain", "--photons"})
        if (line.given(option))
            throw std::invalid_argument(
                std::string(option).append(" does not go with --passes."));
    if (!line.given("--rays")) picture.samples = 1;
    request.more_rays = 0;
    request.passes.exposure = request.exposure;
}

/// Whether settings are to be chosen; refuses those that are given as well.
bool promises(const Request& request, const examples::CommandLine& line) {
    if (request.promise.seconds == 0 && request.promise.error == 0) return false;
    const std::string promise = request.promise.seconds > 0 ? "--seconds" : "--error";
    for (const std::string& option : line.all_given()) {
        constexpr std::array allowed{"--seconds", "--width",   "--height",    "--seed",
                                     "--threads", "--out",     "--precision", "--quiet",
                                     "--error",   "--exposure"};
        if (std::find(allowed.begin(), allowed.end(), option) == allowed.end())
            throw std::invalid_argument(
                std::string(option).append(" does not go with ") + promise +
                ", which chooses the settings.");
    }
    if (request.promise.seconds > 0 && request.promise.error > 0)
        throw std::invalid_argument("--seconds and --error: only one can be promised.");
    return true;
}

/// Takes the number of a slice, and refuses what needs all of the picture.
void set_slice(Request& request, const examples::CommandLine& line,
               const std::string& file) {
    const bool slice_file = std::filesystem::path(file).extension() == ".slice";
    if (request.slice.empty()) {
        if (slice_file)
            throw std::invalid_argument("a file NAME.slice is for --slice K/N");
        return;
    }
    request.part = examples::slice_of(request.slice);
    if (!file.empty() && !slice_file)
        throw std::invalid_argument(
            "a slice is no picture: --out must be NAME.slice, or a folder for it; "
            "ljus-merge makes the picture");
    for (const char* option : {"--explain", "--photons", "--passes"})
        if (line.given(option))
            throw std::invalid_argument(
                std::string(option).append(" does not go with --slice."));
    if (request.more_rays > 0)
        throw std::invalid_argument(
            "--slice takes the same rays in every pixel: give --more-rays 0.");
}

/// What the passes will be, as a line of the plan.
std::string passes_line(const Request& request, const PhotonMappingSettings& settings) {
    const long long passes = request.passes.passes;
    if (passes == 0) return to_text(PlanItem{"passes", false, "one map for all rays"});
    char why[160];
    std::snprintf(why, sizeof why,
                  "%lld, each with %lld caustic photons of its own and a smaller "
                  "radius, alpha %.3g",
                  passes, settings.caustics.photons, request.passes.alpha);
    return to_text(PlanItem{"passes", true, why});
}

/// Rays in a pixel of a preset, before those where they disagree.
void set_samples(Request& request, const examples::CommandLine& line,
                 RenderSettings& picture) {
    if (request.preset.empty()) return;
    const PresetRays rays = preset_rays(chosen<Preset>(presets, request.preset));
    if (!line.given("--rays")) picture.samples = rays.first;
    if (!line.given("--more-rays") && picture.samples > 1)
        request.more_rays = rays.more;
}

/// The numbers of "120,80".
std::pair<int, int> pixel_of(const std::string& text, const RenderSettings& picture) {
    int x = 0;
    int y = 0;
    const char* const end = text.data() + text.size();
    const auto first = std::from_chars(text.data(), end, x);
    const bool comma = first.ec == std::errc{} && first.ptr != end && *first.ptr == ',';
    const auto second = comma ? std::from_chars(first.ptr + 1, end, y)
                              : std::from_chars_result{end, {}};
    if (!comma || second.ec != std::errc{} || second.ptr != end || x < 0 || y < 0 ||
        x >= picture.width || y >= picture.height)
        throw std::invalid_argument(
            std::string("--explain is ").append(text) +
            "; it must be X,Y, from the upper left corner, within [0, " +
            std::to_string(picture.width - 1) + "],[0, " +
            std::to_string(picture.height - 1) + "]");
    return {x, y};
}

void print(const Counts& counts, double seconds) {
    const auto samples = static_cast<double>(counts.camera_rays);
    const auto rays = static_cast<double>(counts.rays());
    std::printf("  %-16s %8.2f s  %" PRIu64 " rays, %.2f per sample, %.2f million/s\n",
                "render", seconds, counts.rays(), rays / samples,
                rays / seconds * 1e-6);
    std::printf("  %-16s %10s  %" PRIu64 " from the camera, %" PRIu64
                " bounces, %" PRIu64 " to lights\n",
                "", "", counts.camera_rays, counts.bounce_rays, counts.shadow_rays);
    if (counts.map_queries > 0)
        std::printf("  %-16s %10s  %.2f map queries per sample, %.1f photons each\n",
                    "", "", static_cast<double>(counts.map_queries) / samples,
                    static_cast<double>(counts.map_photons) /
                        static_cast<double>(counts.map_queries));
    if (counts.skipped_rays + counts.skipped_bounces > 0)
        std::printf("  %-16s %10s  skipped: %.1f %% of the rays to lights, %" PRIu64
                    " bounces\n",
                    "", "",
                    100 * static_cast<double>(counts.skipped_rays) /
                        static_cast<double>(std::max<std::uint64_t>(
                            counts.skipped_rays + counts.shadow_rays, 1)),
                    counts.skipped_bounces);
    if (counts.rejected > 0)
        std::printf("  %-16s %10s  %" PRIu64
                    " samples were not finite and are left out\n",
                    "", "", counts.rejected);
    if (counts.cut_paths > 0)
        std::printf("  %-16s %10s  %" PRIu64
                    " paths were cut at --depth; their further light is missing\n",
                    "", "", counts.cut_paths);
}

/// Renders, or explains one pixel.
/// \return What was rendered; no image if a pixel was explained.
template <typename Renderer, std::floating_point T>
RenderedT<T> run(const Renderer& renderer, const CameraT<T>& camera,
                 RenderSettings picture, const Request& request, bool quiet) {
    const Stoppable<Renderer> stoppable{renderer};
    if (!request.pixel.empty()) {
        const auto [x, y] = pixel_of(request.pixel, picture);
        std::fputs(explain(stoppable, camera, picture, x, y).c_str(), stdout);
        return {};
    }
    const examples::StopWatch watch;
    examples::ProgressBar bar("render", quiet);
    picture.progress = bar;
    RenderedT<T> rendered;
    if (request.more_rays > 0) {
        picture.samples += request.more_rays; // at most
        auto adaptive = render_adaptive(stoppable, camera, picture,
                                        {.first = picture.samples - request.more_rays,
                                         .more = request.more_rays,
                                         .batches = 1,
                                         .disagreement = request.disagreement});
        rendered = {std::move(adaptive.image), adaptive.counts, adaptive.complete};
    } else if (request.part.count > 0) {
        const RowRange rows = examples::rows_of(request.part, picture.height);
        if (rows.first == rows.last) return rendered; // more slices than rows
        rendered = render_rows(stoppable, camera, picture, rows);
    } else {
        rendered = render(stoppable, camera, picture);
    }
    examples::stop_if_asked();
    if (!quiet) print(rendered.counts, watch.seconds());
    return rendered;
}

/// What a map keeps, for the terminal.
template <std::floating_point T>
void print_map(const char* name, const PhotonMapT<T>& map, long long emitted) {
    std::printf("  %-16s %10s  %lld photons emitted; kept:", name, "", emitted);
    const PhotonCensus kept = census(map);
    for (const PhotonKind kind : {PhotonKind::direct, PhotonKind::caustic,
                                  PhotonKind::indirect, PhotonKind::shadow})
        if (kept[kind].photons > 0)
            std::printf(" %" PRIu64 " %s", kept[kind].photons, name_of(kind));
    std::printf("\n");
}

/// All that is made before the picture: photon maps, and what is gathered from them.
/// \return The photon mapper that has them.
template <typename S>
auto first_passes(const Room<S>& room, RenderSettings picture,
                  PhotonMappingSettings settings, bool quiet) {
    const examples::StopWatch watch;
    examples::ProgressBar caustics("caustics photons", quiet);
    examples::ProgressBar general("general photons", quiet);
    settings.caustics.progress = caustics;
    settings.general.progress = general;
    PhotonMapper mapper(room.world, settings, all_abilities);
    examples::stop_if_asked();
    const auto& maps = mapper.maps();
    const Passes& passes = mapper.passes();
    if (!maps.remarks.empty()) std::fputs(maps.remarks.c_str(), stderr);
    if (!quiet && (passes.caustics_map || passes.general_map)) {
        std::printf("  %-16s %8.2f s\n", "photons", watch.seconds());
        if (passes.caustics_map)
            print_map("caustics map", maps.caustics, settings.caustics.photons);
        if (passes.general_map)
            print_map("general map", maps.general, settings.general.photons);
    }
    if (!passes.cache) return mapper;

    const examples::StopWatch cache_watch;
    examples::ProgressBar gathering("irradiance cache", quiet);
    picture.progress = gathering;
    mapper.fill_cache(room.camera, picture);
    examples::stop_if_asked();
    const auto& cache = mapper.template state<Gathering>().cache;
    if (!quiet)
        std::printf("  %-16s %8.2f s  %zu points, %" PRIu64 " gather rays\n",
                    "irradiance cache", cache_watch.seconds(), cache.records.size(),
                    cache.counts.bounce_rays);
    return mapper;
}

/// What was chosen for the caustics, for the terminal.
void print_caustics(const PhotonMappingSettings& settings) {
    std::printf("  %-16s %10s  radius %.3g", "caustics", "",
                double(settings.caustics_estimate.radius));
    const std::vector<double>& shares = settings.caustics.shares;
    for (std::size_t i = 0; i < shares.size() && i < 12; ++i)
        std::printf("%s%.3g", i == 0 ? "; shares of the photons: " : ", ", shares[i]);
    std::printf("%s\n", shares.size() > 12 ? ", ..." : "");
}

/// A picture in passes, each with photons of its own; see \ref progressive.
template <typename S>
RenderedT<typename S::Scalar>
render_passes(const Room<S>& room, RenderSettings picture, const Request& request,
              PhotonMappingSettings& settings, bool quiet) {
    using T = typename S::Scalar;
    auto stopped = [](long long, long long) { return examples::stop_signal() == 0; };
    picture.progress = settings.caustics.progress = settings.general.progress = stopped;
    const examples::StopWatch watch;
    settings = settings_for_passes(room.world, settings, all_abilities);
    examples::stop_if_asked();
    RenderedT<T> rendered;
    const auto pass = [&](long long i, double scale) {
        auto one = photon_mapping_pass(room.world, room.camera, settings, picture, i,
                                       scale, all_abilities);
        rendered.counts += one.counts;
        return one;
    };
    const auto state = examples::run_passes(request.passes, quiet, pass);
    rendered.image = mean_image<T>(state);
    if (quiet) return rendered;
    print(rendered.counts, watch.seconds());
    if (survey(room.world, settings).caustics_map.on) print_caustics(settings);
    std::printf("  %-16s %10s  ", "passes", "");
    examples::print_passes(state);
    return rendered;
}

/// A picture for some seconds, or with some error: settings and samples are chosen.
template <typename S>
RenderedT<typename S::Scalar>
render_promised(const Room<S>& room, RenderSettings& picture, Request& request,
                PhotonMappingSettings& settings, const examples::StopWatch& watch,
                bool quiet) {
    using T = typename S::Scalar;
    const auto& promise = request.promise;
    const auto tell = [&](const examples::Kept<T>& kept) {
        const auto all = examples::recipes(picture.width, picture.height);
        const std::string why = reason(kept.found, all, promise, kept.choice);
        if (!quiet) std::printf("  %s\n", why.c_str());
        std::fflush(stdout);
        request.kept["why"] = why;
    };
    auto kept = keep(
        room.world, room.camera, picture, promise, [&] { return watch.seconds(); },
        quiet, tell);
    settings = kept.recipe.settings;
    picture.samples = kept.recipe.rays;
    request.more_rays = 0;
    request.preset = kept.recipe.name;
    const examples::Forecast& found = kept.forecast();
    if (promise.seconds > 0) request.kept["seconds"] = promise.seconds;
    if (promise.error > 0) request.kept["error"] = promise.error;
    request.kept["pictures"] = kept.pictures;
    request.kept["took"] = kept.seconds;
    request.kept["estimate"] = {{"relMSE", kept.error()},
                                {"noise", kept.noise},
                                {"bias", found.bias},
                                {"error_of_bias", found.unsure}};
    if (quiet) return kept.rendered;
    print(kept.rendered.counts, kept.seconds);
    std::printf("  %-16s %10s  relMSE %.3g, by estimate: noise %.3g, bias %s; mean of "
                "%lld pictures\n",
                "error", "", kept.error(), kept.noise, bias_text(found).c_str(),
                kept.pictures);
    return kept.rendered;
}

template <typename S>
RenderedT<typename S::Scalar>
render_room(const Room<S>& room, const RenderSettings& picture, const Request& request,
            PhotonMappingSettings& settings, bool quiet) {
    if (request.renderer == "path") {
        // Its paths meet narrow lobes by themselves, as by DirectLight::mis.
        for (const auto& remark :
             scene_remarks(room.world, {.direct = DirectLight::mis}))
            std::fprintf(stderr, "%s\n", remark.c_str());
        const PathTracer tracer(room.world, path_settings(request));
        return run(tracer, room.camera, picture, request, quiet);
    }
    if (request.passes.passes > 0)
        return render_passes(room, picture, request, settings, quiet);
    const auto mapper = first_passes(room, picture, settings, quiet);
    settings = mapper.settings(); // with the radii and the shares that were chosen
    if (!quiet && !mapper.maps().caustics.empty()) print_caustics(settings);
    return run(mapper, room.camera, picture, request, quiet);
}

/// All settings of a picture, for the file beside it.
nlohmann::ordered_json to_json(const Request& request, const RenderSettings& picture,
                               const PhotonMappingSettings& settings) {
    const auto pass = [](const PhotonPassSettings& of,
                         const DensityEstimateSettings& how) {
        return nlohmann::ordered_json{
            {"photons", of.photons},
            {"radius", how.radius},
            {"nearest", how.nearest},
            {"kernel", kernels[static_cast<std::size_t>(how.kernel)]}};
    };
    nlohmann::ordered_json json{
        {"scene", std::filesystem::path(request.scene).filename().string()},
        {"renderer", request.renderer},
        {"precision", request.precision},
        {"width", picture.width},
        {"height", picture.height},
        {"rays", picture.samples},
        {"sampling", request.sampling},
        {"seed", picture.seed},
        {"depth", settings.max_depth},
        {"roulette", settings.roulette_depth}};
    if (!request.preset.empty()) json["preset"] = request.preset;
    if (!request.kept.empty()) json["promise"] = request.kept;
    if (request.renderer == "photon") {
        json["more_rays"] = request.more_rays;
        json["disagreement"] = request.disagreement;
        json["direct"] = direct_lights[static_cast<std::size_t>(settings.direct)];
        json["shadow_rays"] = settings.shadow_rays;
        json["split_glass"] = settings.split_glass;
        json["indirect"] = indirect_lights[static_cast<std::size_t>(settings.indirect)];
        json["caustics"] = pass(settings.caustics, settings.caustics_estimate);
        json["general"] = pass(settings.general, settings.general_estimate);
        json["irradiance"] = {{"every", settings.irradiance.every},
                              {"nearest", settings.irradiance.nearest}};
        json["gather"] = {{"rays", settings.gather.rays},
                          {"tile", settings.gather.tile},
                          {"nearest", settings.gather.nearest},
                          {"reach", settings.gather.reach}};
        examples::add_to_json(json, settings);
        if (request.passes.passes > 0)
            json["passes"] = {{"count", request.passes.passes},
                              {"alpha", request.passes.alpha}};
    } else {
        json["path_lights"] = request.path_lights;
        json["roulette_threshold"] = request.roulette_threshold;
        json["roulette_max"] = request.roulette_max;
    }
    return json;
}

constexpr PhotonKind kinds[] = {PhotonKind::direct, PhotonKind::indirect,
                                PhotonKind::shadow, PhotonKind::caustic};

/// A drawing of the scene, and on it the photons of one kind, or of all.
template <typename S>
ImageT<typename S::Scalar>
draw_photons(const Room<S>& room, const RenderSettings& picture, const Request& request,
             const PhotonMappingSettings& settings, const examples::Options& options) {
    using T = typename S::Scalar;
    const auto& [world, camera] = room;
    ImageT<T> image = scene_drawing(world, camera, picture.width, picture.height);
    for (const MapType law : {MapType::general, MapType::caustics}) {
        const bool caustics = law == MapType::caustics;
        if (request.photons != "all" && (request.photons == "caustic") != caustics)
            continue;
        examples::ProgressBar bar(caustics ? "caustics photons" : "general photons",
                                  options.quiet);
        PhotonPassSettings pass = caustics ? settings.caustics : settings.general;
        pass.progress = bar;
        const auto traced = trace_photons(world, law, pass);
        examples::stop_if_asked();
        const PhotonCensus found = census(traced.photons);
        for (const PhotonKind kind : kinds) {
            if (request.photons != "all" && request.photons != name_of(kind)) continue;
            if ((kind == PhotonKind::caustic) != caustics) continue;
            const auto color = [kind](const PhotonT<T>& photon) {
                return photon.kind == kind ? dot_color(photon) : RgbT<T>{0};
            };
            const long long seen =
                add_photon_dots(image, world, camera, traced.photons, {}, color);
            const RgbT<double>& flux = found[kind].flux;
            if (!options.quiet)
                std::printf("  %-16s %10" PRIu64
                            " stored, %lld seen; %.4g, %.4g, %.4g W of %.4g, %.4g, "
                            "%.4g W emitted\n",
                            name_of(kind), found[kind].photons, seen, flux.x, flux.y,
                            flux.z, traced.audit.emitted.x, traced.audit.emitted.y,
                            traced.audit.emitted.z);
        }
    }
    return image;
}

/// A slice and all that tells whose part it is, as a file.
template <std::floating_point T>
void save_part(const std::string& path, const Request& request,
               const RenderSettings& picture, nlohmann::ordered_json settings,
               const RenderedT<T>& rendered, double seconds) {
    settings["scene_hash"] = examples::scene_hash(request.scene);
    settings["exposure"] = request.exposure;
    settings["version"] = {LJUS_VERSION_MAJOR, LJUS_VERSION_MINOR, LJUS_VERSION_PATCH};
    examples::PictureSlice part{.slice = request.part,
                                .width = picture.width,
                                .height = picture.height,
                                .wide = std::is_same_v<T, double>,
                                .exposure = request.exposure,
                                .settings = settings.dump(),
                                .counts = rendered.counts,
                                .seconds = seconds};
    for (const RgbT<T>& color : rendered.image.pixels)
        part.pixels.push_back(RgbT<double>(color));
    examples::save_slice(path, part);
}

/// The scene of a request; what is wrong with its meshes goes to the terminal.
template <std::floating_point T>
LoadedSceneT<T> load_scene(const Request& request, bool quiet) {
#ifdef LJUS_HAS_TINYOBJLOADER
    std::string troubles;
    auto loaded = load_json<T>(request.scene, ObjMeshesT<T>{&troubles});
    if (!quiet) std::fputs(troubles.c_str(), stderr);
    return loaded;
#else
    (void)quiet;
    return load_json<T>(request.scene);
#endif
}

/// How the picture is rendered: as the scene says, unless the user says otherwise.
template <std::floating_point T>
RenderSettings picture_of(const LoadedSceneT<T>& loaded, const Request& request,
                          const examples::CommandLine& line,
                          const examples::Options& options) {
    const RenderSettings picture{
        .width = line.given("--width") ? options.width : loaded.width,
        .height = line.given("--height") ? options.height : loaded.height,
        .samples = options.samples,
        .seed = options.seed,
        .threads = options.threads,
        .sampling = chosen<Sampling>(patterns, request.sampling)};
    require_image_size(picture.width, picture.height);
    return picture;
}

/// Where the picture or the slice goes.
std::string path_of(const Request& request, const examples::Options& options) {
    if (!options.file.empty()) return options.path(options.file);
    const std::string stem = std::filesystem::path(request.scene).stem().string();
    if (request.part.count == 0) return options.path(stem + ".png");
    return options.path(stem + "-" + std::to_string(request.part.number) + "-of-" +
                        std::to_string(request.part.count) + ".slice");
}

/// Prints what is about to be rendered.
/// \param name  Of the scene; empty if it has none.
/// \param rays  How many, in words, or nothing.
template <AnyWorld W>
void print_heading(const W& world, std::string name, const Request& request,
                   const RenderSettings& picture, const std::string& rays) {
    if (name.empty()) name = std::filesystem::path(request.scene).stem().string();
    std::printf("%s: %zu objects, %zu lights; %d x %d, %s%s\n", name.c_str(),
                world.size(), world.light_count(), picture.width, picture.height,
                rays.c_str(),
                !request.photons.empty()     ? "not rendered: photons as dots"
                : request.renderer == "path" ? "path tracing"
                                             : "photon mapping");
}

/// Saves a picture with all that tells how it was made, or a slice of one.
template <std::floating_point T>
void save_result(const std::string& path, const Request& request,
                 const RenderSettings& picture, const PhotonMappingSettings& settings,
                 const RenderedT<T>& rendered, double seconds) {
    nlohmann::ordered_json json = to_json(request, picture, settings);
    if (request.part.count > 0)
        return save_part(path, request, picture, json, rendered, seconds);
    examples::save_picture(rendered.image, path, request.exposure);
    json["cost"] = examples::cost_json(rendered.counts, seconds);
    const std::string text = json.dump(2) + "\n";
    save_file(path + ".json", Bytes(text.begin(), text.end()));
}

/// Does what the user asked for, in one precision.
template <std::floating_point T>
void run_request(const examples::CommandLine& line, Request request,
                 const examples::Options& options) {
    auto loaded = load_scene<T>(request, options.quiet);
    RenderSettings picture = picture_of(loaded, request, line, options);
    const Room room{World(std::move(loaded.scene)), loaded.camera};
    const bool promised = promises(request, line);
    set_samples(request, line, picture);
    set_passes(request, line, picture);
    set_slice(request, line, options.file);
    PhotonMappingSettings settings = settings_of(request, line, options, picture);
    const std::string path = path_of(request, options);
    if (!request.pixel.empty())
        (void)pixel_of(request.pixel, picture);
    else if (!request.plan) {
        examples::require_writable(path);
        examples::require_pass_files(request.passes, path);
    }

    if (!options.quiet || request.plan)
        print_heading(room.world, loaded.name, request, picture,
                      promised ? ""
                               : std::to_string(picture.samples) + " rays per pixel, ");
    if (request.plan) {
        if (request.renderer == "photon")
            std::fputs(
                (to_text(survey(room.world, settings)) + passes_line(request, settings))
                    .c_str(),
                stdout);
        return;
    }

    if (!request.photons.empty()) {
        examples::save_picture(draw_photons(room, picture, request, settings, options),
                               path, request.exposure);
        if (!options.quiet) std::printf("  %s\n", path.c_str());
        return;
    }
    const examples::StopWatch watch;
    const RenderedT<T> rendered =
        promised
            ? render_promised(room, picture, request, settings, watch, options.quiet)
            : render_room(room, picture, request, settings, options.quiet);
    if (rendered.image.pixels.empty() && request.part.count == 0) return;
    const double seconds = watch.seconds();
    save_result(path, request, picture, settings, rendered, seconds);
    if (options.quiet) return;
    std::printf("  %-16s %8.2f s\n", "all passes", seconds);
    std::printf("  %s\n", path.c_str());
}

/// Options of the renderer, its photons, and all its settings at once.
void add_renderer_options(examples::CommandLine& line, Request& request) {
    line.add("--renderer", request.renderer, "photon or path", {"photon", "path"});
    line.add("--depth", request.depth, "Surfaces on a path, mirrors counted", 1, 1000);
    line.add("--roulette", request.roulette, "Surface from which roulette ends paths",
             1, 1'000'000);
    line.add("--shadow-rays", request.shadow_rays, "Shadow rays per light (photon)", 1,
             10'000);
    line.add("--caustic-photons", request.caustic_photons,
             "Photons aimed at mirrors and glass", 0, 1'000'000'000);
    line.add("--general-photons", request.general_photons,
             "Photons for --indirect map, photons, gather, cache", 0, 1'000'000'000);
    line.add("--preset", request.preset,
             "All settings at once; those given by name come before it", presets);
    line.add("--seconds", request.promise.seconds,
             "Choose all settings: the least error in that time", 0.01, 1e9);
    line.add("--error", request.promise.error,
             "Choose all settings: the least time to that relMSE", 1e-9, 1e9);
    line.add("--direct", request.direct,
             "sampled by shadow rays, analytic where lamps have a closed form, or mis",
             direct_lights);
}

/// Options of the estimates from photons.
void add_estimate_options(examples::CommandLine& line, Request& request) {
    line.add("--radius", request.radius,
             "Radius of a caustics estimate, in scene units; 0: from the photons", 0,
             1e6);
    line.add("--general-radius", request.general_radius,
             "Radius of a general estimate, in scene units; 0: from the photons", 0,
             1e6);
    line.add("--caustic-nearest", request.caustic_nearest,
             "Photons per caustics estimate; 0: all in the radius", 0,
             static_cast<int>(max_nearest));
    line.add("--general-nearest", request.general_nearest,
             "Photons per general estimate; 0: all in the radius", 0,
             static_cast<int>(max_nearest));
    line.add("--caustic-kernel", request.caustic_kernel,
             "Weight of a caustic photon by its distance", kernels);
    line.add("--general-kernel", request.general_kernel,
             "Weight of a general photon by its distance", kernels);
}

/// Options of indirect light: precomputed irradiance, and the cache.
void add_indirect_options(examples::CommandLine& line, Request& request) {
    line.add("--indirect", request.indirect,
             "rays, map at their ends, photons where the camera looks, gather or cache "
             "with precomputed irradiance, or none",
             indirect_lights);
    line.add("--irradiance-every", request.irradiance_every,
             "Photons per point at which irradiance is precomputed", 2, 1'000'000);
    line.add("--irradiance-nearest", request.irradiance_nearest,
             "Photons per estimate of that irradiance", 2,
             static_cast<int>(max_nearest));
    line.add("--gather-rays", request.gather_rays, "Rays per point of the cache", 1,
             1'000'000);
    line.add("--gather-tile", request.gather_tile,
             "Pixels on a side that share a point of the cache", 1, 1000);
    line.add("--gather-nearest", request.gather_nearest,
             "Points of the cache that a pixel takes", 2,
             static_cast<int>(max_cache_nearest));
    line.add("--gather-reach", request.gather_reach,
             "How far such a point counts, over the mean distance of what it sees",
             1e-3, 1e3);
}

/// Options of camera rays and of paths.
void add_ray_options(examples::CommandLine& line, Request& request) {
    line.add("--more-rays", request.more_rays,
             "Further rays per pixel where the first ones disagree", 0, 1'000'000);
    line.add("--disagreement", request.disagreement,
             "Relative standard error above which they disagree", 1e-6, 1e6);
    line.add("--split-glass", request.split_glass, "At glass, go both ways (photon)");
    line.add("--sampling", request.sampling, "Where in a pixel its rays go", patterns);
    line.add("--precision", request.precision,
             "Precision of the scene, the photons and the light", {"float", "double"});
    line.add(
        "--path-lights", request.path_lights,
        "Lamps of --renderer path: rays and paths weighted by balance or power, or "
        "rays or paths alone",
        path_lights);
    line.add("--roulette-threshold", request.roulette_threshold,
             "A path that carries less may be ended (path)", 0, 1e6);
    line.add("--roulette-max", request.roulette_max,
             "Largest probability to survive (path)", 1e-6, 1);
}

void body(examples::CommandLine& line) {
    Request request;
    line.about("Renders a scene file into one picture: --out NAME.png, NAME.hdr or "
               "NAME.pfm, or a folder for SCENE.png (of a slice: NAME.slice).");
    line.add_positional("SCENE.json", request.scene, "The scene file");
    line.file_types({".png", ".hdr", ".pfm", ".slice"});
    add_renderer_options(line, request);
    add_estimate_options(line, request);
    add_indirect_options(line, request);
    add_ray_options(line, request);
    examples::add_photon_options(line, request.photon_options);
    examples::add_pass_options(line, request.passes);
    line.add("--exposure", request.exposure, "Exposure of a PNG file, in stops", -100,
             100);
    line.add("--explain", request.pixel,
             "X,Y: print the paths of that pixel and make no picture");
    line.add("--photons", request.photons, "Draw photons as dots and render nothing",
             {"direct", "indirect", "shadow", "caustic", "all"});
    line.add("--slice", request.slice,
             "K/N: the K-th of N parts, for ljus-merge to put together");
    line.add("--plan", request.plan,
             "Print what would run and why, and make no picture");
    const examples::Options options = line.parse();
    if (request.precision == "double")
        run_request<double>(line, request, options);
    else
        run_request<float>(line, request, options);
}

} // namespace

/// Renders a scene file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
