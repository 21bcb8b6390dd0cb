/// \file lane_select_test.cpp
/// \brief The k-th smallest by counting is the k-th smallest.

#include "ljus/accel/detail/lane_select.hpp"

#include <doctest/doctest.h>

#include "support/draws.hpp"
#include <algorithm>
#include <cmath>
#include <vector>

namespace {

template <typename T>
void compare_with_sorting() {
    constexpr T infinity = std::numeric_limits<T>::infinity();
    constexpr T most = std::numeric_limits<T>::max();
    ljus_test::Draws numbers{3};
    for (int repeat = 0; repeat < 20000; ++repeat) {
        const auto n = std::size_t(1 + numbers.below(200));
        const int mode = numbers.below(8);
        std::vector<T> values;
        for (std::size_t i = 0; i < n; ++i) {
            const double u = numbers.unit();
            values.push_back(
                mode == 0   ? T(u)
                : mode == 1 ? T(int(u * 5) - 2)                  // ties
                : mode == 2 ? T(std::exp((u - 0.5) * 80))        // all sizes
                : mode == 3 ? T(7)                               // equal
                : mode == 4 ? (u < 0.2 ? infinity : T(u * 1e30)) // too large
                : mode == 5 ? T((u - 0.5) * 1.9) * most          // the whole range
                : mode == 6 ? T(u) * std::numeric_limits<T>::denorm_min() * T(100)
                            : (u < 0.5 ? T(0) * T(-1) : T(0))); // two zeros
        }
        std::vector<T> sorted = values;
        std::sort(sorted.begin(), sorted.end());
        while (values.size() % 8 != 0) values.push_back(infinity);
        const auto k = std::size_t(1 + numbers.below(int(n)));
        REQUIRE(ljus::detail::select_smallest(values.data(), n, k) == sorted[k - 1]);

        const auto spare = std::size_t(numbers.below(30));
        const T near = ljus::detail::select_smallest(values.data(), n, k, spare);
        const auto through = std::size_t(
            std::upper_bound(sorted.begin(), sorted.end(), near) - sorted.begin());
        REQUIRE(through >= k);
        REQUIRE((through <= k + spare || near == sorted[k - 1]));
    }
}

} // namespace

TEST_CASE("lane_select: what sorting says") {
    compare_with_sorting<float>();
    compare_with_sorting<double>();
}

TEST_CASE("lane_select: the middle of two numbers lies between them, in steps") {
    const auto middle = [](float a, float b) {
        return ljus::detail::middle_in_bits(a, b);
    };
    CHECK(middle(1.0f, 2.0f) == 1.5f);
    CHECK(middle(1.0f, 4.0f) == 2.0f);
    CHECK(middle(-1.0f, 1.0f) == 0.0f);
    CHECK(middle(-4.0f, -1.0f) == -2.0f);
    float low = -3e38f, high = 3e38f;
    int steps = 0;
    for (; std::nextafter(low, high) < high; ++steps) {
        const float m = middle(low, high);
        REQUIRE(low <= m);
        REQUIRE(m <= high);
        if (m == low) break;
        (m < 1.2345e-30f ? low : high) = m;
    }
    CHECK(steps <= 33);
}

TEST_CASE("lane_select: one number far from all others makes no search long") {
    // Each guess by the spread of the numbers would move the lower end by a millionth
    // of what is left: millions of passes. The middle in bits is there in some dozens.
    constexpr std::size_t n = std::size_t{1} << 21;
    std::vector<float> values(n, 1.0f);
    values[54321] = 1.5f;
    values[12345] = 0;
    std::vector<float> sorted = values;
    std::nth_element(sorted.begin(), sorted.begin() + 2, sorted.end());
    CHECK(ljus::detail::select_smallest(values.data(), n, 3) == sorted[2]);
}
