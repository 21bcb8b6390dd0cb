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
/// \brief Finds where two surfaces coincide or touch, such as those of a slab and of
/// the floor under the slab. Chapter: \ref ch_refraction.
/// \{

/// A convex polygon, a sphere or a tube. The facet of a sphere has one corner, its
/// centre. The facet of a tube has two corners, the ends of its axis.
struct SurfacePiece {
    Facet facet{};              ///< The polygon, the centre, or the axis.
    double radius = 0;          ///< The radius of a sphere or a tube; 0 for a polygon.
    bool inside_out = false;    ///< Whether the outside is opposite to the normal.
    glm::dvec3 displacement{0}; ///< The motion from time 0 to 1, in scene units.
};

/// The region that two pieces share.
struct SharedPlace {
    BoxT<double> box{}; ///< A box around the region.
    /// True if the pieces share an area; false if they only touch.
    bool over_area = false;
    bool alike = false; ///< Whether both pieces have their outside on the same side.
};

namespace detail {

[[nodiscard, gnu::cold]] inline BoxT<double>
box_of(const SurfacePiece& piece) noexcept {
    BoxT<double> box;
    for (int i = 0; i < piece.facet.count; ++i)
        for (const double time : {0.0, 1.0})
            box = box_union(box, piece.facet.corners[std::size_t(i)] +
                                     time * piece.displacement);
    return {box.low - piece.radius, box.high + piece.radius};
}

/// The least and the greatest height of a facet's corners above a plane.
[[nodiscard, gnu::cold]] inline std::array<double, 2>
heights_of(const Facet& facet, const glm::dvec3& point,
           const glm::dvec3& normal) noexcept {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < facet.count; ++i) {
        const double height = glm::dot(normal, facet.corners[std::size_t(i)] - point);
        low = std::min(low, height);
        high = std::max(high, height);
    }
    return {low, high};
}

/// Whether a line along an edge of a polygon separates the polygon from another polygon
/// in the same plane. Polygons that only share an edge are separated.
[[nodiscard, gnu::cold]] inline bool separated(const Facet& facet, const Facet& other,
                                               double distance) noexcept {
    const glm::dvec3 normal = area_vector(facet);
    for (int i = 0; i < facet.count; ++i) {
        const glm::dvec3& a = facet.corners[std::size_t(i)];
        const glm::dvec3& b = facet.corners[std::size_t((i + 1) % facet.count)];
        const glm::dvec3 outwards = glm::normalize(glm::cross(b - a, normal));
        if (heights_of(other, a, outwards)[0] >= -distance) return true;
    }
    return false;
}

/// Whether a displacement is parallel to the plane that has the given normal.
[[nodiscard, gnu::cold]] inline bool slides(const glm::dvec3& normal,
                                            const glm::dvec3& way) noexcept {
    return std::abs(glm::dot(normal, way)) <=
           1e-6 * glm::length(normal) * glm::length(way);
}

/// Whether two vectors are parallel. The zero vector is parallel to every vector.
[[nodiscard, gnu::cold]] inline bool parallel(const glm::dvec3& a,
                                              const glm::dvec3& b) noexcept {
    return glm::length(glm::cross(a, b)) <= 1e-6 * glm::length(a) * glm::length(b);
}

/// A rectangle around all positions of a polygon that is displaced within its plane.
[[nodiscard, gnu::cold]] inline Facet around_way(const Facet& facet,
                                                 const glm::dvec3& way) noexcept {
    const glm::dvec3 normal = glm::normalize(area_vector(facet));
    const glm::dvec3 u = glm::normalize(way), v = glm::cross(normal, u);
    const auto [left, right] = heights_of(facet, facet.corners[0], u);
    const auto [bottom, top] = heights_of(facet, facet.corners[0], v);
    const glm::dvec3 at_left = facet.corners[0] + left * u;
    const glm::dvec3 at_right = facet.corners[0] + right * u + way;
    return {.corners{at_left + bottom * v, at_right + bottom * v, at_right + top * v,
                     at_left + top * v},
            .count = 4};
}

/// A box around the point where a sphere or a tube touches another surface. Inside this
/// box the two surfaces are close to each other.
[[nodiscard, gnu::cold]] inline BoxT<double>
around_touch(const glm::dvec3& touch, double radius, double distance) noexcept {
    const double half = std::sqrt(8 * radius * distance) + distance;
    return {touch - half, touch + half};
}

/// The region that a polygon shares with a smaller one; see shared_place(), which trims
/// the box of the region. `way` is the displacement of `other` relative to `one`, from
/// time 0 to 1.
[[nodiscard, gnu::cold]] inline std::optional<SharedPlace>
shared_by_polygons(const SurfacePiece& one, SurfacePiece other, const glm::dvec3& way,
                   double distance) noexcept {
    const glm::dvec3 a = area_vector(one.facet), b = area_vector(other.facet);
    if (glm::length(a) == 0 || !slides(a, way)) return std::nullopt;
    const auto [low, high] =
        heights_of(other.facet, one.facet.corners[0], glm::normalize(a));
    if (!(std::abs(low) <= distance && std::abs(high) <= distance) ||
        glm::dot(a, b) == 0)
        return std::nullopt;
    if (way != glm::dvec3(0)) other.facet = around_way(other.facet, way);
    if (separated(one.facet, other.facet, distance) ||
        separated(other.facet, one.facet, distance))
        return std::nullopt;
    return SharedPlace{.box = box_of(other),
                       .over_area = true,
                       .alike = (glm::dot(a, b) < 0) !=
                                (one.inside_out == other.inside_out)};
}

