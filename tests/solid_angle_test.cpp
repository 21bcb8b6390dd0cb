/// \file solid_angle_test.cpp
/// \brief Points chosen for an observer: their densities against closed forms.
///
/// The mean of 1/pdf over the points that face the observer is the solid angle of the
/// shape; a test of a mean gives a false alarm once in 1.7 million, of counts once in a
/// million.

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/solid_angle.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/draws.hpp"
#include "support/numbers.hpp"
#include "support/statistics.hpp"
#include "support/within.hpp"

using namespace ljus;
using ljus_test::Draws;
using ljus_test::Mean;
using ljus_test::Numbers;

namespace {

constexpr double pi = std::numbers::pi;

/// Van Oosterom and Strackee (1983).
double solid_angle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
    const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
    return 2 * std::abs(std::atan2(glm::dot(a, glm::cross(b, c)),
                                   la * lb * lc + glm::dot(a, b) * lc +
                                       glm::dot(b, c) * la + glm::dot(c, a) * lb));
}

/// 2 pi (1 - cos), of a sphere from outside.
long double cone_of(long double radius, long double distance) {
    const long double sine = radius / distance;
    return 2 * std::numbers::pi_v<long double> * sine * sine /
           (1 + std::sqrt((1 - sine) * (1 + sine)));
}

/// 1/pdf over the sampled points that face the observer, or over all of them.
template <typename S, typename T>
Mean measured(const S& shape, const Vec3T<T>& from, int count, bool all = false) {
    Numbers n;
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const SeenPointT<T> seen = sample_towards(shape, from, n.square<T>());
        const bool faces = glm::dot(seen.point.position - from, seen.point.normal) < 0;
        mean.add(faces || all ? 1.0 / double(seen.pdf) : 0.0);
    }
    return mean;
}

} // namespace

TEST_CASE_TEMPLATE("solid angle: the cone of a sphere, near, far, tiny and huge", T,
                   float, double) {
    const T u = std::numeric_limits<T>::epsilon();
    for (const double radius : {1e-6, 1e-3, 1.0, 1e3, 1e6})
        for (const double ratio : {1.001, 1.1, 2.0, 10.0, 1e2, 1e4, 1e6}) {
            CAPTURE(radius);
            CAPTURE(ratio);
            const SphereT<T> ball{{0, T(radius * ratio), 0}, T(radius)};
            const detail::ConeT<T> cone = detail::cone_towards(ball, Vec3T<T>{0});
            const auto truth = double(
                cone_of((long double)(ball.radius), (long double)(ball.center.y)));
            CHECK(double(cone.axis.y) == doctest::Approx(1).epsilon(double(u)));
            CHECK(cone.axis.x == T(0));
            const double allowed = double(u) * (ratio < 1.01 ? 100 : 8);
            CHECK(2 * pi * double(cone.one_minus_cos) ==
                  ljus_test::within(truth, allowed));
            // And so is the density of every point, for all of the cone.
            Numbers n;
            for (int i = 0; i < 50; ++i) {
                const auto seen = sample_towards(ball, Vec3T<T>{0}, n.square<T>());
                REQUIRE(double(seen.pdf) == ljus_test::within(1 / truth, allowed));
            }
        }
}

TEST_CASE("solid angle: from inside a sphere every direction leads to it") {
    const Sphere room{{1, 2, 3}, 2};
    for (const Vec3 from : {Vec3{1, 2, 3}, Vec3{2, 2, 3}, Vec3{1, 0.5f, 3}}) {
        CHECK_FALSE(detail::sees_cone(room, from));
        CHECK(detail::cone_towards(room, from).one_minus_cos == 2.0f);
        CHECK(measured(room, from, 20000, true).agrees_with(4 * pi, 1e-5));
    }
    // Close to the wall the mean converges slowly, but to the same.
    CHECK(measured(room, Vec3{1, 2, 1.1f}, 200000, true).agrees_with(4 * pi));
}

