/// \file world_test.cpp
/// \brief A closed scene: its tree gives the loop's answers, to the last bit, and the
/// loop those of asking each shape in another way; what is worked out once goes with
/// what it was made of.
///
/// A test of a mean gives a false alarm once in 1.7 million.

#include "ljus/scene/world.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <stdexcept>
#include <type_traits>
#include <vector>

#include "ljus/geometry/watertight.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/mean.hpp"
#include "support/numbers.hpp"
#include "support/quick_ball.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

template <typename T>
using CrowdT =
    Scene<Shapes<SphereT<T>, TriangleT<T>, QuadT<T>>, Materials<LambertianT<T>>>;

template <typename T>
CrowdT<T> crowd(Numbers& n, int count, double room, double size) {
    CrowdT<T> scene;
    const auto grey = scene.add(LambertianT<T>{});
    const auto at = [&](double where) { return Vec3T<T>(n.point(where)); };
    for (int i = 0; i < count; ++i) {
        const Vec3T<T> corner = at(room);
        switch (n.below(4)) {
        case 0:
            scene.add(SphereT<T>{corner, T(n.between(0.1, 1) * size)}, grey);
            break;
        case 1:
            scene.add(TriangleT<T>{corner, corner + at(size), corner + at(size)}, grey);
            break;
        case 2:
            scene.add(QuadT<T>{corner, at(size), at(size)}, grey);
            break;
        default: // one of those that are there once more, or a flat quad
            if (!std::get<0>(scene.shapes).empty() && n.below(2))
                scene.add(std::get<0>(scene.shapes).front(), grey);
            else
                scene.add(QuadT<T>{corner, {T(size), 0, 0}, {0, T(size), 0}}, grey);
        }
    }
    return scene;
}

template <typename T>
RayT<T> some_ray(Numbers& n, double room) {
    const Vec3T<T> origin(n.point(2 * room));
    RayT<T> ray{.origin = origin, .direction = Vec3T<T>(n.point(room)) - origin};
    for (int axis = 0; axis < 3; ++axis) {
        const int what = n.below(10);
        if (what == 0) ray.direction[axis] = T(0);
        if (what == 1) ray.direction[axis] = -T(0);
    }
    if (n.below(4) == 0) ray.t_max = T(n.between(0, 2));
    if (n.below(4) == 0) ray.t_min = T(n.between(0, 1));
    return ray;
}

template <AnyWorld W, typename T>
bool same(const W& world, const RayT<T>& ray) {
    const auto a = closest_hit_plain(world, ray);
    const auto b = closest_hit(world, ray);
    REQUIRE(a.has_value() == b.has_value());
    REQUIRE(occluded_plain(world, ray) == a.has_value());
    REQUIRE(occluded(world, ray) == a.has_value());
    if (!a) return false;
    REQUIRE(a->object == b->object);
    REQUIRE(a->at.t == b->at.t);
    REQUIRE(a->at.u == b->at.u);
    REQUIRE(a->at.v == b->at.v);
    return true;
}

/// Every hit of every object, nearest first; the earlier object on a tie.
std::vector<SceneHitT<float>> all_hits(const World<CrowdT<float>>& world,
                                       const Ray& ray) {
    std::vector<SceneHitT<float>> hits;
    for (std::uint32_t type = 0; type < 3; ++type)
        for (std::uint32_t i = 0; i < world.objects()[type].size(); ++i)
            world.visit_shape({type, i}, [&](const auto& shape) {
                if (const auto hit = intersect(ray, shape))
                    hits.push_back({as_hit(*hit), {type, i}});
            });
    std::stable_sort(hits.begin(), hits.end(),
                     [](const auto& a, const auto& b) { return a.at.t < b.at.t; });
    return hits;
}

} // namespace

