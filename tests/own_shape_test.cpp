/// \file own_shape_test.cpp
/// \brief The box of examples/own_shape.hpp against marching along the ray.

#include "own_shape.hpp"

#include <doctest/doctest.h>

#include <stdexcept>
#include <utility>

#include "ljus/geometry/moving.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/world.hpp"
#include "support/draws.hpp"

using ljus::Ray, ljus::Vec3;
using reader::Crate;

static_assert(ljus::Shape<Crate>);

namespace {

/// A box that can move.
struct SlidingCrate : Crate {};
SlidingCrate translated(const SlidingCrate& box, const Vec3& by) {
    return {{box.low + by, box.high + by}};
}

bool inside(const Crate& box, const glm::dvec3& x) {
    bool all = true;
    for (int i = 0; i < 3; ++i)
        all = all && double(box.low[i]) <= x[i] && x[i] <= double(box.high[i]);
    return all;
}

/// The first step of a thousandth at which the ray crosses the border, or -1.
double march(const Crate& box, const Ray& ray) {
    const glm::dvec3 from(ray.origin), way(ray.direction);
    const bool begins_inside = inside(box, from);
    for (int step = 1; step < 12000; ++step)
        if (inside(box, from + step * 1e-3 * way) != begins_inside) return step * 1e-3;
    return -1;
}

} // namespace

TEST_CASE("own shape: hits are where marching along the ray finds them") {
    const Crate box{{-1, -0.5f, 0.2f}, {1.5f, 0.7f, 2}};
    ljus_test::Draws draws{1};
    int hits = 0, from_within = 0;
    for (int i = 0; i < 3000; ++i) {
        const Vec3 from = 3.0f * (2.0f * draws.cube<float>() - 1.0f);
        const Vec3 aim = 1.5f * (2.0f * draws.cube<float>() - 1.0f) + Vec3{0, 0, 1};
        const Ray ray{.origin = from, .direction = glm::normalize(aim - from)};
        const double marched = march(box, ray);
        const auto t = reader::intersect(ray, box);
        if (t && marched < 0) { // a corner that is thinner than a step
            const auto leave = reader::intersect(
                {.origin = from, .direction = ray.direction, .t_min = *t + 1e-5f}, box);
            REQUIRE((!leave || *leave - *t < 2e-3f));
            continue;
        }
        REQUIRE(t.has_value() == (marched > 0));
        if (!t) continue;
        REQUIRE(std::abs(double(*t) - marched) < 1.1e-3);
        ++hits;
        from_within += inside(box, glm::dvec3(from));
    }
    CHECK(hits > 1000);
    CHECK(from_within > 20);
}

TEST_CASE("own shape: a point of it lies on a side, and its normal points outwards") {
    const Crate box{{-1, -0.5f, 0.2f}, {1.5f, 0.7f, 2}};
    ljus_test::Draws draws{2};
    for (int i = 0; i < 2000; ++i) {
        const Vec3 within = box.low + draws.cube<float>() * (box.high - box.low);
        const Ray ray{.origin = within, .direction = draws.direction<float>()};
        const auto t = reader::intersect(ray, box);
        REQUIRE(t);
        const auto p = surface_point(box, ray, {.t = *t});
        REQUIRE(glm::distance(p.position, point_at(ray, *t)) < 1e-5f);
        for (int c = 0; c < 3; ++c) // two roundings in O + tD, at the least
            REQUIRE(p.error[c] >= 1.2e-7f * std::abs(p.position[c]));
        REQUIRE(glm::dot(p.normal, p.normal) == 1.0f);
        REQUIRE(glm::dot(p.normal, ray.direction) > 0.0f);
        const float off = glm::dot(p.normal, p.position);
        const float side =
            glm::max(glm::dot(p.normal, box.low), glm::dot(p.normal, box.high));
        REQUIRE(off == side);
        REQUIRE(glm::distance(bounding_sphere(box).center, p.position) <=
                bounding_sphere(box).radius);
        // It is left for good, on both sides.
        REQUIRE_FALSE(reader::intersect(spawn_ray(p, p.normal), box));
        REQUIRE(reader::intersect(spawn_ray(p, -p.normal), box));
    }
}

TEST_CASE("own shape: bad rays meet nothing, and bad boxes are refused by name") {
    const Crate box;
    const float nan = std::nanf("");
    CHECK_FALSE(reader::intersect(Ray{.origin{nan, 0, 5}}, box));
    CHECK_FALSE(reader::intersect(Ray{.origin{0, 0, 5}, .t_max = 3.9f}, box));
    CHECK(*reader::intersect(Ray{.origin{0, 0, 5}, .t_min = 4.5f}, box) == 6.0f);
    CHECK_FALSE(reader::intersect(Ray{.origin{0, 0, -5}}, box)); // behind
    CHECK_THROWS_WITH_AS(check(Crate{{0, 0, 0}, {1, 0, 1}}),
                         doctest::Contains("crate.high"), std::invalid_argument);
    CHECK_NOTHROW(check(box));
}

TEST_CASE("own shape: a scene finds it as its own shapes") {
    ljus::Scene<ljus::Shapes<ljus::Sphere, Crate>, ljus::Materials<ljus::Lambertian>>
        scene;
    const auto grey = scene.add(ljus::Lambertian{});
    scene.add(ljus::Sphere{{0, 0, -5}, 1}, grey);
    scene.add(Crate{{-1, -1, -3}, {1, 1, -2}}, grey);
    const ljus::World world(std::move(scene));
    const auto hit = closest_hit(world, Ray{});
    REQUIRE(hit);
    CHECK(hit->at.t == 2.0f);
    CHECK(hit->object.type == 1);
}

TEST_CASE("own shape: it moves if it has translated()") {
    using Moved = ljus::Moving<SlidingCrate>;
    ljus::Scene<ljus::Shapes<Moved>, ljus::Materials<ljus::Lambertian>> scene;
    scene.add(Moved{{{{-1, -1, -1}, {1, 1, 1}}}, {4, 0, 0}},
              scene.add(ljus::Lambertian{}));
    const ljus::World world(std::move(scene));
    for (const float time : {0.0f, 0.5f, 1.0f})
        for (const float x : {0.0f, 2.0f, 4.0f}) {
            const Ray ray{.origin{x, 0, 5}, .direction{0, 0, -1}, .time = time};
            const auto hit = closest_hit(world, ray);
            REQUIRE(hit.has_value() == (x == 4 * time));
            if (hit) CHECK(hit->at.t == 4);
        }
}
