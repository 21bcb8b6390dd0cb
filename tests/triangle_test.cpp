/// \file triangle_test.cpp
/// \brief Properties of a triangle, for any formula that finds the hit.

#include "ljus/geometry/triangle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/plain_triangle.hpp"
#include "ljus/geometry/watertight.hpp"
#include "support/numbers.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

/// In the plane z = -4; x and y are u and v.
const Triangle half_square{{0, 0, -4}, {1, 0, -4}, {0, 1, -4}};

Ray down_at(float x, float y) {
    return {.origin = {x, y, 0}, .direction = {0, 0, -1}};
}

} // namespace

TEST_CASE("triangle: known hits") {
    const auto hit = intersect<float>(down_at(0.25f, 0.5f), half_square);
    REQUIRE(hit);
    CHECK(hit->t == 4.0f);
    CHECK(hit->u == 0.25f);
    CHECK(hit->v == 0.5f);
    CHECK(intersect<double>(down_at(0.25f, 0.5f), half_square)->t == 4.0f);
    // From behind as well, and in lengths of the direction.
    const Ray up{.origin = {0.25f, 0.25f, -6}, .direction = {0, 0, 4}};
    CHECK(intersect<float>(up, half_square)->t == 0.5f);
}

TEST_CASE("triangle: each of the three edges is a border, and belongs to it") {
    for (const float along : {0.0f, 0.125f, 0.5f, 0.75f, 1.0f}) {
        CHECK(intersect<float>(down_at(along, 0), half_square));
        CHECK(intersect<float>(down_at(0, along), half_square));
        CHECK(intersect<float>(down_at(along, 1 - along), half_square));
        CHECK_FALSE(intersect<float>(down_at(along, -0.001f), half_square));
        CHECK_FALSE(intersect<float>(down_at(-0.001f, along), half_square));
        CHECK_FALSE(intersect<float>(down_at(along, 1.001f - along), half_square));
        // One step beyond the border is beyond it.
        CHECK_FALSE(
            intersect<float>(down_at(along, std::nextafter(0.0f, -1.0f)), half_square));
        CHECK_FALSE(
            intersect<float>(down_at(std::nextafter(0.0f, -1.0f), along), half_square));
    }
    CHECK_FALSE(
        intersect<float>(down_at(0.9f, 0.9f), half_square)); // the rest of the square
}

TEST_CASE("triangle: a hit point is where its coordinates say, and on the ray") {
    Numbers n;
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const Triangle triangle{Vec3(n.point(3)), Vec3(n.point(3)), Vec3(n.point(3))};
        const Vec3 origin(n.point(6));
        const Ray ray{.origin = origin, .direction = Vec3(n.point(3)) - origin};
        const auto hit = intersect<float>(ray, triangle);
        if (!hit) continue;
        ++hits;
        REQUIRE(hit->u >= 0);
        REQUIRE(hit->v >= 0);
        REQUIRE(hit->u + hit->v <= 1 + 1e-6f);
        const Vec3 on_triangle = point_at(triangle, hit->u, hit->v).position;
        REQUIRE(glm::distance(on_triangle, point_at(ray, hit->t)) < 1e-3f);
    }
    CHECK(hits > 1000);
}

TEST_CASE("triangle: as many rays hit as the solid angle says") {
    // Van Oosterom and Strackee's closed form for the solid angle of a triangle.
    using V = Vec3T<double>;
    Numbers n{3};
    for (int k = 0; k < 4; ++k) {
        const V a = n.point(2) + V{0, 0, -2}, b = n.point(2), c = n.point(2);
        const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
        const double omega =
            2 * std::atan2(std::abs(glm::dot(a, glm::cross(b, c))),
                           la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la +
                               glm::dot(c, a) * lb);
        ljus_test::Mean share;
        for (int i = 0; i < 200000; ++i) {
            const double z = n.between(-1, 1), phi = n.between(0, 6.283185307179586);
            const double r = std::sqrt(1 - z * z);
            const Ray ray{.direction = {float(r * std::cos(phi)),
                                        float(r * std::sin(phi)), float(z)}};
            share.add(intersect<float>(ray, Triangle{Vec3(a), Vec3(b), Vec3(c)})
                          ? 12.566370614
                          : 0);
        }
        CAPTURE(omega);
        CHECK(share.agrees_with(omega));
    }
}

