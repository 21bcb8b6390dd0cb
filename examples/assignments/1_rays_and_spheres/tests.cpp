// Assignment 1: each test is a sentence that must hold. Its name states its points.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <algorithm>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;
using ljus::next_1d;

namespace {

ljus::Vec3T<double> wide(const Vec3& v) {
    return ljus::Vec3T<double>(v);
}

Vec3 random_point(ljus::RandomStream& stream, float size) {
    const float x = next_1d(stream), y = next_1d(stream);
    return size * (2.0f * Vec3{x, y, next_1d(stream)} - 1.0f);
}

/// The squared distance from the centre of a ball to the line of a ray, in double.
double off_line(const Ray& ray, const Ball& ball) {
    const auto d = normalize(wide(ray.direction));
    const auto across = cross(wide(ball.center) - wide(ray.origin), d);
    return dot(across, across);
}

} // namespace

TEST_CASE("1.1 (1 point) the ray through the middle goes straight ahead") {
    INFO("Expected: origin at the eye, direction (0, 0, -1). The pixel is a point "
         "and needs no half added; x and y are relative to the eye.\n"
         "Read: Primary rays.");
    const Eye eye{.position{1, 2, 3}};
    const Ray ray = primary_ray(eye, {200, 150}, 400, 300);
    CHECK(ray.origin == eye.position);
    CHECK(distance(ray.direction, Vec3{0, 0, -1}) < 1e-6f);
}

TEST_CASE("1.2 (2 points) the edges of the picture are where the angle says") {
    INFO("Expected: tan(vfov / 2) at the upper edge, and the same scale for x and "
         "y.\n"
         "Likely: degrees, the whole angle, a scale for each axis, y upside down, "
         "or no normalize().\n"
         "Read: Primary rays; the chapter First picture.");
    const Eye eye{.vfov_degrees = 90};
    const Ray top = primary_ray(eye, {300, 0}, 600, 300);
    CHECK(distance(top.direction, normalize(Vec3{0, 1, -1})) < 1e-5f);
    const Ray right = primary_ray(eye, {600, 150}, 600, 300);
    CHECK(distance(right.direction, normalize(Vec3{2, 0, -1})) < 1e-5f);
    const Ray corner = primary_ray(eye, {0, 300}, 600, 300);
    CHECK(distance(corner.direction, normalize(Vec3{-2, -1, -1})) < 1e-5f);
}

TEST_CASE("1.3 (2 points) a ray meets a ball where it enters or where it leaves") {
    INFO("Expected: the smaller root, or the larger one if the smaller one lies "
         "before t_min: a ray that starts inside of a ball leaves it.\n"
         "Read: Ray and ball; the chapter Sphere.");
    const Ball ball{.center{0, 0, -5}};
    const auto before = intersect(Ray{}, ball);
    REQUIRE(before);
    CHECK(*before == doctest::Approx(4));
    const auto within = intersect(Ray{.origin{0, 0, -5}}, ball);
    REQUIRE(within);
    CHECK(*within == doctest::Approx(1));
    CHECK_FALSE(intersect(Ray{.origin{0, 0, -7}}, ball));    // behind
    CHECK_FALSE(intersect(Ray{.origin{0, 1.01f, 0}}, ball)); // beside
}

TEST_CASE("1.4 (1 point) only hits between t_min and t_max count") {
    INFO("Expected: each root is compared with t_min and with t_max.\n"
         "Read: Ray and ball.");
    const Ball ball{.center{0, 0, -5}};
    const auto leaves = intersect(Ray{.t_min = 4.5f}, ball);
    REQUIRE(leaves);
    CHECK(*leaves == doctest::Approx(6));
    CHECK_FALSE(intersect(Ray{.t_min = 6.5f}, ball));
    CHECK_FALSE(intersect(Ray{.t_max = 3.5f}, ball));
}

