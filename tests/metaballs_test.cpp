/// \file metaballs_test.cpp
/// \brief Metaballs: their field, their bounds, four ways to meet them, and pictures.

#include "ljus/geometry/metaballs.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/photon_mapping.hpp"
#include "ljus/render/render.hpp"
#include "support/numbers.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::Numbers;

static_assert(Shape<Metaballs> && Shape<MetaballsT<double>>);
static_assert(!Samplable<Metaballs> && Samplable<Sphere> && Samplable<Quad>);

namespace {

using Point = Vec3T<double>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// Two blobs that merge, and one that carves.
template <typename T = float>
MetaballsT<T> peanut() {
    return {.blobs{{{T(-0.5), T(0), T(-4)}, T(1), T(1)},
                   {{T(0.5), T(0.1), T(-4)}, T(1), T(1)},
                   {{T(0), T(0.5), T(-3.6)}, T(0.5), T(-0.5)}}};
}

/// The surface of one blob is a sphere: this is its radius.
double sphere_radius(double radius, double weight, double level) {
    return radius * std::sqrt(1 - std::sqrt(level / weight));
}

/// A field that is no polynomial: Blinn's blobs, exponentials.
struct Blinn {
    double value(Point x) const {
        return std::exp(-2 * glm::dot(x - a, x - a)) +
               std::exp(-2 * glm::dot(x + a, x + a)) - 0.5;
    }
    Point gradient(Point x) const {
        return -4.0 * (std::exp(-2 * glm::dot(x - a, x - a)) * (x - a) +
                       std::exp(-2 * glm::dot(x + a, x + a)) * (x + a));
    }
    // Each is steepest at 1/2 from its centre: 2 exp(-1/2).
    double lipschitz() const { return 4 * std::exp(-0.5); }
    Point a{0.6, 0, 0};
};
static_assert(Shape<Isosurface<Blinn>>);

template <typename F>
void with_all_solvers(F f) {
    f(QuarticPieces{});
    f(Bisection{});
    f(SphereTracing{});
    f(Radicals{});
}

} // namespace

TEST_CASE("metaballs: the field of one blob by hand, of more by their sum") {
    const Metaballs one{.blobs{{.center{1, 0, 0}, .radius = 2, .weight = 3}}};
    CHECK(field(one, Point{1, 0, 0}) == 2.75);
    CHECK(field(one, Point{1, 1, 0}) == doctest::Approx(3 * 0.5625 - 0.25));
    CHECK(field(one, Point{1, 2, 0}) == -0.25);
    CHECK(field(one, Point{9, 9, 9}) == -0.25);
    const Metaballs all = peanut();
    Numbers n;
    for (int i = 0; i < 200; ++i) {
        const Point x = Point{0, 0, -4} + n.point(1.5);
        double sum = -0.25;
        for (const Blob& b : all.blobs) sum += field(Metaballs{.blobs{b}}, x) + 0.25;
        CHECK(field(all, x) == doctest::Approx(sum).epsilon(1e-12));
    }
}

TEST_CASE("metaballs: the gradient agrees with differences, and keeps its bound") {
    const Metaballs balls = peanut();
    const double bound = lipschitz(balls);
    CHECK(bound == doctest::Approx(8 / (3 * std::sqrt(3.0)) * (1 + 1 + 1)));
    Numbers n;
    double steepest = 0;
    for (int i = 0; i < 20000; ++i) {
        const Point x = Point{0, 0, -4} + n.point(1.5);
        const Point g = gradient(balls, x);
        steepest = std::max(steepest, glm::length(g));
        CHECK(glm::length(g) <= bound);
        if (i >= 500) continue;
        const double h = 1e-5;
        for (int k = 0; k < 3; ++k) {
            Point step{0};
            step[k] = h;
            const double difference =
                (field(balls, x + step) - field(balls, x - step)) / (2 * h);
            CHECK(std::abs(g[k] - difference) < 1e-8);
        }
    }
    CHECK(steepest > 0.4 * bound); // it says something
    const Metaballs one{.blobs{{.radius = 2}}};
    const Point steep = gradient(one, Point{2 / std::sqrt(3.0), 0, 0});
    CHECK(glm::length(steep) == doctest::Approx(lipschitz(one)).epsilon(1e-7));
}

TEST_CASE("metaballs: one blob is a sphere, for each solver") {
    Numbers n;
    with_all_solvers([&](auto solver) {
        for (int i = 0; i < 300; ++i) {
            const MetaballsT<double> ball{
                .blobs{{n.point(2), n.between(0.5, 2), n.between(0.5, 2)}},
                .level = 0.25};
            const auto& blob = ball.blobs.front();
            const SphereT<double> sphere{
                blob.center, sphere_radius(blob.radius, blob.weight, ball.level)};
            const RayT<double> ray{.origin = n.direction() * 5.0,
                                   .direction = n.point(1)};
            const auto mine = intersect(ray, ball, solver),
                       truth = intersect(ray, sphere);
            REQUIRE(mine.has_value() == truth.has_value());
            if (truth) CHECK(std::abs(*mine - *truth) < 1e-4 * *truth);
            if (truth && !std::is_same_v<decltype(solver), SphereTracing>)
                CHECK(std::abs(*mine - *truth) < 1e-6 * *truth);
        }
    });
}

