// needs: boost
// concept: metaballs
/// \file metaballs_exact_test.cpp
/// \brief Rays and metaballs against arithmetic of 34 digits, family by family.
///
/// The oracle takes another way than the library: in each span the field is a quartic
/// in powers of t, exact to 34 digits; its extrema, the roots of a cubic, say all that
/// is to be decided. It is itself asked about single blobs, which are spheres.
///
/// A case is *firm* when the field moves less, under 8 units of roundoff in every
/// input, than its largest value on the ray is away from 0 (and its value at the ray's
/// origin). There a solver must be right: hit or miss, and no firm crossing skipped.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "ljus/geometry/metaballs.hpp"
#include "support/numbers.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

using Real = boost::multiprecision::cpp_bin_float_quad;
using Point = Vec3T<double>;

// --- The oracle -------------------------------------------------------------------

struct Quadratic { // s(t) = c + b t + a t^2
    Real c = 0, b = 0, a = 0, w = 0, enter = 0, leave = 0;
};

struct Extremum {
    Real t, f;
};

struct Truth {
    bool inside = false, hit = false, firm = false;
    Real t = 0;                      ///< The first crossing, if hit.
    Real moves = 0;                  ///< What 8 u in every input do to f, at most.
    std::vector<Extremum> extrema{}; ///< Of f on the ray, in order, borders among them.
    std::vector<Quadratic> blobs{};
    Real level = 0;

    Real value(const Real& t_at) const {
        Real sum = -level;
        for (const auto& q : blobs) {
            const Real s = q.c + t_at * (q.b + t_at * q.a);
            if (s > 0) sum += q.w * s * s;
        }
        return sum;
    }
};

/// The zero of f between a and b, where its signs differ: 50 halvings, then secants.
template <typename F>
Real zero_between(const F& f, Real a, Real b) {
    const bool rises = f(a) < 0;
    Real fa = f(a), fb = f(b);
    for (int i = 0; i < 60; ++i) {
        Real m = (a + b) / 2;
        if (i > 8 && fa != fb) {
            const Real s = a - fa * (b - a) / (fb - fa);
            if (s > a && s < b) m = s;
        }
        const Real fm = f(m);
        if (fm == 0) return m;
        // Illinois: the end that stays is halved, or the secant creeps.
        if ((fm < 0) == rises) {
            a = m;
            fa = fm;
            fb /= i > 8 ? 2 : 1;
        } else {
            b = m;
            fb = fm;
            fa /= i > 8 ? 2 : 1;
        }
        if (b - a < (abs(a) + abs(b)) * Real(1e-31)) break;
    }
    return (a + b) / 2;
}

/// Roots in (0, 1) of c0 + c1 x + c2 x^2 + c3 x^3, a slope whose sign changes matter.
std::vector<Real> cubic_roots(const std::array<Real, 4>& c) {
    std::vector<Real> ends{0};
    const Real a = 3 * c[3], b = 2 * c[2], d = b * b - 4 * a * c[1];
    if (d > 0) {
        const Real root = sqrt(d),
                   q = b > 0 ? Real(-(b + root) / 2) : Real((root - b) / 2);
        for (const Real& x : {q != 0 && a != 0 ? Real(q / a) : Real(-1),
                              q != 0 ? Real(c[1] / q) : Real(-1)})
            if (x > 0 && x < 1) ends.push_back(x);
    }
    ends.push_back(1);
    std::sort(ends.begin(), ends.end());
    const auto f = [&](const Real& x) {
        return Real(c[0] + x * (c[1] + x * (c[2] + x * c[3])));
    };
    std::vector<Real> result;
    for (std::size_t i = 0; i + 1 < ends.size(); ++i)
        if ((f(ends[i]) < 0) != (f(ends[i + 1]) < 0))
            result.push_back(zero_between(f, ends[i], ends[i + 1]));
    return result;
}