TEST_CASE("triangle: a mesh of any size has no holes") {
    // Eight faces of an octahedron: every ray from within leaves through one.
    for (const float size : {1e-12f, 1e-6f, 1e-4f, 1e-2f, 1.0f, 1e3f, 1e9f, 1e15f}) {
        std::vector<Triangle> mesh;
        for (const float x : {-size, size})
            for (const float y : {-size, size})
                for (const float z : {-size, size})
                    mesh.push_back({{x, 0, 0}, {0, y, 0}, {0, 0, z}});
        Numbers n{5};
        int missed = 0;
        for (int i = 0; i < 2000; ++i) {
            const Vec3 origin(0.3 * double(size) * n.direction());
            const Ray ray{.origin = origin, .direction = Vec3(n.direction())};
            int hits = 0;
            for (const Triangle& face : mesh)
                if (const auto hit = intersect<float>(ray, face)) {
                    ++hits;
                    REQUIRE(hit->t > 0.2f * size);
                    REQUIRE(hit->t < 1.4f * size);
                }
            missed += hits == 0;
        }
        CAPTURE(size);
        CHECK(missed == 0);
    }
}

TEST_CASE("triangle: the range of the ray decides") {
    const auto hit = [](float t_min, float t_max) {
        Ray ray = down_at(0.25f, 0.25f);
        ray.t_min = t_min, ray.t_max = t_max;
        return intersect<float>(ray, half_square).has_value();
    };
    CHECK(hit(0, infinity));
    CHECK(hit(4, 4)); // both ends belong to it
    CHECK(hit(0, 4));
    CHECK(hit(4, infinity));
    CHECK_FALSE(hit(0, std::nextafter(4.0f, 0.0f)));
    CHECK_FALSE(hit(std::nextafter(4.0f, 5.0f), infinity));
    CHECK_FALSE(hit(5, 3));
    CHECK_FALSE(hit(not_a_number, infinity));
    CHECK_FALSE(hit(0, not_a_number));
    Ray away = down_at(0.25f, 0.25f);
    away.direction.z = 1;
    CHECK_FALSE(intersect<float>(away, half_square));
    away.t_min = -infinity; // the whole line
    CHECK(intersect<float>(away, half_square)->t == -4.0f);
}

