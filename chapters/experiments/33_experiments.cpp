// smoke: --quality draft --width 16 --height 16 --rungs 2 --seeds 2 --truth 16
/// \file chapters/experiments/33_experiments.cpp
/// \brief Chapter 33: two rooms by all renderers: error against time, the same time, bias
/// and noise, and which light paths each carries.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/inspect/class_means.hpp>
#include <ljus/ljus.hpp>
#include <ljus/path/light_path_expression.hpp>
#include <ljus/radiosity/light_map.hpp>
#include <ljus/radiosity/patches.hpp>
#include <ljus/radiosity/radiosity.hpp>
#include <ljus/scene/camera.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/plot.hpp"
#include "common/terminal.hpp"
#include "experiments/show_table.hpp"

using namespace ljus;

namespace {

using Cornell = World<CornellSceneT<float>>;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The options of this program, besides the common ones.
struct Sizes {
    int rungs = 0; ///< Efforts tried, each four times the one before.
    int seeds = 0; ///< Runs of each.
    int truth = 0; ///< Rays per pixel of the reference.
};

// --- The renderers --------------------------------------------------------------------

/// One picture, and what it took.
struct Shot {
    Image image{};           ///< The picture.
    Counts counts{};         ///< Rays of the view.
    double solution = 0;     ///< Seconds for what does not depend on the camera.
    double view = 0;         ///< Seconds for the picture.
    std::size_t memory = 0;  ///< Bytes kept for other views.
    std::size_t working = 0; ///< Peak bytes while it is made.
    long long photons = 0;   ///< How many were emitted.

