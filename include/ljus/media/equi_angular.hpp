#pragma once

/// \file ljus/media/equi_angular.hpp
/// \brief Equi-angular sampling of the points of a ray.

#include <algorithm>
#include <cmath>

#include "ljus/media/medium.hpp"

namespace ljus {

/// \defgroup equi_angular Equi-angular sampling
/// \brief Points of a ray, uniform in angle as seen from a light. The density cancels
/// the inverse square of their distance from the light.
/// \{

/// The angles, in radians, at which a light sees the points of a ray \cite kulla2012.
template <std::floating_point T>
struct EquiAngularT {
    SpanT<T> span{};  ///< The interval of t from which points are sampled.
    T nearest = T(0); ///< The t at which the ray's line is nearest to the light.
    T away = T(1);    ///< Distance of the light from the ray's line.
    T first = T(0);   ///< Angle from the nearest point to the start of the span.
    T opening = T(0); ///< Angle from the start to the end of the span.
};

/// Prepares equi-angular sampling of a span of a ray with a unit direction. The length
/// of the span is finite and not 0. A light on the ray would attract all points. The
/// distance between light and ray therefore counts as at least a thousandth of the
/// length of the span.
// [equi angular]
template <std::floating_point T>
[[nodiscard]] EquiAngularT<T> equi_angular(const RayT<T>& ray, const SpanT<T>& span,
                                           const Vec3T<T>& light) noexcept {
    const Vec3T<T> to = light - ray.origin;
    const T nearest = glm::dot(to, ray.direction);
    const T away = std::max(glm::length(to - nearest * ray.direction),
                            T(1e-3) * (span.last - span.first));
    const T low = span.first - nearest, high = span.last - nearest;
    return {span, nearest, away, std::atan2(low, away),
            std::atan2(away * (high - low), away * away + low * high)};
}

/// Samples a point of the ray.
/// \return The parameter t of the point, within the span.
template <std::floating_point T>
[[nodiscard]] T sample_equi_angular(const EquiAngularT<T>& angles, T u) noexcept {
    const T t =
        angles.nearest + angles.away * std::tan(angles.first + u * angles.opening);
    return std::clamp(t, angles.span.first, angles.span.last);
}

/// The density of sample_equi_angular(), per scene unit along the ray.
template <std::floating_point T>
[[nodiscard]] T pdf_equi_angular(const EquiAngularT<T>& angles, T t) noexcept {
    const T off = t - angles.nearest;
    return angles.away / (angles.opening * (angles.away * angles.away + off * off));
}
// [equi angular]

/// \}

} // namespace ljus
