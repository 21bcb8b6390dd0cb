/// \file shape_test.cpp
/// \brief What a scene asks of a shape, for each shape of the house.

#include "ljus/geometry/shape.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "ljus/geometry/moving.hpp"
#include "support/numbers.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::Numbers;

static_assert(Shape<Sphere> && Shape<Triangle> && Shape<Quad>);
static_assert(Shape<SphereT<double>> && Shape<TriangleT<double>> &&
              Shape<QuadT<double>>);
static_assert(!Shape<int> && !Shape<Vec3> && !Shape<Ray>);
static_assert(std::is_same_v<ScalarOf<Sphere>, float> &&
              std::is_same_v<ScalarOf<QuadT<double>>, double>);

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();

} // namespace

TEST_CASE("shape: every hit has a distance, a flat one also coordinates") {
    CHECK(as_hit(2.5f).t == 2.5f);
    CHECK(as_hit(2.5f).u == 0.0f);
    const ShapeHitT<float> flat{1, 0.25f, 0.5f};
    CHECK(as_hit(flat).t == 1.0f);
    CHECK(as_hit(flat).v == 0.5f);
}

TEST_CASE("shape: a hit point of a sphere is where the ray meets it") {
    // Against the same in long double, relative to the way that t has to describe.
    using L = glm::vec<3, long double>;
    Numbers n;
    int hits = 0;
    for (int i = 0; i < 20000; ++i) {
        const double radius = n.power(-2, 2), distance = radius * n.power(0.1, 2);
        const auto center = n.power(-2, 5) * n.direction();
        if (radius < 1e-4 * glm::length(center)) continue;
        const auto way = n.direction();
        const Sphere ball{Vec3(center), float(radius)};
        const Vec3 origin(center + distance * way);
        const Vec3 aim(center + 0.9 * radius * n.direction());
        const Ray ray{.origin = origin, .direction = glm::normalize(aim - origin)};
        const auto t = intersect<double>(ray, ball);
        if (!t) continue;
        ++hits;
        const SurfacePoint p = surface_point(ball, ray, as_hit(*t));

        const L oc = L(ray.origin) - L(ball.center), d(ray.direction);
        const long double a = glm::dot(d, d), b = -glm::dot(oc, d);
        const L nearest = oc + b / a * d;
        const long double rest =
            (long double)(ball.radius) * (long double)(ball.radius) -
            glm::dot(nearest, nearest);
        const L truth = nearest - std::sqrt(rest / a) * d;
        const long double off =
            glm::length((long double)(ball.radius) * L(p.normal) - truth);
        REQUIRE(off < 4e-7L * (long double)(distance + radius));
        REQUIRE(std::abs(glm::length(p.normal) - 1) < 3e-7f);
    }
    CHECK(hits > 5000);
}

TEST_CASE("shape: a sphere too small for its distance still has a normal") {
    for (const float far : {1.0f, 1e3f, 1e6f, 1e9f})
        for (const float radius : {1e-30f, 1e-12f, 1e-6f, 1e-3f}) {
            const Sphere grain{{far, far, -far}, radius};
            const Ray ray{.direction = glm::normalize(grain.center)};
            ShapeHitT<float> hit{.t = glm::length(grain.center)};
            if (const auto t = intersect<double>(ray, grain)) hit.t = *t;
            const SurfacePoint p = surface_point(grain, ray, hit);
            CHECK(is_finite(p.position));
            CHECK(glm::length(p.normal) == doctest::Approx(1).epsilon(1e-5));
            CHECK(is_finite(offset_ray_origin(p, -ray.direction)));
        }
    // The sum is exactly the centre: the normal faces the ray.
    const Sphere grain{{4, 0, 0}, 1e-9f};
    const Ray ray{.direction = {1, 0, 0}};
    CHECK(surface_point(grain, ray, {.t = 4}).normal == Vec3{-1, 0, 0});
}

