/// \file rays_structures.cpp
/// \brief Grid, octree, k-d tree and the library's two trees over the same triangles:
/// time to build, time of a ray, memory; and whether all find the same hits.

#include <cstdio>

#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/geometry/shape.hpp>

#include "csv.hpp"
#include "rays_scenes.hpp"
#include "rays_structures.hpp"
#include "rays_timing.hpp"

using ljus::NearestHit;
using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

/// Tests every triangle.
struct Loop {
    static constexpr const char* name = "loop";
    const rays::Mesh& mesh;
    explicit Loop(const rays::Mesh& of) : mesh(of) {}
    [[nodiscard]] std::size_t bytes() const { return 0; }
    NearestHit closest(Ray ray) const {
        NearestHit nearest;
        for (std::uint32_t i = 0; i < mesh.size(); ++i)
            if (const auto hit = ljus::intersect<double>(ray, mesh[i]))
                nearest.offer(*hit, i, ray);
        return nearest;
    }
};

/// The trees of the library.
template <typename Made>
struct House {
    const rays::Mesh& mesh;
    Made tree;
    [[nodiscard]] std::size_t bytes() const { return tree.bytes(); }
    NearestHit closest(const Ray& ray) const {
        NearestHit nearest;
        tree.closest(ray, [&](std::uint32_t place, Ray& rest) {
            const Triangle triangle = rays::triangle_at(tree, mesh, place);
            if (const auto hit = ljus::intersect<double>(rest, triangle))
                nearest.offer(*hit, tree.primitive_ids()[place], rest);
        });
        return nearest;
    }
};
struct Plain : House<ljus::Bvh> {
    static constexpr const char* name = "plain tree";
    explicit Plain(const rays::Mesh& of) : House{of, rays::plain_tree(of)} {}
};
struct Wide : House<ljus::TriangleBvh> {
    static constexpr const char* name = "wide tree";
    explicit Wide(const rays::Mesh& of) : House{of, rays::wide_tree(of)} {}
};

bool same(const NearestHit& a, const NearestHit& b) {
    return a.found == b.found &&
           (!a.found || (a.number == b.number && a.at.t == b.at.t && a.at.u == b.at.u &&
                         a.at.v == b.at.v));
}

/// A row of the book's tables for one mesh.
struct Cells {
    std::vector<std::string> rays, build, bytes; ///< Of each structure.
};

/// Builds a structure and traces all rays, three times each; prints the row.
template <typename Structure>
std::vector<NearestHit> row(const rays::Mesh& mesh, std::span<const Ray> set,
                            const std::vector<NearestHit>* expected, Cells& cells) {
    double build = HUGE_VAL, ray_time = HUGE_VAL;
    for (int run = 0; run < 3; ++run) {
        const double start = rays::seconds();
        const Structure made(mesh);
        build = std::min(build, rays::seconds() - start);
    }
    const Structure structure(mesh);
    std::vector<NearestHit> hits(set.size());
    for (int run = 0; run < 3; ++run) {
        const double start = rays::seconds();
        for (std::size_t i = 0; i < set.size(); ++i)
            hits[i] = structure.closest(set[i]);
        ray_time = std::min(ray_time, (rays::seconds() - start) / double(set.size()));
    }
    std::size_t other = 0;
    if (expected != nullptr)
        for (std::size_t i = 0; i < set.size(); ++i)
            other += !same(hits[i], (*expected)[i]);
    std::printf("  %-11s %9.2f %10.0f %8.0f   %zu of %zu differ\n", Structure::name,
                1e3 * build, 1e9 * ray_time,
                double(structure.bytes()) / double(mesh.size()), other, set.size());
    cells.rays.push_back(examples::text(1e9 * ray_time, "%.0f"));
    cells.build.push_back(examples::text(1e3 * build, "%.3g"));
    cells.bytes.push_back(
        examples::text(double(structure.bytes()) / double(mesh.size()), "%.0f"));
    return hits;
}