TEST_CASE_TEMPLATE("world: the loop's answers", Compute, double, Watertight, void) {
    Numbers n;
    int hits = 0;
    for (const int count : {0, 1, 2, 4, 8, 9, 16, 40, 64, 256})
        for (const double scale : {1e-5, 1.0, 1e5})
            for (const double size : {0.3, 3.0}) {
                const World world(crowd<float>(n, count, 5 * scale, size * scale),
                                  compute_in<Compute>);
                for (int i = 0; i < 1500; ++i)
                    hits += same(world, some_ray<float>(n, 5 * scale));
            }
    CHECK(hits > 10000);
}

TEST_CASE("world: in double, and for rays that are none") {
    Numbers n;
    for (const int count : {0, 3, 12, 200}) {
        const World world(crowd<double>(n, count, 5, 1));
        for (int i = 0; i < 1000; ++i) same(world, some_ray<double>(n, 5));
        constexpr double bad = std::numeric_limits<double>::quiet_NaN();
        CHECK_FALSE(same(world, RayT<double>{.origin{bad, 0, 0}}));
        CHECK_FALSE(same(world, RayT<double>{.direction{0, bad, 0}}));
        CHECK_FALSE(same(world, RayT<double>{.t_max = bad}));
        CHECK_FALSE(same(world, RayT<double>{.direction{0, 0, 0}}));
    }
}

TEST_CASE("world: a renderer refers to it, and not to a temporary") {
    const World world(make_scene(placed(Sphere{}, Lambertian{})));
    const PathTracer tracer(world);
    CHECK(&tracer.world() == &world);
    using W = std::remove_const_t<decltype(world)>;
    static_assert(std::is_constructible_v<PathTracer<W>, const W&>);
    static_assert(std::is_constructible_v<PathTracer<W>, W&>);
    static_assert(!std::is_constructible_v<PathTracer<W>, W>);
    static_assert(AnyWorld<W> && !AnyWorld<CrowdT<float>> && !AnyWorld<int>);
}

namespace {

/// A point of a shape: one of its border where there is one, as often as not.
template <typename T>
Vec3T<T> place_on(Numbers& n, const QuadT<T>& quad) {
    const T u = n.below(2) ? T(n.below(2)) : T(n.next());
    const T v = n.below(2) ? T(n.below(2)) : T(n.next());
    return quad.corner + u * quad.edge_u + v * quad.edge_v;
}
template <typename T>
Vec3T<T> place_on(Numbers& n, const TriangleT<T>& triangle) {
    const T u = n.below(2) ? T(n.below(2)) : T(n.next());
    return triangle.v1 + u * (triangle.v2 - triangle.v1) +
           (n.below(2) ? T(0) : (T(1) - u) * T(n.next())) * (triangle.v3 - triangle.v1);
}
template <typename T>
Vec3T<T> place_on(Numbers& n, const SphereT<T>& ball) {
    return ball.center + ball.radius * Vec3T<T>(n.direction());
}

/// As a ray that leaves a shape has it, or one that meets its border or its outline.
template <AnyWorld W>
Ray hard_ray(Numbers& n, const W& world) {
    const auto any = [&] {
        auto i = std::size_t(n.below(int(world.size())));
        std::optional<Vec3> place;
        std::apply(
            [&](const auto&... lists) {
                const auto take = [&](const auto& list) {
                    if (!place && i < list.size()) place = place_on(n, list[i]);
                    i -= list.size();
                };
                (take(lists), ...);
            },
            world.shapes());
        return *place;
    };
    const Vec3 from = any(), to = any();
    const SurfacePoint here{from, Vec3{2e-7f} * detail::sizes(from),
                            Vec3(n.direction())};
    if (n.below(2)) return spawn_ray(here, Vec3(n.direction()));
    const SurfacePoint there{to, Vec3{2e-7f} * detail::sizes(to), Vec3(n.direction())};
    if (n.below(2)) return spawn_ray_to(here, there);
    // Along the outline of a ball: at right angles to the way to its middle.
    const auto& balls = std::get<0>(world.shapes());
    if (balls.empty()) return {.origin = from, .direction = to - from};
    const Sphere& ball = balls[std::size_t(n.below(int(balls.size())))];
    const Vec3 way = glm::normalize(from - ball.center);
    const Vec3 out = glm::normalize(glm::cross(way, Vec3(n.direction())));
    const Vec3 edge = ball.center + ball.radius * (out + 1e-4f * way);
    return {.origin = from, .direction = edge - from};
}

} // namespace

