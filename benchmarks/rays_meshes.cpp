/// \file rays_meshes.cpp
/// \brief The two trees over meshes of 6 000 to 125 000 triangles, and Embree.

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
                                      "shadow", "build time", "bytes a triangle"}};
    std::printf("%-10s %-8s %9s %9s %9s   x Embree: plain  wide\n", "", "", "plain, ns",
                "wide, ns", "Embree");
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
#ifdef LJUS_BENCH_EMBREE
        rays::Embree embree;
        std::vector<float> vertices;
        for (const Triangle& t : mesh)
            for (const Vec3& v : {t.v1, t.v2, t.v3})
                vertices.insert(vertices.end(), {v.x, v.y, v.z});
        embree.add(RTC_GEOMETRY_TYPE_TRIANGLE, vertices, 3, 3);
        embree.commit();
        std::printf(", Embree in %.1f ms", 1e3 * embree.build);
        const std::string ratio = examples::text(build / embree.build, "%.2f");
#else
        const rays::NoPeer embree;
        const std::string ratio;
#endif
        std::printf("\n");
        std::vector<std::string> wide_ratios, plain_ratios;
        const auto row = [&](const char* name, const std::vector<Ray>& set, bool any) {
            const auto t = rays::compare(set, any, plain, wide, embree);
            std::printf("%-10s %-8s %9.1f %9.1f %9.1f   %15.2f %5.2f   %s\n", "", name,
                        t.nanoseconds[0], t.nanoseconds[1], t.nanoseconds[2],
                        t.nanoseconds[2] / t.nanoseconds[0],
                        t.nanoseconds[2] / t.nanoseconds[1],
                        t.sums[0] == t.sums[1] ? "same" : "DIFFERENT");
            const auto to_embree = [&](std::size_t k) {
                return examples::text(t.nanoseconds[2] / t.nanoseconds[k], "%.2f");
            };
            plain_ratios.push_back(to_embree(0));
            wide_ratios.push_back(to_embree(1));
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
    }
    save_csv(folder, table);
}
