#pragma once

/// \file ljus/path/next_vertex.hpp
/// \brief The vertex of a path: what is met next, all that is known of it, and how much
/// of the light between two points arrives.

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

#include "ljus/geometry/shape.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/path/path_state.hpp"
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

/// \defgroup next_vertex The next vertex
/// \brief Intersection, media, thin surfaces and the shutter behind one call.
///
/// A thin surface, as a soap film, reflects some light and lets the rest pass straight
/// through. Passing is not scattering: a path keeps its letters (a photon that came
/// straight from its lamp is still direct), its density and its depth; only what the
/// surface reflects is S. So a path that passes has no vertex there:
///
/// | question                          | answered by                                  |
/// |-----------------------------------|----------------------------------------------|
/// | how much of a lamp is seen        | visibility(): the product of T               |
/// | what a path meets                 | next_vertex(): chance decides between T and R|
///
/// In a scene that lists no such material nothing of this is compiled; in one that
/// lists some and has none it is a comparison per ray.
/// \{

/// A material that light passes straight through, as far as it does not reflect it:
/// `pass_through(m, position, wo)` says how much. Its sample() reflects, nothing else.
template <typename M>
concept ThinSurface = requires(const M& m, const Vec3T<typename M::Scalar>& v) {
    { pass_through(m, v, v) } -> std::same_as<RgbT<typename M::Scalar>>;
};

namespace detail {

/// Whether a type of scene lists a thin surface among its materials.
template <AnyWorld W>
inline constexpr bool lists_thin_surfaces = W::any_material([]<typename M>() {
    return ThinSurface<M>;
});

/// Whether a type of scene lists a shape that moves.
template <AnyWorld W>
inline constexpr bool lists_moving = W::any_shape([]<typename G>() {
    return detail::is_moving<G>;
});

/// Where a vertex of a moving shape was at time 0, when the shutter opened. There photons
/// are kept, and asked for: those of all times then lie together on what moves, and each
/// place of it receives the mean of what falls on it while the shutter is open.
/// \param world   The closed scene.
/// \param vertex  Any.
/// \return The vertex, its position at time 0; itself in a scene in which nothing moves.
// [at_rest]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] decltype(auto) at_rest(const W& world, const VertexT<T>& vertex) {
    if constexpr (lists_moving<W>) {
        VertexT<T> resting = vertex;
        world.visit_shape(vertex.id, [&]<typename G>(const G& shape) {
            if constexpr (is_moving<G>)
                resting.point.position -= vertex.time * shape.way;
        });
        return resting;
    } else {
        return (vertex);
    }
}
// [at_rest]

/// Whether a scene has a thin surface among its materials: the pass is on.
/// \param world  The closed scene.
/// \return False also if it only lists such a type, and has none.
template <AnyWorld W>
[[nodiscard]] bool has_thin_surfaces(const W& world) noexcept {
    return std::apply(
        [](const auto&... array) {
            return ((ThinSurface<
                         typename std::remove_cvref_t<decltype(array)>::value_type> &&
                     !array.empty()) ||
                    ...);
        },
        world.materials());
}

/// The time of a new path while the shutter is open \cite cook1984.
/// \param stream  One number is drawn if the scene lists a shape that moves.
/// \return In [0, 1); 0 if nothing can move.
/// \report{Section 2.1}
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] typename W::Scalar path_time(const W&, Stream& stream) {
    if constexpr (lists_moving<W>) return next_1d<typename W::Scalar>(stream);
    return 0;
}

} // namespace detail

/// The path of a camera ray, at a time of its own.
/// \param world   The closed scene.
/// \param ray     A primary ray.
/// \param stream  See path_time().
/// \return A path without a vertex.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] PathStateT<T> camera_path(const W& world, const RayT<T>& ray,
                                        Stream& stream) {
    PathStateT<T> path{.ray = ray};
    path.ray.time = detail::path_time(world, stream);
    return path;
}

