#pragma once

/// \file ljus/photons/photon_pass.hpp
/// \brief The settings, the results and the limits of a photon pass.

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

/// The kind of a photon map. It determines which photons are scattered and stored.
enum class MapType : std::uint8_t {
    /// All surfaces scatter. The map stores L D and L ... D ... D, not L S+ D.
    general,
    caustics ///< Only mirrors and glass scatter. The map stores L S+ D.
};

/// A criterion for the distribution of caustic photons among objects; see \ref budget.
enum class CausticBudget : std::uint8_t {
    /// Photons in proportion to the solid angle of the object as seen from a light.
    as_seen,
    equal, ///< The same number of photons for each object.
    flux,  ///< Minimises the squared error of the irradiance.
    /// Minimises the squared error relative to the mean irradiance of each caustic.
    area,
    brightness ///< Minimises the squared error relative to the irradiance of all light.
};

/// The kinds of random numbers that photons can use.
enum class PhotonSampling : std::uint8_t {
    random, ///< Pseudo-random numbers; see \ref random.
    sobol   ///< Sobol points in the first dimensions; see \ref low_discrepancy.
};

/// Settings of a photon pass.
struct PhotonPassSettings {
    long long photons = 100000;  ///< Number of paths to emit.
    std::uint64_t seed = 1;      ///< Seed of the random streams.
    std::uint64_t iteration = 0; ///< Each value gives other random numbers.
    int max_bounces = 1000;      ///< Largest number of surfaces on the path of a
                                 ///< photon; a scattering in fog counts as one.
    bool shadow_photons = true;  ///< Whether the general map stores shadow photons.
    /// The kinds of photons to store besides shadow photons.
    PhotonKinds keep = light_kinds;
    /// Whether every light emits the same number of photons, instead of a number in
    /// proportion to its power. This is useful for shadow photons.
    bool equal_lights = false;
    PhotonSampling numbers = PhotonSampling::random; ///< Kind of random numbers.
    /// Whether objects with a nearly_specular() material count as mirrors. The light
    /// that they send to a surface with a diffuse lobe then belongs to the caustics
    /// map. A PhotonMapper sets this member.
    bool gloss_as_mirrors = false;
    /// The fraction of the caustic photons for each object of specular_objects(); the
    /// sum is 1. If empty, the fractions are those of CausticBudget::as_seen.
    std::vector<double> shares = {};
    /// The probability with which a photon chooses each light; the sum is 1. If empty,
    /// the probabilities are in proportion to power. See pilot_lights().
    std::vector<double> light_shares = {};
    double max_memory = 4e9; ///< Limit in bytes for the photons and their map.
    /// The pass ends if it has stored no photon after this number of paths.
    long long give_up = 1LL << 20;
    int threads = 0; ///< Number of threads, as in ParallelSettings.
    /// Called with (done, total); returns false to stop.
    Progress progress = no_progress;
};

/// Checks the settings of a photon pass.
/// \throws std::invalid_argument  if a number is out of range.
inline void check(const PhotonPassSettings& pass) {
    require_at_least("the number of photons", pass.photons, 0);
    require_at_least("the largest number of bounces", pass.max_bounces, 1);
    require(pass.max_memory > 0, "the memory for photons", pass.max_memory, "above 0");
    require_at_least("the number of paths without a photon", pass.give_up, 1);
}

/// The result of a photon pass.
template <std::floating_point T>
struct TracedPhotonsT {
    std::vector<PhotonT<T>> photons{}; ///< The photons in the order of emission.
    FluxAudit audit{};                 ///< What became of the emitted flux.
    long long emitted = 0; ///< Number of paths, including those that stored nothing.
    bool complete = true;  ///< False if the progress callback stopped the pass.
    std::string remark{};  ///< The reason in one sentence if the pass gave up.
};

namespace detail {

/// The photons of a block of paths, in the order of emission.
template <std::floating_point T>
struct PhotonBlockT {
    std::vector<PhotonT<T>> photons{}; ///< The stored photons.
    FluxAudit audit{};                 ///< What became of the emitted flux.
    long long unsent = 0;              ///< Number of paths that no light could emit.
};

inline constexpr long long photon_block = 512;

/// The number of paths after which the memory of the whole pass is predicted.
inline constexpr long long pilot_paths = 4 * photon_block;

/// Predicts the memory of a pass and its map, in bytes: the photons, four numbers per
/// photon for the tree, and the blocks that are traced at the same time.
/// \param photons  The number of paths.
/// \param mean     The number of stored photons per path so far.
template <std::floating_point T>
[[nodiscard]] double expected_bytes(long long photons, double mean) noexcept {
    const auto blocks = static_cast<double>(block_count(photons, photon_block));
    return static_cast<double>(photons) * mean * (sizeof(PhotonT<T>) + 4 * sizeof(T)) +
           blocks / 16 * sizeof(PhotonBlockT<T>);
}

/// Refuses a pass that would exceed its limit of memory.
/// \param mean  The number of stored photons per path so far.
/// \throws std::invalid_argument  with the predicted memory, the limit, and the number
///         of photons that would fit.
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

/// A remark about a caustics pass with several lights that has stored only a few
/// photons.
/// \return One sentence; empty if at least a tenth of the photons is stored.
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
