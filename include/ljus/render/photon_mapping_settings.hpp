#pragma once

/// \file ljus/render/photon_mapping_settings.hpp
/// \brief The settings of the report's renderer.

#include <algorithm>
#include <cmath>

#include "ljus/path/all_lights.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/irradiance_settings.hpp"
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
    gather,  ///< One gather ray, and precomputed irradiance where it ends.
    cache,   ///< Many gather rays at few points, interpolated between them.
    none     ///< Nowhere: direct light and caustics only.
};

namespace detail {

/// Whether paths end at the first diffuse surface behind another: what they gather
/// there stands for all further bounces.
/// \param indirect  Who carries indirect light.
[[nodiscard]] constexpr bool gathers(IndirectLight indirect) noexcept {
    return indirect == IndirectLight::map || indirect == IndirectLight::gather ||
           indirect == IndirectLight::cache;
}

} // namespace detail

/// The most points that an interpolation of the irradiance cache takes.
inline constexpr std::size_t max_cache_nearest = 64;

/// How irradiance is gathered and interpolated.
struct GatherSettings {
    int rays = 25;           ///< Gather rays per point, at least 1.
    int tile = 3;            ///< A point for each square of so many pixels on a side.
    std::size_t nearest = 6; ///< Points that an interpolation takes, 2 to 64.
    float reach = 1;         ///< How far a point counts, over the harmonic mean of the
                             ///< distances of what it sees.
    int max_depth = 100;     ///< Surfaces on a gather ray.
};

/// How the report's renderer works. Lengths are in scene units.
struct PhotonMappingSettings {
    int max_depth = 1000;   ///< Surfaces on a camera path, mirrors and glass counted.
    int roulette_depth = 4; ///< From this surface on, roulette may end a path.
    int shadow_rays = 1;    ///< Shadow rays to each light, at least 1.
    DirectLight direct = DirectLight::sampled; ///< How direct light is found.
    bool split_glass = false; ///< At glass before anything matt, go both ways.
    IndirectLight indirect = IndirectLight::rays; ///< Who carries indirect light.
    PhotonPassSettings caustics{}; ///< Photons aimed at mirrors and glass.
    PhotonPassSettings general{};  ///< Photons for all the rest.
    CausticBudget caustic_budget =
        CausticBudget::as_seen; ///< How mirrors and glass share caustics.photons.
    /// How caustics are estimated; radius 0: one that holds 32 photons typically.
    DensityEstimateSettings caustics_estimate{};
    /// How the general map is asked; radius 0: one that holds 64 photons typically.
    DensityEstimateSettings general_estimate{.radius = 0.3f};
    IrradiancePointSettings irradiance{}; ///< What gather rays look up.
    GatherSettings gather{};              ///< How the irradiance cache is made.
    SkipSettings skip{}; ///< Which rays photons make needless; none, unless asked for.
    bool keep_general_map =
        false; ///< Make the general map, even if no ray will ask it.
};

/// Refuses settings that give no picture.
/// \param settings  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const PhotonMappingSettings& settings) {
    require_at_least("max_depth", settings.max_depth, 1);
    require_at_least("shadow_rays", settings.shadow_rays, 1);
    require_at_least("caustics.photons", settings.caustics.photons, 0);
    require_at_least("general.photons", settings.general.photons, 0);
    require_at_least("irradiance.every", settings.irradiance.every, 2);
    require(settings.irradiance.nearest >= 2 &&
                settings.irradiance.nearest <= max_nearest,
            "irradiance.nearest", static_cast<long long>(settings.irradiance.nearest),
            "within [2, 512] (one photon sets the radius)");
    require(settings.irradiance.radius >= 0 &&
                std::isfinite(settings.irradiance.radius),
            "irradiance.radius", double(settings.irradiance.radius),
            "at least 0 (0: chosen from the photons)");
    require_at_least("irradiance.shadow_rays", settings.irradiance.shadow_rays, 1);
    require_at_least("gather.rays", settings.gather.rays, 1);
    require_at_least("gather.tile", settings.gather.tile, 1);
    require(settings.gather.nearest >= 2 &&
                settings.gather.nearest <= max_cache_nearest,
            "gather.nearest", static_cast<long long>(settings.gather.nearest),
            "within [2, 64]");
    require_positive("gather.reach", settings.gather.reach);
    require_at_least("gather.max_depth", settings.gather.max_depth, 2);
    for (DensityEstimateSettings gather :
         {settings.caustics_estimate, settings.general_estimate}) {
        if (gather.radius == 0) gather.radius = 1; // 0: chosen from the photons later
        check(gather);
    }
    check(settings.skip);
}

/// Settings that go together.
enum class Preset : std::uint8_t {
    draft, ///< A first look: blotches, in a fraction of a second.
    fast,  ///< The least time for a picture without visible errors. What it gives up:
           ///< indirect light that changes within 4 pixels is smoothed, penumbras are
           ///< a little off, caustics blurred, and what glossy surfaces throw onto
           ///< others blurred as they are; and more time does not mend it.
    exact  ///< Indirect rays on and on; what bias is left is that of the caustics map.
};

/// The settings of a preset. Radii are chosen from the photons, and their number from
/// the size of the picture: small pixels show smaller errors.
/// \param preset  Which one.
/// \param width   Of the picture, in pixels.
/// \param height  Of the picture, in pixels.
/// \return All settings; seeds and threads are the caller's.
[[nodiscard]] inline PhotonMappingSettings preset_settings(Preset preset, int width,
                                                           int height) {
    const long long pixels = static_cast<long long>(width) * height;
    PhotonMappingSettings settings{.split_glass = true};
    settings.general.shadow_photons = false;
    settings.caustics_estimate.radius = settings.general_estimate.radius = 0;
    if (preset == Preset::exact) {
        settings.direct = DirectLight::mis;
        settings.caustics.photons = 2'000'000;
        return settings;
    }
    settings.general.numbers = settings.caustics.numbers = PhotonSampling::sobol;
    const bool draft = preset == Preset::draft;
    settings.direct = DirectLight::analytic;
    settings.shadow_rays = draft ? 2 : 4;
    settings.indirect = IndirectLight::cache;
    const long long photons =
        std::clamp(draft ? pixels / 4 : pixels * 7 / 10, 10'000LL, 1'000'000LL);
    // In a small picture blotches are as wide, measured by the picture.
    settings.general.photons = photons + (draft ? 0 : 8000);
    settings.caustics.photons = photons / (draft ? 2 : 1);
    settings.gather.rays = draft ? 16 : 36;
    settings.gather.tile = draft ? 5 : 4;
    if (!draft) settings.irradiance.shadow_rays = 2; // a gather ray is one of 36
    return settings;
}

/// How many rays a preset sends through each pixel.
struct PresetRays {
    int first = 1;             ///< Through all pixels.
    int more = 0;              ///< Through those whose first rays disagree.
    double disagreement = 0.4; ///< Relative standard error that counts as such.
};

/// The rays of a preset, for RenderSettings::samples and render_adaptive().
/// \param preset  Which one.
/// \return The numbers of rays.
[[nodiscard]] inline PresetRays preset_rays(Preset preset) {
    if (preset == Preset::draft) return {.first = 1, .more = 0};
    if (preset == Preset::fast) return {.first = 2, .more = 8};
    return {.first = 64, .more = 0};
}

/// \}

} // namespace ljus
