// concept: triangle
// native: fused multiply-adds round the two sides of an edge differently
/// \file watertight_test.cpp
/// \brief No ray slips between two triangles with the watertight test, by construction.
/// Half a million rays at each mesh are in watertight_leaks_test.cpp, its decisions one
/// by one in triangle_exact_test.cpp.

#include "ljus/geometry/watertight.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "ljus/geometry/sphere.hpp"
#include "support/leaks.hpp"

using namespace ljus;
using ljus_test::Aim;
using ljus_test::ClosedMesh;
using ljus_test::loop_leaks;
using ljus_test::Numbers;

namespace {

/// In the plane z = -4; x and y are u and v.
const Triangle half_square{{0, 0, -4}, {1, 0, -4}, {0, 1, -4}};

Ray down_at(float x, float y) {
    return {.origin = {x, y, 0}, .direction = {0, 0, -1}};
}

} // namespace

TEST_CASE("watertight: rays at edges, at vertices, along the axes, and ties") {
    const ClosedMesh mesh = ljus_test::dented_ball(1, 1, Vec3T<double>{0});
    for (const Aim aim : {Aim::edge, Aim::vertex, Aim::axis, Aim::tie}) {
        CAPTURE(static_cast<int>(aim));
        CHECK(loop_leaks<double>(mesh, aim, 20000) == 0);
        CHECK(loop_leaks<Watertight>(mesh, aim, 20000) == 0);
    }
    CHECK(loop_leaks<float>(mesh, Aim::tie, 20000) > 0);
}

TEST_CASE("watertight: a mesh of any size, met by directions of any length") {
    for (const double size : {1e-42, 1e-35, 1e-20, 1e-3, 1e10, 1e30})
        for (const float length : {1e-38f, 1e-10f, 1.0f, 1e30f}) {
            const ClosedMesh mesh = ljus_test::dented_ball(1, size, Vec3T<double>{0});
            const auto meets = [&](Ray ray) {
                ray.direction *= length; // may vanish; then there is no ray
                if (ray.direction == Vec3{0}) return true;
                for (const Triangle& triangle : mesh.triangles)
                    if (intersect<Watertight>(ray, triangle)) return true;
                return false;
            };
            CAPTURE(size);
            CAPTURE(length);
            // t must be a float, or there is no hit to speak of.
            if (size / double(length) > 1e37) continue;
            CHECK(ljus_test::count_leaks(mesh, Aim::edge, 2000, meets) == 0);
            CHECK(ljus_test::count_leaks(mesh, Aim::vertex, 2000, meets) == 0);
        }
}

TEST_CASE("watertight: a tie is a hit, on an edge, at a vertex, from both sides") {
    for (const float along : {0.0f, 0.125f, 0.5f, 0.75f, 1.0f})
        for (const float side : {-1.0f, 1.0f})
            for (const Triangle& t :
                 {half_square,
                  Triangle{half_square.v3, half_square.v2, half_square.v1}}) {
                const auto hits = [&](float x, float y) {
                    const Ray ray{.origin = {x, y, -4 - 2 * side},
                                  .direction = {0, 0, side}};
                    return intersect<Watertight>(ray, t).has_value();
                };
                CHECK(hits(along, 0));
                CHECK(hits(0, along));
                CHECK(hits(along, 1 - along));
                // One step beyond the border is beyond it.
                const float below = std::nextafter(0.0f, -1.0f);
                CHECK_FALSE(hits(along, below));
                CHECK_FALSE(hits(below, along));
                CHECK_FALSE(hits(along, std::nextafter(1 - along, 2.0f)));
            }
}

TEST_CASE_TEMPLATE("watertight: it agrees with the test in double, t and u, v as well",
                   T, float, double) {
    Numbers n;
    int hits = 0, differ = 0;
    for (int i = 0; i < 50000; ++i) {
        const TriangleT<T> t{Vec3T<T>(n.point(3)), Vec3T<T>(n.point(3)),
                             Vec3T<T>(n.point(3))};
        const Vec3T<T> origin(n.point(6));
        const RayT<T> ray{.origin = origin, .direction = Vec3T<T>(n.point(3)) - origin};
        const auto hit = intersect<Watertight>(ray, t);
        const auto twin = intersect<double>(ray, t);
        differ += hit.has_value() != twin.has_value();
        if (!hit || !twin) continue;
        ++hits;
        const double allowed = sizeof(T) == 4 ? 1e-4 : 1e-11;
        REQUIRE(std::abs(double(hit->t - twin->t)) <= allowed * double(twin->t));
        REQUIRE(std::abs(double(hit->u - twin->u)) < allowed);
        REQUIRE(std::abs(double(hit->v - twin->v)) < allowed);
        REQUIRE(hit->u >= 0);
        REQUIRE(hit->v >= 0);
    }
    CHECK(hits > 3000);
    CHECK(differ <= 1); // where neither knows
}

