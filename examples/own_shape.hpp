/// \file own_shape.hpp
/// \brief A shape of the reader's own: a box along the axes.
#pragma once
#include <cmath>

#include "ljus/geometry/shape.hpp"

/// Code that a reader of the book has written.
namespace reader {
/// A box with faces along the axes, given by two corners.
struct Crate {
    ljus::Vec3 low{-1}; ///< The corner of least x, y, z.
    ljus::Vec3 high{1}; ///< The opposite corner.
};

// [intersect]
/// The distance at which a ray enters the box or, from inside, leaves it. The ray is in
/// the box where it is between the two planes of all three axes. NaN is a miss.
inline std::optional<float> intersect(const ljus::Ray& ray, const Crate& box) {
    const ljus::Vec3 a = (box.low - ray.origin) / ray.direction;
    const ljus::Vec3 b = (box.high - ray.origin) / ray.direction;
    const float enter = ljus::max_component(glm::min(a, b));
    const float leave = -ljus::max_component(-glm::max(a, b));
    if (!(enter <= leave)) return std::nullopt;
    for (const float t : {enter, leave})
        if (ray.t_min <= t && t <= ray.t_max && std::isfinite(t)) return t;
    return std::nullopt;
}
// [intersect]

// [surface_point]
/// The point that a ray has hit. Its normal is along the axis on which the point is
/// farthest out, and the point is moved onto that face.
inline ljus::SurfacePoint surface_point(const Crate& box, const ljus::Ray& ray,
                                        const ljus::ShapeHitT<float>& hit) {
    const ljus::Vec3 middle = (box.low + box.high) / 2.0f;
    ljus::Vec3 x = point_at(ray, hit.t), normal{0};
    const ljus::Vec3 out = (x - middle) / (box.high - box.low);
    const ljus::Vec3 size = glm::abs(out);
    const int axis =
        size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
    normal[axis] = std::copysign(1.0f, out[axis]);
    x[axis] = out[axis] > 0 ? box.high[axis] : box.low[axis];
    return {.position = x, .error = 1e-6f * glm::abs(x), .normal = normal};
}
// [surface_point]

/// A sphere around the box.
inline ljus::Sphere bounding_sphere(const Crate& box) {
    return {(box.low + box.high) / 2.0f, glm::distance(box.low, box.high) / 2};
}

/// Refuses a box without an inside.
inline void check(const Crate& box) {
    const float least = -ljus::max_component(box.low - box.high);
    ljus::require_positive("crate.high - crate.low", least);
}
static_assert(ljus::Shape<Crate>);

} // namespace reader
