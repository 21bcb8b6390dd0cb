// smoke: --quality draft --width 24 --height 24 --rays 1 --photons 1000
/// \file chapters/experiments/28_experiments.cpp
/// \brief Chapter 28: figure 1 taken apart, and error against time for photons and
/// paths.

#include <limits>
#include <string>
#include <string_view>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "common/rendered.hpp"
#include "experiments/show_table.hpp"

namespace {

using examples::rendered;
using ljus::Image;
using ljus::PhotonMappingSettings;
using ljus::RenderSettings;

/// Figure 1 taken apart: the three parts whose sum it is.
template <typename Scene>
void parts(const ljus::Room<Scene>& room, const PhotonMappingSettings& settings,
           const examples::Options& options) {
    const ljus::PhotonMapper mapper(room.world, settings);
    const RenderSettings picture{options.width, options.height, options.samples,
                                 options.seed};
    // [parts]
    const auto save = [&](std::string_view paths, const char* name) {
        const ljus::OnlyPaths one(mapper, paths);
        const auto result = rendered(name, one, room.camera, picture, options);
        save_png(result.image, options.path(std::string(name) + ".png"));
    };
    save("ES*D?L", "fig-1-direct");       // lamps, and direct light
    save("ES*DS+L", "fig-1-caustics");    // the caustics map
    save("E.*D.*D.*L", "fig-1-indirect"); // all longer paths
    // [parts]
}

/// The trade: error against time for the photon mapper and the path tracer.
template <typename Scene>
void trade(const ljus::Room<Scene>& room, const PhotonMappingSettings& settings,
           const examples::Options& options) {
    const int size = options.pick(24, 80, 120);
    const int most = options.pick(16, 256, 1024);
    const ljus::PathTracer tracer(room.world);
    // Another seed, and sixteen times the rays of the best row.
    const Image truth =
        rendered("reference", tracer, room.camera,
                 {.width = size, .height = size, .samples = 16 * most, .seed = 77},
                 options)
            .image;

    examples::Plot plot{.name = "two_pass-trade",
                        .columns = {"seconds", "photon mapping", "path tracing",
                                    "photon mapping (blocks)", "path tracing (blocks)"},
                        .y_label = "relMSE",
                        .log_x = true,
                        .log_y = true};
    examples::Table table{.name = "two_pass-trade-table",
                          .columns = {"rays per pixel", "method", "seconds", "relMSE",
                                      "10x10-block error", "99 % trimmed relMSE"}};
    const double empty = std::numeric_limits<double>::quiet_NaN();
    const auto row = [&](int rays, const char* method, double seconds,
                         const Image& image) {
        const double error = ljus::rel_mse(image, truth);
        const double blocks = ljus::block_error(image, truth);
        const bool photons = std::string(method) == "photon mapping";
        plot.rows.push_back({seconds, photons ? error : empty, photons ? empty : error,
                             photons ? blocks : empty, photons ? empty : blocks});
        table.rows.push_back(
            {std::to_string(rays), method, examples::text(seconds, "%.3g"),
             examples::text(error, "%.2g"), examples::text(blocks, "%.2g"),
             examples::text(ljus::trimmed_rel_mse(image, truth), "%.2g")});
    };
    // The first pass is the same for each row, and timed once: a curve never runs back.
    examples::StopWatch watch;
    const ljus::PhotonMapper mapper(room.world, settings);
    const double first_pass = watch.seconds();
    for (int rays = 1; rays <= most; rays *= 4) {
        const RenderSettings picture{size, size, rays, options.seed};
        watch.restart();
        const auto by_photons =
            rendered("photon mapping", mapper, room.camera, picture, options);
        const double seconds = watch.seconds();
        const auto by_paths =
            rendered("path tracing", tracer, room.camera, picture, options);
        row(rays, "photon mapping", first_pass + seconds, by_photons.image);
        row(rays, "path tracing", watch.seconds() - seconds, by_paths.image);
    }
    save_plot(options.out, plot);
    examples::show_table(options, table);
}

} // namespace

/// Makes the pictures, the plot and the table of chapter 28 that are not the report's.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        PhotonMappingSettings settings{.caustics_estimate{.radius = 0.1f}};
        line.about("Chapter 28, two passes: the experiments behind plot and table.");
        line.add("--photons", settings.caustics.photons,
                 "Photons aimed at mirrors and glass", 0, 1'000'000'000);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 16},
                        .report{.width = 400, .height = 400, .samples = 256},
                        .reference{.width = 500, .height = 500, .samples = 800}});
        settings.caustics.seed = options.seed;
        settings.caustics.threads = options.threads;
        const auto room = ljus::final_room();
        parts(room, settings, options);
        trade(room, settings, options);
    });
}