    [[nodiscard]] double seconds() const { return solution + view; }
};

/// A renderer whose rays, photons and radius, or patches, follow from an effort.
struct Method {
    std::string name; ///< As in plots.
    std::string file; ///< As in names of files.
    /// Renders a room. `effort` is a number of rays per pixel, or as much work;
    /// cameras: one picture each from one solution.
    std::function<std::vector<Shot>(const Cornell&, const std::vector<Camera>&,
                                    double effort, std::uint64_t seed)>
        shoot{};
};

/// Seconds of processor time since the last call.
struct Lap {
    double start = examples::processor_seconds();
    double operator()() {
        const double now = examples::processor_seconds();
        const double spent = now - start;
        start = now;
        return std::max(spent, 1e-6);
    }
};

/// Pictures from all cameras by a renderer that is ready.
template <typename Renderer>
std::vector<Shot> views_of(const Renderer& renderer, const std::vector<Camera>& cameras,
                           const examples::Options& options, double rays,
                           std::uint64_t seed, const Shot& made = {}) {
    std::vector<Shot> shots;
    for (const Camera& camera : cameras) {
        Lap lap;
        const auto seen = render(renderer, camera,
                                 {.width = options.width,
                                  .height = options.height,
                                  .samples = std::max(1, int(std::lround(rays))),
                                  .seed = seed,
                                  .threads = options.threads});
        shots.push_back(made);
        shots.back().view = lap();
        shots.back().image = seen.image;
        shots.back().counts = seen.counts;
        examples::stop_if_asked();
    }
    return shots;
}

/// The bytes of a photon map.
std::size_t bytes_of(const PhotonMap& map) {
    return map.tree.bytes() + map.records.bytes();
}

/// The photon maps' efforts: photons in proportion to the rays, and
/// a radius that shrinks with their sixth root, so that bias and noise fall together.
PhotonMappingSettings photon_settings(IndirectLight indirect, double effort,
                                      std::uint64_t seed) {
    const bool direct = indirect == IndirectLight::photons;
    const auto many = std::llround((direct ? 4000 : 500) * effort);
    const auto smaller = float(std::pow(effort, -1.0 / 6));
    return {.shadow_rays = direct ? 4 : 1,
            .indirect = indirect,
            .caustics{.photons = many, .seed = seed},
            .general{.photons = many, .seed = seed, .shadow_photons = false},
            .caustics_estimate{.radius = 0.15f * smaller},
            .general_estimate{.radius = (direct ? 0.35f : 0.5f) * smaller}};
}

using Cameras = std::vector<Camera>;

/// A method whose renderer needs only the scene.
template <typename Make>
Method by_rays(const std::string& name, const std::string& file, Make make,
               const examples::Options& options) {
    return {name, file,
            [&options, make](const Cornell& world, const Cameras& cameras,
                             double effort, std::uint64_t seed) {
                return views_of(make(world), cameras, options, effort, seed);
            }};
}

/// Radiosity: patches that shrink as the effort grows.
Method by_radiosity(const examples::Options& options) {
    return {"radiosity", "radiosity",
            [&options](const Cornell& world, const Cameras& cameras, double effort,
                       std::uint64_t seed) {
                Lap lap;
                const auto solved = make_radiosity(
                    world,
                    {.patches = {.size = std::max(0.8 / std::sqrt(effort), 0.07)},
                     .factors = {.analytic = false,
                                 .rays = 512,
                                 .seed = seed,
                                 .threads = options.threads}});
                const LightMapView view(world, solved->map);
                const std::size_t kept =
                    solved->map.irradiance.size() * sizeof(RgbT<double>);
                return views_of(view, cameras, options, std::max(effort / 4, 4.0), seed,
                                {.solution = lap(),
                                 .memory = kept,
                                 .working = kept + solved->factors.exchange.size() *
                                                       sizeof(double)});
            }};
}

/// Photon mapping: the general map where an indirect ray ends, or where the camera
/// looks.
Method by_photons(IndirectLight indirect, const examples::Options& options) {
    const bool direct = indirect == IndirectLight::photons;
    return {direct ? "photon map seen" : "two passes", direct ? "seen" : "photons",
            [&options, indirect, direct](const Cornell& world, const Cameras& cameras,
                                         double effort, std::uint64_t seed) {
                const auto settings = photon_settings(indirect, effort, seed);
                Lap lap;
                const PhotonMapper mapper(world, settings);
                const auto& maps = mapper.maps();
                const std::size_t kept =
                    bytes_of(maps.general) + bytes_of(maps.caustics);
                const long long passes = maps.caustics.empty() ? 1 : 2;
                return views_of(mapper, cameras, options, direct ? effort / 4 : effort,
                                seed,
                                {.solution = lap(),
                                 .memory = kept,
                                 .working = kept,
                                 .photons = passes * settings.general.photons});
            }};
}

/// All renderers of the book so far, and two ways to use photons.
std::vector<Method> methods(const examples::Options& options) {
    return {by_rays(
                "Whitted", "whitted",
                [](const Cornell& world) { return WhittedTracer(world); }, options),
            by_rays(
                "distributed rays", "distributed",
                [](const Cornell& world) { return DistributedTracer(world); }, options),
            by_rays(
                "path tracing", "paths",
                [](const Cornell& world) { return PathTracer(world); }, options),
            by_radiosity(options),
            by_photons(IndirectLight::map, options),
            by_photons(IndirectLight::photons, options)};
}

// --- Error against time ---------------------------------------------------------------

/// The result of one method with one effort.
struct Rung {
    double effort = 0;     ///< The effort.
    double seconds = 0;    ///< Median over the seeds.
    double rays = 0;       ///< Of the view.
    double photons = 0;    ///< Emitted.
    BiasVariance pixels{}; ///< The two parts of relMSE.
    BiasVariance blocks{}; ///< The same for means of 10 x 10 pixels.

