#pragma once

/// \file ljus/photons/photon_path.hpp
/// \brief How one photon goes through a scene, and where it leaves its mark.

#include <algorithm>
#include <optional>
#include <vector>

#include "ljus/optics/absorption.hpp"
#include "ljus/path/scatter.hpp"
#include "ljus/path/thin_surfaces.hpp"
#include "ljus/photons/emission.hpp"
#include "ljus/photons/photon_pass.hpp"
#include "ljus/scene/query.hpp"

namespace ljus {

/// \addtogroup tracing
/// \{

/// Compensated Russian roulette: a photon survives with the probability of its
/// reflection, and a survivor carries what the dead had \cite arvo1990.
/// \param flux    Before the surface; not black.
/// \param weight  f |cos| / pdf of the new direction.
/// \param u       In [0, 1).
/// \param audit   Takes what was absorbed, and what the game moved.
/// \return The flux that goes on; nothing if the photon dies.
/// \report{Section 3.2.2}
/// \erratum{The report does not say that a survivor must be divided by its probability;
///          its program did not, and lost the absorbed part twice.}
// [roulette]
template <std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>> play_roulette(const RgbT<T>& flux,
                                                   const RgbT<T>& weight, T u,
                                                   FluxAudit& audit) noexcept {
    const RgbT<T> reflected = flux * weight;
    audit.absorbed += RgbT<double>(flux) - RgbT<double>(reflected);
    const T probability =
        std::min(T(1), max_component(reflected) / max_component(flux));
    if (!(u < probability)) {
        audit.roulette += RgbT<double>(reflected);
        return std::nullopt;
    }
    const RgbT<T> survivor = reflected / probability;
    audit.roulette += RgbT<double>(reflected) - RgbT<double>(survivor);
    return survivor;
}
// [roulette]

/// Stores shadow photons on the matt surfaces behind the first one that a photon meets.
///
/// A surface has two sides, and what a side does not get is the light whose cosine with
/// *that side's* normal is positive. A ray that goes straight on comes to one side of
/// each surface, and the cosine is positive there, wherever the surface's own normal
/// points. So nothing is asked of the normal, as nothing is asked of it for a direct
/// photon; whoever reads the map asks photon_side(). Direct and shadow photons together
/// are then, on each side, all the light that would come if nothing stood in its way.
/// \param scene   The scene.
/// \param flight  The photon as it left its light.
/// \param first   The first surface it met.
/// \param out     Takes the photons.
/// \cost One search for the closest surface for each surface behind the first, and one
///       more; it ends after 1000.
/// \report{Section 3.2.2.1} \cite jensen1995
// [trace_shadow]
template <typename Scene, std::floating_point T>
void trace_shadow(const Scene& scene, const FlightT<T>& flight,
                  const SurfacePointT<T>& first, std::vector<PhotonT<T>>& out) {
    RayT<T> ray = spawn_ray(first, flight.ray.direction);
    for (int surfaces = 0; surfaces < 1000; ++surfaces) {
        const auto hit = closest_hit(scene, ray);
        if (!hit) return;
        const SurfaceT<T> surface = surface_at(scene, ray, *hit);
        const bool diffuse =
            scene.visit_material(surface.object.material, [](const auto& m) {
                return has(lobes(m), Lobes::diffuse);
            });
        if (diffuse)
            out.push_back({surface.point.position, ray.direction, flight.flux,
                           flight.light, PhotonKind::shadow,
                           small_normal(surface.point.normal)});
        ray = spawn_ray(surface.point, ray.direction);
    }
}
// [trace_shadow]

/// A photon on its way, and what it has met.
template <std::floating_point T>
struct TravellerT {
    FlightT<T> flight{};       ///< Where it goes, with what flux.
    RgbT<T> medium{T(0)};      ///< What the medium around it absorbs.
    bool met_diffuse = false;  ///< Whether it has been scattered diffusely.
    bool met_specular = false; ///< Whether it has met a mirror or glass.
    T chance = T(1);           ///< Of being stopped by the sheet where it is.
};

/// What kind of photon it would leave where it is now.
/// \param photon  The photon.
/// \return Its kind; never a shadow.
template <std::floating_point T>
[[nodiscard]] PhotonKind kind_of(const TravellerT<T>& photon) noexcept {
    if (photon.met_diffuse) return PhotonKind::indirect;
    return photon.met_specular ? PhotonKind::caustic : PhotonKind::direct;
}

/// Lets the medium, and the sheets that it went through, take their shares of a photon.
/// \param photon    The photon.
/// \param distance  The way through the medium.
/// \param through   What the sheets left.
/// \param audit     Takes what was absorbed.
// [absorb]
template <std::floating_point T>
void absorb(TravellerT<T>& photon, T distance, const RgbT<T>& through,
            FluxAudit& audit) noexcept {
    RgbT<T>& flux = photon.flight.flux;
    const RgbT<T> arrived = flux * transmittance(photon.medium, distance) * through;
    audit.absorbed += RgbT<double>(flux) - RgbT<double>(arrived);
    flux = arrived;
}
// [absorb]

/// Stores a photon, if the surface is diffuse and the photon's kind is the law's.
/// \param photon    The photon.
/// \param surface   Where it is.
/// \param material  What the surface is made of.
/// \param law       For which map.
/// \param out       Takes it.
// [mark]
template <std::floating_point T, typename Material>
void mark(const TravellerT<T>& photon, const SurfaceT<T>& surface,
          const Material& material, MapType law, std::vector<PhotonT<T>>& out) {
    const PhotonKind kind = kind_of(photon);
    const bool caustics = law == MapType::caustics;
    const bool owned = (kind == PhotonKind::caustic) == caustics;
    if (!owned || !has(lobes(material), Lobes::diffuse)) return;
    const FlightT<T>& flight = photon.flight;
    const Vec3T<T> wo = to_local(surface.frame, -flight.ray.direction);
    const T landing = landing_factor(surface, wo, flight.ray.direction);
    if (!(landing > T(0))) return;
    out.push_back({surface.point.position, flight.ray.direction, landing * flight.flux,
                   flight.light, kind, small_normal(surface.point.normal)});
}
// [mark]

/// Scatters a photon at a surface, unless it dies there.
/// \param photon    The photon; gets its new ray, flux and medium.
/// \param surface   Where it is.
/// \param material  What the surface is made of.
/// \param law       For which map: caustics photons go on by mirrors and glass only.
/// \param stream    Four numbers are drawn.
/// \param audit     Takes what was absorbed, and what roulette moved.
/// \return Whether it goes on.
// [send_on]
template <std::floating_point T, typename Material, typename Stream>
[[nodiscard]] bool send_on(TravellerT<T>& photon, const SurfaceT<T>& surface,
                           const Material& material, MapType law, Stream& stream,
                           FluxAudit& audit) {
    FlightT<T>& flight = photon.flight;
    const Vec3T<T> wo = to_local(surface.frame, -flight.ray.direction);
    const Vec3T<T> u = next_3d<T>(stream);
    const bool only_specular = law == MapType::caustics || surface.turned;
    const auto next = scatter(surface, material, wo, u, Transport::flux,
                              only_specular ? Lobes::specular : Lobes::all);
    if (!next) {
        audit.absorbed += RgbT<double>(flight.flux);
        return false;
    }
    const auto& scattered = next->sample;
    const auto survivor = play_roulette(flight.flux, scattered.weight / photon.chance,
                                        next_1d<T>(stream), audit);
    if (!survivor) return false;

    flight.flux = *survivor;
    (scattered.specular ? photon.met_specular : photon.met_diffuse) = true;
    if (!same_side(wo, scattered.wi))
        photon.medium = scattered.wi.z < T(0) ? absorption(material) : RgbT<T>{};
    flight.ray = spawn_ray(surface.point, next->wi);
    return true;
}
// [send_on]

/// Follows one photon and stores it at every diffuse surface that its law owns.
///
/// A photon that has met nothing but mirrors and glass is a caustic one: the caustics
/// map holds it, and the general map leaves it out, so that no light is counted twice.
/// \param scene   The scene.
/// \param law     For which map.
/// \param flight  The photon, its flux already divided by the number of paths.
/// \param target  Where it was aimed; for caustics, another first hit ends it.
/// \param pass    Limits.
/// \param stream  Four numbers a bounce.
/// \param out     Takes the photons.
/// \param audit   Takes the flux.
// [trace]
template <typename Scene, std::floating_point T, typename Stream>
void trace(const Scene& scene, MapType law, const FlightT<T>& flight,
           std::optional<ObjectId> target, const PhotonPassSettings& pass,
           Stream& stream, std::vector<PhotonT<T>>& out, FluxAudit& audit) {
    TravellerT<T> photon{.flight = flight};
    const auto add_to = [&](RgbT<double>& account) {
        account += RgbT<double>(photon.flight.flux);
    };
    add_to(audit.emitted);
    for (int bounce = 1; bounce <= pass.max_bounces; ++bounce) {
        start_bounce(stream, static_cast<std::uint64_t>(bounce));
        RayT<T>& ray = photon.flight.ray;
        const auto met = meet(scene, ray, stream);
        if (!met) return add_to(audit.escaped);
        if (bounce == 1 && target && met->hit.object != *target)
            return add_to(audit.cut);

        const SurfaceT<T> surface = surface_at(scene, ray, met->hit);
        const MaterialId made_of = surface.object.material;
        if (bounce == 1) {
            // From behind: the light is within the glass.
            if (glm::dot(surface.frame.normal, ray.direction) > T(0))
                photon.medium = scene.visit_material(
                    made_of, [](const auto& m) { return absorption(m); });
            if (law == MapType::general && pass.shadow_photons)
                trace_shadow(scene, flight, surface.point, out);
        }
        absorb(photon, met->distance, met->through, audit);
        photon.chance = met->chance;
        if (is_black(photon.flight.flux)) return;

        const auto at_material = [&](const auto& material) {
            mark(photon, surface, material, law, out);
            return send_on(photon, surface, material, law, stream, audit);
        };
        if (!visit_material_of(scene, surface, at_material)) return;
    }
    add_to(audit.cut);
}
// [trace]

/// \}

} // namespace ljus
