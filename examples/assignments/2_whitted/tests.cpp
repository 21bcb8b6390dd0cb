// Assignment 2: each test is a sentence that must hold. Its name states its points. All
// comparisons are with closed forms, without random numbers.
#include <answer.hpp> // first: it must include what it needs

#define DOCTEST_CONFIG_IMPLEMENT_WITH_MAIN
#include <doctest/doctest.h>

#include "course/check.hpp"

namespace course_tests { // its names hide yours

using namespace answer;

namespace {

constexpr float pi = std::numbers::pi_v<float>;

Vec3 at_angle(double theta) { // comes down onto a surface with the normal +z
    return {float(std::sin(theta)), 0, float(-std::cos(theta))};
}

/// A diffuse ball of radius 1 at the origin, and the ray down its z axis.
const Object diffuse_ball{ljus::Sphere{{0, 0, 0}, 1}, {.color{0.9f, 0.6f, 0.3f}}};
const Ray down{.origin{0, 0, 5}, .direction{0, 0, -1}};

} // namespace

TEST_CASE("2.1 (1 point) a mirror turns the part of a ray along the normal") {
    INFO("Expected: D - 2 (D.N) N for either side.\n"
         "Likely: the 2 forgotten, or a sign that depends on the side of N.\n"
         "Read: Reflection; the chapter Reflection.");
    const Vec3 d = normalize(Vec3{1, 2, -3});
    for (const Vec3& n : {Vec3{0, 0, 1}, Vec3{0, 0, -1}}) // either side
        CHECK(distance(reflect(d, n), normalize(Vec3{1, 2, 3})) < 1e-6f);
    const Vec3 tilted = normalize(Vec3{1, 1, 1});
    const Vec3 out = reflect(d, tilted);
    CHECK(length(out) == doctest::Approx(1));
    CHECK(dot(out, tilted) == doctest::Approx(-dot(d, tilted)).epsilon(1e-5));
    CHECK(length(cross(out, tilted) - cross(d, tilted)) < 1e-6f);
}

TEST_CASE("2.2 (2 points) refraction obeys Snell's law on both sides of the normal") {
    INFO("Expected: sin behind = eta sin before, length 1, onwards.\n"
         "Likely: N not turned to the ray, or eta upside down (n_1/n_2).\n"
         "Read: Refraction; the chapter Refraction.");
    for (const double theta : {0.0, 0.3, 0.7, 1.2})
        for (const float eta : {1 / 1.5f, 0.75f, 1.05f})
            for (const float side : {1.0f, -1.0f}) {
                const auto t = refract(at_angle(theta), {0, 0, side}, eta);
                REQUIRE(t);
                CHECK(length(*t) == doctest::Approx(1));
                CHECK(t->z < 0);
                CHECK(t->x == doctest::Approx(double(eta) * std::sin(theta)));
                CHECK(t->y == 0);
            }
}

TEST_CASE("2.3 (2 points) beyond the critical angle nothing passes") {
    INFO("Expected: nothing where the number below the root is negative, and "
         "Fresnel 1.\n"
         "Likely: another direction is returned in its place.\n"
         "Read: Refraction.");
    const double critical = std::asin(1 / 1.5);
    REQUIRE(refract(at_angle(critical - 0.01), {0, 0, 1}, 1.5f));
    CHECK_FALSE(refract(at_angle(critical + 0.01), {0, 0, 1}, 1.5f));
    CHECK_FALSE(refract(at_angle(1.5), {0, 0, -1}, 1.5f));
    CHECK(fresnel(float(std::cos(critical + 0.01)), 1.5f, 1) == doctest::Approx(1));
}

TEST_CASE("2.4 (3 points) Fresnel's share is right at the angles that one knows") {
    INFO("Expected: the mean of both polarisations.\n"
         "Likely: one of them, Schlick, or n_1 and n_2 swapped in Snell's law.\n"
         "Read: Fresnel; the chapter Fresnel.");
    CHECK(fresnel(1, 1, 1.5f) == doctest::Approx(0.04));
    CHECK(fresnel(1e-4f, 1, 1.5f) > 0.99f);
    const double brewster = std::atan(1.5); // one polarisation is not reflected
    const double ratio = (1 - 1.5 * 1.5) / (1 + 1.5 * 1.5);
    CHECK(fresnel(float(std::cos(brewster)), 1, 1.5f) ==
          doctest::Approx(ratio * ratio / 2).epsilon(1e-4));
    for (const double theta : {0.2, 0.6, 1.0, 1.4}) { // the same from the other side
        const double behind = std::asin(std::sin(theta) / 1.5);
        const float share = fresnel(float(std::cos(theta)), 1, 1.5f);
        CHECK(share > 0.03f);
        CHECK(fresnel(float(std::cos(behind)), 1.5f, 1) ==
              doctest::Approx(share).epsilon(1e-3));
    }
}

TEST_CASE("2.5 (3 points) a diffuse surface shows its lamps by cosine and distance") {
    INFO("Expected: albedo / pi * I cos / r^2, the sum over the lamps, each on the "
         "side that the ray comes from.\n"
         "Likely: 1/pi, r^2, |cos|, or a normal that is not turned to the ray.\n"
         "Read: Diffuse surfaces; the chapter Radiance.");
    Room room{.objects{diffuse_ball}};
    const Rgb f = Rgb{0.9f, 0.6f, 0.3f} / pi;
    const auto see = [&] { return diffuse_light(room, *nearest(room, down), down); };
    room.lamps = {{{0, 0, 3}, Rgb{8}}}; // 2 above the point that the ray meets
    CHECK(distance(see(), f * 2.0f) < 1e-5f);
    room.lamps = {{{2, 0, 3}, Rgb{8}}}; // 45 degrees, distance sqrt(8)
    CHECK(distance(see(), f * std::sqrt(0.5f)) < 1e-5f);
    room.lamps.push_back({{0, 0, 3}, Rgb{8}}); // lamps add up
    CHECK(distance(see(), f * (2 + std::sqrt(0.5f))) < 1e-5f);
    room.lamps.push_back({{3, 0, 0}, Rgb{800}}); // below the horizon
    CHECK(distance(see(), f * (2 + std::sqrt(0.5f))) < 1e-5f);
    // A thin wall, lit on one side and seen from both.
    const Room wall{.objects{{ljus::Quad{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}},
                              {.color{0.9f, 0.6f, 0.3f}}}},
                    .lamps{{{0, 0, -2}, Rgb{8}}}};
    const Ray up{.origin{0, 0, -5}, .direction{0, 0, 1}};
    CHECK(distance(diffuse_light(wall, *nearest(wall, up), up), f * 2.0f) < 1e-5f);
    CHECK(ljus::is_black(diffuse_light(wall, *nearest(wall, down), down)));
}

