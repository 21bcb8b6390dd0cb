#pragma once

/// \file ljus/render/photon_mapping.hpp
/// \brief The report's renderer: two photon maps, and rays from the camera.

#include <algorithm>
#include <string>
#include <tuple>
#include <utility>

#include "ljus/path/all_lights.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/photons/kernel_border.hpp"
#include "ljus/photons/lone_photons.hpp"
#include "ljus/photons/tracing.hpp"
#include "ljus/render/detail/caustics_batch.hpp"
#include "ljus/render/passes.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup photon_mapping Photon mapping
/// \brief The two-pass renderer of Section 3 of the report. Chapter: \ref ch_two_pass.
///
/// Every light path has one owner:
///
/// | path                | owner                                                   |
/// |---------------------|---------------------------------------------------------|
/// | E S* L              | emission, while no diffuse surface has been met         |
/// | E ... D L           | shadow rays, or the verdict of shadow photons           |
/// | E ... D S+ L        | the caustics map, at every diffuse surface              |
/// | E ... D ... D ... L | indirect rays, or a lookup as IndirectLight describes   |
///
/// Scattering in fog is a D as well, but camera paths are not scattered by fog. Fog
/// scatters light towards the eye along each ray of a camera path. Of this light,
/// shadow rays own D L, and the volume map (\ref volume_photons) owns all else: D S+ L
/// and D ... D L.
///
/// A glossy surface is a D, with one exception. IndirectLight::gather and cache treat a
/// nearly_specular() surface as an S if it lies between a light and a surface with a
/// diffuse lobe. Without such surfaces in the scene, a camera path ends at the first
/// glossy surface after a D, see ends_on_gloss(): the general map has its indirect
/// light. At all other glossy surfaces camera paths continue.
///
/// Photon maps are not queried for the light that rough glass scatters through itself,
/// see scatters_through(). Paths therefore continue at rough glass, even with
/// IndirectLight::photons and IndirectLight::map. Photons that have passed through
/// rough glass count as indirect where they land.
/// \{

/// \name Optional abilities of a photon mapper
/// Each has its own header and is listed by abilities<...>. An ability that is not
/// listed costs nothing.
/// \{
/// Needed by IndirectLight::gather and cache; see ljus/render/gathering.hpp.
struct Gathering;
struct Skipping;  ///< Needed by SkipSettings; see ljus/render/skipping.hpp.
struct Budgeting; ///< Needed by CausticBudget; see ljus/render/budgeting.hpp.
/// \}

/// The template arguments of a renderer: its abilities, and its random stream.
template <typename... X>
struct Abilities {};
/// Abilities as an argument: `PhotonMapper(world, settings, abilities<Gathering>)`.
template <typename... X>
inline constexpr Abilities<X...> abilities{};

/// The maps that the photon passes have made (Section 3.2.2 of the report).
template <std::floating_point T>
struct PhotonMapsT {
    PhotonMapT<T> caustics; ///< Photons L S+ D; empty without a caustics pass.
    PhotonMapT<T> lone;     ///< The lone_photons() of the caustics map; empty unless
                            ///< PhotonMappingSettings::lone_radius is above 1.
    PhotonMapT<T> general;  ///< Direct photons L D, indirect photons L ... D ... D and
                            ///< shadow photons; empty if no general map is made.
    VolumeMapT<T> fog_caustics; ///< Photons L S+ D where D is fog; empty without fog.
    VolumeMapT<T> fog; ///< Photons L ... D ... D where the last D is fog; empty without
                       ///< fog.
    FluxAudit caustics_audit{}; ///< The flux of the caustics pass.
    FluxAudit general_audit{};  ///< The flux of the general pass.
    bool starved = false;       ///< Whether the general map has fewer indirect photons
                                ///< than IrradiancePointSettings::least.
    bool complete = true;       ///< False if the progress callback stopped a pass.
    std::string remarks{};      ///< Remarks about the passes, one per line;
                                ///< mapper_remarks() adds those about the scene.
};

