/// \file camera_test.cpp
/// \brief The pinhole camera: where things appear in the picture, and bad views.

#include "ljus/scene/camera.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "support/numbers.hpp"
#include "support/refusal.hpp"

using namespace ljus;
using ljus_test::Numbers;

namespace {

/// Where a point appears, by projecting it: the other way round than primary_ray().
glm::dvec2 projected(const ViewT<double>& view, const glm::dvec3& p, int width,
                     int height) {
    const glm::dvec3 d = glm::normalize(view.target - view.position);
    const glm::dvec3 r = glm::normalize(glm::cross(d, view.up));
    const glm::dvec3 u = glm::cross(r, d);
    const glm::dvec3 way = p - view.position;
    const double t = std::tan(view.vfov_degrees * std::numbers::pi / 360);
    const double depth = glm::dot(way, d);
    const double x = glm::dot(way, r) / (depth * t * width / height);
    const double y = glm::dot(way, u) / (depth * t);
    return {(x + 1) * width / 2, (1 - y) * height / 2};
}

/// How far the ray through a pixel passes from a point.
template <typename T>
double missed_by(const ViewT<T>& view, const glm::dvec2& pixel, int size,
                 const glm::dvec3& point) {
    const RayT<T> ray = primary_ray(look_at(view), Vec2T<T>(pixel), size, size);
    const glm::dvec3 way = point - glm::dvec3(ray.origin);
    const glm::dvec3 d(ray.direction);
    return glm::length(way - glm::dot(way, d) / glm::dot(d, d) * d);
}

std::string refusal(const View& view) {
    return ljus_test::refusal([&] { (void)look_at(view); });
}

} // namespace

TEST_CASE("camera: two Cornell boxes show their balls where others see them") {
    // Check values from another program; pictures of 200 x 200.
    const ViewT<double> mirror_glass{
        .position{0, 1, 2.8}, .target{0, 0.9, -1}, .vfov_degrees = 50};
    const ViewT<double> caustic{
        .position{0, 1.3, 2.8}, .target{0.1, 0.25, 0}, .vfov_degrees = 36};
    struct Seen {
        ViewT<double> view;
        glm::dvec3 center;
        glm::dvec2 pixel;
    };
    for (const auto& [view, center, pixel] :
         {Seen{mirror_glass, {-0.45, 0.42, -0.4}, {69.976, 133.068}},
          Seen{mirror_glass, {0.45, 0.42, 0.3}, {138.380, 143.841}},
          Seen{caustic, {0, 0.5, 0}, {89.398, 75.297}}}) {
        CHECK(glm::distance(projected(view, center, 200, 200), pixel) < 1e-3);
        CHECK(missed_by(view, pixel, 200, center) < 2e-5); // a thousandth of a pixel
        const ViewT<float> in_float{Vec3(view.position), Vec3(view.target),
                                    Vec3(view.up), float(view.vfov_degrees)};
        const Ray ray = primary_ray(look_at(in_float), Vec2(pixel), 200, 200);
        const glm::dvec3 way = center - glm::dvec3(ray.origin), d(ray.direction);
        CHECK(glm::length(way - glm::dot(way, d) * d) < 2e-5);
    }
}

TEST_CASE("camera: the picture's middle, borders and corners") {
    const Camera camera = look_at({.vfov_degrees = 90}); // from 0 along -z
    CHECK(camera.half_height == doctest::Approx(1));
    const auto through = [&](float x, float y) {
        const Ray ray = primary_ray(camera, Vec2{x, y}, 200, 100);
        return ray.direction / -ray.direction.z;
    };
    const auto near = [](const Vec3& a, const Vec3& b) {
        return glm::distance(a, b) < 1e-6f;
    };
    CHECK(near(through(100, 50), {0, 0, -1}));
    CHECK(near(through(100, 0), {0, 1, -1})); // y counts from the top
    CHECK(near(through(100, 100), {0, -1, -1}));
    CHECK(near(through(0, 50), {-2, 0, -1})); // x from the left; twice as wide
    CHECK(near(through(200, 0), {2, 1, -1}));
    CHECK(near(through(150, 75), {1, -0.5f, -1})); // pixels are square
}

