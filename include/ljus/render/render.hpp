#pragma once

/// \file ljus/render/render.hpp
/// \brief Renders pictures: the loop over pixels.

#include <algorithm>

#include "ljus/image/filter.hpp"
#include "ljus/image/image.hpp"
#include "ljus/math/sampling_pattern.hpp"
#include "ljus/parallel.hpp"
#include "ljus/path/renderer.hpp"
#include "ljus/ref.hpp"
#include "ljus/render/detail/sample_sums.hpp"
#include "ljus/scene/camera.hpp"

namespace ljus {

/// \defgroup render Rendering
/// \brief The loop over the pixels of a picture: "in order to render an image, primary
/// rays are cast into the scene" (Section 3.2 of the report).
/// \{

/// Size and sampling of a picture.
struct RenderSettings {
    int width = 400;        ///< Width in pixels, at least 1.
    int height = 400;       ///< Height in pixels, at least 1.
    int samples = 64;       ///< Exact number of primary rays per pixel, at least 1.
    std::uint64_t seed = 1; ///< Seed of the random streams.
    int threads = 0;        ///< Number of threads, as in ParallelSettings.
    Progress progress = no_progress; ///< Called with (done, total); returns false to
                                     ///< stop.
    Sampling sampling = Sampling::multi_jittered; ///< Positions of rays within a pixel.
    /// Weight of a ray by its position relative to the pixel.
    Filter filter = Filter::box;
};

namespace detail {

/// Refuses a scene with fog if the renderer has no member `carries_fog`. OnlyPaths,
/// which selects some of a renderer's paths, is judged by that renderer.
template <typename R>
void require_fog_carried([[maybe_unused]] const R& renderer) {
    constexpr bool carries = requires {
        R::carries_fog;
    };
    if constexpr (requires { renderer.whole(); })
        require_fog_carried(renderer.whole());
    else if constexpr (!carries && requires { renderer.world().has_fog(); })
        require_no_fog(renderer.world(), "this renderer");
}

} // namespace detail

/// The result of rendering.
template <std::floating_point T>
struct RenderedT {
    ImageT<T> image{};    ///< The mean radiance of each pixel.
    Counts counts{};      ///< Numbers of rays and photons.
    bool complete = true; ///< False if the progress callback stopped the work.
};

/// Sets a stream to its first number for one ray.
/// \param stream   The stream; every type of stream has an overload.
/// \param seed     The user's seed.
/// \param pixel    The pixel's number within the picture.
/// \param ray      The ray's number within the pixel.
/// \param pattern  The result of make_pattern() for the rays of a pixel.
constexpr void start_ray(RandomStream& stream, std::uint64_t seed, std::uint64_t pixel,
                         int ray, const Pattern& pattern) noexcept {
    stream = random_stream(seed, Pass::camera, 0,
                           pixel * static_cast<std::uint64_t>(pattern.points) +
                               static_cast<std::uint64_t>(ray));
}

namespace detail {

/// The number of neighbouring pixels of a row that are rendered together.
inline constexpr int strip_width = 16;

} // namespace detail

/// The rays of a picture; all pixels share one sampling pattern.
struct PictureRays {
    /// \param settings  Size, rays, seed, filter; must outlive the PictureRays.
    explicit PictureRays(Ref<RenderSettings> settings)
        : picture(settings.get()),
          pattern(make_pattern(picture.sampling, picture.samples)) {}

