// Assignment 3: each test is a sentence that must hold. Its name states its points.
// Means are compared with closed forms within five standard errors: a right answer
// fails a check once in 1.7 million seeds, and the seeds are fixed. Any right estimator
// will do.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;
using course::Mean;

namespace {

constexpr double pi = std::numbers::pi;

/// The integrals of several functions over all directions, estimated from samples
/// divided by their density. They are right only if sampler and density agree.
template <typename Sample, typename Pdf>
void check_sampler(const Sample& sample, const Pdf& pdf, double one_minus_cosine,
                   const Vec3& axis) {
    auto stream = course::stream(5);
    Mean solid_angle, height, square, side;
    const Vec3 across = around(axis, Vec3{1, 0, 0});
    for (int i = 0; i < 40000; ++i) {
        const Vec3 d = sample(next_2d(stream));
        REQUIRE(length(d) == doctest::Approx(1).epsilon(1e-4));
        const double p = pdf(d);
        REQUIRE(p > 0);
        const double z = dot(d, axis);
        REQUIRE(z >= 1 - one_minus_cosine - 1e-5);
        solid_angle.add(1 / p);
        height.add(z / p);
        square.add(z * z / p);
        side.add((dot(d, across) > 0 ? 1 : 0) / p);
    }
    const double w = 1 - one_minus_cosine; // the cosine at the border
    CHECK(height.agrees(pi * (1 - w * w), 1e-4));
    CHECK(square.agrees(2 * pi * (1 - w * w * w) / 3, 1e-4));
    // If p is the cosine, 1/p is unbounded at the horizon, and its mean converges
    // slowly.
    CHECK(std::abs(solid_angle.mean() / (2 * pi * one_minus_cosine) - 1) < 0.1);
    CHECK(std::abs(side.mean() / (pi * one_minus_cosine) - 1) < 0.1);
}

/// Points near the border of the unit square, where rounding matters most.
template <typename Sample, typename Pdf>
void check_border(const Sample& sample, const Pdf& pdf) {
    const float last = 1 - 0x1p-24f; // the largest float below 1
    for (int i = 0; i < 1000; ++i)
        for (const float edge : {0.0f, last})
            for (const Vec2 u :
                 {Vec2{edge, float(i) / 1000}, {float(i) / 1000, edge}}) {
                CAPTURE(u.x);
                CAPTURE(u.y);
                REQUIRE(sample(u).z > 0);
                REQUIRE(pdf(sample(u)) > 0);
            }
}

/// A sky with a bright lamp at 60 degrees from the zenith; the rest of the sky is dim.
struct Night {
    Cone lamp{normalize(Vec3{std::sqrt(3.0f), 0, 1}), 0.995f};
    double bright = 100, dim = 0.5;
    Sky sky() const {
        return [*this](const Vec3& d) {
            if (d.z <= 0) return 0.0;
            return dot(d, lamp.axis) >= lamp.cosine ? bright : dim;
        };
    }
    /// The projected solid angle of a cone above the horizon: pi sin^2 of its half
    /// angle, times the cosine of its axis.
    double share() const {
        const double c = lamp.cosine;
        return pi * (1 - c * c) * double(lamp.axis.z);
    }
    double irradiance() const { return dim * pi + (bright - dim) * share(); }
};

} // namespace

TEST_CASE("3.1 (2 points) the standard error is that of the mean") {
    INFO("Expected: sqrt(s^2 / n) with s^2 = sum (y - mean)^2 / (n - 1).\n"
         "Likely: n for n - 1, or the deviation of one sample in place of the "
         "mean's.\n"
         "Read: Estimate; the chapter Monte Carlo.");
    const Estimate four = estimate({1, 2, 3, 6});
    CHECK(four.mean == doctest::Approx(3));
    CHECK(four.error == doctest::Approx(std::sqrt(14.0 / 3 / 4)));
    // Over many runs: the true error of the mean of 100 uniform numbers is
    // 1/sqrt(1200).
    auto stream = course::stream(1);
    Mean errors;
    for (int run = 0; run < 400; ++run) {
        std::vector<double> samples;
        for (int i = 0; i < 100; ++i) samples.push_back(double(next_1d(stream)));
        errors.add(estimate(samples).error);
    }
    CHECK(errors.agrees(1 / std::sqrt(1200.0), 2e-4));
}

TEST_CASE("3.2 (2 points) points of the disc are even in area") {
    INFO("Expected: a quarter of the points within half the radius.\n"
         "Likely: r = u without its root.\n"
         "Read: Inversion.");
    auto stream = course::stream(2);
    Mean r2, inner, x, right;
    for (int i = 0; i < 40000; ++i) {
        const Vec2 p = sample_disc(next_2d(stream));
        const double square = double(dot(p, p));
        REQUIRE(square <= 1.00001);
        r2.add(square);
        inner.add(square < 0.25);
        x.add(p.x);
        right.add(p.x > std::abs(p.y));
    }
    CHECK(r2.agrees(0.5));
    CHECK(inner.agrees(0.25));
    CHECK(x.agrees(0));
    CHECK(right.agrees(0.25));
}

