#pragma once

/// \file examples/common/picture_cost.hpp
/// \brief Prints the cost of a picture and of its photon maps, and writes it to the
/// file beside the picture.

#include <algorithm>
#include <cinttypes>
#include <cstdio>
#include <vector>

#include <nlohmann/json.hpp>

#include "ljus/inspect/census.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/render/gathering.hpp"
#include "ljus/render/passes.hpp"

namespace examples {

/// The cost of a picture as JSON, for the file beside it.
[[nodiscard]] inline nlohmann::ordered_json cost_json(const ljus::Counts& counts,
                                                      double seconds) {
    return {{"seconds", seconds},
            {"camera_rays", counts.camera_rays},
            {"bounce_rays", counts.bounce_rays},
            {"shadow_rays", counts.shadow_rays},
            {"map_queries", counts.map_queries},
            {"skipped_rays", counts.skipped_rays},
            {"skipped_bounces", counts.skipped_bounces},
            {"rejected", counts.rejected},
            {"cut_paths", counts.cut_paths}};
}

/// Prints the cost of a picture on the terminal.
inline void print_cost(const ljus::Counts& counts, double seconds) {
    const auto over = [](auto a, auto b) { return double(a) / double(b); };
    std::printf("  %-16s %8.2f s  %" PRIu64
                " rays, %.2f per sample, %.2f million/s\n  %-16s %10s  %" PRIu64
                " from the camera, %" PRIu64 " bounces, %" PRIu64 " to lights\n",
                "render", seconds, counts.rays(),
                over(counts.rays(), counts.camera_rays),
                over(counts.rays(), seconds) * 1e-6, "", "", counts.camera_rays,
                counts.bounce_rays, counts.shadow_rays);
    if (counts.map_queries > 0)
        std::printf("  %-16s %10s  %.2f map queries per sample, %.1f photons each\n",
                    "", "", over(counts.map_queries, counts.camera_rays),
                    over(counts.map_photons, counts.map_queries));
    if (counts.skipped_rays + counts.skipped_bounces > 0)
        std::printf("  %-16s %10s  skipped: %.1f %% of the rays to lights, %" PRIu64
                    " bounces\n",
                    "", "",
                    100 * over(counts.skipped_rays,
                               std::max<std::uint64_t>(
                                   counts.skipped_rays + counts.shadow_rays, 1)),
                    counts.skipped_bounces);
    if (counts.rejected > 0)
        std::printf("  %-16s %10s  %" PRIu64
                    " samples were not finite and are left out\n",
                    "", "", counts.rejected);
    if (counts.cut_paths > 0)
        std::printf("  %-16s %10s  %" PRIu64
                    " paths were cut at --depth; their further light is missing\n",
                    "", "", counts.cut_paths);
}

/// Prints the settings chosen for the caustics, in one line.
/// \param settings  The settings, with the chosen radius, and with the shares of the
///                  objects if there are any.
inline void print_caustics(const ljus::PhotonMappingSettings& settings) {
    const std::vector<double>& shares = settings.caustics.shares;
    std::printf("  %-16s %10s  radius %.3g", "caustics", "",
                double(settings.caustics_estimate.radius));
    for (std::size_t i = 0; i < shares.size() && i < 12; ++i)
        std::printf("%s%.3g", i == 0 ? "; shares of the photons: " : ", ", shares[i]);
    std::printf("%s\n", shares.size() > 12 ? ", ..." : "");
}

/// Prints how long the photon maps took, and what each of them has, in one line each.
/// \param mapper   A PhotonMapper that can gather, with its irradiance cache.
/// \param seconds  The time of all of them.
template <typename Mapper>
void print_maps(const Mapper& mapper, double seconds) {
    const ljus::Passes& passes = mapper.passes();
    const auto& maps = mapper.maps();
    const auto& cache = mapper.template state<ljus::Gathering>().cache;
    const auto print_map = [](const char* name, const auto& map, long long emitted) {
        std::printf("  %-16s %10s  %lld photons emitted; kept:", name, "", emitted);
        const ljus::PhotonCensus kept = census(map);
        using enum ljus::PhotonKind;
        for (const auto kind : {direct, caustic, indirect, shadow})
            if (kept[kind].photons > 0)
                std::printf(" %" PRIu64 " %s", kept[kind].photons, name_of(kind));
        std::printf("\n");
    };
    std::printf("  %-16s %8.2f s\n", "photon maps", seconds);
    if (passes.caustics_map) {
        print_map("caustics map", maps.caustics, mapper.settings().caustics.photons);
        print_caustics(mapper.settings());
    }
    if (passes.general_map)
        print_map("general map", maps.general, mapper.settings().general.photons);
    if (passes.volume_map)
        std::printf("  %-16s %10s  %zu photons stored\n", "volume map", "",
                    maps.fog_caustics.photons.size() + maps.fog.photons.size());
    if (passes.cache)
        std::printf("  %-16s %10s  %zu points, %" PRIu64 " gather rays\n",
                    "irradiance cache", "", cache.records.size(),
                    cache.counts.bounce_rays);
}

} // namespace examples
