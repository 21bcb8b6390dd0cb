// smoke: --quality draft --width 24 --height 24 --most 10 --seeds 2 --truth 64
/// \file chapters/experiments/35_rays_experiments.cpp
/// \brief Chapter 35: the experiments behind its tables and plots: the gain of a ray.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/oracle.hpp"

using namespace ljus;

namespace {

using examples::text;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// The options of this program, besides the common ones.
struct Sizes {
    int most = 0;  ///< The largest number of rays.
    int seeds = 0; ///< Runs behind each error.
    int truth = 0; ///< Rays per pixel of the reference.
};

/// The report's settings: depth 4, or a depth limited only by roulette.
PhotonMappingSettings settings_with(bool fixed_depth, std::uint64_t seed, int threads) {
    PhotonMappingSettings settings;
    if (fixed_depth) settings.max_depth = 4, settings.roulette_depth = 5;
    settings.caustics.photons = 100000;
    settings.caustics.seed = seed;
    settings.caustics.threads = threads;
    settings.caustics_estimate.radius = 0.05f; // the report's
    return settings;
}

using Room3 = decltype(all_materials_room());

// --- Why one over the root -----------------------------------------------------------

/// The luminance of each of many rays through one pixel: one of the floor,
/// where the lamp is large and no glass is near.
std::vector<double> values_of_pixel(const Room3& room,
                                    const examples::Options& options) {
    const auto settings = settings_with(false, options.seed, options.threads);
    const PhotonMapper mapper(room.world, settings);
    const RenderSettings picture{.width = 400,
                                 .height = 400,
                                 .samples = options.pick(1 << 14, 1 << 18, 1 << 18),
                                 .seed = options.seed,
                                 .sampling = Sampling::random};
    const PictureRays rays(picture);
    std::vector<double> values(static_cast<std::size_t>(picture.samples));
    constexpr int block = 4096; // rays
    const auto trace = [&](long long number) {
        for (int i = 0; i < block; ++i) {
            const int ray = int(number) * block + i;
            Counts counts;
            const auto found =
                trace_pixel(mapper, room.camera, rays, {200, 330, ray}, counts);
            values[std::size_t(ray)] = double(luminance(found.weight * found.radiance));
        }
    };
    parallel_blocks(picture.samples / block, trace, {.threads = options.threads});
    return values;
}

/// The means of groups of n values, over the mean of all.
std::vector<double> means_of(const std::vector<double>& values, std::size_t n) {
    double mean = 0;
    for (const double value : values) mean += value / double(values.size());
    std::vector<double> means;
    for (std::size_t i = 0; i + n <= values.size(); i += n) {
        means.push_back(0);
        for (std::size_t k = i; k < i + n; ++k)
            means.back() += values[k] / double(n) / mean;
    }
    return means;
}

/// Adds a column to a histogram from 0 to 2: a density, whose integral is 1.
void add_histogram(std::vector<examples::Row>& rows, const std::vector<double>& means) {
    const int bins = static_cast<int>(rows.size());
    std::vector<double> count(rows.size(), 0.0);
    for (const double m : means) {
        const int bin = static_cast<int>(std::floor(m / 2 * bins));
        if (bin >= 0 && bin < bins) count[std::size_t(bin)] += 1;
    }
    for (int bin = 0; bin < bins; ++bin) {
        auto& row = rows[std::size_t(bin)];
        if (row.empty()) row.push_back((bin + 0.5) * 2 / bins);
        row.push_back(count[std::size_t(bin)] / double(means.size()) * bins / 2);
    }
}

/// The means of n rays through one pixel, repeated: their distribution.
void one_pixel(const Room3& room, const examples::Options& options) {
    const auto values = values_of_pixel(room, options);
    examples::Plot plot{
        .name = "rays_per_pixel-spread",
        .columns = {"mean of n rays over the true one", "n = 4", "16", "64", "256"},
        .y_label = "probability density",
        .rows = std::vector<examples::Row>(60)};
    examples::Table table{
        .name = "rays_per_pixel-spread-table",
        .columns = {"rays", "standard deviation over the mean", "times √n"}};
    for (const std::size_t n : {1u, 4u, 16u, 64u, 256u}) {
        const auto means = means_of(values, n);
        double squares = 0;
        for (const double m : means)
            squares += (m - 1) * (m - 1) / double(means.size());
        table.rows.push_back({std::to_string(n), text(std::sqrt(squares), "%.3f"),
                              text(std::sqrt(squares * double(n)), "%.3f")});
        // One ray finds light or shadow, and little in between.
        if (n > 1) add_histogram(plot.rows, means);
    }
    save_plot(options.path(""), plot);
    save_table(options.path(""), table);
}

// --- Errors --------------------------------------------------------------------------

/// The results of a number of rays, over several seeds.
struct Rung {
    int rays = 0;          ///< Per pixel.
    double seconds = 0;    ///< Processor time of both passes, the mean.
    BiasVariance pixels{}; ///< The two parts of relMSE.
    BiasVariance blocks{}; ///< The same for means of 10 x 10 pixels.
    double rays_alone = 0; ///< The variance with one map for all seeds.
    double trimmed = 0;    ///< relMSE without the worst hundredth.
    double flip = 0;       ///< Of the first seed.

