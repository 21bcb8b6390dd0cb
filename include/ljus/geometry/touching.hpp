#pragma once

/// \file ljus/geometry/touching.hpp
/// \brief Whether two surfaces share an area or a point.

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/facet.hpp"

namespace ljus {

/// \defgroup touching Surfaces in one place
/// \brief A slab that rests on a floor shares its plane. Chapter: \ref ch_refraction.
/// \{

/// A piece of a surface: a convex polygon, or a sphere, whose facet is its centre.
struct SurfacePiece {
    Facet facet{};           ///< Three corners or more; of a sphere one.
    double radius = 0;       ///< Of a sphere; otherwise 0.
    bool inside_out = false; ///< Whether its outside is opposite to its normal.
};

/// What two pieces have in common.
struct SharedPlace {
    BoxT<double> box{};     ///< A box around it.
    bool over_area = false; ///< False if they touch in a point.
    bool alike = false;     ///< Whether both outsides are on the same side.
};

namespace detail {

/// The box around a piece.
[[nodiscard, gnu::cold]] inline BoxT<double>
box_of(const SurfacePiece& piece) noexcept {
    BoxT<double> box;
    for (int i = 0; i < piece.facet.count; ++i)
        box = box_union(box, piece.facet.corners[std::size_t(i)]);
    return {box.low - piece.radius, box.high + piece.radius};
}

/// The least and the greatest height of a piece above a plane.
/// \param normal  Of unit length.
[[nodiscard, gnu::cold]] inline std::array<double, 2>
heights_of(const SurfacePiece& piece, const glm::dvec3& point,
           const glm::dvec3& normal) noexcept {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < piece.facet.count; ++i) {
        const double height =
            glm::dot(normal, piece.facet.corners[std::size_t(i)] - point);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    return {low - piece.radius, high + piece.radius};
}

/// Whether an edge of a polygon separates it from another one in its plane. Polygons
/// that share an edge are separated.
[[nodiscard, gnu::cold]] inline bool
separated(const Facet& facet, const SurfacePiece& other, double distance) noexcept {
    const glm::dvec3 normal = area_vector(facet);
    for (int i = 0; i < facet.count; ++i) {
        const glm::dvec3& a = facet.corners[std::size_t(i)];
        const glm::dvec3& b = facet.corners[std::size_t((i + 1) % facet.count)];
        const glm::dvec3 outwards = glm::normalize(glm::cross(b - a, normal));
        if (heights_of(other, a, outwards)[0] >= -distance) return true;
    }
    return false;
}

} // namespace detail

/// What two pieces of surfaces share.
/// \param one, other  The pieces.
/// \param distance    Surfaces within this distance count as in one place; scene units.
/// \return The place; nothing if they cross, or only share an edge or a corner.
[[nodiscard, gnu::cold]] inline std::optional<SharedPlace>
shared_place(const SurfacePiece& one, const SurfacePiece& other,
             double distance) noexcept {
    const glm::dvec3 a = detail::area_vector(one.facet); // 0 for a sphere
    const glm::dvec3 b = detail::area_vector(other.facet);
    // The larger polygon knows its plane better.
    if (glm::length(a) < glm::length(b)) return shared_place(other, one, distance);
    // Where `other` lies along the normal of `one`, or away from its centre.
    const glm::dvec3& point = one.facet.corners[0];
    const glm::dvec3 across = one.radius > 0 ? other.facet.corners[0] - point : a;
    const double length = glm::length(across);
    const glm::dvec3 normal = length > 0 ? across / length : glm::dvec3(0);
    const auto [low, high] = detail::heights_of(other, point, normal);
    const bool at_low = std::abs(low + one.radius) <= distance;
    const bool at_high = std::abs(high - one.radius) <= distance;
    const bool over_area = at_low && at_high;
    const bool outside = std::abs(low - one.radius) <= distance;
    const bool share = other.radius > 0
                           ? at_low || at_high || outside
                           : over_area && glm::dot(a, b) != 0 &&
                                 !detail::separated(one.facet, other, distance) &&
                                 !detail::separated(other.facet, one, distance);
    if (!share) return std::nullopt;
    const BoxT<double> box = detail::box_of(one), other_box = detail::box_of(other);
    glm::dvec3 least = glm::max(box.low, other_box.low) - distance;
    glm::dvec3 most = glm::min(box.high, other_box.high) + distance;
    if (!over_area && other.radius > 0 && (outside || one.radius == 0)) {
        // Where a sphere is this close to a plane, or to a sphere outside of it.
        const double radius =
            one.radius > 0 ? std::min(one.radius, other.radius) : other.radius;
        const double half = std::sqrt(8 * radius * distance) + distance;
        const glm::dvec3 touch =
            other.facet.corners[0] - ((low + high) / 2 - one.radius) * normal;
        least = glm::max(least, touch - half);
        most = glm::min(most, touch + half);
    }
    return SharedPlace{.box{least, most},
                       .over_area = over_area,
                       .alike = (glm::dot(a, b) < 0) !=
                                (one.inside_out == other.inside_out)};
}

/// \}

} // namespace ljus
