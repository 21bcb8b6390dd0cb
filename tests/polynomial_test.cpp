// needs: boost
/// \file polynomial_test.cpp
/// \brief Roots of polynomials against polynomials made of exact roots, multiple ones
/// among them; and where the quartic formula loses them.
///
/// The roots are integers of up to 12 bits, so that the coefficients of their product
/// are integers below 2^53: a double holds them, and the roots stay exact. Values are
/// compared as fractions.

#include "ljus/geometry/detail/metaball_quartic.hpp"
#include "ljus/math/polynomial.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>
#include <string>
#include <vector>

#include "support/exact.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Exact;
using ljus_test::Numbers;

namespace {

/// A polynomial in powers, c[0] + c[1] x + ... + c[N] x^N, on an interval: as Bernstein
/// coefficients over it.
/// \param p     The coefficients.
/// \param low   The interval's lower end.
/// \param high  Its upper end.
/// \return The polynomial of u, where x = low + u (high - low).
template <std::floating_point T, std::size_t M>
[[nodiscard]] detail::BernsteinT<T, M - 1> on_interval(std::array<T, M> p, T low,
                                                       T high) noexcept {
    constexpr std::size_t N = M - 1;
    // Horner's scheme, again and again: the powers of x - low.
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = N; j-- > i;) p[j] += low * p[j + 1];
    constexpr auto of_n = detail::binomials<T, N>();
    T length = T(1);
    for (std::size_t i = 0; i <= N; ++i, length *= high - low) p[i] *= length / of_n[i];
    for (std::size_t i = 0; i < N; ++i)
        for (std::size_t j = N; j > i; --j) p[j] += p[j - 1];
    return {p};
}

using Powers = std::array<double, 5>;

Exact exact_value(const Powers& p, const Exact& x) {
    Exact sum = 0;
    for (std::size_t i = p.size(); i-- > 0;) sum = sum * x + Exact(p[i]);
    return sum;
}

/// All roots of a polynomial in powers that lie in an interval; the tolerance is
/// 8 (N + 1) eps times the sum of |c_i| m^i, m the larger of |low| and |high|: what
/// rounding may have done.
template <std::floating_point T, std::size_t M>
detail::RootsT<T, M - 1> roots_in(const std::array<T, M>& p, T low, T high) noexcept {
    const T m = glm::max(std::abs(low), std::abs(high));
    T size = T(0);
    for (std::size_t i = M; i-- > 0;) size = size * m + std::abs(p[i]);
    const T tolerance = T(8 * M) * std::numeric_limits<T>::epsilon() * size;
    auto result = detail::roots(on_interval(p, low, high), tolerance);
    for (std::size_t i = 0; i < result.count; ++i)
        result.at[i] = glm::min(high, low + result.at[i] * (high - low));
    return result;
}

/// The tolerance of roots_in(), worked out anew.
double tolerance(const Powers& p, double low, double high) {
    const double m = std::max(std::abs(low), std::abs(high));
    double size = 0;
    for (std::size_t i = 5; i-- > 0;) size = size * m + std::abs(p[i]);
    return 40 * std::numeric_limits<double>::epsilon() * size;
}

Powers times(const Powers& p, double c0, double c1) { // by c0 + c1 x
    Powers result{};
    for (std::size_t i = 0; i < 5; ++i) result[i] = c0 * p[i] + (i ? c1 * p[i - 1] : 0);
    return result;
}

struct Known {
    Powers p{};
    std::vector<double> roots{}; ///< Exact, each once.
    double low = 0, high = 1;
};

enum Family {
    four,
    doubled,
    two_doubled,
    triple,
    quadruple,
    near,
    pair_of_none,
    cubic,
    quadratic,
    linear,
    tiny_lead,
    at_ends,
    family_count
};
const char* const names[family_count] = {"four roots",
                                         "one double",
                                         "two double",
                                         "one triple",
                                         "one quadruple",
                                         "neighbours, 1 in 4096 apart",
                                         "two roots, two complex",
                                         "leading 0: cubic",
                                         "leading 0: quadratic",
                                         "leading 0: linear",
                                         "leading 2^-60: cubic",
                                         "roots at the interval's ends"};

