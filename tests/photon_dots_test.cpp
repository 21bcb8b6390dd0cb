/// \file photon_dots_test.cpp
/// \brief Which photons a camera sees, against rectangles and balls worked out by hand.

#include "ljus/inspect/photon_dots.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>

#include "support/rooms.hpp"
#include "support/within.hpp"

using namespace ljus;
using namespace ljus_test;

namespace {

/// A camera at (0, 0, 5) that looks along -z at a picture whose half is 5 at z = 0.
Camera front() {
    return look_at({.position{0, 0, 5}, .target{0, 0, 0}, .vfov_degrees = 90});
}

Photon photon_at(Vec3 position, Vec3 direction, PhotonKind kind = PhotonKind::direct) {
    return {.position = position,
            .direction = glm::normalize(direction),
            .flux{1, 2, 4},
            .kind = kind};
}

double sum_of(const Image& image) {
    double sum = 0;
    for (const Rgb& color : image.pixels) sum += double(color.x + color.y + color.z);
    return sum;
}

/// A wall [-2, 2]^2 at z = 0, its normal towards the camera or away from it.
BallRoom wall(bool towards) {
    BallRoom room;
    const Vec3 x{4, 0, 0}, y{0, 4, 0};
    room.add(
        Quad{.corner{-2, -2, 0}, .edge_u = towards ? x : y, .edge_v = towards ? y : x},
        room.add(Lambertian{.albedo = Rgb{0.5f}}));
    return room;
}

} // namespace

TEST_CASE("photon dots: a photon is seen on the side that it has come to, wherever the "
          "normal points") {
    for (const bool towards : {true, false}) {
        const ClosedRoom room(wall(towards));
        CAPTURE(towards);
        const auto lit =
            photon_in_sight(room, front(), photon_at({1, 1, 0}, {0, 1, -1}), 100, 100);
        REQUIRE(lit);
        CHECK(glm::distance(*lit, Vec2{60, 40}) < 1e-3f);
        CHECK_FALSE(
            photon_in_sight(room, front(), photon_at({1, 1, 0}, {0, 1, 1}), 100, 100));
        CHECK_FALSE(photon_in_sight(room, front(), photon_at({9, 1, 0}, {0, 1, -1}),
                                    100,
                                    100)); // out of the picture
    }
}

TEST_CASE("photon dots: what stands in front hides a photon, glass too") {
    for (const Ball ball : {Ball::lambertian, Ball::glass}) {
        BallRoom room = wall(true);
        room.add(Sphere{.center{0.5f, 0.5f, 2.5f}, .radius = 0.1f},
                 ball == Ball::glass ? room.add(Glass{})
                                     : room.add(Lambertian{.albedo = Rgb{0.5f}}));
        const World world(std::move(room));
        // The line to (1, 1, 0) goes through the ball's middle.
        CHECK_FALSE(photon_in_sight(world, front(), photon_at({1, 1, 0}, {0, 0, -1}),
                                    100, 100));
        CHECK(photon_in_sight(world, front(), photon_at({-1, 1, 0}, {0, 0, -1}), 100,
                              100));
        // On the ball: its near half, from outside.
        const Vec3 near{0.5f, 0.5f, 2.6f}, far{0.5f, 0.5f, 2.4f};
        CHECK(photon_in_sight(world, front(), photon_at(near, {0, 0, -1}), 100, 100));
        CHECK_FALSE(
            photon_in_sight(world, front(), photon_at(near, {0, 0, 1}), 100, 100));
        CHECK_FALSE(
            photon_in_sight(world, front(), photon_at(far, {0, 0, -1}), 100, 100));
    }
}

