// smoke: --quality draft --width 16 --height 12 --rays 1
/// \file 26_caustic_budget.cpp
/// \brief Chapter 26: two balls of glass and 3000 caustic photons, divided in two ways.

#include <string>
#include <utility>

#include <ljus/ljus.hpp>
#include <ljus/render/budgeting.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders two balls: with half of the photons for each, and with photons in proportion
/// to the area of their caustics.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 26: a budget for the photons of caustics.");
        const examples::Options options =
            line.parse({.draft{.width = 80, .height = 60, .samples = 4},
                        .report{.width = 400, .height = 300, .samples = 16},
                        .reference{.width = 500, .height = 375, .samples = 64}});

        Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>, Lights<PointLight>>
            scene;
        scene.add(Quad{.corner{-3, 0, -3}, .edge_u{0, 0, 6}, .edge_v{6, 0, 0}},
                  scene.add(Lambertian{.albedo = Rgb{0.5f}}));
        scene.add(Sphere{.center{-1, 0.8f, 0}, .radius = 0.5f},
                  scene.add(Glass{.index = 1.05f})); // a wide, faint caustic
        scene.add(Sphere{.center{1, 0.8f, 0}, .radius = 0.5f},
                  scene.add(Glass{.index = 1.5f})); // a small, bright caustic
        scene.add(PointLight{.position{0, 4, 0}, .intensity = Rgb{10}});
        const World world(std::move(scene));
        const Camera camera = look_at(
            {.position{0, 2.4f, 2.9f}, .target{0, 0.45f, 0}, .vfov_degrees = 55});

        PhotonMappingSettings settings{.split_glass = true,
                                       .indirect = IndirectLight::photons};
        settings.caustics = {
            .photons = 3000, .seed = options.seed, .threads = options.threads};
        settings.caustics_estimate.radius = 0.06f;
        settings.general = {.photons = options.pick(100000LL, 400000LL, 1000000LL),
                            .shadow_photons = false,
                            .threads = options.threads};
        settings.general_estimate.radius = 0.3f;
        for (const auto& [name, budget] :
             {std::pair{"budget-dark-seen", CausticBudget::as_seen},
              std::pair{"budget-dark-area", CausticBudget::area}}) {
            settings.caustic_budget = budget;
            const PhotonMapper mapper(world, settings, abilities<Budgeting>);
            auto image = rendered(name, mapper, camera, options).image;
            for (Rgb& color : image.pixels) color *= 1.5f;
            save_png(image, options.path(std::string(name) + ".png"));
        }
    });
}
