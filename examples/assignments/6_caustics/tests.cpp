// Assignment 6: each test is a sentence that must hold. Its name states its points.
// Means are compared with closed forms and with a fan of rays within five standard
// errors: a right answer fails a check once in 1.7 million seeds, and the seeds are
// fixed. Any right estimator will do.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;
using course::Mean;

namespace {

constexpr double pi = std::numbers::pi;

/// A lamp 4 above the centre of a glass ball that hangs above a floor, which lies
/// `drop` below the ball's centre.
Room lens(float drop, bool closed = false) {
    Room room{.objects{{Sphere{{0, 0, 0}, 1}, {.kind = Kind::glass}},
                       {ljus::Quad{{-50, -50, -drop}, {100, 0, 0}, {0, 100, 0}}, {}}},
              .lamps{{{0, 0, 4}, Rgb{1}}}};
    if (closed) room.objects[1] = {Sphere{{0, 0, 0}, 20}, {}};
    return room;
}
const Sphere ball{{0, 0, 0}, 1};

/// A ray of the lamp at the angle theta that passes through the ball without
/// reflection: its distance from the axis on the floor, and the fraction T^2 of its
/// light. It is computed in the plane, by angles only.
struct Fan {
    double radius = 0, share = 0;
};
Fan through(double theta, double drop) {
    const double sine = 4 * std::sin(theta); // angle of incidence
    const double in = std::asin(sine), behind = std::asin(sine / 1.5);
    const double s = std::sin(in - behind) / std::sin(in + behind);
    const double p = std::tan(in - behind) / std::tan(in + behind);
    const double back = (s * s + p * p) / 2;
    // The ray enters at the polar angle in - theta, crosses the ball over the central
    // angle pi - 2 behind, and is turned towards the axis by 2 (in - behind) in total.
    const double leaves = in - theta + pi - 2 * behind;
    const double out = theta - 2 * (in - behind); // angle with the axis; below 0:
                                                  // towards it
    const double x = std::sin(leaves), z = std::cos(leaves);
    const double way = (drop + z) / std::cos(out);
    return {std::abs(x + way * std::sin(out)), (1 - back) * (1 - back)};
}

} // namespace

TEST_CASE("6.1 (2 points) each light path has the owner that the table says") {
    INFO("Expected: L S+ D S* E.\n"
         "Likely: one S only, a second D, or no S after the diffuse surface.\n"
         "Read: Which paths; the chapter Two passes.");
    for (const char* path : {"LSDE", "LSSDE", "LSSSSDE", "LSDSE", "LSSDSSE"}) {
        CAPTURE(path);
        CHECK(belongs_to_caustics_map(path));
    }
    for (const char* path :
         {"LE", "LDE", "LSE", "LDSE", "LDDE", "LSDDE", "LDSDE", "LSDSDE", "LSSE"}) {
        CAPTURE(path);
        CHECK_FALSE(belongs_to_caustics_map(path));
    }
}

TEST_CASE("6.2 (2 points) the flux towards a ball is that of its cone") {
    INFO("Expected: 2 pi (1 - cos) I.\n"
         "Likely: the whole lamp's 4 pi I, pi (R/d)^2 for a near ball, or 1 - cos "
         "in floats for a far one.\n"
         "Read: Aiming; the chapter Photons.");
    // A lamp at sqrt(2) radii sees the ball under 45 degrees.
    const PointLamp near{{0, std::sqrt(2.0f), 0}, Rgb{1, 2, 3}};
    const double cone = 2 * pi * (1 - std::sqrt(0.5));
    CHECK(flux_towards(near, ball).x == doctest::Approx(cone).epsilon(1e-4));
    CHECK(flux_towards(near, ball).z == doctest::Approx(3 * cone).epsilon(1e-4));
    // For a far lamp 1 - cos loses its digits; the solid angle is pi (R/d)^2.
    const PointLamp far{{0, 0, 2000}, Rgb{1}};
    CHECK(flux_towards(far, ball).x * 4e6 / pi == doctest::Approx(1).epsilon(0.01));
}

