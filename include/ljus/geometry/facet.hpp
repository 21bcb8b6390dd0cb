#pragma once

/// \file ljus/geometry/facet.hpp
/// \brief Flat polygons, and how much of a hemisphere one of them fills.

#include <array>
#include <cmath>
#include <numbers>

#include <glm/geometric.hpp>

#include "ljus/math/vector.hpp"

namespace ljus {

/// \defgroup form_factor Form factors
/// \brief Section 2.2: "a form factor, which describes patch visibility, is calculated
/// for each pair of patches". Chapter: \ref ch_radiosity.
///
/// All in double: a form factor is a small difference of larger numbers.
/// \{

/// A convex polygon in space, its corners counter-clockwise as seen from the side that
/// it faces.
struct Facet {
    std::array<glm::dvec3, 6> corners{}; ///< The first `count` of them.
    int count = 0;                       ///< At most 6: a quad cut by a plane has 5.
};

namespace detail {

/// The other side of a facet.
[[nodiscard]] constexpr Facet turned(const Facet& facet) noexcept {
    Facet other{.count = facet.count};
    for (int i = 0; i < facet.count; ++i)
        other.corners[static_cast<std::size_t>(i)] =
            facet.corners[static_cast<std::size_t>(facet.count - 1 - i)];
    return other;
}

/// The area of a facet as a vector along its normal.
/// \param facet  Any facet.
/// \return Normal times area; 0 for fewer than three corners.
[[nodiscard]] constexpr glm::dvec3 area_vector(const Facet& facet) noexcept {
    glm::dvec3 sum(0);
    for (int i = 2; i < facet.count; ++i) {
        const auto k = static_cast<std::size_t>(i);
        sum += glm::cross(facet.corners[k - 1] - facet.corners[0],
                          facet.corners[k] - facet.corners[0]);
    }
    return 0.5 * sum;
}

/// The part of a facet in front of a plane.
/// \param facet   Convex.
/// \param point   Of the plane.
/// \param normal  Unit; points to the side that stays.
/// \param width   What lies as near as this to the plane counts as on it.
/// \return The part, with at most one corner more; no corner if nothing stays.
[[nodiscard]] inline Facet clipped(const Facet& facet, const glm::dvec3& point,
                                   const glm::dvec3& normal,
                                   double width = 0) noexcept {
    const auto height = [&](const glm::dvec3& corner) {
        const double h = glm::dot(normal, corner - point);
        return std::abs(h) <= width ? 0.0 : h;
    };
    Facet part;
    const auto keep = [&](const glm::dvec3& corner) {
        part.corners[static_cast<std::size_t>(part.count++)] = corner;
    };
    for (int i = 0; i < facet.count; ++i) {
        const glm::dvec3& a = facet.corners[static_cast<std::size_t>(i)];
        const glm::dvec3& b =
            facet.corners[static_cast<std::size_t>((i + 1) % facet.count)];
        const double ha = height(a), hb = height(b);
        if (ha >= 0) keep(a);
        if ((ha < 0 && hb > 0) || (ha > 0 && hb < 0))
            keep(a + ha / (ha - hb) * (b - a));
    }
    return part.count < 3 ? Facet{} : part;
}

} // namespace detail

/// The form factor from a point of a surface to a facet: the share of what the point
/// sends out, or of what could come to it, that the facet takes.
///
/// Lambert's formula: with the unit vectors \f$v_k\f$ to the corners,
/// \f[ F = \frac1{2\pi} \sum_k \theta_k\,
///     n \cdot \frac{v_{k+1} \times v_k}{|v_{k+1} \times v_k|}, \f]
/// where \f$\theta_k\f$ is the angle between \f$v_k\f$ and \f$v_{k+1}\f$: the solid
/// angle turned into area on the floor of Nusselt's hemisphere, edge by edge.
/// \param point   Anywhere but on the facet's border.
/// \param normal  Unit normal at the point.
/// \param facet   What lies behind the point's horizon does not count.
/// \return In [0, 1]; 0 if the facet faces away.
/// \report{Section 2.2}
/// \cite baum1989
// [form_factor_at]
[[nodiscard]] inline double form_factor_at(const glm::dvec3& point,
                                           const glm::dvec3& normal,
                                           const Facet& facet) noexcept {
    const Facet seen = detail::clipped(facet, point, normal);
    double sum = 0;
    for (int i = 0; i < seen.count; ++i) {
        const glm::dvec3 a = seen.corners[static_cast<std::size_t>(i)] - point;
        const glm::dvec3 b =
            seen.corners[static_cast<std::size_t>((i + 1) % seen.count)] - point;
        const glm::dvec3 across = glm::cross(b, a);
        const double sine = glm::length(across);
        if (sine > 0)
            sum += glm::dot(normal, across) / sine * std::atan2(sine, glm::dot(a, b));
    }
    return sum > 0 ? sum * std::numbers::inv_pi / 2 : 0;
}
// [form_factor_at]

/// \}

} // namespace ljus
