#pragma once

/// \file ljus/render/skipping.hpp
/// \brief The ability of a photon mapper to leave out rays that photons make needless.

#include "ljus/photons/verdict_grid.hpp"
#include "ljus/render/photon_mapping.hpp"

namespace ljus {

/// \addtogroup shadow_photons
/// \{

/// PhotonMappingSettings::skip: `abilities<Skipping>`.
struct Skipping {
    /// What it keeps.
    template <std::floating_point T>
    struct State {
        VerdictGridT<T> verdicts{}; ///< Which rays can be left out; empty unless asked
                                    ///< for.
    };
};

/// What is known of the lights at a vertex: what sample_all_lights() asks.
/// \param mapper  With Skipping; must outlive what is returned.
/// \param vertex  The surface.
template <typename Mapper, std::floating_point T>
[[nodiscard]] auto verdicts_of(const Mapper& mapper,
                               const VertexT<T>& vertex) noexcept {
    return detail::verdicts_at(mapper.template state<Skipping>().verdicts, vertex);
}

/// Whether a vertex sends no indirect ray, because no indirect photon is near.
/// \param mapper  With Skipping.
/// \param vertex  The surface.
/// \param counts  Counts the ray that is not sent.
template <typename Mapper, std::floating_point T>
[[nodiscard]] bool needs_no_bounce(const Mapper& mapper, const VertexT<T>& vertex,
                                   Counts& counts) noexcept {
    return detail::skips_bounce(mapper.template state<Skipping>().verdicts, vertex,
                                counts);
}

/// \}

} // namespace ljus