TEST_CASE_TEMPLATE("camera: what a ray meets is projected back to its pixel", T, float,
                   double) {
    Numbers n;
    for (int i = 0; i < 5000; ++i) {
        ViewT<T> view{.position = Vec3T<T>(n.point(9)),
                      .target = Vec3T<T>(n.point(9)),
                      .up = Vec3T<T>(n.power(-3, 3) * n.direction()),
                      .vfov_degrees = T(n.between(1, 150))};
        const glm::dvec3 way(view.target - view.position);
        if (glm::length(way) < 0.1 ||
            glm::length(glm::cross(glm::normalize(way),
                                   glm::normalize(glm::dvec3(view.up)))) < 0.01)
            continue;
        const CameraT<T> camera = look_at(view);
        const int width = 1 + n.below(500), height = 1 + n.below(500);
        const glm::dvec2 pixel{n.next() * width, n.next() * height};
        const RayT<T> ray = primary_ray(camera, Vec2T<T>(pixel), width, height);
        REQUIRE(ray.origin == view.position);
        REQUIRE(double(glm::length(ray.direction)) == doctest::Approx(1).epsilon(1e-6));
        const ViewT<double> wide{glm::dvec3(view.position), glm::dvec3(view.target),
                                 glm::dvec3(view.up), double(view.vfov_degrees)};
        const glm::dvec3 point =
            glm::dvec3(ray.origin) + n.power(0, 2) * glm::dvec3(ray.direction);
        const glm::dvec2 back = projected(wide, point, width, height);
        // Wide angles magnify the rounding of the direction at the border.
        const double allowed = (sizeof(T) == 4 ? 1e-4 : 1e-11) * (width + height);
        REQUIRE(glm::distance(back, pixel) < allowed);
        const auto place = project(camera, Vec3T<T>(point), width, height);
        REQUIRE(place);
        REQUIRE(glm::distance(glm::dvec2(*place), back) < 10 * allowed);

        // Its axes are orthonormal and right-handed; up is on the side of view.up.
        REQUIRE(double(glm::dot(camera.right, camera.up)) ==
                doctest::Approx(0).epsilon(1e-5));
        REQUIRE(double(glm::length(camera.up)) == doctest::Approx(1).epsilon(1e-6));
        REQUIRE(double(glm::dot(glm::cross(camera.right, camera.up), camera.forward)) <
                -0.9999);
        REQUIRE(glm::dot(camera.up, view.up) > 0);
    }
}

TEST_CASE("camera: the length of up and the distance of the target do not matter") {
    const View view{.position{1, 2, 3}, .target{0, 1, -2}, .vfov_degrees = 40};
    const Camera one = look_at(view);
    for (const float length : {1e-15f, 1e-6f, 1e6f, 1e15f}) {
        View other = view;
        other.up *= length;
        CHECK(glm::distance(look_at(other).up, one.up) < 1e-6f);
    }
    for (const float far : {1e-15f, 1e-6f, 1e6f, 1e25f}) {
        const Camera there = look_at({.target{far, far, -far}});
        CHECK(glm::distance(there.forward, Vec3{1, 1, -1} / std::sqrt(3.0f)) < 1e-6f);
    }
}

TEST_CASE("camera: angles up to nearly 180 degrees") {
    for (const float angle : {1e-4f, 1.0f, 90.0f, 179.0f, 179.99f, 179.9999f,
                              std::nextafter(180.0f, 0.0f)}) {
        CAPTURE(angle);
        const Camera camera = look_at({.vfov_degrees = angle});
        CHECK(camera.half_height > 0);
        CHECK(double(camera.half_height) ==
              doctest::Approx(std::tan(double(angle) * std::numbers::pi / 360))
                  .epsilon(1e-6));
        const Vec3 up = primary_ray(camera, Vec2{50, 0}, 100, 100).direction;
        CHECK(up.y > 0);
        CHECK(up.z < 0);
    }
}

