#pragma once

/// \file ljus/render/plain_path_tracing.hpp
/// \brief A path tracer in one page of code: the plain twin of path_tracing.hpp.

#include "ljus/path/direct_light.hpp"

namespace ljus {

/// \addtogroup path_tracing
/// \{

/// A plain path tracer of a world. The world must outlive the tracer.
template <typename W>
class PlainPathTracer {
public:
    using Stream = RandomStream; ///< The random stream that render() passes.

    /// \param world      Must outlive the tracer.
    /// \param max_depth  Largest number of surfaces on a camera path; 1 is direct light
    ///                   only.
    /// \throws std::invalid_argument  for a depth below 1.
    explicit PlainPathTracer(WorldRef<W> world, int max_depth = 100)
        : world_(world), max_depth_(max_depth) {
        require_at_least("max_depth", max_depth, 1);
    }
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The largest number of surfaces on a camera path.
    [[nodiscard]] int max_depth() const noexcept { return max_depth_; }

private:
    WorldRef<W> world_;
    int max_depth_;
};
/// Deduces the type of the world.
template <typename W>
PlainPathTracer(const W&, int = 100) -> PlainPathTracer<W>;

/// The radiance that one random path finds. Each diffuse surface sends a shadow ray to
/// one light, with equal probability for all lights. A lamp that the path meets counts
/// only if it is seen directly or via mirrors and glass, where no shadow ray could find
/// it.
///
/// The plain tracer has no MIS weights, and ignores media, thin surfaces, shading
/// normals, dispersion and motion. In a scene without these its expected value is that
/// of PathTracer; only the noise differs.
/// \param tracer   The world and the depth.
/// \param ray      A primary ray.
/// \param context  The random stream of this path; counts its rays.
/// \return Radiance, in W/(m^2 sr).
/// \report{Eq. (1)}
// [plain]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const PlainPathTracer<W>& tracer, RayT<T> ray,
                               Context& context) {
    const W& world = tracer.world();
    auto& stream = context.stream;
    Counts& counts = context.counts;
    RgbT<T> sum{T(0)}, throughput{T(1)};
    bool lamps_count = true;
    for (int depth = 1; depth <= tracer.max_depth(); ++depth, ++counts.bounce_rays) {
        const auto hit = closest_hit(world, ray);
        if (!hit) {
            if (lamps_count) sum += throughput * sky_radiance(world, ray.direction);
            break;
        }
        const VertexT<T> vertex = vertex_at(world, ray, *hit);
        if (lamps_count && vertex.emits()) sum += throughput * vertex.object.emission;
        // [plain]

        // [plain bounce]
        const bool goes_on = visit_material_at(world, vertex, [&](const auto& m) {
            // One shadow ray, to a point of a light.
            const auto lights = static_cast<T>(world.light_count());
            const auto light = static_cast<std::uint32_t>(next_1d<T>(stream) * lights);
            const Vec2T<T> u = next_2d<T>(stream);
            if (has(lobes(m), Lobes::non_specular) && world.light_count() > 0)
                sum += throughput * lights *
                       direct_light(world, light, vertex, m, u, MisT<T>{}, counts);
            // The next ray of the path.
            const auto next =
                sample(m, vertex.wo, next_3d<T>(stream), Transport::radiance);
            if (!next) return false;
            throughput *= next->weight;
            lamps_count = next->specular;
            ray = spawn_ray(vertex.point, to_world(vertex.frame, next->wi));
            return true;
        });
        if (!goes_on || (depth > 4 && !survives(throughput, T(1), next_1d<T>(stream))))
            break;
    }
    return sum;
}
// [plain bounce]

/// \}

} // namespace ljus
