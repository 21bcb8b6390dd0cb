#pragma once

/// \file chapters/drawings/lobes.hpp
/// \brief How bright a surface is, seen from each side: a curve around a point of it.

#include <cmath>
#include <numbers>
#include <vector>

#include "common/drawing.hpp"
#include "ljus/math/vector.hpp"

namespace examples {

/// A direction in the plane of x and z, the normal.
/// \param degrees  From the normal, to the right.
[[nodiscard]] inline ljus::Vec3T<double> tilted(double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return {std::sin(a), 0, std::cos(a)};
}

/// pi f as the distance from the point, for all directions above the surface; a white
/// Lambertian surface has the distance 1.
/// \param material  With evaluate() in double.
/// \param light     Where the light comes from, in degrees from the normal.
template <typename Material>
[[nodiscard]] std::vector<Point> lobe(const Material& material, double light) {
    std::vector<Point> points;
    for (int angle = -89; angle <= 89; ++angle) {
        const ljus::Vec3T<double> wo = tilted(angle);
        const double r = std::numbers::pi * evaluate(material, wo, tilted(light)).x;
        points.push_back({r * wo.x, r * wo.z});
    }
    return points;
}

} // namespace examples
