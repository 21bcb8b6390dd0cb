/// \file ray_test.cpp
/// \brief R(t) = O + tD.

#include "ljus/geometry/ray.hpp"

#include <doctest/doctest.h>

#include <limits>

using namespace ljus;

TEST_CASE("ray: the point at t is O + tD, whatever the length of D") {
    constexpr Ray ray{.origin = {1, 2, 3}, .direction = {0, 0, -2}};
    static_assert(at(ray, 0.0f) == Vec3{1, 2, 3});
    CHECK(at(ray, 1.5f) == Vec3{1, 2, 0});
    CHECK(at(ray, -1.0f) == Vec3{1, 2, 5});
}

TEST_CASE_TEMPLATE("ray: without more said, it starts at the origin and looks along -z",
                   T, float, double) {
    const RayT<T> ray;
    CHECK(ray.origin == Vec3T<T>{0});
    CHECK(ray.direction == Vec3T<T>{0, 0, -1});
    CHECK(ray.t_min == 0); // the report's range: every t >= 0
    CHECK(ray.t_max == std::numeric_limits<T>::infinity());
}
