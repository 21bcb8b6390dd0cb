// smoke: --quality draft --photons 500 --width 40 --height 40
/// \file 22_photon_emission.cpp
/// \brief Chapter 22: shows where photons land, directly from the lamps and after they
/// have met a surface.

#include <cstdio>
#include <string>
#include <vector>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Draws the photons that the camera can see, as dots in the colour of their flux.
template <typename Scene>
void add_dots(Image& image, const Room<Scene>& room,
              const std::vector<Photon>& photons) {
    const Vec3 eye = room.camera.position;
    for (const Photon& photon : photons) {
        const auto at =
            project(room.camera, photon.position, image.width, image.height);
        if (!at || at->x < 0 || at->y < 0 || at->x >= float(image.width) ||
            at->y >= float(image.height))
            continue;
        // Objects in front of the photon hide it.
        const Ray ray{
            .origin = eye, .direction = photon.position - eye, .t_max = 0.999f};
        if (!occluded(room.world, ray))
            pixel(image, int(at->x), int(at->y)) +=
                0.8f / max_component(photon.flux) * photon.flux;
    }
}

} // namespace

/// Makes emission-direct.png and emission-indirect.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long count = 0;
        line.about("Chapter 22, photons: where they land.");
        line.add("--photons", count, "Photons emitted", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 1}});
        if (!line.given("--photons")) count = options.pick(20000LL, 60000LL, 200000LL);

        const auto room = final_room();
        const auto traced = trace_photons(
            room.world, MapType::general,
            {.photons = count, .seed = options.seed, .shadow_photons = false});
        for (const PhotonKind kind : {PhotonKind::direct, PhotonKind::indirect}) {
            std::vector<Photon> photons;
            double flux = 0; // the green channel, as a fraction of the lamps' flux
            for (const Photon& photon : traced.photons)
                if (photon.kind == kind) {
                    photons.push_back(photon);
                    flux += double(photon.flux.y) / traced.audit.emitted.y;
                }
            Image image =
                scene_drawing(room.world, room.camera, options.width, options.height);
            add_dots(image, room, photons);
            const std::string name = kind == PhotonKind::direct ? "direct" : "indirect";
            save_png(image, options.path("emission-" + name + ".png"));
            if (!options.quiet)
                std::printf("%zu %s photons, %.3f of the flux of the lamps\n",
                            photons.size(), name.c_str(), flux);
        }
    });
}
