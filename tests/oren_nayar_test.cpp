/// \file oren_nayar_test.cpp
/// \brief The model of 1994 against its own angles, and the
/// albedo against a closed form.

#include "ljus/materials/oren_nayar.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "ljus/materials/lambertian.hpp"
#include "support/bsdf_checks.hpp"

using ljus::OrenNayar, ljus::OrenNayarT, ljus::Vec3T;
using namespace ljus_test;

namespace {

constexpr double pi = std::numbers::pi;

struct Terms {
    long double a, b;
};

Terms terms(long double sigma) {
    const long double s2 = sigma * sigma;
    return {1 - s2 / (2 * (s2 + 0.33L)), 0.45L * s2 / (s2 + 0.09L)};
}

/// The formula as it is printed, with acos, sin and tan, in long double.
template <typename T>
long double printed(T sigma, const Vec3T<T>& wo, const Vec3T<T>& wi) {
    using L = long double;
    const auto angle = [](const Vec3T<T>& w) {
        return std::atan2(std::hypot(L(w.x), L(w.y)), L(w.z));
    };
    const L theta_i = angle(wi), theta_o = angle(wo);
    const L alpha = std::max(theta_i, theta_o), beta = std::min(theta_i, theta_o);
    const L phi = std::atan2(L(wi.y), L(wi.x)) - std::atan2(L(wo.y), L(wo.x));
    const auto [a, b] = terms(L(sigma));
    return a + b * std::max(L(0), std::cos(phi)) * std::sin(alpha) * std::tan(beta);
}

/// The albedo of white, integrated by hand: the azimuths give 2, and the inclinations
/// split where the tangent changes its angle.
double closed_form(double sigma, double theta) {
    const auto [a, b] = terms(static_cast<long double>(sigma));
    const double s = std::sin(theta), c = std::cos(theta);
    const double steeper = (theta - s * c) / 2, flatter = (1 - s * s * s) / (3 * c);
    return double(a) + 2 * double(b) * s / pi * (steeper + flatter);
}

} // namespace

TEST_CASE_TEMPLATE("oren_nayar: within 64 roundoffs of the printed formula", T, float,
                   double) {
    const long double u = std::numeric_limits<T>::epsilon() / 2;
    Draws draws;
    long double worst = 0;
    for (int i = 0; i < 100000; ++i) {
        const T sigma = i % 2 ? draws.unit<T>() : draws.between(T(0), T(100));
        auto wo = draws.above<T>(), wi = draws.above<T>();
        if (i % 5 == 0) wi = wo; // the same angle
        if (i % 7 == 0) wo = at_degrees<T>(draws.between(85.0, 89.9), 20);
        const long double exact = printed(sigma, wo, wi);
        const long double ours =
            static_cast<long double>(ljus::detail::oren_nayar_ratio(sigma, wo, wi));
        // At crossed azimuths the cosine itself is small: count against its factor.
        const long double factor =
            std::hypot((long double)(wi.x), (long double)(wi.y)) *
            std::hypot((long double)(wo.x), (long double)(wo.y)) /
            std::max((long double)(wi.z), (long double)(wo.z));
        worst = std::max(worst, std::abs(ours - exact) / ((exact + factor) * u));
    }
    MESSAGE("largest error: ", double(worst), " u");
    CHECK(worst <= 64);
}

TEST_CASE(
    "oren_nayar: the albedo of white, as measured before and as integrated by hand") {
    const double table[][3] = {{0.5, 0, 0.785}, {0.5, 45, 0.851}, {0.5, 80, 0.929},
                               {1, 0, 0.624},   {1, 45, 0.707},   {1, 80, 0.805}};
    for (const auto& row : table) {
        const double sigma = row[0], degrees = row[1], albedo = row[2];
        CAPTURE(sigma);
        CAPTURE(degrees);
        const OrenNayarT<double> m{.albedo = ljus::RgbT<double>{1.0}, .sigma = sigma};
        const double ours = albedo_by_quadrature(m, at_degrees<double>(degrees), 800).x;
        CHECK(std::abs(ours - albedo) < 6e-4);
        CHECK(std::abs(ours - closed_form(sigma, degrees * pi / 180)) < 1e-4);
    }
}

