#pragma once

/// \file ljus/path/next_vertex.hpp
/// \brief The vertices of a path: the next intersection, its shading data, and the
/// visibility between two points.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "ljus/geometry/shape.hpp"
#include "ljus/image/texture.hpp"
#include "ljus/math/frame.hpp"
#include "ljus/math/random.hpp"
#include "ljus/optics/absorption.hpp"
#include "ljus/optics/wavelength.hpp"
#include "ljus/path/path_state.hpp"
#include "ljus/scene/nested_bodies.hpp"

namespace ljus {

/// \defgroup vertex Vertices
/// \brief Section 3.2 of the report: the hit of a ray, with the data for shading.
/// \{

/// A vertex of a path, for all renderers and the photon pass.
template <std::floating_point T>
struct VertexT {
    SurfacePointT<T> point{}; ///< Position, rounding error, geometric normal.
    FrameT<T> frame{};        ///< Shading frame, in which materials work.
    /// Unit direction to the previous vertex, in the frame.
    Vec3T<T> wo{T(0), T(0), T(1)};
    Vec2T<T> uv{T(0)};   ///< Texture coordinates, set if the material uses them.
    ObjectId id{};       ///< Number of the object.
    ObjectT<T> object{}; ///< Material and emission of the object.
    T outside = T(1);    ///< Index of refraction on the outside; 1 in air.
    /// Absorption coefficient on the side of `wo`, per scene unit.
    RgbT<T> medium{T(0)};
    T distance = T(0); ///< Distance from the previous vertex, in scene units.
    T time = T(0);     ///< Time of the path, in [0, 1].
    /// At a thin surface, the probability of not passing the surface.
    T stop_probability = T(1);
    T wavelength = line_d<T>; ///< Wavelength for dispersive glass, in nm.
    /// Whether the shading normal and the geometric normal differ, but agree about the
    /// side of `wo`.
    bool smooth = false;
    bool turned = false; ///< Whether the two normals disagree about the side of `wo`.