TEST_CASE("metaballs: the first hit, from outside and from within, in the range") {
    // Two spheres of radius sqrt(1/2), apart: no field where they could add.
    const Metaballs near_first{.blobs{{.center{0, 0, -3}}, {.center{0, 0, -6}}}},
        far_first{.blobs{{.center{0, 0, -6}}, {.center{0, 0, -3}}}};
    const float r = float(std::sqrt(0.5));
    const auto check_all = [&](const Metaballs& two, auto solver) {
        const auto t = [&](float z, float direction, float low, float high) {
            const auto hit = intersect(Ray{.origin{0, 0, z},
                                           .direction{0, 0, direction},
                                           .t_min = low,
                                           .t_max = high},
                                       two, solver);
            return hit ? *hit : -1.0f;
        };
        const float all = std::numeric_limits<float>::infinity();
        CHECK(t(0, -1, 0, all) == doctest::Approx(3 - r).epsilon(1e-6));
        CHECK(t(0, -2, 0, all) == doctest::Approx((3 - r) / 2).epsilon(1e-6));
        CHECK(t(-3, -1, 0, all) == doctest::Approx(r).epsilon(1e-6)); // leaves
        CHECK(t(-4.5f, -1, 0, all) == doctest::Approx(1.5f - r).epsilon(1e-6));
        CHECK(t(0, -1, 3, all) ==
              doctest::Approx(3 + r).epsilon(1e-6)); // starts within
        CHECK(t(0, -1, 4, all) == doctest::Approx(6 - r).epsilon(1e-6));
        CHECK(t(0, -1, 0, 2.25f) == -1);
        CHECK(t(0, -1, 4, 5) == -1);
        CHECK(t(0, -1, 8, all) == -1);
        CHECK(t(0, 1, 0, all) == -1);
    };
    with_all_solvers([&](auto solver) {
        check_all(near_first, solver);
        check_all(far_first, solver);
    });
}

TEST_CASE("metaballs: invalid data are a miss, never a hang") {
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float inf = std::numeric_limits<float>::infinity();
    with_all_solvers([&](auto solver) {
        for (const float bad : {nan, inf, -inf})
            for (int k = 0; k < 3; ++k) {
                Ray ray{};
                ray.origin[k] = bad;
                CHECK_FALSE(intersect(ray, peanut(), solver));
                ray = Ray{};
                ray.direction[k] = bad;
                CHECK_FALSE(intersect(ray, peanut(), solver));
                Metaballs balls{.blobs{{.center{0, 0, -4}}}};
                balls.blobs[0].center[k] = bad;
                CHECK_FALSE(intersect(Ray{}, balls, solver));
            }
        CHECK_FALSE(intersect(Ray{.direction{0, 0, 0}}, peanut(), solver));
        CHECK_FALSE(intersect(Ray{.t_min = nan}, peanut(), solver));
        CHECK_FALSE(intersect(Ray{.t_max = nan}, peanut(), solver));
        CHECK_FALSE(intersect(Ray{}, Metaballs{}, solver));
        for (const float radius : {0.0f, -1.0f, nan, inf})
            CHECK_FALSE(
                intersect(Ray{}, Metaballs{.blobs{{.radius = radius}}}, solver));
        for (const float weight : {nan, inf, 0.0f, -1.0f})
            CHECK_FALSE(intersect(
                Ray{}, Metaballs{.blobs{{.center{0, 0, -4}, .weight = weight}}},
                solver));
        // Anything at all: it returns.
        Numbers n;
        const auto any = [&] {
            return static_cast<float>(n.below(4) ? n.sign() * n.power(-44, 38)
                                                 : n.sign());
        };
        for (int i = 0; i < 3000; ++i) {
            Metaballs balls{.level = std::abs(any())};
            for (int k = n.below(4); k >= 0; --k)
                balls.blobs.push_back({{any(), any(), any()}, std::abs(any()), any()});
            const Ray ray{.origin{any(), any(), any()},
                          .direction{any(), any(), any()}};
            const auto t = intersect(ray, balls, solver);
            if (t) CHECK((*t >= 0 && std::isfinite(*t)));
        }
    });
}

TEST_CASE("metaballs: a blob without weight, or a level of its own, changes nothing") {
    Metaballs balls = peanut(), more = peanut();
    more.blobs.push_back({.center{0.2f, 0, -4}, .weight = 0});
    Numbers n;
    for (int i = 0; i < 500; ++i) {
        const Ray ray{.direction = Vec3(Point{0, 0, -4} + n.point(1))};
        const auto a = intersect(ray, balls), b = intersect(ray, more);
        REQUIRE(a.has_value() == b.has_value());
        if (a) CHECK(*a == doctest::Approx(double(*b)).epsilon(1e-6));
    }
    CHECK(bounding_sphere(more).radius == bounding_sphere(balls).radius);
    CHECK(bounding_sphere(more).center == bounding_sphere(balls).center);
}