TEST_CASE("6.3 (3 points) aimed photons meet the ball and are even in solid angle") {
    INFO("Expected: directions in the cone, 1 - cos uniform, flux over count.\n"
         "Likely: even in the angle or over a disc, or an axis whose length is not "
         "1.\n"
         "Read: Aiming.");
    for (const Vec3& from : {Vec3{3, -1, 2}, {0.6f, -0.9f, 0.5f}}) { // far and near
        const PointLamp lamp{from, Rgb{5}};
        auto stream = course::stream(31);
        const double cosine = std::sqrt(1 - 1 / double(dot(from, from)));
        const Vec3 axis = normalize(-from);
        constexpr int count = 20000;
        Mean height, side;
        double flux = 0;
        int met = 0;
        for (int i = 0; i < count; ++i) {
            const Flight flight = aim(lamp, ball, count, ljus::next_2d(stream));
            REQUIRE(length(flight.ray.direction) == doctest::Approx(1).epsilon(1e-4));
            REQUIRE(flight.ray.origin == lamp.position);
            met += intersect(flight.ray, ball).has_value();
            height.add((1 - double(dot(flight.ray.direction, axis))) / (1 - cosine));
            side.add(double(dot(flight.ray.direction, cross(axis, Vec3{0, 0, 1}))));
            flux += double(flight.flux.x);
        }
        CAPTURE(cosine);
        CHECK(met >= count - 20); // at the rim rounding decides
        CHECK(height.agrees(0.5, 1e-3));
        CHECK(side.agrees(0));
        CHECK(flux == doctest::Approx(5 * 2 * pi * (1 - cosine)).epsilon(1e-3));
    }
}

TEST_CASE("6.4 (2 points) only photons that met glass or a mirror arrive") {
    INFO("Expected: nothing for L D, the mirror's colour once for L S D, and "
         "nothing after more than 20 mirrors.\n"
         "Read: Following; the chapter Caustics.");
    Room room = lens(2);
    auto stream = course::stream(32);
    const Flight beside{{.origin{3, 0, 4}, .direction{0, 0, -1}}, Rgb{1}};
    CHECK_FALSE(follow(room, beside, stream)); // L D
    const Flight away{{.origin{3, 0, 4}, .direction{0, 0, 1}}, Rgb{1}};
    CHECK_FALSE(follow(room, away, stream)); // meets nothing
    room.objects[0].matter = {Kind::mirror, Rgb{0.5f}};
    const float h = std::sqrt(0.5f);
    room.objects.push_back({ljus::Quad{{5, -5, -5}, {0, 10, 0}, {0, 0, 10}}, {}});
    const Flight turned{{.origin{h, 0, 4}, .direction{0, 0, -1}}, Rgb{1}};
    const auto photon = follow(room, turned, stream);
    REQUIRE(photon);
    CHECK(distance(photon->position, Vec3{5, 0, h}) < 1e-4f);
    CHECK(distance(photon->direction, Vec3{1, 0, 0}) < 1e-5f);
    CHECK(photon->flux.x == doctest::Approx(0.5));
    // A photon flies down between two mirrors, and meets them at the depths 0.5, 1.5,
    // 2.5, ...
    for (const int mirrors : {20, 21}) {
        const float drop = float(mirrors);
        const Room shaft{.objects{
            {ljus::Quad{{0, -1, 1}, {0, 2, 0}, {0, 0, -99}}, {Kind::mirror, Rgb{1}}},
            {ljus::Quad{{1, -1, 1}, {0, 2, 0}, {0, 0, -99}}, {Kind::mirror, Rgb{1}}},
            {ljus::Quad{{-9, -9, -drop}, {18, 0, 0}, {0, 18, 0}}, {}}}};
        const Vec3 way = normalize(Vec3{1, 0, -1});
        const auto down = follow(shaft, {{{0.5f, 0, 0}, way}, Rgb{1}}, stream);
        CAPTURE(mirrors);
        CHECK(down.has_value() == (mirrors == 20));
    }
}