TEST_CASE("3.3 (2 points) uniform directions and their density agree") {
    INFO("Expected: 1/(2 pi) above the horizon, 0 below, and z uniform in (0, 1].\n"
         "Likely: the angle uniform in place of its cosine.\n"
         "Read: Inversion; the chapter Directions.");
    check_sampler(sample_uniform, pdf_uniform, 1, {0, 0, 1});
    CHECK(pdf_uniform({0, 0, 1}) == doctest::Approx(0.5 / pi));
    CHECK(pdf_uniform(normalize(Vec3{0, 1, -1})) == 0);
    check_border(sample_uniform, pdf_uniform);
    auto stream = course::stream(3);
    Mean z;
    for (int i = 0; i < 20000; ++i) z.add(sample_uniform(next_2d(stream)).z);
    CHECK(z.agrees(0.5));
}

TEST_CASE("3.4 (2 points) cosine-weighted directions and their density agree") {
    INFO("Expected: cos/pi above the horizon, 0 below, and z > 0 for every u: at "
         "the rim 1 - x^2 - y^2 may round to 0 or below it.\n"
         "Read: Inversion; the chapter Directions.");
    check_sampler(sample_cosine, pdf_cosine, 1, {0, 0, 1});
    CHECK(pdf_cosine({0, 0.6f, 0.8f}) == doctest::Approx(0.8 / pi));
    CHECK(pdf_cosine(normalize(Vec3{0, 1, -1})) == 0);
    check_border(sample_cosine, pdf_cosine);
    auto stream = course::stream(3);
    Mean z;
    for (int i = 0; i < 20000; ++i) z.add(sample_cosine(next_2d(stream)).z);
    CHECK(z.agrees(2.0 / 3));
}

TEST_CASE("3.5 (3 points) directions within a cone and their density agree") {
    INFO("Expected: 1/(2 pi (1 - c)) inside, 0 outside, around the axis.\n"
         "Likely: around +z, or a density that does not ask where the direction is.\n"
         "Read: Inversion.");
    for (const float cosine : {0.2f, 0.9f, 0.999f}) {
        const Cone cone{normalize(Vec3{1, -2, 0.5f}), cosine};
        CAPTURE(cosine);
        check_sampler([&](Vec2 u) { return sample_cone(cone, u); },
                      [&](const Vec3& d) { // rounding may put d just outside
                          return pdf_cone({cone.axis, cosine - 1e-5f}, d);
                      },
                      1 - double(cosine), cone.axis);
        CHECK(pdf_cone(cone, -cone.axis) == 0);
    }
}

TEST_CASE("3.6 (3 points) all ways have the mean of the closed form") {
    INFO("Expected: L cos / density, and 0 for a direction of the cone below the "
         "floor.\n"
         "Likely: the cosine forgotten, or negative there.\n"
         "Read: Irradiance; the chapter Radiance.");
    const Night night;
    const Sky sky = night.sky();
    auto stream = course::stream(4);
    Mean uniform, cosine, cone;
    for (int i = 0; i < 200000; ++i) {
        uniform.add(irradiance_uniform(sky, next_2d(stream)));
        cosine.add(irradiance_cosine(sky, next_2d(stream)));
        cone.add(irradiance_cone(sky, night.lamp, next_2d(stream)));
    }
    CHECK(uniform.agrees(night.irradiance()));
    CHECK(cosine.agrees(night.irradiance()));
    CHECK(cone.agrees(night.bright * night.share(), 1e-3));
    REQUIRE(cone.mean() > 0);
    // A lamp whose middle lies on the horizon, so that half of its light comes from
    // below the floor. The upper half of a cone of half angle a gives (2 a - sin 2a) /
    // 2.
    const Cone half{{1, 0, 0}, 0.5f};
    Mean low;
    for (int i = 0; i < 40000; ++i)
        low.add(
            irradiance_cone([](const Vec3&) { return 1.0; }, half, next_2d(stream)));
    CHECK(low.agrees(pi / 3 - std::sqrt(3.0) / 4));
}

TEST_CASE("3.7 (2 points) an even sky costs cosine-weighted directions no noise") {
    INFO("Expected: L pi from every cosine-weighted direction, since the cosine "
         "cancels.\n"
         "Likely: the cosine twice.\n"
         "Read: Irradiance; the chapter Directions.");
    const Sky even = [](const Vec3& d) { return d.z > 0 ? 2.0 : 0.0; };
    auto stream = course::stream(6);
    Mean cosine, uniform;
    for (int i = 0; i < 20000; ++i) {
        cosine.add(irradiance_cosine(even, next_2d(stream)));
        uniform.add(irradiance_uniform(even, next_2d(stream)));
    }
    CHECK(cosine.mean() == doctest::Approx(2 * pi).epsilon(1e-4));
    CHECK(cosine.variance() < 1e-4);
    CHECK(uniform.variance() == doctest::Approx(4 * pi * pi / 3).epsilon(0.05));
}

