#pragma once

/// \file ljus/accel/instances.hpp
/// \brief Instances: a mesh that is placed many times by affine maps.

#include <array>
#include <string>

#include "ljus/accel/mesh.hpp"
#include "ljus/math/affine.hpp"
#include "ljus/ref.hpp"

namespace ljus {

/// \defgroup instances Instances
/// \brief One mesh in many places. Chapter: \ref ch_instances.
///
/// An instance is a reference to a mesh with an affine map. The inverse map transforms
/// a ray to the space of the mesh \cite rubin1980. If Instance is among the Shapes of a
/// scene, the scene keeps the meshes:
///
///     const auto knot = scene.add(Mesh(data)); // kept once, and not visible itself
///     for (const Affine& place : places) scene.add(Instance(knot, place), glass);
/// \{

namespace detail {

/// An upper bound on |M v| for every vector v with |v| <= size. M is the linear part of
/// the map. Absolute values and comparisons are taken component by component.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> transform_sizes(const AffineT<T>& map,
                                       const Vec3T<T>& size) noexcept {
    return size.x * sizes(map[0]) + size.y * sizes(map[1]) + size.z * sizes(map[2]);
}

/// A bound on the terms that are added when a vector v with |v| <= size is transformed
/// by the inverse map and then by the map. Their absolute values are summed. This sum
/// times the relative rounding error of the inverse map is a bound on the error of the
/// result.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> there_and_back(const AffineT<T>& map, const AffineT<T>& back,
                                      const Vec3T<T>& size) noexcept {
    return transform_sizes(map, transform_sizes(back, size));
}

/// For each triangle of the placed mesh, the sum of the areas of all triangles up to
/// and including it.
template <std::floating_point T>
[[nodiscard]] std::vector<double> placed_areas(const MeshT<T>& mesh,
                                               const AffineT<T>& place) {
    using Wide = Vec3T<WideT<T>>;
    const AffineT<WideT<T>> map(place);
    return summed_areas(mesh.data(), [&](const TriangleT<T>& local) {
        const Wide v1(local.v1);
        return glm::cross(transform_vector(map, Wide(local.v2) - v1),
                          transform_vector(map, Wide(local.v3) - v1));
    });
}

} // namespace detail

/// A mesh placed by an affine map. In float an instance takes 168 bytes, whatever the
/// size of the mesh.
template <std::floating_point T>
class InstanceT {
public:
    using Wide = WideT<T>; ///< Precision of the inverse map; double if T is float.

    /// The data of an instance.
    struct Data {
        const MeshDataT<T>& mesh;          ///< Vertices and triangles.
        std::array<Vec3T<T>, 4> columns{}; ///< The columns of the map.
    };

    /// Places a mesh.
    /// \param mesh   The mesh, which must outlive the instance; a scene keeps a mesh
    ///               that was given to Scene::add().
    /// \param place  The map from the mesh to the scene. If it mirrors, the outside of
    ///               the mesh remains outside.
    /// \throws std::invalid_argument  if the mesh was moved from, if the map is not
    ///         finite or has no inverse, if the map's condition number is above 1e8, or
    ///         if the instance's area is not finite or not above 0.
    /// \cost O(n) for n triangles, whose areas are summed. O(1) if the map stretches
    ///       all directions by the same factor.
    explicit InstanceT(Ref<MeshT<T>> mesh, const AffineT<T>& place = AffineT<T>(1))
        : mesh_(mesh), place_(place) {
        check(mesh.get());
        for (int i = 0; i < 4; ++i)
            if (!is_finite(place[i]))
                require_finite("column " + std::to_string(i) + " of an instance's map",
                               place[i]);
        const AffineT<Wide> wide(place);
        const Wide volume = determinant_of(wide);
        require(volume != Wide(0), "the determinant of an instance's map", volume,
                "other than 0: a mesh without thickness has no inside");
        inverse_ = inverse_of(wide);
        const Wide condition =
            max_component(detail::there_and_back(wide, inverse_, Vec3T<Wide>(1)));
        require(condition <= Wide(1e8), "the condition number of an instance's map",
                condition, "at most 1e8; flatten a mesh only along its own axes");
        // The map is a similarity, up to rounding, if its determinant is the cube of
        // its largest stretch.
        scale_ = largest_stretch(wide);
        const Wide cube = scale_ * scale_ * scale_;
        if (!(std::abs(volume) >= cube * (1 - 16 * std::numeric_limits<T>::epsilon())))
            scale_ = 0;
        const double area =
            scale_ > 0 ? double(scale_ * scale_) * mesh.get().area_up_to().back()
                       : detail::placed_areas(mesh.get(), place).back();
        area_ = static_cast<T>(area);
        require_positive("the area of an instance", area_);
    }

