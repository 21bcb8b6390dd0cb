#pragma once

/// \file ljus/path/all_lights.hpp
/// \brief The direct light of all lights at a vertex, in three ways.

#include <cmath>
#include <optional>

#include "ljus/materials/lambertian.hpp"
#include "ljus/math/sampling_pattern.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"

namespace ljus {

/// \addtogroup direct_light
/// \{

/// How the direct light of a surface is found. All three have the same mean, but for
/// the bias of the closed form in penumbrae.
enum class DirectLight : std::uint8_t {
    sampled,  ///< Shadow rays alone.
    analytic, ///< On a Lambertian surface the closed form of a lamp's light, of which
              ///< shadow rays tell the visible share, or shadow rays alone if there is
              ///< none; on any other surface as mis.
    mis ///< Shadow rays, and a ray in a direction that the material samples: each with
        ///< its weight of multiple importance sampling. For lamps that are walls.
};

namespace detail {

/// How much of the hemisphere over a vertex a light fills, if that is known in closed
/// form.
/// \param scene   The scene.
/// \param light   One of its lights.
/// \param vertex  The surface.
/// \return The form factor, for the side of `wo`; nothing for points, spots and suns,
///         and for shapes without a form_factor_from().
template <SceneLike S, std::floating_point T>
[[nodiscard]] std::optional<T> form_factor_of(const S& scene, const LightT<T>& light,
                                              const VertexT<T>& vertex) {
    if (!light.object) return std::nullopt;
    const Vec3T<T> normal = std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
    const bool inside_out = scene.object(*light.object).inside_out;
    return scene.visit_shape(*light.object, [&](const auto& lamp) -> std::optional<T> {
        const auto& now = at_time(lamp, vertex.time);
        const Vec3T<T>& from = vertex.point.position;
        if constexpr (requires { form_factor_from(from, normal, now, inside_out); })
            return form_factor_from(from, normal, now, inside_out);
        else
            return std::nullopt;
    });
}

/// The light of one lamp at a Lambertian surface: what would come if nothing stood in
/// the way, in closed form, times the share of it that shadow rays find visible,
///
/// \f[ \varrho\,L_e\,F \cdot \frac{\sum_i f_i V_i}{\sum_i f_i} \f]
///
/// with \f$f_i\f$ the light of the i-th sample. Where all of the lamp is seen, or
/// nothing of it, there is no noise. In a penumbra a quotient of two random sums is
/// biased, by the order of the variance of \f$f\f$ over the number of rays.
/// \param scene     The scene.
/// \param light     One of its lights.
/// \param form      form_factor_of() it.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param rays      Shadow rays, at least 1.
/// \param place     Called as place(i) for the point of the unit square that the i-th
///                  of them asks.
/// \param counts    Counts the rays.
/// \param verdict   What is known of the lamp before a ray is cast.
/// \return Radiance towards wo.
/// \cite heitz2018shadows
// [analytic_light]
template <SceneLike S, std::floating_point T, typename Place>
[[nodiscard]] RgbT<T>
analytic_light(const S& scene, const LightT<T>& light, T form, const VertexT<T>& vertex,
               const LambertianT<T>& material, int rays, const Place& place,
               Counts& counts, Verdict verdict) {
    const auto whole = [](const LightSampleT<T>&, const Vec3T<T>&) { return T(1); };
    RgbT<T> arrived{T(0)}, sent{T(0)}, result{T(0)};
    if (!(form > T(0))) return result;
    for (int i = 0; i < rays; ++i) {
        const LightShareT<T> share = light_share(scene, light, vertex, material,
                                                 place(i), whole, counts, verdict);
        arrived += share.arrived;
        sent += share.sent;
    }
    const RgbT<T> all = form * material.albedo * light.emission;
    for (int c = 0; c < 3; ++c)
        if (sent[c] > T(0)) result[c] = all[c] * arrived[c] / sent[c];
    return result;
}
// [analytic_light]

/// The light of lamps that a ray meets whose direction the material samples, with the
/// weight that the shadow rays leave it. It is a path of its own: anything else that it
/// meets adds nothing.
/// \param scene     The scene.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param rays      Shadow rays to each light.
/// \param stream    Three numbers are drawn.
/// \param counts    Counts the ray.
/// \return Radiance towards wo.
// [found_light]
template <SceneLike S, std::floating_point T, Material M, typename Stream>
[[nodiscard]] RgbT<T> found_light(const S& scene, const VertexT<T>& vertex,
                                  const M& material, int rays, Stream& stream,
                                  Counts& counts) {
    const auto next = scatter(vertex, material, next_3d<T>(stream), Transport::radiance,
                              Lobes::non_specular);
    if (!next) return RgbT<T>{T(0)};
    PathStateT<T> path{.ray = spawn_ray(vertex.point, next->wi, vertex.time),
                       .throughput = next->sample.weight,
                       .medium = vertex.medium,
                       .depth = 1,
                       .branch = std::uint64_t(1) << 44};
    auto numbers = stream; // next_vertex() moves them to the ray's own place
    ++counts.shadow_rays;
    const auto lamp = next_vertex(scene, path, numbers);
    if (!lamp || !lamp->emits()) return RgbT<T>{T(0)};
    const T pdf = pdf_of_lamp_point(scene, vertex.point.position, *lamp);
    return balance_heuristic(next->sample.pdf, T(rays) * pdf) * path.throughput *
           lamp->object.emission;
}
// [found_light]

/// Knows nothing of any light: every shadow ray is cast.
struct NoVerdicts {
    /// Of the light with this number.
    constexpr Verdict operator()(std::size_t) const noexcept {
        return Verdict::unknown;
    }
};

/// The light of all lights at a surface.
/// \param scene     The scene.
/// \param vertex    The surface.
/// \param material  What it is made of.
/// \param how       In which of the three ways.
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
                                        const M& material, DirectLight how, int rays,
                                        Stream& stream, Counts& counts,
                                        Verdicts verdicts = {}) {
    constexpr bool lambertian = std::same_as<M, LambertianT<T>>;
    const bool both =
        how == DirectLight::mis || (how == DirectLight::analytic && !lambertian);
    const Strata strata = rays > 1 ? strata_for(rays) : Strata{};
    const auto weigh = [&](const LightSampleT<T>& light, const Vec3T<T>& wi) {
        if (!both || light.pdf == T(0)) return T(1); // no path meets a point light
        return balance_heuristic(T(rays) * light.pdf,
                                 pdf(material, vertex.wo, wi, Lobes::non_specular));
    };
    RgbT<T> sum{T(0)};
    for (std::size_t number = 0; number < scene.lights.size(); ++number) {
        const LightT<T>& light = scene.lights[number];
        const Vec2T<T> u = next_2d<T>(stream);
        const Verdict verdict = verdicts(number);
        if (verdict == Verdict::shadow) {
            counts.skipped_rays += std::uint64_t(rays);
            continue;
        }
        const auto place = [&](int i) { // a single ray needs no cells
            if (rays == 1) return u;
            const std::uint64_t key = stream.key + std::uint32_t(u.x * T(0x1p24));
            return stratified(strata, i, key, u);
        };
        if constexpr (lambertian)
            if (how == DirectLight::analytic)
                if (const auto form = form_factor_of(scene, light, vertex)) {
                    sum += analytic_light(scene, light, *form, vertex, material, rays,
                                          place, counts, verdict);
                    continue;
                }
        for (int i = 0; i < rays; ++i) {
            const RgbT<T> found = direct_light(scene, light, vertex, material, place(i),
                                               weigh, counts, verdict);
            sum += rays == 1 ? found : found / T(rays);
        }
    }
    if (both) sum += found_light(scene, vertex, material, rays, stream, counts);
    return sum;
}
// [sample_all_lights]

} // namespace detail

/// \}

} // namespace ljus
