// smoke: --quality draft --width 24 --height 24 --photons 500
/// \file 25_density_estimate.cpp
/// \brief Chapter 25: the light under a ball of glass, estimated from the same photons
/// by discs of three sizes.

#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using Stage =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass>, Lights<PointLight>>;

/// A point light above a ball of glass above a white floor.
Stage ball_over_floor() {
    Stage stage;
    stage.add(Quad{{-9, 0, -9}, {0, 0, 18}, {18, 0, 0}},
              stage.add(Lambertian{.albedo = Rgb{1}}));
    stage.add(Sphere{.center{0, 0.6f, 0}, .radius = 0.5f},
              stage.add(Glass{.index = 1.5f}));
    stage.add(PointLight{.position{0, 2.6f, 0}});
    return stage;
}

/// A picture of the floor from above, 0.6 wide, around the middle of the caustic. It
/// shows the radiance that is estimated from the photons within a radius.
Image floor_by_photons(const PhotonMap& map, float radius,
                       const examples::Options& options) {
    Image image = make_image(options.width, options.height);
    for (int y = 0; y < options.height; ++y)
        for (int x = 0; x < options.width; ++x) {
            const Vec3 up{0, 1, 0};
            const Vec3 at{0.6f * (float(x) + 0.5f) / float(options.width) - 0.3f, 0,
                          0.6f * (float(y) + 0.5f) / float(options.height) - 0.3f};
            const Vertex floor{.point{.position = at, .normal = up},
                               .frame = frame_around(up),
                               .object = {}};
            std::uint64_t gathered = 0;
            pixel(image, x, y) = estimate_radiance(
                map, floor, Lambertian{.albedo = Rgb{1}}, Vec3{0, 0, 1},
                {.radius = radius}, all_kinds, gathered);
        }
    return image;
}

} // namespace

/// Makes density-small.png, density-medium.png and density-large.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 20000;
        line.about("Chapter 25, the density estimate: discs of three sizes.");
        line.add("--photons", photons, "Photons aimed at the ball", 1, 100000000);
        const examples::Options options = line.parse({});
        const World world(ball_over_floor());
        const PhotonMap map =
            make_photon_map(trace_photons(world, MapType::caustics,
                                          {.photons = photons, .seed = options.seed})
                                .photons);
        const auto save = [&](const std::string& name, float radius) {
            save_png(floor_by_photons(map, radius, options),
                     options.path("density-" + name + ".png"), {.exposure = 0.12});
        };
        save("small", 0.004f);
        save("medium", 0.015f);
        save("large", 0.05f);
    });
}
