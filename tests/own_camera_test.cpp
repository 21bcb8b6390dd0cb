/// \file own_camera_test.cpp
/// \brief The fisheye of examples/own_camera.hpp against its own definition.

#include "own_camera.hpp"

#include <doctest/doctest.h>

#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "ljus/render/render.hpp"
#include "ljus/scene/make_scene.hpp"

using namespace ljus;

TEST_CASE("own camera: the angle from the axis is in proportion to the distance") {
    const reader::Fisheye eye{.at = look_at({.position{1, 2, 3}, .target{4, 2, 3}}),
                              .field_degrees = 150};
    RandomStream stream;
    for (const float share : {0.0f, 0.25f, 0.5f, 0.99f})
        for (const float turn : {0.1f, 1.7f, 3.9f}) {
            const Vec2 pixel{160 + 100 * share * std::cos(turn),
                             100 - 100 * share * std::sin(turn)};
            const Ray ray = camera_ray(eye, pixel, 320, 200, stream);
            CHECK(ray.origin == Vec3{1, 2, 3});
            CHECK(glm::length(ray.direction) == doctest::Approx(1));
            const double angle = std::acos(
                std::min(1.0, double(glm::dot(ray.direction, eye.at.forward))));
            const double right = double(share) * 75 * std::numbers::pi / 180;
            CHECK(angle == doctest::Approx(right).epsilon(1e-3));
            if (share > 0) { // and it goes where the picture shows it
                CHECK(glm::dot(ray.direction, eye.at.right) ==
                      doctest::Approx(std::sin(right) * std::cos(double(turn))));
                CHECK(glm::dot(ray.direction, eye.at.up) ==
                      doctest::Approx(std::sin(right) * std::sin(double(turn))));
            }
        }
    CHECK(stream.counter == 0); // nothing is left to chance
}

TEST_CASE(
    "own camera: the share of a hemisphere that a lamp fills is that of the disc") {
    // A cap of 30 degrees around the axis fills a third of the radius of 90 degrees.
    const World world(make_scene(placed(Sphere{.center{0, 0, -10}, .radius = 5},
                                        Lambertian{.albedo = Rgb{0}}, Rgb{1})));
    const reader::Fisheye eye{.at = look_at({.position{0, 0, 0}, .target{0, 0, -1}})};
    const auto image = render(PathTracer(world), eye,
                              {.width = 90, .height = 90, .samples = 64, .threads = 1})
                           .image;
    double lit = 0;
    for (const Rgb& color : image.pixels) lit += double(color.x);
    // pi 15^2 pixels; strata leave an error well below one pixel of 706.
    CHECK(lit == doctest::Approx(std::numbers::pi * 15 * 15).epsilon(0.003));
    CHECK(pixel(image, 0, 0) == Rgb{0}); // beside the disc
}
