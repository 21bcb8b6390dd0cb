/// \file quad_test.cpp
/// \brief The parallelogram: one test for two triangles. Its decisions against exact
/// arithmetic are in triangle_exact_test.cpp.

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "support/numbers.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

/// In the plane z = -4, x and y are u and v.
const Quad square{{0, 0, -4}, {1, 0, 0}, {0, 1, 0}};

Ray down_at(float x, float y) {
    return {.origin = {x, y, 0}, .direction = {0, 0, -1}};
}

} // namespace

TEST_CASE("quad: known hits, on both sides of the diagonal") {
    for (const float u : {0.0f, 0.25f, 0.75f, 1.0f})
        for (const float v : {0.0f, 0.125f, 0.5f, 1.0f}) {
            const auto hit = intersect<float>(down_at(u, v), square);
            REQUIRE(hit);
            CHECK(hit->t == 4.0f);
            CHECK(hit->u == u);
            CHECK(hit->v == v);
            const auto wide = intersect<double>(down_at(u, v), square);
            REQUIRE(wide);
            CHECK(wide->t == 4.0f);
        }
}

TEST_CASE("quad: without more said it is the unit square of the plane z = 0") {
    const Ray ray{.origin{0.25f, 0.75f, 2}};
    const auto hit = intersect(ray, Quad{});
    REQUIRE(hit);
    CHECK(hit->t == 2);
    CHECK(hit->u == 0.25f);
    CHECK(hit->v == 0.75f);
    CHECK(normal(Quad{}) == Vec3{0, 0, 1});
}

TEST_CASE("quad: each of the four edges is a border") {
    const float below = std::nextafter(0.0f, -1.0f), above = std::nextafter(1.0f, 2.0f);
    for (const float along : {0.0f, 0.5f, 1.0f})
        for (const float beyond : {below, above, -1.0f, 2.0f}) {
            CHECK_FALSE(intersect<float>(down_at(along, beyond), square));
            CHECK_FALSE(intersect<float>(down_at(beyond, along), square));
        }
    // In double the border is closed, but not as wide as one unit of the data.
    for (const float along : {0.0f, 0.5f, 1.0f}) {
        CHECK_FALSE(intersect<double>(down_at(along, above), square));
        CHECK_FALSE(intersect<double>(down_at(above, along), square));
    }
}

TEST_CASE("quad: it is hit where one of its two triangles is") {
    Numbers n;
    int hits = 0, differ = 0;
    for (int i = 0; i < 20000; ++i) {
        const Quad q{Vec3(n.point(3)), Vec3(n.point(3)), Vec3(n.point(3))};
        const Vec3 opposite = q.corner + q.edge_u + q.edge_v;
        const Triangle low{q.corner, q.corner + q.edge_u, q.corner + q.edge_v};
        const Triangle high{opposite, q.corner + q.edge_v, q.corner + q.edge_u};
        const Vec3 origin(n.point(6));
        const Ray ray{.origin = origin, .direction = Vec3(n.point(3)) - origin};
        const auto hit = intersect<double>(ray, q);
        const auto a = intersect<double>(ray, low), b = intersect<double>(ray, high);
        if (hit.has_value() != (a.has_value() || b.has_value())) {
            ++differ; // where the rounding of the fourth corner decides
            continue;
        }
        if (!hit) continue;
        ++hits;
        REQUIRE(hit->t == doctest::Approx((a ? a : b)->t).epsilon(1e-4));
        const Vec3 on_quad = point_at(q, hit->u, hit->v).position;
        REQUIRE(glm::distance(on_quad, point_at(ray, hit->t)) < 1e-3f);
    }
    CHECK(hits > 1000);
    CHECK(differ <= 1);
}

