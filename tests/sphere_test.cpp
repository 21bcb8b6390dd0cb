/// \file sphere_test.cpp
/// \brief Properties of a sphere, for any formula that finds the hit.

#include "ljus/geometry/sphere.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "ljus/geometry/shape.hpp"
#include "support/numbers.hpp"

using ljus::Ray, ljus::RayT;
using ljus::Sphere, ljus::SphereT;
using ljus::Vec3, ljus::Vec3T;
using ljus_test::Numbers;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

} // namespace

TEST_CASE("sphere: known hits") {
    const Sphere ball{.center = {0, 0, -5}, .radius = 1};
    CHECK(*ljus::intersect(Ray{}, ball) == 4.0f);
    CHECK(*ljus::intersect(Ray{.origin = {0, 0, -5}}, ball) == 1.0f); // from the centre
    CHECK(*ljus::intersect(Ray{.origin = {0, 0, -4.5f}}, ball) == 1.5f); // from within
    CHECK_FALSE(ljus::intersect(Ray{.origin = {0, 0, -7}}, ball));       // behind
    CHECK_FALSE(ljus::intersect(Ray{.origin = {0, 1.001f, 0}}, ball));   // beside
    CHECK(*ljus::intersect(Ray{.origin = {0, 1, 0}}, ball) == 5.0f);     // touching
    CHECK(*ljus::intersect(Ray{.origin = {0, 1, -5}}, ball) == 0.0f);    // at the touch
    CHECK(*ljus::intersect(Ray{.direction = {0, 0, -2}}, ball) == 2.0f); // any length
    CHECK(*ljus::intersect<double>(Ray{.direction = {0, 0, -2}}, ball) == 2.0f);
}

TEST_CASE("sphere: a hit lies on the surface, for rays from outside and from within") {
    Numbers numbers;
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Sphere ball{.center = Vec3(numbers.point(5)),
                          .radius = float(numbers.between(0.1, 4))};
        const Vec3 origin = Vec3(numbers.point(9));
        const Vec3 aim = ball.center + Vec3(numbers.point(double(1.2f * ball.radius)));
        const Ray ray{.origin = origin, .direction = aim - origin};
        const auto t = ljus::intersect(ray, ball);
        if (!t) continue;
        ++hits;
        REQUIRE(*t >= 0);
        const float distance = glm::distance(ljus::point_at(ray, *t), ball.center);
        REQUIRE(std::abs(distance - ball.radius) < 1e-5f);
    }
    CHECK(hits > 10000);
}

TEST_CASE("sphere: a miss stays outside at every t") {
    Numbers numbers{7};
    for (int i = 0; i < 2000; ++i) {
        const Sphere ball{.center = Vec3(numbers.point(5)),
                          .radius = float(numbers.between(0.1, 4))};
        const Ray ray{.origin = Vec3(numbers.point(9)),
                      .direction = Vec3(numbers.point(2))};
        if (ljus::intersect(ray, ball)) continue;
        for (float t = 0; t < 20; t += 0.25f)
            REQUIRE(glm::distance(ljus::point_at(ray, t), ball.center) >
                    ball.radius - 1e-5f);
    }
}

TEST_CASE("sphere: t is measured in lengths of the direction") {
    Numbers numbers{11};
    for (int i = 0; i < 2000; ++i) {
        const Sphere ball{.center = Vec3(numbers.point(5)),
                          .radius = float(numbers.between(0.5, 4))};
        Ray ray{.origin = Vec3(numbers.point(9)), .direction = Vec3(numbers.point(2))};
        const auto once = ljus::intersect(ray, ball);
        ray.direction *= 8.0f; // a power of two: exact
        const auto eighth = ljus::intersect(ray, ball);
        REQUIRE(once.has_value() == eighth.has_value());
        if (once) REQUIRE(*eighth == *once / 8.0f);
    }
}

