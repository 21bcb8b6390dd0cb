#pragma once

/// \file ljus/path/continue_path.hpp
/// \brief Continues a path from a vertex, for radiance or flux.

#include "ljus/math/random.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/path_state.hpp"

namespace ljus {

/// \defgroup continue_path Continuing a path
/// \brief Section 3.2.4 of the report: reflected, refracted and indirect rays.
///
/// A surface may have two normals, for example a triangle with interpolated normals
/// \cite veach1997. The geometric normal decides on which side of the surface a
/// direction lies. The shading normal is the z axis of the material's frame. Where the
/// two normals disagree about the side of a direction:
///
/// | direction                         | rule                                         |
/// |-----------------------------------|----------------------------------------------|
/// | wo of a camera path               | the geometric normal becomes the z axis      |
/// | wo of a photon                    | the same, and non-specular lobes absorb it   |
/// | of a shadow ray or stored photon  | the surface reflects no light                |
/// | sampled from a mirror or glass    | sampled again around the geometric normal    |
/// | sampled from any other lobe       | the path ends                                |
/// \{

/// A scattered direction.
template <std::floating_point T>
struct ScatteredT {
    /// The sample in the shading frame; the sign of `wi.z` gives the side.
    BsdfSampleT<T> sample{};
    Vec3T<T> wi{T(0)}; ///< The direction in the world.
};

/// Samples a direction and respects both normals of the surface. The flux of a photon
/// is multiplied by the factor
/// \f[ \frac{|\omega_o \cdot N_s|\,|\omega_i \cdot N_g|}
///          {|\omega_o \cdot N_g|\,|\omega_i \cdot N_s|} \f]
/// of Veach's Eq. 5.19, where N_s is the shading normal, N_g the geometric normal,
/// \f$\omega_o\f$ the direction back along the path of the photon, and \f$\omega_i\f$
/// the sampled direction. With this factor, photons and camera paths find the same
/// light, except where the two normals disagree: by the rules above photons lose light
/// there that camera paths find.
/// `material` comes from visit_material_at(), and `u` is a point of the unit cube.
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

/// The absorption coefficient on the side of `wi` of a surface, per scene unit; 0 where
/// a path leaves a body.
/// \param medium  The absorption coefficient on the side of `wo`.
/// \param wo, wi  Unit vectors in the frame of the surface.
template <typename M, std::floating_point T>
[[nodiscard]] RgbT<T> medium_beyond(const RgbT<T>& medium, const M& material,
                                    const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    if (same_side(wo, wi)) return medium;
    return wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)};
}

/// Whether a path leaves a body along `wi`. If another body surrounds this body,
/// medium_beyond() is wrong, and medium_at() must find the absorption.
template <typename M, std::floating_point T>
[[nodiscard]] bool leaves_body(const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    return MayAbsorb<M> && wo.z < T(0) && wi.z > T(0);
}

/// Continues a path in a sampled direction, which is `wi` in the world.
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

/// Continues a path in a direction that the material samples from the lobes in `which`.
/// Three numbers are drawn, unless the material has none of these lobes.
/// \return False if the path ends here. The path is then unchanged.
/// \report{Section 3.2.4}
template <std::floating_point T, Material M, StreamLike Stream>
[[nodiscard]] bool continue_path(PathStateT<T>& path, const VertexT<T>& vertex,
                                 const M& material, Transport transport, Lobes which,
                                 Stream& stream) {
    if (!has(lobes(material), which)) return false;
    const Vec3T<T> u = next_3d<T>(stream);
    if (!vertex.smooth) { // the same as scatter(), without copies
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

/// Splits a camera path at a boundary: the path is reflected, and a copy of it is
/// refracted.
/// \return The copy, with its own random numbers. Nothing if the material does not
///         split paths, if only one direction exists, or if VertexT::smooth is set;
///         then the path is unchanged.
/// \report{Section 3.2.5}
template <std::floating_point T, Material M>
[[nodiscard]] std::optional<PathStateT<T>>
split_path(PathStateT<T>& path, const VertexT<T>& vertex, const M& material) {
    if constexpr (requires { split(material, vertex.wo, Transport::radiance); }) {
        const auto both = split(material, vertex.wo, Transport::radiance);
        if (!both || vertex.smooth) return std::nullopt;
        const auto& [reflected, refracted] = *both;
        PathStateT<T> other = path;
        // A path splits at most once per depth: one bit per depth names the branch.
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
