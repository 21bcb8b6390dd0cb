#pragma once

/// \file ljus/accel/mesh.hpp
/// \brief Many triangles as one shape, with a tree over them and smooth normals.

#include <utility>

#include "ljus/accel/bvh.hpp"
#include "ljus/accel/mesh_data.hpp"
#include "ljus/accel/triangle_bvh.hpp"

namespace ljus {

/// \defgroup mesh Meshes
/// \brief Triangles that belong together. Chapter: \ref ch_triangle.
///
/// A mesh is one shape: one object, one material, one light, and one target for the
/// photons of the caustics map. The winding of a triangle decides its sides, and from
/// where rays leave; the normals of the vertices only turn the frame of the material,
/// see vertex_at() and scatter().
/// \{

/// A mesh; made once, then fixed. In float about 90 bytes per triangle of a closed
/// mesh with normals, its tree included, and below 120 if no vertex is shared: bytes().
template <std::floating_point T>
class MeshT {
public:
    /// The fast tree, which is made of floats, or the plain one.
    using Tree = std::conditional_t<std::is_same_v<T, float>, TriangleBvh, BvhT<T>>;

    /// Builds the tree.
    /// \param data     What the mesh is made of; triangles without an area are kept,
    ///                 and never hit.
    /// \param threads  That build the tree; 0: all that there are.
    /// \throws std::invalid_argument  naming the number and the value: a mesh without
    ///         an area, a vertex that is not there, a coordinate that is not finite.
    /// \cost O(n log n).
    explicit MeshT(MeshDataT<T> data, int threads = 0) : data_(std::move(data)) {
        check(data_);
        area_up_to_.reserve(size());
        double area = 0;
        for (std::uint32_t i = 0; i < size(); ++i) {
            const TriangleT<T> one = triangle(i);
            if (detail::has_area(one))
                area += double(glm::length(detail::cross_of_edges(one))) / 2;
            area_up_to_.push_back(area);
        }
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

    /// How many triangles there are.
    [[nodiscard]] std::uint32_t size() const noexcept {
        return static_cast<std::uint32_t>(data_.triangles.size());
    }
    /// A triangle: the `part` of a hit.
    [[nodiscard]] TriangleT<T> triangle(std::uint32_t part) const noexcept {
        return detail::triangle_of(data_, part);
    }
    /// The triangle at a slot of the tree: triangle(tree().primitive_ids()[slot]). The
    /// fast tree has it at hand, and a search need not wait for two more parts of
    /// memory.
    [[nodiscard]] TriangleT<T> triangle_at(std::uint32_t slot) const noexcept {
        if constexpr (std::is_same_v<T, float>)
            return tree_.triangle(slot);
        else
            return triangle(tree_.primitive_ids()[slot]);
    }
    /// What the mesh is made of.
    [[nodiscard]] const MeshDataT<T>& data() const noexcept { return data_; }
    /// The tree over its triangles.
    [[nodiscard]] const Tree& tree() const noexcept { return tree_; }
    /// The area of the triangles up to each one, itself included; of nothing for none.
    [[nodiscard]] const std::vector<double>& area_up_to() const noexcept {
        return area_up_to_;
    }
    /// A sphere around it.
    [[nodiscard]] const SphereT<T>& sphere() const noexcept { return sphere_; }
    /// The memory that it takes: vertices, triangles, areas and tree.
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
    std::vector<double> area_up_to_; // in double: a float forgets the last of 1e5
    SphereT<T> sphere_;
};
using Mesh = MeshT<float>; ///< MeshT in float.

/// Where a ray first meets a mesh: what asking all its triangles in turn would find.
/// \tparam Compute  The precision of the arithmetic, or Watertight: as for one
/// triangle.
/// \param ray   Hits count in [t_min, t_max].
/// \param mesh  The mesh.
/// \return The nearest hit, `part` the triangle, the first one on a tie.
/// \cost In the mean O(log n) triangles.
// [intersect]
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<FlatHitT<T>> intersect(const RayT<T>& ray,
                                                   const MeshT<T>& mesh) {
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

/// Whether a ray meets a mesh at all: the question of a shadow ray, which the first
/// triangle answers that is met, not the nearest one.
/// \tparam Compute  As for intersect().
/// \param ray   Hits count in [t_min, t_max].
/// \param mesh  The mesh.
/// \return Whether intersect() would return a hit.
/// \cost In the mean O(log n) triangles, and fewer of them than intersect().
template <typename Compute = void, std::floating_point T>
[[nodiscard]] bool meets(const RayT<T>& ray, const MeshT<T>& mesh) {
    const auto prepared = prepare<Compute>(ray);
    return mesh.tree().any(ray, [&](std::uint32_t slot) {
        return intersect<Compute>(ray, mesh.triangle_at(slot), prepared).has_value();
    });
}

/// The point of a mesh that a ray hit; its normal is that of the triangle.
/// \param mesh  The mesh.
/// \param hit   What intersect() returned.
/// \return Position, its error bound, the geometric normal.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const MeshT<T>& mesh, const RayT<T>&,
                                             const FlatHitT<T>& hit) noexcept {
    return point_at(mesh.triangle(hit.part), hit.u, hit.v);
}

/// The normal that the material sees: that of the vertices, interpolated
/// \cite phong1975.
/// \param mesh       The mesh.
/// \param hit        What intersect() returned.
/// \param geometric  The triangle's normal.
/// \return Unit vector within 90 degrees of `geometric`; `geometric` itself if the mesh
///         has no normals, or where they do not point to the triangle's outer side.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> shading_normal(const MeshT<T>& mesh, const FlatHitT<T>& hit,
                                      const Vec3T<T>& geometric) noexcept {
    const auto& normals = mesh.data().normals;
    if (normals.empty()) return geometric;
    const auto& corner = mesh.data().triangles[hit.part];
    const Vec3T<T> n = (T(1) - hit.u - hit.v) * normals[corner[0]] +
                       hit.u * normals[corner[1]] + hit.v * normals[corner[2]];
    if (!(glm::dot(n, geometric) > T(0))) return geometric;
    return Vec3T<T>(glm::normalize(Vec3T<WideT<T>>(n)));
}

/// Where a mesh was hit on its texture: the coordinates of the vertices, interpolated.
/// \param mesh   The mesh.
/// \param hit    What intersect() returned.
/// \return (u, v); for a mesh without any, those of the triangle: `hit.u`, `hit.v`.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const MeshT<T>& mesh, const FlatHitT<T>& hit,
                                           const SurfacePointT<T>& /*point*/) noexcept {
    const auto& uv = mesh.data().uv;
    if (uv.empty()) return {hit.u, hit.v};
    const auto& corner = mesh.data().triangles[hit.part];
    return (T(1) - hit.u - hit.v) * uv[corner[0]] + hit.u * uv[corner[1]] +
           hit.v * uv[corner[2]];
}

