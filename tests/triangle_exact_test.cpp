// needs: boost
// concept: triangle
/// \file triangle_exact_test.cpp
/// \brief The ray-triangle intersection against exact fractions, family by family.
///
/// By Cramer's rule u, v and t are quotients of volumes; with fractions, the signs of
/// the volumes decide without rounding. A case is *firm* when every input moved by up to
/// 8 units of roundoff still gives the same decision, and a *tie* when the line meets an
/// edge exactly; between (*hard*) only exact or wider arithmetic is right.

#include <doctest/doctest.h>

#include <array>
#include <cstdio>
#include <optional>
#include <string>
#include <type_traits>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/triangle.hpp"
#include "support/exact.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Exact;
using ljus_test::Exact3;
using ljus_test::Numbers;

namespace {

struct Truth {
    bool hit = false;
    bool firm = false;
    bool far = false; ///< t is not all rounding.
    bool tie = false; ///< Exactly on an edge: closed shapes are hit there.
    Exact t = 0, u = 0, v = 0;
};

/// A flat shape in fractions; `wide` bounds what an edge was rounded from.
struct Corner {
    Exact3 v1, e1, e2, wide1, wide2;
    bool is_triangle;
};
template <typename T>
Corner corner_of(const TriangleT<T>& t) {
    const Exact3 v1(t.v1), v2(t.v2), v3(t.v3);
    return {v1, v2 - v1, v3 - v1, abs(v1) + abs(v2), abs(v1) + abs(v3), true};
}
template <typename T>
Corner corner_of(const QuadT<T>& q) {
    const Exact3 e1(q.edge_u), e2(q.edge_v);
    return {Exact3(q.corner), e1, e2, abs(e1), abs(e2), false};
}

/// O + tD = V1 + uE1 + vE2 by Cramer's rule in fractions; t >= 0 counts.
template <typename T, typename Shape>
Truth exact(const RayT<T>& ray, const Shape& shape) {
    const auto [v1, e1, e2, f1, f2, is_triangle] = corner_of(shape);
    const Exact3 o(ray.origin), d(ray.direction), to = o - v1;
    const Exact det = -triple(d, e1, e2);
    const int side = sign(det);

    // Numerators of u, v, their rest to 1, and t, times the sign of det.
    const Exact u = side * -triple(d, to, e2);
    const Exact v = side * -triple(d, e1, to);
    const Exact t = side * triple(to, e1, e2);
    const Exact size = side * det;
    std::vector<Exact> conditions{u, v, t};
    if (is_triangle)
        conditions.push_back(size - u - v);
    else
        conditions.insert(conditions.end(), {size - u, size - v});

    Truth truth;
    truth.hit = side != 0;
    for (const Exact& x : conditions) truth.hit = truth.hit && x >= 0;
    if (truth.hit) truth = {true, false, false, false, t / size, u / size, v / size};

    // Each of the three factors of a volume moves by up to 8 u of its coordinates.
    const Exact roundoff = Exact(std::numeric_limits<T>::epsilon()) / 2;
    const Exact3 ad = abs(d), fo = abs(o) + abs(v1);
    const auto slack = [&](const Exact3& a, const Exact3& b, const Exact3& c) -> Exact {
        return 24 * roundoff * triple_size(a, b, c);
    };
    const Exact slack_det = slack(ad, f1, f2);
    std::vector<Exact> slacks{slack(ad, fo, f2), slack(ad, f1, fo), slack(fo, f1, f2)};
    if (is_triangle)
        slacks.push_back(slack(ad, fo + f1, fo + f2));
    else
        slacks.insert(slacks.end(), {slack_det + slacks[0], slack_det + slacks[1]});

    bool all = true, none = false;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        all = all && conditions[i] > slacks[i];
        none = none || conditions[i] < -slacks[i];
        truth.tie = truth.tie || (truth.hit && sign(conditions[i]) == 0);
    }
    truth.far = t > slacks[2];
    truth.firm = size > slack_det && (truth.hit ? all : none);
    return truth;
}

