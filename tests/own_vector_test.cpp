/// \file own_vector_test.cpp
/// \brief The vector type of examples/own_vector.hpp: its glass against Snell's law by
/// angles, and against the share that Schlick's formula reflects.

#include "own_vector.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <type_traits>
#include <vector>

#include "ljus/accel/bvh.hpp"
#include "ljus/geometry/triangle.hpp"
#include "ljus/math/random.hpp"
#include "ljus/math/sampling.hpp"

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
// [bvh]
/// A mesh of the program's own, and the tree of its boxes.
struct Mesh {
    std::vector<ljus::Triangle> triangles;
    ljus::Bvh tree;

    explicit Mesh(std::vector<ljus::Triangle> all) : triangles(std::move(all)) {
        std::vector<ljus::Box> boxes;
        for (const auto& triangle : triangles) boxes.push_back(bounds(triangle));
        tree = ljus::Bvh(boxes);
    }
    /// The nearest hit: .found, .at.t, and .number, the triangle's index.
    ljus::NearestHit hit(const ljus::Ray& ray) const {
        return nearest_hit(tree, ray, [&](std::uint32_t slot, const ljus::Ray& rest) {
            return intersect(rest, triangles[tree.primitive_ids()[slot]]);
        });
    }
};
// [bvh]

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

TEST_CASE(
    "own vector: refract() without its namespace is GLM's, with no sign of loss") {
    const glm::vec3 d{0.8f, 0, 0.6f}, n{0, 0, 1};
    CHECK_FALSE(ljus::refract(d, n, 1.5f)); // total reflection
    CHECK(refract(d, n, 1.5f) == glm::vec3{0});
}

TEST_CASE("own vector: a mesh in a tree has the hits of a loop over its triangles") {
    auto stream = ljus::random_stream(3, ljus::Pass::user, 0, 0);
    const auto direction = [&] {
        return Vector(ljus::sample_uniform_sphere(ljus::next_2d(stream)));
    };
    std::vector<ljus::Triangle> triangles;
    for (int i = 0; i < 300; ++i) {
        const Vector a = direction();
        triangles.push_back({a, a + 0.3f * direction(), a + 0.3f * direction()});
    }
    const Mesh mesh(triangles);
    int hits = 0;
    for (int i = 0; i < 500; ++i) {
        ljus::Ray ray{.origin = 3.0f * direction(), .direction = direction()};
        const auto nearest = mesh.hit(ray);
        std::size_t index = triangles.size();
        for (std::size_t k = 0; k < triangles.size(); ++k)
            if (const auto hit = intersect(ray, triangles[k])) {
                ray.t_max = hit->t;
                index = k;
            }
        REQUIRE(nearest.found == (index < triangles.size()));
        if (!nearest.found) continue;
        ++hits;
        CHECK(nearest.number == index);
        CHECK(nearest.at.t == ray.t_max);
    }
    CHECK(hits > 10);
}
