// concept: refraction
/// \file lens_test.cpp
/// \brief What optics knows of a ball of glass, found by tracing.

#include <doctest/doctest.h>

#include <cmath>

#include <ljus/ljus.hpp>

using Ray = ljus::RayT<double>;
using Vec3 = ljus::Vec3T<double>;

namespace {

/// Where a ray parallel to the x axis, at a height, meets that axis behind the unit
/// ball of index n.
double crossing(double height, double n) {
    const ljus::SphereT<double> ball{};
    const Ray before{.origin{-3, height, 0}, .direction{1, 0, 0}};
    const Vec3 in = point_at(before, *intersect(before, ball));
    const Vec3 inside = *ljus::refract(before.direction, normal(ball, in), 1 / n);
    const Ray within{.origin = in, .direction = inside, .t_min = 1e-9};
    const Vec3 out = point_at(within, *intersect(within, ball));
    const Vec3 beyond = *ljus::refract(inside, normal(ball, out), n);
    return out.x - out.y * beyond.x / beyond.y;
}

} // namespace

TEST_CASE("lens: the focus of a ball is n R / 2(n - 1), for rays close to the axis") {
    for (const double n : {1.1, 1.33, 1.5, 1.8, 1.99}) {
        const double focus = n / (2 * (n - 1));
        // The aberration goes with the square of the height.
        const double near = crossing(1e-3, n) - focus;
        const double far = crossing(2e-3, n) - focus;
        MESSAGE("n = ", n, ": the focus is at ", focus + near, ", by theory ", focus);
        CHECK(std::abs(near) < 1e-4 * focus);
        CHECK(far / near == doctest::Approx(4).epsilon(1e-3));
        CHECK(near < 0); // rays far from the axis cross it earlier
    }
}

TEST_CASE("lens: a ray leaves a ball at the angle at which it entered") {
    const ljus::SphereT<double> ball{};
    for (int i = 0; i < 99; ++i) {
        const double height = 0.01 * i;
        const Ray before{.origin{-3, height, 0}, .direction{1, 0, 0}};
        const Vec3 in = point_at(before, *intersect(before, ball));
        const Vec3 inside = *ljus::refract(before.direction, normal(ball, in), 1 / 1.5);
        const Ray within{.origin = in, .direction = inside, .t_min = 1e-9};
        const Vec3 out = point_at(within, *intersect(within, ball));
        const auto beyond = ljus::refract(inside, normal(ball, out), 1.5);
        REQUIRE(beyond); // so that there is no total reflection
        CHECK(glm::dot(*beyond, normal(ball, out)) ==
              doctest::Approx(-glm::dot(before.direction, normal(ball, in)))
                  .epsilon(1e-10));
    }
}