TEST_CASE("metaballs: more than 16 blobs on a ray go to the heap and stay the same") {
    Numbers n;
    Metaballs few{.blobs{{.center{0, 0, -4}, .weight = 1}}}, many{.blobs{}};
    for (int i = 0; i < 100; ++i)
        many.blobs.push_back({.center{0, 0, -4}, .weight = 0.01f});
    for (int i = 0; i < 300; ++i) {
        const Ray ray{.direction = Vec3(Point{0, 0, -4} + n.point(0.6))};
        const auto a = intersect(ray, few), b = intersect(ray, many);
        REQUIRE(a.has_value() == b.has_value());
        if (a) CHECK(*a == doctest::Approx(double(*b)).epsilon(1e-5));
    }
    // So do different ones, in any order.
    Metaballs one_way{};
    for (int i = 0; i < 40; ++i)
        one_way.blobs.push_back({.center = Vec3(Point{0, 0, -4} + n.point(0.3)),
                                 .weight = float(n.between(-0.05, 0.1))});
    const Metaballs other_way{.blobs{one_way.blobs.rbegin(), one_way.blobs.rend()}};
    int hits = 0;
    for (int i = 0; i < 300; ++i) {
        const Ray ray{.direction = Vec3(Point{0, 0, -4} + n.point(0.6))};
        const auto a = intersect(ray, one_way), b = intersect(ray, other_way);
        REQUIRE(a.has_value() == b.has_value());
        if (!a) continue;
        ++hits;
        CHECK(*a == doctest::Approx(double(*b)).epsilon(1e-6));
        CHECK(std::abs(field(one_way, Point(point_at(ray, *a)))) < 1e-5);
    }
    CHECK(hits > 100);
}

TEST_CASE("metaballs: the bounding sphere holds every hit, and is tight for one blob") {
    const auto one =
        bounding_sphere(Metaballs{.blobs{{.center{1, 2, 3}, .radius = 2}}});
    CHECK(one.radius == doctest::Approx(sphere_radius(2, 1, 0.25)).epsilon(1e-6));
    CHECK(one.center == Vec3(1, 2, 3));
    Numbers n;
    for (int i = 0; i < 300; ++i) {
        Metaballs balls{};
        for (int k = n.below(5); k >= 0; --k)
            balls.blobs.push_back({Vec3(n.point(1)), float(n.between(0.3, 1)),
                                   float(n.between(0.26, 2) * (k ? n.sign() : 1))});
        const Sphere bound = bounding_sphere(balls);
        for (int k = 0; k < 30; ++k) {
            const Ray ray{.origin = Vec3(n.direction() * 6.0),
                          .direction = Vec3(n.point(3))};
            if (const auto t = intersect(ray, balls))
                CHECK(glm::distance(point_at(ray, *t), bound.center) <=
                      bound.radius * 1.0001f);
        }
    }
    CHECK(bounding_sphere(Metaballs{.blobs{{.weight = 0.1f}}}).radius ==
          0); // no surface
    // Ten weak blobs in one place, none of which reaches the level alone.
    const Metaballs weak{.blobs = std::vector(10, Blob{.weight = 0.1f})};
    CHECK(double(bounding_sphere(weak).radius) >= sphere_radius(1, 1, 0.25));
}

TEST_CASE_TEMPLATE("metaballs: a hit lies on the surface, its normal is the gradient",
                   T, float, double) {
    Numbers n;
    for (const double shift : {0.0, 100.0}) {
        MetaballsT<T> balls = peanut<T>();
        for (auto& b : balls.blobs) b.center += Vec3T<T>(T(shift));
        int hits = 0;
        for (int i = 0; i < 2000; ++i) {
            const Point to = Point{shift, shift, shift - 4} + n.point(1);
            const Point from = Point{shift} + n.point(0.5);
            const RayT<T> ray{.origin = Vec3T<T>(from),
                              .direction = Vec3T<T>(to - from)};
            const auto t = intersect(ray, balls);
            if (!t) continue;
            ++hits;
            const auto p = surface_point(balls, ray, as_hit(*t));
            const Point x(p.position), g = gradient(balls, x);
            CHECK(glm::length(Point(p.normal) + glm::normalize(g)) < 1e-4);
            // Within the error's box, along the normal, the field changes its sign.
            const double reach = glm::dot(glm::abs(Point(p.normal)), Point(p.error));
            CHECK(field(balls, x + Point(p.normal) * reach * 1.01) <= 0);
            CHECK(field(balls, x - Point(p.normal) * reach * 1.01) >= 0);
            // The point is put back onto the surface: what is left is its rounding.
            const double eps = double(std::numeric_limits<T>::epsilon());
            CHECK(reach <
                  1.01 * eps * glm::dot(glm::abs(Point(p.normal)), glm::abs(x)) + 2e-9);
            // A ray that leaves outwards is outside, one that enters is inside.
            const Vec3T<T> out = p.normal;
            CHECK(field(balls, Point(offset_ray_origin(p, out))) < 0);
            CHECK(field(balls, Point(offset_ray_origin(p, Vec3T<T>(-out)))) > 0);
            // Outwards and aside: no hit where the ray starts.
            const Vec3T<T> aside =
                glm::normalize(Vec3T<T>(glm::cross(p.normal, Vec3T<T>(n.direction()))));
            const auto again =
                intersect(spawn_ray(p, Vec3T<T>(aside + T(0.02) * out)), balls);
            if (again) CHECK(*again > T(1e-3));
        }
        CHECK(hits > 300);
    }
}

