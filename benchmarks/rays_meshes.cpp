/// \file rays_meshes.cpp
/// \brief The two trees over meshes of 6 000 to 125 000 triangles, Embree in its
/// default and its robust mode, and the eight-wide tree of tinybvh where it was fetched
/// (LJUS_PEERS).
///
/// bench_rays_meshes is tuned to the machine. bench_rays_meshes_core is compiled as a
/// program that tunes nothing, by -O2 with ljus::core, which chooses its instructions at
/// run time as Embree does.

#include <cstdio>

#ifdef LJUS_CORE
#include <ljus/core.hpp>
#endif
#include <ljus/accel/mesh.hpp>
#include <ljus/geometry/shape.hpp>

#include "csv.hpp"
#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

/// The plain tree; the test of a triangle is in double.
struct Plain {
    const rays::Mesh& mesh;
    ljus::Bvh tree = rays::plain_tree(mesh);
    float closest(const Ray& ray) const {
        const auto found =
            nearest_hit(tree, ray, [&](std::uint32_t place, const Ray& rest) {
                return ljus::intersect(rest, rays::triangle_at(tree, mesh, place));
            });
        return found.found ? found.at.t : -1;
    }
    bool any(const Ray& ray) const {
        return tree.any(ray, [&](std::uint32_t place) {
            return ljus::intersect(ray, rays::triangle_at(tree, mesh, place))
                .has_value();
        });
    }
};

/// The wide tree as a scene asks it: through the mesh that owns it, also in double.
struct Wide {
    ljus::Mesh mesh;
    float closest(const Ray& ray) const {
        const auto hit = ljus::intersect(ray, mesh);
        return hit ? hit->t : -1;
    }
    bool any(const Ray& ray) const { return ljus::meets(ray, mesh); }
};
/// A mesh whose triangles share no corner.
ljus::Mesh mesh_of(const rays::Mesh& triangles) {
    ljus::MeshData data;
    for (const Triangle& t : triangles) {
        const auto first = static_cast<std::uint32_t>(data.positions.size());
        data.positions.insert(data.positions.end(), {t.v1, t.v2, t.v3});
        data.triangles.push_back({first, first + 1, first + 2});
    }
    return ljus::Mesh(std::move(data), 1);
}

/// A row of the book's tables for one mesh: times over those of a peer, ray set
/// by ray set.
struct Ratios {
    std::vector<std::string> wide, robust, plain; ///< Embree's over ours.
    std::vector<std::string> tiny;                ///< tinybvh's over ours.
};

/// Traces all rays of a set, prints a row on the terminal and keeps the ratios.
template <typename... Peer>
void row(const char* name, const std::vector<Ray>& set, bool any, Ratios& ratios,
         const Peer&... peers) {
    const auto t = rays::compare(set, any, peers...);
    std::printf("%-10s %-8s", "", name);
    for (const double ns : t.nanoseconds) std::printf(" %9.1f", ns);
    std::printf("   wide x");
    for (const double ns : t.nanoseconds) std::printf(" %5.2f", ns / t.nanoseconds[1]);
    std::printf("   %s\n", t.sums[0] == t.sums[1] ? "same" : "DIFFERENT");
    std::fflush(stdout);
    const auto over = [&](std::size_t peer, std::size_t k) {
        return examples::text(t.nanoseconds[peer] / t.nanoseconds[k], "%.2f");
    };
    ratios.plain.push_back(over(2, 0));
    ratios.wide.push_back(over(2, 1));
    ratios.robust.push_back(over(3, 1));
    ratios.tiny.push_back(over(4, 1));
}

/// Rays from the camera of a mesh, from their hits, and to a lamp.
rays::RaySets sets_of(const rays::Named& named, const ljus::Mesh& mesh) {
    const auto first_hit = [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
        const auto hit = ljus::intersect(ray, mesh);
        if (!hit) return std::nullopt;
        return ljus::surface_point(mesh, ray, *hit);
    };
    const bool hills = named.name[0] == 'h';
    return rays::ray_sets(first_hit,
                          hills ? Vec3{1.6f, 1.2f, 1.9f} : Vec3{0, 0.6f, 2.6f}, Vec3{0},
                          {0, 1, 0}, {-0.5f, 2.5f, -0.5f}, {1, 0, 0}, {0, 0, 1});
}

