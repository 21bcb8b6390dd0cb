/// \file lambertian_test.cpp
/// \brief The albedo is what comes back, in every direction and from both sides.

#include "ljus/materials/lambertian.hpp"

#include <doctest/doctest.h>

#include <numbers>

#include "support/bsdf_checks.hpp"

using ljus::LambertianT, ljus::Lobes, ljus::RgbT, ljus::Vec3T;
using namespace ljus_test;

TEST_CASE("lambertian: the albedo by quadrature is the albedo, to 1e-12") {
    const LambertianT<double> m{.albedo = {0.2, 0.75, 1}};
    for (const double degrees : {0.0, 45.0, 80.0, 89.9, 100.0, 180.0}) {
        const auto albedo = albedo_by_quadrature(m, at_degrees<double>(degrees));
        for (int c = 0; c < 3; ++c) CHECK(std::abs(albedo[c] - m.albedo[c]) < 1e-12);
    }
}

TEST_CASE("lambertian: the f is albedo over pi, without a cosine") {
    const ljus::Lambertian m{.albedo = {0.5f, 0, 1}};
    const auto f = evaluate(m, at_degrees<float>(30), at_degrees<float>(80, 50));
    CHECK(f.x == doctest::Approx(0.5 / std::numbers::pi));
    CHECK(f.y == 0);
    CHECK(f.z == doctest::Approx(1 / std::numbers::pi));
    CHECK(ljus::is_black(evaluate(m, at_degrees<float>(30), at_degrees<float>(100))));
}

TEST_CASE_TEMPLATE("lambertian: samples, density and weight belong together", T, float,
                   double) {
    const LambertianT<T> m{.albedo{T(0.3), T(0.6), T(1)}};
    check_reciprocity(m, 0);
    for (const double degrees : {0.0, 70.0, 130.0}) {
        check_sampling(m, at_degrees<T>(degrees));
        check_sampling(m, at_degrees<T>(degrees), Lobes::diffuse, 2);
    }
    check_extremes(m, 1);
    // The weight is the albedo alone: a cosine on top would lose a third of the light.
    const auto s = sample(m, at_degrees<T>(50), Vec3T<T>{T(0.9), T(0.2), 0},
                          ljus::Transport::radiance);
    REQUIRE(s);
    CHECK(s->weight == m.albedo);
}

TEST_CASE("lambertian: nothing specular, nothing of black") {
    using ljus::Lambertian;
    static_assert(ljus::Material<Lambertian> && ljus::Material<LambertianT<double>>);
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    CHECK(lobes(Lambertian{}) == Lobes::diffuse);
    CHECK(lobes(Lambertian{.albedo = {0, 0, 0}}) == Lobes::diffuse);
    CHECK_FALSE(sample(Lambertian{}, up, u, ljus::Transport::flux, Lobes::specular));
    CHECK_FALSE(sample(Lambertian{.albedo = {0, 0, 0}}, up, u, ljus::Transport::flux));
    CHECK(ljus::emission(Lambertian{}) == ljus::Rgb{0, 0, 0});
}

TEST_CASE("lambertian: an albedo outside [0, 1] is refused by name and value") {
    using ljus::Lambertian;
    CHECK(refusal(Lambertian{.albedo = {0, 0.5f, 1}}).empty());
    CHECK(refusal(Lambertian{.albedo = {0, 2, 1}}) ==
          "lambertian.albedo is (0, 2, 1); it must be within [0, 1] "
          "in every channel.");
    CHECK_FALSE(refusal(Lambertian{.albedo = {0, NAN, 1}}).empty());
    CHECK_FALSE(refusal(Lambertian{.albedo = {-0.1f, 0, 1}}).empty());
}

TEST_CASE(
    "lambertian: only what is asked for is drawn, and half of the light is grey") {
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    CHECK(sample(ljus::Lambertian{}, up, u, ljus::Transport::flux, Lobes::diffuse));
    CHECK_FALSE(
        sample(ljus::Lambertian{}, up, u, ljus::Transport::flux, Lobes::glossy));
    CHECK(pdf(ljus::Lambertian{}, up, up, Lobes::glossy) == 0);
    CHECK(ljus::Lambertian{}.albedo == ljus::Rgb{0.5f});
}
