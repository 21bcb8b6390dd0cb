// smoke: --quality draft --photons 1000 --width 24 --height 24
/// \file 27_shadow_photons.cpp
/// \brief Chapter 27: the verdict of photons on each lamp in every pixel, by three
/// rules.

#include <string>

#include <ljus/inspect/photon_dots.hpp>
#include <ljus/ljus.hpp>
#include <ljus/render/skipping.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Whether any point of a lamp faces a surface.
template <AnyWorld W>
bool faces(const W& world, const Vertex& vertex, std::uint32_t lamp) {
    for (const Vec2 u :
         {Vec2{0.1f, 0.1f}, Vec2{0.9f, 0.1f}, Vec2{0.1f, 0.9f}, Vec2{0.9f, 0.9f}}) {
        const auto sampled = sample_light(world, lamp, vertex.point.position, u);
        if (sampled && to_local(vertex.frame, sampled->wi).z * vertex.wo.z > 0)
            return true;
    }
    return false;
}

/// A picture of the verdict on a lamp: yellow where it is lit, blue in shadow, red
/// where a ray must decide. Where no ray is needed the drawing of the room is shown.
template <typename Mapper>
Image verdict_map(const Mapper& mapper, const Camera& camera, std::uint32_t lamp,
                  const examples::Options& options) {
    const auto& world = mapper.world();
    const int width = options.width, height = options.height;
    Image image = scene_drawing(world, camera, width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Ray ray = primary_ray(camera, Vec2{float(x) + 0.5f, float(y) + 0.5f},
                                        width, height);
            const auto hit = closest_hit(world, ray);
            if (!hit) continue;
            const Vertex vertex = vertex_at(world, ray, *hit);
            const bool matt = visit_material_at(world, vertex, [](const auto& m) {
                return has(lobes(m), Lobes::non_specular);
            });
            if (!matt || vertex.emits() || !faces(world, vertex, lamp)) continue;
            const Verdict verdict = verdicts_of(mapper, vertex)(lamp);
            const Rgb color = verdict == Verdict::lit      ? Rgb{0.85f, 0.6f, 0.1f}
                              : verdict == Verdict::shadow ? Rgb{0.02f, 0.07f, 0.35f}
                                                           : Rgb{0.55f, 0.02f, 0.02f};
            pixel(image, x, y) = color * (0.35f + 0.65f * std::abs(vertex.wo.z));
        }
    return image;
}

} // namespace

/// Makes shadow-verdicts-R-L.png for each rule R and each lamp L.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 100000;
        line.about("Chapter 27, shadow photons: what they know of each lamp.");
        line.add("--photons", photons, "Photons emitted", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 1}});

        const auto room = final_room();
        for (const SkipRule rule :
             {SkipRule::report, SkipRule::any, SkipRule::enough}) {
            PhotonMappingSettings settings;
            settings.caustics.photons = 0; // verdicts do not use them
            settings.general = {
                .photons = photons, .seed = options.seed, .threads = options.threads};
            settings.skip.rule = rule;
            // A picture by this mapper, render(mapper, ...), casts shadow rays only
            // where the verdict is unknown.
            const PhotonMapper mapper(room.world, settings, abilities<Skipping>);
            for (const std::uint32_t lamp : {0u, 1u})
                save_png(verdict_map(mapper, room.camera, lamp, options),
                         options.path("shadow-verdicts-" + std::to_string(int(rule)) +
                                      "-" + std::to_string(lamp) + ".png"));
        }
    });
}
