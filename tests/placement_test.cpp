// concept: shape
/// \file placement_test.cpp
/// \brief Placed shapes against rays that are placed the other way.

#include "ljus/geometry/placement.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

/// A point before it was placed: written out for a rotation about y.
glm::dvec3 before(glm::dvec3 p, const PlacementT<double>& place) {
    p -= place.translate;
    const double a = -place.rotate.degrees * std::numbers::pi / 180;
    p = {std::cos(a) * p.x + std::sin(a) * p.z, p.y,
         -std::sin(a) * p.x + std::cos(a) * p.z};
    return p / place.scale;
}

/// A ray meets the placed shape where the ray before it was placed meets the shape.
template <typename S>
void check_shape(const S& shape, const PlacementT<double>& place) {
    const S there = placed(shape, place);
    Numbers n;
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        const glm::dvec3 from = n.point(20);
        const glm::dvec3 to = place.translate + n.point(4);
        const auto hit = intersect(RayT<double>{from, to - from}, there);
        const glm::dvec3 origin = before(from, place);
        const auto right =
            intersect(RayT<double>{origin, before(to, place) - origin}, shape);
        const auto t = [](const auto& found) {
            if constexpr (requires { found->t; })
                return found->t;
            else
                return *found;
        };
        CHECK(hit.has_value() == right.has_value());
        if (!hit || !right) continue;
        ++hits;
        CHECK(t(hit) == doctest::Approx(t(right)).epsilon(1e-9));
    }
    CHECK(hits > 20);
}

const PlacementT<double> turned{
    .scale{2, 2, 2}, .rotate{.axis{0, 3, 0}, .degrees = 30}, .translate{1, -2, 5}};
const PlacementT<double> stretched{
    .scale{2, 0.5, 3}, .rotate{.axis{0, 1, 0}, .degrees = -110}, .translate{0, 4, 1}};

} // namespace

TEST_CASE("placement: a placed shape is met by placed rays") {
    const QuadT<double> quad{{-1, -1, 0}, {2, 0.5, 0}, {0, 2, 1}};
    const TriangleT<double> triangle{{-1, -1, 0}, {2, -1, 1}, {0, 2, -1}};
    for (const auto& place : {turned, stretched}) {
        check_shape(quad, place);
        check_shape(triangle, place);
    }
    check_shape(SphereT<double>{{0.5, 0, 0}, 1}, turned);
    check_shape(DiscT<double>{{0.5, 0, 0}, {1, 1, 0}, 1.5}, turned);
    check_shape(CylinderT<double>{{0.5, -1, 0}, {0, 2, 1}, 1}, turned);
}

TEST_CASE("placement: normals stay across the surface and on its side") {
    const QuadT<double> quad{{-1, -1, 0}, {2, 0.5, 0}, {0, 2, 1}};
    const auto there = placed(quad, stretched);
    CHECK(glm::distance(placed_normal(normal(quad), stretched), normal(there)) < 1e-12);
}

TEST_CASE("placement: quarter turns are exact") {
    const Placement upright{.rotate{.axis{1, 0, 0}, .degrees = -90}};
    CHECK(placed_point(Vec3{1, 2, 3}, upright) == Vec3{1, 3, -2});
    CHECK(placed_point(Vec3{1, 2, 3}, {.rotate{.axis{0, 1, 0}, .degrees = 90}}) ==
          Vec3{3, 2, -1});
    CHECK(placed_point(Vec3{1, 2, 3}, {.rotate{.axis{0, 0, 2}, .degrees = 540}}) ==
          Vec3{-1, -2, 3});
    CHECK(placed_point(Vec3{1, 2, 3}, Placement{}) == Vec3{1, 2, 3});
}

TEST_CASE("placement: scaling comes first, translation last") {
    const Placement all{
        .scale{2, 2, 2}, .rotate{.axis{0, 0, 1}, .degrees = 90}, .translate{10, 0, 0}};
    CHECK(placed_point(Vec3{1, 0, 0}, all) == Vec3{10, 2, 0});
}

TEST_CASE("placement: what would not be a sphere any more is refused") {
    CHECK_THROWS_WITH_AS((void)placed(Sphere{}, Placement{.scale{1, 2, 1}}),
                         "the scale of a sphere is (1, 2, 1); it must be the same "
                         "along x, y and z.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)placed(Disc{}, Placement{.scale{1, 2, 1}}),
                    std::invalid_argument);
    CHECK_THROWS_AS((void)placed(Cylinder{}, Placement{.scale{1, 2, 1}}),
                    std::invalid_argument);
    CHECK_THROWS_AS(check(Placement{.scale{1, 0, 1}}), std::invalid_argument);
    CHECK_THROWS_AS(check(Placement{.scale{1, 1, -1}}), std::invalid_argument);
    CHECK_THROWS_AS(check(Placement{.rotate{.axis{0, 0, 0}}}), std::invalid_argument);
    CHECK_NOTHROW(check(Placement{}));
}

TEST_CASE("placement: a box has six sides that face outwards and close it") {
    const BoxT<double> box{{-1, 0, 2}, {1, 3, 2.5}};
    const auto sides = sides_of(box);
    const glm::dvec3 middle = (box.low + box.high) / 2.0;
    double all = 0;
    for (const auto& side : sides) {
        all += area(side);
        const glm::dvec3 centre = side.corner + (side.edge_u + side.edge_v) / 2.0;
        CHECK(glm::dot(normal(side), centre - middle) > 0);
        for (const auto& corner : corners_of(side)) {
            CHECK(glm::all(glm::lessThanEqual(box.low, corner)));
            CHECK(glm::all(glm::lessThanEqual(corner, box.high)));
        }
    }
    CHECK(all == doctest::Approx(2 * (2 * 3 + 3 * 0.5 + 2 * 0.5)));
}
