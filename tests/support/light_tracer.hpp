#pragma once

/// \file support/light_tracer.hpp
/// \brief An oracle that shares no step with the renderers: particles walk from the
/// lights, and each matt surface they meet is joined to the pinhole.

#include <numbers>
#include <random>

#include "ljus/image/image.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/scene/camera.hpp"
#include "ljus/scene/query.hpp"

namespace ljus_test {

/// Which pixels see, wholly and with their neighbours, surfaces without a specular part
/// first.
template <typename Scene, std::floating_point T>
std::vector<bool> matt_pixels(const Scene& scene, const ljus::CameraT<T>& camera,
                              int width, int height) {
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

/// The picture of all paths E D ... L, the first surface matt: light that mirrors and
/// glass throw on it included, lamps themselves not.
///
/// A pixel is the mean of L over its area on the film at distance 1, of which a solid
/// angle d omega covers d omega / cos^3. A surface element dA at distance d covers
/// d omega = cos_x dA / d^2, and L dA = sum of f dPhi.
/// \param particles  How many leave the lights.
template <typename Scene, std::floating_point T>
ljus::ImageT<double> trace_light(const Scene& scene, const ljus::CameraT<T>& camera,
                                 int width, int height, long long particles,
                                 std::uint64_t seed) {
    using namespace ljus;
    constexpr double pi = std::numbers::pi;
    std::mt19937_64 engine(seed);
    const auto uniform = [&] { return double(engine() >> 11) * 0x1p-53; };
    const auto uniform3 = [&] {
        const T x = T(uniform()), y = T(uniform());
        return Vec3T<T>{std::min(x, T(1) - T(1e-7)), std::min(y, T(1) - T(1e-7)),
                        std::min(T(uniform()), T(1) - T(1e-7))};
    };
    // A direction around an axis, uniform over the sphere or with density cos/pi.
    const auto direction_around = [&](const Vec3T<T>& axis, bool lambert) {
        const double z = lambert ? std::sqrt(uniform()) : 2 * uniform() - 1;
        const double phi = 2 * pi * uniform(), r = std::sqrt(1 - z * z);
        const glm::dvec3 n(axis);
        const glm::dvec3 help =
            std::abs(n.x) < 0.5 ? glm::dvec3{1, 0, 0} : glm::dvec3{0, 1, 0};
        const glm::dvec3 s = glm::normalize(glm::cross(n, help));
        const glm::dvec3 t = glm::cross(n, s);
        return Vec3T<T>(z * n + r * (std::cos(phi) * s + std::sin(phi) * t));
    };
    const double half = double(camera.half_height);
    const double pixel_area = 4 * half * half / (double(height) * height);
    auto image = make_image<double>(width, height);

    for (long long particle = 0; particle < particles; ++particle) {
        // Each light gets the same number of particles.
        const auto count = scene.lights.size();
        const auto& light = scene.lights[static_cast<std::size_t>(particle) % count];
        glm::dvec3 flux(0);
        RayT<T> ray;
        const double share = double(count) / double(particles);
        if (light.object) {
            const auto u = uniform3();
            SurfacePointT<T> point =
                scene.visit_shape(*light.object, [&](const auto& shape) {
                    return sample_area(shape, {u.x, u.y});
                });
            const double size = scene.visit_shape(
                *light.object, [&](const auto& shape) { return double(area(shape)); });
            if (scene.object(*light.object).inside_out) point.normal = -point.normal;
            flux = pi * size * share * glm::dvec3(light.emission);
            ray = spawn_ray(point, direction_around(point.normal, true));
        } else {
            flux = 4 * pi * share * glm::dvec3(light.emission);
            ray = {.origin = light.position,
                   .direction = direction_around({T(0), T(0), T(1)}, false)};
        }

        RgbT<T> medium{T(0)};
        for (int bounce = 0; bounce < 500; ++bounce) {
            const auto hit = closest_hit(scene, ray);
            if (!hit) break;
            const auto at = vertex_at(scene, ray, *hit);
            flux *= glm::exp(-glm::dvec3(medium) * double(hit->at.t));
            const Vec3T<T> from = to_local(at.frame, -ray.direction);

            const glm::dvec3 way =
                glm::dvec3(camera.position) - glm::dvec3(at.point.position);
            const double d = glm::length(way);
            const double cos_film = -glm::dot(way, glm::dvec3(camera.forward)) / d;
            const double px =
                double(width) / 2 - glm::dot(way, glm::dvec3(camera.right)) /
                                        (d * cos_film) / (2 * half) * height;
            const double py =
                double(height) / 2 + glm::dot(way, glm::dvec3(camera.up)) /
                                         (d * cos_film) / (2 * half) * height;
            const bool on_film =
                cos_film > 0 && px >= 0 && px < width && py >= 0 && py < height;

            bool goes_on = false;
            scene.visit_material(at.object.material, [&](const auto& material) {
                const Vec3T<T> to_camera = to_local(at.frame, Vec3T<T>(way / d));
                const glm::dvec3 f(evaluate(material, to_camera, from));
                if (on_film && f != glm::dvec3(0)) {
                    const SurfacePointT<T> pinhole{.position = camera.position};
                    const Vec3T<T> start = offset_ray_origin(at.point, Vec3T<T>(way));
                    const RayT<T> shadow{.origin = start,
                                         .direction = pinhole.position - start,
                                         .t_max = T(1)};
                    if (!occluded(scene, shadow))
                        pixel(image, int(px), int(py)) +=
                            flux * f * std::abs(double(to_camera.z)) /
                            (d * d * cos_film * cos_film * cos_film * pixel_area);
                }
                const auto next = sample(material, from, uniform3(), Transport::flux);
                if (!next) return;
                flux *= glm::dvec3(next->weight);
                if (from.z * next->wi.z < T(0))
                    medium = next->wi.z < T(0) ? RgbT<T>(absorption(material))
                                               : RgbT<T>{T(0)};
                ray = spawn_ray(at.point, to_world(at.frame, next->wi));
                goes_on = true;
            });
            if (!goes_on) break;
            if (bounce >= 3) { // every fourth dies
                if (uniform() < 0.25) break;
                flux /= 0.75;
            }
        }
    }
    return image;
}

} // namespace ljus_test
