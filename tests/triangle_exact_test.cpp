// needs: boost
// concept: triangle
/// \file triangle_exact_test.cpp
/// \brief The ray-triangle intersection against exact integers, family by family.
///
/// By Cramer's rule u, v and t are quotients of volumes; with integers, the signs of
/// the volumes decide without rounding. A case is *firm* when every input moved by up
/// to 8 units of roundoff still gives the same decision, and a *tie* when the line
/// meets an edge exactly; between (*hard*) only exact or wider arithmetic is right.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/geometry/watertight.hpp"
#include "support/exact.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Exact;
using ljus_test::Integer;
using ljus_test::Integer3;
using ljus_test::Numbers;

namespace {

struct Truth {
    bool hit = false;
    bool firm = false;
    bool far = false; ///< t is not all rounding.
    bool tie = false; ///< Exactly on an edge: closed shapes are hit there.
    Exact t = 0;
};

/// A vector on the grid, and how much larger than its own size
/// what it was rounded from.
struct Known3 {
    Integer3 value, from;
};

/// The volume of three vectors, and by how much it changes when all that they were made
/// of moves by up to 8 units of roundoff; both times 2^(3 bits), bits for 8 units.
struct Volume {
    Integer value, slack;
    Volume(const Known3& a, const Known3& b, const Known3& c, int bits, int side = 1)
        : value(side * ljus_test::triple(a.value, b.value, c.value) << 3 * bits) {
        const auto moved = [bits](const Known3& x) {
            return (ljus_test::abs(x.value) << bits) + x.from;
        };
        const auto size = [](const Known3& x) { return ljus_test::abs(x.value); };
        slack = ljus_test::triple_size(moved(a), moved(b), moved(c)) -
                (ljus_test::triple_size(size(a), size(b), size(c)) << 3 * bits);
    }
};

template <typename T>
std::array<Vec3T<T>, 3> parts(const TriangleT<T>& t) {
    return {t.v1, t.v2, t.v3};
}
template <typename T>
std::array<Vec3T<T>, 3> parts(const QuadT<T>& q) {
    return {q.corner, q.edge_u, q.edge_v};
}

/// O + tD = V1 + uE1 + vE2 by Cramer's rule in integers; t >= 0 counts.
template <typename T, typename Shape>
Truth exact(const RayT<T>& ray, const Shape& shape) {
    constexpr bool is_triangle = std::is_same_v<Shape, TriangleT<T>>;
    const auto three = parts(shape);
    int length = ljus_test::grid_exponent(ray.origin);
    for (const auto& part : three)
        length = std::min(length, ljus_test::grid_exponent(part));
    const int slope = ljus_test::grid_exponent(ray.direction);
    const auto at = [length](const Vec3T<T>& v) {
        const Integer3 value = ljus_test::on_grid(v, length);
        return Known3{value, ljus_test::abs(value)};
    };
    const auto minus = [](const Known3& a, const Known3& b) {
        return Known3{a.value - b.value, a.from + b.from};
    };
    const Integer3 way = ljus_test::on_grid(ray.direction, slope);
    const Known3 d{way, ljus_test::abs(way)}, o = at(ray.origin), v1 = at(three[0]),
                                              v2 = at(three[1]), v3 = at(three[2]),
                                              to = minus(o, v1);
    const Known3 e1 = is_triangle ? minus(v2, v1) : v2;
    const Known3 e2 = is_triangle ? minus(v3, v1) : v3;
    const int bits = std::numeric_limits<T>::digits - 3;

    // Numerators of u, v, t and the rest, over a determinant that is not negative.
    const int side = ljus_test::triple(d.value, e1.value, e2.value) > 0 ? -1 : 1;
    const Volume size(d, e1, e2, bits, -side), u(d, to, e2, bits, -side),
        v(d, e1, to, bits, -side), t(to, e1, e2, bits, side);
    std::vector<Integer> conditions{u.value, v.value, t.value};
    std::vector<Integer> slacks{u.slack, v.slack, t.slack};
    if constexpr (is_triangle) {
        conditions.push_back(size.value - u.value - v.value);
        slacks.push_back(Volume(d, minus(o, v2), minus(v3, v2), bits).slack);
    } else {
        conditions.insert(conditions.end(),
                          {size.value - u.value, size.value - v.value});
        slacks.insert(slacks.end(), {size.slack + u.slack, size.slack + v.slack});
    }

    Truth truth;
    truth.hit = size.value != 0;
    for (const Integer& x : conditions) truth.hit = truth.hit && x >= 0;
    if (truth.hit)
        truth.t = Exact(t.value, size.value) * ljus_test::power_of_two(length - slope);
    // Further than float reaches is no hit.
    if (truth.t > Exact(std::numeric_limits<T>::max())) truth.hit = false;

    bool all = true, none = false;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        all = all && conditions[i] > slacks[i];
        none = none || conditions[i] < -slacks[i];
        truth.tie = truth.tie || (truth.hit && conditions[i] == 0);
    }
    truth.far = t.value > t.slack;
    truth.firm = size.value > size.slack && (truth.hit ? all : none);
    return truth;
}

