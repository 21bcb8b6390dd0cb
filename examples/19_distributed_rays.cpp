// smoke: --quality draft --width 24 --height 16 --rays 9
/// \file 19_distributed_rays.cpp
/// \brief A billiard table by distributed rays: for each ray, random numbers choose the
/// point in the pixel, on the lens and on the lamps, the time, and the direction off
/// the glossy ball.

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

/// Renders distributed_rays-all.png and, by 4 rays per pixel,
/// distributed_rays-all-few.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 19, distributed rays: five blurs in one picture.");
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 36},
                        .report{.width = 600, .height = 400, .samples = 100},
                        .reference{.width = 900, .height = 600, .samples = 1024}});

        Scene<Shapes<Sphere, Quad, Moving<Sphere>>, Materials<Lambertian, Glossy>>
            scene;
        const auto matt = [&](const Rgb& albedo) {
            return scene.add(Lambertian{.albedo = albedo});
        };
        scene.add(Quad{{-60, 0, 60}, {120, 0, 0}, {0, 0, -120}},
                  matt({0.06f, 0.35f, 0.16f}));

        // The position of a ball when the shutter opens, and the way that it rolls
        // until the shutter closes.
        const auto ball = [&](const Vec3& place, const Vec3& way, const Rgb& color) {
            scene.add(Moving<Sphere>{{.center = place, .radius = 0.5f}, way},
                      matt(color));
        };
        const Vec3 still{0.6f, 0.5f, -0.3f};
        ball({-1.9f, 0.5f, 0.6f}, {1.1f, 0, -0.5f}, {0.85f, 0.82f, 0.7f});
        ball(still, {0, 0, 0}, {0.8f, 0.6f, 0.05f});
        ball({1.8f, 0.5f, 0.4f}, {0.35f, 0, 0.2f}, {0.65f, 0.08f, 0.07f});
        ball({0.3f, 0.5f, -2.6f}, {-0.3f, 0, -0.7f}, {0.1f, 0.15f, 0.55f});

        const auto black = matt(Rgb{0});
        scene.add(Quad{{-4, 6, 1}, {2, 0, 0}, {0, 0, 2}}, black, Rgb{20});
        scene.add(Quad{{3, 6, -4}, {2, 0, 0}, {0, 0, 2}}, black, Rgb{12});
        scene.add(
            Sphere{.center{-0.5f, 0.5f, 1.9f}, .radius = 0.5f},
            scene.add(Glossy{.reflectance{0.75f, 0.7f, 0.6f}, .roughness = 0.35f}));
        scene.add(Sphere{.radius = 90}, black, Rgb{0.05f, 0.06f, 0.08f}, true); // sky
        const World world(std::move(scene));

        // A lens of radius 0.08, focused on the ball at rest.
        const Camera pinhole = look_at(
            {.position{0, 3.2f, 6.5f}, .target{0, 0.3f, -0.4f}, .vfov_degrees = 36});
        const LensCamera camera = with_lens(
            pinhole, 0.08f, glm::dot(still - pinhole.position, pinhole.forward));

        const DistributedTracer tracer(world);
        RenderSettings picture = examples::picture_settings(options);
        const auto many = examples::rendered("many", tracer, camera, picture, options);
        save_png(many.image, options.path("distributed_rays-all.png"));
        picture.samples = 4;
        const auto few = examples::rendered("few", tracer, camera, picture, options);
        save_png(few.image, options.path("distributed_rays-all-few.png"));
    });
}
