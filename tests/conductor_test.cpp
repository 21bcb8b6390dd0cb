// needs: boost
/// \file conductor_test.cpp
/// \brief The reflectance of metals against complex numbers of 50 digits.

#include "ljus/optics/conductor.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include <boost/multiprecision/cpp_complex.hpp>

#include "ljus/optics/fresnel.hpp"
#include "support/draws.hpp"
#include "support/refusal.hpp"

using ljus_test::Draws;

namespace {

using Complex = boost::multiprecision::cpp_complex_50;
using Real = Complex::value_type;

/// Fresnel's equations as they are printed, with the
/// transmitted angle's complex cosine.
Real exact(const Real& cos_theta, const Real& n, const Real& k) {
    const Complex index(n, k);
    const Complex c(cos_theta, 0);
    const Complex sin2 = Complex(1, 0) - c * c;
    const Complex cos_t = sqrt(Complex(1, 0) - sin2 / (index * index));
    const Complex r_s = (c - index * cos_t) / (c + index * cos_t);
    const Complex r_p = (index * c - cos_t) / (index * c + cos_t);
    return (norm(r_s) + norm(r_p)) / 2;
}

/// How much the reflectance changes when each input moves by a unit of roundoff.
Real sensitivity(const Real& c, const Real& n, const Real& k, const Real& u) {
    const Real here = exact(c, n, k);
    return abs(exact(c * (1 - u), n, k) - here) + abs(exact(c, n * (1 + u), k) - here) +
           abs(exact(c, n, k * (1 + u)) - here);
}

} // namespace

TEST_CASE_TEMPLATE("conductor: as complex numbers have it, for any n, k and angle", T,
                   float, double) {
    Draws draws;
    const double u = std::numeric_limits<T>::epsilon() / 2;
    double worst = 0; // in units of what the rounding of the inputs alone may do
    for (int i = 0; i < 10000; ++i) {
        const T n = static_cast<T>(std::pow(10.0, draws.between(-2.0, 1.0)));
        const T k = static_cast<T>(std::pow(10.0, draws.between(-2.0, 1.0)));
        T c = draws.unit<T>();
        if (i % 4 == 1) c = static_cast<T>(std::pow(10.0, draws.between(-6.0, 0.0)));
        if (i % 4 == 2)
            c = T(1) - static_cast<T>(std::pow(10.0, draws.between(-6., 0.)));
        const T found = ljus::fresnel_conductor(c, n, k);
        REQUIRE(found >= 0);
        REQUIRE(double(found) <= 1 + 2 * u);
        const Real error = abs(Real(found) - exact(c, n, k));
        const Real unit = u + sensitivity(c, n, k, u);
        worst = std::max(worst, (error / unit).convert_to<double>());
    }
    MESSAGE("largest error ", worst, " times u + what the rounding of the inputs does");
    CHECK(worst <= 8);
}

TEST_CASE(
    "conductor: without extinction it is a dielectric, total reflection and all") {
    Draws draws{2};
    for (int i = 0; i < 10000; ++i) {
        const double c = draws.unit<double>();
        const double n = std::pow(10.0, draws.between(-1.0, 1.0));
        REQUIRE(ljus::fresnel_conductor(c, n, 0.0) ==
                doctest::Approx(ljus::fresnel(c, 1.0, n)).epsilon(1e-9));
    }
    CHECK(ljus::fresnel_conductor(0.3, 1.0, 0.0) == doctest::Approx(0).epsilon(1e-15));
}

TEST_CASE("conductor: what is known of metals") {
    // Normal incidence, ((n - 1)^2 + k^2) / ((n + 1)^2 + k^2).
    const auto gold = ljus::fresnel_conductor(1.0, ljus::gold<double>);
    CHECK(gold.x == doctest::Approx(0.953).epsilon(1e-3));
    CHECK(gold.y == doctest::Approx(0.807).epsilon(1e-3));
    CHECK(gold.z == doctest::Approx(0.356).epsilon(2e-3));
    const auto silver = ljus::fresnel_conductor(1.0, ljus::silver<double>);
    CHECK(silver.x > 0.97);
    CHECK(silver.z > 0.97);
    const auto copper = ljus::fresnel_conductor(1.0, ljus::copper<double>);
    CHECK(copper.x > copper.y);
    CHECK(copper.y > copper.z);
    // Everything mirrors at grazing incidence.
    for (int channel = 0; channel < 3; ++channel)
        CHECK(ljus::fresnel_conductor(0.0, ljus::gold<double>)[channel] == 1);
}

TEST_CASE("conductor: the indices of the three metals, typed a second time") {
    // R at normal incidence by another program, from the measured n and k.
    const auto check = [](const ljus::ConductorIndexT<double>& metal,
                          const glm::dvec3& right) {
        const auto found = ljus::fresnel_conductor(1.0, metal);
        for (int i = 0; i < 3; ++i) CHECK(std::abs(found[i] - right[i]) < 6e-7);
    };
    check(ljus::gold<double>, {0.953026, 0.807158, 0.356061});
    check(ljus::copper<double>, {0.970051, 0.599719, 0.551778});
    check(ljus::silver<double>, {0.989580, 0.984384, 0.976234});
    CHECK(ljus::gold<float>.n == ljus::Rgb{ljus::gold<double>.n});
}

TEST_CASE("conductor: the light that iron reflects falls before it rises") {
    // The pseudo-Brewster angle: a minimum, above 0 and beyond 45 degrees.
    double least = 1, at = 1;
    for (int i = 0; i <= 1000; ++i) {
        const double c = i / 1000.0;
        const double r = ljus::fresnel_conductor(c, 2.9, 3.4);
        if (r < least) {
            least = r;
            at = c;
        }
    }
    CHECK(at < 0.707);
    CHECK(at > 0.1);
    CHECK(least > 0.4);
    CHECK(least < ljus::fresnel_conductor(1.0, 2.9, 3.4));
}

TEST_CASE_TEMPLATE("conductor: a share for every index and angle, 0 among them", T,
                   float, double) {
    const T least = std::numeric_limits<T>::denorm_min();
    int wrong = 0;
    for (const T n : {T(0), least, T(0.5), T(1), T(3), T(1e9)})
        for (const T k : {T(0), least, T(1e-20), T(1), T(1e9)})
            for (const T c : {T(0), least, T(1e-20), T(1e-4), T(0.6), T(1)}) {
                const T r = ljus::fresnel_conductor(c, n, k);
                wrong += !(r >= T(0) && r <= T(1) + T(1e-6));
            }
    CHECK(wrong == 0);
    CHECK(ljus::fresnel_conductor(T(0), T(1), T(0)) == T(1)); // 0/0, found from outside
    CHECK(ljus::fresnel_conductor(T(1), T(0), T(0)) == T(1));
}

TEST_CASE("conductor: an index below 0, above 1e9 or of NaN is refused by name") {
    const auto message = [](float n, float k) {
        return ljus_test::refusal([&] {
            ljus::detail::require_conductor(
                "metal.index", ljus::ConductorIndex{ljus::Rgb{n}, ljus::Rgb{k}});
        });
    };
    CHECK(message(0.2f, 3).empty());
    CHECK(message(-1, 3).find("metal.index.n") == 0);
    CHECK(message(1, -3).find("metal.index.k") == 0);
    CHECK(message(NAN, 3).find("metal.index.n") == 0);
    CHECK(message(1e30f, 3).find("metal.index.n") == 0); // its square is infinite
}