namespace detail {

/// Whether the header of an ability is included.
template <typename X>
concept Included = requires {
    sizeof(X);
};

/// The state of an optional ability of a photon mapper, such as Gathering, in precision
/// T. A stream has no state, and neither has an ability whose header is not included.
template <typename X, std::floating_point T>
struct StateOf {
    using Type = typename X::template State<T>;
};
template <typename X, std::floating_point T>
requires(!Included<X> || StreamLike<X>) struct StateOf<X, T> {
    using Type = Abilities<X>;
};

/// Finds the stream in a list of abilities; a RandomStream if the list has none.
template <typename... X>
struct StreamAmong {
    using Type = RandomStream;
};
template <typename First, typename... X>
struct StreamAmong<First, X...> : StreamAmong<X...> {};
template <typename First, typename... X>
requires(Included<First>&& StreamLike<First>) struct StreamAmong<First, X...> {
    using Type = First;
};

/// The kinds of photons that the general map keeps.
[[nodiscard]] inline PhotonKinds kept_kinds(const PhotonMappingSettings& settings) {
    const bool only_indirect =
        settings.indirect == IndirectLight::photons || uses_points(settings.indirect);
    if (only_indirect && !settings.keep_general_map)
        return one_kind(PhotonKind::indirect);
    return settings.general.shadow_photons ? all_kinds : light_kinds;
}

template <std::floating_point T>
[[nodiscard]] long long count_of(const PhotonPartsT<T>& photons, PhotonKind kind) {
    long long count = 0;
    for (const auto& part : photons)
        count += std::count_if(part.begin(), part.end(), [kind](const auto& photon) {
            return photon.kind == kind;
        });
    return count;
}

template <std::floating_point T>
void keep_kinds(PhotonPartsT<T>& photons, PhotonKinds kinds) {
    for (auto& part : photons)
        std::erase_if(part,
                      [&](const auto& photon) { return !kinds.has(photon.kind); });
}

template <std::floating_point T>
[[nodiscard]] std::vector<PhotonT<T>> joined(const PhotonPartsT<T>& photons) {
    std::vector<PhotonT<T>> all;
    for (const auto& part : photons) all.insert(all.end(), part.begin(), part.end());
    return all;
}

/// A remark about a general map with so few indirect photons that paths replace it.
[[nodiscard, gnu::cold]] inline std::string
starved_remark(long long indirect, const PhotonMappingSettings& settings) {
    return join({"of ", to_text(settings.general.photons), " general photons ",
                 to_text(indirect), " landed twice or more, fewer than ",
                 to_text(settings.irradiance.least),
                 ": paths carry the light between surfaces instead"});
}

/// A remark about a general map whose indirect photons are few but are used.
[[nodiscard, gnu::cold]] inline std::string
blurred_remark(long long indirect, const PhotonMappingSettings& settings) {
    return join({"of ", to_text(settings.general.photons), " general photons only ",
                 to_text(indirect),
                 " landed twice or more: the light between surfaces is blurred over a "
                 "large radius; trace more, or let rays carry it"});
}

/// Runs the photon passes.
/// \param judge  Called with all photons of the general pass, before the kinds that the
///               map does not keep are removed.
template <AnyWorld W, typename Judge>
[[nodiscard, gnu::cold]] PhotonMapsT<typename W::Scalar>
trace_maps(const W& world, const PhotonMappingSettings& settings, const Passes& run,
           const Judge& judge) {
    constexpr PhotonKinds fog = one_kind(PhotonKind::fog);
    PhotonMapsT<typename W::Scalar> maps;
    const auto trace = [&](MapType type, const PhotonPassSettings& pass,
                           FluxAudit& audit, [[maybe_unused]] auto& in_fog) {
        auto [parts, stored, traced] = trace_parts(world, type, pass);
        if constexpr (W::lists_fog) {
            std::vector<PhotonT<typename W::Scalar>> scattered;
            for (const auto& part : parts)
                std::copy_if(
                    part.begin(), part.end(), std::back_inserter(scattered),
                    [](const auto& photon) { return photon.kind == PhotonKind::fog; });
            in_fog = make_volume_map(scattered, settings.fog_estimate, pass.threads);
            keep_kinds(parts, all_kinds);
            stored -= scattered.size();
        }
        audit = traced.audit;
        maps.complete = maps.complete && traced.complete;
        const bool by_power = world.light_count() > 1 && pass.light_shares.empty();
        if (traced.remark.empty() && by_power && type == MapType::caustics)
            traced.remark = few_stored(stored, traced.emitted);
        if (!traced.remark.empty()) maps.remarks.append(traced.remark).append("\n");
        return std::move(parts);
    };
    if (run.caustics_map) {
        PhotonPassSettings caustics = settings.caustics;
        if (run.volume_map) caustics.keep.bits |= fog.bits;
        maps.caustics = map_of_parts(
            trace(MapType::caustics, caustics, maps.caustics_audit, maps.fog_caustics));
    }
    const bool verdicts = run.skipped_rays || run.skipped_bounces;
    const bool scatters = run.volume_map && scatters_in_fog(settings);
    if (!run.general_map && !verdicts && !scatters) return maps;
    PhotonPassSettings general = settings.general;
    general.shadow_photons = run.shadow_photons;
    PhotonKinds kept = kept_kinds(settings);
    const bool choose =
        run.irradiance && kept.bits == one_kind(PhotonKind::indirect).bits;
    if (!verdicts) general.keep = choose ? light_kinds : kept;
    if (!run.general_map && verdicts && !run.skipped_bounces) {
        general.max_bounces = 1; // only direct light is judged
        general.equal_lights = true;
    }
    if (scatters) general.keep.bits = (run.general_map ? kept.bits : 0) | fog.bits;
    auto photons = trace(MapType::general, general, maps.general_audit, maps.fog);
    if (verdicts) judge(photons);
    const long long indirect = count_of(photons, PhotonKind::indirect);
    maps.starved = run.irradiance && indirect < settings.irradiance.least;
    if (maps.starved) maps.remarks.append(starved_remark(indirect, settings) + "\n");
    // With fewer photons than this, estimates blur indirect light across a room.
    const long long sharp = std::min(1024LL, settings.general.photons / 10);
    const bool blurred =
        run.general_map && kept.has(PhotonKind::indirect) && indirect < sharp;
    if (blurred && !maps.starved)
        maps.remarks.append(blurred_remark(indirect, settings) + "\n");
    if (maps.starved && !settings.keep_general_map) return maps;
    // In the open most photons land once: points at indirect photons would be too few.
    if (choose && count_of(photons, PhotonKind::direct) > 2 * indirect)
        kept = light_kinds;
    if (verdicts || choose) keep_kinds(photons, kept);
    if (run.general_map) maps.general = map_of_parts(std::move(photons));
    return maps;
}

/// A remark about a caustics map of fewer than 256 photons, if the mapper has chosen
/// the radius: a line with a line feed, or nothing.
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::string few_caustics_remark(const PhotonMapT<T>& map,
                                                         float radius) {
    const std::size_t landed = map.records.size();
    if (landed == 0 || landed >= 256) return {};
    return join({"only ", to_text(static_cast<long long>(landed)),
                 " caustic photons landed: the light of caustics is blurred over a "
                 "radius of ",
                 to_text(radius), "; trace more, or choose a caustic budget\n"});
}

/// A remark about estimates whose radius seems to be in a wrong unit, so that hardly
/// any estimate finds a photon, or every estimate finds all: a line with a line feed,
/// or nothing.
template <std::floating_point T>
[[nodiscard, gnu::cold]] std::string
radius_remark(std::string_view name, const DensityEstimateSettings& estimate,
              const PhotonMapT<T>& map) {
    constexpr std::size_t some = 32;
    const double typical = double(typical_radius(map, some, 15)); // roughly
    const double share = double(estimate.radius) / typical;
    const double found = double(some) * share * share;
    const bool few = found < 0.1;
    const bool all = found > 4 * double(map.records.size());
    if (map.empty() || !(few || all)) return {};
    return join({name, ".radius is ", to_text(estimate.radius), ", and a radius of ",
                 to_text(float(typical)), " holds ",
                 to_text(static_cast<long long>(some)),
                 few ? " photons: most of their light is missed"
                     : " photons: their light is blurred away",
                 "; 0 chooses a radius by the photons\n"});
}

} // namespace detail

