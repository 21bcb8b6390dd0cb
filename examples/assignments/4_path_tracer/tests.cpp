// Assignment 4: each test is a sentence that must hold. Its name states its points.
// Means are compared with closed forms and with quadrature within five standard errors:
// a right answer fails a check once in 1.7 million seeds, and the seeds are fixed. Any
// right estimator will do.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;
using course::Mean;

namespace {

constexpr double pi = std::numbers::pi;

/// A square lamp of side 2 that hangs at a height above the floor and shines down.
Object lamp_at(float x, float height, Rgb radiance) {
    return {ljus::Quad{{x - 1, -1, height}, {0, 2, 0}, {2, 0, 0}},
            {.color = Rgb{0}, .emission = radiance}};
}
const Object floor_of_half{ljus::Quad{{-50, -50, 0}, {100, 0, 0}, {0, 100, 0}},
                           {.color = Rgb{0.5f}}};
const Ray down{.origin{0, 0, 0.5f}, .direction{0, 0, -1}};

/// The irradiance at the origin from lamp_at(), by the midpoint rule over the lamp.
double irradiance(double x, double height, double radiance) {
    double sum = 0;
    constexpr int n = 400;
    for (int i = 0; i < n * n; ++i) {
        const double px = x - 1 + 2 * (i % n + 0.5) / n;
        const double py = -1 + 2 * (int(i / n) + 0.5) / n;
        const double r2 = px * px + py * py + height * height;
        sum += height * height / (r2 * r2); // both cosines are height / r
    }
    return radiance * sum * 4 / (n * n);
}

/// A lamp in the middle of a ball of radius 1 with a diffuse inside. The lamp is a ball
/// of radius r that emits radiance 1. It gives the wall the irradiance r^2 pi. Of the
/// light that the wall reflects, the fraction r^2 falls onto the lamp, which absorbs it
/// unless the lamp reflects.
struct Globe {
    float r = 0.3f, albedo = 0.5f, lamp_albedo = 0;
    Room room() const {
        return {.objects{{ljus::Sphere{{0, 0, 0}, 1}, {.color = Rgb{albedo}}},
                         {ljus::Sphere{{0, 0, 0}, r},
                          {.color = Rgb{lamp_albedo}, .emission = Rgb{1}}}}};
    }
    double all() const {
        const double a = double(albedo), r2 = double(r) * double(r);
        return a * r2 / (1 - a * (1 - r2) - a * r2 * double(lamp_albedo));
    }
    Ray to_wall() const {
        return {.origin{0, 0, (1 + r) / 2}, .direction = normalize(Vec3{1, 2, 2})};
    }
};

Mean paths(const Room& room, const Ray& ray, int count) {
    auto stream = course::stream(11);
    Mean mean;
    for (int i = 0; i < count; ++i) mean.add(double(radiance(room, ray, stream).x));
    return mean;
}

Mean shadow_rays(const Room& room, int count) {
    auto stream = course::stream(12);
    const auto surface = nearest(room, down);
    Mean mean;
    for (int i = 0; i < count; ++i)
        mean.add(double(direct_light(room, *surface, down, stream).x));
    return mean;
}

} // namespace

TEST_CASE("4.1 (2 points) points are chosen on lamps only and their density is right") {
    INFO("Expected: density 1/(n A), points even over each lamp.\n"
         "Likely: the choice of the lamp missing in the density, or one random "
         "number for the choice and for the point.\n"
         "Read: A point of a lamp; the chapter Path tracing.");
    Room room{.objects{floor_of_half, lamp_at(0, 2, Rgb{1}), lamp_at(5, 2, Rgb{1})}};
    auto stream = course::stream(10);
    Mean left, front, area;
    for (int i = 0; i < 20000; ++i) {
        const auto chosen = choose_lamp_point(room, stream);
        REQUIRE(chosen);
        REQUIRE(chosen->lamp != nullptr);
        REQUIRE_FALSE(ljus::is_black(chosen->lamp->matter.emission));
        REQUIRE(chosen->point.position.z == doctest::Approx(2));
        REQUIRE(chosen->density > 0);
        const double share = 1 / double(chosen->density);
        area.add(share);
        left.add(chosen->point.position.x < 0 ? share : 0);
        const bool first = chosen->point.position.x < 2;
        front.add(first && chosen->point.position.y < 0 ? share : 0);
    }
    CHECK(area.agrees(8, 1e-4));
    CHECK(left.agrees(2, 1e-4));  // half of the first lamp
    CHECK(front.agrees(2, 1e-4)); // another half of that lamp
    room.objects.resize(1);
    CHECK_FALSE(choose_lamp_point(room, stream));
}

TEST_CASE("4.2 (3 points) direct light is the integral over the lamp") {
    INFO("Expected: albedo/pi L cos cos_L / (r^2 p).\n"
         "Likely: r^2, one cosine, 1/pi or the density missing.\n"
         "Read: Direct light.");
    for (const float x : {0.0f, 1.5f}) {
        const Room room{.objects{floor_of_half, lamp_at(x, 2, Rgb{3})}};
        const double exact = 0.5 / pi * irradiance(double(x), 2, 3);
        CHECK(shadow_rays(room, 40000).agrees(exact, 1e-5));
    }
}

