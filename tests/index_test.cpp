/// \file index_test.cpp
/// \brief The index of a scene gives the loop's answers, to the last bit.

#include "ljus/scene/index.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <limits>
#include <optional>
#include <type_traits>

#include "ljus/geometry/watertight.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scenes/report_rooms.hpp"
#include "support/numbers.hpp"
#include "support/quick_ball.hpp"

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

template <typename Compute, typename S, typename T>
bool same(const S& scene, const IndexedScene<S, Compute>& indexed, const RayT<T>& ray) {
    const auto a = closest_hit<Compute>(scene, ray);
    const auto b = closest_hit(indexed, ray);
    REQUIRE(a.has_value() == b.has_value());
    REQUIRE(occluded<Compute>(scene, ray) == a.has_value());
    REQUIRE(occluded(indexed, ray) == a.has_value());
    if (!a) return false;
    REQUIRE(a->object == b->object);
    REQUIRE(a->at.t == b->at.t);
    REQUIRE(a->at.u == b->at.u);
    REQUIRE(a->at.v == b->at.v);
    return true;
}

} // namespace

TEST_CASE_TEMPLATE("indexed scene: the loop's answers", Compute, double, Watertight,
                   void) {
    Numbers n;
    int hits = 0;
    for (const int count : {0, 1, 2, 4, 8, 9, 16, 40, 64, 256})
        for (const double scale : {1e-5, 1.0, 1e5})
            for (const double size : {0.3, 3.0}) {
                const auto scene = crowd<float>(n, count, 5 * scale, size * scale);
                const auto indexed = index_scene<Compute>(scene);
                for (int i = 0; i < 1500; ++i)
                    hits += same(scene, indexed, some_ray<float>(n, 5 * scale));
            }
    CHECK(hits > 10000);
}

TEST_CASE("indexed scene: in double, and for rays that are none") {
    Numbers n;
    for (const int count : {0, 3, 12, 200}) {
        const auto scene = crowd<double>(n, count, 5, 1);
        const auto indexed = index_scene(scene);
        for (int i = 0; i < 1000; ++i) same(scene, indexed, some_ray<double>(n, 5));
        constexpr double bad = std::numeric_limits<double>::quiet_NaN();
        CHECK_FALSE(same(scene, indexed, RayT<double>{.origin{bad, 0, 0}}));
        CHECK_FALSE(same(scene, indexed, RayT<double>{.direction{0, bad, 0}}));
        CHECK_FALSE(same(scene, indexed, RayT<double>{.t_max = bad}));
        CHECK_FALSE(same(scene, indexed, RayT<double>{.direction{0, 0, 0}}));
    }
}

TEST_CASE(
    "indexed scene: it stands for the scene in a renderer, which makes its own or "
    "takes one") {
    const auto room = all_materials_room();
    const RenderSettings picture{.width = 16, .height = 12, .samples = 4};
    const auto by_itself = render(make_path_tracer(room.scene), room.camera, picture);
    const auto indexed = index_scene(room.scene);
    const auto tracer = make_path_tracer(indexed);
    CHECK(&tracer.scene == &indexed);
    CHECK(render(tracer, room.camera, picture).image.pixels == by_itself.image.pixels);
    CHECK(indexed.size() == room.scene.size());
    CHECK(indexed.size() > detail::flat_loop_limit);
    CHECK(indexed.ids.size() == indexed.size());
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
template <typename S>
Ray hard_ray(Numbers& n, const S& scene) {
    const auto any = [&] {
        auto i = std::size_t(n.below(int(scene.size())));
        std::optional<Vec3> place;
        std::apply(
            [&](const auto&... lists) {
                const auto take = [&](const auto& list) {
                    if (!place && i < list.size()) place = place_on(n, list[i]);
                    i -= list.size();
                };
                (take(lists), ...);
            },
            scene.shapes);
        return *place;
    };
    const Vec3 from = any(), to = any();
    const SurfacePoint here{from, Vec3{2e-7f} * detail::sizes(from),
                            Vec3(n.direction())};
    if (n.below(2)) return spawn_ray(here, Vec3(n.direction()));
    const SurfacePoint there{to, Vec3{2e-7f} * detail::sizes(to), Vec3(n.direction())};
    if (n.below(2)) return spawn_ray_to(here, there);
    // Along the outline of a ball: at right angles to the way to its middle.
    const auto& balls = std::get<0>(scene.shapes);
    if (balls.empty()) return {.origin = from, .direction = to - from};
    const Sphere& ball = balls[std::size_t(n.below(int(balls.size())))];
    const Vec3 way = glm::normalize(from - ball.center);
    const Vec3 out = glm::normalize(glm::cross(way, Vec3(n.direction())));
    const Vec3 edge = ball.center + ball.radius * (out + 1e-4f * way);
    return {.origin = from, .direction = edge - from};
}

} // namespace