TEST_CASE("triangle: invalid data are a miss") {
    const Ray good = down_at(0.25f, 0.25f);
    const auto misses = [](const Ray& ray, const Triangle& triangle) {
        return !intersect<float>(ray, triangle) && !intersect<double>(ray, triangle);
    };
    REQUIRE_FALSE(misses(good, half_square));
    for (const float bad : {not_a_number, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            CAPTURE(bad);
            CAPTURE(axis);
            Ray ray = good;
            ray.origin[axis] = bad;
            CHECK(misses(ray, half_square));
            ray = good;
            ray.direction[axis] = bad;
            CHECK(misses(ray, half_square));
            for (Vec3 Triangle::*vertex :
                 {&Triangle::v1, &Triangle::v2, &Triangle::v3}) {
                Triangle triangle = half_square;
                (triangle.*vertex)[axis] = bad;
                CHECK(misses(good, triangle));
            }
        }
    for (const float zero : {0.0f, -0.0f})
        for (const float z : {0.0f, -4.0f}) {
            const Ray ray{.origin = {0.25f, 0.25f, z}, .direction = Vec3{zero}};
            CHECK(misses(ray, half_square));
        }
}

TEST_CASE("triangle: one without an area is never hit") {
    const Vec3 a{0, 0, -4}, b{1, 0, -4}, c{2, 0, -4};
    for (const Triangle& thin :
         {Triangle{a, a, a}, Triangle{a, a, b}, Triangle{a, b, a}, Triangle{b, a, a},
          Triangle{a, b, c}})
        for (const float x : {0.0f, 0.25f, 0.5f, 1.0f}) {
            CHECK_FALSE(intersect<float>(down_at(x, 0), thin));
            CHECK_FALSE(intersect<double>(down_at(x, 0), thin));
            // Nor by a ray within its line.
            const Ray along{.origin = {x, 0, -4}, .direction = {1, 0, 0}};
            CHECK_FALSE(intersect<float>(along, thin));
        }
}

TEST_CASE("triangle: rays aimed at where one without an area lies miss it") {
    Numbers n;
    const auto whole = [&] {
        const auto below = [&] { return float(int(n.next() * 41)) - 20; };
        const float x = below(), y = below(), z = below();
        return Vec3{x, y, z};
    };
    long hits = 0;
    for (int i = 0; i < 300000; ++i) {
        // Two equal corners, or three on a line, with coordinates that no sum rounds.
        const Vec3 a = whole() / 2.0f, way = whole() / 4.0f;
        const Vec3 b = i % 2 == 0 ? a : a + float(1 + i % 5) * way;
        const Vec3 c = a + 2.0f * way;
        const Triangle thin = i % 3 == 0   ? Triangle{a, b, c}
                              : i % 3 == 1 ? Triangle{b, c, a}
                                           : Triangle{c, a, b};
        const Vec3 at = a + float(n.next()) * (c - a);
        const Vec3 origin = whole();
        for (const Vec3& target : {at, b}) {
            const Ray ray{.origin = origin, .direction = target - origin};
            hits += intersect<float>(ray, thin).has_value();
            hits += intersect<double>(ray, thin).has_value();
            hits += intersect<ljus::Watertight>(ray, thin).has_value();
        }
    }
    CHECK(hits == 0);
    // A case that was found from outside.
    const Triangle found{{-8, -2, 1}, {-11, 0, 2}, {-17, 4, 4}};
    const Ray ray{.origin = {-11.5f, 3, 8.5f}, .direction = {-1, -2, -6}};
    CHECK_FALSE(intersect<ljus::Watertight>(ray, found));
    CHECK_FALSE(intersect<float>(ray, found));
    CHECK_FALSE(intersect(ray, found));
}

TEST_CASE("triangle: a ray within its plane is a miss") {
    for (const float y : {-1.0f, 0.0f, 0.25f, 1.0f}) {
        const Ray ray{.origin = {-2, y, -4}, .direction = {1, 0, 0}};
        CHECK_FALSE(intersect<float>(ray, half_square));
        CHECK_FALSE(intersect<double>(ray, half_square));
    }
}

TEST_CASE("triangle: sizes beyond the arithmetic are never a false hit") {
    // Overflow of the determinant would make all three quotients 0, a "hit" at 0.
    const Triangle vast{{0, 0, -1e10f}, {1e10f, 0, -1e10f}, {0, 1e10f, -1e10f}};
    const Ray beside{.origin = {-1, 0, 0}, .direction = {0, 0, -1e28f}};
    CHECK_FALSE(intersect<float>(beside, vast));
    for (const float size : {1e16f, 1e20f, 1e30f, 1e38f})
        for (const float length : {1e-38f, 1e-20f, 1.0f, 1e20f, 1e38f}) {
            const Triangle t{{0, 0, -size}, {size, 0, -size}, {0, size, -size}};
            for (const Vec3 way : {Vec3{-1, 0, -1}, Vec3{0, -1, -1}, Vec3{1, 1, -1}}) {
                const Ray ray{.origin = 0.1f * size * way, .direction = length * way};
                CHECK_FALSE(intersect<float>(ray, t));
                CHECK_FALSE(intersect<double>(ray, t));
            }
        }
    // Nor is a hit infinitely far away.
    for (const float size : {1e-40f, 1e-30f, 1e-20f, 1e16f, 1e20f, 1e30f, 1e38f})
        for (const float length : {1e-38f, 1e-20f, 1.0f, 1e20f, 1e38f}) {
            const Triangle t{{0, 0, -size}, {size, 0, -size}, {0, size, -size}};
            const Ray ray{.origin = {0.2f * size, 0.2f * size, 0},
                          .direction = {0, 0, -length}};
            if (const auto hit = intersect<float>(ray, t)) CHECK(std::isfinite(hit->t));
            if (const auto hit = intersect<double>(ray, t))
                CHECK(std::isfinite(hit->t));
        }
}

TEST_CASE_TEMPLATE("triangle: the normal is that of exact arithmetic", T, float,
                   double) {
    // Thin ones too, for the normal decides on which side a ray leaves.
    Numbers n{9};
    for (int i = 0; i < 5000; ++i) {
        const double size = n.power(-6, 6), thin = n.power(-3, 0);
        const auto a = n.direction(), b = n.direction();
        const auto p = size * n.point(3);
        const TriangleT<T> t{Vec3T<T>(p), Vec3T<T>(p + size * a),
                             Vec3T<T>(p + size * (a + thin * b))};
        using L = glm::vec<3, long double>;
        const L e1 = L(t.v2) - L(t.v1), e2 = L(t.v3) - L(t.v1);
        const L truth =
            glm::normalize(L{e1.y * e2.z - e1.z * e2.y, e1.z * e2.x - e1.x * e2.z,
                             e1.x * e2.y - e1.y * e2.x});
        const auto off = glm::length(L(normal(t)) - truth);
        const double allowed = sizeof(T) == 4 ? 1e-7 : 1e-12;
        REQUIRE(double(off) < allowed);
    }
}

TEST_CASE("triangle: normal and area of any size") {
    for (const float size : {1e-15f, 1e-10f, 1e-5f, 1.0f, 1e5f, 1e10f, 1e15f}) {
        const Triangle t{{0, 0, 0}, {size, 0, 0}, {0, size, 0}};
        CHECK(normal(t) == Vec3{0, 0, 1});
        CHECK(area(t) == ljus_test::within(double(size) * size / 2, 1e-6));
        const Triangle turned{t.v1, t.v3, t.v2};
        CHECK(normal(turned) == Vec3{0, 0, -1});
    }
}

TEST_CASE("triangle: sampled points cover its area evenly") {
    // Counted in the barycentric plane: each of 16 similar parts, one in a million.
    Numbers n{11};
    const Triangle t{{1, 2, 3}, {4, 2, -1}, {0, 5, 2}};
    std::array<int, 16> parts{};
    ljus_test::Mean x;
    for (int i = 0; i < 160000; ++i) {
        const SurfacePoint p = sample_area(t, n.square<float>());
        x.add(p.position.x);
        const Vec3 up = normal(t);
        const Vec3 way = p.position - t.v1;
        const Vec3 e1 = t.v2 - t.v1, e2 = t.v3 - t.v1;
        const float twice = glm::dot(glm::cross(e1, e2), up);
        const float u = glm::dot(glm::cross(way, e2), up) / twice;
        const float v = glm::dot(glm::cross(e1, way), up) / twice;
        REQUIRE(u > -1e-5f);
        REQUIRE(v > -1e-5f);
        REQUIRE(u + v < 1 + 1e-5f);
        const int i4 = std::min(3, std::max(0, int(u * 4)));
        const int j4 = std::min(3 - i4, std::max(0, int(v * 4)));
        const bool upper = (u * 4 - float(i4)) + (v * 4 - float(j4)) > 1;
        // Row i4 holds 7 - 2 i4 parts.
        const int before = i4 * 8 - i4 * i4;
        const int place = before + std::min(2 * j4 + upper, 6 - 2 * i4);
        ++parts[static_cast<std::size_t>(place)];
    }
    CHECK(ljus_test::chi_square(parts) < ljus_test::chi_square_limit(15));
    CHECK(x.agrees_with(5.0 / 3.0)); // the centroid
}

TEST_CASE("triangle: the point at u, v, and how far rounding may have moved it") {
    Numbers n;
    double largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto place = n.power(-2, 2) * n.direction();
        const double size = n.power(-2, 2);
        const auto corner = [&] { return Vec3(place + size * n.point(1)); };
        const Triangle t{corner(), corner(), corner()};
        auto u = n.square<float>();
        if (u.x + u.y > 1) u = 1.0f - u;
        const SurfacePoint p = point_at(t, u.x, u.y);
        const glm::dvec3 a = (1 - double(u.x) - double(u.y)) * glm::dvec3(t.v1);
        const glm::dvec3 b = double(u.x) * glm::dvec3(t.v2);
        const glm::dvec3 c = double(u.y) * glm::dvec3(t.v3);
        const glm::dvec3 off = glm::abs(glm::dvec3(p.position) - (a + b + c));
        const glm::dvec3 all = glm::abs(a) + glm::abs(b) + glm::abs(c);
        for (int axis = 0; axis < 3; ++axis) {
            // 1 - u - v has an error of its own: of a weight, by the size of v1.
            const double weight = 0x1p-23 * std::abs(double(t.v1[axis]));
            REQUIRE(off[axis] <= double(p.error[axis]) + weight);
            REQUIRE(double(p.error[axis]) <= 1.01 * 7 * 0x1p-24 * all[axis] + weight);
            largest = std::max(largest, off[axis] / double(p.error[axis]));
        }
        CHECK(glm::distance(p.normal, normal(t)) == 0);
    }
    CHECK(largest > 0.1);
}