    /// Whether the surface emits towards `wo`; emission is one-sided.
    [[nodiscard]] bool emits() const noexcept {
        return wo.z > T(0) && !is_black(object.emission);
    }
};
using Vertex = VertexT<float>; ///< VertexT in float.

namespace detail {

/// The shading normal of a surface on the side of `wo`; unit vector.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> seen_normal(const VertexT<T>& vertex) noexcept {
    return std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
}

template <AnyWorld W>
[[nodiscard]] bool uses_uv(const W& world, MaterialId material) {
    if constexpr (W::any_material([]<typename M>() { return UsesUv<M>; }))
        return world.visit_material(material, [](const auto& m) {
            return UsesUv<std::remove_cvref_t<decltype(m)>>;
        });
    else
        return false;
}

/// Sets the frame of a vertex around the shading normal of the shape, and turns both
/// normals if the object is inside out. `point` and `object` must be set.
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

template <AnyWorld W>
inline constexpr bool lists_normal_maps = W::any_material([]<typename M>() {
    return NormalMapped<M>;
});

/// Transforms the normal of a normal map into the world.
/// \param local      The normal from normal_at(); see NormalMapped.
/// \param normal     The shading normal of the shape.
/// \param geometric  The geometric normal, on the same side.
/// \param tangents   texture_tangents() of the shape.
/// \return A unit vector: `normal` if the map is flat at this point or the shape has no
///         tangents there; `geometric` if the mapped normal is 90 degrees or more from
///         it.
// [mapped_normal]
template <std::floating_point T>
[[nodiscard]] Vec3T<T> mapped_normal(const Vec3T<T>& local, const Vec3T<T>& normal,
                                     const Vec3T<T>& geometric,
                                     const std::array<Vec3T<T>, 2>& tangents) noexcept {
    using Wide = Vec3T<WideT<T>>;
    const Wide up(normal), along(tangents[0]);
    const Wide u = along - glm::dot(along, up) * up; // perpendicular to the normal
    constexpr T flat = T(4) * std::numeric_limits<T>::epsilon(); // of interpolation
    if (glm::max(std::abs(local.x), std::abs(local.y)) <= flat || u == Wide(0))
        return normal;
    const Wide x = glm::normalize(u), y = glm::cross(up, x);
    const bool mirrored = glm::dot(y, Wide(tangents[1])) < 0;
    const Wide sum = WideT<T>(local.x) * x +
                     WideT<T>(mirrored ? -local.y : local.y) * y +
                     WideT<T>(local.z) * up;
    const Vec3T<T> mapped(glm::normalize(sum));
    return glm::dot(mapped, geometric) > T(0) ? mapped : geometric;
}
// [mapped_normal]

/// The index of refraction of a body at a wavelength in nm; 1 if its material is
/// neither Dispersive nor Refractive.
template <AnyWorld W>
[[nodiscard]] typename W::Scalar index_of(const W& world, MaterialId material,
                                          typename W::Scalar wavelength) {
    return world.visit_material(material, [&]<typename M>(const M& m) {
        if constexpr (Dispersive<M>)
            return refractive_index(at_wavelength(m, wavelength));
        else if constexpr (Refractive<M>)
            return refractive_index(m);
        else
            return typename W::Scalar(1);
    });
}

/// Completes a vertex at which surfaces of several objects coincide. Sets the index of
/// refraction on the outside, and enlarges the error of the point, so that a new ray
/// starts beyond all of these surfaces.
template <AnyWorld W, std::floating_point T>
[[gnu::cold]] void set_contact(VertexT<T>& vertex, const W& world, const RayT<T>& ray,
                               const SceneHitT<T>& hit) {
    const PlaceHitT<T> place = place_of(world, ray, hit);
    vertex.point.error += place.depth;
    if (place.entered == vertex.object.material && place.left != no_body)
        vertex.outside = index_of(world, place.left, vertex.wavelength);
}

template <AnyWorld W>
inline constexpr bool lists_dispersive = W::any_material([]<typename M>() {
    return Dispersive<M>;
});

/// Whether a material disperses light; false for no_body.
template <AnyWorld W>
[[nodiscard]] bool disperses(const W& world, MaterialId material) {
    return material != no_body &&
           world.visit_material(material,
                                []<typename M>(const M&) { return Dispersive<M>; });
}

/// Chooses the wavelength of a path at random when the path first meets a material that
/// disperses light, on either side of the surface. Until then the path carries all
/// wavelengths. The throughput is multiplied by the colour of the wavelength; the mean
/// of these colours is white.
/// \param outside  The material of the body on the outside; no_body in air.
/// \param stream   One number is drawn if a wavelength is chosen.
// [disperse]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
void disperse(const W& world, PathStateT<T>& path, VertexT<T>& vertex,
              const SceneHitT<T>& hit, MaterialId outside, Stream& stream) {
    if (path.wavelength == T(0)) {
        if (!disperses(world, vertex.object.material) && !disperses(world, outside) &&
            !(hit.shared && disperses(world, place_of(world, path.ray, hit).left)))
            return;
        path.wavelength = sample_wavelength(next_1d<T>(stream));
        path.throughput *= wavelength_color(path.wavelength);
    }
    vertex.wavelength = path.wavelength;
}
// [disperse]

/// Sets the frame of a vertex by the normal map of its material, if there is one.
/// `point`, `uv` and `object` must be set.
/// \return Whether the material has a normal map.
template <AnyWorld W, std::floating_point T, HasTangents G>
[[nodiscard]] bool map_normal(VertexT<T>& vertex, const W& world, const RayT<T>& ray,
                              const G& shape, const ShapeHitT<T>& hit) {
    return world.visit_material(vertex.object.material, [&]<typename M>(const M& m) {
        if constexpr (NormalMapped<M>) {
            Vec3T<T>& geometric = vertex.point.normal;
            if (is_plane<G> && vertex.object.inside_out)
                geometric = -geometric; // set_frame() turns it again
            Vec3T<T> normal = geometric;
            if constexpr (requires { shading_normal(shape, hit, geometric); })
                normal = shading_normal(shape, hit, geometric);
            set_frame(vertex, ray,
                      mapped_normal(normal_at(m, vertex.uv), normal, geometric,
                                    texture_tangents(shape, hit)));
        }
        return NormalMapped<M>;
    });
}

/// Sets all members of a new vertex except `medium`, `outside`, `wavelength` and
/// `stop_probability`. Writing in place saves a copy of 168 bytes per ray. The ray must
/// have a unit direction.
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
        if constexpr (lists_normal_maps<W> && HasTangents<G>)
            if (world.has_material([]<typename M>() { return NormalMapped<M>; }) &&
                map_normal(vertex, world, ray, shape, hit.at))
                return;
        if constexpr (requires { shading_normal(shape, hit.at, geometric); })
            set_frame(vertex, ray, shading_normal(shape, hit.at, geometric));
        else if constexpr (!one_frame)
            set_frame(vertex, ray, geometric);
    });
    if constexpr (W::lists_pictures)
        if (const auto* const lamp = world.picture_of(vertex.object))
            vertex.object.emission = radiance_at(*lamp, vertex.uv);
    vertex.wo = to_local(vertex.frame, -ray.direction);
}

} // namespace detail

