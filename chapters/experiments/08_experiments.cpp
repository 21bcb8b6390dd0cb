// smoke: --quality draft
/// \file chapters/experiments/08_experiments.cpp
/// \brief Chapter 8: the experiments behind its plot and its first table: from how many
/// triangles on a tree is faster than asking them all, and what the two trees cost.

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include "common/clock.hpp"
#include "common/command_line.hpp"
#include "common/plot.hpp"
#include "ljus/accel/triangle_bvh.hpp"
#include "ljus/geometry/shape.hpp"
#include "ljus/math/random.hpp"

using ljus::NearestHit;
using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

using Mesh = std::vector<Triangle>;

/// Many small balls, the same ones each time: about `count` triangles.
Mesh balls(int count) {
    Mesh mesh;
    ljus::RandomStream stream = ljus::random_stream(3, ljus::Pass::user, 0, 0);
    constexpr int rows = 6, columns = 8;
    for (int k = 0; k < std::max(1, count / (2 * rows * columns)); ++k) {
        const Vec3 center = 2.4f * ljus::next_3d<float>(stream) - 1.2f;
        const float radius = 0.03f + 0.1f * ljus::next_1d<float>(stream);
        const auto at = [&](int i, int j) {
            const float theta = std::numbers::pi_v<float> * float(i) / rows;
            const float phi =
                2 * std::numbers::pi_v<float> * float(j % columns) / columns;
            return center + radius * Vec3{std::sin(theta) * std::cos(phi),
                                          std::cos(theta),
                                          std::sin(theta) * std::sin(phi)};
        };
        for (int i = 0; i < rows; ++i)
            for (int j = 0; j < columns; ++j) {
                mesh.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
                mesh.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
            }
    }
    mesh.resize(std::min(mesh.size(), static_cast<std::size_t>(count)));
    return mesh;
}

/// Rays through the room of the balls, in any direction.
std::vector<Ray> rays_through(int count) {
    ljus::RandomStream stream = ljus::random_stream(4, ljus::Pass::user, 0, 0);
    std::vector<Ray> rays;
    for (int i = 0; i < count; ++i) {
        const Vec3 from = 3.0f * ljus::next_3d<float>(stream) - 1.5f;
        const Vec3 to = 3.0f * ljus::next_3d<float>(stream) - 1.5f;
        rays.push_back({.origin = from, .direction = glm::normalize(to - from)});
    }
    return rays;
}

/// The three ways to the first triangle, each with one call.
struct Loop {
    static constexpr const char* name = "loop";
    const Mesh& mesh;
    explicit Loop(const Mesh& of) : mesh(of) {}
    [[nodiscard]] NearestHit first(Ray ray) const {
        NearestHit nearest;
        for (std::uint32_t i = 0; i < mesh.size(); ++i)
            if (const auto hit = ljus::intersect(ray, mesh[i]))
                nearest.offer(*hit, i, ray);
        return nearest;
    }
    [[nodiscard]] std::size_t bytes() const { return 0; }
};

/// By a tree: `tree.closest()` is the same for both; `triangle_at(slot)` is where the
/// triangles are.
template <typename Tree>
NearestHit first_in(const Tree& tree, auto triangle_at, const Ray& ray) {
    NearestHit nearest;
    tree.closest(ray, [&](std::uint32_t slot, Ray& rest) {
        const Triangle triangle = triangle_at(slot);
        if (const auto hit = ljus::intersect(rest, triangle))
            nearest.offer(*hit, tree.primitive_ids()[slot], rest);
    });
    return nearest;
}

/// The chapter's tree.
struct Plain {
    static constexpr const char* name = "plain tree";
    const Mesh& mesh;
    ljus::Bvh tree;
    explicit Plain(const Mesh& of) : mesh(of) {
        std::vector<ljus::Box> boxes;
        for (const Triangle& triangle : mesh) boxes.push_back(ljus::bounds(triangle));
        tree = ljus::Bvh(boxes, {.threads = 1});
    }
    [[nodiscard]] NearestHit first(const Ray& ray) const {
        const auto triangle_at = [&](std::uint32_t slot) {
            return mesh[tree.primitive_ids()[slot]];
        };
        return first_in(tree, triangle_at, ray);
    }
    [[nodiscard]] std::size_t bytes() const {
        return tree.nodes().capacity() * sizeof(tree.nodes()[0]) +
               tree.primitive_ids().capacity() * 4;
    }
};

