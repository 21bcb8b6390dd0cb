#pragma once

/// \file ljus/photons/photon_map.hpp
/// \brief Photons in a k-d tree.

#include <array>
#include <cmath>

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/detail/photon_records.hpp"

namespace ljus {

/// \defgroup photon_map Photon maps
/// \brief Sections 3.2.2 and 3.2.6: the general map and the caustics map.
/// \{

/// Photons in a k-d tree. The general map and the caustics map have this type; they
/// differ in the photons traced into them.
template <std::floating_point T>
struct PhotonMapT {
    KdTree8T<T> tree;                  ///< The positions.
    detail::PhotonRecordsT<T> records; ///< All but the positions, in the tree's order.

    /// Whether the map has no photons.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using PhotonMap = PhotonMapT<float>; ///< PhotonMapT in float.

namespace detail {

// The positions of photons whose members are right: a direction of (0, 0, 0), for one,
// would arrive at neither side of a surface.
template <std::floating_point T>
[[nodiscard]] std::vector<Vec3T<T>>
checked_positions(const std::vector<PhotonT<T>>& photons) {
    std::vector<Vec3T<T>> positions(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        require_finite("photon.flux", photons[i].flux);
        const Vec3T<T>& direction = photons[i].direction;
        require(std::abs(glm::dot(direction, direction) - T(1)) <= T(0.01),
                "photon.direction", direction, "a vector of length 1");
        positions[i] = photons[i].position;
    }
    return positions;
}

} // namespace detail

/// Builds a map.
/// \param photons  In any order.
/// \param threads  As in ParallelSettings.
/// \return The map, the same for any number of threads.
/// \throws std::invalid_argument  if a position or a flux is not finite, or a direction
///         is not of length 1, to 0.5 percent.
template <std::floating_point T>
[[nodiscard]] PhotonMapT<T> make_photon_map(const std::vector<PhotonT<T>>& photons,
                                            int threads = 0) {
    PhotonMapT<T> map;
    map.tree = KdTree8T<T>(detail::checked_positions(photons), threads);
    map.records = detail::PhotonRecordsT<T>(photons, map.tree.point_ids());
    return map;
}

/// The typical radius of a disc with a given number of photons: the geometric mean over
/// the photons of a map, between that of a caustic's focus and that of faint light.
/// \param map    The photons.
/// \param count  Number of photons, 1 to 511.
/// \return In scene units; 1 if there are no photons, or if all lie at one point.
/// \cost At most 255 searches.
template <std::floating_point T>
[[nodiscard, gnu::cold]] T typical_radius(const PhotonMapT<T>& map, std::size_t count) {
    std::array<Neighbor, 512> room;
    const std::span<Neighbor> found(room.data(), count + 1); // with the photon itself
    const std::size_t step = map.records.size() / 255 + 1;
    double logarithms = 0, photons = 0;
    for (std::size_t i = 0; i < map.records.size(); i += step) {
        const std::size_t near = map.tree.template nearest<512>(
            map.tree.point(i), std::numeric_limits<T>::infinity(), found);
        if (near < 2 || !(found[0].distance2 > 0)) continue;
        logarithms += std::log(found[0].distance2) / 2;
        ++photons;
    }
    return photons > 0 ? static_cast<T>(std::exp(logarithms / photons)) : T(1);
}

/// \}

} // namespace ljus
