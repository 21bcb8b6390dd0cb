#pragma once

/// \file ljus/photons/irradiance_estimate.hpp
/// \brief Settings of density estimates, and the irradiance from photons at a point.

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <numbers>
#include <span>
#include <string_view>

#include "ljus/geometry/surface_point.hpp"
#include "ljus/math/require.hpp"
#include "ljus/photons/detail/flux_in_disc.hpp"
#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

/// The largest number k of an estimate with the k nearest photons.
inline constexpr std::size_t max_nearest = 512;

namespace detail {

template <typename K>
inline constexpr K default_kernel{};
/// The kernel with the least variance at equal bias.
template <>
inline constexpr Kernel default_kernel<Kernel> = Kernel::epanechnikov;

} // namespace detail

/// Settings of a density estimate.
/// \tparam K  Kernel, whose value is chosen at run time, or your own KernelLike type.
template <KernelLike K>
struct DensityEstimateOf {
    float radius = 0.1f; ///< Search radius in scene units, from 1e-15 to 1e15.
    /// Number of nearest photons that count, 2 to 512; 0 for all within the radius.
    std::size_t nearest = 0;
    K kernel = detail::default_kernel<K>; ///< Weight of a photon by its distance.
    /// Half the height of the disc, divided by its radius. A small value excludes
    /// photons of parallel walls, but also of curved surfaces. With 0.5 the disc
    /// contains the surface of a ball, unless the ball is smaller than the disc.
    float thickness = 0.5f;
};
/// DensityEstimateOf with a kernel of the library.
using DensityEstimateSettings = DensityEstimateOf<Kernel>;

namespace detail {

inline void check_nearest(std::size_t nearest, std::string_view of) {
    if (nearest == 1 || nearest > max_nearest)
        refuse(join({of, ".nearest"}), static_cast<long long>(nearest),
               "0 for all within the radius, or 2 to 512 (one photon sets the radius)");
}

/// Checks all settings but the kernel. `name` is that of the settings, for messages.
template <typename K>
void check_disc(const DensityEstimateOf<K>& gather, std::string_view name = "gather") {
    if (!(gather.radius >= 1e-15f && gather.radius <= 1e15f))
        refuse(join({name, ".radius"}), gather.radius,
               "within [1e-15, 1e15], or no float holds the radiance");
    if (!(gather.thickness > 0 && std::isfinite(gather.thickness)))
        refuse(join({name, ".thickness"}), gather.thickness, "finite and above 0");
    check_nearest(gather.nearest, name);
}

} // namespace detail

/// Checks the settings of an estimate. `name` is that of the settings, for messages.
/// \throws std::invalid_argument  if a value is out of range, or if the mean of a
///         kernel of your own is not 1.
template <typename K>
void check(const DensityEstimateOf<K>& gather, std::string_view name = "gather") {
    detail::check_disc(gather, name);
    if constexpr (!std::same_as<K, Kernel>) {
        double mean = 0; // averaged over a thousand rings of equal area
        for (int i = 0; i < 1000; ++i)
            mean +=
                double(kernel_weight(gather.kernel, (float(i) + 0.5f) / 1000)) / 1000;
        require(std::abs(mean - 1) < 0.01, "the mean of gather.kernel over the disc",
                mean, "1, so that the estimate conserves flux");
    }
}

