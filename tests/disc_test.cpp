// concept: shape
/// \file disc_test.cpp
/// \brief Discs against the plane's equation in long double, and their light against
/// closed forms.

#include "ljus/geometry/disc.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "ljus/geometry/shape.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

template <typename T>
DiscT<T> any_disc(Numbers& n) {
    const Vec3T<T> center(n.point(5)), normal(n.power(-2, 2) * n.direction());
    return {center, normal, T(n.power(-1, 1))};
}

} // namespace

static_assert(FlatShape<Disc> && detail::is_plane<Disc>);

TEST_CASE("disc: the unit disc, its border and both sides") {
    const auto at = [](float x, float y, float side) {
        return intersect(Ray{{x, y, 2 * side}, {0, 0, -side}}, Disc{});
    };
    for (const float side : {1.0f, -1.0f}) {
        CHECK(at(0, 0, side)->t == 2);
        CHECK(at(1, 0, side));
        CHECK(at(0.6f, -0.79f, side));
        CHECK_FALSE(at(std::nextafter(1.0f, 2.0f), 0, side));
        CHECK_FALSE(at(0.8f, 0.61f, side)); // within its square
    }
    CHECK_FALSE(intersect(Ray{{-2, 0, 0}, {1, 0, 0}}, Disc{})); // in its plane
    CHECK_FALSE(intersect(Ray{{-2, 0, 1}, {1, 0, 0}}, Disc{}));
    CHECK_FALSE(intersect(Ray{{0, 0, 2}, {0, 0, 1}}, Disc{}));
    CHECK_FALSE(intersect(Ray{.origin{0, 0, 2}, .t_max = 1.9f}, Disc{}));
    CHECK_FALSE(intersect(Ray{.origin{0, 0, 2}, .t_min = 2.1f}, Disc{}));
    CHECK_FALSE(intersect(Ray{{0, 0, 2}, {0, 0, 0}}, Disc{}));
}

TEST_CASE_TEMPLATE("disc: what is hit is what the plane's equation says", T, float,
                   double) {
    Numbers n;
    int hits = 0, near = 0;
    for (int i = 0; i < 20000; ++i) {
        const auto disc = any_disc<T>(n);
        const Vec3T<T> from(n.point(20)),
            to(glm::dvec3(disc.center) + 1.5 * double(disc.radius) * n.direction());
        const RayT<T> ray{.origin = from, .direction = to - from};
        using L = long double;
        using V = glm::vec<3, L>;
        const V way = V(disc.center) - V(ray.origin);
        const L t =
            glm::dot(V(disc.normal), way) / glm::dot(V(disc.normal), V(ray.direction));
        const L distance = glm::length(t * V(ray.direction) - way);
        if (std::abs(distance / L(disc.radius) - 1) < 1e-9L) {
            ++near;
            continue;
        }
        const auto hit = intersect(ray, disc);
        CHECK(hit.has_value() == (t >= 0 && distance < L(disc.radius)));
        if (!hit) continue;
        ++hits;
        CHECK(std::abs(L(hit->t) / t - 1) <
              4 * std::numeric_limits<T>::epsilon() + 1e-9);
        // The point lies where the ray goes, on the disc, and does not hit it again.
        const auto point = surface_point(disc, ray, *hit);
        const L size = glm::length(V(disc.center)) + L(disc.radius);
        CHECK(glm::length(V(point.position) - (V(ray.origin) + t * V(ray.direction))) <
              16 * std::numeric_limits<T>::epsilon() * size + 1e-8L);
        CHECK(std::abs(glm::dot(V(point.normal), V(point.position) - V(disc.center))) <=
              2 * glm::dot(V(point.error), glm::abs(V(point.normal))));
        const Vec3T<T> away(n.direction());
        CHECK_FALSE(intersect(spawn_ray(point, away), disc));
    }
    CHECK(hits > 2000);
    CHECK(near < 10);
}

TEST_CASE("disc: samples are spread evenly, on it and in its bounds") {
    Numbers n;
    const auto disc = any_disc<float>(n);
    const BoxT<float> box = bounds(disc);
    constexpr int side = 64;
    double square = 0;
    Vec3T<double> sum(0);
    for (int i = 0; i < side * side; ++i) {
        const Vec2 u{(float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side};
        const auto point = sample_area(disc, u);
        const Vec3T<double> way = Vec3T<double>(point.position - disc.center);
        square += glm::dot(way, way);
        sum += way;
        for (int axis = 0; axis < 3; ++axis) {
            CHECK(point.position[axis] >= box.low[axis]);
            CHECK(point.position[axis] <= box.high[axis]);
        }
    }
    // The mean of r^2 over a disc is R^2/2, and its centre is the mean point.
    const double r = disc.radius, all = side * side;
    CHECK(square / all == doctest::Approx(r * r / 2).epsilon(1e-3));
    CHECK(glm::length(sum) / all < 1e-3 * r);
    CHECK(area(disc) == doctest::Approx(std::numbers::pi * r * r));
    // Its bounds are tight: a disc across x reaches as far as R along y.
    CHECK(bounds(Disc{{0, 0, 0}, {1, 0, 0}, 2}).high.x < 1e-5f);
    CHECK(bounds(Disc{{0, 0, 0}, {1, 0, 0}, 2}).high.y == doctest::Approx(2));
}

TEST_CASE("disc: the light of a round lamp on its axis is R^2/(R^2 + h^2)") {
    const Disc lamp{{0, 2, 0}, {0, -1, 0}, 1.5f};
    constexpr int side = 200;
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
        const Vec2 u{(float(i % side) + 0.5f) / side, (float(i / side) + 0.5f) / side};
        const auto seen = sample_towards(lamp, Vec3{0}, u);
        sum += glm::normalize(seen.point.position).y / seen.pdf;
        CHECK(pdf_towards(lamp, Vec3{0}, seen.point) == seen.pdf);
    }
    const double r2 = 1.5 * 1.5;
    CHECK(sum / (side * side) / std::numbers::pi ==
          doctest::Approx(r2 / (r2 + 4)).epsilon(1e-4));
}

TEST_CASE("disc: texture coordinates fill the circle in the unit square") {
    const auto at = [](float x, float y) {
        const Ray ray{{x, y, 1}, {0, 0, -1}};
        const auto hit = intersect(ray, Disc{});
        return texture_coordinates(Disc{}, *hit, surface_point(Disc{}, ray, *hit));
    };
    CHECK(at(0, 0) == Vec2{0.5f, 0.5f});
    CHECK(at(1, 0) == Vec2{1, 0.5f});
    CHECK(at(0, -1) == Vec2{0.5f, 0});
    CHECK(at(-0.5f, 0.5f) == Vec2{0.25f, 0.75f});
}

TEST_CASE("disc: one without a normal or a radius is refused") {
    CHECK_NOTHROW(check(Disc{}));
    CHECK_THROWS_WITH_AS(check(Disc{.normal{0, 0, 0}}),
                         "disc.normal is (0, 0, 0); it must be finite and not 0, for "
                         "it gives a direction.",
                         std::invalid_argument);
    CHECK_THROWS_AS(check(Disc{.radius = 0}), std::invalid_argument);
    CHECK_THROWS_AS(check(Disc{.center{0, std::nanf(""), 0}}), std::invalid_argument);
}
