#pragma once

/// \file ljus/scenes/cornell_box.hpp
/// \brief The Cornell box, with a mirror ball and a glass ball.

#include "ljus/geometry/shape.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/scenes/room.hpp"

namespace ljus {

/// \defgroup cornell_box The Cornell box
/// \brief A box that is often used to compare renderers \cite goral1984, here with
/// balls instead of blocks \cite jensen1996.
/// \{

/// The scene type of the Cornell box.
template <std::floating_point T>
using CornellSceneT = Scene<Shapes<QuadT<T>, SphereT<T>>,
                            Materials<LambertianT<T>, MirrorT<T>, GlassT<T>>>;

/// Adds five walls of a box from (-1, 0, -1) to (1, 2, 1), with normals inwards. The
/// side towards the camera is open. The left wall is red, the right wall is green, and
/// the others are white. The scene must list quads and Lambertian materials.
template <typename S, std::floating_point T = typename S::Scalar>
void add_cornell_walls(S& scene) {
    const MaterialId white = scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0.75)}});
    const MaterialId red =
        scene.add(LambertianT<T>{.albedo{T(0.63), T(0.06), T(0.05)}});
    const MaterialId green =
        scene.add(LambertianT<T>{.albedo{T(0.14), T(0.45), T(0.09)}});
    const Vec3T<T> x{T(2), T(0), T(0)};
    const Vec3T<T> y{T(0), T(2), T(0)};
    const Vec3T<T> z{T(0), T(0), T(2)};
    const Vec3T<T> corner{T(-1), T(0), T(-1)};
    scene.add(QuadT<T>{corner, z, x}, white);     // floor
    scene.add(QuadT<T>{corner + y, x, z}, white); // ceiling
    scene.add(QuadT<T>{corner, x, y}, white);     // back
    scene.add(QuadT<T>{corner, y, z}, red);       // left
    scene.add(QuadT<T>{corner + x, z, y}, green); // right
}

/// The camera of the box. The box fills its picture.
template <std::floating_point T = float>
[[nodiscard]] CameraT<T> cornell_camera() {
    return look_at(ViewT<T>{.position{T(0), T(1), T(4.4)},
                            .target{T(0), T(1), T(0)},
                            .up{T(0), T(1), T(0)},
                            .vfov_degrees = T(33)});
}

namespace detail {

/// Adds the lamp below the ceiling, a square of side 0.5.
template <typename S, std::floating_point T = typename S::Scalar>
void add_cornell_lamp(S& scene) {
    scene.add(QuadT<T>{.corner{T(-0.25), T(1.99), T(-0.25)},
                       .edge_u{T(0.5), T(0), T(0)},
                       .edge_v{T(0), T(0), T(0.5)}},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}}),
              RgbT<T>{T(17), T(13), T(8)});
}

} // namespace detail

/// The box with its lamp, a mirror ball and a glass ball.
template <std::floating_point T = float>
[[nodiscard]] Room<CornellSceneT<T>> cornell_box() {
    CornellSceneT<T> scene;
    add_cornell_walls(scene);
    scene.add(SphereT<T>{.center{T(-0.42), T(0.38), T(-0.3)}, .radius = T(0.38)},
              scene.add(MirrorT<T>{.reflectance = RgbT<T>{T(0.95)}}));
    scene.add(SphereT<T>{.center{T(0.42), T(0.38), T(0.3)}, .radius = T(0.38)},
              scene.add(GlassT<T>{.index = T(1.5)}));
    detail::add_cornell_lamp(scene);
    return {World(std::move(scene)), cornell_camera<T>()};
}

/// The Cornell box with two matt balls. All surfaces are diffuse, as radiosity
/// assumes.
// [matt_cornell_box]
template <std::floating_point T = float>
[[nodiscard]] Room<CornellSceneT<T>> matt_cornell_box() {
    CornellSceneT<T> scene;
    add_cornell_walls(scene);
    scene.add(SphereT<T>{.center{T(-0.42), T(0.38), T(-0.3)}, .radius = T(0.38)},
              scene.add(LambertianT<T>{.albedo{T(0.2), T(0.35), T(0.7)}}));
    scene.add(SphereT<T>{.center{T(0.42), T(0.38), T(0.3)}, .radius = T(0.38)},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0.7)}}));
    detail::add_cornell_lamp(scene);
    return {World(std::move(scene)), cornell_camera<T>()};
}
// [matt_cornell_box]

/// \}

} // namespace ljus
