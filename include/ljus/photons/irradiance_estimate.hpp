#pragma once

/// \file ljus/photons/irradiance_estimate.hpp
/// \brief How photons are gathered, and the irradiance that those around a point stand
/// for.

#include <array>
#include <cmath>
#include <concepts>
#include <numbers>
#include <span>

#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/require.hpp"
#include "ljus/photons/detail/flux_in_disc.hpp"
#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

/// The most photons that an estimate with the k nearest takes.
inline constexpr std::size_t max_nearest = 512;

namespace detail {

/// The kernel of settings that name none.
template <typename K>
inline constexpr K default_kernel{};
/// Of the kernels of the library, that of the least variance.
template <>
inline constexpr Kernel default_kernel<Kernel> = Kernel::epanechnikov;

} // namespace detail

/// How photons are gathered.
/// \tparam K  Kernel, for one of the library's, chosen when the program runs; or a type
///            that is a kernel: see KernelLike.
template <KernelLike K>
struct DensityEstimateOf {
    float radius = 0.1f;                  ///< In scene units, from 1e-15 to 1e15.
    std::size_t nearest = 0;              ///< k within the radius; 0: all within it.
    K kernel = detail::default_kernel<K>; ///< The weight by distance.
    float thickness = 0.5f; ///< Half the height of the disc over its radius: photons of
                            ///< a parallel wall lie outside. With 0.5 the disc holds
                            ///< all that a ball no smaller than it has within it.
};
using DensityEstimateSettings = DensityEstimateOf<Kernel>; ///< With a listed kernel.

/// Refuses a way to gather that gives no estimate.
/// \param gather  The settings.
/// \throws std::invalid_argument  with name and value; also for a kernel of the user's
///         own that makes or loses light.
template <typename K>
void check(const DensityEstimateOf<K>& gather) {
    require(gather.radius >= 1e-15f && gather.radius <= 1e15f, "gather.radius",
            gather.radius, "within [1e-15, 1e15], or no float holds the radiance");
    require_positive("gather.thickness", gather.thickness);
    require(gather.nearest != 1 && gather.nearest <= max_nearest, "gather.nearest",
            static_cast<long long>(gather.nearest),
            "0 for all within the radius, or 2 to 512 (one photon sets the radius)");
    if constexpr (!std::same_as<K, Kernel>) {
        double mean = 0; // by the middles of a thousand rings of the same area
        for (int i = 0; i < 1000; ++i)
            mean +=
                double(kernel_weight(gather.kernel, (float(i) + 0.5f) / 1000)) / 1000;
        require(std::abs(mean - 1) < 0.01, "the mean of gather.kernel over the disc",
                mean, "1, or light is made or lost");
    }
}

