#pragma once

/// \file ljus/path/fog_path.hpp
/// \brief Paths through fog: where fog scatters them, and the light that arrives there.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include "ljus/media/equi_angular.hpp"
#include "ljus/path/direct_light.hpp"

namespace ljus {

/// \defgroup fog_path Paths through fog
/// \brief Paths that fog scatters between two surfaces.
/// \{

/// The segment of a camera path between two surfaces.
template <std::floating_point T>
struct FogSegmentT {
    RayT<T> ray{}; ///< A ray with a unit direction; t_max is at the next surface.
    RgbT<T> throughput{T(1)}; ///< Throughput of the path at the start of the segment.
};

/// A vertex at which fog scatters a path.
template <std::floating_point T>
struct FogVertexT {
    SurfacePointT<T> point{}; ///< The position; the normal is 0.
    Vec3T<T> travel{T(0)};    ///< Unit direction in which the path arrives.
    std::uint32_t medium = 0; ///< Number of the medium; see visit_fog().
    T distance = T(0); ///< Distance from the start of the segment, in scene units.
    /// Transmittance from the start of the segment to this point.
    RgbT<T> transmittance{T(1)};
    T time = T(0); ///< Time of the path, in [0, 1].
};

/// Refuses a scene with both fog and thin surfaces.
/// \throws std::invalid_argument  for such a scene.
template <AnyWorld W>
void require_no_film_in_fog([[maybe_unused]] const W& world) {
    if constexpr (W::lists_fog && detail::lists_thin_surfaces<W>)
        if (world.has_fog() && detail::has_thin_surfaces(world))
            throw std::invalid_argument(
                "the scene has both fog and thin surfaces, but paths in fog cannot "
                "pass thin surfaces; remove the fog, or all soap films and thin "
                "glass.");
}

/// How to choose the points of a segment from which shadow rays find the light that fog
/// scatters. All choices have the same mean.
enum class FogLight : std::uint8_t {
    both,   ///< The points of both other choices, weighted by the balance heuristic.
    flight, ///< The points where fly() scatters the path.
    /// Points from equi-angular sampling. A distant light uses the points of `flight`.
    equi_angular
};

/// Calls f(medium) with the medium of a number, if there is such a medium. Media are
/// counted type by type, in the order in which the scene lists the types.
template <AnyWorld W, typename F>
void visit_fog(const W& world, std::uint32_t number, F&& f) {
    const auto visit = [&](const auto& list) {
        if (number < list.size()) f(list[number]);
        number -= static_cast<std::uint32_t>(list.size()); // wraps after f was called
    };
    detail::each_array(world.media(), visit);
}

namespace detail {

/// The fate of a path on its way to the next surface.
enum class InFog : std::uint8_t { crossed, scattered, ended };

/// The probabilities of choosing a channel. They are proportional to the throughput.
template <std::floating_point T>
[[nodiscard]] Vec3T<T> channel_probabilities(const RgbT<T>& throughput) noexcept {
    return throughput / (throughput.x + throughput.y + throughput.z);
}

/// The point of a segment at a distance from its start, as a vertex in a medium.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] FogVertexT<T> fog_vertex(const W& world, const FogSegmentT<T>& segment,
                                       std::uint32_t medium, T distance) {
    RayT<T> before = segment.ray;
    before.t_max = distance;
    return {.point{.position = point_at(segment.ray, distance), .normal = Vec3T<T>{0}},
            .travel = segment.ray.direction,
            .medium = medium,
            .distance = distance,
            .transmittance = transmittance(optical_depth(world, before), T(1)),
            .time = segment.ray.time};
}

/// The density with which fly() scatters a path at a vertex, per scene unit. The
/// extinction coefficient is that of the vertex's medium.
template <std::floating_point T>
[[nodiscard]] T pdf_flight(const FogSegmentT<T>& segment, const FogVertexT<T>& vertex,
                           const RgbT<T>& extinction) noexcept {
    return glm::dot(channel_probabilities(segment.throughput),
                    extinction * vertex.transmittance);
}

} // namespace detail