TEST_CASE("world: the loop's answers where rounding decides") {
    Numbers n;
    int hits = 0;
    for (const int count : {3, 9, 20, 32})
        for (const double room : {1.0, 30.0, 1e4})
            for (const double size : {0.01, 1.0, 30.0})
                for (int i = 0; i < 6; ++i) {
                    const World world(crowd<float>(n, count, room, size));
                    for (int k = 0; k < 500; ++k)
                        hits += same(world, hard_ray(n, world));
                }
    CHECK(hits > 10000);
}

TEST_CASE("world: the loop's answers from far away, to a range that ends at a hit") {
    // From 1e6 away t is rounded by a tenth of a ball of radius 1.
    Numbers n;
    const World world(crowd<float>(n, 20, 5, 1));
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin(n.power(1, 6) * n.direction());
        Ray ray{.origin = origin, .direction = Vec3(n.point(5)) - origin};
        const auto hit = closest_hit_plain(world, ray);
        if (!hit) continue;
        hits += same(world, ray);
        ray.t_max = hit->at.t;
        hits += same(world, ray);
        ray.t_min = hit->at.t;
        hits += same(world, ray);
    }
    CHECK(hits > 2000);
}

TEST_CASE("world: the loop's answers about small ones far from where rays begin") {
    // What is rounded there is the place of the shapes, in no number of the ray.
    Numbers n{3};
    int hits = 0;
    for (int repeat = 0; repeat < 80; ++repeat) {
        const double far = n.power(1, 5), size = far * n.power(-4, -1);
        CrowdT<float> scene;
        const auto grey = scene.add(Lambertian{});
        for (int i = 0; i < 4; ++i) {
            const auto at = [&] { return Vec3(far * n.direction()); };
            const auto edge = [&] { return Vec3(n.point(size)); };
            scene.add(Sphere{at(), float(size)}, grey);
            scene.add(Quad{at(), edge(), edge()}, grey);
            const Vec3 corner = at();
            scene.add(Triangle{corner, corner + edge(), corner + edge()}, grey);
        }
        const World world(std::move(scene));
        for (int k = 0; k < 240; ++k) {
            const auto j = std::size_t(n.below(4));
            const Vec3 to =
                k % 6 == 0 ? std::get<0>(world.shapes())[j].center // t of all the least
                : k % 3 == 0 ? place_on(n, std::get<0>(world.shapes())[j])
                : k % 3 == 1 ? place_on(n, std::get<1>(world.shapes())[j])
                             : place_on(n, std::get<2>(world.shapes())[j]);
            Ray ray{.origin = Vec3(n.point(1e-3 * far))};
            ray.direction = to - ray.origin;
            const auto hit = closest_hit_plain(world, ray);
            hits += same(world, ray);
            if (!hit) continue;
            ray.t_max = hit->at.t; // a range of this hit alone
            hits += same(world, ray);
            ray.t_min = hit->at.t;
            hits += same(world, ray);
        }
    }
    CHECK(hits > 10000);
}

TEST_CASE(
    "world: from so far away that nothing is left of a shape, the loop's answers") {
    Numbers n;
    const World world(crowd<float>(n, 12, 5, 1));
    for (const float far : {1e9f, 1e12f})
        for (int i = 0; i < 1000; ++i) {
            const Vec3 origin = far * Vec3(n.direction());
            same(world, Ray{.origin = origin, .direction = Vec3(n.point(5)) - origin});
        }
}

