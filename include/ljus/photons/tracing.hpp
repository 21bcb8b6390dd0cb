#pragma once

/// \file ljus/photons/tracing.hpp
/// \brief A pass of photons: sent by the lights, traced, kept in order.

#include <algorithm>
#include <initializer_list>
#include <optional>
#include <utility>
#include <vector>

#include "ljus/parallel.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/photons/aiming.hpp"
#include "ljus/photons/photon_pass.hpp"

namespace ljus {

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
                store_photon(path, *vertex, material, photon.light, map, pass.keep,
                             block.photons);
            return scatter_photon(path, *vertex, material, map, stream, audit);
        };
        if (!visit_material_at(world, *vertex, at_material)) return;
    }
    audit.cut += RgbT<double>(path.throughput);
}
// [trace]

} // namespace detail

namespace detail {

/// Sends and traces the paths of one block.
/// \param world    The closed scene.
/// \param map      For which map.
/// \param choice   Of the scene's lights.
/// \param targets  What caustics photons are aimed at.
/// \param pass     How many in all, and with which seed.
/// \param paths    Which of them.
/// \param block    Takes the photons and the account.
template <AnyWorld W, std::floating_point T>
void trace_block(const W& world, MapType map, const LightChoice& choice,
                 const std::vector<ObjectId>& targets, const PhotonPassSettings& pass,
                 const BlockRange& paths, PhotonBlockT<T>& block) {
    const Pass part =
        map == MapType::caustics ? Pass::caustics_photons : Pass::general_photons;
    for (long long i = paths.first; i < paths.last; ++i) {
        const auto path = static_cast<std::uint64_t>(i);
        SobolStream stream = pass.numbers == PhotonSampling::sobol
                                 ? sobol_stream(pass.seed, part, pass.iteration, path)
                                 : detail::without_points(random_stream(
                                       pass.seed, part, pass.iteration, path));
        SentPhotonT<T> sent;
        if (map == MapType::caustics) {
            const auto aimed =
                aim_by_share(world, choice, targets, pass.shares, stream);
            if (!aimed) {
                ++block.unsent;
                continue;
            }
            sent = {aimed->photon, aimed->target};
        } else {
            sent.photon = emit(world, choice, stream);
        }
        sent.photon.flux /= static_cast<T>(pass.photons);
        trace_photon(world, map, sent, pass, stream, block);
    }
}

/// Joins the photons of blocks, in their order, and frees them.
/// \param blocks  The blocks.
/// \param result  Takes the photons and the account.
/// \return Paths that no light could send.
template <std::floating_point T>
long long join_blocks(std::vector<PhotonBlockT<T>>& blocks, TracedPhotonsT<T>& result) {
    std::size_t stored = 0;
    for (const PhotonBlockT<T>& block : blocks) stored += block.photons.size();
    result.photons.reserve(stored);
    long long unsent = 0;
    for (PhotonBlockT<T>& block : blocks) {
        for (PhotonT<T>& photon : block.photons)
            result.photons.push_back(std::move(photon));
        result.audit += block.audit;
        unsent += block.unsent;
        block = {};
    }
    return unsent;
}

/// Checks what a pass starts from.
/// \param pass    The settings.
/// \param choice  Of the world's lights.
/// \return The choice between the lights that the pass asks for.
/// \throws std::invalid_argument  as trace_photons().
template <std::floating_point T>
[[nodiscard]] LightChoice start_pass(const PhotonPassSettings& pass,
                                     LightChoice choice) {
    check(pass);
    const std::size_t lights = choice.cumulative.size();
    require(lights > 0, "the number of lights", 0LL,
            "at least 1, because photons start at lights");
    require(lights <= 65536, "the number of lights", static_cast<long long>(lights),
            "at most 65536, because a photon has 16 bits for its light's number");
    require(choice.cumulative.back() > 0, "the power of all lights",
            choice.cumulative.back(), "above 0: a sun needs objects to shine on");
    require_memory<T>(pass, 0);
    for (std::size_t i = 0; pass.equal_lights && i < lights; ++i)
        choice.cumulative[i] = static_cast<double>(i + 1);
    return choice;
}

/// A trace_block() for a scene of any type, as compiled code can call it: run_pass() is
/// the same for all of them, and not compiled again for each.
template <std::floating_point T>
struct BlockTracerT {
    const void* tracer; ///< What `call` knows the type of.
    void (*call)(const void* tracer, const BlockRange& paths, PhotonBlockT<T>& block);
};

/// Traces the blocks of a pass, by several threads, and joins them.
/// \param map    For which map.
/// \param pass   How many paths.
/// \param trace  Traces a block.
/// \return The photons in the order of emission.
/// \throws std::invalid_argument  if the memory would not do.
template <std::floating_point T>
[[nodiscard]] TracedPhotonsT<T> run_pass(MapType map, const PhotonPassSettings& pass,
                                         BlockTracerT<T> trace) {
    TracedPhotonsT<T> result{.emitted = pass.photons};
    std::vector<PhotonBlockT<T>> blocks;
    const long long count = block_count(pass.photons, photon_block);
    long long done = 0;  // blocks
    bool nothing = true; // has been stored so far
    for (const long long paths : {pilot_paths, pass.give_up, pass.photons}) {
        const long long last = std::min(block_count(paths, photon_block), count);
        if (last <= done) continue;
        blocks.resize(static_cast<std::size_t>(last));
        const auto body = [&](long long i) {
            trace.call(trace.tracer, block_range(done + i, photon_block, pass.photons),
                       blocks[static_cast<std::size_t>(done + i)]);
        };
        const auto progress = [&](long long now, long long) {
            return pass.progress(done + now, count);
        };
        result.complete = parallel_blocks(
            last - done, body, {.threads = pass.threads, .progress = progress});
        done = last;
        result.emitted = std::min(last * photon_block, pass.photons);
        std::size_t stored = 0;
        for (const auto& block : blocks) stored += block.photons.size();
        nothing = stored == 0;
        if (!result.complete) break;
        require_memory<T>(pass, double(stored) / double(std::max(result.emitted, 1LL)));
        if (nothing && result.emitted >= pass.give_up) break;
    }
    const long long unsent = join_blocks(blocks, result);
    if (nothing && result.complete && result.emitted < pass.photons) {
        result.audit *= double(pass.photons) / double(result.emitted);
        result.remark = why_nothing(pass, map, result.emitted, unsent, result.audit);
    }
    return result;
}

} // namespace detail

