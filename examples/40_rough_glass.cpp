// smoke: --quality draft --width 48 --height 20 --rays 1
/// \file 40_rough_glass.cpp
/// \brief Renders five plates of glass, from smooth to rough, in front of a wall of
/// squares.

#include <ljus/ljus.hpp>
#include <ljus/materials/rough_glass.hpp>

#include "common/example.hpp"

using namespace ljus;

using Checkered = Textured<Lambertian, Checker>;
using Room = Scene<Shapes<Quad>, Materials<Lambertian, Checkered, RoughGlass>>;

/// Adds the six faces of a plate. Outside is where the normals, u x v, point.
void add_plate(Room& room, const Vec3& low, const Vec3& high, MaterialId material) {
    const Vec3 edge = high - low, x{edge.x, 0, 0}, y{0, edge.y, 0}, z{0, 0, edge.z};
    room.add(Quad{low, x, z}, material);
    room.add(Quad{low + y, z, x}, material);
    room.add(Quad{low, y, x}, material);
    room.add(Quad{low + z, x, y}, material);
    room.add(Quad{low, z, y}, material);
    room.add(Quad{low + x, y, z}, material);
}

/// Renders rough_glass-plates.png.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 40, rough glass: plates of rising roughness.");
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 120, .samples = 16},
                        .report{.width = 800, .height = 320, .samples = 144},
                        .reference{.width = 1500, .height = 600, .samples = 2048}});

        Room room;
        const auto white = room.add(Lambertian{.albedo = Rgb{0.7f}});
        const auto wall = room.add(Checkered{
            {.albedo = Rgb{1}},
            {.map{.origin{-4, 0, 0}, .edge_u{0.5f, 0, 0}, .edge_v{0, 0.5f, 0}},
             .even{0.8f, 0.75f, 0.6f},
             .odd{0.1f, 0.2f, 0.5f}}});
        room.add(Quad{{-4, 0, 0}, {8, 0, 0}, {0, 3, 0}}, wall);
        room.add(Quad{{-4, 0, 6}, {8, 0, 0}, {0, 0, -6}}, white);
        room.add(Quad{{-4, 3, 0}, {8, 0, 0}, {0, 0, 6}}, white);
        room.add(Quad{{-1.5f, 2.99f, 0.6f}, {3, 0, 0}, {0, 0, 2}},
                 room.add(Lambertian{.albedo = Rgb{0}}), Rgb{6, 6, 5.5f});

        const float roughness[] = {0, 0.15f, 0.3f, 0.5f, 0.8f};
        for (int i = 0; i < 5; ++i) {
            const float left = -2.3f + 0.95f * float(i);
            const auto glass = room.add(RoughGlass{.roughness = roughness[i]});
            add_plate(room, {left, 0.2f, 0.45f}, {left + 0.8f, 1.9f, 0.55f}, glass);
        }
        const World world(std::move(room));

        const auto camera = look_at(
            {.position{0, 1.2f, 5.9f}, .target{0, 1.05f, 0}, .vfov_degrees = 22});
        const PhotonMapper mapper(
            world, {.direct = DirectLight::mis,
                    .split_glass = true,
                    .indirect = IndirectLight::photons,
                    .caustics{.photons = options.pick(20000, 300000, 3000000),
                              .seed = options.seed,
                              .threads = options.threads},
                    .general{.photons = options.pick(20000, 300000, 3000000),
                             .seed = options.seed,
                             .shadow_photons = false,
                             .threads = options.threads},
                    .caustics_estimate{.radius = options.pick(0.1f, 0.04f, 0.02f)},
                    .general_estimate{.radius = options.pick(0.3f, 0.15f, 0.1f)}});
        const auto picture = examples::rendered("plates", mapper, camera, options);
        save_png(picture.image, options.path("rough_glass-plates.png"));
    });
}
