/// \file transform_test.cpp
/// \brief Shapes moved, turned and scaled, against what the map does to their points.

#include "ljus/geometry/transform.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

bool close(const Vec3& a, const Vec3& b, float within = 1e-5f) {
    return glm::distance(a, b) <= within * (1 + glm::length(b));
}

/// Turned, scaled, and mirrored every other time.
Transform any_map(Numbers& n) {
    const auto factor = [&] { return float(n.power(-1, 1) * n.sign()); };
    const float x = factor(), y = factor();
    return translate(Vec3(n.point(4))) *
           rotate(Vec3(n.point(3)), float(n.between(-4, 4))) *
           scale(Vec3{x, y, factor()}) * rotate(Vec3(n.point(3)), 1.0f);
}

} // namespace

TEST_CASE("transform: each kind alone") {
    CHECK(transformed(Transform{}, Vec3{1, 2, 3}) == Vec3{1, 2, 3});
    CHECK(transformed(translate(Vec3{1, 0, -1}), Vec3{1, 2, 3}) == Vec3{2, 2, 2});
    CHECK(transformed(scale(Vec3{2, -1, 0.5f}), Vec3{1, 2, 3}) == Vec3{2, -2, 1.5f});
    // Counter-clockwise seen against the axis: x goes to y about z.
    CHECK(close(transformed(rotate(Vec3{0, 0, 9}, pi / 2), Vec3{1, 0, 0}), {0, 1, 0}));
    CHECK(close(transformed(rotate(Vec3{1, 0, 0}, pi / 2), Vec3{0, 1, 0}), {0, 0, 1}));
    CHECK(close(transformed(rotate(Vec3{0, 2, 0}, pi / 2), Vec3{0, 0, 1}), {1, 0, 0}));
    CHECK(close(transformed(rotate(Vec3{1, 1, 1}, 2 * pi / 3), Vec3{1, 2, 3}),
                {3, 1, 2})); // the cube's diagonal: x to y to z to x
}

TEST_CASE("transform: a rotation keeps lengths, angles, its axis and its sense") {
    Numbers n;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 axis(n.direction()), a(n.point(2)), b(n.point(2));
        const float angle = float(n.between(-7, 7));
        const Transform turn = rotate(5.0f * axis, angle);
        const Vec3 ta = transformed(turn, a), tb = transformed(turn, b);
        REQUIRE(glm::dot(ta, tb) == doctest::Approx(glm::dot(a, b)).epsilon(1e-5));
        REQUIRE(close(transformed(turn, axis), axis));
        REQUIRE(close(glm::cross(ta, tb), transformed(turn, glm::cross(a, b))));
        REQUIRE(close(transformed(rotate(axis, -angle), ta), a));
        // The angle itself, in the plane across the axis.
        const Vec3 side = glm::normalize(glm::cross(axis, Vec3(n.direction())));
        const Vec3 turned = transformed(turn, side);
        const float seen = std::atan2(glm::dot(glm::cross(side, turned), axis),
                                      glm::dot(side, turned));
        REQUIRE(std::cos(seen - angle) > 1 - 1e-5f);
    }
}

TEST_CASE("transform: a product applies its right side first") {
    const Transform up = translate(Vec3{0, 1, 0}), twice = scale(Vec3{2});
    CHECK(transformed(up * twice, Vec3{1, 1, 1}) == Vec3{2, 3, 2});
    CHECK(transformed(twice * up, Vec3{1, 1, 1}) == Vec3{2, 4, 2});
    Numbers n;
    for (int i = 0; i < 500; ++i) {
        const Transform a = any_map(n), b = any_map(n), c = any_map(n);
        const Vec3 p(n.point(3));
        REQUIRE(close(transformed(a * b, p), transformed(a, transformed(b, p)), 1e-4f));
        REQUIRE(close(transformed((a * b) * c, p), transformed(a * (b * c), p), 1e-4f));
    }
}