/// The vertex at a hit of a ray with a unit direction. VertexT::medium is not set.
///
/// The frame is set around the shading normal or, if the two normals disagree about the
/// side on which the ray arrives, around the geometric normal. The sign of wo.z
/// therefore always gives the side.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] VertexT<T> vertex_at(const W& world, const RayT<T>& ray,
                                   const SceneHitT<T>& hit) {
    VertexT<T> vertex;
    detail::fill_vertex(vertex, world, ray, hit);
    if (hit.shared) detail::set_contact(vertex, world, ray, hit);
    return vertex;
}

/// Calls f(material) with the material of a vertex, as it is at this point: with the
/// colour of its texture, the thickness of a soap film, or the index at the wavelength
/// of the path. Where two transparent bodies touch, the index of one is relative to
/// that of the other.
// [visit_material_at]
template <AnyWorld W, std::floating_point T, typename F>
decltype(auto) visit_material_at(const W& world, const VertexT<T>& vertex, F&& f) {
    const auto in_contact = [&]<typename M>(const M& here) {
        if constexpr (Refractive<M>)
            return f(relative_to(here, vertex.outside));
        else
            return f(here);
    };
    return world.visit_material(vertex.object.material, [&](const auto& m) {
        const auto& here = material_at(m, vertex.point.position, vertex.uv);
        if constexpr (Dispersive<std::remove_cvref_t<decltype(here)>>)
            return in_contact(at_wavelength(here, vertex.wavelength));
        else
            return in_contact(here);
    });
}
// [visit_material_at]

/// Whether a vertex lies on an object whose material is nearly_specular(). The answer
/// is the same for all points of the object, even if a texture changes the material.
template <AnyWorld W, std::floating_point T, Material M>
[[nodiscard]] bool nearly_specular_at(const W& world, const VertexT<T>& vertex,
                                      const M& material) {
    if (!has(lobes(material), Lobes::glossy)) return false;
    return world.visit_material(vertex.object.material,
                                [](const auto& m) { return nearly_specular(m); });
}

namespace detail {

/// Whether both normals of a vertex agree about the side of a direction, which is given
/// in the frame of the vertex and in the world.
template <std::floating_point T>
[[nodiscard]] bool agrees(const VertexT<T>& vertex, const Vec3T<T>& local,
                          const Vec3T<T>& world) noexcept {
    if (!vertex.smooth) return true;
    const T side = glm::dot(world, vertex.point.normal);
    return (side > T(0) && local.z > T(0)) || (side < T(0) && local.z < T(0));
}

} // namespace detail

/// \}

/// \defgroup next_vertex The next vertex
/// \brief Intersection, media, overlapping bodies, thin surfaces and moving shapes in
/// one function.
///
/// A thin surface, such as a soap film, reflects some light and transmits the rest
/// without deflection. Transmission does not count as scattering: a transmitted path
/// has no vertex at the surface, and keeps its letters in Heckbert's notation, its
/// density and its depth. Reflection counts as specular scattering, S. visibility()
/// multiplies the light of a shadow ray by the transmittances. next_vertex() chooses
/// between transmission and reflection at random.
/// \{

