#pragma once

/// \file ljus/photons/photon_path.hpp
/// \brief The path of a photon: emission, storage and scattering, until it is absorbed
/// or leaves the scene.

#include <algorithm>
#include <optional>
#include <vector>

#include "ljus/math/low_discrepancy.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/fog_path.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/photon_pass.hpp"

namespace ljus {

/// \defgroup emission Photon emission
/// \brief Section 3.2.2 of the report: photons are "shot from all the light sources
/// into the scene".
/// \{

namespace detail {

/// The ray of a photon that leaves a light.
template <std::floating_point T>
[[nodiscard]] RayT<T> leave(const SurfacePointT<T>& point,
                            const Vec3T<T>& direction) noexcept {
    return spawn_ray(point, direction);
}
template <std::floating_point T>
[[nodiscard]] RayT<T> leave(const Vec3T<T>& point, const Vec3T<T>& direction) noexcept {
    return {.origin = point, .direction = direction};
}

/// The flux of a photon that leaves from a point of a light, times the number of
/// photons of the light: flux_from() if the light provides this function, otherwise
/// power().
template <typename L, typename Point>
[[nodiscard]] RgbT<typename L::Scalar> flux_leaving(const L& light,
                                                    const Point& point) {
    if constexpr (requires { flux_from(light, point); })
        return flux_from(light, point);
    else
        return power(light);
}

} // namespace detail

/// A photon that leaves a given light.
template <std::floating_point T>
struct LeavingPhotonT {
    RayT<T> ray{};      ///< The ray, without its time.
    RgbT<T> flux{T(0)}; ///< Flux times the number of photons of the light, in W.
};

/// Emits a photon of a light, with the density of the light's own emission. A near
/// light uses its emission_point() and sample_emission(). A distant light uses its
/// sample_arrival(), and starts the photon from a uniform point of a disc: the cross
/// section of the sphere around the scene, moved out of the scene.
/// \param light        The light, as its scene stores it.
/// \param u_point      Point of the unit square; chooses the origin.
/// \param u_direction  Point of the unit square; chooses the direction.
/// \param time         Time of the photon, in [0, 1].
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
                detail::flux_leaving(light, point)};
    }
}
// [emit_photon]

/// A photon that leaves a light chosen at random.
template <std::floating_point T>
struct EmittedPhotonT {
    RayT<T> ray{};           ///< Origin, direction and time.
    RgbT<T> flux{T(0)};      ///< The flux in W, not yet divided by the number of paths.
    std::uint16_t light = 0; ///< Index of the light.
};

namespace detail {

/// Emits photons by emit_photon(), for a pass that does not aim at the scene.
struct LeaveAsEmitted {
    template <Light L, std::floating_point T>
    [[nodiscard]] LeavingPhotonT<T>
    operator()(std::uint32_t, const L& light, const Vec2T<T>& u_point,
               const Vec2T<T>& u_direction, T time) const {
        return emit_photon(light, u_point, u_direction, time);
    }
};

} // namespace detail

/// Emits a photon of a light chosen at random; see emit_photon(). If the light is
/// chosen in proportion to its power, the flux, summed over the channels, is the same
/// for all photons.
/// \param world   The closed scene.
/// \param choice  The distribution of the lights, at least one. World::light_choice()
///                chooses them in proportion to power.
/// \param stream  Five numbers are drawn, and one more if a shape moves.
/// \param leave   Emits the photon of the chosen light: by default emit_photon(), or a
///                SceneAimT.
/// \return The photon. Its flux is not yet divided by the number of paths.
/// \report{Section 3.2.2}
/// \erratum{The report's program gives every light the same number of photons and the
/// same flux, whatever its area. It multiplies the flux by a cosine that the density of
/// the direction already contains.}
// [emit]
template <AnyWorld W, StreamLike Stream, typename Leave = detail::LeaveAsEmitted>
[[nodiscard]] EmittedPhotonT<typename W::Scalar>
emit(const W& world, const LightChoice& choice, Stream& stream,
     const Leave& leave = {}) {
    using T = typename W::Scalar;
    const ChosenLightT<T> chosen = choose_light(choice, next_1d<T>(stream));
    const Vec2T<T> u_point = next_2d<T>(stream);
    const Vec2T<T> u_direction = next_2d<T>(stream);
    const T time = detail::path_time(world, stream);
    LeavingPhotonT<T> photon = world.visit_light(chosen.light, [&](const auto& light) {
        return leave(chosen.light, light, u_point, u_direction, time);
    });
    photon.ray.time = time;
    return {.ray = photon.ray,
            .flux = photon.flux / chosen.probability,
            .light = static_cast<std::uint16_t>(chosen.light)};
}
// [emit]

