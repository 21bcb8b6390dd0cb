// figures: fig-13
// smoke: --quality draft --width 16 --height 16 --rays 1
/// \file 35_recursion_depth.cpp
/// \brief Chapter 35, figure 13: one room with deeper and deeper paths.

#include <string>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders the report's room with paths that end at some depth, and by roulette.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 35, depth: figure 13.");
        const examples::Options options =
            line.parse({.draft{.width = 64, .height = 64, .samples = 8}});

        const auto room = four_glass_room();
        for (const std::string depth : {"1", "2", "3", "4", "8", "roulette"}) {
            PhotonMappingSettings settings;
            if (depth != "roulette") { // roulette begins at the fourth surface
                settings.max_depth = std::stoi(depth);
                settings.roulette_depth = settings.max_depth + 1;
            }
            settings.caustics.photons = 100000;
            settings.caustics.seed = options.seed;
            settings.caustics.threads = options.threads;
            settings.caustics_estimate.radius = 0.05f; // as in the report
            const PhotonMapper mapper(room.world, settings);
            const auto seen = rendered("depth " + depth, mapper, room.camera, options);
            save_png(seen.image, options.path("fig-13-" + depth + ".png"));
        }
    });
}
