// figures: fig-4
// smoke: --quality draft --width 32 --height 8 --rays 1
/// \file 15_materials.cpp
/// \brief Figure 4: eight materials in a room and, in two rows below, in a furnace,
/// where a ball that loses no light is invisible.

#include <algorithm>

#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

using Globe = Textured<Lambertian, GlobeChecker>;
using Tiles = Textured<Lambertian, Checker>;
using Row =
    Scene<Shapes<Sphere, Quad>, Materials<Lambertian, Glass, ThinGlass, Eon, Mirror,
                                          Metal, RoughMetal, Globe, Tiles>>;

/// The ball with this index in the row, counted from the left.
Sphere ball_at(int place) {
    return {.center{2.4f * (float(place) - 3.5f), 1, 0}, .radius = 1};
}

/// Calls f(index, material) for each ball.
/// \param white  Whether to make the materials white, except gold.
/// \param f      Called with the index and a material of any type.
template <typename F>
void for_each_ball(bool white, F f) {
    const auto color = [&](const Rgb& usual) { return white ? Rgb{1} : usual; };
    const Rgb ochre{0.75f, 0.5f, 0.2f};
    f(0, Glass{.absorption = absorption_from_color(color({0.55f, 0.9f, 0.7f}), 2.0f)});
    f(1, ThinGlass{.tint = color({0.9f, 0.96f, 0.98f})});
    f(2, Eon{.albedo = color(ochre), .roughness = 1}); // clay
    f(3, Mirror{.reflectance = color(Rgb{0.98f})});
    f(4, Lambertian{.albedo = color(ochre)});
    f(5, Metal{});                                    // polished gold
    const ConductorIndex white_metal{Rgb{0}, Rgb{5}}; // each facet reflects all light
    f(6, RoughMetal{white ? white_metal : copper<float>, 0.45f}); // brushed copper
    f(7, Globe{{.albedo = Rgb{1}},
               {.map{.center = ball_at(7).center},
                .even = color({0.85f, 0.85f, 0.8f}),
                .odd = color({0.1f, 0.2f, 0.5f}),
                .columns = 16,
                .rows = 8}});
}

/// Renders the row of balls in a room with two lamps, by photon mapping.
Image in_a_room(const examples::Options& options) {
    Row scene;
    const auto matt = [&](const Rgb& c) { return scene.add(Lambertian{.albedo = c}); };
    const auto white = matt(Rgb{0.7f}), black = matt(Rgb{0});
    const auto floor = scene.add(Tiles{{.albedo = Rgb{1}},
                                       {.map{.edge_u{4, 0, 0}, .edge_v{0, 0, 4}},
                                        .even = Rgb{0.55f},
                                        .odd = Rgb{0.35f}}});
    scene.add(Quad{{-11, 0, -3}, {0, 0, 27}, {22, 0, 0}}, floor);
    scene.add(Quad{{-11, 8, -3}, {22, 0, 0}, {0, 0, 27}}, white);
    scene.add(Quad{{-11, 0, -3}, {22, 0, 0}, {0, 8, 0}}, matt({0.45f, 0.5f, 0.6f}));
    scene.add(Quad{{-11, 0, 24}, {0, 8, 0}, {22, 0, 0}}, white);
    scene.add(Quad{{-11, 0, -3}, {0, 8, 0}, {0, 0, 27}}, matt({0.6f, 0.2f, 0.15f}));
    scene.add(Quad{{11, 0, -3}, {0, 0, 27}, {0, 8, 0}}, matt({0.2f, 0.5f, 0.2f}));
    scene.add(Quad{{-9, 7.99f, -0.5f}, {18, 0, 0}, {0, 0, 2}}, black, Rgb{7});
    scene.add(Quad{{-3, 7.99f, 12}, {6, 0, 0}, {0, 0, 3}}, black, Rgb{7});
    for_each_ball(false, [&](int place, const auto& material) {
        scene.add(ball_at(place), scene.add(material));
    });
    const World world(std::move(scene));
    const PhotonMapper mapper(
        world, {.max_depth = 24,
                .caustics{.photons = options.pick(200000LL, 3000000LL, 20000000LL),
                          .seed = options.seed,
                          .threads = options.threads},
                .caustics_estimate{.radius = options.pick(0.08f, 0.05f, 0.03f)}});
    const Camera camera =
        look_at({.position{0, 3.2f, 22}, .target{0, 1.3f, 0}, .vfov_degrees = 12.5});
    return examples::rendered("room", mapper, camera, options).image;
}

/// Renders each ball alone under a sky of radiance 1, at half the exposure. A ball that
/// loses no light is as grey as the sky.
void in_a_furnace(bool white, Image& figure, const examples::Options& options) {
    for_each_ball(white, [&](int place, const auto& material) {
        Row scene;
        const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
        scene.add(Sphere{.radius = 100}, black, Rgb{1}, true); // seen from inside
        scene.add(ball_at(place), scene.add(material));
        const World world(std::move(scene));
        const int left = options.width * place / 8;
        RenderSettings picture = examples::picture_settings(options);
        picture.width = options.width * (place + 1) / 8 - left;
        picture.samples = std::max(1, options.samples / 2); // less noise than in a room
        const float x = ball_at(place).center.x;
        const Camera camera = look_at(
            {.position{x, 3.2f, 22}, .target{x, 1.3f, 0}, .vfov_degrees = 12.5});
        const auto ball =
            examples::rendered("furnace", PathTracer(world), camera, picture, options);
        const int top = white ? 2 * options.height : options.height;
        for (int v = 0; v < options.height; ++v)
            for (int u = 0; u < ball.image.width; ++u)
                pixel(figure, left + u, top + v) = 0.5f * pixel(ball.image, u, v);
    });
}

/// Renders fig-4.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 15, materials: figure 4.");
        const examples::Options options =
            line.parse({.draft{.width = 600, .height = 150, .samples = 25},
                        .report{.width = 1200, .height = 300, .samples = 64},
                        .reference{.width = 1600, .height = 400, .samples = 2048}});
        Image figure = in_a_room(options);
        figure.height *= 3; // space for two more rows
        figure.pixels.resize(3 * figure.pixels.size());
        for (const bool white : {false, true}) in_a_furnace(white, figure, options);
        save_png(figure, options.path("fig-4.png"));
    });
}
