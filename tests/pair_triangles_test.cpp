#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "ljus/geometry/detail/pair_triangles.hpp"
#include "ljus/math/random.hpp"

using namespace ljus;

namespace {

using Triples = std::vector<std::array<std::uint32_t, 3>>;

const std::vector<glm::dvec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};

detail::FlatShapesT<float> shapes(const std::vector<glm::dvec3>& vertices,
                                  const Triples& indices) {
    return detail::pair_triangles<float>(vertices, indices);
}

} // namespace

TEST_CASE("pair_triangles: a square is found however its triangles begin") {
    const std::array<std::array<std::uint32_t, 3>, 2> halves{{{0, 1, 2}, {0, 2, 3}}};
    for (std::uint32_t i = 0; i < 3; ++i)
        for (std::uint32_t j = 0; j < 3; ++j)
            for (const bool swapped : {false, true}) {
                Triples triples;
                for (const auto& [half, turn] : {std::pair{0u, i}, std::pair{1u, j}})
                    triples.push_back({halves[half][turn], halves[half][(turn + 1) % 3],
                                       halves[half][(turn + 2) % 3]});
                if (swapped) std::swap(triples[0], triples[1]);
                const auto found = shapes(square, triples);
                REQUIRE(found.quads.size() == 1);
                CHECK(found.triangles.empty());
                CHECK(normal(found.quads[0]) == Vec3{0, 0, 1});
                CHECK(area(found.quads[0]) == 1.0f);
                // The middle is the middle, so that the quad covers the square.
                CHECK(point_at(found.quads[0], 0.5f, 0.5f).position ==
                      Vec3{0.5f, 0.5f, 0});
            }
}

TEST_CASE("pair_triangles: vertices that are listed twice are the same") {
    const auto found =
        shapes({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {1, 1, 0}, {0, 1, 0}},
               {{0, 1, 2}, {3, 4, 5}});
    CHECK(found.quads.size() == 1);
    CHECK(found.triangles.empty());
}

TEST_CASE("pair_triangles: what is not one parallelogram stays two triangles") {
    SUBCASE("a kite") {
        const auto found = shapes({{0, 0, 0}, {1, 0, 0}, {1.001, 1, 0}, {0, 1, 0}},
                                  {{0, 1, 2}, {0, 2, 3}});
        CHECK(found.quads.empty());
        CHECK(found.triangles.size() == 2);
    }
    SUBCASE("folded along the diagonal") {
        const auto found = shapes({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 1e-9}},
                                  {{0, 1, 2}, {0, 2, 3}});
        CHECK(found.quads.empty());
    }
    SUBCASE("of opposite sides: one would emit up, the other down") {
        CHECK(shapes(square, {{0, 1, 2}, {0, 3, 2}}).quads.empty());
    }
    SUBCASE("the same triangle twice") {
        CHECK(shapes(square, {{0, 1, 2}, {0, 1, 2}}).triangles.size() == 2);
    }
    SUBCASE("one triangle, and none") {
        CHECK(shapes(square, {{0, 1, 2}}).triangles.size() == 1);
        CHECK(shapes(square, {}).triangles.empty());
    }
}

TEST_CASE("pair_triangles: decimals that are rounded are still a parallelogram") {
    // 0.1 + 0.2 is not 0.3 in double.
    const auto found =
        shapes({{0.1, 0, 0}, {0.3, 0, 0.1}, {0.4, 0.7, 0.2}, {0.2, 0.7, 0.1}},
               {{0, 1, 2}, {0, 2, 3}});
    CHECK(found.quads.size() == 1);
}

TEST_CASE("pair_triangles: every triangle is used once, and the area is kept") {
    // A grid of 5 x 4 squares, skewed, each cut along one diagonal or the other.
    std::vector<glm::dvec3> vertices;
    for (int y = 0; y <= 4; ++y)
        for (int x = 0; x <= 5; ++x) vertices.push_back({x + 0.25 * y, y, 0.5 * x});
    Triples triples;
    for (std::uint32_t y = 0; y < 4; ++y)
        for (std::uint32_t x = 0; x < 5; ++x) {
            const std::uint32_t a = y * 6 + x;
            if ((x + y) % 2 == 0) {
                triples.push_back({a, a + 1, a + 7});
                triples.push_back({a, a + 7, a + 6});
            } else {
                triples.push_back({a, a + 1, a + 6});
                triples.push_back({a + 1, a + 7, a + 6});
            }
        }
    const auto found = shapes(vertices, triples);
    CHECK(2 * found.quads.size() + found.triangles.size() == triples.size());
    CHECK(found.quads.size() >= 10);
    double sum = 0;
    for (const Quad& quad : found.quads) {
        sum += double(area(quad));
        CHECK(glm::dot(normal(quad), normal(found.quads[0])) == doctest::Approx(1));
    }
    for (const Triangle& triangle : found.triangles) sum += double(area(triangle));
    const double one = glm::length(glm::cross(glm::dvec3{1, 0, 0.5}, {0.25, 1, 0}));
    CHECK(sum == doctest::Approx(20 * one));
}