    [[nodiscard]] double error(bool block) const {
        const BiasVariance& parts = block ? blocks : pixels;
        return parts.bias_squared + parts.variance;
    }
};

/// A room, its reference, and the results of all methods.
struct Study {
    std::string name;                      ///< Of the room.
    Room<CornellSceneT<float>> room;       ///< The room.
    ImageT<double> truth{};                ///< By another renderer, with other seeds.
    double noise = 0;                      ///< Of the truth, as relMSE.
    double block_noise = 0;                ///< The same of its blocks.
    std::vector<std::vector<Rung>> runs{}; ///< One list per method.
};

/// A path tracer for the reference: at every surface the random numbers of a pixel's
/// rays are stratified, and caustics come from photons.
struct Judge {
    using Stream = StratifiedStream; ///< The random stream that render() passes to it.
    const Cornell& world;            ///< Of a room.
    const PhotonMap& caustics;       ///< Empty in the matt room.
    DensityEstimateSettings gather;  ///< In discs smaller than a pixel.
};

/// What a matt surface reflects of the light of all lamps and of the caustics map.
template <typename Material>
Rgb lamps_and_caustics(const Judge& judge, const VertexT<float>& at,
                       const Material& material, auto& context) {
    const Rgb lamps = sample_all_lights(judge.world, at, material, {}, context);
    return lamps + estimate_radiance(judge.caustics, at, material, at.wo, judge.gather,
                                     light_kinds, context.counts.map_photons);
}

Rgb radiance(const Judge& judge, const Ray& ray, auto& context) {
    Rgb sum{0};
    PathState path{.ray = ray};
    while (path.depth < 1000) {
        const auto vertex = next_vertex(judge.world, path, context.stream);
        if (!vertex) break;
        if (vertex->emits() && !path.met_diffuse)
            sum += path.throughput * vertex->object.emission;
        const auto at_material = [&](const auto& matter) {
            if (has(lobes(matter), Lobes::non_specular))
                sum += path.throughput *
                       lamps_and_caustics(judge, *vertex, matter, context);
            return continue_path(path, *vertex, matter, Transport::radiance, Lobes::all,
                                 context.stream);
        };
        if (!visit_material_at(judge.world, *vertex, at_material)) break;
        if (path.depth >= 4 &&
            !survives(path.throughput, path.eta_scale, next_1d(context.stream), 0.4f))
            break;
    }
    return sum;
}

/// A room by the renderer of the reference.
/// \param photons  Of the caustics map.
/// \param radius   Of its discs, m.
/// \param options  Its size, and the number of threads.
Image judged(const Room<CornellSceneT<float>>& room, int rays, long long photons,
             float radius, std::uint64_t seed, const examples::Options& options) {
    const PhotonMappingSettings settings{.indirect = IndirectLight::rays,
                                         .caustics{.photons = photons, .seed = seed},
                                         .caustics_estimate{.radius = radius}};
    const PhotonMapper mapper(room.world, settings);
    examples::ProgressBar bar("reference", options.quiet);
    const Judge judge{.world = room.world,
                      .caustics = mapper.maps().caustics,
                      .gather = settings.caustics_estimate};
    auto rendered = render(judge, room.camera,
                           {.width = options.width,
                            .height = options.height,
                            .samples = rays,
                            .seed = seed,
                            .threads = options.threads,
                            .progress = bar});
    examples::stop_if_asked();
    return std::move(rendered.image);
}

/// The reference: the mean of eight pictures, whose scatter gives its error.
/// \param panels  As options, but with the size of what is shown.
void find_truth(Study& study, int rays, const examples::Options& options,
                const examples::Options& panels) {
    constexpr int parts = 8;
    const int part = std::max(1, rays / parts);
    const float radius = 0.6f / float(options.width);
    std::vector<Image> runs;
    for (std::uint64_t number = 0; number < parts; ++number)
        runs.push_back(judged(study.room, part, 400LL * part, radius,
                              options.seed + 1000 + number, options));
    study.truth = {options.width, options.height,
                   std::vector<RgbT<double>>(runs[0].pixels.size())};
    for (const Image& run : runs)
        for (std::size_t i = 0; i < run.pixels.size(); ++i)
            study.truth.pixels[i] += RgbT<double>(run.pixels[i]) / double(parts);
    study.noise = examples::relative_split(runs, study.truth).variance / parts;
    study.block_noise =
        examples::relative_split(runs, study.truth, 0, 10).variance / parts;
    save_png(judged(study.room, part, 400LL * rays, radius, options.seed + 900, panels),
             options.path("side_by_side-" + study.name + "-truth.png"));
}

/// Runs all methods, rung by rung.
void climb(Study& study, const std::vector<Method>& all,
           const examples::Options& options, const Sizes& sizes) {
    for (const Method& method : all) {
        study.runs.emplace_back();
        for (int rung = 0; rung < sizes.rungs; ++rung) {
            Rung result{.effort = std::pow(4.0, rung)};
            std::vector<Image> images;
            std::vector<double> seconds;
            for (int seed = 0; seed < sizes.seeds; ++seed) {
                // A processor clock may tick only a hundred times a second.
                Shot shot;
                Lap lap;
                double spent = 0;
                int repeats = 0;
                for (; spent < options.pick(0.01, 0.06, 0.06);
                     ++repeats, spent += lap())
                    shot = method.shoot(study.room.world, {study.room.camera},
                                        result.effort,
                                        options.seed + std::uint64_t(seed))[0];
                images.push_back(shot.image);
                seconds.push_back(spent / repeats);
                result.rays += double(shot.counts.rays()) / sizes.seeds;
                result.photons = double(shot.photons);
            }
            std::sort(seconds.begin(), seconds.end());
            result.seconds = seconds[seconds.size() / 2];
            result.pixels = examples::relative_split(images, study.truth, study.noise);
            result.blocks =
                examples::relative_split(images, study.truth, study.block_noise, 10);
            if (!options.quiet)
                std::printf("%s, %s, effort %.0f: %.3f s, %.0f rays, %.0f photons, "
                            "relMSE %.5f (bias^2 %.5f), blocks %.6f (bias^2 %.6f)\n",
                            study.name.c_str(), method.name.c_str(), result.effort,
                            result.seconds, result.rays, result.photons,
                            result.error(false), result.pixels.bias_squared,
                            result.error(true), result.blocks.bias_squared);
            study.runs.back().push_back(std::move(result));
        }
    }
}

/// One column of a list of rungs.
template <typename Value>
std::vector<double> column(const std::vector<Rung>& rungs, Value value) {
    std::vector<double> list;
    for (const Rung& rung : rungs) list.push_back(value(rung));
    return list;
}
std::vector<double> times(const std::vector<Rung>& rungs) {
    return column(rungs, [](const Rung& rung) { return rung.seconds; });
}
std::vector<double> errors(const std::vector<Rung>& rungs, bool block) {
    return column(rungs, [&](const Rung& rung) { return rung.error(block); });
}

/// Two plots: relMSE of pixels and of blocks, against time.
void plots(const Study& study, const std::vector<Method>& all,
           const examples::Options& options) {
    for (const bool block : {false, true}) {
        examples::Plot plot{.name = "side_by_side-" + study.name +
                                    (block ? "-blocks" : "-pixels"),
                            .columns = {"seconds of processor time"},
                            .y_label = block ? "relMSE of 10 x 10 blocks" : "relMSE",
                            .log_x = true,
                            .log_y = true};
        for (std::size_t k = 0; k < all.size(); ++k) {
            plot.columns.push_back(all[k].name);
            for (const Rung& rung : study.runs[k]) {
                examples::Row row(all.size() + 1, nothing);
                row[0] = rung.seconds;
                row[k + 1] = std::max(rung.error(block), 1e-9);
                plot.rows.push_back(row);
            }
        }
        save_plot(options.out, plot);
    }
}

/// Slopes, and the bias in the best run's error.
void split_table(const Study& study, const std::vector<Method>& all,
                 const examples::Options& options) {
    examples::Table table{.name = "side_by_side-" + study.name + "-split",
                          .columns = {"", "slope of relMSE against time",
                                      "of the best: bias²", "noise", "blocks: bias²",
                                      "noise "}};
    for (std::size_t k = 0; k < all.size(); ++k) {
        const auto law =
            examples::fit_power(times(study.runs[k]), errors(study.runs[k], false));
        const Rung& best = study.runs[k].back();
        table.rows.push_back({all[k].name,
                              examples::text(law.slope, "%.2f") + " ± " +
                                  examples::text(law.error, "%.2f"),
                              examples::text(best.pixels.bias_squared, "%.5f"),
                              examples::text(best.pixels.variance, "%.5f"),
                              examples::text(best.blocks.bias_squared, "%.6f"),
                              examples::text(best.blocks.variance, "%.6f")});
    }
    examples::show_table(options, table);
    // Every point, to draw other plots from.
    examples::Table points{.name = "side_by_side-" + study.name + "-points",
                           .columns = {"renderer", "effort", "seconds", "rays",
                                       "photons", "bias2", "variance", "block bias2",
                                       "block variance"}};
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < all.size(); ++k)
        for (const Rung& r : study.runs[k]) {
            std::vector<std::string> row{all[k].name};
            for (const double value :
                 {r.effort, r.seconds, r.rays, r.photons, r.pixels.bias_squared,
                  r.pixels.variance, r.blocks.bias_squared, r.blocks.variance})
                row.push_back(examples::text(value, "%.6g"));
            points.rows.push_back(row);
            smallest = std::min(smallest, r.error(false));
        }
    save_table(options.out, points);
    if (!options.quiet)
        std::printf("%s: the reference's standard error is %.4f; the smallest error "
                    "reported (root of relMSE) is %.4f, %.1f times as much\n",
                    study.name.c_str(), std::sqrt(study.noise), std::sqrt(smallest),
                    std::sqrt(smallest / study.noise));
}

