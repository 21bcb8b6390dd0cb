/// \file render.cpp
/// \brief Renders a scene file by photon mapping, or by path tracing as a reference.
///
///     render scene.json --preset fast --out picture.png
///     render scene.json --renderer path --rays 1000 --out picture.pfm
///     render scene.json --renderer normals     what each ray hits first
///     render scene.json --seconds 5            the best picture for that time
///     render scene.json --region 40,30,64,48   some of its pixels
///     render scene.json --layers normal,albedo,light-paths --out picture.exr
///     render scene.json --plan                 what would run, and why
///     render --schema > ljus.schema.json       what a scene file may contain
///     render scene.json --passes 100 --checkpoint a.check --preview a.png
///                                              progressive maps; --resume continues
///     render scene.json --slice 3/16 --out part    some of its rows; see ljus-merge
///
/// Each setting is listed once, in common/render_settings.hpp; --help and the JSON file
/// beside the picture follow from that list.

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/layer_options.hpp"
#include "common/options_together.hpp"
#include "common/picture_cost.hpp"
#include "common/program_files.hpp"
#include "common/promised_picture.hpp"
#include "common/render_settings.hpp"
#include "common/save_picture.hpp"
#include "common/terminal.hpp"
#include "ljus/inspect/census.hpp"
#include "ljus/inspect/explain.hpp"
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

/// The closed scene of a scene file, with its camera.
template <typename S>
struct FileRoom {
    World<S> world;                           ///< Shapes, materials and lights.
    LensCameraT<typename S::Scalar> camera{}; ///< Its camera.
};
template <typename S>
FileRoom(World<S>, LensCameraT<typename S::Scalar>) -> FileRoom<S>;

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
    RenderedT<T>& rendered = result.rendered;
    if (r.more_rays > 0) {
        picture.samples += r.more_rays; // the largest mean number
        auto adaptive = render_adaptive(renderer, camera, picture,
                                        {.first = r.picture.samples,
                                         .more = r.more_rays,
                                         .batches = 1,
                                         .disagreement = r.disagreement});
        rendered = {std::move(adaptive.image), adaptive.counts, adaptive.complete};
    } else if (!r.layers.empty()) {
        result = render_layers(renderer, camera, picture,
                               examples::layer_settings(r.layers));
    } else if (!r.region.empty()) {
        rendered = render_region(renderer, camera, picture, examples::region_of(r));
    } else if (r.part.count > 0) {
        const RowRange rows = examples::rows_of(r.part, picture.height);
        if (rows.first == rows.last) return result; // if slices outnumber rows
        rendered = render_rows(renderer, camera, picture, rows);
    } else {
        rendered = render(renderer, camera, picture);
    }
    examples::stop_if_asked();
    if (!r.quiet) examples::print_cost(rendered.counts, watch.seconds());
    return result;
}

/// A remark of the library, in which names of settings are replaced by options.
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

/// Prints the remarks about a photon mapper, and keeps them for the JSON file of the
/// picture.
void tell_maps(const std::string& remarks, Request& r) {
    r.remarks = in_options(remarks);
    std::fputs(r.remarks.c_str(), stderr);
}

/// Prints remarks on the terminal, one per line.
void tell(const std::vector<std::string>& remarks) {
    for (const std::string& remark : remarks)
        std::fprintf(stderr, "%s\n", remark.c_str());
}

/// Fills the irradiance cache of a photon mapper.
template <typename Mapper, std::floating_point T>
void fill_cache(Mapper& mapper, const LensCameraT<T>& camera, const Request& r) {
    const examples::StopWatch watch;
    examples::ProgressBar bar("irradiance cache", r.quiet);
    RenderSettings picture = r.picture;
    picture.progress = bar;
    mapper.fill_cache(camera, picture);
    examples::stop_if_asked();
    const auto& cache = mapper.template state<Gathering>().cache;
    if (!r.quiet)
        std::printf("  %-16s %8.2f s  %zu points, %" PRIu64 " gather rays\n",
                    "irradiance cache", watch.seconds(), cache.records.size(),
                    cache.counts.bounce_rays);
}

