/// \file compensated_glossy_test.cpp
/// \brief Gloss that keeps its light: a furnace in which white cannot be seen.

#include "ljus/materials/compensated_glossy.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "support/bsdf_checks.hpp"
#include "support/within.hpp"

using ljus::CompensatedGlossyT, ljus::GlossyT, ljus::Lobes, ljus::Transport,
    ljus::Vec3T;
using namespace ljus_test;

namespace {

template <typename T>
CompensatedGlossyT<T> white(double roughness) {
    return compensated_glossy(
        GlossyT<T>{.reflectance = ljus::RgbT<T>{1}, .roughness = T(roughness)});
}

template <typename T>
auto metal(const ljus::ConductorIndexT<T>& index, double roughness) {
    return compensated_glossy(GlossyT<T, ljus::ConductorIndexT<T>>{
        .reflectance = index, .roughness = T(roughness)});
}

} // namespace

// At roughness 1 f is 1/(2 pi (mu_i + mu_o)): its integral is no riddle.
TEST_CASE("facet loss: at roughness 1 it is mu log(1 + 1/mu), the law of Lommel and "
          "Seeliger") {
    const auto loss = ljus::detail::bake_energy_loss(1.0);
    double least = 1, most = -1;
    for (int i = 1; i <= 1000; ++i) {
        const double mu = std::pow(i / 1000.0, 3);
        const double apart = ljus::detail::lost_at(loss, mu) - mu * std::log1p(1 / mu);
        least = std::min(least, apart);
        most = std::max(most, apart);
    }
    MESSAGE("the table is off by ", least, " to ", most);
    CHECK(least > -4e-4);
    CHECK(most < 1e-5);
    CHECK(loss.mean == doctest::Approx(4 * std::log(2.0) / 3 - 1.0 / 3).epsilon(1e-3));
}

TEST_CASE("full glossy: white returns all light, at any roughness and angle") {
    double least = 2, most = 0;
    for (const double roughness : {0.4, 0.6, 0.8, 1.0}) {
        const auto m = white<double>(roughness);
        for (const double degrees : {0.0, 40.0, 70.0, 80.0}) {
            const double share =
                albedo_by_quadrature(m, at_degrees<double>(degrees), 900).x;
            CAPTURE(roughness);
            CAPTURE(degrees);
            CHECK(share > 0.9994);
            CHECK(share <= 1 + 1e-5); // the quadrature's own
            least = std::min(least, share);
            most = std::max(most, share);
        }
    }
    MESSAGE("white returns ", least, " to ", most);
}

TEST_CASE("full glossy: smooth white returns all light, by the weights of samples") {
    for (const double roughness : {0.01, 0.1, 0.25}) {
        const auto m = white<double>(roughness);
        for (const double degrees : {0.0, 60.0, 85.0, 89.9}) {
            Draws draws;
            double sum = 0;
            constexpr int count = 20000; // deviations of the weight are some 0.1
            for (int i = 0; i < count; ++i) {
                const auto s = sample(m, at_degrees<double>(degrees),
                                      draws.cube<double>(), Transport::flux);
                if (s) sum += s->weight.x;
            }
            CAPTURE(roughness);
            CAPTURE(degrees);
            CHECK(sum / count == doctest::Approx(1).epsilon(0.005));
        }
    }
}

TEST_CASE("full glossy: it is the gloss and what that loses, no more than there is") {
    for (const double roughness : {0.5, 0.8, 1.0}) {
        const auto m = metal(ljus::copper<double>, roughness);
        for (const double degrees : {0.0, 45.0, 75.0}) {
            const auto wo = at_degrees<double>(degrees);
            const auto full = albedo_by_quadrature(m, wo, 300);
            const auto first = albedo_by_quadrature(m.first, wo, 300);
            const double lost = ljus::detail::lost_at(m.loss, wo.z);
            for (int c = 0; c < 3; ++c) {
                CHECK(full[c] > first[c]);
                CHECK(full[c] < first[c] + lost + 1e-5);
            }
            // Each further facet takes its share of blue: copper grows redder.
            CHECK(full.x / full.z > first.x / first.z);
        }
    }
    CHECK(ljus::detail::mean_reflectance<double>(ljus::RgbT<double>{1}).x ==
          doctest::Approx(1).epsilon(1e-12));
    const auto grey = ljus::detail::mean_reflectance<double>(ljus::RgbT<double>{0.2});
    CHECK(grey.x == doctest::Approx(0.2 + 0.8 / 21).epsilon(1e-4)); // Schlick's mean
}

TEST_CASE("full glossy: light goes both ways alike") {
    check_reciprocity(metal(ljus::gold<double>, 0.8), 64);
    check_reciprocity(compensated_glossy(ljus::Glossy{.reflectance{0.9f, 0.5f, 0.1f},
                                                      .roughness = 0.5f}),
                      64);
}