/// The corners of a mesh, in the form that the peers expect.
std::vector<float> corners_of(const rays::Mesh& mesh) {
    std::vector<float> vertices;
    for (const Triangle& t : mesh)
        for (const Vec3& v : {t.v1, t.v2, t.v3})
            vertices.insert(vertices.end(), {v.x, v.y, v.z});
    return vertices;
}

/// Adds a row for a mesh: its name and size, and then these cells.
void add_row(examples::Table& table, const rays::Named& named,
             std::initializer_list<std::vector<std::string>> cells) {
    table.rows.push_back({named.name.substr(0, named.name.find(' ')),
                          std::to_string(named.mesh.size())});
    for (const std::vector<std::string>& some : cells)
        table.rows.back().insert(table.rows.back().end(), some.begin(), some.end());
}

} // namespace

/// Prints a row for each mesh and set of rays.
int main(int argc, char** argv) {
    const std::string folder = csv_folder(argc, argv);
#ifdef LJUS_CORE
    const char* const name = "bvh-embree-core";
#else
    const char* const name = "bvh-embree";
#endif
    examples::Table table{.name = name,
                          .columns = {"mesh", "triangles", "primary", "diffuse",
                                      "shadow", "robust Embree: primary", "diffuse",
                                      "shadow", "plain tree: primary", "diffuse",
                                      "shadow", "build time", "bytes per triangle"}};
    examples::Table tiny_table{.name = "bvh-tinybvh",
                               .columns = {"mesh", "triangles", "primary", "diffuse",
                                           "shadow", "build time",
                                           "tinybvh's bytes per triangle"}};
    std::printf("%-19s %9s %9s %9s %9s %9s\n", "", "plain, ns", "wide, ns", "Embree",
                "robust", "tinybvh");
    for (const rays::Named& named : rays::meshes()) {
        const Plain plain{named.mesh};
        const double start = rays::seconds();
        const ljus::TriangleBvh tree = rays::wide_tree(named.mesh);
        const double build = rays::seconds() - start;
        const Wide wide{mesh_of(named.mesh)};
        const rays::RaySets sets = sets_of(named, wide.mesh);
        const std::string bytes =
            examples::text(double(tree.bytes()) / double(named.mesh.size()), "%.0f");
        std::printf("%s: %s bytes per triangle, built in %.1f ms", named.name.c_str(),
                    bytes.c_str(), 1e3 * build);
        const std::vector<float> vertices = corners_of(named.mesh);
#ifdef LJUS_BENCH_EMBREE
        rays::Embree embree, robust(RTC_SCENE_FLAG_ROBUST);
        for (rays::Embree* const each : {&embree, &robust}) {
            each->add(RTC_GEOMETRY_TYPE_TRIANGLE, vertices, 3, 3);
            each->commit();
        }
        std::printf(", Embree in %.1f ms", 1e3 * embree.build);
        const std::string ratio = examples::text(build / embree.build, "%.2f");
#else
        const rays::NoPeer embree, robust;
        const std::string ratio;
#endif
#ifdef LJUS_BENCH_TINYBVH
        const rays::TinyBvh tiny(vertices);
        std::printf(", tinybvh in %.1f ms", 1e3 * tiny.build);
        const std::string tiny_ratio = examples::text(build / tiny.build, "%.2f");
        const std::string tiny_bytes =
            examples::text(tiny.bytes() / double(named.mesh.size()), "%.0f");
#else
        const rays::NoPeer tiny;
        const std::string tiny_ratio, tiny_bytes;
#endif
        std::printf("\n");
        Ratios ratios;
        row("primary", sets.primary, false, ratios, plain, wide, embree, robust, tiny);
        row("diffuse", sets.diffuse, false, ratios, plain, wide, embree, robust, tiny);
        row("shadow", sets.shadow, true, ratios, plain, wide, embree, robust, tiny);
        add_row(table, named,
                {ratios.wide, ratios.robust, ratios.plain, {ratio, bytes}});
        add_row(tiny_table, named, {ratios.tiny, {tiny_ratio, tiny_bytes}});
    }
    save_csv(folder, table);
#ifdef LJUS_BENCH_TINYBVH
    save_csv(folder, tiny_table);
#endif
}
