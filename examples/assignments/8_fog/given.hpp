#pragma once

/// \file given.hpp
/// \brief Given in assignment 8: fog, a lamp with a ball in front of it, and a ball of
/// fog.

#include <cmath>
#include <limits>
#include <optional>

#include "ljus/math/random.hpp"
#include "ljus/math/vector.hpp"

namespace answer {

using ljus::RandomStream, ljus::next_1d; // uniform in [0, 1)
using Vec3 = ljus::Vec3T<double>;

inline constexpr double pi = 3.14159265358979;

/// A ray. Its point at the distance t is origin + t * direction.
struct Ray {
    Vec3 origin{0};
    Vec3 direction{0, 0, 1}; ///< Of length 1.
};

/// Homogeneous fog, whose droplets absorb and scatter light.
struct Fog {
    double absorption = 0; ///< sigma_a, per unit of length.
    double scattering = 1; ///< sigma_s, per unit of length.
    double g = 0;          ///< Mean cosine of the scattering angle.
    double glow = 0;       ///< Radiance that each unit of length adds.
    double extinction() const { return absorption + scattering; } ///< sigma_t
};

/// A small lamp in fog, and a black ball that casts a shadow through the fog.
struct Night {
    Fog fog;
    Vec3 lamp{0};
    double intensity = 1; ///< W/sr, the same in every direction.
    Vec3 ball{0};
    double radius = 0; ///< Radius of the ball; 0: no ball.

    /// Whether a point sees the lamp past the ball.
    bool sees_lamp(const Vec3& point) const {
        const Vec3 to = lamp - point;
        const double t = dot(ball - point, to) / dot(to, to);
        if (!(t > 0 && t < 1)) return true;
        return length(point + t * to - ball) >= radius;
    }
};

/// The distance along a ray from a point inside a ball around the origin to the surface
/// of the ball.
inline double way_out(const Ray& ray, double radius) {
    const double b = dot(ray.origin, ray.direction);
    return -b + std::sqrt(b * b + radius * radius - dot(ray.origin, ray.origin));
}

/// A unit vector that is perpendicular to a given one.
inline Vec3 perpendicular(const Vec3& v) {
    const Vec3 other = std::abs(v.x) < 0.5 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    return normalize(cross(v, other));
}

} // namespace answer