/// A point of a mesh, uniform over its area: a triangle by its share, then a point of
/// it, from what the choice left of u.x.
/// \param mesh  The mesh.
/// \param u     Point of the unit square.
/// \return The point; density 1 / area per squared scene unit.
/// \cost O(log n).
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const MeshT<T>& mesh,
                                           const Vec2T<T>& u) noexcept {
    const auto& sums = mesh.area_up_to();
    const double wanted = double(u.x) * sums.back();
    // The first triangle up to which there is more; for u.x = 1, which rounding may
    // make, the last one that has an area.
    const auto first = [&](auto enough) {
        std::size_t low = 0, high = sums.size();
        while (low < high) {
            const std::size_t middle = low + (high - low) / 2;
            enough(sums[middle]) ? high = middle : low = middle + 1;
        }
        return low;
    };
    std::size_t found = first([&](double sum) { return sum > wanted; });
    if (found == sums.size())
        found = first([&](double sum) { return sum >= sums.back(); });
    const double before = found == 0 ? 0.0 : sums[found - 1];
    const double left = (wanted - before) / (sums[found] - before);
    const auto part = static_cast<std::uint32_t>(found);
    return sample_area(mesh.triangle(part), Vec2T<T>{T(left), u.y});
}

/// The area, in squared scene units.
template <std::floating_point T>
[[nodiscard]] T area(const MeshT<T>& mesh) noexcept {
    return static_cast<T>(mesh.area_up_to().back());
}

/// A box around a mesh.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const MeshT<T>& mesh) noexcept {
    return mesh.tree().box();
}

/// A sphere around a mesh: photons are aimed at it.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const MeshT<T>& mesh) noexcept {
    return mesh.sphere();
}

/// Refuses a mesh that was moved from; anything else was refused when it was made.
/// \throws std::invalid_argument  if it has no triangle.
template <std::floating_point T>
void check(const MeshT<T>& mesh) {
    require(mesh.size() > 0, "the number of a mesh's triangles", 0LL, "at least 1");
}

/// \}

} // namespace ljus
