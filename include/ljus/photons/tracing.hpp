#pragma once

/// \file ljus/photons/tracing.hpp
/// \brief How a photon goes through a scene, and where it leaves its mark.

#include <algorithm>
#include <vector>

#include "ljus/optics/absorption.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/emission.hpp"
#include "ljus/photons/photon.hpp"
#include "ljus/scene/indexed_scene.hpp"

namespace ljus {

/// \defgroup tracing Photon tracing
/// \brief Section 3.2.2: photons bounce "until Russian roulette decides otherwise".
/// \{

/// How photons are made.
struct PhotonPass {
    long long photons = 100000;  ///< How many are emitted; N of the estimate.
    std::uint64_t seed = 1;      ///< Of the random streams.
    std::uint64_t iteration = 0; ///< Which repetition of the pass.
    int max_bounces = 1000; ///< Surfaces a photon may meet; roulette ends it before.
    bool shadow_photons = true; ///< Whether the general map keeps them.
    int threads = 0;            ///< 0: all that there are.
    Progress progress = {};     ///< Called with (done, total); false stops.
};

/// What a photon pass brings.
template <std::floating_point T>
struct TracedPhotonsT {
    std::vector<PhotonT<T>> photons{}; ///< In the order of emission.
    FluxAudit audit{};                 ///< Where the flux has gone.
    long long emitted = 0;             ///< Paths, with the ones that marked nothing.
    bool complete = true; ///< False if the progress callback stopped the pass.
};

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
/// A surface is one thing, its two sides are two: what a side does not get is the light
/// whose cosine with *that side's* normal is positive. A ray that goes straight on comes
/// to exactly one side of each surface, the one that it meets, and the cosine is positive
/// there, wherever the surface's own normal points. So nothing is asked of the normal, as
/// nothing is asked of it for a direct photon; whoever reads the map asks photon_side().
/// Direct and shadow photons together are then, on each side, all the light that would
/// come if nothing stood in its way.
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
    RayT<T> ray = ray_from(first, flight.ray.direction);
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
        ray = ray_from(surface.point, ray.direction);
    }
}
// [trace_shadow]

/// What a photon does at a surface.
enum class PhotonLaw : std::uint8_t {
    general, ///< Any scattering; marks L D and L ... D ... D, not L S+ D.
    caustics ///< Mirrors and glass only; marks L S+ D.
};

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
template <typename Scene, std::floating_point T>
void trace(const Scene& scene, PhotonLaw law, FlightT<T> flight,
           std::optional<ObjectId> target, const PhotonPass& pass, RandomStream& stream,
           std::vector<PhotonT<T>>& out, FluxAudit& audit) {
    audit.emitted += RgbT<double>(flight.flux);
    const bool caustics = law == PhotonLaw::caustics;
    bool met_diffuse = false;
    bool met_specular = false;
    RgbT<T> medium{T(0)};

    for (int bounce = 1; bounce <= pass.max_bounces; ++bounce) {
        start_bounce(stream, static_cast<std::uint64_t>(bounce));
        const auto hit = closest_hit(scene, flight.ray);
        if (!hit) {
            audit.escaped += RgbT<double>(flight.flux);
            return;
        }
        if (bounce == 1 && target && hit->object != *target) {
            audit.cut += RgbT<double>(flight.flux);
            return;
        }
        const SurfaceT<T> surface = surface_at(scene, flight.ray, *hit);
        const Vec3T<T> wo = to_local(surface.frame, -flight.ray.direction);
        if (bounce == 1 && wo.z < T(0)) // its light is within the glass
            medium = scene.visit_material(surface.object.material,
                                          [](const auto& m) { return absorption(m); });
        const RgbT<T> arrived = flight.flux * transmittance(medium, hit->at.t);
        audit.absorbed += RgbT<double>(flight.flux) - RgbT<double>(arrived);
        if (bounce == 1 && !caustics && pass.shadow_photons)
            trace_shadow(scene, flight, surface.point, out);
        flight.flux = arrived;
        if (is_black(arrived)) return;

        const bool goes_on =
            scene.visit_material(surface.object.material, [&](const auto& material) {
                const PhotonKind kind = met_diffuse    ? PhotonKind::indirect
                                        : met_specular ? PhotonKind::caustic
                                                       : PhotonKind::direct;
                const bool owned = (kind == PhotonKind::caustic) == caustics;
                if (has(lobes(material), Lobes::diffuse) && owned)
                    out.push_back({surface.point.position, flight.ray.direction,
                                   flight.flux, flight.light, kind,
                                   small_normal(surface.point.normal)});

                const Vec3T<T> u = next_3d<T>(stream);
                const auto scattered = sample(material, wo, u, Transport::flux,
                                              caustics ? Lobes::specular : Lobes::all);
                if (!scattered) {
                    audit.absorbed += RgbT<double>(flight.flux);
                    return false;
                }
                const auto survivor = play_roulette(flight.flux, scattered->weight,
                                                    next_1d<T>(stream), audit);
                if (!survivor) return false;
                flight.flux = *survivor;
                (scattered->specular ? met_specular : met_diffuse) = true;
                if (!same_side(wo, scattered->wi))
                    medium = scattered->wi.z < T(0) ? absorption(material) : RgbT<T>{};
                flight.ray =
                    ray_from(surface.point, to_world(surface.frame, scattered->wi));
                return true;
            });
        if (!goes_on) return;
    }
    audit.cut += RgbT<double>(flight.flux);
}
// [trace]

