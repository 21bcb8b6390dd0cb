// needs: boost

/// \file fresnel_test.cpp
/// \brief Fresnel's equations against 50 digits.

#include "ljus/optics/fresnel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include <boost/multiprecision/cpp_bin_float.hpp>

#include "support/draws.hpp"

using ljus::fresnel;
using ljus_test::Draws;

namespace {

using Exact = boost::multiprecision::cpp_bin_float_50;

/// Fresnel by the amplitudes of the textbook.
Exact exact_fresnel(const Exact& c, const Exact& n_i, const Exact& n_t) {
    const Exact q = n_i / n_t * sqrt((1 - c) * (1 + c));
    if (q >= 1) return 1;
    const Exact t = sqrt((1 - q) * (1 + q));
    const Exact s = (n_i * c - n_t * t) / (n_i * c + n_t * t);
    const Exact p = (n_t * c - n_i * t) / (n_t * c + n_i * t);
    return (s * s + p * p) / 2;
}

/// By how much relative changes of the three inputs come out larger.
Exact condition(const Exact& c, const Exact& n_i, const Exact& n_t) {
    const Exact h("1e-20"), r = exact_fresnel(c, n_i, n_t);
    const Exact sum = abs(exact_fresnel(c * (1 - h), n_i, n_t) - r) +
                      abs(exact_fresnel(c, n_i * (1 + h), n_t) - r) +
                      abs(exact_fresnel(c, n_i, n_t * (1 + h)) - r);
    return sum / (h * r);
}

} // namespace

TEST_CASE_TEMPLATE(
    "fresnel: within 2 roundoffs times (1 + condition), for index ratios "
    "1e-3 to 1e3 and all angles",
    T, float, double) {
    const Exact u = Exact(std::numeric_limits<T>::epsilon()) / 2;
    Draws draws;
    double worst = 0;
    for (int i = 0; i < 24000; ++i) {
        T c = draws.unit<T>();
        if (i % 3 == 1) c = static_cast<T>(std::pow(10.0, draws.between(-6.0, 0.0)));
        if (i % 3 == 2)
            c = T(1) - static_cast<T>(std::pow(10.0, draws.between(-6.0, 0.0)));
        double n = draws.between(1.0, 4.0);
        if (i / 3 % 3 == 1) n = 1 + std::pow(10.0, draws.between(-6.0, 0.0));
        if (i / 3 % 3 == 2) n = std::pow(10.0, draws.between(-3.0, 3.0));
        T n_i = static_cast<T>(n), n_t = i % 5 == 0 ? T(1.3) : T(1);
        if (i / 9 % 2) std::swap(n_i, n_t);
        const Exact r = exact_fresnel(c, n_i, n_t);
        const T ours = fresnel(c, n_i, n_t);
        REQUIRE((ours >= 0 && ours <= 1));
        if (r == 1 || r == 0) continue; // decided below
        const Exact units = abs(Exact(ours) - r) / (r * u);
        worst =
            std::max(worst, static_cast<double>(units / (1 + condition(c, n_i, n_t))));
    }
    MESSAGE("largest error: ", worst, " u (1 + condition)");
    CHECK(worst <= 2);
}

TEST_CASE("fresnel: exact at normal incidence, at grazing, and for equal indices") {
    CHECK(fresnel(1.0, 1.0, 1.5) == doctest::Approx(0.04).epsilon(1e-15));
    CHECK(fresnel(1.0, 1.5, 1.0) == doctest::Approx(0.04).epsilon(1e-15));
    CHECK(fresnel(1.0, 1.0, 3.0) == doctest::Approx(0.25).epsilon(1e-15));
    CHECK(fresnel(0.0, 1.0, 1.5) == 1);
    CHECK(fresnel(0.0f, 1.0f, 1.5f) == 1);
    for (const float c : {0.0f, 1e-20f, 0.3f, 1.0f})
        for (const float n : {0.001f, 1.0f, 1.3f, 1000.0f})
            CHECK(fresnel(c, n, n) == 0);
}

TEST_CASE("fresnel: at Brewster's angle only one polarisation is left") {
    // There R_p = 0 and R_s = ((n^2 - 1)/(n^2 + 1))^2.
    for (const double n : {1.1, 1.33, 1.5, 2.42, 10.0}) {
        const double s = (n * n - 1) / (n * n + 1);
        CHECK(fresnel(1 / std::sqrt(1 + n * n), 1.0, n) ==
              doctest::Approx(s * s / 2).epsilon(1e-12));
    }
}

TEST_CASE("fresnel: both sides of a boundary reflect the same along one path") {
    Draws draws{4};
    for (int i = 0; i < 20000; ++i) {
        const double c = draws.unit<double>();
        const double n = draws.between(1.01, 4.0);
        const double t = std::sqrt(1 - (1 - c * c) / (n * n));
        REQUIRE(fresnel(c, 1.0, n) ==
                doctest::Approx(fresnel(t, n, 1.0)).epsilon(1e-9));
    }
}

TEST_CASE("fresnel: all is reflected beyond the critical angle, and less before it") {
    for (const double n : {1.0001, 1.33, 1.5, 10.0, 1000.0}) {
        const double critical = std::sqrt((n - 1) * (n + 1)) / n; // its cosine
        CHECK(fresnel(critical * (1 - 1e-12), n, 1.0) == 1);
        CHECK(fresnel(critical / 2, n, 1.0) == 1);
        CHECK(fresnel(0.0, n, 1.0) == 1);
        CHECK(fresnel(critical + (1 - critical) * 1e-6, n, 1.0) < 1);
    }
}

TEST_CASE(
    "fresnel: a rim is brighter than the middle, as no picture of the report shows") {
    // Known values for glass, from outside.
    const double table[][2] = {{0, 0.0400},  {45, 0.0502}, {60, 0.0892},
                               {75, 0.2531}, {85, 0.6133}, {89, 0.9037}};
    for (const auto& row : table) {
        const double degrees = row[0], r = row[1];
        CAPTURE(degrees);
        const double c = ljus_test::at_degrees<double>(degrees).z;
        CHECK(std::abs(fresnel(c, 1.0, 1.5) - r) < 2e-3);
        CHECK(std::abs(static_cast<double>(exact_fresnel(c, 1, Exact(3) / 2)) - r) <
              2e-3);
    }
}

TEST_CASE("fresnel: the model that a material names is the one that is used") {
    using ljus::FresnelModel;
    CHECK(fresnel(FresnelModel::exact, 0.1, 1.0, 1.5) == fresnel(0.1, 1.0, 1.5));
    CHECK(fresnel(FresnelModel::schlick, 0.1, 1.0, 1.5) ==
          ljus::schlick_dielectric(0.1, 1.0, 1.5));
}
