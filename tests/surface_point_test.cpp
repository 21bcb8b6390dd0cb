/// \file surface_point_test.cpp
/// \brief Leaving a surface, and rays between two surfaces. The sides against exact
/// arithmetic are in surface_exact_test.cpp.

#include "ljus/geometry/surface_point.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <type_traits>

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

struct Lost {
    int rays = 0, at_lamp = 0, at_floor = 0;
};

/// Shadow rays from a floor of size 1 to a lamp of size 1, `distance` away; the one at
/// `offset` from the origin, the other beyond it. Nothing else is in the scene.
template <typename T, typename MakeLamp>
Lost shadow_rays(double offset, double distance, bool lamp_near, MakeLamp make_lamp) {
    using V = Vec3T<double>;
    Numbers n;
    Lost lost;
    for (int i = 0; i < 2000; ++i) {
        const V near = offset * n.point(1), way = n.direction();
        const V lamp_at = lamp_near ? near : near + distance * way;
        const V floor_at = lamp_near ? near - distance * way : near;
        const V side = glm::normalize(glm::cross(way, n.direction()));
        const V across = glm::normalize(glm::cross(way + n.next() * side, side));
        const QuadT<T> floor{Vec3T<T>(floor_at - 0.5 * (side + across)), Vec3T<T>(side),
                             Vec3T<T>(across)};
        const SurfacePointT<T> from = point_at(floor, T(0.5), T(0.5));
        const auto lamp = make_lamp(lamp_at, -way, n);
        const auto to = sample_towards(lamp, from.position, n.square<T>()).point;
        if (!(glm::dot(to.position - from.position, to.normal) < 0)) continue;
        const RayT<T> ray = spawn_ray_to(from, to);
        ++lost.rays;
        lost.at_lamp += intersect(ray, lamp).has_value();
        lost.at_floor += intersect(ray, floor).has_value();
    }
    return lost;
}

} // namespace

TEST_CASE_TEMPLATE("surface: the bound of n roundings", T, float, double) {
    constexpr T u = std::numeric_limits<T>::epsilon() / 2;
    static_assert(detail::rounding_bound<T>(0) == T(0));
    CHECK(detail::rounding_bound<T>(1) >= u);
    CHECK(detail::rounding_bound<T>(1) < u * T(1.001));
    for (int n = 1; n < 20; ++n) {
        // (1 + u)^n - 1 and 1 - (1 - u)^n both lie below.
        const auto wide = [&](long double sign) {
            return std::abs(std::pow(1 + sign * (long double)(u), n) - 1);
        };
        CHECK((long double)(detail::rounding_bound<T>(n)) >= wide(1) * (1 - 1e-9L));
        CHECK((long double)(detail::rounding_bound<T>(n)) >= wide(-1) * (1 - 1e-9L));
    }
}

TEST_CASE("surface: a ray leaves on the side that it points to") {
    const SurfacePoint p{.position = {1, 2, 3}, .normal = {0, 1, 0}};
    CHECK(offset_ray_origin(p, Vec3{5, 0.1f, 0}).y > 2);
    CHECK(offset_ray_origin(p, Vec3{5, -0.1f, 0}).y < 2);
    CHECK(offset_ray_origin(p, Vec3{0, 1e-30f, 0}).y > 2); // its length does not matter
    CHECK(offset_ray_origin(p, Vec3{0, 1e30f, 0}) ==
          offset_ray_origin(p, Vec3{0, 1, 0}));
    CHECK(offset_ray_origin(p, Vec3{0, 1, 0}).x == 1.0f); // straight up
    CHECK(offset_ray_origin(p, Vec3{0, 1, 0}).z == 3.0f);
    CHECK(offset_ray_origin(p, Vec3{0, 1, 0}).y < 2.00001f); // and not far
    const Ray ray = spawn_ray(p, Vec3{1, 2, 0});
    CHECK(ray.origin == offset_ray_origin(p, Vec3{1, 2, 0}));
    CHECK(ray.direction == Vec3{1, 2, 0});
    CHECK(ray.t_min == 0.0f);
    CHECK(ray.t_max == std::numeric_limits<float>::infinity());
}

TEST_CASE_TEMPLATE("surface: coordinates of 0 do not hold a ray back", T, float,
                   double) {
    // A wall through the origin, hit in the middle and at its corner.
    for (const T size : {T(1e-6), T(1), T(1e6)})
        for (const T corner : {T(-0.5), T(0)}) {
            const QuadT<T> wall{
                {corner * size, 0, corner * size}, {0, 0, size}, {size, 0, 0}};
            const SurfacePointT<T> p = point_at(wall, -corner, -corner);
            REQUIRE(p.position == Vec3T<T>{0});
            for (const T up : {T(1), T(-1)}) {
                const RayT<T> ray = spawn_ray(p, Vec3T<T>{T(0.3), up, T(0.1)});
                CHECK(ray.origin.y * up > 0);
                CHECK_FALSE(intersect(ray, wall));
            }
        }
}