TEST_CASE("watertight: the range of the ray decides") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const auto hit = [](float t_min, float t_max) {
        Ray ray = down_at(0.25f, 0.25f);
        ray.t_min = t_min, ray.t_max = t_max;
        return intersect<Watertight>(ray, half_square).has_value();
    };
    const auto found = intersect<Watertight>(down_at(0.25f, 0.5f), half_square);
    REQUIRE(found);
    CHECK(found->t == 4.0f);
    CHECK(found->part == 0);
    CHECK(hit(4, 4));
    CHECK(hit(0, 4));
    CHECK(hit(4, infinity));
    CHECK_FALSE(hit(0, std::nextafter(4.0f, 0.0f)));
    CHECK_FALSE(hit(std::nextafter(4.0f, 5.0f), infinity));
    CHECK_FALSE(hit(not_a_number, infinity));
    CHECK_FALSE(hit(0, not_a_number));
}

TEST_CASE("watertight: a direction so short that float has no inverse of it") {
    for (int axis = 0; axis < 3; ++axis)
        for (const float length : {1e-40f, -1e-44f}) {
            Ray ray{.direction = Vec3{0}};
            ray.direction[axis] = length;
            Triangle t{Vec3{-1e-9f}, Vec3{-1e-9f}, Vec3{-1e-9f}};
            t.v1[axis] = t.v2[axis] = t.v3[axis] = length * 0x1p30f;
            t.v2[(axis + 1) % 3] = t.v3[(axis + 2) % 3] = 1e-8f;
            const auto hit = intersect<Watertight>(ray, t);
            REQUIRE(hit);
            CHECK(hit->t == 0x1p30f);
        }
}

TEST_CASE_TEMPLATE("watertight: what lies farther away than any number is a miss", T,
                   float, double) {
    using Limits = std::numeric_limits<T>;
    for (int axis = 0; axis < 3; ++axis) {
        RayT<T> ray{.direction = Vec3T<T>{0}};
        ray.direction[axis] = Limits::min();
        TriangleT<T> t{Vec3T<T>{-1}, Vec3T<T>{-1}, Vec3T<T>{-1}};
        t.v2[(axis + 1) % 3] = t.v3[(axis + 2) % 3] = 8;
        t.v1[axis] = t.v2[axis] = t.v3[axis] = 1;
        const auto hit = intersect<Watertight>(ray, t);
        REQUIRE(hit);
        CHECK(hit->t == 1 / Limits::min());
        t.v1[axis] = t.v2[axis] = t.v3[axis] = 8; // 8 / min() is beyond max()
        CHECK_FALSE(intersect<Watertight>(ray, t));
    }
}

TEST_CASE_TEMPLATE("watertight: the axis is the one along which the ray is longest", T,
                   float, double) {
    // Then nothing leans by more than 45 degrees, for any order of the others.
    for (const T x : {T(0), T(1e-9), T(1), T(2), T(-3)})
        for (const T y : {T(0), T(1e-9), T(1), T(2), T(-3)})
            for (const T z : {T(0), T(1e-9), T(1), T(2), T(-3)}) {
                const Vec3T<T> d{x, y, z};
                const T most = max_component(glm::abs(d));
                if (most == 0) continue;
                const auto shear = prepare<Watertight>(RayT<T>{.direction = d});
                REQUIRE(std::abs(d[shear.z]) == most);
                REQUIRE(shear.x == (shear.z + 1) % 3);
                REQUIRE(shear.y == (shear.z + 2) % 3);
                CHECK(shear.sx == d[shear.x] / d[shear.z]);
                CHECK(shear.sy == d[shear.y] / d[shear.z]);
                CHECK(shear.sz == 1 / double(d[shear.z]));
            }
}