/// Emits and traces the photons of one map, by several threads.
///
/// Some 2000 paths tell how many photons are stored in the mean; a pass that would need
/// more than PhotonPassSettings::max_memory is refused before it takes it. A pass of
/// which nothing was stored in PhotonPassSettings::give_up paths ends there, and says
/// why.
/// \param world  The closed scene, with at least one light.
/// \param map    For which map.
/// \param pass   How many, and with which seed.
/// \return The photons in the order of emission, the same for any number of threads.
/// \throws std::invalid_argument  if the scene has no light or more than 65536, a
///         number of the pass is out of range, or the memory would not do.
template <AnyWorld W>
[[nodiscard]] TracedPhotonsT<typename W::Scalar>
trace_photons(const W& world, MapType map, const PhotonPassSettings& pass) {
    using T = typename W::Scalar;
    const LightChoice choice = detail::start_pass<T>(pass, world.light_choice());
    const bool caustics = map == MapType::caustics;
    const auto targets = caustics ? specular_objects(world) : std::vector<ObjectId>{};
    if (caustics) check_shares(pass.shares, targets.size());
    if (caustics && targets.empty()) return {.emitted = pass.photons};

    const auto trace = [&](const detail::BlockRange& paths,
                           detail::PhotonBlockT<T>& block) {
        detail::trace_block(world, map, choice, targets, pass, paths, block);
    };
    const auto call = [](const void* tracer, const detail::BlockRange& paths,
                         detail::PhotonBlockT<T>& block) {
        (*static_cast<const decltype(trace)*>(tracer))(paths, block);
    };
    return detail::run_pass<T>(map, pass, {&trace, call});
}

/// \}

} // namespace ljus
