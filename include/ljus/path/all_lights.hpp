#pragma once

/// \file ljus/path/all_lights.hpp
/// \brief The direct light of all lights at a vertex, by one of three methods.

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "ljus/materials/lambertian.hpp"
#include "ljus/math/sampling_pattern.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"

namespace ljus {

/// \addtogroup direct_light
/// \{

/// Methods for the direct light of a surface. They have the same mean, except for the
/// bias of the closed form in penumbrae.
enum class DirectLight : std::uint8_t {
    sampled,  ///< Shadow rays alone.
    analytic, ///< On Lambertian surfaces, a lamp's closed form times the fraction that
              ///< shadow rays find visible; shadow rays alone if there is no closed
              ///< form. On other surfaces the same as mis.
    mis ///< Shadow rays and a ray sampled by the material, with the weights of multiple
        ///< importance sampling. For lamps as large as walls.
};

namespace detail {

/// A lamp whose form factor at a vertex is known.
template <std::floating_point T>
struct SeenLampT {
    T form_factor = T(0);   ///< On the side of `wo`.
    RgbT<T> radiance{T(0)}; ///< W/(m^2 sr).
};

/// The form factor and the radiance of a light at a vertex.
/// \return The lamp; nothing for lights without a form_factor().
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<SeenLampT<T>> seen_lamp(const W& world, std::uint32_t light,
                                                    const VertexT<T>& vertex) {
    const Vec3T<T> normal = std::copysign(T(1), vertex.wo.z) * vertex.frame.normal;
    const Vec3T<T>& from = vertex.point.position;
    return world.visit_light(
        light, [&](const auto& lamp) -> std::optional<SeenLampT<T>> {
            if constexpr (requires { form_factor(lamp, from, normal, vertex.time); })
                if (const auto f = form_factor(lamp, from, normal, vertex.time))
                    return SeenLampT<T>{*f, lamp.lamp.radiance};
            return std::nullopt;
        });
}

/// The light of a lamp at a Lambertian surface if nothing occludes it.
/// \return Radiance towards wo.
template <std::floating_point T>
[[nodiscard]] RgbT<T> unoccluded(const SeenLampT<T>& lamp,
                                 const LambertianT<T>& material) noexcept {
    return lamp.form_factor * material.albedo * lamp.radiance;
}

/// The light of one lamp at a Lambertian surface: its unoccluded light in closed form,
/// times the fraction of it that shadow rays find visible,
///
/// \f[ \varrho\,L_e\,F \cdot \frac{\sum_i f_i V_i}{\sum_i f_i} \f]
///
/// with \f$f_i\f$ the light of the i-th sample. If all of the lamp is visible, or none
/// of it, there is no noise. In a penumbra the ratio of two random sums has a bias of
/// the order of the variance of \f$f\f$ over the number of rays.
/// \param rays      Number of shadow rays, at least 1.
/// \param place     Called as place(i, cells) for the point of the i-th of its cells.
/// \return Radiance towards wo.
/// \cite heitz2018shadows
template <AnyWorld W, std::floating_point T, typename Place>
[[nodiscard]] RgbT<T>
analytic_light(const W& world, std::uint32_t light, const SeenLampT<T>& lamp,
               const VertexT<T>& vertex, const LambertianT<T>& material, int rays,
               const Place& place, Counts& counts, Verdict verdict) {
    RgbT<T> arrived{T(0)}, sent{T(0)}, result{T(0)};
    if (!(lamp.form_factor > T(0))) return result;
    const RgbT<T> all = unoccluded(lamp, material);
    const Strata cells = strata_for(rays);
    for (int i = 0; i < rays; ++i) {
        const LightShareT<T> share = light_share(world, light, vertex, material,
                                                 place(i, cells), {}, counts, verdict);
        arrived += share.arrived;
        sent += share.sent;
    }
    for (int c = 0; c < 3; ++c)
        if (sent[c] > T(0)) result[c] = all[c] * arrived[c] / sent[c];
    return result;
}

/// The emission that a ray sampled by the material finds, of lamps and of the sky, with
/// its weight of multiple importance sampling. The ray ends there; it carries no other
/// light.
/// \param rays      Shadow rays per light.
/// \param context   Three numbers are drawn; the ray is counted.
/// \return Radiance towards wo.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> found_light(const W& world, const VertexT<T>& vertex,
                                  const M& material, int rays, Context& context) {
    const auto next = scatter(vertex, material, next_3d<T>(context.stream),
                              Transport::radiance, Lobes::non_specular);
    if (!next) return RgbT<T>{T(0)};
    PathStateT<T> path{
        .ray = spawn_ray(vertex.point, next->wi, vertex.time),
        .throughput = next->sample.weight,
        .medium =
            detail::medium_beyond(vertex.medium, material, vertex.wo, next->sample.wi),
        .medium_known = !detail::leaves_body<M>(vertex.wo, next->sample.wi),
        .depth = 1,
        .branch = std::uint64_t(1) << 44};
    auto numbers = context.stream; // next_vertex() moves the copy
    ++context.counts.shadow_rays;
    const auto lamp = next_vertex(world, path, numbers);
    T reaching = next->sample.pdf;
    if constexpr (W::lists_fog) {
        path.ray.t_max = lamp ? lamp->distance : path.ray.t_max;
        const RgbT<T> through = fog_transmittance(world, path.ray);
        path.throughput *= through;
        reaching *= passing(through);
    }
    const auto share = [&](T pdf) {
        return balance_heuristic(reaching, T(rays) * pdf) * path.throughput;
    };
    if (lamp) {
        if (!lamp->emits()) return RgbT<T>{T(0)};
        return share(pdf_of_lamp_point(world, vertex.point.position, *lamp)) *
               lamp->object.emission;
    }
    RgbT<T> sum{T(0)};
    if constexpr (has_sky<W>)
        for (std::uint32_t light = 0; light < world.light_count(); ++light) {
            const SkyT<T> sky = sky_of(world, light, path.ray.direction);
            sum += share(sky.pdf) * sky.radiance;
        }
    return sum;
}

/// The sum of the channels of what a lamp would send to a vertex if nothing occluded
/// it, up to a factor that is the same for all lamps.
template <std::floating_point T>
[[nodiscard]] T sent_by(const std::optional<SeenLampT<T>>& lamp) noexcept {
    if (!lamp) return T(0);
    return lamp->form_factor * (lamp->radiance.x + lamp->radiance.y + lamp->radiance.z);
}

/// The lamps with a closed form at a vertex, if there are more than two: for fewer, the
/// comparison would take longer than the rays that it saves.
template <std::floating_point T>
struct SeenLampsT {
    std::vector<std::optional<SeenLampT<T>>> kept{}; ///< By light.
    T sent = T(0);  ///< The sum of sent_by() all of them; 0: none was asked.
    T faint = T(0); ///< The sum of sent_by() the faint ones.