TEST_CASE("metaballs: the normal is that of the point, not of where t led to") {
    // From 1000 away t leads to 1e-4 from the surface.
    const Metaballs balls = peanut();
    Numbers n;
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Point to = Point{0, 0, -4} + n.point(1);
        const Vec3 from(to + 1000.0 * n.direction());
        const Ray ray{.origin = from, .direction = Vec3(to) - from};
        const auto t = intersect(ray, balls);
        if (!t) continue;
        ++hits;
        const auto p = surface_point(balls, ray, as_hit(*t));
        const Point right = -glm::normalize(gradient(balls, Point(p.position)));
        REQUIRE(glm::length(Point(p.normal) - right) < 1e-5);
    }
    CHECK(hits > 300);
}

TEST_CASE("metaballs: where the gradient vanishes the normal faces the ray") {
    // Two tops of 1/8 meet in the middle: f = 0 and grad f = 0 there.
    const double s = std::sqrt(0.125);
    const MetaballsT<double> balls{
        .blobs{{{std::sqrt(1 - s), 0, 0}}, {{-std::sqrt(1 - s), 0, 0}}}, .level = 0.25};
    const RayT<double> ray{.origin{0, 0, 3}};
    const auto p = surface_point(balls, ray, as_hit(3.0));
    CHECK(glm::length(p.normal) == doctest::Approx(1));
    CHECK(p.normal.z == doctest::Approx(1));
    CHECK(is_finite(p.error));
    CHECK(is_finite(p.position));
}

TEST_CASE("metaballs: refused are those without a surface, with a sentence") {
    const auto message = [](const Metaballs& balls) {
        return ljus_test::refusal([&] { check(balls); }, "accepted");
    };
    CHECK(message(peanut()) == "accepted");
    CHECK(message(Metaballs{}).find("the sum of the positive weights") == 0);
    CHECK(message({.blobs{{.weight = 0.25f}}}).find("above metaballs.level") !=
          std::string::npos);
    // What a carving blob takes away is no part of the sum, nor does it add to it.
    CHECK(message({.blobs{{}, {.weight = -0.9f}}}) == "accepted");
    CHECK(message({.blobs{{.weight = 0.2f}, {.weight = -9}}}).find("is 0.2;") !=
          std::string::npos);
    CHECK(message({.blobs{{.weight = 3e38f}, {.weight = 3e38f}}}).find("finite") !=
          std::string::npos);
    CHECK(message({.blobs{{}}, .level = 0}) ==
          "metaballs.level is 0; it must be finite and above 0.");
    CHECK(message({.blobs{{.radius = -1}}}) ==
          "metaballs.blobs.radius is -1; it must be finite and above 0.");
    CHECK(message({.blobs{{.weight = float(not_a_number)}}}) ==
          "metaballs.blobs.weight is NaN; it must be finite.");
    CHECK(message({.blobs{{.weight = float(infinity)}}}) ==
          "metaballs.blobs.weight is infinity; it must be finite.");
    CHECK(message({.blobs{{}, {.weight = -float(infinity)}}}) ==
          "metaballs.blobs.weight is -infinity; it must be finite.");
    CHECK(message({.blobs{{.center{0, float(infinity), 0}}}}).find("finite in every") !=
          std::string::npos);
}

TEST_CASE("metaballs: no light, said in one sentence; black radiance is fine") {
    Scene<Shapes<Metaballs, Quad>, Materials<Lambertian>> scene;
    const auto grey = scene.add(Lambertian{});
    CHECK_NOTHROW(scene.add(peanut(), grey));
    CHECK(ljus_test::refusal([&] {
              scene.add(peanut(), grey, Rgb{1, 2, 3});
          }) ==
          "the radiance of a shape of unknown area is (1, 2, 3); it must be black: it "
          "can be lit, but cannot be a light.");
    CHECK(scene.size() == 1);
    CHECK(scene.light_count() == 0);
}

