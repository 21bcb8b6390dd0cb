/// \file ray_test.cpp
/// \brief R(t) = O + tD.

#include "ljus/geometry/ray.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <type_traits>

#include "ljus/geometry/shape.hpp"

using namespace ljus;

namespace {

/// A shape that is met as far away as its test is large.
struct AsTold {};

template <typename Test = char, std::floating_point T>
std::optional<T> intersect(const RayT<T>&, const AsTold&) {
    return T(sizeof(Test));
}

} // namespace

TEST_CASE("ray: the point at t is O + tD, whatever the length of D") {
    constexpr Ray ray{.origin = {1, 2, 3}, .direction = {0, 0, -2}};
    static_assert(point_at(ray, 0.0f) == Vec3{1, 2, 3});
    CHECK(point_at(ray, 1.5f) == Vec3{1, 2, 0});
    CHECK(point_at(ray, -1.0f) == Vec3{1, 2, 5});
}

TEST_CASE_TEMPLATE("ray: without more said, it starts at the origin and looks along -z",
                   T, float, double) {
    const RayT<T> ray;
    CHECK(ray.origin == Vec3T<T>{0});
    CHECK(ray.direction == Vec3T<T>{0, 0, -1});
    CHECK(ray.t_min == 0); // the report's range: every t >= 0
    CHECK(ray.t_max == std::numeric_limits<T>::infinity());
}

TEST_CASE_TEMPLATE(
    "ray: t >= 0 hits the surface that it starts on, offset_ray_origin() does not", T,
    float, double) {
    const SphereT<T> ball{.center = {0, 1, 0}, .radius = 1};
    const QuadT<T> floor{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}};
    const TriangleT<T> triangle{{-1, 0, -1}, {0, 0, 2}, {2, 0, 0}};
    const auto away = [](const auto& shape, T side) {
        const Vec3T<T> direction{T(0.6), T(0.8) * side, 0};
        const RayT<T> printed{.origin = Vec3T<T>{0}, .direction = direction};
        const auto self = intersect(printed, shape);
        CHECK((self && as_hit(*self).t == 0)); // definition 3.1, to the letter
        RayT<T> above{.origin = {0, side, 0}, .direction = {0, -side, 0}};
        if (std::is_same_v<std::decay_t<decltype(shape)>, SphereT<T>> && side > 0)
            above.origin.y = T(0.5); // from within
        const auto hit = intersect(above, shape);
        REQUIRE(hit);
        const auto point = surface_point(shape, above, as_hit(*hit));
        return intersect(spawn_ray(point, direction), shape);
    };
    for (const T side : {T(1), T(-1)}) {
        CHECK_FALSE(away(floor, side));
        CHECK_FALSE(away(triangle, side));
    }
    CHECK_FALSE(away(ball, T(-1)));
    const auto through = away(ball, T(1)); // within the ball its other side is met
    REQUIRE(through);
    CHECK(*through > T(1));
}

TEST_CASE("ray: what is no ray meets nothing") {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr float not_a_number = std::numeric_limits<float>::quiet_NaN();
    const Quad floor{{-1, -1, -1}, {0, 0, 2}, {2, 0, 0}};
    const Sphere ball{.center = {0, -2, 0}, .radius = 1};
    const Ray down{.origin = {0, 1, 0}, .direction = {0, -1, 0}};
    const auto meets = [&](const Ray& ray) {
        return intersect(ray, floor).has_value() || intersect(ray, ball).has_value();
    };
    CHECK(meets(down));
    Ray ray = down;
    ray.direction = Vec3{0};
    CHECK_FALSE(meets(ray));
    ray = down, ray.t_min = 5, ray.t_max = 4;
    CHECK_FALSE(meets(ray));
    for (const float bad : {infinity, -infinity, not_a_number}) {
        ray = down, ray.direction.y = bad;
        CHECK_FALSE(meets(ray));
        ray = down, ray.origin.y = bad;
        CHECK_FALSE(meets(ray));
    }
    ray = down, ray.t_min = not_a_number;
    CHECK_FALSE(meets(ray));
    ray = down, ray.t_max = not_a_number;
    CHECK_FALSE(meets(ray));
}

TEST_CASE(
    "ray: what has no use for what was prepared is still asked by the same test") {
    const Ray ray;
    CHECK(*intersect<float>(ray, AsTold{}, prepare<float>(ray)) == 4);
    CHECK(*intersect<double>(ray, AsTold{}, prepare<double>(ray)) == 8);
}
