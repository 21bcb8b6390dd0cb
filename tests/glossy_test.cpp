// needs: boost
/// \file glossy_test.cpp
/// \brief Gloss: a density for its samples, no light from nowhere, and a mirror at the
/// end.
///
/// Its statistical cases were run with 20 further seeds (`./scripts/test --seeds 20`):
/// none failed.

#include "ljus/materials/glossy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

#include "support/bsdf_checks.hpp"
#include "support/seed.hpp"

using ljus::Glossy, ljus::GlossyT, ljus::RoughMetal, ljus::Lobes, ljus::Transport;
using ljus::Vec3T;
using namespace ljus_test;

namespace {

using Real = boost::multiprecision::cpp_bin_float_50;
template <typename T>
using MetalOf = GlossyT<T, ljus::ConductorIndexT<T>>;

/// f for F = 1 as the papers print it, with angles, D, Lambda, and the quotient by both
/// cosines.
Real printed(const Real& alpha, const Real& ox, const Real& oy, const Real& oz,
             const Real& ix, const Real& iy, const Real& iz) {
    const Real hx = ox + ix, hy = oy + iy, hz = oz + iz;
    const Real length2 = hx * hx + hy * hy + hz * hz;
    const Real cos2 = hz * hz / length2, a2 = alpha * alpha;
    const Real root = cos2 * (a2 - 1) + 1;
    const Real d = a2 / (boost::math::constants::pi<Real>() * root * root);
    const auto lambda = [&](const Real& x, const Real& y, const Real& z) -> Real {
        return (sqrt(Real(1 + a2 * (x * x + y * y) / (z * z))) - 1) / 2;
    };
    const Real g2 = 1 / (1 + lambda(ox, oy, oz) + lambda(ix, iy, iz));
    return d * g2 / (4 * oz * iz);
}

/// Gloss on a matt ground.
struct Coat : Glossy {};
Lobes lobes(const Coat&) {
    return Lobes::diffuse | Lobes::glossy;
}

/// The albedo of white by the weights of a grid of samples: smooth in u.
template <typename T>
double albedo_by_samples(const GlossyT<T>& m, double degrees, int n = 200) {
    double sum = 0;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const Vec3T<T> u{T((i + 0.5) / n), T((j + 0.5) / n), T(0)};
            const auto s = sample(m, at_degrees<T>(degrees), u, Transport::radiance);
            if (s) sum += double(s->weight.x);
        }
    return sum / n / n;
}

} // namespace

TEST_CASE_TEMPLATE("glossy: within its inputs' rounding of 50 digits", T, float,
                   double) {
    Draws draws{ljus_test::test_seed(1)};
    const double u = std::numeric_limits<T>::epsilon() / 2;
    double worst = 0;
    for (int i = 0; i < 10000; ++i) {
        const T roughness = T(0.01) + T(0.99) * draws.unit<T>();
        const GlossyT<T> m{.reflectance = ljus::RgbT<T>{1}, .roughness = roughness};
        auto wo = draws.above<T>();
        if (i % 4 == 1) wo = at_degrees<T>(90 - draws.between(0.001, 1.0));
        auto wi = draws.above<T>();
        // Where the light is: mirror directions, and grazing ones.
        if (i % 2)
            if (const auto s = sample(m, wo, draws.cube<T>(), Transport::flux))
                wi = s->wi;
        const Real alpha = Real(roughness) * Real(roughness);
        const auto exact = [&](double move_z) {
            return printed(alpha, wo.x, wo.y, wo.z, wi.x, wi.y,
                           Real(wi.z) * (1 + move_z));
        };
        const auto exact_x = [&](double move) {
            return printed(alpha, Real(wo.x) + move, wo.y, wo.z, Real(wi.x) + move,
                           wi.y, wi.z);
        };
        const auto exact_y = [&](double move) {
            return printed(alpha, wo.x, Real(wo.y) + move, wo.z, wi.x,
                           Real(wi.y) + move, wi.z);
        };
        const Real here = exact(0);
        const Real unit = u * here + abs(exact(u) - here) + abs(exact_x(u / 4) - here) +
                          abs(exact_y(u / 4) - here) + abs(exact_x(-u / 4) - here) +
                          abs(exact_y(-u / 4) - here);
        const Real error = abs(Real(evaluate(m, wo, wi).x) - here);
        worst = std::max(worst, (error / unit).convert_to<double>());
    }
    MESSAGE("largest error ", worst, " times u + what the rounding of the inputs does");
    CHECK(worst <= 24);
}

