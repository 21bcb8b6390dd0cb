#pragma once

/// \file ljus/render/layers.hpp
/// \brief A picture together with its layers: normals, albedos, depths, positions,
/// objects, and the light of classes of paths.

#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "ljus/path/light_transport.hpp"
#include "ljus/path/path_log.hpp"
#include "ljus/render/first_hit.hpp"
#include "ljus/render/render.hpp"

namespace ljus {

/// \defgroup layers Pictures in layers
/// \brief A picture and the data about it that denoisers and compositing programs use,
/// rendered in one pass. Chapter: \ref ch_today_layers.
/// \{

/// A layer with the light of some paths.
struct PathLayer {
    std::string name{};  ///< Name of the layer, such as "caustics".
    std::string paths{}; ///< The class of the light paths, as in
                         ///< light_path_expression().
};

/// Four classes of light paths: emission of lamps that the eye sees, and direct light,
/// caustics and indirect light at the first diffuse or glossy surface. Each path is in
/// exactly one class, so that the four layers add up to the picture.
[[nodiscard]] inline std::vector<PathLayer> light_path_layers() {
    return {{"emission", "ES*L"},
            {"direct", "ES*DL"},
            {"caustics", "ES*DS+L"},
            {"indirect", "ES*D.*D.*L"}};
}

/// Which layers a picture has.
///
/// Normal and albedo are means over all rays of a pixel, as denoisers need. Each ray
/// is followed to the first surface that is neither a mirror nor clear glass. Depth,
/// position and object are not means. They belong to the first surface on one ray,
/// through the middle of the pixel and of the lens, at the middle of the exposure.
struct LayerSettings {
    /// "N": the mean shading normal on the visible side, in world space; with
    /// Filter::box its length is at most 1. A ray that leaves the scene adds 0.
    bool normal = false;
    /// "albedo": the mean directional albedo, times the albedo of the mirrors and glass
    /// that the ray has met before. A ray that leaves the scene adds 0.
    bool albedo = false;
    bool depth = false; ///< "Z": the distance along the ray, in scene units; infinite
                        ///< where the ray leaves the scene.
    bool position = false; ///< "P": the point in world space; 0 where the ray leaves
                           ///< the scene.
    bool object = false;   ///< "id": the number of the object, from 1 on, in the order
                           ///< of World::objects(); 0 where the ray leaves the scene.
    std::vector<PathLayer> paths{}; ///< Layers of light, at most 64; see
                                    ///< light_path_layers().
};

/// A picture and its layers.
template <std::floating_point T>
struct RenderedLayersT {
    RenderedT<T> rendered{};         ///< The result of render(), byte for byte.
    std::vector<LayerT<T>> layers{}; ///< The layers, in the order of LayerSettings.
};

/// The layers of a picture with their names and channels, before it is rendered: all
/// pixels are 0.
/// \throws std::invalid_argument  as make_image().
template <std::floating_point T>
[[nodiscard]] std::vector<LayerT<T>> make_layers(const LayerSettings& which, int width,
                                                 int height) {
    std::vector<LayerT<T>> layers;
    const auto add = [&](bool asked, const std::string& name,
                         std::vector<std::string> channels) {
        if (asked)
            layers.push_back({name, std::move(channels), make_image<T>(width, height)});
    };
    add(which.normal, "N", {"X", "Y", "Z"});
    add(which.albedo, "albedo", {"R", "G", "B"});
    add(which.depth, "", {"Z"});
    add(which.position, "P", {"X", "Y", "Z"});
    add(which.object, "", {"id"});
    for (const PathLayer& one : which.paths) add(true, one.name, {"R", "G", "B"});
    return layers;
}

namespace detail {

/// A path that looks for a normal and an albedo ends at this number of surfaces, even
/// on a mirror.
inline constexpr int max_guide_depth = 16;

/// The contribution of one ray to the layers of normals and albedos.
template <std::floating_point T>
struct GuideT {
    Vec3T<T> normal{T(0)};
    RgbT<T> albedo{T(0)};
};

template <AnyWorld W, std::floating_point T, StreamLike Stream>
[[nodiscard]] GuideT<T> guide(const W& world, const RayT<T>& ray, Stream& stream) {
    auto path = camera_path(world, ray, stream);
    while (const auto vertex = next_vertex(world, path, stream)) {
        const bool ends = path.depth == max_guide_depth ||
                          visit_material_at(world, *vertex, [](const auto& material) {
                              return has(lobes(material), Lobes::non_specular);
                          });
        if (ends)
            return {seen_normal(*vertex), path.throughput / vertex->stop_probability *
                                              sample_albedo(world, *vertex, stream)};
        const auto follow = [&](const auto& material) {
            return continue_path(path, *vertex, material, Transport::flux,
                                 Lobes::specular, stream);
        };
        if (!visit_material_at(world, *vertex, follow)) break;
    }
    return {};
}

/// A stream whose numbers are all 1/2. A camera ray with this stream passes the middle
/// of the lens at the middle of the exposure.
struct MiddleStream {};
template <std::floating_point T = float>
[[nodiscard]] constexpr T next_1d(MiddleStream&) noexcept {
    return T(0.5);
}
constexpr void start_bounce(MiddleStream&, std::uint64_t) noexcept {}

/// The sums over the rays of one pixel.
struct LayeredPixel {
    RgbT<double> picture{0};
    Vec3T<double> normal{0};
    RgbT<double> albedo{0};
    std::vector<RgbT<double>> light{}; ///< The light of each class of paths.

