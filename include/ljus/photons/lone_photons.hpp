#pragma once

/// \file ljus/photons/lone_photons.hpp
/// \brief The photons of a map that have hardly any others around them.

#include <array>
#include <vector>

#include "ljus/photons/photon_map.hpp"

namespace ljus {

/// \addtogroup photon_map
/// \{

/// A photon with fewer others within the radius of an estimate is lone.
inline constexpr std::size_t lone_others = 3;

/// The lone photons of a map. An estimate shows each of them as a disc that differs
/// from its surroundings. If its flux is spread over a wider disc in place of that one,
/// the disc is fainter and no light is lost, except where it ends beyond an edge. The
/// radius of a photon depends on the photons around it, as in a variable kernel
/// estimate \cite silverman1986, and not on where the estimate is made.
/// \param map     The photons.
/// \param radius  Of the estimate, in scene units.
/// \return A map of them alone, and all of their data; empty if there are none.
/// \cost A search for each photon that has fewer than `lone_others` others within the
///       radius among the eight of its block.
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