TEST_CASE("glossy: light goes both ways alike, and comes back on one side only") {
    check_reciprocity(Glossy{.reflectance{0.9f, 0.5f, 0.1f}, .roughness = 0.5f}, 64);
    check_reciprocity(GlossyT<double>{.reflectance{0.9, 0.5, 0.1}, .roughness = 0.1},
                      1e4);
    check_reciprocity(
        MetalOf<double>{.reflectance = ljus::copper<double>, .roughness = 0.8}, 64);
}

// 24 materials, angles and seeds, at 3 in 10 million each.
TEST_CASE("glossy: samples follow the density, weight is f cos over it") {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Draws draws{ljus_test::test_seed(seed)};
        const float roughness = draws.between(0.55f, 1.0f);
        const auto wo =
            at_degrees<float>(draws.between(0.0, 85.0), draws.between(0.0, 360.0));
        const float side = seed % 2 ? 1.0f : -1.0f;
        const ljus::Vec3 out{wo.x, wo.y, side * wo.z};
        check_sampling(Glossy{.reflectance{0.9f, 0.5f, 0.3f}, .roughness = roughness},
                       out, Lobes::all, seed);
        check_sampling(MetalOf<double>{.reflectance = ljus::gold<double>,
                                       .roughness = double(roughness)},
                       Vec3T<double>(out), Lobes::glossy, seed + 100);
    }
}

TEST_CASE("glossy: white returns no more than it gets, and both ways to count agree") {
    double least = 2;
    for (const double roughness : {0.5, 0.7, 0.85, 1.0})
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 88.0}) {
            const GlossyT<double> m{.reflectance = ljus::RgbT<double>{1},
                                    .roughness = roughness};
            const double sampled = albedo_by_samples(m, degrees);
            const double summed =
                albedo_by_quadrature(m, at_degrees<double>(degrees), 500).x;
            CAPTURE(roughness);
            CAPTURE(degrees);
            CHECK(sampled <= 1);
            CHECK(summed <= 1);
            CHECK(summed == doctest::Approx(sampled).epsilon(3e-3));
            least = std::min(least, sampled);
        }
    // What a second facet would have returned is lost.
    MESSAGE("white returns at least ", least);
    CHECK(least < 0.5);
    CHECK(least > 0.3);
}

TEST_CASE_TEMPLATE(
    "glossy: from grazing to pass_through, from 0.01 to 1, no NaN and no "
    "weight above 1",
    T, float, double) {
    for (const T roughness : {T(0.01), T(0.1), T(0.5), T(1)}) {
        check_extremes(
            GlossyT<T>{.reflectance = ljus::RgbT<T>{1}, .roughness = roughness},
            1 + 4 * double(std::numeric_limits<T>::epsilon()));
        check_extremes(
            MetalOf<T>{.reflectance = ljus::silver<T>, .roughness = roughness},
            1 + 4 * double(std::numeric_limits<T>::epsilon()));
        Draws draws{ljus_test::test_seed(1)};
        const GlossyT<T> m{.reflectance = ljus::RgbT<T>{1}, .roughness = roughness};
        for (int i = 0; i < 20000; ++i) {
            auto wo = draws.direction<T>();
            if (i % 3 == 0)
                wo = at_degrees<T>(90 - std::pow(10.0, -6 * draws.unit<T>()));
            const auto s = sample(m, wo, draws.cube<T>(), Transport::flux);
            if (!s) continue;
            REQUIRE(s->weight.x <= 1 + 4 * std::numeric_limits<T>::epsilon());
            REQUIRE(s->weight.x > 0);
            REQUIRE(s->pdf > 0);
            REQUIRE(ljus::is_finite(evaluate(m, wo, s->wi)));
        }
    }
}