TEST_CASE("6.5 (3 points) a ball of glass has its focus at 3/2 radii") {
    INFO("Expected: rays near the axis meet at n R/(2 (n - 1)), for this glass's n.\n"
         "Likely: n_1 and n_2 swapped, or 1.5 for every glass.\n"
         "Read: A check by geometry.");
    // Parallel rays near the axis of a ball with n = 1.5 meet at n R / (2 (n - 1)).
    for (const float index : {1.5f, 1.8f}) {
        Room room = lens(index / (2 * (index - 1)));
        room.objects[0].matter.index = index;
        auto stream = course::stream(33);
        int arrived = 0;
        for (int i = 0; i < 400; ++i) {
            const float angle = 2 * float(pi) * next_1d(stream);
            const Vec3 from{0.05f * std::cos(angle), 0.05f * std::sin(angle), 4};
            const auto photon = follow(room, {{from, {0, 0, -1}}, Rgb{1}}, stream);
            // A few photons are reflected inside, and arrive elsewhere or nowhere.
            if (photon && length(ljus::Vec2(photon->position)) < 0.003f) ++arrived;
        }
        CAPTURE(index);
        // 92 % of the photons pass a ball of n = 1.5, and 84 % one of 1.8: 368 and 337
        // are expected. 340 and 300 are 5 sigma below.
        CHECK(arrived >= (index < 1.6f ? 340 : 300));
    }
}

TEST_CASE("6.6 (3 points) glass neither makes light nor loses any") {
    INFO("Expected: the same flux behind glass and within it.\n"
         "Likely: multiplied by R or 1 - R although chance has decided, by a "
         "colour, or by n^2.\n"
         "Read: Following.");
    const Room room = lens(0, true); // all light from the ball arrives somewhere
    auto stream = course::stream(34);
    constexpr int count = 20000;
    Mean flux, turned_back;
    for (int i = 0; i < count; ++i) {
        const Flight flight = aim(room.lamps[0], ball, count, ljus::next_2d(stream));
        const auto photon = follow(room, flight, stream);
        flux.add(photon ? count * double(photon->flux.x) : 0);
    }
    CHECK(flux.agrees(double(flux_towards(room.lamps[0], ball).x), 2e-3));
    REQUIRE(flux.mean() > 0.1);
    // At normal incidence a glass plate reflects 2R/(1 + R), for R = 4 %.
    for (int i = 0; i < 20000; ++i) {
        const auto photon = follow(room, {{{0, 0, 4}, {0, 0, -1}}, Rgb{1}}, stream);
        REQUIRE(photon);
        turned_back.add(photon->position.z > 0 ? double(photon->flux.x) : 0);
    }
    CHECK(turned_back.agrees(2 * 0.04 / 1.04));
    // A diffuse core: photons that arrive within the glass have their flux, too.
    Room core = room;
    core.objects.push_back({Sphere{{0, 0, 0}, 0.5f}, {}});
    for (int i = 0; i < 100; ++i) {
        const auto photon = follow(core, {{{0, 0, 4}, {0, 0, -1}}, Rgb{1}}, stream);
        REQUIRE(photon);
        REQUIRE(photon->flux.x == doctest::Approx(1));
    }
}

TEST_CASE("6.7 (5 points) the caustic is as bright as a fan of rays says") {
    INFO("Expected: W in the disc as the fan says. If 6.2 to 6.6 pass, the flux of "
         "a photon or the reflection inside of the ball is wrong.\n"
         "Read: Aiming; Following.");
    const float drop = 1.6f, radius = 0.25f;
    const Room room = lens(drop);
    double exact = 0; // flux into the disc around the axis, W
    constexpr int rays = 100000;
    const double widest = std::asin(0.25);
    for (int i = 0; i < rays; ++i) {
        const double theta = widest * (i + 0.5) / rays;
        const Fan fan = through(theta, double(drop));
        if (fan.radius < double(radius))
            exact += fan.share * 2 * pi * std::sin(theta) * widest / rays;
    }
    auto stream = course::stream(35);
    constexpr int count = 40000;
    Mean inside;
    for (int i = 0; i < count; ++i) {
        const Flight flight = aim(room.lamps[0], ball, count, ljus::next_2d(stream));
        const auto photon = follow(room, flight, stream);
        const bool here = photon && length(ljus::Vec2(photon->position)) < radius;
        inside.add(here ? count * double(photon->flux.x) : 0);
    }
    CHECK(exact > 0.05);
    // The fan lacks light that was reflected twice inside the ball, which is less than
    // 1 %.
    CHECK(inside.agrees(exact, 0.01 * exact));
}

} // namespace course_tests
