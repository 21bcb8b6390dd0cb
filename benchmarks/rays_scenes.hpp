#pragma once

/// \file rays_scenes.hpp
/// \brief Meshes and rays for the benchmarks of rays; made, not loaded.

#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/geometry/triangle.hpp>
#include <ljus/math/frame.hpp>
#include <ljus/math/random.hpp>
#include <ljus/math/sampling.hpp>

namespace rays {

using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;
using Mesh = std::vector<Triangle>;

/// A mesh with its name.
struct Named {
    std::string name;
    Mesh mesh;
};

/// The triangles between the points of a grid, wherever `at(i, j)` puts them.
template <typename At>
void add_grid(Mesh& mesh, int rows, int columns, At at) {
    for (int i = 0; i < rows; ++i)
        for (int j = 0; j < columns; ++j) {
            const Vec3 a = at(i, j), b = at(i + 1, j), c = at(i + 1, j + 1),
                       d = at(i, j + 1);
            mesh.push_back({a, b, c});
            mesh.push_back({a, c, d});
        }
}

/// A ball with bumps, about `count` triangles.
inline Mesh bumpy_ball(int count) {
    const int rows = static_cast<int>(std::sqrt(count / 4.0)), columns = 2 * rows;
    Mesh mesh;
    add_grid(mesh, rows, columns, [&](int i, int j) {
        const float theta = std::numbers::pi_v<float> * float(i) / float(rows);
        const float phi =
            2 * std::numbers::pi_v<float> * float(j % columns) / float(columns);
        const float r = 1 + 0.1f * std::sin(9 * theta) * std::sin(8 * phi) +
                        0.02f * std::sin(40 * theta) * std::cos(48 * phi);
        return r * Vec3{std::sin(theta) * std::cos(phi), std::cos(theta),
                        std::sin(theta) * std::sin(phi)};
    });
    return mesh;
}

/// Hills, about `count` triangles.
inline Mesh hills(int count) {
    const int n = static_cast<int>(std::sqrt(count / 2.0));
    Mesh mesh;
    add_grid(mesh, n, n, [&](int i, int j) {
        const float x = 3 * float(i) / float(n) - 1.5f;
        const float z = 3 * float(j) / float(n) - 1.5f;
        return Vec3{x,
                    0.2f * std::sin(5 * x) * std::cos(4 * z) +
                        0.05f * std::sin(23 * x + 3 * z) + 0.02f * std::sin(61 * z) -
                        0.3f,
                    z};
    });
    return mesh;
}

/// Small balls in a room, about `count` triangles.
inline Mesh balls(int count) {
    Mesh mesh;
    ljus::RandomStream stream = ljus::random_stream(3, ljus::Pass::user, 0, 0);
    const int rows = 8, columns = 12;
    for (int k = 0; k < count / (2 * rows * columns); ++k) {
        const Vec3 center = 2.4f * ljus::next_3d<float>(stream) - 1.2f;
        const float radius = 0.02f + 0.1f * ljus::next_1d<float>(stream);
        add_grid(mesh, rows, columns, [&](int i, int j) {
            const float theta = std::numbers::pi_v<float> * float(i) / float(rows);
            const float phi =
                2 * std::numbers::pi_v<float> * float(j % columns) / float(columns);
            return center + radius * Vec3{std::sin(theta) * std::cos(phi),
                                          std::cos(theta),
                                          std::sin(theta) * std::sin(phi)};
        });
    }
    return mesh;
}

/// The meshes of the comparison.
inline std::vector<Named> meshes() {
    std::vector<Named> all;
    for (const int count : {6000, 30000, 125000}) {
        const std::string k =
            std::string(" ").append(std::to_string(count / 1000)) + " k";
        all.push_back({"ball" + k, bumpy_ball(count)});
        all.push_back({"hills" + k, hills(count)});
        all.push_back({"balls" + k, balls(count)});
    }
    return all;
}

/// Three sets of rays, as a renderer casts them.
struct RaySets {
    std::vector<Ray> primary; ///< From a pinhole, pixel by pixel, row by row.
    std::vector<Ray> diffuse; ///< From their hits, in random directions.
    std::vector<Ray> shadow;  ///< From the same hits to points of a lamp.
};

/// The rays for a mesh or a room. `first_hit(ray)` returns an optional
/// SurfacePoint; `eye`, `target` and the lamp's corner and edges say where things are.
template <typename FirstHit>
RaySets ray_sets(FirstHit first_hit, Vec3 eye, Vec3 target, Vec3 up, Vec3 lamp,
                 Vec3 lamp_u, Vec3 lamp_v, int size = 400) {
    RaySets sets;
    const Vec3 forward = glm::normalize(target - eye);
    const Vec3 right = glm::normalize(glm::cross(forward, up));
    const Vec3 above = glm::cross(right, forward);
    ljus::RandomStream stream = ljus::random_stream(1, ljus::Pass::user, 0, 0);
    for (int y = 0; y < size; ++y)
        for (int x = 0; x < size; ++x) {
            const ljus::Vec2 u = ljus::next_2d<float>(stream);
            const Vec3 way = forward + ((float(x) + u.x) / float(size) - 0.5f) * right +
                             (0.5f - (float(y) + u.y) / float(size)) * above;
            const Ray ray{.origin = eye, .direction = glm::normalize(way)};
            sets.primary.push_back(ray);
            auto point = first_hit(ray);
            if (!point) continue;
            if (glm::dot(point->normal, ray.direction) > 0)
                point->normal = -point->normal;
            const Vec3 local =
                ljus::sample_cosine_hemisphere(ljus::next_2d<float>(stream));
            sets.diffuse.push_back(ljus::spawn_ray(
                *point, ljus::to_world(ljus::frame_around(point->normal), local)));
            const ljus::Vec2 v = ljus::next_2d<float>(stream);
            const ljus::SurfacePoint to{.position = lamp + v.x * lamp_u + v.y * lamp_v};
            if (glm::dot(to.position - point->position, point->normal) > 0) {
                Ray between = ljus::spawn_ray_to(*point, to);
                between.t_max = glm::length(between.direction); // as the report has it
                between.direction /= between.t_max;
                sets.shadow.push_back(between);
            }
        }
    return sets;
}

/// The trees of the library over a mesh, built by one thread.
inline ljus::Bvh plain_tree(const Mesh& mesh) {
    std::vector<ljus::Box> boxes;
    for (const ljus::Triangle& triangle : mesh) boxes.push_back(ljus::bounds(triangle));
    return ljus::Bvh(boxes, {.threads = 1});
}
inline ljus::TriangleBvh wide_tree(const Mesh& mesh) {
    return {static_cast<std::uint32_t>(mesh.size()),
            [&](std::uint32_t i) -> const ljus::Triangle& { return mesh[i]; }, 1};
}
/// The triangle in a slot of a tree: the tree's own copy, or the mesh's triangle.
template <typename Tree>
Triangle triangle_at(const Tree& tree, const Mesh& mesh, std::uint32_t place) {
    if constexpr (requires { tree.triangle(place); })
        return tree.triangle(place);
    else
        return mesh[tree.primitive_ids()[place]];
}

} // namespace rays