    [[nodiscard]] double error() const {
        return std::max(pixels.bias_squared + pixels.variance, 1e-12);
    }
};

/// A renderer: a picture for a number of rays, a seed for them, and one for photons.
struct Method {
    std::string name; ///< As in plots.
    std::function<Image(int rays, std::uint64_t seed, std::uint64_t map_seed)> shoot;
    bool has_map = false; ///< Whether the photons' seed matters.
};

std::vector<Rung> climb(const Method& method, const std::vector<int>& rays,
                        const examples::Oracle& oracle, int seeds, double first_pass) {
    std::vector<Rung> rungs;
    for (const int n : rays) {
        Rung rung{.rays = n, .seconds = method.has_map ? first_pass : 0};
        std::vector<Image> runs, of_one_map;
        for (int seed = 1; seed <= seeds; ++seed) {
            const auto number = static_cast<std::uint64_t>(seed);
            const double start = examples::processor_seconds();
            runs.push_back(method.shoot(n, number, number));
            rung.seconds += (examples::processor_seconds() - start) / seeds;
            if (method.has_map) of_one_map.push_back(method.shoot(n, 100 + number, 1));
            rung.trimmed += trimmed_rel_mse(runs.back(), oracle.truth) / seeds;
            examples::stop_if_asked();
        }
        const auto errors = errors_against(oracle, runs);
        rung.pixels = errors.pixels;
        rung.blocks = errors.blocks;
        rung.rays_alone =
            method.has_map ? examples::relative_split(of_one_map, oracle.truth).variance
                           : rung.pixels.variance;
        rung.flip = flip(runs[0], oracle.truth);
        rungs.push_back(rung);
    }
    return rungs;
}

/// The factor of a 95 % band for a slope through some points: Student's t.
double student_95(std::size_t points) {
    constexpr std::array<double, 9> t{0,     0,     0,     12.71, 4.303,
                                      3.182, 2.776, 2.571, 2.447};
    return points < 3 ? nothing : points < t.size() ? t[points] : 2.2;
}

/// "-1.02 +- 0.05": a slope and its 95 % band.
std::string slope_text(const std::vector<double>& x, const std::vector<double>& y) {
    const auto law = examples::fit_power(x, y);
    const double band = law.error * student_95(x.size());
    return std::isnan(band) ? text(law.slope, "%.2f")
                            : text(law.slope, "%.2f") + " ± " + text(band, "%.2f");
}

/// The error that a method has after some seconds, by straight lines between rungs; NaN
/// before the first one.
double error_at(const std::vector<double>& seconds, const std::vector<double>& errors,
                double when) {
    for (std::size_t i = 1; i < seconds.size(); ++i)
        if (seconds[i - 1] <= when && when <= seconds[i]) {
            const double t =
                std::log(when / seconds[i - 1]) / std::log(seconds[i] / seconds[i - 1]);
            return errors[i - 1] * std::pow(errors[i] / errors[i - 1], t);
        }
    return nothing;
}

/// The results of one method as lists, one per quantity.
struct Lists {
    std::vector<double> rays{}, seconds{}, noise{}, errors{};
};

Lists lists_of(const std::vector<Rung>& rungs) {
    Lists lists;
    for (const Rung& rung : rungs) {
        lists.rays.push_back(rung.rays);
        lists.seconds.push_back(rung.seconds);
        lists.noise.push_back(rung.rays_alone);
        lists.errors.push_back(rung.error());
    }
    return lists;
}

/// Error against time, and the parts of each point's error.
void show_errors(const std::vector<Method>& methods,
                 const std::vector<std::vector<Rung>>& runs,
                 const examples::Options& options) {
    examples::Plot plot{.name = "rays_per_pixel-trade",
                        .columns = {"processor seconds"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    for (const Method& method : methods) plot.columns.push_back(method.name);
    examples::Table split{.name = "rays_per_pixel-split",
                          .columns = {"rays", "", "bias²", "noise", "noise of the rays",
                                      "blocks: bias²", "noise", "trimmed", "FLIP"}};
    for (std::size_t m = 0; m < methods.size(); ++m)
        for (const Rung& rung : runs[m]) {
            examples::Row row(methods.size() + 1, nothing);
            row[0] = rung.seconds;
            row[m + 1] = rung.error();
            plot.rows.push_back(row);
            split.rows.push_back({std::to_string(rung.rays), methods[m].name,
                                  text(rung.pixels.bias_squared, "%.2g"),
                                  text(rung.pixels.variance, "%.2g"),
                                  text(rung.rays_alone, "%.2g"),
                                  text(rung.blocks.bias_squared, "%.2g"),
                                  text(rung.blocks.variance, "%.2g"),
                                  text(rung.trimmed, "%.2g"), text(rung.flip, "%.3f")});
        }
    save_plot(options.path(""), plot);
    save_table(options.path(""), split);
}

/// How fast the noise of rays falls, and the error that remains.
void show_slopes(const std::vector<Method>& methods,
                 const std::vector<std::vector<Rung>>& runs,
                 const examples::Options& options) {
    examples::Table table{.name = "rays_per_pixel-slopes",
                          .columns = {"", "slope of the rays' noise", "bias²",
                                      "noise of the photons", "bias² of blocks"}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        const Lists lists = lists_of(runs[m]);
        const Rung& last = runs[m].back();
        table.rows.push_back({methods[m].name, slope_text(lists.rays, lists.noise),
                              text(last.pixels.bias_squared, "%.2g"),
                              methods[m].has_map
                                  ? text(last.pixels.variance - last.rays_alone, "%.2g")
                                  : "none",
                              text(last.blocks.bias_squared, "%.2g")});
    }
    save_table(options.path(""), table);
}

/// The growth of the error if only half of the time is given.
void show_half_time(const std::vector<Method>& methods,
                    const std::vector<std::vector<Rung>>& runs,
                    const examples::Options& options) {
    examples::Table table{.name = "rays_per_pixel-half", .columns = {"rays"}};
    for (const Method& method : methods) table.columns.push_back(method.name);
    for (std::size_t i = 1; i < runs[0].size(); ++i) {
        std::vector<std::string> row{std::to_string(runs[0][i].rays)};
        for (const auto& rungs : runs) {
            const Lists lists = lists_of(rungs);
            const double before =
                error_at(lists.seconds, lists.errors, lists.seconds[i] / 2);
            row.push_back(std::isnan(before)
                              ? "no picture yet"
                              : text(before / lists.errors[i], "%.2f") + " times");
        }
        table.rows.push_back(row);
    }
    save_table(options.path(""), table);
}

/// Seconds and rays until an error is reached.
void equal_error(const std::vector<Method>& methods,
                 const std::vector<std::vector<Rung>>& runs,
                 const examples::Options& options) {
    examples::Table table{.name = "rays_per_pixel-error", .columns = {"relMSE"}};
    for (const Method& method : methods) table.columns.push_back(method.name);
    for (const double target : {0.3, 0.1, 0.03, 0.01, 0.003}) {
        std::vector<std::string> row{text(target)};
        for (const auto& rungs : runs) {
            const auto& [rays, seconds, noise, errors] = lists_of(rungs);
            const double when = examples::reach(seconds, errors, target);
            row.push_back(
                std::isnan(when)
                    ? "not reached with " + text(rays.back()) + " rays (" +
                          text(errors.back(), "%.2g") + ")"
                    : text(when, "%.2g") + " s, " +
                          text(examples::reach(rays, errors, target), "%.3g") +
                          " rays");
        }
        table.rows.push_back(row);
    }
    save_table(options.path(""), table);
}

/// The three ways that are compared, small pictures of the room.
struct Contest {
    const Room3& room;
    const examples::Options& options;
    int size = 0; ///< Side of the pictures.
    /// By whether the depth is fixed, and by the seed of the photons.
    std::map<std::pair<bool, std::uint64_t>, PhotonMapper<decltype(Room3::world)>>
        mappers{};
    PathTracer<decltype(Room3::world)> tracer = PathTracer(room.world);

    [[nodiscard]] RenderSettings picture(int rays, std::uint64_t seed) const {
        return {.width = size,
                .height = size,
                .samples = rays,
                .seed = seed,
                .threads = options.threads};
    }
    [[nodiscard]] Image by_photons(bool fixed_depth, int rays, std::uint64_t seed,
                                   std::uint64_t map_seed) {
        const auto [place, fresh] =
            mappers.try_emplace({fixed_depth, map_seed}, room.world,
                                settings_with(fixed_depth, map_seed, options.threads));
        return render(place->second, room.camera, picture(rays, seed)).image;
    }
    [[nodiscard]] Image by_paths(int rays, std::uint64_t seed) const {
        return render(tracer, room.camera, picture(rays, seed)).image;
    }
};

std::vector<Method> methods_of(Contest& contest) {
    const auto by_photons = [&contest](bool fixed_depth) {
        return [&contest, fixed_depth](int rays, std::uint64_t seed,
                                       std::uint64_t map_seed) {
            return contest.by_photons(fixed_depth, rays, seed, map_seed);
        };
    };
    return {{"photons to depth 4", by_photons(true), true},
            {"photons with roulette", by_photons(false), true},
            {"path tracing", [&contest](int rays, std::uint64_t seed, std::uint64_t) {
                 return contest.by_paths(rays, seed);
             }}};
}

void table_of_truth(const examples::Oracle& oracle, const examples::Options& options) {
    const examples::Table table{
        .name = "rays_per_pixel-truth",
        .columns = {"reference", "rays per pixel", "its own relMSE", "of blocks"},
        .rows = {{"path tracing, no limit of depth", std::to_string(oracle.rays),
                  text(oracle.noise, "%.2g"), text(oracle.block_noise, "%.2g")}}};
    save_table(options.path(""), table);
}

/// The gain of a ray: three ways, against a reference.
void errors_of_rays(Contest& contest, const std::vector<int>& rays,
                    const examples::Oracle& oracle, const Sizes& sizes,
                    double first_pass) {
    for (int seed = 1; seed <= sizes.seeds; ++seed) // before any clock runs
        for (const bool fixed_depth : {true, false})
            (void)contest.by_photons(fixed_depth, 1, 1, std::uint64_t(seed));
    const std::vector<Method> methods = methods_of(contest);
    std::vector<std::vector<Rung>> runs;
    for (const Method& method : methods)
        runs.push_back(climb(method, rays, oracle, sizes.seeds, first_pass));
    show_errors(methods, runs, contest.options);
    show_slopes(methods, runs, contest.options);
    show_half_time(methods, runs, contest.options);
    equal_error(methods, runs, contest.options);
}

} // namespace

/// Makes the tables and figures of chapter 33.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 35, rays per pixel: what a ray buys.");
        line.add("--most", sizes.most, "The largest number of rays", 10, 1000);
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the reference", 8,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (!line.given("--most")) sizes.most = options.pick(100, 1000, 1000);
        if (!line.given("--seeds")) sizes.seeds = options.pick(3, 6, 16);
        if (!line.given("--truth")) sizes.truth = options.pick(512, 32768, 262144);

        const auto room = all_materials_room();
        one_pixel(room, options);
        const double start = examples::processor_seconds();
        const PhotonMapper first(room.world,
                                 settings_with(true, options.seed, options.threads));
        const double first_pass = examples::processor_seconds() - start;

        std::vector<int> rays;
        for (const int n : {1, 3, 10, 30, 100, 300, 1000})
            if (n <= sizes.most) rays.push_back(n);
        const int size = std::min(options.pick(24, 64, 100), options.width);
        const auto oracle =
            examples::find_oracle("all-materials", room, size, sizes.truth, options);
        table_of_truth(oracle, options);
        Contest contest{.room = room, .options = options, .size = size};
        errors_of_rays(contest, rays, oracle, sizes, first_pass);
    });
}
