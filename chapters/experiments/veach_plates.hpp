#pragma once

/// \file chapters/experiments/veach_plates.hpp
/// \brief The scene of Veach and Guibas: glossy plates that mirror lamps of all sizes.

#include <array>

#include "ljus/geometry/quad.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/materials/glossy.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/scene.hpp"
#include "ljus/scenes/room.hpp"

namespace examples {

/// Of the four plates, from nearly a mirror to satin.
constexpr std::array plate_roughness{0.07f, 0.14f, 0.22f, 0.32f};
/// Of the four lamps, from a point nearly to a ball.
constexpr std::array lamp_radius{0.0333f, 0.1f, 0.3f, 0.9f};

/// Four plates and four lamps of the same power. Each plate mirrors the lamps to the
/// eye.
/// \param roughness  Of the plates, from the back to the front.
/// \return The scene and its camera.
inline auto veach_plates(const std::array<float, 4>& roughness = plate_roughness) {
    using ljus::Quad, ljus::Rgb, ljus::Sphere, ljus::Vec3;
    ljus::Scene<ljus::Shapes<Quad, Sphere>,
                ljus::Materials<ljus::Lambertian, ljus::Glossy>>
        scene;
    const Vec3 eye{0, 2, 15}, x{1, 0, 0};
    const std::array middles{Vec3{0, -2.4f, -0.1f}, Vec3{0, -3.06f, 0.9f},
                             Vec3{0, -3.6f, 2.2f}, Vec3{0, -3.9f, 3.6f}};
    for (std::size_t i = 0; i < 4; ++i) {
        const auto gloss = scene.add(
            ljus::Glossy{.reflectance = Rgb{0.6f}, .roughness = roughness[i]});
        const Vec3 normal =
            normalize(normalize(eye - middles[i]) + normalize(-middles[i]));
        const Vec3 v = cross(normal, x);
        scene.add(Quad{middles[i] - 4.0f * x - 0.5f * v, 8.0f * x, v}, gloss);
    }
    const auto black = scene.add(ljus::Lambertian{.albedo = Rgb{0}});
    const std::array colors{Rgb{1, 0.75f, 0.5f}, Rgb{1, 0.95f, 0.6f},
                            Rgb{0.6f, 1, 0.7f}, Rgb{0.6f, 0.7f, 1}};
    for (std::size_t i = 0; i < 4; ++i) {
        const float r = lamp_radius[i];
        scene.add(Sphere{{2.5f * float(i) - 3.75f, 0, 0}, r}, black,
                  colors[i] / (r * r));
    }
    const auto wall = scene.add(ljus::Lambertian{.albedo = Rgb{0.3f}});
    scene.add(Quad{{-10, -4.2f, 10}, {20, 0, 0}, {0, 0, -12}}, wall);
    scene.add(Quad{{-10, -4.2f, -2}, {20, 0, 0}, {0, 12, 0}}, wall);
    return ljus::Room{
        ljus::World(std::move(scene)),
        look_at(
            ljus::View{.position = eye, .target{0, -1.8f, 2.5f}, .vfov_degrees = 26})};
}

} // namespace examples
