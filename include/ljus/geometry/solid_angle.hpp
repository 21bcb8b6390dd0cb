#pragma once

/// \file ljus/geometry/solid_angle.hpp
/// \brief Points of a shape, chosen for an observer: densities per steradian.

#include <cmath>

#include "ljus/geometry/surface_point.hpp"

namespace ljus {

/// \defgroup solid_angle Shapes as an observer sees them
/// \brief Section 3.2.3: shadow rays end at a point of a lamp; its density per
/// steradian holds the cosine and the inverse square that the report's program forgot.
///
/// Each shape has its own sample_towards() and pdf_towards(), or those that shape.hpp
/// has for any shape.
/// \{

/// A point of a shape, and the density with which an observer's direction fell on it.
template <std::floating_point T>
struct SeenPointT {
    SurfacePointT<T> point{}; ///< The point.
    T pdf = T(0);             ///< Per steradian of the observer.
};

namespace detail {

/// The density per steradian of a point that was chosen uniformly over the area.
/// \param from   The observer.
/// \param point  The point of the shape.
/// \param area   The shape's area.
/// \return distance^2 / (|cos| area); infinity if the surface is seen edge-on, and 0 at
///         the point itself, whose light comes from nowhere.
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