/// Samples the free flight of a path: whether fog scatters it before the next surface,
/// and where.
///
/// In a medium of extinction \f$\sigma\f$ the length t of a flight has the density
/// \f$\sigma e^{-\sigma t}\f$. In coloured fog this density differs between the
/// channels. One channel is chosen in proportion to the throughput, and the throughput
/// is divided by the mean density of all channels, which is the balance heuristic
/// \cite wilkie2014. If several media lie on the segment, a flight is sampled for each,
/// and the shortest counts.
///
/// The segment must lie outside all bodies, and the path must be at the end of the
/// segment. The throughput of the path is multiplied by the weight of the flight. If
/// the path reaches the surface, its pdf is multiplied by the mean transmittance. One
/// number is drawn, and one for each medium on the segment.
/// \return The vertex where fog scatters the path; nothing if the path reaches the
///         surface.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] std::optional<FogVertexT<T>> fly(const W& world,
                                               const FogSegmentT<T>& segment,
                                               PathStateT<T>& path, Stream& stream) {
    // [fly]
    const Vec3T<T> chance = detail::channel_probabilities(segment.throughput);
    const T u = next_1d<T>(stream);
    const int channel = u < chance.x ? 0 : (u < chance.x + chance.y ? 1 : 2);
    std::optional<std::uint32_t> met;
    T distance = segment.ray.t_max;
    each_fog_on(world, segment.ray, [&](auto number, const auto& medium, auto span) {
        const T flight = -std::log1p(-next_1d<T>(stream)) / extinction(medium)[channel];
        if (!(span.first + flight < std::min(span.last, distance))) return;
        distance = span.first + flight;
        met = number;
    });
    auto vertex = detail::fog_vertex(world, segment, met.value_or(0), distance);
    if (!met) {
        path.throughput *=
            vertex.transmittance / glm::dot(chance, vertex.transmittance);
        path.pdf *= detail::passing(vertex.transmittance);
        return std::nullopt;
    }
    visit_fog(world, *met, [&](const auto& medium) {
        path.throughput *= scattering(medium) * vertex.transmittance /
                           detail::pdf_flight(segment, vertex, extinction(medium));
    });
    return vertex;
    // [fly]
}

/// Casts a shadow ray from a point in fog to a light. The point `u` of the unit square
/// chooses the point of the light.
/// \return The radiance that fog scatters back along the path, divided by the
///         scattering coefficient.
template <AnyWorld W, std::floating_point T, Medium M>
[[nodiscard]] RgbT<T> fog_light(const W& world, std::uint32_t light,
                                const FogVertexT<T>& vertex, const M& medium,
                                const Vec2T<T>& u, const MisT<T>& mis, Counts& counts) {
    const auto sampled =
        sample_light(world, light, vertex.point.position, u, vertex.time);
    if (!sampled) return RgbT<T>{T(0)};
    ++counts.shadow_rays;
    const RgbT<T> visible =
        visibility(world, vertex.point, sampled->point, vertex.time);
    if (is_black(visible)) return visible;
    const T f = phase(medium, glm::dot(vertex.travel, sampled->wi));
    T weight = T(1);
    if (mis.heuristic != MisHeuristic::shadow_rays && sampled->pdf > T(0))
        weight = mis_weight(mis.heuristic, mis.factor * sampled->pdf,
                            detail::passing(visible) * f);
    return weight * f * sampled->weight * visible;
}

/// Equi-angular sampling of a segment for one light. One of the media on the segment is
/// chosen, all with the same probability, and then a point in this medium.
template <std::floating_point T>
struct FogAimT {
    std::uint32_t media = 0; ///< Number of media on the segment.
    Vec3T<T> light{T(0)};    ///< A point of the light.
};

/// Prepares equi-angular sampling of a segment.
/// \return Nothing if there is no fog on the segment, or if the light is distant.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<FogAimT<T>> aim_fog(const W& world, std::uint32_t light,
                                                const FogSegmentT<T>& segment) {
    FogAimT<T> aim;
    each_fog_on(world, segment.ray, [&](auto, const auto&, auto) { ++aim.media; });
    const bool near = world.visit_light(light, [&]<typename L>(const L& l) {
        if constexpr (NearLight<L>)
            aim.light = detail::position_of(
                emission_point(l, Vec2T<T>{T(0.5)}, segment.ray.time));
        return NearLight<L>;
    });
    if (!near || aim.media == 0) return std::nullopt;
    return aim;
}

namespace detail {

/// The density of equi-angular sampling at a vertex, per scene unit; 0 if `aim` is
/// empty.
template <Medium M, std::floating_point T>
[[nodiscard]] T pdf_aimed(const std::optional<FogAimT<T>>& aim,
                          const FogSegmentT<T>& segment, const FogVertexT<T>& vertex,
                          const M& medium) noexcept {
    const auto span = span_in(medium, segment.ray);
    if (!aim || !span) return T(0);
    return pdf_equi_angular(equi_angular(segment.ray, *span, aim->light),
                            vertex.distance) /
           T(aim->media);
}

} // namespace detail

