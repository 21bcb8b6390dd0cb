// figures: fig-14
// smoke: --quality draft --width 24 --height 24 --rays 1
/// \file 14_oren_nayar.cpp
/// \brief Figure 14: a rough ball by the report's formula with the report's
/// roughnesses, and by EON with roughnesses in its own range.

#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Renders a ball of one material; the lamp stands behind the camera, and there is no
/// other light.
template <typename Material>
void ball(const std::string& name, const Material& material,
          const examples::Options& options) {
    Scene<Shapes<Sphere>, Materials<Material, Lambertian>> scene;
    scene.add(Sphere{.center{0, 0, 0}, .radius = 1}, scene.add(material));
    scene.add(Sphere{.center{-4, 5, 9}, .radius = 1.2f},
              scene.add(Lambertian{.albedo = Rgb{0}}), Rgb{60});
    const World world(std::move(scene));

    const PathTracer tracer(world, {.max_depth = 1});
    const Camera camera =
        look_at({.position{0, 0, 6}, .target{0, 0, 0}, .vfov_degrees = 21});
    const auto picture = examples::rendered(name, tracer, camera, options);
    save_png(picture.image, options.path(name + ".png"));
}

} // namespace

/// Renders fig-14-report-N.png for the report's roughnesses N, in radians, and
/// fig-14-N.png for those of EON, in percent.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 14, rough surfaces: figure 14.");
        const examples::Options options =
            line.parse({.draft{.width = 140, .height = 140, .samples = 9},
                        .report{.width = 400, .height = 400, .samples = 64},
                        .reference{.width = 400, .height = 400, .samples = 1024}});
        for (const int sigma : {0, 1, 10, 100})
            ball("fig-14-report-" + std::to_string(sigma),
                 RoughDiffuse{.albedo = Rgb{0.8f},
                              .sigma = float(sigma),
                              .model = RoughModel::as_printed},
                 options);
        for (const int percent : {0, 20, 40, 70, 100})
            ball("fig-14-" + std::to_string(percent),
                 Eon{.albedo = Rgb{0.8f}, .roughness = 0.01f * float(percent)},
                 options);
    });
}