TEST_CASE("indexed scene: the loop's answers where rounding decides") {
    Numbers n;
    int hits = 0;
    for (const int count : {3, 9, 20, 32})
        for (const double room : {1.0, 30.0, 1e4})
            for (const double size : {0.01, 1.0, 30.0})
                for (int i = 0; i < 6; ++i) {
                    const auto scene = crowd<float>(n, count, room, size);
                    const auto indexed = index_scene(scene);
                    for (int k = 0; k < 500; ++k)
                        hits += same(scene, indexed, hard_ray(n, scene));
                }
    CHECK(hits > 10000);
}

TEST_CASE(
    "indexed scene: the loop's answers from far away, to a range that ends at a hit") {
    // From 1e6 away t is rounded by a tenth of a ball of radius 1.
    Numbers n;
    const auto scene = crowd<float>(n, 20, 5, 1);
    const auto indexed = index_scene(scene);
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin(n.power(1, 6) * n.direction());
        Ray ray{.origin = origin, .direction = Vec3(n.point(5)) - origin};
        const auto hit = closest_hit(scene, ray);
        if (!hit) continue;
        hits += same(scene, indexed, ray);
        ray.t_max = hit->at.t;
        hits += same(scene, indexed, ray);
        ray.t_min = hit->at.t;
        hits += same(scene, indexed, ray);
    }
    CHECK(hits > 2000);
}

TEST_CASE(
    "indexed scene: the loop's answers about small ones far from where rays begin") {
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
        const auto indexed = index_scene(scene);
        for (int k = 0; k < 240; ++k) {
            const auto j = std::size_t(n.below(4));
            const Vec3 to =
                k % 6 == 0   ? std::get<0>(scene.shapes)[j].center // t of all the least
                : k % 3 == 0 ? place_on(n, std::get<0>(scene.shapes)[j])
                : k % 3 == 1 ? place_on(n, std::get<1>(scene.shapes)[j])
                             : place_on(n, std::get<2>(scene.shapes)[j]);
            Ray ray{.origin = Vec3(n.point(1e-3 * far))};
            ray.direction = to - ray.origin;
            const auto hit = closest_hit(scene, ray);
            hits += same(scene, indexed, ray);
            if (!hit) continue;
            ray.t_max = hit->at.t; // a range of this hit alone
            hits += same(scene, indexed, ray);
            ray.t_min = hit->at.t;
            hits += same(scene, indexed, ray);
        }
    }
    CHECK(hits > 10000);
}

TEST_CASE_TEMPLATE(
    "indexed scene: too few shapes for a tree, in the precision asked for", Compute,
    float, double, Watertight) {
    // Rays that graze a far ball: float and double often disagree on whether they meet.
    Numbers n{5};
    for (const int count : {1, 2, 12}) {
        CrowdT<float> scene;
        const auto grey = scene.add(Lambertian{});
        for (int i = 0; i < count; ++i)
            scene.add(Sphere{.center{i < 1 ? 0.0f : 1e4f + 5 * float(i), 0, 0}}, grey);
        const auto indexed = index_scene<Compute>(scene);
        int hits = 0;
        for (int i = 0; i < 1000; ++i) {
            const glm::dvec3 out = n.direction(), side = n.direction();
            const glm::dvec3 edge = glm::normalize(glm::cross(out, side));
            const Vec3 from(300.0 * out);
            hits += same(scene, indexed,
                         Ray{.origin = from, .direction = Vec3(edge) - from});
        }
        CHECK(hits > 100);
        CHECK(hits < 990); // in double most of them meet it
    }
}

