#pragma once

/// \file ljus/radiosity/radiosity.hpp
/// \brief Makes the light map of a scene by patches, form factors and linear equations.

#include "ljus/radiosity/light_map.hpp"
#include "ljus/radiosity/radiosity_solve.hpp"

namespace ljus {

/// \defgroup radiosity Radiosity
/// \brief Section 2.2 of the report, after Goral et al. \cite goral1984. Chapter:
/// \ref ch_radiosity.
/// \{

/// All settings of radiosity.
struct RadiositySettings {
    PatchSettings patches{};      ///< How the scene is divided.
    FormFactorSettings factors{}; ///< How form factors are computed.
    SolveSettings solve{};        ///< How the equations are solved.
};

/// What becomes of the emitted flux, in W.
struct EnergyBalance {
    RgbT<double> emitted{0};  ///< Flux that all patches emit.
    RgbT<double> absorbed{0}; ///< Flux that all patches absorb.
    RgbT<double> escaped{0}; ///< Flux through openings, or to surfaces without patches.
};

/// The results of radiosity, step by step.
struct Radiosity {
    Patches patches{};            ///< The patches of the scene.
    FormFactors factors{};        ///< The form factors between all patches.
    RadiositySolution solution{}; ///< The radiosity of each patch.
    LightMap map{};               ///< The irradiance of each patch, to draw and save.
};

/// The energy balance of a solution, from the radiosity of each patch in W/m^2. For an
/// exact solution, the emitted flux is the sum of the absorbed and the escaped flux, up
/// to rounding, for any size of patches and any number of rays.
[[nodiscard]] inline EnergyBalance
energy_balance(const Patches& patches, const FormFactors& factors,
               const std::vector<RgbT<double>>& radiosity) {
    const auto irradiance = detail::multiply(factors, radiosity);
    EnergyBalance sum;
    for (std::size_t i = 0; i < radiosity.size(); ++i) {
        const Patch& patch = patches.patches[i];
        sum.emitted += patch.area * patch.emitted;
        sum.absorbed += patch.area * (1.0 - patch.albedo) * irradiance[i];
        sum.escaped += patch.area * (1 - factors.row_sum(i)) * radiosity[i];
    }
    return sum;
}

/// The key of a light map: hashes of the scene and of the settings that change the map.
template <AnyWorld W>
[[nodiscard]] LightMapKey light_map_key(const W& world,
                                        const RadiositySettings& settings) {
    detail::FieldHash how;
    const FormFactorSettings& factors = settings.factors;
    const SolveSettings& solve = settings.solve;
    how.add(settings.patches.size, factors.analytic, factors.rays, factors.shadow_rays,
            factors.closed, factors.seed, solve.solver, solve.tolerance,
            solve.max_sweeps);
    return {detail::scene_hash(world), how.value};
}

/// The light map of a solution, from the radiosity of each patch in W/m^2. The
/// irradiance is computed from the whole radiosity, also where a solver has not yet
/// passed on all of it. In LightMap::key, only the hash of the scene is set; see
/// light_map_key().
template <AnyWorld W>
[[nodiscard]] LightMap make_light_map(const W& world, const Patches& patches,
                                      const FormFactors& factors,
                                      const std::vector<RgbT<double>>& radiosity) {
    return {.key{.scene = detail::scene_hash(world)},
            .grids = patches.grids,
            .irradiance = detail::multiply(factors, radiosity)};
}

/// Computes the radiosity of a scene, from the patches to the light map.
/// \return All results. Patches::left_out says which objects and lights are left out.
///         Nothing if the progress callback of the form factors stopped the
///         computation.
/// \throws std::invalid_argument  as make_patches(), make_form_factors() and
///         solve_radiosity().
/// \report{Section 2.2}
template <AnyWorld W>
[[nodiscard]] std::optional<Radiosity>
make_radiosity(const W& world, const RadiositySettings& settings = {}) {
    Radiosity all{.patches = make_patches(world, settings.patches)};
    auto factors = make_form_factors(world, all.patches, settings.factors);
    if (!factors) return std::nullopt;
    all.factors = std::move(*factors);
    all.solution = solve_radiosity(all.factors, all.patches.patches, settings.solve);
    all.map = make_light_map(world, all.patches, all.factors, all.solution.radiosity);
    all.map.key = light_map_key(world, settings);
    return all;
}

/// \}

} // namespace ljus