    void divide(double rays) {
        picture /= rays;
        normal /= rays;
        albedo /= rays;
        for (RgbT<double>& sum : light) sum /= rays;
    }
};

/// Traces the rays of a picture one by one, and finds the values of each ray in all
/// layers.
template <typename R, typename C>
class LayeredTracer {
public:
    using T = typename C::Scalar;

    LayeredTracer(const R& renderer, const C& camera, const PictureRays& rays,
                  const LayerSettings& which,
                  std::span<const LightPathExpression> classes)
        : renderer_(renderer), camera_(camera), rays_(rays), which_(which),
          log_(classes) {}

    /// Traces one ray, and adds its radiance and other data to the sums of the pixel.
    /// \param count  Counts rays, and samples that are not finite.
    void trace(const PixelRay& at, LayeredPixel& sums, Counts& count) {
        typename R::Stream stream;
        const auto sample = sample_pixel<T>(rays_, at, stream);
        const RayT<T> ray = camera_ray(camera_, sample.place, rays_.picture.width,
                                       rays_.picture.height, stream);
        ++count.camera_rays;
        if (which_.normal || which_.albedo) {
            auto own = stream; // a copy: the picture's numbers stay the same
            const GuideT<T> found = guide(renderer_.world(), ray, own);
            sums.normal += double(sample.weight) * Vec3T<double>(found.normal);
            sums.albedo += double(sample.weight) * RgbT<double>(found.albedo);
        }
        const RgbT<T> found = light_of(ray, stream, count);
        if (!is_finite(found)) {
            ++count.rejected;
            return;
        }
        sums.picture += RgbT<double>(sample.weight * found);
        for (std::size_t k = 0; k < sums.light.size(); ++k)
            sums.light[k] += RgbT<double>(sample.weight * log_.logs[k].sum);
    }

private:
    // The radiance of a ray. The radiance of each class of paths is left in the log.
    [[nodiscard]] RgbT<T> light_of(const RayT<T>& ray, typename R::Stream& stream,
                                   Counts& count) {
        log_.takers.clear();
        for (auto& one : log_.logs) one.sum = RgbT<T>{T(0)};
        Context context{stream, count, log_, batch_};
        if constexpr (!Batches<R>) {
            return radiance(renderer_, ray, context);
        } else {
            batch_.item = 0;
            log_.next_delayed = &batch_.item;
            RgbT<T> sum = radiance(renderer_, ray, context);
            batch_.finish(renderer_, count,
                          [&](std::uint32_t item, const RgbT<T>& light) {
                              sum += light;
                              for (std::size_t k = 0; k < log_.logs.size(); ++k)
                                  if ((log_.takers[item] >> k & 1) != 0)
                                      log_.logs[k].sum += light;
                          });
            return sum;
        }
    }

