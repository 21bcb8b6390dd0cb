/// \file own_photons_test.cpp
/// \brief The photons of examples/own_photons.hpp: an even floor, whose irradiance is
/// known, by the program's own estimate and by the library's.

#include "own_photons.hpp"

#include <doctest/doctest.h>

using ljus::Rgb, ljus::Vec3;

namespace {
/// 100 x 100 photons on the unit square, 2 W in all; every fourth has bounced once.
std::vector<reader::OwnPhoton> even_floor() {
    std::vector<reader::OwnPhoton> photons;
    for (int i = 0; i < 10000; ++i)
        photons.push_back(
            {.position{(float(i % 100) + 0.5f) / 100, (float(i / 100) + 0.5f) / 100, 0},
             .direction{0.6f, 0, -0.8f},
             .flux = Rgb{2e-4f, 1e-4f, 0},
             .bounces = i % 4 == 0 ? 1 : 0});
    return photons;
}
} // namespace

TEST_CASE("own photons: an even floor has the irradiance that fell on it") {
    const auto photons = even_floor();
    const reader::OwnMap map(photons);
    const ljus::PhotonMap library = reader::library_map(photons);
    REQUIRE(map.sorted.size() == 10000);
    for (std::size_t i = 0; i < map.sorted.size(); i += 97)
        CHECK(map.sorted[i].position == map.tree.point(i));
    const Vec3 up{0, 0, 1}, down{0, 0, -1};
    for (const Vec3& x : {Vec3{0.5f, 0.5f, 0}, Vec3{0.31f, 0.62f, 0}}) {
        const Rgb straight = irradiance(map, x, up, 0.2f, 0);
        const Rgb bounced = irradiance(map, x, up, 0.2f, 1);
        CHECK(straight.x == doctest::Approx(1.5).epsilon(0.01)); // W/m^2
        CHECK(bounced.x == doctest::Approx(0.5).epsilon(0.01));
        CHECK(straight.y == doctest::Approx(0.75).epsilon(0.01));
        CHECK(irradiance(map, x, down, 0.2f, 0) == Rgb{0}); // the dark side
        // The same sum, in another order.
        const Rgb all = reader::irradiance(library, x, up, 0.2f);
        CHECK(all.x == doctest::Approx(double(straight.x + bounced.x)));
        CHECK(reader::irradiance(library, x, down, 0.2f) == Rgb{0});
    }
    // Half of the disc lies beyond the floor's edge.
    CHECK(irradiance(map, {0, 0.5f, 0}, up, 0.2f, 0).x ==
          doctest::Approx(0.75).epsilon(0.02));
    CHECK(irradiance(map, {3, 3, 0}, up, 0.2f, 0) == Rgb{0});
}