namespace detail {

/// What passes straight through a surface.
/// \param world   The closed scene.
/// \param vertex  A point of the surface.
/// \return T for each channel; nothing if the surface is no thin one.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>> passed_through(const W& world,
                                                    const VertexT<T>& vertex) {
    return world.visit_material(
        vertex.object.material, [&](const auto& m) -> std::optional<RgbT<T>> {
            if constexpr (ThinSurface<std::remove_cvref_t<decltype(m)>>)
                return pass_through(m, vertex.point.position, vertex.wo);
            else
                return std::nullopt;
        });
}

/// How many thin surfaces a ray passes at most; then its way counts as blocked.
inline constexpr int max_thin_surfaces = 1000;

// visibility() in a scene with thin surfaces.
// [visibility]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> visibility_through(const W& world, const SurfacePointT<T>& from,
                                         const SurfacePointT<T>& to, T time) {
    RgbT<T> through{T(1)};
    SurfacePointT<T> last = from;
    for (int surfaces = 0; surfaces < max_thin_surfaces; ++surfaces) {
        const RayT<T> ray = spawn_ray_to(last, to, time);
        const auto hit = closest_hit(world, ray);
        if (!hit) return through;
        VertexT<T> vertex = vertex_at(world, ray, *hit);
        vertex.wo = glm::normalize(vertex.wo); // the ray is as long as the way
        const auto passed = passed_through(world, vertex);
        if (!passed) break;
        through *= *passed;
        last = vertex.point;
    }
    return RgbT<T>{T(0)};
}
// [visibility]

} // namespace detail

/// How much of the light from one point arrives at another.
/// \param world  The closed scene.
/// \param from   A point of a surface.
/// \param to     Another.
/// \param time   Of the path, in [0, 1].
/// \return 0 if anything is between them, else the product of what the thin surfaces on
///         the way let through.
/// \cost Without thin surfaces that of occluded(); with them a closest_hit() for each,
///       and one more.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> visibility(const W& world, const SurfacePointT<T>& from,
                                 const SurfacePointT<T>& to, T time = T(0)) {
    if constexpr (detail::lists_thin_surfaces<W>)
        if (detail::has_thin_surfaces(world))
            return detail::visibility_through(world, from, to, time);
    return RgbT<T>{occluded(world, spawn_ray_to(from, to, time)) ? T(0) : T(1)};
}

namespace detail {

/// What thin surfaces have done to a path between two vertices.
template <std::floating_point T>
struct PassageT {
    RgbT<T> through{T(1)};     ///< What they let through, over its probability.
    T distance = T(0);         ///< From the vertex to the last of them.
    T stop_probability = T(1); ///< Of stopping at the one where the path is, if it is.
};

/// Takes a ray through the thin surfaces in its way. At each, chance decides with the
/// mean of R over the channels whether the path stops there, to be reflected, or
/// passes.
/// \param world   The closed scene.
/// \param ray     Gets its last part.
/// \param hit     What the ray meets first; becomes what its last part meets.
/// \param stream  A number is drawn for each thin surface.
/// \return What they left.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] PassageT<T> pass_thin_surfaces(const W& world, RayT<T>& ray,
                                             std::optional<SceneHitT<T>>& hit,
                                             Stream& stream) {
    PassageT<T> passage;
    for (int surfaces = 0; hit && surfaces < max_thin_surfaces; ++surfaces) {
        const VertexT<T> vertex = vertex_at(world, ray, *hit);
        const auto passed = passed_through(world, vertex);
        if (!passed) return passage;
        const T stop = T(1) - (passed->x + passed->y + passed->z) / T(3);
        if (next_1d<T>(stream) < stop) {
            passage.stop_probability = stop;
            return passage;
        }
        passage.through *= *passed / (T(1) - stop);
        passage.distance += hit->at.t;
        ray = spawn_ray(vertex.point, ray.direction, ray.time);
        hit = closest_hit(world, ray);
    }
    hit.reset();
    return passage;
}

} // namespace detail

namespace detail {

/// Whether a type of scene lists a material with a medium inside.
template <AnyWorld W>
inline constexpr bool lists_media = W::any_material([]<typename M>() {
    return MayAbsorb<M>;
});

} // namespace detail

