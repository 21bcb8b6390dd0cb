#pragma once

/// \file flatland/path_tracing.hpp
/// \brief A path tracer of the plane: the twin of every photon estimate.

#include "flatland/light.hpp"

namespace flatland {

// Eq. (1) with a dimension less.

/// The radiance that one random path finds. At a diffuse surface a shadow ray samples a
/// lamp; a lamp that the path hits counts only if no shadow ray could have found it.
/// \param scene      The scene.
/// \param ray        From the eye.
/// \param stream     The random numbers of this path.
/// \param max_depth  Surfaces on the path; 1 is emission and direct light.
/// \return Radiance, W/(m rad); its mean is that of the scene, up to the depth.
/// \report{Eq. (1)}
// [radiance]
[[nodiscard]] inline double radiance(const Scene& scene, const Ray& ray,
                                     RandomStream& stream, int max_depth = 1000) {
    PathState path{.ray = ray, .specular = true}; // the eye sees lamps
    double sum = 0;
    while (path.depth < max_depth) {
        const auto vertex = next_vertex(scene, path, stream);
        if (!vertex) break;
        if (path.specular && vertex->emits())
            sum += path.throughput * vertex->object.emission;
        sum += path.throughput * direct_light(scene, *vertex, next_2d<double>(stream));
        if (!continue_path(path, *vertex, Transport::radiance, stream)) break;
    }
    return sum;
}
// [radiance]

} // namespace flatland
