#pragma once

/// \file flatland/path.hpp
/// \brief The vertex of a path in the plane, and the two functions that move a path.

#include "flatland/scene.hpp"
#include "ljus/math/random.hpp"

namespace flatland {

using ljus::RandomStream, ljus::next_1d, ljus::next_2d;

// Section 3.2 in the plane: next_vertex() and continue_path() are as in space.

/// A vertex of a path: ljus::VertexT in two dimensions. A frame of the plane is given
/// by its normal alone.
/// \report{Section 3.2}
// [vertex]
struct Vertex {
    SurfacePoint point{}; ///< Position and geometric normal.
    Vec2 wo{0, 1};      ///< Direction to the previous vertex: unit vector in the frame.
    std::size_t id = 0; ///< Index of the object.
    Object object{};    ///< The object, with material and emission.
    double distance = 0; ///< Distance from the previous vertex.

    /// Whether the surface emits towards `wo`: emission is one-sided.
    [[nodiscard]] bool emits() const noexcept {
        return wo.y > 0 && object.emission > 0;
    }
};
// [vertex]

/// The state of a path, from the eye or from a lamp.
/// \report{Section 3.2.4}
struct PathState {
    Ray ray{};                 ///< The next ray.
    double throughput = 1;     ///< Factor of the radiance that the path finds; for a
                               ///< photon its flux, W.
    bool specular = false;     ///< Whether the last scattering was by a delta.
    bool met_diffuse = false;  ///< Whether any scattering was not by a delta.
    bool met_specular = false; ///< Whether any scattering was by a delta.
    int depth = 0;             ///< Number of vertices so far.
};

/// Transforms a vector from the world into the frame of a surface.
[[nodiscard]] constexpr Vec2 to_local(const Vec2& normal, const Vec2& v) noexcept {
    return {v.x * normal.y - v.y * normal.x, v.x * normal.x + v.y * normal.y};
}

/// Transforms a vector from the frame of a surface into the world.
[[nodiscard]] constexpr Vec2 to_world(const Vec2& normal, const Vec2& v) noexcept {
    return {v.x * normal.y + v.y * normal.x, v.y * normal.y - v.x * normal.x};
}

/// Moves a path to its next vertex.
/// \param scene   The scene.
/// \param path    The path; its depth is updated.
/// \param stream  Moved to the numbers of the next bounce.
/// \return The vertex; nothing if the path leaves the scene.
[[nodiscard]] inline std::optional<Vertex>
next_vertex(const Scene& scene, PathState& path, RandomStream& stream) {
    start_bounce(stream, static_cast<std::uint64_t>(++path.depth));
    const auto hit = closest_hit(scene, path.ray);
    if (!hit) return std::nullopt;
    Vertex vertex{.id = hit->id, .object = scene.objects[hit->id], .distance = hit->t};
    vertex.point.position = path.ray.origin + hit->t * path.ray.direction;
    vertex.point.normal =
        std::visit([&](const auto& s) { return normal(s, vertex.point.position); },
                   vertex.object.shape);
    vertex.wo = to_local(vertex.point.normal, -path.ray.direction);
    return vertex;
}

/// Continues a path in a direction that the material samples, unless Russian roulette
/// ends the path. It survives with the reflectance of the material as probability, and
/// its throughput is not reduced.
/// \param path       The path; its ray and throughput are updated.
/// \param vertex     The vertex that the path has reached.
/// \param transport  The transported quantity: radiance or flux.
/// \param stream     Two numbers are drawn.
/// \return False if the path ends here.
/// \report{Section 3.2.2}
[[nodiscard]] inline bool continue_path(PathState& path, const Vertex& vertex,
                                        Transport transport, RandomStream& stream) {
    const Vec2 u = next_2d<double>(stream);
    const auto next = sample(vertex.object.material, vertex.wo, u.x, transport);
    if (!next) return false;
    const double probability = std::min(1.0, next->weight / next->eta_scale);
    if (!(u.y < probability)) return false;
    path.throughput *= next->weight / probability;
    path.specular = next->specular;
    (next->specular ? path.met_specular : path.met_diffuse) = true;
    path.ray = {.origin = vertex.point.position,
                .direction = to_world(vertex.point.normal, next->wi)};
    return true;
}

} // namespace flatland
