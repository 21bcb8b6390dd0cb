#pragma once

/// \file ljus/path/shading.hpp
/// \brief What every renderer does at a hit.

#include <algorithm>

#include "ljus/math/random.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/path/scatter.hpp"

namespace ljus {

/// \defgroup shading Shading
/// \brief The steps that the renderers share.
/// \{

/// A hit, as the renderers see it.
template <std::floating_point T>
struct ShadingT {
    SurfaceT<T> surface; ///< Where.
    Vec3T<T> wo;         ///< Unit, to where the path came from, in the surface's frame.
    RgbT<T> medium;      ///< Absorption of what the path is in, per scene unit.

    /// Whether the surface emits to where the path came from: emission is one-sided.
    [[nodiscard]] bool emits() const noexcept {
        return wo.z > T(0) && !is_black(surface.object.emission);
    }
};

/// A hit, made ready.
/// \param scene   The scene.
/// \param ray     The ray that hit; its direction of unit length.
/// \param hit     What closest_hit() returned.
/// \param medium  Absorption along the ray, per scene unit.
/// \return The surface and the direction back.
template <typename Scene, std::floating_point T>
[[nodiscard]] ShadingT<T> shading(const Scene& scene, const RayT<T>& ray,
                                  const SceneHitT<T>& hit, const RgbT<T>& medium) {
    const SurfaceT<T> surface = surface_at(scene, ray, hit);
    return {surface, to_local(surface.frame, -ray.direction), medium};
}

/// The absorption after a scattering: of the material's inside, if the path went in;
/// none, if it came out; else what it was.
/// \param medium  Before, per scene unit.
/// \param material  Of the surface.
/// \param wo  Where the path came from, in the surface's frame.
/// \param wi  Where it goes, in the surface's frame.
/// \return Per scene unit.
template <typename Material, std::floating_point T>
[[nodiscard]] RgbT<T> medium_beyond(const RgbT<T>& medium, const Material& material,
                                    const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    if (same_side(wo, wi)) return medium;
    return wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)};
}

/// Russian roulette on a camera path: it survives with a probability in proportion to
/// its throughput, and a survivor is divided by it \cite arvo1990. That radiance is
/// 2.25 times less outside of glass is no loss, and no reason to die. For any positive
/// probability the mean is what it was; the noise is not.
/// \param throughput  Divided by the probability, if it survives.
/// \param squeeze  The product of all BsdfSampleT::squeeze in the throughput.
/// \param u  In [0, 1).
/// \param threshold  Throughput from which on a path is safe; 0: any.
/// \param most  The largest probability, in (0, 1].
/// \return Whether the path goes on.
// [survives]
template <std::floating_point T>
[[nodiscard]] bool survives(RgbT<T>& throughput, T eta_scale, T u, T threshold = T(1),
                            T most = T(1)) noexcept {
    const T share = max_component(throughput) / eta_scale;
    const T probability = std::min(most, share / threshold);
    if (!(u < probability)) return false;
    throughput /= probability;
    return true;
}
// [survives]

/// \}

} // namespace ljus