Known make(Family family, Numbers& n) {
    const auto root = [&] { return double(n.below(4097) - 2048); };
    std::vector<double> r;
    const double a = root();
    switch (family) {
    case four:
        r = {a, root(), root(), root()};
        break;
    case doubled:
        r = {a, a, root(), root()};
        break;
    case two_doubled: {
        const double b = root();
        r = {a, a, b, b};
        break;
    }
    case triple:
        r = {a, a, a, root()};
        break;
    case quadruple:
        r = {a, a, a, a};
        break;
    case near:
        r = {a, a + 1, a + 2, root()};
        break;
    case cubic:
        r = {a, root(), root()};
        break;
    case quadratic:
    case pair_of_none:
        r = {a, root()};
        break;
    case linear:
        r = {a};
        break;
    case tiny_lead:
        r = {a, root(), root()};
        break;
    default:
        r = {-2048, 2048, a, root()};
        break;
    }
    Known known{.p = {1, 0, 0, 0, 0}, .low = -2048, .high = 2048};
    for (const double x : r) known.p = times(known.p, -x, 1);
    if (family == pair_of_none) { // times (x - b)^2 + c, which is above 0
        const double b = double(n.below(64)), c = double(1 + n.below(64));
        const Powers p = known.p;
        for (std::size_t i = 0; i < 5; ++i)
            known.p[i] = (b * b + c) * p[i] - (i ? 2 * b * p[i - 1] : 0) +
                         (i > 1 ? p[i - 2] : 0);
    }
    // 2^-60 x^4 moves the roots by less than 2^-16 of one over the slope: it is the
    // tolerance's business, not a new root within the interval.
    if (family == tiny_lead) known.p[4] = std::ldexp(1.0, -60);
    std::sort(r.begin(), r.end());
    r.erase(std::unique(r.begin(), r.end()), r.end());
    known.roots = r;
    return known;
}

} // namespace

TEST_CASE("polynomial: no root is lost, none is invented, and they come in order") {
    std::printf("%-32s %7s %9s %9s %9s | formula: lost\n", "family", "roots", "found",
                "residual", "error");
    for (int f = 0; f < family_count; ++f) {
        Numbers n{static_cast<std::uint64_t>(f + 1)};
        const auto family = static_cast<Family>(f);
        int truths = 0, found = 0, lost_by_formula = 0, bad = 0;
        double worst_residual = 0, worst_error = 0;
        for (int i = 0; i < 1000; ++i) {
            const Known known = make(family, n);
            const double allowed = tolerance(known.p, known.low, known.high);
            // Half a unit of roundoff of 1 in u, times the slope.
            const auto& p = known.p;
            const auto steepness = [&](double x) {
                return std::abs(((4 * p[4] * x + 3 * p[3]) * x + 2 * p[2]) * x + p[1]);
            };
            const double step = 4096 * std::numeric_limits<double>::epsilon();

            const auto roots = roots_in(known.p, known.low, known.high);
            CHECK(std::is_sorted(roots.begin(), roots.end()));
            found += int(roots.count);
            for (const double x : roots) {
                CHECK(known.low <= x);
                CHECK(x <= known.high);
                const double residual =
                    std::abs(ljus_test::to_double(exact_value(p, Exact(x))));
                worst_residual = std::max(worst_residual,
                                          residual / (allowed + steepness(x) * step));
            }
            const auto formula = detail::quartic_formula(known.p);
            for (const double truth : known.roots) {
                ++truths;
                double nearest = 1e300, nearest_formula = 1e300;
                for (const double x : roots)
                    if (std::abs(x - truth) < std::abs(nearest - truth)) nearest = x;
                for (const double x : formula)
                    nearest_formula = std::min(nearest_formula, std::abs(x - truth));
                lost_by_formula += !(nearest_formula <= 4);
                worst_error = std::max(worst_error, std::abs(nearest - truth) / 4096);
                // p stays within the tolerance all the way to the exact root.
                bool reached = std::abs(nearest) < 1e300;
                for (int k = 0; reached && k <= 8; ++k) {
                    const Exact x =
                        Exact(truth) + (Exact(nearest) - Exact(truth)) * k / 8;
                    const double value =
                        std::abs(ljus_test::to_double(exact_value(p, x)));
                    reached = value <=
                              3 * (allowed + steepness(ljus_test::to_double(x)) * step);
                }
                bad += !reached;
            }
        }
        std::printf("%-32s %7d %9d %9.3f %9.2g | %6d\n", names[f], truths, found,
                    worst_residual, worst_error, lost_by_formula);
        INFO(names[f]);
        CHECK(bad == 0);
        CHECK(worst_residual <= 1);
        if (family == cubic) CHECK(worst_error < 1e-7);
    }
}

TEST_CASE("polynomial: known roots") {
    const auto r = roots_in(std::array{24.0, -50.0, 35.0, -10.0, 1.0}, 0.0, 5.0);
    REQUIRE(r.count == 4);
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(r.at[i] == doctest::Approx(double(i + 1)).epsilon(1e-12));
    CHECK(roots_in(std::array{24.0, -50.0, 35.0, -10.0, 1.0}, 1.5, 3.5).count == 2);
    CHECK(roots_in(std::array{1.0, 0.0, 1.0}, -9.0, 9.0).count == 0);
    CHECK(roots_in(std::array{-2.0, 0.0, 1.0}, 0.0, 2.0).at[0] ==
          doctest::Approx(std::sqrt(2.0)).epsilon(1e-15));
    CHECK(roots_in(std::array{-1.0, 2.0}, 0.0, 1.0).at[0] == 0.5);
    CHECK(roots_in(std::array{0.0f, 1.0f}, -1.0f, 1.0f).at[0] == 0.0f);
}

