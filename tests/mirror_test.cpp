/// \file mirror_test.cpp
/// \brief One direction, and as much light as the reflectance says.

#include "ljus/materials/mirror.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/bsdf_checks.hpp"

using ljus::Lobes, ljus::Mirror, ljus::MirrorT, ljus::Transport;
using namespace ljus_test;

TEST_CASE_TEMPLATE("mirror: the mirror direction, on the side that is looked at", T,
                   float, double) {
    const MirrorT<T> m{.reflectance{T(0.9), T(0.8), T(0.1)}};
    Draws draws;
    for (int i = 0; i < 2000; ++i) {
        const auto wo = draws.direction<T>();
        const auto s = sample(m, wo, draws.cube<T>(), Transport::radiance);
        REQUIRE(s);
        REQUIRE(s->wi == ljus::Vec3T<T>{-wo.x, -wo.y, wo.z});
        REQUIRE(s->weight == m.reflectance);
        REQUIRE(s->specular);
        REQUIRE(s->pdf == 0);
        // The other way round it is the same path.
        const auto back = sample(m, s->wi, draws.cube<T>(), Transport::flux);
        REQUIRE(back->wi == wo);
    }
    check_extremes(m, 1);
    check_sampling(m, at_degrees<T>(40));
}

TEST_CASE("mirror: light between two facing mirrors falls as R^n") {
    const Mirror m{.reflectance = ljus::Rgb{0.9f}};
    ljus::Vec3 wo = at_degrees<float>(10);
    double left = 1;
    for (int n = 1; n <= 50; ++n) {
        const auto s = sample(m, wo, ljus::Vec3{0}, Transport::radiance);
        left *= double(s->weight.x);
        CHECK(left == doctest::Approx(std::pow(0.9, n)).epsilon(1e-5));
        wo = s->wi;
    }
}

TEST_CASE("mirror: it is specular, and only that") {
    static_assert(ljus::Material<Mirror>);
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    CHECK(ljus::lobes(Mirror{}) == ljus::Lobes::specular);
    CHECK(ljus::is_black(evaluate(Mirror{}, up, up)));
    CHECK_FALSE(sample(Mirror{}, up, u, Transport::flux, Lobes::diffuse));
    CHECK(sample(Mirror{}, up, u, Transport::flux, Lobes::specular));
    CHECK_FALSE(sample(Mirror{.reflectance = {0, 0, 0}}, up, u, Transport::flux));
}

TEST_CASE("mirror: a reflectance outside [0, 1] is refused by name and value") {
    CHECK(refusal(Mirror{}).empty());
    CHECK(refusal(Mirror{.reflectance = {1, 1, 1.5f}}).find("mirror.reflectance") == 0);
    CHECK_FALSE(refusal(Mirror{.reflectance = {1, NAN, 1}}).empty());
}

TEST_CASE("mirror: without more said it reflects all, and a metal is gold") {
    CHECK(Mirror{}.reflectance == ljus::Rgb{1});
    CHECK(ljus::Metal{}.index.n == ljus::gold<float>.n);
    CHECK(ljus::Metal{}.index.k == ljus::gold<float>.k);
    const ljus::ConductorIndex none;
    CHECK(none.n == ljus::Rgb{1});
    CHECK(none.k == ljus::Rgb{0});
}
