#pragma once

/// \file ljus/photons/density_estimate.hpp
/// \brief The radiance that the photons around a point stand for.

#include <numbers>

#include "ljus/materials/lambertian.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/photons/irradiance_estimate.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

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
/// 60 degrees, in a disc of the thickness. A photon whose `normal` is left 0 matches
/// every surface. On a ball the cap within r of a point of it
/// has the area \f$ \pi r^2 \f$, as a plane has, so that nothing is lost on a ball of
/// radius r or more. At a surface's edge half of the disc lies beside it, in a corner
/// three quarters, and the estimate reads 1/2 and 1/4 of what it should.
///
/// \param map       The photons.
/// \param surface   Where they are gathered: of the vertex only point.position,
///                  point.normal and frame are read.
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
    // A matt surface sends back the same share of all: the irradiance times its BRDF.
    const Vec3T<T> side = std::copysign(T(1), wo.z) * surface.frame.normal;
    const auto [flux, radius2] =
        detail::flux_within(map, surface.point, side, gather, kinds, gathered);
    return detail::per_area<T>(RgbT<double>(evaluate(material, wo, wo)) * flux,
                               radius2);
}

/// \}

} // namespace ljus