Cells compare_on(const char* name, const rays::Mesh& mesh, Vec3 eye, bool all_rays) {
    Cells cells;
    const Plain tree(mesh);
    const auto first_hit = [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
        const NearestHit found = tree.closest(ray);
        if (!found.found) return std::nullopt;
        return ljus::surface_point(mesh[found.number], ray, found.at);
    };
    auto sets = rays::ray_sets(first_hit, eye, Vec3{0}, {0, 1, 0}, {-0.5f, 2.5f, -0.5f},
                               {1, 0, 0}, {0, 0, 1}, all_rays ? 1000 : 300);
    // Rays of all kinds, in turn.
    std::vector<Ray> set;
    for (std::size_t i = 0; i < sets.diffuse.size(); ++i) {
        set.push_back(sets.diffuse[i]);
        if (i < sets.primary.size()) set.push_back(sets.primary[i]);
    }
    std::printf("%s, %zu triangles, %zu rays\n  %-11s %9s %10s %8s\n", name,
                mesh.size(), set.size(), "", "build, ms", "ns per ray", "bytes");
    // The loop gets only as many rays as it can trace in a few seconds.
    const std::size_t some =
        std::min(set.size(), all_rays ? set.size() : 100000000 / mesh.size());
    const std::span<const Ray> few(set.data(), some);
    const auto expected = row<Loop>(mesh, few, nullptr, cells);
    std::vector<NearestHit> of_all = row<rays::Grid>(mesh, set, nullptr, cells);
    std::size_t other = 0;
    for (std::size_t i = 0; i < some; ++i) other += !same(of_all[i], expected[i]);
    std::printf("  (the grid, against the loop: %zu of %zu differ)\n", other, some);
    row<rays::Octree>(mesh, set, &of_all, cells);
    row<rays::KdTree>(mesh, set, &of_all, cells);
    row<Plain>(mesh, set, &of_all, cells);
    row<Wide>(mesh, set, &of_all, cells);
    return cells;
}

} // namespace

/// Prints a table for each mesh. With `--all`: a million rays on a small mesh, all of
/// them compared with the loop.
int main(int argc, char** argv) {
    if (argc > 1 && std::string(argv[1]) == "--all") {
        compare_on("hills", rays::hills(400), {1.6f, 1.2f, 1.9f}, true);
        return 0;
    }
    const std::vector<std::string> structures{"loop",     "grid",       "octree",
                                              "k-d tree", "plain tree", "wide tree"};
    examples::Table times{.name = "bvh-structures",
                          .columns = {"ns per ray", "triangles"}};
    examples::Table builds{.name = "bvh-structures-build",
                           .columns = {"", "triangles"}};
    times.columns.insert(times.columns.end(), structures.begin(), structures.end());
    builds.columns.insert(builds.columns.end(), structures.begin() + 1,
                          structures.end());
    for (const std::string name : {"balls", "hills"})
        for (const int count : {100, 1000, 10000, 100000}) {
            const bool hills = name == "hills";
            const rays::Mesh mesh =
                hills ? rays::hills(count) : rays::balls(std::max(count, 192));
            const Cells cells =
                compare_on(name.c_str(), mesh,
                           hills ? Vec3{1.6f, 1.2f, 1.9f} : Vec3{0, 0.6f, 2.6f}, false);
            const auto add = [&](examples::Table& table, const std::string& what,
                                 const std::vector<std::string>& values,
                                 std::size_t first) {
                table.rows.push_back({what, std::to_string(mesh.size())});
                table.rows.back().insert(table.rows.back().end(),
                                         values.begin() + std::ptrdiff_t(first),
                                         values.end());
            };
            add(times, name, cells.rays, 0);
            if (count < 100000) continue; // the loop builds nothing
            add(builds, name + ": build, ms", cells.build, 1);
            add(builds, name + ": bytes per triangle", cells.bytes, 1);
        }
    const std::string folder = csv_folder(argc, argv);
    save_csv(folder, times);
    save_csv(folder, builds);
}
