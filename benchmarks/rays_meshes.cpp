/// \file rays_meshes.cpp
/// \brief The two trees over meshes of 6 000 to 125 000 triangles, Embree, and the
/// eight-wide tree of tinybvh where it was fetched (LJUS_PEERS).

#include <cstdio>

#include <ljus/accel/triangle_bvh.hpp>
#include <ljus/geometry/shape.hpp>

#include "csv.hpp"
#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using ljus::NearestHit;
using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

/// One of the library's two trees; the test of a triangle is in double.
template <typename Tree>
struct House {
    const rays::Mesh& mesh;
    Tree tree;
    NearestHit nearest(const Ray& ray) const {
        NearestHit found;
        tree.closest(ray, [&](std::uint32_t place, Ray& rest) {
            const Triangle triangle = rays::triangle_at(tree, mesh, place);
            if (const auto hit = ljus::intersect<double>(rest, triangle))
                found.offer(*hit, tree.primitive_ids()[place], rest);
        });
        return found;
    }
    float closest(const Ray& ray) const {
        const NearestHit found = nearest(ray);
        return found.found ? found.at.t : -1;
    }
    bool any(const Ray& ray) const {
        return tree.any(ray, [&](std::uint32_t place) {
            const Triangle triangle = rays::triangle_at(tree, mesh, place);
            return ljus::intersect<double>(ray, triangle).has_value();
        });
    }
};

/// A row of the book's tables for one mesh: times over those of a peer, ray set
/// by ray set.
struct Ratios {
    std::vector<std::string> wide, plain; ///< Embree's over ours.
    std::vector<std::string> tiny;        ///< tinybvh's over ours.
};

/// Traces all rays of a set, prints a row on the terminal and keeps the ratios.
template <typename Embree, typename Tiny>
void row(const char* name, const std::vector<Ray>& set, bool any,
         const House<ljus::Bvh>& plain, const House<ljus::TriangleBvh>& wide,
         const Embree& embree, const Tiny& tiny, Ratios& ratios) {
    const auto t = rays::compare(set, any, plain, wide, embree, tiny);
    std::printf("%-10s %-8s %9.1f %9.1f %9.1f %9.1f   %15.2f %5.2f   %s\n", "", name,
                t.nanoseconds[0], t.nanoseconds[1], t.nanoseconds[2], t.nanoseconds[3],
                t.nanoseconds[2] / t.nanoseconds[0],
                t.nanoseconds[2] / t.nanoseconds[1],
                t.sums[0] == t.sums[1] ? "same" : "DIFFERENT");
    const auto over = [&](std::size_t peer, std::size_t k) {
        return examples::text(t.nanoseconds[peer] / t.nanoseconds[k], "%.2f");
    };
    ratios.plain.push_back(over(2, 0));
    ratios.wide.push_back(over(2, 1));
    ratios.tiny.push_back(over(3, 1));
}

/// Rays from the camera of a mesh, from their hits, and to a lamp.
rays::RaySets sets_of(const rays::Named& named, const House<ljus::TriangleBvh>& wide) {
    const auto first_hit = [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
        const NearestHit found = wide.nearest(ray);
        if (!found.found) return std::nullopt;
        return ljus::surface_point(named.mesh[found.number], ray, found.at);
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
    examples::Table table{.name = "bvh-embree",
                          .columns = {"mesh", "triangles", "primary", "diffuse",
                                      "shadow", "plain tree: primary", "diffuse",
                                      "shadow", "build time", "bytes per triangle"}};
    examples::Table tiny_table{.name = "bvh-tinybvh",
                               .columns = {"mesh", "triangles", "primary", "diffuse",
                                           "shadow", "build time",
                                           "tinybvh's bytes per triangle"}};
    std::printf("%-10s %-8s %9s %9s %9s %9s   x Embree: plain  wide\n", "", "",
                "plain, ns", "wide, ns", "Embree", "tinybvh");
    for (const rays::Named& named : rays::meshes()) {
        const rays::Mesh& mesh = named.mesh;
        const House<ljus::Bvh> plain{mesh, rays::plain_tree(mesh)};
        const double start = rays::seconds();
        const House<ljus::TriangleBvh> wide{mesh, rays::wide_tree(mesh)};
        const double build = rays::seconds() - start;
        const rays::RaySets sets = sets_of(named, wide);
        std::printf("%s: %zu triangles, %.1f bytes each, built in %.1f ms",
                    named.name.c_str(), mesh.size(),
                    double(wide.tree.bytes()) / double(mesh.size()), 1e3 * build);
        const std::vector<float> vertices = corners_of(mesh);
#ifdef LJUS_BENCH_EMBREE
        rays::Embree embree;
        embree.add(RTC_GEOMETRY_TYPE_TRIANGLE, vertices, 3, 3);
        embree.commit();
        std::printf(", Embree in %.1f ms", 1e3 * embree.build);
        const std::string ratio = examples::text(build / embree.build, "%.2f");
#else
        const rays::NoPeer embree;
        const std::string ratio;
#endif
#ifdef LJUS_BENCH_TINYBVH
        const rays::TinyBvh tiny(vertices);
        std::printf(", tinybvh in %.1f ms", 1e3 * tiny.build);
        const std::string tiny_ratio = examples::text(build / tiny.build, "%.2f");
        const std::string tiny_bytes =
            examples::text(tiny.bytes() / double(mesh.size()), "%.0f");
#else
        const rays::NoPeer tiny;
        const std::string tiny_ratio, tiny_bytes;
#endif
        std::printf("\n");
        Ratios ratios;
        row("primary", sets.primary, false, plain, wide, embree, tiny, ratios);
        row("diffuse", sets.diffuse, false, plain, wide, embree, tiny, ratios);
        row("shadow", sets.shadow, true, plain, wide, embree, tiny, ratios);
        const std::string bytes =
            examples::text(double(wide.tree.bytes()) / double(mesh.size()), "%.0f");
        add_row(table, named, {ratios.wide, ratios.plain, {ratio, bytes}});
        add_row(tiny_table, named, {ratios.tiny, {tiny_ratio, tiny_bytes}});
    }
    save_csv(folder, table);
#ifdef LJUS_BENCH_TINYBVH
    save_csv(folder, tiny_table);
#endif
}
