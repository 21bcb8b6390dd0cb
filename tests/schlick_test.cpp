/// \file schlick_test.cpp
/// \brief How far Schlick's formula is from Fresnel's, and that
/// it needs no other header.

#include "ljus/optics/schlick.hpp" // first and alone: it must need nothing

static_assert(ljus::schlick_r0(1.0, 1.5) > 0.0399999 &&
              ljus::schlick_r0(1.0, 1.5) < 0.0400001);
static_assert(ljus::schlick(0.04f, 1.0f) == 0.04f);

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include "ljus/optics/fresnel.hpp"
#include "support/within.hpp"

namespace {

struct Largest {
    double error = 0, degrees = 0;
};

/// The largest difference from Fresnel over the angles, from one side.
template <typename Approximation>
Largest largest(double n_i, double n_t, Approximation approximation) {
    Largest worst;
    for (int i = 0; i <= 9000; ++i) {
        const double degrees = i / 100.0;
        const double c = std::cos(degrees * 3.14159265358979323846 / 180);
        const double error =
            std::abs(approximation(c) - ljus::fresnel(std::max(c, 0.0), n_i, n_t));
        if (error > worst.error) worst = {error, degrees};
    }
    return worst;
}

} // namespace

TEST_CASE("schlick: the curve for glass that the report's program did not have") {
    // The program evaluated it with cos = 1 at every angle: 0.04 throughout.
    const double r0 = ljus::schlick_r0(1.0, 1.5);
    const double expected[][2] = {
        {0, 0.04}, {60, 0.07}, {75, 0.25}, {85, 0.65}, {89, 0.92}};
    for (const auto& [degrees, r] : expected) {
        const double c = std::cos(degrees * 3.14159265358979323846 / 180);
        CHECK(std::abs(ljus::schlick(r0, c) - r) < 0.006);
    }
}

TEST_CASE("schlick: the largest error against Fresnel is as measured before") {
    const double table[][2] = {
        {1.15, 0.151}, {1.33, 0.060}, {1.47, 0.038}, {1.5, 0.036}, {2.42, 0.076}};
    for (const auto& row : table) {
        const double n = row[0], error = row[1];
        CAPTURE(n);
        const auto in = largest(
            1, n, [n](double c) { return ljus::schlick_dielectric(c, 1.0, n); });
        CHECK(in.error == ljus_test::within(error, 0.02));
        // From inside the same curve is run through, with the angles of Snell's law.
        const auto out = largest(
            n, 1, [n](double c) { return ljus::schlick_dielectric(c, n, 1.0); });
        CHECK(out.error == ljus_test::within(error, 0.02));
    }
    CHECK(largest(1, 1.15, [](double c) {
              return ljus::schlick_dielectric(c, 1.0, 1.15);
          }).degrees == doctest::Approx(82.9).epsilon(0.01));
}

TEST_CASE("schlick: as printed it is wrong by up to 0.96 from inside glass") {
    const double r0 = ljus::schlick_r0(1.0, 1.5);
    const auto printed =
        largest(1.5, 1, [r0](double c) { return ljus::schlick(r0, c); });
    CHECK(printed.error == doctest::Approx(0.96).epsilon(0.005));
    CHECK(printed.degrees == doctest::Approx(41.8).epsilon(0.005));
}

TEST_CASE(
    "schlick: the hemisphere's mean for glass is 0.0857, where Fresnel has 0.0918") {
    // Cosine-weighted: the integral of 2 c R(c) dc, by the midpoint rule.
    double schlick = 0, fresnel = 0;
    const int n = 100000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        schlick += 2 * c * ljus::schlick_dielectric(c, 1.0, 1.5) / n;
        fresnel += 2 * c * ljus::fresnel(c, 1.0, 1.5) / n;
    }
    CHECK(schlick == ljus_test::within(0.0857, 0.001));
    CHECK(fresnel == ljus_test::within(0.0918, 0.001));
}

TEST_CASE("schlick: with both cosines at hand it is the same, without a square root") {
    for (int i = 1; i <= 100; ++i) {
        const double cos_thin = i / 100.0;
        const double sin2 = (1 - cos_thin * cos_thin) / (1.5 * 1.5);
        const double cos_dense = std::sqrt(1 - sin2);
        const double in = ljus::schlick(1.0, 1.5, cos_thin, cos_dense);
        CHECK(in == doctest::Approx(ljus::schlick_dielectric(cos_thin, 1.0, 1.5)));
        CHECK(ljus::schlick(1.5, 1.0, cos_dense, cos_thin) == doctest::Approx(in));
        CHECK(ljus::schlick_dielectric(cos_dense, 1.5, 1.0) == doctest::Approx(in));
    }
    // Total reflection is a refracted cosine of 0.
    CHECK(ljus::schlick(1.5f, 1.0f, 0.5f, 0.0f) == 1.0f);
    CHECK(ljus::schlick_dielectric(0.5f, 1.5f, 1.0f) == 1.0f);
    CHECK(ljus::schlick_dielectric(0.0f, 1.0f, 1.5f) == 1.0f);
    CHECK(ljus::schlick(0.04f, 0.0f) == 1.0f);
}

TEST_CASE("schlick: within [0, 1] for every index and angle") {
    for (float n = 0.001f; n < 1000; n *= 1.7f)
        for (float c = 0; c <= 1; c += 1.0f / 64) {
            const float r = ljus::schlick_dielectric(c, 1.0f, n);
            REQUIRE((r >= 0 && r <= 1));
        }
}
