/// \file rays_room.cpp
/// \brief The report's room: its own style of loop, the library's loop and index, and
/// Embree.

#include <algorithm>
#include <cstdio>
#include <memory>

#include <ljus/ljus.hpp>
#include <ljus/scenes/report_rooms.hpp>

#include "csv.hpp"
#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using ljus::Ray;
using ljus::Vec3;

namespace {

/// What the report's program does, by its text and its structure: triangles and spheres
/// only, so that a quad is two of them; groups of pointers to a base class; a virtual
/// function that solves the printed equations, regardless of nearer hits; and
/// the first hit for a shadow ray, too, which is then compared with the lamp.
namespace report {

struct Primitive {
    virtual ~Primitive() = default;
    virtual bool intersect(const Ray& ray, float& t) const = 0;
};

struct Sphere : Primitive {
    Vec3 center;
    float radius;
    Sphere(const Vec3& c, float r) : center(c), radius(r) {}
    bool intersect(const Ray& ray, float& t) const override {
        const Vec3 to = ray.origin - center; // t^2 + u t + v = 0
        const float half_u = glm::dot(ray.direction, to);
        const float v = glm::dot(to, to) - radius * radius;
        const float inside = half_u * half_u - v;
        if (inside < 0) return false;
        const float root = std::sqrt(inside);
        t = -half_u - root;
        if (t < 0) t = -half_u + root;
        return t > 0;
    }
};

struct Triangle : Primitive {
    Vec3 v1, v2, v3;
    Triangle(const Vec3& a, const Vec3& b, const Vec3& c) : v1(a), v2(b), v3(c) {}
    bool intersect(const Ray& ray, float& t) const override {
        const Vec3 e1 = v2 - v1, e2 = v3 - v1, to = ray.origin - v1;
        const Vec3 p = glm::cross(ray.direction, e2);
        const float inverse = 1 / glm::dot(p, e1);
        const float u = glm::dot(p, to) * inverse;
        if (!(u >= 0 && u <= 1)) return false;
        const Vec3 q = glm::cross(to, e1);
        const float v = glm::dot(q, ray.direction) * inverse;
        if (!(v >= 0 && u + v <= 1)) return false;
        t = glm::dot(q, e2) * inverse;
        return t > 0;
    }
};

struct Loop {
    struct Group {
        std::vector<std::unique_ptr<Primitive>> primitives;
    };
    std::vector<Group> groups;
    std::size_t size = 0;