enum Family : std::size_t {
    ordinary,
    small,
    tiny,
    far_away,
    offset,
    sliver,
    edge,
    vertex,
    grazing,
    in_plane,
    on_surface,
    any_length,
    large,
    degenerate,
    family_count
};
const std::array<const char*, family_count> family_names{
    "ordinary: 1 to 30 sizes away",
    "size 1e-6 to 1e-2",
    "size 1e-15",
    "1e2 to 1e6 sizes away",
    "all moved by 1e6",
    "sliver: 1 to 1e-6",
    "aimed at an edge",
    "aimed at a vertex",
    "nearly parallel: 1e-7 to 1e-2",
    "in the plane, rounded",
    "origin on the surface, rounded",
    "|D| = 1e-10 to 1e10",
    "size 1e15",
    "no area"};

constexpr int cases_a_family = 1500;

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
        hits = 0, within_1 = 0;
    double worst = 0;
    void add(const Tally& o) {
        firm += o.firm, firm_wrong += o.firm_wrong, hard += o.hard;
        hard_wrong += o.hard_wrong, hits += o.hits, ties += o.ties,
            tie_lost += o.tie_lost, within_1 += o.within_1;
        worst = std::max(worst, o.worst);
    }
};

void print(const char* name, const Tally& y) {
    std::printf("%-34s %6d %6d %6d %6d %6d %6d %6d %7d %9.3g\n", name, y.firm,
                y.firm_wrong, y.hard, y.hard_wrong, y.ties, y.tie_lost, y.hits,
                y.within_1, y.worst);
}

/// The shapes of a case: the triangle, or the quad on its first two edges.
template <typename Shape, typename T>
Shape shape_of(const TriangleT<T>& t) {
    if constexpr (std::is_same_v<Shape, TriangleT<T>>)
        return t;
    else
        return {t.v1, t.v2 - t.v1, t.v3 - t.v1};
}

template <typename Shape, typename Intersect>
std::array<Tally, family_count> run(const char* title, Intersect intersect) {
    using T = decltype(area(Shape{}));
    std::printf("\n%s\n%-34s %6s %6s %6s %6s %6s %6s %6s %7s %9s\n", title, "family",
                "firm", "wrong", "hard", "wrong", "ties", "lost", "hits", "1 ulp",
                "worst t");
    std::array<Tally, family_count> tallies{};
    Tally total;
    for (std::size_t family = 0; family < family_count; ++family) {
        Numbers numbers{family + 1};
        Tally& tally = tallies[family];
        for (int i = 0; i < cases_a_family; ++i) {
            const Case<T> made = make_case<T>(family, i, numbers);
            const Shape shape = shape_of<Shape>(made.triangle);
            const Truth truth = exact(made.ray, shape);
            const std::optional<FlatHitT<T>> hit = intersect(made.ray, shape);
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
            tally.worst = std::max(tally.worst, error);
        }
        print(family_names[family], tally);
        total.add(tally);
    }
    print("all", total);
    return tallies;
}

} // namespace

TEST_CASE_TEMPLATE("triangle: float data in double: all right, t within 1 ulp", S,
                   Triangle, Quad) {
    // A tie has no right answer in floating point: the rounding of two neighbours
    // differs. Only a watertight test can promise more.
    const auto tallies =
        run<S>("float data, computed in double", [](const Ray& ray, const S& shape) {
            return intersect<double>(ray, shape);
        });
    for (std::size_t family = 0; family < family_count; ++family) {
        INFO(std::string(family_names[family]));
        CHECK(tallies[family].firm_wrong == 0);
        CHECK(tallies[family].hard_wrong == 0);
        CHECK(tallies[family].within_1 == tallies[family].hits);
    }
}

TEST_CASE_TEMPLATE("triangle: right where inputs within 8 units of roundoff decide", S,
                   Triangle, Quad, TriangleT<double>) {
    using T = decltype(area(S{}));
    const auto tallies =
        run<S>("in the precision of the data", [](const RayT<T>& ray, const S& shape) {
            return intersect(ray, shape);
        });
    for (std::size_t family = 0; family < family_count; ++family) {
        INFO(std::string(family_names[family]));
        CHECK(tallies[family].firm_wrong == 0);
    }
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
                float_hit = float_hit || intersect(ray, t);
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