TEST_CASE("glossy: the smoother, the more a mirror; at roughness 0 it is one") {
    const auto wo = at_degrees<double>(50);
    const Vec3T<double> u{0.3, 0.4, 0.5};
    const GlossyT<double> mirror{.reflectance{0.9, 0.8, 0.7}, .roughness = 0};
    CHECK(ljus::lobes(mirror) == ljus::Lobes::specular);
    CHECK(ljus::is_black(evaluate(mirror, wo, ljus::reflect(wo))));
    CHECK(pdf(mirror, wo, ljus::reflect(wo)) == 0);
    const auto s = sample(mirror, wo, u, Transport::flux);
    REQUIRE(s);
    CHECK(s->specular);
    CHECK(s->wi == ljus::reflect(wo));
    CHECK(s->weight == ljus::detail::facet_reflectance(mirror.reflectance, wo.z));
    CHECK_FALSE(sample(mirror, wo, u, Transport::flux, Lobes::glossy));

    double farther = 1;
    for (const double roughness : {0.3, 0.1, 0.03, 0.01}) {
        const GlossyT<double> m{mirror.reflectance, roughness};
        CHECK(ljus::lobes(m) != ljus::Lobes::specular);
        const auto near = sample(m, wo, u, Transport::flux);
        REQUIRE(near);
        const double apart = glm::length(near->wi - s->wi);
        CHECK(apart < farther);
        CHECK(apart < 4 * roughness * roughness);
        farther = apart;
    }
    const GlossyT<double> white{ljus::RgbT<double>{1}, 0.01};
    CHECK(albedo_by_samples(white, 50) == doctest::Approx(1).epsilon(1e-4));
}

TEST_CASE("glossy: what no facet can be is refused by name and value") {
    CHECK(refusal(Glossy{.reflectance = ljus::Rgb{1}}).empty());
    CHECK(refusal(RoughMetal{.reflectance = ljus::gold<float>}).empty());
    CHECK(refusal(Glossy{.reflectance{1, 1.5f, 1}}).find("glossy.reflectance") == 0);
    CHECK(refusal(Glossy{.reflectance{1, NAN, 1}}).find("glossy.reflectance") == 0);
    CHECK(refusal(RoughMetal{.reflectance{ljus::Rgb{-1}, ljus::Rgb{1}}})
              .find("glossy.reflectance.n") == 0);
    for (const float bad : {NAN, -0.1f, 0.005f, 1.01f, INFINITY}) {
        const std::string said = refusal(Glossy{.reflectance{}, .roughness = bad});
        CHECK(said.find("glossy.roughness") == 0);
        CHECK(said.find("within [0.01, 1]") != std::string::npos);
    }
    CHECK(refusal(Glossy{.reflectance{}, .roughness = 0}).empty());
}

TEST_CASE("glossy: the same from all around, and each colour by itself") {
    const ljus::RgbT<double> color{0.9, 0.5, 0.1};
    for (const double roughness : {0.1, 0.4, 1.0}) {
        const GlossyT<double> gloss{.reflectance = color, .roughness = roughness};
        check_symmetry(gloss);
        Draws draws{ljus_test::test_seed(5)};
        for (int i = 0; i < 300; ++i) {
            auto wo = draws.direction<double>(), wi = draws.direction<double>();
            wi.z = std::copysign(wi.z, wo.z);
            const auto u = draws.cube<double>();
            const auto all = evaluate(gloss, wo, wi);
            const auto next = sample(gloss, wo, u, Transport::radiance);
            for (int c = 0; c < 3; ++c) {
                const GlossyT<double> grey{.reflectance = ljus::RgbT<double>{color[c]},
                                           .roughness = roughness};
                REQUIRE(evaluate(grey, wo, wi).x == all[c]);
                const auto one = sample(grey, wo, u, Transport::radiance);
                REQUIRE(bool(one) == bool(next));
                if (one) REQUIRE(one->weight.y == next->weight[c]);
            }
        }
    }
    // Along the surface f may be beyond all numbers, and then is none.
    for (const float z : {1e-20f, 1e-30f, 1e-38f, 1e-44f})
        for (const float roughness : {0.0f, 0.01f, 1.0f}) {
            const Glossy gloss{.roughness = roughness};
            CHECK(ljus::is_finite(
                evaluate(gloss, Vec3T<float>{1, 0, z}, Vec3T<float>{-1, 0, z})));
        }
}