namespace detail {

template <AnyWorld W>
inline constexpr bool lists_thin_surfaces = W::any_material([]<typename M>() {
    return ThinSurface<M>;
});

template <AnyWorld W>
inline constexpr bool lists_moving = W::any_shape([]<typename G>() {
    return is_moving<G>;
});

/// Moves a vertex on a moving shape back to its position at time 0. Photons of all
/// times are stored and looked up at this position. An estimate is therefore the mean
/// irradiance over the time for which the shutter is open.
// [at_rest]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] decltype(auto) at_rest(const W& world, const VertexT<T>& vertex) {
    if constexpr (lists_moving<W>) {
        VertexT<T> resting = vertex;
        world.visit_shape(vertex.id, [&]<typename G>(const G& shape) {
            if constexpr (is_moving<G>)
                resting.point.position -= vertex.time * shape.displacement;
        });
        return resting;
    } else {
        return (vertex);
    }
}
// [at_rest]

/// Whether any material in a scene is that of a thin surface. It is not enough that
/// Materials<...> of the scene contains such a type.
template <AnyWorld W>
[[nodiscard]] bool has_thin_surfaces(const W& world) noexcept {
    return world.has_material([]<typename M>() { return ThinSurface<M>; });
}

/// Whether any shape in a scene moves. It is not enough that Shapes<...> of the scene
/// contains such a type.
template <AnyWorld W>
[[nodiscard]] bool has_moving(const W& world) noexcept {
    return any_array(world.shapes(), []<typename G>(const std::vector<G>& array) {
        return is_moving<G> && !array.empty();
    });
}

/// Samples the time of a new path while the shutter is open \cite cook1984.
/// \param stream  One number is drawn if the scene has a moving shape.
/// \return The time, in [0, 1); 0 if nothing moves.
/// \report{Section 2.1}
template <AnyWorld W, StreamLike Stream>
[[nodiscard]] typename W::Scalar path_time(const W& world, Stream& stream) {
    if constexpr (lists_moving<W>)
        if (has_moving(world)) return next_1d<typename W::Scalar>(stream);
    return 0;
}

} // namespace detail

/// Starts the path of a camera ray at a random time. One number is drawn if the scene
/// has a moving shape.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] PathStateT<T> camera_path(const W& world, const RayT<T>& ray,
                                        Stream& stream) {
    PathStateT<T> path{.ray = ray};
    path.ray.time = detail::path_time(world, stream);
    return path;
}

namespace detail {

/// The transmittance of a thin surface, per channel; nothing for other surfaces.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>> passed_through(const W& world,
                                                    const VertexT<T>& vertex) {
    return world.visit_material(
        vertex.object.material, [&]<typename M>(const M& m) -> std::optional<RgbT<T>> {
            if constexpr (ThinSurface<M>)
                return pass_through(m, vertex.point.position, vertex.wo);
            else
                return std::nullopt;
        });
}

/// The largest number of thin or hidden surfaces that a ray passes; beyond it the ray
/// counts as blocked. A hidden surface lies inside a body of higher priority.
inline constexpr int max_thin_surfaces = 1000;

// visibility() in a scene with thin surfaces or with overlapping bodies.
// [visibility]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> visibility_through(const W& world, const SurfacePointT<T>& from,
                                         const SurfacePointT<T>& to, T time) {
    RgbT<T> through{T(1)};
    SurfacePointT<T> last = from;
    BodyList bodies = bodies_at(world, spawn_ray_to(from, to, time));
    for (int surfaces = 0; surfaces < max_thin_surfaces; ++surfaces) {
        const RayT<T> ray = spawn_ray_to(last, to, time);
        const auto hit = closest_hit(world, ray);
        if (!hit) return through;
        const CrossingT<T> crossing = crossing_at(world, ray, *hit, bodies);
        VertexT<T> vertex = vertex_at(world, ray, *hit);
        vertex.wo = glm::normalize(vertex.wo); // the ray's direction is no unit vector
        if (!crossing.hidden) {
            const auto passed = passed_through(world, vertex);
            if (!passed) break;
            through *= *passed;
        }
        bodies = crossing.behind;
        last = vertex.point;
    }
    return RgbT<T>{T(0)};
}
// [visibility]

} // namespace detail