TEST_CASE("world: a tree is made of more than two shapes, in every precision") {
    Numbers n;
    for (const int count : {0, 1, 2, 3, 12, 33}) {
        const auto scene = crowd<float>(n, count, 5, 1);
        const std::size_t in_tree = count > 2 ? std::size_t(count) : 0;
        CHECK(detail::needs_tree(std::size_t(count)) == (count > 2));
        CHECK(World(scene).ids().size() == in_tree);
        CHECK(World(scene).tree().primitive_ids().size() == in_tree);
        CHECK(World(scene, compute_in<double>).ids().size() == in_tree);
        CHECK(World(crowd<double>(n, count, 5, 1)).ids().size() == in_tree);
        CHECK(World(scene).size() == std::size_t(count));
    }
}

TEST_CASE_TEMPLATE("world: too few shapes for a tree, in the precision asked for",
                   Compute, float, double, Watertight) {
    // Rays that graze a far ball: float and double often disagree on whether they meet.
    Numbers n{5};
    for (const int count : {1, 2, 12}) {
        CrowdT<float> scene;
        const auto grey = scene.add(Lambertian{});
        for (int i = 0; i < count; ++i)
            scene.add(Sphere{.center{i < 1 ? 0.0f : 1e4f + 5 * float(i), 0, 0}}, grey);
        const World world(std::move(scene), compute_in<Compute>);
        int hits = 0;
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 out = n.direction(), side = n.direction();
            const glm::dvec3 edge = glm::normalize(glm::cross(out, side));
            const Vec3 from(300.0 * out);
            hits += same(world, Ray{.origin = from, .direction = Vec3(edge) - from});
        }
        CHECK(hits > 100);
        CHECK(hits < 990); // in double most of them meet it
    }
}

TEST_CASE("world: of many at one place the first wins, as in the loop") {
    for (const int count : {3, 20, 33, 100}) {
        CrowdT<float> scene;
        const auto grey = scene.add(Lambertian{});
        // Others before and behind, so that a tree does not keep their order.
        for (int i = 0; i < count; ++i) {
            const float z = i % 3 == 0 ? 0.0f : -1.0f - float(i % 7);
            scene.add(Quad{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}}, grey);
            scene.add(Triangle{{-1, -1, z}, {1, -1, z}, {-1, 1, z}}, grey);
        }
        const World world(std::move(scene));
        for (const float x : {-0.9f, -0.5f, -0.1f, 0.3f})
            REQUIRE(same(world, Ray{.origin{x, 0.2f, 5}, .direction{0, 0, -1}}));
    }
}