TEST_CASE("glossy: a value beyond the largest float is none") {
    const ljus::Vec3 up{0, 0, 1};
    const GlossyT<float> sharp{.reflectance = ljus::Rgb{1}, .roughness = 1e-11f};
    CHECK(evaluate(sharp, up, up) == ljus::Rgb{0});
    const GlossyT<float> blunt{.reflectance = ljus::Rgb{1}, .roughness = 0.01f};
    CHECK(evaluate(blunt, up, up).x > 1e6f);
}

TEST_CASE_TEMPLATE("glossy: a mirror from below too, and of a cosine beyond 1", T,
                   float, double) {
    const GlossyT<T> mirror{.reflectance{T(0.9), T(0.5), T(0.1)}, .roughness = 0};
    const Vec3T<T> u{T(0.3), T(0.4), T(0.5)};
    for (const double degrees : {0.0, 30.0, 80.0}) {
        const auto wo = at_degrees<T>(degrees, 20);
        const Vec3T<T> below{wo.x, wo.y, -wo.z};
        const auto a = sample(mirror, wo, u, Transport::radiance);
        const auto b = sample(mirror, below, u, Transport::flux);
        REQUIRE((a && b));
        CHECK(b->wi == ljus::reflect(below));
        CHECK(b->weight == a->weight);
        for (int c = 0; c < 3; ++c)
            CHECK(double(a->weight[c]) ==
                  doctest::Approx(double(ljus::schlick(mirror.reflectance[c], wo.z))));
    }
    for (const T z : {T(1.5), T(-1.5)})
        CHECK(sample(mirror, Vec3T<T>{0, 0, z}, u, Transport::flux)->weight ==
              mirror.reflectance);
}

TEST_CASE("glossy: black facets reflect nothing straight on, and much at their rims") {
    const GlossyT<double> black{.reflectance{0, 0, 0}, .roughness = 0.5};
    const Vec3T<double> up{0, 0, 1};
    // The facet in the middle of the cap lies flat.
    CHECK_FALSE(sample(black, up, {0.5, 0, 0.5}, Transport::flux));
    const auto beside = sample(black, up, {0.5, 0.5, 0.5}, Transport::flux);
    REQUIRE(beside);
    CHECK(beside->weight.x > 0);
    CHECK(sample(black, at_degrees<double>(89), {0.5, 0, 0.5}, Transport::flux)
              ->weight.x > 0.1);
}

TEST_CASE("glossy: a metal's facets reflect what the metal does at their angle") {
    Draws draws{ljus_test::test_seed(3)};
    const GlossyT<double> white{.reflectance = ljus::RgbT<double>{1}, .roughness = 0.6};
    const MetalOf<double> metal{.reflectance = ljus::copper<double>, .roughness = 0.6};
    for (int i = 0; i < 500; ++i) {
        const auto wo = draws.above<double>(), wi = draws.above<double>();
        const double half = std::sqrt((1 + glm::dot(wo, wi)) / 2); // of the angle
        const auto f = evaluate(metal, wo, wi);
        const double of_white = evaluate(white, wo, wi).x;
        for (int c = 0; c < 3; ++c)
            REQUIRE(f[c] == doctest::Approx(of_white * ljus::fresnel_conductor(
                                                           half, metal.reflectance.n[c],
                                                           metal.reflectance.k[c]))
                                .epsilon(1e-9));
    }
    CHECK(Glossy{}.roughness == 0.3f);
    CHECK(ljus::lobes(Glossy{}) == Lobes::glossy);
}

TEST_CASE("glossy: nearly a mirror below a roughness of 0.42") {
    const auto nearly = [](float roughness) {
        const bool colored = nearly_specular(
            Glossy{.reflectance = ljus::Rgb{0.9f}, .roughness = roughness});
        CHECK(nearly_specular(RoughMetal{.reflectance = ljus::copper<float>,
                                         .roughness = roughness}) == colored);
        return colored;
    };
    for (const float roughness : {0.01f, 0.1f, 0.41f}) CHECK(nearly(roughness));
    for (const float roughness : {0.43f, 0.6f, 1.0f}) CHECK_FALSE(nearly(roughness));
    CHECK_FALSE(nearly(0)); // which is a mirror
    CHECK_FALSE(nearly_specular(Coat{{.roughness = 0.1f}}));
}
