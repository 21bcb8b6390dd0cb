/// \file thin_glass_test.cpp
/// \brief A pane against the sum of its reflections, one by one.

#include "ljus/materials/glass.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <numbers>

#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/textured.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/scene/make_scene.hpp"
#include "support/bsdf_checks.hpp"

using ljus::Lobes, ljus::ThinGlass, ljus::ThinGlassT, ljus::Transport, ljus::Vec3T;
using namespace ljus_test;

namespace {

using L = long double;
struct Shares {
    L reflected = 0, transmitted = 0;
};

/// Follows a ray through the pane, from boundary to boundary, with Fresnel's equations
/// as they are printed.
Shares bounce_by_bounce(L cos_theta, L n, L tint) {
    const L sine = std::sqrt(1 - cos_theta * cos_theta) / n;
    if (sine >= 1) return {1, 0};
    const L cosine = std::sqrt(1 - sine * sine);
    const L s = (cos_theta - n * cosine) / (cos_theta + n * cosine);
    const L p = (n * cos_theta - cosine) / (n * cos_theta + cosine);
    const L r = (s * s + p * p) / 2, a = std::pow(tint, 1 / cosine);
    Shares shares{r, 0};
    L inside = 1 - r;
    for (int way = 0; way < 2000000 && inside > 1e-25L; ++way) {
        inside *= a; // to the other boundary
        (way % 2 ? shares.reflected : shares.transmitted) += inside * (1 - r);
        inside *= r;
    }
    return shares;
}

} // namespace

TEST_CASE_TEMPLATE("thin glass: the sum of all bounces, for any index, angle and tint",
                   T, float, double) {
    Draws draws;
    const double u = std::numeric_limits<T>::epsilon() / 2;
    for (int i = 0; i < 5000; ++i) {
        const T n = static_cast<T>(draws.between(0.5, 3.0));
        const T tint = i % 3 ? draws.unit<T>() : T(1);
        const T c = draws.between(T(0.02), T(1));
        // At the critical angle nothing is known of the share.
        if (std::abs(1 - double(c) * double(c) - double(n) * double(n)) < 1e-3)
            continue;
        const auto ours =
            ljus::detail::pane_fractions(ThinGlassT<T>{n, ljus::RgbT<T>{tint}}, c);
        const Shares right = bounce_by_bounce(L(c), L(n), L(tint));
        REQUIRE(std::abs(L(ours.reflected.x) - right.reflected) <= 2000 * u);
        REQUIRE(std::abs(L(ours.transmitted.x) - right.transmitted) <= 2000 * u);
    }
}

TEST_CASE("thin glass: what textbooks say of a pane") {
    const auto pass_through = ljus::detail::pane_fractions(ThinGlassT<double>{}, 1.0);
    CHECK(pass_through.transmitted.x == doctest::Approx(2 * 1.5 / (1.5 * 1.5 + 1)));
    const auto slanted = ljus::detail::pane_fractions(ThinGlassT<double>{}, 0.5);
    CHECK(slanted.transmitted.x == doctest::Approx(0.836).epsilon(0.01));
    // No light is lost in clear glass, at any angle.
    for (int i = 0; i <= 1000; ++i) {
        const auto clear =
            ljus::detail::pane_fractions(ThinGlassT<double>{}, i / 1000.0);
        REQUIRE(clear.reflected.x + clear.transmitted.x ==
                doctest::Approx(1).epsilon(1e-14));
    }
    // One of index 1 is not there.
    const auto air = ljus::detail::pane_fractions(ThinGlassT<double>{.index = 1}, 0.3);
    CHECK(air.reflected.x == 0);
    CHECK(air.transmitted.x == 1);
    // A black one reflects what one boundary does, its colour grows with the angle.
    const ThinGlassT<double> green{.tint{0, 0.9, 0.5}};
    CHECK(ljus::detail::pane_fractions(green, 1.0).reflected.x ==
          doctest::Approx(0.04));
    CHECK(ljus::detail::pane_fractions(green, 1.0).transmitted.x == 0);
    CHECK(ljus::detail::pane_fractions(green, 0.3).transmitted.z <
          0.9 * ljus::detail::pane_fractions(green, 1.0).transmitted.z);
}

