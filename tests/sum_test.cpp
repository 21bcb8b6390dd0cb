#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/math/sum.hpp"
#include "ljus/math/vector.hpp"

namespace {

// Terms k * 2^-40 with whole k: their exact sum is one of integers.
struct Terms {
    std::vector<double> values;
    std::int64_t exact = 0; // in units of 2^-40
};

Terms random_terms(int count) {
    Terms terms;
    std::uint64_t state = 1;
    for (int i = 0; i < count; ++i) {
        state = state * 6364136223846793005u + 1442695040888963407u;
        const auto k = static_cast<std::int64_t>(state >> 24) - (std::int64_t{1} << 39);
        terms.exact += k;
        terms.values.push_back(std::ldexp(static_cast<double>(k), -40));
    }
    return terms;
}

float plain_sum(const std::vector<float>& terms) {
    float sum = 0;
    for (const float term : terms) sum += term;
    return sum;
}

} // namespace

TEST_CASE("sum: the compensated one agrees with the exact sum to the last digit") {
    for (const int count : {0, 1, 2, 3, 17, 1000, 100000}) {
        const Terms terms = random_terms(count);
        CHECK(ljus::compensated_sum(terms.values) ==
              std::ldexp(static_cast<double>(terms.exact), -40));
    }
}

TEST_CASE(
    "sum: the compensated one in float is the exact sum rounded, within one unit") {
    // Multiples of 2^-20 below 1, whose exact sum is one of integers.
    std::vector<float> terms;
    std::int64_t exact = 0;
    std::uint32_t state = 7;
    for (int i = 0; i < 1000000; ++i) {
        state = state * 1664525u + 1013904223u;
        exact += state >> 12;
        terms.push_back(std::ldexp(static_cast<float>(state >> 12), -20));
    }
    const double right = std::ldexp(static_cast<double>(exact), -20);
    const double unit = std::numeric_limits<float>::epsilon() * right;
    CHECK(std::abs(static_cast<double>(ljus::compensated_sum(terms)) - right) <= unit);
    CHECK(std::abs(static_cast<double>(ljus::detail::pairwise_sum(terms)) - right) <=
          8 * unit);
    CHECK(std::abs(static_cast<double>(plain_sum(terms)) - right) > 20 * unit);
}

TEST_CASE("sum: what is lost in a large term comes back when that term is taken away") {
    CHECK(ljus::compensated_sum(std::array{1.0, 1e100, 1.0, -1e100}) == 2.0);
    CHECK(ljus::compensated_sum(std::array{1e16, 1.0, -1e16}) == 1.0);
    CHECK(ljus::compensated_sum(std::array{1.0f, 1e20f, 1.0f, -1e20f}) == 2.0f);
}

TEST_CASE(
    "sum: 4e7 terms of 1 in float, where plain sums and Neumaier's stop growing") {
    const int count = 40000000;
    ljus::CompensatedSumT<float> total;
    float plain = 0;
    float neumaier = 0;
    float gathered = 0;
    for (int i = 0; i < count; ++i) {
        ljus::add(total, 1.0f);
        plain += 1.0f;
        const float next = neumaier + 1.0f;
        gathered +=
            neumaier >= 1.0f ? (neumaier - next) + 1.0f : (1.0f - next) + neumaier;
        neumaier = next;
    }
    CHECK(total.sum == 4e7f);
    CHECK(plain == 16777216.0f);
    CHECK(neumaier + gathered == 33554432.0f);
    CHECK(ljus::detail::pairwise_sum(std::vector<float>(1 << 25, 1.0f)) == 33554432.0f);
}

TEST_CASE("sum: infinity and NaN stay") {
    constexpr double inf = std::numeric_limits<double>::infinity();
    CHECK(ljus::compensated_sum(std::array{1.0, inf, 1.0}) == inf);
    CHECK(ljus::compensated_sum(std::array{1.0, -inf, 1.0}) == -inf);
    CHECK(std::isnan(ljus::compensated_sum(std::array{inf, -inf, 1.0})));
    CHECK(std::isnan(ljus::compensated_sum(std::array{1.0, std::nan(""), 1.0})));
    CHECK(ljus::compensated_sum(std::array{1e308, 1e308}) == inf);
    CHECK(ljus::detail::pairwise_sum(std::array{1.0, inf, 1.0}) == inf);
}

TEST_CASE("sum: pairwise sums of nothing, of one, of colours") {
    CHECK(ljus::detail::pairwise_sum(std::vector<double>{}) == 0.0);
    CHECK(ljus::detail::pairwise_sum(std::vector<double>{3.0}) == 3.0);
    const std::vector<ljus::Rgb> colours(1000, ljus::Rgb{1, 2, 3});
    CHECK(ljus::detail::pairwise_sum(colours) == ljus::Rgb{1000, 2000, 3000});
    CHECK(ljus::detail::pairwise_sum(std::vector<ljus::Rgb>{}) == ljus::Rgb{0, 0, 0});
}
