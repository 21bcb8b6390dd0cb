#pragma once

/// \file ljus/photons/irradiance_settings.hpp
/// \brief How irradiance is precomputed at photons.

#include <cstddef>

#include "ljus/version.hpp"

namespace ljus {

/// \addtogroup irradiance_points
/// \{

/// How irradiance is precomputed.
struct IrradiancePointSettings {
    int every = 6; ///< Every n-th photon becomes a lookup point, and is left out of the
                   ///< estimates; at least 2.
    std::size_t nearest = 32; ///< Photons of an estimate, 2 to 512.
    float radius = 0; ///< Within which they lie, at most, in scene units; 0: four times
                      ///< as far as they lie typically.
    int shadow_rays = 4; ///< To each light, for the direct part; at least 1.
    bool edges = true;   ///< Divide by the part of the disc that is on the shape.
};

/// \}

} // namespace ljus
