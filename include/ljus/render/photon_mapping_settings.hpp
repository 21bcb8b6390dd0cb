#pragma once

/// \file ljus/render/photon_mapping_settings.hpp
/// \brief The settings of the report's renderer.

#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/photon_pass.hpp"
#include "ljus/photons/shadow_verdict.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// Where light that has met two diffuse surfaces comes from.
enum class IndirectLight : std::uint8_t {
    rays,    ///< Indirect rays, on and on.
    map,     ///< One indirect ray, and the general map where it ends.
    photons, ///< The general map's indirect photons where the camera looks: no indirect
             ///< ray and little noise, but their light is blurred by the radius.
    none     ///< Nowhere: direct light and caustics only.
};

/// How the report's renderer works. Lengths are in scene units.
struct PhotonMappingSettings {
    int max_depth = 1000;     ///< Surfaces on a camera path, mirrors and glass counted.
    int roulette_depth = 4;   ///< From this surface on, roulette may end a path.
    int shadow_rays = 1;      ///< Shadow rays to each light, at least 1.
    bool split_glass = false; ///< At glass before anything matt, go both ways.
    IndirectLight indirect = IndirectLight::rays; ///< Who carries indirect light.
    PhotonPassSettings caustics{}; ///< Photons aimed at mirrors and glass.
    PhotonPassSettings general{};  ///< Photons for all the rest.
    DensityEstimateSettings caustics_estimate{}; ///< How caustics are estimated.
    DensityEstimateSettings general_estimate{
        .radius = 0.3f}; ///< How the general map is asked.
    SkipSettings skip{}; ///< Which rays photons make needless; none, unless asked for.
    bool keep_general_map =
        false; ///< Make the general map, even if no ray will ask it.
};

/// Refuses settings that give no picture.
/// \param settings  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const PhotonMappingSettings& settings) {
    require(settings.max_depth >= 1, "max_depth",
            static_cast<long long>(settings.max_depth), "at least 1");
    require(settings.shadow_rays >= 1, "shadow_rays",
            static_cast<long long>(settings.shadow_rays), "at least 1");
    require(settings.caustics.photons >= 0, "caustics.photons",
            settings.caustics.photons, "at least 0");
    require(settings.general.photons >= 0, "general.photons", settings.general.photons,
            "at least 0");
    check(settings.caustics_estimate);
    check(settings.general_estimate);
    check(settings.skip);
}

/// \}

} // namespace ljus