/// The report's renderer. The constructor traces the photons. The world must outlive
/// the mapper.
///
///     const PhotonMapper mapper(world, {.indirect = IndirectLight::map});
///     const PhotonMapper fast(world, preset_settings(Preset::fast, 400, 400),
///                             abilities<Gathering>);
/// \tparam X  The abilities of the mapper, and its random stream: RandomStream by
///            default, or StratifiedStream, which stratifies the choice of lamps and
///            directions over the rays of a pixel.
template <typename W, typename... X>
class PhotonMapper {
    static_assert((detail::Included<X> && ...),
                  "Include the header of each ability: ljus/render/gathering.hpp for "
                  "Gathering, skipping.hpp for Skipping, budgeting.hpp for Budgeting.");

public:
    using Scalar = typename W::Scalar; ///< The precision.
    /// The random stream that render() passes to the mapper.
    using Stream = typename detail::StreamAmong<X...>::Type;
    /// The batch of samples whose caustics are estimated together.
    using Batch = detail::CausticsBatch<Scalar>;
    static constexpr bool carries_fog = true; ///< The volume map holds the light in
                                              ///< fog.
    /// Whether an ability is listed.
    template <typename A>
    static constexpr bool has = ((std::is_same_v<A, X> && detail::Included<X>) || ...);