TEST_CASE("triangle: near each of its corners the error holds the way to its plane") {
    // There one of the three terms is nearly all of the point. A ray that leaves it is
    // moved along the normal, and by no more than the error says.
    Numbers n{3};
    double largest = 0;
    for (int i = 0; i < 6000; ++i) {
        const glm::dvec3 place = 100.0 * n.direction();
        const auto corner = [&] { return Vec3(place + n.point(20)); };
        const Triangle t{corner(), corner(), corner()};
        const float near = float(n.between(0, 0.02)), far = 1 - 2 * near;
        const Vec2 u = i % 3 == 0   ? Vec2{near, near}
                       : i % 3 == 1 ? Vec2{far, near}
                                    : Vec2{near, far};
        const SurfacePoint p = point_at(t, u.x, u.y);
        const glm::dvec3 v1(t.v1), up = glm::normalize(glm::cross(
                                       glm::dvec3(t.v2) - v1, glm::dvec3(t.v3) - v1));
        const double height = std::abs(glm::dot(up, glm::dvec3(p.position) - v1));
        const double bound = glm::dot(glm::abs(up), glm::dvec3(p.error));
        REQUIRE(height <= bound);
        largest = std::max(largest, height / bound);
    }
    CHECK(largest > 0.2);
}

TEST_CASE("triangle: a hit names no triangle of a mesh") {
    CHECK(intersect(down_at(0.25f, 0.25f), half_square)->part == 0);
}

