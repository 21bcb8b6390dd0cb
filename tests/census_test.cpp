/// \file census_test.cpp
/// \brief A census against photons that were counted by hand.

#include "ljus/inspect/census.hpp"

#include <doctest/doctest.h>

#include <string>

using ljus::Photon;
using ljus::PhotonKind;
using ljus::Rgb;

TEST_CASE("census: of an empty map every count is 0") {
    const auto nothing = ljus::census(ljus::PhotonMap{});
    for (const auto& count : nothing.kinds) {
        CHECK(count.photons == 0);
        CHECK(count.flux == ljus::RgbT<double>{0});
    }
    CHECK(nothing.light().photons == 0);
}

TEST_CASE("census: kinds are counted apart, and shadow photons are no light") {
    std::vector<Photon> photons;
    const auto add = [&](PhotonKind kind, int count, Rgb flux) {
        for (int i = 0; i < count; ++i)
            photons.push_back({.position{float(photons.size()), 0, 0},
                               .direction{0, 0, -1},
                               .flux = flux,
                               .kind = kind});
    };
    add(PhotonKind::indirect, 3, {1, 2, 3});
    add(PhotonKind::direct, 5, {0.5f, 0, 0});
    add(PhotonKind::shadow, 7, {4, 4, 4});
    add(PhotonKind::caustic, 2, {0, 8, 0});

    for (const auto& found :
         {ljus::census(photons), ljus::census(ljus::make_photon_map(photons))}) {
        CHECK(found[PhotonKind::direct].photons == 5);
        CHECK(found[PhotonKind::caustic].photons == 2);
        CHECK(found[PhotonKind::indirect].photons == 3);
        CHECK(found[PhotonKind::shadow].photons == 7);
        CHECK(found[PhotonKind::direct].flux == ljus::RgbT<double>{2.5, 0, 0});
        CHECK(found[PhotonKind::caustic].flux == ljus::RgbT<double>{0, 16, 0});
        CHECK(found[PhotonKind::indirect].flux == ljus::RgbT<double>{3, 6, 9});
        CHECK(found[PhotonKind::shadow].flux == ljus::RgbT<double>{28, 28, 28});
        CHECK(found.light().photons == 10);
        CHECK(found.light().flux == ljus::RgbT<double>{5.5, 22, 9});
    }
}

TEST_CASE("census: ten million small terms lose nothing") {
    // In float the sum stops growing at 2^24 of them, and is wrong long before.
    const std::vector<Photon> photons(10'000'000, Photon{.flux{0.1f, 0, 1e-9f}});
    const auto found = ljus::census(photons)[PhotonKind::direct];
    CHECK(found.flux.x == doctest::Approx(1e7 * double(0.1f)).epsilon(1e-9));
    CHECK(found.flux.z == doctest::Approx(1e7 * double(1e-9f)).epsilon(1e-9));
}

TEST_CASE("census: each kind has its name") {
    CHECK(std::string(ljus::name_of(PhotonKind::direct)) == "direct");
    CHECK(std::string(ljus::name_of(PhotonKind::caustic)) == "caustic");
    CHECK(std::string(ljus::name_of(PhotonKind::indirect)) == "indirect");
    CHECK(std::string(ljus::name_of(PhotonKind::shadow)) == "shadow");
}