TEST_CASE("polynomial: the constant 0 has a root, a constant has none, a NaN no end") {
    CHECK(detail::roots(detail::BernsteinT<double, 4>{}, 0.0).count > 0);
    CHECK(detail::roots(detail::BernsteinT<double, 4>{{1, 1, 1, 1, 1}}, 0.0).count ==
          0);
    CHECK(
        detail::roots(detail::BernsteinT<double, 4>{{-1, -1, -1, -1, -1}}, 0.0).count ==
        0);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const double inf = std::numeric_limits<double>::infinity();
    Numbers n;
    for (int i = 0; i < 20000; ++i) { // each returns
        detail::BernsteinT<double, 4> p;
        for (double& c : p.c) {
            const int kind = n.below(8);
            c = kind == 0   ? nan
                : kind == 1 ? inf
                : kind == 2 ? -inf
                : kind == 3 ? 0
                            : n.sign() * n.power(-320, 308);
        }
        CHECK(detail::roots(p, detail::noise(p)).count <= 5);
        (void)detail::first_change(p);
        (void)detail::quartic_formula(p.c);
    }
    CHECK_FALSE(
        detail::first_change(detail::BernsteinT<double, 4>{{nan, nan, nan, nan, nan}}));
}

TEST_CASE("polynomial: value and derivative on Bernstein coefficients") {
    // u^3 (1 - u) * 4 has one coefficient; its derivative is 12 u^2 - 16 u^3.
    const detail::BernsteinT<double, 4> p{{0, 0, 0, 1, 0}};
    CHECK(detail::value_at(p, 0.5) == 0.25);
    CHECK(detail::value_at(detail::derivative(p), 0.5) == 1.0);
    CHECK(detail::value_at(on_interval(std::array{1.0, 2.0, 3.0}, 2.0, 4.0), 0.5) ==
          34.0);
    CHECK(detail::sign_changes(detail::BernsteinT<double, 4>{{1, 0, -1, 0, 2}}) == 2);
    CHECK(detail::sign_changes(p) == 0);
}

TEST_CASE("polynomial: the first change of sign") {
    // (u - 1/4)(u - 3/4): below, between, and from an end to the other
    const auto p = on_interval(std::array{3.0 / 16, -1.0, 1.0}, 0.0, 1.0);
    REQUIRE(detail::first_change(p));
    CHECK(*detail::first_change(p) == doctest::Approx(0.25).epsilon(1e-14));
    const auto late = on_interval(std::array{3.0 / 16, -1.0, 1.0}, 0.5, 1.5);
    REQUIRE(detail::first_change(late));
    CHECK(*detail::first_change(late) == doctest::Approx(0.25).epsilon(1e-14));
    // A touch counts, a miss by a little does not.
    const auto touch = on_interval(std::array{0.25, -1.0, 1.0}, 0.0, 1.0);
    REQUIRE(detail::first_change(touch));
    CHECK(*detail::first_change(touch) == doctest::Approx(0.5));
    CHECK_FALSE(detail::first_change(
        on_interval(std::array{0.25 + 1e-13, -1.0, 1.0}, 0.0, 1.0)));
    // A quartic that changes three times: the first of them.
    const auto three = on_interval(
        std::array{-0.1 * 0.5 * 0.8, 0.05 + 0.08 + 0.4, -1.4, 1.0}, 0.0, 1.0);
    CHECK(*detail::first_change(three) == doctest::Approx(0.1).epsilon(1e-12));
}

TEST_CASE("polynomial: a touch is met wherever it is, on either side by rounding") {
    // (u - r)^2, which is within rounding of 0 as far as 1e-7 from r.
    for (int i = 1; i < 1000; ++i) {
        const double r = i / 1000.0, s = 1 - r;
        const auto met =
            detail::first_change(detail::BernsteinT<double, 2>{{r * r, -r * s, s * s}});
        REQUIRE(met);
        REQUIRE(std::abs(*met - r) < 1e-7);
    }
}

TEST_CASE("polynomial: the bound of rounding is that of the largest coefficient") {
    const double eps = std::numeric_limits<double>::epsilon();
    using P = detail::BernsteinT<double, 3>;
    CHECK(detail::noise(P{{1, -5, 2, 0}}) == 8 * eps * 5);
    CHECK(detail::noise(P{{-7, 5, -2, 1}}) == 8 * eps * 7);
    CHECK(detail::noise(P{{1, 2, 3, 4}}) == 8 * eps * 4);
    CHECK(detail::noise(P{{0, 0, 0, 0}}) == 0);
}

