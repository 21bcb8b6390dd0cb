// Assignment 7: each test is a sentence that must hold. Its name states its points.
// Means are compared with closed forms within five standard errors: a right answer
// fails a check once in 1.7 million seeds, and the seeds are fixed. Any right estimator
// will do.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include <algorithm>
#include <numbers>
#include <set>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;
using course::Mean;

namespace {

constexpr double pi = std::numbers::pi;

/// The arguments with which a pass should be called.
struct Call {
    float radius;
    int number;
};

/// The squared radius of pass n divided by that of the first pass, by gamma functions.
double shrunk(int n, double alpha) {
    return std::exp(std::lgamma(n + alpha) - std::lgamma(1 + alpha) -
                    std::lgamma(n + 1));
}

/// The fraction of an estimate that remains at a distance d inside a straight edge of
/// light: the integral of the kernel over the lit part of the disc, by the midpoint
/// rule.
double inside(double d, double radius) {
    const double end = std::min(1.0, d / radius);
    constexpr int n = 1000;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double x = -1 + (end + 1) * (i + 0.5) / n;
        sum += std::pow(1 - x * x, 1.5);
    }
    return 8 / (3 * pi) * sum * (end + 1) / n;
}

/// The progress after passes of a given light at some points.
Progress passes_of(const Light& light, const std::vector<Vec2>& points,
                   Progress progress, int passes, int count, int first_number) {
    run(progress, passes, [&](float radius, int number) {
        return photon_pass(light, points, radius, count, first_number + number);
    });
    return progress;
}

/// The irradiance of the square of light at one point, from the 50 photons of a pass.
double middle(int number) {
    const std::vector<Vec2> points{{0, 0}};
    const Picture picture = photon_pass(square_of_light(), points, 0.4f, 50, number);
    REQUIRE(picture.size() == 1);
    return picture[0];
}

} // namespace

TEST_CASE("7.1 (3 points) the radius shrinks at the rate that alpha asks for") {
    INFO("Expected: the square of the radius times (i + alpha)/(i + 1).\n"
         "Likely: the radius itself times that, or passes counted from 0.\n"
         "Read: The radius; the chapter Progressive photons.");
    for (const float alpha : {1.0f / 3, 2.0f / 3, 1.0f}) {
        float radius = 0.5f;
        for (int i = 1; i < 1000; ++i) radius = next_radius(radius, i, alpha);
        const double share = double(radius) * double(radius) / 0.25;
        CHECK(share == doctest::Approx(shrunk(1000, double(alpha))).epsilon(1e-3));
    }
    CHECK(next_radius(1, 1, 0.5f) == doctest::Approx(std::sqrt(0.75)));
}

TEST_CASE("7.2 (3 points) each pass has its radius and a number of its own") {
    INFO("Expected: the first pass with the radius that progress has, and each later "
         "one with the next; no number twice.\n"
         "Likely: a radius that shrinks before the first pass, or never.\n"
         "Read: The loop.");
    Progress progress{.alpha = 0.5f, .radius = 2};
    std::vector<Call> calls;
    run(progress, 40, [&](float radius, int number) {
        calls.push_back({radius, number});
        return Picture{1.0};
    });
    REQUIRE(calls.size() == 40);
    std::set<int> numbers;
    for (int i = 0; i < 40; ++i) {
        const double radius = double(calls[static_cast<std::size_t>(i)].radius);
        CHECK(radius ==
              doctest::Approx(2 * std::sqrt(shrunk(i + 1, 0.5))).epsilon(1e-4));
        numbers.insert(calls[static_cast<std::size_t>(i)].number);
    }
    CHECK(numbers.size() == 40);
}

TEST_CASE("7.3 (2 points) every pass counts the same in the mean") {
    INFO("Expected: the sum of all pictures over their number, at each point.\n"
         "Likely: a mean that forgets old passes, or is divided by one too many.\n"
         "Read: The sums.");
    Progress progress;
    for (int i = 1; i <= 10; ++i) add_pass(progress, {double(i), 100.0, double(i * i)});
    REQUIRE(progress.mean.size() == 3);
    CHECK(progress.passes == 10);
    CHECK(progress.mean[0] == doctest::Approx(5.5));
    CHECK(progress.mean[1] == doctest::Approx(100));
    CHECK(progress.mean[2] == doctest::Approx(38.5));
}

