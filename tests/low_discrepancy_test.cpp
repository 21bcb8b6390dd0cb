/// \file low_discrepancy_test.cpp
/// \brief Sobol's points are nets, stay nets when they are scrambled, and are then
/// uniform one by one.
///
/// Statistical tests have a false-alarm rate of one in a million each, and are the same
/// at every run. Run with 20 further seeds: none failed.

#include "ljus/math/low_discrepancy.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <set>
#include <vector>

#include "support/numbers.hpp"
#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;
using ljus_test::chi_square;
using ljus_test::chi_square_limit;

namespace {

/// Owen's scrambling as he defines it: a coin for each bit and each pattern of bits
/// above it.
std::uint32_t owen_by_definition(std::uint32_t bits, std::uint64_t seed) {
    std::uint32_t result = 0;
    for (int bit = 31; bit >= 0; --bit) {
        const std::uint64_t above = bit == 31 ? 0 : bits >> (bit + 1);
        const std::uint64_t coin =
            mix_bits(mix_bits(mix_bits(seed) + static_cast<std::uint64_t>(bit)) +
                     above) >>
            63;
        result |= (((bits >> bit) & 1u) ^ static_cast<std::uint32_t>(coin)) << bit;
    }
    return result;
}

/// A coordinate of the first points, plain or scrambled.
std::uint32_t coordinate(std::uint32_t i, std::uint32_t d, std::uint64_t seed) {
    return seed == 0 ? detail::sobol(i, d)
                     : detail::owen_scrambled(detail::sobol(i, d), seed + d);
}

/// The least t for which 2^m points in two dimensions are a (t,m,2)-net: each cell of
/// 2^-a by 2^-b with a + b = m - t holds 2^t of them.
int quality(std::uint32_t d, std::uint32_t e, int m, std::uint64_t seed) {
    for (int t = 0; t <= m; ++t) {
        bool net = true;
        for (int a = 0; a <= m - t && net; ++a) {
            const int b = m - t - a;
            std::vector<int> cells(std::size_t(1) << (m - t));
            for (std::uint32_t i = 0; i < 1u << m; ++i) {
                const std::uint64_t x = coordinate(i, d, seed),
                                    y = coordinate(i, e, seed);
                ++cells[static_cast<std::size_t>((x >> (32 - a)) << b | y >> (32 - b))];
            }
            for (const int count : cells) net = net && count == 1 << t;
        }
        if (net) return t;
    }
    return m;
}

/// How the rms error of a mean over the square falls with the number of points.
template <typename F>
double error_slope(F f, double exact, bool low_discrepancy) {
    std::vector<double> counts, errors;
    for (int m = 4; m <= 12; m += 2) {
        double squares = 0;
        for (std::uint64_t seed = 1; seed <= 64; ++seed) {
            double sum = 0;
            for (std::uint64_t i = 0; i < std::uint64_t(1) << m; ++i) {
                auto s = sobol_stream(ljus_test::test_seed(seed), Pass::user, 0, i);
                auto r = random_stream(ljus_test::test_seed(seed), Pass::user, 0, i);
                sum += f(low_discrepancy ? next_2d<double>(s) : next_2d<double>(r));
            }
            const double error = sum / double(1 << m) - exact;
            squares += error * error / 64;
        }
        counts.push_back(std::log(1 << m));
        errors.push_back(std::log(squares) / 2);
    }
    return ljus_test::slope(counts, errors);
}

} // namespace

TEST_CASE("low_discrepancy: the first points, by hand") {
    // 0, 1/2, 1/4, 3/4, ... in dimension 0; 0, 1/2, 3/4, 1/4 in dimension 1.
    const std::uint32_t quarter = 1u << 30;
    const std::uint32_t first[][2] = {{0, 0}, {2, 2}, {1, 3}, {3, 1}};
    for (std::uint32_t i = 0; i < 4; ++i)
        for (std::uint32_t d = 0; d < 2; ++d)
            CHECK(detail::sobol(i, d) == first[i][d] * quarter);
    CHECK(detail::sobol(1, 15) == 1u << 31);
    CHECK(detail::reversed_bits(1) == 1u << 31);
    CHECK(detail::reversed_bits(0x12345678u) == 0x1e6a2c48u);
}

