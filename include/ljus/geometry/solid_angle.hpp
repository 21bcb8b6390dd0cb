#pragma once

/// \file ljus/geometry/solid_angle.hpp
/// \brief Points sampled on a shape for an observer, with densities per steradian.

#include <cmath>

#include "ljus/geometry/surface_point.hpp"

namespace ljus {

/// \defgroup solid_angle Shapes as an observer sees them
/// \brief Section 3.2.3: shadow rays end at a point of a lamp. Its density per
/// steradian contains the cosine and the inverse square that the report's program
/// forgot.
///
/// A shape has its own sample_towards() and pdf_towards(), or uses those of shape.hpp.
/// \{

/// A sampled point of a shape, with its density.
template <std::floating_point T>
struct SeenPointT {
    SurfacePointT<T> point{}; ///< The point.
    T pdf = T(0);             ///< Per steradian at the observer.
};

namespace detail {

/// Converts the density of a point, uniform over the area, to one per steradian at the
/// observer `from`.
/// \return distance^2 / (|cos| area); infinity if the surface is seen edge-on; 0 if the
///         observer is at the point.
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