TEST_CASE("polynomial: the formula finds what is well apart: four roots, two or none") {
    Numbers draws{9};
    int negative = 0, positive = 0; // both ways of the resolvent
    for (int i = 0; i < 3000; ++i) {
        // (x^2 - s x + t) twice, with roots m - h and m + h, or m - ih and m + ih.
        std::vector<double> right;
        double quadratic[2][2];
        const int real = i % 3; // of the two quadratics
        for (int k = 0; k < 2; ++k) {
            const double m = draws.between(-2.0, 2.0), h = draws.between(0.3, 2.0);
            const double sign = k < real ? -1 : 1;
            quadratic[k][0] = -2 * m;
            quadratic[k][1] = m * m + sign * h * h;
            if (k < real) right.insert(right.end(), {m - h, m + h});
        }
        std::sort(right.begin(), right.end());
        bool apart = true;
        for (std::size_t k = 1; k < right.size(); ++k)
            apart = apart && right[k] - right[k - 1] > 0.2;
        if (!apart) continue;
        const auto& [b, c] = quadratic[0];
        const auto& [d, e] = quadratic[1];
        const double lead = draws.between(0.5, 2.0) * (i % 2 == 0 ? 1 : -1);
        const std::array<double, 5> powers{lead * c * e, lead * (b * e + c * d),
                                           lead * (c + e + b * d), lead * (b + d),
                                           lead};
        const auto found = detail::quartic_formula(powers);
        std::vector<double> roots(found.begin(), found.end());
        std::sort(roots.begin(), roots.end());
        CAPTURE(real);
        REQUIRE(roots.size() == right.size());
        for (std::size_t k = 0; k < roots.size(); ++k)
            REQUIRE(std::abs(roots[k] - right[k]) < 1e-5);
        (real == 1 ? positive : negative) += 1;
    }
    CHECK(negative > 500);
    CHECK(positive > 500);
    // One that is even, and one shifted by 3.
    const auto roots_of = [](const std::array<double, 5>& powers) {
        const auto found = detail::quartic_formula(powers);
        std::vector<double> roots(found.begin(), found.end());
        std::sort(roots.begin(), roots.end());
        return roots;
    };
    const auto even = roots_of({4, 0, -5, 0, 1});
    REQUIRE(even.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(even[k] == doctest::Approx(std::array{-2, -1, 1, 2}[k]).epsilon(1e-9));
    const auto shifted = roots_of({40, -78, 49, -12, 1}); // 1, 2, 4, 5
    REQUIRE(shifted.size() == 4);
    for (std::size_t k = 0; k < 4; ++k)
        CHECK(shifted[k] == doctest::Approx(std::array{1, 2, 4, 5}[k]).epsilon(1e-9));
    // All four in one place: each of its roots and quotients is 0.
    const auto none = roots_of({0, 0, 0, 0, 2});
    CHECK(none == std::vector<double>(4, 0.0));
}

TEST_CASE(
    "polynomial: a root at an end of its interval is found there, rising or not") {
    using Line = detail::BernsteinT<double, 1>;
    CHECK(detail::root_between(Line{{0, 1}}, 0.0, 1.0) < 1e-15);
    CHECK(detail::root_between(Line{{0, -1}}, 0.0, 1.0) < 1e-15);
    CHECK(detail::root_between(Line{{-1, 0}}, 0.0, 1.0) == doctest::Approx(1));
    CHECK(detail::root_between(Line{{1, 0}}, 0.0, 1.0) == doctest::Approx(1));
    CHECK(detail::root_between(Line{{-1, 3}}, 0.0, 1.0) == 0.25);
    CHECK(detail::root_between(Line{{1, -3}}, 0.0, 1.0) == 0.25);
    // From 1, Newton's method would go to 1.25.
    using Quartic = detail::BernsteinT<double, 4>;
    CHECK(detail::root_between(Quartic{{19, 7, 19, -2, -1}}, 0.0, 1.0) ==
          doctest::Approx(0.883408780790739).epsilon(1e-14));
    // Within a part: 1/4 is the only one of three roots.
    const auto three = on_interval(std::array{-3.0 / 32, 11.0 / 16, -3.0 / 2, 1.0}, 0.0,
                                   1.0); // 1/4, 1/2, 3/4
    CHECK(detail::root_between(three, 0.0, 0.375) == doctest::Approx(0.25));
    CHECK(detail::root_between(three, 0.375, 0.625) == doctest::Approx(0.5));
    CHECK(detail::root_between(three, 0.625, 1.0) == doctest::Approx(0.75));
    const auto all = detail::roots(three, 1e-15);
    REQUIRE(all.count == 3);
    CHECK(all.at[1] == doctest::Approx(0.5).epsilon(1e-14));
}
