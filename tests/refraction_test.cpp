/// \file refraction_test.cpp
/// \brief Known bends, the way back, and where there is no refracted ray.

#include "ljus/optics/refraction.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <type_traits>

#include "support/draws.hpp"
#include "support/refusal.hpp"

using ljus::Vec3T;
using ljus_test::Draws;

TEST_CASE_TEMPLATE("refraction: total reflection begins at the critical angle", T,
                   float, double) {
    for (const double n : {1.001, 1.33, 1.5, 2.42, 1000.0}) {
        const double critical = std::asin(1 / n) * 180 / 3.14159265358979323846;
        const double near = sizeof(T) == 4 ? 1e-3 : 1e-9; // of the angle
        const auto below = ljus_test::at_degrees<T>(critical * (1 - near));
        const auto above = ljus_test::at_degrees<T>(critical * (1 + near));
        CHECK(ljus::refract(below, T(n)));
        CHECK_FALSE(ljus::refract(above, T(n)));
        CHECK(ljus::refract(-below, Vec3T<T>{0, 0, 1}, T(n)));
        CHECK_FALSE(ljus::refract(-above, Vec3T<T>{0, 0, 1}, T(n)));
        CHECK(ljus::refract(above, T(1 / n))); // into the denser medium always
    }
}

TEST_CASE_TEMPLATE("refraction: the known bend into glass and out of it", T, float,
                   double) {
    // 3-4-5: sine 0.6 becomes 0.4 for n = 1.5, cosine sqrt(0.84).
    const Vec3T<T> up{0, 0, 1};
    const auto in = ljus::refract(Vec3T<T>{T(0.6), 0, T(-0.8)}, up, T(1) / T(1.5));
    REQUIRE(in);
    CHECK(in->x == doctest::Approx(0.4).epsilon(1e-7));
    CHECK(in->y == 0);
    CHECK(in->z == doctest::Approx(-std::sqrt(0.84)).epsilon(1e-7));
    const auto out = ljus::refract(*in, up, T(1.5));
    REQUIRE(out);
    CHECK(out->x == doctest::Approx(0.6).epsilon(1e-6));
    CHECK(out->z == doctest::Approx(-0.8).epsilon(1e-6));
}

TEST_CASE_TEMPLATE("refraction: a path can be walked back", T, float, double) {
    Draws draws{11};
    const double u = std::numeric_limits<T>::epsilon() / 2;
    for (int i = 0; i < 20000; ++i) {
        const Vec3T<T> wo = draws.direction<T>();
        const T eta = static_cast<T>(std::pow(10.0, draws.between(-1.0, 1.0)));
        const auto wi = ljus::refract(wo, eta);
        if (!wi) continue;
        const auto back = ljus::refract(*wi, T(1) / eta);
        if (!back) {
            REQUIRE(std::abs(wo.z) < T(1e-3)); // grazing: rounding may close the way
            continue;
        }
        // Snell's law gives the sines back, multiplied by 1/eta: so are the roundings.
        const double most = 16 * u * (1 + double(eta) + 1 / double(eta));
        REQUIRE(std::abs(back->x - wo.x) <= most);
        REQUIRE(std::abs(back->y - wo.y) <= most);
    }
}

TEST_CASE_TEMPLATE(
    "refraction: into the same index a ray goes straight on, even where it "
    "grazes",
    T, float, double) {
    Draws draws{5};
    const T u = std::numeric_limits<T>::epsilon() / 2;
    for (int i = 0; i < 20000; ++i) {
        Vec3T<T> wo = draws.direction<T>();
        if (i % 2) wo = glm::normalize(Vec3T<T>{wo.x, wo.y, T(1e-6) * wo.z});
        const auto wi = ljus::refract(wo, T(1));
        REQUIRE(wi);
        REQUIRE(std::abs(wi->x + wo.x) <= 3 * u);
        REQUIRE(std::abs(wi->y + wo.y) <= 3 * u);
        REQUIRE(std::abs(wi->z + wo.z) <= 4 * u * std::abs(wo.z));
    }
}

