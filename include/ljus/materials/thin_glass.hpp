#pragma once

/// \file ljus/materials/thin_glass.hpp
/// \brief A pane of glass that is one surface: light goes straight through.

#include <algorithm>
#include <cmath>

#include "ljus/materials/bsdf.hpp"
#include "ljus/math/require.hpp"
#include "ljus/optics/fresnel.hpp"
#include "ljus/optics/reflection.hpp"
#include "ljus/optics/refraction.hpp"

namespace ljus {

/// \defgroup thin_glass Thin glass
/// \brief Section 3.2.5, for a window: two boundaries so close that they are one.
///
/// A pane is a *thin sheet*, as a soap film is: what goes on goes straight on, which is
/// no scattering but visibility. So shadow rays and photons go through, tinted;
/// sample() knows the reflection only. See \ref thin_sheets.
/// \{

/// A pane with air on both sides.
/// \report{Section 3.2.5}
template <std::floating_point T>
struct ThinGlassT {
    using Scalar = T;                           ///< The precision of its numbers.
    static constexpr bool only_specular = true; ///< See OnlySpecular.
    T index = T(1.5);                           ///< Index of refraction of the glass.
    RgbT<T> tint{T(1)}; ///< What is left of light that crosses the glass straight,
                        ///< without its boundaries; in [0, 1].
};
using ThinGlass = ThinGlassT<float>; ///< ThinGlassT in float.

/// What a pane reflects and lets through.
template <std::floating_point T>
struct PaneSharesT {
    RgbT<T> reflected;   ///< Of the light that arrives.
    RgbT<T> transmitted; ///< Of the light that arrives; absorbed is the rest.
};

/// All reflections within a pane, summed. With R of one boundary and a left of one way
/// through the glass,
///
/// \f[ T_\infty = (1-R)^2 a \left(1 + R^2 a^2 + R^4 a^4 + \dots\right)
///              = \frac{(1-R)^2 a}{1 - R^2 a^2}, \qquad
///     R_\infty = R + R\,a\,T_\infty \f]
///
/// with a = tint^(1/cos) of the angle within the glass. The waves of both boundaries
/// are added without their phases: the pane is thicker than light is coherent.
/// \param pane       The pane.
/// \param cos_theta  Cosine between ray and normal, in [0, 1].
/// \return The shares; without tint they add up to 1.
/// \cost fresnel(), one more square root, three powers if there is a tint.
// [pane]
template <std::floating_point T>
[[nodiscard]] PaneSharesT<T> pane_shares(const ThinGlassT<T>& pane,
                                         T cos_theta) noexcept {
    const T r = fresnel(cos_theta, T(1), pane.index);
    if (!(r < T(1))) return {RgbT<T>{T(1)}, RgbT<T>{T(0)}};
    const T sine2 = (T(1) - cos_theta) * (T(1) + cos_theta);
    const T cosine =
        std::sqrt(std::max(T(0), T(1) - sine2 / (pane.index * pane.index)));
    PaneSharesT<T> shares{};
    for (int c = 0; c < 3; ++c) {
        const T tint = pane.tint[c];
        const T a = tint == T(1) ? T(1) : std::pow(tint, T(1) / cosine);
        shares.transmitted[c] =
            (T(1) - r) * (T(1) - r) * a / ((T(1) - r * a) * (T(1) + r * a));
        shares.reflected[c] = r * (T(1) + a * shares.transmitted[c]);
    }
    return shares;
}
// [pane]

/// What goes straight on through a pane. A material with this function is a thin sheet.
/// \param pane  The pane.
/// \param wo    Towards where the light goes.
/// \return PaneSharesT::transmitted.
// [pane straight]
template <std::floating_point T>
[[nodiscard]] RgbT<T> straight(const ThinGlassT<T>& pane, const Vec3T<T>& /*position*/,
                               const Vec3T<T>& wo) noexcept {
    return pane_shares(pane, std::min(std::abs(wo.z), T(1))).transmitted;
}
// [pane straight]

/// The mirror direction, with PaneSharesT::reflected as weight. What goes straight on
/// is not sampled.
/// \param pane   The pane.
/// \param wo     Towards where the light goes.
/// \param which  The parts to sample from.
/// \return The sample; nothing if `wo` lies on the surface or without Lobes::specular.
/// \cost pane_shares().
/// \report{Section 3.2.5}
// [thin glass sample]
template <std::floating_point T>
[[nodiscard]] std::optional<BsdfSampleT<T>>
sample(const ThinGlassT<T>& pane, const Vec3T<T>& wo, const Vec3T<T>&,
       Transport /*transport*/, Lobes which = Lobes::all) noexcept {
    if (!has(which, Lobes::specular) || !(wo.z > T(0) || wo.z < T(0)))
        return std::nullopt;
    const T cos_theta = std::min(std::abs(wo.z), T(1));
    return specular_sample(reflect(wo), pane_shares(pane, cos_theta).reflected);
}
// [thin glass sample]

/// Refuses an index or a tint that no pane can have.
/// \param pane  The pane.
/// \throws std::invalid_argument naming the member.
template <std::floating_point T>
void check(const ThinGlassT<T>& pane) {
    require_index("thin_glass.index", pane.index);
    require_unit("thin_glass.tint", pane.tint);
}

/// \}

} // namespace ljus
