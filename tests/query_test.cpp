/// \file query_test.cpp
/// \brief The first object that a ray meets, against asking each in another way.

#include "ljus/scene/query.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <vector>

#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/numbers.hpp"
#include "support/quick_ball.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

using Crowd = Scene<Shapes<Sphere, Triangle, Quad>, Materials<Lambertian>>;

Crowd crowd(Numbers& n, int of_each) {
    Crowd scene;
    const auto grey = scene.add(Lambertian{});
    for (int i = 0; i < of_each; ++i) {
        scene.add(Sphere{Vec3(n.point(5)), float(n.between(0.1, 1))}, grey);
        const Vec3 corner(n.point(5));
        scene.add(
            Triangle{corner, corner + Vec3(n.point(2)), corner + Vec3(n.point(2))},
            grey);
        scene.add(Quad{Vec3(n.point(5)), Vec3(n.point(2)), Vec3(n.point(2))}, grey);
    }
    return scene;
}

/// Every hit of every object, nearest first; the earlier object on a tie.
std::vector<SceneHitT<float>> all_hits(const Crowd& scene, const Ray& ray) {
    std::vector<SceneHitT<float>> hits;
    for (std::uint32_t type = 0; type < 3; ++type)
        for (std::uint32_t i = 0; i < scene.objects[type].size(); ++i)
            scene.visit_shape({type, i}, [&](const auto& shape) {
                if (const auto hit = intersect(ray, shape))
                    hits.push_back({as_hit(*hit), {type, i}});
            });
    std::stable_sort(hits.begin(), hits.end(),
                     [](const auto& a, const auto& b) { return a.at.t < b.at.t; });
    return hits;
}

} // namespace

TEST_CASE("query: the closest hit is the first of all hits, sorted") {
    Numbers n;
    int hits = 0, misses = 0;
    for (int k = 0; k < 50; ++k) {
        const Crowd scene = crowd(n, 1 + n.below(10));
        for (int i = 0; i < 200; ++i) {
            const Vec3 origin(n.point(8));
            Ray ray{.origin = origin, .direction = 0.2f * (Vec3(n.point(5)) - origin)};
            if (i % 2) ray.t_min = float(n.between(0, 5));
            if (i % 3 == 0) ray.t_max = ray.t_min + float(n.between(0, 10));
            const auto expected = all_hits(scene, ray);
            const auto found = closest_hit(scene, ray);
            REQUIRE(found.has_value() == !expected.empty());
            REQUIRE(occluded(scene, ray) == !expected.empty());
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

TEST_CASE("query: on a tie the earlier object wins, and the earlier type") {
    Crowd scene;
    const auto grey = scene.add(Lambertian{});
    const Quad wall{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}};
    const Triangle half{{-1, -1, -4}, {1, -1, -4}, {-1, 1, -4}};
    scene.add(wall, grey);
    scene.add(wall, grey); // the same place
    const Ray ray{.origin{-0.5f, -0.5f, 0}};
    CHECK(closest_hit(scene, ray)->object == ObjectId{2, 0});
    scene.add(half, grey); // added last, but its type is listed before
    CHECK(closest_hit(scene, ray)->object == ObjectId{1, 0});
    scene.add(Sphere{{-0.5f, -0.5f, -5}, 1}, grey); // touches the same point
    CHECK(closest_hit(scene, ray)->object == ObjectId{0, 0});
    CHECK(closest_hit(scene, ray)->at.t == 4.0f);
}

TEST_CASE("query: a hit at the very end of the ray's range counts") {
    const auto scene =
        make_scene(placed(Quad{{-1, -1, -4}, {2, 0, 0}, {0, 2, 0}}, Lambertian{}));
    for (const float t_max : {4.0f, std::numeric_limits<float>::infinity()}) {
        CHECK(closest_hit(scene, Ray{.t_max = t_max}));
        CHECK(occluded(scene, Ray{.t_max = t_max}));
    }
    CHECK_FALSE(closest_hit(scene, Ray{.t_max = 3.999f}));
    CHECK_FALSE(occluded(scene, Ray{.t_max = 3.999f}));
    CHECK_FALSE(occluded(scene, Ray{.t_min = 4.001f}));
}

TEST_CASE("query: in an empty scene, and for bad rays, nothing is met") {
    const Crowd empty;
    CHECK_FALSE(closest_hit(empty, Ray{}));
    CHECK_FALSE(occluded(empty, Ray{}));
    const auto scene = make_scene(placed(Sphere{.radius = 9}, Lambertian{}));
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const Ray& bad : {Ray{.origin{nan, 0, 0}}, Ray{.direction{0, nan, 0}},
                           Ray{.direction = Vec3{0}}, Ray{.t_max = nan}}) {
        CHECK_FALSE(closest_hit(scene, bad));
        CHECK_FALSE(occluded(scene, bad));
    }
}

TEST_CASE("query: in the precision that is asked for, whether the first or any") {
    // Rays that graze a far ball: float and double often disagree on whether they meet.
    const Sphere ball{.radius = 1};
    const auto scene = make_scene(placed(ball, Lambertian{}));
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
        REQUIRE(closest_hit<float>(scene, ray).has_value() == in_float);
        REQUIRE(occluded<float>(scene, ray) == in_float);
        REQUIRE(closest_hit<double>(scene, ray).has_value() == in_double);
        REQUIRE(occluded<double>(scene, ray) == in_double);
    }
    CHECK(differ > 100);
}

TEST_CASE("query: a shape that is quick to say so is asked whether it is met") {
    int asked = 0;
    Scene<Shapes<Sphere, reader::Quick>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    scene.add(reader::Quick{{{0, 0, -5}, 1}, &asked}, grey);
    scene.add(reader::Quick{{{0, 0, -9}, 1}, &asked}, grey);
    CHECK(occluded(scene, Ray{}));
    CHECK(asked == 1); // the first that is met will do
    CHECK_FALSE(occluded(scene, Ray{.direction{0, 0, 1}}));
    CHECK(asked == 3);
    const auto hit = closest_hit(scene, Ray{});
    REQUIRE(hit);
    CHECK(hit->object == ObjectId{1, 0});
    CHECK(hit->at.t == 4);
    CHECK(asked == 3);                         // where it is met it cannot say
    scene.add(Sphere{{0, 0, -2}, 0.5f}, grey); // asked before, as its type is
    CHECK(occluded(scene, Ray{}));
    CHECK(asked == 3);
}
