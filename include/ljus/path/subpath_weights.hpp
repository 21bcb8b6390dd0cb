#pragma once

/// \file ljus/path/subpath_weights.hpp
/// \brief The weights with which a path from the eye and a path from a light are
/// joined.

#include <cmath>

#include "ljus/path/continue_path.hpp"

namespace ljus {

/// \defgroup subpath_weights Weights of joined paths
/// \brief The balance heuristic over all strategies that find a path from both ends,
/// computed from two numbers per vertex \cite georgiev2012 \cite hachisuka2012.
/// Chapter: \ref ch_both_ends.
///
/// A path from the eye and a path from a light are the two *subpaths* of a whole path.
/// A *strategy* says at which vertices the subpaths are joined, and how: by a
/// connection of two vertices, or by merging two vertices that are close together. The
/// *opposite way* of a subpath is the way from its last vertex back to its first.
///
/// If not said otherwise, the functions have these arguments:
///
/// | argument      | meaning                                                         |
/// |---------------|-----------------------------------------------------------------|
/// | `at`          | the weights of a subpath at its last vertex                     |
/// | `pdf`         | density of the next direction, per steradian                    |
/// | `back`        | density of the previous direction, sampled the opposite way     |
/// | `cosine`      | absolute cosine of the next direction to the geometric normal   |
/// | `probability` | probability of choosing the light                               |
/// | `merging`     | \f$\eta\f$ of SubpathWeights; 0 without merging                 |
///
/// At a mirror or clear glass, both densities are infinite. They cancel, and are given
/// as 0.
/// \{

/// Two numbers for the last vertex x of a subpath. Let x be connected to a vertex y of
/// the other subpath. The two numbers give the sum of the densities of all strategies
/// whose joint lies on this subpath instead, relative to the density of the connection:
///
/// \f[ \overleftarrow{p}\,\bigl(\mathrm{join} + \eta
///     + \overleftarrow{\sigma}\,\mathrm{further}\bigr) . \f]
///
/// Here \f$\overleftarrow{p}\f$ is the density, per area, with which a path from y
/// finds x; \f$\overleftarrow{\sigma}\f$ is the density, per steradian, of the
/// direction from x to the vertex before x; and \f$\eta = N \pi r^2\f$ is the term of
/// merging at x, with N light paths and the radius r.
struct SubpathWeights {
    /// The number for the strategy that connects the last vertex, x, to the vertex
    /// before x.
    double join = 0;
    /// The number for all strategies whose joint lies still earlier on the subpath.
    double further = 0;
};

/// The densities at the end of a path on a light.
struct LightEnd {
    double area = 0; ///< Area of the light; 0 for a light without extent.
    double pdf = 0;  ///< Density of the emitted direction, per steradian.
    /// Density with which a shadow ray would choose the point, times the area.
    double direct = 1;
    /// Cosine between direction and normal; 0 if the light has no surface.
    double cosine = 0;
};

/// The weights of a light path at its start, for arrived().
// [start]
[[nodiscard]] inline SubpathWeights started(const LightEnd& end,
                                            double probability) noexcept {
    return {end.direct / end.pdf, end.area * end.cosine / (end.pdf * probability)};
}
// [start]

/// The weights, for arrived(), after a subpath has scattered at its last vertex.
/// `cosine` belongs to the next direction; at a mirror or glass, to the previous one.
// [recursion]
[[nodiscard]] inline SubpathWeights scattered(const SubpathWeights& at, double pdf,
                                              double back, double cosine,
                                              double merging) noexcept {
    if (pdf == 0) return {0, at.further * cosine};
    return {1 / pdf, (at.join + merging + back * at.further) * cosine / pdf};
}

/// The weights at the next vertex of a subpath, from the result of started() or
/// scattered() and the squared distance between the two vertices. `cosine` belongs to
/// the direction between them, at the next vertex.
[[nodiscard]] inline SubpathWeights arrived(const SubpathWeights& from, double cosine,
                                            double distance2) noexcept {
    return {from.join * distance2 / cosine, from.further / cosine};
}

/// The sum of the densities of all strategies whose joint lies on one subpath of a
/// connection, relative to the density of the connection; see SubpathWeights. A path
/// from the other vertex finds the last vertex with this `density`, per area.
[[nodiscard]] inline double others(const SubpathWeights& at, double density,
                                   double back, double merging) noexcept {
    return density * (at.join + merging + back * at.further);
}
// [recursion]

/// The sum of the densities of all other strategies, relative to the density of a
/// camera path that hits a lamp.
// [ends]
[[nodiscard]] inline double others_of_emission(const SubpathWeights& at,
                                               const LightEnd& end,
                                               double probability) noexcept {
    return probability / end.area * (end.direct * at.join + end.pdf * at.further);
}

/// The sum of the densities of all other strategies, relative to the density of a
/// shadow ray from the last vertex of a camera path. The next direction is that of the
/// shadow ray, and `distance2` is its squared length.
[[nodiscard]] inline double
others_of_shadow_ray(const SubpathWeights& at, const LightEnd& end, double probability,
                     double pdf, double back, double cosine, double distance2,
                     double merging) noexcept {
    const double hit = pdf * end.area * end.cosine / (distance2 * probability);
    const double arrive = end.pdf * cosine / distance2;
    return (hit + others(at, arrive, back, merging)) / end.direct;
}
// [ends]

/// The sum of the densities of all strategies whose joint lies on one subpath before
/// its last vertex, relative to the density of merging at the last vertex; `merging` is
/// above 0.
[[nodiscard]] inline double others_merged(const SubpathWeights& at, double back,
                                          double merging) noexcept {
    return (at.join + back * at.further) / merging;
}

/// The weight of a strategy by the balance heuristic \cite veach1995, from the sum of
/// the densities of all others relative to its own; 0 if the sum is not finite.
[[nodiscard]] inline double weight_against(double sum) noexcept {
    return std::isfinite(sum) ? 1 / (1 + sum) : 0;
}

namespace detail {

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

/// BSDF, cosines and densities at a vertex, for a direction in which the path could
/// continue.
template <std::floating_point T>
struct TurnT {
    RgbT<T> f{T(0)};   ///< The BSDF, in 1/sr; 0 if the normals disagree about the side.
    T shading = T(0);  ///< Absolute cosine to the shading normal.
    double cosine = 0; ///< Absolute cosine to the geometric normal.
    double pdf = 0;    ///< Density of the direction, per steradian.
    /// Density of `wo` for a path that arrives from this direction, per steradian.
    double back = 0;
};

/// Computes a TurnT for a unit direction in the world.
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

/// Whether light_end() supports a type of light. It supports lamps, and lights that
/// emit from a point.
template <typename L, typename V = Vec3T<typename L::Scalar>>
inline constexpr bool has_light_end = requires(const L& light, const V& v) {
    light.lamp.area;
}
|| requires(const L& light, const V& v) {
    pdf_emission(light, v, v);
};

/// Computes the densities at the end of a path on a light, whose type must satisfy
/// has_light_end. The unit direction leads from the point of the light to the point x
/// of a surface.
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