TEST_CASE(
    "oren_nayar: at grazing angles the model returns 1.5 percent too much, not more") {
    double most = 0;
    for (double sigma = 0; sigma <= pi / 2; sigma += 0.01)
        for (double degrees = 0; degrees < 90; degrees += 0.5)
            most = std::max(most, closed_form(sigma, degrees * pi / 180));
    CHECK(most > 1.01);
    CHECK(most < 1.016);
}

TEST_CASE_TEMPLATE("oren_nayar: without roughness it is Lambert, to the last bit", T,
                   float, double) {
    const OrenNayarT<T> rough{.albedo{T(0.2), T(0.5), T(1)}, .sigma = 0};
    const ljus::LambertianT<T> matt{.albedo = rough.albedo};
    Draws draws;
    for (int i = 0; i < 2000; ++i) {
        const auto wo = draws.direction<T>(), wi = draws.direction<T>();
        REQUIRE(evaluate(rough, wo, wi) == evaluate(matt, wo, wi));
        const auto u = draws.cube<T>();
        const auto a = sample(rough, wo, u, ljus::Transport::flux);
        const auto b = sample(matt, wo, u, ljus::Transport::flux);
        REQUIRE(bool(a));
        REQUIRE(a->wi == b->wi);
        REQUIRE(a->weight == b->weight);
        REQUIRE(a->pdf == b->pdf);
    }
}

TEST_CASE("oren_nayar: roughness 10 and 100 are one picture, because 10 radians are no "
          "slope") {
    const auto up = at_degrees<float>(0);
    CHECK(ljus::detail::oren_nayar_ratio(1.0f, up, up) ==
          doctest::Approx(0.682 - 0.058).epsilon(2e-3));
    const float ten = ljus::detail::oren_nayar_ratio(10.0f, up, up);
    const float hundred = ljus::detail::oren_nayar_ratio(100.0f, up, up);
    CHECK(ten == doctest::Approx(0.5016).epsilon(1e-3));
    CHECK(hundred == doctest::Approx(0.5).epsilon(1e-3));
    CHECK(std::abs(ten / hundred - 1) < 0.006);
}

TEST_CASE("oren_nayar: the azimuths count, not the angle between the directions") {
    // Both at 60 degrees, a quarter turn apart: the azimuths' cosine is 0 and so is the
    // second term, where the directions' cosine, which the program took, is 1/4.
    const auto wo = at_degrees<double>(60, 0), wi = at_degrees<double>(60, 90);
    CHECK(glm::dot(wo, wi) == doctest::Approx(0.25));
    CHECK(ljus::detail::oren_nayar_ratio(0.5, wo, wi) ==
          doctest::Approx(double(terms(0.5L).a)).epsilon(1e-12));
    // Away from the light it is flat, towards it bright.
    CHECK(ljus::detail::oren_nayar_ratio(0.5, wo, at_degrees<double>(60, 180)) ==
          doctest::Approx(double(terms(0.5L).a)).epsilon(1e-12));
    CHECK(ljus::detail::oren_nayar_ratio(0.5, wo, wo) ==
          doctest::Approx(double(terms(0.5L).a + terms(0.5L).b * 1.5L)).epsilon(1e-12));
}

TEST_CASE("oren_nayar: a ball lit from the eye is flatter than Lambert's") {
    // Reflected radiance is f cos: from the middle to 75 degrees Lambert falls by cos.
    const auto radiance = [](double degrees) {
        const auto w = at_degrees<double>(degrees);
        return ljus::detail::oren_nayar_ratio(0.5, w, w) * w.z;
    };
    for (const double degrees : {30.0, 45.0, 60.0, 75.0}) {
        const double lambert = at_degrees<double>(degrees).z;
        MESSAGE("at ", degrees, " degrees ", radiance(degrees) / radiance(0),
                " of the middle, Lambert's ", lambert);
        CHECK(radiance(degrees) / radiance(0) > lambert + 0.05);
        CHECK(radiance(degrees) / radiance(0) < 1.01);
    }
}

