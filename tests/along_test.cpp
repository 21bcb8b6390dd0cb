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

#include <ljus/inspect/block_statistics.hpp>
#include <ljus/ljus.hpp>

#include "support/seed.hpp"

namespace along {
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wreturn-type" // main() is no main function here
#include "along/12_caustic.cpp"
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
    const Vec3 x{2, 0, 0}, y{0, 2, 0}, z{0, 0, 4}, corner{-1, -1, -1};
    scene.add(Quad{corner, z, x}, white);
    scene.add(Quad{corner + y, x, z}, white);
    scene.add(Quad{corner, x, y}, white);
    scene.add(Quad{corner + z, y, x}, white);
    scene.add(Quad{corner, y, z}, red);
    scene.add(Quad{corner + x, z, y}, blue);
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

// 75 differences of two means of 8: beyond 6 standard errors (Student's t with 14 degrees
// of freedom) with a chance of 75 * 3e-5, once in 440 seeds. The further 4 % are for what
// the program's photons blur at the ends of gather rays, mostly along edges of the room.
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