TEST_CASE("7.4 (3 points) the standard error is that of the mean even far from 0") {
    INFO("Expected: sqrt(s/(n (n - 1))), with s the sum of (x - mean)^2.\n"
         "Likely: s/n^2, the deviation of one pass, or squares of large numbers whose "
         "difference is lost in rounding.\n"
         "Read: The sums; the chapter Progressive photons.");
    Progress progress;
    add_pass(progress, {1.0, 1e9});
    REQUIRE(standard_error(progress).size() == 2);
    CHECK(std::isinf(standard_error(progress)[0]));
    add_pass(progress, {2.0, 1e9 + 1});
    add_pass(progress, {6.0, 1e9 + 5});
    // The mean is 3, and s is 4 + 1 + 9.
    const Picture errors = standard_error(progress);
    CHECK(errors[0] == doctest::Approx(std::sqrt(14.0 / 6)));
    CHECK(errors[1] == doctest::Approx(std::sqrt(14.0 / 6)).epsilon(1e-4));
}

TEST_CASE("7.5 (2 points) a run that was interrupted goes on as if it had not been") {
    INFO("Expected: the same numbers, radii and sums as in one long run.\n"
         "Likely: passes that are counted anew in each run.\n"
         "Read: The loop.");
    const std::vector<Vec2> points{{0, 0}, {0.3f, 0.4f}};
    const Progress start{.radius = 0.4f};
    const Progress whole = passes_of(square_of_light(), points, start, 9, 100, 0);
    const Progress half = passes_of(square_of_light(), points, start, 4, 100, 0);
    const Progress both = passes_of(square_of_light(), points, half, 5, 100, 0);
    REQUIRE(whole.mean.size() == 2);
    CHECK(whole.passes == both.passes);
    CHECK(whole.radius == both.radius);
    CHECK(whole.mean == both.mean);
    CHECK(whole.squares == both.squares);
    CHECK(whole.mean[0] > 0);
}

TEST_CASE("7.6 (3 points) a pass is right on the average where light is even") {
    INFO("Expected: the irradiance 1 in the middle of the square.\n"
         "Likely: the flux divided by the photons that landed, not by all that were "
         "sent out.\n"
         "Read: A pass; the chapter Photons.");
    Mean mean;
    for (int number = 1; number <= 2000; ++number) mean.add(middle(number));
    CHECK(mean.mean() > 0);
    CHECK(mean.agrees(1));
}

TEST_CASE("7.7 (2 points) passes are independent and can be repeated") {
    INFO("Expected: other photons for another number, the same for the same.\n"
         "Likely: one stream for all passes, or one that the clock starts.\n"
         "Read: A pass.");
    CHECK(middle(3) == middle(3));
    // The mean of 20 passes has a twentieth of the variance of a pass. The variance of
    // 100 such means exceeds twice that once in ten million seeds.
    Mean one, many;
    for (int k = 0; k < 100; ++k) {
        Mean group;
        for (int i = 0; i < 20; ++i) {
            const double value = middle(1 + 20 * k + i);
            one.add(value);
            group.add(value);
        }
        many.add(group.mean());
    }
    REQUIRE(one.variance() > 1e-6); // above the rounding of equal numbers
    CHECK(20 * many.variance() < 2 * one.variance());
}

TEST_CASE("7.8 (4 points) the passes converge as fast as they should also at an edge") {
    INFO(
        "Expected: at a distance d from the edge the mean of what the discs of all "
        "passes leave of the light; on the edge always one half.\n"
        "Likely: a radius that photon_pass() does not use. If 7.1 to 7.7 pass, look at "
        "what travels from one function to the other.\n"
        "Read: What converges; the chapter Progressive photons.");
    const std::vector<double> distances{0, 0.05, 0.1, 0.3};
    std::vector<Vec2> points;
    for (const double d : distances) points.push_back({0.1f, 0.5f - float(d)});
    constexpr int passes = 100;
    std::vector<Mean> means(points.size());
    for (int k = 0; k < 40; ++k) {
        const Progress progress = passes_of(square_of_light(), points, {.radius = 0.2f},
                                            passes, 100, 1000 * (k + 1));
        REQUIRE(progress.mean.size() == points.size());
        for (std::size_t i = 0; i < points.size(); ++i) means[i].add(progress.mean[i]);
    }
    for (std::size_t i = 0; i < points.size(); ++i) {
        double expected = 0;
        for (int n = 1; n <= passes; ++n)
            expected +=
                inside(distances[i], 0.2 * std::sqrt(shrunk(n, 2.0 / 3))) / passes;
        CAPTURE(distances[i]);
        CHECK(means[i].mean() > 0);
        CHECK(means[i].agrees(expected, 1e-4));
    }
}

} // namespace course_tests
