#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <limits>
#include <vector>

#include <glm/geometric.hpp>

#include "ljus/math/frame.hpp"
#include "support/draws.hpp"

using namespace ljus;

namespace {

/// Unit vectors all around, the poles and their neighbourhoods among them.
template <typename T>
std::vector<Vec3T<T>> directions() {
    std::vector<Vec3T<T>> all;
    const int rings = 40;
    const int steps = 16;
    const T pi = std::acos(T(-1));
    for (int i = 0; i <= rings; ++i)
        for (int j = 0; j < steps; ++j) {
            const T theta = pi * T(i) / T(rings);
            const T phi = T(2) * pi * (T(j) + T(0.37)) / T(steps);
            all.push_back({std::sin(theta) * std::cos(phi),
                           std::sin(theta) * std::sin(phi), std::cos(theta)});
        }
    // Near the poles, where a construction that divides by 1 + z breaks.
    for (const T tilt : {T(0), T(1e-2), T(1e-3), T(1e-4), T(1e-6), T(1e-12)})
        for (const T side : {T(1), T(-1)})
            all.push_back(glm::normalize(Vec3T<T>{tilt, -tilt / T(3), side}));
    all.push_back({T(1), T(0), -T(0)}); // a normal with a negative zero
    return all;
}

/// How far the three vectors are from orthonormal.
template <typename T>
T distance_from_orthonormal(const FrameT<T>& f) {
    T worst = T(0);
    for (const T error :
         {glm::dot(f.tangent, f.tangent) - T(1),
          glm::dot(f.bitangent, f.bitangent) - T(1),
          glm::dot(f.normal, f.normal) - T(1), glm::dot(f.tangent, f.bitangent),
          glm::dot(f.bitangent, f.normal), glm::dot(f.normal, f.tangent)})
        worst = std::fmax(worst, std::abs(error));
    return worst;
}

} // namespace

TEST_CASE_TEMPLATE("frame: three orthonormal vectors around every normal", T, float,
                   double) {
    // The inputs are unit vectors only up to roundoff, so a few of its units are
    // allowed.
    const T few_ulps = T(8) * std::numeric_limits<T>::epsilon();
    for (const Vec3T<T>& n : directions<T>()) {
        CAPTURE(n.x);
        CAPTURE(n.y);
        CAPTURE(n.z);
        const FrameT<T> frame = frame_around(n);
        CHECK(frame.normal == n);
        CHECK(distance_from_orthonormal(frame) <= few_ulps);
    }
}

TEST_CASE_TEMPLATE("frame: right-handed, also below the horizon", T, float, double) {
    for (const Vec3T<T>& n : directions<T>()) {
        const FrameT<T> frame = frame_around(n);
        CHECK(glm::dot(glm::cross(frame.tangent, frame.bitangent), frame.normal) >
              T(0.99));
    }
}

TEST_CASE("frame: exact at both poles") {
    const Frame up = frame_around(Vec3{0, 0, 1});
    CHECK(up.tangent == Vec3{1, 0, 0});
    CHECK(up.bitangent == Vec3{0, 1, 0});
    const Frame down = frame_around(Vec3{0, 0, -1});
    CHECK(distance_from_orthonormal(down) == 0.0f);
}

TEST_CASE_TEMPLATE("frame: to the world and back is the identity", T, float, double) {
    const T few_ulps = T(16) * std::numeric_limits<T>::epsilon();
    const Vec3T<T> v{T(0.3), T(-1.7), T(0.9)};
    for (const Vec3T<T>& n : directions<T>()) {
        const FrameT<T> frame = frame_around(n);
        CHECK(glm::distance(to_local(frame, to_world(frame, v)), v) <= few_ulps);
        CHECK(glm::distance(to_world(frame, to_local(frame, v)), v) <= few_ulps);
    }
}

TEST_CASE("frame: the local z axis is the normal") {
    const Vec3 n = glm::normalize(Vec3{1, -2, 0.5f});
    const Frame frame = frame_around(n);
    CHECK(to_world(frame, Vec3{0, 0, 1}) == n);
    CHECK(to_local(frame, n).z == doctest::Approx(1.0f));
    CHECK(to_local(frame, n).x == doctest::Approx(0.0f));
    CHECK(to_local(frame, n).y == doctest::Approx(0.0f));
}

TEST_CASE_TEMPLATE("frame: orthonormal within the units that the doc names", T, float,
                   double) {
    // In long double, of normals all around, and of such with a small x.
    using L = long double;
    ljus_test::Draws draws{59};
    const auto dot = [](const Vec3T<T>& a, const Vec3T<T>& b) {
        return L(a.x) * L(b.x) + L(a.y) * L(b.y) + L(a.z) * L(b.z);
    };
    L length[2] = {}, product[2] = {};
    for (int i = 0; i < 400000; ++i) {
        auto n = draws.direction<T>();
        const int kind = i % 2;
        if (kind == 1) {
            if (i % 4 == 1) n.x *= std::pow(T(10), draws.between(T(-8), T(0)));
            n = glm::normalize(draws.between(T(1), T(2)) * n);
        }
        const FrameT<T> f = frame_around(n);
        const L unit = std::numeric_limits<T>::epsilon() / 2;
        for (const auto* v : {&f.tangent, &f.bitangent})
            length[kind] =
                std::max(length[kind], std::abs(std::sqrt(dot(*v, *v)) - 1) / unit);
        for (const L p : {dot(f.tangent, f.bitangent), dot(f.tangent, f.normal),
                          dot(f.bitangent, f.normal)})
            product[kind] = std::max(product[kind], std::abs(p) / unit);
    }
    CHECK(length[0] < 2);
    CHECK(product[0] < 4);
    CHECK(length[1] < 3);
    CHECK(product[1] < 8);
}

TEST_CASE_TEMPLATE("frame: on the equator the sign of zero tells which side it is of",
                   T, float, double) {
    // So that the frame there is the limit from that side, and does not jump.
    const T near = T(1e-3) * std::numeric_limits<T>::epsilon();
    for (const T turn : {T(0), T(1), T(2.5), T(4)})
        for (const T side : {T(1), T(-1)}) {
            const T x = std::cos(turn), y = std::sin(turn);
            const auto there = frame_around(Vec3T<T>{x, y, side * T(0)});
            const auto beside = frame_around(Vec3T<T>{x, y, side * near});
            CHECK(glm::distance(there.tangent, beside.tangent) < T(1e-6));
            CHECK(glm::distance(there.bitangent, beside.bitangent) < T(1e-6));
        }
    const FrameT<T> none;
    CHECK(none.tangent == Vec3T<T>{1, 0, 0});
    CHECK(none.bitangent == Vec3T<T>{0, 1, 0});
    CHECK(none.normal == Vec3T<T>{0, 0, 1});
}
