#pragma once

/// \file ljus/render/vertex_merging.hpp
/// \brief Vertex connection and merging: paths from the eye and from the lights are
/// joined in four ways, which share the light by MIS weights.

#include "ljus/path/direct_light.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/photons/light_paths.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup vertex_merging Vertex connection and merging
/// \brief Path tracing, bidirectional path tracing and photon mapping in one estimate
/// \cite georgiev2012 \cite hachisuka2012. Chapter: \ref ch_both_ends.
///
/// | term       | from the light      | how the two paths are joined                  |
/// |------------|---------------------|-----------------------------------------------|
/// | emission   | nothing             | the camera path hits the lamp                 |
/// | shadow ray | a point of a light  | by a ray to the point                         |
/// | connection | a path with a bounce| by a ray to one of its vertices               |
/// | merging    | a path with a bounce| one of its vertices lies within the radius    |
///
/// Light that several of these methods can find is shared among them by the balance
/// heuristic. With radius 0 the renderer is bidirectional path tracing. It then has no
/// bias, except that the caustics of points and spots are missing.
/// \{

/// A renderer that traces light paths in its constructor and joins them to camera
/// paths. The world must outlive the renderer:
///
///     const VertexMerger merger(world, {.paths = 100000, .radius = 0.02f});
///
/// The renderer leaves out two effects. If a body of rough glass lies inside a second
/// body, a ray that leaves the glass to join two paths is not absorbed by the second
/// body. At grazing angles, meshes with interpolated normals absorb some photons, whose
/// light is missing.
template <typename W>
class VertexMerger {
public:
    using Scalar = typename W::Scalar; ///< The precision.
    using Stream = RandomStream;       ///< The random stream that render() passes.

    /// Traces the light paths.
    /// \param world     Must outlive the merger.
    /// \param settings  Number of paths, radius, limits.
    /// \throws std::invalid_argument  as trace_light_paths().
    explicit VertexMerger(WorldRef<W> world, const LightPathSettings& settings = {})
        : world_(world), settings_(settings),
          lights_(trace_light_paths(world.get(), settings)) {}
    /// The world that is rendered.
    [[nodiscard]] const W& world() const noexcept { return world_.get(); }
    /// Number of paths, radius, limits.
    [[nodiscard]] const LightPathSettings& settings() const noexcept {
        return settings_;
    }
    /// The light paths.
    [[nodiscard]] const LightPathsT<Scalar>& lights() const noexcept { return lights_; }

private:
    WorldRef<W> world_;
    LightPathSettings settings_;
    LightPathsT<Scalar> lights_;
};
/// Deduces the type of the world.
template <typename W>
VertexMerger(const W&, const LightPathSettings& = {}) -> VertexMerger<W>;