TEST_CASE("sphere: the range of the ray decides which root counts") {
    const Sphere ball{.center = {0, 0, -5}, .radius = 1}; // roots at 4 and 6
    const auto hit = [&](float t_min, float t_max) {
        return ljus::intersect(Ray{.t_min = t_min, .t_max = t_max}, ball);
    };
    CHECK(*hit(0, infinity) == 4.0f);
    CHECK(*hit(4, 4) == 4.0f); // both ends belong to the range
    CHECK(*hit(6, 6) == 6.0f);
    CHECK(*hit(4.5f, infinity) == 6.0f);
    CHECK_FALSE(hit(0, 3.999f));
    CHECK_FALSE(hit(4.5f, 5.5f));
    CHECK_FALSE(hit(6.001f, infinity));
    CHECK_FALSE(hit(5, 4));
    CHECK_FALSE(hit(not_a_number, infinity));
    CHECK_FALSE(hit(0, not_a_number));
}

TEST_CASE("sphere: the chord has both ends, in order, also behind the origin") {
    for (const float z : {-9.0f, -6.0f, -5.5f, -5.0f, -4.25f, -4.0f, 0.0f}) {
        const Sphere ball{.center = {0, 0, -5}, .radius = 1};
        const auto ends = ljus::chord(Ray{.origin = {0, 0, z}}, ball);
        REQUIRE(ends);
        CHECK(ends->enter == z + 4);
        CHECK(ends->leave == z + 6);
    }
    const auto touch = ljus::chord(Ray{.origin = {1, 0, 0}}, Sphere{});
    REQUIRE(touch);
    CHECK(touch->enter == 0.0f);
    CHECK(touch->leave == 0.0f);
}

TEST_CASE("sphere: far away it is neither lost nor found where it is not") {
    Numbers numbers{13};
    for (float distance = 10; distance < 2e5f; distance *= 10)
        for (int i = 0; i < 2000; ++i) {
            const Vec3 origin = distance * glm::normalize(Vec3(numbers.point(1)));
            const Vec3 side =
                glm::normalize(glm::cross(origin, Vec3(numbers.point(1))));
            // Past the centre by 0.9 and by 1.1 radii: a float ray is off by about
            // distance / 1e7 there.
            const auto aimed = [&](float miss) {
                return Ray{.origin = origin,
                           .direction = glm::normalize(miss * side - origin)};
            };
            const auto t = ljus::intersect(aimed(0.9f), Sphere{});
            REQUIRE(t);
            const float slant = std::hypot(distance, 0.9f);
            const float nearest = 0.9f * distance / slant; // of the line, to the centre
            const float expected =
                distance * distance / slant - std::sqrt(1 - nearest * nearest);
            REQUIRE(std::abs(*t - expected) < 2e-6f * distance);
            REQUIRE_FALSE(ljus::intersect(aimed(1.1f), Sphere{}));
        }
}

TEST_CASE("sphere: just above a large sphere the small root does not cancel") {
    // 1024 plus k units in its last place: squares and their difference are exact.
    const Sphere world{.radius = 1024};
    for (int k = 1; k < 20; ++k) {
        const float height = static_cast<float>(k) / 8192.0f;
        const Ray ray{.origin = {0, 1024 + height, 0}, .direction = {0.6f, -0.8f, 0}};
        const auto t = ljus::intersect(ray, world);
        REQUIRE(t);
        CHECK(*t == doctest::Approx(height / 0.8f).epsilon(1e-5));
    }
}

