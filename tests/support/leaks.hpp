#pragma once

/// \file support/leaks.hpp
/// \brief Closed meshes, and rays from inside at their vertices and edges. A ray that
/// meets no triangle has leaked.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <utility>
#include <vector>

#include "ljus/geometry/triangle.hpp"
#include "ljus/geometry/watertight.hpp"
#include "support/numbers.hpp"

namespace ljus_test {

/// A closed and nearly convex mesh around a centre.
struct ClosedMesh {
    ljus::Vec3T<double> center{0};
    std::vector<ljus::Vec3> vertices{};
    std::vector<std::array<std::uint32_t, 3>> faces{};            ///< Counter-clockwise
                                                                  ///< from outside.
    std::vector<std::pair<std::uint32_t, std::uint32_t>> edges{}; ///< Each once.
    std::vector<ljus::Triangle> triangles{}; ///< The faces, as shapes.
};

/// Fills in the edges and the triangles.
inline void finish(ClosedMesh& mesh) {
    for (const auto& f : mesh.faces) {
        mesh.triangles.push_back(
            {mesh.vertices[f[0]], mesh.vertices[f[1]], mesh.vertices[f[2]]});
        for (std::size_t k = 0; k < 3; ++k)
            if (f[k] < f[(k + 1) % 3]) mesh.edges.push_back({f[k], f[(k + 1) % 3]});
    }
}

/// An octahedron whose faces are cut into four `level` times, which gives 8 * 4^level
/// triangles. The vertices are moved onto a ball and dented by up to 4 %.
inline ClosedMesh dented_ball(int level, double radius, ljus::Vec3T<double> center,
                              std::uint64_t seed = 1) {
    using V = ljus::Vec3T<double>;
    std::vector<V> points{{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                          {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    ClosedMesh mesh{.center = center};
    mesh.faces = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4},
                  {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
    for (int i = 0; i < level; ++i) {
        std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
        const auto middle = [&](std::uint32_t a, std::uint32_t b) {
            const auto [found, is_new] = middles.try_emplace(
                std::minmax(a, b), static_cast<std::uint32_t>(points.size()));
            if (is_new) points.push_back(glm::normalize(points[a] + points[b]));
            return found->second;
        };
        std::vector<std::array<std::uint32_t, 3>> finer;
        for (const auto [a, b, c] : mesh.faces) {
            const auto ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
            finer.push_back({a, ab, ca});
            finer.push_back({b, bc, ab});
            finer.push_back({c, ca, bc});
            finer.push_back({ab, bc, ca});
        }
        mesh.faces = finer;
    }
    Numbers n{seed};
    // Dents shrink with the faces, so that the whole stays nearly convex.
    const double dent = 0.04 / (1 << level);
    for (const V& p : points)
        mesh.vertices.push_back(
            ljus::Vec3(center + radius * (1 + n.between(-dent, dent)) * p));
    finish(mesh);
    return mesh;
}

/// A cube whose faces are cut into `cuts` x `cuts` squares of two triangles. Its edges
/// are parallel to the axes, as rays may be.
inline ClosedMesh cut_cube(int cuts, double half, ljus::Vec3T<double> center) {
    using V = ljus::Vec3T<double>;
    ClosedMesh mesh{.center = center};
    std::map<std::array<int, 3>, std::uint32_t> numbers;
    const auto vertex = [&](std::array<int, 3> at) {
        const auto [found, is_new] =
            numbers.try_emplace(at, static_cast<std::uint32_t>(mesh.vertices.size()));
        if (is_new)
            mesh.vertices.push_back(ljus::Vec3(
                center + half * (V(at[0], at[1], at[2]) * (2.0 / cuts) - 1.0)));
        return found->second;
    };
    for (std::size_t axis = 0; axis < 3; ++axis)
        for (const int side : {0, cuts})
            for (int i = 0; i < cuts; ++i)
                for (int j = 0; j < cuts; ++j) {
                    const auto at = [&](int di, int dj) {
                        std::array<int, 3> p{};
                        p[axis] = side;
                        p[(axis + 1) % 3] = i + di;
                        p[(axis + 2) % 3] = j + dj;
                        return vertex(p);
                    };
                    const auto p = at(0, 0), q = at(1, 0), r = at(1, 1), s = at(0, 1);
                    if (side) {
                        mesh.faces.push_back({p, q, r});
                        mesh.faces.push_back({p, r, s});
                    } else {
                        mesh.faces.push_back({p, r, q});
                        mesh.faces.push_back({p, s, r});
                    }
                }
    finish(mesh);
    return mesh;
}

/// The target of a ray.
enum class Aim {
    edge,   ///< A point of an edge. The direction has unit length.
    vertex, ///< A vertex. The direction has unit length.
    axis,   ///< A vertex or an edge, in the direction of an axis.
    tie     ///< A vertex or an edge. The direction leads to the target, often exactly.
};

/// A ray from within the mesh at a vertex or edge. For Aim::axis the direction
/// has two zeros, of either sign, and the ray starts close to its target.
inline ljus::Ray ray_at_seam(const ClosedMesh& mesh, Aim aim, Numbers& n) {
    using V = ljus::Vec3T<double>;
    const auto pick = [&n](const auto& from) {
        return from[static_cast<std::size_t>(n.below(static_cast<int>(from.size())))];
    };
    V target{pick(mesh.vertices)};
    if (aim == Aim::edge || (aim != Aim::vertex && n.next() < 0.5)) {
        const auto [a, b] = pick(mesh.edges);
        target = glm::mix(V(mesh.vertices[a]), V(mesh.vertices[b]), n.next());
    }
    const V out = target - mesh.center;
    if (aim == Aim::axis) {
        const ljus::Vec3 start(target); // two coordinates stay the same
        const V size = glm::abs(out);
        const int axis = size.x > size.y   ? (size.x > size.z ? 0 : 2)
                         : size.y > size.z ? 1
                                           : 2;
        ljus::Ray ray{.origin = start, .direction = ljus::Vec3{0}};
        for (int k = 0; k < 3; ++k)
            if (n.next() < 0.5) ray.direction[k] = -0.0f;
        ray.direction[axis] = static_cast<float>(out[axis] > 0 ? 1 : -1);
        ray.origin[axis] -= static_cast<float>(n.between(0.1, 0.9) * out[axis]);
        return ray;
    }
    // At most half of the way out, which is inside the mesh.
    const V origin = mesh.center + n.between(0, 0.5) * glm::length(out) * n.direction();
    ljus::Ray ray{.origin = ljus::Vec3(origin)};
    const V way = target - V(ray.origin);
    ray.direction = ljus::Vec3(aim == Aim::tie ? way : glm::normalize(way));
    return ray;
}

/// The number of rays from inside, among `count`, that meet nothing.
/// \param meets  Returns whether a ray hits the mesh, by any loop or tree.
template <typename Meets>
long count_leaks(const ClosedMesh& mesh, Aim aim, long count, Meets meets,
                 std::uint64_t seed = 1) {
    Numbers n{seed};
    long leaks = 0;
    for (long i = 0; i < count; ++i) leaks += !meets(ray_at_seam(mesh, aim, n));
    return leaks;
}

/// The number of rays that meet nothing, by a loop over all triangles.
/// \tparam Test  The intersection test: float, double or Watertight.
template <typename Test>
long loop_leaks(const ClosedMesh& mesh, Aim aim, long count) {
    return count_leaks(mesh, aim, count, [&](const ljus::Ray& ray) {
        const auto prepared = ljus::prepare<Test>(ray);
        for (const ljus::Triangle& triangle : mesh.triangles)
            if (ljus::intersect<Test>(ray, triangle, prepared)) return true;
        return false;
    });
}

} // namespace ljus_test
