#pragma once

/// \file ljus/materials/metal.hpp
/// \brief Polished metal: a mirror whose colour is in its index.

#include <algorithm>

#include "ljus/materials/bsdf.hpp"
#include "ljus/optics/conductor.hpp"
#include "ljus/optics/reflection.hpp"

namespace ljus {

/// \defgroup metal Polished metal
/// \brief Section 3.2.4: a perfectly reflective surface, coloured as metals are.
/// \{

/// Smooth metal, on both sides. Its colour fades to white at grazing angles.
/// \report{Section 3.2.4}
template <std::floating_point T>
struct MetalT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< See OnlySpecular.
    ConductorIndexT<T> index = gold<T>;         ///< n and k for each channel.
};
using Metal = MetalT<float>; ///< MetalT in float.

/// The mirror direction, with the reflectance of its angle as weight.
/// \param metal  The metal.
/// \param wo     Towards where the light goes.
/// \param which  The parts to sample from.
/// \return The sample; nothing if `wo` lies on the surface or without Lobes::specular.
/// \cost Three times fresnel_conductor().
/// \report{Section 3.2.4, Eq. (4)}
// [metal sample]
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const MetalT<T>& metal, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    const T cos_theta = std::min(std::abs(wo.z), T(1));
    return specular_sample(reflect(wo), fresnel_conductor(cos_theta, metal.index));
}
// [metal sample]

/// Refuses an index that no metal has.
/// \param metal  The metal.
/// \throws std::invalid_argument naming the member.
template <std::floating_point T>
void check(const MetalT<T>& metal) {
    require_conductor("metal.index", metal.index);
}

/// \}

} // namespace ljus
