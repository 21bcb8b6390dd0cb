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
#include "ljus/photons/volume_photons.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// The source of light that has met two diffuse surfaces.
enum class IndirectLight : std::uint8_t {
    rays,    ///< Indirect rays at every bounce.
    map,     ///< One indirect ray, and the general map where it ends.
    photons, ///< Indirect photons at the surface itself, without indirect rays: little
             ///< noise, but blurred by the radius.
    gather,  ///< One gather ray, and precomputed irradiance where it ends.
    cache,   ///< Many gather rays at few points, interpolated between them.
    none     ///< None: direct light and caustics only.
};

namespace detail {

/// Whether paths end at the second diffuse surface: a lookup there replaces all further
/// bounces.
/// \param indirect  The source of indirect light.
[[nodiscard]] constexpr bool gathers(IndirectLight indirect) noexcept {
    return indirect == IndirectLight::map || indirect == IndirectLight::gather ||
           indirect == IndirectLight::cache;
}

} // namespace detail

/// The largest number of points in an interpolation of the irradiance cache.
inline constexpr std::size_t max_cache_nearest = 64;

/// How irradiance is gathered and interpolated.
struct GatherSettings {
    int rays = 25;           ///< Gather rays per point, at least 1.
    int tile = 3;            ///< Side of the square of pixels for each point.
    std::size_t nearest = 6; ///< Points in an interpolation, 2 to 64.
    float reach = 1;     ///< Largest distance of a point that is used, as a multiple
                         ///< of the harmonic mean length of its gather rays.
    int max_depth = 100; ///< Surfaces on a gather ray.
};

/// Settings of the report's renderer. Lengths are in scene units.
struct PhotonMappingSettings {
    int max_depth = 1000;   ///< Surfaces on a camera path, mirrors and glass counted.
    int roulette_depth = 4; ///< From this surface on, roulette may end a path.
    int shadow_rays = 1;    ///< Shadow rays to each light, at least 1.
    DirectLight direct = DirectLight::sampled; ///< How direct light is found.
    bool split_glass = false; ///< Split paths at glass before the first matt surface.
    IndirectLight indirect = IndirectLight::rays; ///< Source of indirect light.
    PhotonPassSettings caustics{}; ///< Photons aimed at mirrors and glass.
    PhotonPassSettings general{};  ///< Photons for all other light.
    CausticBudget caustic_budget =
        CausticBudget::as_seen; ///< How mirrors and glass share caustics.photons.
    /// Whether a pilot measures how much of each light arrives, and the lights share
    /// caustics.photons by that, even with CausticBudget::as_seen. The pilot takes at
    /// most a quarter of the photons. Works with Budgeting only.
    bool share_lights = false;
    /// How caustics are estimated. With radius 0 the mapper chooses a radius for which
    /// a disc typically holds 32 photons.
    DensityEstimateSettings caustics_estimate{};
    /// The radius of the disc of a lone caustic photon, see lone_photons(), over that
    /// of all others. With 1 a lone photon is as any other; so it is with k nearest.
    float lone_radius = 1;
    /// How the general map is queried. With radius 0 the mapper chooses a radius for
    /// which a disc typically holds 64 photons.
    DensityEstimateSettings general_estimate{.radius = 0.3f};
    BeamEstimateSettings fog_estimate{};  ///< How photons in fog are spread.
    IrradiancePointSettings irradiance{}; ///< Points that gather rays look up.
    GatherSettings gather{};              ///< How the irradiance cache is made.
    SkipSettings skip{}; ///< Rays that photons make unnecessary; none by default.
    bool keep_general_map = false; ///< Make the general map even if no ray queries it.
};

/// Refuses settings that give no picture.
/// \param settings  The settings.
/// \throws std::invalid_argument  with name and value.
[[gnu::cold]] inline void check(const PhotonMappingSettings& settings) {
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
    require_at_least("irradiance.least", settings.irradiance.least, 0);
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
    require(settings.lone_radius >= 1 && settings.lone_radius <= 1000, "lone_radius",
            double(settings.lone_radius), "within [1, 1000]");
    check(settings.skip);
    check(settings.fog_estimate);
}

namespace detail {

/// How lone photons are estimated.
[[nodiscard]] inline DensityEstimateSettings
lone_estimate(const PhotonMappingSettings& settings) noexcept {
    DensityEstimateSettings wide = settings.caustics_estimate;
    wide.radius *= settings.lone_radius;
    return wide;
}

} // namespace detail

/// Settings for a purpose.
enum class Preset : std::uint8_t {
    draft, ///< A first look: blotches, in a fraction of a second.
    fast,  ///< Least time without visible errors. It has bias that more time does not
           ///< remove: indirect light is smoothed over 4 pixels, so that dark corners
           ///< are too bright, by 10 % or more within 8 pixels; penumbras are slightly
           ///< wrong, and caustics and reflections from gloss are blurred. In
           ///< random scenes a ninth of the picture is off by 5 % or less.
    exact  ///< Indirect rays at every bounce; only the caustics map is biased.
};

/// The settings of a preset. The number of photons depends on the size of the picture,
/// because smaller pixels show smaller errors; radii are chosen from the photons.
/// \param preset  Which one.
/// \param width   Width of the picture, in pixels.
/// \param height  Height of the picture, in pixels.
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
    settings.share_lights = true;
    settings.lone_radius = 4;
    const long long photons =
        std::clamp(draft ? pixels / 4 : pixels * 7 / 10, 10'000LL, 1'000'000LL);
    // Small pictures need more photons per pixel: blotches scale with the picture.
    settings.general.photons = draft ? photons : photons * 6 / 10 + 8000;
    settings.caustics.photons = photons / (draft ? 2 : 1);
    settings.gather.rays = draft ? 16 : 36;
    settings.gather.tile = draft ? 5 : 4;
    if (!draft) { // a gather ray is one of 36
        settings.irradiance.shadow_rays = 2;
        settings.irradiance.every = 8;
    }
    // The disc of an estimate then covers at most 1/32 of what indirect light falls on.
    settings.irradiance.least = 32 * int(settings.irradiance.nearest);
    return settings;
}

/// The rays per pixel of a preset. The further rays go to pixels around which the first
/// rays differ. A pixel's own rays do not decide, so that this choice has no bias: see
/// render_adaptive().
struct PresetRays {
    int first = 1; ///< In every pixel.
    int more = 0;  ///< The most that are added to a pixel.
    /// If the relative standard deviation of the first rays around a pixel is at least
    /// this, the pixel gets all `more` rays. If it is smaller, the pixel gets a part of
    /// them, in proportion.
    double disagreement = 1.2;
};

/// The rays of a preset, for RenderSettings::samples and render_adaptive().
/// \param preset  Which one.
/// \return The numbers of rays.
[[nodiscard]] constexpr PresetRays preset_rays(Preset preset) noexcept {
    if (preset == Preset::draft) return {.first = 1, .more = 0};
    if (preset == Preset::fast) return {.first = 1, .more = 16};
    return {.first = 64, .more = 0};
}

/// \}

} // namespace ljus
