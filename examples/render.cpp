/// \file render.cpp
/// \brief Renders a scene file by photon mapping, or by path tracing as a reference.
///
///     render scene.json --preset fast --out picture.png
///     render scene.json --renderer path --rays 1000 --out picture.pfm
///     render scene.json --seconds 5            the best picture for that time
///     render scene.json --plan                 what would run, and why
///     render scene.json --passes 100 --checkpoint a.check --preview a.png
///                                              progressive maps; --resume continues
///     render scene.json --slice 3/16 --out part    some of its rows; see ljus-merge
///
/// Each setting is listed once, in common/render_settings.hpp; --help and the JSON file
/// beside the picture follow from that list.

#include <algorithm>
#include <array>
#include <cinttypes>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "common/command_line.hpp"
#include "common/options_together.hpp"
#include "common/picture_cost.hpp"
#include "common/program_files.hpp"
#include "common/promised_picture.hpp"
#include "common/render_settings.hpp"
#include "common/save_picture.hpp"
#include "common/terminal.hpp"
#include "ljus/inspect/census.hpp"
#include "ljus/inspect/explain.hpp"
#include "ljus/inspect/metrics.hpp"
#include "ljus/inspect/photon_dots.hpp"
#include "ljus/inspect/survey.hpp"
#include "ljus/io/load_json.hpp"
#include "ljus/io/load_mesh.hpp"
#include "ljus/io/scene_schema.hpp"
#include "ljus/render/adaptive.hpp"
#include "ljus/render/lamp_shares.hpp"

