#pragma once

/// \file ljus/render/budgeting.hpp
/// \brief The ability of a photon mapper to distribute caustic photons by a budget.

#include "ljus/photons/budget.hpp"
#include "ljus/render/photon_mapping.hpp"

namespace ljus {

/// \addtogroup budget
/// \{

/// The ability that PhotonMappingSettings::caustic_budget needs.
struct Budgeting {
    /// Budgeting has no state. The mapper keeps the shares in
    /// PhotonMapper::settings().caustics, as `shares` and `light_shares`.
    template <std::floating_point T>
    struct State {};
};

/// The share of each light in the caustic photons, measured by pilot_lights().
/// \param world     The closed scene.
/// \param settings  The budget and the photons.
/// \return PhotonPassSettings::light_shares; unchanged if the settings contain shares
///         or ask for no measurement.
template <AnyWorld W>
[[nodiscard]] std::vector<double>
caustic_light_shares(const W& world, const PhotonMappingSettings& settings) {
    const CausticBudget budget = settings.caustic_budget;
    const bool given =
        !settings.caustics.light_shares.empty() || !settings.caustics.shares.empty();
    const bool measures =
        budget != CausticBudget::as_seen && budget != CausticBudget::equal;
    if (given || !(measures || settings.share_lights))
        return settings.caustics.light_shares;
    return pilot_lights(world, settings.caustics);
}

/// The share of each mirror and each glass object in the caustic photons, estimated by
/// a pilot pass.
/// \param world     The closed scene.
/// \param settings  The budget, photons, radii. For CausticBudget::brightness, 20 000
///                  photons of a general pass estimate all light that is no caustic.
/// \return PhotonPassSettings::shares; unchanged if the settings contain them, or for
///         CausticBudget::as_seen.
/// \throws std::invalid_argument  as trace_photons(), as for a scene without a light.
template <AnyWorld W>
[[nodiscard]] std::vector<double>
caustic_shares(const W& world, const PhotonMappingSettings& settings) {
    using T = typename W::Scalar;
    const CausticBudget budget = settings.caustic_budget;
    if (budget == CausticBudget::as_seen || !settings.caustics.shares.empty())
        return settings.caustics.shares;
    std::vector<PhotonT<T>> light;
    if (budget == CausticBudget::brightness) {
        PhotonPassSettings pass = settings.general;
        pass.photons = 20000;
        pass.shadow_photons = false;
        pass.iteration = ~pass.iteration;
        pass.progress = no_progress;
        light = trace_photons(world, MapType::general, pass).photons;
    }
    return caustic_shares(budget,
                          pilot_caustics(world, settings.caustics,
                                         T(settings.caustics_estimate.radius), light,
                                         T(settings.general_estimate.radius)));
}

/// \}

} // namespace ljus