/// Makes the photon maps, the irradiance cache if there is one, and then the picture.
template <typename S>
RenderedLayersT<typename S::Scalar> map_photons(const FileRoom<S>& room, Request& r) {
    const examples::StopWatch watch;
    examples::ProgressBar caustics("caustics photons", r.quiet);
    examples::ProgressBar general("general photons", r.quiet);
    PhotonMappingSettings settings = r.photon;
    if (settings.share_lights)
        settings = share_by_sight(room.world, room.camera, settings, r.picture.width,
                                  r.picture.height);
    settings.caustics.progress = caustics;
    settings.general.progress = general;
    PhotonMapper mapper(room.world, settings, examples::recipe_abilities);
    examples::stop_if_asked();
    const Passes& passes = mapper.passes();
    const auto& maps = mapper.maps();
    tell_maps(mapper_remarks(mapper), r);
    if (!r.quiet && (passes.caustics_map || passes.general_map || passes.volume_map)) {
        std::printf("  %-16s %8.2f s\n", "photons", watch.seconds());
        if (passes.caustics_map)
            examples::print_map("caustics map", maps.caustics,
                                settings.caustics.photons);
        if (passes.general_map)
            examples::print_map("general map", maps.general, settings.general.photons);
        if (passes.volume_map)
            std::printf("  %-16s %10s  %zu photons stored\n", "volume map", "",
                        maps.fog_caustics.photons.size() + maps.fog.photons.size());
    }
    if (passes.cache) fill_cache(mapper, room.camera, r);
    r.photon = mapper.settings(); // including the chosen radii and fractions
    if (!r.quiet && !maps.caustics.empty()) examples::print_caustics(r.photon);
    return run(mapper, room.camera, r);
}

/// Renders a picture in passes, each with its own photons; see \ref progressive.
template <typename S>
RenderedT<typename S::Scalar> render_passes(const FileRoom<S>& room, Request& r) {
    const auto& abilities = examples::recipe_abilities;
    auto go_on = [](long long, long long) { return examples::stop_signal() == 0; };
    RenderSettings picture = r.picture;
    picture.progress = r.photon.caustics.progress = r.photon.general.progress = go_on;
    const examples::StopWatch watch;
    {
        const PhotonMapper first(room.world, r.photon, abilities);
        examples::stop_if_asked();
        tell_maps(mapper_remarks(first), r);
        r.photon = settings_for_passes(first);
    }
    RenderedT<typename S::Scalar> rendered;
    const auto pass = [&](long long i, double scale) {
        auto one = photon_mapping_pass(room.world, room.camera, r.photon, picture, i,
                                       scale, abilities);
        rendered.counts += one.counts;
        return one;
    };
    const auto state = examples::run_passes(r.passes, r.quiet, pass);
    rendered.image = mean_image<typename S::Scalar>(state);
    if (r.quiet) return rendered;
    examples::print_cost(rendered.counts, watch.seconds());
    if (survey(room.world, r.photon).caustics_map.on)
        examples::print_caustics(r.photon);
    std::printf("  %-16s %10s  ", "passes", "");
    examples::print_passes(state);
    return rendered;
}

/// Renders a picture within a given time or with a given error, with settings that are
/// chosen for that.
template <typename S>
RenderedT<typename S::Scalar> render_promised(const FileRoom<S>& room, Request& r) {
    if (room.world.has_fog())
        throw std::invalid_argument(
            "--seconds and --error choose among settings that cache irradiance, which "
            "fog does not allow: give a --preset and --rays");
    const examples::StopWatch watch;
    const auto say = [&r](const auto& kept) {
        if (!r.quiet) std::printf("  %s\n", kept.why.c_str());
        std::fflush(stdout);
    };
    const auto now = [&watch] { return watch.seconds(); };
    auto kept = keep(room.world, room.camera, r.picture, r.promise, now, r.quiet, say);
    r.remarks = kept.remarks;
    std::fputs(r.remarks.c_str(), stderr);
    r.photon = kept.recipe.settings;
    r.picture.samples = kept.recipe.rays;
    r.preset = static_cast<Preset>(kept.choice.recipe); // one recipe each
    r.kept = {
        {"why", kept.why},
        {r.promise.seconds > 0 ? "seconds" : "error",
         std::max(r.promise.seconds, r.promise.error)},
        {"pictures", kept.pictures},
        {"took", kept.seconds},
        {"estimate",
         {{"relMSE", kept.error()},
          {"interval", {kept.stated.pixels.low, kept.stated.pixels.high}},
          {"interval_of_blocks", {kept.stated.blocks.low, kept.stated.blocks.high}},
          {"checked_pixels", kept.checked_pixels()},
          {"noise", kept.noise},
          {"bias", kept.forecast().bias},
          {"error_of_bias", kept.forecast().unsure}}}};
    if (!r.quiet) {
        examples::print_cost(kept.rendered.counts, kept.seconds);
        std::printf("  %-16s %10s  relMSE %s, noise %.3g and bias %s; mean of %lld "
                    "pictures\n",
                    "error", "", stated_text(kept).c_str(), kept.noise,
                    bias_text(kept.forecast()).c_str(), kept.pictures);
    }
    return std::move(kept.rendered);
}

