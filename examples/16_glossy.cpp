// smoke: --quality draft --width 40 --height 16 --rays 1
/// \file 16_glossy.cpp
/// \brief Chapter 16: five balls of gold, from a mirror to satin.

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

using Hall = Scene<Shapes<Sphere, Quad>, Materials<Lambertian, RoughMetal>>;

/// A long room with a lamp over five balls of gold. Each ball is rougher than the one
/// before.
Hall five_balls() {
    Hall hall;
    const auto matt = [&](const Rgb& c) { return hall.add(Lambertian{.albedo = c}); };
    const auto grey = matt(Rgb{0.55f});
    hall.add(Quad{{-7, 0, 8}, {14, 0, 0}, {0, 0, -11}}, matt(Rgb{0.35f})); // floor
    hall.add(Quad{{-7, 0, -3}, {14, 0, 0}, {0, 5, 0}}, matt({0.4f, 0.5f, 0.6f}));
    hall.add(Quad{{-7, 5, -3}, {14, 0, 0}, {0, 0, 11}}, grey); // ceiling
    hall.add(Quad{{-7, 0, 8}, {0, 5, 0}, {14, 0, 0}}, grey);
    hall.add(Quad{{-7, 0, 8}, {0, 0, -11}, {0, 5, 0}}, matt({0.6f, 0.2f, 0.1f}));
    hall.add(Quad{{7, 0, 8}, {0, 5, 0}, {0, 0, -11}}, matt({0.1f, 0.4f, 0.2f}));
    hall.add(Quad{{-5, 4.99f, 0}, {10, 0, 0}, {0, 0, 2}}, matt(Rgb{0}), Rgb{7});

    for (int i = 0; i < 5; ++i)
        hall.add(Sphere{.center{2.4f * float(i - 2), 1, 0}, .radius = 1},
                 hall.add(RoughMetal{.reflectance = gold<float>,
                                     .roughness = 0.175f * float(i)}));
    return hall;
}

} // namespace

/// Renders glossy-row.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 16, gloss: gold from a mirror to satin.");
        const examples::Options options =
            line.parse({.draft{.width = 500, .height = 150, .samples = 16},
                        .report{.width = 1000, .height = 300, .samples = 256},
                        .reference{.width = 1200, .height = 360, .samples = 2048}});
        const World world(five_balls());
        const Camera camera =
            look_at({.position{0, 2.2f, 7.5f}, .target{0, 1, 0}, .vfov_degrees = 28});
        const PathTracer tracer(world);
        save_png(examples::rendered("gold", tracer, camera, options).image,
                 options.path("glossy-row.png"));
    });
}
