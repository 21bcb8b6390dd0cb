#pragma once

/// \file ljus/scenes/report_rooms.hpp
/// \brief The room, the camera and the three scenes of the report's figures.

#include <array>

#include "ljus/geometry/shape.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/mixture.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/scenes/room.hpp"

namespace ljus {

/// \defgroup report_room The report's room
/// \brief A room of which the camera sees the floor, the ceiling and four walls.
///
/// x points into the picture, y to the left and z up. As in the report, the part of the
/// room behind the camera is left out: two walls, and the floor and ceiling there.
/// \{

/// The camera of all the report's pictures: at (-7, 0, 0), with a field of view of
/// 53.13 degrees.
///
/// In a square picture, the point (x, y, z) appears at the fraction 1/2 - y/(x + 7) of
/// the width from the left, and at the fraction 1/2 - z/(x + 7) of the height from the
/// top.
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

/// Adds one of the report's lamps: a black square that shines down, 0.001 below the
/// ceiling. Its smallest coordinates are (x, y), and its sides are `size` long. `color`
/// is the lamp's radiance divided by 30, in W/(m^2 sr).
template <typename S, std::floating_point T>
void add_ceiling_lamp(S& scene, T x, T y, T size, const RgbT<T>& color) {
    scene.add(QuadT<T>{.corner{x, y, T(4.999)},
                       .edge_u{T(0), size, T(0)},
                       .edge_v{size, T(0), T(0)}},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}}), T(30) * color);
}

