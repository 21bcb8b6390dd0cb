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

/// A method for the direct light of a surface. All methods have the same mean, except
/// that `analytic` has a bias in penumbrae.
enum class DirectLight : std::uint8_t {
    sampled, ///< Shadow rays alone.
    /// On a Lambertian surface, the closed form of a lamp's unoccluded light, times the
    /// fraction of it that shadow rays find visible. A light without a closed form is
    /// sampled by shadow rays alone. On other surfaces the method is the same as `mis`.
    analytic,
    /// Shadow rays, and a ray sampled by the material, with the weights of multiple
    /// importance sampling. This method is the best for lamps as large as walls.
    mis
};

namespace detail {

/// A lamp as seen from a vertex, on the side of `wo`.
template <std::floating_point T>
struct SeenLampT {
    T form_factor = T(0);
    RgbT<T> radiance{T(0)}; ///< The lamp's radiance in W/(m^2 sr).
};

/// What a vertex sees of a lamp; nothing if the form factor of the light is not known.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] std::optional<SeenLampT<T>> seen_lamp(const W& world, std::uint32_t light,
                                                    const VertexT<T>& vertex) {
    const Vec3T<T> normal = seen_normal(vertex);
    const Vec3T<T>& from = vertex.point.position;
    return world.visit_light(
        light, [&](const auto& lamp) -> std::optional<SeenLampT<T>> {
            if constexpr (requires { form_factor(lamp, from, normal, vertex.time); })
                if (const auto f = form_factor(lamp, from, normal, vertex.time))
                    return SeenLampT<T>{*f, lamp.lamp.radiance};
            return std::nullopt;
        });
}

/// The radiance that a Lambertian surface reflects from an unoccluded lamp, in
/// W/(m^2 sr).
template <std::floating_point T>
[[nodiscard]] RgbT<T> unoccluded(const SeenLampT<T>& lamp,
                                 const LambertianT<T>& material) noexcept {
    return lamp.form_factor * material.albedo * lamp.radiance;
}

/// Multiplies each channel of `all` by the ratio of `arrived` to `sent`. A channel in
/// which nothing was sent becomes 0.
template <std::floating_point T>
[[nodiscard]] RgbT<T> visible_part(const RgbT<T>& all, const RgbT<T>& arrived,
                                   const RgbT<T>& sent) noexcept {
    RgbT<T> result{T(0)};
    for (int c = 0; c < 3; ++c)
        if (sent[c] > T(0)) result[c] = all[c] * (arrived[c] / sent[c]);
    return result;
}

/// The radiance that a Lambertian surface reflects from one lamp: the unoccluded light
/// in closed form, times the fraction of it that shadow rays find visible,
///
/// \f[ \varrho\,L_e\,F \cdot \frac{\sum_i f_i V_i}{\sum_i f_i} . \f]
///
/// Here \f$\varrho\f$ is the albedo, L_e the radiance of the lamp, F the form factor,
/// f_i the unoccluded light of the i-th shadow ray, and V_i its visibility. Where the
/// lamp is fully visible or fully occluded there is no noise. In a penumbra the ratio
/// of two random sums has a bias; it is of the order of the variance of f_i divided
/// by the number of rays.
/// \param rays   Number of shadow rays, at least 1.
/// \param place  place(i, cells) returns a point of the unit square, in the i-th cell.
/// \return Radiance towards `wo`, in W/(m^2 sr).
/// \cite heitz2018shadows
template <AnyWorld W, std::floating_point T, typename Place>
[[nodiscard]] RgbT<T>
analytic_light(const W& world, std::uint32_t light, const SeenLampT<T>& lamp,
               const VertexT<T>& vertex, const LambertianT<T>& material, int rays,
               const Place& place, Counts& counts, Verdict verdict) {
    RgbT<T> arrived{T(0)}, sent{T(0)};
    if (!(lamp.form_factor > T(0))) return sent;
    const Strata cells = strata_for(rays);
    for (int i = 0; i < rays; ++i) {
        const LightShareT<T> share = light_share(world, light, vertex, material,
                                                 place(i, cells), {}, counts, verdict);
        arrived += share.arrived;
        sent += share.sent;
    }
    return visible_part(unoccluded(lamp, material), arrived, sent);
}

