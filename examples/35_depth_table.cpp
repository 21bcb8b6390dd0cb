// figures: table-4
// smoke: --quality draft --width 16 --height 16 --rays 1
/// \file 35_depth_table.cpp
/// \brief Chapter 35, table 4: the cost of deeper paths, and the light that they add.

#include <algorithm>
#include <string>
#include <vector>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/oracle.hpp"

using namespace ljus;
using examples::text;

namespace {

/// The report's settings with another depth; 0: roulette from the fourth surface on.
PhotonMappingSettings settings_with(int depth, std::uint64_t seed, int threads) {
    PhotonMappingSettings settings;
    if (depth > 0) settings.max_depth = depth, settings.roulette_depth = depth + 1;
    settings.caustics.photons = 100000;
    settings.caustics.seed = seed;
    settings.caustics.threads = threads;
    settings.caustics_estimate.radius = 0.05f;
    return settings;
}

/// Pictures of the size of the reference, each with its own photons.
template <typename Room>
std::vector<Image> runs_to_depth(const Room& room, int depth,
                                 const examples::Oracle& oracle,
                                 const examples::Options& options) {
    std::vector<Image> runs;
    for (std::uint64_t seed = 1; seed <= options.pick(2u, 6u, 16u); ++seed) {
        const PhotonMapper mapper(room.world,
                                  settings_with(depth, seed, options.threads));
        const RenderSettings picture{.width = oracle.truth.width,
                                     .height = oracle.truth.height,
                                     .samples = 64,
                                     .seed = seed};
        runs.push_back(rendered("errors", mapper, room.camera, picture, options).image);
    }
    return runs;
}

/// The mean of all channels of all pixels.
template <typename T>
double mean_of(const std::vector<ImageT<T>>& images) {
    double sum = 0, count = 0;
    for (const ImageT<T>& image : images)
        for (const RgbT<T>& c : image.pixels)
            sum += double(c.x) + double(c.y) + double(c.z), count += 3;
    return sum / count;
}

} // namespace

/// Measures time and error of the report's room with paths that end at some depth.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 35, depth: table 4.");
        const examples::Options options =
            line.parse({.draft{.width = 64, .height = 64, .samples = 8}});

        const auto room = four_glass_room();
        const auto oracle = find_oracle(
            "four-glass", room, std::min(options.pick(20, 64, 100), options.width),
            options.pick(512, 32768, 262144), options);
        const double all_light = mean_of(std::vector{oracle.truth});

        examples::Table table{.name = "table-4",
                              .columns = {"depth", "report", "picture, s",
                                          "rays per camera ray", "light", "bias²",
                                          "noise", "bias² of blocks"}};
        const std::vector<std::string> report{"", "22 s", "33 s", "44 s", "53 s"};
        for (const int depth : {1, 2, 3, 4, 8, 16, 0}) {
            const PhotonMapper mapper(
                room.world, settings_with(depth, options.seed, options.threads));
            const double start = examples::processor_seconds();
            const auto seen = rendered("picture", mapper, room.camera, options);
            const double seconds = examples::processor_seconds() - start;

            // The error is measured in smaller pictures, by several seeds.
            const auto runs = runs_to_depth(room, depth, oracle, options);
            const auto [pixels, blocks] = errors_against(oracle, runs);
            table.rows.push_back(
                {depth > 0 ? std::to_string(depth) : "roulette",
                 depth <= 4 ? report[std::size_t(depth)] : "", text(seconds, "%.3g"),
                 text(double(seen.counts.rays()) / double(seen.counts.camera_rays),
                      "%.2f"),
                 text(100 * (mean_of(runs) - all_light) / all_light, "%+.2f %%"),
                 text(pixels.bias_squared, "%.2g"), text(pixels.variance, "%.2g"),
                 text(blocks.bias_squared, "%.2g")});
        }
        save_table(options.out, table);
        if (!options.quiet) print_table(table);
    });
}
