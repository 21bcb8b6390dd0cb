// needs: boost
// concept: surface_point
/// \file surface_point_exact_test.cpp
/// \brief Where a ray starts that leaves a surface, with exact fractions: on its own
/// side, never on the surface, and not through a layer of a thousandth of the object.

#include <doctest/doctest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "ljus/geometry/shape.hpp"
#include "ljus/geometry/solid_angle.hpp"
#include "support/exact.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Exact;
using ljus_test::Exact3;
using ljus_test::Numbers;

namespace {

/// How far a point lies above a surface, exactly in sign, to 15 digits in size.
template <typename T>
double height(const TriangleT<T>& t, const Vec3T<T>& p) {
    const Exact3 v1(t.v1), e1 = Exact3(t.v2) - v1, e2 = Exact3(t.v3) - v1;
    const Exact3 up = cross(e1, e2);
    const double length = std::sqrt(ljus_test::to_double(dot(up, up)));
    return ljus_test::to_double(dot(Exact3(p) - v1, up)) / length;
}
template <typename T>
double height(const QuadT<T>& q, const Vec3T<T>& p) {
    const Exact3 up = cross(Exact3(q.edge_u), Exact3(q.edge_v));
    const double length = std::sqrt(ljus_test::to_double(dot(up, up)));
    return ljus_test::to_double(dot(Exact3(p) - Exact3(q.corner), up)) / length;
}
template <typename T>
double height(const SphereT<T>& s, const Vec3T<T>& p) {
    const Exact3 way = Exact3(p) - Exact3(s.center);
    const Exact r(s.radius);
    return ljus_test::to_double(dot(way, way) - r * r) / (2 * double(s.radius));
}

template <typename T>
Vec3T<double> true_normal(const SphereT<T>& s, const Vec3T<T>& p) {
    return glm::normalize(Vec3T<double>(p) - Vec3T<double>(s.center));
}
template <typename Flat, typename T>
Vec3T<double> true_normal(const Flat& flat, const Vec3T<T>&) {
    return glm::normalize(Vec3T<double>(detail::cross_of_edges(flat)));
}

/// The coordinates that a point of the shape is computed from.
template <typename T>
double extent(const SphereT<T>& s) {
    return double(max_component(glm::abs(s.center)) + s.radius);
}
template <typename T>
double extent(const TriangleT<T>& t) {
    return double(max_component(
        glm::max(glm::abs(t.v1), glm::max(glm::abs(t.v2), glm::abs(t.v3)))));
}
template <typename T>
double extent(const QuadT<T>& q) {
    return double(
        max_component(glm::abs(q.corner) + glm::abs(q.edge_u) + glm::abs(q.edge_v)));
}

template <typename T>
struct Made {
    SphereT<T> sphere;
    TriangleT<T> triangle;
    QuadT<T> quad;
    Vec3T<T> target; ///< A point of each, nearly.
    double size;
};

/// Shapes of a size at an offset; every fourth along the axes, every third through 0.
template <typename T>
Made<T> make(Numbers& n, int i, double size, double offset) {
    using V = Vec3T<double>;
    const V center = i % 3 ? offset * n.point(1) : V{0};
    V a = n.direction(), b = glm::normalize(glm::cross(a, n.direction()));
    if (i % 4 == 0) a = V{0, 0, n.sign()}, b = V{n.sign(), 0, 0};
    const V e1 = size * a, e2 = size * (0.3 * a + n.between(0.1, 1) * b);
    const V corner = center - n.next() * e1 - n.next() * e2;
    Made<T> made;
    made.size = size;
    made.sphere = {Vec3T<T>(center + size * a), static_cast<T>(size)};
    made.quad = {Vec3T<T>(corner), Vec3T<T>(e1), Vec3T<T>(e2)};
    made.triangle = {Vec3T<T>(corner), Vec3T<T>(corner + 2.0 * e1),
                     Vec3T<T>(corner + 2.0 * e2)};
    made.target = Vec3T<T>(center);
    return made;
}

struct Tally {
    long cases = 0, wrong_side = 0, on_surface = 0, layers = 0, through_layer = 0;
    long outside_bound = 0, again = 0;
};

enum class From { hit, area, lamp };

template <typename T, typename Shape>
void leave_it(Tally& tally, Numbers& n, const Made<T>& made, const Shape& shape,
              From from) {
    using V = Vec3T<double>;
    SurfacePointT<T> point;
    if (from == From::hit) {
        const V origin = V(made.target) + made.size * n.power(-1, 2) * n.direction();
        RayT<T> ray{.origin = Vec3T<T>(origin)};
        ray.direction = made.target - ray.origin;
        if (glm::dot(ray.direction, ray.direction) > 0)
            ray.direction = glm::normalize(ray.direction);
        const auto hit = intersect(ray, shape);
        if (!hit) return;
        point = surface_point(shape, ray, as_hit(*hit));
    } else if (from == From::area) {
        point = sample_area(shape, n.square<T>());
    } else {
        const V observer = V(made.target) + made.size * n.power(0, 2) * n.direction();
        point = sample_towards(shape, Vec3T<T>(observer), n.square<T>()).point;
    }
    const V up = true_normal(shape, point.position);

    // The error bound: does the surface pass within it?
    const V err(point.error);
    ++tally.cases;
    tally.outside_bound += std::abs(height(shape, point.position)) >
                           glm::dot(glm::abs(up), err) * (1 + 1e-5);

    for (const double side : {1.0, -1.0}) {
        // From upright to grazing; a rounded point of a small
        // sphere has another normal.
        const double cosine = n.power(-4, 0);
        const double ulp = double(std::numeric_limits<T>::epsilon());
        if (cosine < 4 * ulp * extent(shape) / made.size) continue;
        const V along = glm::normalize(glm::cross(up, n.direction()));
        const Vec3T<T> direction(side * cosine * up + along);
        const Vec3T<T> start = offset_ray_origin(point, direction);
        const double h = height(shape, start);
        tally.on_surface += h == 0;
        tally.wrong_side += h * side < 0;

        // Float must be able to tell the layer from the surface.
        if (1e-3 * made.size > 40 * ulp * extent(shape)) {
            ++tally.layers;
            tally.through_layer += std::abs(h) >= 1e-3 * made.size;
        }

        // It does not meet where it came from.
        const auto hit =
            intersect(RayT<T>{.origin = start, .direction = direction}, shape);
        if (!hit) continue;
        const bool inside = std::is_same_v<Shape, SphereT<T>> && side < 0;
        const double chord = 2 * made.size * cosine; // within the sphere
        if (!inside || double(as_hit(*hit).t) < 0.2 * chord) ++tally.again;
    }
}

void print(const std::string& name, const Tally& t) {
    std::printf("%-26s %7ld %7ld %7ld %7ld %7ld %7ld %7ld\n", name.c_str(), t.cases,
                t.outside_bound, t.wrong_side, t.on_surface, t.again, t.layers,
                t.through_layer);
}

} // namespace

