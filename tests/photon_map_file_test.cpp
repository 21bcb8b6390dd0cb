// concept: photon_map
/// \file photon_map_file_test.cpp
/// \brief Photon maps in files: the same searches, and what is refused.

#include "ljus/io/photon_map_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <optional>
#include <stdexcept>

#include "ljus/photons/irradiance_estimate.hpp"
#include "scratch_folder.hpp"
#include "support/draws.hpp"
#include "support/refusal.hpp"

#if __has_include(<sys/mman.h>)

using namespace ljus;

namespace {

/// Photons on a floor.
PhotonMap rain(int count) {
    ljus_test::Draws numbers{7};
    std::vector<Photon> photons;
    for (int i = 0; i < count; ++i)
        photons.push_back(
            {.position{float(numbers.between(-1, 1)), float(numbers.between(-1, 1)), 0},
             .direction{0, 0, -1},
             .flux = Rgb{float(i + 1)},
             .light = std::uint16_t(i % 3),
             .kind = PhotonKind(i % 4),
             .normal{0, 0, 127}});
    return make_photon_map(photons);
}

bool same(const PhotonMap& a, const PhotonMap& b) {
    const auto all_a = detail::arrays_of(a), all_b = detail::arrays_of(b);
    for (std::size_t i = 0; i < all_a.size(); ++i)
        if (!std::ranges::equal(all_a[i], all_b[i])) return false;
    return a.tree.size() == b.tree.size() && a.records.size() == b.records.size();
}

/// The light near a place.
Rgb estimate(const PhotonMap& map) {
    SurfacePoint floor;
    floor.position = {0.1f, 0.2f, 0};
    floor.normal = {0, 0, 1};
    return estimate_irradiance(map, floor, floor.normal, {.radius = 0.5f});
}

std::string why_not(const std::string& path, const PhotonMapFileSettings& how = {}) {
    return ljus_test::refusal<std::runtime_error>(
        [&] { (void)open_photon_map(path, how); }, "it was opened");
}

} // namespace

TEST_CASE("photon_map_file: it comes back, bit by bit, and is searched in the file") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.photons");
    // Without nodes, with one level of them, and with several.
    for (const int count : {0, 1, 8, 33, 500, 100000}) {
        const PhotonMap map = rain(count);
        save_photon_map(path, map, 5);
        PhotonMap back = open_photon_map(path, {.key = 5});
        CHECK(same(back, map));
        CHECK(same(open_photon_map(path, {.key = 5, .check = false}), map));
        CHECK(estimate(back) == estimate(map));
        CHECK(back.empty() == (count == 0));
        // What it is moved to keeps the file; a copy needs none.
        PhotonMap moved = std::move(back);
        const PhotonMap copy = moved;
        if (count > 0)
            REQUIRE(copy.records.blocks().data() != moved.records.blocks().data());
        CHECK(same(moved, map));
        save_photon_map(path, {}); // replaces the file, and does not change it
        CHECK(same(moved, map));
        moved = PhotonMap{};
        CHECK(moved.empty());
        CHECK(same(copy, map));
    }
    CHECK(folder.count() == 1);
}

TEST_CASE("photon_map_file: no byte between the numbers of a record is left over") {
    const PhotonMap map = rain(4001);
    for (const auto& block : map.records.blocks())
        for (const std::uint32_t unused : block.unused) REQUIRE(unused == 0);
}

