/// \file photon_map_file_test.cpp
/// \brief A map comes back byte by byte, and nothing else comes back at all.

#include "ljus/io/photon_map_file.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

#include "scratch_folder.hpp"
#include "support/draws.hpp"

using ljus::Bytes;
using ljus::PhotonMapT;
using ljus::PhotonT;
using ljus_test::Draws;

namespace {

template <typename T>
PhotonMapT<T> some_map(int count) {
    Draws numbers{std::uint64_t(count) + 1};
    std::vector<PhotonT<T>> photons;
    for (int i = 0; i < count; ++i)
        photons.push_back({.position = numbers.point<T>(1),
                           .direction = glm::normalize(numbers.point<T>(1)),
                           .flux = numbers.point<T>(1e-3) + T(1e-3),
                           .light = std::uint16_t(i),
                           .kind = static_cast<ljus::PhotonKind>(i % 4),
                           .normal = ljus::detail::SmallNormal(1, 2, -i % 128)});
    return ljus::make_photon_map(photons);
}

template <typename T>
bool same(const PhotonMapT<T>& a, const PhotonMapT<T>& b) {
    const auto bytes = [](const auto& x, const auto& y) {
        return x.size() == y.size() &&
               (x.empty() ||
                std::memcmp(x.data(), y.data(), x.size() * sizeof(x[0])) == 0);
    };
    if (!bytes(a.tree.blocks(), b.tree.blocks()) ||
        !bytes(a.tree.point_ids(), b.tree.point_ids()) ||
        a.records.size() != b.records.size())
        return false;
    for (std::size_t i = 0; i < a.records.size(); ++i) {
        const auto x = a.records[i];
        const auto y = b.records[i];
        if (x.direction != y.direction || x.flux != y.flux || x.light != y.light ||
            x.kind != y.kind || x.normal != y.normal)
            return false;
    }
    return true;
}

/// What the maps of these tests were made from.
constexpr ljus::MapKey key{.scene = 0x0123456789abcdefu, .settings = 42};

std::string why_not(const std::string& path) {
    try {
        (void)ljus::load_photon_map(path, key);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "it was read";
}

} // namespace

TEST_CASE("photon_map_file: a map comes back, byte by byte") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    for (const int count : {0, 1, 7, 8, 9, 1000, 40000}) {
        const auto map = some_map<float>(count);
        ljus::save_photon_map(path, map, key);
        CHECK(same(map, ljus::load_photon_map(path, key)));
        CHECK(same(map, ljus::load_photon_map(path, key, 40000, 2)));
        CHECK(ljus::load_file(path, 10'000'000).size() == 56 + 42 * std::size_t(count));
    }
    const auto precise = some_map<double>(100);
    ljus::save_photon_map(path, precise, key);
    CHECK(same(precise, ljus::load_photon_map<double>(path, key)));
    CHECK(why_not(path) == "cannot read '" + path +
                               "': its numbers have 8 bytes; those asked for have 4.");
}

TEST_CASE("photon_map_file: a file cut short at any byte is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    ljus::save_photon_map(path, some_map<float>(5), key);
    const Bytes whole = ljus::load_file(path, 10000);
    for (std::size_t size = 0; size < whole.size(); ++size) {
        ljus::save_file(path,
                        Bytes(whole.begin(), whole.begin() + std::ptrdiff_t(size)));
        const std::string why = why_not(path);
        CHECK(why.starts_with("cannot read '" + path + "': it"));
        if (size >= 40)
            CHECK(why == "cannot read '" + path +
                             "': its checksum is wrong, so that it is damaged or cut "
                             "short.");
    }
    Bytes longer = whole;
    longer.push_back(0);
    ljus::save_file(path, longer);
    CHECK(why_not(path) != "it was read");
}

TEST_CASE("photon_map_file: a file with any bit turned over is refused") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    ljus::save_photon_map(path, some_map<float>(3), key);
    const Bytes whole = ljus::load_file(path, 10000);
    for (std::size_t i = 0; i < whole.size(); ++i)
        for (int bit = 0; bit < 8; ++bit) {
            Bytes damaged = whole;
            damaged[i] = static_cast<unsigned char>(damaged[i] ^ 1u << bit);
            ljus::save_file(path, damaged);
            REQUIRE(why_not(path) != "it was read");
        }
}