/// \}

/// \defgroup tracing Photon tracing
/// \brief Section 3.2.2 of the report: photons bounce "until Russian roulette decides
/// otherwise".
/// \{

/// Russian roulette for a photon at a surface \cite arvo1990. The probability of
/// survival is the flux in the brightest channel after the reflection, divided by that
/// before the reflection. The flux of a survivor is divided by this probability, so
/// that the mean flux stays the same.
/// \param flux    Flux before the reflection, in W; not black.
/// \param weight  BSDF times |cosine| over pdf, for the new direction.
/// \param u       In [0, 1).
/// \param audit   Receives the absorbed flux, and the flux lost and gained by roulette.
/// \return The new flux; nothing if the photon does not survive.
/// \report{Section 3.2.2}
/// \erratum{The report does not say that the flux of a survivor must be divided by the
/// probability. Its program does not divide it, and so counts the absorption twice.}
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

/// Stores shadow photons on the diffuse surfaces behind the first hit of a photon. On
/// each side of a surface, direct and shadow photons together represent the unoccluded
/// light.
/// \param photon  The photon as it leaves the light.
/// \param stream  A copy of the photon's stream. One number is drawn per thin surface.
/// \cost One call of closest_hit() for each surface behind the first, and one more; at
///       most 1000.
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

/// The kind of photon that a path would store at its current vertex.
template <std::floating_point T>
[[nodiscard]] PhotonKind kind_of(const PathStateT<T>& path) noexcept {
    if (path.met_diffuse) return PhotonKind::indirect;
    return path.met_specular ? PhotonKind::caustic : PhotonKind::direct;
}

/// The factor of a photon's flux where shading normal and geometric normal differ. The
/// density of photons on a surface contains the cosine to the geometric normal, but the
/// material needs the cosine to the shading normal.
/// \param direction  The photon's unit direction of travel.
/// \return |cosine| to the shading normal over |cosine| to the geometric normal. 0 if
///         the two normals disagree about the side.
template <std::floating_point T>
[[nodiscard]] T landing_factor(const VertexT<T>& vertex,
                               const Vec3T<T>& direction) noexcept {
    if (vertex.turned) return T(0);
    if (!vertex.smooth) return T(1);
    return std::abs(vertex.wo.z / glm::dot(direction, vertex.point.normal));
}

/// Stores a photon if the surface has a non-specular lobe and the map stores this kind
/// of photon. The throughput of the path is the photon's flux.
template <AnyWorld W, std::floating_point T, Material M>
void store_photon(const W& world, const PathStateT<T>& path, const VertexT<T>& vertex,
                  const M& material, std::uint16_t light, MapType map, PhotonKinds keep,
                  std::vector<PhotonT<T>>& out) {
    const PhotonKind kind = kind_of(path);
    const bool caustics = map == MapType::caustics;
    const bool owned = (kind == PhotonKind::caustic) == caustics && keep.has(kind);
    if (!owned || !has(lobes(material), Lobes::non_specular)) return;
    const T landing = landing_factor(vertex, path.ray.direction);
    if (!(landing > T(0))) return;
    Vec3T<T> position = vertex.point.position;
    if constexpr (lists_moving<W>) position = at_rest(world, vertex).point.position;
    out.push_back({position, path.ray.direction, landing * path.throughput, light, kind,
                   small_normal(vertex.point.normal)});
}

