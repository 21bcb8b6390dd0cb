// Assignment 5: each test is a sentence that must hold. Its name states its points.
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

/// A square lamp of side 2 at height 2 that shines down: its flux is 4 pi L.
Object lamp_at(float x, Rgb radiance) {
    return {ljus::Quad{{x - 1, -1, 2}, {0, 2, 0}, {2, 0, 0}},
            {.color = Rgb{0}, .emission = radiance}};
}

/// A lamp in the middle of a ball of radius 1 with a diffuse inside. The lamp is a
/// black ball of radius r that emits radiance 1. Of the light that the wall reflects,
/// the fraction r^2 falls onto the lamp.
struct Globe {
    float r = 0.3f, albedo = 0.5f;
    Room room() const {
        return {.objects{
            {ljus::Sphere{{0, 0, 0}, 1}, {.color = Rgb{albedo}}},
            {ljus::Sphere{{0, 0, 0}, r}, {.color = Rgb{0}, .emission = Rgb{1}}}}};
    }
    double flux() const { return 4 * pi * pi * double(r) * double(r); }
    /// The flux that arrives at the wall, after any number of bounces.
    double arrives() const {
        return flux() / (1 - double(albedo) * (1 - double(r) * double(r)));
    }
    /// The radiance that the wall reflects.
    double radiance() const { return double(albedo) / pi * arrives() / (4 * pi); }
};

/// The mean, over emitted photons, of the flux that a photon leaves on the wall of a
/// globe, times the number of photons.
Mean on_the_wall(const Globe& globe, int count, std::vector<Photon>& all) {
    const Room room = globe.room();
    auto stream = course::stream(21);
    Mean mean;
    for (int i = 0; i < count; ++i) {
        const std::size_t before = all.size();
        follow(room, emit(room, count, stream), stream, all);
        double flux = 0;
        for (std::size_t k = before; k < all.size(); ++k)
            if (length(all[k].position) > 0.9f) flux += double(all[k].flux.x);
        mean.add(flux * count);
    }
    return mean;
}

/// Photons on a fine grid of the square [-1, 1]^2 at a height, 3 W per unit of area.
std::vector<Photon> rain(float height, Vec3 direction) {
    std::vector<Photon> photons;
    constexpr int n = 300;
    for (int i = 0; i < n * n; ++i)
        photons.push_back({{-1 + 2 * (float(i % n) + 0.5f) / n,
                            -1 + 2 * (float(int(i / n)) + 0.5f) / n, height},
                           normalize(direction),
                           Rgb{12.0f / (n * n)}});
    return photons;
}
const Object floor_of_half{ljus::Quad{{-1, -1, 0}, {2, 0, 0}, {0, 2, 0}},
                           {.color = Rgb{0.5f}}};
const Ray down{.origin{0, 0, 1}, .direction{0, 0, -1}};

double seen(const std::vector<Photon>& photons, const Ray& ray = down) {
    const Room room{.objects{floor_of_half}};
    const PhotonMap map(photons);
    return double(estimate(map, *nearest(room, ray), ray, 0.3f).x);
}

} // namespace

TEST_CASE("5.1 (2 points) all photons together carry the flux of all lamps") {
    INFO("Expected: pi L A of each lamp, over its chance and the number of "
         "photons, in the colour of the lamp.\n"
         "Likely: the chance, pi, or the colour missing.\n"
         "Read: Flux; the chapter Photons.");
    const Room room{.objects{lamp_at(0, Rgb{1, 2, 3}), lamp_at(9, Rgb{3, 3, 3})}};
    auto stream = course::stream(20);
    constexpr int count = 20000;
    Mean red, blue, left;
    for (int i = 0; i < count; ++i) {
        const Flight flight = emit(room, count, stream);
        red.add(count * double(flight.flux.x));
        blue.add(count * double(flight.flux.z));
        left.add(flight.ray.origin.x < 5 ? count * double(flight.flux.y) : 0);
    }
    CHECK(red.agrees(16 * pi, 1e-3));
    CHECK(blue.agrees(24 * pi, 1e-3));
    CHECK(left.agrees(8 * pi, 1e-3));
    CHECK(emit({.objects{floor_of_half}}, 1, stream).flux == Rgb{0}); // no lamp
}