namespace {

using namespace ljus;
using Request = examples::RenderRequest;
using examples::RendererName;

/// A sentence of the library with the names of options in place of its own.
std::string in_options(std::string sentence) {
    constexpr std::pair<std::string_view, std::string_view> names[]{
        {"max_memory", "--photon-memory"},
        {"caustics_estimate.radius", "--caustic-radius"},
        {"general_estimate.radius", "--general-radius"}};
    for (const auto& [name, option] : names)
        for (std::size_t at = 0; (at = sentence.find(name, at)) != sentence.npos;)
            sentence.replace(at, name.size(), option);
    return sentence;
}

/// Prints remarks, a line each, and keeps them for the file beside the picture.
void tell(const std::string& remarks, Request& r) {
    const std::string told = in_options(remarks);
    std::fputs(told.c_str(), stderr);
    r.remarks += told;
}
void tell(const std::vector<std::string>& remarks, Request& r) {
    for (const std::string& remark : remarks) tell(remark + "\n", r);
}

/// Renders the picture, or explains one pixel.
/// \return The picture; without an image if a pixel was explained.
template <typename Renderer, std::floating_point T>
RenderedLayersT<T> run(const Renderer& renderer, const LensCameraT<T>& camera,
                       const Request& r) {
    RenderSettings picture = r.picture;
    if (!r.pixel.empty()) {
        const auto [x, y] = pixel_of(r);
        std::fputs(explain(renderer, camera, picture, x, y).c_str(), stdout);
        return {};
    }
    const examples::StopWatch watch;
    examples::ProgressBar bar("render", r.quiet);
    picture.progress = bar;
    RenderedLayersT<T> result;
    if (r.adaptive.more > 0) {
        picture.samples += r.adaptive.more; // at most
        auto adaptive = render_adaptive(renderer, camera, picture, r.adaptive);
        result.rendered = {std::move(adaptive.image), adaptive.counts};
    } else if (!r.layers.empty()) {
        result = render_layers(renderer, camera, picture, r.which);
    } else if (r.pixels.height > 0) { // of more slices than rows some have none
        result.rendered = render_region(renderer, camera, picture, r.pixels);
    }
    examples::stop_if_asked();
    if (!r.quiet && r.pixels.height > 0)
        examples::print_cost(result.rendered.counts, watch.seconds());
    return result;
}

/// Makes the photon maps, the irradiance cache if there is one, and then the picture.
template <AnyWorld W, std::floating_point T>
RenderedLayersT<T> map_photons(const W& world, const LensCameraT<T>& camera,
                               Request& r) {
    const examples::StopWatch watch;
    examples::ProgressBar caustics("caustics photons", r.quiet);
    examples::ProgressBar general("general photons", r.quiet);
    if (r.photon.share_lights)
        r.photon =
            share_by_sight(world, camera, r.photon, r.picture.width, r.picture.height);
    r.photon.caustics.progress = caustics;
    r.photon.general.progress = general;
    PhotonMapper mapper(world, r.photon, examples::recipe_abilities);
    examples::stop_if_asked();
    tell(mapper_remarks(mapper), r);
    if (mapper.passes().cache) {
        examples::ProgressBar points("irradiance cache", r.quiet);
        RenderSettings picture = r.picture;
        picture.progress = points;
        mapper.fill_cache(camera, picture);
        examples::stop_if_asked();
    }
    r.photon = mapper.settings(); // with the chosen radii and fractions
    if (!r.quiet) examples::print_maps(mapper, watch.seconds());
    return run(mapper, camera, r);
}

/// Renders a picture in passes, each with its own photons; see \ref progressive.
template <AnyWorld W, std::floating_point T>
RenderedT<T> render_passes(const W& world, const LensCameraT<T>& camera, Request& r) {
    const auto& abilities = examples::recipe_abilities;
    auto go_on = [](long long, long long) { return examples::stop_signal() == 0; };
    RenderSettings picture = r.picture;
    picture.progress = r.photon.caustics.progress = r.photon.general.progress = go_on;
    const examples::StopWatch watch;
    {
        const PhotonMapper first(world, r.photon, abilities);
        examples::stop_if_asked();
        tell(mapper_remarks(first), r);
        r.photon = settings_for_passes(first);
    }
    RenderedT<T> rendered;
    const auto pass = [&](long long i, double scale) {
        auto one =
            photon_mapping_pass(world, camera, r.photon, picture, i, scale, abilities);
        rendered.counts += one.counts;
        return one;
    };
    const auto state = examples::run_passes(r.passes, r.quiet, pass);
    rendered.image = mean_image<T>(state);
    if (r.quiet) return rendered;
    examples::print_cost(rendered.counts, watch.seconds());
    if (survey(world, r.photon).caustics_map.on) examples::print_caustics(r.photon);
    std::printf("  %-16s %10s  ", "passes", "");
    examples::print_passes(state);
    return rendered;
}

/// Renders a picture within a time or with an error, by settings that it chooses.
template <AnyWorld W, std::floating_point T>
RenderedT<T> render_promised(const W& world, const LensCameraT<T>& camera, Request& r) {
    const examples::StopWatch watch;
    const auto say = [&r](const auto& kept) {
        if (!r.quiet) std::printf("  %s\n", kept.why.c_str());
        std::fflush(stdout);
    };
    const auto now = [&watch] { return watch.seconds(); };
    auto kept = keep(world, camera, r.picture, r.promise, now, r.quiet, say);
    tell(kept.remarks, r);
    r.photon = kept.recipe.settings;
    r.picture.samples = kept.recipe.rays;
    r.preset = static_cast<Preset>(kept.choice.recipe); // one per preset
    const auto& [pixels, blocks] = kept.stated;
    r.kept = {{"why", kept.why},
              {r.promise.seconds > 0 ? "seconds" : "error",
               std::max(r.promise.seconds, r.promise.error)},
              {"pictures", kept.pictures},
              {"took", kept.seconds},
              {"relMSE", kept.error()},
              {"interval", {pixels.low, pixels.high}},
              {"interval_of_blocks", {blocks.low, blocks.high}},
              {"noise", kept.noise},
              {"bias", kept.forecast().bias}};
    if (!r.quiet) {
        examples::print_cost(kept.rendered.counts, kept.seconds);
        std::printf("  %-16s %10s  relMSE %s, noise %s and bias %s; %lld pictures\n",
                    "error", "", stated_text(kept).c_str(),
                    examples::noise_text(kept.noise).c_str(),
                    bias_text(kept.forecast()).c_str(), kept.pictures);
    }
    return std::move(kept.rendered);
}

/// Draws the scene, with the photons of some kinds as dots.
template <AnyWorld W, std::floating_point T>
RenderedT<T> draw_photons(const W& world, const CameraT<T>& camera, const Request& r) {
    RenderedT<T> drawn{scene_drawing(world, camera, r.picture.width, r.picture.height)};
    for (const MapType type : {MapType::general, MapType::caustics}) {
        const bool caustics = type == MapType::caustics;
        auto kinds = r.photons;
        std::erase_if(kinds,
                      [=](auto k) { return caustics != (k == PhotonKind::caustic); });
        if (kinds.empty()) continue;
        examples::ProgressBar bar("photons", r.quiet);
        PhotonPassSettings pass = caustics ? r.photon.caustics : r.photon.general;
        pass.progress = bar;
        const auto traced = trace_photons(world, type, pass);
        examples::stop_if_asked();
        for (const PhotonKind kind : kinds) {
            const auto color = [kind](const PhotonT<T>& photon) {
                return photon.kind == kind ? dot_color(photon) : RgbT<T>{0};
            };
            const long long seen =
                add_photon_dots(drawn.image, world, camera, traced.photons, {}, color);
            if (!r.quiet)
                std::printf("  %-16s %10" PRIu64 " stored, %lld seen\n", name_of(kind),
                            census(traced.photons)[kind].photons, seen);
        }
    }
    return drawn;
}

/// The path of the picture or the slice.
std::string path_of(const Request& r, const examples::Options& options) {
    std::string name = std::filesystem::path(r.scene).stem().string();
    name += r.part.count == 0 ? ".png"
                              : "-" + std::to_string(r.part.number) + "-of-" +
                                    std::to_string(r.part.count) + ".slice";
    return options.path(options.file.empty() ? name : options.file);
}

/// Makes sure that all files can be written, and that no file replaces another one.
void check_files(const Request& r) {
    examples::check_pass_files(r.passes);
    const bool alone = r.part.count > 0 || !r.photons.empty();
    std::vector<examples::OutputFile> files{
        {"--out", r.file},
        {"the file of settings beside --out", alone ? "" : r.file + ".json"},
        {"--preview", r.passes.preview},
        {"--checkpoint", r.passes.checkpoint}};
    if (!examples::is_exr(r.file))
        for (const Layer& layer : make_layers<float>(r.which, 1, 1))
            files.push_back(
                {"the layer beside --out", examples::layer_file(r.file, layer)});
    examples::require_outputs(files, r.reads);
}

/// Saves a picture, and beside it a JSON file with its settings; or saves a slice,
/// which holds both.
template <std::floating_point T>
void save_result(const Request& r, nlohmann::ordered_json json,
                 const RenderedLayersT<T>& result, double seconds) {
    const RenderedT<T>& rendered = result.rendered;
    if (r.part.count > 0) {
        json["scene_hash"] = examples::hex_text(r.scene_hash);
        json["version"] = {LJUS_VERSION_MAJOR, LJUS_VERSION_MINOR, LJUS_VERSION_PATCH};
        return examples::save_slice(r.file, {.slice = r.part,
                                             .width = r.picture.width,
                                             .height = r.picture.height,
                                             .wide = std::is_same_v<T, double>,
                                             .exposure = r.exposure,
                                             .settings = json.dump(),
                                             .counts = rendered.counts,
                                             .seconds = seconds,
                                             .pixels = {rendered.image.pixels.begin(),
                                                        rendered.image.pixels.end()}});
    }
    examples::save_with_layers(rendered.image, result.layers, r.file, r.exposure);
    if (!r.photons.empty()) return;
    json["cost"] = examples::cost_json(rendered.counts, seconds);
    const std::string text = json.dump(2) + "\n";
    save_file(r.file + ".json", Bytes(text.begin(), text.end()));
}

/// A remark on a picture so dim that relMSE gives its noise little weight.
/// \return Empty unless the squared mean radiance is far below the epsilon of relMSE.
template <std::floating_point T>
std::string dim_remark(const ImageT<T>& image) {
    double mean = 0;
    for (const RgbT<T>& color : image.pixels)
        mean += double(luminance(color)) / double(image.pixels.size());
    if (!(mean > 0) || mean * mean > default_epsilon / 10) return {};
    std::array<char, 256> text{};
    std::snprintf(text.data(), text.size(),
                  "the mean radiance of the picture is %.3g, but --error, --seconds "
                  "and --more-rays give little weight to noise in pixels below %.3g: "
                  "multiply the light of all lamps by %.3g\n",
                  mean, std::sqrt(default_epsilon), 1 / mean);
    return text.data();
}

/// Prints a line about the work that begins.
template <AnyWorld W>
void print_heading(const W& world, std::string name, const Request& r) {
    if (name.empty()) name = std::filesystem::path(r.scene).stem().string();
    constexpr const char* names[]{"photon mapping", "path tracing", "normals", "albedo",
                                  "depth"};
    std::string how = names[int(r.renderer)];
    if (!r.photons.empty())
        how = "photons as dots";
    else if (!promised(r.promise))
        how = std::to_string(r.picture.samples) + " rays per pixel, " + how;
    if (r.passes.passes > 0)
        how += " in " + std::to_string(r.passes.passes) + " passes, alpha " +
               examples::two_digits(r.passes.alpha);
    std::printf("%s: %zu objects, %zu lights; %d x %d, %s\n", name.c_str(),
                world.size(), world.light_count(), r.picture.width, r.picture.height,
                how.c_str());
}

/// Prints the passes that would run, or the hooks of the types of the scene.
template <AnyWorld W>
void print_plan(const W& world, Request& r) {
    if (r.plan && r.renderer == RendererName::photon) {
        const Plan plan = survey(world, r.photon);
        for (const PlanItem* item : plan.items())
            if (item != &plan.volume_map || world.has_fog())
                std::fputs(to_text(*item).c_str(), stdout);
        tell(plan.remarks, r);
    }
    if (r.hooks)
        for (const std::string& line : survey_hooks(world)) std::puts(line.c_str());
}

/// Makes the picture that the user asks for.
template <AnyWorld W, std::floating_point T>
RenderedLayersT<T> make_picture(const W& world, const LensCameraT<T>& camera,
                                Request& r) {
    if (!r.photons.empty()) return {draw_photons(world, camera.pinhole, r)};
    if (promised(r.promise)) return {render_promised(world, camera, r)};
    if (r.passes.passes > 0) return {render_passes(world, camera, r)};
    if (const auto first = examples::first_hit_of(r.renderer))
        return run(FirstHitRenderer(world, *first), camera, r);
    if (r.renderer == RendererName::path)
        return run(PathTracer(world, r.path), camera, r);
    return map_photons(world, camera, r);
}

/// Does the work that the user asks for, in one precision.
template <std::floating_point T>
void run_request(examples::CommandLine& line, Request& r,
                 const examples::Options& options) {
    check_options(line, r, options.file);
    const FilesRead read;
    std::string troubles; // of meshes
    auto loaded = load_json<T>(r.scene, examples::with_exr(MeshFilesT<T>{&troubles}));
    r.reads = examples::paths_of(read);
    r.scene_hash = read.hash();
    const World world(std::move(loaded.scene));
    const LensCameraT<T>& camera = loaded.camera;
    choose_settings(line, r, loaded.width, loaded.height, world.has_fog());
    r.file = path_of(r, options);
    if (!r.quiet || r.plan) print_heading(world, loaded.name, r);
    const bool prints = r.plan || r.hooks;
    // Refuse wrong pixels, layers and files before any work is done.
    choose_pixels(r);
    if (!r.pixel.empty())
        (void)pixel_of(r);
    else if (!prints)
        check_files(r);
    tell_idle_options(line, r, choose_passes(needs(world), r.photon));
    tell(troubles, r);
    tell(camera_remarks(world, camera.pinhole.position), r);
    if (r.renderer == RendererName::path && r.photons.empty() && (r.plan || !r.hooks))
        tell(path_remarks(world), r);
    if (prints) return print_plan(world, r);
    r.passes.picture = text_of_passes(line, r);

    examples::when_stopped_say(
        r.part.count > 0 ? "the slice is not saved; the same command makes it again"
                         : "no picture is saved; a picture that can be stopped and "
                           "continued is made by --passes N --checkpoint FILE");
    const examples::StopWatch watch;
    const RenderedLayersT<T> result = make_picture(world, camera, r);
    if (!r.pixel.empty()) return;
    const double seconds = watch.seconds();
    const auto& colors = result.rendered.image.pixels;
    const bool whole = r.part.count == 0 && r.region.empty();
    if (whole && world.size() > 0 && !examples::first_hit_of(r.renderer) &&
        std::all_of(colors.begin(), colors.end(), is_black<T>))
        tell("every pixel is black: " + why_black(r, needs(world)) + "\n", r);
    line.fill({r.picture.width, r.picture.height, r.picture.samples});
    if (whole && !examples::first_hit_of(r.renderer) && r.photons.empty() &&
        (promised(r.promise) || r.adaptive.more > 0))
        tell(dim_remark(result.rendered.image), r);
    save_result(r, to_json(line, r), result, seconds);
    examples::when_stopped_say("'" + r.file + "' is saved");
    if (r.quiet) return;
    std::printf("  %-16s %8.2f s\n  %s\n", "all passes", seconds, r.file.c_str());
}

void body(examples::CommandLine& line) {
    Request request;
    line.about(
        "Renders a scene file into one picture: --out NAME.png, NAME.hdr, "
        "NAME.pfm or NAME.exr, or a folder for SCENE.png (of a slice: NAME.slice).");
    line.without({"--quality"});
    add_settings(line, request);
    line.prints("--schema", "Print the JSON schema of scene files, for editors",
                scene_schema);
    const examples::Options options =
        line.parse({.report = {.width = 0, .height = 0, .samples = 64}});
    request.quiet = options.quiet;
    try {
        if (request.in_double)
            run_request<double>(line, request, options);
        else
            run_request<float>(line, request, options);
    } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(in_options(error.what()));
    }
}

} // namespace

/// Renders a scene file.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, body);
}