/// Adds the report's room: floor, ceiling and the four visible walls. All are matt and
/// have normals inwards. The scene must list quads, triangles and Lambertian materials.
template <typename S, std::floating_point T = typename S::Scalar>
void add_report_room(S& scene) {
    // The outline of the floor, from the left corner near the camera to the right one.
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

/// \defgroup report_rooms The report's scenes
/// \brief Figures 1, 11, 12, 13 and 15: the objects in the report's room.
///
/// The table lists the materials of the report's program and their counterparts here.
/// Lengths are in scene units, radiances in W/(m^2 sr).
///
/// | the report's program                | here                                     |
/// |-------------------------------------|------------------------------------------|
/// | matt, colour c, up to 1             | Lambertian, albedo 0.75 c                |
/// | Oren-Nayar, roughness 0             | Lambertian, which is the same            |
/// | mirror, reflectivity 1, colour c    | Mirror, 0.98; the program ignored c      |
/// | glass, colour c at each boundary    | Glass of the same index, transmittance   |
/// |                                     | \f$c^2\f$ through the centre (Beer's law)|
/// | a channel of 0 in a glass           | 0.05; a transmittance of 0 would need    |
/// |                                     | infinite absorption                      |
/// | reflectivity r and transparency 1,  | Mixture; both are divided by 1 + r, and  |
/// |   together up to 1 + r of the light | the mirror's fraction is r / (1 + r)     |
/// | index 1.0 (the thin glass)          | index 1.0; light goes straight on        |
/// | lamp of colour c, no unit           | radiance 30 c, on a black surface        |
/// | a lamp 0.00001 below the ceiling    | 0.001 below                              |
/// \{

/// The scene type of the report's rooms.
template <std::floating_point T>
using ReportSceneT =
    Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>>,
          Materials<LambertianT<T>, GlassT<T>, MirrorT<T>, MixtureT<T>>>;

namespace detail {

// The report's program multiplies by the colour at both boundaries. Light through the
// centre of a ball is thus multiplied by the square of the colour, and by the colour
// itself along one radius.
template <std::floating_point T>
RgbT<T> report_absorption(const RgbT<T>& color, T radius) {
    return absorption_from_color(glm::max(color, RgbT<T>{T(0.05)}), radius);
}

template <std::floating_point T>
void add_report_glass(ReportSceneT<T>& scene, const SphereT<T>& ball, T index,
                      const RgbT<T>& color) {
    const GlassT<T> glass{.index = index,
                          .absorption = report_absorption(color, ball.radius)};
    scene.add(ball, scene.add(glass));
}

template <std::floating_point T>
void add_report_mixture(ReportSceneT<T>& scene, const SphereT<T>& ball, T index,
                        T reflectivity, const RgbT<T>& color) {
    const MixtureT<T> mixture{.color = RgbT<T>{T(0)},
                              .reflectivity = reflectivity / (T(1) + reflectivity),
                              .transparency = T(1),
                              .index = index,
                              .absorption = report_absorption(color, ball.radius)};
    scene.add(ball, scene.add(mixture));
}

template <std::floating_point T>
void add_tetrahedron(ReportSceneT<T>& scene) {
    const std::array<Vec3T<T>, 4> v{
        Vec3T<T>{T(7), T(5.09), T(-1)}, Vec3T<T>{T(7), T(3.46), T(0.15)},
        Vec3T<T>{T(6), T(3.46), T(-1.57)}, Vec3T<T>{T(8), T(3.46), T(-1.57)}};
    const MaterialId cyan = scene.add(report_matt<T>(0, 1, 1));
    scene.add(TriangleT<T>{v[0], v[2], v[1]}, cyan);
    scene.add(TriangleT<T>{v[0], v[3], v[2]}, cyan);
    scene.add(TriangleT<T>{v[1], v[3], v[0]}, cyan);
    scene.add(TriangleT<T>{v[2], v[3], v[1]}, cyan);
}

// The matt balls, the mirror and the tetrahedron of figures 1, 12 and 15.
template <std::floating_point T>
void add_report_matt_objects(ReportSceneT<T>& scene) {
    scene.add(SphereT<T>{.center{T(5), T(-0.5), T(-4)}, .radius = T(0.75)},
              scene.add(report_matt<T>(1, 0, 0)));
    scene.add(SphereT<T>{.center{T(10), T(0), T(-0.5)}, .radius = T(1.25)},
              scene.add(report_matt<T>(1, T(0.2), 1)));
    scene.add(SphereT<T>{.center{T(6), T(4), T(2)}, .radius = T(1.15)},
              scene.add(report_matt<T>(1, 1, T(0.2))));
    scene.add(SphereT<T>{.center{T(8), T(3), T(-3)}, .radius = T(1.15)},
              scene.add(MirrorT<T>{.reflectance = RgbT<T>{T(0.98)}}));
    add_tetrahedron(scene);
}

} // namespace detail

/// The room of figure 1, with two lamps and every material.
/// \report{Figure 1}
template <std::floating_point T = float>
[[nodiscard]] Room<ReportSceneT<T>> final_room() {
    ReportSceneT<T> scene;
    add_report_room(scene);
    detail::add_report_matt_objects(scene);
    detail::add_report_mixture<T>(scene, {{T(6), T(-3.5), T(-3.5)}, T(1.15)}, T(1.15),
                                  T(0.6), {T(0.5), T(0.5), T(1)});
    detail::add_report_glass<T>(scene, {{T(6), T(-4), T(1.75)}, T(1.5)}, T(1.47),
                                {T(1), T(1), T(0)});
    detail::add_report_glass<T>(scene, {{T(7), T(0), T(2.75)}, T(0.5)}, T(1.37),
                                {T(0.8), T(0.2), T(1)});
    detail::add_report_glass<T>(scene, {{T(6.5), T(-2), T(0.95)}, T(1)}, T(1.47),
                                {T(0.7), T(1), T(0)});
    add_ceiling_lamp(scene, T(5), T(-1), T(2), RgbT<T>{T(1)});
    add_ceiling_lamp(scene, T(4), T(2), T(1), RgbT<T>{1, 1, T(0.65)});
    return {World(std::move(scene)), report_camera<T>()};
}

/// The room of figures 12 and 15, with one lamp and one object of each material.
/// \report{Figures 12 and 15, Table 3}
template <std::floating_point T = float>
[[nodiscard]] Room<ReportSceneT<T>> all_materials_room() {
    ReportSceneT<T> scene;
    add_report_room(scene);
    detail::add_report_matt_objects(scene);
    detail::add_report_mixture<T>(scene, {{T(6), T(-3.5), T(-3.5)}, T(1.15)}, T(1),
                                  T(0.6), {T(0.5), T(0.5), T(1)});
    detail::add_report_glass<T>(scene, {{T(6), T(-4), T(1.75)}, T(1.5)}, T(1.97),
                                RgbT<T>{T(1)});
    add_ceiling_lamp(scene, T(5), T(-1), T(2), RgbT<T>{T(1)});
    return {World(std::move(scene)), report_camera<T>()};
}

/// The room of figures 11 and 13, with one lamp and four glass balls. Two of the balls
/// were estimated from the report's picture, because no stored version of the report's
/// program contains this room.
/// \report{Figures 11 and 13, Tables 2 and 4}
template <std::floating_point T = float>
[[nodiscard]] Room<ReportSceneT<T>> four_glass_room() {
    ReportSceneT<T> scene;
    add_report_room(scene);
    detail::add_report_glass<T>(scene, {{T(6), T(-4), T(1.75)}, T(1.5)}, T(1.97),
                                RgbT<T>{T(1)});
    detail::add_report_mixture<T>(scene, {{T(6), T(-3.5), T(-3.5)}, T(1.15)}, T(1),
                                  T(0.6), {T(0.5), T(0.5), T(1)});
    detail::add_report_mixture<T>(scene, {{T(8), T(0.5), T(-2.5)}, T(1.5)}, T(1.6),
                                  T(0.5), RgbT<T>{T(1)});
    detail::add_report_glass<T>(scene, {{T(7), T(4.5), T(-3)}, T(1.15)}, T(1.7),
                                {T(1), T(1), T(0.2)});
    add_ceiling_lamp(scene, T(5), T(-1), T(2), RgbT<T>{T(1)});
    return {World(std::move(scene)), report_camera<T>()};
}

/// \}

} // namespace ljus