    /// Traces the photons that the scene requires.
    /// \param world     Must outlive the mapper.
    /// \param settings  Photons, depths, radii, source of indirect light. In place of a
    ///                  radius of 0 the mapper chooses one from the photons.
    /// \throws std::invalid_argument  if a setting is out of range, needs an ability
    ///         that is not listed, or is not allowed with fog.
    [[gnu::cold]] explicit PhotonMapper(WorldRef<W> world,
                                        PhotonMappingSettings settings = {},
                                        Abilities<X...> = {})
        : world_(world), settings_(std::move(settings)) {
        require_allowed();
        passes_ = choose_passes(needs(world.get()), settings_);
        settings_.caustics.gloss_as_mirrors = settings_.general.gloss_as_mirrors =
            passes_.gloss_as_mirrors;
        if constexpr (has<Budgeting>)
            if (passes_.caustics_map) {
                settings_.caustics.light_shares =
                    caustic_light_shares(world.get(), settings_);
                settings_.caustics.shares = caustic_shares(world.get(), settings_);
            }
        maps_ = detail::trace_maps(
            world.get(), settings_, passes_, [&](const auto& photons) {
                if constexpr (has<Skipping>)
                    kept<Skipping>().verdicts = make_verdict_grid(
                        detail::joined(photons), world.get().light_count(),
                        detail::skipping(passes_, settings_),
                        settings_.general.threads);
            });
        choose_radii();
        if constexpr (has<Gathering>)
            if (passes_.irradiance && maps_.complete && !maps_.starved)
                kept<Gathering>().points = make_irradiance_points(
                    world.get(), maps_.general, maps_.caustics, settings_.irradiance,
                    settings_.general.seed, settings_.general.threads);
    }

    /// Fills the irradiance cache for the pictures of one camera, if the settings ask
    /// for one. With an empty cache the mapper gathers at every vertex, which is slow.
    /// \param camera   Any camera.
    /// \param picture  Size, seed, threads, progress.
    template <CameraLike C>
    void fill_cache(const C& camera, const RenderSettings& picture) {
        if constexpr (has<Gathering>)
            if (passes_.cache)
                kept<Gathering>().cache = make_irradiance_cache(
                    world(), gather_lookup(*this), camera, picture, settings_.gather);
    }

    /// Takes caustics photons that were traced by other machines or read from a file.
    /// \param caustics  Photons L S+ D of this world. If the settings give a radius of
    ///                  0, the mapper chooses one from these photons.
    /// \throws std::invalid_argument  if the mapper has traced caustics photons itself,
    ///         or has computed irradiance points without them.
    void set_caustics(PhotonMapT<Scalar> caustics) {
        require(!passes_.caustics_map, "caustics.photons", settings_.caustics.photons,
                "0, for a mapper that takes photons traced elsewhere");
        if (passes_.irradiance)
            throw std::invalid_argument(
                "The irradiance was already gathered without these caustics photons; "
                "choose an IndirectLight other than gather or cache.");
        maps_.caustics = std::move(caustics);
        if (radius_is_chosen_) settings_.caustics_estimate.radius = 0;
        choose_radii();
    }

    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The settings, with the radii and photon shares that the mapper has chosen.
    [[nodiscard]] const PhotonMappingSettings& settings() const noexcept {
        return settings_;
    }
    /// Which passes ran.
    [[nodiscard]] const Passes& passes() const noexcept { return passes_; }
    /// The photons that the passes stored.
    [[nodiscard]] const PhotonMapsT<Scalar>& maps() const noexcept { return maps_; }
    /// The state of an ability.
    template <typename A>
    [[nodiscard]] const auto& state() const noexcept {
        return std::get<typename A::template State<Scalar>>(states_);
    }
    /// The lobes by which a camera path continues until it looks up indirect light.
    [[nodiscard]] Lobes bounces() const noexcept {
        return passes_.indirect_rays ? Lobes::all
               : settings_.indirect == IndirectLight::cache
                   ? Lobes::glossy | Lobes::specular
                   : Lobes::specular;
    }

private:
    // The writable state of an ability.
    template <typename A>
    [[nodiscard]] auto& kept() noexcept {
        return std::get<typename A::template State<Scalar>>(states_);
    }

