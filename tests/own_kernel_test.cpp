/// \file own_kernel_test.cpp
/// \brief The kernel of examples/own_kernel.hpp: normalised, and right on a floor.

#include "own_kernel.hpp"

#include <doctest/doctest.h>

#include <vector>

#include "ljus/materials/lambertian.hpp"
#include "ljus/photons/density_estimate.hpp"

using ljus::Photon, ljus::Rgb, ljus::Vec3;
using reader::Hann;

static_assert(ljus::KernelLike<Hann>);

namespace {
struct Forgetful {}; // the same without its factor
float kernel_weight(Forgetful, float x) {
    return 1 + std::cos(std::numbers::pi_v<float> * std::sqrt(x));
}

// It loses half of the light.
struct Swallowing {};
float kernel_weight(Swallowing, float x) {
    return 1 - x;
}

// A hill of the volume 1 - exp(-30), within a fifth of the radius.
struct Narrow {};
float kernel_weight(Narrow, float x) {
    return 30 * std::exp(-30 * x);
}
} // namespace

TEST_CASE("own kernel: its mean over the disc is 1, and nowhere is it negative") {
    double mean = 0, last = 10;
    constexpr int rings = 100000;
    for (int i = 0; i < rings; ++i) {
        const double weight = double(kernel_weight(Hann{}, (float(i) + 0.5f) / rings));
        mean += weight / rings;
        REQUIRE(weight >= 0);
        REQUIRE(weight <= last + 1e-6); // it falls with the distance
        last = weight;
    }
    CHECK(mean == doctest::Approx(1).epsilon(1e-4));
    CHECK(kernel_weight(Hann{}, 1.0f) == doctest::Approx(0).epsilon(1e-6));
}

TEST_CASE("own kernel: the library refuses one that makes light") {
    CHECK_NOTHROW(check(ljus::DensityEstimateOf<Hann>{}));
    CHECK_THROWS_AS(check(ljus::DensityEstimateOf<Forgetful>{}), std::invalid_argument);
    CHECK_THROWS_AS(check(ljus::DensityEstimateOf<Swallowing>{}),
                    std::invalid_argument);
    // A narrow hill: by the inner borders of the rings its mean would be 1.5 % too
    // large.
    CHECK_NOTHROW(check(ljus::DensityEstimateOf<Narrow>{}));
}

TEST_CASE("own kernel: an even floor has the radiance of its photons") {
    // 3 W per unit of area on a fine grid: albedo / pi times that.
    std::vector<Photon> photons;
    constexpr int n = 300;
    for (int i = 0; i < n * n; ++i)
        photons.push_back({.position{-1 + 2 * (float(i % n) + 0.5f) / n,
                                     -1 + 2 * (float(int(i / n)) + 0.5f) / n, 0},
                           .direction{0, 0, -1},
                           .flux = Rgb{12.0f / (n * n)}});
    const auto map = ljus::make_photon_map(photons);
    ljus::VertexT<float> surface{};
    surface.point.normal = {0, 0, 1};
    surface.frame = ljus::frame_around(surface.point.normal);
    std::uint64_t found = 0;
    const Rgb seen = estimate_radiance(
        map, surface, ljus::Lambertian{.albedo = Rgb{0.5f}}, Vec3{0, 0, 1},
        ljus::DensityEstimateOf<Hann>{.radius = 0.3f}, ljus::all_kinds, found);
    CHECK(double(seen.x) == doctest::Approx(0.5 / std::numbers::pi * 3).epsilon(0.005));
    CHECK(found > 1000);
}