/// Scatters a photon at a vertex, and plays Russian roulette. For a caustics map only
/// specular lobes are sampled.
/// \param path    Receives the new ray, flux and medium.
/// \param stream  Four numbers are drawn.
/// \param gloss   Whether the glossy lobe of the surface counts as a mirror.
/// \return Whether the path continues.
template <std::floating_point T, Material M, StreamLike Stream>
[[nodiscard]] bool scatter_photon(PathStateT<T>& path, const VertexT<T>& vertex,
                                  const M& material, MapType map, Stream& stream,
                                  FluxAudit& audit, bool gloss = false) {
    const RgbT<T> flux = path.throughput;
    const bool only_specular = map == MapType::caustics || vertex.turned;
    const Lobes mirrors =
        gloss && !vertex.turned ? Lobes::specular | Lobes::glossy : Lobes::specular;
    const Lobes which = only_specular ? mirrors : Lobes::all;
    const bool met_diffuse = path.met_diffuse;
    path.throughput = RgbT<T>{T(1)}; // continue_path() turns it into the weight
    if (!continue_path(path, vertex, material, Transport::flux, which, stream)) {
        audit.absorbed += RgbT<double>(flux);
        return false;
    }
    if (gloss) {
        path.met_diffuse = met_diffuse;
        path.met_specular = true;
    }
    const auto survivor =
        play_roulette(flux, path.throughput, next_1d<T>(stream), audit);
    if (!survivor) return false;
    path.throughput = *survivor;
    return true;
}

/// Takes a photon through the fog before its next surface. fly() decides whether and
/// where fog scatters the photon.
///
/// Where fog scatters it, a photon of the kind PhotonKind::fog is stored if the path so
/// far is L S+ for the caustics map, or L ... D ... for the general map. Direct light
/// in fog is left to shadow rays. In the general pass the photon then goes on in its
/// new direction, unless Russian roulette ends it. In the caustics pass it goes
/// straight on, and the fog attenuates its flux.
/// \param path     The path after next_vertex(). Receives the flux and, if fog scatters
///                 the photon, the new ray.
/// \param before   The flux before next_vertex(); receives the flux at the surface.
/// \param surface  Distance to the next surface along the path's ray.
/// \param stream   One number is drawn, and one for each medium; three more if the
///                 photon is scattered, of which one is for roulette.
// [photon in fog]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] InFog cross_fog(const W& world, MapType map, PathStateT<T>& path,
                              RgbT<double>& before, T surface, PhotonKinds keep,
                              Stream& stream, PhotonBlockT<T>& block) {
    if (!meets_fog(world, path.ray)) return InFog::crossed;
    FogSegmentT<T> segment{path.ray, RgbT<T>(before)};
    segment.ray.t_max = surface;
    PathStateT<T> flight = path;
    flight.throughput = RgbT<T>{T(1)}; // fly() turns it into the weight
    const auto vertex = fly(world, segment, flight, stream);
    const bool caustics = map == MapType::caustics;
    const PhotonKind owned = caustics ? PhotonKind::caustic : PhotonKind::indirect;
    if (vertex && keep.has(PhotonKind::fog) && kind_of(path) == owned)
        block.photons.push_back({vertex->point.position, vertex->travel,
                                 segment.throughput * flight.throughput,
                                 static_cast<std::uint16_t>(vertex->medium),
                                 PhotonKind::fog});
    if (vertex && !caustics) {
        const auto survivor = play_roulette(segment.throughput, flight.throughput,
                                            next_1d<T>(stream), block.audit);
        if (!survivor) return InFog::ended;
        path.throughput = *survivor;
        visit_fog(world, vertex->medium, [&](const auto& medium) {
            scatter_in_fog(path, *vertex, medium, stream);
        });
        return InFog::scattered;
    }
    path.throughput *= caustics ? transmittance(optical_depth(world, segment.ray), T(1))
                                : flight.throughput;
    const RgbT<double> after(path.throughput);
    block.audit.absorbed += before - after;
    before = after;
    return InFog::crossed;
}
// [photon in fog]

