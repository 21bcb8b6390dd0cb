#pragma once

/// \file course/room.hpp
/// \brief Given: a small room of spheres and quads, and the first hit of a ray in it.

#include <optional>
#include <variant>
#include <vector>

#include "ljus/geometry/shape.hpp"

namespace course {

using ljus::Ray, ljus::Rgb, ljus::SurfacePoint, ljus::Vec2, ljus::Vec3;

enum class Kind { diffuse, mirror, glass };

/// The material of an object.
struct Matter {
    Kind kind = Kind::diffuse;
    Rgb color{0.5f};    ///< Albedo of a diffuse object, reflectance of a mirror.
    Rgb emission{0};    ///< Radiance, on the side of the normal only.
    float index = 1.5f; ///< Index of refraction of glass; outside it is 1.
};

/// A shape and its matter. The normal of a sphere points outwards, that of a quad along
/// cross(edge_u, edge_v). Both sides of a diffuse object reflect.
struct Object {
    std::variant<ljus::Sphere, ljus::Quad> shape;
    Matter matter{};
};

/// A lamp without a size.
struct PointLamp {
    Vec3 position{0};
    Rgb intensity{1}; ///< W/sr
};

struct Room {
    std::vector<Object> objects{};
    std::vector<PointLamp> lamps{};
    Rgb sky{0}; ///< The radiance of a ray that meets nothing.
};

/// The surface that a ray has met.
struct Surface {
    const Object* object = nullptr;
    SurfacePoint point{}; ///< Position and normal; for spawn_ray().
    float t = 0;
};

/// The first surface that a ray meets; nothing if it leaves the room.
inline std::optional<Surface> nearest(const Room& room, Ray ray) {
    std::optional<Surface> found;
    for (const Object& object : room.objects) {
        const auto test = [&](const auto& shape) {
            const auto hit = intersect(ray, shape);
            if (!hit) return;
            const ljus::ShapeHitT<float> at = ljus::as_hit(*hit);
            ray.t_max = at.t;
            found = Surface{&object, surface_point(shape, ray, at), at.t};
        };
        std::visit(test, object.shape);
    }
    return found;
}

/// Whether nothing lies between two points of surfaces.
inline bool visible(const Room& room, const SurfacePoint& from,
                    const SurfacePoint& to) {
    return !nearest(room, ljus::spawn_ray_to(from, to));
}

/// Whether nothing lies between a point of a surface and a lamp without a size.
inline bool visible(const Room& room, const SurfacePoint& from, const Vec3& lamp) {
    return visible(room, from, SurfacePoint{.position = lamp, .normal = Vec3{0}});
}

/// The area of an object.
inline float area(const Object& object) {
    return std::visit([](const auto& shape) { return ljus::area(shape); },
                      object.shape);
}

/// A point of an object, uniform over its area: density 1/area.
inline SurfacePoint sample_area(const Object& object, Vec2 u) {
    return std::visit([&](const auto& shape) { return ljus::sample_area(shape, u); },
                      object.shape);
}

/// The emitted radiance that leaves a point of an object in a direction.
inline Rgb emitted(const Object& object, const SurfacePoint& point, const Vec3& way) {
    return dot(way, point.normal) > 0 ? object.matter.emission : Rgb{0};
}

/// The normal on the side from which a ray comes.
inline Vec3 facing(const Vec3& normal, const Vec3& direction) {
    return dot(normal, direction) < 0 ? normal : -normal;
}

} // namespace course