/// Its twin for speed.
struct Wide {
    static constexpr const char* name = "wide tree";
    ljus::TriangleBvh tree;
    explicit Wide(const Mesh& of)
        : tree(
              static_cast<std::uint32_t>(of.size()),
              [&](std::uint32_t i) { return of[i]; }, 1) {}
    [[nodiscard]] NearestHit first(const Ray& ray) const {
        const auto triangle_at = [&](std::uint32_t slot) {
            return tree.triangle(slot);
        };
        return first_in(tree, triangle_at, ray);
    }
    [[nodiscard]] std::size_t bytes() const { return tree.bytes(); }
};

/// What one way takes.
struct Cost {
    double build = 0;    ///< Milliseconds.
    double ray = 0;      ///< Nanoseconds.
    double bytes = 0;    ///< A triangle.
    double checksum = 0; ///< Of all hits: equal for all ways.
};

template <typename Way>
Cost cost(const Mesh& mesh, const std::vector<Ray>& rays) {
    Cost result;
    double start = examples::processor_seconds();
    const Way way(mesh);
    result.build = 1e3 * (examples::processor_seconds() - start);
    result.ray = std::numeric_limits<double>::infinity();
    for (int run = 0; run < 5; ++run) {
        result.checksum = 0;
        start = examples::processor_seconds();
        int rounds = 0;
        do {
            for (const Ray& ray : rays) {
                const NearestHit hit = way.first(ray);
                if (hit.found && rounds == 0)
                    result.checksum += double(hit.at.t) + hit.number;
            }
            ++rounds;
        } while (examples::processor_seconds() - start < 0.02);
        result.ray =
            std::min(result.ray, 1e9 * (examples::processor_seconds() - start) /
                                     double(rays.size()) / rounds);
    }
    result.bytes = double(way.bytes()) / double(mesh.size());
    return result;
}

/// Figure: time per ray, against the number of triangles.
void plot_crossover(const examples::Options& options) {
    examples::Plot plot{.name = "bvh-crossover",
                        .columns = {"triangles", Loop::name, Plain::name, Wide::name},
                        .y_label = "nanoseconds per ray",
                        .rows = {},
                        .log_x = true,
                        .log_y = true};
    const int largest = options.pick(20000, 200000, 1000000);
    for (double size = 1; size <= largest; size *= 2) {
        const Mesh mesh = balls(static_cast<int>(size));
        const bool few = size <= 4096;
        const auto rays = rays_through(few ? 300 : 3000);
        const Cost plain = cost<Plain>(mesh, rays), wide = cost<Wide>(mesh, rays);
        const double loop = few ? cost<Loop>(mesh, rays).ray : std::nan("");
        plot.rows.push_back({size, loop, plain.ray, wide.ray});
    }
    examples::save_plot(options.out, plot);
}

/// Table: the ways over one mesh.
void tabulate(const examples::Options& options) {
    examples::Table table{
        .name = "bvh-trade",
        .columns = {"", "build, ms", "bytes per triangle", "ns per ray", "same hits"}};
    const Mesh mesh = balls(options.pick(10000, 100000, 100000));
    const auto rays = rays_through(options.pick(300, 2000, 5000));
    const Cost loop = cost<Loop>(mesh, rays), plain = cost<Plain>(mesh, rays),
               wide = cost<Wide>(mesh, rays);
    const auto add = [&](const char* name, const Cost& c) {
        table.rows.push_back({name, examples::text(c.build, "%.1f"),
                              examples::text(c.bytes, "%.0f"),
                              examples::text(c.ray, "%.0f"),
                              c.checksum == loop.checksum ? "yes" : "no"});
    };
    add(Loop::name, loop);
    add(Plain::name, plain);
    add(Wide::name, wide);
    examples::save_table(options.out, table);
    if (options.quiet) return;
    std::printf("%zu triangles\n", mesh.size());
    examples::print_row(table.columns, 18);
    examples::print_rows(table, 18);
}

} // namespace

/// Makes the plot and the table.
int main(int argc, char** argv) {
    return examples::run_main(argc, argv, [](examples::CommandLine& line) {
        line.about("Chapter 8, bounding volumes: its plot and its first table.");
        line.without({"--width", "--height", "--rays", "--seed", "--threads"});
        const examples::Options options = line.parse();
        plot_crossover(options);
        tabulate(options);
    });
}
