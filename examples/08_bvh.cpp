// smoke: --quality draft --width 32 --height 32
/// \file 08_bvh.cpp
/// \brief Shows the number of nodes of a bounding volume hierarchy that the ray of each
/// pixel visits.

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>

#include <ljus/accel/bvh.hpp>
#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/ljus.hpp>

#include "common/example.hpp"

using namespace ljus;

namespace {

/// Makes 104 small balls of 96 triangles each.
std::vector<Triangle> balls() {
    std::vector<Triangle> triangles;
    RandomStream stream = random_stream(3, Pass::user, 0, 0);
    constexpr int rows = 6, columns = 8;
    constexpr float pi = std::numbers::pi_v<float>;
    for (int k = 0; k < 104; ++k) {
        const Vec3 center = 2.4f * next_3d<float>(stream) - 1.2f;
        const float radius = 0.03f + 0.1f * next_1d<float>(stream);
        const auto at = [&](int i, int j) {
            const float theta = pi * float(i) / rows;
            const float phi = 2 * pi * float(j % columns) / columns;
            return center + radius * Vec3{std::sin(theta) * std::cos(phi),
                                          std::cos(theta),
                                          std::sin(theta) * std::sin(phi)};
        };
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
    }
    return triangles;
}

/// Finds the first triangle that a ray hits, and counts the nodes on the way to it.
/// \param triangle_at  Returns the triangle of a slot, in the order of the tree.
template <typename Tree, typename TriangleAt>
int nodes_visited(const Tree& tree, const Ray& ray, TriangleAt triangle_at) {
    NearestHit nearest;
    int nodes = 0;
    const auto test = [&](std::uint32_t slot, Ray& rest) {
        if (const auto hit = intersect(rest, triangle_at(slot)))
            nearest.offer(*hit, tree.primitive_ids()[slot], rest); // shortens the ray
    };
    tree.closest(ray, test, [&](std::uint32_t) { ++nodes; });
    return nodes;
}

/// A colour from blue through green and yellow to red.
Rgb heat(float x) {
    const auto ramp = [x](float middle) {
        return glm::clamp(1.5f - std::abs(4 * x - middle), 0.0f, 1.0f);
    };
    return {ramp(3), ramp(2), ramp(1)};
}

/// A picture of the numbers count(ray), red from 60 on. Also prints their mean.
template <typename Count>
void save_heat(const std::string& name, const examples::Options& options, Count count) {
    const int width = options.width, height = options.height;
    Image image = make_image(width, height);
    double sum = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const Vec3 eye{0, 0, 5};
            const Vec3 to{(float(x) + 0.5f) / float(width) * 4.0f - 2.0f,
                          2.0f - (float(y) + 0.5f) / float(height) * 4.0f, 0};
            const int nodes =
                count(Ray{.origin = eye, .direction = glm::normalize(to - eye)});
            pixel(image, x, y) = heat(float(nodes) / 60);
            sum += nodes;
        }
    save_png(image, options.path(name + ".png"));
    std::printf("%s: %.1f nodes per ray\n", name.c_str(),
                sum / (double(width) * height));
}

} // namespace

/// Makes a picture of each tree.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 8, bounding volumes: the nodes that rays visit.");
        line.without({"--rays", "--seed", "--threads"});
        const examples::Options options =
            line.parse({.draft{.width = 300, .height = 300},
                        .report{.width = 400, .height = 400},
                        .reference{.width = 800, .height = 800}});
        const std::vector<Triangle> triangles = balls();

        std::vector<Box> boxes;
        for (const Triangle& triangle : triangles) boxes.push_back(bounds(triangle));
        const Bvh plain(boxes);
        save_heat("bvh-nodes-plain", options, [&](const Ray& ray) {
            return nodes_visited(plain, ray, [&](std::uint32_t slot) {
                return triangles[plain.primitive_ids()[slot]];
            });
        });

        const TriangleBvh wide(std::uint32_t(triangles.size()),
                               [&](std::uint32_t i) { return triangles[i]; });
        save_heat("bvh-nodes-wide", options, [&](const Ray& ray) {
            return nodes_visited(
                wide, ray, [&](std::uint32_t slot) { return wide.triangle(slot); });
        });
    });
}
