// smoke: --quality draft --width 24 --height 24
/// \file 31_irradiance_cache.cpp
/// \brief Chapter 31: indirect light that is gathered in every pixel, or at few points
/// and interpolated.

#include <algorithm>
#include <string>
#include <vector>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>
#include <ljus/path/light_transport.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Makes irradiance_cache-everywhere.png, -interpolated.png and -points.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 31, the irradiance cache: what it holds, what it gives.");
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 4},
                        .report{.width = 400, .height = 400, .samples = 4},
                        .reference{.width = 400, .height = 400, .samples = 4}});
        RenderSettings picture = examples::picture_settings(options);
        picture.samples = 4;

        const auto room = cornell_box();
        auto settings = preset_settings(Preset::fast, options.width, options.width);
        settings.gather.rays = 100;
        settings.general.seed = settings.caustics.seed = options.seed;
        settings.general.threads = settings.caustics.threads = options.threads;
        PhotonMapper mapper(room.world, settings,
                            abilities<StratifiedStream, Gathering>);

        // Only light that has been reflected by two or more diffuse surfaces.
        const auto save_indirect = [&](const std::string& name) {
            const OnlyPaths indirect(mapper, "E.*D.*D.*L");
            save_png(
                examples::rendered(name, indirect, room.camera, picture, options).image,
                options.path("irradiance_cache-" + name + ".png"), {.exposure = 2});
        };
        save_indirect("everywhere"); // gathers in every pixel
        mapper.fill_cache(room.camera, picture);
        save_indirect("interpolated");

        // The points are drawn as dots, as if they were photons on the visible side.
        const IrradianceCache& cache = mapper.state<Gathering>().cache;
        std::vector<Photon> points;
        for (std::size_t i = 0; i < cache.records.size(); ++i)
            points.push_back({.position = cache.tree.point(i),
                              .direction = -cache.records[i].normal,
                              .flux = cache.records[i].irradiance});
        Image drawing =
            scene_drawing(room.world, room.camera, options.width, options.height);
        const float radius = std::max(0.8f, float(options.width) / 250);
        const auto color = [](const Photon& point) { return dot_color(point); };
        add_photon_dots(drawing, room.world, room.camera, points,
                        {.radius = radius, .brightness = 1}, color);
        save_png(drawing, options.path("irradiance_cache-points.png"));
    });
}
