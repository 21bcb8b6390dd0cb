#pragma once

/// \file answer.hpp
/// \brief Assignment 3: a solution, for those who keep the course.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "given.hpp"

namespace answer {

inline constexpr float pi = std::numbers::pi_v<float>;

inline Estimate estimate(const std::vector<double>& samples) {
    const auto n = static_cast<double>(samples.size());
    double sum = 0, squares = 0;
    for (const double x : samples) sum += x;
    for (const double x : samples) squares += (x - sum / n) * (x - sum / n);
    return {.mean = sum / n, .error = std::sqrt(squares / (n - 1) / n)};
}

inline Vec2 sample_disc(Vec2 u) {
    const float r = std::sqrt(u.x);
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y)};
}

/// Uniform within a cone around +z: by Archimedes z is uniform.
inline Vec3 sample_cap(float cosine, Vec2 u) {
    const float z = 1 - u.x * (1 - cosine);
    const float r = std::sqrt(std::max(0.0f, 1 - z * z));
    return {r * std::cos(2 * pi * u.y), r * std::sin(2 * pi * u.y), z};
}

inline Vec3 sample_uniform(Vec2 u) {
    return sample_cap(0, u);
}
inline float pdf_uniform(const Vec3& direction) {
    return direction.z > 0 ? 1 / (2 * pi) : 0;
}

inline Vec3 sample_cosine(Vec2 u) {
    const Vec2 p = sample_disc(u);
    return {p.x, p.y, std::sqrt(std::max(1e-7f, 1 - dot(p, p)))};
}
inline float pdf_cosine(const Vec3& direction) {
    return std::max(0.0f, direction.z / pi);
}

inline Vec3 sample_cone(const Cone& cone, Vec2 u) {
    return around(cone.axis, sample_cap(cone.cosine, u));
}
inline float pdf_cone(const Cone& cone, const Vec3& direction) {
    if (dot(direction, cone.axis) < cone.cosine) return 0;
    return 1 / (2 * pi * (1 - cone.cosine));
}

inline double irradiance_uniform(const Sky& sky, Vec2 u) {
    const Vec3 d = sample_uniform(u);
    return sky(d) * double(d.z / pdf_uniform(d));
}
inline double irradiance_cosine(const Sky& sky, Vec2 u) {
    const Vec3 d = sample_cosine(u);
    return sky(d) * double(d.z / pdf_cosine(d));
}
inline double irradiance_cone(const Sky& sky, const Cone& cone, Vec2 u) {
    const Vec3 d = sample_cone(cone, u);
    const float density = 1 / (2 * pi * (1 - cone.cosine));
    return sky(d) * double(std::max(0.0f, d.z) / density);
}

inline double balance(double a, double b) {
    return a / (a + b);
}

inline double irradiance_both(const Sky& sky, const Cone& cone, Vec2 u_cosine,
                              Vec2 u_cone) {
    const Vec3 d = sample_cosine(u_cosine);
    const Vec3 e = sample_cone(cone, u_cone);
    const double from_cosine =
        irradiance_cosine(sky, u_cosine) *
        balance(double(pdf_cosine(d)), double(pdf_cone(cone, d)));
    const double cone_density = 1 / (2 * double(pi) * (1 - double(cone.cosine)));
    const double from_cone = irradiance_cone(sky, cone, u_cone) *
                             balance(cone_density, double(pdf_cosine(e)));
    return from_cosine + from_cone;
}

inline std::vector<Vec2> stratified(int n, RandomStream& stream) {
    std::vector<Vec2> points;
    for (int y = 0; y < n; ++y)
        for (int x = 0; x < n; ++x)
            points.push_back((Vec2{float(x), float(y)} + next_2d(stream)) / float(n));
    return points;
}

inline double roulette(double value, double chance, double u) {
    return u < chance ? value / chance : 0;
}

} // namespace answer
