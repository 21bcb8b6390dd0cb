#pragma once

/// \file support/light_tracer.hpp
/// \brief A reference renderer that shares no code with the others. Particles start at
/// the lights, and each matt surface that a particle hits is connected to the pinhole
/// of the camera.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>

#include "ljus/image/image.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/world.hpp"

namespace ljus_test {

/// The pixels whose first surfaces, and those of their neighbours, have no specular
/// part.
template <ljus::AnyWorld W, std::floating_point T>
std::vector<bool> matt_pixels(const W& scene, const ljus::CameraT<T>& camera, int width,
                              int height) {
    const auto matt = [&](T x, T y) {
        const auto hit = closest_hit(
            scene, primary_ray(camera, ljus::Vec2T<T>{x, y}, width, height));
        if (!hit) return false;
        return scene.visit_material(
            scene.object(hit->object).material,
            [](const auto& m) { return lobes(m) == ljus::Lobes::diffuse; });
    };
    std::vector<bool> all;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            bool good = true;
            for (int i = -4; i <= 8 && good; ++i)
                for (int j = -4; j <= 8 && good; ++j)
                    good = matt(T(x) + T(i) / 4, T(y) + T(j) / 4);
            all.push_back(good);
        }
    return all;
}

/// Random numbers that are independent of the library.
struct Uniform {
    std::mt19937_64 engine;

    double next() { return double(engine() >> 11) * 0x1p-53; }

    template <typename T>
    ljus::Vec3T<T> cube() {
        const T last = T(1) - T(1e-7);
        const T x = T(next()), y = T(next());
        return {std::min(x, last), std::min(y, last), std::min(T(next()), last)};
    }

    /// A direction, uniform over the sphere, or with density cos/pi around an axis.
    template <typename T>
    ljus::Vec3T<T> direction_around(const ljus::Vec3T<T>& axis, bool lambert) {
        const double z = lambert ? std::sqrt(next()) : 2 * next() - 1;
        const double phi = 2 * std::numbers::pi * next(), r = std::sqrt(1 - z * z);
        const glm::dvec3 n(axis);
        const glm::dvec3 help =
            std::abs(n.x) < 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
        const glm::dvec3 s = glm::normalize(glm::cross(n, help));
        const glm::dvec3 t = glm::cross(n, s);
        return ljus::Vec3T<T>(z * n + r * (std::cos(phi) * s + std::sin(phi) * t));
    }
};

/// A particle on its path.
template <std::floating_point T>
struct Particle {
    ljus::RayT<T> ray{};
    glm::dvec3 flux{0};
    ljus::RgbT<T> medium{T(0)}; ///< Absorption of the medium around the particle.
};

/// A particle from a point light, with a fraction of its flux.
template <std::floating_point T>
Particle<T> leave(const ljus::PointLightT<T>& light, double share, Uniform& uniform) {
    return {{.origin = light.position,
             .direction =
                 uniform.direction_around(ljus::Vec3T<T>{T(0), T(0), T(1)}, false)},
            4 * std::numbers::pi * share * glm::dvec3(light.intensity)};
}
/// A particle from a lamp, with a fraction of its flux.
template <typename S, std::floating_point T = ljus::ScalarOf<S>>
Particle<T> leave(const ljus::AreaLightT<S>& light, double share, Uniform& uniform) {
    const ljus::Vec3T<T> u = uniform.cube<T>();
    ljus::SurfacePointT<T> point = sample_area(light.shape, {u.x, u.y});
    if (light.lamp.inside_out) point.normal = -point.normal;
    return {spawn_ray(point, uniform.direction_around(point.normal, true)),
            std::numbers::pi * double(area(light.shape)) * share *
                glm::dvec3(light.lamp.radiance)};
}

/// The pixel in which a point appears, and the area that a pixel covers there.
struct FilmPlace {
    int x = 0, y = 0;
    double area = 0; ///< Area perpendicular to the direction of the pinhole.
};

