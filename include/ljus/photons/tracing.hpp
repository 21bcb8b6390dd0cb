#pragma once

/// \file ljus/photons/tracing.hpp
/// \brief A photon pass: emission and tracing by several threads, in a fixed order.

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "ljus/parallel.hpp"
#include "ljus/photons/aiming.hpp"
#include "ljus/photons/photon_pass.hpp"
#include "ljus/photons/scene_aim.hpp"

namespace ljus {

/// \addtogroup tracing
/// \{

namespace detail {

/// Emits and traces the paths of a block.
template <AnyWorld W, std::floating_point T>
void trace_block(const W& world, MapType map, const SceneAimT<T>& aim,
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
                aim_by_share(world, aim.choice, targets, pass.shares, stream);
            if (!aimed) {
                ++block.unsent;
                continue;
            }
            sent = {aimed->photon, aimed->target};
        } else {
            sent.photon = emit(world, aim.choice, stream, aim);
            if (is_black(sent.photon.flux)) { // behind a lamp, or outside of its cone
                ++block.unsent;
                continue;
            }
        }
        sent.photon.flux /= static_cast<T>(pass.photons);
        trace_photon(world, map, sent, pass, stream, block);
    }
}

/// Joins blocks in their order, and frees them.
/// \return The number of paths that no light could emit.
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

/// Checks the settings and the lights of a pass.
/// \return The distribution for the pass.
/// \throws std::invalid_argument  as trace_photons().
template <std::floating_point T>
[[nodiscard, gnu::cold]] LightChoice
start_pass(MapType map, const PhotonPassSettings& pass, LightChoice choice) {
    check(pass);
    const std::size_t lights = choice.cumulative.size();
    require(lights > 0, "the number of lights", 0LL,
            "at least 1, because photons start at lights");
    require(lights <= 65536, "the number of lights", static_cast<long long>(lights),
            "at most 65536, because a photon has 16 bits for its light's number");
    require(choice.cumulative.back() > 0, "the power of all lights",
            choice.cumulative.back(), "above 0: a sun needs objects to shine on");
    require_memory<T>(map, pass, 0);
    check_shares(pass.light_shares, lights, "the number of lights");
    std::partial_sum(pass.light_shares.begin(), pass.light_shares.end(),
                     choice.cumulative.begin());
    for (std::size_t i = 0; pass.equal_lights && i < lights; ++i)
        choice.cumulative[i] = static_cast<double>(i + 1);
    return choice;
}

/// Where the photons of a pass leave their lights to; those of the caustics map are
/// aimed at single objects instead.
/// \param choice  The distribution of the lights for the pass.
template <AnyWorld W>
[[nodiscard]] SceneAimT<typename W::Scalar> scene_aim_of(const W& world, MapType map,
                                                         const PhotonPassSettings& pass,
                                                         LightChoice choice) {
    require_no_film_in_fog(world);
    if (map == MapType::caustics) return {.choice = std::move(choice)};
    return aim_at_scene(world, choice, pass.light_shares.empty() && !pass.equal_lights);
}

/// The objects at which the photons of a pass are aimed: none for the general map.
/// \throws std::invalid_argument  if the shares do not suit them.
template <AnyWorld W>
[[nodiscard]] std::vector<ObjectId> targets_of(const W& world, MapType map,
                                               const PhotonPassSettings& pass) {
    if (map == MapType::general) return {};
    auto targets = specular_objects(world, pass.gloss_as_mirrors);
    check_shares(pass.shares, targets.size());
    return targets;
}

/// A type-erased trace_block(), so that run_pass() is compiled only once for all types
/// of scenes.
template <std::floating_point T>
struct BlockTracerT {
    const void* tracer; ///< An object whose type `call` knows.
    void (*call)(const void* tracer, const BlockRange& paths, PhotonBlockT<T>& block);
};

/// Traces the blocks of a pass by several threads, and joins them.
/// \return The photons in the order of emission.
/// \throws std::invalid_argument  if the memory would not suffice.
template <std::floating_point T>
[[nodiscard]] TracedPhotonsT<T> run_pass(MapType map, const PhotonPassSettings& pass,
                                         BlockTracerT<T> trace) {
    TracedPhotonsT<T> result{.emitted = pass.photons};
    std::vector<PhotonBlockT<T>> blocks;
    const long long count = block_count(pass.photons, photon_block);
    long long done = 0;  // finished blocks
    bool nothing = true; // no photon has been stored
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
        require_memory<T>(map, pass,
                          double(stored) / double(std::max(result.emitted, 1LL)));
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
/// The first 2000 paths or so predict the memory; a pass that would need more than
/// PhotonPassSettings::max_memory is refused at that point. A pass that has stored
/// nothing after PhotonPassSettings::give_up paths ends with a remark.
/// \param world  The closed scene, with at least one light.
/// \param map    The kind of map.
/// \param pass   The settings.
/// \return The photons in the order of emission, the same for any number of threads.
/// \throws std::invalid_argument  if the scene has no light or more than 65536, a
///         setting is out of range, the memory would not suffice, or there are thin
///         surfaces in fog.
template <AnyWorld W>
[[nodiscard, gnu::cold]] TracedPhotonsT<typename W::Scalar>
trace_photons(const W& world, MapType map, const PhotonPassSettings& pass) {
    using T = typename W::Scalar;
    const auto aim = detail::scene_aim_of(
        world, map, pass, detail::start_pass<T>(map, pass, world.light_choice()));
    const auto targets = detail::targets_of(world, map, pass);
    if (map == MapType::caustics && targets.empty()) return {.emitted = pass.photons};

    const auto trace = [&](const detail::BlockRange& paths,
                           detail::PhotonBlockT<T>& block) {
        detail::trace_block(world, map, aim, targets, pass, paths, block);
    };
    const auto call = [](const void* tracer, const detail::BlockRange& paths,
                         detail::PhotonBlockT<T>& block) {
        (*static_cast<const decltype(trace)*>(tracer))(paths, block);
    };
    return detail::run_pass<T>(map, pass, {&trace, call});
}

/// Emits and traces some of the paths of a pass, by one thread, so that several
/// processes can share a pass: what they trace of it, joined in order, is what
/// trace_photons() traces.
/// \param world  The closed scene, with at least one light.
/// \param map    The kind of map.
/// \param pass   The settings of the whole pass, without `threads`, `progress` and
///               `give_up`.
/// \param first  The first path, 0 or more.
/// \param last   One past the last path, at most `pass.photons`.
/// \return Their photons in the order of emission, and where their flux went.
/// \throws std::invalid_argument  as trace_photons(), or if there are no such paths.
template <AnyWorld W>
[[nodiscard, gnu::cold]] TracedPhotonsT<typename W::Scalar>
trace_photons(const W& world, MapType map, const PhotonPassSettings& pass,
              long long first, long long last) {
    using T = typename W::Scalar;
    require_at_least("the first path", first, 0);
    require_at_least("the last path", last, first);
    require_at_least("the number of photons", pass.photons, last);
    const auto aim = detail::scene_aim_of(
        world, map, pass, detail::start_pass<T>(map, pass, world.light_choice()));
    const auto targets = detail::targets_of(world, map, pass);
    detail::PhotonBlockT<T> block;
    if (map == MapType::general || !targets.empty())
        detail::trace_block(world, map, aim, targets, pass, {first, last}, block);
    return {.photons = std::move(block.photons),
            .audit = block.audit,
            .emitted = last - first};
}

/// \}

} // namespace ljus
