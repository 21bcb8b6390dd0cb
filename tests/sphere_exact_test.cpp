// needs: boost
// concept: sphere
/// \file sphere_exact_test.cpp
/// \brief The ray-sphere intersection against exact arithmetic, family by family.
///
/// The oracle takes another way than the library: every float is an integer times a
/// power of two, so with integers of any length
///
///     a = D.D,   b = -D.(O - C),   c = |O - C|^2 - R^2,   e = a R^2 - |(O - C) x D|^2
///
/// are exact, and so are the decisions: the line meets the sphere when e >= 0, the
/// origin lies inside when c < 0, and the sphere lies ahead when b > 0. Only t needs a
/// square root, taken to 100 decimal digits.
///
/// A case is *firm* when every input moved by up to 8 units of roundoff still gives the
/// same decision. There an algorithm that is worth its salt is right; between (*hard*)
/// only exact or wider arithmetic is.

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/multiprecision/cpp_int.hpp>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/intersect.hpp>

#include "ljus/geometry/sphere.hpp"
#include "support/exact.hpp"
#include "support/numbers.hpp"

using ljus::Ray;
using ljus::RayT;
using ljus::Sphere;
using ljus::SphereT;
using ljus::Vec3;
using ljus::Vec3T;

namespace {

using ljus_test::grid_exponent;
using ljus_test::Integer;
using ljus_test::Numbers;
using ljus_test::on_grid;
using Real = boost::multiprecision::cpp_bin_float_50;

// --- The oracle ----------------------------------------------------------------------

struct Truth {
    bool hit = false;
    bool firm = false; ///< The same for all inputs within 8 units of roundoff.
    Real t = 0;        ///< The first root at or above 0, if hit.
};

template <std::floating_point T>
Truth exact(const RayT<T>& ray, const SphereT<T>& sphere) {
    const T r = sphere.radius;
    int length = grid_exponent(r), slope = 1 << 20;
    for (int i = 0; i < 3; ++i) {
        length = std::min(
            {length, grid_exponent(ray.origin[i]), grid_exponent(sphere.center[i])});
        slope = std::min(slope, grid_exponent(ray.direction[i]));
    }
    std::array<Integer, 3> d, m;
    for (int i = 0; i < 3; ++i) {
        const auto at = static_cast<std::size_t>(i);
        d[at] = on_grid(ray.direction[i], slope);
        m[at] = on_grid(ray.origin[i], length) - on_grid(sphere.center[i], length);
    }
    const Integer radius = on_grid(r, length);
    const auto dot = [](const auto& x, const auto& y) {
        return Integer(x[0] * y[0] + x[1] * y[1] + x[2] * y[2]);
    };
    const std::array<Integer, 3> cross{m[1] * d[2] - m[2] * d[1],
                                       m[2] * d[0] - m[0] * d[2],
                                       m[0] * d[1] - m[1] * d[0]};
    const Integer a = dot(d, d), b = -dot(m, d);
    const Integer c = dot(m, m) - radius * radius;
    const Integer e = a * radius * radius - dot(cross, cross);

    Truth truth;
    truth.hit = e >= 0 && (c <= 0 || b >= 0);
    const Real unit = ldexp(Real(1), length - slope); // of t
    if (truth.hit) {
        const Real root = sqrt(Real(e));
        if (c > 0)
            truth.t =
                Real(c) / (Real(b) + root) * unit; // enters: (b - root)/a by Vieta
        else
            truth.t =
                (b > 0 ? (Real(b) + root) / Real(a) : -Real(c) / (root - Real(b))) *
                unit; // leaves
        if (c == 0 && b >= 0) truth.t = 0;
    }

    // Firm? The line comes no nearer to C than by `shift` when every number moves by 8
    // u.
    const Real grid = ldexp(Real(1), length);
    const Real eight_u = Real(4) * Real(std::numeric_limits<T>::epsilon());
    const Real t_near = abs(Real(b) / Real(a) * unit);
    const Real distance = sqrt(Real(dot(cross, cross)) / Real(a)) * grid;
    const Real to_origin = sqrt(Real(dot(m, m))) * grid;
    Real line_shift = 0, origin_shift = 0;
    for (int i = 0; i < 3; ++i) {
        const Real o = abs(Real(ray.origin[i])) + abs(Real(sphere.center[i]));
        const Real line = o + t_near * abs(Real(ray.direction[i]));
        line_shift += line * line;
        origin_shift += o * o;
    }
    const Real slack = eight_u * Real(r);
    const bool line_firm = abs(distance - Real(r)) > eight_u * sqrt(line_shift) + slack;
    const bool origin_firm =
        abs(to_origin - Real(r)) > eight_u * sqrt(origin_shift) + slack;
    truth.firm = line_firm && (distance > Real(r) || origin_firm);
    return truth;
}

/// |t - truth| in units of the last place of the truth, seen as a T.
template <std::floating_point T>
double ulps(T t, const Real& truth) {
    const T near = truth.convert_to<T>();
    const T unit = std::nextafter(std::abs(near), std::numeric_limits<T>::infinity()) -
                   std::abs(near);
    return (abs(Real(t) - truth) / Real(unit)).template convert_to<double>();
}

// --- The families --------------------------------------------------------------------

template <std::floating_point T>
struct Case {
    RayT<T> ray;
    SphereT<T> sphere;
};

template <std::floating_point T>
Case<T> rounded(const Vec3T<double>& origin, const Vec3T<double>& direction,
                const Vec3T<double>& center, double radius) {
    return {{.origin = Vec3T<T>(origin), .direction = Vec3T<T>(direction)},
            {.center = Vec3T<T>(center), .radius = static_cast<T>(radius)}};
}

/// A direction from the origin to a point beside the centre: `miss` radii away.
Vec3T<double> aim(Numbers& numbers, const Vec3T<double>& origin,
                  const Vec3T<double>& center, double radius, double miss) {
    const Vec3T<double> way = center - origin;
    if (glm::dot(way, way) == 0) return numbers.direction();
    const Vec3T<double> side = glm::cross(way, numbers.direction());
    const Vec3T<double> target = center + side * (radius * miss / glm::length(side));
    return glm::normalize(target - origin);
}

constexpr int cases_a_family = 4000;

enum Family : std::size_t {
    ordinary,
    far_away,
    huge,
    inside,
    at_centre,
    on_surface,
    offset,
    tangent,
    axis,
    any_length,
    tiny,
    denormal,
    large,
    family_count
};
const std::array<const char*, family_count> family_names{
    "ordinary: 1 to 100 radii away",
    "1e2 to 1e8 radii away",
    "huge radius: 1e4 to 1e8, seen from 1",
    "origin inside",
    "origin at the centre",
    "origin on the surface, rounded",
    "all moved by 1e6",
    "tangent by +-0..40 ulp",
    "tangent, axis-parallel, by +-0..40 ulp",
    "|D| = 1e-10 to 1e10",
    "size 1e-30",
    "denormal radius",
    "size 1e30"};
/// Whether the family has ordinary sizes and unit directions: there float must do.
constexpr bool is_ordinary(std::size_t family) {
    return family <= axis;
}

template <std::floating_point T>
Case<T> make_case(std::size_t family, int i, Numbers& n) {
    using V = Vec3T<double>;
    const V way = n.direction();
    const double miss = n.between(0, 1.3);
    const auto seen = [&](double radius, double distance, const V& center) {
        const V origin = center + way * (radius * distance);
        return rounded<T>(origin, aim(n, origin, center, radius, miss), center, radius);
    };
    switch (family) {
    case ordinary:
        return seen(n.power(-2, 2), n.power(0, 2), V{n.between(-5, 5), 1, 2});
    case far_away:
        return seen(n.power(-2, 2), n.power(2, 8), V{0.5, n.next(), -1});
    case huge: {
        const double radius = n.power(4, 8);
        return seen(radius, 1 + n.between(-3, 3) / radius, V{0, -radius, 0});
    }
    case inside:
        return seen(n.power(-2, 2), n.next(), V{n.next(), 1, 2});
    case at_centre:
        return seen(n.power(-2, 2), 0, V{n.next(), 1, 2});
    case on_surface:
        return seen(n.power(-2, 2), 1, V{n.next(), 1, 2});
    case offset:
        return seen(n.power(0, 3), n.power(0.1, 3), V{1e6, -1e6, 1e6 * n.next()});
    case tangent: {
        // The radius is the distance of the rounded line, moved by a few ulp.
        const V center{n.between(-3, 3), n.between(-3, 3), n.between(-3, 3)};
        const V origin = center + way * n.power(0, 4);
        auto result = rounded<T>(origin, n.direction(), center, 1);
        if (i % 2) result.ray.direction = Vec3T<T>(aim(n, origin, center, 1, 1));
        const V m = V(result.ray.origin) - V(result.sphere.center);
        const V d(result.ray.direction);
        result.sphere.radius =
            static_cast<T>(glm::length(glm::cross(m, d)) / glm::length(d));
        for (int k = 0; k < i % 81 - 40; ++k)
            result.sphere.radius =
                std::nextafter(result.sphere.radius, std::numeric_limits<T>::max());
        for (int k = 0; k < 40 - i % 81; ++k)
            result.sphere.radius = std::nextafter(result.sphere.radius, T(0));
        return result;
    }
    case axis: {
        auto result =
            rounded<T>(V{0, n.power(-2, 2), n.power(-1, 7)}, V{0, 0, -1}, V{0}, 1);
        result.sphere.radius = result.ray.origin.y;
        for (int k = 0; k < i % 81 - 40; ++k)
            result.sphere.radius =
                std::nextafter(result.sphere.radius, std::numeric_limits<T>::max());
        for (int k = 0; k < 40 - i % 81; ++k)
            result.sphere.radius = std::nextafter(result.sphere.radius, T(0));
        return result;
    }
    case any_length: {
        auto result = seen(n.power(-2, 2), n.power(-1, 3), V{n.next(), 1, 2});
        result.ray.direction *= static_cast<T>(n.power(-10, 10));
        return result;
    }
    case tiny:
        return seen(1e-30, n.power(-1, 4), V{1e-30 * n.next(), 0, 0});
    case denormal: {
        // For double data the same sizes are ordinary; the family is about float.
        const double least = 1.4012984643248171e-45;
        return seen(least * (1 + i % 5000), n.power(-1, 6), V{0});
    }
    default:
        return seen(1e30, n.power(-1, 4), V{1e30 * n.next(), 0, 0});
    }
}

// --- The count -----------------------------------------------------------------------

struct Tally {
    int firm = 0, firm_wrong = 0, hard = 0, hard_wrong = 0;
    int hard_hits = 0, hard_within_1 = 0;
    int hits = 0, within_half = 0, within_1 = 0, within_4 = 0;
    double worst = 0;
    void add(const Tally& other) {
        firm += other.firm, firm_wrong += other.firm_wrong;
        hard += other.hard, hard_wrong += other.hard_wrong;
        hard_hits += other.hard_hits, hard_within_1 += other.hard_within_1;
        hits += other.hits, within_half += other.within_half;
        within_1 += other.within_1, within_4 += other.within_4;
        worst = std::max(worst, other.worst);
    }
};

template <std::floating_point T>
void count(Tally& tally, const Truth& truth, const std::optional<T>& t) {
    const bool wrong = t.has_value() != truth.hit;
    (truth.firm ? tally.firm : tally.hard) += 1;
    if (wrong) (truth.firm ? tally.firm_wrong : tally.hard_wrong) += 1;
    if (!truth.hit || !t) return;
    const double error = ulps(*t, truth.t);
    if (!truth.firm) {
        ++tally.hard_hits;
        tally.hard_within_1 += error <= 1;
        return;
    }
    ++tally.hits;
    tally.within_half += error <= 0.5;
    tally.within_1 += error <= 1;
    tally.within_4 += error <= 4;
    tally.worst = std::max(tally.worst, error);
}

void print_head(const char* title) {
    std::printf("\n%s\n%-39s %6s %6s %6s %6s %6s %7s %7s %7s %9s %8s\n", title,
                "family", "firm", "wrong", "hard", "wrong", "hits", "0.5 ulp", "1 ulp",
                "4 ulp", "worst", "hard");
}

void print(const char* name, const Tally& tally) {
    const auto share = [&](int n) { return tally.hits ? 100.0 * n / tally.hits : 0.0; };
    std::printf("%-39s %6d %6d %6d %6d %6d %6.1f%% %6.1f%% %6.1f%% %9.3g %7.1f%%\n",
                name, tally.firm, tally.firm_wrong, tally.hard, tally.hard_wrong,
                tally.hits, share(tally.within_half), share(tally.within_1),
                share(tally.within_4), tally.worst,
                tally.hard_hits ? 100.0 * tally.hard_within_1 / tally.hard_hits : 0.0);
}

/// A case with its truth.
template <std::floating_point T>
struct Known {
    Case<T> input;
    Truth truth;
};

/// All cases of all families, made once.
template <std::floating_point T>
const std::array<std::vector<Known<T>>, family_count>& all_cases() {
    static const auto cases = [] {
        std::array<std::vector<Known<T>>, family_count> result;
        for (std::size_t family = 0; family < family_count; ++family) {
            Numbers numbers{family + 1};
            for (int i = 0; i < cases_a_family; ++i) {
                const auto made = make_case<T>(family, i, numbers);
                if (made.sphere.radius > T(0)) // a tangent family may shrink it to 0
                    result[family].push_back({made, exact(made.ray, made.sphere)});
            }
        }
        return result;
    }();
    return cases;
}

/// Runs all families through one way to intersect; returns a tally a family.
template <std::floating_point T, typename Intersect>
std::array<Tally, family_count> run(const char* title, Intersect intersect) {
    std::array<Tally, family_count> tallies{};
    print_head(title);
    Tally total, total_ordinary;
    for (std::size_t family = 0; family < family_count; ++family) {
        auto& tally = tallies[family];
        for (const auto& [input, truth] : all_cases<T>()[family])
            count(tally, truth, intersect(input.ray, input.sphere));
        print(family_names[family], tally);
        total.add(tally);
        if (is_ordinary(family)) total_ordinary.add(tally);
    }
    print("ordinary sizes, unit D (first nine)", total_ordinary);
    print("all", total);
    return tallies;
}

} // namespace