TEST_CASE_TEMPLATE("refraction: straight down stays straight down", T, float, double) {
    for (const T eta : {T(1e-3), T(0.5), T(1), T(1.5), T(1e3)}) {
        CHECK(*ljus::refract(Vec3T<T>{0, 0, 1}, eta) == Vec3T<T>{0, 0, -1});
        CHECK(*ljus::refract(Vec3T<T>{0, 0, -1}, eta) == Vec3T<T>{0, 0, 1});
        const Vec3T<T> n{T(0.6), 0, T(0.8)};
        const auto t = ljus::refract(-n, n, eta);
        REQUIRE(t);
        CHECK(glm::dot(*t, -n) == doctest::Approx(1).epsilon(1e-6));
    }
}

TEST_CASE_TEMPLATE("refraction: the normal may point to either side", T, float,
                   double) {
    Draws draws{9};
    for (int i = 0; i < 2000; ++i) {
        const Vec3T<T> n = draws.direction<T>(), d = draws.direction<T>();
        const T eta = static_cast<T>(std::pow(10.0, draws.between(-3.0, 3.0)));
        const auto a = ljus::refract(d, n, eta), b = ljus::refract(d, -n, eta);
        REQUIRE(bool(a) == bool(b));
        if (a) REQUIRE(*a == *b);
        if (a) REQUIRE(glm::dot(*a, n) * glm::dot(d, n) > 0); // it has crossed
    }
}

TEST_CASE_TEMPLATE("refraction: NaN and infinity give nothing", T, float, double) {
    const T nan = std::numeric_limits<T>::quiet_NaN();
    const T infinity = std::numeric_limits<T>::infinity();
    const Vec3T<T> up{0, 0, 1};
    const Vec3T<T> d{T(0.6), 0, T(-0.8)};
    CHECK_FALSE(ljus::refract(d, nan));
    CHECK_FALSE(ljus::refract(d, infinity));
    CHECK_FALSE(ljus::refract(d, up, nan));
    CHECK_FALSE(ljus::refract(d, Vec3T<T>{0, 0, nan}, T(1.5)));
    for (int i = 0; i < 3; ++i) {
        Vec3T<T> bad = d;
        bad[i] = nan;
        CHECK_FALSE(ljus::refract(bad, T(0.7)));
        CHECK_FALSE(ljus::refract(bad, up, T(0.7)));
    }
}

TEST_CASE("refraction: GLM's function of the same name is not in the way") {
    using ljus::refract, ljus::Vec3;
    const Vec3 d{0.6f, 0, -0.8f}, n{0, 0, 1};
    static_assert(std::is_same_v<decltype(refract(d, n, 0.5f)), std::optional<Vec3>>);
    CHECK(refract(d, n, 0.5f)->x == doctest::Approx(0.3));
}

TEST_CASE("refraction: an index that no substance has is refused by name and value") {
    const auto message = [](float index) {
        return ljus_test::refusal(
            [&] { ljus::detail::require_index("glass.index", index); });
    };
    CHECK(message(1.5f).empty());
    CHECK(message(0.001f).empty());
    CHECK(message(1000.0f).empty());
    CHECK(message(-1) == "glass.index is -1; it must be within [0.001, 1000].");
    CHECK(message(0) == "glass.index is 0; it must be within [0.001, 1000].");
    CHECK(message(NAN) == "glass.index is NaN; it must be within [0.001, 1000].");
    CHECK(message(2000) == "glass.index is 2000; it must be within [0.001, 1000].");
    CHECK(message(0.0005f) ==
          "glass.index is 0.0005; it must be within [0.001, 1000].");
}

TEST_CASE_TEMPLATE("refraction: what comes out is of unit length, whatever goes in", T,
                   float, double) {
    Draws draws{13};
    const T u = std::numeric_limits<T>::epsilon() / 2;
    int found = 0;
    for (int i = 0; i < 20000; ++i) {
        // A little too long or too short, as a sum of rounded parts may be.
        const T stretch = i % 2 ? T(1) : draws.between(T(0.999), T(1.001));
        const Vec3T<T> d = stretch * draws.direction<T>(), n = draws.direction<T>();
        const T eta = static_cast<T>(std::pow(10.0, draws.between(-2.0, 2.0)));
        for (const auto& t : {ljus::refract(d, eta), ljus::refract(d, n, eta)}) {
            if (!t) continue;
            ++found;
            REQUIRE(std::abs(glm::length(*t) - 1) <= 6 * u);
        }
    }
    CHECK(found > 20000);
}