/// The emission of a lamp or of the sky that a scattered ray meets, with the weight of
/// multiple importance sampling.
/// \param path      The path after next_vertex(). It was scattered at path.previous.
/// \param lamp      The vertex that the ray hit; nothing if the ray left the scene.
/// \param reaching  The density of the ray's direction, per steradian. In fog the
///                  caller multiplies it by passing().
/// \param rays      Number of shadow rays per light.
/// \return Throughput times radiance times the weight.
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> met_light(const W& world, const PathStateT<T>& path,
                                const std::optional<VertexT<T>>& lamp, T reaching,
                                int rays) {
    const auto share = [&](T pdf) {
        return balance_heuristic(reaching, T(rays) * pdf) * path.throughput;
    };
    if (lamp) {
        if (!lamp->emits()) return RgbT<T>{T(0)};
        return share(pdf_of_lamp_point(world, path.previous, *lamp)) *
               lamp->object.emission;
    }
    RgbT<T> sum{T(0)};
    if constexpr (has_sky<W>)
        for (std::uint32_t light = 0; light < world.light_count(); ++light) {
            const SkyT<T> sky = sky_of(world, light, path.ray.direction);
            if (is_black(sky.radiance)) continue; // its density may be 0, as `reaching`
            sum += share(sky.pdf) * sky.radiance;
        }
    return sum;
}

/// Traces an extra ray, sampled by the material, and returns the result of met_light()
/// for this ray: radiance towards `wo`, in W/(m^2 sr). The ray carries no other light.
/// \param rays     Number of shadow rays per light.
/// \param context  Three numbers are drawn; the ray is counted as a shadow ray.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> found_light(const W& world, const VertexT<T>& vertex,
                                  const M& material, int rays, Context& context) {
    const auto next = scatter(vertex, material, next_3d<T>(context.stream),
                              Transport::radiance, Lobes::non_specular);
    if (!next) return RgbT<T>{T(0)};
    PathStateT<T> path{
        .ray = spawn_ray(vertex.point, next->wi, vertex.time),
        .throughput = next->sample.weight,
        .medium = medium_beyond(vertex.medium, material, vertex.wo, next->sample.wi),
        .medium_known = !leaves_body<M>(vertex.wo, next->sample.wi),
        .previous = vertex.point.position,
        .depth = 1,
        .branch = std::uint64_t(1) << 44};
    auto numbers = context.stream; // a copy, because next_vertex() advances it
    ++context.counts.shadow_rays;
    const auto lamp = next_vertex(world, path, numbers);
    T reaching = next->sample.pdf;
    if constexpr (W::lists_fog) {
        if (lamp) path.ray.t_max = lamp->distance;
        const RgbT<T> through = fog_transmittance(world, path.ray);
        path.throughput *= through;
        reaching *= passing(through);
    }
    return met_light(world, path, lamp, reaching, rays);
}

/// The unoccluded light of a lamp at a vertex: the form factor times the sum of the
/// channels of the radiance. 0 for a light without a closed form.
template <std::floating_point T>
[[nodiscard]] T sent_by(const std::optional<SeenLampT<T>>& lamp) noexcept {
    if (!lamp) return T(0);
    return lamp->form_factor * (lamp->radiance.x + lamp->radiance.y + lamp->radiance.z);
}

/// Divides shadow rays among several lamps with a closed form, at one vertex.
///
/// A lamp that sends at least half of the unoccluded light of all lamps gets `rays`
/// shadow rays. A lamp that sends less gets fewer rays, in proportion. A lamp that
/// would get less than one ray is *faint*. The faint lamps share some rays. These go to
/// lamps that are chosen in proportion to their unoccluded light. The light of all
/// faint lamps is their unoccluded light, times the fraction of it that these rays find
/// visible, with the bias of analytic_light().
template <std::floating_point T>
class SharedRaysT {
public:
    SharedRaysT() = default; ///< For no lamps.
    /// Computes the unoccluded light of all lamps that are not known to be occluded.
    /// \param rays      The largest number of rays to a lamp.
    /// \param verdicts  Called with a light's index; returns its known visibility.
    /// \param stream    One number is drawn.
    template <AnyWorld W, typename Stream, typename Verdicts>
    SharedRaysT(const W& world, const VertexT<T>& vertex, int rays,
                const Verdicts& verdicts, Stream& stream)
        : lamps_(world.light_count()), rays_(rays) {
        for (std::uint32_t light = 0; light < lamps_.size(); ++light)
            if (verdicts(light) != Verdict::shadow) {
                lamps_[light] = seen_lamp(world, light, vertex);
                sent_by_all_ += sent_by(lamps_[light]);
            }
        if (!(sent_by_all_ > T(0))) return;
        T faint = T(0); // the unoccluded light of all faint lamps
        for (const auto& lamp : lamps_)
            if (is_faint(sent_by(lamp))) faint += sent_by(lamp);
        next_ = next_1d<T>(stream);
        if (faint > T(0))
            scale_ = std::ceil(T(2 * rays) * (faint / sent_by_all_)) / faint;
    }

