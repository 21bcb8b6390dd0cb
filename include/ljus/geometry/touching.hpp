#pragma once

/// \file ljus/geometry/touching.hpp
/// \brief Whether two surfaces share an area or a point.

#include <algorithm>
#include <cmath>
#include <optional>

#include "ljus/geometry/box.hpp"
#include "ljus/geometry/facet.hpp"
#include "ljus/geometry/sphere.hpp"

namespace ljus {

/// \defgroup touching Surfaces in one place
/// \brief A slab that rests on a floor shares its plane. Chapter: \ref ch_refraction.
/// \{

/// A piece of a surface: a convex polygon or a sphere.
struct SurfacePiece {
    Facet facet{};                            ///< The polygon, if it has corners.
    SphereT<double> sphere{glm::dvec3(0), 0}; ///< Otherwise the sphere.
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
[[nodiscard]] inline BoxT<double> box_of(const SurfacePiece& piece) noexcept {
    if (piece.facet.count == 0)
        return {piece.sphere.center - piece.sphere.radius,
                piece.sphere.center + piece.sphere.radius};
    BoxT<double> box;
    for (int i = 0; i < piece.facet.count; ++i)
        box = box_union(box, piece.facet.corners[std::size_t(i)]);
    return box;
}

/// The intersection of two boxes, larger by a distance on all sides.
[[nodiscard]] inline BoxT<double>
common_box(const BoxT<double>& a, const BoxT<double>& b, double distance) noexcept {
    return {glm::max(a.low, b.low) - distance, glm::min(a.high, b.high) + distance};
}

/// The box within which a sphere of a radius is closer than a distance to the plane, or
/// to the larger sphere, that it touches in a point.
[[nodiscard]] inline BoxT<double> box_of_touch(const glm::dvec3& point, double radius,
                                               double distance) noexcept {
    const double half = std::sqrt(8 * radius * distance) + distance;
    return {point - half, point + half};
}

/// Whether an edge of one facet separates it from another one in their plane. Facets
/// that share an edge are separated.
[[nodiscard]] inline bool separated(const Facet& one, const glm::dvec3& normal,
                                    const Facet& other, double distance) noexcept {
    for (int i = 0; i < one.count; ++i) {
        const glm::dvec3& a = one.corners[std::size_t(i)];
        const glm::dvec3& b = one.corners[std::size_t((i + 1) % one.count)];
        const glm::dvec3 outwards = glm::normalize(glm::cross(b - a, normal));
        bool beyond = true;
        for (int k = 0; k < other.count && beyond; ++k)
            beyond = glm::dot(outwards, other.corners[std::size_t(k)] - a) >= -distance;
        if (beyond) return true;
    }
    return false;
}

/// The area that two facets share.
[[nodiscard]] inline std::optional<SharedPlace>
shared_by_facets(const Facet& one, const Facet& other, double distance) noexcept {
    const glm::dvec3 a = area_vector(one), b = area_vector(other);
    const double area_a = glm::length(a), area_b = glm::length(b);
    if (!(area_a > 0 && area_b > 0)) return std::nullopt;
    if (area_a < area_b) return shared_by_facets(other, one, distance);
    const glm::dvec3 normal = a / area_a; // the larger one knows its plane better
    for (int i = 0; i < other.count; ++i)
        if (!(std::abs(glm::dot(normal, other.corners[std::size_t(i)] -
                                            one.corners[0])) <= distance))
            return std::nullopt;
    if (separated(one, normal, other, distance) ||
        separated(other, b / area_b, one, distance))
        return std::nullopt;
    return SharedPlace{
        .box = common_box(box_of({.facet = one}), box_of({.facet = other}), distance),
        .over_area = true,
        .alike = glm::dot(a, b) > 0};
}

/// The point in which a sphere touches a facet's plane.
[[nodiscard]] inline std::optional<SharedPlace>
shared_by_ball(const Facet& facet, const SphereT<double>& ball,
               double distance) noexcept {
    const glm::dvec3 normal = area_vector(facet) / glm::length(area_vector(facet));
    const double height = glm::dot(normal, ball.center - facet.corners[0]);
    if (!(std::abs(std::abs(height) - ball.radius) <= distance)) return std::nullopt;
    return SharedPlace{.box = common_box(box_of({.facet = facet}),
                                         box_of_touch(ball.center - height * normal,
                                                      ball.radius, distance),
                                         distance)};
}

/// What two spheres share: all if they are equal, a point if they touch from outside or
/// inside.
[[nodiscard]] inline std::optional<SharedPlace>
shared_by_spheres(const SphereT<double>& a, const SphereT<double>& b,
                  double distance) noexcept {
    const glm::dvec3 way = b.center - a.center;
    const double apart = glm::length(way), less = std::min(a.radius, b.radius);
    if (apart + std::abs(a.radius - b.radius) <= distance)
        return SharedPlace{
            .box = common_box(box_of({.sphere = a}), box_of({.sphere = b}), distance),
            .over_area = true,
            .alike = true};
    if (std::abs(apart - (a.radius + b.radius)) <= distance)
        return SharedPlace{
            .box = box_of_touch(a.center + a.radius / apart * way, less, distance)};
    if (std::abs(apart - std::abs(a.radius - b.radius)) <= distance)
        return SharedPlace{
            .box = common_box(box_of({.sphere = a}), box_of({.sphere = b}), distance)};
    return std::nullopt;
}

} // namespace detail

/// What two pieces of surfaces share.
/// \param one, other  The pieces.
/// \param distance    Surfaces within this distance count as in one place; scene units.
/// \return The place; nothing if they cross, or only share an edge or a corner.
// [shared_place]
[[nodiscard]] inline std::optional<SharedPlace> shared_place(const SurfacePiece& one,
                                                             const SurfacePiece& other,
                                                             double distance) noexcept {
    const bool flat = one.facet.count > 0, other_flat = other.facet.count > 0;
    auto shared =
        flat && other_flat ? detail::shared_by_facets(one.facet, other.facet, distance)
        : flat             ? detail::shared_by_ball(one.facet, other.sphere, distance)
        : other_flat       ? detail::shared_by_ball(other.facet, one.sphere, distance)
                     : detail::shared_by_spheres(one.sphere, other.sphere, distance);
    if (!shared) return shared;
    shared->alike = shared->alike == (one.inside_out == other.inside_out);
    return shared;
}
// [shared_place]

/// \}

} // namespace ljus
