#pragma once

/// \file ljus/photons/irradiance_settings.hpp
/// \brief Settings of irradiance points.

#include <cmath>
#include <cstddef>

#include "ljus/math/require.hpp"
#include "ljus/photons/irradiance_estimate.hpp"

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
    /// radius of a disc that typically contains `nearest` photons.
    float radius = 0;
    /// Number of shadow rays per light and lookup point, at least 1.
    int shadow_rays = 4;
    /// If the map has fewer indirect photons than this, gather rays use no lookup
    /// points and continue as paths.
    int least = 0;
    bool edges = true; ///< Whether an estimate is divided by part_on_surface().
};

/// Checks the settings.
/// \throws std::invalid_argument  if a setting is out of range.
[[gnu::cold]] inline void check(const IrradiancePointSettings& settings) {
    require_at_least("irradiance.every", settings.every, 2);
    require(settings.nearest >= 2 && settings.nearest <= max_nearest,
            "irradiance.nearest", static_cast<long long>(settings.nearest),
            "within [2, 512] (one photon sets the radius)");
    require(settings.radius >= 0 && std::isfinite(settings.radius), "irradiance.radius",
            double(settings.radius), "at least 0 (0: chosen from the photons)");
    require_at_least("irradiance.shadow_rays", settings.shadow_rays, 1);
    require_at_least("irradiance.least", settings.least, 0);
}

/// \}

} // namespace ljus