TEST_CASE_TEMPLATE(
    "surface: the last place is that of the largest coordinate and error", T, float,
    double) {
    // Where every coordinate is 0, an error in the plane says how large the wall is.
    for (int large = 0; large < 3; ++large)
        for (int up = 0; up < 3; ++up)
            for (const bool by_error : {false, true}) {
                if (by_error && large == up) continue;
                SurfacePointT<T> p{.normal = Vec3T<T>{0}};
                (by_error ? p.error : p.position)[large] = by_error ? T(8) : T(-8);
                p.normal[up] = 1;
                Vec3T<T> direction{1};
                for (const T side : {T(1), T(-1)}) {
                    direction[up] = side;
                    const Vec3T<T> off = offset_ray_origin(p, direction) - p.position;
                    CHECK(off[up] == side * 32 * std::numeric_limits<T>::epsilon());
                    CHECK(glm::length(off) == std::abs(off[up]));
                }
            }
}

TEST_CASE("surface: at a millionth of a unit as at a million") {
    // A layer of a thousandth of its size, and a ray that starts on its upper face.
    for (const float size : {1e-6f, 1e-3f, 1.0f, 1e3f, 1e6f}) {
        const float half = size / 2, thick = size / 1000;
        const Quad top{{-half, size + thick, -half}, {0, 0, size}, {size, 0, 0}};
        const Quad bottom{{-half, size, -half}, {0, 0, size}, {size, 0, 0}};
        Numbers n;
        for (int i = 0; i < 200; ++i) {
            const auto u = n.square<float>();
            const SurfacePoint p = point_at(top, u.x, u.y);
            const Vec3 down{0.1f * u.x, -1, 0.1f * u.y};
            const Ray in = spawn_ray(p, down);
            CHECK_FALSE(intersect(in, top));
            CHECK(intersect(in, bottom).has_value() ==
                  (std::abs(point_at(in, thick).x) < half &&
                   std::abs(point_at(in, thick).z) < half));
            CHECK(in.origin.y > size);
            const Ray out = spawn_ray(p, -down);
            CHECK_FALSE(intersect(out, top));
            CHECK_FALSE(intersect(out, bottom));
        }
    }
}

TEST_CASE("surface: a ray between two points ends just short of both") {
    const Quad floor{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}};
    const Quad lamp{{-1, 2, -1}, {2, 0, 0}, {0, 0, 2}};
    const auto from = point_at(floor, 0.25f, 0.25f), to = point_at(lamp, 0.75f, 0.5f);
    const Ray ray = spawn_ray_to(from, to);
    CHECK(ray.t_max == 1.0f);
    CHECK(ray.origin.y > 0);
    CHECK(point_at(ray, 1.0f).y < 2);
    CHECK(glm::distance(ray.origin, from.position) < 1e-5f);
    CHECK(glm::distance(point_at(ray, 1.0f), to.position) < 1e-5f);
    // Behind the lamp the ray comes from its other side.
    const auto above = point_at(Quad{{-1, 5, -1}, {0, 0, 2}, {2, 0, 0}}, 0.5f, 0.5f);
    CHECK(point_at(spawn_ray_to(above, to), 1.0f).y > 2);
}

TEST_CASE_TEMPLATE("surface: no lamp and no floor is in its own light", T, float,
                   double) {
    using V = Vec3T<double>;
    const auto sphere = [](const V& at, const V&, Numbers&) {
        return SphereT<T>{Vec3T<T>(at), T(1)};
    };
    const auto quad = [](const V& at, const V& up, Numbers& n) {
        const V lean = glm::normalize(up + 0.8 * n.direction());
        const V a = glm::normalize(glm::cross(lean, n.direction()));
        const V b = glm::cross(lean, a);
        return QuadT<T>{Vec3T<T>(at - 0.5 * (a + b)), Vec3T<T>(a), Vec3T<T>(b)};
    };
    for (const double offset : {0.0, 1e2, 1e4})
        for (const double distance : {1.5, 10.0, 1e2, 1e3, 1e4, 1e5})
            for (const bool lamp_near : {true, false}) {
                CAPTURE(offset);
                CAPTURE(distance);
                CAPTURE(lamp_near);
                const auto check = [](const Lost& lost) {
                    CHECK(lost.rays > 900);
                    CHECK(lost.at_lamp == 0);
                    CHECK(lost.at_floor == 0);
                };
                check(shadow_rays<T>(offset, distance, lamp_near, sphere));
                check(shadow_rays<T>(offset, distance, lamp_near, quad));
            }
}

