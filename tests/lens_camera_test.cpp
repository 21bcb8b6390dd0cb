// concept: distributed_rays
// A lens against Gauss' formula. Its statistical cases were run with 20 further seeds
// (`./scripts/test --seeds 20`): none failed.
#include "ljus/scene/lens_camera.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "support/seed.hpp"
#include "support/statistics.hpp"

using namespace ljus;

namespace {

template <typename T>
LensCameraT<T> camera(T radius = T(0.2), T focus = T(5)) {
    return with_lens(look_at<T>({.position{T(1), T(2), T(3)},
                                 .target{T(0), T(1), T(-4)},
                                 .vfov_degrees = T(50)}),
                     radius, focus);
}

/// Where a ray crosses the plane at a depth.
template <typename T>
Vec3T<T> crosses(const RayT<T>& ray, const CameraT<T>& at, T depth) {
    const T t = (depth - glm::dot(ray.origin - at.position, at.forward)) /
                glm::dot(ray.direction, at.forward);
    return ray.origin + t * ray.direction;
}

} // namespace

TEST_CASE_TEMPLATE("lens: all rays of a point meet in the plane of focus", T, float,
                   double) {
    const auto lens = camera<T>();
    const T most = T(40) * std::numeric_limits<T>::epsilon();
    auto numbers = random_stream(ljus_test::test_seed(1), Pass::user, 0, 0);
    for (int i = 0; i < 200; ++i) {
        const Vec2T<T> pixel = next_2d<T>(numbers) * Vec2T<T>{T(60), T(40)};
        const auto pinhole = primary_ray(lens.pinhole, pixel, 60, 40);
        const auto ray = primary_ray(lens, pixel, 60, 40, next_2d<T>(numbers));
        CHECK(glm::distance(crosses(ray, lens.pinhole, lens.focus),
                            crosses(pinhole, lens.pinhole, lens.focus)) < most);
        CHECK(std::abs(glm::length(ray.direction) - T(1)) < most);
        // It starts in the plane of the lens, within its opening.
        const Vec3T<T> from = ray.origin - lens.pinhole.position;
        CHECK(std::abs(glm::dot(from, lens.pinhole.forward)) < most);
        CHECK(glm::length(from) <= lens.radius * T(1.00001));
        // A lens without an opening is a pinhole.
        const auto closed = primary_ray(camera<T>(T(0)), pixel, 60, 40, Vec2T<T>{T(1)});
        CHECK(closed.origin == pinhole.origin);
        CHECK(glm::distance(closed.direction, pinhole.direction) < most);
    }
}

TEST_CASE("lens: the opening is covered evenly") {
    const auto lens = camera<double>();
    auto numbers = random_stream(ljus_test::test_seed(2), Pass::user, 0, 0);
    std::vector<double> rings(8); // of the same area
    for (int i = 0; i < 8000; ++i) {
        const auto ray = primary_ray(lens, {3, 4}, 60, 40, next_2d<double>(numbers));
        const double r = glm::distance(ray.origin, lens.pinhole.position) / lens.radius;
        rings[std::min<std::size_t>(7, static_cast<std::size_t>(8 * r * r))] += 1;
    }
    CHECK(ljus_test::chi_square_agrees(rings, std::vector<double>(8, 1000), 4));
}

TEST_CASE("lens: the circle of confusion is the thin lens' 1/F = 1/s + 1/d") {
    // A real lens of focal length F stands d before the film, focused at s; a point at
    // z is sharp at d' and leaves a cone of the opening's width that the film cuts.
    for (const double focal : {0.01, 0.05, 0.3})
        for (const double s : {1.0, 5.0, 40.0})
            for (const double z : {0.6, 1.0, 4.0, 5.0, 7.0, 1000.0}) {
                const double radius = 0.07;
                const auto lens = camera<double>(radius, s);
                const double d = 1 / (1 / focal - 1 / s),
                             there = 1 / (1 / focal - 1 / z);
                const double on_film = 2 * radius * std::abs(there - d) / there;
                // The film is as high as the picture at distance d.
                const double film = 2 * lens.pinhole.half_height * d;
                CAPTURE(focal);
                CAPTURE(s);
                CAPTURE(z);
                CHECK(circle_of_confusion(lens, z, 400) ==
                      doctest::Approx(on_film / film * 400).epsilon(1e-9));
            }
    CHECK(circle_of_confusion(camera<double>(), 5.0, 400) == 0);
    const auto lens = camera<double>(0.07, 5.0); // of a star: the opening, seen 5 away
    CHECK(circle_of_confusion(lens, std::numeric_limits<double>::infinity(), 400) ==
          doctest::Approx(0.14 / (5 * 2 * lens.pinhole.half_height) * 400));
}

