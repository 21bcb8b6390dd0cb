/// \file own_renderer.hpp
/// \brief A renderer of the reader's own: ambient occlusion.
#pragma once
#include "ljus/path/next_vertex.hpp"
#include "ljus/path/renderer.hpp"

/// Code that a reader of the book has written.
namespace reader {

// [renderer]
/// Shows how open each surface is: the fraction of the directions above it, weighted by
/// the cosine, in which no surface lies within a given distance.
template <typename World>
class AmbientOcclusion {
public:
    using Stream = ljus::RandomStream; ///< The random stream that render() passes.

    /// \param world  Must outlive the renderer.
    /// \param reach  The distance within which surfaces count, in scene units.
    AmbientOcclusion(ljus::WorldRef<World> world, float reach)
        : world_(world), reach_(reach) {}
    const World& world() const { return world_.get(); } ///< The world.
    float reach() const { return reach_; }              ///< The distance.

private:
    ljus::WorldRef<World> world_;
    float reach_;
};
/// Deduces the world.
template <typename World>
AmbientOcclusion(const World&, float) -> AmbientOcclusion<World>;
// [renderer]

// [radiance]
/// Sends one ray to the first surface, and one ray on from there.
template <typename World, typename Context>
ljus::Rgb radiance(const AmbientOcclusion<World>& renderer, const ljus::Ray& ray,
                   Context& context) {
    auto path = ljus::camera_path(renderer.world(), ray, context.stream);
    const auto vertex = next_vertex(renderer.world(), path, context.stream);
    if (!vertex) return ljus::Rgb{1};
    ljus::Vec3 up = ljus::sample_cosine_hemisphere(ljus::next_2d(context.stream));
    if (vertex->wo.z < 0) up.z = -up.z; // on the visible side
    ljus::Ray out = spawn_ray(vertex->point, to_world(vertex->frame, up), vertex->time);
    out.t_max = renderer.reach();
    ++context.counts.bounce_rays;
    return ljus::Rgb{occluded(renderer.world(), out) ? 0.0f : 1.0f};
}
// [radiance]

} // namespace reader
