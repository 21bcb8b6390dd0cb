/// \file sampling_pattern_test.cpp
/// \brief Four ways to spread the rays of a pixel: as many points as asked for, each of
/// them uniform, and an error that falls as theory has it.
///
/// Statistical tests have a false-alarm rate of one in a million each, and are the same
/// at every run. Run with 20 further seeds: none failed.

#include "ljus/math/sampling_pattern.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <vector>

#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::chi_square;
using ljus_test::chi_square_limit;
using ljus_test::test_seed;

namespace {

constexpr Sampling all[] = {Sampling::random, Sampling::jittered,
                            Sampling::multi_jittered, Sampling::sobol};

/// The share of the unit square on one side of a line, by clipping its corners: nothing
/// of what is tested.
double share_below(double c, double s, double offset) {
    const std::array<glm::dvec2, 4> corners{{{0, 0}, {1, 0}, {1, 1}, {0, 1}}};
    const auto side = [&](const glm::dvec2& p) {
        return (p.x - 0.5) * c + (p.y - 0.5) * s - offset;
    };
    std::vector<glm::dvec2> kept;
    for (std::size_t i = 0; i < 4; ++i) {
        const glm::dvec2 a = corners[i], b = corners[(i + 1) % 4];
        const double fa = side(a), fb = side(b);
        if (fa < 0) kept.push_back(a);
        if ((fa < 0) != (fb < 0)) kept.push_back(a + fa / (fa - fb) * (b - a));
    }
    double area = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        const glm::dvec2 a = kept[i], b = kept[(i + 1) % kept.size()];
        area += (a.x * b.y - a.y * b.x) / 2;
    }
    return area;
}

/// The errors of the mean over a pixel, one for each key: of what is smooth, and of
/// edges that cross it in all directions.
struct SquaredErrors {
    std::vector<double> smooth, edge;
};

SquaredErrors squared_errors(Sampling sampling, int count, int keys) {
    const Pattern pattern = make_pattern(sampling, count);
    const double exact = (std::numbers::e - 1) / 2 + 0.25; // of e^x y + x y
    SquaredErrors found;
    for (std::uint64_t key = 0; key < std::uint64_t(keys); ++key) {
        RandomStream stream = random_stream(test_seed(5), Pass::user, 0, key);
        const double angle = 2 * std::numbers::pi * next_1d<double>(stream);
        const double offset = 0.6 * (next_1d<double>(stream) - 0.5);
        const double c = std::cos(angle), s = std::sin(angle);
        double smooth = 0, below = 0;
        for (int i = 0; i < count; ++i) {
            const Vec2T<double> p =
                spread(pattern, i, test_seed(key), next_2d<double>(stream));
            smooth += (std::exp(p.x) + p.x) * p.y;
            below += (p.x - 0.5) * c + (p.y - 0.5) * s < offset;
        }
        found.smooth.push_back(std::pow(smooth / count - exact, 2));
        found.edge.push_back(std::pow(below / count - share_below(c, s, offset), 2));
    }
    return found;
}

/// The rms of these errors.
struct Errors {
    double smooth = 0, edge = 0;
};

Errors errors(Sampling sampling, int count, int keys = 400) {
    const SquaredErrors found = squared_errors(sampling, count, keys);
    const auto rms = [&](const std::vector<double>& squares) {
        return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) / keys);
    };
    return {rms(found.smooth), rms(found.edge)};
}

/// The exponents of n by which the errors fall, by least squares.
Errors slopes(Sampling sampling, const std::vector<int>& counts) {
    double n = 0, x = 0, xx = 0;
    glm::dvec2 y(0), xy(0);
    for (const int count : counts) {
        const Errors e = errors(sampling, count);
        const double lx = std::log(double(count));
        const glm::dvec2 ly(std::log(e.smooth), std::log(e.edge));
        n += 1, x += lx, xx += lx * lx, y += ly, xy += lx * ly;
    }
    const glm::dvec2 slope = (n * xy - x * y) / (n * xx - x * x);
    return {slope.x, slope.y};
}

} // namespace

TEST_CASE_TEMPLATE("sampling_pattern: any count has its points, within the pixel", T,
                   float, double) {
    for (const int count : {1, 2, 3, 7, 8, 10, 13, 97, 100, 1000, 1009, 99991, 100000})
        for (const Sampling sampling : all) {
            const Pattern pattern = make_pattern(sampling, count);
            CHECK(pattern.points == count);
            bool inside = true;
            for (int i = 0; i < count; ++i)
                for (const T corner :
                     {T(0), T(1) - std::numeric_limits<T>::epsilon()}) {
                    const Vec2T<T> p = spread(pattern, i, 9, Vec2T<T>{corner});
                    inside = inside && p.x >= 0 && p.y >= 0 && p.x <= 1 && p.y <= 1;
                }
            CAPTURE(count);
            CHECK(inside);
        }
    // A product of the columns and the rows of so many points has 32 bits.
    constexpr int most = std::numeric_limits<int>::max();
    constexpr Vec2T<double> last = spread(make_pattern(Sampling::multi_jittered, most),
                                          most - 1, 9, Vec2T<double>{0.5, 0.5});
    CHECK(last.x < 1);
}