TEST_CASE("2.6 (2 points) an object between lamp and surface casts a shadow") {
    INFO("Expected: only the lamp that is not hidden. visible() tells.\n"
         "Read: Diffuse surfaces.");
    Room room{.objects{diffuse_ball, {ljus::Sphere{{1, 0, 2}, 0.3f}, {}}},
              .lamps{{{2, 0, 3}, Rgb{8}}, {{0, 0, 3}, Rgb{8}}}};
    const Rgb light = diffuse_light(room, *nearest(room, down), down);
    CHECK(distance(light, Rgb{0.9f, 0.6f, 0.3f} / pi * 2.0f) < 1e-5f);
}

TEST_CASE("2.7 (1 point) a ray sees the sky and diffuse objects") {
    INFO("Expected: sky and diffuse light at depth 0, too: only mirrors and glass "
         "use up depth.\n"
         "Read: The tree.");
    const Room room{.objects{diffuse_ball}, .lamps{{{0, 0, 3}, Rgb{8}}}, .sky{1, 2, 3}};
    CHECK(radiance(room, {.direction{0, 0, 1}, .t_min = 2}, 0) == Rgb{1, 2, 3});
    CHECK(distance(radiance(room, down, 0), Rgb{0.9f, 0.6f, 0.3f} / pi * 2.0f) < 1e-5f);
}

TEST_CASE("2.8 (2 points) a mirror shows what lies behind it in its colour") {
    INFO("Expected: the mirror's colour times what the reflected ray sees.\n"
         "Read: The tree; the chapter Whitted's ray tracing.");
    const Room room{.objects{{ljus::Sphere{{0, 0, 0}, 1}, {Kind::mirror, Rgb{0.5f}}},
                             {ljus::Sphere{{5, 0, 1}, 1}, {.color = Rgb{1}}}},
                    .lamps{{{2, 0, 1}, Rgb{4}}}, // at distance 2 from the diffuse ball
                    .sky = Rgb{3}};
    // The ray meets the mirror at 45 degrees, and is reflected to the diffuse ball.
    const float h = std::sqrt(0.5f);
    const Ray ray{.origin{h, 0, 5}, .direction{0, 0, -1}};
    const Rgb seen = radiance(room, ray, 2);
    CHECK(seen.x > 0.1f);
    CHECK(seen.x < 0.5f / pi);
    const Rgb sky = radiance(room, {.origin{0, h, 5}, .direction{0, 0, -1}}, 2);
    CHECK(distance(sky, Rgb{1.5f}) < 1e-5f);
}

