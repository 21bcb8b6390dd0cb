/// \file rays_room.cpp
/// \brief The report's room: its own style of loop, the house's loop and index, and
/// Embree; and the path tracer's rays a second.

#include <cstdio>
#include <memory>

#include <ljus/ljus.hpp>

#include "rays_scenes.hpp"
#include "rays_timing.hpp"

using ljus::Ray;
using ljus::Vec3;

namespace {

/// The report's style: a base class, a virtual function, shared pointers.
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
    template <typename Scene>
    explicit Virtual(const Scene& scene) {
        const auto add = [&](const auto& shapes) {
            for (const auto& shape : shapes)
                objects.push_back(
                    std::make_shared<ObjectOf<std::decay_t<decltype(shape)>>>(shape));
        };
        std::apply([&](const auto&... shapes) { (add(shapes), ...); }, scene.shapes);
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

/// The loop, or the index.
template <typename Scene>
struct House {
    const Scene& scene;
    float closest(const Ray& ray) const {
        const auto hit = closest_hit(scene, ray);
        return hit ? hit->at.t : -1;
    }
    bool any(const Ray& ray) const { return occluded(scene, ray); }
};

#ifdef LJUS_BENCH_EMBREE
template <typename Scene>
void add_to(rays::Embree& embree, const Scene& scene) {
    std::vector<float> quads, spheres, triangles;
    const auto put = [](std::vector<float>& to, const Vec3& v) {
        to.insert(to.end(), {v.x, v.y, v.z});
    };
    for (const ljus::Quad& q : std::get<0>(scene.shapes)) {
        put(quads, q.corner);
        put(quads, q.corner + q.edge_u);
        put(quads, q.corner + q.edge_u + q.edge_v);
        put(quads, q.corner + q.edge_v);
    }
    for (const ljus::Sphere& s : std::get<1>(scene.shapes)) {
        put(spheres, s.center);
        spheres.push_back(s.radius);
    }
    for (const ljus::Triangle& t : std::get<2>(scene.shapes))
        for (const Vec3& v : {t.v1, t.v2, t.v3}) put(triangles, v);
    embree.add(RTC_GEOMETRY_TYPE_QUAD, quads, 3, 4);
    embree.add(RTC_GEOMETRY_TYPE_TRIANGLE, triangles, 3, 3);
    embree.add(RTC_GEOMETRY_TYPE_SPHERE_POINT, spheres, 4, 0);
    embree.commit();
}
#endif

} // namespace

/// Prints a row for each set of rays, and the path tracer's speed.
int main() {
    const auto room = ljus::final_room();
    const auto& scene = room.scene;
    const auto indexed = ljus::index_scene(scene);
    const auto in_double = ljus::index_scene<double>(scene);
    const Virtual objects(scene);
    const House loop{scene};
    const House index{indexed};
    const House index_double{in_double};
#ifdef LJUS_BENCH_EMBREE
    rays::Embree embree;
    add_to(embree, scene);
#else
    const House embree{indexed}; // no peer
#endif
    const auto first_hit = [&](const Ray& ray) -> std::optional<ljus::SurfacePoint> {
        const auto hit = closest_hit(scene, ray);
        if (!hit) return std::nullopt;
        return surface_at(scene, ray, *hit).point;
    };
    const ljus::Quad& lamp = std::get<0>(scene.shapes)[scene.lights[0].object->index];
    const Ray middle = primary_ray(room.camera, ljus::Vec2{200, 200}, 400, 400);
    const rays::RaySets sets =
        rays::ray_sets(first_hit, middle.origin, middle.origin + middle.direction,
                       {0, 0, 1}, lamp.corner, lamp.edge_u, lamp.edge_v);
    std::printf("ns a ray, %zu objects\n%-8s %8s %8s %8s %8s %8s\n", scene.size(), "",
                "virtual", "loop", "index", "double", "Embree");
    const auto row = [&](const char* name, const std::vector<Ray>& set, bool any) {
        const auto t =
            rays::compare(set, any, objects, loop, index, index_double, embree);
        std::printf("%-8s", name);
        for (const double ns : t.nanoseconds) std::printf(" %8.1f", ns);
        std::printf("   index: %.2f x virtual, %.2f x Embree\n",
                    t.nanoseconds[0] / t.nanoseconds[2],
                    t.nanoseconds[4] / t.nanoseconds[2]);
    };
    row("primary", sets.primary, false);
    row("diffuse", sets.diffuse, false);
    row("shadow", sets.shadow, true);

    const auto tracer = make_path_tracer(indexed);
    double best = 0;
    for (int run = 0; run < 7; ++run) {
        const double start = rays::seconds();
        const auto result =
            render(tracer, room.camera,
                   {.width = 100, .height = 100, .rays = 8, .threads = 1});
        best = std::max(best, double(result.counts.rays()) / (rays::seconds() - start));
    }
    std::printf("path tracing: %.2f million rays a second and thread\n", best / 1e6);
}