    explicit Loop(const ljus::AnyWorld auto& world) {
        const auto add = [&](auto... made) {
            size += sizeof...(made);
            groups.emplace_back();
            (groups.back().primitives.emplace_back(made), ...);
        };
        for (const ljus::Quad& q : std::get<0>(world.shapes())) {
            const Vec3 a = q.corner, b = a + q.edge_u, c = b + q.edge_v;
            add(new Triangle(a, b, c), new Triangle(c, a + q.edge_v, a));
        }
        for (const ljus::Sphere& s : std::get<1>(world.shapes()))
            add(new Sphere(s.center, s.radius));
        for (const ljus::Triangle& t : std::get<2>(world.shapes()))
            add(new Triangle(t.v1, t.v2, t.v3));
    }
    bool first(const Ray& ray, std::size_t& group, std::size_t& primitive,
               float& t) const {
        float nearest = std::numeric_limits<float>::max();
        for (std::size_t i = 0; i < groups.size(); ++i)
            for (std::size_t k = 0; k < groups[i].primitives.size(); ++k)
                if (groups[i].primitives[k]->intersect(ray, t) && t < nearest) {
                    nearest = t;
                    group = i;
                    primitive = k;
                }
        t = nearest;
        return nearest < std::numeric_limits<float>::max();
    }
    float closest(const Ray& ray) const {
        std::size_t group = 0, primitive = 0;
        float t = 0;
        return first(ray, group, primitive, t) ? t : -1;
    }
    bool any(const Ray& ray) const {
        std::size_t group = 0, primitive = 0;
        float t = 0;
        return first(ray, group, primitive, t) && t < ray.t_max;
    }
};

} // namespace report

/// The best version of that idea: the library's tests and its 22 shapes behind a
/// virtual function, and a shadow ray that stops at the first hit.
struct Object {
    virtual ~Object() = default;
    virtual bool intersect(const Ray& ray, float& t) const = 0;
};

template <typename Shape>
struct ObjectOf : Object {
    Shape shape;
    explicit ObjectOf(const Shape& of) : shape(of) {}
    bool intersect(const Ray& ray, float& t) const override {
        const auto hit = ljus::intersect(ray, shape);
        if (hit) t = ljus::as_hit(*hit).t;
        return hit.has_value();
    }
};

struct Virtual {
    std::vector<std::shared_ptr<Object>> objects;
    explicit Virtual(const ljus::AnyWorld auto& world) {
        const auto add = [&](const auto& shapes) {
            for (const auto& shape : shapes)
                objects.push_back(
                    std::make_shared<ObjectOf<std::decay_t<decltype(shape)>>>(shape));
        };
        std::apply([&](const auto&... shapes) { (add(shapes), ...); }, world.shapes());
    }
    float closest(const Ray& ray) const {
        float nearest = -1;
        std::shared_ptr<Object> hit;
        for (const auto& object : objects) {
            float t = 0;
            if (object->intersect(ray, t) && (nearest < 0 || t < nearest)) {
                nearest = t;
                hit = object;
            }
        }
        return nearest;
    }
    bool any(const Ray& ray) const {
        float t = 0;
        for (const auto& object : objects)
            if (object->intersect(ray, t)) return true;
        return false;
    }
};

/// The library's loop over all shapes.
template <typename W>
struct InTurn {
    const W& world;
    float closest(const Ray& ray) const {
        const auto hit = closest_hit_plain(world, ray);
        return hit ? hit->at.t : -1;
    }
    bool any(const Ray& ray) const { return occluded_plain(world, ray); }
};
template <typename W>
InTurn(const W&) -> InTurn<W>; // clang finds it by itself from version 17 on

/// The library's tree; for one or two shapes, its loop.
template <typename W>
struct ByTree {
    const W& world;
    float closest(const Ray& ray) const {
        const auto hit = closest_hit(world, ray);
        return hit ? hit->at.t : -1;
    }
    bool any(const Ray& ray) const { return occluded(world, ray); }
};
template <typename W>
ByTree(const W&) -> ByTree<W>;

/// The same shapes with intersections in double. It has no lights: only
/// rays are cast in it.
template <typename S>
auto in_double(const ljus::World<S>& world) {
    S scene;
    scene.shapes = world.shapes();
    scene.objects = world.objects();
    scene.materials = world.materials();
    return ljus::World(std::move(scene), ljus::compute_in<double>);
}

#ifdef LJUS_BENCH_EMBREE
void add_to(rays::Embree& embree, const ljus::AnyWorld auto& world) {
    std::vector<float> quads, spheres, triangles;
    const auto put = [](std::vector<float>& to, const Vec3& v) {
        to.insert(to.end(), {v.x, v.y, v.z});
    };
    for (const ljus::Quad& q : std::get<0>(world.shapes())) {
        put(quads, q.corner);
        put(quads, q.corner + q.edge_u);
        put(quads, q.corner + q.edge_u + q.edge_v);
        put(quads, q.corner + q.edge_v);
    }
    for (const ljus::Sphere& s : std::get<1>(world.shapes())) {
        put(spheres, s.center);
        spheres.push_back(s.radius);
    }
    for (const ljus::Triangle& t : std::get<2>(world.shapes()))
        for (const Vec3& v : {t.v1, t.v2, t.v3}) put(triangles, v);
    embree.add(RTC_GEOMETRY_TYPE_QUAD, quads, 3, 4);
    embree.add(RTC_GEOMETRY_TYPE_TRIANGLE, triangles, 3, 3);
    embree.add(RTC_GEOMETRY_TYPE_SPHERE_POINT, spheres, 4, 0);
    embree.commit();
}
#endif

/// The number of objects from which the tree is faster: the room, cut down to its first
/// few.
void print_crossover(const ljus::AnyWorld auto& whole, const std::vector<Ray>& set,
                     const std::string& folder) {
    examples::Table table{
        .name = "bvh-first", .columns = {"objects"}, .rows = {{"loop"}, {"wide tree"}}};
    using Part = ljus::Scene<ljus::Shapes<ljus::Quad, ljus::Sphere, ljus::Triangle>,
                             ljus::Materials<ljus::Lambertian>>;
    std::printf("\ndiffuse rays, the first objects only, ns per ray\n%8s %8s %8s\n",
                "objects", "loop", "tree");
    for (const std::size_t count : {1u, 2u, 3u, 4u, 6u, 8u, 12u, 16u, 22u}) {
        Part part;
        const auto matt = part.add(ljus::Lambertian{});
        const auto add = [&](const auto& shapes) {
            for (const auto& shape : shapes)
                if (part.size() < count) part.add(shape, matt);
        };
        std::apply([&](const auto&... shapes) { (add(shapes), ...); }, whole.shapes());
        const ljus::World world(std::move(part));
        const InTurn loop{world};
        const ByTree tree{world};
        const auto t = rays::compare(set, false, loop, tree);
        std::printf("%8zu %8.1f %8.1f\n", count, t.nanoseconds[0], t.nanoseconds[1]);
        table.columns.push_back(std::to_string(count));
        for (const std::size_t k : {0u, 1u})
            table.rows[k].push_back(examples::text(t.nanoseconds[k], "%.0f"));
    }
    save_csv(folder, table);
}

} // namespace

