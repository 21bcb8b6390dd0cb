#pragma once

/// \file ljus/render/detail/caustics_batch.hpp
/// \brief Caustics that are asked for together: of 64 samples at a time.

#include "ljus/path/renderer.hpp"
#include "ljus/photons/detail/estimates_together.hpp"

namespace ljus::detail {

/// \addtogroup photon_mapping
/// \{

/// The caustics estimates that were put off, of samples that are finished together.
template <std::floating_point T>
struct CausticsBatch {
    std::uint32_t item = 0;                  ///< Which of the samples is being traced.
    std::vector<EstimatePlaceT<T>> places{}; ///< In the order of the samples.
    BallBlocks found{};                      ///< Room for the search.

    /// Asks, and adds what comes to the samples.
    /// \param mapper   The maps, and how to ask.
    /// \param counts   Counts queries and photons.
    /// \param samples  By their items.
    template <typename Mapper>
    void finish(const Mapper& mapper, Counts& counts, std::span<RgbT<T>> samples) {
        if (places.empty()) return;
        counts.map_queries += places.size();
        estimates_together<T>(
            mapper.maps().caustics, places, mapper.settings().caustics_estimate,
            light_kinds, counts.map_photons, found,
            [&](const EstimatePlaceT<T>& place, const RgbT<T>& light) {
                samples[place.item] += place.throughput * light;
            });
        places.clear();
    }
};

/// Queues the caustics estimate of a vertex, if it can be batched.
/// \param batch       Of the context; a NoBatch puts nothing off.
/// \param vertex      The surface.
/// \param material    What it is made of.
/// \param throughput  Of the path.
/// \param how         The estimate.
/// \return Whether it comes later.
template <typename Batch, std::floating_point T, typename M, typename K>
[[nodiscard]] bool put_off(Batch& batch, const VertexT<T>& vertex, const M& material,
                           const RgbT<T>& throughput, const DensityEstimateOf<K>& how) {
    if constexpr (std::same_as<M, LambertianT<T>> &&
                  std::same_as<Batch, CausticsBatch<T>>)
        if (how.nearest == 0 && in_lanes<M>(how)) {
            set_place(batch.places.emplace_back(), vertex, material, throughput,
                      batch.item);
            return true;
        }
    return false;
}

/// \}

} // namespace ljus::detail
