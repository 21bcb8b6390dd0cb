#pragma once

/// \file ljus/scenes/furnaces.hpp
/// \brief Closed rooms that glow, with a known radiance.

#include "ljus/geometry/shape.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scenes/room.hpp"

namespace ljus {

/// \defgroup furnaces Furnaces
/// \brief A furnace is a closed room whose walls all have the same emission L and
/// albedo a. At every point and in every direction the radiance is
///
/// \f[ L + aL + a^2L + \dots = \frac{L}{1 - a}. \f]
///
/// This holds for any shape of the room, and with any objects of the same emission and
/// albedo in it.
/// \{

namespace detail {

template <std::floating_point T>
using SphereFurnaceT = Scene<Shapes<SphereT<T>>, Materials<LambertianT<T>>>;
template <std::floating_point T>
using BoxFurnaceT = Scene<Shapes<QuadT<T>>, Materials<LambertianT<T>>>;

template <std::floating_point T>
CameraT<T> furnace_camera() {
    return look_at(ViewT<T>{.position{T(0.3), T(-0.2), T(0.5)},
                            .target{T(0), T(0), T(-1)},
                            .up{T(0), T(1), T(0)},
                            .vfov_degrees = T(90)});
}

} // namespace detail

/// A furnace inside the sphere of radius 1 around the origin, with the emission of its
/// wall in W/(m^2 sr). Its only lamp is the wall itself. With an albedo of 1 the
/// radiance inside has no bound.
/// \throws std::invalid_argument  if the emission is negative or the albedo is not
///         within [0, 1].
template <std::floating_point T>
[[nodiscard]] Room<detail::SphereFurnaceT<T>> sphere_furnace(const RgbT<T>& emission,
                                                             const RgbT<T>& albedo) {
    detail::SphereFurnaceT<T> scene;
    const MaterialId wall = scene.add(LambertianT<T>{.albedo = albedo});
    scene.add(SphereT<T>{}, wall, emission, true);
    return {World(std::move(scene)), detail::furnace_camera<T>()};
}

/// A furnace inside the cube of side 2 around the origin, with the emission of its
/// walls in W/(m^2 sr). With an albedo of 1 the radiance inside has no bound. Near an
/// edge the glowing walls are so close that only multiple importance sampling bounds
/// the noise.
/// \throws std::invalid_argument  if the emission is negative or the albedo is not
///         within [0, 1].
template <std::floating_point T>
[[nodiscard]] Room<detail::BoxFurnaceT<T>> box_furnace(const RgbT<T>& emission,
                                                       const RgbT<T>& albedo) {
    detail::BoxFurnaceT<T> scene;
    const MaterialId wall = scene.add(LambertianT<T>{.albedo = albedo});
    const Vec3T<T> x{T(2), T(0), T(0)};
    const Vec3T<T> y{T(0), T(2), T(0)};
    const Vec3T<T> z{T(0), T(0), T(2)};
    const Vec3T<T> corner{T(-1), T(-1), T(-1)};
    for (const QuadT<T>& side : {QuadT<T>{corner, z, x}, QuadT<T>{corner + y, x, z},
                                 QuadT<T>{corner, x, y}, QuadT<T>{corner + z, y, x},
                                 QuadT<T>{corner, y, z}, QuadT<T>{corner + x, z, y}})
        scene.add(side, wall, emission);
    return {World(std::move(scene)), detail::furnace_camera<T>()};
}

/// \}

} // namespace ljus