template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> fog_transmittance(const W& world, const RayT<T>& ray);

/// The fraction of light that gets from one point to another, at a time in [0, 1].
/// \return For each channel: 0 if a surface occludes one point from the other,
///         otherwise the product of the transmittances of thin surfaces and of fog
///         between the points. A surface inside a body of higher priority does not
///         occlude.
/// \cost One call of occluded(). In a scene with priorities, if `from` lies in the box
///       of all bodies and is occluded, those of bodies_around() follow, and calls of
///       closest_hit(), one more than there are hidden surfaces on the way. In a scene
///       with thin surfaces there are only these calls, one per thin surface as well.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> visibility(const W& world, const SurfacePointT<T>& from,
                                 const SurfacePointT<T>& to, T time = T(0)) {
    if constexpr (detail::lists_thin_surfaces<W>)
        if (detail::has_thin_surfaces(world))
            return detail::visibility_through(world, from, to, time);
    const RayT<T> ray = spawn_ray_to(from, to, time);
    if (occluded(world, ray)) {
        if constexpr (W::lists_priorities)
            if (world.has_priorities() && world.may_be_in_medium(ray.origin))
                return detail::visibility_through(world, from, to, time);
        return RgbT<T>{T(0)};
    }
    if constexpr (W::lists_fog) return fog_transmittance(world, ray);
    return RgbT<T>{T(1)};
}

namespace detail {

/// The surfaces that a path passes between two vertices.
template <std::floating_point T>
struct PassageT {
    RgbT<T> through{T(1)}; ///< Transmittance divided by the probability of passing.
    T distance = T(0); ///< Distance from the first vertex to the last passed surface.
    /// Probability of stopping at the thin surface where the path stops; 1 at any other
    /// surface.
    T stop_probability = T(1);
    /// Rank of the body on the outside, see BodyList; 0 is air.
    std::uint8_t outside = 0;
};

/// Traces a path through thin and hidden surfaces. A path stops at a thin surface, to
/// be reflected, with a probability of 1 minus the mean transmittance of the channels.
/// \param path    Receives the last segment of its ray, and the bodies on both sides of
///                the surface where the path stops.
/// \param hit     The first hit of the ray; receives the hit where the path stops.
/// \param stream  One number is drawn per thin surface.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] PassageT<T> pass_surfaces(const W& world, PathStateT<T>& path,
                                        std::optional<SceneHitT<T>>& hit,
                                        Stream& stream) {
    PassageT<T> passage;
    RayT<T>& ray = path.ray;
    if (path.bodies.top() == 0 || !world.may_be_in_medium(ray.origin))
        path.bodies = bodies_at(world, ray);
    for (int surfaces = 0; hit && surfaces < max_thin_surfaces; ++surfaces) {
        const CrossingT<T> crossing = crossing_at(world, ray, *hit, path.bodies);
        path.bodies = crossing.hidden ? crossing.behind : crossing.before;
        path.behind = crossing.behind;
        passage.outside = crossing.outside();
        hit = crossing.hit;
        if (!crossing.hidden && !has_thin_surfaces(world)) return passage;
        const VertexT<T> vertex = vertex_at(world, ray, *hit);
        if (!crossing.hidden) {
            const auto passed = passed_through(world, vertex);
            if (!passed) return passage;
            const T stop = T(1) - (passed->x + passed->y + passed->z) / T(3);
            if (next_1d<T>(stream) < stop) {
                passage.stop_probability = stop;
                return passage;
            }
            passage.through *= *passed / (T(1) - stop);
        }
        passage.distance += hit->at.t;
        ray = spawn_ray(vertex.point, ray.direction, ray.time);
        hit = closest_hit(world, ray);
    }
    if (hit) passage.through = RgbT<T>{T(0)}; // blocked
    hit.reset();
    return passage;
}

/// Calls pass_surfaces() if the scene has thin surfaces or priorities. Otherwise the
/// path passes no surfaces.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] inline PassageT<T> passage(const W& world, PathStateT<T>& path,
                                         std::optional<SceneHitT<T>>& hit,
                                         Stream& stream) {
    if constexpr (lists_thin_surfaces<W> || W::lists_priorities)
        if (has_thin_surfaces(world) || world.has_priorities())
            return pass_surfaces(world, path, hit, stream);
    return {};
}

