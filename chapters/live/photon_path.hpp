#pragma once

/// \file photon_path.hpp
/// \brief What the live figures of chapters 22 and 26 share: the path of a photon of
/// Flatland, for the page.

#include <vector>

#include "flatland/photon_map.hpp"

namespace live {

/// Of the photon that was followed last: x, y of each vertex.
inline std::vector<float> last_path;

/// Follows a photon as `trace_photon()` does, and keeps its path.
template <class Visit>
void follow_photon(const flatland::Scene& scene, const flatland::PathState& photon,
                   ljus::RandomStream& stream, int most, Visit visit) {
    const auto keep = [](flatland::Vec2 at) {
        last_path.insert(last_path.end(), {float(at.x), float(at.y)});
    };
    last_path.clear();
    keep(photon.ray.origin);
    trace_photon(scene, photon, stream, most,
                 [&](const flatland::PathState& state, const flatland::Vertex& vertex) {
                     keep(vertex.point.position);
                     visit(state, vertex);
                 });
}

} // namespace live

extern "C" {

[[gnu::used]] inline const float* path() {
    return live::last_path.data();
}
[[gnu::used]] inline int path_size() {
    return int(live::last_path.size() / 2);
}

} // extern "C"
