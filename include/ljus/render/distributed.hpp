#pragma once

/// \file ljus/render/distributed.hpp
/// \brief Distributed rays: one ray of each kind, in a random direction.

#include "ljus/math/stratified_stream.hpp"
#include "ljus/path/continue_path.hpp"
#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"

namespace ljus {

/// \defgroup distributed_rays Distributed rays
/// \brief Soft shadows and blurry reflections "by averaging multiple camera rays per
/// pixel" (Section 2.1 of the report), after Cook, Porter and Carpenter \cite cook1984.
/// Chapter: \ref ch_distributed_rays.
///
/// In Heckbert's notation, with G for glossy, this renderer finds the paths L D? (S|G)*
/// E: the paths of Whitted's tree, with each ray blurred. No matt surface lights
/// another.
/// \{

/// How rays are distributed.
struct DistributedSettings {
    int max_depth = 5; ///< Largest number of reflections and refractions in a row, at
                       ///< least 0.
};

/// A tracer of distributed rays. RenderSettings::sampling stratifies the rays of a
/// pixel over the pixel, the lens, the time, each light and each lobe.
template <typename W>
class DistributedTracer {
public:
    using Stream = StratifiedStream; ///< The random stream that render() passes.

    /// \param world     Must outlive the tracer.
    /// \param settings  The largest depth.
    /// \throws std::invalid_argument  if the depth is negative.
    explicit DistributedTracer(WorldRef<W> world,
                               const DistributedSettings& settings = {})
        : world_(world), settings_(settings) {
        require_at_least("max_depth", settings.max_depth, 0);
    }
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The settings.
    [[nodiscard]] const DistributedSettings& settings() const noexcept {
        return settings_;
    }

private:
    WorldRef<W> world_;
    DistributedSettings settings_;
};
/// Deduces the type of the world.
template <typename W>
DistributedTracer(const W&, const DistributedSettings& = {}) -> DistributedTracer<W>;

namespace detail {

/// Direct light at a surface, by one shadow ray to a random point of each light. A
/// glossy surface sends no shadow ray to a lamp, because the reflected ray finds the
/// lamp.
/// \param context  Two numbers are drawn for each light with a size.
/// \return Radiance towards wo.
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> soft_light(const W& world, const VertexT<T>& vertex,
                                 const M& material, Context& context) {
    const bool gloss = has(lobes(material), Lobes::glossy);
    RgbT<T> sum{T(0)};
    for (std::uint32_t light = 0; light < world.light_count(); ++light) {
        const bool met = world.can_be_met(light);
        if (gloss && met) continue;
        const Vec2T<T> u = met ? next_2d<T>(context.stream) : Vec2T<T>{T(0)};
        sum +=
            direct_light(world, light, vertex, material, u, MisT<T>{}, context.counts);
    }
    return sum;
}

} // namespace detail

/// The radiance that one camera ray finds at a random time: one ray continues at each
/// mirror, glass or glossy surface, and one shadow ray goes to each light.
/// \param tracer   The world and the settings.
/// \param ray      A primary ray.
/// \param context  The random stream of this ray; counts rays, and logs the path. In
///                 the log a glossy surface has the letter D.
/// \return Radiance, in W/(m^2 sr): an unbiased estimate of the light of the paths in
///         \ref distributed_rays, up to max_depth.
/// \cost At most max_depth + 1 rays, and as many shadow rays to each light.
/// \report{Section 2.1}
// [radiance]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const DistributedTracer<W>& tracer, const RayT<T>& ray,
                               Context& context) {
    const W& world = tracer.world();
    RgbT<T> sum{T(0)};
    auto path = camera_path(world, ray, context.stream);
    const RadianceSum add{sum, path.throughput, context.log};
    context.log.begin();
    for (;;) {
        const auto vertex = next_vertex(world, path, context.stream);
        if (!vertex) {
            add("sky", "L", sky_radiance(world, path.ray.direction));
            break;
        }
        detail::log_arrival(context.log, vertex->point.position);
        if (vertex->emits()) add("emission", "L", vertex->object.emission);

        const auto at_material = [&](const auto& material) {
            const Lobes parts = lobes(material);
            if (has(parts, Lobes::non_specular))
                add("shadow ray", "DL",
                    detail::soft_light(world, *vertex, material, context));
            const Lobes which =
                has(parts, Lobes::glossy) ? Lobes::all : Lobes::specular;
            if (path.depth > tracer.settings().max_depth) {
                detail::cut_if(has(parts, which), context.counts);
                return false;
            }
            return continue_path(path, *vertex, material, Transport::radiance, which,
                                 context.stream);
        };
        if (!visit_material_at(world, *vertex, at_material)) break;
        detail::log_vertex(context.log, path);
        if (is_black(path.throughput)) break;
        ++context.counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// \}

} // namespace ljus
