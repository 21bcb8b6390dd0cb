#pragma once

/// \file ljus/path/continue_path.hpp
/// \brief How a path goes on from a vertex, be it radiance or flux.

#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/path_state.hpp"

namespace ljus {

/// \defgroup continue_path Continuing a path
/// \brief Section 3.2.4: reflected, refracted and indirect rays.
///
/// A surface may have two normals, its own and the one it is shaded with, as where
/// smooth normals meet flat triangles \cite veach1997. The geometric normal decides the
/// side of every direction, the shading normal turns the frame of the material. Where
/// they disagree about a direction:
///
/// | direction                        | rule                                         |
/// |----------------------------------|----------------------------------------------|
/// | a camera path comes from         | the frame is around the geometric normal     |
/// | a photon comes from              | the same; diffuse parts absorb it            |
/// | of a shadow ray, a photon's mark | no light                                     |
/// | sampled, of a mirror or of glass | sampled again, around the geometric normal   |
/// | sampled, of any other part       | the path ends                                |
/// \{

/// A scattered direction.
template <std::floating_point T>
struct ScatteredT {
    BsdfSampleT<T> sample{}; ///< In the frame; the z of `wi` tells the side.
    Vec3T<T> wi{T(0)};       ///< The direction in the world.
};

/// Samples a direction, with both normals of the surface kept in mind.
///
/// A photon's flux is multiplied by the factor of the adjoint,
/// \f[ \frac{|\omega_o \cdot N_s|\,|\omega_i \cdot N_g|}
///          {|\omega_o \cdot N_g|\,|\omega_i \cdot N_s|} \f]
/// (Veach's Eq. 5.19, \f$\omega_o\f$ to where the photon came from): without it, camera
/// paths and photons do not see the same scene.
/// \param vertex     Where.
/// \param material   What the surface is made of there; see visit_material_at().
/// \param u          Point of [0,1)^3.
/// \param transport  What the path carries.
/// \param which      The parts to sample from.
/// \return The direction; nothing if the path ends here.
/// \cite veach1997
// [scatter]
template <std::floating_point T, Material M>
[[nodiscard]] std::optional<ScatteredT<T>>
scatter(const VertexT<T>& vertex, const M& material, const Vec3T<T>& u,
        Transport transport, Lobes which = Lobes::all) noexcept {
    const Vec3T<T>& wo = vertex.wo;
    const auto next = sample(material, wo, u, transport, which);
    if (!next) return std::nullopt;
    ScatteredT<T> scattered{*next, to_world(vertex.frame, next->wi)};
    if (!vertex.smooth) return scattered;

    const Vec3T<T>& geometric = vertex.point.normal;
    const Vec3T<T> back = to_world(vertex.frame, wo);
    if (detail::agrees(vertex, next->wi, scattered.wi)) {
        if (transport == Transport::radiance) return scattered;
        const T factor = (wo.z * glm::dot(scattered.wi, geometric)) /
                         (glm::dot(back, geometric) * next->wi.z);
        if (!std::isfinite(factor)) return std::nullopt;
        scattered.sample.weight *= std::abs(factor);
        return scattered;
    }
    if (!next->specular) return std::nullopt;
    const FrameT<T> flat = frame_around(geometric);
    const auto again = sample(material, to_local(flat, back), u, transport, which);
    if (!again || !again->specular) return std::nullopt;
    return ScatteredT<T>{*again, to_world(flat, again->wi)};
}
// [scatter]

namespace detail {

/// The absorption after a scattering: of the material's inside, if the path went in;
/// none, if it came out; else what it was.
/// \param medium    Before, per scene unit.
/// \param material  Of the surface.
/// \param wo        Unit vector in the surface's frame, to where the light goes.
/// \param wi        Unit vector in the surface's frame, to where it comes from.
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
template <std::floating_point T, Material M, StreamLike Stream>
[[nodiscard]] bool continue_path(PathStateT<T>& path, const VertexT<T>& vertex,
                                 const M& material, Transport transport, Lobes which,
                                 Stream& stream) {
    const Vec3T<T> u = next_3d<T>(stream);
    if (!vertex.smooth) { // as scatter() does it, without its copies
        const auto next = sample(material, vertex.wo, u, transport, which);
        if (!next) return false;
        detail::follow(path, vertex, material, *next, to_world(vertex.frame, next->wi));
        return true;
    }
    const auto scattered = scatter(vertex, material, u, transport, which);
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