TEST_CASE("2.9 (3 points) a glass ball in an even sky cannot be seen") {
    INFO("Expected: 1, since R + (1 - R) = 1.\n"
         "Likely: a ray too few, a share twice, a colour or a factor n^2 in the "
         "glass.\n"
         "Read: The tree; the chapter Whitted's ray tracing.");
    const Room room{.objects{{ljus::Sphere{{0, 0, 0}, 1}, {.kind = Kind::glass}}},
                    .sky = Rgb{1}};
    for (const float beside : {0.0f, 0.3f, 0.7f, 0.9f, 0.97f}) {
        const Ray ray{.origin{beside, 0, 5}, .direction{0, 0, -1}};
        CAPTURE(beside);
        CHECK(radiance(room, ray, 12).x == doctest::Approx(1).epsilon(0.01));
    }
}

TEST_CASE("2.10 (3 points) glass shows what it lets through and what it throws back") {
    INFO("Expected: both rays, with their shares, at each surface, and the index "
         "of this glass.\n"
         "Likely: no reflection inside, n_1 and n_2 swapped on the way out, or 1.5 "
         "for every glass.\n"
         "Read: Fresnel; The tree.");
    for (const float index : {1.5f, 2.0f}) {
        // Along the axis each surface reflects the fraction R and transmits T = 1 - R.
        // Through the ball one sees T^2 (1 + R^2 + R^4 + ...) = T^2/(1 - R^2) of the
        // light behind it.
        const Matter glass{.kind = Kind::glass, .index = index};
        CAPTURE(index);
        Room room{.objects{{ljus::Sphere{{0, 0, 5}, 1}, glass}, diffuse_ball},
                  .lamps{{{3, 0, 4}, Rgb{8}}}};
        const Ray ray{.origin{0, 0, 9}, .direction{0, 0, -1}};
        const float behind = 0.9f / pi * 8 * std::sqrt(0.5f) / 18;
        const float back = (index - 1) * (index - 1) / ((index + 1) * (index + 1));
        const float share = (1 - back) * (1 - back) / (1 - back * back);
        CHECK(radiance(room, ray, 16).x ==
              doctest::Approx(behind * share).epsilon(1e-4));
        room.lamps = {};
        room.objects.pop_back();
        room.objects.push_back({ljus::Quad{{-9, -9, -9}, {0, 18, 0}, {18, 0, 0}}, {}});
        room.sky = Rgb{1}; // reflected sky: R + T^2 R (1 + R^2 + ...)
        CHECK(radiance(room, ray, 16).x ==
              doctest::Approx(back + share * back).epsilon(2e-4));
        // A ray near the axis crosses the axis at n/(2 (n - 1)) radii from the centre.
        // At 3 radii it is at x = -0.1 for n = 1.5, and at x = -0.2 for n = 2. A black
        // wall hides the sky below x = -0.15.
        room.objects.back() = {ljus::Quad{{-9, -9, 2}, {0, 18, 0}, {8.85f, 0, 0}}, {}};
        const float seen = radiance(room, {{0.1f, 0, 9}, {0, 0, -1}}, 16).x;
        CHECK((index < 1.75f ? seen > 0.7f : seen < 0.4f));
    }
}

TEST_CASE("2.11 (1 point) each mirror and each surface of glass uses up depth") {
    INFO("Expected: black when the depth is used up; every mirror and every "
         "surface of glass uses 1, by reflection and by refraction.\n"
         "Read: The tree; the chapter Whitted's ray tracing.");
    const Room room{
        .objects{
            {ljus::Quad{{-9, -9, 0}, {18, 0, 0}, {0, 18, 0}}, {Kind::mirror, Rgb{1}}},
            {ljus::Quad{{-9, -9, 9}, {0, 18, 0}, {18, 0, 0}}, {Kind::mirror, Rgb{1}}},
            diffuse_ball},
        .sky = Rgb{1}};
    const Ray ray{.origin{5, 5, 5}, .direction{0, 0, -1}};
    CHECK(ljus::is_black(radiance(room, ray, 20)));
    const Ray out{.origin{5, 5, 5}, .direction = normalize(Vec3{5, 0, 1})};
    CHECK(radiance(room, out, 20).x == doctest::Approx(1));
    // Along the axis of a glass ball under an even sky, 4 % of the light is reflected
    // at the first surface, and 0.96^2 passes two surfaces.
    const Room ball{.objects{{ljus::Sphere{{0, 0, 0}, 1}, {.kind = Kind::glass}}},
                    .sky = Rgb{1}};
    CHECK(radiance(ball, down, 0).x == 0);
    CHECK(radiance(ball, down, 1).x == doctest::Approx(0.04).epsilon(1e-4));
    CHECK(radiance(ball, down, 2).x == doctest::Approx(0.04 + 0.9216).epsilon(1e-4));
}

} // namespace course_tests