// --- The same time --------------------------------------------------------------------

/// A picture of a method for a panel.
Shot panel(const Study& study, const Method& method, double effort,
           const examples::Options& options) {
    return method.shoot(study.room.world, {study.room.camera}, effort,
                        options.seed + 77)[0];
}

/// The effort that takes a time: between rungs a straight line, beyond them the power
/// law of the last two, or in proportion if that is less. At least 1 ray per pixel.
double effort_for(const std::vector<Rung>& rungs, double seconds) {
    const Rung &last = rungs.back(), &before = rungs[rungs.size() - 2];
    if (seconds >= last.seconds) {
        const double power = std::log(last.seconds / before.seconds) /
                             std::log(last.effort / before.effort);
        return last.effort * std::pow(seconds / last.seconds, 1 / std::max(power, 1.0));
    }
    for (std::size_t i = 1; i < rungs.size(); ++i)
        if (seconds <= rungs[i].seconds && rungs[i].seconds > rungs[i - 1].seconds) {
            const double t = (seconds - rungs[i - 1].seconds) /
                             (rungs[i].seconds - rungs[i - 1].seconds);
            return std::max(1.0, rungs[i - 1].effort +
                                     t * (rungs[i].effort - rungs[i - 1].effort));
        }
    return 1;
}

/// All renderers at the same time; `larger`: also the pictures of
/// the first of the times, in more pixels by the same effort.
void equal_time(const Study& study, const std::vector<Method>& all,
                const std::vector<Method>& larger, const examples::Options& options) {
    examples::Table table{
        .name = "side_by_side-" + study.name + "-time",
        .columns = {"", "budget, s", "taken, s", "rays per pixel", "photons", "relMSE",
                    "times the reference's error", "of 10 x 10 blocks", "FLIP"}};
    const std::vector<double> budgets =
        options.pick<std::vector<double>>({0.1}, {1, 10}, {1, 10, 100});
    for (std::size_t b = 0; b < budgets.size(); ++b)
        for (std::size_t k = 0; k < all.size(); ++k) {
            const double effort = std::min(effort_for(study.runs[k], budgets[b]), 1e6);
            const Shot shot = panel(study, all[k], effort, options);
            // The example of the chapter makes those of the matt room.
            if (b == 0 && study.name == "glass")
                save_png(panel(study, larger[k], effort, options).image,
                         options.path("side_by_side-" + study.name + "-time-" +
                                      all[k].file + ".png"));
            const double pixels = double(options.width) * options.height;
            const double error = rel_mse(shot.image, study.truth) - study.noise;
            table.rows.push_back(
                {all[k].name, examples::text(budgets[b]),
                 examples::text(shot.seconds(), "%.2f"),
                 examples::text(double(shot.counts.camera_rays) / pixels),
                 std::to_string(shot.photons), examples::text(error, "%.5f"),
                 examples::text(std::sqrt(std::max(error, 0.0) / study.noise), "%.0f"),
                 examples::text(
                     block_error(shot.image, study.truth) - study.block_noise, "%.6f"),
                 examples::text(flip(shot.image, study.truth), "%.3f")});
        }
    examples::show_table(options, table);
}

