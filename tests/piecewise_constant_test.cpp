#include <doctest/doctest.h>

#include <array>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <vector>

#include "ljus/math/piecewise_constant.hpp"
#include "support/refusal.hpp"

using namespace ljus;

namespace {

constexpr int width = 5, height = 3;
constexpr std::array<double, 15> weights{0, 1, 2, 0, 1, 0,    0, 0,
                                         0, 0, 4, 0, 1, 1e-9, 6};
constexpr double sum = 15 + 1e-9;

double weight_at(int x, int y) {
    return weights[static_cast<std::size_t>(y * width + x)];
}

} // namespace

TEST_CASE("piecewise_constant: the probability of a cell is its part of all weight") {
    const auto density = make_piecewise_constant(width, height, weight_at);
    double all = 0;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            const double p = probability_of_cell(density, x, y);
            CHECK(p == doctest::Approx(weight_at(x, y) / sum).epsilon(1e-6));
            all += p;
        }
    CHECK(all == doctest::Approx(1));
}

TEST_CASE_TEMPLATE(
    "piecewise_constant: even numbers fall in proportion, evenly in each", T, float,
    double) {
    const auto density = make_piecewise_constant(width, height, weight_at);
    constexpr int n = 512;
    std::array<double, 15> counts{}, across{}, down{};
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const auto cell = sample_cell(
                density, Vec2T<T>{(T(i) + T(0.5)) / n, (T(j) + T(0.5)) / n});
            const auto at = static_cast<std::size_t>(cell.y * width + cell.x);
            counts[at] += 1;
            across[at] += double(cell.within.x);
            down[at] += double(cell.within.y);
            REQUIRE(cell.within.x >= 0);
            REQUIRE(cell.within.x <= 1);
            REQUIRE(cell.within.y >= 0);
            REQUIRE(cell.within.y <= 1);
        }
    for (std::size_t i = 0; i < counts.size(); ++i) {
        CAPTURE(i);
        // A border of a cell is off by at most one number in each row and column.
        CHECK(std::abs(counts[i] - n * n * weights[i] / sum) <= 2 * n);
        if (weights[i] == 0) CHECK(counts[i] == 0);
        if (weights[i] < 1) continue;
        CHECK(across[i] / counts[i] == doctest::Approx(0.5).epsilon(0.02));
        CHECK(down[i] / counts[i] == doctest::Approx(0.5).epsilon(0.02));
    }
}

TEST_CASE_TEMPLATE("piecewise_constant: the ends of u choose cells with weight", T,
                   float, double) {
    // Nothing at either end, nor in the last row.
    const auto density = make_piecewise_constant(
        4, 3, [](int x, int y) { return y < 2 && (x == 1 || x == 2) ? 3.0 : 0.0; });
    constexpr T last = T(1) - std::numeric_limits<T>::epsilon() / 2;
    for (const T u : {T(0), last})
        for (const T v : {T(0), last}) {
            const auto cell = sample_cell(density, Vec2T<T>{u, v});
            CHECK(cell.x == (u == T(0) ? 1 : 2));
            CHECK(cell.y == (v == T(0) ? 0 : 1));
        }
    const auto one = make_piecewise_constant(1, 1, [](int, int) { return 7.0; });
    const auto cell = sample_cell(one, Vec2T<T>{T(0.25), T(0.75)});
    CHECK(cell.within == Vec2T<T>{T(0.25), T(0.75)});
}

TEST_CASE("piecewise_constant: one cell a billion times as heavy leaves the others") {
    const auto density = make_piecewise_constant(
        1000, 1, [](int x, int) { return x == 300 ? 1e12 : 1.0 + x % 2; });
    double dark = 0;
    for (int x = 0; x < 1000; ++x)
        if (x != 300) dark += probability_of_cell(density, x, 0);
    CHECK(dark * 1e12 == doctest::Approx(1499).epsilon(1e-4));
    CHECK(probability_of_cell(density, 999, 0) * 1e12 ==
          doctest::Approx(2).epsilon(1e-3));
}

TEST_CASE("piecewise_constant: no weight at all is refused") {
    CHECK(ljus_test::refusal([] {
              (void)make_piecewise_constant(2, 2, [](int, int) { return 0.0; });
          }) == "the sum of all weights is 0; it must be finite and above 0.");
}
