// smoke: --quality draft --width 24 --height 16 --rays 1
/// \file 29_shading_normals.cpp
/// \brief Renders a ball and a ring of triangles, flat with the normals of their faces,
/// and smooth with normals that are interpolated between their corners.

#include <string>

#include <ljus/accel/mesh.hpp>
#include <ljus/ljus.hpp>
#include <ljus/scenes/mesh_formulas.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Two meshes on a floor between two lamps.
auto two_meshes(const MeshData& ball, const MeshData& ring) {
    Scene<Shapes<Mesh, Quad>, Materials<Lambertian>> scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.7f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const auto clay = scene.add(Lambertian{.albedo{0.75f, 0.42f, 0.25f}});
    const auto blue = scene.add(Lambertian{.albedo{0.25f, 0.4f, 0.7f}});
    scene.add(Quad{.corner{-5, 0, 4}, .edge_u{10, 0, 0}, .edge_v{0, 0, -10}}, white);
    scene.add(
        Quad{.corner{-3.3f, 4, -0.3f}, .edge_u{0.6f, 0.3f, 0}, .edge_v{0, 0, 0.6f}},
        black, Rgb{60});
    scene.add(Quad{.corner{1, 3.5f, 5}, .edge_u{2, 0, 1}, .edge_v{0, 1.5f, -0.5f}},
              black, Rgb{2.5f});
    scene.add(Mesh(ball), clay);
    scene.add(Mesh(ring), blue);
    return World(std::move(scene));
}

} // namespace

/// Makes the two pictures.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 29, shading normals: meshes, flat and smooth.");
        const examples::Options options =
            line.parse({.draft{.width = 240, .height = 160, .samples = 8},
                        .report{.width = 480, .height = 320, .samples = 256},
                        .reference{.width = 480, .height = 320, .samples = 4096}});
        MeshData ball = icosphere(Sphere{.center{-1.1f, 0.8f, 0}, .radius = 0.8f}, 2);
        MeshData ring = torus(Vec3{0.9f, 0.35f, 0.1f}, 0.75f, 0.34f, 24, 12);
        const Camera camera = look_at(
            {.position{0, 2.2f, 5}, .target{0.1f, 0.5f, 0}, .vfov_degrees = 30});
        const auto picture = [&](const std::string& name) {
            const auto world = two_meshes(ball, ring);
            const PathTracer tracer(world);
            save_png(examples::rendered(name, tracer, camera, options).image,
                     options.path(name + ".png"));
        };
        picture("mesh-smooth");
        ball.normals.clear(); // a mesh without normals is flat
        ring.normals.clear();
        picture("mesh-flat");
    });
}
