#pragma once

/// \file ljus/path/camera_path.hpp
/// \brief A path from the camera, and how it goes on from a surface.

#include "ljus/path/path_log.hpp"
#include "ljus/path/scatter.hpp"
#include "ljus/path/shading.hpp"

namespace ljus {

/// \defgroup camera_path Camera paths
/// \brief Section 3.2.4: what the recursive trace of the report carries along.
/// \{

/// A path from the camera, on its way.
template <std::floating_point T>
struct PathT {
    RayT<T> ray{};            ///< Where it goes.
    RgbT<T> throughput{T(1)}; ///< What it brings of the radiance that it finds.
    T eta_scale = T(1);       ///< What of that is no loss, see survives().
    RgbT<T> medium{T(0)};     ///< Absorption of what it is in, per scene unit.
    Vec3T<T> from{T(0)};      ///< The surface that it comes from.
    T bsdf_pdf = T(0); ///< Of its direction, per steradian; 0: no other was possible.
    bool met_diffuse = false; ///< Whether it has left a diffuse surface.
    std::uint64_t bounce = 0; ///< Where its random numbers start.
};

/// Sends a path on from a surface in a direction that is known.
/// \param path      The path.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param next      The direction, its weight, its density.
/// \param wi        The same direction in the world.
/// \param log       Told of the vertex.
template <std::floating_point T, typename Material, typename Log>
void go_on(PathT<T>& path, const ShadingT<T>& at, const Material& material,
           const BsdfSampleT<T>& next, const Vec3T<T>& wi, Log& log) {
    path.throughput *= next.weight;
    path.eta_scale *= next.eta_scale;
    path.bsdf_pdf = next.pdf;
    path.from = at.surface.point.position;
    path.met_diffuse = path.met_diffuse || !next.specular;
    log.vertex(next.specular ? 'S' : 'D', path.from, path.throughput, next.pdf);
    path.medium = medium_beyond(path.medium, material, at.wo, next.wi);
    path.ray = spawn_ray(at.surface.point, wi);
}

/// Sends a path on from a surface in a direction that the material samples.
/// \param path      The path.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param which     The parts to sample from.
/// \param last      Whether it is the last surface: from there a path goes on to the
///                  lamp that its shadow ray left a share of, and to nothing else.
/// \param stream    Three numbers are drawn.
/// \param log       Told of the vertex.
/// \return False if the path ends here.
/// \report{Section 3.2.4}
// [send on]
template <std::floating_point T, typename Material, typename Stream, typename Log>
[[nodiscard]] bool send_on(PathT<T>& path, const ShadingT<T>& at,
                           const Material& material, Lobes which, bool last,
                           Stream& stream, Log& log) {
    const auto scattered = scatter(at.surface, material, at.wo, next_3d<T>(stream),
                                   Transport::radiance, which);
    if (!scattered || (last && scattered->sample.specular)) return false;
    go_on(path, at, material, scattered->sample, scattered->wi, log);
    return true;
}
// [send on]

/// Sends a path both ways at a boundary: the path itself back, a copy of it through.
/// \param path      The path.
/// \param at        The surface.
/// \param material  What it is made of.
/// \param log       Told of the path's own vertex.
/// \return The copy; nothing, and the path as it was, where there is one way only.
/// \report{Section 3.2.5}
// [split]
template <std::floating_point T, typename Material, typename Log>
[[nodiscard]] std::optional<PathT<T>> split(PathT<T>& path, const ShadingT<T>& at,
                                            const Material& material, Log& log) {
    if constexpr (requires { both_ways(material, at.wo, Transport::radiance); }) {
        const auto both = both_ways(material, at.wo, Transport::radiance);
        if (!both || at.surface.smooth) return std::nullopt;
        const auto& [back, through] = *both;
        PathT<T> other = path;
        other.bounce = std::uint64_t(1) << 32; // its own random numbers
        NoLog silent;                          // it is told of when it is followed
        go_on(other, at, material, through, to_world(at.surface.frame, through.wi),
              silent);
        go_on(path, at, material, back, to_world(at.surface.frame, back.wi), log);
        return other;
    } else {
        return std::nullopt;
    }
}
// [split]

/// \}

} // namespace ljus