/// Estimates the light that fog scatters back along a path at a vertex from fly(). One
/// light is chosen in proportion to its power, and one shadow ray is cast towards it.
/// The scene must have a light. `throughput` is that of the path after fly(). Three
/// numbers are drawn.
/// \return Throughput times radiance times the weights; 0 if aimed_light() finds this
///         light alone.
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> light_in_flight(const W& world, const FogSegmentT<T>& segment,
                                      const FogVertexT<T>& vertex,
                                      const RgbT<T>& throughput, MisHeuristic heuristic,
                                      FogLight how, Context& context) {
    const auto chosen = choose_light(world.light_choice(), next_1d<T>(context.stream));
    const Vec2T<T> u = next_2d<T>(context.stream);
    const auto aim =
        how == FogLight::flight ? std::nullopt : aim_fog(world, chosen.light, segment);
    if (aim && how == FogLight::equi_angular) return RgbT<T>{T(0)};
    RgbT<T> light{T(0)};
    visit_fog(world, vertex.medium, [&](const auto& medium) {
        const T share =
            balance_heuristic(detail::pdf_flight(segment, vertex, extinction(medium)),
                              detail::pdf_aimed(aim, segment, vertex, medium));
        const MisT<T> mis{.heuristic = heuristic, .factor = chosen.probability};
        light = share *
                fog_light(world, chosen.light, vertex, medium, u, mis, context.counts);
    });
    return throughput * light / chosen.probability;
}

/// Estimates the light that fog scatters back along a segment. One light is chosen in
/// proportion to its power, and one shadow ray is cast towards it. The ray starts at a
/// point from equi-angular sampling, which favours points near the light
/// \cite kulla2012.
/// The scene must have a light, and the segment must lie outside all bodies. Five
/// numbers are drawn, except for FogLight::flight.
/// \return Throughput times radiance times the weights; 0 for FogLight::flight and for
///         distant lights.
// [aimed light]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> aimed_light(const W& world, const FogSegmentT<T>& segment,
                                  MisHeuristic heuristic, FogLight how,
                                  Context& context) {
    RgbT<T> light{T(0)};
    if (how == FogLight::flight) return light;
    const auto chosen = choose_light(world.light_choice(), next_1d<T>(context.stream));
    const Vec2T<T> along = next_2d<T>(context.stream), u = next_2d<T>(context.stream);
    const auto aim = aim_fog(world, chosen.light, segment);
    if (!aim) return light;
    auto before = std::min(aim->media - 1, std::uint32_t(along.x * T(aim->media)));
    each_fog_on(world, segment.ray, [&](auto number, const auto& medium, auto span) {
        if (before-- != 0) return;
        const auto angles = equi_angular(segment.ray, span, aim->light);
        const auto vertex = detail::fog_vertex(world, segment, number,
                                               sample_equi_angular(angles, along.y));
        const T pdf = detail::pdf_aimed(aim, segment, vertex, medium);
        const T flight = detail::pdf_flight(segment, vertex, extinction(medium));
        const T share = how == FogLight::both ? balance_heuristic(pdf, flight) : T(1);
        const MisT<T> mis{.heuristic = heuristic, .factor = chosen.probability};
        light = share / pdf * scattering(medium) * vertex.transmittance *
                fog_light(world, chosen.light, vertex, medium, u, mis, context.counts);
    });
    return segment.throughput * light / chosen.probability;
}
// [aimed light]

/// Continues a path from a vertex of fly(), in a direction sampled by the phase
/// function of the vertex's medium. The throughput does not change. Two numbers are
/// drawn.
template <std::floating_point T, Medium M, StreamLike Stream>
void scatter_in_fog(PathStateT<T>& path, const FogVertexT<T>& vertex, const M& medium,
                    Stream& stream) {
    const Vec3T<T> next = sample_phase(medium, vertex.travel, next_2d<T>(stream));
    path.previous = vertex.point.position;
    path.pdf = phase(medium, glm::dot(vertex.travel, next));
    path.specular = false;
    path.met_diffuse = true;
    path.ray = {.origin = path.previous, .direction = next, .time = vertex.time};
}

/// \}

} // namespace ljus
