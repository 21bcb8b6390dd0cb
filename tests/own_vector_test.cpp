/// \file own_vector_test.cpp
/// \brief The vector type of examples/own_vector.hpp: its glass against Snell's law by
/// angles, and against the share that Schlick's formula reflects.

#include "own_vector.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <type_traits>

using reader::Vector;

static_assert(std::is_convertible_v<Vector, glm::vec3>);
static_assert(std::is_convertible_v<glm::vec3, Vector>);

namespace {
/// A direction of travel at an angle to the normal (0, 0, 1): down if it is above 0.
Vector travelling(double degrees, bool down) {
    const double angle = degrees * std::numbers::pi / 180;
    return {float(std::sin(angle)), 0,
            float(down ? -std::cos(angle) : std::cos(angle))};
}
/// Schlick's formula with the index 1.5.
double schlick_of(double degrees_outside) {
    const double c = std::cos(degrees_outside * std::numbers::pi / 180);
    return 0.04 + 0.96 * std::pow(1 - c, 5);
}
/// The share of numbers u that reflect.
double share_reflected(const Vector& d) {
    const Vector n{0, 0, 1};
    int reflected = 0;
    constexpr int steps = 10000;
    for (int i = 0; i < steps; ++i) {
        const Vector next = at_glass(d, n, (float(i) + 0.5f) / steps);
        reflected += (next.z > 0) == (d.z < 0) ? 1 : 0;
    }
    return double(reflected) / steps;
}
} // namespace

TEST_CASE("own vector: glass bends by Snell's law and reflects by Schlick's formula") {
    const Vector n{0, 0, 1};
    for (const double outside : {5.0, 30.0, 60.0, 85.0}) {
        CAPTURE(outside);
        const double sine = std::sin(outside * std::numbers::pi / 180) / 1.5;
        const double inside = std::asin(sine) * 180 / std::numbers::pi;
        const Vector in = at_glass(travelling(outside, true), n, 0.9999f);
        CHECK(in.x == doctest::Approx(sine));
        CHECK(in.z < 0);
        const Vector out = at_glass(travelling(inside, false), n, 0.9999f);
        CHECK(out.x == doctest::Approx(1.5 * sine));
        CHECK(out.z > 0);
        const double expected = schlick_of(outside);
        CHECK(std::abs(share_reflected(travelling(outside, true)) - expected) < 2e-4);
        CHECK(std::abs(share_reflected(travelling(inside, false)) - expected) < 2e-4);
    }
    // Beyond 41.8 degrees from inside all is reflected.
    CHECK(share_reflected(travelling(43, false)) == 1);
    const Vector back = at_glass(travelling(60, false), n, 0.99f);
    CHECK(back.z == doctest::Approx(-0.5));
}
