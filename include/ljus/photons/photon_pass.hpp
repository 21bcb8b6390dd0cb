#pragma once

/// \file ljus/photons/photon_pass.hpp
/// \brief What a pass of photons is asked for, what it brings, and when it gives up.

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "ljus/math/require.hpp"
#include "ljus/parallel.hpp"
#include "ljus/photons/photon.hpp"

namespace ljus {

/// \addtogroup tracing
/// \{

/// Which map photons are traced for: how they scatter, and where they are stored.
enum class MapType : std::uint8_t {
    general, ///< Any scattering; stored: L D and L ... D ... D, not L S+ D.
    caustics ///< Mirrors and glass only; stored: L S+ D.
};

/// What the photons of the caustics map are shared out by; see \ref budget.
enum class CausticBudget : std::uint8_t {
    as_seen,   ///< The cones in which lights see the objects; no pilot.
    equal,     ///< Nothing: each object gets as many.
    flux,      ///< Least squared error of the light on surfaces, in (W/m^2)^2.
    area,      ///< Least squared error relative to each caustic's own mean light.
    brightness ///< Least squared error relative to all light: what the eye sees.
};

/// Where the numbers of photons come from.
enum class PhotonSampling : std::uint8_t {
    random, ///< Chance; see \ref random.
    sobol ///< Evenly spread, as long as the dimensions last; see \ref low_discrepancy.
};

/// How photons are made.
struct PhotonPassSettings {
    long long photons = 100000;  ///< How many are emitted; N of the estimate.
    std::uint64_t seed = 1;      ///< Of the random streams.
    std::uint64_t iteration = 0; ///< Which repetition of the pass.
    int max_bounces = 1000; ///< Surfaces a photon may meet; roulette ends it before.
    bool shadow_photons = true;     ///< Whether the general map keeps them.
    PhotonKinds keep = light_kinds; ///< Which others it keeps.
    bool equal_lights = false;      ///< As many from each light, not as its power: for
        ///< what each light hides rather than what it sends.
    PhotonSampling numbers = PhotonSampling::random; ///< Chance, or better than chance.
    /// Of the caustics' photons: an object each, in the order of specular_objects(),
    /// with the sum 1; none: as lights see them. See \ref budget.
    std::vector<double> shares = {};
    double max_memory = 4e9;         ///< Bytes that the photons may take while traced.
    long long give_up = 1LL << 20;   ///< Ends after so many paths if none was stored.
    int threads = 0;                 ///< 0: all that there are.
    Progress progress = no_progress; ///< Called with (done, total); false stops.
};

/// Refuses a pass that cannot be made.
/// \param pass  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const PhotonPassSettings& pass) {
    require_at_least("the number of photons", pass.photons, 0);
    require_at_least("the largest number of bounces", pass.max_bounces, 1);
    require(pass.max_memory > 0, "the memory for photons", pass.max_memory, "above 0");
    require_at_least("the number of paths without a photon", pass.give_up, 1);
}

/// What a photon pass brings.
template <std::floating_point T>
struct TracedPhotonsT {
    std::vector<PhotonT<T>> photons{}; ///< In the order of emission.
    FluxAudit audit{};                 ///< Where the flux has gone.
    long long emitted = 0;             ///< Paths, with the ones that marked nothing.
    bool complete = true; ///< False if the progress callback stopped the pass.
    std::string remark{}; ///< Why it gave up, if it did: one sentence.
};

namespace detail {

/// The photons of some paths, next to each other in the order of emission.
template <std::floating_point T>
struct PhotonBlockT {
    std::vector<PhotonT<T>> photons{}; ///< What they stored.
    FluxAudit audit{};                 ///< Where their flux went.
    long long unsent = 0; ///< Paths that no light could send: targets behind it.
};

/// Paths in a block.
inline constexpr long long photon_block = 512;

/// Paths that are traced before the memory for all of them is foretold.
inline constexpr long long pilot_paths = 4 * photon_block;

/// The memory that a pass will take: twice what it stores, because the blocks are
/// joined when all are there, and the blocks themselves.
/// \param photons  Paths in all.
/// \param mean     Photons stored a path, as seen so far.
/// \return Bytes.
template <std::floating_point T>
[[nodiscard]] double expected_bytes(long long photons, double mean) noexcept {
    const auto blocks = static_cast<double>(block_count(photons, photon_block));
    return 2 * static_cast<double>(photons) * mean * sizeof(PhotonT<T>) +
           blocks * sizeof(PhotonBlockT<T>);
}

/// Refuses a pass that will need more memory than it may take.
/// \param pass  The pass.
/// \param mean  Photons stored a path, as seen so far.
/// \throws std::invalid_argument  with both numbers, in a sentence.
template <std::floating_point T>
void require_memory(const PhotonPassSettings& pass, double mean) {
    const double bytes = expected_bytes<T>(pass.photons, mean);
    if (bytes <= pass.max_memory) return;
    char text[256];
    std::snprintf(text, sizeof text,
                  "The number of photons is %lld, which would take %.3g GB at %.3g "
                  "stored a path; max_memory allows %.3g GB.",
                  pass.photons, bytes * 1e-9, mean, pass.max_memory * 1e-9);
    throw std::invalid_argument(text);
}

/// Says why a pass that has stored nothing gives up.
/// \param pass    The pass.
/// \param map     For which map it was.
/// \param paths   Paths so far.
/// \param unsent  Those of them that no light could send.
/// \param audit   Where their flux went.
/// \return One sentence.
[[nodiscard]] inline std::string why_nothing(const PhotonPassSettings& pass,
                                             MapType map, long long paths,
                                             long long unsent, const FluxAudit& audit) {
    const auto sum = [](const RgbT<double>& flux) { return flux.x + flux.y + flux.z; };
    const double sent = 1 - static_cast<double>(unsent) / static_cast<double>(paths);
    const double all = sum(audit.emitted) > 0 ? sum(audit.emitted) : 1;
    const auto percent = [&](const RgbT<double>& flux) {
        return 100 * sent * sum(flux) / all;
    };
    const bool caustics = map == MapType::caustics;
    char text[400];
    std::snprintf(text, sizeof text,
                  "gave up after %lld of %lld photons, none of which was stored: "
                  "%.0f %% could not be sent (%s), %.0f %% met %s, %.0f %% left the "
                  "scene, %.0f %% was absorbed",
                  paths, pass.photons, 100 * (1 - sent),
                  caustics ? "mirrors and glass lie behind the lights" : "no light",
                  percent(audit.cut),
                  caustics ? "something else before the mirror or glass"
                           : "the limit of bounces",
                  percent(audit.escaped), percent(audit.absorbed + audit.roulette));
    return text;
}

} // namespace detail

/// \}

} // namespace ljus