    const RenderSettings& picture; ///< Size, rays, seed, filter.
    Pattern pattern;               ///< Pattern of the rays of a pixel.
};

/// One ray of a picture.
struct PixelRay {
    int x = 0;      ///< Column of the pixel.
    int y = 0;      ///< Row of the pixel.
    int number = 0; ///< Number of the ray within the pixel.
};

/// The position of one ray in the picture, and its filter weight.
/// \param rays    The rays of the picture.
/// \param at      Which ray.
/// \param stream  Set to the random numbers of that ray. Two of them are drawn, for the
///                position.
/// \return The position in pixels from the upper left corner, and its weight.
template <std::floating_point T, StreamLike Stream>
[[nodiscard]] FilterSampleT<T> sample_pixel(const PictureRays& rays, const PixelRay& at,
                                            Stream& stream) {
    const RenderSettings& picture = rays.picture;
    const auto pixel =
        static_cast<std::uint64_t>(at.y) * static_cast<std::uint64_t>(picture.width) +
        static_cast<std::uint64_t>(at.x);
    start_ray(stream, picture.seed, pixel, at.number, rays.pattern);
    const Vec2T<T> u = spread(rays.pattern, at.number, mix_bits(picture.seed) ^ pixel,
                              next_2d<T>(stream));
    FilterSampleT<T> sample = sample_filter(picture.filter, u);
    sample.place += Vec2T<T>{T(at.x), T(at.y)};
    return sample;
}

/// The result of one ray of a pixel.
template <std::floating_point T>
struct PixelSampleT {
    RgbT<T> radiance{T(0)}; ///< Radiance of the ray, in W/(m^2 sr).
    T weight = T(1);        ///< Filter weight at the ray's position.
};

/// Sends one ray through a pixel, as the pixel loop does.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    Any camera.
/// \param rays      The rays of the picture.
/// \param at        Which ray.
/// \param counts    Counts the rays.
/// \param log       Receives each vertex and each term, without the filter weight.
/// \param batch     Receives the queries that the renderer delays.
/// \return Radiance and filter weight.
// [trace_pixel]
template <typename R, CameraLike C, typename Log = const NoLog,
          typename Batch = const NoBatch>
[[nodiscard]] PixelSampleT<typename C::Scalar>
trace_pixel(const R& renderer, const C& camera, const PictureRays& rays,
            const PixelRay& at, Counts& counts, Log& log = detail::no_log,
            Batch& batch = detail::no_batch) {
    using T = typename C::Scalar;
    typename R::Stream stream;
    const auto sample = sample_pixel<T>(rays, at, stream);
    const RayT<T> ray = camera_ray(camera, sample.place, rays.picture.width,
                                   rays.picture.height, stream);
    ++counts.camera_rays;
    Context context{stream, counts, log, batch};
    return {radiance(renderer, ray, context), sample.weight};
}
// [trace_pixel]

/// A rectangle of a picture's pixels.
struct PixelRegion {
    int x = 0;      ///< The first column.
    int y = 0;      ///< The first row, from the top.
    int width = 1;  ///< Width in pixels, at least 1.
    int height = 1; ///< Height in pixels, at least 1.
};

/// Renders a part of a picture by several threads, for example some rows on one of
/// several machines. Its pixels are those of the picture that render() returns, byte
/// for byte.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    Any camera: see CameraLike.
/// \param picture   Size of the whole, rays, seed, threads.
/// \param region    A rectangle within the picture.
/// \return A picture of the region alone. A sample that is not finite is left out and
///         counted.
/// \throws std::invalid_argument  if the size or the number of rays is below 1, the
///         region reaches out of the picture, or the scene has fog that the renderer
///         does not carry.
/// \cost The cost of all strips of 16 pixels that the region touches.
template <typename R, CameraLike C>
requires Renderer<R, typename C::Scalar>
[[nodiscard, gnu::cold]] RenderedT<typename C::Scalar>
render_region(const R& renderer, const C& camera, const RenderSettings& picture,
              const PixelRegion& region) {
    using T = typename C::Scalar;
    detail::require_fog_carried(renderer);
    require_at_least("samples", picture.samples, 1);
    require_image_size(picture.width, picture.height);
    const auto inside = [](int first, int size, int all) {
        return first >= 0 && size >= 1 && first < all && size <= all - first;
    };
    require(inside(region.x, region.width, picture.width), "the region's width",
            static_cast<long long>(region.width),
            "at least 1, and the region within the picture");
    require(inside(region.y, region.height, picture.height), "the region's height",
            static_cast<long long>(region.height),
            "at least 1, and the region within the picture");
    RenderedT<T> result{.image = make_image<T>(region.width, region.height)};
    const PictureRays rays(picture);
    const int right = region.x + region.width; // one past the last column
    const int first_tile = region.x / detail::strip_width;
    const int tiles = (right - 1) / detail::strip_width + 1 - first_tile;
    std::vector<Counts> counts(static_cast<std::size_t>(tiles) *
                               static_cast<std::size_t>(result.image.height));
    // Whole strips, because the rays of a strip are traced together.
    const auto strip = [&](long long number) {
        const int row = static_cast<int>(number / tiles);
        const int first =
            (first_tile + static_cast<int>(number % tiles)) * detail::strip_width;
        const int last = std::min(first + detail::strip_width, picture.width);
        const int y = region.y + row;
        Counts cost; // local, so that threads do not share a cache line
        std::array<detail::PixelSums, detail::strip_width> sums{};
        detail::SampleSums<R, T> samples(renderer, sums, cost);
        for (int x = first; x < last; ++x)
            for (int i = 0; i < picture.samples; ++i)
                samples.add(std::size_t(x - first), [&](auto& batch) {
                    return trace_pixel(renderer, camera, rays, {x, y, i}, cost,
                                       detail::no_log, batch);
                });
        samples.finish();
        const int begin = std::max(first, region.x), end = std::min(last, right);
        RgbT<T>* out = &pixel(result.image, begin - region.x, row);
        for (int x = begin; x < end; ++x)
            *out++ =
                RgbT<T>(sums[std::size_t(x - first)].sum / double(picture.samples));
        counts[static_cast<std::size_t>(number)] = cost;
    };
    result.complete =
        parallel_blocks(static_cast<long long>(counts.size()), strip,
                        {.threads = picture.threads, .progress = picture.progress});
    for (const Counts& cost : counts) result.counts += cost;
    return result;
}

/// Renders a picture by several threads, in strips of 16 pixels.
/// \param renderer  A PathTracer, a PhotonMapper, or any other Renderer.
/// \param camera    Any camera: see CameraLike.
/// \param picture   Size, rays, seed, threads.
/// \return The picture, the same for any number of threads. A sample that is not finite
///         is left out and counted.
/// \throws std::invalid_argument  as render_region().
template <typename R, typename C>
[[nodiscard]] auto render(const R& renderer, const C& camera,
                          const RenderSettings& picture) {
    static_assert(
        CameraLike<C>,
        "This is no camera, which render() takes second: a camera has a type Scalar "
        "and camera_ray(camera, pixel, width, height, stream), which returns a Ray.");
    if constexpr (CameraLike<C>) {
        using T = typename C::Scalar;
        static_assert(
            Renderer<R, T>,
            "This is no Renderer, such as PathTracer(world): it has a type "
            "Stream and radiance(renderer, ray, context), which returns an Rgb.");
        if constexpr (Renderer<R, T>)
            return render_region(renderer, camera, picture,
                                 {0, 0, picture.width, picture.height});
        else
            return RenderedT<T>{};
    } else {
        return RenderedT<float>{};
    }
}

/// \}

} // namespace ljus