    /// The mesh.
    [[nodiscard]] const MeshT<T>& mesh() const noexcept { return mesh_.get(); }
    /// The map from the mesh to the scene.
    [[nodiscard]] const AffineT<T>& place() const noexcept { return place_; }
    /// The map from the scene to the mesh.
    [[nodiscard]] const AffineT<Wide>& inverse_place() const noexcept {
        return inverse_;
    }
    /// The factor by which lengths grow, if it is the same in all directions; otherwise
    /// 0.
    [[nodiscard]] Wide scale() const noexcept { return scale_; }
    /// The area in the scene, in squared scene units.
    [[nodiscard]] T area() const noexcept { return area_; }
    /// The data of the instance. Saved photon maps and light maps contain a hash of it,
    /// so that a changed scene is noticed.
    [[nodiscard]] Data data() const noexcept {
        return {mesh().data(), {place_[0], place_[1], place_[2], place_[3]}};
    }
    /// The number of triangles.
    [[nodiscard]] std::uint32_t size() const noexcept { return mesh().size(); }
    /// The triangle with the index `part`, transformed to the scene. If the map
    /// mirrors, the second and the third vertex are exchanged, so that the triangle
    /// faces outwards.
    [[nodiscard]] TriangleT<T> triangle(std::uint32_t part) const noexcept {
        const TriangleT<T> local = mesh().triangle(part);
        const AffineT<Wide> wide(place_);
        const auto there = [&](const Vec3T<T>& v) {
            return Vec3T<T>(transform_point(wide, Vec3T<Wide>(v)));
        };
        const bool mirrors = determinant_of(inverse_) < Wide(0);
        return {there(local.v1), there(mirrors ? local.v3 : local.v2),
                there(mirrors ? local.v2 : local.v3)};
    }

    /// An instance displaced by a vector, in scene units.
    [[nodiscard]] friend InstanceT translated(const InstanceT& instance,
                                              const Vec3T<T>& by) noexcept {
        InstanceT moved = instance;
        moved.place_[3] += by;
        moved.inverse_[3] =
            -transform_vector(moved.inverse_, Vec3T<Wide>(moved.place_[3]));
        return moved;
    }

private:
    Ref<MeshT<T>> mesh_;
    AffineT<T> place_;
    AffineT<Wide> inverse_{};
    Wide scale_ = 0;
    T area_ = T(0);
};
using Instance = InstanceT<float>; ///< InstanceT in float.

namespace detail {

/// A ray transformed to the space of the mesh. The direction is not normalised, so that
/// t is the same for the mesh and in the scene.
// [ray_at_mesh]
template <std::floating_point T>
[[nodiscard]] RayT<T> ray_at_mesh(const InstanceT<T>& instance,
                                  const RayT<T>& ray) noexcept {
    using Wide = Vec3T<WideT<T>>;
    const auto& back = instance.inverse_place();
    return {.origin = Vec3T<T>(transform_point(back, Wide(ray.origin))),
            .direction = Vec3T<T>(transform_vector(back, Wide(ray.direction))),
            .t_min = ray.t_min,
            .t_max = ray.t_max,
            .time = ray.time};
}
// [ray_at_mesh]

/// Transforms a point of the mesh, on the triangle with the index `part`, to the scene.
///
/// The error of the result includes the rounding of a ray that leaves the point. When
/// this ray is transformed to the space of the mesh, its origin and its direction are
/// rounded, and the inverse map is inexact.
// [placed_point]
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> placed_point(const InstanceT<T>& instance,
                                            std::uint32_t part,
                                            const SurfacePointT<T>& local) noexcept {
    using Wide = Vec3T<WideT<T>>;
    const TriangleT<T> triangle = instance.mesh().triangle(part);
    const AffineT<WideT<T>> map(instance.place());
    const AffineT<WideT<T>>& back = instance.inverse_place();
    const Wide position = transform_point(map, Wide(local.position));
    const Wide normal = transform_normal(back, cross_of_edges(triangle));
    const Vec3T<T> reach =
        glm::max(glm::max(sizes(triangle.v1), sizes(triangle.v2)), sizes(triangle.v3));
    const Wide at_mesh(local.error + rounding_bound<T>(4) * reach);
    const Wide from_map = sizes(position) + sizes(map[3]);
    const Wide error =
        transform_sizes(map, at_mesh) +
        WideT<T>(rounding_bound<T>(2)) * sizes(position) +
        rounding_bound<WideT<T>>(16) * there_and_back(map, back, from_map);
    const WideT<T> tilt =
        local.tilt * max_component(there_and_back(map, back, Wide(1)));
    return {.position = Vec3T<T>(position),
            .error = Vec3T<T>(error),
            .normal = Vec3T<T>(glm::normalize(normal)),
            .tilt = T(tilt)};
}
// [placed_point]

} // namespace detail