TEST_CASE(
    "sphere: float data computed in double: every decision right, t within 1 ulp") {
    const auto tallies = run<float>("float data, computed in double",
                                    [](const Ray& ray, const Sphere& s) {
                                        return ljus::intersect<double>(ray, s);
                                    });
    for (std::size_t family = 0; family < family_count; ++family) {
        INFO(family_names[family]);
        const auto& tally = tallies[family];
        CHECK(tally.firm + tally.hard == cases_a_family);
        CHECK(tally.firm_wrong == 0);
        CHECK(tally.hard_wrong == 0);
        CHECK(tally.within_1 == tally.hits);
    }
}

TEST_CASE("sphere: in float right where inputs within 8 units of roundoff decide") {
    const auto tallies = run<float>(
        "float data, computed in float",
        [](const Ray& ray, const Sphere& s) { return ljus::intersect(ray, s); });
    Tally total;
    for (std::size_t family = 0; family < family_count; ++family) {
        if (!is_ordinary(family)) continue;
        INFO(family_names[family]);
        const auto& tally = tallies[family];
        CHECK(tally.firm_wrong == 0);
        total.add(tally);
    }
    CHECK(total.within_4 >= 0.8 * total.hits);
}

TEST_CASE("sphere: double data computed in double, for sizes that double can square") {
    const auto tallies =
        run<double>("double data, computed in double",
                    [](const RayT<double>& ray, const SphereT<double>& s) {
                        return ljus::intersect(ray, s);
                    });
    Tally total;
    for (const auto& tally : tallies) {
        CHECK(tally.firm_wrong == 0);
        total.add(tally);
    }
    CHECK(total.within_4 >= 0.8 * total.hits);
}

TEST_CASE("sphere: the printed formula and glm's fail where the robust form holds") {
    const auto printed =
        run<float>("the report's formula, float", [](const Ray& ray, const Sphere& s) {
            return ljus::intersect_as_printed(ray, s);
        });
    const auto glms = run<float>(
        "glm::intersectRaySphere, float", [](const Ray& ray, const Sphere& s) {
            float t = 0;
            const bool hit = glm::intersectRaySphere(ray.origin, ray.direction,
                                                     s.center, s.radius * s.radius, t);
            return hit ? std::optional<float>(t) : std::nullopt;
        });
    CHECK(printed[far_away].firm_wrong > 0);
    CHECK(glms[far_away].firm_wrong > 0);
}