// --- Who carries what -----------------------------------------------------------------

/// The classes of paths that are distinguished.
constexpr std::array class_names{"EL",      "ES+L",       "EDL", "ES+DL",
                                 "ES*DS+L", "E.*D.*D.*L", "E.*L"};

/// How much light of one class a renderer finds, over several seeds.
struct ClassSum {
    double mean = 0, squares = 0;

    /// The relative standard error of the mean.
    [[nodiscard]] double error(int seeds) const {
        const double spread = std::max(squares - mean * mean, 0.0);
        return mean > 0 ? std::sqrt(spread / (seeds - 1)) / mean : 0;
    }
};
using ClassSums = std::array<ClassSum, class_names.size()>;

/// Settings common to all renderers when their classes are measured.
struct ClassStudy {
    const Study& study;
    const examples::Options& options;
    int seeds;
    std::vector<LightPathExpression> classes{};
};

/// The means over the seeds of the results of `make`.
template <typename Make>
ClassSums over_seeds(const ClassStudy& of, Make make) {
    ClassSums sums{};
    for (int seed = 1; seed <= of.seeds; ++seed) {
        const std::vector<RgbT<double>> means =
            make({.width = of.options.width,
                  .height = of.options.height,
                  .samples = of.options.pick(2, 16, 64),
                  .seed = of.options.seed + 5000 + std::uint64_t(seed),
                  .threads = of.options.threads});
        examples::stop_if_asked();
        for (std::size_t k = 0; k < means.size(); ++k) {
            const double value = (means[k].x + means[k].y + means[k].z) / 3;
            sums[k].mean += value / of.seeds;
            sums[k].squares += value * value / of.seeds;
        }
    }
    return sums;
}

