#pragma once

/// \file ljus/photons/density_estimate.hpp
/// \brief The radiance estimate from the photons around a point, or around many.

#include <numbers>
#include <span>

#include "ljus/materials/lambertian.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/irradiance_estimate.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

namespace detail {

/// Whether an estimate processes eight photons at a time: on a Lambertian surface,
/// unless the square of the radius leaves the range of float.
template <typename Material, typename K>
[[nodiscard]] constexpr bool in_lanes(const DensityEstimateOf<K>& gather) noexcept {
    return std::same_as<Material, LambertianT<typename Material::Scalar>> &&
           1e-15f < gather.radius && gather.radius < 1e15f;
}

} // namespace detail

/// The plain counterpart of estimate_radiance() with a fixed radius: one photon at a
/// time, for any material.
/// \return Radiance, W/(m^2 sr).
// [plain estimate]
template <std::floating_point T, typename Material, KernelLike<T> K = Kernel>
[[nodiscard]] RgbT<T>
estimate_radiance_plain(const PhotonMapT<T>& map, const VertexT<T>& surface,
                        const Material& material, const Vec3T<T>& wo,
                        const DensityEstimateOf<K>& gather, PhotonKinds kinds,
                        std::uint64_t& gathered) {
    const glm::dvec3 x(surface.point.position), n(surface.point.normal);
    const double r2 = double(gather.radius) * double(gather.radius);
    const double height2 = double(gather.thickness) * double(gather.thickness) * r2;
    RgbT<double> sum{0}; // float would lose the last terms
    const auto add = [&](std::uint32_t i, double distance2) {
        const detail::PhotonRecordT<T> photon = map.records[i];
        const double height = glm::dot(glm::dvec3(map.tree.point(i)) - x, n);
        if (!kinds.has(photon.kind) || height * height > height2 ||
            detail::turned_away(photon.normal, surface.point.normal))
            return;
        const Vec3T<T> wi = to_local(surface.frame, -photon.direction);
        const T weight = kernel_weight(gather.kernel, T(distance2 / r2));
        sum += RgbT<double>(weight * evaluate(material, wo, wi) * photon.flux);
        ++gathered;
    };
    map.tree.visit_within(surface.point.position, T(gather.radius), add);
    return RgbT<T>(sum / (std::numbers::pi * r2));
}
// [plain estimate]

/// The radiance that the photons around a point give towards an observer:
///
/// \f[ L(x, \omega_o) = \frac{1}{\pi r^2} \sum_i w_i\, f(\omega_o, \omega_i)\,
///     \Delta\Phi_i \f]
///
/// The k-th of the k nearest photons only sets the radius; with it in the sum, the
/// estimate would be too bright by k/(k-1). If there are fewer than k within the
/// maximum radius, all of them are summed over its disc, and the mean is still right.
///
/// A photon counts if its normal is within 60 degrees of the surface's and if it lies
/// in a disc of the given thickness. A photon whose `normal` is 0 matches every
/// surface. On a ball of radius r or more, the cap within r of a point has the area
/// \f$ \pi r^2 \f$ of the disc, so the estimate is unbiased. At the edge of a surface
/// half of the disc lies outside, in a corner three quarters, and the estimate is 1/2
/// and 1/4 of the right value.
///
/// Of the vertex only point.position, point.normal and frame are used; `wo` is in that
/// frame. `gathered` counts the summed photons.
/// \return Radiance, W/(m^2 sr); 0 if the k nearest photons all lie within 1e-15 of
///         the radius from x, where the disc has no area.
/// \throws std::invalid_argument  for k = 1 or above max_nearest; a radius that check()
///         refuses is a precondition.
/// \report{Section 3.2.6}
/// \erratum{The report calls R_i a radiance; it is the BRDF times the photon's flux.
///          There is no cosine: the flux that arrives on the surface contains it.}
template <std::floating_point T, typename Material, KernelLike<T> K = Kernel>
[[nodiscard]] RgbT<T> estimate_radiance(const PhotonMapT<T>& map,
                                        const VertexT<T>& surface,
                                        const Material& material, const Vec3T<T>& wo,
                                        const DensityEstimateOf<K>& gather,
                                        PhotonKinds kinds, std::uint64_t& gathered) {
    if (map.empty()) return RgbT<T>{T(0)};
    if (gather.nearest > 0) {
        const auto factor = [&](const detail::PhotonRecordT<T>& photon) {
            const Vec3T<T> from_light = to_local(surface.frame, -photon.direction);
            return evaluate(material, wo, from_light);
        };
        const auto [sum, radius2] =
            detail::sum_of_nearest(map, surface.point, gather, kinds, gathered, factor);
        return detail::per_area<T>(sum, radius2);
    }
    if (!detail::in_lanes<Material>(gather))
        return estimate_radiance_plain(map, surface, material, wo, gather, kinds,
                                       gathered);
    // On a Lambertian surface the radiance is the irradiance times the BRDF.
    const Vec3T<T> side = std::copysign(T(1), wo.z) * surface.frame.normal;
    const auto [flux, radius2] =
        detail::flux_within(map, surface.point, side, gather, kinds, gathered);
    return detail::per_area<T>(RgbT<double>(evaluate(material, wo, wo)) * flux,
                               radius2);
}

namespace detail {

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

} // namespace detail

/// \}

} // namespace ljus
