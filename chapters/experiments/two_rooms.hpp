#pragma once

/// \file chapters/experiments/two_rooms.hpp
/// \brief A lit room and a dark one with a thin wall between: a photon map leaks here.

#include "ljus/geometry/quad.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/world.hpp"

namespace examples {

/// A scene of flat walls.
using Boxes = ljus::Scene<ljus::Shapes<ljus::Quad>, ljus::Materials<ljus::Lambertian>>;

/// Two rooms, open in front, with a wall between them that has no thickness; a lamp in
/// the left one.
struct TwoRooms {
    ljus::World<Boxes> world; ///< Walls, floor, ceiling, and the lamp.
    ljus::Quad lamp;          ///< Of radiance 8; under the ceiling, facing down.
};

/// Makes the two rooms.
inline TwoRooms two_rooms() {
    using ljus::Lambertian, ljus::Quad, ljus::Rgb, ljus::Vec3;
    Boxes scene;
    const auto white = scene.add(Lambertian{.albedo = Rgb{0.75f}});
    const auto red = scene.add(Lambertian{.albedo = Rgb{0.75f, 0.3f, 0.2f}});
    const auto blue = scene.add(Lambertian{.albedo = Rgb{0.2f, 0.4f, 0.75f}});
    const auto black = scene.add(Lambertian{.albedo = Rgb{0}});
    const Vec3 x{2, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
    scene.add(Quad{.corner{-1, 0, 0}, .edge_u = z, .edge_v = x}, white); // floor
    scene.add(Quad{.corner{-1, 1, 0}, .edge_u = x, .edge_v = z}, white); // ceiling
    scene.add(Quad{.corner{-1, 0, 0}, .edge_u = x, .edge_v = y}, white); // back
    scene.add(Quad{.corner{-1, 0, 0}, .edge_u = y, .edge_v = z}, red);
    scene.add(Quad{.corner{1, 0, 0}, .edge_u = z, .edge_v = y}, blue);
    scene.add(Quad{.corner{0, 0, 0}, .edge_u = y, .edge_v = z}, white); // between
    const Quad lamp{
        .corner{-0.7f, 0.999f, 0.3f}, .edge_u{0.4f, 0, 0}, .edge_v{0, 0, 0.4f}};
    scene.add(lamp, black, Rgb{8});
    return {ljus::World(std::move(scene)), lamp};
}

} // namespace examples
