#pragma once

/// \file ljus/photons/budget.hpp
/// \brief The distribution of caustic photons among mirrors and glass objects.

#include <cmath>
#include <span>
#include <vector>

#include "ljus/image/color.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/photons/tracing.hpp"

namespace ljus {

/// \defgroup budget A budget for caustics
/// \brief Section 5 of the report: "shooting fewer caustics photons towards objects
/// with higher refractivity". Chapter: \ref ch_caustic_budget.
/// \{

/// The fractions of photons that minimise a sum of variances. If n_k photons give
/// object k the variance \f$ a_k^2 / n_k \f$, the sum of all variances is smallest for
/// \f$ n_k \propto a_k \f$ (Neyman). As the measured a_k may be wrong, the fraction
/// `floor` of the photons is distributed evenly. With correct a_k, the sum of the
/// variances is then at most 1/(1 - floor) times the smallest possible.
/// \param scatter  The a_k: at least 0, with a finite sum.
/// \param floor    The fraction that is distributed evenly, in [0, 1].
/// \return One fraction per object, at least `floor` divided by the number of objects;
///         the sum is 1. Equal fractions if all a_k are 0.
/// \throws std::invalid_argument  if a value is out of range.
// [share_out]
[[nodiscard]] inline std::vector<double> share_out(std::span<const double> scatter,
                                                   double floor = 0.1) {
    require_unit("the floor of the shares", floor);
    double sum = 0;
    for (const double a : scatter) {
        require(std::isfinite(a) && a >= 0, "the scatter of an object", a,
                "finite and at least 0");
        sum += a;
    }
    require(std::isfinite(sum), "the sum of the scatter", sum, "finite");
    std::vector<double> shares;
    for (const double a : scatter) {
        const double equal = 1 / double(scatter.size());
        // With this formula a single object gets exactly 1.
        shares.push_back(sum > 0 ? floor * equal + (1 - floor) * (a / sum) : equal);
    }
    return shares;
}
// [share_out]

/// The results of a pilot pass for one object. The last three members are values of a_k
/// for share_out(), for three measures of the error; see pilot_caustics().
struct CausticPilot {
    ObjectId object{};      ///< The object.
    std::size_t stored = 0; ///< Number of photons that the pilot stored.
    double flux = 0;        ///< Luminance of the flux of the object's caustic, in W.
    double area = 0;        ///< Area of the caustic: flux divided by mean irradiance.
    double absolute = 0;    ///< a_k for the error of the irradiance, in W.
    /// a_k for the error relative to the mean irradiance of the caustic, in squared
    /// scene units.
    double relative = 0;
    /// a_k for the error relative to the irradiance of all light, in squared scene
    /// units.
    double visible = 0;
};

namespace detail {

/// The luminance of the irradiance around a photon, in W/m^2, on the side on which the
/// photon arrived. Shadow photons of the map do not count.
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

/// The mean of the irradiance around at most a thousand of the photons, weighted by
/// their flux.
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

/// Traces the pilot of one object: `paths` photons, all aimed at this object. No pass
/// of the picture uses the same random streams.
template <AnyWorld W>
[[nodiscard]] TracedPhotonsT<typename W::Scalar>
trace_pilot(const W& world, PhotonPassSettings pass, std::size_t object,
            std::size_t objects, long long paths) {
    pass.shares.assign(objects, 0.0);
    pass.shares[object] = 1;
    pass.photons = pass.give_up = paths;
    pass.keep.bits &= all_kinds.bits; // a photon in fog has no normal
    pass.iteration = ~pass.iteration - object;
    pass.progress = no_progress;
    return trace_photons(world, MapType::caustics, pass);
}

template <std::floating_point T>
struct PilotLightT {
    const PhotonMapT<T>& caustics; ///< Photons of all pilots.
    const PhotonMapT<T>& rest;     ///< Photons of all other light.
    T radius = T(0);               ///< Search radius in `caustics`.
    T wide = T(0);                 ///< Search radius in `rest`.
    /// Added to the irradiance of all light, to limit the weight of dark surfaces; in
    /// W/m^2.
    double dark = 0;

