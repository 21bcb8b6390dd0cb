#pragma once

/// \file support/box_sides.hpp
/// \brief Rooms and blocks of six quads.

#include <array>
#include <cstddef>

#include "ljus/geometry/quad.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus_test {

/// Adds a room whose sides face inwards.
/// \param sides  The materials of floor, ceiling, back, front, left and right.
template <typename S>
void add_room(S& scene, const ljus::Vec3& low, const ljus::Vec3& high,
              const std::array<ljus::MaterialId, 6>& sides) {
    const ljus::Vec3 e = high - low, x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
    const std::array<ljus::Quad, 6> quads{{{low, z, x},
                                           {low + y, x, z},
                                           {low, x, y},
                                           {low + z, y, x},
                                           {low, y, z},
                                           {low + x, z, y}}};
    for (std::size_t i = 0; i < 6; ++i) scene.add(quads[i], sides[i]);
}

/// Adds a block whose sides face outwards.
template <typename S>
void add_block(S& scene, const ljus::Vec3& low, const ljus::Vec3& high,
               ljus::MaterialId material) {
    const ljus::Vec3 e = high - low, x{e.x, 0, 0}, y{0, e.y, 0}, z{0, 0, e.z};
    for (const ljus::Quad& side : std::array<ljus::Quad, 6>{{{low, x, z},
                                                             {low + y, z, x},
                                                             {low, y, x},
                                                             {low + z, x, y},
                                                             {low, z, y},
                                                             {low + x, y, z}}})
        scene.add(side, material);
}

} // namespace ljus_test
