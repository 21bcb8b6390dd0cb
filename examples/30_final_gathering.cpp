// smoke: --quality draft --width 16 --height 16 --rays 4 --photons 2000
/// \file 30_final_gathering.cpp
/// \brief Chapter 30: photons that are seen directly, and by gather rays one bounce
/// away.

#include <algorithm>
#include <string>

#include <ljus/ljus.hpp>
#include <ljus/render/gathering.hpp>
#include <ljus/scenes/cornell_box.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// A renderer that shows what gather rays find, by sending them from the camera.
template <typename Mapper>
struct PointsSeen {
    using Stream = RandomStream; ///< The random stream that render() passes.
    const Mapper& mapper;        ///< A mapper with Gathering.
};
template <typename Mapper>
Rgb radiance(const PointsSeen<Mapper>& seen, const Ray& ray, auto& context) {
    const auto& world = seen.mapper.world();
    const auto& points = seen.mapper.template state<Gathering>().points;
    const auto path = camera_path(world, ray, context.stream);
    return gather_ray(world, points, path, 20, context).radiance;
}

} // namespace

/// Makes the five pictures final-gathering-*.png at the top of the chapter.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 20000;
        line.about("Chapter 30, final gathering: blotches, rays, and a lookup.");
        line.add("--photons", photons, "Photons in either map", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 96, .height = 96, .samples = 16},
                        .report{.width = 448, .height = 448, .samples = 64},
                        .reference{.width = 896, .height = 896, .samples = 256}});

        const auto room = cornell_box();
        PhotonMappingSettings settings{.direct = DirectLight::analytic,
                                       .split_glass = true};
        settings.general.photons = settings.caustics.photons = photons;
        settings.general.seed = settings.caustics.seed = options.seed;
        settings.general.threads = settings.caustics.threads = options.threads;
        settings.general.shadow_photons = false;
        // With 0 the mapper chooses a radius that typically holds 64 photons of the
        // general map, or 32 of the caustics map.
        settings.general_estimate.radius = settings.caustics_estimate.radius = 0;

        const auto save = [&](const std::string& name, const auto& renderer,
                              int samples) {
            RenderSettings picture = examples::picture_settings(options);
            picture.samples = samples;
            save_png(
                examples::rendered(name, renderer, room.camera, picture, options).image,
                options.path("final-gathering-" + name + ".png"));
        };
        const int rays = options.samples;
        settings.indirect = IndirectLight::photons;
        save("photons", PhotonMapper(room.world, settings), rays);

        settings.indirect = IndirectLight::gather;
        const PhotonMapper mapper(room.world, settings, abilities<Gathering>);
        save("gather-1", mapper, 1);
        save("gather-few", mapper, std::max(2, rays / 4));
        save("gather-many", mapper, rays);
        save("points", PointsSeen<decltype(mapper)>{mapper}, std::min(rays, 16));
    });
}