TEST_CASE("photon_map_file: what is wrong is said in a sentence") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    const std::string cannot = "cannot read '" + path + "': ";
    CHECK(why_not(path) == cannot + "No such file or directory.");
    const std::string text = "P6 this is a picture, and no map of photons at all";
    ljus::save_file(path, Bytes(text.begin(), text.end()));
    CHECK(why_not(path) == cannot + "it does not begin with 'ljus photon map?', so "
                                    "that it is another kind of file.");
    ljus::save_photon_map(path, some_map<float>(3), key);
    const Bytes whole = ljus::load_file(path, 10000);
    Bytes later = whole;
    later[16] = 1;
    ljus::save_file(path, later);
    CHECK(why_not(path) ==
          cannot + "it is of version 1, and this library reads version 2.");
    Bytes damaged = whole;
    damaged[70] = static_cast<unsigned char>(damaged[70] + 1);
    ljus::save_file(path, damaged);
    CHECK(why_not(path) ==
          cannot + "its checksum is wrong, so that it is damaged or cut short.");
    // More photons than one wants to have.
    ljus::save_file(path, whole);
    CHECK_THROWS_AS((void)ljus::load_photon_map(path, key, 2), std::runtime_error);
    // A huge number of photons takes no memory before it is found to be wrong.
    Bytes huge = whole;
    for (std::size_t i = 24; i < 32; ++i) huge[i] = 255;
    ljus::detail::put_checksum(huge);
    ljus::save_file(path, huge);
    CHECK(why_not(path).starts_with(cannot + "it says that it holds"));
}

TEST_CASE(
    "photon_map_file: photons that no map would take are refused, checksum or not") {
    const ScratchFolder folder;
    const std::string path = folder.file("a.map");
    ljus::save_photon_map(path, some_map<float>(3), key);
    const Bytes whole = ljus::load_file(path, 10000);
    const auto with = [&](std::size_t at, std::initializer_list<int> values) {
        Bytes bytes = whole;
        for (const int value : values) bytes[at++] = static_cast<unsigned char>(value);
        ljus::detail::put_checksum(bytes);
        ljus::save_file(path, bytes);
        return why_not(path);
    };
    const std::string cannot = "cannot read '" + path + "': ";
    CHECK(with(56, {0, 0, 128, 127}) == cannot + "it has a photon that is not finite.");
    for (int number = 0; number < 9; ++number) // of position, direction and flux
        for (const int sign : {0, 128})
            CHECK(with(56 + 4 * std::size_t(number), {0, 0, 128, sign + 127}) ==
                  cannot + "it has a photon that is not finite.");
    CHECK(with(56 + 38, {4}) == cannot + "it has a photon of kind 4.");
    CHECK(with(56 + 38, {3}) == "it was read");
    CHECK(with(24, {4}) == cannot +
                               "it says that it holds 4 photons, which does not go "
                               "with its 182 bytes.");
    CHECK(with(24, {2}).starts_with(cannot + "it says that it holds 2 photons"));
    Bytes longer = whole;
    longer.push_back(0);
    ljus::detail::put_checksum(longer);
    ljus::save_file(path, longer);
    CHECK(why_not(path).starts_with(cannot + "it says that it holds 3 photons"));
    Bytes no_key(whole.begin(), whole.begin() + 50);
    ljus::detail::put_checksum(no_key);
    ljus::save_file(path, no_key);
    CHECK(why_not(path) == cannot + "it ends in the middle of its key.");
    // No photon, but a key.
    ljus::save_photon_map(path, some_map<float>(0), key);
    CHECK(why_not(path) == "it was read");
    CHECK(ljus::detail::map_limit(3, 38) == 56 + 3 * 38);
    CHECK(ljus::detail::map_limit(std::numeric_limits<std::size_t>::max(), 38) ==
          std::numeric_limits<std::size_t>::max());
}

TEST_CASE("photon_map_file: a save that fails leaves the older file as it was") {
    const ScratchFolder folder;
    CHECK_THROWS_AS(
        ljus::save_photon_map(folder.file("nowhere/a.map"), some_map<float>(3), key),
        std::runtime_error);
}

TEST_CASE("photon_map_file: the limit of a file's bytes, and none without one") {
    constexpr std::size_t all = static_cast<std::size_t>(-1);
    CHECK(ljus::detail::map_limit(3, 42) == 56 + 3 * 42);
    CHECK(ljus::detail::map_limit(0, 42) == 56);
    CHECK(ljus::detail::map_limit(all, 42) == all);
    CHECK(ljus::detail::map_limit(all / 42, 42) == all);
    // The header counts, too: never beyond what a number holds, and so less again.
    for (const std::size_t bytes : {1u, 8u, 24u, 38u, 42u, 96u})
        for (std::size_t below = 0; below < 60; ++below) {
            const std::size_t most = all / bytes - below;
            CHECK(ljus::detail::map_limit(most, bytes) >= most);
        }
}