    [[gnu::cold]] void choose_radii() {
        radius_is_chosen_ = settings_.caustics_estimate.radius == 0;
        float& radius = settings_.caustics_estimate.radius;
        if (radius_is_chosen_) {
            radius = float(typical_radius(maps_.caustics, 32));
            maps_.remarks += detail::few_caustics_remark(maps_.caustics, radius);
        } else {
            maps_.remarks += detail::radius_remark(
                "caustics_estimate", settings_.caustics_estimate, maps_.caustics);
        }
        const bool widens =
            settings_.lone_radius > 1 && settings_.caustics_estimate.nearest == 0;
        maps_.lone = widens ? lone_photons(maps_.caustics, Scalar(radius))
                            : PhotonMapT<Scalar>{};
        if (settings_.general_estimate.radius == 0)
            settings_.general_estimate.radius =
                float(typical_radius(maps_.general, 64));
        else if (passes_.general_map && !passes_.irradiance)
            maps_.remarks += detail::radius_remark(
                "general_estimate", settings_.general_estimate, maps_.general);
        // A chosen radius may be out of range.
        check(settings_.caustics_estimate, "caustics_estimate");
        check(settings_.general_estimate, "general_estimate");
    }

    // Refuses settings that are out of range, or not allowed here.
    [[gnu::cold]] void require_allowed() const {
        const PhotonMappingSettings& settings = settings_;
        check(settings);
        if constexpr (W::lists_fog)
            if (const auto why = detail::refused_in_fog(world(), settings);
                !why.empty())
                throw std::invalid_argument(why + ".");
        const auto require_ability = [](bool listed, bool asked, const char* what,
                                        const char* ability) {
            if (asked && !listed)
                throw std::invalid_argument(detail::join(
                    {what, " needs an ability that is not listed: abilities<",
                     ability}));
        };
        require_ability(has<Gathering>, detail::uses_points(settings.indirect),
                        "indirect light by gathering",
                        "Gathering> of ljus/render/gathering.hpp.");
        require_ability(has<Skipping>, detail::skips_rays(settings.skip),
                        "leaving out needless rays",
                        "Skipping> of ljus/render/skipping.hpp.");
        require_ability(has<Budgeting>,
                        settings.caustic_budget != CausticBudget::as_seen &&
                            settings.caustics.shares.empty(),
                        "a budget of caustic photons",
                        "Budgeting> of ljus/render/budgeting.hpp.");
    }

    WorldRef<W> world_;
    PhotonMappingSettings settings_;
    Passes passes_{};
    bool radius_is_chosen_ = false; // for the caustics map
    PhotonMapsT<Scalar> maps_{};
    std::tuple<typename detail::StateOf<X, Scalar>::Type...> states_{};
};
/// Deduces the world and the abilities.
template <typename W, typename... X>
PhotonMapper(const W&, const PhotonMappingSettings& = {}, Abilities<X...> = {})
    -> PhotonMapper<W, X...>;

namespace detail {

/// Direct light at a surface. Where shadow photons tell whether a light is visible, no
/// shadow ray is sent.
template <typename Mapper, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> light_of_lights(const Mapper& mapper, const VertexT<T>& vertex,
                                      const M& material, const DirectLightSettings& how,
                                      Context& context) {
    if constexpr (Mapper::template has<Skipping>)
        if (!scatters_through(material)) // a verdict holds for one side only
            return sample_all_lights(
                mapper.world(), vertex, material, how, context,
                verdicts_of(mapper, at_rest(mapper.world(), vertex)));
    return sample_all_lights(mapper.world(), vertex, material, how, context);
}

/// Whether a scene lists a material that may be glossy.
template <AnyWorld W>
inline constexpr bool lists_gloss = W::any_material([]<typename M>() {
    return !OnlySpecular<M> && !std::same_as<M, LambertianT<typename M::Scalar>>;
});

/// How direct light is found at a surface. If a path continues at a glossy surface, its
/// next ray also serves to find lamps. A single shadow ray to each light is enough
/// there, and at any glossy surface after the first diffuse surface. A branch that was
/// split off at glass and carries less than half of the light needs fewer shadow rays.
/// \param open  The lobes by which the path continues.
template <typename Mapper, std::floating_point T, Material M>
[[nodiscard]] DirectLightSettings direct_light_at(const Mapper& mapper,
                                                  const PathStateT<T>& path,
                                                  const M& material, Lobes open) {
    const PhotonMappingSettings& settings = mapper.settings();
    DirectLightSettings how{settings.direct, settings.shadow_rays};
    if (settings.split_glass && !path.met_diffuse) {
        const T carried = max_component(path.throughput) / path.eta_scale;
        how.rays =
            std::max(1, int(std::ceil(std::min(T(1), 2 * carried) * T(how.rays))));
    }
    if (has(lobes(material), Lobes::diffuse) || how.how == DirectLight::sampled)
        return how;
    const bool may_skip =
        mapper.passes().skipped_bounces && !scatters_through(material);
    if (has(open, Lobes::glossy) && path.depth < settings.max_depth && !may_skip &&
        !mapper.world().has_fog())
        how.next = open;
    if (path.met_diffuse || how.next != Lobes::none) how.rays = 1;
    return how;
}

} // namespace detail

