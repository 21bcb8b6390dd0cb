#pragma once

/// \file ljus/photons/density_estimate.hpp
/// \brief The radiance from the photons around a point, or around many points.

#include <numbers>
#include <span>

#include "ljus/materials/lambertian.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/irradiance_estimate.hpp"
#include "ljus/ref.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

namespace detail {

/// Whether an estimate processes eight photons at a time, as it does on a Lambertian
/// surface.
template <typename Material>
inline constexpr bool in_lanes =
    std::same_as<Material, LambertianT<typename Material::Scalar>>;

} // namespace detail

/// The plain counterpart of estimate_radiance(), with the same arguments and a fixed
/// radius: it adds one photon at a time.
/// \return Radiance, in W/(m^2 sr).
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
/// where r is the radius, w_i the weight of photon i by the kernel, f the BSDF, and
/// \f$ \Delta\Phi_i \f$ the flux of the photon. No cosine appears, because flux that
/// arrives on a surface contains it. With the k nearest photons, the k-th photon sets
/// the radius and is not summed. If there are fewer than k photons within the largest
/// radius, all of them are summed and r is the largest radius.
///
/// A photon counts if its normal is within 60 degrees of the normal of the surface, and
/// if it lies in a disc of the given thickness. A photon whose normal is 0 matches
/// every surface. At an edge, half of the disc lies outside the surface, and the
/// estimate is half the right value; at a corner it is a quarter.
/// \param map       The photons.
/// \param surface   The vertex; point.position, point.normal and frame are used.
/// \param material  The material at the vertex.
/// \param wo        Unit direction to the observer, in the frame of the vertex.
/// \param gather    The settings.
/// \param kinds     The kinds of photons that count.
/// \param gathered  A counter. The number of summed photons is added to it.
/// \return Radiance, in W/(m^2 sr). It is 0 if the k nearest photons lie so close to
///         the point that the disc has no area.
/// \throws std::invalid_argument  if k is 1 or above max_nearest. The other settings
///         must pass check().
/// \report{Section 3.2.6}
/// \erratum{The report calls R_i a radiance; it is the BRDF times the flux of the
/// photon.}
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
    if constexpr (detail::in_lanes<Material>) {
        // On a Lambertian surface the radiance is the irradiance times the BRDF.
        const Vec3T<T> side = std::copysign(T(1), wo.z) * surface.frame.normal;
        const auto [flux, radius2] =
            detail::flux_within(map, surface.point, side, gather, kinds, gathered);
        return detail::per_area<T>(RgbT<double>(evaluate(material, wo, wo)) * flux,
                                   radius2);
    } else {
        return estimate_radiance_plain(map, surface, material, wo, gather, kinds,
                                       gathered);
    }
}

namespace detail {

/// A request for an estimate at a point of a diffuse surface.
template <std::floating_point T>
struct EstimatePlaceT {
    Vec3T<T> center{T(0)}; ///< The point, in scene units.
    /// Geometric normal, to be compared with the normals of photons.
    Vec3T<T> normal{T(0)};
    Vec3T<T> from{T(0)};      ///< Unit normal on the visible side; see FluxDiscT.
    RgbT<T> brdf{T(0)};       ///< BRDF of the surface, per steradian.
    RgbT<T> throughput{T(0)}; ///< Throughput of the path; used by the caller only.
    std::uint32_t item = 0;   ///< Identifies the request to the caller.
};

/// Makes a request for the estimate at a vertex, for the direction vertex.wo. The
/// request is written in place, because copying it is slow.
template <std::floating_point T>
void set_place(EstimatePlaceT<T>& place, const VertexT<T>& vertex,
               const LambertianT<T>& material, const RgbT<T>& throughput,
               std::uint32_t item) noexcept {
    place.center = vertex.point.position;
    place.normal = vertex.point.normal;
    place.from = seen_normal(vertex);
    place.brdf = evaluate(material, vertex.wo, vertex.wo);
    place.throughput = throughput;
    place.item = item;
}

/// Computes estimate_radiance() at many points, with the same results to the last bit.
/// It is faster, because the waits for memory overlap.
/// \param gather    The settings. `nearest` must be 0.
/// \param gathered  A counter. The number of photons in the discs is added to it.
/// \param found     A buffer for the search, which can be used again.
/// \param give      Called as give(place, radiance), in the order of the requests. A
///                  request without photons is left out.
template <std::floating_point T, KernelLike<T> K>
LJUS_CORE_CLONES void estimates_together(
    const PhotonMapT<T>& map, std::span<const EstimatePlaceT<T>> places,
    const DensityEstimateOf<K>& gather, PhotonKinds kinds, std::uint64_t& gathered,
    BallBlocks& found,
    FunctionRef<void(const EstimatePlaceT<T>&, const RgbT<T>&)> give) {
    const T radius = T(gather.radius);
    const double r2 = double(gather.radius) * double(gather.radius);
    const std::span<const Lanes3T<T>> blocks = map.tree.blocks();
    const std::span<const RecordBlockT<T>> records = map.records.blocks();
    find_in_balls(
        map.tree.parts(), places.size(),
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
