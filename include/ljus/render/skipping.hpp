#pragma once

/// \file ljus/render/skipping.hpp
/// \brief The ability of a photon mapper to omit rays that photons make unnecessary.

#include "ljus/photons/verdict_grid.hpp"
#include "ljus/render/photon_mapping.hpp"

namespace ljus {

/// \addtogroup shadow_photons
/// \{

/// The ability that PhotonMappingSettings::skip needs.
struct Skipping {
    /// The data that a mapper keeps for skipping.
    template <std::floating_point T>
    struct State {
        VerdictGridT<T> verdicts{}; ///< Which rays to omit; empty unless requested.
    };
};

/// The verdicts on the lights at a vertex, for sample_all_lights().
/// \param mapper  A PhotonMapper with the ability Skipping; must outlive the result.
/// \param vertex  The surface.
template <typename Mapper, std::floating_point T>
[[nodiscard]] auto verdicts_of(const Mapper& mapper,
                               const VertexT<T>& vertex) noexcept {
    return detail::verdicts_at(mapper.template state<Skipping>().verdicts, vertex);
}

/// Whether to omit the indirect ray of a vertex, because no indirect photon is near.
/// \param mapper  A PhotonMapper with the ability Skipping.
/// \param vertex  The surface.
/// \param counts  Counts the ray that is not sent.
template <typename Mapper, std::floating_point T>
[[nodiscard]] bool needs_no_bounce(const Mapper& mapper, const VertexT<T>& vertex,
                                   Counts& counts) noexcept {
    const VerdictGridT<T>& grid = mapper.template state<Skipping>().verdicts;
    if (!grid.dark_known || grid.indirect_near(detail::cell_of(grid, vertex)))
        return false;
    ++counts.skipped_bounces;
    return true;
}

/// \}

} // namespace ljus
