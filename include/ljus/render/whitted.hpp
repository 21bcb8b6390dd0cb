#pragma once

/// \file ljus/render/whitted.hpp
/// \brief Whitted's ray tracing: a tree of mirrors and glass, with hard shadows.

#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"

namespace ljus {

/// \defgroup whitted Whitted's ray tracing
/// \brief A tree of reflected, refracted and shadow rays (Section 2.1 of the report),
/// after Whitted \cite whitted1980. Chapter: \ref ch_whitted.
///
/// In Heckbert's notation this renderer finds the paths L D? S* E, with one point of
/// each light. It finds no diffuse interreflection L D D E and no caustics L S D E.
/// \{

/// How a tree is traced.
struct WhittedSettings {
    int max_depth = 5; ///< Largest number of reflections and refractions in a row, 0 to
                       ///< 1000; each is a recursive call.
    bool split_glass = true; ///< Whether both rays continue at glass, or one at random.
    bool lamps = true; ///< Whether lamps with a size send light, from their centres.
    /// Ambient radiance, in W/(m^2 sr), from all directions at every diffuse surface: a
    /// substitute for the light that the tree does not find.
    Rgb ambient{0};
};

/// Whitted's ray tracer of a world. The world must outlive the tracer.
template <typename W>
class WhittedTracer {
public:
    using Stream = RandomStream; ///< The random stream that render() passes.

    /// \param world     Must outlive the tracer.
    /// \param settings  Depth, branches, ambient light.
    /// \throws std::invalid_argument  if a setting is out of range.
    explicit WhittedTracer(WorldRef<W> world, const WhittedSettings& settings = {})
        : world_(world), settings_(settings) {
        require(settings.max_depth >= 0 && settings.max_depth <= 1000, "max_depth",
                static_cast<long long>(settings.max_depth), "within [0, 1000]");
        require_radiance("whitted.ambient", settings.ambient);
    }
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// How a tree is traced.
    [[nodiscard]] const WhittedSettings& settings() const noexcept { return settings_; }

private:
    WorldRef<W> world_;
    WhittedSettings settings_;
};
/// Deduces the type of the world.
template <typename W>
WhittedTracer(const W&, const WhittedSettings& = {}) -> WhittedTracer<W>;

namespace detail {

/// Adds the light that a diffuse surface reflects: that of each light, by one shadow
/// ray, and the ambient light, without a shadow ray.
/// \param add  A RadianceSum, to which the light is added.
// [local light]
template <AnyWorld W, std::floating_point T, Material M, typename Add>
void local_light(const WhittedTracer<W>& tracer, const VertexT<T>& vertex,
                 const M& material, Counts& counts, const Add& add) {
    const W& world = tracer.world();
    for (std::uint32_t light = 0; light < world.light_count(); ++light) {
        if (!tracer.settings().lamps && world.can_be_met(light)) continue;
        const Vec2T<T> u = world.visit_light(light, [](const auto& l) {
            if constexpr (requires { center_sample(l); })
                return center_sample(l);
            else
                return Vec2T<T>{T(0.5)};
        });
        add("shadow ray", "DL",
            direct_light(world, light, vertex, material, u, MisT<T>{}, counts));
    }
    if (tracer.settings().ambient == Rgb{0}) return;
    // As if all ambient light arrived along the normal. At a matt surface this gives
    // the albedo times the ambient radiance.
    const Vec3T<T> normal{T(0), T(0), std::copysign(T(1), vertex.wo.z)};
    add("ambient", "D",
        std::numbers::pi_v<T> * evaluate(material, vertex.wo, normal) *
            RgbT<T>(tracer.settings().ambient));
}
// [local light]

/// Traces one branch of the tree, and all branches that split off from it.
// [trace_branch]
template <AnyWorld W, std::floating_point T, typename Context>
void trace_branch(const WhittedTracer<W>& tracer, PathStateT<T> path, Context& context,
                  RgbT<T>& sum) {
    const W& world = tracer.world();
    const auto vertex = next_vertex(world, path, context.stream);
    const RgbT<T> throughput = path.throughput; // of this vertex
    const RadianceSum add{sum, throughput, context.log};
    if (!vertex) return add("sky", "L", sky_radiance(world, path.ray.direction));
    log_arrival(context.log, vertex->point.position);
    if (vertex->emits()) add("emission", "L", vertex->object.emission);

    std::optional<PathStateT<T>> other; // the second branch
    const auto at_material = [&](const auto& material) {
        if (has(lobes(material), Lobes::non_specular))
            local_light(tracer, *vertex, material, context.counts, add);
        if (path.depth > tracer.settings().max_depth) {
            cut_if(has(lobes(material), Lobes::specular), context.counts);
            return false;
        }
        if (tracer.settings().split_glass) other = split_path(path, *vertex, material);
        return other || continue_path(path, *vertex, material, Transport::radiance,
                                      Lobes::specular, context.stream);
    };
    if (!visit_material_at(world, *vertex, at_material)) return;
    log_vertex(context.log, path);
    const auto grow = [&](const PathStateT<T>& branch) {
        if (is_black(branch.throughput)) return;
        ++context.counts.bounce_rays;
        trace_branch(tracer, branch, context, sum);
    };
    grow(path);
    if (!other) return;
    log_specular_path(context.log, *other);
    grow(*other);
}
// [trace_branch]

} // namespace detail

/// The radiance that the tree of one primary ray finds.
///
/// The tree is deterministic by default: glass sends both rays, and each light has one
/// point. Only thin surfaces, materials with several lobes, glass with interpolated
/// normals, dispersion and motion choose at random.
/// \param tracer   The world and the settings.
/// \param ray      A primary ray.
/// \param context  The random stream; counts rays, logs terms.
/// \return Radiance, in W/(m^2 sr).
/// \cost Up to 2^(max_depth + 1) - 1 rays, if every ray meets glass.
/// \report{Section 2.1}
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const WhittedTracer<W>& tracer, const RayT<T>& ray,
                               Context& context) {
    RgbT<T> sum{T(0)};
    context.log.begin();
    detail::trace_branch(tracer, camera_path(tracer.world(), ray, context.stream),
                         context, sum);
    return sum;
}

/// \}

} // namespace ljus
