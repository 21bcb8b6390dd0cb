#pragma once

/// \file ljus/photons/tracing.hpp
/// \brief A photon pass: emission and tracing by several threads, in a fixed order.

#include <algorithm>
#include <numeric>
#include <span>
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
            auto aimed = aim_by_share(world, aim.choice, targets, pass.shares, stream);
            if (!aimed) {
                ++block.unsent;
                continue;
            }
            sent = {aimed->photon, aimed->target, std::move(aimed->others)};
        } else {
            sent.photon = emit(world, aim.choice, stream, aim);
            if (is_black(sent.photon.flux)) { // the light does not emit there
                ++block.unsent;
                continue;
            }
        }
        sent.photon.flux /= static_cast<T>(pass.photons);
        trace_photon(world, map, sent, pass, stream, block);
    }
}

/// The photons of a pass in parts, which can be freed one by one.
template <std::floating_point T>
struct TracedPartsT {
    /// The photons, in the order of emission.
    std::vector<std::vector<PhotonT<T>>> parts{};
    std::size_t stored = 0;   ///< The number of all photons.
    TracedPhotonsT<T> pass{}; ///< The other results; its own list of photons is empty.
};

/// Adds the photons of blocks, in their order, to those of a pass, and empties the
/// blocks. The memory of the blocks is not freed.
/// \return The number of paths that no light could emit.
template <std::floating_point T>
long long take_photons(std::span<PhotonBlockT<T>> blocks, TracedPartsT<T>& result) {
    constexpr std::size_t part = 1 << 13; // photons
    long long unsent = 0;
    for (PhotonBlockT<T>& block : blocks) {
        for (const PhotonT<T>& photon : block.photons) {
            if (result.stored++ % part == 0) {
                result.parts.emplace_back();
                result.parts.back().reserve(part);
            }
            result.parts.back().push_back(photon);
        }
        result.pass.audit += block.audit;
        unsent += block.unsent;
        block.photons.clear();
        block.audit = {};
        block.unsent = 0;
    }
    return unsent;
}

/// Joins the photons of a pass in one list, and frees the parts.
template <std::floating_point T>
[[nodiscard]] TracedPhotonsT<T> join_parts(TracedPartsT<T> traced) {
    TracedPhotonsT<T> result = std::move(traced.pass);
    result.photons.reserve(traced.stored);
    for (auto& part : traced.parts) {
        result.photons.insert(result.photons.end(), part.begin(), part.end());
        std::vector<PhotonT<T>>().swap(part);
    }
    return result;
}

/// Checks the settings and the lights of a pass. `choice` is the distribution of the
/// lights by power; the result is the distribution for the pass.
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

/// Checks a pass, and determines how its photons leave their lights. For the caustics
/// map only `choice` is set, because its photons are aimed at single objects.
template <AnyWorld W, std::floating_point T = typename W::Scalar>
[[nodiscard]] SceneAimT<T> scene_aim_of(const W& world, MapType map,
                                        const PhotonPassSettings& pass) {
    LightChoice choice = start_pass<T>(map, pass, world.light_choice());
    require_no_film_in_fog(world);
    if (map == MapType::caustics) return {.choice = std::move(choice)};
    return aim_at_scene(world, choice, pass.light_shares.empty() && !pass.equal_lights);
}

/// The objects at which the photons of a caustics map are aimed; none for a general
/// map.
template <AnyWorld W>
[[nodiscard]] std::vector<ObjectId> targets_of(const W& world, MapType map,
                                               const PhotonPassSettings& pass) {
    if (map == MapType::general) return {};
    auto targets = specular_objects(world, pass.gloss_as_mirrors);
    check_shares(pass.shares, targets.size());
    return targets;
}

