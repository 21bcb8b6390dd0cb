#pragma once

/// \file support/slabs.hpp
/// \brief Parallel slabs before a lamp: their transmittance in closed form, and as the
/// path tracer sees it.

#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "ljus/geometry/quad.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/render/path_tracing.hpp"
#include "support/closed_forms.hpp"
#include "support/mean.hpp"

namespace ljus_test {

/// A rectangle in a plane of constant z, around the z axis; it faces up or down.
template <typename T>
ljus::QuadT<T> face(T z, bool up, T half = T(50)) {
    const ljus::Vec3T<T> x{2 * half, 0, 0}, y{0, 2 * half, 0}, corner{-half, -half, z};
    return up ? ljus::QuadT<T>{corner, x, y} : ljus::QuadT<T>{corner, y, x};
}

/// A ray to the origin from 5 above it, at an angle to the z axis.
template <typename T>
ljus::RayT<T> ray_at(double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    const ljus::Vec3T<T> way{T(std::sin(a)), T(0), T(-std::cos(a))};
    return {.origin = T(-5 / std::cos(a)) * way, .direction = way};
}

/// Fresnel's reflectance between two indices, for a ray that has an angle in air.
inline double reflectance(double n1, double n2, double degrees) {
    const double s = std::sin(degrees * std::numbers::pi / 180) / n1;
    return fresnel_share(std::sqrt(1 - s * s), n1, n2);
}

/// The transmittance of a stack of layers, from air into air, with all reflections.
/// Layer by layer, from the far side: what is known of the stack behind a boundary is
/// its reflectance R and its transmittance T.
/// \param absorbed  The optical thickness of each layer, straight through; empty: 0.
inline double transmittance_of(const std::vector<double>& indices, double degrees,
                               const std::vector<double>& absorbed = {}) {
    double r = 0, t = 1;
    for (std::size_t i = indices.size(); i-- > 1;) {
        const double f = reflectance(indices[i - 1], indices[i], degrees);
        const double inner = 1 - f * r;
        t = (1 - f) * t / inner;
        r = f + (1 - f) * (1 - f) * r / inner;
        if (i == 1 || absorbed.empty()) continue;
        const double s = std::sin(degrees * std::numbers::pi / 180) / indices[i - 1];
        const double a = std::exp(-absorbed[i - 1] / std::sqrt(1 - s * s));
        t *= a;
        r *= a * a;
    }
    return t;
}

/// What a ray sees of a lamp of radiance 1 behind bodies.
/// \param scene  The bodies; gets the lamp.
template <typename T, typename S>
Mean seen_through_scene(S scene, double degrees, long long paths = 20000) {
    scene.add(face(T(-5), true, T(500)),
              scene.add(ljus::LambertianT<T>{ljus::RgbT<T>{0}}), ljus::RgbT<T>{1});
    const ljus::World world(std::move(scene));
    const ljus::PathTracer tracer(world, {.roulette_depth = 1000});
    return mean_radiance(tracer, paths, 7,
                         [&](const auto&) { return ray_at<T>(degrees); });
}

} // namespace ljus_test