TEST_CASE("transform: a flat shape has the moved points, and its outer side outside") {
    Numbers n;
    int mirrored = 0;
    for (int i = 0; i < 2000; ++i) {
        const Transform map = any_map(n);
        const Triangle t{Vec3(n.point(2)), Vec3(n.point(2)), Vec3(n.point(2))};
        const Quad q{t.v1, t.v2, t.v3};
        if (area(t) < 0.05f || area(q) < 0.05f) continue;
        const Triangle moved_t = transformed(map, t);
        const Quad moved_q = transformed(map, q);
        mirrored += glm::determinant(map.linear) < 0;

        // The same set of points: the centroid, and the area by the volume it spans.
        REQUIRE(close((moved_t.v1 + moved_t.v2 + moved_t.v3) / 3.0f,
                      transformed(map, (t.v1 + t.v2 + t.v3) / 3.0f), 1e-4f));
        REQUIRE(close(point_at(moved_q, 0.5f, 0.5f).position,
                      transformed(map, point_at(q, 0.5f, 0.5f).position), 1e-4f));
        for (const Vec3& v : {t.v1, t.v2, t.v3}) {
            const Vec3 moved = transformed(map, v);
            REQUIRE((close(moved_t.v1, moved, 1e-4f) ||
                     close(moved_t.v2, moved, 1e-4f) ||
                     close(moved_t.v3, moved, 1e-4f)));
        }
        // A point above the old surface is above the new one.
        const Vec3 above_t = transformed(map, t.v1 + normal(t));
        REQUIRE(glm::dot(above_t - moved_t.v1, normal(moved_t)) > 0);
        const Vec3 above_q = transformed(map, q.corner + normal(q));
        REQUIRE(glm::dot(above_q - moved_q.corner, normal(moved_q)) > 0);
    }
    CHECK(mirrored > 500);
}

TEST_CASE("transform: a sphere moves, turns, scales and mirrors") {
    Numbers n;
    for (int i = 0; i < 1000; ++i) {
        const double factor = n.power(-4, 4);
        const Vec3 signs{float(n.sign()), float(n.sign()), float(n.sign())};
        const Transform map = translate(Vec3(n.point(4))) *
                              rotate(Vec3(n.point(1)), float(n.between(-4, 4))) *
                              scale(float(factor) * signs) *
                              rotate(Vec3(n.point(1)), float(n.between(-4, 4)));
        const Sphere ball{Vec3(n.point(2)), float(n.power(-2, 2))};
        const Sphere moved = transformed(map, ball);
        REQUIRE(double(moved.radius) ==
                doctest::Approx(factor * double(ball.radius)).epsilon(1e-5));
        REQUIRE(close(moved.center, transformed(map, ball.center)));
    }
}

TEST_CASE("transform: a sphere refuses to become an ellipsoid") {
    const Sphere ball;
    const auto message = [&](const Transform& map) -> std::string {
        try {
            (void)transformed(map, ball);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "";
    };
    CHECK(message(scale(Vec3{3})) == "");
    const std::string stretched = message(scale(Vec3{8, 1, 1}));
    CHECK(stretched.find("the stretch of a sphere is 4") == 0);
    CHECK(stretched.find("an ellipsoid is not a sphere") != std::string::npos);
    CHECK(message(scale(Vec3{1, 1, 1.001f})) != "");
    CHECK(message(scale(Vec3{1, 0, 1})) != ""); // flat
    CHECK(message(scale(Vec3{0})) != "");       // a point
    CHECK(message(scale(Vec3{std::numeric_limits<float>::quiet_NaN()})) != "");
    Transform shear; // keeps each axis' length nearly, but not the angle
    shear.linear[1] = glm::normalize(Vec3{0.3f, 1, 0});
    CHECK(message(shear) != "");
    // Turned and stretched along a slanted direction.
    const Transform slanted = rotate(Vec3{1, 2, 3}, 1.0f) * scale(Vec3{1, 1.01f, 1}) *
                              rotate(Vec3{1, 2, 3}, -1.0f);
    CHECK(message(slanted) != "");
}