TEST_CASE_TEMPLATE("triangle: no area in data of any size and precision is never hit",
                   T, float, double) {
    // Edges of 53 bits, whose products round, and corners a power of ten apart.
    Numbers n{17};
    long hits = 0;
    for (int i = 0; i < 200000; ++i) {
        const Vec3T<T> a(n.power(-6, 3) * n.point(1)), c(n.point(10));
        const Vec3T<T> b = i % 2 ? T(2) * a : a, far = i % 2 ? T(4) * a : c;
        const TriangleT<T> thin = i % 3 == 0   ? TriangleT<T>{a, b, far}
                                  : i % 3 == 1 ? TriangleT<T>{b, far, a}
                                               : TriangleT<T>{far, a, b};
        const Vec3T<T> origin(n.point(20));
        for (const Vec3T<T>& target : {a + T(n.next()) * (far - a), a, far}) {
            const RayT<T> ray{.origin = origin, .direction = target - origin};
            hits += intersect<T>(ray, thin).has_value();
            hits += intersect(ray, thin).has_value();
            hits += intersect<ljus::Watertight>(ray, thin).has_value();
        }
    }
    CHECK(hits == 0);
    // And one that has an area is not lost, however thin its bits allow.
    // (Of doubles, edges are a rounding off themselves.)
    if constexpr (sizeof(T) == 4) {
        const T last = std::nextafter(T(1), T(2));
        CHECK(has_area(Triangle{{0, 0, 0}, {1, last, 0}, {last, 1, 0}}));
        CHECK(has_area(Triangle{{0, 0, 0}, {1, 1, 0}, {1, last, 0}}));
    }
}

