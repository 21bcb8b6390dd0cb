// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file 13_hemisphere_sampling.cpp
/// \brief Renders a ball of a diffuse material that samples directions in proportion to
/// the cosine, without shadow rays.

#include <cmath>
#include <numbers>
#include <optional>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

/// A diffuse surface.
struct Matt {
    using Scalar = float; ///< The precision.
    Rgb albedo{0.5f};     ///< Albedo, in [0, 1].
};

/// The lobes of the material: only a diffuse one.
Lobes lobes(const Matt&) {
    return Lobes::diffuse;
}

/// Lambert's law: f = albedo / pi, in 1/sr.
Rgb evaluate(const Matt& matt, const Vec3& wo, const Vec3& wi) {
    return same_side(wo, wi) ? matt.albedo * std::numbers::inv_pi_v<float> : Rgb{0};
}

/// The density of the directions that sample() draws, in 1/sr.
float pdf(const Matt&, const Vec3& wo, const Vec3& wi, Lobes = Lobes::all) {
    if (!same_side(wo, wi)) return 0;
    return pdf_cosine_hemisphere(Vec3{wi.x, wi.y, std::abs(wi.z)});
}

// [sample]
/// Samples a direction, with the weight f cos / pdf. For naive directions, call
/// sample_naive_hemisphere() here, and pdf_naive_hemisphere() here and in pdf().
std::optional<BsdfSample> sample(const Matt& matt, const Vec3& wo, const Vec3& u,
                                 Transport, Lobes which = Lobes::all) {
    if (!has(which, Lobes::diffuse) || wo.z == 0) return std::nullopt;
    Vec3 wi = sample_cosine_hemisphere(Vec2{u.x, u.y});
    const float density = pdf_cosine_hemisphere(wi);
    const Rgb weight = matt.albedo * std::numbers::inv_pi_v<float> * wi.z / density;
    wi.z = std::copysign(wi.z, wo.z); // on the side of wo
    return diffuse_sample(wi, weight, density);
}
// [sample]

/// Refuses an albedo that would create light.
void check(const Matt& matt) {
    require_unit("matt.albedo", matt.albedo);
}

/// Renders hemisphere-cosine-lamp.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 13, directions: a ball whose light is found by chance.");
        const examples::Options options =
            line.parse({.draft{.width = 150, .height = 100, .samples = 64},
                        .report{.width = 480, .height = 320, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});

        Scene<Shapes<Sphere, Quad>, Materials<Matt>> scene;
        const auto skin = scene.add(Matt{.albedo{0.75f, 0.6f, 0.5f}});
        const auto grey = scene.add(Matt{.albedo = Rgb{0.5f}});
        const auto black = scene.add(Matt{.albedo = Rgb{0}});
        scene.add(Quad{{-6, 0, 6}, {12, 0, 0}, {0, 0, -12}}, grey);
        scene.add(Sphere{.center{0, 1, 0}, .radius = 1}, skin);
        scene.add(Sphere{.center{0.5f, 6, 0.8f}, .radius = 1.1f}, black, Rgb{14});
        const World world(std::move(scene));

        // No shadow rays: only the directions of sample() find the light.
        const PathTracer tracer(world, {.sample_lights = false});
        const Camera camera =
            look_at({.position{0, 2.4f, 6}, .target{0, 0.8f, 0}, .vfov_degrees = 32});
        const auto picture = examples::rendered("lamp", tracer, camera, options);
        save_png(picture.image, options.path("hemisphere-cosine-lamp.png"));
    });
}