TEST_CASE("5.2 (2 points) a lamp sends its flux along the cosine") {
    INFO("Expected: cosine-weighted directions around the normal, even over the "
         "lamp, and no further cosine in the flux.\n"
         "Read: Place and direction; the chapter Photons.");
    const Room room{.objects{lamp_at(0, Rgb{1})}};
    auto stream = course::stream(22);
    constexpr int count = 40000;
    Mean cosine, square, side, place;
    for (int i = 0; i < count; ++i) {
        const Flight flight = emit(room, count, stream);
        REQUIRE(length(flight.ray.direction) == doctest::Approx(1).epsilon(1e-4));
        const double c = -double(flight.ray.direction.z);
        REQUIRE(c >= 0);
        const double share = count * double(flight.flux.x) / (4 * pi);
        cosine.add(c * share);
        square.add(c * c * share);
        side.add(double(flight.ray.direction.x) * share);
        place.add(double(flight.ray.origin.x * flight.ray.origin.x) * share);
    }
    CHECK(cosine.agrees(2.0 / 3));
    CHECK(square.agrees(0.5));
    CHECK(side.agrees(0));
    CHECK(place.agrees(1.0 / 3));
}

TEST_CASE("5.3 (2 points) a black wall gets the flux of the lamp") {
    INFO("Expected: each photon stored where it arrives, the first surface "
         "included, with the flux that arrives there.\n"
         "Read: On its way; the chapter Photons.");
    const Globe globe{.albedo = 0};
    std::vector<Photon> stored;
    CHECK(on_the_wall(globe, 5000, stored).agrees(globe.flux(), 1e-3));
    REQUIRE(!stored.empty());
    const Photon& photon = stored.front();
    CHECK(length(photon.position) == doctest::Approx(1).epsilon(1e-3));
    CHECK(length(photon.direction) == doctest::Approx(1).epsilon(1e-4));
    CHECK(dot(photon.direction, photon.position) > 0); // from inside the ball
}

TEST_CASE("5.4 (3 points) what arrives in all bounces adds up") {
    INFO("Expected: flux multiplied by albedo/q at each bounce, in each colour.\n"
         "Likely: not divided by q, not multiplied because it survived (right for "
         "grey only), or a normal that is not turned to the photon.\n"
         "Read: On its way.");
    for (const float albedo : {0.3f, 0.8f}) {
        const Globe globe{.albedo = albedo};
        std::vector<Photon> stored;
        CAPTURE(albedo);
        CHECK(on_the_wall(globe, 40000, stored).agrees(globe.arrives(), 1e-3));
    }
    // A wall that reflects much red and little green light.
    Room room = Globe{.albedo = 0.8f}.room();
    room.objects[0].matter.color = Rgb{0.8f, 0.3f, 0};
    auto stream = course::stream(23);
    constexpr int count = 20000;
    Mean green, blue;
    for (int i = 0; i < count; ++i) {
        std::vector<Photon> stored;
        follow(room, emit(room, count, stream), stream, stored);
        Rgb flux{0};
        for (const Photon& photon : stored)
            if (length(photon.position) > 0.9f) flux += photon.flux;
        green.add(double(flux.y) * count);
        blue.add(double(flux.z) * count);
    }
    CHECK(green.agrees(Globe{.albedo = 0.3f}.arrives(), 1e-3));
    CHECK(blue.agrees(Globe{}.flux(), 1e-3));
}

