#pragma once

/// \file ljus/media/phase_function.hpp
/// \brief The phase function of Henyey and Greenstein: where fog scatters light.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ljus/math/frame.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup phase_function Phase functions
/// \brief The directions of light that is scattered within a medium.
///
/// A phase function is to a medium what the BRDF is to a surface, without a cosine: its
/// integral over all directions is 1, so that it is the density of its own samples.
/// \{

/// The phase function of Henyey and Greenstein \cite henyey1941,
/// \f[ \varrho(\theta) =
///     \frac{1 - g^2}{4\pi\,(1 + g^2 - 2 g \cos\theta)^{3/2}} . \f]
/// \param g       Mean cosine of the angle by which light is turned, within
///                [-0.99, 0.99]: 0 scatters equally in all directions, above 0 mostly
///                forwards.
/// \param cosine  Of the angle between the directions of travel before and after.
/// \return Per steradian: the phase function, and the density of
///         sample_henyey_greenstein().
// [henyey greenstein]
template <std::floating_point T>
[[nodiscard]] T henyey_greenstein(T g, T cosine) noexcept {
    // As it is printed, 1 + g^2 - 2 g cos loses its digits around the peak.
    const T narrow = T(1) - std::abs(g);
    const T off_peak = std::max(T(0), T(1) - std::copysign(cosine, g * cosine));
    const T square = narrow * narrow + T(2) * std::abs(g) * off_peak;
    return (T(1) - g * g) / (T(4) * std::numbers::pi_v<T> * square * std::sqrt(square));
}
// [henyey greenstein]

/// Samples the direction of travel after a scattering, by henyey_greenstein().
///
/// The cumulative distribution is inverted. Its usual form divides by g; this one has
/// no such division, and holds for g = 0.
/// \param g       As for henyey_greenstein().
/// \param travel  Unit direction of travel before.
/// \param u       Point of the unit square.
/// \return Unit direction of travel after.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> sample_henyey_greenstein(T g, const Vec3T<T>& travel,
                                                const Vec2T<T>& u) noexcept {
    const T v = T(2) * u.x - T(1); // the cosine, if g is 0
    const T below = T(1) + g * v;
    const T q = (T(1) - g * g) / below;
    const T cosine = std::clamp((g + (v + g) * (T(1) + q) / below) / T(2), T(-1), T(1));
    const T sine = std::sqrt((T(1) - cosine) * (T(1) + cosine));
    const T phi = T(2) * std::numbers::pi_v<T> * u.y;
    return to_world(frame_around(travel),
                    Vec3T<T>{sine * std::cos(phi), sine * std::sin(phi), cosine});
}

/// \}

} // namespace ljus