TEST_CASE(
    "sampling_pattern: multi-jittered with any count: one point in each of n strips "
    "of x and of y, and a grid of cells") {
    std::vector<int> counts(400);
    for (int i = 0; i < 400; ++i) counts[std::size_t(i)] = i + 1;
    for (const int more : {997, 1000, 1009, 4095, 4096, 4097, 65537})
        counts.push_back(more);
    for (const int count : counts) {
        const Pattern pattern = make_pattern(Sampling::multi_jittered, count);
        const int m = pattern.strata.columns, n = pattern.strata.rows;
        CAPTURE(count);
        REQUIRE((m * n >= count && m * (n - 1) < count));
        REQUIRE((m <= n && n <= 2 * m + 2)); // not far from square
        for (const std::uint64_t key : {42u, 43u, 44u}) {
            std::vector<int> of_x(std::size_t(count), -1), of_y = of_x;
            for (int i = 0; i < count; ++i) {
                const auto p = spread(pattern, i, key, Vec2T<double>{0.5});
                // In the middle of its strip, so that no rounding can move it out.
                int& column = of_x[std::size_t(p.x * count)];
                int& row = of_y[std::size_t(p.y * count)];
                REQUIRE((column == -1 && row == -1)); // so that each has one
                column = row = i;
            }
            // The m points of a row of cells stand in m columns: the next one is never
            // farther than two columns.
            for (int row = 0; row * m + m <= count; ++row) {
                int gap = 0, worst = 0, seen = 0;
                for (int x = 0; x < 2 * count; ++x) {
                    const bool here = of_x[std::size_t(x % count)] / m == row;
                    seen += here;
                    gap = here ? 0 : gap + 1;
                    worst = std::max(worst, gap);
                }
                REQUIRE((seen == 2 * m && worst <= 2 * n));
                if (count > 400) break; // one row will do
            }
        }
    }
    // A grid without a remainder where one is near to a square.
    const auto cells = [](int count) {
        const auto strata = make_pattern(Sampling::multi_jittered, count).strata;
        return std::array<int, 2>{strata.columns, strata.rows};
    };
    CHECK(cells(32) == std::array<int, 2>{4, 8});
    CHECK(cells(200) == std::array<int, 2>{10, 20});
    CHECK(cells(1000) == std::array<int, 2>{25, 40});
    CHECK(cells(61) == std::array<int, 2>{7, 9}); // a prime: 5 of 7 in the last row
}

TEST_CASE(
    "sampling_pattern: multi-jittered with a broken row: a strip holds each row as "
    "often as any other does") {
    // Over the keys, each strip of x with each strip of y: else a mean would be off.
    for (const int count : {5, 7, 11, 13}) {
        const Pattern pattern = make_pattern(Sampling::multi_jittered, count);
        std::vector<int> pairs(std::size_t(count * count));
        for (std::uint64_t key = 0; key < 60000; ++key)
            for (int i = 0; i < count; ++i) {
                const auto p = spread(pattern, i, test_seed(key), Vec2T<double>{0.5});
                ++pairs[std::size_t(p.x * count) * std::size_t(count) + std::size_t(i)];
            }
        CAPTURE(count);
        // A table with all sums of rows and columns fixed has (n - 1)^2 degrees.
        CHECK(chi_square(pairs) < chi_square_limit((count - 1) * (count - 1)));
    }
}

TEST_CASE(
    "sampling_pattern: Sobol, the first n of 2^k points: at most one in each cell "
    "of each dyadic grid") {
    for (const int count : {1, 2, 5, 16, 61, 64, 100, 128})
        for (const std::uint64_t key : {0u, 1u, 77u}) {
            int k = 0;
            while (1 << k < count) ++k;
            const Pattern pattern = make_pattern(Sampling::sobol, count);
            for (int a = 0; a <= k; ++a) {
                std::vector<int> cells(std::size_t(1) << k);
                for (int i = 0; i < count; ++i) {
                    const auto p = spread(pattern, i, key, Vec2T<double>{0});
                    ++cells[(std::size_t(std::ldexp(p.x, a)) << (k - a)) +
                            std::size_t(std::ldexp(p.y, k - a))];
                }
                CHECK(*std::max_element(cells.begin(), cells.end()) == 1);
            }
        }
}

TEST_CASE("sampling_pattern: each point is uniform over the pixels, and all together") {
    for (const Sampling sampling : all)
        for (const int count : {1, 5, 7, 16}) {
            const Pattern pattern = make_pattern(sampling, count);
            std::vector<int> together(400), last(400);
            for (std::uint64_t key = 0; key < 40000; ++key) {
                RandomStream stream = random_stream(test_seed(1), Pass::user, 0, key);
                for (int i = 0; i < count; ++i) {
                    const Vec2 p = spread(pattern, i, test_seed(key), next_2d(stream));
                    const int x = std::min(19, int(p.x * 20)),
                              y = std::min(19, int(p.y * 20));
                    ++together[std::size_t(20 * y + x)];
                    // One point of Sobol alone is uniform. One of a multi-jittered
                    // pattern has its row; in x it has no home.
                    const bool sobol = sampling == Sampling::sobol;
                    if (i == count - 1)
                        ++last[std::size_t(20 * (sobol ? y : int(key % 20)) + x)];
                }
            }
            CAPTURE(count);
            CAPTURE(int(sampling));
            CHECK(chi_square(together) < chi_square_limit(399));
            if (sampling != Sampling::jittered)
                CHECK(chi_square(last) < chi_square_limit(399));
        }
}