template <AnyWorld W>
inline constexpr bool lists_media = W::any_material([]<typename M>() {
    return Transparent<M>;
});

/// The absorption coefficient in a body made of a material, per scene unit; nothing if
/// the material has no absorption().
template <AnyWorld W>
[[nodiscard]] std::optional<RgbT<typename W::Scalar>> medium_of(const W& world,
                                                                MaterialId material) {
    return world.visit_material(
        material,
        []<typename M>(const M& m) -> std::optional<RgbT<typename W::Scalar>> {
            if constexpr (MayAbsorb<M>)
                return absorption(m);
            else
                return std::nullopt;
        });
}

/// The absorption coefficient in a body whose material has the given rank, per scene
/// unit; nothing for air, or if the material has no absorption().
template <AnyWorld W>
[[nodiscard]] std::optional<RgbT<typename W::Scalar>>
medium_of_rank(const W& world, std::uint8_t rank) {
    if (rank == 0) return std::nullopt;
    return medium_of(world, world.material_of_rank(rank));
}

} // namespace detail

/// The absorption coefficient at the origin of a ray, whose t_max is ignored. If
/// several bodies contain the origin, the innermost body counts, or the body with the
/// highest priority if the scene has priorities. A body contains the origin if the ray
/// leaves the body without having entered it. A body must be closed; it may consist of
/// several shapes.
/// \return Per scene unit; nothing outside all bodies.
/// \cost One call of closest_hit() per surface up to the end of the body; outside all
///       bodies, up to the end of the scene.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<RgbT<T>> interior_at(const W& world, RayT<T> ray) {
    ray.t_max = std::numeric_limits<T>::infinity();
    if (world.has_priorities())
        return detail::medium_of_rank(world, bodies_at(world, ray).top());
    std::array<MaterialId, 16> entered{};
    std::size_t count = 0;
    for (int surfaces = 0; surfaces < 256; ++surfaces) {
        const auto hit = closest_hit(world, ray);
        if (!hit) break;
        const VertexT<T> vertex = vertex_at(world, ray, *hit);
        PlaceHitT<T> place = place_of(world, ray, *hit);
        if (place.left == no_body && place.entered == no_body)
            (vertex.wo.z > T(0) ? place.entered : place.left) = vertex.object.material;
        if (place.left != no_body) {
            const auto last = entered.begin() + std::ptrdiff_t(count);
            const auto body = std::find(entered.begin(), last, place.left);
            if (body != last)
                *body = entered[--count];
            else if (const auto found = detail::medium_of(world, place.left))
                return found;
        }
        if (place.entered != no_body && count < entered.size() &&
            detail::medium_of(world, place.entered))
            entered[count++] = place.entered;
        ray = spawn_ray(vertex.point, ray.direction, ray.time);
    }
    return std::nullopt;
}

/// The absorption coefficient at the origin of a ray, per scene unit: interior_at(), or
/// 0 outside all bodies.
/// \cost Only a comparison outside the bounding box of all absorbing bodies.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> medium_at(const W& world, const RayT<T>& ray) {
    if (!detail::lists_media<W> || !world.may_be_in_medium(ray.origin))
        return RgbT<T>{T(0)};
    return interior_at(world, ray).value_or(RgbT<T>{T(0)});
}

/// Calls f(number, medium, span) for each medium that a ray crosses. The span is the
/// interval of t in which the ray is inside the medium. For the numbers, see
/// visit_fog().
template <AnyWorld W, std::floating_point T, typename F>
void each_fog_on(const W& world, const RayT<T>& ray, F&& f) {
    std::uint32_t number = 0;
    const auto ask = [&](const auto& list) {
        for (const auto& medium : list) {
            if (const auto span = span_in(medium, ray)) f(number, medium, *span);
            ++number;
        }
    };
    detail::each_array(world.media(), ask);
}