template <std::floating_point T>
Truth exact(const RayT<T>& ray, const MetaballsT<T>& balls) {
    Truth truth;
    truth.level = Real(balls.level);
    const Real eight_u = 4 * Real(std::numeric_limits<T>::epsilon());
    using R3 = std::array<Real, 3>;
    const auto dot3 = [](const R3& x, const R3& y) {
        return Real(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
    };
    const R3 d{Real(ray.direction.x), Real(ray.direction.y), Real(ray.direction.z)};
    std::vector<Real> borders;
    truth.moves = eight_u * truth.level;
    for (const auto& blob : balls.blobs) {
        R3 m, o, size;
        for (int i = 0; i < 3; ++i) {
            const auto k = static_cast<std::size_t>(i);
            m[k] = Real(ray.origin[i]) - Real(blob.center[i]);
            o[k] = abs(Real(ray.origin[i])) + abs(Real(blob.center[i]));
        }
        const Real r2 = Real(blob.radius) * Real(blob.radius);
        Quadratic q{.c = 1 - dot3(m, m) / r2,
                    .b = -2 * dot3(m, d) / r2,
                    .a = -dot3(d, d) / r2,
                    .w = Real(blob.weight)};
        const Real middle = -q.b / (2 * q.a), height = q.c - q.b * q.b / (4 * q.a);
        const Real half = height > 0 ? Real(sqrt(height / -q.a)) : Real(0);
        q.enter = middle - half, q.leave = middle + half;
        if (q.enter > 0) borders.push_back(q.enter);
        if (q.leave > 0) borders.push_back(q.leave);
        truth.blobs.push_back(q);
        // |grad| of (1 - r^2/R^2)^2 is at most 1.54 / R; its own
        // terms move by 2 R-errors.
        const Real far = std::max(Real(0), q.leave);
        for (std::size_t k = 0; k < 3; ++k) size[k] = o[k] + far * abs(d[k]);
        const Real shift = eight_u * sqrt(dot3(size, size)) / Real(blob.radius);
        truth.moves += abs(q.w) * (eight_u * 3 + Real(1.54) * shift + shift * shift);
    }
    borders.push_back(0);
    std::sort(borders.begin(), borders.end());
    borders.erase(std::unique(borders.begin(), borders.end()), borders.end());

    const auto keep = [&](const Real& t) {
        truth.extrema.push_back({t, truth.value(t)});
    };
    for (std::size_t i = 0; i < borders.size(); ++i) {
        keep(borders[i]);
        if (i + 1 == borders.size()) break;
        const Real a = borders[i], length = borders[i + 1] - borders[i];
        const Real middle = a + length / 2;
        std::array<Real, 4> slope{0, 0, 0,
                                  0}; // d/dx of the sum of w s^2, t = a + length x
        for (const auto& q : truth.blobs) {
            if (!(q.enter < middle && middle < q.leave)) continue;
            const Real c = q.c + a * (q.b + a * q.a), b = (q.b + 2 * a * q.a) * length;
            const Real e = q.a * length * length;
            slope[0] += q.w * 2 * b * c;
            slope[1] += q.w * (4 * e * c + 2 * b * b);
            slope[2] += q.w * 6 * b * e;
            slope[3] += q.w * 4 * e * e;
        }
        for (const Real& x : cubic_roots(slope)) keep(a + x * length);
    }
    truth.inside = truth.extrema.front().f >= 0;
    Real most = truth.extrema.front().f;
    for (const auto& e : truth.extrema) most = std::max(most, e.f);
    truth.hit = truth.inside || most >= 0;
    truth.firm = abs(truth.extrema.front().f) > truth.moves && abs(most) > truth.moves;
    if (truth.hit)
        for (std::size_t i = 1; i < truth.extrema.size(); ++i)
            if ((truth.extrema[i].f >= 0) != truth.inside) {
                truth.t = zero_between([&](const Real& t) { return truth.value(t); },
                                       truth.extrema[i - 1].t, truth.extrema[i].t);
                break;
            }
    return truth;
}

// --- The families -----------------------------------------------------------------

enum Family : std::size_t {
    single,
    merging,
    five,
    coincident,
    carved,
    tangent,
    grazing,
    within,
    tiny,
    huge,
    offset,
    any_length,
    distant,
    family_count
};
const char* const family_names[family_count] = {"one blob",
                                                "two, merging",
                                                "five",
                                                "40 in one place",
                                                "one of three carves",
                                                "tangent within 1e-5",
                                                "two tops grazed",
                                                "camera inside",
                                                "size 1e-6",
                                                "size 1e6",
                                                "all moved by 1e6",
                                                "|D| = 1e-6 to 1e6",
                                                "seen from 1e3 to 1e6"};

template <std::floating_point T>
struct Case {
    RayT<T> ray;
    MetaballsT<T> balls;
};

template <std::floating_point T>
Case<T> make_case(std::size_t family, Numbers& n) {
    double scale = 1, distance = n.power(0.3, 1.5), length = 1;
    Point shift{n.between(-3, 3), 1, 2};
    MetaballsT<double> b{.level = n.between(0.05, 0.6)};
    const auto blob = [&](const Point& c, double r, double w) {
        b.blobs.push_back({c, r, w});
    };
    if (family == tiny) scale = 1e-6, shift *= 1e-6;
    if (family == huge) scale = 1e6, shift *= 1e6;
    if (family == offset) shift = {1e6, -1e6, 1e6 * n.next()}, scale = n.power(1, 3);
    if (family == any_length) length = n.power(-6, 6);
    if (family == distant) distance = n.power(3, 6);
    switch (family) {
    case single:
    case tangent:
        blob(Point{0}, 1, 1);
        break;
    case coincident:
        for (int i = 0; i < 40; ++i) blob(Point{0.25, 0, 0}, 1, n.between(0.02, 0.1));
        break;
    case carved:
        blob(Point{0}, 1, 1), blob(n.direction() * 0.6, 0.9, 1);
        blob(n.direction() * 0.5, n.between(0.3, 0.8), -n.between(0.5, 2));
        break;
    case five:
        for (int i = 0; i < 5; ++i)
            blob(n.point(1), n.between(0.4, 1), n.between(0.5, 2));
        break;
    case grazing:
        blob({-0.6, 0, 0}, 1, 1), blob({0.6, 0, 0}, 1, 1);
        break;
    default:
        blob(Point{0}, 1, 1),
            blob(n.direction() * n.between(0, 1.9), n.between(0.5, 1), 1);
    }
    const Point way = n.direction();
    Point origin = family == within ? way * n.between(0, 0.4) : way * (1 + distance);
    Point aim = n.direction() * n.between(0, 1.2);
    if (family == within) aim = origin + n.direction();
    if (family == tangent) {
        const double r = std::sqrt(1 - std::sqrt(b.level));
        const Point side = glm::normalize(glm::cross(way, n.direction()));
        // The tangent point of the cone from the origin, and a little aside.
        const double d = glm::length(origin), sine = r / d;
        aim = way * (r * sine) + side * (r * std::sqrt(1 - sine * sine));
        aim *= 1 + n.sign() * n.power(-12, -5);
    }
    if (family == grazing) { // along both tops
        const double h = std::sqrt(1 - std::sqrt(b.level));
        const double up = h * (1 + n.sign() * n.power(-9, -2));
        origin = {-3, up, 0}, aim = {3, up + n.sign() * n.power(-9, -2), 0};
    }
    Point direction = aim - origin;
    if (!(glm::length(direction) > 0)) direction = -way;
    direction = glm::normalize(direction) * length;
    Case<T> result{
        {.origin = Vec3T<T>(origin * scale + shift), .direction = Vec3T<T>(direction)},
        {.level = static_cast<T>(b.level)}};
    for (const auto& x : b.blobs)
        result.balls.blobs.push_back({Vec3T<T>(x.center * scale + shift),
                                      static_cast<T>(x.radius * scale),
                                      static_cast<T>(x.weight)});
    return result;
}

template <std::floating_point T>
struct Known {
    Case<T> input;
    Truth truth;
};

template <std::floating_point T>
const std::array<std::vector<Known<T>>, family_count>& all_cases() {
    static const auto cases = [] {
        std::array<std::vector<Known<T>>, family_count> result;
        for (std::size_t f = 0; f < family_count; ++f) {
            Numbers n{f + 1};
            for (int i = 0; i < 1000; ++i) {
                auto made = make_case<T>(f, n);
                auto truth = exact(made.ray, made.balls);
                result[f].push_back({std::move(made), std::move(truth)});
            }
        }
        return result;
    }();
    return cases;
}

// --- The count --------------------------------------------------------------------

struct Tally {
    int firm = 0, wrong = 0, hard = 0, hard_wrong = 0, hits = 0;
    double residual = 0; ///< The worst, in units of roundoff; see below.
};

/// Whether an answer crosses the surface where every input within 8 u does.
template <std::floating_point T>
bool is_wrong(const Truth& truth, const std::optional<T>& t) {
    if (t.has_value() != truth.hit) return true;
    if (!t) return false;
    for (const auto& e : truth.extrema) // a firm crossing that was skipped
        if (e.t > truth.t && e.t < Real(*t) &&
            (truth.inside ? e.f < -truth.moves : e.f > truth.moves))
            return true;
    return false;
}

/// |f| at a hit, in units of what one unit of roundoff in every input moves f by.
template <std::floating_point T>
double residual(const Known<T>& known, T t) {
    const Real f = abs(known.truth.value(Real(t)));
    return (8 * f / known.truth.moves).template convert_to<double>();
}

template <typename Solver, std::floating_point T>
std::array<Tally, family_count> run(const char* title) {
    std::array<Tally, family_count> tallies{};
    std::printf("\n%-28s %6s %6s %6s %6s %6s %10s\n", title, "firm", "wrong", "hard",
                "wrong", "hits", "residual");
    for (std::size_t f = 0; f < family_count; ++f) {
        Tally& tally = tallies[f];
        for (const auto& known : all_cases<T>()[f]) {
            const auto t = intersect<Solver>(known.input.ray, known.input.balls);
            const bool wrong = is_wrong(known.truth, t);
            (known.truth.firm ? tally.firm : tally.hard) += 1;
            (known.truth.firm ? tally.wrong : tally.hard_wrong) += wrong;
            if (!t || !known.truth.firm || wrong) continue;
            ++tally.hits;
            tally.residual = std::max(tally.residual, residual(known, *t));
        }
        std::printf("%-28s %6d %6d %6d %6d %6d %10.3g\n", family_names[f], tally.firm,
                    tally.wrong, tally.hard, tally.hard_wrong, tally.hits,
                    tally.residual);
    }
    return tallies;
}

} // namespace