TEST_CASE("shape: a hit point of a flat shape comes from its coordinates") {
    const Triangle t{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    CHECK(surface_point(t, Ray{}, {.t = 9, .u = 0.25f, .v = 0.5f}).position ==
          Vec3{1, 2, 0});
    const Quad q{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
    CHECK(surface_point(q, Ray{}, {.t = 9, .u = 1, .v = 0.5f}).position ==
          Vec3{4, 2, 0});
    CHECK(surface_point(q, Ray{}, {.t = 9}).normal == Vec3{0, 0, 1});
}

TEST_CASE("shape: points of a sphere cover its area evenly") {
    // Cells of equal area in z and longitude; a false alarm once in a million.
    Numbers n;
    const Sphere ball{{1, -2, 3}, 2};
    std::array<int, 128> cells{};
    for (int i = 0; i < 128000; ++i) {
        const SurfacePoint p = sample_area(ball, n.square<float>());
        const Vec3 way = (p.position - ball.center) / ball.radius;
        REQUIRE(glm::distance(way, p.normal) < 1e-6f);
        REQUIRE(std::abs(glm::length(way) - 1) < 1e-6f);
        const float turn = std::atan2(way.y, way.x) / 6.2831855f + 0.5f;
        const int row = std::clamp(int((way.z + 1) * 4), 0, 7);
        const int column = std::clamp(int(turn * 16), 0, 15);
        ++cells[static_cast<std::size_t>(row * 16 + column)];
    }
    CHECK(ljus_test::chi_square(cells) < ljus_test::chi_square_limit(127));
}

TEST_CASE("shape: the bounding sphere contains the shape") {
    Numbers n;
    for (int i = 0; i < 5000; ++i) {
        const double size = n.power(-6, 6);
        const auto vec = [&] { return Vec3(size * n.point(1)); };
        const Sphere ball{vec(), float(size)};
        const Triangle triangle{vec(), vec(), vec()};
        const Quad quad{vec(), vec(), vec()};
        const auto holds = [&](const Sphere& bound, const Vec3& p) {
            return glm::distance(glm::dvec3(bound.center), glm::dvec3(p)) <=
                   double(bound.radius) * (1 + 1e-5);
        };
        const Sphere of_triangle = bounding_sphere(triangle);
        for (const Vec3& v : {triangle.v1, triangle.v2, triangle.v3})
            REQUIRE(holds(of_triangle, v));
        const Sphere of_quad = bounding_sphere(quad);
        for (const float u : {0.0f, 1.0f})
            for (const float v : {0.0f, 1.0f})
                REQUIRE(holds(of_quad, point_at(quad, u, v).position));
        REQUIRE(bounding_sphere(ball).center == ball.center);
        REQUIRE(bounding_sphere(ball).radius == ball.radius);
    }
    // No larger than it has to be.
    CHECK(bounding_sphere(Quad{{0, 0, 0}, {2, 0, 0}, {0, 2, 0}}).radius ==
          doctest::Approx(std::sqrt(2.0)));
    CHECK(bounding_sphere(
              Triangle{{1, 0, 0}, {-0.5f, 0.8660254f, 0}, {-0.5f, -0.8660254f, 0}})
              .radius == doctest::Approx(1));
}

TEST_CASE("shape: what no picture can be made of is refused by name") {
    CHECK_NOTHROW(check(Triangle{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
    CHECK_NOTHROW(check(Quad{}));
    CHECK_NOTHROW(check(Triangle{})); // a mesh may hold some without an area
    CHECK_THROWS_WITH_AS(
        check(Triangle{.v2{0, not_a_number, 0}}),
        "triangle.v2 is (0, NaN, 0); it must be finite in every component.",
        std::invalid_argument);
    CHECK_THROWS_WITH_AS(
        check(Quad{.edge_v{infinity, 0, 0}}),
        "quad.edge_v is (infinity, 0, 0); it must be finite in every component.",
        std::invalid_argument);
    for (const float bad : {not_a_number, infinity, -infinity})
        for (int axis = 0; axis < 3; ++axis) {
            for (Vec3 Triangle::*part : {&Triangle::v1, &Triangle::v2, &Triangle::v3}) {
                Triangle t{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
                (t.*part)[axis] = bad;
                CHECK_THROWS_AS(check(t), std::invalid_argument);
            }
            for (Vec3 Quad::*part : {&Quad::corner, &Quad::edge_u, &Quad::edge_v}) {
                Quad q;
                (q.*part)[axis] = bad;
                CHECK_THROWS_AS(check(q), std::invalid_argument);
            }
        }
}

namespace {

/// What rounding has done to a position, in parts of the bound that comes with it: at
/// most 1 in each coordinate.
float part_of_bound(const SurfacePoint& point, const glm::dvec3& truth) {
    const glm::dvec3 off = glm::abs(glm::dvec3(point.position) - truth);
    return max_component(Vec3(off / glm::dvec3(point.error)));
}

} // namespace

TEST_CASE("shape: the error of a sphere's point holds its rounding, and little more") {
    Numbers n;
    float largest = 0;
    for (int i = 0; i < 20000; ++i) {
        const double radius = n.power(-2, 2);
        const Sphere ball{Vec3(n.power(-2, 3) * n.direction()), float(radius)};
        const Vec3 origin = ball.center + Vec3(3 * radius * n.direction());
        const Ray ray{.origin = origin,
                      .direction = glm::normalize(ball.center - origin)};
        const auto t = intersect<double>(ray, ball);
        REQUIRE(t);
        for (const SurfacePoint& p : {surface_point(ball, ray, as_hit(*t)),
                                      sample_area(ball, n.square<float>())}) {
            const glm::dvec3 truth =
                glm::dvec3(ball.center) + double(ball.radius) * glm::dvec3(p.normal);
            largest = std::max(largest, part_of_bound(p, truth));
            // Nine tenths of a millionth of the coordinates, not nine tenths of them.
            const glm::vec3 size = glm::abs(ball.center) + ball.radius;
            for (int axis = 0; axis < 3; ++axis) {
                REQUIRE(p.error[axis] > 0);
                REQUIRE(p.error[axis] < 1e-6f * size[axis]);
            }
        }
    }
    CHECK(largest <= 1);
    CHECK(largest > 0.1);
}

TEST_CASE("shape: the sphere around a triangle stands at its middle") {
    Numbers n;
    for (int i = 0; i < 2000; ++i) {
        const auto middle = n.point(100);
        const auto corner = [&] { return Vec3(middle + n.point(1)); };
        const Triangle t{corner(), corner(), corner()};
        const Sphere ball = bounding_sphere(t);
        const glm::dvec3 mean =
            (glm::dvec3(t.v1) + glm::dvec3(t.v2) + glm::dvec3(t.v3)) / 3.0;
        REQUIRE(glm::distance(glm::dvec3(ball.center), mean) < 1e-4);
        double farthest = 0;
        for (const Vec3& v : {t.v1, t.v2, t.v3})
            farthest = std::max(farthest, glm::distance(glm::dvec3(v), mean));
        REQUIRE(std::abs(double(ball.radius) - farthest) < 1e-4);
    }
}

TEST_CASE("shape: a ball that no picture can be made of is refused by name") {
    CHECK_NOTHROW(check(Sphere{{1, 2, 3}, 1e-30f}));
    for (const float bad : {0.0f, -1.0f, infinity, not_a_number})
        CHECK_THROWS_AS(check(Sphere{{1, 2, 3}, bad}), std::invalid_argument);
    for (int axis = 0; axis < 3; ++axis) {
        Sphere ball;
        ball.center[axis] = not_a_number;
        CHECK_THROWS_AS(check(ball), std::invalid_argument);
    }
    CHECK_THROWS_WITH_AS(check(Sphere{.radius = 0}),
                         "sphere.radius is 0; it must be finite and above 0.",
                         std::invalid_argument);
}

TEST_CASE("shape: a table of hooks in one line") {
    using Table = std::vector<detail::Hook>;
    const detail::Hook a{"area", "its size", "no lamp", true},
        b{"box", "bounds", "a ball's", true};
    const detail::Hook c{"uv", "textures", "none", false},
        d{"flat", "speed", "slow", false};
    CHECK(detail::to_line(Table{}) == "has no hook");
    CHECK(detail::to_line(Table{a}) == "has area");
    CHECK(detail::to_line(Table{a, b}) == "has area, box");
    CHECK(detail::to_line(Table{c}) == "has no hook; without uv (none)");
    CHECK(detail::to_line(Table{c, a, d, b}) ==
          "has area, box; without uv (none), flat (slow)");
    CHECK(detail::to_line(Table{c, d}) ==
          "has no hook; without uv (none), flat (slow)");
    // A stand-in is of its type, and of no other's; a final type stands for itself.
    struct Open {};
    struct Final final {};
    CHECK(std::is_base_of_v<Open, detail::Own<Open>>);
    CHECK(detail::is_stand_in<detail::Own<Open>>);
    CHECK_FALSE(detail::is_stand_in<Open>);
    CHECK(std::is_same_v<Final, detail::Own<Final>>);
    // The name of a type, and of those within it.
    CHECK(detail::type_name<Moving<Quad>>().find("ljus::") == std::string::npos);
}

TEST_CASE("shape: what there is without more said") {
    CHECK(Sphere{}.center == Vec3{0});
    CHECK(Sphere{}.radius == 1);
    CHECK(Quad{}.corner == Vec3{0});
    CHECK(Quad{}.edge_u == Vec3{1, 0, 0});
    CHECK(Quad{}.edge_v == Vec3{0, 1, 0});
    CHECK(Triangle{}.v1 == Vec3{0});
    CHECK(Triangle{}.v2 == Vec3{0});
    CHECK(Triangle{}.v3 == Vec3{0});
    CHECK(Moving<Sphere>{}.displacement == Vec3{0});
    CHECK(Ray{}.time == 0);
    const ShapeHitT<float> hit;
    CHECK((hit.t == 0 && hit.u == 0 && hit.v == 0 && hit.part == 0));
    const SurfacePoint point;
    CHECK((point.position == Vec3{0} && point.error == Vec3{0}));
    CHECK((point.normal == Vec3{0, 0, 1} && point.tilt == 0));
    CHECK(as_hit(1.0f).part == 0);
}

namespace reader {

/// The rows of the table of hooks, in their order.
constexpr std::array<std::string_view, 19> rows{"bounds",
                                                "meets",
                                                "shading_normal",
                                                "area",
                                                "sample_area",
                                                "sample_towards",
                                                "pdf_towards",
                                                "center_sample",
                                                "normal",
                                                "point_at",
                                                "form_factor_from",
                                                "facet_of",
                                                "patch_grid",
                                                "corners_of",
                                                "texture_coordinates",
                                                "texture_tangents",
                                                "translated",
                                                "area_sums",
                                                "prototype"};
/// The number of a row.
constexpr std::size_t row(std::string_view name) {
    std::size_t i = 0;
    while (rows[i] != name) ++i;
    return i;
}

/// A ball of a reader that has what a shape must have, and one that has one hook more.
struct Poor {
    Sphere ball{};
};
template <std::size_t Row>
struct One {
    Sphere ball{};
};
template <typename S>
inline constexpr bool is_shape = std::is_same_v<S, Poor>;
template <std::size_t Row>
inline constexpr bool is_shape<One<Row>> = true;
template <typename S>
requires is_shape<S> std::optional<float> intersect(const Ray& ray, const S& s) {
    return ljus::intersect(ray, s.ball);
}
template <typename S>
requires is_shape<S> SurfacePoint surface_point(const S& s, const Ray& ray,
                                                const ShapeHitT<float>& hit) {
    return ljus::surface_point(s.ball, ray, hit);
}
template <typename S>
requires is_shape<S> Sphere bounding_sphere(const S& s) {
    return s.ball;
}
template <typename S>
requires is_shape<S>
void check(const S&) {}

// The hooks, each of the one shape that has it.
template <std::size_t R>
requires(R == row("bounds")) Box bounds(const One<R>&) {
    return {};
}
template <typename Compute, std::size_t R>
requires(R == row("meets")) bool meets(const Ray&, const One<R>&) {
    return false;
}
template <std::size_t R>
requires(R == row("shading_normal")) Vec3
    shading_normal(const One<R>&, const ShapeHitT<float>&, const Vec3& n) {
    return n;
}
template <std::size_t R>
requires(R == row("area")) float area(const One<R>&) {
    return 1;
}
template <std::size_t R>
requires(R == row("sample_area")) SurfacePoint sample_area(const One<R>&, const Vec2&) {
    return {};
}
template <std::size_t R>
requires(R == row("sample_towards")) SeenPointT<float> sample_towards(const One<R>&,
                                                                      const Vec3&,
                                                                      const Vec2&) {
    return {};
}
template <std::size_t R>
requires(R == row("pdf_towards")) float pdf_towards(const One<R>&, const Vec3&,
                                                    const SurfacePoint&) {
    return 0;
}
template <std::size_t R>
requires(R == row("center_sample")) Vec2 center_sample(const One<R>&) {
    return Vec2{0};
}
template <std::size_t R>
requires(R == row("normal")) Vec3 normal(const One<R>&) {
    return Vec3{0, 0, 1};
}
template <std::size_t R>
requires(R == row("point_at")) SurfacePoint
    point_at(const One<R>&, float, float, const Vec3&) {
    return {};
}
template <std::size_t R>
requires(R == row("point_at")) SurfacePoint
    sample_area(const One<R>&, const Vec2&, const Vec3&) {
    return {};
}
template <std::size_t R>
requires(R == row("form_factor_from")) std::optional<float> form_factor_from(
    const Vec3&, const Vec3&, const One<R>&, bool) {
    return {};
}
template <std::size_t R>
requires(R == row("facet_of")) Facet facet_of(const One<R>&) {
    return {};
}
template <std::size_t R>
requires(R == row("patch_grid")) int patch_grid(const One<R>&, double) {
    return 0;
}
template <std::size_t R>
requires(R == row("corners_of")) std::array<Vec3, 3> corners_of(const One<R>&) {
    return {};
}
template <std::size_t R>
requires(R == row("texture_coordinates")) Vec2
    texture_coordinates(const One<R>&, const ShapeHitT<float>&, const SurfacePoint&) {
    return Vec2{0};
}
template <std::size_t R>
requires(R == row("texture_tangents")) std::array<Vec3, 2> texture_tangents(
    const One<R>&, const ShapeHitT<float>&) {
    return {};
}
template <std::size_t R>
requires(R == row("translated")) One<R> translated(const One<R>& s, const Vec3&) {
    return s;
}
template <std::size_t R>
requires(R == row("area_sums")) std::vector<double> area_sums(const One<R>&) {
    return {};
}
template <std::size_t R>
requires(R == row("prototype")) const Sphere& prototype(const One<R>& s) {
    return s.ball;
}

} // namespace reader

TEST_CASE("shape: which hooks a shape has, by name") {
    const auto names = [](const auto& hooks) {
        std::string all;
        for (const auto& hook : hooks)
            if (hook.provided) all.append(hook.name).append(" ");
        return all;
    };
    static_assert(Shape<reader::Poor> && !HasArea<reader::Poor>);
    using Sized = reader::One<reader::row("area")>;
    static_assert(HasArea<Sized> && !Samplable<Sized>);
    // What has no point to be aimed at is not aimed at.
    static_assert(!FlatShape<reader::One<reader::row("normal")>>);
    static_assert(FlatShape<Quad> && FlatShape<Triangle> && !FlatShape<Sphere>);
    CHECK(names(detail::shape_hooks<reader::Poor>()).empty());
    // Each hook alone is told from all others.
    const auto alone = [&]<std::size_t... R>(std::index_sequence<R...>) {
        const auto check_one = [&](const auto& table, std::size_t row) {
            REQUIRE(table.size() == reader::rows.size());
            CHECK(table[row].name == reader::rows[row]);
            CHECK(names(table) == std::string(reader::rows[row]) + " ");
        };
        (check_one(detail::shape_hooks<reader::One<R>>(), R), ...);
    };
    alone(std::make_index_sequence<reader::rows.size()>());
    CHECK(names(detail::shape_hooks<Sphere>()) ==
          "bounds area sample_area sample_towards pdf_towards center_sample "
          "form_factor_from texture_coordinates translated ");
    for (const auto& flat :
         {names(detail::shape_hooks<Triangle>()), names(detail::shape_hooks<Quad>())})
        CHECK(flat == "bounds area sample_area normal point_at facet_of corners_of "
                      "texture_tangents translated ");
    CHECK(names(detail::shape_hooks<Moving<Quad>>()) ==
          "bounds area sample_area center_sample corners_of texture_coordinates "
          "texture_tangents ");
    // A shape without an area has no points to choose; the one there is is of no use.
    const SurfacePoint none = sample_area(reader::Poor{}, Vec2{0.5f});
    CHECK(none.position == Vec3{0});
    CHECK(none.error == Vec3{0});
    // What has one normal is told it; a sphere and what moves work theirs out.
    CHECK((detail::is_plane<Quad> && detail::is_plane<Triangle>));
    CHECK_FALSE((detail::is_plane<Sphere> || detail::is_plane<Moving<Quad>>));
}
