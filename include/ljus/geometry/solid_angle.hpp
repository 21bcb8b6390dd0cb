#pragma once

/// \file ljus/geometry/solid_angle.hpp
/// \brief Points sampled on a shape for an observer, with densities per steradian.

#include <cmath>

#include "ljus/geometry/surface_point.hpp"

namespace ljus {

/// \defgroup solid_angle Shapes as an observer sees them
/// \brief Section 3.2.3 of the report: a shadow ray ends at a sampled point of a lamp.
/// The density of the point per steradian contains a cosine and the squared distance.
/// The report's program forgot both.
/// \{

/// A sampled point of a shape, with its density.
template <std::floating_point T>
struct SeenPointT {
    SurfacePointT<T> point{}; ///< The point.
    T pdf = T(0);             ///< The density, per steradian at the observer.
};

namespace detail {

/// The density per steradian, at the observer `from`, of a point that is sampled
/// uniformly over an area.
/// \return distance^2 / (|cos| area), with the cosine between the point's normal and
///         the direction of the observer. Infinity if the surface is seen edge-on; 0 if
///         the observer is at the point.
/// \cite veach1997
// [pdf from area]
template <std::floating_point T>
[[nodiscard]] T pdf_from_area(const Vec3T<T>& from, const SurfacePointT<T>& point,
                              T area) noexcept {
    const Vec3T<T> way = point.position - from;
    const T distance2 = glm::dot(way, way);
    if (!(distance2 > T(0))) return T(0);
    const T cosine = std::abs(glm::dot(way, point.normal)) / std::sqrt(distance2);
    return distance2 / (cosine * area);
}
// [pdf from area]

} // namespace detail

/// \}

} // namespace ljus
