#pragma once

/// \file ljus/photons/photon_path.hpp
/// \brief One photon from beginning to end: it leaves its light, is stored, is
/// scattered, until it is absorbed or leaves the scene.

#include <algorithm>
#include <optional>
#include <vector>

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/photon_pass.hpp"

namespace ljus {

/// \defgroup emission Photon emission
/// \brief Section 3.2.2: photons are "shot from all the light sources into the scene".
/// \{

namespace detail {

/// A ray that leaves a light: from a surface safely, from a point as it is.
template <std::floating_point T>
[[nodiscard]] RayT<T> leave(const SurfacePointT<T>& point,
                            const Vec3T<T>& direction) noexcept {
    return spawn_ray(point, direction);
}
/// From a point that lies on no surface.
template <std::floating_point T>
[[nodiscard]] RayT<T> leave(const Vec3T<T>& point, const Vec3T<T>& direction) noexcept {
    return {.origin = point, .direction = direction};
}

} // namespace detail

/// A photon as it leaves one light.
template <std::floating_point T>
struct LeavingPhotonT {
    RayT<T> ray{};      ///< Where it is and where it goes; its time is still to be set.
    RgbT<T> flux{T(0)}; ///< W, of all photons of the light together.
};

/// A photon of a light, with the density of what the light sends: uniform over a lamp's
/// area and with cos / pi in direction; uniform over the sphere from a point; as the
/// intensity from a spot; and from afar side by side, over the disc that the sphere
/// around the scene throws as its shadow.
/// \param light        The light, as its scene keeps it.
/// \param u_point      Point of the unit square: where on the light.
/// \param u_direction  Point of the unit square: where to.
/// \param time         Of the photon, in [0, 1].
/// \return Ray and flux.
// [emit_photon]
template <Light L, std::floating_point T>
[[nodiscard]] LeavingPhotonT<T> emit_photon(const L& light, const Vec2T<T>& u_point,
                                            const Vec2T<T>& u_direction, T time) {
    if constexpr (FarLight<L>) {
        const ArrivalT<T> arrival = sample_arrival(light, u_direction);
        const SphereT<T>& around = light.around;
        return {detail::ray_from_afar(around, arrival.direction, around.center,
                                      around.radius, u_point),
                detail::disc_area(around.radius) * arrival.irradiance};
    } else {
        const auto point = emission_point(light, u_point, time);
        return {detail::leave(point, sample_emission(light, point, u_direction)),
                power(light)};
    }
}
// [emit_photon]

/// A photon as it leaves its light.
template <std::floating_point T>
struct EmittedPhotonT {
    RayT<T> ray{};      ///< Where it is, where it goes, and when.
    RgbT<T> flux{T(0)}; ///< W, of all paths together: divide by how many are emitted.
    std::uint16_t light = 0; ///< The number of its light.
};

/// A photon of a light chosen by power, see emit_photon().
///
/// Each photon of a white light then carries the same flux, the scene's whole flux over
/// the number of photons; a coloured light's differs in its channels only.
/// \param world   The closed scene.
/// \param choice  Of its lights, at least one: World::light_choice(), or another.
/// \param stream  Five numbers are drawn; of any kind, see \ref low_discrepancy.
/// \return The photon; its flux is that of all paths together.
/// \report{Section 3.2.2}
/// \erratum{The program behind the report gives every light the same number of photons
///          and the same flux whatever its area, and multiplies the flux by the cosine
///          that the direction's density already holds.}
// [emit]
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] EmittedPhotonT<typename W::Scalar>
emit(const W& world, const LightChoice& choice, Stream& stream) {
    using T = typename W::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    const T time = detail::path_time(world, stream);
    LeavingPhotonT<T> photon = world.visit_light(chosen.light, [&](const auto& light) {
        return emit_photon(light, u_point, u_direction, time);
    });
    photon.ray.time = time;
    return {.ray = photon.ray,
            .flux = photon.flux / chosen.probability,
            .light = static_cast<std::uint16_t>(chosen.light)};
}
// [emit]

/// \}

/// \defgroup tracing Photon tracing
/// \brief Section 3.2.2: photons bounce "until Russian roulette decides otherwise".
/// \{

/// Compensated Russian roulette: a photon survives with the probability of its
/// reflection, and a survivor carries what the others had \cite arvo1990.
/// \param flux    Before the surface; not black.
/// \param weight  f |cos| / pdf of the new direction.
/// \param u       In [0, 1).
/// \param audit   Takes what was absorbed, and what roulette moved.
/// \return The flux that goes on; nothing if the photon ends here.
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

