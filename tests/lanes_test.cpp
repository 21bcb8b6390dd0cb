/// \file lanes_test.cpp
/// \brief Eight at a time must be what one at a time is.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <doctest/doctest.h>

#include "ljus/math/lanes.hpp"
#include "ljus/math/random.hpp"

using namespace ljus;
using namespace ljus::detail;

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

} // namespace

TEST_CASE("lanes: those up to a bound, as bits; NaN is none of them") {
    const Lanes a{{quiet_nan, 1, 2, 3, -infinity, infinity, -0.0f, 5}};
    CHECK(lanes_up_to(a, 2.0f) == (2u | 4u | 16u | 64u));
    CHECK(lanes_up_to(a, infinity) == 254u);
    CHECK(lanes_up_to(a, quiet_nan) == 0u);
}

TEST_CASE("lanes: the smallest of those that count, but for its last three bits") {
    RandomStream stream = random_stream(1, Pass::user, 0, 0);
    for (int round = 0; round < 10000; ++round) {
        Lanes a = numbers(stream);
        for (float& x : a.lane) x = std::abs(x);
        const auto among = static_cast<std::uint32_t>(256 * next_1d(stream));
        const float bound = std::abs(numbers(stream).lane[0]);
        float smallest = infinity;
        bool any = false;
        for (std::uint32_t i = 0; i < 8; ++i)
            if ((among >> i & 1u) != 0 && a.lane[i] <= bound) {
                smallest = std::min(smallest, a.lane[i]);
                any = true;
            }
        const std::uint32_t found = smallest_lane(a, among, bound);
        REQUIRE((found < 8) == any);
        REQUIRE(found <= 8);
        if (!any) continue;
        REQUIRE((among >> found & 1u) != 0);
        const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x) >> 3; };
        REQUIRE(bits(a.lane[found]) == bits(smallest));
    }
}

TEST_CASE("lanes: those that say yes are taken one by one, the first one first") {
    for (std::uint32_t wanted = 0; wanted < 256; ++wanted) {
        LaneMask mask{};
        for (std::size_t i = 0; i < 8; ++i)
            mask.lane[i] = (wanted & lane_bit[i]) != 0 ? -1 : 0;
        std::uint64_t yes = yes_lanes(mask);
        std::uint32_t taken = 0, last = 0;
        while (yes != 0) {
            const std::uint32_t bit = lane_bit[take_lane(yes)];
            REQUIRE(bit > last); // each of them once
            taken |= last = bit;
        }
        REQUIRE(taken == wanted);
    }
}

TEST_CASE("lanes: a point goes in and comes out") {
    Lanes3 block{};
    for (std::size_t i = 0; i < 8; ++i) block.set(i, Vec3{float(i), 10.0f, -float(i)});
    for (std::size_t i = 0; i < 8; ++i)
        CHECK(block[i] == Vec3{float(i), 10.0f, -float(i)});
}

TEST_CASE_TEMPLATE("lanes: a bound that is met counts, in either precision", T, float,
                   double) {
    LanesT<T> a{};
    for (std::size_t i = 0; i < 8; ++i) a.lane[i] = T(8 - i); // 8 to 1
    CHECK(smallest_lane(a, 255u, T(9)) == 7);
    CHECK(smallest_lane(a, 127u, T(9)) == 6);
    CHECK(smallest_lane(a, 1u, T(8)) == 0);
    CHECK(smallest_lane(a, 1u, std::nextafter(T(8), T(0))) == 8);
    CHECK(smallest_lane(a, 0u, T(9)) == 8);
    CHECK(smallest_lane(a, 256u, T(9)) == 8); // no lane of these
    CHECK(lanes_up_to(a, T(3)) == (32u | 64u | 128u));
    for (T& x : a.lane) x = std::numeric_limits<T>::infinity();
    CHECK(smallest_lane(a, 255u, std::numeric_limits<T>::infinity()) < 8);
    CHECK(smallest_lane(a, 255u, std::numeric_limits<T>::max()) == 8);
}