    /// The result of seen_lamp(); nothing for a light that is known to be occluded.
    [[nodiscard]] const std::optional<SeenLampT<T>>& lamp(std::uint32_t light) const {
        return lamps_[light];
    }
    /// Whether a lamp is faint. `by_it` is the result of sent_by() for the lamp.
    [[nodiscard]] bool is_faint(T by_it) const noexcept {
        return mean_rays(by_it) < T(1);
    }
    /// The number of rays to the next lamp. `by_it` is the result of sent_by() for the
    /// lamp. The calls must follow the order of the lights.
    [[nodiscard]] int rays_to(T by_it) noexcept {
        if (!is_faint(by_it)) return int(std::ceil(mean_rays(by_it)));
        next_ += by_it * scale_;
        const T whole = std::floor(next_);
        next_ -= whole;
        return int(whole);
    }
    /// Adds the light of a faint lamp.
    /// \param all      The result of unoccluded().
    /// \param arrived  The result of analytic_light(); 0 without rays.
    /// \param rays     The number of rays to the lamp.
    /// \param by_it    The result of sent_by().
    void add(const RgbT<T>& all, const RgbT<T>& arrived, int rays, T by_it) noexcept {
        all_ += all;
        if (rays == 0) return;
        const T weight = T(rays) / (by_it * scale_);
        sent_ += weight * all;
        arrived_ += weight * arrived;
    }
    /// The light of all faint lamps.
    [[nodiscard]] RgbT<T> light() const noexcept {
        return visible_part(all_, arrived_, sent_);
    }

private:
    // If no lamp sends light, 0/0 gives NaN, and min() gives 1: `rays` for each lamp.
    [[nodiscard]] T mean_rays(T by_it) const noexcept {
        return std::min(T(1), T(2) * by_it / sent_by_all_) * T(rays_);
    }

    std::vector<std::optional<SeenLampT<T>>> lamps_; // by light
    int rays_ = 0;
    T sent_by_all_ = T(0), scale_ = T(0), next_ = T(0);
    RgbT<T> all_{T(0)}, sent_{T(0)}, arrived_{T(0)};
};

/// Verdicts for a vertex at which the visibility of every light is unknown.
struct NoVerdicts {
    constexpr Verdict operator()(std::size_t) const noexcept {
        return Verdict::unknown;
    }
};

/// The point of the unit square for the i-th ray to a light. Each ray has its own cell.
/// The position `u` within the cell is the same for all rays of a vertex.
template <std::floating_point T, typename Context>
[[nodiscard]] Vec2T<T> place_of_ray(int i, const Strata& cells, const Vec2T<T>& u,
                                    const Context& context) noexcept {
    const std::uint64_t key = context.stream.key + std::uint32_t(u.x * T(0x1p24));
    return stratified(cells, i, key, u);
}

/// Adds the radiance towards `wo` from one light: the mean of one or more shadow rays.
/// \param u  Position within each cell of the light.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[gnu::always_inline]] inline void
add_sampled_light(RgbT<T>& sum, const W& world, std::uint32_t light,
                  const VertexT<T>& vertex, const M& material, const Vec2T<T>& u,
                  int rays, const MisT<T>& mis, Context& context, Verdict verdict) {
    const Strata cells = rays > 1 ? strata_for(rays) : Strata{};
    for (int i = 0; i < rays; ++i) {
        const Vec2T<T> at = rays == 1 ? u : place_of_ray(i, cells, u, context);
        const RgbT<T> found = direct_light(world, light, vertex, material, at, mis,
                                           context.counts, verdict);
        sum += rays == 1 ? found : found / T(rays);
    }
}

