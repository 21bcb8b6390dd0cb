#pragma once

/// \file chapters/experiments/window.hpp
/// \brief Caustic light that is known everywhere: a square of it, with a sharp edge.

#include <algorithm>
#include <cmath>

#include "ljus/geometry/quad.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/lambertian.hpp"
#include "ljus/materials/mirror.hpp"

namespace examples {

/// Adds a white floor of 18 x 18 around the y axis.
/// \param scene  A scene with quads and Lambert's surfaces.
/// \param y      Its height.
template <typename Scene>
void add_floor(Scene& scene, float y) {
    scene.add(ljus::Quad{.corner{-9, y, -9}, .edge_u{0, 0, 18}, .edge_v{18, 0, 0}},
              scene.add(ljus::Lambertian{.albedo = ljus::Rgb{1}}));
}

/// A square mirror above a point light above a floor: what it reflects ends at 2 from
/// the middle.
/// \tparam Scene  A scene with quads, Lambert's surfaces and mirrors.
template <typename Scene>
[[nodiscard]] Scene window_scene() {
    Scene scene;
    add_floor(scene, 0);
    scene.add(
        ljus::Quad{.corner{-0.5f, 1.5f, -0.5f}, .edge_u{1, 0, 0}, .edge_v{0, 0, 1}},
        scene.add(ljus::Mirror{.reflectance = ljus::Rgb{1}}));
    scene.add(ljus::PointLight{.position{0, 1, 0}});
    return scene;
}

/// The reflected light on the floor, W/m^2: the light's image is at height 2, and seen
/// through the mirror as through a window.
[[nodiscard]] inline double window_light(double x, double z) {
    if (std::max(std::abs(x), std::abs(z)) > 2) return 0;
    const double d2 = x * x + z * z + 4;
    return 2 / (d2 * std::sqrt(d2));
}

/// Where errors are measured, along x.
struct Strip {
    const char* name; ///< Where it lies.
    double first;     ///< Its left end.
    double last;      ///< Its right end.

    /// The middle of part i of equal parts.
    [[nodiscard]] constexpr double at(int i, int parts) const {
        return first + (last - first) * (i + 0.5) / parts;
    }
};
inline constexpr Strip middle{"middle", -0.5, 0.5}; ///< The light is smooth there.
inline constexpr Strip edge{"edge", 1.2, 2.8};      ///< Across the end of the light.

} // namespace examples