/// Adds the light that a diffuse surface reflects along a camera path, except light
/// that the path's next ray finds. Direct light comes by shadow rays, and caustics come
/// from the caustics map. Where an indirect ray ends, the settings replace some of
/// these: with IndirectLight::map, the general map replaces the shadow rays; otherwise
/// irradiance points replace the shadow rays and the caustics map.
/// \param mapper    The world, the maps, the limits.
/// \param vertex    The surface.
/// \param material  Its material.
/// \param gather    Whether an indirect ray ends here.
/// \param direct    How shadow rays find direct light.
/// \param context   The random stream of the path. Counts rays and photons. Its batch
///                  may delay the query of the caustics map.
/// \param add       The RadianceSum to which the light is added.
/// \report{Sections 3.2.3 and 3.2.6}
// [light_at]
template <AnyWorld W, typename... X, std::floating_point T, Material M,
          typename Context, typename Sum>
void light_at(const PhotonMapper<W, X...>& mapper, const VertexT<T>& vertex,
              const M& material, bool gather, const DirectLightSettings& direct,
              Context& context, const Sum& add) {
    using Mapper = PhotonMapper<W, X...>;
    const PhotonMappingSettings& settings = mapper.settings();
    const PhotonMapsT<T>& maps = mapper.maps();
    const VertexT<T>& resting = detail::at_rest(mapper.world(), vertex);
    const auto ask = [&](const PhotonMapT<T>& map, const DensityEstimateSettings& how,
                         PhotonKinds kinds) {
        ++context.counts.map_queries;
        return estimate_radiance(map, resting, material, vertex.wo, how, kinds,
                                 context.counts.map_photons);
    };
    if constexpr (Mapper::template has<Gathering>)
        if (gather && settings.indirect != IndirectLight::map)
            return add("irradiance points", "DL|D..DL|DS+L",
                       known_light(mapper, resting, material, context));
    if (gather)
        add("general map", "DL|D..DL",
            ask(maps.general, settings.general_estimate, light_kinds));
    else
        add("shadow ray", "DL",
            detail::light_of_lights(mapper, vertex, material, direct, context));
    if (settings.indirect == IndirectLight::photons && !scatters_through(material))
        add("general map", "D..DL",
            ask(maps.general, settings.general_estimate,
                one_kind(PhotonKind::indirect)));
    if constexpr (Mapper::template has<Gathering>)
        if (settings.indirect == IndirectLight::cache &&
            ljus::has(lobes(material), Lobes::diffuse))
            add("irradiance cache", "D..DL",
                cached_light(mapper, vertex, material, context));
    if (maps.caustics.empty()) return;
    if (!mapper.passes().caustics_on_gloss && !has(lobes(material), Lobes::diffuse))
        return;
    T part = T(1);
    if constexpr (Mapper::template has<Gathering>)
        part = part_of_caustics(mapper, resting);
    if (detail::put_off(context.batch, resting, material, add.throughput / part,
                        settings.caustics_estimate))
        return detail::log_delay(context.log, "DS+L");
    const auto caustic = [&](const PhotonMapT<T>& map,
                             const DensityEstimateSettings& how) {
        return ask(map, how, light_kinds) / part;
    };
    RgbT<T> light = caustic(maps.caustics, settings.caustics_estimate);
    if (!maps.lone.empty()) {
        light += caustic(maps.lone, detail::lone_estimate(settings));
        light -= caustic(maps.lone, settings.caustics_estimate);
    }
    add("caustics map", "DS+L", light);
}
// [light_at]