TEST_CASE("sphere: invalid data are a miss") {
    const Sphere ball{.center = {0, 0, -5}, .radius = 1};
    for (const float bad : {not_a_number, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis)
            for (const Vec3 base : {Vec3{0}, Vec3{1, 2, 3}}) {
                Ray origin{.origin = base}, direction{.direction = base};
                Sphere center = ball;
                origin.origin[axis] = direction.direction[axis] = bad;
                center.center[axis] = bad;
                for (const auto& ray : {origin, direction}) {
                    CHECK_FALSE(ljus::chord(ray, ball));
                    CHECK_FALSE(ljus::intersect(ray, ball));
                    CHECK_FALSE(ljus::intersect<double>(ray, ball));
                }
                CHECK_FALSE(ljus::chord(Ray{}, center));
                CHECK_FALSE(ljus::intersect(Ray{}, center));
                CHECK_FALSE(ljus::intersect<double>(Ray{}, center));
            }
    for (const float radius : {0.0f, -0.0f, -1.0f, not_a_number, infinity, -infinity}) {
        const Sphere bad{.center = {0, 0, -5}, .radius = radius};
        CHECK_FALSE(ljus::chord(Ray{}, bad));
        CHECK_FALSE(ljus::intersect(Ray{}, bad));
        CHECK_FALSE(ljus::intersect<double>(Ray{}, bad));
        CHECK_FALSE(ljus::intersect(Ray{.origin = bad.center}, bad));
        CHECK_THROWS_AS(ljus::check(bad), std::invalid_argument);
    }
    for (const float zero : {0.0f, -0.0f})
        for (const float z : {-5.0f, -4.5f, 0.0f}) { // centre, inside, outside
            const Ray ray{.origin = {0, 0, z}, .direction = Vec3{zero}};
            CHECK_FALSE(ljus::intersect(ray, ball));
            CHECK_FALSE(ljus::intersect<double>(ray, ball));
        }
    CHECK_THROWS_WITH_AS(ljus::check(Sphere{.radius = -1}),
                         "sphere.radius is -1; it must be finite and above 0.",
                         std::invalid_argument);
    CHECK_NOTHROW(ljus::check(ball));
}

TEST_CASE("sphere: a chord with an end beyond the largest number is none") {
    // In float the square of the distance overflows, and with it the nearer end.
    const Sphere sphere{.radius = 1e19f};
    for (const float way : {-1.0f, 1.0f})
        CHECK_FALSE(ljus::chord<float>(Ray{.origin{0, 0, 1e20f}, .direction{0, 0, way}},
                                       sphere));
}

TEST_CASE("sphere: a hit is never infinitely far away") {
    // In units of a short direction t leaves the range of float; double holds it.
    int beyond = 0;
    for (const float distance : {1e-30f, 1.0f, 1e10f, 1e18f, 1e30f, 1e38f})
        for (const float length : {1e-45f, 1e-38f, 1e-30f, 1e-20f, 1.0f, 1e20f}) {
            const Sphere ball{.center = {0, 0, -distance}, .radius = 0.5f * distance};
            for (const float z : {0.0f, -distance}) { // from outside, and from within
                const Ray ray{.origin = {0, 0, z}, .direction = {0, 0, -length}};
                const double t = 0.5 * double(distance) / double(length);
                if (const auto hit = ljus::intersect(ray, ball))
                    CHECK(std::isfinite(*hit));
                const auto hit = ljus::intersect<double>(ray, ball);
                if (hit) CHECK(std::isfinite(*hit));
                if (t > 3.5e38) {
                    CHECK_FALSE(hit);
                    ++beyond;
                }
            }
        }
    CHECK(beyond > 5);
}

TEST_CASE("sphere: near the origin the printed formula gives the same hits") {
    Numbers numbers{3};
    int same = 0;
    for (int i = 0; i < 5000; ++i) {
        const Sphere ball{.center = Vec3(numbers.point(3)),
                          .radius = float(numbers.between(0.5, 2))};
        const Vec3 origin = Vec3(numbers.point(5));
        const Vec3 aim = ball.center + Vec3(numbers.point(double(1.2f * ball.radius)));
        const Ray ray{.origin = origin, .direction = glm::normalize(aim - origin)};
        const auto robust = ljus::intersect<double>(ray, ball);
        const auto printed = ljus::intersect_as_printed<double>(ray, ball);
        REQUIRE(robust.has_value() == printed.has_value());
        if (!robust) continue;
        REQUIRE(std::abs(*robust - *printed) < 1e-4f);
        ++same;
    }
    CHECK(same > 2500);
}

TEST_CASE("sphere: the normal points outward and has unit length") {
    Numbers numbers{5};
    for (int i = 0; i < 1000; ++i) {
        const Sphere ball{.center = Vec3(numbers.point(50)),
                          .radius = float(numbers.between(0.01, 9))};
        const Vec3 outward = glm::normalize(Vec3(numbers.point(1)));
        const Vec3 n = ljus::normal(ball, ball.center + ball.radius * outward);
        REQUIRE(std::abs(glm::length(n) - 1) < 3e-7f);
        REQUIRE(glm::dot(n, outward) > 0.999f);
    }
}

TEST_CASE("sphere: the area is 4 pi R^2") {
    CHECK(ljus::area(ljus::SphereT<double>{.radius = 3}) ==
          doctest::Approx(36 * std::numbers::pi).epsilon(1e-15));
}

TEST_CASE_TEMPLATE(
    "sphere: both ends of a chord are finite and in order, for every length "
    "that the arithmetic holds",
    T, float, double) {
    // Tangents, where the two are one; and lengths up to the end of the range.
    Numbers n{23};
    constexpr bool single = sizeof(T) == 4;
    const double most = single ? 18 : 150;
    long hits = 0, wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        const double size = i % 2 ? n.power(-2, 2) : n.power(-most, most - 1);
        const auto center = size * n.point(3);
        const double radius = size * n.between(0.1, 1);
        const auto across = n.direction();
        const auto origin =
            center + radius * n.power(-0.3, 0.3) * n.direction() + radius * across;
        auto direction = glm::cross(across, n.direction());
        const auto touching = center + radius * across;
        if (i % 3 == 0) direction = touching - origin;
        if (!(glm::length(direction) > 0)) continue;
        const double unit = 1 / glm::length(direction);
        const double other = n.power(-most, most);
        const bool held = std::abs(std::log10(size * other)) < most;
        const RayT<T> ray{.origin = Vec3T<T>(origin),
                          .direction =
                              Vec3T<T>(unit * direction * (i % 5 && held ? other : 1))};
        const SphereT<T> sphere{.center = Vec3T<T>(center), .radius = T(radius)};
        const auto chord = ljus::chord(ray, sphere);
        if (!chord) continue;
        ++hits;
        wrong += !(std::isfinite(chord->enter) && std::isfinite(chord->leave) &&
                   chord->enter <= chord->leave);
    }
    CHECK(hits > 50000);
    CHECK(wrong == 0);
    // Beyond it there is no hit, rather than an infinite one.
    const T far = single ? T(1e19) : T(1e154);
    for (const T radius : {T(1), far, T(4) * far})
        for (const T length : {T(1), far}) {
            const RayT<T> ray{.origin = {-T(8) * far, T(0), T(0)},
                              .direction = {length, T(0), T(0)}};
            if (const auto c = ljus::chord(ray, SphereT<T>{.radius = radius}))
                CHECK((std::isfinite(c->enter) && std::isfinite(c->leave)));
        }
}