/// A photon as a pass emits it.
template <std::floating_point T>
struct SentPhotonT {
    EmittedPhotonT<T> photon{}; ///< The photon as it leaves its light.
    /// The target, if any. A photon that first hits another object is dropped, unless
    /// that object is one of `others`.
    std::optional<ObjectId> target{};
    std::vector<ObjectId> others{};
};

/// Traces a photon and stores it at each surface with a non-specular lobe.
///
/// If PhotonPassSettings::gloss_as_mirrors is true, a nearly_specular() surface counts
/// as a mirror. A photon that has met such a surface, and no other surfaces but mirrors
/// and glass, is stored only at surfaces with a diffuse lobe.
/// \param sent    The photon. Its flux has been divided by the number of paths.
/// \param stream  Four numbers are drawn per bounce; more in fog, at thin surfaces and
///                where a wavelength is chosen.
// [trace]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
void trace_photon(const W& world, MapType map, const SentPhotonT<T>& sent,
                  const PhotonPassSettings& pass, Stream& stream,
                  PhotonBlockT<T>& block) {
    const EmittedPhotonT<T>& photon = sent.photon;
    FluxAudit& audit = block.audit;
    PathStateT<T> path{.ray = photon.ray, .throughput = photon.flux};
    audit.emitted += RgbT<double>(photon.flux);
    bool by_gloss = false; // whether a glossy lobe counted as a mirror
    while (path.depth < pass.max_bounces) {
        RgbT<double> before{path.throughput};
        [[maybe_unused]] const T wavelength = path.wavelength;
        const auto vertex = next_vertex(world, path, stream);
        if constexpr (lists_dispersive<W>)
            if (path.wavelength != wavelength) { // it takes the flux of all wavelengths
                const RgbT<double> all = before;
                before *= RgbT<double>(wavelength_color(path.wavelength));
                audit.roulette += all - before;
            }
        if constexpr (W::lists_fog) {
            const T surface = vertex ? vertex->distance : path.ray.t_max;
            const InFog fog =
                cross_fog(world, map, path, before, surface, pass.keep, stream, block);
            if (fog == InFog::scattered) continue;
            if (fog == InFog::ended) return;
        }
        const RgbT<double> after(path.throughput);
        audit.absorbed += before - after; // by media and thin surfaces
        if (!vertex) {
            audit.escaped += after;
            return;
        }
        const bool first = path.depth == 1;
        const auto& others = sent.others;
        if (first && sent.target && vertex->id != *sent.target &&
            std::find(others.begin(), others.end(), vertex->id) == others.end()) {
            audit.cut += after;
            return;
        }
        if (first && map == MapType::general && pass.shadow_photons)
            trace_shadow(world, photon, vertex->point, stream, block.photons);
        if (is_black(path.throughput)) return;

        const auto at_material = [&]<typename M>(const M& material) {
            if constexpr (!OnlySpecular<M>)
                if (!by_gloss || path.met_diffuse ||
                    has(lobes(material), Lobes::diffuse))
                    store_photon(world, path, *vertex, material, photon.light, map,
                                 pass.keep, block.photons);
            const bool gloss =
                pass.gloss_as_mirrors && nearly_specular_at(world, *vertex, material);
            if (!scatter_photon(path, *vertex, material, map, stream, audit, gloss))
                return false;
            by_gloss |= gloss && !path.specular;
            return true;
        };
        if (!visit_material_at(world, *vertex, at_material)) return;
    }
    audit.cut += RgbT<double>(path.throughput);
}
// [trace]

} // namespace detail

/// \}

} // namespace ljus