/// Emits and traces the photons of one map, by several threads.
/// \param scene  The scene; with at least one light.
/// \param law    For which map.
/// \param pass   How many, and with which seed.
/// \return The photons in the order of emission, the same for any number of threads.
/// \throws std::invalid_argument  if the scene has no light or more than 65536, or a
///         number of the pass is out of range.
// [trace_photons]
template <typename Scene>
[[nodiscard]] TracedPhotonsT<typename Scene::Scalar>
trace_photons(const Scene& scene, PhotonLaw law, const PhotonPass& pass) {
    using T = typename Scene::Scalar;
    require(pass.photons >= 0, "the number of photons", pass.photons, "at least 0");
    require(!scene.lights.empty(), "the number of lights", 0LL,
            "at least 1, because photons start at lights");
    require(scene.lights.size() <= 65536, "the number of lights",
            static_cast<long long>(scene.lights.size()),
            "at most 65536, because a photon has 16 bits for its light's number");
    require(pass.max_bounces >= 1, "the largest number of bounces",
            static_cast<long long>(pass.max_bounces), "at least 1");

    const bool caustics = law == PhotonLaw::caustics;
    const IndexedT<Scene> indexed(scene);
    const LightChoice choice = light_choice(scene.lights);
    const auto targets = caustics ? specular_objects(scene) : std::vector<ObjectId>{};
    TracedPhotonsT<T> result{.emitted = pass.photons};
    if (caustics && targets.empty()) return result;

    struct Block {
        std::vector<PhotonT<T>> photons;
        FluxAudit audit;
    };
    constexpr long long block_size = 512;
    const long long count = block_count(pass.photons, block_size);
    std::vector<Block> blocks(static_cast<std::size_t>(count));
    const auto body = [&](long long number) {
        Block& block = blocks[static_cast<std::size_t>(number)];
        const BlockRange paths = block_range(number, block_size, pass.photons);
        for (long long path = paths.first; path < paths.last; ++path) {
            RandomStream stream = random_stream(
                pass.seed, caustics ? Pass::caustics_photons : Pass::general_photons,
                pass.iteration, static_cast<std::uint64_t>(path));
            FlightT<T> flight;
            std::optional<ObjectId> target;
            if (caustics) {
                const auto aimed = aim(scene, choice, targets, stream);
                if (!aimed) continue;
                flight = aimed->flight;
                target = aimed->target;
            } else {
                flight = emit(scene, choice, stream);
            }
            flight.flux /= static_cast<T>(pass.photons);
            trace(indexed, law, flight, target, pass, stream, block.photons,
                  block.audit);
        }
    };
    result.complete = parallel_blocks(
        count, body, {.threads = pass.threads, .progress = pass.progress});
    for (Block& block : blocks) {
        result.photons.insert(result.photons.end(), block.photons.begin(),
                              block.photons.end());
        result.audit += block.audit;
        block = {};
    }
    return result;
}
// [trace_photons]

/// \}

} // namespace ljus
