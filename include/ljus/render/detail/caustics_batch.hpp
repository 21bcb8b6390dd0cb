#pragma once

/// \file ljus/render/detail/caustics_batch.hpp
/// \brief Batched estimates of caustics, for 64 samples at a time.

#include "ljus/path/renderer.hpp"
#include "ljus/photons/density_estimate.hpp"
#include "ljus/render/photon_mapping_settings.hpp"

namespace ljus::detail {

/// The delayed caustics estimates of a batch of samples.
template <std::floating_point T>
struct CausticsBatch {
    std::uint32_t item = 0; ///< Index of the sample that is being traced.
    GrowingArray<EstimatePlaceT<T>> places{}; ///< The queued estimates, in the order of
                                              ///< the samples.
    BallBlocks found{};                       ///< Storage for the search.

    /// Computes the queued estimates.
    /// \param give  Called as give(item, light), with the index of a sample and the
    ///              radiance that is to be added to it.
    template <typename Mapper, typename Give>
    void finish(const Mapper& mapper, Counts& counts, const Give& give) {
        if (places.empty()) return;
        const auto& maps = mapper.maps();
        const DensityEstimateSettings& how = mapper.settings().caustics_estimate;
        const auto add = [&](const PhotonMapT<T>& map,
                             const DensityEstimateSettings& estimate, T sign) {
            counts.map_queries += places.size();
            const auto take = [&](const EstimatePlaceT<T>& place,
                                  const RgbT<T>& light) {
                give(place.item, sign * place.throughput * light);
            };
            estimates_together<T, Kernel>(map, places, estimate, light_kinds,
                                          counts.map_photons, found, take);
        };
        add(maps.caustics, how, T(1));
        if (!maps.lone.empty()) {
            add(maps.lone, lone_estimate(mapper.settings()), T(1));
            add(maps.lone, how, T(-1));
        }
        places.clear();
    }
};

/// Queues the caustics estimate of a vertex, if it can be batched.
/// \return Whether the estimate was queued.
template <typename Batch, std::floating_point T, typename M, typename K>
[[nodiscard]] bool put_off(Batch& batch, const VertexT<T>& vertex, const M& material,
                           const RgbT<T>& throughput, const DensityEstimateOf<K>& how) {
    if constexpr (std::same_as<M, LambertianT<T>> &&
                  std::same_as<Batch, CausticsBatch<T>>)
        if (how.nearest == 0) {
            set_place(batch.places.add(), vertex, material, throughput, batch.item);
            return true;
        }
    return false;
}

} // namespace ljus::detail