namespace detail {

/// Adds the light that fog scatters towards the eye along a ray of a camera path, and
/// dims the path, which is not scattered. Shadow rays start at two random points of the
/// ray. One point is chosen by equi-angular sampling, the other by a free flight.
/// \param path     The path after next_vertex().
/// \param before   Its throughput before next_vertex().
/// \param surface  Distance of the next surface.
// [light in fog]
template <AnyWorld W, typename... X, std::floating_point T, typename Context,
          typename Sum>
void cross_fog(const PhotonMapper<W, X...>& mapper, PathStateT<T>& path,
               const RgbT<T>& before, T surface, Context& context, const Sum& add) {
    const W& world = mapper.world();
    if (!meets_fog(world, path.ray) || is_black(before)) return; // fly() divides by it
    FogSegmentT<T> segment{path.ray, before};
    segment.ray.t_max = surface;
    if (world.light_count() > 0) {
        constexpr MisHeuristic alone = MisHeuristic::shadow_rays;
        constexpr FogLight how = FogLight::both;
        add.add("equi-angular", "DL", aimed_light(world, segment, alone, how, context));
        PathStateT<T> flight{.throughput = before};
        if (const auto vertex = fly(world, segment, flight, context.stream))
            add.add("shadow ray", "DL",
                    light_in_flight(world, segment, *vertex, flight.throughput, alone,
                                    how, context));
    }
    const auto ask = [&](const VolumeMapT<T>& map) {
        ++context.counts.map_queries;
        return before * estimate_beam(world, map, segment.ray,
                                      mapper.settings().fog_estimate.kernel,
                                      context.counts.map_photons);
    };
    const PhotonMapsT<T>& maps = mapper.maps();
    if (!maps.fog_caustics.empty())
        add.add("volume map", "DS+L", ask(maps.fog_caustics));
    if (!maps.fog.empty()) add.add("volume map", "D..DL", ask(maps.fog));
    path.throughput *= transmittance(optical_depth(world, segment.ray), T(1));
}
// [light in fog]

/// What a camera path does at a surface.
struct SurfacePlan {
    bool gather = false; ///< Photons have the light there, see light_at().
    bool mirror = false; ///< Nearly specular gloss, which counts as a mirror.
    bool ends = false;   ///< Gloss where photons have the indirect light.
    Lobes open{};        ///< The lobes by which the path may continue.
};

/// Decides what a camera path does at a surface.
/// \param gloss_mirrors  Whether nearly specular gloss counts as a mirror on this path.
template <AnyWorld W, typename... X, std::floating_point T, Material M>
[[nodiscard]] SurfacePlan plan_surface(const PhotonMapper<W, X...>& mapper,
                                       const PathStateT<T>& path,
                                       const VertexT<T>& vertex, const M& material,
                                       [[maybe_unused]] bool gloss_mirrors) {
    const IndirectLight indirect = mapper.settings().indirect;
    const bool second = path.met_diffuse && gathers(indirect);
    const bool through = scatters_through(material);
    SurfacePlan plan{.gather = second && !through};
    if constexpr (PhotonMapper<W, X...>::template has<Gathering>)
        if (second && indirect != IndirectLight::map &&
            (has(lobes(material), Lobes::glossy) || mapper.maps().starved)) {
            // Irradiance does not determine what a glossy surface reflects.
            plan.gather = false;
            plan.mirror =
                gloss_mirrors && nearly_specular_at(mapper.world(), vertex, material);
            plan.ends = ends_on_gloss(mapper, vertex, material);
        }
    if (plan.gather || plan.ends)
        plan.open = Lobes::specular;
    else if (plan.mirror || (through && indirect == IndirectLight::photons))
        plan.open = Lobes::all;
    else
        plan.open = mapper.bounces();
    return plan;
}

/// The largest number of branches that split off from one camera path at glass.
inline constexpr std::size_t max_splits = 8;

/// Factor of the survival probability of a branch that was split off at glass. Without
/// the factor a faint branch would rarely survive roulette, and would then be bright
/// noise. The expected value does not depend on the factor.
inline constexpr int split_survival = 64;

/// Threshold of roulette after a glossy surface, see survives(). Roulette makes the few
/// paths that survive bright. Where such paths meet a lamp, they are bright noise.
inline constexpr double gloss_threshold = 0.25;

} // namespace detail