/// The nearest hit of a ray on an instance.
/// \cost That of intersect() for the mesh, and 18 multiplications.
template <typename Compute = void, std::floating_point T>
[[nodiscard]] std::optional<ShapeHitT<T>> intersect(const RayT<T>& ray,
                                                    const InstanceT<T>& instance) {
    return intersect<Compute>(detail::ray_at_mesh(instance, ray), instance.mesh());
}

/// Whether a ray hits an instance, for shadow rays.
template <typename Compute = void, std::floating_point T>
[[nodiscard]] bool meets(const RayT<T>& ray, const InstanceT<T>& instance) {
    return meets<Compute>(detail::ray_at_mesh(instance, ray), instance.mesh());
}

/// The point of an instance that a ray hit, with the normal of the triangle.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> surface_point(const InstanceT<T>& instance,
                                             const RayT<T>&,
                                             const ShapeHitT<T>& hit) noexcept {
    const TriangleT<T> triangle = instance.mesh().triangle(hit.part);
    return detail::placed_point(instance, hit.part,
                                point_at(triangle, hit.u, hit.v, Vec3T<T>(0)));
}

/// The shading normal of the mesh at a hit, transformed to the scene. `geometric` is
/// the triangle's normal in the scene.
/// \return Unit vector within 90 degrees of `geometric`; `geometric` itself if the mesh
///         has no shading normal there.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> shading_normal(const InstanceT<T>& instance,
                                      const ShapeHitT<T>& hit,
                                      const Vec3T<T>& geometric) noexcept {
    const MeshT<T>& mesh = instance.mesh();
    if (mesh.data().normals.empty()) return geometric;
    const Vec3T<T> flat = normal(mesh.triangle(hit.part));
    const Vec3T<T> smooth = shading_normal(mesh, hit, flat);
    if (smooth == flat) return geometric;
    const Vec3T<T> n(glm::normalize(
        transform_normal(instance.inverse_place(), Vec3T<WideT<T>>(smooth))));
    return glm::dot(n, geometric) > T(0) ? n : geometric;
}

/// The texture coordinates of the mesh at a hit.
template <std::floating_point T>
[[nodiscard]] Vec2T<T> texture_coordinates(const InstanceT<T>& instance,
                                           const ShapeHitT<T>& hit,
                                           const SurfacePointT<T>& point) noexcept {
    return texture_coordinates(instance.mesh(), hit, point);
}

/// The texture tangents of the mesh at a hit, transformed to the scene.
template <std::floating_point T>
[[nodiscard]] std::array<Vec3T<T>, 2>
texture_tangents(const InstanceT<T>& instance, const ShapeHitT<T>& hit) noexcept {
    const auto [along_u, along_v] = texture_tangents(instance.mesh(), hit);
    return {transform_vector(instance.place(), along_u),
            transform_vector(instance.place(), along_v)};
}

/// For each triangle of the placed mesh, the sum of the areas of all triangles up to
/// and including it. A lamp keeps these sums for sample_area().
/// \return The sums. Empty if the map stretches all directions by the same factor:
///         then the sums of the mesh serve.
/// \cost O(n) time for n triangles, and 8 bytes per triangle.
template <std::floating_point T>
[[nodiscard]] std::vector<double> area_sums(const InstanceT<T>& instance) {
    if (instance.scale() > 0) return {};
    return detail::placed_areas(instance.mesh(), instance.place());
}

/// The area in the scene, in squared scene units.
template <std::floating_point T>
[[nodiscard]] T area(const InstanceT<T>& instance) noexcept {
    return instance.area();
}