TEST_CASE("world: the frames of its flat shapes face as the objects do") {
    Scene<Shapes<Sphere, Quad, Triangle>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(Sphere{}, grey);
    const ObjectId out = scene.add(Quad{}, grey);
    const ObjectId wall = scene.add(Quad{}, grey, Rgb{0}, true);
    const ObjectId face = scene.add(Triangle{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, grey);
    const World world(std::move(scene));
    CHECK(world.frame(out).normal == Vec3{0, 0, 1});
    CHECK(world.frame(wall).normal == Vec3{0, 0, -1});
    CHECK(world.frame(face).normal == Vec3{0, 0, -1});
    CHECK(glm::dot(world.frame(wall).tangent, world.frame(wall).normal) == 0);
    // What is asked of it, it knows by number and by type.
    CHECK(world.object(wall).inside_out);
    CHECK_FALSE(world.object(out).inside_out);
    CHECK(world.visit_shape(wall, [](const auto& s) { return sizeof(s); }) ==
          sizeof(Quad));
    CHECK(world.visit_material(grey, [](const auto& m) { return m.albedo.x; }) == 0.5f);
    using W = std::remove_cvref_t<decltype(world)>;
    const auto is_quad = []<typename G>() { return std::is_same_v<G, Quad>; };
    const auto is_int = []<typename G>() { return std::is_same_v<G, int>; };
    CHECK(W::any_shape(is_quad));
    CHECK_FALSE(W::any_shape(is_int));
    CHECK_FALSE(W::any_material(is_quad));
    CHECK_FALSE(W::any_light(is_quad));
}

TEST_CASE("world: a shape that is quick to say so is asked whether it is met") {
    for (const int count : {1, 2, 3, 40}) {
        int asked = 0;
        Scene<Shapes<reader::Quick>, Materials<Lambertian>> scene;
        const auto grey = scene.add(Lambertian{});
        for (int i = 0; i < count; ++i)
            scene.add(reader::Quick{{{5.0f * float(i), 0, -5}, 1}, &asked}, grey);
        const World world(std::move(scene));
        CHECK(occluded(world, Ray{}));
        CHECK(asked == 1);
        CHECK(closest_hit(world, Ray{})->at.t == 4);
        CHECK(asked == 1);
        CHECK_FALSE(occluded(world, Ray{.direction{0, 1, 0}}));
        CHECK(asked <= 1 + (count < 3 ? count : 0)); // in a tree nobody is
    }
}

TEST_CASE("world: the closest hit is the first of all hits, sorted") {
    Numbers n;
    int hits = 0, misses = 0;
    for (int k = 0; k < 50; ++k) {
        const World world(crowd<float>(n, 1 + n.below(30), 5, 2));
        for (int i = 0; i < 200; ++i) {
            const Vec3 origin(n.point(8));
            Ray ray{.origin = origin, .direction = 0.2f * (Vec3(n.point(5)) - origin)};
            if (i % 2) ray.t_min = float(n.between(0, 5));
            if (i % 3 == 0) ray.t_max = ray.t_min + float(n.between(0, 10));
            const auto expected = all_hits(world, ray);
            const auto found = closest_hit(world, ray);
            same(world, ray);
            REQUIRE(found.has_value() == !expected.empty());
            REQUIRE(occluded(world, ray) == !expected.empty());
            (found ? hits : misses) += 1;
            if (!found) continue;
            REQUIRE(found->object == expected[0].object);
            REQUIRE(found->at.t == expected[0].at.t);
            REQUIRE(found->at.u == expected[0].at.u);
            REQUIRE(found->at.v == expected[0].at.v);
        }
    }
    CHECK(hits > 1000);
    CHECK(misses > 1000);
}

TEST_CASE("world: on a tie the earlier object wins, and the earlier type") {
    CrowdT<float> scene;
    const auto grey = scene.add(Lambertian{});
    const Quad wall{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}};
    const Triangle half{{-1, -1, -4}, {1, -1, -4}, {-1, 1, -4}};
    scene.add(wall, grey);
    scene.add(wall, grey); // the same place
    const Ray ray{.origin{-0.5f, -0.5f, 0}};
    const auto first = [&] {
        const World world(scene);
        same(world, ray);
        return closest_hit(world, ray)->object;
    };
    CHECK(first() == ObjectId{2, 0});
    scene.add(half, grey); // added last, but its type is listed before
    CHECK(first() == ObjectId{1, 0});
    scene.add(Sphere{{-0.5f, -0.5f, -5}, 1}, grey); // touches the same point
    CHECK(first() == ObjectId{0, 0});
    CHECK(closest_hit(World(scene), ray)->at.t == 4.0f);
}

TEST_CASE("world: a hit at the very end of the ray's range counts") {
    const World world(
        make_scene(placed(Quad{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}}, Lambertian{})));
    for (const float t_max : {4.0f, std::numeric_limits<float>::infinity()}) {
        CHECK(closest_hit(world, Ray{.t_max = t_max}));
        CHECK(occluded(world, Ray{.t_max = t_max}));
    }
    CHECK_FALSE(closest_hit(world, Ray{.t_max = 3.999f}));
    CHECK_FALSE(occluded(world, Ray{.t_max = 3.999f}));
    CHECK_FALSE(occluded(world, Ray{.t_min = 4.001f}));
}

