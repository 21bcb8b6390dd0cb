// smoke: --quality draft --width 32 --height 32 --rays 1
/// \file 40_glass_in_water.cpp
/// \brief Renders a glass of water with bubbles and a straw, all of which are bodies
/// that overlap.

#include <ljus/geometry/cylinder.hpp>
#include <ljus/geometry/disc.hpp>
#include <ljus/ljus.hpp>
#include <ljus/materials/nested.hpp>

#include "common/example.hpp"

using namespace ljus;

using Checkered = Textured<Lambertian, Checker>;
using Table = Scene<Shapes<Quad, Sphere, Cylinder, Disc>,
                    Materials<Lambertian, Checkered, Nested<Glass>>>;

/// Adds a cylinder that is closed by two discs.
void add_rod(Table& table, const Cylinder& side, MaterialId material) {
    table.add(side, material);
    for (const Disc& end : ends_of(side)) table.add(end, material);
}

/// Adds the glass and its content. Each part is a whole body that overlaps other
/// bodies.
/// \param table  The scene.
/// \param rank   1: the bodies have priorities; 0: no body has a priority.
// [glass of water]
void add_glass(Table& table, int rank) {
    const Rgb green{0.5f, 0.15f, 0.4f}, blue{0.3f, 0.1f, 0.04f};
    const auto glass = table.add(Nested<Glass>{{1.5f, green}, 1 * rank});
    const auto hollow = table.add(Nested<Glass>{{1.0f}, 2 * rank});
    const auto water = table.add(Nested<Glass>{{1.33f, blue}, 3 * rank});
    const auto bubble = table.add(Nested<Glass>{{1.0f}, 4 * rank});
    add_rod(table, {{0, 0.01f, 0}, {0, 1.49f, 0}, 0.6f}, glass);   // not on the table
    add_rod(table, {{0, 0.15f, 0}, {0, 1.36f, 0}, 0.53f}, hollow); // above the rim
    add_rod(table, {{0, 0.14f, 0}, {0, 0.9f, 0}, 0.54f}, water);   // into the glass
    table.add(Sphere{{-0.2f, 0.5f, 0.15f}, 0.13f}, bubble);
    table.add(Sphere{{-0.33f, 0.8f, 0.1f}, 0.07f}, bubble);
    table.add(Sphere{{-0.1f, 1.04f, 0.2f}, 0.1f}, bubble); // reaches the water surface
}
// [glass of water]

/// Renders glass_in_water.png and glass_in_water-none.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 40, rough glass, and glass in water: bodies that overlap.");
        const examples::Options options =
            line.parse({.draft{.width = 200, .height = 200, .samples = 16},
                        .report{.width = 300, .height = 300, .samples = 36},
                        .reference{.width = 1000, .height = 1000, .samples = 2048}});
        for (const int rank : {1, 0}) {
            Table table;
            const auto cloth = table.add(Checkered{
                {.albedo = Rgb{1}},
                {.map{.origin{-3, 0, 3}, .edge_u{0.5f, 0, 0}, .edge_v{0, 0, -0.5f}},
                 .even{0.8f, 0.78f, 0.72f},
                 .odd{0.55f, 0.2f, 0.15f}}});
            const auto white = table.add(Lambertian{.albedo = Rgb{0.75f}});
            table.add(Quad{{-3, 0, 5}, {6, 0, 0}, {0, 0, -7}}, cloth);
            table.add(Quad{{-3, 0, -2}, {6, 0, 0}, {0, 5, 0}}, white);
            table.add(Quad{{-3, 0, 5}, {0, 0, -7}, {0, 5, 0}}, white);
            table.add(Quad{{3, 0, -2}, {0, 0, 7}, {0, 5, 0}}, white);
            table.add(Quad{{-3, 5, 5}, {0, 0, -7}, {6, 0, 0}}, white);
            table.add(Quad{{1, 4.5f, -1.2f}, {1.2f, 0, 0}, {0, 0, 1.2f}},
                      table.add(Lambertian{.albedo = Rgb{0}}), Rgb{26, 25, 22});
            add_glass(table, rank);
            add_rod(table, {{-0.3f, 0.24f, -0.1f}, {0.75f, 1.75f, -0.1f}, 0.06f},
                    table.add(Lambertian{.albedo{0.1f, 0.35f, 0.65f}}));
            const World world(std::move(table));

            const auto camera = look_at(
                {.position{0, 2, 4.2f}, .target{0.05f, 0.72f, 0}, .vfov_degrees = 28});
            const PhotonMapper mapper(
                world, {.split_glass = true,
                        .indirect = IndirectLight::photons,
                        .caustics{.photons = options.pick(20000, 50000, 5000000),
                                  .seed = options.seed,
                                  .threads = options.threads},
                        .general{.photons = options.pick(10000, 20000, 3000000),
                                 .seed = options.seed,
                                 .shadow_photons = false,
                                 .threads = options.threads},
                        .caustics_estimate{.radius = options.pick(0.1f, 0.08f, 0.02f)},
                        .general_estimate{.radius = options.pick(0.4f, 0.3f, 0.1f)}});
            const char* const name = rank ? "glass_in_water" : "glass_in_water-none";
            const auto picture = examples::rendered(name, mapper, camera, options);
            save_png(picture.image, options.path(std::string(name) + ".png"));
        }
    });
}
