// concept: radiance
/// \file filter_test.cpp
/// \brief Pixel filters: their weights, places drawn by them, and pictures.

#include "ljus/image/filter.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <vector>

#include "ljus/render/render.hpp"

using ljus::Filter;
using ljus::Rgb;
using ljus::Vec2T;

namespace {

constexpr double pi = std::numbers::pi;
constexpr Filter filters[] = {Filter::box, Filter::tent, Filter::gaussian,
                              Filter::mitchell};

/// The integral of weight times cos(2 pi f x): what the filter lets through of a wave
/// with f cycles per pixel. Midpoint rule.
double passed(Filter filter, double frequency) {
    constexpr int steps = 40000;
    const double radius = 2.5;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double x = ((i + 0.5) / steps * 2 - 1) * radius;
        sum += ljus::filter_weight(filter, x) * std::cos(2 * pi * frequency * x);
    }
    return sum * 2 * radius / steps;
}

/// A renderer of waves along x, in the plane at distance 1.
struct Waves {
    using Stream = ljus::RandomStream;
    double frequency = 1; ///< In cycles per pixel.
    double pixel = 0.1;   ///< Width of a pixel in that plane.
    double slope = 0;     ///< Of a ramp that is added.
};
template <typename Context>
Rgb radiance(const Waves& waves, const ljus::Ray& ray, Context&) {
    const double x = double(ray.direction.x / -ray.direction.z) / waves.pixel;
    return Rgb(float(1 + std::cos(2 * pi * waves.frequency * x) + waves.slope * x));
}

ljus::Image seen(const Waves& waves, Filter filter, int samples) {
    const auto camera = ljus::look_at(
        {.vfov_degrees = 2 * 180 / float(pi) * std::atan(float(5 * 0.1))});
    return render(waves, camera,
                  {.width = 10, .height = 10, .samples = samples, .filter = filter})
        .image;
}

} // namespace

TEST_CASE_TEMPLATE("filter: weights are even, have the integral 1, and end at the "
                   "radius",
                   T, float, double) {
    for (const Filter filter : filters) {
        CAPTURE(int(filter));
        const double radius = ljus::filter_radius(filter);
        double sum = 0, values = 0;
        for (int i = 0; i < 20000; ++i) {
            const double x = (i + 0.5) / 10000 - 1;
            const T w = ljus::filter_weight(filter, T(x * radius));
            REQUIRE(w == ljus::filter_weight(filter, T(-x * radius)));
            sum += double(w) * radius / 10000;
            values += double(w) * double(w);
        }
        CHECK(sum == doctest::Approx(1).epsilon(1e-6));
        CHECK(values > 0);
        CHECK(ljus::filter_weight(filter, T(radius)) == 0);
        CHECK(ljus::filter_weight(filter, T(3)) == 0);
        CHECK(ljus::filter_weight(filter, std::numeric_limits<T>::quiet_NaN()) == 0);
        if (filter != Filter::box) // no step at the radius
            CHECK(std::abs(ljus::filter_weight(filter, T(radius * 0.9999))) < 2e-4);
    }
}

TEST_CASE("filter: of a wave passes what its Fourier transform says") {
    const auto sinc = [](double f) { return std::sin(pi * f) / (pi * f); };
    for (const double f : {0.25, 0.5, 0.9, 1.5, 2.5}) {
        CHECK(passed(Filter::box, f) == doctest::Approx(sinc(f)).epsilon(1e-4));
        CHECK(passed(Filter::tent, f) ==
              doctest::Approx(sinc(f) * sinc(f)).epsilon(1e-6));
    }
    // A pattern of 1.5 cycles per pixel: 21 %, and with dark for bright.
    CHECK(passed(Filter::box, 1.5) == doctest::Approx(-0.2122).epsilon(1e-3));
    CHECK(std::abs(passed(Filter::gaussian, 1.5)) < 0.01);
    CHECK(std::abs(passed(Filter::mitchell, 1.5)) < 0.02);
    // And of what a picture can show, half a cycle per pixel, as Mitchell keeps most.
    CHECK(passed(Filter::mitchell, 0.25) > passed(Filter::gaussian, 0.25));
    CHECK(passed(Filter::mitchell, 0.25) > passed(Filter::tent, 0.25));
}

TEST_CASE("filter: Mitchell's weights of all pixels add up to 1 everywhere") {
    for (double x = 0; x < 1; x += 0.0625)
        for (const Filter filter : {Filter::box, Filter::tent, Filter::mitchell}) {
            double sum = 0;
            for (int k = -3; k <= 3; ++k) sum += ljus::filter_weight(filter, x + k);
            // The box has both of its ends, or none, at just one place.
            if (filter != Filter::box || x != 0.5) CHECK(sum == doctest::Approx(1));
        }
    CHECK(ljus::filter_weight(Filter::mitchell, 0.0) == doctest::Approx(8.0 / 9));
    CHECK(ljus::filter_weight(Filter::mitchell, 1.0) == doctest::Approx(1.0 / 18));
    CHECK(ljus::filter_weight(Filter::mitchell, 1.5) < 0);
}