TEST_CASE("isosurface: Blinn's blobs, which no formula solves, by both solvers") {
    const Isosurface<Blinn> surface{.bounds{.radius = 2}};
    check(surface);
    Numbers n;
    int hits = 0;
    for (int i = 0; i < 1000; ++i) {
        const Ray ray{.origin = Vec3(n.direction() * 4.0),
                      .direction = Vec3(n.point(1.2))};
        const Ray aimed{.origin = ray.origin, .direction = ray.direction - ray.origin};
        const auto a = intersect(aimed, surface),
                   b = intersect(aimed, surface, Bisection{.max_parts = 1 << 22});
        // The truth by small steps.
        double truth = -1;
        const Point o(aimed.origin), d(aimed.direction);
        for (double t = 0; t < 2 && truth < 0; t += 1e-3)
            if (surface.field.value(o + t * d) >= 0) truth = t;
        if (truth >= 0) {
            ++hits;
            REQUIRE(a);
            REQUIRE(b);
        }
        REQUIRE(a.has_value() == b.has_value());
        if (!a) continue;
        CHECK(std::abs(*a - *b) < 1e-3);
        if (truth >= 0) CHECK(std::abs(double(*b) - truth) < 1.1e-3);
        const auto p = surface_point(surface, aimed, as_hit(*b));
        CHECK(std::abs(surface.field.value(Point(p.position))) < 1e-6);
    }
    CHECK(hits > 200);
}

TEST_CASE(
    "metaballs: a start on the surface itself is inside, and the way out counts") {
    // 1 - t^2 is 3/4 at both ends, without rounding.
    const MetaballsT<double> ball{.blobs{{.center{0, 0, 0}}}, .level = 0.5625};
    const RayT<double> in{.origin{-0.5, 0, 0}, .direction{1, 0, 0}};
    REQUIRE(field(ball, Point{-0.5, 0, 0}) == 0);
    CHECK(intersect(in, ball, QuarticPieces{}).value_or(-1) == doctest::Approx(1));
    const RayT<double> out{.origin{0.5, 0, 0}, .direction{1, 0, 0}};
    CHECK(intersect(out, ball, QuarticPieces{}).value_or(0) < 1e-12);
    // In float the way out must be found, too.
    const Metaballs balls{.blobs{{}}, .level = 0.5625f};
    CHECK(intersect(Ray{.origin{0.5f, 0, 0}, .direction{1, 0, 0}}, balls).value_or(9) ==
          doctest::Approx(0).epsilon(1e-6));
    CHECK(
        intersect(Ray{.origin{0.5f, 0, 0}, .direction{-1, 0, 0}}, balls).value_or(9) ==
        doctest::Approx(1).epsilon(1e-6));
}

TEST_CASE("metaballs: on a ray, bounds of value and slope hold and close in") {
    Numbers n{21};
    const double eps = std::numeric_limits<double>::epsilon();
    for (int i = 0; i < 2000; ++i) {
        detail::StrandsT<double> strands;
        double weights = 0;
        for (int k = n.below(4); k >= 0; --k) {
            const detail::StrandT<double> b{.middle = n.between(-1, 1),
                                            .height = n.between(0.1, 1),
                                            .bend = n.between(0.5, 4),
                                            .weight = n.between(-1, 2)};
            strands.add(b);
            weights += std::abs(b.weight);
        }
        const double level = n.between(0.1, 0.5);
        const auto line = detail::line_of(strands, level);
        CHECK(line.rounding() == doctest::Approx(8 * eps * (level + weights)));
        // At one place both are the value and the slope themselves.
        const double t = n.between(-1.5, 1.5), h = 1e-6;
        const double slope = (line.value(t + h) - line.value(t - h)) / (2 * h);
        const auto value_at = line.range(t, t), slope_at = line.slope(t, t);
        CHECK(std::abs(value_at.low - line.value(t)) < 1e-13);
        CHECK(std::abs(value_at.high - line.value(t)) < 1e-13);
        CHECK(value_at.low <= line.value(t));
        CHECK(value_at.high >= line.value(t));
        CHECK(std::abs(slope_at.low - slope) < 1e-4);
        CHECK(std::abs(slope_at.high - slope) < 1e-4);
        // Over a part they hold for each place, and the mean value theorem for both.
        const double a = n.between(-1.5, 1.5), b = a + n.power(-3, 0);
        const auto range = line.range(a, b), slopes = line.slope(a, b);
        double steepest = 0;
        for (int k = 0; k <= 20; ++k) {
            const double x = a + (b - a) * k / 20;
            CHECK(range.low <= line.value(x));
            CHECK(line.value(x) <= range.high);
            const double y = a + (b - a) * (k + 1) / 21;
            const double rise = line.value(y) - line.value(a);
            CHECK(rise <= slopes.high * (y - a) + 1e-13);
            CHECK(rise >= slopes.low * (y - a) - 1e-13);
            steepest = std::max(steepest, std::abs(rise) / (y - a));
        }
        CHECK(steepest <= line.steepest() + 1e-9);
    }
}

namespace {

/// A straight field, t - zero, with bounds as loose as a test wants them.
struct Straight {
    double zero = 2;
    double loose = 0;
    double enter = 0, leave = 100;
    double value(double t) const { return t - zero; }
    double steepest() const { return 1; }
    double rounding() const { return 0; }
    detail::IntervalT<double> range(double a, double b) const {
        return {value(a) - loose, value(b) + loose};
    }
    detail::IntervalT<double> slope(double, double) const { return {1, 1 + loose}; }
};

} // namespace