/// The pixel of the point at the vector `way` from the pinhole; nothing outside the
/// picture.
///
/// On the film at distance 1 a solid angle d omega covers the area d omega / cos^3.
template <std::floating_point T>
std::optional<FilmPlace> place_on_film(const ljus::CameraT<T>& camera, int width,
                                       int height, const glm::dvec3& way) {
    const double half = double(camera.half_height);
    const double pixel_area = 4 * half * half / (double(height) * height);
    const double d = glm::length(way);
    const double cos_film = -glm::dot(way, glm::dvec3(camera.forward)) / d;
    const double x = double(width) / 2 - glm::dot(way, glm::dvec3(camera.right)) /
                                             (d * cos_film) / (2 * half) * height;
    const double y = double(height) / 2 + glm::dot(way, glm::dvec3(camera.up)) /
                                              (d * cos_film) / (2 * half) * height;
    if (!(cos_film > 0 && x >= 0 && x < width && y >= 0 && y < height))
        return std::nullopt;
    return FilmPlace{int(x), int(y),
                     d * d * cos_film * cos_film * cos_film * pixel_area};
}

/// The picture of all paths E D ... L, whose first surface is matt. It includes light
/// that reaches this surface by mirrors and glass, but not lamps that the eye sees.
///
/// A pixel is the mean of the radiance L over its area. A surface element dA at
/// distance d covers the solid angle d omega = cos_x dA / d^2. L dA is the sum of f
/// dPhi, with the BSDF f and the flux dPhi of each particle.
/// \param particles  Number of particles.
template <ljus::AnyWorld W, std::floating_point T>
ljus::ImageT<double> trace_light(const W& scene, const ljus::CameraT<T>& camera,
                                 int width, int height, long long particles,
                                 std::uint64_t seed) {
    using namespace ljus;
    Uniform uniform{std::mt19937_64(seed)};
    auto image = make_image<double>(width, height);

    // Adds the light that a surface reflects to the pinhole, of a particle from `from`.
    const auto join = [&](const auto& at, const auto& material, const Vec3T<T>& from,
                          const glm::dvec3& flux) {
        const glm::dvec3 way =
            glm::dvec3(camera.position) - glm::dvec3(at.point.position);
        const auto place = place_on_film(camera, width, height, way);
        if (!place) return;
        const Vec3T<T> to_camera = to_local(at.frame, Vec3T<T>(way / glm::length(way)));
        const glm::dvec3 f(evaluate(material, to_camera, from));
        if (f == glm::dvec3(0)) return;
        const Vec3T<T> start = offset_ray_origin(at.point, Vec3T<T>(way));
        const RayT<T> shadow{
            .origin = start, .direction = camera.position - start, .t_max = T(1)};
        if (!occluded(scene, shadow))
            pixel(image, place->x, place->y) +=
                flux * f * std::abs(double(to_camera.z)) / place->area;
    };
    // Scatters a particle; returns false if it is absorbed.
    const auto scatter = [&](const auto& at, const auto& material, const Vec3T<T>& from,
                             Particle<T>& particle) {
        const auto next = sample(material, from, uniform.cube<T>(), Transport::flux);
        if (!next) return false;
        particle.flux *= glm::dvec3(next->weight);
        if (from.z * next->wi.z < T(0))
            particle.medium =
                next->wi.z < T(0) ? RgbT<T>(absorption(material)) : RgbT<T>{T(0)};
        particle.ray = spawn_ray(at.point, to_world(at.frame, next->wi));
        return true;
    };

    const std::size_t lights = scene.light_count();
    for (long long number = 0; number < particles; ++number) {
        // Each light gets the same number of particles.
        Particle<T> particle = scene.visit_light(
            static_cast<std::uint32_t>(static_cast<std::size_t>(number) % lights),
            [&](const auto& light) {
                return leave(light, double(lights) / double(particles), uniform);
            });
        for (int bounce = 0; bounce < 500; ++bounce) {
            const auto hit = closest_hit(scene, particle.ray);
            if (!hit) break;
            const auto at = vertex_at(scene, particle.ray, *hit);
            particle.flux *= glm::exp(-glm::dvec3(particle.medium) * double(hit->at.t));
            const Vec3T<T> from = to_local(at.frame, -particle.ray.direction);
            const bool goes_on =
                scene.visit_material(at.object.material, [&](const auto& material) {
                    join(at, material, from, particle.flux);
                    return scatter(at, material, from, particle);
                });
            if (!goes_on) break;
            if (bounce >= 3) { // roulette: a quarter ends
                if (uniform.next() < 0.25) break;
                particle.flux /= 0.75;
            }
        }
    }
    return image;
}

} // namespace ljus_test