// 12 materials, angles and seeds, at 3 in 10 million each.
TEST_CASE("full glossy: samples follow the density, weight is f cos over it") {
    for (std::uint64_t seed = 1; seed <= 6; ++seed) {
        Draws draws{seed};
        const float roughness = draws.between(0.55f, 1.0f);
        const auto wo =
            at_degrees<float>(draws.between(0.0, 80.0), draws.between(0.0, 360.0));
        const ljus::Vec3 out{wo.x, wo.y, seed % 2 ? wo.z : -wo.z};
        check_sampling(compensated_glossy(ljus::Glossy{.reflectance{0.9f, 0.5f, 0.3f},
                                                       .roughness = roughness}),
                       out, Lobes::all, seed);
        check_sampling(metal(ljus::gold<double>, double(roughness)), Vec3T<double>(out),
                       Lobes::glossy, seed + 100);
    }
}

TEST_CASE_TEMPLATE("full glossy: no NaN at the corners, and weights below 3.3", T,
                   float, double) {
    for (const double roughness : {0.01, 0.3, 1.0})
        check_extremes(white<T>(roughness), 3.3);
    check_extremes(metal(ljus::silver<T>, 0.5), 3.3);
    check_extremes(compensated_glossy(GlossyT<T>{.reflectance = ljus::RgbT<T>{0},
                                                 .roughness = T(0.5)}),
                   3.3);
}

TEST_CASE("full glossy: with roughness 0 it is the mirror that gloss is") {
    const auto m = compensated_glossy(
        GlossyT<double>{.reflectance{0.9, 0.8, 0.7}, .roughness = 0});
    CHECK(ljus::lobes(m) == ljus::Lobes::specular);
    const auto wo = at_degrees<double>(50);
    const Vec3T<double> u{0.3, 0.4, 0.5};
    const auto s = sample(m, wo, u, Transport::flux);
    const auto of_gloss = sample(m.first, wo, u, Transport::flux);
    REQUIRE(s);
    CHECK(s->specular);
    CHECK(s->wi == of_gloss->wi);
    CHECK(s->weight == of_gloss->weight);
    CHECK(ljus::is_black(evaluate(m, wo, ljus::reflect(wo))));
    CHECK(pdf(m, wo, ljus::reflect(wo)) == 0);
    CHECK_FALSE(sample(m, wo, u, Transport::flux, Lobes::glossy));
}

TEST_CASE("full glossy: what is not made by compensated_glossy() is refused by name") {
    auto m = white<float>(0.5);
    CHECK(refusal(m).empty());
    m.first.roughness = 0.6f;
    CHECK(refusal(m).find("compensated_glossy.loss.alpha is 0.25") == 0);
    CHECK(refusal(m).find("compensated_glossy()") != std::string::npos);
    m = white<float>(0.5);
    m.mean.y = 1.5f;
    CHECK(refusal(m).find("compensated_glossy.mean") == 0);
    for (const float bad : {NAN, -0.1f, 0.005f, 1.01f})
        CHECK_THROWS_AS(
            (void)compensated_glossy(ljus::Glossy{.reflectance{}, .roughness = bad}),
            std::invalid_argument);
}

TEST_CASE("compensated glossy: what comes back is a geometric series, in colours") {
    // Reflected twice, after which a fraction leaves; or three times, ...
    for (const double loss : {0.0, 0.1, 0.5, 0.9}) {
        const ljus::RgbT<double> facet{1, 0.6, 0.2};
        const auto found = ljus::detail::multiple_scattering(facet, loss);
        for (int c = 0; c < 3; ++c) {
            double sum = 0, left = facet[c] * facet[c];
            for (int k = 0; k < 400; ++k, left *= facet[c] * loss)
                sum += left * (1 - loss);
            CHECK(found[c] == doctest::Approx(sum).epsilon(1e-12));
        }
    }
    auto bad = white<double>(0.5);
    CHECK(refusal(bad).empty());
    bad.first.reflectance.y = 1.5;
    CHECK(refusal(bad).find("glossy.reflectance") == 0);
    bad = white<double>(0.5);
    bad.mean.z = -1;
    CHECK(refusal(bad).find("compensated_glossy.mean") == 0);
    bad = white<double>(0.5);
    bad.first.roughness = 0.6;
    CHECK(refusal(bad).find("compensated_glossy.loss.alpha") == 0);
}

TEST_CASE("facet loss: a cosine is drawn by its share of what is lost, cell by cell") {
    // Within a cell evenly in the cosine's square, as pdf_lost() has it: the share that
    // is lost below what u gives is u, in closed form.
    for (const float alpha : {0.05f, 0.3f, 1.0f}) {
        const auto loss = ljus::detail::bake_energy_loss(alpha);
        const auto cosine = [&](std::size_t i) {
            return double(ljus::detail::facet_cosine(alpha, float(i)));
        };
        double worst = 0;
        for (int k = 0; k < 2000; ++k) {
            const double u = (k + 0.5) / 2000;
            const double z = double(ljus::detail::sample_lost(loss, float(u)));
            std::size_t i = 0;
            while (i + 1 < loss.cells && cosine(i + 1) <= z) ++i;
            const double low = cosine(i), high = cosine(i + 1);
            const double part = (z * z - low * low) / (high * high - low * low);
            const double below = double(loss.below[i]) +
                                 part * double(loss.below[i + 1] - loss.below[i]);
            worst = std::max(worst, std::abs(below - u));
        }
        MESSAGE("at ", alpha, " off by ", worst);
        CHECK(worst < 5e-6);
    }
}

