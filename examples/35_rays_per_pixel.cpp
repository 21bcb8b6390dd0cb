// figures: fig-12
// smoke: --quality draft --width 8 --height 8
/// \file 35_rays_per_pixel.cpp
/// \brief Chapter 35, figure 12: one room with more and more rays per pixel.

#include <string>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders the report's room with 1 to 1000 rays per pixel.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 35, rays per pixel: figure 12.");
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40}});

        // As in the report: paths end at the fourth surface, and never by roulette.
        PhotonMappingSettings settings{.max_depth = 4, .roulette_depth = 5};
        settings.caustics.photons = 100000;
        settings.caustics.seed = options.seed;
        settings.caustics.threads = options.threads;
        settings.caustics_estimate.radius = 0.05f;

        const auto room = all_materials_room();
        const PhotonMapper mapper(room.world, settings); // traces the photons, once
        for (const int rays : {1, 10, 100, 1000}) {
            const std::string name = "fig-12-" + std::to_string(rays);
            RenderSettings picture = picture_settings(options);
            picture.samples = rays;
            const auto seen = rendered(name, mapper, room.camera, picture, options);
            save_png(seen.image, options.path(name + ".png"));
        }
    });
}