TEST_CASE("lens: a point out of focus is a disc of that diameter in the picture") {
    const auto lens = camera<double>(0.3, 5.0);
    const CameraT<double>& at = lens.pinhole;
    constexpr int size = 400;
    for (const double depth : {2.0, 3.5, 9.0, 100.0}) {
        const Vec3T<double> point =
            at.position + depth * (at.forward + 0.1 * at.right - 0.05 * at.up);
        // Each point of the lens sees it in the direction that crosses the plane of
        // focus where the pinhole's ray of some pixel does: project() tells which.
        auto numbers = random_stream(ljus_test::test_seed(3), Pass::user, 0, 0);
        const auto middle = project(at, point, size, size);
        REQUIRE(middle);
        double widest = 0;
        for (int i = 0; i < 4000; ++i) {
            const auto u = next_2d<double>(numbers);
            const auto on_lens = primary_ray(lens, *middle, size, size, u).origin;
            const RayT<double> sees{.origin = on_lens, .direction = point - on_lens};
            const auto pixel = project(at, crosses(sees, at, lens.focus), size, size);
            REQUIRE(pixel);
            widest = std::max(widest, 2 * glm::distance(*pixel, *middle));
            // And indeed, the lens' ray of that pixel passes through the point.
            const auto ray = primary_ray(lens, *pixel, size, size, u);
            REQUIRE(glm::distance(crosses(ray, at, depth), point) < 1e-11 * depth);
        }
        const double right = circle_of_confusion(lens, depth, size);
        CAPTURE(depth);
        CHECK(widest <= right * (1 + 1e-9));
        CHECK(widest > 0.99 * right);
    }
}

TEST_CASE("lens: one of radius 0 is the pinhole and draws no number") {
    auto drawn = random_stream(1, Pass::user, 0, 0), untouched = drawn;
    const auto pinhole = camera<float>().pinhole;
    const auto ray = camera_ray(with_lens(pinhole, 0.0f, 5.0f), {7, 9}, 60, 40, drawn);
    CHECK(ray.direction == primary_ray(pinhole, {7, 9}, 60, 40).direction);
    CHECK(ray.origin == pinhole.position);
    CHECK(next_1d<float>(drawn) == next_1d<float>(untouched));
    (void)camera_ray(with_lens(pinhole, 0.1f, 5.0f), {7, 9}, 60, 40, drawn);
    (void)next_2d<float>(untouched);
    CHECK(next_1d<float>(drawn) == next_1d<float>(untouched));
}

TEST_CASE("lens: what it refuses") {
    const auto pinhole = look_at(View{});
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, -1.0f, 5.0f),
                         "camera.radius is -1; it must be finite and at least 0.",
                         std::invalid_argument);
    CHECK_THROWS_AS((void)with_lens(pinhole, 0.1f, 0.0f), std::invalid_argument);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK_THROWS_AS((void)with_lens(pinhole, nan, 1.0f), std::invalid_argument);
    CHECK_THROWS_AS((void)with_lens(pinhole, 0.1f, nan), std::invalid_argument);
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, infinity, 5.0f),
                         "camera.radius is infinity; it must be finite and at least 0.",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS((void)with_lens(pinhole, 0.1f, infinity),
                         "camera.focus is infinity; it must be finite and above 0.",
                         std::invalid_argument);
    CHECK_NOTHROW((void)with_lens(pinhole, 0.0f, 5.0f));
}

TEST_CASE("lens: without an opening it is a pinhole; it draws two numbers") {
    const LensCamera lens;
    CHECK(lens.radius == 0);
    CHECK(lens.focus == 1);
    const auto wide = camera<double>(0.3, 4.0);
    auto numbers = random_stream(5, Pass::user, 0, 0), same = numbers;
    const auto ray = camera_ray(wide, Vec2T<double>{30, 10}, 60, 40, numbers);
    CHECK(numbers.counter == 2);
    const auto by_hand =
        primary_ray(wide, Vec2T<double>{30, 10}, 60, 40, next_2d<double>(same));
    CHECK(ray.origin == by_hand.origin);
    CHECK(ray.direction == by_hand.direction);
    // u runs along the picture's own axes: its corner is the opening's lower left.
    const auto corner =
        primary_ray(wide, Vec2T<double>{30, 10}, 60, 40, {0, 0}).origin -
        wide.pinhole.position;
    const double s = 0.3 * std::sqrt(0.5);
    CHECK(glm::dot(corner, wide.pinhole.right) == doctest::Approx(-s));
    CHECK(glm::dot(corner, wide.pinhole.up) == doctest::Approx(-s));
}