TEST_CASE("1.5 (2 points) t counts in lengths of the direction") {
    INFO("Expected: t such that origin + t direction is the point.\n"
         "Likely: D.D taken for 1, in one of its three places.\n"
         "Read: Ray and ball.");
    const Ball ball{.center{0, 0, -5}};
    const auto t = intersect(Ray{.direction{0, 0, -2}}, ball);
    REQUIRE(t);
    CHECK(*t == doctest::Approx(2));
    const auto aslant =
        intersect(Ray{.origin{0, 0.6f, 0}, .direction{0, 0, -0.1f}}, ball);
    REQUIRE(aslant);
    CHECK(*aslant == doctest::Approx(42));
}

TEST_CASE("1.6 (3 points) random rays hit what they should and end on the ball") {
    INFO("Expected: the same decision as in double, and a point on the ball.\n"
         "Likely: D.D, a sign, or the centre missing in m.\n"
         "Read: Ray and ball; the chapter Sphere.");
    auto stream = course::stream(1);
    int hits = 0;
    for (int i = 0; i < 5000; ++i) {
        const Ball ball{.center = random_point(stream, 5),
                        .radius = 0.2f + 3 * next_1d(stream)};
        const Vec3 from = random_point(stream, 9);
        const Ray ray{.origin = from,
                      .direction = 0.3f * (random_point(stream, 5) - from)};
        const double r2 = double(ball.radius) * double(ball.radius);
        const double off = off_line(ray, ball) / r2;
        const auto out = wide(ray.origin) - wide(ball.center);
        const bool outside = dot(out, out) > r2;
        const bool ahead = dot(out, wide(ray.direction)) < 0;
        if (std::abs(off - 1) < 1e-4) continue; // grazing: rounding decides
        const auto t = intersect(ray, ball);
        REQUIRE(t.has_value() == (off < 1 && (!outside || ahead)));
        if (!t) continue;
        ++hits;
        const auto point = wide(ray.origin) + double(*t) * wide(ray.direction);
        REQUIRE(std::abs(distance(point, wide(ball.center)) - double(ball.radius)) <
                1e-3);
        if (outside) REQUIRE(dot(point - wide(ball.center), wide(ray.direction)) < 0);
    }
    CHECK(hits > 500);
}

TEST_CASE("1.7 (3 points) a ball 1000 radii away keeps its outline") {
    INFO("Expected: at most 20 wrong decisions. b^2 - c subtracts two large "
         "floats: measure the distance from the nearest point P.\n"
         "Read: Ray and ball; the chapter Sphere.");
    auto stream = course::stream(2);
    int wrong = 0, hits = 0;
    for (int i = 0; i < 4000; ++i) {
        const Ball ball{.radius = 1};
        const Vec3 aim = 0.9f * random_point(stream, 1);
        const Vec3 from = 1000.0f * normalize(random_point(stream, 1));
        const Ray ray{.origin = from, .direction = normalize(aim - from)};
        const bool hit = intersect(ray, ball).has_value();
        hits += hit;
        wrong += hit != (off_line(ray, ball) < 1);
    }
    CHECK(hits > 1000);
    CHECK(wrong <= 20); // 0.5 %; b^2 - c in float gives several times as many
}

TEST_CASE("1.8 (1 point) the normal has length 1 and points away from the centre") {
    INFO("Expected: (point - centre) of length 1.\n"
         "Likely: not divided by the radius, or the wrong way around.\n"
         "Read: the chapter Sphere.");
    const Ball ball{.center{1, 2, 3}, .radius = 4};
    CHECK(distance(normal(ball, {1, 6, 3}), Vec3{0, 1, 0}) < 1e-6f);
    CHECK(distance(normal(ball, {-3, 2, 3}), Vec3{-1, 0, 0}) < 1e-6f);
}

TEST_CASE("1.9 (2 points) the nearest ball is found whatever the order of the list") {
    INFO("Expected: t = 4 and the index of that ball.\n"
         "Likely: the last hit is kept, or the index of another ball.\n"
         "Read: the chapter First picture.");
    std::vector<Ball> balls{{{0, 0, -9}, 1},
                            {{0, 0, -5}, 1},
                            {{0, 0, 5}, 1},
                            {{0, 3, -4}, 1},
                            {{0, 0, -7}, 1}};
    for (int turn = 0; turn < 5; ++turn) {
        const auto hit = nearest(Ray{}, balls);
        REQUIRE(hit);
        CHECK(hit->t == doctest::Approx(4));
        REQUIRE(hit->ball < balls.size());
        CHECK(balls[hit->ball].center.z == -5);
        std::rotate(balls.begin(), balls.begin() + 1, balls.end());
    }
    CHECK_FALSE(nearest(Ray{.direction{1, 0, 0}}, balls));
}

