/// \file form_factor_test.cpp
/// \brief Form factors against tables, quadrature and closed rooms.

#include "ljus/radiosity/exchange_area.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/closed_forms.hpp"
#include "support/numbers.hpp"

using ljus::Facet;
using ljus_test::Numbers;

namespace {

using V = glm::dvec3;

Facet rectangle(const V& corner, const V& u, const V& v) {
    return {{corner, corner + u, corner + u + v, corner + v}, 4};
}

/// The definition: cos cos / (pi r^2) over both areas, by Gauss's rule of 5 points in
/// each of the four coordinates, on n x n pieces of each rectangle.
double quadrature(const Facet& a, const Facet& b, int n) {
    constexpr std::array place{0.04691007703066802, 0.23076534494715845, 0.5,
                               0.7692346550528415, 0.953089922969332};
    constexpr std::array weight{0.11846344252809454, 0.23931433524968324,
                                0.28444444444444444, 0.23931433524968324,
                                0.11846344252809454};
    struct Node {
        V at;
        double weight;
    };
    const auto nodes = [&](const Facet& f) {
        std::vector<Node> all;
        const V u = f.corners[1] - f.corners[0], v = f.corners[3] - f.corners[0];
        for (int i = 0; i < 5 * n; ++i)
            for (int k = 0; k < 5 * n; ++k) {
                const auto p = std::size_t(i % 5), q = std::size_t(k % 5);
                const double x = (i / 5 + place[p]) / n, y = (k / 5 + place[q]) / n;
                all.push_back(
                    {f.corners[0] + x * u + y * v, weight[p] * weight[q] / (n * n)});
            }
        return all;
    };
    const V na = ljus::detail::area_vector(a), nb = ljus::detail::area_vector(b);
    double sum = 0;
    for (const Node& p : nodes(a))
        for (const Node& q : nodes(b)) {
            const V way = q.at - p.at;
            const double r2 = glm::dot(way, way);
            const double cosines = -glm::dot(way, na) * glm::dot(way, nb);
            sum += p.weight * q.weight * cosines / (std::numbers::pi * r2 * r2);
        }
    return sum;
}

/// The four sides of a tetrahedron, facing inwards.
std::vector<Facet> tetrahedron(std::array<V, 4> p) {
    if (glm::dot(glm::cross(p[1] - p[0], p[2] - p[0]), p[3] - p[0]) < 0)
        std::swap(p[0], p[1]);
    return {{{p[0], p[1], p[2]}, 3},
            {{p[0], p[2], p[3]}, 3},
            {{p[0], p[3], p[1]}, 3},
            {{p[1], p[3], p[2]}, 3}};
}

} // namespace

