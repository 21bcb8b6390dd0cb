/// \file glass_test.cpp
/// \brief Nothing is lost at a boundary, and the known optics of
/// slabs and balls come out.

#include "ljus/materials/glass.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

#include "support/bsdf_checks.hpp"

using ljus::FresnelModel, ljus::Glass, ljus::GlassT, ljus::Lobes, ljus::Transport;
using ljus::Vec3T;
using namespace ljus_test;

namespace {

/// The probability of reflection, by bisection over u.z: what sample() does, not says.
double reflected_share(const GlassT<double>& m, const Vec3T<double>& wo) {
    const auto reflects = [&](double u) {
        const auto s = sample(m, wo, Vec3T<double>{0.5, 0.5, u}, Transport::flux);
        return s->wi.z * wo.z > 0;
    };
    const double last = std::nextafter(1.0, 0.0);
    if (!reflects(0)) return 0;
    if (reflects(last)) return 1;
    double low = 0, high = last;
    while (high - low > 1e-14) {
        const double middle = (low + high) / 2;
        (reflects(middle) ? low : high) = middle;
    }
    return low;
}

} // namespace

TEST_CASE_TEMPLATE("glass: both branches have the weight 1, radiance the square of the "
                   "index ratio on top, for index ratios 1e-3 to 1e3",
                   T, float, double) {
    static_assert(ljus::Material<GlassT<T>>);
    Draws draws;
    int reflected = 0, refracted = 0;
    for (int i = 0; i < 20000; ++i) {
        const GlassT<T> m{.index =
                              static_cast<T>(std::pow(10, draws.between(-3.0, 3.0)))};
        const auto wo = draws.direction<T>();
        const auto u = draws.cube<T>();
        const auto flux = sample(m, wo, u, Transport::flux);
        const auto radiance = sample(m, wo, u, Transport::radiance);
        REQUIRE(flux);
        REQUIRE(flux->specular);
        REQUIRE(flux->pdf == 0);
        REQUIRE(flux->wi == radiance->wi);
        REQUIRE(flux->weight == Vec3T<T>{1, 1, 1});
        if (ljus::same_side(wo, flux->wi)) {
            ++reflected;
            REQUIRE(radiance->weight == Vec3T<T>{1, 1, 1});
            REQUIRE(flux->wi == Vec3T<T>{-wo.x, -wo.y, wo.z});
        } else {
            ++refracted;
            // From where the light comes: n_i over n_t, squared.
            const double eta = wo.z > 0 ? 1 / double(m.index) : double(m.index);
            REQUIRE(double(radiance->weight.x) ==
                    doctest::Approx(eta * eta).epsilon(1e-6));
            // Snell: the tangential parts are in this ratio, and opposite.
            REQUIRE(double(flux->wi.x) ==
                    doctest::Approx(-eta * double(wo.x)).epsilon(1e-5));
        }
    }
    CHECK(reflected > 5000);
    CHECK(refracted > 2000);
}

TEST_CASE(
    "glass: the share that is reflected is Fresnel's, at the angle of the light") {
    for (const double n : {0.5, 1.1, 1.5, 2.42})
        for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 89.0, 100.0, 150.0}) {
            CAPTURE(n);
            CAPTURE(degrees);
            const auto wo = at_degrees<double>(degrees, 33);
            const double c = std::abs(wo.z);
            const double n_i = wo.z > 0 ? 1 : n, n_t = wo.z > 0 ? n : 1;
            CHECK(std::abs(reflected_share({.index = n}, wo) -
                           ljus::fresnel(c, n_i, n_t)) < 1e-12);
            CHECK(std::abs(reflected_share(
                               {.index = n, .fresnel = FresnelModel::schlick}, wo) -
                           ljus::schlick_dielectric(c, n_i, n_t)) < 1e-12);
        }
    // As the report's pictures do not show: the rim is bright.
    CHECK(reflected_share({.index = 1.5}, at_degrees<double>(85)) > 0.6);
}

TEST_CASE("glass: beyond the critical angle all stays inside") {
    for (const double degrees : {42.0, 60.0, 89.9}) {
        const auto wo = at_degrees<double>(180 - degrees);
        CHECK(reflected_share({.index = 1.5}, wo) == 1);
        CHECK(reflected_share({.index = 1.5, .fresnel = FresnelModel::schlick}, wo) ==
              1);
    }
    CHECK(reflected_share({.index = 1.5}, at_degrees<double>(180 - 41.5)) < 0.6);
    // An air bubble in water, seen from outside.
    CHECK(reflected_share({.index = 0.75}, at_degrees<double>(60)) == 1);
}

TEST_CASE_TEMPLATE("glass: the index of its surroundings makes it invisible", T, float,
                   double) {
    const GlassT<T> m{.index = 1};
    Draws draws;
    for (int i = 0; i < 5000; ++i) {
        const auto wo = draws.direction<T>();
        const auto s = sample(m, wo, draws.cube<T>(), Transport::radiance);
        REQUIRE(s);
        REQUIRE(glm::length(s->wi + wo) <= 4 * std::numeric_limits<T>::epsilon());
        REQUIRE(s->weight == Vec3T<T>{1, 1, 1});
    }
}

namespace {

/// What points back along a path at the other face of a slab, in that face's frame (z
/// outwards), when the path left the first face along `wi`, inwards.
Vec3T<double> at_other_face(const Vec3T<double>& wi) {
    return {-wi.x, -wi.y, wi.z};
}

} // namespace