/// Samples a point of an instance, uniformly over its area in the scene. `sums` is the
/// result of area_sums().
/// \return The point. Its density is 1 / area per squared scene unit.
/// \cost O(log n) for n triangles.
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const InstanceT<T>& instance,
                                           const Vec2T<T>& u,
                                           const std::vector<double>& sums) noexcept {
    const auto [chosen, left] = detail::choose_interval(
        sums.empty() ? instance.mesh().area_up_to() : sums, u.x);
    const auto part = static_cast<std::uint32_t>(chosen);
    return detail::placed_point(
        instance, part,
        sample_area(instance.mesh().triangle(part), Vec2T<T>{left, u.y}, Vec3T<T>(0)));
}

/// Samples a point of an instance uniformly. The function calls area_sums().
/// \cost That of area_sums().
template <std::floating_point T>
[[nodiscard]] SurfacePointT<T> sample_area(const InstanceT<T>& instance,
                                           const Vec2T<T>& u) {
    return sample_area(instance, u, area_sums(instance));
}

/// Samples a point by sample_area(), for an observer at `from`. The error of the point
/// includes the rounding of the shadow ray when it is transformed to the space of the
/// mesh.
/// \return The point and its density per steradian at the observer.
template <std::floating_point T>
[[nodiscard]] SeenPointT<T> sample_towards(const InstanceT<T>& instance,
                                           const Vec3T<T>& from, const Vec2T<T>& u,
                                           const std::vector<double>& sums) noexcept {
    using Wide = Vec3T<WideT<T>>;
    SurfacePointT<T> point = sample_area(instance, u, sums);
    const T pdf = detail::pdf_from_area(from, point, area(instance));
    const Wide way(detail::sizes(point.position - from));
    point.error += Vec3T<T>(WideT<T>(detail::rounding_bound<T>(4)) *
                            detail::there_and_back(AffineT<WideT<T>>(instance.place()),
                                                   instance.inverse_place(), way));
    return {point, pdf};
}

/// A box around an instance. The map turns the mesh's bounding sphere into an
/// ellipsoid, and its bounding box into a parallelepiped. The result is the
/// intersection of the boxes around the two.
template <std::floating_point T>
[[nodiscard]] BoxT<T> bounds(const InstanceT<T>& instance) noexcept {
    using Wide = Vec3T<WideT<T>>;
    const AffineT<WideT<T>> map(instance.place());
    const BoxT<T> box = bounds(instance.mesh());
    const SphereT<T>& sphere = instance.mesh().sphere();
    const Wide middle = transform_point(map, Wide(sphere.center));
    const Wide corner =
        detail::transform_sizes(map, glm::max(Wide(box.high) - Wide(sphere.center),
                                              Wide(sphere.center) - Wide(box.low)));
    const Wide round = WideT<T>(sphere.radius) *
                       glm::sqrt(map[0] * map[0] + map[1] * map[1] + map[2] * map[2]);
    const Wide half = glm::min(corner, round);
    const Wide slack = WideT<T>(detail::rounding_bound<T>(8)) *
                       (detail::sizes(middle) + detail::sizes(map[3]) + half);
    return {Vec3T<T>(middle - half - slack), Vec3T<T>(middle + half + slack)};
}

/// A sphere around an instance.
template <std::floating_point T>
[[nodiscard]] SphereT<T> bounding_sphere(const InstanceT<T>& instance) noexcept {
    using Wide = WideT<T>;
    const AffineT<Wide> map(instance.place());
    const SphereT<T>& sphere = instance.mesh().sphere();
    const Vec3T<Wide> center = transform_point(map, Vec3T<Wide>(sphere.center));
    const Wide radius = Wide(sphere.radius) * largest_stretch(map);
    const Wide slack = Wide(detail::rounding_bound<T>(8)) *
                       (radius + max_component(detail::sizes(center)) +
                        max_component(detail::sizes(map[3])));
    return {.center = Vec3T<T>(center), .radius = static_cast<T>(radius + slack)};
}

/// The mesh of an instance. The scene keeps this mesh.
template <std::floating_point T>
[[nodiscard]] const MeshT<T>& prototype(const InstanceT<T>& instance) noexcept {
    return instance.mesh();
}

/// Refuses an instance of a mesh that was moved from. The constructor refuses all other
/// invalid data.
/// \throws std::invalid_argument  as check() of the mesh.
template <std::floating_point T>
void check(const InstanceT<T>& instance) {
    check(instance.mesh());
}

/// \}

} // namespace ljus
