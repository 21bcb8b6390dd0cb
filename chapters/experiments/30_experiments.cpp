// smoke: --quality draft --width 16 --height 16 --rays 4 --photons 2000 --seeds 2
/// \file chapters/experiments/30_experiments.cpp
/// \brief Chapter 30: estimates at edges; error against time for photons seen directly,
/// gathered, and precomputed.

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <ljus/image/flip.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/convergence.hpp"
#include "common/oracle.hpp"
#include "common/plot.hpp"
#include "experiments/show_table.hpp"

using namespace ljus;

namespace {

/// The options of this program, besides the common ones.
struct Sizes {
    long long photons = 0; ///< The largest number of photons.
    int seeds = 0;         ///< Runs behind each bias and variance.
    int truth = 0;         ///< Rays per pixel of the reference.
};

// --- Where a surface ends ------------------------------------------------------------

using Flat = World<Scene<Shapes<Quad>, Materials<Lambertian>>>;

/// A unit square at z = 0.
Flat unit_square() {
    Scene<Shapes<Quad>, Materials<Lambertian>> scene;
    scene.add(Quad{.corner{0, 0, 0}, .edge_u{1, 0, 0}, .edge_v{0, 1, 0}},
              scene.add(Lambertian{.albedo = Rgb{0.5f}}));
    return Flat(std::move(scene));
}

Vertex square_vertex(const Flat& square, float x, float y) {
    const Ray ray{.origin{x, y, 0.1f}, .direction{0, 0, -1}};
    return vertex_at(square, ray, closest_hit(square, ray).value());
}

/// Indirect photons, evenly on the unit square: 1 W in all, so that E is 1 W/m^2.
PhotonMap even_photons(int count, std::uint64_t seed) {
    auto stream = random_stream(seed, Pass::user, 0, 0);
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i)
        photons.push_back({.position = Vec3(next_2d(stream), 0),
                           .direction{0, 0, -1},
                           .flux = Rgb{1 / float(count)},
                           .kind = PhotonKind::indirect,
                           .normal = small_normal(Vec3{0, 0, 1})});
    return make_photon_map(photons);
}

/// Lets every photon count, for estimate_irradiance().
constexpr auto all_photons = [](std::uint32_t) { return true; };

/// A mean.
struct Mean {
    double count = 0, sum = 0;

    void add(double x) { ++count, sum += x; }
    double mean() const { return sum / count; }
};

constexpr float border_radius = 0.1f; ///< Of the disc that photons are counted in.
constexpr int border_steps = 24;      ///< From the edge to the distance of the radius.

/// The estimates by several maps under an even light.
struct Borders {
    std::vector<Mean> with, without; ///< The correction, step by step from an edge.
};

Borders measure_borders(int maps, std::uint64_t seed) {
    const Flat square = unit_square();
    const Vec3 up{0, 0, 1};
    IrradiancePointSettings corrected{.nearest = 512, .radius = border_radius};
    IrradiancePointSettings plain = corrected;
    plain.edges = false;
    Borders found{.with = std::vector<Mean>(border_steps + 1),
                  .without = std::vector<Mean>(border_steps + 1)};
    for (int m = 0; m < maps; ++m) {
        const PhotonMap map = even_photons(6000, seed + std::uint64_t(m));
        const auto estimate = [&](float x, float y, const auto& how) {
            return double(estimate_irradiance(square, map, square_vertex(square, x, y),
                                              up, how, border_radius, all_photons)
                              .x);
        };
        for (int i = 0; i <= border_steps; ++i)
            for (const float x : {0.2f, 0.4f, 0.6f, 0.8f}) {
                const float y =
                    std::max(1e-4f, 1.2f * border_radius * float(i) / border_steps);
                found.with[std::size_t(i)].add(estimate(x, y, corrected));
                found.without[std::size_t(i)].add(estimate(x, y, plain));
            }
    }
    return found;
}

/// The estimates from an edge inwards, beside the fraction of the kernel that lies
/// inside.
void plot_edge(const Borders& found, const examples::Options& options) {
    examples::Plot plot{
        .name = "final-gathering-edge",
        .columns = {"distance from the edge over the radius", "part of the kernel",
                    "photons as they are", "divided by the part"},
        .y_label = "estimate over the truth",
        .more = "set yrange [0:1.3]\nset key inside bottom right vertical\n"};
    for (int i = 0; i <= border_steps; ++i) {
        const double s = 1.2 * double(i) / border_steps;
        const auto k = std::size_t(i);
        plot.rows.push_back(
            {s, kernel_part(s), found.without[k].mean(), found.with[k].mean()});
    }
    save_plot(options.out, plot);
}

// --- The trade -----------------------------------------------------------------------