TEST_CASE("solid angle: a sphere just outside of which the observer stands") {
    // As close as two millionths of the radius, samples are not wasted on points that
    // the observer cannot see.
    const Sphere ball{{0, 0, 0}, 1};
    for (const float height : {3e-6f, 1e-5f, 1e-4f, 1e-3f, 0.1f}) {
        CAPTURE(height);
        const Vec3 from{0, 1 + height, 0};
        const double truth = double(cone_of(1, (long double)(from.y)));
        CHECK(measured(ball, from, 2000, true).agrees_with(truth, 1e-3));
        CHECK(measured(ball, from, 2000).agrees_with(truth, 2e-2));
    }
    // On the surface itself the answer is a number or nothing, never a wrong light.
    Numbers n;
    for (int i = 0; i < 1000; ++i)
        CHECK(sample_towards(ball, Vec3{0, 1, 0}, n.square<float>()).pdf >= 0);
}

TEST_CASE_TEMPLATE("solid angle: on the wall of a spherical room all of it is seen", T,
                   float, double) {
    // The hit point is rounded to one side or the other.
    Numbers n;
    for (const double offset : {0.0, 10.0, 1000.0}) {
        const SphereT<T> room{Vec3T<T>(offset * n.point(1)), T(2)};
        Mean light;
        for (int i = 0; i < 40000; ++i) {
            const auto from = sample_area(room, n.square<T>());
            const auto seen = sample_towards(room, from.position, n.square<T>());
            const Vec3T<T> way = seen.point.position - from.position;
            // Both normals point inwards; L = 1 gives the irradiance pi.
            const double cosine = -double(glm::dot(glm::normalize(way), from.normal));
            if (glm::dot(way, seen.point.normal) > 0 && cosine > 0)
                light.add(cosine / double(seen.pdf));
            else
                light.add(0);
        }
        CAPTURE(offset);
        CHECK(light.agrees_with(pi, 1e-3));
    }
}

TEST_CASE_TEMPLATE(
    "solid angle: a point of a sphere faces the observer, on the surface", T, float,
    double) {
    Numbers n;
    for (const double ratio : {1.001, 1.01, 1.5, 10.0, 1e3, 1e5})
        for (const double offset : {0.0, 1.0, 100.0}) {
            int averted = 0, off = 0;
            for (int i = 0; i < 4000; ++i) {
                const auto center = offset * n.point(1);
                const auto from = Vec3T<T>(center + ratio * n.direction());
                const SphereT<T> ball{Vec3T<T>(center), T(1)};
                const auto seen = sample_towards(ball, from, n.square<T>());
                const Vec3T<T> way = seen.point.position - from;
                averted += !(glm::dot(way, seen.point.normal) < 0);
                const double distance = glm::distance(glm::dvec3(seen.point.position),
                                                      glm::dvec3(ball.center));
                off += std::abs(distance - 1) > 1e-6 * (1 + offset);
            }
            CAPTURE(ratio);
            CAPTURE(offset);
            CHECK(averted <= 1); // exactly at the rim
            CHECK(off == 0);
        }
}

TEST_CASE("solid angle: directions fill the cone of a sphere evenly") {
    for (const double distance : {1.02, 1.5, 10.0, 300.0}) {
        const Sphere ball{{0, 0, 0}, 1};
        const glm::dvec3 axis = glm::normalize(glm::dvec3{1, -2, 2});
        const glm::dvec3 x = glm::normalize(glm::dvec3{2, 1, 0});
        const glm::dvec3 y = glm::cross(axis, x);
        const Vec3 from(-distance * axis);
        const double range = double(cone_of(1, distance)) / (2 * pi);
        Numbers n;
        std::array<int, 100> cells{};
        for (int i = 0; i < 100000; ++i) {
            const SeenPointT<float> seen =
                sample_towards(ball, from, n.square<float>());
            const auto wi =
                glm::normalize(glm::dvec3(seen.point.position) - glm::dvec3(from));
            const double px = glm::dot(wi, x), py = glm::dot(wi, y);
            const double sine2 = px * px + py * py;
            const double down = sine2 / (1 + std::sqrt(1 - sine2)); // 1 - cos
            const int row = std::clamp(int(down / range * 10), 0, 9);
            const int column =
                std::clamp(int((std::atan2(py, px) / (2 * pi) + 0.5) * 10), 0, 9);
            ++cells[static_cast<std::size_t>(row * 10 + column)];
        }
        CAPTURE(distance);
        CHECK(ljus_test::chi_square(cells) < ljus_test::chi_square_limit(99));
    }
}

