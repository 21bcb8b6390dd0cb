// figures: fig-5 fig-6 fig-7
// smoke: --quality draft --photons 500 --width 40 --height 40
/// \file 27_general_map.cpp
/// \brief Figures 5, 6 and 7: indirect, shadow and direct photons, as dots.

#include <cstdio>
#include <string>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Makes general-indirect.png, general-shadow.png and general-direct.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 27, the general map: figures 5, 6 and 7.");
        line.makes({"fig-5", "fig-6", "fig-7"});
        line.add("--photons", photons, "Photons emitted", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 300, .samples = 1}});
        if (!line.given("--photons")) photons = options.pick(15000LL, 30000LL, 60000LL);

        // All three kinds come from one pass. A photon is direct at its first surface
        // and indirect at later ones. Beyond the first surface, its extended first ray
        // leaves shadow photons.
        const auto room = final_room();
        const auto traced = trace_photons(
            room.world, MapType::general,
            {.photons = photons, .seed = options.seed, .threads = options.threads});
        const Image drawing =
            scene_drawing(room.world, room.camera, options.width, options.height);

        const auto draw = [&](const std::string& item, PhotonKind kind,
                              const std::string& name) {
            if (!options.wants(item)) return;
            const auto color = [kind](const Photon& photon) {
                return photon.kind == kind ? dot_color(photon) : Rgb{0};
            };
            Image image = drawing;
            const long long seen =
                add_photon_dots(image, room.world, room.camera, traced.photons,
                                {.radius = 1.2f, .brightness = 0.9f}, color);
            save_png(image, options.path("general-" + name + ".png"));
            if (!options.quiet)
                std::printf("%s: %lld %s photons in sight\n", item.c_str(), seen,
                            name.c_str());
        };
        draw("fig-5", PhotonKind::indirect, "indirect");
        draw("fig-6", PhotonKind::shadow, "shadow");
        draw("fig-7", PhotonKind::direct, "direct");
    });
}