TEST_CASE("photon dots: of a room's photons those are seen that a ray finds") {
    // Independent: the photons of the wall that a camera inside of the room looks at.
    const ClosedRoom room = make_room<float>(Ball::mirror, Lamp::point, 1);
    std::vector<Photon> photons;
    int in_picture = 0;
    for (int i = 0; i < 40; ++i)
        for (int j = 0; j < 40; ++j) {
            const float x = float(i) / 20 - 0.97f, y = float(j) / 20 - 0.97f;
            photons.push_back(photon_at({x, y, -1}, {0, 0, -1}));
            // From (0, 0.25, 0.97) the ball (0.1, -0.4, -0.1) 0.45 hides a part of it.
            const glm::dvec3 eye{0, 0.25, 0.97}, way = glm::dvec3{x, y, -1} - eye;
            const glm::dvec3 ball = glm::dvec3{0.1, -0.4, -0.1} - eye;
            const double along = glm::dot(ball, way) / glm::dot(way, way);
            const bool hidden = glm::distance(ball, along * way) < 0.45;
            const CameraT<float> camera = room_camera<float>();
            const glm::dvec3 f(camera.forward), r(camera.right), u(camera.up);
            const double reach = double(camera.half_height) * glm::dot(way, f);
            const bool inside = std::abs(glm::dot(way, r)) < reach &&
                                std::abs(glm::dot(way, u)) < reach;
            in_picture += inside && !hidden ? 1 : 0;
        }
    Image image = make_image(100, 100);
    const long long seen =
        add_photon_dots(image, room, room_camera<float>(), photons, {},
                        [](const Photon& photon) { return dot_color(photon); });
    CHECK(seen == in_picture);
    CHECK(in_picture > 300);
    CHECK(in_picture < 1500);
}

TEST_CASE("photon dots: a dot is a cone, and black ones are not drawn") {
    const ClosedRoom room(wall(true));
    const auto drawn = [&](float x, float y, const PhotonDotSettings& look) {
        Image image = make_image(40, 40);
        CHECK(add_photon_dots(image, room, front(), {photon_at({x, y, 0}, {0, 0, -1})},
                              look, [](const Photon& p) { return dot_color(p); }) == 1);
        return image;
    };
    // 1/8 of a unit is half a pixel: the middle of pixel (20, 19).
    const Image one = drawn(0.125f, 0.125f, {.radius = 1, .brightness = 0.5f});
    CHECK(glm::distance(pixel(one, 20, 19), 0.5f * Rgb{0.25f, 0.5f, 1}) < 1e-3f);
    CHECK(sum_of(one) == doctest::Approx(0.5 * 1.75).epsilon(1e-3));
    // The volume of a cone: a third of its foot.
    const Image wide = drawn(0.03f, -0.2f, {.radius = 12, .brightness = 1});
    CHECK(sum_of(wide) ==
          doctest::Approx(1.75 * std::numbers::pi * 144 / 3).epsilon(0.01));
    // At the border the rest falls off the picture.
    CHECK(sum_of(drawn(1.99f, 1.99f, {.radius = 30, .brightness = 1})) > 100);

    Image image = make_image(40, 40);
    const std::vector<Photon> photons{photon_at({0, 0, 0}, {0, 0, -1})};
    const auto none = [](const Photon&) { return Rgb{0}; };
    CHECK(add_photon_dots(image, room, front(), photons, {}, none) == 0);
    CHECK(sum_of(image) == 0);
    CHECK(add_photon_dots(image, room, front(), {}, {}, none) == 0);
    for (const float radius :
         {0.f, -1.f, 1001.f, std::numeric_limits<float>::quiet_NaN()})
        CHECK_THROWS_AS(
            add_photon_dots(image, room, front(), photons, {.radius = radius}, none),
            std::invalid_argument);
}

TEST_CASE("photon dots: the colour is that of the flux, shadow photons are yellow") {
    CHECK(dot_color(photon_at({}, {0, 0, 1})) == Rgb{0.25f, 0.5f, 1});
    CHECK(dot_color(photon_at({}, {0, 0, 1}, PhotonKind::shadow)) ==
          Rgb{1, 0.8f, 0.1f});
    CHECK(dot_color(Photon{}) == Rgb{0});
}