TEST_CASE("solid angle: triangles and quads, at any size and from both sides") {
    Numbers n;
    for (int k = 0; k < 12; ++k) {
        const double size = std::pow(10.0, k % 5 * 3 - 6);
        const auto vec = [&](double s) { return Vec3(size * s * n.point(1)); };
        const Vec3 from = vec(1), corner = vec(1) + Vec3(size * 2.0 * n.direction());
        const Quad quad{corner, vec(2), vec(2)};
        const Triangle triangle{corner, corner + quad.edge_u, corner + quad.edge_v};
        const glm::dvec3 o(from), v1(corner), e1(quad.edge_u), e2(quad.edge_v);
        const double half = solid_angle(v1 - o, v1 + e1 - o, v1 + e2 - o);
        const double other = solid_angle(v1 + e1 + e2 - o, v1 + e1 - o, v1 + e2 - o);
        // One-sided as emission is, a flat shape is seen from one side only.
        const bool seen = glm::dot(o - v1, glm::cross(e1, e2)) > 0;
        CAPTURE(size);
        CHECK(measured(triangle, from, 40000, true).agrees_with(half, 1e-4));
        CHECK(measured(quad, from, 40000, true).agrees_with(half + other, 1e-4));
        CHECK((measured(quad, from, 100).mean > 0) == seen);
    }
}

TEST_CASE("solid angle: small and far, every point of a lamp has the lamp's density") {
    // A lamp of area A at distance d, leaning by 60 degrees: A cos / d^2.
    for (const float distance : {1e2f, 1e4f, 1e6f}) {
        const Vec3 up{0, 0.5f, std::sqrt(0.75f)};
        const Vec3 side{1, 0, 0}, across = glm::cross(up, side);
        const Quad lamp{{0, distance, 0}, side, across};
        Numbers n;
        for (int i = 0; i < 100; ++i) {
            const auto seen = sample_towards(lamp, Vec3{0}, n.square<float>());
            CHECK(double(seen.pdf) ==
                  doctest::Approx(double(distance) * distance * 2).epsilon(0.04));
        }
    }
}

TEST_CASE_TEMPLATE("solid angle: pdf_towards is the density of sample_towards", T,
                   float, double) {
    Numbers n;
    for (int i = 0; i < 3000; ++i) {
        const Vec3T<T> from(n.point(3));
        const SphereT<T> ball{Vec3T<T>(n.point(3)), T(n.between(0.1, 3))};
        const QuadT<T> quad{Vec3T<T>(n.point(3)), Vec3T<T>(n.point(3)),
                            Vec3T<T>(n.point(3))};
        const TriangleT<T> triangle{quad.corner, quad.edge_u, quad.edge_v};
        const auto same = [&](const auto& shape) {
            const auto seen = sample_towards(shape, from, n.square<T>());
            return pdf_towards(shape, from, seen.point) == seen.pdf;
        };
        REQUIRE(same(ball));
        REQUIRE(same(quad));
        REQUIRE(same(triangle));
    }
}

