#pragma once

/// \file ljus/path/direct_light.hpp
/// \brief Light that comes straight from a light: shadow rays.

#include "ljus/path/counts.hpp"
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/vertex.hpp"

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

namespace detail {

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

/// The density with which a shadow ray to a lamp chooses the point of it that a path
/// has met.
/// \param scene  The scene.
/// \param from   Where the shadow ray would start.
/// \param lamp   The point of the lamp.
/// \return Per steradian, as seen from there.
template <SceneLike S, std::floating_point T>
[[nodiscard]] T pdf_of_lamp_point(const S& scene, const Vec3T<T>& from,
                                  const VertexT<T>& lamp) {
    return scene.visit_shape(lamp.id, [&](const auto& shape) {
        return pdf_towards(at_time(shape, lamp.time), from, lamp.point);
    });
}

/// The light of one point of a light: as it is sent, and what of it arrives.
template <std::floating_point T>
struct LightShareT {
    RgbT<T> sent{T(0)};    ///< If nothing lay between.
    RgbT<T> arrived{T(0)}; ///< Less what the medium and all objects between take.
};

/// What direct_light() returns, and what it would return if nothing lay between.
template <SceneLike S, std::floating_point T, Material M, typename Weigh>
[[nodiscard]] LightShareT<T> light_share(const S& scene, const LightT<T>& light,
                                         const VertexT<T>& vertex, const M& material,
                                         const Vec2T<T>& u, Weigh weigh, Counts& counts,
                                         Verdict verdict) {
    const SurfacePointT<T>& point = vertex.point;
    const auto sampled = sample_light(scene, light, point.position, u, vertex.time);
    if (!sampled) return {};
    const Vec3T<T> wi = to_local(vertex.frame, sampled->wi);
    const RgbT<T> f = evaluate(material, vertex.wo, wi);
    if (is_black(f) || !detail::agrees(vertex, wi, sampled->wi)) return {};

    LightShareT<T> share;
    share.sent = std::abs(wi.z) * weigh(*sampled, wi) * f * sampled->weight;
    RgbT<T> visible{T(1)};
    if (verdict == Verdict::lit) {
        ++counts.skipped_rays;
    } else {
        ++counts.shadow_rays;
        visible = visibility(scene, point, sampled->point, vertex.time);
        if (is_black(visible)) return share;
    }
    share.arrived = share.sent;
    if (!is_black(vertex.medium))
        share.arrived *= transmittance(
            vertex.medium, glm::distance(point.position, sampled->point.position));
    share.arrived *= visible;
    return share;
}

} // namespace detail

/// The light of one light at a surface, by one shadow ray to one point of it:
/// \f$ f\,|\cos|\,L_e\,V / p \f$.
/// \param scene     The scene.
/// \param light     One of its lights.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param u         Point of the unit square: which point of the light.
/// \param weigh     Called with the sample and the direction in the surface's frame;
///                  returns the factor of multiple importance sampling, or 1.
/// \param counts    Counts the ray; none is cast where the surface cannot reflect.
/// \param verdict   With Verdict::lit no ray is cast, and V = 1.
/// \return Radiance towards wo.
/// \report{Section 3.2.3}
/// \erratum{The report's program divides the sum over the lights by their number, so
///          that a second lamp dims the first.}
template <SceneLike S, std::floating_point T, Material M, typename Weigh>
[[nodiscard]] RgbT<T> direct_light(const S& scene, const LightT<T>& light,
                                   const VertexT<T>& vertex, const M& material,
                                   const Vec2T<T>& u, Weigh weigh, Counts& counts,
                                   Verdict verdict = Verdict::unknown) {
    return detail::light_share(scene, light, vertex, material, u, weigh, counts,
                               verdict)
        .arrived;
}

/// \}

} // namespace ljus
