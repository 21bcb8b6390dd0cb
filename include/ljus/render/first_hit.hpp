#pragma once

/// \file ljus/render/first_hit.hpp
/// \brief Pictures of normals, albedos or distances at the hits of primary rays.

#include "ljus/path/continue_path.hpp"

namespace ljus {

/// \defgroup first_hit Pictures of the first hit
/// \brief Pictures of normals, albedos or depths, for a look at a scene or as input of
/// a denoiser. Chapter: \ref ch_first_picture_first_hit.
/// \{

/// The quantity that a FirstHitRenderer shows of the first surface on a primary ray.
enum class FirstHit {
    /// The shading normal n on the visible side, as the colour (n + 1)/2; 1/2 for a ray
    /// without a hit.
    normals,
    albedo, ///< sample_albedo(), in [0, 1] on average; 0 for a ray without a hit.
    depth   ///< The distance along the ray, in scene units; 0 for a ray without a hit.
};

/// A renderer that shows the first hit of each primary ray.
template <typename W>
class FirstHitRenderer {
public:
    using Stream = RandomStream; ///< The random stream that render() passes.
    /// Scenes with fog are accepted; the fog is ignored.
    static constexpr bool carries_fog = true;

    /// \param world  Must outlive the renderer.
    /// \param shown  The quantity that a picture shows.
    FirstHitRenderer(WorldRef<W> world, FirstHit shown)
        : world_(world), shown_(shown) {}
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// The quantity that a picture shows.
    [[nodiscard]] FirstHit shown() const noexcept { return shown_; }

private:
    WorldRef<W> world_;
    FirstHit shown_;
};
/// Deduces the type of the world.
template <typename W>
FirstHitRenderer(const W&, FirstHit) -> FirstHitRenderer<W>;

/// One sample of the directional albedo of a vertex: the fraction of the light from
/// `wo` that its material reflects and transmits in all directions. The mean of the
/// weight of sample() is this fraction, for every material. For a Lambertian surface
/// the weight has no noise.
/// \param world   The closed scene.
/// \param vertex  The vertex.
/// \param stream  Three numbers are drawn.
/// \return Per channel, at least 0.
template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] RgbT<T> sample_albedo(const W& world, const VertexT<T>& vertex,
                                    Stream& stream) {
    const Vec3T<T> u = next_3d<T>(stream);
    return visit_material_at(world, vertex, [&](const auto& material) {
        // Transport of flux, because radiance is scaled by the squared ratio of
        // refractive indices at glass.
        const auto next = sample(material, vertex.wo, u, Transport::flux, Lobes::all);
        return next ? next->weight : RgbT<T>{T(0)};
    });
}

/// The first hit of a primary ray, as a colour.
/// \param renderer  The world, and the quantity to show.
/// \param ray       A primary ray.
/// \param context   The random stream; logs one term.
/// \return A colour as FirstHit describes it, which is not a radiance.
/// \cost One ray, and one sample() for an albedo.
/// \report{Section 3.2}
// [first hit]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const FirstHitRenderer<W>& renderer, const RayT<T>& ray,
                               Context& context) {
    const W& world = renderer.world();
    auto path = camera_path(world, ray, context.stream);
    const auto vertex = next_vertex(world, path, context.stream);
    RgbT<T> seen{renderer.shown() == FirstHit::normals ? T(0.5) : T(0)};
    if (vertex) {
        switch (renderer.shown()) {
        case FirstHit::normals:
            seen += std::copysign(T(0.5), vertex->wo.z) * vertex->frame.normal;
            break;
        case FirstHit::albedo:
            seen = path.throughput / vertex->stop_probability *
                   sample_albedo(world, *vertex, context.stream);
            break;
        case FirstHit::depth:
            seen = RgbT<T>{vertex->distance};
            break;
        }
    }
    context.log.begin();
    context.log.term("first hit", "", seen);
    return seen;
}
// [first hit]

/// \}

} // namespace ljus