namespace detail {

/// A sum over the photons of a disc.
struct DiscSum {
    /// The sum, in double because float would lose the last terms.
    RgbT<double> sum{0};
    double radius2 = 1; ///< Squared radius of the disc.
};

/// Divides a sum over a disc by the area of the disc.
/// \param sum  Sum of weight times flux in W, or of weight times flux times BRDF.
/// \return Irradiance in W/m^2 or, with a BRDF, radiance in W/(m^2 sr).
template <std::floating_point T>
[[nodiscard]] RgbT<T> per_area(const RgbT<double>& sum, double radius2) noexcept {
    return RgbT<T>(sum / (std::numbers::pi * radius2));
}

struct OfKinds {
    PhotonKinds kinds; ///< The kinds that count.
    template <std::floating_point T>
    [[nodiscard]] bool operator()(std::uint32_t /*index*/,
                                  const PhotonRecordT<T>& photon) const noexcept {
        return kinds.has(photon.kind);
    }
};

/// The photons of an estimate from the k nearest photons.
struct NearestPhotons {
    std::span<const Neighbor> photons{}; ///< The photons, in no particular order.
    double radius2 = 0;                  ///< Squared radius of the disc.
};

/// Finds the k nearest photons for an estimate. The k-th photon sets the radius and is
/// left out. If there are fewer than k photons within `radius`, all of them are
/// returned. Photons for which turned_away() is true never count.
/// \param room    Space for k elements, at most max_nearest.
/// \param wanted  wanted(index, record) returns whether the photon counts.
template <std::floating_point T, typename Wanted>
[[nodiscard]] LJUS_CORE_CLONES NearestPhotons
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

/// Sums the weighted flux of the k nearest photons, one by one; k is gather.nearest.
/// \param gathered  A counter. The number of summed photons is added to it.
/// \param factor    Called with a PhotonRecordT; returns a factor of the flux.
/// \return The sum; 0 if all k photons lie at one point, where the disc has no area.
template <std::floating_point T, KernelLike<T> K, typename Factor>
[[nodiscard]] DiscSum
sum_of_nearest(const PhotonMapT<T>& map, const SurfacePointT<T>& point,
               const DensityEstimateOf<K>& gather, PhotonKinds kinds,
               std::uint64_t& gathered, const Factor& factor) {
    check_nearest(gather.nearest, "gather"); // there is room for max_nearest only
    const double widest2 = double(gather.radius) * double(gather.radius);
    std::array<Neighbor, max_nearest> room;
    const auto [photons, radius2] =
        nearest_photons(map, point, T(gather.radius),
                        std::span(room.data(), gather.nearest), OfKinds{kinds});
    if (!(radius2 > 1e-30 * std::min(widest2, 1.0))) return {};
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

/// Sums the flux that arrives on one side of a surface within a fixed radius, eight
/// photons at a time.
/// \param side      Unit normal on this side.
/// \param gathered  A counter. The number of photons in the disc, on both sides, is
///                  added to it.
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

/// The irradiance on one side of a surface, from the photons around a point:
///
/// \f[ E(x) = \frac{1}{\pi r^2} \sum_i w_i\, \Delta\Phi_i \f]
///
/// where r is the radius, w_i the weight of photon i by the kernel, and
/// \f$ \Delta\Phi_i \f$ the flux of the photon. estimate_radiance() explains which
/// photons count.
///
/// The function needs no scene, so that photons of another program can be used: copy
/// their position, direction, flux and kind into Photon. The i-th record of the map
/// belongs to photons[map.tree.point_ids()[i]].
///
///     const PhotonMap map = make_photon_map(photons);
///     const Rgb E = estimate_irradiance(map, {.position = x, .normal = n}, n,
///                                       DensityEstimateSettings{.radius = 0.1f});
///     const Rgb L = albedo / pi * E; // radiance of a Lambertian surface
///
/// \param map     The photons.
/// \param point   Point of a surface. Its normal is compared with the normals of the
///                photons.
/// \param side    The normal of the point or its opposite. Photons that arrive on this
///                side are summed.
/// \param gather  The settings.
/// \param kinds   The kinds of photons that count.
/// \return W/m^2; 0 without photons.
/// \throws std::invalid_argument  if the radius, the thickness or the number of nearest
///         photons is out of range.
/// \report{Section 3.2.6}
template <std::floating_point T, KernelLike<T> K = Kernel>
[[nodiscard]] RgbT<T>
estimate_irradiance(const PhotonMapT<T>& map, const SurfacePointT<T>& point,
                    const Vec3T<T>& side, const DensityEstimateOf<K>& gather,
                    PhotonKinds kinds = light_kinds) {
    detail::check_disc(gather);
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
