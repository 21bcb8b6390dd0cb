/// \file box_test.cpp
/// \brief Boxes around shapes, and rays that meet them, against the definitions.

#include "ljus/geometry/box.hpp"

#include <doctest/doctest.h>

#include <limits>

#include "ljus/geometry/shape.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

constexpr float inf = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// The slabs as they are defined, in long double, without a sign or a division by 0.
bool meets(const Ray& ray, const Box& box) {
    long double first = ray.t_min, last = ray.t_max;
    for (int axis = 0; axis < 3; ++axis) {
        const long double o = ray.origin[axis], d = ray.direction[axis];
        const long double low = box.low[axis], high = box.high[axis];
        if (d == 0) {
            if (o < low || o > high) return false;
            continue;
        }
        first = std::max(first, std::min((low - o) / d, (high - o) / d));
        last = std::min(last, std::max((low - o) / d, (high - o) / d));
    }
    return first <= last;
}

std::optional<float> entry(const Ray& ray, const Box& box) {
    const auto ready = box_ray(ray, box);
    if (!ready) return std::nullopt;
    return intersect(*ready, box, ray.t_min, ray.t_max);
}

bool within(const Box& box, const Vec3T<long double>& p) {
    for (int axis = 0; axis < 3; ++axis)
        if (p[axis] < box.low[axis] || p[axis] > box.high[axis]) return false;
    return true;
}

} // namespace

TEST_CASE("box: the box around nothing, and what it grows to") {
    Box box;
    CHECK(box.low.x > box.high.x);
    box = box_union(box, Vec3{1, 2, 3});
    CHECK(box.low == Vec3{1, 2, 3});
    CHECK(box.high == Vec3{1, 2, 3});
    box = box_union(box, Box{{-1, 5, 0}, {0, 6, 1}});
    CHECK(box.low == Vec3{-1, 2, 0});
    CHECK(box.high == Vec3{1, 6, 3});
    CHECK(box_union(Box{}, box).low == box.low);
}

TEST_CASE("box: no point of a shape is outside of its box") {
    using Exact = Vec3T<long double>;
    Numbers n;
    for (int k = 0; k < 20000; ++k) {
        const double size = n.power(-6, 6);
        const Vec3 at(n.point(n.power(-3, 6)));
        const Sphere sphere{at, float(size)};
        const Triangle triangle{at, at + Vec3(n.point(size)), at + Vec3(n.point(size))};
        const Quad quad{at, Vec3(n.point(size)), Vec3(n.point(size))};
        for (int axis = 0; axis < 3; ++axis)
            for (const long double sign : {-1.0L, 1.0L}) {
                Exact pole(sphere.center);
                pole[axis] += sign * static_cast<long double>(sphere.radius);
                REQUIRE(within(bounds(sphere), pole));
            }
        for (const Vec3& v : {triangle.v1, triangle.v2, triangle.v3})
            REQUIRE(within(bounds(triangle), Exact(v)));
        for (const long double u : {0.0L, 1.0L})
            for (const long double v : {0.0L, 1.0L})
                REQUIRE(within(bounds(quad), Exact(quad.corner) +
                                                 u * Exact(quad.edge_u) +
                                                 v * Exact(quad.edge_v)));
        // Nor is the box much larger than the shape.
        const double slack = 1e-6 * (size + double(max_component(glm::abs(at))));
        REQUIRE(double(bounds(sphere).high.x) <=
                double(at.x) + double(sphere.radius) + slack);
    }
}

TEST_CASE("box: what the slabs say exactly, intersect() says too, and little more") {
    Numbers n;
    int hits = 0, more = 0;
    for (int k = 0; k < 200000; ++k) {
        const Vec3 a(n.point(2)), b(n.point(2));
        Box box{glm::min(a, b), glm::max(a, b)};
        if (k % 3 == 0) box.high[k % 2] = box.low[k % 2]; // flat
        Ray ray{.origin = Vec3(n.point(4)), .direction = Vec3(n.point(1))};
        for (int axis = 0; axis < 3; ++axis) {
            const int what = n.below(6);
            if (what == 0) ray.direction[axis] = 0.0f;
            if (what == 1) ray.direction[axis] = -0.0f;
            if (what == 2)
                ray.origin[axis] = n.below(2) ? box.low[axis] : box.high[axis];
        }
        if (ray.direction == Vec3{0}) continue;
        if (k % 5 == 0) ray.t_max = float(n.between(0, 5));
        if (k % 7 == 0) ray.t_min = float(n.between(0, 5));
        const bool exact = meets(ray, box);
        const auto found = entry(ray, box);
        if (exact) REQUIRE(found);
        hits += exact;
        more += found && !exact;
        if (found) REQUIRE((*found >= ray.t_min && *found <= ray.t_max));
    }
    CHECK(hits > 5000);
    MESSAGE("met beyond the exact box: " << more << " beside " << hits);
    CHECK(more < hits / 20);
}