TEST_CASE("pair_triangles: points that differ in one coordinate are two") {
    for (int axis = 0; axis < 3; ++axis) {
        // The halves of a square, in the plane across the axis, one of them lifted.
        const auto at = [&](double u, double v, double height) {
            glm::dvec3 point;
            point[axis] = height;
            point[(axis + 1) % 3] = u;
            point[(axis + 2) % 3] = v;
            return point;
        };
        for (const double lift : {0.0, 1.0}) {
            const auto found = shapes({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0),
                                       at(0, 0, lift), at(1, 1, lift), at(0, 1, lift)},
                                      {{0, 1, 2}, {3, 4, 5}});
            CHECK(found.quads.size() == (lift == 0 ? 1 : 0));
            CHECK(found.triangles.size() == (lift == 0 ? 0 : 2));
            // Only where it should touch the other one.
            CHECK(shapes({at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 0, lift),
                          at(1, 1, lift), at(0, 1, 0)},
                         {{0, 1, 2}, {3, 4, 5}})
                      .quads.size() == (lift == 0 ? 1 : 0));
        }
    }
}

TEST_CASE("pair_triangles: one that has its partner does not stand in another's way") {
    // At the edge from a to b stand two triangles; the second of them is half of a
    // square already when the partner of the first one comes.
    const glm::dvec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{0, 0, 1}, e{1, 0, 1},
        f{1, -1, 0};
    const auto found =
        shapes({a, b, c, d, e, f}, {{0, 1, 2}, {3, 1, 4}, {0, 1, 3}, {1, 0, 5}});
    CHECK(found.quads.size() == 2);
    CHECK(found.triangles.empty());
}

TEST_CASE("pair_triangles: one that has its partner is not taken once more") {
    // Of a strip, whose every two neighbours are a parallelogram, the first three; the
    // middle one comes first.
    const auto found = shapes({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {2, 1, 0}},
                              {{0, 1, 3}, {0, 3, 2}, {1, 4, 3}});
    CHECK(found.quads.size() == 1);
    CHECK(found.triangles.size() == 1);
}

TEST_CASE("pair_triangles: how far a corner may be off grows with the coordinates") {
    // Sums of decimals, far from 0: off by a unit in the last place of 1e6.
    const std::vector<glm::dvec3> far{
        {1e6 + 0.1, 7, 0}, {1e6 + 0.4, 7, 0}, {1e6 + 0.6, 9, 0}, {1e6 + 0.3, 9, 0}};
    const glm::dvec3 gap = (far[0] - far[1]) + (far[2] - far[3]);
    REQUIRE(gap.x != 0); // so that it says something
    CHECK(shapes(far, {{0, 1, 2}, {0, 2, 3}}).quads.size() == 1);
    // A kite as small as a roundoff is a kite.
    const double small = 1e-15;
    CHECK(shapes({{0, 0, 0}, {small, 0, 0}, {1.1 * small, small, 0}, {0, small, 0}},
                 {{0, 1, 2}, {0, 2, 3}})
              .quads.empty());
    CHECK(shapes({{0, 0, 0}, {small, 0, 0}, {small, small, 0}, {0, small, 0}},
                 {{0, 1, 2}, {0, 2, 3}})
              .quads.size() == 1);
}

TEST_CASE("pair_triangles: equal points are found as by comparing each with each") {
    const auto check = [](auto zero) {
        using T = decltype(zero);
        RandomStream stream = random_stream(3, Pass::user, 0, 0);
        for (const int count : {0, 1, 2, 300}) {
            std::vector<Vec3T<T>> points;
            for (int i = 0; i < count; ++i) {
                Vec3T<T> point;
                for (int axis = 0; axis < 3; ++axis) // -2, ..., 2, and both zeros
                    point[axis] = std::trunc(5 * next_1d<T>(stream) - T(2.5));
                points.push_back(point);
            }
            const auto first = detail::first_equal_points(points);
            REQUIRE(first.size() == points.size());
            for (std::size_t i = 0; i < points.size(); ++i)
                CHECK(first[i] ==
                      std::uint32_t(std::find(points.begin(), points.end(), points[i]) -
                                    points.begin()));
        }
    };
    check(0.0f);
    check(0.0);
}
