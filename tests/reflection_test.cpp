/// \file reflection_test.cpp
/// \brief Length and angle are kept, and the formula of the report is the usual one.

#include "ljus/optics/reflection.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/draws.hpp"

using ljus::Vec3T;
using ljus_test::Draws;

TEST_CASE("reflection: a ball that bounces off the floor") {
    const ljus::Vec3 up{0, 0, 1};
    CHECK(ljus::reflect(ljus::Vec3{1, 2, -3}, up) == ljus::Vec3{1, 2, 3});
    CHECK(ljus::reflect(ljus::Vec3{0, 0, -1}, up) == up);
    CHECK(ljus::reflect(ljus::Vec3{1, 0, 0}, up) == ljus::Vec3{1, 0, 0});
    static_assert(ljus::reflect(ljus::Vec3{1, 2, 3}) == ljus::Vec3{-1, -2, 3});
}

TEST_CASE_TEMPLATE("reflection: length and angle are kept, the part along the surface "
                   "too, and twice is back",
                   T, float, double) {
    Draws draws;
    const T u = std::numeric_limits<T>::epsilon() / 2;
    for (int i = 0; i < 20000; ++i) {
        const Vec3T<T> d = draws.direction<T>(), n = draws.direction<T>();
        const Vec3T<T> r = ljus::reflect(d, n);
        REQUIRE(std::abs(glm::length(r) - 1) <= 12 * u);
        REQUIRE(std::abs(glm::dot(r, n) + glm::dot(d, n)) <= 8 * u);
        REQUIRE(glm::length(glm::cross(r, n) - glm::cross(d, n)) <= 12 * u);
        REQUIRE(glm::length(ljus::reflect(r, n) - d) <= 16 * u);
        // R = D - 2 (D.N) N, and the side of the normal does not matter.
        REQUIRE(glm::length(r - (d - 2 * glm::dot(d, n) * n)) <= 6 * u);
        REQUIRE(ljus::reflect(d, -n) == r);
    }
}

TEST_CASE_TEMPLATE("reflection: any length is kept", T, float, double) {
    const Vec3T<T> n{0, T(0.6), T(0.8)};
    const Vec3T<T> r = ljus::reflect(Vec3T<T>{T(3e4), T(-4e4), 0}, n);
    CHECK(glm::length(r) == doctest::Approx(5e4).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("reflection: the frame of a material has the same law, directions "
                   "pointing away",
                   T, float, double) {
    Draws draws{2};
    for (int i = 0; i < 2000; ++i) {
        const Vec3T<T> wo = draws.direction<T>();
        const Vec3T<T> wi = ljus::reflect(wo);
        REQUIRE(wi == Vec3T<T>{-wo.x, -wo.y, wo.z});
        // Light that comes from wi travels along -wi, and leaves along wo.
        REQUIRE(glm::length(ljus::reflect(-wi, Vec3T<T>{0, 0, 1}) - wo) <=
                4 * std::numeric_limits<T>::epsilon());
    }
}