TEST_CASE("indexed scene: of many at one place the first wins, as in the loop") {
    for (const int count : {3, 20, 33, 100}) {
        CrowdT<float> scene;
        const auto grey = scene.add(Lambertian{});
        // Others before and behind, so that a tree does not keep their order.
        for (int i = 0; i < count; ++i) {
            const float z = i % 3 == 0 ? 0.0f : -1.0f - float(i % 7);
            scene.add(Quad{{-1, -1, z}, {2, 0, 0}, {0, 2, 0}}, grey);
            scene.add(Triangle{{-1, -1, z}, {1, -1, z}, {-1, 1, z}}, grey);
        }
        const auto indexed = index_scene(scene);
        for (const float x : {-0.9f, -0.5f, -0.1f, 0.3f})
            REQUIRE(
                same(scene, indexed, Ray{.origin{x, 0.2f, 5}, .direction{0, 0, -1}}));
    }
}

TEST_CASE("indexed scene: the frames of its flat shapes face as the objects do") {
    Scene<Shapes<Sphere, Quad, Triangle>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(Sphere{}, grey);
    scene.add(Quad{}, grey);
    scene.add(Quad{}, grey, Rgb{0}, true);
    scene.add(Triangle{{0, 0, 0}, {0, 1, 0}, {1, 0, 0}}, grey);
    const auto frames = detail::frames_of(scene);
    CHECK(frames[0].empty()); // of a ball there is no one normal
    REQUIRE(frames[1].size() == 2);
    REQUIRE(frames[2].size() == 1);
    CHECK(frames[1][0].normal == Vec3{0, 0, 1});
    CHECK(frames[1][1].normal == Vec3{0, 0, -1});
    CHECK(frames[2][0].normal == Vec3{0, 0, -1});
    CHECK(glm::dot(frames[1][1].tangent, frames[1][1].normal) == 0);
    CHECK(index_scene(scene).frames[1][1].normal == Vec3{0, 0, -1});
    // From how many shapes on there is a tree.
    CHECK_FALSE(detail::needs_tree(0));
    CHECK_FALSE(detail::needs_tree(2));
    CHECK(detail::needs_tree(3));
    Scene<Shapes<Sphere>, Materials<Lambertian>> two;
    const auto matt = two.add(Lambertian{});
    for (int i = 0; i < 2; ++i) two.add(Sphere{}, matt);
    CHECK(index_scene(two).ids.empty());
    two.add(Sphere{}, matt);
    CHECK(index_scene(two).ids.size() == 3);
    // It stands for the scene: what is asked of one is what the other says.
    const auto indexed = index_scene(scene);
    const ObjectId wall{1, 1};
    CHECK(&indexed.object(wall) == &scene.object(wall));
    CHECK(&indexed.lights == &scene.lights);
    CHECK(&indexed.materials == &scene.materials);
    CHECK(indexed.visit_shape(wall, [](const auto& s) { return sizeof(s); }) ==
          sizeof(Quad));
    CHECK(indexed.visit_material(grey, [](const auto& m) { return m.albedo.x; }) ==
          0.5f);
    using Indexed = std::remove_cvref_t<decltype(indexed)>;
    const auto is_quad = []<typename G>() { return std::is_same_v<G, Quad>; };
    const auto is_int = []<typename G>() { return std::is_same_v<G, int>; };
    CHECK(Indexed::any_shape(is_quad));
    CHECK_FALSE(Indexed::any_shape(is_int));
    CHECK_FALSE(Indexed::any_material(is_quad));
}

TEST_CASE("indexed scene: a shape that is quick to say so is asked whether it is met") {
    for (const int count : {1, 2, 3, 40}) {
        int asked = 0;
        Scene<Shapes<reader::Quick>, Materials<Lambertian>> scene;
        const auto grey = scene.add(Lambertian{});
        for (int i = 0; i < count; ++i)
            scene.add(reader::Quick{{{5.0f * float(i), 0, -5}, 1}, &asked}, grey);
        const auto indexed = index_scene(scene);
        CHECK(occluded(indexed, Ray{}));
        CHECK(asked == 1);
        CHECK(closest_hit(indexed, Ray{})->at.t == 4);
        CHECK(asked == 1);
        CHECK_FALSE(occluded(indexed, Ray{.direction{0, 1, 0}}));
        CHECK(asked <= 1 + (count < 3 ? count : 0)); // in a tree nobody is
    }
}