TEST_CASE_TEMPLATE("surface: a ray leaves on its side, and not through a thin layer", T,
                   float, double) {
    std::printf("\n%-26s %7s %7s %7s %7s %7s %7s %7s\n",
                sizeof(T) == 4 ? "float" : "double", "points", "unbound", "wrong", "on",
                "again", "layers", "through");
    for (const From from : {From::hit, From::area, From::lamp}) {
        Tally spheres, triangles, quads;
        Numbers n;
        for (int i = 0; i < 1500; ++i)
            for (const double offset : {0.0, 1.0, 1e3, 1e6}) {
                const double size = n.power(-6, 6);
                // What no number of this precision can tell from a point is no shape.
                const double ulp = double(std::numeric_limits<T>::epsilon());
                if (size < 100 * ulp * offset) continue;
                const Made<T> made = make<T>(n, i, size, offset);
                leave_it(spheres, n, made, made.sphere, from);
                leave_it(triangles, n, made, made.triangle, from);
                leave_it(quads, n, made, made.quad, from);
            }
        const char* names[] = {"hit", "area", "lamp"};
        const std::string name = names[static_cast<int>(from)];
        print("sphere, " + name, spheres);
        print("triangle, " + name, triangles);
        print("quad, " + name, quads);
        for (const Tally& tally : {spheres, triangles, quads}) {
            CHECK(tally.cases > 1000);
            CHECK(tally.outside_bound == 0);
            CHECK(tally.wrong_side == 0);
            CHECK(tally.on_surface == 0);
            CHECK(tally.again == 0);
            CHECK(tally.layers > 1000);
            CHECK(tally.through_layer == 0);
        }
    }
}
