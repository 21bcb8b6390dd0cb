#pragma once

/// \file ljus/path/counts.hpp
/// \brief What a picture cost, in rays and photons.

#include <cstdint>

namespace ljus {

/// \defgroup counts Counts
/// \brief What the renderers count: the same on every machine.
/// \{

/// Rays and photons of a rendering.
struct Counts {
    std::uint64_t camera_rays = 0;     ///< Primary rays.
    std::uint64_t bounce_rays = 0;     ///< Reflected, refracted and indirect rays.
    std::uint64_t shadow_rays = 0;     ///< Rays to lights.
    std::uint64_t map_queries = 0;     ///< Estimates asked of a photon map.
    std::uint64_t map_photons = 0;     ///< Photons summed in them.
    std::uint64_t skipped_rays = 0;    ///< Shadow rays that photons have made needless.
    std::uint64_t skipped_bounces = 0; ///< Indirect rays left out where it is dark.
    std::uint64_t rejected = 0;        ///< Samples that were not finite and left out.
    std::uint64_t cut_paths =
        0; ///< Ended by the limit of depth: their light is missing.

    /// All rays.
    [[nodiscard]] constexpr std::uint64_t rays() const noexcept {
        return camera_rays + bounce_rays + shadow_rays;
    }

    /// Adds another account.
    constexpr Counts& operator+=(const Counts& other) noexcept {
        camera_rays += other.camera_rays;
        bounce_rays += other.bounce_rays;
        shadow_rays += other.shadow_rays;
        map_queries += other.map_queries;
        map_photons += other.map_photons;
        skipped_rays += other.skipped_rays;
        skipped_bounces += other.skipped_bounces;
        rejected += other.rejected;
        cut_paths += other.cut_paths;
        return *this;
    }
};

namespace detail {

/// Counts a path that is cut, if it is.
/// \param cut     Whether the limit of depth ends it.
/// \param counts  Gets one more.
/// \return `cut`.
constexpr bool cut_if(bool cut, Counts& counts) noexcept {
    counts.cut_paths += cut ? 1u : 0u;
    return cut;
}

} // namespace detail

/// \}

} // namespace ljus
