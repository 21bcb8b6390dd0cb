/// \file rays_meshes.cpp
/// \brief The two trees over meshes of 6 000 to 125 000 triangles, Embree, and the
/// eight-wide tree of tinybvh where it was fetched (LJUS_PEERS).

#include <cstdio>

#include <ljus/accel/detail/triangle_bvh.hpp>
#include <ljus/geometry/shape.hpp>

#include "csv.hpp"
#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using ljus::NearestHit;
using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;

namespace {

/// Either tree of the house; the triangles' own test is in double.
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
        const auto first_hit =
            [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
            const NearestHit found = wide.nearest(ray);
            if (!found.found) return std::nullopt;
            return ljus::surface_point(mesh[found.number], ray, found.at);
        };
        const bool hills = named.name[0] == 'h';
        const rays::RaySets sets = rays::ray_sets(
            first_hit, hills ? Vec3{1.6f, 1.2f, 1.9f} : Vec3{0, 0.6f, 2.6f}, Vec3{0},
            {0, 1, 0}, {-0.5f, 2.5f, -0.5f}, {1, 0, 0}, {0, 0, 1});
        std::printf("%s: %zu triangles, %.1f bytes each, built in %.1f ms",
                    named.name.c_str(), mesh.size(),
                    double(wide.tree.bytes()) / double(mesh.size()), 1e3 * build);
        std::vector<float> vertices;
        for (const Triangle& t : mesh)
            for (const Vec3& v : {t.v1, t.v2, t.v3})
                vertices.insert(vertices.end(), {v.x, v.y, v.z});
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
        std::vector<std::string> wide_ratios, plain_ratios, tiny_ratios;
        const auto row = [&](const char* name, const std::vector<Ray>& set, bool any) {
            const auto t = rays::compare(set, any, plain, wide, embree, tiny);
            std::printf("%-10s %-8s %9.1f %9.1f %9.1f %9.1f   %15.2f %5.2f   %s\n", "",
                        name, t.nanoseconds[0], t.nanoseconds[1], t.nanoseconds[2],
                        t.nanoseconds[3], t.nanoseconds[2] / t.nanoseconds[0],
                        t.nanoseconds[2] / t.nanoseconds[1],
                        t.sums[0] == t.sums[1] ? "same" : "DIFFERENT");
            const auto over = [&](std::size_t peer, std::size_t k) {
                return examples::text(t.nanoseconds[peer] / t.nanoseconds[k], "%.2f");
            };
            plain_ratios.push_back(over(2, 0));
            wide_ratios.push_back(over(2, 1));
            tiny_ratios.push_back(over(3, 1));
        };
        row("primary", sets.primary, false);
        row("diffuse", sets.diffuse, false);
        row("shadow", sets.shadow, true);
        table.rows.push_back(
            {named.name.substr(0, named.name.find(' ')), std::to_string(mesh.size())});
        std::vector<std::string>& cells = table.rows.back();
        cells.insert(cells.end(), wide_ratios.begin(), wide_ratios.end());
        cells.insert(cells.end(), plain_ratios.begin(), plain_ratios.end());
        cells.push_back(ratio);
        cells.push_back(
            examples::text(double(wide.tree.bytes()) / double(mesh.size()), "%.0f"));
        tiny_table.rows.push_back({table.rows.back()[0], table.rows.back()[1]});
        tiny_table.rows.back().insert(tiny_table.rows.back().end(), tiny_ratios.begin(),
                                      tiny_ratios.end());
        tiny_table.rows.back().push_back(tiny_ratio);
        tiny_table.rows.back().push_back(tiny_bytes);
    }
    save_csv(folder, table);
#ifdef LJUS_BENCH_TINYBVH
    save_csv(folder, tiny_table);
#endif
}
