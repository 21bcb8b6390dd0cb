#pragma once

/// \file ljus/path/continue_path.hpp
/// \brief How a path goes on from a vertex, be it radiance or flux.

#include "ljus/math/random.hpp"
#include "ljus/path/path_state.hpp"
#include "ljus/path/scatter.hpp"

namespace ljus {

/// \defgroup continue_path Continuing a path
/// \brief Section 3.2.4: reflected, refracted and indirect rays.
/// \{

namespace detail {

/// The absorption after a scattering: of the material's inside, if the path went in;
/// none, if it came out; else what it was.
/// \param medium    Before, per scene unit.
/// \param material  Of the surface.
/// \param wo        To the vertex before, in the surface's frame.
/// \param wi        To where the path goes, in the surface's frame.
/// \return Per scene unit.
template <typename M, std::floating_point T>
[[nodiscard]] RgbT<T> medium_beyond(const RgbT<T>& medium, const M& material,
                                    const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    if (same_side(wo, wi)) return medium;
    return wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)};
}

/// Continues a path in a direction that is known.
/// \param path      Gets its new ray, throughput and medium.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \param next      The direction, its weight, its density.
/// \param wi        The same direction in the world.
template <std::floating_point T, Material M>
void follow(PathStateT<T>& path, const VertexT<T>& vertex, const M& material,
            const BsdfSampleT<T>& next, const Vec3T<T>& wi) noexcept {
    path.throughput *= next.weight;
    if (vertex.stop_probability < T(1)) path.throughput /= vertex.stop_probability;
    path.eta_scale *= next.eta_scale;
    path.medium = medium_beyond(path.medium, material, vertex.wo, next.wi);
    path.previous = vertex.point.position;
    path.pdf = next.pdf;
    path.specular = next.specular;
    (next.specular ? path.met_specular : path.met_diffuse) = true;
    path.ray = spawn_ray(vertex.point, wi, vertex.time);
}

} // namespace detail

/// Continues a path in a direction that the material samples.
/// \param path       Gets its new ray, throughput and medium.
/// \param vertex     Where it is.
/// \param material   What the surface is made of.
/// \param transport  What the path carries: radiance from the camera, or flux.
/// \param which      The lobes to sample from.
/// \param stream     Three numbers are drawn.
/// \return False if the path ends here: its light is absorbed.
/// \report{Section 3.2.4}
template <std::floating_point T, Material M, typename Stream>
[[nodiscard]] bool continue_path(PathStateT<T>& path, const VertexT<T>& vertex,
                                 const M& material, Transport transport, Lobes which,
                                 Stream& stream) {
    const auto scattered =
        scatter(vertex, material, next_3d<T>(stream), transport, which);
    if (!scattered) return false;
    detail::follow(path, vertex, material, scattered->sample, scattered->wi);
    return true;
}

/// Continues a camera path both ways at a boundary: the path itself is reflected, a
/// copy of it refracted.
/// \param path      The path.
/// \param vertex    Where it is.
/// \param material  What the surface is made of.
/// \return The copy, with random numbers of its own; nothing, and the path as it was,
///         where there is one way only.
/// \report{Section 3.2.5}
template <std::floating_point T, Material M>
[[nodiscard]] std::optional<PathStateT<T>>
split_path(PathStateT<T>& path, const VertexT<T>& vertex, const M& material) {
    if constexpr (requires { both_ways(material, vertex.wo, Transport::radiance); }) {
        const auto both = both_ways(material, vertex.wo, Transport::radiance);
        if (!both || vertex.smooth) return std::nullopt;
        const auto& [reflected, refracted] = *both;
        PathStateT<T> other = path;
        // A path splits once per depth: its place in the tree is a bit for each.
        other.branch += std::uint64_t(1) << (16 + path.depth % 32);
        detail::follow(other, vertex, material, refracted,
                       to_world(vertex.frame, refracted.wi));
        detail::follow(path, vertex, material, reflected,
                       to_world(vertex.frame, reflected.wi));
        return other;
    } else {
        return std::nullopt;
    }
}

/// \}

} // namespace ljus
