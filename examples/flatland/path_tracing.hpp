#pragma once

/// \file flatland/path_tracing.hpp
/// \brief A path tracer of the plane, the reference for photon estimates.

#include "flatland/light.hpp"

namespace flatland {

// Eq. (1) in two dimensions.

/// The radiance that one random path finds. At a diffuse surface a shadow ray samples a
/// lamp; a lamp that the path hits counts only if no shadow ray could have found it.
/// \param scene      The scene.
/// \param ray        A ray from the eye.
/// \param stream     The random numbers of this path.
/// \param max_depth  Largest number of surfaces on the path; 1: emission and direct
///                   light only.
/// \return Radiance, W/(m rad): an unbiased estimate of the light of all paths up to
///         max_depth.
/// \report{Eq. (1)}
// [radiance]
[[nodiscard]] inline double radiance(const Scene& scene, const Ray& ray,
                                     RandomStream& stream, int max_depth = 1000) {
    PathState path{.ray = ray, .specular = true}; // true, because the eye sees lamps
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
