// figures: fig-2
// smoke: --quality draft --width 16 --height 16 --rays 1 --photons 2000
/// \file 04_light_transport.cpp
/// \brief Figure 2: a room in direct light alone, in all of its light, and their
/// difference.

#include <cstdio>

#include <ljus/ljus.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// The mean over pixels and channels.
double mean_radiance(const Image& image) {
    double sum = 0;
    for (const Rgb& c : image.pixels) sum += double(c.x + c.y + c.z) / 3;
    return sum / double(image.pixels.size());
}

} // namespace

/// Renders the three pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 4, light transport: figure 2.");
        line.add("--photons", photons, "Caustic photons; 0: by the quality", 0,
                 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        if (photons == 0) photons = options.pick(30000LL, 1000000LL, 10000000LL);

        const auto room = cornell_box();
        const PhotonMapper mapper(
            room.world,
            {.caustics{.photons = photons},
             .caustics_estimate{.radius = options.pick(0.1f, 0.02f, 0.007f)}});
        const auto picture = [&](const char* name, const auto& renderer) {
            return examples::rendered(name, renderer, room.camera, options).image;
        };
        // [figure 2]
        const Image all = picture("all light", mapper);
        const Image direct = picture("direct light", OnlyPaths(mapper, "ES*D?L"));
        Image indirect = all;
        for (std::size_t i = 0; i < all.pixels.size(); ++i)
            indirect.pixels[i] -= direct.pixels[i];
        // [figure 2]
        save_png(direct, options.path("fig-2-direct.png"));
        save_png(all, options.path("fig-2-global.png"));
        save_png(indirect, options.path("fig-2-difference.png"));
        std::printf("%.0f %% of the light is indirect.\n",
                    100 * mean_radiance(indirect) / mean_radiance(all));
    });
}