TEST_CASE("glass: radiance that goes in and out again is what it was") {
    const GlassT<double> m{.index = 1.7};
    const auto wo = at_degrees<double>(50, 20);
    const Vec3T<double> through{0.5, 0.5, 0.999};
    const auto in = sample(m, wo, through, Transport::radiance);
    REQUIRE(in->wi.z < 0);
    CHECK(in->weight.x == doctest::Approx(1 / (1.7 * 1.7)).epsilon(1e-12));
    const auto out = sample(m, at_other_face(in->wi), through, Transport::radiance);
    REQUIRE(out->wi.z > 0);
    CHECK(in->weight.x * out->weight.x == doctest::Approx(1).epsilon(1e-12));
    CHECK(out->wi.z == doctest::Approx(wo.z).epsilon(1e-12)); // parallel to before
}

// False alarms: 5 standard errors in each of two rows, 1 in a million.
TEST_CASE(
    "glass: a slab lets 2n/(n^2 + 1) through at normal incidence, all reflections "
    "inside included") {
    const GlassT<double> m{.index = 1.5};
    const double table[][2] = {{0, 2 * 1.5 / (1.5 * 1.5 + 1)}, {60, 0.8362}};
    Draws draws;
    constexpr int count = 200000;
    for (const auto& row : table) {
        const double degrees = row[0], expected = row[1];
        CAPTURE(degrees);
        int passed = 0;
        for (int i = 0; i < count; ++i) {
            auto s = sample(m, at_degrees<double>(degrees), draws.cube<double>(),
                            Transport::flux);
            int crossings = 0;
            while (s->wi.z < 0) { // inside
                ++crossings;
                s = sample(m, at_other_face(s->wi), draws.cube<double>(),
                           Transport::flux);
            }
            passed += crossings % 2;
        }
        const double mean = double(passed) / count;
        const double error = std::sqrt(expected * (1 - expected) / count);
        MESSAGE("transmitted at ", degrees, " degrees: ", mean, ", expected ",
                expected);
        CHECK(std::abs(mean - expected) < 5 * error);
    }
}

TEST_CASE_TEMPLATE("glass: no NaN anywhere, for index ratios 1e-3 to 1e3", T, float,
                   double) {
    for (const T index : {T(1e-3), T(0.5), T(1), T(1.0000001), T(1.5), T(1e3)})
        for (const auto model : {FresnelModel::exact, FresnelModel::schlick})
            check_extremes(GlassT<T>{.index = index, .fresnel = model}, 1);
    check_sampling(GlassT<T>{}, at_degrees<T>(40));
}

TEST_CASE("glass: it is specular, and its colour is absorption") {
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    const Glass m{.absorption = {1, 2, 3}};
    CHECK(ljus::lobes(m) == ljus::Lobes::specular);
    CHECK(ljus::is_black(evaluate(m, up, up)));
    CHECK_FALSE(sample(m, up, u, Transport::flux, Lobes::diffuse));
    CHECK(ljus::absorption(m) == ljus::Rgb{1, 2, 3});
    CHECK(ljus::emission(m) == ljus::Rgb{0, 0, 0});
}

TEST_CASE("glass: what no glass can be is refused by name and value") {
    CHECK(refusal(Glass{}).empty());
    CHECK(refusal(Glass{.index = 1}).empty());
    CHECK(refusal(Glass{.index = -1}) ==
          "glass.index is -1; it must be within [0.001, 1000].");
    CHECK(refusal(Glass{.index = INFINITY}).find("glass.index") == 0);
    CHECK(refusal(Glass{.index = 1000}).empty());
    CHECK(refusal(Glass{.index = 0.001f}).empty());
    for (const float beyond : {1000.1f, 0.000999f})
        CHECK(refusal(Glass{.index = beyond}).find("within [0.001, 1000]") !=
              std::string::npos);
    CHECK(refusal(Glass{.absorption = {0, -1, 0}})
              .find("glass.absorption is (0, -1, 0)") == 0);
    CHECK(refusal(Glass{.absorption = {0, NAN, 0}}).find("glass.absorption") == 0);
}

TEST_CASE("glass: both ways at once are what one way is in the mean") {
    for (const double index : {1.0, 1.5, 2.4})
        for (const double cosine : {-1.0, -0.8, -0.3, 0.05, 0.5, 1.0}) {
            CAPTURE(index);
            CAPTURE(cosine);
            const GlassT<double> m{.index = index};
            const Vec3T<double> wo{std::sqrt(1 - cosine * cosine), 0, cosine};
            const auto both = split(m, wo, Transport::radiance);
            const double share = reflected_share(m, wo);
            if (!both) {
                CHECK(share == doctest::Approx(1)); // total reflection
                continue;
            }
            const auto& [reflected, refracted] = *both;
            CHECK(reflected.weight.x == doctest::Approx(share).epsilon(1e-9));
            CHECK(refracted.weight.x ==
                  doctest::Approx((1 - share) * refracted.eta_scale).epsilon(1e-9));
            CHECK(refracted.eta_scale ==
                  doctest::Approx(cosine > 0 ? 1 / (index * index) : index * index));
            const auto down = sample(m, wo, {0.5, 0.5, 0.9999999}, Transport::radiance);
            REQUIRE(down);
            CHECK(glm::distance(down->wi, refracted.wi) < 1e-12);
            CHECK(split(m, wo, Transport::flux)->at(1).eta_scale == 1);
        }
}
