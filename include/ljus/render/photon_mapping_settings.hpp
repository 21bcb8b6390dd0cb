#pragma once

/// \file ljus/render/photon_mapping_settings.hpp
/// \brief The settings of the report's renderer.

#include <algorithm>
#include <cmath>
#include <utility>

#include "ljus/path/all_lights.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/irradiance_settings.hpp"
#include "ljus/photons/photon_pass.hpp"
#include "ljus/photons/shadow_verdict.hpp"
#include "ljus/photons/volume_photons.hpp"

namespace ljus {

/// \addtogroup photon_mapping
/// \{

/// The source of indirect light, which has met at least two diffuse surfaces.
enum class IndirectLight : std::uint8_t {
    rays,    ///< Indirect rays at every bounce.
    map,     ///< One indirect ray, and the general map where it ends.
    photons, ///< Indirect photons at the surface itself, without indirect rays. The
             ///< light has little noise, but the radius blurs it.
    gather,  ///< One gather ray, and precomputed irradiance where it ends.
    cache,   ///< Irradiance, gathered by many rays at few points and interpolated.
    none     ///< No indirect light: direct light and caustics only.
};

namespace detail {

/// Whether irradiance points are looked up where indirect rays end.
[[nodiscard]] constexpr bool uses_points(IndirectLight indirect) noexcept {
    return indirect == IndirectLight::gather || indirect == IndirectLight::cache;
}

/// Whether paths end at the second diffuse surface: a lookup there replaces all further
/// bounces.
[[nodiscard]] constexpr bool gathers(IndirectLight indirect) noexcept {
    return indirect == IndirectLight::map || uses_points(indirect);
}

} // namespace detail

/// The largest number of points in an interpolation of the irradiance cache.
inline constexpr std::size_t max_cache_nearest = 64;

/// How irradiance is gathered and interpolated.
struct GatherSettings {
    int rays = 25;           ///< Gather rays per point, at least 1.
    int tile = 3;            ///< Side of a square tile, in pixels; one camera ray
                             ///< through each tile makes points.
    std::size_t nearest = 6; ///< Number of points in an interpolation, 2 to 64.
    float reach = 1;     ///< Largest distance of a point that is used, as a multiple
                         ///< of the harmonic mean length of its gather rays.
    int max_depth = 100; ///< Largest number of surfaces on the path of a gather ray,
                         ///< including the surface of its origin; at least 2.
};

/// Settings of the report's renderer. Lengths are in scene units.
struct PhotonMappingSettings {
    int max_depth = 1000; ///< Largest number of surfaces on a camera path, including
                          ///< mirrors and glass.
    /// Number of the first surface at which roulette may end a path.
    int roulette_depth = 4;
    int shadow_rays = 1; ///< Shadow rays to each light, at least 1. Unless `direct` is
                         ///< `sampled`, a glossy surface sends one if the path's next
                         ///< ray finds lamps as well, or if it has met a D before.
    DirectLight direct = DirectLight::sampled; ///< How direct light is found.
    /// Whether paths split at glass before the first matt surface.
    bool split_glass = false;
    IndirectLight indirect = IndirectLight::rays; ///< Source of indirect light.
    PhotonPassSettings caustics{}; ///< Photons aimed at mirrors and glass.
    PhotonPassSettings general{};  ///< Photons for all other light.
    CausticBudget caustic_budget =
        CausticBudget::as_seen; ///< How mirrors and glass share caustics.photons.
    /// Whether the mapper calls pilot_lights() to measure how the lights share
    /// caustics.photons. The pilot costs at most a quarter of that number of photons.
    /// Each caustic_budget measures this anyway, except CausticBudget::as_seen and
    /// CausticBudget::equal. A mapper without the ability Budgeting, see abilities,
    /// ignores the setting.
    bool share_lights = false;
    /// How caustics are estimated. With radius 0 the mapper chooses a radius for which
    /// a disc typically holds 32 photons.
    DensityEstimateSettings caustics_estimate{};
    /// The light of a caustic photon that lies far from all others is spread over a
    /// disc of this many times the radius of the estimates, 1 to 1000; see
    /// lone_photons(). Estimates with the k nearest photons ignore it.
    float lone_radius = 1;
    /// How the general map is queried. With radius 0 the mapper chooses a radius for
    /// which a disc typically holds 64 photons.
    DensityEstimateSettings general_estimate{.radius = 0.3f};
    /// How radiance is estimated from photons in fog.
    BeamEstimateSettings fog_estimate{};
    IrradiancePointSettings irradiance{}; ///< How irradiance points are made.
    GatherSettings gather{};              ///< How the irradiance cache is made.
    SkipSettings skip{};           ///< Which rays are omitted because photons make them
                                   ///< unnecessary; none by default.
    bool keep_general_map = false; ///< Whether to make the general map even if no ray
                                   ///< queries it.
};

/// Checks the settings.
/// \throws std::invalid_argument  if a setting is out of range.
[[gnu::cold]] LJUS_CORE_INLINE void check(const PhotonMappingSettings& settings);

#ifndef LJUS_CORE // otherwise defined in ljus::core
LJUS_CORE_INLINE void check(const PhotonMappingSettings& settings) {
    require_at_least("max_depth", settings.max_depth, 1);
    require_at_least("shadow_rays", settings.shadow_rays, 1);
    require_at_least("caustics.photons", settings.caustics.photons, 0);
    require_at_least("general.photons", settings.general.photons, 0);
    check(settings.irradiance);
    require_at_least("gather.rays", settings.gather.rays, 1);
    require_at_least("gather.tile", settings.gather.tile, 1);
    require(settings.gather.nearest >= 2 &&
                settings.gather.nearest <= max_cache_nearest,
            "gather.nearest", static_cast<long long>(settings.gather.nearest),
            "within [2, 64]");
    require_positive("gather.reach", settings.gather.reach);
    require_at_least("gather.max_depth", settings.gather.max_depth, 2);
    for (auto [gather, name] :
         {std::pair{settings.caustics_estimate, "caustics_estimate"},
          std::pair{settings.general_estimate, "general_estimate"}}) {
        if (gather.radius == 0) gather.radius = 1; // 0 is replaced later
        check(gather, name);
    }
    require(settings.lone_radius >= 1 && settings.lone_radius <= 1000, "lone_radius",
            double(settings.lone_radius), "within [1, 1000]");
    check(settings.skip);
    check(settings.fog_estimate);
}
#endif

namespace detail {

/// The settings of the estimate with lone photons.
[[nodiscard]] inline DensityEstimateSettings
lone_estimate(const PhotonMappingSettings& settings) noexcept {
    DensityEstimateSettings wide = settings.caustics_estimate;
    wide.radius *= settings.lone_radius;
    return wide;
}

} // namespace detail

/// The purposes for which there are ready settings.
enum class Preset : std::uint8_t {
    draft, ///< For a first look: a picture with blotches, in a fraction of a second.
    /// Few visible errors in little time. More rays do not reduce the bias of this
    /// preset. Indirect light is smoothed over 4 pixels. The last 8 pixels before a
    /// dark corner are therefore too bright, by 10 % or more. Penumbras are slightly
    /// wrong. Caustics, glossy reflections and light in fog are blurred.
    fast,
    /// Indirect rays at every bounce; only caustics and light in fog are biased.
    exact
};

/// The settings of a preset. The number of photons depends on the size of the picture,
/// because smaller pixels show smaller errors; radii are chosen from the photons.
/// \param preset  The preset.
/// \param width   Width of the picture, in pixels.
/// \param height  Height of the picture, in pixels.
/// \return All settings; seeds and threads have their defaults.
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
    settings.roulette_depth = 3;
    const auto within = [](long long photons) {
        return std::clamp(photons, 10'000LL, 1'000'000LL);
    };
    // Small pictures need more photons per pixel, or blotches cover much of the
    // picture.
    settings.general.photons = draft ? within(pixels / 4) : within(pixels / 2) + 8000;
    settings.caustics.photons =
        draft ? within(pixels / 4) / 2 : within(pixels * 7 / 10);
    settings.gather.rays = draft ? 16 : 36;
    settings.gather.tile = draft ? 5 : 4;
    if (!draft) { // 36 gather rays are averaged
        settings.irradiance.every = 8;
        settings.irradiance.shadow_rays = 2;
    }
    // The disc of an estimate then covers at most 1/32 of the surfaces with indirect
    // light.
    settings.irradiance.least = 32 * int(settings.irradiance.nearest);
    return settings;
}

/// The rays per pixel of a preset. Further rays go to a pixel if the first rays of the
/// pixels around it differ. The pixel's own rays do not count, so that this choice has
/// no bias; see render_adaptive().
struct PresetRays {
    int first = 1; ///< Number of first rays of every pixel.
    int more = 0;  ///< Largest number of further rays of a pixel.
    /// If the relative standard deviation of the first rays around a pixel is at least
    /// this number, the pixel gets all `more` rays. If it is smaller, the number of
    /// further rays is proportional to it.
    double disagreement = 1.3;
};

/// The rays of a preset, for RenderSettings::samples and render_adaptive().
/// \param preset  The preset.
/// \return The numbers of rays.
[[nodiscard]] constexpr PresetRays preset_rays(Preset preset) noexcept {
    if (preset == Preset::draft) return {.first = 1, .more = 0};
    if (preset == Preset::fast) return {.first = 1, .more = 16};
    return {.first = 64, .more = 0};
}

/// \}

} // namespace ljus