TEST_CASE("photon dots: the drawing shows each surface in its colour, lamps bright") {
    BallRoom room = wall(true);
    const auto black = room.add(Lambertian{.albedo = Rgb{0}});
    const auto lamp = [](float x, bool towards) {
        const Vec3 a{1, 0, 0}, b{0, 1, 0};
        return Quad{
            .corner{x, 0.5f, 1}, .edge_u = towards ? a : b, .edge_v = towards ? b : a};
    };
    room.add(lamp(0.5f, true), black, Rgb{9});
    room.add(lamp(-1.5f, false), black, Rgb{9});
    const World world(std::move(room)); // from behind it is dark
    const Image image = scene_drawing(world, front(), 100, 100);
    CHECK(pixel(image, 50, 50).x == ljus_test::within(0.08, 0.01));
    CHECK(pixel(image, 62, 37) == Rgb{0.5f});
    CHECK(pixel(image, 37, 37) == Rgb{0});
    CHECK(pixel(image, 2, 2) == Rgb{0}); // nothing there
    // Each pixel by the ray through its middle.
    const ClosedRoom slope(wall(true));
    const Image small = scene_drawing(slope, front(), 11, 9);
    for (int y = 0; y < 9; ++y)
        for (int x = 0; x < 11; ++x) {
            const Vec2 middle{float(x) + 0.5f, float(y) + 0.5f};
            const Ray ray = primary_ray(front(), middle, 11, 9);
            const auto hit = closest_hit(slope, ray);
            REQUIRE((pixel(small, x, y).x > 0) == hit.has_value());
            if (!hit) continue;
            const double cosine = std::abs(glm::normalize(ray.direction).z);
            CHECK(pixel(small, x, y).x ==
                  ljus_test::within(0.16 * (0.3 + 0.7 * cosine) * 0.5, 1e-5));
        }
    CHECK_THROWS_AS((void)scene_drawing(world, front(), 0, 5), std::invalid_argument);
}