TEST_CASE("5.5 (2 points) survivors of roulette are no weaker than they were") {
    INFO("Expected: all photons alike between grey walls: q is the largest "
         "component of the albedo.\n"
         "Read: On its way.");
    // On grey walls, roulette with the albedo gives every stored photon the same flux.
    const Globe globe{.albedo = 0.6f};
    std::vector<Photon> stored;
    const Mean mean = on_the_wall(globe, 20000, stored);
    const double per_photon = globe.flux() / 20000;
    const double photons = double(stored.size()) / 20000;
    CHECK(mean.mean() > globe.flux());
    CHECK(photons < 1.3 * globe.arrives() / globe.flux()); // not many weak photons
    for (const Photon& photon : stored)
        REQUIRE(double(photon.flux.x) < 1.5 * per_photon);
}

TEST_CASE("5.6 (1 point) the mean of the kernel over the disc is 1") {
    INFO("Expected: 2 (1 - x), with x = d^2/r^2.\n"
         "Likely: 1 - x, or d/r.\n"
         "Read: The kernel.");
    double mean = 0;
    for (int i = 0; i < 1000; ++i)
        mean += double(kernel((float(i) + 0.5f) / 1000)) / 1000;
    CHECK(mean == doctest::Approx(1).epsilon(1e-3));
    CHECK(kernel(0) == doctest::Approx(2));
    CHECK(kernel(0.5f) == doctest::Approx(1));
    CHECK(kernel(1) == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("5.7 (3 points) even photons make an even floor whatever their direction") {
    INFO("Expected: albedo/pi E for any direction of the photons.\n"
         "Likely: a cosine, which flux has already, or a factor pi.\n"
         "Read: The estimate; the chapter The density estimate.");
    const double exact = 0.5 / pi * 3;
    CHECK(seen(rain(0, {0, 0, -1})) == doctest::Approx(exact).epsilon(0.01));
    CHECK(seen(rain(0, {2, 1, -1})) == doctest::Approx(exact).epsilon(0.01));
}

TEST_CASE("5.8 (3 points) only photons of this side of this surface count") {
    INFO("Expected: photons of this side, within half the radius of the plane, on "
         "both sides of it.\n"
         "Likely: a normal that is not turned to the ray, or |height| without its "
         "bars.\n"
         "Read: Which photons; the chapter The density estimate.");
    std::vector<Photon> photons = rain(0, {0, 0, -1});
    const auto add = [&](const std::vector<Photon>& more) {
        photons.insert(photons.end(), more.begin(), more.end());
    };
    const double exact = 0.5 / pi * 3;
    add(rain(0, {0, 1, 1}));       // photons from below
    add(rain(-0.25f, {0, 0, -1})); // photons of another floor
    CHECK(seen(photons) == doctest::Approx(exact).epsilon(0.01));
    const Ray up{.origin{0, 0, -0.1f}, .direction{0, 0, 1}}; // the same from below
    CHECK(seen(photons, up) == doctest::Approx(exact).epsilon(0.01));
}

TEST_CASE("5.9 (4 points) the map of a closed room shows the light of all bounces") {
    INFO("Expected: emission, bounces and estimate together. If 5.1 to 5.8 pass, "
         "look at what travels from one to the other.\n"
         "Read: The estimate; the chapter The density estimate.");
    const Globe globe{.albedo = 0.7f};
    const Room room = globe.room();
    Mean mean;
    for (int run = 0; run < 40; ++run) { // each run has its own map
        auto stream = course::stream(static_cast<std::uint64_t>(100 + run));
        std::vector<Photon> stored;
        for (int i = 0; i < 4000; ++i)
            follow(room, emit(room, 4000, stream), stream, stored);
        const Ray ray{.origin{0, 0, 0.6f}, .direction = normalize(Vec3{1, 2, 2})};
        mean.add(double(estimate(PhotonMap(stored), *nearest(room, ray), ray, 0.2f).x));
    }
    CHECK(mean.mean() > 0);
    // A disc of radius 0.2 on a ball of radius 1 is curved. The curvature may change
    // the result by 2 %.
    CHECK(mean.agrees(globe.radiance(), 0.02 * globe.radiance()));
}

} // namespace course_tests
