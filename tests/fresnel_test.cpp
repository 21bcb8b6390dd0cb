/// \file fresnel_test.cpp
/// \brief The angles at which Fresnel's equations are known.

#include "ljus/optics/fresnel.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>

#include "support/draws.hpp"

using ljus::fresnel;
using ljus_test::Draws;

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
    // The equations as the textbook prints them, with angles.
    const auto printed = [](double degrees) {
        const double i = degrees * 3.14159265358979323846 / 180;
        const double t = std::asin(std::sin(i) / 1.5);
        const double s = std::sin(i - t) / std::sin(i + t);
        const double p = std::tan(i - t) / std::tan(i + t);
        return (s * s + p * p) / 2;
    };
    const double table[][2] = {{1, 0.0400},  {45, 0.0502}, {60, 0.0892},
                               {75, 0.2531}, {85, 0.6133}, {89, 0.9037}};
    for (const auto& row : table) {
        const double degrees = row[0], r = row[1];
        CAPTURE(degrees);
        const double c = ljus_test::at_degrees<double>(degrees).z;
        CHECK(fresnel(c, 1.0, 1.5) == doctest::Approx(printed(degrees)).epsilon(1e-11));
        CHECK(std::abs(fresnel(c, 1.0, 1.5) - r) < 1e-3);
    }
}

TEST_CASE("fresnel: the model that a material names is the one that is used") {
    using ljus::FresnelModel;
    CHECK(fresnel(FresnelModel::exact, 0.1, 1.0, 1.5) == fresnel(0.1, 1.0, 1.5));
    CHECK(fresnel(FresnelModel::schlick, 0.1, 1.0, 1.5) ==
          ljus::schlick_dielectric(0.1, 1.0, 1.5));
}

TEST_CASE("fresnel: Schlick's curve takes the cosine of the thinner side, by Snell") {
    // (1 - R0) m^5 + R0 with m = 1 - cosine, the cosine by angles.
    for (const double n : {1.1, 1.5, 2.4})
        for (const double degrees : {0.0, 10.0, 20.0, 24.0, 35.0, 41.0, 60.0, 89.0}) {
            const double angle = degrees * 3.14159265358979323846 / 180;
            const double r0 = (n - 1) * (n - 1) / ((n + 1) * (n + 1));
            const double m = 1 - std::cos(angle);
            CAPTURE(n);
            CAPTURE(degrees);
            CHECK(ljus::schlick_dielectric(std::cos(angle), 1.0, n) ==
                  doctest::Approx(r0 + (1 - r0) * std::pow(m, 5)));
            const double sine = n * std::sin(angle);
            const double thin = sine < 1 ? 1 - std::cos(std::asin(sine)) : 1;
            CHECK(ljus::schlick_dielectric(std::cos(angle), n, 1.0) ==
                  doctest::Approx(r0 + (1 - r0) * std::pow(thin, 5)));
        }
}

TEST_CASE("fresnel: Schlick's curve depends on the ratio of the indices alone") {
    for (const double scale : {0.7, 1.3, 2.0})
        for (const double c : {0.0, 0.2, 0.7, 0.8, 0.95, 1.0}) {
            CHECK(ljus::schlick_dielectric(c, 1.5 * scale, scale) ==
                  doctest::Approx(ljus::schlick_dielectric(c, 1.5, 1.0)));
            CHECK(ljus::schlick_dielectric(c, scale, 1.5 * scale) ==
                  doctest::Approx(ljus::schlick_dielectric(c, 1.0, 1.5)));
        }
}

TEST_CASE_TEMPLATE("fresnel: a share of light for all indices of its range", T, float,
                   double) {
    Draws draws{53};
    int wrong = 0;
    for (int i = 0; i < 200000; ++i) {
        const auto index = [&](int k) {
            if (i % 5 == k) return T(i % 2 ? 1e-9 : 1e9); // its ends
            return T(std::pow(10.0, draws.between(-9.0, 9.0)));
        };
        const T n_i = index(0), n_t = index(1);
        const T c = i % 3 ? draws.unit<T>() : T(i % 2);
        for (const T r : {fresnel(c, n_i, n_t), ljus::schlick_dielectric(c, n_i, n_t),
                          ljus::schlick_r0(n_i, n_t)})
            wrong += !(r >= 0 && r <= 1);
    }
    CHECK(wrong == 0);
}