TEST_CASE("photon dots: in the corners of a picture too, and just outside of none") {
    // A wall as large as the picture: its corners are those of the picture.
    BallRoom room;
    room.add(Quad{.corner{-50, -50, 0}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    const World world(std::move(room));
    const Image drawn = scene_drawing(world, front(), 40, 30);
    for (const Rgb& color : drawn.pixels) CHECK(max_component(color) > 0);
    const auto seen = [&](float x, float y) {
        const auto ray = primary_ray(front(), Vec2{x, y}, 100, 100);
        const auto hit = closest_hit(world, ray);
        REQUIRE(hit);
        const Vec3 place = ray.origin + hit->at.t * ray.direction;
        return photon_in_sight(world, front(), photon_at(place, {0, 0, -1}), 100, 100)
            .has_value();
    };
    for (const float near : {0.1f, 50.0f, 99.9f})
        for (const float also : {0.1f, 50.0f, 99.9f}) CHECK(seen(near, also));
    for (const float out : {-0.1f, 100.1f}) {
        CHECK_FALSE(seen(out, 50));
        CHECK_FALSE(seen(50, out));
    }
    // A dot in each corner reaches the corner's pixel.
    for (const float x : {0.5f, 7.5f})
        for (const float y : {0.5f, 5.5f}) {
            Image image = make_image(8, 6);
            detail::add_dot(image, Vec2{x, y}, Rgb{1}, {.radius = 2});
            CHECK(pixel(image, int(x), int(y)).x > 0);
            int lit = 0;
            for (const Rgb& color : image.pixels) lit += color.x > 0;
            CHECK(lit == 4); // itself and its three neighbours
        }
}

TEST_CASE("photon dots: in pictures that are wider than high, and higher than wide") {
    BallRoom room;
    room.add(Quad{.corner{-50, -50, 0}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    const World world(std::move(room));
    const auto seen = [&](Vec3 position, int width, int height) {
        return photon_in_sight(world, front(), photon_at(position, {0, 0, -1}), width,
                               height);
    };
    for (const auto& size : {std::pair{100, 60}, {60, 100}}) {
        const int width = size.first;
        const int height = size.second;
        // Five units of the wall are half of the picture's height.
        const float per_unit = float(height) / 10;
        for (const float x : {-0.5f, 0.5f})
            for (const float y : {-0.5f, 0.5f})
                for (const float side : {0.98f, 1.02f}) {
                    CAPTURE(width);
                    CAPTURE(x);
                    CAPTURE(y);
                    CAPTURE(side);
                    // In the last column or just beyond it, then the last row.
                    const Vec2 across{x * side * float(width), 0.3f * float(height)};
                    const Vec2 along{0.3f * float(width), y * side * float(height)};
                    for (const Vec2 at : {across, along}) {
                        const auto place =
                            seen({at.x / per_unit, at.y / per_unit, 0}, width, height);
                        CHECK(place.has_value() == (side < 1));
                        if (place)
                            CHECK(glm::distance(
                                      *place, Vec2{float(width) / 2 + at.x,
                                                   float(height) / 2 - at.y}) < 1e-3f);
                    }
                }
    }
}

TEST_CASE("photon dots: the drawing darkens by the cosine, as it says") {
    // 0.16 (0.3 + 0.7 cos) times the albedo, away from the middle of the picture.
    const ClosedRoom room(wall(true));
    const Image image = scene_drawing(room, front(), 100, 100);
    for (const int x : {50, 60, 68}) {
        const auto ray = primary_ray(front(), Vec2{float(x) + 0.5f, 50.5f}, 100, 100);
        const double cosine = -double(ray.direction.z);
        CHECK(pixel(image, x, 50).x ==
              ljus_test::within(0.16 * (0.3 + 0.7 * cosine) * 0.5, 1e-4));
    }
    // A faint photon is as bright as a strong one.
    Photon faint = photon_at({}, {0, 0, 1});
    faint.flux *= 1e-6f;
    CHECK(glm::distance(dot_color(faint), Rgb{0.25f, 0.5f, 1}) < 1e-6f);
}

TEST_CASE("photon dots: two at one place add up, and the picture ends at its size") {
    BallRoom room;
    room.add(Quad{.corner{-50, -50, 0}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}},
             room.add(Lambertian{.albedo = Rgb{0.5f}}));
    const World world(std::move(room));
    const Photon photon = photon_at({0.125f, 0.125f, 0}, {0, 0, -1});
    Image image = make_image(40, 40, Rgb{0.5f});
    CHECK(add_photon_dots(image, world, front(), {photon, photon},
                          {.radius = 1, .brightness = 0.5f},
                          [](const Photon& p) { return dot_color(p); }) == 2);
    CHECK(glm::distance(pixel(image, 20, 19), Rgb{0.75f, 1, 1.5f}) < 1e-3f);
    // Ten pixels a unit from the middle (50, 50): the first column and row count, those
    // behind the last do not.
    const auto seen = [&](float x, float y) {
        return photon_in_sight(world, front(), photon_at({x, y, 0}, {0, 0, -1}), 100,
                               100)
            .has_value();
    };
    CHECK(project(front(), Vec3{5, 5, 0}, 100, 100) == Vec2{100, 0});
    CHECK(seen(-5, 0));
    CHECK(seen(0, 5));
    CHECK_FALSE(seen(5, 0));
    CHECK_FALSE(seen(0, -5));
    CHECK(
        seen(std::nextafter(5.0f, 0.0f), 0) ==
        (project(front(), Vec3{std::nextafter(5.0f, 0.0f), 0, 0}, 100, 100)->x < 100));
}

TEST_CASE("photon dots: what mirrors or refracts is drawn grey") {
    for (const Ball ball : {Ball::mirror, Ball::glass, Ball::mixture}) {
        BallRoom room;
        const Quad all{.corner{-50, -50, 0}, .edge_u{100, 0, 0}, .edge_v{0, 100, 0}};
        if (ball == Ball::mirror)
            room.add(all, room.add(Mirror{.reflectance{1, 0, 0}}));
        if (ball == Ball::glass) room.add(all, room.add(Glass{}));
        if (ball == Ball::mixture)
            room.add(all, room.add(Mixture{.color{1, 0, 0}, .reflectivity = 0.5f}));
        const World world(std::move(room));
        const Image image = scene_drawing(world, front(), 11, 11);
        const Rgb& middle = pixel(image, 5, 5); // seen straight on
        for (const float channel : {middle.x, middle.y, middle.z})
            CHECK(channel == ljus_test::within(0.16 * 0.25, 1e-5));
    }
}
