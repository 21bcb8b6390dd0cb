// needs: boost
// concept: refraction

/// \file refraction_exact_test.cpp
/// \brief Snell's law and the critical angle against 50 digits.

#include "ljus/optics/refraction.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "support/draws.hpp"

using ljus::Vec3T;
using ljus_test::Draws;

namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;

struct Exact3 {
    Exact x, y, z;
    template <typename T>
    explicit Exact3(const Vec3T<T>& v) : x(v.x), y(v.y), z(v.z) {}
    Exact3(Exact a, Exact b, Exact c) : x(a), y(b), z(c) {}
};

Exact dot(const Exact3& a, const Exact3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
Exact length(const Exact3& a) {
    return sqrt(dot(a, a));
}
Exact3 cross(const Exact3& a, const Exact3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// The exact sine of the angle between two rounded vectors.
Exact sine(const Exact3& a, const Exact3& b) {
    return length(cross(a, b)) / (length(a) * length(b));
}

/// An index ratio from 1e-3 to 1e3, as often below 1 as above.
template <typename T>
T ratio(Draws& draws) {
    return static_cast<T>(std::pow(10.0, draws.between(-3.0, 3.0)));
}

/// A direction towards a normal: at any angle, at grazing ones, and for a large index
/// ratio at those that can pass, and close to the critical one.
template <typename T>
Vec3T<T> incoming(Draws& draws, const Vec3T<T>& normal, T eta, int kind) {
    using L = long double;
    const auto unit = [](const glm::vec<3, L>& v) { return v / glm::length(v); };
    const glm::vec<3, L> n = unit(glm::vec<3, L>(normal));
    const glm::vec<3, L> d = draws.direction<double>();
    const glm::vec<3, L> along = unit(d - glm::dot(d, n) * n);
    const L most = std::min(L(1), 1 / L(eta));
    L s = draws.unit<double>();
    if (kind == 1) s *= most;
    if (kind == 2) s = most * (1 - std::pow(L(10), L(draws.between(-16.0, -2.0))));
    if (kind == 3) s = std::pow(L(10), L(draws.between(-12.0, 0.0))) * most;
    return Vec3T<T>(unit(s * along - std::sqrt((1 - s) * (1 + s)) * n));
}

struct Worst {
    double length = 0, snell = 0, plane = 0;
};

/// The largest errors in units of roundoff over many cases.
template <typename T, typename Refract>
Worst worst(Refract refract_it, bool local) {
    const Exact u = Exact(std::numeric_limits<T>::epsilon()) / 2;
    Draws draws;
    Worst worst;
    for (int i = 0; i < 20000; ++i) {
        const Vec3T<T> n = local ? Vec3T<T>{0, 0, 1} : draws.direction<T>();
        const T eta = ratio<T>(draws);
        const Vec3T<T> d = incoming(draws, n, eta, i % 4);
        const auto t = refract_it(d, n, eta);
        if (!t) continue;
        const Exact3 en(n), ed(d), et(*t);
        const auto units = [u](const Exact& e) {
            return static_cast<double>(abs(e) / u);
        };
        worst.length = std::max(worst.length, units(length(et) - 1));
        const Exact residual = sine(en, et) - Exact(eta) * sine(en, ed);
        worst.snell = std::max(worst.snell, units(residual));
        // T lies in the plane of D and N; relevant where that plane is known.
        const Exact3 side = cross(en, ed);
        if (length(side) > Exact(0.01))
            worst.plane = std::max(worst.plane, units(dot(et, side) / length(side)));
    }
    return worst;
}

} // namespace

TEST_CASE_TEMPLATE("refraction_exact: unit length and Snell's law within 4 roundoffs, "
                   "index ratios 1e-3 to 1e3",
                   T, float, double) {
    for (const bool local : {false, true}) {
        const Worst w = worst<T>(
            [local](const Vec3T<T>& d, const Vec3T<T>& n, T eta) {
                return local ? ljus::refract(Vec3T<T>{-d.x, -d.y, -d.z}, eta)
                             : ljus::refract(d, n, eta);
            },
            local);
        MESSAGE((local ? "local" : "world"), ": |T| - 1 ", w.length, " u, Snell ",
                w.snell, " u, out of the plane ", w.plane, " u");
        CHECK(w.length <= 4);
        CHECK(w.snell <= 4);
        CHECK(w.plane <= 4);
    }
}

TEST_CASE_TEMPLATE(
    "refraction_exact: total reflection is decided right unless it takes "
    "less than 8 roundoffs to change it",
    T, float, double) {
    const Exact u = Exact(std::numeric_limits<T>::epsilon()) / 2;
    Draws draws{3};
    int passed = 0, reflected = 0;
    double farthest = 0; // of a wrong decision from the critical angle, in roundoffs
    for (int i = 0; i < 40000; ++i) {
        const bool local = i % 2 == 0;
        const Vec3T<T> n = local ? Vec3T<T>{0, 0, 1} : draws.direction<T>();
        const T eta =
            i % 4 < 2 ? static_cast<T>(std::pow(10.0, draws.between(0.0, 3.0)))
                      : static_cast<T>(1 + std::pow(10.0, draws.between(-9.0, 0.0)));
        // Sines from a bit below the critical one to a bit above.
        Vec3T<T> d = incoming(draws, n, eta, 2);
        const double few = draws.between(-40.0, 40.0);
        d = Vec3T<T>(glm::vec<3, long double>(d) +
                     static_cast<long double>(few) * std::numeric_limits<T>::epsilon() *
                         glm::vec<3, long double>(draws.direction<double>()));
        const Exact q = Exact(eta) * sine(Exact3(n), Exact3(d));
        const auto t = local ? ljus::refract(-d, eta) : ljus::refract(d, n, eta);
        ++(t ? passed : reflected);
        if (bool(t) != (q <= 1))
            farthest = std::max(farthest, static_cast<double>(abs(q - 1) / u));
    }
    MESSAGE("refracted ", passed, ", reflected ", reflected,
            "; a wrong decision at most ", farthest, " u from the critical sine");
    CHECK(farthest <= 8);
    CHECK(passed > 1000);
    CHECK(reflected > 1000);
}
