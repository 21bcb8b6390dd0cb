#pragma once

/// \file ball_over_floor.hpp
/// \brief What two live figures share: the caustic of chapter 25 under a ball of glass,
/// seen from above, by photons aimed at the ball.

#include <cmath>
#include <cstdint>
#include <vector>

#include "experiments/white_floor.hpp"
#include "experiments/window.hpp"
#include "ljus/geometry/sphere.hpp"
#include "ljus/lights/point_light.hpp"
#include "ljus/materials/glass.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/scene/world.hpp"

namespace live {

using Stage = ljus::Scene<ljus::Shapes<ljus::Sphere, ljus::Quad>,
                          ljus::Materials<ljus::Lambertian, ljus::Glass>,
                          ljus::Lights<ljus::PointLight>>;

/// The scene of `examples/25_density_estimate.cpp`.
inline ljus::World<Stage> ball_over_floor() {
    Stage stage;
    examples::add_floor(stage, 0);
    stage.add(ljus::Sphere{.center{0, 0.6f, 0}, .radius = 0.5f},
              stage.add(ljus::Glass{.index = 1.5f}));
    stage.add(ljus::PointLight{.position{0, 2.6f, 0}});
    return ljus::World(std::move(stage));
}

constexpr float half_width = 0.2f; ///< Of the floor that is seen.
constexpr int cells = 72;          ///< Of the picture of its light, along a side.
constexpr int rings = 60;          ///< Around the middle, out to the half width.

/// The middle of a cell along one side.
constexpr float cell_middle(int i) {
    return half_width * (2 * (float(i) + 0.5f) / cells - 1);
}

/// The irradiance by photons in the cells, row by row.
inline std::vector<float> picture_by(const ljus::PhotonMap& map, float radius) {
    std::vector<float> picture;
    for (int row = 0; row < cells; ++row)
        for (int column = 0; column < cells; ++column)
            picture.push_back(float(examples::irradiance_read(
                map, {cell_middle(column), 0, cell_middle(row)}, {0, 1, 0},
                {.radius = radius})));
    return picture;
}

/// Photons counted in rings around the middle: the light of the same caustic without
/// the blur of a disc.
struct Rings {
    long long sent = 0;                                         ///< Photons.
    std::vector<double> flux = std::vector<double>(rings, 0.0); ///< In W.

    /// Counts photons of one pass.
    void count(const ljus::World<Stage>& world, int photons) {
        const ljus::PhotonPassSettings pass{
            .photons = photons, .seed = 1000 + std::uint64_t(sent), .threads = 1};
        for (const auto& photon :
             trace_photons(world, ljus::MapType::caustics, pass, 0, photons).photons) {
            const float part = glm::length(photon.position) / half_width * rings;
            if (part < rings)
                flux[std::size_t(part)] += double(photon.flux.x) * photons;
        }
        sent += photons;
    }
    /// The irradiance in a ring, W/m^2.
    [[nodiscard]] double irradiance(int ring) const {
        const double step = double(half_width) / rings;
        const double area = 3.141592653589793 * step * step * (2 * ring + 1);
        return sent > 0 ? flux[std::size_t(ring)] / double(sent) / area : 0;
    }
};

/// What both figures show of the floor. The one of a figure is its `floor_shown()`.
struct Floor {
    ljus::World<Stage> world = ball_over_floor();
    std::vector<float> dots; ///< x and z of photons.
    Rings rings;

    /// Adds photons to the dots.
    void show(const std::vector<ljus::Photon>& photons) {
        for (const ljus::Photon& photon : photons)
            dots.insert(dots.end(), {photon.position.x, photon.position.z});
    }
};
Floor& floor_shown();

} // namespace live

extern "C" {

[[gnu::used]] inline double width() {
    return 2 * double(live::half_width);
}
[[gnu::used]] inline int picture_size() {
    return live::cells;
}
[[gnu::used]] inline const float* dots() {
    return live::floor_shown().dots.data();
}

/// Counts more photons in rings, and returns how many so far.
[[gnu::used]] inline double count_reference(int photons) {
    live::Floor& floor = live::floor_shown();
    if (photons > 0) floor.rings.count(floor.world, photons);
    return double(floor.rings.sent);
}
[[gnu::used]] inline int reference_size() {
    return live::rings;
}
[[gnu::used]] inline double reference(int ring) {
    return live::floor_shown().rings.irradiance(ring);
}

/// Photons in float; a last digit of a sine moves each of them a little.
[[gnu::used]] inline double tolerance() {
    return 1e-4;
}

} // extern "C"