TEST_CASE("1.10 (2 points) a lamp is seen unless a ball is between or the horizon") {
    INFO("Expected: seen on the side of the normal if nothing lies before the lamp.\n"
         "Likely: t_max in another unit than the direction (with direction = lamp "
         "- origin the lamp is at t = 1), or no test of the side.\n"
         "Read: Shadows.");
    const std::vector<Ball> balls{{{0, 0, 0}, 1}, {{0, 4, 0}, 1}};
    CHECK(sees(balls, {0, 1, 0}, {0, 1, 0}, {0, 2.5f, 0}));    // before the second ball
    CHECK_FALSE(sees(balls, {0, 1, 0}, {0, 1, 0}, {0, 9, 0})); // behind it
    CHECK_FALSE(sees(balls, {0, 1, 0}, {0, 1, 0}, {5, 0.5f, 0})); // below the horizon
    CHECK(sees(balls, {1, 0, 0}, {1, 0, 0}, {5, 0, 0}));
    // A plane, without a ball that hides lamps below the horizon.
    CHECK_FALSE(sees({}, {0, 0, 0}, {0, 1, 0}, {3, -1, 0}));
    CHECK(sees({}, {0, 0, 0}, {0, 1, 0}, {3, 1, 0}));
}

TEST_CASE("1.11 (3 points) no ball shades itself whatever the unit of length") {
    INFO("Expected: no ball shades itself. Step along the normal, in proportion to "
         "the coordinates: a step along the way to the lamp hardly leaves the "
         "surface if the lamp is low.\n"
         "Read: Shadows; the chapter Ray.");
    for (const float scale : {0.001f, 1.0f, 1000.0f}) {
        auto stream = course::stream(3);
        int wrong = 0;
        for (int i = 0; i < 2000; ++i) {
            const Ball ball{.center = scale * Vec3{3, 1, -6}, .radius = scale};
            const Vec3 n = normalize(random_point(stream, 1));
            const Vec3 way = normalize(random_point(stream, 1));
            if (std::abs(dot(n, way)) < 0.05f) continue;
            const Vec3 point = ball.center + ball.radius * n;
            wrong +=
                sees({ball}, point, n, point + 5.0f * scale * way) != (dot(n, way) > 0);
        }
        CAPTURE(scale);
        CHECK(wrong == 0);
        int hidden = 0; // of lamps barely above the horizon
        for (int i = 0; i < 500; ++i) {
            const Ball ball{.center = scale * Vec3{3, 1, -6}, .radius = scale};
            const Vec3 n = normalize(random_point(stream, 1));
            const Vec3 along = normalize(cross(n, random_point(stream, 1)));
            const Vec3 point = ball.center + ball.radius * n;
            const Vec3 lamp = point + scale * (5.0f * along + 0.001f * n);
            hidden += !sees({ball}, point, n, lamp);
        }
        CHECK(hidden == 0);
        // Two balls are a fiftieth of a radius apart. From the top of one, a lamp
        // behind the other is hidden, and a lamp between the two is visible.
        const Ball below{.center = scale * Vec3{3, 1, -6}, .radius = scale};
        const Ball above{.center = scale * Vec3{3, 3.02f, -6}, .radius = scale};
        const Vec3 top = scale * Vec3{3, 2, -6}, up{0, 1, 0};
        INFO("the step away from the surface must be far smaller than the gap");
        CHECK_FALSE(sees({below, above}, top, up, scale * Vec3{3, 9, -6}));
        CHECK(sees({below, above}, top, up, scale * Vec3{3, 2.01f, -6}));
    }
}

} // namespace course_tests
