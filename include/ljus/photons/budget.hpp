#pragma once

/// \file ljus/photons/budget.hpp
/// \brief How many caustic photons each mirror and each glass gets.

#include <cmath>
#include <span>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/tracing.hpp"

namespace ljus {

/// \defgroup budget A budget for caustics
/// \brief Section 5: "shooting fewer caustics photons towards objects with higher
/// refractivity". Chapter: \ref ch_caustic_budget.
/// \{

/// Shares that make a sum of variances least. With n_k photons object k adds the
/// variance \f$ a_k^2 / n_k \f$; the sum, with all n_k together given, is least for
/// \f$ n_k \propto a_k \f$ (Neyman). A part of the photons is shared out equally, for
/// a pilot can be wrong: the variance is then at most 1/(1 - floor) of the least.
/// \param scatter  The a_k: finite, at least 0.
/// \param floor    The part that is shared out equally, in [0, 1].
/// \return Shares with the sum 1, none below floor / size; equal ones if all a_k are 0.
/// \throws std::invalid_argument  with the number that is wrong.
// [share_out]
[[nodiscard]] inline std::vector<double> share_out(std::span<const double> scatter,
                                                   double floor = 0.1) {
    require_unit("the floor of the shares", floor);
    double sum = 0;
    for (const double a : scatter) {
        require(std::isfinite(a) && a >= 0, "a scatter", a, "finite and at least 0");
        sum += a;
    }
    std::vector<double> shares;
    for (const double a : scatter) {
        const double equal = 1 / double(scatter.size());
        // The part of one that is alone is 1, not a little more.
        shares.push_back(sum > 0 ? floor * equal + (1 - floor) * (a / sum) : equal);
    }
    return shares;
}
// [share_out]

/// What a pilot pass found out about one object. Scatters are the a_k of share_out().
struct CausticPilot {
    ObjectId object{};      ///< Which object.
    std::size_t stored = 0; ///< Photons of the pilot that came to a diffuse surface.
    double flux = 0;        ///< Luminous part of the flux that it throws, W.
    double area = 0;        ///< Flux over its mean irradiance: on how much it lies.
    double absolute = 0;    ///< Scatter of the light on surfaces, W.
    double relative = 0;    ///< Scatter relative to its own mean light, as an area.
    double visible = 0;     ///< Scatter relative to all light, as an area.
};

namespace detail {

/// The irradiance around a photon, by the photons of a map on its side of its surface.
/// \param map     The photons; shadow photons do not count.
/// \param at      Where.
/// \param radius  Of the disc.
/// \return The luminance of W/m^2.
template <std::floating_point T>
[[nodiscard]] double irradiance_around(const PhotonMapT<T>& map, const PhotonT<T>& at,
                                       T radius) {
    const Vec3T<T> normal = glm::normalize(Vec3T<T>(at.normal));
    const int side = photon_side(at.direction, normal);
    double sum = 0;
    map.tree.visit_within(at.position, radius, [&](std::uint32_t i, double) {
        const PhotonRecordT<T> photon = map.records[i];
        if (light_kinds.has(photon.kind) && !turned_away(photon.normal, normal) &&
            photon_side(photon.direction, normal) == side)
            sum += luminance(RgbT<double>(photon.flux));
    });
    return sum / (std::numbers::pi * double(radius) * double(radius));
}

/// The mean irradiance that photons meet in a map, by some thousand of them.
template <std::floating_point T>
[[nodiscard]] double mean_irradiance(const PhotonMapT<T>& map,
                                     const std::vector<PhotonT<T>>& photons, T radius) {
    const std::size_t step = photons.size() / 1000 + 1;
    double flux = 0, lit = 0;
    for (std::size_t i = 0; i < photons.size(); i += step) {
        const double part = luminance(RgbT<double>(photons[i].flux));
        flux += part;
        lit += part * irradiance_around(map, photons[i], radius);
    }
    return flux > 0 ? lit / flux : 0;
}

/// The photons of a pilot for one object: as many of a pass as `paths`, aimed at it
/// alone, from streams that no pass of the picture draws from.
template <AnyWorld W>
[[nodiscard]] TracedPhotonsT<typename W::Scalar>
trace_pilot(const W& world, PhotonPassSettings pass, std::size_t object,
            std::size_t objects, long long paths) {
    pass.shares.assign(objects, 0.0);
    pass.shares[object] = 1;
    pass.photons = pass.give_up = paths;
    pass.iteration = ~pass.iteration - object;
    pass.progress = no_progress;
    return trace_photons(world, MapType::caustics, pass);
}

/// What the photons of a pilot say of their object.
template <std::floating_point T>
struct PilotLightT {
    const PhotonMapT<T>& caustics; ///< The photons of all pilots.
    const PhotonMapT<T>& rest;     ///< What else lights the scene.
    T radius = T(0);               ///< The caustics are asked within it.
    T wide = T(0);                 ///< The rest is asked within it.
    double dark = 0;               ///< A tenth of the mean light, W/m^2.