/// Up to `last_ordinary` directions are of unit length.
enum Family : std::size_t {
    ordinary,
    small,
    far_away,
    very_far,
    huge,
    offset,
    sliver,
    edge,
    vertex,
    border,
    grazing,
    in_plane,
    on_surface,
    last_ordinary = on_surface,
    any_length,
    tiny,
    denormal,
    large,
    degenerate,
    family_count
};
const std::array<const char*, family_count> family_names{
    "ordinary: 1 to 30 sizes away",
    "size 1e-6 to 1e-2",
    "1e2 to 1e6 sizes away",
    "1e6 to 1e8 sizes away",
    "size 1e4 to 1e8, seen from near",
    "all moved by 1e6",
    "sliver: 1 to 1e-6",
    "aimed at an edge",
    "aimed at a vertex",
    "along an axis, an edge by 40 ulp",
    "nearly parallel: 1e-7 to 1e-2",
    "in the plane, rounded",
    "origin on the surface, rounded",
    "|D| = 1e-10 to 1e10",
    "size 1e-15",
    "denormal size",
    "size 1e15",
    "no area"};

/// Of the families up to `last_ordinary`, those whose triangles are neither thin as
/// 1e-6 nor 1e4 times as large as their distance: there all digits of t may cancel.
constexpr bool is_of_ordinary_size(std::size_t family) {
    return family <= last_ordinary && family != sliver && family != huge;
}

constexpr int cases_a_family = 4000;

template <typename T>
struct Case {
    RayT<T> ray;
    TriangleT<T> triangle;
};

template <typename T>
Case<T> make_case(std::size_t family, int i, Numbers& n) {
    using V = Vec3T<double>;
    double size = n.power(-1, 1), distance = n.power(0, 1.5), length = 1;
    V center = n.point(5);
    V a = n.direction(), b = n.direction(), c = n.direction();
    double u = n.between(-0.2, 1), v = n.between(-0.2, 1 - u);
    V way = n.direction();
    switch (family) {
    case small:
        size = n.power(-6, -2), center *= size;
        break;
    case tiny:
        size = 1e-15, center *= size;
        break;
    case far_away:
        distance = n.power(2, 6), center *= size;
        break;
    case very_far:
        distance = n.power(6, 8), center *= size;
        break;
    case huge:
        size = n.power(4, 8), center *= size;
        distance = n.power(0, 2) / size;
        break;
    case denormal: // for double data an ordinary size
        size = 1.4e-45 * n.power(1, 6), center *= size;
        break;
    case offset:
        center = V{1e6, -1e6, 1e6 * n.next()};
        size = n.power(0, 4);
        break;
    case sliver:
        c = b + n.power(-6, 0) * c;
        break;
    case edge:
        if (i % 3 == 0) u = 0, v = n.next();
        if (i % 3 == 1) v = 0, u = n.next();
        if (i % 3 == 2) u = n.next(), v = 1 - u;
        break;
    case vertex:
        u = i % 3 == 1, v = i % 3 == 2;
        break;
    case on_surface:
        distance = 0;
        break;
    case any_length:
        length = n.power(-10, 10);
        break;
    case large:
        size = 1e15, center *= size;
        break;
    default:
        break;
    }
    const V v1 = center + size * a, v2 = center + size * b, v3 = center + size * c;
    const V target = v1 + u * (v2 - v1) + v * (v3 - v1);
    const V n_plane = glm::cross(v2 - v1, v3 - v1);
    if (family == grazing || family == in_plane) {
        const double lean = family == grazing ? n.sign() * n.power(-7, -2) : 0;
        const V along =
            glm::normalize(n.between(-1, 1) * (v2 - v1) + n.next() * (v3 - v1));
        way = glm::normalize(along + lean * glm::normalize(n_plane));
    }
    Case<T> made;
    if (family == border) {
        // In a plane across the axis; the line through a point of the edge along y.
        const auto at = [&](double x, double y) {
            return Vec3T<T>{T(center.x + size * x), T(center.y + size * y),
                            T(center.z)};
        };
        made.triangle = {at(0, 0), at(1, n.between(-0.2, 0.2)), at(0, 1)};
        made.ray = {.origin = at(0, n.next()), .direction = {0, 0, 1}};
        made.ray.origin.z = static_cast<T>(center.z - size * distance);
        T& x = made.ray.origin.x;
        for (int k = 40; k < i % 81; ++k) x = std::nextafter(x, T(100));
        for (int k = i % 81; k < 40; ++k) x = std::nextafter(x, T(-100));
        if (i % 2) { // along another axis
            for (Vec3T<T>* p : {&made.triangle.v1, &made.triangle.v2, &made.triangle.v3,
                                &made.ray.origin, &made.ray.direction})
                *p = {p->z, p->x, p->y};
        }
        return made;
    }
    made.triangle = {Vec3T<T>(v1), Vec3T<T>(v2), Vec3T<T>(v3)};
    if (family == degenerate) {
        if (i % 3 == 0) made.triangle.v3 = made.triangle.v1;
        if (i % 3 == 1) made.triangle.v3 = made.triangle.v2;
        if (i % 3 == 2)
            made.triangle.v3 =
                T(3) * (made.triangle.v2 =
                            T(2) * (made.triangle.v1 = Vec3T<T>(
                                        n.below(99), n.below(99), n.below(99))));
    }
    const V origin = target + way * (size * distance * (i % 17 == 0 ? -1 : 1));
    made.ray.origin = Vec3T<T>(origin);
    V direction = -way;
    // An edge or a vertex is aimed at from where the ray really starts.
    if (family == edge || family == vertex || family == degenerate)
        direction = glm::normalize(target - V(made.ray.origin));
    made.ray.direction = Vec3T<T>(direction * length);
    if (family == vertex && i % 2) // exactly, if the difference is a float
        made.ray.direction = (u > 0   ? made.triangle.v2
                              : v > 0 ? made.triangle.v3
                                      : made.triangle.v1) -
                             made.ray.origin;
    return made;
}

