// figures: table-1
// smoke: --quality draft --width 8 --height 8
/// \file 34_parallel.cpp
/// \brief Chapter 34, table 1: the report's room, rendered by one thread and by all
/// threads.

#include <algorithm>
#include <string>
#include <thread>
#include <vector>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/oracle.hpp"

using namespace ljus;
using examples::text;

namespace {

/// A row of the report's table 1, in seconds.
struct ReportRow {
    int rays;       ///< Rays per pixel.
    double one;     ///< "Unparallelized rendering time".
    double four;    ///< "Parallelized rendering time", on four cores.
    double printed; ///< The quotient of both, as printed.
};

double median(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

} // namespace

/// Measures the time of pictures with one thread and with all threads.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 34, many threads: table 1.");
        const examples::Options options =
            line.parse({.draft{.width = 48, .height = 48}});
        const int processors = int(std::thread::hardware_concurrency());
        const int threads =
            std::max(2, options.threads > 0 ? options.threads : processors);

        // As in the report: paths end at the fourth surface, and never by roulette.
        PhotonMappingSettings settings{.max_depth = 4, .roulette_depth = 5};
        settings.caustics.photons = 100000;
        settings.caustics_estimate.radius = 0.05f;
        const auto room = four_glass_room();
        const PhotonMapper mapper(room.world, settings);

        // The second pass: wall-clock seconds, and processor seconds.
        const auto shot = [&](int rays, int by) {
            RenderSettings picture = picture_settings(options);
            picture.samples = rays;
            picture.threads = by;
            return examples::timed([&] {
                (void)rendered("table-1", mapper, room.camera, picture, options);
            });
        };
        (void)shot(1, threads); // starts the threads before any clock runs

        const auto oracle = find_oracle(
            "four-glass", room, std::min(options.pick(20, 64, 100), options.width),
            options.pick(512, 32768, 262144), options);
        const auto error_of = [&](int rays) {
            const RenderSettings picture{.width = oracle.truth.width,
                                         .height = oracle.truth.height,
                                         .samples = rays,
                                         .seed = options.seed};
            const auto seen = rendered("errors", mapper, room.camera, picture, options);
            return std::max(rel_mse(seen.image, oracle.truth) - oracle.noise, 0.0);
        };

        examples::Table table{.name = "table-1",
                              .columns = {"rays", "report: 1 thread, s", "4 threads, s",
                                          "printed", "is", "1 thread, s",
                                          std::to_string(threads) + " threads, s",
                                          "ratio", "total processor time", "relMSE"}};
        for (const ReportRow& row : {ReportRow{1, 3, 22, 0.14},
                                     {10, 17, 28, 0.61},
                                     {100, 188, 106, 1.79},
                                     {200, 362, 208, 1.75},
                                     {1000, 1391, 640, 2.17}}) {
            if (row.rays > options.pick(100, 1000, 1000)) continue;
            std::vector<double> one, all, ratio, work;
            for (int i = 0; i < options.pick(3, 3, 5); ++i) { // pairs, alternating
                const examples::Timing a = shot(row.rays, 1);
                const examples::Timing b = shot(row.rays, threads);
                one.push_back(a.wall);
                all.push_back(b.wall);
                ratio.push_back(a.wall / b.wall);
                work.push_back(b.work / a.work);
            }
            table.rows.push_back(
                {std::to_string(row.rays), text(row.one), text(row.four),
                 text(row.printed), text(row.one / row.four, "%.2f"),
                 text(median(one), "%.3g"), text(median(all), "%.3g"),
                 text(median(ratio), "%.2f"), text(median(work), "%.2f"),
                 text(error_of(row.rays), "%.2g")});
        }
        save_table(options.out, table);
        if (!options.quiet) print_table(table);
    });
}
