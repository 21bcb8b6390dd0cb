#pragma once

/// \file ljus/photons/photon_pass.hpp
/// \brief Settings and results of a photon pass, and its limits.

#include <algorithm>
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

/// The two kinds of maps, which differ in scattering and storage of photons.
enum class MapType : std::uint8_t {
    general, ///< Any scattering; stored: L D and L ... D ... D, not L S+ D.
    caustics ///< Mirrors and glass only; stored: L S+ D.
};

/// Criteria for the distribution of caustic photons; see \ref budget.
enum class CausticBudget : std::uint8_t {
    as_seen,   ///< By the cones in which lights see the objects; no pilot.
    equal,     ///< The same number for each object.
    flux,      ///< Least squared error of the irradiance, in (W/m^2)^2.
    area,      ///< Least squared error relative to each caustic's mean.
    brightness ///< Least squared error relative to all light, as seen by the eye.
};

/// Sources of a photon's random numbers.
enum class PhotonSampling : std::uint8_t {
    random, ///< Pseudo-random; see \ref random.
    sobol   ///< Low-discrepancy, in the first dimensions; see \ref low_discrepancy.
};

/// Settings of a photon pass.
struct PhotonPassSettings {
    long long photons = 100000;  ///< Paths to emit; N of the estimate.
    std::uint64_t seed = 1;      ///< Seed of the random streams.
    std::uint64_t iteration = 0; ///< Index of the repetition.
    int max_bounces = 1000;      ///< Surfaces per photon; roulette ends paths earlier.
    bool shadow_photons = true;  ///< Whether the general map stores them.
    PhotonKinds keep = light_kinds; ///< The other kinds that it stores.
    bool equal_lights = false;      ///< The same number from every light instead of by
        ///< power, for shadow photons.
    PhotonSampling numbers = PhotonSampling::random; ///< Pseudo-random or Sobol.
    /// Whether nearly_specular() objects count as mirrors: light that they send to a
    /// surface with a diffuse lobe belongs to the caustics map. A PhotonMapper sets it.
    bool gloss_as_mirrors = false;
    /// Fractions of the caustic photons, one per object of specular_objects(), with the
    /// sum 1; empty: by the cones that lights see. See \ref budget.
    std::vector<double> shares = {};
    /// Probabilities with which photons choose their lights, one per light, with the
    /// sum 1; empty: by power. See pilot_lights().
    std::vector<double> light_shares = {};
    double max_memory = 4e9;       ///< Bytes for the photons of the pass and their map.
    long long give_up = 1LL << 20; ///< Ends after as many paths if none was stored.
    int threads = 0;               ///< 0: all processors.
    Progress progress = no_progress; ///< Called with (done, total); false stops.
};

/// Refuses invalid settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const PhotonPassSettings& pass) {
    require_at_least("the number of photons", pass.photons, 0);
    require_at_least("the largest number of bounces", pass.max_bounces, 1);
    require(pass.max_memory > 0, "the memory for photons", pass.max_memory, "above 0");
    require_at_least("the number of paths without a photon", pass.give_up, 1);
}

/// The result of a photon pass.
template <std::floating_point T>
struct TracedPhotonsT {
    std::vector<PhotonT<T>> photons{}; ///< In the order of emission.
    FluxAudit audit{};                 ///< Where the flux went.
    long long emitted = 0; ///< Paths emitted, including those that stored nothing.
    bool complete = true;  ///< False if the progress callback stopped the pass.
    std::string remark{};  ///< If the pass gave up, one sentence why.
};

namespace detail {

/// The photons of a block of paths, in the order of emission.
template <std::floating_point T>
struct PhotonBlockT {
    std::vector<PhotonT<T>> photons{}; ///< Stored photons.
    FluxAudit audit{};                 ///< Where their flux went.
    long long unsent = 0; ///< Paths not emitted: no target before the light.
};

/// Number of paths per block.
inline constexpr long long photon_block = 512;

/// Number of paths before the memory of the whole pass is predicted.
inline constexpr long long pilot_paths = 4 * photon_block;

/// Predicts the memory of a pass in bytes, and of the map that is made of its parts:
/// its photons with four numbers each for the tree, and the blocks of a round.
/// \param mean     Stored photons per path so far.
template <std::floating_point T>
[[nodiscard]] double expected_bytes(long long photons, double mean) noexcept {
    const auto blocks = static_cast<double>(block_count(photons, photon_block));
    return static_cast<double>(photons) * mean * (sizeof(PhotonT<T>) + 4 * sizeof(T)) +
           blocks / 16 * sizeof(PhotonBlockT<T>);
}

/// Refuses a pass that would exceed its memory.
/// \param mean  Stored photons per path so far.
/// \throws std::invalid_argument  with both numbers, and how many photons would fit.
template <std::floating_point T>
[[gnu::cold]] void require_memory(MapType map, const PhotonPassSettings& pass,
                                  double mean) {
    const double bytes = expected_bytes<T>(pass.photons, mean);
    if (bytes <= pass.max_memory) return;
    const double each_block = expected_bytes<T>(photon_block, mean);
    const double fit = std::floor(pass.max_memory / each_block) * photon_block;
    char text[256];
    std::snprintf(text, sizeof text,
                  "The %lld photons for the %s map would take %.3g GB, and max_memory "
                  "is %.3g GB: %s%.0f photons would fit.",
                  pass.photons, map == MapType::caustics ? "caustics" : "general",
                  bytes * 1e-9, pass.max_memory * 1e-9, mean > 0 ? "" : "at most ",
                  fit);
    throw std::invalid_argument(text);
}

/// Explains in one sentence why a pass that has stored nothing gives up.
/// \param unsent  Paths that no light could emit.
[[nodiscard, gnu::cold]] inline std::string why_nothing(const PhotonPassSettings& pass,
                                                        MapType map, long long paths,
                                                        long long unsent,
                                                        const FluxAudit& audit) {
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

/// A sentence about a caustics pass with several lights most of whose photons are lost.
/// \return Empty if at least a tenth was stored.
[[nodiscard, gnu::cold]] inline std::string few_stored(std::size_t stored,
                                                       long long emitted) {
    const double share = double(stored) / double(std::max(emitted, 1LL));
    if (share >= 0.1) return {};
    char text[200];
    std::snprintf(text, sizeof text,
                  "%.3g %% of the photons sent to mirrors and glass are stored: a "
                  "caustic budget by flux sends more of them from those lights that "
                  "reach mirrors and glass",
                  100 * share);
    return text;
}

} // namespace detail

/// \}

} // namespace ljus