    /// The rays to a lamp that sends light, on average: `rays` if it sends half of all
    /// or more, and in proportion if it sends less. A lamp with the share s of the
    /// light then adds s times the variance of half of it, so that many lamps are no
    /// noisier than one.
    [[nodiscard]] T rays_to(int rays, T by_it) const noexcept {
        return std::min(T(1), T(2) * by_it / sent) * T(rays);
    }
    /// Whether a lamp gets less than one ray: such lamps share their rays.
    [[nodiscard]] bool is_faint(int rays, T by_it) const noexcept {
        return rays_to(rays, by_it) < T(1);
    }
};

/// The lamp with a number, as it is kept.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<SeenLampT<T>> lamp_of(const SeenLampsT<T>& seen,
                                                  const W& world, std::uint32_t light,
                                                  const VertexT<T>& vertex) {
    return seen.kept.empty() ? seen_lamp(world, light, vertex) : seen.kept[light];
}

/// Asks all lamps that are not known to be hidden.
template <AnyWorld W, std::floating_point T, typename Verdicts>
void see_lamps(SeenLampsT<T>& seen, const W& world, const VertexT<T>& vertex, int rays,
               const Verdicts& verdicts) {
    const std::size_t count = world.light_count();
    if (count <= 2) return;
    seen.kept.resize(count);
    for (std::uint32_t light = 0; light < count; ++light) {
        if (verdicts(light) == Verdict::shadow) continue;
        seen.kept[light] = seen_lamp(world, light, vertex);
        seen.sent += sent_by(seen.kept[light]);
    }
    for (std::uint32_t light = 0; light < count; ++light) {
        if (verdicts(light) == Verdict::shadow) continue;
        const T by_it = sent_by(seen.kept[light]);
        if (seen.is_faint(rays, by_it)) seen.faint += by_it;
    }
}

/// The light of the faint lamps, as if they were the pieces of one lamp: in closed
/// form, times the fraction that shadow rays to some of the pieces find visible. A
/// piece is chosen in proportion to the light that it sends. The fraction is a ratio of
/// two random sums, as in analytic_light().
template <std::floating_point T>
class FaintLampsT {
public:
    /// \param u  In [0, 1); chooses the lamps.
    FaintLampsT(const SeenLampsT<T>& seen, int rays, T u) noexcept : next_(u) {
        if (seen.faint > T(0))
            scale_ = std::ceil(T(2 * rays) * (seen.faint / seen.sent)) / seen.faint;
    }

    /// The rays to the next lamp. Their sum over all lamps is that of the mean numbers
    /// of SeenLampsT::rays_to(), rounded up.
    [[nodiscard]] int rays_to(T by_it) noexcept {
        next_ += by_it * scale_;
        const T whole = std::floor(next_);
        next_ -= whole;
        return int(whole);
    }
    /// Adds a lamp.
    /// \param all      Its unoccluded light.
    /// \param arrived  The part of it that its rays find.
    /// \param rays     Rays to it; if 0, `arrived` does not matter.
    void add(const RgbT<T>& all, const RgbT<T>& arrived, int rays, T by_it) noexcept {
        all_ += all;
        if (rays == 0) return;
        const T weight = T(rays) / (by_it * scale_);
        sent_ += weight * all;
        arrived_ += weight * arrived;
    }
    /// The light of all that were added.
    [[nodiscard]] RgbT<T> light() const noexcept {
        RgbT<T> result{T(0)};
        for (int c = 0; c < 3; ++c)
            if (sent_[c] > T(0)) result[c] = all_[c] * arrived_[c] / sent_[c];
        return result;
    }

private:
    T scale_ = T(0), next_;
    RgbT<T> all_{T(0)}, sent_{T(0)}, arrived_{T(0)};
};