namespace detail {

/// What is summed over the photons of a disc.
struct DiscSum {
    RgbT<double> sum{0}; ///< Many small terms: a float would lose the last of them.
    double radius2 = 1;  ///< Of the disc, squared.
};

/// A sum over a disc, as a density: over the disc's area.
/// \param sum      Of weight times flux, W; or of that times a BRDF.
/// \param radius2  Of the disc, squared.
/// \return W/m^2; or W/(m^2 sr).
template <std::floating_point T>
[[nodiscard]] RgbT<T> per_area(const RgbT<double>& sum, double radius2) noexcept {
    return RgbT<T>(sum / (std::numbers::pi * radius2));
}

/// Wants the photons of some kinds: see nearest_photons().
struct OfKinds {
    PhotonKinds kinds; ///< Which kinds count.
    /// Whether a photon counts.
    template <std::floating_point T>
    [[nodiscard]] bool operator()(std::uint32_t /*index*/,
                                  const PhotonRecordT<T>& photon) const noexcept {
        return kinds.has(photon.kind);
    }
};

/// The photons that an estimate with the k nearest sums.
struct NearestPhotons {
    std::span<const Neighbor> photons{}; ///< They, in any order.
    double radius2 = 0;                  ///< Of the disc that they lie in, squared.
};

/// The k nearest photons at a point: the one search of all estimates with them. The
/// k-th sets the radius and is left out of the sum. Fewer than k are all that there are
/// in the whole disc, and none of them is left out.
/// \param map     The photons.
/// \param point   Of a surface: position and normal are read.
/// \param radius  They lie within it.
/// \param room    Room for k, at most max_nearest.
/// \param wanted  Called as wanted(index, record): whether that photon counts. Those
///                that are turned_away() do not.
template <std::floating_point T, typename Wanted>
[[nodiscard]] NearestPhotons
nearest_photons(const PhotonMapT<T>& map, const SurfacePointT<T>& point, T radius,
                std::span<Neighbor> room, const Wanted& wanted) {
    const auto counts = [&](std::uint32_t i) {
        const PhotonRecordT<T> photon = map.records[i];
        return wanted(i, photon) && !turned_away(photon.normal, point.normal);
    };
    const std::size_t count =
        map.tree.template nearest<max_nearest>(point.position, radius, room, counts);
    const bool full = count == room.size();
    const std::size_t skip = full ? 1 : 0;
    return {room.subspan(skip, count - skip),
            full ? room[0].distance2 : double(radius) * double(radius)};
}

/// Sums over the k nearest photons in their disc, one by one.
/// \param map       The photons.
/// \param point     Where: position and normal are read.
/// \param gather    Radius, k, kernel, thickness.
/// \param kinds     Which kinds count.
/// \param gathered  Counts the photons that were summed.
/// \param factor    Called with a PhotonRecordT; returns what the flux is multiplied by
///                  besides its weight.
/// \return A sum of 0 if the k photons all lie in one point: they have no area, and
///         there is no estimate.
template <std::floating_point T, KernelLike<T> K, typename Factor>
[[nodiscard]] DiscSum
sum_of_nearest(const PhotonMapT<T>& map, const SurfacePointT<T>& point,
               const DensityEstimateOf<K>& gather, PhotonKinds kinds,
               std::uint64_t& gathered, const Factor& factor) {
    const double widest2 = double(gather.radius) * double(gather.radius);
    std::array<Neighbor, max_nearest> room;
    const auto [photons, radius2] =
        nearest_photons(map, point, T(gather.radius),
                        std::span(room.data(), gather.nearest), OfKinds{kinds});
    if (!(radius2 > 1e-30 * widest2)) return {};
    DiscSum disc{.radius2 = radius2};
    for (const Neighbor& near : photons) {
        const PhotonRecordT<T> photon = map.records[near.index];
        const double height = glm::dot(glm::dvec3(map.tree.point(near.index)) -
                                           glm::dvec3(point.position),
                                       glm::dvec3(point.normal));
        const double limit = double(gather.thickness);
        if (height * height > limit * limit * radius2) continue;
        const T weight = kernel_weight(gather.kernel, T(near.distance2 / radius2));
        disc.sum += RgbT<double>(weight * factor(photon) * photon.flux);
        ++gathered;
    }
    return disc;
}

/// The disc of an estimate with all photons within the radius.
/// \param point   Where: position and normal are read.
/// \param side    Unit: photons that travel against it count.
/// \param gather  Radius, kernel, thickness.
/// \param kinds   Which kinds count.
template <std::floating_point T, KernelLike<T> K>
[[nodiscard]] FluxDiscT<T, K>
flux_disc(const Vec3T<T>& position, const Vec3T<T>& normal, const Vec3T<T>& side,
          const DensityEstimateOf<K>& gather, PhotonKinds kinds) noexcept {
    return {.center = position,
            .normal = normal,
            .from = side,
            .radius = T(gather.radius),
            .thickness = T(gather.thickness),
            .kernel = gather.kernel,
            .kinds = kinds};
}

/// The flux within the radius that arrives on one side of a surface, eight photons at a
/// time.
/// \param map       The photons.
/// \param point     Where: position and normal are read.
/// \param side      Unit: photons that travel against it count.
/// \param gather    Radius, kernel, thickness.
/// \param kinds     Which kinds count.
/// \param gathered  Counts the photons in the disc, of either side.
template <std::floating_point T, KernelLike<T> K>
[[nodiscard]] DiscSum flux_within(const PhotonMapT<T>& map,
                                  const SurfacePointT<T>& point, const Vec3T<T>& side,
                                  const DensityEstimateOf<K>& gather, PhotonKinds kinds,
                                  std::uint64_t& gathered) {
    return {flux_in_disc(map.tree, map.records,
                         flux_disc(point.position, point.normal, side, gather, kinds),
                         gathered),
            double(gather.radius) * double(gather.radius)};
}

} // namespace detail

/// The irradiance that the photons around a point bring to one side of its surface:
///
/// \f[ E(x) = \frac{1}{\pi r^2} \sum_i w_i\, \Delta\Phi_i \f]
///
/// estimate_radiance() of a matt surface is this times its BRDF, and says which photons
/// count. No scene, no material and no vertex are asked for, so that photons of your
/// own will do: position, direction, flux and kind, and nothing else. One whose
/// `normal` is left 0 matches every surface.
///
///     const PhotonMap map = make_photon_map(photons);
///     const Rgb E = estimate_irradiance(map, {.position = x, .normal = n}, n,
///                                       DensityEstimateSettings{.radius = 0.1f});
///     const Rgb L = albedo / pi * E; // what a matt surface sends back
///
/// \param map     The photons.
/// \param point   Where: its position and its normal are read, which is compared with
///                the normals of photons.
/// \param side    Unit, on the side that is asked about: the point's normal, or its
///                opposite. Photons that travel against it count.
/// \param gather  Radius, k, kernel, thickness.
/// \param kinds   Which kinds count.
/// \return W/m^2; 0 without photons.
/// \report{Section 3.2.6}
template <std::floating_point T, KernelLike<T> K = Kernel>
[[nodiscard]] RgbT<T>
estimate_irradiance(const PhotonMapT<T>& map, const SurfacePointT<T>& point,
                    const Vec3T<T>& side, const DensityEstimateOf<K>& gather,
                    PhotonKinds kinds = light_kinds) {
    if (map.empty()) return RgbT<T>{T(0)};
    std::uint64_t gathered = 0;
    const auto lit = [&](const detail::PhotonRecordT<T>& photon) {
        return glm::dot(photon.direction, side) < T(0) ? T(1) : T(0);
    };
    const detail::DiscSum disc =
        gather.nearest == 0
            ? detail::flux_within(map, point, side, gather, kinds, gathered)
            : detail::sum_of_nearest(map, point, gather, kinds, gathered, lit);
    return detail::per_area<T>(disc.sum, disc.radius2);
}

/// \}

} // namespace ljus
