#pragma once

/// \file flatland/density_estimate.hpp
/// \brief The irradiance at a point of a wall, estimated from photons.

#include <algorithm>

#include "flatland/photon_map.hpp"
#include "ljus/photons/kernel.hpp"

namespace flatland {

using ljus::Kernel;

// Section 3.2.6: a disc of the plane cuts an interval of length 2r out of a
// wall.

/// The weight of a photon, relative to 1/(2r).
/// \param kernel  The kernel, as in ljus::Kernel, but with a mean of 1 over the
///                *interval*, which changes the constant factor.
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
        // sqrt(8/pi) / erf(sqrt(2)): one over its mean over the interval.
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
    double radius = 0.1;                  ///< In metres.
    std::size_t nearest = 0;              ///< k within the radius; 0: all within it.
    Kernel kernel = Kernel::epanechnikov; ///< The weight by distance.
};

/// Refuses settings that give no estimate.
/// \param gather  The settings.
/// \throws std::invalid_argument  with name and value.
inline void check(const DensityEstimateSettings& gather) {
    require_positive("gather.radius", gather.radius);
    require(gather.nearest != 1, "gather.nearest",
            static_cast<long long>(gather.nearest),
            "0 for all within the radius, or at least 2 (one photon sets the radius)");
}

/// An estimate, and its interval.
struct Estimate {
    double irradiance = 0;    ///< W/m.
    double radius = 0;        ///< Radius of the disc, in metres.
    std::size_t gathered = 0; ///< Photons within it that were summed.
};

/// Whether a photon counts at a point: it lies on the same wall, or on one that is
/// turned by less than 60 degrees, and came from the side of the normal.
/// \param photon  The photon.
/// \param point   A point of a surface.
[[nodiscard]] inline bool counts_at(const Photon& photon,
                                    const SurfacePoint& point) noexcept {
    return glm::dot(photon.normal, point.normal) > 0.5 &&
           glm::dot(photon.direction, point.normal) < 0;
}

/// The irradiance at a point, estimated from the photons around it:
///
/// \f[ E(x) = \frac{1}{2r} \sum_i w_i\, \Delta\Phi_i \f]
///
/// With the k nearest, the k-th sets the radius and is left out of the sum. Fewer than
/// k within the radius are summed over the whole disc.
/// \param map     The photons.
/// \param point   A point of a surface; the normal points to the side of the estimate.
/// \param gather  Radius, k, kernel; see check().
/// \return The estimate; 0 W/m if the k nearest all lie at the point itself.
/// \cost A walk over all photons.
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
        found.erase(kth, found.end()); // it lies on the border
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