TEST_CASE("triangle: a hit does not lie beside a sliver in whose plane the ray is") {
    // In such a plane rounding moves u and v by any amount: the border has an end.
    Numbers n{13};
    int hits = 0;
    double beside = 0;
    for (int i = 0; i < 400000; ++i) {
        const Vec3T<double> a = n.point(1), way = n.direction();
        const Vec3 v1(a), v2(a + way);
        const Vec3 v3(a + n.between(-1, 2) * way + n.power(-8, -5) * n.direction());
        const Vec3 u = v2 - v1, v = v3 - v1;
        const Vec3 at = v1 + float(n.between(-0.1, 1.1)) * u;
        const Vec3 along =
            glm::normalize(float(n.between(-1, 1)) * u + float(n.between(-1, 1)) * v);
        const Ray ray{.origin = at - along, .direction = along};
        const Triangle sliver{v1, v2, v3};
        const auto hit = intersect(ray, sliver);
        if (!hit) continue;
        ++hits;
        const auto x =
            Vec3T<double>(ray.origin) + double(hit->t) * Vec3T<double>(ray.direction);
        for (int axis = 0; axis < 3; ++axis) {
            const double low = std::min({v1[axis], v2[axis], v3[axis]}),
                         high = std::max({v1[axis], v2[axis], v3[axis]});
            beside = std::max({beside, low - x[axis], x[axis] - high});
        }
    }
    CHECK(hits > 1000);
    CHECK(beside < 1e-6);
}

TEST_CASE("triangle: the border is as wide as the rounding, and open on slivers") {
    // u by the same formula, in the 64 bits of long double's mantissa.
    using D = Vec3T<double>;
    using Wide = glm::vec<3, long double>;
    Numbers n{17};
    const double near = std::numeric_limits<float>::epsilon();
    int closed = 0, open = 0;
    double farthest = 0;
    for (int i = 0; i < 20000; ++i) {
        const D d = n.direction(), e1 = n.direction();
        const D e2 = e1 * n.between(-1, 2) + n.power(-9, 0) * n.direction();
        // The origin of a ray that meets the edge E2, where u is 0.
        const D to = n.between(0, 1) * e2 - n.power(-3, 3) * d;
        const auto u_of = [&]<typename V>(V) {
            const V p = glm::cross(V(d), V(e2));
            return glm::dot(p, V(to)) * (1 / glm::dot(p, V(e1)));
        };
        const double inverse = 1 / glm::dot(glm::cross(d, e2), e1);
        const double border = detail::border_of_rounding(d, to, e1, e2, inverse, near);
        const double unbound =
            detail::border_of_rounding(d, to, e1, e2, inverse, 1e300);
        const auto off = double(std::abs((long double)(u_of(D{})) - u_of(Wide{})));
        // No more than what the doc says it is, and no less than what happens.
        REQUIRE(unbound < 64 * 16 * 1.2e-16 * glm::length(to) * std::abs(inverse) *
                              (1 + glm::length(e2)));
        farthest = std::max(farthest, off / unbound);
        if (unbound <= near) {
            ++closed;
            REQUIRE(border == unbound);
        } else {
            ++open;
            REQUIRE(border == 0);
        }
    }
    CHECK(farthest <= 1);
    CHECK(closed > 1000);
    CHECK(open > 1000);
}

TEST_CASE("triangle: the border by hand, along each axis") {
    for (int axis = 0; axis < 3; ++axis) {
        const auto along = [&](double x) {
            Vec3T<double> v{0};
            v[axis] = x;
            return v;
        };
        // |D| |T| (|E1| + |E2|) / |determinant|
        CHECK(detail::border_of_rounding(along(-3), along(5), along(7), along(-11),
                                         -2.0, 1.0) ==
              detail::rounding_bound<double>(16) * 3 * 5 * 18 * 2);
    }
}

