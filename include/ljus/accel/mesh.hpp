#pragma once

/// \file ljus/accel/mesh.hpp
/// \brief Many triangles as one shape, with a tree over them and smooth normals.

#include <utility>

#include "ljus/accel/bvh.hpp"
#include "ljus/accel/mesh_data.hpp"
#include "ljus/accel/triangle_bvh.hpp"
#include "ljus/math/piecewise_constant.hpp"

namespace ljus {

/// \defgroup mesh Meshes
/// \brief Triangles that form one shape. Chapter: \ref ch_triangle.
///
/// A mesh is one object: it has one material, can be one light, and is one target for
/// the photons of the caustics map. The order of a triangle's vertices determines its
/// outside. The normals of the vertices affect only the shading.
/// \{

namespace detail {

/// For each triangle, the sum of the areas up to and including that triangle.
/// `cross(triangle)` is the cross product of two edges.
template <std::floating_point T, typename Cross>
[[nodiscard]] std::vector<double> summed_areas(const MeshDataT<T>& data,
                                               const Cross& cross) {
    std::vector<double> sums; // double, because float would lose small areas
    sums.reserve(data.triangles.size());
    double area = 0;
    for (std::size_t i = 0; i < data.triangles.size(); ++i) {
        const TriangleT<T> one = triangle_of(data, i);
        if (has_area(one)) area += double(glm::length(cross(one))) / 2;
        sums.push_back(area);
    }
    return sums;
}

} // namespace detail

/// An immutable mesh. In float, a closed mesh with normals takes about 90 bytes per
/// triangle, including the tree. If no vertex is shared, it takes about 150 bytes with
/// normals, and 110 without.
template <std::floating_point T>
class MeshT {
public:
    /// The type of the tree: TriangleBvh in float, otherwise BvhT.
    using Tree = std::conditional_t<std::is_same_v<T, float>, TriangleBvh, BvhT<T>>;

    /// Builds the tree.
    /// \param data     Vertices and triangles. Triangles without an area are kept, but
    ///                 are never hit.
    /// \param threads  The number of threads that build the tree; 0 for all processors.
    /// \throws std::invalid_argument  if check() refuses the data, or if the total area
    ///         is not finite or not above 0.
    /// \cost O(n log n) for n triangles.
    explicit MeshT(MeshDataT<T> data, int threads = 0) : data_(std::move(data)) {
        check(data_);
        area_up_to_ = detail::summed_areas(
            data_, [](const TriangleT<T>& one) { return detail::cross_of_edges(one); });
        const double area = area_up_to_.back();
        const bool fits = static_cast<T>(area) > T(0) && std::isfinite(T(area));
        require(fits, "the area of the mesh", area, "above 0 and finite");
        const auto at = [this](std::uint32_t i) { return triangle(i); };
        if constexpr (std::is_same_v<T, float>) {
            tree_ = Tree(size(), at, threads);
        } else {
            std::vector<BoxT<T>> boxes;
            for (std::uint32_t i = 0; i < size(); ++i) boxes.push_back(bounds(at(i)));
            tree_ = Tree(boxes, {.threads = threads});
        }

        const BoxT<T> box = tree_.box();
        sphere_.center = T(0.5) * box.low + T(0.5) * box.high;
        sphere_.radius = T(0);
        for (const Vec3T<T>& p : data_.positions)
            sphere_.radius = glm::max(sphere_.radius, glm::distance(p, sphere_.center));
        sphere_.radius += detail::rounding_bound<T>(8) *
                          (sphere_.radius + max_component(glm::abs(sphere_.center)));
        require_positive("the radius around the mesh", sphere_.radius);
    }

    /// The number of triangles.
    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(data_.triangles.size());
    }
    /// The triangle with the index `part`, as in a ShapeHitT.
    [[nodiscard]] TriangleT<T> triangle(std::uint32_t part) const noexcept {
        return detail::triangle_of(data_, part);
    }
    /// The triangle at a slot of the tree. A TriangleBvh stores its triangles, which
    /// saves two reads of distant memory.
    [[nodiscard]] TriangleT<T> triangle_at(std::uint32_t slot) const noexcept {
        if constexpr (std::is_same_v<T, float>)
            return tree_.triangle(slot);
        else
            return triangle(tree_.primitive_ids()[slot]);
    }
    /// The vertices and triangles.
    [[nodiscard]] const MeshDataT<T>& data() const noexcept { return data_; }
    /// The tree over the triangles.
    [[nodiscard]] const Tree& tree() const noexcept { return tree_; }
    /// For each triangle, the sum of the areas up to and including that triangle.
    [[nodiscard]] const std::vector<double>& area_up_to() const noexcept {
        return area_up_to_;
    }
    /// A sphere around the mesh.
    [[nodiscard]] const SphereT<T>& sphere() const noexcept { return sphere_; }
    /// The size in bytes: vertices, triangles, areas and tree.
    [[nodiscard]] std::size_t bytes() const noexcept {
        const auto of = [](const auto& list) {
            return list.capacity() * sizeof(list[0]);
        };
        return of(data_.positions) + of(data_.normals) + of(data_.triangles) +
               of(data_.uv) + of(area_up_to_) + tree_.bytes() + sizeof(*this);
    }

private:
    MeshDataT<T> data_;
    Tree tree_;
    std::vector<double> area_up_to_;
    SphereT<T> sphere_;
};
using Mesh = MeshT<float>; ///< MeshT in float.

