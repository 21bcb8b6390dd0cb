#pragma once

/// \file footprint/report.hpp
/// \brief What each program of the footprint says: its counters and its picture.

#include <cstdint>
#include <cstdio>
#include <cstring>

#include "ljus/render/render.hpp"

/// How many bytes a map takes, but for its own few.
template <typename Map>
std::size_t bytes_of(const Map& map) {
    return map.tree.bytes() + map.records.bytes();
}

/// One line that footprint.sh reads: rays, searches, photons searched for, bytes that a
/// stored photon takes, and a hash of the picture.
inline void report(const ljus::RenderedT<float>& rendered, std::size_t photons = 0,
                   std::size_t bytes = 0) {
    std::uint64_t hash = 0xcbf29ce484222325u;
    for (const ljus::Rgb& color : rendered.image.pixels) {
        unsigned char raw[sizeof color];
        std::memcpy(raw, &color, sizeof color);
        for (const unsigned char byte : raw) hash = (hash ^ byte) * 0x100000001b3u;
    }
    const ljus::Counts& counts = rendered.counts;
    std::printf(
        "%llu %llu %zu %zu %016llx\n", static_cast<unsigned long long>(counts.rays()),
        static_cast<unsigned long long>(counts.map_queries), photons,
        photons == 0 ? 0 : bytes / photons, static_cast<unsigned long long>(hash));
}
