#pragma once

/// \file ljus/photons/photon_path.hpp
/// \brief How one photon travels through a scene, and where it is stored.

#include <algorithm>
#include <optional>
#include <vector>

#include "ljus/path/continue_path.hpp"
#include "ljus/path/emission.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/photon_pass.hpp"

namespace ljus {

/// \addtogroup tracing
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
/// \param scene   The scene.
/// \param photon  As it left its light.
/// \param first   The first surface it met.
/// \param stream  A copy: the photon's own path draws from where it was. A number is
///                drawn for each thin surface.
/// \param out     Takes the photons.
/// \cost One search for the closest surface for each surface behind the first, and one
///       more; it ends after 1000.
/// \report{Section 3.2.2.1} \cite jensen1995
// [trace_shadow]
template <SceneLike S, std::floating_point T, typename Stream>
void trace_shadow(const S& scene, const EmittedPhotonT<T>& photon,
                  const SurfacePointT<T>& first, Stream stream,
                  std::vector<PhotonT<T>>& out) {
    const auto straight_on = [&](const SurfacePointT<T>& from) {
        return spawn_ray(from, photon.ray.direction, photon.ray.time);
    };
    PathStateT<T> path{.ray = straight_on(first)};
    while (path.depth < 1000) {
        const auto vertex = next_vertex(scene, path, stream);
        if (!vertex) return;
        const auto diffuse = [](const auto& m) {
            return has(lobes(m), Lobes::non_specular);
        };
        if (scene.visit_material(vertex->object.material, diffuse))
            out.push_back({vertex->point.position, path.ray.direction, photon.flux,
                           photon.light, PhotonKind::shadow,
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
/// \param path      The path of the photon; its throughput is the flux.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \param light     The number of its light.
/// \param map       For which map.
/// \param keep      Which kinds are kept.
/// \param out       Takes it.
template <std::floating_point T, Material M>
void store_photon(const PathStateT<T>& path, const VertexT<T>& vertex,
                  const M& material, std::uint16_t light, MapType map, PhotonKinds keep,
                  std::vector<PhotonT<T>>& out) {
    const PhotonKind kind = kind_of(path);
    const bool caustics = map == MapType::caustics;
    const bool owned = (kind == PhotonKind::caustic) == caustics && keep.has(kind);
    if (!owned || !has(lobes(material), Lobes::non_specular)) return;
    const T landing = detail::landing_factor(vertex, path.ray.direction);
    if (!(landing > T(0))) return;
    out.push_back({vertex.point.position, path.ray.direction, landing * path.throughput,
                   light, kind, small_normal(vertex.point.normal)});
}

/// Scatters a photon at a vertex, unless roulette ends it there.
/// \param path      Gets its new ray, flux and medium.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \param map       For which map: caustics photons go on by mirrors and glass only.
/// \param stream    Four numbers are drawn.
/// \param audit     Takes what was absorbed, and what roulette moved.
/// \return Whether it goes on.
template <std::floating_point T, Material M, typename Stream>
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

/// Follows one photon and stores it at every diffuse surface where its map keeps it.
///
/// A photon that has met nothing but mirrors and glass is a caustic one: the caustics
/// map holds it, and the general map leaves it out, so that no light is counted twice.
/// \param scene   The scene.
/// \param map     For which map.
/// \param photon  As it leaves its light, its flux already divided by the number of
///                paths.
/// \param target  Where it was aimed; for caustics, another first hit ends it.
/// \param pass    Limits.
/// \param stream  Four numbers per bounce.
/// \param out     Takes the photons.
/// \param audit   Takes the flux.
// [trace]
template <SceneLike S, std::floating_point T, typename Stream>
void trace_photon(const S& scene, MapType map, const EmittedPhotonT<T>& photon,
                  std::optional<ObjectId> target, const PhotonPassSettings& pass,
                  Stream& stream, std::vector<PhotonT<T>>& out, FluxAudit& audit) {
    PathStateT<T> path{.ray = photon.ray, .throughput = photon.flux};
    audit.emitted += RgbT<double>(photon.flux);
    while (path.depth < pass.max_bounces) {
        const RgbT<double> sent{path.throughput};
        const auto vertex = next_vertex(scene, path, stream);
        if (!vertex) {
            audit.escaped += sent;
            return;
        }
        const bool first = path.depth == 1;
        if (first && target && vertex->id != *target) {
            audit.cut += sent;
            return;
        }
        if (first && map == MapType::general && pass.shadow_photons)
            trace_shadow(scene, photon, vertex->point, stream, out);
        audit.absorbed += sent - RgbT<double>(path.throughput); // by what lies between
        if (is_black(path.throughput)) return;

        const auto at_material = [&]<typename M>(const M& material) {
            if constexpr (!OnlySpecular<M>)
                store_photon(path, *vertex, material, photon.light, map, pass.keep,
                             out);
            return scatter_photon(path, *vertex, material, map, stream, audit);
        };
        if (!visit_material_at(scene, *vertex, at_material)) return;
    }
    audit.cut += RgbT<double>(path.throughput);
}
// [trace]

} // namespace detail

/// \}

} // namespace ljus
