// smoke: --quality draft --width 24 --height 24 --rays 4
/// \file 02_radiance.cpp
/// \brief A lamp moves away from a white wall. The wall becomes darker, but the
/// radiance of the lamp does not change.

#include <string>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

constexpr double radius = 0.6;  // radius of the lamp, m
constexpr double emitted = 0.9; // radiance of the lamp, W/(m^2 sr)
constexpr double albedo = 0.8;  // albedo of the wall
const Vec3 eye{8, 0.6f, 5};     // the camera stays where it is

/// A glowing ball in front of a wall.
auto lamp_before_wall(float distance) {
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian>> scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{float(albedo)}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    scene.add(Quad{{-40, -40, 0}, {80, 0, 0}, {0, 80, 0}}, white);
    scene.add(Sphere{.center{0, 0, distance}, .radius = float(radius)}, black,
              Rgb{float(emitted)});
    return World(std::move(scene));
}

/// The radiance that one pixel of a hundredth of a degree measures.
template <typename Renderer>
double radiance_seen(const Renderer& renderer, const Vec3& target) {
    const Camera camera =
        look_at({.position = eye, .target = target, .vfov_degrees = 0.01f});
    const auto picture =
        render(renderer, camera, {.width = 1, .height = 1, .samples = 65536});
    return double(picture.image.pixels[0].x);
}

} // namespace

/// Makes three pictures and a table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 2, radiance: a lamp that leaves a wall.");
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 16},
                        .report{.width = 480, .height = 320, .samples = 64},
                        .reference{.width = 480, .height = 320, .samples = 1024}});
        const Camera camera =
            look_at({.position = eye, .target{0, 0, 1.4f}, .vfov_degrees = 36});
        using examples::text;
        examples::Table table{.name = "radiance-wall",
                              .columns = {"lamp to wall (m)", "radiance of the lamp",
                                          "radiance of the wall behind it",
                                          "by formula"}};
        int number = 0;
        for (const float distance : {0.8f, 1.6f, 3.2f}) {
            const auto world = lamp_before_wall(distance);
            const PathTracer tracer(world);
            const std::string name = "radiance-wall-" + std::to_string(++number);
            const auto picture = examples::rendered(name, tracer, camera, options);
            save_png(picture.image, options.path(name + ".png"));

            // If the wall sees the ball within an angle a from its centre, the ball
            // gives the irradiance E = pi L sin^2 a. The wall reflects the radiance
            // albedo E / pi.
            const double sine = radius / double(distance);
            table.rows.push_back({text(double(distance)),
                                  text(radiance_seen(tracer, {0, 0, distance}), "%.4f"),
                                  text(radiance_seen(tracer, {0, 0, 0}), "%.4f"),
                                  text(albedo * emitted * sine * sine, "%.4f")});
        }
        examples::print_row(table.columns, 31);
        examples::print_rows(table, 31);
        save_table(options.path(""), table);
    });
}
