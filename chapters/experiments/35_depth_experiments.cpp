// smoke: --quality draft --width 20 --height 20 --rays 2 --seeds 2 --truth 64
/// \file chapters/experiments/35_depth_experiments.cpp
/// \brief Chapter 35: the experiments behind its tables and plots: how paths end, and
/// which pixels deserve rays.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/render/adaptive.hpp>
#include <ljus/scenes/furnaces.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/error_map.hpp"
#include "common/oracle.hpp"
#include "experiments/ended_paths.hpp"

using namespace ljus;

namespace {

using examples::Ending;
using examples::text;

/// The options of this program, besides the common ones.
struct Sizes {
    int seeds = 0; ///< Runs behind each error.
    int truth = 0; ///< Rays per pixel of the reference.
};

using Room4 = decltype(four_glass_room());

double mean_of(const std::vector<Image>& images) {
    double sum = 0, count = 0;
    for (const Image& image : images)
        for (const Rgb& c : image.pixels)
            sum += double(c.x) + double(c.y) + double(c.z), count += 3;
    return sum / count;
}

double mean_of(const ImageT<double>& image) {
    double sum = 0;
    for (const auto& c : image.pixels) sum += c.x + c.y + c.z;
    return sum / 3 / double(image.pixels.size());
}

/// "-3.1 %": the relative difference of two means.
std::string percent(double mean, double truth) {
    return text(100 * (mean - truth) / truth, "%+.2f %%");
}

// --- The furnace ---------------------------------------------------------------------

/// The light that a fixed depth loses in a room with a known solution.
void furnace_by_depth(int rays, const examples::Options& options) {
    examples::Plot plot{.name = "recursion_depth-furnace",
                        .columns = {"depth", "albedo 0.5 predicted", "measured",
                                    "albedo 0.75 predicted", "measured ",
                                    "albedo 0.9 predicted", "measured  "},
                        .y_label = "fraction of the light that is lost",
                        .log_y = true,
                        .more = "set yrange [1e-4:1]\n"};
    for (int depth = 1; depth <= 24; depth += depth < 4 ? 1 : depth < 12 ? 2 : 4) {
        examples::Row row{double(depth)};
        for (const float albedo : {0.5f, 0.75f, 0.9f}) {
            const auto room = sphere_furnace<float>(Rgb{1}, Rgb{albedo});
            const auto paths =
                examples::make_ended_paths(room.world, Ending::depth, depth);
            const double seen = mean_of({render(paths, room.camera,
                                                {.width = 16,
                                                 .height = 16,
                                                 .samples = rays,
                                                 .threads = options.threads})
                                             .image});
            const double all = 1 / (1 - double(albedo));
            row.push_back(std::pow(double(albedo), depth + 1));
            row.push_back(std::max(1 - seen / all, 1e-9));
        }
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

// --- Depth, threshold, roulette: error against time ----------------------------------

void endings(const Room4& room, const examples::Oracle& oracle,
             const examples::Options& options, const Sizes& sizes) {
    struct Way {
        std::string name;
        Ending ending;
        int depth;
        double threshold;
    };
    const std::vector<Way> ways{{"depth 2", Ending::depth, 2, 1},
                                {"depth 4", Ending::depth, 4, 1},
                                {"depth 8", Ending::depth, 8, 1},
                                {"threshold 0.3", Ending::threshold, 0, 0.3},
                                {"threshold 0.1", Ending::threshold, 0, 0.1},
                                {"threshold 0.01", Ending::threshold, 0, 0.01},
                                {"roulette from 4", Ending::roulette, 4, 1},
                                {"roulette from 1", Ending::roulette, 1, 1},
                                {"roulette, safe above 0.1", Ending::roulette, 1, 0.1}};
    examples::Table table{.name = "recursion_depth-endings",
                          .columns = {"", "rays per camera ray", "s", "light", "bias²",
                                      "noise", "1 / (noise × s)", "bias² of blocks"}};
    const double truth = mean_of(oracle.truth);
    for (const Way& way : ways) {
        const auto paths = examples::make_ended_paths(room.world, way.ending, way.depth,
                                                      way.threshold);
        std::vector<Image> runs;
        Counts counts;
        double seconds = 0;
        for (int seed = 1; seed <= sizes.seeds; ++seed) {
            const double start = examples::processor_seconds();
            const auto seen = render(paths, room.camera,
                                     {.width = oracle.truth.width,
                                      .height = oracle.truth.height,
                                      .samples = options.pick(16, 256, 256),
                                      .seed = std::uint64_t(seed),
                                      .threads = options.threads});
            seconds += (examples::processor_seconds() - start) / sizes.seeds;
            counts += seen.counts;
            runs.push_back(seen.image);
            examples::stop_if_asked();
        }
        const auto [pixels, blocks] = errors_against(oracle, runs);
        table.rows.push_back(
            {way.name, text(double(counts.rays()) / double(counts.camera_rays), "%.2f"),
             text(seconds, "%.3g"), percent(mean_of(runs), truth),
             text(pixels.bias_squared, "%.2g"), text(pixels.variance, "%.2g"),
             text(1 / (pixels.variance * std::max(seconds, 1e-9)), "%.3g"),
             text(blocks.bias_squared, "%.2g")});
    }
    save_table(options.path(""), table);
}

// --- Which pixels deserve rays -------------------------------------------------------

/// A way to distribute rays, by their number.
struct Sharing {
    std::string name;                                    ///< As in plots.
    std::function<AdaptiveSettings(int samples)> rule{}; ///< None: the same everywhere.
};

/// The results of a way: means over the seeds.
struct Shared {
    double rays = 0;     ///< Per pixel, in the mean.
    double error = 0;    ///< relMSE.
    double trimmed = 0;  ///< Without the worst hundredth.
    double estimate = 0; ///< The renderer's own relMSE.
    double mean = 0;     ///< Light.
};

template <typename Renderer>
Shared share(const Renderer& renderer, const Camera& camera, const Sharing& way,
             int samples, const ImageT<double>& truth, const examples::Options& options,
             int seeds) {
    Shared found;
    for (int seed = 1; seed <= seeds; ++seed) {
        const RenderSettings picture{.width = truth.width,
                                     .height = truth.height,
                                     .samples = samples,
                                     .seed = std::uint64_t(seed),
                                     .threads = options.threads};
        Image image;
        double rays = samples;
        if (way.rule) {
            const auto seen =
                render_adaptive(renderer, camera, picture, way.rule(samples));
            image = seen.image;
            rays = double(seen.counts.camera_rays) / double(image.pixels.size());
            found.estimate += seen.estimate / seeds;
        } else {
            image = render(renderer, camera, picture).image;
        }
        found.rays += rays / seeds;
        found.error += rel_mse(image, truth) / seeds;
        found.trimmed += trimmed_rel_mse(image, truth) / seeds;
        found.mean += mean_of({image}) / seeds;
        examples::stop_if_asked();
    }
    return found;
}

/// The mean of many pictures by the renderer itself: only the distribution of rays is
/// judged.
template <typename Renderer>
ImageT<double> own_truth(const Renderer& renderer, const Camera& camera, int size,
                         int rays, const examples::Options& options) {
    examples::ProgressBar bar("reference of adaptive sampling", options.quiet);
    const auto seen = render(renderer, camera,
                             {.width = size,
                              .height = size,
                              .samples = rays,
                              .seed = 4711,
                              .threads = options.threads,
                              .progress = bar});
    ImageT<double> truth = make_image<double>(size, size);
    for (std::size_t i = 0; i < truth.pixels.size(); ++i)
        truth.pixels[i] = RgbT<double>(seen.image.pixels[i]);
    return truth;
}

/// A renderer with which ways to distribute rays are tried.
template <typename Renderer>
struct Trial {
    const Renderer& renderer;
    const Camera& camera;
    const examples::Options& options;
    int seeds;                 ///< Runs behind each number.
    ImageT<double> truth = {}; ///< By the renderer itself.

    [[nodiscard]] Shared operator()(const Sharing& way, int samples) const {
        return share(renderer, camera, way, samples, truth, options, seeds);
    }
};

/// The ways that are compared, with some rays per pixel each.
std::vector<Sharing> sharings() {
    const auto squares = [](int side, bool two_stage) {
        return [side, two_stage](int) {
            return AdaptiveSettings{
                .first = 8, .more = 8, .block = side, .two_stage = two_stage};
        };
    };
    return {
        {"the same everywhere", {}},
        {"pixel by pixel", [](int) { return AdaptiveSettings{.first = 8, .more = 8}; }},
        {"squares of 4", squares(4, false)},
        {"squares of 8", squares(8, false)},
        {"squares of 4 in two stages", squares(4, true)}};
}

/// The error of each way, by the number of rays.
template <typename Renderer>
void error_of_sharing(const Trial<Renderer>& trial) {
    const auto& options = trial.options;
    const std::vector<Sharing> ways = sharings();
    examples::Plot plot{.name = "recursion_depth-adaptive-photons",
                        .columns = {"rays per pixel"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    for (const Sharing& way : ways) plot.columns.push_back(way.name);
    const int most = options.pick(64, 256, 1024);
    for (int samples = 16; samples <= most; samples *= 4) {
        examples::Row row{double(samples)};
        for (const Sharing& way : ways) row.push_back(trial(way, samples).error);
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

/// Where the rays went: the picture, and a map of their number.
template <typename Renderer>
void map_of_rays(const Trial<Renderer>& trial) {
    const auto& options = trial.options;
    const auto seen = render_adaptive(trial.renderer, trial.camera,
                                      {.width = options.width,
                                       .height = options.height,
                                       .samples = 64,
                                       .seed = options.seed,
                                       .threads = options.threads},
                                      {.first = 8, .more = 8, .block = 4});
    save_png(seen.image, options.path("recursion_depth-photons.png"));
    ImageT<double> rays = make_image<double>(seen.rays.width, seen.rays.height);
    double largest = 0;
    for (std::size_t i = 0; i < rays.pixels.size(); ++i) {
        rays.pixels[i] = RgbT<double>(seen.rays.pixels[i]);
        largest = std::max(largest, rays.pixels[i].x);
    }
    save_png(error_picture(rays, examples::Ramp::heat, 0, std::min(largest, 256.0)),
             options.path("recursion_depth-photons-rays.png"));
}

/// Rays until each block estimates that its error is small enough.
template <typename Renderer>
void stop_at_error(const Trial<Renderer>& trial) {
    examples::Table table{.name = "recursion_depth-stop-photons",
                          .columns = {"stop at relMSE", "", "rays per pixel",
                                      "estimated relMSE", "relMSE", "trimmed",
                                      "light"}};
    for (const double target : {0.1, 0.03, 0.01})
        for (const bool two_stage : {false, true}) {
            const Sharing way{two_stage ? "in two stages" : "in one stage",
                              [target, two_stage](int) {
                                  return AdaptiveSettings{.first = 16,
                                                          .more = 8,
                                                          .block = 8,
                                                          .target = target,
                                                          .two_stage = two_stage};
                              }};
            const Shared found = trial(way, trial.options.pick(256, 4096, 4096));
            table.rows.push_back({text(target), way.name, text(found.rays, "%.1f"),
                                  text(found.estimate, "%.3g"),
                                  text(found.error, "%.3g"),
                                  text(found.trimmed, "%.3g"),
                                  percent(found.mean, mean_of(trial.truth))});
        }
    save_table(trial.options.path(""), table);
}

/// A trial of one renderer, judged by its own picture with many rays.
template <typename Renderer>
Trial<Renderer> trial_of(const Renderer& renderer, const Camera& camera,
                         const examples::Options& options, const Sizes& sizes) {
    const int size = std::min(options.pick(24, 96, 128), options.width);
    const int rays = std::max(16, sizes.truth / options.pick(1, 4, 4));
    return {renderer, camera, options, sizes.seeds,
            own_truth(renderer, camera, size, rays, options)};
}

/// The bias of choosing by the rays that are averaged, in closed form: a bright spot
/// that a ray finds with chance p; two rays, and m more if they disagree.
void spot(const examples::Options& options) {
    examples::Plot plot{.name = "recursion_depth-spot",
                        .columns = {"probability that a ray finds the spot",
                                    "2 rays then 8 more", "8 rays then 8 more",
                                    "32 rays then 32 more"},
                        .y_label = "fraction of the light that is found",
                        .log_x = true};
    for (int i = 0; i <= 40; ++i) {
        const double p = std::pow(10.0, -3 + i / 16.0 * 1.15);
        if (p > 0.9) break;
        examples::Row row{p};
        for (const int n : {2, 8, 32}) {
            const int more = n == 2 ? 8 : n;
            // All n rays find it, or none: the mean is 1, or 0. Else more rays come:
            // E(k + m p) / (n + m), over the other cases.
            const double all = std::pow(p, n), none = std::pow(1 - p, n);
            const double found = n * p - n * all; // E(k) without k = n
            const double mean =
                all + (found + more * p * (1 - all - none)) / (n + more);
            row.push_back(mean / p);
        }
        plot.rows.push_back(row);
    }
    save_plot(options.path(""), plot);
}

} // namespace

/// Makes the tables and figures of chapter 35 on depth and on adaptive sampling.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 35, depth: how paths end, and adaptive sampling.");
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the reference", 8,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 64, .height = 64, .samples = 8},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (!line.given("--seeds")) sizes.seeds = options.pick(2, 6, 16);
        if (!line.given("--truth")) sizes.truth = options.pick(512, 32768, 262144);

        spot(options);
        furnace_by_depth(options.pick(16, 64, 256), options);
        const auto room = four_glass_room();
        const int side = std::min(options.pick(20, 64, 100), options.width);
        const auto oracle =
            examples::find_oracle("four-glass", room, side, sizes.truth, options);
        endings(room, oracle, options, sizes);

        // Without split_glass a few fireflies would decide all errors.
        PhotonMappingSettings settings{.split_glass = true};
        settings.caustics.photons = 100000;
        settings.caustics.seed = options.seed;
        settings.caustics.threads = options.threads;
        settings.caustics_estimate.radius = 0.05f; // the report's
        const PhotonMapper mapper(room.world, settings);
        const auto photons = trial_of(mapper, room.camera, options, sizes);
        error_of_sharing(photons);
        map_of_rays(photons);
        stop_at_error(photons);
    });
}
