#pragma once

/// \file ljus/scenes/material_rows.hpp
/// \brief Four balls beside each other: materials, and one material's roughness.

#include <array>
#include <numbers>

#include "ljus/materials/glass.hpp"
#include "ljus/materials/mirror.hpp"
#include "ljus/materials/oren_nayar.hpp"
#include "ljus/scenes/report_room.hpp"

namespace ljus {

/// \defgroup material_rows Rows of balls
/// \brief Figures 4 and 14, in the report's room: the balls stand on its floor.
/// \{

/// What figure 4 shows, but for the soap bubble.
template <std::floating_point T>
using MaterialRowT =
    Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>>,
          Materials<LambertianT<T>, OrenNayarT<T>, GlassT<T>, MirrorT<T>>>;

/// A row of Oren-Nayar's surfaces.
template <std::floating_point T>
using OrenNayarRowT = Scene<Shapes<QuadT<T>, SphereT<T>, TriangleT<T>>,
                            Materials<LambertianT<T>, OrenNayarT<T>>>;

/// The ball at a place of a row, touching the report's floor.
/// \param place  0 to 3, from the left.
/// \return The ball.
template <std::floating_point T = float>
[[nodiscard]] constexpr SphereT<T> ball_of_row(int place) noexcept {
    const T radius = T(1.25);
    return {.center{T(6), T(4.2) - T(2.8) * T(place), T(-5) + radius},
            .radius = radius};
}

/// Glass, rough, mirror, matt: from the left. The matt ball has the rough one's colour.
/// \return The scene and its camera.
/// \report{Figure 4}
template <std::floating_point T = float>
[[nodiscard]] Room<MaterialRowT<T>> material_row() {
    Room<MaterialRowT<T>> room{.camera = report_camera<T>()};
    auto& scene = room.scene;
    add_report_room(scene);
    const RgbT<T> color{T(0.75), T(0.5), T(0.2)};
    scene.add(ball_of_row<T>(0), scene.add(GlassT<T>{.index = T(1.5)}));
    scene.add(ball_of_row<T>(1),
              scene.add(OrenNayarT<T>{.albedo = color, .sigma = T(0.7)}));
    scene.add(ball_of_row<T>(2),
              scene.add(MirrorT<T>{.reflectance = RgbT<T>{T(0.98)}}));
    scene.add(ball_of_row<T>(3), scene.add(LambertianT<T>{.albedo = color}));
    detail::add_ceiling_lamp(scene, T(5), T(-1), T(2), RgbT<T>{T(1)});
    return room;
}

/// The roughnesses of oren_nayar_row(), in radians: all that the model is made for.
/// \erratum{The report shows 0, 1, 10 and 100; the last two are one picture.}
template <std::floating_point T>
inline constexpr std::array<T, 4> oren_nayar_sigmas{T(0), T(0.25), T(0.5),
                                                    std::numbers::pi_v<T> / T(4)};

/// Rougher and rougher from the left, of the pale green of the report's balls. The lamp
/// hangs above the camera: seen from where the light comes from, a rough ball is as
/// bright at its edge as in its middle.
/// \return The scene and its camera.
/// \report{Figure 14}
template <std::floating_point T = float>
[[nodiscard]] Room<OrenNayarRowT<T>> oren_nayar_row() {
    Room<OrenNayarRowT<T>> room{.camera = report_camera<T>()};
    auto& scene = room.scene;
    add_report_room(scene);
    for (int i = 0; i < 4; ++i)
        scene.add(ball_of_row<T>(i),
                  scene.add(OrenNayarT<T>{
                      .albedo = T(0.75) * RgbT<T>{T(0.5), T(1), T(0.35)},
                      .sigma = oren_nayar_sigmas<T>[static_cast<std::size_t>(i)]}));
    scene.add(QuadT<T>{.corner{T(-8), T(-1.5), T(0.5)},
                       .edge_u{T(0), T(3), T(0)},
                       .edge_v{T(0), T(0), T(3)}},
              scene.add(LambertianT<T>{.albedo = RgbT<T>{T(0)}}), RgbT<T>{T(30)});
    return room;
}

/// \}

} // namespace ljus