/// The radiance that one camera path finds with the photon maps.
///
/// At each diffuse surface the path sends shadow rays to each light, queries the
/// caustics map and continues by one indirect ray. At each mirror or glass it continues
/// by one branch. With IndirectLight::map the general map is queried at the first
/// diffuse surface that an indirect ray meets; with IndirectLight::photons, at the
/// diffuse surface that the camera path meets. With split_glass a path follows both
/// branches at glass until it meets a diffuse surface. Without split_glass, one path in
/// a few hundred is reflected inside a glass ball to a lamp, and makes its pixel a
/// hundred times too bright.
/// \param mapper   The world, the maps, the limits.
/// \param ray      A primary ray.
/// \param context  The random stream of this path; counts rays and photons, logs terms.
/// \return Radiance, in W/(m^2 sr); biased by the radius of the estimates and by
///         max_depth.
/// \report{Sections 3.2.3, 3.2.4 and 3.2.6}
/// \erratum{In the report's program an indirect ray that met a lamp added it again,
///          though the shadow ray had counted it.}
// [radiance]
template <AnyWorld W, typename... X, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const PhotonMapper<W, X...>& mapper, const RayT<T>& ray,
                               Context& context) {
    const PhotonMappingSettings& settings = mapper.settings();
    RgbT<T> sum{T(0)};
    // The branches that split off at glass. Each may split again.
    detail::GrowingArray<PathStateT<T>> branches;
    const auto follow_path = [&](PathStateT<T> path) {
        const RadianceSum add{sum, path.throughput, context.log};
        bool gloss_mirrors = false; // nearly specular gloss is an S
        // The number of shadow rays that share each light with the path's next ray.
        [[maybe_unused]] int sharing = 0;
        while (path.depth < settings.max_depth) {
            [[maybe_unused]] const RgbT<T> before = path.throughput;
            const auto vertex = next_vertex(mapper.world(), path, context.stream);
            if constexpr (W::lists_fog)
                detail::cross_fog(mapper, path, before,
                                  vertex ? vertex->distance : path.ray.t_max, context,
                                  add);
            if constexpr (detail::lists_gloss<W>) {
                if (sharing > 0 && !path.specular)
                    add.add("scattered ray", "L",
                            detail::met_light(mapper.world(), path, vertex, path.pdf,
                                              sharing));
                sharing = 0;
            }
            if (!vertex) {
                if (!path.met_diffuse)
                    add("sky", "L", sky_radiance(mapper.world(), path.ray.direction));
                return;
            }
            detail::log_arrival(context.log, vertex->point.position);
            if (vertex->emits() && !path.met_diffuse)
                add("emission", "L", vertex->object.emission);

            const auto at_material = [&]<typename M>(const M& material) {
                const Lobes parts = lobes(material);
                const detail::SurfacePlan plan = detail::plan_surface(
                    mapper, path, *vertex, material, gloss_mirrors);
                if constexpr (!OnlySpecular<M>)
                    if (has(parts, Lobes::non_specular) && !plan.mirror) {
                        const auto direct =
                            detail::direct_light_at(mapper, path, material, plan.open);
                        light_at(mapper, *vertex, material, plan.gather, direct,
                                 context, add);
                        if constexpr (PhotonMapper<W, X...>::template has<Gathering>)
                            if (plan.ends)
                                add("general map", "D..DL",
                                    photons_on_gloss(mapper, *vertex, material,
                                                     context.counts));
                        if (direct.next != Lobes::none) sharing = direct.rays;
                        if (!plan.gather)
                            gloss_mirrors = mapper.passes().gloss_as_mirrors &&
                                            has(parts, Lobes::diffuse);
                    }
                if (path.depth == settings.max_depth) {
                    detail::cut_if(has(parts, plan.open), context.counts);
                    return false;
                }
                if (settings.split_glass && !path.met_diffuse &&
                    branches.size() < detail::max_splits)
                    if (const auto other = split_path(path, *vertex, material)) {
                        branches.push_back(*other);
                        return true;
                    }
                // Follows one branch; after a lookup, via mirrors and glass only.
                Lobes which = plan.open;
                if constexpr (PhotonMapper<W, X...>::template has<Skipping>)
                    if (has(which, Lobes::diffuse) && !scatters_through(material) &&
                        needs_no_bounce(mapper,
                                        detail::at_rest(mapper.world(), *vertex),
                                        context.counts))
                        which = Lobes::specular;
                return continue_path(path, *vertex, material, Transport::radiance,
                                     which, context.stream);
            };
            if (!visit_material_at(mapper.world(), *vertex, at_material)) return;
            detail::log_vertex(context.log, path);
            if (is_black(path.throughput)) return;
            const T eta_scale = !branches.empty() && !path.met_diffuse
                                    ? path.eta_scale / T(detail::split_survival)
                                    : path.eta_scale;
            if (path.depth >= settings.roulette_depth &&
                !survives(path.throughput, eta_scale, next_1d<T>(context.stream),
                          sharing > 0 ? T(detail::gloss_threshold) : T(1)))
                return;
            ++context.counts.bounce_rays;
        }
    };
    context.log.begin();
    follow_path(camera_path(mapper.world(), ray, context.stream));
    for (std::size_t i = 0; i < branches.size(); ++i) {
        const PathStateT<T> branch = branches[i];
        ++context.counts.bounce_rays;
        detail::log_specular_path(context.log, branch);
        follow_path(branch);
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
