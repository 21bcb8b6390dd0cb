#pragma once

/// \file ljus/photons/irradiance_settings.hpp
/// \brief Settings of precomputed irradiance.

#include <cstddef>

#include "ljus/version.hpp"

namespace ljus {

/// \addtogroup irradiance_points
/// \{

/// Settings of precomputed irradiance.
struct IrradiancePointSettings {
    int every = 6; ///< Every n-th photon becomes a lookup point and is left out of the
                   ///< estimates; at least 2.
    std::size_t nearest = 32; ///< Photons per estimate, 2 to 512.
    float radius = 0;    ///< Their maximum radius, in scene units; 0: four times their
                         ///< typical radius.
    int shadow_rays = 4; ///< Per light, for direct light; at least 1.
    int least = 0;       ///< Fewest indirect photons of the map: with fewer, no gather
                         ///< ray ends at a point; it goes on as a path does.
    bool edges = true;   ///< Divide by the fraction of the disc on the shape.
};

/// \}

} // namespace ljus
