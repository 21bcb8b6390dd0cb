#pragma once

/// \file ljus/path/direct_light.hpp
/// \brief Light that comes straight from a light: shadow rays.

#include "ljus/path/next_vertex.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus {

/// \defgroup direct_light Direct light
/// \brief Section 3.2.3: a shadow ray toward each light source.
/// \{

/// What is known of the way from a surface to a light before a ray is cast.
enum class Verdict : std::uint8_t {
    unknown, ///< Nothing: a shadow ray finds V.
    lit,     ///< Nothing stands in the way: V = 1.
    shadow   ///< All of the light is hidden: V = 0.
};

/// How light that both a shadow ray and a scattered ray can find is divided between the
/// two: the weights of multiple importance sampling \cite veach1997.
enum class MisHeuristic : std::uint8_t {
    balance,    ///< In proportion to each one's pdf.
    power,      ///< In proportion to the square of the pdf.
    shadow_rays ///< All to the shadow ray: next-event estimation alone.
};

/// The balance heuristic: the share of one of two strategies that could have made the
/// same sample \cite veach1997.
/// \param pdf    Of the strategy that did.
/// \param other  Of the one that could have.
/// \return In [0, 1].
// [heuristics]
template <std::floating_point T>
[[nodiscard]] constexpr T balance_heuristic(T pdf, T other) noexcept {
    // Not pdf / (pdf + other), which is NaN for two infinities.
    return pdf > other ? T(1) / (T(1) + other / pdf)
                       : pdf / other / (T(1) + pdf / other);
}

/// The power heuristic: the same by the squares of the densities, so that the surer of
/// the two is believed even more \cite veach1995.
/// \param pdf    Of the strategy that did.
/// \param other  Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T power_heuristic(T pdf, T other) noexcept {
    // Squares of quotients, for the squares of densities overflow.
    const T q = pdf > other ? other / pdf : pdf / other;
    return (pdf > other ? T(1) : q * q) / (T(1) + q * q);
}
// [heuristics]

/// The weight of one of two strategies.
/// \param heuristic  balance or power.
/// \param pdf        Of the strategy that made the sample.
/// \param other      Of the one that could have.
/// \return In [0, 1].
template <std::floating_point T>
[[nodiscard]] constexpr T mis_weight(MisHeuristic heuristic, T pdf, T other) noexcept {
    return heuristic == MisHeuristic::power ? power_heuristic(pdf, other)
                                            : balance_heuristic(pdf, other);
}

/// How a shadow ray shares light with a scattered ray.
template <std::floating_point T>
struct MisT {
    MisHeuristic heuristic = MisHeuristic::shadow_rays; ///< Which weights.
    T factor = T(1); ///< Of the sample's pdf: how many shadow rays are cast, or the
                     ///< probability that the light is chosen.
    Lobes lobes = Lobes::all; ///< Those that the scattered ray is sampled from.
};

/// The density with which a shadow ray to a lamp chooses the point of it that a path
/// has met.
/// \param world  The closed scene.
/// \param from   Where the shadow ray would start.
/// \param lamp   The point of the lamp.
/// \return Per steradian, as seen from there.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] T pdf_of_lamp_point(const W& world, const Vec3T<T>& from,
                                  const VertexT<T>& lamp) {
    return world.visit_shape(lamp.id, [&](const auto& shape) {
        return pdf_towards(at_time(shape, lamp.time), from, lamp.point);
    });
}

/// What a light fills the sky with, in one direction.
template <std::floating_point T>
struct SkyT {
    RgbT<T> radiance{T(0)}; ///< W/(m^2 sr).
    T pdf = T(0); ///< With which a shadow ray to it chooses the direction, per
                  ///< steradian.
};

namespace detail {

/// Whether a type of world lists a light that fills the sky.
template <AnyWorld W>
inline constexpr bool has_sky = W::any_light([]<typename L>() { return FillsSky<L>; });

} // namespace detail

/// What a ray that leaves the scene sees of one light.
/// \param world      The closed scene.
/// \param light      The number of the light.
/// \param direction  Of the ray, unit.
/// \return Black for a light that does not fill the sky.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] SkyT<T> sky_of(const W& world, std::uint32_t light,
                             const Vec3T<T>& direction) {
    return world.visit_light(light, [&]<typename L>(const L& l) -> SkyT<T> {
        if constexpr (FillsSky<L>)
            return {escaped_radiance(l, direction), pdf_escaped(l, direction)};
        else
            return {};
    });
}

