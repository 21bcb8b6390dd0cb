// rest: half a million rays through whole trees, 12 s
// concept: bvh
// native: fused multiply-adds must not open a leak
/// \file tree_leaks_test.cpp
/// \brief Half a million rays at edges, at vertices and along the axes of a closed
/// mesh, through the whole tree: none slips through.

#include "ljus/accel/mesh.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cstddef>
#include <cstdio>

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/watertight.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/world.hpp"
#include "support/leaks.hpp"

using namespace ljus;
using ljus_test::Aim;
using ljus_test::ClosedMesh;

namespace {

using Triangles = Scene<Shapes<Triangle>, Materials<Lambertian>>;

Mesh mesh_of(const ClosedMesh& closed) {
    return Mesh({.positions = closed.vertices, .triangles = closed.faces});
}

Triangles scene_of(const ClosedMesh& closed) {
    Triangles scene;
    const auto grey = scene.add(Lambertian{});
    for (const Triangle& triangle : closed.triangles) scene.add(triangle, grey);
    return scene;
}

/// What slipped through: through a mesh, whose tree looks at eight triangles together,
/// and through a scene of triangles, whose tree asks them one by one;
/// the first hit, and any hit.
struct Leaks {
    long mesh_first = 0, mesh_any = 0, scene_first = 0, scene_any = 0;
};

template <typename Test>
Leaks leaks(const ClosedMesh& closed, Aim aim, long rays) {
    const Mesh mesh = mesh_of(closed);
    const Triangles triangles = scene_of(closed);
    const auto scene = World(triangles, compute_in<Test>);
    Leaks sum;
    ljus_test::count_leaks(closed, aim, rays, [&](const Ray& ray) {
        sum.mesh_first += !intersect<Test>(ray, mesh);
        sum.mesh_any += !meets<Test>(ray, mesh);
        sum.scene_first += !closest_hit(scene, ray);
        sum.scene_any += !occluded(scene, ray);
        return true;
    });
    return sum;
}

} // namespace

TEST_CASE("tree leaks: half a million rays at edges, at vertices, along the axes") {
    const long rays = 500000;
    std::printf("\n%-26s %31s %31s\n%-26s %10s %10s %9s %10s %10s %9s\n",
                "leaks of 500 000, mesh and", "watertight", "by default",
                "scene, first and any hit", "mesh", "scene", "any", "mesh", "scene",
                "any");
    const Vec3T<double> origin{0}, moved{100, -100, 100};
    // Along the axes the seams of a cube lie, and so do the rays.
    const auto row = [&](const char* name, const ClosedMesh& mesh, Aim aim) {
        const Leaks tight = leaks<Watertight>(mesh, aim, rays);
        const Leaks wide = leaks<void>(mesh, aim, rays); // in double
        std::printf("%-26s", name);
        for (const Leaks& l : {tight, wide}) {
            std::printf(" %10ld %10ld %9ld", l.mesh_first, l.scene_first,
                        l.mesh_any + l.scene_any);
            CHECK(l.mesh_first + l.mesh_any + l.scene_first + l.scene_any == 0);
        }
        std::printf("\n");
    };
    row("edges", ljus_test::dented_ball(3, 1, origin), Aim::edge);
    row("vertices", ljus_test::dented_ball(3, 1, origin), Aim::vertex);
    row("axes", ljus_test::cut_cube(6, 1, origin), Aim::axis);
    row("edges, moved by 100", ljus_test::dented_ball(3, 1, moved), Aim::edge);
    row("vertices, moved by 100", ljus_test::dented_ball(3, 1, moved), Aim::vertex);
    row("axes, moved by 100", ljus_test::cut_cube(6, 1.1, moved), Aim::axis);
}

TEST_CASE("tree leaks: a room of loose quads, at its edges and corners, by default") {
    // Corners that floats hold: what the data leave open no test can close.
    for (const float moved : {0.0f, 100.0f}) {
        const Vec3 low = Vec3{moved, -moved, moved} + Vec3{-1.375f, -0.625f, -2.25f};
        const Vec3 size{3.0625f, 1.625f, 4.6875f};
        Scene<Shapes<Quad>, Materials<Lambertian>> quads;
        const auto grey = quads.add(Lambertian{});
        // Each wall in three times three pieces.
        for (int axis = 0; axis < 3; ++axis)
            for (int side = 0; side < 2; ++side)
                for (int piece = 0; piece < 9; ++piece) {
                    const int a = (axis + 1) % 3, b = (axis + 2) % 3;
                    const float cut[] = {0, 0.25f, 0.625f, 1};
                    Vec3 corner = low, u{0}, v{0};
                    corner[axis] += float(side) * size[axis];
                    corner[a] += cut[piece % 3] * size[a];
                    corner[b] += cut[piece / 3] * size[b];
                    u[a] = (cut[piece % 3 + 1] - cut[piece % 3]) * size[a];
                    v[b] = (cut[piece / 3 + 1] - cut[piece / 3]) * size[b];
                    quads.add(Quad{.corner = corner, .edge_u = u, .edge_v = v}, grey);
                }
        const World quads_world(std::move(quads));
        const auto scene = World(quads_world);
        ljus_test::Numbers n;
        long leaks = 0;
        for (int i = 0; i < 500000; ++i) {
            const auto in = [&] {
                const float x = float(n.next()), y = float(n.next());
                return Vec3{x, y, float(n.next())};
            };
            const Vec3 origin = low + (0.1f + 0.8f * in()) * size;
            // On an edge, and every other time at a corner.
            Vec3 at = in();
            for (int axis = 0; axis < 3; ++axis)
                if (i % 2 == 0 || axis != i % 3)
                    at[axis] = std::array{0.0f, 0.25f, 0.625f,
                                          1.0f}[std::size_t(i >> (2 * axis + 1) & 3)];
            const int wall = i / 2 % 3;
            at[wall] = float(i >> 8 & 1);
            const Ray ray{.origin = origin, .direction = low + at * size - origin};
            leaks += !closest_hit(scene, ray);
            leaks += !occluded(scene, ray);
            leaks += !closest_hit(quads_world, ray);
        }
        CAPTURE(moved);
        CHECK(leaks == 0);
    }
}

TEST_CASE("tree leaks: the plain float test is what they would find") {
    // The trees are asked by the same rays; only the test differs.
    CHECK(leaks<float>(ljus_test::dented_ball(3, 1, Vec3T<double>{100}), Aim::vertex,
                       20000)
              .mesh_first > 0);
}
