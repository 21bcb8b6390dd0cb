/// \file own_photons.hpp
/// \brief Photons of the reader's own in the library's k-d tree.
#pragma once
#include <cstdint>
#include <numbers>
#include <span>
#include <vector>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/irradiance_estimate.hpp"
#include "ljus/photons/kernel.hpp"

/// Code that a reader of the book has written.
namespace reader {

// [photon]
/// A photon that also stores how often it was reflected.
struct OwnPhoton {
    ljus::Vec3 position{0};  ///< Position, in scene units.
    ljus::Vec3 direction{0}; ///< Direction of travel, unit.
    ljus::Rgb flux{0};       ///< Flux, W.
    int bounces = 0;         ///< Number of reflections.
};
// [photon]

// [tree]
/// Photons in the order of their tree, so that sorted[i] belongs to tree.point(i).
struct OwnMap {
    ljus::KdTree8 tree;            ///< The positions of the photons.
    std::vector<OwnPhoton> sorted; ///< The photons.

    /// Builds the tree and sorts the photons.
    explicit OwnMap(const std::vector<OwnPhoton>& photons) {
        std::vector<ljus::Vec3> positions;
        for (const OwnPhoton& photon : photons) positions.push_back(photon.position);
        tree = ljus::KdTree8{std::span<const ljus::Vec3>(positions)};
        for (const std::uint32_t id : tree.point_ids()) sorted.push_back(photons[id]);
    }
};
// [tree]

// [irradiance]
/// The irradiance at a point from photons with a given number of bounces, W/m^2.
/// \param map      The photons.
/// \param x        The point.
/// \param normal   Unit normal on the lit side; photons travel against it.
/// \param radius   Radius of the disc of photons, in scene units.
/// \param bounces  Only photons with this number count.
inline ljus::Rgb irradiance(const OwnMap& map, const ljus::Vec3& x,
                            const ljus::Vec3& normal, float radius, int bounces) {
    ljus::Rgb sum{0};
    map.tree.visit_within(x, radius, [&](std::uint32_t i, double distance2) {
        const OwnPhoton& photon = map.sorted[i];
        if (photon.bounces != bounces || dot(photon.direction, normal) >= 0) return;
        const float x2 = float(distance2) / (radius * radius);
        sum += kernel_weight(ljus::Kernel::epanechnikov, x2) * photon.flux;
    });
    return sum / (std::numbers::pi_v<float> * radius * radius);
}
// [irradiance]

// [library]
/// Copies photons into a map of the library, without their bounces.
inline ljus::PhotonMap library_map(const std::vector<OwnPhoton>& photons) {
    std::vector<ljus::Photon> copies;
    for (const OwnPhoton& photon : photons)
        copies.push_back({.position = photon.position,
                          .direction = photon.direction,
                          .flux = photon.flux}); // no normal: counts on any surface
    return ljus::make_photon_map(copies);
}

/// The irradiance at a point from all photons of a map, W/m^2.
inline ljus::Rgb irradiance(const ljus::PhotonMap& map, const ljus::Vec3& x,
                            const ljus::Vec3& normal, float radius) {
    return estimate_irradiance(map, {.position = x, .normal = normal}, normal,
                               ljus::DensityEstimateSettings{.radius = radius});
}
// [library]

} // namespace reader