/// Draws the scene, and photons of one kind or of all kinds as dots.
template <typename S>
RenderedT<typename S::Scalar> draw_photons(const FileRoom<S>& room, const Request& r) {
    using T = typename S::Scalar;
    using enum PhotonKind;
    const CameraT<T>& camera = room.camera.pinhole; // without the lens
    RenderedT<T> drawn{
        scene_drawing(room.world, camera, r.picture.width, r.picture.height)};
    for (const bool caustics : {false, true}) {
        const MapType type = caustics ? MapType::caustics : MapType::general;
        if (r.photons != "all" && (r.photons == "caustic") != caustics) continue;
        examples::ProgressBar bar(caustics ? "caustics photons" : "general photons",
                                  r.quiet);
        PhotonPassSettings pass = caustics ? r.photon.caustics : r.photon.general;
        pass.progress = bar;
        const auto traced = trace_photons(room.world, type, pass);
        examples::stop_if_asked();
        for (const PhotonKind kind : {direct, indirect, shadow, caustic}) {
            if (r.photons != "all" && r.photons != name_of(kind)) continue;
            if ((kind == caustic) != caustics) continue;
            const auto color = [kind](const PhotonT<T>& photon) {
                return photon.kind == kind ? dot_color(photon) : RgbT<T>{0};
            };
            const long long seen = add_photon_dots(drawn.image, room.world, camera,
                                                   traced.photons, {}, color);
            const PhotonCount found = census(traced.photons)[kind];
            const RgbT<double>&flux = found.flux, &emitted = traced.audit.emitted;
            if (!r.quiet)
                std::printf("  %-16s %10" PRIu64 " stored, %lld seen; "
                            "%.4g, %.4g, %.4g W of %.4g, %.4g, %.4g W emitted\n",
                            name_of(kind), found.photons, seen, flux.x, flux.y, flux.z,
                            emitted.x, emitted.y, emitted.z);
        }
    }
    return drawn;
}

/// Loads the scene of a request, lists its files, and prints remarks about its meshes.
template <std::floating_point T>
LoadedSceneT<T> load_scene(Request& r) {
    const FilesRead read;
    std::string troubles;
    auto loaded = load_json<T>(r.scene, examples::with_exr(MeshFilesT<T>{&troubles}));
    if (!r.quiet) std::fputs(troubles.c_str(), stderr);
    r.reads = examples::paths_of(read);
    r.scene_hash = read.hash();
    return loaded;
}