TEST_CASE("quad: invalid data and parallel edges are a miss") {
    const Ray ray = down_at(0.5f, 0.5f);
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (const float bad :
         {std::numeric_limits<float>::quiet_NaN(), infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis)
            for (Vec3 Quad::*part : {&Quad::corner, &Quad::edge_u, &Quad::edge_v}) {
                Quad q = square;
                (q.*part)[axis] = bad;
                CHECK_FALSE(intersect(ray, q));
                CHECK_FALSE(intersect<double>(ray, q));
            }
    for (const Vec3 edge : {Vec3{0}, Vec3{1, 0, 0}, Vec3{-2, 0, 0}}) {
        const Quad q{{0, 0.5f, -4}, {1, 0, 0}, edge};
        CHECK_FALSE(intersect(ray, q));
        CHECK_FALSE(intersect<double>(ray, q));
        CHECK(area(q) == 0.0f);
    }
}

TEST_CASE("quad: normal and area, of any size") {
    for (const float size : {1e-15f, 1e-5f, 1.0f, 1e5f, 1e15f}) {
        const Quad q{{5, 6, 7}, {0, 2 * size, 0}, {0, 0, size}};
        CHECK(normal(q) == Vec3{1, 0, 0});
        CHECK(area(q) == ljus_test::within(2.0 * double(size) * size, 1e-6));
    }
    const Quad leaning{{0, 0, 0}, {2, 0, 0}, {1, 1, 0}};
    CHECK(normal(leaning) == Vec3{0, 0, 1});
    CHECK(area(leaning) == 2.0f);
}

TEST_CASE("quad: sampled points cover its area evenly") {
    Numbers n;
    std::array<int, 64> cells{};
    const Quad q{{1, 2, 3}, {4, 0, 0}, {2, 3, 0}}; // leaning
    for (int i = 0; i < 100000; ++i) {
        const SurfacePoint p = sample_area(q, n.square<float>());
        CHECK(p.normal == Vec3{0, 0, 1});
        const float v = (p.position.y - 2) / 3;
        const float u = (p.position.x - 1 - 2 * v) / 4;
        const int i8 = std::clamp(int(u * 8), 0, 7), j8 = std::clamp(int(v * 8), 0, 7);
        REQUIRE(std::abs(u - 0.5f) < 0.50001f);
        REQUIRE(std::abs(v - 0.5f) < 0.50001f);
        ++cells[static_cast<std::size_t>(i8 * 8 + j8)];
    }
    // A false alarm once in a million.
    CHECK(ljus_test::chi_square(cells) < ljus_test::chi_square_limit(63));
}

TEST_CASE("quad: the point at u, v, and how far rounding may have moved it") {
    Numbers n;
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const double size = n.power(-2, 2);
        const Quad quad{Vec3(n.power(-2, 2) * n.direction()), Vec3(size * n.point(1)),
                        Vec3(size * n.point(1))};
        const auto u = n.square<float>();
        const SurfacePoint p = sample_area(quad, u);
        REQUIRE(p.position == point_at(quad, u.x, u.y).position);
        const glm::dvec3 b = double(u.x) * glm::dvec3(quad.edge_u);
        const glm::dvec3 c = double(u.y) * glm::dvec3(quad.edge_v);
        const glm::dvec3 off =
            glm::abs(glm::dvec3(p.position) - (glm::dvec3(quad.corner) + b + c));
        const glm::dvec3 all =
            glm::abs(glm::dvec3(quad.corner)) + glm::abs(b) + glm::abs(c);
        for (int axis = 0; axis < 3; ++axis) {
            REQUIRE(off[axis] <= double(p.error[axis]));
            // Five roundings of half a unit in 2^23 each.
            REQUIRE(double(p.error[axis]) <= 1.01 * 5 * 0x1p-24 * all[axis]);
            largest = std::max(largest, off[axis] / double(p.error[axis]));
        }
    }
    CHECK(largest > 0.2);
}

TEST_CASE("quad: without an area in exact arithmetic it is never hit") {
    // The edges are the same line; rounding their cross product, in float, is not 0.
    Numbers n;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 edge(n.point(1));
        const Quad quad{Vec3(n.point(1)), edge, edge * 0.5f};
        const Vec3 origin(n.point(4));
        const Ray ray{.origin = origin,
                      .direction =
                          point_at(quad, float(n.next()), float(n.next())).position -
                          origin};
        REQUIRE_FALSE(intersect<float>(ray, quad));
        REQUIRE_FALSE(intersect(ray, quad));
    }
}

TEST_CASE("quad: what meets an edge or a corner exactly is a hit") {
    // Whole numbers so large that the products of three are rounded, in double too.
    Numbers n{31};
    const auto whole = [&] { return n.whole_point(1 << 20); };
    int rays = 0, open = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 corner = whole(), half_u = whole(), half_v = whole(), way = whole();
        const Quad quad{corner, 2.0f * half_u, 2.0f * half_v};
        for (const float x : {0.0f, 1.0f, 2.0f})
            for (const float y : {0.0f, 1.0f, 2.0f}) {
                const Vec3 at = corner + x * half_u + y * half_v;
                const auto hit =
                    intersect(Ray{.origin = at - way, .direction = way}, quad);
                ++rays;
                open += !hit; // slivers alone: the border of all others is closed
                if (!hit) continue;
                REQUIRE(hit->u >= 0);
                REQUIRE(hit->v >= 0);
            }
    }
    CHECK(open < rays / 100);
}

TEST_CASE("quad: a point of doubles tells how badly the plane is known") {
    const auto tilt = [](auto one) {
        const QuadT<decltype(one)> quad{{5, 6, 7}, {2, 0, 0}, {4, one / 1024, 0}};
        CHECK(sample_area(quad, {one / 4, one / 2}).tilt ==
              point_at(quad, one, one).tilt);
        return point_at(quad, one / 4, one / 2).tilt;
    };
    // The sizes of the edges over the area between them: 2 (4 + 1/1024) 1024 / 2.
    CHECK(tilt(1.0) == 4097);
    CHECK(tilt(1.0f) == 0); // a test in double does not turn it
}