TEST_CASE("sampling_pattern: neighbouring pixels do not repeat each other") {
    for (std::uint64_t key = 0; key < 1000; ++key) {
        const auto here = detail::scrambled_sobol<double>(0, key);
        const auto there = detail::scrambled_sobol<double>(0, key + 1);
        CHECK(here.x != there.x);
        CHECK(here.y != there.x);
        CHECK(here.x != here.y);
    }
    // Where the point of one stands says nothing of where that of its neighbour does.
    std::vector<int> pairs(256);
    for (std::uint64_t pair = 0; pair < 1 << 20; ++pair) {
        const auto place = [&](std::uint64_t key) {
            const auto p = detail::scrambled_sobol<double>(0, test_seed(key));
            return static_cast<std::size_t>(16 * p.x);
        };
        ++pairs[16 * place(2 * pair) + place(2 * pair + 1)];
    }
    CHECK(chi_square(pairs) < chi_square_limit(255));
    // The errors of two neighbours are as often of equal as of opposite sign: 4000
    // coins, 5 standard errors.
    for (const Sampling sampling : all) {
        const Pattern pattern = make_pattern(sampling, 13);
        int equal = 0;
        double before = 0;
        for (std::uint64_t key = 0; key <= 4000; ++key) {
            RandomStream stream = random_stream(test_seed(2), Pass::user, 0, key);
            double sum = -13.0 / 4; // the mean of a product is 1/4
            for (int i = 0; i < 13; ++i) {
                const auto p =
                    spread(pattern, i, test_seed(key), next_2d<double>(stream));
                sum += p.x * p.y;
            }
            equal += sum * before > 0;
            before = sum;
        }
        CAPTURE(int(sampling));
        CHECK(std::abs(equal - 2000) < 5 * 32);
    }
}

TEST_CASE("sampling_pattern: the error falls as theory has it, where light is smooth "
          "and at edges") {
    const std::vector<int> squares{16, 64, 256, 1024};
    const auto near = [](double value, double exponent) {
        return std::abs(value - exponent) < 0.08;
    };
    const Errors chance = slopes(Sampling::random, squares);
    CHECK(near(chance.smooth, -0.5));
    CHECK(near(chance.edge, -0.5));
    const Errors jittered = slopes(Sampling::jittered, squares);
    CHECK(near(jittered.smooth, -1));
    CHECK(near(jittered.edge, -0.75));
    const Errors kensler = slopes(Sampling::multi_jittered, squares);
    CHECK(kensler.smooth < -0.7);
    CHECK(near(kensler.edge, -0.75));
    const Errors sobol = slopes(Sampling::sobol, squares);
    CHECK(sobol.smooth < -1.35);
    CHECK(near(sobol.edge, -0.75));
}

TEST_CASE("sampling_pattern: primes do as well as squares; n_rooks do not") {
    // Each ratio has a standard error of 3 %.
    constexpr int keys = 1600;
    const Errors square = errors(Sampling::multi_jittered, 256, keys);
    const Errors prime = errors(Sampling::multi_jittered, 257, keys);
    CHECK(prime.smooth < 1.3 * square.smooth);
    CHECK(prime.edge < 1.2 * square.edge);
    CHECK(errors(Sampling::sobol, 257, keys).edge < 1.35 * square.edge);
    const Errors n_rooks = errors(Sampling::jittered, 257, keys);
    CHECK(n_rooks.smooth > 2 * prime.smooth);
    CHECK(n_rooks.edge > 2 * prime.edge);
}

TEST_CASE("sampling_pattern: at an edge the default is the best of the four") {
    // 24 comparisons of mean squares over the same edges. If two patterns are equally
    // good, the difference of the means is below 5.4 of its standard errors but once
    // in 3e7 times: one false alarm in a million runs of all 24.
    constexpr int keys = 4000;
    for (const int count : {4, 7, 16, 61, 64, 97, 100, 256}) {
        const auto mine = squared_errors(Pattern{}.sampling, count, keys).edge;
        for (const Sampling other :
             {Sampling::random, Sampling::jittered, Sampling::sobol}) {
            const auto theirs = squared_errors(other, count, keys).edge;
            ljus_test::Mean worse;
            for (std::size_t i = 0; i < mine.size(); ++i)
                worse.add(mine[i] - theirs[i]);
            CAPTURE(count);
            CAPTURE(int(other));
            CHECK(worse.mean < 5.4 * worse.error());
        }
    }
}