namespace detail {

/// A vertex of a camera path, its material, and the weights of the subpath.
template <std::floating_point T, Material M>
struct CameraVertex {
    const VertexT<T>& at;
    const M& material;
    const SubpathWeights& weights; ///< MIS weights at the vertex.
    int depth;                     ///< Number of surfaces from the eye to the vertex.
};
template <std::floating_point T, Material M>
CameraVertex(const VertexT<T>&, const M&, const SubpathWeights&, int)
    -> CameraVertex<T, M>;

/// The radiance of a lamp that the camera path hits, times its MIS weight.
// [emission]
template <AnyWorld W, std::floating_point T>
[[nodiscard]] RgbT<T> hit_lamp(const VertexMerger<W>& merger, const PathStateT<T>& path,
                               const VertexT<T>& lamp, const SubpathWeights& weights) {
    if (path.depth == 1) return lamp.object.emission;
    const std::uint32_t light = lamp.object.light;
    const LightEnd end = light_end(merger.world(), light, lamp.point,
                                   -path.ray.direction, path.previous);
    const double sum = others_of_emission(
        weights, end, probability_of<double>(merger.world().light_choice(), light));
    return T(weight_against(sum)) * lamp.object.emission;
}
// [emission]

/// The radiance that a camera vertex reflects from one light, found by a shadow ray,
/// times its MIS weight and divided by the probability of the light.
// [shadow ray]
template <AnyWorld W, std::floating_point T, Material M, typename Context>
[[nodiscard]] RgbT<T> ask_light(const VertexMerger<W>& merger,
                                const CameraVertex<T, M>& x, Context& context) {
    const W& world = merger.world();
    const auto [light, probability] =
        choose_light(world.light_choice(), next_1d<T>(context.stream));
    const Vec2T<T> u = next_2d<T>(context.stream);
    const RgbT<T> arrived =
        direct_light(world, light, x.at, x.material, u, MisT<T>{}, context.counts);
    if (is_black(arrived)) return arrived;

    const Vec3T<T>& here = x.at.point.position;
    const auto lamp = sample_light(world, light, here, u, x.at.time); // the same point
    const auto by = turn(x.at, x.material, lamp->wi, Transport::radiance);
    const LightEnd end = light_end(world, light, lamp->point, -lamp->wi, here);
    const Vec3T<T> way = lamp->point.position - here;
    const double sum =
        others_of_shadow_ray(x.weights, end, probability, by.pdf, by.back, by.cosine,
                             glm::dot(way, way), merger.settings().merging());
    return arrived * (T(weight_against(sum)) / probability);
}
// [shadow ray]

/// The radiance that a camera path receives by a connection, times its MIS weight. A
/// connection is a shadow ray from the vertex of the camera path to a vertex of a light
/// path.
// [connection]
template <AnyWorld W, std::floating_point T, Material M>
[[nodiscard]] RgbT<T> connect(const VertexMerger<W>& merger,
                              const CameraVertex<T, M>& x, const LightVertexT<T>& y,
                              Counts& counts) {
    const Vec3T<T> way = y.vertex.point.position - x.at.point.position;
    const T distance = glm::length(way);
    const Vec3T<T> wi = way / distance;
    const auto here = turn(x.at, x.material, wi, Transport::radiance);
    if (is_black(here.f)) return here.f;
    const auto there = visit_material_at(merger.world(), y.vertex, [&](const auto& m) {
        return turn(y.vertex, m, -wi, Transport::flux);
    });
    if (is_black(there.f)) return there.f;
    ++counts.shadow_rays;
    const RgbT<T> visible = visibility(merger.world(), x.at.point, y.vertex.point);
    if (is_black(visible)) return visible;

    const double merging = merger.settings().merging(),
                 d2 = double(distance * distance);
    const double sum =
        others(y.weights, here.pdf * there.cosine / d2, there.back, merging) +
        others(x.weights, there.pdf * here.cosine / d2, here.back, merging);
    const RgbT<T> medium =
        medium_beyond(x.at.medium, x.material, x.at.wo, to_local(x.at.frame, wi));
    // Each of N light paths carries 1/N of the flux, but only one path is connected.
    const double factor = double(merger.settings().paths) * weight_against(sum);
    return here.f * there.f * y.flux * visible * transmittance(medium, distance) *
           (here.shading * T(there.cosine / d2 * factor));
}
// [connection]

/// Finds the light vertices within the radius, and the radiance that a camera vertex
/// reflects from each of them, times the MIS weight.
/// \param add  Called with the letters of each light path and this radiance.
// [merging]
template <AnyWorld W, std::floating_point T, Material M, typename Add>
void merge(const VertexMerger<W>& merger, const CameraVertex<T, M>& x, Counts& counts,
           const Add& add) {
    const LightPathSettings& settings = merger.settings();
    const LightPathsT<T>& lights = merger.lights();
    const double merging = settings.merging();
    ++counts.map_queries;
    const auto visit = [&](std::uint32_t i, double) {
        const LightVertexT<T>& y = lights.vertices[lights.tree.point_ids()[i]];
        if (x.depth + y.depth - 1 > settings.max_depth) return;
        if (glm::dot(y.vertex.point.normal, x.at.point.normal) < T(0.5)) return;
        const Vec3T<T> wi = to_world(y.vertex.frame, y.vertex.wo);
        const auto by = turn(x.at, x.material, wi, Transport::radiance);
        if (is_black(by.f)) return;
        ++counts.map_photons;
        const double sum = others_merged(x.weights, by.back, merging) +
                           others_merged(y.weights, by.pdf, merging);
        const double area = merging / double(settings.paths); // pi r^2
        add(y.letters, by.f * y.flux * T(weight_against(sum) / area));
    };
    lights.tree.visit_within(x.at.point.position, T(settings.radius), visit);
}
// [merging]

} // namespace detail