TEST_CASE("solvers: a crossing at an end of the range counts, none behind it") {
    for (const double loose : {0.0, 10.0}) {
        const Straight line{.loose = loose};
        const auto by = [&](const auto& solver, double t_min, double t_max) {
            return detail::first_meeting(solver, line, t_min, t_max);
        };
        CHECK(by(Bisection{}, 0, 1) == std::nullopt);
        CHECK(by(Bisection{}, 0, 2) == 2.0);
        CHECK(by(Bisection{}, 0, 9) == 2.0);
        CHECK(by(Bisection{}, 3, 9) == std::nullopt);
        CHECK(by(SphereTracing{}, 0, 1) == std::nullopt);
        CHECK(by(SphereTracing{}, 0, 2) == 2.0);
        CHECK(by(SphereTracing{}, 0, 9) == 2.0);
        CHECK(by(SphereTracing{}, 3, 9) == std::nullopt);
        CHECK(by(SphereTracing{}, 2, 2) == 2.0);
    }
}

TEST_CASE("isosurface: a hit is put back no farther than its t can have been wrong") {
    // The plane x = 1, and a ray along x whose t is off by so much.
    const auto value = [](const Point& x) { return 1 - x.x; };
    const auto gradient = [](const Point&) { return Point{-1, 0, 0}; };
    const RayT<double> ray{.origin{-3, 0, 4}, .direction{0.5, 0, 0}};
    const double unit = std::numeric_limits<double>::epsilon() / 2;
    const double doubt = 8 * unit * (5 + 8 * 0.5); // |O| = 5, t = 8, |D| = 1/2
    const auto at = [&](double off) {
        return detail::refined<double>(value, gradient, ray, 8 + 2 * off, 0.0);
    };
    const Vec3T<double> own =
        detail::rounding_bound<double>(2) * glm::abs(Point{1, 0, 4});
    const auto near = at(0.5 * doubt), far = at(1e-9);
    CHECK(near.position == Point{1, 0, 4});
    CHECK(near.error == own);
    CHECK(near.normal == Point{1, 0, 0});
    CHECK(far.position.x == doctest::Approx(1 + 1e-9).epsilon(1e-14));
    CHECK(far.error.y == doctest::Approx(doubt).epsilon(1e-8));
    CHECK(far.error.z == doctest::Approx(doubt + own.z).epsilon(1e-8));
    // What the values may be wrong by is added, if it is the smaller of the two.
    const auto rough = detail::refined<double>(value, gradient, ray, 8.0, doubt / 4);
    CHECK(rough.error.y == doctest::Approx(doubt / 4));
}

TEST_CASE("solvers: both give up where their limits say") {
    const Metaballs balls{.blobs{{.center{0, 0, -4}}}};
    CHECK(intersect(Ray{}, balls, SphereTracing{.max_steps = 200}));
    CHECK_FALSE(intersect(Ray{}, balls, SphereTracing{.max_steps = 3}));
    CHECK(intersect(Ray{}, balls, Bisection{}));
    CHECK_FALSE(intersect(Ray{}, balls, Bisection{.max_parts = 1}));
}

TEST_CASE("metaballs: glass and grey ones in the path tracer and the photon mapper") {
    Scene<Shapes<Metaballs, Sphere, Quad>, Materials<Lambertian, Glass>> scene;
    const auto grey = scene.add(Lambertian{.albedo = Rgb{0.6f}});
    Metaballs left = peanut();
    for (Blob& b : left.blobs) b.center.x -= 1.6f;
    scene.add(peanut(), scene.add(Glass{}));
    scene.add(left, grey);
    scene.add(Quad{.corner{-4, -1, 0}, .edge_u{8, 0, 0}, .edge_v{0, 0, -8}}, grey);
    scene.add(Sphere{.center{2, 4, -2}, .radius = 0.5f}, grey, Rgb{20});
    const World world(std::move(scene));
    const PhotonMapper mapper(world);
    CHECK(mapper.maps().caustics.records.size() > 1000); // aimed at the bounding sphere
    const PathTracer tracer(world);
    const RenderSettings picture{32, 32, 64, 1};
    const auto a = render(mapper, Camera{}, picture),
               b = render(tracer, Camera{}, picture);
    double sum_a = 0, sum_b = 0;
    for (std::size_t i = 0; i < a.image.pixels.size(); ++i) {
        CHECK(is_finite(a.image.pixels[i]));
        CHECK(is_finite(b.image.pixels[i]));
        sum_a += double(a.image.pixels[i].y);
        sum_b += double(b.image.pixels[i].y);
    }
    CHECK(sum_b > 0);
    CHECK(sum_a == doctest::Approx(sum_b).epsilon(0.1));
}

