/// \file metal_test.cpp
/// \brief A mirror whose reflectance is that of its index and angle.

#include "ljus/materials/mirror.hpp"

#include <doctest/doctest.h>

#include <cmath>

#include "support/bsdf_checks.hpp"

using ljus::Lobes, ljus::Metal, ljus::MetalT, ljus::Transport;
using namespace ljus_test;

TEST_CASE_TEMPLATE("metal: the mirror direction with the reflectance of its angle", T,
                   float, double) {
    const MetalT<T> m{.index = ljus::copper<T>};
    Draws draws;
    for (int i = 0; i < 2000; ++i) {
        const auto wo = draws.direction<T>();
        const auto s = sample(m, wo, draws.cube<T>(), Transport::radiance);
        REQUIRE(s);
        REQUIRE(s->wi == ljus::Vec3T<T>{-wo.x, -wo.y, wo.z});
        REQUIRE(s->weight == ljus::fresnel_conductor(std::abs(wo.z), m.index));
        REQUIRE(s->specular);
        const auto back = sample(m, s->wi, draws.cube<T>(), Transport::flux);
        REQUIRE(back->weight == s->weight);
    }
    // A cosine that rounding has made larger than 1.
    const auto above =
        sample(m, ljus::Vec3T<T>{0, 0, T(1.5)}, draws.cube<T>(), Transport::radiance);
    REQUIRE(above);
    CHECK(above->weight == ljus::fresnel_conductor(T(1), m.index));
    check_extremes(m, 1);
    check_sampling(m, at_degrees<T>(40));
}

TEST_CASE("metal: gold is yellow from above and white at the rim") {
    const ljus::Vec3 u{0.5f, 0.5f, 0.5f};
    const auto weight = [&](double degrees) {
        return sample(Metal{}, at_degrees<float>(degrees), u, Transport::radiance)
            ->weight;
    };
    CHECK(weight(0).x > 2.5f * weight(0).z);
    CHECK(weight(89.9).z > 0.98f);
    CHECK(weight(89.9).x > 0.98f);
}

TEST_CASE("metal: it is specular, and only that") {
    static_assert(ljus::Material<Metal>);
    const ljus::Vec3 up{0, 0, 1}, u{0.5f, 0.5f, 0.5f};
    CHECK(ljus::lobes(Metal{}) == ljus::Lobes::specular);
    CHECK(ljus::is_black(evaluate(Metal{}, up, up)));
    CHECK(pdf(Metal{}, up, up) == 0);
    CHECK_FALSE(sample(Metal{}, up, u, Transport::flux, Lobes::diffuse));
    CHECK_FALSE(sample(Metal{}, {1, 0, 0}, u, Transport::flux));
    CHECK_FALSE(sample(Metal{}, {0, 0, NAN}, u, Transport::flux));
}

TEST_CASE("metal: an index that no metal has is refused by name and value") {
    CHECK(refusal(Metal{}).empty());
    CHECK(refusal(Metal{.index{ljus::Rgb{-1}, ljus::Rgb{1}}}).find("metal.index.n") ==
          0);
    CHECK(refusal(Metal{.index{ljus::Rgb{1}, {1, NAN, 1}}}).find("metal.index.k") == 0);
}