/// The optical depth of the fog along a ray outside all bodies: the extinction of each
/// medium times the length of the ray within it. The transmittance is exp(-depth). The
/// direction of the ray may have any length above 0.
// [optical depth]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> optical_depth(const W& world, const RayT<T>& ray) {
    RgbT<T> depth{T(0)};
    const T unit = glm::length(ray.direction);
    each_fog_on(world, ray, [&](auto, const auto& medium, auto span) {
        depth += (span.last - span.first) * unit * extinction(medium);
    });
    return depth;
}
// [optical depth]

/// Whether a ray may cross fog: the scene has fog, and the ray does not start inside a
/// body, where there is no fog.
/// \cost Only a comparison outside the bounding box of all transparent bodies.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] bool meets_fog(const W& world, const RayT<T>& ray) {
    if (!world.has_fog()) return false;
    if (!detail::lists_media<W> || !world.may_be_in_medium(ray.origin)) return true;
    return !interior_at(world, ray);
}

/// The fraction of light that crosses the fog along a ray; 1 inside a body. The ray
/// must not meet the surface of a body before its t_max.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> fog_transmittance(const W& world, const RayT<T>& ray) {
    if (!meets_fog(world, ray)) return RgbT<T>{T(1)};
    return transmittance(optical_depth(world, ray), T(1));
}

namespace detail {

/// Finds the medium of a path in a scene without priorities, if
/// PathStateT::medium_known is false: at the start of the path and, in a scene whose
/// bodies may lie inside others, after the path has left a body.
template <AnyWorld W, std::floating_point T>
inline void find_medium(const W& world, PathStateT<T>& path) {
    if constexpr (lists_media<W>) {
        if (!path.medium_known && !(W::lists_priorities && world.has_priorities()) &&
            (path.depth == 0 || world.has_nested_media()))
            path.medium = medium_at(world, path.ray);
        path.medium_known = true;
    }
}

/// In a scene with priorities, sets the index of refraction on the outside of a vertex.
/// The medium of the path becomes that of the body with the highest priority around the
/// path.
/// \param outside  The rank of the body on the outside, see BodyList; 0 is air.
template <AnyWorld W, std::floating_point T>
inline void set_bodies(VertexT<T>& vertex, const W& world, PathStateT<T>& path,
                       std::uint8_t outside) {
    if constexpr (W::lists_priorities) {
        if (!world.has_priorities()) return;
        vertex.outside = outside == 0 ? T(1)
                                      : index_of(world, world.material_of_rank(outside),
                                                 vertex.wavelength);
        path.medium = medium_of_rank(world, path.bodies.top()).value_or(RgbT<T>{T(0)});
    }
}

} // namespace detail

/// Advances a path to its next vertex. The throughput is multiplied by the
/// transmittance of bodies and thin surfaces on the way, but not by that of fog. At the
/// first material that disperses light, the throughput is also multiplied by the colour
/// of the wavelength that is chosen there. The stream is advanced to the start of the
/// bounce; one number is drawn per thin surface, and one if a wavelength is chosen.
/// \return The vertex; nothing if the path leaves the scene, or if it meets more than
///         max_thin_surfaces surfaces, which makes its throughput 0.
// [next_vertex]
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] std::optional<VertexT<T>> next_vertex(const W& world, PathStateT<T>& path,
                                                    Stream& stream) {
    detail::find_medium(world, path);
    start_bounce(stream, path.branch + static_cast<std::uint64_t>(++path.depth));
    auto hit = closest_hit(world, path.ray);
    const detail::PassageT<T> passage = detail::passage(world, path, hit, stream);
    std::optional<VertexT<T>> vertex;
    if (!hit) {
        path.throughput *= passage.through;
        return vertex;
    }

    detail::fill_vertex(vertex.emplace(), world, path.ray, *hit);
    if constexpr (detail::lists_dispersive<W>)
        detail::disperse(world, path, *vertex, *hit,
                         world.material_of_rank(passage.outside), stream);
    if (hit->shared) detail::set_contact(*vertex, world, path.ray, *hit);
    detail::set_bodies(*vertex, world, path, passage.outside);
    vertex->medium = path.medium;
    vertex->distance += passage.distance;
    vertex->stop_probability = passage.stop_probability;
    path.throughput *= transmittance(path.medium, vertex->distance) * passage.through;
    return vertex;
}
// [next_vertex]

/// \}

} // namespace ljus
