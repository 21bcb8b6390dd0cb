#pragma once

/// \file ljus/scenes/report_room.hpp
/// \brief The room and the camera of all the report's figures.

#include <array>

#include "ljus/geometry/shape.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scenes/room.hpp"

namespace ljus {

/// \defgroup report_room The report's room
/// \brief A room with six walls, of which the camera sees four.
///
/// x points into the picture, y to the left and z up. As in the report, the two walls
/// behind the camera and the floor and ceiling between them are left out.
/// \{

/// The camera of all the report's pictures: 53.13 degrees, from (-7, 0, 0).
///
/// The point (x, y, z) appears at the fraction 1/2 - y/(x + 7) of the width and
/// 1/2 - z/(x + 7) of the height, from the upper left corner.
template <std::floating_point T = float>
[[nodiscard]] CameraT<T> report_camera() {
    return look_at(ViewT<T>{.position{T(-7), T(0), T(0)},
                            .target{T(0), T(0), T(0)},
                            .up{T(0), T(0), T(1)},
                            .vfov_degrees = T(53.13010235415598)});
}

namespace detail {

template <std::floating_point T>
LambertianT<T> report_matt(T red, T green, T blue) {
    return {.albedo = T(0.75) * RgbT<T>{red, green, blue}};
}

} // namespace detail

/// Adds one of the report's lamps: a black square below the ceiling that shines down.
/// \param scene  A scene with quads and Lambertian materials.
/// \param x      x of its first corner; the lamp ends at x + size.
/// \param y      y of its first corner; the lamp ends at y + size.
/// \param size   Length of its sides.
/// \param color  The lamp's radiance over 30.
template <typename S, std::floating_point T>
void add_ceiling_lamp(S& scene, T x, T y, T size, const RgbT<T>& color) {
    scene.add(QuadT<T>{.corner{x, y, T(4.999)},
                       .edge_u{T(0), size, T(0)},
                       .edge_v{size, T(0), T(0)}},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}}), T(30) * color);
}

/// Adds the report's room: floor, ceiling and the four visible walls, all matt, with
/// normals inwards.
/// \param scene  A scene with quads, triangles and Lambertian materials.
template <typename S, std::floating_point T = typename S::Scalar>
void add_report_room(S& scene) {
    // The outline of the floor from v2, the left corner near the camera, to v6.
    constexpr std::array<std::array<T, 2>, 5> outline{
        {{T(0), T(6)}, {T(10), T(6)}, {T(13), T(0)}, {T(10), T(-6)}, {T(0), T(-6)}}};
    const auto corner = [&](std::size_t i, T z) {
        return Vec3T<T>{outline[i][0], outline[i][1], z};
    };
    const T low = T(-5);
    const T high = T(5);

    const MaterialId white = scene.add(detail::report_matt<T>(1, 1, 1));
    scene.add(QuadT<T>{.corner = corner(0, low),
                       .edge_u = corner(4, low) - corner(0, low),
                       .edge_v = corner(1, low) - corner(0, low)},
              white);
    scene.add(TriangleT<T>{corner(1, low), corner(3, low), corner(2, low)}, white);
    scene.add(QuadT<T>{.corner = corner(0, high),
                       .edge_u = corner(1, high) - corner(0, high),
                       .edge_v = corner(4, high) - corner(0, high)},
              white);
    scene.add(TriangleT<T>{corner(1, high), corner(2, high), corner(3, high)}, white);

    const std::array<LambertianT<T>, 4> walls{
        detail::report_matt<T>(T(0.05), 1, T(0.05)),  // left: green
        detail::report_matt<T>(T(0.05), T(0.05), 1),  // front left: blue
        detail::report_matt<T>(1, T(0.05), T(0.05)),  // front right: red
        detail::report_matt<T>(1, T(0.25), T(0.05))}; // right: orange
    for (std::size_t i = 0; i < walls.size(); ++i)
        scene.add(QuadT<T>{.corner = corner(i, low),
                           .edge_u = corner(i + 1, low) - corner(i, low),
                           .edge_v{T(0), T(0), high - low}},
                  scene.add(walls[i]));
}

/// \}

} // namespace ljus