/// The radiance that a ray sees which leaves the scene: of all lights that fill the
/// sky. Nothing is compiled where no such type is listed.
/// \param world      The closed scene.
/// \param direction  Of the ray, unit.
/// \return W/(m^2 sr).
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> sky_radiance(const W& world, const Vec3T<T>& direction) {
    RgbT<T> sum{T(0)};
    if constexpr (detail::has_sky<W>)
        for (std::uint32_t i = 0; i < world.light_count(); ++i)
            sum += sky_of(world, i, direction).radiance;
    return sum;
}

namespace detail {

/// The light of one point of a light: as it is sent, and what of it arrives.
template <std::floating_point T>
struct LightShareT {
    RgbT<T> sent{T(0)};    ///< If nothing lay between.
    RgbT<T> arrived{T(0)}; ///< Less what the medium and all objects between take.
};

/// What direct_light() returns, and what it would return if nothing lay between.
template <AnyWorld W, std::floating_point T, Material M>
[[nodiscard]] LightShareT<T> light_share(const W& world, std::uint32_t light,
                                         const VertexT<T>& vertex, const M& material,
                                         const Vec2T<T>& u, const MisT<T>& mis,
                                         Counts& counts, Verdict verdict) {
    const SurfacePointT<T>& point = vertex.point;
    const auto sampled = sample_light(world, light, point.position, u, vertex.time);
    if (!sampled) return {};
    const Vec3T<T> wi = to_local(vertex.frame, sampled->wi);
    const RgbT<T> f = evaluate(material, vertex.wo, wi);
    if (is_black(f) || !detail::agrees(vertex, wi, sampled->wi)) return {};

    T weight = T(1);
    if (mis.heuristic != MisHeuristic::shadow_rays && sampled->pdf > T(0))
        weight = mis_weight(mis.heuristic, mis.factor * sampled->pdf,
                            pdf(material, vertex.wo, wi, mis.lobes));
    LightShareT<T> share;
    share.sent = std::abs(wi.z) * weight * f * sampled->weight;
    RgbT<T> visible{T(1)};
    if (verdict == Verdict::lit) {
        ++counts.skipped_rays;
    } else {
        ++counts.shadow_rays;
        visible = visibility(world, point, sampled->point, vertex.time);
        if (is_black(visible)) return share;
    }
    share.arrived = share.sent;
    const RgbT<T> medium = medium_beyond(vertex.medium, material, vertex.wo, wi);
    if (!is_black(medium))
        share.arrived *= transmittance(
            medium, glm::distance(point.position, sampled->point.position));
    share.arrived *= visible;
    return share;
}

} // namespace detail

/// The light of one light at a surface, by one shadow ray to one point of it:
/// \f$ f\,|\cos|\,L_e\,V / p \f$.
/// \param world     The closed scene.
/// \param light     The number of one of its lights.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param u         Point of the unit square: which point of the light.
/// \param mis       What of the light is left to a scattered ray.
/// \param counts    Counts the ray; none is cast where the surface cannot reflect.
/// \param verdict   With Verdict::lit no ray is cast, and V = 1.
/// \return Radiance towards wo.
/// \report{Section 3.2.3}
/// \erratum{The report's program divides the sum over the lights by their number, so
///          that a second lamp dims the first.}
template <AnyWorld W, std::floating_point T, Material M>
[[nodiscard]] RgbT<T> direct_light(const W& world, std::uint32_t light,
                                   const VertexT<T>& vertex, const M& material,
                                   const Vec2T<T>& u, const MisT<T>& mis,
                                   Counts& counts, Verdict verdict = Verdict::unknown) {
    return detail::light_share(world, light, vertex, material, u, mis, counts, verdict)
        .arrived;
}

/// The light of one light, chosen by power, at a vertex of a path: by a shadow ray,
/// with the weight that it leaves to the path itself.
/// \param world      The closed scene, with at least one light.
/// \param path       The path.
/// \param vertex     The surface.
/// \param material   What it is made of.
/// \param heuristic  How the light is shared with the path.
/// \param context    Three numbers are drawn; the ray is counted.
/// \return Throughput times radiance times the weight.
/// \report{Section 3.2.3}
// [sampled]
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> sample_one_light(const W& world, const PathStateT<T>& path,
                                       const VertexT<T>& vertex, const M& material,
                                       MisHeuristic heuristic, Context& context) {
    const auto chosen = choose_light(world.light_choice(), next_1d<T>(context.stream));
    const MisT<T> mis{.heuristic = heuristic, .factor = chosen.probability};
    return path.throughput *
           direct_light(world, chosen.light, vertex, material,
                        next_2d<T>(context.stream), mis, context.counts) /
           chosen.probability;
}
// [sampled]

/// \}

} // namespace ljus
