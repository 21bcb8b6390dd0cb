#pragma once

/// \file support/triangle_soups.hpp
/// \brief Unconnected triangles, rays of all kinds, and the expected hits.

#include <cstdint>
#include <limits>
#include <vector>

#include "ljus/accel/bvh.hpp"
#include "ljus/geometry/shape.hpp"
#include "support/numbers.hpp"

namespace ljus_test {

using ljus::Box;
using ljus::Ray;
using ljus::Triangle;
using ljus::Vec3;
using Triangles = std::vector<Triangle>;

inline std::vector<Box> boxes_of(const Triangles& triangles) {
    std::vector<Box> boxes;
    for (const Triangle& triangle : triangles) boxes.push_back(bounds(triangle));
    return boxes;
}

/// The expected hit: the nearest one, and among equally near ones that of the first
/// triangle.
struct Found {
    std::uint32_t number = ~0u;
    float t = std::numeric_limits<float>::infinity(), u = 0, v = 0;
    bool operator==(const Found&) const = default;
};

inline Found by_loop(const Triangles& triangles, const Ray& ray) {
    Found found;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const auto hit = intersect<double>(ray, triangles[i]);
        if (hit && hit->t < found.t) found = {i, hit->t, hit->u, hit->v};
    }
    return found;
}

/// The triangle at a slot of a tree, from the tree's own copy if it has one.
template <typename Tree>
Triangle triangle_at(const Tree& tree, const Triangles& triangles, std::uint32_t slot) {
    if constexpr (requires { tree.triangle(slot); })
        return tree.triangle(slot);
    else
        return triangles[tree.primitive_ids()[slot]];
}

template <typename Tree>
Found by_tree(const Tree& tree, const Triangles& triangles, const Ray& ray) {
    ljus::NearestHit nearest;
    tree.closest(ray, [&](std::uint32_t slot, Ray& rest) {
        const Triangle triangle = triangle_at(tree, triangles, slot);
        if (const auto hit = intersect<double>(rest, triangle))
            nearest.offer(*hit, tree.primitive_ids()[slot], rest);
    });
    if (!nearest.found) return {};
    return {nearest.number, nearest.at.t, nearest.at.u, nearest.at.v};
}

template <typename Tree>
bool any_by_tree(const Tree& tree, const Triangles& triangles, const Ray& ray) {
    return tree.any(ray, [&](std::uint32_t slot) {
        return intersect<double>(ray, triangle_at(tree, triangles, slot)).has_value();
    });
}

inline Triangles soup(Numbers& n, int count, double room, double size,
                      const Vec3& place) {
    Triangles triangles;
    for (int i = 0; i < count; ++i) {
        const Vec3 at = place + Vec3(n.point(room));
        triangles.push_back({at, at + Vec3(n.point(size)), at + Vec3(n.point(size))});
    }
    return triangles;
}

/// Difficult triangles of a given scale: 64 equal ones, some in the plane x = 0, and
/// some without an area.
inline Triangles hard_soup(Numbers& n, double scale) {
    Triangles triangles = soup(n, 100, 5 * scale, scale, Vec3{0});
    for (int i = 0; i < 64; ++i) triangles.push_back(triangles[7]);
    for (int i = 0; i < 20; ++i) {
        Triangle flat = triangles[std::size_t(i)];
        flat.v1.x = flat.v2.x = flat.v3.x = 0;
        triangles.push_back(flat);
        flat.v3 = flat.v1;
        triangles.push_back(flat);
    }
    return triangles;
}

/// A random ray of some kind: parallel to an axis or nearly so, with zeros of both
/// signs, or with a limited range of distances.
inline Ray some_ray(Numbers& n, double room, const Vec3& place) {
    const Vec3 origin = place + Vec3(n.point(2 * room));
    Ray ray{.origin = origin, .direction = place + Vec3(n.point(room)) - origin};
    for (int axis = 0; axis < 3; ++axis) {
        const int what = n.below(12);
        if (what == 0) ray.direction[axis] = 0.0f;
        if (what == 1) ray.direction[axis] = -0.0f;
        if (what == 2) ray.direction[axis] *= 1e-15f;
    }
    if (n.below(4) == 0) ray.t_max = float(n.between(0, 2));
    if (n.below(4) == 0) ray.t_min = float(n.between(0, 1));
    return ray;
}

} // namespace ljus_test