/// The absorption of what a ray begins in: of the innermost body around its origin. A
/// body whose surface it leaves without having entered it is around the origin; what is
/// opaque is looked through. Bodies are closed, of one shape or of several.
/// \param world  The closed scene.
/// \param ray    Any ray from there, of unit direction.
/// \return Per scene unit; 0 outside of all bodies.
/// \cost A comparison outside of a box around all that absorbs; inside of it a ray for
///       each surface up to the end of the body.
// [medium_at]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> medium_at(const W& world, RayT<T> ray) {
    if (!detail::lists_media<W> || !world.may_be_in_medium(ray.origin))
        return RgbT<T>{T(0)};
    std::array<MaterialId, 16> entered{};
    std::size_t count = 0;
    for (int surfaces = 0; surfaces < 256; ++surfaces) {
        const auto hit = closest_hit(world, ray);
        if (!hit) break;
        const VertexT<T> vertex = vertex_at(world, ray, *hit);
        const MaterialId id = vertex.object.material;
        const auto found = world.visit_material(
            id, [&]<typename M>(const M& m) -> std::optional<RgbT<T>> {
                if constexpr (MayAbsorb<M>) {
                    if (vertex.wo.z > T(0)) {
                        if (count < entered.size()) entered[count++] = id;
                        return std::nullopt;
                    }
                    const auto last = entered.begin() + std::ptrdiff_t(count);
                    const auto body = std::find(entered.begin(), last, id);
                    if (body == last) return absorption(m);
                    *body = entered[--count];
                }
                return std::nullopt;
            });
        if (found) return *found;
        ray = spawn_ray(vertex.point, ray.direction, ray.time);
    }
    return RgbT<T>{T(0)};
}
// [medium_at]

namespace detail {

/// The absorption beyond a surface where light is scattered: of the material's inside,
/// if the light comes from there; none, if it comes from outside; else what it is on
/// the side of `wo`.
/// \param medium    On that side, per scene unit.
/// \param material  Of the surface.
/// \param wo        Unit vector in the surface's frame, to where the light goes.
/// \param wi        Unit vector in the surface's frame, to where it comes from.
/// \return Per scene unit.
template <typename M, std::floating_point T>
[[nodiscard]] RgbT<T> medium_beyond(const RgbT<T>& medium, const M& material,
                                    const Vec3T<T>& wo, const Vec3T<T>& wi) noexcept {
    if (same_side(wo, wi)) return medium;
    return wi.z < T(0) ? absorption(material) : RgbT<T>{T(0)};
}

} // namespace detail

/// Sends a path to its next vertex. Media and thin surfaces on the way take their part
/// of the throughput. Where a path begins, and where it leaves a body that may lie in
/// another one, medium_at() says what it is in.
/// \param world   The closed scene.
/// \param path    Gets its depth, the last part of its ray and its throughput.
/// \param stream  Moved to the start of the bounce; a number is drawn for each thin
///                surface, and none without.
/// \return The vertex; nothing if the path leaves the scene, along its ray.
// [next_vertex]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] std::optional<VertexT<T>> next_vertex(const W& world, PathStateT<T>& path,
                                                    Stream& stream) {
    if constexpr (detail::lists_media<W>) {
        if (!path.medium_known && (path.depth == 0 || world.has_nested_media()))
            path.medium = medium_at(world, path.ray);
        path.medium_known = true;
    }
    start_bounce(stream, path.branch + static_cast<std::uint64_t>(++path.depth));
    auto hit = closest_hit(world, path.ray);
    detail::PassageT<T> passage;
    if constexpr (detail::lists_thin_surfaces<W>)
        if (detail::has_thin_surfaces(world))
            passage = detail::pass_thin_surfaces(world, path.ray, hit, stream);
    std::optional<VertexT<T>> vertex;
    if (!hit) return vertex;

    detail::fill_vertex(vertex.emplace(), world, path.ray, *hit);
    vertex->medium = path.medium;
    vertex->distance += passage.distance;
    vertex->stop_probability = passage.stop_probability;
    path.throughput *= transmittance(path.medium, vertex->distance) * passage.through;
    return vertex;
}
// [next_vertex]

/// \}

} // namespace ljus