/// The radiance that one camera path finds, with one light path for connections and all
/// light paths for merging.
/// \param merger   World and light paths.
/// \param ray      A primary ray.
/// \param context  The random stream of this path; counts its rays, logs its terms.
/// \return Radiance, in W/(m^2 sr).
// [radiance]
template <AnyWorld W, std::floating_point T, typename Context>
[[nodiscard]] RgbT<T> radiance(const VertexMerger<W>& merger, const RayT<T>& ray,
                               Context& context) {
    const W& world = merger.world();
    const LightPathSettings& settings = merger.settings();
    RgbT<T> sum{T(0)};
    auto path = camera_path(world, ray, context.stream);
    const RadianceSum terms{sum, path.throughput, context.log};
    const auto partner = merger.lights().choose(next_1d<double>(context.stream));
    SubpathWeights weights;
    context.log.begin();
    while (const auto at = next_vertex(world, path, context.stream)) {
        detail::log_arrival(context.log, at->point.position);
        weights = detail::arrived(weights, path, *at);
        if (at->emits())
            terms("emission", "L", detail::hit_lamp(merger, path, *at, weights));
        if (detail::cut_if(path.depth > settings.max_depth, context.counts)) break;

        const bool goes_on = visit_material_at(world, *at, [&](const auto& material) {
            const detail::CameraVertex x{*at, material, weights, path.depth};
            if (has(lobes(material), Lobes::non_specular) && world.light_count() > 0) {
                terms("shadow ray", "DL", detail::ask_light(merger, x, context));
                for (const LightVertexT<T>& y : partner)
                    if (x.depth + y.depth <= settings.max_depth)
                        terms("connection", y.letters.c_str(),
                              detail::connect(merger, x, y, context.counts));
                detail::merge(merger, x, context.counts,
                              [&](const std::string& letters, const RgbT<T>& light) {
                                  terms("merging", letters.c_str() + 1, light);
                              });
            }
            if (!continue_path(path, *at, material, Transport::radiance, Lobes::all,
                               context.stream))
                return false;
            weights =
                detail::scattered(weights, path, *at, material, settings.merging());
            return true;
        });
        if (!goes_on) break;
        detail::log_vertex(context.log, path);
        if (is_black(path.throughput)) break;
        if (path.depth > 4 &&
            !survives(path.throughput, path.eta_scale, next_1d<T>(context.stream)))
            break;
        ++context.counts.bounce_rays;
    }
    return sum;
}
// [radiance]

/// One pass with its own light paths and camera rays, for progressive_mean() and
/// run_progressive(). From pass to pass the radius shrinks, and with it the bias.
/// \param world     The closed scene.
/// \param camera    Any camera.
/// \param settings  Light paths *of one pass*, and the radius of the first pass.
/// \param picture   Size; rays per pixel in one pass.
/// \param pass      The number of the pass, from 1.
/// \param scale     Factor of the radius, in (0, 1].
/// \return The picture; not complete if a progress callback stopped it.
template <AnyWorld W, CameraLike C>
[[nodiscard]] RenderedT<typename C::Scalar>
vertex_merging_pass(const W& world, const C& camera, LightPathSettings settings,
                    RenderSettings picture, long long pass, double scale) {
    settings.iteration = static_cast<std::uint64_t>(pass);
    settings.radius *= static_cast<float>(scale);
    picture.seed = mix_bits(mix_bits(picture.seed) + settings.iteration);
    const VertexMerger merger(world, settings);
    return render(merger, camera, picture);
}

/// \}

} // namespace ljus
