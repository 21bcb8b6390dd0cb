/// \file tests/fuzz/photon_map.cpp
/// \brief Photon maps in files; the same with key and checksum put right.

#include <algorithm>

#include "fuzz.hpp"
#include "ljus/io/photon_map_file.hpp"
#include "ljus/photons/density_estimate.hpp"

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    ljus::Bytes bytes(data, data + size);
    const auto load = [](const ljus::Bytes& file) {
        const fuzz::MemoryFile in_memory(file);
        fuzz::refused_or_done([&] {
            const auto map = ljus::load_photon_map(in_memory.path(), {}, 10'000, 1);
            for (const ljus::Photon& photon : ljus::detail::photons_of(map))
                fuzz::require_that(ljus::is_finite(photon.position) &&
                                       ljus::is_finite(photon.flux),
                                   "a photon is somewhere and carries something");
        });
    };
    load(bytes);
    if (size < ljus::detail::map_header + ljus::detail::map_key_bytes) return 0;
    std::fill_n(bytes.begin() + 40, ljus::detail::map_key_bytes, std::uint8_t(0));
    ljus::detail::put_checksum(bytes);
    load(bytes);
    return 0;
}
