#pragma once

/// \file ljus/photons/lone_photons.hpp
/// \brief The photons of a map that have few other photons around them.

#include <array>
#include <vector>

#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

/// A photon is *lone* if fewer than this number of other photons lie within the radius
/// of an estimate.
inline constexpr std::size_t lone_others = 3;

/// Finds the lone photons of a map: those with fewer than `lone_others` other photons
/// within the radius. An estimate shows a lone photon as a visible disc. A wider disc
/// is fainter and carries the same flux, except where it reaches beyond an edge. An
/// estimate in which each photon has its own radius is called a variable kernel
/// estimate \cite silverman1986.
/// \param map     The photons.
/// \param radius  The radius of the estimate, in scene units.
/// \return A map of the lone photons, with all their data; empty if there are none.
/// \cost A search for each photon, unless the eight photons of its block in the tree
///       already show that it is not lone.
// [lone_photons]
template <std::floating_point T>
[[nodiscard, gnu::cold]] PhotonMapT<T> lone_photons(const PhotonMapT<T>& map,
                                                    T radius) {
    detail::PhotonPartsT<T> lone(1);
    std::array<Neighbor, lone_others + 1> room; // with the photon itself
    for (std::size_t i = 0; i < map.records.size(); ++i) {
        const Vec3T<T> place = map.tree.point(i);
        const auto distances = detail::distances2(map.tree.blocks()[i / 8], place);
        std::size_t near = 0;
        for (const T distance2 : distances.lane) near += distance2 <= radius * radius;
        if (near < room.size())
            near = map.tree.template nearest<lone_others + 1>(place, radius, room);
        if (near >= room.size()) continue;
        const detail::PhotonRecordT<T> record = map.records[i];
        lone[0].push_back({place, record.direction, record.flux, record.light,
                           record.kind, record.normal});
    }
    return detail::map_of_parts(std::move(lone));
}
// [lone_photons]

/// \}

} // namespace ljus
