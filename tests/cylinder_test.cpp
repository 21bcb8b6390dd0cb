// concept: shape
/// \file cylinder_test.cpp
/// \brief Cylinders against signs along the ray in long double, and their light against
/// quadrature.

#include "ljus/geometry/cylinder.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>

#include "ljus/geometry/shape.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

using L = long double;
using V = glm::vec<3, L>;

template <typename T>
CylinderT<T> any_cylinder(Numbers& n) {
    const Vec3T<T> base(n.point(5)), axis(n.power(-1, 1) * n.direction());
    return {base, axis, T(n.power(-1, 0.7))};
}

/// How far outside of the infinite cylinder a point lies, and its height along the
/// axis.
template <typename T>
L outside(const CylinderT<T>& c, const V& point) {
    const V a = glm::normalize(V(c.axis)), way = point - V(c.base);
    return glm::length(glm::cross(a, way)) - L(c.radius);
}
template <typename T>
L height(const CylinderT<T>& c, const V& point) {
    return glm::dot(V(c.axis), point - V(c.base)) / glm::dot(V(c.axis), V(c.axis));
}

/// The first crossing of the surface along a ray, by steps and bisection.
template <typename T>
std::optional<L> first_crossing(const CylinderT<T>& c, const RayT<T>& ray) {
    const auto at = [&](L t) { return V(ray.origin) + t * V(ray.direction); };
    constexpr int steps = 4000;
    constexpr L last = 3;
    for (int i = 0; i < steps; ++i) {
        L a = last * i / steps, b = last * (i + 1) / steps;
        const bool before = outside(c, at(a)) > 0;
        if ((outside(c, at(b)) > 0) == before) continue;
        for (int k = 0; k < 60; ++k) {
            const L middle = (a + b) / 2;
            ((outside(c, at(middle)) > 0) == before ? a : b) = middle;
        }
        if (const L h = height(c, at(a)); h >= 0 && h <= 1) return a;
    }
    return std::nullopt;
}

} // namespace

static_assert(Samplable<Cylinder> && !FlatShape<Cylinder>);

TEST_CASE("cylinder: the unit cylinder, from outside, inside and through its ends") {
    const auto t = [](const Vec3& from, const Vec3& way) {
        const auto hit = intersect(Ray{from, way}, Cylinder{});
        return hit ? hit->t : -1;
    };
    CHECK(t({3, 0.5f, 0}, {-1, 0, 0}) == 2);
    CHECK(t({0, 0.5f, 0}, {-1, 0, 0}) == 1);
    CHECK(t({3, 1.5f, 0}, {-1, 0, 0}) == -1);
    CHECK(t({3, -0.5f, 0}, {-1, 0, 0}) == -1);
    CHECK(t({0, 3, 0}, {0, -1, 0}) == -1);    // along the axis
    CHECK(t({1, 3, 0}, {0, -1, 0}) == -1);    // along its surface
    CHECK(t({-2, 2, 0}, {2, -1, 0}) == 1.5f); // in at the top, out at the side
    CHECK(t({3, 0.5f, 1.01f}, {-1, 0, 0}) == -1);
    CHECK(t({3, 0.5f, 0}, {0, 0, 0}) == -1);
    CHECK_FALSE(intersect(Ray{.origin{3, 0.5f, 0}, .direction{-1, 0, 0}, .t_max = 1.9f},
                          Cylinder{}));
    CHECK(intersect(Ray{.origin{3, 0.5f, 0}, .direction{-1, 0, 0}, .t_min = 2.1f},
                    Cylinder{})
              ->t == 4);
}

TEST_CASE_TEMPLATE("cylinder: what is hit is the first crossing along the ray", T,
                   float, double) {
    Numbers n;
    int hits = 0, differ = 0;
    for (int i = 0; i < 600; ++i) {
        const auto c = any_cylinder<T>(n);
        const Vec3T<T> from(n.point(9));
        const glm::dvec3 aim = glm::dvec3(c.base) + n.next() * glm::dvec3(c.axis) +
                               1.1 * double(c.radius) * n.direction();
        const RayT<T> ray{.origin = from, .direction = Vec3T<T>(aim) - from};
        const auto hit = intersect(ray, c);
        const auto right = first_crossing(c, ray);
        if (hit && hit->t > T(2.99)) continue; // beyond the steps
        if (hit.has_value() != right.has_value()) {
            ++differ; // two crossings within a step, or at a border
            continue;
        }
        if (!hit) continue;
        if (std::abs(L(hit->t) - *right) > 1e-5L) {
            ++differ;
            continue;
        }
        ++hits;
        const auto point = surface_point(c, ray, *hit);
        const V place(point.position);
        CHECK(std::abs(outside(c, place)) <= glm::length(V(point.error)));
        CHECK(glm::length(place - V(ray.origin) - *right * V(ray.direction)) < 1e-4L);
        CHECK(std::abs(height(c, place) - L(hit->v)) < 1e-5L);
        CHECK(std::abs(glm::dot(V(point.normal), glm::normalize(V(c.axis)))) < 1e-6L);
        CHECK(outside(c, place + L(c.radius) / 2 * V(point.normal)) > 0);
        // A ray that leaves on the outside does not come back.
        Vec3T<T> away(n.direction());
        if (glm::dot(away, point.normal) < T(0)) away = -away;
        CHECK_FALSE(intersect(spawn_ray(point, away), c));
    }
    CHECK(hits > 200);
    CHECK(differ < 12);
}

TEST_CASE("cylinder: one so thin that rounding leaves no normal faces the ray") {
    // The ray meets the axis exactly, once the distance is rounded.
    const Cylinder wire{{0, -1, -1e6f}, {0, 2, 0}, 1e-4f};
    const Ray ray{.direction{0, 0, -1}};
    const auto hit = intersect(ray, wire);
    REQUIRE(hit);
    CHECK(surface_point(wire, ray, *hit).normal == Vec3{0, 0, 1});
}

