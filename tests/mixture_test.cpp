/// \file mixture_test.cpp
/// \brief The sliders never return more than arrives, and their ends are the materials.

#include "ljus/materials/mixture.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "support/bsdf_checks.hpp"

using ljus::Lobes, ljus::Mixture, ljus::MixtureT, ljus::Rgb, ljus::Transport;
using ljus::RgbT, ljus::Vec3T;
using namespace ljus_test;

namespace {

using D = MixtureT<double>;
const RgbT<double> white{1.0};

/// All light that a material sends to wo out of a uniform surrounding, as flux: matt
/// part by quadrature, deltas by their weights.
double total_albedo(const D& m, const Vec3T<double>& wo) {
    return albedo_by_quadrature(m, wo, 300).x +
           specular_albedo(m, wo, Transport::flux, 2000).x;
}

/// A few mixtures with everything in them.
const D kinds[] = {
    {},
    {.color = {0.9, 0.5, 0.1}, .reflectivity = 0.3},
    {.color = {0.9, 0.5, 0.1}, .index = 1.5, .specularity = 1},
    {.color = {0.9, 0.5, 0.1}, .transparency = 0.7, .index = 1.5, .specularity = 1},
    {.color = {1, 1, 0},
     .reflectivity = 0.2,
     .transparency = 0.5,
     .index = 1.8,
     .specularity = 0.6,
     .sigma = 0.4},
    {.color = {0, 0, 0}, .transparency = 0.5, .index = 0.7, .specularity = 0.5},
    {.color = {1, 1, 1}, .reflectivity = 0.6, .transparency = 1, .index = 1.05},
};

} // namespace

TEST_CASE("mixture: what is in the furnace is never brighter than the furnace") {
    for (const D& m : kinds)
        for (const double degrees : {0.0, 40.0, 75.0, 88.0, 100.0, 135.0, 179.0}) {
            CAPTURE(degrees);
            D smooth = m;
            smooth.sigma = 0; // Oren and Nayar's own 1.5 percent apart
            CHECK(total_albedo(smooth, at_degrees<double>(degrees)) <= 1 + 1e-3);
            CHECK(total_albedo(m, at_degrees<double>(degrees)) <= 1.016);
        }
}

TEST_CASE("mixture: where nothing can be lost nothing is") {
    const D lossless[] = {
        {.color = white},
        {.color = white, .reflectivity = 0.4},
        {.color = {0, 0, 0}, .reflectivity = 1},
        {.color = {0, 0, 0}, .transparency = 1},
        {.color = {0, 0, 0}, .transparency = 1, .specularity = 1},
        {.color = {0, 0, 0},
         .reflectivity = 0.6,
         .transparency = 1,
         .specularity = 0.3},
        {.color = white,
         .reflectivity = 0.1,
         .transparency = 0.5,
         .index = 1,
         .specularity = 1},
    };
    for (const D& m : lossless)
        for (const double degrees : {0.0, 60.0, 89.0, 120.0, 160.0}) {
            CAPTURE(degrees);
            CHECK(total_albedo(m, at_degrees<double>(degrees)) ==
                  doctest::Approx(1).epsilon(1e-3)); // the grid of u.z has 2000 steps
        }
}

TEST_CASE("mixture: the report's thin glass returns 1, and not 1.6 times the light") {
    const D thin{.color = white, .reflectivity = 0.6, .transparency = 1, .index = 1.5};
    CHECK(total_albedo(thin, at_degrees<double>(10)) ==
          doctest::Approx(1).epsilon(1e-3));
}

TEST_CASE("mixture: coated matt loses on the way in and on the way out") {
    // (1 - F) of the light enters, the mean of 1 - F leaves:
    // by a quadrature of its own.
    const D coated{.color = white, .index = 1.5, .specularity = 1};
    double leaves = 0;
    const int n = 20000;
    for (int i = 0; i < n; ++i) {
        const double c = (i + 0.5) / n;
        leaves += 2 * c * (1 - ljus::fresnel(c, 1.0, 1.5)) / n;
    }
    for (const double degrees : {0.0, 60.0, 85.0, 120.0}) {
        const auto wo = at_degrees<double>(degrees);
        const double f = ljus::fresnel(std::abs(wo.z), 1.0, 1.5);
        CHECK(albedo_by_quadrature(coated, wo).x ==
              doctest::Approx((1 - f) * leaves).epsilon(1e-3));
        CHECK(specular_albedo(coated, wo, Transport::flux, 20000).x ==
              doctest::Approx(f).epsilon(1e-3));
    }
}