TEST_CASE(
    "photon_map_file: a file cut short, damaged or of something else is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.photons");
    const std::string cannot = "cannot read '" + path + "': ";
    const std::string damaged = cannot + "its checksum is wrong: it is damaged.";
    const PhotonMap map = rain(500);
    save_photon_map(path, map);
    const Bytes whole = load_file(path, 1 << 20);
    for (const std::size_t size :
         {0u, 1u, 15u, 16u, 17u, 39u, 40u, 65535u, 65536u, 70000u}) {
        save_file(path, Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
        REQUIRE(why_not(path).starts_with(cannot));
        REQUIRE(why_not(path, {.check = false}).starts_with(cannot));
    }
    for (const std::ptrdiff_t by : {-1, 1}) {
        Bytes bytes = whole;
        bytes.resize(std::size_t(std::ptrdiff_t(whole.size()) + by));
        save_file(path, bytes);
        CHECK(why_not(path) ==
              cannot + "it declares 500 photons, which does not match its " +
                  std::to_string(bytes.size()) + " bytes.");
    }
    const auto changed = [&](std::size_t place, int value) {
        Bytes bytes = whole;
        bytes[place] = static_cast<unsigned char>(value);
        save_file(path, bytes);
        return why_not(path);
    };
    CHECK(changed(0, 'L').starts_with(cannot + "it does not begin with 'ljus photon"));
    CHECK(changed(16, 2) == cannot + "its version is 2; this library reads version 1.");
    CHECK(changed(23, 255).starts_with(cannot + "it declares 4278190580 photons"));
    CHECK(changed(24, 1).starts_with(cannot + "it was made of another scene"));
    CHECK(changed(32, whole[32] ^ 1) == damaged);
    const auto sizes = detail::MapSizes::of(500);
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t first = sizes.places()[i];
        const std::size_t last = first + sizes.bytes()[i] - 1;
        for (const std::size_t place : {first, (first + last) / 2, last})
            for (const int bit : {1, 128})
                REQUIRE(changed(place, whole[place] ^ bit) == damaged);
    }
    CHECK(why_not(folder.file("none")).ends_with("No such file or directory."));
    CHECK(why_not(folder.path.string()).ends_with("it is not a file."));
    CHECK_THROWS_AS(save_photon_map(folder.file("nowhere/a"), map), std::runtime_error);
}

TEST_CASE("photon_map_file: photons that no map has are refused, checksum or not") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.photons");
    const PhotonMap map = rain(500); // the last block has four
    save_photon_map(path, map);
    const Bytes whole = load_file(path, 1 << 20);
    const auto places = detail::MapSizes::of(500).places();
    // Saves numbers in place of others, with the checksum that belongs to them.
    const auto with = [&](std::size_t place, auto number) {
        Bytes bytes = whole;
        const auto put = [&](std::size_t at, auto value) {
            const auto raw = detail::bytes_of(value);
            std::copy(raw.begin(), raw.end(), bytes.begin() + std::ptrdiff_t(at));
        };
        put(place, number);
        save_file(path, bytes);
        const PhotonMap wrong = open_photon_map(path, {.check = false});
        put(detail::checksum_place,
            detail::map_checksum(Bytes(bytes.begin(), bytes.begin() + 40), wrong, 1));
        save_file(path, bytes);
        return why_not(path);
    };
    const auto says = [&](int first) {
        return "cannot read '" + path + "': one of its photons " +
               std::to_string(first) + " to " + std::to_string(first + 7) +
               " is not valid.";
    };
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    constexpr float infinity = std::numeric_limits<float>::infinity();
    CHECK(with(places[0], nan) == "it was opened"); // a box that no search enters
    CHECK(with(places[1] + 2 * 96 + 4, infinity) == says(16));
    CHECK(with(places[1] + 62 * 96 + 3 * 4, nan) == says(496));
    CHECK(with(places[1] + 62 * 96 + 4 * 4, 0.5f) == says(496)); // a 501st
    CHECK(with(places[2] + 9 * 4, std::uint32_t(500)) == says(8));
    CHECK(with(places[2] + 9 * 4, std::uint32_t(499)) == "it was opened");
    const std::size_t record = places[3] + 3 * 256;
    CHECK(with(record + 5 * 4, 0.2f) == says(24));                    // a direction
    CHECK(with(record + 96 + 5 * 4, nan) == says(24));                // flux
    CHECK(with(places[3] + 62 * 256 + 96 + 7 * 4, nan) == says(496)); // of none
    for (const std::uint32_t kind : {0u, 3u, 32u})
        CHECK(with(record + 208 + 5 * 4, kind << 24) == says(24));
    for (const std::uint32_t kind : {1u, 16u})
        CHECK(with(record + 208 + 5 * 4, kind << 24) == "it was opened");
}

#endif