TEST_CASE("3.8 (2 points) the weights of two ways add up to 1") {
    INFO("Expected: a / (a + b).\n"
         "Read: Two ways.");
    CHECK(balance(3, 1) == doctest::Approx(0.75));
    CHECK(balance(1, 3) + balance(3, 1) == doctest::Approx(1));
    CHECK(balance(2, 0) == doctest::Approx(1));
}

TEST_CASE("3.9 (4 points) both ways together are right and have less noise") {
    INFO("Expected: the irradiance of the whole sky.\n"
         "Likely: a density of the other direction in a weight, weights swapped, a "
         "mean of the two ways, or pdf_cone() = 0 for a direction that was drawn "
         "in the cone.\n"
         "Read: Two ways; the chapter Monte Carlo.");
    const Night night;
    const Sky sky = night.sky();
    auto stream = course::stream(7);
    Mean both, cosine;
    for (int i = 0; i < 100000; ++i) {
        both.add(irradiance_both(sky, night.lamp, next_2d(stream), next_2d(stream)));
        cosine.add(irradiance_cosine(sky, next_2d(stream)));
    }
    CHECK(both.agrees(night.irradiance(), 1e-3));
    CHECK(both.variance() < cosine.variance() / 20);

    // A lamp as wide as a third of the sky, for which both methods have similar
    // densities.
    const Night wide{.lamp = {{0, 0, 1}, 0.5f}, .bright = 3};
    Mean evening;
    for (int i = 0; i < 100000; ++i)
        evening.add(
            irradiance_both(wide.sky(), wide.lamp, next_2d(stream), next_2d(stream)));
    CHECK(evening.agrees(wide.irradiance(), 1e-3));

    // Lamps as small as stars, each in a slightly larger patch of bright sky. A
    // direction in the cone gives L cos / (p_a + p_b), even if rounding moves it out of
    // the cone. The cosine-weighted direction is far from the patch.
    for (int i = 0; i < 20000; ++i) {
        const float phi = 2 * next_1d(stream) - 1, sine = std::sqrt(0.75f);
        const Vec3 to_star{sine * std::cos(phi), sine * std::sin(phi), 0.5f};
        const Cone star{normalize(to_star), 0.999999f};
        const Sky patch = [&](const Vec3& d) {
            return dot(d, star.axis) > 0.999f ? 1 : 0;
        };
        const double p_b = 1 / (2 * pi * (1 - double(star.cosine)));
        const double light =
            irradiance_both(patch, star, {0.5f, 0.5f}, next_2d(stream));
        REQUIRE(light * (0.5 / pi + p_b) == doctest::Approx(0.5).epsilon(0.02));
    }
}

TEST_CASE("3.10 (2 points) each cell of the grid gets one point") {
    INFO("Expected: one point in each cell, x and y by chance and independent.\n"
         "Likely: one number for both, or for all cells.\n"
         "Read: Strata; the chapter Monte Carlo.");
    auto stream = course::stream(8);
    Mean offset, product;
    for (const int n : {1, 3, 8}) {
        for (int run = 0; run < 20; ++run) {
            const std::vector<Vec2> points = stratified(n, stream);
            REQUIRE(points.size() == static_cast<std::size_t>(n * n));
            std::vector<int> cells(points.size());
            for (const Vec2& p : points) {
                REQUIRE((p.x >= 0 && p.x < 1 && p.y >= 0 && p.y < 1));
                ++cells[static_cast<std::size_t>(int(p.y * float(n)) * n +
                                                 int(p.x * float(n)))];
                const double x = double(p.x) * n, y = double(p.y) * n;
                offset.add(x - std::floor(x));
                product.add((x - std::floor(x) - 0.5) * (y - std::floor(y) - 0.5));
            }
            for (const int cell : cells) REQUIRE(cell == 1);
        }
    }
    CHECK(offset.agrees(0.5));
    CHECK(product.agrees(0)); // x tells nothing about y
    CHECK(offset.variance() == doctest::Approx(1.0 / 12).epsilon(0.1));
}

TEST_CASE("3.11 (1 point) roulette keeps the mean") {
    INFO("Expected: value / chance where u < chance, otherwise 0.\n"
         "Likely: not divided, or divided by the other chance.\n"
         "Read: Roulette; the chapter Monte Carlo.");
    auto stream = course::stream(9);
    Mean value;
    int ended = 0;
    for (int i = 0; i < 20000; ++i) {
        const double x = roulette(3, 0.25, double(next_1d(stream)));
        value.add(x);
        ended += x == 0;
    }
    CHECK(value.agrees(3));
    CHECK(ended == doctest::Approx(15000).epsilon(0.03));
}

} // namespace course_tests
