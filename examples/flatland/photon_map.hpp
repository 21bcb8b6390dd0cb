#pragma once

/// \file flatland/photon_map.hpp
/// \brief Photons of the plane: how they travel, and where they are stored.

#include <utility>

#include "flatland/light.hpp"
#include "ljus/photons/photon.hpp"

namespace flatland {

using ljus::Pass, ljus::PhotonKind, ljus::require_at_least, ljus::require_positive;

// Sections 2.3 and 3.2.2 in two dimensions.

/// A photon at the point where it met a diffuse surface.
/// \report{Section 2.3}
struct Photon {
    Vec2 position{0};                     ///< Position, in metres.
    Vec2 direction{0};                    ///< Direction of travel, unit vector.
    Vec2 normal{0, 1};                    ///< Normal of the surface.
    double flux = 0;                      ///< Flux, W.
    PhotonKind kind = PhotonKind::direct; ///< Kind, by the surfaces met before.
};

/// The photons of a scene. Flatland has few photons, which are kept in a list and
/// searched one by one. For many photons there is the k-d tree of chapter 24.
using PhotonMap = std::vector<Photon>;

/// Settings of a photon pass.
struct PhotonPassSettings {
    int photons = 10000;    ///< Number of photons that the lamps emit.
    std::uint64_t seed = 1; ///< Seed of the random numbers.
    int max_bounces = 1000; ///< Largest number of surfaces on the path of a photon.
};

/// The kind of photon that a path would store at its vertex.
/// \param path  The path of a photon.
[[nodiscard]] inline PhotonKind kind_of(const PathState& path) noexcept {
    if (path.met_diffuse) return PhotonKind::indirect;
    return path.met_specular ? PhotonKind::caustic : PhotonKind::direct;
}

/// Follows one photon until it is absorbed or leaves the scene.
/// \param scene        The scene.
/// \param path         The emitted photon.
/// \param stream       The random numbers of the photon.
/// \param max_bounces  The largest number of surfaces on its path.
/// \param visit        Called with the path and the vertex at each surface.
// [trace_photon]
template <typename Visit>
void trace_photon(const Scene& scene, PathState path, RandomStream& stream,
                  int max_bounces, Visit&& visit) {
    while (path.depth < max_bounces) {
        const auto vertex = next_vertex(scene, path, stream);
        if (!vertex) return;
        visit(std::as_const(path), *vertex);
        if (!continue_path(path, *vertex, Transport::flux, stream)) return;
    }
}
// [trace_photon]

/// Stores a photon at the vertex of its path, if the surface is diffuse.
/// \param path    The path of the photon.
/// \param vertex  The vertex that the path has reached.
/// \param out     Receives the photon.
inline void store_photon(const PathState& path, const Vertex& vertex, PhotonMap& out) {
    if (!std::holds_alternative<Lambertian>(vertex.object.material)) return;
    out.push_back({vertex.point.position, path.ray.direction, vertex.point.normal,
                   path.throughput, kind_of(path)});
}

/// The random numbers of one photon. They do not depend on the number of photons.
/// \param pass   The settings, with the seed.
/// \param index  The number of the photon.
[[nodiscard]] constexpr RandomStream photon_stream(const PhotonPassSettings& pass,
                                                   int index) noexcept {
    return random_stream(pass.seed, Pass::general_photons, 0,
                         static_cast<std::uint64_t>(index));
}

/// Sends photons through a scene and stores them at every diffuse surface that they
/// hit.
/// \param scene  The scene.
/// \param pass   Number of photons, seed, longest path.
/// \return The photons, in the order of their paths.
/// \throws std::invalid_argument  if the scene has no lamp, or as check().
/// \report{Section 3.2.2}
[[nodiscard]] inline PhotonMap trace_photons(const Scene& scene,
                                             const PhotonPassSettings& pass) {
    check(scene);
    require_at_least("pass.photons", pass.photons, 0);
    require_positive("the flux of the scene", flux(scene));
    const double each = flux(scene) / pass.photons;
    PhotonMap map;
    for (int i = 0; i < pass.photons; ++i) {
        RandomStream stream = photon_stream(pass, i);
        const PathState photon = emit_photon(scene, each, stream);
        trace_photon(scene, photon, stream, pass.max_bounces,
                     [&](const PathState& path, const Vertex& vertex) {
                         store_photon(path, vertex, map);
                     });
    }
    return map;
}

} // namespace flatland
