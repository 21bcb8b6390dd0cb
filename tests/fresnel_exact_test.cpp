// needs: boost
// concept: fresnel

/// \file fresnel_exact_test.cpp
/// \brief Fresnel's equations against 50 digits.

#include "ljus/optics/fresnel.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

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
    "fresnel_exact: within 2 roundoffs times (1 + condition), for index ratios "
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