TEST_CASE("4.3 (2 points) several lamps add up") {
    INFO("Expected: the sum over the lamps; the density holds the choice among n.\n"
         "Read: A point of a lamp.");
    const Room room{
        .objects{floor_of_half, lamp_at(0, 2, Rgb{3}), lamp_at(3, 1, Rgb{5})}};
    const double exact = 0.5 / pi * (irradiance(0, 2, 3) + irradiance(3, 1, 5));
    CHECK(shadow_rays(room, 40000).agrees(exact, 1e-5));
}

TEST_CASE("4.4 (2 points) what is between casts a shadow and a lamp has one side") {
    INFO("Expected: 0 behind an object, and 0 behind a lamp: emitted() knows its "
         "side.\n"
         "Likely: |cos| at the lamp.\n"
         "Read: Direct light.");
    Room room{.objects{floor_of_half,
                       lamp_at(0, 2, Rgb{3}),
                       lamp_at(3, 1, Rgb{5}),
                       {ljus::Quad{{1, -2, 0.6f}, {3, 0, 0}, {0, 4, 0}}, {}}}};
    const double exact = 0.5 / pi * irradiance(0, 2, 3);
    CHECK(shadow_rays(room, 40000).agrees(exact, 1e-5));
    room.objects.push_back({ljus::Quad{{-1, -1, 0.7f}, {2, 0, 0}, {0, 2, 0}},
                            {.color = Rgb{0}, .emission = Rgb{9}}}); // shines upwards
    CHECK(shadow_rays(room, 2000).mean() == 0);
    CHECK(shadow_rays({.objects{floor_of_half, lamp_at(0, 2, Rgb{3})}}, 99).mean() > 0);
}

TEST_CASE("4.5 (2 points) a shadow ray has less noise than a path by chance") {
    INFO("Expected: one shadow ray to a point of the lamp, not a ray that finds it "
         "by chance.\n"
         "Read: Direct light.");
    // A path hits the lamp with probability p and then carries 0.5 L. The variance is
    // therefore about 0.25 L^2 p.
    const Room room{.objects{floor_of_half, lamp_at(0, 4, Rgb{3})}};
    const double chance = irradiance(0, 4, 3) / (3 * pi);
    const Mean mean = shadow_rays(room, 20000);
    CHECK(mean.mean() > 0);
    CHECK(mean.variance() < 0.25 * 9 * chance * (1 - chance) / 10);
}

TEST_CASE("4.6 (1 point) a ray that meets a lamp sees its radiance") {
    INFO("Expected: the radiance on the side of its normal, 0 on the other one and "
         "outside of the room.\n"
         "Read: Who counts the lamp?");
    const Room room{.objects{lamp_at(0, 2, Rgb{3})}};
    const Mean below = paths(room, {.direction{0, 0, 1}}, 10);
    CHECK(below.mean() == doctest::Approx(3));
    CHECK(paths(room, {.origin{0, 0, 4}, .direction{0, 0, -1}}, 10).mean() == 0);
    CHECK(paths(room, {.direction{1, 0, 0}}, 10).mean() == 0); // no sky
}

TEST_CASE("4.7 (3 points) a closed room has the light of all bounces") {
    INFO("Expected: all bounces, also on lamps that reflect.\n"
         "Likely: throughput multiplied too early, a cosine twice, a normal that "
         "is not turned, roulette without its division, or a path that ends at a "
         "lamp.\n"
         "Read: The path; the chapter Path tracing.");
    for (const float albedo : {0.2f, 0.5f, 0.8f}) {
        const Globe globe{.albedo = albedo};
        CAPTURE(albedo);
        CHECK(paths(globe.room(), globe.to_wall(), 40000).agrees(globe.all(), 2e-4));
    }
    const Globe pale{.r = 0.6f, .albedo = 0.8f, .lamp_albedo = 0.7f};
    const Ray to_lamp{.origin{0, 0, 0.8f}, .direction{0, 0, -1}};
    CHECK(paths(pale.room(), pale.to_wall(), 40000).agrees(pale.all(), 2e-4));
    CHECK(paths(pale.room(), to_lamp, 40000).agrees(1 + 0.7 * pale.all(), 2e-4));
}

TEST_CASE("4.8 (3 points) a large lamp is not counted twice") {
    INFO("Expected: the lamp counts where the eye sees it and in shadow rays, not "
         "again where a path meets it.\n"
         "Read: Who counts the lamp?");
    const Globe globe{.r = 0.8f};
    CHECK(paths(globe.room(), globe.to_wall(), 40000).agrees(globe.all(), 2e-4));
}

TEST_CASE("4.9 (2 points) paths between white walls end and lose nothing") {
    INFO("Expected: light of hundreds of bounces.\n"
         "Likely: a limit on their number, or roulette without its division.\n"
         "Read: The end; the chapter Path tracing.");
    for (const float r : {0.4f, 0.1f}) { // a small lamp absorbs little
        const Globe globe{.r = r, .albedo = 0.97f};
        CAPTURE(r);
        CHECK(paths(globe.room(), globe.to_wall(), 40000).agrees(globe.all(), 2e-4));
    }
}

} // namespace course_tests
