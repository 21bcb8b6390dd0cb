#pragma once

/// \file ljus/path/scatter.hpp
/// \brief Scattering at a surface with two normals: its own, and the one it is shaded
/// with.

#include "ljus/path/vertex.hpp"

namespace ljus {

/// \defgroup scatter Shading normals
/// \brief Where smooth normals meet flat triangles \cite veach1997.
///
/// The geometric normal decides the side of every direction, the shading normal turns
/// the frame of the material. Where they disagree about a direction:
///
/// | direction                        | rule                                         |
/// |----------------------------------|----------------------------------------------|
/// | a camera path comes from         | the frame is around the geometric normal     |
/// | a photon comes from              | the same; diffuse parts absorb it            |
/// | of a shadow ray, a photon's mark | no light                                     |
/// | sampled, of a mirror or of glass | sampled again, around the geometric normal   |
/// | sampled, of any other part       | the path ends                                |
/// \{

namespace detail {

/// Whether a direction lies on the same side of a surface by both its normals.
/// \param vertex  A point of the surface.
/// \param local   The direction in the surface's frame.
/// \param world   The same in the world.
template <std::floating_point T>
[[nodiscard]] bool agrees(const VertexT<T>& vertex, const Vec3T<T>& local,
                          const Vec3T<T>& world) noexcept {
    if (!vertex.smooth) return true;
    const T side = glm::dot(world, vertex.point.normal);
    return (side > T(0) && local.z > T(0)) || (side < T(0) && local.z < T(0));
}

/// What a photon's flux counts for where it lands: the flux is that of the triangle,
/// but the material reflects what the shading normal's cosine says.
/// \param vertex     Where it lands.
/// \param direction  The photon's direction of travel.
/// \return \f$ |\omega \cdot N_s| / |\omega \cdot N_g| \f$; 0 if they disagree.
template <std::floating_point T>
[[nodiscard]] T landing_factor(const VertexT<T>& vertex,
                               const Vec3T<T>& direction) noexcept {
    if (vertex.turned) return T(0);
    if (!vertex.smooth) return T(1);
    return std::abs(vertex.wo.z / glm::dot(direction, vertex.point.normal));
}

/// A scattered direction.
template <std::floating_point T>
struct ScatteredT {
    BsdfSampleT<T> sample{}; ///< In the frame; the z of `wi` tells the side.
    Vec3T<T> wi{T(0)};       ///< The direction in the world.
};

} // namespace detail

/// Samples a direction, with both normals of the surface kept in mind.
///
/// A photon's flux is multiplied by the factor of the adjoint,
/// \f[ \frac{|\omega_o \cdot N_s|\,|\omega_i \cdot N_g|}
///          {|\omega_o \cdot N_g|\,|\omega_i \cdot N_s|} \f]
/// (Veach's Eq. 5.19, \f$\omega_o\f$ to where the photon came from): without it, camera
/// paths and photons do not see the same scene.
/// \param vertex     Where.
/// \param material   What the surface is made of.
/// \param u          Point of [0,1)^3.
/// \param transport  What the path carries.
/// \param which      The parts to sample from.
/// \return The direction; nothing if the path ends here.
/// \cite veach1997
// [scatter]
template <std::floating_point T, Material M>
[[nodiscard]] std::optional<detail::ScatteredT<T>>
scatter(const VertexT<T>& vertex, const M& material, const Vec3T<T>& u,
        Transport transport, Lobes which = Lobes::all) noexcept {
    const Vec3T<T>& wo = vertex.wo;
    const auto& here = material_at(material, vertex.point.position, vertex.uv);
    const auto next = sample(here, wo, u, transport, which);
    if (!next) return std::nullopt;
    detail::ScatteredT<T> scattered{*next, to_world(vertex.frame, next->wi)};
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
    const auto again = sample(here, to_local(flat, back), u, transport, which);
    if (!again || !again->specular) return std::nullopt;
    return detail::ScatteredT<T>{*again, to_world(flat, again->wi)};
}
// [scatter]

/// \}

} // namespace ljus
