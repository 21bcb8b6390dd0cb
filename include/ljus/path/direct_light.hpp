#pragma once

/// \file ljus/path/direct_light.hpp
/// \brief Direct light by shadow rays.

#include "ljus/path/continue_path.hpp"
#include "ljus/path/renderer.hpp"

namespace ljus {

/// \defgroup direct_light Direct light
/// \brief Section 3.2.3 of the report: a shadow ray toward each light source.
/// \{

/// What is known of the visibility of a light from a surface before a shadow ray is
/// cast.
enum class Verdict : std::uint8_t {
    unknown, ///< Nothing: a shadow ray must be cast.
    lit,     ///< The light is fully visible.
    shadow   ///< The light is fully occluded.
};

/// The weights of multiple importance sampling \cite veach1997, for light that both a
/// shadow ray and a scattered ray can find.
enum class MisHeuristic : std::uint8_t {
    balance,    ///< Weights proportional to the pdf.
    power,      ///< Weights proportional to the square of the pdf.
    shadow_rays ///< Weight 1 for the shadow ray: next-event estimation alone.
};

/// The balance heuristic, pdf/(pdf + other): the weight of a sample that two strategies
/// could have made. `pdf` is the density of the strategy that made it \cite veach1997.
// [heuristics]
template <std::floating_point T>
[[nodiscard]] constexpr T balance_heuristic(T pdf, T other) noexcept {
    // The sum of two large densities may be infinite.
    return pdf > other ? T(1) / (T(1) + other / pdf)
                       : pdf / other / (T(1) + pdf / other);
}

/// The power heuristic: balance_heuristic() with squared densities. It favours the
/// strategy with the larger density \cite veach1995.
template <std::floating_point T>
[[nodiscard]] constexpr T power_heuristic(T pdf, T other) noexcept {
    // The square of a ratio does not overflow.
    const T q = pdf > other ? other / pdf : pdf / other;
    return (pdf > other ? T(1) : q * q) / (T(1) + q * q);
}
// [heuristics]

/// The weight of a sample by MisHeuristic::power or, for any other value, by
/// MisHeuristic::balance.
template <std::floating_point T>
[[nodiscard]] constexpr T mis_weight(MisHeuristic heuristic, T pdf, T other) noexcept {
    return heuristic == MisHeuristic::power ? power_heuristic(pdf, other)
                                            : balance_heuristic(pdf, other);
}

/// How light is divided between a shadow ray and a scattered ray.
template <std::floating_point T>
struct MisT {
    /// The heuristic of the weights.
    MisHeuristic heuristic = MisHeuristic::shadow_rays;
    /// Factor by which the pdf of a shadow ray is multiplied: the number of shadow
    /// rays, or the probability of choosing the light.
    T factor = T(1);
    Lobes lobes = Lobes::all; ///< The lobes that the scattered ray samples.
};

/// The density, per steradian, with which a shadow ray from the lit point `from` would
/// choose the point where a path hit a lamp.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] T pdf_of_lamp_point(const W& world, const Vec3T<T>& from,
                                  const VertexT<T>& lamp) {
    if constexpr (W::lists_pictures)
        if (const auto* const picture = world.picture_of(lamp.object))
            return pdf_towards(*picture, from, lamp.point, lamp.uv);
    return world.visit_shape(lamp.id, [&](const auto& shape) {
        return pdf_towards(at_time(shape, lamp.time), from, lamp.point);
    });
}

/// A light that fills the sky, as seen in one direction.
template <std::floating_point T>
struct SkyT {
    RgbT<T> radiance{T(0)}; ///< The radiance in W/(m^2 sr).
    /// Density with which a shadow ray would choose this direction, per steradian.
    T pdf = T(0);
};

namespace detail {

template <AnyWorld W>
inline constexpr bool has_sky = W::any_light([]<typename L>() { return FillsSky<L>; });

} // namespace detail

/// One light as seen by a ray that leaves the scene in a unit direction. Radiance and
/// density are 0 for a light that does not fill the sky.
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