TEST_CASE_TEMPLATE(
    "mixture: at their ends the sliders are Lambert, Oren-Nayar, mirror and "
    "glass",
    T, float, double) {
    const RgbT<T> color{T(0.2), T(0.5), T(0.8)};
    const T u3 = 3 * std::numeric_limits<T>::epsilon();
    Draws draws;
    int at_threshold = 0;
    for (int i = 0; i < 2000; ++i) {
        const auto wo = draws.direction<T>(), wi = draws.direction<T>();
        const auto near = [u3](const RgbT<T>& a, const RgbT<T>& b) {
            return glm::length(a - b) <= u3 * glm::length(b);
        };
        REQUIRE(near(evaluate(MixtureT<T>{.color = color}, wo, wi),
                     evaluate(ljus::LambertianT<T>{.albedo = color}, wo, wi)));
        REQUIRE(near(
            evaluate(MixtureT<T>{.color = color, .sigma = T(0.4)}, wo, wi),
            evaluate(ljus::OrenNayarT<T>{.albedo = color, .sigma = T(0.4)}, wo, wi)));
        const auto u = draws.cube<T>();
        for (const auto transport : {Transport::radiance, Transport::flux}) {
            const auto mirror =
                sample(MixtureT<T>{.reflectivity = 1}, wo, u, transport);
            REQUIRE(mirror);
            REQUIRE(mirror->specular);
            REQUIRE(mirror->wi == ljus::reflect(wo));
            REQUIRE(mirror->weight == RgbT<T>{1, 1, 1});
            // Glass chooses by the other end of u.z; the directions and weights agree.
            const MixtureT<T> clear{
                .color = color, .transparency = 1, .index = T(1.5), .specularity = 1};
            const auto a = sample(clear, wo, u, transport);
            const auto b = sample(
                ljus::GlassT<T>{.index = T(1.5)}, wo,
                Vec3T<T>{u.x, u.y, std::min(T(1) - u.z, std::nextafter(T(1), T(0)))},
                transport);
            REQUIRE(a);
            REQUIRE(b);
            if (!ljus::same_side(a->wi, b->wi)) { // u.z at the very threshold
                ++at_threshold;
                continue;
            }
            REQUIRE(a->wi == b->wi);
            REQUIRE(near(a->weight, b->weight));
        }
    }
    CHECK(at_threshold <= 1);
    CHECK(lobes(MixtureT<T>{.reflectivity = 1}) == Lobes::specular);
}

TEST_CASE(
    "mixture: radiance through its boundary is scaled by the squared index ratio") {
    const D m{.color = {0, 0, 0}, .transparency = 1, .index = 1.6, .specularity = 1};
    const auto in = at_degrees<double>(30), out = at_degrees<double>(160);
    const Vec3T<double> first{0.5, 0.5, 0};
    REQUIRE(sample(m, in, first, Transport::radiance)->wi.z < 0);
    CHECK(sample(m, in, first, Transport::radiance)->weight.x ==
          doctest::Approx(1 / (1.6 * 1.6)));
    CHECK(sample(m, out, first, Transport::radiance)->weight.x ==
          doctest::Approx(1.6 * 1.6));
    CHECK(sample(m, in, first, Transport::flux)->weight.x == doctest::Approx(1));
}