TEST_CASE(
    "facet loss: a mirror loses nothing; a table holds shares, and is found again") {
    const ljus::detail::EnergyLossT<float> none;
    for (const float c : {0.0f, 1e-30f, 0.5f, 1.0f})
        CHECK(ljus::detail::lost_at(none, c) == 0);
    for (const float alpha : {1e-4f, 0.01f, 0.3f, 1.0f}) {
        const auto loss = ljus::detail::bake_energy_loss(alpha);
        const auto cells = float(loss.cells);
        CHECK(loss.alpha == alpha);
        for (const float lost : loss.at) REQUIRE((lost >= 0 && lost < 1));
        CHECK(std::is_sorted(loss.below.begin(), loss.below.end()));
        CHECK(loss.below.front() == 0);
        CHECK(loss.below.back() == 1);
        CHECK(ljus::detail::facet_position(alpha, 0.0f) == 0);
        CHECK(ljus::detail::facet_position(alpha, 1.0f) == cells);
        CHECK(ljus::detail::facet_position(alpha, 1.25f) == cells); // by rounding, say
        CHECK(ljus::detail::lost_at(loss, 1.25f) ==
              ljus_test::within(double(loss.at.back()), 1e-5));
        for (int i = 1; i <= loss.cells; ++i)
            REQUIRE(ljus::detail::facet_position(
                        double(alpha),
                        ljus::detail::facet_cosine(double(alpha), double(i))) ==
                    doctest::Approx(i).epsilon(1e-9));
        for (const float u : {0.0f, 0.5f, std::nextafter(1.0f, 0.0f)}) {
            const float z = ljus::detail::sample_lost(loss, u);
            REQUIRE((z >= 0 && z <= 1));
        }
    }
}

TEST_CASE(
    "facet loss: what is given back is what the table says is lost, cell by cell") {
    // The integral of 2 mu times the table by a rule of its own, even in mu^2.
    for (const double alpha : {0.3, 1.0}) {
        const auto loss = ljus::detail::bake_energy_loss(alpha);
        constexpr int n = 400000;
        double sum = 0, farthest = 0;
        int next = 1;
        for (int i = 0; i < n; ++i) {
            const double mu = std::sqrt((i + 0.5) / n);
            while (next < loss.cells &&
                   ljus::detail::facet_cosine(alpha, double(next)) <= mu) {
                farthest = std::max(farthest, std::abs(sum / loss.mean -
                                                       loss.below[std::size_t(next)]));
                ++next;
            }
            sum += ljus::detail::lost_at(loss, mu) / n;
            // Where a direction is drawn, there it is lost.
            const double right = ljus::detail::lost_at(loss, mu) * mu / loss.mean;
            if (i % 100 == 0)
                REQUIRE(ljus::detail::pdf_lost(loss, mu) * std::numbers::pi ==
                        doctest::Approx(right).epsilon(0.02));
        }
        MESSAGE("the mean is off by ", loss.mean / sum - 1, ", a cell by ", farthest);
        CHECK(std::abs(loss.mean / sum - 1) < 4e-6);
        CHECK(farthest < 1e-5);
    }
}

TEST_CASE("full glossy: the first reflection is taken as often as it carries light") {
    using ljus::detail::first_probability;
    for (const double roughness : {0.4, 0.7, 1.0})
        for (const double degrees : {0.0, 50.0, 80.0}) {
            const auto wo = at_degrees<double>(degrees);
            // All that white loses comes back.
            const auto all = white<double>(roughness);
            const double lost = ljus::detail::lost_at(all.loss, wo.z);
            CHECK(first_probability(all, wo) ==
                  doctest::Approx(1 - lost).epsilon(1e-6));
            CHECK(first_probability(all, -wo) == first_probability(all, wo));
            // Of copper by quadrature: red, the brightest. Facets are met at other
            // angles than their mean's, so that this is not exact.
            const auto m = metal(ljus::copper<double>, roughness);
            const double full = albedo_by_quadrature(m, wo, 200).x;
            const double first = albedo_by_quadrature(m.first, wo, 200).x;
            CHECK(std::abs(first_probability(m, wo) - first / full) < 0.02);
        }
    const auto mirror = compensated_glossy(
        GlossyT<double>{.reflectance = ljus::RgbT<double>{0.5}, .roughness = 0});
    CHECK(first_probability(mirror, at_degrees<double>(30)) == 1);
    // A metal's mean, and a colour's, by another rule.
    const auto mean = ljus::detail::mean_reflectance<double>(ljus::gold<double>);
    ljus::RgbT<double> sum{0};
    for (int i = 0; i < 20000; ++i) {
        const double mu = (i + 0.5) / 20000;
        sum += 2 * mu / 20000 * ljus::fresnel_conductor(mu, ljus::gold<double>);
    }
    for (int c = 0; c < 3; ++c) CHECK(mean[c] == ljus_test::within(sum[c], 3e-4));
}
