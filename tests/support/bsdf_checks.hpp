#pragma once

/// \file support/bsdf_checks.hpp
/// \brief Properties that every material must have.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

#include "ljus/materials/material.hpp"
#include "support/draws.hpp"
#include "support/refusal.hpp"
#include "support/statistics.hpp"

namespace ljus_test {

// These functions also serve materials of other namespaces that do not define them; see
// OnlySpecular.
using ljus::evaluate, ljus::lobes, ljus::pdf;

/// The middles of n equal arcs of the unit circle. They are computed once for sums over
/// a hemisphere.
inline std::vector<glm::dvec2> directions_around(int n) {
    std::vector<glm::dvec2> ring;
    for (int i = 0; i < n; ++i) {
        const double phi = 2 * std::numbers::pi * (i + 0.5) / n;
        ring.emplace_back(std::cos(phi), std::sin(phi));
    }
    return ring;
}

/// The fraction of uniform light that all lobes but deltas send to `wo`, by the
/// midpoint rule in sin^2(theta) and phi. The rule is exact for a constant BSDF.
template <ljus::Material M>
ljus::RgbT<double> albedo_by_quadrature(const M& m,
                                        const ljus::Vec3T<typename M::Scalar>& wo,
                                        int n = 400) {
    using T = typename M::Scalar;
    const std::vector<glm::dvec2> around = directions_around(n);
    ljus::RgbT<double> sum{0};
    for (int i = 0; i < n; ++i) {
        const double sin2 = (i + 0.5) / n;
        const T z = std::copysign(T(std::sqrt(1 - sin2)), wo.z);
        ljus::RgbT<double> row{0}; // a sum of sums loses less to rounding
        for (const glm::dvec2& way : around) {
            const glm::dvec2 side = std::sqrt(sin2) * way;
            row += ljus::RgbT<double>(evaluate(m, wo, {T(side.x), T(side.y), z}));
        }
        sum += row;
    }
    return sum * (std::numbers::pi / n / n); // d(omega) cos = d(sin^2) d(phi)/2
}

/// The fraction of uniform light that the delta lobes send to `wo`: the mean weight of
/// samples over a grid of u.z. The weight depends on no other number, and the error is
/// a few 1/steps.
template <ljus::Material M>
ljus::RgbT<double> specular_albedo(const M& m,
                                   const ljus::Vec3T<typename M::Scalar>& wo,
                                   ljus::Transport transport, int steps = 20000) {
    using T = typename M::Scalar;
    ljus::RgbT<double> sum{0};
    for (int i = 0; i < steps; ++i) {
        const ljus::Vec3T<T> u{T(0.3), T(0.6), T((i + 0.5) / steps)};
        const auto s = sample(m, wo, u, transport);
        if (s && s->specular) sum += ljus::RgbT<double>(s->weight);
    }
    return sum / double(steps);
}

/// Checks Helmholtz reciprocity: the BSDF does not change if its directions are
/// exchanged.
template <ljus::Material M>
void check_reciprocity(const M& m, double roundoffs = 4) {
    using T = typename M::Scalar;
    Draws draws{17};
    for (int i = 0; i < 5000; ++i) {
        const auto a = draws.direction<T>(), b = draws.direction<T>();
        const auto ab = evaluate(m, a, b), ba = evaluate(m, b, a);
        for (int c = 0; c < 3; ++c) {
            REQUIRE(ab[c] >= 0);
            REQUIRE(std::abs(ab[c] - ba[c]) <=
                    T(roundoffs) * std::numeric_limits<T>::epsilon() * ab[c]);
        }
        if (!(a.z * b.z > 0)) REQUIRE(ljus::is_black(ab));
    }
}

/// Checks the samples of one `wo`, for the lobes `which`. sample() and pdf() must
/// agree, by a chi-square test with 3 false alarms in 10 million calls. The weight must
/// be f |cos|/pdf, directions must be unit vectors, and only requested lobes may
/// appear. The density of a cell is summed over `fine` by `fine` points.
template <ljus::Material M>
void check_sampling(const M& m, const ljus::Vec3T<typename M::Scalar>& wo,
                    ljus::Lobes which = ljus::Lobes::all, std::uint64_t seed = 1,
                    int fine = 16) {
    using T = typename M::Scalar;
    constexpr int rows = 10, columns = 12, count = 60000;
    constexpr double dphi = 2 * std::numbers::pi / columns, dz = 2.0 / rows;
    // The last cell counts deltas and absorbed samples.
    std::vector<double> counts(rows * columns + 1), expected(rows * columns + 1);
    const std::vector<glm::dvec2> ring = directions_around(columns * fine);
    double dense = 0;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column) {
            double sum = 0;
            for (int i = 0; i < fine; ++i) {
                const double z = -1 + dz * (row + (i + 0.5) / fine);
                const double r = std::sqrt((1 - z) * (1 + z));
                for (int j = 0; j < fine; ++j) {
                    const glm::dvec2 side = r * ring[std::size_t(column * fine + j)];
                    sum += double(pdf(m, wo, {T(side.x), T(side.y), T(z)}, which));
                }
            }
            const double share = sum / (fine * fine) * dz * dphi;
            expected[static_cast<std::size_t>(row * columns + column)] = share * count;
            dense += share;
        }
    CHECK(dense <= 1 + 1e-5);
    expected.back() = std::max(0.0, 1 - dense) * count;
    if (expected.back() < 1) expected.back() = 0; // error of the quadrature

