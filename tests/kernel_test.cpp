/// \file kernel_test.cpp
/// \brief Each kernel holds the volume 1; its shape by its values at known places.

#include "ljus/photons/kernel.hpp"

#include <doctest/doctest.h>

#include "support/integrate.hpp"
#include <array>

using ljus::Kernel;
using ljus::kernel_weight;

namespace {

constexpr std::array kernels{Kernel::box, Kernel::cone, Kernel::gaussian,
                             Kernel::epanechnikov, Kernel::biweight};

/// The mean over the unit disc of a power of a kernel, in polar coordinates.
double mean_over_disc(Kernel kernel, int power) {
    return ljus_test::integrate(0, 1, 16, [&](double r) {
        return 2 * r * std::pow(kernel_weight(kernel, r * r), power);
    });
}

} // namespace

TEST_CASE("kernel: the mean over the disc is 1") {
    for (const Kernel kernel : kernels) {
        CAPTURE(static_cast<int>(kernel));
        CHECK(mean_over_disc(kernel, 1) == doctest::Approx(1).epsilon(1e-12));
    }
}

TEST_CASE("kernel: the mean square, by which the variance grows") {
    // Integrals of w^2 over the disc, worked out on paper.
    const double e = std::exp(-2.0);
    const std::array expected{1.0, 1.5, (1 + e) / (1 - e), 4.0 / 3, 9.0 / 5};
    for (std::size_t i = 0; i < kernels.size(); ++i) {
        CAPTURE(i);
        CHECK(mean_over_disc(kernels[i], 2) ==
              doctest::Approx(expected[i]).epsilon(1e-12));
    }
}

TEST_CASE("kernel: values in the middle, half way and at the edge") {
    const double e = std::exp(-2.0);
    const auto check = [](Kernel kernel, double middle, double half, double edge) {
        CAPTURE(static_cast<int>(kernel));
        CHECK(kernel_weight(kernel, 0.0) == doctest::Approx(middle).epsilon(1e-14));
        CHECK(kernel_weight(kernel, 0.25) == doctest::Approx(half).epsilon(1e-14));
        CHECK(kernel_weight(kernel, 1.0) == doctest::Approx(edge).epsilon(1e-14));
    };
    check(Kernel::box, 1, 1, 1);
    check(Kernel::cone, 3, 1.5, 0);
    check(Kernel::gaussian, 2 / (1 - e), 2 / (1 - e) * std::exp(-0.5), 2 / (1 / e - 1));
    check(Kernel::epanechnikov, 2, 1.5, 0);
    check(Kernel::biweight, 3, 27.0 / 16, 0);
}

TEST_CASE("kernel: none grows with the distance, none is negative") {
    for (const Kernel kernel : kernels) {
        float before = kernel_weight(kernel, 0.0f);
        for (int i = 1; i <= 1000; ++i) {
            const float weight = kernel_weight(kernel, float(i) / 1000);
            REQUIRE(weight <= before);
            REQUIRE(weight >= 0);
            before = weight;
        }
    }
}

TEST_CASE("kernel: float is double, rounded") {
    for (const Kernel kernel : kernels)
        for (int i = 0; i <= 1000; ++i) {
            const float x = float(i) / 1000;
            // 1 - x cancels near the edge, but its error is that of a float near 1.
            REQUIRE(std::abs(double(kernel_weight(kernel, x)) -
                             kernel_weight(kernel, double(x))) < 5e-7);
        }
}

TEST_CASE("kernel: one that is not listed has no weight") {
    CHECK(ljus::kernel_weight(static_cast<ljus::Kernel>(99), 0.25f) == 0);
}