TEST_CASE("low_discrepancy: the direction numbers are those of Joe and Kuo") {
    // Their file new-joe-kuo-6.21201: degree s, coefficients a, and m_1 to m_s; and the
    // recurrence as they print it, on the odd integers m_k.
    struct Line {
        unsigned s, a;
        std::vector<std::uint32_t> m;
    };
    const std::vector<Line> lines = {
        {1, 0, {1}},
        {2, 1, {1, 3}},
        {3, 1, {1, 3, 1}},
        {3, 2, {1, 1, 1}},
        {4, 1, {1, 1, 3, 3}},
        {4, 4, {1, 3, 5, 13}},
        {5, 2, {1, 1, 5, 5, 17}},
        {5, 4, {1, 1, 5, 5, 5}},
        {5, 7, {1, 1, 7, 11, 19}},
        {5, 11, {1, 1, 5, 1, 1}},
        {5, 13, {1, 1, 1, 3, 11}},
        {5, 14, {1, 3, 5, 5, 31}},
        {6, 1, {1, 3, 3, 9, 7, 49}},
        {6, 13, {1, 1, 1, 15, 21, 21}},
        {6, 16, {1, 3, 1, 13, 27, 49}},
    };
    REQUIRE(lines.size() + 1 == detail::sobol_dimensions);
    for (std::size_t d = 0; d < lines.size(); ++d) {
        std::vector<std::uint32_t> m = lines[d].m;
        const unsigned s = lines[d].s;
        REQUIRE(m.size() == s);
        while (m.size() < 32) {
            const std::size_t k = m.size();
            std::uint32_t next = m[k - s] ^ (m[k - s] << s);
            for (unsigned j = 1; j < s; ++j)
                if ((lines[d].a >> (s - 1 - j) & 1u) != 0) next ^= m[k - j] << j;
            m.push_back(next);
        }
        std::uint32_t all = 0; // of the bits 0 to k
        for (std::uint32_t k = 0; k < 32; ++k) {
            CAPTURE(d);
            CAPTURE(k);
            const auto dimension = static_cast<std::uint32_t>(d + 1);
            CHECK(detail::sobol(1u << k, dimension) == m[k] << (31 - k));
            CHECK(detail::sobol(1u << k, 0) == 1u << (31 - k));
            all ^= m[k] << (31 - k);
            CHECK(detail::sobol(~0u >> (31 - k), dimension) == all);
        }
    }
}

TEST_CASE("low_discrepancy: in each dimension the first 2^m points lie one in a cell") {
    for (const std::uint64_t seed : {0u, 1u, 77u})
        for (std::uint32_t d = 0; d < detail::sobol_dimensions; ++d)
            for (const int m : {1, 4, 9, 14}) {
                std::vector<bool> taken(std::size_t(1) << m);
                for (std::uint32_t i = 0; i < 1u << m; ++i)
                    taken[coordinate(i, d, seed) >> (32 - m)] = true;
                std::size_t cells = 0;
                for (const bool cell : taken) cells += cell ? 1 : 0;
                CHECK(cells == taken.size());
            }
}

TEST_CASE("low_discrepancy: dimensions 0 and 1 are a (0,m,2)-net, scrambled or not") {
    for (const std::uint64_t seed : {0u, 1u, 2u, 99u})
        for (const int m : {1, 2, 5, 8, 11}) {
            CAPTURE(seed);
            CAPTURE(m);
            CHECK(quality(0, 1, m, seed) == 0);
        }
}

TEST_CASE("low_discrepancy: any two dimensions are a net, and scrambling keeps its t") {
    // t is at most the sum of the degrees of the polynomials less one each (Sobol).
    const int degree[] = {1, 1, 2, 3, 3, 4, 4, 5, 5, 5, 5, 5, 5, 6, 6, 6};
    for (std::uint32_t d = 0; d < detail::sobol_dimensions; ++d)
        for (std::uint32_t e = 0; e < d; ++e) {
            const int t = quality(e, d, 8, 0);
            CAPTURE(d);
            CAPTURE(e);
            CHECK(t <= degree[d] + degree[e] - 2);
            if (e % 5 == 0) CHECK(quality(e, d, 8, 3) == t);
        }
}

TEST_CASE(
    "low_discrepancy: the scrambling is a bijection that exchanges dyadic cells") {
    ljus_test::Numbers n;
    for (int test = 0; test < 2000; ++test) {
        const auto a = static_cast<std::uint32_t>(n.below(1 << 30)) * 4u + 1u;
        const int level = n.below(32); // the first bit, from above, that differs
        const std::uint32_t b = a ^ (0x80000000u >> level);
        const auto seed = static_cast<std::uint64_t>(test);
        const std::uint32_t apart =
            detail::owen_scrambled(a, seed) ^ detail::owen_scrambled(b, seed);
        // They part at the same bit, neither before nor after.
        CHECK((apart >> (31 - level)) == 1u);
    }
}

