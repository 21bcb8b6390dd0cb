// figures: fig-1 fig-15
// smoke: --quality draft --width 24 --height 24 --rays 1 --photons 1000
/// \file 28_two_pass.cpp
/// \brief Figures 1 and 15: the report's whole renderer, in two passes.

#include <cstdio>
#include <string>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Renders a room by the report's two passes.
template <typename Scene>
void make_figure(const std::string& name, const Room<Scene>& room,
                 const PhotonMappingSettings& settings,
                 const examples::Options& options) {
    // The first pass: photons are traced, and those that arrive by way of mirrors and
    // glass are stored in the caustics map.
    const examples::StopWatch watch;
    const PhotonMapper mapper(room.world, settings);
    const double first = watch.seconds();

    // The second pass: rays from the camera, which look up the map at each diffuse
    // surface.
    const auto picture = examples::rendered(name, mapper, room.camera, options);
    const double second = watch.seconds() - first;
    save_png(picture.image, options.path(name + ".png"));

    const double rays = double(picture.counts.rays());
    if (!options.quiet)
        std::printf(
            "%s: %zu photons stored in %.2f s; picture in %.2f s, %.1f rays per "
            "camera ray, %.2f million rays/s\n",
            name.c_str(), mapper.maps().caustics.records.size(), first, second,
            rays / double(picture.counts.camera_rays), rays / second / 1e6);
}

} // namespace

/// Makes fig-1.png and fig-15.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        PhotonMappingSettings settings{.caustics_estimate{.radius = 0.1f}};
        line.about("Chapter 28, two passes: figures 1 and 15.");
        line.makes({"fig-1", "fig-15"});
        line.add("--photons", settings.caustics.photons,
                 "Photons aimed at mirrors and glass", 0, 1'000'000'000);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 16},
                        .report{.width = 400, .height = 400, .samples = 256},
                        .reference{.width = 500, .height = 500, .samples = 800}});
        settings.caustics.seed = options.seed;
        settings.caustics.threads = options.threads;

        if (options.wants("fig-1"))
            make_figure("fig-1", final_room(), settings, options);
        if (options.wants("fig-15"))
            make_figure("fig-15", all_materials_room(), settings, options);
    });
}
