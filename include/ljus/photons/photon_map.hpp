#pragma once

/// \file ljus/photons/photon_map.hpp
/// \brief Photons in a k-d tree.

#include "ljus/accel/kd_tree8.hpp"
#include "ljus/photons/detail/photon_records.hpp"

namespace ljus {

/// \defgroup photon_map Photon maps
/// \brief Sections 3.2.2 and 3.2.6: the general map and the caustics map.
/// \{

/// Photons, ordered for searching. The general map and the caustics map differ in what
/// was traced into them, not in what they are.
template <std::floating_point T>
struct PhotonMapT {
    KdTree8T<T> tree;                  ///< The positions.
    detail::PhotonRecordsT<T> records; ///< The rest, in the order of the tree.

    /// Whether there is nothing to be found.
    [[nodiscard]] bool empty() const noexcept { return records.empty(); }
};
using PhotonMap = PhotonMapT<float>; ///< PhotonMapT in float.

namespace detail {

// Where photons are, if all that they carry is finite.
template <std::floating_point T>
[[nodiscard]] std::vector<Vec3T<T>>
checked_positions(const std::vector<PhotonT<T>>& photons) {
    std::vector<Vec3T<T>> positions(photons.size());
    for (std::size_t i = 0; i < photons.size(); ++i) {
        require_finite("photon.direction", photons[i].direction);
        require_finite("photon.flux", photons[i].flux);
        positions[i] = photons[i].position;
    }
    return positions;
}

} // namespace detail

/// Builds a map.
/// \param photons  In any order, which it does not keep.
/// \param threads  As in ParallelSettings.
/// \return The map, the same for any number of threads.
/// \throws std::invalid_argument  if a position, a direction or a flux is not finite.
template <std::floating_point T>
[[nodiscard]] PhotonMapT<T> make_photon_map(const std::vector<PhotonT<T>>& photons,
                                            int threads = 0) {
    PhotonMapT<T> map;
    map.tree = KdTree8T<T>(detail::checked_positions(photons), threads);
    map.records = detail::PhotonRecordsT<T>(photons, map.tree.point_ids());
    return map;
}

/// \}

} // namespace ljus