TEST_CASE(
    "surface point: whether two edges span an area, in any plane and of any size") {
    const Vec3T<double> x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1}, slanted{3, -5, 7};
    for (const double size : {1e-60, 1e-12, 1.0, 1e12, 1e60}) {
        for (const auto& [a, b] : {std::pair{x, y},
                                   {y, z},
                                   {z, x},
                                   {x, slanted},
                                   {slanted, y},
                                   {slanted, z}}) {
            CHECK(detail::span_area(size * a, size * b));
            CHECK(detail::span_area(size * b, -size * a));
        }
        for (const Vec3T<double>& a : {x, y, z, slanted, x + y, y + z, z + x})
            for (const double k : {1.0, -1.0, 3.0, -0.25, 0.0}) {
                CHECK_FALSE(detail::span_area(size * a, k * (size * a)));
                CHECK_FALSE(detail::span_area(k * (size * a), size * a));
            }
        // An angle of a millionth is one.
        CHECK(detail::span_area(size * slanted, size * (slanted + 1e-6 * x)));
        CHECK(detail::span_area(size * slanted, size * (slanted + 1e-6 * y)));
        CHECK(detail::span_area(size * slanted, size * (slanted + 1e-6 * z)));
    }
}

TEST_CASE_TEMPLATE("surface: slivers do not meet again what leaves them", T, float,
                   double) {
    // In double the plane of a sliver is known worse than its points are: a test of it
    // rounds by what is left of its area.
    using V = Vec3T<double>;
    Numbers n;
    for (const double thin : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10})
        for (const double offset : {0.0, 10.0}) {
            long cases = 0, again = 0, at_lamp = 0, at_floor = 0;
            for (int i = 0; i < 2000; ++i) {
                const V a = n.direction(), corner = offset * n.point(1);
                const V b = glm::normalize(glm::cross(a, n.direction()));
                const V third = n.between(-0.5, 1.5) * a + thin * b;
                const TriangleT<T> triangle{Vec3T<T>(corner), Vec3T<T>(corner + a),
                                            Vec3T<T>(corner + third)};
                const QuadT<T> quad{triangle.v1, triangle.v2 - triangle.v1,
                                    triangle.v3 - triangle.v1};
                const Vec3T<T> way(n.direction());
                const auto far = static_cast<T>(n.power(-1, 3));
                const auto check = [&](const auto& shape) {
                    if (!has_area(shape)) return;
                    const auto point = sample_area(shape, n.square<T>());
                    // Below that angle no rounded test knows the side of the plane.
                    const double sine = std::abs(glm::dot(V(way), V(point.normal)));
                    if (sine < 1e-3) return;
                    ++cases;
                    again += intersect(spawn_ray(point, way), shape).has_value();
                    const SurfacePointT<T> seen{.position = point.position + far * way,
                                                .normal = -way};
                    at_lamp += intersect(spawn_ray_to(seen, point), shape).has_value();
                    at_floor += intersect(spawn_ray_to(point, seen), shape).has_value();
                };
                check(triangle);
                check(quad);
            }
            CAPTURE(thin);
            CAPTURE(offset);
            CHECK(cases > 3000);
            CHECK(again == 0);
            CHECK(at_lamp == 0);
            CHECK(at_floor == 0);
        }
}

TEST_CASE("surface: how badly the plane between two edges is known, by hand") {
    using V = Vec3T<double>;
    const auto between = [](const auto& e1, const auto& e2) {
        SurfacePointT<std::remove_cvref_t<decltype(e1.x)>> point;
        detail::add_tilt(point, e1, e2);
        return point;
    };
    const SurfacePointT<double> square = between(V{2, 0, 0}, V{0, 3, 0});
    CHECK(square.tilt == 1);
    CHECK(square.error == V{detail::rounding_bound<double>(9) * 5});
    CHECK(between(V{1, 0, 0}, V{1, 1e-6, 0}).tilt == doctest::Approx(1e6 + 1));
    // No ray meets a shape of parallel edges; what is wider than its data is exact.
    const SurfacePointT<double> parallel = between(V{1, 2, 3}, V{2, 4, 6});
    CHECK((parallel.tilt == 0 && parallel.error == V{0}));
    const SurfacePoint narrow = between(Vec3{1, 0, 0}, Vec3{1, 1e-6f, 0});
    CHECK((narrow.tilt == 0 && narrow.error == Vec3{0}));
}

TEST_CASE_TEMPLATE("surface: a ray has the time that it is given, a copy all there is",
                   T, float, double) {
    const SurfacePointT<T> a{.position{T(1), T(2), T(3)},
                             .error{T(4), T(5), T(6)},
                             .normal{T(0), T(1), T(0)},
                             .tilt = T(7)};
    const SurfacePointT<T> b{.position{T(9), T(8), T(3)}};
    const Vec3T<T> up{T(0), T(1), T(0)};
    CHECK(spawn_ray(a, up).time == T(0));
    CHECK(spawn_ray(a, up, T(0.25)).time == T(0.25));
    CHECK(spawn_ray_to(a, b).time == T(0));
    CHECK(spawn_ray_to(a, b, T(0.75)).time == T(0.75));
    CHECK(spawn_ray_to(a, b).t_max == T(1));
    CHECK(spawn_ray(a, up).t_max == std::numeric_limits<T>::infinity());
    SurfacePointT<T> copy{.tilt = T(3)};
    detail::set_point(copy, a);
    CHECK(copy.position == a.position);
    CHECK(copy.error == a.error);
    CHECK(copy.normal == a.normal);
    CHECK(copy.tilt == a.tilt);
}