/// The radiance of the sky in a unit direction, in W/(m^2 sr): the sum over all lights
/// that fill the sky.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> sky_radiance(const W& world, const Vec3T<T>& direction) {
    RgbT<T> sum{T(0)};
    if constexpr (detail::has_sky<W>)
        for (std::uint32_t i = 0; i < world.light_count(); ++i)
            sum += sky_of(world, i, direction).radiance;
    return sum;
}

namespace detail {

/// The mean of the channels of the transmittance of fog. For the weights of multiple
/// importance sampling, the density of a scattered ray is multiplied by this mean,
/// which approximates the probability that fog lets the ray pass.
template <std::floating_point T>
[[nodiscard]] T passing(const RgbT<T>& transmittance) noexcept {
    return (transmittance.x + transmittance.y + transmittance.z) / T(3);
}

/// The radiance that a vertex reflects from one sampled point of a light.
template <std::floating_point T>
struct LightShareT {
    RgbT<T> sent{T(0)};    ///< The radiance without occlusion and absorption.
    RgbT<T> arrived{T(0)}; ///< The radiance with occlusion and absorption.
};

/// The result of direct_light(), with and without occlusion.
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

    const auto sent = [&](T reaching) -> RgbT<T> {
        T weight = T(1);
        if (mis.heuristic != MisHeuristic::shadow_rays && sampled->pdf > T(0))
            weight = mis_weight(mis.heuristic, mis.factor * sampled->pdf,
                                reaching * pdf(material, vertex.wo, wi, mis.lobes));
        return std::abs(wi.z) * weight * f * sampled->weight;
    };
    LightShareT<T> share;
    share.sent = sent(T(1));
    RgbT<T> visible{T(1)};
    if (verdict == Verdict::lit) {
        ++counts.skipped_rays;
    } else {
        ++counts.shadow_rays;
        visible = visibility(world, point, sampled->point, vertex.time);
        if (is_black(visible)) return share;
    }
    share.arrived = share.sent;
    if constexpr (W::lists_fog)
        if (world.has_fog()) share.arrived = sent(passing(visible));
    RgbT<T> medium = medium_beyond(vertex.medium, material, vertex.wo, wi);
    if constexpr (MayAbsorb<M>)
        if (leaves_body<M>(vertex.wo, wi) && world.has_nested_media())
            medium = medium_at(world, spawn_ray(point, sampled->wi, vertex.time));
    if (!is_black(medium))
        share.arrived *= transmittance(
            medium, glm::distance(point.position, sampled->point.position));
    share.arrived *= visible;
    return share;
}

} // namespace detail

/// The radiance that a surface reflects from one light, by one shadow ray:
/// \f$ f\,|\cos\theta|\,L_e\,V / p \f$. Here f is the BSDF, theta the angle of the ray
/// to the normal, L_e the emitted radiance, V the visibility, and p the density of the
/// ray per steradian. The result is also multiplied by the transmittance of the medium
/// and by the weight that `mis` selects. The point `u` of the unit square chooses the
/// point of the light. No ray is cast if the surface cannot reflect the light, or for
/// Verdict::lit.
/// \return Radiance towards `wo`, in W/(m^2 sr).
/// \report{Section 3.2.3}
/// \erratum{The report's program divides the sum over the lights by their number. A
/// second lamp therefore dims the first.}
template <AnyWorld W, std::floating_point T, Material M>
[[nodiscard]] RgbT<T> direct_light(const W& world, std::uint32_t light,
                                   const VertexT<T>& vertex, const M& material,
                                   const Vec2T<T>& u, const MisT<T>& mis,
                                   Counts& counts, Verdict verdict = Verdict::unknown) {
    return detail::light_share(world, light, vertex, material, u, mis, counts, verdict)
        .arrived;
}

/// The direct light at a vertex of a path, by one shadow ray to one light. The light is
/// chosen in proportion to its power. The scene must have a light. Three numbers are
/// drawn.
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
