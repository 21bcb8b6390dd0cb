// figures: table-3 fig-12
// smoke: --quality draft --width 24 --height 24 --most 10 --seeds 2 --truth 64
/// \file 33_rays_per_pixel.cpp
/// \brief Chapter 33: rays per pixel. Table 3, figure 12, and what a ray buys.

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

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"

using namespace ljus;

namespace {

using examples::text;
constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// What the user may set besides the common options.
struct Sizes {
    int most = 0;  ///< The largest number of rays.
    int seeds = 0; ///< Runs behind each error.
    int truth = 0; ///< Rays a pixel of the reference.
};

/// A row of the report's table 3.
struct ReportRow {
    int rays;         ///< A pixel.
    double seconds;   ///< Its time.
    const char* time; ///< As it is printed.
};
constexpr std::array<ReportRow, 4> report_rows{{{1, 16, "16 s"},
                                                {10, 20, "20 s"},
                                                {100, 72, "1 min 12 s"},
                                                {1000, 763, "12 min 43 s"}}};

/// The report's settings: depth 4, or as far as roulette lets a path go.
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

/// The means of n rays through one pixel, again and again: how they are spread.
void one_pixel(const Room3& room, const examples::Options& options) {
    const auto settings = settings_with(false, options.seed, options.threads);
    const auto maps = make_photon_maps(room.scene, settings);
    const auto mapper = make_photon_mapper(room.scene, maps, settings);
    // A pixel of the floor, where the lamp is large and no glass is near.
    const int rays = options.pick(1 << 14, 1 << 18, 1 << 18);
    const RenderSettings picture{.width = 400,
                                 .height = 400,
                                 .samples = rays,
                                 .seed = options.seed,
                                 .sampling = Sampling::random};
    const Pattern pattern = make_pattern(picture.sampling, rays);
    std::vector<double> values(static_cast<std::size_t>(rays));
    constexpr long long size = 4096;
    const auto body = [&](long long block) {
        Counts counts;
        const auto range = detail::block_range(block, size, rays);
        for (long long i = range.first; i < range.last; ++i)
            values[static_cast<std::size_t>(i)] = double(luminance(detail::sample_pixel(
                mapper, room.camera, picture, pattern, 200, 330, int(i), counts)));
    };
    parallel_blocks(detail::block_count(rays, size), body,
                    {.threads = options.threads});

    constexpr std::array groups{1, 4, 16, 64, 256};
    double mean = 0;
    for (const double value : values) mean += value / double(values.size());
    constexpr int bins = 60;
    examples::Plot plot{
        .name = "rays_per_pixel-spread",
        .columns = {"mean of n rays over the true one", "n = 4", "16", "64", "256"},
        .y_label = "how often",
        .rows = std::vector<examples::Row>(bins)};
    examples::Table table{
        .name = "rays_per_pixel-spread-table",
        .columns = {"rays", "standard deviation, of the mean", "times the root of n"}};
    for (std::size_t g = 0; g < groups.size(); ++g) {
        const auto n = static_cast<std::size_t>(groups[g]);
        std::vector<double> means;
        for (std::size_t i = 0; i + n <= values.size(); i += n) {
            means.push_back(0);
            for (std::size_t k = i; k < i + n; ++k)
                means.back() += values[k] / double(n) / mean;
        }
        double squares = 0;
        for (const double m : means)
            squares += (m - 1) * (m - 1) / double(means.size());
        table.rows.push_back({std::to_string(n), text(std::sqrt(squares), "%.3f"),
                              text(std::sqrt(squares * double(n)), "%.3f")});
        if (g == 0) continue; // one ray: light or shadow, and little in between
        std::vector<double> count(bins, 0.0);
        for (const double m : means) {
            const int bin = static_cast<int>(std::floor(m / 2 * bins));
            if (bin >= 0 && bin < bins) count[std::size_t(bin)] += 1;
        }
        for (int bin = 0; bin < bins; ++bin) {
            auto& row = plot.rows[std::size_t(bin)];
            if (row.empty()) row.push_back((bin + 0.5) * 2 / bins);
            row.push_back(count[std::size_t(bin)] / double(means.size()) * bins / 2);
        }
    }
    save_plot(options.path(""), plot);
    save_table(options.path(""), table);
}

// --- Figure 12 -----------------------------------------------------------------------

/// What the pictures of figure 12 took.
struct Shots {
    double first = 0;              ///< Processor seconds of the first pass.
    std::vector<double> seconds{}; ///< Of the second, for each number of rays.
};

Shots figure_12(const Room3& room, const std::vector<int>& rays,
                const examples::Options& options) {
    const auto settings = settings_with(true, options.seed, options.threads);
    Shots shots;
    const double start = examples::processor_seconds();
    const auto maps = make_photon_maps(room.scene, settings);
    shots.first = examples::processor_seconds() - start;
    const auto mapper = make_photon_mapper(room.scene, maps, settings);
    for (const int n : rays) {
        examples::ProgressBar bar("fig-12, " + std::to_string(n) + " rays",
                                  options.quiet);
        const double before = examples::processor_seconds();
        const auto seen = render(mapper, room.camera,
                                 {.width = options.width,
                                  .height = options.height,
                                  .samples = n,
                                  .seed = options.seed,
                                  .threads = options.threads,
                                  .progress = bar});
        shots.seconds.push_back(std::max(examples::processor_seconds() - before, 1e-6));
        save_png(seen.image, options.path("fig-12-" + std::to_string(n) + ".png"));
    }
    return shots;
}

// --- Errors --------------------------------------------------------------------------

/// What a number of rays brought, over several seeds.
struct Rung {
    int rays = 0;          ///< A pixel.
    double seconds = 0;    ///< Processor time of both passes, the mean.
    BiasVariance pixels{}; ///< The two parts of relMSE.
    BiasVariance blocks{}; ///< The same of the means of 10 x 10 pixels.
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
        rung.pixels = examples::relative_split(runs, oracle.truth, oracle.noise);
        rung.blocks =
            examples::relative_split(runs, oracle.truth, oracle.block_noise, 10);
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

/// The plots and tables of errors.
void show(const std::vector<Method>& methods,
          const std::vector<std::vector<Rung>>& runs,
          const examples::Options& options) {
    examples::Plot plot{.name = "rays_per_pixel-trade",
                        .columns = {"processor seconds"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    for (const Method& method : methods) plot.columns.push_back(method.name);
    examples::Table slopes{.name = "rays_per_pixel-slopes",
                           .columns = {"", "slope of the rays' noise", "bias²",
                                       "noise of the photons", "bias² of blocks"}};
    examples::Table split{.name = "rays_per_pixel-split",
                          .columns = {"rays", "", "bias²", "noise", "of which rays",
                                      "blocks: bias²", "noise", "trimmed", "FLIP"}};
    examples::Table half{.name = "rays_per_pixel-half", .columns = {"rays"}};
    for (std::size_t m = 0; m < methods.size(); ++m) {
        std::vector<double> rays, seconds, noise, errors;
        for (const Rung& rung : runs[m]) {
            rays.push_back(rung.rays);
            seconds.push_back(rung.seconds);
            noise.push_back(rung.rays_alone);
            errors.push_back(rung.error());
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
        const Rung& last = runs[m].back();
        slopes.rows.push_back(
            {methods[m].name, slope_text(rays, noise),
             text(last.pixels.bias_squared, "%.2g"),
             methods[m].has_map ? text(last.pixels.variance - last.rays_alone, "%.2g")
                                : "none",
             text(last.blocks.bias_squared, "%.2g")});
        half.columns.push_back(methods[m].name);
        half.rows.resize(errors.size());
        for (std::size_t i = 0; i < errors.size(); ++i) {
            const double before = error_at(seconds, errors, seconds[i] / 2);
            half.rows[i].resize(methods.size() + 1);
            half.rows[i][0] = text(rays[i]);
            half.rows[i][m + 1] = std::isnan(before)
                                      ? "no picture yet"
                                      : text(before / errors[i], "%.2f") + " times";
        }
    }
    half.rows.erase(half.rows.begin());
    save_plot(options.path(""), plot);
    save_table(options.path(""), slopes);
    save_table(options.path(""), split);
    save_table(options.path(""), half);
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
            std::vector<double> rays, seconds, errors;
            for (const Rung& rung : rungs) {
                rays.push_back(rung.rays);
                seconds.push_back(rung.seconds);
                errors.push_back(rung.error());
            }
            const double when = examples::reach(seconds, errors, target);
            row.push_back(
                std::isnan(when)
                    ? "not by " + text(rays.back()) + " rays (" +
                          text(errors.back(), "%.2g") + ")"
                    : text(when, "%.2g") + " s, " +
                          text(examples::reach(rays, errors, target), "%.3g") +
                          " rays");
        }
        table.rows.push_back(row);
    }
    save_table(options.path(""), table);
}

} // namespace

/// Makes the tables and figures of chapter 33.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 33, rays per pixel: table 3, figure 12.");
        line.add("--most", sizes.most, "The largest number of rays", 10, 1000);
        line.add("--seeds", sizes.seeds, "Runs behind each error", 2, 1000);
        line.add("--truth", sizes.truth, "Rays a pixel of the reference", 8, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (!line.given("--most")) sizes.most = options.pick(100, 1000, 1000);
        if (!line.given("--seeds")) sizes.seeds = options.pick(3, 6, 16);
        if (!line.given("--truth")) sizes.truth = options.pick(512, 32768, 262144);
        const int size = std::min(options.pick(24, 64, 100), options.width);

        const auto room = all_materials_room();
        one_pixel(room, options);
        // Errors may stop before the pictures do: several seeds of 1000 rays take long.
        std::vector<int> rays, shown;
        for (const int n : {1, 3, 10, 30, 100, 300, 1000})
            if (n <= sizes.most) rays.push_back(n);
        for (const ReportRow& row : report_rows)
            if (row.rays <= sizes.most || !line.given("--most"))
                shown.push_back(row.rays);
        const Shots shots = figure_12(room, shown, options);

        const auto oracle =
            examples::find_oracle("all-materials", room, size, sizes.truth, options);
        const auto tracer = make_path_tracer(room.scene);
        const auto picture = [&](int n, std::uint64_t seed) {
            return RenderSettings{.width = size,
                                  .height = size,
                                  .samples = n,
                                  .seed = seed,
                                  .threads = options.threads};
        };
        // Made once a seed: neither depth nor rays change the map.
        std::map<std::uint64_t, PhotonMapsT<float>> kept;
        const auto by_photons = [&](bool fixed_depth) {
            return [&, fixed_depth](int n, std::uint64_t seed, std::uint64_t map_seed) {
                const auto settings =
                    settings_with(fixed_depth, map_seed, options.threads);
                const auto [place, fresh] = kept.try_emplace(map_seed);
                if (fresh) place->second = make_photon_maps(room.scene, settings);
                const auto mapper =
                    make_photon_mapper(room.scene, place->second, settings);
                return render(mapper, room.camera, picture(n, seed)).image;
            };
        };
        for (int seed = 1; seed <= sizes.seeds; ++seed) // before any clock runs
            (void)by_photons(true)(1, 1, std::uint64_t(seed));
        const std::vector<Method> methods{
            {"photons to depth 4", by_photons(true), true},
            {"photons with roulette", by_photons(false), true},
            {"path tracing", [&](int n, std::uint64_t seed, std::uint64_t) {
                 return render(tracer, room.camera, picture(n, seed)).image;
             }}};
        std::vector<std::vector<Rung>> runs;
        for (const Method& method : methods)
            runs.push_back(climb(method, rays, oracle, sizes.seeds, shots.first));
        show(methods, runs, options);
        equal_error(methods, runs, options);

        examples::Table table{.name = "table-3",
                              .columns = {"rays", "report", "photons, s", "picture, s",
                                          "relMSE, depth 4", "relMSE, roulette",
                                          "of blocks, depth 4", "of blocks, roulette",
                                          "FLIP, roulette"}};
        for (std::size_t i = 0; i < shown.size(); ++i) {
            table.rows.push_back({std::to_string(shown[i]), report_rows[i].time,
                                  text(shots.first, "%.2f"),
                                  text(shots.seconds[i], "%.3g")});
            auto& row = table.rows.back();
            row.resize(table.columns.size());
            const auto at = std::find(rays.begin(), rays.end(), shown[i]);
            if (at == rays.end()) continue;
            const auto rung_number = static_cast<std::size_t>(at - rays.begin());
            for (const std::size_t m : {0u, 1u}) {
                const Rung& rung = runs[m][rung_number];
                row[4 + m] = text(rung.error(), "%.2g");
                row[6 + m] =
                    text(std::max(rung.blocks.bias_squared + rung.blocks.variance, 0.0),
                         "%.2g");
            }
            row[8] = text(runs[1][rung_number].flip, "%.3f");
        }
        save_table(options.path(""), table);
        examples::Table truth{
            .name = "rays_per_pixel-truth",
            .columns = {"reference", "rays a pixel", "its own relMSE", "of blocks"},
            .rows = {{"path tracing, no limit of depth", std::to_string(oracle.rays),
                      text(oracle.noise, "%.2g"), text(oracle.block_noise, "%.2g")}}};
        save_table(options.path(""), truth);
        if (!options.quiet)
            for (const auto& row : table.rows) {
                for (const auto& cell : row) std::printf("%-12s ", cell.c_str());
                std::printf("\n");
            }
    });
}