TEST_CASE("low_discrepancy: one point is uniform over the seeds, by cells and in pairs "
          "of dimensions, as by Owen's definition") {
    for (const bool definition : {false, true})
        for (const std::uint32_t index : {0u, 1u, 1000u}) {
            std::vector<int> cells(256), low(256);
            std::array<std::vector<int>, 3> pairs;
            pairs.fill(std::vector<int>(256));
            const std::uint64_t seeds = std::uint64_t(1) << (definition ? 16 : 20);
            for (std::uint64_t seed = 0; seed < seeds; ++seed) {
                const std::uint64_t key = mix_bits(ljus_test::test_seed(seed));
                SobolStream stream{.seed = key, .index = index};
                std::array<std::uint32_t, 4> x;
                for (std::uint32_t d = 0; d < 4; ++d)
                    x[d] = definition
                               ? owen_by_definition(detail::sobol(index, d), key + d)
                               : static_cast<std::uint32_t>(next_1d<double>(stream) *
                                                            0x1p32);
                ++cells[x[0] >> 24];
                ++low[(x[0] >> 8) & 255u];
                for (std::uint32_t step = 1; step <= 3; ++step)
                    ++pairs[step - 1][(x[0] >> 28) << 4 | x[step] >> 28];
            }
            CHECK(chi_square(cells) < chi_square_limit(255));
            CHECK(chi_square(low) < chi_square_limit(255));
            for (const auto& pair : pairs)
                CHECK(chi_square(pair) < chi_square_limit(255));
        }
}

TEST_CASE("low_discrepancy: the error of a mean falls faster than that of chance") {
    const auto smooth = [](const Vec2T<double>& u) { return std::exp(u.x) * u.y; };
    const auto edge = [](const Vec2T<double>& u) {
        return u.x * u.x + u.y * u.y < 1 ? 1.0 : 0.0;
    };
    const double exact = (std::exp(1.0) - 1) / 2, quarter = std::atan(1.0);
    // Owen: 3/2 for what is smooth; 3/4 for an edge that
    // follows no axis; 1/2 by chance.
    CHECK(error_slope(smooth, exact, true) < -1.35);
    CHECK(error_slope(edge, quarter, true) == doctest::Approx(-0.75).epsilon(0.15));
    CHECK(error_slope(smooth, exact, false) == doctest::Approx(-0.5).epsilon(0.15));
    CHECK(error_slope(edge, quarter, false) == doctest::Approx(-0.5).epsilon(0.15));
}

TEST_CASE("low_discrepancy: after its dimensions a stream goes on at random; never 1") {
    std::set<double> seen;
    for (std::uint64_t path = 0; path < 200; ++path) {
        auto stream = sobol_stream(1, Pass::user, 0, path);
        for (std::uint64_t bounce = 1; bounce < 20; ++bounce) {
            start_bounce(stream, bounce);
            const auto u = next_3d<float>(stream);
            for (int c = 0; c < 3; ++c) CHECK((u[c] >= 0 && u[c] < 1));
            seen.insert(double(u.x));
        }
        CHECK(stream.dimension == detail::sobol_dimensions);
    }
    CHECK(seen.size() > 3700); // of 3800; a few of 24 bits may be equal
    // Past the dimensions, in each bounce, the numbers are those of the path itself.
    for (std::uint64_t bounce = 0; bounce < 3; ++bounce) {
        auto stream = sobol_stream(1, Pass::user, 0, 5);
        auto random = random_stream(1, Pass::user, 0, 5);
        for (std::uint32_t d = 0; d < detail::sobol_dimensions; ++d)
            (void)next_1d<double>(stream);
        start_bounce(stream, bounce);
        start_bounce(random, bounce);
        for (int i = 0; i < 4; ++i)
            CHECK(next_1d<double>(stream) == next_1d<double>(random));
    }
    // What comes after the points is of the same seed, pass, iteration and path.
    for (const Pass pass : {Pass::general_photons, Pass::user})
        for (const std::uint64_t iteration : {0u, 3u})
            for (const std::uint64_t path :
                 {std::uint64_t(5), (std::uint64_t(2) << 32) + 7}) {
                auto stream = sobol_stream(9, pass, iteration, path);
                auto random = random_stream(9, pass, iteration, path);
                for (std::uint32_t d = 0; d < detail::sobol_dimensions; ++d)
                    (void)next_1d<double>(stream);
                CHECK(next_1d<double>(stream) == next_1d<double>(random));
            }
    // A scrambling that takes the first point to the last place of all: still below 1.
    const std::uint64_t far_seed = 4988170;
    REQUIRE(detail::owen_scrambled(0, far_seed) >= 0xffffff80u);
    SobolStream single{.seed = far_seed}, twice{.seed = far_seed};
    CHECK(next_1d<float>(single) < 1.0f);
    CHECK(next_1d<double>(twice) < 1.0);
    CHECK(next_1d<double>(twice) < 1.0);
    // Another seed, pass, iteration or 2^32 paths on: another scrambling.
    const auto first = [](SobolStream s) { return next_1d<double>(s); };
    const double u = first(sobol_stream(1, Pass::user, 0, 5));
    CHECK(u == first(sobol_stream(1, Pass::user, 0, 5)));
    CHECK(u != first(sobol_stream(2, Pass::user, 0, 5)));
    CHECK(u != first(sobol_stream(1, Pass::camera, 0, 5)));
    CHECK(u != first(sobol_stream(1, Pass::user, 1, 5)));
    CHECK(u != first(sobol_stream(1, Pass::user, 0, 5 + (1ull << 32))));
}

