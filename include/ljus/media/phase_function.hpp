#pragma once

/// \file ljus/media/phase_function.hpp
/// \brief The phase function of Henyey and Greenstein.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "ljus/math/frame.hpp"
#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup phase_function Phase functions
/// \brief The directions of light that is scattered within a medium.
///
/// A phase function describes how a medium scatters light, as a BRDF does for a
/// surface. Unlike a BRDF it is not multiplied by a cosine. Its integral over all
/// directions is 1, so that it can serve as a probability density.
/// \{

/// The phase function of Henyey and Greenstein \cite henyey1941,
/// \f[ \varrho(\theta) =
///     \frac{1 - g^2}{4\pi\,(1 + g^2 - 2 g \cos\theta)^{3/2}} . \f]
/// \param g       Mean cosine of theta, within [-0.99, 0.99]. 0 scatters equally in all
///                directions; a positive g scatters mostly forwards.
/// \param cosine  Cosine of theta, the angle between the directions of travel before
///                and after scattering.
/// \return Per steradian. This is also the density of sample_henyey_greenstein().
// [henyey greenstein]
template <std::floating_point T>
[[nodiscard]] T henyey_greenstein(T g, T cosine) noexcept {
    // The printed form, 1 + g^2 - 2 g cos, loses its digits around the peak.
    const T narrow = T(1) - std::abs(g);
    const T off_peak = std::max(T(0), T(1) - std::copysign(cosine, g * cosine));
    const T square = narrow * narrow + T(2) * std::abs(g) * off_peak;
    return (T(1) - g * g) / (T(4) * std::numbers::pi_v<T> * square * std::sqrt(square));
}
// [henyey greenstein]

/// Samples the unit direction of travel after scattering, with the density
/// henyey_greenstein(). `travel` is the unit direction before scattering. The
/// cumulative distribution is inverted in a form that also holds for g = 0.
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