/// The radiance that a Lambertian surface reflects from all lights: by analytic_light()
/// for each light with a closed form, by shadow rays for all other lights.
template <AnyWorld W, std::floating_point T, typename Context, typename Verdicts>
[[nodiscard]] RgbT<T> analytic_lights(const W& world, const VertexT<T>& vertex,
                                      const LambertianT<T>& material, int rays,
                                      Context& context, const Verdicts& verdicts) {
    const bool shares = rays > 1 && world.light_count() > 2;
    SharedRaysT<T> shared;
    if (shares) shared = {world, vertex, rays, verdicts, context.stream};
    RgbT<T> sum{T(0)};
    for (std::uint32_t light = 0; light < world.light_count(); ++light) {
        const Verdict verdict = verdicts(light);
        std::optional<SeenLampT<T>> lamp;
        int lamp_rays = rays;
        bool is_faint = false;
        if (verdict != Verdict::shadow)
            lamp = shares ? shared.lamp(light) : seen_lamp(world, light, vertex);
        if (shares && lamp) {
            is_faint = shared.is_faint(sent_by(lamp));
            lamp_rays = shared.rays_to(sent_by(lamp));
            if (lamp_rays == 0) {
                shared.add(unoccluded(*lamp, material), {}, 0, sent_by(lamp));
                continue;
            }
        }
        const Vec2T<T> u = next_2d<T>(context.stream);
        if (verdict == Verdict::shadow) {
            context.counts.skipped_rays += std::uint64_t(rays);
        } else if (!lamp) {
            add_sampled_light(sum, world, light, vertex, material, u, rays, {}, context,
                              verdict);
        } else {
            const auto place = [&](int i, const Strata& cells) {
                return place_of_ray(i, cells, u, context);
            };
            const RgbT<T> arrived =
                analytic_light(world, light, *lamp, vertex, material, lamp_rays, place,
                               context.counts, verdict);
            if (is_faint)
                shared.add(unoccluded(*lamp, material), arrived, lamp_rays,
                           sent_by(lamp));
            else
                sum += arrived;
        }
    }
    return shares ? sum + shared.light() : sum;
}

} // namespace detail

/// Method and number of rays for direct light.
struct DirectLightSettings {
    DirectLight how = DirectLight::sampled; ///< The method.
    /// Number of shadow rays per light, at least 1. DirectLight::analytic casts fewer
    /// rays to lamps that send little light.
    int rays = 1;
    /// The lobes from which the next ray of the path is sampled, if that ray is to
    /// serve as the scattered ray of multiple importance sampling. The caller must then
    /// add its light by detail::met_light(). With Lobes::none, and always on a
    /// Lambertian surface, an extra ray is traced. In fog, only Lobes::none is allowed.
    Lobes next = Lobes::none;
};

/// The radiance that a surface reflects from all lights. n rays divide each light into
/// n cells, and one ray goes to each cell. Two numbers are drawn for each light, except
/// for a lamp that is too faint to get a ray. One more may be drawn for
/// DirectLight::analytic, and three more for an extra ray. `verdicts` is called with a
/// light's index and returns its known visibility. For a light with Verdict::shadow, n
/// skipped rays are counted.
/// \return Radiance towards `wo`, in W/(m^2 sr).
/// \report{Section 3.2.3}
template <AnyWorld W, std::floating_point T, Material M, typename Context,
          typename Verdicts = detail::NoVerdicts>
[[nodiscard]] RgbT<T> sample_all_lights(const W& world, const VertexT<T>& vertex,
                                        const M& material,
                                        const DirectLightSettings& settings,
                                        Context& context, Verdicts verdicts = {}) {
    const DirectLight how = settings.how;
    const int rays = settings.rays;
    // Decided at compile time for a matt surface.
    const Lobes next = std::same_as<M, LambertianT<T>> ? Lobes::none : settings.next;
    if constexpr (std::same_as<M, LambertianT<T>>)
        if (how == DirectLight::analytic)
            return detail::analytic_lights(world, vertex, material, rays, context,
                                           verdicts);
    const bool both = how != DirectLight::sampled;
    const MisT<T> mis{.heuristic =
                          both ? MisHeuristic::balance : MisHeuristic::shadow_rays,
                      .factor = T(rays),
                      .lobes = next == Lobes::none ? Lobes::non_specular : next};
    RgbT<T> sum{T(0)};
    for (std::uint32_t light = 0; light < world.light_count(); ++light) {
        const Vec2T<T> u = next_2d<T>(context.stream);
        const Verdict verdict = verdicts(light);
        if (verdict == Verdict::shadow)
            context.counts.skipped_rays += std::uint64_t(rays);
        else
            detail::add_sampled_light(sum, world, light, vertex, material, u, rays, mis,
                                      context, verdict);
    }
    if (both && next == Lobes::none)
        sum += detail::found_light(world, vertex, material, rays, context);
    return sum;
}

/// \}

} // namespace ljus