TEST_CASE("world: in an empty scene, and for bad rays, nothing is met") {
    const World empty(CrowdT<float>{});
    CHECK_FALSE(closest_hit(empty, Ray{}));
    CHECK_FALSE(occluded(empty, Ray{}));
    const World world(make_scene(placed(Sphere{.radius = 9}, Lambertian{})));
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Ray& bad : {Ray{.origin{nan, 0, 0}}, Ray{.direction{0, nan, 0}},
                           Ray{.direction = Vec3{0}}, Ray{.t_max = nan}}) {
        CHECK_FALSE(closest_hit(world, bad));
        CHECK_FALSE(occluded(world, bad));
    }
}

TEST_CASE("world: in the precision that is asked for, whether the first or any") {
    // Rays that graze a far ball: float and double often disagree on whether they meet.
    const Sphere ball{.radius = 1};
    const auto scene = make_scene(placed(ball, Lambertian{}));
    const World floats(scene, compute_in<float>);
    const World doubles(scene, compute_in<double>);
    Numbers n{5};
    int differ = 0;
    for (int i = 0; i < 3000; ++i) {
        const glm::dvec3 out = n.direction(), side = n.direction();
        const glm::dvec3 edge = glm::normalize(glm::cross(out, side));
        const Vec3 from(300.0 * out);
        const Ray ray{.origin = from, .direction = Vec3(edge) - from};
        const bool in_float = intersect<float>(ray, ball).has_value();
        const bool in_double = intersect<double>(ray, ball).has_value();
        differ += in_float != in_double;
        REQUIRE(closest_hit(floats, ray).has_value() == in_float);
        REQUIRE(occluded(floats, ray) == in_float);
        REQUIRE(closest_hit(doubles, ray).has_value() == in_double);
        REQUIRE(occluded(doubles, ray) == in_double);
    }
    CHECK(differ > 100);
}

TEST_CASE("world: of shapes that are quick to say so the first that is met will do") {
    int asked = 0;
    Scene<Shapes<Sphere, reader::Quick>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(reader::Quick{{{0, 0, -5}, 1}, &asked}, grey);
    scene.add(reader::Quick{{{0, 0, -9}, 1}, &asked}, grey);
    const World two(scene);
    CHECK(occluded(two, Ray{}));
    CHECK(asked == 1); // the first that is met will do
    CHECK_FALSE(occluded(two, Ray{.direction{0, 0, 1}}));
    CHECK(asked == 3);
    const auto hit = closest_hit(two, Ray{});
    REQUIRE(hit);
    CHECK(hit->object == ObjectId{1, 0});
    CHECK(hit->at.t == 4);
    CHECK(asked == 3);                         // where it is met it cannot say
    scene.add(Sphere{{0, 0, -2}, 0.5f}, grey); // asked before, as its type is
    CHECK(occluded_plain(World(scene), Ray{}));
    CHECK(asked == 3);
}

namespace {

/// The lamp of a room of two, made as long as one asks in the array of its shapes.
auto room_with_lamp(float length) {
    Scene<Shapes<Quad>, Materials<Lambertian>> scene;
    const auto matt = scene.add(Lambertian{.albedo = Rgb{0.8f}});
    scene.add(Quad{{-2, 0, 2}, {4, 0, 0}, {0, 0, -4}}, matt);
    scene.add(Quad{{-0.5f, 1, -0.5f}, {1, 0, 0}, {0, 0, 1}}, matt, Rgb{2});
    std::get<0>(scene.shapes)[1].edge_u = Vec3{length, 0, 0};
    return scene;
}

} // namespace