TEST_CASE("cylinder: samples are spread evenly, on it and in its bounds") {
    Numbers n;
    for (int k = 0; k < 20; ++k) {
        const auto c = any_cylinder<float>(n);
        const BoxT<float> box = bounds(c);
        const Sphere ball = bounding_sphere(c);
        constexpr int side = 16;
        glm::dvec3 sum(0);
        double square = 0;
        for (int i = 0; i < side * side; ++i) {
            const Vec2 u{(float(i % side) + 0.5f) / side,
                         (float(i / side) + 0.5f) / side};
            const auto point = sample_area(c, u);
            CHECK(std::abs(outside(c, V(point.position))) <=
                  glm::length(V(point.error)));
            const double h = double(height(c, V(point.position)));
            sum += glm::dvec3(point.position);
            square += h * h;
            CHECK(glm::all(glm::lessThanEqual(box.low, point.position)));
            CHECK(glm::all(glm::lessThanEqual(point.position, box.high)));
            CHECK(glm::distance(ball.center, point.position) < 1.00001f * ball.radius);
        }
        // The mean point is the middle of the axis; the mean of h^2 is 1/3.
        const glm::dvec3 middle = glm::dvec3(c.base) + 0.5 * glm::dvec3(c.axis);
        CHECK(glm::distance(sum / double(side * side), middle) < 1e-4);
        CHECK(square / (side * side) == doctest::Approx(1.0 / 3).epsilon(2e-3));
        CHECK(area(c) == doctest::Approx(2 * std::numbers::pi * double(c.radius) *
                                         glm::length(glm::dvec3(c.axis))));
    }
}

TEST_CASE("cylinder: the light of a tube lamp is what quadrature says") {
    // Seen from distance D at the height of its middle by a surface that faces it:
    // E/L is the integral of cos cos' / d^2 over the visible part, |phi| < acos(R/D).
    const Cylinder lamp{{0, -1, 0}, {0, 2, 0}, 0.5f};
    const double r = 0.5, far = 2, half = 1;
    const double most = std::acos(r / far);
    constexpr int steps = 400;
    double right = 0;
    for (int i = 0; i < steps; ++i)
        for (int k = 0; k < steps; ++k) {
            const double phi = (2 * (i + 0.5) / steps - 1) * most;
            const double y = (2 * (k + 0.5) / steps - 1) * half;
            const double x = r * std::cos(phi), z = r * std::sin(phi);
            const double d2 = (far - x) * (far - x) + y * y + z * z;
            right += (far - x) * ((far - x) * std::cos(phi) - z * std::sin(phi)) /
                     (d2 * d2) * r;
        }
    right *= 4 * most * half / (steps * steps);
    constexpr int side = 400;
    double sum = 0;
    const Vec3 from{2, 0, 0};
    for (int i = 0; i < side * side; ++i) {
        const Vec2 u{(float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side};
        const auto seen = sample_towards(lamp, from, u);
        const Vec3 way = glm::normalize(seen.point.position - from);
        if (glm::dot(way, seen.point.normal) < 0) sum += -way.x / seen.pdf;
    }
    CHECK(sum / (side * side) == doctest::Approx(right).epsilon(1e-3));
}

TEST_CASE("cylinder: two discs close it") {
    const Cylinder c{{1, 2, 3}, {0, 2, 0}, 0.5f};
    const auto ends = ends_of(c);
    CHECK(ends[0].center == Vec3{1, 2, 3});
    CHECK(normal(ends[0]) == Vec3{0, -1, 0});
    CHECK(ends[1].center == Vec3{1, 4, 3});
    CHECK(normal(ends[1]) == Vec3{0, 1, 0});
    // A ray from outside meets the closed body an even number of times.
    Numbers n;
    int met = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 from(n.direction() * 9.0);
        RayT<float> ray{from, Vec3(glm::dvec3(1, 3, 3) + n.point(1)) - from};
        int crossings = 0;
        for (const Disc& end : ends) crossings += intersect(ray, end).has_value();
        while (const auto hit = intersect(ray, c)) {
            ++crossings;
            ray.t_min = std::nextafter(hit->t * 1.00001f, 100.0f);
        }
        CHECK(crossings % 2 == 0);
        met += crossings > 0;
    }
    CHECK(met > 500);
}

TEST_CASE("cylinder: texture coordinates go around and along the axis") {
    Numbers n;
    const auto c = any_cylinder<double>(n);
    const auto frame = frame_around(axis_of(c));
    for (const double u : {0.125, 0.375, 0.625, 0.875}) {
        const double angle = 2 * std::numbers::pi * u;
        const auto out =
            std::cos(angle) * frame.tangent + std::sin(angle) * frame.bitangent;
        const auto place = c.base + 0.25 * c.axis;
        const RayT<double> ray{place + 2 * c.radius * out, -out};
        const auto hit = intersect(ray, c);
        REQUIRE(hit);
        const auto uv = texture_coordinates(c, *hit, surface_point(c, ray, *hit));
        CHECK(uv.x == doctest::Approx(u));
        CHECK(uv.y == doctest::Approx(0.25));
    }
}

TEST_CASE("cylinder: one without a length or a radius is refused") {
    CHECK_NOTHROW(check(Cylinder{}));
    CHECK_THROWS_AS(check(Cylinder{.axis{0, 0, 0}}), std::invalid_argument);
    CHECK_THROWS_WITH_AS(check(Cylinder{.radius = -1}),
                         "cylinder.radius is -1; it must be finite and above 0.",
                         std::invalid_argument);
}