/// Prints a row for each set of rays, and the crossover.
int main(int argc, char** argv) {
    const std::string folder = csv_folder(argc, argv);
    examples::Table table{.name = "bvh-room",
                          .columns = {"ns per ray", "report", "virtual", "loop",
                                      "wide tree", "all in double", "Embree",
                                      "report / tree", "virtual / tree",
                                      "Embree / tree"}};
    const auto room = ljus::final_room();
    const auto& world = room.world;
    const auto world_in_double = in_double(world);
    const report::Loop as_report(world);
    const Virtual objects(world);
    const InTurn loop{world};
    const ByTree tree{world};
    const ByTree tree_in_double{world_in_double};
#ifdef LJUS_BENCH_EMBREE
    rays::Embree embree;
    add_to(embree, world);
#else
    const rays::NoPeer embree;
#endif
    const auto first_hit = [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
        const auto hit = closest_hit(world, ray);
        if (!hit) return std::nullopt;
        return vertex_at(world, ray, *hit).point;
    };
    const auto is_lamp = [](const auto& object) { return object.light == 0; };
    const auto& quads = world.objects()[0];
    const ljus::Quad& lamp = std::get<0>(world.shapes())[std::size_t(
        std::find_if(quads.begin(), quads.end(), is_lamp) - quads.begin())];
    const Ray middle = primary_ray(room.camera, ljus::Vec2{200, 200}, 400, 400);
    const rays::RaySets sets =
        rays::ray_sets(first_hit, middle.origin, middle.origin + middle.direction,
                       {0, 0, 1}, lamp.corner, lamp.edge_u, lamp.edge_v);
    std::printf("ns per ray; %zu objects, as the report has them %zu\n", world.size(),
                as_report.size);
    std::printf("%-8s %8s %8s %8s %8s %8s %8s   tree x report, virtual, Embree\n", "",
                "report", "virtual", "loop", "tree", "double", "Embree");
    const auto row = [&](const char* name, const std::vector<Ray>& set, bool any) {
        const auto t = rays::compare(set, any, as_report, objects, loop, tree,
                                     tree_in_double, embree);
        table.rows.push_back({name});
        std::vector<std::string>& cells = table.rows.back();
        std::printf("%-8s", name);
        for (const double ns : t.nanoseconds) {
            std::printf(" %8.1f", ns);
            cells.push_back(examples::text(ns, "%.0f"));
        }
        for (const std::size_t k : {std::size_t(0), std::size_t(1), std::size_t(5)}) {
            std::printf("   %.2f", t.nanoseconds[k] / t.nanoseconds[3]);
            cells.push_back(
                examples::text(t.nanoseconds[k] / t.nanoseconds[3], "%.1f"));
        }
        std::printf("\n");
    };
    row("primary", sets.primary, false);
    row("diffuse", sets.diffuse, false);
    row("shadow", sets.shadow, true);

    save_csv(folder, table);
    print_crossover(world, sets.diffuse, folder);
}
