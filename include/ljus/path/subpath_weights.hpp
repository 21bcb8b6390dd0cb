#pragma once

/// \file ljus/path/subpath_weights.hpp
/// \brief Weights of all ways to join a path from the eye and a path from a light.

#include <cmath>

#include "ljus/path/continue_path.hpp"

namespace ljus {

/// \defgroup subpath_weights Weights of joined paths
/// \brief The balance heuristic over all ways to find a path from both ends, by two
/// numbers per vertex \cite georgiev2012 \cite hachisuka2012. Chapter:
/// \ref ch_both_ends.
///
/// The functions take numbers only: densities per steradian, cosines, distances.
/// Density of a direction from a mirror or clear glass is infinite on either way; it
/// cancels, and is written as 0.
/// \{

/// The strategies that make less of a subpath and more from the other end, at the last
/// vertex x of the subpath. Relative to the strategy that connects x to a vertex y of
/// the other subpath, their densities add up to
///
/// \f[ \overleftarrow{p}\,\bigl(\mathrm{join} + \eta
///     + \overleftarrow{\sigma}\,\mathrm{further}\bigr) , \f]
///
/// where \f$\overleftarrow{p}\f$ is the density with which a path from y finds x, per
/// area; \f$\overleftarrow{\sigma}\f$ that of its direction from x to the vertex
/// before; and \f$\eta = N \pi r^2\f$ belongs to merging at x. The same holds for paths
/// from the light and from the eye.
struct SubpathWeights {
    double join = 0;    ///< For the connection of x to the vertex before it.
    double further = 0; ///< For all joints before that one.
};

/// How light leaves a point of a light.
struct LightEnd {
    double area = 0;   ///< Photons start with the density 1/area; 0: at one point.
    double pdf = 0;    ///< Density of the direction, per steradian.
    double direct = 1; ///< Density of the point for a shadow ray, times the area.
    double cosine = 0; ///< Of the direction and the normal; 0 without a surface.
};

/// The weights of a light path at its start, as scattered() returns them.
/// \param end          Where it starts.
/// \param probability  Of choosing the light.
// [start]
[[nodiscard]] inline SubpathWeights started(const LightEnd& end,
                                            double probability) noexcept {
    return {end.direct / end.pdf, end.area * end.cosine / (end.pdf * probability)};
}
// [start]

/// The weights after a subpath has scattered at its last vertex.
/// \param at       The weights at the vertex.
/// \param pdf      Density of the new direction, per steradian; 0: mirror or glass.
/// \param back     Density of the old direction, for a path on the opposite way.
/// \param cosine   |cosine| of the new direction and the geometric normal; for a mirror
///                 or glass that of the old direction, so that the factors cancel.
/// \param merging  \f$\eta\f$.
/// \return To be passed to arrived().
// [recursion]
[[nodiscard]] inline SubpathWeights scattered(const SubpathWeights& at, double pdf,
                                              double back, double cosine,
                                              double merging) noexcept {
    if (pdf == 0) return {0, at.further * cosine};
    return {1 / pdf, (at.join + merging + back * at.further) * cosine / pdf};
}

/// The weights at the next vertex.
/// \param from       The result of scattered().
/// \param cosine     |cosine| of the direction and the geometric normal.
/// \param distance2  Squared distance from the last vertex.
[[nodiscard]] inline SubpathWeights arrived(const SubpathWeights& from, double cosine,
                                            double distance2) noexcept {
    return {from.join * distance2 / cosine, from.further / cosine};
}

/// The sum in SubpathWeights, for one of the two subpaths of a connection.
/// \param at       The weights at x.
/// \param density  Of x for a path from the other vertex, per area.
/// \param back     Density of the direction from x to the vertex before.
/// \param merging  \f$\eta\f$.
[[nodiscard]] inline double others(const SubpathWeights& at, double density,
                                   double back, double merging) noexcept {
    return density * (at.join + merging + back * at.further);
}
// [recursion]

/// The sum for a camera path that hits a lamp.
/// \param at           The weights at the lamp.
/// \param end          The point of the lamp.
/// \param probability  Of choosing the lamp.
// [ends]
[[nodiscard]] inline double others_of_emission(const SubpathWeights& at,
                                               const LightEnd& end,
                                               double probability) noexcept {
    return probability / end.area * (end.direct * at.join + end.pdf * at.further);
}

/// The sum for a shadow ray.
/// \param at           The weights at the surface that asks.
/// \param end          The point of the light.
/// \param probability  Of choosing the light.
/// \param pdf          Density of the direction to it, for a path from the eye.
/// \param back         Density of the direction to the eye, for a path from the light.
/// \param cosine       |cosine| of the direction and the surface's geometric normal.
/// \param distance2    Squared distance of the two.
/// \param merging      \f$\eta\f$.
[[nodiscard]] inline double
others_of_shadow_ray(const SubpathWeights& at, const LightEnd& end, double probability,
                     double pdf, double back, double cosine, double distance2,
                     double merging) noexcept {
    const double hit = pdf * end.area * end.cosine / (distance2 * probability);
    const double arrive = end.pdf * cosine / distance2;
    return (hit + others(at, arrive, back, merging)) / end.direct;
}
// [ends]

/// The sum for merging at x, for one of the two subpaths.
/// \param at       The weights at x.
/// \param back     Density of the direction from x to the vertex before.
/// \param merging  \f$\eta\f$, above 0.
[[nodiscard]] inline double others_merged(const SubpathWeights& at, double back,
                                          double merging) noexcept {
    return (at.join + back * at.further) / merging;
}

/// The balance heuristic for a strategy \cite veach1995.
/// \param sum  The densities of all other strategies, relative to its own.
/// \return In [0, 1]; 0 unless the sum is finite.
[[nodiscard]] inline double weight_against(double sum) noexcept {
    return std::isfinite(sum) ? 1 / (1 + sum) : 0;
}

namespace detail {

/// |cosine| of a direction and the geometric normal of a vertex.
template <std::floating_point T>
[[nodiscard]] double cosine_at(const VertexT<T>& at, const Vec3T<T>& direction) {
    return std::abs(double(glm::dot(direction, at.point.normal)));
}

/// The weights after continue_path().
template <std::floating_point T, Material M>
[[nodiscard]] SubpathWeights scattered(const SubpathWeights& weights,
                                       const PathStateT<T>& path, const VertexT<T>& at,
                                       const M& material, double merging) {
    if (path.specular)
        return scattered(weights, 0, 0, cosine_at(at, to_world(at.frame, at.wo)),
                         merging);
    const Vec3T<T>& wi = path.ray.direction;
    return scattered(weights, path.pdf, pdf(material, to_local(at.frame, wi), at.wo),
                     cosine_at(at, wi), merging);
}

/// The weights after next_vertex().
template <std::floating_point T>
[[nodiscard]] SubpathWeights arrived(const SubpathWeights& from,
                                     const PathStateT<T>& path, const VertexT<T>& at) {
    return arrived(from, cosine_at(at, path.ray.direction),
                   double(at.distance) * double(at.distance));
}

/// How a surface turns light between the vertex before it and a direction.
template <std::floating_point T>
struct TurnT {
    RgbT<T> f{T(0)};   ///< The BSDF, 1/sr; 0 if the normals disagree about the side.
    T shading = T(0);  ///< |cosine| of the direction and the shading normal.
    double cosine = 0; ///< The same of the geometric normal.
    double pdf = 0;    ///< Density of the direction, per steradian.
    double back = 0;   ///< Density of `wo`, for a path on the opposite way.
};

/// The turn at a vertex into a unit direction of the world.
/// \param transport  What the path carries that has found the vertex.
template <std::floating_point T, Material M>
[[nodiscard]] TurnT<T> turn(const VertexT<T>& at, const M& material,
                            const Vec3T<T>& direction, Transport transport) {
    const Vec3T<T> w = to_local(at.frame, direction);
    const RgbT<T> f = transport == Transport::radiance ? evaluate(material, at.wo, w)
                                                       : evaluate(material, w, at.wo);
    if (is_black(f) || !agrees(at, w, direction)) return {};
    return {.f = f,
            .shading = std::abs(w.z),
            .cosine = cosine_at(at, direction),
            .pdf = double(pdf(material, at.wo, w)),
            .back = double(pdf(material, w, at.wo))};
}

} // namespace detail

/// Whether the densities of a LightEnd are known for a light: for lamps, and for lights
/// that emit from a point.
template <typename L, typename V = Vec3T<typename L::Scalar>>
inline constexpr bool has_light_end = requires(const L& light, const V& v) {
    light.lamp.area;
}
|| requires(const L& light, const V& v) {
    pdf_emission(light, v, v);
};

/// The densities at the end of a path on a light.
/// \param world      The closed scene.
/// \param light      Number of the light; see has_light_end.
/// \param point      The point.
/// \param direction  Unit, away from the light.
/// \param x          The surface that it reaches.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] LightEnd light_end(const W& world, std::uint32_t light,
                                 const SurfacePointT<T>& point,
                                 const Vec3T<T>& direction, const Vec3T<T>& x) {
    return world.visit_light(light, [&]<typename L>(const L& l) -> LightEnd {
        if constexpr (requires { l.lamp.area; }) {
            const Vec3T<T> way = x - point.position;
            const double area = l.lamp.area, cosine = glm::dot(direction, point.normal);
            return {.area = area,
                    .pdf = double(pdf_emission(l, point, direction)),
                    .direct = area * double(pdf_towards(l.shape, x, point)) * cosine /
                              double(glm::dot(way, way)),
                    .cosine = cosine};
        } else if constexpr (has_light_end<L>) {
            return {.pdf = double(pdf_emission(l, point.position, direction))};
        } else {
            return {};
        }
    });
}

/// \}

} // namespace ljus