TEST_CASE("metaballs: what a carving blob may round off is part of a hit's error") {
    // Far from where it carves, the surface of the other one is a sphere, where
    // |grad f| = 4 w s q / r, with s = 1/2 and q^2 = 1/2.
    const Metaballs balls{.blobs{{}, {.center{0, 50, 0}, .weight = -100}}};
    const Ray ray{.origin{10, 0, 0}, .direction{-1, 0, 0}};
    const auto t = intersect(ray, balls);
    REQUIRE(t);
    const SurfacePoint p = surface_point(balls, ray, as_hit(*t));
    const double eps = std::numeric_limits<double>::epsilon();
    const double rounding = 64 * eps * (0.25 + 1 + 100) / std::sqrt(2);
    CHECK(double(p.error.y) > 0.999 * rounding);
    CHECK(double(p.error.y) < 1.3 * rounding); // and what Newton's step leaves of f
}

TEST_CASE("metaballs: a surface on the border of another blob is met there") {
    // f of the large blob is exactly 0 at -1, where the small one begins.
    for (const float weight : {0.5f, -0.25f}) {
        const Metaballs balls{.blobs{{.radius = 2}, {.weight = weight}},
                              .level = 0.5625f};
        const Ray ray{.origin{-4, 0, 0}, .direction{1, 0, 0}};
        const auto check = [&](const auto& solver) {
            const auto t = intersect(ray, balls, solver);
            REQUIRE(t);
            CHECK(*t == doctest::Approx(3).epsilon(1e-6));
        };
        check(QuarticPieces{});
        check(Bisection{});
        check(SphereTracing{});
    }
}

namespace {

/// f = depth - (t - 3)^2 on a ray, with the best bounds of its values and none of its
/// slope: a field that is crossed at 3 -+ sqrt(depth), or only touched.
struct Parabola {
    double depth = 0, enter = 0, leave = 8;
    double value(double t) const { return depth - (t - 3) * (t - 3); }
    double steepest() const { return 12; }
    detail::IntervalT<double> range(double a, double b) const {
        const double most = value(std::clamp(3.0, a, b));
        return {std::min(value(a), value(b)), most};
    }
};

} // namespace

TEST_CASE("solvers: without bounds of the slope the smallest parts decide") {
    const auto by = [](double depth, double t_min, double t_max) {
        return detail::first_meeting(Bisection{}, Parabola{depth}, t_min, t_max);
    };
    CHECK(by(1, 0, 8) == 2.0);
    CHECK(by(1, 0, 2) == 2.0); // the last number of the range
    CHECK(by(1, 0, std::nextafter(2.0, 0.0)) == std::nullopt);
    CHECK(by(1, 3, 8) == 4.0); // from within
    CHECK(by(1, 3, 4) == 4.0);
    CHECK(by(1, 5, 8) == std::nullopt);
    CHECK(by(0, 0, 8) == 3.0); // touched, and not crossed
    CHECK(by(0, 0, 3) == 3.0);
    CHECK(by(-1e-9, 0, 8) == std::nullopt);
}

TEST_CASE("solvers: a field that is no number is met nowhere") {
    const Straight line{.zero = not_a_number};
    CHECK_FALSE(detail::first_meeting(SphereTracing{}, line, 0.0, 9.0));
    CHECK_FALSE(detail::first_meeting(Bisection{}, line, 0.0, 9.0));
}

namespace {

/// A ball's own distance from its border, with a bound that a test may spoil.
struct Linear {
    double value(Point x) const { return 1 - glm::length(x); }
    Point gradient(Point x) const { return -glm::normalize(x); }
    double lipschitz() const { return bound; }
    double bound = 1;
};

} // namespace

