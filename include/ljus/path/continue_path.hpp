#pragma once

/// \file ljus/path/continue_path.hpp
/// \brief How a path continues from a vertex, with radiance or flux.

#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/path_state.hpp"

namespace ljus {

/// \defgroup continue_path Continuing a path
/// \brief Section 3.2.4: reflected, refracted and indirect rays.
///
/// A surface may have two normals, as where smooth normals meet flat triangles
/// \cite veach1997. The geometric normal decides the side of every direction; the
/// shading normal sets the frame of the material. Where they disagree about the side of
/// a direction:
///
/// | direction                        | rule                                          |
/// |----------------------------------|-----------------------------------------------|
/// | wo of a camera path              | the frame is around the geometric normal      |
/// | wo of a photon                   | the same; non-specular lobes absorb it        |
/// | of a shadow ray, a stored photon | no light                                      |
/// | sampled, of a mirror or of glass | sampled again, around the geometric normal    |
/// | sampled, of any other lobe       | the path ends                                 |
/// \{

/// A scattered direction.
template <std::floating_point T>
struct ScatteredT {
    BsdfSampleT<T> sample{}; ///< In the frame; z of `wi` gives the side.
    Vec3T<T> wi{T(0)};       ///< The direction in the world.
};

/// Samples a direction and respects both normals of the surface.
///
/// The flux of a photon is multiplied by the adjoint correction
/// \f[ \frac{|\omega_o \cdot N_s|\,|\omega_i \cdot N_g|}
///          {|\omega_o \cdot N_g|\,|\omega_i \cdot N_s|} \f]
/// (Veach's Eq. 5.19; \f$\omega_o\f$ points back along the photon's path). Without it,
/// camera paths and photons would see different scenes.
/// \param vertex     The surface.
/// \param material   Its material at the vertex; see visit_material_at().
/// \param u          Point of [0,1)^3.
/// \param transport  What the path carries.
/// \param which      The lobes to sample.
/// \return The direction; nothing if the path ends.
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

/// The absorption on the side of `wi` at a surface that scatters light: `medium` if
/// `wo` lies on the same side, otherwise that of the material's interior, or none
/// outside.
/// \param medium    Absorption on the side of `wo`, per scene unit.
/// \return Per scene unit.
template <typename M, std::floating_point T>
[[nodiscard]] RgbT<T> medium_beyond(const RgbT<T>& medium, const M& material,
                                    const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    if (same_side(wo, wi)) return medium;
    return wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)};
}

/// Whether light leaves a body along `wi`. Another body may surround it, which
/// medium_at() finds and medium_beyond() does not.
template <typename M, std::floating_point T>
[[nodiscard]] bool leaves_body(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    return MayAbsorb<M> && wo.z < T(0) && wi.z > T(0);
}

/// Continues a path in a given direction.
/// \param path      Receives its new ray, throughput and medium.
template <std::floating_point T, Material M>
void follow(PathStateT<T>& path, const VertexT<T>& vertex, const M& material,
            const BsdfSampleT<T>& next, const Vec3T<T>& wi) noexcept {
    path.throughput *= next.weight;
    if (vertex.stop_probability < T(1)) path.throughput /= vertex.stop_probability;
    path.eta_scale *= next.eta_scale;
    path.medium = medium_beyond(path.medium, material, vertex.wo, next.wi);
    if constexpr (MayAbsorb<M>) path.medium_known = !leaves_body<M>(vertex.wo, next.wi);
    if constexpr (Transparent<M>)
        if (!same_side(vertex.wo, next.wi)) path.bodies = path.behind;
    path.previous = vertex.point.position;
    path.pdf = next.pdf;
    path.specular = next.specular;
    (next.specular ? path.met_specular : path.met_diffuse) = true;
    path.ray = spawn_ray(vertex.point, wi, vertex.time);
}

} // namespace detail

/// Continues a path in a direction sampled by the material.
/// \param path       Receives its new ray, throughput and medium.
/// \param vertex     The vertex.
/// \param material   Its material.
/// \param transport  Radiance from the camera, or flux.
/// \param which      The lobes to sample.
/// \param stream     Three numbers are drawn.
/// \return False if the path ends because its light is absorbed.
/// \report{Section 3.2.4}
template <std::floating_point T, Material M, StreamLike Stream>
[[nodiscard]] bool continue_path(PathStateT<T>& path, const VertexT<T>& vertex,
                                 const M& material, Transport transport, Lobes which,
                                 Stream& stream) {
    if (!has(lobes(material), which)) return false;
    const Vec3T<T> u = next_3d<T>(stream);
    if (!vertex.smooth) { // as scatter(), without copies
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

/// Splits a camera path at a boundary: the path is reflected, a copy of it refracted.
/// \return The copy, with its own random numbers; nothing if there is only one
///         direction, and then the path is unchanged.
/// \report{Section 3.2.5}
template <std::floating_point T, Material M>
[[nodiscard]] std::optional<PathStateT<T>>
split_path(PathStateT<T>& path, const VertexT<T>& vertex, const M& material) {
    if constexpr (requires { split(material, vertex.wo, Transport::radiance); }) {
        const auto both = split(material, vertex.wo, Transport::radiance);
        if (!both || vertex.smooth) return std::nullopt;
        const auto& [reflected, refracted] = *both;
        PathStateT<T> other = path;
        // A path splits at most once per depth; one bit per depth identifies the
        // branch.
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