TEST_CASE("sphere: the printed formula has the range of the ray, and no hit for NaN") {
    const Sphere ball{.center = {0, 0, -5}, .radius = 1}; // roots at 4 and 6
    const auto hit = [&](float t_min, float t_max) {
        return ljus::intersect_as_printed(Ray{.t_min = t_min, .t_max = t_max}, ball);
    };
    CHECK(*hit(0, infinity) == 4.0f);
    CHECK(*hit(4, 4) == 4.0f);
    CHECK(*hit(6, 6) == 6.0f);
    CHECK(*hit(4.5f, infinity) == 6.0f);
    CHECK_FALSE(hit(0, 3.999f));
    CHECK_FALSE(hit(4.5f, 5.5f));
    CHECK_FALSE(hit(6.001f, infinity));
    CHECK_FALSE(hit(0, not_a_number));
    CHECK(*ljus::intersect_as_printed(Ray{.origin = {0, 1, 0}}, ball) == 5.0f);
    CHECK(*ljus::intersect_as_printed(Ray{.origin = {0, 0, -5}}, ball) == 1.0f);
    CHECK_FALSE(ljus::intersect_as_printed(Ray{.origin = {0, 1.5f, 0}}, ball));
    CHECK_FALSE(ljus::intersect_as_printed(Ray{.origin = {0, 0, -7}}, ball));
    CHECK_FALSE(ljus::intersect_as_printed(Ray{.origin = {not_a_number, 0, 0}}, ball));
}
