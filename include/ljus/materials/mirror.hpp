#pragma once

/// \file ljus/materials/mirror.hpp
/// \brief The perfect mirror, and polished metal.

#include <algorithm>

#include "ljus/materials/material.hpp"
#include "ljus/math/require.hpp"
#include "ljus/optics/conductor.hpp"
#include "ljus/optics/reflection.hpp"

namespace ljus {

/// \defgroup mirror Mirrors
/// \brief Section 3.2.4 of the report: perfectly reflective surfaces.
/// \{

/// A two-sided mirror with the same reflectance at every angle.
/// \report{Section 3.2.4}
template <std::floating_point T>
struct MirrorT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    RgbT<T> reflectance{T(1)}; ///< Reflected fraction of the light, in [0, 1].
};
using Mirror = MirrorT<float>; ///< MirrorT in float.

/// Returns the mirror direction. Its weight is the reflectance.
/// \cost Two sign changes.
/// \report{Section 3.2.4, Eq. (4)}
// [mirror sample]
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const MirrorT<T>& mirror, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || is_black(mirror.reflectance))
        return std::nullopt;
    if (!(wo.z > T(0) || wo.z < T(0))) return std::nullopt;
    return specular_sample(reflect(wo), mirror.reflectance);
}
// [mirror sample]

/// Requires a reflectance within [0, 1].
template <std::floating_point T>
void check(const MirrorT<T>& mirror) {
    require_unit("mirror.reflectance", mirror.reflectance);
}

/// \}

/// \defgroup metal Polished metal
/// \brief Section 3.2.4 of the report: a mirror with the colour of a metal.
/// \{

/// A smooth two-sided surface of metal. Its colour fades to white at grazing angles.
/// \report{Section 3.2.4}
template <std::floating_point T>
struct MetalT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< All lobes are specular.
    ConductorIndexT<T> index = gold<T>; ///< Complex index of refraction, per channel.
};
using Metal = MetalT<float>; ///< MetalT in float.

/// Returns the mirror direction. Its weight is the reflectance of the metal at the
/// angle of `wo`.
/// \cost Three calls of fresnel_conductor().
/// \report{Section 3.2.4, Eq. (4)}
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const MetalT<T>& metal, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    const T cos_theta = std::min(std::abs(wo.z), T(1));
    return specular_sample(reflect(wo), fresnel_conductor(cos_theta, metal.index));
}

/// Requires an index whose parts n and k are within [0, 1e9].
template <std::floating_point T>
void check(const MetalT<T>& metal) {
    detail::require_conductor("metal.index", metal.index);
}

/// \}

} // namespace ljus