/// Unknown visibility of all lights: every shadow ray is cast.
struct NoVerdicts {
    /// Verdict::unknown for every light.
    constexpr Verdict operator()(std::size_t) const noexcept {
        return Verdict::unknown;
    }
};

} // namespace detail

/// Method and number of rays for direct light.
struct DirectLightSettings {
    DirectLight how = DirectLight::sampled; ///< The method.
    int rays = 1; ///< Shadow rays per light, at least 1; fewer to faint lamps in closed
                  ///< form, or none, if others stand for them.
};

/// The light of all lights at a surface.
/// \param world     The closed scene.
/// \param vertex    The surface.
/// \param material  Its material.
/// \param settings  Method and rays. n rays divide each light into n cells.
/// \param context   Draws two numbers per light: the position in its cells, the same in
///                  all of them; the rays of a pixel stratify a cell. Among faint lamps
///                  one more chooses those that get rays. Rays are counted.
///                  In shadow as many are counted as for a surface that faces the whole
///                  light.
/// \param verdicts  Called with a light's index; returns its known visibility.
/// \return Radiance towards wo.
/// \report{Section 3.2.3}
template <AnyWorld W, std::floating_point T, Material M, typename Context,
          typename Verdicts = detail::NoVerdicts>
[[nodiscard]] RgbT<T> sample_all_lights(const W& world, const VertexT<T>& vertex,
                                        const M& material,
                                        const DirectLightSettings& settings,
                                        Context& context, Verdicts verdicts = {}) {
    constexpr bool lambertian = std::same_as<M, LambertianT<T>>;
    const auto [how, rays] = settings;
    const bool both =
        how == DirectLight::mis || (how == DirectLight::analytic && !lambertian);
    const detail::Strata strata =
        rays > 1 ? detail::strata_for(rays) : detail::Strata{};
    const MisT<T> mis{.heuristic =
                          both ? MisHeuristic::balance : MisHeuristic::shadow_rays,
                      .factor = T(rays),
                      .lobes = Lobes::non_specular};
    [[maybe_unused]] detail::SeenLampsT<T> seen;
    if constexpr (lambertian)
        if (how == DirectLight::analytic && rays > 1)
            detail::see_lamps(seen, world, vertex, rays, verdicts);
    [[maybe_unused]] detail::FaintLampsT<T> faint(
        seen, rays, seen.sent > T(0) ? next_1d<T>(context.stream) : T(0));
    RgbT<T> sum{T(0)};
    for (std::uint32_t light = 0; light < world.light_count(); ++light) {
        const Verdict verdict = verdicts(light);
        [[maybe_unused]] std::optional<detail::SeenLampT<T>> lamp;
        int lamp_rays = rays;
        [[maybe_unused]] bool is_faint = false;
        if constexpr (lambertian)
            if (how == DirectLight::analytic && verdict != Verdict::shadow) {
                lamp = detail::lamp_of(seen, world, light, vertex);
                const T by_it = detail::sent_by(lamp);
                if (seen.sent > T(0) && lamp) {
                    is_faint = seen.is_faint(rays, by_it);
                    lamp_rays = is_faint ? faint.rays_to(by_it)
                                         : int(std::ceil(seen.rays_to(rays, by_it)));
                    if (lamp_rays == 0) {
                        faint.add(detail::unoccluded(*lamp, material), {}, 0, by_it);
                        continue;
                    }
                }
            }
        const Vec2T<T> u = next_2d<T>(context.stream);
        if (verdict == Verdict::shadow) {
            context.counts.skipped_rays += std::uint64_t(rays);
            continue;
        }
        const auto place = [&](int i, const detail::Strata& cells) {
            const std::uint64_t key =
                context.stream.key + std::uint32_t(u.x * T(0x1p24));
            return detail::stratified(cells, i, key, u);
        };
        if constexpr (lambertian)
            if (lamp) {
                const RgbT<T> arrived =
                    detail::analytic_light(world, light, *lamp, vertex, material,
                                           lamp_rays, place, context.counts, verdict);
                if (is_faint)
                    faint.add(detail::unoccluded(*lamp, material), arrived, lamp_rays,
                              detail::sent_by(lamp));
                else
                    sum += arrived;
                continue;
            }
        for (int i = 0; i < rays; ++i) {
            const Vec2T<T> at = rays == 1 ? u : place(i, strata); // one needs no cells
            const RgbT<T> found = direct_light(world, light, vertex, material, at, mis,
                                               context.counts, verdict);
            sum += rays == 1 ? found : found / T(rays);
        }
    }
    if constexpr (lambertian) sum += faint.light();
    if (both) sum += detail::found_light(world, vertex, material, rays, context);
    return sum;
}

/// \}

} // namespace ljus