TEST_CASE("metaballs exact: the oracle knows spheres") {
    for (const auto& known : all_cases<float>()[single]) {
        const auto& blob = known.input.balls.blobs.front();
        const Real r2 = Real(blob.radius) * Real(blob.radius) *
                        (1 - sqrt(Real(known.input.balls.level)));
        std::array<Real, 3> m, d;
        for (int i = 0; i < 3; ++i) {
            m[std::size_t(i)] = Real(known.input.ray.origin[i]) - Real(blob.center[i]);
            d[std::size_t(i)] = Real(known.input.ray.direction[i]);
        }
        const auto dot3 = [](const auto& x, const auto& y) {
            return Real(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
        };
        const Real a = dot3(d, d), b = -dot3(m, d), c = dot3(m, m) - r2;
        const Real under = b * b - a * c;
        CHECK(known.truth.hit == (under >= 0 && b >= 0));
        if (known.truth.hit)
            CHECK(abs(known.truth.t - (b - sqrt(under)) / a) <
                  Real(1e-19) * known.truth.t);
    }
}

TEST_CASE("metaballs exact: quartic pieces decide right, and land on the surface") {
    const auto floats = run<QuarticPieces, float>("quartic pieces, float data");
    const auto doubles = run<QuarticPieces, double>("quartic pieces, double data");
    for (std::size_t f = 0; f < family_count; ++f) {
        INFO(family_names[f]);
        CHECK(floats[f].firm + floats[f].hard == 1000);
        CHECK(floats[f].wrong == 0);
        CHECK(floats[f].residual <= 1);
        CHECK(doubles[f].wrong == 0);
        CHECK(doubles[f].residual <= 4);
    }
}

TEST_CASE("metaballs exact: interval bisection decides right") {
    const auto floats = run<Bisection, float>("bisection, float data");
    const auto doubles = run<Bisection, double>("bisection, double data");
    for (std::size_t f = 0; f < family_count; ++f) {
        INFO(family_names[f]);
        CHECK(floats[f].wrong == 0);
        CHECK(floats[f].residual <= 1);
        CHECK(doubles[f].wrong == 0);
        CHECK(doubles[f].residual <= 4);
    }
}

TEST_CASE("metaballs exact: sphere tracing never lands behind the surface") {
    const auto tallies = run<SphereTracing, float>("sphere tracing, float data");
    (void)run<SphereTracing, double>("sphere tracing, double data");
    for (std::size_t f = 0; f < family_count; ++f) {
        INFO(family_names[f]);
        if (f != tangent && f != grazing) CHECK(tallies[f].wrong == 0);
    }
    CHECK(tallies[tangent].wrong + tallies[grazing].wrong > 0); // it gives up
}

TEST_CASE("metaballs exact: the quartic formula fails where pieces hold") {
    (void)run<Radicals, float>("quartic formula, float data");
    const auto tallies = run<Radicals, double>("quartic formula, double data");
    int wrong = 0;
    double worst = 0;
    for (const auto& tally : tallies) {
        wrong += tally.wrong;
        worst = std::max(worst, tally.residual);
    }
    CHECK(wrong > 0);
    CHECK(worst > 1e4);
}