TEST_CASE("mixture: inside a transparent body the angle counts from the dense side") {
    const D m{.color = {0, 0, 0}, .transparency = 1, .index = 1.5, .specularity = 1};
    CHECK(ljus::detail::boundary_reflectance(m, at_degrees<double>(180 - 60)) ==
          1); // total reflection
    CHECK(ljus::detail::boundary_reflectance(m, at_degrees<double>(60)) ==
          doctest::Approx(ljus::fresnel(0.5, 1.0, 1.5)).epsilon(1e-12));
    // Without specularity there is still no way out beyond the critical angle.
    const D dull{.color = {0, 0, 0}, .transparency = 1, .index = 1.5};
    CHECK(ljus::detail::boundary_reflectance(dull, at_degrees<double>(180 - 60)) == 1);
    CHECK(ljus::detail::boundary_reflectance(dull, at_degrees<double>(180 - 30)) == 0);
    // An opaque sheet has no inside.
    const D coated{.index = 1.5, .specularity = 1};
    CHECK(ljus::detail::boundary_reflectance(coated, at_degrees<double>(120)) ==
          doctest::Approx(
              ljus::detail::boundary_reflectance(coated, at_degrees<double>(60))));
}

TEST_CASE(
    "mixture: samples, density and weight belong together, whatever is asked for") {
    std::uint64_t seed = 1;
    for (const D& m : kinds) {
        check_reciprocity(m, 8);
        for (const double degrees : {20.0, 80.0, 130.0})
            for (const auto which : {Lobes::all, Lobes::diffuse, Lobes::specular}) {
                CAPTURE(seed);
                check_sampling(m, at_degrees<double>(degrees), which, seed++);
            }
        check_extremes(m, 1 + 0.45 / std::sqrt(std::numeric_limits<double>::epsilon()));
    }
    check_sampling(MixtureT<float>{.transparency = 0.5f, .specularity = 1},
                   at_degrees<float>(30));
}

TEST_CASE("mixture: asking for deltas only gives all that the deltas carry") {
    for (const D& m : kinds)
        for (const double degrees : {20.0, 85.0, 170.0}) {
            const auto wo = at_degrees<double>(degrees);
            const double all = specular_albedo(m, wo, Transport::radiance, 50000).x;
            double only = 0;
            for (int i = 0; i < 50000; ++i) {
                const auto s = sample(m, wo, Vec3T<double>{0.5, 0.5, (i + 0.5) / 50000},
                                      Transport::radiance, Lobes::specular);
                if (s) only += s->weight.x / 50000;
            }
            CHECK(only == doctest::Approx(all).epsilon(3e-4));
        }
}

TEST_CASE("mixture: without roughness no weight is above 1, so that no path grows") {
    Draws draws;
    for (D m : kinds) {
        m.sigma = 0;
        for (int i = 0; i < 5000; ++i) {
            const auto s = sample(m, draws.direction<double>(), draws.cube<double>(),
                                  Transport::flux);
            if (s) REQUIRE(ljus::max_component(s->weight) <= 1 + 1e-12);
        }
    }
}

TEST_CASE("mixture: it reports the parts that it has") {
    const Rgb black{0, 0, 0}, grey{0.5f, 0.5f, 0.5f};
    CHECK(lobes(Mixture{.color = grey}) == Lobes::diffuse);
    CHECK(lobes(Mixture{.color = black}) == Lobes::diffuse); // black, but something
    CHECK(lobes(Mixture{.color = grey, .reflectivity = 0.1f}) ==
          (Lobes::diffuse | Lobes::specular));
    CHECK(lobes(Mixture{.color = grey, .reflectivity = 1}) == Lobes::specular);
    CHECK(lobes(Mixture{.color = black, .reflectivity = 0.1f}) == Lobes::specular);
    CHECK(lobes(Mixture{.color = grey, .transparency = 1}) == Lobes::specular);
    CHECK(lobes(Mixture{.color = grey, .transparency = 0.5f}) ==
          (Lobes::diffuse | Lobes::specular));
    for (const float index : {0.8f, 1.5f}) // thinner than air reflects as well
        CHECK(lobes(Mixture{.color = grey, .index = index, .specularity = 1}) ==
              (Lobes::diffuse | Lobes::specular));
    CHECK(lobes(Mixture{.color = grey, .index = 1, .specularity = 1}) ==
          Lobes::diffuse);
    CHECK_FALSE(sample(Mixture{.color = black}, ljus::Vec3{0, 0, 1}, ljus::Vec3{0.5f},
                       Transport::flux)); // absorbed
}

