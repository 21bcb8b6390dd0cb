#pragma once

/// \file flatland/room.hpp
/// \brief A room of Flatland: four walls, a lamp, a mirror, a disc of glass.

#include "flatland/light.hpp"

namespace flatland {

// The room of chapter 23 resembles that of the report's figure 1 (section 4.1).

/// The settings that a reader may change.
struct RoomSettings {
    Vec2 lamp{-0.45, 0.95};  ///< The middle of the lamp.
    double index = 1.5;      ///< Index of refraction of the disc.
    double albedo = 0.5;     ///< Albedo of the walls.
    double flux = 1;         ///< Flux of the lamp, W.
    double lamp_size = 0.03; ///< Radius of the lamp, in metres.
};

/// The floor from end to end; its normal points up.
inline constexpr Segment room_floor{.from{-1, 0}, .to{1, 0}};
/// The disc of glass.
inline constexpr Circle room_disc{.center{0.1, 0.45}, .radius = 0.25};
/// The mirror, in the upper right corner.
inline constexpr Segment room_mirror{.from{0.95, 0.6}, .to{0.6, 1.0}};
/// The height of the room, in metres.
inline constexpr double room_height = 1.1;

/// Makes the room. The floor is its first object.
/// \param settings  The settings.
/// \return The scene.
[[nodiscard]] inline Scene make_room(const RoomSettings& settings = {}) {
    const Lambertian wall{settings.albedo};
    const Circle lamp{settings.lamp, settings.lamp_size};
    const Vec2 left = room_floor.from, right = room_floor.to, up{0, room_height};
    return {{{room_floor, wall}, // counter-clockwise: the normals point into the room
             {Segment{right, right + up}, wall},
             {Segment{right + up, left + up}, wall},
             {Segment{left + up, left}, wall},
             {room_mirror, Mirror{0.95}},
             {room_disc, Glass{settings.index}},
             {lamp, Lambertian{0}, radiance_of(lamp, settings.flux)}}};
}

} // namespace flatland
