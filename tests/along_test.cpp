/// \file along_test.cpp
/// \brief The last program of the build-along against the library's photon mapper.
// rest: a program that does without the library

// What the program includes, before it is included into a namespace.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <numbers>
#include <span>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include <ljus/inspect/metrics.hpp>
#include <ljus/ljus.hpp>

#include "support/box_sides.hpp"
#include "support/seed.hpp"

namespace along {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wreturn-type" // main() is no main function here
#include "../examples/along/12_caustic.cpp"
#pragma GCC diagnostic pop
} // namespace along

using namespace ljus;

namespace {

constexpr int side = 50, runs = 8; // pixels; pictures by each renderer

/// The room of the program.
auto room() {
    Scene<Shapes<Quad, Sphere>, Materials<Lambertian, Mirror, Glass>> scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.75f}});
    const auto red = scene.add(Lambertian{.albedo{0.75f, 0.25f, 0.2f}});
    const auto blue = scene.add(Lambertian{.albedo{0.25f, 0.35f, 0.75f}});
    ljus_test::add_room(scene, {-1, -1, -1}, {1, 1, 3},
                        {white, white, white, white, red, blue});
    scene.add(Quad{{-0.15f, 1, -0.15f}, {0.3f, 0, 0}, {0, 0, 0.3f}}, white, Rgb{50});
    scene.add(Sphere{.center{-0.45f, -0.6f, -0.4f}, .radius = 0.4f},
              scene.add(Mirror{}));
    scene.add(Sphere{.center{0.45f, -0.65f, 0.1f}, .radius = 0.35f},
              scene.add(Glass{.index = 1.5f}));
    return World(std::move(scene));
}

/// The program's picture, from photons of its own.
Image along_picture(std::uint64_t seed, int samples) {
    along::Random random{mix_bits(seed)};
    along::Photons photons = along::trace_photons(20000, random);
    along::build(photons);
    along::Photons caustics = along::trace_caustics(30000, random);
    along::build(caustics);
    Image image = make_image(side, side);
    const double scale = double(along::width) / side;
    for (int row = 0; row < side; ++row)
        for (int column = 0; column < side; ++column)
            for (int i = 0; i < samples; ++i) {
                const double x = column + random(), y = row + random();
                const along::Ray ray = along::camera_ray(scale * x, scale * y);
                const along::Vec c = along::radiance(ray, photons, caustics, random);
                pixel(image, column, row) += Rgb{c.x, c.y, c.z} / float(samples);
            }
    return image;
}

} // namespace

// 75 differences of two means of 8: beyond 6 standard errors (Student's t with 14
// degrees of freedom) with a chance of 75 * 3e-5, once in 440 seeds. The further 4 %
// are for what photons blur at the ends of gather rays, mostly along edges of the room.
TEST_CASE("the last step of the build-along has the radiance of the photon mapper") {
    const auto world = room();
    const Camera camera{.position{0, 0, 2.9f}, .half_height = 0.45f};
    std::vector<Image> ours, theirs;
    for (std::uint64_t i = 1; i <= runs; ++i) {
        const std::uint64_t seed = ljus_test::test_seed(i);
        ours.push_back(along_picture(seed, 16));
        const PhotonMapper mapper(world, {.caustics{.photons = 200'000, .seed = seed},
                                          .caustics_estimate{.radius = 0.03f}});
        theirs.push_back(
            render(mapper, camera,
                   {.width = side, .height = side, .samples = 16, .seed = seed})
                .image);
    }
    const BlockStatistics found = block_statistics(ours),
                          right = block_statistics(theirs);
    for (std::size_t block = 0; block < found.mean.pixels.size(); ++block)
        for (int channel = 0; channel < 3; ++channel) {
            CAPTURE(block);
            CAPTURE(channel);
            const double value = right.mean.pixels[block][channel];
            const double noise =
                std::hypot(found.standard_error.pixels[block][channel],
                           right.standard_error.pixels[block][channel]);
            CHECK(std::abs(found.mean.pixels[block][channel] - value) <=
                  6 * noise + 0.04 * value);
            CHECK(noise < 0.1 * value); // or the check above could not fail
        }
}

// Ten numbers of 20 000 trials: beyond 5 standard errors with a chance of 10 * 6e-7.
TEST_CASE("the glass of the build-along reflects what Fresnel's equations say") {
    along::Random random{mix_bits(ljus_test::test_seed(1))};
    constexpr int trials = 20000;
    for (const double cosine : {1.0, 0.8, 0.5, 0.3, 0.1})
        for (const bool outside : {true, false}) {
            CAPTURE(cosine);
            CAPTURE(outside);
            const double up = outside ? -cosine : cosine;
            const along::Ray ray{{}, {std::sqrt(1 - cosine * cosine), up, 0}};
            const along::Hit hit{0, {}, {0, 1, 0}, {}, &along::spheres[1]};
            int reflected = 0;
            for (int i = 0; i < trials; ++i)
                if (along::scatter(ray, hit, random).direction.y * up < 0) ++reflected;
            const double right =
                fresnel(cosine, outside ? 1.0 : 1.5, outside ? 1.5 : 1.0);
            CHECK(std::abs(reflected - trials * right) <=
                  5 * std::sqrt(trials * right * (1 - right)));
        }
}

// A sphere at distance d, in a direction of the cosine c, receives c (R/d)^2 of what a
// point of the lamp emits; here the mean over 50 x 50 points. The flux of photons for
// one sphere varies by a few per cent, and their sum by less than 0.1 %.
TEST_CASE(
    "the caustic photons of the build-along carry what the lamp sends to the balls") {
    const double flux = along::pi * along::lamp_area * along::lamp_radiance.x; // W
    double right = 0, found = 0;
    for (const along::Sphere& sphere : along::spheres)
        for (int i = 0; i < 50; ++i)
            for (int j = 0; j < 50; ++j) {
                const double x = (i - 24.5) / 25 * along::lamp_half;
                const double z = (j - 24.5) / 25 * along::lamp_half;
                const along::Vec to = sphere.centre - along::Vec{x, 1, z};
                const double square = along::dot(to, to), cosine = -along::unit(to).y;
                right += cosine * sphere.radius * sphere.radius / square / 2500;
            }
    along::Random random{mix_bits(ljus_test::test_seed(1))};
    for (const along::Photon& photon : along::trace_caustics(30000, random))
        found += photon.flux.x;
    CHECK(found == doctest::Approx(right * flux).epsilon(0.005));
}