TEST_CASE_TEMPLATE("oren_nayar: samples, density and weight belong together", T, float,
                   double) {
    static_assert(ljus::Material<OrenNayarT<T>>);
    for (const double sigma : {0.0, 0.3, 100.0}) {
        const OrenNayarT<T> m{.albedo{T(0.3), T(0.6), T(1)}, .sigma = T(sigma)};
        check_reciprocity(m, 0);
        for (const double degrees : {0.0, 80.0, 130.0})
            check_sampling(m, at_degrees<T>(degrees));
        CHECK(lobes(m) == ljus::Lobes::diffuse);
    }
    // Where both directions graze the weight has no bound but that of sin tan.
    check_extremes(OrenNayarT<T>{.albedo = ljus::RgbT<T>{T(1)}, .sigma = T(0.5)},
                   1 + 0.45 / std::sqrt(double(std::numeric_limits<T>::epsilon())));
    const ljus::Vec3T<T> up{0, 0, 1}, u{T(0.5), T(0.5), T(0.5)};
    CHECK_FALSE(sample(OrenNayarT<T>{.albedo = ljus::RgbT<T>{T(0)}}, up, u,
                       ljus::Transport::flux));
    CHECK_FALSE(
        sample(OrenNayarT<T>{}, up, u, ljus::Transport::flux, ljus::Lobes::specular));
}

TEST_CASE("oren_nayar: what is no angle is refused by name and value") {
    CHECK(refusal(OrenNayar{.albedo = {1, 1, 1}, .sigma = 0}).empty());
    CHECK(refusal(OrenNayar{.albedo = {1, 1, 1}, .sigma = 100}).empty()); // figure 14
    CHECK(refusal(OrenNayar{.albedo = {1, 1, 1}, .sigma = -0.5f}) ==
          "oren_nayar.sigma is -0.5; it must be within [0, 1000] radians (the model "
          "saturates near 1).");
    CHECK(refusal(OrenNayar{.sigma = NAN}).find("oren_nayar.sigma is NaN") == 0);
    CHECK(refusal(OrenNayar{.sigma = 1000}).empty());
    for (const float beyond : {std::nextafter(1000.0f, 2000.0f), INFINITY})
        CHECK(refusal(OrenNayar{.sigma = beyond}).find("oren_nayar.sigma is ") == 0);
    CHECK(refusal(OrenNayar{.albedo = {1, 1, 2}}).find("oren_nayar.albedo") == 0);
}

TEST_CASE_TEMPLATE("oren_nayar: finite where both directions are on the horizon", T,
                   float, double) {
    const T least = std::numeric_limits<T>::denorm_min();
    for (const T a : {least, T(3) * least, std::numeric_limits<T>::min(), T(1e-30)})
        for (const T b : {least, T(5) * least, T(1e-20)}) {
            const Vec3T<T> wo{T(1), T(0), a}, wi{T(1), T(0), b}, back{T(-1), T(0), b};
            const ljus::OrenNayarT<T> m{.sigma = T(1)};
            // A lamp of 1e20 W/(m^2 sr) is still a number.
            CHECK(std::isfinite(evaluate(m, wo, wi).x * T(1e20)));
            CHECK(evaluate(m, wo, wi).x > 0);
            CHECK(std::isfinite(evaluate(m, wo, back).x));
        }
}

TEST_CASE(
    "oren_nayar: only what is asked for is drawn; what it is if nothing is said") {
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    const auto flux = ljus::Transport::flux;
    CHECK(sample(OrenNayar{}, up, u, flux, ljus::Lobes::diffuse));
    CHECK_FALSE(sample(OrenNayar{}, up, u, flux, ljus::Lobes::glossy));
    CHECK(pdf(OrenNayar{}, up, up, ljus::Lobes::glossy) == 0);
    CHECK(OrenNayar{}.albedo == ljus::Rgb{0.5f});
    CHECK(OrenNayar{}.sigma == 0.3f);
}
