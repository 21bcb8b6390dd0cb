#pragma once

/// \file ljus/scene/query.hpp
/// \brief What a ray meets first, and whether anything is in its way.

#include <optional>
#include <type_traits>

#include "ljus/geometry/texture_coordinates.hpp"
#include "ljus/scene/scene.hpp"

namespace ljus {

/// \defgroup query Scene queries
/// \brief Section 3.1: "determine the first object intersected by a ray".
/// \{

/// The first object that a ray meets.
template <std::floating_point T>
struct SceneHitT {
    FlatHitT<T> at{};  ///< Distance, and the shape's own coordinates.
    ObjectId object{}; ///< Which object.
};

/// Where a ray meets a shape of any type, in the arithmetic that is asked for, if the
/// shape has a choice.
/// \tparam Compute  As for intersect().
/// \param ray    Hits count in [t_min, t_max].
/// \param shape  The shape.
/// \return The hit; nothing for a miss.
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] std::optional<FlatHitT<T>> hit_of(const RayT<T>& ray, const S& shape) {
    const auto hit = [&] {
        if constexpr (requires { intersect<Compute>(ray, shape); })
            return intersect<Compute>(ray, shape);
        else
            return intersect(ray, shape);
    }();
    if (!hit) return std::nullopt;
    return as_hit(*hit);
}

/// Whether a ray meets a shape of any type: by the shape's own meets(), if it has one
/// that is done sooner than its intersect(), as a mesh has.
/// \tparam Compute  As for intersect().
/// \param ray    Hits count in [t_min, t_max].
/// \param shape  The shape.
/// \return Whether hit_of() would return a hit.
// [is_met]
template <typename Compute, std::floating_point T, typename S>
[[nodiscard]] bool is_met(const RayT<T>& ray, const S& shape) {
    if constexpr (requires { meets<Compute>(ray, shape); })
        return meets<Compute>(ray, shape);
    else
        return hit_of<Compute>(ray, shape).has_value();
}
// [is_met]

/// The first object that a ray meets, by asking every shape in turn: the exact twin of
/// the tree in an IndexedScene.
/// \tparam Compute  The arithmetic, as for intersect().
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return The nearest hit, the earlier object on a tie; nothing for a miss.
/// \cost One intersection a shape.
// [closest_hit]
template <typename Compute = void, typename Scene, std::floating_point T>
[[nodiscard]] std::optional<SceneHitT<T>> closest_hit(const Scene& scene, RayT<T> ray) {
    std::optional<SceneHitT<T>> closest;
    std::uint32_t type = 0;
    const auto ask_all = [&](const auto& shapes) {
        for (std::uint32_t i = 0; i < shapes.size(); ++i) {
            const auto found = hit_of<Compute>(ray, shapes[i]);
            if (!found || (closest && !(found->t < ray.t_max))) continue;
            ray.t_max = found->t;
            closest = SceneHitT<T>{*found, {type, i}};
        }
        ++type;
    };
    std::apply([&](const auto&... shapes) { (ask_all(shapes), ...); }, scene.shapes);
    return closest;
}
// [closest_hit]

/// Whether anything lies on a ray: the question of a shadow ray.
/// \tparam Compute  The arithmetic, as for intersect().
/// \param scene  The scene.
/// \param ray    Hits count in [t_min, t_max].
/// \return True at the first hit found, whichever it is.
template <typename Compute = void, typename Scene, std::floating_point T>
[[nodiscard]] bool occluded(const Scene& scene, const RayT<T>& ray) {
    const auto any = [&](const auto& shapes) {
        for (const auto& shape : shapes)
            if (is_met<Compute>(ray, shape)) return true;
        return false;
    };
    return std::apply([&](const auto&... shapes) { return (any(shapes) || ...); },
                      scene.shapes);
}

/// A point of an object, ready to be shaded.
template <std::floating_point T>
struct SurfaceT {
    SurfacePointT<T> point{}; ///< Position, error bound, normal of the outer side.
    FrameT<T> frame{};        ///< Materials work in it: around the shading normal.
    ObjectT<T> object{};      ///< What it is made of, and whether it shines.
    Vec2T<T> uv{T(0)};        ///< Of texture_coordinates(), if the material uses it.
    bool smooth = false;      ///< Whether frame.normal differs from point.normal.
    bool turned = false;      ///< Whether the ray came from different sides of the two.
};

/// The surface at a hit.
///
/// The geometric normal decides on which side a direction is. A ray that comes from
/// different sides of the two normals finds the frame around the geometric one: so the
/// z of its way back always tells the side, and no surface is seen from behind.
/// \param scene  The scene.
/// \param ray    The ray that hit.
/// \param hit    What closest_hit() returned.
/// \return The point, its frame, its object.
// [surface_at]
template <typename Scene, std::floating_point T>
[[nodiscard]] SurfaceT<T> surface_at(const Scene& scene, const RayT<T>& ray,
                                     const SceneHitT<T>& hit) {
    SurfaceT<T> surface{.object = scene.object(hit.object)};
    const bool uses_uv =
        scene.visit_material(surface.object.material, [](const auto& m) {
            return UsesUv<std::remove_cvref_t<decltype(m)>>;
        });
    Vec3T<T>& geometric = surface.point.normal;
    Vec3T<T> normal = scene.visit_shape(hit.object, [&](const auto& shape) {
        surface.point = surface_point(shape, ray, hit.at);
        if (uses_uv) surface.uv = texture_coordinates(shape, hit.at, surface.point);
        if constexpr (requires { shading_normal(shape, hit.at, geometric); })
            return shading_normal(shape, hit.at, geometric);
        else
            return geometric;
    });
    surface.smooth = normal != geometric;
    if (surface.object.inside_out) {
        geometric = -geometric;
        normal = -normal;
    }
    if (surface.smooth) {
        surface.turned = (glm::dot(ray.direction, geometric) < T(0)) !=
                         (glm::dot(ray.direction, normal) < T(0));
        surface.smooth = !surface.turned;
    }
    surface.frame = frame_around(surface.turned ? geometric : normal);
    return surface;
}
// [surface_at]

/// Calls f(material) with what a surface is made of where the ray met it: what
/// visit_material() does for an object, this does for a place of it. A textured
/// material is its base in another colour there; all others are themselves.
/// \param scene    The scene.
/// \param surface  Of surface_at().
/// \param f        Called with the material, as its own type.
// [visit_material_of]
template <typename Scene, std::floating_point T, typename F>
decltype(auto) visit_material_of(const Scene& scene, const SurfaceT<T>& surface,
                                 F&& f) {
    return scene.visit_material(surface.object.material, [&](const auto& m) {
        using Here = decltype(material_at(m, surface.point.position, surface.uv));
        // A soap film's point is no material: scatter() asks for it.
        if constexpr (Material<std::remove_cvref_t<Here>>)
            return f(material_at(m, surface.point.position, surface.uv));
        else
            return f(m);
    });
}
// [visit_material_of]

/// \}

} // namespace ljus