struct Tally {
    int firm = 0, firm_wrong = 0, hard = 0, hard_wrong = 0, ties = 0, tie_lost = 0,
        hits = 0, within_1 = 0, within_4 = 0;
    double worst = 0;
    void add(const Tally& o) {
        firm += o.firm, firm_wrong += o.firm_wrong, hard += o.hard;
        hard_wrong += o.hard_wrong, hits += o.hits, ties += o.ties,
            tie_lost += o.tie_lost, within_1 += o.within_1, within_4 += o.within_4;
        worst = std::max(worst, o.worst);
    }
};

void print(const char* name, const Tally& y) {
    std::printf("%-34s %6d %6d %6d %6d %6d %6d %6d %7d %7d %9.3g\n", name, y.firm,
                y.firm_wrong, y.hard, y.hard_wrong, y.ties, y.tie_lost, y.hits,
                y.within_1, y.within_4, y.worst);
}

/// The shapes of a case: the triangle, or the quad on its first two edges.
template <typename Shape, typename T>
Shape shape_of(const TriangleT<T>& t) {
    if constexpr (std::is_same_v<Shape, TriangleT<T>>)
        return t;
    else
        return {t.v1, t.v2 - t.v1, t.v3 - t.v1};
}

/// All cases of all families with their truths, made once.
template <typename Shape>
struct Known {
    RayT<decltype(area(Shape{}))> ray;
    Shape shape;
    Truth truth;
};
template <typename Shape>
const std::array<std::vector<Known<Shape>>, family_count>& all_cases() {
    using T = decltype(area(Shape{}));
    static const auto cases = [] {
        std::array<std::vector<Known<Shape>>, family_count> result;
        for (std::size_t family = 0; family < family_count; ++family) {
            Numbers numbers{family + 1};
            for (int i = 0; i < cases_a_family; ++i) {
                const Case<T> made = make_case<T>(family, i, numbers);
                const Shape shape = shape_of<Shape>(made.triangle);
                result[family].push_back({made.ray, shape, exact(made.ray, shape)});
            }
        }
        return result;
    }();
    return cases;
}

template <typename Shape, typename Intersect>
std::array<Tally, family_count> run(const char* title, Intersect intersect) {
    std::printf("\n%s\n%-34s %6s %6s %6s %6s %6s %6s %6s %7s %7s %9s\n", title,
                "family", "firm", "wrong", "hard", "wrong", "ties", "lost", "hits",
                "1 ulp", "4 ulp", "worst t");
    std::array<Tally, family_count> tallies{};
    Tally total;
    for (std::size_t family = 0; family < family_count; ++family) {
        Tally& tally = tallies[family];
        for (const auto& [ray, shape, truth] : all_cases<Shape>()[family]) {
            const auto hit = intersect(ray, shape);
            const bool wrong = hit.has_value() != truth.hit;
            (truth.firm ? tally.firm : truth.tie ? tally.ties : tally.hard) += 1;
            if (wrong)
                (truth.firm  ? tally.firm_wrong
                 : truth.tie ? tally.tie_lost
                             : tally.hard_wrong) += 1;
            if (!hit || !truth.hit || !truth.far) continue;
            const double error = ljus_test::ulps(hit->t, truth.t);
            ++tally.hits;
            tally.within_1 += error <= 1;
            tally.within_4 += error <= 4;
            tally.worst = std::max(tally.worst, error);
        }
        print(family_names[family], tally);
        total.add(tally);
        if (family == last_ordinary) print("any size, unit D (all above)", total);
    }
    print("all", total);
    return tallies;
}

} // namespace

