#pragma once

/// \file ljus/path/vertex.hpp
/// \brief The vertex of a path: everything that is known of the place where it arrived.

#include "ljus/geometry/shape.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/scene/world.hpp"

namespace ljus {

/// \defgroup vertex Vertices
/// \brief Section 3.2: where a ray has arrived, ready to be shaded.
/// \{

/// Where a path arrived. Every renderer and the photon pass see a surface as this.
template <std::floating_point T>
struct VertexT {
    SurfacePointT<T> point{};      ///< Position, rounding error, geometric normal.
    FrameT<T> frame{};             ///< Around the shading normal; materials work in it.
    Vec3T<T> wo{T(0), T(0), T(1)}; ///< To the vertex before: unit, in the frame.
    Vec2T<T> uv{T(0)};             ///< Of texture_coordinates(), if a material uses it.
    ObjectId id{};                 ///< Which object.
    ObjectT<T> object{};           ///< What it is made of, and whether it emits.
    RgbT<T> medium{T(0)};          ///< Absorption before it, per scene unit.
    T distance = T(0);             ///< From the vertex before, in scene units.
    T time = T(0);                 ///< Of the path, in [0, 1].
    T stop_probability = T(1);     ///< Of stopping here, at a thin surface.
    bool smooth = false; ///< Whether the shading normal is not the geometric one.
    bool turned = false; ///< Whether `wo` lies on different sides of the two.

    /// Whether the surface emits towards `wo`: emission is one-sided.
    [[nodiscard]] bool emits() const noexcept {
        return wo.z > T(0) && !is_black(object.emission);
    }
};
using Vertex = VertexT<float>; ///< VertexT in float.

namespace detail {

/// Whether a material looks up by texture coordinates; a comparison in a scene that
/// lists such a type, and nothing in any other.
/// \param world     The closed scene.
/// \param material  One of its materials.
template <AnyWorld W>
[[nodiscard]] bool uses_uv(const W& world, MaterialId material) {
    if constexpr (W::any_material([]<typename M>() { return UsesUv<M>; }))
        return world.visit_material(material, [](const auto& m) {
            return UsesUv<std::remove_cvref_t<decltype(m)>>;
        });
    else
        return false;
}

/// Sets the frame of a vertex where two normals may differ.
/// \param vertex  Its point and its object are set.
/// \param ray     The ray that hit.
/// \param normal  The shading normal, as the shape has it.
// [set_frame]
template <std::floating_point T>
inline void set_frame(VertexT<T>& vertex, const RayT<T>& ray, Vec3T<T> normal) {
    Vec3T<T>& geometric = vertex.point.normal;
    vertex.smooth = normal != geometric;
    if (vertex.object.inside_out) {
        geometric = -geometric;
        normal = -normal;
    }
    if (vertex.smooth) {
        vertex.turned = (glm::dot(ray.direction, geometric) < T(0)) !=
                        (glm::dot(ray.direction, normal) < T(0));
        vertex.smooth = !vertex.turned;
    }
    vertex.frame = frame_around(vertex.turned ? geometric : normal);
}
// [set_frame]

/// Sets a vertex to what vertex_at() returns. next_vertex() has the vertex in the
/// optional that it returns: a copy of these 160 bytes for each ray is slow.
/// \param vertex  A new one; all but its medium is set.
/// \param world   The closed scene.
/// \param ray     The ray that hit; its direction of unit length.
/// \param hit     What closest_hit() returned.
template <AnyWorld W, std::floating_point T>
inline void fill_vertex(VertexT<T>& vertex, const W& world, const RayT<T>& ray,
                        const SceneHitT<T>& hit) {
    vertex.id = hit.object;
    vertex.object = world.object(hit.object);
    vertex.distance = hit.at.t;
    vertex.time = ray.time;
    const Vec3T<T>& geometric = vertex.point.normal;
    world.visit_shape(hit.object, [&]<typename G>(const G& shape) {
        constexpr bool one_frame = is_plane<G>;
        if constexpr (one_frame) {
            vertex.frame = world.frame(hit.object);
            set_point(vertex.point,
                      point_at(shape, hit.at.u, hit.at.v, vertex.frame.normal));
        } else {
            set_point(vertex.point, surface_point(shape, ray, hit.at));
        }
        if (detail::uses_uv(world, vertex.object.material))
            vertex.uv = texture_coordinates(shape, hit.at, vertex.point);
        if constexpr (requires { shading_normal(shape, hit.at, geometric); })
            set_frame(vertex, ray, shading_normal(shape, hit.at, geometric));
        else if constexpr (!one_frame)
            set_frame(vertex, ray, geometric);
    });
    vertex.wo = to_local(vertex.frame, -ray.direction);
}

} // namespace detail

/// The vertex at a hit.
///
/// The geometric normal decides on which side a direction is. A ray that comes from
/// different sides of the two normals finds the frame around the geometric one: so the
/// z of `wo` always tells the side, and no surface is seen from behind.
/// \param world  The closed scene.
/// \param ray    The ray that hit; its direction of unit length.
/// \param hit    What closest_hit() returned.
/// \return The vertex; its medium is not known yet.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] VertexT<T> vertex_at(const W& world, const RayT<T>& ray,
                                   const SceneHitT<T>& hit) {
    VertexT<T> vertex;
    detail::fill_vertex(vertex, world, ray, hit);
    return vertex;
}

/// Calls f(material) with what a surface is made of at a vertex: what visit_material()
/// does for an object, this does for a place of it. A textured material is its base in
/// another colour there, a soap film as thick as it is there; others are themselves.
/// \param world   The closed scene.
/// \param vertex  The place.
/// \param f       Called with the material, as its own type.
// [visit_material_at]
template <AnyWorld W, std::floating_point T, typename F>
decltype(auto) visit_material_at(const W& world, const VertexT<T>& vertex, F&& f) {
    return world.visit_material(vertex.object.material, [&](const auto& m) {
        return f(material_at(m, vertex.point.position, vertex.uv));
    });
}
// [visit_material_at]

namespace detail {

/// Whether a direction lies on the same side of a surface by both its normals.
/// \param vertex  A point of the surface.
/// \param local   The direction in the surface's frame.
/// \param world   The same in the world.
template <std::floating_point T>
[[nodiscard]] bool agrees(const VertexT<T>& vertex, const Vec3T<T>& local,
                          const Vec3T<T>& world) noexcept {
    if (!vertex.smooth) return true;
    const T side = glm::dot(world, vertex.point.normal);
    return (side > T(0) && local.z > T(0)) || (side < T(0) && local.z < T(0));
}

/// What a photon's flux counts for where it lands: the flux is that of the triangle,
/// but the material reflects what the shading normal's cosine says.
/// \param vertex     Where it lands.
/// \param direction  The photon's direction of travel.
/// \return \f$ |\omega \cdot N_s| / |\omega \cdot N_g| \f$; 0 if they disagree.
template <std::floating_point T>
[[nodiscard]] T landing_factor(const VertexT<T>& vertex,
                               const Vec3T<T>& direction) noexcept {
    if (vertex.turned) return T(0);
    if (!vertex.smooth) return T(1);
    return std::abs(vertex.wo.z / glm::dot(direction, vertex.point.normal));
}

} // namespace detail

/// \}

} // namespace ljus
