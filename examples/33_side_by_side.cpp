// smoke: --quality draft --width 16 --height 16
/// \file 33_side_by_side.cpp
/// \brief Chapter 33: one room by six renderers, in about the same time.

#include <cstdio>
#include <string>

#include <ljus/ljus.hpp>
#include <ljus/radiosity/light_map.hpp>
#include <ljus/radiosity/radiosity.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Makes the six pictures side_by_side-matt-time-*.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 33, side by side: one room by all renderers.");
        const examples::Options options =
            line.parse({.draft{.width = 40, .height = 40, .samples = 1}});
        const auto room = matt_cornell_box();
        const std::uint64_t seed = options.seed + 77;
        const int threads = options.threads;

        // Rays per pixel, photons and patches are chosen so that a picture of 100 x 100
        // pixels took a processor second in the chapter's experiments.
        const auto save = [&](const std::string& name, const auto& renderer, int rays) {
            const examples::StopWatch watch;
            const auto picture = examples::rendered(name, renderer, room.camera,
                                                    {.width = options.width,
                                                     .height = options.height,
                                                     .samples = rays,
                                                     .seed = seed},
                                                    options);
            save_png(picture.image,
                     options.path("side_by_side-matt-time-" + name + ".png"));
            if (!options.quiet)
                std::printf("%-12s %3d rays per pixel, %5.1f million rays, %.2f s\n",
                            name.c_str(), rays, double(picture.counts.rays()) * 1e-6,
                            watch.seconds());
        };
        save("whitted", WhittedTracer(room.world), 259);
        save("distributed", DistributedTracer(room.world), 252);
        save("paths", PathTracer(room.world), 82);

        // Radiosity solves for all patches at once; rendering only looks them up.
        const auto solved = make_radiosity(
            room.world,
            {.patches{.size = 0.097},
             .factors{
                 .analytic = false, .rays = 512, .seed = seed, .threads = threads}});
        save("radiosity", LightMapView(room.world, solved->map), 17);

        // Two passes: one gather ray leaves each diffuse surface, and its end is looked
        // up in the photon map.
        PhotonMappingSettings settings{.indirect = IndirectLight::map,
                                       .general{.photons = 16516,
                                                .seed = seed,
                                                .shadow_photons = false,
                                                .threads = threads},
                                       .general_estimate{.radius = 0.27913f}};
        save("photons", PhotonMapper(room.world, settings), 33);

        // The photon map is seen directly, with more photons in smaller discs.
        settings.shadow_rays = 4;
        settings.indirect = IndirectLight::photons;
        settings.general.photons = 239788;
        settings.general_estimate.radius = 0.17692f;
        save("seen", PhotonMapper(room.world, settings), 15);
    });
}