namespace detail {

/// Stores shadow photons on the matt surfaces behind the first one that a photon meets.
///
/// A surface has two sides, and what a side does not get is the light whose cosine with
/// *that side's* normal is positive. A ray that goes straight on comes to one side of
/// each surface, and the cosine is positive there, wherever the surface's own normal
/// points. So nothing is asked of the normal, as nothing is asked of it for a direct
/// photon; whoever reads the map asks photon_side(). Direct and shadow photons together
/// are then, on each side, all the light that would come if nothing stood in its way.
/// \param world   The closed scene.
/// \param photon  As it left its light.
/// \param first   The first surface it met.
/// \param stream  A copy: the photon's own path draws from where it was. A number is
///                drawn for each thin surface.
/// \param out     Takes the photons.
/// \cost One search for the closest surface for each surface behind the first, and one
///       more; it ends after 1000.
/// \report{Section 3.2.2.1} \cite jensen1995
// [trace_shadow]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
void trace_shadow(const W& world, const EmittedPhotonT<T>& photon,
                  const SurfacePointT<T>& first, Stream stream,
                  std::vector<PhotonT<T>>& out) {
    const auto straight_on = [&](const SurfacePointT<T>& from) {
        return spawn_ray(from, photon.ray.direction, photon.ray.time);
    };
    PathStateT<T> path{.ray = straight_on(first)};
    while (path.depth < 1000) {
        const auto vertex = next_vertex(world, path, stream);
        if (!vertex) return;
        const auto diffuse = [](const auto& m) {
            return has(lobes(m), Lobes::non_specular);
        };
        if (world.visit_material(vertex->object.material, diffuse))
            out.push_back({at_rest(world, *vertex).point.position, path.ray.direction,
                           photon.flux, photon.light, PhotonKind::shadow,
                           small_normal(vertex->point.normal)});
        path.ray = straight_on(vertex->point);
    }
}
// [trace_shadow]

/// What kind of photon a path would leave where it is now.
/// \param path  The path of a photon.
/// \return Its kind; never a shadow.
template <std::floating_point T>
[[nodiscard]] PhotonKind kind_of(const PathStateT<T>& path) noexcept {
    if (path.met_diffuse) return PhotonKind::indirect;
    return path.met_specular ? PhotonKind::caustic : PhotonKind::direct;
}

/// Stores a photon, if the surface is diffuse and the map keeps photons of its kind.
/// \param world     The closed scene.
/// \param path      The path of the photon; its throughput is the flux.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \param light     The number of its light.
/// \param map       For which map.
/// \param keep      Which kinds are kept.
/// \param out       Takes it.
template <AnyWorld W, std::floating_point T, Material M>
void store_photon(const W& world, const PathStateT<T>& path, const VertexT<T>& vertex,
                  const M& material, std::uint16_t light, MapType map, PhotonKinds keep,
                  std::vector<PhotonT<T>>& out) {
    const PhotonKind kind = kind_of(path);
    const bool caustics = map == MapType::caustics;
    const bool owned = (kind == PhotonKind::caustic) == caustics && keep.has(kind);
    if (!owned || !has(lobes(material), Lobes::non_specular)) return;
    const T landing = detail::landing_factor(vertex, path.ray.direction);
    if (!(landing > T(0))) return;
    out.push_back({at_rest(world, vertex).point.position, path.ray.direction,
                   landing * path.throughput, light, kind,
                   small_normal(vertex.point.normal)});
}

/// Scatters a photon at a vertex, unless roulette ends it there.
/// \param path      Gets its new ray, flux and medium.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \param map       For which map: caustics photons go on by mirrors and glass only.
/// \param stream    Four numbers are drawn.
/// \param audit     Takes what was absorbed, and what roulette moved.
/// \return Whether it goes on.
template <std::floating_point T, Material M, StreamLike Stream>
[[nodiscard]] bool scatter_photon(PathStateT<T>& path, const VertexT<T>& vertex,
                                  const M& material, MapType map, Stream& stream,
                                  FluxAudit& audit) {
    const RgbT<T> flux = path.throughput;
    const bool only_specular = map == MapType::caustics || vertex.turned;
    const Lobes which = only_specular ? Lobes::specular : Lobes::all;
    path.throughput = RgbT<T>{T(1)}; // so that what is left is the weight alone
    if (!continue_path(path, vertex, material, Transport::flux, which, stream)) {
        audit.absorbed += RgbT<double>(flux);
        return false;
    }
    const auto survivor =
        play_roulette(flux, path.throughput, next_1d<T>(stream), audit);
    if (!survivor) return false;
    path.throughput = *survivor;
    return true;
}

/// A photon as a pass sends it.
template <std::floating_point T>
struct SentPhotonT {
    EmittedPhotonT<T> photon{};       ///< As it leaves its light.
    std::optional<ObjectId> target{}; ///< Where it was aimed, if it was; another first
                                      ///< hit ends it.
};

/// Follows one photon and stores it at every diffuse surface where its map keeps it.
///
/// A photon that has met nothing but mirrors and glass is a caustic one: the caustics
/// map holds it, and the general map leaves it out, so that no light is counted twice.
/// \param world   The closed scene.
/// \param map     For which map.
/// \param sent    As it leaves its light, its flux already divided by the number of
///                paths.
/// \param pass    Limits.
/// \param stream  Four numbers per bounce.
/// \param block   Takes the photons and the flux.
// [trace]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
void trace_photon(const W& world, MapType map, const SentPhotonT<T>& sent,
                  const PhotonPassSettings& pass, Stream& stream,
                  PhotonBlockT<T>& block) {
    const EmittedPhotonT<T>& photon = sent.photon;
    FluxAudit& audit = block.audit;
    PathStateT<T> path{.ray = photon.ray, .throughput = photon.flux};
    audit.emitted += RgbT<double>(photon.flux);
    while (path.depth < pass.max_bounces) {
        const RgbT<double> before{path.throughput};
        const auto vertex = next_vertex(world, path, stream);
        if (!vertex) {
            audit.escaped += before;
            return;
        }
        const bool first = path.depth == 1;
        if (first && sent.target && vertex->id != *sent.target) {
            audit.cut += before;
            return;
        }
        if (first && map == MapType::general && pass.shadow_photons)
            trace_shadow(world, photon, vertex->point, stream, block.photons);
        audit.absorbed +=
            before - RgbT<double>(path.throughput); // by what lies between
        if (is_black(path.throughput)) return;

        const auto at_material = [&]<typename M>(const M& material) {
            if constexpr (!OnlySpecular<M>)
                store_photon(world, path, *vertex, material, photon.light, map,
                             pass.keep, block.photons);
            return scatter_photon(path, *vertex, material, map, stream, audit);
        };
        if (!visit_material_at(world, *vertex, at_material)) return;
    }
    audit.cut += RgbT<double>(path.throughput);
}
// [trace]

} // namespace detail

/// \}

} // namespace ljus