    const R& renderer_;
    const C& camera_;
    const PictureRays& rays_;
    const LayerSettings& which_;
    ClassesLog<T> log_;
    typename BatchOf<R>::Type batch_{};
};

/// Calls `add` with the value of one pixel in each layer, in the order of the layers.
/// \param middle  The ray through the middle of the pixel.
template <AnyWorld W, std::floating_point T, typename Add>
void layer_values(const LayerSettings& which, const LayeredPixel& means, const W& world,
                  const RayT<T>& middle, const Add& add) {
    if (which.normal) add(RgbT<T>(means.normal));
    if (which.albedo) add(RgbT<T>(means.albedo));
    if (which.depth || which.position || which.object) {
        MiddleStream stream;
        auto path = camera_path(world, middle, stream);
        const auto vertex = next_vertex(world, path, stream);
        if (which.depth)
            add(RgbT<T>{vertex ? vertex->distance
                               : std::numeric_limits<T>::infinity()});
        if (which.position) add(vertex ? vertex->point.position : Vec3T<T>{T(0)});
        std::size_t number = vertex ? 1 + std::size_t{vertex->id.index} : 0;
        for (std::size_t type = 0; vertex && type < vertex->id.type; ++type)
            number += world.objects()[type].size();
        if (which.object) add(RgbT<T>{static_cast<T>(number)});
    }
    for (const RgbT<double>& light : means.light) add(RgbT<T>(light));
}

} // namespace detail

/// Renders a picture and its layers in one pass.
///
/// Layers of light consist of the terms that the renderer reports. A photon map reports
/// one term for a whole class of paths, such as "DS+L". For the layers this term counts
/// as the shortest path of the class. A layer can therefore select light of a photon
/// map by the surfaces on the camera path, but not by those that the photons have met.
/// The layers of light_path_layers() can be selected with every Preset.
/// \param renderer  A PathTracer, a PhotonMapper, or another Renderer with world().
/// \param camera    Any camera: see CameraLike.
/// \param picture   Size, rays, seed, threads.
/// \param which     The layers.
/// \return The picture and each layer, the same for any number of threads. If every
///         path belongs to exactly one layer of light, the sum of these layers is the
///         picture, except for rounding. A sample that is not finite is left out of the
///         picture and of all layers of light.
/// \throws std::invalid_argument  as render(), and for more than 64 classes of paths
///         or one that light_path_expression() refuses.
/// \cost The cost of the picture and a few bit operations per vertex and class of
///       paths. Normals or albedos cost one more path per ray, up to the first matt
///       surface. Depth, position or object cost one more ray per pixel.
template <typename R, CameraLike C>
requires Renderer<R, typename C::Scalar>
[[nodiscard, gnu::cold]] RenderedLayersT<typename C::Scalar>
render_layers(const R& renderer, const C& camera, const RenderSettings& picture,
              const LayerSettings& which) {
    using T = typename C::Scalar;
    detail::require_fog_carried(renderer);
    require_at_least("samples", picture.samples, 1);
    require_image_size(picture.width, picture.height);
    require(which.paths.size() <= 64, "the number of classes of light paths",
            static_cast<long long>(which.paths.size()), "at most 64");
    std::vector<LightPathExpression> classes;
    for (const PathLayer& one : which.paths)
        classes.push_back(light_path_expression(one.paths));

    RenderedLayersT<T> result;
    RenderedT<T>& rendered = result.rendered;
    rendered.image = make_image<T>(picture.width, picture.height);
    result.layers = make_layers<T>(which, picture.width, picture.height);
    const PictureRays rays(picture);
    std::vector<Counts> counts(static_cast<std::size_t>(picture.height));
    const auto row = [&](long long number) {
        const int y = static_cast<int>(number);
        Counts& count = counts[static_cast<std::size_t>(number)];
        detail::LayeredTracer<R, C> tracer(renderer, camera, rays, which, classes);
        detail::LayeredPixel sums;
        for (int x = 0; x < picture.width; ++x) {
            sums = {.light = std::vector<RgbT<double>>(classes.size(), {0, 0, 0})};
            for (int i = 0; i < picture.samples; ++i)
                tracer.trace({x, y, i}, sums, count);
            sums.divide(double(picture.samples));
            pixel(rendered.image, x, y) = RgbT<T>(sums.picture);
            detail::MiddleStream middle;
            const RayT<T> ray =
                camera_ray(camera, Vec2T<T>{T(x) + T(0.5), T(y) + T(0.5)},
                           picture.width, picture.height, middle);
            auto layer = result.layers.begin();
            detail::layer_values(
                which, sums, renderer.world(), ray,
                [&](const RgbT<T>& value) { pixel((layer++)->image, x, y) = value; });
        }
    };
    rendered.complete =
        parallel_blocks(picture.height, row,
                        {.threads = picture.threads, .progress = picture.progress});
    for (const Counts& count : counts) rendered.counts += count;
    return result;
}

/// \}

} // namespace ljus
