#pragma once

/// \file ljus/photons/detail/estimates_together.hpp
/// \brief Density estimates at many points, computed together.

#include <span>

#include "ljus/photons/density_estimate.hpp"

namespace ljus::detail {

/// \addtogroup photon_map
/// \{

/// A request for an estimate at a point of a diffuse surface.
template <std::floating_point T>
struct EstimatePlaceT {
    Vec3T<T> center{T(0)}; ///< In scene units.
    Vec3T<T> normal{T(0)}; ///< Normal of the surface; compared with those of photons.
    Vec3T<T> from{T(0)};   ///< As in FluxDiscT: the visible side.
    RgbT<T> brdf{T(0)};    ///< BRDF of the surface, per steradian.
    RgbT<T> throughput{T(0)}; ///< Throughput of the path; a factor of the result.
    std::uint32_t item = 0;   ///< Identifies the request to the caller.
};

/// Sets a request from a vertex, in place, to avoid a store-forwarding stall.
/// \param place       The request; its estimate is that of estimate_radiance() with the
///                    vertex's wo.
/// \param item        Identifies the request to the caller.
template <std::floating_point T>
void set_place(EstimatePlaceT<T>& place, const VertexT<T>& vertex,
               const LambertianT<T>& material, const RgbT<T>& throughput,
               std::uint32_t item) noexcept {
    place.center = vertex.point.position;
    place.normal = vertex.point.normal;
    place.from = std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
    place.brdf = evaluate(material, vertex.wo, vertex.wo);
    place.throughput = throughput;
    place.item = item;
}

/// The estimates of estimate_radiance() at many points, to the last bit. An estimate
/// waits for memory, first of the tree and then of the photons; here the waits overlap.
/// \param gather    Radius, kernel, thickness; in_lanes(), and without `nearest`.
/// \param found     Reusable buffer of the search.
/// \param give      Called as give(place, radiance) in the order of the requests,
///                  except for those without a photon.
template <std::floating_point T, KernelLike<T> K, typename Give>
void estimates_together(const PhotonMapT<T>& map,
                        std::span<const EstimatePlaceT<T>> places,
                        const DensityEstimateOf<K>& gather, PhotonKinds kinds,
                        std::uint64_t& gathered, BallBlocks& found, Give give) {
    const T radius = T(gather.radius);
    const double r2 = double(gather.radius) * double(gather.radius);
    const std::span<const Lanes3T<T>> blocks = map.tree.blocks();
    const std::span<const RecordBlockT<T>> records = map.records.blocks();
    map.tree.find_in_balls(
        places.size(),
        [&](std::size_t i) -> const Vec3T<T>& { return places[i].center; }, radius,
        [&](std::size_t block) {
            prefetch<sizeof(RecordBlockT<T>) / 64>(&records[block]);
        },
        found);
    auto at = found.blocks.begin();
    while (at != found.blocks.end()) {
        const std::uint32_t ball = at->ball;
        const EstimatePlaceT<T>& place = places[ball];
        const FluxDiscT<T, K> disc =
            flux_disc(place.center, place.normal, place.from, gather, kinds);
        DiscFluxT<T, K> flux(records, disc);
        for (; at != found.blocks.end() && at->ball == ball; ++at) {
            const Lanes3T<T>& points = blocks[at->block];
            flux.add({8 * std::size_t{at->block}, at->found, points,
                      distances2(points, place.center)});
        }
        const RgbT<double> sum = RgbT<double>(place.brdf) * flux.sum();
        gathered += flux.gathered();
        give(place, per_area<T>(sum, r2));
    }
}

/// \}

} // namespace ljus::detail