/// Traces the blocks of a pass by several threads. This function is compiled once for
/// all types of scenes.
/// \param trace  Traces one block of paths, by trace_block().
template <std::floating_point T>
[[nodiscard, gnu::cold]] TracedPartsT<T>
run_pass(MapType map, const PhotonPassSettings& pass,
         FunctionRef<void(const BlockRange&, PhotonBlockT<T>&)> trace) {
    TracedPartsT<T> traced;
    TracedPhotonsT<T>& result = traced.pass;
    result.emitted = pass.photons;
    std::vector<PhotonBlockT<T>> blocks; // of one round; the next round reuses them
    const long long count = block_count(pass.photons, photon_block);
    const long long threads = pass.threads == 0 ? max_threads() : pass.threads;
    long long done = 0, unsent = 0; // finished blocks; paths that were not emitted
    for (const long long paths : {pilot_paths, pass.give_up, pass.photons}) {
        const long long stop = std::min(block_count(paths, photon_block), count);
        if (stop <= done) continue;
        while (done < stop && result.complete) {
            // With few rounds, threads rarely wait for each other. With small rounds,
            // few photons are in memory twice while they are copied.
            const long long last =
                std::min(done + std::max(16 * threads, done / 16), stop);
            blocks.resize(static_cast<std::size_t>(last - done));
            const auto body = [&](long long i) {
                trace(block_range(done + i, photon_block, pass.photons),
                      blocks[static_cast<std::size_t>(i)]);
            };
            const auto progress = [&](long long now, long long) {
                return pass.progress(done + now, count);
            };
            result.complete = parallel_blocks(
                last - done, body, {.threads = pass.threads, .progress = progress});
            unsent += take_photons<T>(blocks, traced);
            done = last;
        }
        result.emitted = std::min(done * photon_block, pass.photons);
        if (!result.complete) break;
        require_memory<T>(
            map, pass, double(traced.stored) / double(std::max(result.emitted, 1LL)));
        if (traced.stored == 0 && result.emitted >= pass.give_up) break;
    }
    if (traced.stored == 0 && result.complete && result.emitted < pass.photons) {
        result.audit *= double(pass.photons) / double(result.emitted);
        result.remark = why_nothing(pass, map, result.emitted, unsent, result.audit);
    }
    return traced;
}

/// Emits and traces the photons of one map, and returns them in parts.
template <AnyWorld W>
[[nodiscard, gnu::cold]] TracedPartsT<typename W::Scalar>
trace_parts(const W& world, MapType map, const PhotonPassSettings& pass) {
    using T = typename W::Scalar;
    const auto aim = scene_aim_of(world, map, pass);
    const auto targets = targets_of(world, map, pass);
    if (map == MapType::caustics && targets.empty())
        return {.pass = {.emitted = pass.photons}};

    const auto trace = [&](const BlockRange& paths, PhotonBlockT<T>& block) {
        trace_block(world, map, aim, targets, pass, paths, block);
    };
    return run_pass<T>(map, pass, trace);
}

} // namespace detail

/// Emits and traces the photons of one map, by several threads.
///
/// After about 2000 paths the memory of the pass is predicted. A pass that would need
/// more than PhotonPassSettings::max_memory is refused then. A pass that has stored
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
    return detail::join_parts(detail::trace_parts(world, map, pass));
}

/// Emits and traces some of the paths of a pass, by one thread. Several processes can
/// thus share a pass. Their photons, joined in order, are the photons of the whole
/// pass.
/// \param world  The closed scene, with at least one light.
/// \param map    The kind of map.
/// \param pass   The settings of the whole pass, without `threads`, `progress` and
///               `give_up`.
/// \param first  The first path, 0 or more.
/// \param last   One past the last path, at most `pass.photons`.
/// \return The photons in the order of emission, and what became of the flux.
/// \throws std::invalid_argument  as the other trace_photons(), or if the pass has no
///         such paths.
template <AnyWorld W>
[[nodiscard, gnu::cold]] TracedPhotonsT<typename W::Scalar>
trace_photons(const W& world, MapType map, const PhotonPassSettings& pass,
              long long first, long long last) {
    using T = typename W::Scalar;
    require_at_least("the first path", first, 0);
    require_at_least("the last path", last, first);
    if (last > pass.photons)
        detail::refuse("the last path", last,
                       "at most the number of photons, " + to_text(pass.photons));
    const auto aim = detail::scene_aim_of(world, map, pass);
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