    Draws draws{seed};
    const T u = std::numeric_limits<T>::epsilon() / 2;
    for (int i = 0; i < count; ++i) {
        const auto s = sample(m, wo, draws.cube<T>(), ljus::Transport::radiance, which);
        if (!s || s->specular) counts.back() += 1;
        if (!s) continue;
        REQUIRE(std::abs(glm::length(s->wi) - 1) <= 4 * u);
        REQUIRE(has(which,
                    s->specular ? ljus::Lobes::specular : ljus::Lobes::non_specular));
        REQUIRE(has(lobes(m),
                    s->specular ? ljus::Lobes::specular : ljus::Lobes::non_specular));
        if (s->specular) {
            REQUIRE(s->pdf == 0);
            continue;
        }
        REQUIRE(s->pdf > 0);
        REQUIRE(std::abs(s->pdf - pdf(m, wo, s->wi, which)) <= 8 * u * s->pdf);
        const auto f = evaluate(m, wo, s->wi);
        for (int c = 0; c < 3; ++c) {
            const T weight = f[c] * std::abs(s->wi.z) / s->pdf;
            REQUIRE(std::abs(s->weight[c] - weight) <= 32 * u * weight);
        }
        const double phi = std::atan2(double(s->wi.y), double(s->wi.x));
        const int column = std::min(
            static_cast<int>((phi < 0 ? phi + 2 * std::numbers::pi : phi) / dphi),
            columns - 1);
        const int row =
            std::min(static_cast<int>((double(s->wi.z) + 1) / dz), rows - 1);
        counts[static_cast<std::size_t>(row * columns + column)] += 1;
    }
    CHECK(chi_square_agrees(counts, expected, 5.0));
}

/// Checks extreme arguments: every corner of the unit cube, and steep, flat and grazing
/// `wo`. There must be no NaN, infinity or negative number, all directions must be unit
/// vectors, and a `wo` on the surface must give no sample.
template <ljus::Material M>
void check_extremes(const M& m, double most_weight) {
    using T = typename M::Scalar;
    const T last = std::nextafter(T(1), T(0)), tiny = std::numeric_limits<T>::min();
    const T grid[] = {T(0), std::numeric_limits<T>::denorm_min(), T(0.5), last};
    for (const T z : {T(1), T(0.5), T(1e-3), T(1e-6), tiny}) {
        for (const T side : {T(1), T(-1)}) {
            const T r = std::sqrt((1 - z) * (1 + z));
            for (const ljus::Vec3T<T> wo :
                 {ljus::Vec3T<T>{r, 0, side * z}, ljus::Vec3T<T>{0, -r, side * z}})
                for (const T x : grid)
                    for (const T y : grid)
                        for (const T w : grid) {
                            const auto s = sample(m, wo, ljus::Vec3T<T>{x, y, w},
                                                  ljus::Transport::flux);
                            if (!s) continue;
                            REQUIRE(std::abs(glm::length(s->wi) - 1) <=
                                    2 * std::numeric_limits<T>::epsilon());
                            REQUIRE(ljus::is_finite(s->weight));
                            REQUIRE(std::isfinite(s->pdf));
                            REQUIRE(s->pdf >= 0);
                            for (int c = 0; c < 3; ++c) {
                                REQUIRE(s->weight[c] >= 0);
                                REQUIRE(double(s->weight[c]) <= most_weight);
                            }
                            REQUIRE(ljus::is_finite(evaluate(m, wo, s->wi)));
                        }
        }
    }
    const ljus::Vec3T<T> u{T(0.5), T(0.5), T(0.5)};
    CHECK_FALSE(sample(m, ljus::Vec3T<T>{1, 0, 0}, u, ljus::Transport::radiance));
    CHECK(
        ljus::is_black(evaluate(m, ljus::Vec3T<T>{1, 0, 0}, ljus::Vec3T<T>{0, 0, 1})));
    CHECK(pdf(m, ljus::Vec3T<T>{0, 0, 1}, ljus::Vec3T<T>{1, 0, 0}) == 0);
    // Without an allowed lobe there is no sample.
    const ljus::Vec3T<T> up{0, 0, 1};
    CHECK_FALSE(sample(m, up, u, ljus::Transport::flux, ljus::Lobes::none));
    CHECK(pdf(m, up, up, ljus::Lobes::none) == 0);
    CHECK(pdf(m, up, up, ljus::Lobes::specular) == 0);
}

/// Checks that BSDF and density do not depend on the angle around the normal nor on the
/// side of the surface, and that the albedo does not exceed that of the facets.
template <ljus::Material M>
void check_symmetry(const M& m) {
    using T = typename M::Scalar;
    Draws draws{17};
    for (int i = 0; i < 500; ++i) {
        auto wo = draws.direction<T>(), wi = draws.direction<T>();
        wi.z = std::copysign(wi.z, wo.z);
        const T turn = draws.between(T(0), T(6)), c = std::cos(turn),
                s = std::sin(turn);
        const auto turned = [&](const ljus::Vec3T<T>& w, T side) {
            return ljus::Vec3T<T>{c * w.x - s * w.y, s * w.x + c * w.y, side * w.z};
        };
        for (const T side : {T(1), T(-1)}) {
            const auto a = evaluate(m, wo, wi);
            const auto b = evaluate(m, turned(wo, side), turned(wi, side));
            const double size = std::max(1.0, double(ljus::max_component(a)));
            REQUIRE(double(glm::distance(a, b)) < 1e-3 * size);
            const double p = double(pdf(m, wo, wi));
            const double q = double(pdf(m, turned(wo, side), turned(wi, side)));
            REQUIRE(std::abs(p - q) < 1e-3 * std::max(1.0, p));
        }
    }
}

/// The message with which check() refuses a material; empty if check() accepts the
/// material.
template <ljus::Material M>
std::string refusal(const M& m) {
    return refusal([&] { check(m); });
}

} // namespace ljus_test