/// The classes of a renderer that is ready.
template <typename Renderer>
ClassSums classes_of(const ClassStudy& of, const Renderer& renderer) {
    return over_seeds(of, [&](const RenderSettings& picture) {
        return class_means(renderer, of.study.room.camera, picture, of.classes);
    });
}

/// The classes of photon mapping, with maps of its own for each seed.
ClassSums classes_of_photons(const ClassStudy& of, IndirectLight indirect) {
    const Cornell& world = of.study.room.world;
    return over_seeds(of, [&](const RenderSettings& picture) {
        const auto settings =
            photon_settings(indirect, of.options.pick(16.0, 64.0, 256.0), picture.seed);
        return class_means(PhotonMapper(world, settings), of.study.room.camera, picture,
                           of.classes);
    });
}

/// The classes of radiosity, which answers for E D+ L at once. What its lamps' patches
/// send out, and no others, is E D L; the rest is E D+ D L.
ClassSums classes_of_radiosity(const ClassStudy& of) {
    const Cornell& world = of.study.room.world;
    return over_seeds(of, [&](const RenderSettings& picture) {
        const auto all = make_radiosity(
            world, {.patches = {.size = of.options.pick(0.4, 0.2, 0.1)},
                    .factors = {.analytic = false, .rays = 512, .seed = picture.seed}});
        std::vector<RgbT<double>> lamp;
        for (const Patch& patch : all->patches.patches) lamp.push_back(patch.emitted);
        const auto view = [&](const LightMap& map) {
            return class_means(LightMapView(world, map), of.study.room.camera, picture,
                               of.classes);
        };
        auto whole = view(all->map);
        const auto direct =
            view(make_light_map(world, all->patches, all->factors, lamp));
        whole[5] = whole[2] - direct[2];
        whole[2] = direct[2];
        return whole;
    });
}

/// "0.998(3)": a class over the true one, and the standard error of its last digit.
/// Empty if the room has no such light.
std::string class_ratio(const ClassSum& its, const ClassSum& right, int seeds) {
    if (!(right.mean > 0)) return its.mean > 0 ? "?" : "";
    // The difference of two light maps may leave a rest by rounding.
    if (!(its.mean > 1e-6 * right.mean)) return "0";
    const double ratio = its.mean / right.mean;
    const double error = ratio * std::hypot(its.error(seeds), right.error(seeds));
    return examples::text(ratio, "%.3f(") + std::to_string(std::lround(1000 * error)) +
           ")";
}