TEST_CASE_TEMPLATE("watertight: invalid data are a miss", T, float, double) {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    constexpr T not_a_number = std::numeric_limits<T>::quiet_NaN();
    const TriangleT<T> good_triangle{{0, 0, -4}, {1, 0, -4}, {0, 1, -4}};
    const RayT<T> good{.origin = {T(0.25), T(0.25), 0}, .direction = {0, 0, -1}};
    REQUIRE(intersect<Watertight>(good, good_triangle));
    for (const T bad : {not_a_number, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(bad);
            CAPTURE(axis);
            RayT<T> ray = good;
            ray.origin[axis] = bad;
            CHECK_FALSE(intersect<Watertight>(ray, good_triangle));
            ray = good;
            ray.direction[axis] = bad;
            CHECK_FALSE(intersect<Watertight>(ray, good_triangle));
            for (Vec3T<T> TriangleT<T>::*vertex :
                 {&TriangleT<T>::v1, &TriangleT<T>::v2, &TriangleT<T>::v3}) {
                TriangleT<T> triangle = good_triangle;
                (triangle.*vertex)[axis] = bad;
                CHECK_FALSE(intersect<Watertight>(good, triangle));
            }
        }
    // An infinite direction from within the plane: every t would be 0.
    for (const T z : {T(0), T(-4)})
        for (const T wild : {T(0), T(-0.0), infinity, not_a_number}) {
            const RayT<T> ray{.origin = {T(0.25), T(0.25), z},
                              .direction = {0, 0, wild}};
            CHECK_FALSE(intersect<Watertight>(ray, good_triangle));
        }
    // No area, and within the plane.
    const Vec3T<T> a{0, 0, -4}, b{1, 0, -4}, c{2, 0, -4};
    for (const TriangleT<T>& thin :
         {TriangleT<T>{a, a, a}, TriangleT<T>{a, a, b}, TriangleT<T>{a, b, a},
          TriangleT<T>{b, a, a}, TriangleT<T>{a, b, c}})
        for (const T x : {T(0), T(0.25), T(1)}) {
            const RayT<T> down{.origin = {x, 0, 0}, .direction = {0, 0, -1}};
            CHECK_FALSE(intersect<Watertight>(down, thin));
        }
    const TriangleT<T> on_a_line{{-8, -2, 1}, {-11, 0, 2}, {-17, 4, 4}};
    const RayT<T> across{.origin = {T(-11.5), 3, T(8.5)}, .direction = {-1, -2, -6}};
    CHECK_FALSE(intersect<Watertight>(across, on_a_line));
    for (const T y : {T(-1), T(0), T(0.25), T(1)}) {
        const RayT<T> ray{.origin = {-2, y, -4}, .direction = {1, 0, 0}};
        CHECK_FALSE(intersect<Watertight>(ray, good_triangle));
    }
}

TEST_CASE("watertight: what takes a precision for all its shapes takes it too") {
    const auto t = [](const auto& shape) {
        return intersect<Watertight>(down_at(0.25f, 0.25f), shape);
    };
    const Sphere ball{.center = {0.25f, 0.25f, -4}};
    const Quad square{{0, 0, -4}, {1, 0, 0}, {0, 1, 0}};
    CHECK(*t(ball) == *intersect(down_at(0.25f, 0.25f), ball));
    CHECK(t(square)->t == 4.0f);
    CHECK(t(square)->u == 0.25f);
    // A quad in double, also where float would decide otherwise: at its edges.
    Numbers n{7};
    int differ = 0;
    for (int i = 0; i < 3000; ++i) {
        const Quad quad{Vec3(n.point(3)), Vec3(n.point(3)), Vec3(n.point(3))};
        const Vec3 origin(n.point(6));
        const Vec3 at = quad.corner + float(n.next()) * quad.edge_u;
        const Ray ray{.origin = origin, .direction = at - origin};
        const bool hit = intersect<Watertight>(ray, quad).has_value();
        REQUIRE(hit == intersect<double>(ray, quad).has_value());
        differ += hit != intersect<float>(ray, quad).has_value();
    }
    CHECK(differ > 100);
    // And so does a loop that prepares a ray once, for each of them.
    const auto prepared = [](auto test, const auto& shape) {
        using Test = decltype(test);
        const Ray ray = down_at(0.25f, 0.25f);
        return intersect<Test>(ray, shape, prepare<Test>(ray));
    };
    CHECK(*prepared(Watertight{}, ball) == *prepared(float{}, ball));
    CHECK(prepared(Watertight{}, square)->t == prepared(double{}, square)->t);
    CHECK(prepared(Watertight{}, half_square)->t == 4.0f);
    CHECK(prepared(double{}, half_square)->t == 4.0f);
}
