/// \file stratified_test.cpp
/// \brief Primary rays: the requested number, spread evenly, for any number.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/math/sampling_pattern.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <vector>

#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::chi_square;
using ljus_test::chi_square_limit;

TEST_CASE("stratified: as many cells as rays, as square as the number allows") {
    const auto is = [](int rays, int columns, int rows, bool n_rooks) {
        const detail::Strata s = detail::strata_for(rays);
        return s.columns == columns && s.rows == rows && s.n_rooks == n_rooks;
    };
    CHECK(is(1, 1, 1, false));
    CHECK(is(2, 1, 2, false));
    CHECK(is(8, 2, 4, false));
    CHECK(is(10, 2, 5, false));
    CHECK(is(64, 8, 8, false));
    CHECK(is(100, 10, 10, false));
    CHECK(is(200, 10, 20, false));
    CHECK(is(1000, 25, 40, false));
    CHECK(is(5, 5, 5, true));
    CHECK(is(7, 7, 7, true));
    CHECK(is(997, 997, 997, true));
    CHECK(is(2 * 499, 998, 998, true));
    CHECK(is(2147483647, 2147483647, 2147483647, true)); // a prime; no overflow
}

TEST_CASE("stratified: rooks stand only where no grid is square enough") {
    for (int rays = 1; rays <= 1000; ++rays) {
        bool grid = false; // some division with sides of 1 : 4 at most
        for (int columns = 1; columns <= rays; ++columns)
            grid = grid || (rays % columns == 0 && columns <= rays / columns &&
                            rays / columns <= 4 * columns);
        const detail::Strata s = detail::strata_for(rays);
        CAPTURE(rays);
        REQUIRE(s.n_rooks == !grid);
        if (s.n_rooks)
            REQUIRE((s.columns == rays && s.rows == rays));
        else
            REQUIRE(s.columns * s.rows == rays);
    }
}

TEST_CASE_TEMPLATE("stratified: of 1 to 1000 rays each has a cell of its own", T, float,
                   double) {
    for (int rays = 1; rays <= 1000; ++rays) {
        const detail::Strata s = detail::strata_for(rays);
        std::set<int> cells;
        std::vector<bool> column(std::size_t(s.columns)), row(std::size_t(s.rows));
        for (int i = 0; i < rays; ++i) {
            // The middle of the cell, and its far corner, which rounding may reach.
            const auto middle = detail::stratified(s, i, 42, Vec2T<T>{T(0.5)});
            const int x = int(middle.x * T(s.columns)), y = int(middle.y * T(s.rows));
            cells.insert(y * s.columns + x);
            column[std::size_t(x)] = row[std::size_t(y)] = true;
            const T last = T(1) - std::numeric_limits<T>::epsilon() / 2;
            const auto corner = detail::stratified(s, i, 42, Vec2T<T>{last});
            REQUIRE(corner.x <= T(x + 1) / T(s.columns));
            REQUIRE(corner.y <= T(y + 1) / T(s.rows));
            const auto near = detail::stratified(s, i, 42, Vec2T<T>{0});
            REQUIRE(near.x == T(x) / T(s.columns));
            REQUIRE(near.y == T(y) / T(s.rows));
        }
        CAPTURE(rays);
        REQUIRE(cells.size() == std::size_t(rays));
        // And none of its columns and rows is empty.
        REQUIRE(std::count(column.begin(), column.end(), false) == 0);
        REQUIRE(std::count(row.begin(), row.end(), false) == 0);
    }
}

TEST_CASE("stratified: shuffled() is a permutation for every count") {
    std::vector<bool> seen;
    for (std::uint32_t count = 1; count <= 2000; ++count)
        for (const std::uint64_t key : {0u, 1u, 12345u}) {
            seen.assign(count, false);
            for (std::uint32_t i = 0; i < count; ++i) {
                const std::uint32_t place = detail::shuffled(i, count, key);
                REQUIRE(place < count);
                REQUIRE_FALSE(seen[place]);
                seen[place] = true;
            }
        }
}

TEST_CASE("stratified: over the keys every place is as likely as any other") {
    // Neighbouring keys, as neighbouring pixels have. A false alarm once in a million.
    for (const std::uint32_t count : {2u, 3u, 5u, 7u, 11u, 13u, 37u, 101u}) {
        std::vector<int> places(count * count);
        for (std::uint64_t key = 0; key < 20000; ++key)
            for (std::uint32_t i = 0; i < count; ++i)
                ++places[i * count + detail::shuffled(i, count, key)];
        CAPTURE(count);
        // Each row and each column of this table is fixed: (count - 1)^2 are free.
        const double free = double((count - 1) * (count - 1));
        CHECK(chi_square(places) < chi_square_limit(free));
    }
}

TEST_CASE("stratified: keys give different orders") {
    std::set<std::vector<std::uint32_t>> orders;
    for (std::uint64_t key = 0; key < 1000; ++key) {
        std::vector<std::uint32_t> order;
        for (std::uint32_t i = 0; i < 13; ++i)
            order.push_back(detail::shuffled(i, 13, key));
        orders.insert(order);
    }
    CHECK(orders.size() > 500);
}

TEST_CASE_TEMPLATE("stratified: uniform over the pixel, in a grid and with rooks", T,
                   float, double) {
    // 60 x 60 cells fall across the strata. Stratified counts scatter less than
    // independent ones, so the limit is generous.
    for (const int rays : {1, 6, 7, 10, 13, 16, 97}) {
        const detail::Strata s = detail::strata_for(rays);
        std::vector<int> area(3600), x_only(60), y_only(60);
        for (std::uint64_t pixel = 0; pixel < 400000u / unsigned(rays); ++pixel) {
            RandomStream stream =
                random_stream(ljus_test::test_seed(1), Pass::user, 0, pixel);
            for (int i = 0; i < rays; ++i) {
                const auto p = detail::stratified(s, i, pixel, next_2d<T>(stream));
                const int x = std::min(59, int(p.x * 60)),
                          y = std::min(59, int(p.y * 60));
                ++area[std::size_t(60 * y + x)];
                ++x_only[std::size_t(x)];
                ++y_only[std::size_t(y)];
            }
        }
        CAPTURE(rays);
        CHECK(chi_square(area) < chi_square_limit(3599));
        CHECK(chi_square(x_only) < chi_square_limit(59));
        CHECK(chi_square(y_only) < chi_square_limit(59));
    }
}

TEST_CASE("stratified: an edge through the pixel is seen better than by chance") {
    // The share of the pixel left of x + y/3 = 2/3 is 1/2; its error falls.
    for (const int rays : {7, 16, 97, 100}) {
        const detail::Strata s = detail::strata_for(rays);
        double strata_error = 0, chance_error = 0;
        for (std::uint64_t pixel = 0; pixel < 2000; ++pixel) {
            RandomStream stream =
                random_stream(ljus_test::test_seed(2), Pass::user, 0, pixel);
            int strata_left = 0, chance_left = 0;
            for (int i = 0; i < rays; ++i) {
                const Vec2 u = next_2d(stream);
                const Vec2 p = detail::stratified(s, i, pixel, u);
                strata_left += p.x + p.y / 3 < 2.0f / 3;
                chance_left += u.x + u.y / 3 < 2.0f / 3;
            }
            strata_error += std::pow(double(strata_left) / rays - 0.5, 2);
            chance_error += std::pow(double(chance_left) / rays - 0.5, 2);
        }
        CAPTURE(rays);
        CHECK(strata_error < 0.5 * chance_error);
    }
}