    /// Computes the results for an object.
    /// \param photons  The photons that its pilot stored.
    /// \param paths    The number of photons that its pilot emitted.
    [[nodiscard]] CausticPilot judge(ObjectId object,
                                     const std::vector<PhotonT<T>>& photons,
                                     long long paths) const {
        CausticPilot pilot{.object = object, .stored = photons.size()};
        double lit = 0; // flux times irradiance
        for (const PhotonT<T>& photon : photons) {
            const double flux = luminance(RgbT<double>(photon.flux));
            if (!(flux > 0)) continue; // the divisor below might be 0
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

/// Traces a few photons to each mirror and each glass object, to measure the flux and
/// the scatter of the object's caustic. These photons are not used for the picture,
/// because an estimate is biased if the same photons decide how many are sent to each
/// object.
///
/// The variance of estimates, summed over a picture, is proportional to
/// \f$ \sum_i \varphi_i^2 \f$, where \f$ \varphi_i \f$ is the flux of photon i. If the
/// error is divided by an irradiance E, photon i adds \f$ (\varphi_i / E(x_i))^2 \f$,
/// where \f$ x_i \f$ is its position. The scatter a_k of object k, from a pilot of n
/// photons, is therefore given by \f$ a_k^2 = n \sum_i (\varphi_i / E(x_i))^2 \f$. For
/// CausticPilot::absolute E is 1. For `relative` E is the mean irradiance of the
/// caustic. For `visible` E is the irradiance of all light plus a tenth of the mean
/// irradiance of the light without caustics, or of the caustics if there is no other
/// light. This addition limits the weight of dark surfaces.
/// \param world   The closed scene.
/// \param pass    The settings of the picture's pass. The pilot sends a twentieth of
///                the photons of that pass. Each object gets the same number, at least
///                500 and at most 20 000.
/// \param radius  Radius of the picture's estimates, in scene units. The pilot searches
///                within twice this radius. If it is 0, the radius is chosen for which
///                a disc typically contains 32 photons of the picture.
/// \param light   The photons of a general map, for all other light; may be empty.
///                Shadow photons do not count.
/// \param wide    Search radius in `light`. If it is 0, the typical radius of 64 of
///                these photons is used.
/// \return One result per element of specular_objects().
template <AnyWorld W, std::floating_point T = typename W::Scalar>
[[nodiscard]] std::vector<CausticPilot>
pilot_caustics(const W& world, const PhotonPassSettings& pass, T radius,
               std::vector<PhotonT<T>> light = {}, T wide = T(1)) {
    const auto objects = specular_objects(world, pass.gloss_as_mirrors);
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
    if (radius == 0) // the picture's photons are denser than the pilot's
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

/// The weight of a pilot in the shares of lights, see pilot_lights(): 0.9 from 200
/// photons per light upwards, and less if the pilot has fewer, because its shares are
/// then uncertain. At 22 photons per light it is a half.
/// \param photons  The pilot's photons per light, at least 0.
// [pilot_weight]
[[nodiscard]] inline double pilot_weight(double photons) noexcept {
    return std::min(0.9, photons / (photons + 200.0 / 9));
}
// [pilot_weight]

namespace detail {

struct AllAlike {
    template <std::floating_point T>
    [[nodiscard]] constexpr double operator()(const PhotonT<T>&) const noexcept {
        return 1;
    }
};

} // namespace detail

/// Traces a few photons from every light, the same number from each, to measure what
/// each light contributes to a map. The share of light k is
/// \f$ (1 - w)\, p_k + w\, a_k / \sum_j a_j \f$, where w is the pilot_weight() and
/// \f$ p_k \f$ is the fraction of the power that light k emits. The scatter a_k is
/// given by \f$ a_k^2 = \sum_i (w_i \varphi_i)^2 \f$ over the stored photons of the
/// light, where \f$ \varphi_i \f$ is the flux of photon i and \f$ w_i \f$ its weight.
/// As w is at most 0.9, the variance is at most ten times that of a choice by power,
/// even if the pilot misses some light.
/// \param world   The closed scene.
/// \param pass    The settings of the picture's pass. The pilot sends a twentieth of
///                the photons of that pass, at most 20 000 per light. If that is less
///                than 200 per light, it sends 200 per light, but at most a quarter of
///                the photons of that pass.
/// \param map     The kind of map.
/// \param weight  Called with each photon; returns \f$ w_i \f$, at least 0.
/// \return One fraction per light, with the sum 1, for
///         PhotonPassSettings::light_shares. Empty for a single light, or if no photon
///         was stored.
template <AnyWorld W, typename Weight = detail::AllAlike>
[[nodiscard]] std::vector<double> pilot_lights(const W& world, PhotonPassSettings pass,
                                               MapType map = MapType::caustics,
                                               const Weight& weight = {}) {
    const auto lights = static_cast<long long>(world.light_count());
    if (lights < 2 || pass.photons < 4) return {};
    const long long least = std::min(200 * lights, pass.photons / 4);
    pass.photons = std::clamp(pass.photons / 20, least, 20000 * lights);
    pass.give_up = pass.photons;
    pass.equal_lights = true;
    pass.shadow_photons = false;
    pass.keep.bits &= all_kinds.bits; // a photon in fog does not know its light
    pass.shares = pass.light_shares = {};
    pass.iteration = ~pass.iteration - (1u << 31); // beyond the pilots of objects
    pass.progress = no_progress;
    std::vector<double> scatter(static_cast<std::size_t>(lights));
    for (const auto& photon : trace_photons(world, map, pass).photons) {
        const double flux = weight(photon) * luminance(RgbT<double>(photon.flux));
        scatter[photon.light] += flux * flux;
    }
    double sum = 0;
    for (double& a : scatter) sum += a = std::sqrt(a);
    if (!(sum > 0)) return {};
    const double weight_of_pilot = pilot_weight(double(pass.photons) / double(lights));
    std::vector<double> shares;
    for (std::uint32_t k = 0; k < scatter.size(); ++k)
        shares.push_back((1 - weight_of_pilot) *
                             probability_of<double>(world.light_choice(), k) +
                         weight_of_pilot * (scatter[k] / sum));
    return shares;
}

/// Computes PhotonPassSettings::shares.
/// \param budget  The criterion.
/// \param pilots  The results of pilot_caustics().
/// \return One fraction per object; empty for CausticBudget::as_seen.
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
