#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/math/sum.hpp"
#include "ljus/math/vector.hpp"

namespace {

float plain_sum(const std::vector<float>& terms) {
    float sum = 0;
    for (const float term : terms) sum += term;
    return sum;
}

} // namespace

TEST_CASE("sum: in float, by halves, it is exact within a few units") {
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
    CHECK(std::abs(static_cast<double>(ljus::detail::pairwise_sum(terms)) - right) <=
          8 * unit);
    CHECK(std::abs(static_cast<double>(plain_sum(terms)) - right) > 20 * unit);
}

TEST_CASE("sum: many equal terms do not stop it") {
    CHECK(ljus::detail::pairwise_sum(std::vector<float>(1 << 25, 1.0f)) == 33554432.0f);
}

TEST_CASE("sum: infinity stays") {
    constexpr double inf = std::numeric_limits<double>::infinity();
    CHECK(ljus::detail::pairwise_sum(std::array{1.0, inf, 1.0}) == inf);
}

TEST_CASE("sum: pairwise sums of nothing, of one, of colours") {
    CHECK(ljus::detail::pairwise_sum(std::vector<double>{}) == 0.0);
    CHECK(ljus::detail::pairwise_sum(std::vector<double>{3.0}) == 3.0);
    const std::vector<ljus::Rgb> colours(1000, ljus::Rgb{1, 2, 3});
    CHECK(ljus::detail::pairwise_sum(colours) == ljus::Rgb{1000, 2000, 3000});
    CHECK(ljus::detail::pairwise_sum(std::vector<ljus::Rgb>{}) == ljus::Rgb{0, 0, 0});
}

namespace {

/// A number that knows through how many additions its terms have gone at most.
struct Counted {
    double value = 0;
    int additions = 0;
    Counted() = default;
    Counted(double x) : value(x) {} // NOLINT: as 0 is of any number
    friend Counted operator+(const Counted& a, const Counted& b) {
        Counted sum(a.value + b.value);
        sum.additions = std::max(a.additions, b.additions) + 1;
        return sum;
    }
};

} // namespace

TEST_CASE("sum: no term goes through more than 16 + log2(n) additions") {
    for (const std::size_t n :
         {1u, 2u, 15u, 16u, 17u, 31u, 33u, 100u, 1000u, 1024u, 4097u, 100003u}) {
        const Counted sum = ljus::detail::pairwise_sum(std::vector<Counted>(n, 1.0));
        CHECK(sum.value == double(n));
        CHECK(sum.additions <= 16 + std::ceil(std::log2(double(n))));
    }
    // Short runs are plain: that is where the speed is.
    CHECK(ljus::detail::pairwise_sum(std::vector<Counted>(16, 1.0)).additions == 16);
}
