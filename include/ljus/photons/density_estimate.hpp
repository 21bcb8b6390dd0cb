#pragma once

/// \file ljus/photons/density_estimate.hpp
/// \brief The radiance that the photons around a point stand for.

#include <array>
#include <numbers>

#include "ljus/materials/lambertian.hpp"
#include "ljus/path/vertex.hpp"
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

/// Whether an estimate runs eight photons at a time: on a matt surface, unless the
/// radius is of a size whose square no float can hold.
/// \param gather  How.
template <typename Material, typename K>
[[nodiscard]] constexpr bool in_lanes(const DensityEstimateOf<K>& gather) noexcept {
    return std::same_as<Material, LambertianT<typename Material::Scalar>> &&
           1e-15f < gather.radius && gather.radius < 1e15f;
}

} // namespace detail

/// The plain twin of estimate_radiance() with all photons within the radius: photon by
/// photon, for any material. What the chapter shows, what the fast one is tested
/// against, and what runs where that would not be faster.
/// \param map       The photons.
/// \param surface   Where they are gathered.
/// \param material  What the surface is made of.
/// \param wo        Unit vector in the surface's frame, to where the light goes.
/// \param gather    Radius, kernel, thickness.
/// \param kinds     Which kinds count.
/// \param gathered  Counts the photons that were summed.
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
    RgbT<double> sum{0}; // many small terms: a float would lose the last of them
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

namespace detail {

/// The nearest photons that count at a point: a search for all materials.
/// \param map     The photons.
/// \param point   Of a surface, from which they must not be turned_away().
/// \param radius  They lie within it.
/// \param kinds   Which kinds count.
/// \param found   Room for as many as are wanted, at most max_nearest; the farthest is
///                put first.
/// \return How many were found.
template <std::floating_point T>
[[nodiscard]] std::size_t
nearest_photons(const PhotonMapT<T>& map, const SurfacePointT<T>& point, T radius,
                PhotonKinds kinds, std::span<Neighbor> found) {
    const auto counts = [&](std::uint32_t i) {
        const PhotonRecordT<T> photon = map.records[i];
        return kinds.has(photon.kind) && !turned_away(photon.normal, point.normal);
    };
    const Vec3T<T>& x = point.position;
    return map.tree.template nearest<max_nearest>(x, radius, found, counts);
}

} // namespace detail

/// The radiance that the photons around a point send towards an observer:
///
/// \f[ L(x, \omega_o) = \frac{1}{\pi r^2} \sum_i w_i\, f(\omega_o, \omega_i)\,
///     \Delta\Phi_i \f]
///
/// With the k nearest, the k-th sets the radius and is left out of the sum: counting it
/// would be too bright by k/(k-1). Fewer than k within the radius are summed over the
/// whole disc, and the mean stays right.
///
/// Only photons of the same surface count: those whose surface is turned by less than
/// 60 degrees, in a disc of the thickness. On a ball the cap within r of a point of it
/// has the area \f$ \pi r^2 \f$, as a plane has, so that nothing is lost on a ball of
/// radius r or more. At a surface's edge half of the disc lies beside it, in a corner
/// three quarters, and the estimate reads 1/2 and 1/4 of what it should.
///
/// \param map       The photons.
/// \param surface   Where they are gathered.
/// \param material  What the surface is made of.
/// \param wo        Unit vector in the surface's frame, to where the light goes.
/// \param gather    Radius, k, kernel.
/// \param kinds     Which kinds count.
/// \param gathered  Counts the photons that were summed.
/// \return Radiance, W/(m^2 sr); 0 if the k nearest photons all lie at x itself, or
///         within 1e-15 of the radius of it: a disc without an area.
/// \report{Section 3.2.6}
/// \erratum{The report's R_i is called a radiance; it is the BRDF times the photon's
///          flux. There is no cosine: the flux that arrives on the surface holds it.}
template <std::floating_point T, typename Material, KernelLike<T> K = Kernel>
[[nodiscard]] RgbT<T> estimate_radiance(const PhotonMapT<T>& map,
                                        const VertexT<T>& surface,
                                        const Material& material, const Vec3T<T>& wo,
                                        const DensityEstimateOf<K>& gather,
                                        PhotonKinds kinds, std::uint64_t& gathered) {
    if (map.empty()) return RgbT<T>{T(0)};
    const Vec3T<T>& x = surface.point.position;
    const double widest2 = double(gather.radius) * double(gather.radius);
    double radius2 = widest2;

    RgbT<double> sum{0}; // many small terms: a float would lose the last of them
    if (gather.nearest == 0) {
        if (!detail::in_lanes<Material>(gather))
            return estimate_radiance_plain(map, surface, material, wo, gather, kinds,
                                           gathered);
        // A matt surface sends back the same share of all: their flux is summed.
        const detail::FluxDiscT<T, K> disc{.center = x,
                                           .normal = surface.point.normal,
                                           .from = std::copysign(T(1), wo.z) *
                                                   surface.frame.normal,
                                           .radius = T(gather.radius),
                                           .thickness = T(gather.thickness),
                                           .kernel = gather.kernel,
                                           .kinds = kinds};
        sum = RgbT<double>(evaluate(material, wo, wo)) *
              detail::flux_in_disc(map.tree, map.records, disc, gathered);
    } else {
        std::array<Neighbor, max_nearest> room;
        const std::span<Neighbor> found(room.data(), gather.nearest);
        const std::size_t count =
            detail::nearest_photons(map, surface.point, T(gather.radius), kinds, found);
        const bool full = count == gather.nearest;
        if (full) radius2 = found[0].distance2;
        // All photons in one point have no area: there is no estimate.
        if (!(radius2 > 1e-30 * widest2)) return RgbT<T>{T(0)};
        for (std::size_t k = full ? 1 : 0; k < count; ++k) {
            const detail::PhotonRecordT<T> photon = map.records[found[k].index];
            const double height =
                glm::dot(glm::dvec3(map.tree.point(found[k].index)) - glm::dvec3(x),
                         glm::dvec3(surface.point.normal));
            const double limit = double(gather.thickness);
            if (height * height > limit * limit * radius2) continue;
            const T weight =
                kernel_weight(gather.kernel, T(found[k].distance2 / radius2));
            const Vec3T<T> from_light = to_local(surface.frame, -photon.direction);
            sum +=
                RgbT<double>(weight * evaluate(material, wo, from_light) * photon.flux);
            ++gathered;
        }
    }
    return RgbT<T>(sum / (std::numbers::pi * radius2));
}

/// \}

} // namespace ljus