/// The settings that all pictures share.
PhotonMappingSettings gather_settings(IndirectLight indirect, long long photons,
                                      std::uint64_t seed,
                                      const examples::Options& options) {
    PhotonMappingSettings settings{
        .direct = DirectLight::analytic, .split_glass = true, .indirect = indirect};
    settings.caustics.photons = photons;
    settings.general.photons = photons;
    settings.general.shadow_photons = false;
    settings.caustics.seed = settings.general.seed = seed;
    settings.caustics.threads = settings.general.threads = options.threads;
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    return settings;
}

/// The pictures of all seeds, and what one of them costs.
struct Runs {
    std::vector<Image> images{};
    std::vector<double> first{}, second{}; ///< Processor seconds of either pass.
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Ways that alternate seed by seed, so that a busy machine affects all of them.
template <typename Room>
std::vector<Runs> compare(const Room& room,
                          const std::vector<PhotonMappingSettings>& ways, int samples,
                          int seeds, const examples::Options& options) {
    std::vector<Runs> runs(ways.size());
    for (int seed = 1; seed <= seeds; ++seed)
        for (std::size_t w = 0; w < ways.size(); ++w) {
            auto settings = ways[w];
            settings.caustics.seed = settings.general.seed = std::uint64_t(seed);
            const double begin = examples::processor_seconds();
            const PhotonMapper mapper(room.world, settings, abilities<Gathering>);
            const double middle = examples::processor_seconds();
            runs[w].images.push_back(render(mapper, room.camera,
                                            {.width = options.width,
                                             .height = options.height,
                                             .samples = samples,
                                             .seed = std::uint64_t(seed),
                                             .threads = options.threads})
                                         .image);
            runs[w].first.push_back(middle - begin);
            runs[w].second.push_back(examples::processor_seconds() - middle);
            examples::stop_if_asked();
        }
    return runs;
}

constexpr std::array way_names{"photons", "map", "gather"};
constexpr std::array way_kinds{IndirectLight::photons, IndirectLight::map,
                               IndirectLight::gather};

/// The result of one way to gather, for some number of photons and of rays.
struct Setting {
    std::size_t way;       ///< 0: photons, 1: map, 2: gather.
    double seconds, error; ///< Processor seconds, relMSE.
};

/// Plot: for each way the settings that no faster one of the same way beats, or comes
/// near.
void plot_frontier(std::vector<Setting> tried, const examples::Options& options) {
    std::sort(tried.begin(), tried.end(),
              [](const Setting& a, const Setting& b) { return a.seconds < b.seconds; });
    examples::Plot plot{.name = "final-gathering-trade",
                        .columns = {"processor seconds", "photons", "map", "gather"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    std::array best{1e300, 1e300, 1e300};
    for (const Setting& setting : tried) {
        if (setting.error > 0.95 * best[setting.way]) continue;
        best[setting.way] = setting.error;
        examples::Row row{setting.seconds, std::nan(""), std::nan(""), std::nan("")};
        row[setting.way + 1] = setting.error;
        plot.rows.push_back(row);
    }
    save_plot(options.out, plot);
}

/// All settings that were tried, as the plot and the table show them.
struct Trade {
    examples::Table table{.name = "final-gathering-table",
                          .columns = {"photons", "rays per pixel", "way",
                                      "first pass, s", "second pass, s", "relMSE",
                                      "squared bias", "variance", "FLIP"}};
    std::vector<Setting> tried{};
};

/// Adds the result of one way with some photons and rays.
void add_way(Trade& trade, std::size_t way, long long photons, int samples,
             const Runs& runs, const examples::Oracle& oracle) {
    const auto split =
        examples::relative_split(runs.images, oracle.truth, oracle.noise);
    double seen = 0;
    for (const Image& image : runs.images)
        seen += flip(image, oracle.truth) / double(runs.images.size());
    const double first = median(runs.first), second = median(runs.second);
    const double error = split.bias_squared + split.variance;
    trade.tried.push_back({way, first + second, error});
    trade.table.rows.push_back(
        {std::to_string(photons), std::to_string(samples), way_names[way],
         examples::text(first, "%.2f"), examples::text(second, "%.2f"),
         examples::text(error, "%.2g"), examples::text(split.bias_squared, "%.2g"),
         examples::text(split.variance, "%.2g"), examples::text(seen, "%.3f")});
}

/// Tries the three ways with each number of photons and of rays.
template <typename Room>
Trade try_settings(const Room& room, const examples::Oracle& oracle,
                   const examples::Options& options, const Sizes& sizes) {
    Trade trade;
    for (const long long part : {100, 32, 10, 3, 1})
        for (int samples = 1; samples <= options.samples; samples *= 4) {
            const long long photons = std::max(1000LL, sizes.photons / part);
            std::vector<PhotonMappingSettings> ways;
            for (const IndirectLight kind : way_kinds)
                ways.push_back(gather_settings(kind, photons, 1, options));
            const auto runs = compare(room, ways, samples, sizes.seeds, options);
            for (std::size_t w = 0; w < ways.size(); ++w)
                add_way(trade, w, photons, samples, runs[w], oracle);
        }
    return trade;
}

/// Error against time: three ways, photons and rays.
void trade(const examples::Options& options, const Sizes& sizes) {
    const auto room = matt_cornell_box();
    const auto oracle = examples::find_oracle("matt-cornell", room, options.width,
                                              sizes.truth, options);
    const Trade found = try_settings(room, oracle, options, sizes);
    plot_frontier(found.tried, options);
    examples::show_table(options, found.table);
}

/// Processor seconds in which the points of precomputed irradiance are made.
template <typename Room>
double seconds_of_points(const Room& room, const PhotonMappingSettings& gather,
                         int threads) {
    const PhotonMapper mapper(room.world, gather, abilities<Gathering>);
    const double begin = examples::processor_seconds();
    (void)make_irradiance_points(room.world, mapper.maps().general,
                                 mapper.maps().caustics, gather.irradiance, 1, threads);
    return examples::processor_seconds() - begin;
}

/// What a lookup saves: the general map and precomputed irradiance at equal settings.
template <typename Room>
void table_of_ratios(const Room& room, const examples::Oracle& oracle,
                     const examples::Options& options, const Sizes& sizes) {
    const int rays = options.pick(16, 100, 100);
    const int seeds = std::min(sizes.seeds, options.pick(2, 3, 16));
    examples::Table table{.name = "final-gathering-ratio",
                          .columns = {"photons per estimate", "map, s", "gather, s",
                                      "ratio", "points, s", "share of the time saved",
                                      "relMSE: map", "gather"}};
    for (const std::size_t k : {0u, 32u, 64u, 128u, 256u}) {
        auto map = gather_settings(IndirectLight::map, sizes.photons, 1, options);
        if (k > 0) map.general_estimate = {.radius = 1, .nearest = k};
        auto gather = map;
        gather.indirect = IndirectLight::gather;
        gather.irradiance.nearest = k > 0 ? k : 64;
        const auto runs = compare(room, {map, gather}, rays, seeds, options);
        const double slow = median(runs[0].second), fast = median(runs[1].second);
        const double extra = seconds_of_points(room, gather, options.threads);
        const auto error = [&](const Runs& r) {
            const auto split =
                examples::relative_split(r.images, oracle.truth, oracle.noise);
            return examples::text(split.bias_squared + split.variance, "%.2g");
        };
        table.rows.push_back(
            {k > 0 ? "the nearest " + std::to_string(k) : "64 typically",
             examples::text(slow, "%.2f"), examples::text(fast, "%.2f"),
             examples::text(slow / fast, "%.1f"), examples::text(extra, "%.2f"),
             examples::text(100 * extra / (slow - fast), "%.0f %%"), error(runs[0]),
             error(runs[1])});
    }
    examples::show_table(options, table);
}

/// What precomputed irradiance saves.
void ratio(const examples::Options& options, const Sizes& sizes) {
    const auto room = matt_cornell_box();
    const auto oracle = examples::find_oracle("matt-cornell", room, options.width,
                                              sizes.truth, options);
    table_of_ratios(room, oracle, options, sizes);
}

} // namespace

/// Makes the plots and tables of chapter 30.
/// \param argc  Number of arguments.
/// \param argv  The command line; `--help` explains it.
/// \return 0; after an exception 2, with one sentence on stderr.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        Sizes sizes;
        line.about("Chapter 30, final gathering: the experiments behind its tables.");
        line.add("--photons", sizes.photons, "The largest number of photons", 1,
                 100000000);
        line.add("--seeds", sizes.seeds, "Runs behind bias and variance", 2, 1000);
        line.add("--truth", sizes.truth, "Rays per pixel of the reference", 8, 1000000);
        const examples::Options options =
            line.parse({.draft{.width = 32, .height = 32, .samples = 16},
                        .report{.width = 64, .height = 64, .samples = 64},
                        .reference{.width = 128, .height = 128, .samples = 256}});
        if (!line.given("--photons"))
            sizes.photons = options.pick(20000LL, 200000LL, 1000000LL);
        if (!line.given("--seeds")) sizes.seeds = options.pick(4, 16, 64);
        if (!line.given("--truth")) sizes.truth = options.pick(512, 4096, 65536);
        plot_edge(measure_borders(options.pick(32, 128, 512), options.seed), options);
        trade(options, sizes);
        ratio(options, sizes);
    });
}