/// The nearest hit of a ray on a mesh, the same as in a loop over all triangles.
/// \tparam Compute  The precision of the arithmetic, or Watertight.
/// \return The hit. `part` is the index of the triangle, the lowest one if several hits
///         are equally near.
/// \cost Tests of O(log n) triangles on average, for n triangles.
// [intersect]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] LJUS_CORE_CLONES std::optional<ShapeHitT<T>>
intersect(const RayT<T>& ray, const MeshT<T>& mesh) {
    const auto prepared = prepare<Compute>(ray);
    NearestHitT<T> nearest =
        nearest_hit(mesh.tree(), ray, [&](std::uint32_t slot, const RayT<T>& rest) {
            return intersect<Compute>(rest, mesh.triangle_at(slot), prepared);
        });
    if (!nearest.found) return std::nullopt;
    nearest.at.part = nearest.number;
    return nearest.at;
}
// [intersect]

/// Whether a ray hits a mesh, for shadow rays. The first triangle that is found to be
/// hit ends the search.
template <typename Compute = void, std::floating_point T>
[[nodiscard]] LJUS_CORE_CLONES bool meets(const RayT<T>& ray, const MeshT<T>& mesh) {
    const auto prepared = prepare<Compute>(ray);
    return mesh.tree().any(ray, [&](std::uint32_t slot) {
        return intersect<Compute>(ray, mesh.triangle_at(slot), prepared).has_value();
    });
}

/// The point of a mesh that a ray hit, with the triangle's normal.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const MeshT<T>& mesh, const RayT<T>&,
                                             const ShapeHitT<T>& hit) noexcept {
    return point_at(mesh.triangle(hit.part), hit.u, hit.v);
}

/// The shading normal, interpolated between the normals of the vertices
/// \cite phong1975. `geometric` is the triangle's normal.
/// \return Unit vector within 90 degrees of `geometric`; `geometric` itself if the mesh
///         has no normals, or where the interpolated normal points to the triangle's
///         inside.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> shading_normal(const MeshT<T>& mesh, const ShapeHitT<T>& hit,
                                      const Vec3T<T>& geometric) noexcept {
    const auto& normals = mesh.data().normals;
    if (normals.empty()) return geometric;
    const auto& corner = mesh.data().triangles[hit.part];
    const Vec3T<T> n = (T(1) - hit.u - hit.v) * normals[corner[0]] +
                       hit.u * normals[corner[1]] + hit.v * normals[corner[2]];
    if (!(glm::dot(n, geometric) > T(0))) return geometric;
    return Vec3T<T>(glm::normalize(Vec3T<WideT<T>>(n)));
}

/// The texture coordinates of a hit, interpolated between the vertices; (hit.u, hit.v)
/// if the mesh has none.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const MeshT<T>& mesh,
                                           const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    const auto& uv = mesh.data().uv;
    if (uv.empty()) return {hit.u, hit.v};
    const auto& corner = mesh.data().triangles[hit.part];
    return (T(1) - hit.u - hit.v) * uv[corner[0]] + hit.u * uv[corner[1]] +
           hit.v * uv[corner[2]];
}

/// The directions in which the texture coordinates of a triangle grow.
/// \return The derivatives of the point with respect to u and v; 0 on a triangle whose
///         texture coordinates span no area. If the mesh has no texture coordinates,
///         two edges of the triangle.
template <std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 2>
texture_tangents(const MeshT<T>& mesh, const ShapeHitT<T>& hit) noexcept {
    const TriangleT<T> triangle = mesh.triangle(hit.part);
    const auto edges = texture_tangents(triangle, hit);
    const auto& uv = mesh.data().uv;
    if (uv.empty()) return edges;
    using Wide = WideT<T>;
    const auto& corner = mesh.data().triangles[hit.part];
    const Vec2T<Wide> first(uv[corner[0]]);
    const Vec2T<Wide> a = Vec2T<Wide>(uv[corner[1]]) - first;
    const Vec2T<Wide> b = Vec2T<Wide>(uv[corner[2]]) - first;
    const Wide area = a.x * b.y - a.y * b.x;
    if (!(std::abs(area) > Wide(0))) return {Vec3T<T>{T(0)}, Vec3T<T>{T(0)}};
    const Vec3T<Wide> e1(edges[0]), e2(edges[1]);
    return {Vec3T<T>((b.y * e1 - a.y * e2) / area),
            Vec3T<T>((a.x * e2 - b.x * e1) / area)};
}

/// Samples a point of a mesh, uniformly over its area.
/// \return The point. Its density is 1 / area per squared scene unit.
/// \cost O(log n) for n triangles.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const MeshT<T>& mesh,
                                           const Vec2T<T>& u) noexcept {
    const auto [part, left] = detail::choose_interval(mesh.area_up_to(), u.x);
    return sample_area(mesh.triangle(static_cast<std::uint32_t>(part)),
                       Vec2T<T>{left, u.y});
}

/// The area of a mesh, in squared scene units.
template <std::floating_point T>
[[nodiscard]] T area(const MeshT<T>& mesh) noexcept {
    return static_cast<T>(mesh.area_up_to().back());
}

/// A box around a mesh.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const MeshT<T>& mesh) noexcept {
    return mesh.tree().box();
}

/// A sphere around a mesh.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const MeshT<T>& mesh) noexcept {
    return mesh.sphere();
}

/// Refuses a mesh that was moved from; the constructor refuses all other invalid data.
/// \throws std::invalid_argument  if the mesh has no triangle.
template <std::floating_point T>
void check(const MeshT<T>& mesh) {
    require(mesh.size() > 0, "the number of a mesh's triangles", 0LL, "at least 1");
}

/// \}

} // namespace ljus
