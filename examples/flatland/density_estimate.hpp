#pragma once

/// \file flatland/density_estimate.hpp
/// \brief The irradiance at a point of a wall, estimated from photons.

#include <algorithm>

#include "flatland/photon_map.hpp"
#include "ljus/photons/kernel.hpp"

namespace flatland {

using ljus::Kernel;

// Section 3.2.6 in the plane: a disc of radius r cuts an interval of length 2r out of a
// wall.

/// The weight of a photon, relative to 1/(2r).
/// \param kernel  A kernel of ljus::Kernel. Its constant factor is another one in the
///                plane, so that the mean over the *interval* is 1.
/// \param x       Squared distance over squared radius, in [0, 1].
/// \return At least 0.
/// \report{Section 3.2.6}
[[nodiscard]] inline double kernel_weight(Kernel kernel, double x) noexcept {
    switch (kernel) {
    case Kernel::box:
        return 1;
    case Kernel::cone:
        return 2 * (1 - std::sqrt(x));
    case Kernel::gaussian:
        // The factor sqrt(8/pi) / erf(sqrt(2)) is 1 over the mean of exp(-2x).
        return 1.6718382009405384 * std::exp(-2 * x);
    case Kernel::epanechnikov:
        return 1.5 * (1 - x);
    case Kernel::biweight:
        return 1.875 * (1 - x) * (1 - x);
    }
    return 0;
}

/// Settings of an estimate.
struct DensityEstimateSettings {
    double radius = 0.1;     ///< Radius of the disc, in metres.
    std::size_t nearest = 0; ///< Use the k nearest photons within the radius; 0: all.
    Kernel kernel = Kernel::epanechnikov; ///< Weight of a photon by its distance.
};

/// Checks the settings.
/// \param gather  The settings.
/// \throws std::invalid_argument  if a number is out of range, with its name and value.
inline void check(const DensityEstimateSettings& gather) {
    require_positive("gather.radius", gather.radius);
    require(gather.nearest != 1, "gather.nearest",
            static_cast<long long>(gather.nearest),
            "0 for all within the radius, or at least 2 (one photon sets the radius)");
}

/// An estimate of the irradiance, with its disc.
struct Estimate {
    double irradiance = 0;    ///< Irradiance, W/m.
    double radius = 0;        ///< Radius of the disc, in metres.
    std::size_t gathered = 0; ///< Number of photons in the sum.
};

/// Whether a photon counts at a point. It does if its wall is turned by less than 60
/// degrees from that of the point, and if it came from the side of the normal.
/// \param photon  The photon.
/// \param point   A point of a surface.
[[nodiscard]] inline bool counts_at(const Photon& photon,
                                    const SurfacePoint& point) noexcept {
    return glm::dot(photon.normal, point.normal) > 0.5 &&
           glm::dot(photon.direction, point.normal) < 0;
}

/// The irradiance at a point x, estimated from the photons around it,
///
/// \f[ E(x) = \frac{1}{2r} \sum_i w_i\, \Delta\Phi_i, \f]
///
/// where r is the radius of the disc, and photon i has the flux \f$ \Delta\Phi_i \f$
/// and the weight \f$ w_i \f$ of the kernel.
///
/// With the k nearest photons, the k-th sets the radius and is left out of the sum. If
/// the disc has fewer than k photons, all of them are summed and the radius is kept.
/// \param map     The photons.
/// \param point   A point of a surface; the normal points to the side of the estimate.
/// \param gather  Radius, k, kernel; see check().
/// \return The estimate; 0 W/m if the k nearest photons all lie at the point itself.
/// \cost A loop over all photons.
/// \report{Section 3.2.6}
// [photons within]
[[nodiscard]] inline Estimate
estimate_irradiance(const PhotonMap& map, const SurfacePoint& point,
                    const DensityEstimateSettings& gather) {
    struct Found {
        double distance2;
        double flux;
    };
    std::vector<Found> found;
    for (const Photon& photon : map) {
        const Vec2 way = photon.position - point.position;
        const double distance2 = glm::dot(way, way);
        if (distance2 <= gather.radius * gather.radius && counts_at(photon, point))
            found.push_back({distance2, photon.flux});
    }
    // [photons within]
    // [estimate]
    double radius = gather.radius;
    if (gather.nearest > 0 && found.size() >= gather.nearest) {
        const auto kth =
            found.begin() + static_cast<std::ptrdiff_t>(gather.nearest - 1);
        std::nth_element(
            found.begin(), kth, found.end(),
            [](const Found& a, const Found& b) { return a.distance2 < b.distance2; });
        radius = std::sqrt(kth->distance2);
        found.erase(kth, found.end()); // without the k-th photon, which lies on the
                                       // border
    }
    Estimate result{.radius = radius, .gathered = found.size()};
    if (!(radius > 0)) return result;
    for (const Found& photon : found)
        result.irradiance +=
            kernel_weight(gather.kernel, photon.distance2 / (radius * radius)) *
            photon.flux / (2 * radius);
    return result;
}
// [estimate]

} // namespace flatland