TEST_CASE("form_factor: unit squares, as every table has them") {
    CHECK(std::abs(ljus_test::form_factor_facing(1, 1, 1) - 0.1998248957) < 1e-10);
    CHECK(std::abs(ljus::form_factor_corner(1, 1, 1) - 0.2000437761) < 1e-10);
    // A floor and the five other faces of a cube.
    CHECK(ljus_test::form_factor_facing(1, 1, 1) +
              4 * ljus::form_factor_corner(1, 1, 1) ==
          doctest::Approx(1).epsilon(1e-14));
    // Very near to each other all of the light arrives, very far almost none.
    CHECK(ljus_test::form_factor_facing(1e6, 1e6, 1) > 1 - 1e-5);
    CHECK(ljus_test::form_factor_facing(1, 1, 100) * std::numbers::pi * 1e4 ==
          doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("exchange_area: rectangles that face each other or stand on each other") {
    for (const double a : {0.3, 1.0, 4.0})
        for (const double b : {0.5, 1.0, 7.0})
            for (const double c : {0.2, 1.0, 3.0}) {
                const Facet floor = rectangle({}, {a, 0, 0}, {0, b, 0});
                const Facet roof = rectangle({0, 0, c}, {0, b, 0}, {a, 0, 0});
                const Facet wall = rectangle({}, {0, b, 0}, {0, 0, c});
                CHECK(exchange_area(floor, roof) ==
                      doctest::Approx(a * b * ljus_test::form_factor_facing(a, b, c))
                          .epsilon(1e-11));
                CHECK(exchange_area(floor, wall) ==
                      doctest::Approx(a * b * ljus::form_factor_corner(b, a, c))
                          .epsilon(1e-12));
                // From behind nothing arrives.
                CHECK(exchange_area(ljus::detail::turned(floor), wall) == 0);
                CHECK(exchange_area(floor, ljus::detail::turned(roof)) == 0);
            }
}

TEST_CASE("exchange_area: quads anywhere, by the definition") {
    Numbers numbers;
    for (int i = 0; i < 60; ++i) {
        const V u = numbers.point(1), v = numbers.point(1);
        const V s = numbers.point(1), t = numbers.point(1);
        const Facet a = rectangle(-(u + v) / 2.0, u, v);
        const V up = glm::normalize(ljus::detail::area_vector(a));
        // So far up that all of it is in front; turned so that it faces downwards.
        Facet b = rectangle(4.0 * up + 0.3 * numbers.point(1) - (s + t) / 2.0, s, t);
        if (glm::dot(ljus::detail::area_vector(b), up) > 0) b = ljus::detail::turned(b);
        if (glm::dot(glm::normalize(ljus::detail::area_vector(b)), up) > -0.8) continue;
        const double right = quadrature(a, b, 2);
        CHECK(std::abs(exchange_area(a, b) - right) < 1e-9 * right);
        // An edge of b that is parallel to one of a takes another way.
        const Facet c = rectangle(b.corners[0], v, u);
        CHECK(std::abs(exchange_area(a, c) - quadrature(a, c, 2)) < 1e-9 * right);
    }
}

TEST_CASE("exchange_area: reciprocity, however two triangles lie") {
    Numbers numbers;
    double worst = 0;
    int seen = 0;
    for (int i = 0; i < 400; ++i) {
        const V p = numbers.point(1), q = numbers.point(1);
        const Facet a{{p, p + numbers.point(1), p + numbers.point(1)}, 3};
        Facet b{{q, q + numbers.point(1), q + numbers.point(1)}, 3};
        if (i % 4 == 1) b.corners[0] = a.corners[0];                 // a common corner
        if (i % 4 == 2) b.corners = {a.corners[1], a.corners[0], q}; // a common edge
        if (i % 4 == 3) b.corners[0] = (a.corners[0] + 2.0 * a.corners[1]) / 3.0;
        const double there = exchange_area(a, b), back = exchange_area(b, a);
        worst = std::max(worst, std::abs(there - back));
        seen += there > 0;
        // The parts of a patch receive what the whole does.
        const V middle = (b.corners[0] + b.corners[1]) / 2.0;
        const Facet left{{b.corners[0], middle, b.corners[2]}, 3};
        const Facet right{{middle, b.corners[1], b.corners[2]}, 3};
        CHECK(std::abs(exchange_area(a, left) + exchange_area(a, right) - there) <
              1e-11);
    }
    CHECK(worst < 1e-11);
    CHECK(seen > 200);
    // Along the axes: 1e-12 of the smaller one's area, at any place.
    for (int i = 0; i < 200; ++i) {
        const V p = 3.0 * numbers.point(1);
        const double w = 1 + numbers.between(-1, 1), h = 1 + numbers.between(-1, 1);
        const Facet a = rectangle({}, {1, 0, 0}, {0, 1, 0});
        const Facet b = i % 2 == 0 ? rectangle(p, {0, w, 0}, {h, 0, 0})
                                   : rectangle(p, {0, w, 0}, {0, 0, h});
        CHECK(std::abs(exchange_area(a, b) - exchange_area(b, a)) <=
              1e-12 * std::min(1.0, w * h));
    }
}

TEST_CASE("exchange_area: in a closed room all light arrives somewhere") {
    Numbers numbers;
    for (int i = 0; i < 12; ++i) {
        const auto sides = tetrahedron(
            {numbers.point(1), numbers.point(1), numbers.point(1), numbers.point(1)});
        for (const Facet& from : sides) {
            double sum = 0;
            for (const Facet& to : sides)
                if (&to != &from) sum += exchange_area(from, to);
            CHECK(sum == doctest::Approx(glm::length(ljus::detail::area_vector(from)))
                             .epsilon(1e-10));
        }
    }
}

TEST_CASE("exchange_area: what lies behind a plane is cut off") {
    const Facet floor = rectangle({}, {1, 0, 0}, {0, 1, 0});
    const Facet wall = rectangle({}, {0, 1, 0}, {0, 0, 1});
    const Facet deep = rectangle({0, 0, -2}, {0, 1, 0}, {0, 0, 3});
    CHECK(exchange_area(floor, deep) ==
          doctest::Approx(exchange_area(floor, wall)).epsilon(1e-13));
    // The floor reaches behind the wall; there it sees its back.
    const Facet wide = rectangle({-5, 0, 0}, {6, 0, 0}, {0, 1, 0});
    CHECK(exchange_area(wide, wall) ==
          doctest::Approx(exchange_area(floor, wall)).epsilon(1e-13));
    CHECK(exchange_area(floor, floor) == 0);
    CHECK(exchange_area(floor, rectangle({3, 0, 0}, {1, 0, 0}, {0, 1, 0})) == 0);
}

TEST_CASE("exchange_area: sizes, places and far away") {
    const Facet floor = rectangle({}, {1, 0, 0}, {0, 1, 0});
    const Facet wall = rectangle({}, {0, 1, 0}, {0, 0, 1});
    const double right = exchange_area(floor, wall);
    for (const double size : {1e-60, 1e-6, 1e6, 1e60}) {
        Facet a = floor, b = wall;
        for (V& corner : a.corners) corner *= size;
        for (V& corner : b.corners) corner *= size;
        CHECK(exchange_area(a, b) / size / size ==
              doctest::Approx(right).epsilon(1e-12));
    }
    for (const double d : {10.0, 100.0, 1000.0}) {
        const Facet roof = rectangle({0, 0, d}, {0, 1, 0}, {1, 0, 0});
        // Relative to what there is: doctest's Approx is absolute below 1.
        CHECK(std::abs(exchange_area(floor, roof) / quadrature(floor, roof, 1) - 1) <
              1e-11);
    }
    // No area, no numbers: no light.
    const double nan = std::nan("");
    CHECK(exchange_area(floor, rectangle({}, {}, {0, 0, 1})) == 0);
    CHECK(exchange_area(floor, Facet{}) == 0);
    CHECK(exchange_area(floor, rectangle({nan, 0, 0}, {0, 1, 0}, {0, 0, 1})) == 0);
}

TEST_CASE("exchange_area: edges that are nearly parallel, and edges without a length") {
    // A turn that is small, but far above rounding: to take its edges for parallel ones
    // would be wrong by as much as they are turned.
    const Facet floor = rectangle({}, {1, 0, 0}, {0, 1, 0});
    for (const double turn : {1e-8, 1e-7, 1e-5, 1e-3}) {
        CAPTURE(turn);
        const Facet roof = rectangle({0.3, 0.4, 1.5}, {turn, 1, 2 * turn},
                                     {0.8, -0.8 * turn, 3 * turn});
        CHECK(std::abs(exchange_area(floor, roof) / quadrature(floor, roof, 3) - 1) <
              1e-11);
        CHECK(std::abs(exchange_area(roof, floor) / quadrature(floor, roof, 3) - 1) <
              1e-11);
    }
    // A corner that stands there twice changes nothing, in whichever of the two.
    const Facet wall{{V{0, 0.2, 0}, V{0, 1, 0.1}, V{0, 0.5, 1}}, 3};
    const double right = exchange_area(floor, wall);
    CHECK(right > 0.01);
    for (std::size_t twice = 0; twice < 3; ++twice) {
        Facet other{{}, 4};
        for (std::size_t i = 0, k = 0; i < 3; ++i) {
            other.corners[k++] = wall.corners[i];
            if (i == twice) other.corners[k++] = wall.corners[i];
        }
        CHECK(exchange_area(floor, other) == doctest::Approx(right).epsilon(1e-12));
        CHECK(exchange_area(other, floor) == doctest::Approx(right).epsilon(1e-12));
    }
    // The logarithm's integrals where it has no value: nothing, and no NaN.
    CHECK(ljus::detail::log_once(0, 0, 1) == 0);
    CHECK(ljus::detail::log_twice(0, 0, 1) == 0);
}

TEST_CASE("form_factor: from a point, by Lambert") {
    const V up{0, 0, 1};
    const Facet roof = rectangle({-1, -1, 2}, {0, 2, 0}, {2, 0, 0});
    CHECK(
        form_factor_at({}, up, roof) ==
        doctest::Approx(4 * ljus_test::form_factor_of_corner(1, 1, 2)).epsilon(1e-14));
    CHECK(form_factor_at({}, up, ljus::detail::turned(roof)) == 0);
    CHECK(form_factor_at({}, -up, roof) == 0);
    // A cube around the point, which stands on no wall: below its horizon nothing
    // counts, and above it everything does.
    const std::vector<Facet> cube{
        rectangle({-1, -1, -1}, {2, 0, 0}, {0, 2, 0}),
        rectangle({-1, -1, 1}, {0, 2, 0}, {2, 0, 0}),
        rectangle({-1, -1, -1}, {0, 2, 0}, {0, 0, 2}),
        rectangle({1, -1, -1}, {0, 0, 2}, {0, 2, 0}),
        rectangle({-1, -1, -1}, {0, 0, 2}, {2, 0, 0}),
        rectangle({-1, 1, -1}, {2, 0, 0}, {0, 0, 2}),
    };
    Numbers numbers;
    for (int i = 0; i < 100; ++i) {
        const V point = 0.99 * numbers.point(1);
        const V normal = glm::normalize(numbers.point(1));
        double sum = 0;
        for (const Facet& side : cube) sum += form_factor_at(point, normal, side);
        CHECK(sum == doctest::Approx(1).epsilon(1e-12));
    }
    // Its mean over a patch is the patch's form factor.
    const Facet floor = rectangle({}, {1, 0, 0}, {0, 1, 0});
    const Facet side = rectangle({-0.5, 0, 0.5}, {0, 1, 0}, {0.2, 0, 1});
    double mean = 0;
    for (int i = 0; i < 100; ++i)
        for (int k = 0; k < 100; ++k)
            mean +=
                form_factor_at({(i + 0.5) / 100, (k + 0.5) / 100, 0}, up, side) / 1e4;
    CHECK(mean == doctest::Approx(exchange_area(floor, side)).epsilon(1e-4));
}

TEST_CASE("form_factor: the fast twin agrees with the plain one") {
    for (int i = 0; i <= 100; ++i) {
        const double angle = std::numbers::pi / 3 * i / 100;
        const double ratio = i == 0 ? 1 : angle / std::sin(angle);
        CHECK(ljus::detail::angle_over_sine(std::cos(angle)) ==
              doctest::Approx(ratio).epsilon(1e-9));
    }
    // Near and far, in front and behind, above the horizon and cut by it.
    Numbers numbers;
    int seen = 0;
    for (int i = 0; i < 20'000; ++i) {
        const V u = numbers.point(1), v = numbers.point(1);
        const V corner = numbers.power(-1, 2) * numbers.direction();
        Facet facet = rectangle(corner, u, v);
        if (i % 2 == 0) facet.count = 3;
        const V normal = numbers.direction();
        const double plain = ljus::form_factor_at(V(0), normal, facet);
        seen += plain > 0;
        CHECK(std::abs(ljus::detail::form_factor_fast(V(0), normal, facet) - plain) <
              1e-9);
    }
    CHECK(seen > 3000);
}

TEST_CASE("facet: a plane cuts it into two parts that are all of it") {
    Numbers numbers{7};
    int cut = 0, corners = 0;
    for (int i = 0; i < 2000; ++i) {
        const V p = numbers.point(1), u = numbers.point(1), v = numbers.point(1);
        const Facet whole = i % 2 ? rectangle(p, u, v) : Facet{{p, p + u, p + v}, 3};
        const V at = numbers.point(1), normal = numbers.direction();
        const Facet front = ljus::detail::clipped(whole, at, normal);
        const Facet back = ljus::detail::clipped(whole, at, -normal);
        const V all = ljus::detail::area_vector(whole);
        const V sum =
            ljus::detail::area_vector(front) + ljus::detail::area_vector(back);
        REQUIRE(glm::distance(sum, all) < 1e-12);
        for (int k = 0; k < front.count; ++k) {
            const V corner = front.corners[std::size_t(k)];
            REQUIRE(glm::dot(corner - at, normal) > -1e-12);
            REQUIRE(std::abs(glm::dot(corner - p, all)) < 1e-12); // in its plane
        }
        REQUIRE((front.count == 0 || front.count >= 3));
        cut += front.count > 0 && back.count > 0;
        corners = std::max(corners, front.count);
        const Facet other = ljus::detail::turned(whole);
        REQUIRE(other.count == whole.count);
        REQUIRE(glm::distance(ljus::detail::area_vector(other), -all) < 1e-14);
    }
    CHECK(cut > 500);
    CHECK(corners == 5);
}

TEST_CASE("facet: what only touches the plane is no part, what is near it lies on it") {
    const V up{0, 0, 1};
    const Facet wall = rectangle({0, 0, -1}, {1, 0, 0}, {0, 0, 1}); // its edge at 0
    CHECK(ljus::detail::clipped(wall, {}, up).count == 0);
    CHECK(ljus::detail::clipped(wall, {}, -up).count == 4);
    const Facet tip{{V{0, 0, 0}, V{-1, 0, -1}, V{1, 0, -1}}, 3};
    CHECK(ljus::detail::clipped(tip, {}, up).count == 0);
    CHECK(ljus::detail::area_vector(Facet{{V{0, 0, 0}, V{1, 0, 0}}, 2}) == V{0});
    // An edge that lies 1e-9 beyond: cut off, or taken as it is.
    const Facet low = rectangle({0, 0, -1e-9}, {1, 0, 0}, {0, 0, 1});
    const Facet exact = ljus::detail::clipped(low, {}, up);
    REQUIRE(exact.count == 4);
    const Facet wide = ljus::detail::clipped(low, {}, up, 1e-8);
    REQUIRE(wide.count == 4);
    double least = 1, least_wide = 1;
    for (std::size_t k = 0; k < 4; ++k) {
        least = std::min(least, exact.corners[k].z);
        least_wide = std::min(least_wide, wide.corners[k].z);
    }
    CHECK(std::abs(least) < 1e-20);
    CHECK(least_wide == -1e-9);
    CHECK(ljus::detail::clipped(low, {}, -up, 1e-8).count == 0);
    // Edges that a point sees at more than a right angle: a roof without an end.
    const Facet roof = rectangle({-1e4, -1e4, 1}, {0, 2e4, 0}, {2e4, 0, 0});
    CHECK(form_factor_at({}, up, roof) > 1 - 1e-7);
    CHECK(form_factor_at({}, up, roof) < 1 + 1e-12);
    CHECK(form_factor_at({}, up, Facet{}) == 0);
    // A hexagon of which the horizon cuts one corner: seven corners, as two halves.
    const auto corner = [](int i) {
        const double angle = (i + 0.5) * std::numbers::pi / 3;
        return V{1, -std::cos(angle), std::sin(angle) + 0.7};
    };
    Facet hexagon{{}, 6}, one{{}, 4}, two{{}, 4};
    for (int i = 0; i < 6; ++i) hexagon.corners[std::size_t(i)] = corner(i);
    for (int i = 0; i < 4; ++i) {
        one.corners[std::size_t(i)] = corner(i);
        two.corners[std::size_t(i)] = corner((i + 3) % 6);
    }
    CHECK(ljus::detail::clipped(hexagon, {}, up).count == 7);
    const double halves = form_factor_at({}, up, one) + form_factor_at({}, up, two);
    CHECK(form_factor_at({}, up, hexagon) == doctest::Approx(halves).epsilon(1e-12));
    // In the plane, by rounding every other corner lies below: three stay, six are cut.
    for (int i = 0; i < 6; ++i)
        hexagon.corners[std::size_t(i)] =
            V{corner(i).y, corner(i).z + 3, i % 2 == 0 ? 1e-17 : -1e-17};
    CHECK(ljus::detail::clipped(hexagon, {}, up).count == 9);
    CHECK(form_factor_at({}, up, hexagon) < 1e-12);
}