TEST_CASE("world: a lamp that was made longer in its array is longer in all that is") {
    const World once(room_with_lamp(1)), twice(room_with_lamp(2));
    CHECK(twice.powers()[0] == 2.0f * once.powers()[0]);
    CHECK(twice.light_choice().cumulative.back() ==
          2 * once.light_choice().cumulative.back());
    twice.visit_light(0, [](const auto& lamp) { CHECK(lamp.lamp.area == 2); });
    // By shadow rays, by paths alone and by both together the floor is as bright.
    const auto floor_by = [&](const PathTracingSettings& settings) {
        const PathTracer tracer(twice, settings);
        return ljus_test::mean_radiance(tracer, 100000, 3, [](auto&) {
            return Ray{.origin{0.5f, 0.5f, 0}, .direction{0, -1, 0}};
        });
    };
    const auto by_shadow_rays = floor_by({.heuristic = MisHeuristic::shadow_rays});
    CHECK(by_shadow_rays.mean > 0.1);
    using ljus_test::apart;
    CHECK(std::abs(apart(by_shadow_rays, floor_by({.sample_lights = false}))) < 5);
    for (const MisHeuristic both : {MisHeuristic::balance, MisHeuristic::power})
        CHECK(std::abs(apart(by_shadow_rays, floor_by({.heuristic = both}))) < 5);
}

TEST_CASE("world: what was changed in place is checked, what grew past add() refused") {
    using ljus_test::refusal;
    const auto close = [](const auto& scene) {
        return refusal([&] { World world(scene); });
    };
    const auto sound = room_with_lamp(1);
    CHECK(close(sound).empty());
    auto grown = sound;
    std::get<0>(grown.shapes).push_back(Quad{});
    CHECK(close(grown) ==
          "the number of shapes is 3; it must be the number of their objects: "
          "add shapes by add().");
    auto shrunk = sound;
    std::get<0>(shrunk.shapes).pop_back();
    CHECK(close(shrunk).find("the number of shapes is 1;") == 0);
    auto flat = sound;
    std::get<0>(flat.shapes)[1].edge_u = Vec3{0};
    CHECK(close(flat) == "the area of a light is 0; it must be finite and above 0.");
    auto broken = sound;
    std::get<0>(broken.shapes)[0].corner.y = std::numeric_limits<float>::infinity();
    CHECK(close(broken).find("quad.corner is (-2, infinity, 2);") == 0);
    auto made_of_nothing = sound;
    made_of_nothing.objects[0][0].material = {0, 7};
    CHECK(close(made_of_nothing) ==
          "the material's number is 7; it must be one that add() returned.");
    auto negative = sound;
    negative.objects[0][0].emission = Rgb{-1};
    CHECK(close(negative).find("emission is (-1, -1, -1);") == 0);
    Scene<Shapes<Sphere>, Materials<Lambertian>, Lights<PointLight>> bulbs;
    bulbs.add(PointLight{});
    auto dark = bulbs;
    std::get<0>(dark.lights)[0].intensity = Rgb{-1};
    CHECK(close(dark).find("point light.intensity is (-1, -1, -1);") == 0);
    // The order lists each object and each light once.
    const auto not_listed = [&](auto scene, const auto& change) {
        change(scene);
        CHECK(close(scene) == "the number of entries in Scene::order is " +
                                  std::to_string(scene.order.size()) +
                                  "; it must be one for each shape and light: add them "
                                  "by add().");
    };
    not_listed(bulbs, [](auto& s) { std::get<0>(s.lights).push_back(PointLight{}); });
    not_listed(bulbs, [](auto& s) { std::get<0>(s.lights).clear(); });
    not_listed(bulbs, [](auto& s) { s.order.push_back(s.order[0]); });
    not_listed(bulbs, [](auto& s) { s.order[0].index = 1; });
    not_listed(bulbs, [](auto& s) { s.order[0].type = 1; });
    not_listed(sound, [](auto& s) { s.order[0].type = 1; });
    not_listed(sound, [](auto& s) { s.order.clear(); });
    not_listed(sound, [](auto& s) {
        std::get<0>(s.shapes).push_back(std::get<0>(s.shapes)[0]);
        s.objects[0].push_back({.material = {0, 7}});
    });
    // An object whose emission was set in place is a light as any other.
    auto shining = sound;
    shining.objects[0][0].emission = Rgb{1};
    CHECK(shining.light_count() == 2);
    CHECK(World(shining).light_count() == 2);
    CHECK(World(shining).powers()[0] == 8.0f * World(sound).powers()[0]);
}