TEST_CASE("triangle: a hit in the border has coordinates that are not below 0") {
    // Just below 0 an image would show its other end. The rays meet the middle of an
    // edge exactly; the products of such large whole numbers are rounded.
    Numbers n{31};
    const auto whole = [&] { return n.whole_point(1 << 20); };
    int on_edge = 0, open = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 v1 = whole(), half = whole(), other = v1 + whole(), way = whole();
        const Vec3 far = v1 + 2.0f * half;
        for (const Vec3& at : {v1 + half, far}) {
            const Ray ray{.origin = at - way, .direction = way};
            for (const Triangle& t :
                 {Triangle{v1, other, far}, Triangle{v1, far, other},
                  Triangle{other, far, v1}}) {
                const auto hit = intersect(ray, t);
                open += !hit; // slivers alone: the border of all others is closed
                if (!hit) continue;
                REQUIRE(hit->u >= 0);
                REQUIRE(hit->v >= 0);
                on_edge += hit->u == 0 || hit->v == 0;
            }
        }
    }
    CHECK(on_edge > 1000);
    CHECK(open < 60);
}

TEST_CASE("triangle: a point of doubles tells how badly the plane is known") {
    const auto tilt = [](auto one) {
        const TriangleT<decltype(one)> t{{0, 0, 0}, {2, 0, 0}, {4, one / 1024, 0}};
        CHECK(sample_area(t, {one / 4, one / 2}).tilt ==
              point_at(t, one, 0 * one).tilt);
        return point_at(t, one / 4, one / 2).tilt;
    };
    // The sizes of the edges over the area between them: 2 (4 + 1/1024) 1024 / 2.
    CHECK(tilt(1.0) == 4097);
    CHECK(tilt(1.0f) == 0); // a test in double does not turn it
}

TEST_CASE("triangle: of a parallelogram u and v are within [0, 1] each") {
    const auto hit = [](float x, float y) {
        return moller_trumbore<Spanned::parallelogram, double>(
            down_at(x, y), {0, 0, -4}, {1, 0, 0}, {0, 1, 0});
    };
    for (const float along : {0.0f, 0.25f, 1.0f}) {
        CHECK(hit(along, 0));
        CHECK(hit(along, 1));
        CHECK(hit(0, along));
        CHECK(hit(1, along));
        CHECK_FALSE(hit(along, -0.001f));
        CHECK_FALSE(hit(along, 1.001f));
        CHECK_FALSE(hit(-0.001f, along));
        CHECK_FALSE(hit(1.001f, along));
    }
    REQUIRE(hit(0.25f, 0.5f));
    CHECK(hit(0.25f, 0.5f)->part == 0);
}

// Within 1e-3 of an edge float may decide either way; elsewhere both must agree.
TEST_CASE("triangle: the formula on paper agrees away from edges") {
    Numbers numbers{31};
    int hits = 0, misses = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Triangle triangle{Vec3(numbers.point(1)), Vec3(numbers.point(1)),
                                Vec3(numbers.point(1))};
        const double u = numbers.between(-0.5, 1.5), v = numbers.between(-0.5, 1.5);
        const double nearest =
            std::min({std::abs(u), std::abs(v), std::abs(1 - u - v)});
        if (area(triangle) < 0.1f || nearest < 1e-3) continue;
        const Vec3 target = triangle.v1 + float(u) * (triangle.v2 - triangle.v1) +
                            float(v) * (triangle.v3 - triangle.v1);
        const Vec3 way(numbers.direction());
        if (std::abs(glm::dot(way, normal(triangle))) < 0.1f) continue;
        const Ray ray{.origin = target - 3.0f * way, .direction = way};
        const auto hit = examples::intersect_plainly(ray, triangle);
        const bool inside = u > 0 && v > 0 && u + v < 1;
        CHECK(hit.has_value() == inside);
        (inside ? hits : misses) += 1;
        if (!hit) continue;
        CHECK(hit->t == doctest::Approx(3).epsilon(1e-5));
        CHECK(hit->u == doctest::Approx(u).epsilon(1e-4).scale(1));
        CHECK(hit->v == doctest::Approx(v).epsilon(1e-4).scale(1));
    }
    CHECK(hits > 1000);
    CHECK(misses > 1000);
}