TEST_CASE_TEMPLATE("thin glass: samples are reflected, the rest goes straight on", T,
                   float, double) {
    const ThinGlassT<T> pane{T(1.5), {T(0.9), T(0.7), T(0.3)}};
    for (const double degrees : {0.0, 45.0, 80.0, 89.0, 120.0, 179.0}) {
        const auto wo = at_degrees<T>(degrees);
        const auto shares = ljus::detail::pane_fractions(pane, std::abs(wo.z));
        for (const auto transport : {Transport::radiance, Transport::flux}) {
            const auto s = sample(pane, wo, Vec3T<T>{0, 0, T(0.5)}, transport);
            REQUIRE(s);
            CHECK(s->specular);
            CHECK(s->wi == ljus::reflect(wo));
            CHECK(s->weight == shares.reflected);
        }
        CHECK(pass_through(pane, Vec3T<T>{0}, wo) == shares.transmitted);
    }
    check_extremes(pane, 1 + 1e-6);
    check_sampling(pane, at_degrees<T>(40));
    CHECK(ljus::lobes(pane) == ljus::Lobes::specular);
    static_assert(ljus::ThinSurface<ThinGlassT<T>>);
}

TEST_CASE("thin glass: a lamp is seen through it, and its shadow has its colour") {
    using namespace ljus;
    const ThinGlass pane{.tint{0.5f, 1, 0.25f}};
    const World scene(make_scene(placed(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}}, pane),
                                 placed(Sphere{.center{0, 0, 9}}, Lambertian{})));
    const SurfacePoint from{.position{0, 0, -1}}, to{.position{0, 0, 1}};
    const auto straight_through = detail::pane_fractions(pane, 1.0f).transmitted;
    CHECK(visibility(scene, from, to) == straight_through);
    const SurfacePoint beside{.position{3, 0, 1}};
    CHECK(visibility(scene, from, beside) == Rgb{1});
    // The checker decides for each place; a plain pane behind glass would not.
    const World board(make_scene(
        placed(Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
               Textured<ThinGlass, Checker>{{},
                                            {.map{.edge_u{1, 0, 0}, .edge_v{0, 1, 0}},
                                             .even = Rgb{1},
                                             .odd = Rgb{0}}})));
    const auto at = [&](float x) {
        return visibility(board, SurfacePoint{.position{x, 0.2f, -1}},
                          SurfacePoint{.position{x, 0.2f, 1}});
    };
    CHECK(at(0.2f).x == doctest::Approx(12.0 / 13));
    CHECK(is_black(at(0.7f)));
}

TEST_CASE("thin glass: an index or a tint that there is not is refused by name") {
    CHECK(refusal(ThinGlass{}).empty());
    for (const float bad : {0.0f, -1.0f, NAN, INFINITY})
        CHECK(refusal(ThinGlass{.index = bad}).find("thin_glass.index") == 0);
    CHECK(refusal(ThinGlass{.tint{1, 1.1f, 1}}).find("thin_glass.tint") == 0);
    CHECK(refusal(ThinGlass{.tint{1, NAN, 1}}).find("thin_glass.tint") == 0);
}

TEST_CASE("thin glass: a cosine that rounding has put above 1 is straight on") {
    const ThinGlassT<double> pane{1.5, {0.9, 0.7, 0.3}};
    const auto shares = ljus::detail::pane_fractions(pane, 1.0);
    for (const double z : {1.5, -1.5}) {
        const Vec3T<double> wo{0, 0, z};
        CHECK(pass_through(pane, Vec3T<double>{0}, wo) == shares.transmitted);
        CHECK(sample(pane, wo, Vec3T<double>{0}, Transport::flux)->weight ==
              shares.reflected);
    }
    CHECK(ThinGlass{}.index == 1.5f);
    CHECK(ThinGlass{}.tint == ljus::Rgb{1});
    CHECK(ljus::Glass{}.index == 1.5f);
    CHECK(ljus::Glass{}.absorption == ljus::Rgb{0});
    CHECK(ljus::Glass{}.fresnel == ljus::FresnelModel::exact);
}