/// The region that a polygon shares with a sphere or a tube; see shared_by_polygons().
[[nodiscard, gnu::cold]] inline std::optional<SharedPlace>
shared_with_polygon(const SurfacePiece& polygon, const SurfacePiece& round,
                    const glm::dvec3& way, double distance) noexcept {
    const glm::dvec3 a = area_vector(polygon.facet);
    if (glm::length(a) == 0 || !slides(a, way)) return std::nullopt;
    const glm::dvec3 normal = glm::normalize(a);
    SharedPlace place;
    bool touches = false;
    for (int i = 0; i < round.facet.count; ++i) {
        const glm::dvec3& center = round.facet.corners[std::size_t(i)];
        const double height = glm::dot(normal, center - polygon.facet.corners[0]);
        if (!(std::abs(std::abs(height) - round.radius) <= distance)) continue;
        touches = true;
        const glm::dvec3 touch = center - height * normal;
        for (const double time : {0.0, 1.0})
            place.box =
                box_union(place.box, around_touch(touch + time * round.displacement,
                                                  round.radius, distance));
    }
    return touches ? std::optional(place) : std::nullopt;
}

/// The region that two spheres or tubes share; see shared_by_polygons().
[[nodiscard, gnu::cold]] inline std::optional<SharedPlace>
shared_by_round(const SurfacePiece& one, const SurfacePiece& other,
                const glm::dvec3& way, double distance) noexcept {
    const auto axis_of = [](const SurfacePiece& piece) {
        return piece.facet.count == 2 ? piece.facet.corners[1] - piece.facet.corners[0]
                                      : glm::dvec3(0);
    };
    const glm::dvec3 a = axis_of(one), b = axis_of(other);
    const bool tubes = a != glm::dvec3(0) && b != glm::dvec3(0);
    const glm::dvec3 along = a != glm::dvec3(0) ? a : b;
    // Otherwise they touch only in one point, or only for an instant.
    if (!parallel(a, b) || !parallel(along, way) ||
        (along == glm::dvec3(0) && way != glm::dvec3(0)))
        return std::nullopt;
    const glm::dvec3 u = along != glm::dvec3(0) ? glm::normalize(along) : glm::dvec3(0);
    const glm::dvec3 from = other.facet.corners[0] - one.facet.corners[0];
    const glm::dvec3 across = from - glm::dot(from, u) * u;
    const double apart = glm::length(across);
    const double low = apart - other.radius, high = apart + other.radius;
    const bool at_low = std::abs(low + one.radius) <= distance;
    const bool at_high = std::abs(high - one.radius) <= distance;
    const bool outside = std::abs(low - one.radius) <= distance;
    if (!at_low && !at_high && !outside) return std::nullopt;
    // The interval along the axis that both pieces cover, at any time.
    const auto mine = heights_of(one.facet, one.facet.corners[0], u);
    const auto its = heights_of(other.facet, one.facet.corners[0], u);
    const double moved = glm::dot(way, u);
    const double first = std::max(mine[0], its[0] + std::min(moved, 0.0));
    const double last = std::min(mine[1], its[1] + std::max(moved, 0.0));
    // They meet only end to end, or not at all.
    if (!(last - first > (tubes ? distance : -distance))) return std::nullopt;
    SharedPlace place{.box = box_of(other),
                      .over_area =
                          at_low && at_high && one.facet.count == other.facet.count,
                      .alike = one.inside_out == other.inside_out};
    if (!outside || apart == 0) return place;
    place.box = {};
    for (const double at : {first, last})
        for (const double time : {0.0, 1.0})
            place.box = box_union(
                place.box,
                around_touch(one.facet.corners[0] + at * u +
                                 one.radius / apart * across + time * one.displacement,
                             std::min(one.radius, other.radius), distance));
    return place;
}

} // namespace detail

/// The region that two pieces of surfaces share at any time in [0, 1]. Surfaces within
/// `distance`, in scene units, count as coincident.
/// \return Nothing if the pieces cross, if they share only an edge or a corner, or if
///         they meet only for an instant.
[[nodiscard, gnu::cold]] inline std::optional<SharedPlace>
shared_place(const SurfacePiece& one, const SurfacePiece& other,
             double distance) noexcept {
    // The plane of the larger polygon is more accurate.
    if (one.radius > 0
            ? other.radius == 0
            : other.radius == 0 && glm::length(detail::area_vector(one.facet)) <
                                       glm::length(detail::area_vector(other.facet)))
        return shared_place(other, one, distance);
    glm::dvec3 way = other.displacement - one.displacement;
    if (glm::length(way) <= distance) way = glm::dvec3(0);
    const auto shared =
        one.radius > 0     ? detail::shared_by_round(one, other, way, distance)
        : other.radius > 0 ? detail::shared_with_polygon(one, other, way, distance)
                           : detail::shared_by_polygons(one, other, way, distance);
    if (!shared) return std::nullopt;
    const BoxT<double> box = detail::box_of(one), other_box = detail::box_of(other);
    SharedPlace place = *shared;
    place.box = {
        glm::max(place.box.low, glm::max(box.low, other_box.low) - distance),
        glm::min(place.box.high, glm::min(box.high, other_box.high) + distance)};
    if (glm::any(glm::greaterThan(place.box.low, place.box.high))) return std::nullopt;
    return place;
}

/// \}

} // namespace ljus
