/// \file tests/fuzz/photon_map.cpp
/// \brief Photon maps in files, searched if they are opened; also with the checksum put
/// right.
///
/// A file's arrays begin at multiples of 64 KiB, more than a fuzzer's inputs hold. An
/// input has the header and the arrays one after another, and is taken apart.

#include <algorithm>
#include <cmath>

#include "fuzz.hpp"
#include "ljus/io/photon_map_file.hpp"
#include "ljus/photons/irradiance_estimate.hpp"

namespace {

/// The file of an input; its size is what its number of photons wants, if that is
/// small.
ljus::Bytes file_of(const ljus::Bytes& input) {
    using namespace ljus;
    Bytes file(input.begin(), input.begin() + file_front_bytes);
    const auto points = ljus::detail::number_at<std::uint32_t>(file, 20);
    if (points > 1000) return input;
    const auto sizes = ljus::detail::MapSizes::of(points);
    const auto places = sizes.places();
    file.resize(places[4]);
    std::size_t from = file_front_bytes;
    for (std::size_t i = 0; i < 4; ++i) {
        const std::size_t count = std::min(sizes.bytes()[i], input.size() - from);
        std::copy_n(input.begin() + std::ptrdiff_t(from), count,
                    file.begin() + std::ptrdiff_t(places[i]));
        from += count;
    }
    return file;
}

/// Asks a map whose bytes were checked.
void search(const ljus::PhotonMap& map) {
    using namespace ljus;
    float brightest = 0;
    for (std::size_t i = 0; i < map.records.size(); ++i) {
        const Rgb flux = map.records[i].flux;
        brightest =
            std::max({brightest, std::abs(flux.x), std::abs(flux.y), std::abs(flux.z)});
    }
    const float typical = typical_radius(map, 8);
    fuzz::require_that(typical > 0, "a typical radius is above 0");
    for (std::size_t i = 0; i < std::min<std::size_t>(map.tree.size(), 8); ++i)
        for (const float radius : {1e-3f, 0.5f, 100.0f})
            for (const std::size_t nearest : {0, 2, 20}) {
                const Rgb e = estimate_irradiance(
                    map, SurfacePoint{.position = map.tree.point(i), .normal{0, 1, 0}},
                    Vec3{0, 1, 0},
                    DensityEstimateSettings{.radius = radius, .nearest = nearest},
                    all_kinds);
                if (brightest < 1e20f)
                    fuzz::require_that(is_finite(e), "an irradiance is finite");
            }
}

} // namespace

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace ljus;
    if (size < file_front_bytes) return 0;
    Bytes file = file_of(Bytes(data, data + size));
    const auto open = [&](bool check) {
        const fuzz::MemoryFile in_memory(file);
        fuzz::refused_or_done([&] {
            const PhotonMap map =
                open_photon_map(in_memory.path(), {.check = check, .threads = 1});
            if (check) return search(map);
            const Bytes front(file.begin(), file.begin() + file_front_bytes);
            const auto sum =
                ljus::detail::bytes_of(ljus::detail::map_checksum(front, map, 1));
            std::copy(sum.begin(), sum.end(),
                      file.begin() + ljus::detail::checksum_place);
        });
    };
    open(true);
    open(false);
    open(true);
    return 0;
}