/// The path of the picture or the slice.
std::string path_of(const Request& r, const examples::Options& options) {
    if (!options.file.empty()) return options.path(options.file);
    const std::string stem = std::filesystem::path(r.scene).stem().string();
    if (r.part.count == 0) return options.path(stem + ".png");
    return options.path(stem + "-" + std::to_string(r.part.number) + "-of-" +
                        std::to_string(r.part.count) + ".slice");
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
    if (!r.layers.empty() && !examples::is_exr(r.file))
        for (const Layer& layer :
             make_layers<float>(examples::layer_settings(r.layers), 1, 1))
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

/// Prints a line about the work that begins.
template <AnyWorld W>
void print_heading(const W& world, std::string name, const Request& r) {
    if (name.empty()) name = std::filesystem::path(r.scene).stem().string();
    std::string how = examples::first_hit_of(r.renderer) ? "the first hit"
                      : r.renderer == RendererName::path ? "path tracing"
                                                         : "photon mapping";
    if (!r.photons.empty())
        how = "photons as dots";
    else if (r.promise.seconds == 0 && r.promise.error == 0)
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
void print_plan(const W& world, const Request& r) {
    if (r.plan && r.renderer == RendererName::photon) {
        const Plan plan = survey(world, r.photon);
        for (const PlanItem* item : plan.items())
            if (item != &plan.volume_map || world.has_fog())
                std::fputs(to_text(*item).c_str(), stdout);
        tell(plan.remarks);
    }
    if (r.hooks)
        for (const std::string& line : survey_hooks(world)) std::puts(line.c_str());
}

/// Prints a remark if the camera lies in a surface, or if the scene has no surface.
template <typename S>
void tell_place(const FileRoom<S>& room) {
    using T = typename S::Scalar;
    if (room.world.size() == 0)
        return tell({"the scene has no objects: nothing but its sky, if it has one, is "
                     "seen"});
    const auto& box = room.world.box();
    const T size = max_component(glm::max(glm::abs(box.low), glm::abs(box.high)));
    const T reach = T(1e-6) * size;
    for (int axis = 0; axis < 3; ++axis) {
        Vec3T<T> way{T(0)};
        way[axis] = T(1);
        const Vec3T<T> from = room.camera.pinhole.position - reach * way;
        if (closest_hit(room.world,
                        RayT<T>{.origin = from, .direction = way, .t_max = 2 * reach}))
            return tell({"camera.position lies in a surface, which its rays may meet "
                         "at once or not at all: move it to one side"});
    }
}

/// Prints a remark if no light has reached a whole picture.
template <std::floating_point T>
void tell_dark(const ImageT<T>& image, const Request& r) {
    if (r.part.count > 0 || !r.region.empty()) return;
    for (const RgbT<T>& color : image.pixels)
        if (!is_black(color)) return;
    tell({"every pixel is black: no light reaches what the camera sees; the camera may "
          "be in a body, or the lamps may face away"});
}

/// Does the work that the user asks for, in one precision.
template <std::floating_point T>
void run_request(examples::CommandLine& line, Request& r,
                 const examples::Options& options) {
    check_options(line, r, options.file);
    auto loaded = load_scene<T>(r);
    const FileRoom room{World(std::move(loaded.scene)), loaded.camera};
    choose_settings(line, r, loaded.width, loaded.height, room.world.has_fog());
    r.file = path_of(r, options);
    if (!r.quiet || r.plan) print_heading(room.world, loaded.name, r);
    const bool prints = r.plan || r.hooks;
    // Wrong pixels and layers are refused before the work begins.
    if (!r.region.empty()) (void)region_of(r);
    if (!r.layers.empty()) (void)examples::layer_settings(r.layers);
    if (!r.pixel.empty())
        (void)pixel_of(r);
    else if (!prints)
        check_files(r);
    tell_idle_options(line, r, choose_passes(needs(room.world), r.photon));
    tell_place(room);
    const bool paths = r.renderer == RendererName::path && r.photons.empty();
    if (paths && (r.plan || !r.hooks)) tell(path_remarks(room.world));
    if (prints) return print_plan(room.world, r);
    r.passes.picture = text_of_passes(line, r);

    examples::when_stopped_say(
        r.part.count > 0 ? "the slice is not saved; the same command makes it again"
                         : "no picture is saved; a picture that can be stopped and "
                           "continued is made by --passes N --checkpoint FILE");
    const examples::StopWatch watch;
    const bool promised = r.promise.seconds > 0 || r.promise.error > 0;
    const auto first_hit = examples::first_hit_of(r.renderer);
    const RenderedLayersT<T> result =
        !r.photons.empty() ? RenderedLayersT<T>{draw_photons(room, r)}
        : promised         ? RenderedLayersT<T>{render_promised(room, r)}
        : first_hit ? run(FirstHitRenderer(room.world, *first_hit), room.camera, r)
        : paths     ? run(PathTracer(room.world, r.path), room.camera, r)
        : r.passes.passes > 0 ? RenderedLayersT<T>{render_passes(room, r)}
                              : map_photons(room, r);
    if (!r.pixel.empty()) return;
    const double seconds = watch.seconds();
    if (!first_hit && room.world.size() > 0) tell_dark(result.rendered.image, r);
    line.fill({r.picture.width, r.picture.height, r.picture.samples});
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