    /// Adds up what an object throws, and how that scatters.
    /// \param object   The object.
    /// \param photons  Of its pilot, as they were stored.
    /// \param paths    How many were sent.
    [[nodiscard]] CausticPilot judge(ObjectId object,
                                     const std::vector<PhotonT<T>>& photons,
                                     long long paths) const {
        CausticPilot pilot{.object = object, .stored = photons.size()};
        double lit = 0; // flux times irradiance
        for (const PhotonT<T>& photon : photons) {
            const double flux = luminance(RgbT<double>(photon.flux));
            if (!(flux > 0)) continue; // what follows is above 0 as well
            const double own = irradiance_around(caustics, photon, radius);
            const double visible =
                flux / (own + dark + irradiance_around(rest, photon, wide));
            pilot.flux += flux;
            lit += flux * own;
            pilot.absolute += double(paths) * flux * flux;
            pilot.visible += double(paths) * visible * visible;
        }
        pilot.absolute = std::sqrt(pilot.absolute);
        pilot.visible = std::sqrt(pilot.visible);
        if (lit > 0) {
            pilot.area = pilot.flux * pilot.flux / lit;
            pilot.relative = pilot.absolute * pilot.area / pilot.flux;
        }
        return pilot;
    }
};

} // namespace detail

/// Traces a few photons to each mirror and each glass, to learn what it throws and how
/// it scatters. They are not used again: what decides about a share must not count in
/// it, or the mean is wrong.
///
/// An estimate sums photons of the flux \f$ \varphi_i \f$, with a variance that over
/// the whole picture is \f$ \propto \sum_i \varphi_i^2 \f$. Where the error counts
/// relative to a light E, each counts as \f$ (\varphi_i / E(x_i))^2 \f$. So of the n
/// photons that were sent to object k
/// \f$ a_k^2 = n \sum_i (\varphi_i / E(x_i))^2 \f$. E is 1, or the mean light of its
/// caustic, or all light and a tenth of its mean: in the dark no error is relative to
/// nothing.
/// \param world   The closed scene.
/// \param pass    Of the picture; a twentieth of its photons is sent, at least 500 and
///                at most 20 000 to each object.
/// \param radius  Of the estimates of the picture, in scene units; twice of it is used.
///                0: that in which 32 photons of the picture lie typically.
/// \param light   What else lights the scene: photons of a general map, or none; shadow
///                photons are no light, and do not count.
/// \param wide    The radius that they are asked with; 0: that of 64 of them.
/// \return One for each of specular_objects().
template <AnyWorld W, std::floating_point T = typename W::Scalar>
[[nodiscard]] std::vector<CausticPilot>
pilot_caustics(const W& world, const PhotonPassSettings& pass, T radius,
               std::vector<PhotonT<T>> light = {}, T wide = T(1)) {
    const auto objects = specular_objects(world);
    if (objects.empty()) return {};
    std::erase_if(light, [](const auto& p) { return p.kind == PhotonKind::shadow; });
    const auto count = static_cast<long long>(objects.size());
    const long long paths = std::clamp(pass.photons / (20 * count), 500LL, 20000LL);
    std::vector<std::vector<PhotonT<T>>> found;
    std::vector<PhotonT<T>> all;
    for (std::size_t k = 0; k < objects.size(); ++k) {
        found.push_back(
            detail::trace_pilot(world, pass, k, objects.size(), paths).photons);
        all.insert(all.end(), found[k].begin(), found[k].end());
    }
    const PhotonMapT<T> caustics = make_photon_map(all, pass.threads);
    const PhotonMapT<T> rest = make_photon_map(light, pass.threads);
    if (radius == 0) // the picture's photons lie denser than those of the pilot
        radius =
            typical_radius(caustics, 32) *
            T(std::sqrt(double(paths * count) / double(std::max(pass.photons, 1LL))));
    if (wide == 0) wide = typical_radius(rest, 64);
    const double dark =
        0.1 * (light.empty() ? detail::mean_irradiance(caustics, all, 2 * radius)
                             : detail::mean_irradiance(rest, light, wide));
    const detail::PilotLightT<T> around{caustics, rest, 2 * radius, wide, dark};
    std::vector<CausticPilot> pilots;
    for (std::size_t k = 0; k < objects.size(); ++k)
        pilots.push_back(around.judge(objects[k], found[k], paths));
    return pilots;
}

/// The shares of a budget, for PhotonPassSettings::shares.
/// \param budget  What the photons are shared out by.
/// \param pilots  Of pilot_caustics().
/// \return One for each object; none at all for CausticBudget::as_seen.
[[nodiscard]] inline std::vector<double>
caustic_shares(CausticBudget budget, std::span<const CausticPilot> pilots) {
    if (budget == CausticBudget::as_seen) return {};
    std::vector<double> scatter;
    for (const CausticPilot& pilot : pilots)
        scatter.push_back(budget == CausticBudget::equal  ? 1.0
                          : budget == CausticBudget::flux ? pilot.absolute
                          : budget == CausticBudget::area ? pilot.relative
                                                          : pilot.visible);
    return share_out(scatter);
}

/// \}

} // namespace ljus