/// For each class of paths, the light that a renderer finds over that of path tracing.
void class_table(const Study& study, const examples::Options& options,
                 const Sizes& sizes) {
    const Cornell& world = study.room.world;
    ClassStudy of{study, options, std::max(sizes.seeds, 4)};
    for (const char* name : class_names)
        of.classes.push_back(light_path_expression(name));
    const ClassSums truth = classes_of(of, PathTracer(world));
    const std::array<std::pair<const char*, ClassSums>, 6> renderers{
        {{"Whitted", classes_of(of, WhittedTracer(world))},
         {"distributed rays", classes_of(of, DistributedTracer(world))},
         {"path tracing", truth},
         {"radiosity", classes_of_radiosity(of)},
         {"two passes", classes_of_photons(of, IndirectLight::map)},
         {"photon map seen", classes_of_photons(of, IndirectLight::photons)}}};

    examples::Table table{.name = "side_by_side-" + study.name + "-classes",
                          .columns = {""}};
    table.columns.insert(table.columns.end(), class_names.begin(), class_names.end());
    std::vector<std::string> share{"share of the light"};
    for (const ClassSum& sum : truth)
        share.push_back(examples::text(100 * sum.mean / truth.back().mean, "%.1f %%"));
    table.rows.push_back(share);
    for (const auto& [name, sums] : renderers) {
        std::vector<std::string> row{name};
        for (std::size_t k = 0; k < sums.size(); ++k)
            row.push_back(class_ratio(sums[k], truth[k], of.seeds));
        table.rows.push_back(row);
    }
    examples::show_table(options, table);
}

// --- One solution, many views ---------------------------------------------------------

/// The cost of the first view and of each further one, and the memory kept.
void views(const Study& study, const std::vector<Method>& all,
           const examples::Options& options, const Sizes& sizes) {
    constexpr int count = 5;
    std::vector<Camera> cameras;
    for (int i = 0; i < count; ++i) {
        const auto x = float(-0.8 + 1.6 * i / (count - 1));
        cameras.push_back(look_at(View{.position{x, 1.0f + x / 2, 4.4f - x * x},
                                       .target{0, 1, 0},
                                       .up{0, 1, 0},
                                       .vfov_degrees = 33}));
    }
    examples::Table table{.name = "side_by_side-" + study.name + "-views",
                          .columns = {"", "solution, s", "per view, s",
                                      "a further view over the first", "kept",
                                      "while it is made"}};
    const double effort = std::pow(4.0, sizes.rungs - 1);
    for (const Method& method : all) {
        if (method.file == "whitted" || method.file == "distributed") continue;
        const auto shots =
            method.shoot(study.room.world, cameras, effort, options.seed);
        const double solution = shots[0].solution;
        double view = 0;
        for (const Shot& shot : shots) view += shot.view / count;
        const auto size = [](std::size_t bytes) {
            return bytes == 0 ? std::string("nothing")
                              : examples::text(double(bytes) / 1e6, "%.2f MB");
        };
        const bool keeps = shots[0].memory > 0;
        table.rows.push_back({method.name,
                              keeps ? examples::text(solution, "%.3f") : "none",
                              examples::text(view, "%.3f"),
                              examples::text(view / (solution + view), "%.2f"),
                              size(shots[0].memory), size(shots[0].working)});
    }
    examples::show_table(options, table);
}

} // namespace

/// Makes the plots, tables and further pictures of chapter 33.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 33, side by side: the experiments in two rooms.");
        line.add("--rungs", sizes.rungs,
                 "Efforts tried, each four times the one before", 2, 8);
        line.add("--seeds", sizes.seeds, "Runs of each effort", 2, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the reference", 8,
                 10000000);
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40, .samples = 1},
                        .report{.width = 100, .height = 100, .samples = 1},
                        .reference{.width = 200, .height = 200, .samples = 1}});
        if (!line.given("--rungs")) sizes.rungs = options.pick(3, 4, 5);
        if (!line.given("--seeds")) sizes.seeds = options.pick(3, 6, 12);
        if (!line.given("--truth")) sizes.truth = options.pick(1000, 8000, 100000);

        examples::Options panels = options; // the size of what is shown
        panels.width *= options.pick(1, 4, 2);
        panels.height *= options.pick(1, 4, 2);
        const auto all = methods(options), larger = methods(panels);
        for (const bool matt : {true, false}) {
            Study study{.name = matt ? "matt" : "glass",
                        .room = matt ? matt_cornell_box() : cornell_box()};
            find_truth(study, sizes.truth, options, panels);
            climb(study, all, options, sizes);
            plots(study, all, options);
            if (matt) split_table(study, all, options);
            equal_time(study, all, larger, options);
            class_table(study, options, sizes);
            if (matt) views(study, all, options, sizes);
        }
    });
}
