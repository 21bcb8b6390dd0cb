#include <doctest/doctest.h>

#include <cmath>
#include <initializer_list>
#include <limits>
#include <type_traits>

#include "ljus/math/vector.hpp"

using namespace ljus;

TEST_CASE("vector: the plain names are float") {
    CHECK(std::is_same_v<Vec3, glm::vec3>);
    CHECK(std::is_same_v<Vec2, glm::vec2>);
    CHECK(std::is_same_v<Rgb, glm::vec3>);
    CHECK(std::is_same_v<Vec3T<double>, glm::dvec3>);
}

TEST_CASE("vector: a computation has the precision asked for, or that of the data") {
    CHECK(std::is_same_v<ComputeT<void, float>, float>);
    CHECK(std::is_same_v<ComputeT<void, double>, double>);
    CHECK(std::is_same_v<ComputeT<double, float>, double>);
}

TEST_CASE_TEMPLATE("vector: finite means no NaN and no infinity in any place", T, float,
                   double) {
    using Limits = std::numeric_limits<T>;
    CHECK(is_finite(Vec3T<T>{T(0), T(-0.0), T(1)}));
    CHECK(is_finite(Vec3T<T>{Limits::max(), Limits::lowest(), Limits::denorm_min()}));
    CHECK(is_finite(Vec3T<T>{Limits::max()})); // though their sum is not
    CHECK(is_finite(Vec3T<T>{Limits::lowest()}));
    for (const T bad : {Limits::quiet_NaN(), Limits::infinity(), -Limits::infinity()})
        for (int place = 0; place < 3; ++place) {
            Vec3T<T> v{T(1), T(2), T(3)};
            v[place] = bad;
            CHECK_FALSE(is_finite(v));
        }
}

TEST_CASE("vector: black is zero in every channel") {
    CHECK(is_black(Rgb{0, 0, 0}));
    CHECK(is_black(Rgb{-0.0f, 0, 0}));
    CHECK_FALSE(is_black(Rgb{1, -1, 0})); // though their sum is
    CHECK_FALSE(is_black(Rgb{-1, -1, 2}));
    for (int channel = 0; channel < 3; ++channel) {
        Rgb color{0, 0, 0};
        color[channel] = std::numeric_limits<float>::denorm_min();
        CHECK_FALSE(is_black(color));
    }
    CHECK_FALSE(is_black(Rgb{std::numeric_limits<float>::quiet_NaN(), 0, 0}));
}

TEST_CASE("vector: the largest component, wherever it stands") {
    CHECK(max_component(Vec3{3, 2, 1}) == 3.0f);
    CHECK(max_component(Vec3{1, 3, 2}) == 3.0f);
    CHECK(max_component(Vec3{1, 2, 3}) == 3.0f);
    CHECK(max_component(Vec3{-3, -2, -1}) == -1.0f);
    CHECK(max_component(Vec3{-1, -2, -3}) == -1.0f);
    CHECK(max_component(Vec3{2, 2, 2}) == 2.0f);
}

TEST_CASE_TEMPLATE("vector: the size of each component", T, float, double) {
    const Vec3T<T> v{T(-1), T(2), T(-3)};
    CHECK(detail::sizes(v) == Vec3T<T>{T(1), T(2), T(3)});
    CHECK(detail::sizes(-v) == Vec3T<T>{T(1), T(2), T(3)});
    CHECK_FALSE(std::signbit(detail::sizes(Vec3T<T>{T(-0.0)}).x));
}