TEST_CASE("mixture: emission and absorption are what was set") {
    const Mixture m{.color = {1, 0.5f, 0}, .emissivity = 10, .absorption = {1, 2, 3}};
    CHECK(ljus::emission(m) == Rgb{10, 5, 0});
    CHECK(ljus::absorption(m) == Rgb{1, 2, 3});
    CHECK(ljus::emission(Mixture{}) == Rgb{0, 0, 0});
}

TEST_CASE("mixture: every slider outside its range is refused by name and value") {
    CHECK(refusal(Mixture{}).empty());
    CHECK(refusal(Mixture{.color = {2, 0, 0}}).find("mixture.color is (2, 0, 0)") == 0);
    CHECK(refusal(Mixture{.reflectivity = 1.5f}) ==
          "mixture.reflectivity is 1.5; it must be within [0, 1].");
    CHECK(refusal(Mixture{.transparency = -1}).find("mixture.transparency") == 0);
    CHECK(refusal(Mixture{.index = 0}).find("mixture.index") == 0);
    CHECK(refusal(Mixture{.specularity = NAN}).find("mixture.specularity is NaN") == 0);
    CHECK(refusal(Mixture{.emissivity = -3}) ==
          "mixture.emissivity is -3; it must be finite and at least 0.");
    CHECK(refusal(Mixture{.emissivity = INFINITY}).find("mixture.emissivity") == 0);
    CHECK(refusal(Mixture{.sigma = -1}).find("mixture.sigma") == 0);
    CHECK(refusal(Mixture{.sigma = 1001}).find("mixture.sigma is 1001") == 0);
    CHECK(refusal(Mixture{.index = 1001}).find("mixture.index is 1001") == 0);
    CHECK(refusal(Mixture{.index = 0.0009f}).find("mixture.index is 0.0009") == 0);
    CHECK(refusal(Mixture{.emissivity = NAN}).find("mixture.emissivity is NaN") == 0);
    CHECK(refusal(Mixture{.absorption = {0, INFINITY, 0}}).find("mixture.abs") == 0);
    CHECK(refusal(Mixture{.absorption = {0, 0, -1}}).find("mixture.absorption") == 0);
}

TEST_CASE_TEMPLATE("mixture: what is sampled and no delta has a density above 0", T,
                   float, double) {
    // Hardest beside a gloss that takes nearly all, with a colour that is nearly 0.
    Draws draws{47};
    const T tiny = std::numeric_limits<T>::min(), one = std::nextafter(T(1), T(0));
    int matt = 0, without = 0;
    for (int i = 0; i < 200000; ++i) {
        MixtureT<T> m{.color = draws.cube<T>(),
                      .index = draws.between(T(1), T(3)),
                      .specularity = draws.unit<T>()};
        if (i % 2) m.color *= T(8) * tiny;
        if (i % 3) m.transparency = one;
        if (i % 5) m.reflectivity = i % 10 < 5 ? one : draws.unit<T>();
        auto u = draws.cube<T>();
        u.z = i % 7 ? T(0) : u.z;
        const auto wo = draws.above<T>();
        const auto s = sample(m, wo, u, Transport::radiance);
        if (!s || s->specular) continue;
        ++matt;
        without += !(s->pdf > 0) || !(pdf(m, wo, s->wi) > 0);
    }
    CHECK(matt > 10000);
    CHECK(without == 0);
}

TEST_CASE("mixture: without more said it is grey and matt") {
    const Mixture m;
    CHECK(m.color == Rgb{0.5f});
    CHECK(m.index == 1.5f);
    for (const float slider :
         {m.reflectivity, m.transparency, m.specularity, m.emissivity, m.sigma})
        CHECK(slider == 0);
    CHECK(m.absorption == Rgb{0});
    CHECK(lobes(m) == Lobes::diffuse);
}
