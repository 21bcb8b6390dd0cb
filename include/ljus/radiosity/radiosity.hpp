#pragma once

/// \file ljus/radiosity/radiosity.hpp
/// \brief From a scene to its light map: patches, form factors, equations.

#include "ljus/radiosity/light_map.hpp"
#include "ljus/radiosity/radiosity_solve.hpp"

namespace ljus {

/// \defgroup radiosity Radiosity
/// \brief Section 2.2, after Goral et al. \cite goral1984. Chapter: \ref ch_radiosity.
/// \{

/// All that one may choose.
struct RadiositySettings {
    PatchSettings patches{};      ///< How the scene is cut up.
    FormFactorSettings factors{}; ///< How form factors are found.
    SolveSettings solve{};        ///< How the equations are solved.
};

/// Where the light has gone, in W.
struct EnergyBalance {
    RgbT<double> emitted{0};  ///< By all patches.
    RgbT<double> absorbed{0}; ///< By all patches.
    RgbT<double> escaped{0};  ///< Through openings, and to what is no patch.
};

/// Radiosity, with all that it was made of.
struct Radiosity {
    Patches patches{};            ///< What the scene was cut into.
    FormFactors factors{};        ///< Between all of them.
    RadiositySolution solution{}; ///< The radiosity of each.
    LightMap map{};               ///< The irradiance of each, to be drawn and saved.
};

/// Accounts for the light of a solution.
/// \param patches    The patches.
/// \param factors    The form factors.
/// \param radiosity  Of each patch, W/m^2.
/// \return Emitted = absorbed + escaped, if the equations are solved and the form
///         factors reciprocal: to rounding, however large the patches and however few
///         the rays.
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

/// What a light map is made of: the scene, and those settings that change the map.
/// \param world     The closed scene.
/// \param settings  Patches, form factors and solver; their progress and threads do not
///                  count.
/// \return The key.
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

/// The light map of a solution.
/// \param world      The closed scene.
/// \param patches    Its patches.
/// \param factors    Their form factors.
/// \param radiosity  Of each patch, W/m^2. One that still waits to be sent on is seen
///                   already: the map holds what arrives.
/// \return The light map, without the settings in its key.
template <AnyWorld W>
[[nodiscard]] LightMap make_light_map(const W& world, const Patches& patches,
                                      const FormFactors& factors,
                                      const std::vector<RgbT<double>>& radiosity) {
    return {.key{.scene = detail::scene_hash(world)},
            .grids = patches.grids,
            .irradiance = detail::multiply(factors, radiosity)};
}

/// Radiosity of a scene, from the patches to the light map.
/// \param world     Matt quads, triangles and balls, and what stands in their light.
/// \param settings  How.
/// \return The light map and all that led to it; nothing if the progress callback of
///         the form factors stopped it. See Patches::left_out.
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