TEST_CASE_TEMPLATE("triangle: float data in double: all right, t within 1 ulp", S,
                   Triangle, Quad) {
    // The ties too, for the border is as wide as the rounding.
    const auto tallies =
        run<S>("float data, computed in double", [](const Ray& ray, const S& shape) {
            return intersect<double>(ray, shape);
        });
    for (std::size_t family = 0; family < family_count; ++family) {
        INFO(std::string(family_names[family]));
        CHECK(tallies[family].firm_wrong == 0);
        CHECK(tallies[family].hard_wrong == 0);
        CHECK(tallies[family].tie_lost == 0);
        CHECK(tallies[family].within_1 == tallies[family].hits);
    }
}

TEST_CASE_TEMPLATE("triangle: right where inputs within 8 units of roundoff decide", S,
                   Triangle, Quad, TriangleT<double>) {
    using T = decltype(area(S{}));
    const auto tallies =
        run<S>("in the precision of the data", [](const RayT<T>& ray, const S& shape) {
            return intersect<T>(ray, shape);
        });
    Tally total;
    for (std::size_t family = 0; family <= last_ordinary; ++family) {
        INFO(std::string(family_names[family]));
        CHECK(tallies[family].firm_wrong == 0);
        if (is_of_ordinary_size(family)) total.add(tallies[family]);
    }
    print("ordinary sizes, unit D", total);
    CHECK(total.within_4 >= 0.8 * total.hits);
}

TEST_CASE("triangle: the watertight test, in the products of floats") {
    const auto tallies =
        run<Triangle>("watertight", [](const Ray& ray, const Triangle& triangle) {
            return intersect<Watertight>(ray, triangle);
        });
    Tally total;
    for (std::size_t family = 0; family < family_count; ++family) {
        INFO(std::string(family_names[family]));
        if (family != denormal) CHECK(tallies[family].firm_wrong == 0);
        total.add(tallies[family]);
    }
    CHECK(total.within_4 >= 0.8 * total.hits);
}

TEST_CASE("triangle: in double no ray slips through where two triangles meet") {
    // A fan of eight triangles; rays at its spokes and its hub, from all around.
    Numbers n;
    long leaks = 0, float_leaks = 0, rays = 0;
    for (int fan = 0; fan < 200; ++fan) {
        const Vec3 hub(n.point(5));
        const Vec3T<double> axis = n.direction();
        const auto frame_x = glm::normalize(glm::cross(axis, n.direction()));
        const auto frame_y = glm::cross(axis, frame_x);
        std::array<Vec3, 8> rim;
        for (std::size_t k = 0; k < 8; ++k) {
            const double phi = 0.7853981633974483 * (double(k) + 0.3 * n.next());
            rim[k] = Vec3(Vec3T<double>(hub) +
                          n.between(0.5, 2) *
                              (std::cos(phi) * frame_x + std::sin(phi) * frame_y) +
                          n.between(-0.2, 0.2) * axis);
        }
        for (int i = 0; i < 200; ++i, ++rays) {
            const double along = i % 4 ? n.between(0, 0.9) : 0;
            const auto spoke = Vec3T<double>(rim[static_cast<std::size_t>(i % 8)]);
            const auto target = glm::mix(Vec3T<double>(hub), spoke, along);
            const auto lean = n.between(-1, 1) * frame_x + n.between(-1, 1) * frame_y;
            const Vec3 origin(target + n.power(0, 1.5) * (axis + 0.5 * lean));
            const Ray ray{.origin = origin,
                          .direction = glm::normalize(Vec3(target) - origin)};
            bool hit = false, float_hit = false;
            for (std::size_t k = 0; k < 8; ++k) {
                const Triangle t{hub, rim[k], rim[(k + 1) % 8]};
                hit = hit || intersect<double>(ray, t);
                float_hit = float_hit || intersect<float>(ray, t);
            }
            leaks += !hit;
            float_leaks += !float_hit;
        }
    }
    std::printf("\nleaks of %ld rays: in double %ld, in float %ld\n", rays, leaks,
                float_leaks);
    CHECK(leaks == 0);
    CHECK(float_leaks < rays / 4); // fused multiply-adds make it 12 % instead of 5 %
}