TEST_CASE("solid angle: a surface seen edge-on gives no light, not a wrong one") {
    const Quad lamp{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const auto seen = sample_towards(lamp, Vec3{3, 0.25f, 0}, Vec2{0.5f, 0.5f});
    CHECK_FALSE(std::isfinite(seen.pdf));
    const auto on_it = sample_towards(lamp, Vec3{0.5f, 0.5f, 0}, Vec2{0.5f, 0.5f});
    CHECK(on_it.pdf == 0); // at the sampled point itself
}

TEST_CASE("solid angle: what stands for a lamp is its middle, or its nearest point") {
    const QuadT<double> quad{{-1, 4, -2}, {2, 0, 0}, {0, 0, 6}};
    const Vec3T<double> eye{3, 1, 2};
    CHECK(sample_towards(quad, eye, center_sample(quad)).point.position ==
          Vec3T<double>{0, 4, 1});
    const SphereT<double> ball{{3, 1, -4}, 2};
    CHECK(glm::distance(sample_towards(ball, eye, center_sample(ball)).point.position,
                        Vec3T<double>{3, 1, -2}) < 1e-12);
}

TEST_CASE("solid angle: on a far sphere, whichever way it lies, nobody is outside") {
    for (const float far : {-1000.0f, 1000.0f}) {
        const Sphere ball{Vec3{far}, 1};
        for (const Vec3& way : {Vec3{1, 0, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}}) {
            // A point of it, and one farther out than the rounding reaches.
            CHECK_FALSE(detail::sees_cone(ball, ball.center + 1.0002f * way));
            CHECK(detail::sees_cone(ball, ball.center + 1.01f * way));
        }
    }
}

TEST_CASE("solid angle: a sampled point is where the observer's ray meets the ball") {
    Numbers n;
    for (int i = 0; i < 5000; ++i) {
        const SphereT<double> ball{n.point(5), n.power(-1, 1)};
        const auto from = ball.center + ball.radius * n.between(1.1, 9) * n.direction();
        auto u = n.square<double>();
        if (i % 10 == 0) u.x = u.y = 1 - 0x1p-53; // the rim
        const auto seen = sample_towards(ball, from, u);
        REQUIRE(is_finite(seen.point.position));
        const auto way = glm::normalize(seen.point.position - from);
        REQUIRE(glm::dot(way, seen.point.normal) < 1e-6);
        const auto t = intersect(RayT<double>{.origin = from, .direction = way}, ball);
        if (i % 10 == 0) continue; // beside the rim there may be no hit
        REQUIRE(t);
        REQUIRE(std::abs(*t - glm::distance(seen.point.position, from)) <
                1e-6 * ball.radius);
    }
}

TEST_CASE_TEMPLATE("solid angle: an observer at the very point that is chosen", T,
                   float, double) {
    Draws draws{43};
    int wrong = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto v = draws.cube<T>();
        const T size = T(std::pow(10.0, draws.between(-3.0, 3.0)));
        const SphereT<T> ball{.center = T(10) * v, .radius = size};
        const ljus::TriangleT<T> triangle{size * v, size * draws.cube<T>(),
                                          size * draws.cube<T>()};
        const auto u = draws.square<T>();
        const auto none = [&](const auto& lamp) {
            const auto point = sample_area(lamp, u);
            const auto seen = sample_towards(lamp, point.position, u);
            // Not NaN, and no light either where the way is 0.
            return seen.pdf >= 0 && pdf_towards(lamp, point.position, point) == 0;
        };
        wrong += !none(ball) || !none(triangle);
    }
    CHECK(wrong == 0);
}

namespace {

/// The form factor of a point to the triangle v1 + a e1 + b e2, by the midpoint rule of
/// 90 000 small ones; only what faces the point counts, and lies above it.
double by_rule(const glm::dvec3& from, const glm::dvec3& normal, const glm::dvec3& v1,
               const glm::dvec3& e1, const glm::dvec3& e2, double sign) {
    constexpr int n = 300;
    const glm::dvec3 area = sign * glm::cross(e1, e2);
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; i + j < n; ++j)
            for (const double third : {1.0, 2.0}) {
                if (third == 2 && i + j + 1 >= n) continue;
                const glm::dvec3 way =
                    v1 + (i + third / 3) / n * e1 + (j + third / 3) / n * e2 - from;
                const double here = glm::dot(way, normal), there = -glm::dot(way, area);
                const double d2 = glm::dot(way, way);
                if (here > 0 && there > 0) sum += here * there / (d2 * d2);
            }
    return sum / (2.0 * n * n) / pi;
}

} // namespace

