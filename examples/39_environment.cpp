// smoke: --quality draft --width 24 --height 16 --rays 1 --photons 500
/// \file 39_environment.cpp
/// \brief Chapter 39: makes a picture of a morning sky, and renders balls of mirror,
/// clay and glass in its light.

#include <cmath>
#include <numbers>

#include <ljus/lights/environment.hpp>
#include <ljus/ljus.hpp>
#include <ljus/math/stratified_stream.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

// [morning]
/// The radiance of a clear sky from a direction, W/(m^2 sr). The sky is pale at the
/// horizon, blue above, and warm around a sun with a radius of 2 degrees. Below the
/// horizon is sand.
Rgb morning(const Vec3& direction) {
    const Vec3 sun = glm::normalize(Vec3{-1.5f, 1.4f, -1.1f});
    if (direction.y < 0) return {0.75f, 0.62f, 0.45f};
    const float apart = std::acos(std::min(glm::dot(direction, sun), 1.0f));
    if (apart < 2 * pi / 180) return {1100, 950, 720};
    const Rgb horizon{0.95f, 0.9f, 0.85f}, zenith{0.16f, 0.32f, 0.75f};
    const Rgb glow = std::exp(-5 * apart) * Rgb{3, 2.4f, 1.5f};
    return horizon + std::sqrt(direction.y) * (zenith - horizon) + glow;
}

/// The sky as a picture, computed for the direction of the middle of each pixel.
Image picture_of_morning(int width, int height) {
    Image picture = make_image(width, height);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const float down = pi * (float(y) + 0.5f) / float(height);
            const float azimuth = pi * ((2 * float(x) + 1) / float(width) - 1);
            const float r = std::sin(down);
            pixel(picture, x, y) = morning(
                {r * std::sin(azimuth), std::cos(down), -r * std::cos(azimuth)});
        }
    return picture;
}
// [morning]

} // namespace

/// Makes environment-sky.png and environment-balls.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        long long photons = 0;
        line.about("Chapter 39, environments: balls in the light of a picture.");
        line.add("--photons", photons, "Photons of the caustics", 1, 100000000);
        const examples::Options options =
            line.parse({.draft{.width = 150, .height = 100, .samples = 8},
                        .report{.width = 480, .height = 320, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});
        if (!line.given("--photons"))
            photons = options.pick(20000LL, 400000LL, 4000000LL);

        // [scene]
        const Image sky = picture_of_morning(1024, 512);
        const World world(
            make_scene(placed(Quad{{-12, 0, 12}, {24, 0, 0}, {0, 0, -24}},
                              Lambertian{.albedo{0.6f, 0.5f, 0.36f}}),
                       placed(Sphere{{-1.35f, 0.65f, -0.5f}, 0.65f}, Mirror{}),
                       placed(Sphere{{0.1f, 0.65f, -1.4f}, 0.65f},
                              Lambertian{.albedo{0.65f, 0.32f, 0.2f}}),
                       placed(Sphere{{1.1f, 0.66f, 0.2f}, 0.65f}, Glass{.index = 1.5f}),
                       EnvironmentLight{.picture = sky}));
        const PhotonMapper mapper(world,
                                  {.direct = DirectLight::mis,
                                   .caustics{.photons = photons, .seed = options.seed},
                                   .caustics_estimate{.radius = 0.05f}},
                                  abilities<StratifiedStream>);
        // [scene]
        const Camera camera = look_at(
            {.position{0.2f, 1.7f, 5.6f}, .target{0, 0.75f, 0}, .vfov_degrees = 34});
        save_png(sky, options.path("environment-sky.png"));
        const auto picture = examples::rendered("balls", mapper, camera, options);
        save_png(picture.image, options.path("environment-balls.png"));
    });
}
