#pragma once

/// \file ljus/path/direct_light.hpp
/// \brief Light that comes straight from a light: shadow rays.

#include "ljus/math/sampling_pattern.hpp"
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

/// The light of one light at a surface, by one shadow ray to one point of it:
/// \f$ f\,|\cos|\,L_e\,V / p \f$.
/// \param scene     The scene.
/// \param light     One of its lights.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param u         Point of the unit square: which point of the light.
/// \param weigh     Called with the sample, the direction in the surface's frame, and
///                  its cosine; returns the factor of multiple importance sampling, or
///                  1.
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
    const SurfacePointT<T>& point = vertex.point;
    const auto sampled = sample_light(scene, light, point.position, u, vertex.time);
    if (!sampled) return RgbT<T>{T(0)};
    const Vec3T<T> wi = to_local(vertex.frame, sampled->wi);
    const RgbT<T> f = evaluate(material, vertex.wo, wi);
    if (is_black(f) || !detail::agrees(vertex, wi, sampled->wi)) return RgbT<T>{T(0)};

    RgbT<T> visible{T(1)};
    if (verdict == Verdict::lit) {
        ++counts.skipped_rays;
    } else {
        ++counts.shadow_rays;
        visible = visibility(scene, point, sampled->point, vertex.time);
        if (is_black(visible)) return RgbT<T>{T(0)};
    }
    const T distance = glm::distance(point.position, sampled->point.position);
    return std::abs(wi.z) * weigh(*sampled, wi) * f * sampled->weight *
           transmittance(vertex.medium, distance) * visible;
}

namespace detail {

/// Knows nothing of any light: every shadow ray is cast.
struct NoVerdicts {
    /// Of the light with this number.
    constexpr Verdict operator()(std::size_t) const noexcept {
        return Verdict::unknown;
    }
};

/// The light of all lights at a surface, by shadow rays to each.
/// \param scene     The scene.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param rays      Shadow rays to each light, at least 1: it has as many cells.
/// \param stream    Two numbers per light: the place in the cells, the same in all. The
///                  rays of a pixel share out a cell as they would share out the light.
/// \param counts    Counts the rays; in shadow, as many as would have been cast if the
///                  surface faces all of the light.
/// \param verdicts  Called with a light's number: what is known of it here.
/// \return Radiance towards wo.
/// \report{Section 3.2.3}
// [sample_all_lights]
template <SceneLike S, std::floating_point T, Material M, typename Stream,
          typename Verdicts = NoVerdicts>
[[nodiscard]] RgbT<T> sample_all_lights(const S& scene, const VertexT<T>& vertex,
                                        const M& material, int rays, Stream& stream,
                                        Counts& counts, Verdicts verdicts = {}) {
    const detail::Strata strata = detail::strata_for(rays);
    const auto unweighted = [](const LightSampleT<T>&, const Vec3T<T>&) {
        return T(1);
    };
    RgbT<T> sum{T(0)};
    for (std::size_t number = 0; number < scene.lights.size(); ++number) {
        const Vec2T<T> u = next_2d<T>(stream);
        const Verdict verdict = verdicts(number);
        if (verdict == Verdict::shadow) {
            counts.skipped_rays += std::uint64_t(rays);
            continue;
        }
        const std::uint64_t key = stream.key + std::uint64_t(u.x * 0x1p24f);
        for (int i = 0; i < rays; ++i)
            sum += direct_light(scene, scene.lights[number], vertex, material,
                                rays > 1 ? detail::stratified(strata, i, key, u) : u,
                                unweighted, counts, verdict);
    }
    return sum / T(rays);
}
// [sample_all_lights]

} // namespace detail

/// \}

} // namespace ljus