TEST_CASE("box: no ray at an edge is lost to rounding") {
    Numbers n;
    int hits = 0;
    for (int k = 0; k < 200000; ++k) {
        const Vec3 place(n.point(k % 2 ? 100 : 0)), a(n.point(2)), b(n.point(2));
        const Box box{place + glm::min(a, b), place + glm::max(a, b)};
        Vec3 edge = box.low + float(n.next()) * (box.high - box.low);
        for (int axis = 0; axis < 2 + n.below(2); ++axis)
            edge[axis] = n.below(2) ? box.low[axis] : box.high[axis];
        const Vec3 origin = place + Vec3(n.point(4));
        const Ray ray{.origin = origin, .direction = edge - origin};
        if (!meets(ray, box)) continue;
        ++hits;
        REQUIRE(entry(ray, box));
    }
    CHECK(hits > 50000);
}

TEST_CASE("box: along an axis, the sign of zero does not matter") {
    const Box box{{-1, -1, -5}, {1, 1, -3}};
    for (const float zero : {0.0f, -0.0f})
        for (const float x : {-1.0f, -0.5f, 0.0f, 1.0f}) {
            CHECK(entry({.origin{x, 0, 0}, .direction{zero, zero, -1}}, box).value() ==
                  doctest::Approx(3));
            CHECK(entry({.origin{x, -1, 0}, .direction{zero, zero, -1}}, box));
            CHECK(entry({.origin{x, 1, -9}, .direction{zero, zero, 1}}, box));
            CHECK_FALSE(entry({.origin{x, 1.01f, 0}, .direction{zero, zero, -1}}, box));
            CHECK_FALSE(entry({.origin{x, 0, 0}, .direction{zero, zero, 1}}, box));
        }
}

TEST_CASE("box: NaN is a miss, and so is nothing") {
    const Box box{{-1, -1, -5}, {1, 1, -3}};
    CHECK(entry(Ray{}, box));
    CHECK_FALSE(entry({.t_max = not_a_number}, box));
    CHECK_FALSE(entry({.t_min = not_a_number}, box));
    CHECK_FALSE(entry({.t_max = 2.99f}, box));
    CHECK_FALSE(entry({.t_min = 5.01f}, box));
    const auto ready = box_ray(Ray{}, box);
    CHECK_FALSE(intersect(*ready, Box{}, 0.0f, inf));
    for (const Ray& bad :
         {Ray{.origin{not_a_number, 0, 0}}, Ray{.direction{not_a_number, 0, 1}},
          Ray{.direction = Vec3{0}}, Ray{.direction{0, 0, inf}},
          Ray{.direction{0, 0, 1e-30f}}, Ray{.direction{0, 0, 1e30f}},
          Ray{.origin{1e30f, 0, 0}}})
        CHECK_FALSE(box_ray(bad, box));
}

TEST_CASE("box: the slack is 16 units of roundoff of the farthest side") {
    const Ray ray{.origin{1, 2, 3}, .direction{1, 2, 3}};
    for (int axis = 0; axis < 3; ++axis)
        for (const float side : {-1000.0f, 1000.0f}) {
            Box box{{0, 0, 0}, {4, 4, 4}};
            (side < 0 ? box.low : box.high)[axis] = side;
            const float reach = std::abs(side - ray.origin[axis]);
            CHECK(box_ray(ray, box)->slack / (16 * 0x1p-24 * reach) ==
                  doctest::Approx(1).epsilon(1e-5));
        }
}

TEST_CASE("box: a range of one point within it is met there, and beyond it is not") {
    const Box box{{-1, -1, -5}, {1, 1, -3}};
    const auto ready = box_ray(Ray{}, box);
    REQUIRE(ready);
    CHECK(intersect(*ready, box, 4.0f, 4.0f).value() == 4);
    CHECK_FALSE(intersect(*ready, box, 2.0f, 2.0f));
    CHECK_FALSE(intersect(*ready, box, 6.0f, 6.0f));
}

TEST_CASE("box: around a quad it is hardly larger than the quad") {
    const Quad quad{{1, 2, 3}, {4, 0, -1}, {0, -5, 2}};
    const Box box = bounds(quad);
    CHECK(glm::distance(box.low, Vec3{1, -3, 2}) < 1e-5f);
    CHECK(glm::distance(box.high, Vec3{5, 2, 5}) < 1e-5f);
}

TEST_CASE("box: around a ball it is hardly larger than the ball") {
    const Box box = bounds(Sphere{{1, -2, 3}, 4});
    CHECK(glm::distance(box.low, Vec3{-3, -6, -1}) < 1e-5f);
    CHECK(glm::distance(box.high, Vec3{5, 2, 7}) < 1e-5f);
}

TEST_CASE("box: around a flat quad it is not flat") {
    // Else a ray in its plane would have no room for any rounding.
    for (int axis = 0; axis < 3; ++axis) {
        Quad quad;
        quad.edge_u = quad.edge_v = Vec3{0};
        quad.edge_u[(axis + 1) % 3] = quad.edge_v[(axis + 2) % 3] = 1;
        const Box box = bounds(quad);
        CHECK(box.low[axis] < 0);
        CHECK(box.high[axis] > 0);
        CHECK(box.high[axis] < 1e-6f);
    }
    const Box of_ball = bounds(Sphere{.radius = 1e-44f});
    CHECK(of_ball.low.x < -1e-44f);
    CHECK(of_ball.high.z > 1e-44f);
}