TEST_CASE("solid angle: form factors of lamps, cut by the horizon or not") {
    Numbers n{3};
    int some = 0;
    for (int i = 0; i < 60; ++i) {
        const glm::dvec3 from = n.point(1), normal = n.direction();
        const glm::dvec3 v1 = from + 3.0 * n.direction();
        const glm::dvec3 e1 = n.point(1.5), e2 = n.point(1.5);
        // Not through the point's own place, where the rule has no end.
        if (std::abs(glm::dot(v1 - from, glm::normalize(glm::cross(e1, e2)))) < 0.5)
            continue;
        const QuadT<double> quad{v1, e1, e2};
        const TriangleT<double> triangle{v1, v1 + e1, v1 + e2};
        for (const bool inside_out : {false, true}) {
            const double sign = inside_out ? -1 : 1;
            const double half = by_rule(from, normal, v1, e1, e2, sign);
            const double rest = by_rule(from, normal, v1 + e1 + e2, -e1, -e2, sign);
            CHECK(std::abs(*form_factor_from(from, normal, triangle, inside_out) -
                           half) < 1e-4);
            CHECK(std::abs(*form_factor_from(from, normal, quad, inside_out) - half -
                           rest) < 1e-4);
            some += half > 1e-3;
        }
    }
    CHECK(some > 10);
    // A sphere: (r/d)^2 cos, if all of it stands above the horizon.
    for (int i = 0; i < 200; ++i) {
        const glm::dvec3 from = n.point(9), normal = n.direction();
        const SphereT<double> ball{from + n.between(0.5, 9) * n.direction(),
                                   n.between(0.1, 2)};
        const double d = glm::distance(from, ball.center);
        const double height = glm::dot(ball.center - from, normal);
        const auto found = form_factor_from(from, normal, ball, false);
        CHECK_FALSE(form_factor_from(from, normal, ball, true));
        CHECK(bool(found) == (d > ball.radius && std::abs(height) >= ball.radius));
        if (found && height > 0)
            CHECK(*found ==
                  ljus_test::within(std::pow(ball.radius / d, 2) * height / d, 1e-12));
        if (found && height < 0) CHECK(*found == 0);
    }
}

namespace reader {

/// A ball that does not know its area: it can be lit, but is no lamp.
struct Blind {
    Sphere ball{};
};
inline std::optional<float> intersect(const Ray& ray, const Blind& s) {
    return ljus::intersect(ray, s.ball);
}
inline SurfacePoint surface_point(const Blind& s, const Ray& ray,
                                  const ShapeHitT<float>& hit) {
    return ljus::surface_point(s.ball, ray, hit);
}
inline Sphere bounding_sphere(const Blind& s) {
    return s.ball;
}
inline void check(const Blind&) {}

} // namespace reader

TEST_CASE("solid angle: of a shape without an area no point is chosen") {
    const reader::Blind blind;
    static_assert(Shape<reader::Blind> && !HasArea<reader::Blind>);
    const auto seen = sample_towards(blind, Vec3{0, 0, 5}, Vec2{0.5f});
    CHECK(seen.pdf == 0);
    CHECK(pdf_towards(blind, Vec3{0, 0, 5}, seen.point) == 0);
    CHECK(center_sample(blind) == Vec2{0.5f});
    CHECK(center_sample(Quad{}) == Vec2{0.5f});
    CHECK(center_sample(Triangle{}) == Vec2{0.5f});
    CHECK(center_sample(Sphere{}) == Vec2{0});
    CHECK(SeenPointT<float>{}.pdf == 0);
    CHECK(detail::ConeT<float>{}.one_minus_cos == 2);
}

TEST_CASE("solid angle: a density by area is d^2 over cosine and area, and no less") {
    // A point 3 above, 4 aside: d = 5, cos = 3/5; of area 2 that is 25 * 5/3 / 2.
    const SurfacePointT<double> point{.position{4, 0, 0}, .normal{0, 0, 1}};
    const Vec3T<double> from{0, 0, 3};
    const double right = 25.0 * 5 / 3 / 2;
    CHECK(detail::pdf_from_area(from, point, 2.0) == doctest::Approx(right));
    auto turned = point;
    turned.normal = -turned.normal;
    CHECK(detail::pdf_from_area(from, turned, 2.0) == doctest::Approx(right));
    CHECK(detail::pdf_from_area(point.position, point, 2.0) == 0);
    CHECK(std::isinf(detail::pdf_from_area(Vec3T<double>{0}, point, 2.0)));
}