TEST_CASE("low_discrepancy: the scrambling stays what it is, so that pictures do") {
    // By another program in another language, from the steps of Burley's paper.
    struct Known {
        std::uint32_t bits;
        std::uint64_t seed;
        std::uint32_t scrambled;
    };
    for (const auto& [bits, seed, scrambled] :
         {Known{0u, 1u, 0xdd7cb651u}, Known{0x80000000u, 2u, 0xa62516a0u},
          Known{0x12345678u, 77u, 0x0838cfb9u}, Known{~0u, 123456789u, 0xf7b9aa2bu}})
        CHECK(detail::owen_scrambled(bits, seed) == scrambled);
}

TEST_CASE(
    "low_discrepancy: what a stream draws, in which order, and of how many bits") {
    const auto start = sobol_stream(3, Pass::user, 1, 77);
    CHECK(start.index == 77);
    CHECK(start.dimension == 0);
    // The scrambling knows nothing of the rest, that of the first path neither.
    for (const std::uint64_t path : {0u, 77u}) {
        const auto stream = sobol_stream(3, Pass::user, 1, path);
        CHECK(stream.seed != stream.rest.key);
        CHECK(stream.seed == start.seed);
    }
    SobolStream a = start, b = start, c = start;
    const double x = next_1d<double>(a), y = next_1d<double>(a), z = next_1d<double>(a);
    CHECK(next_2d<double>(b) == Vec2T<double>{x, y});
    CHECK(next_3d<double>(c) == Vec3T<double>{x, y, z});
    CHECK(b.dimension == 2);
    CHECK(c.dimension == 3);
    // Each is a multiple of 2^-32, and of 2^-24 in float; dimensions differ.
    int odd = 0;
    for (std::uint64_t path = 0; path < 64; ++path) {
        SobolStream in_double = sobol_stream(3, Pass::user, 1, path),
                    in_float = in_double;
        const double u = next_1d<double>(in_double) * 0x1p32;
        CHECK(u == std::floor(u));
        odd += static_cast<std::uint64_t>(u) % 2 != 0;
        CHECK(double(next_1d<float>(in_float)) == std::floor(u * 0x1p-8) * 0x1p-24);
        SobolStream zero{.seed = path};
        CHECK(next_1d<double>(zero) != next_1d<double>(zero));
    }
    CHECK(odd > 16);
    CHECK(odd < 48);
    // Without points it is the random stream, from the first number on.
    RandomStream random = random_stream(3, Pass::user, 1, 77);
    SobolStream without = detail::without_points(random);
    for (int i = 0; i < 20; ++i)
        CHECK(next_1d<double>(without) == next_1d<double>(random));
    start_bounce(without, 2);
    start_bounce(random, 2);
    CHECK(next_3d<float>(without) == next_3d<float>(random));
    CHECK(next_2d<double>(without) == next_2d<double>(random));
}
