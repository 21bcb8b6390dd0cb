#pragma once

/// \file ljus/photons/irradiance_settings.hpp
/// \brief Settings of irradiance points.

#include <cstddef>

#include "ljus/version.hpp"

namespace ljus {

/// \addtogroup irradiance_points
/// \{

/// Settings of precomputed irradiance.
struct IrradiancePointSettings {
    /// The n for which every n-th photon becomes a lookup point; at least 2. Estimates
    /// leave out these photons.
    int every = 6;
    std::size_t nearest = 32; ///< Number of photons per estimate, 2 to 512.
    /// Largest radius of an estimate, in scene units. 0 stands for four times the
    /// typical radius of `nearest` photons.
    float radius = 0;
    /// Number of shadow rays per light and lookup point, at least 1.
    int shadow_rays = 4;
    /// If the map has fewer indirect photons than this, gather rays use no lookup
    /// points and continue as paths.
    int least = 0;
    bool edges = true; ///< Whether an estimate is divided by part_on_surface().
};

/// \}

} // namespace ljus
