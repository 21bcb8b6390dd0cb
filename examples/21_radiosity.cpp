// smoke: --quality draft --width 16 --height 16 --rays 1 --size 6.3
/// \file 21_radiosity.cpp
/// \brief Renders the report's room by radiosity, with patches, form factors and a
/// solution that any camera can use, and by path tracing.

#include <cstdio>

#include <ljus/ljus.hpp>
#include <ljus/radiosity/light_map.hpp>
#include <ljus/radiosity/radiosity.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders radiosity-report.png and radiosity-report-path.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        double size = 0;
        line.about("Chapter 21, radiosity: the report's room.");
        line.add("--size", size, "Largest side of a patch; 0: by quality", 0.0, 10.0);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 16},
                        .reference{.width = 400, .height = 400, .samples = 64}});
        if (size == 0) size = 7 * options.pick(0.2, 0.1, 0.0625);

        // [light and view]
        // The light on all patches, computed once for all cameras.
        const auto room = final_room();
        const auto solved =
            make_radiosity(room.world, {.patches{.size = size},
                                        .factors{.analytic = false, .rays = 2048}});

        // A view only looks up the light.
        const LightMapView view(room.world, solved->map);
        const auto seen = examples::rendered("view", view, room.camera, options);
        // [light and view]
        save_png(seen.image, options.path("radiosity-report.png"));
        if (!options.quiet)
            for (const auto& object : solved->patches.left_out)
                std::printf("without patches: %s\n", object.c_str());

        RenderSettings picture = examples::picture_settings(options);
        picture.samples *= 2;
        const PathTracer tracer(room.world);
        const auto traced =
            examples::rendered("paths", tracer, room.camera, picture, options);
        save_png(traced.image, options.path("radiosity-report-path.png"));
    });
}
