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
}

} // namespace

/// Makes the table and the plot of chapter 35 on rays per pixel.
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
        Contest contest{.room = room, .options = options, .size = size};
        errors_of_rays(contest, rays, oracle, sizes, first_pass);
    });
}