TEST_CASE("isosurface: what it refuses, and where it ends") {
    using Ball = IsosurfaceT<double, Linear>;
    const auto refused = [](const Ball& ball) {
        return ljus_test::refusal([&] { check(ball); }, "accepted");
    };
    const Ball good{.field{}, .bounds{.center{0, 0, 0}, .radius = 2}};
    CHECK(refused(good) == "accepted");
    for (const double bad : {0.0, -1.0, not_a_number, infinity}) {
        Ball ball = good;
        ball.bounds.radius = bad;
        CHECK(refused(ball).find("isosurface.bounds.radius is ") == 0);
        ball = good;
        ball.field.bound = bad;
        CHECK(refused(ball).find("isosurface.field.lipschitz() is ") == 0);
        ball = good;
        ball.bounds.center.y = bad;
        const bool finite = std::isfinite(bad);
        CHECK((refused(ball).find("isosurface.bounds.center is ") == 0) == !finite);
    }
    CHECK(bounding_sphere(good).radius == 2);
    // Its roots are 4 and 6 along z, in lengths of the direction; the range decides.
    for (const double length : {1.0, 0.25, 8.0}) {
        const auto hit = [&](double z, double t_min, double t_max) {
            const RayT<double> ray{.origin{0, 0, z},
                                   .direction{0, 0, -length},
                                   .t_min = t_min / length,
                                   .t_max = t_max / length};
            const auto by_steps = intersect(ray, good);
            const auto by_parts = intersect(ray, good, Bisection{});
            CHECK(by_steps.has_value() == by_parts.has_value());
            if (by_steps) CHECK(std::abs(*by_steps - *by_parts) * length < 2e-9);
            return by_parts ? *by_parts * length : -1.0;
        };
        CHECK(hit(5, 0, infinity) == doctest::Approx(4));
        CHECK(hit(5, 4.5, infinity) == doctest::Approx(6)); // from within
        CHECK(hit(0.5, 0, infinity) == doctest::Approx(1.5));
        CHECK(hit(5, 0, 3.9) == -1);
        CHECK(hit(5, 6.1, infinity) == -1);
        CHECK(hit(-5, 0, infinity) == -1);
    }
    CHECK_FALSE(intersect(RayT<double>{.origin{0, 1.5, 5}}, good)); // within the bounds
    CHECK_FALSE(intersect(RayT<double>{.origin{0, 3, 5}}, good));
    // What lies farther away than any float is a miss.
    const IsosurfaceT<float, Linear> ball{.bounds{.radius = 2}};
    for (const float length : {2e-38f, 1e-38f}) {
        const Ray ray{.origin{0, 0, 5}, .direction{0, 0, -length}};
        CHECK(intersect(ray, ball).has_value() == (length > 1.5e-38f));
        CHECK(intersect(ray, ball, Bisection{}).has_value() == (length > 1.5e-38f));
    }
    // A hit is put back, and within its error's box the field changes its sign.
    Numbers n{17};
    for (int i = 0; i < 200; ++i) {
        const Point from = 3.0 * n.direction();
        const RayT<double> ray{.origin = from, .direction = 0.6 * n.point(1) - from};
        const auto t = intersect(ray, good);
        if (!t) continue;
        const auto p = surface_point(good, ray, as_hit(*t));
        CHECK(glm::distance(p.normal, glm::normalize(p.position)) < 1e-8);
        const double reach = glm::dot(glm::abs(p.normal), p.error);
        CHECK(std::abs(glm::length(p.position) - 1) <= reach);
        CHECK(reach < 1e-7);
        // What leaves it does not meet it again, what enters comes out elsewhere.
        const auto aside = glm::normalize(p.normal + 0.9 * n.direction());
        CHECK_FALSE(intersect(spawn_ray(p, aside), good));
        const auto across = intersect(spawn_ray(p, -p.normal), good);
        REQUIRE(across);
        CHECK(*across == doctest::Approx(2));
    }
    CHECK(SphereTracing{}.tolerance == 1e-9);
    CHECK(SphereTracing{}.max_steps == 2000);
    CHECK(Bisection{}.max_parts == 4096);
    CHECK(Metaballs{}.level == 0.25f);
    CHECK((Blob{}.radius == 1 && Blob{}.weight == 1 && Blob{}.center == Vec3{0}));
}

TEST_CASE("metaballs: the sphere around one blob is rounded up, never down") {
    Numbers n{23};
    for (int i = 0; i < 500; ++i) {
        const Metaballs one{.blobs{
            {Vec3(n.point(9)), float(n.power(-3, 3)), float(n.between(0.3, 5))}}};
        const Blob& blob = one.blobs[0];
        const long double right =
            (long double)(blob.radius) *
            std::sqrt(1 - std::sqrt(0.25L / (long double)(blob.weight)));
        const Sphere ball = bounding_sphere(one);
        CHECK((long double)(ball.radius) >= right);
        CHECK((long double)(ball.radius) <= right * (1 + 1e-6L));
        CHECK(glm::distance(ball.center, blob.center) <= 1e-6f * ball.radius);
    }
}

TEST_CASE("metaballs: the formula's roots, leaning to either side, and the first") {
    for (const bool mirrored : {false, true}) {
        std::array<double, 4> right{0.1, 0.3, 0.4, 0.9};
        if (mirrored) right = {0.1, 0.6, 0.7, 0.9};
        std::array<double, 5> c{1, 0, 0, 0, 0}; // the product of x - root
        for (const double root : right)
            for (std::size_t i = 5; i-- > 0;)
                c[i] = (i > 0 ? c[i - 1] : 0) - root * c[i];
        const auto found = detail::quartic_formula(c);
        REQUIRE(found.count == 4);
        auto sorted = found.at;
        std::sort(sorted.begin(), sorted.begin() + 4);
        for (std::size_t i = 0; i < 4; ++i)
            CHECK(sorted[i] == doctest::Approx(right[i]).epsilon(1e-6));
    }
    // (x - 0.2) (x - 0.4) (x - 0.6) (x - 0.8), in Bernstein's form.
    const detail::BernsteinT<double, 4> p{
        .c{0.0384, -0.0616, 0.0384 - 0.2 + 1.4 / 6, -0.0616, 0.0384}};
    const auto first = detail::first_change(Radicals{}, p);
    REQUIRE(first);
    CHECK(*first == doctest::Approx(0.2).epsilon(1e-6));
}
