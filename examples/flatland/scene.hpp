#pragma once

/// \file flatland/scene.hpp
/// \brief A scene of the plane: segments and circles, and the first hit of a ray.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <variant>
#include <vector>

#include "flatland/material.hpp"
#include "ljus/math/require.hpp"

namespace flatland {

using ljus::require, ljus::require_unit;

// Section 3.1 in two dimensions: walls are segments, and balls are circles.

/// A ray, and the range of distances in which hits count.
/// \report{Definition 3.1}
struct Ray {
    Vec2 origin{0};        ///< The start of the ray.
    Vec2 direction{0, -1}; ///< Unit vector.
    double t_min = 1e-9;   ///< Least distance of a hit. It is above 0, so that a ray
                           ///< does not hit the surface where it starts.
    double t_max = std::numeric_limits<double>::infinity(); ///< Largest distance of a
                                                            ///< hit.
};

/// A wall. Its normal points to the left when going from `from` to `to`.
struct Segment {
    Vec2 from{0};  ///< One end.
    Vec2 to{1, 0}; ///< The other end.
};

/// A ball, or a lamp. Its normal points outwards.
/// \report{Definition 3.2}
struct Circle {
    Vec2 center{0};    ///< Its centre.
    double radius = 1; ///< Its radius, above 0.
};

/// Any shape of a scene.
using Shape = std::variant<Segment, Circle>;

/// A point of a surface.
struct SurfacePoint {
    Vec2 position{0};  ///< Position, in metres.
    Vec2 normal{0, 1}; ///< Unit normal.
};

/// A shape, its material and its emission.
struct Object {
    Shape shape{};       ///< Its shape and position.
    Material material{}; ///< Its material.
    double emission = 0; ///< Radiance, W/(m rad), on the side of the normal.
};

/// A scene.
struct Scene {
    std::vector<Object> objects{}; ///< Objects, in any order.
};

/// The hit of a ray on an object.
struct Hit {
    double t = 0;       ///< Distance.
    std::size_t id = 0; ///< The object's index in Scene::objects.
};

/// The distance t at which a ray with origin O and direction D meets a segment from A
/// to B. The point satisfies \f$ O + tD = A + s (B - A) \f$ with s in [0, 1]. The cross
/// product of both sides with B - A gives t, and that with D gives s.
/// \param ray      The ray.
/// \param segment  The segment.
/// \return The distance t; nothing for a miss.
/// \report{Section 3.1.5}
// [intersect segment]
[[nodiscard]] inline std::optional<double> intersect(const Ray& ray,
                                                     const Segment& segment) noexcept {
    const auto cross = [](const Vec2& a, const Vec2& b) {
        return a.x * b.y - a.y * b.x;
    };
    const Vec2 along = segment.to - segment.from;
    const Vec2 way = segment.from - ray.origin;
    const double det = cross(ray.direction, along);
    const double t = cross(way, along) / det;
    const double s = cross(way, ray.direction) / det;
    if (!(0 <= s && s <= 1)) return std::nullopt; // written so that NaN is a miss
    if (!(ray.t_min <= t && t <= ray.t_max)) return std::nullopt;
    return t;
}
// [intersect segment]

/// The distance at which a ray meets a circle, by the formula for a ball in chapter 6.
/// \param ray     The ray.
/// \param circle  The circle.
/// \return The smaller distance within the range of the ray; nothing for a miss.
/// \report{Section 3.1.4, Eqs. (2) and (3)}
// [intersect circle]
[[nodiscard]] inline std::optional<double> intersect(const Ray& ray,
                                                     const Circle& circle) noexcept {
    const Vec2 m = ray.origin - circle.center;
    const double b = -glm::dot(m, ray.direction);
    const Vec2 closest = m + b * ray.direction;
    const double discriminant =
        circle.radius * circle.radius - glm::dot(closest, closest);
    if (!(discriminant >= 0)) return std::nullopt;
    const double half_chord = std::sqrt(discriminant);
    for (const double t : {b - half_chord, b + half_chord})
        if (ray.t_min <= t && t <= ray.t_max) return t;
    return std::nullopt;
}
// [intersect circle]

/// The unit normal of a segment, which is the same everywhere.
[[nodiscard]] inline Vec2 normal(const Segment& segment, const Vec2&) noexcept {
    const Vec2 along = glm::normalize(segment.to - segment.from);
    return {-along.y, along.x};
}

/// The unit normal of a circle at one of its points.
[[nodiscard]] inline Vec2 normal(const Circle& circle, const Vec2& point) noexcept {
    return (point - circle.center) / circle.radius;
}

/// The length of a segment, in place of an area.
[[nodiscard]] inline double length(const Segment& segment) noexcept {
    return glm::distance(segment.from, segment.to);
}

/// The length of a circle.
[[nodiscard]] inline double length(const Circle& circle) noexcept {
    return 2 * std::numbers::pi * circle.radius;
}

/// The length of a shape.
[[nodiscard]] inline double length(const Shape& shape) {
    return std::visit([](const auto& s) { return length(s); }, shape);
}

/// The first hit of a ray.
/// \param scene  The scene.
/// \param ray    The ray.
/// \return The hit; nothing if the ray leaves the scene.
/// \cost A loop over all objects. Larger scenes need the tree of chapter 8.
// [closest_hit]
[[nodiscard]] inline std::optional<Hit> closest_hit(const Scene& scene, Ray ray) {
    std::optional<Hit> closest;
    for (std::size_t id = 0; id < scene.objects.size(); ++id) {
        const auto t = std::visit([&](const auto& s) { return intersect(ray, s); },
                                  scene.objects[id].shape);
        if (!t) continue;
        ray.t_max = *t;
        closest = Hit{*t, id};
    }
    return closest;
}
// [closest_hit]

/// Whether anything lies between two points.
/// \param scene  The scene.
/// \param from   One point.
/// \param to     The other point.
[[nodiscard]] inline bool occluded(const Scene& scene, const Vec2& from,
                                   const Vec2& to) {
    Ray ray{.origin = from, .direction = glm::normalize(to - from)};
    ray.t_max = glm::distance(from, to) - ray.t_min;
    return closest_hit(scene, ray).has_value();
}

/// Checks all objects of a scene. Coordinates and sizes must be those of rooms, because
/// Ray::t_min is a fixed distance. It must be small compared with objects, and large
/// compared with rounding errors.
/// \param scene  The scene.
/// \throws std::invalid_argument  if a number is out of range, with its name and value.
inline void check(const Scene& scene) {
    constexpr double largest = 1000;
    const auto require_near = [](const Vec2& p) {
        const double far = std::max(std::abs(p.x), std::abs(p.y));
        require(std::isfinite(p.x) && std::isfinite(p.y) && far <= largest,
                "the larger coordinate of a point", far, "at most 1000");
    };
    for (const Object& object : scene.objects) {
        if (const auto* segment = std::get_if<Segment>(&object.shape)) {
            require_near(segment->from);
            require_near(segment->to);
        } else {
            require_near(std::get<Circle>(object.shape).center);
        }
        const double size = length(object.shape);
        require(size >= 1e-6 && size <= 10 * largest, "the length of a shape", size,
                "within [1e-6, 10000]");
        if (const auto* matt = std::get_if<Lambertian>(&object.material))
            require_unit("lambertian.albedo", matt->albedo);
        if (const auto* mirror = std::get_if<Mirror>(&object.material))
            require_unit("mirror.reflectance", mirror->reflectance);
        if (const auto* glass = std::get_if<Glass>(&object.material))
            require(glass->index >= 0.1 && glass->index <= 10, "glass.index",
                    glass->index, "within [0.1, 10]");
        require(std::isfinite(object.emission) && object.emission >= 0,
                "object.emission", object.emission, "finite and at least 0");
    }
}

} // namespace flatland
