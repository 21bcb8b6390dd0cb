#pragma once

/// \file ljus/photons/tracing.hpp
/// \brief A pass of photons: sent by the lights, traced, kept in order.

#include <algorithm>
#include <initializer_list>
#include <utility>
#include <vector>

#include "ljus/parallel.hpp"
#include "ljus/photons/aiming.hpp"
#include "ljus/photons/photon_path.hpp"
#include "ljus/scene/index.hpp"

namespace ljus {

/// \defgroup tracing Photon tracing
/// \brief Section 3.2.2: photons bounce "until Russian roulette decides otherwise".
/// \{

namespace detail {

/// Sends and traces the paths of one block.
/// \param scene    The scene.
/// \param map      For which map.
/// \param choice   Of the scene's lights.
/// \param targets  What caustics photons are aimed at.
/// \param pass     How many in all, and with which seed.
/// \param paths    Which of them.
/// \param block    Takes the photons and the account.
template <SceneLike S, std::floating_point T>
void trace_block(const S& scene, MapType map, const LightChoice& choice,
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
        EmittedPhotonT<T> photon;
        std::optional<ObjectId> target;
        if (map == MapType::caustics) {
            const auto aimed = aim(scene, choice, targets, stream);
            if (!aimed) {
                ++block.unsent;
                continue;
            }
            photon = aimed->photon;
            target = aimed->target;
        } else {
            photon = emit(scene, choice, stream);
        }
        photon.flux /= static_cast<T>(pass.photons);
        trace_photon(scene, map, photon, target, pass, stream, block.photons,
                     block.audit);
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

} // namespace detail

/// Emits and traces the photons of one map, by several threads.
///
/// Some 2000 paths tell how many photons are stored in the mean; a pass that would need
/// more than PhotonPassSettings::max_memory is refused before it takes it. A pass of
/// which nothing was stored in PhotonPassSettings::give_up paths ends there, and says
/// why.
/// \param scene  The scene; with at least one light.
/// \param map    For which map.
/// \param pass   How many, and with which seed.
/// \return The photons in the order of emission, the same for any number of threads.
/// \throws std::invalid_argument  if the scene has no light or more than 65536, a
///         number of the pass is out of range, or the memory would not do.
template <SceneLike S>
[[nodiscard]] TracedPhotonsT<typename S::Scalar>
trace_photons(const S& scene, MapType map, const PhotonPassSettings& pass) {
    using T = typename S::Scalar;
    check(pass);
    require(!scene.lights.empty(), "the number of lights", 0LL,
            "at least 1, because photons start at lights");
    require(scene.lights.size() <= 65536, "the number of lights",
            static_cast<long long>(scene.lights.size()),
            "at most 65536, because a photon has 16 bits for its light's number");
    const LightChoice choice = light_choice(scene.lights);
    require(choice.cumulative.back() > 0, "the power of all lights",
            choice.cumulative.back(), "above 0: a sun needs objects to shine on");
    detail::require_memory<T>(pass, 0);

    const detail::IndexedT<S> indexed(scene);
    TracedPhotonsT<T> result{.emitted = pass.photons};
    const bool caustics = map == MapType::caustics;
    const auto targets = caustics ? specular_objects(scene) : std::vector<ObjectId>{};
    if (caustics && targets.empty()) return result;

    std::vector<detail::PhotonBlockT<T>> blocks;
    const long long count = detail::block_count(pass.photons, detail::photon_block);
    long long done = 0;  // blocks
    bool nothing = true; // has been stored so far
    for (const long long paths : {detail::pilot_paths, pass.give_up, pass.photons}) {
        const long long last =
            std::min(detail::block_count(paths, detail::photon_block), count);
        if (last <= done) continue;
        blocks.resize(static_cast<std::size_t>(last));
        const auto body = [&](long long i) {
            const detail::BlockRange range =
                detail::block_range(done + i, detail::photon_block, pass.photons);
            detail::trace_block(indexed, map, choice, targets, pass, range,
                                blocks[static_cast<std::size_t>(done + i)]);
        };
        const auto progress = [&](long long now, long long) {
            return pass.progress(done + now, count);
        };
        result.complete = parallel_blocks(
            last - done, body, {.threads = pass.threads, .progress = progress});
        done = last;
        result.emitted = std::min(last * detail::photon_block, pass.photons);
        std::size_t stored = 0;
        for (const auto& block : blocks) stored += block.photons.size();
        nothing = stored == 0;
        if (!result.complete) break;
        detail::require_memory<T>(pass, double(stored) /
                                            double(std::max(result.emitted, 1LL)));
        if (nothing && result.emitted >= pass.give_up) break;
    }
    const long long unsent = detail::join_blocks(blocks, result);
    if (nothing && result.complete && result.emitted < pass.photons) {
        result.audit *= double(pass.photons) / double(result.emitted);
        result.remark =
            detail::why_nothing(pass, map, result.emitted, unsent, result.audit);
    }
    return result;
}

/// \}

} // namespace ljus