// By a fine grid of u, not at random: the midpoint rule over the unit square.
TEST_CASE_TEMPLATE("filter: places drawn, weighed, are the filter", T, float, double) {
    constexpr int n = 20000;
    for (const Filter filter : filters) {
        CAPTURE(int(filter));
        for (const double f : {0.0, 0.25, 0.8, 1.5}) {
            double sum_x = 0, sum_y = 0;
            for (int i = 0; i < n; ++i) {
                const T u = T((i + 0.5) / n);
                const auto x = ljus::sample_filter(filter, Vec2T<T>{u, T(0.25)});
                const auto y = ljus::sample_filter(filter, Vec2T<T>{T(0.25), u});
                const double other =
                    filter == Filter::box
                        ? 1
                        : double(ljus::detail::sample_filter_axis(filter, T(0.25)).y);
                sum_x += double(x.weight) / other *
                         std::cos(2 * pi * f * (double(x.place.x) - 0.5));
                sum_y += double(y.weight) / other *
                         std::cos(2 * pi * f * (double(y.place.y) - 0.5));
            }
            CHECK(sum_x / n == doctest::Approx(passed(filter, f)).epsilon(2e-4));
            CHECK(sum_y / n == doctest::Approx(passed(filter, f)).epsilon(2e-4));
        }
    }
}

TEST_CASE_TEMPLATE("filter: no u leaves the radius or has a weight that is no number",
                   T, float, double) {
    const T last = std::nextafter(T(1), T(0));
    for (const Filter filter : filters) {
        T before = T(-10);
        for (const T u : {T(0), T(1e-30), T(0.25), std::nextafter(T(0.5), T(0)), T(0.5),
                          T(0.500001), T(0.75), last, T(1)}) {
            const auto at = ljus::sample_filter(filter, Vec2T<T>{u, u});
            REQUIRE(std::isfinite(at.weight));
            REQUIRE(std::abs(at.weight) < 2);
            REQUIRE(std::abs(double(at.place.x) - 0.5) <=
                    ljus::filter_radius(filter) + 1e-6);
            REQUIRE(at.place.x == at.place.y);
            REQUIRE(at.place.x >= before); // strata stay strata
            before = at.place.x;
        }
        const auto middle = ljus::sample_filter(filter, Vec2T<T>{T(0.5), T(0.5)});
        CHECK(double(middle.place.x) == doctest::Approx(0.5));
    }
}

// Along an axis: a place that is drawn in proportion to the filter counts 1, or with
// its sign what the filter has on both sides of 0 in all; cells of constant density are
// off by the filter's slope, less than a fiftieth in the mean.
TEST_CASE("filter: places are drawn as often as they count") {
    constexpr int n = 4000;
    for (const Filter filter : {Filter::tent, Filter::gaussian, Filter::mitchell}) {
        CAPTURE(int(filter));
        double whole = 0; // the integral of |filter|, by the midpoint rule
        for (int i = 0; i < 40000; ++i)
            whole += std::abs(ljus::filter_weight(filter, (i + 0.5) / 10000 - 2)) / 1e4;
        double off = 0;
        for (int i = 0; i < n; ++i) {
            const auto at = ljus::detail::sample_filter_axis(filter, (i + 0.5) / n);
            off += std::abs(std::abs(at.y) - whole) / n;
        }
        CHECK(off < 0.02);
        // In a cell where the filter falls to 0 it is up to twice as large.
        double most = 0;
        for (int i = 0; i < 100 * n; ++i)
            most = std::max(
                most,
                std::abs(
                    ljus::detail::sample_filter_axis(filter, (i + 0.5) / n / 100).y));
        CHECK(most < 2.01 * whole);
    }
}

// 2x - x^2 = v: near the middle of the pixel, where 1 - sqrt(1 - v) has no digit left.
TEST_CASE_TEMPLATE("filter: a tent's places near the middle have all their digits", T,
                   float, double) {
    for (const double v : {1e-3, 1e-5, 1e-6, 3e-7}) {
        const T u = T(0.5 + v / 2);
        const double exact = 2 * double(u) - 1; // of the number as it was rounded
        const auto at = ljus::detail::sample_filter_axis(Filter::tent, u);
        CHECK(double(at.x) ==
              doctest::Approx(-std::expm1(std::log1p(-exact) / 2))
                  .epsilon(4 * double(std::numeric_limits<T>::epsilon()))
                  .scale(1e-300));
        CHECK(at.y == T(1));
        CHECK(ljus::detail::sample_filter_axis(Filter::tent, T(1) - u).x == -at.x);
    }
}

TEST_CASE("filter: the box leaves the place as it is, bit by bit") {
    const Vec2T<float> u{0.3f, 0.123456789f};
    const auto at = ljus::sample_filter(Filter::box, u);
    CHECK(at.place == u);
    CHECK(at.weight == 1.0f);
}

// 1024 stratified rays: the error is below 1/1000 of a wave of height 1 (measured with
// other seeds: 0.0003 at most), so that a wrong filter shows and chance does not.
TEST_CASE("filter: a picture of a wave keeps what the filter passes") {
    for (const Filter filter : filters)
        for (const double f : {0.25, 1.0, 1.5}) {
            CAPTURE(int(filter));
            CAPTURE(f);
            const auto image = seen({.frequency = f}, filter, 1024);
            for (int x = 3; x < 7; ++x) {
                const double middle = x + 0.5 - 5; // in pixels from the axis
                CHECK(double(pixel(image, x, 5).x) ==
                      doctest::Approx(1 +
                                      passed(filter, f) * std::cos(2 * pi * f * middle))
                          .epsilon(0.003));
            }
        }
}

TEST_CASE("filter: no filter moves a picture or changes its mean") {
    for (const Filter filter : filters) {
        CAPTURE(int(filter));
        const auto image = seen({.frequency = 0, .slope = 0.1}, filter, 4096);
        for (int x = 0; x < 10; ++x)
            CHECK(double(pixel(image, x, 4).x) ==
                  doctest::Approx(2 + 0.1 * (x + 0.5 - 5)).epsilon(0.005));
    }
}