TEST_CASE("camera: a view that shows nothing is refused with a sentence") {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    const auto starts = [](const std::string& text, const char* with) {
        return text.find(with) == 0 && text.back() == '.';
    };
    CHECK(refusal({}) == "");
    CHECK(
        starts(refusal({.position{nan, 0, 0}}), "camera.position is (NaN, 0, 0); it"));
    CHECK(starts(refusal({.target{0, infinity, 0}}), "camera.target is (0, infinity,"));
    CHECK(starts(refusal({.up{0, 0, nan}}), "camera.up is (0, 0, NaN); it must be"));
    CHECK(refusal({.position{1, 2, 3}, .target{1, 2, 3}}) ==
          "camera.target is (1, 2, 3); it must be another point than camera.position.");
    for (const Vec3 up : {Vec3{0}, Vec3{0, 0, 1}, Vec3{0, 0, -5}, Vec3{0, 0, 1e-20f},
                          Vec3{0, 0, 1e20f}, Vec3{1e-9f, 0, 1}})
        CHECK(starts(refusal({.up = up}), "camera.up is ("));
    // Also along a slanted view.
    CHECK(starts(refusal({.target{0.1f, 0.7f, -0.3f}, .up{0.1f, 0.7f, -0.3f}}),
                 "camera.up is (0.1, 0.7, -0.3); it must be a direction that is not"));
    for (const float angle : {0.0f, -1.0f, 180.0f, 360.0f, nan, infinity, -infinity})
        CHECK(starts(refusal({.vfov_degrees = angle}), "camera.vfov_degrees is "));
    CHECK(refusal({.vfov_degrees = -1}) ==
          "camera.vfov_degrees is -1; it must be above 0 and below 180.");
}

TEST_CASE("camera: what lies beside or behind the camera has no place in the picture") {
    const Camera camera = look_at({.position{1, 2, 3}, .target{1, 2, -7}});
    CHECK(project(camera, Vec3{1, 2, 2}, 200, 100) == Vec2{100, 50});
    CHECK_FALSE(project(camera, Vec3{1, 2, 4}, 200, 100));
    CHECK_FALSE(project(camera, Vec3{1, 2, 3}, 200, 100)); // the pinhole itself
    CHECK_FALSE(project(camera, Vec3{7, 2, 3}, 200, 100));
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const float infinity = std::numeric_limits<float>::infinity();
    CHECK_FALSE(project(camera, Vec3{nan, 2, 2}, 200, 100));
    CHECK_FALSE(project(camera, Vec3{1, 2, -infinity}, 200, 100));
    // Out of float's range.
    CHECK_FALSE(project(camera, Vec3{1e38f, 2, 2.9f}, 200, 100));
    CHECK_FALSE(project(camera, Vec3{1, 1e38f, 2.9f}, 200, 100));
}

TEST_CASE("camera: without more said it looks along -z, upright") {
    const Camera camera;
    CHECK(camera.position == Vec3{0});
    CHECK(camera.right == Vec3{1, 0, 0});
    CHECK(camera.up == Vec3{0, 1, 0});
    CHECK(camera.forward == Vec3{0, 0, -1});
    CHECK(camera.half_height == 1);
    const View view;
    CHECK(view.position == Vec3{0});
    CHECK(view.target == Vec3{0, 0, -1});
    CHECK(view.up == Vec3{0, 1, 0});
    CHECK(view.vfov_degrees == 45);
    // A pinhole leaves nothing to chance, and draws no number.
    RandomStream drawn;
    CHECK(camera_ray(camera, Vec2{3, 4}, 10, 20, drawn).direction ==
          primary_ray(camera, Vec2{3, 4}, 10, 20).direction);
    CHECK(drawn.counter == 0);
    CHECK(camera_ray(camera, Vec2{3, 4}, 10, 20, drawn).t_min == 0);
}
