/// \file lanes_test.cpp
/// \brief Eight at a time must be what one at a time is, bit by bit.

#include <array>
#include <bit>
#include <limits>

#include <doctest/doctest.h>

#include "ljus/math/lanes.hpp"
#include "ljus/math/random.hpp"

using namespace ljus;

namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();
constexpr float quiet_nan = std::numeric_limits<float>::quiet_NaN();

/// Numbers of all sizes and signs; a few special ones among them.
Lanes numbers(RandomStream& stream) {
    constexpr std::array special{0.0f,      -0.0f,  infinity, -infinity,
                                 quiet_nan, 1e-45f, 3e38f};
    Lanes result{};
    for (float& x : result.lane) {
        const float u = next_1d(stream);
        const float exponent = 40.0f * next_1d(stream) - 20.0f;
        x = (u - 0.5f) * std::exp2(exponent);
        if (next_1d(stream) < 0.1f)
            x = special[static_cast<std::size_t>(next_1d(stream) * 7.0f)];
    }
    return result;
}

/// The same bits, or NaN both: the bits of a NaN are not promised.
bool same(float a, float b) {
    return (std::isnan(a) && std::isnan(b)) ||
           std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

} // namespace

TEST_CASE("lanes: arithmetic is that of single floats, to the bit") {
    RandomStream stream = random_stream(1, Pass::user, 0, 0);
    for (int round = 0; round < 1000; ++round) {
        const Lanes a = numbers(stream);
        const Lanes b = numbers(stream);
        const Lanes sum = a + b;
        const Lanes difference = a - b;
        const Lanes product = a * b;
        const Lanes quotient = a / b;
        const Lanes root = sqrt(a);
        for (int i = 0; i < lane_count; ++i) {
            REQUIRE(same(sum.lane[i], a.lane[i] + b.lane[i]));
            REQUIRE(same(difference.lane[i], a.lane[i] - b.lane[i]));
            REQUIRE(same(product.lane[i], a.lane[i] * b.lane[i]));
            REQUIRE(same(quotient.lane[i], a.lane[i] / b.lane[i]));
            REQUIRE(same(root.lane[i], std::sqrt(a.lane[i])));
        }
    }
}

TEST_CASE("lanes: NaN is no to every comparison, and gives way in min and max") {
    const Lanes a{{quiet_nan, 1, 1, 2, quiet_nan, -infinity, -0.0f, 5}};
    const Lanes b{{1, quiet_nan, 2, 1, quiet_nan, infinity, 0.0f, 5}};
    const LaneMask mask = a <= b;
    const std::array<std::int32_t, 8> expected{0, 0, -1, 0, 0, -1, -1, -1};
    for (std::size_t i = 0; i < 8; ++i) CHECK(mask.lane[i] == expected[i]);
    CHECK(min(a, b).lane[0] == 1.0f);
    CHECK(max(a, b).lane[0] == 1.0f);
    CHECK(min(a, b).lane[2] == 1.0f);
    CHECK(max(a, b).lane[2] == 2.0f);
}

TEST_CASE("lanes: select takes each lane from where the mask says") {
    const Lanes index{{0, 1, 2, 3, 4, 5, 6, 7}};
    const LaneMask low = index <= all_lanes(3.0f);
    const Lanes mixed = select(low, index, all_lanes(-1.0f));
    for (int i = 0; i < lane_count; ++i)
        CHECK(mixed.lane[i] == (i <= 3 ? float(i) : -1.0f));
    CHECK(any(low));
    CHECK_FALSE(any(low & (all_lanes(4.0f) <= index)));
}

TEST_CASE("lanes: dot and cross are those of vectors") {
    RandomStream stream = random_stream(2, Pass::user, 0, 0);
    Lanes3 a{};
    Lanes3 b{};
    std::array<glm::dvec3, lane_count> va{};
    std::array<glm::dvec3, lane_count> vb{};
    for (int i = 0; i < lane_count; ++i) {
        const Vec3 p = next_3d(stream) - Vec3{0.5f};
        const Vec3 q = next_3d(stream) - Vec3{0.5f};
        a.x.lane[i] = p.x, a.y.lane[i] = p.y, a.z.lane[i] = p.z;
        b.x.lane[i] = q.x, b.y.lane[i] = q.y, b.z.lane[i] = q.z;
        va[static_cast<std::size_t>(i)] = p;
        vb[static_cast<std::size_t>(i)] = q;
    }
    const Lanes scalar = dot(a, b);
    const Lanes3 vector = cross(a, b);
    for (int i = 0; i < lane_count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        const glm::dvec3 c = glm::cross(va[k], vb[k]);
        CHECK(scalar.lane[i] == doctest::Approx(glm::dot(va[k], vb[k])).epsilon(1e-5));
        CHECK(std::abs(vector.x.lane[i] - c.x) < 1e-7);
        CHECK(std::abs(vector.y.lane[i] - c.y) < 1e-7);
        CHECK(std::abs(vector.z.lane[i] - c.z) < 1e-7);
    }
}
