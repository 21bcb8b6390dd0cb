#pragma once

/// \file ljus/render/detail/gather_along.hpp
/// \brief Where along a camera ray irradiance is gathered for the cache.

#include <vector>

#include "ljus/render/final_gathering.hpp"

namespace ljus::detail {

/// \addtogroup irradiance_cache
/// \{

/// What the points behind one row of tiles have gathered.
template <std::floating_point T>
struct GatheredRowT {
    std::vector<Vec3T<T>> positions;   ///< Where, in the world.
    std::vector<GatheredT<T>> records; ///< What was gathered there, in the same order.
    Counts counts{};                   ///< What it cost.
};

/// Gathers at the first diffuse surfaces of a camera ray, the points of an irradiance
/// cache \cite ward1988 ; behind mirrors, and both ways at glass.
/// \param scene     The scene.
/// \param points    What gather rays look up.
/// \param ray       A primary ray.
/// \param settings  How.
/// \param stream    Its numbers.
/// \param row       Takes what is gathered.
template <SceneLike S, std::floating_point T>
void gather_along(const S& scene, const IrradiancePointsT<T>& points,
                  const RayT<T>& ray, const GatherSettings& settings,
                  RandomStream& stream, GatheredRowT<T>& row) {
    constexpr std::size_t most = 8; // ways through glass, as many as are rendered
    constexpr T faint = T(0.01); // a fainter place is gathered if it is ever asked for
    std::vector<PathStateT<T>> ways{camera_path(scene, ray, stream)};
    for (std::size_t way = 0; way < ways.size(); ++way) {
        PathStateT<T> path = ways[way];
        while (path.depth < settings.max_depth) {
            const auto vertex = next_vertex(scene, path, stream);
            if (!vertex || max_component(path.throughput) < faint) break;
            const auto at_material = [&](const auto& material) {
                const Lobes parts = lobes(material);
                if (has(parts, Lobes::diffuse)) {
                    row.positions.push_back(vertex->point.position);
                    row.records.push_back(gather_irradiance(
                        scene, points, *vertex, settings, stream, row.counts));
                }
                if (ways.size() < most)
                    if (const auto other = split_path(path, *vertex, material)) {
                        ways.push_back(*other);
                        return true;
                    }
                return has(parts, Lobes::specular) &&
                       continue_path(path, *vertex, material, Transport::radiance,
                                     Lobes::specular, stream);
            };
            if (!visit_material_at(scene, *vertex, at_material)) break;
        }
    }
}

/// \}

} // namespace ljus::detail
